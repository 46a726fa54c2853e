// MOTION.csv. Truth: texts written here; the table of bad ones says of each by name which error it must give and in
// which line.
#define FILES_FOLDER "test_io_motion"
#include "files.h"

#define POSES "time,body,x,y,z,qw,qx,qy,qz\n"
#define VELOCITIES "time,body,vx,vy,vz,wx,wy,wz\n"
#define GOOD "0,a,1,2,3,1,0,0,0\n"

static const char scene_text[] =
    "{\"objects\": [{\"name\": \"a\", \"sphere\": 1}, {\"name\": \"b, c\", \"sphere\": 1},\n"
    "{\"name\": \"say \\\"so\\\"\", \"sphere\": 1}, {\"name\": \" d\", \"sphere\": 1}]}";

static ovoid_scene *scene;

static void check_poses(void) {
    const char *path =
        file_write_text("poses.csv", POSES GOOD "\n 0 ,\t\"b, c\" ,-1e-3,+2.5,0,0,2,0,0\r\n\r\n"
                                                "0.5,\"say \"\"so\"\"\",0,0,0,1,0,0,0\n"
                                                "0.5,a,4,5,6,0.5,.5,0.5,-0.5\n0.5,\" d\",0,0,0,1,0,0,0.1");
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, &error);
    if (!CHECK(reader != NULL)) return;
    CHECK_EQ(ovoid_motion_reader_get_columns(reader), OVOID_MOTION_COLUMNS_POSE);
    ovoid_motion_line l;
    int got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 1 && l.time == 0 && l.body == 0 && l.pose.position.z == 3 && l.pose.rotation.w == 1);
    CHECK_EQ(ovoid_motion_reader_get_line(reader), 2);
    got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 1 && l.time == 0 && l.body == 1 && l.pose.position.x == -1e-3 && l.pose.rotation.x == 2);
    got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 1 && l.time == 0.5 && l.body == 2 && l.linear.x == 0 && l.angular.z == 0);
    CHECK_EQ(ovoid_motion_reader_get_line(reader), 6);
    got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 1 && l.time == 0.5 && l.body == 0 && l.pose.position.y == 5 && l.pose.rotation.z == -0.5);
    got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 1 && l.body == 3 && l.pose.rotation.z == 0.1);
    got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 0 && error.code == OVOID_OK);
    ovoid_motion_reader_close(reader);
}

static void check_velocities(void) {
    const char *path = file_write_text("velocities.csv", VELOCITIES "-2,a,1,2,3,4,5,6\n1e3,a,0,0,0,0,0,0\n");
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, &error);
    if (!CHECK(reader != NULL)) return;
    CHECK_EQ(ovoid_motion_reader_get_columns(reader), OVOID_MOTION_COLUMNS_VELOCITY);
    ovoid_motion_line l;
    int got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 1 && l.time == -2 && l.body == 0 && l.linear.x == 1 && l.linear.z == 3 && l.angular.z == 6);
    CHECK(l.pose.rotation.w == 1); // a pose that is none, but no broken one
    got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK(got == 1 && l.time == 1000);
    got = ovoid_motion_reader_read(reader, &l, &error);
    CHECK_EQ(got, 0);
    ovoid_motion_reader_close(reader);
}

// ---- frames that are skipped; truth: all lines, read one by one

enum { BODIES = 4, FRAMES = 12, LINES_MAX = BODIES * FRAMES };

// A motion in which bodies come in different orders, not all in each frame; one time is written in several ways. Each x
// is the number of the line.
static const char *write_random(uint64_t *s) {
    static const char *const names[] = {"a", "\"b, c\"", "\"say \"\"so\"\"\"", "\" d\""};
    static const char *const halves[] = {".5", "5e-1", ".500", ".5 "};
    static char text[20000];
    size_t n = (size_t)snprintf(text, sizeof text, POSES);
    int number = 2;
    for (int f = 0; f < FRAMES; f++) {
        int first = (int)(random_next(s) % BODIES), step = random_next(s) % 2 ? 1 : 3;
        for (int i = 0; i < BODIES; i++) {
            int body = (first + i * step) % BODIES;
            if (i && random_next(s) % 3 == 0) continue;
            int has_blank = random_next(s) % 5 == 0;
            n += (size_t)snprintf(text + n, sizeof text - n, "%d%s,%s,%d,%d,-0.25,1,0,0,%d%s\n", f,
                                  f % 2 ? "" : halves[i], names[body], number, body, i, has_blank ? "\r\n" : "");
            number += 1 + has_blank;
        }
    }
    return file_write_text("skip.csv", text);
}

