// Solids beside FCL's BVHModel, in one run: knots and bumpy spheres of about 5 000 and 50 000 triangles, meshes of
// files, at gaps of 100, 10 and 1 % of half their diagonal, and overlapping, in random rotations. Both answer the same
// pairs in turns, the best of several passes each, in time of the thread; distances and hits are compared and have to
// agree. FCL computes distances with OBBRSS and RSS and answers yes or no with OBB and OBBRSS; the faster of its two
// trees counts in each cell. Distances are computed to a relative tolerance of 1e-9 here, to FCL's default there.
#include <fcl/fcl.h>
#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

// Seconds of this thread: what else runs on the machine is not counted.
double get_seconds() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct mesh {
    std::vector<double> points;
    std::vector<std::uint32_t> triangles;
    std::string name;
};

// FCL's trees of a mesh.
struct models {
    std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> both;
    std::shared_ptr<fcl::BVHModel<fcl::RSSd>> distance;
    std::shared_ptr<fcl::BVHModel<fcl::OBBd>> collide;
};

class random_numbers {
  public:
    double next() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    ovoid_quat turn() { return {next() - 0.5, next() - 0.5, next() - 0.5, next() - 0.5}; }
    ovoid_vec3 direction() {
        double z = 2 * next() - 1, a = 6.283185307179586 * next(), w = std::sqrt(1 - z * z);
        return {w * std::cos(a), w * std::sin(a), z};
    }

  private:
    std::uint64_t state_ = 7;
};

double radius_at(double a, double b) {
    return 1 + 0.25 * std::sin(7 * a + 1) * std::cos(5 * b) + 0.075 * std::sin(23 * b) * std::sin(19 * a);
}

mesh make_bumpy(std::size_t triangles) {
    const auto rings = static_cast<std::uint32_t>(std::sqrt(triangles / 4.0)), around = 2 * rings;
    mesh m;
    auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        m.triangles.insert(m.triangles.end(), {a, b, c});
    };
    m.points = {0, 0, radius_at(0, 0)};
    for (std::uint32_t i = 1; i < rings; i++)
        for (std::uint32_t j = 0; j < around; j++) {
            double a = 3.141592653589793 * i / rings, b = 6.283185307179586 * j / around, r = radius_at(a, b);
            m.points.insert(m.points.end(),
                            {r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a)});
        }
    const auto south = static_cast<std::uint32_t>(m.points.size() / 3), last = 1 + (rings - 2) * around;
    m.points.insert(m.points.end(), {0, 0, -radius_at(3.141592653589793, 0)});
    for (std::uint32_t j = 0; j < around; j++) {
        const std::uint32_t k = (j + 1) % around;
        add(0, 1 + j, 1 + k);
        add(south, last + k, last + j);
        for (std::uint32_t p = 1; p < last; p += around) {
            add(p + j, p + around + j, p + around + k);
            add(p + j, p + around + k, p + k);
        }
    }
    return m;
}

// The tube of radius 0.4 around a (2, 3) torus knot.
mesh make_knot(std::uint32_t around, std::uint32_t tube) {
    mesh m;
    const double turn = 6.283185307179586;
    const auto center = [](double a) {
        return fcl::Vector3d((2 + std::cos(3 * a)) * std::cos(2 * a), (2 + std::cos(3 * a)) * std::sin(2 * a),
                             std::sin(3 * a));
    };
    for (std::uint32_t i = 0; i < around; i++) {
        const double a = turn * i / around;
        const fcl::Vector3d along = (center(a + 1e-4) - center(a - 1e-4)).normalized();
        const fcl::Vector3d x = along.cross(fcl::Vector3d(0, 0, 1)).normalized(), y = along.cross(x);
        for (std::uint32_t j = 0; j < tube; j++) {
            const double b = turn * j / tube;
            const fcl::Vector3d p = center(a) + 0.4 * (std::cos(b) * x + std::sin(b) * y);
            m.points.insert(m.points.end(), {p.x(), p.y(), p.z()});
        }
    }
    for (std::uint32_t i = 0; i < around; i++)
        for (std::uint32_t j = 0; j < tube; j++) {
            const std::uint32_t p = i * tube, q = (i + 1) % around * tube, k = (j + 1) % tube;
            m.triangles.insert(m.triangles.end(), {p + j, q + j, p + k, p + k, q + j, q + k});
        }
    return m;
}

