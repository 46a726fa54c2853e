// When do two moving compounds first meet? A branch and bound down both trees (the traversal of X. Zhang, S. Redon, M.
// Lee, Y. J. Kim, Continuous collision detection for articulated models using Taylor models and temporal culling,
// 2007): the balls around two nodes are moved with their solids, and the time until which these are free is a lower
// bound of that of all their parts. The pair of nodes that may meet first is opened first; what is free until the first
// hit found is left out. Each pair of parts is an ordinary impact (query/impact.c), with its own steps.
#include "scene/compound_impact.h"
#include "base/environment.h"
#include "base/error.h"
#include "query/impact.h"
#include "query/impact_sweep.h"

enum { BOX_DEPTH = 4 };

typedef struct couple {
    const compound_node *a, *b;
    double after; ///< no two of their parts meet before this time
} couple;

typedef struct descent {
    const ovoid_moving_solid *a, *b;
    solid_view view_a, view_b;
    double margin, begin, end; ///< end: of the times that matter, the first hit found
    double tolerance;          ///< of times
    ovoid_motion_options options;
    ovoid_compound_impact *out;
    uint32_t place_a, place_b; ///< of the deciding pair
    double window;             ///< the end of times when it was asked
    double free_until;         ///< the least of all pairs
    size_t step_count;         ///< of all groups
} descent;

static const ovoid_pose no_part = {{0, 0, 0}, {0, 0, 0, 0}};

void moving_view_make(const ovoid_moving_solid *s, solid_view *view) {
    const ovoid_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};
    ovoid_solid solid = {s->shape, s->compound, origin};
    (void)solid_view_make(&solid, view);
    view->pose = NULL;
}

ovoid_moving moving_view_get_part(const ovoid_moving_solid *solid, const solid_view *view, uint32_t place) {
    const compound_part *part = &view->parts[place];
    return (ovoid_moving){part->shape, solid->motion, solid->compound ? part->pose : no_part};
}

ovoid_moving moving_node_make_ball(const ovoid_moving_solid *solid, const compound_node *node, point_shape *ball) {
    const ovoid_quat none = {1, 0, 0, 0};
    point_make(ball, node->radius);
    return (ovoid_moving){&ball->shape, solid->motion, {node->center, none}};
}

// The times that matter, and the tolerance in parts of them.
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

// Where the next steps are written.
static void set_steps(const descent *d, ovoid_motion_options *o) {
    if (!is_recording(d) || !d->options.steps || d->step_count >= d->options.capacity) return;
    o->steps = d->options.steps + d->step_count;
    o->capacity = d->options.capacity - d->step_count;
}

// A group of the steps that were just written.
static void take_group(descent *d, const compound_node *a, const compound_node *b, size_t count) {
    if (!is_recording(d)) return;
    size_t *groups = &d->out->group_count;
    if (*groups < d->options.group_capacity)
        d->options.groups[*groups] = (ovoid_step_group){a->first, a->end, b->first, b->end, count};
    ++*groups;
    d->step_count += count;
}

// ---- the search

// The impact of the balls around two nodes, up to the first hit found. 1e-3 is enough for an order.
static void find_balls(const descent *d, const compound_node *a, const compound_node *b, ovoid_impact *x) {
    point_shape ball_a, ball_b;
    ovoid_moving moving_a = moving_node_make_ball(d->a, a, &ball_a), moving_b = moving_node_make_ball(d->b, b, &ball_b);
    ovoid_motion_options o = make_options(d, d->end, 1e-3 * (d->end - d->begin));
    o.query = NULL;
    set_steps(d, &o);
    impact_find(&moving_a, &moving_b, d->margin, &o, 1e-3, x);
}

// 1 if the balls are free up to the first hit found; then that is a group of the proof. Else when they are not any
// more.
static int is_left_out(descent *d, const compound_node *a, const compound_node *b, double *after) {
    ovoid_impact x;
    find_balls(d, a, b, &x);
    *after = x.free_until;
    if (x.status != OVOID_IMPACT_FREE) return 0;
    take_group(d, a, b, x.step_count);
    return 1;
}

