/**
 * @file body.hpp
 * FCL's geometries as bodies of ovoid, for <ovoid/fcl.hpp>. Box, Sphere, Capsule, Convex and TriangleP are shapes
 * without an allowance; Cylinder, Cone and Ellipsoid are the true bodies, stored as inscribed polyhedra; a BVHModel is
 * the surface of its triangles.
 */
#ifndef OVOID_FCL_BODY_HPP
#define OVOID_FCL_BODY_HPP

#include "ovoid/body.h"
#include "ovoid/fcl/boxes.hpp"
#include "ovoid/fcl/pose.hpp"
#include "ovoid/fcl/print.hpp"
#include "ovoid/motion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace ovoid {
namespace fcl {
namespace detail {

/// How far the prism of a cylinder and the pyramid of a cone may be from it, as a part of the radius.
constexpr double round_tolerance = 1e-4;

struct shape_deleter {
    void operator()(ovoid_shape *shape) const { ovoid_shape_destroy(shape); }
};
struct solid_deleter {
    void operator()(ovoid_solid *solid) const { ovoid_solid_destroy(solid); }
};
using shape_owner = std::unique_ptr<ovoid_shape, shape_deleter>;
using solid_owner = std::unique_ptr<ovoid_solid, solid_deleter>;

/// A box by its centre and half lengths, and the sum of all of these, which rounding goes by.
struct centered_box {
    double center[3], half[3], size = 0;

    explicit centered_box(const ovoid_box &box) {
        const double low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
        for (int k = 0; k < 3; k++) {
            center[k] = (low[k] + high[k]) / 2;
            half[k] = high[k] - center[k];
            size += std::fabs(center[k]) + half[k];
        }
    }
};

/// A tree of boxes over the triangles of a solid, in the solid's own order. A shape has one box.
struct box_tree {
    std::vector<centered_box> boxes;
    std::vector<std::uint32_t> order;  ///< the triangle of each leaf
    std::vector<std::uint32_t> places; ///< the leaf of each triangle

