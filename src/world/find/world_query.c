// Queries of a world between its steps: which bodies touch a body or a probe, which is nearest to it, which two of all
// are nearest. The tree is traversed with the body's own box; the remaining pairs are queried without a warm start, so
// nothing is changed or cached, and any number of threads may query at once.
#include "base/environment.h"
#include "base/error.h"
#include "compound/compound.h"
#include "tools/heap.h"
#include "world/body_bounds.h"
#include "world/find/bodies_query.h"
#include "world/state.h"
#include "world/tree/dynamic_tree_traverse.h"

#include <string.h>

// A search: the querying body, the goal, and the best hit so far.
typedef struct world_search {
    const ovoid_world *w;
    ovoid_body body;
    uint32_t self, after; ///< the querying body, or NONE for a probe; only bodies with higher indices than `after` are
                          ///< queried, NONE: all
    ovoid_groups groups;
    box bounds;
    ovoid_options options;
    query_goal goal;
    double bound; ///< of the traversal, length
    double lower; ///< the least lower bound of all pairs queried
    ovoid_body_answer found;
    uint32_t found_a, found_b;
    // Overlaps, in the caller's memory.
    ovoid_world_hit *hits;
    size_t capacity, count;
} world_search;

// ---- the search

static void set_box(world_search *state) {
    body_sphere ball = body_compute_sphere(&state->body);
    state->bounds = body_compute_box(&state->body, &ball);
}

static void take_body(world_search *state, uint32_t i) {
    state->self = i;
    state->body = state->w->bodies[i].body;
    set_box(state);
}

static ovoid_code take_probe(world_search *state, const ovoid_world_body *probe, ovoid_error *error) {
    ovoid_code code = world_validate_body(&probe->body, -1, error);
    if (code != OVOID_OK) return code;
    state->self = NONE;
    state->body = probe->body;
    state->groups = groups_make(probe->groups);
    set_box(state);
    return OVOID_OK;
}

static void world_search_make(world_search *state, const ovoid_world *w) {
    state->w = w;
    state->after = state->found_a = state->found_b = NONE;
    state->bound = state->lower = INFINITY;
    state->hits = NULL;
    state->capacity = state->count = 0;
}

// ---- leaves

static int is_queried(const world_search *state, uint32_t j) {
    const world_body *b = &state->w->bodies[j];
    if (state->self == NONE) return groups_are_paired(&state->groups, &b->groups);
    return j != state->self && (state->after == NONE || j > state->after) && world_is_pair(state->w, state->self, j);
}

static void query_body(const world_search *state, uint32_t j, ovoid_body_answer *out) {
    const ovoid_body_pair pair = {state->body, state->w->bodies[j].body};
    bodies_query(&pair, &state->options, &state->goal, out);
}

static double measure_distance(const void *context, const box *bounds) {
    const world_search *state = context;
    return box_compute_distance(&state->bounds, bounds);
}

static void visit_nearest(void *context, uint32_t j) {
    world_search *state = context;
    if (!is_queried(state, j)) return;
    ovoid_body_answer out;
    state->goal.far = state->bound;
    query_body(state, j, &out);
    state->lower = min2(state->lower, out.lower);
    if (!(out.upper <= state->bound)) return;
    state->found = out;
    state->found_a = state->self;
    state->found_b = j;
    // No pair is nearer than one that overlaps.
    state->bound = out.upper > 0 ? out.upper : -INFINITY;
}

static int find_touch(void *context, const tree_node *leaf) {
    world_search *state = context;
    uint32_t j = leaf->body;
    if (!is_queried(state, j)) return 1;
    ovoid_body_answer out;
    query_body(state, j, &out);
    if (out.lower > 0) return 1;
    state->found = out;
    state->found_a = state->self;
    state->found_b = j;
    return 0;
}

static ovoid_id get_id(const ovoid_world *w, uint32_t i) { return i == NONE ? 0 : body_get_id(w, i); }

static void visit_overlaps(void *context, uint32_t j) {
    world_search *state = context;
    if (!is_queried(state, j)) return;
    ovoid_body_answer out;
    query_body(state, j, &out);
    if (out.lower > state->goal.far) return;
    if (state->count < state->capacity)
        state->hits[state->count] =
            (ovoid_world_hit){get_id(state->w, state->self), body_get_id(state->w, j), out.lower, out};
    state->count++;
}

static void run(world_search *state, tree_visit *visit) {
    tree_traversal all = {&state->w->tree, measure_distance, visit, state, &state->bound};
    dynamic_tree_find_nearest(&all);
}

