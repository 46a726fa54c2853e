/**
 * @file contacts.hpp
 * The contacts of two shapes in FCL's terms, for <ovoid/fcl.hpp>: the points of their contact manifold.
 */
#ifndef OVOID_FCL_CONTACTS_HPP
#define OVOID_FCL_CONTACTS_HPP

#include "ovoid/fcl/parts.hpp"
#include "ovoid/manifold.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace ovoid {
namespace fcl {
namespace detail {

/// Where FCL has an answer of yes or no, and ovoid a bracket: a sign that is not proven is that of the middle.
template <class Answer> bool is_hit(const Answer &answer) {
    if (answer.status == OVOID_UNDECIDED) return !(answer.lower + answer.upper > 0);
    return answer.status != OVOID_SEPARATED;
}
template <class Answer> double middle(const Answer &answer) { return (answer.lower + answer.upper) / 2; }
/// The point at this part of the way from a to b.
inline ovoid_vec3 between(const ovoid_vec3 &a, const ovoid_vec3 &b, double part) {
    return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), a.z + part * (b.z - a.z)};
}
/// Where a contact is between the two deepest points: in the middle; of two spheres, as in FCL, by their radii.
template <class S> OVOID_FCL_INLINE double get_part(const typed<S> &o1, const typed<S> &o2) {
    if (o1.type != ::fcl::GEOM_SPHERE || o2.type != ::fcl::GEOM_SPHERE) return 0.5;
    const double a = static_cast<const ::fcl::Sphere<S> *>(o1.of)->radius,
                 b = static_cast<const ::fcl::Sphere<S> *>(o2.of)->radius;
    return a + b > 0 ? a / (a + b) : 0.5;
}

/// Adds the contacts that a request wants to a result. FCL's functions for it are calls of libfcl, so their number is
/// kept here.
template <class S> class contact_list {
  public:
    contact_list(const typed<S> &o1, const typed<S> &o2, const ::fcl::CollisionRequest<S> &request,
                 ::fcl::CollisionResult<S> &result)
        : o1_(o1), o2_(o2), request_(&request), result_(&result), count_(result.numContacts()) {}

    const ::fcl::CollisionRequest<S> &request() const { return *request_; }
    ::fcl::CollisionResult<S> &result() const { return *result_; }
    /// How many contacts are in the result.
    std::size_t count() const { return count_; }
    /// How many more contacts are wanted.
    std::size_t room() const { return count_ < request_->num_max_contacts ? request_->num_max_contacts - count_ : 0; }
    bool is_detailed() const { return request_->enable_contact; }

    /// A contact without details, of parts i and j (-1: not of a mesh).
    OVOID_FCL_INLINE void add(int i, int j) {
        result_->addContact(::fcl::Contact<S>(o1_.of, o2_.of, i, j));
        count_++;
    }
    /// A contact with details. FCL's depths are not negative.
    OVOID_FCL_INLINE void add(int i, int j, const ovoid_vec3 &position, const ovoid_vec3 &normal, double depth) {
        result_->addContact(::fcl::Contact<S>(o1_.of, o2_.of, i, j, from_vec3<S>(position), from_vec3<S>(normal),
                                              static_cast<S>(std::max(0.0, depth))));
        count_++;
    }
    OVOID_FCL_INLINE void add(int i, int j, const ovoid_manifold_point &at, const ovoid_vec3 &normal) {
        add(i, j, between(at.point_a, at.point_b, get_part(o1_, o2_)), normal, -at.separation);
    }

  private:
    typed<S> o1_, o2_;
    const ::fcl::CollisionRequest<S> *request_;
    ::fcl::CollisionResult<S> *result_;
    std::size_t count_;
};

/// A bracket, and its points and normal; without the proof, which FCL's callers have no place for.
struct measured {
    ovoid_verdict bracket;
    ovoid_witness at;
};
/// Where round bodies touch, a depth that is off by e has a normal that is off by the root of e: 1e-4 at most here, in
/// radians. Depths and normals of polyhedra are exact but for rounding anyway.
constexpr ovoid_options contact_options = {0, 1e-9, 0, 0};
inline measured ask_depth(const ovoid_prepared_pair &pair) {
    measured found;
    const ovoid_evidence evidence = {nullptr, &found.at, nullptr};
    found.bracket = ovoid_prepared_depth(pair, &contact_options, &evidence);
    return found;
}
inline measured ask_depth(const ovoid_pair &pair) {
    const ovoid_answer x = ovoid_depth(&pair, &contact_options, nullptr, nullptr);
    return {{x.status, x.stage, x.limit, x.iterations, x.lower, x.upper}, {x.point_a, x.point_b, x.normal}};
}

