// ovoid robot spheres: do a robot's spheres cover its links, proven; which states do they miss; and spheres that do
// cover.
#include "robot/spheres/spheres.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/outputs.h"
#include "base/progress.h"
#include "robot/commands.h"
#include "robot/xacro.h"

#include <stdlib.h>
#include <string.h>

typedef struct settings {
    cell_settings cell;
    robot_settings robot;
    states_settings states;
    const char *given, *output;
    args_list counts;
    double excess;
    unsigned samples, rounds, seed, cells;
    int json;
} settings;

static const cli_option options[] = {
    {"given", 'g', OPTION_FILE, offsetof(settings, given), "FILE", NULL,
     "the spheres: a URDF whose links have spheres for collision geometry, or an SRDF (default: those of --srdf)"},
    {"count", 'n', OPTION_LIST, offsetof(settings, counts), "N|LINK=N", NULL,
     "find N spheres that cover each link, or the one named; may be given several times (default: as many as are "
     "given)"},
    {"excess", 0, OPTION_POSITIVE, offsetof(settings, excess), "D", NULL,
     "find as few spheres as cover a link so that none stands out of it by more than D, at most --count (default: 64)"},
    {"output", 'o', OPTION_OUTPUT, offsetof(settings, output), "FILE", "urdf|srdf|csv|json",
     "find spheres, and write them: a URDF with spheres in the place of the links' collision geometry, an SRDF, CSV or "
     "JSON"},
    {"rounds", 0, OPTION_COUNT, offsetof(settings, rounds), "N", NULL,
     "moves of a sphere in the search for little volume outside (default: 8000)"},
    {"cells", 0, OPTION_COUNT, offsetof(settings, cells), "N", NULL,
     "into how many cells at most a link's space is divided to measure volumes; more cells narrow them (default: "
     "65536)"},
    {"seed", 0, OPTION_AMOUNT, offsetof(settings, seed), "S", NULL, "of the search and of random states (default: 0)"},
    {"samples", 0, OPTION_COUNT, offsetof(settings, samples), "N", NULL,
     "compare N random states: which do the spheres miss, which do they invent"},
    STATES_OPTIONS(settings),
    CELL_OPTIONS(settings),
    ROBOT_OPTIONS(settings),
    {"json", 0, OPTION_FLAG, offsetof(settings, json), NULL, NULL, "write JSON Lines, one object a line"},
    {.name = NULL},
};

/// Most spheres of a link where --excess says how many, and --count nothing.
enum { COUNT_EXCESS = 64, COUNT_MOST = 4096 };

/// A run.
typedef struct run_state {
    const settings *settings;
    cli_cell cell;
    sphere_set sets[2];
    int set_count;
    sphere_samples samples;
    size_t of_all;   ///< --count N; 0: not given
    size_t *of_link; ///< --count LINK=N
} run_state;

// ---- links

/// How many links have geometry, and which is the next one from `link` on.
static uint32_t find_next_link(const cli_cell *cell, uint32_t link) {
    const ovoid_robot_description *d = &cell->description;
    for (; link < d->link_count; link++)
        for (size_t i = 0; i < d->element_count; i++)
            if (d->elements[i].link == link) return link;
    return OVOID_ROBOT_NONE;
}

static size_t count_links(const cli_cell *cell) {
    size_t count = 0;
    for (uint32_t i = find_next_link(cell, 0); i != OVOID_ROBOT_NONE; i = find_next_link(cell, i + 1)) count++;
    return count;
}

/// The spheres of a link, one after another; NULL after a message where memory is out.
static ovoid_robot_sphere *copy_balls(const sphere_list *list, uint32_t link, size_t *count) {
    size_t first = sphere_list_find(list, link, count);
    ovoid_robot_sphere *balls = malloc((*count + 1) * sizeof *balls);
    if (!balls) return message_error("out of memory"), NULL;
    for (size_t i = 0; i < *count; i++) balls[i] = list->items[first + i].ball;
    return balls;
}

