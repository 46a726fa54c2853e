/**
 * @file shape.hpp
 * Shapes: class shape owns one, shape_view borrows one; their ellipsoids and measures.
 *
 * A shape is immutable, and any number of bodies and threads share it; borrowers must not outlive it. If there is no
 * single owner, use std::make_shared<const ovoid::shape>(ovoid::shape::box(...)): *pointer is a shape_view.
 */
#ifndef OVOID_CPP_SHAPE_HPP
#define OVOID_CPP_SHAPE_HPP

#include "ovoid/cpp/points.hpp"

namespace ovoid {

class shape;

/** Options of a shape: radius, gap, inner, allocator. */
using shape_options = zeroed<ovoid_shape_options>;
/** A view of a convex polyhedron. */
using polytope = ovoid_polytope;
/** An ellipsoid. */
using ellipsoid = ovoid_ellipsoid;
/** An ellipsoid with its gap. */
using fit = ovoid_fit;
/** Volume, area, centroid, inertia, box and sphere. */
using measures = ovoid_measures;

/** A view of a shape that is owned elsewhere: one pointer, passed by value. Queries take it. */
class shape_view {
  public:
    constexpr shape_view() noexcept = default;
    /** Wraps a C shape, which must outlive the view. */
    constexpr explicit shape_view(const ovoid_shape *from) noexcept : shape_(from) {}
    /** The C shape, borrowed; nullptr if there is none. */
    constexpr const ovoid_shape *get() const noexcept { return shape_; }
    /** False if there is no shape: after a move, or by default. Then no other function may be called. */
    explicit constexpr operator bool() const noexcept { return shape_ != nullptr; }

    /** The polyhedron. */
    ovoid_polytope polytope() const noexcept { return ovoid_shape_get_polytope(shape_); }
    /** The vertices in the body frame: the polyhedron's origin plus a vertex is a point of the user's local frame. */
    span<const double> vertices() const noexcept {
        const ovoid_polytope p = polytope();
        return {p.vertices, std::size_t{3} * p.vertex_count};
    }
    /** The triangles: three vertices each. */
    span<const std::uint32_t> triangles() const noexcept {
        const ovoid_polytope p = polytope();
        return {p.triangles, std::size_t{3} * p.triangle_count};
    }
    /** The rounding radius. */
    double radius() const noexcept { return ovoid_shape_get_radius(shape_); }
    /** How far the true body may differ from the shape. */
    ovoid_allowance allowance() const noexcept { return ovoid_shape_get_allowance(shape_); }
    /** The true body, where it is a cylinder or a cone. */
    ovoid_round round() const noexcept { return ovoid_shape_get_round(shape_); }
    /** What the constructor did with the given points. */
    ovoid_report report() const noexcept { return ovoid_shape_get_report(shape_); }
    /** Was it made as a lean shape? */
    bool is_lean() const noexcept { return ovoid_shape_is_lean(shape_) != 0; }
    /** The outer ellipsoid of the polyhedron. */
    ovoid_fit outer() const noexcept { return ovoid_shape_get_outer(shape_); }
    /** The inner ellipsoid of the polyhedron. */
    ovoid_fit inner() const noexcept { return ovoid_shape_get_inner(shape_); }
    /** Measures of the polyhedron without its radius. */
    ovoid_measures measures() const noexcept { return ovoid_shape_get_measures(shape_); }
    /** Size of the block in bytes. */
    std::size_t size_in_bytes() const noexcept { return ovoid_shape_get_size(shape_); }

    /** A copy with memory of its own. Throws MEMORY. */
    shape copy(const ovoid_allocator *allocator = nullptr) const;
    /** A copy with another allowance. */
    shape allowed(ovoid_allowance allowance) const;
    /**
     * The shape with its vertices moved to the given points, one for each vertex. Throws ARGUMENT (another number of
     * points), and as shape::from_points.
     */
    template <class Points>
    shape deformed(const Points &points, const ovoid_shape_options &options = shape_options()) const;
    /**
     * The two parts on the sides of a plane: first the side normal . x <= offset. A part is empty if nothing is on its
     * side. Throws as ovoid_shape_create_divided fails.
     */
    std::pair<shape, shape> divided(const ovoid_plane &plane,
                                    const ovoid_shape_options &options = shape_options()) const;
    /** The bytes of an .ovoid file. */
    std::vector<unsigned char> write() const {
        std::vector<unsigned char> bytes(ovoid_shape_write(shape_, nullptr, 0));
        ovoid_shape_write(shape_, bytes.data(), bytes.size());
        return bytes;
    }

  private:
    const ovoid_shape *shape_ = nullptr;
};

/** A shape that owns its memory: it moves and does not copy (copy() makes a copy). Creation throws ovoid::error. */
class shape : public detail::owner<shape_view, ovoid_shape, ovoid_shape_destroy> {
  public:
    using owner::owner;

