// ovoid::fcl::BroadPhaseManager beside FCL's managers: every pair whose boxes meet is called back once, as by FCL's
// brute force, and the least distance is that of all pairs; after objects were moved, registered twice, removed and
// added again, of one manager, of two, and of one of each library.
#include "fcl_zoo.hpp"

#include <ovoid/fcl.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

using namespace fcl;

namespace {

template <class S> using object_of = CollisionObject<S>;
template <class S> using pair_list = std::vector<std::pair<object_of<S> *, object_of<S> *>>;

/// What a callback saw.
template <class S> struct record {
    pair_list<S> pairs;
    std::size_t most = std::numeric_limits<std::size_t>::max(); ///< then it wants to stop
    S least = std::numeric_limits<S>::max();
};
template <class S> bool note(object_of<S> *a, object_of<S> *b, void *data) {
    auto &to = *static_cast<record<S> *>(data);
    to.pairs.emplace_back(a, b);
    return to.pairs.size() >= to.most;
}
/// A number that is at least the distance of the boxes stands for that of the objects: the manager does not know what
/// the callback measures. The pair with the nearest boxes is seldom the one with the least number.
template <class S> bool measure(object_of<S> *a, object_of<S> *b, void *data, S &least) {
    auto &to = *static_cast<record<S> *>(data);
    to.pairs.emplace_back(a, b);
    least = to.least = std::min(to.least, a->getAABB().distance(b->getAABB()) +
                                              S(0.2) * (a->getTranslation() - b->getTranslation()).norm());
    return to.pairs.size() >= to.most;
}

/// Pairs without an order, sorted; a pair that occurs twice stays twice.
template <class S> pair_list<S> sorted(pair_list<S> pairs) {
    for (auto &p : pairs)
        if (p.second < p.first) std::swap(p.first, p.second);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// Objects at random poses, and both managers of some of them.
template <class S> class scene {
  public:
    scene(random_poses &poses, std::size_t count) : poses_(&poses) {
        const auto shapes = make_shapes<S>();
        for (std::size_t i = 0; i < count; i++) {
            all_.push_back(std::make_unique<object_of<S>>(shapes[i % shapes.size()].geometry, make_pose()));
            all_.back()->computeAABB();
        }
    }
    object_of<S> *get(std::size_t i) const { return all_[i].get(); }
    std::vector<object_of<S> *> list() const {
        std::vector<object_of<S> *> objects;
        for (const auto &o : all_) objects.push_back(o.get());
        return objects;
    }
    void move(std::size_t i) {
        all_[i]->setTransform(make_pose());
        all_[i]->computeAABB();
    }

  private:
    Transform3<S> make_pose() { return poses_->make<S>(1.5); }
    random_poses *poses_;
    std::vector<std::unique_ptr<object_of<S>>> all_;
};

/// The two managers have the same objects: all of their answers are the same.
template <class S>
void compare(ovoid::fcl::BroadPhaseManager<S> &ours, NaiveCollisionManager<S> &theirs, object_of<S> *other) {
    CHECK_EQ(ours.size(), theirs.size());
    CHECK_EQ(ours.empty(), theirs.empty());
    std::vector<object_of<S> *> mine, others;
    ours.getObjects(mine);
    theirs.getObjects(others);
    CHECK(
        (std::set<object_of<S> *>(mine.begin(), mine.end()) == std::set<object_of<S> *>(others.begin(), others.end())));
    record<S> a, b, c, d, e, f, g, h;
    ours.collide(&a, note<S>);
    theirs.collide(&b, note<S>);
    CHECK(sorted<S>(a.pairs) == sorted<S>(b.pairs));
    ours.collide(other, &c, note<S>);
    for (auto *o : others) // FCL's brute force calls back with boxes that are apart
        if (o->getAABB().overlap(other->getAABB())) d.pairs.emplace_back(o, other);
    CHECK(sorted<S>(c.pairs) == sorted<S>(d.pairs));
    for (const auto &p : c.pairs) CHECK(p.second == other);
    ours.distance(&e, measure<S>);
    theirs.distance(&f, measure<S>);
    CHECK_EQ(e.least, f.least);
    const auto asked = sorted<S>(e.pairs); // no pair twice
    CHECK(std::adjacent_find(asked.begin(), asked.end()) == asked.end());
    ours.distance(other, &g, measure<S>);
    theirs.distance(other, &h, measure<S>);
    CHECK_EQ(g.least, h.least);
}

template <class S> void test_changes(std::size_t count) {
    random_poses poses(11);
    scene<S> objects(poses, count);
    scene<S> probes(poses, 4);
    ovoid::fcl::BroadPhaseManager<S> ours;
    NaiveCollisionManager<S> theirs;
    compare<S>(ours, theirs, probes.get(0));
    // One by one, asked before the tree is built; twice is once.
    for (std::size_t i = 0; i < count; i++) {
        ours.registerObject(objects.get(i));
        ours.registerObject(objects.get(i / 2));
        theirs.registerObject(objects.get(i));
        if (i % 16 == 7) compare<S>(ours, theirs, probes.get(1));
    }
    ours.setup();
    compare<S>(ours, theirs, probes.get(1));
    // Moved: each, some, all.
    for (std::size_t i = 0; i < count; i++) {
        objects.move(i);
        if (i % 3 == 0) ours.update(objects.get(i));
    }
    ours.update(objects.list());
    compare<S>(ours, theirs, probes.get(2));
    objects.move(0), objects.move(count - 1);
    ours.update(std::vector<object_of<S> *>{objects.get(0), objects.get(count - 1)});
    compare<S>(ours, theirs, probes.get(2));
    for (int n = 0; n < 4; n++) {
        for (std::size_t i = 0; i < count; i++) objects.move(i);
        ours.update();
        compare<S>(ours, theirs, probes.get(3));
    }
    // Removed, one that is not there too, and some of them back.
    ours.unregisterObject(probes.get(0));
    for (std::size_t i = 0; i < count; i += 2) {
        ours.unregisterObject(objects.get(i));
        theirs.unregisterObject(objects.get(i));
        objects.move(i);
        ours.update(objects.get(i));
        if (i % 6 == 0) {
            ours.registerObject(objects.get(i));
            theirs.registerObject(objects.get(i));
        }
        if (i % 16 == 8) compare<S>(ours, theirs, probes.get(0));
    }
    compare<S>(ours, theirs, probes.get(0));
    ours.update();
    compare<S>(ours, theirs, probes.get(0));
    ours.clear();
    theirs.clear();
    compare<S>(ours, theirs, probes.get(0));
    ours.registerObjects(objects.list());
    theirs.registerObjects(objects.list());
    compare<S>(ours, theirs, probes.get(0));
}

/// Two managers: both ours, ours and FCL's, the same twice; with objects beside the tree.
template <class S> void test_two() {
    random_poses poses(12);
    scene<S> left(poses, 70), right(poses, 50);
    ovoid::fcl::BroadPhaseManager<S> a, b, none;
    NaiveCollisionManager<S> c, d;
    DynamicAABBTreeCollisionManager<S> e;
    const auto listed = left.list();
    a.registerObjects({listed.begin(), listed.end() - 5});
    for (std::size_t i = 65; i < 70; i++) a.registerObject(left.get(i));
    b.registerObjects(right.list());
    b.unregisterObject(right.get(0));
    b.registerObject(right.get(0));
    c.registerObjects(left.list());
    d.registerObjects(right.list());
    e.registerObjects(right.list());
    e.setup();
    record<S> truth, least;
    c.collide(&d, &truth, note<S>);
    c.distance(&d, &least, measure<S>);
    CHECK_LE(20, truth.pairs.size());
    for (BroadPhaseCollisionManager<S> *other : std::vector<BroadPhaseCollisionManager<S> *>{&b, &d, &e}) {
        record<S> found, nearest, one;
        a.collide(other, &found, note<S>);
        CHECK(sorted<S>(found.pairs) == sorted<S>(truth.pairs));
        for (const auto &p : found.pairs) {
            CHECK(std::find(listed.begin(), listed.end(), p.first) != listed.end());
        }
        a.distance(other, &nearest, measure<S>);
        CHECK_EQ(nearest.least, least.least);
        one.most = 1;
        a.collide(other, &one, note<S>);
        CHECK_EQ(one.pairs.size(), 1u);
        record<S> first;
        first.most = 1;
        a.distance(other, &first, measure<S>);
        CHECK_EQ(first.pairs.size(), 1u);
    }
    record<S> own, own_truth, empty;
    a.collide(&a, &own, note<S>);
    c.collide(&own_truth, note<S>);
    CHECK(sorted<S>(own.pairs) == sorted<S>(own_truth.pairs));
    record<S> near, near_truth;
    a.distance(&a, &near, measure<S>);
    c.distance(&near_truth, measure<S>);
    CHECK_EQ(near.least, near_truth.least);
    a.collide(&none, &empty, note<S>);
    none.collide(&a, &empty, note<S>);
    none.distance(&a, &empty, measure<S>);
    a.distance(&none, &empty, measure<S>);
    CHECK_EQ(empty.pairs.size(), 0u);
}

/// A callback that returns true is the last one.
void test_stop() {
    random_poses poses(13);
    scene<double> objects(poses, 60);
    ovoid::fcl::BroadPhaseManager<double> manager;
    for (const bool is_built : {false, true}) {
        manager.clear();
        manager.registerObjects({objects.get(0), objects.get(1)});
        for (std::size_t i = 2; i < 18; i++) manager.registerObject(objects.get(i));
        if (is_built) manager.registerObjects(objects.list());
        record<double> all;
        manager.collide(&all, note<double>);
        CHECK_LE(4, all.pairs.size());
        for (const std::size_t most : {std::size_t{1}, std::size_t{2}, all.pairs.size() - 1}) {
            record<double> some, own, near, of_one;
            some.most = own.most = near.most = of_one.most = most;
            manager.collide(&some, note<double>);
            CHECK_EQ(some.pairs.size(), most);
            of_one.most = 1;
            manager.collide(objects.get(0), &of_one, note<double>); // itself at least
            CHECK_EQ(of_one.pairs.size(), 1u);
            near.most = 1;
            manager.distance(&near, measure<double>);
            CHECK_EQ(near.pairs.size(), 1u);
            record<double> near_one;
            near_one.most = 1;
            manager.distance(objects.get(5), &near_one, measure<double>);
            CHECK_EQ(near_one.pairs.size(), 1u);
        }
    }
}

/// Unbounded objects, and one whose box is not a number: no crash, and the others are found as before.
void test_strange() {
    random_poses poses(14);
    scene<double> objects(poses, 40);
    ovoid::fcl::BroadPhaseManager<double> ours;
    NaiveCollisionManager<double> theirs;
    CollisionObjectd ground(std::make_shared<Halfspaced>(Vector3d(0, 0, 1), 0.0));
    ground.computeAABB();
    ours.registerObjects(objects.list());
    ours.registerObject(&ground);
    theirs.registerObjects(objects.list());
    theirs.registerObject(&ground);
    compare<double>(ours, theirs, objects.get(3));
    ours.update();
    compare<double>(ours, theirs, objects.get(3));
    Transform3d nowhere = Transform3d::Identity();
    nowhere.translation()[0] = NAN;
    CollisionObjectd lost(std::make_shared<Sphered>(0.5), nowhere);
    lost.computeAABB();
    record<double> before, after;
    ours.collide(&before, note<double>);
    ours.registerObject(&lost);
    ours.update();
    ours.collide(&after, note<double>);
    auto &pairs = after.pairs;
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const auto &p) { return p.first == &lost || p.second == &lost; }),
                pairs.end());
    CHECK(sorted<double>(before.pairs) == sorted<double>(pairs));
}