    explicit box_tree(std::vector<std::uint32_t> triangles = {}) : order(std::move(triangles)), places(order.size()) {
        for (std::size_t k = 0; k < order.size(); k++) places[order[k]] = static_cast<std::uint32_t>(k);
    }
    /// The place of a triangle among the leaves.
    std::size_t find(std::uint32_t triangle) const { return triangle < places.size() ? places[triangle] : 0; }
};

/// Two balls around a point of a shape, in its own frame: one that holds it and one that it holds.
struct shape_balls {
    ovoid_vec3 center{0, 0, 0};
    double outer = std::numeric_limits<double>::infinity(), inner = -outer; ///< these decide nothing
};

/// The balls of a shape. A solid's inner ellipsoid is proven to be in it; its radii, and the middle of a point or a
/// segment, are right to a part in 1e9 of the size. The middle of a flat shape may be beside it: it has no inner ball.
inline shape_balls make_balls(const ovoid_shape *shape) {
    const ovoid_polytope polytope = ovoid_shape_get_polytope(shape);
    const ovoid_ellipsoid inside = ovoid_shape_get_inner(shape).ellipsoid;
    const double radius = ovoid_shape_get_radius(shape);
    const ovoid_vec3 c = polytope.rank == 3 ? inside.center : ovoid_shape_get_measures(shape).sphere_center,
                     &o = polytope.origin;
    double square = 0;
    for (std::size_t i = 0; i < polytope.vertex_count; i++) {
        const double *v = polytope.vertices + 3 * i, x = v[0] - c.x, y = v[1] - c.y, z = v[2] - c.z;
        square = std::max(square, x * x + y * y + z * z);
    }
    shape_balls balls;
    balls.center = {o.x + c.x, o.y + c.y, o.z + c.z};
    balls.outer = (1 + 1e-9) * (std::sqrt(square) + radius + ovoid_shape_get_allowance(shape).outside);
    if (polytope.rank == 2) return balls;
    const ovoid_vec3 radii = ovoid_ellipsoid_compute_radii(&inside);
    balls.inner =
        (polytope.rank == 3 ? std::min(radii.x, std::min(radii.y, radii.z)) : 0) + radius - 1e-9 * balls.outer;
    return balls;
}

/// A box in a shape's own frame: its centre, unit axes and half lengths, and the sum of these.
struct corner_box {
    bool is_one = false;
    ovoid_vec3 center{0, 0, 0}, axis[3];
    double half[3], size = 0;
};

/// The nearest of the points that are at right angles to the first `count` edges, as an edge from the origin, or zero.
/// Of the corners of a box around one of them that is an edge.
inline ovoid_vec3 find_edge(const ovoid_vec3 (&points)[8], const ovoid_vec3 (&edges)[3], int count) {
    ovoid_vec3 nearest{0, 0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (const ovoid_vec3 &p : points) {
        const double square = dot(p, p);
        bool is_across = square > 0 && square < least;
        for (int k = 0; k < count; k++)
            is_across =
                is_across && std::fabs(dot(p, edges[k])) <= 0x1p-50 * std::sqrt(square * dot(edges[k], edges[k]));
        if (is_across) nearest = p, least = square;
    }
    return nearest;
}

/// The box whose corners a shape has, each to 2^-51 of the box's size, if there is one. It is about its frame's origin:
/// the distance of bodies is rounded by their sizes, not by coordinates that are greater.
inline corner_box find_corner_box(const ovoid_shape *shape) {
    const ovoid_polytope polytope = ovoid_shape_get_polytope(shape);
    corner_box box;
    if (polytope.vertex_count != 8 || polytope.facet_count != 6 || ovoid_shape_get_radius(shape) > 0) return box;
    const double *v = polytope.vertices;
    ovoid_vec3 points[8], edges[3];
    double most = 0;
    for (int i = 0; i < 8; i++) {
        points[i] = {v[3 * i] - v[0], v[3 * i + 1] - v[1], v[3 * i + 2] - v[2]};
        for (int k = 0; k < 3; k++) most = std::max(most, std::fabs(v[3 * i + k]));
    }
    for (int k = 0; k < 3; k++) edges[k] = find_edge(points, edges, k);
    const ovoid_vec3 &o = polytope.origin;
    box.center = {o.x + v[0], o.y + v[1], o.z + v[2]};
    for (int k = 0; k < 3; k++) {
        const double length = std::sqrt(dot(edges[k], edges[k]));
        if (!(length > 0)) return box;
        box.center = add_scaled(box.center, edges[k], 0.5);
        box.axis[k] = add_scaled({0, 0, 0}, edges[k], 1 / length);
        box.half[k] = length / 2;
        box.size += length / 2;
    }
    if (!(most + sum_abs(o) <= 4 * box.size)) return box;
    // All sums of the edges are corners.
    for (int i = 0; i < 8; i++) {
        ovoid_vec3 corner{0, 0, 0};
        for (int k = 0; k < 3; k++)
            if (i >> k & 1) corner = add_scaled(corner, edges[k], 1);
        if (std::none_of(points, points + 8, [&](const ovoid_vec3 &p) {
                const ovoid_vec3 off = add_scaled(p, corner, -1);
                return std::max(std::fabs(off.x), std::max(std::fabs(off.y), std::fabs(off.z))) <= 0x1p-51 * box.size;
            }))
            return box;
    }
    box.is_one = true;
    return box;
}

/// A geometry of FCL as a shape or a solid; neither of them if ovoid refused it: then FCL answers.
class body {
  public:
    body() = default;
    /// may_be_box: the shape is asked whether it has the corners of a box.
    explicit body(shape_owner shape, bool may_be_box = false) : shape_(std::move(shape)) {
        if (!shape_) return;
        balls_ = make_balls(shape_.get());
        if (may_be_box) box_ = find_corner_box(shape_.get());
    }
    explicit body(solid_owner solid) : solid_(std::move(solid)), pieces_(count_triangles()) {}
    ~body() {
        for (auto &piece : pieces_) ovoid_shape_destroy(piece.load(std::memory_order_relaxed));
    }
    body(const body &) = delete;
    body &operator=(const body &) = delete;

    const ovoid_shape *shape() const { return shape_.get(); }
    const ovoid_solid *solid() const { return solid_.get(); }
    bool is_empty() const { return !shape_ && !solid_; }
    /// Of a shape; of others they decide nothing.
    const shape_balls &balls() const { return balls_; }
    /// Of a convex polytope the box that it is.
    const corner_box &box() const { return box_; }
    std::size_t size() const {
        return shape_ ? ovoid_shape_get_size(shape_.get()) : solid_ ? ovoid_solid_get_size(solid_.get()) : 0;
    }

    /// Writes the corners of triangle i of the solid.
    void get_triangle(std::uint32_t i, ovoid_vec3 *to) const {
        const double *points = ovoid_solid_get_points(solid_.get());
        std::uint32_t corners[3];
        ovoid_solid_get_triangle(solid_.get(), i, corners);
        for (int k = 0; k < 3; k++) {
            const double *xyz = points + 3 * std::size_t{corners[k]};
            to[k] = {xyz[0], xyz[1], xyz[2]};
        }
    }
    /// The shape, or triangle i of the solid as a shape, which is made when it is first wanted. NULL: no memory is
    /// left.
    const ovoid_shape *piece(std::uint32_t i) const {
        if (shape_) return shape_.get();
        ovoid_shape *made = pieces_[i].load(std::memory_order_acquire);
        if (made) return made;
        ovoid_vec3 at[3];
        get_triangle(i, at);
        const double xyz[9] = {at[0].x, at[0].y, at[0].z, at[1].x, at[1].y, at[1].z, at[2].x, at[2].y, at[2].z};
        ovoid_shape *mine = ovoid_shape_create_from_points(xyz, 3, nullptr, nullptr);
        if (pieces_[i].compare_exchange_strong(made, mine, std::memory_order_acq_rel)) return mine;
        ovoid_shape_destroy(mine);
        return made;
    }

    /// The tree of boxes, which is made when it is first wanted.
    const box_tree &tree() const {
        std::call_once(once_, [this] {
            if (shape_) return make_box();
            const std::uint32_t *order = ovoid_solid_get_order(solid_.get());
            tree_ = box_tree({order, order + pieces_.size()});
            std::vector<ovoid_box> boxes(count_boxes(pieces_.size()));
            fill_boxes(boxes, {0, 0, pieces_.size()},
                       [this](std::size_t k) { return box_of_triangle(tree_.order[k]); });
            for (const ovoid_box &box : boxes) tree_.boxes.emplace_back(box);
        });
        return tree_;
    }

  private:
    std::size_t count_triangles() const {
        return solid_ ? static_cast<std::size_t>(ovoid_solid_get_report(solid_.get()).triangles) : 0;
    }
    void make_box() const {
        ovoid_moving_shape still{};
        still.shape = shape_.get();
        still.motion = ovoid_motion_make_still(ovoid_pose_make_identity());
        ovoid_box box = ovoid_moving_shape_compute_box(&still, 0, 0);
        const double outside = ovoid_shape_get_allowance(shape_.get()).outside;
        box.min = {box.min.x - outside, box.min.y - outside, box.min.z - outside};
        box.max = {box.max.x + outside, box.max.y + outside, box.max.z + outside};
        tree_ = box_tree({0});
        tree_.boxes.emplace_back(box);
    }
    ovoid_box box_of_triangle(std::uint32_t i) const {
        ovoid_vec3 at[3];
        get_triangle(i, at);
        return join(join({at[0], at[0]}, {at[1], at[1]}), {at[2], at[2]});
    }

    shape_owner shape_;
    shape_balls balls_;
    corner_box box_;
    solid_owner solid_;
    mutable std::vector<std::atomic<ovoid_shape *>> pieces_;
    mutable std::once_flag once_;
    mutable box_tree tree_;
};

/// The hull of points of FCL.
template <class S> ovoid_shape *make_hull(const ::fcl::Vector3<S> *points, std::size_t count) {
    std::vector<double> xyz;
    xyz.reserve(3 * count);
    for (std::size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) xyz.push_back(static_cast<double>(points[i][k]));
    return ovoid_shape_create_from_points(xyz.data(), count, nullptr, nullptr);
}

/// A surface of triangles. FCL's meshes have no inside: where they are closed, one triangle is turned over, so that
/// ovoid's solid has none either. A triangle without area would change nothing, so the next one is tried.
template <class S> ovoid_solid *make_surface(const mesh_view<S> &view) {
    std::vector<double> xyz;
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < view.vertex_count; i++)
        for (int k = 0; k < 3; k++) xyz.push_back(static_cast<double>(view.vertices[i][k]));
    for (int i = 0; i < view.triangle_count; i++)
        for (int k = 0; k < 3; k++) indices.push_back(static_cast<std::uint32_t>(view.triangles[i][k]));
    const ovoid_triangles triangles = {xyz.data(), xyz.size() / 3, indices.data(), indices.size() / 3};
    solid_owner solid(ovoid_solid_create_from_triangles(&triangles, nullptr, nullptr));
    for (std::size_t i = 0; i < triangles.count && solid && ovoid_solid_get_report(solid.get()).is_closed; i++) {
        std::swap(indices[3 * i + 1], indices[3 * i + 2]);
        solid.reset(ovoid_solid_create_from_triangles(&triangles, nullptr, nullptr));
    }
    return solid.release();
}

/// Translates a geometry. What ovoid refuses, for example a box with a negative side, becomes an empty body.
template <class S> std::shared_ptr<const body> make_body(const geometry<S> *g) {
    const auto hold = [](ovoid_shape *shape) { return std::make_shared<const body>(shape_owner(shape)); };
    ovoid_shape_options options{};
    switch (g->getNodeType()) {
    case ::fcl::GEOM_BOX: {
        const ovoid_vec3 side = to_vec3<S>(static_cast<const ::fcl::Box<S> *>(g)->side);
        return hold(ovoid_shape_create_box({side.x / 2, side.y / 2, side.z / 2}, nullptr, nullptr));
    }
    case ::fcl::GEOM_SPHERE:
        return hold(ovoid_shape_create_sphere(static_cast<const ::fcl::Sphere<S> *>(g)->radius, nullptr, nullptr));
    case ::fcl::GEOM_ELLIPSOID:
        return hold(ovoid_shape_create_ellipsoid(to_vec3<S>(static_cast<const ::fcl::Ellipsoid<S> *>(g)->radii),
                                                 nullptr, nullptr));
    case ::fcl::GEOM_CAPSULE: {
        const auto *s = static_cast<const ::fcl::Capsule<S> *>(g);
        return hold(ovoid_shape_create_capsule(s->radius, static_cast<double>(s->lz) / 2, nullptr, nullptr));
    }
    case ::fcl::GEOM_CYLINDER: {
        const auto *s = static_cast<const ::fcl::Cylinder<S> *>(g);
        options.tolerance = static_cast<double>(s->radius) * round_tolerance;
        return hold(ovoid_shape_create_cylinder(s->radius, static_cast<double>(s->lz) / 2, &options, nullptr));
    }
    case ::fcl::GEOM_CONE: {
        const auto *s = static_cast<const ::fcl::Cone<S> *>(g);
        options.tolerance = static_cast<double>(s->radius) * round_tolerance;
        return hold(ovoid_shape_create_cone(s->radius, static_cast<double>(s->lz) / 2, &options, nullptr));
    }
    case ::fcl::GEOM_TRIANGLE: {
        const auto *s = static_cast<const ::fcl::TriangleP<S> *>(g);
        const ::fcl::Vector3<S> points[3] = {s->a, s->b, s->c};
        return hold(make_hull<S>(points, 3));
    }
    case ::fcl::GEOM_CONVEX: {
        const auto &vertices = static_cast<const ::fcl::Convex<S> *>(g)->getVertices();
        return std::make_shared<const body>(shape_owner(make_hull<S>(vertices.data(), vertices.size())), true);
    }
    default: break;
    }
    mesh_view<S> view;
    if (!view_mesh(g, view)) return std::make_shared<const body>();
    solid_owner surface(make_surface(view));
    return surface ? std::make_shared<const body>(std::move(surface)) : std::make_shared<const body>();
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
