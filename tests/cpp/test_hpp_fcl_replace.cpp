// <ovoid/fcl.hpp> in the place of FCL's calls: a program of FCL, unchanged, whose calls ovoid answers. What tells them
// apart: FCL takes a triangle with a sphere for unsupported, and a broad-phase manager's callback comes to ovoid too.
#define OVOID_FCL_REPLACE
#include <ovoid/fcl.hpp>

#include "fcl_zoo.hpp"

using namespace fcl;

int main() {
    const auto mesh = make_ball<OBBRSSd>(0.5);
    const TrianglePd triangle(Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0));
    const Sphered ball(0.25);
    const Transform3d at = Transform3d::Identity(), up(Eigen::Translation3d(0.2, 0.2, 1));
    DistanceRequestd request(true);
    DistanceResultd result;
    CHECK_NEAR(distance(&triangle, at, &ball, up, request, result), 0.75, 1e-9);
    // Meshes of different volumes, which FCL does not take.
    const auto other = make_ball<AABBd>(0.5);
    result.clear();
    CHECK_LE(distance(mesh.get(), at, other.get(), up, request, result), 1);
    ContinuousCollisionRequestd moving;
    ContinuousCollisionResultd when;
    Transform3d end = up;
    end.translation()[2] = -1;
    CHECK_NEAR(continuousCollide(&triangle, at, at, &ball, up, end, moving, when), 0.375, 1e-6);
    // Objects by a manager of FCL, with its own callbacks and with one that asks by objects.
    std::vector<std::unique_ptr<CollisionObjectd>> objects;
    DynamicAABBTreeCollisionManagerd manager;
    objects.push_back(std::make_unique<CollisionObjectd>(std::make_shared<TrianglePd>(triangle), at));
    objects.push_back(std::make_unique<CollisionObjectd>(std::make_shared<Sphered>(0.25),
                                                         Transform3d(Eigen::Translation3d(0.2, 0.2, 0.2))));
    objects.push_back(std::make_unique<CollisionObjectd>(mesh, Transform3d(Eigen::Translation3d(9, 0, 0))));
    for (auto &o : objects) manager.registerObject(o.get());
    manager.setup();
    struct found {
        std::size_t hits = 0;
        double nearest = 1e9;
    } seen;
    manager.collide(&seen, [](CollisionObjectd *a, CollisionObjectd *b, void *to) {
        CollisionRequestd wanted(10, true);
        CollisionResultd contacts;
        static_cast<found *>(to)->hits += collide(a, b, wanted, contacts) > 0;
        return false;
    });
    CHECK_EQ(seen.hits, 1u);
    manager.distance(&seen, [](CollisionObjectd *a, CollisionObjectd *b, void *to, double &least) {
        DistanceRequestd wanted(true, true);
        DistanceResultd r;
        auto &nearest = static_cast<found *>(to)->nearest;
        least = nearest = std::min(nearest, distance(a, b, wanted, r));
        return false;
    });
    CHECK_NEAR(seen.nearest, -0.05, 1e-9);
    return check_end();
}
