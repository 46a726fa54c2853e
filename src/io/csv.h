// One line of a CSV file read column by column, strictly: every column present, no other, numbers finite.
#ifndef OVOID_IO_CSV_H
#define OVOID_IO_CSV_H

#include "io/text.h"

/// The reading position in a line of known columns.
typedef struct csv_line {
    const char *at, *end;       ///< the rest of the line
    const char *const *columns; ///< their names
    int column, count;          ///< the next one; their number
    where place;
    ovoid_error *error;
} csv_line;

/// The next column as a finite number.
ovoid_code csv_read_number(csv_line *line, double *value);

/// 1 if a spreadsheet may take the text for a formula, or its first byte is an apostrophe; blanks before it do not
/// count.
int text_is_formula(const char *text, const char *end);

/// The byte of an escape "\xHH" at the text; -1: there is none.
int text_read_escape(const char *text, const char *end);

/// The next column as a text that ovoid_text_write_csv wrote, without the blanks around it, or in quotes ("" stands for
/// a quote). Terminated; FORMAT where it is empty or does not fit into `room` bytes.
ovoid_code csv_read_text(csv_line *line, char *text, size_t room);

/// The first line of a file, which must be one of these: which one, or -1 with the error filled.
int csv_read_header(line_source *source, const char *const *headers, int count, ovoid_error *error);

/// The next line that is not blank. 1, 0 at the end, -1: *error is filled.
int csv_next_line(line_source *source, const char **line, size_t *length, ovoid_error *error);

#endif
