// The joints that move are those of a group, or are named; without either, all that a planner can move.
#include "plan/ends.h"

#include "base/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- the joints that move

/// Adds the variables of a joint, unless it has none of its own.
static void add_joint(const cli_cell *cell, uint32_t joint, plan_ends *ends) {
    const ovoid_robot_joint *j = &cell->description.joints[joint];
    if (j->mimic != OVOID_ROBOT_NONE) return;
    uint32_t first = ovoid_robot_get_joint_variable(cell->robot.robot, joint);
    for (uint32_t i = 0; i < ovoid_joint_type_get_variable_count(j->type); i++)
        ends->moving[ends->moving_count++] = first + i;
}

/// Adds those of a group; 0 where the SRDF has none of that name.
static int add_group(const cli_cell *cell, const char *name, plan_ends *ends) {
    for (size_t i = 0; i < ovoid_robot_file_get_group_count(cell->robot.file); i++) {
        ovoid_robot_group group = ovoid_robot_file_get_group(cell->robot.file, i);
        if (strcmp(group.name, name) != 0) continue;
        for (size_t k = 0; k < group.joint_count; k++) add_joint(cell, group.joints[k], ends);
        return 1;
    }
    return 0;
}

/// Adds all that have limits, and continuous joints.
static void add_all(const cli_cell *cell, plan_ends *ends) {
    for (uint32_t i = 0; i < ovoid_robot_get_variable_count(cell->robot.robot); i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, i);
        ovoid_joint_type type = cell->description.joints[v.joint].type;
        int has_room = isfinite(v.lower) && isfinite(v.upper) && v.lower < v.upper;
        if (type == OVOID_JOINT_CONTINUOUS || (has_room && type != OVOID_JOINT_FLOATING))
            ends->moving[ends->moving_count++] = i;
    }
}

/// Adds the group of the request, or all where it names none. 0, or EXIT_INPUT after a message.
static int add_group_of_request(const cli_cell *cell, const char *path, plan_ends *ends) {
    ovoid_error error;
    ovoid_motion_request *request = path ? ovoid_motion_request_read(path, NULL, &error) : NULL;
    if (path && !request) return message_error("%s", error.message), EXIT_INPUT;
    const char *group = request ? ovoid_motion_request_get_group(request) : "";
    int is_found = *group && add_group(cell, group, ends);
    if (*group && !is_found)
        message_error(
            "%s: group_name \"%s\": the SRDF has no such group: --srdf FILE gives one that has it, --moving GROUP "
            "names another group",
            path, group);
    if (!*group) add_all(cell, ends);
    int code = is_found || !*group ? 0 : EXIT_INPUT;
    ovoid_motion_request_destroy(request);
    return code;
}

static int is_moving(const plan_ends *ends, size_t variable) {
    for (size_t i = 0; i < ends->moving_count; i++)
        if (ends->moving[i] == variable) return 1;
    return 0;
}

/// The group or the joint whose name is nearest to this word; NULL: none is near.
static const char *find_similar(const cli_cell *cell, const char *word) {
    enum { WORDS_MAX = 256 };
    const char *words[WORDS_MAX];
    size_t count = 0, groups = ovoid_robot_file_get_group_count(cell->robot.file);
    for (size_t i = 0; i < groups && count < WORDS_MAX; i++)
        words[count++] = ovoid_robot_file_get_group(cell->robot.file, i).name;
    for (size_t i = 0; i < cell->description.joint_count && count < WORDS_MAX; i++)
        words[count++] = cell->description.joints[i].name;
    return args_find_similar(word, words, count);
}

/// Adds the joints of --moving: a group, or names with commas between them. 0, or an exit code after a message.
static int add_named(const cli_command *command, const char *names, const cli_cell *cell, plan_ends *ends) {
    if (add_group(cell, names, ends)) return 0;
    char *text = strdup(names), *rest = NULL;
    int code = text ? 0 : (message_error("out of memory"), EXIT_INPUT);
    for (char *word = text ? strtok_r(text, ",", &rest) : NULL; word && !code; word = strtok_r(NULL, ",", &rest)) {
        uint32_t joint = ovoid_robot_find_joint(cell->robot.robot, word);
        const char *similar = joint == OVOID_ROBOT_NONE ? find_similar(cell, word) : NULL;
        if (joint == OVOID_ROBOT_NONE)
            code = args_complain(command, "%s: --moving %s: neither a group of the SRDF nor a joint is named %s%s%s%s",
                                 command->name, names, word, similar ? "; did you mean " : "", similar ? similar : "",
                                 similar ? "?" : "");
        else if (cell->description.joints[joint].mimic != OVOID_ROBOT_NONE)
            code = args_complain(command, "%s: --moving %s: %s follows another joint", command->name, names, word);
        else if (!is_moving(ends, ovoid_robot_get_joint_variable(cell->robot.robot, joint)))
            add_joint(cell, joint, ends);
    }
    free(text);
    return code;
}

