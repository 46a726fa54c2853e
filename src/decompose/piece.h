// What a convex cell has of a solid, while the solid is cut: the triangles clipped to the cell, and the cell. Caps are
// not needed: a corner of the hull of the solid's share is a corner of a clipped triangle, or a corner of the cell
// inside the solid.
#ifndef OVOID_DECOMPOSE_PIECE_H
#define OVOID_DECOMPOSE_PIECE_H

#include "decompose/body.h"
#include "polytope/hull.h"

/// Corners of triangles, three a triangle.
typedef struct soup {
    vec3 *corners;
    size_t count, room; ///< of corners
} soup;

/// A point of a hull outside the solid, and about how far.
typedef struct outlier {
    vec3 point;
    double distance;
    uint32_t triangle; ///< near it
} outlier;
enum { OUTLIERS = 256 };

typedef struct piece {
    soup triangles;
    ovoid_shape *frame; ///< the cell; user's units
    vec3 *points;       ///< corners of the hull
    uint32_t point_count;
    outlier outliers[OUTLIERS]; ///< the farthest first
    uint32_t outlier_count;
    double excess;   ///< estimated
    int is_finished; ///< no plane cuts it
} piece;

/// The whole solid. Errors: MEMORY and those of hulls.
ovoid_code piece_create(const body *b, piece *p, ovoid_error *error);
/// The piece cut by a plane; 0 in *is_cut where one side is empty. The piece stays. Errors: as above.
ovoid_code piece_divide(const body *b, const piece *p, const ovoid_plane *plane, piece sides[2], int *is_cut,
                        ovoid_error *error);
void piece_destroy(const body *b, piece *p);

/// Fills the outliers and the estimate from the hull of the points. Errors: MEMORY and those of hulls.
ovoid_code piece_estimate(const body *b, piece *p, ovoid_error *error);
/// The estimate of points' hull alone; where it is found to be above `enough`, some number above that.
ovoid_code points_estimate(const body *b, const vec3 *points, uint32_t count, double enough, double *excess,
                           ovoid_error *error);

/// A plane that leaves the least of the outliers in the hulls of both sides, and how much that is in the measure of
/// piece_compute_cost, with a hair for planes far from the middle; infinite where there is none.
double piece_find_plane(const body *b, const piece *p, ovoid_plane *plane);
/// The sum of the squares of the outliers' distances.
double piece_compute_cost(const piece *p);
/// A few planes that a second one may make good.
enum { PIECE_PLANES = 15 };
uint32_t piece_list_planes(const body *b, const piece *p, ovoid_plane planes[PIECE_PLANES]);
/// The plane by which the piece is cut; 0 in *is_found where there is none. Errors: MEMORY and those of hulls.
ovoid_code piece_choose_plane(const body *b, const piece *p, ovoid_plane *plane, int *is_found, ovoid_error *error);

/// Corners of the cell inside the solid, moved towards its middle by a hair: what touches from outside is not inside.
int piece_is_inside(const body *b, vec3 corner, vec3 middle);
vec3 piece_get_frame_point(const body *b, const ovoid_polytope *frame, uint32_t i);
vec3 piece_get_frame_middle(const body *b, const ovoid_polytope *frame);

#endif
