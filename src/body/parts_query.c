// Proximity of two bodies: which pair of parts decides, and which exclusions prove it.
//
// Both trees are traversed at once, from the pair of roots down, the nearer children first (S. Quinlan, Efficient
// distance computation between non-convex objects, 1994; E. Larsen, S. Gottschalk, M. C. Lin, D. Manocha, Fast distance
// queries with rectangular swept sphere volumes, 2000). A pair of nodes is pruned where its lower bound (node_bounds.c)
// is above what the goal needs, or not below the best pair's upper bound. A pair of parts is an ordinary query that may
// stop beyond the best upper bound. So the answer's bracket is that of the best pair, its lower end lowered to the
// least bound of all that was pruned.
//
// The traversal's stack is as deep as both trees together; nothing is allocated. At worst every pair of parts is
// queried.
#include "body/exclusions.h"
#include "body/first_look.h"
#include "body/node_bounds.h"
#include "query/answer.h"

typedef struct traversal {
    body_view a, b;
    nodes_frame frame;
    nodes_other turned; ///< a node along the axes of the other body, shared by several of its nodes
    int turned_side;
    ovoid_options options;       ///< of the queries of pairs of parts
    query_goal whole_goal, goal; ///< the query's goal, and what is left of it: once a margin is met, the sign
    double tolerance, allowance; ///< the latter is not in the former
    // The best pair of parts so far, with its answer in *out; place_a is count_a where there is none.
    ovoid_body_answer *out;
    uint32_t place_a, place_b;
    uint32_t warm_a, warm_b; ///< the pair of parts of the earlier proof, or count_a
    double enough;           ///< bounds from here on are pruned: at least the best pair's upper bound
    double lower;            ///< the least lower bound of all that was pruned
    ovoid_limit trouble;     ///< of a pair of parts whose bracket stayed wide, or NONE
    ovoid_exclusions *exclusions;
    // The world poses of the parts queried last.
    ovoid_pair pair;
    uint32_t posed_a, posed_b;
    ovoid_answer spare;
} traversal;

// ---- pruning

// A pair of nodes on the stack, with its lower bound.
typedef struct node_pair {
    const compound_node *a, *b;
    nodes_bound bound;
} node_pair;

// A pair of nodes as the stack holds it: nodes by their places, which takes half the room.
typedef struct stacked_pair {
    uint32_t a, b;
    nodes_bound bound;
} stacked_pair;

// The pairs of a node's children with the other node, the nearer one last. side: 0 where the node is of a, 1 where of
// b.
static void bound_children(traversal *h, int side, const node_pair *w, node_pair two[2]) {
    const compound_node *node = side ? w->b : w->a;
    const compound_node *children[2] = {node_get_right(node), node_get_left(node)};
    // Often that of the pair before, and always where the other body is a shape.
    const compound_node *rest = side ? w->a : w->b;
    if (h->turned.node != rest || h->turned_side != side) {
        h->turned = nodes_turn(&h->frame, side, rest);
        h->turned_side = side;
    }
    double enough = min2(h->goal.far, h->enough);
    nodes_bound bounds[2];
    for (int i = 0; i < 2; i++) bounds[i] = nodes_compute_lower(&h->frame, side, children[i], &h->turned, enough);
    h->out->visited += 2;
    int turned = bounds[0].lower < bounds[1].lower;
    for (int i = 0; i < 2; i++) {
        const compound_node *child = children[i ^ turned];
        two[i].a = side ? rest : child;
        two[i].b = side ? child : rest;
        two[i].bound = bounds[i ^ turned];
    }
}

static node_pair bound_roots(traversal *h, double enough) {
    nodes_other other = nodes_turn(&h->frame, 0, h->b.nodes);
    nodes_bound bound = nodes_compute_lower(&h->frame, 0, h->a.nodes, &other, enough);
    return (node_pair){h->a.nodes, h->b.nodes, bound};
}

