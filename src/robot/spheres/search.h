// A search for balls that cover points and little else.
#ifndef OVOID_ROBOT_SPHERES_SEARCH_H
#define OVOID_ROBOT_SPHERES_SEARCH_H

#include "polytope/sphere.h"
#include "robot/spheres/spheres.h"
#include "tools/random.h"

enum { SPHERES_MOST = 4096, SAMPLES = 12000, OUTSIDE = 16000, SAMPLES_MORE = 4096, BLOCK = 32, GROUP = 8 * BLOCK };

/// Boxes around each block of points, and each group of blocks.
typedef struct sample_boxes {
    box *blocks, *groups;
} sample_boxes;

/// Points that must be covered, points outside the link that should not be, and the balls. Each point knows how many
/// balls hold it.
typedef struct spheres_samples {
    vec3 *points, *outside;
    uint16_t *point_hits, *outside_hits;
    uint32_t point_count, point_room, outside_count;
    sphere *balls;
    uint32_t ball_count;
    long excess;     ///< points outside that some ball holds: what the search makes small
    double weight;   ///< the volume that each of them stands for
    uint64_t random; ///< the state of the random numbers
    vec3 *own;       ///< scratch: the points that one ball alone holds
    uint32_t own_count;
    box region; ///< the points outside are of it, and no ball leaves it
    sample_boxes point_boxes, outside_boxes;
    const ovoid_watch *watch; ///< asked before each move
} spheres_samples;

/// Puts points that are near each other into one block.
void spheres_sort_blocks(vec3 *points, uint32_t count);
/// Boxes and hits anew.
void spheres_samples_recount(spheres_samples *s);
/// Gathers in `own` the points that ball i alone holds.
void spheres_samples_gather(spheres_samples *s, uint32_t i);
/// Puts the smallest ball around its own points, and one more if `also` is not NULL, in place of ball i.
void spheres_samples_fit(spheres_samples *s, uint32_t i, const vec3 *also);
/// The first balls: count of them, all points covered.
void spheres_samples_begin(spheres_samples *s, uint32_t count);
/// Makes that many moves, of which the first are as bold as `hot` says and the last as `cold` does, between 1 and 0.
/// The scratch balls and hits are as large as those of *s.
void spheres_samples_improve(spheres_samples *s, spheres_samples *scratch, size_t moves, double hot, double cold);

#endif
