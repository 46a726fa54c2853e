// MoveIt's messages in YAML: values by their keys, numbers, poses; errors that name the object at hand.
#ifndef OVOID_ROBOT_READ_SCENE_MESSAGE_H
#define OVOID_ROBOT_READ_SCENE_MESSAGE_H

#include "ovoid/robot_io.h"
#include "robot/read/text/yaml_tree.h"

/// The state of reading a message.
typedef struct message_reader {
    const char *path;
    const ovoid_robot_read_options *options;
    ovoid_error *error;
    const char *object; ///< the name of the object at hand; NULL: none
    pool *memory;       ///< of what is kept
    pool scratch;       ///< of the tree
} message_reader;

/// Reports "path:line: object "x": sentence".
COMPILER_PRINTF(4, 5)
void message_report(const message_reader *r, const yaml_value *at, ovoid_code code, const char *format, ...);
/// Reports as message_report, and has the value of the code: a macro, so that compilers know that it is not OVOID_OK.
#define message_fail(r, at, code, ...) (message_report(r, at, code, __VA_ARGS__), (code))
/// Tells the caller of something; at NULL: about the file.
COMPILER_PRINTF(3, 4)
void message_note(const message_reader *r, const yaml_value *at, const char *format, ...);

/// The member of that key; NULL where there is none, or where it is empty or null; refused where there are two.
ovoid_code message_find(const message_reader *r, const yaml_value *map, const char *key, const yaml_value **member);
/// Finds a member that must be a map (YAML_MAP), a list or a text, where it is there.
ovoid_code message_find_kind(const message_reader *r, const yaml_value *map, const char *key, yaml_kind kind,
                             const yaml_value **member);
/// A text that is kept; "" where it is not there.
ovoid_code message_read_text(const message_reader *r, const yaml_value *map, const char *key, const char **text);
/// A finite number.
ovoid_code message_read_number(const message_reader *r, const yaml_value *value, double *number);
/// A list of count finite numbers, or a map with these keys.
ovoid_code message_read_numbers(const message_reader *r, const yaml_value *value, const char *const *keys, size_t count,
                                double *numbers);
/// {position, orientation}: lists or maps, the quaternion x y z w; NULL: no displacement.
ovoid_code message_read_pose(const message_reader *r, const yaml_value *value, ovoid_pose *pose);
/// {translation, rotation} as x, y, z and the quaternion w, x, y, z.
ovoid_code message_read_transform(const message_reader *r, const yaml_value *value, double values[7]);
/// 1: such a transform moves nothing.
int transform_is_identity(const double values[7]);
/// Refuses the first key of a map that is not among "one|two"; what is no map has none.
ovoid_code message_refuse_others(const message_reader *r, const yaml_value *map, const char *known);
/// Refuses a key whose value is not empty, with the reason.
ovoid_code message_refuse_filled(const message_reader *r, const yaml_value *map, const char *key, const char *why);
/// The frame_id of a header, kept, without a slash before it; "" where there is none.
ovoid_code message_read_frame(const message_reader *r, const yaml_value *header, const char **frame);

#endif
