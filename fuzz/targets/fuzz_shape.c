// The .ovoid format, as given and with the checksum mended (FNV-1a of 64 bits, docs/polytope.md), without which little
// would get past it. What is accepted is written again as the same bytes and can be asked. (A solid is written in the
// version of its number of vertices; read in another one, it is the bytes of the second writing that stay.)
#include "fuzz.h"

// The version of the format, its first byte.
#define VERSION_AT 8

// The shape's file, with malloc.
static unsigned char *write_file(const ovoid_shape *shape, size_t *size) {
    *size = ovoid_shape_write(shape, NULL, 0);
    unsigned char *bytes = malloc(*size);
    fuzz_require(bytes != NULL);
    fuzz_require(ovoid_shape_write(shape, bytes, *size) == *size);
    return bytes;
}

static void require_same_bytes(const ovoid_shape *shape, const uint8_t *data, size_t size) {
    size_t written, again;
    unsigned char *copy = write_file(shape, &written);
    if (copy[VERSION_AT] == data[VERSION_AT])
        fuzz_require(written == size && memcmp(copy, data, size) == 0);
    else {
        ovoid_shape *other = ovoid_shape_read(copy, written, NULL, NULL);
        fuzz_require(other != NULL);
        unsigned char *second = write_file(other, &again);
        fuzz_require(again == written && memcmp(second, copy, written) == 0);
        free(second);
        ovoid_shape_destroy(other);
    }
    free(copy);
}

static void read_shape(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_read(data, size, NULL, &error);
    if (!shape) {
        fuzz_require_error(&error);
        return;
    }
    require_same_bytes(shape, data, size);
    // A query of it, proven.
    ovoid_pair pair = {shape, shape, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position.x = 2 * (ovoid_shape_get_measures(shape).sphere_radius + ovoid_shape_get_radius(shape)) + 1;
    ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
    fuzz_require(ovoid_answer_verify(&pair, &answer, NULL, NULL) == OVOID_OK || answer.limit >= OVOID_LIMIT_POSE_A);
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