// The lines, and the number of each one's frame.
static size_t read_lines(const char *path, ovoid_motion_line *lines, uint64_t *frames) {
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, NULL);
    size_t count = 0;
    while (count < LINES_MAX && ovoid_motion_reader_read(reader, &lines[count], NULL) == 1)
        frames[count++] = ovoid_motion_reader_get_frame_count(reader) - 1;
    ovoid_motion_reader_close(reader);
    return count;
}

// 1 if both poses have the same seven numbers.
static int is_same_pose(const ovoid_pose *a, const ovoid_pose *b) {
    const ovoid_vec3 p = a->position, q = b->position;
    const ovoid_quat r = a->rotation, s = b->rotation;
    return p.x == q.x && p.y == q.y && p.z == q.z && r.w == s.w && r.x == s.x && r.y == s.y && r.z == s.z;
}

/// What a reader is to say next.
typedef struct model {
    ovoid_motion_line lines[LINES_MAX];
    uint64_t frames[LINES_MAX]; ///< of each line
    size_t count, at;           ///< all lines; those that were read or skipped
    const ovoid_motion_line *last, *waiting[BODIES];
} model;

static void skip_frames(model *m, uint64_t frame) {
    if (frame == UINT64_MAX) {
        m->last = NULL;
        memset(m->waiting, 0, sizeof m->waiting);
        m->at = m->count;
        return;
    }
    if (m->at && m->frames[m->at - 1] >= frame) return;
    if (m->last) m->waiting[m->last->body] = m->last;
    m->last = NULL;
    for (; m->at < m->count && m->frames[m->at] < frame; m->at++) m->waiting[m->lines[m->at].body] = &m->lines[m->at];
}

// The next line, and its time; NULL at the end.
static const ovoid_motion_line *next_line(model *m, double *time) {
    m->last = NULL;
    for (int b = 0; b < BODIES; b++) {
        const ovoid_motion_line *line = m->waiting[b];
        if (!line) continue;
        m->waiting[b] = NULL;
        *time = m->lines[m->at - 1].time;
        return line;
    }
    if (m->at == m->count) return NULL;
    m->last = &m->lines[m->at++];
    *time = m->last->time;
    return m->last;
}

// Reads and skips in any order up to the end.
static void check_random(const char *path, uint64_t *s) {
    static model m;
    m = (model){.last = NULL};
    m.count = read_lines(path, m.lines, m.frames);
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, NULL);
    const ovoid_motion_line *wanted = NULL;
    do {
        if (random_next(s) % 4 == 0) {
            uint64_t frame = random_next(s) % 40 ? random_next(s) % (FRAMES + 2) : UINT64_MAX;
            // Mostly the next ones.
            if (random_next(s) % 2) frame = (m.at ? m.frames[m.at - 1] : 0) + random_next(s) % 3;
            CHECK_EQ(ovoid_motion_reader_skip(reader, frame, NULL), OVOID_OK);
            skip_frames(&m, frame);
        }
        ovoid_motion_line l;
        double time = 0;
        wanted = next_line(&m, &time);
        CHECK_EQ(ovoid_motion_reader_read(reader, &l, NULL), wanted != NULL);
        CHECK_EQ(ovoid_motion_reader_get_frame_count(reader), m.at ? m.frames[m.at - 1] + 1 : 0);
        if (wanted) CHECK(l.body == wanted->body && is_same_pose(&l.pose, &wanted->pose) && l.time == time);
        if (m.last) CHECK_EQ(ovoid_motion_reader_get_line(reader), (int64_t)l.pose.position.x);
    } while (wanted);
    ovoid_motion_reader_close(reader);
}

static void check_skips(void) {
    uint64_t s = 5;
    for (int i = 0; i < 500; i++) {
        check_seed = s;
        const char *path = write_random(&s);
        for (int k = 0; k < 5; k++) check_random(path, &s);
    }
    check_seed = 0;
    // Velocities are skipped alike.
    ovoid_motion_reader *reader = ovoid_motion_reader_open(
        file_write_text("skip_speeds.csv", VELOCITIES "0,a,1,0,0,0,0,0\n1,a,2,0,0,0,0,0\n2,a,3,0,0,0,0,0\n"), scene,
        NULL);
    ovoid_motion_line l;
    CHECK_EQ(ovoid_motion_reader_skip(reader, 2, NULL), OVOID_OK);
    CHECK(ovoid_motion_reader_read(reader, &l, NULL) == 1 && l.time == 1 && l.linear.x == 2);
    CHECK_EQ(ovoid_motion_reader_get_line(reader), 3);
    ovoid_motion_reader_close(reader);
}