// A pair of parts.
static void take_parts(descent *d, const compound_node *leaf_a, const compound_node *leaf_b) {
    uint32_t a = leaf_a->first, b = leaf_b->first;
    ovoid_impact x, *best = &d->out->impact;
    ovoid_moving moving_a = moving_view_get_part(d->a, &d->view_a, a),
                 moving_b = moving_view_get_part(d->b, &d->view_b, b);
    ovoid_motion_options o = make_options(d, d->end, d->tolerance);
    set_steps(d, &o);
    impact_find(&moving_a, &moving_b, d->margin, &o, 1e-9, &x);
    take_group(d, leaf_a, leaf_b, x.step_count);
    d->out->tested++;
    uint32_t all = best->iterations + x.iterations;
    // A hit before all others, or what is not decided where there is no hit.
    int is_first = x.status == OVOID_IMPACT_HIT || (x.status == OVOID_IMPACT_UNDECIDED &&
                                                    best->status != OVOID_IMPACT_HIT && x.free_until < d->free_until);
    if (x.status != OVOID_IMPACT_FREE && x.free_until < d->free_until) d->free_until = x.free_until;
    if (is_first) {
        d->window = d->end;
        d->place_a = a;
        d->place_b = b;
        *best = x;
    }
    best->iterations = all;
    if (x.status == OVOID_IMPACT_HIT) d->end = x.hit_at;
}

static int couple_is_parts(const couple *c) { return node_is_leaf(c->a) && node_is_leaf(c->b); }

// Pairs of children, the one that may meet first on top of the stack. Two parts are asked at once.
static int open_couple(descent *d, const couple *c, couple *stack) {
    int is_a = node_is_split_first(c->a, c->b), count = 0;
    const compound_node *opened = is_a ? c->a : c->b, *halves[2] = {node_get_left(opened), node_get_right(opened)};
    couple found[2];
    for (int i = 0; i < 2; i++) {
        couple half = {is_a ? halves[i] : c->a, is_a ? c->b : halves[i], c->after};
        d->out->visited++;
        if (couple_is_parts(&half) || !is_left_out(d, half.a, half.b, &half.after)) found[count++] = half;
    }
    int last_first = count == 2 && found[0].after <= found[1].after;
    for (int i = 0; i < count; i++) stack[i] = found[last_first ? count - 1 - i : i];
    return count;
}

// What waits on the stack may be left out by now: a hit was found before its balls meet. A proof needs its steps too.
static int is_late(descent *d, couple *c) {
    if (d->out->impact.status != OVOID_IMPACT_HIT) return 0;
    if (d->end <= d->begin) return 1;
    if (c->after < d->end) return 0;
    return !is_recording(d) || (!couple_is_parts(c) && is_left_out(d, c->a, c->b, &c->after));
}

static void descend(descent *d) {
    couple stack[2 * COMPOUND_DEPTH_MAX + 2];
    int top = 0;
    stack[top++] = (couple){d->view_a.nodes, d->view_b.nodes, d->begin};
    while (top > 0) {
        couple c = stack[--top];
        if (is_late(d, &c)) continue;
        if (couple_is_parts(&c))
            take_parts(d, c.a, c.b);
        else
            top += open_couple(d, &c, stack + top);
    }
}

// The deciding pair; again, where its steps alone are wanted.
static void finish(descent *d) {
    ovoid_compound_impact *out = d->out;
    ovoid_impact *best = &out->impact;
    uint32_t iterations = best->iterations;
    if (is_recording(d)) best->step_count = d->step_count;
    if (best->status == OVOID_IMPACT_FREE) return;
    out->part_a = solid_view_get_index(&d->view_a, d->place_a);
    out->part_b = solid_view_get_index(&d->view_b, d->place_b);
    if (!is_recording(d) && d->options.steps) {
        ovoid_moving a = moving_view_get_part(d->a, &d->view_a, d->place_a);
        ovoid_moving b = moving_view_get_part(d->b, &d->view_b, d->place_b);
        ovoid_motion_options o = make_options(d, d->window, d->tolerance);
        o.steps = d->options.steps;
        o.capacity = d->options.capacity;
        impact_find(&a, &b, d->margin, &o, 1e-9, best);
        best->iterations = iterations;
    }
    // Another pair may have been free for a shorter time without being hit.
    if (d->free_until < best->free_until) {
        best->free_until = d->free_until;
        if (best->limit == OVOID_LIMIT_NONE) best->limit = OVOID_LIMIT_PRECISION;
    }
}

