// Most couples of a batch are decided by their enclosing spheres or ellipsoids, which cost the same for every couple:
// so a lane group of eight couples is taken at once, without a branch. Couples that the spheres leave open are packed
// into full lane groups before they go on to the ellipsoids. Small ones are then searched in their group
// (batch_group.h); of a distance, before any ellipsoid, in single precision (batch_nearest.h). The yes or no of plain
// bodies without evidence is in single precision from the start (batch_floats.h). Others go on to the exact search, one
// by one, where the supports along the ellipsoids' direction leave them open. A couple that is in any way unusual (a
// far origin, a quaternion to be scaled, a refused pose) is queried alone, from the start; so is one with an earlier
// proof that the spheres leave open.
//
// No lane depends on the others, so nothing depends on which couples share a group, and a batch may be cut anywhere.
// Working memory: six lane groups on the stack, 31 KB, and what is in single precision, 40 KB; they are gone while the
// couples that they left open are searched, which takes more.
#include "query/batch_simd.h"

#include "base/compiler.h"
#include "base/error.h"
#include "exact/closed.h"
#include "pair/reject.h"
#include "query/batch_floats.h"
#include "query/batch_group.h"
#include "query/batch_nearest.h"

// A couple that the lanes leave open, with what they found.
typedef struct open_couple {
    size_t index;
    double lower, upper;
    vec3 n; ///< the direction of `lower`, along which a and b are extreme
    uint32_t a, b;
} open_couple;

// Couples that wait when a block of FLOATS is taken: PAIR8_GROUPS groups, and less than one each of few small ones, far
// ones and the next; in single precision less than two blocks before its search, FLOAT_COUPLES in all. The
// block itself may be left open, too. What its search leaves open is queried alone.
enum {
    WAITING_MOST = (PAIR8_GROUPS + 3) * PAIR8 + 3 * FLOATS,
    OPEN_MOST = 136,
    OPEN_FULL = OPEN_MOST - WAITING_MOST,
    ALONE_MOST = OPEN_MOST + FLOAT_COUPLES,
    ALONE_FULL = ALONE_MOST - WAITING_MOST - FLOAT_COUPLES
};

typedef struct open_list {
    open_couple items[OPEN_MOST];
    size_t alone[ALONE_MOST]; ///< couples of which nothing is known
    unsigned count, alone_count;
} open_list;

// Small couples to be searched, from groups that have few of them.
typedef struct few_couples {
    lane_group *group;
    unsigned count;
    int is_far; // of a distance: to be searched in doubles
} few_couples;

typedef struct batch_state {
    const ovoid_batch *batch;
    const pair8_kernels *kernels;
    const query_goal *goal; ///< without the tolerance, which is each couple's own
    const ovoid_options *options;
    pair8_query numbers;
    int wants_evidence; ///< answers, proofs or points, not only verdicts
    size_t next[PAIR8]; ///< the couples of the next group
    unsigned next_count;
    lane_group *own;                   ///< the group that is taken through the spheres, where none of these has room
    lane_group *waiting[PAIR8_GROUPS]; ///< couples on their way to the ellipsoids
    unsigned waiting_count;
    few_couples few, far;
    batch_floats *floats;   ///< of a yes or no without evidence; else NULL
    batch_nearest *nearest; ///< of a distance without a cap; else NULL
    open_list *open;
} batch_state;

static void leave_alone(const batch_state *c, size_t index) { c->open->alone[c->open->alone_count++] = index; }

// 1 if a couple has no earlier proof, or one that holds nothing.
static int is_blank(const ovoid_proof *p) {
    return p->kind == OVOID_PROOF_NONE && p->count == 0 && !(p->normal.x != 0 || p->normal.y != 0 || p->normal.z != 0);
}

void batch_write(const ovoid_batch *batch, size_t i, const ovoid_answer *answer) {
    if (batch->proofs) batch->proofs[i] = answer->proof;
    if (batch->verdicts) batch->verdicts[i] = answer_get_verdict(answer);
    if (batch->answers && answer != &batch->answers[i]) batch->answers[i] = *answer;
    if (batch->witnesses) batch->witnesses[i] = (ovoid_witness){answer->point_a, answer->point_b, answer->normal};
}

