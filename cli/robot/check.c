// ovoid robot check: which states of a robot are free, and what they hit or are near. States go through a pipeline in
// blocks of OVOID_ROBOT_BLOCK, each of which begins with nothing remembered, as ovoid_robot_collide_batch has it; so
// the answers are the same bytes for any number of threads.
#include "robot/commands.h"

#include "base/message.h"
#include "base/outputs.h"
#include "base/pipeline.h"
#include "base/progress.h"
#include "robot/page.h"
#include "robot/report.h"
#include "robot/tally.h"

#include <stdlib.h>
#include <string.h>

typedef struct settings {
    cell_settings cell;
    robot_settings robot;
    states_settings states;
    output_settings out;
    double near;
    int gradient;
    unsigned threads, top;
    shard_part part;
    const char *html;
} settings;

static const cli_option options[] = {
    STATES_OPTIONS(settings),
    CELL_OPTIONS(settings),
    ATTACH_OPTION(settings),
    {"near", 0, OPTION_POSITIVE, offsetof(settings, near), "D", NULL,
     "of each state all pairs that are not proven farther apart than D, nearest first"},
    {"gradient", 0, OPTION_FLAG, offsetof(settings, gradient), NULL, NULL,
     "with --near: the derivatives of the distances by the variables"},
    {"top", 0, OPTION_AMOUNT, offsetof(settings, top), "N", NULL,
     "list N states, 0: all; all are counted (default: of a table 20, else all)"},
    THREADS_OPTION(settings),
    SHARD_OPTION(settings),
    PAGE_OPTION(settings),
    ROBOT_OPTIONS(settings),
    REPORT_OPTIONS(settings),
    {.name = NULL},
};

/// The default of --top.
#define TOP_UNSET 0xffffffffu
#define TOP_TABLE 20

/// A growing list of near pairs with their gradients.
typedef struct near_list {
    ovoid_robot_near *items;
    double *gradients;
    size_t count, capacity;
} near_list;

/// A run.
typedef struct check {
    const settings *settings;
    report_form form;
    ovoid_robot_query_options options, near_options;
    size_t next, listed;
    cli_results results;
    tally tally;
    report_state *rows; ///< of the table
    near_list kept;     ///< their near pairs
    robot_page *page;
    const char *urdf;
} check;

/// States of a pipeline's slot.
typedef struct block {
    ovoid_robot_checker *checker;
    size_t first, count, counts[OVOID_ROBOT_BLOCK]; ///< counts: of near pairs
    ovoid_robot_answer answers[OVOID_ROBOT_BLOCK];
    near_list near;
    char *text;
    size_t size;
    ovoid_error error; ///< where failed
    int failed;
} block;

static void free_list(near_list *list) {
    free(list->items);
    free(list->gradients);
    *list = (near_list){.items = NULL};
}

/// Room for that many more pairs; 0 where memory is out.
static int reserve(near_list *list, size_t more, size_t variables) {
    size_t wanted = list->count + more, n = variables ? variables : 1;
    if (wanted <= list->capacity) return 1;
    wanted += wanted / 2;
    ovoid_robot_near *items = realloc(list->items, wanted * sizeof *items);
    if (items) list->items = items;
    double *gradients = realloc(list->gradients, wanted * n * sizeof *gradients);
    if (gradients) list->gradients = gradients;
    if (items && gradients) list->capacity = wanted;
    return items && gradients;
}

// ---- a block of states

static int fill(void *context, void *slot) {
    check *c = context;
    block *k = slot;
    const shard_part part = c->settings->part;
    k->count = pipeline_take(&c->next, c->form.states->count, OVOID_ROBOT_BLOCK, &k->first);
    // The blocks of other shards are left out.
    for (unsigned i = 1; i < part.count && k->count; i++) {
        size_t first;
        (void)pipeline_take(&c->next, c->form.states->count, OVOID_ROBOT_BLOCK, &first);
    }
    return k->count > 0;
}

/// Near pairs of a state for which there is room at first. Always as many, whatever room there is: a second search is
/// warm from the first and has other last digits, so that whether there is one must not depend on the blocks before.
#define NEAR_ROOM 64

