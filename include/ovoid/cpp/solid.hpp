/**
 * @file solid.hpp
 * Solids of triangles.
 */
#ifndef OVOID_CPP_SOLID_HPP
#define OVOID_CPP_SOLID_HPP

#include "ovoid/cpp/query.hpp"
#include "ovoid/solid.h"

namespace ovoid {

/** A view of a solid that is owned elsewhere: one pointer, passed by value. */
class solid_view {
  public:
    constexpr solid_view() noexcept = default;
    /** Wraps a C solid, which must outlive the view. */
    constexpr explicit solid_view(const ovoid_solid *from) noexcept : solid_(from) {}
    /** The C solid, borrowed; nullptr if there is none. */
    constexpr const ovoid_solid *get() const noexcept { return solid_; }
    /** False if there is no solid. Then no other function may be called. */
    explicit constexpr operator bool() const noexcept { return solid_ != nullptr; }

    /** Facts about the triangles. */
    ovoid_solid_report report() const noexcept { return ovoid_solid_get_report(solid_); }
    /** The triangles in the order of the tree of boxes. */
    span<const std::uint32_t> order() const noexcept {
        return {ovoid_solid_get_order(solid_), static_cast<std::size_t>(report().triangles)};
    }
    /** The points, xyz of point i at 3 i. */
    span<const double> points() const noexcept {
        return {ovoid_solid_get_points(solid_), 3 * static_cast<std::size_t>(report().points)};
    }
    /** The points of triangle i < report().triangles. */
    void triangle(std::size_t i, std::uint32_t points[3]) const noexcept {
        ovoid_solid_get_triangle(solid_, i, points);
    }
    /** How often the solid winds around a point, exactly. True if *winding is written. */
    bool winding(const ovoid_vec3 &point, std::int64_t *winding) const noexcept {
        return ovoid_solid_compute_winding(solid_, point, winding) != 0;
    }
    /**
     * Counts the pairs of triangles with a common point that is not a corner or edge of both; stops at `most` pairs.
     */
    ovoid_solid_crossings crossings(std::uint64_t most = UINT64_MAX) const noexcept {
        return ovoid_solid_compute_crossings(solid_, most);
    }
    /** Size of the block in bytes. */
    std::size_t size_in_bytes() const noexcept { return ovoid_solid_get_size(solid_); }

  private:
    const ovoid_solid *solid_ = nullptr;
};

/** A solid that owns its memory. */
class solid : public detail::owner<solid_view, ovoid_solid, ovoid_solid_destroy> {
  public:
    using owner::owner;

    /**
     * From point_count points, xyz of point i at 3 i, and count triangles, three indices each. All are copied. Throws
     * ARGUMENT, EMPTY, LIMIT, NOT_FINITE (place: the point), RANGE, INDEX (place: the triangle), MEMORY.
     */
    static solid from_triangles(const double *xyz, std::size_t point_count, const std::uint32_t *indices,
                                std::size_t count, const ovoid_allocator *allocator = nullptr) {
        ovoid_error e;
        const ovoid_triangles triangles = {xyz, point_count, indices, count};
        const ovoid_solid_options o = {allocator};
        return solid(detail::require(ovoid_solid_create_from_triangles(&triangles, &o, &e), e));
    }
};

/** Are the triangles the surface of their hull, exactly or nearly? hull: of the same points. */
inline ovoid_hull_match match_hull(const ovoid_triangles &triangles, const shape_view &hull) {
    ovoid_hull_match found;
    ovoid_error e;
    detail::require(ovoid_triangles_compute_hull_match(&triangles, hull.get(), &found, &e), e);
    return found;
}

/**
 * An upper bound of how much farther a solid is than its hull from any other body; infinity if none is proven. Throws
 * MEMORY.
 */
inline double hull_gap(const solid_view &solid, const shape_view &hull) {
    double gap;
    ovoid_error e;
    detail::require(ovoid_solid_compute_hull_gap(solid.get(), hull.get(), &gap, &e), e);
    return gap;
}

} // namespace ovoid

#endif
