// The manifolds of a world beside all its pairs, one by one; and which pairs have begun and ended, by a list of its
// own.
#ifndef OVOID_TESTS_WORLD_MANIFOLDS_H
#define OVOID_TESTS_WORLD_MANIFOLDS_H

#include "worlds.h"

enum { HISTORY_MOST = 4096, PARTS_MOST = 1024 };

/// The pairs of the last manifolds, in their order.
typedef struct history {
    ovoid_world_parting pairs[HISTORY_MOST];
    size_t count;
} history;

static inline int history_has(const history *h, ovoid_id a, ovoid_id b) {
    for (size_t i = 0; i < h->count; i++)
        if (h->pairs[i].a == a && h->pairs[i].b == b) return 1;
    return 0;
}

/// Compares the events with the list of pairs, which becomes that of these manifolds.
static inline void history_step(history *h, const ovoid_world_manifolds *found) {
    static history now;
    size_t begun = 0, at = 0;
    now.count = 0;
    for (size_t i = 0; i < found->count && CHECK(i < HISTORY_MOST); i++) {
        const ovoid_world_manifold *m = &found->items[i];
        int is_new = !history_has(h, m->a, m->b);
        CHECK_EQ(m->event, is_new ? OVOID_MANIFOLD_BEGIN : OVOID_MANIFOLD_STAY);
        begun += (size_t)is_new;
        now.pairs[now.count++] = (ovoid_world_parting){m->a, m->b, m->user_a, m->user_b};
    }
    CHECK_EQ(found->begun, begun);
    for (size_t i = 0; i < h->count; i++) {
        if (history_has(&now, h->pairs[i].a, h->pairs[i].b)) continue;
        if (!CHECK(at < found->ended_count)) return;
        const ovoid_world_parting *own = &found->ended[at++], *right = &h->pairs[i];
        CHECK(own->a == right->a && own->b == right->b && own->user_a == right->user_a && own->user_b == right->user_b);
    }
    CHECK_EQ(found->ended_count, at);
    *h = now;
}

/// A pair of bodies alone, with the options of its manifolds.
typedef struct manifold_pair {
    ovoid_body_pair bodies;
    ovoid_manifold_options options;
    ovoid_body_manifolds alone; ///< found cold
} manifold_pair;

/// The manifold of one pair of bodies, beside that of the pair alone.
static inline void world_check_manifold(const ovoid_world_manifolds *found, const ovoid_world_manifold *m,
                                        const manifold_pair *by) {
    const ovoid_body_pair *pair = &by->bodies;
    const ovoid_body_manifolds *alone = &by->alone;
    ovoid_body_answer truth = ovoid_body_depth(pair, NULL, NULL);
    CHECK_LE(m->verdict.lower, truth.upper);
    CHECK_LE(truth.lower, m->verdict.upper);
    CHECK(m->verdict.status != OVOID_SEPARATED || m->verdict.lower > 0);
    CHECK(m->verdict.status != OVOID_OVERLAPPING || m->verdict.upper < 0);
    CHECK(m->verdict.status != OVOID_TOUCHING || (m->verdict.lower <= 0 && m->verdict.upper >= 0));
    CHECK(m->first + m->count <= found->part_count);
    size_t at = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        const ovoid_body_manifold *part = &found->parts[m->first + i];
        const ovoid_manifold_points *points = &found->points[m->first + i];
        CHECK(i == 0 || part[-1].part_a < part->part_a ||
              (part[-1].part_a == part->part_a && part[-1].part_b < part->part_b));
        ovoid_manifold_points again = ovoid_body_manifold_compute_points(pair, part);
        CHECK_EQ(points->count, part->manifold.count);
        CHECK_EQ(points->count, again.count);
        // Two bounds of the same excess, measured in the query and after it.
        CHECK_NEAR(points->grown, again.grown, 0.01 * again.grown);
        CHECK(memcmp(points->points, again.points, again.count * sizeof *again.points) == 0);
        // What an earlier search left of its upper bound needs the cover of that search.
        ovoid_error error = {0};
        if (part->manifold.proof != OVOID_MANIFOLD_PROOF_SEARCH &&
            !CHECK(ovoid_body_manifold_verify(pair, part, &by->options, &error) == OVOID_OK))
            printf("  %s\n", error.message);
        // Any part that the pair alone has within the margin is there too.
        for (;
             at < alone->count && (alone->items[at].part_a < part->part_a ||
                                   (alone->items[at].part_a == part->part_a && alone->items[at].part_b < part->part_b));
             at++)
            CHECK(alone->items[at].manifold.upper > m->margin);
        if (at < alone->count && alone->items[at].part_a == part->part_a && alone->items[at].part_b == part->part_b)
            at++;
        CHECK_LE(part->manifold.lower, m->margin);
    }
    for (; at < alone->count; at++) CHECK(alone->items[at].manifold.upper > m->margin);
}

