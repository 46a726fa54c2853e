// When do two moving bodies first meet, of which one at least is a solid? As compound_impact.c has it for parts: a
// branch and bound down both trees (X. Zhang, S. Redon, M. Lee, Y. J. Kim, Continuous collision detection for
// articulated models using Taylor models and temporal culling, 2007), the balls around two nodes moved with their
// bodies.
//
// What is inside what is decided once, at the beginning: bodies that are apart then, and whose surfaces do not meet
// until some time, have nothing inside each other until then, since a component would have to pass through a surface.
#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "body/compound_impact.h"
#include "body/moving_tree.h"
#include "linear/box.h"
#include "motion/impact_sweep.h"

typedef struct couple {
    solid_ref a, b;
    double after; ///< no two of their leaves meet before this time
} couple;

typedef struct descent {
    moving_tree a, b;
    double margin, begin, end; ///< end: of the relevant times, the first hit found
    double tolerance;          ///< of times
    ovoid_motion_options options;
    ovoid_compound_impact *out;
    uint32_t place_a, place_b; ///< of the deciding pair
    double free_until;         ///< the least of all pairs of leaves that are not free
    size_t step_count;         ///< of all groups
} descent;

// The options for the relevant times, with the tolerance in parts of them; the next steps go to the free part of the
// caller's array.
static ovoid_motion_options make_options(const descent *d, double tolerance) {
    ovoid_motion_options o = d->options;
    o.steps = NULL;
    o.capacity = 0;
    o.begin = d->begin;
    o.end = d->end;
    o.tolerance = d->end > d->begin ? tolerance / (d->end - d->begin) : 0;
    if (!d->options.groups || !d->options.steps || d->step_count >= d->options.capacity) return o;
    o.steps = d->options.steps + d->step_count;
    o.capacity = d->options.capacity - d->step_count;
    return o;
}

// Adds the group of the steps that were just written.
static void take_group(descent *d, solid_ref a, solid_ref b, size_t count) {
    ovoid_step_group g = {.count = count};
    if (!d->options.groups) return;
    solid_view_get_range(&d->a.view, a, &g.first_a, &g.end_a);
    solid_view_get_range(&d->b.view, b, &g.first_b, &g.end_b);
    size_t *groups = &d->out->group_count;
    if (*groups < d->options.group_capacity) d->options.groups[*groups] = g;
    ++*groups;
    d->step_count += count;
}

// The steps of two leaves or balls that are free: of one time alone, which no step goes on from, one that ends where it
// begins, along the normal of their distance.
static size_t count_steps(const descent *d, const ovoid_impact *x) {
    if (d->begin < d->end || x->status != OVOID_IMPACT_FREE) return x->step_count;
    ovoid_motion_options room = make_options(d, 0);
    if (room.steps) room.steps[0] = (ovoid_step){d->begin, x->free.normal, OVOID_STEP_WORLD};
    return 1;
}

// 1 if the balls are free up to the first hit found; that is a group of the proof. Else *after: the time until which
// they are free. A tolerance of 1e-3 is enough to order them.
COMPILER_NOINLINE static int is_pruned(descent *d, couple *c) {
    moving_room rooms[2];
    ovoid_impact x;
    ovoid_moving_shape ball_a = moving_tree_make_ball(&d->a, c->a, &rooms[0]),
                       ball_b = moving_tree_make_ball(&d->b, c->b, &rooms[1]);
    ovoid_motion_options o = make_options(d, 1e-3 * (d->end - d->begin));
    o.query = NULL;
    impact_find((moving_shapes){&ball_a, &ball_b}, d->margin, &o, 1e-3, &x);
    c->after = x.free_until;
    if (x.status != OVOID_IMPACT_FREE) return 0;
    take_group(d, c->a, c->b, count_steps(d, &x));
    return 1;
}

// The impact of two leaves.
COMPILER_NOINLINE static void take_leaves(descent *d, const couple *c) {
    moving_room rooms[2];
    ovoid_moving_shape made[2];
    ovoid_impact x, *best = &d->out->impact;
    moving_shapes pair = moving_trees_get_pair(&d->a, c->a, &d->b, c->b, made, rooms);
    ovoid_motion_options o = make_options(d, d->tolerance);
    impact_find(pair, d->margin, &o, 1e-9, &x);
    take_group(d, c->a, c->b, count_steps(d, &x));
    d->out->tested++;
    if (impact_take_pair(best, &x, &d->free_until)) {
        d->place_a = ref_get_place(c->a);
        d->place_b = ref_get_place(c->b);
    }
    if (x.status == OVOID_IMPACT_HIT) d->end = x.hit_at;
}

static int is_leaves(const couple *c) { return ref_is_triangle(c->a) && ref_is_triangle(c->b); }

// Pushes the pairs of children, the one that may meet first on top.
static uint32_t open_couple(descent *d, const couple *c, couple *stack) {
    int is_a = moving_trees_split_first(&d->a, c->a, &d->b, c->b);
    solid_ref children[BOX8];
    uint32_t more = solid_view_get_children(is_a ? &d->a.view : &d->b.view, is_a ? c->a : c->b, children), count = 0;
    for (uint32_t i = 0; i < more; i++) {
        couple next = {is_a ? children[i] : c->a, is_a ? c->b : children[i], c->after};
        d->out->visited++;
        if (is_pruned(d, &next)) continue;
        uint32_t at = count++;
        for (; at > 0 && stack[at - 1].after < next.after; at--) stack[at] = stack[at - 1];
        stack[at] = next;
    }
    return count;
}

