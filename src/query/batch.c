// One question about many pairs: arrays in, arrays out. Each couple's answer has the bits of the single query's.
#include "base/environment.h"
#include "base/error.h"
#include "query/answer.h"

// No earlier proof: nothing in it could help.
static int is_blank(const ovoid_proof *p) {
    return p->kind == OVOID_PROOF_NONE && p->count == 0 && !(p->normal.x != 0 || p->normal.y != 0 || p->normal.z != 0);
}

static void write_outputs(const ovoid_batch *batch, size_t i, const ovoid_answer *x) {
    if (batch->proofs) batch->proofs[i] = x->proof;
    if (batch->verdicts)
        batch->verdicts[i] = (ovoid_verdict){x->status, x->stage, x->limit, x->iterations, x->lower, x->upper};
    if (batch->answers && x != &batch->answers[i]) batch->answers[i] = *x;
}

static void find_answers(const ovoid_batch *batch, question ask) {
    ovoid_answer own;
    for (size_t i = 0; i < batch->couple_count; i++) {
        const ovoid_body *a = &batch->bodies[batch->couples[i].a], *b = &batch->bodies[batch->couples[i].b];
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        const ovoid_proof *earlier = batch->proofs && !is_blank(&batch->proofs[i]) ? &batch->proofs[i] : NULL;
        ovoid_answer *out = batch->answers ? &batch->answers[i] : &own;
        answer_find_inside(&pair, batch->options, ask, earlier, NULL, out);
        write_outputs(batch, i, out);
    }
}

static ovoid_code run(const ovoid_batch *batch, question ask, ovoid_error *error) {
    OVOID_ASSERT(batch && (batch->couples || !batch->couple_count));
    for (size_t i = 0; i < batch->couple_count; i++)
        if (batch->couples[i].a >= batch->body_count || batch->couples[i].b >= batch->body_count)
            return error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "couple %zu names a body past the last of %zu", i,
                             batch->body_count);
    environment before = environment_enter();
    environment_hide(ask);
    find_answers(batch, ask);
    environment_leave(before);
    return OVOID_OK;
}

ovoid_code ovoid_collide_batch(const ovoid_batch *batch, ovoid_error *error) {
    return run(batch, question_make_collide(), error);
}

ovoid_code ovoid_within_batch(const ovoid_batch *batch, double margin, ovoid_error *error) {
    return run(batch, question_make_within(margin), error);
}

ovoid_code ovoid_distance_batch(const ovoid_batch *batch, ovoid_error *error) {
    return run(batch, question_make_distance(batch->options), error);
}

ovoid_code ovoid_depth_batch(const ovoid_batch *batch, ovoid_error *error) {
    return run(batch, question_make_depth(batch->options), error);
}
