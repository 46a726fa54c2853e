// Shared by the files of the scene reader: scene.c reads objects, poses and pairs to ignore, scene_bodies.c their
// geometry, scene_values.c single values; scene_pack.c writes a packed scene and scene_unpack.c reads it.
#ifndef OVOID_IO_SCENE_SCENE_H
#define OVOID_IO_SCENE_SCENE_H

#include "io/json.h"

/// A shape or a compound, shared by all objects of equal geometry.
typedef struct scene_body {
    uint64_t hash;            ///< of the key
    char *key;                ///< a text of all that the body is made from
    const ovoid_shape *shape; ///< made, or the only part
    ovoid_shape *made;        ///< of a body that is no mesh
    ovoid_compound *compound;
    char *mesh;             ///< its path, NULL for none
    size_t mesh_at;         ///< where in the path the name begins that the scene has
    uint64_t mesh_checksum; ///< of its file, as it was when the shapes were made
    ovoid_read_options read;
    ovoid_shapes *parts;      ///< the hulls of a mesh; other compounds have parts that are bodies of the scene
    ovoid_named_shape *hulls; ///< the same of a packed scene, which owns what they point to
    size_t hull_count;
    const ovoid_solid *solid; ///< of a mesh that is one; `shape` is its hull
    int is_asked;             ///< the scene says that it is to be one
} scene_body;

typedef struct scene_entry {
    char *name;
    ovoid_pose pose;
    size_t body;
} scene_entry;

struct ovoid_scene {
    char unit[4]; ///< "" where none is named
    scene_entry *entries;
    size_t count;
    size_t *by_name; ///< entries in the order of their names
    scene_body *bodies;
    size_t body_count, body_capacity;
    uint64_t *ignored; ///< pairs as (smaller << 32 | larger), ascending
    size_t ignored_count;
    int hulls;      ///< 1: it was read with hulls for meshes that the scene leaves open
    int has_choice; ///< 1: there are such meshes
    // Of a packed scene.
    char *packed; ///< the file, which has the names; NULL: each name is its own memory
    ovoid_shape **shapes;
    ovoid_solid **solids;
    size_t shape_count, solid_count, solid_capacity;
};

enum { NO_PART = -1 };

/// The state of reading.
typedef struct scene_reader {
    const char *path;
    bytes file;
    json_list objects;
    ovoid_scene *scene;
    const ovoid_shape_options *options;
    ovoid_error *error;
    size_t index;     ///< the present object
    const char *name; ///< its name; NULL until it is read
    long part;        ///< of the object's "compound", or NO_PART
    int hulls;        ///< 1: meshes are their hulls where the scene does not say otherwise
    size_t *slots;    ///< bodies by their hash, as index + 1; a power of two of them
    size_t slot_count;
} scene_reader;

/// Fails with "path:line: object "name": sentence", and the line of the object's member `key`, or of the object itself
/// (NULL).
ovoid_code scene_fail(scene_reader *r, ovoid_code code, const char *key, const char *sentence);
/// Fails with "key" what, for a member that is not what it must be.
ovoid_code scene_fail_member(scene_reader *r, ovoid_code code, const char *key, const char *what);
/// Fails for a member that the owner ("objects", "parts") has none of, with the keys that it has.
ovoid_code scene_fail_key(scene_reader *r, const char *key, const char *owner, const char *const *words);

/// Reads exactly `count` finite numbers; 0 where the value is something else.
int scene_read_numbers(const json_t *value, double *numbers, size_t count);
/// 1 if every key of the object is among the words (a list that ends with NULL); else *unknown is the first other one.
int scene_has_only(json_t *object, const char *const *words, const char **unknown);
/// Reads the pose of an object or of a part; value NULL: none is given.
ovoid_code scene_read_pose(scene_reader *r, json_t *value, ovoid_pose *pose);

/// The body of an object, by its geometry and the members beside it: made, or found where an equal one exists.
ovoid_code scene_read_body(scene_reader *r, json_t *object, size_t *body);
void scene_body_clear(scene_body *body);

/// The hulls of a mesh; of other bodies none.
size_t scene_body_count_hulls(const scene_body *body);
ovoid_named_shape scene_body_get_hull(const scene_body *body, size_t i);

#endif