/// The signed distance of a contact. Where an allowance leaves the depth open it is the longest one, since a
/// translation by that along the normal is proven to part the bodies.
inline double contact_distance(const ovoid_verdict &depth) {
    return depth.upper - depth.lower > 1e-8 * -depth.lower ? depth.lower : middle(depth);
}

/// The deepest point of two overlapping shapes as a contact.
template <class S> OVOID_FCL_INLINE void add_deepest(contact_list<S> &to, int i, int j, const measured &depth) {
    to.add(i, j, {depth.at.point_a, depth.at.point_b, contact_distance(depth.bracket), 0}, depth.at.normal);
}

/// Does a polyhedron stand for a round body, whose faces its facets are not; or is it a sphere? Both have one contact.
inline bool is_round(const ovoid_shape *shape) {
    return ovoid_shape_get_allowance(shape).outside > 0 || ovoid_shape_get_polytope(shape).vertex_count == 1;
}

/// The contacts of two polyhedra that touch: the points of their manifold, deepest first. The first one has the depth
/// of the shapes. Where no corner of the manifold is that deep, the deepest point comes before its corners.
template <class S> void add_contacts(contact_list<S> &to, int i, int j, const ovoid_pair &pair) {
    ovoid_manifold_points points;
    ovoid_manifold_options options{};
    options.points = &points;
    const ovoid_manifold manifold = ovoid_manifold_find(&pair, &options, nullptr);
    std::uint32_t count = 0;
    for (; count < points.count && count < 4; count++)
        for (std::uint32_t at = count; at > 0 && points.points[at].separation < points.points[at - 1].separation; at--)
            std::swap(points.points[at], points.points[at - 1]);
    // The points are of the polyhedra, the bracket of the bodies with their allowances, which are in its width.
    const double width = manifold.upper - manifold.lower, depth = (manifold.lower + manifold.upper) / 2;
    double off = count == 0 ? INFINITY : points.points[0].separation - depth;
    if (!(off <= width)) {
        add_deepest(to, i, j, ask_depth(pair));
        off = 0;
    } else if (width > 1e-9 * -depth) {
        // Of edges that are nearly parallel the manifold's bracket may be wider than that of the depth.
        off += depth - contact_distance(ask_depth(pair).bracket);
    }
    for (std::uint32_t n = 0; n < count && to.room() > 0; n++) {
        points.points[n].separation -= off;
        to.add(i, j, points.points[n], manifold.normal);
    }
}

/// A shape whose depth in another one costs what yes or no does: a point or a segment with a radius.
inline bool is_thin(const ovoid_shape *shape) { return ovoid_shape_get_polytope(shape).vertex_count <= 2; }

/// The contacts of two shapes: one, as FCL has of round bodies, or of others with room for more those of the polyhedra.
/// has_met: their inner balls show that they meet, and details are wanted.
template <class S> void collide_shapes(contact_list<S> &to, const body_couple &of, bool has_met) {
    const ovoid_prepared_pair pair = of.prepared();
    if (!to.is_detailed()) {
        if (is_hit(ovoid_prepared_collide(pair, nullptr, nullptr))) to.add(-1, -1);
        return;
    }
    const bool is_single = to.room() == 1 || is_round(of.a->shape()) || is_round(of.b->shape());
    if (is_single && (is_thin(of.a->shape()) || is_thin(of.b->shape()))) {
        const measured depth = ask_depth(pair);
        if (is_hit(depth.bracket)) add_deepest(to, -1, -1, depth);
        return;
    }
    if (!has_met && !is_hit(ovoid_prepared_collide(pair, nullptr, nullptr))) return;
    if (is_single)
        add_deepest(to, -1, -1, ask_depth(pair));
    else
        add_contacts(to, -1, -1, of.shapes());
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
