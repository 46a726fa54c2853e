/**
 * @file dart_shapes.hpp
 * DART's shapes in ovoid's words, and half spaces, which ovoid does not have. <ovoid/dart.hpp> includes it.
 */
#ifndef OVOID_DART_SHAPES_HPP
#define OVOID_DART_SHAPES_HPP

#include "ovoid/adapter.hpp"

#include <assimp/scene.h>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/MultiSphereConvexHullShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include <array>
#include <limits>
#include <map>
#include <optional>

namespace ovoid {
namespace dartsim {
namespace detail {

namespace shapes = ::dart::dynamics;

inline Eigen::Vector3d to_dart(const ovoid_vec3 &v) { return {v.x, v.y, v.z}; }
inline ovoid_vec3 from_dart(const Eigen::Vector3d &v) { return {v.x(), v.y(), v.z()}; }
inline ovoid_pose from_dart(const Eigen::Isometry3d &t) {
    const Eigen::Quaterniond q(t.linear());
    return {from_dart(Eigen::Vector3d(t.translation())), {q.w(), q.x(), q.y(), q.z()}};
}

/// A convex part; it has the frame of its whole. `middle` and `half`: its box there.
struct part {
    adapters::shared_shape made;
    ovoid_vec3 middle = {}, half = {};
};

/// A half space: normal . x <= offset, in the frame of its shape.
struct half_space {
    ovoid_vec3 normal;
    double offset;
};

/// A shape of DART: convex parts, or a half space. A mesh that is not convex has its triangles as parts, for distances
/// and rays, and is a solid for contacts.
struct geometry {
    std::vector<part> parts;
    std::shared_ptr<const solid> mesh;
    std::optional<half_space> plane;
};

/// A contact's points and normal, from the first to the second.
struct manifold {
    ovoid_vec3 normal;
    ovoid_manifold_points points;
    /// The same with the sides exchanged.
    manifold flipped() const {
        manifold other = *this;
        other.normal = {-normal.x, -normal.y, -normal.z};
        for (ovoid_manifold_point &p : other.points.points) std::swap(p.point_a, p.point_b);
        return other;
    }
};

inline double dot(const ovoid_vec3 &a, const ovoid_vec3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline ovoid_vec3 along(const ovoid_vec3 &p, const ovoid_vec3 &n, double t) {
    return {p.x + t * n.x, p.y + t * n.y, p.z + t * n.z};
}

inline bool do_boxes_meet(const ovoid_box &a, const ovoid_box &b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

inline part make_part(adapters::shared_shape made) {
    const ovoid_vec3 origin = made->made.polytope().origin;
    const ovoid_box box = made->made.measures().box;
    const double more = made->made.radius() + made->made.allowance().outside;
    part whole;
    whole.middle = {origin.x + 0.5 * (box.min.x + box.max.x), origin.y + 0.5 * (box.min.y + box.max.y),
                    origin.z + 0.5 * (box.min.z + box.max.z)};
    whole.half = {0.5 * (box.max.x - box.min.x) + more, 0.5 * (box.max.y - box.min.y) + more,
                  0.5 * (box.max.z - box.min.z) + more};
    whole.made = std::move(made);
    return whole;
}

/// The box of a part at a pose: of its turned box, with room for rounding.
inline ovoid_box compute_box(const part &of, const ovoid_pose &at) {
    double m[9];
    ovoid_pose_compute_matrix(&at, m);
    const ovoid_vec3 c = ovoid_pose_compute_point(&at, of.middle);
    const auto reach = [&](int row) {
        const double *r = m + 3 * row;
        const double sum = std::abs(r[0]) * of.half.x + std::abs(r[1]) * of.half.y + std::abs(r[2]) * of.half.z;
        return sum + 1e-13 * (sum + std::abs(c.x) + std::abs(c.y) + std::abs(c.z));
    };
    const double x = reach(0), y = reach(1), z = reach(2);
    return {{c.x - x, c.y - y, c.z - z}, {c.x + x, c.y + y, c.z + z}};
}

/// The box of a whole shape; of a half space, everything.
inline ovoid_box compute_box(const geometry &of, const ovoid_pose &at) {
    constexpr double far = std::numeric_limits<double>::max();
    if (of.plane) return {{-far, -far, -far}, {far, far, far}};
    ovoid_box all = {{far, far, far}, {-far, -far, -far}};
    for (const part &one : of.parts) {
        const ovoid_box box = compute_box(one, at);
        all.min = {std::min(all.min.x, box.min.x), std::min(all.min.y, box.min.y), std::min(all.min.z, box.min.z)};
        all.max = {std::max(all.max.x, box.max.x), std::max(all.max.y, box.max.y), std::max(all.max.z, box.max.z)};
    }
    return all;
}

/// Points on the unit sphere: an octahedron's faces cut into 12 x 12, and how far the sphere exceeds their hull.
inline std::vector<ovoid_vec3> make_sphere_points() {
    std::vector<ovoid_vec3> points;
    constexpr int cuts = 12;
    for (int i = -cuts; i <= cuts; i++)
        for (int j = -cuts; j <= cuts; j++) {
            const int rest = cuts - std::abs(i) - std::abs(j);
            if (rest < 0) continue;
            for (const int k : {rest, -rest}) {
                const double length = std::sqrt(double(i * i + j * j + k * k));
                points.push_back({i / length, j / length, k / length});
                if (rest == 0) break;
            }
        }
    return points;
}

/// An ellipsoid as the hull of points on it. The hull of the unit sphere's points holds a ball of radius r; stretched,
/// every point of the ellipsoid is within (1 - r) of its largest radius of the hull.
inline shape make_ellipsoid(const Eigen::Vector3d &radii) {
    std::vector<ovoid_vec3> points = make_sphere_points();
    const shape unit = shape::from_points(points);
    double r = 1;
    const ovoid_polytope p = unit.polytope();
    for (std::uint32_t i = 0; i < p.facet_count; i++) r = std::min(r, p.planes[i].offset);
    for (ovoid_vec3 &v : points) v = {v.x * radii.x(), v.y * radii.y(), v.z * radii.z()};
    shape_options options;
    options.allowance.outside = (1 - r) * radii.maxCoeff() * (1 + 1e-9);
    return shape::from_points(points, options);
}

/// The triangles of a mesh, nine numbers each.
inline std::vector<double> read_triangles(const shapes::MeshShape &of) {
    std::vector<double> corners;
    const aiScene *scene = of.getMesh();
    const Eigen::Vector3d &scale = of.getScale();
    for (unsigned m = 0; scene && m < scene->mNumMeshes; m++) {
        const aiMesh &mesh = *scene->mMeshes[m];
        for (unsigned f = 0; f < mesh.mNumFaces; f++) {
            // A polygon as a fan.
            for (unsigned k = 2; k < mesh.mFaces[f].mNumIndices; k++)
                for (const unsigned corner : {0u, k - 1, k}) {
                    const aiVector3D &v = mesh.mVertices[mesh.mFaces[f].mIndices[corner]];
                    corners.insert(corners.end(), {v.x * scale.x(), v.y * scale.y(), v.z * scale.z()});
                }
        }
    }
    return corners;
}

/// Whether triangles are the whole surface of a convex body, which is then returned.
inline std::optional<shape> make_convex(const std::vector<double> &corners) {
    std::map<std::array<double, 3>, std::uint32_t> numbers;
    std::vector<double> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (std::size_t i = 0; i + 9 <= corners.size(); i += 9) {
        std::array<std::uint32_t, 3> face;
        for (std::size_t k = 0; k < 3; k++) {
            const double *v = corners.data() + i + 3 * k;
            const auto entry = numbers.emplace(std::array<double, 3>{v[0], v[1], v[2]}, std::uint32_t(numbers.size()));
            if (entry.second) vertices.insert(vertices.end(), v, v + 3);
            face[k] = entry.first->second;
        }
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) faces.push_back(face);
    }
    try {
        return shape::from_faces(vertices, faces);
    } catch (const error &) {
        return std::nullopt; // not closed, or not convex: triangles then
    }
}

inline geometry translate_mesh(adapters::shape_table &table, const shapes::MeshShape &of) {
    const std::vector<double> corners = read_triangles(of);
    if (corners.empty()) ovoid::detail::fail(OVOID_ERROR_EMPTY, "the mesh has no triangles");
    geometry made;
    if (std::optional<shape> convex = make_convex(corners)) {
        made.parts.push_back(make_part(std::make_shared<const adapters::sized_shape>(std::move(*convex))));
        return made;
    }
    std::vector<std::uint32_t> indices(corners.size() / 3);
    for (std::size_t i = 0; i < indices.size(); i++) indices[i] = std::uint32_t(i);
    made.mesh = std::make_shared<const solid>(
        solid::from_triangles(corners.data(), indices.size(), indices.data(), indices.size() / 3));
    for (std::size_t i = 0; i + 9 <= corners.size(); i += 9) {
        adapters::description of_triangle = {-1};
        of_triangle.insert(of_triangle.end(), corners.begin() + std::ptrdiff_t(i),
                           corners.begin() + std::ptrdiff_t(i + 9));
        made.parts.push_back(make_part(table.find(
            of_triangle, [&] { return shape::from_points(span<const double>(of_triangle.data() + 1, 9)); })));
    }
    return made;
}

inline geometry translate_spheres(adapters::shape_table &table, const shapes::MultiSphereConvexHullShape &of) {
    adapters::description points = {-2, of.getSpheres().empty() ? 0 : of.getSpheres()[0].first};
    for (const auto &[radius, middle] : of.getSpheres()) {
        if (radius != points[1])
            ovoid::detail::fail(OVOID_ERROR_ARGUMENT, "a hull of spheres of different radii is not answered by ovoid");
        points.insert(points.end(), {middle.x(), middle.y(), middle.z()});
    }
    shape_options options;
    options.radius = points[1];
    geometry made;
    made.parts.push_back(make_part(table.find(points, [&] {
        return shape::from_points(span<const double>(points.data() + 2, points.size() - 2), options);
    })));
    return made;
}

/// A part of the kind and the sizes, from the table.
template <class Create>
geometry translate_sized(adapters::shape_table &table, const adapters::description &of, const Create &create) {
    geometry made;
    made.parts.push_back(make_part(table.find(of, create)));
    return made;
}

/// Any shape; throws ARGUMENT for those that ovoid does not answer.
inline geometry translate(adapters::shape_table &table, const shapes::Shape &of) {
    if (of.is<shapes::BoxShape>()) {
        const Eigen::Vector3d half = 0.5 * static_cast<const shapes::BoxShape &>(of).getSize();
        return translate_sized(table, {0, half.x(), half.y(), half.z()}, [&] { return shape::box(from_dart(half)); });
    }
    if (of.is<shapes::SphereShape>()) {
        const double r = static_cast<const shapes::SphereShape &>(of).getRadius();
        return translate_sized(table, {1, r}, [&] { return shape::sphere(r); });
    }
    if (of.is<shapes::EllipsoidShape>()) {
        const Eigen::Vector3d r = static_cast<const shapes::EllipsoidShape &>(of).getRadii();
        if (r.x() == r.y() && r.y() == r.z())
            return translate_sized(table, {1, r.x()}, [&] { return shape::sphere(r.x()); });
        return translate_sized(table, {2, r.x(), r.y(), r.z()}, [&] { return make_ellipsoid(r); });
    }
    if (of.is<shapes::CapsuleShape>()) {
        const auto &c = static_cast<const shapes::CapsuleShape &>(of);
        const double r = c.getRadius(), half = 0.5 * c.getHeight();
        return translate_sized(table, {3, r, half}, [&] { return shape::capsule(r, half); });
    }
    if (of.is<shapes::CylinderShape>()) {
        const auto &c = static_cast<const shapes::CylinderShape &>(of);
        const double r = c.getRadius(), half = 0.5 * c.getHeight();
        return translate_sized(table, {4, r, half}, [&] { return shape::cylinder(r, half); });
    }
    if (of.is<shapes::ConeShape>()) {
        const auto &c = static_cast<const shapes::ConeShape &>(of);
        const double r = c.getRadius(), half = 0.5 * c.getHeight();
        return translate_sized(table, {5, r, half}, [&] { return shape::cone(r, half); });
    }
    if (of.is<shapes::PyramidShape>()) {
        const auto &p = static_cast<const shapes::PyramidShape &>(of);
        const double x = 0.5 * p.getBaseWidth(), y = 0.5 * p.getBaseDepth(), z = 0.5 * p.getHeight();
        return translate_sized(table, {6, x, y, z}, [&] {
            return shape::from_points(
                {vec3(-x, -y, -z), vec3(x, -y, -z), vec3(x, y, -z), vec3(-x, y, -z), vec3(0, 0, z)});
        });
    }
    if (of.is<shapes::MultiSphereConvexHullShape>())
        return translate_spheres(table, static_cast<const shapes::MultiSphereConvexHullShape &>(of));
    // By its type, not by is<>, which a soft mesh would pass too.
    if (of.getType() == shapes::MeshShape::getStaticType())
        return translate_mesh(table, static_cast<const shapes::MeshShape &>(of));
    if (of.is<shapes::PlaneShape>()) {
        const auto &p = static_cast<const shapes::PlaneShape &>(of);
        geometry made;
        made.plane = half_space{from_dart(p.getNormal()), p.getOffset()};
        return made;
    }
    const std::string why = "a " + of.getType() + " is not answered by ovoid";
    ovoid::detail::fail(OVOID_ERROR_ARGUMENT, why.c_str());
}

/// The corners of a part over a plane: in the world, with their heights, the radius already taken off.
struct corner {
    ovoid_vec3 at;
    double height;
};
inline std::vector<corner> measure_corners(const part &of, const ovoid_pose &at, const half_space &in_world) {
    std::vector<corner> all;
    const ovoid_vec3 origin = of.made->made.polytope().origin;
    const span<const double> xyz = of.made->made.vertices();
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
        const ovoid_vec3 local = {origin.x + xyz[i], origin.y + xyz[i + 1], origin.z + xyz[i + 2]};
        const ovoid_vec3 world = along(ovoid_pose_compute_point(&at, local), in_world.normal, -of.made->made.radius());
        all.push_back({world, dot(in_world.normal, world) - in_world.offset});
    }
    return all;
}

inline half_space move_plane(const half_space &plane, const ovoid_pose &at) {
    const ovoid_pose turn = {{0, 0, 0}, at.rotation};
    const ovoid_vec3 n = ovoid_pose_compute_point(&turn, plane.normal);
    return {n, plane.offset + dot(n, at.position)};
}

/// The lowest point of a part over a half space.
struct nearest {
    double distance;
    ovoid_vec3 on_part, on_plane;
};
inline nearest measure_plane(const part &of, const ovoid_pose &at, const half_space &plane,
                             const ovoid_pose &plane_at) {
    const half_space in_world = move_plane(plane, plane_at);
    const std::vector<corner> all = measure_corners(of, at, in_world);
    const auto lowest =
        std::min_element(all.begin(), all.end(), [](const corner &a, const corner &b) { return a.height < b.height; });
    return {lowest->height, lowest->at, along(lowest->at, in_world.normal, -lowest->height)};
}

/// Of the corners below the plane the lowest, the one farthest from it, and those farthest to both sides of that line.
inline std::vector<corner> reduce_corners(std::vector<corner> below, const ovoid_vec3 &normal) {
    if (below.size() <= 4) return below;
    const auto take = [&](const auto &value) {
        const auto best = std::max_element(below.begin(), below.end(),
                                           [&](const corner &a, const corner &b) { return value(a) < value(b); });
        const corner found = *best;
        below.erase(best);
        return found;
    };
    const auto from = [](const ovoid_vec3 &a, const ovoid_vec3 &b) {
        return ovoid_vec3{b.x - a.x, b.y - a.y, b.z - a.z};
    };
    const corner lowest = take([](const corner &c) { return -c.height; });
    const corner far = take([&](const corner &c) {
        const ovoid_vec3 d = from(lowest.at, c.at);
        return dot(d, d);
    });
    const ovoid_vec3 line = from(lowest.at, far.at);
    const ovoid_vec3 aside = {normal.y * line.z - normal.z * line.y, normal.z * line.x - normal.x * line.z,
                              normal.x * line.y - normal.y * line.x};
    const corner left = take([&](const corner &c) { return dot(aside, c.at); });
    const corner right = take([&](const corner &c) { return -dot(aside, c.at); });
    return {lowest, far, left, right};
}

/// The contact of a part with a half space. Its heights are exact but for rounding: the normal is the only direction
/// out.
inline manifold meet_plane(const part &of, const ovoid_pose &at, const half_space &plane, const ovoid_pose &plane_at) {
    const half_space in_world = move_plane(plane, plane_at);
    std::vector<corner> below = measure_corners(of, at, in_world);
    below.erase(std::remove_if(below.begin(), below.end(), [](const corner &c) { return c.height > 0; }), below.end());
    const ovoid_vec3 n = in_world.normal;
    manifold made = {{-n.x, -n.y, -n.z}, {}};
    for (const corner &c : reduce_corners(std::move(below), n)) {
        ovoid_manifold_point &p = made.points.points[made.points.count++];
        p.point_a = c.at;
        p.point_b = along(c.at, n, -c.height);
        p.separation = c.height;
    }
    return made;
}

/// The first hit of a ray on a shape; fraction of the way from its first point to its last.
struct ray_hit {
    bool is_hit = false;
    double fraction = 0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};
inline ray_hit cast_ray(const geometry &of, const ovoid_pose &at, const Eigen::Vector3d &from,
                        const Eigen::Vector3d &to) {
    ray_hit first;
    const auto take = [&](double t, const ovoid_vec3 &normal) {
        if (first.is_hit && t >= first.fraction) return;
        first = {true, t, to_dart(normal)};
    };
    if (of.plane) {
        const half_space plane = move_plane(*of.plane, at);
        const double begin = dot(plane.normal, from_dart(from)) - plane.offset;
        const double end = dot(plane.normal, from_dart(to)) - plane.offset;
        if (begin > 0 && end <= 0) take(begin / (begin - end), plane.normal);
    }
    ovoid_ray ray = {from_dart(from), from_dart(Eigen::Vector3d(to - from)), 1, 0};
    for (const part &one : of.parts) {
        const ovoid_posed_shape body = {one.made->made.get(), at};
        // What has no inside is hit by a ray of a thickness near rounding.
        ray.radius = one.made->made.polytope().rank < 3 && one.made->made.radius() == 0
                         ? 1e-9 * (one.half.x + one.half.y + one.half.z)
                         : 0;
        const ovoid_ray_hit hit = ovoid_shape_cast_ray(&body, &ray);
        if (std::isfinite(hit.upper) && hit.lower <= 1) take(hit.lower, hit.normal);
    }
    return first;
}

} // namespace detail
} // namespace dartsim
} // namespace ovoid

#endif
