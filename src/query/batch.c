// One query of many pairs: arrays in, arrays out. Each couple's answer has the bits of a batch of that couple alone.
#include "base/environment.h"
#include "base/error.h"
#include "query/batch_simd.h"

// 1 if surely each couple names bodies. Without a branch or a comparison: what is past the last of at most 2^31 bodies
// has the highest bit, or the last body less that number has it.
static int names_bodies(const ovoid_batch *batch) {
    uint32_t last = (uint32_t)batch->body_count - 1, bad = 0;
    if (batch->body_count - 1 > INT32_MAX) return 0;
    for (size_t i = 0; i < batch->couple_count; i++) {
        uint32_t a = batch->couples[i].a, b = batch->couples[i].b;
        bad |= (a | b) | ((last - a) | (last - b));
    }
    return !(bad >> 31);
}

// The first couple that names a body past the last; couple_count where there is none.
static size_t find_bad_couple(const ovoid_batch *batch) {
    size_t i = names_bodies(batch) ? batch->couple_count : 0;
    while (i < batch->couple_count && batch->couples[i].a < batch->body_count &&
           batch->couples[i].b < batch->body_count)
        i++;
    return i;
}

static ovoid_code find_answers(const ovoid_batch *batch, query_goal *goal, ovoid_error *error) {
    OVOID_ASSERT(batch && (batch->couples || !batch->couple_count));
    size_t bad = find_bad_couple(batch);
    if (bad < batch->couple_count)
        return error_set(error, OVOID_ERROR_INDEX, (int64_t)bad, "couple %zu names a body past the last of %zu", bad,
                         batch->body_count);
    ovoid_options options;
    // Refused options are refused couple by couple, and a depth has no cheap stages.
    if (goal->wants_depth || !options_make(batch->options, &options) || !(goal->far >= 0))
        for (size_t i = 0; i < batch->couple_count; i++) batch_query_single(batch, i, goal);
    else
        batch_run(batch, goal, &options);
    return OVOID_OK;
}

// The goal is not copied: it was just stored, and a wider load would wait for that.
static ovoid_code run(const ovoid_batch *batch, query_goal *goal, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, *goal, find_answers(batch, goal, error));
}

ovoid_code ovoid_collide_batch(const ovoid_batch *batch, ovoid_error *error) {
    query_goal goal = query_goal_make_collide();
    return run(batch, &goal, error);
}

ovoid_code ovoid_within_batch(const ovoid_batch *batch, double margin, ovoid_error *error) {
    query_goal goal = query_goal_make_within(margin);
    return run(batch, &goal, error);
}

ovoid_code ovoid_distance_batch(const ovoid_batch *batch, ovoid_error *error) {
    query_goal goal = query_goal_make_distance(batch->options);
    return run(batch, &goal, error);
}

ovoid_code ovoid_depth_batch(const ovoid_batch *batch, ovoid_error *error) {
    query_goal goal = query_goal_make_depth(batch->options);
    return run(batch, &goal, error);
}
