// The translations that <ovoid/fcl.hpp> keeps, of other geometries than pairs of spheres, capsules and boxes: each
// geometry is translated once; a geometry that is changed, refitted or has another one's address is translated anew,
// and the answer is that of a fresh geometry; those of dead geometries go; many threads get what one gets. The balls of
// a body hold it and are held by it, and say what the shapes say.
#include "fcl_zoo.hpp"

#include <ovoid/fcl.hpp>

#include <thread>

using namespace fcl;

static const Transform3d still = Transform3d::Identity();

static double ask(const CollisionGeometryd *a, const CollisionGeometryd *b, const Transform3d &t) {
    DistanceResultd result;
    return ovoid::fcl::distance<double>(a, still, b, t, DistanceRequestd(), result);
}
static Transform3d right(double x) { return Transform3d(Eigen::Translation3d(x, 0, 0)); }

/// The fields of a geometry are public.
static void test_changes() {
    Boxd box(1, 1, 1);
    Sphered ball(0.5);
    CHECK_NEAR(ask(&box, &ball, right(3)), 2, 1e-9);
    box.side[0] = 2;
    CHECK_NEAR(ask(&box, &ball, right(3)), 1.5, 1e-9);
    ball.radius = 1;
    CHECK_NEAR(ask(&box, &ball, right(3)), 1, 1e-9);
    Capsuled pill(0.5, 1);
    CHECK_NEAR(ask(&ball, &pill, right(3)), 1.5, 1e-9);
    pill.radius = 0.25;
    CHECK_NEAR(ask(&ball, &pill, right(3)), 1.75, 1e-9);
    Ellipsoidd egg(1, 1, 1);
    CHECK_NEAR(ask(&ball, &egg, right(3)), 1, 1e-3);
    egg.radii[0] = 0.5;
    CHECK_NEAR(ask(&ball, &egg, right(3)), 1.5, 1e-3);
    Cylinderd can(0.5, 1);
    Coned hat(0.5, 1);
    TrianglePd triangle(Vector3d(0, -1, -1), Vector3d(0, 1, -1), Vector3d(0, 0, 2));
    for (int n = 0; n < 2; n++) {
        CHECK_NEAR(ask(&ball, &can, right(3)), 2 - can.radius, 1e-4);
        CHECK_NEAR(ask(&hat, &can, right(3)), 3 - can.radius - hat.radius, 2e-4);
        CHECK_NEAR(ask(&triangle, &ball, right(3)), 2 - triangle.a[0], 1e-9);
        can.radius = 0.75, hat.radius = 0.6;
        for (auto *corner : {&triangle.a, &triangle.b, &triangle.c}) (*corner)[0] = 0.5;
    }
}

/// A geometry in the place of a dead one.
static void test_addresses() {
    alignas(16) unsigned char room[sizeof(Boxd) + sizeof(Sphered)];
    const Boxd other(1, 1, 1);
    for (int n = 0; n < 20; n++) {
        auto *box = new (room) Boxd(1 + 0.1 * n, 1, 1);
        CHECK_NEAR(ask(box, &other, right(5)), 5 - 0.5 - box->side[0] / 2, 1e-9);
        box->~Box();
        auto *ball = new (room) Sphered(1 + 0.1 * n);
        CHECK_NEAR(ask(ball, &other, right(5)), 4.5 - ball->radius, 1e-9);
        ball->~Sphere();
    }
}

/// The distance of a geometry is that of a copy, which has another address.
template <class BV> static void check_copy(const BVHModel<BV> &model, const CollisionGeometryd &other) {
    const BVHModel<BV> copy(model);
    CHECK_EQ(ask(&model, &other, right(3)), ask(&copy, &other, right(3)));
}

/// Vertices are moved by FCL's two ways, one vertex alone too: any one of them that the print does not hold.
template <class BV> static void test_refits() {
    const Boxd other(1, 1, 1);
    const auto model = make_ball<BV>(1, 16);
    check_copy(*model, other);
    // One that the print does not hold, near the other body: it decides when it is moved towards it.
    const int step = model->num_vertices / 16;
    int nearest = 1;
    for (int i = 0; i < model->num_vertices; i++)
        if (i % step != 0 && model->vertices[i][0] > model->vertices[nearest][0]) nearest = i;
    for (int round = 0; round < 6; round++) {
        std::vector<Vector3d> points(model->vertices, model->vertices + model->num_vertices);
        points[std::size_t(nearest)][0] = 1.01 + 0.002 * round;
        const double before = ask(model.get(), &other, right(3));
        if (round < 3) { // FCL replaces none that was updated
            model->beginReplaceModel();
            model->replaceSubModel(points);
            model->endReplaceModel(true, true);
        } else {
            model->beginUpdateModel();
            model->updateSubModel(points);
            model->endUpdateModel(true, true);
        }
        CHECK(ask(model.get(), &other, right(3)) < before - 0.001);
        check_copy(*model, other);
    }
}

