// When do two moving compounds first meet? A branch and bound down both trees (the traversal of X. Zhang, S. Redon, M.
// Lee, Y. J. Kim, Continuous collision detection for articulated models using Taylor models and temporal culling,
// 2007): the balls around two nodes are moved with their bodies, and the time until which these are free is a lower
// bound for all their parts. The pair of nodes that may meet first is opened first; pairs that are free until the first
// hit found are pruned. Each pair of parts is an ordinary impact (motion/impact.c), with its own steps.
#include "body/compound_impact.h"
#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "linear/box.h"
#include "motion/impact.h"
#include "motion/impact_sweep.h"

enum { BOX_DEPTH = 4 };

typedef struct couple {
    uint32_t a, b; ///< nodes
    double after;  ///< no two of their parts meet before this time
} couple;

typedef struct descent {
    const ovoid_moving_body *a, *b;
    body_view view_a, view_b;
    double margin, begin, end; ///< end: of the relevant times, the first hit found
    double tolerance;          ///< of times
    ovoid_motion_options options;
    ovoid_compound_impact *out;
    uint32_t place_a, place_b; ///< of the deciding pair
    double window;             ///< the end of the times of its query
    double free_until;         ///< the least of all pairs of parts
    size_t step_count;         ///< of all groups
} descent;

static const ovoid_pose no_part = {{0, 0, 0}, {0, 0, 0, 0}};

int moving_view_make(const ovoid_moving_body *body, body_view *view) {
    const ovoid_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};
    ovoid_body own = {.shape = body->shape, .compound = body->compound, .pose = origin, .solid = body->solid};
    int ok = body_view_make(&own, view);
    view->pose = NULL;
    return ok;
}

ovoid_moving_shape moving_view_get_part(const ovoid_moving_body *body, const body_view *view, uint32_t place) {
    const compound_part *part = &view->parts[place];
    return (ovoid_moving_shape){part->shape, body->motion, body->compound ? part->pose : no_part};
}

ovoid_moving_shape moving_node_make_sphere(const ovoid_moving_body *body, const compound_node *node,
                                           point_shape *ball) {
    const ovoid_quat none = {1, 0, 0, 0};
    point_make(ball, node->radius);
    return (ovoid_moving_shape){&ball->shape, body->motion, {node->center, none}};
}

// The options for the relevant times, with the tolerance in parts of them.
static ovoid_motion_options make_options(const descent *d, double end, double tolerance) {
    ovoid_motion_options o = d->options;
    o.steps = NULL;
    o.capacity = 0;
    o.begin = d->begin;
    o.end = end;
    o.tolerance = end > d->begin ? tolerance / (end - d->begin) : 0;
    return o;
}

// ---- the proof

static int is_recording(const descent *d) { return d->options.groups != NULL; }

// Directs the next steps to the free part of the caller's array.
static void set_steps(const descent *d, ovoid_motion_options *o) {
    if (!is_recording(d) || !d->options.steps || d->step_count >= d->options.capacity) return;
    o->steps = d->options.steps + d->step_count;
    o->capacity = d->options.capacity - d->step_count;
}

// Adds the group of the steps that were just written.
static void take_group(descent *d, const compound_node *a, const compound_node *b, size_t count) {
    if (!is_recording(d)) return;
    size_t *groups = &d->out->group_count;
    if (*groups < d->options.group_capacity)
        d->options.groups[*groups] = (ovoid_step_group){a->first, a->end, b->first, b->end, count};
    ++*groups;
    d->step_count += count;
}

// The steps of two bodies that are free: of one time alone, which no step goes on from, one that ends where it begins,
// along the normal of their distance.
static size_t count_steps(const descent *d, const ovoid_impact *x) {
    if (d->begin < d->end || x->status != OVOID_IMPACT_FREE) return x->step_count;
    ovoid_motion_options room = {.steps = NULL};
    set_steps(d, &room);
    if (room.steps) room.steps[0] = (ovoid_step){d->begin, x->free.normal, OVOID_STEP_WORLD};
    return 1;
}

// ---- the search

// The impact of the balls around two nodes, up to the first hit found. A tolerance of 1e-3 is enough to order them.
static void find_balls(const descent *d, const compound_node *a, const compound_node *b, ovoid_impact *x) {
    point_shape ball_a, ball_b;
    ovoid_moving_shape moving_a = moving_node_make_sphere(d->a, a, &ball_a),
                       moving_b = moving_node_make_sphere(d->b, b, &ball_b);
    ovoid_motion_options o = make_options(d, d->end, 1e-3 * (d->end - d->begin));
    o.query = NULL;
    set_steps(d, &o);
    impact_find((moving_shapes){&moving_a, &moving_b}, d->margin, &o, 1e-3, x);
}

