/// @file main.cpp
/// Runs scenes in an engine, with its own narrow phase and with ovoid's, and prints a table.
///
///     scenes_ENGINE [--smoke] [--seconds S] [--write FILE.json] [SCENE...]
///
/// --write: the last scene where it ends with ovoid's narrow phase, for `ovoid check FILE.json --contacts`.
/// Both sides step in turn, fifty steps each, so that a busy machine burdens both; the time is the processor's. The
/// exact queries are outside of it, in every twentieth step.
#include "scenes/measure.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>

namespace scenes {

namespace {

double read_clock() {
    timespec t = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double apart(ovoid_vec3 p, ovoid_vec3 q) { return std::hypot(p.x - q.x, p.y - q.y); }

/// One side of a run: an engine, and what it showed so far.
class side {
  public:
    side(const scene &of, const truth &exact, bool ours)
        : scene_(&of), truth_(&exact), engine_(create_engine(of, ours)) {
        engine_->read_state(before_);
        first_ = before_;
        found_.energy_begin = truth_->energy(before_);
    }

    void run(std::uint64_t steps, std::uint64_t all) {
        for (std::uint64_t i = 0; i < steps; i++) {
            const double begin = read_clock();
            engine_->step();
            found_.seconds += read_clock() - begin;
            state after;
            engine_->read_state(after);
            if (found_.steps % 20 == 0) look(after);
            const double squares = look_at_speeds(*scene_, after, found_);
            if (10 * found_.steps >= 9 * all) squares_ += squares, looked_++;
            before_ = std::move(after);
            found_.steps++;
        }
    }

    const state &last() const { return before_; }

    const findings &finish() {
        std::size_t moving = 0;
        for (std::size_t i = 0; i < before_.poses.size(); i++) {
            if (scene_->bodies[i].moves == motion::fixed) continue;
            moving++;
            found_.drift = std::max(found_.drift, apart(before_.poses[i].position, first_.poses[i].position));
        }
        found_.jitter = std::sqrt(squares_ / static_cast<double>(std::max<std::size_t>(1, looked_ * moving)));
        found_.energy_end = truth_->energy(before_);
        return found_;
    }

  private:
    void look(const state &after) {
        std::vector<touch> touches;
        engine_->read_touches(touches);
        truth_->compare(before_, touches, found_);
        found_.energy_gain = std::max(found_.energy_gain, truth_->energy(after) - found_.energy_begin);
    }

    const scene *scene_;
    const truth *truth_;
    std::unique_ptr<engine> engine_;
    state before_, first_;
    findings found_;
    double squares_ = 0;
    std::size_t looked_ = 0;
};

void print(const scene &of, const char *who, const findings &f) {
    std::printf("| %s | %s | %llu | %llu (%.2g) | %llu (%.2g) | %zu (%.2g) | %.2g | %.2g | %.3g | %.0f |\n",
                of.name.c_str(), who, static_cast<unsigned long long>(f.pairs),
                static_cast<unsigned long long>(f.phantoms), f.worst_phantom, static_cast<unsigned long long>(f.lost),
                f.worst_lost, f.ejected.size(), f.fastest, f.drift, f.jitter, f.energy_gain,
                f.seconds > 0 ? static_cast<double>(f.steps) / f.seconds : 0.0);
    std::fflush(stdout);
}

/// A hull as an OFF file.
void write_mesh(const part &of, const std::string &path) {
    const ovoid::shape shape = make_shape(of, 0);
    const ovoid_polytope hull = shape.polytope();
    std::ofstream file(path);
    file.precision(17);
    file << "OFF\n" << hull.vertex_count << ' ' << hull.triangle_count << " 0\n";
    for (std::uint32_t i = 0; i < hull.vertex_count; i++) {
        const double *v = hull.vertices + 3 * std::size_t(i);
        file << v[0] + hull.origin.x << ' ' << v[1] + hull.origin.y << ' ' << v[2] + hull.origin.z << '\n';
    }
    for (std::uint32_t i = 0; i < hull.triangle_count; i++) {
        const std::uint32_t *t = hull.triangles + 3 * std::size_t(i);
        file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    }
}

/// The free bodies that are a box or a hull, as a scene of ovoid; without those that are fixed, as walls would hide
/// the others.
void write_scene(const scene &of, const state &at, const std::string &path) {
    std::ofstream file(path);
    file.precision(17);
    std::vector<bool> is_written(of.parts.size());
    file << "{\"objects\": [";
    for (std::size_t i = 0, count = 0; i < of.bodies.size(); i++) {
        const body &b = of.bodies[i];
        const std::size_t number = b.parts[0].part;
        const part &p = of.parts[number];
        if (b.moves != motion::free || b.parts.size() != 1 || (p.is != kind::box && p.is != kind::hull)) continue;
        const std::string mesh = path + "." + std::to_string(number) + ".off";
        if (p.is == kind::hull && !is_written[number]) write_mesh(p, mesh);
        is_written[number] = true;
        file << (count++ ? ",\n " : "\n ") << "{\"name\": \"" << i << "\", ";
        if (p.is == kind::hull)
            file << "\"mesh\": \"" << mesh.substr(mesh.rfind('/') + 1) << "\", \"radius\": " << hull_margin * of.size;
        else
            file << "\"box\": [" << 2 * p.size.x << ", " << 2 * p.size.y << ", " << 2 * p.size.z << ']';
        const ovoid_pose &pose = at.poses[i];
        file << ", \"pose\": {\"xyz\": [" << pose.position.x << ", " << pose.position.y << ", " << pose.position.z
             << "], \"quat_wxyz\": [" << pose.rotation.w << ", " << pose.rotation.x << ", " << pose.rotation.y << ", "
             << pose.rotation.z << "]}}";
    }
    file << "\n]}\n";
}

void add(const findings &from, findings &to) {
    to.pairs += from.pairs, to.phantoms += from.phantoms, to.lost += from.lost, to.steps += from.steps;
    to.worst_phantom = std::max(to.worst_phantom, from.worst_phantom);
    to.worst_lost = std::max(to.worst_lost, from.worst_lost);
}

/// Many scenes of pairs, one step each. True if nothing was wrong on ours.
bool run_pairs(bool small) {
    std::array<findings, 2> sums;
    scene of;
    for (int round = 0; round < (small ? 2 : 100); round++) {
        of = make_scene("pairs", small);
        const truth exact(of);
        for (std::size_t who = 0; who < 2; who++) {
            side one(of, exact, who == 1);
            one.run(1, 1);
            add(one.finish(), sums[who]);
        }
    }
    print(of, engine_name, sums[0]);
    print(of, "ovoid", sums[1]);
    return sums[1].phantoms == 0 && sums[1].lost == 0;
}

/// What is asked for.
struct request {
    bool small = false;
    double seconds = 0;  ///< 0: those of the scene
    std::string written; ///< the path of a scene; empty: none
};

/// Both sides of a scene. True if nothing was wrong on ours.
bool run(const std::string &name, const request &asked) {
    if (name == "pairs") return run_pairs(asked.small);
    scene of = make_scene(name, asked.small);
    if (asked.seconds > 0) of.seconds = asked.seconds;
    const truth exact(of);
    std::array<side, 2> sides = {side(of, exact, false), side(of, exact, true)};
    const auto all = static_cast<std::uint64_t>(std::ceil(of.seconds / of.step));
    for (std::uint64_t done = 0; done < all; done += 50)
        for (side &s : sides) s.run(std::min<std::uint64_t>(50, all - done), all);
    print(of, engine_name, sides[0].finish());
    const findings &ours = sides[1].finish();
    print(of, "ovoid", ours);
    if (!asked.written.empty()) write_scene(of, sides[1].last(), asked.written);
    return ours.phantoms == 0 && ours.lost == 0 && ours.ejected.empty();
}

int run_all(int count, char **names) {
    bool right = true;
    request how;
    std::vector<std::string> asked;
    for (int i = 1; i < count; i++) {
        if (std::strcmp(names[i], "--smoke") == 0)
            how.small = true;
        else if (std::strcmp(names[i], "--seconds") == 0 && i + 1 < count)
            how.seconds = std::atof(names[++i]);
        else if (std::strcmp(names[i], "--write") == 0 && i + 1 < count)
            how.written = names[++i];
        else
            asked.push_back(names[i]);
    }
    std::printf(
        "| scene | narrow phase | pairs asked | phantom (worst, m) | lost (worst, m) | ejected (fastest, m/s) | drift, "
        "m "
        "| jitter, m/s | energy gained, J | steps a second |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const std::string &name : asked.empty() ? list_scenes() : asked) right = run(name, how) && right;
    return right ? 0 : 1;
}

} // namespace

} // namespace scenes

int main(int count, char **names) {
    try {
        return scenes::run_all(count, names);
    } catch (const std::exception &e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 2;
    }
}
