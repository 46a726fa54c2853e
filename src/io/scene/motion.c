// MOTION.csv, read line by line: poses of bodies at times, or velocities from times on; the header decides. Strict:
// times never decrease, and a body has at most one line at each time, so that a frame is all lines of one time and
// their order does not matter. Linear in the file; memory: a number for each body of the scene.
#include "io/csv.h"

#include <math.h>
#include <stdlib.h>

enum { NAME_MAX_BYTES = 4096, COLUMNS_MAX = 9 };

static const char *const headers[] = {"time,body,x,y,z,qw,qx,qy,qz", "time,body,vx,vy,vz,wx,wy,wz"};
static const char *const columns[][COLUMNS_MAX] = {{"time", "body", "x", "y", "z", "qw", "qx", "qy", "qz"},
                                                   {"time", "body", "vx", "vy", "vz", "wx", "wy", "wz"}};
static const int column_counts[] = {9, 8};

struct ovoid_motion_reader {
    line_source source;
    const ovoid_scene *scene;
    ovoid_motion_columns kind;
    double time;       ///< of the last line; -infinity before it
    double *last_time; ///< of each body's last line; -infinity: none yet
    char name[NAME_MAX_BYTES];
};

ovoid_motion_reader *ovoid_motion_reader_open(const char *path, const ovoid_scene *scene, ovoid_error *error) {
    size_t count = ovoid_scene_get_count(scene);
    ovoid_motion_reader *reader = calloc(1, sizeof *reader);
    double *last_time = malloc((count + 1) * sizeof *last_time);
    if (!reader || !last_time) {
        free(reader);
        free(last_time);
        io_fail_memory(error, path);
        return NULL;
    }
    for (size_t i = 0; i < count; i++) last_time[i] = -INFINITY;
    reader->scene = scene;
    reader->time = -INFINITY;
    reader->last_time = last_time;
    if (!line_source_open(&reader->source, path, error)) {
        int kind = csv_read_header(&reader->source, headers, 2, error);
        reader->kind = kind == 1 ? OVOID_MOTION_COLUMNS_VELOCITY : OVOID_MOTION_COLUMNS_POSE;
        if (kind >= 0) return reader;
    }
    ovoid_motion_reader_close(reader);
    return NULL;
}

ovoid_motion_columns ovoid_motion_reader_get_columns(const ovoid_motion_reader *reader) { return reader->kind; }

int64_t ovoid_motion_reader_get_line(const ovoid_motion_reader *reader) { return reader->source.line; }

void ovoid_motion_reader_close(ovoid_motion_reader *reader) {
    if (!reader) return;
    line_source_close(&reader->source);
    free(reader->last_time);
    free(reader);
}

// Finds the body of that name; an error where it has a line at this time already.
static ovoid_code find_body(ovoid_motion_reader *r, const csv_line *c, double time, size_t *body) {
    *body = ovoid_scene_find(r->scene, r->name);
    if (*body == (size_t)-1)
        return io_fail(c->error, OVOID_ERROR_FORMAT, c->place, "the scene has no object \"%.60s\"", r->name);
    if (r->last_time[*body] == time)
        return io_fail(c->error, OVOID_ERROR_FORMAT, c->place, "\"%.60s\" has a line at this time already", r->name);
    return OVOID_OK;
}

static ovoid_code set_pose(const ovoid_motion_reader *r, const csv_line *c, const double v[7], ovoid_pose *pose) {
    *pose = (ovoid_pose){{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
    ovoid_code code = ovoid_pose_validate(pose);
    if (!code) return code;
    return io_fail(c->error, code, c->place, "the pose of \"%.60s\" has %s", r->name,
                   code == OVOID_ERROR_ROTATION ? "a quaternion of four zeros" : "a number out of range");
}

static ovoid_code set_velocity(const ovoid_motion_reader *r, const csv_line *c, const double v[6],
                               ovoid_motion_line *line) {
    for (int i = 0; i < 6; i++)
        if (fabs(v[i]) > OVOID_LENGTH_MAX)
            return io_fail(c->error, OVOID_ERROR_RANGE, c->place, "the velocity of \"%.60s\" has a number above %g",
                           r->name, OVOID_LENGTH_MAX);
    line->linear = (ovoid_vec3){v[0], v[1], v[2]};
    line->angular = (ovoid_vec3){v[3], v[4], v[5]};
    return OVOID_OK;
}

static ovoid_code read_line(ovoid_motion_reader *r, csv_line *c, ovoid_motion_line *line) {
    double v[7] = {0};
    int count = column_counts[r->kind];
    *line = (ovoid_motion_line){.pose = ovoid_pose_make_identity()};
    ovoid_code code = csv_read_number(c, &line->time);
    if (!code && line->time < r->time)
        code = io_fail(c->error, OVOID_ERROR_FORMAT, c->place, "the time is before that of an earlier line: sort them");
    if (!code) code = csv_read_text(c, r->name, sizeof r->name);
    for (int i = 2; i < count && !code; i++) code = csv_read_number(c, &v[i - 2]);
    if (!code) code = find_body(r, c, line->time, &line->body);
    if (code) return code;
    code = r->kind == OVOID_MOTION_COLUMNS_POSE ? set_pose(r, c, v, &line->pose) : set_velocity(r, c, v, line);
    if (code) return code;
    r->time = r->last_time[line->body] = line->time;
    return OVOID_OK;
}

int ovoid_motion_reader_read(ovoid_motion_reader *reader, ovoid_motion_line *line, ovoid_error *error) {
    const char *text;
    size_t length;
    int got = csv_next_line(&reader->source, &text, &length, error);
    if (got <= 0) return got;
    where at = {reader->source.path, reader->source.line, -1};
    csv_line c = {text, text + length, columns[reader->kind], 0, column_counts[reader->kind], at, error};
    return read_line(reader, &c, line) ? -1 : 1;
}