// Moves a mesh's box to the origin and scales half its diagonal to 1.
void scale(mesh &m) {
    fcl::Vector3d low = fcl::Vector3d::Constant(INFINITY), high = -low;
    for (std::size_t i = 0; i < m.points.size(); i += 3) {
        const fcl::Vector3d p(m.points[i], m.points[i + 1], m.points[i + 2]);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const fcl::Vector3d middle = (low + high) / 2;
    const double half = (high - low).norm() / 2;
    for (std::size_t i = 0; i < m.points.size(); i++)
        m.points[i] = (m.points[i] - middle[static_cast<Eigen::Index>(i % 3)]) / half;
}

bool read_mesh(const std::string &path, mesh &m) {
    ovoid_error error;
    ovoid_solid *s = ovoid_solid_read_file(path.c_str(), nullptr, &error);
    if (!s) {
        (void)std::fprintf(stderr, "bench_solids: %s\n", error.message);
        return false;
    }
    const ovoid_solid_report report = ovoid_solid_get_report(s);
    const double *points = ovoid_solid_get_points(s);
    m.points.assign(points, points + 3 * report.points);
    m.triangles.resize(3 * report.triangles);
    for (std::size_t i = 0; i < report.triangles; i++) ovoid_solid_get_triangle(s, i, &m.triangles[3 * i]);
    ovoid_solid_destroy(s);
    return true;
}

template <class Volume> std::shared_ptr<fcl::BVHModel<Volume>> make_model(const mesh &m) {
    std::vector<fcl::Vector3d> points;
    std::vector<fcl::Triangle> triangles;
    for (std::size_t i = 0; i < m.points.size(); i += 3)
        points.emplace_back(m.points[i], m.points[i + 1], m.points[i + 2]);
    for (std::size_t i = 0; i < m.triangles.size(); i += 3)
        triangles.emplace_back(m.triangles[i], m.triangles[i + 1], m.triangles[i + 2]);
    auto made = std::make_shared<fcl::BVHModel<Volume>>();
    made->beginModel();
    made->addSubModel(points, triangles);
    made->endModel();
    return made;
}

fcl::Transform3d make_transform(const ovoid_pose &p) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    t.linear() =
        fcl::Quaterniond(p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z).normalized().toRotationMatrix();
    t.translation() = fcl::Vector3d(p.position.x, p.position.y, p.position.z);
    return t;
}

// A pair at a gap, found by moving the second body along a line; gap 0: from where they touch 0.2 nearer.
ovoid_body_pair make_pair_at(const ovoid_solid *s, double gap, random_numbers &numbers) {
    ovoid_body_pair pair = {{nullptr, nullptr, {{0, 0, 0}, numbers.turn()}, s},
                            {nullptr, nullptr, {{0, 0, 0}, numbers.turn()}, s}};
    const ovoid_vec3 n = numbers.direction();
    const double wanted = gap > 0 ? gap : 0.01;
    double at = 4;
    for (int i = 0; i < 40; i++) {
        pair.b.pose.position = {at * n.x, at * n.y, at * n.z};
        const ovoid_body_answer x = ovoid_body_distance(&pair, nullptr, nullptr);
        if (std::fabs(x.upper - wanted) < 0.02 * wanted) break;
        at += x.upper > 0 ? wanted - x.upper : 0.05;
    }
    if (!(gap > 0)) at -= 0.2;
    pair.b.pose.position = {at * n.x, at * n.y, at * n.z};
    return pair;
}

// The best passes of three works over all pairs, in turns: ours and FCL's with two trees; microseconds a pair.
struct times {
    double own, theirs[2];
    double ratio() const { return std::fmin(theirs[0], theirs[1]) / own; }
};

// FCL's times over ours, of all meshes: of a distance and of a yes or no at a gap.
struct cells {
    double gap;
    std::vector<double> distance, collide;
};

// As often as it takes to be far above what reading the clock costs.
double measure_once(std::size_t count, const std::function<void()> &work) {
    for (std::size_t rounds = 1;; rounds *= 4) {
        const double start = get_seconds();
        for (std::size_t i = 0; i < rounds; i++) work();
        const double spent = get_seconds() - start;
        if (spent > 1e-4) return spent * 1e6 / static_cast<double>(rounds * count);
    }
}

times measure(std::size_t count, const std::function<void()> &own, const std::function<void()> &first,
              const std::function<void()> &second) {
    times best = {INFINITY, {INFINITY, INFINITY}};
    for (int pass = 0; pass < 5; pass++) {
        best.own = std::fmin(best.own, measure_once(count, own));
        best.theirs[0] = std::fmin(best.theirs[0], measure_once(count, first));
        best.theirs[1] = std::fmin(best.theirs[1], measure_once(count, second));
    }
    return best;
}

