// What Bullet's contestants share: hulls without margins, and poses. Built once in double and once in single precision.
#ifndef OVOID_BENCH_PEERS_BULLET_HULLS_H
#define OVOID_BENCH_PEERS_BULLET_HULLS_H

#include <ovoid/linear.h>

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <cstdint>
#include <memory>

inline btVector3 to_bullet(const ovoid_vec3 &v) { return {btScalar(v.x), btScalar(v.y), btScalar(v.z)}; }

inline btTransform make_transform(const ovoid_pose &pose) {
    const ovoid_quat &q = pose.rotation;
    return btTransform(btQuaternion(btScalar(q.x), btScalar(q.y), btScalar(q.z), btScalar(q.w)),
                       to_bullet(pose.position));
}

/// x, y, z of each vertex.
inline std::unique_ptr<btConvexHullShape> make_hull(const double *vertices, std::uint32_t count) {
    auto shape = std::make_unique<btConvexHullShape>();
    for (std::uint32_t k = 0; k < count; k++, vertices += 3)
        shape->addPoint(to_bullet({vertices[0], vertices[1], vertices[2]}), false);
    shape->setMargin(0);
    shape->recalcLocalAabb();
    return shape;
}

#endif
