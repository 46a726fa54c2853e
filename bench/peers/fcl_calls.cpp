// bench_fcl_calls: FCL's calls answered by FCL and by <ovoid/fcl.hpp>, all pairs of types in the same random poses: how
// long each takes, where they differ, and who is right by ovoid's proof. Times are CPU times of this thread; both
// answer the same call in turn, and the medians over rounds are compared.
#include <ovoid/fcl.hpp>

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <random>
#include <string>
#include <vector>

using geometry = std::shared_ptr<fcl::CollisionGeometryd>;

namespace {

struct named {
    const char *name;
    geometry of;
};

/// A box of eight vertices as FCL's Convex.
geometry make_convex(double half) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (int i = 0; i < 8; i++)
        vertices->push_back(fcl::Vector3d(i & 4 ? half : -half, i & 2 ? half : -half, i & 1 ? half : -half));
    const auto faces = std::make_shared<std::vector<int>>(
        std::vector<int>{4, 0, 1, 3, 2, 4, 4, 6, 7, 5, 4, 0, 4, 5, 1, 4, 2, 3, 7, 6, 4, 0, 2, 6, 4, 4, 1, 5, 7, 3});
    return std::make_shared<fcl::Convexd>(vertices, 6, faces);
}

std::vector<named> make_geometries() {
    using namespace fcl;
    const auto mesh = std::make_shared<BVHModel<OBBRSSd>>();
    generateBVHModel(*mesh, Sphered(0.5), Transform3d(Transform3d::Identity()), 50, 50);
    return {{"box", std::make_shared<Boxd>(0.9, 0.8, 0.7)},
            {"sphere", std::make_shared<Sphered>(0.5)},
            {"ellipsoid", std::make_shared<Ellipsoidd>(0.5, 0.4, 0.3)},
            {"capsule", std::make_shared<Capsuled>(0.3, 0.8)},
            {"cone", std::make_shared<Coned>(0.45, 0.9)},
            {"cylinder", std::make_shared<Cylinderd>(0.4, 0.9)},
            {"convex", make_convex(0.42)},
            {"mesh", mesh}};
}

double get_time() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e9 + static_cast<double>(t.tv_nsec);
}

/// The time of a call, the median over rounds of the mean over poses.
class stopwatch {
  public:
    template <class Call> void add(Call call) {
        const double begin = get_time();
        call();
        now_ += get_time() - begin;
    }
    void end_round(std::size_t calls) {
        rounds_.push_back(now_ / static_cast<double>(calls));
        now_ = 0;
    }
    double get_median() {
        std::sort(rounds_.begin(), rounds_.end());
        return rounds_.empty() ? 0 : rounds_[rounds_.size() / 2];
    }

  private:
    double now_ = 0;
    std::vector<double> rounds_;
};

/// Both answers to one question.
struct sides {
    stopwatch fcl, ovoid;
};

/// How the answers of a pair of types differ.
struct difference {
    long calls = 0, answers = 0, fcl_wrong = 0, ours_wrong = 0, open = 0, far = 0, unsupported = 0;
    double most = 0;
};

struct poses {
    std::vector<fcl::Transform3d> a, b;
};
poses make_poses(std::mt19937 &engine, int count, double spread) {
    std::normal_distribution<double> normal;
    poses all;
    for (int i = 0; i < count; i++)
        for (auto *to : {&all.a, &all.b}) {
            fcl::Transform3d t = fcl::Transform3d::Identity();
            t.linear() = fcl::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
                             .normalized()
                             .toRotationMatrix();
            t.translation() = fcl::Vector3d(normal(engine), normal(engine), normal(engine)) * spread;
            to->push_back(t);
        }
    return all;
}

