// Proximity of two solids: which parts decide, and what excludes the others.
//
// Both trees are walked at once, from the pair of roots down, the nearer children first (S. Quinlan, Efficient distance
// computation between non-convex objects, 1994; E. Larsen, S. Gottschalk, M. C. Lin, D. Manocha, Fast distance queries
// with rectangular swept sphere volumes, 2000). A pair of nodes is left out where its lower bound (nodes.c) is above
// what the question asks, or not below what the best pair of parts so far is known to be. A pair of parts is an
// ordinary query, which is told that it may stop beyond the best upper bound. So the answer's bracket is that of the
// best pair, its lower end lowered to the least bound of all that was left out.
//
// The walk's stack is as deep as both trees together; nothing is allocated. At worst every pair of parts is looked at.
#include "base/environment.h"
#include "base/error.h"
#include "query/answer.h"
#include "scene/nodes.h"

typedef struct hunt {
    solid_view a, b;
    nodes_frame frame;
    nodes_other turned; ///< a node as the children of a node of `turned_side` see it
    int turned_side;
    ovoid_options options; ///< for pairs of parts
    question asked, ask;   ///< as asked, and what is left of it: once a margin is met, the sign
    double tolerance;
    // The best pair of parts so far: its answer is in *out; place_a is count_a where there is none.
    ovoid_compound_answer *out;
    uint32_t place_a, place_b;
    uint32_t warm_a, warm_b; ///< the pair that was looked at first, likewise
    double enough;           ///< what is not below it cannot matter: a bound of the best pair
    double lower;            ///< of all that was left out
    ovoid_limit trouble;     ///< of a pair of parts whose bracket stayed wide
    ovoid_exclusions *exclusions;
    // The world poses of the parts asked for last.
    ovoid_pair pair;
    uint32_t posed_a, posed_b;
    ovoid_answer spare;
} hunt;

static int are_numbers_sound(const ovoid_options *o, const question *ask) {
    if (!(ask->far >= 0)) return 0;
    return !o || (o->absolute_tolerance >= 0 && o->relative_tolerance >= 0 && o->cap >= 0);
}

int solid_view_make(const ovoid_solid *solid, solid_view *v) {
    OVOID_ASSERT((solid->shape != NULL) != (solid->compound != NULL));
    if (pose_compute_check(&solid->pose) != OVOID_OK) return 0;
    v->pose = &solid->pose;
    v->compound = solid->compound;
    if (v->compound) {
        v->nodes = v->compound->nodes;
        v->parts = v->compound->parts;
        v->extent = v->compound->extent;
        v->count = v->compound->count;
    } else {
        ovoid_body body = {solid->shape, {{0, 0, 0}, {1, 0, 0, 0}}};
        v->own_node = node_make_shape(solid->shape);
        v->own_part = part_make(&body);
        v->nodes = &v->own_node;
        v->parts = &v->own_part;
        v->extent = body_compute_extent(&body);
        v->count = 1;
    }
    return vec3_norm(v->pose->position) + v->extent <= OVOID_LENGTH_MAX;
}

// ---- what is left out

static void add_exclusion(hunt *h, const ovoid_exclusion *x) {
    ovoid_exclusions *all = h->exclusions;
    if (all->count < all->capacity) all->items[all->count] = *x;
    all->count++;
}

// A pair of nodes that waits, and what is known of it.
typedef struct waiting {
    const compound_node *a, *b;
    nodes_bound bound;
} waiting;

