// What a lane of gjk8.h ended with.
#include "simd/gjk8.h"

#include <math.h>

static void take_corner(const gjk8_corner *c, unsigned k, int i, small_gjk_result *r) {
    uint32_t id = (uint32_t)c->id.lane[k];
    r->at.x[i] = c->x.lane[k];
    r->at.y[i] = c->y.lane[k];
    r->at.z[i] = c->z.lane[k];
    r->a[i] = id % SMALL_GJK_POINTS;
    r->b[i] = id / SMALL_GJK_POINTS;
    r->valid |= 1u << i;
}

void gjk8_get_result(const gjk8 *g, unsigned k, small_gjk_end end, small_gjk_result *r) {
    int is_inside = end == SMALL_GJK_INSIDE;
    const lane_column *n = is_inside ? g->start : g->n;
    r->end = end;
    r->valid = 0;
    for (int i = 0; i < 3; i++) r->n[i] = n[i].lane[k];
    r->scale = 1 / sqrt((is_inside ? &g->start_square : &g->square)->lane[k]);
    r->gap = (is_inside ? &g->start_gap : &g->gap)->lane[k];
    r->iterations = (uint32_t)g->steps.lane[k];
    if (end == SMALL_GJK_APART) {
        take_corner(&g->fresh, k, 0, r);
        return;
    }
    for (int i = 0; i < 3; i++)
        if (g->is_valid[i].lane[k] > 0) take_corner(&g->old[i], k, i, r);
    if (is_inside) take_corner(&g->fresh, k, 3, r);
}

static void put_corner(gjk8_corner *c, unsigned k, int i, const small_gjk_result *r) {
    c->x.lane[k] = r->at.x[i];
    c->y.lane[k] = r->at.y[i];
    c->z.lane[k] = r->at.z[i];
    c->id.lane[k] = r->a[i] + SMALL_GJK_POINTS * r->b[i];
}

void gjk8_put_result(gjk8 *g, unsigned k, const small_gjk_result *r) {
    for (int i = 0; i < 3; i++) {
        int is_valid = (int)(r->valid >> i & 1);
        g->n[i].lane[k] = r->n[i];
        g->is_valid[i].lane[k] = is_valid;
        if (is_valid) put_corner(&g->old[i], k, i, r);
    }
    g->square.lane[k] = vec3_norm_squared(vec3_at(r->n, 0));
    g->gap.lane[k] = r->gap;
    g->steps.lane[k] = r->iterations;
}
