// Moving bodies as trees, and the moving balls around their nodes.
#ifndef OVOID_COMPOUND_COMPOUND_IMPACT_H
#define OVOID_COMPOUND_COMPOUND_IMPACT_H

#include "compound/compound.h"
#include "linear/box.h"
#include "ovoid/compound_impact.h"
#include "shape/point.h"

/// The tree of a moving body, with parts in the body's own frame. 0 where the body has neither a shape nor a compound,
/// or both.
int moving_view_make(const ovoid_moving_body *body, body_view *view);

/// The part at a place of the order, as a moving shape.
ovoid_moving_shape moving_view_get_part(const ovoid_moving_body *body, const body_view *view, uint32_t place);

/// ovoid_moving_body_compute_box of a shape or a compound.
box moving_body_compute_box(const ovoid_moving_body *body, double begin, double end);

/// The ball around a node, as a moving shape; *ball holds its shape and must outlive it.
ovoid_moving_shape moving_node_make_sphere(const ovoid_moving_body *body, const compound_node *node, point_shape *ball);

#endif
