// The least overlap of two cores, as far as it is seen from a direction.
#ifndef OVOID_QUERY_SWEPT_DESCEND_H
#define OVOID_QUERY_SWEPT_DESCEND_H

#include "query/swept/patch.h"

/// Two cores, of which B's centre is d from A's.
typedef struct cores {
    const ovoid_swept_sphere *a, *b;
    vec3 d;
    double size;
} cores;

/// A smooth piece of the overlap along a direction: of both cores one.
typedef struct piece {
    unsigned a, b;
    patch on_a, on_b;
    patch_form form; ///< the second derivatives of both together
    double value;    ///< along the direction
    double g[2];     ///< its slope along the plane's vectors
    double weight;   ///< not below 0; of all pieces together 1
} piece;

enum { LEAST_PIECES = 6 };

/// A local minimum of the overlap h(n), the width along n of what is common, over the unit directions n from A to B: no
/// translation that is about along n and parts the cores is shorter.
typedef struct least_overlap {
    patch_plane of;
    double value;  ///< h(n)
    double lowest; ///< the least of the pieces' values
    double slope;  ///< of their weighted mean
    double inside; ///< of a facet how far its point is within its edges; 0: it is not one of a facet, there are pieces
                   ///< beside it, which a facet need not have
    int count;
    piece pieces[LEAST_PIECES]; ///< the first `active`, at most three, have weights
    int active;
    vec3 on_a, on_b; ///< A's and B's points of it, from each centre
} least_overlap;

/// The point of A that is the farthest along n, less the one of B that is the farthest the other way: as far as that
/// goes along a unit n the cores overlap there, and no farther. Both from their centres.
typedef struct overlap_ends {
    vec3 on_a, on_b, v;
} overlap_ends;
COMPILER_INLINED overlap_ends cores_find_ends(const cores *p, vec3 n) {
    const vec3 on_a = patch_find_end(p->a, n, 1), on_b = patch_find_end(p->b, vec3_neg(n), 1);
    return (overlap_ends){on_a, on_b, vec3_sub(vec3_sub(on_a, on_b), p->d)};
}

/// Descends from a unit direction, along which the overlap is `height`, to a local minimum that is not above that, with
/// the pieces that are in *to already; 0 if none is found in a few steps. Where h is not above 0 on the way the cores
/// are apart: the value is that, and nothing else is set.
int cores_descend(const cores *p, vec3 from, double height, least_overlap *to);

/// Adds the piece of an ellipsoid to a minimum along the normal of the other core's facet, for the angle around it. 1.
int least_overlap_add_piece(const cores *p, int is_facet_b, least_overlap *to);

/// The tangent of an angle around the minimum's direction in which no overlap is less than `wanted`; 0 if none is
/// proven.
double least_overlap_find_angle(const least_overlap *at, double wanted);

#endif
