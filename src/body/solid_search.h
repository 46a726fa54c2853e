// The search of two bodies of which one is a solid: the steps of its traversal.
#ifndef OVOID_BODY_SOLID_SEARCH_H
#define OVOID_BODY_SOLID_SEARCH_H

#include "body/traverse.h"

/// The normal that is tried on boxes, in a's frame.
static inline vec3 solids_get_normal(const body_search *state) {
    return state->solids->normals[state->solids->normal_count - 1];
}

/// The gap of the boxes of both roots, and its direction in a's frame.
box_gap solids_find_roots_gap(const body_search *state);
/// The steps (search_kind).
waiting_pair solids_bound_roots(const body_search *state, double enough);
void solids_exclude_boxes(body_search *state, const waiting_pair *w);
void solids_visit_leaves(body_search *state, const waiting_pair *w);
int solids_take(body_search *state, const leaf_pair *pair);

/// Triangles of the body `side` (0: a) at places, and one triangle of the other.
typedef struct triangle_group {
    int side;
    uint32_t one;
    uint32_t places[BOX8], count;
} triangle_group;

/// The pairs of a group, in lanes.
void solids_visit_triangles(body_search *state, const triangle_group *group);

#endif
