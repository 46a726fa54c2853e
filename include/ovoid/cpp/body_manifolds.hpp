/**
 * @file body_manifolds.hpp
 * The manifolds of two bodies, part by part.
 */
#ifndef OVOID_CPP_BODY_MANIFOLDS_HPP
#define OVOID_CPP_BODY_MANIFOLDS_HPP

#include "ovoid/body_manifolds.h"
#include "ovoid/cpp/body.hpp"

#include <cstdint>
#include <vector>

namespace ovoid {

/** The manifold of a part of a and a part of b. */
using body_manifold = ovoid_body_manifold;

/**
 * The manifolds of one pair of bodies, for range-for, sorted by part_a, then part_b. Those of the last query are the
 * earlier ones of the next.
 */
class body_manifolds {
  public:
    /** Finds them anew; NONE, or why the query is refused: then there are none. Allocates while their number grows. */
    ovoid_limit find(const body_pair &p, const ovoid_manifold_options &o = ovoid_manifold_options()) {
        ovoid_body_manifolds room = {};
        room.earlier = items_.data();
        room.earlier_count = items_.size();
        next_.resize(items_.size());
        points_.resize(items_.size());
        for (;;) {
            room.items = next_.data();
            room.points = points_.data();
            room.capacity = next_.size();
            const ovoid_limit refused = ovoid_body_manifolds_find(&p, &o, &room);
            next_.resize(room.count);
            points_.resize(room.count);
            if (room.count > room.capacity) continue;
            items_.swap(next_);
            lower_ = room.lower;
            upper_ = room.upper;
            through_ = room.through;
            return refused;
        }
    }
    /** The bracket of the smallest signed distance over all pairs of parts, as ovoid_body_manifolds has it. */
    double lower() const noexcept { return lower_; }
    /** Its upper end. */
    double upper() const noexcept { return upper_; }
    /** Number of facets of a solid that a part has gone through: they have no manifold. */
    std::uint32_t through() const noexcept { return through_; }
    /** The points of a manifold of this list. */
    const ovoid_manifold_points &points_of(const body_manifold &m) const noexcept { return points_[index(m)]; }
    /** The first manifold. */
    const body_manifold *begin() const noexcept { return items_.data(); }
    /** One past the last. */
    const body_manifold *end() const noexcept { return items_.data() + items_.size(); }
    /** Number of manifolds. */
    std::size_t size() const noexcept { return items_.size(); }
    /** True if there is none. */
    bool empty() const noexcept { return items_.empty(); }
    /** Manifold i < size. */
    const body_manifold &operator[](std::size_t i) const noexcept { return items_[i]; }

  private:
    std::size_t index(const body_manifold &m) const noexcept { return static_cast<std::size_t>(&m - items_.data()); }
    std::vector<body_manifold> items_, next_;
    std::vector<ovoid_manifold_points> points_;
    double lower_ = 0, upper_ = 0;
    std::uint32_t through_ = 0;
};

/** The points of one manifold of these bodies at their present poses; none where a part does not exist. */
inline ovoid_manifold_points compute_points(const body_pair &p, const ovoid_body_manifold &m) noexcept {
    return ovoid_body_manifold_compute_points(&p, &m);
}
/** True if the manifold follows from its two parts, without a search. */
inline bool is_proven(const body_pair &p, const ovoid_body_manifold &m,
                      const ovoid_manifold_options &o = ovoid_manifold_options()) noexcept {
    return ovoid_body_manifold_verify(&p, &m, &o, nullptr) == OVOID_OK;
}
/** Throws PROOF, with a sentence, if is_proven is false. */
inline void verify(const body_pair &p, const ovoid_body_manifold &m,
                   const ovoid_manifold_options &o = ovoid_manifold_options()) {
    ovoid_error error;
    detail::require(ovoid_body_manifold_verify(&p, &m, &o, &error), error);
}

} // namespace ovoid

#endif
