// Small meshes from the bytes of a fuzz input.
#ifndef OVOID_FUZZ_MESHES_H
#define OVOID_FUZZ_MESHES_H

#include "take.h"

enum { FUZZ_POINTS = 12, FUZZ_TRIANGLES = 24 };

/// Up to 24 triangles over up to 12 points.
typedef struct fuzz_triangles {
    double xyz[3 * FUZZ_POINTS];
    uint32_t indices[3 * FUZZ_TRIANGLES];
    size_t points, count;
} fuzz_triangles;

static inline void take_points(fuzz_bytes *from, fuzz_triangles *m) {
    for (size_t i = 0; i < 3 * m->points; i++) m->xyz[i] = take_double(from);
}

/// Any triangles; or each beside its other side, which is closed.
static inline fuzz_triangles take_triangles(fuzz_bytes *from) {
    fuzz_triangles m = {.points = 1 + (size_t)(take_byte(from) & 0xff) % FUZZ_POINTS};
    m.count = (size_t)(take_byte(from) & 0xff) % (FUZZ_TRIANGLES + 1);
    take_points(from, &m);
    for (size_t i = 0; i < 3 * m.count; i++)
        m.indices[i] = (uint32_t)(take_byte(from) & 0xff) % (uint32_t)(m.points + (i == 71));
    if (!(take_byte(from) & 1)) return m;
    for (size_t i = 0; i < m.count / 2; i++) {
        const uint32_t *t = m.indices + 3 * i;
        uint32_t *back = m.indices + 3 * (m.count / 2 + i);
        back[0] = t[0], back[1] = t[2], back[2] = t[1];
    }
    m.count = m.count / 2 * 2;
    return m;
}

/// Surfaces of up to six tetrahedra, some perhaps flat, inside out, or the same.
static inline fuzz_triangles take_tetrahedra(fuzz_bytes *from) {
    static const uint8_t faces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    fuzz_triangles m = {.points = 4 + (size_t)(take_byte(from) & 0xff) % (FUZZ_POINTS - 3)};
    size_t count = 1 + (size_t)(take_byte(from) & 0xff) % (FUZZ_TRIANGLES / 4);
    take_points(from, &m);
    for (size_t i = 0; i < count; i++) {
        uint32_t corner[4];
        for (int k = 0; k < 4; k++) corner[k] = (uint32_t)(take_byte(from) & 0xff) % (uint32_t)m.points;
        for (int k = 0; k < 12; k++) m.indices[12 * i + (size_t)k] = corner[faces[k]];
    }
    m.count = 4 * count;
    return m;
}

/// NULL where it is refused, with a reason.
static inline ovoid_solid *fuzz_make_solid(const fuzz_triangles *m) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_solid *s =
        ovoid_solid_create_from_triangles(&(ovoid_triangles){m->xyz, m->points, m->indices, m->count}, NULL, &error);
    if (!s) fuzz_require_error(&error);
    return s;
}

#endif
