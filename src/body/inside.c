// Containment. Where the surfaces of two bodies do not meet, each component of either surface lies in the other body or
// outside of it, whole; and if the bodies have a point in common, some component of one lies in the other: around a
// common point the region that both cover is bounded by surfaces of one that the other covers. So one point of each
// component decides.
//
// The parts of a compound are its components: each is connected, and a surface that enters the union of the parts meets
// one of them.
//
// The point is rounded in the other's frame, off by less than 91 u S (of a part 136 u S), and the surfaces are farther
// apart than the claim of 512 u S: on the way from the exact point to the rounded one no surface is met, so the winding
// number is the same.
#include "body/tree_frame.h"

#include "linear/rotation.h"

// A point of a component in the frame of the other body.
static vec3 find_point(const body_tree *own, const body_tree *other, uint32_t component) {
    vec3 p;
    ovoid_pose pose = *own->pose;
    if (own->solid) {
        p = vec3_at(own->solid->points, own->solid->components[component]);
    } else {
        ovoid_posed_shape leaf = body_tree_get_leaf(own, body_tree_get_place(own, component), NULL);
        p = vec3_add(leaf.shape->origin, leaf.shape->first);
        pose = leaf.pose;
    }
    mat3 r = quat_to_mat3(pose.rotation), q = quat_to_mat3(other->pose->rotation);
    vec3 offset = vec3_sub(pose.position, other->pose->position);
    return mat3_mul_transposed_vec3(q, vec3_add(mat3_mul_vec3(r, p), offset));
}

int tree_is_inside(const body_tree *own, const body_tree *other, uint32_t component, int linear) {
    int64_t winding;
    if (!body_tree_is_closed(other)) return 0;
    if (!solid_find_winding(other->solid, find_point(own, other, component), linear, &winding)) return -1;
    return winding != 0;
}

int trees_find_inside(const body_tree *a, const body_tree *b, int linear, contained_component *found) {
    int is_open = 0;
    for (int side = 0; side < 2; side++) {
        const body_tree *own = side ? b : a, *other = side ? a : b;
        uint32_t count = body_tree_get_component_count(own);
        if (!body_tree_is_closed(other)) continue;
        for (uint32_t i = 0; i < count; i++) {
            int is = tree_is_inside(own, other, i, linear);
            is_open |= is < 0;
            if (is <= 0) continue;
            *found = (contained_component){side ? OVOID_BODY_B_INSIDE : OVOID_BODY_A_INSIDE, i};
            return 1;
        }
    }
    return is_open ? -1 : 0;
}
