// Steps as short arrays: a page lists thousands of them.
#include "robot/page_steps.h"

#include "base/message.h"
#include "io/fields.h"
#include "page/write.h"
#include "robot/path/proof.h"

#include <stdlib.h>

/// Most steps of a page, and most pairs whose sides are named.
enum { STEPS_MOST = 20000, PAIRS_MOST = 20000 };

static void write_step(FILE *file, const ovoid_robot_step *step) {
    fputc('[', file);
    json_write_number(file, step->begin);
    fputc(',', file);
    json_write_number(file, step->end);
    fprintf(file, ",\"%s\",[", path_get_step_kind(step->kind));
    path_write_step_pairs(file, step);
    fputs("]]", file);
}

int page_write_steps(FILE *file, const path_report *r, size_t *left_out) {
    size_t count = r->answer.step_count, listed = count < STEPS_MOST ? count : STEPS_MOST, size = 0;
    char *text = NULL;
    // Names of links may have any sign.
    FILE *pairs = open_memstream(&text, &size);
    if (pairs && ovoid_robot_cell_get_pair_count(r->cell->cell) <= PAIRS_MOST) proof_write_pairs(pairs, r->cell);
    int is_written = pairs && fclose(pairs) == 0;
    fputs(",\"steps\":[", file);
    for (size_t i = 0; i < listed; i++) {
        if (i) fputc(',', file);
        write_step(file, &r->steps[i]);
    }
    fputs("],\"pairs\":[", file);
    if (is_written) page_copy_json(file, text, size);
    fputc(']', file);
    free(text);
    *left_out = count - listed;
    return is_written ? 0 : (message_error("out of memory"), EXIT_INPUT);
}
