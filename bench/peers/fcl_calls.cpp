// bench_fcl_calls: FCL's calls answered by FCL and by <ovoid/fcl.hpp>, all pairs of types in the same random poses: how
// long each takes, where they differ, and who is right by ovoid's proof. Times are CPU times of this thread; both
// answer the same call in turn, and the medians over rounds are compared.
#include <ovoid/fcl.hpp>

#ifdef OVOID_HAVE_JUDGE
extern "C" {
#include <judge.h>
}
#endif

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
    std::shared_ptr<const ovoid::fcl::detail::body> body = ovoid::fcl::detail::make_body<double>(of.get());
};

/// Halfspaces and planes have z = 0 as boundary; a body of this half size, centred at z = -offset, stands for them.
constexpr double flat_size = 100;
using body_owner = std::shared_ptr<const ovoid::fcl::detail::body>;
body_owner make_flat(double thickness) {
    using namespace ovoid::fcl::detail;
    return std::make_shared<const body>(
        shape_owner(ovoid_shape_create_box({flat_size, flat_size, thickness}, nullptr, nullptr)));
}
bool is_flat(const named &x) {
    return x.of->getNodeType() == fcl::GEOM_HALFSPACE || x.of->getNodeType() == fcl::GEOM_PLANE;
}

using points_owner = std::shared_ptr<std::vector<fcl::Vector3d>>;

/// The corners of a box as FCL's Convex.
geometry make_corners(double half) {
    const auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (int i = 0; i < 8; i++)
        vertices->push_back(fcl::Vector3d(i & 4 ? half : -half, i & 2 ? half : -half, i & 1 ? half : -half));
    const auto faces = std::make_shared<std::vector<int>>(
        std::vector<int>{4, 0, 1, 3, 2, 4, 4, 6, 7, 5, 4, 0, 4, 5, 1, 4, 2, 3, 7, 6, 4, 0, 2, 6, 4, 4, 1, 5, 7, 3});
    return std::make_shared<fcl::Convexd>(vertices, 6, faces);
}

/// A hull of so many points on an ellipsoid, along a spiral, as FCL's Convex.
geometry make_convex(int count) {
    std::vector<double> points;
    for (int i = 0; i < count; i++) {
        const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), angle = 2.4 * i;
        points.insert(points.end(), {0.5 * r * std::cos(angle), 0.45 * r * std::sin(angle), 0.4 * z});
    }
    const std::unique_ptr<ovoid_shape, void (*)(ovoid_shape *)> shape(
        ovoid_shape_create_from_points(points.data(), static_cast<std::size_t>(count), nullptr, nullptr),
        ovoid_shape_destroy);
    const ovoid_polytope hull = ovoid_shape_get_polytope(shape.get());
    const auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const double *v = hull.vertices; v < hull.vertices + 3 * std::size_t{hull.vertex_count}; v += 3)
        vertices->push_back(fcl::Vector3d(v[0] + hull.origin.x, v[1] + hull.origin.y, v[2] + hull.origin.z));
    const auto faces = std::make_shared<std::vector<int>>();
    for (const std::uint32_t *t = hull.triangles; t < hull.triangles + 3 * std::size_t{hull.triangle_count}; t += 3)
        faces->insert(faces->end(), {3, static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull.triangle_count), faces);
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
            {"corners", make_corners(0.42)},
            {"convex", make_convex(20)},
            {"triangle",
             std::make_shared<TrianglePd>(Vector3d(-0.4, -0.3, 0), Vector3d(0.5, -0.2, 0.1), Vector3d(0, 0.6, 0))},
            {"mesh", mesh},
            {"halfspace", std::make_shared<Halfspaced>(Vector3d(0, 0, 1), 0.0), make_flat(flat_size)},
            {"plane", std::make_shared<Planed>(Vector3d(0, 0, 1), 0.0), make_flat(0)}};
}

double get_time() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e9 + static_cast<double>(t.tv_nsec);
}

/// How long it takes to read the clock, the least of a few readings.
double get_reading_time() {
    static const double least = [] {
        double time = 1e9;
        for (int i = 0; i < 100; i++) {
            const double begin = get_time();
            time = std::min(time, get_time() - begin);
        }
        return time;
    }();
    return least;
}

