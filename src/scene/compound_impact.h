// Moving solids as trees, and the moving balls around their nodes.
#ifndef OVOID_SCENE_COMPOUND_IMPACT_H
#define OVOID_SCENE_COMPOUND_IMPACT_H

#include "ovoid/compound_impact.h"
#include "query/point.h"
#include "scene/compound.h"

/// The tree of a solid; parts are taken in the solid's own frame.
void moving_view_make(const ovoid_moving_solid *solid, solid_view *view);

/// A part at a place, as it moves.
ovoid_moving moving_view_get_part(const ovoid_moving_solid *solid, const solid_view *view, uint32_t place);

/// The ball around a node, as it moves; *ball is where its shape lives.
ovoid_moving moving_node_make_ball(const ovoid_moving_solid *solid, const compound_node *node, point_shape *ball);

#endif