/// Audits each link that has geometry. 0, or EXIT_INPUT after a message.
static int audit(const cli_cell *cell, const ovoid_robot_audit_options *how, sphere_set *set) {
    ovoid_error error;
    size_t links = count_links(cell);
    int good = 1;
    set->rows = calloc(links + 1, sizeof *set->rows);
    if (!set->rows) return message_error("out of memory"), EXIT_INPUT;
    progress_start("links", links);
    for (uint32_t i = find_next_link(cell, 0); i != OVOID_ROBOT_NONE && good; i = find_next_link(cell, i + 1)) {
        sphere_row *row = &set->rows[set->row_count++];
        row->link = i;
        ovoid_robot_sphere *balls = copy_balls(&set->list, i, &row->count);
        good = balls != NULL;
        if (good && row->count)
            good =
                ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){cell->robot.robot, i, balls, row->count},
                                                 how, &row->audit, &error) == OVOID_OK;
        if (!good && balls) message_error("link %s: %s", cell->description.links[i].name, error.message);
        free(balls);
        progress_set(set->row_count);
    }
    progress_end();
    return good ? 0 : EXIT_INPUT;
}

// ---- search

/// How many spheres a link is to have; 0: none are wanted.
static size_t get_count(const run_state *r, uint32_t link) {
    size_t given = 0;
    if (r->of_link[link]) return r->of_link[link];
    if (r->of_all) return r->of_all;
    if (r->settings->excess > 0 && !r->settings->counts.count) return COUNT_EXCESS;
    if (r->set_count && strcmp(r->sets[0].name, "given") == 0) (void)sphere_list_find(&r->sets[0].list, link, &given);
    return given;
}

/// Finds the spheres of one link. 0 after a message.
static int find_spheres(const run_state *r, uint32_t link, size_t count, sphere_list *list) {
    const settings *s = r->settings;
    const char *name = r->cell.description.links[link].name;
    ovoid_robot_cover_options o = {
        .excess = s->excess, .rounds = s->rounds, .seed = s->seed, .watch = progress_make_watch(0)};
    ovoid_error error;
    ovoid_robot_sphere *balls = malloc(count * sizeof *balls);
    if (!balls) return message_error("out of memory"), 0;
    ovoid_robot_sphere_cover cover = {.link = link, .spheres = balls, .capacity = count};
    int good = ovoid_robot_compute_sphere_cover(r->cell.robot.robot, &o, &cover, &error) == OVOID_OK;
    if (!good) message_error("link %s: %s", name, error.message);
    for (size_t i = 0; i < cover.count && good; i++) good = sphere_list_add(list, link, balls[i]);
    free(balls);
    return good;
}

/// Finds spheres for all links that are to have some. 0, or EXIT_INPUT after a message.
static int find_all(const run_state *r, sphere_list *list) {
    const cli_cell *cell = &r->cell;
    size_t done = 0, left_out = 0;
    int good = 1;
    progress_start("links", count_links(cell));
    for (uint32_t i = find_next_link(cell, 0); i != OVOID_ROBOT_NONE && good; i = find_next_link(cell, i + 1)) {
        size_t count = get_count(r, i);
        left_out += !count;
        if (count) good = find_spheres(r, i, count, list);
        progress_set(++done);
    }
    progress_end();
    if (good && left_out) message_warning("%zu links get no spheres, since none are given: --count N", left_out);
    return good ? 0 : EXIT_INPUT;
}

