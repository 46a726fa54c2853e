// Reading states: what the readers of files, of messages and of the command line have in common. Strict: each name is
// a variable that there is, each state has all its numbers, and numbers are finite.
#ifndef OVOID_CLI_ROBOT_STATES_READER_H
#define OVOID_CLI_ROBOT_STATES_READER_H

#include "robot/states/states.h"

/// What a column of a file is where it is no variable: of a joint that follows another one or is fixed, which is not
/// read; the time, in seconds as it is, or in seconds or nanoseconds from the first line's; what is not looked at; the
/// name of a joint, and a number whose joint is named by another column.
#define COLUMN_FOLLOWS 0xfffffff0u
#define COLUMN_TIME 0xfffffff1u
#define COLUMN_SECONDS 0xfffffff2u
#define COLUMN_NANOSECONDS 0xfffffff3u
#define COLUMN_SKIPPED 0xfffffff4u
#define COLUMN_NAME 0xfffffff5u
#define COLUMN_NAMED 0xfffffff6u

/// Room for a sentence about what is wrong, and most words that a mistyped name is compared with.
enum { WHY_ROOM = 400, WORDS_MAX = 256 };

/// The columns of a bag's joint states.
typedef struct bag_columns {
    int is_bag;
    char **names;       ///< of column i, as the first line had it; NULL: not a name, or no line was read
    size_t name_count;  ///< columns with names
    size_t named_count; ///< columns with numbers that they name
    size_t skipped_count;
    double first; ///< seconds of the first line
    long long first_nanoseconds;
    int has_first;
} bag_columns;

/// What the states are read for.
typedef struct reader {
    const cli_cell *cell;
    cli_states *states;
    double *defaults;         ///< of what a state does not give
    unsigned char *given;     ///< 1: the variable has a column
    unsigned char *in_others; ///< 1: the default is that of --others, and no note names it
    uint32_t *columns;        ///< variables
    size_t column_count;
    int has_time;
    int takes_fixed; ///< 1: a message, which may name fixed joints; a warning says so
    bag_columns bag;
    char why[WHY_ROOM];
} reader;

/// Marks the variable of that name as given. NONE where it was, or there is none, with r->why filled; COLUMN_FOLLOWS
/// after a warning.
uint32_t reader_take_variable(reader *r, const char *name);
/// A floating joint's quaternion is given whole or not at all. 0: not so, with r->why filled.
int reader_check_quaternions(reader *r);
/// Says which variables are not given.
void reader_report_missing(const reader *r, const char *place);
/// Room for one more state, with the default; NULL after a message.
double *reader_add_state(reader *r);

/// Cuts the column at `*at` off a line, without the blanks and quotes around it; *at becomes NULL behind the last one.
char *reader_take_field(char **at);
/// A finite number; 0 where the text is none, with r->why filled.
int reader_read_number(reader *r, const char *text, double *value);

/// The states of a CSV file; "-": standard input. 0, or an exit code after a message.
int reader_read_csv(reader *r, const char *path);
/// The states of a trajectory of MoveIt. 0, or an exit code after a message.
int reader_read_trajectory(reader *r, const char *path);
/// The start and the goals of a request. 0, or an exit code after a message.
int reader_read_request(reader *r, const char *path);
/// The states of --state. 0, or an exit code after a message.
int reader_read_texts(reader *r, const cli_command *command, const args_list *texts);
/// Takes the defaults from --others. 0, or an exit code after a message.
int reader_read_others(reader *r, const cli_command *command, const char *text);

/// 1: this header is of a bag's joint states.
int bag_is_header(const char *line);
/// The column of a bag with that name; NONE with r->why filled.
uint32_t bag_take_column(reader *r, const char *name);
/// Ends the header: each number has a name. 0 with r->why filled.
int bag_end_header(reader *r, const char *path);
/// Takes the name of a joint in column i: of the first line, or the same in each other. 0 with r->why filled.
int bag_take_name(reader *r, size_t i, const char *name);
/// Reads a time, which counts from the first line's. 0 with r->why filled.
int bag_read_time(reader *r, uint32_t column, const char *text, double *seconds);
void bag_close(reader *r);

#endif
