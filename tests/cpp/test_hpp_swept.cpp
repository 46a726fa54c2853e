// Swept spheres through the C++ header and in C against a table of answers, bit for bit, which the tests of the Python
// and of the JavaScript package read too, so all faces answer the same. Truth: the table; test_query_swept says of
// these queries whether they are right. --write prints it anew.
//
// A line: two bodies, each the kind, how many numbers, the numbers as Python's constructors take them (of a hull its
// points, whose middle is the origin), the rounding, the pose as xyz and wxyz. Then of collide, distance, depth and
// contact each the status, lower, upper, and how many numbers of a witness there are: points of A and B, the normal.
#include "same.hpp"

#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using ovoid::pose;
using ovoid::swept_sphere;
using ovoid::vec3;

namespace {

const char *const TABLE = OVOID_SOURCE_DIR "/tests/cpp/swept_answers.txt";

struct body {
    std::string kind;
    std::vector<double> sizes;
    double rounding = 0;
    pose at;
};

struct reader {
    std::istringstream words;
    // Streams do not read infinities.
    double number() {
        std::string word;
        words >> word;
        return std::strtod(word.c_str(), nullptr);
    }
    std::vector<double> numbers() {
        std::vector<double> all(static_cast<std::size_t>(number()));
        for (double &x : all) x = number();
        return all;
    }
    body read_body() {
        body b;
        words >> b.kind;
        b.sizes = numbers();
        b.rounding = number();
        const std::vector<double> p = [&] {
            std::vector<double> seven(7);
            for (double &x : seven) x = number();
            return seven;
        }();
        b.at = ovoid_pose{{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}};
        return b;
    }
};

swept_sphere make(const body &b) {
    const std::vector<double> &x = b.sizes;
    if (b.kind == "sphere") return swept_sphere::sphere(x[0], b.at.position);
    if (b.kind == "capsule") return swept_sphere::capsule(x[0], x[1], b.at);
    if (b.kind == "cylinder") return swept_sphere::cylinder(x[0], x[1], b.at);
    if (b.kind == "cone") return swept_sphere::cone(x[0], x[1], b.at);
    if (b.kind == "box") return swept_sphere::box({x[0], x[1], x[2]}, b.at, b.rounding);
    if (b.kind == "ellipsoid") return swept_sphere::ellipsoid({x[0], x[1], x[2]}, b.at);
    return swept_sphere::hull(x.data(), static_cast<std::uint32_t>(x.size() / 3), {}, b.at, b.rounding);
}

// The same in C, by hand.
ovoid_swept_sphere make_in_c(const body &b) {
    double m[9];
    ovoid_pose_compute_matrix(&b.at, m);
    const ovoid_vec3 x = {m[0], m[3], m[6]}, y = {m[1], m[4], m[7]}, z = {m[2], m[5], m[8]};
    const double *s = b.sizes.data();
    const ovoid_vec3 center = b.at.position;
    if (b.kind == "sphere") return {center, s[0], OVOID_SWEPT_POINT, {}, {}, nullptr, 0, nullptr};
    if (b.kind == "capsule") return {center, s[0], OVOID_SWEPT_SEGMENT, {s[1]}, {z}, nullptr, 0, nullptr};
    if (b.kind == "cylinder") return {center, 0, OVOID_SWEPT_CYLINDER, {s[1], s[0]}, {z}, nullptr, 0, nullptr};
    if (b.kind == "cone") return {center, 0, OVOID_SWEPT_CONE, {s[1], s[0]}, {z}, nullptr, 0, nullptr};
    if (b.kind == "box")
        return {center, b.rounding, OVOID_SWEPT_BOX, {s[0], s[1], s[2]}, {x, y, z}, nullptr, 0, nullptr};
    if (b.kind == "ellipsoid")
        return {center, 0, OVOID_SWEPT_ELLIPSOID, {s[0], s[1], s[2]}, {x, y, z}, nullptr, 0, nullptr};
    return {center, b.rounding, OVOID_SWEPT_POINTS, {}, {x, y, z}, s, static_cast<std::uint32_t>(b.sizes.size() / 3),
            nullptr};
}

struct answered {
    ovoid_verdict verdict;
    std::vector<double> witness;
};

answered gather(const ovoid_verdict &v, const ovoid_witness &w) {
    answered a = {v, {}};
    if (std::isnan(w.normal.x)) return a;
    for (const ovoid_vec3 &p : {w.point_a, w.point_b, w.normal}) a.witness.insert(a.witness.end(), {p.x, p.y, p.z});
    return a;
}

template <class Ask> answered ask(const Ask &query) {
    ovoid_witness w = {};
    w.normal.x = NAN;
    const ovoid_verdict v = query(&w);
    return gather(v, w);
}

std::vector<answered> ask_in_cpp(const swept_sphere &a, const swept_sphere &b) {
    return {ask([&](ovoid_witness *) { return ovoid::collide(a, b); }),
            ask([&](ovoid_witness *w) { return ovoid::distance(a, b, w); }),
            ask([&](ovoid_witness *w) { return ovoid::depth(a, b, w); }),
            ask([&](ovoid_witness *w) { return ovoid::contact_depth(a, b, w); })};
}

std::vector<answered> ask_in_c(const ovoid_swept_sphere &a, const ovoid_swept_sphere &b) {
    const ovoid_swept_pair p = {&a, &b};
    return {ask([&](ovoid_witness *) { return ovoid_swept_collide(p); }),
            ask([&](ovoid_witness *w) { return ovoid_swept_distance(p, w); }),
            ask([&](ovoid_witness *w) { return ovoid_swept_depth(p, w); }),
            ask([&](ovoid_witness *w) { return ovoid_swept_contact(p, w); })};
}

std::string write(double x) {
    char text[40];
    std::snprintf(text, sizeof text, " %.17g", x);
    return text;
}

void write_line(const std::string &bodies, const std::vector<answered> &all) {
    std::cout << bodies << " |";
    for (const answered &a : all) {
        std::cout << ' ' << ovoid::name(a.verdict.status) << write(a.verdict.lower) << write(a.verdict.upper) << ' '
                  << a.witness.size();
        for (double x : a.witness) std::cout << write(x);
    }
    std::cout << '\n';
}

void check_line(reader &from, const std::vector<answered> &in_c, const std::vector<answered> &in_cpp) {
    for (std::size_t i = 0; i < in_c.size(); i++) {
        std::string status;
        from.words >> status;
        const double lower = from.number(), upper = from.number();
        CHECK(status == ovoid::name(in_c[i].verdict.status));
        CHECK_EQ(in_c[i].verdict.lower, lower);
        CHECK_EQ(in_c[i].verdict.upper, upper);
        CHECK(in_c[i].witness == from.numbers());
        CHECK(is_same(in_c[i].verdict, in_cpp[i].verdict) && in_c[i].witness == in_cpp[i].witness);
    }
}

} // namespace

int main(int count, char **words) {
    const bool writes = count > 1 && std::string(words[1]) == "--write";
    std::ifstream file(TABLE);
    std::string line;
    int lines = 0;
    for (; std::getline(file, line); lines++) {
        const std::string bodies = line.substr(0, line.find(" |"));
        reader from = {
            std::istringstream(line.substr(0, bodies.size()) + line.substr(std::min(line.size(), bodies.size() + 2)))};
        const body a = from.read_body(), b = from.read_body();
        const std::vector<answered> in_c = ask_in_c(make_in_c(a), make_in_c(b));
        if (writes)
            write_line(bodies, in_c);
        else
            check_line(from, in_c, ask_in_cpp(make(a), make(b)));
    }
    if (writes) return 0;
    CHECK(lines >= 50);
    return check_end();
}
