/**
 * @file bullet_shapes.hpp
 * Bullet's convex shapes in ovoid's words. <ovoid/bullet.hpp> includes it.
 */
#ifndef OVOID_BULLET_SHAPES_HPP
#define OVOID_BULLET_SHAPES_HPP

#include "ovoid/adapter.hpp"

#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <btBulletCollisionCommon.h>

#include <array>
#include <cstdint>

namespace ovoid {
namespace bullet {

namespace detail {

inline ovoid_vec3 from_bullet(const btVector3 &v) { return {double(v.x()), double(v.y()), double(v.z())}; }
inline btVector3 to_bullet(const ovoid_vec3 &v) { return {btScalar(v.x), btScalar(v.y), btScalar(v.z)}; }

/// The pose of a transform. Bullet keeps a matrix, whose rounding drifts; the rotation is that of its quaternion.
inline ovoid_pose from_bullet(const btTransform &t) {
    const btQuaternion q = t.getRotation();
    return {from_bullet(t.getOrigin()), {double(q.w()), double(q.x()), double(q.y()), double(q.z())}};
}

} // namespace detail

/** A Bullet shape in ovoid's words: the shape, and its pose in the frame of Bullet's. */
struct translation {
    adapters::shared_shape made; /**< nullptr: not translated */
    pose local;
    bool has_pose = false; /**< false: local is the identity */

    /** The pose of the shape, if Bullet's shape is at a transform. */
    ovoid_pose place(const btTransform &at) const {
        const ovoid_pose outer = detail::from_bullet(at);
        return has_pose ? ovoid_pose_compute_product(&outer, &local) : outer;
    }
};

namespace detail {

/// The vertices of a mesh's triangles.
class vertex_collector : public btInternalTriangleIndexCallback {
  public:
    vertex_collector(adapters::description &to, const btVector3 &scale) : to_(&to), scale_(scale) {}
    void internalProcessTriangleIndex(btVector3 *triangle, int, int) override {
        for (int i = 0; i < 3; i++) add(*to_, triangle[i] * scale_);
    }
    static void add(adapters::description &to, const btVector3 &v) {
        to.insert(to.end(), {double(v.x()), double(v.y()), double(v.z())});
    }

  private:
    adapters::description *to_;
    btVector3 scale_;
};

/// Adds the points whose hull a shape is, without its margin; false if it is no hull of points.
inline bool add_points(const btConvexShape &of, adapters::description &to) {
    switch (of.getShapeType()) {
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
        const auto &hull = static_cast<const btConvexHullShape &>(of);
        for (int i = 0; i < hull.getNumPoints(); i++) vertex_collector::add(to, hull.getScaledPoint(i));
        return true;
    }
    case CONVEX_POINT_CLOUD_SHAPE_PROXYTYPE: {
        const auto &cloud = static_cast<const btConvexPointCloudShape &>(of);
        for (int i = 0; i < cloud.getNumPoints(); i++) vertex_collector::add(to, cloud.getScaledPoint(i));
        return true;
    }
    case CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE: {
        const auto &mesh = static_cast<const btConvexTriangleMeshShape &>(of);
        vertex_collector collect(to, mesh.getLocalScaling());
        constexpr btScalar far = btScalar(BT_LARGE_FLOAT);
        mesh.getMeshInterface()->InternalProcessAllTriangles(&collect, {-far, -far, -far}, {far, far, far});
        return true;
    }
    case TRIANGLE_SHAPE_PROXYTYPE:
    case TETRAHEDRAL_SHAPE_PROXYTYPE:
    case CUSTOM_POLYHEDRAL_SHAPE_TYPE: {
        const auto &polyhedron = static_cast<const btPolyhedralConvexShape &>(of);
        for (int i = 0; i < polyhedron.getNumVertices(); i++) {
            btVector3 v;
            polyhedron.getVertex(i, v);
            vertex_collector::add(to, v);
        }
        return true;
    }
    case MULTI_SPHERE_SHAPE_PROXYTYPE: {
        const auto &spheres = static_cast<const btMultiSphereShape &>(of);
        for (int i = 0; i < spheres.getSphereCount(); i++)
            vertex_collector::add(to, spheres.getSpherePosition(i) * spheres.getLocalScaling());
        return true;
    }
    default: return false;
    }
}

/// The radius by which the hull of the points is rounded; negative: not by one radius.
inline double radius_of_hull(const btConvexShape &of) {
    if (of.getShapeType() != MULTI_SPHERE_SHAPE_PROXYTYPE) return double(of.getMargin());
    const auto &spheres = static_cast<const btMultiSphereShape &>(of);
    const btVector3 &scale = spheres.getLocalScaling();
    const btScalar radius = spheres.getSphereCount() > 0 ? spheres.getSphereRadius(0) : btScalar(-1);
    for (int i = 1; i < spheres.getSphereCount(); i++)
        if (spheres.getSphereRadius(i) != radius) return -1;
    return scale.x() == scale.y() && scale.y() == scale.z() ? double(radius * scale.x()) : -1;
}

/// A description: the kind, the radius around it, the sizes.
inline translation find_sized(adapters::shape_table &table, const adapters::description &of, int axis) {
    shape_options options;
    options.radius = of[1];
    const double x = of[2], y = of[3];
    translation made;
    made.has_pose = axis != 2;
    made.local = pose(adapters::make_axis_pose(axis));
    made.made = table.find(of, [&] {
        switch (int(of[0])) {
        case BOX_SHAPE_PROXYTYPE: return shape::box(vec3(x, y, of[4]), options);
        case SPHERE_SHAPE_PROXYTYPE: return shape::sphere(x, options);
        case CAPSULE_SHAPE_PROXYTYPE: return shape::capsule(x, y, options);
        case CONE_SHAPE_PROXYTYPE: return shape::cone(x, y, 0, options);
        default: return shape::cylinder(x, y, 0, options);
        }
    });
    return made;
}

/// The translation of a convex shape.
inline translation translate(adapters::shape_table &table, const btConvexShape &of) {
    const int type = of.getShapeType();
    switch (type) {
    case BOX_SHAPE_PROXYTYPE: {
        const btVector3 half = static_cast<const btBoxShape &>(of).getHalfExtentsWithMargin();
        return find_sized(table, {double(type), 0, double(half.x()), double(half.y()), double(half.z())}, 2);
    }
    case SPHERE_SHAPE_PROXYTYPE:
        return find_sized(table, {double(type), 0, double(static_cast<const btSphereShape &>(of).getRadius()), 0}, 2);
    case CAPSULE_SHAPE_PROXYTYPE: {
        const auto &capsule = static_cast<const btCapsuleShape &>(of);
        return find_sized(table, {double(type), 0, double(capsule.getRadius()), double(capsule.getHalfHeight())},
                          capsule.getUpAxis());
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
        const auto &cylinder = static_cast<const btCylinderShape &>(of);
        const int axis = cylinder.getUpAxis();
        const double half = double(cylinder.getHalfExtentsWithMargin()[axis]);
        return find_sized(table, {double(type), 0, double(cylinder.getRadius()), half}, axis);
    }
    case CONE_SHAPE_PROXYTYPE: {
        const auto &cone = static_cast<const btConeShape &>(of);
        const double margin = double(cone.getMargin()), half = 0.5 * double(cone.getHeight());
        return find_sized(table, {double(type), margin, double(cone.getRadius()), half}, cone.getConeUpIndex());
    }
    default: break;
    }
    translation made;
    shape_options options;
    options.radius = radius_of_hull(of);
    adapters::description points = {double(CONVEX_HULL_SHAPE_PROXYTYPE), options.radius};
    if (options.radius < 0 || !add_points(of, points)) return made;
    made.made = table.find(points, [&] {
        const double *xyz = points.data() + 2;
        return shape::from_points(span<const double>(xyz, points.size() - 2), options);
    });
    return made;
}

/// A triangle of a mesh, by Bullet's numbers.
struct mesh_triangle {
    std::array<btVector3, 3> corners;
    int part, index;
};

inline bool operator==(const mesh_triangle &t, const btVector3 *corners) {
    return t.corners[0] == corners[0] && t.corners[1] == corners[1] && t.corners[2] == corners[2];
}

/// A mesh as a solid: its triangles in the order in which Bullet's tree gave them.
struct mesh_solid {
    std::vector<mesh_triangle> triangles;
    std::unordered_map<std::uint64_t, std::uint32_t> places;
    solid made;

