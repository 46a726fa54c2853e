// States from a CSV file: a header of names in any order, then one state a line; or a bag's joint states (bag.c).
#include "robot/states/reader.h"

#include "base/lines.h"
#include "base/message.h"
#include "io/fields.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/// The column of that name; NONE with r->why filled.
static uint32_t take_column(reader *r, const char *name) {
    if (r->bag.is_bag) return bag_take_column(r, name);
    if (strcmp(name, "time") != 0 || ovoid_robot_find_joint(r->cell->robot.robot, name) != OVOID_ROBOT_NONE)
        return reader_take_variable(r, name);
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
        if (!r->column_count && reader_read_number(r, name, &number)) {
            snprintf(r->why, WHY_ROOM, "the first line names the joints, \"shoulder,elbow,...\"; this one has numbers");
            return 0;
        }
        uint32_t variable = take_column(r, name);
        if (variable == OVOID_ROBOT_NONE) return 0;
        r->columns[r->column_count++] = variable;
    }
    return reader_check_quaternions(r);
}

/// 1: the columns of a header are apart by a character that is no comma; r->why is filled.
static int has_other_commas(reader *r, const char *line) {
    const char *semicolon = strchr(line, ';'), *tab = strchr(line, '\t');
    if (strchr(line, ',') || (!semicolon && !tab)) return 0;
    snprintf(r->why, WHY_ROOM, "%s between the columns, where commas are wanted: tr '%s' ',' <FILE >COMMAS.csv",
             semicolon ? "semicolons stand" : "tabs stand", semicolon ? ";" : "\\t");
    return 1;
}

/// 1: a header begins as JSON does; r->why is filled.
static int is_json(reader *r, const char *line) {
    const char first = line[strspn(line, " \t")];
    if (first != '{' && first != '[') return 0;
    snprintf(r->why, WHY_ROOM,
             "this is JSON, where CSV is wanted: a trajectory is read from a file whose name ends in "
             ".json or .yaml");
    return 1;
}

static int read_header(reader *r, const char *path, const char *line) {
    size_t most = 1;
    if (is_json(r, line)) return 0;
    if (has_other_commas(r, line)) return 0;
    r->takes_fixed = r->bag.is_bag = bag_is_header(line);
    for (const char *c = line; *c; c++) most += *c == ',';
    char *name = malloc(strlen(line) + 1);
    r->columns = malloc(most * sizeof *r->columns);
    int is_good = name && r->columns ? read_names(r, line, name) : (snprintf(r->why, WHY_ROOM, "out of memory"), 0);
    free(name);
    return is_good && r->bag.is_bag ? bag_end_header(r, path) : is_good;
}

/// What stands in column i of a line.
static int read_field(reader *r, size_t i, const char *text, double *state) {
    uint32_t column = r->columns[i];
    double value;
    if (column == COLUMN_SKIPPED) return 1;
    if (r->bag.is_bag && !*text) {
        snprintf(r->why, WHY_ROOM, "column %zu is empty: write the joint states alone, of which each line is full",
                 i + 1);
        return 0;
    }
    if (column == COLUMN_NAME) return bag_take_name(r, i, text);
    int is_clock = column == COLUMN_SECONDS || column == COLUMN_NANOSECONDS;
    if (!(is_clock ? bag_read_time(r, column, text, &value) : reader_read_number(r, text, &value))) return 0;
    if ((is_clock || column == COLUMN_TIME) && r->states->times) r->states->times[r->states->stored - 1] = value;
    if (column < COLUMN_FOLLOWS) state[column] = value;
    return 1;
}

static int read_state(reader *r, char *line, double *state) {
    size_t count = 1, i = 0;
    for (const char *c = line; *c; c++) count += *c == ',';
    if (count != r->column_count) {
        snprintf(r->why, WHY_ROOM, "%zu numbers, where the header has %zu columns", count, r->column_count);
        return 0;
    }
    for (char *at = line; at; i++)
        if (!read_field(r, i, reader_take_field(&at), state)) return 0;
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
        if (read_header(r, path, line)) return r->bag.name_count ? 0 : (reader_report_missing(r, path), 0);
    } else if (!shard_part_has(r->states->part, r->states->count / OVOID_ROBOT_BLOCK)) {
        r->states->count++;
        return 0;
    } else {
        double *state = reader_add_state(r);
        if (!state) return EXIT_INPUT;
        int is_good = read_state(r, line, state);
        // A bag names its joints on the first line.
        if (is_good && r->bag.name_count && r->states->stored == 1) reader_report_missing(r, path);
        if (is_good) return 0;
    }
    message_error("%s:%zu: %s", path, number, r->why);
    return EXIT_INPUT;
}

int reader_read_csv(reader *r, const char *path) {
    int is_input = strcmp(path, "-") == 0, code = 0;
    FILE *file = is_input ? stdin : fopen(path, "r");
    if (!file) return message_error("%s: cannot be opened: %s", path, strerror(errno)), EXIT_INPUT;
    const char *name = is_input ? "standard input" : path;
    char *line = NULL;
    size_t room = 0, number = 0;
    long length = 0;
    while (!code && (length = lines_read(file, &line, &room)) > 0)
        code = take_line(r, name, ++number, line, (size_t)length);
    if (!code && length < 0) {
        if (errno == ENOMEM)
            message_error("%s:%zu: the line is too long for the memory that there is", name, number + 1);
        else
            message_error("%s: cannot be read: %s", name, strerror(errno));
        code = EXIT_INPUT;
    }
    free(line);
    if (!is_input) (void)fclose(file); // it was read
    if (code || r->states->count) return code;
    message_error("%s: there is no state: a header of joints' names, then one state a line", name);
    return EXIT_INPUT;
}
