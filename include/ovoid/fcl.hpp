/**
 * @file fcl.hpp
 * The calls of FCL 0.7, the Flexible Collision Library, answered by ovoid over FCL's own types: geometries, objects,
 * requests and results stay, and namespace ovoid::fcl takes the place of namespace fcl at the calls. With
 * OVOID_FCL_REPLACE defined before this header, the calls of namespace fcl go to ovoid without another change of the
 * program, except for those that name their template argument (fcl::collide<double>). Links libovoid and libfcl.
 *
 * Spheres, capsules and boxes are read in each call (<ovoid/fcl/swept.hpp>); other geometries, and pairs of these that
 * closed forms leave open, are translated once and kept (<ovoid/fcl/cache.hpp>). Calls are safe from several threads.
 *
 * FCL answers what ovoid does not: octrees, clouds of points, cost sources, num_max_contacts = 0, a plane or halfspace
 * against another one, geometries that ovoid refuses (a side below 0, NaN), transforms that are no rigid motions,
 * spline motions, and continuous collision with a plane. docs/coming-from-fcl.md has the differences in the answers.
 */
#ifndef OVOID_FCL_HPP
#define OVOID_FCL_HPP

#if __cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L)
#error "<ovoid/fcl.hpp> needs C++17: put -std=c++17 after the flags of FCL's pkg-config file, which has -std=c++11"
#endif

#include "ovoid/body_impact.h"
#include "ovoid/fcl/cache.hpp"
#include "ovoid/fcl/contacts.hpp"
#include "ovoid/fcl/manager.hpp"
#include "ovoid/fcl/meshes.hpp"
#include "ovoid/fcl/motions.hpp"
#include "ovoid/fcl/planes.hpp"
#include "ovoid/fcl/swept.hpp"

#include <fcl/fcl.h>

#include <cstddef>
#include <memory>

/** @cond */
#ifndef OVOID_FCL_ITSELF
#define OVOID_FCL_ITSELF ::ovoid::fcl::detail::fcl_itself
#endif
/** @endcond */

