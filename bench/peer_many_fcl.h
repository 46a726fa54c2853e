// What both of FCL's many-body contestants use.
#ifndef OVOID_BENCH_PEER_MANY_FCL_H
#define OVOID_BENCH_PEER_MANY_FCL_H

#include "many_peer.h"

#include <fcl/fcl.h>

#include <memory>
#include <vector>

/// A Convex: above 32 vertices FCL climbs from vertex to vertex.
inline std::shared_ptr<fcl::Convexd> make_convex(const body &b) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    auto faces = std::make_shared<std::vector<int>>();
    for (uint32_t i = 0; i < b.vertex_count; i++)
        vertices->emplace_back(b.vertices[3 * i], b.vertices[3 * i + 1], b.vertices[3 * i + 2]);
    for (uint32_t t = 0; t < b.triangle_count; t++) {
        faces->push_back(3);
        for (int k = 0; k < 3; k++) faces->push_back(static_cast<int>(b.triangles[3 * t + k]));
    }
    auto shape = std::make_shared<fcl::Convexd>(vertices, static_cast<int>(b.triangle_count), faces);
    shape->computeLocalAABB();
    return shape;
}

/// A posed shape with the box of its vertices; FCL's own is the box of the enclosing sphere.
class posed_convex : public fcl::CollisionObjectd {
  public:
    posed_convex(const std::shared_ptr<fcl::Convexd> &shape, uint32_t index)
        : fcl::CollisionObjectd(shape), index(index), convex(shape.get()) {
        setUserData(this);
    }

    void move(const ovoid_pose &pose) {
        const ovoid_quat &q = pose.rotation;
        t.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
        t.translation() = fcl::Vector3d(pose.position.x, pose.position.y, pose.position.z);
        const auto &vertices = convex->getVertices();
        fcl::Vector3d low = t.linear() * vertices[0], high = low;
        for (size_t i = 1; i < vertices.size(); i++) {
            fcl::Vector3d v = t.linear() * vertices[i];
            low = low.cwiseMin(v);
            high = high.cwiseMax(v);
        }
        aabb.min_ = low + t.translation();
        aabb.max_ = high + t.translation();
    }

    const uint32_t index;

  private:
    const fcl::Convexd *convex;
};

inline const posed_convex *to_posed(const fcl::CollisionObjectd *object) {
    return static_cast<const posed_convex *>(object->getUserData());
}

extern const swarm_peer *const fcl_swarms[];
extern const cell_peer *const fcl_cells[];

#endif
