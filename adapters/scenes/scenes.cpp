/// @file scenes.cpp
/// The scenes: a tower at rest, a pile of hulls in a bowl, dominoes, needles and plates, tops, gears, and boxes whose
/// faces are nearly flush.
#include "scenes/scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <stdexcept>

namespace scenes {

namespace {

constexpr double gravity = 9.81;
constexpr double pi = 3.14159265358979323846;

ovoid_pose place(double x, double y, double z) { return {{x, y, z}, {1, 0, 0, 0}}; }

ovoid_pose turned(ovoid_vec3 at, ovoid_vec3 axis, double angle) {
    ovoid_pose made;
    ovoid_pose_make_axis_angle(at, axis, angle, &made);
    return made;
}

/// Numbers in [low, high), the same on every machine: the engine of the standard is exact, its distributions are not.
class dice {
  public:
    explicit dice(unsigned seed) : bits_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * (bits_() / 4294967296.0); }
    ovoid_quat rotation() {
        ovoid_quat q = {};
        double square = 0;
        while (square < 0.01 || square > 1) {
            q = {(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)};
            square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
        }
        const double length = std::sqrt(square);
        return {q.w / length, q.x / length, q.y / length, q.z / length};
    }

  private:
    std::mt19937 bits_;
};

std::size_t add_part(scene &to, part made) {
    to.parts.push_back(std::move(made));
    return to.parts.size() - 1;
}

std::size_t add_box(scene &to, double x, double y, double z) { return add_part(to, {kind::box, {x, y, z}, {}}); }

/// A body of one part with that mass, and the inertia of its solid.
body &add_body(scene &to, std::size_t of, const ovoid_pose &pose, double mass) {
    body made;
    made.parts = {{of, ovoid_pose_make_identity()}};
    made.pose = pose;
    made.mass = mass;
    const ovoid::shape shape = make_shape(to.parts[of], 0);
    const ovoid_measures m = shape.measures();
    const double density = m.volume > 0 ? mass / m.volume : 0;
    made.inertia = {m.inertia.xx * density, m.inertia.yy * density, m.inertia.zz * density};
    if (density == 0) made.inertia = {0.1 * mass, 0.1 * mass, 0.1 * mass}; // of a sphere, a capsule: near enough
    to.bodies.push_back(made);
    return to.bodies.back();
}

void add_fixed(scene &to, std::size_t of, const ovoid_pose &pose) {
    body made;
    made.parts = {{of, ovoid_pose_make_identity()}};
    made.pose = pose;
    made.moves = motion::fixed;
    to.bodies.push_back(made);
}

/// A floor whose top is z = 0.
void add_floor(scene &to, double reach) { add_fixed(to, add_box(to, reach, reach, 1), place(0, 0, -1)); }

/// A floor with eight slanted walls.
void add_bowl(scene &to, double radius) {
    add_floor(to, 2 * radius);
    const std::size_t wall = add_box(to, 0.25, radius, 1.5 * radius);
    for (int i = 0; i < 8; i++) {
        const double angle = pi / 4 * i;
        const ovoid_pose around = turned({0, 0, 0}, {0, 0, 1}, angle);
        const ovoid_pose slanted = turned({radius + 0.5 * radius, 0, 1.2 * radius}, {0, 1, 0}, 0.5);
        add_fixed(to, wall, ovoid_pose_compute_product(&around, &slanted));
    }
}

/// The points about their hull's centre of mass.
part centred(std::vector<ovoid_vec3> points) {
    part made = {kind::hull, {}, std::move(points)};
    const ovoid::shape shape = make_shape(made, 0);
    const ovoid_vec3 centre = shape.measures().centroid, origin = shape.polytope().origin;
    for (ovoid_vec3 &p : made.points)
        p = {p.x - centre.x - origin.x, p.y - centre.y - origin.y, p.z - centre.z - origin.z};
    return made;
}

part random_hull(dice &roll, int vertices, double radius) {
    std::vector<ovoid_vec3> points;
    while (static_cast<int>(points.size()) < vertices) {
        const ovoid_vec3 p = {roll(-1, 1), roll(-1, 1), roll(-1, 1)};
        const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        if (length < 0.1 || length > 1) continue;
        points.push_back({radius * p.x / length, 0.8 * radius * p.y / length, 0.7 * radius * p.z / length});
    }
    return centred(std::move(points));
}

scene make_tower(bool small) {
    scene made;
    made.seconds = small ? 1 : 60;
    add_floor(made, 10);
    const std::size_t box = add_box(made, 0.5, 0.5, 0.5);
    for (int i = 0; i < 20; i++) add_body(made, box, place(0, 0, 0.5 + i), 1);
    made.fastest = 2; // it stands, and only settles
    return made;
}

scene make_pile(bool small) {
    scene made;
    dice roll(7);
    made.seconds = small ? 0.5 : 4;
    made.size = 0.5;
    const int side = small || most_bodies < 500 ? 4 : 10;
    const int layers = small ? 2 : most_bodies / (side * side);
    add_bowl(made, side == 4 ? 2 : 4);
    std::vector<std::size_t> hulls;
    for (int i = 0; i < 10; i++) hulls.push_back(add_part(made, random_hull(roll, 32, 0.25)));
    for (int i = 0; i < side * side * layers; i++) {
        const double x = i % side - (side - 1) / 2.0, y = i / side % side - (side - 1) / 2.0, z = i / (side * side);
        const ovoid_vec3 at = {0.6 * x + roll(-0.02, 0.02), 0.6 * y + roll(-0.02, 0.02), 0.5 + 0.6 * z};
        add_body(made, hulls[i % hulls.size()], {at, roll.rotation()}, 1);
    }
    // A fall from the top, and as much again for what others give.
    made.fastest = 2 * std::sqrt(2 * gravity * (0.5 + 0.6 * layers));
    return made;
}

scene make_dominoes(bool small) {
    scene made;
    made.seconds = small ? 1 : 10;
    made.size = 0.4;
    add_floor(made, 20);
    const std::size_t stone = add_box(made, 0.04, 0.2, 0.4);
    const int count = small ? 10 : 50;
    for (int i = 0; i < count; i++) {
        // A line with a bend.
        const double along = 0.4 * i, angle = i < count / 2 ? 0 : 0.02 * (i - count / 2);
        add_body(made, stone, turned({along, angle * 2, 0.4}, {0, 0, 1}, angle), 1);
    }
    made.bodies[1].spin = {0, 1.5, 0};
    made.bodies[1].velocity = {0.6, 0, 0};
    // The whole run's fall in one stone would be more; a stone's own fall and a push is what there is.
    made.fastest = 3 * std::sqrt(2 * gravity * 0.4);
    return made;
}

scene make_needles(bool small) {
    scene made;
    dice roll(11);
    made.seconds = small ? 0.5 : 10;
    made.size = 0.5;
    add_bowl(made, 2);
    const std::size_t needle = add_box(made, 0.01, 0.01, 0.5), plate = add_box(made, 0.4, 0.4, 0.01);
    const int count = small ? 12 : 100;
    for (int i = 0; i < count; i++) {
        const ovoid_vec3 at = {roll(-0.7, 0.7), roll(-0.7, 0.7), 0.6 + 0.25 * i};
        body &b = add_body(made, i % 3 ? needle : plate, {at, roll.rotation()}, i % 3 ? 0.2 : 1);
        // Needles about their own axis have next to no inertia; solvers are not what is tried here.
        const double least = 0.02 * std::max({b.inertia.x, b.inertia.y, b.inertia.z});
        b.inertia = {std::max(b.inertia.x, least), std::max(b.inertia.y, least), std::max(b.inertia.z, least)};
    }
    made.fastest = 2 * std::sqrt(2 * gravity * (0.6 + 0.25 * count));
    return made;
}

scene make_tops(bool small) {
    scene made;
    made.seconds = small ? 0.5 : 10;
    made.size = 0.5;
    made.rests = false;
    add_floor(made, 20);
    std::vector<ovoid_vec3> points = {{0, 0, -0.3}};
    for (int i = 0; i < 24; i++) points.push_back({0.3 * std::cos(pi / 12 * i), 0.3 * std::sin(pi / 12 * i), 0.1});
    points.push_back({0, 0, 0.2});
    const std::size_t top = add_part(made, centred(points));
    double lowest = 0;
    for (const ovoid_vec3 &p : made.parts[top].points) lowest = std::min(lowest, p.z);
    const int count = small ? 2 : 16;
    for (int i = 0; i < count; i++) {
        body &b = add_body(made, top, place(0.7 * (i % 4), 0.7 * (i / 4), 0.001 - lowest), 1);
        b.spin = {0.1 * (i % 3), 0, 40.0 + i};
        b.friction = 0.3;
    }
    // A top that falls and rolls off its spin: half of the rim's speed and a fall.
    made.fastest = 0.3 * 56;
    return made;
}

/// A gear of boxes for teeth on a prism, both convex parts.
body make_gear(scene &to, int teeth, double radius, const ovoid_pose &pose) {
    body made;
    std::vector<ovoid_vec3> rim;
    for (int i = 0; i < 2 * teeth; i++)
        for (const double z : {-0.1, 0.1})
            rim.push_back({radius * std::cos(pi / teeth * i), radius * std::sin(pi / teeth * i), z});
    made.parts.push_back({add_part(to, {kind::hull, {}, rim}), ovoid_pose_make_identity()});
    const double half = 0.2 * pi * radius / teeth, length = 0.55 * pi * radius / teeth;
    std::vector<ovoid_vec3> wedge;
    for (const double z : {-0.1, 0.1})
        for (const double side : {-1.0, 1.0}) {
            wedge.push_back({-0.02, side * 1.5 * half, z});
            wedge.push_back({length, side * half * 0.7, z});
        }
    const std::size_t tooth = add_part(to, {kind::hull, {}, wedge});
    for (int i = 0; i < teeth; i++) {
        const double angle = 2 * pi / teeth * i;
        const ovoid_vec3 at = {radius * 0.99 * std::cos(angle), radius * 0.99 * std::sin(angle), 0};
        made.parts.push_back({tooth, turned(at, {0, 0, 1}, angle)});
    }
    made.pose = pose;
    made.moves = motion::axle;
    const double about = 0.5 * radius * radius;
    made.inertia = {about, about, about};
    made.friction = 0.05;
    return made;
}

scene make_gears(bool small) {
    scene made;
    made.seconds = small ? 0.5 : 10;
    made.rests = false;
    const int teeth = 16;
    const double pitch = 2 * pi / teeth;
    for (int i = 0; i < 4; i++) {
        // Every other gear is turned by half a tooth, so that teeth stand in gaps.
        made.bodies.push_back(make_gear(made, teeth, 1, turned({2.17 * i, 0, 0}, {0, 0, 1}, i % 2 ? pitch / 2 : 0)));
    }
    made.bodies[0].spin = {0, 0, 3};
    // The first gear has all of the energy, and all are alike.
    made.fastest = 3 * 1.01;
    return made;
}

/// Boxes face to face, turned against one another by so little that a corner or an edge alone overlaps: where
/// mujoco#3476 had a contact as deep as a box is wide.
scene make_flush(bool small) {
    scene made;
    dice roll(23);
    made.seconds = small ? 0.25 : 2;
    made.size = 0.07;
    add_floor(made, 10);
    const double x = 0.055, y = 0.0355, z = 0.02;
    const std::size_t box = add_box(made, x, y, z);
    const int count = small ? 3 : 9;
    for (int k = 0; k < (small ? 1 : 3); k++)
        for (int i = 0; i < count; i++) {
            const double yaw = roll(-1e-3, 1e-3), gap = roll(-6e-5, 6e-5);
            add_body(
                made, box,
                turned({2 * x * (i / 3) + roll(-1e-4, 1e-4), (2 * y + gap) * (i % 3), z + 2 * z * k}, {0, 0, 1}, yaw),
                0.2);
        }
    made.fastest = 0.5;
    return made;
}

/// A thin, small or plain solid.
part random_part(dice &roll) {
    switch (static_cast<int>(roll(0, 7))) {
    case 0: return {kind::box, {0.5, 0.5, 0.01}, {}};
    case 1: return {kind::box, {0.02, 0.02, 0.6}, {}};
    case 2: return {kind::box, {roll(0.1, 0.5), roll(0.1, 0.5), roll(0.1, 0.5)}, {}};
    case 3:
        if (!has_capsules) return random_hull(roll, 16, 0.5);
        return {kind::capsule, {roll(0.1, 0.3), roll(0.1, 0.5), 0}, {}};
    case 4: return {kind::cylinder, {roll(0.1, 0.5), roll(0.1, 0.5), 0}, {}};
    case 5: return random_hull(roll, 8, 0.5);
    default: return random_hull(roll, 32, 0.5);
    }
}

/// Pairs far from one another, for one step: every other one boxes that are nearly flush, else any two solids so placed
/// that about half of the pairs overlap. What an engine says of poses that nobody has chosen.
scene make_pairs(bool small) {
    scene made;
    static unsigned seed = 0;
    dice roll(++seed);
    made.seconds = made.step;
    made.rests = false;
    const int count = small ? 10 : std::min(100, most_bodies / 2);
    for (int i = 0; i < count; i++) {
        const double x = 10.0 * (i % 10), z = 10.0 * (i / 10) + 10;
        if (i % 2) {
            const ovoid_vec3 half = {roll(0.2, 0.5), roll(0.2, 0.5), roll(0.2, 0.5)};
            const std::size_t box = add_box(made, half.x, half.y, half.z);
            const ovoid_pose at = {{x, 0, z}, roll.rotation()};
            const double tilt = std::pow(10, roll(-9, -2));
            ovoid_pose beside = turned({roll(-0.3, 0.3), 2 * half.y - tilt * roll(0, 1), roll(-0.3, 0.3)},
                                       {roll(-1, 1), roll(-1, 1), roll(-1, 1)}, tilt);
            add_body(made, box, at, 1);
            add_body(made, box, ovoid_pose_compute_product(&at, &beside), 1);
        } else {
            const std::size_t a = add_part(made, random_part(roll)), b = add_part(made, random_part(roll));
            const ovoid_vec3 aside = {roll(-0.6, 0.6), roll(-0.6, 0.6), roll(-0.6, 0.6)};
            add_body(made, a, {{x, 0, z}, roll.rotation()}, 1);
            add_body(made, b, {{x + aside.x, aside.y, z + aside.z}, roll.rotation()}, 1);
        }
    }
    made.fastest = 1e9; // overlaps of any depth are pushed apart at any speed
    return made;
}

const std::map<std::string, std::function<scene(bool)>> &all() {
    static const std::map<std::string, std::function<scene(bool)>> makers = {
        {"tower", make_tower}, {"pile", make_pile},   {"dominoes", make_dominoes}, {"needles", make_needles},
        {"tops", make_tops},   {"gears", make_gears}, {"flush", make_flush},       {"pairs", make_pairs}};
    return makers;
}

} // namespace

std::vector<std::string> list_scenes() {
    return {"tower", "pile", "dominoes", "needles", "tops", "gears", "flush", "pairs"};
}

scene make_scene(const std::string &name, bool small) {
    const auto found = all().find(name);
    if (found == all().end()) throw std::invalid_argument("no such scene: " + name);
    scene made = found->second(small);
    made.name = name;
    return made;
}

ovoid::shape make_shape(const part &from, double margin) {
    ovoid::shape_options options;
    switch (from.is) {
    case kind::box: return ovoid::shape::box(from.size);
    case kind::sphere: return ovoid::shape::sphere(from.size.x);
    case kind::capsule: return ovoid::shape::capsule(from.size.x, from.size.y);
    case kind::cylinder: return ovoid::shape::cylinder(from.size.x, from.size.y);
    case kind::hull: break;
    }
    options.radius = margin;
    return ovoid::shape::from_points(from.points, options);
}

} // namespace scenes
