// <ovoid/bullet.hpp> in Bullet itself, in both precisions. Sources of truth: Bullet's own support functions for the
// translations, closed forms for contacts, ovoid's proven brackets for depths of random hulls, and physics for what
// rests.
#include "check.h"

#include <ovoid/bullet.hpp>

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletDynamicsCommon.h>

#include <array>
#include <functional>

namespace {

/// Of lengths near one: rounding of Bullet's numbers, which are float or double.
const double eps = sizeof(btScalar) == 4 ? 1e-5 : 1e-12;

/// A world with ovoid's algorithms.
struct bullet_world {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    ovoid::bullet::adapter adapter;
    btDbvtBroadphase broad;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broad, &solver, &configuration};
    std::vector<std::unique_ptr<btRigidBody>> bodies;

    explicit bullet_world(const ovoid::bullet::settings &chosen = {}) : adapter(dispatcher, chosen) {
        world.setGravity({0, 0, btScalar(-9.81)});
    }
    ~bullet_world() {
        for (const auto &b : bodies) world.removeRigidBody(b.get());
    }
    btRigidBody &add(btCollisionShape &shape, const btTransform &at, double mass) {
        btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, &shape, {1, 1, 1});
        info.m_startWorldTransform = at;
        bodies.push_back(std::make_unique<btRigidBody>(info));
        bodies.back()->setActivationState(DISABLE_DEACTIVATION);
        world.addRigidBody(bodies.back().get());
        return *bodies.back();
    }
    btRigidBody &add(btCollisionShape &shape, double x, double y, double z, double mass = 1) {
        return add(shape, btTransform(btQuaternion::getIdentity(), {btScalar(x), btScalar(y), btScalar(z)}), mass);
    }
    /// All contact points, as (distance, normal on B, point on B).
    std::vector<btManifoldPoint> detect() {
        world.performDiscreteCollisionDetection();
        return points();
    }
    std::vector<btManifoldPoint> points() const {
        std::vector<btManifoldPoint> all;
        for (int i = 0; i < dispatcher.getNumManifolds(); i++) {
            const btPersistentManifold &m = *dispatcher.getManifoldByIndexInternal(i);
            for (int k = 0; k < m.getNumContacts(); k++) all.push_back(m.getContactPoint(k));
        }
        return all;
    }
};

btVector3 random_direction(std::uint64_t *seed) {
    btVector3 v(btScalar(random_normal(seed)), btScalar(random_normal(seed)), btScalar(random_normal(seed)));
    return v.normalized();
}

btTransform random_transform(std::uint64_t *seed, double reach) {
    const btQuaternion q(random_direction(seed), btScalar(random_uniform(seed, -3, 3)));
    return btTransform(q, random_direction(seed) * btScalar(random_uniform(seed, 0, reach)));
}

btConvexHullShape random_hull(std::uint64_t *seed, int points, double margin) {
    btConvexHullShape made;
    for (int i = 0; i < points; i++) made.addPoint(random_direction(seed) * btScalar(0.5), false);
    made.recalcLocalAabb();
    made.setMargin(btScalar(margin));
    return made;
}

/// The support of a translation along a unit direction of Bullet's frame.
double compute_support(const ovoid::bullet::translation &of, const btVector3 &along) {
    const ovoid::shape &shape = of.made->made;
    const ovoid_pose local = of.has_pose ? ovoid_pose(of.local) : ovoid_pose_make_identity();
    const ovoid_vec3 origin = shape.polytope().origin;
    const auto xyz = shape.vertices();
    double most = -1e300;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
        const ovoid_vec3 v = {origin.x + xyz[i], origin.y + xyz[i + 1], origin.z + xyz[i + 2]};
        const ovoid_vec3 p = ovoid_pose_compute_point(&local, v);
        most = std::max(most, p.x * along.x() + p.y * along.y() + p.z * along.z());
    }
    return most + shape.radius();
}

