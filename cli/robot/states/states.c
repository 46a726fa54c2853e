// States of a robot: the command line that gives them, and what is kept.
#include "robot/states/reader.h"

#include "base/message.h"
#include "base/outputs.h"
#include "io/fields.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

double states_get_default(const cli_cell *cell, size_t variable) {
    ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, variable);
    if (cell->description.joints[v.joint].type == OVOID_JOINT_FLOATING && v.component == 3) return 1;
    return v.lower <= 0 && v.upper >= 0 ? 0 : v.lower + (v.upper - v.lower) / 2;
}

int states_check_goal(const states_settings *settings, const cli_states *states) {
    if (!settings->request || states->count == 2) return 0;
    if (states->count == 1)
        message_error("%s: there is no goal, and a path leads to one", settings->request);
    else
        message_error("%s: there are %zu goals, and a path leads to one: \"ovoid robot check\" takes all of them",
                      settings->request, states->count - 1);
    return EXIT_INPUT;
}

/// Takes the scene that stands beside the request, "sceneX.yaml" for "requestX.yaml", where there is one.
static void find_scene(states_settings *settings, cell_settings *cell) {
    static const char head[] = "request";
    const char *path = settings->request, *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    struct stat status;
    if (cell->scene || strncmp(name, head, sizeof head - 1) != 0) return;
    int length = snprintf(settings->scene, sizeof settings->scene, "%.*sscene%s", (int)(name - path), path,
                          name + sizeof head - 1);
    if (length < 0 || (size_t)length >= sizeof settings->scene || stat(settings->scene, &status) != 0) {
        message_note("%s: there is no scene of that name beside it, and no --scene: no obstacles", path);
        return;
    }
    cell->scene = settings->scene;
    message_note("%s: the obstacles are those of %s", path, settings->scene);
}

int states_settle(const cli_command *command, states_settings *settings, cell_settings *cell) {
    int kinds = (settings->path != NULL) + (settings->texts.count > 0) + (settings->request != NULL);
    if (kinds > 1)
        return args_complain(command, "%s: --states, --state and --request exclude each other", command->name);
    if (!kinds)
        return args_complain(command,
                             "%s: there is no state: --states Q.csv, --state \"joint=number,...\", or --request FILE",
                             command->name);
    if (settings->group && !settings->texts.count && !settings->others)
        return args_complain(command, "%s: --group goes with --state NAME", command->name);
    if (settings->request) find_scene(settings, cell);
    return -1;
}

/// A trajectory of MoveIt or a CSV file, by the end of its name.
static int read_file(reader *r, const char *path) {
    int is_message = outputs_has_extension(path, "yaml") || outputs_has_extension(path, "yml") ||
                     outputs_has_extension(path, "json");
    return (is_message ? reader_read_trajectory : reader_read_csv)(r, path);
}

int states_open(const cli_command *command, const states_settings *settings, const cli_cell *cell, cli_states *states) {
    size_t n = ovoid_robot_get_variable_count(cell->robot.robot);
    *states = (cli_states){.variable_count = n,
                           .part = states->part,
                           .texts = settings->texts.count ? &settings->texts : NULL,
                           .group = settings->group};
    reader r = {.cell = cell,
                .states = states,
                .defaults = calloc(n + 1, sizeof(double)),
                .given = calloc(n + 1, 1),
                .in_others = calloc(n + 1, 1)};
    for (size_t i = 0; i < n && r.defaults; i++) r.defaults[i] = states_get_default(cell, i);
    int code = r.defaults && r.given && r.in_others ? 0 : (message_error("out of memory"), EXIT_INPUT);
    if (!code && settings->others) code = reader_read_others(&r, command, settings->others);
    if (!code)
        code = settings->path      ? read_file(&r, settings->path)
               : settings->request ? reader_read_request(&r, settings->request)
                                   : reader_read_texts(&r, command, &settings->texts);
    bag_close(&r);
    free(r.defaults);
    free(r.given);
    free(r.in_others);
    free(r.columns);
    if (code) states_close(states);
    return code;
}

const double *states_get(const cli_states *s, size_t i) {
    size_t block = i / OVOID_ROBOT_BLOCK, before = s->part.count ? block / s->part.count : block;
    return s->q + (before * OVOID_ROBOT_BLOCK + i % OVOID_ROBOT_BLOCK) * s->variable_count;
}

void states_close(cli_states *states) {
    free(states->q);
    free(states->times);
    *states = (cli_states){.q = NULL};
}

const char *states_get_name(const cli_states *states, size_t i) {
    return states->texts && i < (size_t)states->texts->count ? states->texts->items[i] : NULL;
}

void states_write_json(FILE *file, const cli_states *states, const char *key, size_t count) {
    fprintf(file, ",\"%s\":[", key);
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', file);
        json_write_numbers(file, states->q + i * states->variable_count, states->variable_count);
    }
    fputc(']', file);
    if (!states->times) return;
    fputs(",\"times\":", file);
    json_write_numbers(file, states->times, count);
}
