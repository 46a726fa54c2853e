// A world of up to twelve bodies under any sequence of its functions. Truth: a model of the bodies and their groups,
// and the query of each pair alone: a frame's contacts are sorted, are pairs, leave none out that is proven within the
// margin, and each bracket has a point in common with the pair's own; whole answers are verified. The same of
// manifolds, and a list of the pairs of the last ones, by which pairs begin and end. Queries between frames leave out
// nothing that is nearer.
#include "bodies.h"

enum { SHAPES = 4, BODIES = 12, OPERATIONS = 48 };

typedef struct model {
    ovoid_world *world;
    ovoid_shape *shapes[SHAPES];
    ovoid_compound *compound;
    struct {
        ovoid_id id;
        ovoid_body body;
        uint32_t group, mask;
    } bodies[BODIES];
    int count;
    ovoid_id ignored[OPERATIONS][2];
    int ignored_count;
    ovoid_id stale;                    ///< of the body removed last
    ovoid_id last[BODIES * BODIES][2]; ///< the pairs of the last manifolds
    size_t last_count;
    int is_wild;
} model;

static int find_body(const model *m, ovoid_id id) {
    for (int i = 0; i < m->count; i++)
        if (m->bodies[i].id == id) return i;
    return -1;
}
static int find_ignored(const model *m, ovoid_id a, ovoid_id b) {
    for (int i = 0; i < m->ignored_count; i++)
        if ((m->ignored[i][0] == a && m->ignored[i][1] == b) || (m->ignored[i][0] == b && m->ignored[i][1] == a))
            return i;
    return -1;
}
static int is_pair(const model *m, int i, int j) {
    return (m->bodies[i].group & m->bodies[j].mask) && (m->bodies[j].group & m->bodies[i].mask) &&
           find_ignored(m, m->bodies[i].id, m->bodies[j].id) < 0;
}

static void add(model *m, fuzz_bytes *from) {
    int which = (unsigned)take_byte(from) % (SHAPES + 1);
    ovoid_world_body body = {.user = 7};
    if (which < SHAPES)
        body.body.shape = m->shapes[which];
    else
        body.body.compound = m->compound;
    body.body.pose = take_any_pose(from, m->is_wild);
    body.groups.group = (uint32_t)(take_byte(from) & 3);
    body.groups.mask = (uint32_t)(take_byte(from) & 3);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_id id = ovoid_world_add(m->world, &body, &error);
    if (!id) {
        fuzz_require_error(&error);
        return;
    }
    fuzz_require(find_body(m, id) < 0);
    m->bodies[m->count].id = id;
    m->bodies[m->count].body = body.body;
    int is_all = body.groups.group == 0 && body.groups.mask == 0;
    m->bodies[m->count].group = is_all ? UINT32_MAX : body.groups.group;
    m->bodies[m->count++].mask = is_all ? UINT32_MAX : body.groups.mask;
}

static void remove_one(model *m, int i) {
    fuzz_require(ovoid_world_remove(m->world, m->bodies[i].id, NULL) == OVOID_OK);
    m->stale = m->bodies[i].id;
    for (int k = m->ignored_count - 1; k >= 0; k--)
        if (m->ignored[k][0] == m->stale || m->ignored[k][1] == m->stale) {
            m->ignored_count--;
            m->ignored[k][0] = m->ignored[m->ignored_count][0];
            m->ignored[k][1] = m->ignored[m->ignored_count][1];
        }
    m->bodies[i] = m->bodies[--m->count];
}

static void set_ignored(model *m, int i, int j, int ignored) {
    ovoid_id a = m->bodies[i].id, b = m->bodies[j].id;
    ovoid_code code =
        ignored ? ovoid_world_add_ignored(m->world, a, b, NULL) : ovoid_world_remove_ignored(m->world, a, b, NULL);
    fuzz_require(code == (i == j ? OVOID_ERROR_ARGUMENT : OVOID_OK));
    int k = find_ignored(m, a, b);
    if (i == j || (k >= 0) == ignored) return;
    if (ignored) {
        m->ignored[m->ignored_count][0] = a;
        m->ignored[m->ignored_count++][1] = b;
    } else {
        m->ignored_count--;
        m->ignored[k][0] = m->ignored[m->ignored_count][0];
        m->ignored[k][1] = m->ignored[m->ignored_count][1];
    }
}

