// The answers of many pairs of a scene's objects, on several threads, in the order of the pairs.
#ifndef OVOID_CLI_PAIRS_ANSWERS_H
#define OVOID_CLI_PAIRS_ANSWERS_H

#include "contacts.h"
#include "results.h"

#include <ovoid/ovoid.h>

/// The words of the commands' --query, in their order. A distance is signed: where bodies overlap it is minus the
/// depth, to the tolerance, as ovoid_depth answers.
enum query { QUERY_NONE = -1, QUERY_COLLIDE, QUERY_WITHIN, QUERY_DISTANCE };
#define QUERY_CHOICES "collide|within|distance"

/// Working memory for one answer after another.
typedef struct answer_room {
    ovoid_cover cover;
    ovoid_exclusions exclusions;
    ovoid_body_answer body;
} answer_room;

/// A query of two bodies.
typedef struct answers_query {
    int query; ///< of enum query
    double margin, tolerance;
    int wants_proof;                        ///< 1: with cover and exclusions
    const ovoid_body_proof *earlier;        ///< of this pair, or NULL
    const ovoid_manifold_options *contacts; ///< of the contacts that the record is to have; NULL: none
} answers_query;

/// Answers one query: sets the record's answer and parts, and with a proof its cover and exclusions, which are in the
/// room until the next call; so is the answer of a pair with a solid. Contacts are the record's own: contacts_clear
/// frees them. 0 if memory runs out.
int answers_find(answer_room *room, const ovoid_body_pair *pair, const answers_query *query, ovoid_record *record);
void answer_room_clear(answer_room *room);

/// Sets the limit of an answer whose bracket contains the margin and is no wider than its query made it: ALLOWANCE if
/// the bodies' allowances make most of its width, as in ovoid_within. tolerance: the absolute tolerance of the query.
void answers_settle_limit(ovoid_answer *answer, const ovoid_body_pair *pair, double margin, double tolerance);

/// The largest width that the allowance of the body, or of one of its parts, adds to a bracket.
double answers_find_width(const ovoid_body *body);

/// Sets the kinds of two objects of a scene in a record.
void answers_describe(const ovoid_scene *scene, ovoid_couple couple, ovoid_record *record);

/// The object of a scene as a body, at a pose.
ovoid_body answers_get_body(const ovoid_scene *scene, size_t object, const ovoid_pose *pose);

/// A query of many pairs.
typedef struct answers_job {
    const ovoid_scene *scene;
    const ovoid_pose *poses; ///< of its objects
    int query;
    double margin, tolerance; ///< margin: that of the records; negative if there is none
    int is_near_only; ///< 1: pairs that are proven farther apart than `reach`, by the answer or by a query of that
                      ///< alone, are left out
    double reach;
    unsigned threads;
    const void *couples; ///< ovoid_couple, `stride` bytes apart
    size_t stride, count;
    const ovoid_manifold_options *contacts; ///< of the contacts of the records; NULL: they have none
    double time;
    cli_results *results; ///< where records are written; NULL: nowhere
    int wants_proof;      ///< 1: each is the answer that is written with its proof, whose memory takes a search farther
    int are_units;        ///< 1: each pair is a unit of a shard's work
    /// Receives each record that is not left out, in order (without cover and exclusions); i: of the couple. May be
    /// NULL.
    void (*take)(void *context, size_t i, const ovoid_record *record);
    void *context;
} answers_job;

/// Answers all pairs. 0, or an exit code, after a message if one is due.
int answers_run(const answers_job *job);

#endif
