// MOTION.csv, read line by line: poses of bodies at times, or velocities from times on; the header decides. Strict:
// times never decrease, and a body has at most one line at each time, so that a frame is all lines of one time and
// their order does not matter. Linear in the file; memory: a number for each body of the scene.
//
// Of a frame that is skipped, only times and names are read. The last line of each body stays as a text. Bodies mostly
// come in the order of the frame before, so a name is first compared with that of the line that came next there.
#include "io/csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_MAX_BYTES = 4096, COLUMNS_MAX = 9 };

static const char *const headers[] = {"time,body,x,y,z,qw,qx,qy,qz", "time,body,vx,vy,vz,wx,wy,wz"};
static const char *const columns[][COLUMNS_MAX] = {{"time", "body", "x", "y", "z", "qw", "qx", "qy", "qz"},
                                                   {"time", "body", "vx", "vy", "vz", "wx", "wy", "wz"}};
static const int column_counts[] = {9, 8};

/// The last line of a body in frames that are skipped.
typedef struct skipped_line {
    char *text;
    size_t length, capacity;
    size_t name_at, name_end; ///< where the body's name stands in the text, with the comma behind it
    size_t next;              ///< the body of the line behind it, or NO_BODY
    int64_t line;
    int is_waiting; ///< it is to be read
} skipped_line;

/// A line of the file as it stands there, valid until the source reads on.
typedef struct raw_line {
    const char *text; ///< NULL: there is none
    size_t length;
} raw_line;

#define NO_BODY ((size_t)-1)