static void exclude_nodes(traversal *h, const node_pair *w) {
    h->lower = min2(h->lower, w->bound.lower);
    if (!h->exclusions) return;
    const compound_node *a = w->a, *b = w->b;
    ovoid_exclusion x = {a->first, a->end, b->first, b->end, {0, 0, 0}, {0, 0, 0}, w->bound.lower};
    nodes_means means = w->bound.means;
    x.normal = means < NODES_PARTS
                   ? nodes_compute_normal(&h->frame, a, b, means)
                   : parts_compute_normal(&h->frame, &h->a.parts[a->first], &h->b.parts[b->first], means);
    exclusions_add(h->exclusions, &x);
}

static void take_trouble(traversal *h, const ovoid_answer *x) {
    if (limit_is_stuck(x->limit) && h->trouble == OVOID_LIMIT_NONE) h->trouble = x->limit;
}

static void exclude_parts(traversal *h, uint32_t a, uint32_t b, const ovoid_answer *x) {
    h->lower = min2(h->lower, x->lower);
    take_trouble(h, x);
    if (!h->exclusions) return;
    ovoid_exclusion e = {a, a + 1, b, b + 1, x->proof.normal, x->proof.normal_low, x->lower};
    exclusions_add(h->exclusions, &e);
}

// ---- pairs of parts

// The pair of parts at two places, in the world; a part posed by the last call is reused.
static const ovoid_pair *pose_pair(traversal *h, uint32_t a, uint32_t b) {
    if (h->posed_a != a) {
        ovoid_posed_shape body = body_view_get_part(&h->a, a);
        h->pair.shape_a = body.shape;
        h->pair.pose_a = body.pose;
        h->posed_a = a;
    }
    if (h->posed_b != b) {
        ovoid_posed_shape body = body_view_get_part(&h->b, b);
        h->pair.shape_b = body.shape;
        h->pair.pose_b = body.pose;
        h->posed_b = b;
    }
    return &h->pair;
}

// Lowers the bound from which on pairs are pruned.
static void tighten(traversal *h) {
    const ovoid_answer *best = &h->out->deciding;
    if (h->goal.wants_bracket) {
        // Parts known to within less may have a lower upper bound, whatever their lower one.
        double near = best->upper - h->tolerance;
        h->enough = h->allowance > 0 ? near : min2(best->lower, near);
    }
    // The margin is met: only the sign is left to find.
    if (best->upper <= h->goal.near) h->goal = query_goal_make_collide();
}

static void take_best(traversal *h, uint32_t a, uint32_t b, const ovoid_answer *x) {
    if (h->place_a < h->a.count) exclude_parts(h, h->place_a, h->place_b, &h->out->deciding);
    h->out->deciding = *x;
    h->place_a = a;
    h->place_b = b;
    nodes_frame_set_normal(&h->frame, x->proof.normal);
    tighten(h);
}

// Queries a pair of parts: the query may stop once it is proven not to be nearer than the best pair.
static void visit_parts(traversal *h, uint32_t a, uint32_t b, const ovoid_proof *earlier) {
    query_goal goal = h->goal;
    int has_best = h->place_a < h->a.count;
    if (has_best && goal.wants_bracket && h->out->deciding.upper < goal.far) {
        goal.far = max2(h->enough, 0);
        goal.beyond = OVOID_LIMIT_CAP;
    }
    // The best pair's cover is replaced by that of a deeper one only.
    ovoid_cover *cover = goal.wants_depth && h->exclusions ? h->exclusions->cover : NULL;
    goal.has_cover = has_best;
    if (has_best) goal.covered = h->out->deciding.upper;
    answer_find_internal(pose_pair(h, a, b), &h->options, goal, earlier, cover, &h->spare);
    h->out->tested++;
    if (has_best && !(h->spare.upper < h->out->deciding.upper)) {
        exclude_parts(h, a, b, &h->spare);
        return;
    }
    take_best(h, a, b, &h->spare);
    if (cover && h->spare.proof.kind != OVOID_PROOF_COVER) cover->point_count = cover->triangle_count = 0;
}

