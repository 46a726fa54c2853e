// Two hulls of points on a coarse grid (many duplicates, many coplanar, many touchings) in poses, with options and an
// earlier proof from the bytes. All five questions; the exact judge is the abort.
#include "ask.h"

/// Of a grid of few values.
static double take_coordinate(fuzz_bytes *from, int step) {
    int cell = take_byte(from) / step;
    return cell;
}

static ovoid_shape *take_shape(fuzz_bytes *from) {
    double xyz[3 * 16];
    size_t count = 1 + (size_t)(take_byte(from) & 15);
    double scale = ldexp(1, take_byte(from) / 2);
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = scale * take_coordinate(from, 16);
    uint8_t kind = take_byte(from);
    ovoid_shape_options options = {.radius = (kind & 3) == 0 ? scale * (take_byte(from) & 7) : 0};
    if ((kind & 12) == 8) options.allowance.outside = scale * (take_byte(from) & 15) / 8;
    if ((kind & 48) == 32) options.allowance.inside = scale * (take_byte(from) & 15) / 8;
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, &error);
    if (!shape) fuzz_require_error(&error);
    return shape;
}

static ovoid_pose take_pose(fuzz_bytes *from) {
    double scale = ldexp(1, take_byte(from) / 2);
    double v[7];
    for (int i = 0; i < 7; i++) v[i] = take_coordinate(from, 8);
    return (ovoid_pose){{scale * v[0], scale * v[1], scale * v[2]}, {v[3], v[4], v[5], v[6]}};
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    ovoid_shape *a = take_shape(&from), *b = take_shape(&from);
    if (a && b) {
        ovoid_pair pair = {a, b, take_pose(&from), take_pose(&from)};
        double margin = fabs(take_double(&from));
        ovoid_options options = {.relative_tolerance = ldexp(1, take_byte(&from) / 4 - 32),
                                 .iterations = 1 + (uint32_t)(take_byte(&from) & 15)};
        ovoid_proof earlier = fuzz_take_proof(&from);
        fuzz_ask(&pair, isfinite(margin) ? margin : 0, size > 200 ? &options : NULL, &earlier);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return 0;
}