/// The near pairs of state i of the block, behind those of the states before.
static ovoid_code find_near(const check *c, block *k, size_t i) {
    size_t n = c->form.states->variable_count, room = NEAR_ROOM;
    for (;;) {
        if (!reserve(&k->near, room, n)) {
            snprintf(k->error.message, sizeof k->error.message, "out of memory");
            return OVOID_ERROR_MEMORY;
        }
        double *gradients = c->form.has_gradient ? k->near.gradients + k->near.count * n : NULL;
        ovoid_robot_nears nears = {.items = k->near.items + k->near.count, .gradients = gradients, .capacity = room};
        const double *q = states_get(c->form.states, k->first) + i * n;
        ovoid_code code =
            ovoid_robot_find_near(k->checker, &(ovoid_robot_query){q, &c->near_options}, &nears, &k->error);
        if (code != OVOID_OK) return code;
        if (nears.count > nears.capacity) {
            room = nears.count;
            continue;
        }
        k->counts[i] = nears.count;
        k->near.count += nears.count;
        return OVOID_OK;
    }
}

static report_state get_state(const check *c, const block *k, size_t i, size_t first_near) {
    size_t n = c->form.states->variable_count;
    return (report_state){k->first + i, k->answers[i], k->near.items ? k->near.items + first_near : NULL,
                          c->form.has_gradient && k->near.gradients ? k->near.gradients + first_near * n : NULL,
                          k->counts[i]};
}

/// The block's lines of JSON or CSV.
static int write_lines(const check *c, block *k) {
    FILE *file = open_memstream(&k->text, &k->size);
    size_t near = 0;
    if (!file) return 0;
    for (size_t i = 0; i < k->count && k->first + i < c->listed; i++) {
        report_state s = get_state(c, k, i, near);
        (c->settings->out.json ? report_write_json : report_write_csv)(file, &c->form, &s);
        near += k->counts[i];
    }
    return fclose(file) == 0;
}

static void work(void *context, void *slot) {
    const check *c = context;
    block *k = slot;
    if (!k->checker) k->checker = ovoid_robot_checker_create(c->form.cell->cell, NULL, &k->error);
    k->failed = !k->checker;
    if (k->failed) return;
    const ovoid_robot_batch batch = {states_get(c->form.states, k->first), k->count, &c->options, k->answers};
    k->failed = ovoid_robot_collide_batch(&k->checker, 1, &batch, &k->error) != OVOID_OK;
    // The near pairs begin with the proofs of the batch, which begins with none.
    k->near.count = 0;
    memset(k->counts, 0, sizeof k->counts);
    for (size_t i = 0; i < k->count && c->form.has_near && !k->failed; i++)
        if (k->answers[i].status != OVOID_ROBOT_REFUSED) k->failed = find_near(c, k, i) != OVOID_OK;
    if (k->failed || !results_are_lines(&c->results) || write_lines(c, k)) return;
    k->failed = 1;
    snprintf(k->error.message, sizeof k->error.message, "out of memory");
}

/// Keeps state i for the table. 0 where memory is out.
static int keep(check *c, const block *k, size_t i, size_t first_near) {
    size_t n = c->form.states->variable_count, count = k->counts[i];
    c->rows[k->first + i] = get_state(c, k, i, first_near);
    if (!count) return 1;
    if (!reserve(&c->kept, count, n)) return 0;
    memcpy(c->kept.items + c->kept.count, k->near.items + first_near, count * sizeof *c->kept.items);
    if (c->form.has_gradient)
        memcpy(c->kept.gradients + c->kept.count * n, k->near.gradients + first_near * n,
               count * n * sizeof *c->kept.gradients);
    c->kept.count += count;
    return 1;
}

