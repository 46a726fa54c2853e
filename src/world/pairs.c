// The list of pairs whose enlarged boxes overlap, updated for the boxes that changed.
//
// A pair is new if and only if its boxes overlap now and its earlier boxes, `seen`, from which the list was made, did
// not; so the list need not be searched. Workers find the changed bodies' overlaps in the tree; these are sorted and
// merged into the list from the back. Pairs whose boxes no longer overlap are removed during the merge. All memory is
// reserved before the list changes.
#include "world/state.h"

#include "world/tree/dynamic_tree_traverse.h"
#include "world/tree/radix_sort.h"
#include "world/tree/wide_tree.h"

#include <string.h>

enum { LEAST = 64 };

// ---- filters

int world_is_pair(const ovoid_world *w, uint32_t a, uint32_t b) {
    if (!groups_are_paired(&w->bodies[a].groups, &w->bodies[b].groups)) return 0;
    if (w->ignored.count && ignored_is_in(&w->ignored, key_make(a, b))) return 0;
    if (!w->filter) return 1;
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    return w->filter(w->filter_context, body_get_id(w, low), body_get_id(w, high)) != 0;
}

// ---- finding

static int gather(const ovoid_world *w, gathered *g, uint64_t key) {
    if (g->count == g->capacity) {
        size_t room = g->capacity ? 2 * g->capacity : 1024;
        uint64_t *larger = allocator_allocate(&w->allocator, room, sizeof *larger);
        if (!larger) return 0;
        if (g->count) memcpy(larger, g->keys, g->count * sizeof *larger);
        allocator_release(&w->allocator, g->keys);
        g->keys = larger;
        g->capacity = room;
    }
    g->keys[g->count++] = key;
    return 1;
}

// 1 if boxes that overlap now did not overlap when the list was made.
static int is_new(const ovoid_world *w, uint32_t i, uint32_t j, const box *box_j) {
    if (!(w->marks[j] & (MARK_BOX | MARK_FRESH))) return !box_is_overlapping(&w->seen[i], box_j);
    // If both bodies have changed, both find the pair, and the lower index reports it.
    return i < j && !box_is_overlapping(&w->seen[i], &w->seen[j]);
}

// The search for the pairs of one body.
typedef struct pair_search {
    const ovoid_world *w;
    uint32_t body;
    gathered *found;
} pair_search;

static int take_leaf(void *context, const tree_node *leaf) {
    const pair_search *search = context;
    uint32_t i = search->body, j = leaf->body;
    if (j == i || !is_new(search->w, i, j, &leaf->bounds) || !world_is_pair(search->w, i, j)) return 1;
    return gather(search->w, search->found, key_make(i, j));
}

static int find_pairs_of(const ovoid_world *w, uint32_t i, gathered *g) {
    box bounds = w->tree.nodes[w->leaf_of[i]].bounds;
    pair_search search = {w, i, g};
    return dynamic_tree_find_new(&w->tree, &bounds, &w->seen[i], take_leaf, &search);
}

static void find_pairs(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    const ovoid_world *w = work;
    gathered *g = &w->gathered[worker];
    for (uint32_t k = first; k < end && !g->failed; k++) {
        uint32_t i = w->changed[k];
        if (w->leaf_of[i] != NONE) g->failed = !find_pairs_of(w, i, g);
    }
}

// Sorts the changed bodies by their leaves, so that neighbours visit the same nodes. 0 if memory runs out.
static int sort_changed(ovoid_world *w) {
    size_t count = w->changed_count;
    if (!world_reserve(w, (void **)&w->keys, &w->key_capacity, 0, count, 2 * sizeof *w->keys)) return 0;
    for (size_t k = 0; k < count; k++) w->keys[k] = (uint64_t)w->leaf_of[w->changed[k]] << 32 | w->changed[k];
    radix_sort(w->keys, w->keys + w->key_capacity, count);
    for (size_t k = 0; k < count; k++) w->changed[k] = (uint32_t)w->keys[k];
    return 1;
}

