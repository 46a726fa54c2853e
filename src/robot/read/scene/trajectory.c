// Trajectories in YAML, of which JSON is a part: moveit_msgs/RobotTrajectory, moveit_msgs/DisplayTrajectory,
// trajectory_msgs/JointTrajectory, messages that hold one of them as their "trajectory", and one
// sensor_msgs/JointState. Several trajectories follow one another, as MoveIt shows them. Cost: linear in the file.
#include "robot/read/scene/positions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct trajectory_point {
    position_list positions;
    double time; ///< seconds from the start; NAN: none is given
    int64_t line;
    int is_first; ///< of its trajectory
} trajectory_point;

struct ovoid_trajectory {
    pool memory;
    position_list start;
    trajectory_point *points;
    size_t count, capacity;
    int has_times;
};

/// The state of reading: what is read, and the time at which the trajectory at hand begins.
typedef struct trajectory_reader {
    message_reader message;
    ovoid_trajectory *out;
    double begin;
    size_t first; ///< the number of its first point
} trajectory_reader;

static const ovoid_robot_read_options no_options;

/// A trajectory that begins farther than this from its trajectory_start, in radians or metres, is told of: MoveIt's
/// default of allowed_start_tolerance.
static const double start_tolerance = 0.01;

// ---- points

// A duration in seconds: {secs, nsecs}, {sec, nanosec}, or a number; NULL: not given.
static ovoid_code read_seconds(const message_reader *r, const yaml_value *value, double *seconds) {
    static const char *const keys[2][2] = {{"secs", "nsecs"}, {"sec", "nanosec"}};
    double parts[2] = {0, 0};
    *seconds = NAN;
    if (!value) return OVOID_OK;
    ovoid_code code = value->kind == YAML_MAP ? message_refuse_others(r, value, "secs|nsecs|sec|nanosec")
                                              : message_read_number(r, value, &parts[0]);
    for (int i = 0; i < 4 && !code && value->kind == YAML_MAP; i++) {
        const yaml_value *part = NULL;
        code = message_find(r, value, keys[i / 2][i % 2], &part);
        if (!code && part) code = message_read_number(r, part, &parts[i % 2]);
    }
    *seconds = parts[0] + 1e-9 * parts[1];
    if (code) return code;
    if (parts[0] < 0)
        return message_fail(r, value, OVOID_ERROR_FORMAT, "time_from_start is below zero: %.9g s", parts[0]);
    if (!(parts[1] >= 0 && parts[1] < 1e9))
        return message_fail(r, value, OVOID_ERROR_FORMAT, "%.9g nanoseconds are not between 0 and 999999999", parts[1]);
    return OVOID_OK;
}

static ovoid_code add_point(trajectory_reader *t, const yaml_value *at, const trajectory_point *point) {
    ovoid_trajectory *o = t->out;
    if (!array_reserve((void **)&o->points, &o->capacity, o->count, sizeof *o->points))
        return io_fail_memory(t->message.error, t->message.path);
    int has_time = !isnan(point->time);
    if (o->count && has_time != !isnan(o->points[0].time))
        return message_fail(&t->message, at, OVOID_ERROR_FORMAT,
                            "this point has %s time_from_start, unlike the first one", has_time ? "a" : "no");
    o->points[o->count++] = *point;
    return OVOID_OK;
}

// names: of the joints, in the order of the numbers.
static ovoid_code read_point(trajectory_reader *t, const yaml_value *value, const char *const *names, size_t count) {
    const message_reader *r = &t->message;
    const yaml_value *positions = NULL, *time = NULL;
    trajectory_point point = {.line = value->line, .is_first = t->out->count == t->first};
    ovoid_code code = message_refuse_others(r, value, "positions|velocities|accelerations|effort|time_from_start");
    if (!code) code = message_find_kind(r, value, "positions", YAML_LIST, &positions);
    if (!code) code = message_find(r, value, "time_from_start", &time);
    if (!code && (positions ? positions->count : 0) != count)
        code = message_fail(r, value, OVOID_ERROR_FORMAT, "a point has %zu positions for %zu joints",
                            positions ? positions->count : 0, count);
    if (!code) code = read_seconds(r, time, &point.time);
    point.time += t->begin;
    if (!code) code = position_list_make(r, count, &point.positions);
    const yaml_value *number = positions ? positions->first : NULL;
    for (size_t i = 0; i < count && !code; i++, number = number->next)
        code = position_list_add(r, names[i], number, &point.positions);
    return code ? code : add_point(t, value, &point);
}

