// A step: its query, its pairs, and which of them are answered. A pair's state depends on its own past alone, so it
// does not matter which worker updates it.
#include "world/step.h"

#include "base/error.h"
#include "query/goal.h"
#include "simd/kept8.h"

#include <string.h>

// ---- deciding

unsigned step_find_answered(ovoid_world *w, world_pair *pairs, uint32_t count) {
    unsigned known = 0, moved = 0, of_kind[PAIR_SPHERE + 1] = {0};
    double ranges[PAIR8] = {0};
    for (uint32_t k = 0; k < count; k++) {
        const world_pair *p = &pairs[k];
        known |= (unsigned)((p->flags & PAIR_KNOWN) != 0) << k;
        moved |= (unsigned)(((w->marks[p->a] | w->marks[p->b]) & MARK_MOVED) || p->flags & PAIR_CHECK) << k;
        of_kind[p->kind] |= 1u << k;
    }
    moved &= known;
    if (!moved) return known;
    for (uint32_t k = 0; k < count; k++) {
        world_pair *p = &pairs[k];
        if (moved >> k & 1) p->flags &= (uint16_t) ~(PAIR_STILL | PAIR_CHECK);
        if (w->wants_manifolds) ranges[k] = world_get_pair_range(w, p->a, p->b);
    }
    const kept8_bounds bounds = {pairs, sizeof *pairs, &w->places[0].at.x, ranges, count};
    kept8_answers holds = kept8_get_kernels(count)->compare(&bounds);
    return (known & ~moved) | (moved & ((holds.plane & of_kind[PAIR_PLANE]) | (holds.ball & of_kind[PAIR_BALL]) |
                                        (holds.sphere & of_kind[PAIR_SPHERE])));
}

// Bodies, cached proofs and shapes are scattered in memory.
enum { AHEAD = 6, SHAPES_AHEAD = 2, SHAPE_LINES = 8 };

void step_prefetch_bodies(const ovoid_world *w, const world_pair *p) {
    prefetch_two_lines(&w->bodies[p->a]);
    prefetch_two_lines(&w->bodies[p->b]);
    prefetch_two_lines(&w->pair_cache[p->slot]);
}

static void prefetch_shapes(const ovoid_world *w, const world_pair *p) {
    const char *a = (const char *)w->bodies[p->a].body.shape, *b = (const char *)w->bodies[p->b].body.shape;
    for (int line = 0; a && b && line < SHAPE_LINES; line++) {
        compiler_prefetch(a + 64 * line);
        compiler_prefetch(b + 64 * line);
    }
}

void step_prefetch(const ovoid_world *w, const world_pair *pairs, const uint16_t *items, uint32_t i, uint32_t count) {
    for (uint32_t k = 0; i == 0 && k < count && k < AHEAD; k++) step_prefetch_bodies(w, &pairs[items[k]]);
    if (i + AHEAD < count) step_prefetch_bodies(w, &pairs[items[i + AHEAD]]);
    if (i + SHAPES_AHEAD < count) prefetch_shapes(w, &pairs[items[i + SHAPES_AHEAD]]);
}

// Recomputes how long each cached answer holds after a change of the query. Not every query caches witness points.
static void renew_ages(ovoid_world *w) {
    for (size_t i = 0; i < w->pair_count; i++) {
        world_pair *p = &w->pairs[i];
        if (!(p->flags & PAIR_KNOWN)) continue;
        p->flags &= (uint16_t) ~(PAIR_STILL | PAIR_KNOWN);
        pair_set_age(w, p, &w->pair_cache[p->slot]);
        if (p->kind != PAIR_OPEN) p->flags |= PAIR_KNOWN | PAIR_CHECK;
    }
}

// ---- the query

ovoid_code step_validate(const ovoid_contact_query *q, ovoid_error *error) {
    ovoid_options options;
    if ((unsigned)q->kind > OVOID_QUERY_DEPTH)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "kind %d: there are 0 .. 3", (int)q->kind);
    if (!(q->margin >= 0 && q->margin <= OVOID_LENGTH_MAX))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "margin %.17g: it must be finite and not negative",
                         q->margin);
    if (q->kind == OVOID_QUERY_COLLIDE && q->margin > 0)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "margin %.17g: collide takes none; the query within does",
                         q->margin);
    return options_validate(q->options, &options, error);
}

ovoid_code step_refuse_memory(ovoid_error *error) {
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for the contacts; nothing is lost, call again");
}

static int is_same(const ovoid_options *a, const ovoid_options *b) {
    return a->absolute_tolerance == b->absolute_tolerance && a->relative_tolerance == b->relative_tolerance &&
           a->iterations == b->iterations;
}

void step_take_query(ovoid_world *w, const ovoid_contact_query *q, int wants_manifolds) {
    static const ovoid_options none;
    ovoid_options options = q->options ? *q->options : none;
    if (w->has_query && w->kind == q->kind && w->margin == q->margin && w->wants_manifolds == wants_manifolds &&
        is_same(&w->query_options, &options))
        return;
    if (w->margin != q->margin) world_set_margin(w, q->margin);
    w->has_query = 1;
    w->kind = q->kind;
    w->wants_manifolds = wants_manifolds;
    w->query_options = options;
    renew_ages(w);
}

// ---- begin and end

// Room in every slot of the cache for witness points, and for what a depth starts from.
static int reserve_beside(ovoid_world *w) {
    if (world_has_witnesses(w) && !world_reserve(w, (void **)&w->witnesses, &w->witness_slots, w->witness_slots,
                                                 w->slot_capacity, sizeof *w->witnesses))
        return 0;
    return w->kind != OVOID_QUERY_DEPTH ||
           world_reserve(w, (void **)&w->depths, &w->depth_slots, w->depth_slots, w->slot_capacity, sizeof *w->depths);
}

int step_begin(ovoid_world *w, uint32_t *chunks, ovoid_contacts *counts) {
    *counts = (ovoid_contacts){.bodies = w->count};
    counts->rebuilt = (uint32_t)world_mend_tree(w);
    if (!world_update_pairs(w, counts) || !reserve_beside(w)) return 0;
    *chunks = (uint32_t)((w->pair_count + CHUNK - 1) / CHUNK);
    return world_reserve(w, (void **)&w->chunks, &w->chunk_capacity, 0, *chunks, sizeof *w->chunks);
}

void step_end(ovoid_world *w, ovoid_contacts *counts) {
    if (w->used) memset(w->marks, 0, w->used);
    w->steps++;
    counts->pairs = w->pair_count;
    counts->aged = counts->pairs - counts->queried;
    counts->memory = world_get_memory(w);
}
