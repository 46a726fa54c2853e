// Reading states. Strict: each column is a variable that there is, each line has all columns, numbers are finite. What
// is not given is MoveIt's default (moveit_core, RobotModel::getVariableDefaultPositions), and a note says so.
#include "robot/states.h"

#include "base/message.h"
#include "io/fields.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// The column of a joint that follows another one: it is not read.
#define COLUMN_FOLLOWS 0xfffffffeu

/// The column "time", unless a joint has that name.
#define COLUMN_TIME 0xfffffffdu

/// Room for a sentence about what is wrong.
enum { WHY_ROOM = 400, WORDS_MAX = 256, MISSING_MAX = 8 };

/// What the states are read for.
typedef struct reader {
    const cli_cell *cell;
    cli_states *states;
    const double *defaults;
    unsigned char *given; ///< 1: the variable has a column
    uint32_t *columns;    ///< variables
    size_t column_count;
    int has_time;
    char why[WHY_ROOM];
} reader;

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
    if (joint->type == OVOID_JOINT_FIXED)
        snprintf(r->why, WHY_ROOM, "joint \"%.60s\" is fixed and has no number: leave it out", name);
    else
        snprintf(r->why, WHY_ROOM, "joint \"%.60s\" has several variables: \"%.60s%s\", \"%.60s%s\", ...", name, name,
                 robot_get_component(joint, 0), name, robot_get_component(joint, 1));
    return OVOID_ROBOT_NONE;
}

/// Marks a variable as given; 0 where it was, or there is none, with r->why filled.
static uint32_t take_variable(reader *r, const char *name) {
    uint32_t variable = find_variable(r, name);
    if (variable == COLUMN_FOLLOWS) message_warning("joint %s follows another one: its numbers are not read", name);
    if (variable >= COLUMN_FOLLOWS) return variable;
    if (r->given[variable]) {
        snprintf(r->why, WHY_ROOM, "\"%.60s\" is there twice", name);
        return OVOID_ROBOT_NONE;
    }
    r->given[variable] = 1;
    return variable;
}

/// A floating joint's quaternion is given whole or not at all. 0: not so, with r->why filled.
static int check_quaternions(reader *r) {
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

double states_get_default(const cli_cell *cell, size_t variable) {
    ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, variable);
    if (cell->description.joints[v.joint].type == OVOID_JOINT_FLOATING && v.component == 3) return 1;
    return v.lower <= 0 && v.upper >= 0 ? 0 : v.lower + (v.upper - v.lower) / 2;
}

/// Says which variables are not given.
static void report_missing(const reader *r, const char *place) {
    size_t count = 0, size = 0;
    char *text = NULL;
    FILE *list = open_memstream(&text, &size);
    for (size_t i = 0; i < r->states->variable_count && list; i++) {
        if (r->given[i] || count++ >= MISSING_MAX) continue;
        fputs(count > 1 ? ", " : "", list);
        cell_write_variable_name(list, r->cell, i);
        fprintf(list, " %.9g", r->defaults[i]);
    }
    if (list && fclose(list) == 0 && count)
        message_note("%s: not given, at their default: %s%s", place, text, count > MISSING_MAX ? ", ..." : "");
    free(text);
}