static void write_verdict(const ovoid_batch *batch, size_t i, ovoid_verdict verdict) {
    if (batch->verdicts) batch->verdicts[i] = verdict;
}

static ovoid_pair get_pair(const ovoid_batch *batch, size_t i) {
    const ovoid_posed_shape *a = &batch->bodies[batch->couples[i].a], *b = &batch->bodies[batch->couples[i].b];
    return (ovoid_pair){a->shape, b->shape, a->pose, b->pose};
}

void batch_query_single(const ovoid_batch *batch, size_t i, const query_goal *goal) {
    ovoid_pair pair = get_pair(batch, i);
    ovoid_answer own, *out = batch->answers ? &batch->answers[i] : &own;
    const ovoid_proof *earlier = batch->proofs && !is_blank(&batch->proofs[i]) ? &batch->proofs[i] : NULL;
    answer_find_internal(&pair, &(query_request){.options = batch->options, .goal = goal, .earlier = earlier}, out);
    batch_write(batch, i, out);
}

// ---- one lane

// The frame of a lane after the ellipsoids, as frame_make makes it.
static pair_frame get_frame(group_lane at) {
    pair_frame f;
    lane_group_place_frame(at, &f);
    f.rotation = get9(at.e->lanes->rotation, at.k);
    f.translation = get3(at.e->lanes->translation, at.k);
    return f;
}

static query_goal get_goal(const batch_state *c, group_lane at) {
    query_goal goal = *c->goal;
    goal.tolerance = at.e->lanes->tolerance.lane[at.k];
    return goal;
}

// The verdict of a stage that answered the query, from the lane's bounds.
static void write_bounds(const batch_state *c, group_lane at, ovoid_stage stage, unsigned narrow) {
    double lower = at.e->lanes->lower.lane[at.k], upper = at.e->lanes->upper.lane[at.k];
    ovoid_status status = lower > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING;
    ovoid_limit wide = lower > c->goal->far ? c->goal->beyond : OVOID_LIMIT_ANSWERED;
    ovoid_limit limit = narrow >> at.k & 1 ? OVOID_LIMIT_NONE : wide;
    write_verdict(c->batch, at.e->index[at.k], (ovoid_verdict){status, stage, limit, 0, lower, upper});
}

// Ends a lane that the spheres decided. Its evidence is that of the line of their centres.
static void end_at_spheres(const batch_state *c, group_lane at, const pair8_found *found) {
    if (!c->wants_evidence) {
        write_bounds(c, at, OVOID_STAGE_SPHERE, found->narrow);
        return;
    }
    pair_frame frame;
    query_goal goal = get_goal(c, at);
    lane_group_place_frame(at, &frame);
    ovoid_answer own, *out = c->batch->answers ? &c->batch->answers[at.e->index[at.k]] : &own;
    double lower = at.e->lanes->lower.lane[at.k];
    vec3 line = found->origin >> at.k & 1 ? frame.offset : frame.between;
    *out = rejection_make_answer(&(rejection){lower, vec3_unit(line), 0, 0, OVOID_STAGE_SPHERE}, &frame, &goal);
    // The verdict's bracket, which knows no vertex where the origins decided.
    out->upper = at.e->lanes->upper.lane[at.k];
    out->limit = found->narrow >> at.k & 1 ? OVOID_LIMIT_NONE : goal.beyond;
    batch_write(c->batch, at.e->index[at.k], out);
}

// The search as the lane's stage leaves it; *frame must outlive the search.
static search get_search(const batch_state *c, group_lane at, ovoid_stage stage, pair_frame *frame) {
    search s;
    query_goal goal = get_goal(c, at);
    *frame = get_frame(at);
    search_make(&s, frame, &goal);
    s.stage = stage;
    return s;
}

static void end_search(const ovoid_batch *batch, int wants_evidence, size_t index, search *s) {
    if (!wants_evidence) {
        write_verdict(batch, index, answer_make_verdict(s));
        return;
    }
    ovoid_answer own, *out = batch->answers ? &batch->answers[index] : &own;
    answer_write(s, out);
    batch_write(batch, index, out);
}

