// The rounds of the search, in lanes or of few couples one by one with the same bits, and its ends. Couples that stall
// go on as a couple alone does.
#include "query/batch_group.h"

#include "base/compiler.h"
#include "simd/group_gjk.h"

// A group at work.
typedef struct group_work {
    const group_search *task;
    const lane_group *e;
    group_gjk gjk;
    group_result found; ///< of lanes that ended near
} group_work;

static void put_corner(group_work *w, unsigned k, const gjk8_corner *corner) {
    group_gjk *s = &w->gjk;
    unsigned id = (unsigned)corner->id.lane[k], i = (unsigned)s->count.lane[k];
    s->count.lane[k] = i + 1;
    w->found.a[k][i] = id % SMALL_GJK_POINTS;
    w->found.b[k][i] = id / SMALL_GJK_POINTS;
    put3(&s->corner[3 * i], k, (vec3){corner->x.lane[k], corner->y.lane[k], corner->z.lane[k]});
    put3(&s->corner_a[3 * i], k, vec3_at(shape_vertices(get_a(w->e, k)->shape), w->found.a[k][i]));
}

// The simplex that each lane of a mask ended with.
static void put_corners(group_work *w, unsigned lanes) {
    const gjk8 *g = &w->gjk.search;
    for (; lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        w->gjk.count.lane[k] = 0;
        for (int i = 0; i < 3; i++)
            if (g->is_valid[i].lane[k] > 0) put_corner(w, k, &g->old[i]);
        w->found.count[k] = (uint32_t)w->gjk.count.lane[k];
        w->found.steps[k] = (uint32_t)g->steps.lane[k];
    }
}

// What the verdict of a lane says that ended apart, with such bounds.
static small_end make_end(const group_work *w, unsigned k, double lower, double upper) {
    small_end end;
    end.lower = lower;
    end.upper = upper;
    end.iterations = (uint32_t)w->gjk.search.steps.lane[k];
    end.stage = end.iterations > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT;
    end.kind = OVOID_PROOF_POINTS;
    return end;
}

// Ends a lane apart, or with the origin inside its corners.
static void end_at_result(const group_work *w, unsigned k, const pair_frame *f, const small_gjk_result *r) {
    query_goal goal = group_get_goal(w->task, w->e, k);
    const placed_query query = {.frame = f, .goal = &goal};
    small_end end;
    group_finish(w->task, w->e->index[k], &query, small_finish(f, &goal, r, &end) ? &end : NULL);
}

static void end_lanes(const group_work *w, unsigned lanes, small_gjk_end how) {
    for (; lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        pair_frame f;
        small_gjk_result r;
        if (w->task->owner.wants_evidence) {
            lane_group_place_frame((group_lane){w->e, k}, &f);
        } else {
            f.size = w->e->lanes->size.lane[k];
            f.hidden = OVOID_LENGTH_MIN;
            f.lower_radii = f.upper_radii = w->e->lanes->radii.lane[k];
        }
        gjk8_get_result(&w->gjk.search, k, how, &r);
        end_at_result(w, k, &f, &r);
    }
}

// Lanes that ended apart: the columns have the bounds of small_finish.
static void end_apart(const group_work *w, unsigned lanes) {
    const group_search *task = w->task;
    const gjk8 *g = &w->gjk.search;
    if (task->owner.wants_evidence) {
        end_lanes(w, lanes, SMALL_GJK_APART);
        return;
    }
    for (; lanes && task->to->verdicts; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        query_goal goal = group_get_goal(w->task, w->e, k);
        small_end end = make_end(w, k, g->lower.lane[k], g->upper.lane[k]);
        task->to->verdicts[w->e->index[k]] = answer_make_small_verdict(&end, &goal);
    }
}

// All rounds of the lanes at work; how they ended.
static gjk8_ends run_rounds(group_work *w, const group_gjk_kernels *kernels) {
    gjk8 *g = &w->gjk.search;
    const pair8 *o = w->e->lanes;
    kernels->support(o, &w->gjk);
    gjk8_ends all = kernels->start(&w->gjk);
    while (g->active) {
        kernels->support(o, &w->gjk);
        gjk8_ends now = kernels->advance(g);
        all.apart |= now.apart;
        all.near |= now.near;
        all.inside |= now.inside;
        all.open |= now.open;
    }
    return all;
}

// The search of one lane in the kernel of a single pair, with the bits of the lanes.
static void run_alone(const group_work *w, unsigned k, pair_frame *f, small_gjk_result *r) {
    query_goal goal = group_get_goal(w->task, w->e, k);
    double square = w->gjk.search.square.lane[k];
    r->end = SMALL_GJK_OPEN;
    if (!(square > 1e-150 && square < 1e150)) return;
    lane_group_place_frame((group_lane){w->e, k}, f);
    small_gjk_query query = small_make_query(f, &goal);
    for (int i = 0; i < 3; i++) query.start[i] = w->gjk.search.start[i].lane[k];
    simd_run_small_gjk_unposed(&query, r);
}

static int is_apart(const group_work *w, unsigned k, const small_gjk_result *r) {
    const gjk8 *g = &w->gjk.search;
    return r->gap * r->scale - g->lower_radii.lane[k] - g->claim.lane[k] > g->far;
}

// Fewer lanes are searched one by one, each in less time than the steps of eight take.
enum { FEW = 3 };

// The searches of the lanes at work, each by itself. What ended apart or inside is answered; the others are left as
// run_rounds leaves them.
static gjk8_ends run_each(group_work *w) {
    gjk8 *g = &w->gjk.search;
    gjk8_ends all = {0, 0, 0, 0};
    for (unsigned rest = g->active; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest), lane = 1u << k;
        pair_frame f;
        small_gjk_result r;
        run_alone(w, k, &f, &r);
        if (r.end == SMALL_GJK_OPEN) {
            all.open |= lane;
        } else if (r.end == SMALL_GJK_INSIDE || is_apart(w, k, &r)) {
            end_at_result(w, k, &f, &r);
        } else {
            gjk8_put_result(g, k, &r);
            all.near |= lane;
        }
    }
    return all;
}

void group_search_run(const group_search *task, const lane_group *e, unsigned some) {
    const group_gjk_kernels *kernels = group_gjk_get_kernels(e->lanes->count);
    group_work w;
    w.task = task;
    w.e = e;
    w.gjk.is_along_n = task->is_along_n;
    w.gjk.search.active = some;
    w.gjk.search.far = task->goal->far;
    w.gjk.search.near = task->goal->near;
    w.gjk.search.wants_bracket = task->goal->wants_bracket;
    for (unsigned rest = some; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        const ovoid_shape *a = get_a(e, k)->shape, *b = get_b(e, k)->shape;
        w.gjk.points_a[k] = shape_get_points(a);
        w.gjk.points_b[k] = shape_get_points(b);
        w.gjk.vertices_a[k] = shape_vertices(a);
        w.gjk.vertices_b[k] = shape_vertices(b);
    }
    kernels->begin(e->lanes, task->numbers, &w.gjk);
    gjk8_ends ends = count_lanes(some) < FEW ? run_each(&w) : run_rounds(&w, kernels);
    end_apart(&w, ends.apart);
    end_lanes(&w, ends.inside, SMALL_GJK_INSIDE);
    if (ends.near) {
        put_corners(&w, ends.near);
        kernels->finish(e->lanes, ends.near, &w.gjk, &w.found.nearest);
        group_end_at_points(task, e, ends.near, &w.found);
    }
    for (unsigned rest = ends.open; rest; rest &= rest - 1)
        group_finish(task, e->index[compiler_count_low_zeros(rest)], NULL, NULL);
}
