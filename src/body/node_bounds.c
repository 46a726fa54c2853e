// Bounds of two nodes: gaps along the line of the centres, by spheres, boxes and ellipsoids, whichever reaches least;
// then the boxes along the axes of either body. Along these the other's box is enclosed by a box of the same axes; the
// distance of two such boxes is known in closed form, and so is the direction along which their supports show it. (S.
// Gottschalk, M. C. Lin, D. Manocha, OBBTree: a hierarchical structure for rapid interference detection, 1996, has nine
// axes more.) Two parts: their spheres, and their vertices along a direction that is known to separate other parts.
//
// Errors (docs/compound.md), u = 2^-53, S = Ea + Eb + |offset|, P = |position of a| + |of b|:
//   parts in the world, as the rounded product of poses has them      45 u (Ea + Eb) + 2 u P
//   the centres' difference, the turned half sizes                    100 u S each
//   sums, squares and roots                                           16 u S
//   the normal, turned to the world                                   42 u S
//   the measurement of whoever checks it, along that normal           148 u S
// Together below 460 u S + 2 u P: a bound is lowered by 512 u S + 8 u P.
#include "body/node_bounds.h"

#include "linear/rotation.h"

// The other body in the frame of the own one.
typedef struct side_view {
    const mat3 *rotation;
    const mat3 *sizes; ///< its entries without their signs
    const vec3 *translation;
} side_view;

static inline side_view get_side(const tree_frame *f, int side) {
    return side ? (side_view){&f->to_b, &f->absolute_b, &f->translation_a}
                : (side_view){&f->to_a, &f->absolute_a, &f->translation};
}

static int has_normal(const parts_direction *d) { return d->normal.x != 0 || d->normal.y != 0 || d->normal.z != 0; }

parts_direction parts_direction_make(const tree_frame *f, vec3 normal) {
    vec3 n = vec3_is_finite(normal) ? vec3_unit(normal) : (vec3){0, 0, 0};
    if (!(vec3_norm_squared(n) > 0.5)) return (parts_direction){.offset = 0};
    vec3 in_a = mat3_mul_transposed_vec3(f->world, n), in_b = mat3_mul_transposed_vec3(f->world_b, n);
    return (parts_direction){n, in_a, in_b, vec3_dot(in_a, f->translation)};
}

// The support of a node's box along a unit direction of its axes, from its centre.
static inline double find_reach(const compound_node *node, vec3 n) {
    const vec3 *h = &node->half;
    return min2((fabs(n.x) * h->x + fabs(n.y) * h->y) + fabs(n.z) * h->z, node->radius);
}

// The support of a node, which is in its box and in its ellipsoid, from the centre of the box. The sign of the
// direction matters, as the two centres differ.
static inline double find_round_reach(const compound_node *node, vec3 n, double reach) {
    if (!node_is_round(node)) return reach;
    return min2(reach, vec3_dot(n, node->shift) + sqrt(sym3_quadratic(node->round, n)));
}

// A point of the other body in the own frame.
static inline vec3 turn_point(const side_view *s, vec3 other) {
    return vec3_add(mat3_mul_vec3(*s->rotation, other), *s->translation);
}
// From a point of a to one of b, in a's frame.
static inline vec3 find_way(const tree_frame *f, vec3 a, vec3 b) {
    return vec3_sub(vec3_add(mat3_mul_vec3(f->to_a, b), f->translation), a);
}
static vec3 find_world_direction(const mat3 *world, vec3 t) {
    vec3 n = vec3_unit(t);
    return mat3_mul_vec3(*world, vec3_norm_squared(n) > 0.5 ? n : (vec3){1, 0, 0});
}

nodes_other nodes_turn(const tree_frame *f, int side, const compound_node *other) {
    const side_view s = get_side(f, side);
    return (nodes_other){side, other, turn_point(&s, other->center), mat3_mul_vec3(*s.sizes, other->half)};
}

// The gaps of two boxes along their three common axes, negative where they overlap.
static inline vec3 find_gaps(vec3 t, vec3 half, vec3 other) {
    return (vec3){fabs(t.x) - (half.x + other.x), fabs(t.y) - (half.y + other.y), fabs(t.z) - (half.z + other.z)};
}

// A lower bound of the signed distance of two boxes with those gaps.
static inline double measure(vec3 g) {
    double most = max2(g.x, max2(g.y, g.z));
    if (!(most > 0)) return most;
    return vec3_norm((vec3){max2(g.x, 0), max2(g.y, 0), max2(g.z, 0)});
}

static inline int is_inside(vec3 t, vec3 half) {
    return fabs(t.x) < half.x && fabs(t.y) < half.y && fabs(t.z) < half.z;
}
static inline nodes_bound lowered(nodes_bound x, const tree_frame *f) {
    return (nodes_bound){x.lower - f->claim, x.means};
}
static inline void take(nodes_bound *best, double gap, nodes_means means) {
    if (gap > best->lower) *best = (nodes_bound){gap, means};
}

