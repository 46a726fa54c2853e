// `bench --robot`.
#include "robots/robots.h"

#include "common/build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

robots_plan robots_plan_make(void) { return (robots_plan){700, 256, 1, 10, 10000, 0, NULL, NULL}; }

robots_plan robots_plan_make_smoke(void) { return (robots_plan){1, 2, 1, 2, 50, 10, NULL, NULL}; }

static int load_all(robots_field *all, const char *const *modules, uint32_t count, int alone) {
    static const struct { const char *name, *path; } built[] = {OVOID_BENCH_ROBOT_MODULES{"", ""}};
    for (size_t i = 0; !alone && i + 1 < sizeof built / sizeof built[0]; i++) {
        if (built[i].path[0])
            (void)robots_field_load(all, built[i].path);
        else
            printf("without %s: it was not found when this was built\n", built[i].name);
    }
    for (uint32_t i = 0; i < count; i++)
        if (!robots_field_load(all, modules[i])) return 0;
    return 1;
}

// ---- a machine

static int run_scene(robots_run *run, const robots_field *who, uint32_t index) {
    robots_scene s;
    if (!robots_scene_create(&s, run->machine, index)) return 0;
    rival rivals[ROBOT_PEERS_MOST];
    uint32_t count = 0;
    for (uint32_t i = 0; i < who->count; i++) {
        // The contestants begin in turn.
        const robot_peer *one = who->peers[(i + index) % who->count];
        void *self = one->create(&s.what);
        if (self) rivals[count++] = (rival){one, self};
    }
    robots_run_states(run, &s, rivals, count);
    robots_run_edges(run, &s, rivals, count);
    robots_run_monitor(run, &s, rivals, count);
    for (uint32_t i = 0; i < count; i++) rivals[i].who->destroy(rivals[i].self);
    robots_scene_destroy(&s, run->machine);
    return 1;
}

/// A title that lives as long as rows point to it.
static const char *make_title(const machine *m, const char *what) {
    enum { TITLES = 128 };
    static char titles[TITLES][128];
    static uint32_t count;
    char *title = titles[count < TITLES - 1 ? count++ : count];
    (void)snprintf(title, sizeof titles[0], "%.63s: %.60s", m->name, what);
    return title;
}

static void report(robots_run *run, rows *all, double obstacles) {
    static const char *const edges[2][3] = {
        {"free edges, 0.1 of the range", "free edges, 0.5 of the range", "free edges, all of the range"},
        {"edges that hit, 0.1 of the range", "edges that hit, 0.5 of the range", "edges that hit, all of the range"}};
    const machine *m = run->machine;
    tallies_report(&run->free_states, all, make_title(m, "random states, free"), "ns", obstacles);
    tallies_report(&run->hit_states, all, make_title(m, "random states, hits"), "ns", obstacles);
    tallies_report(&run->along, all, make_title(m, "states along free edges"), "ns", obstacles);
    tallies_report(&run->covers, all, make_title(m, "covers of a cell, made by its first edge"), "us", obstacles);
    for (int k = 0; k < 3; k++) {
        tallies_report(&run->edges[k], all, make_title(m, edges[0][k]), "us", obstacles);
        tallies_report(&run->hit_edges[k], all, make_title(m, edges[1][k]), "us", obstacles);
    }
    double cycles = run->monitor.count ? run->monitor.items[0].count : 1;
    tallies_report(&run->monitor, all, make_title(m, "monitor, all pairs within 0.2 m"), "us", obstacles);
    printf("%38s %.1f pairs a cycle\n", "", run->near / fmax(cycles, 1));
}

static void run_matrix(robots_run *run, rows *all) {
    double start = get_own_seconds();
    // With many links the proofs of nearly two thousand pairs would dominate the time.
    size_t budget = run->machine->link_count > 40 ? 100 : run->plan->budget;
    ovoid_robot_matrix_options options = {.samples = run->plan->samples, .budget = budget};
    ovoid_robot_matrix *matrix = ovoid_robot_matrix_create(run->machine->robot, &options, NULL);
    double time = get_own_seconds() - start;
    run->wrong += !matrix;
    ovoid_robot_matrix_destroy(matrix);
    char what[64];
    (void)snprintf(what, sizeof what, "allowed pairs from %zu states", run->plan->samples);
    rows_add(all, (row){make_title(run->machine, what), "links", "s", "ovoid", run->machine->link_count,
                        timing_make(&time, 1), 0, 0});
}

