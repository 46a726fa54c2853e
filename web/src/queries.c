// Queries of pairs, their proofs and checks, batches, smooth brackets.
#include "src/exchange.h"

#include <stdlib.h>

// As much as a cover may take, so that no search for a depth fills it.
static _Alignas(64) unsigned char cover_memory[OVOID_COVER_SIZE + (size_t)150 * OVOID_COVER_POINTS_MAX];

ovoid_cover cover = {.memory = cover_memory, .size = sizeof cover_memory};

/// The cover of the last depth: its counts and where its arrays and its memory are, as ovoid_cover has them.
ovoid_cover *EXPORT(get_cover)(void) { return &cover; }

static const double *read_pair(const ovoid_shape *a, const ovoid_shape *b, ovoid_pair *pair) {
    pair->shape_a = a, pair->shape_b = b;
    return read_pose(read_pose(exchange, &pair->pose_a), &pair->pose_b);
}

/// kind: collide, within, distance, depth. Reads both poses, the margin, four options and, where is_warm, a proof;
/// writes the answer and its proof, and of a depth the cover.
void EXPORT(query)(int kind, const ovoid_shape *a, const ovoid_shape *b, int is_warm) {
    ovoid_pair pair;
    ovoid_options options;
    ovoid_proof earlier;
    const double *from = read_pair(a, b, &pair);
    double margin = *from++;
    from = read_options(from, &options);
    if (is_warm) read_proof(from, &earlier);
    const ovoid_proof *warm = is_warm ? &earlier : NULL;
    cover.point_count = cover.triangle_count = 0;
    ovoid_answer answer;
    switch (kind) {
    case 0: answer = ovoid_collide(&pair, &options, warm); break;
    case 1: answer = ovoid_within(&pair, margin, &options, warm); break;
    case 2: answer = ovoid_distance(&pair, &options, warm); break;
    default: answer = ovoid_depth(&pair, &options, warm, &cover); break;
    }
    write_proof(write_answer(exchange, &answer), &answer.proof);
}

/// Reads both poses, the four options of the query, its answer and proof, and the cover where it stands. 0, or the
/// error's code.
int EXPORT(verify)(const ovoid_shape *a, const ovoid_shape *b) {
    ovoid_pair pair;
    ovoid_options options;
    ovoid_answer answer;
    read_proof(read_answer(read_options(read_pair(a, b, &pair), &options), &answer), &answer.proof);
    const ovoid_cover *given = cover.point_count ? &cover : NULL;
    return (int)ovoid_answer_verify(&pair, &answer, &(ovoid_answer_basis){.options = &options, .cover = given},
                                    &exchange_error);
}

static ovoid_code run_batch(int kind, const ovoid_batch *batch, double margin) {
    switch (kind) {
    case 0: return ovoid_collide_batch(batch, &exchange_error);
    case 1: return ovoid_within_batch(batch, margin, &exchange_error);
    case 2: return ovoid_distance_batch(batch, &exchange_error);
    default: return ovoid_depth_batch(batch, &exchange_error);
    }
}

/// The bounds of each couple, and as codes all statuses, then all stages, then all limits. shapes: one for each body;
/// poses: seven numbers each. Reads the margin and four options; kind as in query. 0, or the error's code.
int EXPORT(batch)(int kind, ovoid_shape *const *shapes, const double *poses, size_t body_count,
                  const ovoid_couple *couples, size_t count, double *bounds, uint8_t *codes) {
    ovoid_options options;
    double margin = exchange[0];
    read_options(exchange + 1, &options);
    ovoid_posed_shape *bodies = calloc(body_count ? body_count : 1, sizeof *bodies);
    ovoid_verdict *verdicts = calloc(count ? count : 1, sizeof *verdicts);
    int code = OVOID_ERROR_MEMORY;
    if (bodies && verdicts) {
        for (size_t i = 0; i < body_count; i++) {
            bodies[i].shape = shapes[i];
            read_pose(poses + 7 * i, &bodies[i].pose);
        }
        ovoid_batch all = {.bodies = bodies,
                           .body_count = body_count,
                           .couples = couples,
                           .couple_count = count,
                           .options = &options,
                           .verdicts = verdicts};
        code = (int)run_batch(kind, &all, margin);
        for (size_t i = 0; !code && i < count; i++) {
            const ovoid_verdict *v = &verdicts[i];
            bounds[i] = v->lower, bounds[count + i] = v->upper;
            codes[i] = (uint8_t)v->status, codes[count + i] = (uint8_t)v->stage,
            codes[2 * count + i] = (uint8_t)v->limit;
        }
    } else
        exchange_error = (ovoid_error){OVOID_ERROR_MEMORY, -1, "out of memory"};
    free(bodies);
    free(verdicts);
    return code;
}

static double *write_smooth(double *to, const ovoid_smooth_value *v, int order) {
    *to++ = v->value, *to++ = v->error, *to++ = v->condition, *to++ = v->is_smooth;
    to = write_vec3(write_vec3(write_vec3(to, v->point_a), v->point_b), v->normal);
    for (int i = 0; i < 12; i++) *to++ = v->gradient[i];
    if (order == 2)
        for (int i = 0; i < 144; i++) *to++ = v->hessian[i / 12][i % 12];
    return to;
}

/// Reads both poses; writes the limit and the values of both ellipsoids.
void EXPORT(smooth)(const ovoid_shape *a, const ovoid_shape *b, int order) {
    ovoid_pair pair;
    read_pair(a, b, &pair);
    ovoid_smooth s = ovoid_pair_compute_smooth(&pair, order);
    exchange[0] = s.limit;
    write_smooth(write_smooth(exchange + 1, &s.outer, order), &s.inner, order);
}