/// Room for one more state, with the default; NULL after a message.
static double *add_state(reader *r) {
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

/// Cuts the column at `*at` off a line, without the blanks and quotes around it; *at becomes NULL behind the last one.
static char *take_field(char **at) {
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

/// A finite number; 0 where the text is none, with r->why filled.
static int read_number(reader *r, const char *text, double *value) {
    char *end;
    *value = strtod(text, &end);
    if (!*text) return snprintf(r->why, WHY_ROOM, "a number is missing"), 0;
    if (end == text || *end) return snprintf(r->why, WHY_ROOM, "\"%.60s\" is no number", text), 0;
    if (isfinite(*value)) return 1;
    snprintf(r->why, WHY_ROOM, "\"%.60s\" is not finite", text);
    return 0;
}

// ---- files

/// The column of that name; NONE with r->why filled.
static uint32_t take_column(reader *r, const char *name) {
    if (strcmp(name, "time") != 0 || ovoid_robot_find_joint(r->cell->robot.robot, name) != OVOID_ROBOT_NONE)
        return take_variable(r, name);
    if (!r->has_time++) return COLUMN_TIME;
    snprintf(r->why, WHY_ROOM, "\"time\" is there twice");
    return OVOID_ROBOT_NONE;
}

/// The names of a header, each read into `name`, which has room for the line.
static int read_names(reader *r, const char *line, char *name) {
    size_t room = strlen(line) + 1;
    ovoid_error error;
    double number;
    for (const char *at = line; at; at = *at == ',' ? at + 1 : NULL) {
        at = ovoid_text_read_csv(at, name, room, &error);
        if (!at) return snprintf(r->why, WHY_ROOM, "%s", error.message), 0;
        if (!r->column_count && read_number(r, name, &number)) {
            snprintf(r->why, WHY_ROOM, "the first line names the joints, \"shoulder,elbow,...\"; this one has numbers");
            return 0;
        }
        uint32_t variable = take_column(r, name);
        if (variable == OVOID_ROBOT_NONE) return 0;
        r->columns[r->column_count++] = variable;
    }
    return check_quaternions(r);
}

/// 1: the columns of a header are apart by a character that is no comma; r->why is filled.
static int has_other_commas(reader *r, const char *line) {
    const char *semicolon = strchr(line, ';'), *tab = strchr(line, '\t');
    if (strchr(line, ',') || (!semicolon && !tab)) return 0;
    snprintf(r->why, WHY_ROOM, "%s between the columns, where commas are wanted: tr '%s' ',' <FILE >COMMAS.csv",
             semicolon ? "semicolons stand" : "tabs stand", semicolon ? ";" : "\\t");
    return 1;
}

static int read_header(reader *r, const char *line) {
    size_t most = 1;
    if (has_other_commas(r, line)) return 0;
    for (const char *c = line; *c; c++) most += *c == ',';
    char *name = malloc(strlen(line) + 1);
    r->columns = malloc(most * sizeof *r->columns);
    int is_good = name && r->columns ? read_names(r, line, name) : (snprintf(r->why, WHY_ROOM, "out of memory"), 0);
    free(name);
    return is_good;
}

static int read_state(reader *r, char *line, double *state) {
    size_t count = 1, i = 0;
    double value;
    for (const char *c = line; *c; c++) count += *c == ',';
    if (count != r->column_count) {
        snprintf(r->why, WHY_ROOM, "%zu numbers, where the header has %zu columns", count, r->column_count);
        return 0;
    }
    for (char *at = line; at; i++) {
        if (!read_number(r, take_field(&at), &value)) return 0;
        if (r->columns[i] == COLUMN_TIME && r->states->times) r->states->times[r->states->stored - 1] = value;
        if (r->columns[i] < COLUMN_TIME) state[r->columns[i]] = value;
    }
    return 1;
}

static int is_blank(const char *line) { return line[strspn(line, " \t\r\n")] == 0; }

/// One line of the file. 0, or an exit code after a message.
static int take_line(reader *r, const char *path, size_t number, char *line, size_t length) {
    static const char mark[] = "\xEF\xBB\xBF";
    r->why[0] = 0;
    if (number == 1 && strncmp(line, mark, 3) == 0) line += 3, length -= 3;
    if (strlen(line) != length)
        snprintf(r->why, WHY_ROOM, "a byte of zero: this is no text");
    else if (is_blank(line))
        return 0;
    else if (!r->columns) {
        if (read_header(r, line)) return report_missing(r, path), 0;
    } else if (!shard_part_has(r->states->part, r->states->count / OVOID_ROBOT_BLOCK)) {
        r->states->count++;
        return 0;
    } else {
        double *state = add_state(r);
        if (!state) return EXIT_INPUT;
        if (read_state(r, line, state)) return 0;
    }
    message_error("%s:%zu: %s", path, number, r->why);
    return EXIT_INPUT;
}

static int read_file(reader *r, const char *path) {
    int is_input = strcmp(path, "-") == 0, code = 0;
    FILE *file = is_input ? stdin : fopen(path, "r");
    if (!file) return message_error("%s: cannot be opened: %s", path, strerror(errno)), EXIT_INPUT;
    const char *name = is_input ? "standard input" : path;
    char *line = NULL;
    size_t room = 0, number = 0;
    for (;;) {
        ssize_t length = getline(&line, &room, file);
        if (length < 0 || code) break;
        code = take_line(r, name, ++number, line, (size_t)length);
        if (code) break;
    }
    if (!code && ferror(file)) message_error("%s: cannot be read: %s", name, strerror(errno)), code = EXIT_INPUT;
    free(line);
    if (!is_input) (void)fclose(file); // it was read
    if (code || r->states->count) return code;
    message_error("%s: there is no state: a header of joints' names, then one state a line", name);
    return EXIT_INPUT;
}

// ---- the command line

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
        char *column = take_field(&at), *equals = strchr(column, '=');
        double value;
        if (!equals) {
            snprintf(r->why, WHY_ROOM, "\"%.60s\" is not of the form joint=number", column);
            good = 0;
            break;
        }
        *equals = 0;
        char *number = equals + 1;
        uint32_t variable = take_variable(r, take_field(&column));
        good = variable != OVOID_ROBOT_NONE && read_number(r, take_field(&number), &value);
        if (good && variable != COLUMN_FOLLOWS) state[variable] = value;
    }
    free(copy);
    return good && check_quaternions(r);
}

