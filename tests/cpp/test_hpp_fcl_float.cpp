// <ovoid/fcl.hpp> for floats: the answers are those for doubles of the same numbers, rounded. Lengths are below 3, so
// 1e-5 is some forty roundings of them.
#include "fcl_zoo.hpp"

#include <ovoid/fcl.hpp>

using namespace fcl;

int main() {
    auto floats = make_shapes<float>();
    auto doubles = make_shapes<double>();
    floats.push_back({"mesh", make_ball<OBBRSSf>(0.5)});
    const auto mesh = std::make_shared<BVHModel<OBBRSSd>>();
    const auto &from = static_cast<const BVHModel<OBBRSSf> &>(*floats.back().geometry);
    std::vector<Vector3d> points;
    for (int i = 0; i < from.num_vertices; i++) points.push_back(from.vertices[i].cast<double>());
    mesh->beginModel();
    mesh->addSubModel(points, std::vector<Triangle>(from.tri_indices, from.tri_indices + from.num_tris));
    mesh->endModel();
    doubles.push_back({"mesh", mesh});
    floats.push_back({"half", std::make_shared<Halfspacef>(Vector3f(0, 0, 1), 0.25f)});
    doubles.push_back({"half", std::make_shared<Halfspaced>(Vector3d(0, 0, 1), 0.25)});
    random_poses poses(6);
    for (std::size_t i = 0; i + 1 < floats.size(); i++)
        for (std::size_t j = 0; j < floats.size(); j++)
            for (int n = 0; n < 4; n++) {
                const Transform3f s = poses.make<float>(0.4), t = poses.make<float>(0.4);
                const Transform3d sd = s.cast<double>(), td = t.cast<double>();
                const auto *a = floats[i].geometry.get(), *b = floats[j].geometry.get();
                const auto *ad = doubles[i].geometry.get(), *bd = doubles[j].geometry.get();
                DistanceResultf result;
                DistanceResultd truth;
                const double d = ovoid::fcl::distance<double>(ad, sd, bd, td, DistanceRequestd(true, true), truth);
                CHECK_NEAR(ovoid::fcl::distance<float>(a, s, b, t, DistanceRequestf(true, true), result), d, 1e-5);
                if (std::fabs(d) < 1e-4) continue;
                CollisionResultf hit;
                CollisionResultd hits;
                const std::size_t count = ovoid::fcl::collide<float>(a, s, b, t, CollisionRequestf(1, true), hit);
                CHECK_EQ(count, ovoid::fcl::collide<double>(ad, sd, bd, td, CollisionRequestd(1, true), hits));
                if (count > 0)
                    CHECK_NEAR(hit.getContact(0).penetration_depth, hits.getContact(0).penetration_depth, 1e-5);
            }
    // Objects.
    const CollisionObjectf x(floats[0].geometry), y(floats[1].geometry, Transform3f(Eigen::Translation3f(3, 0, 0)));
    CollisionResultf none;
    CHECK_EQ(ovoid::fcl::collide(&x, &y, CollisionRequestf(), none), 0u);
    return check_end();
}
