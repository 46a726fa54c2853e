// Doubles find a vertex that is extreme but for roundings of doubles, floats one by their own values. A gap computed in
// floats from either has the same error, that of all vertices' values (docs/error-analysis.md).
#include "query/batch_supports.h"

#include "base/compiler.h"

// A lane's body. The direction is `sign` times the columns n, and the vertex goes to the columns `to`, about the
// sphere's centre, in the couple's unit.
typedef struct lane_body {
    const ovoid_shape *shape;
    const float_column *n;
    float_column *to;
    float sign, factor, scale; // from the shape's unit; from that of lengths
    unsigned k;
} lane_body;

static vec3 get_direction(const lane_body *at) {
    double sign = (double)at->sign;
    return (vec3){sign * (double)at->n[0].lane[at->k], sign * (double)at->n[1].lane[at->k],
                  sign * (double)at->n[2].lane[at->k]};
}

// The cell of a body's table; NULL where none is needed. All are prefetched before the first is read, as most are in no
// near cache.
static const simd_cell *fetch_cell(const lane_body *at) {
    const ovoid_shape *shape = at->shape;
    if (shape_has_columns(shape) || !shape->support.k) return NULL;
    const simd_cell *cell = support_table_find_cell(&shape->support, shape_cells(shape), get_direction(at));
    for (size_t i = 0; cell && i < sizeof *cell; i += 64) compiler_prefetch((const char *)cell + i);
    return cell;
}

static void find_in_columns(const float_gjk_kernels *kernels, const lane_body *at) {
    const float *columns = shape_get_float_columns(at->shape),
                n[3] = {at->sign * at->n[0].lane[at->k], at->sign * at->n[1].lane[at->k],
                        at->sign * at->n[2].lane[at->k]};
    uint32_t count = at->shape->padded_count, i = kernels->find(columns, count, n);
    for (uint32_t d = 0; d < 3; d++) at->to[d].lane[at->k] = columns[d * count + i] * at->factor;
}

static void find_in_doubles(const lane_body *at, const simd_cell *cell) {
    vec3 n = get_direction(at), center = at->shape->center;
    double scale = (double)at->scale;
    simd_extreme x = cell ? simd_find_in_cell(cell, &shape_cells(at->shape)[cell->next], cell->count, &n)
                          : shape_find_extreme(at->shape, n);
    at->to[0].lane[at->k] = (float)((x.x - center.x) * scale);
    at->to[1].lane[at->k] = (float)((x.y - center.y) * scale);
    at->to[2].lane[at->k] = (float)((x.z - center.z) * scale);
}

static void find_support(const float_gjk_kernels *kernels, const lane_body *at, const simd_cell *cell) {
    if (shape_has_columns(at->shape))
        find_in_columns(kernels, at);
    else
        find_in_doubles(at, cell);
}

static lane_body get_a(float_gjk *g, const float_bodies *bodies, unsigned k) {
    const float_query *q = &g->query;
    return (lane_body){bodies->a[k], g->n, g->given.a, 1, q->factor_a.lane[k], q->scale.lane[k], k};
}
static lane_body get_b(float_gjk *g, const float_bodies *bodies, unsigned k) {
    const float_query *q = &g->query;
    return (lane_body){bodies->b[k], g->given.b, g->given.b, -1, q->factor_b.lane[k], q->scale.lane[k], k};
}

void batch_supports_find(float_gjk *g, const float_gjk_kernels *kernels, const float_bodies *bodies) {
    const simd_cell *cells_a[FLOATS], *cells_b[FLOATS];
    kernels->turn(g);
    for (unsigned rest = g->live; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        lane_body a = get_a(g, bodies, k), b = get_b(g, bodies, k);
        cells_a[k] = fetch_cell(&a);
        cells_b[k] = fetch_cell(&b);
    }
    for (unsigned rest = g->live; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        lane_body a = get_a(g, bodies, k), b = get_b(g, bodies, k);
        find_support(kernels, &a, cells_a[k]);
        find_support(kernels, &b, cells_b[k]);
    }
}