static void end_at_inner(const batch_state *c, group_lane at, unsigned narrow) {
    if (!c->wants_evidence) {
        write_bounds(c, at, OVOID_STAGE_INNER, narrow);
        return;
    }
    pair_frame frame;
    search s = get_search(c, at, OVOID_STAGE_INNER, &frame);
    s.upper = at.e->lanes->upper.lane[at.k];
    s.kind = OVOID_PROOF_INNER;
    s.inner_a = get3(at.e->lanes->inner, at.k);
    end_search(c->batch, c->wants_evidence, at.e->index[at.k], &s);
}

static void end_at_outer(const batch_state *c, group_lane at, unsigned narrow) {
    if (!c->wants_evidence) {
        write_bounds(c, at, OVOID_STAGE_OUTER, narrow);
        return;
    }
    pair_frame frame;
    search s = get_search(c, at, OVOID_STAGE_OUTER, &frame);
    s.lower = at.e->lanes->lower.lane[at.k];
    s.normal = get3(at.e->lanes->n, at.k);
    end_search(c->batch, c->wants_evidence, at.e->index[at.k], &s);
}

// Ends a couple of small bodies (small_owner).
static void end_small(void *self, size_t index, const placed_query *q, const small_end *end) {
    const batch_state *c = self;
    const ovoid_batch *to = c->batch;
    if (!end) {
        leave_alone(c, index);
        return;
    }
    write_verdict(to, index, answer_make_small_verdict(end, q->goal));
    if (to->proofs) answer_write_small_proof(end, &to->proofs[index]);
    if (to->witnesses) answer_write_small_witness(end, q->frame, &to->witnesses[index]);
    if (to->answers) to->answers[index] = answer_make_small(end, q->frame, q->goal);
}

// The supports left it open: the exact search goes on from their corner, later.
static void leave_open(const batch_state *c, group_lane at, uint32_t a, uint32_t b) {
    const pair8 *o = at.e->lanes;
    c->open->items[c->open->count++] =
        (open_couple){at.e->index[at.k], o->lower.lane[at.k], o->upper.lane[at.k], get3(o->n, at.k), a, b};
}

// What is known after the supports.
static void take_supports(search *s, const open_couple *couple, simplex *start) {
    vec3 w = frame_difference(s->frame, couple->a, couple->b);
    *start = (simplex){.p = {{w, couple->a, couple->b}}, .weight = {1}, .count = 1};
    s->stage = OVOID_STAGE_SUPPORT;
    s->lower = couple->lower;
    s->normal = couple->n;
    s->upper = couple->upper;
    s->kind = OVOID_PROOF_POINTS;
    s->witness = evidence_make(start);
}

// Takes the result of the supports: the couple is answered, or left open.
static void end_at_support(const batch_state *c, group_lane at, uint32_t a, uint32_t b) {
    double lower = at.e->lanes->lower.lane[at.k], upper = at.e->lanes->upper.lane[at.k];
    query_goal goal = get_goal(c, at);
    int is_met = query_goal_is_met(&goal, lower, upper);
    if (!is_met) {
        leave_open(c, at, a, b);
    } else if (goal.wants_bracket && at.e->lanes->radii.lane[at.k] > 0) {
        // If radii overlap, the single query takes a second look (stage_support).
        leave_alone(c, at.e->index[at.k]);
    } else if (!c->wants_evidence) {
        write_bounds(c, at, OVOID_STAGE_SUPPORT, (unsigned)(upper - lower <= goal.tolerance) << at.k);
    } else {
        pair_frame frame;
        search s = get_search(c, at, OVOID_STAGE_SUPPORT, &frame);
        open_couple couple = {.lower = lower, .upper = upper, .n = get3(at.e->lanes->n, at.k), .a = a, .b = b};
        simplex start;
        take_supports(&s, &couple, &start);
        end_search(c->batch, 1, at.e->index[at.k], &s);
    }
}

// The exact search of a couple that was left open.
static void search_open(const batch_state *c, const open_couple *couple) {
    ovoid_pair pair = get_pair(c->batch, couple->index);
    pair_frame frame;
    search s;
    simplex start;
    query_goal goal = *c->goal;
    (void)frame_make(&pair, &frame);
    goal.tolerance = options_compute_tolerance(c->options, frame.size, frame.hidden);
    search_make(&s, &frame, &goal);
    take_supports(&s, couple, &start);
    answer_search(&s, &pair, &start);
    end_search(c->batch, c->wants_evidence, couple->index, &s);
}

