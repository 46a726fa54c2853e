// The pool of searches in lanes. While there is a place, a couple begins there; when there is none, all groups go on by
// a step at a time until some couple ends.
#include "query/batch_small.h"

#include "base/compiler.h"

// Fewer couples do not pay for the lanes.
enum { FEW = 6 };

void small_pool_make(small_pool *pool, const query_goal *goal, small_owner owner, size_t count) {
    pool->kernels = gjk8_get_kernels(count);
    pool->goal = goal;
    pool->owner = owner;
    pool->has_lanes = count >= FEW;
    pool->place = 0;
    for (int i = 0; i < SMALL_POOL_GROUPS; i++) {
        pool->groups[i].bodies = &pool->bodies[PAIR8 * i];
        pool->groups[i].active = pool->groups[i].measured = 0;
    }
}

// small_finish of a lane that ended apart, for a verdict alone: the lanes have its bounds.
static void finish_apart(const gjk8 *g, unsigned k, small_end *end) {
    end->lower = g->lower.lane[k];
    end->upper = g->upper.lane[k];
    end->iterations = (uint32_t)g->steps.lane[k];
    end->stage = end->iterations > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT;
    end->kind = OVOID_PROOF_POINTS;
}

// Ends the lanes of a mask.
static void end_lanes(const small_pool *p, unsigned group, unsigned lanes, small_gjk_end how) {
    const gjk8 *g = &p->groups[group];
    for (; lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        const small_couple *c = &p->couples[PAIR8 * group + k];
        query_goal goal = *p->goal;
        goal.tolerance = c->tolerance;
        const placed_query q = {.frame = &c->frame, .goal = &goal};
        small_gjk_result r;
        small_end end;
        int is_answered = 1;
        if (how == SMALL_GJK_APART && !p->owner.wants_evidence) {
            finish_apart(g, k, &end);
        } else {
            pair_frame f;
            f.size = c->size;
            f.hidden = OVOID_LENGTH_MIN;
            f.lower_radii = g->lower_radii.lane[k];
            f.upper_radii = g->upper_radii.lane[k];
            gjk8_get_result(g, k, how, &r);
            is_answered = small_finish(&f, &goal, &r, &end);
        }
        p->owner.finish(p->owner.self, c->index, &q, is_answered ? &end : NULL);
    }
}

static void advance(small_pool *p, unsigned group) {
    gjk8_ends e = p->kernels->advance(&p->groups[group]);
    end_lanes(p, group, e.apart, SMALL_GJK_APART);
    end_lanes(p, group, e.near, SMALL_GJK_NEAR);
    end_lanes(p, group, e.inside, SMALL_GJK_INSIDE);
    end_lanes(p, group, e.open, SMALL_GJK_OPEN);
}

// A place that no couple has.
static unsigned find_place(small_pool *p) {
    for (;;) {
        for (unsigned i = 0; i < SMALL_POOL_GROUPS; i++)
            if (p->groups[i].active != PAIR8_ALL) return PAIR8 * i + compiler_count_low_zeros(~p->groups[i].active);
        for (unsigned i = 0; i < SMALL_POOL_GROUPS; i++) advance(p, i);
    }
}

pair_frame *small_pool_get_frame(small_pool *p) {
    p->place = find_place(p);
    return p->owner.wants_evidence ? &p->couples[p->place].frame : &p->frame;
}

// Searches a couple by itself.
static void run_alone(small_pool *p, size_t index, const placed_query *q, const small_gjk_query *gjk) {
    small_gjk_result r;
    small_end end;
    simd_run_small_gjk(gjk, &r);
    p->owner.finish(p->owner.self, index, q, small_finish(q->frame, q->goal, &r, &end) ? &end : NULL);
}

static void begin_in_lane(small_pool *p, size_t index, const placed_query *q, const small_gjk_query *gjk) {
    small_couple *c = &p->couples[p->place];
    c->index = index;
    c->size = q->frame->size;
    c->tolerance = q->goal->tolerance;
    p->kernels->begin(&p->groups[p->place / PAIR8], p->place % PAIR8, gjk);
}

void small_pool_add(small_pool *p, size_t index, const placed_query *q, const small_start *start) {
    small_gjk_query gjk = small_make_query(q->frame, q->goal);
    gjk.start[0] = start->direction.x;
    gjk.start[1] = start->direction.y;
    gjk.start[2] = start->direction.z;
    gjk.first = start->first;
    if (p->has_lanes)
        begin_in_lane(p, index, q, &gjk);
    else
        run_alone(p, index, q, &gjk);
}

void small_pool_finish(small_pool *p) {
    for (unsigned i = 0; i < SMALL_POOL_GROUPS; i++)
        while (p->groups[i].active) advance(p, i);
}
