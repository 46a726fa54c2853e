// Arcs. Across an edge the overlap h is the support function of what both bodies are along the edge, f(x) by the angle
// x, of which f + f" is the radius of curvature: 0 for an apex, R w_k^2 / |n x w|^3 for a rim, w the axis, which is the
// greatest where n is nearest to w. Over an arc of a quarter at most, which has no other piece in it, f is not below r
// - where two points of both ends say so;
// - where the radius is not above r, if f is not below r at the ends: f - r is concave but for a sine;
// - where it is not below r, if f is not at one point in it, and its slope there: f - r is convex but for a sine, f - r
//   >= (f - r) cos x + f' sin x from there. The minimum is found by Newton's method.
// Other arcs are halved. r is the least value so far, so what is shown for it stays so where that falls.
#include "query/swept/arcs.h"

// Halves of an arc, of which there are many where the axis is nearly across the edge, and steps to a minimum.
enum { MOST_HALVES = 36, MOST_STEPS = 24 };
// Points that are nearer than that part of the size span no line.
#define SHORT 0x1p-6
// A slope that is none, as a part of the size.
#define LEVEL 1e-14

// A direction, and what both bodies have there.
typedef struct arc_end {
    plane_vector n, v; ///< the difference of the farthest points
    double value;
    double along, aside; ///< n by the axis: their products
    double sine;         ///< of the angle to the axis
} arc_end;

arc_plane arcs_make_plane(const edged_search *q, int edge, plane_vector axis, double square) {
    arc_plane o = {.edge = edge, .axis = axis, .square = square};
    const double squared = dot2(axis, axis), at = -q->sine, left = squared - at * at;
    if (!(squared > 1e-200)) return o;
    o.at[0] = unit2(o.axis.x, o.axis.y);
    o.at[1] = (plane_vector){-o.at[0].x, -o.at[0].y};
    o.breaks = 2;
    if (!(left > 0)) return o;
    const double scale = 1 / squared, aside = sqrt(left);
    for (int i = 0; i < 2; i++) {
        const double side = i ? aside : -aside;
        o.at[2 + i] = unit2((at * o.axis.x - side * o.axis.y) * scale, (at * o.axis.y + side * o.axis.x) * scale);
    }
    o.breaks = 4;
    return o;
}

// Of a minimum the direction is right to rounding, which a value that is as low is not: it comes before others, and
// these before what was known only where they are lower by more than that.
static void take_in_plane(edged_search *q, const arc_plane *o, const arc_end *e, int is_minimum) {
    if (!(e->value < q->value + (is_minimum ? LEVEL : -LEVEL) * q->size)) return;
    edged_set_value(q, min2(e->value, q->value), FREE_EDGED, o->edge);
    q->is_on_arc = 1;
    q->in_plane = e->n;
}

static arc_end make_end(const edged_search *q, const arc_plane *o, plane_vector n) {
    arc_end e = {.n = n, .along = dot2(n, o->axis), .aside = cross2(n, o->axis)};
    e.sine = sqrt(o->square + e.aside * e.aside);
    const double scale = e.sine > 0 ? q->radius / e.sine : 0, along = o->up * q->height;
    e.v.x = o->corner.x + (along * o->axis.x + scale * (o->square * n.x + e.aside * o->axis.y));
    e.v.y = o->corner.y + (along * o->axis.y + scale * (o->square * n.y - e.aside * o->axis.x));
    e.value = dot2(n, e.v);
    return e;
}

// Is f not below what is wanted along all directions between two, by the points of both?
static int is_held(const edged_search *q, const arc_plane *o, const arc_end *from, const arc_end *to) {
    if (min2(from->value, dot2(from->v, to->n)) >= q->low || min2(to->value, dot2(to->v, from->n)) >= q->low) return 1;
    const plane_vector d = {to->v.x - from->v.x, to->v.y - from->v.y};
    const double area = o->side * cross2(from->v, to->v), square = dot2(d, d);
    return area > 0 && square > SHORT * SHORT * q->size * q->size && area * area >= q->low * q->low * square &&
           min2(from->value, to->value) >= q->low;
}

// The slope of f from `from` to `to`.
static inline double find_slope(const arc_plane *o, const arc_end *e) { return o->side * cross2(e->n, e->v); }

static inline double find_radius(const edged_search *q, const arc_plane *o, double sine) {
    return o->square > 0 ? q->radius * o->square / (sine * sine * sine) : 0;
}