// The pairs of a gap, here and there, and their answers.
struct work {
    std::vector<ovoid_body_pair> pairs;
    std::vector<fcl::Transform3d> a, b;
    std::vector<double> distances, their_distances;
    std::vector<int> hits, their_hits;
};

template <class Volume> std::function<void()> make_collide(work &w, const std::shared_ptr<fcl::BVHModel<Volume>> &m) {
    return [&w, &m] {
        for (std::size_t i = 0; i < w.pairs.size(); i++) {
            fcl::CollisionResultd result;
            w.their_hits[i] = fcl::collide(m.get(), w.a[i], m.get(), w.b[i], fcl::CollisionRequestd(), result) > 0;
        }
    };
}

template <class Volume> std::function<void()> make_distance(work &w, const std::shared_ptr<fcl::BVHModel<Volume>> &m) {
    return [&w, &m] {
        for (std::size_t i = 0; i < w.pairs.size(); i++) {
            fcl::DistanceResultd result;
            w.their_distances[i] = fcl::distance(m.get(), w.a[i], m.get(), w.b[i], fcl::DistanceRequestd(), result);
        }
    };
}

work make_work(const ovoid_solid *s, double gap, std::size_t count) {
    random_numbers numbers;
    work w;
    for (std::size_t i = 0; i < count; i++) {
        w.pairs.push_back(make_pair_at(s, gap, numbers));
        w.a.push_back(make_transform(w.pairs.back().a.pose));
        w.b.push_back(make_transform(w.pairs.back().b.pose));
    }
    w.distances.resize(count), w.their_distances.resize(count), w.hits.resize(count), w.their_hits.resize(count);
    return w;
}

bool run(const ovoid_solid *s, const models &m, std::size_t count, cells &all) {
    const double gap = all.gap;
    work w = make_work(s, gap, count);
    const times collide = measure(
        count,
        [&] {
            for (std::size_t i = 0; i < count; i++)
                w.hits[i] = ovoid_body_collide(&w.pairs[i], nullptr, nullptr).status == OVOID_OVERLAPPING;
        },
        make_collide(w, m.collide), make_collide(w, m.both));
    times distance = {NAN, {NAN, NAN}};
    if (gap > 0)
        distance = measure(
            count,
            [&] {
                for (std::size_t i = 0; i < count; i++)
                    w.distances[i] = std::fmax(0, ovoid_body_distance(&w.pairs[i], nullptr, nullptr).upper);
            },
            make_distance(w, m.distance), make_distance(w, m.both));
    double off = 0;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < count && gap > 0; i++)
        off = std::fmax(off, std::fabs(w.distances[i] - w.their_distances[i]));
    for (std::size_t i = 0; i < count; i++) differ += w.hits[i] != w.their_hits[i];
    std::printf("  %4.0f %%  %9.2f %9.2f %9.2f %6.2f  %9.2f %9.2f %9.2f %6.2f  %.0e %zu\n", 100 * gap, distance.own,
                distance.theirs[0], distance.theirs[1], distance.ratio(), collide.own, collide.theirs[0],
                collide.theirs[1], collide.ratio(), off, differ);
    if (gap > 0) all.distance.push_back(distance.ratio());
    all.collide.push_back(collide.ratio());
    return off < 1e-6 && differ == 0;
}

bool run_mesh(mesh m, std::size_t pairs, std::vector<cells> &all) {
    scale(m);
    const ovoid_triangles given = {m.points.data(), m.points.size() / 3, m.triangles.data(), m.triangles.size() / 3};
    const auto t0 = get_seconds();
    ovoid_solid *s = ovoid_solid_create_from_triangles(&given, nullptr, nullptr);
    const auto t1 = get_seconds();
    models theirs;
    theirs.both = make_model<fcl::OBBRSSd>(m);
    const auto t2 = get_seconds();
    theirs.collide = make_model<fcl::OBBd>(m);
    const auto t3 = get_seconds();
    theirs.distance = make_model<fcl::RSSd>(m);
    if (!s) return false;
    std::printf("%s: %zu triangles, %s; set-up %.1f ms, FCL's %.1f (OBBRSS) and %.1f (OBB); %.0f bytes a triangle\n",
                m.name.c_str(), given.count, ovoid_solid_get_report(s).is_closed ? "closed" : "open", 1e3 * (t1 - t0),
                1e3 * (t2 - t1), 1e3 * (t3 - t2),
                static_cast<double>(ovoid_solid_get_size(s)) / static_cast<double>(given.count));
    bool ok = true;
    for (cells &gap : all) ok &= run(s, theirs, pairs, gap);
    ovoid_solid_destroy(s);
    return ok;
}