/// Reads --count. 0, or EXIT_USAGE.
static int read_counts(const cli_command *command, run_state *r) {
    const args_list *texts = &r->settings->counts;
    r->of_link = calloc(r->cell.description.link_count + 1, sizeof *r->of_link);
    if (!r->of_link) return message_error("out of memory"), EXIT_INPUT;
    for (int i = 0; i < texts->count; i++) {
        char name[1024], *end;
        const char *equals = strrchr(texts->items[i], '='), *number = equals ? equals + 1 : texts->items[i];
        unsigned long count = strtoul(number, &end, 10);
        if (*number < '0' || *number > '9' || *end || count < 1 || count > COUNT_MOST)
            return args_complain(command, "%s: --count %s: give N or LINK=N, N from 1 to %d", command->name,
                                 texts->items[i], COUNT_MOST);
        if (!equals) {
            r->of_all = count;
            continue;
        }
        snprintf(name, sizeof name, "%.*s", (int)(equals - texts->items[i]), texts->items[i]);
        uint32_t link = ovoid_robot_find_link(r->cell.robot.robot, name);
        if (link == OVOID_ROBOT_NONE)
            return args_complain(command, "%s: --count %s: there is no link %s: \"ovoid robot info\" lists them",
                                 command->name, texts->items[i], name);
        r->of_link[link] = count;
    }
    return 0;
}

// ---- all of it

/// The exit code of a list: proven not to cover 1, else not proven 4.
static int get_exit(const sphere_set *set) {
    int code = 0;
    for (size_t i = 0; i < set->row_count; i++) {
        const sphere_row *row = &set->rows[i];
        if (!row->count || row->audit.depth.lower > 0) return EXIT_TOUCH;
        if (row->audit.depth.upper > 0) code = EXIT_NOT_PROVEN;
    }
    for (int i = 0; i < set->states_count; i++)
        if (set->states[i].found.counts[OVOID_ROBOT_COMPARED_MISSED]) return EXIT_TOUCH;
    return code;
}

static int wants_search(const settings *s) { return s->output || s->counts.count || s->excess > 0; }

/// The lists of spheres: given and found. 0, or an exit code after a message.
static int get_sets(const cli_command *command, run_state *r, const char *urdf) {
    const settings *s = r->settings;
    sphere_set *given = &r->sets[0];
    int code = read_counts(command, r);
    if (!code) code = spheres_read(command, &r->cell, &s->robot, urdf, s->given, &given->list);
    if (code) return code;
    if (given->list.count) given->name = "given", r->set_count = 1;
    if (!r->set_count && !s->counts.count && !(s->excess > 0))
        return args_complain(command, "%s: there are no spheres: --given FILE, an SRDF that has some, or --count N",
                             command->name);
    if (!wants_search(s)) return 0;
    sphere_set *found = &r->sets[r->set_count];
    *found = (sphere_set){.name = "found"};
    code = find_all(r, &found->list);
    r->set_count++;
    return code;
}

static int get_samples(const cli_command *command, run_state *r) {
    const settings *s = r->settings;
    if (s->samples) {
        int code = sphere_samples_draw(&r->samples, &r->cell, s->samples, s->seed);
        if (r->samples.fixed_count)
            message_note("%zu variables have no limits and stay at their default", r->samples.fixed_count);
        return code;
    }
    return states_open(command, &s->states, &r->cell, &r->samples.states);
}

static int has_given_states(const settings *s) { return s->states.path || s->states.request || s->states.texts.count; }

static int work(const cli_command *command, run_state *r, const char *urdf) {
    const settings *s = r->settings;
    int has_states = s->samples || has_given_states(s);
    const ovoid_robot_audit_options how = {.volume_cells = s->cells, .watch = progress_make_watch(0)};
    int code = has_states ? get_samples(command, r) : 0;
    if (!code) code = get_sets(command, r, urdf);
    for (int i = 0; i < r->set_count && !code; i++) {
        code = audit(&r->cell, &how, &r->sets[i]);
        if (!code && has_states) code = spheres_compare(&r->cell, &s->cell, &r->samples, &r->sets[i]);
    }
    if (code) return code;
    sphere_report report = {&r->cell, r->sets, r->set_count, has_states ? &r->samples : NULL, s->robot.parts};
    (s->json ? spheres_write_json : spheres_write_text)(stdout, &report);
    code = finish_file(stdout);
    if (!code && s->output)
        code = spheres_write(s->output, &r->cell, &r->sets[r->set_count - 1].list, urdf, s->robot.srdf);
    return code ? code : get_exit(&r->sets[r->set_count - 1]);
}

