// The .ovoid format, as given and with the checksum mended (FNV-1a of 64 bits, docs/polytope.md), without which little
// would get past it. What is accepted is written again as the same bytes and can be asked.
#include "fuzz.h"

static void read_shape(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_read(data, size, NULL, &error);
    if (!shape) {
        fuzz_require_error(&error);
        return;
    }
    // The same bytes.
    size_t needed = ovoid_shape_write(shape, NULL, 0);
    unsigned char *copy = malloc(needed);
    fuzz_require(copy != NULL);
    fuzz_require(ovoid_shape_write(shape, copy, needed) == needed);
    fuzz_require(needed == size && memcmp(copy, data, size) == 0);
    free(copy);
    // A query of it, proven.
    ovoid_pair pair = {shape, shape, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position.x = 2 * (ovoid_shape_get_measures(shape).sphere_radius + ovoid_shape_get_radius(shape)) + 1;
    ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
    fuzz_require(ovoid_answer_check(&pair, &answer, NULL, NULL) == OVOID_OK || answer.limit >= OVOID_LIMIT_POSE_A);
    ovoid_shape_destroy(shape);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    read_shape(data, size);
    if (size < 8) return 0;

    uint8_t *mended = malloc(size);
    fuzz_require(mended != NULL);
    memcpy(mended, data, size);
    uint64_t checksum = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size - 8; i++) checksum = (checksum ^ data[i]) * 0x100000001b3u;
    for (size_t i = 0; i < 8; i++) mended[size - 8 + i] = (uint8_t)(checksum >> 8 * i);
    read_shape(mended, size);
    free(mended);
    return 0;
}
