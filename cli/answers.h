// The answers of many pairs of a scene's objects, on several threads, in the order of the pairs.
#ifndef OVOID_CLI_ANSWERS_H
#define OVOID_CLI_ANSWERS_H

#include "results.h"

#include <ovoid/ovoid.h>

/// The questions of the commands' --query, in the order of its words.
enum query { QUERY_NONE = -1, QUERY_COLLIDE, QUERY_WITHIN, QUERY_DISTANCE, QUERY_DEPTH };
#define QUERY_CHOICES "collide|within|distance|depth"

/// Working memory of one answer after another.
typedef struct answer_room {
    ovoid_cover *cover;
    ovoid_exclusion *items;
    size_t capacity;
} answer_room;

/// One question about two solids, with all that proves its answer where `proven`: the record's answer, parts, cover and
/// exclusions, which live in the room until the next call. 0 where memory is out.
int answers_ask(answer_room *room, const ovoid_solid_pair *pair, int query, double margin, double tolerance, int proven,
                ovoid_record *record);
void answer_room_clear(answer_room *room);

/// The object of a scene as a solid, at a pose.
ovoid_solid answers_get_solid(const ovoid_scene *scene, size_t object, const ovoid_pose *pose);

/// The fields of records about a scene's objects: parts where it has compounds.
unsigned answers_get_fields(const ovoid_scene *scene);

/// What is asked about which pairs.
typedef struct answers_job {
    const ovoid_scene *scene;
    const ovoid_pose *poses; ///< of its objects
    int query;
    double margin, tolerance;
    unsigned threads;
    const void *couples; ///< ovoid_couple, `stride` bytes apart
    size_t stride, count;
    double time;
    unsigned fields;
    cli_results *results; ///< where the records go; NULL: nowhere
    /// Looks at each record in order (without cover and exclusions); i: of the couple. May be NULL.
    void (*take)(void *context, size_t i, const ovoid_record *record);
    void *context;
} answers_job;

/// Does it. 0, or an exit code, after a message where one is due.
int answers_run(const answers_job *job);

#endif
