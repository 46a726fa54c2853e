// Shared by FCL's two many-body contestants.
#ifndef OVOID_BENCH_PEERS_PEER_MANY_FCL_H
#define OVOID_BENCH_PEERS_PEER_MANY_FCL_H

#include "peers/many_peer.h"
#include "peers/peer_fcl.h"

#include <memory>
#include <vector>

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

    /// Sets a box other than that of the vertices.
    void set_box(const fcl::AABBd &box) { aabb = box; }

    /// The largest reach of a vertex along a direction of the world, relative to the body's position.
    double find_extreme(const fcl::Vector3d &direction) const {
        fcl::Vector3d own = t.linear().transpose() * direction;
        double most = -INFINITY;
        for (const auto &v : convex->getVertices()) most = std::max(most, own.dot(v));
        return most;
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
