// Theorem. Let b be the least half axis of an ellipsoid, and `reach` how far that goes along a unit direction from its
// centre. A ball of the radius r = b^2 / reach is in the ellipsoid and touches its farthest point along the direction
// (query/swept/overlap.c), so the overlap of the ellipsoid and a body X is nowhere less than that of X and this ball.
// Let a unit direction be c along an axis and s across it, to the side u, and let X reach p.n + R s along the
// directions n of a cell: p is a corner of a box, an end of a segment, the apex of a cone, or the middle of a rim of
// the radius R. With the ball's centre, from p, z along the axis and y across it, the overlap with the ball is
//   R s - z c - (y.u) s + r.
// A cell has the directions between two angles with the axis, less than a half turn apart, with u on an arc. With the
// greatest y.u of the arc in its place the sum without r is no more than before, and is f = A c + B s. For an angle x
// from the first end of a cell that is w wide, f = (f_0 sin(w - x) + f_w sin x) / sin w: where both ends are at least
// t, it is no less than t, or if that is below 0, than t / cos(w / 2). So a ball shows a cell by two products.
//
// The ball of a cell is that along its middle. Where it does not show the cell, this is halved across the longer side;
// tried before is the ball of the cell that it is a half of. Around local minima, where no ball does, the second
// derivatives do up to an angle (query/swept/descend.c): the least cosine of a cell with one is found in the same way.
// Other minima need few cells, since a ball is off by the square of a cell's size and has most of the curvature. Two
// ellipsoids have both balls, a point takes the place of X.
//
// Errors, in parts u s as in swept.c: the axes here are unit and at right angles to 32 u, angles of cells are those of
// cosines and sines of unit length to 4 u, the ends of neighbours are the same numbers, so the cells leave nothing out,
// and values are summed to 40 u s: below 100 u s. A ball is off as the ellipsoid's farthest point, by 16 u a^2 / b, a
// the greatest half axis: `doubt` is twice that. Cosines are off by 10 u; 16 are taken off.
#include "query/swept/ellipsoid_cells.h"

#include "query/swept/arcs.h"
#include "query/swept/pair.h"

// The most balls that a search asks for, the most times that a cell is halved, and the steps to a minimum on the side.
enum { MOST_BALLS = 300, MOST_HALVES = 18, MOST_STEPS = 8 };
// What rounding may leave open, as a part of the size.
#define MOST_DOUBT 3e-13
// A part across the axis that has no digits, and a slope that is none, as parts of the size; the longest step.
#define NO_DIGITS 0x1p-20
#define LEVEL 1e-10
#define LONGEST 0.5
// What is taken off a cosine.
#define COSINE_DOUBT (16 * 0x1p-53)
#define HALF_ROOT 0.70710678118654752440

static int is_ellipsoid(const ovoid_swept_sphere *s) { return s->core == OVOID_SWEPT_ELLIPSOID; }
static int is_body(const ovoid_swept_sphere *s) {
    return s->core >= OVOID_SWEPT_SEGMENT && s->core <= OVOID_SWEPT_ELLIPSOID;
}

int cores_have_ellipsoid_cells(const cores *p) {
    return (is_ellipsoid(p->a) && is_body(p->b)) || (is_ellipsoid(p->b) && is_body(p->a));
}

// ---- directions

static vec3 turn_out(const ellipsoid_cells *c, vec3 n) {
    const vec3 to =
        vec3_unit(vec3_add(vec3_add_scaled(vec3_scale(c->axis[0], n.x), c->axis[1], n.y), vec3_scale(c->axis[2], n.z)));
    return c->is_b ? vec3_neg(to) : to;
}
static vec3 turn_in(const ellipsoid_cells *c, vec3 v) {
    const vec3 from = c->is_b ? vec3_neg(v) : v;
    return (vec3){vec3_dot(c->axis[0], from), vec3_dot(c->axis[1], from), vec3_dot(c->axis[2], from)};
}

static double find_reach(const ellipsoid_cells *c, vec3 n) {
    const double *half = c->body->half;
    if (c->body->core == OVOID_SWEPT_BOX) return half[0] * fabs(n.x) + half[1] * fabs(n.y) + half[2] * fabs(n.z);
    const double end = c->height * n.x, rim = c->radius * sqrt(n.y * n.y + n.z * n.z);
    return c->body->core == OVOID_SWEPT_CONE ? max2(end, rim - end) : fabs(end) + rim;
}

// ---- where to begin

// A direction, what of the body is the farthest beside it, and the overlap along it.
typedef struct first_direction {
    vec3 n;
    double value;
} first_direction;

static void take_first(first_direction *best, vec3 n, double value) {
    if (value < best->value) *best = (first_direction){n, value};
}

