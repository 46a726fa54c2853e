// What the writers and the reader of results share.
#ifndef OVOID_IO_RESULTS_RECORD_H
#define OVOID_IO_RESULTS_RECORD_H

#include "io/json.h"

#include <ovoid/io.h>

/// 1 for a record of an impact, 0 for one of a frame.
int record_is_impact(const ovoid_record *record);

/// 1 where the record has a margin.
int record_has_margin(const ovoid_record *record);

/// What the bracket says of the record's margin: "yes" (within), "no" (farther), "at" (the bracket is as narrow as
/// asked and holds the margin) or "unproven"; "" without a margin.
const char *record_find_within(const ovoid_record *record);

// What solids have beside the deciding pair's answer, and what meshes are taken as. q: the quote, as in
// results_write.c.

/// The keys behind a (side 0) or b; what is taken of it; those behind the margin; those of the proof.
void record_write_triangle(FILE *file, const ovoid_record *record, int side);
void record_write_kind(FILE *file, const ovoid_record *record, int side);
void record_write_inside(FILE *file, const ovoid_record *record);
void record_write_surfaces(FILE *file, const char *q, const ovoid_record *record);
/// The columns of CSV.
void record_write_solid_header(FILE *file, unsigned fields);
void record_write_solid_columns(FILE *file, const ovoid_record *record);

/// Reads all of these from a line whose other keys are in the record; *x becomes the record's where it has one.
/// NULL, or what is wrong with *key.
const char *record_read_solid(const json_t *line, ovoid_record *record, ovoid_solid_answer *x, const char **key);

// Of the reader: numbers and names.

/// A whole number from 0 to top; a number, or null for what is not finite; three of them.
int record_read_whole(const json_t *value, double top, double *whole);
int record_read_number(const json_t *value, double if_null, double *number);
int record_read_vector(const json_t *value, ovoid_vec3 *v);
/// -1 where it is none.
int record_find_status(const char *text);
int record_find_limit(const char *text);

/// A column of CSV, or nothing for an empty one.
void record_write_column(FILE *file, double value);

#endif