static int drain(void *context, void *slot) {
    check *c = context;
    block *k = slot;
    int code = 0;
    size_t near = 0;
    if (k->failed) return message_error("%s", k->error.message), EXIT_INPUT;
    if (results_are_lines(&c->results)) code = results_add_text(&c->results, k->text, k->size);
    free(k->text);
    k->text = NULL;
    for (size_t i = 0; i < k->count && !code; i++) {
        int good = tally_add(&c->tally, &k->answers[i]);
        results_count(&c->results, (exit_code)cell_get_exit(k->answers[i].status));
        if (c->rows && k->first + i < c->listed) good &= keep(c, k, i, near);
        if (!good) return message_error("out of memory"), EXIT_INPUT;
        const report_state state = get_state(c, k, i, near);
        robot_page_add_state(c->page, &c->form, &state);
        near += k->counts[i];
    }
    progress_set(k->first + k->count);
    return code ? code : results_end_units(&c->results, k->count);
}

static void clear(void *slot) {
    block *k = slot;
    ovoid_robot_checker_destroy(k->checker);
    free_list(&k->near);
    free(k->text);
}

// ---- all of them

static void write_table(check *c) {
    size_t near = 0, n = c->form.states->variable_count;
    // The near pairs have their place once all are there.
    for (size_t i = 0; i < c->listed; i++) {
        c->rows[i].near = c->kept.items ? c->kept.items + near : NULL;
        if (c->rows[i].gradients) c->rows[i].gradients = c->kept.gradients + near * n;
        near += c->rows[i].count;
    }
    report_write_table(c->results.file, &c->form, c->rows, c->listed);
}

/// Checks the states from c->next on. 0, or an exit code after a message.
static int check_states(check *c) {
    size_t count = c->form.states->count;
    // A few states are checked sooner than a thread starts.
    cli_pipeline line = {c, sizeof(block), fill, work, drain, clear};
    unsigned threads = pipeline_get_threads(c->settings->threads);
    progress_start("states", count);
    int code = pipeline_run(&line, count <= OVOID_ROBOT_BLOCK ? 1 : threads);
    progress_end();
    if (code < 0) message_error("out of memory or threads"), code = EXIT_INPUT;
    return code;
}

/// Adds the shapes of the links and of the obstacles.
static void add_shapes(shard_digest *digest, const cli_cell *cell) {
    for (size_t i = 0; i < cell->description.element_count; i++) {
        const ovoid_robot_element *element = &cell->description.elements[i];
        shard_digest_add_body(digest, element->shape, element->solid);
    }
    for (size_t i = 0; i < cell->body_count; i++)
        shard_digest_add_body(digest, cell->bodies[i].shape, cell->bodies[i].solid);
}

/// Writes the header of CSV, which is not that of records, where it is due.
static void write_header(check *c) {
    if (c->results.header_due) report_write_csv_header(c->results.file, &c->form);
    c->results.header_due = 0;
}

/// The states of a shard, behind those that an earlier run has written.
static int run_shard(check *c, const cli_command *command, const cli_operands *operands) {
    const settings *s = c->settings;
    size_t count = c->form.states->count;
    c->listed = s->top != TOP_UNSET && s->top && s->top < count ? s->top : count;
    shard_job job = {.command = command,
                     .settings = s,
                     .operands = operands,
                     .part = s->part,
                     .seen = shard_digest_make(),
                     .units = "states"};
    add_shapes(&job.seen, c->form.cell);
    int code = results_open_shard(&c->results, &s->out, 0, &job);
    if (code) return code;
    write_header(c);
    // Whole blocks were written, but for the last one of all.
    uint64_t done = results_get_done(&c->results), blocks = done / OVOID_ROBOT_BLOCK + (done % OVOID_ROBOT_BLOCK > 0);
    size_t first = done < count ? ((size_t)blocks * s->part.count + s->part.index - 1) * OVOID_ROBOT_BLOCK : count;
    c->next = first < count ? first : count;
    code = check_states(c);
    return results_close(&c->results, code);
}

