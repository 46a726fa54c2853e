// The directions of discs, of sides and of sides that cross: four of five least overlaps of two cylinders or cones are
// along one of them, as the theorem of query/swept/circles.c says of those with a box, and not where a rim meets a rim.
// They begin a descent (query/swept/descend.c), and prove nothing.
//
// Each is measured by a few products of the axes and the way between the centres.
#include "query/swept/sides.h"

enum { STEPS = 2 };
// A slope that is none, as a part of the reach.
#define LEVEL 1e-9
// Normals of a side are looked at in the direction to the other body, and on by that many radians.
#define APART 0.7

// A cylinder or a cone X beside another one, Y, with directions outward from X; e are those across X's axis that look
// to Y and to its left.
typedef struct side {
    const ovoid_swept_sphere *x, *y;
    int is_x_b;
    vec3 e[2];
    double sine, cosine;   ///< of the side's normals, along the axis and across it
    double reach;          ///< of X along them
    double ahead, off;     ///< of Y's centre: along X's axis, and from it
    double along, of_e[2]; ///< of Y's axis: along X's, and along e
} side;

typedef struct found_overlap {
    vec3 n;
    double value;
} found_overlap;

static int is_round(const ovoid_swept_sphere *s) {
    return s->core == OVOID_SWEPT_CYLINDER || s->core == OVOID_SWEPT_CONE;
}

static side make_side(const cores *p, int is_x_b) {
    const ovoid_swept_sphere *x = is_x_b ? p->b : p->a, *y = is_x_b ? p->a : p->b;
    const vec3 axis = x->axis[0], d = is_x_b ? vec3_neg(p->d) : p->d;
    const double h = x->half[0], r = x->half[1];
    side s = {.x = x, .y = y, .is_x_b = is_x_b, .cosine = 1, .reach = r, .ahead = vec3_dot(axis, d)};
    if (x->core == OVOID_SWEPT_CONE) {
        const double scale = 1 / sqrt(4 * h * h + r * r);
        s.sine = r * scale, s.cosine = 2 * h * scale;
        s.reach = h * s.sine;
    }
    const vec3 off = vec3_add_scaled(d, axis, -s.ahead);
    s.off = vec3_norm(off);
    s.e[0] = s.off > 0 ? vec3_scale(off, 1 / s.off) : vec3_orthogonal(axis);
    s.e[1] = vec3_cross(axis, s.e[0]);
    s.along = vec3_dot(axis, y->axis[0]);
    for (int i = 0; i < 2; i++) s.of_e[i] = vec3_dot(s.e[i], y->axis[0]);
    return s;
}

static void take(const side *s, vec3 m, double value, found_overlap *to) {
    if (!(value < to->value)) return;
    to->value = value;
    to->n = s->is_x_b ? vec3_neg(m) : m;
}

// How far a body reaches along a unit direction by the cosine of that with its axis, and the slope by the cosine.
static double find_reach(const ovoid_swept_sphere *s, double cosine, double *slope) {
    const double h = s->half[0], r = s->half[1], across = sqrt(max2(0, 1 - cosine * cosine)),
                 rim = across > 0 ? -r * cosine / across : 0;
    const int is_cone = s->core == OVOID_SWEPT_CONE, is_apex = is_cone && 2 * h * cosine >= r * across;
    const double along = is_cone ? (is_apex ? h : -h) : copysign(h, cosine);
    *slope = along + (is_apex ? 0 : rim);
    return along * cosine + (is_apex ? 0 : r * across);
}

// The disc that looks to Y; a cone has one at its base.
static void try_disc(const side *s, found_overlap *to) {
    const double sign = s->x->core == OVOID_SWEPT_CONE || s->ahead < 0 ? -1 : 1;
    double slope;
    const double of_y = find_reach(s->y, -sign * s->along, &slope);
    take(s, vec3_scale(s->x->axis[0], sign), s->x->half[0] - sign * s->ahead + of_y, to);
}

