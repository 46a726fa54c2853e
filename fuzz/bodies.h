// Shapes and poses from the bytes of a fuzz input: of a coarse grid, where much is equal, coplanar and touching, or of
// any doubles whatever.
#ifndef OVOID_FUZZ_BODIES_H
#define OVOID_FUZZ_BODIES_H

#include "take.h"

/// A whole number from -16 to 15, or any double.
static inline double take_number(fuzz_bytes *from, int is_wild) {
    if (is_wild) return take_double(from);
    int cell = take_byte(from) / 8;
    return cell;
}

static inline ovoid_vec3 take_vector(fuzz_bytes *from, int is_wild) {
    double v[3];
    for (int i = 0; i < 3; i++) v[i] = take_number(from, is_wild);
    return (ovoid_vec3){v[0], v[1], v[2]};
}

static inline ovoid_pose take_any_pose(fuzz_bytes *from, int is_wild) {
    ovoid_vec3 position = take_vector(from, is_wild), xyz = take_vector(from, is_wild);
    return (ovoid_pose){position, {take_number(from, is_wild), xyz.x, xyz.y, xyz.z}};
}

/// NULL where it is refused, with a reason.
static inline ovoid_shape *take_any_shape(fuzz_bytes *from, int is_wild) {
    double xyz[3 * 10];
    size_t count = 1 + (size_t)((unsigned)take_byte(from) % 10);
    uint8_t kind = take_byte(from);
    ovoid_shape_options options = {.radius = (kind & 3) == 0 ? take_number(from, is_wild) / 8 : 0};
    if ((kind & 12) == 8) options.allowance.outside = take_number(from, is_wild) / 64;
    if ((kind & 48) == 32) options.allowance.inside = take_number(from, is_wild) / 64;
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = take_number(from, is_wild) / 2;
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, &error);
    if (!shape) fuzz_require_error(&error);
    return shape;
}

/// What a promise of a check says, then the end.
static inline void fuzz_require_code(ovoid_code code, const ovoid_error *error) {
    if (code == OVOID_OK) return;
    (void)fprintf(stderr, "wrong answer: %s\n", error->message);
    abort();
}

#endif