static void check_contact(const model *m, const ovoid_contact *c, double margin) {
    int i = find_body(m, c->a), j = find_body(m, c->b);
    fuzz_require(c->a < c->b && i >= 0 && j >= 0 && is_pair(m, i, j) && ovoid_world_is_pair(m->world, c->a, c->b));
    ovoid_body_pair pair = {m->bodies[i].body, m->bodies[j].body};
    ovoid_body_answer alone = ovoid_body_depth(&pair, NULL, NULL);
    fuzz_require(c->verdict.lower <= alone.upper && alone.lower <= c->verdict.upper);
    fuzz_require(!(c->verdict.lower > margin));
    static ovoid_exclusion items[256];
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    static ovoid_cover cover = {.memory = memory, .size = sizeof memory};
    ovoid_exclusions exclusions = {.items = items, .capacity = 256, .cover = &cover};
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_contact_proof proof = {.exclusions = &exclusions};
    fuzz_require_code(ovoid_world_compute_proof(m->world, c, &proof, &error), &error);
    fuzz_require_code(ovoid_body_verify(&pair, &proof.answer, &(ovoid_body_basis){.exclusions = &exclusions}, &error),
                      &error);
}

static void ask_frame(model *m, fuzz_bytes *from) {
    ovoid_contact_query query = {.kind = (ovoid_query_kind)((unsigned)take_byte(from) % 4)};
    query.margin = query.kind == OVOID_QUERY_COLLIDE ? 0 : fabs(take_number(from, m->is_wild)) / 4;
    ovoid_contacts frame;
    ovoid_error error = {OVOID_OK, -1, ""};
    if (ovoid_world_compute_contacts(m->world, &query, &frame, &error) != OVOID_OK) {
        fuzz_require_error(&error);
        fuzz_require(error.code == OVOID_ERROR_ARGUMENT && m->is_wild);
        return;
    }
    fuzz_require(frame.bodies == (size_t)m->count && frame.count <= frame.pairs);
    fuzz_require(frame.aged + frame.queried == frame.pairs);
    for (size_t k = 0; k < frame.count; k++) {
        const ovoid_contact *c = &frame.items[k];
        if (k) fuzz_require(c[-1].a < c->a || (c[-1].a == c->a && c[-1].b < c->b));
        check_contact(m, c, query.margin);
    }
    // None is left out.
    for (int i = 0; i < m->count; i++)
        for (int j = 0; j < i; j++) {
            if (!is_pair(m, i, j)) continue;
            ovoid_body_pair pair = {m->bodies[i].body, m->bodies[j].body};
            ovoid_body_answer x = ovoid_body_within(&pair, query.margin, NULL, NULL);
            int is_there = 0;
            for (size_t k = 0; k < frame.count; k++)
                is_there |= (frame.items[k].a == m->bodies[i].id && frame.items[k].b == m->bodies[j].id) ||
                            (frame.items[k].b == m->bodies[i].id && frame.items[k].a == m->bodies[j].id);
            if (ovoid_answer_is_within(&x.deciding, query.margin) == 1) fuzz_require(is_there);
        }
}

static int was_there(const model *m, ovoid_id a, ovoid_id b) {
    for (size_t k = 0; k < m->last_count; k++)
        if (m->last[k][0] == a && m->last[k][1] == b) return 1;
    return 0;
}

