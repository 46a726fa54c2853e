// Two nodes: spheres around the boxes' centres, then the boxes, along the axes of a and along those of b. Along the
// axes of one solid the other's box is enclosed by a box of the same axes; of two such boxes the distance is known in
// closed form, and so is the direction along which their supports show it. S. Gottschalk, M. C. Lin, D. Manocha,
// OBBTree: a hierarchical structure for rapid interference detection, 1996, has all 15 axes; the other nine are left
// out.
//
// Errors (docs/compound.md), u = 2^-53, S = Ea + Eb + |offset|, P = |position of a| + |of b|:
//   parts in the world, as the rounded product of poses has them      45 u (Ea + Eb) + 2 u P
//   the centres' difference, the turned half sizes                    100 u S each
//   sums, squares and root                                            16 u S
//   the normal, turned to the world                                   42 u S
//   the measurement of whoever checks it, along that normal           100 u S
// Together below 448 u S + 2 u P: a bound is lowered by 512 u S + 8 u P.
#include "scene/nodes.h"

#include "linear/rotation.h"

void nodes_frame_make(const solid_view *a, const solid_view *b, nodes_frame *f) {
    f->world_a = quat_to_mat3(a->pose->rotation);
    f->world_b = quat_to_mat3(b->pose->rotation);
    f->rotation = mat3_mul_transposed(f->world_a, f->world_b);
    const mat3 *m = &f->rotation;
    f->sizes = (mat3){{fabs(m->r0.x), fabs(m->r0.y), fabs(m->r0.z)},
                      {fabs(m->r1.x), fabs(m->r1.y), fabs(m->r1.z)},
                      {fabs(m->r2.x), fabs(m->r2.y), fabs(m->r2.z)}};
    vec3 offset = vec3_sub(b->pose->position, a->pose->position);
    f->translation = mat3_mul_transposed_vec3(f->world_a, offset);
    f->size = a->extent + b->extent + vec3_norm(offset);
    double positions = vec3_norm(a->pose->position) + vec3_norm(b->pose->position);
    f->claim = 512 * 0x1p-53 * f->size + 8 * 0x1p-53 * positions + 4 * OVOID_LENGTH_MIN;
    f->normal = (vec3){0, 0, 0};
    f->check = 100 * 0x1p-53 * f->size + OVOID_LENGTH_MIN;
}

void nodes_frame_set_normal(nodes_frame *f, vec3 normal) {
    vec3 n = vec3_is_finite(normal) ? vec3_unit(normal) : (vec3){0, 0, 0};
    if (!(vec3_norm_squared(n) > 0.5)) n = (vec3){0, 0, 0};
    f->normal = n;
    f->in_a = mat3_mul_transposed_vec3(f->world_a, n);
    f->in_b = mat3_mul_transposed_vec3(f->world_b, n);
    f->offset = vec3_dot(f->in_a, f->translation);
}

// How far a node reaches from its centre along a unit direction of its axes.
static double find_reach(const compound_node *node, vec3 n) {
    const vec3 *h = &node->half;
    return min2((fabs(n.x) * h->x + fabs(n.y) * h->y) + fabs(n.z) * h->z, node->radius);
}
static double find_gap_along(const nodes_frame *f, const compound_node *a, const compound_node *b) {
    double apart = (f->offset + vec3_dot(f->in_b, b->center)) - vec3_dot(f->in_a, a->center);
    return apart - (find_reach(a, f->in_a) + find_reach(b, f->in_b));
}

// How far the boxes are apart along each of three common axes, negative where they overlap.
static vec3 find_gaps(vec3 t, vec3 half_a, vec3 half_b) {
    return (vec3){fabs(t.x) - (half_a.x + half_b.x), fabs(t.y) - (half_a.y + half_b.y),
                  fabs(t.z) - (half_a.z + half_b.z)};
}

// The signed distance from below of two boxes with those gaps.
static double measure(vec3 g) {
    double most = max2(g.x, max2(g.y, g.z));
    if (!(most > 0)) return most;
    return vec3_norm((vec3){max2(g.x, 0), max2(g.y, 0), max2(g.z, 0)});
}

// A point of b from a point of a, in the frame; and as a unit direction of the world.
static vec3 find_offset(const nodes_frame *f, vec3 a, vec3 b) {
    return vec3_sub(vec3_add(mat3_mul_vec3(f->rotation, b), f->translation), a);
}
static vec3 turn_offset(const nodes_frame *f, vec3 t) {
    vec3 n = vec3_unit(t);
    return mat3_mul_vec3(f->world_a, vec3_norm_squared(n) > 0.5 ? n : (vec3){1, 0, 0});
}
static int has_normal(const nodes_frame *f) { return f->normal.x != 0 || f->normal.y != 0 || f->normal.z != 0; }

