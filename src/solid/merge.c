// The given triangles: refusals of bad input, and their points, of which equal ones are merged.
#include "solid/merge.h"

#include "base/allocator.h"
#include "base/error.h"
#include "tools/hash.h"

#include <string.h>

ovoid_code solid_validate_triangles(const ovoid_triangles *given, ovoid_error *error) {
    const double *xyz = given->xyz;
    const uint32_t *indices = given->indices;
    size_t points = given->point_count, count = given->count;
    if ((!xyz && points) || (!indices && count))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the array of %s is NULL", xyz ? "indices" : "points");
    if (count == 0) return error_set(error, OVOID_ERROR_EMPTY, -1, "a solid of no triangles");
    if (count > OVOID_SOLID_TRIANGLES_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu triangles, %zu are allowed", count,
                         OVOID_SOLID_TRIANGLES_MAX);
    if (points > 3 * OVOID_SOLID_TRIANGLES_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu points, %zu are allowed", points,
                         3 * OVOID_SOLID_TRIANGLES_MAX);
    for (size_t i = 0; i < points; i++) {
        vec3 p = vec3_at(xyz, i);
        if (!vec3_is_finite(p))
            return error_set(error, OVOID_ERROR_NOT_FINITE, (int64_t)i, "point %zu is not finite", i);
        if (vec3_max_abs(p) > OVOID_LENGTH_MAX)
            return error_set(error, OVOID_ERROR_RANGE, (int64_t)i, "point %zu is beyond %g", i, OVOID_LENGTH_MAX);
    }
    for (size_t i = 0; i < 3 * count; i++)
        if (indices[i] >= points)
            return error_set(error, OVOID_ERROR_INDEX, (int64_t)(i / 3), "triangle %zu: there is no point %u, only %zu",
                             i / 3, indices[i], points);
    return OVOID_OK;
}

static int is_end(const void *table, size_t slot, const void *key) {
    const solid_merger *m = table;
    return m->table[slot] == UINT32_MAX || hash_is_same_point(m->points + 3 * (size_t)m->table[slot], key);
}

// The slot of an equal point, or the free slot where it belongs.
static size_t find_slot(const solid_merger *m, const double p[3]) {
    return hash_find(hash_point(p), (size_t)m->mask + 1, m, p, is_end);
}

uint32_t merger_find(const solid_merger *m, vec3 point) {
    const double p[3] = {point.x + 0.0, point.y + 0.0, point.z + 0.0};
    return m->table[find_slot(m, p)];
}

static uint32_t merge_point(solid_merger *m, const double *xyz) {
    const double p[3] = {xyz[0] + 0.0, xyz[1] + 0.0, xyz[2] + 0.0};
    size_t at = find_slot(m, p);
    if (m->table[at] != UINT32_MAX) return m->table[at];
    memcpy(m->points + 3 * (size_t)m->count, p, sizeof p);
    return m->table[at] = m->count++;
}

void merger_destroy(solid_merger *m, const ovoid_allocator *a) {
    allocator_release(a, m->points);
    allocator_release(a, m->triangles);
    allocator_release(a, m->table);
    allocator_release(a, m->merged);
}

int merger_make(solid_merger *m, const ovoid_triangles *given, const ovoid_allocator *a) {
    const double *xyz = given->xyz;
    const uint32_t *indices = given->indices;
    size_t points = given->point_count, count = given->count;
    size_t most = points < 3 * count ? points : 3 * count, slots = 4;
    while (slots < 2 * most) slots *= 2;
    *m = (solid_merger){allocator_allocate(a, most, 3 * sizeof(double)),
                        allocator_allocate(a, count, sizeof(solid_triangle)),
                        allocator_allocate(a, slots, sizeof(uint32_t)),
                        allocator_allocate(a, points, sizeof(uint32_t)),
                        (uint32_t)(slots - 1),
                        0};
    if (!m->points || !m->triangles || !m->table || !m->merged) {
        merger_destroy(m, a);
        return 0;
    }
    memset(m->table, 0xff, slots * sizeof(uint32_t));
    memset(m->merged, 0xff, points * sizeof(uint32_t));
    for (size_t i = 0; i < 3 * count; i++) {
        uint32_t *known = &m->merged[indices[i]];
        if (*known == UINT32_MAX) *known = merge_point(m, xyz + 3 * (size_t)indices[i]);
        m->triangles[i / 3].point[i % 3] = *known;
    }
    return 1;
}