/// An object that is moved by itself to where no other one is, is found there.
void test_far() {
    random_poses poses(16);
    scene<double> objects(poses, 90);
    ovoid::fcl::BroadPhaseManager<double> manager;
    manager.registerObjects(objects.list());
    for (std::size_t i = 0; i < 90; i += 11) {
        CollisionObjectd *moved = objects.get(i);
        CollisionObjectd probe(std::make_shared<Sphered>(0.5));
        for (auto *o : {moved, &probe}) {
            o->setTranslation(Vector3d(100 + 20 * static_cast<double>(i), 0, 0));
            o->computeAABB();
        }
        manager.update(moved);
        record<double> found;
        manager.collide(&probe, &found, note<double>);
        CHECK_EQ(found.pairs.size(), 1u);
    }
}

/// Boxes side by side, whose faces are in one plane or off it by roundings: none of the pairs that meet is lost where
/// boxes are compared in single precision.
void test_touching() {
    std::vector<std::unique_ptr<CollisionObjectd>> all;
    std::vector<CollisionObjectd *> list;
    for (int i = 0; i < 125; i++) {
        Transform3d t = Transform3d::Identity();
        t.translation() = Vector3d(i % 5, i / 5 % 5, i / 25) * 0.1 + Vector3d(1.3, -7.7, 1000.1);
        all.push_back(std::make_unique<CollisionObjectd>(std::make_shared<Boxd>(0.1, 0.1, 0.1), t));
        all.back()->computeAABB();
        list.push_back(all.back().get());
    }
    ovoid::fcl::BroadPhaseManager<double> ours;
    NaiveCollisionManager<double> theirs;
    ours.registerObjects(list);
    theirs.registerObjects(list);
    record<double> a, b;
    ours.collide(&a, note<double>);
    theirs.collide(&b, note<double>);
    CHECK_LE(150, b.pairs.size());
    CHECK(sorted<double>(a.pairs) == sorted<double>(b.pairs));
}