// ---- queries

static void write_hit(const world_search *state, ovoid_world_hit *hit) {
    if (state->found_b == NONE) {
        memset(hit, 0, sizeof *hit);
        hit->lower = min2(state->lower, state->bound);
        return;
    }
    *hit = (ovoid_world_hit){get_id(state->w, state->found_a), body_get_id(state->w, state->found_b),
                             min2(state->lower, state->found.lower), state->found};
}

// The options and the querying body of a query.
static ovoid_code take_query(world_search *state, const ovoid_world_query *query, ovoid_error *error) {
    ovoid_code code = options_validate(query->options, &state->options, error);
    if (code != OVOID_OK) return code;
    if (query->id == 0 && !query->probe)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a query names a body of the world or has a probe");
    if (query->id == 0) return take_probe(state, query->probe, error);
    uint32_t i = world_find_body(state->w, query->id);
    if (i == NONE) return world_refuse_id(error, -1, query->id);
    take_body(state, i);
    return OVOID_OK;
}

static ovoid_code find_nearest(const ovoid_world *w, const ovoid_world_query *query, ovoid_world_hit *hit,
                               ovoid_error *error) {
    OVOID_ASSERT(w && query && hit);
    world_search state;
    world_search_make(&state, w);
    ovoid_code code = take_query(&state, query, error);
    if (code != OVOID_OK) return code;
    state.bound = state.options.cap;
    state.goal = query_goal_make_distance(NULL);
    run(&state, visit_nearest);
    write_hit(&state, hit);
    return OVOID_OK;
}

ovoid_code ovoid_world_find_nearest(const ovoid_world *w, const ovoid_world_query *query, ovoid_world_hit *hit,
                                    ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, find_nearest(w, query, hit, error));
}

// For each of the named bodies, or for all, a query with those of higher indices.
static ovoid_code find_any(const ovoid_world *w, const ovoid_world_ids *named, ovoid_world_hit *hit,
                           ovoid_error *error) {
    OVOID_ASSERT(w && hit && (!named || named->items || !named->count));
    const ovoid_id *ids = named ? named->items : NULL;
    size_t count = named ? named->count : w->used;
    world_search state;
    world_search_make(&state, w);
    ovoid_code code = options_validate(NULL, &state.options, error);
    for (size_t k = 0; ids && k < count && code == OVOID_OK; k++)
        if (world_find_body(w, ids[k]) == NONE) code = world_refuse_id(error, (int64_t)k, ids[k]);
    if (code != OVOID_OK) return code;
    state.goal = query_goal_make_collide();
    for (size_t k = 0; k < count && state.found_b == NONE; k++) {
        uint32_t i = ids ? (uint32_t)(ids[k] >> 32) : (uint32_t)k;
        if (w->leaf_of[i] == NONE) continue;
        take_body(&state, i);
        if (!named) state.after = i;
        (void)dynamic_tree_find_overlaps(&w->tree, &state.bounds, find_touch, &state);
    }
    state.bound = 0;
    write_hit(&state, hit);
    return OVOID_OK;
}

ovoid_code ovoid_world_find_any(const ovoid_world *w, const ovoid_world_ids *ids, ovoid_world_hit *hit,
                                ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, find_any(w, ids, hit, error));
}

// ---- overlaps

static int is_after(const void *items, size_t i, size_t k) {
    const ovoid_world_hit *hits = items;
    return hits[i].b > hits[k].b;
}

static void exchange(void *items, size_t i, size_t k) {
    ovoid_world_hit *hits = items, swapped = hits[i];
    hits[i] = hits[k];
    hits[k] = swapped;
}

static void sort_hits(ovoid_world_hit *hits, size_t count) {
    heap_sort(&(heap_places){hits, is_after, exchange}, count);
}

static ovoid_code find_overlaps(const ovoid_world *w, const ovoid_world_query *query, ovoid_world_hits *hits,
                                ovoid_error *error) {
    OVOID_ASSERT(w && query && hits);
    double margin = query->margin;
    world_search state;
    world_search_make(&state, w);
    if (!(margin >= 0 && margin <= OVOID_LENGTH_MAX))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "margin %.17g: it must be finite and not negative", margin);
    ovoid_code code = take_query(&state, query, error);
    if (code != OVOID_OK) return code;
    state.hits = hits->items;
    state.capacity = hits->items ? hits->capacity : 0;
    state.goal = margin > 0 ? query_goal_make_within(margin) : query_goal_make_collide();
    state.bound = margin;
    run(&state, visit_overlaps);
    hits->count = state.count;
    sort_hits(state.hits, state.count < state.capacity ? state.count : state.capacity);
    return OVOID_OK;
}

