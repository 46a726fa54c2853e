// A robot compiled to flat arrays in one block of memory.
#ifndef OVOID_ROBOT_MODEL_ROBOT_H
#define OVOID_ROBOT_MODEL_ROBOT_H

#include "ovoid/robot.h"
#include "robot/model/inner_balls.h"

/// A name and the index of what has it.
typedef struct robot_name {
    const char *name;
    uint32_t index;
} robot_name;

/// What a joint follows, all mimics on the way composed: factor * q + offset.
typedef struct joint_lead {
    double factor, offset;
    double error; ///< the value is off by at most error * (spread * |q| + offset_spread) from the exact one
    double spread, offset_spread;
    uint32_t lengths; ///< how many of the joint's values, the first ones, are lengths
} joint_lead;

/// The source of a value of the chain, where all is well with it: factor * q[variable] + offset, at most `most`.
typedef struct value_source {
    double factor, offset, most;
    double scale; ///< 1: errors grow with the variable; 0
    uint32_t variable;
} value_source;

struct ovoid_robot {
    ovoid_robot_description of; ///< the copy; its arrays are below, in the block
    ovoid_robot_link *links;
    ovoid_robot_joint *joints;
    ovoid_robot_element *elements;
    ovoid_robot_pair *disabled;
    uint32_t link_count, joint_count, element_count, disabled_count;
    robot_name *link_names, *joint_names; ///< sorted by name
    uint32_t root;
    uint32_t *parent_joint;   ///< of each link; NONE: the root
    uint32_t *order;          ///< the joints, parents before children
    uint32_t *joint_variable; ///< of each joint: the first variable that moves it; NONE: fixed
    ovoid_robot_variable *variables;
    uint32_t variable_count;
    joint_lead *leads;
    chain_step *steps;     ///< one a joint, in that order; frames are those of the links
    uint32_t *step_of;     ///< of each joint: its place in `order`
    uint32_t *value_first; ///< of each joint: where its values begin
    value_source *sources; ///< of each value
    uint32_t *followers;   ///< the joints that follow others and have limits of their own
    uint32_t follower_count;
    uint32_t *free_values; ///< of each floating joint: where its quaternion begins among the values
    uint32_t free_count;   ///< floating joints
    uint32_t value_count;
    double magnitude;         ///< the largest that variables of limited joints can have, where errors grow with them
    shape_inside *insides;    ///< of each shape once, in a block of its own
    uint32_t *element_inside; ///< of each element: which
    struct pair_tables_once *tables; ///< in the block; made where they are first asked for
    int takes_shapes;
    ovoid_allocator allocator;
};

/// OVOID_OK, or what is wrong with the description, of each link, joint and element alone: names, numbers, indices.
ovoid_code description_validate(const ovoid_robot_description *d, ovoid_error *error);

/// Sorts names; the index of the second of two equal ones, or NONE.
uint32_t names_sort(robot_name *names, uint32_t count);
/// The index of a name, or NONE.
uint32_t names_find(const robot_name *names, uint32_t count, const char *name);

/// Sets root, parent_joint and order from the joints; scratch: 2 numbers a link and one more. OVOID_OK, or ARGUMENT: no
/// tree.
ovoid_code tree_find_order(ovoid_robot *r, uint32_t *scratch, ovoid_error *error);

/// 1: errors grow with the variables of the joint: those that are lengths, and that which a mimic multiplies.
static inline int lead_is_scaled(const joint_lead *lead) { return lead->lengths > 0 || lead->error > 0; }

/// What is known to lie inside an element's shape.
static inline const shape_inside *robot_get_inside(const ovoid_robot *r, uint32_t element) {
    return &r->insides[r->element_inside[element]];
}

/// Sets leads, steps and frames.
void chain_compile(ovoid_robot *r);

/// Sets variables and joint_variable. OVOID_OK, or ARGUMENT: a ring of mimics, or one of a joint without one variable.
ovoid_code variables_find(ovoid_robot *r, ovoid_error *error);

/// Destroys an element's shape: it is borrowed, and const; here it is the robot's own.
void element_destroy_shape(const ovoid_robot_element *element);

#endif
