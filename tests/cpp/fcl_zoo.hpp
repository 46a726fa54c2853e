// A geometry of each type of FCL that <ovoid/fcl.hpp> answers, and random poses, for the tests of that header.
#ifndef OVOID_TESTS_FCL_ZOO_HPP
#define OVOID_TESTS_FCL_ZOO_HPP

#include "check.h"

#include <fcl/fcl.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

template <class S> using geometry_of = std::shared_ptr<fcl::CollisionGeometry<S>>;

template <class S> struct named {
    std::string name;
    geometry_of<S> geometry;
};

/// A box as a convex polytope with quadrangles.
template <class S> std::shared_ptr<fcl::Convex<S>> make_convex(S half) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3<S>>>();
    for (int i = 0; i < 8; i++)
        vertices->push_back(fcl::Vector3<S>(i & 4 ? half : -half, i & 2 ? half : -half, i & 1 ? half : -half));
    const auto faces = std::make_shared<std::vector<int>>(
        std::vector<int>{4, 0, 1, 3, 2, 4, 4, 6, 7, 5, 4, 0, 4, 5, 1, 4, 2, 3, 7, 6, 4, 0, 2, 6, 4, 4, 1, 5, 7, 3});
    return std::make_shared<fcl::Convex<S>>(vertices, 6, faces);
}

/// A sphere of triangles with volumes of type BV.
template <class BV> std::shared_ptr<fcl::BVHModel<BV>> make_ball(double radius, unsigned parts = 8) {
    using S = typename BV::S;
    auto model = std::make_shared<fcl::BVHModel<BV>>();
    fcl::generateBVHModel(*model, fcl::Sphere<S>(static_cast<S>(radius)), fcl::Transform3<S>::Identity(), parts, parts);
    return model;
}

/// The convex ones.
template <class S> std::vector<named<S>> make_shapes() {
    using namespace fcl;
    return {{"box", std::make_shared<Box<S>>(S(1), S(0.8), S(0.6))},
            {"sphere", std::make_shared<Sphere<S>>(S(0.5))},
            {"ellipsoid", std::make_shared<Ellipsoid<S>>(S(0.5), S(0.4), S(0.3))},
            {"capsule", std::make_shared<Capsule<S>>(S(0.25), S(0.8))},
            {"cone", std::make_shared<Cone<S>>(S(0.4), S(0.9))},
            {"cylinder", std::make_shared<Cylinder<S>>(S(0.4), S(0.8))},
            {"convex", make_convex<S>(S(0.45))},
            {"triangle",
             std::make_shared<TriangleP<S>>(Vector3<S>(0, 0, 0), Vector3<S>(1, 0, 0), Vector3<S>(0, 1, S(0.25)))}};
}

struct random_poses {
    std::mt19937 engine;
    std::normal_distribution<double> normal;
    explicit random_poses(unsigned seed) : engine(seed) { check_seed = seed; }

    template <class S> fcl::Transform3<S> make(double spread) {
        const auto real = [this] { return normal(engine); };
        const Eigen::Quaterniond q = Eigen::Quaterniond(real(), real(), real(), real()).normalized();
        fcl::Transform3<S> t = fcl::Transform3<S>::Identity();
        t.linear() = q.cast<S>().toRotationMatrix();
        for (int i = 0; i < 3; i++) t.translation()[i] = static_cast<S>(spread * real());
        return t;
    }
};

#endif
