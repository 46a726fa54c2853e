// The nodes of two bodies with a solid: bounds of eight children at a time, and which pairs wait where.
#include "body/solid_search.h"

#include <string.h>

enum { WAITING_ROOM = 1280, HEAP_MOST = 1024 };
_Static_assert(WAITING_ROOM > 2 * (BOX8 - 1) * SOLID_DEPTH_MAX + 1, "the deepest trees leave room for a heap");

// The children of a node that are not left out, farthest first.
typedef struct children {
    waiting_pair pair[BOX8];
    uint32_t count;
} children;

static void insert(children *c, const waiting_pair *w) {
    uint32_t at = c->count++;
    for (; at > 0 && c->pair[at - 1].lower < w->lower; at--) c->pair[at] = c->pair[at - 1];
    c->pair[at] = *w;
}

// A node that is opened, of a (side 0) or of b, and the box of the other body's node beside it.
typedef struct opened_node {
    int side;
    tree_ref node;
    turned_box rest;
} opened_node;

// The bounds of the children of a solid's node, in lanes.
static void bound_boxes(const body_search *state, const opened_node *o, double lower[BOX8]) {
    const ovoid_solid *s = o->side ? state->b.solid : state->a.solid;
    const framed_node framed = {o->side, &s->frames[o->node].axes, &o->rest};
    solid8_other other = tree_frame_turn(&state->frame, &framed, solids_get_normal(state));
    other.unit = s->unit;
    state->solids->kernels->boxes(&s->turned[o->node], &other, lower);
}

// Of the two children of a compound's node.
static void bound_nodes(const body_search *state, const opened_node *o, const tree_ref *two, double lower[BOX8]) {
    const body_tree *tree = o->side ? &state->b : &state->a;
    vec3 normal = solids_get_normal(state);
    for (int i = 0; i < 2; i++) {
        const turned_box own = body_tree_get_turned_box(tree, two[i]);
        const turned_box *a = o->side ? &o->rest : &own, *b = o->side ? &own : &o->rest;
        lower[i] = tree_frame_find_gap(&state->frame, a, b, normal).lower;
    }
}

static void bound_children(body_search *state, const waiting_pair *w, const opened_node *o, children *found) {
    int side = o->side;
    const body_tree *tree = side ? &state->b : &state->a;
    tree_ref all[BOX8];
    uint32_t count = body_tree_get_children(tree, o->node, all);
    double lower[BOX8];
    if (tree->solid)
        bound_boxes(state, o, lower);
    else
        bound_nodes(state, o, all, lower);
    state->out->visited += count;
    found->count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const waiting_pair next = waiting_make(side ? waiting_get_a(w) : all[i], side ? all[i] : waiting_get_b(w),
                                               lower[i] - state->frame.claim, state->solids->normal_count - 1);
        if (!search_is_left_out(state, next.lower))
            insert(found, &next);
        else if (state->exclusions)
            solids_exclude_boxes(state, &next);
        else
            state->lower = min2(state->lower, next.lower);
    }
}

// Children that are triangles, of a node beside a triangle: in lanes.
static void visit_triangles(body_search *state, int side, const children *found) {
    const waiting_pair *any = &found->pair[0];
    triangle_group group;
    group.side = side;
    group.one = ref_get_index(side ? waiting_get_a(any) : waiting_get_b(any));
    group.count = found->count;
    for (uint32_t i = 0; i < found->count; i++) {
        // The nearest first.
        const waiting_pair *w = &found->pair[found->count - 1 - i];
        group.places[i] = ref_get_index(side ? waiting_get_b(w) : waiting_get_a(w));
    }
    solids_visit_triangles(state, &group);
}

// Children wait: boxes that overlap on the stack, since each has to be opened, the others in the heap; where that is
// full on the stack too. Until there is an upper bound the nearest goes on the stack: straight down to a pair of leaves
// costs less than what would be opened without a bound. Triangles beside a triangle are visited at once.
static void pass_on(body_search *state, int side, const children *found, waiting *q) {
    children leaves;
    leaves.count = 0;
    int is_first = !state->has_best && state->goal.wants_bracket;
    for (uint32_t i = 0; i < found->count; i++) {
        const waiting_pair *w = &found->pair[i];
        int is_next = is_first && i + 1 == found->count;
        if (waiting_is_leaves(w) && state->a.solid && state->b.solid)
            leaves.pair[leaves.count++] = *w;
        else if (is_next || !(w->lower > 0 && waiting_push_heap(q, w)))
            waiting_push(q, w);
    }
    if (leaves.count) visit_triangles(state, side, &leaves);
}

box_gap solids_find_roots_gap(const body_search *state) {
    turned_box a = body_tree_get_turned_box(&state->a, body_tree_get_root(&state->a)),
               b = body_tree_get_turned_box(&state->b, body_tree_get_root(&state->b));
    return tree_frame_find_gap(&state->frame, &a, &b, solids_get_normal(state));
}

waiting_pair solids_bound_roots(const body_search *state, double enough) {
    (void)enough;
    uint32_t reason = state->solids->normal_count - 1;
    double gap = reason ? solids_find_roots_gap(state).lower : state->solids->roots.lower;
    return waiting_make(body_tree_get_root(&state->a), body_tree_get_root(&state->b), gap - state->frame.claim, reason);
}

// A node of a solid beside one triangle of the other, if all its children are triangles: they cost no more than their
// boxes. 1 if they were visited.
static int visit_all(body_search *state, const opened_node *o, uint32_t one) {
    const ovoid_solid *own = o->side ? state->b.solid : state->a.solid;
    triangle_group group;
    group.side = o->side;
    group.one = one;
    group.count = own->nodes[o->node].children;
    if (own->boxes[o->node].leaves != (1u << group.count) - 1) return 0;
    memcpy(group.places, own->boxes[o->node].child, group.count * sizeof *group.places);
    solids_visit_triangles(state, &group);
    return 1;
}

static void open_nodes(body_search *state, const waiting_pair *w, waiting *q) {
    const tree_ref ref_a = waiting_get_a(w), ref_b = waiting_get_b(w);
    int side = !trees_split_first(&state->a, ref_a, &state->b, ref_b);
    tree_ref other = side ? ref_a : ref_b;
    opened_node opened;
    opened.side = side;
    opened.node = side ? ref_b : ref_a;
    if (state->a.solid && state->b.solid && ref_is_leaf(other) && visit_all(state, &opened, ref_get_index(other)))
        return;
    opened.rest = body_tree_get_turned_box(side ? &state->a : &state->b, other);
    children found;
    bound_children(state, w, &opened, &found);
    pass_on(state, side, &found, q);
}

// Down a path of both trees each node leaves all its children but one.
static uint32_t find_most_stacked(const body_tree *tree) {
    return tree->solid ? (BOX8 - 1) * tree->solid->depth : tree->compound ? COMPOUND_DEPTH_MAX : 0;
}

static void traverse(body_search *state);
const search_kind solids_kind = {solids_bound_roots, solids_exclude_boxes, solids_visit_leaves, open_nodes,
                                 traverse,           solids_take,          search_query_new};

// The stack is at the beginning of the memory, the heap behind the most that the stack can take.
static void traverse(body_search *state) {
    waiting_pair room[WAITING_ROOM];
    uint32_t most = 1 + find_most_stacked(&state->a) + find_most_stacked(&state->b), left = WAITING_ROOM - most;
    waiting q = {.stack = room, .heap = room + most, .heap_room = left < HEAP_MOST ? left : HEAP_MOST};
    search_traverse(state, &solids_kind, &q);
}
