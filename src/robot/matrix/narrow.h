// The chains of two groups alone: what moves elsewhere in the robot costs nothing there.
#ifndef OVOID_ROBOT_MATRIX_NARROW_H
#define OVOID_ROBOT_MATRIX_NARROW_H

#include "robot/path/motion.h"

/// A path's work whose steps are those above the items of two groups. The other items' links are not set.
typedef struct narrow_work {
    path_work w; ///< shares the memory of `whole` but for steps, joints, axes, speeds, and links
    const path_work *whole;
    uint32_t *place;          ///< of each step of the whole: which it is
    unsigned char *is_needed; ///< of each frame
    void *block;
} narrow_work;

/// Memory for any two groups; 0: there is none. `whole` outlives it.
int narrow_create(narrow_work *n, const path_work *whole);
void narrow_destroy(narrow_work *n);
/// Takes the steps that two groups of the cell need.
void narrow_choose(narrow_work *n, uint32_t group_a, uint32_t group_b);

#endif
