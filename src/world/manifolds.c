// Manifolds of a step: workers find those of their chunks, which are then put one behind the other in the order of the
// list, with their points; and the pairs of the last call that are missing have ended.
#include "base/environment.h"
#include "base/error.h"
#include "manifold/manifold.h"
#include "world/manifold_list.h"
#include "world/material.h"

#include <string.h>

// ---- finding

static void find_chunks(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    ovoid_world *w = work;
    for (uint32_t c = first; c < end && !w->manifolds->rooms[worker].failed; c++) manifolds_find_chunk(w, c, worker);
}

// Where each chunk's manifolds come in the list, and how many there are of all. 0: memory ran out.
static int find_all(ovoid_world *w, uint32_t chunks, ovoid_world_manifolds *found) {
    manifolds *m = w->manifolds;
    if (!world_reserve(w, (void **)&m->chunks, &m->chunk_capacity, 0, chunks, sizeof *m->chunks)) return 0;
    for (uint32_t i = 0; i < w->threads; i++) {
        manifold_room *room = &m->rooms[i];
        room->list.count = room->list.part_count = 0;
        room->failed = 0;
    }
    task_host_run(&w->host, &(task){find_chunks, w, chunks, 1});
    for (uint32_t i = 0; i < w->threads; i++)
        if (m->rooms[i].failed) return 0;
    for (uint32_t c = 0; c < chunks; c++) {
        manifold_chunk *its = &m->chunks[c];
        its->at = found->count;
        its->part_at = found->part_count;
        found->count += its->count;
        found->part_count += its->part_count;
        found->begun += its->begun;
        found->kept += its->kept;
        found->step.queried += its->queried;
    }
    return 1;
}

// ---- writing

static void write_chunk(const manifolds *m, const manifold_chunk *its) {
    const manifold_list *from = &m->rooms[its->worker].list, *to = &m->next;
    for (size_t i = 0; i < its->count; i++) {
        ovoid_world_manifold *item = &to->items[its->at + i];
        *item = from->items[its->first + i];
        item->first = item->first - its->first_part + its->part_at;
    }
    if (!its->part_count) return;
    memcpy(to->parts + its->part_at, from->parts + its->first_part, its->part_count * sizeof *to->parts);
    memcpy(to->points + its->part_at, from->points + its->first_part, its->part_count * sizeof *to->points);
}

static void write_chunks(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    const ovoid_world *w = work;
    (void)worker;
    for (uint32_t c = first; c < end; c++) write_chunk(w->manifolds, &w->manifolds->chunks[c]);
}

static int reserve(ovoid_world *w, const ovoid_world_manifolds *found) {
    manifolds *m = w->manifolds;
    manifold_list *list = &m->next;
    return world_reserve(w, (void **)&list->items, &list->capacity, 0, found->count, sizeof *list->items) &&
           world_reserve(w, (void **)&list->parts, &list->part_capacity, 0, found->part_count, sizeof *list->parts) &&
           world_reserve(w, (void **)&list->points, &list->point_capacity, 0, found->part_count,
                         sizeof *list->points) &&
           world_reserve(w, (void **)&m->ended, &m->ended_capacity, 0, m->last.count, sizeof *m->ended);
}

// ---- pairs that have ended

static int compare(const ovoid_world_manifold *x, const ovoid_world_manifold *y) {
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    return x->b < y->b ? -1 : x->b > y->b;
}

// Both lists are sorted by ids.
static size_t write_ended(manifolds *m) {
    const manifold_list *last = &m->last, *next = &m->next;
    size_t count = 0, at = 0;
    for (size_t i = 0; i < last->count; i++) {
        const ovoid_world_manifold *item = &last->items[i];
        while (at < next->count && compare(&next->items[at], item) < 0) at++;
        if (at < next->count && compare(&next->items[at], item) == 0) continue;
        m->ended[count++] = (ovoid_world_parting){item->a, item->b, item->user_a, item->user_b};
    }
    return count;
}

// ---- the step

static ovoid_code validate(const ovoid_world_manifold_query *q, const ovoid_contact_query *pairs, ovoid_error *error) {
    const ovoid_manifold_options *o = &q->options;
    if (!(o->tolerance >= 0 && o->keep >= 0 && o->angle >= 0 && o->angle <= MANIFOLD_ANGLE))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1,
                         "tolerance %.17g, keep %.17g, angle %.17g: none may be negative or NaN, and the angle at most "
                         "%g",
                         o->tolerance, o->keep, o->angle, MANIFOLD_ANGLE);
    if (!(q->ahead >= 0 && q->ahead <= 100))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "ahead %.17g: it must be in 0 .. 100", q->ahead);
    return step_validate(pairs, error);
}

static int is_same(const ovoid_manifold_options *a, const ovoid_manifold_options *b) {
    return a->margin == b->margin && a->tolerance == b->tolerance && a->keep == b->keep && a->angle == b->angle;
}

static void take_options(ovoid_world *w, const ovoid_manifold_options *options) {
    manifolds *m = w->manifolds;
    m->is_current = m->steps == w->steps && is_same(&m->last_options, options);
    m->options = *options;
    m->options.cover = NULL;
}

// What was found becomes what the next call compares with.
static void commit(ovoid_world *w, ovoid_world_manifolds *found) {
    manifolds *m = w->manifolds;
    manifold_list last = m->last;
    m->next.count = found->count;
    m->next.part_count = found->part_count;
    found->ended_count = write_ended(m);
    m->last = m->next;
    m->next = last;
    m->last_options = m->options;
    m->steps = w->steps;
    found->items = m->last.items;
    found->parts = m->last.parts;
    found->points = m->last.points;
    found->ended = m->ended;
}

static ovoid_code compute_manifolds(ovoid_world *w, const ovoid_world_manifold_query *q, ovoid_world_manifolds *out,
                                    ovoid_error *error) {
    OVOID_ASSERT(w && q && out);
    const ovoid_contact_query pairs = {.kind = OVOID_QUERY_WITHIN, .margin = q->options.margin};
    ovoid_code code = validate(q, &pairs, error);
    if (code != OVOID_OK) return code;
    ovoid_world_manifolds found = {.count = 0};
    uint32_t chunks;
    if (!manifolds_create(w)) return step_refuse_memory(error);
    take_options(w, &q->options);
    step_take_query(w, &pairs, 1);
    if (!material_update_ranges(w, q->ahead) || !step_begin(w, &chunks, &found.step) || !find_all(w, chunks, &found) ||
        !reserve(w, &found))
        return step_refuse_memory(error);
    task_host_run(&w->host, &(task){write_chunks, w, chunks, 1});
    step_end(w, &found.step);
    commit(w, &found);
    *out = found;
    return OVOID_OK;
}

ovoid_code ovoid_world_compute_manifolds(ovoid_world *w, const ovoid_world_manifold_query *query,
                                         ovoid_world_manifolds *out, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, query, compute_manifolds(w, query, out, error));
}
