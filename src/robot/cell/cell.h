// A robot among obstacles, compiled to flat arrays: items (elements and parts of attached bodies), parts of obstacles,
// pairs of items.
#ifndef OVOID_ROBOT_CELL_CELL_H
#define OVOID_ROBOT_CELL_CELL_H

#include "base/allocator.h"
#include "robot/cell/oriented_box.h"
#include "robot/cell/solid_pair.h"
#include "robot/model/inner_balls.h"
#include "robot/model/kinematics.h"
#include "shape/block.h"

/// 256 u: what rounding may do to a centre and a distance, in parts of the lengths that they are made of.
#define CELL_SLACK ROBOT8_SLACK

/// Something that moves with a link.
typedef struct cell_item {
    const ovoid_shape *shape; ///< where there is a solid its hull
    const ovoid_solid *solid; ///< NULL: none
    uint32_t frame;
    vec3 center;        ///< of its enclosing sphere, in its link's frame
    double reach;       ///< its radius, rounding radius and allowance in it, and what rounding may add to a centre
    double far;         ///< no point of it is farther than this from the origin of its own frame
    vec3 middle, half;  ///< the box of its vertices, in its own frame
    double radius;      ///< what it stands out of that, and what rounding may add to the box' place
    ovoid_pose in_link; ///< of its own frame
    const shape_inside *inside;
    ovoid_robot_side side;
} cell_item;

/// A part of an obstacle: where it is, and a box around it.
typedef struct cell_part {
    const ovoid_shape *shape; ///< as of an item
    const ovoid_solid *solid;
    ovoid_pose pose;
    oriented_box box;
    inner_region inside; ///< in the world
    double inside_size;  ///< the lengths that its centre is made of, summed
    double gap;          ///< as of shape_inside
    body_slabs slabs;    ///< in its own frame
    double size;         ///< the lengths that they are made of
    ovoid_robot_side side;
} cell_part;

/// The items of a link, and a sphere around them in its frame.
typedef struct cell_group {
    uint32_t link, first, end; ///< items
    vec3 center;
    double reach, far; ///< as of an item
    vec3 middle, half; ///< of a box around them, in the link's frame
    double radius;
    int is_box_of_item; ///< 1: the box is that of its only item
} cell_group;

typedef struct item_pair {
    uint32_t a, b; ///< items
} item_pair;

/// Two groups with pairs of items.
typedef struct group_pair {
    uint32_t a, b, first, end; ///< pairs
} group_pair;

/// An obstacle or an attached body in its slot.
typedef struct cell_body {
    ovoid_body body;
    ovoid_shape *hull;         ///< of a solid, the cell's own; else NULL
    inner_region inside;       ///< of a solid
    double gap;                ///< as of shape_inside
    uint32_t generation, link; ///< link NONE: an obstacle
    int is_used;
} cell_body;

/// An array that grows.
typedef struct cell_array {
    void *items;
    size_t count, capacity;
} cell_array;

struct ovoid_robot_cell {
    const ovoid_robot *robot;
    ovoid_allocator allocator;
    uint64_t version;          ///< changes with everything that checkers keep memory for
    uint64_t moved;            ///< changes where an obstacle moves, or a padding does
    uint32_t used;             ///< all slots before this one are used
    int ignores_disabled;      ///< 1: what the description disables is queried: a scene says what is allowed
    int is_whole;              ///< 0: memory ended while the arrays were made; nothing is said of a state
    cell_array bodies;         ///< cell_body
    cell_array allowed_links;  ///< keys of two links, sorted
    cell_array allowed_bodies; ///< keys slot << 32 | link, sorted
    double *padding;           ///< of each link
    uint32_t *rigid;           ///< of each link: the topmost link that it never moves against
    // What follows from these.
    cell_array items, parts, boxes, pairs; ///< cell_item, sorted by link; cell_part, box8, item_pair
    cell_array insides;                    ///< shape_inside, of items that are attached
    cell_array groups, group_pairs;        ///< cell_group, group_pair
    cell_array steps, step_joints;         ///< chain_step and its joint: those of the links that items hang on
    cell_array own;                        ///< chain_step: the frames beyond those of links, each one's
    uint32_t frame_count;
};

static inline const cell_item *cell_items(const ovoid_robot_cell *c) { return c->items.items; }
static inline const cell_part *cell_parts(const ovoid_robot_cell *c) { return c->parts.items; }
static inline const item_pair *cell_pairs(const ovoid_robot_cell *c) { return c->pairs.items; }
static inline const cell_group *cell_groups(const ovoid_robot_cell *c) { return c->groups.items; }
static inline const group_pair *cell_group_pairs(const ovoid_robot_cell *c) { return c->group_pairs.items; }
static inline const box8 *cell_boxes(const ovoid_robot_cell *c) { return c->boxes.items; }
static inline const cell_body *cell_bodies(const ovoid_robot_cell *c) { return c->bodies.items; }

/// The solids of an item and a part, and of two items.
static inline solid_sides cell_get_part_solids(const cell_item *a, const cell_part *b) {
    return (solid_sides){a->solid, b->solid, (a->inside->gap + b->gap) * (1 + 0x1p-50)};
}
static inline solid_sides cell_get_item_solids(const cell_item *a, const cell_item *b) {
    return (solid_sides){a->solid, b->solid, (a->inside->gap + b->inside->gap) * (1 + 0x1p-50)};
}

static inline ovoid_id cell_make_id(uint32_t slot, uint32_t generation) { return (uint64_t)slot << 32 | generation; }
static inline uint64_t cell_make_key(uint32_t high, uint32_t low) { return (uint64_t)high << 32 | low; }

/// Room for one more, or count in all; 0: no memory, and all is as it was.
int cell_reserve(const ovoid_allocator *memory, cell_array *a, size_t count, size_t size);
/// Sorted keys.
int keys_are_holding(const cell_array *keys, uint64_t key);
ovoid_code keys_set(const ovoid_allocator *memory, cell_array *keys, uint64_t key, int is_in);

/// Compiles items, parts, boxes, pairs and steps anew. MEMORY, LIMIT: they are not to be used.
ovoid_code cell_compile(ovoid_robot_cell *cell, ovoid_error *error);
/// Appends the parts of the obstacle in a slot that is new; where it is the last slot that costs as much as its parts.
/// The codes of cell_compile.
ovoid_code cell_append_obstacle(ovoid_robot_cell *cell, uint32_t slot, ovoid_error *error);
/// Makes the boxes of all parts anew, from where they are.
void cell_place_parts(ovoid_robot_cell *cell);

/// 1 if an item, like all of its link, and an obstacle are left out.
static inline int cell_is_allowed(const ovoid_robot_cell *c, const ovoid_robot_side *item,
                                  const ovoid_robot_side *obstacle) {
    return c->allowed_bodies.count &&
           keys_are_holding(&c->allowed_bodies, cell_make_key((uint32_t)(obstacle->body >> 32), item->link));
}

/// 1 if elements of two links are asked about.
int cell_are_links_queried(const ovoid_robot_cell *c, uint32_t a, uint32_t b);

/// 1 if there is a pair to ask about.
int cell_has_pairs(const ovoid_robot_cell *c, const ovoid_robot_query_options *options);

#endif
