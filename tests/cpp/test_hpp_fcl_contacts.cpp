// Several contacts of boxes and capsules by <ovoid/fcl.hpp>: depths against brackets of ovoid's shapes, to 1e-9 of the
// size; points against closed forms of the bodies' surfaces; numbers and places of contacts of bodies that lie on one
// another against what is plain to see.
#include "fcl_zoo.hpp"

#include <ovoid/fcl.hpp>
#include <ovoid/ovoid.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

using namespace fcl;

static const double pi = std::acos(-1.0);

/// A geometry with its shape, and how far a point of its own frame is from the surface; within it, by how much less
/// than 0.
struct body {
    geometry_of<double> of;
    std::shared_ptr<ovoid_shape> shape;
    Vector3d half; ///< of a box; of a capsule 0, 0 and the half length
    double radius;

    double measure(const Vector3d &point) const {
        const Vector3d off = point.cwiseAbs() - half;
        const double outside = off.cwiseMax(0).norm();
        return (outside > 0 || radius > 0 ? outside : off.maxCoeff()) - radius;
    }
};
static std::shared_ptr<ovoid_shape> own(ovoid_shape *shape) {
    return std::shared_ptr<ovoid_shape>(shape, ovoid_shape_destroy);
}
static body make_box(double x, double y, double z) {
    return {std::make_shared<Boxd>(x, y, z), own(ovoid_shape_create_box({x / 2, y / 2, z / 2}, nullptr, nullptr)),
            Vector3d(x, y, z) / 2, 0};
}
static body make_capsule(double radius, double length) {
    return {std::make_shared<Capsuled>(radius, length),
            own(ovoid_shape_create_capsule(radius, length / 2, nullptr, nullptr)), Vector3d(0, 0, length / 2), radius};
}

static ovoid_answer ask(const body &a, const Transform3d &s, const body &b, const Transform3d &t) {
    const auto pose = [](const Transform3d &at) {
        const Eigen::Quaterniond q(at.linear());
        return ovoid_pose{{at.translation()[0], at.translation()[1], at.translation()[2]},
                          {q.w(), q.x(), q.y(), q.z()}};
    };
    const ovoid_pair pair = {a.shape.get(), b.shape.get(), pose(s), pose(t)};
    ovoid_options tight{};
    tight.relative_tolerance = 1e-12;
    return ovoid_depth(&pair, &tight, nullptr, nullptr);
}

static std::vector<Contactd> list(const body &a, const Transform3d &s, const body &b, const Transform3d &t,
                                  std::size_t most = 8) {
    CollisionResultd result;
    ovoid::fcl::collide<double>(a.of.get(), s, b.of.get(), t, CollisionRequestd(most, true), result);
    std::vector<Contactd> all;
    result.getContacts(all);
    return all;
}

/// A point of a contact is on the surface; of a capsule the deepest one, others are a radius along the normal from the
/// segment and may be within it.
static void check_point(const body &of, const Vector3d &point, bool is_deepest) {
    CHECK_LE(of.measure(point), 1e-8);
    if (is_deepest || of.radius <= 0) CHECK_LE(-1e-8, of.measure(point));
}

/// The contacts of a pair: their number.
static std::size_t check(const body &a, const Transform3d &s, const body &b, const Transform3d &t) {
    const ovoid_answer truth = ask(a, s, b, t);
    const std::vector<Contactd> all = list(a, s, b, t);
    if (truth.status == OVOID_SEPARATED) CHECK_EQ(all.size(), 0u);
    if (truth.status != OVOID_OVERLAPPING || truth.upper > -1e-9) return all.size();
    CHECK(!all.empty() && all.size() <= 4);
    if (all.empty()) return 0;
    const double size =
        a.half.sum() + b.half.sum() + a.radius + b.radius + (t.translation() - s.translation()).lpNorm<1>();
    CHECK_NEAR(all[0].penetration_depth, -truth.lower, 1e-9 * size);
    CHECK_NEAR(all[0].penetration_depth, -truth.upper, 1e-9 * size);
    for (std::size_t i = 0; i < all.size(); i++) {
        const Contactd &c = all[i];
        CHECK(c.o1 == a.of.get() && c.o2 == b.of.get());
        CHECK_NEAR(c.normal.norm(), 1, 1e-12);
        CHECK(c.normal == all[0].normal);
        CHECK_LE(0, c.penetration_depth);
        CHECK_LE(c.penetration_depth, all[std::max<std::size_t>(i, 1) - 1].penetration_depth);
        const Vector3d half = c.normal * c.penetration_depth / 2;
        check_point(a, s.inverse() * Vector3d(c.pos + half), i == 0);
        check_point(b, t.inverse() * Vector3d(c.pos - half), i == 0);
        for (std::size_t k = 0; k < i; k++) CHECK_LE(1e-6 * size, (c.pos - all[k].pos).norm());
    }
    // The normal parts the bodies.
    Transform3d moved = t;
    moved.translation() += all[0].normal * all[0].penetration_depth;
    CHECK_LE(-1e-8, ask(a, s, b, moved).upper);
    // The same bodies exchanged are as deep.
    const std::vector<Contactd> back = list(b, t, a, s);
    CHECK(!back.empty());
    if (!back.empty()) CHECK_NEAR(back[0].penetration_depth, all[0].penetration_depth, 2e-9 * size);
    CHECK_EQ(list(a, s, b, t, 2).size(), std::min<std::size_t>(2, all.size()));
    return all.size();
}