/// What the world is asked, and by how much farther than their materials say its bodies may reach.
typedef struct manifold_truth {
    const ovoid_world_manifold_query *query;
    double ahead_most;
} manifold_truth;

/// Compares the manifolds with all pairs of the world, which must be small.
static inline void world_validate_manifolds(const ovoid_world *w, const manifold_truth *by,
                                            const ovoid_world_manifolds *found) {
    static ovoid_body_manifold parts[PARTS_MOST];
    size_t at = 0, part_count = 0;
    for (ovoid_id a = ovoid_world_find_next(w, 0); a; a = ovoid_world_find_next(w, a)) {
        ovoid_world_body body_a;
        ovoid_material of_a;
        CHECK(ovoid_world_get(w, a, &body_a, NULL) == OVOID_OK);
        CHECK(ovoid_world_get_material(w, a, &of_a, NULL) == OVOID_OK);
        for (ovoid_id b = ovoid_world_find_next(w, a); b; b = ovoid_world_find_next(w, b)) {
            ovoid_world_body body_b;
            ovoid_material of_b;
            CHECK(ovoid_world_get(w, b, &body_b, NULL) == OVOID_OK);
            CHECK(ovoid_world_get_material(w, b, &of_b, NULL) == OVOID_OK);
            const ovoid_world_manifold *m = at < found->count ? &found->items[at] : NULL;
            int is_in = m && m->a == a && m->b == b;
            at += (size_t)is_in;
            if (!ovoid_world_is_pair(w, a, b)) {
                CHECK(!is_in);
                continue;
            }
            manifold_pair pair = {.bodies = {body_a.body, body_b.body},
                                  .options = by->query->options,
                                  .alone = {.items = parts, .capacity = PARTS_MOST}};
            double least = by->query->options.margin + (of_a.margin + of_b.margin);
            pair.options.margin = is_in ? m->margin : least;
            CHECK_EQ(ovoid_body_manifolds_find(&pair.bodies, &pair.options, &pair.alone), OVOID_LIMIT_NONE);
            CHECK_LE(pair.alone.count, PARTS_MOST);
            if (!is_in) {
                CHECK(pair.alone.upper > least);
                continue;
            }
            part_count += m->count;
            CHECK(m->margin >= least * (1 - 1e-15) && m->margin <= (least + 2 * by->ahead_most) * (1 + 1e-15));
            CHECK(m->user_a == body_a.user && m->user_b == body_b.user);
            CHECK_NEAR(m->friction, sqrt(of_a.friction * of_b.friction), 1e-15 * m->friction);
            CHECK(m->restitution == fmax(of_a.restitution, of_b.restitution));
            // A pair that is proven farther is not there.
            CHECK_LE(m->verdict.lower, m->margin);
            CHECK_LE(pair.alone.lower, m->margin + 2e-9 * world_find_size(&body_a.body, &body_b.body));
            world_check_manifold(found, m, &pair);
        }
    }
    CHECK_EQ(at, found->count);
    CHECK_EQ(part_count, found->part_count);
}

#endif
