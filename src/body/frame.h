// A pair of posed bodies, each a solid, a shape or a compound, in the frame of the first; triangles as shapes.
//
// With u = 2^-53, ea, eb the largest point norms in the bodies' frames (of a shape its origin's norm, span and radius),
// t the place of b's frame and S = ea + eb + |t|:
// - the rotation of b in a's frame is off by 82 u, t by 43 u |t| (two rotations of a difference that is off by u);
// - a point of b in a's frame is off by 91 u S, as in pair/frame.h; so is one of a in b's;
// - centres and half sizes of boxes are off by 8 u S beside that, since boxes are rounded outward to single precision
//   when they are made; the largest of gaps, sums and a root by 16 u S;
// - a gap of two triangles along a unit direction is off by 100 u S, turning the direction to the world moves it by
//   42 u S, and whoever measures it again there is off by 148 u S.
// Together below 400 u S; a bound is lowered by 512 u S and twice what underflow can hide.
// A part of a compound is where the rounded product of two poses has it (compound.h): off by 45 u S more, and by u of
// its body's position; where a compound takes part, a bound is lowered by 8 u of both positions beside that.
#ifndef OVOID_SOLID_FRAME_H
#define OVOID_SOLID_FRAME_H

#include "body/body_view.h"
#include "solid/solid.h"

#define SOLID_CLAIM (512 * 0x1p-53)
#define SOLID_CHECK (148 * 0x1p-53)

/// A posed body as a tree, of which one pointer is set. The leaves of a compound's are its parts; a shape is a tree of
/// one leaf, "triangle" 0.
typedef struct solid_view {
    const ovoid_solid *solid;
    const ovoid_shape *shape;
    const ovoid_compound *compound;
    const ovoid_pose *pose;
    vec3 center;      ///< of the tree's frame, in the body's
    vec3 half;        ///< of the shape's box around it
    double extent;    ///< radius and allowance included
    double allowance; ///< the width that it gives every bracket
    uint32_t count;
} solid_view;

/// 0 where the body or its pose is refused.
int solid_view_make(const ovoid_body *body, solid_view *view);
static inline solid_ref solid_view_get_root(const solid_view *v) {
    return v->count > 1 || v->solid ? 0 : SOLID_TRIANGLE;
}
static inline uint32_t solid_view_get_index(const solid_view *v, uint32_t place) {
    return v->solid ? v->solid->order[place] : v->compound ? v->compound->order[place] : 0;
}
static inline uint32_t solid_view_get_place(const solid_view *v, uint32_t index) {
    return v->solid ? v->solid->places[index] : v->compound ? v->compound->places[index] : 0;
}
/// The places of the leaves below a node: [*first, *end).
void solid_view_get_range(const solid_view *v, solid_ref ref, uint32_t *first, uint32_t *end);
/// The children of a node that is no leaf; how many.
uint32_t solid_view_get_children(const solid_view *v, solid_ref node, solid_ref children[BOX8]);

/// The node of a compound that a reference names; of a leaf down from the root.
const compound_node *compound_get_node(const ovoid_compound *compound, solid_ref ref);

/// A box in a tree's frame, in the user's unit of length.
typedef struct tree_box {
    vec3 center, half;
} tree_box;
tree_box solid_view_get_box(const solid_view *v, solid_ref ref);

typedef struct solid_frame {
    mat3 world, world_b;         ///< of a's and of b's frame to the world
    mat3 to_a, to_b;             ///< of b's frame to a's, and of a's to b's: the transpose
    mat3 absolute_a, absolute_b; ///< the sizes of their entries
    vec3 offset;                 ///< of b's frame from a's, world
    vec3 translation;            ///< of b's frame, in a's
    vec3 between;                ///< of b's tree's frame from a's, in a's frame
    double size, claim, check;
} solid_frame;

void solid_frame_make(const solid_view *a, const solid_view *b, solid_frame *frame);

/// The width that a bracket of two bodies may keep beside their allowances.
static inline double solid_frame_compute_tolerance(const solid_frame *f, const ovoid_options *options) {
    return options_compute_tolerance(options, f->size, OVOID_LENGTH_MIN);
}

/// The bound of two boxes, and a unit direction in a's frame that shows it: as the kernel's. normal: one to try, in a's
/// frame.
typedef struct box_gap {
    double lower;
    vec3 normal;
} box_gap;
box_gap solid_frame_find_gap(const solid_frame *f, const tree_box *a, const tree_box *b, vec3 normal);

/// A box of b (side 0) or of a (side 1) as the kernel wants it beside nodes of the other; the
/// unit of these is left to the caller.
void solid_frame_turn(const solid_frame *f, int side, const tree_box *rest, vec3 normal, solid8_other *other);

/// The rule by which a pair that is not two triangles is split: 1 where the first is.
static inline int pair_is_split_first(solid_ref a, const tree_box *box_a, solid_ref b, const tree_box *box_b) {
    if (ref_is_triangle(a) || ref_is_triangle(b)) return ref_is_triangle(b);
    return box_a->half.x + box_a->half.y + box_a->half.z >= box_b->half.x + box_b->half.y + box_b->half.z;
}

int solid_views_split_first(const solid_view *a, solid_ref ref_a, const solid_view *b, solid_ref ref_b);
/// The rule of bodies without a solid: the balls around the nodes are compared.
int parts_views_split_first(const solid_view *a, solid_ref ref_a, const solid_view *b, solid_ref ref_b);

/// A triangle as a shape, without an allocation. It must not be moved once made.
typedef struct triangle_shape {
    ovoid_shape shape;
    _Alignas(64) double lanes[3][8];
    double vertices[16]; ///< nine, and what makes its size a multiple of its alignment
} triangle_shape;

/// What does not depend on the corners.
void triangle_begin(triangle_shape *t);
void triangle_set(triangle_shape *t, const vec3 corner[3]);

/// A leaf in the world: the body's shape, the part, or the triangle at that place, made in *room.
ovoid_posed_shape solid_view_get_leaf(const solid_view *v, uint32_t place, triangle_shape *room);

/// Components, of which each is inside of another body or outside of it: of a solid those of its surface, of a compound
/// its parts by the caller's index, of a shape the whole.
static inline uint32_t solid_view_get_component_count(const solid_view *v) {
    return v->solid ? v->solid->component_count : v->count;
}
/// 1 if a body has an inside that other bodies' components can be in.
static inline int solid_view_is_closed(const solid_view *v) { return v->solid && v->solid->report.is_closed; }

/// Is a component of one body inside of the other? For bodies whose surfaces are farther apart than frame->claim: 0 no,
/// 1 yes, with side (the body whose component it is) and component; -1: a winding number could not be found. linear: as
/// in solid_find_winding.
int solid_find_inside(const solid_view *a, const solid_view *b, int linear, ovoid_body_inside *inside,
                      uint32_t *component);
/// The same for one component: 1 if the other body winds around its point.
int solid_is_inside(const solid_view *own, const solid_view *other, uint32_t component, int linear);

/// The bound by the boxes of both roots, lowered by the claim, and its direction in the world: what parts the bodies.
box_gap solid_frame_find_parting(const solid_frame *f, const solid_view *a, const solid_view *b);
/// The same by all points, along the best of some directions (parting.c). normal: one to try, world frame.
box_gap solid_find_parting(const solid_frame *f, const solid_view *a, const solid_view *b, vec3 normal);

#endif
