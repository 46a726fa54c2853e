// Obstacles of a scene: obstacles.c reads them, place.c puts them into a cell.
#ifndef OVOID_ROBOT_READ_SCENE_OBSTACLES_H
#define OVOID_ROBOT_READ_SCENE_OBSTACLES_H

#include "robot/read/body/primitive.h"
#include "robot/read/scene/state.h"

/// An obstacle, or a part of an object that a link holds.
typedef struct obstacle_entry {
    const char *name;
    const char *frame; ///< "": none is named
    const char *link;  ///< that holds it; NULL: none does
    const char *const *touching;
    size_t touching_count; ///< links that what is held may touch
    ovoid_pose pose;       ///< in the frame
    primitive what;
    ovoid_shape *made; ///< of a mesh: its own; NULL: of the primitive
    const ovoid_shape *shape;
    const ovoid_solid *solid;      ///< of which the shape is the hull; NULL: none
    const yaml_value *at, *object; ///< the part and its object, while the scene is read
    int64_t line;                  ///< 0: of ovoid's own scenes
    size_t index;
} obstacle_entry;

struct ovoid_obstacles {
    pool memory;
    const char *path;
    scene_state state;
    ovoid_scene *scene; ///< whose shapes these are; NULL: the shapes are ours
    obstacle_entry *entries;
    size_t count, capacity;
    ovoid_shape **shapes;
    size_t shape_count, shape_capacity;
    ovoid_solid **solids; ///< and surfaces, of planning scenes
    size_t solid_count, solid_capacity;
};

#endif