static Transform3d make_transform(const Vector3d &at, const Vector3d &axis = Vector3d::UnitZ(), double angle = 0) {
    Transform3d t = Transform3d::Identity();
    t.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    t.translation() = at;
    return t;
}

static void test_random(const std::vector<body> &all) {
    random_poses poses(1);
    for (const body &a : all)
        for (const body &b : all)
            for (int n = 0; n < 150; n++) check(a, poses.make<double>(0.4), b, poses.make<double>(0.4));
}

/// Turned by less and less from faces and edges that are parallel, around any axis, in a common frame that is turned
/// too. Depths and points are right however small the turn.
static void test_nearly_parallel(const std::vector<body> &all) {
    random_poses poses(2);
    for (const body &a : all)
        for (const body &b : all)
            for (int n = 0; n < 8; n++)
                for (double turn = 1; turn > 1e-17; turn *= 0.2) {
                    const Transform3d frame = poses.make<double>(0.3), by = poses.make<double>(0.4);
                    const Vector3d axis = n % 4 < 3 ? Vector3d(Vector3d::Unit(n % 4)) : Vector3d(by.linear().col(0));
                    check(a, frame, b, frame * make_transform(by.translation(), axis, turn));
                }
}

/// A small box on a large one: its corners, however it is turned around the vertical and however little it is tilted.
static void test_on_a_table(const body &table) {
    const body box = make_box(0.5, 0.4, 0.3);
    const auto place = [&](const Vector3d &axis, double angle, double depth) {
        return make_transform(Vector3d(0.1, -0.2, 0.5 + 0.15 - depth), axis, angle);
    };
    const Transform3d at = Transform3d::Identity();
    for (double turn : {0.0, 1e-15, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3, 0.3, 1.2}) {
        const Transform3d t = place(Vector3d::UnitZ(), turn, 0.01);
        CHECK_EQ(check(table, at, box, t), 4u);
        for (const Contactd &c : list(table, at, box, t)) {
            const Vector3d own = t.inverse() * c.pos;
            CHECK_NEAR(std::fabs(own[0]), 0.25, 1e-8);
            CHECK_NEAR(std::fabs(own[1]), 0.2, 1e-8);
            CHECK_NEAR(c.penetration_depth, 0.01, 1e-8);
        }
    }
    CHECK_EQ(check(table, at, box, place(Vector3d(1, 0.3, 0), 1e-4, 0.01)), 4u);
    // On an edge: its two ends. On a corner: what of the nearest face is in the table, the corner first.
    const double tilt = 0.6, down = 0.2 * std::sin(tilt) + 0.15 * std::cos(tilt);
    const auto on_edge =
        list(table, at, box, make_transform(Vector3d(0, 0, 0.5 + down - 0.001), Vector3d::UnitX(), tilt));
    CHECK(on_edge.size() >= 2);
    for (std::size_t i = 0; i < 2; i++) CHECK_NEAR(on_edge[i].penetration_depth, 0.001, 1e-9);
    CHECK_NEAR((on_edge[1].pos - on_edge[0].pos).norm(), 0.5, 1e-8);
}

