// Updating one pair from step to step. docs/world.md derives how kept bounds are adjusted for the motion.
//
// Roundings: c, d and t are sums of a few terms, each bounded by |d| + t + |L|, and off by a few u of that. KEPT8_SLACK
// is subtracted when c is made and again when it is compared; reported bounds are moved by half as much, so that they
// always show the status that a comparison found.
#include "world/pair_update.h"

#include "body/body_find.h"
#include "exact/cover_memory.h"
#include "exact/small.h"
#include "simd/kept8.h"

#define SLACK_REPORTED 0x1p-49

static double sum_abs(vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

// ---- the cache and proofs

static void write_proof(const pair_cache *cache, ovoid_proof *p) {
    *p = (ovoid_proof){.normal = cache->normal, .kind = (ovoid_proof_kind)cache->proof, .count = cache->count};
    if (p->kind == OVOID_PROOF_INNER) {
        p->inner_a = cache->of.inner;
        return;
    }
    for (uint32_t i = 0; i < p->count; i++) {
        p->a[i] = cache->of.entry[i][0];
        p->b[i] = cache->of.entry[i][1];
        p->weight_a[i] = p->weight_b[i] = 1;
    }
}

static void cache_proof(pair_cache *cache, const ovoid_proof *p) {
    cache->normal = p->normal;
    cache->proof = (uint8_t)p->kind;
    cache->count = 0;
    if (p->kind == OVOID_PROOF_INNER) {
        cache->of.inner = p->inner_a;
        return;
    }
    // Indices beyond 16 bits are not cached: the warm start is slower, from the normal alone.
    for (uint32_t i = 0; i < p->count; i++)
        if (p->a[i] > UINT16_MAX || p->b[i] > UINT16_MAX) return;
    cache->count = (uint8_t)p->count;
    for (uint32_t i = 0; i < p->count; i++) {
        cache->of.entry[i][0] = (uint16_t)p->a[i];
        cache->of.entry[i][1] = (uint16_t)p->b[i];
    }
}

// ---- queries

static query_goal make_goal(const ovoid_world *w, uint32_t a, uint32_t b) {
    query_goal goal = query_goal_make_distance(NULL);
    switch (w->kind) {
    case OVOID_QUERY_COLLIDE: return query_goal_make_collide();
    case OVOID_QUERY_WITHIN: return query_goal_make_within(w->margin + world_get_pair_range(w, a, b));
    case OVOID_QUERY_DISTANCE: break;
    case OVOID_QUERY_DEPTH: goal.wants_depth = 1; break;
    }
    goal.far = w->margin;
    return goal;
}

void pair_query(const ovoid_world *w, ovoid_couple pair, const pair_cache *cache, ovoid_exclusions *exclusions,
                ovoid_body_answer *out) {
    const ovoid_body_pair both = {w->bodies[pair.a].body, w->bodies[pair.b].body};
    ovoid_body_proof earlier;
    if (cache && cache->proof == OVOID_PROOF_NONE) cache = NULL;
    if (cache) {
        earlier.part_a = cache->part_a;
        earlier.part_b = cache->part_b;
        write_proof(cache, &earlier.proof);
    }
    const query_goal goal = make_goal(w, pair.a, pair.b);
    body_find_internal(&both, &(body_request){&w->query_options, &goal, cache ? &earlier : NULL, exclusions}, out);
}

// d and t of a pair at the present poses.
static vec3 find_between(const ovoid_world *w, const world_pair *p, double *travel) {
    const body_place *a = &w->places[p->a], *b = &w->places[p->b];
    *travel = a->travel + b->travel;
    return vec3_sub(b->at, a->at);
}

void pair_set_age(const ovoid_world *w, world_pair *p, const pair_cache *cache) {
    double margin = w->margin, range = world_get_pair_range(w, p->a, p->b);
    double slack =
        KEPT8_SLACK * (sum_abs(cache->between) + cache->travel + fabs(cache->lower) + fabs(cache->upper) + margin);
    // The ranges of bodies change from step to step: a comparison adds those of its own step.
    int is_far = cache->lower > margin + range;
    p->kind = PAIR_OPEN;
    p->flags &= (uint16_t)~PAIR_CONTACT;
    if (!is_far) p->flags |= PAIR_CONTACT;
    int are_shapes = w->bodies[p->a].body.shape && w->bodies[p->b].body.shape;
    if (is_far && are_shapes && cache->stage == OVOID_STAGE_SPHERE) {
        // Three times the present centre error exceeds the part of any later one that the positions do not explain.
        const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
        double reach = (a->reach + b->reach) + (a->radius + b->radius);
        p->kind = PAIR_SPHERE;
        p->v = (vec3){0, 0, 0};
        p->c = (reach + margin) * (1 + 0x1p-48) + 3 * (a->center_error + b->center_error);
        return;
    }
    if (is_far && are_shapes && vec3_norm_squared(cache->normal) > 0.5) {
        p->kind = PAIR_PLANE;
        p->v = cache->normal;
        p->c = ((cache->lower - margin) - vec3_dot(cache->normal, cache->between)) + cache->travel - slack;
        return;
    }
    // Witness points move with the bodies and must be measured again. Compounds and solids have a normal for each pair
    // of parts; their bounds are adjusted by the motion of the points alone (docs/world.md).
    if (world_is_measuring(w) && p->flags & PAIR_CONTACT) return;
    double lasts = -cache->upper;
    if (is_far)
        lasts = cache->lower - margin;
    else if (cache->status == OVOID_SEPARATED)
        lasts = min2(cache->lower, margin - cache->upper);
    if (!(lasts > 0)) return;
    p->kind = PAIR_BALL;
    p->v = cache->between;
    p->c = lasts + cache->travel - slack;
}

double pair_compute_age(const ovoid_world *w, const world_pair *p, const pair_cache *cache) {
    double t;
    vec3 d = find_between(w, p, &t);
    return (vec3_norm(vec3_sub(d, cache->between)) + (t - cache->travel)) +
           SLACK_REPORTED * (sum_abs(d) + sum_abs(cache->between) + t + fabs(cache->lower) + fabs(cache->upper));
}

// 1 if the cached proof was of an overlap and has just been measured: it does not hold. Only a search of many vertices
// begins at its differences.
static int has_failed(const ovoid_world *w, const pair_cache *cache, const ovoid_pair *pair) {
    int is_small = pair->shape_a->padded_count <= SMALL_POINTS_SIGN && pair->shape_b->padded_count <= SMALL_POINTS_SIGN;
    return is_small && cache->status == OVOID_OVERLAPPING && !world_is_measuring(w);
}

// The memory of a kept depth as a cover, which shows what is in it.
static ovoid_cover show_kept(kept_depth *kept) {
    return (ovoid_cover){
        kept->point_count, kept->triangle_count, kept->of.a, kept->of.b, (const uint16_t(*)[3])kept->of.triangles,
        &kept->of,         sizeof kept->of};
}

// cover: with memory for the search, or NULL: then a depth starts from the surface of the last one, and keeps its own.
static void query_shapes(const ovoid_world *w, const world_pair *p, ovoid_cover *cover, ovoid_answer *out) {
    const pair_cache *cache = &w->pair_cache[p->slot];
    const ovoid_body *a = &w->bodies[p->a].body, *b = &w->bodies[p->b].body;
    ovoid_pair both = {a->shape, b->shape, a->pose, b->pose};
    ovoid_proof earlier;
    int is_warm = cache->proof != OVOID_PROOF_NONE && !has_failed(w, cache, &both);
    if (is_warm) write_proof(cache, &earlier);
    const query_goal goal = make_goal(w, p->a, p->b);
    ovoid_options options = w->query_options;
    options.iterations = cover_get_iterations(cover, options.iterations);
    query_request request = {.options = &options, .goal = &goal, .earlier = is_warm ? &earlier : NULL, .cover = cover};
    if (w->kind != OVOID_QUERY_DEPTH) {
        answer_find_internal(&both, &request, out);
        return;
    }
    kept_depth *kept = &w->depths[p->slot];
    ovoid_cover last = show_kept(kept), next = last;
    next.point_count = next.triangle_count = 0;
    if (!cover) request.cover = &next;
    if (!cover && is_warm && earlier.kind == OVOID_PROOF_COVER && last.point_count) request.kept = &last;
    answer_find_internal(&both, &request, out);
    kept->point_count = next.point_count;
    kept->triangle_count = next.triangle_count;
}

static void cache_answer(ovoid_world *w, const world_pair *p, pair_cache *cache, const ovoid_answer *answer) {
    const ovoid_verdict verdict = answer_get_verdict(answer);
    pair_cache_verdict(cache, &verdict);
    cache_proof(cache, &answer->proof);
    if (world_has_witnesses(w))
        w->witnesses[p->slot] = (ovoid_witness){answer->point_a, answer->point_b, answer->normal};
}

static void query_pair(ovoid_world *w, const world_pair *p, ovoid_cover *cover) {
    pair_cache *cache = &w->pair_cache[p->slot];
    if (w->bodies[p->a].body.shape && w->bodies[p->b].body.shape) {
        ovoid_answer x;
        query_shapes(w, p, cover, &x);
        cache_answer(w, p, cache, &x);
        return;
    }
    ovoid_body_answer x;
    ovoid_exclusions with_cover = {.cover = cover};
    pair_query(w, (ovoid_couple){p->a, p->b}, cache, cover ? &with_cover : NULL, &x);
    cache->part_a = x.part_a;
    cache->part_b = x.part_b;
    ovoid_answer own = ovoid_body_answer_get_answer(&x);
    cache_answer(w, p, cache, &own);
}

void pair_renew(const ovoid_world *w, world_pair *p, pair_cache *cache) {
    cache->between = find_between(w, p, &cache->travel);
    p->flags |= PAIR_STILL | PAIR_KNOWN;
    pair_set_age(w, p, cache);
}

void pair_update_with(ovoid_world *w, world_pair *p, ovoid_cover *cover) {
    pair_cache *cache = &w->pair_cache[p->slot];
    p->flags &= (uint16_t)~PAIR_FULL;
    query_pair(w, p, cover);
    if (!cover && w->kind == OVOID_QUERY_DEPTH && cache->limit == OVOID_LIMIT_CAPACITY) p->flags |= PAIR_FULL;
    pair_renew(w, p, cache);
}

void pair_update(ovoid_world *w, world_pair *p) {
    pair_cache *cache = &w->pair_cache[p->slot];
    if (pair_revalidate(w, p, cache))
        pair_renew(w, p, cache);
    else
        pair_update_with(w, p, NULL);
}

// ---- contacts

ovoid_contact pair_make_contact(const ovoid_world *w, const world_pair *p) {
    const pair_cache *cache = &w->pair_cache[p->slot];
    ovoid_contact contact = {.a = body_get_id(w, p->a),
                             .b = body_get_id(w, p->b),
                             .user_a = w->bodies[p->a].user,
                             .user_b = w->bodies[p->b].user,
                             .part_a = cache->part_a,
                             .part_b = cache->part_b};
    contact.verdict = (ovoid_verdict){(ovoid_status)cache->status,
                                      (ovoid_stage)cache->stage,
                                      (ovoid_limit)cache->limit,
                                      cache->iterations,
                                      cache->lower,
                                      cache->upper};
    if (p->flags & PAIR_STILL) return contact;
    double age = pair_compute_age(w, p, cache);
    contact.verdict = (ovoid_verdict){.status = (ovoid_status)cache->status,
                                      .stage = OVOID_STAGE_PROOF,
                                      .limit = OVOID_LIMIT_ANSWERED,
                                      .lower = cache->lower - age,
                                      .upper = cache->upper + age};
    return contact;
}