// 1 if the balls are free up to the first hit found; that is a group of the proof. Else *after: the time until which
// they are free.
COMPILER_NOINLINE static int is_pruned(descent *d, const compound_node *a, const compound_node *b, double *after) {
    ovoid_impact x;
    find_balls(d, a, b, &x);
    *after = x.free_until;
    if (x.status != OVOID_IMPACT_FREE) return 0;
    take_group(d, a, b, count_steps(d, &x));
    return 1;
}

// The impact of a pair of parts.
COMPILER_NOINLINE static void take_parts(descent *d, const compound_node *leaf_a, const compound_node *leaf_b) {
    uint32_t a = leaf_a->first, b = leaf_b->first;
    ovoid_impact x, *best = &d->out->impact;
    ovoid_moving_shape moving_a = moving_view_get_part(d->a, &d->view_a, a),
                       moving_b = moving_view_get_part(d->b, &d->view_b, b);
    ovoid_motion_options o = make_options(d, d->end, d->tolerance);
    set_steps(d, &o);
    impact_find((moving_shapes){&moving_a, &moving_b}, d->margin, &o, 1e-9, &x);
    take_group(d, leaf_a, leaf_b, count_steps(d, &x));
    d->out->tested++;
    if (impact_take_pair(best, &x, &d->free_until)) {
        d->window = d->end;
        d->place_a = a;
        d->place_b = b;
    }
    if (x.status == OVOID_IMPACT_HIT) d->end = x.hit_at;
}

static const compound_node *get_a(const descent *d, const couple *c) { return &d->view_a.nodes[c->a]; }
static const compound_node *get_b(const descent *d, const couple *c) { return &d->view_b.nodes[c->b]; }

static int is_parts(const descent *d, const couple *c) {
    return node_is_leaf(get_a(d, c)) && node_is_leaf(get_b(d, c));
}

// Pushes the pairs of children, the one that may meet first on top. Pairs of parts are answered at once.
static int open_couple(descent *d, const couple *c, couple *stack) {
    int is_a = node_is_split_first(get_a(d, c), get_b(d, c)), count = 0;
    const compound_node *opened = is_a ? get_a(d, c) : get_b(d, c);
    uint32_t halves[2], from = is_a ? c->a : c->b;
    halves[0] = from + (uint32_t)(node_get_left(opened) - opened);
    halves[1] = from + (uint32_t)(node_get_right(opened) - opened);
    couple found[2];
    for (int i = 0; i < 2; i++) {
        couple half = {is_a ? halves[i] : c->a, is_a ? c->b : halves[i], c->after};
        d->out->visited++;
        if (is_parts(d, &half) || !is_pruned(d, get_a(d, &half), get_b(d, &half), &half.after)) found[count++] = half;
    }
    int last_first = count == 2 && found[0].after <= found[1].after;
    for (int i = 0; i < count; i++) stack[i] = found[last_first ? count - 1 - i : i];
    return count;
}

// 1 if a pair on the stack can be pruned by now, as a hit was found before its balls meet. A proof needs its steps too.
static int is_late(descent *d, couple *c) {
    if (d->out->impact.status != OVOID_IMPACT_HIT) return 0;
    if (d->end <= d->begin) return 1;
    if (c->after < d->end) return 0;
    return !is_recording(d) || (!is_parts(d, c) && is_pruned(d, get_a(d, c), get_b(d, c), &c->after));
}

COMPILER_NOINLINE static void descend(descent *d) {
    couple stack[2 * COMPOUND_DEPTH_MAX + 2];
    int top = 0;
    stack[top++] = (couple){0, 0, d->begin};
    while (top > 0) {
        couple c = stack[--top];
        if (is_late(d, &c)) continue;
        if (is_parts(d, &c))
            take_parts(d, get_a(d, &c), get_b(d, &c));
        else
            top += open_couple(d, &c, stack + top);
    }
}

