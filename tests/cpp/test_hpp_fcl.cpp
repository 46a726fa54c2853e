// <ovoid/fcl.hpp> for doubles. Pairs of shapes against brackets of ovoid's C functions, of shapes made here; planes
// against boxes of ovoid that stand for them; lists of triangles against all pairs of them; meshes and round shapes
// against FCL, to what FCL's own tolerance allows; motions against closed forms and FCL's own motions.
#include "fcl_zoo.hpp"

/// FCL, with a count of the calls that are left to it.
struct counting_fcl {
    static inline long calls = 0;
    template <class S, class... T> static std::size_t collide(T &&...arguments) {
        calls++;
        return fcl::collide<S>(std::forward<T>(arguments)...);
    }
    template <class S, class... T> static S distance(T &&...arguments) {
        calls++;
        return fcl::distance<S>(std::forward<T>(arguments)...);
    }
    template <class S, class... T> static S continuous_collide(T &&...arguments) {
        calls++;
        return fcl::continuousCollide<S>(std::forward<T>(arguments)...);
    }
};
#define OVOID_FCL_ITSELF ::counting_fcl
#include <ovoid/fcl.hpp>
#include <ovoid/ovoid.h>

#include <algorithm>
#include <iostream>
#include <set>

using namespace fcl;
using pair_set = std::set<std::pair<long, long>>;

/// The most by which a distance of a round shape may differ from the true one: half an allowance of 1e-4 radii for
/// cylinders and cones, of 1.2e-3 for ellipsoids; two bodies.
static const double round_error = 1.5e-3;

static ovoid_pose pose_of(const Transform3d &t) {
    const Eigen::Quaterniond q(t.linear());
    return {{t.translation()[0], t.translation()[1], t.translation()[2]}, {q.w(), q.x(), q.y(), q.z()}};
}

/// The shape of a geometry with ovoid's default tolerance; of an ellipsoid none.
static ovoid_shape *make_plain(const CollisionGeometryd *g) {
    switch (g->getNodeType()) {
    case GEOM_BOX: {
        const auto side = static_cast<const Boxd *>(g)->side;
        return ovoid_shape_create_box({side[0] / 2, side[1] / 2, side[2] / 2}, nullptr, nullptr);
    }
    case GEOM_SPHERE: return ovoid_shape_create_sphere(static_cast<const Sphered *>(g)->radius, nullptr, nullptr);
    case GEOM_CAPSULE: {
        const auto *s = static_cast<const Capsuled *>(g);
        return ovoid_shape_create_capsule(s->radius, s->lz / 2, nullptr, nullptr);
    }
    case GEOM_CONE: {
        const auto *s = static_cast<const Coned *>(g);
        return ovoid_shape_create_cone(s->radius, s->lz / 2, nullptr, nullptr);
    }
    case GEOM_CYLINDER: {
        const auto *s = static_cast<const Cylinderd *>(g);
        return ovoid_shape_create_cylinder(s->radius, s->lz / 2, nullptr, nullptr);
    }
    case GEOM_TRIANGLE: {
        const auto *s = static_cast<const TrianglePd *>(g);
        double xyz[9];
        for (int i = 0; i < 3; i++) xyz[i] = s->a[i], xyz[3 + i] = s->b[i], xyz[6 + i] = s->c[i];
        return ovoid_shape_create_from_points(xyz, 3, nullptr, nullptr);
    }
    case GEOM_CONVEX: {
        std::vector<double> xyz;
        for (const auto &v : static_cast<const Convexd *>(g)->getVertices())
            xyz.insert(xyz.end(), v.data(), v.data() + 3);
        return ovoid_shape_create_from_points(xyz.data(), xyz.size() / 3, nullptr, nullptr);
    }
    default: return nullptr;
    }
}

