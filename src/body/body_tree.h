// A posed body of any kind as a tree: of a solid the leaves are its triangles, of a compound its parts, and a shape is
// a tree of one leaf.
#ifndef OVOID_BODY_BODY_TREE_H
#define OVOID_BODY_BODY_TREE_H

#include "compound/compound.h"
#include "ovoid/body.h"
#include "solid/solid.h"

typedef struct body_tree {
    const ovoid_solid *solid; ///< one of these three is set
    const ovoid_shape *shape;
    const ovoid_compound *compound;
    const ovoid_pose *pose;
    vec3 center;      ///< of the tree's frame, in the body's
    vec3 half;        ///< of a shape's box around it; of others not set
    double extent;    ///< no point is farther than this from the body's origin, radius included
    double allowance; ///< the width that it gives every bracket
    uint32_t count;   ///< of leaves
} body_tree;

/// 1 if exactly one of a body's pointers is set.
static inline int body_is_one(const ovoid_body *body) { return !!body->shape + !!body->compound + !!body->solid == 1; }

/// 0 where the body or its pose is refused.
int body_tree_make(const ovoid_body *body, body_tree *tree);
/// The trees of both bodies, or the reason why their queries are refused.
ovoid_limit body_trees_make(const ovoid_body_pair *pair, body_tree *a, body_tree *b);

static inline tree_ref body_tree_get_root(const body_tree *tree) {
    return tree->count > 1 || tree->solid ? 0 : TREE_LEAF;
}
/// The caller's index of the leaf at a place of the tree's order, and the place of an index.
static inline uint32_t body_tree_get_index(const body_tree *tree, uint32_t place) {
    return tree->solid ? tree->solid->order[place] : tree->compound ? tree->compound->order[place] : 0;
}
static inline uint32_t body_tree_get_place(const body_tree *tree, uint32_t index) {
    return tree->solid ? tree->solid->places[index] : tree->compound ? tree->compound->places[index] : 0;
}
/// The place of a leaf.
static inline uint32_t body_tree_get_leaf_place(const body_tree *tree, tree_ref leaf) {
    return tree->compound ? tree->compound->nodes[ref_get_index(leaf)].first : ref_get_index(leaf);
}
/// The places of the leaves below a node: [*first, *end).
void body_tree_get_range(const body_tree *tree, tree_ref ref, uint32_t *first, uint32_t *end);
/// The children of a node that is no leaf; how many.
uint32_t body_tree_get_children(const body_tree *tree, tree_ref node, tree_ref children[BOX8]);

/// A node of a compound's tree; of a leaf too.
static inline tree_ref compound_get_ref(const ovoid_compound *compound, const compound_node *node) {
    return (tree_ref)(node - compound->nodes) | (node_is_leaf(node) ? TREE_LEAF : 0);
}

/// A box in a tree's frame, in the user's unit of length.
typedef struct tree_box {
    vec3 center, half;
} tree_box;
tree_box body_tree_get_box(const body_tree *tree, tree_ref ref);
/// A box of a solid's tree, from its unit.
static inline tree_box solid_scale_box(const ovoid_solid *s, const float low[3], const float high[3]) {
    vec3 from = {low[0], low[1], low[2]}, to = {high[0], high[1], high[2]};
    double half = 0.5 * s->unit;
    return (tree_box){vec3_scale(vec3_add(to, from), half), vec3_scale(vec3_sub(to, from), half)};
}

/// A box along axes of its own: rows in the tree's frame, in which its centre is too.
typedef struct turned_box {
    tree_box box;
    mat3 axes;
} turned_box;
/// The thinnest box at hand around a node or leaf: along its node's axes, or along its triangle.
turned_box body_tree_get_turned_box(const body_tree *tree, tree_ref ref);
/// The box that the parent of a node or leaf has around it; the root's own.
turned_box body_tree_get_child_box(const body_tree *tree, tree_ref ref);

/// Of a pair of nodes, not both leaves, 1 if the first is to be split: where one of the bodies is a solid the one with
/// the larger box, else the one with the larger ball.
int trees_split_first(const body_tree *a, tree_ref ref_a, const body_tree *b, tree_ref ref_b);

/// A triangle as a shape, without an allocation. It must not be moved once made.
typedef struct triangle_shape {
    ovoid_shape shape;
    _Alignas(64) double lanes[3][8];
    double vertices[16]; ///< nine, and what makes its size a multiple of its alignment
} triangle_shape;

/// What does not depend on the corners.
void triangle_begin(triangle_shape *t);
void triangle_set(triangle_shape *t, const vec3 corner[3]);

ovoid_posed_shape solid_get_leaf(const body_tree *tree, uint32_t place, triangle_shape *room);
/// A leaf in the world: the body's shape, the part, or the triangle at that place, made in *room, which triangle_begin
/// has made; NULL will do for a body without triangles.
static inline ovoid_posed_shape body_tree_get_leaf(const body_tree *tree, uint32_t place, triangle_shape *room) {
    if (tree->solid) return solid_get_leaf(tree, place, room);
    if (tree->shape) return (ovoid_posed_shape){tree->shape, *tree->pose};
    const compound_part *part = &tree->compound->parts[place];
    return (ovoid_posed_shape){part->shape, pose_compute_product(tree->pose, &part->pose)};
}

/// Components, of which each is inside of another body or outside of it: of a solid those of its surface, of a compound
/// its parts by the caller's index, of a shape the whole.
static inline uint32_t body_tree_get_component_count(const body_tree *tree) {
    return tree->solid ? tree->solid->component_count : tree->count;
}
/// 1 if a body has an inside that other bodies' components can be in.
static inline int body_tree_is_closed(const body_tree *tree) { return tree->solid && tree->solid->report.is_closed; }

/// A component of a body that lies inside of the other one.
typedef struct contained_component {
    ovoid_body_inside inside; ///< whose component it is
    uint32_t component;
} contained_component;

/// Is a component of one body inside of the other? For bodies whose surfaces are farther apart than frame->claim: 0 no,
/// 1 yes, with *found; -1: a winding number could not be found. linear: as in solid_find_winding.
int trees_find_inside(const body_tree *a, const body_tree *b, int linear, contained_component *found);
/// 1 if the other body winds around the point of one component of the own one; 0, or -1, as above.
int tree_is_inside(const body_tree *own, const body_tree *other, uint32_t component, int linear);

#endif
