/**
 * @file meshes.hpp
 * The contacts of meshes in FCL's terms, for <ovoid/fcl.hpp>: one for each triangle that meets the other body. The
 * parts are read as swept spheres (<ovoid/swept.h>) in each call; what these leave open is asked of their shapes.
 */
#ifndef OVOID_FCL_MESHES_HPP
#define OVOID_FCL_MESHES_HPP

#include "ovoid/fcl/contacts.hpp"
#include "ovoid/fcl/parts.hpp"
#include "ovoid/fcl/swept.hpp"

#include <cstddef>
#include <cstdint>

namespace ovoid {
namespace fcl {
namespace detail {

/// The parts of a body at a transform: the triangles of a mesh, or the geometry itself. Of a triangle and a convex
/// polytope the shapes answer faster.
template <class S> class swept_parts {
  public:
    swept_parts(const body &of, const typed<S> &g, const ::fcl::Transform3<S> &t) : of_(of) {
        if (!of.solid()) {
            is_known_ = make_swept<S>(g, t, part_);
            return;
        }
        is_known_ = set_axes<S>(t, part_);
        part_.center = to_vec3<S>(t.translation());
        part_.radius = 0;
        part_.core = OVOID_SWEPT_POINTS;
        part_.points = corners_;
        part_.count = 3;
        part_.shape = nullptr;
    }
    swept_parts(const swept_parts &) = delete;
    swept_parts &operator=(const swept_parts &) = delete;

    /// Part i until the next one is wanted, or NULL if it is no swept sphere.
    const ovoid_swept_sphere *get(std::uint32_t i) {
        if (is_known_ && of_.solid()) {
            ovoid_vec3 at[3];
            of_.get_triangle(i, at);
            for (int k = 0; k < 3; k++) {
                corners_[3 * k] = at[k].x, corners_[3 * k + 1] = at[k].y, corners_[3 * k + 2] = at[k].z;
                part_.half[k] = 0;
            }
            for (int k = 0; k < 9; k++) part_.half[k % 3] += corners_[k] / 3;
        }
        return is_known_ ? &part_ : nullptr;
    }

  private:
    const body &of_;
    bool is_known_;
    ovoid_swept_sphere part_;
    double corners_[9];
};

/// Adds the contacts of parts of two bodies.
template <class S> class part_contacts {
  public:
    part_contacts(contact_list<S> &to, const body_couple &of, swept_parts<S> &a, swept_parts<S> &b)
        : to_(to), of_(of), a_(a), b_(b) {}

    /// Adds the contact of two parts if they touch.
    void add(std::uint32_t part_a, std::uint32_t part_b) {
        if (add_swept(part_a, part_b)) return;
        const ovoid_pair pair = of_.pieces(part_a, part_b);
        if (is_hit(ovoid_collide(&pair, nullptr, nullptr))) add_touching(part_a, part_b);
    }
    /// Adds that of two parts that are known to touch.
    void add_touching(std::uint32_t part_a, std::uint32_t part_b) {
        if (!to_.is_detailed()) return to_.add(name(*of_.a, part_a), name(*of_.b, part_b));
        const measured depth = ask_depth(of_.pieces(part_a, part_b));
        if (is_hit(depth.bracket)) add_deepest(to_, name(*of_.a, part_a), name(*of_.b, part_b), depth);
    }

  private:
    /// What FCL calls a part: the triangle, or -1 where it is no mesh's.
    static int name(const body &of, std::uint32_t part) { return of.solid() ? static_cast<int>(part) : -1; }
    /// False if the parts' shapes have to be asked.
    bool add_swept(std::uint32_t part_a, std::uint32_t part_b) {
        const ovoid_swept_pair pair = {a_.get(part_a), b_.get(part_b)};
        return pair.a && pair.b && collide_swept<S>(to_, pair, name(*of_.a, part_a), name(*of_.b, part_b));
    }

    contact_list<S> &to_;
    const body_couple &of_;
    swept_parts<S> &a_, &b_;
};

/// The contacts of a mesh with a shape or a mesh. One wanted: that of the two parts that decide. More: those of all
/// pairs of parts that touch.
template <class S>
void collide_meshes(contact_list<S> &to, const body_couple &of, swept_parts<S> &a, swept_parts<S> &b) {
    const ovoid_body_pair pair = of.bodies();
    const ovoid_body_answer answer = ovoid_body_collide(&pair, nullptr, nullptr);
    if (!is_hit(answer.deciding)) return;
    const std::size_t before = to.room();
    part_contacts<S> contacts(to, of, a, b);
    if (before > 1)
        search_pairs(of, answer, [&](std::uint32_t i, std::uint32_t j) {
            contacts.add(i, j);
            return to.room() == 0;
        });
    // One is wanted, or rounding lets only the whole query see the contact.
    if (to.room() == before) contacts.add_touching(answer.part_a, answer.part_b);
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
