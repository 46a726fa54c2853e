// Before anything else of two bodies is looked at: are the balls around them farther apart than was asked, or the boxes
// of their roots?
#ifndef OVOID_BODY_FIRST_LOOK_H
#define OVOID_BODY_FIRST_LOOK_H

#include "body/search.h"

/// What is known of bodies that are farther apart than was asked.
typedef struct far_bodies {
    double lower, upper;
    vec3 point_a, point_b, normal;
    uint32_t part_a, part_b;
    ovoid_limit limit;
} far_bodies;

/// The initialiser of their answer. Within one expression gcc 12 builds it in the place of what it is for; it would
/// copy what a function returns.
#define FAR_ANSWER(x)                                                                                                  \
    {                                                                                                                  \
        .status = OVOID_SEPARATED, .limit = (x)->limit, .lower = (x)->lower, .upper = (x)->upper,                      \
        .part_a = (x)->part_a, .part_b = (x)->part_b, .visited = 1, .deciding = {                                      \
            .status = OVOID_SEPARATED,                                                                                 \
            .stage = OVOID_STAGE_SPHERE,                                                                               \
            .limit = (x)->limit,                                                                                       \
            .lower = (x)->lower,                                                                                       \
            .upper = (x)->upper,                                                                                       \
            .point_a = (x)->point_a,                                                                                   \
            .point_b = (x)->point_b,                                                                                   \
            .normal = (x)->normal,                                                                                     \
            .proof = {.normal = (x)->normal, .kind = OVOID_PROOF_POINTS, .count = 1, .weight_a = {1}, .weight_b = {1}} \
        }                                                                                                              \
    }

/// 1 where they are: *far is filled, and the exclusion of all pairs of parts added. The search has its options and
/// trees, and has found nothing yet. boxes: NULL, for the balls; or the gap of the boxes as measured, and its direction
/// in a's frame.
int first_look(const body_search *state, const query_goal *goal, const box_gap *boxes, far_bodies *far);

#endif
