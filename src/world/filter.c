// Which pairs of bodies are queried: groups, ignored pairs, the filter.
#include "base/environment.h"
#include "base/error.h"
#include "world/move.h"

#include <string.h>

ovoid_code ovoid_world_set_groups(ovoid_world *w, ovoid_id id, ovoid_groups groups, ovoid_error *error) {
    uint32_t i = world_find_body(w, id);
    if (i == NONE) return world_refuse_id(error, -1, id);
    w->bodies[i].groups = groups_make(groups);
    body_mark_fresh(w, i);
    return OVOID_OK;
}

ovoid_code ovoid_world_renew(ovoid_world *w, ovoid_id id, ovoid_error *error) {
    uint32_t i = world_find_body(w, id);
    if (i == NONE) return world_refuse_id(error, -1, id);
    body_mark_fresh(w, i);
    return OVOID_OK;
}

// Doubles the table where it would be more than half full.
static int reserve_ignored(ovoid_world *w) {
    ignored *old = &w->ignored;
    if (2 * (old->count + 1) <= old->capacity) return 1;
    ignored larger = {.capacity = old->capacity ? 2 * old->capacity : 32};
    larger.keys = world_allocate(w, larger.capacity, sizeof *larger.keys);
    if (!larger.keys) return 0;
    memset(larger.keys, 0xff, larger.capacity * sizeof *larger.keys);
    for (size_t i = 0; i < old->capacity; i++)
        if (old->keys[i] != IGNORED_NONE) (void)ignored_add(&larger, old->keys[i]);
    world_release(w, old->keys, old->capacity, sizeof *old->keys);
    *old = larger;
    return 1;
}

static ovoid_code validate_pair(const ovoid_world *w, ovoid_id a, ovoid_id b, ovoid_error *error) {
    uint32_t i = world_find_body(w, a), j = world_find_body(w, b);
    if (i == NONE) return world_refuse_id(error, 0, a);
    if (j == NONE) return world_refuse_id(error, 1, b);
    if (i == j) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a body and itself are no pair");
    return OVOID_OK;
}

// Both bodies of a pair are in `change` more ignored pairs.
static void count_ignored(ovoid_world *w, uint64_t key, uint32_t change) {
    uint32_t i = key_get_a(key), j = key_get_b(key);
    w->bodies[i].next += change;
    w->bodies[j].next += change;
    body_mark_fresh(w, i < j ? i : j);
}

static ovoid_code add_ignored(ovoid_world *w, ovoid_id a, ovoid_id b, ovoid_error *error) {
    ovoid_code code = validate_pair(w, a, b, error);
    if (code != OVOID_OK) return code;
    if (!reserve_ignored(w)) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory to ignore a pair");
    uint64_t key = key_make((uint32_t)(a >> 32), (uint32_t)(b >> 32));
    if (ignored_add(&w->ignored, key)) count_ignored(w, key, 1);
    return OVOID_OK;
}

static ovoid_code remove_ignored(ovoid_world *w, ovoid_id a, ovoid_id b, ovoid_error *error) {
    ovoid_code code = validate_pair(w, a, b, error);
    if (code != OVOID_OK) return code;
    uint64_t key = key_make((uint32_t)(a >> 32), (uint32_t)(b >> 32));
    if (ignored_remove(&w->ignored, key)) count_ignored(w, key, ~0u);
    return OVOID_OK;
}

ovoid_code ovoid_world_add_ignored(ovoid_world *w, ovoid_id a, ovoid_id b, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, a, add_ignored(w, a, b, error));
}

ovoid_code ovoid_world_remove_ignored(ovoid_world *w, ovoid_id a, ovoid_id b, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, a, remove_ignored(w, a, b, error));
}

static int is_pair(const ovoid_world *w, ovoid_id a, ovoid_id b) {
    uint32_t i = world_find_body(w, a), j = world_find_body(w, b);
    return i != NONE && j != NONE && i != j && world_is_pair(w, i, j);
}

int ovoid_world_is_pair(const ovoid_world *w, ovoid_id a, ovoid_id b) { ENVIRONMENT_RETURN(int, a, is_pair(w, a, b)); }