static void check_manifold(const model *m, const ovoid_world_manifolds *all, const ovoid_world_manifold *x,
                           const ovoid_manifold_options *options) {
    int i = find_body(m, x->a), j = find_body(m, x->b);
    fuzz_require(x->a < x->b && i >= 0 && j >= 0 && is_pair(m, i, j));
    fuzz_require(x->event == (was_there(m, x->a, x->b) ? OVOID_MANIFOLD_STAY : OVOID_MANIFOLD_BEGIN));
    ovoid_body_pair pair = {m->bodies[i].body, m->bodies[j].body};
    ovoid_body_answer alone = ovoid_body_depth(&pair, NULL, NULL);
    fuzz_require(x->verdict.lower <= alone.upper && alone.lower <= x->verdict.upper);
    fuzz_require(!(x->verdict.lower > x->margin) && x->margin >= options->margin);
    fuzz_require(x->first + x->count <= all->part_count);
    ovoid_manifold_options own = *options;
    own.margin = x->margin;
    for (size_t k = x->first; k < x->first + x->count; k++) {
        const ovoid_body_manifold *part = &all->parts[k];
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_manifold_points points = ovoid_body_manifold_compute_points(&pair, part);
        fuzz_require(points.count == part->manifold.count && points.count == all->points[k].count);
        for (uint32_t at = 0; at < points.count; at++) {
            const ovoid_manifold_point *p = &points.points[at], *q = &all->points[k].points[at];
            fuzz_require(!memcmp(p, q, offsetof(ovoid_manifold_point, id)) && p->id == q->id);
        }
        // Of a search made in an earlier step there is no cover.
        if (part->manifold.proof != OVOID_MANIFOLD_PROOF_SEARCH)
            fuzz_require_code(ovoid_body_manifold_verify(&pair, part, &own, &error), &error);
    }
}

// The pairs that are not there any more are told, once and in order.
static void check_ended(model *m, const ovoid_world_manifolds *all) {
    size_t at = 0;
    for (size_t k = 0; k < m->last_count; k++) {
        int is_there = 0;
        for (size_t i = 0; i < all->count; i++)
            is_there |= all->items[i].a == m->last[k][0] && all->items[i].b == m->last[k][1];
        if (is_there) continue;
        fuzz_require(at < all->ended_count && all->ended[at].a == m->last[k][0] && all->ended[at].b == m->last[k][1]);
        at++;
    }
    fuzz_require(at == all->ended_count);
    m->last_count = all->count;
    for (size_t i = 0; i < all->count; i++) {
        m->last[i][0] = all->items[i].a;
        m->last[i][1] = all->items[i].b;
    }
}

static void ask_manifolds(model *m, fuzz_bytes *from) {
    ovoid_world_manifold_query query = {.ahead = (double)((unsigned)take_byte(from) % 3)};
    query.options.margin = fabs(take_number(from, m->is_wild)) / 4;
    query.options.tolerance = fabs(take_number(from, m->is_wild)) / 64;
    query.options.keep = fabs(take_number(from, m->is_wild)) / 64;
    ovoid_material material = {.margin = fabs(take_number(from, m->is_wild)) / 8, .friction = 1};
    ovoid_world_manifolds all;
    ovoid_error error = {OVOID_OK, -1, ""};
    if (m->count && ovoid_world_set_material(m->world, m->bodies[0].id, &material, &error) != OVOID_OK)
        fuzz_require(error.code == OVOID_ERROR_ARGUMENT && m->is_wild);
    if (ovoid_world_compute_manifolds(m->world, &query, &all, &error) != OVOID_OK) {
        fuzz_require_error(&error);
        fuzz_require(error.code == OVOID_ERROR_ARGUMENT && m->is_wild);
        return;
    }
    for (size_t k = 0; k < all.count; k++) check_manifold(m, &all, &all.items[k], &query.options);
    for (int i = 0; i < m->count; i++)
        for (int j = 0; j < i; j++) {
            if (!is_pair(m, i, j)) continue;
            ovoid_body_pair pair = {m->bodies[i].body, m->bodies[j].body};
            ovoid_body_answer x = ovoid_body_within(&pair, query.options.margin, NULL, NULL);
            int is_there = 0;
            for (size_t k = 0; k < all.count; k++)
                is_there |= (all.items[k].a == m->bodies[i].id && all.items[k].b == m->bodies[j].id) ||
                            (all.items[k].b == m->bodies[i].id && all.items[k].a == m->bodies[j].id);
            if (ovoid_answer_is_within(&x.deciding, query.options.margin) == 1) fuzz_require(is_there);
        }
    check_ended(m, &all);
}

// The answer about a pair alone.
static ovoid_answer ask_alone(const ovoid_body *a, const ovoid_body *b) {
    ovoid_body_pair pair = {*a, *b};
    return ovoid_body_depth(&pair, NULL, NULL).deciding;
}