/// Arrays that are written to behind FCL's back are told of.
static void test_forget() {
    const Boxd other(1, 1, 1);
    const auto model = make_ball<OBBd>(1, 16);
    const double before = ask(model.get(), &other, right(3));
    const std::size_t count = ovoid::fcl::count_kept();
    ovoid::fcl::forget<double>(model.get());
    CHECK_EQ(ovoid::fcl::count_kept(), count - 1);
    CHECK_EQ(ask(model.get(), &other, right(3)), before);
    CHECK_EQ(ovoid::fcl::count_kept(), count);
}

static void test_deaths() {
    ovoid::fcl::trim();
    CHECK_EQ(ovoid::fcl::count_kept(), 0u);
    std::vector<CollisionObjectd> living;
    for (int i = 0; i < 40; i++) living.emplace_back(std::make_shared<Boxd>(1, 1, 1 + 0.01 * i), right(3));
    CollisionResultd result;
    const auto ask_all = [&] {
        for (const auto &o : living) {
            result.clear();
            // The one contact of two boxes, which their shapes are asked for.
            CHECK_EQ(ovoid::fcl::collide<double>(&living[0], &o, CollisionRequestd(1, true), result), 1u);
        }
    };
    ask_all();
    CHECK_EQ(ovoid::fcl::count_kept(), 40u);
    // Geometries of objects that died; others come in their place. What lives stays.
    for (int i = 0; i < 5000; i++) {
        const double size = 0.1 + 1e-4 * i;
        const auto sheet = std::make_shared<TrianglePd>(Vector3d(0, 0, 0), Vector3d(size, 0, 0), Vector3d(0, 1, 0));
        const CollisionObjectd brief(sheet, still);
        result.clear();
        ovoid::fcl::collide<double>(&living[0], &brief, CollisionRequestd(), result);
        const TrianglePd raw(Vector3d(0, 0, 0), Vector3d(size, 0, 0), Vector3d(0, 1, 0));
        DistanceResultd distance;
        ovoid::fcl::distance<double>(&raw, still, living[0].collisionGeometry().get(), right(9), DistanceRequestd(),
                                     distance);
        CHECK_LE(ovoid::fcl::count_kept(), 200u);
    }
    const std::size_t before = ovoid::fcl::count_kept();
    ask_all();
    CHECK_EQ(ovoid::fcl::count_kept(), before);
    ovoid::fcl::trim();
    CHECK_EQ(ovoid::fcl::count_kept(), 40u);
    living.clear();
    ovoid::fcl::trim();
    CHECK_EQ(ovoid::fcl::count_kept(), 0u);
}

/// More geometries than a thread's table has places, in turns, from several threads, while others are made and die.
static void test_threads() {
    std::vector<std::shared_ptr<Boxd>> boxes;
    for (int i = 0; i < 700; i++) boxes.push_back(std::make_shared<Boxd>(1 + 0.001 * i, 1, 1));
    const auto ball = make_ball<OBBRSSd>(0.5);
    const auto work = [&](int salt) {
        std::vector<double> found;
        for (int i = 0; i < 1400; i++) {
            const auto &box = boxes[std::size_t(i * 13 + salt * 0) % boxes.size()];
            found.push_back(ask(box.get(), ball.get(), right(3)));
            const Coned brief(0.1 + 0.0001 * (i + salt), 1);
            ask(&brief, box.get(), right(4));
            if (i % 400 == 0) ovoid::fcl::trim();
        }
        return found;
    };
    const std::vector<double> alone = work(0);
    std::vector<std::vector<double>> together(4);
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < together.size(); k++) threads.emplace_back([&, k] { together[k] = work(int(k) + 1); });
    for (auto &thread : threads) thread.join();
    for (const auto &found : together) CHECK(found == alone);
    // Every pair of triangles, whose shapes are made by whichever thread comes first.
    const auto list = [&] {
        CollisionResultd result;
        return ovoid::fcl::collide<double>(ball.get(), still, ball.get(), right(0.7), CollisionRequestd(10000, true),
                                           result);
    };
    std::vector<std::size_t> counts(4);
    threads.clear();
    for (auto &count : counts) threads.emplace_back([&] { count = list(); });
    for (auto &thread : threads) thread.join();
    CHECK_LE(10, counts[0]);
    for (std::size_t count : counts) CHECK_EQ(count, list());
}

