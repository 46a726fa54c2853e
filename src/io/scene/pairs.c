// PAIRS.csv, read line by line: two shapes and their poses. Linear in the file, constant memory.
#include "io/csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const header = "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz";

enum { COLUMNS = 16 };
static const char *const columns[COLUMNS] = {"a",   "b",  "ax", "ay", "az",  "aqw", "aqx", "aqy",
                                             "aqz", "bx", "by", "bz", "bqw", "bqx", "bqy", "bqz"};

struct ovoid_pairs_reader {
    line_source source;
    size_t shape_count;
};

static where here(const ovoid_pairs_reader *reader) { return (where){reader->source.path, reader->source.line, -1}; }

ovoid_pairs_reader *ovoid_pairs_reader_create(const char *path, size_t shape_count, ovoid_error *error) {
    ovoid_pairs_reader *reader = calloc(1, sizeof *reader);
    if (!reader) {
        io_fail_memory(error, path);
        return NULL;
    }
    reader->shape_count = shape_count;
    ovoid_code code = line_source_open(&reader->source, path, error);
    if (!code && csv_read_header(&reader->source, &header, 1, error) == 0) return reader;
    ovoid_pairs_reader_destroy(reader);
    return NULL;
}

void ovoid_pairs_reader_destroy(ovoid_pairs_reader *reader) {
    if (!reader) return;
    line_source_close(&reader->source);
    free(reader);
}

static ovoid_code read_index(ovoid_pairs_reader *reader, double value, char column, size_t *index, ovoid_error *error) {
    if (!(value >= 0) || value >= (double)reader->shape_count || value != floor(value))
        return io_fail(error, OVOID_ERROR_INDEX, here(reader), "column %c: there is no shape %.17g; the list has %zu",
                       column, value, reader->shape_count);
    *index = (size_t)value;
    return OVOID_OK;
}

static ovoid_code read_pose(ovoid_pairs_reader *reader, const double v[7], char body, ovoid_pose *pose,
                            ovoid_error *error) {
    *pose = (ovoid_pose){{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
    ovoid_code code = ovoid_pose_compute_check(pose);
    if (!code) return code;
    return io_fail(error, code, here(reader), "the pose of %c has %s", body,
                   code == OVOID_ERROR_ROTATION ? "a quaternion of four zeros" : "a number out of range");
}

int ovoid_pairs_reader_read(ovoid_pairs_reader *reader, ovoid_indexed_pair *pair, ovoid_error *error) {
    const char *line;
    size_t length;
    int got = csv_next_line(&reader->source, &line, &length, error);
    if (got <= 0) return got;
    double v[COLUMNS];
    csv_line columns_left = {line, line + length, columns, 0, COLUMNS, here(reader), error};
    ovoid_code code = OVOID_OK;
    for (int i = 0; i < COLUMNS && !code; i++) code = csv_read_number(&columns_left, &v[i]);
    if (!code) code = read_index(reader, v[0], 'a', &pair->a, error);
    if (!code) code = read_index(reader, v[1], 'b', &pair->b, error);
    if (!code) code = read_pose(reader, v + 2, 'a', &pair->pose_a, error);
    if (!code) code = read_pose(reader, v + 9, 'b', &pair->pose_b, error);
    return code ? -1 : 1;
}