// No pair that was asked about is nearer than the hit says; body: the one asked about, or -1 for all pairs.
static void check_nearest(const model *m, const ovoid_world_hit *hit, int body) {
    int is_overlap = hit->b && hit->answer.lower <= 0;
    for (int i = 0; i < m->count; i++)
        for (int j = 0; j < i; j++)
            if (is_pair(m, i, j) && (body < 0 || i == body || j == body)) {
                fuzz_require(hit->b != 0);
                if (!is_overlap) fuzz_require(hit->lower <= ask_alone(&m->bodies[i].body, &m->bodies[j].body).upper);
            }
    if (!hit->b) return;
    int i = find_body(m, hit->a), j = find_body(m, hit->b);
    fuzz_require(i >= 0 && j >= 0 && is_pair(m, i, j));
    ovoid_answer alone = ask_alone(&m->bodies[i].body, &m->bodies[j].body);
    fuzz_require(hit->answer.lower <= alone.upper && alone.lower <= hit->answer.upper);
}

static void check_overlaps(const model *m, const ovoid_world_body *probe, double margin) {
    ovoid_world_hit items[BODIES];
    ovoid_world_hits hits = {items, BODIES, 0};
    ovoid_error error = {OVOID_OK, -1, ""};
    if (ovoid_world_find_overlaps(m->world, &(ovoid_world_query){.probe = probe, .margin = margin}, &hits, &error) !=
        OVOID_OK) {
        fuzz_require_error(&error);
        return;
    }
    fuzz_require(hits.count <= (size_t)m->count);
    // Of huge bodies another question may prove more: what is proven here counts.
    for (size_t k = 0; k < hits.count; k++) {
        fuzz_require(!(items[k].answer.lower > margin));
        if (k) fuzz_require(items[k - 1].b < items[k].b);
    }
    for (int i = 0; i < m->count; i++) {
        int is_asked = m->bodies[i].group && m->bodies[i].mask, is_there = 0; // the probe is of all groups
        for (size_t k = 0; k < hits.count; k++) is_there |= items[k].b == m->bodies[i].id;
        ovoid_answer alone = ask_alone(&probe->body, &m->bodies[i].body);
        if (!is_asked) fuzz_require(!is_there);
        if (is_asked && alone.upper <= margin) fuzz_require(is_there);
    }
}

static void check_casts(const model *m, fuzz_bytes *from, const ovoid_world_body *probe) {
    ovoid_world_ray ray = {.ray = {take_vector(from, m->is_wild), take_vector(from, m->is_wild), 4, 0}};
    ray.ray.radius = fabs(take_number(from, 0)) / 8;
    ovoid_world_cast cast;
    ovoid_error error = {OVOID_OK, -1, ""};
    if (ovoid_world_cast_ray(m->world, &ray, &cast, &error) == OVOID_OK) {
        fuzz_require(!(cast.lower > cast.upper));
        for (int i = 0; i < m->count; i++) {
            if (!m->bodies[i].body.shape || !m->bodies[i].group || !m->bodies[i].mask) continue;
            ovoid_posed_shape body = {m->bodies[i].body.shape, m->bodies[i].body.pose};
            ovoid_ray_hit alone = ovoid_shape_cast_ray(&body, &ray.ray);
            if (alone.status == OVOID_IMPACT_HIT) fuzz_require(cast.lower <= alone.upper);
        }
    } else {
        fuzz_require_error(&error);
    }
    if (ovoid_world_cast_body(m->world, &(ovoid_world_sweep){*probe, take_vector(from, m->is_wild)}, &cast, &error) ==
        OVOID_OK)
        fuzz_require(!(cast.lower > cast.upper));
    else
        fuzz_require_error(&error);
}

