// When do two moving bodies first meet? A branch and bound down both trees (the traversal of X. Zhang, S. Redon, M.
// Lee, Y. J. Kim, Continuous collision detection for articulated models using Taylor models and temporal culling,
// 2007): the balls around two nodes are moved with their bodies, and the time until which these are free is a lower
// bound for all their parts. The pair of nodes that may meet first is opened first; pairs that are free until the first
// hit found are pruned. Each pair of parts is an ordinary impact (motion/impact.c), with its own steps.
//
// Of solids, what is inside what is decided once, at the beginning: bodies that are apart then, and whose surfaces do
// not meet until some time, have nothing inside each other until then, since a component would have to pass through a
// surface. Their triangles are tested by balls first.
#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "body/moving_tree.h"
#include "linear/box.h"
#include "motion/impact_sweep.h"

typedef struct couple {
    tree_ref a, b;
    double after; ///< no two of their parts meet before this time
} couple;

typedef struct descent {
    moving_trees trees;
    double margin, begin, end; ///< end: of the relevant times, the first hit found
    double tolerance;          ///< of times
    ovoid_motion_options options;
    ovoid_body_impact *out;
    couple deciding;
    double window;     ///< the end of the times of the deciding pair's query
    double free_until; ///< the least of all pairs of parts that are not free
    size_t step_count; ///< of all groups
} descent;

// ---- the proof

static int is_recording(const descent *d) { return d->options.groups != NULL; }

// The options for the relevant times, with the tolerance in parts of them; the next steps of a proof go to the free
// part of the caller's array.
static ovoid_motion_options make_options(const descent *d, double tolerance) {
    ovoid_motion_options o = d->options;
    o.steps = NULL;
    o.capacity = 0;
    o.begin = d->begin;
    o.end = d->end;
    o.tolerance = d->end > d->begin ? tolerance / (d->end - d->begin) : 0;
    if (!is_recording(d) || !d->options.steps || d->step_count >= d->options.capacity) return o;
    o.steps = d->options.steps + d->step_count;
    o.capacity = d->options.capacity - d->step_count;
    return o;
}

// Adds the group of the steps that were just written.
static void take_group(descent *d, const couple *c, size_t count) {
    ovoid_step_group g = {.count = count};
    if (!is_recording(d)) return;
    body_tree_get_range(&d->trees.a.tree, c->a, &g.first_a, &g.end_a);
    body_tree_get_range(&d->trees.b.tree, c->b, &g.first_b, &g.end_b);
    size_t *groups = &d->out->group_count;
    if (*groups < d->options.group_capacity) d->options.groups[*groups] = g;
    ++*groups;
    d->step_count += count;
}

// The steps of two parts or balls that are free: of one time alone, which no step goes on from, one that ends where it
// begins, along the normal of their distance.
static size_t count_steps(const descent *d, const ovoid_impact *x) {
    if (d->begin < d->end || x->status != OVOID_IMPACT_FREE) return x->step_count;
    ovoid_motion_options room = make_options(d, 0);
    if (room.steps) room.steps[0] = (ovoid_step){d->begin, x->free.normal, OVOID_STEP_WORLD};
    return 1;
}

// ---- the search

static int is_parts(const couple *c) { return ref_is_leaf(c->a) && ref_is_leaf(c->b); }

// 1 if the balls are free up to the first hit found; that is a group of the proof. Else c->after: the time until which
// they are free. A tolerance of 1e-3 is enough to order them. The parts of compounds are queried without balls.
COMPILER_NOINLINE static int is_pruned(descent *d, couple *c) {
    moving_couple made;
    ovoid_impact x;
    if (!d->trees.has_solid && is_parts(c)) return 0;
    moving_shapes balls = moving_trees_make_balls(&d->trees, c->a, c->b, &made);
    ovoid_motion_options o = make_options(d, 1e-3 * (d->end - d->begin));
    o.query = NULL;
    impact_find(balls, d->margin, &o, 1e-3, &x);
    c->after = x.free_until;
    if (x.status != OVOID_IMPACT_FREE) return 0;
    take_group(d, c, count_steps(d, &x));
    return 1;
}

