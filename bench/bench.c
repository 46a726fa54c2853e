// bench: nanoseconds per query of ovoid and its peers, side by side, with every answer judged. bench --help explains
// the options.
#include "common/build.h"
#include "contacts/contacts.h"
#include "many/many.h"
#include "pairs/cells.h"
#include "pairs/field.h"
#include "pairs/ours.h"
#include "pairs/plan.h"
#include "pairs/scale.h"
#include "pairs/stages.h"
#include "pairs/standing.h"
#include "robots/robots.h"
#include "setup/setup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "bench [OPTION...]: nanoseconds per query of ovoid and its peers over the same pairs\n"
    "\n"
    "  --smoke          few pairs, one repetition: does it run\n"
    "  --workload TEXT  only workloads whose name holds TEXT: hulls, boxes, real, motion, paper, 'gap 1%', ...\n"
    "  --sizes N,...    vertices of the random hulls (8,16,32,64,128,512,2048)\n"
    "  --count N        bodies and pairs of each still workload (200)\n"
    "  --seconds S      time spent on each line of the table (1.5)\n"
    "  --csv FILE       all numbers\n"
    "  --svg FILE       a plot of them\n"
    "  --data FOLDER    where pieces/game_hulls.bin is (OVOID_DATA, else ../shared/data)\n"
    "  --peer FILE      a module with one more peer (bench/peers/peer.h; with --robot bench/peers/robot_peer.h); may "
    "be repeated\n"
    "  --alone          without the peers built beside it\n"
    "  --stages         instead: which stage decides how many pairs, at what cost; spheres and boxes beside "
    "ellipsoids\n"
    "  --scale          instead: cost over vertices, pairs and threads; memory of a shape\n"
    "  --setup          instead: making a shape and reading its file, beside Qhull's and peers' hulls "
    "(bench/peers/setup_peer.h)\n"
    "  --many           instead: frames of many moving bodies; a robot among parts, for a planner and a monitor\n"
    "  --bodies N,...   with --many: numbers of bodies (1000,10000,100000)\n"
    "  --robot          instead: robots of the data folder among obstacles: states, edges, monitor, matrix\n"
    "  --contacts       instead: contact points, cold and from the frame before (bench/peers/contact_peer.h)\n"
    "  --scenes N       with --robot: most scenes of a robot (700)\n"
    "  --pairs N        with --scale: most pairs of a batch (1000000)\n"
    "  --help           this\n"
    "\n"
    "A number is the median of the repetitions; CSV has quartiles and minima too. A name with + starts from the last\n"
    "frame's result, and 'ovoid' with its last proof. '*': some of the answers are wrong, '!': more than 1 %.\n";

enum { MODULES_MOST = 16 };

typedef struct settings {
    plan what;
    effort much;
    field all;
    const char *csv, *svg;
    int alone, stages, scale, setup, many, robot, contacts;
    const char *modules[MODULES_MOST];
    uint32_t module_count;
    robots_plan robots;
    uint32_t pairs;
    many_plan crowd;
} settings;

/// All cells of one workload.
typedef struct table {
    const settings *how;
    cells results;
} table;

static void print_cell(table *t, const cell *c) {
    // A new head if the family of workloads changes.
    const cell *last = t->results.count > 1 ? &t->results.items[t->results.count - 2] : NULL;
    if (!last || strncmp(last->workload, c->workload, 4) != 0) cells_print_head(c);
    cells_print_row(c, t->results.own);
}

static int measure_question(table *t, const workload *work, question what, const truth *truths, found *answers,
                            cell *c) {
    // Contestants that do not answer the question, or are not warm here, do not take part.
    void *selves[ENTRANTS_MOST] = {NULL};
    for (uint32_t i = 0; i < c->count; i++) {
        entrant *e = &c->entrants[i];
        selves[i] = e->self;
        if (!(e->who->questions >> what & 1)) e->self = NULL;
        if (i >= t->results.own) e->warm = work->tracks && (e->who->warm >> what & 1);
    }
    measure(c->entrants, c->count, work, what, truths, answers, t->how->much);
    for (uint32_t i = 0; i < c->count; i++) c->entrants[i].self = selves[i];
    c->what = what;
    c->unproven = ours_count_unproven(work, what);
    if (!cells_add(&t->results, c)) return 0;
    print_cell(t, c);
    return 1;
}

static int measure_workload(void *context, const workload *work) {
    table *t = context;
    static cell c;
    c = (cell){.vertices = work->vertices, .pairs = work->pair_count, .tracks = work->tracks};
    memcpy(c.workload, work->name, sizeof c.workload);
    truth *truths = truths_create(work, &c.open);
    found *answers = calloc(work->pair_count, sizeof *answers);
    c.count = field_enter(&t->how->all, work, c.entrants);
    int good = truths && answers;
    for (int what = 0; good && what < QUESTION_COUNT; what++)
        if (work->questions >> what & 1) good = measure_question(t, work, (question)what, truths, answers, &c);
    field_leave(c.entrants, c.count);
    free(answers);
    free(truths);
    return good;
}

static int run_table(const settings *how) {
    static table t;
    t = (table){how, {.own = FIELD_OWN}};
    printf("ovoid %s, nanoseconds per query, one thread\n%s\n", ovoid_get_version(), get_build());
    int good = plan_visit(&how->what, measure_workload, &t);
    if (good) cells_print_faults(&t.results);
    if (good && !how->alone) standing_print(&t.results);
    uint32_t unproven = 0;
    for (uint32_t i = 0; i < t.results.count; i++) unproven += t.results.items[i].unproven;
    if (how->csv && !cells_write_csv(&t.results, how->csv)) good = 0;
    if (how->svg && !cells_write_svg(&t.results, how->svg)) good = 0;
    cells_destroy(&t.results);
    return good && unproven == 0;
}