/// The proven answer of the translated bodies; meshes by their surfaces.
ovoid_answer prove(const named &x, const named &y, const fcl::Transform3d &s, const fcl::Transform3d &t) {
    namespace detail = ovoid::fcl::detail;
    const auto a = detail::make_body<double>(x.of.get()), b = detail::make_body<double>(y.of.get());
    detail::body_couple couple = {a.get(), b.get(), {}, {}};
    detail::to_pose<double>(s, couple.pose_a), detail::to_pose<double>(t, couple.pose_b);
    if (couple.has_mesh()) {
        const ovoid_body_pair pair = couple.bodies();
        return ovoid_body_distance(&pair, nullptr, nullptr).deciding;
    }
    const ovoid_pair pair = couple.shapes();
    const ovoid_answer answer = ovoid_distance(&pair, nullptr, nullptr);
    ovoid_error error;
    if (ovoid_answer_verify(&pair, &answer, nullptr, &error) != OVOID_OK)
        std::printf("NOT PROVEN: %s\n", error.message);
    return answer;
}

void compare(const named &x, const named &y, const poses &at, difference &d) {
    for (std::size_t i = 0; i < at.a.size(); i++) {
        fcl::CollisionResultd r, s;
        const fcl::CollisionRequestd request;
        const bool theirs = fcl::collide(x.of.get(), at.a[i], y.of.get(), at.b[i], request, r) > 0;
        const bool ours = ovoid::fcl::collide<double>(x.of.get(), at.a[i], y.of.get(), at.b[i], request, s) > 0;
        d.calls++;
        if (theirs != ours) {
            const ovoid_status truth = prove(x, y, at.a[i], at.b[i]).status;
            d.answers++;
            if (truth == OVOID_SEPARATED || truth == OVOID_OVERLAPPING)
                (ours == (truth == OVOID_OVERLAPPING) ? d.fcl_wrong : d.ours_wrong)++;
            else
                d.open++;
        }
        fcl::DistanceResultd u, v;
        const double e = fcl::distance(x.of.get(), at.a[i], y.of.get(), at.b[i], fcl::DistanceRequestd(), u);
        const double f =
            ovoid::fcl::distance<double>(x.of.get(), at.a[i], y.of.get(), at.b[i], fcl::DistanceRequestd(), v);
        if (!u.o1) d.unsupported++;
        if (!u.o1 || !(f > 0)) continue;
        d.most = std::max(d.most, std::fabs(e - f));
        if (std::fabs(e - f) < 1e-5) continue;
        const ovoid_answer truth = prove(x, y, at.a[i], at.b[i]);
        d.far += e < truth.lower - 1e-6 || e > truth.upper + 1e-6;
    }
}

void measure(const named &x, const named &y, const poses &at, int rounds) {
    sides collide, contacts, distance;
    const fcl::CollisionRequestd yes, four(4, true);
    const fcl::DistanceRequestd near(true);
    const std::size_t count = at.a.size();
    // A round is one reading of the clock around all poses: reading it costs as much as a call.
    const auto ask_all = [&](stopwatch &watch, auto ask) {
        watch.add([&] {
            for (std::size_t i = 0; i < count; i++) ask(x.of.get(), at.a[i], y.of.get(), at.b[i]);
        });
        watch.end_round(count);
    };
    const auto collide_both = [&](sides &both, const fcl::CollisionRequestd &request) {
        ask_all(both.fcl, [&](const auto *a, const auto &s, const auto *b, const auto &t) {
            fcl::CollisionResultd result;
            fcl::collide(a, s, b, t, request, result);
        });
        ask_all(both.ovoid, [&](const auto *a, const auto &s, const auto *b, const auto &t) {
            fcl::CollisionResultd result;
            ovoid::fcl::collide<double>(a, s, b, t, request, result);
        });
    };
    for (int n = 0; n < rounds; n++) {
        collide_both(collide, yes);
        collide_both(contacts, four);
        ask_all(distance.fcl, [&](const auto *a, const auto &s, const auto *b, const auto &t) {
            fcl::DistanceResultd result;
            fcl::distance(a, s, b, t, near, result);
        });
        ask_all(distance.ovoid, [&](const auto *a, const auto &s, const auto *b, const auto &t) {
            fcl::DistanceResultd result;
            ovoid::fcl::distance<double>(a, s, b, t, near, result);
        });
    }
    std::printf("%-10s%-10s", x.name, y.name);
    for (auto *both : {&collide, &contacts, &distance}) {
        const double theirs = both->fcl.get_median(), ours = both->ovoid.get_median();
        std::printf(" | %8.0f %8.0f %6.2f", theirs, ours, theirs / ours);
    }
    std::printf("\n");
}

