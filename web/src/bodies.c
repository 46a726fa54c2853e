// Compounds, and pairs with a compound or a solid: queries, the exclusions of their proofs, checks.
#include "ovoid/solid.h"
#include "src/exchange.h"

#include <stdlib.h>

const double *read_body(const double *from, unsigned kind, const void *body, ovoid_body *out) {
    *out = (ovoid_body){.shape = kind == IS_SHAPE ? body : NULL,
                        .compound = kind == IS_COMPOUND ? body : NULL,
                        .solid = kind == IS_SOLID ? body : NULL};
    return read_pose(from, &out->pose);
}

/// poses: seven numbers each.
ovoid_compound *EXPORT(compound_create)(ovoid_shape *const *shapes, const double *poses, size_t count) {
    ovoid_posed_shape *parts = calloc(count + 1, sizeof *parts);
    if (!parts) return exchange_error = (ovoid_error){OVOID_ERROR_MEMORY, -1, "out of memory"}, NULL;
    for (size_t i = 0; i < count; i++) {
        parts[i].shape = shapes[i];
        read_pose(poses + 7 * i, &parts[i].pose);
    }
    ovoid_compound *compound = ovoid_compound_create(parts, count, NULL, &exchange_error);
    free(parts);
    return compound;
}
void EXPORT(compound_destroy)(ovoid_compound *compound) { ovoid_compound_destroy(compound); }

// The exclusions of the last query, and of the next check, as the caller reads and writes them.
static ovoid_exclusions exclusions = {.grows = 1};
_Static_assert(sizeof(ovoid_exclusion) == 72 && offsetof(ovoid_exclusion, normal) == 16, "four indices, seven numbers");

ovoid_exclusion *EXPORT(get_exclusions)(void) { return exclusions.items; }

/// Room for so many exclusions: their address; 0 where there is no memory, or nothing to hold.
ovoid_exclusion *EXPORT(set_exclusions)(size_t count) {
    if (count > exclusions.capacity) {
        ovoid_exclusions_release(&exclusions);
        exclusions.items = count <= SIZE_MAX / 2 / sizeof(ovoid_exclusion)
                               ? aligned_alloc(64, (count * sizeof(ovoid_exclusion) + 63) / 64 * 64)
                               : NULL;
        if (!exclusions.items) return NULL;
        exclusions.capacity = count;
    }
    exclusions.count = count;
    return exclusions.items;
}

static const double *read_bodies(unsigned kinds, const void *a, const void *b, ovoid_body_pair *pair) {
    return read_body(read_body(exchange, kinds & 3, a, &pair->a), kinds >> 2 & 3, b, &pair->b);
}

static int has_solid(const ovoid_body_pair *pair) { return pair->a.solid || pair->b.solid; }

typedef struct question {
    int kind;
    ovoid_body_pair pair;
    double margin;
    ovoid_options options;
    ovoid_body_proof earlier;
    int is_warm;
} question;

static ovoid_body_answer ask(const question *q) {
    const ovoid_body_proof *earlier = q->is_warm ? &q->earlier : NULL;
    switch (q->kind) {
    case 0:
        return ovoid_body_collide(&q->pair, &q->options,
                                  &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    case 1:
        return ovoid_body_within(&q->pair, q->margin, &q->options,
                                 &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    case 2:
        return ovoid_body_distance(&q->pair, &q->options,
                                   &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    default:
        return ovoid_body_depth(&q->pair, &q->options,
                                &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    }
}

/// kind: collide, within, distance, depth. Reads both poses, the margin, four options and, where is_warm, the deciding
/// parts of an earlier answer and its proof. Writes how many exclusions there are (-1: memory was out), the deciding
/// parts, parting, inside, component, common point, of the surfaces status, limit, lower and upper, then the answer and
/// its proof; of a depth the cover.
void EXPORT(body_query)(int kind, unsigned kinds, const void *a, const void *b, int is_warm) {
    question q = {.kind = kind, .is_warm = is_warm};
    const double *from = read_bodies(kinds, a, b, &q.pair);
    q.margin = *from++;
    from = read_options(from, &q.options);
    if (is_warm) {
        q.earlier.part_a = read_index(from[0]), q.earlier.part_b = read_index(from[1]);
        read_proof(from + 2, &q.earlier.proof);
    }
    exclusions.cover = kind == 3 ? &cover : NULL;
    cover.point_count = cover.triangle_count = 0;
    ovoid_body_answer s = ask(&q);
    double *to = exchange;
    *to++ = exclusions.count <= exclusions.capacity ? (double)exclusions.count : -1, *to++ = s.part_a, *to++ = s.part_b;
    to = write_vec3(to, s.parting);
    *to++ = s.inside, *to++ = s.component;
    to = write_vec3(to, s.common);
    *to++ = s.deciding.status, *to++ = s.deciding.limit, *to++ = s.deciding.lower, *to++ = s.deciding.upper;
    ovoid_answer answer = ovoid_body_answer_get_answer(&s);
    write_proof(write_answer(to, &answer), &answer.proof);
}

static int verify_compounds(const ovoid_body_pair *pair, const ovoid_body_answer *s, const ovoid_options *options) {
    exclusions.cover = cover.point_count ? &cover : NULL;
    ovoid_body_answer c = ovoid_body_answer_make(&s->deciding, s->part_a, s->part_b);
    return (int)ovoid_body_verify(pair, &c, &(ovoid_body_basis){.options = options, .exclusions = &exclusions},
                                  &exchange_error);
}

/// Reads both poses, the four options of the query and what body_query wrote; the exclusions are those of
/// set_exclusions. 0, or the error's code.
int EXPORT(body_verify)(unsigned kinds, const void *a, const void *b) {
    ovoid_body_pair pair;
    ovoid_body_answer s = {0};
    ovoid_options options;
    const double *from = read_options(read_bodies(kinds, a, b, &pair), &options) + 1;
    s.part_a = read_index(*from++), s.part_b = read_index(*from++);
    from = read_vec3(from, &s.parting);
    s.inside = (ovoid_body_inside)(read_index(*from++) & 0xff);
    s.component = read_index(*from++);
    from = read_vec3(from, &s.common);
    const double *surfaces = from;
    read_proof(read_answer(from + 4, &s.deciding), &s.deciding.proof);
    if (!has_solid(&pair)) return verify_compounds(&pair, &s, &options);
    s.status = s.deciding.status, s.limit = s.deciding.limit, s.lower = s.deciding.lower, s.upper = s.deciding.upper;
    s.deciding.status = (ovoid_status)(read_index(surfaces[0]) & 0xff);
    s.deciding.limit = (ovoid_limit)(read_index(surfaces[1]) & 0xff);
    s.deciding.lower = surfaces[2], s.deciding.upper = surfaces[3];
    return (int)ovoid_body_verify(&pair, &s, &(ovoid_body_basis){.options = &options, .exclusions = &exclusions},
                                  &exchange_error);
}
