// The frames of a motion: the poses of a scene's objects at successive times of a MOTION.csv.
#ifndef OVOID_CLI_BASE_FRAMES_H
#define OVOID_CLI_BASE_FRAMES_H

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

/// The motion of a scene's objects, frame by frame. The arrays are indexed by object and owned here.
typedef struct cli_frames {
    const ovoid_scene *scene;
    const char *path;
    ovoid_motion_reader *reader;
    ovoid_motion_line line; ///< the first line of the next frame, if has_line
    int has_line;
    size_t count;           ///< of frames so far
    double time, earlier;   ///< of this frame and of the one before; the first frame has its own time for both
    ovoid_pose *poses;      ///< in this frame
    ovoid_pose *starts;     ///< in the frame before
    ovoid_vec3 (*speed)[2]; ///< linear and angular, from this frame on; NULL if the file has poses
    ovoid_vec3 (*used)[2];  ///< linear and angular, from the frame before to this one
    uint32_t *moved;        ///< objects whose pose differs from that of the frame before
    unsigned char *is_moved;
    size_t moved_count;
} cli_frames;

/// Opens the file. 0, or EXIT_INPUT after a message, with nothing left open.
int frames_open(cli_frames *frames, const char *path, const ovoid_scene *scene);

/// Reads the next frame. 1, 0 at the end, or -1 after a message.
int frames_next(cli_frames *frames);

/// Goes on to the frame before number `frame`, counted from 0, from an earlier one. As frames_next, but `starts` are
/// not those of the frame before. Poses that are not needed are not read; velocities are integrated from frame to
/// frame.
int frames_skip(cli_frames *frames, uint64_t frame);

/// Counts the frames of a file, which is read once. 0, or EXIT_INPUT after a message.
int frames_count(const char *path, const ovoid_scene *scene, uint64_t *count);

/// The motion of an object from the frame before (time 0) to this one (time: the difference of both).
ovoid_motion frames_get_motion(const cli_frames *frames, size_t object);

/// Refuses motions from the frame before to this one that queries refuse, for instance over more than 1e100 of time. 0,
/// or EXIT_INPUT after a message.
int frames_validate_motions(const cli_frames *frames);

void frames_close(cli_frames *frames);

#endif