/// Objects of three types in a cube, each of which meets about two others.
std::vector<std::unique_ptr<CollisionObjectd>> make_many(std::size_t count) {
    random_poses poses(17);
    const double side = 2 * std::cbrt(static_cast<double>(count));
    std::vector<std::unique_ptr<CollisionObjectd>> all;
    const std::shared_ptr<CollisionGeometryd> shapes[] = {
        std::make_shared<Boxd>(1, 1.2, 0.8), std::make_shared<Sphered>(0.5), std::make_shared<Capsuled>(0.3, 1)};
    for (std::size_t i = 0; i < count; i++) {
        Transform3d t = poses.make<double>(1);
        for (int k = 0; k < 3; k++) t.translation()[k] = side * (t.translation()[k] - std::floor(t.translation()[k]));
        all.push_back(std::make_unique<CollisionObjectd>(shapes[i % 3], t));
        all.back()->computeAABB();
    }
    return all;
}

/// More objects than those whose pairs are handed on at once: each pair is called back once, most pairs after one of
/// the same types, and the last one is that whose callback returns true. Of one manager and of two, FCL's among them.
void test_many(std::size_t count) {
    const auto all = make_many(count);
    std::vector<CollisionObjectd *> list;
    for (const auto &o : all) list.push_back(o.get());
    const std::vector<CollisionObjectd *> rest(list.begin(), list.begin() + 270);
    ovoid::fcl::BroadPhaseManager<double> ours, ours_too;
    NaiveCollisionManager<double> theirs, theirs_too;
    for (auto *manager : std::vector<BroadPhaseCollisionManager<double> *>{&ours, &theirs}) {
        manager->registerObjects(list);
        manager->unregisterObject(list[3]);
    }
    ours_too.registerObjects(rest), theirs_too.registerObjects(rest);
    for (BroadPhaseCollisionManager<double> *other :
         std::vector<BroadPhaseCollisionManager<double> *>{nullptr, &ours_too, &theirs_too}) {
        record<double> found, truth;
        const auto ask = [&](record<double> &to) {
            return other ? ours.collide(other, &to, note<double>) : ours.collide(&to, note<double>);
        };
        ask(found);
        if (other)
            theirs.collide(&theirs_too, &truth, note<double>);
        else
            theirs.collide(&truth, note<double>);
        CHECK(sorted<double>(found.pairs) == sorted<double>(truth.pairs));
        CHECK_LE(400, found.pairs.size());
        std::size_t changes = 0;
        for (std::size_t i = 1; i < found.pairs.size(); i++) {
            const auto &p = found.pairs[i], &q = found.pairs[i - 1];
            changes +=
                p.first->getNodeType() != q.first->getNodeType() || p.second->getNodeType() != q.second->getNodeType();
        }
        CHECK_LE(5 * changes, found.pairs.size());
        for (const std::size_t most : {std::size_t{1}, std::size_t{31}, std::size_t{32}, std::size_t{33},
                                       std::size_t{97}, found.pairs.size() - 1, found.pairs.size()}) {
            record<double> some;
            some.most = most;
            ask(some);
            CHECK_EQ(some.pairs.size(), most);
        }
    }
}

