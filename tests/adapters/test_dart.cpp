// <ovoid/dart.hpp> in DART itself. Sources of truth: closed forms, ovoid's proven brackets for random poses, and
// physics for what rests.
#include "check.h"

#include <ovoid/dart.hpp>

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/LineSegmentShape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

#include <assimp/cimport.h>

namespace {

using namespace dart::dynamics;
using namespace dart::collision;
using Eigen::Vector3d;

SimpleFramePtr make_frame(const ShapePtr &shape, const Vector3d &at = Vector3d::Zero()) {
    auto made = SimpleFrame::createShared(Frame::World());
    made->setShape(shape);
    made->setTranslation(at);
    return made;
}

ShapePtr make_box(double x, double y, double z) { return std::make_shared<BoxShape>(Vector3d(x, y, z)); }

/// A mesh of DART from the text of an OFF file.
ShapePtr make_mesh(const std::string &off) {
    const aiScene *scene = aiImportFileFromMemory(off.data(), static_cast<unsigned>(off.size()), 0, "off");
    return std::make_shared<MeshShape>(Vector3d::Ones(), scene);
}

std::shared_ptr<ovoid::dartsim::detector> detector() {
    static const auto one = ovoid::dartsim::detector::create();
    return one;
}

/// The factory has it by name.
void test_name() {
    const auto made = CollisionDetector::getFactory()->create("ovoid");
    CHECK(made != nullptr);
    CHECK(made && made->getType() == "ovoid");
    CHECK(detector()->cloneWithoutCollisionObjects()->getType() == "ovoid");
}

/// Two boxes, one 0.01 in the other, in a group and in two.
void test_boxes() {
    const auto low = make_frame(make_box(1, 1, 1)), high = make_frame(make_box(0.8, 0.8, 0.8), {0, 0, 0.89});
    const auto both = detector()->createCollisionGroup(low.get(), high.get());
    const auto first = detector()->createCollisionGroup(low.get()),
               second = detector()->createCollisionGroup(high.get());
    CollisionResult result;
    for (const bool is_one : {true, false}) {
        const CollisionOption all(true, 100);
        CHECK(is_one ? both->collide(all, &result) : first->collide(second.get(), all, &result));
        CHECK_EQ(result.getNumContacts(), 4u);
        for (const Contact &c : result.getContacts()) {
            CHECK_NEAR(c.penetrationDepth, 0.01, 1e-12);
            CHECK(c.collisionObject1->getShapeFrame() == low.get());
            CHECK_NEAR(c.normal.z(), -1, 1e-12); // from the second to the first
            CHECK_NEAR(c.point.z(), 0.495, 1e-12);
            CHECK_NEAR(std::abs(c.point.x()), 0.4, 1e-12);
        }
    }
    // The object that was added first is the first of a contact, wherever it is; one group's objects do not meet.
    const auto right = make_frame(make_box(1, 1, 1), {0.9, 0, 0}), left = make_frame(make_box(1, 1, 1));
    const auto turned = detector()->createCollisionGroup(right.get(), left.get());
    CHECK(turned->collide(CollisionOption(true, 100), &result));
    for (const Contact &c : result.getContacts()) CHECK(c.collisionObject1->getShapeFrame() == right.get());
    const auto far = make_frame(make_box(1, 1, 1), {0.5, 0, 9});
    const auto alone = detector()->createCollisionGroup(far.get());
    CHECK(!turned->collide(alone.get(), CollisionOption(true, 100), &result));
    // At most what is asked for; without contacts the pair alone; without a result yes or no.
    both->collide(CollisionOption(true, 3), &result);
    CHECK_EQ(result.getNumContacts(), 3u);
    both->collide(CollisionOption(false, 100), &result);
    CHECK_EQ(result.getNumContacts(), 1u);
    CHECK(both->collide());
    CHECK(result.inCollision(low.get()));
    high->setTranslation({0, 0, 1});
    CHECK(!both->collide(CollisionOption(true, 100), &result));
    CHECK_EQ(result.getNumContacts(), 0u);
    CHECK(!both->collide(CollisionOption(true, 0), &result));
    // Another detector's group is not answered.
    const auto other = ovoid::dartsim::detector::create();
    CHECK(!other->collide(both.get()));
}

/// Every kind of shape at random poses: contacts exist where an overlap is proven, and are no deeper than proven.
void test_poses() {
    MultiSphereConvexHullShape::Spheres spheres = {{0.1, {0, 0, 0}}, {0.1, {0.4, 0, 0}}, {0.1, {0, 0.4, 0.2}}};
    const ShapePtr shapes[] = {
        make_box(0.8, 0.4, 0.6),
        make_box(1, 1, 0.02),
        std::make_shared<SphereShape>(0.3),
        std::make_shared<CapsuleShape>(0.2, 0.5),
        std::make_shared<CylinderShape>(0.3, 0.6),
        std::make_shared<ConeShape>(0.3, 0.7),
        std::make_shared<EllipsoidShape>(Vector3d(0.4, 0.8, 0.6)),
        std::make_shared<PyramidShape>(0.5, 0.6, 0.7),
        std::make_shared<MultiSphereConvexHullShape>(spheres),
        make_mesh("OFF\n4 4 0\n0 0 0\n.6 0 0\n0 .6 0\n0 0 .6\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")};
    ovoid::adapters::shape_table table;
    for (std::uint64_t number = 1; number <= 1000; number++) {
        std::uint64_t seed = check_seed = number;
        const ShapePtr &a = shapes[number % 10], &b = shapes[number / 10 % 10];
        const auto place = [&](SimpleFrame &frame) {
            Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
            at.translation() = 0.4 * Vector3d(random_normal(&seed), random_normal(&seed), random_normal(&seed));
            at.linear() = Eigen::Quaterniond(random_normal(&seed), random_normal(&seed), random_normal(&seed),
                                             random_normal(&seed))
                              .normalized()
                              .toRotationMatrix();
            frame.setTransform(at);
            return ovoid::dartsim::detail::from_dart(at);
        };
        const auto x = make_frame(a), y = make_frame(b);
        const auto p = ovoid::dartsim::detail::translate(table, *a), q = ovoid::dartsim::detail::translate(table, *b);
        CHECK_EQ(p.parts.size(), 1u); // the mesh is convex
        const ovoid_pair pair = {p.parts[0].made->made.get(), q.parts[0].made->made.get(), place(*x), place(*y)};
        const ovoid_answer exact = ovoid_depth(&pair, nullptr, nullptr, nullptr);
        const auto group = detector()->createCollisionGroup(x.get(), y.get());
        CollisionResult result;
        const bool touches = group->collide(CollisionOption(true, 100), &result);
        if (exact.upper < 0) CHECK(touches);
        if (exact.lower > 0) CHECK(!touches);
        for (const Contact &c : result.getContacts()) CHECK_LE(c.penetrationDepth, 5e-4 - exact.lower);
        DistanceResult near;
        const double least = group->distance(DistanceOption(true, -1e9), &near);
        CHECK_LE(exact.lower - 1e-8, least);
        CHECK_LE(least, exact.upper + 1e-8);
        if (least > 0.05) CHECK_NEAR((near.nearestPoint2 - near.nearestPoint1).norm(), least, 0.01);
    }
}

/// A box 0.01 in a half space, distances from it, and a ball over it.
void test_planes() {
    const auto plane = make_frame(std::make_shared<PlaneShape>(Vector3d::UnitZ(), 0.5));
    const auto box = make_frame(make_box(1, 1, 1), {3, 4, 0.99}),
               ball = make_frame(std::make_shared<SphereShape>(0.2), {0, 0, 1});
    for (const bool is_first : {true, false}) {
        const auto group = is_first ? detector()->createCollisionGroup(plane.get(), box.get())
                                    : detector()->createCollisionGroup(box.get(), plane.get());
        CollisionResult result;
        CHECK(group->collide(CollisionOption(true, 100), &result));
        CHECK_EQ(result.getNumContacts(), 4u);
        for (const Contact &c : result.getContacts()) {
            CHECK_NEAR(c.penetrationDepth, 0.01, 1e-12);
            CHECK_NEAR(c.normal.z(), c.collisionObject1->getShapeFrame() == box.get() ? 1 : -1, 1e-12);
            CHECK_NEAR(std::abs(c.point.x() - 3), 0.5, 1e-12);
            CHECK_NEAR(c.point.z(), 0.495, 1e-12);
        }
    }
    const auto over = detector()->createCollisionGroup(ball.get(), plane.get());
    DistanceResult near;
    CHECK_NEAR(over->distance(DistanceOption(true, 0), &near), 0.3, 1e-12);
    CHECK(near.found());
    CHECK_NEAR(near.nearestPoint1.z(), 0.8, 1e-12);
    CHECK_NEAR(near.nearestPoint2.z(), 0.5, 1e-12);
    CHECK(!over->collide());
}

/// The least distance of several, its filter and its bound.
void test_distances() {
    const auto a = make_frame(std::make_shared<SphereShape>(1)),
               b = make_frame(std::make_shared<SphereShape>(1), {3, 0, 0});
    const auto c = make_frame(std::make_shared<SphereShape>(1), {0, 2.5, 0});
    const auto group = detector()->createCollisionGroup(a.get(), b.get(), c.get());
    DistanceResult near;
    CHECK_NEAR(group->distance(DistanceOption(true, 0), &near), 0.5, 1e-8);
    CHECK(near.shapeFrame1 == a.get() && near.shapeFrame2 == c.get());
    CHECK_NEAR(near.nearestPoint1.y(), 1, 1e-8);
    CHECK_NEAR(near.nearestPoint2.y(), 1.5, 1e-8);
    // Clamped at the bound; the depth where the bound lets it through.
    CHECK_NEAR(group->distance(DistanceOption(false, 0.7), &near), 0.7, 0);
    c->setTranslation({0, 1.5, 0});
    CHECK_EQ(group->distance(DistanceOption(false, 0), &near), 0.0);
    CHECK_NEAR(group->distance(DistanceOption(false, -10), &near), -0.5, 1e-8);
    CHECK_EQ(detector()->createCollisionGroup()->distance(), 0.0);
}

/// Rays: the first hit, all of them, in order.
void test_rays() {
    const auto far = make_frame(make_box(1, 1, 1), {5, 0, 0}),
               near = make_frame(std::make_shared<SphereShape>(1), {2, 0, 0});
    const auto group = detector()->createCollisionGroup(far.get(), near.get());
    RaycastResult result;
    CHECK(group->raycast({0, 0, 0}, {10, 0, 0}, RaycastOption(), &result));
    CHECK_EQ(result.mRayHits.size(), 1u);
    CHECK(result.mRayHits[0].mCollisionObject->getShapeFrame() == near.get());
    CHECK_NEAR(result.mRayHits[0].mFraction, 0.1, 1e-9);
    CHECK_NEAR(result.mRayHits[0].mPoint.x(), 1, 1e-8);
    CHECK_NEAR(result.mRayHits[0].mNormal.x(), -1, 1e-6);
    CHECK(group->raycast({0, 0, 0}, {10, 0, 0}, RaycastOption(true, true), &result));
    CHECK_EQ(result.mRayHits.size(), 2u);
    CHECK_NEAR(result.mRayHits[1].mFraction, 0.45, 1e-9);
    CHECK(!group->raycast({0, 0, 3}, {10, 0, 3}, RaycastOption(), &result));
    CHECK(!result.hasHit());
}

/// A mesh that is not convex is its triangles, and a shape that is not answered is refused by its name.
void test_meshes() {
    const auto roof = make_frame(make_mesh("OFF\n5 2 0\n-2 -2 0\n2 -2 0\n2 2 1\n-2 2 1\n0 0 0\n3 0 1 2\n3 0 2 3\n"));
    ovoid::adapters::shape_table table;
    CHECK_EQ(ovoid::dartsim::detail::translate(table, *roof->getShape()).parts.size(), 2u);
    const auto ball = make_frame(std::make_shared<SphereShape>(0.5), {0.7, -0.7, 0.8});
    const auto group = detector()->createCollisionGroup(roof.get(), ball.get());
    CollisionResult result;
    CHECK(group->collide(CollisionOption(true, 100), &result));
    // The slope is one in four; the ball's middle is 0.8 - 0.325 above it.
    const double depth = 0.5 - 0.475 * 4 / std::sqrt(17.0);
    CHECK_EQ(result.getNumContacts(), 1u);
    for (const Contact &c : result.getContacts()) CHECK_NEAR(c.penetrationDepth, depth, 5e-4);
    // A box on a level floor of eight triangles has its four corners alone, whichever comes first.
    const auto floor =
        make_frame(make_mesh("OFF\n9 8 0\n-2 -2 0\n0 -2 0\n2 -2 0\n-2 0 0\n0 0 0\n2 0 0\n-2 2 0\n0 2 0\n2 2 0\n"
                             "3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 3 4 7\n3 3 7 6\n3 4 5 8\n3 4 8 7\n"));
    const auto crate = make_frame(make_box(1, 1, 1), {0.1, 0.2, 0.499});
    for (const bool is_first : {true, false}) {
        const auto both = is_first ? detector()->createCollisionGroup(floor.get(), crate.get())
                                   : detector()->createCollisionGroup(crate.get(), floor.get());
        CollisionResult four;
        CHECK(both->collide(CollisionOption(true, 100), &four));
        CHECK_EQ(four.getNumContacts(), 4u);
        for (const Contact &c : four.getContacts()) {
            CHECK_NEAR(c.penetrationDepth, 0.001, 1e-9);
            CHECK_NEAR(c.normal.z(), is_first ? -1 : 1, 1e-12);
        }
    }
    std::string why;
    try {
        const auto line = make_frame(std::make_shared<LineSegmentShape>(Vector3d(0, 0, 0), Vector3d(1, 0, 0)));
        const auto refused = detector()->createCollisionGroup(line.get());
    } catch (const ovoid::error &e) {
        why = e.what();
    }
    CHECK(why.find("LineSegmentShape") != std::string::npos);
}

/// A shape that changes its size, and one that leaves.
void test_changes() {
    const auto box = std::make_shared<BoxShape>(Vector3d(1, 1, 1));
    const auto low = make_frame(box);
    auto high = make_frame(make_box(1, 1, 1), {0, 0, 1.2});
    const auto group = detector()->createCollisionGroup(low.get(), high.get());
    CHECK(!group->collide());
    box->setSize(Vector3d(1, 1, 2));
    CHECK(group->collide());
    high.reset();
    CHECK(!group->collide());
}

/// Boxes in DART's world, at rest after a second.
void test_world() {
    const auto world = dart::simulation::World::create();
    world->getConstraintSolver()->setCollisionDetector(CollisionDetector::getFactory()->create("ovoid"));
    const auto add = [&](const ShapePtr &shape, double z, bool is_free) {
        const auto skeleton = Skeleton::create("box" + std::to_string(world->getNumSkeletons()));
        Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
        at.translation().z() = z;
        BodyNode *node = nullptr;
        if (is_free) {
            const auto made = skeleton->createJointAndBodyNodePair<FreeJoint>();
            made.first->setTransform(at);
            node = made.second;
        } else {
            const auto made = skeleton->createJointAndBodyNodePair<WeldJoint>();
            made.first->setTransformFromParentBodyNode(at);
            node = made.second;
        }
        node->createShapeNodeWith<CollisionAspect, DynamicsAspect>(shape);
        node->setInertia(Inertia(1, 0, 0, 0, 0.1, 0.1, 0.1, 0, 0, 0));
        world->addSkeleton(skeleton);
        return node;
    };
    add(make_box(10, 10, 1), -0.5, false);
    std::vector<BodyNode *> boxes;
    for (int i = 0; i < 3; i++) boxes.push_back(add(make_box(1, 1, 1), 0.5 + i, true));
    for (int i = 0; i < 500; i++) world->step();
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(boxes[std::size_t(i)]->getTransform().translation().z(), 0.5 + i, 0.01);
        CHECK_NEAR(boxes[std::size_t(i)]->getTransform().translation().x(), 0, 1e-3);
        CHECK_LE(boxes[std::size_t(i)]->getLinearVelocity().norm(), 0.02);
    }
    CHECK_EQ(world->getLastCollisionResult().getNumContacts(), 12u);
}

} // namespace

int main() {
    test_name();
    test_boxes();
    test_poses();
    test_planes();
    test_distances();
    test_rays();
    test_meshes();
    test_changes();
    test_world();
    return check_end();
}
