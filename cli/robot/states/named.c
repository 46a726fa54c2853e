// States from the command line: names of the SRDF's, and assignments.
#include "robot/states/reader.h"

#include <stdlib.h>
#include <string.h>

/// The joints' numbers of all states of the SRDF with that name, which may be of several groups.
static int read_named(reader *r, const char *name, double *state) {
    const ovoid_robot_file *file = r->cell->robot.file;
    const char *group = r->states->group;
    size_t count = ovoid_robot_file_get_state_count(file), found = 0, words_count = 0;
    const char *words[WORDS_MAX];
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_state s = ovoid_robot_file_get_state(file, i);
        if (group && strcmp(s.group, group) != 0) continue;
        if (words_count < WORDS_MAX) words[words_count++] = s.name;
        if (strcmp(s.name, name) != 0) continue;
        found++;
        for (size_t k = 0; k < s.value_count; k++) {
            uint32_t joint = s.values[k].joint, v = ovoid_robot_get_joint_variable(r->cell->robot.robot, joint);
            if (v == OVOID_ROBOT_NONE || r->cell->description.joints[joint].mimic != OVOID_ROBOT_NONE) continue;
            for (uint32_t c = 0; c < s.values[k].count; c++) state[v + c] = s.values[k].values[c], r->given[v + c] = 1;
        }
    }
    if (found) return 1;
    const char *similar = args_find_similar(name, words, words_count);
    if (!count) return snprintf(r->why, WHY_ROOM, "no SRDF names states: --srdf, or \"joint=number,...\""), 0;
    snprintf(r->why, WHY_ROOM, "the SRDF has no such state%s%.60s%s%.60s%s", group ? " of the group " : "",
             group ? group : "", similar ? "; did you mean " : "", similar ? similar : "",
             similar ? "?" : ": give one as \"joint=number,...\"");
    return 0;
}

static int read_assignments(reader *r, const char *text, double *state) {
    char *copy = strdup(text);
    int good = copy != NULL;
    if (!copy) snprintf(r->why, WHY_ROOM, "out of memory");
    for (char *at = copy; at && good;) {
        char *column = reader_take_field(&at), *equals = strchr(column, '=');
        double value;
        if (!equals) {
            snprintf(r->why, WHY_ROOM, "\"%.60s\" is not of the form joint=number", column);
            good = 0;
            break;
        }
        *equals = 0;
        char *number = equals + 1;
        uint32_t variable = reader_take_variable(r, reader_take_field(&column));
        good = variable != OVOID_ROBOT_NONE && reader_read_number(r, reader_take_field(&number), &value);
        if (good && variable != COLUMN_FOLLOWS) state[variable] = value;
    }
    free(copy);
    return good && reader_check_quaternions(r);
}

/// One state from its text. 0 with r->why filled.
static int read_text(reader *r, const char *text, double *state) {
    memset(r->given, 0, r->states->variable_count);
    return !*text || (strchr(text, '=') ? read_assignments(r, text, state) : read_named(r, text, state));
}

int reader_read_others(reader *r, const cli_command *command, const char *text) {
    if (!read_text(r, text, r->defaults))
        return args_complain(command, "%s: --others \"%.100s\": %s", command->name, text, r->why);
    memcpy(r->in_others, r->given, r->states->variable_count);
    memset(r->given, 0, r->states->variable_count);
    return 0;
}

int reader_read_texts(reader *r, const cli_command *command, const args_list *texts) {
    for (int i = 0; i < texts->count; i++) {
        const char *text = texts->items[i];
        double *state = reader_add_state(r);
        if (!state) return EXIT_INPUT;
        if (!read_text(r, text, state))
            return args_complain(command, "%s: --state \"%.100s\": %s", command->name, text, r->why);
        reader_report_missing(r, *text ? text : "--state \"\"");
    }
    return 0;
}
