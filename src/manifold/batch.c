// Contacts of many pairs, one after another.
#include "base/environment.h"
#include "base/error.h"
#include "manifold/manifold.h"

static ovoid_pair get_pair(const ovoid_manifold_batch *batch, size_t i) {
    const ovoid_posed_shape *a = batch->bodies + batch->couples[i].a, *b = batch->bodies + batch->couples[i].b;
    return (ovoid_pair){a->shape, b->shape, a->pose, b->pose};
}

static ovoid_code find_all(const ovoid_manifold_batch *batch, ovoid_error *error) {
    OVOID_ASSERT(batch && (batch->couples || !batch->couple_count));
    for (size_t i = 0; i < batch->couple_count; i++)
        if (batch->couples[i].a >= batch->body_count || batch->couples[i].b >= batch->body_count)
            return error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "couple %zu names a body past the last of %zu", i,
                             batch->body_count);
    ovoid_manifold_options options = batch->options ? *batch->options : (ovoid_manifold_options){0};
    for (size_t i = 0; i < batch->couple_count; i++) {
        ovoid_pair pair = get_pair(batch, i);
        ovoid_manifold found;
        options.points = batch->points ? batch->points + i : NULL;
        manifold_find_internal(&pair, &options, batch->manifolds + i, &found);
        batch->manifolds[i] = found;
    }
    return OVOID_OK;
}

ovoid_code ovoid_manifold_find_batch(const ovoid_manifold_batch *batch, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, batch, find_all(batch, error));
}
