// What the two halves of the scene reader share: scene.c reads objects, poses and pairs to ignore; scene_bodies.c reads
// what the objects are.
#ifndef OVOID_IO_SCENE_H
#define OVOID_IO_SCENE_H

#include "io/json.h"

/// What one object or several are: a shape, or a compound.
typedef struct scene_body {
    uint64_t hash; ///< of the key
    char *key;     ///< all that it was made from
    ovoid_shape *shape;
    ovoid_compound *compound;
    ovoid_shapes *parts; ///< of a compound that comes from a mesh; others have parts that are bodies of the scene
} scene_body;

typedef struct scene_entry {
    char *name;
    ovoid_pose pose;
    size_t body;
} scene_entry;

struct ovoid_scene {
    scene_entry *entries;
    size_t count;
    size_t *by_name; ///< entries in the order of their names
    scene_body *bodies;
    size_t body_count, body_capacity;
    uint64_t *ignored; ///< pairs as (smaller << 32 | larger), ascending
    size_t ignored_count;
};

enum { NO_PART = -1 };

/// What is being read.
typedef struct scene_reader {
    const char *path;
    bytes file;
    ovoid_scene *scene;
    const ovoid_shape_options *options;
    ovoid_error *error;
    size_t index;     ///< the object at hand
    const char *name; ///< its name; NULL while it is not known
    long part;        ///< of the object's "compound", or NO_PART
    size_t *slots;    ///< bodies by their hash, as index + 1; a power of two of them
    size_t slot_count;
} scene_reader;

/// "path:line: object "name": sentence", with the line of the object's member `key`, or of the object itself (NULL).
ovoid_code scene_fail(scene_reader *r, ovoid_code code, const char *key, const char *sentence);
/// Likewise for a member that is not what it must be: "key" what.
ovoid_code scene_fail_member(scene_reader *r, ovoid_code code, const char *key, const char *what);

/// Finite numbers, exactly so many; 0 where the value is something else.
int scene_read_numbers(const json_t *value, double *numbers, size_t count);
/// 1 if every key of the object is among the words (a list that ends with NULL); else *unknown is the first other one.
int scene_has_only(json_t *object, const char *const *words, const char **unknown);
/// The pose of an object or of a part; value NULL: none is given.
ovoid_code scene_read_pose(scene_reader *r, json_t *value, ovoid_pose *pose);

/// The body that an object is, by its geometry and what stands beside it: made, or found where an equal one was made.
ovoid_code scene_read_body(scene_reader *r, json_t *object, size_t *body);
void scene_body_clear(scene_body *body);

#endif
