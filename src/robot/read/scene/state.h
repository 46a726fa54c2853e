// What a planning scene of MoveIt says beside its obstacles: the state that it was made in, frames, paddings of links
// and which collisions are allowed. state.c reads it, place.c puts it into a cell.
#ifndef OVOID_ROBOT_READ_SCENE_STATE_H
#define OVOID_ROBOT_READ_SCENE_STATE_H

#include "robot/read/scene/message.h"

/// A frame that is fixed in the model's.
typedef struct scene_frame {
    const char *name;
    ovoid_pose pose;
} scene_frame;

/// The numbers of a joint as its variables have them; of a multi-DOF joint x, y, z and the quaternion w, x, y, z.
typedef struct scene_joint {
    const char *name;
    int is_multiple;
    double values[7];
    int64_t line;
} scene_joint;

typedef struct scene_padding {
    const char *link;
    double padding;
    int64_t line;
} scene_padding;

/// Which collisions are allowed: of two names that both have a row the entry counts, else the defaults.
typedef struct scene_matrix {
    int64_t line; ///< 0: there is none
    const char **names;
    name_index rows;        ///< of the names
    unsigned char *entries; ///< of names i < k at i * count + k
    size_t count;
    name_index defaults; ///< index 1: allowed
} scene_matrix;

typedef struct scene_state {
    const char *model; ///< the frame that fixed frames are given in; NULL: none is
    int64_t model_line;
    scene_frame *frames;
    size_t frame_count;
    scene_joint *joints;
    size_t joint_count;
    scene_padding *paddings;
    size_t padding_count;
    scene_matrix matrix;
} scene_state;

/// Reads it from the root of a scene; all of it is in the reader's memory. What cannot be obeyed is refused.
ovoid_code scene_state_read(message_reader *r, const yaml_value *root, scene_state *state);

/// 1: a collision of what has these names is allowed.
int scene_matrix_is_allowed(const scene_matrix *m, const char *a, const char *b);

#endif
