/**
 * @file swept.hpp
 * FCL's spheres, capsules, boxes, cylinders and cones as swept spheres (<ovoid/swept.h>), for <ovoid/fcl.hpp>: they are
 * read from the geometry and the transform in each call, so nothing of them is kept, looked up or prepared.
 */
#ifndef OVOID_FCL_SWEPT_HPP
#define OVOID_FCL_SWEPT_HPP

#include "ovoid/fcl/body.hpp"
#include "ovoid/fcl/contacts.hpp"
#include "ovoid/fcl/faces.hpp"
#include "ovoid/swept.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace ovoid {
namespace fcl {
namespace detail {

/// The axis of a cylinder, a cone or a capsule: the third column; false if it is no unit vector.
template <class S> OVOID_FCL_INLINE bool set_axis(const ::fcl::Transform3<S> &t, ovoid_swept_sphere &to) {
    to.axis[0] = get_column<S>(t, 2);
    return off_unit(to.axis[0]) <= columns_rounding;
}
/// The axes of a box, an ellipsoid or a convex polytope; false if they are not those of a rotation.
template <class S> OVOID_FCL_INLINE bool set_axes(const ::fcl::Transform3<S> &t, ovoid_swept_sphere &to) {
    for (int k = 0; k < 3; k++) to.axis[k] = get_column<S>(t, k);
    return off_rotation(to.axis) <= columns_rounding || straighten(to.axis);
}

/// A cylinder or a cone around its own z axis, but for its centre.
template <class S, class Round>
OVOID_FCL_INLINE bool make_round(const Round &g, ovoid_swept_core core, const ::fcl::Transform3<S> &t,
                                 ovoid_swept_sphere &to) {
    to.radius = 0;
    to.core = core;
    to.half[0] = static_cast<double>(g.lz) / 2;
    to.half[1] = static_cast<double>(g.radius);
    return g.lz > 0 && g.radius > 0 && set_axis<S>(t, to);
}

/// A box or an ellipsoid, but for its centre: parts of the lengths are its half axes.
template <class S>
OVOID_FCL_INLINE bool make_box(const ::fcl::Vector3<S> &lengths, double part, ovoid_swept_core core,
                               const ::fcl::Transform3<S> &t, ovoid_swept_sphere &to) {
    to.radius = 0;
    to.core = core;
    for (int k = 0; k < 3; k++) to.half[k] = part * static_cast<double>(lengths[k]);
    return lengths[0] > 0 && lengths[1] > 0 && lengths[2] > 0 && set_axes<S>(t, to);
}

/// The most vertices of a convex polytope that are read in each step of a search; of more its shape's tables answer.
constexpr std::size_t most_swept_points = 32;

/// A convex polytope or a triangle, but for its centre, with the mean of its corners as the point in the middle.
template <class S>
bool make_points(const ::fcl::Vector3<S> *corners, std::size_t count, const ::fcl::Transform3<S> &t,
                 ovoid_swept_sphere &to) {
    // Numbers in single precision would have to be copied.
    if (!std::is_same<S, double>::value || count == 0 || count > most_swept_points) return false;
    double sum[3] = {0, 0, 0};
    for (std::size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) sum[k] += static_cast<double>(corners[i][k]);
    to.radius = 0;
    to.core = OVOID_SWEPT_POINTS;
    to.points = reinterpret_cast<const double *>(corners);
    to.count = static_cast<std::uint32_t>(count);
    to.shape = nullptr;
    for (int k = 0; k < 3; k++) to.half[k] = sum[k] / static_cast<double>(count);
    return set_axes<S>(t, to);
}

/// The geometry at its transform, of which no more is read than the body needs; false if it is none of these types, has
/// a size that is not above 0, or is at a transform that is not rigid to a few roundings.
template <class S>
OVOID_FCL_INLINE bool make_swept(const typed<S> &g, const ::fcl::Transform3<S> &t, ovoid_swept_sphere &to) {
    switch (g.type) {
    case ::fcl::GEOM_SPHERE:
        to.radius = static_cast<double>(static_cast<const ::fcl::Sphere<S> *>(g.of)->radius);
        to.core = OVOID_SWEPT_POINT;
        break;
    case ::fcl::GEOM_CAPSULE: {
        const auto *s = static_cast<const ::fcl::Capsule<S> *>(g.of);
        to.radius = static_cast<double>(s->radius);
        to.core = OVOID_SWEPT_SEGMENT;
        to.half[0] = static_cast<double>(s->lz) / 2;
        if (!(s->lz > 0 && set_axis<S>(t, to))) return false;
        break;
    }
    case ::fcl::GEOM_BOX:
        if (!make_box<S>(static_cast<const ::fcl::Box<S> *>(g.of)->side, 0.5, OVOID_SWEPT_BOX, t, to)) return false;
        break;
    case ::fcl::GEOM_ELLIPSOID:
        if (!make_box<S>(static_cast<const ::fcl::Ellipsoid<S> *>(g.of)->radii, 1, OVOID_SWEPT_ELLIPSOID, t, to))
            return false;
        break;
    case ::fcl::GEOM_CYLINDER:
        if (!make_round<S>(*static_cast<const ::fcl::Cylinder<S> *>(g.of), OVOID_SWEPT_CYLINDER, t, to)) return false;
        break;
    case ::fcl::GEOM_CONE:
        if (!make_round<S>(*static_cast<const ::fcl::Cone<S> *>(g.of), OVOID_SWEPT_CONE, t, to)) return false;
        break;
    default: return false;
    }
    to.center = to_vec3<S>(t.translation());
    return true;
}
/// Balls around the centre of a geometry: one in it, and one around it.
struct center_balls {
    double inner, outer;
};
/// Those of a sphere, a capsule, a box or a cylinder; false of others, and of a size that make_swept refuses.
template <class S> OVOID_FCL_INLINE bool find_center_balls(const typed<S> &g, center_balls &to) {
    if (g.type == ::fcl::GEOM_SPHERE) {
        to.inner = to.outer = static_cast<double>(static_cast<const ::fcl::Sphere<S> *>(g.of)->radius);
        return to.inner >= 0;
    }
    if (g.type == ::fcl::GEOM_BOX) {
        const auto &side = static_cast<const ::fcl::Box<S> *>(g.of)->side;
        const double x = static_cast<double>(side[0]) / 2, y = static_cast<double>(side[1]) / 2,
                     z = static_cast<double>(side[2]) / 2;
        to = {std::min(x, std::min(y, z)), std::sqrt(x * x + y * y + z * z)};
        return to.inner > 0;
    }
    if (g.type == ::fcl::GEOM_CYLINDER) {
        const auto *s = static_cast<const ::fcl::Cylinder<S> *>(g.of);
        const double r = static_cast<double>(s->radius), half = static_cast<double>(s->lz) / 2;
        to = {std::min(r, half), std::sqrt(r * r + half * half)};
        return to.inner > 0;
    }
    if (g.type != ::fcl::GEOM_CAPSULE) return false;
    const auto *s = static_cast<const ::fcl::Capsule<S> *>(g.of);
    to.inner = static_cast<double>(s->radius);
    to.outer = to.inner + static_cast<double>(s->lz) / 2;
    return s->lz > 0 && to.inner >= 0;
}
/// Is a transform one at which make_swept reads a geometry of that type?
template <class S> OVOID_FCL_INLINE bool is_rigid_for(::fcl::NODE_TYPE type, const ::fcl::Transform3<S> &t) {
    if (type == ::fcl::GEOM_SPHERE) return true;
    return type == ::fcl::GEOM_BOX ? is_rotation<S>(t) : off_unit(get_column<S>(t, 2)) <= columns_rounding;
}

/// A convex polytope that is a box, at its transform; false if that is not rigid to a few roundings, or the centre
/// would be rounded by a translation that is large beside the box. What is rounded is less than 50 u of the size.
template <class S> bool make_corner_box(const corner_box &box, const ::fcl::Transform3<S> &t, ovoid_swept_sphere &to) {
    const bool is_central = !(sum_abs(box.center) > 0);
    if (!is_central && !(sum_abs(to_vec3<S>(t.translation())) <= 16 * box.size)) return false;
    to.radius = 0;
    to.core = OVOID_SWEPT_BOX;
    to.center = add_scaled(to_vec3<S>(t.translation()), turn<S>(t, box.center), 1);
    for (int k = 0; k < 3; k++) {
        to.half[k] = box.half[k];
        to.axis[k] = turn<S>(t, box.axis[k]);
    }
    return off_rotation(to.axis) <= columns_rounding && is_rotation<S>(t);
}
/// The same of these types, of a convex polytope and of a triangle.
template <class S> bool make_swept_or_points(const typed<S> &g, const ::fcl::Transform3<S> &t, ovoid_swept_sphere &to) {
    to.center = to_vec3<S>(t.translation());
    if (g.type == ::fcl::GEOM_CONVEX) {
        const auto &corners = static_cast<const ::fcl::Convex<S> *>(g.of)->getVertices();
        return make_points<S>(corners.data(), corners.size(), t, to);
    }
    if (g.type != ::fcl::GEOM_TRIANGLE) return make_swept<S>(g, t, to);
    // Its corners are three members, which are read as an array where they lie as one.
    const auto *s = static_cast<const ::fcl::TriangleP<S> *>(g.of);
    return &s->b == &s->a + 1 && &s->c == &s->a + 2 && make_points<S>(&s->a, 3, t, to);
}

/// Are the contacts of two swept spheres those of faces? Else they have one.
inline bool have_faces(const ovoid_swept_pair &pair, std::size_t room) {
    // The one contact of two boxes is in the middle of the faces that meet.
    return has_faces(*pair.a) && has_faces(*pair.b) &&
           (room > 1 || (pair.a->core == OVOID_SWEPT_BOX && pair.b->core == OVOID_SWEPT_BOX));
}
/// The contacts of faces; false if their shapes have to be asked.
template <class S> bool list_faces(contact_list<S> &to, const ovoid_swept_pair &pair) {
    // The middle of faces is what shapes know.
    return to.room() > 1 ? collide_faces<S>(to, pair) : ovoid_swept_collide(pair).status == OVOID_SEPARATED;
}
/// The one contact of two swept spheres, with or without details, which are the parts i and j; false if their shapes
/// have to be asked. The verdict is read where it was written: to copy it would wait for its parts.
template <class S>
OVOID_FCL_INLINE bool collide_swept(contact_list<S> &to, const ovoid_swept_pair &pair, int i = -1, int j = -1) {
    if (!to.is_detailed()) {
        const ovoid_verdict found = ovoid_swept_collide(pair);
        if (found.status == OVOID_UNDECIDED) return false;
        if (is_hit(found)) to.add(i, j);
        return true;
    }
    ovoid_witness at;
    const ovoid_verdict found = ovoid_swept_contact(pair, &at);
    if (found.status == OVOID_UNDECIDED) return false;
    if (is_hit(found)) to.add(i, j, {at.point_a, at.point_b, contact_distance(found), 0}, at.normal);
    return true;
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
