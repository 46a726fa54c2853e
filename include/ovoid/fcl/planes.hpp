/**
 * @file planes.hpp
 * FCL's Halfspace and Plane against its other geometries, in closed form, for <ovoid/fcl.hpp>. Both are unbounded, so
 * they are no bodies of ovoid. The other geometry's extent along the plane's normal, from FCL's own sizes, decides:
 * right to a few roundings for every type, round ones included.
 */
#ifndef OVOID_FCL_PLANES_HPP
#define OVOID_FCL_PLANES_HPP

#include "ovoid/fcl/pose.hpp"
#include "ovoid/fcl/print.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace ovoid {
namespace fcl {
namespace detail {

/// The components of a vector along the columns of a transform.
template <class S> ovoid_vec3 turn_back(const ::fcl::Transform3<S> &t, const ovoid_vec3 &v) {
    return {dot(get_column<S>(t, 0), v), dot(get_column<S>(t, 1), v), dot(get_column<S>(t, 2), v)};
}
/// Where a transform puts a point.
template <class S> ovoid_vec3 move(const ::fcl::Transform3<S> &t, const ovoid_vec3 &point) {
    return add_scaled(turn<S>(t, point), get_column<S>(t, 3), 1);
}

/// The sign of a direction's component; 0 where the component is no more than a rounding, so that of a face or an edge
/// that is parallel to the plane the middle counts, as in FCL.
inline double side_of(double component) { return std::fabs(component) <= 1e-15 ? 0 : std::copysign(1, component); }

/// A point set's farthest point along a direction; i: of a mesh its triangle, else -1.
struct extreme {
    ovoid_vec3 point;
    double height;
    int i;
};

template <class S> class supporter {
  public:
    explicit supporter(const ovoid_vec3 &direction) : n_(direction) {}

    void add(const ::fcl::Vector3<S> &at) {
        const ovoid_vec3 point = to_vec3<S>(at);
        const double height = dot(n_, point);
        if (height > best_.height) best_ = {point, height, -1};
    }
    const extreme &get() const { return best_; }

  private:
    ovoid_vec3 n_;
    extreme best_{{0, 0, 0}, -std::numeric_limits<double>::infinity(), -1};
};

/// The farthest point of a triangle or a convex polytope along a unit direction of its frame; its height is -infinity
/// of other types.
template <class S> extreme find_extreme(const typed<S> &geometry, const ovoid_vec3 &n) {
    supporter<S> to(n);
    const auto *g = geometry.of;
    switch (geometry.type) {
    case ::fcl::GEOM_TRIANGLE: {
        const auto *s = static_cast<const ::fcl::TriangleP<S> *>(g);
        to.add(s->a), to.add(s->b), to.add(s->c);
        break;
    }
    case ::fcl::GEOM_CONVEX:
        for (const auto &v : static_cast<const ::fcl::Convex<S> *>(g)->getVertices()) to.add(v);
        break;
    default: break;
    }
    return to.get();
}

/// A halfspace { n x <= d } or a plane { n x = d }, n of length 1.
struct plane {
    ovoid_vec3 n;
    double d;
    bool is_halfspace;
};

/// The plane in the world; its normal is not finite if it was no plane.
template <class S> OVOID_FCL_INLINE plane make_plane(const typed<S> &geometry, const ::fcl::Transform3<S> &pose) {
    const bool is_halfspace = geometry.type == ::fcl::GEOM_HALFSPACE;
    ovoid_vec3 n;
    double d;
    if (is_halfspace) {
        const auto *h = static_cast<const ::fcl::Halfspace<S> *>(geometry.of);
        n = to_vec3<S>(h->n), d = static_cast<double>(h->d);
    } else {
        const auto *h = static_cast<const ::fcl::Plane<S> *>(geometry.of);
        n = to_vec3<S>(h->n), d = static_cast<double>(h->d);
    }
    // FCL's constructors leave a normal of length 1; whoever writes another one into the geometry means its direction.
    const double square = dot(n, n);
    n = turn<S>(pose, n);
    if (!(std::fabs(square - 1) <= 1e-15)) {
        const double length = std::sqrt(square);
        n = {n.x / length, n.y / length, n.z / length}, d /= length;
    }
    return {n, d + dot(n, get_column<S>(pose, 3)), is_halfspace};
}

/// Is the plane's transform one of ours? No more of the rotation is read than the normal; one that is not a unit vector
/// to a few roundings is asked for the rest.
template <class S> OVOID_FCL_INLINE bool is_placed(const plane &p, const ::fcl::Transform3<S> &pose) {
    return off_unit(p.n) <= columns_rounding ? is_in_range<S>(pose) : is_rigid<S>(pose);
}
/// Is that of a geometry beside it? Of a sphere the rotation is not read, of a body around an axis the axis alone; a
/// box and an ellipsoid may be mirrored.
template <class S> OVOID_FCL_INLINE bool is_placed(const typed<S> &geometry, const ::fcl::Transform3<S> &pose) {
    bool is_plain = false;
    switch (geometry.type) {
    case ::fcl::GEOM_SPHERE: is_plain = true; break;
    case ::fcl::GEOM_CAPSULE:
    case ::fcl::GEOM_CYLINDER:
    case ::fcl::GEOM_CONE: is_plain = off_unit(get_column<S>(pose, 2)) <= columns_rounding; break;
    case ::fcl::GEOM_BOX:
    case ::fcl::GEOM_ELLIPSOID: is_plain = is_rotation<S>(pose); break;
    default: break;
    }
    return is_plain ? is_in_range<S>(pose) : is_rigid<S>(pose);
}

/// Where a geometry meets a plane: points and normal in the world, from the geometry to the plane.
struct plane_answer {
    double distance;  ///< signed
    ovoid_vec3 point; ///< of the geometry
    ovoid_vec3 on_plane;
    ovoid_vec3 normal;
    ovoid_vec3 position; ///< of a contact, as in FCL: on a plane; half way between a halfspace's plane and the point
    int i;               ///< of a mesh the triangle, else -1
};

/// How far a geometry's lowest and highest points are above a plane.
struct extent {
    double low, high;
};

/// Has a type an extent in closed form?
inline bool has_extent(::fcl::NODE_TYPE type) { return type >= ::fcl::GEOM_BOX && type <= ::fcl::GEOM_CYLINDER; }

/// The extent of a geometry, without its points; infinite of a type that has none. Of a body around an axis no column
/// of the transform is read but that.
template <class S>
OVOID_FCL_INLINE extent find_extent(const typed<S> &geometry, const ::fcl::Transform3<S> &pose, const plane &p) {
    const auto *g = geometry.of;
    const double middle = dot(p.n, get_column<S>(pose, 3)) - p.d;
    const auto around = [middle](double reach) { return extent{middle - reach, middle + reach}; };
    const ovoid_vec3 &n = p.n, axis = get_column<S>(pose, 2);
    const double z = dot(axis, n);
    const auto across = [&] {
        const ovoid_vec3 off = {n.x - z * axis.x, n.y - z * axis.y, n.z - z * axis.z};
        return std::sqrt(dot(off, off));
    };
    const auto add_sides = [&](const ::fcl::Vector3<S> &lengths, auto measure) {
        return measure(static_cast<double>(lengths[0]) * dot(get_column<S>(pose, 0), n),
                       static_cast<double>(lengths[1]) * dot(get_column<S>(pose, 1), n),
                       static_cast<double>(lengths[2]) * z);
    };
    switch (geometry.type) {
    case ::fcl::GEOM_SPHERE: return around(static_cast<double>(static_cast<const ::fcl::Sphere<S> *>(g)->radius));
    case ::fcl::GEOM_BOX:
        return around(add_sides(static_cast<const ::fcl::Box<S> *>(g)->side, [](double u, double v, double w) {
            return (std::fabs(u) + std::fabs(v) + std::fabs(w)) / 2;
        }));
    case ::fcl::GEOM_ELLIPSOID:
        return around(add_sides(static_cast<const ::fcl::Ellipsoid<S> *>(g)->radii,
                                [](double u, double v, double w) { return std::sqrt(u * u + v * v + w * w); }));
    case ::fcl::GEOM_CAPSULE: {
        const auto *s = static_cast<const ::fcl::Capsule<S> *>(g);
        return around(static_cast<double>(s->lz) / 2 * std::fabs(z) + static_cast<double>(s->radius));
    }
    case ::fcl::GEOM_CYLINDER: {
        const auto *s = static_cast<const ::fcl::Cylinder<S> *>(g);
        return around(static_cast<double>(s->lz) / 2 * std::fabs(z) + static_cast<double>(s->radius) * across());
    }
    case ::fcl::GEOM_CONE: {
        const auto *s = static_cast<const ::fcl::Cone<S> *>(g);
        const double apex = static_cast<double>(s->lz) / 2 * z, rim = static_cast<double>(s->radius) * across();
        return {middle + std::min(apex, -apex - rim), middle + std::max(apex, rim - apex)};
    }
    default: return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    }
}

/// 1: a geometry of this extent is apart from a plane; -1: it meets it; 0: the extent does not tell, to rounding.
OVOID_FCL_INLINE int find_side(const extent &e, const plane &p) {
    const double doubt = 1e-14 * (e.high - e.low + std::fabs(e.low) + std::fabs(p.d)),
                 apart = p.is_halfspace ? e.low : std::max(e.low, -e.high);
    return apart > doubt ? 1 : apart < -doubt ? -1 : 0;
}

/// The lowest (sign -1) or the highest (1) point above a plane of a geometry that has an extent.
template <class S>
OVOID_FCL_INLINE ovoid_vec3 find_end(const typed<S> &geometry, const ::fcl::Transform3<S> &pose, const plane &p,
                                     double sign) {
    const auto *g = geometry.of;
    const ovoid_vec3 &n = p.n, axis = get_column<S>(pose, 2), middle = get_column<S>(pose, 3);
    const double along[3] = {dot(get_column<S>(pose, 0), n), dot(get_column<S>(pose, 1), n), dot(axis, n)};
    const auto go_along = [&](double lz) { return add_scaled(middle, axis, sign * side_of(along[2]) * lz / 2); };
    // From a point of the axis to the rim around it.
    const auto go_across = [&](const ovoid_vec3 &from, double radius) {
        const ovoid_vec3 off = add_scaled(n, axis, -along[2]);
        const double length = std::sqrt(dot(off, off));
        return length > 1e-15 ? add_scaled(from, off, sign * radius / length) : from;
    };
    const auto go = [&](double x, double y, double z) {
        return add_scaled(add_scaled(add_scaled(middle, get_column<S>(pose, 0), x), get_column<S>(pose, 1), y), axis,
                          z);
    };
    switch (geometry.type) {
    case ::fcl::GEOM_SPHERE:
        return add_scaled(middle, n, sign * static_cast<double>(static_cast<const ::fcl::Sphere<S> *>(g)->radius));
    case ::fcl::GEOM_BOX: {
        const auto &side = static_cast<const ::fcl::Box<S> *>(g)->side;
        const auto half = [&](int k) { return sign * side_of(along[k]) * static_cast<double>(side[k]) / 2; };
        return go(half(0), half(1), half(2));
    }
    case ::fcl::GEOM_ELLIPSOID: {
        const auto &radii = static_cast<const ::fcl::Ellipsoid<S> *>(g)->radii;
        const auto scale = [&](int k) { return static_cast<double>(radii[k]) * along[k]; };
        const double part = sign / std::sqrt(scale(0) * scale(0) + scale(1) * scale(1) + scale(2) * scale(2));
        const auto reach = [&](int k) { return part * static_cast<double>(radii[k]) * scale(k); };
        return go(reach(0), reach(1), reach(2));
    }
    case ::fcl::GEOM_CAPSULE: {
        const auto *s = static_cast<const ::fcl::Capsule<S> *>(g);
        return add_scaled(go_along(s->lz), n, sign * static_cast<double>(s->radius));
    }
    case ::fcl::GEOM_CYLINDER: {
        const auto *s = static_cast<const ::fcl::Cylinder<S> *>(g);
        return go_across(go_along(s->lz), s->radius);
    }
    default: { // a cone
        const auto *s = static_cast<const ::fcl::Cone<S> *>(g);
        const double half = static_cast<double>(s->lz) / 2;
        const ovoid_vec3 apex = add_scaled(middle, axis, half),
                         rim = go_across(add_scaled(middle, axis, -half), s->radius);
        return sign * (dot(apex, n) - dot(rim, n)) > 0 ? apex : rim;
    }
    }
}

/// Does the lowest point decide, and not the highest one? Above a plane it does, or where it is less deep.
OVOID_FCL_INLINE bool is_low_deciding(const plane &p, const extent &e) {
    return p.is_halfspace || e.low > 0 || (e.high >= 0 && -e.low <= e.high);
}
/// The answer for the point that decides, with its height above the plane.
OVOID_FCL_INLINE plane_answer answer_plane(const plane &p, const extreme &by, bool is_low) {
    const double sign = is_low ? -1 : 1;
    return {-sign * by.height,
            by.point,
            add_scaled(by.point, p.n, -by.height),
            {sign * p.n.x, sign * p.n.y, sign * p.n.z},
            add_scaled(by.point, p.n, p.is_halfspace ? by.height / -2 : -by.height),
            by.i};
}
inline plane_answer answer_plane(const plane &p, const extreme &low, const extreme &high) {
    const bool is_low = is_low_deciding(p, {low.height, high.height});
    return answer_plane(p, is_low ? low : high, is_low);
}
/// The same of a geometry that has an extent.
template <class S>
OVOID_FCL_INLINE plane_answer answer_plane(const typed<S> &g, const ::fcl::Transform3<S> &pose, const plane &p,
                                           const extent &e) {
    const bool is_low = is_low_deciding(p, e);
    return answer_plane(p, {find_end(g, pose, p, is_low ? -1 : 1), is_low ? e.low : e.high, -1}, is_low);
}

/// A mesh and a plane: the height of a corner needs no transform of it.
template <class S> class mesh_heights {
  public:
    mesh_heights(const mesh_view<S> &mesh, const ::fcl::Transform3<S> &pose, const plane &p)
        : mesh_(mesh), pose_(pose), n_(turn_back<S>(pose, p.n)), offset_(dot(p.n, get_column<S>(pose, 3)) - p.d) {}

    double at(int vertex) const { return dot(n_, to_vec3<S>(mesh_.vertices[vertex])) + offset_; }
    /// FCL's operator for this is no inline function.
    int corner(int i, int k) const {
        static_assert(std::is_standard_layout<::fcl::Triangle>::value &&
                          sizeof(::fcl::Triangle) == sizeof(std::size_t[3]),
                      "a triangle is its three indices");
        const auto *corners = reinterpret_cast<const std::size_t *>(mesh_.triangles + i);
        return static_cast<int>(corners[k]);
    }
    /// A corner of triangle i, in the world.
    extreme make(int vertex, double height, int i) const {
        return {move<S>(pose_, to_vec3<S>(mesh_.vertices[vertex])), height, i};
    }
    int count() const { return mesh_.vertex_count; }
    int triangle_count() const { return mesh_.triangle_count; }

    /// The first triangle with this corner; -1: none, the vertex is not of the surface.
    int find_triangle(int vertex) const {
        for (int i = 0; i < mesh_.triangle_count; i++)
            if (corner(i, 0) == vertex || corner(i, 1) == vertex || corner(i, 2) == vertex) return i;
        return -1;
    }
    /// The lowest (sign 1) or the highest (-1) corner of all triangles.
    extreme find_end(double sign) const {
        const double far = std::numeric_limits<double>::infinity();
        int vertex = 0, triangle;
        double best = far;
        for (int i = 0; i < mesh_.vertex_count; i++) {
            const double height = sign * at(i);
            if (height < best) best = height, vertex = i;
        }
        triangle = find_triangle(vertex);
        if (triangle >= 0) return make(vertex, sign * best, triangle);
        best = far;
        for (int i = 0; i < mesh_.triangle_count; i++)
            for (int k = 0; k < 3; k++) {
                const double height = sign * at(corner(i, k));
                if (height < best) best = height, vertex = corner(i, k), triangle = i;
            }
        return make(vertex, sign * best, triangle);
    }

  private:
    const mesh_view<S> &mesh_;
    const ::fcl::Transform3<S> &pose_;
    ovoid_vec3 n_;
    double offset_;
};

/// The farthest point of a triangle or a convex polytope along a plane's normal (sign 1) or against it, in the world.
template <class S>
extreme find_height(const typed<S> &g, const ::fcl::Transform3<S> &pose, const plane &p, double sign) {
    const ovoid_vec3 n = turn_back<S>(pose, p.n);
    extreme e = find_extreme(g, {sign * n.x, sign * n.y, sign * n.z});
    e.point = move<S>(pose, e.point);
    e.height = dot(p.n, e.point) - p.d;
    return e;
}

template <class S> plane_answer ask_plane(const typed<S> &g, const ::fcl::Transform3<S> &pose, const plane &p) {
    mesh_view<S> mesh;
    if (g.type < ::fcl::GEOM_BOX && view_mesh(g.of, mesh)) {
        const mesh_heights<S> heights(mesh, pose, p);
        const extreme low = heights.find_end(1);
        return answer_plane(p, low, p.is_halfspace ? low : heights.find_end(-1));
    }
    if (has_extent(g.type)) return answer_plane(g, pose, p, find_extent(g, pose, p));
    const extreme low = find_height(g, pose, p, -1);
    return answer_plane(p, low, p.is_halfspace ? low : find_height(g, pose, p, 1));
}

/// The answers of all triangles of a mesh that touch the plane, until `take` returns false.
template <class S, class Take>
void list_plane(const geometry<S> *g, const ::fcl::Transform3<S> &pose, const plane &p, Take take) {
    mesh_view<S> mesh;
    if (!view_mesh(g, mesh)) return;
    const mesh_heights<S> heights(mesh, pose, p);
    std::vector<double> all(static_cast<std::size_t>(heights.count()));
    for (int i = 0; i < heights.count(); i++) all[static_cast<std::size_t>(i)] = heights.at(i);
    for (int i = 0; i < heights.triangle_count(); i++) {
        int low = heights.corner(i, 0), high = low;
        for (int k = 1; k < 3; k++) {
            const int vertex = heights.corner(i, k);
            const auto height_of = [&all](int of) { return all[static_cast<std::size_t>(of)]; };
            if (height_of(vertex) < height_of(low)) low = vertex;
            if (height_of(vertex) > height_of(high)) high = vertex;
        }
        const double lowest = all[static_cast<std::size_t>(low)], highest = all[static_cast<std::size_t>(high)];
        if (!(lowest <= 0) || (!p.is_halfspace && !(highest >= 0))) continue;
        if (!take(answer_plane(p, heights.make(low, lowest, i), heights.make(high, highest, i)))) return;
    }
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
