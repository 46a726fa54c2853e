// What a lane of gjk8.h ended with.
#include "simd/gjk8.h"

static void take_corner(const gjk8_corner *c, unsigned k, int i, small_gjk_result *r) {
    uint32_t id = (uint32_t)c->id.lane[k];
    r->at.x[i] = c->x.lane[k];
    r->at.y[i] = c->y.lane[k];
    r->at.z[i] = c->z.lane[k];
    r->a[i] = id % SMALL_GJK_POINTS;
    r->b[i] = id / SMALL_GJK_POINTS;
    r->valid |= 1u << i;
}

void gjk8_put_first(gjk8 *g, unsigned k, const gjk8_first *first) {
    const small_gjk_body *a = &g->bodies[k].a, *b = &g->bodies[k].b;
    g->fresh.x.lane[k] = b->x[first->b] - a->x[first->a];
    g->fresh.y.lane[k] = b->y[first->b] - a->y[first->a];
    g->fresh.z.lane[k] = b->z[first->b] - a->z[first->a];
    g->fresh.id.lane[k] = first->a + SMALL_GJK_POINTS * first->b;
    g->gap.lane[k] = first->gap;
    g->measured |= 1u << k;
}

void gjk8_get_result(const gjk8 *g, unsigned k, small_gjk_end end, small_gjk_result *r) {
    int is_inside = end == SMALL_GJK_INSIDE;
    const lane_column *n = is_inside ? g->start : g->n;
    r->end = end;
    r->valid = 0;
    for (int i = 0; i < 3; i++) r->n[i] = n[i].lane[k];
    r->square = (is_inside ? &g->start_square : &g->square)->lane[k];
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