/// A shape's support is Bullet's, with the margin; of a round one less by at most the allowance. Bullet rounds the rims
/// of a cylinder by its margin, inside of its size; ovoid does not.
void check_translation(const btConvexShape &of) {
    ovoid::adapters::shape_table table;
    const ovoid::bullet::translation ours = ovoid::bullet::detail::translate(table, of);
    if (!CHECK(ours.made != nullptr)) return;
    const double allowed = ours.made->made.allowance().outside;
    const bool is_cylinder = of.getShapeType() == CYLINDER_SHAPE_PROXYTYPE;
    const double rim = is_cylinder ? (std::sqrt(2.0) - 1) * double(of.getMargin()) : 0;
    for (std::uint64_t seed = 1; seed <= 100; seed++) {
        check_seed = seed;
        const btVector3 n = random_direction(&check_seed);
        const double theirs = double(of.localGetSupportingVertex(n).dot(n)), mine = compute_support(ours, n);
        CHECK_LE(theirs - mine, allowed + eps);
        CHECK_LE(mine - theirs, rim + eps);
    }
    CHECK(ovoid::bullet::detail::translate(table, of).made == ours.made);
}

void test_translations() {
    const btVector3 half(btScalar(0.3), btScalar(0.2), btScalar(0.5));
    check_translation(btBoxShape(half));
    check_translation(btSphereShape(btScalar(0.4)));
    check_translation(btCapsuleShape(btScalar(0.2), btScalar(0.7)));
    check_translation(btCapsuleShapeX(btScalar(0.2), btScalar(0.7)));
    check_translation(btCapsuleShapeZ(btScalar(0.2), btScalar(0.7)));
    const btScalar r = btScalar(0.3), h = btScalar(0.6);
    check_translation(btCylinderShape({r, h, r}));
    check_translation(btCylinderShapeX({h, r, r}));
    check_translation(btCylinderShapeZ({r, r, h}));
    btBU_Simplex1to4 simplex({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    check_translation(simplex);
    btTriangleShape triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 1});
    triangle.setMargin(btScalar(0.01));
    check_translation(triangle);
    std::uint64_t seed = 3;
    btConvexHullShape hull = random_hull(&seed, 20, 0.04);
    check_translation(hull);
    hull.setLocalScaling({2, 1, btScalar(0.5)});
    check_translation(hull);
    const btVector3 places[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
    const btScalar radii[] = {btScalar(0.2), btScalar(0.2), btScalar(0.2)};
    check_translation(btMultiSphereShape(places, radii, 3));
    btTriangleMesh mesh;
    mesh.addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.addTriangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    check_translation(btConvexTriangleMeshShape(&mesh));
}

/// Cones: Bullet's own support is of the sharp cone, its margin is added beyond.
void test_cones() {
    const btScalar r = btScalar(0.3), h = btScalar(0.8);
    const btConeShape y(r, h);
    const btConeShapeX x(r, h);
    const btConeShapeZ z(r, h);
    for (const btConeShape *of : {&y, static_cast<const btConeShape *>(&x), static_cast<const btConeShape *>(&z)})
        check_translation(*of);
}

/// Four corners of a box 0.01 deep in another, in either order of the bodies.
void test_boxes() {
    for (const bool is_below : {false, true}) {
        bullet_world w;
        btBoxShape small({btScalar(0.5), btScalar(0.5), btScalar(0.5)}), floor({5, 5, 1});
        if (is_below) w.add(floor, 0, 0, -1, 0);
        w.add(small, 0, 0, 0.49);
        if (!is_below) w.add(floor, 0, 0, -1, 0);
        const std::vector<btManifoldPoint> found = w.detect();
        CHECK_EQ(found.size(), 4u);
        for (const btManifoldPoint &p : found) {
            CHECK_NEAR(p.getDistance(), -0.01, eps);
            CHECK_NEAR(std::abs(p.m_normalWorldOnB.z()), 1, eps);
            CHECK_NEAR(std::abs(p.getPositionWorldOnB().x()), 0.5, eps);
            CHECK_NEAR(std::abs(p.getPositionWorldOnB().y()), 0.5, eps);
            // B is where the normal comes from.
            const bool b_is_low = p.m_normalWorldOnB.z() > 0;
            CHECK_NEAR(p.getPositionWorldOnB().z(), b_is_low ? 0 : -0.01, eps);
            CHECK_NEAR(p.getPositionWorldOnA().z(), b_is_low ? -0.01 : 0, eps);
        }
    }
}

/// Random hulls, with margins: no point is deeper than the proven depth by more than the tolerance.
void test_depths() {
    for (std::uint64_t number = 1; number <= 300; number++) {
        std::uint64_t seed = check_seed = number;
        bullet_world w;
        btConvexHullShape a = random_hull(&seed, 24, 0.02), b = random_hull(&seed, 12, 0.01);
        const btTransform at_a = random_transform(&seed, 0.5), at_b = random_transform(&seed, 0.5);
        w.add(a, at_a, 1);
        w.add(b, at_b, 1);
        const std::vector<btManifoldPoint> found = w.detect();
        const ovoid::bullet::translation x = w.adapter.translate(a), y = w.adapter.translate(b);
        const ovoid_pair pair = {x.made->made.get(), y.made->made.get(), x.place(at_a), y.place(at_b)};
        const ovoid_answer exact = ovoid_depth(&pair, nullptr, nullptr, nullptr);
        double least = 1e300;
        for (const btManifoldPoint &p : found) least = std::min(least, double(p.getDistance()));
        if (exact.upper < 0) CHECK(!found.empty());
        if (found.empty()) continue;
        CHECK_LE(exact.lower, least + 5e-4 * 0.5 + eps);
        // The points are those of the manifold, and lie where their distance says.
        ovoid_manifold_options options = {};
        options.margin = 0.02, options.tolerance = 5e-4 * 0.5, options.keep = 5e-3 * 0.5;
        const ovoid_manifold alone = ovoid_manifold_find(&pair, &options, nullptr);
        if (exact.upper < 0) CHECK_EQ(found.size(), alone.count);
        for (const btManifoldPoint &p : found)
            CHECK_NEAR((p.getPositionWorldOnA() - p.getPositionWorldOnB()).dot(p.m_normalWorldOnB), p.getDistance(),
                       10 * eps);
    }
}

/// A box that is apart by half of the threshold has points, and none where only bodies that touch are asked for.
void test_margin() {
    btBoxShape box({btScalar(0.5), btScalar(0.5), btScalar(0.5)});
    const double gap = 0.5 * double(box.getContactBreakingThreshold(gContactBreakingThreshold));
    for (const double margin : {1.0, 0.4, 0.0})
        for (const double apart : {gap, -gap}) {
            ovoid::bullet::settings chosen;
            chosen.margin = margin;
            bullet_world w(chosen);
            w.add(box, 0, 0, 0, 0);
            w.add(box, 0, 0, 1 + apart);
            CHECK_EQ(w.detect().size(), apart < 0 || margin == 1 ? 4u : 0u);
        }
}

/// Points at rest keep their impulses and grow old; a body that leaves has none.
void test_rest() {
    bullet_world w;
    btBoxShape box({btScalar(0.5), btScalar(0.5), btScalar(0.5)}), floor({5, 5, 1});
    w.add(floor, 0, 0, -1, 0);
    for (int i = 0; i < 5; i++) w.add(box, 0, 0, 0.5 + i);
    for (int i = 0; i < 240; i++) w.world.stepSimulation(btScalar(1.0 / 240), 0);
    const std::vector<btManifoldPoint> found = w.points();
    CHECK_EQ(found.size(), 20u);
    double weight = 0;
    for (const btManifoldPoint &p : found) {
        CHECK_LE(200, p.getLifeTime());
        CHECK_LE(0, p.getAppliedImpulse());
        weight += double(p.getAppliedImpulse()) * 240;
    }
    // The five contacts carry five, four, three, two and one box.
    CHECK_NEAR(weight, 15 * 9.81, 0.05 * 15 * 9.81);
    for (int i = 1; i <= 5; i++) {
        CHECK_NEAR(w.bodies[std::size_t(i)]->getCenterOfMassPosition().z(), i - 0.5, 0.01);
        CHECK_LE(w.bodies[std::size_t(i)]->getLinearVelocity().length(), 0.02);
    }
    w.bodies.back()->setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), {0, 0, 50}));
    CHECK_EQ(w.detect().size(), 16u);
}

