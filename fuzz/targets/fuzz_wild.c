// Two hulls of any doubles in any poses: all scales, mixed, and what is not a number. What is refused is refused with a
// reason; all else is answered, and the exact judge is the abort.
#include "ask.h"

static ovoid_shape *take_shape(fuzz_bytes *from) {
    double xyz[3 * 12], radius = 0;
    size_t count = 1 + (size_t)((unsigned)take_byte(from) % 12);
    int is_round = take_byte(from) > 64;
    if (is_round) radius = take_double(from);
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = take_double(from);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape_options options = {.radius = radius};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, &error);
    if (!shape) fuzz_require_error(&error);
    return shape;
}

static ovoid_pose take_pose(fuzz_bytes *from) {
    ovoid_vec3 position = {take_double(from), take_double(from), take_double(from)};
    ovoid_quat rotation = {take_double(from), take_double(from), take_double(from), take_double(from)};
    return (ovoid_pose){position, rotation};
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    ovoid_shape *a = take_shape(&from), *b = take_shape(&from);
    if (a && b) {
        ovoid_pair pair = {a, b, take_pose(&from), take_pose(&from)};
        int is_signed = take_byte(&from) > 64; // a negative margin is refused
        double margin = is_signed ? take_double(&from) : fabs(take_double(&from));
        ovoid_options options = {take_double(&from), take_double(&from), take_double(&from),
                                 (uint32_t)take_byte(&from) & 63};
        ovoid_proof earlier = fuzz_take_proof(&from);
        fuzz_ask(&pair, margin, &options, &earlier);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return 0;
}
