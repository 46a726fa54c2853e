// A compound's block: a header, then arrays at fixed offsets. The tree is a full binary tree in preorder with one part
// a leaf: a node over k parts is followed by its left subtree of 2 l - 1 nodes, l its parts, and then by the right one.
//
// Errors (docs/compound.md): with u = 2^-53, E_i = |position| + |shape's origin| + extent + radius of part i, a posed
// vertex as computed here is off by less than 46 u E_i; the bounds of nodes are widened by 64 u E_i for each part.
#ifndef OVOID_SCENE_COMPOUND_H
#define OVOID_SCENE_COMPOUND_H

#include "linear/pose.h"
#include "ovoid/compound.h"
#include "query/answer.h"

/// Bounds of the parts at [first, end) of the order, radii and rounding included: a box along the compound's axes, a
/// sphere around its centre, and an ellipsoid where that is the narrower one.
typedef struct compound_node {
    vec3 center;
    double radius;
    vec3 half;
    uint32_t first, end;
    vec3 shift; ///< of the ellipsoid's centre
    sym3 round; ///< its matrix; zero: there is none
} compound_node;

static inline int node_is_round(const compound_node *n) { return n->round.xx > 0; }

/// A part in the compound's frame, ready for a first look.
typedef struct compound_part {
    const ovoid_shape *shape;
    ovoid_pose pose;
    mat3 rotation; ///< of the pose
    vec3 at;       ///< of the shape's body frame
    vec3 center;   ///< of the sphere around the part
    double reach;  ///< its radius: the rounding radius and all rounding included
} compound_part;

/// More than the depth of a tree of 2^24 parts, of which each split gives at least a quarter to either side.
enum { COMPOUND_DEPTH_MAX = 64 };

struct ovoid_compound {
    uint32_t count;
    double extent; ///< the largest E_i
    ovoid_ellipsoid outer, inner;
    size_t size;
    ovoid_allocator allocator;
    // Into the block.
    compound_node *nodes; ///< 2 count - 1
    compound_part *parts; ///< in the order of the tree
    uint32_t *order;      ///< the caller's index of the part at a place
    uint32_t *places;     ///< the place of the caller's part
};

static inline int node_is_leaf(const compound_node *n) { return n->end - n->first == 1; }
static inline const compound_node *node_get_left(const compound_node *n) { return n + 1; }
static inline const compound_node *node_get_right(const compound_node *n) {
    const compound_node *left = n + 1;
    return n + 2 * (size_t)(left->end - left->first);
}
/// 1 if of a pair of nodes, not both leaves, the first is to be split.
static inline int node_is_split_first(const compound_node *a, const compound_node *b) {
    return node_is_leaf(b) || (!node_is_leaf(a) && a->radius >= b->radius);
}

/// E of a part: no quantity that its place in the compound's frame is made of is larger.
double body_compute_extent(const ovoid_body *body);

/// The vertices of all parts, in the caller's order, in the compound's frame: those of part i are starts[i] to
/// starts[i + 1] - 1.
typedef struct parts_vertices {
    double *xyz;
    size_t *starts;
} parts_vertices;

/// Fills nodes, parts, order and places; 0 where there is no memory.
int tree_build(ovoid_compound *compound, const ovoid_body *parts, const parts_vertices *all);

/// One node around a shape in its own frame.
compound_node node_make_shape(const ovoid_shape *shape);

/// The part, in the frame that its pose is in.
compound_part part_make(const ovoid_body *body);

/// The ellipsoid that encloses e and a ball of radius r around each of its points, rounding included: also that of
/// whoever computes its support in doubles.
ovoid_ellipsoid ellipsoid_enlarge(ovoid_ellipsoid e, double r);

/// Fills the outer and inner ellipsoids; 0 where there is no memory.
int compound_compute_bounds(ovoid_compound *compound, const ovoid_body *parts, const parts_vertices *all);

/// A solid as queries see it: a tree over parts.
typedef struct solid_view {
    const compound_node *nodes;
    const compound_part *parts;
    const ovoid_compound *compound; ///< NULL: a shape
    const ovoid_pose *pose;
    double extent;
    uint32_t count;
    // Of a shape.
    compound_node own_node;
    compound_part own_part;
} solid_view;

/// 0 where the pose is refused.
int solid_view_make(const ovoid_solid *solid, solid_view *view);

/// The part at a place, in the world.
static inline ovoid_body solid_view_get_part(const solid_view *v, uint32_t place) {
    const compound_part *part = &v->parts[place];
    if (!v->compound) return (ovoid_body){part->shape, *v->pose};
    return (ovoid_body){part->shape, pose_compute_product(v->pose, &part->pose)};
}
/// The caller's index of it.
static inline uint32_t solid_view_get_index(const solid_view *v, uint32_t place) {
    return v->compound ? v->compound->order[place] : 0;
}

/// The answer to a question, inside a public function: the floating-point environment is the default one already.
void solid_find_inside(const ovoid_solid_pair *pair, const ovoid_options *options, question ask,
                       const ovoid_compound_proof *earlier, ovoid_exclusions *exclusions, ovoid_compound_answer *out);

/// Sorts exclusions by their ranges.
void exclusions_sort(ovoid_exclusion *items, size_t count);

#endif
