// Solids compared with FCL's BVHModel<OBBRSS>, in one run: bumpy spheres of about 5 000 and 50 000 triangles, at gaps
// of 10 % and 1 % of their diameter of 2, and overlapping by about a quarter of it, in random rotations. Both answer
// the same pairs in turns, the best of several passes each; distances and hits are compared and have to agree.
// Distances are computed to a relative tolerance of 1e-9 here, to FCL's default there. `bench_solids [TRIANGLES
// [PAIRS]]`.
#include <fcl/fcl.h>
#include <ovoid/ovoid.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

namespace {

using clock_type = std::chrono::steady_clock;
using model = fcl::BVHModel<fcl::OBBRSSd>;

struct mesh {
    std::vector<double> points;
    std::vector<std::uint32_t> triangles;
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

std::shared_ptr<model> make_model(const mesh &m) {
    std::vector<fcl::Vector3d> points;
    std::vector<fcl::Triangle> triangles;
    for (std::size_t i = 0; i < m.points.size(); i += 3)
        points.emplace_back(m.points[i], m.points[i + 1], m.points[i + 2]);
    for (std::size_t i = 0; i < m.triangles.size(); i += 3)
        triangles.emplace_back(m.triangles[i], m.triangles[i + 1], m.triangles[i + 2]);
    auto made = std::make_shared<model>();
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

// A pair at a gap, found by moving the second body along a line; gap 0: at a distance of 1.2 between the centres.
ovoid_body_pair make_pair_at(const ovoid_solid *s, double gap, random_numbers &numbers) {
    ovoid_body_pair pair = {{nullptr, nullptr, {{0, 0, 0}, numbers.turn()}, s},
                            {nullptr, nullptr, {{0, 0, 0}, numbers.turn()}, s}};
    const ovoid_vec3 n = numbers.direction();
    double at = gap > 0 ? 4 : 1.2;
    for (int i = 0; i < 40; i++) {
        pair.b.pose.position = {at * n.x, at * n.y, at * n.z};
        if (!(gap > 0)) break;
        const ovoid_body_answer x = ovoid_body_distance(&pair, nullptr, nullptr);
        if (std::fabs(x.upper - gap) < 0.02 * gap) break;
        at += x.upper > 0 ? gap - x.upper : 0.05;
    }
    return pair;
}

// The best of seven passes over all pairs, microseconds a pair.
template <class Work> double measure(std::size_t count, Work work) {
    double best = INFINITY;
    for (int pass = 0; pass < 7; pass++) {
        const auto start = clock_type::now();
        work();
        best = std::fmin(best, std::chrono::duration<double>(clock_type::now() - start).count() * 1e6 /
                                   static_cast<double>(count));
    }
    return best;
}

int run(const ovoid_solid *s, const model *m, double gap, std::size_t count) {
    random_numbers numbers;
    std::vector<ovoid_body_pair> pairs;
    std::vector<fcl::Transform3d> a, b;
    for (std::size_t i = 0; i < count; i++) {
        pairs.push_back(make_pair_at(s, gap, numbers));
        a.push_back(make_transform(pairs.back().a.pose));
        b.push_back(make_transform(pairs.back().b.pose));
    }
    double off = 0;
    std::size_t differ = 0;
    std::vector<double> distances(count);
    std::vector<int> hits(count);
    const double distance = measure(count, [&] {
        for (std::size_t i = 0; i < count; i++)
            distances[i] = std::fmax(0, ovoid_body_distance(&pairs[i], nullptr, nullptr).upper);
    });
    const double their_distance = measure(count, [&] {
        for (std::size_t i = 0; i < count; i++) {
            fcl::DistanceResultd result;
            off = std::fmax(off,
                            std::fabs(std::fmax(0, fcl::distance(m, a[i], m, b[i], fcl::DistanceRequestd(), result)) -
                                      distances[i]));
        }
    });
    const double collide = measure(count, [&] {
        for (std::size_t i = 0; i < count; i++)
            hits[i] = ovoid_body_collide(&pairs[i], nullptr, nullptr).status == OVOID_OVERLAPPING;
    });
    const double their_collide = measure(count, [&] {
        differ = 0;
        for (std::size_t i = 0; i < count; i++) {
            fcl::CollisionResultd result;
            differ += (fcl::collide(m, a[i], m, b[i], fcl::CollisionRequestd(), result) > 0) != hits[i];
        }
    });
    std::printf(
        "  gap %-5g distance %8.1f us, FCL %8.1f (%.2f); yes or no %7.1f us, FCL %7.1f (%.2f); off by %.1e, hits "
        "that differ: %zu\n",
        gap, distance, their_distance, distance / their_distance, collide, their_collide, collide / their_collide, off,
        differ);
    return off < 1e-6 && differ == 0;
}

} // namespace

int main(int argc, char **argv) {
    const long only = argc > 1 ? std::atol(argv[1]) : 0;
    const long wanted = argc > 2 ? std::atol(argv[2]) : 100;
    if (argc > 3 || (argc > 1 && only < 1) || wanted < 1) {
        const bool help = argc == 2 && std::strcmp(argv[1], "--help") == 0;
        (void)std::fprintf(help ? stdout : stderr,
                           "bench_solids [TRIANGLES [PAIRS]]: queries of solids beside FCL; 5000 "
                           "or 50000 triangles alone, PAIRS (100) of each gap\n");
        return help ? 0 : 2;
    }
    const std::size_t pairs = static_cast<std::size_t>(wanted);
    int ok = 1;
    for (long size : {5000L, 50000L}) {
        if (only > 0 && size != only) continue;
        const mesh m = make_bumpy(static_cast<std::size_t>(size));
        const double count = static_cast<double>(m.triangles.size() / 3);
        const auto t0 = clock_type::now();
        const ovoid_triangles all = {m.points.data(), m.points.size() / 3, m.triangles.data(), m.triangles.size() / 3};
        ovoid_solid *s = ovoid_solid_create_from_triangles(&all, nullptr, nullptr);
        const auto t1 = clock_type::now();
        const auto theirs = make_model(m);
        const auto t2 = clock_type::now();
        if (!s) return 1;
        std::printf("%.0f triangles: set-up %.2f us a triangle, FCL %.2f; %.1f bytes a triangle\n", count,
                    std::chrono::duration<double>(t1 - t0).count() * 1e6 / count,
                    std::chrono::duration<double>(t2 - t1).count() * 1e6 / count,
                    static_cast<double>(ovoid_solid_get_size(s)) / count);
        for (double gap : {0.2, 0.02, 0.0}) ok &= run(s, theirs.get(), gap, pairs);
        ovoid_solid_destroy(s);
    }
    return !ok;
}
