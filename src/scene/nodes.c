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
    f->check = 100 * 0x1p-53 * f->size + OVOID_LENGTH_MIN;
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

// What two nodes are measured by.
typedef struct gaps {
    vec3 t;              // between the centres, frame of a
    double sphere;       // between the spheres
    vec3 in_a, in_b;     // between the boxes, along the axes of each
    double box_a, box_b; // what they show
} gaps;

static inline void find_spheres(const nodes_frame *f, const compound_node *a, const compound_node *b, gaps *g) {
    g->t = vec3_sub(vec3_add(mat3_mul_vec3(f->rotation, b->center), f->translation), a->center);
    g->sphere = vec3_norm(g->t) - (a->radius + b->radius);
}
static inline void find_boxes(const nodes_frame *f, const compound_node *a, const compound_node *b, gaps *g) {
    g->in_a = find_gaps(g->t, a->half, mat3_mul_vec3(f->sizes, b->half));
    g->in_b =
        find_gaps(mat3_mul_transposed_vec3(f->rotation, g->t), b->half, mat3_mul_transposed_vec3(f->sizes, a->half));
    g->box_a = measure(g->in_a);
    g->box_b = measure(g->in_b);
}

double nodes_compute_lower(const nodes_frame *f, const compound_node *a, const compound_node *b, double enough) {
    gaps g;
    find_spheres(f, a, b, &g);
    if (g.sphere - f->claim > enough) return g.sphere - f->claim;
    find_boxes(f, a, b, &g);
    return max2(g.sphere, max2(g.box_a, g.box_b)) - f->claim;
}

static double with_sign_of(double size, double sign) { return sign < 0 ? -size : size; }

// The direction of the boxes' distance, or of the axis along which they overlap least.
static vec3 find_direction(vec3 g, vec3 t) {
    double most = max2(g.x, max2(g.y, g.z));
    vec3 n = {max2(g.x, 0), max2(g.y, 0), max2(g.z, 0)};
    if (!(most > 0)) n = most == g.x ? (vec3){1, 0, 0} : most == g.y ? (vec3){0, 1, 0} : (vec3){0, 0, 1};
    return vec3_unit((vec3){with_sign_of(n.x, t.x), with_sign_of(n.y, t.y), with_sign_of(n.z, t.z)});
}

vec3 nodes_compute_normal(const nodes_frame *f, const compound_node *a, const compound_node *b) {
    gaps g;
    find_spheres(f, a, b, &g);
    find_boxes(f, a, b, &g);
    if (g.sphere >= g.box_a && g.sphere >= g.box_b) {
        vec3 n = vec3_unit(g.t);
        if (!(vec3_norm_squared(n) > 0.5)) n = (vec3){1, 0, 0};
        return mat3_mul_vec3(f->world_a, n);
    }
    if (g.box_a >= g.box_b) return mat3_mul_vec3(f->world_a, find_direction(g.in_a, g.t));
    return mat3_mul_vec3(f->world_b, find_direction(g.in_b, mat3_mul_transposed_vec3(f->rotation, g.t)));
}
