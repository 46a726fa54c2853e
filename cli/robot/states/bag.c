// The joint states of a bag as CSV. "rostopic echo -p" writes "%time" in nanoseconds, field.name0, ... with a joint's
// name on each line, and field.position0, ...; PlotJuggler writes "__time" in seconds and /joint_states/NAME/position.
// Other columns are not read. Times count from the first line, since those of a clock have few digits left for them.
#include "robot/states/reader.h"

#include "base/message.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char position[] = "/position";

static int ends_with(const char *text, size_t length, const char *end) {
    size_t size = strlen(end);
    return length > size && strncmp(text + length - size, end, size) == 0;
}

int bag_is_header(const char *line) {
    for (const char *at = line; at; at = (at = strchr(at, ',')) ? at + 1 : NULL) {
        size_t length = strcspn(at, ",\r\n");
        while (length && (*at == '"' || *at == ' ')) at++, length--;
        while (length && (at[length - 1] == '"' || at[length - 1] == ' ')) length--;
        if (strncmp(at, "%time", 5) == 0 || strncmp(at, "__time", 6) == 0 || ends_with(at, length, position)) return 1;
    }
    return 0;
}

/// What stands behind "field.name" is a number.
static int is_numbered(const char *name, const char *head) {
    size_t size = strlen(head);
    return strncmp(name, head, size) == 0 && name[size] && !name[size + strspn(name + size, "0123456789")];
}

/// The joint of "/joint_states/NAME/position": the longest end of what stands before the last slash that is a joint.
static uint32_t take_position(reader *r, const char *name) {
    char text[256];
    size_t length = strlen(name) - strlen(position);
    if (length >= sizeof text)
        return snprintf(r->why, WHY_ROOM, "the column \"%.60s...\" is too long", name), OVOID_ROBOT_NONE;
    memcpy(text, name, length);
    text[length] = 0;
    const char *joint = text;
    for (const char *at = text; at && *at; at = (at = strchr(at, '/')) ? at + 1 : NULL) {
        joint = at;
        if (ovoid_robot_find_joint(r->cell->robot.robot, at) != OVOID_ROBOT_NONE) break;
    }
    return reader_take_variable(r, joint);
}

static uint32_t take_time(reader *r, uint32_t column) {
    if (!r->has_time++) return column;
    snprintf(r->why, WHY_ROOM, "the time is there twice");
    return OVOID_ROBOT_NONE;
}

uint32_t bag_take_column(reader *r, const char *name) {
    if (strcmp(name, "%time") == 0) return take_time(r, COLUMN_NANOSECONDS);
    if (strcmp(name, "__time") == 0) return take_time(r, COLUMN_SECONDS);
    if (ends_with(name, strlen(name), position)) return take_position(r, name);
    if (is_numbered(name, "field.name")) {
        r->bag.name_count++;
        if (!r->bag.named_count) return COLUMN_NAME;
        snprintf(r->why, WHY_ROOM, "\"%.60s\" stands behind a position; names come first", name);
        return OVOID_ROBOT_NONE;
    }
    if (is_numbered(name, "field.position")) return r->bag.named_count++, COLUMN_NAMED;
    return r->bag.skipped_count++, COLUMN_SKIPPED;
}

int bag_end_header(reader *r, const char *path) {
    size_t positions = r->bag.named_count;
    for (size_t i = 0; i < r->column_count; i++) positions += r->columns[i] <= COLUMN_FOLLOWS;
    if (!positions) {
        snprintf(r->why, WHY_ROOM,
                 "a bag's columns without a position of a joint: field.position0 or /joint_states/NAME/position");
        return 0;
    }
    if (r->bag.name_count != r->bag.named_count) {
        snprintf(r->why, WHY_ROOM, "there are %zu names, field.name0, ..., but %zu positions, field.position0, ...",
                 r->bag.name_count, r->bag.named_count);
        return 0;
    }
    r->bag.names = calloc(r->column_count + 1, sizeof *r->bag.names);
    if (!r->bag.names) return snprintf(r->why, WHY_ROOM, "out of memory"), 0;
    message_note("%s: joint states of a bag: positions are read, %zu other columns are not; times count from the first "
                 "state",
                 path, r->bag.skipped_count);
    return 1;
}

/// Gives the next position that has none its variable.
static void set_named(reader *r, uint32_t variable) {
    for (size_t i = 0; i < r->column_count; i++)
        if (r->columns[i] == COLUMN_NAMED) {
            r->columns[i] = variable;
            return;
        }
}

int bag_take_name(reader *r, size_t i, const char *name) {
    const char *before = r->bag.names[i];
    if (before && strcmp(before, name) == 0) return 1;
    if (before) {
        snprintf(r->why, WHY_ROOM,
                 "the joint \"%.60s\", where the first line has \"%.60s\": several publishers share this topic; write "
                 "one CSV for each",
                 name, before);
        return 0;
    }
    r->bag.names[i] = strdup(name);
    if (!r->bag.names[i]) return snprintf(r->why, WHY_ROOM, "out of memory"), 0;
    uint32_t variable = reader_take_variable(r, name);
    set_named(r, variable);
    return variable != OVOID_ROBOT_NONE;
}

int bag_read_time(reader *r, uint32_t column, const char *text, double *seconds) {
    if (column == COLUMN_SECONDS) {
        if (!reader_read_number(r, text, seconds)) return 0;
        if (!r->bag.has_first++) r->bag.first = *seconds;
        *seconds -= r->bag.first;
        return 1;
    }
    char *end;
    errno = 0;
    long long nanoseconds = strtoll(text, &end, 10);
    if (end == text || *end || errno || nanoseconds < 0)
        return snprintf(r->why, WHY_ROOM, "\"%.60s\" is no time in nanoseconds", text), 0;
    if (!r->bag.has_first++) r->bag.first_nanoseconds = nanoseconds;
    *seconds = 1e-9 * (double)(nanoseconds - r->bag.first_nanoseconds);
    return 1;
}

void bag_close(reader *r) {
    for (size_t i = 0; r->bag.names && i < r->column_count; i++) free(r->bag.names[i]);
    free(r->bag.names);
}
