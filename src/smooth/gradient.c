// The gradient of the exact signed distance from an answer, and whether it exists. docs/smooth.md derives it.
//
// d is the largest gap of the supports over all directions. Where the direction n is unique, the derivative by a
// translation of B is n; where the witness points are unique too, that by a rotation is the torque of n at them (J. M.
// Danskin, The theory of max-min and its application to weapons allocation problems, 1967).
//
// Is n unique? For bodies apart always, and with lower <= d <= upper of the hulls the cosine between n and the exact
// normal is at least lower / upper. For a depth the cover decides: of its triangles those on the plane n.w = depth are
// one face; if all others are farther from the origin than the depth, the exact direction lies over these triangles,
// and is as near to n as they are to the plane.
//
// Are the points unique? Each body is a cone at its point, by the edges of the vertices there. Over a tangential step u
// it falls away by sa(u), sb(u) >= 0, and the points can move along together where both are zero. These are bounded
// from below: at a vertex by the least slope of its edges; at an edge by the slope across it, so that two edges at the
// angle psi leave the lesser slope times sin psi; on a face by 0. Rounding and the turn of n are subtracted first.
//
// Of shapes with an allowance the gradient is that of the true bodies: their normal is bounded by their own bracket in
// the same way, which holds for any convex bodies; their points are not known.
#include "smooth/gradient.h"
#include "base/environment.h"
#include "base/error.h"
#include "pair/cover.h"
#include "pair/proof.h"

static const double rounding = 0x1p-53;

// The vertices of positive weight, and their mean.
static void take_vertices(feature *own, const uint32_t *index, const double *weight, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) sum += weight[i];
    own->count = 0;
    own->point = (vec3){0, 0, 0};
    for (uint32_t i = 0; i < count; i++) {
        own->point = vec3_add_scaled(own->point, shape_get_vertex(own->shape, index[i]), weight[i] / sum);
        int is_known = !(weight[i] > 0x1p-40 * sum);
        for (int k = 0; k < own->count; k++) is_known |= own->v[k] == index[i];
        if (!is_known) own->v[own->count++] = index[i];
    }
}

static int has_vertex(const feature *own, uint32_t v) {
    for (int k = 0; k < own->count; k++)
        if (own->v[k] == v) return 1;
    return 0;
}

// The least slope of the edges that leave the feature, across the edge where it is one; infinity where no edge leaves
// it.
static double find_slope(const feature *own) {
    const char *block = (const char *)own->shape;
    const uint32_t *starts = (const uint32_t *)(block + own->shape->at.neighbor_starts);
    const uint32_t *neighbors = (const uint32_t *)(block + own->shape->at.neighbors);
    double least = INFINITY; // its square
    for (int k = 0; k < own->count; k++) {
        vec3 corner = vec3_at(shape_vertices(own->shape), own->v[k]);
        for (uint32_t i = starts[own->v[k]]; i < starts[own->v[k] + 1]; i++) {
            if (has_vertex(own, neighbors[i])) continue;
            vec3 e = vec3_sub(vec3_at(shape_vertices(own->shape), neighbors[i]), corner);
            double fall = -vec3_dot(own->n, e) - 8 * rounding * own->shape->extent;
            vec3 t = vec3_add_scaled(e, own->n, -vec3_dot(own->n, e));
            if (own->count == 2) t = vec3_add_scaled(t, own->edge, -vec3_dot(own->edge, t));
            double run = vec3_norm_squared(t);
            if (!(fall > 0)) return 0;
            if (run > 0) least = min2(least, fall * fall / run);
        }
    }
    return sqrt(least);
}

