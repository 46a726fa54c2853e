// Pairs of a batch.
#include "fuzz.h"

#include <ovoid/io.h>

/// How many pairs all parts of a good file have.
static size_t count_parts(const char *path, size_t parts) {
    ovoid_error error;
    ovoid_indexed_pair pair;
    size_t count = 0;
    for (size_t i = 0; i < parts; i++) {
        ovoid_pairs_reader *reader = ovoid_pairs_reader_open(path, 10, &error);
        fuzz_require(reader && ovoid_pairs_reader_set_part(reader, i, parts, &error) == OVOID_OK);
        int got;
        while ((got = ovoid_pairs_reader_read(reader, &pair, &error)) == 1) count++;
        fuzz_require(got == 0);
        ovoid_pairs_reader_close(reader);
    }
    return count;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = fuzz_write_file("pairs.csv", data, size);
    ovoid_pairs_reader *reader = ovoid_pairs_reader_open(path, 10, &error);
    if (!reader) {
        fuzz_require_error(&error);
        return 0;
    }
    ovoid_indexed_pair pair;
    size_t count = 0;
    int got;
    while ((got = ovoid_pairs_reader_read(reader, &pair, &error)) == 1) {
        count++;
        fuzz_require(pair.a < 10 && pair.b < 10);
        fuzz_require(ovoid_pose_validate(&pair.pose_a) == OVOID_OK);
        fuzz_require(ovoid_pose_validate(&pair.pose_b) == OVOID_OK);
    }
    if (got < 0) fuzz_require_error(&error);
    ovoid_pairs_reader_close(reader);
    if (got == 0) fuzz_require(count_parts(path, 3) == count);
    return 0;
}
