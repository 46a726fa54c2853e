// The order of two bodies. A query computes with the bodies in this order, whichever of them the caller names first, so
// that a contact of exchanged bodies has the same bits. Equal shapes are ordered by their poses; a contact that goes on
// from an earlier one keeps its order, as a body at rest may come now before, now after an equal one.
#include "manifold/manifold.h"

#include <string.h>

static int compare_numbers(const double *p, const double *q, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (p[i] != q[i]) return p[i] < q[i] ? -1 : 1;
    return 0;
}

// Most shapes differ in their number of vertices or their sphere; copies of one shape have the same bytes.
static int compare_shapes(const ovoid_shape *a, const ovoid_shape *b) {
    if (a == b) return 0;
    if (a->vertex_count != b->vertex_count) return a->vertex_count < b->vertex_count ? -1 : 1;
    if (a->reach != b->reach) return a->reach < b->reach ? -1 : 1;
    const double p[] = {a->radius, a->lower_radius, a->upper_radius, a->origin.x, a->origin.y, a->origin.z};
    const double q[] = {b->radius, b->lower_radius, b->upper_radius, b->origin.x, b->origin.y, b->origin.z};
    int order = compare_numbers(p, q, sizeof p / sizeof *p);
    if (order) return order;
    const double *of_a = shape_vertices(a), *of_b = shape_vertices(b);
    size_t count = 3 * (size_t)a->vertex_count;
    return memcmp(of_a, of_b, count * sizeof *of_a) ? compare_numbers(of_a, of_b, count) : 0;
}

static int compare_poses(const ovoid_pose *a, const ovoid_pose *b) {
    const double p[] = {a->position.x, a->position.y, a->position.z, a->rotation.w,
                        a->rotation.x, a->rotation.y, a->rotation.z};
    const double q[] = {b->position.x, b->position.y, b->position.z, b->rotation.w,
                        b->rotation.x, b->rotation.y, b->rotation.z};
    return compare_numbers(p, q, sizeof p / sizeof *p);
}

int order_is_exchanged(const ovoid_pair *pair, const ovoid_manifold *earlier) {
    if (earlier && earlier->axis != OVOID_MANIFOLD_NONE) return (earlier->memory.flags & MANIFOLD_EXCHANGED) != 0;
    int order = compare_shapes(pair->shape_a, pair->shape_b);
    if (order == 0) order = compare_poses(&pair->pose_a, &pair->pose_b);
    return order > 0;
}
