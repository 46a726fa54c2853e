// Theorem. Let h(n) be the overlap of a box and a cylinder or a cone along a unit n, and n* a direction in which it is
// the least, and above 0. Where both bodies have one farthest point around n*, a corner and a point of a rim or an
// apex, h is the sum of a linear function and of R |n x w|, w the axis: across n* and along w nothing bends it, so that
// h / |n| bends down there, and n* is no minimum. So n* is one of these:
// - the axis of a disc, at w or -w;
// - on the circle across an edge of the box, or
// - where the side of the round body has more than one farthest point: on the circle across the axis of a cylinder, and
//   on the one around that of a cone. Between the directions in which an edge of the box is across, that is the circles
//   above, h is a constant and a cosine there: its minimum is where a corner goes straight to the axis.
//
// On the circle across an edge h is the support function of what both bodies are along the edge, f(x) by the angle x,
// of which f + f" is the radius of curvature: 0 for an apex, R w_k^2 / |n x w|^3 for a rim, which is the greatest where
// n is nearest to w. Over an arc of a quarter at most, which has no other piece in it, f is not below r
// - where two points of both ends say so;
// - where the radius is not above r, if f is not below r at the ends: f - r is concave but for a sine;
// - where it is not below r, if f is not at one point in it, and its slope there: f - r is convex but for a sine, f - r
//   >= (f - r) cos x + f' sin x from there. The minimum is found by Newton's method.
// Other arcs are halved. r is the least value so far, so what is shown for it stays so where that falls.
//
// (For two boxes that leaves the 15 axes of exact/boxes.c.)
//
// Errors, in parts u s as in swept.c: the axis and the centre in the box's axes are taken as they were rounded, which
// moves no point by more than 10 u s; a value is summed to 40 u s; that of a direction that is off by some u is by as
// many u s. |n x w| is computed from the product, so that nothing is lost near the axis. The cosines and sines of the
// arcs' proofs add the slope that is left.
#include "query/swept/circles.h"

#include "query/swept/points.h"

// Halves of an arc, and steps to a minimum.
enum { MOST_HALVES = 12, MOST_STEPS = 24 };
// Points that are nearer than that part of the size span no line.
#define SHORT 0x1p-6
// A slope that is none, as a part of the size.
#define LEVEL 1e-14

// Which body has more than one farthest point along a direction.
typedef enum free_body { FREE_BOX, FREE_ROUND, FREE_BOTH } free_body;

// A box and a round body in the box's axes, from its centre. Directions go from the box to the round body.
typedef struct box_and_round {
    const double *half; ///< of the box
    double axis[3], center[3];
    double height, radius; ///< half of the former
    int is_cone;
    double sine, cosine; ///< of the side's normals: their height along the axis, and across it
    double inside;       ///< how far the side is from the centre
    double ball;         ///< a ball around the centre that the body holds
    double size, tolerance;
    double value; ///< the least so far
    double low;   ///< what is to be shown
    double n[3];  ///< its direction
    free_body free;
    int edge; ///< FREE_BOTH: that of the box
} box_and_round;

