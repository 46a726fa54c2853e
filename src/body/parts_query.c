// The search of two bodies without a solid: shapes and compounds. The bounds of nodes are those of node_bounds.c, two
// parts are an ordinary query, which may stop beyond the best upper bound.
#include "body/body_find.h"
#include "body/traverse.h"
#include "exact/cover_memory.h"

// ---- what is left out

static const compound_node *get_node(const body_search *state, int side, tree_ref ref) {
    return &state->parts->nodes[side][ref_get_index(ref)];
}
static tree_ref get_ref(const body_search *state, int side, const compound_node *node) {
    return (tree_ref)(node - state->parts->nodes[side]) | (node_is_leaf(node) ? TREE_LEAF : 0);
}

static vec3 find_normal(const body_search *state, const compound_node *a, const compound_node *b, nodes_means means) {
    const compound_part *const *parts = state->parts->parts;
    if (means == NODES_NORMAL) return state->parts->direction.normal;
    return means == NODES_PARTS ? parts_compute_normal(&state->frame, &parts[0][a->first], &parts[1][b->first])
                                : nodes_compute_normal(&state->frame, a, b, means);
}

static void exclude_nodes(body_search *state, const waiting_pair *w) {
    state->lower = min2(state->lower, w->lower);
    if (!state->exclusions) return;
    const compound_node *a = get_node(state, 0, waiting_get_a(w)), *b = get_node(state, 1, waiting_get_b(w));
    ovoid_exclusion x = {a->first, a->end, b->first, b->end, {0, 0, 0}, {0, 0, 0}, w->lower};
    x.normal = find_normal(state, a, b, (nodes_means)waiting_get_reason(w));
    exclusions_add(state->exclusions, &x);
}

static int take(body_search *state, const leaf_pair *pair) {
    if (!search_take(state, pair)) return 0;
    state->parts->direction = parts_direction_make(&state->frame, pair->normal);
    return 1;
}

// ---- the steps of the traversal

static waiting_pair bound_roots(const body_search *state, double enough) {
    const compound_node *a = state->parts->nodes[0], *b = state->parts->nodes[1];
    nodes_other other = nodes_turn(&state->frame, 0, b);
    nodes_bound bound = nodes_compute_lower(&state->frame, a, &other, enough);
    return waiting_make(get_ref(state, 0, a), get_ref(state, 1, b), bound.lower, bound.means);
}

// Two parts: the closer bounds of their own spheres and supports, then the query.
static void visit_leaves(body_search *state, const waiting_pair *w) {
    const parts_state *parts = state->parts;
    uint32_t a = get_node(state, 0, waiting_get_a(w))->first, b = get_node(state, 1, waiting_get_b(w))->first;
    if (a == state->warm_a && b == state->warm_b) return;
    const part_pair pair = {&parts->parts[0][a], &parts->parts[1][b]};
    nodes_bound bound = parts_compute_lower(&state->frame, &parts->direction, &pair, min2(state->far, state->enough));
    if (!search_is_left_out(state, bound.lower)) {
        state->kind->query_leaves(state, a, b);
        return;
    }
    const waiting_pair closer = waiting_make(waiting_get_a(w), waiting_get_b(w), bound.lower, bound.means);
    exclude_nodes(state, &closer);
}

// The other node of a pair, along the axes of the body whose node is opened: often that of the pair before, and always
// where the other body is a shape.
static inline const nodes_other *turn(body_search *state, int side, const compound_node *rest) {
    parts_state *parts = state->parts;
    if (parts->turned.node != rest || parts->turned.side != side) parts->turned = nodes_turn(&state->frame, side, rest);
    return &parts->turned;
}

// The children of a node of a tree in preorder, the right one first.
static inline void get_children(const compound_node *node, tree_ref ref, tree_ref children[2]) {
    const compound_node *left = node + 1;
    uint32_t below = left->end - left->first, all = node->end - node->first;
    children[1] = (ref + 1) | (below == 1 ? TREE_LEAF : 0);
    children[0] = (ref + 2 * below) | (all - below == 1 ? TREE_LEAF : 0);
}

// The pairs of a node's children with the other node wait, the nearer one on top.
COMPILER_INLINED void open_nodes(body_search *state, const waiting_pair *w, waiting *q) {
    const tree_ref ref_a = waiting_get_a(w), ref_b = waiting_get_b(w);
    const compound_node *a = get_node(state, 0, ref_a), *b = get_node(state, 1, ref_b);
    int side = ref_is_leaf(ref_b) ? 0 : ref_is_leaf(ref_a) || a->radius < b->radius;
    const nodes_other *other = turn(state, side, side ? a : b);
    double enough = min2(state->far, state->enough);
    tree_ref children[2];
    nodes_bound bounds[2];
    get_children(side ? b : a, side ? ref_b : ref_a, children);
    for (int i = 0; i < 2; i++)
        bounds[i] = nodes_compute_lower(&state->frame, get_node(state, side, children[i]), other, enough);
    state->out->visited += 2;
    int turned = bounds[0].lower < bounds[1].lower;
    for (int i = 0; i < 2; i++) {
        tree_ref child = children[i ^ turned];
        const nodes_bound *bound = &bounds[i ^ turned];
        const waiting_pair next = waiting_make(side ? ref_a : child, side ? child : ref_b, bound->lower, bound->means);
        waiting_push(q, &next);
    }
}

