// Moving bodies of any kind as trees: their leaves, and the balls around their nodes, as moving shapes.
#ifndef OVOID_BODY_MOVING_TREE_H
#define OVOID_BODY_MOVING_TREE_H

#include "body/tree_frame.h"
#include "motion/impact.h"
#include "ovoid/body_impact.h"
#include "shape/point.h"

typedef struct moving_tree {
    const ovoid_moving_body *body;
    body_tree tree; ///< in the moving frame; its pose is not used
    int has_boxes;  ///< balls are around the nodes' boxes; 0: those of a compound's nodes and of a shape
    vec3 center;    ///< of the ball around a shape
    double radius;
} moving_tree;

/// 0 where the body has not exactly one of shape, compound and solid. has_boxes: beside a solid.
int moving_tree_make(const ovoid_moving_body *body, int has_boxes, moving_tree *moving);

/// Both bodies of a pair.
typedef struct moving_trees {
    moving_tree a, b;
    int has_solid;
} moving_trees;
/// NONE, or the reason why their queries are refused.
ovoid_limit moving_trees_make(const ovoid_moving_body *a, const ovoid_moving_body *b, moving_trees *trees);

/// Room for a leaf or a ball; it must outlive the moving shape that is made in it, and not be moved.
typedef union moving_room {
    point_shape ball;
    triangle_shape triangle;
} moving_room;

/// The leaf at a place: the triangle, the part, the shape.
ovoid_moving_shape moving_tree_get_leaf(const moving_tree *moving, uint32_t place, moving_room *room);
/// A ball around a node or a leaf.
ovoid_moving_shape moving_tree_make_ball(const moving_tree *moving, tree_ref ref, moving_room *room);

/// Two moving shapes and the room that they are made in.
typedef struct moving_couple {
    moving_room rooms[2];
    ovoid_moving_shape made[2];
} moving_couple;
/// The balls around two nodes or leaves.
moving_shapes moving_trees_make_balls(const moving_trees *trees, tree_ref a, tree_ref b, moving_couple *couple);
/// The leaves at two places.
moving_shapes moving_trees_get_leaves(const moving_trees *trees, uint32_t a, uint32_t b, moving_couple *couple);
/// The leaves where both are leaves, else the balls: what a group of steps is about.
moving_shapes moving_trees_get_pair(const moving_trees *trees, tree_ref a, tree_ref b, moving_couple *couple);

/// The bodies at a time: whether they are within the margin there, for computed poses, and by how much the exact motion
/// may differ from these.
typedef struct moving_answer {
    ovoid_body_pair pair;
    ovoid_body_answer answer;
    double shift;
} moving_answer;
void moving_trees_ask(const moving_trees *trees, double margin, double time, moving_answer *out);
/// 1 if the answer shows that the bodies are apart then, and neither is inside the other; linear: by all triangles.
int moving_answer_is_apart(const moving_answer *x, int linear);

#endif
