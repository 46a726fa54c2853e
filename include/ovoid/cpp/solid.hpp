/**
 * @file solid.hpp
 * Solids of triangles.
 */
#ifndef OVOID_CPP_SOLID_HPP
#define OVOID_CPP_SOLID_HPP

#include "ovoid/cpp/query.hpp"
#include "ovoid/solid.h"

namespace ovoid {

/** A solid that someone else owns: one pointer, passed by value. */
class solid_view {
  public:
    constexpr solid_view() noexcept = default;
    /** Of a C solid. */
    constexpr explicit solid_view(const ovoid_solid *from) noexcept : solid_(from) {}
    /** The C solid, borrowed; nullptr where this is empty. */
    constexpr const ovoid_solid *get() const noexcept { return solid_; }
    /** False where there is none. No other function may then be called. */
    explicit constexpr operator bool() const noexcept { return solid_ != nullptr; }

    /** What was found of the triangles. */
    ovoid_solid_report report() const noexcept { return ovoid_solid_get_report(solid_); }
    /** The triangles in the order of the tree. */
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
    /** How often it winds around a point, exactly: true where *winding is written. */
    bool winding(const ovoid_vec3 &point, std::int64_t *winding) const noexcept {
        return ovoid_solid_compute_winding(solid_, point, winding) != 0;
    }
    /** The pairs of triangles that meet other than in common corners and edges, up to `most`. */
    ovoid_solid_crossings crossings(std::uint64_t most = UINT64_MAX) const noexcept {
        return ovoid_solid_compute_crossings(solid_, most);
    }
    /** Size of the block in bytes. */
    std::size_t size_in_bytes() const noexcept { return ovoid_solid_get_size(solid_); }

  private:
    const ovoid_solid *solid_ = nullptr;
};

/** A solid that is owned. */
class solid : public detail::owner<solid_view, ovoid_solid, ovoid_solid_destroy> {
  public:
    using owner::owner;

    /** Of point_count points, xyz of point i at 3 i, and count triangles, three indices each; copied. Throws ARGUMENT,
     * EMPTY, LIMIT, NOT_FINITE (place: the point), RANGE, INDEX (place: the triangle), MEMORY. */
    static solid from_triangles(const double *xyz, std::size_t point_count, const std::uint32_t *indices,
                                std::size_t count, const ovoid_allocator *allocator = nullptr) {
        ovoid_error e;
        const ovoid_triangles triangles = {xyz, point_count, indices, count};
        const ovoid_solid_options o = {allocator};
        return solid(detail::require(ovoid_solid_create_from_triangles(&triangles, &o, &e), e));
    }
};

/** Are the triangles the hull, exactly or nearly? hull: of the same points. */
inline ovoid_hull_match match_hull(const ovoid_triangles &triangles, const shape_view &hull) {
    ovoid_hull_match found;
    ovoid_error e;
    detail::require(ovoid_triangles_compute_hull_match(&triangles, hull.get(), &found, &e), e);
    return found;
}

/** How much farther from any body a solid is than its hull, at most; infinity where that is not shown. Throws MEMORY.
 */
inline double hull_gap(const solid_view &solid, const shape_view &hull) {
    double gap;
    ovoid_error e;
    detail::require(ovoid_solid_compute_hull_gap(solid.get(), hull.get(), &gap, &e), e);
    return gap;
}

} // namespace ovoid

#endif
