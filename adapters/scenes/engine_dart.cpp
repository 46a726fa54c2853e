/// @file engine_dart.cpp
/// Scenes in DART's world. Beside its own detector for convex shapes, FCL's with its primitives and meshes.
#include "scenes/scene.hpp"

#include <ovoid/dart.hpp>

#include <assimp/cimport.h>
#include <dart/collision/fcl/fcl.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

namespace scenes {

const double hull_margin = 0;
const char *const engine_name = "DART with FCL";
const int most_bodies = 48;
const bool has_capsules = false;

namespace {

Eigen::Isometry3d to_dart(const ovoid_pose &p) {
    Eigen::Isometry3d made = Eigen::Isometry3d::Identity();
    made.translation() = Eigen::Vector3d(p.position.x, p.position.y, p.position.z);
    made.linear() =
        Eigen::Quaterniond(p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z).normalized().toRotationMatrix();
    return made;
}

ovoid_vec3 from_dart(const Eigen::Vector3d &v) { return {v.x(), v.y(), v.z()}; }

/// A hull's surface as Assimp has it, which DART's meshes are: from an OFF file in memory.
dart::dynamics::ShapePtr make_mesh(const part &of) {
    const ovoid::shape hull = make_shape(of, 0);
    const ovoid_polytope p = hull.polytope();
    std::string off = "OFF\n" + std::to_string(p.vertex_count) + " " + std::to_string(p.triangle_count) + " 0\n";
    char line[200];
    for (std::uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * i;
        off.append(line,
                   static_cast<std::size_t>(std::snprintf(line, sizeof line, "%.9g %.9g %.9g\n", p.origin.x + v[0],
                                                          p.origin.y + v[1], p.origin.z + v[2])));
    }
    for (std::uint32_t i = 0; i < p.triangle_count; i++) {
        const std::uint32_t *t = p.triangles + 3 * i;
        off.append(line, static_cast<std::size_t>(std::snprintf(line, sizeof line, "3 %u %u %u\n", t[0], t[1], t[2])));
    }
    const aiScene *scene = aiImportFileFromMemory(off.data(), static_cast<unsigned>(off.size()), 0, "off");
    if (!scene) throw std::runtime_error(aiGetErrorString());
    return std::make_shared<dart::dynamics::MeshShape>(Eigen::Vector3d::Ones(), scene);
}

dart::dynamics::ShapePtr make_part(const part &p) {
    using namespace dart::dynamics;
    switch (p.is) {
    case kind::box: return std::make_shared<BoxShape>(2 * Eigen::Vector3d(p.size.x, p.size.y, p.size.z));
    case kind::sphere: return std::make_shared<SphereShape>(p.size.x);
    case kind::capsule: return std::make_shared<CapsuleShape>(p.size.x, 2 * p.size.y);
    case kind::cylinder: return std::make_shared<CylinderShape>(p.size.x, 2 * p.size.y);
    case kind::hull: break;
    }
    return make_mesh(p);
}

class dart_engine : public engine {
  public:
    dart_engine(const scene &of, bool ours) : world_(dart::simulation::World::create()) {
        world_->setTimeStep(of.step);
        world_->setGravity(Eigen::Vector3d(0, 0, -9.81));
        auto *solver = world_->getConstraintSolver();
        if (ours) {
            solver->setCollisionDetector(ovoid::dartsim::detector::create());
        } else {
            auto fcl = dart::collision::FCLCollisionDetector::create();
            solver->setCollisionDetector(fcl);
        }
        solver->getCollisionOption().maxNumContacts = 100000;
        for (const part &p : of.parts) parts_.push_back(make_part(p));
        for (const body &b : of.bodies) add(b);
        for (std::size_t i = 0; i < nodes_.size(); i++) numbers_[nodes_[i]] = static_cast<std::uint32_t>(i);
    }

    void step() override { world_->step(); }

    void read_state(state &to) const override {
        to = {};
        for (const dart::dynamics::BodyNode *node : nodes_) {
            const Eigen::Isometry3d &at = node->getTransform();
            const Eigen::Quaterniond q(at.linear());
            to.poses.push_back({from_dart(at.translation()), {q.w(), q.x(), q.y(), q.z()}});
            to.velocities.push_back(from_dart(node->getCOMLinearVelocity()));
            to.spins.push_back(from_dart(node->getAngularVelocity()));
        }
    }

    void read_touches(std::vector<touch> &to) const override {
        to.clear();
        for (const dart::collision::Contact &c : world_->getLastCollisionResult().getContacts())
            to.push_back(
                {number(c.collisionObject1), number(c.collisionObject2), from_dart(-c.normal), -c.penetrationDepth});
    }

  private:
    std::uint32_t number(const dart::collision::CollisionObject *of) const {
        return numbers_.at(of->getShapeFrame()->asShapeNode()->getBodyNodePtr().get());
    }

    void add(const body &b) {
        const auto skeleton = dart::dynamics::Skeleton::create("body" + std::to_string(nodes_.size()));
        dart::dynamics::BodyNode *node = nullptr;
        if (b.moves == motion::axle) {
            const auto made = skeleton->createJointAndBodyNodePair<dart::dynamics::RevoluteJoint>();
            made.first->setAxis(Eigen::Vector3d::UnitZ());
            made.first->setTransformFromParentBodyNode(to_dart(b.pose));
            made.first->setVelocity(0, b.spin.z);
            node = made.second;
        } else if (b.moves == motion::free) {
            const auto made = skeleton->createJointAndBodyNodePair<dart::dynamics::FreeJoint>();
            made.first->setTransform(to_dart(b.pose));
            made.first->setLinearVelocity(Eigen::Vector3d(b.velocity.x, b.velocity.y, b.velocity.z));
            made.first->setAngularVelocity(Eigen::Vector3d(b.spin.x, b.spin.y, b.spin.z));
            node = made.second;
        } else {
            const auto made = skeleton->createJointAndBodyNodePair<dart::dynamics::WeldJoint>();
            made.first->setTransformFromParentBodyNode(to_dart(b.pose));
            node = made.second;
        }
        for (const placed &p : b.parts) {
            auto *shape = node->createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(
                parts_[p.part]);
            shape->setRelativeTransform(to_dart(p.pose));
            shape->getDynamicsAspect()->setFrictionCoeff(b.friction);
        }
        node->setInertia(dart::dynamics::Inertia(b.mass, 0, 0, 0, b.inertia.x, b.inertia.y, b.inertia.z, 0, 0, 0));
        skeleton->setMobile(b.moves != motion::fixed);
        world_->addSkeleton(skeleton);
        nodes_.push_back(node);
    }

    dart::simulation::WorldPtr world_;
    std::vector<dart::dynamics::ShapePtr> parts_;
    std::vector<const dart::dynamics::BodyNode *> nodes_;
    std::map<const dart::dynamics::BodyNode *, std::uint32_t> numbers_;
};

} // namespace

engine *create_engine(const scene &from, bool ours) { return new dart_engine(from, ours); }

} // namespace scenes