/// Objects in a cube, for managers: boxes, spheres and capsules, each with sizes of its own.
std::vector<std::unique_ptr<fcl::CollisionObjectd>> make_objects(std::mt19937 &engine, int count) {
    std::uniform_real_distribution<double> part;
    const double side = 2 * std::cbrt(count);
    const poses at = make_poses(engine, count, 0);
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> all;
    for (std::size_t i = 0; i < at.a.size(); i++) {
        const auto size = [&] { return 0.5 + part(engine); };
        geometry of;
        if (i % 3 == 0)
            of = std::make_shared<fcl::Boxd>(size(), size(), size());
        else if (i % 3 == 1)
            of = std::make_shared<fcl::Sphered>(size() / 2);
        else
            of = std::make_shared<fcl::Capsuled>(size() / 4, size());
        fcl::Transform3d t = at.a[i];
        t.translation() = side * fcl::Vector3d(part(engine), part(engine), part(engine));
        all.push_back(std::make_unique<fcl::CollisionObjectd>(of, t));
        all.back()->computeAABB();
    }
    return all;
}

/// What a callback counts.
struct tally {
    long pairs = 0, hits = 0;
    double least = 1e9;
};
template <bool is_ours> bool count_hits(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data) {
    auto &to = *static_cast<tally *>(data);
    fcl::CollisionResultd result;
    const fcl::CollisionRequestd yes;
    to.hits += (is_ours ? ovoid::fcl::collide<double>(a, b, yes, result) : fcl::collide<double>(a, b, yes, result)) > 0;
    return false;
}
bool count_pairs(fcl::CollisionObjectd *, fcl::CollisionObjectd *, void *data) {
    static_cast<tally *>(data)->pairs++;
    return false;
}
template <bool is_ours> bool find_least(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data, double &least) {
    auto &to = *static_cast<tally *>(data);
    fcl::DistanceResultd result;
    const fcl::DistanceRequestd near;
    to.least = std::min(to.least, is_ours ? ovoid::fcl::distance<double>(a, b, near, result)
                                          : fcl::distance<double>(a, b, near, result));
    least = to.least;
    return false;
}

/// FCL's dynamic tree with FCL's calls beside ovoid's manager with ovoid's, step by step. False if they disagree.
bool measure_managers(int count, int rounds, double step) {
    std::mt19937 engine(2);
    std::normal_distribution<double> normal;
    const auto all = make_objects(engine, count);
    std::vector<fcl::CollisionObjectd *> list;
    for (const auto &o : all) list.push_back(o.get());
    fcl::DynamicAABBTreeCollisionManagerd theirs;
    ovoid::fcl::BroadPhaseManager<double> ours;
    theirs.registerObjects(list), ours.registerObjects(list);
    theirs.setup(), ours.setup();
    tally warm;
    ours.collide(&warm, count_hits<true>);
    sides update, pairs, collide, distance;
    bool is_same = true;
    for (int n = 0; n < rounds; n++) {
        for (auto *o : list) {
            o->setTranslation(o->getTranslation() +
                              step * fcl::Vector3d(normal(engine), normal(engine), normal(engine)));
            o->computeAABB();
        }
        tally a, b;
        update.fcl.add([&] { theirs.update(); }), update.ovoid.add([&] { ours.update(); });
        pairs.fcl.add([&] { theirs.collide(&a, count_pairs); }),
            pairs.ovoid.add([&] { ours.collide(&b, count_pairs); });
        collide.fcl.add([&] { theirs.collide(&a, count_hits<false>); });
        collide.ovoid.add([&] { ours.collide(&b, count_hits<true>); });
        distance.fcl.add([&] { theirs.distance(&a, find_least<false>); });
        distance.ovoid.add([&] { ours.distance(&b, find_least<true>); });
        for (auto *both : {&update, &pairs, &collide, &distance}) both->fcl.end_round(1), both->ovoid.end_round(1);
        is_same = is_same && a.pairs == b.pairs && a.hits == b.hits;
    }
    std::printf("%6d %5.2f", count, step);
    for (auto *both : {&update, &pairs, &collide, &distance}) {
        const double first = both->fcl.get_median(), second = both->ovoid.get_median();
        std::printf(" | %8.1f %8.1f %6.2f", first / 1e3, second / 1e3, first / second);
    }
    std::printf("%s\n", is_same ? "" : " | NOT THE SAME PAIRS");
    return is_same;
}

} // namespace