/// Two squares turned by an eighth meet in an octagon: four of its corners, of half its area or more.
static void test_octagon() {
    const body a = make_box(1, 1, 1);
    const auto all =
        list(a, Transform3d::Identity(), a, make_transform(Vector3d(0, 0, 0.99), Vector3d::UnitZ(), pi / 4));
    CHECK_EQ(all.size(), 4u);
    double most = 0;
    for (const Contactd &c : all)
        for (const Contactd &d : all) most = std::max(most, (c.pos - d.pos).norm());
    CHECK_NEAR(most, 2 * std::hypot(0.5, 0.5 * std::tan(pi / 8)), 1e-9);
}

/// Bars that cross touch in a point.
static void test_crossing() {
    const body bar = make_box(3, 0.2, 0.2);
    const Transform3d a = make_transform(Vector3d(0, 0, 0), Vector3d::UnitX(), pi / 4);
    const double reach = 0.1 * std::sqrt(2.0);
    const Transform3d b = make_transform(Vector3d(0.3, 0.2, 2 * reach - 0.01), Vector3d::UnitZ(), pi / 2) *
                          make_transform(Vector3d(0, 0, 0), Vector3d::UnitX(), pi / 4);
    CHECK_EQ(check(bar, a, bar, b), 1u);
    const auto all = list(bar, a, bar, b);
    CHECK_NEAR((all[0].pos - Vector3d(0.3, 0, reach - 0.005)).norm(), 0, 1e-9);
    CHECK_NEAR(all[0].normal[2], 1, 1e-12);
    CHECK_NEAR(all[0].penetration_depth, 0.01, 1e-12);
}

/// Bars on their edges, one on the other, turned by so little that the edges are nearly parallel: they overlap least
/// along the edges' cross product, as long as they overlap by less than the ends are beside one another.
static void test_long_crossing() {
    const body bar = make_box(3, 0.2, 0.2);
    const Transform3d a = make_transform(Vector3d(0, 0, 0), Vector3d::UnitX(), pi / 4);
    for (double turn : {1e-1, 1e-2, 1e-3, 2e-4, 5e-5, 1e-5}) {
        const double height = 0.2 * std::sqrt(2.0) - 0.1 * turn;
        const Transform3d b = make_transform(Vector3d(0, 0, height), Vector3d::UnitZ(), turn) * a;
        check(bar, a, bar, b);
        const auto all = list(bar, a, bar, b);
        CHECK(!all.empty());
        if (!all.empty()) CHECK_NEAR(all[0].penetration_depth, 0.1 * turn, 4e-9);
    }
}

/// A capsule on a box: lying two ends, standing or leaning one; within it too.
static void test_capsules() {
    const body box = make_box(4, 4, 1), pill = make_capsule(0.3, 0.8);
    const Transform3d at = Transform3d::Identity();
    const auto lean = [&](double angle, double height) {
        return make_transform(Vector3d(0.1, 0.2, 0.5 + height), Vector3d::UnitY(), angle);
    };
    for (double height : {0.29, 0.1, -0.05}) CHECK_EQ(check(box, at, pill, lean(pi / 2, height)), 2u);
    const auto lying = list(box, at, pill, lean(pi / 2, -0.05));
    CHECK_NEAR(lying[0].penetration_depth, 0.35, 1e-9);
    CHECK_NEAR((lying[0].pos - lying[1].pos).norm(), 0.8, 1e-9);
    for (double height : {0.69, 0.5, 0.3}) CHECK_EQ(check(box, at, pill, lean(0, height)), 1u);
    CHECK_EQ(check(box, at, pill, lean(0.1, 0.69)), 1u);
    // Side by side, along 0.5 of 0.8; in line; crossing.
    const Transform3d beside = make_transform(Vector3d(0.58, 0, 0.3));
    CHECK_EQ(check(pill, at, pill, beside), 2u);
    const auto both = list(pill, at, pill, beside);
    CHECK_NEAR((both[0].pos - both[1].pos).norm(), 0.5, 1e-9);
    CHECK_NEAR(std::max(both[0].pos[2], both[1].pos[2]), 0.4, 1e-9);
    CHECK_EQ(check(pill, at, pill, make_transform(Vector3d(0.1, 0, 1.3))), 1u);
    CHECK_EQ(check(pill, at, pill, make_transform(Vector3d(0.58, 0, 0), Vector3d::UnitX(), 0.2)), 1u);
}

