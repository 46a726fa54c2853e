/// @file engine_bullet.cpp
/// Scenes in Bullet's dynamics world.
#include "scenes/scene.hpp"

#include <ovoid/bullet.hpp>

#include <btBulletDynamicsCommon.h>

#include <memory>

namespace scenes {

const double hull_margin = 0.01;
const char *const engine_name = "Bullet";
const int most_bodies = 1000;
const bool has_capsules = true;

namespace {

btVector3 to_bullet(ovoid_vec3 v) {
    return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}

btTransform to_bullet(const ovoid_pose &p) {
    const btQuaternion q(static_cast<btScalar>(p.rotation.x), static_cast<btScalar>(p.rotation.y),
                         static_cast<btScalar>(p.rotation.z), static_cast<btScalar>(p.rotation.w));
    return btTransform(q, to_bullet(p.position));
}

ovoid_vec3 from_bullet(const btVector3 &v) { return {v.x(), v.y(), v.z()}; }

ovoid_pose from_bullet(const btTransform &t) {
    const btQuaternion q = t.getRotation();
    return {from_bullet(t.getOrigin()), {q.w(), q.x(), q.y(), q.z()}};
}

class bullet_engine : public engine {
  public:
    bullet_engine(const scene &of, bool ours) : step_(of.step) {
        dispatcher_ = std::make_unique<btCollisionDispatcher>(&configuration_);
        if (ours) adapter_ = std::make_unique<ovoid::bullet::adapter>(*dispatcher_);
        world_ = std::make_unique<btDiscreteDynamicsWorld>(dispatcher_.get(), &broad_, &solver_, &configuration_);
        world_->setGravity({0, 0, static_cast<btScalar>(-9.81)});
        world_->getSolverInfo().m_numIterations = 30;
        for (const part &p : of.parts) parts_.push_back(make_part(p, hull_margin * of.size));
        for (const body &b : of.bodies) add(b);
    }
    ~bullet_engine() override {
        for (const auto &axle : axles_) world_->removeConstraint(axle.get());
        for (const auto &b : bodies_) world_->removeRigidBody(b.get());
    }

    void step() override { world_->stepSimulation(static_cast<btScalar>(step_), 0); }

    void read_state(state &to) const override {
        to = {};
        for (const auto &b : bodies_) {
            to.poses.push_back(from_bullet(b->getCenterOfMassTransform()));
            to.velocities.push_back(from_bullet(b->getLinearVelocity()));
            to.spins.push_back(from_bullet(b->getAngularVelocity()));
        }
    }

    void read_touches(std::vector<touch> &to) const override {
        to.clear();
        for (int i = 0; i < dispatcher_->getNumManifolds(); i++) {
            const btPersistentManifold *m = dispatcher_->getManifoldByIndexInternal(i);
            for (int k = 0; k < m->getNumContacts(); k++) {
                const btManifoldPoint &p = m->getContactPoint(k);
                // Bullet's normal is that of B, towards A.
                to.push_back(
                    {number(m->getBody0()), number(m->getBody1()), from_bullet(-p.m_normalWorldOnB), p.getDistance()});
            }
        }
    }

  private:
    static std::uint32_t number(const btCollisionObject *of) { return static_cast<std::uint32_t>(of->getUserIndex()); }

    static std::unique_ptr<btCollisionShape> make_part(const part &p, double margin) {
        const auto x = static_cast<btScalar>(p.size.x), y = static_cast<btScalar>(p.size.y);
        switch (p.is) {
        case kind::box: return std::make_unique<btBoxShape>(to_bullet(p.size));
        case kind::sphere: return std::make_unique<btSphereShape>(x);
        case kind::capsule: return std::make_unique<btCapsuleShapeZ>(x, 2 * y);
        case kind::cylinder: return std::make_unique<btCylinderShapeZ>(btVector3(x, x, y));
        case kind::hull: break;
        }
        auto made = std::make_unique<btConvexHullShape>();
        for (const ovoid_vec3 &v : p.points) made->addPoint(to_bullet(v), false);
        made->recalcLocalAabb();
        made->setMargin(static_cast<btScalar>(margin));
        made->initializePolyhedralFeatures();
        return made;
    }

    btCollisionShape *shape_of(const body &b) {
        if (b.parts.size() == 1) return parts_[b.parts[0].part].get();
        auto made = std::make_unique<btCompoundShape>();
        for (const placed &p : b.parts) made->addChildShape(to_bullet(p.pose), parts_[p.part].get());
        compounds_.push_back(std::move(made));
        return compounds_.back().get();
    }

    void add(const body &b) {
        const bool fixed = b.moves == motion::fixed;
        btRigidBody::btRigidBodyConstructionInfo info(fixed ? 0 : static_cast<btScalar>(b.mass), nullptr, shape_of(b),
                                                      fixed ? btVector3(0, 0, 0) : to_bullet(b.inertia));
        info.m_startWorldTransform = to_bullet(b.pose);
        info.m_friction = static_cast<btScalar>(b.friction);
        info.m_linearDamping = info.m_angularDamping = 0;
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        btRigidBody &made = *bodies_.back();
        made.setUserIndex(static_cast<int>(bodies_.size() - 1));
        made.setActivationState(DISABLE_DEACTIVATION);
        made.setLinearVelocity(to_bullet(b.velocity));
        made.setAngularVelocity(to_bullet(b.spin));
        world_->addRigidBody(&made);
        if (b.moves != motion::axle) return;
        axles_.push_back(std::make_unique<btHingeConstraint>(made, btVector3(0, 0, 0), btVector3(0, 0, 1)));
        world_->addConstraint(axles_.back().get());
    }

    double step_;
    btDefaultCollisionConfiguration configuration_;
    btDbvtBroadphase broad_;
    btSequentialImpulseConstraintSolver solver_;
    std::vector<std::unique_ptr<btCollisionShape>> parts_;
    std::vector<std::unique_ptr<btCompoundShape>> compounds_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<std::unique_ptr<btHingeConstraint>> axles_;
    std::unique_ptr<ovoid::bullet::adapter> adapter_;
    std::unique_ptr<btCollisionDispatcher> dispatcher_;
    std::unique_ptr<btDiscreteDynamicsWorld> world_;
};

} // namespace

engine *create_engine(const scene &from, bool ours) { return new bullet_engine(from, ours); }

} // namespace scenes