static int run_check(check *c) {
    const settings *s = c->settings;
    double start = progress_get_seconds();
    size_t count = c->form.states->count;
    int is_table = !s->out.json && !s->out.csv;
    size_t most = s->top == TOP_UNSET ? (is_table ? TOP_TABLE : 0) : s->top;
    c->listed = most && most < count ? most : count;
    if (is_table) c->rows = calloc(c->listed + 1, sizeof *c->rows);
    if (is_table && !c->rows) return message_error("out of memory"), EXIT_INPUT;
    if (results_open(&c->results, &s->out, 0, "")) return EXIT_INPUT;
    write_header(c);
    int code = check_states(c);
    if (!code && is_table) write_table(c);
    int worst = tally_get_exit(&c->tally);
    code = results_close(&c->results, code ? code : worst);
    if (code != worst) return code;
    if (c->listed < count) message_note("%zu more states%s", count - c->listed, is_table ? ": --top 0, or --json" : "");
    tally_report(&c->tally, c->form.cell, progress_get_seconds() - start);
    const robot_page_source source = {c->urdf, &s->cell, c->form.cell, c->form.states, NULL, NULL};
    return robot_page_write(c->page, &source) ? EXIT_INPUT : code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.top = TOP_UNSET, .cell.slack = CELL_SLACK};
    cli_operands operands;
    cli_cell cell;
    cli_states states = {.part = {0, 0}};
    int code = command_parse(command, argc, argv, &s, &operands);
    if (code < 0) code = results_settle_part(command, &s.out, s.part);
    if (code < 0) code = page_settle(command, s.html, s.part);
    if (code < 0) code = robot_settle(command, &s.robot);
    if (code < 0) code = states_settle(command, &s.states, &s.cell);
    if (code < 0 && s.part.count && !s.states.path)
        code = args_complain(command, "%s: --shard goes with --states Q.csv", command->name);
    if (code < 0 && s.gradient && s.near == 0)
        code = args_complain(command, "%s: --gradient goes with --near D", command->name);
    if (code >= 0) return code;
    s.cell.robot = &s.robot;
    robot_page page;
    if (robot_page_open(&page, s.html)) return EXIT_INPUT;
    code = cell_open(command, operands.items[0], &s.cell, &cell);
    if (code) return robot_page_close(&page), code;
    states.part = s.part;
    code = states_open(command, &s.states, &cell, &states);
    // Of a shard the first state may be another's.
    if (!code) code = cell_attach(command, &s.cell, s.part.count ? NULL : states.q, &cell);
    if (code) states_close(&states);
    if (!code) {
        cell_tell_held(&cell, &s.cell);
        check c = {.settings = &s,
                   .form = {&cell, &states, s.near > 0, s.gradient},
                   .options = cell_make_options(&s.cell),
                   .page = &page,
                   .urdf = operands.items[0]};
        c.near_options = c.options;
        c.near_options.margin = s.near;
        code = s.part.count ? run_shard(&c, command, &operands) : run_check(&c);
        tally_clear(&c.tally);
        free_list(&c.kept);
        free(c.rows);
        states_close(&states);
    }
    robot_page_close(&page);
    cell_close(&cell);
    return code;
}

const cli_command command_robot_check = {
    .name = "robot check",
    .summary = "states: are they free, what do they hit, what is near",
    .usage = "[OPTION...] ROBOT.urdf --states Q.csv\n[OPTION...] ROBOT.urdf --state STATE",
    .description =
        "Of each state of the robot: free (every pair is proven farther apart than the margin), hit (a pair is within "
        "it, proven, and named with a bracket of its distance), undecided (the side of the margin is not proven: treat "
        "it as a hit), or refused (a variable is outside its limits). Pairs are those of two links that the SRDF does "
        "not disable, and of a link and an obstacle.\n\n"
        "A file of states:\n\n"
        "    shoulder,elbow,floor/x\n"
        "    0.5,-1.2,0\n\n"
        "Joints of several variables have the names of \"ovoid robot info\", \"floor x\", or MoveIt's, \"floor/x\". "
        "Variables that are not given have MoveIt's default, 0, or the middle of the limits where 0 is outside, and a "
        "note says which. States are numbered from 0. A check ends with the first pair that is hit; --near has all.",
    .exits = "0 every state is free\n"
             "1 a state hits\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 a state is undecided or refused; this comes before 1",
    .examples = "ovoid robot check panda.urdf --srdf panda.srdf --states q.csv\n"
                "ovoid robot check panda.urdf --scene cell.yaml --state \"panda_joint4=-1.5\"\n"
                "ovoid robot check arm.urdf --srdf arm.srdf --state home --near 0.1 --gradient",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