// Both children of one node with the other node, the nearer one last. side: 0 where the node is of a.
static void look_at_children(hunt *h, int side, const waiting *w, waiting two[2]) {
    const compound_node *node = side ? w->b : w->a;
    const compound_node *children[2] = {node_get_right(node), node_get_left(node)};
    // Often the one that was turned before, and always where the other solid is a shape.
    const compound_node *rest = side ? w->a : w->b;
    if (h->turned.node != rest || h->turned_side != side) {
        h->turned = nodes_turn(&h->frame, side, rest);
        h->turned_side = side;
    }
    double enough = min2(h->ask.far, h->enough);
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

static waiting look_at_roots(hunt *h, double enough) {
    nodes_other other = nodes_turn(&h->frame, 0, h->b.nodes);
    nodes_bound bound = nodes_compute_lower(&h->frame, 0, h->a.nodes, &other, enough);
    return (waiting){h->a.nodes, h->b.nodes, bound};
}

static void exclude_nodes(hunt *h, const waiting *w) {
    h->lower = min2(h->lower, w->bound.lower);
    if (!h->exclusions) return;
    const compound_node *a = w->a, *b = w->b;
    ovoid_exclusion x = {a->first, a->end, b->first, b->end, {0, 0, 0}, {0, 0, 0}, w->bound.lower};
    nodes_means means = w->bound.means;
    x.normal = means < NODES_PARTS
                   ? nodes_compute_normal(&h->frame, a, b, means)
                   : parts_compute_normal(&h->frame, &h->a.parts[a->first], &h->b.parts[b->first], means);
    add_exclusion(h, &x);
}

static void take_trouble(hunt *h, const ovoid_answer *x) {
    int is_wide =
        x->limit == OVOID_LIMIT_ITERATIONS || x->limit == OVOID_LIMIT_PRECISION || x->limit == OVOID_LIMIT_CAPACITY;
    if (is_wide && h->trouble == OVOID_LIMIT_NONE) h->trouble = x->limit;
}

static void exclude_parts(hunt *h, uint32_t a, uint32_t b, const ovoid_answer *x) {
    h->lower = min2(h->lower, x->lower);
    take_trouble(h, x);
    if (!h->exclusions) return;
    ovoid_exclusion e = {a, a + 1, b, b + 1, x->proof.normal, x->proof.normal_low, x->lower};
    add_exclusion(h, &e);
}

// ---- pairs of parts

// The pair of parts at two places, in the world; a part that was asked for before is still there.
static const ovoid_pair *pose_pair(hunt *h, uint32_t a, uint32_t b) {
    if (h->posed_a != a) {
        ovoid_body body = solid_view_get_part(&h->a, a);
        h->pair.shape_a = body.shape;
        h->pair.pose_a = body.pose;
        h->posed_a = a;
    }
    if (h->posed_b != b) {
        ovoid_body body = solid_view_get_part(&h->b, b);
        h->pair.shape_b = body.shape;
        h->pair.pose_b = body.pose;
        h->posed_b = b;
    }
    return &h->pair;
}

// What may be left out from now on.
static void tighten(hunt *h) {
    const ovoid_answer *best = &h->out->answer;
    if (h->ask.wants_bracket) h->enough = min2(best->lower, best->upper - h->tolerance);
    // The margin is met: what is still asked is the sign.
    if (best->upper <= h->ask.near) h->ask = question_make_collide();
}

static void take_best(hunt *h, uint32_t a, uint32_t b, const ovoid_answer *x) {
    if (h->place_a < h->a.count) exclude_parts(h, h->place_a, h->place_b, &h->out->answer);
    h->out->answer = *x;
    h->place_a = a;
    h->place_b = b;
    nodes_frame_set_normal(&h->frame, x->proof.normal);
    tighten(h);
}

// Asks about a pair of parts: nothing needs to be known of it but whether it is nearer than the best one.
static void visit_parts(hunt *h, uint32_t a, uint32_t b, const ovoid_proof *earlier) {
    question ask = h->ask;
    int has_best = h->place_a < h->a.count;
    if (has_best && ask.wants_bracket && h->out->answer.upper < ask.far) {
        ask.far = max2(h->enough, 0);
        ask.beyond = OVOID_LIMIT_CAP;
    }
    ovoid_cover cover, *wanted = ask.wants_depth && h->exclusions && h->exclusions->cover ? &cover : NULL;
    answer_find_inside(pose_pair(h, a, b), &h->options, ask, earlier, wanted, &h->spare);
    h->out->tested++;
    if (has_best && !(h->spare.upper < h->out->answer.upper)) {
        exclude_parts(h, a, b, &h->spare);
        return;
    }
    take_best(h, a, b, &h->spare);
    if (wanted) *h->exclusions->cover = cover;
}

// ---- the walk

// 1 if nothing that is still to come can change the answer.
static int is_decided(const hunt *h) {
    return h->place_a < h->a.count && h->out->answer.upper < 0 && !h->ask.wants_depth;
}
static int is_left_out(const hunt *h, double lower) { return lower > h->ask.far || lower >= h->enough; }

// Two parts: a closer look at their own bounds, then the pair query.
static void visit_leaves(hunt *h, waiting *w) {
    uint32_t a = w->a->first, b = w->b->first;
    if (a == h->warm_a && b == h->warm_b) return;
    w->bound = parts_compute_lower(&h->frame, &h->a.parts[a], &h->b.parts[b], min2(h->ask.far, h->enough));
    if (is_left_out(h, w->bound.lower))
        exclude_nodes(h, w);
    else
        visit_parts(h, a, b, NULL);
}

static void walk(hunt *h) {
    // One pair waits for each step down, of either tree.
    waiting stack[2 * COMPOUND_DEPTH_MAX];
    stack[0] = look_at_roots(h, min2(h->ask.far, h->enough));
    h->out->visited++;
    for (int count = 1; count > 0 && !is_decided(h);) {
        waiting w = stack[--count];
        if (is_left_out(h, w.bound.lower)) {
            exclude_nodes(h, &w);
            continue;
        }
        if (node_is_leaf(w.a) && node_is_leaf(w.b)) {
            visit_leaves(h, &w);
            continue;
        }
        look_at_children(h, !node_is_split_first(w.a, w.b), &w, stack + count);
        count += 2;
    }
}

// Starts with the pair of parts that decided before. Such numbers may be anything.
static void visit_earlier(hunt *h, const ovoid_compound_proof *earlier) {
    if (!earlier || earlier->part_a >= h->a.count || earlier->part_b >= h->b.count) return;
    h->warm_a = h->a.compound ? h->a.compound->places[earlier->part_a] : 0;
    h->warm_b = h->b.compound ? h->b.compound->places[earlier->part_b] : 0;
    visit_parts(h, h->warm_a, h->warm_b, &earlier->proof);
}

// ---- the answer

static ovoid_status find_status(const hunt *h, const ovoid_answer *x, double lower) {
    if (lower > 0) return OVOID_SEPARATED;
    if (x->upper < 0) return OVOID_OVERLAPPING;
    int is_narrow = x->upper - lower <= h->tolerance || (x->status == OVOID_TOUCHING && lower >= x->lower);
    return is_narrow ? OVOID_TOUCHING : OVOID_UNDECIDED;
}

// Why the bracket is wider than the tolerance, if it is.
static ovoid_limit find_limit(const hunt *h, const ovoid_answer *x, ovoid_status status, double lower) {
    const question *ask = &h->asked;
    // A common point is no witness of a depth, unless the depth is within the tolerance.
    int is_common = ask->wants_depth && x->proof.kind == OVOID_PROOF_HULL && lower < -h->tolerance;
    if (x->upper - lower <= h->tolerance && !is_common) return OVOID_LIMIT_NONE;
    if (status == OVOID_UNDECIDED) return h->trouble != OVOID_LIMIT_NONE ? h->trouble : OVOID_LIMIT_PRECISION;
    if (lower > ask->far) return ask->beyond;
    int is_asked = ask->wants_bracket && (status == OVOID_SEPARATED || ask->wants_depth);
    if (!is_asked || x->upper <= ask->near) return OVOID_LIMIT_ANSWERED;
    return h->trouble != OVOID_LIMIT_NONE ? h->trouble : OVOID_LIMIT_PRECISION;
}

// All pairs of parts by the roots alone, where the walk ended before its time.
static void exclude_all(hunt *h) {
    if (h->exclusions) h->exclusions->count = 0;
    waiting roots = look_at_roots(h, INFINITY);
    exclude_nodes(h, &roots);
}

static void finish(hunt *h) {
    ovoid_compound_answer *out = h->out;
    if (h->place_a == h->a.count) visit_parts(h, 0, 0, NULL);
    if (is_decided(h)) exclude_all(h);
    ovoid_answer *x = &out->answer;
    take_trouble(h, x);
    double lower = min2(x->lower, h->lower);
    ovoid_status status = find_status(h, x, lower);
    x->limit = find_limit(h, x, status, lower);
    x->status = status;
    x->lower = lower;
    out->part_a = solid_view_get_index(&h->a, h->place_a);
    out->part_b = solid_view_get_index(&h->b, h->place_b);
    ovoid_exclusions *all = h->exclusions;
    if (all && all->count <= all->capacity) exclusions_sort(all->items, all->count);
}

static void hunt_make(hunt *h, const ovoid_options *options, question ask) {
    nodes_frame_make(&h->a, &h->b, &h->frame);
    h->options = options ? *options : (ovoid_options){0, 0, 0, 0};
    double relative = h->options.relative_tolerance > 0 ? h->options.relative_tolerance : 1e-9;
    h->tolerance = h->options.absolute_tolerance = max2(h->options.absolute_tolerance, relative * h->frame.size);
    h->asked = h->ask = ask;
    h->enough = h->lower = INFINITY;
    h->place_a = h->warm_a = h->a.count;
    h->place_b = h->warm_b = h->b.count;
    h->posed_a = h->a.count;
    h->posed_b = h->b.count;
    h->trouble = OVOID_LIMIT_NONE;
    h->turned.node = NULL;
    h->turned_side = 0;
}

void solid_find_inside(const ovoid_solid_pair *pair, const ovoid_options *options, question ask,
                       const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions, ovoid_compound_answer *out) {
    out->part_a = out->part_b = out->visited = out->tested = 0;
    if (exclusions) exclusions->count = 0;
    ovoid_cover *cover = exclusions ? exclusions->cover : NULL;
    if (cover) cover->point_count = cover->triangle_count = 0;
    hunt h;
    ovoid_limit refused = OVOID_LIMIT_NONE;
    if (!are_numbers_sound(options, &ask))
        refused = OVOID_LIMIT_OPTIONS;
    else if (!solid_view_make(&pair->a, &h.a))
        refused = OVOID_LIMIT_POSE_A;
    else if (!solid_view_make(&pair->b, &h.b))
        refused = OVOID_LIMIT_POSE_B;
    if (refused != OVOID_LIMIT_NONE) {
        out->answer = answer_make_refused(refused);
        return;
    }
    if (!h.a.compound && !h.b.compound) {
        ovoid_pair parts = {pair->a.shape, pair->b.shape, pair->a.pose, pair->b.pose};
        answer_find_inside(&parts, options, ask, earlier ? &earlier->proof : NULL, cover, &out->answer);
        out->tested = 1;
        return;
    }
    hunt_make(&h, options, ask);
    h.out = out;
    h.exclusions = exclusions;
    visit_earlier(&h, earlier);
    if (!is_decided(&h)) walk(&h);
    finish(&h);
}

static ovoid_compound_answer find(const ovoid_solid_pair *pair, const ovoid_options *options, question ask,
                                  const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions) {
    ovoid_compound_answer out;
    environment before = environment_enter();
    environment_hide(ask);
    solid_find_inside(pair, options, ask, earlier, exclusions, &out);
    environment_hide(out);
    environment_leave(before);
    return out;
}

ovoid_compound_answer ovoid_compound_collide(const ovoid_solid_pair *pair, const ovoid_options *options,
                                             const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions) {
    return find(pair, options, question_make_collide(), earlier, exclusions);
}
ovoid_compound_answer ovoid_compound_within(const ovoid_solid_pair *pair, double margin, const ovoid_options *options,
                                            const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions) {
    return find(pair, options, question_make_within(margin), earlier, exclusions);
}
ovoid_compound_answer ovoid_compound_distance(const ovoid_solid_pair *pair, const ovoid_options *options,
                                              const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions) {
    return find(pair, options, question_make_distance(options), earlier, exclusions);
}
ovoid_compound_answer ovoid_compound_depth(const ovoid_solid_pair *pair, const ovoid_options *options,
                                           const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions) {
    return find(pair, options, question_make_depth(options), earlier, exclusions);
}
