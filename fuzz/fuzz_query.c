// Two hulls of points on a coarse grid (many duplicates, many coplanar, many touchings) in poses from the bytes. Every
// answer, of any status, must pass the library's own check, and a depth must agree with the distance about the sign.
#include "fuzz.h"

#include <math.h>

typedef struct bytes {
    const uint8_t *data;
    size_t size;
} bytes;

static int take(bytes *from) {
    if (!from->size) return 0;
    from->size--;
    return (int8_t)*from->data++;
}

/// Of a grid of few values.
static double take_coordinate(bytes *from, int step) {
    int cell = take(from) / step;
    return cell;
}

static ovoid_shape *take_shape(bytes *from) {
    double xyz[3 * 16];
    size_t count = 1 + (size_t)(take(from) & 15);
    double scale = ldexp(1, take(from) / 2);
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = scale * take_coordinate(from, 16);
    ovoid_shape_options options = {.radius = (take(from) & 3) == 0 ? scale * (take(from) & 7) : 0};
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, &error);
    if (!shape) fuzz_require_error(&error);
    return shape;
}

static ovoid_pose take_pose(bytes *from) {
    double scale = ldexp(1, take(from) / 2);
    double v[7];
    for (int i = 0; i < 7; i++) v[i] = take_coordinate(from, 8);
    return (ovoid_pose){{scale * v[0], scale * v[1], scale * v[2]}, {v[3], v[4], v[5], v[6]}};
}

static void ask(const ovoid_pair *pair) {
    static ovoid_cover cover; // large, and filled by each call
    ovoid_answer answers[4] = {ovoid_collide(pair, NULL, NULL), ovoid_distance(pair, NULL, NULL),
                               ovoid_depth(pair, NULL, NULL, &cover), ovoid_bounds(pair)};
    for (int i = 0; i < 4; i++) {
        fuzz_require(answers[i].lower <= answers[i].upper);
        // Refused: no bracket, hence nothing to check.
        if (answers[i].limit >= OVOID_LIMIT_POSE_A) continue;
        fuzz_require(ovoid_answer_check(pair, &answers[i], i == 2 ? &cover : NULL, NULL) == OVOID_OK);
        // Brackets of one d have a point in common.
        for (int k = 0; k < i; k++)
            fuzz_require(answers[i].lower <= answers[k].upper && answers[k].lower <= answers[i].upper);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    bytes from = {data, size};
    ovoid_shape *a = take_shape(&from), *b = take_shape(&from);
    if (a && b) {
        ovoid_pair pair = {a, b, take_pose(&from), take_pose(&from)};
        ask(&pair);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return 0;
}