COMPILER_NOINLINE static void search_all_open(const batch_state *c) {
    const open_list *open = c->open;
    for (unsigned i = 0; i < open->count; i++) search_open(c, &open->items[i]);
    for (unsigned i = 0; i < open->alone_count; i++) batch_query_single(c->batch, open->alone[i], c->goal);
}

// ---- a lane group

// The first `count` lanes are in use; the others repeat lane 0.
static void fill(lane_group *e, unsigned count) {
    e->lanes->count = count;
    for (unsigned k = count; k < PAIR8; k++) {
        e->at.pose_a[k] = e->at.pose_a[0];
        e->at.pose_b[k] = e->at.pose_b[0];
        e->at.shape_a[k] = e->at.shape_a[0];
        e->at.shape_b[k] = e->at.shape_b[0];
    }
}

// The vertices of the supports of a lane group.
typedef struct lane_ends {
    uint32_t a[PAIR8], b[PAIR8];
} lane_ends;

// The supports of the lanes `some` along their directions n and `low`.
static void find_supports(const lane_group *e, unsigned some, lane_ends *found) {
    pair8 *o = e->lanes;
    for (unsigned rest = some; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        const ovoid_shape *a = get_a(e, k)->shape, *b = get_b(e, k)->shape;
        simd_pair ends = shapes_find_pair(a, b, get3(o->n, k), get3(o->low, k));
        o->high_value.lane[k] = ends.high.value;
        o->low_value.lane[k] = ends.low.value;
        put3(o->vertex_a, k, vec3_at(shape_vertices(a), found->a[k] = ends.high.index));
        put3(o->vertex_b, k, vec3_at(shape_vertices(b), found->b[k] = ends.low.index));
    }
}

// The supports along the ellipsoids' direction for the lanes of `open`.
static void meet(const batch_state *c, const lane_group *e, unsigned open) {
    lane_ends ends;
    find_supports(e, open, &ends);
    c->kernels->supports(e->lanes);
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        end_at_support(c, (group_lane){e, k}, ends.a[k], ends.b[k]);
    }
}

static pair8_ellipsoids find_ellipsoids(const lane_group *e) {
    pair8_ellipsoids rows;
    for (unsigned k = 0; k < PAIR8; k++) {
        const ovoid_shape *a = get_a(e, k)->shape, *b = get_b(e, k)->shape;
        rows.outer_a[k] = &a->outer.center.x;
        rows.outer_b[k] = &b->outer.center.x;
        rows.inner_a[k] = a->inside.w;
        rows.inner_b[k] = b->inside.w;
    }
    return rows;
}

// ---- couples that wait

// Fills the columns of a waiting group. Couples that came from several groups are placed again, in lanes: this costs
// less than copying some forty columns lane by lane.
static void place_again(const batch_state *c, lane_group *e) {
    pair8_query numbers = c->numbers;
    numbers.keeps_all = 1;
    if (!e->is_placed) (void)c->kernels->spheres(&e->at, &numbers, e->lanes);
}

// Appends lane k of e to a group of couples that wait, at lane `at`; e may be that group.
static void append(lane_group *to, unsigned at, const lane_group *e, unsigned k) {
    to->index[at] = e->index[k];
    to->at.pose_a[at] = e->at.pose_a[k];
    to->at.pose_b[at] = e->at.pose_b[k];
    to->at.shape_a[at] = e->at.shape_a[k];
    to->at.shape_b[at] = e->at.shape_b[k];
    to->is_placed = 0;
}

// ---- searches of small bodies

static group_search get_search_task(batch_state *c) {
    return (group_search){c->goal, &c->numbers, c->goal->far < INFINITY, {end_small, c, c->wants_evidence}, c->batch};
}

// Searches the lanes `some` of a group.
static void search_group(batch_state *c, const lane_group *e, unsigned some) {
    const group_search task = get_search_task(c);
    group_search_run(&task, e, some);
}

// Searches the lanes `some` of a group; in single precision those of a distance that are not far apart. Then the group
// may be another one.
static void search_lanes(batch_state *c, lane_group **place, unsigned some, int is_far) {
    if (c->nearest && !is_far)
        batch_nearest_add(c->nearest, place, some);
    else
        search_group(c, *place, some);
}

