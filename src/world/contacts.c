// Contacts: the list of pairs is brought up to date, each pair is answered from its cache or queried again, and those
// that are not proven farther than the margin are written in the order of the list. A pair's state depends on its own
// past alone, so it does not matter which worker updates it.
#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "query/goal.h"
#include "world/pair_update.h"

#include <string.h>

enum { CHUNK = 512 };

// ---- deciding

// 1 if the pair is answered without a query; mostly its entry in the list suffices.
static int is_answered(const ovoid_world *w, world_pair *p) {
    int has_moved = (w->marks[p->a] | w->marks[p->b]) & MARK_MOVED || p->flags & PAIR_CHECK;
    if (!(p->flags & PAIR_KNOWN)) return 0;
    if (!has_moved) return 1;
    p->flags &= (uint16_t) ~(PAIR_STILL | PAIR_CHECK);
    return pair_is_answered(w, p);
}

// Bodies, cached proofs and shapes are scattered in memory: they are prefetched some pairs ahead.
enum { AHEAD = 6, SHAPES_AHEAD = 2, SHAPE_LINES = 8 };

static void prefetch_bodies(const ovoid_world *w, const world_pair *p) {
    const char *a = (const char *)&w->bodies[p->a], *b = (const char *)&w->bodies[p->b],
               *k = (const char *)&w->pair_cache[p->slot];
    for (int line = 0; line < 2; line++) {
        compiler_prefetch(a + 64 * line);
        compiler_prefetch(b + 64 * line);
        compiler_prefetch(k + 64 * line);
    }
}

static void prefetch_shapes(const ovoid_world *w, const world_pair *p) {
    const char *a = (const char *)w->bodies[p->a].body.shape, *b = (const char *)w->bodies[p->b].body.shape;
    for (int line = 0; a && b && line < SHAPE_LINES; line++) {
        compiler_prefetch(a + 64 * line);
        compiler_prefetch(b + 64 * line);
    }
}

static void decide_chunk(ovoid_world *w, world_pair *pairs, uint32_t count, chunk *out) {
    uint16_t open[CHUNK];
    uint32_t open_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        open[open_count] = (uint16_t)i;
        open_count += !is_answered(w, &pairs[i]);
    }
    for (uint32_t i = 0; i < open_count && i < AHEAD; i++) prefetch_bodies(w, &pairs[open[i]]);
    for (uint32_t i = 0; i < open_count; i++) {
        if (i + AHEAD < open_count) prefetch_bodies(w, &pairs[open[i + AHEAD]]);
        if (i + SHAPES_AHEAD < open_count) prefetch_shapes(w, &pairs[open[i + SHAPES_AHEAD]]);
        pair_update(w, &pairs[open[i]]);
    }
    *out = (chunk){0, open_count};
    for (uint32_t i = 0; i < count; i++) out->contacts += (pairs[i].flags & PAIR_CONTACT) != 0;
}

static uint32_t get_chunk_size(const ovoid_world *w, uint32_t c) {
    size_t rest = w->pair_count - (size_t)c * CHUNK;
    return rest < CHUNK ? (uint32_t)rest : CHUNK;
}

static void decide_chunks(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    ovoid_world *w = work;
    (void)worker;
    for (uint32_t c = first; c < end; c++)
        decide_chunk(w, &w->pairs[(size_t)c * CHUNK], get_chunk_size(w, c), &w->chunks[c]);
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

// ---- writing

static void write_chunks(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    ovoid_world *w = work;
    (void)worker;
    for (uint32_t c = first; c < end; c++) {
        size_t at = w->chunks[c].contacts;
        for (uint32_t i = 0, count = get_chunk_size(w, c); i < count; i++) {
            const world_pair *p = &w->pairs[(size_t)c * CHUNK + i];
            if (!(p->flags & PAIR_CONTACT)) continue;
            w->contacts[at] = pair_make_contact(w, p);
            if (world_is_measuring(w)) w->contact_witnesses[at] = w->witnesses[p->slot];
            at++;
        }
    }
}

static int reserve_contacts(ovoid_world *w, size_t count) {
    return world_reserve(w, (void **)&w->contacts, &w->contact_capacity, 0, count, sizeof *w->contacts) &&
           (!world_is_measuring(w) || world_reserve(w, (void **)&w->contact_witnesses, &w->witness_capacity, 0, count,
                                                    sizeof *w->contact_witnesses));
}

// ---- the query

static ovoid_code validate_query(const ovoid_contact_query *q, ovoid_error *error) {
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

static ovoid_code refuse_memory(ovoid_error *error) {
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for the contacts; nothing is lost, call again");
}

static int is_same(const ovoid_options *a, const ovoid_options *b) {
    return a->absolute_tolerance == b->absolute_tolerance && a->relative_tolerance == b->relative_tolerance &&
           a->iterations == b->iterations;
}

// Makes the query that of the world.
static void take_query(ovoid_world *w, const ovoid_contact_query *q) {
    static const ovoid_options none;
    ovoid_options options = q->options ? *q->options : none;
    if (w->has_query && w->kind == q->kind && w->margin == q->margin && is_same(&w->query_options, &options)) return;
    if (w->margin != q->margin) world_set_margin(w, q->margin);
    w->has_query = 1;
    w->kind = q->kind;
    w->query_options = options;
    renew_ages(w);
}

// Room for witness points in every slot of the cache.
static int reserve_witnesses(ovoid_world *w) {
    return !world_is_measuring(w) || world_reserve(w, (void **)&w->witnesses, &w->witness_slots, w->witness_slots,
                                                   w->slot_capacity, sizeof *w->witnesses);
}

static void decide(ovoid_world *w, uint32_t chunks, ovoid_contacts *found) {
    task_host_run(&w->host, &(task){decide_chunks, w, chunks, 1});
    for (uint32_t c = 0; c < chunks; c++) {
        size_t here = w->chunks[c].contacts;
        w->chunks[c].contacts = found->count;
        found->count += here;
        found->queried += w->chunks[c].queried;
    }
}

static ovoid_code compute_contacts(ovoid_world *w, const ovoid_contact_query *q, ovoid_contacts *out,
                                   ovoid_error *error) {
    OVOID_ASSERT(w && q && out);
    ovoid_code code = validate_query(q, error);
    if (code != OVOID_OK) return code;
    ovoid_contacts found = {.bodies = w->count};
    take_query(w, q);
    found.rebuilt = (uint32_t)world_mend_tree(w);
    if (!world_update_pairs(w, &found) || !reserve_witnesses(w)) return refuse_memory(error);
    uint32_t chunks = (uint32_t)((w->pair_count + CHUNK - 1) / CHUNK);
    if (!world_reserve(w, (void **)&w->chunks, &w->chunk_capacity, 0, chunks, sizeof *w->chunks))
        return refuse_memory(error);
    decide(w, chunks, &found);
    if (!reserve_contacts(w, found.count)) return refuse_memory(error);
    task_host_run(&w->host, &(task){write_chunks, w, chunks, 1});
    if (w->used) memset(w->marks, 0, w->used);
    w->steps++;
    found.items = w->contacts;
    found.witnesses = world_is_measuring(w) ? w->contact_witnesses : NULL;
    found.pairs = w->pair_count;
    found.aged = found.pairs - found.queried;
    found.memory = world_get_memory(w);
    *out = found;
    return OVOID_OK;
}

ovoid_code ovoid_world_compute_contacts(ovoid_world *w, const ovoid_contact_query *query, ovoid_contacts *contacts,
                                        ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, query, compute_contacts(w, query, contacts, error));
}
