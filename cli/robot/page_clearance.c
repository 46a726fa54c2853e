// Samples of the clearance: what holds at these s, not between them.
#include "robot/page_clearance.h"

#include "base/message.h"
#include "io/fields.h"
#include "page/write.h"
#include "robot/path/path.h"

#include <math.h>
#include <stdlib.h>

/// Samples of a segment, and most of a path.
enum { SEGMENT_SAMPLES = 50, SAMPLES_MOST = 2001 };

/// Writes one sample into JSON that may have any sign in its names.
static void write_sample(FILE *file, const cli_cell *cell, double s, const ovoid_robot_near *near) {
    fputc('[', file);
    json_write_number(file, s);
    fputc(',', file);
    json_write_number(file, near->lower);
    fputc(',', file);
    json_write_number(file, near->upper);
    fputc(',', file);
    cell_write_side_json(file, cell, &near->a);
    fputc(',', file);
    cell_write_side_json(file, cell, &near->b);
    fputc(']', file);
}

static int write_samples(FILE *file, const cli_cell *cell, const cli_states *states, ovoid_robot_checker *checker,
                         const ovoid_robot_query_options *options) {
    ovoid_error error;
    ovoid_robot_near near;
    ovoid_robot_nears nears = {.items = &near, .capacity = 1};
    size_t segments = states->count - 1, most = (SAMPLES_MOST - 1) / SEGMENT_SAMPLES;
    size_t count = 1 + (segments < most ? segments * SEGMENT_SAMPLES : SAMPLES_MOST - 1);
    double *q = malloc((states->variable_count + 1) * sizeof *q);
    if (!q) return message_error("out of memory"), EXIT_INPUT;
    int code = 0;
    const char *before = "";
    ovoid_robot_checker_reset(checker);
    for (size_t i = 0; i < count && !code; i++) {
        double s = count > 1 ? (double)segments * (double)i / (double)(count - 1) : 0;
        path_compute_state(states, s, q);
        if (ovoid_robot_find_nearest(checker, &(ovoid_robot_query){q, options}, &nears, &error) != OVOID_OK) {
            message_error("--html: s %.9g: %s", s, error.message);
            code = EXIT_INPUT;
        } else if (nears.count) {
            fputs(before, file);
            write_sample(file, cell, s, &near);
            before = ",";
        }
    }
    free(q);
    return code;
}

int page_write_clearance(FILE *file, const cli_cell *cell, const cli_states *states, ovoid_robot_checker *checker,
                         const ovoid_robot_query_options *options) {
    ovoid_robot_query_options all = *options;
    all.margin = all.limit_slack = INFINITY; // all distances, of all states that there are
    char *text = NULL;
    size_t size = 0;
    FILE *samples = open_memstream(&text, &size);
    if (!samples) return message_error("out of memory"), EXIT_INPUT;
    int code = write_samples(samples, cell, states, checker, &all);
    if (fclose(samples) != 0 && !code) code = EXIT_INPUT, message_error("out of memory");
    fputs(",\"clearance\":[", file);
    if (!code) page_copy_json(file, text, size);
    fputc(']', file);
    free(text);
    return code;
}