// Names the leaves of all changed bodies as fresh for the search, or no longer.
static void set_fresh(ovoid_world *w, int is_fresh) {
    for (uint32_t k = 0; w->tree.wide_count && k < w->changed_count; k++) {
        uint32_t leaf = w->leaf_of[w->changed[k]];
        if (leaf != NONE) wide_tree_set_fresh(&w->tree, leaf, is_fresh);
    }
}

// Building the wide nodes costs as much as they save in this many searches, as a share of all bodies.
enum { WIDEN = 16 };

// Finds all new pairs, sorted, in w->keys; 0 if memory runs out.
static int find_new(ovoid_world *w, size_t *count) {
    if (!sort_changed(w)) return 0;
    if ((uint64_t)w->changed_count * WIDEN > w->count) world_widen_tree(w);
    for (uint32_t k = 0; k < w->threads; k++) w->gathered[k].count = 0, w->gathered[k].failed = 0;
    set_fresh(w, 1);
    task_host_run(&w->host, &(task){find_pairs, w, w->changed_count, LEAST});
    set_fresh(w, 0);
    *count = 0;
    for (uint32_t k = 0; k < w->threads; k++) {
        if (w->gathered[k].failed) return 0;
        *count += w->gathered[k].count;
    }
    // The keys, and as much scratch memory for sorting.
    if (!world_reserve(w, (void **)&w->keys, &w->key_capacity, 0, *count, 2 * sizeof *w->keys)) return 0;
    size_t at = 0;
    for (uint32_t k = 0; k < w->threads; k++) {
        if (w->gathered[k].count) memcpy(w->keys + at, w->gathered[k].keys, w->gathered[k].count * sizeof *w->keys);
        at += w->gathered[k].count;
    }
    if (*count) radix_sort(w->keys, w->keys + w->key_capacity, *count);
    return 1;
}

// ---- the list

// The list is looked through in parts of so many, a bit of `ended` for each; so many pairs ahead leaves are prefetched.
// A worker looks through so many parts at least.
enum { PART = 512, WORDS = PART / 64, AHEAD = 12, LEAST_PARTS = 16 };

static size_t count_parts(size_t pairs) { return (pairs + PART - 1) / PART; }

static int reserve_pairs(ovoid_world *w, size_t count) {
    return world_reserve(w, (void **)&w->pairs, &w->pair_capacity, w->pair_count, count, sizeof *w->pairs) &&
           world_reserve(w, (void **)&w->free_slots, &w->free_slot_capacity, w->free_slot_count, count,
                         sizeof *w->free_slots) &&
           world_reserve(w, (void **)&w->pair_cache, &w->slot_capacity, w->slot_used, count, sizeof *w->pair_cache) &&
           world_reserve(w, (void **)&w->ended, &w->ended_capacity, 0, count_parts(count) * WORDS, sizeof *w->ended);
}

// Prefetches the leaves of a pair whose boxes are compared. A removed body has none, and is MARK_FRESH.
static void prefetch_leaves(const ovoid_world *w, const world_pair *p) {
    if ((w->marks[p->a] | w->marks[p->b]) & MARK_FRESH) return;
    compiler_prefetch(&w->tree.nodes[w->leaf_of[p->a]]);
    compiler_prefetch(&w->tree.nodes[w->leaf_of[p->b]]);
}

// 1 if a pair of which a body has changed is no longer one.
static int has_ended(const ovoid_world *w, const world_pair *p) {
    return (w->marks[p->a] | w->marks[p->b]) & MARK_FRESH ||
           !box_is_overlapping(&w->tree.nodes[w->leaf_of[p->a]].bounds, &w->tree.nodes[w->leaf_of[p->b]].bounds);
}

// The pairs of a part of the list of which a body has changed; their number.
static uint32_t find_changed(const ovoid_world *w, const world_pair *pairs, uint32_t count, uint16_t *changed) {
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; i++) {
        changed[found] = (uint16_t)i;
        found += ((w->marks[pairs[i].a] | w->marks[pairs[i].b]) & (MARK_BOX | MARK_FRESH)) != 0;
    }
    return found;
}

// Moves the pairs from..end - 1 of the list to `to`; the place after them there.
static size_t move_pairs(ovoid_world *w, size_t to, size_t from, size_t end) {
    if (to != from) memmove(&w->pairs[to], &w->pairs[from], (end - from) * sizeof *w->pairs);
    return to + (end - from);
}

