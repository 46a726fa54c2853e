// Reading the inputs of the commands, with the options for it.
#ifndef OVOID_CLI_BASE_INPUTS_H
#define OVOID_CLI_BASE_INPUTS_H

#include "base/args.h"

#include <ovoid/io.h>

/// Options of every command that reads meshes.
typedef struct read_settings {
    int unit;     ///< index in INPUTS_UNITS; INPUTS_NO_UNIT: no unit is named
    double scale; ///< 0 means 1
    int hull;     ///< 1: meshes are queried as their hulls, without an allowance
    int solid;    ///< 1: a mesh that is its hull is queried as its triangles too
} read_settings;

#define INPUTS_UNITS "m|cm|mm|um|in|ft"
#define INPUTS_NO_UNIT (-1)

/// The rows of these options in a table; `read` is the member of the settings that holds them.
#define INPUTS_OPTIONS(settings)                                                                                       \
    {"unit",                                                                                                           \
     0,                                                                                                                \
     OPTION_CHOICE,                                                                                                    \
     offsetof(settings, read.unit),                                                                                    \
     "UNIT",                                                                                                           \
     INPUTS_UNITS,                                                                                                     \
     "unit of all lengths, those of files, poses and options and those printed: m, cm, mm, um, in or ft; no number "   \
     "changes by it but those of COLLADA files, which say theirs (default: none is named)"},                           \
    {                                                                                                                  \
        "scale", 0, OPTION_POSITIVE, offsetof(settings, read.scale), "S", NULL,                                        \
            "multiply the coordinates of meshes by S (default: 1)"                                                     \
    }

/// The word of the unit; "" if none is named. It converts only files that state their own unit.
const char *inputs_get_unit(const read_settings *settings);

/// The options of the io library.
ovoid_read_options inputs_make_options(const read_settings *settings);

/// A body from a file: its hull, or with parts a compound of its objects.
typedef struct cli_body {
    const ovoid_shape *shape; ///< NULL for a compound
    ovoid_shapes *parts;
    ovoid_compound *compound;
} cli_body;

/// Opens a body. 0, or EXIT_INPUT after a message, with nothing left open.
int inputs_open_body(const char *path, const read_settings *settings, int parts, cli_body *body);
/// Opens both bodies of a pair. 0, or EXIT_INPUT after a message, with nothing left open.
int inputs_open_pair(const char *const paths[2], const read_settings *settings, int parts, cli_body bodies[2]);
ovoid_body inputs_get_body(const cli_body *body, const ovoid_pose *pose);
void inputs_close_body(cli_body *body);

/// Reads a scene; NULL after a message. hulls: meshes are solids only where the scene says so.
ovoid_scene *inputs_read_scene(const char *path, int hulls);

/// The optional fields of the records of a scene with solids.
unsigned inputs_get_fields(const ovoid_scene *scene);

/// The row of that option for a scene's meshes.
#define INPUTS_HULL_OPTION(settings)                                                                                   \
    {                                                                                                                  \
        "hull", 0, OPTION_FLAG, offsetof(settings, hull), NULL, NULL,                                                  \
            "each mesh is its convex hull, or its \"parts\" (default: a closed mesh that is not convex is the solid "  \
            "that its triangles enclose, an open one its surface); \"solid\" and \"hull\" in the scene come first"     \
    }

/// Where the mesh of a body comes from, to be read again for a picture.
typedef struct mesh_source {
    const char *path; ///< NULL: the body has none
    ovoid_read_options read;
    const ovoid_scene *scene; ///< of an object of a scene, whose file must be the one that the scene was made from
    size_t object;
} mesh_source;

/// Object i of the scene.
mesh_source inputs_find_mesh(const ovoid_scene *scene, size_t i);
/// 1 if it can be read: standard input cannot be read twice, and a shape file has no mesh.
int inputs_has_mesh(const mesh_source *source);
/// Reads it; the caller destroys it. NULL after a message.
ovoid_mesh *inputs_read_mesh(const mesh_source *source);

/// Copies the poses of its objects, which the caller frees; NULL after a message.
ovoid_pose *inputs_copy_poses(const ovoid_scene *scene);

/// Reads the shapes of a LIST; NULL after a message.
ovoid_shapes *inputs_read_list(const char *path, const read_settings *settings);

/// Warnings about meshes that are queried as their hulls but are not their hulls: a part of a file; a file without
/// --parts, with the advice to use it if each of its parts is its hull; the files of one or two bodies, the same file
/// once; the meshes of a list or a scene, each once, and for a scene also its surfaces, with their number of open
/// edges.
void inputs_warn_part(const char *path, const char *part, const ovoid_convexity *convexity);
void inputs_warn_file(const char *path, const read_settings *settings, const ovoid_convexity *convexity);
void inputs_warn_bodies(const char *const *paths, const cli_body *bodies, size_t count, const read_settings *settings);
void inputs_warn_list(const ovoid_shapes *shapes);
void inputs_warn_scene(const ovoid_scene *scene);
/// Warns that an open mesh is queried as its surface.
void inputs_warn_surface(const char *path, uint64_t open_edges);

/// 1 if the path is that of a scene: it ends in ".json", or in ".ovoids" of a packed one.
int inputs_is_scene(const char *path);

#endif
