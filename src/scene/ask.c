// One pair from frame to frame. docs/world.md derives the bounds that age.
//
// Roundings: c, d and t are sums of a few terms, each bounded by |d| + t + |L|, and off by a few u of that. SLACK_SET
// is taken off when c is made and again when it is compared; what is reported is moved by half as much, so that a
// status that a comparison found is also the one that the reported bounds show.
#include "scene/ask.h"

#define SLACK_SET 0x1p-48
#define SLACK_SAID 0x1p-49

static double sum_abs(vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

// ---- what is kept, as a proof and back

static void write_proof(const kept *k, ovoid_proof *p) {
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

static void keep_proof(kept *k, const ovoid_proof *p) {
    k->normal = p->normal;
    k->proof = (uint8_t)p->kind;
    k->count = 0;
    if (p->kind == OVOID_PROOF_INNER) {
        k->of.inner = p->inner_a;
        return;
    }
    // Vertices that do not fit are only a slower start: their normal stays.
    for (uint32_t i = 0; i < p->count; i++)
        if (p->a[i] > UINT16_MAX || p->b[i] > UINT16_MAX) return;
    k->count = (uint8_t)p->count;
    for (uint32_t i = 0; i < p->count; i++) {
        k->of.entry[i][0] = (uint16_t)p->a[i];
        k->of.entry[i][1] = (uint16_t)p->b[i];
    }
}

// ---- asking

question ask_make(const ovoid_frame_query *query) {
    question ask = question_make_distance(NULL);
    switch (query->question) {
    case OVOID_QUESTION_COLLIDE: return question_make_collide();
    case OVOID_QUESTION_WITHIN: return question_make_within(query->margin);
    case OVOID_QUESTION_DISTANCE: break;
    case OVOID_QUESTION_DEPTH: ask.wants_depth = 1; break;
    }
    ask.far = query->margin;
    return ask;
}

void ask_pair(const ovoid_world *w, uint32_t a, uint32_t b, const kept *k, question ask, ovoid_exclusions *exclusions,
              ovoid_compound_answer *out) {
    ovoid_solid_pair both = {w->bodies[a].solid, w->bodies[b].solid};
    ovoid_compound_proof earlier;
    if (k && k->proof == OVOID_PROOF_NONE) k = NULL;
    if (k) {
        earlier.part_a = k->part_a;
        earlier.part_b = k->part_b;
        write_proof(k, &earlier.proof);
    }
    solid_find_inside(&both, &w->asked, ask, k ? &earlier : NULL, exclusions, out);
}

// d and t of a pair now.
static vec3 find_between(const ovoid_world *w, const world_pair *p, double *travel) {
    const body_place *a = &w->places[p->a], *b = &w->places[p->b];
    *travel = a->travel + b->travel;
    return vec3_sub(b->at, a->at);
}

void pair_set_age(const ovoid_world *w, world_pair *p, const kept *k) {
    double margin = w->margin;
    double slack = SLACK_SET * (sum_abs(k->between) + k->travel + fabs(k->lower) + fabs(k->upper) + margin);
    p->kind = PAIR_OPEN;
    p->flags &= (uint16_t)~PAIR_CONTACT;
    if (!(k->lower > margin)) p->flags |= PAIR_CONTACT;
    int are_shapes = !w->bodies[p->a].solid.compound && !w->bodies[p->b].solid.compound;
    if (k->lower > margin && are_shapes && k->stage == OVOID_STAGE_SPHERE) {
        // Three times the blur of now is above what the positions do not explain of any blur to come.
        const world_body *a = &w->bodies[p->a], *b = &w->bodies[p->b];
        double reach = (a->reach + b->reach) + (a->radius + b->radius);
        p->kind = PAIR_SPHERE;
        p->c = (reach + margin) * (1 + 0x1p-48) + 3 * (a->blur + b->blur);
        return;
    }
    if (k->lower > margin && are_shapes && vec3_norm_squared(k->normal) > 0.5) {
        p->kind = PAIR_PLANE;
        p->v = k->normal;
        p->c = ((k->lower - margin) - vec3_dot(k->normal, k->between)) + k->travel - slack;
        return;
    }
    // Points move with the bodies: what is measured is measured again. Compounds have a normal for each pair of parts.
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

// What rounding hides in both centres for the sake of where they are: solid.c, its 128 u of a position.
static double find_blur(const ovoid_world *w, const world_pair *p) {
    return 0x1p-45 * (sum_abs(w->places[p->a].at) + sum_abs(w->places[p->b].at));
}

int pair_is_answered(const ovoid_world *w, const world_pair *p) {
    double t;
    vec3 d = find_between(w, p, &t);
    double slack = SLACK_SET * (sum_abs(d) + t + fabs(p->c));
    if (p->kind == PAIR_PLANE) return p->c + vec3_dot(p->v, d) - t > slack;
    if (p->kind == PAIR_BALL) return p->c - vec3_norm(vec3_sub(d, p->v)) - t > slack;
    return p->kind == PAIR_SPHERE && vec3_norm(d) > p->c + slack + find_blur(w, p);
}

double pair_compute_age(const ovoid_world *w, const world_pair *p, const kept *k) {
    double t;
    vec3 d = find_between(w, p, &t);
    return (vec3_norm(vec3_sub(d, k->between)) + (t - k->travel)) +
           SLACK_SAID * (sum_abs(d) + sum_abs(k->between) + t + fabs(k->lower) + fabs(k->upper));
}

static void ask_shapes(const ovoid_world *w, const world_pair *p, const kept *k, ovoid_answer *out) {
    const ovoid_solid *a = &w->bodies[p->a].solid, *b = &w->bodies[p->b].solid;
    ovoid_pair both = {a->shape, b->shape, a->pose, b->pose};
    ovoid_frame_query query = {w->question, w->margin, NULL};
    ovoid_proof earlier;
    int is_warm = k->proof != OVOID_PROOF_NONE;
    if (is_warm) write_proof(k, &earlier);
    answer_find_inside(&both, &w->asked, ask_make(&query), is_warm ? &earlier : NULL, NULL, out);
}

static void keep_answer(ovoid_world *w, const world_pair *p, kept *k, const ovoid_answer *x) {
    k->lower = x->lower;
    k->upper = x->upper;
    k->status = (uint8_t)x->status;
    k->stage = (uint8_t)x->stage;
    k->limit = (uint8_t)x->limit;
    k->iterations = x->iterations;
    keep_proof(k, &x->proof);
    if (world_is_measuring(w)) w->witnesses[p->slot] = (ovoid_witness){x->point_a, x->point_b, x->normal};
}

static void ask_anew(ovoid_world *w, const world_pair *p, kept *k) {
    if (!w->bodies[p->a].solid.compound && !w->bodies[p->b].solid.compound) {
        ovoid_answer x;
        ask_shapes(w, p, k, &x);
        keep_answer(w, p, k, &x);
        return;
    }
    ovoid_compound_answer x;
    ovoid_frame_query query = {w->question, w->margin, NULL};
    ask_pair(w, p->a, p->b, k, ask_make(&query), NULL, &x);
    k->part_a = x.part_a;
    k->part_b = x.part_b;
    keep_answer(w, p, k, &x.answer);
}

void pair_ask(ovoid_world *w, world_pair *p) {
    kept *k = &w->kept[p->slot];
    if (!(p->flags & PAIR_KNOWN) || !pair_measure(w, p, k)) ask_anew(w, p, k);
    k->between = find_between(w, p, &k->travel);
    p->flags |= PAIR_STILL | PAIR_KNOWN;
    pair_set_age(w, p, k);
}

// ---- reporting

ovoid_contact pair_make_contact(const ovoid_world *w, const world_pair *p) {
    const kept *k = &w->kept[p->slot];
    ovoid_contact x = {.a = body_get_id(w, p->a), .b = body_get_id(w, p->b), .part_a = k->part_a, .part_b = k->part_b};
    x.verdict = (ovoid_verdict){
        (ovoid_status)k->status, (ovoid_stage)k->stage, (ovoid_limit)k->limit, k->iterations, k->lower, k->upper};
    if (p->flags & PAIR_STILL) return x;
    double age = pair_compute_age(w, p, k);
    x.verdict = (ovoid_verdict){.status = (ovoid_status)k->status,
                                .stage = OVOID_STAGE_PROOF,
                                .limit = OVOID_LIMIT_ANSWERED,
                                .lower = k->lower - age,
                                .upper = k->upper + age};
    return x;
}