// Searches the few that wait.
static void search_few(batch_state *c, few_couples *few) {
    if (!few->count) return;
    unsigned some = (1u << few->count) - 1;
    fill(few->group, few->count);
    place_again(c, few->group);
    few->count = 0;
    search_lanes(c, &few->group, some, few->is_far);
}

// Fewer lanes of a group do not pay for its search.
enum { FEW = 6 };

// Searches the lanes `some` at once or, where they are few and there are other groups, with those of these.
static void search_or_wait(batch_state *c, lane_group **place, unsigned some, few_couples *few) {
    const lane_group *e = *place;
    if (count_lanes(some) >= FEW || c->batch->couple_count <= PAIR8) {
        search_lanes(c, place, some, few->is_far);
        return;
    }
    for (; some; some &= some - 1) {
        unsigned k = compiler_count_low_zeros(some);
        if (c->goal->far < INFINITY) put3(few->group->lanes->n, few->count, get3(e->lanes->n, k));
        append(few->group, few->count++, e, k);
        if (few->count == PAIR8) search_few(c, few);
    }
}

// ---- the ellipsoids

// The small couples of a yes or no among the lanes `open`: their search begins along the ellipsoids' direction.
static unsigned find_small(const batch_state *c, const lane_group *e, unsigned open) {
    unsigned small = 0;
    if (c->goal->far == INFINITY) return 0;
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        small |= (unsigned)small_fits(c->goal, get_a(e, k)->shape, get_b(e, k)->shape, 0) << k;
    }
    return small;
}

// Ends the lanes `some` of a group after the ellipsoids.
static void end_group(batch_state *c, lane_group **place, unsigned some, const pair8_found *found) {
    const lane_group *e = *place;
    for (unsigned rest = some; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        if (found->odd >> k & 1)
            leave_alone(c, e->index[k]);
        else if (found->inner >> k & 1)
            end_at_inner(c, (group_lane){e, k}, found->narrow);
        else if (found->apart >> k & 1)
            end_at_outer(c, (group_lane){e, k}, found->narrow);
    }
    unsigned open = some & ~(found->odd | found->inner | found->apart);
    unsigned small = find_small(c, e, open);
    if (small) search_or_wait(c, place, small, &c->few);
    open &= ~small;
    if (open) meet(c, e, open);
}

// Distances of bodies far apart start from the line of centres.
static void choose_directions(const batch_state *c, pair8 *o) {
    for (unsigned k = 0; k < PAIR8; k++)
        o->line.lane[k] = c->goal->far == INFINITY && o->lower.lane[k] > o->reach.lane[k];
}

// Takes all waiting couples through the ellipsoids to their answers.
static void settle(batch_state *c) {
    unsigned groups = (c->waiting_count + PAIR8 - 1) / PAIR8, last = c->waiting_count % PAIR8;
    pair8_group waiting[PAIR8_GROUPS];
    for (unsigned i = 0; i < groups; i++) {
        fill(c->waiting[i], i + 1 == groups && last ? last : PAIR8);
        place_again(c, c->waiting[i]);
        choose_directions(c, c->waiting[i]->lanes);
        waiting[i].from = find_ellipsoids(c->waiting[i]);
        waiting[i].lanes = c->waiting[i]->lanes;
    }
    c->kernels->ellipsoids(waiting, groups, &c->numbers);
    for (unsigned i = 0; i < groups; i++)
        end_group(c, &c->waiting[i], i + 1 == groups && last ? (1u << last) - 1 : PAIR8_ALL, &waiting[i].found);
    c->waiting_count = 0;
}

// Appends lane k of e to the waiting couples; e may be the group that it goes to.
static void wait_for_others(batch_state *c, const lane_group *e, unsigned k) {
    append(c->waiting[c->waiting_count / PAIR8], c->waiting_count % PAIR8, e, k);
    c->waiting_count++;
}

// How many couples ahead the beginning of shapes is prefetched; bodies twice as many.
enum { AHEAD = 16 };

static void fetch_first(const ovoid_shape *shape) {
    if (!shape) return;
    compiler_prefetch(shape);
    compiler_prefetch((const char *)shape + 64);
}