// ---- trajectories

static ovoid_code read_names(const message_reader *r, const yaml_value *list, const char ***names) {
    size_t count = 0;
    *names = pool_get(r->memory, list ? list->count : 0, sizeof **names);
    ovoid_code code = *names ? OVOID_OK : io_fail_memory(r->error, r->path);
    for (const yaml_value *v = list ? list->first : NULL; v && !code; v = v->next)
        code = position_list_copy_name(r, v, &(*names)[count++]);
    return code;
}

// trajectory_msgs/JointTrajectory. It begins where the one before ended.
static ovoid_code read_joint_trajectory(trajectory_reader *t, const yaml_value *value) {
    const message_reader *r = &t->message;
    const yaml_value *list = NULL, *points = NULL;
    const char **names = NULL;
    ovoid_code code = message_refuse_others(r, value, "header|joint_names|points");
    if (!code) code = message_find_kind(r, value, "joint_names", YAML_LIST, &list);
    if (!code) code = message_find_kind(r, value, "points", YAML_LIST, &points);
    if (!code) code = read_names(r, list, &names);
    t->first = t->out->count;
    if (t->first && !isnan(t->out->points[t->first - 1].time)) t->begin = t->out->points[t->first - 1].time;
    for (const yaml_value *v = points ? points->first : NULL; v && !code; v = v->next)
        code = read_point(t, v, names, list ? list->count : 0);
    return code;
}

// Joints of several variables are refused by their name.
static ovoid_code refuse_multiple(const message_reader *r, const yaml_value *value) {
    const yaml_value *map = NULL, *names = NULL;
    ovoid_code code = message_find_kind(r, value, "multi_dof_joint_trajectory", YAML_MAP, &map);
    if (!code && map) code = message_find_kind(r, map, "joint_names", YAML_LIST, &names);
    if (code || !names || !names->first) return code;
    return message_fail(r, names, OVOID_ERROR_FORMAT,
                        "multi_dof_joint_trajectory moves joint \"%.60s\", which has several variables: such points "
                        "are not read; write the states as CSV",
                        names->first->text);
}

// moveit_msgs/RobotTrajectory, or a JointTrajectory in its place.
static ovoid_code read_trajectory(trajectory_reader *t, const yaml_value *value) {
    const message_reader *r = &t->message;
    const yaml_value *joints = NULL, *points = NULL;
    ovoid_code code = message_find(r, value, "points", &points);
    if (code || points) return code ? code : read_joint_trajectory(t, value);
    code = message_refuse_others(r, value, "joint_trajectory|multi_dof_joint_trajectory");
    if (!code) code = refuse_multiple(r, value);
    if (!code) code = message_find_kind(r, value, "joint_trajectory", YAML_MAP, &joints);
    return code || !joints ? code : read_joint_trajectory(t, joints);
}

// A message that holds a trajectory or a list of them, and perhaps the state in which the first begins.
static ovoid_code read_holder(trajectory_reader *t, const yaml_value *root, const yaml_value *held) {
    const message_reader *r = &t->message;
    const yaml_value *start = NULL;
    ovoid_code code =
        message_refuse_others(r, root,
                              "trajectory|trajectory_start|model_id|group_name|planning_time|error_code|path_tolerance|"
                              "component_path_tolerance|goal_tolerance|component_goal_tolerance|goal_time_tolerance|"
                              "multi_dof_trajectory|controller_names");
    if (!code) code = message_refuse_filled(r, root, "multi_dof_trajectory", "is not read; write the states as CSV");
    if (!code) code = message_find_kind(r, root, "trajectory_start", YAML_MAP, &start);
    if (!code && start) code = position_list_read_state(r, start, "a trajectory", &t->out->start);
    if (code || held->kind == YAML_MAP) return code ? code : read_trajectory(t, held);
    for (const yaml_value *v = held->first; v && !code; v = v->next) code = read_trajectory(t, v);
    return code;
}

// sensor_msgs/JointState: one point.
static ovoid_code read_joint_state(trajectory_reader *t, const yaml_value *root) {
    trajectory_point point = {.time = NAN, .line = root->line};
    ovoid_code code = position_list_read_joints(&t->message, root, &point.positions);
    return code ? code : add_point(t, root, &point);
}