// 1 if a pair on the stack can be pruned by now, as a hit was found before its balls meet. A proof needs its steps too.
static int is_late(descent *d, couple *c) {
    if (d->out->impact.status != OVOID_IMPACT_HIT) return 0;
    if (d->end <= d->begin) return 1;
    if (c->after < d->end) return 0;
    return !d->options.groups || is_pruned(d, c);
}

COMPILER_NOINLINE static void descend(descent *d) {
    couple stack[2 * SOLID_DEPTH_MAX * BOX8];
    uint32_t top = 0;
    stack[top++] = (couple){solid_view_get_root(&d->a.view), solid_view_get_root(&d->b.view), d->begin};
    while (top > 0) {
        couple c = stack[--top];
        if (is_late(d, &c)) continue;
        if (is_leaves(&c))
            take_leaves(d, &c);
        else
            top += open_couple(d, &c, stack + top);
    }
}

static void finish(descent *d) {
    ovoid_compound_impact *out = d->out;
    ovoid_impact *best = &out->impact;
    if (d->options.groups) best->step_count = d->step_count;
    if (best->status == OVOID_IMPACT_FREE) return;
    out->part_a = solid_view_get_index(&d->a.view, d->place_a);
    out->part_b = solid_view_get_index(&d->b.view, d->place_b);
    impact_finish_pairs(best, d->free_until);
}

// The bodies as trees, and the times. Refusals are those of two shapes.
COMPILER_NOINLINE static ovoid_limit start(descent *d, const ovoid_moving_body *a, const ovoid_moving_body *b,
                                           const ovoid_motion_options *given) {
    static const ovoid_motion_options none = {0};
    moving_room rooms[2];
    sweep s;
    d->options = given ? *given : none;
    if (!moving_tree_make(a, &d->a)) return OVOID_LIMIT_SHAPE_A;
    if (!moving_tree_make(b, &d->b)) return OVOID_LIMIT_SHAPE_B;
    ovoid_moving_shape ball_a = moving_tree_make_ball(&d->a, solid_view_get_root(&d->a.view), &rooms[0]),
                       ball_b = moving_tree_make_ball(&d->b, solid_view_get_root(&d->b.view), &rooms[1]);
    ovoid_limit limit = sweep_make(&s, (moving_shapes){&ball_a, &ball_b}, &d->options, 1e-9);
    if (limit == OVOID_LIMIT_NONE && !(d->margin >= 0 && d->margin < INFINITY)) limit = OVOID_LIMIT_OPTIONS;
    d->begin = s.begin;
    d->end = s.end;
    d->tolerance = s.tolerance * (s.end - s.begin);
    return limit;
}

// 1 where the beginning decides: within the margin there, or it cannot be said what is inside what.
COMPILER_NOINLINE static int begin_decides(descent *d) {
    moving_answer at;
    ovoid_compound_impact *out = d->out;
    moving_trees_ask(&d->a, &d->b, d->margin, d->begin, &at);
    const ovoid_solid_answer *answer = &at.answer;
    int is_hit = answer->upper + at.shift <= d->margin, is_closed = d->a.view.solid || d->b.view.solid;
    if (!is_hit && (!is_closed || moving_answer_is_apart(&at, 0))) return 0;
    out->impact.status = is_hit ? OVOID_IMPACT_HIT : OVOID_IMPACT_UNDECIDED;
    out->impact.limit = is_hit ? OVOID_LIMIT_NONE : OVOID_LIMIT_PRECISION;
    out->impact.free_until = d->begin;
    out->impact.hit_at = is_hit ? d->begin : INFINITY;
    out->impact.iterations = 1;
    out->part_a = answer->triangle_a;
    out->part_b = answer->triangle_b;
    ovoid_answer *x = &out->impact.hit;
    *x = answer->surfaces;
    x->status = answer->status;
    x->limit = answer->limit;
    x->lower = answer->lower;
    x->upper = answer->upper;
    out->impact.free = *x;
    return 1;
}

static void find(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                 const ovoid_motion_options *options, ovoid_compound_impact *out) {
    OVOID_ASSERT(a && b);
    *out = (ovoid_compound_impact){.impact = {.hit_at = INFINITY}};
    ovoid_impact *x = &out->impact;
    descent d = {.margin = margin, .out = out, .free_until = INFINITY};
    x->limit = start(&d, a, b, options);
    x->free = x->hit = answer_make_refused(x->limit);
    if (x->limit != OVOID_LIMIT_NONE) return;
    double end = d.end;
    if (!begin_decides(&d)) {
        x->status = OVOID_IMPACT_FREE;
        descend(&d);
        finish(&d);
        if (x->status == OVOID_IMPACT_FREE) x->free_until = end;
    }
    x->begin = d.begin;
    x->end = end;
}

ovoid_compound_impact ovoid_solid_impact_find(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                                              const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN_FILLED(ovoid_compound_impact, out, margin, find(a, b, margin, options, &out));
}
