// The least overlap of a box and a triangle in closed form, in the box's frame: its middle is the origin, its edges are
// along the axes.
#ifndef OVOID_LINEAR_BOX_TRIANGLE_H
#define OVOID_LINEAR_BOX_TRIANGLE_H

#include "linear/vec3.h"

/// The shortest translation of the triangle, by value along the unit n, that parts it from the box. Moved along n by
/// less, it still overlaps the box; no overlap along another direction is less than `lower`.
typedef struct box_triangle {
    vec3 n;
    double value, lower;
    vec3 on_box, on_triangle; ///< points of both: on_box - on_triangle is value n, to rounding
} box_triangle;

/// 1 if the bodies overlap by more than `doubt`, and the points were found. Else, as of a triangle that is nearly a
/// segment, or where several directions are as good to rounding and the points are of none alone, *to is undefined.
/// half: of the box, none negative. doubt: 16 u of a length that no coordinate and no half exceeds, or more. Cost: 13
/// directions, both ways.
int box_triangle_find_overlap(const double half[3], const vec3 corner[3], double doubt, box_triangle *to);

#endif
