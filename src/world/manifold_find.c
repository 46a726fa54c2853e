// The manifolds of one chunk of pairs, found in the order of the list. The manifolds of the last call are sorted in the
// same order, so those of each pair are found by going through both at once. A pair that had a manifold is not queried:
// its manifold, found again from the last one, says whether it is within the margin.
#include "body/manifolds/body_manifolds.h"
#include "simd/pair8.h"
#include "world/manifold_list.h"
#include "world/material.h"

// A worker at one chunk.
typedef struct finding {
    ovoid_world *w;
    const manifolds *m;
    manifold_room *room;
    manifold_chunk *chunk;
    size_t cursor; ///< of the last call's manifolds
} finding;

// ---- the manifold of the last call

static uint64_t get_key(const ovoid_world_manifold *item) {
    return key_make((uint32_t)(item->a >> 32), (uint32_t)(item->b >> 32));
}

// The first manifold of the last call whose bodies' indices are not below a key.
static size_t find_first(const manifold_list *list, uint64_t key) {
    size_t first = 0, end = list->count;
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        if (get_key(&list->items[middle]) < key)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

// That of a pair, or NULL. An index that is used again is another body.
static const ovoid_world_manifold *find_earlier(finding *f, const world_pair *p) {
    const manifold_list *last = &f->m->last;
    uint64_t key = key_make(p->a, p->b);
    while (f->cursor < last->count && get_key(&last->items[f->cursor]) < key) f->cursor++;
    if (f->cursor == last->count) return NULL;
    const ovoid_world_manifold *item = &last->items[f->cursor];
    return item->a == body_get_id(f->w, p->a) && item->b == body_get_id(f->w, p->b) ? item : NULL;
}

// ---- what is written of a pair

static void take_part(void *context, const ovoid_body_manifold *part, const ovoid_manifold_points *points) {
    const finding *f = context;
    manifold_room_add_part(f->w, f->room, part, points);
}

static void add_item(finding *f, const world_pair *p, const ovoid_world_manifold *earlier,
                     const ovoid_world_manifold *found) {
    const ovoid_world *w = f->w;
    const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
    ovoid_material of_a = material_get(w, p->a), of_b = material_get(w, p->b);
    ovoid_world_manifold item = {.a = body_get_id(w, p->a),
                                 .b = body_get_id(w, p->b),
                                 .user_a = a->user,
                                 .user_b = b->user,
                                 .verdict = found->verdict,
                                 .margin = w->margin + world_get_pair_range(w, p->a, p->b),
                                 .friction = sqrt(of_a.friction) * sqrt(of_b.friction),
                                 .restitution = max2(of_a.restitution, of_b.restitution),
                                 .first = found->first,
                                 .count = found->count,
                                 .event = earlier ? OVOID_MANIFOLD_STAY : OVOID_MANIFOLD_BEGIN};
    f->chunk->begun += !earlier;
    manifold_room_add(w, f->room, &item);
}

// Takes the manifold of the last call over.
static void keep(finding *f, const world_pair *p, const ovoid_world_manifold *earlier) {
    ovoid_world_manifold found = {
        .verdict = earlier->verdict, .first = f->room->list.part_count, .count = earlier->count};
    for (size_t i = earlier->first; i < earlier->first + earlier->count; i++)
        take_part(f, &f->m->last.parts[i], &f->m->last.points[i]);
    f->chunk->kept += earlier->count;
    add_item(f, p, earlier, &found);
}

// ---- finding

// Of several parts that may touch: touching if each of them is touching or apart.
static ovoid_status find_status(const manifolds_found *found, const ovoid_body_manifold *parts, uint32_t count) {
    if (found->lower > 0) return OVOID_SEPARATED;
    if (found->upper < 0) return OVOID_OVERLAPPING;
    int is_touching = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (parts[i].manifold.status == OVOID_UNDECIDED) return OVOID_UNDECIDED;
        is_touching |= parts[i].manifold.status == OVOID_TOUCHING;
    }
    return is_touching ? OVOID_TOUCHING : OVOID_UNDECIDED;
}

static ovoid_verdict make_verdict(const manifolds_found *found, const ovoid_body_manifold *parts, uint32_t count) {
    ovoid_verdict verdict = {.status = find_status(found, parts, count), .lower = found->lower, .upper = found->upper};
    // Why a bracket is wide: the first reason of a part.
    for (uint32_t i = 0; i < count && verdict.limit == OVOID_LIMIT_NONE; i++) verdict.limit = parts[i].manifold.limit;
    if (!count && verdict.status == OVOID_UNDECIDED) verdict.limit = OVOID_LIMIT_PRECISION;
    return verdict;
}

static ovoid_verdict get_verdict(const pair_cache *cache) {
    return (ovoid_verdict){(ovoid_status)cache->status,
                           (ovoid_stage)cache->stage,
                           (ovoid_limit)cache->limit,
                           cache->iterations,
                           cache->lower,
                           cache->upper};
}