static inline double dot3(const double a[3], const double b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

// ---- directions

static double measure(const box_and_round *q, const double n[3]) {
    const double *w = q->axis, t = dot3(n, w), x = n[1] * w[2] - n[2] * w[1], y = n[2] * w[0] - n[0] * w[2],
                 z = n[0] * w[1] - n[1] * w[0], rim = q->radius * sqrt((x * x + y * y) + z * z), along = q->height * t;
    const double round = q->is_cone ? max2(-along, along + rim) : fabs(along) + rim;
    const double box = (q->half[0] * fabs(n[0]) + q->half[1] * fabs(n[1])) + q->half[2] * fabs(n[2]);
    return (box + round) - dot3(n, q->center);
}

static inline void set_least(box_and_round *q, double value, const double n[3], free_body free, int edge) {
    q->value = value;
    q->low = value - 0.5 * q->tolerance;
    for (int i = 0; i < 3; i++) q->n[i] = n[i];
    q->free = free;
    q->edge = edge;
}

static inline void take(box_and_round *q, double value, const double n[3], free_body free, int edge) {
    if (value < q->value) set_least(q, value, n, free, edge);
}

// Of a direction and its reverse; of a cylinder the lesser one is that to its centre.
static void take_both(box_and_round *q, const double n[3], free_body free, int edge) {
    const double m[3] = {-n[0], -n[1], -n[2]};
    const int is_ahead = dot3(n, q->center) >= 0;
    if (q->is_cone || is_ahead) take(q, measure(q, n), n, free, edge);
    if (q->is_cone || !is_ahead) take(q, measure(q, m), m, free, edge);
}

static void take_faces(box_and_round *q) {
    for (int k = 0; k < 3; k++) {
        double n[3] = {0, 0, 0};
        n[k] = 1;
        take_both(q, n, FREE_BOX, k);
    }
    // The apex of a cone is no disc; that direction is as good as others.
    take_both(q, q->axis, FREE_ROUND, 0);
}

// Where the box's corner goes straight to the axis, or the slant: v the corner from the round body's centre. Its depth
// is `most` less what it is off the axis, which is to be above 0 and less than the least so far.
static void take_corner(box_and_round *q, const double v[3], const double sign[3]) {
    const double along = dot3(v, q->axis), most = q->inside - q->sine * along, left = most - q->value;
    double off[3], n[3];
    for (int i = 0; i < 3; i++) off[i] = v[i] - along * q->axis[i];
    const double square = dot3(off, off), squared = q->cosine * q->cosine * square;
    if (!(square > 0 && most > 0) || squared > most * most || (left > 0 && squared < left * left)) return;
    const double across = q->cosine / sqrt(square);
    int is_corner = 1;
    for (int i = 0; i < 3; i++) {
        n[i] = -(q->sine * q->axis[i] + across * off[i]);
        is_corner &= n[i] * sign[i] >= 0;
    }
    if (is_corner) take(q, measure(q, n), n, FREE_ROUND, 0);
}

static void take_corners(box_and_round *q) {
    for (int i = 0; i < 8; i++) {
        const double sign[3] = {i & 1 ? -1 : 1, i & 2 ? -1 : 1, i & 4 ? -1 : 1};
        double v[3];
        for (int k = 0; k < 3; k++) v[k] = sign[k] * q->half[k] - q->center[k];
        take_corner(q, v, sign);
    }
}

// ---- the circle across an edge

typedef struct plane_vector {
    double x, y;
} plane_vector;

static inline double dot2(plane_vector a, plane_vector b) { return a.x * b.x + a.y * b.y; }
static inline double cross2(plane_vector a, plane_vector b) { return a.x * b.y - a.y * b.x; }
static inline plane_vector unit2(double x, double y) {
    const double scale = 1 / sqrt(x * x + y * y);
    return (plane_vector){x * scale, y * scale};
}

// The plane across the box's axis k, which the axes i and j span, and directions in it: those nearest to the round
// body's axis and its reverse, and where that body goes from one piece to another.
typedef struct circle {
    int i, j, k;
    plane_vector axis;
    double square;      ///< of the axis along k
    plane_vector at[4]; ///< the last two are the kinks
    int breaks;
    plane_vector last;   ///< of the quarter that is looked at
    plane_vector corner; ///< of the box in the quarter that is looked at, from the round body's centre
    double side;         ///< 1 if the quarter turns to the left, or -1
    double up;           ///< in the arc that is looked at, the rim's height along the axis in parts of the body's
} circle;

// A direction, and what both bodies have there.
typedef struct arc_end {
    plane_vector n, v; ///< the difference of the farthest points
    double value;
    double along, aside; ///< n by the axis: their products
    double sine;         ///< of the angle to the axis
} arc_end;

static circle make_circle(const box_and_round *q, int k) {
    circle o = {.i = (k + 1) % 3, .j = (k + 2) % 3, .k = k};
    o.axis = (plane_vector){q->axis[o.i], q->axis[o.j]};
    o.square = q->axis[k] * q->axis[k];
    const double squared = dot2(o.axis, o.axis), at = -q->sine, left = squared - at * at;
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
static void take_in_plane(box_and_round *q, const circle *o, const arc_end *e, int is_minimum) {
    if (!(e->value < q->value + (is_minimum ? LEVEL : -LEVEL) * q->size)) return;
    double at[3];
    at[o->i] = e->n.x, at[o->j] = e->n.y, at[o->k] = 0;
    set_least(q, min2(e->value, q->value), at, FREE_BOX, o->k);
}

static arc_end make_end(const box_and_round *q, const circle *o, plane_vector n) {
    arc_end e = {.n = n, .along = dot2(n, o->axis), .aside = cross2(n, o->axis)};
    e.sine = sqrt(o->square + e.aside * e.aside);
    const double scale = e.sine > 0 ? q->radius / e.sine : 0, along = o->up * q->height;
    e.v.x = o->corner.x + (along * o->axis.x + scale * (o->square * n.x + e.aside * o->axis.y));
    e.v.y = o->corner.y + (along * o->axis.y + scale * (o->square * n.y - e.aside * o->axis.x));
    e.value = dot2(n, e.v);
    return e;
}

// Is f not below what is wanted along all directions between two, by the points of both?
static int is_held(const box_and_round *q, const circle *o, const arc_end *from, const arc_end *to) {
    if (min2(from->value, dot2(from->v, to->n)) >= q->low || min2(to->value, dot2(to->v, from->n)) >= q->low) return 1;
    const plane_vector d = {to->v.x - from->v.x, to->v.y - from->v.y};
    const double area = o->side * cross2(from->v, to->v), square = dot2(d, d);
    return area > 0 && square > SHORT * SHORT * q->size * q->size && area * area >= q->low * q->low * square &&
           min2(from->value, to->value) >= q->low;
}

// The slope of f from `from` to `to`.
static inline double find_slope(const circle *o, const arc_end *e) { return o->side * cross2(e->n, e->v); }

static inline double find_radius(const box_and_round *q, const circle *o, double sine) {
    return o->square > 0 ? q->radius * o->square / (sine * sine * sine) : 0;
}

// Over an arc where the radius of curvature is not below what is wanted: to its minimum.
static int find_bottom(box_and_round *q, const circle *o, arc_end from, arc_end to) {
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
static int hold_arc(box_and_round *q, const circle *o, const arc_end *from, const arc_end *to, int halves) {
    if (is_held(q, o, from, to)) return 1;
    // The radius falls from the axis, which is in no arc, to the directions across it.
    const double a = find_radius(q, o, from->sine), b = find_radius(q, o, to->sine), most = max2(a, b),
                 least = from->along * to->along < 0 ? q->radius * o->square : min2(a, b);
    if (most <= q->value) return 1;
    if (least >= q->value) return find_bottom(q, o, *from, *to);
    if (halves == 0) return 0;
    const arc_end middle = make_end(q, o, unit2(from->n.x + to->n.x, from->n.y + to->n.y));
    take_in_plane(q, o, &middle, 0);
    return hold_arc(q, o, from, &middle, halves - 1) && hold_arc(q, o, &middle, to, halves - 1);
}

// Sets the piece between two directions; 0 if it is an apex, whose arc is above its ends.
static int set_piece(const box_and_round *q, circle *o, plane_vector from, plane_vector to) {
    const plane_vector n = {from.x + to.x, from.y + to.y};
    const double along = dot2(n, o->axis), aside = cross2(n, o->axis), apex = 2 * q->height * along;
    o->up = q->is_cone || along >= 0 ? 1 : -1;
    return !(q->is_cone && along < 0 &&
             apex * apex >= q->radius * q->radius * (o->square * dot2(n, n) + aside * aside));
}

static int hold_between(box_and_round *q, circle *o, plane_vector from, plane_vector to) {
    if (!set_piece(q, o, from, to)) return 1;
    const arc_end first = make_end(q, o, from), last = make_end(q, o, to);
    take_in_plane(q, o, &first, 0);
    take_in_plane(q, o, &last, 0);
    return hold_arc(q, o, &first, &last, MOST_HALVES);
}

// In order from the first direction of a quarter to its last one.
static void add_break(const circle *o, plane_vector n, plane_vector *breaks, int *count) {
    if (!(o->side * cross2(breaks[0], n) > 0 && o->side * cross2(n, o->last) > 0)) return;
    int at = (*count)++;
    for (; at > 1 && o->side * cross2(n, breaks[at - 1]) > 0; at--) breaks[at] = breaks[at - 1];
    breaks[at] = n;
}

// The quarter between two axes of the box, with their signs.
static int hold_quarter(box_and_round *q, circle *o, double x, double y) {
    plane_vector breaks[6] = {{x, 0}};
    int count = 1;
    o->last = (plane_vector){0, y};
    o->corner = (plane_vector){x * q->half[o->i] - q->center[o->i], y * q->half[o->j] - q->center[o->j]};
    o->side = x * y;
    const double ahead = min2(x * o->corner.x, y * o->corner.y);
    if (ahead >= 0 && ahead + q->ball >= q->low) return 1;
    set_piece(q, o, breaks[0], breaks[0]);
    const arc_end first = make_end(q, o, breaks[0]);
    set_piece(q, o, o->last, o->last);
    const arc_end last = make_end(q, o, o->last);
    if (is_held(q, o, &first, &last)) return 1;
    for (int i = 0; i < o->breaks; i++) add_break(o, o->at[i], breaks, &count);
    breaks[count++] = o->last;
    for (int i = 1; i < count; i++)
        if (!hold_between(q, o, breaks[i - 1], breaks[i])) return 0;
    return 1;
}

static int hold_circle(box_and_round *q, circle *o) {
    for (int i = 0; i < 4; i++)
        if (!hold_quarter(q, o, i & 1 ? -1 : 1, i & 2 ? -1 : 1)) return 0;
    return 1;
}

static int search_circles(box_and_round *q) {
    circle circles[3];
    take_faces(q);
    for (int k = 0; k < 3; k++) {
        circles[k] = make_circle(q, k);
        for (int i = 2; i < circles[k].breaks; i++) {
            double n[3];
            n[circles[k].i] = circles[k].at[i].x, n[circles[k].j] = circles[k].at[i].y, n[k] = 0;
            take(q, measure(q, n), n, FREE_BOTH, k);
        }
    }
    take_corners(q);
    for (int k = 0; k < 3; k++)
        if (!(q->low > 0 && hold_circle(q, &circles[k]))) return 0;
    return q->low > 0;
}

// ---- the points

// The direction in the world, the overlap along it and its points. 0 if these are not found.
static int set_points(const cores *p, const box_and_round *q, least_overlap *at) {
    const int is_box_b = p->b->core == OVOID_SWEPT_BOX;
    const ovoid_swept_sphere *box = is_box_b ? p->b : p->a, *round = is_box_b ? p->a : p->b;
    const vec3 n = vec3_unit(patch_turn_back(box, (vec3){q->n[0], q->n[1], q->n[2]})),
               center = is_box_b ? vec3_neg(p->d) : p->d;
    at->of.n = is_box_b ? vec3_neg(n) : n;
    const overlap_ends ends = cores_find_ends(p, at->of.n);
    const vec3 on_edge = is_box_b ? ends.on_b : ends.on_a;
    vec3 on_round = is_box_b ? ends.on_a : ends.on_b;
    at->value = vec3_dot(at->of.n, ends.v);
    const vec3 opposite = vec3_sub(vec3_add_scaled(on_edge, n, -at->value), center);
    if (q->free == FREE_ROUND) on_round = opposite;
    if (q->free == FREE_BOTH)
        on_round =
            points_find_crossing(on_round, points_find_line(round, vec3_neg(n)), opposite, box->axis[q->edge], n);
    const vec3 between = vec3_add_scaled(center, n, at->value);
    vec3 on_box = q->free == FREE_ROUND ? on_edge : vec3_add(between, on_round);
    // Of an edge along a face, or of two faces, the farthest points are many.
    const double doubt = FRAME_REJECT * p->size;
    if (points_move_in(box, &on_box, doubt)) on_round = vec3_sub(on_box, between);
    if (points_move_in(round, &on_round, doubt)) on_box = vec3_add(between, on_round);
    at->on_a = is_box_b ? on_round : on_box;
    at->on_b = is_box_b ? on_box : on_round;
    return fabs(at->value - q->value) <= doubt && !points_move_in(box, &on_box, doubt);
}

int cores_have_circles(const cores *p) {
    const ovoid_swept_core a = p->a->core, b = p->b->core, other = a == OVOID_SWEPT_BOX ? b : a;
    return (a == OVOID_SWEPT_BOX || b == OVOID_SWEPT_BOX) &&
           (other == OVOID_SWEPT_CYLINDER || other == OVOID_SWEPT_CONE);
}

int cores_search_circles(const cores *p, double tolerance, least_overlap *at) {
    const int is_box_b = p->b->core == OVOID_SWEPT_BOX;
    const ovoid_swept_sphere *box = is_box_b ? p->b : p->a, *round = is_box_b ? p->a : p->b;
    const vec3 axis = patch_turn(box, round->axis[0]), center = patch_turn(box, is_box_b ? vec3_neg(p->d) : p->d);
    box_and_round q = {.half = box->half,
                       .axis = {axis.x, axis.y, axis.z},
                       .center = {center.x, center.y, center.z},
                       .height = round->half[0],
                       .radius = round->half[1],
                       .is_cone = round->core == OVOID_SWEPT_CONE,
                       .size = p->size,
                       .tolerance = tolerance,
                       .value = INFINITY};
    const double height = 2 * q.height, scale = 1 / sqrt(height * height + q.radius * q.radius);
    q.sine = q.is_cone ? q.radius * scale : 0;
    q.cosine = q.is_cone ? height * scale : 1;
    q.inside = q.is_cone ? q.height * q.sine : q.radius;
    q.ball = min2(q.height, q.inside);
    return search_circles(&q) && set_points(p, &q, at);
}