/// A callback that changes its manager: what it registers takes part from the next query on, what it removes stays
/// away from then on.
void test_changes_by_callback(std::size_t count) {
    const auto ball = std::make_shared<Sphered>(0.7);
    struct growth {
        ovoid::fcl::BroadPhaseManager<double> manager;
        std::vector<std::unique_ptr<CollisionObjectd>> all;
        std::size_t calls = 0, room = 0;
        std::shared_ptr<Sphered> ball;
        void add(double x) {
            all.push_back(std::make_unique<CollisionObjectd>(ball));
            all.back()->setTranslation(Vector3d(x, 0, 0));
            all.back()->computeAABB();
            manager.registerObject(all.back().get());
        }
        static bool take(CollisionObjectd *, CollisionObjectd *, void *data) {
            auto &to = *static_cast<growth *>(data);
            to.calls++;
            if (to.all.size() < to.room) to.add(static_cast<double>(to.all.size()));
            return false;
        }
        static bool clear(CollisionObjectd *a, CollisionObjectd *, void *data) {
            auto &to = *static_cast<growth *>(data);
            if (to.calls++ == 0)
                to.manager.clear();
            else
                to.manager.unregisterObject(a);
            to.manager.update();
            return false;
        }
    } to;
    to.ball = ball;
    for (std::size_t i = 0; i < count; i++) to.add(static_cast<double>(i));
    to.manager.setup();
    to.room = 2 * count;
    to.manager.collide(&to, growth::take);
    CHECK_EQ(to.calls, count - 1);
    CHECK_EQ(to.manager.size(), 2 * count - 1);
    to.room = to.calls = 0;
    to.manager.collide(&to, growth::take);
    CHECK_EQ(to.calls, 2 * count - 2);
    to.calls = 0;
    to.manager.collide(&to, growth::clear);
    CHECK_LE(to.calls, 513);
    CHECK(to.manager.empty());
    to.calls = 0;
    to.manager.collide(&to, growth::take);
    CHECK_EQ(to.calls, 0);
}