static ovoid_code read_root(trajectory_reader *t, const yaml_value *root) {
    const message_reader *r = &t->message;
    const yaml_value *held = NULL, *own = NULL, *positions = NULL;
    ovoid_code code = root->kind == YAML_MAP
                          ? OVOID_OK
                          : message_fail(r, root, OVOID_ERROR_FORMAT, "there is no map: this is no trajectory");
    if (!code) code = message_find(r, root, "trajectory", &held);
    if (!code) code = message_find(r, root, "joint_trajectory", &own);
    if (!code && !own) code = message_find(r, root, "multi_dof_joint_trajectory", &own);
    if (!code && !own) code = message_find(r, root, "points", &own);
    if (!code) code = message_find(r, root, "position", &positions);
    if (code) return code;
    if (held) return read_holder(t, root, held);
    if (own) return read_trajectory(t, root);
    if (positions) return read_joint_state(t, root);
    return message_fail(r, root, OVOID_ERROR_FORMAT,
                        "no trajectory: there is neither \"joint_trajectory\" (RobotTrajectory), \"trajectory\" "
                        "(DisplayTrajectory), \"points\" (JointTrajectory) nor \"position\" (JointState)");
}

// ---- where one trajectory ends and the next one begins

/// Where the joints stand, as far as the file has told it.
typedef struct known_joints {
    name_index names;
    double *positions; ///< by the names' indices; NAN: not told yet
} known_joints;

static void add_names(known_joints *known, const position_list *list) {
    for (size_t i = 0; i < list->count; i++, known->names.count++)
        known->names.entries[known->names.count] = (name_entry){list->items[i].joint, (uint32_t)known->names.count};
}

static void set_positions(known_joints *known, const position_list *list) {
    for (size_t i = 0; i < list->count; i++)
        known->positions[name_index_find(&known->names, list->items[i].joint)] = list->items[i].position;
}

// The names of the start and of every trajectory.
static ovoid_code make_known(trajectory_reader *t, known_joints *known) {
    const ovoid_trajectory *o = t->out;
    pool *scratch = &t->message.scratch;
    size_t count = o->start.count;
    for (size_t i = 0; i < o->count; i++) count += o->points[i].is_first ? o->points[i].positions.count : 0;
    *known = (known_joints){.names.entries = pool_get(scratch, count, sizeof *known->names.entries),
                            .positions = pool_get(scratch, count, sizeof *known->positions)};
    if (!known->names.entries || !known->positions) return io_fail_memory(t->message.error, t->message.path);
    add_names(known, &o->start);
    for (size_t i = 0; i < o->count; i++)
        if (o->points[i].is_first) add_names(known, &o->points[i].positions);
    (void)name_index_sort(&known->names); // joints of several trajectories
    for (size_t i = 0; i < count; i++) known->positions[i] = NAN;
    set_positions(known, &o->start);
    return OVOID_OK;
}

// Refuses a point at which a joint is elsewhere at the same time.
static ovoid_code compare_point(const message_reader *r, const known_joints *known, const trajectory_point *point) {
    const yaml_value at = {.line = point->line};
    for (size_t i = 0; i < point->positions.count; i++) {
        const ovoid_joint_position *joint = &point->positions.items[i];
        double before = known->positions[name_index_find(&known->names, joint->joint)];
        if (before == joint->position) continue;
        if (isnan(before))
            return message_fail(r, &at, OVOID_ERROR_FORMAT,
                                "a later trajectory begins at time 0 with joint \"%.60s\" at %.9g, and nothing says "
                                "where it was before: name it in trajectory_start",
                                joint->joint, joint->position);
        return message_fail(r, &at, OVOID_ERROR_FORMAT,
                            "a later trajectory begins at time 0 with joint \"%.60s\" at %.9g, where the one before "
                            "ended with %.9g: no time is left for the way",
                            joint->joint, joint->position, before);
    }
    return OVOID_OK;
}

// A trajectory that begins at its time 0 repeats the state in which the one before ended: one point is enough.
static ovoid_code join_trajectories(trajectory_reader *t) {
    ovoid_trajectory *o = t->out;
    known_joints known;
    size_t kept = 0;
    ovoid_code code = o->has_times ? make_known(t, &known) : OVOID_OK;
    if (code || !o->has_times) return code;
    for (size_t i = 0; i < o->count && !code; i++) {
        const trajectory_point point = o->points[i];
        int is_last = i + 1 == o->count || o->points[i + 1].is_first;
        int is_repeated = i && point.is_first && point.time == o->points[i - 1].time;
        if (is_repeated) code = compare_point(&t->message, &known, &point);
        if (!is_repeated) o->points[kept++] = point;
        if (is_last) set_positions(&known, &point.positions);
    }
    o->count = kept;
    return code;
}

