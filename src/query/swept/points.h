// The points of a least overlap along whose direction a body has more than one farthest point.
#ifndef OVOID_QUERY_SWEPT_POINTS_H
#define OVOID_QUERY_SWEPT_POINTS_H

#include "query/swept/pair.h"

/// The direction of the side's line of a cylinder or a cone that is farthest along n, a normal of its side.
static inline vec3 points_find_line(const ovoid_swept_sphere *s, vec3 n) {
    const vec3 axis = s->axis[0];
    if (s->core != OVOID_SWEPT_CONE) return axis;
    const vec3 out = vec3_unit(vec3_add_scaled(n, axis, -vec3_dot(axis, n)));
    return vec3_add_scaled(vec3_scale(axis, 2 * s->half[0]), out, -s->half[1]);
}

/// Where a line crosses another one, seen along n: the point of the former. from, to: a point of each.
static inline vec3 points_find_crossing(vec3 from, vec3 line, vec3 to, vec3 other, vec3 n) {
    const vec3 across = vec3_cross(other, n);
    return vec3_add_scaled(from, line, vec3_dot(across, vec3_sub(to, from)) / vec3_dot(across, line));
}

/// Moves a point beside a core to the nearest one of it. 0 if it is in it.
static inline int points_move_in(const ovoid_swept_sphere *core, vec3 *y, double doubt) {
    const swept_way_out out = swept_leave_core(core, *y);
    if (out.is_inside || out.depth > 0 || out.distance <= doubt) return 0;
    *y = vec3_sub(*y, out.off);
    return 1;
}

#endif