// What skipping refuses; what it leaves to reading: 0 there.
static const struct {
    const char *text;
    int64_t skipping, reading; ///< the line of the error; 0: none
    const char *what;
} bad_skips[] = {
    {POSES GOOD "0,b\n1,a,0,0,0,1,0,0,0\n", 3, 0, "fewer"},
    {POSES GOOD "0,nobody,1\n1,a,0,0,0,1,0,0,0\n", 3, 0, "no object \"nobody\""},
    {POSES GOOD GOOD "1,a,0,0,0,1,0,0,0\n", 3, 0, "a line at this time already"},
    {POSES GOOD "0.0,a,4,4,4,1,0,0,0\n", 3, 0, "a line at this time already"},
    {POSES GOOD "-1,a,4,4,4,1,0,0,0\n", 3, 0, "sort them"},
    {POSES GOOD "nan,a,4,4,4,1,0,0,0\n", 3, 0, "not finite"},
    {POSES GOOD "\n0,\"b, c\",1,2,three,1,0,0,0\n1,a,4,4,4,1,0,0,0\n", 0, 4, "\"three\""},
    {POSES GOOD "0,\"b, c\",1,2,3\n1,a,4,4,4,1,0,0,0\n", 0, 3, "fewer"},
    {POSES GOOD "1,a,4,4,4,0,0,0,0\n2,a,4,4,4,1,0,0,0\n", 0, 3, "quaternion of four zeros"},
    {POSES "0,a,no,2,3,1,0,0,0\n1,a,4,4,4,1,0,0,0\n2,a,4,4,4,1,0,0,0\n", 0, 0, ""},
};

static void check_bad_skips(void) {
    // Counting reads the times alone.
    ovoid_error wrong;
    ovoid_motion_reader *counting = ovoid_motion_reader_open(
        file_write_text("count.csv", POSES GOOD "0,nobody\n1,a,x\n1.0,a,y\n2,b\n"), scene, NULL);
    CHECK_EQ(ovoid_motion_reader_skip(counting, UINT64_MAX, NULL), OVOID_OK);
    CHECK_EQ(ovoid_motion_reader_get_frame_count(counting), 3);
    ovoid_motion_reader_close(counting);
    counting = ovoid_motion_reader_open(file_write_text("count.csv", POSES GOOD "1,a\n0,a\n"), scene, NULL);
    CHECK_EQ(ovoid_motion_reader_skip(counting, UINT64_MAX, &wrong), OVOID_ERROR_FORMAT);
    CHECK(wrong.place == 4 && strstr(wrong.message, "sort them"));
    ovoid_motion_reader_close(counting);
    for (size_t i = 0; i < sizeof bad_skips / sizeof *bad_skips; i++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_motion_line l;
        ovoid_motion_reader *reader =
            ovoid_motion_reader_open(file_write_text("bad_skip.csv", bad_skips[i].text), scene, &error);
        ovoid_code code = ovoid_motion_reader_skip(reader, 2, &error);
        if (!CHECK(code == (bad_skips[i].skipping ? error.code : OVOID_OK) &&
                   (code != OVOID_OK) == (bad_skips[i].skipping > 0)))
            printf("  case %zu\n", i);
        int got = 1;
        while (!code && got == 1) got = ovoid_motion_reader_read(reader, &l, &error);
        CHECK_EQ(got<0, bad_skips[i].reading> 0);
        int64_t line = bad_skips[i].skipping + bad_skips[i].reading;
        if (line && !CHECK(error.place == line && strstr(error.message, bad_skips[i].what)))
            printf("  %s\n", error.message);
        ovoid_motion_reader_close(reader);
    }
}