/// The parts of compounds, and the triangles of a mesh, carry a box.
void test_parts() {
    btBoxShape box({btScalar(0.5), btScalar(0.5), btScalar(0.5)});
    btCompoundShape table;
    for (const int side : {-1, 1})
        table.addChildShape(btTransform(btQuaternion::getIdentity(), {btScalar(2 * side), 0, 0}), &box);
    btTriangleMesh mesh;
    const btVector3 corners[] = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
    mesh.addTriangle(corners[0], corners[1], corners[2]);
    mesh.addTriangle(corners[0], corners[2], corners[3]);
    btBvhTriangleMeshShape ground(&mesh, true);
    ground.setMargin(0);
    bullet_world w;
    w.add(ground, 0, 0, 0, 0);
    w.add(table, 0, 0, 0.499);
    const std::vector<btManifoldPoint> found = w.detect();
    CHECK_LE(8, found.size());
    for (const btManifoldPoint &p : found) {
        CHECK_NEAR(p.getDistance(), -0.001, 1e-5);
        CHECK_NEAR(std::abs(p.m_normalWorldOnB.z()), 1, 1e-5);
        CHECK(p.m_index0 >= 0 || p.m_index1 >= 0);
    }
    for (int i = 0; i < 240; i++) w.world.stepSimulation(btScalar(1.0 / 240), 0);
    CHECK_NEAR(w.bodies[1]->getCenterOfMassPosition().z(), 0.5, 0.01);
    CHECK_NEAR(w.bodies[1]->getCenterOfMassPosition().x(), 0, 0.01);
    // A triangle that is left has no contact in the same step, though the mesh's box is still met.
    btTriangleMesh steps;
    steps.addTriangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    steps.addTriangle({9, -1, 5}, {11, -1, 5}, {10, 1, 5});
    btBvhTriangleMeshShape stairs(&steps, true);
    bullet_world other;
    other.add(stairs, 0, 0, 0, 0);
    other.add(box, 0, 0, 0.49);
    CHECK_LE(1, other.detect().size());
    other.bodies[1]->setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), {5, 0, 2}));
    CHECK_EQ(other.detect().size(), 0u);
    w.bodies[1]->setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), {0, 0, 50}));
    CHECK_EQ(w.detect().size(), 0u);
    CHECK_EQ(w.dispatcher.getNumManifolds(), 0);
}

