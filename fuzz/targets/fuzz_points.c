// Shapes from any points, radius and gap. What is accepted holds all its points (no query can prove one of them
// outside), is made of some of them, and survives being written and read.
#include "take.h"

enum { MOST = 40 };

static void check_points(const ovoid_shape *shape, const double *xyz, size_t count) {
    for (size_t i = 0; i < count; i++) {
        ovoid_shape *point = ovoid_shape_create_from_points(xyz + 3 * i, 1, NULL, NULL);
        fuzz_require(point != NULL);
        ovoid_pair pair = {point, shape, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
        ovoid_answer answer = ovoid_collide(&pair, NULL, NULL);
        fuzz_require(answer.status != OVOID_SEPARATED);
        ovoid_shape_destroy(point);
    }
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    fuzz_require(p.vertex_count >= 1 && p.vertex_count <= count);
    for (uint32_t v = 0; v < p.vertex_count; v++) {
        const double *x = p.vertices + 3 * (size_t)v;
        int is_given = 0;
        for (size_t i = 0; i < count && !is_given; i++)
            is_given = p.origin.x + x[0] == xyz[3 * i] && p.origin.y + x[1] == xyz[3 * i + 1] &&
                       p.origin.z + x[2] == xyz[3 * i + 2];
        fuzz_require(is_given);
    }
}

static void check_file(const ovoid_shape *shape) {
    size_t size = ovoid_shape_write(shape, NULL, 0);
    void *bytes = malloc(size);
    fuzz_require(bytes && ovoid_shape_write(shape, bytes, size) == size);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *again = ovoid_shape_read(bytes, size, NULL, &error);
    fuzz_require(again != NULL);
    ovoid_shape_destroy(again);
    free(bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    double xyz[3 * MOST] = {0};
    size_t count = (size_t)((unsigned)take_byte(&from) % (MOST + 1));
    ovoid_shape_options options = {.inner = (ovoid_inner_method)(take_byte(&from) % 3)};
    uint8_t kind = take_byte(&from);
    if (kind > 64) options.radius = take_double(&from);
    if (kind > 192) options.allowance = (ovoid_allowance){.outside = take_double(&from), .inside = take_double(&from)};
    if (take_byte(&from) > 64) options.gap = take_double(&from);
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = take_double(&from);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, &error);
    if (!shape) {
        fuzz_require_error(&error);
        return 0;
    }
    check_points(shape, xyz, count);
    check_file(shape);
    ovoid_shape_destroy(shape);
    return 0;
}