/// The hull of a parallelepiped's corners around a centre, of which one face is tilted; its faces are not read.
static body make_hull(const Vector3d &center, const Vector3d &x, const Vector3d &y, const Vector3d &z,
                      double tilt = 0) {
    const auto points = std::make_shared<std::vector<Vector3d>>();
    for (int i = 0; i < 8; i++)
        points->push_back(center + (i & 1 ? Vector3d((i & 2 ? 1 + tilt : 1) * x) : Vector3d(-x)) +
                          (i & 2 ? 1 : -1) * y + (i & 4 ? 1 : -1) * z);
    const auto hull =
        std::make_shared<Convexd>(points, 1, std::make_shared<std::vector<int>>(std::vector<int>{4, 0, 1, 3, 2}));
    return {hull, own(ovoid_shape_create_from_points((*points)[0].data(), 8, nullptr, nullptr)), {0, 0, 0}, 0};
}

/// Convex polytopes that are boxes, have their corners nearly, or are far from their frame's origin, beside each other
/// and a box: a corner is not off by more than roundings where a box stands for the polytope.
static void test_hulls_of_boxes() {
    random_poses poses(3);
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ(), none(0, 0, 0);
    const Eigen::Matrix3d turn = poses.make<double>(0).linear();
    const std::vector<std::pair<body, bool>> hulls = {
        {make_hull(none, 0.5 * x, 0.4 * y, 0.3 * z), true},
        {make_hull(none, 0.5 * z, 0.4 * x, 0.01 * y), true},
        {make_hull(Vector3d(0.2, -0.1, 0.3), 0.5 * x, 0.1 * y, 0.4 * z), true},
        {make_hull(none, turn * (0.5 * x), turn * (0.45 * y), turn * (0.55 * z)), true},
        {make_hull(none, 0.5 * x, 0.4 * y, 0.3 * z + 1e-9 * x), false},
        {make_hull(none, 0.5 * x, 0.4 * y + 0.2 * x, 0.3 * z), false},
        {make_hull(none, 0.5 * x, 0.4 * y, 0.3 * z, 1e-9), false},
        {make_hull(Vector3d(1e6, 0, 0), 0.5 * x, 0.5 * y, 0.5 * z), false}};
    for (const auto &a : hulls) {
        const ovoid::fcl::detail::corner_box box = ovoid::fcl::detail::find_corner_box(a.first.shape.get());
        CHECK_EQ(box.is_one, a.second);
        for (const auto &b : hulls)
            for (int n = 0; n < 100; n++) {
                const Transform3d s = poses.make<double>(0.4), t = poses.make<double>(0.4);
                const ovoid_answer truth = ask(a.first, s, b.first, t);
                const std::vector<Contactd> found = list(a.first, s, b.first, t);
                const std::size_t single = list(a.first, s, b.first, t, 1).size();
                if (truth.status == OVOID_SEPARATED) CHECK_EQ(found.size() + single, 0u);
                if (truth.status != OVOID_OVERLAPPING) continue;
                CHECK(!found.empty());
                CHECK_EQ(single, 1u);
                if (!found.empty()) CHECK_NEAR(found[0].penetration_depth, -truth.upper, 1e-8);
            }
    }
    // Far away the corners are where they are, and not where the sum of a position and a centre is rounded to.
    for (int n = 0; n < 100; n++) {
        Transform3d s = poses.make<double>(0.4), t = poses.make<double>(0.4);
        s.translation()[0] += 1e9, t.translation()[0] += 1e9;
        const ovoid_answer truth = ask(hulls[2].first, s, hulls[2].first, t);
        const std::vector<Contactd> found = list(hulls[2].first, s, hulls[2].first, t);
        CHECK(truth.status != OVOID_OVERLAPPING || !found.empty());
        if (truth.status == OVOID_OVERLAPPING && !found.empty())
            CHECK_NEAR(found[0].penetration_depth, -truth.upper, 1e-9);
    }
}

int main() {
    const std::vector<body> all = {make_box(1, 0.8, 0.6), make_box(0.9, 0.9, 0.9), make_box(2, 0.1, 0.3),
                                   make_capsule(0.25, 0.8), make_capsule(0.05, 1.5)};
    test_random(all);
    test_nearly_parallel(all);
    test_on_a_table(make_box(4, 4, 1));
    test_octagon();
    test_crossing();
    test_long_crossing();
    test_capsules();
    test_hulls_of_boxes();
    return check_end();
}
