// The order of the verification: the answer's own data, the pair, the bounds, the status, the direction, the points.
#include "parts.h"

#include <math.h>
#include <stdlib.h>

// The library's default, and the share by which sizes may differ by rounding.
#define TOLERANCE 1e-9
#define ROUNDING 1e-12

judge *judge_create(void) {
    judge *context = calloc(1, sizeof *context);
    if (!context) return NULL;
    context->p = number_pool_create();
    judge_set_options(context, NULL);
    if (context->p) return context;
    free(context);
    return NULL;
}

void judge_forget_surface(judge *context) {
    free(context->points);
    free(context->triangles);
    context->points = NULL;
    context->triangles = NULL;
    context->point_room = 0;
}

void judge_forget(judge *context) {
    for (size_t i = 0; i < context->capacity; i++)
        if (context->table[i].shape) mpz_clear(context->table[i].radius.m);
    free(context->table);
    context->table = NULL;
    context->capacity = context->count = 0;
}

void judge_destroy(judge *context) {
    if (!context) return;
    judge_forget(context);
    judge_forget_surface(context);
    number_pool_destroy(context->p);
    free(context);
}

void judge_set_options(judge *context, const ovoid_options *options) {
    context->absolute = options ? options->absolute_tolerance : 0;
    context->relative = options && options->relative_tolerance > 0 ? options->relative_tolerance : TOLERANCE;
}

// --- refusals

static ovoid_code verify_refusal(const ovoid_pair *pair, const ovoid_answer *answer, ovoid_error *error) {
    int valid_a = judge_is_pose_valid(&pair->pose_a), valid_b = judge_is_pose_valid(&pair->pose_b);
    if (answer->status != OVOID_UNDECIDED || answer->lower != -INFINITY || answer->upper != INFINITY)
        return judge_reject(error, OVOID_ERROR_PROOF, "a refused query with an answer");
    if ((answer->limit == OVOID_LIMIT_POSE_A && valid_a) || (answer->limit == OVOID_LIMIT_POSE_B && valid_b))
        return judge_reject(error, OVOID_ERROR_PROOF, "a valid pose was refused");
    if (answer->limit == OVOID_LIMIT_SHAPE_A || answer->limit == OVOID_LIMIT_SHAPE_B)
        return judge_reject(error, OVOID_ERROR_PROOF, "a shape was refused that is there");
    return OVOID_OK;
}

static int is_refusal(const ovoid_answer *answer) {
    return answer->limit >= OVOID_LIMIT_POSE_A && answer->limit <= OVOID_LIMIT_SHAPE_B;
}

// --- checks that need no bodies

static ovoid_code verify_data(const ovoid_answer *answer, ovoid_error *error) {
    if (isnan(answer->lower) || isnan(answer->upper) || answer->lower == INFINITY || answer->upper == -INFINITY)
        return judge_reject(error, OVOID_ERROR_NOT_FINITE, "the bracket is not one of numbers");
    if (!is_finite(answer->point_a) || !is_finite(answer->point_b) || !is_finite(answer->normal))
        return judge_reject(error, OVOID_ERROR_NOT_FINITE, "a witness point or the normal is not finite");
    if (answer->lower > answer->upper)
        return judge_reject(error, OVOID_ERROR_PROOF, "lower %.17g is above upper %.17g", answer->lower, answer->upper);
    return OVOID_OK;
}

ovoid_code judge_verify_touching(const judge *context, const ovoid_answer *answer, double size, double reach,
                                 ovoid_error *error) {
    double width = answer->upper - answer->lower, unresolved = 0x1p-88 * reach + 16 * OVOID_LENGTH_MIN;
    if (!(answer->lower <= 0 && answer->upper >= 0))
        return judge_reject(error, OVOID_ERROR_PROOF, "touching is not what the bracket says");
    if (width <= fmax(context->absolute, context->relative * size) * (1 + ROUNDING) + unresolved) return OVOID_OK;
    return judge_reject(error, OVOID_ERROR_PROOF, "touching within %.3g is wide for bodies of size %.3g", width, size);
}

static ovoid_code verify_status(const judge *context, const posed *s, const ovoid_answer *answer, ovoid_error *error) {
    if ((answer->status == OVOID_SEPARATED) != (answer->lower > 0))
        return judge_reject(error, OVOID_ERROR_PROOF, "the status is not what lower, %.17g, says", answer->lower);
    if ((answer->status == OVOID_OVERLAPPING) != (answer->upper < 0))
        return judge_reject(error, OVOID_ERROR_PROOF, "the status is not what upper, %.17g, says", answer->upper);
    if (answer->status != OVOID_TOUCHING) return OVOID_OK;
    return judge_verify_touching(context, answer, s->size + s->allowed, s->a.reach + s->b.reach, error);
}

