// Variables of a robot by their names, and states that are gathered one by one. What a state does not give is MoveIt's
// default (moveit_core, RobotModel::getVariableDefaultPositions), and a note says so.
#include "robot/states/reader.h"

#include "base/message.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Most variables that a note names.
enum { MISSING_MAX = 8 };

// ---- variables by name

/// The component of that name, as `robot info` and as MoveIt have it; NONE: none.
static uint32_t find_component(const ovoid_robot_joint *joint, const char *name) {
    static const char *const planar[] = {"x", "y", "theta"};
    static const char *const floating[] = {"trans_x", "trans_y", "trans_z", "rot_w", "rot_x", "rot_y", "rot_z"};
    int is_planar = joint->type == OVOID_JOINT_PLANAR;
    if (!is_planar && joint->type != OVOID_JOINT_FLOATING) return OVOID_ROBOT_NONE;
    const char *const *theirs = is_planar ? planar : floating;
    for (uint32_t i = 0; i < (is_planar ? 3u : 7u); i++)
        if (strcmp(name, theirs[i]) == 0 || strcmp(name, robot_get_component(joint, i) + 1) == 0) return i;
    return OVOID_ROBOT_NONE;
}

/// "floor/x" or "floor x".
static uint32_t find_by_component(const cli_cell *cell, const char *name) {
    char joint[256];
    const char *slash = strrchr(name, '/'), *end = slash ? slash : strrchr(name, ' ');
    if (!end || (size_t)(end - name) >= sizeof joint) return OVOID_ROBOT_NONE;
    memcpy(joint, name, (size_t)(end - name));
    joint[end - name] = 0;
    uint32_t j = ovoid_robot_find_joint(cell->robot.robot, joint);
    if (j == OVOID_ROBOT_NONE) return j;
    uint32_t component = find_component(&cell->description.joints[j], end + 1);
    return component == OVOID_ROBOT_NONE ? component : ovoid_robot_get_joint_variable(cell->robot.robot, j) + component;
}

static void explain_unknown(reader *r, const char *name) {
    const char *words[WORDS_MAX];
    const ovoid_robot_description *d = &r->cell->description;
    size_t count = 0;
    for (size_t i = 0; i < d->joint_count && count < WORDS_MAX; i++)
        if (d->joints[i].type != OVOID_JOINT_FIXED) words[count++] = d->joints[i].name;
    const char *similar = args_find_similar(name, words, count);
    if (similar)
        snprintf(r->why, WHY_ROOM, "there is no joint \"%.60s\"; did you mean %.60s?", name, similar);
    else
        snprintf(r->why, WHY_ROOM, "there is no joint \"%.60s\": \"ovoid robot info\" lists the variables", name);
}

/// The variable of that name, COLUMN_FOLLOWS, or NONE with r->why filled.
static uint32_t find_variable(reader *r, const char *name) {
    const ovoid_robot *robot = r->cell->robot.robot;
    uint32_t j = ovoid_robot_find_joint(robot, name);
    if (j == OVOID_ROBOT_NONE) {
        uint32_t variable = find_by_component(r->cell, name);
        if (variable == OVOID_ROBOT_NONE) explain_unknown(r, name);
        return variable;
    }
    const ovoid_robot_joint *joint = &r->cell->description.joints[j];
    if (joint->mimic != OVOID_ROBOT_NONE) return COLUMN_FOLLOWS;
    if (ovoid_joint_type_get_variable_count(joint->type) == 1) return ovoid_robot_get_joint_variable(robot, j);
    if (joint->type == OVOID_JOINT_FIXED && r->takes_fixed) return COLUMN_FOLLOWS;
    if (joint->type == OVOID_JOINT_FIXED)
        snprintf(r->why, WHY_ROOM, "joint \"%.60s\" is fixed and has no number: leave it out", name);
    else
        snprintf(r->why, WHY_ROOM, "joint \"%.60s\" has several variables: \"%.60s%s\", \"%.60s%s\", ...", name, name,
                 robot_get_component(joint, 0), name, robot_get_component(joint, 1));
    return OVOID_ROBOT_NONE;
}