static void close_run(run_state *r) {
    for (int i = 0; i < 2; i++) {
        sphere_list_clear(&r->sets[i].list);
        free(r->sets[i].rows);
    }
    states_close(&r->samples.states);
    free(r->of_link);
    cell_close(&r->cell);
}

/// Settles the command line. -1 to go on, or EXIT_USAGE.
static int settle(const cli_command *command, settings *s) {
    static const char *const formats[] = {"urdf", "srdf", "csv", "json"};
    int is_format = !s->output, has_states = has_given_states(s);
    for (int i = 0; i < 4 && s->output; i++) is_format |= outputs_has_extension(s->output, formats[i]);
    if (!is_format)
        return args_complain(command, "%s: --output %s: its name must end in .urdf, .srdf, .csv or .json",
                             command->name, s->output);
    if (s->samples && has_states)
        return args_complain(command, "%s: --samples and given states exclude each other", command->name);
    if (has_states) return states_settle(command, &s->states, &s->cell);
    if (!s->samples && (s->cell.scene || s->cell.margin > 0 || s->cell.slack != CELL_SLACK || s->cell.paddings.count))
        return args_complain(command,
                             "%s: --scene, --padding, --margin and --limit-slack go with --samples N or --states Q.csv",
                             command->name);
    return -1;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.cell.slack = CELL_SLACK};
    cli_operands operands;
    run_state r = {.settings = &s};
    int code = command_parse(command, argc, argv, &s, &operands);
    if (code < 0) code = settle(command, &s);
    if (code < 0 && s.output && outputs_has_extension(s.output, "urdf") && xacro_is_file(operands.items[0]))
        code =
            args_complain(command,
                          "%s: --output %s: a URDF is written with the text of the robot's: expand it first, \"xacro "
                          "FILE > robot.urdf\"",
                          command->name, s.output);
    if (code >= 0) return code;
    s.cell.robot = &s.robot;
    // Spheres are of hulls, and so is what they are compared with.
    s.robot.hull = 1;
    code = cell_open(command, operands.items[0], &s.cell, &r.cell);
    if (code) return code;
    code = work(command, &r, operands.items[0]);
    close_run(&r);
    return code;
}

const cli_command command_robot_spheres = {
    .name = "robot spheres",
    .summary = "spheres of links: do they cover, what do they miss",
    .usage = "[OPTION...] ROBOT.urdf --given SPHERES.urdf\n[OPTION...] ROBOT.urdf --count N -o OUT.urdf",
    .description =
        "Planners put spheres in the place of a robot's links. For each link: how far the deepest point that is in no "
        "sphere is from them all, how much of the link's volume is outside the spheres, and how much of theirs outside "
        "the link, all proven; where two numbers stand, the true one is between them.\n\n"
        "With states: in how many the links hit and the spheres are free (missed), and in how many the links are free "
        "and the spheres hit (invented), each proven; pairs of links (--srdf says which need not be looked at) and "
        "obstacles are counted apart. A mesh counts as its hull, and a warning says so where it is not convex; with "
        "--parts each of its objects does.\n\n"
        "With -o, --count or --excess spheres are found that are proven to cover, with as little volume outside as "
        "the search can do with so many, and both lists are told of.",
    .exits = "0 every link is covered, and no state is missed; of spheres found if any\n"
             "1 a link is not covered, or a state is missed\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written\n"
             "4 a cover is not proven",
    .examples = "ovoid robot spheres panda.urdf --given panda_spherized.urdf\n"
                "ovoid robot spheres panda.urdf --srdf panda.srdf -g balls.urdf --samples 9999\n"
                "ovoid robot spheres panda.urdf --given balls.urdf -o covering.urdf\n"
                "ovoid robot spheres arm.urdf --count 8 --count hand=20 -o arm.srdf",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