/// The triangles of a terrain carry a box; where they are left they have no contact, though the terrain's box is met.
void test_terrain() {
    const std::array<float, 25> heights = {};
    btHeightfieldTerrainShape terrain(5, 5, heights.data(), btScalar(-5), btScalar(5), 2, false);
    terrain.setMargin(0);
    btBoxShape box({btScalar(0.5), btScalar(0.5), btScalar(0.5)});
    bullet_world w;
    w.add(terrain, 0, 0, 0, 0);
    w.add(box, 0.2, 0.1, 0.499);
    const std::vector<btManifoldPoint> found = w.detect();
    CHECK_LE(4, found.size());
    for (const btManifoldPoint &p : found) {
        CHECK_NEAR(p.getDistance(), -0.001, 1e-5);
        CHECK_NEAR(std::abs(p.m_normalWorldOnB.z()), 1, 1e-5);
    }
    w.bodies[1]->setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), {0, 0, 3}));
    CHECK_EQ(w.detect().size(), 0u);
}

/// A level floor of many triangles.
struct triangle_floor {
    btTriangleMesh mesh;
    std::unique_ptr<btBvhTriangleMeshShape> shape;
    explicit triangle_floor(double margin) {
        const auto at = [](int i, int k) { return btVector3(btScalar(0.4 * i - 4), btScalar(0.4 * k - 4), 0); };
        for (int i = 0; i < 20; i++)
            for (int k = 0; k < 20; k++) {
                mesh.addTriangle(at(i, k), at(i + 1, k), at(i + 1, k + 1));
                mesh.addTriangle(at(i, k), at(i + 1, k + 1), at(i, k + 1));
            }
        shape = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
        shape->setMargin(btScalar(margin));
    }
};