    /**
     * The convex hull of the points of a container. Throws EMPTY, NOT_FINITE (place: the point), RANGE, RADIUS, LIMIT,
     * HULL, MEMORY, and ARGUMENT as points_of does.
     */
    template <class Points>
    static shape from_points(const Points &points, const ovoid_shape_options &options = shape_options()) {
        const point_array p = points_of(points);
        return made([&](ovoid_error *e) { return ovoid_shape_create_from_points(p.data(), p.size(), &options, e); });
    }
    /** The convex hull of points in braces. */
    static shape from_points(std::initializer_list<vec3> points, const ovoid_shape_options &options = shape_options()) {
        const point_array p = points_of(points);
        return made([&](ovoid_error *e) { return ovoid_shape_create_from_points(p.data(), p.size(), &options, e); });
    }
    /**
     * A polyhedron from points and faces; each face is a container of vertex indices. The input is stated to be convex,
     * which is checked. Throws INDEX, NOT_CONVEX (place: the face), and as from_points.
     */
    template <class Points, class Faces>
    static shape from_faces(const Points &points, const Faces &faces,
                            const ovoid_shape_options &options = shape_options()) {
        const point_array p = points_of(points);
        const face_array f(faces);
        return from_faces(f.with(p), options);
    }
    /** As above, from the C struct. */
    static shape from_faces(const ovoid_faces &faces, const ovoid_shape_options &options = shape_options()) {
        return made([&](ovoid_error *e) { return ovoid_shape_create_from_faces(&faces, &options, e); });
    }
    /** An axis-aligned box of the given half sizes around the origin. */
    static shape box(const vec3 &half, const ovoid_shape_options &options = shape_options()) {
        return made([&](ovoid_error *e) { return ovoid_shape_create_box(half, &options, e); });
    }
    /** A sphere around the origin. */
    static shape sphere(double radius, const ovoid_shape_options &options = shape_options()) {
        return made([&](ovoid_error *e) { return ovoid_shape_create_sphere(radius, &options, e); });
    }
    /** A capsule along z: a segment of length 2 half_length with a radius. */
    static shape capsule(double radius, double half_length, const ovoid_shape_options &options = shape_options()) {
        return made([&](ovoid_error *e) { return ovoid_shape_create_capsule(radius, half_length, &options, e); });
    }
    /**
     * A cylinder along z, represented by a prism with an allowance of at most the tolerance, a length; 0: radius / 200.
     */
    static shape cylinder(double radius, double half_length, double tolerance = 0,
                          const ovoid_shape_options &options = shape_options()) {
        ovoid_shape_options o = options;
        if (tolerance != 0) o.tolerance = tolerance;
        return made([&](ovoid_error *e) { return ovoid_shape_create_cylinder(radius, half_length, &o, e); });
    }
    /**
     * A cone along z with its apex at z = +half_length, represented by a pyramid with an allowance of at most the
     * tolerance.
     */
    static shape cone(double radius, double half_length, double tolerance = 0,
                      const ovoid_shape_options &options = shape_options()) {
        ovoid_shape_options o = options;
        if (tolerance != 0) o.tolerance = tolerance;
        return made([&](ovoid_error *e) { return ovoid_shape_create_cone(radius, half_length, &o, e); });
    }
    /**
     * The ellipsoid around the origin with half axes along x, y and z, represented by a polyhedron with an allowance of
     * at most the tolerance; 0: a 13th of the largest half axis.
     */
    static shape ellipsoid(const vec3 &half_axes, double tolerance = 0,
                           const ovoid_shape_options &options = shape_options()) {
        ovoid_shape_options o = options;
        if (tolerance != 0) o.tolerance = tolerance;
        return made([&](ovoid_error *e) { return ovoid_shape_create_ellipsoid(half_axes, &o, e); });
    }
    /** A prism of n >= 3 sides along z, inscribed in the cylinder: exactly this polyhedron, without an allowance. */
    static shape prism(double radius, double half_length, std::uint32_t sides,
                       const ovoid_shape_options &options = shape_options()) {
        const ovoid_prism by = {radius, half_length, sides};
        return made([&](ovoid_error *e) { return ovoid_shape_create_prism(&by, &options, e); });
    }
    /** A pyramid of n >= 3 sides along z, apex at z = +half_length; without an allowance. */
    static shape pyramid(double radius, double half_length, std::uint32_t sides,
                         const ovoid_shape_options &options = shape_options()) {
        const ovoid_prism by = {radius, half_length, sides};
        return made([&](ovoid_error *e) { return ovoid_shape_create_pyramid(&by, &options, e); });
    }
    /**
     * A shape from the bytes of an .ovoid file in any contiguous container; every byte is checked. Throws FORMAT
     * (place: the byte), MEMORY.
     */
    template <class Bytes> static shape read(const Bytes &bytes, const ovoid_allocator *allocator = nullptr) {
        const std::size_t size = std::size(bytes) * sizeof(*std::data(bytes));
        shape_options o;
        o.allocator = allocator;
        return made([&](ovoid_error *e) { return ovoid_shape_read(std::data(bytes), size, &o, e); });
    }

