/**
 * @file adapter.hpp
 * What the adapters for physics engines share: a table of shapes, in which equal descriptions are one shape.
 *
 * <ovoid/bullet.hpp>, <ovoid/mujoco.hpp> and <ovoid/dart.hpp> include it; a program includes those.
 */
#ifndef OVOID_ADAPTER_HPP
#define OVOID_ADAPTER_HPP

#include "ovoid/manifold.h"
#include "ovoid/ovoid.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace ovoid {
namespace adapters {

/** What a shape is made of: a number for its kind, then its sizes or points, its margin. Equal bits are equal shapes.
 */
using description = std::vector<double>;

/** A description's hash: of its bits, by multiplication (FNV-1a by words). */
struct description_hash {
    std::size_t operator()(const description &of) const noexcept {
        std::uint64_t sum = UINT64_C(14695981039346656037);
        for (const double number : of) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &number, sizeof bits);
            sum = (sum ^ bits) * UINT64_C(1099511628211);
            sum ^= sum >> 32;
        }
        return static_cast<std::size_t>(sum);
    }
};

/** Whether two descriptions have the same bits. */
struct description_equal {
    bool operator()(const description &a, const description &b) const noexcept {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
    }
};

/** A shape, and two lengths of it that every query wants. */
struct sized_shape {
    shape made;
    double radius; /**< of a ball that holds it */
    double reach;  /**< of a ball around the origin of the user's local frame that holds it, allowance included */

    /** Measures a shape. */
    explicit sized_shape(shape &&of) : made(std::move(of)) {
        const ovoid_measures m = made.measures();
        const ovoid_vec3 origin = made.polytope().origin;
        const ovoid_vec3 c = {origin.x + m.sphere_center.x, origin.y + m.sphere_center.y, origin.z + m.sphere_center.z};
        radius = m.sphere_radius + made.radius();
        reach = std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z) + radius + made.allowance().outside;
    }
};

/** A shape that any number of pairs share. */
using shared_shape = std::shared_ptr<const sized_shape>;

/** Shapes by description: each is made once and kept. Safe for any number of threads. */
class shape_table {
  public:
    /** The shape of a description; made by create() if there is none. What create throws passes through. */
    template <class Create> shared_shape find(const description &of, const Create &create) {
        const std::lock_guard<std::mutex> lock(mutex_);
        shared_shape &found = shapes_[of];
        if (!found) {
            try {
                found = std::make_shared<const sized_shape>(create());
            } catch (...) {
                shapes_.erase(of);
                throw;
            }
        }
        return found;
    }
    /** Number of shapes. */
    std::size_t size() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        return shapes_.size();
    }
    /** Destroys the shapes that no pair uses now. */
    void drop_unused() {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (auto i = shapes_.begin(); i != shapes_.end();) i = i->second.use_count() == 1 ? shapes_.erase(i) : ++i;
    }

  private:
    mutable std::mutex mutex_;
    std::unordered_map<description, shared_shape, description_hash, description_equal> shapes_;
};

/** What all adapters let their users choose; lengths as shares of the smaller body's radius. */
struct contact_settings {
    /**
     * How wide the bracket of a kept contact's depth may become before the pair is searched again. A contact is never
     * deeper than the true depth by more than this.
     */
    double tolerance = 5e-4;
    /** A corner of the manifold stays while it is outside of the other body's facet by at most this. */
    double keep = 5e-3;
};

/** Two posed shapes of which a contact is wanted, up to a distance. */
struct contact_query {
    const sized_shape *a, *b;
    ovoid_pose pose_a, pose_b;
    double margin;

    /** The pair for ovoid's functions. */
    ovoid_pair pair() const { return {a->made.get(), b->made.get(), pose_a, pose_b}; }
    /** True if the balls around both origins are farther apart than the margin. */
    bool is_far() const {
        const ovoid_vec3 p = pose_a.position, q = pose_b.position;
        const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z, most = (a->reach + b->reach + margin) * (1 + 1e-12);
        return x * x + y * y + z * z > most * most;
    }
};

/**
 * The points of a contact; none if the shapes are farther apart than the margin. kept: the contact of the last step,
 * all zero in the first, which is replaced. A pair that is as far apart as in the last step, along the same direction,
 * costs two supports; one whose balls are far apart next to nothing.
 */
inline ovoid_manifold_points find_contact(const contact_query &of, const contact_settings &settings,
                                          ovoid_manifold &kept) {
    if (of.is_far()) {
        kept = {};
        return {};
    }
    const ovoid_pair pair = of.pair();
    const double size = std::min(of.a->radius, of.b->radius);
    ovoid_manifold_options options = {};
    options.margin = of.margin;
    options.tolerance = settings.tolerance * size;
    options.keep = settings.keep * size;
    ovoid_manifold_points points = {};
    options.points = &points;
    kept = ovoid_manifold_find(&pair, &options, &kept);
    return points;
}

/** True if the query was refused because of a pose. */
inline bool is_refused(const ovoid_manifold &of) {
    return of.limit == OVOID_LIMIT_POSE_A || of.limit == OVOID_LIMIT_POSE_B;
}

/** The rotation that takes z to another axis (0: x, 1: y, 2: z) by exchanging axes in a circle. */
inline ovoid_pose make_axis_pose(int axis) {
    ovoid_pose made = ovoid_pose_make_identity();
    if (axis == 0) made.rotation = {0.5, 0.5, 0.5, 0.5};    // x to y, y to z, z to x
    if (axis == 1) made.rotation = {0.5, -0.5, -0.5, -0.5}; // x to z, z to y, y to x
    return made;
}

} // namespace adapters
} // namespace ovoid

#endif
