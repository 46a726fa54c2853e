// Motions of a scene.
#include "fuzz.h"

#include <ovoid/io.h>

#include <math.h>

static const char scene_text[] = "{\"objects\":[{\"name\":\"a\",\"sphere\":1},{\"name\":\"b, c\",\"sphere\":1}]}";

// What was read so far: the last pose of each body, and the time.
typedef struct motion_state {
    ovoid_motion_line last[2];
    int has[2];
} motion_state;

// 1 if both poses have the same seven numbers.
static int is_same_pose(const ovoid_pose *a, const ovoid_pose *b) {
    const ovoid_vec3 p = a->position, q = b->position;
    const ovoid_quat r = a->rotation, s = b->rotation;
    return p.x == q.x && p.y == q.y && p.z == q.z && r.w == s.w && r.x == s.x && r.y == s.y && r.z == s.z;
}

// Frames are counted as they are read.
static void check_count(const ovoid_scene *scene, const char *path) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_motion_reader *whole = ovoid_motion_reader_open(path, scene, &error);
    ovoid_motion_reader *counted = ovoid_motion_reader_open(path, scene, &error);
    ovoid_motion_line line;
    while (ovoid_motion_reader_read(whole, &line, &error) == 1) continue;
    fuzz_require(ovoid_motion_reader_skip(counted, UINT64_MAX, &error) == OVOID_OK);
    fuzz_require(ovoid_motion_reader_get_frame_count(counted) == ovoid_motion_reader_get_frame_count(whole));
    fuzz_require(ovoid_motion_reader_read(counted, &line, &error) == 0);
    ovoid_motion_reader_close(whole);
    ovoid_motion_reader_close(counted);
}

// A motion that is read without errors is the same where its first frames are skipped.
static void check_skip(const ovoid_scene *scene, const char *path, uint64_t frame) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_motion_reader *whole = ovoid_motion_reader_open(path, scene, &error);
    ovoid_motion_reader *part = ovoid_motion_reader_open(path, scene, &error);
    motion_state wanted = {0}, found = {0};
    fuzz_require(ovoid_motion_reader_skip(part, frame, &error) == OVOID_OK);
    uint64_t skipped = ovoid_motion_reader_get_frame_count(part);
    fuzz_require(skipped <= frame);
    ovoid_motion_line line;
    int got = 1;
    while (got == 1 && (got = ovoid_motion_reader_read(whole, &line, &error)) == 1) {
        if (ovoid_motion_reader_get_frame_count(whole) > frame) break;
        wanted.last[line.body] = line;
        wanted.has[line.body] = 1;
    }
    double time = got == 1 ? line.time : INFINITY;
    // All lines of the part before that time, in one.
    ovoid_motion_line next = line;
    int more = 1;
    while (more == 1 && (more = ovoid_motion_reader_read(part, &next, &error)) == 1 && next.time < time) {
        found.last[next.body] = next;
        found.has[next.body] = 1;
    }
    fuzz_require(more == got && (got != 1 || (next.body == line.body && next.time == line.time)));
    for (int b = 0; b < 2; b++) {
        fuzz_require(found.has[b] == wanted.has[b]);
        fuzz_require(is_same_pose(&found.last[b].pose, &wanted.last[b].pose));
    }
    ovoid_motion_reader_close(whole);
    ovoid_motion_reader_close(part);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const void *text = scene_text;
    ovoid_scene *scene = ovoid_scene_read(fuzz_write_file("motion.json", text, sizeof scene_text - 1), NULL, &error);
    fuzz_require(scene != NULL);
    const char *path = fuzz_write_file("motion.csv", data, size);
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, &error);
    ovoid_motion_line line;
    double time = -INFINITY;
    int got = reader ? 1 : -1;
    while (got == 1 && (got = ovoid_motion_reader_read(reader, &line, &error)) == 1) {
        fuzz_require(line.body < 2 && line.time >= time && isfinite(line.time));
        fuzz_require(ovoid_pose_validate(&line.pose) == OVOID_OK);
        time = line.time;
    }
    if (got < 0) fuzz_require_error(&error);
    ovoid_motion_reader_close(reader);
    // The first frames, some, and all.
    for (uint64_t frame = 0; got == 0 && frame < 4; frame++) check_skip(scene, path, frame);
    if (got == 0) check_count(scene, path);
    ovoid_scene_destroy(scene);
    return 0;
}