// ---- the traversal

// 1 if no pair that is left can change the answer.
static int is_decided(const traversal *h) {
    return h->place_a < h->a.count && h->out->deciding.upper < 0 && !h->goal.wants_depth;
}
static int is_pruned(const traversal *h, double lower) { return lower > h->goal.far || lower >= h->enough; }

// Two parts: the closer bounds of their own spheres and supports, then the query.
static void visit_leaves(traversal *h, node_pair *w) {
    uint32_t a = w->a->first, b = w->b->first;
    if (a == h->warm_a && b == h->warm_b) return;
    w->bound = parts_compute_lower(&h->frame, &h->a.parts[a], &h->b.parts[b], min2(h->goal.far, h->enough));
    if (is_pruned(h, w->bound.lower))
        exclude_nodes(h, w);
    else
        visit_parts(h, a, b, NULL);
}

static stacked_pair stack_pair(const traversal *h, const node_pair *w) {
    return (stacked_pair){(uint32_t)(w->a - h->a.nodes), (uint32_t)(w->b - h->b.nodes), w->bound};
}

static void traverse(traversal *h) {
    // Each step down either tree leaves one pair on the stack.
    stacked_pair stack[2 * COMPOUND_DEPTH_MAX];
    node_pair roots = bound_roots(h, min2(h->goal.far, h->enough)), two[2];
    stack[0] = stack_pair(h, &roots);
    h->out->visited++;
    for (int count = 1; count > 0 && !is_decided(h);) {
        const stacked_pair *top = &stack[--count];
        node_pair w = {h->a.nodes + top->a, h->b.nodes + top->b, top->bound};
        if (is_pruned(h, w.bound.lower)) {
            exclude_nodes(h, &w);
            continue;
        }
        if (node_is_leaf(w.a) && node_is_leaf(w.b)) {
            visit_leaves(h, &w);
            continue;
        }
        bound_children(h, !node_is_split_first(w.a, w.b), &w, two);
        for (int i = 0; i < 2; i++) stack[count++] = stack_pair(h, &two[i]);
    }
}

// Starts with the pair of parts that decided the earlier query. Its indices may be out of range.
static void visit_earlier(traversal *h, const ovoid_body_proof *earlier) {
    if (!earlier || earlier->part_a >= h->a.count || earlier->part_b >= h->b.count) return;
    h->warm_a = h->a.compound ? h->a.compound->places[earlier->part_a] : 0;
    h->warm_b = h->b.compound ? h->b.compound->places[earlier->part_b] : 0;
    visit_parts(h, h->warm_a, h->warm_b, &earlier->proof);
}

// ---- the answer

// A deciding pair that touches within its own tolerance, in which is what far origins hide, keeps its status.
static ovoid_status find_status(const traversal *h, const ovoid_answer *x, double lower) {
    ovoid_status status = bracket_find_status(lower, x->upper, h->tolerance);
    return status == OVOID_UNDECIDED && x->status == OVOID_TOUCHING && lower >= x->lower ? OVOID_TOUCHING : status;
}

static ovoid_limit find_limit(const traversal *h, const final_bracket *b) {
    if (bracket_is_left_open(b, &h->whole_goal)) return OVOID_LIMIT_ALLOWANCE;
    if (bracket_is_narrow(b, &h->whole_goal)) return OVOID_LIMIT_NONE;
    return bracket_find_limit(b, &h->whole_goal, h->trouble);
}

// Where the traversal ended early: one exclusion of all pairs of parts, by the roots.
static void exclude_all(traversal *h) {
    if (h->exclusions) h->exclusions->count = 0;
    node_pair roots = bound_roots(h, INFINITY);
    exclude_nodes(h, &roots);
}