static int is_fixed(const reader *r, const char *name) {
    uint32_t j = ovoid_robot_find_joint(r->cell->robot.robot, name);
    return j != OVOID_ROBOT_NONE && r->cell->description.joints[j].type == OVOID_JOINT_FIXED;
}

uint32_t reader_take_variable(reader *r, const char *name) {
    uint32_t variable = find_variable(r, name);
    if (variable == COLUMN_FOLLOWS)
        message_warning("joint %s %s: its numbers are not read", name,
                        is_fixed(r, name) ? "is fixed" : "follows another one");
    if (variable >= COLUMN_FOLLOWS) return variable;
    if (r->given[variable]) {
        snprintf(r->why, WHY_ROOM, "\"%.60s\" is there twice", name);
        return OVOID_ROBOT_NONE;
    }
    r->given[variable] = 1;
    return variable;
}

int reader_check_quaternions(reader *r) {
    for (size_t i = 0; i < r->states->variable_count; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(r->cell->robot.robot, i);
        const ovoid_robot_joint *joint = &r->cell->description.joints[v.joint];
        if (joint->type != OVOID_JOINT_FLOATING || v.component != 3) continue;
        const unsigned char *q = r->given + i;
        if (q[0] == q[1] && q[1] == q[2] && q[2] == q[3]) continue;
        snprintf(r->why, WHY_ROOM,
                 "of the quaternion of joint \"%.60s\" some numbers are missing: give qw, qx, qy and qz", joint->name);
        return 0;
    }
    return 1;
}

void reader_report_missing(const reader *r, const char *place) {
    size_t count = 0, size = 0;
    char *text = NULL;
    FILE *list = open_memstream(&text, &size);
    for (size_t i = 0; i < r->states->variable_count && list; i++) {
        if (r->given[i] || r->in_others[i] || count++ >= MISSING_MAX) continue;
        fputs(count > 1 ? ", " : "", list);
        cell_write_variable_name(list, r->cell, i);
        fprintf(list, " %.9g", r->defaults[i]);
    }
    if (list && fclose(list) == 0 && count)
        message_note("%s: not given, at their default: %s%s", place, text, count > MISSING_MAX ? ", ..." : "");
    free(text);
}

double *reader_add_state(reader *r) {
    cli_states *s = r->states;
    size_t n = s->variable_count;
    if (s->stored == s->capacity) {
        size_t capacity = 2 * s->capacity + 16;
        double *q = realloc(s->q, capacity * (n ? n : 1) * sizeof *q);
        if (!q) return message_error("out of memory for %zu states", capacity), NULL;
        s->q = q;
        double *times = r->has_time ? realloc(s->times, capacity * sizeof *times) : NULL;
        if (r->has_time && !times) return message_error("out of memory for %zu states", capacity), NULL;
        s->times = times;
        s->capacity = capacity;
    }
    double *state = s->q + s->stored++ * n;
    s->count++;
    if (n) memcpy(state, r->defaults, n * sizeof *state);
    return state;
}

// ---- text

char *reader_take_field(char **at) {
    char *column = *at, *comma = strchr(column, ',');
    if (comma) *comma = 0;
    *at = comma ? comma + 1 : NULL;
    while (isspace((unsigned char)*column)) column++;
    size_t length = strlen(column);
    while (length && isspace((unsigned char)column[length - 1])) length--;
    if (length > 1 && column[0] == '"' && column[length - 1] == '"') column++, length -= 2;
    column[length] = 0;
    return column;
}

int reader_read_number(reader *r, const char *text, double *value) {
    char *end;
    *value = strtod(text, &end);
    if (!*text) return snprintf(r->why, WHY_ROOM, "a number is missing"), 0;
    if (end == text || *end) return snprintf(r->why, WHY_ROOM, "\"%.60s\" is no number", text), 0;
    if (isfinite(*value)) return 1;
    snprintf(r->why, WHY_ROOM, "\"%.60s\" is not finite", text);
    return 0;
}