  private:
    friend class shape_view;
    template <class Create> static shape made(const Create &create) {
        ovoid_error e;
        return shape(detail::require(create(&e), e));
    }
};

inline shape shape_view::allowed(ovoid_allowance allowance) const {
    shape_options o;
    o.allowance = allowance;
    return shape::made([&](ovoid_error *e) { return ovoid_shape_create_allowed(shape_, &o, e); });
}

inline shape shape_view::copy(const ovoid_allocator *allocator) const {
    shape_options o;
    o.allocator = allocator;
    return shape::made([&](ovoid_error *e) { return ovoid_shape_create_copy(shape_, &o, e); });
}

template <class Points> shape shape_view::deformed(const Points &points, const ovoid_shape_options &options) const {
    const point_array p = points_of(points);
    if (p.size() != polytope().vertex_count)
        detail::fail(OVOID_ERROR_ARGUMENT, "one point is needed for each vertex of the shape");
    return shape::made([&](ovoid_error *e) { return ovoid_shape_create_deformed(shape_, p.data(), &options, e); });
}

inline std::pair<shape, shape> shape_view::divided(const ovoid_plane &plane, const ovoid_shape_options &options) const {
    ovoid_error e;
    const ovoid_shape_halves halves = ovoid_shape_create_divided(shape_, &plane, &options, &e);
    detail::require(halves.code, e);
    return {shape(halves.below), shape(halves.above)};
}

/** Measures of a polyhedron. */
inline ovoid_measures compute_measures(const ovoid_polytope &p) noexcept { return ovoid_polytope_compute_measures(&p); }

/**
 * The smallest ellipsoid around a polyhedron, to a relative gap of its volume (0: the default, 1e-6). Throws ARGUMENT,
 * MEMORY.
 */
inline ovoid_fit compute_outer(const ovoid_polytope &p, double gap = 0, const ovoid_allocator *allocator = nullptr) {
    ovoid_fit made;
    ovoid_error e;
    const ovoid_ellipsoid_options o = {gap, allocator};
    detail::require(ovoid_ellipsoid_compute_outer(&p, &o, &made, &e), e);
    return made;
}
/**
 * The largest ellipsoid inside a polyhedron, to a relative gap of its volume (0: the default, 1e-6). Throws ARGUMENT,
 * MEMORY.
 */
inline ovoid_fit compute_inner(const ovoid_polytope &p, double gap = 0, const ovoid_allocator *allocator = nullptr) {
    ovoid_fit made;
    ovoid_error e;
    const ovoid_ellipsoid_options o = {gap, allocator};
    detail::require(ovoid_ellipsoid_compute_inner(&p, &o, &made, &e), e);
    return made;
}
/** Phase 1 of the paper: the outer ellipsoid, shrunk until it is inside. */
inline ovoid_fit compute_shrunk(const ovoid_polytope &p, const ovoid_ellipsoid &outer) noexcept {
    return ovoid_ellipsoid_compute_shrunk(&p, &outer);
}
/** Phase 2 of the paper: the shrunk ellipsoid, stretched toward the farthest facet. */
inline ovoid_fit compute_stretched(const ovoid_polytope &p, const ovoid_ellipsoid &shrunk) noexcept {
    return ovoid_ellipsoid_compute_stretched(&p, &shrunk);
}
/** Phase 3 of the paper: the stretched ellipsoid with each radius enlarged. */
inline ovoid_fit compute_enlarged(const ovoid_polytope &p, const ovoid_ellipsoid &stretched) noexcept {
    return ovoid_ellipsoid_compute_enlarged(&p, &stretched);
}
/** The radii of an ellipsoid, in descending order. */
inline vec3 compute_radii(const ovoid_ellipsoid &e) noexcept { return ovoid_ellipsoid_compute_radii(&e); }
/** The volume of an ellipsoid. */
inline double compute_volume(const ovoid_ellipsoid &e) noexcept { return ovoid_ellipsoid_compute_volume(&e); }
/** An ellipsoid moved by a pose, rounded. */
inline ovoid_ellipsoid compute_posed(const ovoid_ellipsoid &e, const pose &at) noexcept {
    return ovoid_ellipsoid_compute_posed(&e, &at);
}
/** The point of the ellipsoid nearest to a point. */
inline ovoid_nearest compute_nearest_to_point(const ovoid_ellipsoid &e, const vec3 &point) noexcept {
    return ovoid_ellipsoid_compute_nearest_to_point(&e, point);
}
/** The paper's X* and Y*: a good direction, not the Euclidean nearest points. */
inline ovoid_nearest compute_nearest_by_sphere(const ovoid_ellipsoid &a, const ovoid_ellipsoid &b) noexcept {
    return ovoid_ellipsoid_compute_nearest_by_sphere(&a, &b);
}
/** The nearest points of two ellipsoids. */
inline ovoid_nearest compute_nearest(const ovoid_ellipsoid &a, const ovoid_ellipsoid &b) noexcept {
    return ovoid_ellipsoid_compute_nearest(&a, &b);
}
/** True if the ellipsoids are proven to share a point, which is written to *point (may be nullptr). */
inline bool is_overlapping(const ovoid_ellipsoid &a, const ovoid_ellipsoid &b, vec3 *point = nullptr) noexcept {
    return ovoid_ellipsoid_is_overlapping(&a, &b, point) != 0;
}

} // namespace ovoid

#endif