static int read_texts(reader *r, const cli_command *command, const args_list *texts) {
    for (int i = 0; i < texts->count; i++) {
        const char *text = texts->items[i];
        double *state = add_state(r);
        if (!state) return EXIT_INPUT;
        memset(r->given, 0, r->states->variable_count);
        int good = !*text || (strchr(text, '=') ? read_assignments(r, text, state) : read_named(r, text, state));
        if (!good) return args_complain(command, "%s: --state \"%.100s\": %s", command->name, text, r->why);
        report_missing(r, *text ? text : "--state \"\"");
    }
    return 0;
}

// ---- requests

/// The numbers that a request gives; `state` has those that it does not.
static int read_positions(reader *r, const ovoid_joint_position *items, size_t count, double *state) {
    memset(r->given, 0, r->states->variable_count);
    for (size_t i = 0; i < count; i++) {
        uint32_t variable = take_variable(r, items[i].joint);
        if (variable == OVOID_ROBOT_NONE) return 0;
        if (variable != COLUMN_FOLLOWS) state[variable] = items[i].position;
    }
    return 1;
}

/// The start and each goal, in which joints that it does not name stay where the start has them.
static int read_all_positions(reader *r, const ovoid_motion_request *request, const char *path) {
    size_t count, goals = ovoid_motion_request_get_goal_count(request), n = r->states->variable_count;
    for (size_t i = 0; i <= goals; i++) {
        const ovoid_joint_position *items =
            i ? ovoid_motion_request_get_goal(request, i - 1, &count) : ovoid_motion_request_get_start(request, &count);
        double *state = add_state(r);
        if (!state) return EXIT_INPUT;
        if (i && n) memcpy(state, r->states->q, n * sizeof *state);
        if (!read_positions(r, items, count, state)) {
            message_error("%s: %s: %s", path, i ? "goal_constraints" : "start_state", r->why);
            return EXIT_INPUT;
        }
        if (!i) report_missing(r, path);
    }
    return 0;
}

static int read_request(reader *r, const char *path) {
    ovoid_error error;
    // The notes are shown as those of the robot are, and only here.
    cli_robot notes = {.note_count = 0};
    const ovoid_robot_read_options options = {.note = robot_warn, .context = &notes};
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
    if (settings->group && !settings->texts.count)
        return args_complain(command, "%s: --group goes with --state NAME", command->name);
    if (settings->request) find_scene(settings, cell);
    return -1;
}

int states_open(const cli_command *command, const states_settings *settings, const cli_cell *cell, cli_states *states) {
    size_t n = ovoid_robot_get_variable_count(cell->robot.robot);
    *states = (cli_states){.variable_count = n,
                           .part = states->part,
                           .texts = settings->texts.count ? &settings->texts : NULL,
                           .group = settings->group};
    double *defaults = calloc(n + 1, sizeof *defaults);
    reader r = {.cell = cell, .states = states, .defaults = defaults, .given = calloc(n + 1, 1)};
    for (size_t i = 0; i < n && defaults; i++) defaults[i] = states_get_default(cell, i);
    int code = EXIT_INPUT;
    if (!defaults || !r.given)
        message_error("out of memory");
    else
        code = settings->path      ? read_file(&r, settings->path)
               : settings->request ? read_request(&r, settings->request)
                                   : read_texts(&r, command, &settings->texts);
    free(defaults);
    free(r.given);
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