// On the circle of the side's normals, from the one towards the ellipsoid, to a minimum.
static void try_side(const ellipsoid_cells *c, first_direction *best) {
    const double reach = find_reach(c, (vec3){c->sine, c->cosine, 0});
    plane_vector u = {1, 0};
    for (int i = 0; i < MOST_STEPS; i++) {
        const vec3 n = {c->sine, c->cosine * u.x, c->cosine * u.y}, t = {0, -n.z, n.y}, back = {0, -n.y, -n.z};
        const vec3 of_n = ellipsoid_apply_form(&c->form[0], n), of_t = ellipsoid_apply_form(&c->form[0], t);
        const double far = sqrt(vec3_dot(n, of_n)), scale = 1 / far, first = vec3_dot(t, of_n) * scale;
        const double value = reach + far - vec3_dot(c->center, n), slope = first - vec3_dot(c->center, t);
        take_first(best, n, value);
        if (fabs(slope) <= LEVEL * c->size) break;
        const double bend =
            (vec3_dot(t, of_t) + vec3_dot(back, of_n) - first * first) * scale - vec3_dot(c->center, back);
        const double step =
            bend > 0.05 * value ? max2(-LONGEST, min2(LONGEST, -slope / bend)) : -copysign(LONGEST, slope);
        u = unit2(u.x - step * u.y, u.y + step * u.x);
    }
}

// The part of a point of an end's plane that is beside the end.
static vec3 find_beside_end(const ellipsoid_cells *c, int axis, vec3 at) {
    const double *half = c->body->half, y[3] = {at.x, at.y, at.z};
    double beside[3] = {0, 0, 0};
    if (c->body->core != OVOID_SWEPT_BOX) {
        const double off = sqrt(y[1] * y[1] + y[2] * y[2]), part = off > c->radius ? 1 - c->radius / off : 0;
        return (vec3){0, part * y[1], part * y[2]};
    }
    for (int k = 0; k < 3; k++)
        if (k != axis) beside[k] = y[k] - max2(-half[k], min2(half[k], y[k]));
    return (vec3){beside[0], beside[1], beside[2]};
}

// Along a unit direction along an axis, to an end of the body; where the ellipsoid's deepest point is beside that, a
// step from there towards the minimum.
static void try_end(const ellipsoid_cells *c, int axis, vec3 n, first_direction *best) {
    const vec3 of_n = ellipsoid_apply_form(&c->form[0], n);
    const double far = sqrt(vec3_dot(n, of_n)), value = find_reach(c, n) + far - vec3_dot(c->center, n);
    const vec3 beside = find_beside_end(c, axis, vec3_add_scaled(c->center, of_n, -1 / far));
    const double off = vec3_norm(beside);
    if (!(off > 0)) {
        take_first(best, n, value);
        return;
    }
    const vec3 t = vec3_scale(beside, 1 / off);
    const double first = vec3_dot(t, of_n) / far,
                 bend = (vec3_dot(t, ellipsoid_apply_form(&c->form[0], t)) - first * first) / far - value;
    const vec3 m = vec3_unit(vec3_add_scaled(n, t, bend > 0.05 * value ? min2(LONGEST, off / bend) : LONGEST));
    take_first(best, m,
               find_reach(c, m) + sqrt(vec3_dot(m, ellipsoid_apply_form(&c->form[0], m))) - vec3_dot(c->center, m));
}

static void try_ends(const ellipsoid_cells *c, first_direction *best) {
    const double at[3] = {c->center.x, c->center.y, c->center.z};
    const int is_base = c->body->core == OVOID_SWEPT_CONE, axes = c->body->core == OVOID_SWEPT_BOX ? 3 : 1;
    for (int k = 0; k < axes; k++) {
        const double sign = is_base || at[k] < 0 ? -1 : 1;
        try_end(c, k, (vec3){k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0}, best);
    }
}

static void add_ellipsoid(ellipsoid_cells *to, const ovoid_swept_sphere *ellipsoid) {
    const double least = ellipsoid_find_least(ellipsoid);
    to->form[to->ellipsoids] = ellipsoid_make_form(ellipsoid, to->axis);
    to->least_square[to->ellipsoids++] = least * least;
}

// A body with an axis: the axes, and its numbers.
static void set_turned(ellipsoid_cells *to, vec3 d) {
    const ovoid_swept_sphere *s = to->body;
    const vec3 axis = s->axis[0], off = patch_find_across(axis, d, vec3_dot(axis, d), vec3_norm_squared(d));
    to->axis[0] = axis;
    to->axis[1] = vec3_norm(off) > NO_DIGITS * to->size ? vec3_unit(off) : vec3_orthogonal(axis);
    to->axis[2] = vec3_cross(axis, to->axis[1]);
    to->height = s->half[0];
    to->radius = s->core == OVOID_SWEPT_SEGMENT ? 0 : s->half[1];
    if (s->core != OVOID_SWEPT_CONE) return;
    const double scale = 1 / sqrt(4 * to->height * to->height + to->radius * to->radius);
    to->sine = to->radius * scale, to->cosine = 2 * to->height * scale;
}