ovoid_code ovoid_world_find_overlaps(const ovoid_world *w, const ovoid_world_query *query, ovoid_world_hits *hits,
                                     ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, find_overlaps(w, query, hits, error));
}

// ---- the nearest two of all

typedef struct couple_entry {
    uint32_t a, b;
    double key;
} couple_entry;

// The largest number of waiting couples: two for each step down, of either tree.
enum { COUPLES = 192 };

static void visit_pair(world_search *state, uint32_t i, uint32_t j) {
    take_body(state, i < j ? i : j);
    visit_nearest(state, i < j ? j : i);
}

// Handles two subtrees when the stack is full: all leaves of one against the other.
static void run_pair_below(world_search *state, uint32_t a, uint32_t b) {
    const dynamic_tree *t = &state->w->tree;
    uint32_t end_a = dynamic_tree_skip(t, a), end_b = dynamic_tree_skip(t, b);
    for (uint32_t i = a; i != end_a; i = t->nodes[i].child ? t->nodes[i].child : dynamic_tree_skip(t, i)) {
        const tree_node *leaf = &t->nodes[i];
        for (uint32_t j = b; j != end_b && !leaf->child;) {
            const tree_node *n = &t->nodes[j];
            int is_near = box_compute_distance(&leaf->bounds, &n->bounds) <= state->bound;
            if (is_near && !n->child && (a != b || leaf->body < n->body)) visit_pair(state, leaf->body, n->body);
            j = is_near && n->child ? n->child : dynamic_tree_skip(t, j);
        }
    }
}

static couple_entry make_entry(const world_search *state, uint32_t a, uint32_t b) {
    const tree_node *nodes = state->w->tree.nodes;
    return (couple_entry){a, b, a == b ? 0 : box_compute_distance(&nodes[a].bounds, &nodes[b].bounds)};
}

// Pushes the pairs of children of a pair of nodes, the nearer one on top.
static uint32_t push_below(const world_search *state, couple_entry e, couple_entry *stack, uint32_t count) {
    const tree_node *nodes = state->w->tree.nodes, *a = &nodes[e.a], *b = &nodes[e.b];
    if (e.a == e.b) {
        if (!a->child) return count;
        stack[count++] = make_entry(state, a->child, a->child + 1);
        stack[count++] = make_entry(state, a->child + 1, a->child + 1);
        stack[count++] = make_entry(state, a->child, a->child);
        return count;
    }
    int splits_a = a->child && (!b->child || box_compute_surface(&a->bounds) >= box_compute_surface(&b->bounds));
    couple_entry left = splits_a ? make_entry(state, a->child, e.b) : make_entry(state, e.a, b->child);
    couple_entry right = splits_a ? make_entry(state, a->child + 1, e.b) : make_entry(state, e.a, b->child + 1);
    int is_right_first = right.key < left.key;
    stack[count++] = is_right_first ? left : right;
    stack[count++] = is_right_first ? right : left;
    return count;
}

static void run_pairs(world_search *state) {
    const tree_node *nodes = state->w->tree.nodes;
    couple_entry stack[COUPLES + 3];
    uint32_t count = 0;
    if (state->w->count > 1) stack[count++] = make_entry(state, 0, 0);
    while (count) {
        couple_entry e = stack[--count];
        if (!(e.key <= state->bound)) continue;
        if (e.a != e.b && !nodes[e.a].child && !nodes[e.b].child)
            visit_pair(state, nodes[e.a].body, nodes[e.b].body);
        else if (count >= COUPLES)
            run_pair_below(state, e.a, e.b);
        else
            count = push_below(state, e, stack, count);
    }
}

static ovoid_code find_nearest_pair(const ovoid_world *w, const ovoid_options *options, ovoid_world_hit *hit,
                                    ovoid_error *error) {
    OVOID_ASSERT(w && hit);
    world_search state;
    world_search_make(&state, w);
    ovoid_code code = options_validate(options, &state.options, error);
    if (code != OVOID_OK) return code;
    state.bound = state.options.cap;
    state.goal = query_goal_make_distance(NULL);
    run_pairs(&state);
    write_hit(&state, hit);
    return OVOID_OK;
}

ovoid_code ovoid_world_find_nearest_pair(const ovoid_world *w, const ovoid_options *options, ovoid_world_hit *hit,
                                         ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, find_nearest_pair(w, options, hit, error));
}
