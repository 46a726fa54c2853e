// The gradient of the distance of cylinders and cones themselves, which shapes hold by polyhedra with an allowance.
//
// The answer's points are those of the polyhedra. From them the points of the true bodies are found: the polyhedron's
// nearest feature to a point of the round body (an exact query of a point), then the point of the round body that is
// nearest to that feature, in closed form for a vertex and a face, by halving along an edge, where the distance from a
// convex body is convex; and so on until the feature stays. Of two round bodies each is nearest to the other's point in
// turn; the axis of a cylinder that is met at its side is an edge. Whatever these searches do, the result is proven:
// the supports' gap along the direction n that was found, in closed form, is below the distance, and the distance of
// the two points above it. So the exact normal is within acos(lower / upper) of n, as for polyhedra.
//
// Are the points unique? Those of one body are, if for all directions within that angle of n its support is one point;
// then so are the other's, as their difference is. At the rim of a base, off n's angles to the axis and to the base (of
// a cone also to its side), the support point is the rim's point along n; it turns by the angle over the sine of n to
// the axis. At a polyhedron's vertex or a cone's apex it stays. Where neither is such, a cylinder's side is a line with
// a radius: where another such line or an edge crosses it, they fall away from each other by the slope that they have
// as edges.
//
// Cost: some queries of a point, 1 to 10 microseconds.
#include "pair/balls.h"
#include "query/answer.h"
#include "shape/point.h"
#include "smooth/gradient.h"

#define ROUNDING 0x1p-53

enum { ROUNDS = 8, TURNS = 200, HALVINGS = 80 };

/// A body in the world's axes, from the body frame of A.
typedef struct round_body {
    const ovoid_shape *shape;
    ovoid_round form; ///< OVOID_ROUND_NONE: the polyhedron
    ovoid_pose pose;
    mat3 rotation;
    vec3 base;         ///< the origin of the body frame
    vec3 center, axis; ///< of the round body
} round_body;

/// A point of the round body, the nearest of the other body, and what holds that.
typedef struct nearest {
    vec3 p, q;
    vec3 n;       ///< unit, from p to q
    double upper; ///< of the distance
    feature of_q; ///< of a polyhedron; its vertices alone
} nearest;

static vec3 get_axis(const mat3 *m) { return (vec3){m->r0.z, m->r1.z, m->r2.z}; }

static round_body make_body(const ovoid_shape *shape, const mat3 *rotation, ovoid_quat turn, vec3 base) {
    round_body b = {.shape = shape, .form = shape->round, .rotation = *rotation, .base = base};
    vec3 origin = shape->has_origin ? mat3_mul_vec3(*rotation, shape->origin) : (vec3){0, 0, 0};
    b.center = vec3_sub(base, origin);
    b.axis = get_axis(rotation);
    b.pose = (ovoid_pose){b.center, turn};
    return b;
}

// ---- round bodies in closed form

// The support along the unit n, and its point.
static double find_round_support(const round_body *b, vec3 n, vec3 *point) {
    double along = vec3_dot(n, b->axis), half = b->form.half_length;
    vec3 across = vec3_add_scaled(n, b->axis, -along);
    double length = vec3_norm(across), rim = b->form.radius * length, end = along < 0 ? -half : half;
    if (b->form.kind == OVOID_ROUND_CONE) {
        end = half * along >= rim - half * along ? half : -half;
        if (end > 0) rim = 0;
    }
    *point = vec3_add_scaled(b->center, b->axis, end);
    if (rim > 0) *point = vec3_add_scaled(*point, across, b->form.radius / length);
    return (vec3_dot(n, b->center) + end * along) + rim;
}

// The nearest point to one outside.
static vec3 find_round_point(const round_body *b, vec3 x) {
    vec3 v = vec3_sub(x, b->center);
    double z = vec3_dot(v, b->axis), radius = b->form.radius, half = b->form.half_length;
    vec3 across = vec3_add_scaled(v, b->axis, -z);
    double off = vec3_norm(across), to = min2(off, radius), at = max2(-half, min2(z, half));
    if (b->form.kind == OVOID_ROUND_CONE) {
        // In the half plane through the axis: the base, or the side.
        double t = ((radius - off) * radius + (z + half) * (2 * half)) / (radius * radius + 4 * half * half);
        t = max2(0, min2(t, 1));
        double side_off = radius * (1 - t), side_at = half * (2 * t - 1);
        double from_side = (off - side_off) * (off - side_off) + (z - side_at) * (z - side_at);
        double from_base = (off - to) * (off - to) + (z + half) * (z + half);
        at = from_side < from_base ? side_at : -half;
        to = from_side < from_base ? side_off : to;
    }
    vec3 point = vec3_add_scaled(b->center, b->axis, at);
    return off > 0 ? vec3_add_scaled(point, across, to / off) : point;
}

