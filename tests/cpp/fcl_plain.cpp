// A program of FCL that knows nothing of ovoid. tests/cli/test_fcl_preload.sh runs it alone, and with libovoid_fcl
// loaded before libfcl: what it prints tells who answered. FCL's own answers: a triangle and a sphere, and two meshes
// with different volumes, are not supported, and a tilted box and a capsule are only about as far apart as it says.
#include <fcl/fcl.h>

#include <cstdio>
#include <iostream>

using namespace fcl;

static double ask(const CollisionGeometryd &a, const CollisionGeometryd &b, const Transform3d &t) {
    DistanceResultd result;
    return distance(&a, Transform3d(Transform3d::Identity()), &b, t, DistanceRequestd(true), result);
}

int main() {
    std::cerr.rdbuf(nullptr);
    const Transform3d up(Eigen::Translation3d(0.2, 0.2, 1));
    const TrianglePd triangle(Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0));
    const Sphered ball(0.25);
    std::printf("triangle and sphere %s\n", ask(triangle, ball, up) < 1 ? "answered" : "not supported");
    // Left to FCL by both: planes that cross, and cost.
    const Planed floor(Vector3d(0, 0, 1), 0), wall(Vector3d(1, 0, 0), 0);
    CollisionResultd result;
    const CollisionRequestd plain, cost(1, false, 3, true);
    std::printf("planes %zu\n", collide(&floor, up, &wall, up, plain, result));
    const Boxd box(1, 1, 1);
    result.clear();
    const std::size_t count = collide(&box, up, &box, up, cost, result);
    std::printf("cost %zu %zu\n", count, result.numCostSources());
    // FCL's own calls from within: a tree whose leaves are compared by FCL's default callback.
    const auto thin = std::make_shared<TrianglePd>(triangle);
    CollisionObjectd a(thin, Transform3d(Transform3d::Identity())), b(std::make_shared<Sphered>(0.25), up);
    DynamicAABBTreeCollisionManagerd manager;
    manager.registerObject(&a);
    manager.registerObject(&b);
    manager.setup();
    DefaultDistanceData<double> data;
    data.request.enable_signed_distance = true;
    manager.distance(&data, DefaultDistanceFunction<double>);
    std::printf("manager %s\n", data.result.min_distance < 1 ? "answered" : "not supported");
    ContinuousCollisionResultd when;
    Transform3d end = up;
    end.translation()[2] = -1;
    const auto wide = std::make_shared<Boxd>(4, 4, 1e-4);
    const Transform3d still = Transform3d::Identity();
    continuousCollide(wide.get(), still, still, &ball, up, end, ContinuousCollisionRequestd(), when);
    std::printf("contact at %.3f\n", when.time_of_contact);
    return 0;
}
