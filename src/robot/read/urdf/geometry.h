// Shared by the files that read the geometry of a URDF's links: geometry.c reads it, geometry_find.c finds the meshes,
// geometry_make.c makes the shapes.
#ifndef OVOID_ROBOT_READ_URDF_GEOMETRY_H
#define OVOID_ROBOT_READ_URDF_GEOMETRY_H

#include "robot/read/body/primitive.h"
#include "robot/read/urdf/reader.h"

/// One <collision>, or <visual> in its place.
typedef struct geometry {
    const xml_element *at; ///< its shape
    uint32_t link, index;  ///< index: its place in the file
    const char *name;      ///< NULL: none
    ovoid_pose pose;
    primitive what;
    const char *address, *path;    ///< of a mesh; "" else
    int is_absent;                 ///< it is the first one of its address, which was not found
    size_t shape, shape_count;     ///< in the file's shapes
    const ovoid_solid *solid;      ///< of which the one shape is the hull; NULL: none
    const char *const *part_names; ///< of these; NULL: they have none
} geometry;

/// All of them, and the order in which equal ones are neighbours.
typedef struct geometry_list {
    geometry *items, **order;
    size_t count;
} geometry_list;

/// Sorts the order by a comparison of pointers to geometries, each a `geometry *`.
void geometry_sort(geometry_list *list, int (*compare)(const void *, const void *));

/// Finds the file of each mesh; refused where one is absent, and each of those is a note.
ovoid_code geometry_find(robot_reader *r, geometry_list *list);
/// Makes the shapes of all, equal ones once.
ovoid_code geometry_make(robot_reader *r, geometry_list *list);

#endif
