// The clearance over a path: the signed distance of the nearest pair at samples, in the colour of that pair. A picture
// only: what holds between the samples is what ovoid_robot_path_find_hit proves.
#include "base/finish.h"
#include "base/message.h"
#include "robot/path/path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Samples of a segment, and most of a path.
enum { SEGMENT_SAMPLES = 100, SAMPLES_MAX = 4000 };

/// Most pairs with a colour of their own; the others share one.
enum { PAIRS_MAX = 9, NAMES_ROOM = 2 * CELL_SIDE_ROOM };

/// What was sampled.
typedef struct plot {
    const path_report *report;
    size_t count, pair_count;
    double *x; ///< count
    double *y; ///< (PAIRS_MAX + 2) * count: of each pair, of all others, the margin
    ovoid_robot_near firsts[PAIRS_MAX];
    char names[PAIRS_MAX][NAMES_ROOM];
    double least, least_at;
    char least_names[NAMES_ROOM];
} plot;

static int is_same_side(const ovoid_robot_side *a, const ovoid_robot_side *b) {
    return a->link == b->link && a->element == b->element && a->body == b->body;
}

static void format_names(char text[NAMES_ROOM], const cli_cell *cell, const ovoid_robot_near *near) {
    char a[CELL_SIDE_ROOM], b[CELL_SIDE_ROOM];
    (void)cell_format_side(a, cell, &near->a);
    (void)cell_format_side(b, cell, &near->b);
    snprintf(text, NAMES_ROOM, "%.150s, %.150s", a, b);
}

/// The colour of a pair.
static size_t find_pair(plot *p, const ovoid_robot_near *near) {
    for (size_t i = 0; i < p->pair_count; i++)
        if (is_same_side(&p->firsts[i].a, &near->a) && is_same_side(&p->firsts[i].b, &near->b)) return i;
    if (p->pair_count == PAIRS_MAX) return PAIRS_MAX;
    p->firsts[p->pair_count] = *near;
    format_names(p->names[p->pair_count], p->report->cell, near);
    return p->pair_count++;
}

static void set_sample(plot *p, size_t i, const ovoid_robot_near *near) {
    double middle = near->lower + (near->upper - near->lower) / 2;
    p->y[find_pair(p, near) * p->count + i] = middle;
    if (i && middle >= p->least) return;
    p->least = middle;
    p->least_at = p->x[i];
    format_names(p->least_names, p->report->cell, near);
}

/// 0, or an exit code after a message.
static int sample(plot *p, ovoid_robot_checker *checker, const ovoid_robot_query_options *options) {
    ovoid_error error;
    ovoid_robot_near near;
    ovoid_robot_nears nears = {.items = &near, .capacity = 1};
    ovoid_robot_query_options all = *options;
    const cli_states *states = p->report->states;
    double *q = malloc((states->variable_count + 1) * sizeof *q);
    if (!q) return message_error("out of memory"), EXIT_INPUT;
    all.margin = all.limit_slack = INFINITY; // the plot shows all distances, of all states that there are
    int code = 0;
    for (size_t i = 0; i < p->count && !code; i++) {
        p->x[i] = p->count > 1 ? (double)(states->count - 1) * (double)i / (double)(p->count - 1) : 0;
        path_compute_state(states, p->x[i], q);
        if (ovoid_robot_find_nearest(checker, &(ovoid_robot_query){q, &all}, &nears, &error) != OVOID_OK)
            message_error("plot: s %.9g: %s", p->x[i], error.message), code = EXIT_INPUT;
        else if (nears.count)
            set_sample(p, i, &near);
    }
    free(q);
    return code;
}

static int write_chart(const plot *p, const char *path) {
    ovoid_series series[PAIRS_MAX + 2];
    size_t count = 0;
    char title[2 * NAMES_ROOM];
    for (size_t i = 0; i <= PAIRS_MAX + 1; i++) {
        const char *name = i < p->pair_count ? p->names[i] : i == PAIRS_MAX ? "other pairs" : "margin";
        int is_used = i < p->pair_count || (i == PAIRS_MAX + 1 && p->report->margin > 0);
        for (size_t k = 0; i == PAIRS_MAX && k < p->count; k++) is_used |= isfinite(p->y[i * p->count + k]);
        if (is_used)
            series[count++] = (ovoid_series){
                .name = name, .kind = OVOID_SERIES_LINE, .count = p->count, .x = p->x, .y = p->y + i * p->count};
    }
    snprintf(title, sizeof title, "least clearance %.6g at s %.6g: %s", p->least, p->least_at, p->least_names);
    const ovoid_chart chart = {.title = title,
                               .x_label = "s, of the path",
                               .y_label = "distance of the nearest pair",
                               .series = series,
                               .series_count = count,
                               .width = 1000};
    return finish_chart(path, &chart);
}

int path_plot(const char *path, const path_report *report, ovoid_robot_checker *checker,
              const ovoid_robot_query_options *options) {
    size_t segments = report->states->count - 1, most = (SAMPLES_MAX - 1) / SEGMENT_SAMPLES;
    plot p = {.report = report, .least = INFINITY};
    p.count = 1 + (segments < most ? segments * SEGMENT_SAMPLES : SAMPLES_MAX - 1);
    if (report->answer.status == OVOID_ROBOT_REFUSED) return message_warning("a refused path is not drawn"), 0;
    size_t numbers = (PAIRS_MAX + 3) * p.count;
    double *room = malloc(numbers * sizeof *room);
    if (!room) return message_error("out of memory"), EXIT_INPUT;
    for (size_t i = 0; i < numbers; i++) room[i] = NAN;
    p.x = room;
    p.y = room + p.count;
    for (size_t i = 0; i < p.count; i++) p.y[(PAIRS_MAX + 1) * p.count + i] = report->margin;
    int code = sample(&p, checker, options);
    if (!code && !isfinite(p.least)) message_warning("there is no pair: nothing is drawn");
    if (!code && isfinite(p.least)) code = write_chart(&p, path);
    free(room);
    return code;
}
