// How little two bodies must be moved to be apart: along any direction what parts all points of both is enough, so each
// direction bounds the depth, and the least of those tried is taken. For a distance these are the axes of both frames,
// the line of the centres, the normals of the deciding pair, and from the best of them a descent: the width along n is
// the support of the difference of the hulls, of which the farthest point is a gradient (N. Z. Shor, Minimization
// methods for non-differentiable functions, 1985), so n is turned away from that point, by half as much where that does
// not help. A yes or no gets the bound of the boxes.
//
// The farthest point of a solid is found through its tree, nearest box first. A box is rounded outward by more than its
// bound is off here; a point that is passed over so is farther by less than 16 u S, and the claim has room for that.
#include "body/search.h"

enum { DESCENT = 12 };

/// The farthest point of a body along a direction, its own frame for both.
typedef struct farthest {
    double top;
    vec3 point;
} farthest;

/// A direction in a tree's frame and unit, for lanes of boxes.
typedef struct tree_direction {
    vec3 n, size;
} tree_direction;

static double bound_lane(const box8 *b, uint32_t i, const tree_direction *d) {
    double x = d->n.x * ((double)b->low[0][i] + b->high[0][i]) + d->size.x * ((double)b->high[0][i] - b->low[0][i]);
    double y = d->n.y * ((double)b->low[1][i] + b->high[1][i]) + d->size.y * ((double)b->high[1][i] - b->low[1][i]);
    double z = d->n.z * ((double)b->low[2][i] + b->high[2][i]) + d->size.z * ((double)b->high[2][i] - b->low[2][i]);
    return 0.5 * (x + y + z);
}

typedef struct waiting_node {
    uint32_t node;
    double bound; ///< in the tree's unit
} waiting_node;

static void take_triangle(const ovoid_solid *s, uint32_t place, vec3 n, farthest *best) {
    for (int i = 0; i < 3; i++) {
        vec3 p = solid_get_corner(s, place, i);
        double x = vec3_dot(n, p);
        if (x > best->top) *best = (farthest){x, p};
    }
}

static farthest find_farthest_of_solid(const ovoid_solid *s, vec3 n) {
    farthest best = {-INFINITY, {0, 0, 0}};
    tree_direction d = {n, vec3_abs(n)};
    double origin = vec3_dot(n, s->center), unit = s->unit;
    waiting_node stack[SOLID_DEPTH_MAX * BOX8] = {{0, INFINITY}};
    for (uint32_t count = 1; count > 0;) {
        waiting_node w = stack[--count];
        if (origin + w.bound * unit <= best.top) continue;
        const box8 *b = &s->boxes[w.node];
        uint32_t first = count;
        for (uint32_t i = 0; i < s->nodes[w.node].children; i++) {
            double bound = bound_lane(b, i, &d);
            if (origin + bound * unit <= best.top) continue;
            if (b->leaves >> i & 1) {
                take_triangle(s, b->child[i], n, &best);
                continue;
            }
            // The farthest last, which is opened first.
            uint32_t at = count++;
            for (; at > first && stack[at - 1].bound > bound; at--) stack[at] = stack[at - 1];
            stack[at] = (waiting_node){b->child[i], bound};
        }
    }
    return best;
}

static farthest find_farthest_of_parts(const ovoid_compound *c, vec3 n) {
    farthest best = {-INFINITY, {0, 0, 0}};
    for (uint32_t i = 0; i < c->count; i++) {
        const compound_part *part = &c->parts[i];
        vec3 in = mat3_mul_transposed_vec3(part->rotation, n);
        simd_extreme x = shape_find_extreme(part->shape, in);
        double r = shape_compute_lower_radius(part->shape, in, AXIS_CLAIM), top = vec3_dot(n, part->at) + x.value + r;
        vec3 p = vec3_add(part->at, mat3_mul_vec3(part->rotation, (vec3){x.x, x.y, x.z}));
        if (top > best.top) best = (farthest){top, vec3_add_scaled(p, n, r)};
    }
    return best;
}

static farthest find_farthest(const body_tree *tree, vec3 n) {
    if (tree->solid) return find_farthest_of_solid(tree->solid, n);
    if (tree->compound) return find_farthest_of_parts(tree->compound, n);
    simd_extreme x = shape_find_extreme(tree->shape, n);
    vec3 p = vec3_add(tree->shape->origin, (vec3){x.x, x.y, x.z});
    double r = shape_compute_lower_radius(tree->shape, n, AXIS_CLAIM);
    return (farthest){vec3_dot(n, tree->shape->origin) + x.value + r, vec3_add_scaled(p, n, r)};
}

/// The gap of both bodies along a unit direction of a's frame, below 0 where they overlap along it; *farther: from the
/// last point of a to the first of b.
static double measure(const framed_pair *pair, vec3 n, vec3 *farther) {
    const tree_frame *f = pair->frame;
    farthest top = find_farthest(pair->a, n), bottom = find_farthest(pair->b, vec3_neg(mat3_mul_vec3(f->to_b, n)));
    *farther = vec3_sub(vec3_add(f->translation, mat3_mul_vec3(f->to_a, bottom.point)), top.point);
    return (vec3_dot(n, f->translation) - bottom.top) - top.top;
}

/// The best so far, and where the gap along it is measured.
typedef struct parting {
    box_gap gap;
    vec3 farther;
} parting;

static int try_direction(const framed_pair *pair, vec3 n, parting *best) {
    vec3 farther;
    if (!(vec3_norm_squared(n) > 0.5)) return 0;
    double lower = measure(pair, n, &farther);
    if (!(lower > best->gap.lower)) return 0;
    *best = (parting){{lower, n}, farther};
    return 1;
}

static vec3 get_column(const mat3 *m, int i) {
    return i == 0   ? (vec3){m->r0.x, m->r1.x, m->r2.x}
           : i == 1 ? (vec3){m->r0.y, m->r1.y, m->r2.y}
                    : (vec3){m->r0.z, m->r1.z, m->r2.z};
}

// n and -n, that first along which b's centre lies.
static void try_both(const framed_pair *pair, vec3 n, parting *best) {
    try_direction(pair, n, best);
    try_direction(pair, vec3_neg(n), best);
}

static void descend(const framed_pair *pair, parting *best) {
    double step = 0.5;
    for (int i = 0; i < DESCENT; i++) {
        // Toward the difference, across n: so the gap along n grows.
        vec3 n = best->gap.normal, p = best->farther;
        vec3 across = vec3_unit(vec3_add_scaled(p, n, -vec3_dot(n, p)));
        if (!(vec3_norm_squared(across) > 0.5)) return;
        if (!try_direction(pair, vec3_unit(vec3_add_scaled(n, across, step)), best)) step *= 0.5;
    }
}

box_gap framed_pair_find_parting(const framed_pair *pair, vec3 normal) {
    const tree_frame *f = pair->frame;
    parting best = {{-INFINITY, {1, 0, 0}}, {0, 0, 0}};
    const vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++) {
        try_both(pair, axes[i], &best);
        try_both(pair, vec3_unit(get_column(&f->to_a, i)), &best);
    }
    try_both(pair, vec3_unit(f->between), &best);
    try_both(pair, vec3_unit(mat3_mul_transposed_vec3(f->world, normal)), &best);
    descend(pair, &best);
    return (box_gap){best.gap.lower - f->claim, mat3_mul_vec3(f->world, best.gap.normal)};
}