static double find_support(const round_body *b, vec3 n) {
    vec3 point;
    if (b->form.kind != OVOID_ROUND_NONE) return find_round_support(b, n, &point);
    return vec3_dot(n, b->base) + shape_find_extreme(b->shape, mat3_mul_transposed_vec3(b->rotation, n)).value;
}

static vec3 find_vertex(const round_body *b, uint32_t v) {
    return vec3_add(b->base, mat3_mul_vec3(b->rotation, vec3_at(shape_vertices(b->shape), v)));
}

// ---- a round body and a polyhedron

// The polyhedron's nearest point to x->p, and its feature. 0 where there is none.
static int ask_point(const round_body *hull, nearest *result) {
    point_shape point;
    point_make(&point, 0);
    const ovoid_pair pair = {&point.shape, hull->shape, {result->p, {1, 0, 0, 0}}, hull->pose};
    const ovoid_options options = {.relative_tolerance = 1e-14};
    ovoid_answer found;
    const query_goal goal = query_goal_make_distance(&options);
    answer_find_internal(&pair, &(query_request){.options = &options, .goal = &goal}, &found);
    const ovoid_proof *proof = &found.proof;
    if (proof->kind != OVOID_PROOF_POINTS || !proof->count) return 0;
    result->of_q =
        feature_make(hull->shape, (vec3){0, 0, 0}, (weighted_vertices){proof->b, proof->weight_b, proof->count});
    result->q = vec3_add(hull->base, mat3_mul_vec3(hull->rotation, result->of_q.point));
    result->upper = vec3_norm(vec3_sub(result->q, result->p));
    return result->upper > 0;
}

// The nearest points of a round body and an edge: halving on where the way to the body is across the edge.
static void solve_edge(const round_body *round, vec3 from, vec3 to, nearest *found) {
    vec3 e = vec3_sub(to, from);
    double low = 0, high = 1;
    for (int i = 0; i < HALVINGS; i++) {
        double t = low + 0.5 * (high - low);
        if (!(t > low && t < high)) break;
        found->q = vec3_add_scaled(from, e, t);
        found->p = find_round_point(round, found->q);
        if (vec3_dot(vec3_sub(found->q, found->p), e) < 0)
            low = t;
        else
            high = t;
    }
}

// The nearest points of the round body and the feature.
static void solve_feature(const round_body *round, const round_body *hull, nearest *found) {
    const uint32_t *v = found->of_q.v;
    vec3 first = find_vertex(hull, v[0]);
    if (found->of_q.count >= 3) {
        vec3 n =
            vec3_unit(vec3_cross(vec3_sub(find_vertex(hull, v[1]), first), vec3_sub(find_vertex(hull, v[2]), first)));
        if (vec3_dot(n, vec3_sub(first, found->p)) < 0) n = vec3_neg(n);
        (void)find_round_support(round, n, &found->p);
        found->n = n;
        return;
    }
    if (found->of_q.count == 2)
        solve_edge(round, first, find_vertex(hull, v[1]), found);
    else
        found->p = find_round_point(round, found->q = first);
    found->n = vec3_unit(vec3_sub(found->q, found->p));
}

static int has_same_feature(const feature *a, const feature *b) {
    if (a->count != b->count) return 0;
    for (int i = 0; i < a->count; i++)
        if (a->v[i] != b->v[i] && (a->count < 2 || a->v[i] != b->v[(i + 1) % a->count])) return 0;
    return 1;
}

// From a point q of the polyhedron.
static int find_with_hull(const round_body *round, const round_body *hull, vec3 q, nearest *found) {
    found->p = find_round_point(round, q);
    for (int i = 0; i < ROUNDS; i++) {
        feature before = found->of_q;
        if (!ask_point(hull, found)) return 0;
        if (i > 0 && has_same_feature(&before, &found->of_q)) return 1;
        solve_feature(round, hull, found);
    }
    return 1;
}

// ---- two round bodies