// The axes of two ellipsoids, of which the rest is set where it is asked for.
static vec3 set_point(ellipsoid_cells *to, vec3 d) {
    const vec3 n = vec3_norm(d) > NO_DIGITS * to->size ? vec3_unit(d) : to->body->axis[0];
    const patch_plane of = patch_make_plane(n);
    to->axis[0] = n, to->axis[1] = of.e[0], to->axis[2] = of.e[1];
    to->doubt += ellipsoid_find_doubt(to->body);
    return to->is_b ? vec3_neg(n) : n;
}

double ellipsoid_cells_make(const cores *p, ellipsoid_cells *to, vec3 *n) {
    const int is_b = !is_ellipsoid(p->b);
    const vec3 d = is_b ? vec3_neg(p->d) : p->d;
    *to = (ellipsoid_cells){.is_b = is_b, .cosine = 1, .size = p->size};
    to->body = is_b ? p->b : p->a, to->ellipsoid = is_b ? p->a : p->b;
    to->doubt = ellipsoid_find_doubt(to->ellipsoid);
    if (is_ellipsoid(to->body)) {
        *n = set_point(to, d);
    } else if (to->body->core == OVOID_SWEPT_BOX) {
        for (int k = 0; k < 3; k++) to->axis[k] = to->body->axis[k];
    } else {
        set_turned(to, d);
    }
    to->center = (vec3){vec3_dot(to->axis[0], d), vec3_dot(to->axis[1], d), vec3_dot(to->axis[2], d)};
    if (!is_ellipsoid(to->body)) {
        first_direction best = {{1, 0, 0}, INFINITY};
        add_ellipsoid(to, to->ellipsoid);
        if (to->body->core != OVOID_SWEPT_BOX) try_side(to, &best);
        try_ends(to, &best);
        *n = turn_out(to, best.n);
    }
    return to->doubt <= MOST_DOUBT * p->size ? vec3_dot(*n, cores_find_ends(p, *n).v) : INFINITY;
}

// ---- cells

// Directions between two angles with the first axis, cosine and sine, which are on an arc around it.
typedef struct direction_cell {
    plane_vector along[2], around[2];
} direction_cell;

typedef struct inner_ball {
    beside_first at;
    double radius;
} inner_ball;

typedef struct cell_search {
    const ellipsoid_cells *of;
    vec3 point; ///< of the body, that it reaches to in the cell,
    double rim; ///< beside so much across the axis
    double wanted;
    int left;
    vec3 less; ///< a unit direction with less overlap, or none
} cell_search;

static beside_first make_beside(vec3 v) { return (beside_first){v.x, {v.y, v.z}, sqrt(v.y * v.y + v.z * v.z)}; }

// The most of what is across, along a direction of the cell's arc.
COMPILER_INLINED double find_most(const direction_cell *c, const beside_first *at) {
    const plane_vector across = {at->across[0], at->across[1]};
    const int is_within = cross2(c->around[0], across) >= 0 && cross2(across, c->around[1]) >= 0;
    return is_within ? at->off : max2(dot2(c->around[0], across), dot2(c->around[1], across));
}

static int is_held_by(const cell_search *s, const direction_cell *c, const inner_ball *ball) {
    const double across = s->rim - find_most(c, &ball->at), z = ball->at.along, left = s->wanted - ball->radius;
    const plane_vector a = c->along[0], b = c->along[1];
    return min2(across * a.y - z * a.x, across * b.y - z * b.x) >=
           (left < 0 ? left * 0.5 * (1 + dot2(a, b)) : left); // (1 + cos w) / 2 is no more than cos(w / 2)
}

// Is it within the angle around a minimum? The cosine is the reverse of the product with the reverse.
static int is_around_minimum(const cell_search *s, const direction_cell *c) {
    const plane_vector a = c->along[0], b = c->along[1];
    for (int i = 0; i < s->of->minima; i++) {
        const known_minimum *at = &s->of->minimum[i];
        const double most = find_most(c, &at->back), z = at->back.along;
        if (min2(-z * a.x - most * a.y, -z * b.x - most * b.y) >= at->cosine) return 1;
    }
    return 0;
}

// The ball along a unit direction, of two ellipsoids that of the difference body; and the overlap.
COMPILER_INLINED double make_ball(const cell_search *s, vec3 n, inner_ball *to) {
    const ellipsoid_cells *c = s->of;
    vec3 at = vec3_sub(c->center, s->point);
    double value = s->rim * sqrt(n.y * n.y + n.z * n.z) - vec3_dot(at, n);
    to->radius = 0;
    for (uint32_t i = 0; i < c->ellipsoids; i++) {
        const vec3 of_n = ellipsoid_apply_form(&c->form[i], n);
        const double far = sqrt(vec3_dot(n, of_n)), scale = 1 / far;
        to->radius += c->least_square[i] * scale;
        at = vec3_add_scaled(at, of_n, -scale);
        value += far;
    }
    to->at = make_beside(vec3_add_scaled(at, n, to->radius));
    return value;
}