// The gaps along the axes of A, of B, given the offset of the centres.
static vec3 find_gaps_in_a(const nodes_frame *f, const compound_node *a, const compound_node *b, vec3 t) {
    return find_gaps(t, a->half, mat3_mul_vec3(f->sizes, b->half));
}
// Likewise along those of b; t: along its axes.
static vec3 find_gaps_in_b(const nodes_frame *f, const compound_node *a, const compound_node *b, vec3 t) {
    return find_gaps(t, b->half, mat3_mul_transposed_vec3(f->sizes, a->half));
}

// The gap along the line of the centres, given that line along the axes of both.
static double find_gap_of_line(const compound_node *a, const compound_node *b, vec3 in_a, vec3 in_b, double length) {
    double scale = 1 / length;
    return length - (find_reach(a, vec3_scale(in_a, scale)) + find_reach(b, vec3_scale(in_b, scale)));
}

static nodes_bound better(nodes_bound x, nodes_bound y) { return y.lower > x.lower ? y : x; }

nodes_bound nodes_compute_lower(const nodes_frame *f, const compound_node *a, const compound_node *b, double enough) {
    nodes_bound best = {-INFINITY, NODES_SPHERES};
    if (has_normal(f)) {
        best = (nodes_bound){find_gap_along(f, a, b) - f->claim, NODES_NORMAL};
        if (best.lower > enough) return best;
    }
    vec3 t = find_offset(f, a->center, b->center);
    double length = vec3_norm(t);
    best = better(best, (nodes_bound){length - (a->radius + b->radius) - f->claim, NODES_SPHERES});
    if (best.lower > enough) return best;
    vec3 turned = mat3_mul_transposed_vec3(f->rotation, t);
    // Of nodes that lie in each other it shows nothing.
    if (length > a->radius || length > b->radius) {
        best = better(best, (nodes_bound){find_gap_of_line(a, b, t, turned, length) - f->claim, NODES_SPHERES});
        if (best.lower > enough) return best;
    }
    best = better(best, (nodes_bound){measure(find_gaps_in_a(f, a, b, t)) - f->claim, NODES_BOX_A});
    if (best.lower > enough) return best;
    return better(best, (nodes_bound){measure(find_gaps_in_b(f, a, b, turned)) - f->claim, NODES_BOX_B});
}

static double with_sign_of(double size, double sign) { return sign < 0 ? -size : size; }

// The direction of the boxes' distance, or of the axis along which they overlap least.
static vec3 find_direction(vec3 g, vec3 t) {
    double most = max2(g.x, max2(g.y, g.z));
    vec3 n = {max2(g.x, 0), max2(g.y, 0), max2(g.z, 0)};
    if (!(most > 0)) n = most == g.x ? (vec3){1, 0, 0} : most == g.y ? (vec3){0, 1, 0} : (vec3){0, 0, 1};
    return vec3_unit((vec3){with_sign_of(n.x, t.x), with_sign_of(n.y, t.y), with_sign_of(n.z, t.z)});
}

vec3 nodes_compute_normal(const nodes_frame *f, const compound_node *a, const compound_node *b, nodes_means means,
                          vec3 normal) {
    vec3 t = find_offset(f, a->center, b->center), turned = mat3_mul_transposed_vec3(f->rotation, t);
    switch (means) {
    case NODES_NORMAL: return normal;
    case NODES_BOX_A: return mat3_mul_vec3(f->world_a, find_direction(find_gaps_in_a(f, a, b, t), t));
    case NODES_BOX_B: return mat3_mul_vec3(f->world_b, find_direction(find_gaps_in_b(f, a, b, turned), turned));
    default: break;
    }
    return turn_offset(f, t);
}

nodes_bound parts_compute_lower(const nodes_frame *f, const compound_part *a, const compound_part *b, double enough) {
    vec3 t = find_offset(f, a->center, b->center);
    nodes_bound best = {vec3_norm(t) - (a->reach + b->reach) - f->claim, NODES_PARTS};
    if (best.lower > enough || !has_normal(f)) return best;
    // The parts' own vertices along the normal.
    vec3 in_a = mat3_mul_transposed_vec3(a->rotation, f->in_a), in_b = mat3_mul_transposed_vec3(b->rotation, f->in_b);
    simd_pair most = shapes_find_pair(a->shape, b->shape, in_a, vec3_neg(in_b));
    double apart = (f->offset + vec3_dot(f->in_b, b->at)) - vec3_dot(f->in_a, a->at);
    double gap = (apart - (most.high.value + most.low.value)) - (a->shape->radius + b->shape->radius);
    return better(best, (nodes_bound){gap - f->claim, NODES_NORMAL});
}

vec3 parts_compute_normal(const nodes_frame *f, const compound_part *a, const compound_part *b) {
    return turn_offset(f, find_offset(f, a->center, b->center));
}
