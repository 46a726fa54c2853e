// A program of FCL whose calls ovoid answers: the definition and the first include are all that was added. FCL alone
// does not support the distance of a triangle and a box.
#define OVOID_FCL_REPLACE
#include <ovoid/fcl.hpp>

#include <cstdio>

int main() {
    const fcl::Boxd box(2, 2, 2);
    const fcl::TrianglePd sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const fcl::Transform3d here = fcl::Transform3d::Identity(), there(Eigen::Translation3d(0.2, 0.2, 3));
    fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    std::printf("%.9g\n", fcl::distance(&sheet, here, &box, there, request, result));
}