// From the axis of a cylinder, which is an edge with a radius where the points are on its side; 0 where they are not.
static int find_from_axis(const round_body *a, const round_body *b, nearest *found) {
    vec3 end = vec3_scale(b->axis, b->form.half_length);
    if (b->form.kind != OVOID_ROUND_CYLINDER || !(fabs(vec3_dot(found->n, b->axis)) < 0.25)) return 0;
    nearest y = *found;
    solve_edge(a, vec3_sub(b->center, end), vec3_add(b->center, end), &y);
    y.n = vec3_unit(vec3_sub(y.q, y.p));
    y.q = find_round_point(b, y.p);
    y.upper = vec3_norm(vec3_sub(y.q, y.p));
    if (!(fabs(vec3_dot(y.n, b->axis)) < 0x1p-40) || !(y.upper < found->upper * (1 + 0x1p-40))) return 0;
    *found = y;
    return 1;
}

static int find_with_round(const round_body *a, const round_body *b, vec3 q, nearest *found) {
    found->q = q;
    found->of_q.count = 0;
    for (int i = 0; i < TURNS; i++) {
        vec3 before = found->q;
        found->p = find_round_point(a, found->q);
        found->q = find_round_point(b, found->p);
        if (!(vec3_max_abs(vec3_sub(before, found->q)) > 0)) break;
    }
    vec3 w = vec3_sub(found->q, found->p);
    found->upper = vec3_norm(w);
    found->n = vec3_unit(w);
    if (!(found->upper > 0)) return 0;
    if (find_from_axis(a, b, found)) return 1;
    nearest y = {.p = found->q, .q = found->p, .n = vec3_neg(found->n), .upper = found->upper};
    if (find_from_axis(b, a, &y)) {
        found->p = y.q;
        found->q = y.p;
        found->n = vec3_neg(y.n);
        found->upper = y.upper;
    }
    return 1;
}

// ---- what is shown

/// How far a body's support point for directions within `turn` of n may be from the one of n; infinity where it may not
/// be one point. *angle: how far n is from directions of several points, at least.
static double find_round_slide(const round_body *b, vec3 n, double turn, double *angle) {
    double along = vec3_dot(n, b->axis), across = vec3_norm(vec3_cross(n, b->axis));
    double radius = b->form.radius, half = b->form.half_length;
    // Sines of angles are below the angles: to the axis, and to the base plane or the cone's side.
    *angle = min2(across, fabs(along));
    if (b->form.kind == OVOID_ROUND_CONE) {
        double side = (2 * half * along - radius * across) / sqrt(4 * half * half + radius * radius);
        *angle = fabs(side);
        if (side > turn + 64 * ROUNDING) return 0;
        *angle = min2(*angle, across);
    }
    if (!(*angle > 2 * turn + 64 * ROUNDING)) return INFINITY;
    return radius * turn / (across - turn);
}

// How far a point may slide, and by which slope it is held there, as in ovoid_gradient.
typedef struct sliding {
    double slide, slope;
} sliding;

static sliding find_slide(const round_body *b, const nearest *found, vec3 n, double turn) {
    sliding s;
    if (b->form.kind != OVOID_ROUND_NONE) {
        s.slide = find_round_slide(b, n, turn, &s.slope);
        return s;
    }
    const double weight[OVOID_PROOF_PAIRS] = {1, 1, 1, 1, 1, 1};
    const weighted_vertices all = {found->of_q.v, weight, (uint32_t)found->of_q.count};
    feature f = feature_make(b->shape, mat3_mul_transposed_vec3(b->rotation, n), all);
    s.slope = f.count == 1 ? min2(f.slope, 1) : 0;
    s.slide = s.slope > 2 * turn + 256 * ROUNDING ? 0 : INFINITY;
    return s;
}

// The room along a cylinder's side to its ends, of a point with the normal n there; below zero where it is not there.
static double find_room(const round_body *b, vec3 n, vec3 point, double turn) {
    if (b->form.kind != OVOID_ROUND_CYLINDER || !(fabs(vec3_dot(n, b->axis)) <= turn + 64 * ROUNDING)) return -1;
    return b->form.half_length - fabs(vec3_dot(vec3_sub(point, b->center), b->axis));
}