void print_cells(double gap, const char *what, std::vector<double> ratios) {
    if (ratios.empty()) return;
    std::sort(ratios.begin(), ratios.end());
    const auto below = [&](double least) {
        return std::lower_bound(ratios.begin(), ratios.end(), least) - ratios.begin();
    };
    std::printf("  %4.0f %%  %-9s  median %5.2f, least %5.2f; below 2: %td, below 1: %td of %zu\n", 100 * gap, what,
                ratios[ratios.size() / 2], ratios[0], below(2), below(1), ratios.size());
}

// The meshes of the collection that the tests use; what is absent is said and left out.
void add_collection(const std::string &folder, std::vector<mesh> &meshes) {
    static const char *const files[] = {"scans/duck.obj",
                                        "scans/teddy.obj",
                                        "scans/bunny.obj",
                                        "robots/solo12/meshes/stl/solo12/solo_12_base.stl",
                                        "robots/solo12/meshes/stl/solo12/solo12_hip_fe_fl.stl",
                                        "robots/solo12/meshes/stl/with_foot/solo_upper_leg_left_side.stl",
                                        "robots/solo12/meshes/stl/with_foot/solo_lower_leg_left_side.stl",
                                        "robots/panda/meshes/collision/link6.stl",
                                        "robots/kinova_jaco/meshes/forearm.dae",
                                        "robots/kinova_jaco/meshes/base.dae",
                                        "robots/fetch_mbm/meshes/torso_fixed_link.STL",
                                        "robots/fetch_mbm/meshes/bellows_link_collision.STL"};
    for (const char *file : files) {
        const std::string path = folder + "/" + file;
        mesh m;
        if (!read_mesh(path, m)) {
            std::printf("%s is left out\n", path.c_str());
            continue;
        }
        m.name = path.substr(path.find_last_of('/') + 1);
        meshes.push_back(m);
    }
}

mesh name(mesh m, const char *as) {
    m.name = as;
    return m;
}

} // namespace

int main(int argc, char **argv) {
    long pairs = 40;
    std::vector<mesh> meshes;
    bool is_small = false;
    for (int i = 1; i < argc; i++) {
        const std::string given = argv[i];
        if (given == "--help") {
            std::printf(
                "bench_solids [--pairs N] [--small] [--data FOLDER] [MESH...]: queries of solids beside FCL, N (40) "
                "pairs of each gap.\nKnots and bumpy spheres of 5 000 and 50 000 triangles (--small: of 5 000), twelve "
                "scans and robots' links\nof a collection's folder, and the meshes given.\nColumns: gap; microseconds "
                "of a distance, FCL's with RSS and OBBRSS, the faster over ovoid's; the same for\nyes or no with OBB "
                "and OBBRSS; the largest difference of distances, and how many hits differ\n");
            return 0;
        }
        if (given == "--pairs" && i + 1 < argc && (pairs = std::atol(argv[++i])) > 0) continue;
        if (given == "--data" && i + 1 < argc) {
            add_collection(argv[++i], meshes);
            continue;
        }
        if (given == "--small") {
            is_small = true;
            continue;
        }
        mesh m;
        if (given[0] == '-' || !read_mesh(given, m)) {
            (void)std::fprintf(stderr, "bench_solids: %s is no option and no mesh; see --help\n", argv[i]);
            return 2;
        }
        m.name = given.substr(given.find_last_of('/') + 1);
        meshes.push_back(m);
    }
    if (!is_small) {
        meshes.insert(meshes.begin(), name(make_bumpy(50000), "bumpy sphere"));
        meshes.insert(meshes.begin(), name(make_knot(500, 48), "knot"));
    }
    meshes.insert(meshes.begin(), name(make_bumpy(5000), "bumpy sphere"));
    meshes.insert(meshes.begin(), name(make_knot(160, 16), "knot"));
    std::vector<cells> all = {{1, {}, {}}, {0.1, {}, {}}, {0.01, {}, {}}, {0, {}, {}}};
    bool ok = true;
    for (const mesh &m : meshes) ok &= run_mesh(m, static_cast<std::size_t>(pairs), all);
    std::printf("FCL's time over ovoid's\n");
    for (const cells &gap : all) {
        print_cells(gap.gap, "distance", gap.distance);
        print_cells(gap.gap, "yes or no", gap.collide);
    }
    return !ok;
}