static void fetch_ahead(const ovoid_batch *batch, size_t first) {
    const ovoid_couple *couples = batch->couples;
    for (size_t i = first + 2 * AHEAD; i < first + 2 * AHEAD + PAIR8 && i < batch->couple_count; i++) {
        compiler_prefetch(&batch->bodies[couples[i].a]);
        compiler_prefetch(&batch->bodies[couples[i].b]);
    }
    for (size_t i = first + AHEAD; i < first + AHEAD + PAIR8 && i < batch->couple_count; i++) {
        fetch_first(batch->bodies[couples[i].a].shape);
        fetch_first(batch->bodies[couples[i].b].shape);
    }
}

// Prefetches the ellipsoids of a couple that goes on to them.
static void fetch_ellipsoids(const ovoid_shape *shape) {
    const char *from = (const char *)&shape->outer, *to = (const char *)&shape->inside + sizeof shape->inside - 1;
    for (; from < to; from += 64) compiler_prefetch(from);
    compiler_prefetch(to);
}

// 1 for a couple that must be queried alone.
static unsigned is_unusual(const ovoid_shape *a, const ovoid_shape *b) {
    return a->has_origin | b->has_origin | a->has_allowance | b->has_allowance;
}

// Stands in the lanes for a body without a shape, whose couple is refused alone.
static const ovoid_shape no_shape;
static const ovoid_posed_shape no_body = {&no_shape, {{0, 0, 0}, {1, 0, 0, 0}}};

// Lane k of a group becomes a couple. 1 for an unusual one.
static unsigned put_place(const ovoid_batch *batch, size_t i, lane_group *e, unsigned k) {
    const ovoid_posed_shape *a = &batch->bodies[batch->couples[i].a], *b = &batch->bodies[batch->couples[i].b];
    unsigned is_missing = !a->shape || !b->shape;
    if (is_missing) a = b = &no_body;
    e->index[k] = i;
    e->at.pose_a[k] = &a->pose.position.x;
    e->at.pose_b[k] = &b->pose.position.x;
    e->at.shape_a[k] = (const void *)a->shape;
    e->at.shape_b[k] = (const void *)b->shape;
    return is_missing | is_unusual(a->shape, b->shape);
}

// Fills a lane group with the next couples. The mask of unusual couples.
static unsigned find_places(const batch_state *c, lane_group *e) {
    unsigned odd = 0;
    for (unsigned k = 0; k < c->next_count; k++) odd |= put_place(c->batch, c->next[k], e, k) << k;
    fill(e, c->next_count);
    return odd;
}

// The lanes of `open` that have an earlier proof: after the spheres their queries go another way than the lanes. A
// proof is not read where the spheres part the bodies.
COMPILER_NOINLINE static unsigned find_warm(const ovoid_batch *batch, const lane_group *e, unsigned open) {
    unsigned warm = 0;
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        warm |= (unsigned)!is_blank(&batch->proofs[e->index[k]]) << k;
    }
    return warm;
}

// ---- the spheres

// The query of a lane as it stands after the spheres; the frame and the goal must outlive it.
static placed_query place_query(const batch_state *c, group_lane at, pair_frame *frame, query_goal *goal) {
    *goal = get_goal(c, at);
    lane_group_place_frame(at, frame);
    return (placed_query){frame, goal, NULL, at.e->lanes->lower.lane[at.k], 0};
}

// Answers a couple that has a closed form, or leaves it to be queried alone.
static void end_at_closed(batch_state *c, group_lane at) {
    pair_frame frame;
    query_goal goal;
    small_end end;
    placed_query query = place_query(c, at, &frame, &goal);
    end_small(c, at.e->index[at.k], &query, closed_run(&query, &end) ? &end : NULL);
}

// Of a distance in lanes the inner ellipsoids are tried only where they are nearly sure to overlap: the search takes
// less time in lanes than alone.
#define DEEP_DISTANCE (-0.6)

// Fewer lanes are tried at their inner ellipsoids one by one.
enum { FEW_DEEP = 4 };