static void finish(traversal *h) {
    ovoid_body_answer *out = h->out;
    if (h->place_a == h->a.count) visit_parts(h, 0, 0, NULL);
    if (is_decided(h)) exclude_all(h);
    ovoid_answer *x = &out->deciding;
    take_trouble(h, x);
    double lower = min2(x->lower, h->lower);
    ovoid_status status = find_status(h, x, lower);
    final_bracket b = {lower, x->upper, h->tolerance + h->allowance, h->allowance, status, x->proof.kind};
    x->limit = find_limit(h, &b);
    x->status = status;
    x->lower = lower;
    out->part_a = body_view_get_index(&h->a, h->place_a);
    out->part_b = body_view_get_index(&h->b, h->place_b);
    exclusions_finish(h->exclusions);
}

// Starts a traversal; the options are set already.
static void traversal_make(traversal *h, query_goal goal) {
    nodes_frame_make(&h->a, &h->b, &h->frame);
    options_take_size(&h->options, h->frame.size);
    h->tolerance = h->options.absolute_tolerance;
    h->allowance = h->a.allowance + h->b.allowance;
    h->whole_goal = h->goal = goal;
    h->enough = h->lower = INFINITY;
    h->place_a = h->warm_a = h->a.count;
    h->place_b = h->warm_b = h->b.count;
    h->posed_a = h->a.count;
    h->posed_b = h->b.count;
    h->trouble = OVOID_LIMIT_NONE;
    h->turned.node = NULL;
    h->turned_side = 0;
}

// The whole traversal, from an earlier proof or NULL. Nodes visited and pairs tested are counted on.
static void search_from(traversal *h, query_goal goal, const ovoid_body_proof *earlier) {
    exclusions_begin(h->exclusions);
    traversal_make(h, goal);
    visit_earlier(h, earlier);
    if (!is_decided(h)) traverse(h);
    finish(h);
}

static void search_parts(const ovoid_body_pair *pair, const ovoid_options *options, query_goal goal,
                         const ovoid_body_proof *earlier, ovoid_exclusions *exclusions, ovoid_body_answer *out) {
    out->part_a = out->part_b = out->visited = out->tested = 0;
    exclusions_begin(exclusions);
    ovoid_cover *cover = exclusions ? exclusions->cover : NULL;
    traversal h;
    ovoid_limit refused = OVOID_LIMIT_OPTIONS;
    if (options_make(options, &h.options) && goal.far >= 0) refused = body_pair_view(pair, &h.a, &h.b);
    if (refused != OVOID_LIMIT_NONE) {
        out->deciding = answer_make_refused(refused);
        return;
    }
    if (!h.a.compound && !h.b.compound) {
        ovoid_pair parts = {pair->a.shape, pair->b.shape, pair->a.pose, pair->b.pose};
        answer_find_internal(&parts, options, goal, earlier ? &earlier->proof : NULL, cover, &out->deciding);
        out->tested = 1;
        return;
    }
    if (goal.far < INFINITY && first_look(&h.a, &h.b, &h.options, &goal, exclusions, out)) return;
    h.out = out;
    h.exclusions = exclusions;
    search_from(&h, goal, earlier);
    if (!earlier || !answer_is_improvable(&out->deciding)) return;
    // No earlier proof makes an answer worse: the query alone, unless only the proof decides it.
    int was_decided = out->deciding.status != OVOID_UNDECIDED;
    search_from(&h, goal, NULL);
    if (was_decided && out->deciding.status == OVOID_UNDECIDED) search_from(&h, goal, earlier);
}

void parts_find_internal(const ovoid_body_pair *pair, const ovoid_options *options, query_goal goal,
                         const ovoid_body_proof *earlier, ovoid_exclusions *exclusions, ovoid_body_answer *out) {
    static const vec3 none = {0, 0, 0};
    search_parts(pair, options, goal, earlier, exclusions, out);
    const ovoid_answer *x = &out->deciding;
    out->status = x->status;
    out->limit = x->limit;
    out->lower = x->lower;
    out->upper = x->upper;
    out->inside = OVOID_BODY_INSIDE_NONE;
    out->component = 0;
    out->parting = out->common = none;
}
