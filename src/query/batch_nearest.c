// Soundness: floats prove nothing. Every bound is one of doubles, made from the corners that floats name with the
// operations of the search in doubles (exact/small.h), and has its errors; a direction or a simplex that is not the
// best widens the bracket, and a couple whose bracket is wider than was asked is queried alone.
#include "query/batch_nearest.h"

#include "base/compiler.h"
#include "shape/floats.h"

static const lane_group *get_group(const batch_nearest *w, unsigned k) { return w->at[k / PAIR8]; }
static const ovoid_shape *get_shape_a(const batch_nearest *w, unsigned k) {
    return (const void *)get_group(w, k)->at.shape_a[k % PAIR8];
}
static const ovoid_shape *get_shape_b(const batch_nearest *w, unsigned k) {
    return (const void *)get_group(w, k)->at.shape_b[k % PAIR8];
}

static void leave_alone(const batch_nearest *w, unsigned lanes) {
    for (; lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        group_finish(w->task, get_group(w, k)->index[k % PAIR8], NULL, NULL);
    }
}

// ---- the search

// Sets what the search reads of couple `from` beside its numbers.
static void put_couple(batch_nearest *w, unsigned from, float_points *to, unsigned k) {
    const ovoid_shape *a = get_shape_a(w, from), *b = get_shape_b(w, from);
    const float_shape *of_a = shape_get_floats(a), *of_b = shape_get_floats(b);
    double scale = w->numbers[from / PAIR8].scale.lane[from % PAIR8];
    to->a[k] = shape_get_float_columns(a);
    to->b[k] = shape_get_float_columns(b);
    to->blocks_a[k] = a->padded_count / 8;
    to->blocks_b[k] = b->padded_count / 8;
    w->search.query.factor_a.lane[k] = (float)(of_a->unit * scale);
    w->search.query.factor_b.lane[k] = (float)(of_b->unit * scale);
}

// Runs the search of the lanes to its end.
static float_ends run(batch_nearest *w, const float_gjk_kernels *kernels, const float_points *points, unsigned lanes) {
    w->search.live = 0;
    kernels->load(points, lanes, &w->search);
    return kernels->approach(&w->search, lanes);
}

// All lanes at once. The rows of lanes that are none repeat one of them.
static void search_lanes(batch_nearest *w, unsigned some) {
    float_column *columns = (float_column *)&w->search.query;
    float_points points;
    unsigned any = compiler_count_low_zeros(some);
    for (unsigned g = 0; g < w->count; g++)
        for (int i = 0; i < FLOAT_NUMBERS; i++)
            memcpy(columns[i].lane + PAIR8 * g, w->numbers[g].numbers[i], sizeof w->numbers[g].numbers[i]);
    for (unsigned k = 0; k < PAIR8 * w->count; k++) put_couple(w, some >> k & 1 ? k : any, &points, k);
    float_ends ends = run(w, float_gjk_get_kernels(PAIR8 * w->count), &points, some);
    w->near = ends.near;
    w->inside = ends.inside;
    w->found = &w->search.found;
}

// The lanes one by one.
static void search_each(batch_nearest *w, unsigned some) {
    float_column *columns = (float_column *)&w->search.query;
    const float_column *found = (const float_column *)&w->search.found;
    float_column *own = (float_column *)&w->own;
    for (; some; some &= some - 1) {
        unsigned k = compiler_count_low_zeros(some);
        float_points points;
        for (int i = 0; i < FLOAT_NUMBERS; i++) columns[i].lane[0] = w->numbers[k / PAIR8].numbers[i][k % PAIR8];
        put_couple(w, k, &points, 0);
        float_ends ends = run(w, float_gjk_get_kernels(1), &points, 1);
        w->near |= ends.near << k;
        w->inside |= ends.inside << k;
        for (size_t i = 0; i < sizeof w->own / sizeof *own && !ends.open; i++) own[i].lane[k] = found[i].lane[0];
    }
    w->found = &w->own;
}

// So few couples, one more where they have more than eight vertices, take less time one by one.
enum { FEW = 3 };

static void search_all(batch_nearest *w, unsigned some) {
    uint32_t iterations = w->task->goal->iterations, most = 8;
    w->near = w->inside = 0;
    if (!some) return;
    for (unsigned rest = some; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        uint32_t a = get_shape_a(w, k)->padded_count, b = get_shape_b(w, k)->padded_count;
        most = a > most ? a : most;
        most = b > most ? b : most;
    }
    w->search.blocks = most / 8;
    w->search.most = (float)(iterations < 24 ? iterations : 24);
    if (count_lanes(some) <= (w->search.blocks > 1 ? FEW + 1 : FEW))
        search_each(w, some);
    else
        search_lanes(w, some);
}

// ---- the ends, in doubles

