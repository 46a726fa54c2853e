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
    check_bad();
    check_damaged_lines(POSES, GOOD "0,\"b, c\",1,2,3,1,0,0,0\n1,a,1,2,3,1,0,0,0\n", read_all);
    ovoid_scene_destroy(scene);
    return check_end();
}
