// Contacts: each pair of a step is answered, and those that are not proven farther than the margin are written in the
// order of the list.
#include "base/environment.h"
#include "base/error.h"
#include "exact/cover_memory.h"
#include "simd/pair8.h"
#include "world/step.h"

// ---- deciding

// How many pairs ahead the place of the second body is prefetched. The list is sorted by the first one.
enum { PLACES_AHEAD = 16 };

static size_t count_contacts(const world_pair *pairs, uint32_t count) {
    size_t contacts = 0;
    for (uint32_t i = 0; i < count; i++) contacts += (pairs[i].flags & PAIR_CONTACT) != 0;
    return contacts;
}

static void decide_chunk(ovoid_world *w, world_pair *pairs, uint32_t count, chunk *out) {
    uint16_t open[CHUNK];
    uint32_t open_count = 0;
    for (uint32_t i = 0; i < count; i += PAIR8) {
        uint32_t some = count - i < PAIR8 ? count - i : PAIR8;
        for (uint32_t k = i + PLACES_AHEAD; k < i + PLACES_AHEAD + some && k < count; k++)
            compiler_prefetch(&w->places[pairs[k].b]);
        unsigned answered = step_find_answered(w, &pairs[i], some);
        for (uint32_t k = 0; k < some; k++) {
            open[open_count] = (uint16_t)(i + k);
            open_count += !(answered >> k & 1);
        }
    }
    *out = (chunk){.queried = open_count};
    open_count = pairs_revalidate(w, pairs, open, open_count);
    open_count = pairs_ask_floats(w, pairs, open, open_count);
    for (uint32_t i = 0; i < open_count; i++) {
        step_prefetch(w, pairs, open, i, open_count);
        pair_update_with(w, &pairs[open[i]], NULL);
        out->full += (pairs[open[i]].flags & PAIR_FULL) != 0;
    }
    out->contacts = count_contacts(pairs, count);
}

static void decide_chunks(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    ovoid_world *w = work;
    (void)worker;
    for (uint32_t c = first; c < end; c++)
        decide_chunk(w, &w->pairs[(size_t)c * CHUNK], step_get_chunk_size(w, c), &w->chunks[c]);
}

// The pairs of a chunk whose searches filled their memory, one after another in the world's. Where that is not to be
// had they are forgotten, so that the next call asks them again, and 0 is returned.
static int decide_full(ovoid_world *w, world_pair *pairs, uint32_t count, chunk *out) {
    size_t size = cover_get_memory_size(OVOID_COVER_POINTS_MAX);
    int has_memory = world_reserve(w, (void **)&w->cover_memory, &w->cover_size, 0, size, 1);
    ovoid_cover cover = {.memory = w->cover_memory, .size = w->cover_size};
    for (uint32_t i = 0; i < count; i++) {
        if (!(pairs[i].flags & PAIR_FULL)) continue;
        if (has_memory)
            pair_update_with(w, &pairs[i], &cover);
        else
            pairs[i].flags &= (uint16_t) ~(PAIR_FULL | PAIR_KNOWN);
    }
    out->contacts = count_contacts(pairs, count);
    return has_memory;
}

// ---- writing

// How many pairs ahead what a contact reads is prefetched.
enum { AHEAD = 12 };

static void prefetch_contact(const ovoid_world *w, const world_pair *p) {
    if (!(p->flags & PAIR_CONTACT)) return;
    compiler_prefetch(&w->pair_cache[p->slot]);
    compiler_prefetch(&w->places[p->b]);
    compiler_prefetch(&w->bodies[p->a].user);
    compiler_prefetch(&w->bodies[p->b].user);
}

// Writes the contacts of a chunk, which are contacts number `at` and those that follow.
static void write_chunk(ovoid_world *w, uint32_t c, size_t at) {
    const world_pair *pairs = &w->pairs[(size_t)c * CHUNK];
    for (uint32_t i = 0, count = step_get_chunk_size(w, c); i < count; i++) {
        const world_pair *p = &pairs[i];
        if (i + AHEAD < count) prefetch_contact(w, p + AHEAD);
        if (!(p->flags & PAIR_CONTACT)) continue;
        w->contacts[at] = pair_make_contact(w, p);
        if (world_has_witnesses(w)) w->contact_witnesses[at] = w->witnesses[p->slot];
        at++;
    }
}

static void write_chunks(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    ovoid_world *w = work;
    (void)worker;
    for (uint32_t c = first; c < end; c++) write_chunk(w, c, w->chunks[c].contacts);
}

// Room for so many contacts, of which the first `used` are written.
static int reserve_contacts(ovoid_world *w, size_t used, size_t count) {
    return world_reserve(w, (void **)&w->contacts, &w->contact_capacity, used, count, sizeof *w->contacts) &&
           (!world_has_witnesses(w) || world_reserve(w, (void **)&w->contact_witnesses, &w->witness_capacity, used,
                                                     count, sizeof *w->contact_witnesses));
}

// ---- all chunks

// Adds a chunk that is decided to the counts, once its full searches are repeated. 0: no memory for these.
static int count_chunk(ovoid_world *w, uint32_t c, ovoid_contacts *found) {
    int has_memory = 1;
    chunk *here = &w->chunks[c];
    if (here->full) has_memory = decide_full(w, &w->pairs[(size_t)c * CHUNK], step_get_chunk_size(w, c), here);
    size_t contacts = here->contacts;
    here->contacts = found->count;
    found->count += contacts;
    found->queried += here->queried;
    return has_memory;
}

// One thread writes each chunk at once, while what it reads is in the near caches. 0: no memory.
static int answer_alone(ovoid_world *w, uint32_t chunks, ovoid_contacts *found) {
    int has_memory = 1;
    for (uint32_t c = 0; c < chunks; c++) {
        size_t before = found->count;
        decide_chunks(w, c, c + 1, 0);
        has_memory &= count_chunk(w, c, found);
        has_memory = has_memory && reserve_contacts(w, before, found->count);
        if (has_memory) write_chunk(w, c, before);
    }
    return has_memory;
}

// Several threads decide all chunks, then write them all, when it is known how many contacts come before each.
static int answer_together(ovoid_world *w, uint32_t chunks, ovoid_contacts *found) {
    int has_memory = 1;
    task_host_run(&w->host, &(task){decide_chunks, w, chunks, 1});
    for (uint32_t c = 0; c < chunks; c++) has_memory &= count_chunk(w, c, found);
    if (!has_memory || !reserve_contacts(w, 0, found->count)) return 0;
    task_host_run(&w->host, &(task){write_chunks, w, chunks, 1});
    return 1;
}

// ---- the step

static ovoid_code compute_contacts(ovoid_world *w, const ovoid_contact_query *q, ovoid_contacts *out,
                                   ovoid_error *error) {
    OVOID_ASSERT(w && q && out);
    ovoid_code code = step_validate(q, error);
    if (code != OVOID_OK) return code;
    ovoid_contacts found;
    uint32_t chunks;
    step_take_query(w, q, 0);
    if (!step_begin(w, &chunks, &found)) return step_refuse_memory(error);
    if (!(w->threads == 1 && !w->host.tasks.start ? answer_alone : answer_together)(w, chunks, &found))
        return step_refuse_memory(error);
    step_end(w, &found);
    found.items = w->contacts;
    found.witnesses = world_has_witnesses(w) ? w->contact_witnesses : NULL;
    *out = found;
    return OVOID_OK;
}

ovoid_code ovoid_world_compute_contacts(ovoid_world *w, const ovoid_contact_query *query, ovoid_contacts *contacts,
                                        ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, query, compute_contacts(w, query, contacts, error));
}
