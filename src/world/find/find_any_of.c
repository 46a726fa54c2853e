// Does a state of a robot touch anything? Its bodies are probes, which are not in the world; some are queried with one
// another.
//
// A probe is placed once, by its pose alone: its sphere, and the box around its own box, rotated (body_bounds.h). The
// tree is traversed with that box. The box of its vertices, which costs as much as all the rest, is computed when the
// first leaf is met; from then on the traversal uses it. Pairs that spheres and boxes leave open are queried without a
// warm start. Nothing is allocated: if there are many probes, those after the first KEPT are placed again for each
// couple that names them.
#include "base/environment.h"
#include "base/error.h"
#include "linear/pose.h"
#include "world/find/bodies_query.h"
#include "world/state.h"
#include "world/tree/dynamic_tree_traverse.h"

#include <string.h>

// A probe with its place in the world.
typedef struct placed_probe {
    const ovoid_body *body;
    body_outline at;
} placed_probe;

/// The number of probes whose places are kept for the couples.
enum { KEPT = 24 };

typedef struct state_search {
    const ovoid_world *w;
    const ovoid_world_probes *probes;
    ovoid_options options;
    query_goal goal;
    placed_probe *probe; ///< the one that traverses the tree
    ovoid_groups groups;
    ovoid_body_answer found;
    uint32_t body; ///< the body that was found, or NONE
} state_search;

// ---- a probe

static placed_probe place_probe(const ovoid_body *body) {
    body_sphere ball = body_compute_sphere(body);
    return (placed_probe){body, body_compute_outline(body, &ball)};
}

static void tighten(placed_probe *p) {
    if (p->at.is_tight) return;
    body_sphere ball = body_compute_sphere(p->body);
    p->at.bounds = body_compute_box(p->body, &ball);
    p->at.is_tight = 1;
}

// 1 if balls around two centres are proven to be apart: squares are off by 5 u, sums by 2 u.
static int are_apart(vec3 a, vec3 b, double reach) {
    double most = reach * (1 + 0x1p-48);
    return vec3_norm_squared(vec3_sub(b, a)) > most * most * (1 + 0x1p-48);
}

// The checks of pose_validate, by comparisons alone, for most poses of shapes.
static int is_plain(const ovoid_body *body) {
    return !body->compound && !body->solid && body->shape && pose_is_plain(&body->pose);
}

static ovoid_code validate_probe(const ovoid_body *body, size_t number, ovoid_error *error) {
    return is_plain(body) ? OVOID_OK : world_validate_body(body, (int64_t)number, error);
}

// ---- a probe and the world

static int find_touch(void *context, const tree_node *leaf) {
    state_search *state = context;
    const world_body *b = &state->w->bodies[leaf->body];
    placed_probe *p = state->probe;
    if (!groups_are_paired(&state->groups, &b->groups)) return 1;
    if (are_apart(p->at.at, state->w->places[leaf->body].at, p->at.reach + (b->reach + b->radius + b->center_error)))
        return 1;
    tighten(p);
    if (!box_is_overlapping(&p->at.bounds, &leaf->bounds)) return 1;
    const ovoid_body_pair pair = {*p->body, b->body};
    bodies_query(&pair, &state->options, &state->goal, &state->found);
    if (state->found.lower > 0) return 1;
    state->body = leaf->body;
    return 0;
}

// 1 if the probe touches a body of the world.
static int meets_world(state_search *state, placed_probe *p, const ovoid_world_body *given) {
    state->groups = groups_make(given->groups);
    state->probe = p;
    return !dynamic_tree_find_overlaps(&state->w->tree, &p->at.bounds, find_touch, state);
}

// ---- two probes

static placed_probe *get_probe(const state_search *state, uint32_t number, placed_probe *kept, placed_probe *spare) {
    if (number < KEPT) return &kept[number];
    *spare = place_probe(&state->probes->items[number].body);
    return spare;
}

static int do_touch(state_search *state, placed_probe *a, placed_probe *b) {
    if (are_apart(a->at.at, b->at.at, a->at.reach + b->at.reach)) return 0;
    if (!box_is_overlapping(&a->at.bounds, &b->at.bounds)) return 0;
    tighten(a);
    tighten(b);
    if (!box_is_overlapping(&a->at.bounds, &b->at.bounds)) return 0;
    const ovoid_body_pair pair = {*a->body, *b->body};
    bodies_query(&pair, &state->options, &state->goal, &state->found);
    return !(state->found.lower > 0);
}

// The number of the first couple that is not proven apart; couple_count if all are.
static size_t find_couple(state_search *state, placed_probe *kept) {
    const ovoid_world_probes *all = state->probes;
    placed_probe spare[2];
    size_t k = 0;
    for (; k < all->couple_count; k++) {
        ovoid_couple c = all->couples[k];
        if (do_touch(state, get_probe(state, c.a, kept, &spare[0]), get_probe(state, c.b, kept, &spare[1]))) break;
    }
    return k;
}

// ---- the query

static ovoid_code validate_couples(const ovoid_world_probes *all, ovoid_error *error) {
    for (size_t k = 0; k < all->couple_count; k++)
        if (all->couples[k].a >= all->count || all->couples[k].b >= all->count)
            return error_set(error, OVOID_ERROR_INDEX, (int64_t)k, "couple %zu names a probe past the last of %zu", k,
                             all->count);
    return OVOID_OK;
}

static void write_none(ovoid_world_hit *hit) { memset(hit, 0, sizeof *hit); }

static void write_hit(const state_search *state, size_t a, ovoid_id b, ovoid_world_hit *hit) {
    *hit = (ovoid_world_hit){a, b, state->found.lower, state->found};
}

static ovoid_code find_any_of(const ovoid_world *w, const ovoid_world_probes *all, ovoid_world_hit *hit,
                              ovoid_error *error) {
    OVOID_ASSERT(w && hit && all && (all->items || !all->count) && (all->couples || !all->couple_count));
    ovoid_code code = validate_couples(all, error);
    if (code != OVOID_OK) return code;
    state_search state = {.w = w, .probes = all, .goal = query_goal_make_collide(), .body = NONE};
    (void)options_make(NULL, &state.options);
    placed_probe kept[KEPT], spare;
    for (size_t k = 0; k < all->count; k++) {
        const ovoid_world_body *given = &all->items[k];
        code = validate_probe(&given->body, k, error);
        if (code != OVOID_OK) return code;
        placed_probe *p = k < KEPT ? &kept[k] : &spare;
        *p = place_probe(&given->body);
        if (!meets_world(&state, p, given)) continue;
        write_hit(&state, k, body_get_id(w, state.body), hit);
        return OVOID_OK;
    }
    size_t couple = find_couple(&state, kept);
    if (couple < all->couple_count)
        write_hit(&state, all->couples[couple].a, OVOID_WORLD_PROBE | all->couples[couple].b, hit);
    else
        write_none(hit);
    return OVOID_OK;
}

ovoid_code ovoid_world_find_any_of(const ovoid_world *w, const ovoid_world_probes *probes, ovoid_world_hit *hit,
                                   ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, probes, find_any_of(w, probes, hit, error));
}
