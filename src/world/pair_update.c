// Updating one pair from step to step. docs/world.md derives how kept bounds are adjusted for the motion.
//
// Roundings: c, d and t are sums of a few terms, each bounded by |d| + t + |L|, and off by a few u of that. SLACK_SET
// is subtracted when c is made and again when it is compared; reported bounds are moved by half as much, so that they
// always show the status that a comparison found.
#include "world/pair_update.h"

#include "body/body_find.h"

#define SLACK_SET 0x1p-48
#define SLACK_REPORTED 0x1p-49

static double sum_abs(vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

// ---- the cache and proofs

static void write_proof(const pair_cache *k, ovoid_proof *p) {
    *p = (ovoid_proof){.normal = k->normal, .kind = (ovoid_proof_kind)k->proof, .count = k->count};
    if (p->kind == OVOID_PROOF_INNER) {
        p->inner_a = k->of.inner;
        return;
    }
    for (uint32_t i = 0; i < p->count; i++) {
        p->a[i] = k->of.entry[i][0];
        p->b[i] = k->of.entry[i][1];
        p->weight_a[i] = p->weight_b[i] = 1;
    }
}

static void cache_proof(pair_cache *k, const ovoid_proof *p) {
    k->normal = p->normal;
    k->proof = (uint8_t)p->kind;
    k->count = 0;
    if (p->kind == OVOID_PROOF_INNER) {
        k->of.inner = p->inner_a;
        return;
    }
    // Indices beyond 16 bits are not cached: the warm start is slower, from the normal alone.
    for (uint32_t i = 0; i < p->count; i++)
        if (p->a[i] > UINT16_MAX || p->b[i] > UINT16_MAX) return;
    k->count = (uint8_t)p->count;
    for (uint32_t i = 0; i < p->count; i++) {
        k->of.entry[i][0] = (uint16_t)p->a[i];
        k->of.entry[i][1] = (uint16_t)p->b[i];
    }
}

// ---- queries

static query_goal make_goal(const ovoid_world *w) {
    query_goal goal = query_goal_make_distance(NULL);
    switch (w->kind) {
    case OVOID_QUERY_COLLIDE: return query_goal_make_collide();
    case OVOID_QUERY_WITHIN: return query_goal_make_within(w->margin);
    case OVOID_QUERY_DISTANCE: break;
    case OVOID_QUERY_DEPTH: goal.wants_depth = 1; break;
    }
    goal.far = w->margin;
    return goal;
}

void pair_query(const ovoid_world *w, const ovoid_body_pair *both, const pair_cache *k, ovoid_exclusions *exclusions,
                ovoid_body_answer *out) {
    ovoid_body_proof earlier;
    if (k && k->proof == OVOID_PROOF_NONE) k = NULL;
    if (k) {
        earlier.part_a = k->part_a;
        earlier.part_b = k->part_b;
        write_proof(k, &earlier.proof);
    }
    body_find_internal(both, &w->query_options, make_goal(w), k ? &earlier : NULL, exclusions, out);
}

// d and t of a pair at the present poses.
static vec3 find_between(const ovoid_world *w, const world_pair *p, double *travel) {
    const body_place *a = &w->places[p->a], *b = &w->places[p->b];
    *travel = a->travel + b->travel;
    return vec3_sub(b->at, a->at);
}

void pair_set_age(const ovoid_world *w, world_pair *p, const pair_cache *k) {
    double margin = w->margin;
    double slack = SLACK_SET * (sum_abs(k->between) + k->travel + fabs(k->lower) + fabs(k->upper) + margin);
    p->kind = PAIR_OPEN;
    p->flags &= (uint16_t)~PAIR_CONTACT;
    if (!(k->lower > margin)) p->flags |= PAIR_CONTACT;
    int are_shapes = w->bodies[p->a].body.shape && w->bodies[p->b].body.shape;
    if (k->lower > margin && are_shapes && k->stage == OVOID_STAGE_SPHERE) {
        // Three times the present centre error exceeds the part of any later one that the positions do not explain.
        const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
        double reach = (a->reach + b->reach) + (a->radius + b->radius);
        p->kind = PAIR_SPHERE;
        p->c = (reach + margin) * (1 + 0x1p-48) + 3 * (a->center_error + b->center_error);
        return;
    }
    if (k->lower > margin && are_shapes && vec3_norm_squared(k->normal) > 0.5) {
        p->kind = PAIR_PLANE;
        p->v = k->normal;
        p->c = ((k->lower - margin) - vec3_dot(k->normal, k->between)) + k->travel - slack;
        return;
    }
    // Witness points move with the bodies and must be measured again. Compounds and solids have a normal for each pair
    // of parts; their bounds are adjusted by the motion of the points alone (docs/world.md).
    if (world_is_measuring(w) && p->flags & PAIR_CONTACT) return;
    double lasts = -k->upper;
    if (k->lower > margin)
        lasts = k->lower - margin;
    else if (k->status == OVOID_SEPARATED)
        lasts = min2(k->lower, margin - k->upper);
    if (!(lasts > 0)) return;
    p->kind = PAIR_BALL;
    p->v = k->between;
    p->c = lasts + k->travel - slack;
}

// The error of both centres that comes from their positions: 128 u of a position (body_bounds.c).
static double find_center_error(const ovoid_world *w, const world_pair *p) {
    return 0x1p-45 * (sum_abs(w->places[p->a].at) + sum_abs(w->places[p->b].at));
}

int pair_is_answered(const ovoid_world *w, const world_pair *p) {
    double t;
    vec3 d = find_between(w, p, &t);
    double slack = SLACK_SET * (sum_abs(d) + t + fabs(p->c));
    if (p->kind == PAIR_PLANE) return p->c + vec3_dot(p->v, d) - t > slack;
    if (p->kind == PAIR_BALL) return p->c - vec3_norm(vec3_sub(d, p->v)) - t > slack;
    return p->kind == PAIR_SPHERE && vec3_norm(d) > p->c + slack + find_center_error(w, p);
}

double pair_compute_age(const ovoid_world *w, const world_pair *p, const pair_cache *k) {
    double t;
    vec3 d = find_between(w, p, &t);
    return (vec3_norm(vec3_sub(d, k->between)) + (t - k->travel)) +
           SLACK_REPORTED * (sum_abs(d) + sum_abs(k->between) + t + fabs(k->lower) + fabs(k->upper));
}

static void query_shapes(const ovoid_world *w, const world_pair *p, const pair_cache *k, ovoid_answer *out) {
    const ovoid_body *a = &w->bodies[p->a].body, *b = &w->bodies[p->b].body;
    ovoid_pair both = {a->shape, b->shape, a->pose, b->pose};
    ovoid_proof earlier;
    int is_warm = k->proof != OVOID_PROOF_NONE;
    if (is_warm) write_proof(k, &earlier);
    answer_find_internal(&both, &w->query_options, make_goal(w), is_warm ? &earlier : NULL, NULL, out);
}

static void cache_answer(ovoid_world *w, const world_pair *p, pair_cache *k, const ovoid_answer *answer) {
    k->lower = answer->lower;
    k->upper = answer->upper;
    k->status = (uint8_t)answer->status;
    k->stage = (uint8_t)answer->stage;
    k->limit = (uint8_t)answer->limit;
    k->iterations = answer->iterations;
    cache_proof(k, &answer->proof);
    if (world_is_measuring(w))
        w->witnesses[p->slot] = (ovoid_witness){answer->point_a, answer->point_b, answer->normal};
}

static void query_pair(ovoid_world *w, const world_pair *p, pair_cache *k) {
    if (w->bodies[p->a].body.shape && w->bodies[p->b].body.shape) {
        ovoid_answer x;
        query_shapes(w, p, k, &x);
        cache_answer(w, p, k, &x);
        return;
    }
    ovoid_body_answer x;
    ovoid_body_pair both = {w->bodies[p->a].body, w->bodies[p->b].body};
    pair_query(w, &both, k, NULL, &x);
    k->part_a = x.part_a;
    k->part_b = x.part_b;
    ovoid_answer own = ovoid_body_answer_get_answer(&x);
    cache_answer(w, p, k, &own);
}

void pair_update(ovoid_world *w, world_pair *p) {
    pair_cache *k = &w->pair_cache[p->slot];
    if (!(p->flags & PAIR_KNOWN) || !pair_revalidate(w, p, k)) query_pair(w, p, k);
    k->between = find_between(w, p, &k->travel);
    p->flags |= PAIR_STILL | PAIR_KNOWN;
    pair_set_age(w, p, k);
}

// ---- contacts

ovoid_contact pair_make_contact(const ovoid_world *w, const world_pair *p) {
    const pair_cache *k = &w->pair_cache[p->slot];
    ovoid_contact contact = {.a = body_get_id(w, p->a),
                             .b = body_get_id(w, p->b),
                             .user_a = w->bodies[p->a].user,
                             .user_b = w->bodies[p->b].user,
                             .part_a = k->part_a,
                             .part_b = k->part_b};
    contact.verdict = (ovoid_verdict){
        (ovoid_status)k->status, (ovoid_stage)k->stage, (ovoid_limit)k->limit, k->iterations, k->lower, k->upper};
    if (p->flags & PAIR_STILL) return contact;
    double age = pair_compute_age(w, p, k);
    contact.verdict = (ovoid_verdict){.status = (ovoid_status)k->status,
                                      .stage = OVOID_STAGE_PROOF,
                                      .limit = OVOID_LIMIT_ANSWERED,
                                      .lower = k->lower - age,
                                      .upper = k->upper + age};
    return contact;
}