// Says in `ended` which pairs of a part of the list are no longer one.
static void find_ended_in(const ovoid_world *w, uint32_t part) {
    uint16_t changed[PART] = {0};
    const world_pair *pairs = &w->pairs[(size_t)part * PART];
    uint64_t *ended = &w->ended[(size_t)part * WORDS];
    size_t rest = w->pair_count - (size_t)part * PART;
    uint32_t count = find_changed(w, pairs, rest < PART ? (uint32_t)rest : PART, changed);
    memset(ended, 0, WORDS * sizeof *ended);
    for (uint32_t k = 0; k < count && k < AHEAD; k++) prefetch_leaves(w, &pairs[changed[k]]);
    for (uint32_t k = 0; k < count; k++) {
        if (k + AHEAD < count) prefetch_leaves(w, &pairs[changed[k + AHEAD]]);
        ended[changed[k] / 64] |= (uint64_t)has_ended(w, &pairs[changed[k]]) << changed[k] % 64;
    }
}

static void find_ended(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    (void)worker;
    for (uint32_t part = first; part < end; part++) find_ended_in(work, part);
}

// Removes pairs whose boxes no longer overlap; the rest keeps its order.
static size_t drop_pairs(ovoid_world *w) {
    size_t parts = count_parts(w->pair_count), to = 0, stays = 0; // pairs from `stays` on are to be moved
    task_host_run(&w->host, &(task){find_ended, w, (uint32_t)parts, LEAST_PARTS});
    for (size_t k = 0; k < parts * WORDS; k++)
        for (uint64_t bits = w->ended[k]; bits; bits &= bits - 1) {
            size_t pair = 64 * k + compiler_count_low_zeros_64(bits);
            w->free_slots[w->free_slot_count++] = w->pairs[pair].slot;
            to = move_pairs(w, to, stays, pair);
            stays = pair + 1;
        }
    return move_pairs(w, to, stays, w->pair_count);
}

static world_pair make_pair(ovoid_world *w, uint64_t key) {
    uint32_t slot = w->free_slot_count ? w->free_slots[--w->free_slot_count] : (uint32_t)w->slot_used++;
    w->pair_cache[slot] = (pair_cache){.proof = OVOID_PROOF_NONE};
    return (world_pair){.a = key_get_a(key), .b = key_get_b(key), .slot = slot};
}

// The number of the first `count` pairs of the list that come before a key, most of them as a rule: the search doubles
// its step from the end, then bisects.
static size_t count_before(const ovoid_world *w, size_t count, uint64_t key) {
    size_t step = 1, end = count, first;
    for (;; end = first, step *= 2) {
        first = end > step ? end - step : 0;
        if (!first || key_make(w->pairs[first].a, w->pairs[first].b) < key) break;
    }
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        if (key_make(w->pairs[middle].a, w->pairs[middle].b) < key)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

// Merges the new keys in from the back, so that nothing is moved twice.
static void merge_pairs(ovoid_world *w, size_t count) {
    size_t old = w->pair_count;
    while (count) {
        uint64_t key = w->keys[--count];
        size_t before = count_before(w, old, key);
        (void)move_pairs(w, before + count + 1, before, old);
        w->pairs[before + count] = make_pair(w, key);
        old = before;
    }
}

int world_update_pairs(ovoid_world *w, ovoid_contacts *counts) {
    size_t fresh = 0;
    if (!w->changed_count) return 1;
    if (!find_new(w, &fresh) || !reserve_pairs(w, w->pair_count + fresh)) return 0;
    size_t stay = drop_pairs(w);
    counts->dropped = w->pair_count - stay;
    counts->added = fresh;
    w->pair_count = stay;
    merge_pairs(w, fresh);
    w->pair_count += fresh;
    for (uint32_t k = 0; k < w->changed_count; k++) {
        w->marks[w->changed[k]] &= (uint8_t) ~(MARK_BOX | MARK_FRESH);
        counts->moved += w->leaf_of[w->changed[k]] != NONE;
    }
    w->changed_count = 0;
    return 1;
}