static void traverse(body_search *state);
const search_kind parts_kind = {bound_roots, exclude_nodes, visit_leaves, open_nodes, traverse, take, search_query_new};

static void traverse(body_search *state) {
    // Each step down either tree leaves one pair on the stack.
    waiting_pair stack[2 * COMPOUND_DEPTH_MAX];
    waiting q = {.stack = stack};
    if (!search_is_decided(state)) search_traverse(state, &parts_kind, &q);
}

// ---- the query

// The nodes and parts of a body; a shape beside a compound is one node.
static void set_nodes(parts_state *parts, int side, const body_tree *tree) {
    if (tree->compound) {
        parts->nodes[side] = tree->compound->nodes;
        parts->parts[side] = tree->compound->parts;
        return;
    }
    const ovoid_posed_shape own = {tree->shape, {{0, 0, 0}, {1, 0, 0, 0}}};
    parts->own_node = node_make_shape(tree->shape);
    parts->own_part = part_make(&own);
    parts->nodes[side] = &parts->own_node;
    parts->parts[side] = &parts->own_part;
}

static void begin_again(body_search *state, const query_goal *goal) {
    search_begin(state, goal);
    state->parts->direction = (parts_direction){.offset = 0};
    state->parts->turned.node = NULL;
}

// The nodes are set.
static void begin(body_search *state, const query_goal *goal) {
    tree_frame_make(&state->a, &state->b, &state->frame);
    options_take_size(&state->options, state->frame.size);
    state->tolerance = state->slack = state->options.absolute_tolerance;
    state->least_far = 0;
    begin_again(state, goal);
}

void parts_begin(body_search *state, const query_goal *goal) {
    set_nodes(state->parts, 0, &state->a);
    set_nodes(state->parts, 1, &state->b);
    begin(state, goal);
}

// From an earlier proof or NULL. Nodes visited and pairs tested are counted on.
static void search_from(body_search *state, const query_goal *goal, const ovoid_body_proof *earlier) {
    begin_again(state, goal);
    search_run(state, earlier);
}

static void find(body_search *state, const query_goal *goal, const ovoid_body_proof *earlier) {
    begin(state, goal);
    search_run(state, earlier);
    const ovoid_answer *x = &state->out->deciding;
    if (!earlier || !answer_is_improvable(x)) return;
    // No earlier proof makes an answer worse: the query alone, unless only the proof decides it.
    int was_decided = x->status != OVOID_UNDECIDED;
    search_from(state, goal, NULL);
    if (was_decided && x->status == OVOID_UNDECIDED) search_from(state, goal, earlier);
}

static int search_parts(body_search *state, const ovoid_body_pair *pair, const body_request *request, far_bodies *far) {
    ovoid_body_answer *out = state->out;
    const query_goal *goal = request->goal;
    const ovoid_body_proof *earlier = request->earlier;
    out->part_a = out->part_b = out->visited = out->tested = 0;
    exclusions_begin(state->exclusions);
    ovoid_cover *cover = goal->wants_depth && state->exclusions ? state->exclusions->cover : NULL;
    ovoid_options given = request->options ? *request->options : (ovoid_options){0, 0, 0, 0};
    given.iterations = cover_get_iterations(cover, given.iterations);
    ovoid_limit refused = OVOID_LIMIT_OPTIONS;
    if (options_make(&given, &state->options) && goal->far >= 0) refused = body_trees_make(pair, &state->a, &state->b);
    if (refused == OVOID_LIMIT_NONE && cover && !cover_has_memory(cover)) refused = OVOID_LIMIT_MEMORY;
    if (refused != OVOID_LIMIT_NONE) {
        out->deciding = answer_make_refused(refused);
        return 0;
    }
    if (pair->a.shape && pair->b.shape) {
        ovoid_pair shapes = {pair->a.shape, pair->b.shape, pair->a.pose, pair->b.pose};
        const query_request of_shapes = {&given, goal, earlier ? &earlier->proof : NULL, cover, NULL};
        answer_find_internal(&shapes, &of_shapes, &out->deciding);
        out->tested = 1;
        return 0;
    }
    set_nodes(state->parts, 0, &state->a);
    set_nodes(state->parts, 1, &state->b);
    if (goal->far < INFINITY && first_look(state, goal, NULL, far)) return 1;
    find(state, goal, earlier);
    return 0;
}

int parts_find(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out, far_bodies *far) {
    static const vec3 none = {0, 0, 0};
    parts_state parts;
    body_search state;
    state.kind = &parts_kind;
    state.has_solid = 0;
    state.parts = &parts;
    state.solids = NULL;
    state.out = out;
    state.exclusions = request->exclusions;
    if (search_parts(&state, pair, request, far)) return 1;
    const ovoid_answer *x = &out->deciding;
    out->status = x->status;
    out->limit = x->limit;
    out->lower = x->lower;
    out->upper = x->upper;
    out->inside = OVOID_BODY_INSIDE_NONE;
    out->component = 0;
    out->parting = out->common = none;
    return 0;
}
