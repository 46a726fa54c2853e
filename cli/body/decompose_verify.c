// Verifies the proof of a decomposition against the mesh and the parts.
#include "body/decompose.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/progress.h"

#include <stdlib.h>

static void show_progress(void *context, size_t done, size_t total) {
    (void)context, (void)total;
    progress_set(done);
}

/// Checks the claims; an exit code.
static int check(const char *path, const decomposed *d, const ovoid_decomposition_record *record) {
    ovoid_error error;
    ovoid_decomposition_options options = {.work = DECOMPOSED_CHECK_WORK, .progress = show_progress};
    if (record->triangles != ovoid_solid_get_report(d->view.solid).triangles || record->parts != d->view.part_count) {
        message_error("%s: it is of another mesh or of other parts: %llu triangles and %llu parts", path,
                      (unsigned long long)record->triangles, (unsigned long long)record->parts);
        return EXIT_NOT_PROVEN;
    }
    progress_start("cells", 0);
    ovoid_code code = ovoid_decomposition_verify(&d->view, &record->proof, &options, &error);
    progress_end();
    if (code) message_error("%s: %s", path, error.message);
    if (code == OVOID_ERROR_ARGUMENT || code == OVOID_ERROR_LIMIT) return EXIT_NOT_PROVEN;
    return code ? EXIT_INPUT : EXIT_APART;
}

int decomposed_verify(const char *const *paths, const read_settings *settings) {
    ovoid_decomposition_record record;
    ovoid_error error;
    decomposed d = {.path = paths[1]};
    ovoid_read_options read = inputs_make_options(settings);
    if (ovoid_decomposition_read_json(paths[0], &record, &error)) return message_error("%s", error.message), EXIT_INPUT;
    ovoid_solid *solid = ovoid_solid_read_file(paths[1], &read, &error);
    if (!solid) return message_error("%s", error.message), EXIT_INPUT;
    d.view.solid = solid;
    int code = decomposed_read_parts(&d, paths[2], settings);
    if (!code) code = check(paths[0], &d, &record);
    if (code != EXIT_INPUT) printf("proofs: 1, hold: %d, do not: %d\n", !code, code != 0);
    ovoid_shapes_destroy(d.given);
    ovoid_solid_destroy(solid);
    free(d.list);
    int end = finish_file(stdout);
    return end ? end : code;
}
