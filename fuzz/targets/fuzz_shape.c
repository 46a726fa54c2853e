// The .ovoid format, as given and with the checksum mended (docs/polytope.md), without which little
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

static uint64_t mix(uint64_t sum, uint64_t word) {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 32;
}

// Of versions up to 8 by bytes, of later ones by words, in turn into four sums.
static void mend(unsigned char *bytes, size_t size) {
    uint64_t by_bytes = 0xcbf29ce484222325u, by_words = 0, sum[4] = {1, 2, 3, 4};
    for (size_t i = 0; i < size - 8; i++) by_bytes = (by_bytes ^ bytes[i]) * 0x100000001b3u;
    for (size_t i = 0; i + 16 <= size; i += 8) {
        uint64_t word = 0;
        for (size_t k = 0; k < 8; k++) word |= (uint64_t)bytes[i + k] << 8 * k;
        sum[i / 8 % 4] = mix(sum[i / 8 % 4], word);
    }
    for (int k = 0; k < 4; k++) by_words = mix(by_words, sum[k]);
    uint64_t checksum = size > VERSION_AT && bytes[VERSION_AT] > 8 ? by_words : by_bytes;
    for (size_t i = 0; i < 8; i++) bytes[size - 8 + i] = (unsigned char)(checksum >> 8 * i);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    read_shape(data, size);
    if (size < 8) return 0;

    uint8_t *mended = malloc(size);
    fuzz_require(mended != NULL);
    memcpy(mended, data, size);
    mend(mended, size);
    read_shape(mended, size);
    free(mended);
    return 0;
}