// Takes the impact of another pair of parts into that of the bodies. 1: this pair decides, a hit before all others, or
// undecided where there is no hit yet.
static int take_impact(descent *d, const ovoid_impact *x) {
    ovoid_impact *best = &d->out->impact;
    uint32_t all = best->iterations + x->iterations;
    int is_first = x->status == OVOID_IMPACT_HIT || (x->status == OVOID_IMPACT_UNDECIDED &&
                                                     best->status != OVOID_IMPACT_HIT && x->free_until < d->free_until);
    if (x->status != OVOID_IMPACT_FREE) d->free_until = min2(d->free_until, x->free_until);
    if (is_first) *best = *x;
    best->iterations = all;
    return is_first;
}

// The impact of two parts.
COMPILER_NOINLINE static void take_parts(descent *d, const couple *c) {
    moving_couple made;
    ovoid_impact x;
    moving_shapes pair = moving_trees_get_pair(&d->trees, c->a, c->b, &made);
    ovoid_motion_options o = make_options(d, d->tolerance);
    impact_find(pair, d->margin, &o, 1e-9, &x);
    take_group(d, c, count_steps(d, &x));
    d->out->tested++;
    if (take_impact(d, &x)) {
        d->deciding = *c;
        d->window = d->end;
    }
    if (x.status == OVOID_IMPACT_HIT) d->end = x.hit_at;
}

// Pushes the pairs of children, the one that may meet first on top; of two that may meet at once the first of a
// compound's, the last of a solid's.
static uint32_t open_couple(descent *d, const couple *c, couple *stack) {
    int is_a = trees_split_first(&d->trees.a.tree, c->a, &d->trees.b.tree, c->b), is_last_first = d->trees.has_solid;
    const moving_tree *opened = is_a ? &d->trees.a : &d->trees.b;
    tree_ref children[BOX8];
    uint32_t more = body_tree_get_children(&opened->tree, is_a ? c->a : c->b, children), count = 0;
    for (uint32_t i = 0; i < more; i++) {
        couple next = {is_a ? children[i] : c->a, is_a ? c->b : children[i], c->after};
        d->out->visited++;
        if (is_pruned(d, &next)) continue;
        uint32_t at = count++;
        for (; at > 0; at--) {
            double under = stack[at - 1].after;
            if (is_last_first ? !(under < next.after) : !(under <= next.after)) break;
            stack[at] = stack[at - 1];
        }
        stack[at] = next;
    }
    return count;
}

// 1 if a pair on the stack can be pruned by now, as a hit was found before its balls meet. A proof needs its steps too.
static int is_late(descent *d, couple *c) {
    if (d->out->impact.status != OVOID_IMPACT_HIT) return 0;
    if (d->end <= d->begin) return 1;
    if (c->after < d->end) return 0;
    return !is_recording(d) || is_pruned(d, c);
}

static void descend(descent *d, couple *stack) {
    uint32_t top = 0;
    stack[top++] = (couple){body_tree_get_root(&d->trees.a.tree), body_tree_get_root(&d->trees.b.tree), d->begin};
    while (top > 0) {
        couple c = stack[--top];
        if (is_late(d, &c)) continue;
        if (is_parts(&c))
            take_parts(d, &c);
        else
            top += open_couple(d, &c, stack + top);
    }
}

// Compounds' trees need less of the caller's stack than those of solids.
COMPILER_NOINLINE static void descend_compounds(descent *d) {
    couple stack[2 * COMPOUND_DEPTH_MAX + 2];
    descend(d, stack);
}
COMPILER_NOINLINE static void descend_solids(descent *d) {
    couple stack[2 * SOLID_DEPTH_MAX * BOX8];
    descend(d, stack);
}

// ---- the end

// The deciding pair, queried again where only its steps are wanted.
COMPILER_NOINLINE static void find_deciding_steps(descent *d) {
    ovoid_impact *best = &d->out->impact;
    uint32_t iterations = best->iterations;
    moving_couple made;
    moving_shapes pair = moving_trees_get_pair(&d->trees, d->deciding.a, d->deciding.b, &made);
    d->end = d->window;
    ovoid_motion_options o = make_options(d, d->tolerance);
    o.steps = d->options.steps;
    o.capacity = d->options.capacity;
    impact_find(pair, d->margin, &o, 1e-9, best);
    best->iterations = iterations;
}

static uint32_t get_part(const body_tree *tree, tree_ref leaf) {
    return body_tree_get_index(tree, body_tree_get_leaf_place(tree, leaf));
}

