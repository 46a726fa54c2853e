// Shared by the files that read URDF and SRDF: the object under construction, errors with file, line and the link or
// joint, and the values of attributes.
#ifndef OVOID_ROBOT_READ_URDF_READER_H
#define OVOID_ROBOT_READ_URDF_READER_H

#include "ovoid/robot_io.h"
#include "robot/read/text/xml.h"

struct ovoid_robot_file {
    pool memory; ///< of all but the shapes
    ovoid_robot_description description;
    ovoid_robot_link *links;
    ovoid_robot_joint *joints;
    ovoid_shape **shapes;
    size_t shape_count, shape_capacity;
    ovoid_solid **solids;
    size_t solid_count, solid_capacity;
    ovoid_robot_mesh *meshes;
    size_t mesh_count;
    ovoid_robot_ignored *ignored;
    size_t ignored_count, fixed_mimic_count;
    ovoid_robot_group *groups;
    size_t group_count;
    ovoid_robot_state *states;
    size_t state_count;
    ovoid_robot_link_sphere *spheres;
    size_t sphere_count;
    ovoid_robot_end_effector *effectors;
    size_t effector_count;
    uint32_t *passive;
    size_t passive_count;
};

/// A name of an SRDF that is not there, and where it stands.
typedef struct unknown_name {
    const char *kind, *name; ///< kind: of what it would be the name
    const xml_element *at;
} unknown_name;

/// An element or an attribute that is not read: "parent/name" or "element@name".
typedef struct ignored_name {
    const char *parent, *between, *name;
} ignored_name;

/// The state of reading.
typedef struct robot_reader {
    const char *path; ///< of the file at hand
    const ovoid_robot_read_options *options;
    ovoid_error *error;
    ovoid_robot_file *file;
    pool scratch;                       ///< until all is read: the trees, and what is made of them
    name_index link_names, joint_names; ///< of the description
    uint32_t *parents;                  ///< of each link: the joint whose child it is, or OVOID_ROBOT_NONE
    ignored_name *ignored;
    size_t ignored_count, ignored_capacity;
    unknown_name *unknown;
    size_t unknown_count, unknown_capacity;
} robot_reader;

/// Reports "path:line: joint "x": sentence", where the element is, or is in, a child of the root that has a name.
COMPILER_PRINTF(4, 5)
void robot_report(const robot_reader *r, const xml_element *element, ovoid_code code, const char *format, ...);
/// Reports as robot_report, and has the value of the code: a macro, so that compilers know that it is not OVOID_OK.
#define robot_fail(r, element, code, ...) (robot_report(r, element, code, __VA_ARGS__), (code))
ovoid_code robot_fail_memory(const robot_reader *r);
/// Hands a note about the line of the element (NULL: about the file) to the caller.
COMPILER_PRINTF(3, 4)
void robot_note(const robot_reader *r, const xml_element *element, const char *format, ...);

/// 1 if the word is one of "one|two".
int robot_is_among(const char *word, const char *words);
/// Keeps in mind that something is not read.
ovoid_code robot_ignore(robot_reader *r, const char *parent, const char *between, const char *name);
/// Keeps in mind that children whose names are not among "one|two" are not read.
ovoid_code robot_ignore_others(robot_reader *r, const xml_element *element, const char *known);
/// Keeps in mind all attributes, here and further in, that have no effect on elements that are read.
ovoid_code robot_ignore_attributes(robot_reader *r, const xml_element *element);
/// Sums the ignored elements up in the file.
ovoid_code robot_finish_ignored(robot_reader *r);

/// Keeps in mind that an SRDF names something that is not there.
ovoid_code robot_add_unknown(robot_reader *r, const xml_element *element, const char *kind, const char *name);
/// A note for each of these names.
void robot_finish_unknown(const robot_reader *r);

/// The value of an attribute that must be there.
ovoid_code robot_get_text(const robot_reader *r, const xml_element *element, const char *name, const char **text);
/// The only child of that name; NULL where there is none; refused where there are several.
ovoid_code robot_get_child(const robot_reader *r, const xml_element *element, const char *name,
                           const xml_element **child);
/// Finite numbers of an attribute with blanks between, exactly count of them. 1: read; 0: it is not there; -1: refused.
int robot_read_numbers(const robot_reader *r, const xml_element *element, const char *name, double *values,
                       size_t count);
/// The number of an attribute that must be there.
ovoid_code robot_read_number(const robot_reader *r, const xml_element *element, const char *name, double *value);
/// The pose of an <origin>: xyz, and rpy or quat_xyzw; NULL: no displacement.
ovoid_code robot_read_origin(const robot_reader *r, const xml_element *origin, ovoid_pose *pose);

/// The rooms: urdf.c, joint_tree.c, geometry.c, srdf.c and groups.c.
ovoid_code urdf_read(robot_reader *r, const xml_element *root);
ovoid_code tree_validate(robot_reader *r, const xml_element *const *links, const xml_element *const *joints);
ovoid_code geometry_read(robot_reader *r, const xml_element *const *links);
ovoid_code srdf_read(robot_reader *r, const xml_element *root);
ovoid_code groups_read(robot_reader *r, const xml_element *root);

#endif