// The solids as trees, and the times; what is refused is refused as of two parts.
static ovoid_limit start(descent *d, const ovoid_motion_options *given) {
    static const ovoid_motion_options none = {0};
    sweep s;
    d->options = given ? *given : none;
    moving_view_make(d->a, &d->view_a);
    moving_view_make(d->b, &d->view_b);
    ovoid_moving a = moving_view_get_part(d->a, &d->view_a, 0), b = moving_view_get_part(d->b, &d->view_b, 0);
    ovoid_limit limit = sweep_make(&s, &a, &b, &d->options, 1e-9);
    if (limit == OVOID_LIMIT_NONE && !(d->margin >= 0 && d->margin < INFINITY)) limit = OVOID_LIMIT_OPTIONS;
    d->begin = s.begin;
    d->end = s.end;
    d->tolerance = s.tolerance * (s.end - s.begin);
    return limit;
}

static ovoid_compound_impact find(const ovoid_moving_solid *a, const ovoid_moving_solid *b, double margin,
                                  const ovoid_motion_options *options) {
    OVOID_ASSERT(!a->shape != !a->compound && !b->shape != !b->compound);
    ovoid_compound_impact out = {.impact = {.hit_at = INFINITY}};
    ovoid_impact *x = &out.impact;
    descent d = {.a = a, .b = b, .margin = margin, .out = &out, .free_until = INFINITY};
    x->limit = start(&d, options);
    x->free = x->hit = answer_make_refused(x->limit);
    if (x->limit != OVOID_LIMIT_NONE) return out;
    double end = d.end;
    x->status = OVOID_IMPACT_FREE;
    descend(&d);
    finish(&d);
    x->begin = d.begin;
    x->end = end;
    if (x->status == OVOID_IMPACT_FREE) x->free_until = end;
    return out;
}

ovoid_compound_impact ovoid_compound_impact_find(const ovoid_moving_solid *a, const ovoid_moving_solid *b,
                                                 double margin, const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN(ovoid_compound_impact, margin, find(a, b, margin, options));
}

ovoid_moving ovoid_moving_solid_get_part(const ovoid_moving_solid *solid, size_t i) {
    if (!solid->compound) return (ovoid_moving){solid->shape, solid->motion, no_part};
    ovoid_body part = ovoid_compound_get_part(solid->compound, i);
    return (ovoid_moving){part.shape, solid->motion, part.pose};
}

// ---- boxes

static void join(ovoid_box *all, ovoid_box box) {
    all->low = (vec3){min2(all->low.x, box.low.x), min2(all->low.y, box.low.y), min2(all->low.z, box.low.z)};
    all->high = (vec3){max2(all->high.x, box.high.x), max2(all->high.y, box.high.y), max2(all->high.z, box.high.z)};
}

// The box of a part, or of the ball around a node.
static ovoid_box find_box(const ovoid_moving_solid *solid, const solid_view *view, const compound_node *n, double begin,
                          double end) {
    point_shape ball;
    ovoid_moving m =
        node_is_leaf(n) ? moving_view_get_part(solid, view, n->first) : moving_node_make_ball(solid, n, &ball);
    return ovoid_moving_compute_box(&m, begin, end);
}

static ovoid_box compute_box(const ovoid_moving_solid *solid, double begin, double end) {
    struct {
        const compound_node *node;
        int depth;
    } stack[2 * BOX_DEPTH + 2];
    OVOID_ASSERT(!solid->shape != !solid->compound);
    solid_view view;
    moving_view_make(solid, &view);
    ovoid_box all = find_box(solid, &view, view.nodes, begin, end);
    if (isnan(all.low.x) || node_is_leaf(view.nodes)) return all;
    all = (ovoid_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    int top = 0;
    stack[top].node = view.nodes;
    stack[top++].depth = 0;
    while (top > 0) {
        const compound_node *n = stack[--top].node;
        int depth = stack[top].depth + 1;
        if (depth > BOX_DEPTH || node_is_leaf(n)) {
            join(&all, find_box(solid, &view, n, begin, end));
            continue;
        }
        stack[top].node = node_get_left(n);
        stack[top++].depth = depth;
        stack[top].node = node_get_right(n);
        stack[top++].depth = depth;
    }
    return all;
}

ovoid_box ovoid_moving_solid_compute_box(const ovoid_moving_solid *solid, double begin, double end) {
    ENVIRONMENT_RETURN(ovoid_box, begin, compute_box(solid, begin, end));
}