// The side of a cylinder that crosses an edge, or another cylinder's side: the slope by which they fall away from each
// other, else 0. *room: how far the points may be moved along them.
static double find_crossing(const round_body bodies[2], const nearest *found, double turn, double *room) {
    const round_body *other = &bodies[1];
    *room = find_room(&bodies[0], found->n, found->p, turn);
    if (other->form.kind != OVOID_ROUND_NONE) {
        *room = min2(*room, find_room(other, found->n, found->q, turn));
        return vec3_norm(vec3_cross(other->axis, bodies[0].axis));
    }
    if (found->of_q.count != 2) return 0;
    const double weight[2] = {1, 1};
    vec3 n = mat3_mul_transposed_vec3(other->rotation, vec3_neg(found->n));
    feature f = feature_make(other->shape, n, (weighted_vertices){found->of_q.v, weight, 2});
    return min2(f.slope, 1) * vec3_norm(vec3_cross(mat3_mul_vec3(other->rotation, f.edge), bodies[0].axis));
}

// What is not known of a distance: the angle that its normal may be off by, the bracket's width, and how far the points
// may be off the normal.
typedef struct doubt {
    double turn, excess, off;
} doubt;

// Of the first body, which is round, and the second.
static sliding find_points(const round_body bodies[2], const nearest *found, const doubt *d) {
    double turn = d->turn;
    sliding least = {INFINITY, 0};
    for (int k = 0; k < 2; k++) {
        sliding own = find_slide(&bodies[k], found, k ? vec3_neg(found->n) : found->n, turn);
        if (own.slide + d->off < least.slide) least = (sliding){own.slide + d->off, own.slope};
    }
    if (least.slide < INFINITY) return least;
    double room, cross = find_crossing(bodies, found, turn, &room);
    if (!(cross > 2 * turn + 256 * ROUNDING) || !((d->excess + d->off) / cross < room)) return least;
    return (sliding){(d->excess + d->off) / cross, cross};
}

// The second body's point in its body frame, to begin with.
static vec3 find_start(const pair_frame *f, const ovoid_proof *proof, int is_swapped) {
    if (proof->kind == OVOID_PROOF_BALLS) {
        ball_centers c = balls_find_centers(f, proof);
        return is_swapped ? c.a : c.b;
    }
    weighted_vertices of_a = {proof->a, proof->weight_a, proof->count},
                      of_b = {proof->b, proof->weight_b, proof->count};
    return is_swapped ? feature_make(f->a, (vec3){0, 0, 0}, of_a).point
                      : feature_make(f->b, (vec3){0, 0, 0}, of_b).point;
}

void gradient_refine_round(const pair_frame *f, const ovoid_pair *pair, const ovoid_proof *proof, ovoid_gradient *out) {
    const ovoid_shape *shapes[2] = {f->a, f->b};
    for (int k = 0; k < 2; k++)
        if ((shapes[k]->has_allowance && !shape_is_round(shapes[k])) || shape_is_ellipsoid(shapes[k])) return;
    // The first body is round.
    int is_swapped = !shape_is_round(f->a);
    round_body bodies[2];
    bodies[is_swapped] = make_body(f->a, &f->world, pair->pose_a.rotation, (vec3){0, 0, 0});
    bodies[!is_swapped] = make_body(f->b, &f->world_b, pair->pose_b.rotation, f->offset);
    nearest found = {.upper = 0};
    vec3 q = vec3_add(bodies[1].base, mat3_mul_vec3(bodies[1].rotation, find_start(f, proof, is_swapped)));
    int is_found = bodies[1].form.kind == OVOID_ROUND_NONE ? find_with_hull(&bodies[0], &bodies[1], q, &found)
                                                           : find_with_round(&bodies[0], &bodies[1], q, &found);
    if (!is_found || !(vec3_norm_squared(found.n) > 0.5)) return;

    double gap = -find_support(&bodies[1], vec3_neg(found.n)) - find_support(&bodies[0], found.n);
    double lower = gap - 2 * f->check, upper = found.upper + 2 * f->check;
    if (!(lower > 0)) return;
    const doubt d = {gradient_find_angle_above((upper - lower) / upper), upper - lower,
                     sqrt(max2((upper - lower) * (upper + lower), 0))};
    // A direction that is nearly as good is taken: its points are known.
    if (!(d.turn < 2 * out->turn)) return;
    sliding points = find_points(bodies, &found, &d);
    vec3 n = is_swapped ? vec3_neg(found.n) : found.n, to_p = vec3_sub(found.p, bodies[0].base),
         to_q = vec3_sub(found.q, bodies[1].base);
    gradient_put(f, n, is_swapped ? to_q : to_p, is_swapped ? to_p : to_q, out);
    out->turn = d.turn;
    out->margin = INFINITY;
    out->slope = min2(points.slope, 1);
    out->slide = points.slide;
    out->has_translation = 1;
    out->has_rotation = points.slide < INFINITY;
}
