// The list of pairs whose enlarged boxes overlap, updated for the boxes that changed.
//
// A pair is new if and only if its boxes overlap now and its earlier boxes, `seen`, from which the list was made, did
// not; so the list need not be searched. Workers find the changed bodies' overlaps in the tree; these are sorted and
// merged into the list from the back. Pairs whose boxes no longer overlap are removed during the merge. All memory is
// reserved before the list changes.
#include "world/state.h"

#include "world/tree/dynamic_tree_traverse.h"
#include "world/tree/radix_sort.h"

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
    if (!(w->marks[j] & (MARK_BOX | MARK_FRESH))) return !box_is_overlapping(&w->bodies[i].seen, box_j);
    // If both bodies have changed, both find the pair, and the lower index reports it.
    return i < j && !box_is_overlapping(&w->bodies[i].seen, &w->bodies[j].seen);
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
    return dynamic_tree_find_overlaps(&w->tree, &bounds, take_leaf, &search);
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

// Building the wide nodes costs as much as they save in this many searches, as a share of all bodies.
enum { WIDEN = 16 };

// Finds all new pairs, sorted, in w->keys; 0 if memory runs out.
static int find_new(ovoid_world *w, size_t *count) {
    if (!sort_changed(w)) return 0;
    if ((uint64_t)w->changed_count * WIDEN > w->count) world_widen_tree(w);
    for (uint32_t k = 0; k < w->threads; k++) w->gathered[k].count = 0, w->gathered[k].failed = 0;
    task_host_run(&w->host, &(task){find_pairs, w, w->changed_count, LEAST});
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

static int reserve_pairs(ovoid_world *w, size_t count) {
    return world_reserve(w, (void **)&w->pairs, &w->pair_capacity, w->pair_count, count, sizeof *w->pairs) &&
           world_reserve(w, (void **)&w->free_slots, &w->free_slot_capacity, w->free_slot_count, count,
                         sizeof *w->free_slots) &&
           world_reserve(w, (void **)&w->pair_cache, &w->slot_capacity, w->slot_used, count, sizeof *w->pair_cache);
}

// Prefetches the leaves of a pair whose boxes drop_pairs will compare. A removed body has none, and is MARK_FRESH.
static void prefetch_leaves(const ovoid_world *w, const world_pair *p) {
    unsigned marks = w->marks[p->a] | w->marks[p->b];
    if (!(marks & MARK_BOX) || marks & MARK_FRESH) return;
    compiler_prefetch(&w->tree.nodes[w->leaf_of[p->a]]);
    compiler_prefetch(&w->tree.nodes[w->leaf_of[p->b]]);
}

// How many pairs ahead leaves are prefetched.
enum { AHEAD = 12 };

// Removes pairs whose boxes no longer overlap; the rest keeps its order.
static size_t drop_pairs(ovoid_world *w) {
    size_t to = 0;
    for (size_t from = 0; from < w->pair_count; from++) {
        const world_pair *p = &w->pairs[from];
        if (from + AHEAD < w->pair_count) prefetch_leaves(w, p + AHEAD);
        unsigned marks = w->marks[p->a] | w->marks[p->b];
        int ends =
            marks & MARK_FRESH || (marks & MARK_BOX && !box_is_overlapping(&w->tree.nodes[w->leaf_of[p->a]].bounds,
                                                                           &w->tree.nodes[w->leaf_of[p->b]].bounds));
        if (ends) {
            w->free_slots[w->free_slot_count++] = p->slot;
        } else {
            if (to != from) w->pairs[to] = *p;
            to++;
        }
    }
    return to;
}

static world_pair make_pair(ovoid_world *w, uint64_t key) {
    uint32_t slot = w->free_slot_count ? w->free_slots[--w->free_slot_count] : (uint32_t)w->slot_used++;
    w->pair_cache[slot] = (pair_cache){.proof = OVOID_PROOF_NONE};
    return (world_pair){.a = key_get_a(key), .b = key_get_b(key), .slot = slot};
}

// Merges the new keys in from the back, so that nothing is moved twice.
static void merge_pairs(ovoid_world *w, size_t count) {
    size_t old = w->pair_count, at = old + count;
    while (count) {
        const world_pair *last = old ? &w->pairs[old - 1] : NULL;
        uint64_t key = w->keys[count - 1];
        if (last && key_make(last->a, last->b) > key) {
            w->pairs[--at] = *last;
            old--;
        } else {
            w->pairs[--at] = make_pair(w, key);
            count--;
        }
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
