// The pool of searches in lanes. While there is a place, a couple begins there; when there is none, all groups go on by
// a step at a time until some couple ends.
#include "query/batch_small.h"

#include "base/compiler.h"

// Fewer couples do not pay for the lanes.
enum { FEW = 3 };

void small_pool_make(small_pool *pool, const query_goal *goal, small_owner owner, size_t count) {
    pool->kernels = gjk8_get_kernels();
    pool->goal = goal;
    pool->owner = owner;
    pool->has_lanes = count >= FEW;
    for (int i = 0; i < SMALL_POOL_GROUPS; i++) pool->groups[i].active = 0;
}

// Ends the lanes of a mask.
static void end_lanes(const small_pool *p, unsigned group, unsigned lanes, small_gjk_end how) {
    const gjk8 *g = &p->groups[group];
    for (; lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        const small_couple *c = &p->couples[PAIR8 * group + k];
        query_goal goal = *p->goal;
        goal.tolerance = c->tolerance;
        pair_frame f;
        f.size = c->size;
        f.hidden = OVOID_LENGTH_MIN;
        f.lower_radii = g->lower_radii.lane[k];
        f.upper_radii = g->upper_radii.lane[k];
        small_gjk_result r;
        small_end end;
        gjk8_get_result(g, k, how, &r);
        const placed_query q = {.frame = &c->frame, .goal = &goal};
        p->owner.finish(p->owner.self, c->index, &q, small_finish(&f, &goal, &r, &end) ? &end : NULL);
    }
}

static void advance(small_pool *p, unsigned group) {
    gjk8_ends e = p->kernels->advance(&p->groups[group]);
    end_lanes(p, group, e.apart, SMALL_GJK_APART);
    end_lanes(p, group, e.near, SMALL_GJK_NEAR);
    end_lanes(p, group, e.inside, SMALL_GJK_INSIDE);
    end_lanes(p, group, e.open, SMALL_GJK_OPEN);
}

// A group with a place.
static unsigned find_group(small_pool *p) {
    for (;;) {
        for (unsigned i = 0; i < SMALL_POOL_GROUPS; i++)
            if (p->groups[i].active != PAIR8_ALL) return i;
        for (unsigned i = 0; i < SMALL_POOL_GROUPS; i++) advance(p, i);
    }
}

// 1 where a place in the lanes costs more than it saves: the first supports end most searches of bodies far apart.
static int is_short(const placed_query *q) { return q->sphere_gap > q->frame->a->reach + q->frame->b->reach; }

// Searches a couple by itself.
static void run_alone(small_pool *p, size_t index, const placed_query *q, const small_gjk_query *gjk) {
    small_gjk_result r;
    small_end end;
    simd_run_small_gjk(gjk, &r);
    p->owner.finish(p->owner.self, index, q, small_finish(q->frame, q->goal, &r, &end) ? &end : NULL);
}

static void begin_in_lane(small_pool *p, size_t index, const placed_query *q, const small_gjk_query *gjk) {
    unsigned group = find_group(p), k = compiler_count_low_zeros(~p->groups[group].active);
    small_couple *c = &p->couples[PAIR8 * group + k];
    c->index = index;
    c->size = q->frame->size;
    c->tolerance = q->goal->tolerance;
    if (p->owner.keeps_frames) c->frame = *q->frame;
    p->kernels->begin(&p->groups[group], k, gjk);
}

void small_pool_add(small_pool *p, size_t index, const placed_query *q) {
    small_gjk_query gjk;
    small_end end;
    int is_over = small_begin(q, &gjk, &end);
    if (is_over >= 0)
        p->owner.finish(p->owner.self, index, q, is_over ? &end : NULL);
    else if (!p->has_lanes || is_short(q))
        run_alone(p, index, q, &gjk);
    else
        begin_in_lane(p, index, q, &gjk);
}

void small_pool_add_from(small_pool *p, size_t index, const placed_query *q, vec3 start) {
    small_gjk_query gjk = small_make_query(q->frame, q->goal);
    gjk.start[0] = start.x;
    gjk.start[1] = start.y;
    gjk.start[2] = start.z;
    if (p->has_lanes)
        begin_in_lane(p, index, q, &gjk);
    else
        run_alone(p, index, q, &gjk);
}

void small_pool_finish(small_pool *p) {
    for (unsigned i = 0; i < SMALL_POOL_GROUPS; i++)
        while (p->groups[i].active) advance(p, i);
}