// Over an arc where the radius of curvature is not below what is wanted: to its minimum.
static int find_bottom(edged_search *q, const arc_plane *o, arc_end from, arc_end to) {
    if (find_slope(o, &from) >= 0 || find_slope(o, &to) <= 0) return 1;
    plane_vector n = unit2(o->side * (to.v.y - from.v.y), o->side * (from.v.x - to.v.x));
    for (int k = 0; k < MOST_STEPS; k++) {
        const arc_end e = make_end(q, o, n);
        const double slope = find_slope(o, &e), bend = find_radius(q, o, e.sine) - e.value;
        const int is_minimum = fabs(slope) <= LEVEL * q->size;
        take_in_plane(q, o, &e, is_minimum);
        if (is_minimum) return 1;
        if (slope > 0)
            to = e;
        else
            from = e;
        if (e.value > q->value && is_held(q, o, &from, &to)) return 1;
        const double step = -slope / bend * o->side;
        const plane_vector next = unit2(n.x - step * n.y, n.y + step * n.x);
        const int is_within =
            bend > 0 && o->side * cross2(from.n, next) > 0 && o->side * cross2(next, to.n) > 0 && dot2(n, next) > 0.5;
        n = is_within ? next : unit2(from.n.x + to.n.x, from.n.y + to.n.y);
    }
    return 0;
}

// NOLINTNEXTLINE(misc-no-recursion): no arc is halved more than MOST_HALVES times
static int hold_arc(edged_search *q, const arc_plane *o, const arc_end *from, const arc_end *to, int halves) {
    if (is_held(q, o, from, to)) return 1;
    // The radius falls from the axis, which is in no arc, to the directions across it.
    const double a = find_radius(q, o, from->sine), b = find_radius(q, o, to->sine), most = max2(a, b),
                 least = from->along * to->along < 0 ? q->radius * o->square : min2(a, b);
    if (most <= q->value) return 1;
    if (least >= q->value) return find_bottom(q, o, *from, *to);
    if (halves == 0 || q->left-- <= 0) return 0;
    const arc_end middle = make_end(q, o, unit2(from->n.x + to->n.x, from->n.y + to->n.y));
    take_in_plane(q, o, &middle, 0);
    return hold_arc(q, o, from, &middle, halves - 1) && hold_arc(q, o, &middle, to, halves - 1);
}

// Sets the piece between two directions; 0 if it is an apex, whose arc is above its ends.
static int set_piece(const edged_search *q, arc_plane *o, plane_vector from, plane_vector to) {
    const plane_vector n = {from.x + to.x, from.y + to.y};
    const double along = dot2(n, o->axis), aside = cross2(n, o->axis), apex = 2 * q->height * along;
    o->up = q->is_cone || along >= 0 ? 1 : -1;
    return !(q->is_cone && along < 0 &&
             apex * apex >= q->radius * q->radius * (o->square * dot2(n, n) + aside * aside));
}

static int hold_between(edged_search *q, arc_plane *o, plane_vector from, plane_vector to) {
    if (!set_piece(q, o, from, to)) return 1;
    const arc_end first = make_end(q, o, from), last = make_end(q, o, to);
    take_in_plane(q, o, &first, 0);
    take_in_plane(q, o, &last, 0);
    return hold_arc(q, o, &first, &last, MOST_HALVES);
}

// In order from the first direction of the arc to its last one.
static void add_break(const arc_plane *o, plane_vector n, plane_vector *breaks, int *count) {
    if (!arcs_is_within(o, n)) return;
    int at = (*count)++;
    for (; at > 1 && o->side * cross2(n, breaks[at - 1]) > 0; at--) breaks[at] = breaks[at - 1];
    breaks[at] = n;
}

// Is an arc of a quarter at most shown by its ends?
static int is_short(const edged_search *q, arc_plane *o) {
    set_piece(q, o, o->first, o->first);
    const arc_end first = make_end(q, o, o->first);
    set_piece(q, o, o->last, o->last);
    const arc_end last = make_end(q, o, o->last);
    return is_held(q, o, &first, &last);
}

int arcs_hold(edged_search *q, arc_plane *o) {
    plane_vector breaks[7] = {o->first};
    int count = 1;
    if (dot2(o->first, o->last) < 0) {
        const double x = o->last.x - o->first.x, y = o->last.y - o->first.y;
        add_break(o, unit2(o->side * y, -o->side * x), breaks, &count);
    } else if (is_short(q, o)) {
        return 1;
    }
    for (int i = 0; i < o->breaks; i++) add_break(o, o->at[i], breaks, &count);
    breaks[count++] = o->last;
    for (int i = 1; i < count; i++)
        if (!hold_between(q, o, breaks[i - 1], breaks[i])) return 0;
    return 1;
}