/// Reads a list like "8,16"; 0 if it is not one, or longer than `most`.
static int read_list(const char *text, uint32_t *items, uint32_t most, uint32_t *count) {
    *count = 0;
    while (*text) {
        char *end;
        unsigned long n = strtoul(text, &end, 10);
        if (end == text || n < 4 || n > 1000000 || *count == most || (*end && *end != ',')) return 0;
        items[(*count)++] = (uint32_t)n;
        text = *end ? end + 1 : end;
    }
    return *count > 0;
}

static int read_count(const char *text, uint32_t *count) {
    char *end;
    unsigned long n = strtoul(text, &end, 10);
    *count = (uint32_t)n;
    return *text && !*end && n >= 2 && n <= 100000000;
}

/// A module is loaded once its queries are known.
static int add_module(settings *how, const char *path) {
    if (how->module_count == MODULES_MOST) return 0;
    how->modules[how->module_count++] = path;
    return 1;
}

/// An option with its value; 0 if it is not valid.
static int read_valued(settings *how, const char *name, const char *value) {
    if (!value) return 0;
    if (!strcmp(name, "--workload"))
        how->robots.only = how->crowd.only = how->what.only = value;
    else if (!strcmp(name, "--sizes"))
        return read_list(value, how->what.sizes, SIZES_MOST, &how->what.size_count);
    else if (!strcmp(name, "--bodies"))
        return read_list(value, how->crowd.counts, COUNTS_MOST, &how->crowd.count_of_counts);
    else if (!strcmp(name, "--count"))
        return read_count(value, &how->what.count);
    else if (!strcmp(name, "--seconds"))
        return (how->much.seconds = strtod(value, NULL)) > 0;
    else if (!strcmp(name, "--csv"))
        how->csv = value;
    else if (!strcmp(name, "--svg"))
        how->svg = value;
    else if (!strcmp(name, "--data"))
        how->robots.data = how->crowd.data = how->what.data = value;
    else if (!strcmp(name, "--peer"))
        return add_module(how, value);
    else if (!strcmp(name, "--scenes"))
        return read_count(value, &how->robots.scenes);
    else if (!strcmp(name, "--pairs"))
        return read_count(value, &how->pairs);
    else
        return 0;
    return 1;
}

/// An option alone; 0 if it is not valid.
static int read_switch(settings *how, const char *name) {
    if (!strcmp(name, "--alone"))
        how->alone = 1;
    else if (!strcmp(name, "--stages"))
        how->stages = 1;
    else if (!strcmp(name, "--scale"))
        how->scale = 1;
    else if (!strcmp(name, "--setup"))
        how->setup = 1;
    else if (!strcmp(name, "--many"))
        how->many = 1;
    else if (!strcmp(name, "--robot"))
        how->robot = 1;
    else if (!strcmp(name, "--contacts"))
        how->contacts = 1;
    else if (!strcmp(name, "--smoke")) {
        how->what.smoke = 1;
        how->what.count = 10;
        how->what.size_count = 2;
        how->much = (effort){0, 1};
        how->pairs = 100;
        how->crowd = many_plan_make_smoke();
        how->robots = robots_plan_make_smoke();
    } else
        return 0;
    return 1;
}

int main(int argc, char **argv) {
    const char *data = getenv("OVOID_DATA");
    settings how = {.what = {{8, 16, 32, 64, 128, 512, 2048}, 7, 200, NULL, data && *data ? data : "../shared/data", 0},
                    .much = {1.5, 5},
                    .all = field_make(),
                    .pairs = 1000000,
                    .crowd = many_plan_make(),
                    .robots = robots_plan_make()};
    how.robots.data = how.crowd.data = how.what.data;
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            (void)fputs(help, stdout);
            return 0;
        }
        if (read_switch(&how, argv[i])) continue;
        if (!read_valued(&how, argv[i], i + 1 < argc ? argv[i + 1] : NULL)) {
            (void)fprintf(stderr, "bench: not understood: %s %s; bench --help says what is\n", argv[i],
                          i + 1 < argc ? argv[i + 1] : "");
            return 2;
        }
        i++;
    }
    if (how.stages) return !stages_run(&how.what);
    if (how.scale) return !scale_run(how.csv, how.svg, how.pairs, how.what.smoke);
    if (how.setup) {
        const setup_plan asked = {how.what.sizes,   how.what.size_count, how.modules,
                                  how.module_count, how.alone,           how.what.smoke};
        return !setup_run(&asked, how.csv, how.svg);
    }
    if (how.many) return !many_run(&how.crowd, how.csv, how.svg, how.alone);
    if (how.robot) return !robots_run_all(&how.robots, how.modules, how.module_count, how.csv, how.svg, how.alone);
    if (how.contacts) {
        const contacts_plan asked = {how.what.only,           how.modules, how.module_count, how.what.smoke ? 10 : 120,
                                     how.what.smoke ? 1 : 40, how.alone};
        return !contacts_run(&asked);
    }
    for (uint32_t i = 0; i < how.module_count; i++)
        if (!field_load(&how.all, how.modules[i])) return 2;
    if (!how.alone) field_load_built(&how.all);
    return !run_table(&how);
}