static const bad_input bad_files[] = {
    {"m_empty.csv", "", 1, "the file is empty", OVOID_ERROR_EMPTY},
    {"m_header.csv", "time,body\n", 1, "the first line must be time,body,x,y,z,qw,qx,qy,qz, or"},
    {"m_no_header.csv", GOOD, 1, "the first line must be"},
    {"m_few.csv", POSES GOOD "1,a,2\n", 3, "fewer than 9 columns"},
    {"m_one.csv", POSES "1\n", 2, "fewer than 9 columns"},
    {"m_many.csv", VELOCITIES "0,a,1,2,3,4,5,6,7\n", 2, "more than 8 columns"},
    {"m_word.csv", POSES "0,a,1,2,three,1,0,0,0\n", 2, "column z: \"three\""},
    {"m_blank.csv", POSES "0,a,1,,3,1,0,0,0\n", 2, "column y: \"\" is not a number"},
    {"m_time.csv", POSES "noon,a,1,2,3,1,0,0,0\n", 2, "column time: \"noon\""},
    {"m_nan_time.csv", POSES GOOD "nan,a,1,2,3,1,0,0,0\n", 3, "column time is not finite", OVOID_ERROR_NOT_FINITE},
    {"m_order.csv", POSES GOOD "1,a,1,2,3,1,0,0,0\n0.5,a,1,2,3,1,0,0,0\n", 4, "sort them"},
    {"m_twice.csv", POSES GOOD "0,b\n0,a,1,2,3,1,0,0,0\n", 3, "fewer"},
    {"m_again.csv", POSES GOOD "\n0,a,1,2,3,1,0,0,0\n", 4, "\"a\" has a line at this time already"},
    {"m_body.csv", POSES GOOD "0,nobody,1,2,3,1,0,0,0\n", 3, "the scene has no object \"nobody\""},
    {"m_no_body.csv", POSES "0,,1,2,3,1,0,0,0\n", 2, "column body: is empty"},
    {"m_quote.csv", POSES "0,\"a,1,2,3,1,0,0,0\n", 2, "closing quote is missing"},
    {"m_behind.csv", POSES "0,\"a\" b,1,2,3,1,0,0,0\n", 2, "follows the closing quote"},
    {"m_within.csv", POSES "0,a\"b,1,2,3,1,0,0,0\n", 2, "a quote within a text"},
    {"m_nan.csv", POSES "0,a,nan,2,3,1,0,0,0\n", 2, "column x is not finite", OVOID_ERROR_NOT_FINITE},
    {"m_infinite.csv", VELOCITIES "0,a,1,2,3,1,0,1e999\n", 2, "column wz is not finite", OVOID_ERROR_NOT_FINITE},
    {"m_zero.csv", POSES "0,a,1,2,3,0,0,0,0\n", 2, "pose of \"a\" has a quaternion of four", OVOID_ERROR_ROTATION},
    {"m_far.csv", POSES "0,a,1e99,2,3,1,0,0,0\n", 2, "pose of \"a\" has a number out of range", OVOID_ERROR_RANGE},
    {"m_fast.csv", VELOCITIES "0,a,1,2,3,1,0,-1e99\n", 2, "velocity of \"a\" has a number above", OVOID_ERROR_RANGE},
};

static int read_all(const char *path, ovoid_error *error) {
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, error);
    ovoid_motion_line line;
    int got = reader ? 1 : -1;
    while (got == 1) got = ovoid_motion_reader_read(reader, &line, error);
    ovoid_motion_reader_close(reader);
    return got;
}

static int accepts(const char *path, ovoid_error *error) { return read_all(path, error) != -1; }

static void check_bad(void) {
    check_bad_inputs(bad_files, sizeof bad_files / sizeof *bad_files, accepts);
    ovoid_error error;
    CHECK(read_all(file_path("absent.csv"), &error) == -1 && error.code == OVOID_ERROR_FILE);
    CHECK(read_all(OVOID_BUILD_DIR, NULL) == -1);
    // A zero byte, which would end a name early; a name that is longer than any.
    static const char zero[] = POSES "0,a\0b,1,2,3,1,0,0,0\n";
    CHECK(read_all(file_write("m_zero_byte.csv", zero, sizeof zero - 1), &error) == -1 &&
          strstr(error.message, "zero byte"));
    static char text[6000];
    snprintf(text, sizeof text, "%s0,%05000d,1,2,3,1,0,0,0\n", POSES, 1);
    CHECK(read_all(file_write_text("m_long.csv", text), &error) == -1 && strstr(error.message, "too long"));
}

int main(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    scene = ovoid_scene_read(file_write_text("motion_scene.json", scene_text), NULL, &error);
    if (!CHECK(scene != NULL)) return check_end();
    check_poses();
    check_velocities();
    check_skips();
    check_bad_skips();
    check_bad();
    check_damaged_lines(POSES, GOOD "0,\"b, c\",1,2,3,1,0,0,0\n1,a,1,2,3,1,0,0,0\n", read_all);
    ovoid_scene_destroy(scene);
    return check_end();
}