static int find_moving(const cli_command *command, const plan_settings *s, const cli_cell *cell, plan_ends *ends) {
    ends->moving = malloc((ovoid_robot_get_variable_count(cell->robot.robot) + 1) * sizeof *ends->moving);
    if (!ends->moving) return message_error("out of memory"), EXIT_INPUT;
    int code =
        s->moving ? add_named(command, s->moving, cell, ends) : add_group_of_request(cell, s->states.request, ends);
    if (code || ends->moving_count) return code;
    message_error("no joint moves: a group without joints that a planner can move");
    return EXIT_INPUT;
}

// ---- the states

/// A goal is where the start is in all that stands still. 0, or EXIT_INPUT after a message.
static int check_still(const cli_cell *cell, const plan_ends *ends, const double *start, const double *goal) {
    char name[CELL_SIDE_ROOM];
    for (size_t i = 0; i < ovoid_robot_get_variable_count(cell->robot.robot); i++) {
        if (start[i] == goal[i] || is_moving(ends, i)) continue;
        cell_format_variable(name, cell, i);
        message_error(
            "the goal is %.9g in %s, the start %.9g, and the planner does not move it: --moving tells what moves",
            goal[i], name, start[i]);
        return EXIT_INPUT;
    }
    return 0;
}

/// Why a state is no end of a path, as a text to be freed; NULL: out of memory.
static char *explain_end(const cli_cell *cell, const ovoid_robot_answer *answer, const double *q) {
    char a[CELL_SIDE_ROOM], b[CELL_SIDE_ROOM], *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file) return NULL;
    if (answer->status == OVOID_ROBOT_REFUSED) {
        cell_write_refusal(file, cell, answer, q);
    } else if (!cell_has_pair(answer)) {
        fputs(cell_get_empty(), file);
    } else {
        cell_format_side(a, cell, &answer->a);
        cell_format_side(b, cell, &answer->b);
        fprintf(file, "not free: %s, %s: %s", a, b, cell_get_status_name(answer->status));
    }
    return fclose(file) == 0 ? text : NULL;
}

/// Says why: of the start, without which there is no path, an error, of a goal a warning.
static void report_end(const cli_cell *cell, size_t i, const ovoid_robot_answer *answer, const double *q) {
    char *why = explain_end(cell, answer, q);
    if (i)
        message_warning("goal %zu: %s", i, why ? why : "out of memory");
    else
        message_error("the start: %s", why ? why : "out of memory");
    free(why);
    if (cell_has_pair(answer)) cell_tell_links(cell, &answer->a, &answer->b);
    if (cell_is_outside(answer)) cell_tell_outside();
}

/// The exit code of a state that is no end of a path.
static int get_exit(const ovoid_robot_answer *answer) {
    if (answer->status == OVOID_ROBOT_REFUSED) return EXIT_INPUT;
    return answer->status == OVOID_ROBOT_HIT ? EXIT_TOUCH : EXIT_NOT_PROVEN;
}

/// Keeps the goals that are free. 0, or an exit code after a message.
static int find_goals(const plan_settings *s, const cli_cell *cell, const cli_states *states, plan_ends *ends) {
    ovoid_robot_query_options how = cell_make_options(&s->cell);
    ovoid_robot_answer answer;
    ovoid_error error;
    size_t n = states->variable_count;
    ends->goals = malloc((states->count * n + 1) * sizeof *ends->goals);
    ovoid_robot_checker *checker = ovoid_robot_checker_create(cell->cell, NULL, &error);
    int code = ends->goals && checker ? 0 : (message_error("out of memory"), EXIT_INPUT), last = 0;
    for (size_t i = 0; i < states->count && !code; i++) {
        const double *q = states->q + i * n;
        code = check_still(cell, ends, states->q, q);
        if (code) break;
        if (ovoid_robot_collide(checker, &(ovoid_robot_query){q, &how}, &answer, &error) != OVOID_OK)
            message_error("%s", error.message), code = EXIT_INPUT;
        else if (answer.status != OVOID_ROBOT_FREE)
            report_end(cell, i, &answer, q), last = get_exit(&answer), code = i ? 0 : last;
        else if (i)
            memcpy(ends->goals + ends->goal_count++ * n, q, n * sizeof *q);
    }
    ovoid_robot_checker_destroy(checker);
    if (code || ends->goal_count) return code;
    message_error("no goal is free");
    return last;
}

int ends_open(const cli_command *command, const plan_settings *s, const cli_cell *cell, const cli_states *states,
              plan_ends *ends) {
    *ends = (plan_ends){.moving = NULL};
    int code = 0;
    if (states->count < 2)
        message_error("there is no goal: the first state is the start, the others are goals"), code = EXIT_INPUT;
    if (!code) code = find_moving(command, s, cell, ends);
    if (!code) code = find_goals(s, cell, states, ends);
    if (code) ends_close(ends);
    return code;
}

void ends_close(plan_ends *ends) {
    free(ends->moving);
    free(ends->goals);
    *ends = (plan_ends){.moving = NULL};
}