// A normal of the side: as a direction across the axis, the overlap along it, and the slope of that around the axis.
typedef struct side_normal {
    double x, y;
    double value, slope;
} side_normal;

static side_normal measure(const side *s, double x, double y) {
    const double cosine = -(s->cosine * (x * s->of_e[0] + y * s->of_e[1]) + s->sine * s->along),
                 turned = -s->cosine * (x * s->of_e[1] - y * s->of_e[0]);
    double slope;
    const double of_y = find_reach(s->y, cosine, &slope);
    return (side_normal){x, y, s->reach + of_y - (s->cosine * x * s->off + s->sine * s->ahead),
                         slope * turned + s->cosine * y * s->off};
}

static void take_normal(const side *s, const side_normal *at, found_overlap *to) {
    const vec3 across = vec3_add_scaled(vec3_scale(s->e[0], at->x), s->e[1], at->y);
    take(s, vec3_add_scaled(vec3_scale(across, s->cosine), s->x->axis[0], s->sine), at->value, to);
}

// The next one on a side.
static side_normal go_on(const side *s, const side_normal *from, double turn) {
    static const double cosine = 0.76484218728448842, sine = 0.64421768723769102;
    return measure(s, cosine * from->x - turn * sine * from->y, cosine * from->y + turn * sine * from->x);
}

// The least overlap along the side's normals around the direction to Y: the slope's zero by secants through two of
// them, between which it is, unless tangents show that it is not less than another overlap.
static void try_side(const side *s, found_overlap *to) {
    side_normal low = measure(s, 1, 0), high = low;
    const double turn = low.slope > 0 ? -1 : 1;
    for (int k = 0; k < 2 && low.slope * turn < 0; k++) {
        high = low;
        low = go_on(s, &high, turn);
    }
    side_normal best = low.value < high.value ? low : high;
    const double bend = fabs(low.slope) + fabs(high.slope);
    const double tangents =
        fabs(low.slope) * high.value + fabs(high.slope) * low.value - APART * fabs(low.slope * high.slope);
    for (int k = 0; k < STEPS && low.slope * turn > 0 && tangents < to->value * bend; k++) {
        const double u = fabs(high.slope), v = fabs(low.slope), x = u * low.x + v * high.x, y = u * low.y + v * high.y,
                     scale = 1 / sqrt(x * x + y * y);
        const side_normal next = measure(s, x * scale, y * scale);
        if (next.value < best.value) best = next;
        if (fabs(next.slope) < LEVEL * s->reach) break;
        *(next.slope * turn > 0 ? &low : &high) = next;
    }
    take_normal(s, &best, to);
}

// Where both sides have a line of farthest points: n.a is A's sine and -n.b B's.
static void try_crossing(const side *a, const side *b, vec3 d, found_overlap *to) {
    const double c = a->along, left = 1 - c * c;
    if (!(left > 1e-6)) return;
    const double x = (a->sine + c * b->sine) / left, y = -(b->sine + c * a->sine) / left,
                 square = (1 - (x * x + y * y + 2 * x * y * c)) / left;
    if (!(square >= 0)) return;
    const vec3 across = vec3_cross(a->x->axis[0], b->x->axis[0]);
    const double out = copysign(sqrt(square), vec3_dot(across, d));
    const vec3 flat = vec3_add_scaled(vec3_scale(a->x->axis[0], x), b->x->axis[0], y),
               n = vec3_add_scaled(flat, across, out);
    take(a, n, a->reach + b->reach - vec3_dot(n, d), to);
}

int cores_have_sides(const cores *p) { return is_round(p->a) && is_round(p->b); }

double cores_try_sides(const cores *p, vec3 *n) {
    found_overlap found = {{0, 0, 0}, INFINITY};
    const side a = make_side(p, 0), b = make_side(p, 1);
    try_disc(&a, &found);
    try_disc(&b, &found);
    try_crossing(&a, &b, p->d, &found);
    try_side(&a, &found);
    try_side(&b, &found);
    *n = found.n;
    return found.value;
}
