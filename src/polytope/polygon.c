// Convex polygons by Andrew's chains: points sorted along one coordinate, the lower and the upper chain kept convex by
// exact signs. A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979. Cost: n log n.
#include "polytope/polygon.h"

#include "base/allocator.h"
#include "polytope/quickhull.h"
#include "polytope/sort.h"

typedef struct projection {
    const double *grid;
    int u, v; // the coordinates of the projection
    int axis;
} projection;

static int compare_points(const void *context, uint32_t a, uint32_t b) {
    const projection *p = context;
    const double *x = p->grid + 3 * (size_t)a, *y = p->grid + 3 * (size_t)b;
    if (x[p->u] != y[p->u]) return x[p->u] < y[p->u] ? -1 : 1;
    if (x[p->v] != y[p->v]) return x[p->v] < y[p->v] ? -1 : 1;
    return 0;
}

typedef struct chain {
    uint32_t *items, count;
} chain;

// Appends a point to the chain that begins at items[start]; corners that then no longer turn left are dropped.
static void extend(const projection *p, chain *c, uint32_t start, uint32_t next) {
    vec3 end = vec3_at(p->grid, next);
    while (c->count >= start + 2) {
        const uint32_t *last = c->items + c->count - 2;
        if (orient2d_sign(vec3_at(p->grid, last[0]), vec3_at(p->grid, last[1]), end, p->axis) > 0) break;
        c->count--;
    }
    c->items[c->count++] = next;
}

static void rotate_to_lowest(uint32_t *loop, uint32_t *scratch, uint32_t count) {
    uint32_t lowest = 0;
    for (uint32_t i = 1; i < count; i++)
        if (loop[i] < loop[lowest]) lowest = i;
    for (uint32_t i = 0; i < count; i++) scratch[i] = loop[(lowest + i) % count];
    for (uint32_t i = 0; i < count; i++) loop[i] = scratch[i];
}

uint32_t polygon_find_loop(const points *p, int axis, uint32_t *loop, const ovoid_allocator *allocator) {
    // The indices, and a chain with room for every point and its start again.
    uint32_t count = p->count, *order = allocator_allocate(allocator, 2 * (size_t)count + 2, sizeof *order);
    if (!order) return 0;
    chain c = {order + count, 0};
    projection q = {p->grid, (axis + 1) % 3, (axis + 2) % 3, axis};
    for (uint32_t i = 0; i < count; i++) order[i] = i;
    sort_indices(order, c.items, count, (index_order){compare_points, &q});

    // The lower chain rightward, then the upper one back; the last point is the first one again.
    for (uint32_t i = 0; i < count; i++) extend(&q, &c, 0, order[i]);
    uint32_t turn = c.count - 1;
    for (uint32_t i = count - 1; i-- > 0;) extend(&q, &c, turn, order[i]);
    uint32_t corners = c.count > 1 ? c.count - 1 : c.count;
    for (uint32_t i = 0; i < corners; i++) loop[i] = c.items[i];
    rotate_to_lowest(loop, order, corners);
    allocator_release(allocator, order);
    return corners;
}
