// Pairs of a batch.
#include "fuzz.h"

#include <ovoid/io.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_pairs_reader *reader = ovoid_pairs_reader_create(fuzz_write_file("pairs.csv", data, size), 10, &error);
    if (!reader) {
        fuzz_require_error(&error);
        return 0;
    }
    ovoid_indexed_pair pair;
    int got;
    while ((got = ovoid_pairs_reader_read(reader, &pair, &error)) == 1) {
        fuzz_require(pair.a < 10 && pair.b < 10);
        fuzz_require(ovoid_pose_compute_check(&pair.pose_a) == OVOID_OK);
        fuzz_require(ovoid_pose_compute_check(&pair.pose_b) == OVOID_OK);
    }
    if (got < 0) fuzz_require_error(&error);
    ovoid_pairs_reader_destroy(reader);
    return 0;
}