static void finish(descent *d) {
    ovoid_body_impact *out = d->out;
    ovoid_impact *best = &out->impact;
    if (is_recording(d)) best->step_count = d->step_count;
    if (best->status == OVOID_IMPACT_FREE) return;
    out->part_a = get_part(&d->trees.a.tree, d->deciding.a);
    out->part_b = get_part(&d->trees.b.tree, d->deciding.b);
    if (!is_recording(d) && d->options.steps) find_deciding_steps(d);
    // Another pair may have been proven free for a shorter time without being hit.
    if (!(d->free_until < best->free_until)) return;
    best->free_until = d->free_until;
    if (best->limit == OVOID_LIMIT_NONE) best->limit = OVOID_LIMIT_PRECISION;
}

// ---- the beginning

// The bodies as trees, and the times. Refusals are those of two shapes.
COMPILER_NOINLINE static ovoid_limit start(descent *d, const ovoid_moving_body *a, const ovoid_moving_body *b,
                                           const ovoid_motion_options *given) {
    static const ovoid_motion_options none = {0};
    moving_couple made;
    sweep s;
    d->options = given ? *given : none;
    ovoid_limit limit = moving_trees_make(a, b, &d->trees);
    if (limit != OVOID_LIMIT_NONE) return limit;
    const moving_shapes balls = moving_trees_make_balls(&d->trees, body_tree_get_root(&d->trees.a.tree),
                                                        body_tree_get_root(&d->trees.b.tree), &made);
    limit = sweep_make(&s, balls, &d->options, 1e-9);
    if (limit == OVOID_LIMIT_NONE && !(d->margin >= 0 && d->margin < INFINITY)) limit = OVOID_LIMIT_OPTIONS;
    d->begin = s.begin;
    d->end = s.end;
    d->tolerance = s.tolerance * (s.end - s.begin);
    return limit;
}

// 1 where the beginning decides: within the margin there, or it cannot be said what is inside what.
COMPILER_NOINLINE static int begin_decides(descent *d) {
    moving_answer at;
    ovoid_body_impact *out = d->out;
    if (!d->trees.has_solid) return 0;
    moving_trees_ask(&d->trees, d->margin, d->begin, &at);
    const ovoid_body_answer *answer = &at.answer;
    int is_hit = answer->upper + at.shift <= d->margin;
    if (!is_hit && moving_answer_is_apart(&at, 0)) return 0;
    out->impact.status = is_hit ? OVOID_IMPACT_HIT : OVOID_IMPACT_UNDECIDED;
    out->impact.limit = is_hit ? OVOID_LIMIT_NONE : OVOID_LIMIT_PRECISION;
    out->impact.free_until = d->begin;
    out->impact.hit_at = is_hit ? d->begin : INFINITY;
    out->impact.iterations = 1;
    out->part_a = answer->part_a;
    out->part_b = answer->part_b;
    ovoid_answer *x = &out->impact.hit;
    *x = answer->deciding;
    x->status = answer->status;
    x->limit = answer->limit;
    x->lower = answer->lower;
    x->upper = answer->upper;
    out->impact.free = *x;
    return 1;
}

static void find(const ovoid_moving_body_pair *pair, const ovoid_motion_options *options, ovoid_body_impact *out) {
    OVOID_ASSERT(pair);
    *out = (ovoid_body_impact){.impact = {.hit_at = INFINITY}};
    ovoid_impact *x = &out->impact;
    descent d = {.margin = pair->margin, .out = out, .free_until = INFINITY};
    x->limit = start(&d, &pair->a, &pair->b, options);
    x->free = x->hit = answer_make_refused(x->limit);
    if (x->limit != OVOID_LIMIT_NONE) return;
    double end = d.end;
    if (!begin_decides(&d)) {
        x->status = OVOID_IMPACT_FREE;
        if (d.trees.has_solid)
            descend_solids(&d);
        else
            descend_compounds(&d);
        finish(&d);
        if (x->status == OVOID_IMPACT_FREE) x->free_until = end;
    }
    x->begin = d.begin;
    x->end = end;
}

ovoid_body_impact ovoid_body_impact_find(const ovoid_moving_body_pair *pair, const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN_FILLED(ovoid_body_impact, out, pair, find(pair, options, &out));
}
