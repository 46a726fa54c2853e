// What callers set of bodies for their manifolds, and the ranges that follow: how far beyond the margin contacts of a
// body are wanted.
#include "world/material.h"

#include "base/environment.h"
#include "base/error.h"
#include "world/move.h"

#include <string.h>

ovoid_material material_get(const ovoid_world *w, uint32_t i) {
    return i < w->material_capacity ? w->materials[i] : (ovoid_material){0, 0, 0};
}

void material_forget(ovoid_world *w, uint32_t i) {
    if (i < w->material_capacity) w->materials[i] = (ovoid_material){0, 0, 0};
    if (i < w->range_capacity) w->ranges[i] = (body_range){0, 0, 0};
}

static ovoid_code refuse_number(const ovoid_material *m, ovoid_error *error) {
    const double numbers[] = {m->margin, m->friction, m->restitution};
    static const char *const names[] = {"margin", "friction", "restitution"};
    for (int k = 0; k < 3; k++)
        if (!(numbers[k] >= 0 && numbers[k] <= OVOID_LENGTH_MAX))
            return error_set(error, OVOID_ERROR_ARGUMENT, -1,
                             "%s %.17g: it must be finite, not negative and at most OVOID_LENGTH_MAX", names[k],
                             numbers[k]);
    return OVOID_OK;
}

// Room for an item of each index in use, the new ones of zeros.
static int reserve_items(ovoid_world *w, void **items, size_t *capacity, size_t size) {
    size_t before = *capacity;
    if (!world_reserve(w, items, capacity, before, w->used, size)) return 0;
    if (*capacity > before) memset((char *)*items + before * size, 0, (*capacity - before) * size);
    return 1;
}

static ovoid_code set_material(ovoid_world *w, ovoid_id id, const ovoid_material *material, ovoid_error *error) {
    OVOID_ASSERT(w && material);
    uint32_t i = world_find_body(w, id);
    if (i == NONE) return world_refuse_id(error, -1, id);
    ovoid_code code = refuse_number(material, error);
    if (code != OVOID_OK) return code;
    if (!reserve_items(w, (void **)&w->materials, &w->material_capacity, sizeof *w->materials))
        return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for the materials of %u bodies", w->used);
    w->materials[i] = *material;
    return OVOID_OK;
}

ovoid_code ovoid_world_set_material(ovoid_world *w, ovoid_id id, const ovoid_material *material, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, set_material(w, id, material, error));
}

ovoid_code ovoid_world_get_material(const ovoid_world *w, ovoid_id id, ovoid_material *material, ovoid_error *error) {
    OVOID_ASSERT(w && material);
    uint32_t i = world_find_body(w, id);
    if (i == NONE) return world_refuse_id(error, -1, id);
    *material = material_get(w, i);
    return OVOID_OK;
}

// ---- ranges

// The way of the last move says nothing of a body that was not moved since the last step.
static double find_way(const ovoid_world *w, uint32_t i, double ahead) {
    const world_body *b = &w->bodies[i];
    if (!(ahead > 0) || !(w->marks[i] & MARK_POSED)) return 0;
    const vec3 d = {(double)b->displacement[0], (double)b->displacement[1], (double)b->displacement[2]};
    return min2(ahead * (vec3_norm(d) + (double)b->turn), b->reach + b->radius);
}

int material_update_ranges(ovoid_world *w, double ahead) {
    if (!w->material_capacity && !w->range_capacity && !(ahead > 0)) return 1;
    if (!reserve_items(w, (void **)&w->ranges, &w->range_capacity, sizeof *w->ranges)) return 0;
    for (uint32_t i = 0; i < w->used; i++) {
        if (w->leaf_of[i] == NONE) continue;
        body_range *range = &w->ranges[i];
        double way = find_way(w, i, ahead), now = material_get(w, i).margin + way;
        // The pairs of a body with another range are compared again.
        if (now != range->now) w->marks[i] |= MARK_MOVED;
        range->now = now;
        range->spare = way / 2;
        if (now > range->boxed) body_refresh(w, i);
    }
    return 1;
}
