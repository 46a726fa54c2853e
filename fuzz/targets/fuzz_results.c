// Results: what is read is checked against a pair of boxes (its proofs may hold or not, but are never followed out of
// bounds) and can be written again.
#include "fuzz.h"

#include <ovoid/io.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_results_reader *reader = ovoid_results_reader_open(fuzz_write_file("results.jsonl", data, size), &error);
    if (!reader) {
        fuzz_require_error(&error);
        return 0;
    }
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    FILE *nowhere = fopen("/dev/null", "w");
    fuzz_require(box != NULL && nowhere != NULL);
    ovoid_pair pair = {box, box, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position.x = 3;
    ovoid_record record;
    int got;
    while ((got = ovoid_results_reader_read(reader, &record, &error)) == 1) {
        fuzz_require(ovoid_results_reader_get_line(reader) > 0);
        (void)ovoid_answer_verify(&pair, &record.answer, &(ovoid_answer_basis){.cover = record.cover}, &error);
        for (size_t i = 0; i < record.contact_count; i++) {
            const ovoid_record_contact *contact = &record.contacts[i];
            const ovoid_manifold_options options = {.margin = 2.5, .cover = (ovoid_cover *)contact->cover};
            (void)ovoid_manifold_verify(&pair, &contact->manifold, &options, &error);
            fuzz_require(ovoid_manifold_compute_points(&pair, &contact->manifold).count <= 4);
        }
        fuzz_require(ovoid_record_write_json(nowhere, &record) == OVOID_OK);
        fuzz_require(ovoid_record_write_csv(nowhere, &record) == OVOID_OK);
    }
    if (got < 0) fuzz_require_error(&error);
    (void)fclose(nowhere);
    ovoid_shape_destroy(box);
    ovoid_results_reader_close(reader);
    return 0;
}
