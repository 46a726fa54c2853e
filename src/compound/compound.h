// A compound's block: a header, then arrays at fixed offsets. The tree is a full binary tree in preorder with one part
// a leaf: a node over k parts is followed by its left subtree of 2 l - 1 nodes, l its parts, and then by the right one.
//
// Errors (docs/compound.md): with u = 2^-53, E_i = |position| + |shape's origin| + span + lower_radius (shape/block.h)
// of part i, a posed vertex as computed here is off by less than 46 u E_i; the bounds of nodes are widened by 64 u E_i
// for each part.
#ifndef OVOID_COMPOUND_COMPOUND_H
#define OVOID_COMPOUND_COMPOUND_H

#include "linear/pose.h"
#include "ovoid/compound.h"
#include "query/answer.h"

/// Bounds of the parts at [first, end) of the order, radii and rounding included: a box along the compound's axes, a
/// sphere around its centre, and an ellipsoid if that is narrower.
typedef struct compound_node {
    vec3 center;
    double radius;
    vec3 half;
    uint32_t first, end;
    vec3 shift; ///< of the ellipsoid's centre from the box's
    sym3 round; ///< the ellipsoid's matrix; zero: there is no ellipsoid
} compound_node;

static inline int node_is_round(const compound_node *n) { return n->round.xx > 0; }

/// A part in the compound's frame, ready for the first rejections.
typedef struct compound_part {
    const ovoid_shape *shape;
    ovoid_pose pose;
    mat3 rotation; ///< of the part's pose
    vec3 at;       ///< the origin of the shape's body frame
    vec3 center;   ///< of the sphere around the part
    double reach;  ///< of that sphere: the rounding radius and all rounding included
} compound_part;

/// More than the depth of a tree of 2^24 parts, of which each split gives at least a quarter to either side.
enum { COMPOUND_DEPTH_MAX = 64 };

struct ovoid_compound {
    uint32_t count;
    double extent;    ///< the largest E_i
    double allowance; ///< the largest width that a part's allowance gives a bracket
    ovoid_ellipsoid outer, inner;
    size_t size;
    ovoid_allocator allocator;
    // Arrays inside the block.
    compound_node *nodes; ///< 2 count - 1
    compound_part *parts; ///< in the order of the tree
    uint32_t *order;      ///< the caller's index of the part at each place of the tree's order
    uint32_t *places;     ///< the place of each of the caller's parts
};

static inline int node_is_leaf(const compound_node *n) { return n->end - n->first == 1; }
static inline const compound_node *node_get_left(const compound_node *n) { return n + 1; }
static inline const compound_node *node_get_right(const compound_node *n) {
    const compound_node *left = n + 1;
    return n + 2 * (size_t)(left->end - left->first);
}

/// The E of a part: an upper bound of all lengths from which its place in the compound's frame is computed.
double posed_shape_compute_extent(const ovoid_posed_shape *body);

/// The vertices of all parts, in the caller's order, in the compound's frame: those of part i are starts[i] to
/// starts[i + 1] - 1.
typedef struct parts_vertices {
    double *xyz;
    size_t *starts;
} parts_vertices;

/// Fills nodes, parts, order and places; 0 if memory runs out.
int tree_build(ovoid_compound *compound, const ovoid_posed_shape *parts, const parts_vertices *all);

/// The node of a single shape, in the shape's own frame.
compound_node node_make_shape(const ovoid_shape *shape);

/// The part, in the frame of its pose.
compound_part part_make(const ovoid_posed_shape *body);

/// An ellipsoid that encloses e and a ball of radius r around each of its points, with room for rounding, including
/// that of a support computed in doubles.
ovoid_ellipsoid ellipsoid_enlarge(ovoid_ellipsoid e, double r);

/// Fills the outer and inner ellipsoids; 0 if memory runs out.
int compound_compute_bounds(ovoid_compound *compound, const ovoid_posed_shape *parts, const parts_vertices *all);

#endif