/// A box that slides over a floor of triangles without friction keeps its velocity, and nothing throws it: no edge
/// inside of the floor has a contact. A ball that rolls does not leave its line either.
void test_slide() {
    for (const double margin : {0.0, 0.04}) {
        const triangle_floor floor(margin);
        bullet_world w;
        btBoxShape box({btScalar(0.3), btScalar(0.4), btScalar(0.2)});
        w.add(*floor.shape, 0, 0, 0, 0).setFriction(0);
        btRigidBody &slider = w.add(box, -2.5, 0.1, 0.2 + margin - 1e-4);
        slider.setFriction(0);
        slider.setLinearVelocity({2, btScalar(0.3), 0});
        double lift = 0, turn = 0;
        for (int i = 0; i < 480; i++) {
            w.world.stepSimulation(btScalar(1.0 / 240), 0);
            lift = std::max(lift, std::abs(double(slider.getLinearVelocity().z())));
            turn = std::max(turn, double(slider.getAngularVelocity().length()));
            CHECK_EQ(w.dispatcher.getNumManifolds(), 1);
            for (const btManifoldPoint &p : w.points()) CHECK_NEAR(p.m_normalWorldOnB.z(), -1, 2 * eps);
        }
        CHECK_NEAR(slider.getLinearVelocity().x(), 2, 1e4 * eps * eps + 1e-4);
        CHECK_NEAR(slider.getLinearVelocity().y(), 0.3, 1e-4);
        CHECK_NEAR(slider.getCenterOfMassPosition().z(), 0.2 + margin, 1e-3);
        CHECK_LE(lift, 0.01);
        CHECK_LE(turn, 0.01);
    }
    const triangle_floor floor(0);
    bullet_world w;
    btSphereShape ball(btScalar(0.3));
    w.add(*floor.shape, 0, 0, 0, 0);
    btRigidBody &roller = w.add(ball, -2.5, 0.13, 0.3);
    roller.setLinearVelocity({2, 0, 0});
    roller.setAngularVelocity({0, btScalar(2 / 0.3), 0});
    double lift = 0;
    for (int i = 0; i < 480; i++) {
        w.world.stepSimulation(btScalar(1.0 / 240), 0);
        lift = std::max(lift, std::abs(double(roller.getLinearVelocity().z())));
    }
    CHECK_NEAR(roller.getLinearVelocity().x(), 2, 0.02);
    CHECK_NEAR(roller.getCenterOfMassPosition().y(), 0.13, 1e-4);
    CHECK_LE(lift, 0.01);
}

/// A mesh that is changed in place is taken anew where a shape meets what changed.
void test_changed_mesh() {
    triangle_floor floor(0);
    bullet_world w;
    btBoxShape box({btScalar(0.3), btScalar(0.4), btScalar(0.2)});
    w.add(*floor.shape, 0, 0, 0, 0);
    w.add(box, 0, 0.1, 0.199);
    CHECK_EQ(w.detect().size(), 4u);
    unsigned char *base = nullptr, *indices = nullptr;
    int points = 0, stride = 0, index_stride = 0, faces = 0;
    PHY_ScalarType type, index_type;
    floor.mesh.getLockedVertexIndexBase(&base, points, type, stride, &indices, index_stride, faces, index_type, 0);
    for (int i = 0; i < points; i++) reinterpret_cast<btScalar *>(base + i * stride)[2] = btScalar(-0.01);
    floor.mesh.unLockVertexBase(0);
    floor.shape->refitTree({-9, -9, -9}, {9, 9, 9});
    w.bodies[1]->setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, btScalar(0.1), btScalar(0.188)}));
    const std::vector<btManifoldPoint> found = w.detect();
    CHECK_EQ(found.size(), 4u);
    for (const btManifoldPoint &p : found) CHECK_NEAR(p.getDistance(), -0.002, 1e-6);
}

/// A query of Bullet's users: the distance of two bodies by contactPairTest, in closed form.
void test_queries() {
    struct taker : btCollisionWorld::ContactResultCallback {
        double least = 1e300;
        btScalar addSingleResult(btManifoldPoint &p, const btCollisionObjectWrapper *, int, int,
                                 const btCollisionObjectWrapper *, int, int) override {
            least = std::min(least, double(p.getDistance()));
            return 0;
        }
    };
    bullet_world w;
    btBoxShape box({btScalar(0.5), btScalar(0.5), btScalar(0.5)});
    btSphereShape ball(btScalar(0.25));
    btRigidBody &a = w.add(box, 0, 0, 0), &b = w.add(ball, 1.5, 0, 0);
    taker near;
    near.m_closestDistanceThreshold = 1;
    w.world.contactPairTest(&a, &b, near);
    CHECK_NEAR(near.least, 0.75, 2 * eps);
    taker far;
    far.m_closestDistanceThreshold = btScalar(0.5);
    w.world.contactPairTest(&a, &b, far);
    CHECK(far.least == 1e300);
}

