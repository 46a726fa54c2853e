// Joints' numbers in MoveIt's messages: of a robot's state, of a goal, of a trajectory's point.
#ifndef OVOID_ROBOT_READ_SCENE_POSITIONS_H
#define OVOID_ROBOT_READ_SCENE_POSITIONS_H

#include "robot/read/scene/message.h"

typedef struct position_list {
    ovoid_joint_position *items;
    size_t count;
} position_list;

/// Makes room for that many numbers in the reader's memory.
ovoid_code position_list_make(const message_reader *r, size_t most, position_list *out);
/// Adds the number of a joint; the name is kept as it is, a copy is made by position_list_copy_name.
ovoid_code position_list_add(const message_reader *r, const char *name, const yaml_value *number, position_list *out);
/// A joint's name, kept; refused where the value is no text.
ovoid_code position_list_copy_name(const message_reader *r, const yaml_value *value, const char **name);
/// Reads moveit_msgs/RobotState. owner: what the state belongs to, "a request". The list is empty where the state names
/// no joints. Refused: a base that is not at its frame, and what a link holds.
ovoid_code position_list_read_state(const message_reader *r, const yaml_value *state, const char *owner,
                                    position_list *out);
/// Reads sensor_msgs/JointState.
ovoid_code position_list_read_joints(const message_reader *r, const yaml_value *state, position_list *out);

#endif