static void ask_between(const model *m, fuzz_bytes *from) {
    ovoid_world_hit hit;
    ovoid_error error = {OVOID_OK, -1, ""};
    fuzz_require_code(ovoid_world_find_nearest_pair(m->world, NULL, &hit, &error), &error);
    check_nearest(m, &hit, -1);
    for (int i = 0; i < m->count && i < 2; i++) {
        fuzz_require_code(ovoid_world_find_nearest(m->world, &(ovoid_world_query){.id = m->bodies[i].id}, &hit, &error),
                          &error);
        check_nearest(m, &hit, i);
    }
    fuzz_require_code(ovoid_world_find_any(m->world, NULL, &hit, &error), &error);
    for (int i = 0; i < m->count && !hit.b; i++)
        for (int j = 0; j < i; j++)
            if (is_pair(m, i, j)) fuzz_require(ask_alone(&m->bodies[i].body, &m->bodies[j].body).upper > 0);
    ovoid_world_body probe = {.body = {.shape = m->shapes[0], .pose = take_any_pose(from, m->is_wild)}};
    if (take_byte(from) > 64) probe = ovoid_world_make_point(m->world, take_vector(from, m->is_wild));
    check_overlaps(m, &probe, fabs(take_number(from, m->is_wild)) / 4);
    check_casts(m, from, &probe);
}

static void move(model *m, int i, fuzz_bytes *from) {
    ovoid_pose pose = take_any_pose(from, m->is_wild);
    ovoid_error error = {OVOID_OK, -1, ""};
    if (ovoid_world_move(m->world, m->bodies[i].id, &pose, &error) == OVOID_OK)
        m->bodies[i].body.pose = pose;
    else
        fuzz_require_error(&error);
}

static void operate(model *m, fuzz_bytes *from) {
    unsigned what = (unsigned)take_byte(from) % 8, one = (unsigned)take_byte(from), other = (unsigned)take_byte(from);
    int i = m->count ? (int)(one % (unsigned)m->count) : 0, j = m->count ? (int)(other % (unsigned)m->count) : 0;
    if (what <= 1 && m->count < BODIES) add(m, from);
    if (what == 7 && other % 2)
        ask_between(m, from);
    else if (what == 7 && other % 4 == 2)
        ask_manifolds(m, from);
    else if (what == 7 || m->count == 0)
        ask_frame(m, from);
    if (m->count == 0) return;
    ovoid_world_body body;
    switch (what) {
    case 2: remove_one(m, i); break;
    case 3:
    case 4: move(m, i, from); break;
    case 5: set_ignored(m, i, j, one & 1); break;
    case 6:
        m->bodies[i].group = (uint32_t)(other & 3);
        m->bodies[i].mask = (uint32_t)(other >> 2 & 3);
        fuzz_require(ovoid_world_set_groups(m->world, m->bodies[i].id,
                                            (ovoid_groups){m->bodies[i].group, m->bodies[i].mask}, NULL) == OVOID_OK);
        fuzz_require(ovoid_world_get(m->world, m->bodies[i].id, &body, NULL) == OVOID_OK && body.user == 7);
        // Both zero means all.
        m->bodies[i].group = body.groups.group;
        m->bodies[i].mask = body.groups.mask;
        break;
    default: break;
    }
    // An id of the past stays of the past.
    if (m->stale && find_body(m, m->stale) < 0)
        fuzz_require(ovoid_world_get(m->world, m->stale, &body, NULL) == OVOID_ERROR_INDEX);
    fuzz_require(ovoid_world_get_count(m->world) == (size_t)m->count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    model m = {.is_wild = take_byte(&from) > 96};
    ovoid_world_options options = {.threads = take_byte(&from) == 77 ? 3 : 1,
                                   .enlargement = (take_byte(&from) & 3) * 0.1};
    ovoid_error error = {OVOID_OK, -1, ""};
    int all = 1;
    for (int i = 0; i < SHAPES; i++) all &= (m.shapes[i] = take_any_shape(&from, m.is_wild)) != NULL;
    if (all) {
        ovoid_posed_shape parts[3];
        for (int i = 0; i < 3; i++) parts[i] = (ovoid_posed_shape){m.shapes[i], take_any_pose(&from, m.is_wild)};
        m.compound = ovoid_compound_create(parts, 3, NULL, &error);
        m.world = ovoid_world_create(&options, &error);
        fuzz_require(m.world != NULL);
        for (int k = 0; k < OPERATIONS && from.size && m.compound; k++) operate(&m, &from);
        if (m.compound) {
            ask_frame(&m, &from);
            ask_between(&m, &from);
            ask_manifolds(&m, &from);
        }
    }
    ovoid_world_destroy(m.world);
    ovoid_compound_destroy(m.compound);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(m.shapes[i]);
    return 0;
}