// The bounds of the manifolds become those that the pair's cache has. Of two shapes the lower one is a gap along the
// normal.
static void cache_bounds(const ovoid_world *w, world_pair *p, const ovoid_verdict *verdict, vec3 normal) {
    pair_cache *cache = &w->pair_cache[p->slot];
    cache->status = (uint8_t)verdict->status;
    cache->stage = (uint8_t)verdict->stage;
    cache->limit = (uint8_t)verdict->limit;
    cache->iterations = 0;
    cache->lower = verdict->lower;
    cache->upper = verdict->upper;
    cache->normal = normal;
    pair_renew(w, p, cache);
}

static ovoid_limit find_parts(finding *f, const world_pair *p, const ovoid_world_manifold *earlier,
                              manifolds_found *found) {
    const ovoid_world *w = f->w;
    const ovoid_body_pair both = {w->bodies[p->a].body, w->bodies[p->b].body};
    ovoid_manifold_options options = f->m->options;
    manifolds_request request = {.options = &options, .has_points = 1, .take = take_part, .context = f};
    options.margin = min2(w->margin + world_get_pair_range(w, p->a, p->b), OVOID_LENGTH_MAX);
    if (earlier && earlier->count) {
        request.earlier = &f->m->last.parts[earlier->first];
        request.earlier_count = earlier->count;
    }
    return body_manifolds_find_internal(&both, &request, found);
}

static void find_pair(finding *f, world_pair *p, int is_answered) {
    ovoid_world *w = f->w;
    const ovoid_world_manifold *earlier = find_earlier(f, p);
    if (is_answered && earlier && f->m->is_current) {
        keep(f, p, earlier);
        return;
    }
    int is_queried = !is_answered && !(earlier && earlier->count);
    if (is_queried) pair_update(w, p);
    if (is_queried && !(p->flags & PAIR_CONTACT)) return;
    manifold_list *list = &f->room->list;
    manifolds_found found;
    ovoid_world_manifold item = {.first = list->part_count};
    ovoid_limit refused = find_parts(f, p, earlier, &found);
    if (f->room->failed) return;
    if (refused != OVOID_LIMIT_NONE) {
        // Two solids: what the query of the pair says.
        if (!is_queried && !is_answered) pair_update(w, p);
        item.verdict = get_verdict(&w->pair_cache[p->slot]);
        item.verdict.limit = refused;
        if (p->flags & PAIR_CONTACT) add_item(f, p, earlier, &item);
        return;
    }
    if (found.lower > w->margin + world_get_pair_range(w, p->a, p->b)) {
        // Apart: how long this holds, the query of the pair says better.
        if (!is_queried) pair_update(w, p);
        p->flags &= (uint16_t)~PAIR_CONTACT;
        return;
    }
    item.count = (uint32_t)(list->part_count - item.first);
    ovoid_body_manifold *parts = list->parts + item.first;
    if (item.count > 1) {
        item.count = (uint32_t)body_manifolds_sort(parts, list->points + item.first, item.count);
        list->part_count = item.first + item.count;
    }
    item.verdict = make_verdict(&found, parts, item.count);
    int has_solid = w->bodies[p->a].body.solid || w->bodies[p->b].body.solid;
    cache_bounds(w, p, &item.verdict, item.count == 1 && !has_solid ? parts->manifold.normal : (vec3){0, 0, 0});
    p->flags |= PAIR_CONTACT;
    add_item(f, p, earlier, &item);
}

// The pairs to look at: those that are not answered, and those that are in contact.
static uint32_t list_pairs(ovoid_world *w, world_pair *pairs, uint32_t count, uint16_t items[CHUNK],
                           uint8_t answered[CHUNK]) {
    uint32_t listed = 0;
    unsigned some = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (i % PAIR8 == 0) some = step_find_answered(w, &pairs[i], count - i < PAIR8 ? count - i : PAIR8);
        int is_answered = some >> i % PAIR8 & 1;
        items[listed] = (uint16_t)i;
        answered[listed] = (uint8_t)is_answered;
        listed += !is_answered || pairs[i].flags & PAIR_CONTACT;
    }
    return listed;
}

void manifolds_find_chunk(ovoid_world *w, uint32_t c, uint32_t worker) {
    manifolds *m = w->manifolds;
    world_pair *pairs = &w->pairs[(size_t)c * CHUNK];
    uint16_t items[CHUNK];
    uint8_t answered[CHUNK];
    uint32_t listed = list_pairs(w, pairs, step_get_chunk_size(w, c), items, answered);
    finding f = {.w = w, .m = m, .room = &m->rooms[worker], .chunk = &m->chunks[c]};
    const manifold_list *list = &f.room->list;
    *f.chunk = (manifold_chunk){.worker = worker, .first = list->count, .first_part = list->part_count};
    if (listed) f.cursor = find_first(&m->last, key_make(pairs[items[0]].a, pairs[items[0]].b));
    for (uint32_t i = 0; i < listed && !f.room->failed; i++) {
        step_prefetch(w, pairs, items, i, listed);
        find_pair(&f, &pairs[items[i]], answered[i]);
        f.chunk->queried += !answered[i];
    }
    f.chunk->count = list->count - f.chunk->first;
    f.chunk->part_count = list->part_count - f.chunk->first_part;
}