    static std::uint64_t key(int part, int index) {
        return std::uint64_t(std::uint32_t(part)) << 32 | std::uint32_t(index);
    }
};

/// Takes all triangles of a mesh.
class triangle_collector : public btTriangleCallback {
  public:
    explicit triangle_collector(std::vector<mesh_triangle> &to) : to_(&to) {}
    void processTriangle(btVector3 *corners, int part, int index) override {
        to_->push_back({{corners[0], corners[1], corners[2]}, part, index});
    }

  private:
    std::vector<mesh_triangle> *to_;
};

/// Compares the triangles near a shape with those of a solid.
class triangle_check : public btTriangleCallback {
  public:
    explicit triangle_check(const mesh_solid *of) : has_changed(!of), of_(of) {}
    void processTriangle(btVector3 *corners, int part, int index) override {
        count++;
        if (has_changed) return;
        const auto found = of_->places.find(mesh_solid::key(part, index));
        has_changed = found == of_->places.end() || !(of_->triangles[found->second] == corners);
    }
    std::size_t count = 0;
    bool has_changed;

  private:
    const mesh_solid *of_;
};

/// Meshes as solids, by their addresses. Safe for any number of threads.
class solid_table {
  public:
    /// The solid of a mesh; made, if there is none, or only one that is known to be old.
    std::shared_ptr<const mesh_solid> find(const btConcaveShape &of, const std::shared_ptr<const mesh_solid> &old) {
        const std::lock_guard<std::mutex> lock(mutex_);
        std::shared_ptr<const mesh_solid> &found = solids_[&of];
        if (!found || found == old) found = make(of);
        return found;
    }
    /// Forgets the solids that no pair uses now.
    void drop_unused() {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (auto i = solids_.begin(); i != solids_.end();) i = i->second.use_count() == 1 ? solids_.erase(i) : ++i;
    }

  private:
    static std::shared_ptr<const mesh_solid> make(const btConcaveShape &of) {
        auto made = std::make_shared<mesh_solid>();
        triangle_collector collect(made->triangles);
        constexpr btScalar far = btScalar(BT_LARGE_FLOAT);
        of.processAllTriangles(&collect, {-far, -far, -far}, {far, far, far});
        std::vector<double> xyz;
        std::vector<std::uint32_t> indices;
        for (const mesh_triangle &t : made->triangles) {
            made->places[mesh_solid::key(t.part, t.index)] = std::uint32_t(&t - made->triangles.data());
            for (const btVector3 &corner : t.corners) {
                indices.push_back(std::uint32_t(xyz.size() / 3));
                xyz.insert(xyz.end(), {double(corner.x()), double(corner.y()), double(corner.z())});
            }
        }
        made->made = solid::from_triangles(xyz.data(), xyz.size() / 3, indices.data(), made->triangles.size());
        return made;
    }

    std::mutex mutex_;
    std::unordered_map<const btConcaveShape *, std::shared_ptr<const mesh_solid>> solids_;
};

} // namespace detail
} // namespace bullet
} // namespace ovoid

#endif