struct ovoid_motion_reader {
    line_source source;
    const ovoid_scene *scene;
    size_t body_count; ///< of the scene, which may be gone when the reader is closed
    ovoid_motion_columns kind;
    double time;           ///< of the last line; -infinity before it
    double *last_time;     ///< of each body's last line; -infinity: none yet
    uint64_t frames;       ///< that have begun
    int64_t line;          ///< number of the line that was read last
    raw_line last;         ///< that line, if it was not skipped
    raw_line ahead;        ///< the line behind the frames that were skipped
    skipped_line *skipped; ///< of each body; NULL: nothing was skipped yet
    size_t next_skipped;   ///< no body before it has a line that waits
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
    reader->body_count = count;
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

int64_t ovoid_motion_reader_get_line(const ovoid_motion_reader *reader) { return reader->line; }

uint64_t ovoid_motion_reader_get_frame_count(const ovoid_motion_reader *reader) { return reader->frames; }

void ovoid_motion_reader_close(ovoid_motion_reader *reader) {
    if (!reader) return;
    line_source_close(&reader->source);
    for (size_t i = 0; reader->skipped && i < reader->body_count; i++) free(reader->skipped[i].text);
    free(reader->skipped);
    free(reader->last_time);
    free(reader);
}

// ---- lines

static csv_line make_csv_line(const ovoid_motion_reader *r, raw_line raw, int64_t number, ovoid_error *error) {
    const where at = {r->source.path, number, -1};
    return (csv_line){raw.text, raw.text + raw.length, columns[r->kind], 0, column_counts[r->kind], at, error};
}

static ovoid_code read_time(const ovoid_motion_reader *r, csv_line *c, double *time) {
    ovoid_code code = csv_read_number(c, time);
    if (!code && *time < r->time)
        code = io_fail(c->error, OVOID_ERROR_FORMAT, c->place, "the time is before that of an earlier line: sort them");
    return code;
}

// Finds the body of r->name.
static ovoid_code find_body(const ovoid_motion_reader *r, const csv_line *c, size_t *body) {
    *body = ovoid_scene_find(r->scene, r->name);
    if (*body != NO_BODY) return OVOID_OK;
    return io_fail(c->error, OVOID_ERROR_FORMAT, c->place, "the scene has no object \"%.60s\"", r->name);
}

// A body has a line at a time, the first at that time.
static ovoid_code take_time(ovoid_motion_reader *r, const csv_line *c, double time, size_t body) {
    if (r->last_time[body] == time)
        return io_fail(c->error, OVOID_ERROR_FORMAT, c->place, "\"%.60s\" has a line at this time already",
                       ovoid_scene_get(r->scene, body).name);
    r->frames += time != r->time;
    r->time = r->last_time[body] = time;
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

// What is behind the time.
static ovoid_code read_rest(ovoid_motion_reader *r, csv_line *c, ovoid_motion_line *line) {
    double v[7] = {0};
    ovoid_code code = csv_read_text(c, r->name, sizeof r->name);
    for (int i = 2; i < column_counts[r->kind] && !code; i++) code = csv_read_number(c, &v[i - 2]);
    if (!code) code = find_body(r, c, &line->body);
    if (code) return code;
    return r->kind == OVOID_MOTION_COLUMNS_POSE ? set_pose(r, c, v, &line->pose) : set_velocity(r, c, v, line);
}

static ovoid_code read_line(ovoid_motion_reader *r, csv_line *c, ovoid_motion_line *line) {
    ovoid_code code = read_time(r, c, &line->time);
    if (!code) code = read_rest(r, c, line);
    return code ? code : take_time(r, c, line->time, line->body);
}

// The next line of the file, with its number in r->source.line. 1, 0 at the end, -1: *error is filled.
static int take_line(ovoid_motion_reader *r, raw_line *raw, ovoid_error *error) {
    *raw = r->ahead;
    r->ahead.text = NULL;
    return raw->text ? 1 : csv_next_line(&r->source, &raw->text, &raw->length, error);
}

// ---- frames that are skipped

// A line that was skipped, which is that of its body until the time of the frames skipped last.
static ovoid_code read_skipped(ovoid_motion_reader *r, skipped_line *skipped, ovoid_motion_line *line,
                               ovoid_error *error) {
    csv_line c = make_csv_line(r, (raw_line){skipped->text, skipped->length}, skipped->line, error);
    skipped->is_waiting = 0;
    r->line = skipped->line;
    ovoid_code code = csv_read_number(&c, &line->time);
    if (!code) code = read_rest(r, &c, line);
    line->time = r->time;
    return code;
}

// The first body with a line that waits, or NULL.
static skipped_line *find_waiting(ovoid_motion_reader *r) {
    size_t count = r->skipped ? r->body_count : 0;
    for (; r->next_skipped < count; r->next_skipped++)
        if (r->skipped[r->next_skipped].is_waiting) return &r->skipped[r->next_skipped];
    return NULL;
}

/// A line of a frame that is skipped.
typedef struct line_head {
    double time;
    size_t body;              ///< NO_BODY: there was no line yet
    size_t name_at, name_end; ///< as in a skipped_line
    char time_text[40];       ///< the time as it stands there, with the comma behind it
    size_t time_size;         ///< 0: it does not fit
} line_head;

// Reads the time of a line; the same text as in the line before is the same time.
static ovoid_code find_time(ovoid_motion_reader *r, csv_line *c, line_head *head) {
    const char *begin = c->at;
    if (head->time_size && head->time_size < (size_t)(c->end - begin) &&
        memcmp(begin, head->time_text, head->time_size) == 0) {
        c->at += head->time_size;
        c->column++;
        return OVOID_OK;
    }
    ovoid_code code = read_time(r, c, &head->time);
    size_t size = code ? 0 : (size_t)(c->at - begin);
    head->time_size = size <= sizeof head->time_text ? size : 0;
    memcpy(head->time_text, begin, head->time_size);
    return code;
}

// Finds the body of a line; the same text as that of the body that came next the last time is the same body.
static ovoid_code find_name(ovoid_motion_reader *r, csv_line *c, line_head *head, const char *begin) {
    size_t guess = head->body == NO_BODY ? NO_BODY : r->skipped[head->body].next;
    // A body whose line came first behind skipped frames may have none yet.
    const skipped_line *s = guess == NO_BODY || !r->skipped[guess].text ? NULL : &r->skipped[guess];
    size_t size = s ? s->name_end - s->name_at : 0;
    head->name_at = (size_t)(c->at - begin);
    if (s && size <= (size_t)(c->end - c->at) && memcmp(c->at, s->text + s->name_at, size) == 0) {
        head->body = guess;
        head->name_end = head->name_at + size;
        return OVOID_OK;
    }
    size_t before = head->body;
    ovoid_code code = csv_read_text(c, r->name, sizeof r->name);
    if (!code) code = find_body(r, c, &head->body);
    if (code) return code;
    head->name_end = (size_t)(c->at - begin);
    if (before != NO_BODY) r->skipped[before].next = head->body;
    return OVOID_OK;
}

// Reads time and name of a line that is skipped, head: those of the line before it.
static ovoid_code find_head(ovoid_motion_reader *r, csv_line *c, line_head *head) {
    const char *begin = c->at;
    ovoid_code code = find_time(r, c, head);
    return code ? code : find_name(r, c, head, begin);
}

// Keeps a line as the last one of its body.
static ovoid_code keep(ovoid_motion_reader *r, raw_line raw, const line_head *head, ovoid_error *error) {
    skipped_line *s = &r->skipped[head->body];
    if (s->capacity < raw.length) {
        char *grown = realloc(s->text, 2 * raw.length);
        if (!grown) return io_fail_memory(error, r->source.path);
        s->text = grown;
        s->capacity = 2 * raw.length;
    }
    memcpy(s->text, raw.text, raw.length);
    s->length = raw.length;
    s->name_at = head->name_at;
    s->name_end = head->name_end;
    s->line = r->source.line;
    s->is_waiting = 1;
    return OVOID_OK;
}

// Makes room for skipped lines, and keeps the line that was read last.
static ovoid_code begin_skipping(ovoid_motion_reader *r, line_head *head, ovoid_error *error) {
    if (!r->skipped) {
        r->skipped = calloc(r->body_count + 1, sizeof *r->skipped);
        if (!r->skipped) return io_fail_memory(error, r->source.path);
        for (size_t i = 0; i < r->body_count; i++) r->skipped[i].next = NO_BODY;
    }
    r->next_skipped = 0;
    raw_line last = r->last;
    r->last.text = NULL;
    if (!last.text) return OVOID_OK;
    csv_line c = make_csv_line(r, last, r->line, error);
    ovoid_code code = find_head(r, &c, head);
    return code ? code : keep(r, last, head, error);
}

// Counts the frames up to the end of the file, of which nothing is left to read.
static ovoid_code count_frames(ovoid_motion_reader *r, ovoid_error *error) {
    line_head head = {.body = NO_BODY};
    raw_line raw;
    int got = 0;
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; r->skipped && i < r->body_count; i++) r->skipped[i].is_waiting = 0;
    r->last.text = NULL;
    while (!code && (got = take_line(r, &raw, error)) > 0) {
        csv_line c = make_csv_line(r, raw, r->source.line, error);
        code = find_time(r, &c, &head);
        if (code) break;
        r->frames += head.time != r->time;
        r->time = head.time;
    }
    return got < 0 ? error->code : code;
}

ovoid_code ovoid_motion_reader_skip(ovoid_motion_reader *reader, uint64_t frame, ovoid_error *error) {
    ovoid_motion_reader *r = reader;
    ovoid_error own;
    if (!error) error = &own;
    if (frame == UINT64_MAX) return count_frames(r, error);
    if (r->frames > frame) return OVOID_OK;
    line_head head = {.body = NO_BODY};
    raw_line raw;
    int got = 0;
    ovoid_code code = begin_skipping(r, &head, error);
    while (!code && (got = take_line(r, &raw, error)) > 0) {
        csv_line c = make_csv_line(r, raw, r->source.line, error);
        code = find_head(r, &c, &head);
        if (!code && r->frames == frame && head.time != r->time) {
            r->ahead = raw;
            break;
        }
        if (!code) code = take_time(r, &c, head.time, head.body);
        if (!code) code = keep(r, raw, &head, error);
    }
    return got < 0 ? error->code : code;
}

int ovoid_motion_reader_read(ovoid_motion_reader *reader, ovoid_motion_line *line, ovoid_error *error) {
    raw_line raw;
    skipped_line *waiting = find_waiting(reader);
    *line = (ovoid_motion_line){.pose = ovoid_pose_make_identity()};
    if (waiting) return read_skipped(reader, waiting, line, error) ? -1 : 1;
    int got = take_line(reader, &raw, error);
    reader->last.text = NULL;
    if (got <= 0) return got;
    reader->line = reader->source.line;
    csv_line c = make_csv_line(reader, raw, reader->line, error);
    if (read_line(reader, &c, line)) return -1;
    reader->last = raw;
    return 1;
}