// The normal is unit to 1e-12 and parallel to the proof's direction to 1e-12; nothing is required if there is no
// lower bound.
static ovoid_code verify_normal(pool *p, const ovoid_answer *answer, ovoid_error *error) {
    if (answer->lower == -INFINITY) return OVOID_OK;
    nvec n = nvec_from(p, answer->normal), direction = proof_direction(p, &answer->proof);
    num square = nvec_norm_squared(p, n), tolerance = number_from(p, 1e-12), one = number_from_integer(p, 1);
    if (num_compare(p, square, num_mul(p, num_sub(p, one, tolerance), num_sub(p, one, tolerance))) < 0 ||
        num_compare(p, square, num_mul(p, num_add(p, one, tolerance), num_add(p, one, tolerance))) > 0)
        return judge_reject(error, OVOID_ERROR_PROOF, "the normal's length is %.17g", sqrt(num_to_double(square)));
    // sine and cosine of the angle between the two
    num across = nvec_norm_squared(p, nvec_cross(p, n, direction));
    if (num_sign(nvec_dot(p, n, direction)) <= 0 ||
        num_compare_roots(p, one, across, tolerance, num_mul(p, square, nvec_norm_squared(p, direction))) > 0)
        return judge_reject(error, OVOID_ERROR_PROOF, "the normal is not the direction of the lower bound");
    return OVOID_OK;
}

static ovoid_code verify_indices(const posed *s, const ovoid_proof *proof, ovoid_error *error) {
    if (proof->count > OVOID_PROOF_PAIRS)
        return judge_reject(error, OVOID_ERROR_INDEX, "%u pairs, more than a proof has", proof->count);
    for (uint32_t i = 0; i < proof->count; i++)
        if (!body_has_vertex(&s->a, proof->a[i]) || !body_has_vertex(&s->b, proof->b[i]))
            return judge_reject(error, OVOID_ERROR_INDEX, "entry %u of the proof has no such vertex", i);
    return OVOID_OK;
}

// --- the whole answer

static ovoid_code verify_bounds(judge *context, const posed *s, const ovoid_answer *answer, const ovoid_cover *cover,
                                ovoid_error *error) {
    pool *p = s->p;
    claim c = {.context = context, .s = s, .proof = &answer->proof, .error = error};
    ovoid_code code = OVOID_OK;
    if (answer->lower != -INFINITY) {
        c.core = num_add(p, num_add(p, number_from(p, answer->lower), s->radii), s->outside);
        code = judge_verify_lower(&c);
    }
    if (code == OVOID_OK && answer->upper != INFINITY) {
        c.core = num_sub(p, num_add(p, number_from(p, answer->upper), s->radii), s->inside);
        code = judge_verify_upper(&c, cover);
        if (code == OVOID_OK) code = judge_verify_witness(&c, answer);
    }
    return code;
}

ovoid_code judge_verify_posed(judge *context, const posed *s, const ovoid_answer *answer, const ovoid_cover *cover,
                              ovoid_error *error) {
    ovoid_code code = verify_data(answer, error);
    if (code == OVOID_OK) code = verify_indices(s, &answer->proof, error);
    if (code == OVOID_OK) code = verify_bounds(context, s, answer, cover, error);
    if (code == OVOID_OK) code = verify_status(context, s, answer, error);
    if (code == OVOID_OK) code = verify_normal(context->p, answer, error);
    return code;
}

ovoid_code judge_verify_answer(judge *context, const ovoid_pair *pair, const ovoid_answer *answer,
                               const ovoid_cover *cover, ovoid_error *error) {
    if (!context || !pair || !pair->shape_a || !pair->shape_b || !answer)
        return judge_reject(error, OVOID_ERROR_ARGUMENT, "a pointer is NULL");
    if (is_refusal(answer)) return verify_refusal(pair, answer, error);
    if (!judge_is_pose_valid(&pair->pose_a) || !judge_is_pose_valid(&pair->pose_b))
        return judge_reject(error, OVOID_ERROR_PROOF, "an answer for a pose that is none");
    size_t mark = pool_get_mark(context->p);
    posed s = posed_make(context->p, pair);
    ovoid_code code = judge_verify_posed(context, &s, answer, cover, error);
    pool_release(context->p, mark);
    return code;
}