struct plain_pair {
    ovoid_shape *a, *b;
    plain_pair(const CollisionGeometryd *x, const CollisionGeometryd *y) : a(make_plain(x)), b(make_plain(y)) {}
    ~plain_pair() {
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    ovoid_answer ask(const Transform3d &s, const Transform3d &t) const {
        const ovoid_pair pair = {a, b, pose_of(s), pose_of(t)};
        return ovoid_depth(&pair, nullptr, nullptr, nullptr);
    }
};

/// Contacts part the bodies: o2 moved along the normal by the depth touches o1 no more than the error of round shapes.
static void check_contact(const Contactd &c, const plain_pair &plain, const Transform3d &s, Transform3d t) {
    CHECK_NEAR(c.normal.norm(), 1, 1e-12);
    CHECK_LE(0, c.penetration_depth);
    const ovoid_answer before = plain.ask(s, t);
    t.translation() += c.normal * c.penetration_depth;
    const ovoid_answer after = plain.ask(s, t);
    CHECK_LE(-2 * round_error, after.upper);
    CHECK_LE(c.penetration_depth, -before.lower + 1e-4);
    CHECK_LE(-before.upper - round_error, c.penetration_depth);
}

/// One pair at one pose.
static void check_pair(const named<double> &x, const named<double> &y, const plain_pair &plain, const Transform3d &s,
                       const Transform3d &t) {
    const ovoid_answer truth = plain.ask(s, t);
    CollisionRequestd yes;
    CollisionResultd hit;
    const bool is_hit = ovoid::fcl::collide<double>(x.geometry.get(), s, y.geometry.get(), t, yes, hit) > 0;
    if (truth.status == OVOID_SEPARATED) CHECK(!is_hit);
    if (truth.status == OVOID_OVERLAPPING) CHECK(is_hit);
    if (is_hit) CHECK(hit.getContact(0).o1 == x.geometry.get() && hit.getContact(0).o2 == y.geometry.get());

    CollisionRequestd more(8, true);
    CollisionResultd contacts;
    CHECK_EQ(ovoid::fcl::collide<double>(x.geometry.get(), s, y.geometry.get(), t, more, contacts) > 0, is_hit);
    if (is_hit) check_contact(contacts.getContact(0), plain, s, t);
    for (std::size_t i = 1; i < contacts.numContacts(); i++)
        CHECK_LE(contacts.getContact(i).penetration_depth, contacts.getContact(i - 1).penetration_depth);

    DistanceRequestd sign(true, true);
    DistanceResultd signed_result;
    const double d = ovoid::fcl::distance<double>(x.geometry.get(), s, y.geometry.get(), t, sign, signed_result);
    CHECK_LE(truth.lower - 1e-4, d);
    CHECK_LE(d, truth.upper + 1e-4);
    const double between = (signed_result.nearest_points[1] - signed_result.nearest_points[0]).norm();
    CHECK_NEAR(between, std::fabs(d), 1e-4);
    DistanceResultd plain_result;
    const double e =
        ovoid::fcl::distance<double>(x.geometry.get(), s, y.geometry.get(), t, DistanceRequestd(), plain_result);
    if (truth.status == OVOID_OVERLAPPING) CHECK_EQ(e, -1);
    if (truth.status == OVOID_SEPARATED) CHECK_NEAR(e, d, 1e-8);
}

static void test_shapes() {
    const auto shapes = make_shapes<double>();
    random_poses poses(1);
    for (const auto &x : shapes)
        for (const auto &y : shapes) {
            const plain_pair plain(x.geometry.get(), y.geometry.get());
            if (!plain.a || !plain.b) continue;
            for (int i = 0; i < 12; i++) check_pair(x, y, plain, poses.make<double>(0.4), poses.make<double>(0.4));
        }
}

/// Everything that FCL answers too, ellipsoids and meshes included: its distances are right to about 4e-4, and yes and
/// no agree where the bodies are not that near. Some pairs FCL has no answer for, and says so on stderr.
static void test_beside_fcl() {
    auto all = make_shapes<double>();
    all.push_back({"aabb", make_ball<AABBd>(0.5)});
    all.push_back({"obbrss", make_ball<OBBRSSd>(0.4)});
    all.push_back({"rss", make_ball<RSSd>(0.45)});
    random_poses poses(2);
    long compared = 0;
    for (const auto &x : all)
        for (const auto &y : all)
            for (int i = 0; i < 6; i++) {
                const Transform3d s = poses.make<double>(0.6), t = poses.make<double>(0.6);
                DistanceResultd ours, theirs;
                const double d =
                    ovoid::fcl::distance<double>(x.geometry.get(), s, y.geometry.get(), t, DistanceRequestd(), ours);
                const double e =
                    fcl::distance<double>(x.geometry.get(), s, y.geometry.get(), t, DistanceRequestd(), theirs);
                if (d > 0.02 && theirs.o1) CHECK_NEAR(d, e, 4e-3);
                compared += d > 0.02 && theirs.o1;
                if (std::fabs(d) < 0.02 && d > -0.5) continue;
                CollisionResultd mine, other;
                const bool is_hit = ovoid::fcl::collide<double>(x.geometry.get(), s, y.geometry.get(), t,
                                                                CollisionRequestd(), mine) > 0;
                CHECK_EQ(is_hit, d <= 0);
                if (d > 0)
                    CHECK_EQ(fcl::collide<double>(x.geometry.get(), s, y.geometry.get(), t, CollisionRequestd(), other),
                             0u);
            }
    CHECK_LE(200, compared);
}

/// The contact of two spheres is where FCL has it, to some roundings; within one another too.
static void test_spheres() {
    random_poses poses(7);
    const Sphered a(0.6), b(0.25);
    const CollisionRequestd one(1, true);
    long hits = 0;
    for (int n = 0; n < 60; n++) {
        const Transform3d s = poses.make<double>(0.3), t = poses.make<double>(0.3);
        CollisionResultd ours, theirs;
        CHECK_EQ(ovoid::fcl::collide<double>(&a, s, &b, t, one, ours), fcl::collide<double>(&a, s, &b, t, one, theirs));
        if (!ours.isCollision()) continue;
        hits++;
        const Contactd &c = ours.getContact(0), &d = theirs.getContact(0);
        CHECK_NEAR((c.pos - d.pos).norm(), 0, 1e-12);
        CHECK_NEAR((c.normal - d.normal).norm(), 0, 1e-12);
        CHECK_NEAR(c.penetration_depth, d.penetration_depth, 1e-12);
    }
    CHECK_LE(20, hits);
}

/// Yes or no of a sphere and another geometry, of which balls decide some, are those of the library, in both orders and
/// for bodies that all but touch along the way to the centre.
static void test_balls() {
    random_poses poses(9);
    const std::vector<named<double>> others = {{"sphere", std::make_shared<Sphered>(0.3)},
                                               {"capsule", std::make_shared<Capsuled>(0.2, 1.1)},
                                               {"box", std::make_shared<Boxd>(1.2, 0.3, 0.8)},
                                               {"disc", std::make_shared<Cylinderd>(0.7, 0.2)},
                                               {"rod", std::make_shared<Cylinderd>(0.2, 1.4)}};
    const Sphered ball(0.4);
    const auto read = [](const CollisionGeometryd *g, const Transform3d &t, ovoid_swept_sphere &to) {
        return ovoid::fcl::detail::make_swept<double>({g, g->getNodeType()}, t, to);
    };
    long hits = 0, misses = 0;
    for (int n = 0; n < 400; n++)
        for (const auto &x : others) {
            Transform3d s = poses.make<double>(0.5);
            const Transform3d t = poses.make<double>(0.5);
            ovoid_swept_sphere of_x{}, of_ball{};
            ovoid_witness at;
            // Few of the rotations are not those of a rotation to the last digits.
            if (!read(&ball, s, of_ball) || !read(x.geometry.get(), t, of_x)) continue;
            const ovoid_verdict found = ovoid_swept_distance({&of_ball, &of_x}, &at);
            if (n % 2 == 0 && found.status == OVOID_SEPARATED) {
                const double gap = (found.lower + found.upper) / 2 + (n % 4 == 0 ? 1e-9 : -1e-9);
                s.translation() += gap * Vector3d(at.normal.x, at.normal.y, at.normal.z);
                CHECK(read(&ball, s, of_ball));
            }
            const bool is_hit = ovoid_swept_collide({&of_ball, &of_x}).status != OVOID_SEPARATED;
            (is_hit ? hits : misses)++;
            for (const bool is_detailed : {false, true}) {
                const CollisionRequestd request(1, is_detailed);
                CollisionResultd first, second;
                CHECK_EQ(ovoid::fcl::collide<double>(&ball, s, x.geometry.get(), t, request, first), is_hit);
                CHECK_EQ(ovoid::fcl::collide<double>(x.geometry.get(), t, &ball, s, request, second), is_hit);
            }
        }
    CHECK_LE(600, hits);
    CHECK_LE(600, misses);
    // Sizes and transforms that are left to FCL.
    const Sphered wrong(-1);
    const Capsuled wrong_capsule(0.2, -1);
    const Boxd wrong_box(1, 1, -1);
    const Cylinderd wrong_cylinder(-1, 1);
    const Transform3d here = Transform3d::Identity(), far(Eigen::Translation3d(9, 0, 0));
    Transform3d grown = far;
    grown.linear() *= 2;
    const auto is_left = [&](const CollisionGeometryd &x, const CollisionGeometryd &y, const Transform3d &t) {
        const long before = counting_fcl::calls;
        CollisionResultd result;
        ovoid::fcl::collide<double>(&x, here, &y, t, CollisionRequestd(), result);
        return counting_fcl::calls > before;
    };
    for (const CollisionGeometryd *y :
         {static_cast<const CollisionGeometryd *>(&wrong), static_cast<const CollisionGeometryd *>(&wrong_capsule),
          static_cast<const CollisionGeometryd *>(&wrong_box),
          static_cast<const CollisionGeometryd *>(&wrong_cylinder)})
        CHECK(is_left(ball, *y, far));
    for (const auto &x : others) CHECK_EQ(is_left(ball, *x.geometry, grown), x.name != "sphere");
}

/// A matrix that is off a rotation by some roundings is read as one that is not, and is not far from it, mirrored or
/// not; one that is off by more is not read.
static void test_straightened() {
    using namespace ovoid::fcl::detail;
    random_poses poses(11);
    const Boxd box(0.9, 0.8, 0.7);
    long straightened = 0;
    for (int n = 0; n < 300; n++) {
        Transform3d t = poses.make<double>(0.5);
        if (n % 2) t.linear().col(n % 3) *= -1;
        t.linear()(n / 3 % 3, n % 3) += 3e-15;
        ovoid_swept_sphere of{};
        const double before =
            off_rotation({get_column<double>(t, 0), get_column<double>(t, 1), get_column<double>(t, 2)});
        const bool is_read = make_swept<double>({&box, box.getNodeType()}, t, of);
        CHECK_EQ(is_read, before <= 1e-14);
        if (!is_read) continue;
        straightened += before > columns_rounding;
        CHECK_LE(off_rotation(of.axis), columns_rounding);
        for (int k = 0; k < 3; k++) CHECK_LE(sum_abs(add_scaled(of.axis[k], get_column<double>(t, k), -1)), 2e-14);
        t.linear()(0, 0) += 1e-13;
        CHECK(!make_swept<double>({&box, box.getNodeType()}, t, of));
    }
    CHECK_LE(100, straightened);
}

/// The rotation of a sphere changes no bit of an answer, whatever the matrix is.
static void test_turned_spheres() {
    random_poses poses(8);
    const Sphered a(0.6), ball(0.25);
    const Boxd box(0.9, 0.8, 0.7);
    const Capsuled capsule(0.3, 0.8);
    const CollisionGeometryd *others[] = {&ball, &box, &capsule};
    const CollisionRequestd one(1, true);
    Transform3d sheared = Transform3d::Identity();
    sheared.linear()(0, 1) = 0.5;
    const long left = counting_fcl::calls;
    for (int n = 0; n < 30; n++) {
        const Transform3d s = poses.make<double>(0.5), t = poses.make<double>(0.5);
        const Transform3d place(Eigen::Translation3d(s.translation()));
        for (const auto *other : others) {
            CollisionResultd plain;
            DistanceResultd far;
            ovoid::fcl::collide<double>(&a, place, other, t, one, plain);
            ovoid::fcl::distance<double>(other, t, &a, place, DistanceRequestd(true), far);
            for (const Transform3d &turned : {s, place * sheared}) {
                CollisionResultd contacts;
                DistanceResultd nearest;
                ovoid::fcl::collide<double>(&a, turned, other, t, one, contacts);
                ovoid::fcl::distance<double>(other, t, &a, turned, DistanceRequestd(true), nearest);
                CHECK_EQ(contacts.numContacts(), plain.numContacts());
                CHECK(nearest.min_distance == far.min_distance && nearest.nearest_points[0] == far.nearest_points[0]);
                if (!plain.isCollision()) continue;
                const Contactd &c = contacts.getContact(0), &d = plain.getContact(0);
                CHECK(c.pos == d.pos && c.normal == d.normal && c.penetration_depth == d.penetration_depth);
            }
        }
    }
    CHECK_EQ(counting_fcl::calls, left);
    Transform3d nowhere = Transform3d::Identity();
    nowhere.translation()[1] = NAN;
    ovoid_prepared_shape unused;
    using posed = ovoid::fcl::detail::posed<double>;
    CHECK(!(posed{&a, nowhere, nullptr}).place(nullptr, unused));
    CHECK(!(posed{&box, sheared, nullptr}).place(nullptr, unused));
    CHECK((posed{&a, sheared, nullptr}).place(nullptr, unused));
}

/// Every pair of triangles that touch is listed, and no other; a mesh within another has no contact, and its distance
/// is that of the surfaces.
static void test_meshes() {
    const auto a = make_ball<OBBRSSd>(0.5, 7);
    const auto b = make_ball<AABBd>(0.4, 6);
    random_poses poses(3);
    const auto piece = [](const auto &mesh, int i) {
        double xyz[9];
        for (int k = 0; k < 9; k++) xyz[k] = mesh.vertices[mesh.tri_indices[i][std::size_t(k / 3)]][k % 3];
        return ovoid_shape_create_from_points(xyz, 3, nullptr, nullptr);
    };
    std::vector<ovoid_shape *> of_a, of_b;
    for (int i = 0; i < a->num_tris; i++) of_a.push_back(piece(*a, i));
    for (int i = 0; i < b->num_tris; i++) of_b.push_back(piece(*b, i));
    for (int n = 0; n < 6; n++) {
        const Transform3d s = poses.make<double>(0.3), t = poses.make<double>(0.3);
        pair_set truth, found;
        for (std::size_t i = 0; i < of_a.size(); i++)
            for (std::size_t j = 0; j < of_b.size(); j++) {
                const ovoid_pair pair = {of_a[i], of_b[j], pose_of(s), pose_of(t)};
                if (ovoid_collide(&pair, nullptr, nullptr).status != OVOID_SEPARATED) truth.insert({long(i), long(j)});
            }
        CollisionResultd result;
        const std::size_t count =
            ovoid::fcl::collide<double>(a.get(), s, b.get(), t, CollisionRequestd(100000, n % 2), result);
        CHECK_EQ(count, truth.size());
        for (std::size_t i = 0; i < count; i++) found.insert({result.getContact(i).b1, result.getContact(i).b2});
        CHECK(found == truth);
        CollisionResultd few;
        CHECK_EQ(ovoid::fcl::collide<double>(a.get(), s, b.get(), t, CollisionRequestd(3, true), few),
                 std::min<std::size_t>(3, count));
    }
    for (auto *shape : of_a) ovoid_shape_destroy(shape);
    for (auto *shape : of_b) ovoid_shape_destroy(shape);

    const auto inner = make_ball<OBBRSSd>(0.1, 6);
    const Transform3d at = Transform3d::Identity();
    CollisionResultd none;
    CHECK_EQ(ovoid::fcl::collide<double>(a.get(), at, inner.get(), at, CollisionRequestd(), none), 0u);
    const Boxd box(0.1, 0.1, 0.1), big(5, 5, 5);
    CHECK_EQ(ovoid::fcl::collide<double>(a.get(), at, &box, at, CollisionRequestd(), none), 0u);
    CHECK_EQ(ovoid::fcl::collide<double>(&big, at, a.get(), at, CollisionRequestd(), none), 1u);
    CHECK_EQ(none.getContact(0).b1, -1);
    DistanceResultd ours, theirs;
    CHECK_NEAR(ovoid::fcl::distance<double>(a.get(), at, inner.get(), at, DistanceRequestd(), ours),
               fcl::distance<double>(a.get(), at, inner.get(), at, DistanceRequestd(), theirs), 1e-6);
}

/// Halfspaces against a box of ovoid as large as all poses need, planes against a sheet.
static void test_planes() {
    random_poses poses(4);
    for (const auto &x : make_shapes<double>()) {
        ovoid_shape *plain = make_plain(x.geometry.get());
        if (!plain) continue;
        for (int n = 0; n < 20; n++) {
            const bool is_half = n % 2 == 0;
            const double size = 60;
            const Halfspaced half(Vector3d(0, 0, 1), 0);
            const Planed sheet(Vector3d(0, 0, 1), 0);
            const CollisionGeometryd *flat = is_half ? static_cast<const CollisionGeometryd *>(&half) : &sheet;
            const Transform3d s = poses.make<double>(0.4), t = poses.make<double>(0.4);
            ovoid_shape *stand_in = ovoid_shape_create_box({size, size, is_half ? size : 0}, nullptr, nullptr);
            Transform3d lowered = t;
            if (is_half) lowered.translation() -= t.linear() * Vector3d(0, 0, size);
            const ovoid_pair pair = {plain, stand_in, pose_of(s), pose_of(lowered)};
            ovoid_options tight = {};
            tight.relative_tolerance = 1e-12;
            const ovoid_answer truth = ovoid_depth(&pair, &tight, nullptr, nullptr);
            DistanceResultd result, swapped;
            const DistanceRequestd sign(true, true);
            const double d = ovoid::fcl::distance<double>(x.geometry.get(), s, flat, t, sign, result);
            CHECK_LE(truth.lower - 1e-8, d);
            CHECK_LE(d, truth.upper + 1e-8);
            CHECK_NEAR((result.nearest_points[1] - result.nearest_points[0]).norm(), std::fabs(d), 1e-12);
            CHECK_NEAR((t.inverse() * result.nearest_points[1])[2], 0, 1e-12);
            CHECK_EQ(ovoid::fcl::distance<double>(flat, t, x.geometry.get(), s, sign, swapped), d);
            CHECK((swapped.nearest_points[0] - result.nearest_points[1]).norm() == 0);
            CollisionResultd hit, back;
            const CollisionRequestd more(4, true);
            CHECK_EQ(ovoid::fcl::collide<double>(x.geometry.get(), s, flat, t, more, hit), d <= 0 ? 1u : 0u);
            CHECK_EQ(ovoid::fcl::collide<double>(flat, t, x.geometry.get(), s, more, back), hit.numContacts());
            if (d > 0) {
                ovoid_shape_destroy(stand_in);
                continue;
            }
            CHECK_NEAR(hit.getContact(0).penetration_depth, -d, 1e-12);
            CHECK((hit.getContact(0).normal + back.getContact(0).normal).norm() == 0);
            // As in FCL: on a plane, and half way between a halfspace's plane and the deepest point.
            const Vector3d &on_flat = result.nearest_points[1], &deepest = result.nearest_points[0];
            const Vector3d position = is_half ? Vector3d((on_flat + deepest) / 2) : on_flat;
            CHECK_LE((hit.getContact(0).pos - position).norm(), 1e-12);
            CHECK_LE((back.getContact(0).pos - position).norm(), 1e-12);
            // The other body moved along the normal by the depth touches.
            Transform3d moved = t;
            moved.translation() += hit.getContact(0).normal * -d;
            DistanceResultd after;
            CHECK_NEAR(ovoid::fcl::distance<double>(x.geometry.get(), s, flat, moved, sign, after), 0, 1e-12);
            ovoid_shape_destroy(stand_in);
        }
        ovoid_shape_destroy(plain);
    }
    // An ellipsoid's deepest point: of its surface, and as deep as FCL says.
    const Ellipsoidd egg(0.5, 0.4, 0.3);
    const Halfspaced floor(Vector3d(0, 0, 1), 0);
    const Planed wall(Vector3d(0, 0, 1), 0);
    for (int n = 0; n < 40; n++) {
        const CollisionGeometryd *flat = n % 2 == 0 ? static_cast<const CollisionGeometryd *>(&floor) : &wall;
        const Transform3d s = poses.make<double>(0.2), t = poses.make<double>(0.2);
        CollisionResultd known;
        if (fcl::collide(&egg, s, flat, t, CollisionRequestd(1, true), known) == 0) continue;
        DistanceResultd found;
        const double d = ovoid::fcl::distance<double>(&egg, s, flat, t, DistanceRequestd(true, true), found);
        CHECK_NEAR(-d, known.getContact(0).penetration_depth, 1e-12);
        CHECK_NEAR((s.inverse() * found.nearest_points[0]).cwiseQuotient(egg.radii).norm(), 1, 1e-12);
        CHECK_NEAR(std::fabs((t.inverse() * found.nearest_points[0])[2]), -d, 1e-12);
    }
    // A mesh: each triangle that reaches into the halfspace.
    const auto ball = make_ball<OBBd>(0.5);
    const Halfspaced half(Vector3d(0, 0, 2), -0.2);
    std::size_t below = 0;
    for (int i = 0; i < ball->num_tris; i++) {
        double low = 1;
        for (std::size_t k = 0; k < 3; k++) low = std::min(low, ball->vertices[ball->tri_indices[i][k]][2]);
        below += low <= half.d;
    }
    CollisionResultd result;
    const Transform3d at = Transform3d::Identity();
    CHECK_EQ(ovoid::fcl::collide<double>(ball.get(), at, &half, at, CollisionRequestd(1000, true), result), below);
    // Both unbounded: FCL's own answer.
    const Planed plane(Vector3d(0, 0, 1), -5);
    CollisionResultd ours, theirs;
    CHECK_EQ(ovoid::fcl::collide<double>(&half, at, &plane, at, CollisionRequestd(), ours),
             fcl::collide<double>(&half, at, &plane, at, CollisionRequestd(), theirs));
}

/// Contacts are those of occupied geometries, motions of others are free for FCL's naive solver; distances are
/// measured.
static void test_not_occupied() {
    const Transform3d at = Transform3d::Identity();
    Transform3d t = at, begin = at, end = at;
    t.translation()[0] = 0.5, begin.translation()[0] = -3, end.translation()[0] = 3;
    Boxd box(1, 1, 1), cell(1, 1, 1);
    Sphered ball(0.5);
    const auto mesh = make_ball<OBBd>(0.5);
    for (CollisionGeometryd *x : {static_cast<CollisionGeometryd *>(&box), static_cast<CollisionGeometryd *>(&ball),
                                  static_cast<CollisionGeometryd *>(mesh.get())})
        for (const double cost : {1.0, 0.5, 0.0}) {
            x->cost_density = cost;
            for (const bool is_first : {true, false}) {
                CollisionResultd result;
                const CollisionGeometryd *a = is_first ? x : &cell, *b = is_first ? &cell : x;
                CHECK_EQ(ovoid::fcl::collide<double>(a, at, b, t, CollisionRequestd(9, true), result) > 0, cost == 1);
                for (const auto solver : {CCDC_NAIVE, CCDC_CONSERVATIVE_ADVANCEMENT}) {
                    ContinuousCollisionRequestd request(100);
                    request.ccd_solver_type = solver;
                    request.ccd_motion_type = CCDM_TRANS;
                    ContinuousCollisionResultd found;
                    ovoid::fcl::continuousCollide<double>(a, at, at, b, begin, end, request, found);
                    CHECK_EQ(found.is_collide, cost == 1 || solver != CCDC_NAIVE);
                }
            }
            DistanceResultd result;
            CHECK_NEAR(ovoid::fcl::distance<double>(x, at, &cell, end, DistanceRequestd(), result), 2, 1e-2);
        }
}

/// What ovoid does not answer is FCL's answer: cost, no contacts, a transform that is no rotation, NaN, a box with a
/// side below 0, two planes, points without triangles, a spline.
static void test_left_to_fcl() {
    const Boxd a(1, 1, 1), wrong(1, 1, -1);
    const Planed plane(Vector3d(0, 0, 1), 0);
    BVHModel<OBBd> cloud;
    cloud.beginModel();
    cloud.addSubModel(std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    cloud.endModel();
    const Transform3d at = Transform3d::Identity();
    Transform3d t = at, grown = at, mirrored = at, sheared = at, nowhere = at;
    t.translation()[0] = 0.5;
    grown.linear() *= 3;
    mirrored.linear()(2, 2) = -1;
    sheared.linear()(0, 1) = 0.1;
    nowhere.translation()[0] = NAN;
    const auto count = [&](const CollisionGeometryd *x, const CollisionGeometryd *y, const Transform3d &where,
                           CollisionRequestd request) {
        const long before = counting_fcl::calls;
        CollisionResultd ours, theirs;
        CHECK_EQ(ovoid::fcl::collide<double>(x, at, y, where, request, ours),
                 fcl::collide<double>(x, at, y, where, request, theirs));
        CHECK_EQ(ours.numCostSources(), theirs.numCostSources());
        return counting_fcl::calls - before;
    };
    CHECK_EQ(count(&a, &a, t, CollisionRequestd()), 0);
    CHECK_EQ(count(&a, &a, t, CollisionRequestd(1, false, 5, true)), 1);
    CHECK_EQ(count(&a, &a, t, CollisionRequestd(0)), 1);
    for (const auto *wrong_pose : {&grown, &mirrored, &sheared})
        for (const CollisionGeometryd *other :
             {static_cast<const CollisionGeometryd *>(&a), static_cast<const CollisionGeometryd *>(&plane)})
            // A box is its own mirror image; of a plane no more is read than the turned normal.
            CHECK_EQ(count(&a, other, *wrong_pose, CollisionRequestd()),
                     wrong_pose == &grown || (wrong_pose == &sheared && other == &a));
    const auto hull = make_convex<double>(0.5);
    CHECK_EQ(count(&a, hull.get(), t, CollisionRequestd()), 0);
    for (const auto *wrong_pose : {&grown, &sheared})
        CHECK_EQ(count(&a, hull.get(), *wrong_pose, CollisionRequestd()), 1);
    CHECK_EQ(count(&a, &wrong, t, CollisionRequestd()), 1);
    CHECK_EQ(count(&plane, &plane, t, CollisionRequestd()), 1);
    CHECK_EQ(count(&a, &plane, t, CollisionRequestd()), 0);
    CHECK_EQ(count(&a, &plane, grown, CollisionRequestd()), 1);
    // FCL would crash on this one.
    ovoid::fcl::detail::print unused;
    CHECK(!ovoid::fcl::detail::make_print<double>({&cloud, cloud.getNodeType()}, unused));
    ovoid_pose pose;
    CHECK(!ovoid::fcl::detail::to_pose<double>(nowhere, pose));
    CHECK(ovoid::fcl::detail::to_pose<double>(t, pose));
    const long before = counting_fcl::calls;
    DistanceResultd result;
    ovoid::fcl::distance<double>(&wrong, at, &a, t, DistanceRequestd(), result);
    CHECK_EQ(counting_fcl::calls, before + 1);
    ContinuousCollisionRequestd spline;
    spline.ccd_motion_type = CCDM_SPLINE;
    ContinuousCollisionResultd moving;
    ovoid::fcl::continuousCollide<double>(&a, at, at, &a, t, t, spline, moving);
    CHECK_EQ(counting_fcl::calls, before + 2);
}

/// Results that are handed on: contacts are added up to the number wanted, distances only get smaller.
static void test_results() {
    const Boxd a(1, 1, 1);
    const Transform3d at = Transform3d::Identity();
    CollisionResultd result;
    const CollisionRequestd six(6, true);
    CHECK_EQ(ovoid::fcl::collide<double>(&a, at, &a, Transform3d(Eigen::Translation3d(0.9, 0.1, 0)), six, result), 4u);
    CHECK_EQ(ovoid::fcl::collide<double>(&a, at, &a, Transform3d(Eigen::Translation3d(0.9, 0.1, 0)), six, result), 6u);
    CHECK_EQ(ovoid::fcl::collide<double>(&a, at, &a, at, six, result), 6u);
    DistanceResultd nearest;
    const Transform3d far(Eigen::Translation3d(3, 0, 0)), near(Eigen::Translation3d(2, 0, 0));
    CHECK_NEAR(ovoid::fcl::distance<double>(&a, at, &a, near, DistanceRequestd(), nearest), 1, 1e-9);
    CHECK_NEAR(ovoid::fcl::distance<double>(&a, at, &a, far, DistanceRequestd(), nearest), 1, 1e-9);
}

static void test_motions() {
    const auto a = std::make_shared<Boxd>(1, 1, 1), b = std::make_shared<Boxd>(1, 1, 1);
    const Transform3d still = Transform3d::Identity();
    Transform3d begin = still, end = still;
    begin.translation() = Vector3d(-5, 0.1, 0), end.translation() = Vector3d(5, 0.1, 0);
    ContinuousCollisionRequestd request;
    ContinuousCollisionResultd result;
    CHECK_NEAR(ovoid::fcl::continuousCollide<double>(a.get(), still, still, b.get(), begin, end, request, result), 0.4,
               1e-6);
    CHECK(result.is_collide);
    CHECK_NEAR(result.contact_tf2.translation()[0], -1, 1e-5);
    // A thin sheet between FCL's samples.
    const auto sheet = std::make_shared<Boxd>(1e-6, 3, 3);
    CHECK_NEAR(ovoid::fcl::continuousCollide<double>(sheet.get(), still, still, b.get(), begin, end, request, result),
               0.45, 1e-6);
    end.translation()[0] = -2;
    CHECK_EQ(ovoid::fcl::continuousCollide<double>(a.get(), still, still, b.get(), begin, end, request, result), 1);
    CHECK(!result.is_collide);
    // Motions are FCL's own at all times.
    random_poses poses(5);
    for (int n = 0; n < 40; n++) {
        const Transform3d from = poses.make<double>(1), to = poses.make<double>(1);
        const TranslationMotion<double> slide(from.linear(), from.translation(), to.translation());
        const InterpMotion<double> turn(from.linear(), from.translation(), to.linear(), to.translation(),
                                        Vector3d(0, 0, 0));
        const ScrewMotion<double> screw(from, to);
        const MotionBase<double> *all[] = {&slide, &turn, &screw};
        for (const auto *motion : all) {
            ovoid_motion ours;
            CHECK(ovoid::fcl::detail::make_motion<double>(motion, ours));
            for (double time : {0.0, 0.3, 0.8, 1.0}) {
                Transform3d truth;
                motion->integrate(time);
                motion->getCurrentTransform(truth);
                const ovoid_pose pose = ovoid_motion_compute_pose(&ours, time);
                CHECK_NEAR((ovoid::fcl::detail::from_pose<double>(pose).matrix() - truth.matrix()).norm(), 0, 1e-9);
            }
        }
    }
    // Objects, and objects with motions.
    CollisionObjectd x(a), y(b, begin);
    end.translation()[0] = 5;
    CHECK_NEAR(ovoid::fcl::continuousCollide<double>(&x, still, &y, end, request, result), 0.4, 1e-6);
    const ContinuousCollisionObjectd mx(a, std::make_shared<TranslationMotion<double>>(still, still)),
        my(b, std::make_shared<TranslationMotion<double>>(begin, end));
    CHECK_NEAR(ovoid::fcl::collide<double>(&mx, &my, request, result), 0.4, 1e-6);
}

/// A capsule that lies on a box has a contact at each end where more than one is wanted.
static void test_lying() {
    const Boxd box(4, 4, 1);
    const Capsuled pill(0.3, 0.8);
    Transform3d lying = Transform3d::Identity();
    lying.linear() = Eigen::AngleAxisd(std::acos(-1.0) / 2, Vector3d::UnitY()).toRotationMatrix();
    lying.translation() = Vector3d(0.1, 0.2, 0.79);
    for (const std::size_t most : {std::size_t{1}, std::size_t{4}}) {
        CollisionResultd result;
        const CollisionRequestd request(most, true);
        CHECK_EQ(ovoid::fcl::collide<double>(&box, Transform3d::Identity(), &pill, lying, request, result),
                 most > 1 ? 2u : 1u);
        CHECK_NEAR(result.getContact(0).penetration_depth, 0.01, 1e-9);
    }
}

int main() {
    test_lying();
    std::cerr.rdbuf(nullptr); // FCL's warnings
    test_shapes();
    test_beside_fcl();
    test_spheres();
    test_balls();
    test_straightened();
    test_turned_spheres();
    test_meshes();
    test_planes();
    test_not_occupied();
    test_left_to_fcl();
    test_results();
    test_motions();
    return check_end();
}
