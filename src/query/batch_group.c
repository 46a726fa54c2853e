// The rounds of the search, in lanes or of few couples one by one with the same bits, and its ends. No lane ends apart,
// as no distance is beyond the goal's far end. Couples with the origin inside their corners, or that stall, go on as a
// couple alone does.
#include "query/batch_group.h"

#include "base/compiler.h"
#include "simd/group_gjk.h"

// A group at work, and the vertices of the corners that its lanes end with.
typedef struct group_work {
    const group_search *task;
    const lane_group *e;
    group_gjk gjk;
    uint32_t a[PAIR8][3], b[PAIR8][3];
} group_work;

static void put_corner(group_work *w, unsigned k, const gjk8_corner *corner) {
    group_gjk *s = &w->gjk;
    unsigned id = (unsigned)corner->id.lane[k], i = (unsigned)s->count.lane[k];
    s->count.lane[k] = i + 1;
    w->a[k][i] = id % SMALL_GJK_POINTS;
    w->b[k][i] = id / SMALL_GJK_POINTS;
    put3(&s->corner[3 * i], k, (vec3){corner->x.lane[k], corner->y.lane[k], corner->z.lane[k]});
    put3(&s->corner_a[3 * i], k, vec3_at(shape_vertices(get_a(w->e, k)->shape), w->a[k][i]));
}

// The simplex that each lane of a mask ended with.
static void put_corners(group_work *w, unsigned lanes) {
    const gjk8 *g = &w->gjk.search;
    for (; lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        w->gjk.count.lane[k] = 0;
        for (int i = 0; i < 3; i++)
            if (g->is_valid[i].lane[k] > 0) put_corner(w, k, &g->old[i]);
    }
}

static simplex get_corners(const group_work *w, unsigned k) {
    simplex found = {.count = (int)w->gjk.count.lane[k]};
    for (int i = 0; i < found.count; i++) {
        found.p[i].a = w->a[k][i];
        found.p[i].b = w->b[k][i];
        found.weight[i] = w->gjk.weight[i].lane[k];
    }
    return found;
}

static query_goal get_goal(const group_work *w, unsigned k) {
    query_goal goal = *w->task->goal;
    goal.tolerance = w->e->lanes->tolerance.lane[k];
    return goal;
}

static void finish(const group_work *w, unsigned k, const placed_query *query, const small_end *end) {
    const small_owner *owner = &w->task->owner;
    owner->finish(owner->self, w->e->index[k], query, end);
}

// What the verdict of a lane that ended at the nearest points says.
static small_end get_bounds(const group_work *w, unsigned k) {
    small_end end;
    end.lower = w->gjk.lower.lane[k];
    end.upper = w->gjk.upper.lane[k];
    end.iterations = (uint32_t)w->gjk.search.steps.lane[k];
    end.stage = end.iterations > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT;
    end.kind = OVOID_PROOF_POINTS;
    return end;
}

// The nearest points of a lane, from the origin of A's body frame.
COMPILER_INLINED small_points get_points(const group_work *w, unsigned k, vec3 normal) {
    const group_gjk *s = &w->gjk;
    small_points points = {get3(s->point_a, k), get3(s->point_b, k)};
    if (w->e->lanes->radii.lane[k] > 0) {
        pair_frame f;
        f.a = get_a(w->e, k)->shape;
        f.b = get_b(w->e, k)->shape;
        small_points_add_radii(&points, &f, normal);
    }
    return points;
}

// Ends a lane at the nearest points, for a verdict and the points alone: from the columns into their places, as numbers
// that are copied just after they were made would be waited for.
static void write_points(const group_work *w, unsigned k, const query_goal *goal) {
    const group_search *task = w->task;
    size_t index = w->e->index[k];
    vec3 origin = get_a(w->e, k)->pose.position, normal = get3(w->gjk.normal, k);
    small_end end = get_bounds(w, k);
    if (task->verdicts) task->verdicts[index] = answer_make_small_verdict(&end, goal);
    if (!task->witnesses) return;
    small_points points = get_points(w, k, normal);
    ovoid_witness *to = &task->witnesses[index];
    *to = (ovoid_witness){vec3_add(origin, points.a), vec3_add(origin, points.b), normal};
}

