// Frames: all lines of one time, read one time ahead. Poses stay until another line changes them; velocities are
// integrated exactly over each interval between two frames (ovoid_motion_compute_pose), from the pose at its beginning.
#include "base/frames.h"

#include "base/args.h"
#include "base/message.h"

#include <math.h>
#include <stdlib.h>

/// Reads the first line of the next frame. 0 at the end too; -1 after a message.
static int read_ahead(cli_frames *f) {
    ovoid_error error;
    int got = ovoid_motion_reader_read(f->reader, &f->line, &error);
    if (got < 0) message_error("%s", error.message);
    f->has_line = got > 0;
    return got;
}

static void *make_array(size_t count, size_t size) { return calloc(count + 1, size); }

int frames_open(cli_frames *f, const char *path, const ovoid_scene *scene) {
    ovoid_error error;
    size_t count = ovoid_scene_get_count(scene);
    *f = (cli_frames){.scene = scene, .path = path};
    f->reader = ovoid_motion_reader_open(path, scene, &error);
    if (!f->reader) return message_error("%s", error.message), EXIT_INPUT;
    int has_speed = ovoid_motion_reader_get_columns(f->reader) == OVOID_MOTION_COLUMNS_VELOCITY;
    f->poses = make_array(count, sizeof *f->poses);
    f->starts = make_array(count, sizeof *f->starts);
    f->moved = make_array(count, sizeof *f->moved);
    f->is_moved = make_array(count, 1);
    if (has_speed) {
        f->speed = make_array(count, sizeof *f->speed);
        f->used = make_array(count, sizeof *f->used);
    }
    int is_full = f->poses && f->starts && f->moved && f->is_moved && (!has_speed || (f->speed && f->used));
    if (!is_full) message_error("out of memory");
    if (!is_full || read_ahead(f) < 0) {
        frames_close(f);
        return EXIT_INPUT;
    }
    for (size_t i = 0; i < count; i++) f->poses[i] = f->starts[i] = ovoid_scene_get(scene, i).pose;
    return 0;
}

void frames_close(cli_frames *f) {
    ovoid_motion_reader_close(f->reader);
    free(f->poses);
    free(f->starts);
    free(f->speed);
    free(f->used);
    free(f->moved);
    free(f->is_moved);
    *f = (cli_frames){.path = NULL};
}

static void set_pose(cli_frames *f, size_t i, const ovoid_pose *pose) {
    f->poses[i] = *pose;
    if (f->is_moved[i]) return;
    f->is_moved[i] = 1;
    f->moved[f->moved_count++] = (uint32_t)i;
}

static int is_zero(const ovoid_vec3 v[2]) {
    return v[0].x == 0 && v[0].y == 0 && v[0].z == 0 && v[1].x == 0 && v[1].y == 0 && v[1].z == 0;
}

ovoid_motion frames_get_motion(const cli_frames *f, size_t object) {
    double duration = f->time - f->earlier;
    size_t i = object;
    if (!f->is_moved[i]) return ovoid_motion_make_still(f->starts[i]);
    if (f->used) return ovoid_motion_make_velocity(f->starts[i], f->used[i][0], f->used[i][1], duration);
    return ovoid_motion_make_poses(f->starts[i], f->poses[i], duration);
}

/// 1 if the object's motion to this frame is valid, or 0 after a message.
static int validate_motion(const cli_frames *f, size_t object, const ovoid_motion *motion) {
    ovoid_error error;
    if (ovoid_motion_validate(motion, &error) == OVOID_OK) return 1;
    message_error("%s: object \"%.60s\" from time %.9g to %.9g: %s", f->path, ovoid_scene_get(f->scene, object).name,
                  f->earlier, f->time, error.message);
    return 0;
}

int frames_validate_motions(const cli_frames *f) {
    for (size_t i = 0; i < f->moved_count; i++) {
        const ovoid_motion motion = frames_get_motion(f, f->moved[i]);
        if (!validate_motion(f, f->moved[i], &motion)) return EXIT_INPUT;
    }
    return 0;
}

/// Moves every object with a velocity to the time of the frame. 1, or -1 after a message.
static int integrate(cli_frames *f) {
    size_t count = ovoid_scene_get_count(f->scene);
    for (size_t i = 0; i < count; i++) {
        f->used[i][0] = f->speed[i][0];
        f->used[i][1] = f->speed[i][1];
        if (is_zero(f->used[i]) || !(f->time > f->earlier)) continue;
        ovoid_motion motion =
            ovoid_motion_make_velocity(f->starts[i], f->used[i][0], f->used[i][1], f->time - f->earlier);
        if (!validate_motion(f, i, &motion)) return -1;
        ovoid_pose pose = ovoid_motion_compute_pose(&motion, motion.duration);
        set_pose(f, i, &pose);
    }
    return 1;
}

int frames_skip(cli_frames *f, uint64_t frame) {
    ovoid_error error;
    int got = 1;
    if (f->speed) {
        while (f->count < frame && got > 0) got = frames_next(f);
        return got;
    }
    if (ovoid_motion_reader_skip(f->reader, frame, &error)) return message_error("%s", error.message), -1;
    if (read_ahead(f) < 0) return -1;
    // The lines that were kept are those of one frame, which frames_next counts.
    f->count = (size_t)frame - 1;
    return frames_next(f);
}

int frames_count(const char *path, const ovoid_scene *scene, uint64_t *count) {
    ovoid_error error;
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, &error);
    ovoid_code code = reader ? ovoid_motion_reader_skip(reader, UINT64_MAX, &error) : error.code;
    if (code)
        message_error("%s", error.message);
    else
        *count = ovoid_motion_reader_get_frame_count(reader);
    ovoid_motion_reader_close(reader);
    return code ? EXIT_INPUT : 0;
}

int frames_next(cli_frames *f) {
    if (!f->has_line) return 0;
    // The present frame becomes the previous one.
    for (size_t i = 0; i < f->moved_count; i++) {
        f->starts[f->moved[i]] = f->poses[f->moved[i]];
        f->is_moved[f->moved[i]] = 0;
    }
    f->moved_count = 0;
    f->earlier = f->count ? f->time : f->line.time;
    f->time = f->line.time;
    if (f->speed && integrate(f) < 0) return -1;
    while (f->has_line && f->line.time == f->time) {
        size_t i = f->line.body;
        if (f->speed)
            f->speed[i][0] = f->line.linear, f->speed[i][1] = f->line.angular;
        else
            set_pose(f, i, &f->line.pose);
        if (read_ahead(f) < 0) return -1;
    }
    f->count++;
    return 1;
}