/// Through the shim: the least distance of all pairs, and each pair that collides.
void test_shim() {
    random_poses poses(15);
    scene<double> objects(poses, 40);
    ovoid::fcl::BroadPhaseManager<double> ours;
    ours.registerObjects(objects.list());
    struct truth_of {
        std::size_t hits = 0;
        double least = 1e9;
    } truth, found;
    for (std::size_t i = 0; i < 40; i++)
        for (std::size_t j = 0; j < i; j++) {
            CollisionResultd result;
            DistanceResultd distance;
            truth.hits += ovoid::fcl::collide<double>(objects.get(i), objects.get(j), CollisionRequestd(), result) > 0;
            truth.least = std::min(truth.least, ovoid::fcl::distance<double>(objects.get(i), objects.get(j),
                                                                             DistanceRequestd(), distance));
        }
    ours.collide(&found, [](CollisionObjectd *a, CollisionObjectd *b, void *data) {
        CollisionResultd result;
        static_cast<truth_of *>(data)->hits += ovoid::fcl::collide<double>(a, b, CollisionRequestd(), result) > 0;
        return false;
    });
    ours.distance(&found, [](CollisionObjectd *a, CollisionObjectd *b, void *data, double &least) {
        DistanceResultd result;
        auto &to = *static_cast<truth_of *>(data);
        least = to.least = std::min(to.least, ovoid::fcl::distance<double>(a, b, DistanceRequestd(), result));
        return false;
    });
    CHECK_LE(10, truth.hits);
    CHECK_EQ(found.hits, truth.hits);
    CHECK_NEAR(found.least, truth.least, 1e-9);
}

} // namespace

int main() {
    for (const std::size_t count : {1, 2, 3, 90}) test_changes<double>(count);
    test_changes<float>(60);
    test_two<double>();
    test_two<float>();
    test_stop();
    test_strange();
    test_far();
    test_touching();
    for (const std::size_t count : {300, 2100}) test_many(count);
    for (const std::size_t count : {30, 300, 3000}) test_changes_by_callback(count);
    test_shim();
    return check_end();
}