// ---- what all faces want of a trajectory

// Times rise: a path in time goes forwards.
static ovoid_code check_times(const trajectory_reader *t) {
    const trajectory_point *points = t->out->points;
    for (size_t i = 1; i < t->out->count && t->out->has_times; i++) {
        if (points[i].time > points[i - 1].time) continue;
        return message_fail(&t->message, &(yaml_value){.line = points[i].line}, OVOID_ERROR_FORMAT,
                            "point %zu: its time, %.9g s, is not after that of the point before, %.9g s", i,
                            points[i].time, points[i - 1].time);
    }
    return OVOID_OK;
}

// Tells of the first joint that is elsewhere in the first point than in the state in which the trajectory is said to
// begin.
static ovoid_code compare_start(trajectory_reader *t) {
    const position_list *start = &t->out->start, *first = &t->out->points[0].positions;
    known_joints known = {.names.entries = pool_get(&t->message.scratch, start->count, sizeof *known.names.entries)};
    if (!known.names.entries) return io_fail_memory(t->message.error, t->message.path);
    add_names(&known, start);
    (void)name_index_sort(&known.names);
    for (size_t i = 0; i < first->count; i++) {
        const ovoid_joint_position *joint = &first->items[i];
        uint32_t number = name_index_find(&known.names, joint->joint);
        if (number == UINT32_MAX || fabs(joint->position - start->items[number].position) <= start_tolerance) continue;
        message_note(&t->message, &(yaml_value){.line = t->out->points[0].line},
                     "%.60s is %.9g in trajectory_start, %.9g in the first point: the way between is not checked",
                     joint->joint, start->items[number].position, joint->position);
        break;
    }
    return OVOID_OK;
}

// Without times where none is given, or all are 0: the path was not given a speed.
static void settle_times(ovoid_trajectory *o) {
    for (size_t i = 0; i < o->count; i++) o->has_times |= o->points[i].time != 0;
    if (o->count && isnan(o->points[0].time)) o->has_times = 0;
}

ovoid_trajectory *ovoid_trajectory_read(const char *path, const ovoid_robot_read_options *options, ovoid_error *error) {
    ovoid_trajectory *trajectory = calloc(1, sizeof *trajectory);
    if (!trajectory) {
        (void)io_fail_memory(error, path);
        return NULL;
    }
    trajectory_reader t = {.message = {.path = path,
                                       .options = options ? options : &no_options,
                                       .error = error,
                                       .memory = &trajectory->memory},
                           .out = trajectory};
    yaml_value *root;
    ovoid_code code = yaml_read(path, &t.message.scratch, &root, error);
    if (!code) code = read_root(&t, root);
    if (!code && !trajectory->count)
        code = message_fail(&t.message, root, OVOID_ERROR_EMPTY, "the trajectory has no points");
    settle_times(trajectory);
    if (!code) code = join_trajectories(&t);
    if (!code) code = check_times(&t);
    if (!code) code = compare_start(&t);
    pool_clear(&t.message.scratch);
    if (!code) return trajectory;
    ovoid_trajectory_destroy(trajectory);
    return NULL;
}

void ovoid_trajectory_destroy(ovoid_trajectory *trajectory) {
    if (!trajectory) return;
    pool_clear(&trajectory->memory);
    free(trajectory->points);
    free(trajectory);
}

const ovoid_joint_position *ovoid_trajectory_get_start(const ovoid_trajectory *trajectory, size_t *count) {
    *count = trajectory->start.count;
    return trajectory->start.items;
}

size_t ovoid_trajectory_get_count(const ovoid_trajectory *trajectory) { return trajectory->count; }

const ovoid_joint_position *ovoid_trajectory_get_point(const ovoid_trajectory *trajectory, size_t i, size_t *count) {
    *count = trajectory->points[i].positions.count;
    return trajectory->points[i].positions.items;
}

double ovoid_trajectory_get_time(const ovoid_trajectory *trajectory, size_t i) {
    return trajectory->has_times ? trajectory->points[i].time : NAN;
}

int64_t ovoid_trajectory_get_line(const ovoid_trajectory *trajectory, size_t i) { return trajectory->points[i].line; }
