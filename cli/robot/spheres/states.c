// States in which a robot and its model of spheres disagree. Random states: SplitMix64 (G. L. Steele, D. Lea,
// C. H. Flood, Fast splittable pseudorandom number generators, 2014), so the same seed gives the same states
// everywhere.
#include "robot/spheres/spheres.h"

#include "base/message.h"
#include "base/progress.h"
#include "tools/random.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { CHUNK = 4096 };

/// A number for a variable: within its limits; of a continuous joint within a turn; else the default.
static double draw_value(const cli_cell *cell, size_t variable, uint64_t *random) {
    static const double half_turn = 3.141592653589793;
    ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, variable);
    int is_turning = cell->description.joints[v.joint].type == OVOID_JOINT_CONTINUOUS;
    if (is_turning) v.lower = -half_turn, v.upper = half_turn;
    if (!isfinite(v.lower) || !isfinite(v.upper)) return states_get_default(cell, variable);
    double x = v.lower + random_share(random) * (v.upper - v.lower);
    return x < v.upper ? x : v.upper;
}

static size_t count_fixed(const cli_cell *cell) {
    size_t count = 0;
    for (size_t i = 0; i < ovoid_robot_get_variable_count(cell->robot.robot); i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, i);
        int is_turning = cell->description.joints[v.joint].type == OVOID_JOINT_CONTINUOUS;
        count += !is_turning && (!isfinite(v.lower) || !isfinite(v.upper));
    }
    return count;
}

int sphere_samples_draw(sphere_samples *samples, const cli_cell *cell, unsigned count, unsigned seed) {
    size_t n = ovoid_robot_get_variable_count(cell->robot.robot);
    uint64_t random = seed;
    *samples = (sphere_samples){.is_random = 1, .seed = seed, .fixed_count = count_fixed(cell)};
    double *q = calloc(count, (n ? n : 1) * sizeof *q);
    if (!q) return message_error("out of memory for %u states", count), EXIT_INPUT;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < n; k++) q[i * n + k] = draw_value(cell, k, &random);
    samples->states = (cli_states){.q = q, .count = count, .variable_count = n, .stored = count, .capacity = count};
    return 0;
}

// ---- the model

/// A robot of spheres among the same obstacles.
typedef struct model {
    ovoid_robot *robot;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checkers[2]; ///< of the robot and of the model
} model;

static void close_model(model *m) {
    ovoid_robot_checker_destroy(m->checkers[0]);
    ovoid_robot_checker_destroy(m->checkers[1]);
    ovoid_robot_cell_destroy(m->cell);
    ovoid_robot_destroy(m->robot);
}

static int open_model(model *m, const cli_cell *cell, const cell_settings *settings, const sphere_list *list) {
    ovoid_error error;
    *m = (model){.robot = ovoid_robot_create_from_spheres(
                     cell->robot.robot, &(ovoid_robot_link_spheres){list->items, list->count}, NULL, &error)};
    if (m->robot) m->cell = ovoid_robot_cell_create(m->robot, NULL, &error);
    int good = m->cell != NULL;
    if (good && cell->obstacles)
        good = ovoid_robot_cell_add_obstacles(m->cell, cell->obstacles, NULL, &error) == OVOID_OK;
    // The options' paddings are in the robot's cell already, so they are right.
    if (good) good = cell_set_paddings(NULL, cell, m->cell, &settings->paddings) == 0;
    if (good) m->checkers[0] = ovoid_robot_checker_create(cell->cell, NULL, &error);
    if (m->checkers[0]) m->checkers[1] = ovoid_robot_checker_create(m->cell, NULL, &error);
    if (m->checkers[1]) return 1;
    message_error("the robot of spheres: %s", error.message);
    close_model(m);
    return 0;
}

/// Compares all states by one kind of pairs. 0 after a message.
static int compare(const model *m, const sphere_samples *samples, const ovoid_robot_query_options *o,
                   ovoid_robot_comparison *found) {
    ovoid_error error;
    const cli_states *s = &samples->states;
    progress_start("states", s->count);
    int good = 1;
    for (size_t i = 0; i < s->count && good; i += CHUNK) {
        size_t count = s->count - i < CHUNK ? s->count - i : CHUNK;
        ovoid_robot_comparison_batch batch = {
            m->checkers[0], m->checkers[1], s->q + i * s->variable_count, count, o, NULL};
        good = ovoid_robot_compare_states(&batch, found, &error) == OVOID_OK;
        progress_set(i + count);
    }
    progress_end();
    if (!good) message_error("%s", error.message);
    return good;
}

int spheres_compare(const cli_cell *cell, const cell_settings *settings, const sphere_samples *samples,
                    sphere_set *set) {
    static const char *const names[] = {"links", "obstacles"};
    model m;
    if (!open_model(&m, cell, settings, &set->list)) return EXIT_INPUT;
    int good = 1, kinds = cell->obstacles ? 2 : 1;
    for (set->states_count = 0; set->states_count < kinds && good; set->states_count++) {
        ovoid_robot_query_options o = cell_make_options(settings);
        o.without_obstacles = set->states_count == 0;
        o.without_self = set->states_count == 1;
        sphere_states *states = &set->states[set->states_count];
        *states = (sphere_states){.pairs = names[set->states_count]};
        good = compare(&m, samples, &o, &states->found);
    }
    close_model(&m);
    return good ? 0 : EXIT_INPUT;
}
