// One question about many pairs: arrays in, arrays out. Each couple's answer has the bits of the single query's.
#include "base/environment.h"
#include "base/error.h"
#include "query/crowd.h"

// The first couple that names a body past the last; couple_count where there is none. Without a branch for each.
static size_t find_bad_couple(const ovoid_batch *batch) {
    size_t bad = 0;
    for (size_t i = 0; i < batch->couple_count; i++)
        bad |= (size_t)(batch->couples[i].a >= batch->body_count) | (size_t)(batch->couples[i].b >= batch->body_count);
    if (!bad) return batch->couple_count;
    size_t i = 0;
    while (batch->couples[i].a < batch->body_count && batch->couples[i].b < batch->body_count) i++;
    return i;
}

enum { FEW = 3 };

static void find_answers(const ovoid_batch *batch, question ask) {
    ovoid_options options;
    // What is refused is refused for each, a depth has no cheap stages, and a few couples do not pay for eight lanes.
    int is_few = batch->couple_count < FEW;
    if (is_few || ask.wants_depth || !options_make(batch->options, &options) || !(ask.far >= 0))
        for (size_t i = 0; i < batch->couple_count; i++) crowd_ask_single(batch, i, ask);
    else
        crowd_run(batch, ask, &options);
}

static ovoid_code run(const ovoid_batch *batch, question ask, ovoid_error *error) {
    OVOID_ASSERT(batch && (batch->couples || !batch->couple_count));
    size_t bad = find_bad_couple(batch);
    if (bad < batch->couple_count)
        return error_set(error, OVOID_ERROR_INDEX, (int64_t)bad, "couple %zu names a body past the last of %zu", bad,
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