// Ends those of the lanes `deep` whose inner ellipsoids have a common point; their mask.
static unsigned end_at_common(batch_state *c, const lane_group *e, unsigned deep) {
    int is_few = count_lanes(deep) < FEW_DEEP;
    unsigned tried = deep, ended = 0;
    pair8_common common;
    if (!is_few) {
        pair8_ellipsoids rows = find_ellipsoids(e);
        tried &= c->kernels->inner(&rows, &c->numbers, e->lanes, &common);
    }
    for (; tried; tried &= tried - 1) {
        unsigned k = compiler_count_low_zeros(tried);
        pair_frame frame;
        query_goal goal;
        small_end end;
        placed_query query = place_query(c, (group_lane){e, k}, &frame, &goal);
        if (!is_few)
            small_end_at_inner(&query, get3(common.x, k), common.upper.lane[k], &end);
        else if (!small_run_inner(&query, &end))
            continue;
        end_small(c, e->index[k], &query, &end);
        ended |= 1u << k;
    }
    return ended;
}

// Of bodies a sum of radii apart the first support is mostly the answer: it takes less time in doubles than floats take
// to begin with.

// Answers those of the lanes `open` that have a closed form, and searches the small ones from the line of centres where
// a distance is asked for, which needs no ellipsoids, unless the inner ones decide it. Those that are small alone, but
// too large for lanes, are left to be queried alone. The mask of all these.
static unsigned add_small(batch_state *c, lane_group **place, unsigned open) {
    const lane_group *e = *place;
    unsigned small = 0, searched = 0, deep = 0, far = 0;
    int is_distance = c->goal->far == INFINITY;
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest), lane = 1u << k;
        const ovoid_shape *a = get_a(e, k)->shape, *b = get_b(e, k)->shape;
        double sphere_gap = e->lanes->lower.lane[k];
        if (closed_fits(a, b))
            end_at_closed(c, (group_lane){e, k});
        else if (!is_distance || !small_takes(c->goal, a, b, sphere_gap))
            continue;
        else if (!small_fits(c->goal, a, b, sphere_gap))
            leave_alone(c, e->index[k]);
        else
            searched |= lane;
        small |= lane;
        if (sphere_gap < DEEP_DISTANCE * e->lanes->reach.lane[k]) deep |= lane;
        if (sphere_gap > e->lanes->reach.lane[k]) far |= lane;
    }
    deep &= searched;
    if (deep) searched &= ~end_at_common(c, e, deep);
    far &= searched;
    if (far) search_or_wait(c, place, far, &c->far);
    searched &= ~far;
    if (searched) search_or_wait(c, place, searched, &c->few);
    return small;
}

// Takes the next couples through the spheres. They are placed where they would wait, so that a group that the spheres
// leave open stays there.
static void take_next(batch_state *c) {
    lane_group **place = c->waiting_count % PAIR8 ? &c->own : &c->waiting[c->waiting_count / PAIR8], *e = *place;
    unsigned count = c->next_count, odd = find_places(c, e), all = (1u << count) - 1;
    c->next_count = 0;
    pair8_found found = c->kernels->spheres(&e->at, &c->numbers, e->lanes);
    odd |= found.odd;
    unsigned apart = found.apart & ~odd & all, open = all & ~(odd | apart);
    unsigned warm = c->batch->proofs ? find_warm(c->batch, e, open) : 0;
    open &= ~warm;
    for (unsigned rest = (odd & all) | warm; rest; rest &= rest - 1)
        leave_alone(c, e->index[compiler_count_low_zeros(rest)]);
    for (unsigned rest = apart; rest; rest &= rest - 1)
        end_at_spheres(c, (group_lane){e, compiler_count_low_zeros(rest)}, &found);
    if (open) open &= ~add_small(c, place, open);
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        fetch_ellipsoids((const void *)e->at.shape_a[k]);
        fetch_ellipsoids((const void *)e->at.shape_b[k]);
    }
    if (open == all && e != c->own) {
        c->waiting_count += count;
        e->is_placed = 1;
    } else
        for (; open; open &= open - 1) wait_for_others(c, e, compiler_count_low_zeros(open));
    // Without room for another group, the waiting ones go first.
    if (c->waiting_count > PAIR8 * (PAIR8_GROUPS - 1)) settle(c);
}

static void take(batch_state *c, size_t index) {
    c->next[c->next_count++] = index;
    if (c->next_count == PAIR8) take_next(c);
}

// ---- single precision