/// A convex polytope of 5 to 20 random points around a middle; its faces are not read.
static std::shared_ptr<Convexd> make_random_hull(random_poses &random, const Vector3d &middle) {
    auto points = std::make_shared<std::vector<Vector3d>>();
    const std::size_t count = 5 + random.engine() % 16;
    const auto number = [&random] { return random.normal(random.engine); };
    for (std::size_t i = 0; i < count; i++)
        points->push_back(middle + 0.4 * Vector3d(number(), number(), (1 + double(i % 3)) * number()));
    return std::make_shared<Convexd>(points, 1, std::make_shared<std::vector<int>>(std::vector<int>{3, 0, 1, 2}));
}

/// The hull holds the inner ball where it reaches as far as that along any direction; what it reaches beyond the outer
/// ball none of its points does.
static void check_balls(const std::vector<Vector3d> &points, random_poses &random) {
    using namespace ovoid::fcl::detail;
    const body made(shape_owner(make_hull<double>(points.data(), points.size())));
    const auto &balls = made.balls();
    const Vector3d center(balls.center.x, balls.center.y, balls.center.z);
    for (const auto &v : points) CHECK_LE((v - center).norm(), balls.outer);
    for (int k = 0; k < 3000; k++) {
        const Vector3d n = random.make<double>(1).translation().normalized();
        double reach = -1e9;
        for (const auto &v : points) reach = std::max(reach, n.dot(v - center));
        CHECK_LE(balls.inner, reach);
    }
}

static void test_balls() {
    random_poses random(9);
    check_balls({{0, 0, 0}, {1, 0, 0}, {0.1, 0.1, 0}}, random);
    check_balls({{3, 0, 0}, {4, 1, 0}}, random);
    check_balls({{3, 2, 1}}, random);
    long decided = 0;
    for (int n = 0; n < 100; n++) {
        const auto hull = make_random_hull(random, Vector3d(1, 2, -3) * (n % 3));
        check_balls(hull->getVertices(), random);
        for (const auto &other : make_shapes<double>()) {
            const Transform3d s = random.make<double>(1);
            Transform3d t = random.make<double>(0);
            t.translation() = s * hull->getInteriorPoint() + random.make<double>(0.5).translation();
            DistanceResultd nearest;
            const double distance = ovoid::fcl::distance<double>(hull.get(), s, other.geometry.get(), t,
                                                                 DistanceRequestd(true, true), nearest);
            CollisionResultd result, swapped;
            const bool is_hit =
                ovoid::fcl::collide<double>(hull.get(), s, other.geometry.get(), t, CollisionRequestd(), result) > 0;
            CHECK_EQ(ovoid::fcl::collide<double>(other.geometry.get(), t, hull.get(), s, CollisionRequestd(), swapped),
                     is_hit ? 1u : 0u);
            if (std::fabs(distance) > 1e-6) CHECK_EQ(is_hit, distance < 0), decided++;
        }
    }
    CHECK_LE(700, decided);
}

/// Vertices of a convex polytope that are written to: all of few, of many those that the print holds.
static void test_vertices() {
    const Boxd other(1, 4, 4);
    auto points = std::make_shared<std::vector<Vector3d>>();
    for (int i = 0; i < 8; i++) points->push_back(Vector3d(i & 4 ? 1 : -1, i & 2 ? 1 : -1, i & 1 ? 1 : -1));
    const Convexd hull(points, 1, std::make_shared<std::vector<int>>(std::vector<int>{3, 0, 1, 2}));
    CHECK_NEAR(ask(&hull, &other, right(4)), 2.5, 1e-9);
    for (std::size_t i = 4; i < 8; i++) {
        (*points)[i][0] = 1.25 + 0.25 * double(i - 4);
        CHECK_NEAR(ask(&hull, &other, right(4)), 3.5 - (*points)[i][0], 1e-9);
    }
    random_poses random(10);
    auto many = std::make_shared<std::vector<Vector3d>>();
    for (int i = 0; i < 40; i++) many->push_back(random.make<double>(1).translation().normalized());
    const Convexd ball(many, 1, std::make_shared<std::vector<int>>(std::vector<int>{3, 0, 1, 2}));
    ask(&ball, &other, right(4));
    for (std::size_t i = 0; i < many->size(); i += 2) {
        (*many)[i][0] = 1.1 + 0.01 * double(i);
        CHECK_NEAR(ask(&ball, &other, right(4)), 3.5 - (*many)[i][0], 1e-9);
    }
}

int main() {
    test_balls();
    test_vertices();
    test_changes();
    test_addresses();
    test_refits<OBBRSSd>();
    test_refits<OBBd>();
    test_refits<RSSd>();
    test_refits<kIOSd>();
    test_refits<AABBd>();
    test_refits<KDOP<double, 18>>();
    test_forget();
    test_deaths();
    test_threads();
    return check_end();
}