/// The time of a call, the median over rounds of the mean over poses, without that of reading the clock.
class stopwatch {
  public:
    template <class Call> void add(Call call) {
        const double begin = get_time();
        call();
        now_ += get_time() - begin - get_reading_time();
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

/// What one side said that the proof refutes, of the calls in which the two differ.
struct faults {
    long sign = 0, distance = 0, short_depth = 0, long_depth = 0;
    void add(const faults &other) {
        sign += other.sign, distance += other.distance;
        short_depth += other.short_depth, long_depth += other.long_depth;
    }
};

/// How the answers of a pair of types differ.
struct difference {
    long calls = 0, answers = 0, distances = 0, depths = 0, unsupported = 0;
    faults fcl, ours;
    double most = 0;
    void add(const difference &other) {
        calls += other.calls, answers += other.answers, distances += other.distances, depths += other.depths;
        unsupported += other.unsupported, fcl.add(other.fcl), ours.add(other.ours), most = std::max(most, other.most);
    }
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

/// Places a geometry's body.
void place(const named &x, const fcl::Transform3d &at, ovoid_prepared_shape &to) {
    fcl::Transform3d t = at;
    if (x.of->getNodeType() == fcl::GEOM_HALFSPACE) t.translation() -= at.linear() * fcl::Vector3d(0, 0, flat_size);
    ovoid::fcl::detail::place<double>(x.body->shape(), t, to);
}

/// What a proof is asked for.
enum question { of_sign, of_distance, of_depth, question_count };

/// Puts a sample of the proofs before the exact judge, which works in rationals and shares no code with the library: of
/// each pair of types and question the first few.
class court {
  public:
    static court &get() {
        static court all;
        return all;
    }
    void set_sample(long proofs) { sample_ = proofs; }
    void begin_pair() { std::fill(taken_, taken_ + question_count, 0); }
    void print() const {
#ifdef OVOID_HAVE_JUDGE
        std::printf("of the proofs behind this the exact judge was given, and confirmed: yes or no %ld, %ld; distances "
                    "%ld, %ld; depths and normals %ld, %ld\n",
                    given_[of_sign], right_[of_sign], given_[of_distance], right_[of_distance], given_[of_depth],
                    right_[of_depth]);
#endif
    }
    bool is_right() const { return std::equal(given_, given_ + question_count, right_); }
#ifdef OVOID_HAVE_JUDGE
    void take(question of, const ovoid_pair &pair, const ovoid_answer &answer, const ovoid_answer_basis &basis) {
        if (taken_[of]++ >= sample_) return;
        ovoid_error error;
        judge_set_options(judge_, basis.options);
        given_[of]++;
        if (judge_verify_answer(judge_, &pair, &answer, basis.cover, &error) == OVOID_OK)
            right_[of]++;
        else
            std::printf("NOT CONFIRMED: %s\n", error.message);
    }

  private:
    judge *judge_ = judge_create(); // lives until the program ends
#else
    void take(question, const ovoid_pair &, const ovoid_answer &, const ovoid_answer_basis &) {}

  private:
#endif
    long sample_ = 10, taken_[question_count] = {}, given_[question_count] = {}, right_[question_count] = {};
};

/// The proven bracket of the signed distance; meshes are their surfaces, whose overlaps have no depth here.
ovoid_answer prove(const named &x, const named &y, const fcl::Transform3d &s, const fcl::Transform3d &t, question of) {
    ovoid::fcl::detail::body_couple couple;
    couple.a = x.body.get(), couple.b = y.body.get();
    place(x, s, couple.at_a), place(y, t, couple.at_b);
    if (couple.has_mesh()) {
        const ovoid_body_pair pair = couple.bodies();
        return ovoid_body_distance(&pair, nullptr, nullptr).deciding;
    }
    const ovoid_pair pair = couple.shapes();
    ovoid_options tight{};
    tight.relative_tolerance = 1e-10;
    static unsigned char memory[OVOID_COVER_SIZE];
    ovoid_cover cover{};
    cover.memory = memory;
    cover.size = sizeof memory;
    const ovoid_answer answer = ovoid_depth(&pair, &tight, nullptr, &cover);
    const ovoid_answer_basis basis = {&tight, &cover};
    ovoid_error error;
    if (ovoid_answer_verify(&pair, &answer, &basis, &error) != OVOID_OK) std::printf("NOT PROVEN: %s\n", error.message);
    court::get().take(of, pair, answer, basis);
    return answer;
}

/// Numbers that differ by more than this part of them, with lengths of about 1, are judged by the proof.
constexpr double resolution = 1e-6;
bool is_other(double a, double b) { return !(std::fabs(a - b) <= resolution * std::max(1.0, std::fabs(b))); }

/// A contact parts the bodies by its depth along its normal, and no shorter way does.
void judge_contact(const named &x, const named &y, const fcl::Transform3d &s, const fcl::Transform3d &t,
                   const fcl::Contactd &contact, faults &of) {
    fcl::Transform3d moved = t;
    moved.translation() += contact.normal * contact.penetration_depth;
    of.short_depth += prove(x, y, s, moved, of_depth).upper < -resolution;
    of.long_depth += contact.penetration_depth > -prove(x, y, s, t, of_depth).lower + resolution;
}

/// Takes the place of stderr: FCL says there that it has no answer for a pair.
class listener : public std::streambuf {
  public:
    bool has_heard = false;

  protected:
    int overflow(int c) override {
        has_heard = true;
        return c;
    }
};
listener &get_listener() {
    static listener all;
    return all;
}
/// While it lives, std::cerr writes to the listener. The streams are flushed after the listener has been destroyed, so
/// std::cerr gets its own buffer back.
class listening {
  public:
    listening() : own_(std::cerr.rdbuf(&get_listener())) {}
    ~listening() { std::cerr.rdbuf(own_); }
    listening(const listening &) = delete;
    listening &operator=(const listening &) = delete;

  private:
    std::streambuf *own_;
};
/// FCL's answer, or false where it has none.
template <class Call> bool is_answered(Call call) {
    get_listener().has_heard = false;
    call();
    return !get_listener().has_heard;
}

void compare_contacts(const named &x, const named &y, const fcl::Transform3d &s, const fcl::Transform3d &t,
                      difference &d) {
    const fcl::CollisionRequestd request(1, true);
    fcl::CollisionResultd theirs, ours;
    const bool is_known = is_answered([&] { fcl::collide(x.of.get(), s, y.of.get(), t, request, theirs); });
    ovoid::fcl::collide<double>(x.of.get(), s, y.of.get(), t, request, ours);
    d.calls++;
    d.unsupported += !is_known;
    if (!is_known) return;
    if (theirs.isCollision() != ours.isCollision()) {
        d.answers++;
        const ovoid_status truth = prove(x, y, s, t, of_sign).status;
        const bool is_hit = truth == OVOID_OVERLAPPING;
        if (is_hit || truth == OVOID_SEPARATED)
            d.fcl.sign += theirs.isCollision() != is_hit, d.ours.sign += ours.isCollision() != is_hit;
        return;
    }
    if (!ours.isCollision() || x.body->solid() || y.body->solid()) return;
    const fcl::Contactd &a = theirs.getContact(0), &b = ours.getContact(0);
    if (!is_other(a.penetration_depth, b.penetration_depth) && a.normal.dot(b.normal) > 1 - resolution) return;
    d.depths++;
    judge_contact(x, y, s, t, a, d.fcl);
    judge_contact(x, y, s, t, b, d.ours);
}

void compare_distances(const named &x, const named &y, const fcl::Transform3d &s, const fcl::Transform3d &t,
                       difference &d) {
    fcl::DistanceResultd u, v;
    const fcl::DistanceRequestd request;
    double theirs = 0;
    const bool is_known = is_answered([&] { theirs = fcl::distance(x.of.get(), s, y.of.get(), t, request, u); });
    const double ours = ovoid::fcl::distance<double>(x.of.get(), s, y.of.get(), t, request, v);
    if (!is_known || !u.o1 || !(ours > 0)) return;
    d.most = std::max(d.most, std::fabs(theirs - ours));
    if (!is_other(theirs, ours)) return;
    d.distances++;
    const ovoid_answer truth = prove(x, y, s, t, of_distance);
    const auto is_outside = [&](double found) {
        return found < truth.lower - resolution || found > truth.upper + resolution;
    };
    d.fcl.distance += is_outside(theirs);
    d.ours.distance += is_outside(ours);
}

/// FCL 0.7 calls a null pointer where a plane meets a convex polytope or a triangle.
bool is_fatal(const named &x, const named &y) {
    const auto is_one = [](const named &a, const named &b) {
        const auto type = b.of->getNodeType();
        return a.of->getNodeType() == fcl::GEOM_PLANE && (type == fcl::GEOM_CONVEX || type == fcl::GEOM_TRIANGLE);
    };
    return is_one(x, y) || is_one(y, x);
}

void compare(const named &x, const named &y, const poses &at, difference &d) {
    court::get().begin_pair();
    for (std::size_t i = 0; i < at.a.size(); i++) {
        compare_contacts(x, y, at.a[i], at.b[i], d);
        // FCL's distance of a box and a halfspace calls a null pointer.
        if (!is_flat(x) && !is_flat(y)) compare_distances(x, y, at.a[i], at.b[i], d);
    }
}

void print_row(const char *x, const char *y, const difference &d) {
    std::printf("%-10s%-10s %8ld | %6ld %6ld %6ld | %6ld %6ld %6ld %8.1e | %6ld %6ld %6ld %6ld %6ld | %8ld\n", x, y,
                d.calls, d.answers, d.fcl.sign, d.ours.sign, d.distances, d.fcl.distance, d.ours.distance, d.most,
                d.depths, d.fcl.short_depth, d.fcl.long_depth, d.ours.short_depth, d.ours.long_depth, d.unsupported);
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
        if (is_flat(x) || is_flat(y)) continue;
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
        } else if (std::strcmp(argv[i], "--judge") == 0 && i + 1 < argc) {
            court::get().set_sample(std::atol(argv[++i]));
        } else {
            std::printf(
                "bench_fcl_calls [--calls N] [--rounds N] [--objects N] [--judge N]: FCL's calls by FCL and by ovoid; "
                "N "
                "calls of each pair of types (0: none), N rounds of 1000 calls, with a mesh of 100, are timed (0: "
                "none), and managers "
                "of 100, 1000, ... up to N objects; the exact judge is given N proofs of each pair of types and "
                "question, 10\n");
            return std::strcmp(argv[i], "--help") != 0;
        }
    }
    const listening to_stderr;
    const auto all = make_geometries();
    std::mt19937 engine(1);
    std::printf("of %d calls a pair those that differ, and of these what the proof refutes: yes or no (FCL's, ours); "
                "distances by more than 1e-6 (FCL's, ours; the most); depths or normals of one contact (FCL's too "
                "short to part the bodies, longer than needed, ours likewise); calls that FCL has no answer for\n",
                calls);
    difference total;
    for (const auto &x : all)
        for (const auto &y : all) {
            if ((is_flat(x) && is_flat(y)) || is_fatal(x, y)) continue;
            difference d;
            compare(x, y, make_poses(engine, calls, 0.5), d);
            print_row(x.name, y.name, d);
            total.add(d);
        }
    print_row("all", "", total);
    court::get().print();
    if (rounds > 0 && calls > 0)
        std::printf(
            "\nns a call, FCL, ovoid, FCL / ovoid | collide | collide with 4 contacts | distance with points\n");
    for (std::size_t i = 0; i < all.size() && rounds > 0 && calls > 0; i++)
        for (std::size_t j = i; j < all.size(); j++)
            if (!is_flat(all[i]) && !is_fatal(all[i], all[j]))
                measure(all[i], all[j],
                        make_poses(engine, all[i].body->solid() || all[j].body->solid() ? 100 : 1000, 0.5), rounds);
    bool is_same = true;
    if (rounds > 0)
        std::printf("\nmanagers, us a step, FCL, ovoid, FCL / ovoid | update | pairs | collide | distance\n");
    for (int count = 100; count <= objects && rounds > 0; count *= 10)
        for (const double step : {0.0, 0.02}) is_same = measure_managers(count, rounds, step) && is_same;
    const faults &ours = total.ours;
    return ours.sign + ours.distance + ours.short_depth + ours.long_depth > 0 || !is_same || !court::get().is_right();
}
