// A posed shape or compound as a tree over parts, and the pipeline of its queries.
#ifndef OVOID_BODY_BODY_VIEW_H
#define OVOID_BODY_BODY_VIEW_H

#include "compound/compound.h"
#include "ovoid/body.h"
#include "query/answer.h"

/// The options of a query of bodies of that size become those of its pairs of parts: the tolerance of the bodies.
static inline void options_take_size(ovoid_options *options, double size) {
    options->absolute_tolerance = options_compute_tolerance(options, size, 0);
}

/// A posed body as a tree over parts; a shape is a tree of one node.
typedef struct body_view {
    const compound_node *nodes;
    const compound_part *parts;
    const ovoid_compound *compound; ///< NULL: a shape
    const ovoid_pose *pose;
    double extent, allowance;
    uint32_t count;
    // The tree of a shape.
    compound_node own_node;
    compound_part own_part;
} body_view;

/// 1 if a body is a shape or a compound, and nothing else.
static inline int body_is_convex(const ovoid_body *body) { return !body->solid && !body->shape != !body->compound; }
/// 1 if exactly one of a body's pointers is set.
static inline int body_is_one(const ovoid_body *body) { return !!body->shape + !!body->compound + !!body->solid == 1; }

/// 0 where the body or its pose is refused.
int body_view_make(const ovoid_body *body, body_view *view);
/// The views of both bodies, or the reason why their queries are refused.
ovoid_limit body_pair_view(const ovoid_body_pair *pair, body_view *a, body_view *b);

/// The part at a place of the order, with its pose in the world.
static inline ovoid_posed_shape body_view_get_part(const body_view *v, uint32_t place) {
    const compound_part *part = &v->parts[place];
    if (!v->compound) return (ovoid_posed_shape){part->shape, *v->pose};
    return (ovoid_posed_shape){part->shape, pose_compute_product(v->pose, &part->pose)};
}
/// The caller's index of the part at a place.
static inline uint32_t body_view_get_index(const body_view *v, uint32_t place) {
    return v->compound ? v->compound->order[place] : 0;
}

/// The pipeline of queries without a solid (body_find.h).
void parts_find_internal(const ovoid_body_pair *pair, const ovoid_options *options, query_goal goal,
                         const ovoid_body_proof *earlier, ovoid_exclusions *exclusions, ovoid_body_answer *out);

#endif