namespace ovoid {
/** FCL's functions, answered by ovoid. */
namespace fcl {

namespace detail {

/// FCL's own answers. A library that stands in the place of FCL's names another class, which finds them elsewhere.
struct fcl_itself {
    template <class S, class... T> static std::size_t collide(T &&...arguments) {
        return ::fcl::collide<S>(std::forward<T>(arguments)...);
    }
    template <class S, class... T> static S distance(T &&...arguments) {
        return ::fcl::distance<S>(std::forward<T>(arguments)...);
    }
    template <class S, class... T> static S continuous_collide(T &&...arguments) {
        return ::fcl::continuousCollide<S>(std::forward<T>(arguments)...);
    }
};

/// A geometry, its pose, and what owns it, where that is known, or NULL.
template <class S> struct posed {
    const geometry<S> *of;
    const ::fcl::Transform3<S> &pose;
    const std::shared_ptr<const geometry<S>> *owner;
    ::fcl::NODE_TYPE type = of->getNodeType();

    bool is_flat() const { return type == ::fcl::GEOM_HALFSPACE || type == ::fcl::GEOM_PLANE; }
    typed<S> self() const { return {of, type}; }
    const body *find(table &in) const { return in.find<S>(self(), owner); }
    bool place(const ovoid_shape *shape, ovoid_prepared_shape &to) const {
        return type == ::fcl::GEOM_SPHERE ? place_sphere<S>(shape, pose, to) : detail::place<S>(shape, pose, to);
    }
};
/// Two geometries that are swept spheres, at their poses; false if one is none. Both types are asked before one is
/// read.
template <class S>
OVOID_FCL_INLINE bool make_swept_pair(const posed<S> &a, const posed<S> &b, ovoid_swept_sphere (&to)[2]) {
    return has_extent(a.type) && has_extent(b.type) && make_swept<S>(a.self(), a.pose, to[0]) &&
           make_swept<S>(b.self(), b.pose, to[1]);
}
/// A convex polytope or a triangle beside a cylinder, a cone or an ellipsoid; of other pairs with one of them the
/// shapes answer faster.
template <class S> bool make_points_pair(const posed<S> &a, const posed<S> &b, ovoid_swept_sphere (&to)[2]) {
    const auto is_round = [](const posed<S> &x) {
        return x.type == ::fcl::GEOM_CYLINDER || x.type == ::fcl::GEOM_CONE || x.type == ::fcl::GEOM_ELLIPSOID;
    };
    const auto has_points = [](const posed<S> &x) {
        return x.type == ::fcl::GEOM_CONVEX || x.type == ::fcl::GEOM_TRIANGLE;
    };
    const bool is_one = (has_points(a) && is_round(b)) || (has_points(b) && is_round(a));
    return is_one && make_swept_or_points<S>(a.self(), a.pose, to[0]) &&
           make_swept_or_points<S>(b.self(), b.pose, to[1]);
}
/// The swept spheres of make_points_pair, with the shapes of convex polytopes.
template <class S>
bool make_hull_pair(const posed<S> &a, const posed<S> &b, const body_couple &couple, ovoid_swept_sphere (&to)[2]) {
    if (!make_points_pair(a, b, to)) return false;
    if (to[0].core == OVOID_SWEPT_POINTS) to[0].shape = couple.a->shape();
    if (to[1].core == OVOID_SWEPT_POINTS) to[1].shape = couple.b->shape();
    return true;
}
/// Two geometries of which one is a convex polytope with the corners of a box, and the other that or a swept sphere.
template <class S>
bool make_box_pair(const posed<S> &a, const posed<S> &b, const body_couple &couple, ovoid_swept_sphere (&to)[2]) {
    const auto make = [](const posed<S> &x, const body *of, ovoid_swept_sphere &part) {
        return of->box().is_one ? make_corner_box<S>(of->box(), x.pose, part) : make_swept<S>(x.self(), x.pose, part);
    };
    return (couple.a->box().is_one || couple.b->box().is_one) && make(a, couple.a, to[0]) && make(b, couple.b, to[1]);
}
template <class S> posed<S> pose_of(const ::fcl::CollisionObject<S> *o) {
    return {o->collisionGeometry().get(), o->getTransform(), &o->collisionGeometry()};
}

/// Finds the bodies of a couple; false if FCL has to answer. What is in it stays until this thread's next call.
template <class S> bool find_couple(const posed<S> &a, const posed<S> &b, body_couple &couple) {
    table &mine = table::get();
    mine.begin();
    couple.a = a.find(mine);
    couple.b = b.find(mine);
    return couple.a && couple.b && !couple.a->is_empty() && !couple.b->is_empty();
}
/// Prepares them at their poses; false if FCL has to answer.
template <class S> bool place_couple(const posed<S> &a, const posed<S> &b, body_couple &couple) {
    return a.place(couple.a->shape(), couple.at_a) && b.place(couple.b->shape(), couple.at_b);
}

/// A point's distance from a shape; the radii around it within which another shape ends, and which that holds; and the
/// lengths that were summed.
struct nearness {
    double distance, outer, inner, lengths;
};
/// 1: two shapes are apart; -1: they meet; 0: neither is known, or a transform is not rigid to a few roundings. All
/// roundings are less than a part in 1e13 of the lengths.
template <class S> int decide(const posed<S> &a, const posed<S> &b, const nearness &of) {
    const double doubt = 1e-12 * (of.distance + of.outer + of.lengths);
    if (!(of.distance < 1e50)) return 0;
    const int side = of.distance - of.outer > doubt ? 1 : of.distance - of.inner < -doubt ? -1 : 0;
    return side != 0 && is_rotation<S>(a.pose) && is_rotation<S>(b.pose) ? side : 0;
}
/// The centre of b's balls from the origin of a, in the world.
template <class S>
ovoid_vec3 find_ball(const posed<S> &a, const posed<S> &b, const shape_balls &balls, double &lengths) {
    const ovoid_vec3 q = turn<S>(b.pose, balls.center), s = to_vec3<S>(a.pose.translation()),
                     t = to_vec3<S>(b.pose.translation());
    lengths = sum_abs(q);
    return {t.x - s.x + q.x, t.y - s.y + q.y, t.z - s.z + q.z};
}
/// By the balls of both.
template <class S> int compare_balls(const posed<S> &a, const posed<S> &b, const body_couple &couple) {
    const shape_balls &of_a = couple.a->balls(), &of_b = couple.b->balls();
    nearness of;
    const ovoid_vec3 p = turn<S>(a.pose, of_a.center), d = add_scaled(find_ball(a, b, of_b, of.lengths), p, -1);
    of.lengths += sum_abs(p);
    of.distance = std::sqrt(dot(d, d));
    of.outer = of_a.outer + of_b.outer, of.inner = of_a.inner + of_b.inner;
    return decide(a, b, of);
}
/// By a box, or a convex polytope that is one, and the balls of another shape.
template <class S>
int compare_box_and_ball(const posed<S> &a, const posed<S> &b, const corner_box &box, const shape_balls &balls) {
    nearness of;
    const ovoid_vec3 d = find_ball(a, b, balls, of.lengths);
    const bool is_box = a.type == ::fcl::GEOM_BOX;
    double p[3], half[3], square = 0;
    for (int k = 0; k < 3; k++) p[k] = dot(get_column<S>(a.pose, k), d);
    if (is_box) {
        const ovoid_vec3 side = to_vec3<S>(static_cast<const ::fcl::Box<S> *>(a.of)->side);
        half[0] = side.x / 2, half[1] = side.y / 2, half[2] = side.z / 2;
    } else {
        const ovoid_vec3 from = add_scaled({p[0], p[1], p[2]}, box.center, -1);
        for (int k = 0; k < 3; k++) p[k] = dot(box.axis[k], from), half[k] = box.half[k];
        of.lengths += sum_abs(box.center);
    }
    for (int k = 0; k < 3; k++) {
        const double beyond = std::max(0.0, std::fabs(p[k]) - half[k]);
        square += beyond * beyond;
        of.lengths += std::fabs(p[k]) + half[k];
    }
    of.distance = std::sqrt(square);
    of.outer = balls.outer, of.inner = balls.inner;
    return decide(a, b, of);
}
/// By what is known of both without a search.
template <class S> int compare_nearness(const posed<S> &a, const posed<S> &b, const body_couple &couple) {
    const auto is_box = [](const posed<S> &x, const body *of) { return x.type == ::fcl::GEOM_BOX || of->box().is_one; };
    if (is_box(a, couple.a)) return compare_box_and_ball(a, b, couple.a->box(), couple.b->balls());
    if (is_box(b, couple.b)) return compare_box_and_ball(b, a, couple.b->box(), couple.a->balls());
    return compare_balls(a, b, couple);
}

/// As decide(), of a sphere and another geometry, if that is a sphere, a capsule, a box or a cylinder, without their
/// shapes. All roundings are less than a part in 1e13 of the squares, whatever way the caller's settings round.
template <class S> OVOID_FCL_INLINE int compare_sphere(const posed<S> &sphere, const posed<S> &other) {
    center_balls of_sphere, of_other;
    if (!find_center_balls<S>(other.self(), of_other) || !find_center_balls<S>(sphere.self(), of_sphere)) return 0;
    const auto between = [&](int i) {
        return static_cast<double>(other.pose.matrix().coeff(i, 3)) -
               static_cast<double>(sphere.pose.matrix().coeff(i, 3));
    };
    const double x = between(0), y = between(1), z = between(2), square = x * x + y * y + z * z,
                 outer = of_other.outer + of_sphere.outer, inner = of_other.inner + of_sphere.inner,
                 sum = square + outer * outer, doubt = 1e-12 * sum;
    if (!(sum > 1e-100 && sum < 1e100)) return 0;
    const int side = square - outer * outer > doubt ? 1 : square - inner * inner < -doubt ? -1 : 0;
    return side != 0 && is_rigid_for<S>(other.type, other.pose) ? side : 0;
}

/// A plane and the other geometry of a call.
template <class S> struct plane_pair {
    const posed<S> &flat, &other;
    plane at;
    bool is_a; ///< the plane is the first
    plane_answer ask() const { return ask_plane<S>(other.self(), other.pose, at); }
};

/// The pair, and whether FCL does not have to answer it.
template <class S>
OVOID_FCL_INLINE std::pair<plane_pair<S>, bool> make_plane_pair(const posed<S> &a, const posed<S> &b) {
    const bool is_a = a.is_flat();
    const posed<S> &flat = is_a ? a : b, &other = is_a ? b : a;
    const plane at = make_plane<S>(flat.self(), flat.pose);
    return {plane_pair<S>{flat, other, at, is_a},
            !other.is_flat() && is_placed<S>(at, flat.pose) && is_placed<S>(other.self(), other.pose)};
}

/// The answer from a to b, or false if FCL has to answer.
template <class S> bool make_plane_answer(const posed<S> &a, const posed<S> &b, plane_answer &answer) {
    const auto asked = make_plane_pair(a, b);
    if (!asked.second) return false;
    answer = asked.first.ask();
    return std::isfinite(answer.distance);
}

/// Adds the contacts of a plane (is_a: it is the first) and another geometry.
template <class S> class plane_contacts {
  public:
    plane_contacts(contact_list<S> &to, bool is_a) : to_(to), is_a_(is_a) {}
    bool add(const plane_answer &at) {
        const int i = is_a_ ? -1 : at.i, j = is_a_ ? at.i : -1;
        if (to_.is_detailed())
            to_.add(i, j, at.position, is_a_ ? negate(at.normal) : at.normal, -at.distance);
        else
            to_.add(i, j);
        return to_.room() > 0;
    }

  private:
    contact_list<S> &to_;
    bool is_a_;
};

/// The contacts with a plane of a geometry without an extent: of a mesh one for each triangle, else the deepest. False
/// if FCL has to answer.
template <class S> OVOID_FCL_APART bool list_plane_contacts(contact_list<S> &to, const plane_pair<S> &pair) {
    const plane_answer answer = pair.ask();
    if (!std::isfinite(answer.distance)) return false;
    if (answer.distance > 0) return true;
    plane_contacts<S> contacts(to, pair.is_a);
    if (pair.other.of->getObjectType() != ::fcl::OT_BVH || to.room() == 1)
        contacts.add(answer);
    else
        list_plane(pair.other.of, pair.other.pose, pair.at, [&](const plane_answer &at) { return contacts.add(at); });
    return true;
}

/// The contacts that FCL finds itself; their number, as of all of these functions.
template <class S>
OVOID_FCL_APART std::size_t collide_itself(const posed<S> &a, const posed<S> &b, const contact_list<S> &to) {
    return OVOID_FCL_ITSELF::template collide<S>(a.of, a.pose, b.of, b.pose, to.request(), to.result());
}

/// The contacts with a plane. Where the extent of the other geometry is known, a yes or no needs no more than that.
template <class S> OVOID_FCL_APART std::size_t collide_plane(const posed<S> &a, const posed<S> &b, contact_list<S> to) {
    const auto asked = make_plane_pair(a, b);
    const plane_pair<S> &pair = asked.first;
    if (!asked.second) return collide_itself<S>(a, b, to);
    if (!has_extent(pair.other.type))
        return list_plane_contacts<S>(to, pair) ? to.count() : collide_itself<S>(a, b, to);
    const extent reach = find_extent(pair.other.self(), pair.other.pose, pair.at);
    const int side = find_side(reach, pair.at);
    if (side > 0) return to.count();
    if (side < 0 && !to.is_detailed()) {
        to.add(-1, -1);
        return to.count();
    }
    const plane_answer answer = answer_plane(pair.other.self(), pair.other.pose, pair.at, reach);
    if (!std::isfinite(answer.distance)) return collide_itself<S>(a, b, to);
    if (answer.distance <= 0) plane_contacts<S>(to, pair.is_a).add(answer);
    return to.count();
}

/// The contacts of two swept spheres; false if their shapes have to be asked.
template <class S> bool collide_numbers(contact_list<S> &to, const ovoid_swept_pair &pair) {
    return to.is_detailed() && have_faces(pair, to.room()) ? list_faces<S>(to, pair) : collide_swept<S>(to, pair);
}

/// The contacts of bodies, or false if FCL has to answer.
template <class S> bool collide_bodies(contact_list<S> &to, const posed<S> &a, const posed<S> &b) {
    body_couple couple;
    ovoid_swept_sphere swept[2];
    if (!find_couple(a, b, couple)) return false;
    const int side = compare_nearness(a, b, couple);
    if (side > 0) return true;
    if (side < 0 && !to.is_detailed()) {
        to.add(-1, -1);
        return true;
    }
    if ((make_box_pair(a, b, couple, swept) || make_hull_pair(a, b, couple, swept)) &&
        collide_numbers<S>(to, {&swept[0], &swept[1]}))
        return true;
    if (!place_couple(a, b, couple)) return false;
    if (couple.has_mesh()) {
        swept_parts<S> parts_a(*couple.a, a.self(), a.pose), parts_b(*couple.b, b.self(), b.pose);
        collide_meshes(to, couple, parts_a, parts_b);
    } else {
        collide_shapes(to, couple, side < 0);
    }
    return true;
}

/// The contacts of other geometries than swept spheres, and of those that need their shapes.
template <class S>
OVOID_FCL_APART std::size_t collide_others(const posed<S> &a, const posed<S> &b, contact_list<S> to) {
    return collide_bodies(to, a, b) ? to.count() : collide_itself<S>(a, b, to);
}

/// The contacts of the faces of swept spheres.
template <class S>
OVOID_FCL_APART std::size_t collide_faced(const posed<S> &a, const posed<S> &b, const ovoid_swept_pair &pair,
                                          contact_list<S> to) {
    return list_faces<S>(to, pair) ? to.count() : collide_others<S>(a, b, to);
}

/// FCL's contacts are those of geometries that are occupied, which cells of an octree need not be. FCL's own functions
/// are calls of libfcl.
template <class S> OVOID_FCL_INLINE bool are_occupied(const geometry<S> *a, const geometry<S> *b) {
    return a->cost_density >= a->threshold_occupied && b->cost_density >= b->threshold_occupied;
}

/// The poses are passed on by copies, so that a call that is answered here keeps its own in registers.
template <class S>
OVOID_FCL_INLINE std::size_t collide(const posed<S> &a, const posed<S> &b, const ::fcl::CollisionRequest<S> &request,
                                     ::fcl::CollisionResult<S> &result) {
    contact_list<S> to(a.self(), b.self(), request, result);
    // request.isSatisfied(result), which is a call of libfcl.
    if (!request.enable_cost && to.count() > 0 && to.room() == 0) return to.count();
    if (request.enable_cost || request.num_max_contacts == 0 || !are_occupied<S>(a.self().of, b.self().of))
        return collide_itself<S>(posed<S>(a), posed<S>(b), contact_list<S>(to));
    if (a.is_flat() || b.is_flat()) return collide_plane<S>(posed<S>(a), posed<S>(b), to);
    // Half of the boxes are left open, which cost more with it where they have details.
    const bool is_sphere_a = a.type == ::fcl::GEOM_SPHERE, is_sphere_b = b.type == ::fcl::GEOM_SPHERE,
               is_box = a.type == ::fcl::GEOM_BOX || b.type == ::fcl::GEOM_BOX;
    if ((is_sphere_a || is_sphere_b) && !(is_box && request.enable_contact)) {
        const int side = is_sphere_a ? compare_sphere<S>(a, b) : compare_sphere<S>(b, a);
        if (side > 0) return to.count();
        if (side < 0 && !request.enable_contact) {
            to.add(-1, -1);
            return to.count();
        }
    }
    ovoid_swept_sphere swept[2];
    if (!make_swept_pair(a, b, swept)) return collide_others<S>(posed<S>(a), posed<S>(b), to);
    const ovoid_swept_pair pair = {&swept[0], &swept[1]};
    if (request.enable_contact && have_faces(pair, to.room()))
        return collide_faced<S>(posed<S>(a), posed<S>(b), pair, to);
    return collide_swept<S>(to, pair) ? to.count() : collide_others<S>(posed<S>(a), posed<S>(b), to);
}

/// A distance in FCL's terms, before it is written to a result.
struct distance_answer {
    double distance;
    ovoid_vec3 point_a, point_b;
    int i, j;
};

/// Of shapes that overlap FCL's distance is -1, unless the signed one is wanted.
OVOID_FCL_INLINE distance_answer make_distance(const ovoid_verdict &x, const ovoid_witness &at, bool is_signed) {
    const bool is_apart = x.status == OVOID_SEPARATED || (x.status == OVOID_UNDECIDED && !is_hit(x));
    double apart = x.status == OVOID_TOUCHING ? 0 : -1;
    if (is_apart || is_signed) apart = x.status == OVOID_OVERLAPPING ? contact_distance(x) : middle(x);
    return {apart, at.point_a, at.point_b, -1, -1};
}
inline distance_answer measure_shapes(const body_couple &of, bool is_signed) {
    ovoid_witness at;
    const ovoid_evidence evidence = {nullptr, &at, nullptr};
    const ovoid_verdict x = is_signed ? ovoid_prepared_depth(of.prepared(), nullptr, &evidence)
                                      : ovoid_prepared_distance(of.prepared(), nullptr, &evidence);
    return make_distance(x, at, is_signed);
}
/// Of swept spheres; false if their shapes have to be asked.
OVOID_FCL_INLINE bool measure_swept(const ovoid_swept_pair &pair, bool is_signed, distance_answer &found) {
    ovoid_witness at;
    const ovoid_verdict x = is_signed ? ovoid_swept_depth(pair, &at) : ovoid_swept_distance(pair, &at);
    if (x.status == OVOID_UNDECIDED) return false;
    found = make_distance(x, at, is_signed);
    return true;
}

/// Of meshes that cross the signed distance is minus the length of a translation that is proven to part them; the
/// unsigned one is FCL's: 0 of two meshes, -1 of a mesh and a shape.
inline distance_answer measure_meshes(const body_couple &of, bool is_signed) {
    const ovoid_body_pair pair = of.bodies();
    const ovoid_body_answer x = ovoid_body_distance(&pair, nullptr, nullptr);
    const double crossing = is_signed ? std::min(0.0, x.lower) : of.a->solid() && of.b->solid() ? 0 : -1;
    return {is_hit(x.deciding) ? crossing : middle(x.deciding), x.deciding.point_a, x.deciding.point_b,
            of.a->solid() ? static_cast<int>(x.part_a) : -1, of.b->solid() ? static_cast<int>(x.part_b) : -1};
}

/// Of a plane. The unsigned distance of an overlap is -1.
inline distance_answer measure_plane(const plane_answer &x, bool is_a, bool is_signed) {
    const double distance = is_signed || x.distance >= 0 ? x.distance : -1;
    return {distance, is_a ? x.on_plane : x.point, is_a ? x.point : x.on_plane, is_a ? -1 : x.i, is_a ? x.i : -1};
}

/// The distance of other geometries than swept spheres, and of those that need their shapes; false if FCL has to
/// answer.
template <class S> bool measure_others(const posed<S> &a, const posed<S> &b, bool is_signed, distance_answer &found) {
    plane_answer plane;
    body_couple couple;
    ovoid_swept_sphere swept[2];
    if (a.is_flat() || b.is_flat()) {
        if (!make_plane_answer(a, b, plane)) return false;
        found = measure_plane(plane, a.is_flat(), is_signed);
        return true;
    }
    if (make_points_pair(a, b, swept) && measure_swept({&swept[0], &swept[1]}, is_signed, found)) return true;
    if (!find_couple(a, b, couple) || !place_couple(a, b, couple)) return false;
    found = couple.has_mesh() ? measure_meshes(couple, is_signed) : measure_shapes(couple, is_signed);
    return true;
}

/// result.update, which is a call of libfcl. Points are written whether or not they were asked for, as FCL does.
template <class S>
OVOID_FCL_INLINE void write_distance(const distance_answer &found, const geometry<S> *a, const geometry<S> *b,
                                     ::fcl::DistanceResult<S> &to) {
    const S distance = static_cast<S>(found.distance);
    if (!(to.min_distance > distance)) return;
    to.min_distance = distance;
    to.o1 = a, to.o2 = b;
    to.b1 = found.i, to.b2 = found.j;
    to.nearest_points[0] = from_vec3<S>(found.point_a);
    to.nearest_points[1] = from_vec3<S>(found.point_b);
}

/// The distance of other geometries than swept spheres, and of those that need their shapes.
template <class S>
OVOID_FCL_APART S distance_others(const posed<S> &a, const posed<S> &b, const ::fcl::DistanceRequest<S> &request,
                                  ::fcl::DistanceResult<S> &result) {
    distance_answer found;
    if (!measure_others(a, b, request.enable_signed_distance, found))
        return OVOID_FCL_ITSELF::template distance<S>(a.of, a.pose, b.of, b.pose, request, result);
    write_distance(found, a.of, b.of, result);
    return result.min_distance;
}

template <class S>
OVOID_FCL_INLINE S distance(const posed<S> &a, const posed<S> &b, const ::fcl::DistanceRequest<S> &request,
                            ::fcl::DistanceResult<S> &result) {
    // request.isSatisfied(result), which is a call of libfcl.
    if (result.min_distance <= 0) return result.min_distance;
    distance_answer found;
    ovoid_swept_sphere swept[2];
    if (!make_swept_pair(a, b, swept) || !measure_swept({&swept[0], &swept[1]}, request.enable_signed_distance, found))
        return distance_others<S>(posed<S>(a), posed<S>(b), request, result);
    write_distance(found, a.of, b.of, result);
    return result.min_distance;
}

/// A moving geometry, and how it moves.
template <class S> struct moved {
    const geometry<S> *of;
    ovoid_motion motion;
};

/// The first time of contact, up to request.toc_err; false if FCL has to answer. The time is one of contact, or where
/// that is not proven the first that is not proven free.
template <class S>
bool continuous_collide(const moved<S> &a, const moved<S> &b, const ::fcl::ContinuousCollisionRequest<S> &request,
                        ::fcl::ContinuousCollisionResult<S> &result) {
    // FCL's naive solver finds contacts, the others measure distances.
    if (request.ccd_solver_type == ::fcl::CCDC_NAIVE && !are_occupied<S>(a.of, b.of)) return false;
    table &mine = table::get();
    mine.begin();
    const body *x = mine.find<S>({a.of, a.of->getNodeType()}, nullptr),
               *y = mine.find<S>({b.of, b.of->getNodeType()}, nullptr);
    if (!x || !y || x->is_empty() || y->is_empty()) return false;
    const ovoid_moving_body_pair pair = {
        {x->shape(), nullptr, a.motion, x->solid()}, {y->shape(), nullptr, b.motion, y->solid()}, 0};
    ovoid_motion_options options{};
    options.end = 1;
    options.tolerance = std::min(1e-6, std::max(1e-12, static_cast<double>(request.toc_err)));
    const ovoid_impact impact = ovoid_body_impact_find(&pair, &options).impact;
    if (impact.limit >= OVOID_LIMIT_POSE_A && impact.limit <= OVOID_LIMIT_SHAPE_B) return false;
    result.is_collide = impact.status != OVOID_IMPACT_FREE;
    const double time = !result.is_collide ? 1 : impact.status == OVOID_IMPACT_HIT ? impact.hit_at : impact.free_until;
    result.time_of_contact = static_cast<S>(time);
    result.contact_tf1 = from_pose<S>(ovoid_motion_compute_pose(&a.motion, time));
    result.contact_tf2 = from_pose<S>(ovoid_motion_compute_pose(&b.motion, time));
    return true;
}

} // namespace detail

/** Forgets the translation of a geometry whose arrays were written to without FCL's own functions. */
template <class S> void forget(const ::fcl::CollisionGeometry<S> *geometry) { detail::store::get().forget(geometry); }
/** Drops the translations of geometries that are not known to be alive; the next calls make those that are wanted. */
inline void trim() { detail::store::get().trim(true); }
/** The number of translations that are kept. */
inline std::size_t count_kept() { return detail::store::get().count(); }

/**
 * fcl::collide. Contacts: of two shapes one, or with num_max_contacts above 1 the points of their manifold, deepest
 * first; of a mesh the triangles that decide, or each pair that touches. Normals go from o1 to o2.
 */
template <class S>
std::size_t collide(const ::fcl::CollisionGeometry<S> *o1, const ::fcl::Transform3<S> &tf1,
                    const ::fcl::CollisionGeometry<S> *o2, const ::fcl::Transform3<S> &tf2,
                    const ::fcl::CollisionRequest<S> &request, ::fcl::CollisionResult<S> &result) {
    return detail::collide<S>({o1, tf1, nullptr}, {o2, tf2, nullptr}, request, result);
}
/** fcl::collide of objects. */
template <class S>
std::size_t collide(const ::fcl::CollisionObject<S> *o1, const ::fcl::CollisionObject<S> *o2,
                    const ::fcl::CollisionRequest<S> &request, ::fcl::CollisionResult<S> &result) {
    return detail::collide<S>(detail::pose_of(o1), detail::pose_of(o2), request, result);
}

/** fcl::distance. The nearest points are in the world, on o1 and on o2, and always written. */
template <class S>
S distance(const ::fcl::CollisionGeometry<S> *o1, const ::fcl::Transform3<S> &tf1,
           const ::fcl::CollisionGeometry<S> *o2, const ::fcl::Transform3<S> &tf2,
           const ::fcl::DistanceRequest<S> &request, ::fcl::DistanceResult<S> &result) {
    return detail::distance<S>({o1, tf1, nullptr}, {o2, tf2, nullptr}, request, result);
}
/** fcl::distance of objects. */
template <class S>
S distance(const ::fcl::CollisionObject<S> *o1, const ::fcl::CollisionObject<S> *o2,
           const ::fcl::DistanceRequest<S> &request, ::fcl::DistanceResult<S> &result) {
    return detail::distance<S>(detail::pose_of(o1), detail::pose_of(o2), request, result);
}

/**
 * fcl::continuousCollide, from time 0 to 1. Doubles alone: FCL's motions of floats do not compile. The whole motion is
 * proven free, or the time found is the first one of contact; of the request, the kind of motion and toc_err count.
 */
template <class S>
S continuousCollide(const ::fcl::CollisionGeometry<S> *o1, const ::fcl::MotionBase<S> *motion1,
                    const ::fcl::CollisionGeometry<S> *o2, const ::fcl::MotionBase<S> *motion2,
                    const ::fcl::ContinuousCollisionRequest<S> &request, ::fcl::ContinuousCollisionResult<S> &result) {
    detail::moved<S> a{o1, {}}, b{o2, {}};
    if (detail::make_motion(motion1, a.motion) && detail::make_motion(motion2, b.motion) &&
        detail::continuous_collide(a, b, request, result))
        return result.time_of_contact;
    return OVOID_FCL_ITSELF::template continuous_collide<S>(o1, motion1, o2, motion2, request, result);
}
/** fcl::continuousCollide between transforms, by motions of request.ccd_motion_type. */
template <class S>
S continuousCollide(const ::fcl::CollisionGeometry<S> *o1, const ::fcl::Transform3<S> &tf1_beg,
                    const ::fcl::Transform3<S> &tf1_end, const ::fcl::CollisionGeometry<S> *o2,
                    const ::fcl::Transform3<S> &tf2_beg, const ::fcl::Transform3<S> &tf2_end,
                    const ::fcl::ContinuousCollisionRequest<S> &request, ::fcl::ContinuousCollisionResult<S> &result) {
    detail::moved<S> a{o1, {}}, b{o2, {}};
    if (detail::make_motion<S>(request.ccd_motion_type, tf1_beg, tf1_end, a.motion) &&
        detail::make_motion<S>(request.ccd_motion_type, tf2_beg, tf2_end, b.motion) &&
        detail::continuous_collide(a, b, request, result))
        return result.time_of_contact;
    return OVOID_FCL_ITSELF::template continuous_collide<S>(o1, tf1_beg, tf1_end, o2, tf2_beg, tf2_end, request,
                                                            result);
}
/** fcl::continuousCollide of objects, from where they are. */
template <class S>
S continuousCollide(const ::fcl::CollisionObject<S> *o1, const ::fcl::Transform3<S> &tf1_end,
                    const ::fcl::CollisionObject<S> *o2, const ::fcl::Transform3<S> &tf2_end,
                    const ::fcl::ContinuousCollisionRequest<S> &request, ::fcl::ContinuousCollisionResult<S> &result) {
    return fcl::continuousCollide<S>(o1->collisionGeometry().get(), o1->getTransform(), tf1_end,
                                     o2->collisionGeometry().get(), o2->getTransform(), tf2_end, request, result);
}
/** fcl::collide of objects that move. */
template <class S>
S collide(const ::fcl::ContinuousCollisionObject<S> *o1, const ::fcl::ContinuousCollisionObject<S> *o2,
          const ::fcl::ContinuousCollisionRequest<S> &request, ::fcl::ContinuousCollisionResult<S> &result) {
    return fcl::continuousCollide<S>(o1->collisionGeometry().get(), o1->getMotion(), o2->collisionGeometry().get(),
                                     o2->getMotion(), request, result);
}

} // namespace fcl
} // namespace ovoid

#ifdef OVOID_FCL_REPLACE
#include "ovoid/fcl/replace.hpp"
#endif

#endif