static double count_obstacles(machine *m) {
    robots_scene s;
    if (!robots_scene_create(&s, m, 0)) return 0;
    double count = s.what.obstacle_count;
    robots_scene_destroy(&s, m);
    return count;
}

static int run_machine(machine *m, const robots_plan *plan, const robots_field *rivals, rows *all, double *wrong) {
    static robots_run run;
    run = (robots_run){.machine = m, .plan = plan};
    uint32_t scenes = machine_count_scenes(m);
    // If not all scenes are used, they are spread over all of them.
    uint32_t count = scenes < plan->scenes ? scenes : plan->scenes;
    double obstacles = count_obstacles(m);
    printf("\n%s: %u links with %u solids, %u variables, %u of %u scenes\n", m->name, m->link_count, m->element_count,
           m->variable_count, count, scenes);
    for (uint32_t i = 0; i < count; i++)
        if (!run_scene(&run, rivals, (uint32_t)((uint64_t)i * scenes / count))) return 0;
    report(&run, all, obstacles);
    run_matrix(&run, all);
    printf("\n%s: %.0f free states, %.0f hits; judged by checked proofs %.0f, open %.0f. Wrong: %.0f\n", m->name,
           run.states_free, run.states_hit, run.judged, run.open, run.wrong);
    *wrong += run.wrong;
    return 1;
}

// ---- all machines

static const machine_files files[] = {
    {"panda", "panda_mbm/panda.urdf", "panda_mbm/panda.srdf", "panda/mbm_problems.tar.bz2"},
    {"fetch", "fetch_mbm/fetch.urdf", "fetch_mbm/fetch.srdf", "fetch_mbm/problems.tar.bz2"},
    {"anymal", "anymal_b/robots/anymal.urdf", "anymal_b/srdf/anymal.srdf", NULL},
    {"solo12", "solo12/robots/solo12.urdf", "solo12/srdf/solo.srdf", NULL},
    {"allegro", "allegro_hand/urdf/allegro_right_hand.urdf", NULL, NULL},
};

static int is_wanted(const robots_plan *plan, const char *name) { return !plan->only || strstr(name, plan->only); }

static int run_file(const robots_plan *plan, const robots_field *rivals, const machine_files *f, rows *all,
                    double *wrong) {
    machine m;
    if (!machine_read(&m, plan->data, f)) return 1;
    int good = run_machine(&m, plan, rivals, all, wrong);
    machine_destroy(&m);
    return good;
}

static int run_pair(const robots_plan *plan, const robots_field *rivals, rows *all, double *wrong) {
    machine one, two;
    machine_files alone = files[0];
    alone.problems = NULL;
    if (!machine_read(&one, plan->data, &alone)) return 1;
    int good = machine_make_pair(&two, &one);
    if (good) {
        good = run_machine(&two, plan, rivals, all, wrong);
        machine_destroy(&two);
    }
    machine_destroy(&one);
    return good;
}

static int run_snake(const robots_plan *plan, const robots_field *rivals, rows *all, double *wrong) {
    machine m;
    if (!machine_make_snake(&m, 60)) return 0;
    int good = run_machine(&m, plan, rivals, all, wrong);
    machine_destroy(&m);
    return good;
}

int robots_run_all(const robots_plan *plan, const char *const *modules, uint32_t module_count, const char *csv,
                   const char *svg, int alone) {
    static rows all;
    robots_field rivals = {.count = 0};
    double wrong = 0;
    printf("%s\n", get_build());
    if (!load_all(&rivals, modules, module_count, alone)) return 0;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (is_wanted(plan, files[i].name) && !run_file(plan, &rivals, &files[i], &all, &wrong)) return 0;
    if (is_wanted(plan, "two of panda") && !run_pair(plan, &rivals, &all, &wrong)) return 0;
    if (is_wanted(plan, "snake") && !run_snake(plan, &rivals, &all, &wrong)) return 0;
    printf("\nWrong: %.0f\n", wrong);
    if (wrong > 0) return 0;
    return (!csv || rows_write_csv(&all, csv)) && (!svg || rows_write_svg(&all, svg));
}