// An overlap: the hull of the four corners holds the origin.
static void end_inside(const batch_nearest *w, unsigned k) {
    const lane_group *e = get_group(w, k);
    pair_frame frame;
    small_end end;
    query_goal goal = group_get_goal(w->task, e, k % PAIR8);
    uint32_t a[4], b[4];
    for (int i = 0; i < 4; i++) {
        uint32_t id = (uint32_t)w->found->corner[i].lane[k];
        a[i] = id % FLOAT_GJK_POINTS;
        b[i] = id / FLOAT_GJK_POINTS;
    }
    lane_group_place_frame((group_lane){e, k % PAIR8}, &frame);
    const placed_query query = {&frame, &goal, NULL, e->lanes->lower.lane[k % PAIR8], 0};
    int is_proven = small_end_at_hull(&query, a, b, &end);
    end.stage = OVOID_STAGE_GJK;
    end.iterations = (uint32_t)w->found->steps.lane[k];
    group_finish(w->task, e->index[k % PAIR8], &query, is_proven ? &end : NULL);
}

// The corners of a lane that ended near.
COMPILER_INLINED void put_corners(const batch_nearest *w, unsigned k, group_corners *to, group_result *r) {
    const float_found *found = w->found;
    const ovoid_shape *a = get_shape_a(w, k), *b = get_shape_b(w, k);
    const double *of_a = shape_vertices(a), *of_b = shape_vertices(b);
    unsigned lane = k % PAIR8;
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t id = (uint32_t)found->corner[i].lane[k], in_a = id % FLOAT_GJK_POINTS, in_b = id / FLOAT_GJK_POINTS;
        to->a[i][lane] = of_a + 3 * (size_t)in_a;
        to->b[i][lane] = of_b + 3 * (size_t)in_b;
        r->a[lane][i] = in_a;
        r->b[lane][i] = in_b;
    }
    to->count.lane[lane] = found->count.lane[k];
    to->points_a[lane] = shape_get_points(a);
    to->points_b[lane] = shape_get_points(b);
    r->count[lane] = (uint32_t)found->count.lane[k];
    r->steps[lane] = (uint32_t)found->steps.lane[k];
}

// Of a lane that did not, so that it can be read: the origin.
static void put_nothing(unsigned lane, group_corners *to) {
    static const double nowhere[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) to->a[i][lane] = to->b[i][lane] = nowhere;
    to->count.lane[lane] = 1;
}

// The lanes of a group that ended near.
static void end_near(const batch_nearest *w, unsigned g) {
    const lane_group *e = w->at[g];
    unsigned lanes = w->near >> PAIR8 * g & PAIR8_ALL;
    group_corners corners;
    group_result r;
    if (!lanes) return;
    for (unsigned k = 0; k < PAIR8; k++)
        if (lanes >> k & 1)
            put_corners(w, PAIR8 * g + k, &corners, &r);
        else
            put_nothing(k, &corners);
    group_gjk_get_kernels(e->lanes->count)->measure(e->lanes, w->task->numbers, lanes, &corners, &r.nearest);
    leave_alone(w, (lanes & ~corners.good) << PAIR8 * g);
    group_end_at_points(w->task, e, lanes & corners.good, &r);
}

// Searches all groups, which are free then.
static void search_groups(batch_nearest *w) {
    unsigned asked = 0, some = 0;
    for (unsigned g = 0; g < w->count; g++) {
        unsigned good = w->kernels->floats(w->at[g]->lanes, w->task->numbers, &w->numbers[g]);
        some |= (w->some[g] & good) << PAIR8 * g;
        asked |= w->some[g] << PAIR8 * g;
    }
    search_all(w, some);
    leave_alone(w, asked & ~(w->near | w->inside));
    for (unsigned rest = w->inside; rest; rest &= rest - 1) end_inside(w, compiler_count_low_zeros(rest));
    for (unsigned g = 0; g < w->count; g++) end_near(w, g);
    w->count = 0;
}

void batch_nearest_begin(batch_nearest *w, const group_search *task, const pair8_kernels *kernels) {
    w->task = task;
    w->kernels = kernels;
    w->count = 0;
    for (unsigned g = 0; g < NEAREST_GROUPS; g++) {
        w->groups[g].lanes = &w->lanes[g];
        w->at[g] = &w->groups[g];
    }
    w->far.lanes = &w->lanes[NEAREST_GROUPS];
}

void batch_nearest_add(batch_nearest *w, lane_group **place, unsigned some) {
    lane_group *free = w->at[w->count];
    w->at[w->count] = *place;
    w->some[w->count++] = some;
    *place = free;
    if (w->count == NEAREST_GROUPS) search_groups(w);
}

void batch_nearest_end(batch_nearest *w) {
    if (w->count) search_groups(w);
}