nodes_bound nodes_compute_lower(const tree_frame *f, const compound_node *own, const nodes_other *other,
                                double enough) {
    const int side = other->side;
    const side_view s = get_side(f, side);
    const compound_node *node = other->node;
    enough += f->claim;
    // The line of the centres: spheres first, then boxes and ellipsoids, which show nothing of nodes with overlapping
    // centres.
    vec3 t = vec3_sub(other->center, own->center);
    double length = vec3_norm(t);
    nodes_bound best = {length - (own->radius + node->radius), NODES_LINE};
    if (best.lower > enough) return lowered(best, f);
    // With a centre inside the other box the boxes overlap, and how deep only a depth query needs.
    if (enough >= 0 && is_inside(t, own->half)) return lowered(best, f);
    vec3 back = mat3_mul_transposed_vec3(*s.rotation, t);
    if (enough >= 0 && is_inside(back, node->half)) return lowered(best, f);
    if (length > own->radius || length > node->radius) {
        vec3 n = vec3_scale(t, 1 / length), m = vec3_scale(back, -1 / length);
        double of_own = find_reach(own, n), of_other = find_reach(node, m);
        take(&best, length - (of_own + of_other), NODES_LINE);
        if (best.lower > enough) return lowered(best, f);
        if (node_is_round(own) || node_is_round(node)) {
            take(&best, length - (find_round_reach(own, n, of_own) + find_round_reach(node, m, of_other)), NODES_LINE);
            if (best.lower > enough) return lowered(best, f);
        }
    }
    // The boxes along the axes of either body.
    take(&best, measure(find_gaps(t, own->half, other->half)), side ? NODES_BOX_B : NODES_BOX_A);
    if (best.lower > enough) return lowered(best, f);
    take(&best, measure(find_gaps(back, node->half, mat3_mul_transposed_vec3(*s.sizes, own->half))),
         side ? NODES_BOX_A : NODES_BOX_B);
    return lowered(best, f);
}

static double with_sign_of(double size, double sign) { return sign < 0 ? -size : size; }

// The direction of the boxes' distance, or of the axis along which they overlap least.
static vec3 find_direction(vec3 g, vec3 t) {
    double most = max2(g.x, max2(g.y, g.z));
    vec3 n = {max2(g.x, 0), max2(g.y, 0), max2(g.z, 0)};
    if (!(most > 0)) n = most == g.x ? (vec3){1, 0, 0} : most == g.y ? (vec3){0, 1, 0} : (vec3){0, 0, 1};
    return vec3_unit((vec3){with_sign_of(n.x, t.x), with_sign_of(n.y, t.y), with_sign_of(n.z, t.z)});
}

// The direction of the boxes along the axes of the own body, from it to the other; world frame.
static vec3 find_box_normal(const tree_frame *f, int side, const compound_node *own, const compound_node *other) {
    const side_view s = get_side(f, side);
    vec3 t = vec3_sub(turn_point(&s, other->center), own->center);
    vec3 gaps = find_gaps(t, own->half, mat3_mul_vec3(*s.sizes, other->half));
    return mat3_mul_vec3(side ? f->world_b : f->world, find_direction(gaps, t));
}

vec3 nodes_compute_normal(const tree_frame *f, const compound_node *a, const compound_node *b, nodes_means means) {
    switch (means) {
    case NODES_BOX_A: return find_box_normal(f, 0, a, b);
    case NODES_BOX_B: return vec3_neg(find_box_normal(f, 1, b, a));
    default: return find_world_direction(&f->world, find_way(f, a->center, b->center));
    }
}

nodes_bound parts_compute_lower(const tree_frame *f, const parts_direction *d, const part_pair *pair, double enough) {
    const compound_part *a = pair->a, *b = pair->b;
    vec3 t = find_way(f, a->center, b->center);
    nodes_bound best = {vec3_norm(t) - (a->reach + b->reach), NODES_PARTS};
    if (!(best.lower > enough + f->claim) && has_normal(d)) {
        // The parts' own vertices along the normal.
        vec3 in_a = mat3_mul_transposed_vec3(a->rotation, d->in_a);
        vec3 in_b = mat3_mul_transposed_vec3(b->rotation, d->in_b);
        simd_pair most = shapes_find_pair(a->shape, b->shape, in_a, vec3_neg(in_b));
        double apart = (d->offset + vec3_dot(d->in_b, b->at)) - vec3_dot(d->in_a, a->at);
        double gap = (apart - (most.high.value + most.low.value)) - (a->shape->lower_radius + b->shape->lower_radius);
        take(&best, gap, NODES_NORMAL);
    }
    return lowered(best, f);
}

vec3 parts_compute_normal(const tree_frame *f, const compound_part *a, const compound_part *b) {
    return find_world_direction(&f->world, find_way(f, a->center, b->center));
}