// The same for a proof.
static void end_with_corners(const group_work *w, unsigned k, const query_goal *goal) {
    const ovoid_posed_shape *a = get_a(w->e, k);
    pair_frame f;
    f.a = a->shape;
    f.b = get_b(w->e, k)->shape;
    const placed_query query = {.frame = &f, .goal = goal};
    small_end end = get_bounds(w, k);
    end.normal = get3(w->gjk.normal, k);
    end.has_witness = 1;
    small_points points = get_points(w, k, end.normal);
    end.point_a = vec3_add(a->pose.position, points.a);
    end.point_b = vec3_add(a->pose.position, points.b);
    end.points = get_corners(w, k);
    end.inner = (vec3){0, 0, 0};
    finish(w, k, &query, &end);
}

static void end_at_points(const group_work *w, unsigned k) {
    query_goal goal = get_goal(w, k);
    if (!query_goal_is_met(&goal, w->gjk.lower.lane[k], w->gjk.upper.lane[k]))
        finish(w, k, NULL, NULL);
    else if (w->task->wants_corners)
        end_with_corners(w, k, &goal);
    else
        write_points(w, k, &goal);
}

// Ends a lane with the origin inside its corners.
static void end_inside(const group_work *w, unsigned k) {
    query_goal goal = get_goal(w, k);
    pair_frame f;
    const placed_query query = {.frame = &f, .goal = &goal};
    small_gjk_result r;
    small_end end;
    place_frame((group_lane){w->e, k}, &f);
    gjk8_get_result(&w->gjk.search, k, SMALL_GJK_INSIDE, &r);
    finish(w, k, &query, small_finish(&f, &goal, &r, &end) ? &end : NULL);
}

// All rounds of the lanes at work; how they ended.
static gjk8_ends run_rounds(group_work *w, const group_gjk_kernels *kernels) {
    gjk8 *g = &w->gjk.search;
    const gjk8_kernels *steps = gjk8_get_kernels(w->e->lanes->count);
    const pair8 *o = w->e->lanes;
    kernels->support(o, &w->gjk);
    gjk8_ends all = kernels->start(&w->gjk);
    while (g->active) {
        kernels->support(o, &w->gjk);
        g->measured = g->active;
        gjk8_ends now = steps->advance(g);
        all.near |= now.near;
        all.inside |= now.inside;
        all.open |= now.open;
    }
    return all;
}

// Fewer lanes are searched one by one, each in less time than the steps of eight take.
enum { FEW = 4 };

// The same of each lane by itself.
static gjk8_ends run_each(group_work *w) {
    gjk8 *g = &w->gjk.search;
    gjk8_ends all = {0, 0, 0, 0};
    for (unsigned rest = g->active; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest), lane = 1u << k;
        query_goal goal = get_goal(w, k);
        pair_frame f;
        small_gjk_result r = {.end = SMALL_GJK_OPEN};
        place_frame((group_lane){w->e, k}, &f);
        small_gjk_query query = small_make_query(&f, &goal);
        double square = vec3_norm_squared(f.between);
        if (square > 1e-150 && square < 1e150) simd_run_small_gjk_unposed(&query, &r);
        if (r.end == SMALL_GJK_OPEN) {
            all.open |= lane;
            continue;
        }
        gjk8_put_result(g, k, &r);
        if (r.end == SMALL_GJK_INSIDE)
            all.inside |= lane;
        else
            all.near |= lane;
    }
    return all;
}

static unsigned count_lanes(unsigned some) {
    unsigned count = 0;
    for (; some; some &= some - 1) count++;
    return count;
}

void group_search_run(const group_search *task, const lane_group *e, unsigned some) {
    const group_gjk_kernels *kernels = group_gjk_get_kernels(e->lanes->count);
    group_work w;
    w.task = task;
    w.e = e;
    w.gjk.search.active = some;
    w.gjk.search.far = task->goal->far;
    w.gjk.search.near = task->goal->near;
    w.gjk.search.wants_bracket = task->goal->wants_bracket;
    for (unsigned rest = some; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        w.gjk.points_a[k] = shape_get_points(get_a(e, k)->shape);
        w.gjk.points_b[k] = shape_get_points(get_b(e, k)->shape);
    }
    kernels->begin(e->lanes, task->numbers, &w.gjk);
    gjk8_ends ends = count_lanes(some) < FEW ? run_each(&w) : run_rounds(&w, kernels);
    put_corners(&w, ends.near);
    kernels->finish(e->lanes, ends.near, &w.gjk);
    for (unsigned rest = ends.near; rest; rest &= rest - 1) end_at_points(&w, compiler_count_low_zeros(rest));
    for (unsigned rest = ends.inside; rest; rest &= rest - 1) end_inside(&w, compiler_count_low_zeros(rest));
    for (unsigned rest = ends.open; rest; rest &= rest - 1) finish(&w, compiler_count_low_zeros(rest), NULL, NULL);
}