// Couples that floats leave open, or that are not for them (batch_floats).
static void leave_float_open(void *self, size_t index) { leave_alone(self, index); }
static void take_float_odd(void *self, size_t index) { take(self, index); }

// A yes or no of which only the verdicts are wanted.
static int wants_floats(const batch_state *c) {
    return !c->wants_evidence && c->batch->verdicts && c->goal->far < INFINITY &&
           c->goal->beyond == OVOID_LIMIT_ANSWERED;
}

static void begin_floats(batch_state *c, batch_floats *floats) {
    floats->kernels = float_gjk_get_kernels(c->batch->couple_count);
    floats->alone = float_gjk_get_kernels(1);
    floats->goal = c->goal;
    floats->options = c->options;
    floats->batch = c->batch;
    floats->verdicts = c->batch->verdicts;
    floats->normals = NULL;
    floats->corners = NULL;
    floats->leave_open = leave_float_open;
    floats->pass_on = take_float_odd;
    floats->self = c;
    batch_floats_begin(floats);
    c->floats = floats;
}

// What is asked in single precision: a yes or no, or a distance.
typedef union single_room {
    batch_floats floats;
    batch_nearest nearest;
} single_room;

// The couples from `first` on, as many as floats take at once.
static void take_some(batch_state *c, size_t first) {
    size_t left = c->batch->couple_count - first, end = first + (left < FLOATS ? left : FLOATS);
    for (size_t i = first; i < end; i++) {
        if (i % PAIR8 == 0) fetch_ahead(c->batch, i);
        take(c, i);
    }
}

// 1 if there is room for what these, and those that wait, may leave open.
static int has_room(const open_list *open) { return open->count <= OPEN_FULL && open->alone_count <= ALONE_FULL; }

// Runs from couple `first` on, until enough couples are left open or all are done; returns the next one. The working
// memory of the state is here.
COMPILER_NOINLINE static size_t run_lanes(batch_state *c, size_t first) {
    pair8 lanes[PAIR8_GROUPS + 2];
    lane_group groups[PAIR8_GROUPS + 2], *next = groups;
    single_room room;
    for (unsigned i = 0; i < PAIR8_GROUPS + 2; i++) groups[i].lanes = &lanes[i];
    for (unsigned i = 0; i < PAIR8_GROUPS; i++) c->waiting[i] = next++;
    c->own = next++;
    c->few = (few_couples){next, 0, 0};
    c->far = (few_couples){&room.nearest.far, 0, 1};
    c->waiting_count = c->next_count = 0;
    const group_search task = get_search_task(c);
    if (wants_floats(c)) begin_floats(c, &room.floats);
    if (c->goal->far == INFINITY) batch_nearest_begin(c->nearest = &room.nearest, &task, c->kernels);
    size_t count = c->batch->couple_count;
    for (; first < count && has_room(c->open); first += FLOATS)
        if (c->floats)
            batch_floats_take(c->floats, first);
        else
            take_some(c, first);
    if (c->floats) batch_floats_end(c->floats);
    if (c->next_count) take_next(c);
    if (c->waiting_count) settle(c);
    search_few(c, &c->far);
    search_few(c, &c->few);
    if (c->nearest) batch_nearest_end(c->nearest);
    c->floats = NULL;
    c->nearest = NULL;
    return first;
}

void batch_run(const ovoid_batch *batch, query_goal *goal, const ovoid_options *options) {
    open_list open;
    int wants_evidence = batch->answers || batch->proofs || batch->witnesses;
    batch_state c = {.batch = batch,
                     .kernels = pair8_get_kernels(batch->couple_count),
                     .goal = goal,
                     .options = options,
                     .numbers = {goal->far, goal->near, options->absolute_tolerance, options->relative_tolerance,
                                 FRAME_REJECT, FRAME_CLAIM, OVOID_LENGTH_MIN, OVOID_LENGTH_MAX, options->iterations,
                                 goal->far < INFINITY ? 1 : 2, wants_evidence},
                     .wants_evidence = wants_evidence,
                     .open = &open};
    goal->iterations = options->iterations;
    for (size_t next = 0; next < batch->couple_count;) {
        open.count = open.alone_count = 0;
        next = run_lanes(&c, next);
        search_all_open(&c);
    }
}