/// What is not translated is answered by Bullet.
void test_others() {
    bullet_world w;
    const btVector3 places[] = {{0, 0, 0}, {1, 0, 0}};
    const btScalar radii[] = {btScalar(0.2), btScalar(0.3)};
    btMultiSphereShape spheres(places, radii, 2);
    CHECK(w.adapter.translate(spheres).made == nullptr);
    btBoxShape box({btScalar(0.5), btScalar(0.5), btScalar(0.5)});
    w.add(box, 0, 0, 0);
    w.add(spheres, 0, 0, 0.65);
    CHECK_LE(1, w.detect().size());
}

/// A body at NaN has no contact, and is counted.
void test_refused() {
    bullet_world w;
    btBoxShape box({btScalar(0.5), btScalar(0.5), btScalar(0.5)});
    w.add(box, 0, 0, 0);
    btRigidBody &lost = w.add(box, 0, 0, 0.9);
    CHECK_EQ(w.detect().size(), 4u);
    CHECK_EQ(w.adapter.refused_count(), 0u);
    btTransform nowhere = lost.getWorldTransform();
    nowhere.getOrigin().setX(std::numeric_limits<btScalar>::quiet_NaN());
    lost.setWorldTransform(nowhere);
    const btCollisionObjectWrapper a(nullptr, &box, w.bodies[0].get(), w.bodies[0]->getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper b(nullptr, &box, &lost, lost.getWorldTransform(), -1, -1);
    btManifoldResult to(&a, &b);
    btCollisionAlgorithm *pair = w.dispatcher.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    pair->processCollision(&a, &b, w.world.getDispatchInfo(), &to);
    CHECK_EQ(to.getPersistentManifold()->getNumContacts(), 0);
    CHECK_EQ(w.adapter.refused_count(), 1u);
    pair->~btCollisionAlgorithm();
    w.dispatcher.freeCollisionAlgorithm(pair);
}

/// Shapes are shared, kept, and dropped.
void test_table() {
    bullet_world w;
    btBoxShape box({1, 1, 1}), same({1, 1, 1}), other({1, 1, 2});
    CHECK(w.adapter.translate(box).made == w.adapter.translate(same).made);
    CHECK(w.adapter.translate(box).made != w.adapter.translate(other).made);
    CHECK_EQ(w.adapter.shape_count(), 2u);
    const ovoid::bullet::translation held = w.adapter.translate(other);
    w.adapter.drop_unused();
    CHECK_EQ(w.adapter.shape_count(), 1u);
}

/// The depth alone, of random hulls that overlap: Bullet's words for it, against the bracket.
void test_solver() {
    ovoid::bullet::depth_solver solver;
    btVoronoiSimplexSolver simplex;
    int overlaps = 0;
    for (std::uint64_t number = 1; number <= 200; number++) {
        std::uint64_t seed = check_seed = number;
        const btConvexHullShape a = random_hull(&seed, 16, 0.02), b = random_hull(&seed, 16, 0.02);
        const btTransform at_a = random_transform(&seed, 0.5), at_b = random_transform(&seed, 0.8);
        ovoid::adapters::shape_table table;
        const ovoid::bullet::translation x = ovoid::bullet::detail::translate(table, a);
        const ovoid::bullet::translation y = ovoid::bullet::detail::translate(table, b);
        const ovoid_pair pair = {x.made->made.get(), y.made->made.get(), x.place(at_a), y.place(at_b)};
        const ovoid_answer exact = ovoid_depth(&pair, nullptr, nullptr, nullptr);
        btVector3 axis, p, q;
        const bool found = solver.calcPenDepth(simplex, &a, &b, at_a, at_b, axis, p, q, nullptr);
        CHECK_EQ(found, exact.upper < 0);
        overlaps += found;
        const double length = double((p - q).length()), margins = found ? 0 : 0.04;
        CHECK_NEAR(length - margins, std::abs(exact.lower), 1e-8 + eps);
        // From B to A where they are apart, and where they overlap the way out of B.
        CHECK_NEAR((p - q).dot(axis), found ? -length : length, 1e-8 + 10 * eps);
    }
    CHECK_LE(20, overlaps);
}

} // namespace

int main() {
    test_translations();
    test_cones();
    test_boxes();
    test_margin();
    test_depths();
    test_rest();
    test_parts();
    test_terrain();
    test_slide();
    test_changed_mesh();
    test_queries();
    test_others();
    test_refused();
    test_table();
    test_solver();
    return check_end();
}
