// Convex polygons by Andrew's chains: points sorted along one coordinate, the lower and the upper chain kept convex by
// exact signs. A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979. Cost: n log n.
#include "polytope/polygon.h"

#include "polytope/quickhull.h"
#include "polytope/sort.h"

typedef struct projection {
    const double *grid;
    int u, v; // the coordinates that are seen
    int axis;
} projection;

static int compare_points(const void *context, uint32_t a, uint32_t b) {
    const projection *p = context;
    const double *x = p->grid + 3 * (size_t)a, *y = p->grid + 3 * (size_t)b;
    if (x[p->u] != y[p->u]) return x[p->u] < y[p->u] ? -1 : 1;
    if (x[p->v] != y[p->v]) return x[p->v] < y[p->v] ? -1 : 1;
    return 0;
}

// Extends a chain that starts at loop[start]: corners that do not turn left go.
static uint32_t extend(const projection *p, uint32_t *loop, uint32_t start, uint32_t count, uint32_t next) {
    while (count >= start + 2 && orient2d_sign(vec3_at(p->grid, loop[count - 2]), vec3_at(p->grid, loop[count - 1]),
                                               vec3_at(p->grid, next), p->axis) <= 0)
        count--;
    loop[count++] = next;
    return count;
}

static void rotate_to_lowest(uint32_t *loop, uint32_t *scratch, uint32_t count) {
    uint32_t lowest = 0;
    for (uint32_t i = 1; i < count; i++)
        if (loop[i] < loop[lowest]) lowest = i;
    for (uint32_t i = 0; i < count; i++) scratch[i] = loop[(lowest + i) % count];
    for (uint32_t i = 0; i < count; i++) loop[i] = scratch[i];
}

uint32_t polygon_find_loop(const double *grid, uint32_t count, int axis, uint32_t *loop,
                           const ovoid_allocator *allocator) {
    // The indices, and a chain that may hold every point and its start again.
    uint32_t *order = allocator_allocate(allocator, 2 * (size_t)count + 2, sizeof *order);
    if (!order) return 0;
    uint32_t *chain = order + count;
    projection p = {grid, (axis + 1) % 3, (axis + 2) % 3, axis};
    for (uint32_t i = 0; i < count; i++) order[i] = i;
    sort_indices(order, chain, count, compare_points, &p);

    // The lower chain rightward, then the upper one back; the last point is the first one again.
    uint32_t corners = 0;
    for (uint32_t i = 0; i < count; i++) corners = extend(&p, chain, 0, corners, order[i]);
    uint32_t turn = corners - 1;
    for (uint32_t i = count - 1; i-- > 0;) corners = extend(&p, chain, turn, corners, order[i]);
    if (corners > 1) corners--;
    for (uint32_t i = 0; i < corners; i++) loop[i] = chain[i];
    rotate_to_lowest(loop, order, corners);
    allocator_release(allocator, order);
    return corners;
}