feature feature_make(const ovoid_shape *shape, vec3 n, weighted_vertices of) {
    feature own = {.shape = shape, .n = n};
    take_vertices(&own, of.index, of.weight, of.count);
    if (shape_is_round(shape)) return own;
    if (own.count == 2) {
        vec3 e = vec3_sub(vec3_at(shape_vertices(shape), own.v[1]), vec3_at(shape_vertices(shape), own.v[0]));
        own.edge = vec3_unit(vec3_add_scaled(e, n, -vec3_dot(n, e)));
    }
    own.slope = own.count <= 2 ? find_slope(&own) : 0;
    return own;
}

// The least slope by which the two bodies fall away from each other.
static double join_slopes(const pair_frame *f, const feature *a, const feature *b) {
    if (a->count + b->count == 4 && a->count == 2) {
        vec3 across = vec3_cross(mat3_mul_vec3(f->world, a->edge), mat3_mul_vec3(f->world_b, b->edge));
        return min2(min2(a->slope, b->slope), 1) * vec3_norm(across);
    }
    if (a->count == 1 && b->count == 1) return a->slope + b->slope;
    if (a->count == 1) return a->slope;
    return b->count == 1 ? b->slope : 0;
}

// 1 if the triangles are of the surface's points.
static int has_points(const surface *s) {
    for (uint32_t t = 0; t < s->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (s->triangles[t][k] >= s->point_count) return 0;
    return s->triangle_count > 0;
}

// For a depth of the hulls between `least` and `most`: which of the cover's triangles lie on the plane across n (frame
// of A), and by how much (*margin) they are nearer than all others. Returns one less the cosine of the turn.
static double judge_depth(const pair_frame *f, const ovoid_cover *cover, vec3 n, double least, double most,
                          double *margin) {
    vec3 w[OVOID_COVER_POINTS];
    surface all;
    *margin = 0;
    if (!surface_take_cover(&all, f, cover, w) || !has_points(&all)) return 2;
    // The differences point from A to B: the Minkowski difference ends along n where n.w is least.
    double from = -most + 2 * (most - least) + f->check, low = most, others = INFINITY;
    for (uint32_t t = 0; t < cover->triangle_count; t++) {
        const uint16_t *v = cover->triangles[t];
        vec3 a = surface_get_point(&all, v[0]), b = surface_get_point(&all, v[1]), c = surface_get_point(&all, v[2]),
             normal;
        double high = max2(vec3_dot(n, a), max2(vec3_dot(n, b), vec3_dot(n, c)));
        if (high <= from)
            low = min2(low, -high);
        else
            others = min2(others, triangle_compute_clearance(a, b, c, INFINITY, &normal));
    }
    *margin = max2(others - f->check - most, 0);
    return *margin > 0 ? (most - low + f->check) / most : 2;
}

// An upper bound of the angle whose cosine is 1 - rest: with the chord c = sqrt(2 rest) the angle is 2 asin(c / 2), and
// that over c is 1 + k c^2 with a k that grows from 1 / 24 to 0.1427.
double gradient_find_angle_above(double rest) {
    if (!(rest < 2)) return 0x1.921fb54442d19p+1;
    double chord = sqrt(2 * max2(rest, 0));
    return chord * (1 + 0.143 * chord * chord);
}

static void put(double *to, vec3 v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

static vec3 find_lever(const ovoid_shape *shape, const mat3 *rotation, vec3 point) {
    if (shape->has_origin) point = vec3_add(point, shape->origin);
    return mat3_mul_vec3(*rotation, point);
}

void gradient_put(const pair_frame *f, vec3 n, vec3 point_a, vec3 point_b, ovoid_gradient *out) {
    if (f->a->has_origin) point_a = vec3_add(point_a, mat3_mul_vec3(f->world, f->a->origin));
    if (f->b->has_origin) point_b = vec3_add(point_b, mat3_mul_vec3(f->world_b, f->b->origin));
    put(out->gradient, vec3_neg(n));
    put(out->gradient + 3, vec3_cross(n, point_a));
    put(out->gradient + 6, n);
    put(out->gradient + 9, vec3_cross(point_b, n));
}

// The torques, and whether the derivative by rotations exists.
static void add_rotation(const pair_frame *f, const ovoid_proof *p, vec3 n, double excess, double off,
                         ovoid_gradient *out) {
    feature a =
        feature_make(f->a, mat3_mul_transposed_vec3(f->world, n), (weighted_vertices){p->a, p->weight_a, p->count});
    feature b = feature_make(f->b, vec3_neg(mat3_mul_transposed_vec3(f->world_b, n)),
                             (weighted_vertices){p->b, p->weight_b, p->count});
    put(out->gradient + 3, vec3_cross(n, find_lever(f->a, &f->world, a.point)));
    put(out->gradient + 9, vec3_cross(find_lever(f->b, &f->world_b, b.point), n));
    out->slope = min2(join_slopes(f, &a, &b), 1);
    out->has_rotation = out->has_translation && out->slope > 2 * out->turn + 256 * rounding;
    if (out->slope > 0) out->slide = (excess + off) / out->slope;
}

// The radius by which a body's own distance is that of its hull. A true body within an allowance has none that is
// known.
static double get_core_radius(const ovoid_shape *s) { return s->has_allowance ? 0 : s->radius; }

static void compute(const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_cover *cover, ovoid_gradient *out) {
    OVOID_ASSERT(pair && answer);
    pair_frame f;
    vec3 n = vec3_unit(answer->normal);
    *out = (ovoid_gradient){.has_translation = 0};
    out->turn = gradient_find_angle_above(2);
    out->slide = INFINITY;
    if (frame_make(pair, &f) != OVOID_LIMIT_NONE) return;
    if (!(vec3_norm_squared(n) > 0.5) || !vec3_is_finite(n) || !(answer->lower <= answer->upper)) return;
    put(out->gradient, vec3_neg(n));
    put(out->gradient + 6, n);

    // Bounds of the hulls, without radii; of true bodies that are known to within allowances, of these bodies.
    int is_exact = !f.a->has_allowance && !f.b->has_allowance;
    double radii = get_core_radius(f.a) + get_core_radius(f.b);
    double lower = answer->lower + radii, upper = answer->upper + radii, off = INFINITY;
    if (lower > 0) {
        out->turn = gradient_find_angle_above((upper - lower) / upper);
        out->margin = INFINITY;
        off = sqrt(max2((upper - lower) * (upper + lower), 0));
    } else if (upper < 0 && is_exact) {
        vec3 in_frame = frame_direction_from_world(&f, n);
        out->turn = gradient_find_angle_above(judge_depth(&f, cover, in_frame, -upper, -lower, &out->margin));
        off = out->turn * -lower;
    }
    out->has_translation = out->margin > 0;
    int has_points = answer->proof.kind == OVOID_PROOF_POINTS || answer->proof.kind == OVOID_PROOF_COVER;
    if (has_points && answer->proof.count && proof_is_sound(&f, &answer->proof))
        add_rotation(&f, &answer->proof, n, upper - lower, off, out);
    if (is_exact) return;
    // The points of the true bodies, and how these fall away there, are not known but of those in closed form.
    out->has_rotation = 0;
    out->slope = 0;
    out->slide = INFINITY;
    const ovoid_proof *proof = &answer->proof;
    int is_balls = proof->kind == OVOID_PROOF_BALLS && vec3_is_finite(proof->inner_a) && vec3_is_finite(proof->inner_b);
    int has_start = is_balls || (proof->kind == OVOID_PROOF_POINTS && proof->count);
    if (has_start && proof_is_sound(&f, proof)) gradient_refine_round(&f, pair, proof, out);
}

ovoid_gradient ovoid_answer_compute_gradient(const ovoid_pair *pair, const ovoid_answer *answer,
                                             const ovoid_cover *cover) {
    ENVIRONMENT_RETURN_FILLED(ovoid_gradient, out, pair, compute(pair, answer, cover, &out));
}
