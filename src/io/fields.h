// Records told by tables: of each field its key, its kind, where it is in a C struct, whether it may be left out, and
// the words of a reader that finds it wrong. JSON and CSV are written, and JSON is read, by such a table, so that a
// field stands in one place. The tool writes its own reports by tables too, and compiles fields_write.c for that.
#ifndef OVOID_IO_FIELDS_H
#define OVOID_IO_FIELDS_H

#include <ovoid/io.h>

/// What a field is in C, and in a file.
typedef enum field_kind {
    FIELD_FINITE,  ///< double; null is not read
    FIELD_NUMBER,  ///< double; what is not finite is null in JSON, and is read as `if_null`; "inf", "nan" in CSV
    FIELD_MEASURE, ///< double; as FIELD_NUMBER, but empty in CSV where it is not finite
    FIELD_SECONDS, ///< double; as FIELD_MEASURE, with nine digits behind the point in JSON
    FIELD_WHOLE,   ///< uint16_t, uint32_t, uint64_t or size_t, by its size
    FIELD_RANGE,   ///< uint32_t[2], or two members that follow one another
    FIELD_VECTOR,  ///< ovoid_vec3; three columns of CSV: key_x, key_y, key_z
    FIELD_NAME,    ///< an enum, by its names
    FIELD_TEXT,    ///< const char *; NULL is null, and empty in CSV
    FIELD_FLAG,    ///< int: true or false
    FIELD_WHOLES,  ///< uint32_t[], as many as the count says; left out where there are none
    FIELD_NUMBERS, ///< double[], the same
    FIELD_TEXTS,   ///< pointer to texts, as many as the size_t count says
    FIELD_OBJECT,  ///< a struct with a table
    FIELD_LIST,    ///< pointer to structs with a table, as many as the size_t count says; left out where there are none
    FIELD_OWN      ///< written and read by functions
} field_kind;

/// What readers say of a field that is not of its kind.
#define WRONG_WHOLE "must be a whole number >= 0"
#define WRONG_NUMBER "must be a number"
#define WRONG_VECTOR "must be three numbers"

/// The names of an enum's values, from the first on.
typedef struct field_names {
    const char *(*get)(int value);
    int first, last;
} field_names;

struct json_t;
struct field_table;

/// How a field is written and read that is of no other kind. quote: "\"", doubled within a field of CSV, NULL where it
/// is a column of CSV. read: NULL, or what is wrong.
typedef struct field_own {
    void (*write)(FILE *file, const char *quote, const void *item);
    const char *(*read)(const struct json_t *value, void *item);
} field_own;

/// Bits of a field that have a meaning of their own; all others are the table's.
#define FIELD_ALWAYS ((uint64_t)0)
#define FIELD_NOT_ZERO ((uint64_t)1 << 63) ///< left out where it is zero
#define FIELD_COLUMN (1u << 31)            ///< a column of CSV in any case

typedef struct field {
    const char *key;
    field_kind kind;
    unsigned column;                 ///< any of these bits makes it a column of CSV; 0: it never is
    size_t offset, size;             ///< of the member
    size_t count;                    ///< offset of the number of items: uint32_t of an array in the struct, else size_t
    uint64_t bit;                    ///< with which it is there; FIELD_ALWAYS: it is
    const field_names *names;        ///< of NAME
    const struct field_table *table; ///< of OBJECT and LIST
    const field_own *own;            ///< of OWN
    double if_null;                  ///< of NUMBER and MEASURE
    double least;                    ///< of FINITE, NUMBER and MEASURE: read only above it, where it is not 0
    const char *wrong;               ///< what a reader says of a value that is not of the kind
    const char *apart;               ///< what it says where the field is there, or not, against its bit
} field;

typedef struct field_table {
    const field *fields;
    size_t count, size;  ///< of the fields; of the struct
    const char *foreign; ///< what a reader says of a key that is none of these
    const char *missing; ///< what it says of one that is not there; NULL: what is wrong with its value
} field_table;

/// The row of a member; a table of rows, and one that is read, too, with its sentences.
#define FIELD_AT(type, member) .offset = offsetof(type, member), .size = sizeof(((type *)NULL)->member)
#define FIELD_TABLE(type, rows)                                                                                        \
    { .fields = (rows), .count = sizeof(rows) / sizeof *(rows), .size = sizeof(type) }
#define FIELD_TABLE_READ(type, rows, foreign, missing)                                                                 \
    { (rows), sizeof(rows) / sizeof *(rows), sizeof(type), (foreign), (missing) }

/// A struct that is written, by its table, without what its bits leave out.
typedef struct fields_item {
    const field_table *table;
    const void *item;
    uint64_t bits;
} fields_item;

/// Writes the struct as an object.
void fields_write_json(FILE *file, const char *quote, fields_item item);
/// Writes the members alone: `before` stands before the first of them, a comma before all others. Returns what stands
/// before the next one.
const char *fields_write_members(FILE *file, const char *quote, const char *before, fields_item of);

/// Writes the names, or the values, of the columns that are chosen, as above; what is left out is empty.
const char *fields_write_csv_header(FILE *file, const char *before, const field_table *table, unsigned columns);
const char *fields_write_csv(FILE *file, const char *before, fields_item of, unsigned columns);

/// The name of an enum's field; "" where it has none.
const char *field_get_name(const field_names *names, const void *at);

/// Writes %.17g; null where it is not finite.
void json_write_number(FILE *file, double value);
void json_write_numbers(FILE *file, const double *numbers, size_t count);
/// A column of CSV.
void csv_write_number(FILE *file, double value);

/// Memory of lists that were read, and where a failure is.
typedef struct fields_reader {
    struct fields_block *blocks;
    const char *key; ///< of what is wrong
    char text[64];   ///< a sentence about it
    uint64_t bits;   ///< of each field that was there
    int is_memory_out;
} fields_reader;

/// Reads an object into a struct that holds the defaults: all keys of the table that need be, each of its kind, no
/// others. NULL, or what is wrong with reader->key.
const char *fields_read(fields_reader *reader, struct json_t *object, const field_table *table, void *item);

/// What is wrong where an object that was read has a field against `bits`, or lacks one; NULL: nothing.
const char *fields_compare(fields_reader *reader, const struct json_t *object, const field_table *table, uint64_t bits);

void fields_reader_clear(fields_reader *reader);

#endif