int main(int argc, char **argv) {
    int calls = 1000, rounds = 7, objects = 1000;
    for (int i = 1; i < argc; i++) {
        if (std::strcmp(argv[i], "--calls") == 0 && i + 1 < argc) {
            calls = std::max(0, std::atoi(argv[++i]));
        } else if (std::strcmp(argv[i], "--rounds") == 0 && i + 1 < argc) {
            rounds = std::max(0, std::atoi(argv[++i]));
        } else if (std::strcmp(argv[i], "--objects") == 0 && i + 1 < argc) {
            objects = std::max(0, std::atoi(argv[++i]));
        } else {
            std::printf(
                "bench_fcl_calls [--calls N] [--rounds N] [--objects N]: FCL's calls by FCL and by ovoid; N "
                "calls of each pair of types (0: none), N rounds of 100 calls are timed (0: none), and managers "
                "of 100, 1000, ... up to N objects\n");
            return std::strcmp(argv[i], "--help") != 0;
        }
    }
    std::cerr.rdbuf(nullptr); // FCL's warnings; its unsupported pairs are counted
    const auto all = make_geometries();
    std::mt19937 engine(1);
    std::printf(
        "differences of %d calls a pair; answers: yes or no differs, by the proof FCL is wrong, ovoid is, open; "
        "distances: FCL's outside of the proven bracket by more than 1e-6, largest difference\n",
        calls);
    std::printf("%-10s%-10s %8s %8s %8s %8s %10s %10s %12s\n", "", "", "answers", "FCL", "ovoid", "open", "distances",
                "most", "unsupported");
    difference total;
    for (const auto &x : all)
        for (const auto &y : all) {
            difference d;
            compare(x, y, make_poses(engine, calls, 0.5), d);
            std::printf("%-10s%-10s %8ld %8ld %8ld %8ld %10ld %10.1e %12ld\n", x.name, y.name, d.answers, d.fcl_wrong,
                        d.ours_wrong, d.open, d.far, d.most, d.unsupported);
            total.calls += d.calls, total.answers += d.answers, total.fcl_wrong += d.fcl_wrong;
            total.ours_wrong += d.ours_wrong, total.open += d.open, total.far += d.far;
        }
    std::printf(
        "all %ld calls: %ld answers differ, FCL wrong %ld, ovoid wrong %ld, open %ld; %ld of FCL's distances outside\n",
        total.calls, total.answers, total.fcl_wrong, total.ours_wrong, total.open, total.far);
    if (rounds > 0 && calls > 0)
        std::printf(
            "\nns a call, FCL, ovoid, FCL / ovoid | collide | collide with 4 contacts | distance with points\n");
    for (std::size_t i = 0; i < all.size() && rounds > 0 && calls > 0; i++)
        for (std::size_t j = i; j < all.size(); j++) measure(all[i], all[j], make_poses(engine, 100, 0.5), rounds);
    bool is_same = true;
    if (rounds > 0)
        std::printf("\nmanagers, us a step, FCL, ovoid, FCL / ovoid | update | pairs | collide | distance\n");
    for (int count = 100; count <= objects && rounds > 0; count *= 10)
        for (const double step : {0.0, 0.02}) is_same = measure_managers(count, rounds, step) && is_same;
    return total.ours_wrong > 0 || !is_same;
}
