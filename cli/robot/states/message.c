// States from messages of MoveIt and ROS: a planning request, a trajectory.
#include "robot/states/reader.h"

#include "base/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- requests

/// The numbers that a request gives; `state` has those that it does not.
static int read_positions(reader *r, const ovoid_joint_position *items, size_t count, double *state) {
    memset(r->given, 0, r->states->variable_count);
    for (size_t i = 0; i < count; i++) {
        uint32_t variable = reader_take_variable(r, items[i].joint);
        if (variable == OVOID_ROBOT_NONE) return 0;
        if (variable < COLUMN_FOLLOWS) state[variable] = items[i].position;
    }
    return 1;
}

/// The start and each goal, in which joints that it does not name stay where the start has them.
static int read_all_positions(reader *r, const ovoid_motion_request *request, const char *path) {
    size_t count, goals = ovoid_motion_request_get_goal_count(request), n = r->states->variable_count;
    for (size_t i = 0; i <= goals; i++) {
        const ovoid_joint_position *items =
            i ? ovoid_motion_request_get_goal(request, i - 1, &count) : ovoid_motion_request_get_start(request, &count);
        double *state = reader_add_state(r);
        if (!state) return EXIT_INPUT;
        if (i && n) memcpy(state, r->states->q, n * sizeof *state);
        if (!read_positions(r, items, count, state)) {
            message_error("%s: %s: %s", path, i ? "goal_constraints" : "start_state", r->why);
            return EXIT_INPUT;
        }
        if (!i) reader_report_missing(r, path);
    }
    return 0;
}

int reader_read_request(reader *r, const char *path) {
    ovoid_error error;
    // The notes are shown as those of the robot are, and only here.
    cli_robot notes = {.note_count = 0};
    const ovoid_robot_read_options options = {.note = robot_warn, .context = &notes};
    r->takes_fixed = 1;
    ovoid_motion_request *request = ovoid_motion_request_read(path, &options, &error);
    if (!request) return message_error("%s", error.message), EXIT_INPUT;
    size_t goals = ovoid_motion_request_get_goal_count(request);
    const char *group = ovoid_motion_request_get_group(request);
    message_note("%s: state 0 is the start%s%s%s; of goals the positions are used, not their tolerances; what tells a "
                 "planner how to search is not used",
                 path,
                 goals == 1 ? ", state 1 the goal"
                 : goals    ? ", the others are the goals"
                            : "; there is no goal",
                 *group ? "; group: " : "", group);
    int code = read_all_positions(r, request, path);
    ovoid_motion_request_destroy(request);
    return code;
}

// ---- trajectories

/// The variables of the joints of a point. The points of a trajectory share their names, which are looked up once.
typedef struct point_variables {
    uint32_t *items;
    size_t count;
    const ovoid_joint_position *of; ///< the point that was looked up
} point_variables;

static int are_names(const point_variables *v, const ovoid_joint_position *point, size_t count) {
    if (!v->of || v->count != count) return 0;
    for (size_t i = 0; i < count; i++)
        if (v->of[i].joint != point[i].joint) return 0;
    return 1;
}

/// 0 with r->why filled.
static int find_variables(reader *r, const ovoid_joint_position *point, size_t count, point_variables *v) {
    if (are_names(v, point, count)) return 1;
    uint32_t *items = realloc(v->items, (count + 1) * sizeof *items);
    if (!items) return snprintf(r->why, WHY_ROOM, "out of memory"), 0;
    v->items = items;
    memset(r->given, 0, r->states->variable_count);
    for (size_t i = 0; i < count; i++)
        if ((v->items[i] = reader_take_variable(r, point[i].joint)) == OVOID_ROBOT_NONE) return 0;
    v->of = point;
    v->count = count;
    return 1;
}

/// The state in which the trajectory begins; joints that a point does not name stay there. 0 with r->why filled.
static int read_start(reader *r, const ovoid_trajectory *trajectory, point_variables *v) {
    size_t count;
    const ovoid_joint_position *start = ovoid_trajectory_get_start(trajectory, &count);
    if (!find_variables(r, start, count, v)) return 0;
    for (size_t i = 0; i < count; i++)
        if (v->items[i] < COLUMN_FOLLOWS) r->defaults[v->items[i]] = start[i].position;
    v->of = NULL;
    return 1;
}

/// Adds a point, behind which the defaults are its numbers. 0, or an exit code after a message.
static int add_point(reader *r, const ovoid_trajectory *trajectory, size_t number, const point_variables *v) {
    size_t count;
    const ovoid_joint_position *point = ovoid_trajectory_get_point(trajectory, number, &count);
    for (size_t i = 0; i < count; i++)
        if (v->items[i] < COLUMN_FOLLOWS) r->defaults[v->items[i]] = point[i].position;
    if (!shard_part_has(r->states->part, r->states->count / OVOID_ROBOT_BLOCK)) return r->states->count++, 0;
    if (!reader_add_state(r)) return EXIT_INPUT;
    if (r->has_time) r->states->times[r->states->stored - 1] = ovoid_trajectory_get_time(trajectory, number);
    return 0;
}

/// Marks what the start or the first point gives, and says what neither does.
static void report_first(reader *r, const char *path, const unsigned char *in_start) {
    for (size_t i = 0; i < r->states->variable_count; i++) r->given[i] |= in_start[i];
    reader_report_missing(r, path);
}

static int read_points(reader *r, const ovoid_trajectory *trajectory, const char *path, point_variables *v) {
    size_t n = r->states->variable_count, count, points = ovoid_trajectory_get_count(trajectory);
    unsigned char *in_start = malloc(n + 1);
    if (!in_start) return message_error("out of memory"), EXIT_INPUT;
    int code = 0, is_good = read_start(r, trajectory, v);
    if (!is_good) message_error("%s: trajectory_start: %s", path, r->why), code = EXIT_INPUT;
    memcpy(in_start, r->given, n);
    for (size_t i = 0; i < points && !code; i++) {
        const ovoid_joint_position *point = ovoid_trajectory_get_point(trajectory, i, &count);
        if (!find_variables(r, point, count, v)) {
            message_error("%s:%lld: %s", path, (long long)ovoid_trajectory_get_line(trajectory, i), r->why);
            code = EXIT_INPUT;
            break;
        }
        if (!i) report_first(r, path, in_start);
        code = add_point(r, trajectory, i, v);
    }
    free(in_start);
    return code;
}

int reader_read_trajectory(reader *r, const char *path) {
    ovoid_error error;
    cli_robot notes = {.note_count = 0};
    point_variables v = {NULL, 0, NULL};
    const ovoid_robot_read_options options = {.note = robot_warn, .context = &notes};
    ovoid_trajectory *trajectory = ovoid_trajectory_read(path, &options, &error);
    if (!trajectory) return message_error("%s", error.message), EXIT_INPUT;
    r->takes_fixed = 1;
    r->has_time = !isnan(ovoid_trajectory_get_time(trajectory, 0));
    int code = read_points(r, trajectory, path, &v);
    free(v.items);
    ovoid_trajectory_destroy(trajectory);
    return code;
}