// The deciding pair, queried again where only its steps are wanted.
COMPILER_NOINLINE static void finish(descent *d) {
    ovoid_compound_impact *out = d->out;
    ovoid_impact *best = &out->impact;
    uint32_t iterations = best->iterations;
    if (is_recording(d)) best->step_count = d->step_count;
    if (best->status == OVOID_IMPACT_FREE) return;
    out->part_a = body_view_get_index(&d->view_a, d->place_a);
    out->part_b = body_view_get_index(&d->view_b, d->place_b);
    if (!is_recording(d) && d->options.steps) {
        ovoid_moving_shape a = moving_view_get_part(d->a, &d->view_a, d->place_a);
        ovoid_moving_shape b = moving_view_get_part(d->b, &d->view_b, d->place_b);
        ovoid_motion_options o = make_options(d, d->window, d->tolerance);
        o.steps = d->options.steps;
        o.capacity = d->options.capacity;
        impact_find((moving_shapes){&a, &b}, d->margin, &o, 1e-9, best);
        best->iterations = iterations;
    }
    impact_finish_pairs(best, d->free_until);
}

// The bodies as trees, and the times. Refusals are those of two parts.
COMPILER_NOINLINE static ovoid_limit start(descent *d, const ovoid_motion_options *given) {
    static const ovoid_motion_options none = {0};
    sweep s;
    d->options = given ? *given : none;
    if (!moving_view_make(d->a, &d->view_a)) return OVOID_LIMIT_SHAPE_A;
    if (!moving_view_make(d->b, &d->view_b)) return OVOID_LIMIT_SHAPE_B;
    ovoid_moving_shape a = moving_view_get_part(d->a, &d->view_a, 0), b = moving_view_get_part(d->b, &d->view_b, 0);
    ovoid_limit limit = sweep_make(&s, (moving_shapes){&a, &b}, &d->options, 1e-9);
    if (limit == OVOID_LIMIT_NONE && !(d->margin >= 0 && d->margin < INFINITY)) limit = OVOID_LIMIT_OPTIONS;
    d->begin = s.begin;
    d->end = s.end;
    d->tolerance = s.tolerance * (s.end - s.begin);
    return limit;
}

static void find(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                 const ovoid_motion_options *options, ovoid_compound_impact *out) {
    OVOID_ASSERT(a && b);
    *out = (ovoid_compound_impact){.impact = {.hit_at = INFINITY}};
    ovoid_impact *x = &out->impact;
    descent d = {.a = a, .b = b, .margin = margin, .out = out, .free_until = INFINITY};
    x->limit = start(&d, options);
    x->free = x->hit = answer_make_refused(x->limit);
    if (x->limit != OVOID_LIMIT_NONE) return;
    double end = d.end;
    x->status = OVOID_IMPACT_FREE;
    descend(&d);
    finish(&d);
    x->begin = d.begin;
    x->end = end;
    if (x->status == OVOID_IMPACT_FREE) x->free_until = end;
}

ovoid_compound_impact ovoid_compound_impact_find(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                                                 const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN_FILLED(ovoid_compound_impact, out, margin, find(a, b, margin, options, &out));
}

ovoid_moving_shape ovoid_moving_body_get_part(const ovoid_moving_body *body, size_t i) {
    if (!body->compound) return (ovoid_moving_shape){body->shape, body->motion, no_part};
    ovoid_posed_shape part = ovoid_compound_get_part(body->compound, i);
    return (ovoid_moving_shape){part.shape, body->motion, part.pose};
}

// ---- boxes

// The box of a part, or of the ball around a node.
static box find_box(const ovoid_moving_body *body, const body_view *view, const compound_node *n, double begin,
                    double end) {
    point_shape ball;
    ovoid_moving_shape m =
        node_is_leaf(n) ? moving_view_get_part(body, view, n->first) : moving_node_make_sphere(body, n, &ball);
    return ovoid_moving_shape_compute_box(&m, begin, end);
}

box moving_body_compute_box(const ovoid_moving_body *body, double begin, double end) {
    struct {
        const compound_node *node;
        int depth;
    } stack[2 * BOX_DEPTH + 2];
    const ovoid_box none = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    body_view view;
    if (!moving_view_make(body, &view)) return none;
    box all = find_box(body, &view, view.nodes, begin, end);
    if (isnan(all.min.x) || node_is_leaf(view.nodes)) return all;
    all = box_make_empty();
    int top = 0;
    stack[top].node = view.nodes;
    stack[top++].depth = 0;
    while (top > 0) {
        const compound_node *n = stack[--top].node;
        int depth = stack[top].depth + 1;
        if (depth > BOX_DEPTH || node_is_leaf(n)) {
            box own = find_box(body, &view, n, begin, end);
            all = box_join(&all, &own);
            continue;
        }
        stack[top].node = node_get_left(n);
        stack[top++].depth = depth;
        stack[top].node = node_get_right(n);
        stack[top++].depth = depth;
    }
    return all;
}
