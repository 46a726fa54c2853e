// A solid's block: a header, then arrays at fixed offsets. The tree has eight children to a node, each a node or one
// triangle; the triangles of a node are a range of the tree's order. Its boxes are in the tree's frame, the solid's
// frame moved to `center`, in units of a power of two, `unit`: so single precision serves solids of any size and place.
// Each node has a second set of boxes around its children, along axes of its own (frames.c): queries of two bodies
// use these, whatever goes along the solid's axes (rays, crossings, motions) the first.
#ifndef OVOID_SOLID_SOLID_H
#define OVOID_SOLID_SOLID_H

#include "linear/box.h"
#include "linear/mat3.h"
#include "linear/pose.h"
#include "ovoid/solid.h"
#include "simd/solid8.h"

/// A node beside its box8: its own box, in the tree's frame and unit, and the places of its triangles.
typedef struct solid_node {
    float low[3], high[3];
    uint32_t first, end;
    uint32_t children;
} solid_node;

/// The axes of a node, as rows in the tree's frame, and its box along them around the tree's origin, in its unit.
typedef struct node_frame {
    mat3 axes;
    float low[3], high[3];
} node_frame;

static const mat3 axes_upright = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
/// A rotation whose first row is along the first vector, and whose third is across both; upright if the two are nearly
/// parallel. With u = 2^-53 its rows are units to 4 u and perpendicular to 8 u, however short or near the vectors.
mat3 axes_make(vec3 first, vec3 second);

/// Three points, by index.
typedef struct solid_triangle {
    uint32_t point[3];
} solid_triangle;

struct ovoid_solid {
    uint32_t point_count, triangle_count, node_count, component_count;
    uint32_t depth; ///< nodes on the longest path down
    vec3 center;    ///< of the box of all points
    double unit;    ///< a power of two, at least the largest size of a coordinate from `center`
    double extent;  ///< no point is farther than this from the frame's origin, rounding included
    double reach;   ///< no point is farther than this from `center`, rounding included
    ovoid_solid_report report;
    size_t size;
    ovoid_allocator allocator;
    // Arrays inside the block.
    double *points;
    solid_triangle *triangles; ///< in the order of the tree
    uint32_t *order;           ///< the caller's index of the triangle at each place
    uint32_t *places;          ///< the place of each of the caller's triangles
    box8 *boxes, *turned;      ///< along the solid's axes, and along each node's; with equal children
    solid_node *nodes;
    node_frame *frames;
    uint32_t *components; ///< one point of each component
    // Facets (facets.c), of the triangle at each place.
    double flatness;  ///< no corner of a facet is farther than this from its plane
    uint32_t *facets; ///< the facet, named by the place of the triangle that gives its plane
    uint8_t *bends;   ///< of each edge a solid_bend, two bits each; and the two bits below
};

/// How a surface bends at an edge of a triangle, seen from outside.
typedef enum solid_bend {
    SOLID_FLAT = 0, ///< inside of a facet
    SOLID_CONVEX,
    SOLID_CONCAVE,
    SOLID_OPEN ///< no other triangle has the edge
} solid_bend;
enum {
    SOLID_ALONE = 64,   ///< the facet is this triangle
    SOLID_NO_AREA = 128 ///< the triangle is in no facet
};
static inline solid_bend solid_get_bend(const ovoid_solid *s, uint32_t place, int edge) {
    return (solid_bend)(s->bends[place] >> (2 * edge) & 3);
}
/// The outward unit normal of a facet; of a surface that is not closed, the side from which its triangles are
/// counter-clockwise.
vec3 solid_compute_facet_normal(const ovoid_solid *solid, uint32_t facet);

static inline vec3 solid_get_corner(const ovoid_solid *s, uint32_t place, int corner) {
    return vec3_at(s->points, s->triangles[place].point[corner]);
}

/// A point of the solid's frame in the tree's frame and unit.
static inline vec3 solid_to_tree(const ovoid_solid *s, vec3 p) {
    return vec3_scale(vec3_sub(p, s->center), 1 / s->unit);
}

/// A node of a tree, or a leaf: the place of a triangle of a solid.
typedef uint32_t tree_ref;
#define TREE_LEAF 0x80000000u
static inline int ref_is_leaf(tree_ref r) { return (r & TREE_LEAF) != 0; }
static inline uint32_t ref_get_index(tree_ref r) { return r & ~TREE_LEAF; }
/// Child i < nodes[node].children of a node.
static inline tree_ref solid_get_child(const ovoid_solid *s, uint32_t node, uint32_t i) {
    const box8 *b = &s->boxes[node];
    return b->child[i] | (b->leaves >> i & 1 ? TREE_LEAF : 0);
}

/// Steps down a tree of 2^26 triangles: each child of more than eight has at most three quarters of its parent's.
enum { SOLID_DEPTH_MAX = BOX8_DEPTH };

/// The data of a solid's triangles before the block is made.
typedef struct solid_parts {
    const double *points;
    const solid_triangle *triangles; ///< in the caller's order
    uint32_t point_count, triangle_count;
} solid_parts;

/// Fills the report, except for the box, and writes one point of each component into `points` (room for at least
/// point_count). Returns the number of components, or 0 if memory runs out.
uint32_t solid_compute_report(const solid_parts *parts, const ovoid_allocator *allocator, uint32_t *components,
                              ovoid_solid_report *report);

/// A triangle's box in the tree's frame and unit.
box solid_make_bounds(const ovoid_solid *solid, const solid_triangle *triangle);
/// The largest number of nodes of a tree of that many triangles.
uint32_t tree_get_most_nodes(uint32_t triangles);
/// Fills boxes, nodes, order and node_count; center and unit must be set. triangles: in the caller's order. 0 if memory
/// runs out.
int solid_build_tree(ovoid_solid *solid, const solid_triangle *triangles);
/// Fills frames and turned, beside a tree and triangles in its order.
void solid_make_frames(ovoid_solid *solid);

/// Fills flatness, facets and bends, beside everything else. 0 if memory runs out.
int solid_find_facets(ovoid_solid *solid);

/// The signed crossing of the ray from p toward +x with a triangle, with p moved by an infinitesimal amount: 1, 0 or
/// -1; 2 if p is on the triangle, by exact signs. Coordinates in units of the body. index: of the corners, so that both
/// triangles of an edge agree.
int ray_count_crossing(vec3 p, const vec3 corner[3], const uint32_t index[3]);

/// ovoid_solid_compute_winding for callers inside a public function. linear: reads all triangles, without the tree.
int solid_find_winding(const ovoid_solid *solid, vec3 point, int linear, int64_t *winding);

#endif
