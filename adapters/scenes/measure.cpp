/// @file measure.cpp
/// Exact queries beside an engine's contacts. Source of truth: ovoid_depth's bracket for each pair of parts.
#include "scenes/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace scenes {

namespace {

constexpr double gravity = 9.81;

double length(ovoid_vec3 v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// The points of a part, for its box.
double reach_of(const ovoid::shape &shape) {
    const ovoid_measures m = shape.measures();
    return length(m.sphere_center) + m.sphere_radius + shape.radius() + shape.allowance().outside;
}

bool can_meet(const body &a, const body &b) { return a.moves != motion::fixed || b.moves != motion::fixed; }

ovoid_box box_of(const body &of, const ovoid_pose &pose, const std::vector<ovoid::shape> &shapes) {
    constexpr double far = std::numeric_limits<double>::infinity();
    ovoid_box box = {{far, far, far}, {-far, -far, -far}};
    for (const placed &p : of.parts) {
        const ovoid::shape &shape = shapes[p.part];
        const ovoid_pose at = ovoid_pose_compute_product(&pose, &p.pose);
        const ovoid_vec3 origin = shape.polytope().origin;
        const double more = shape.radius() + shape.allowance().outside;
        const ovoid::span<const double> xyz = shape.vertices();
        for (std::size_t i = 0; i < xyz.size(); i += 3) {
            const ovoid_vec3 local = {xyz[i] + origin.x, xyz[i + 1] + origin.y, xyz[i + 2] + origin.z};
            const ovoid_vec3 world = ovoid_pose_compute_point(&at, local);
            box.min = {std::min(box.min.x, world.x - more), std::min(box.min.y, world.y - more),
                       std::min(box.min.z, world.z - more)};
            box.max = {std::max(box.max.x, world.x + more), std::max(box.max.y, world.y + more),
                       std::max(box.max.z, world.z + more)};
        }
    }
    return box;
}

bool meet(const ovoid_box &a, const ovoid_box &b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

} // namespace

truth::truth(const scene &of) : scene_(&of) {
    for (const part &p : of.parts) {
        shapes_.push_back(make_shape(p, hull_margin * of.size));
        reach_.push_back(reach_of(shapes_.back()));
    }
}

truth::depth truth::measure(std::size_t a, std::size_t b, const state &at) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    depth least = {far, far};
    ovoid_options options = {};
    options.absolute_tolerance = 1e-7 * scene_->size;
    for (const placed &i : scene_->bodies[a].parts)
        for (const placed &j : scene_->bodies[b].parts) {
            ovoid_pair pair = {shapes_[i.part].get(), shapes_[j.part].get(), {}, {}};
            pair.pose_a = ovoid_pose_compute_product(&at.poses[a], &i.pose);
            pair.pose_b = ovoid_pose_compute_product(&at.poses[b], &j.pose);
            const ovoid_vec3 p = pair.pose_a.position, q = pair.pose_b.position;
            const double gap = length({p.x - q.x, p.y - q.y, p.z - q.z}) - (reach_[i.part] + reach_[j.part]);
            if (gap > 0) {
                least.lower = std::min(least.lower, gap);
                continue;
            }
            const ovoid_answer answer = ovoid_depth(&pair, &options, nullptr, nullptr);
            least = {std::min(least.lower, answer.lower), std::min(least.upper, answer.upper)};
        }
    return least;
}

void truth::compare(const state &at, const std::vector<touch> &touches, findings &to) const {
    const std::size_t count = scene_->bodies.size();
    const double slack = share * scene_->size;
    // The deepest contact of each pair, as the engine has it.
    std::map<std::pair<std::size_t, std::size_t>, double> claimed;
    for (const touch &t : touches) {
        const auto found = claimed.emplace(std::minmax<std::size_t>(t.a, t.b), t.separation).first;
        found->second = std::min(found->second, t.separation);
    }
    std::vector<ovoid_box> boxes(count);
    for (std::size_t i = 0; i < count; i++) boxes[i] = box_of(scene_->bodies[i], at.poses[i], shapes_);
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return boxes[i].min.x < boxes[j].min.x; });
    for (std::size_t k = 0; k < count; k++)
        for (std::size_t m = k + 1; m < count && boxes[order[m]].min.x <= boxes[order[k]].max.x; m++) {
            const auto [a, b] = std::minmax(order[k], order[m]);
            if (!can_meet(scene_->bodies[a], scene_->bodies[b]) || !meet(boxes[a], boxes[b])) continue;
            to.pairs++;
            const depth exact = measure(a, b, at);
            const auto found = claimed.find({a, b});
            if (found == claimed.end()) {
                if (exact.upper < -slack) to.lost++, to.worst_lost = std::max(to.worst_lost, -exact.upper);
                continue;
            }
            const double beyond = exact.lower - found->second;
            if (found->second < 0 && beyond > slack)
                to.phantoms++, to.worst_phantom = std::max(to.worst_phantom, beyond);
            claimed.erase(found);
        }
    // Contacts of pairs whose boxes do not even meet.
    for (const auto &[pair, separation] : claimed)
        if (separation < -slack) to.phantoms++, to.worst_phantom = std::max(to.worst_phantom, -separation);
    to.touches += touches.size();
}

double truth::energy(const state &at) const {
    double sum = 0;
    for (std::size_t i = 0; i < at.poses.size(); i++) {
        const body &b = scene_->bodies[i];
        if (b.moves == motion::fixed) continue;
        ovoid_pose turn = {{0, 0, 0}, at.poses[i].rotation};
        const ovoid_vec3 w = ovoid_pose_compute_local_point(&turn, at.spins[i]);
        const double speed = length(at.velocities[i]);
        sum += 0.5 * (b.inertia.x * w.x * w.x + b.inertia.y * w.y * w.y + b.inertia.z * w.z * w.z);
        if (b.moves == motion::free) sum += b.mass * (0.5 * speed * speed + gravity * at.poses[i].position.z);
    }
    return sum;
}

double look_at_speeds(const scene &of, const state &at, findings &to) {
    double sum = 0;
    for (std::size_t i = 0; i < at.poses.size(); i++) {
        if (of.bodies[i].moves == motion::fixed) continue;
        const double speed = length(of.bodies[i].moves == motion::axle ? at.spins[i] : at.velocities[i]);
        to.fastest = std::max(to.fastest, speed);
        if (!(speed <= of.fastest)) to.ejected.insert(i);
        sum += speed * speed;
    }
    return sum;
}

} // namespace scenes