static plane_vector find_middle(const plane_vector end[2]) { return unit2(end[0].x + end[1].x, end[0].y + end[1].y); }

// Halves a cell, across the longer side.
static void halve(const direction_cell *c, plane_vector along, plane_vector around, direction_cell half[2]) {
    const double across = max2(along.y, max2(c->along[0].y, c->along[1].y)),
                 wide = across * across * (1 - dot2(c->around[0], c->around[1]));
    half[0] = half[1] = *c;
    if (1 - dot2(c->along[0], c->along[1]) > wide)
        half[0].along[1] = half[1].along[0] = along;
    else
        half[0].around[1] = half[1].around[0] = around;
}

// known: a ball of the ellipsoid; left: how many times the cell may be halved.
// NOLINTNEXTLINE(misc-no-recursion): no cell is halved more than MOST_HALVES times
static int hold_cell(cell_search *s, const direction_cell *c, const inner_ball *known, int left) {
    if (is_held_by(s, c, known) || is_around_minimum(s, c)) return 1;
    if (s->left-- <= 0) return 0;
    const plane_vector along = find_middle(c->along), around = find_middle(c->around);
    const vec3 n = {along.x, along.y * around.x, along.y * around.y};
    inner_ball ball;
    const double value = make_ball(s, n, &ball);
    if (value >= s->wanted && is_held_by(s, c, &ball)) return 1;
    // A small cell is open where the overlap is less nearby.
    if (!(value >= s->wanted) || left == 0) {
        s->less = n;
        return 0;
    }
    direction_cell half[2];
    halve(c, along, around, half);
    return hold_cell(s, &half[0], &ball, left - 1) && hold_cell(s, &half[1], &ball, left - 1);
}

// The directions above or below the side, in a quarter around the axis: a corner of a box, or of others, of which one
// quarter is around the second axis, a half of the body.
static int hold_part(cell_search *s, vec3 first, int is_down, int quarter) {
    static const plane_vector sides[2][5] = {{{HALF_ROOT, -HALF_ROOT},
                                              {HALF_ROOT, HALF_ROOT},
                                              {-HALF_ROOT, HALF_ROOT},
                                              {-HALF_ROOT, -HALF_ROOT},
                                              {HALF_ROOT, -HALF_ROOT}},
                                             {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}}};
    const ellipsoid_cells *c = s->of;
    const int is_box = c->body->core == OVOID_SWEPT_BOX;
    const plane_vector end = {is_down ? -1 : 1, 0}, side = {c->sine, c->cosine};
    const direction_cell cell = {{is_down ? side : end, is_down ? end : side},
                                 {sides[is_box][quarter], sides[is_box][quarter + 1]}};
    const double *half = c->body->half;
    inner_ball ball;
    s->point = (vec3){is_down ? -c->height : c->height, 0, 0};
    s->rim = c->body->core == OVOID_SWEPT_CONE && !is_down ? 0 : c->radius;
    if (is_box) {
        s->point.x = is_down ? -half[0] : half[0];
        s->point.y = quarter == 0 || quarter == 3 ? half[1] : -half[1];
        s->point.z = quarter < 2 ? half[2] : -half[2];
    }
    make_ball(s, first, &ball);
    return hold_cell(s, &cell, &ball, MOST_HALVES);
}

static void add_minimum(ellipsoid_cells *c, vec3 n, double tangent) {
    if (!(tangent > 0) || c->minima == KNOWN_MINIMA) return;
    const double cosine = 1 / sqrt(1 + tangent * tangent) + COSINE_DOUBT;
    c->minimum[c->minima++] = (known_minimum){make_beside(vec3_neg(n)), cosine};
}

int ellipsoid_cells_hold(ellipsoid_cells *c, const least_overlap *at, double wanted, vec3 *less) {
    const vec3 n = turn_in(c, at->of.n);
    if (c->ellipsoids == 0) {
        add_ellipsoid(c, c->body);
        add_ellipsoid(c, c->ellipsoid);
    }
    add_minimum(c, n, least_overlap_find_angle(at, wanted));
    cell_search s = {.of = c, .wanted = wanted, .left = MOST_BALLS};
    int is_held = 1;
    for (int i = 0; i < 8 && is_held; i++) is_held = hold_part(&s, n, i & 1, i >> 1);
    *less = vec3_norm_squared(s.less) > 0 ? turn_out(c, s.less) : s.less;
    return is_held;
}
