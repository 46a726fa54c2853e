/**
 * @file parts.hpp
 * The parts of two bodies that may touch, for <ovoid/fcl.hpp>: triangles of meshes, found by trees of boxes, and
 * shapes.
 */
#ifndef OVOID_FCL_PARTS_HPP
#define OVOID_FCL_PARTS_HPP

#include "ovoid/fcl/body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace ovoid {
namespace fcl {
namespace detail {

/// Two bodies at their poses; shapes are prepared there.
struct body_couple {
    const body *a, *b;
    ovoid_prepared_shape at_a, at_b;

    const ovoid_pose &pose_a() const { return at_a.body.pose; }
    const ovoid_pose &pose_b() const { return at_b.body.pose; }
    ovoid_pair pieces(std::uint32_t i, std::uint32_t j) const { return {a->piece(i), b->piece(j), pose_a(), pose_b()}; }
    ovoid_pair shapes() const { return {a->shape(), b->shape(), pose_a(), pose_b()}; }
    ovoid_prepared_pair prepared() const { return {&at_a, &at_b}; }
    ovoid_body_pair bodies() const {
        return {{a->shape(), nullptr, pose_a(), a->solid()}, {b->shape(), nullptr, pose_b(), b->solid()}};
    }
    bool has_mesh() const { return a->solid() || b->solid(); }
};

/// A triangle, or the box of a shape: its centre and half axes.
struct flat_part {
    ovoid_vec3 at[4];
    bool is_box;
};

/// Which parts of two bodies cannot touch, in the frame of a. What is left undecided is few roundings.
class part_test {
  public:
    explicit part_test(const body_couple &of) : a_(of.a), b_(of.b) {
        const ovoid_pose inverse = ovoid_pose_compute_inverse(&of.pose_a());
        const ovoid_pose b_in_a = ovoid_pose_compute_product(&inverse, &of.pose_b());
        ovoid_pose_compute_matrix(&b_in_a, turn_);
        const double at[3] = {b_in_a.position.x, b_in_a.position.y, b_in_a.position.z};
        for (int i = 0; i < 3; i++) at_[i] = at[i], spread_at_[i] = spread(at[i]);
        // Rounding: a part in 1e12 of every length that enters the sums.
        for (int i = 0; i < 9; i++) {
            spread_turn_[i] = spread(turn_[i]);
            spread_size_[i] = spread(std::fabs(turn_[i]) + 1e-12);
        }
        reach_ = 1e-12 * (std::fabs(at[0]) + std::fabs(at[1]) + std::fabs(at[2]));
    }
    /// May the boxes have a common point? Separating axes are the axes of both frames.
    bool operator()(const centered_box &a, const centered_box &b) const { return (*this)(a, b, a, b).first; }
#if defined(__GNUC__)
    // The compiler's own vectors, which it has for every processor: a lane for each pair.
    std::pair<bool, bool> operator()(const centered_box &a, const centered_box &b, const centered_box &c,
                                     const centered_box &d) const {
        number ca[3], ha[3], cb[3], hb[3];
        for (int k = 0; k < 3; k++) {
            ca[k] = number{a.center[k], c.center[k]}, ha[k] = number{a.half[k], c.half[k]};
            cb[k] = number{b.center[k], d.center[k]}, hb[k] = number{b.half[k], d.half[k]};
        }
        const flags beyond = are_beyond(ca, ha, cb, hb, number{a.size + b.size, c.size + d.size});
        return {!beyond[0], !beyond[1]};
    }
#else
    std::pair<bool, bool> operator()(const centered_box &a, const centered_box &b, const centered_box &c,
                                     const centered_box &d) const {
        return {!are_beyond(a.center, a.half, b.center, b.half, a.size + b.size),
                !are_beyond(c.center, c.half, d.center, d.half, c.size + d.size)};
    }
#endif

    /// May triangle i of a, or the shape, and triangle j of b touch? Not if the plane of one is beside the other.
    bool may_touch(std::uint32_t i, std::uint32_t j) const {
        const flat_part x = get_part(*a_, i), y = turn(get_part(*b_, j));
        return !(a_->solid() && is_beside(x, y)) && !(b_->solid() && is_beside(y, x));
    }

  private:
#if defined(__GNUC__)
    using number = double __attribute__((vector_size(16)));
    using flags = std::int64_t __attribute__((vector_size(16)));
    static number spread(double x) { return number{x, x}; }
    static number get_abs(const number &x) {
        const std::int64_t rest = std::numeric_limits<std::int64_t>::max();
        flags bits;
        std::memcpy(&bits, &x, sizeof bits);
        bits &= flags{rest, rest};
        number to;
        std::memcpy(&to, &bits, sizeof to);
        return to;
    }
#else
    using number = double;
    using flags = bool;
    static number spread(double x) { return x; }
    static number get_abs(number x) { return std::fabs(x); }
#endif
    /// Are boxes apart along an axis? By their centres, halves and sizes.
    flags are_beyond(const number (&ca)[3], const number (&ha)[3], const number (&cb)[3], const number (&hb)[3],
                     const number &size) const {
        const number far = reach_ + 1e-12 * size, *m = spread_turn_, *s = spread_size_;
        number between[3];
        for (int i = 0; i < 3; i++)
            between[i] = spread_at_[i] + m[3 * i] * cb[0] + m[3 * i + 1] * cb[1] + m[3 * i + 2] * cb[2] - ca[i];
        flags beyond = far < -far;
        for (int i = 0; i < 3; i++)
            beyond |=
                get_abs(between[i]) > ha[i] + s[3 * i] * hb[0] + s[3 * i + 1] * hb[1] + s[3 * i + 2] * hb[2] + far;
        for (int i = 0; i < 3; i++) {
            const number along = m[i] * between[0] + m[3 + i] * between[1] + m[6 + i] * between[2];
            beyond |= get_abs(along) > hb[i] + s[i] * ha[0] + s[3 + i] * ha[1] + s[6 + i] * ha[2] + 2 * far;
        }
        return beyond;
    }

    static ovoid_vec3 subtract(const ovoid_vec3 &x, const ovoid_vec3 &y) { return {x.x - y.x, x.y - y.y, x.z - y.z}; }
    static double dot(const ovoid_vec3 &x, const ovoid_vec3 &y) { return x.x * y.x + x.y * y.y + x.z * y.z; }
    static double sum(const ovoid_vec3 &x) { return std::fabs(x.x) + std::fabs(x.y) + std::fabs(x.z); }
    static flat_part get_part(const body &of, std::uint32_t i) {
        flat_part part{};
        if (of.solid()) {
            of.get_triangle(i, part.at);
            return part;
        }
        const centered_box &box = of.tree().boxes[0];
        part.is_box = true;
        part.at[0] = {box.center[0], box.center[1], box.center[2]};
        part.at[1].x = box.half[0], part.at[2].y = box.half[1], part.at[3].z = box.half[2];
        return part;
    }
    flat_part turn(flat_part part) const {
        for (int k = 0; k < 3 + part.is_box; k++) {
            const ovoid_vec3 v = part.at[k];
            const double off = part.is_box && k > 0 ? 0 : 1;
            part.at[k] = {turn_[0] * v.x + turn_[1] * v.y + turn_[2] * v.z + off * at_[0],
                          turn_[3] * v.x + turn_[4] * v.y + turn_[5] * v.z + off * at_[1],
                          turn_[6] * v.x + turn_[7] * v.y + turn_[8] * v.z + off * at_[2]};
        }
        return part;
    }
    bool is_beside(const flat_part &triangle, const flat_part &other) const {
        const ovoid_vec3 &o = triangle.at[0], u = subtract(triangle.at[1], o), v = subtract(triangle.at[2], o);
        const ovoid_vec3 n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        double far = sum(o) + reach_ * 1e12, low = dot(n, subtract(other.at[0], o)), high = low;
        for (int k = 0; k < 3 + other.is_box; k++) far += sum(other.at[k]);
        if (other.is_box) {
            const double reach =
                std::fabs(dot(n, other.at[1])) + std::fabs(dot(n, other.at[2])) + std::fabs(dot(n, other.at[3]));
            low -= reach, high += reach;
        }
        for (int k = 1; k < 3 && !other.is_box; k++) {
            const double along = dot(n, subtract(other.at[k], o));
            low = std::min(low, along), high = std::max(high, along);
        }
        // Rounding: a part in 1e12 of every length, as of boxes.
        const double least = 1e-12 * sum(u) * sum(v) * far;
        return low > least || high < -least;
    }

    const body *a_, *b_;
    double turn_[9], at_[3], reach_;
    number spread_turn_[9], spread_at_[3];
    number spread_size_[9]; ///< the sizes of the entries of the rotation
};

/// Goes through the pairs of a triangle (or the shape) of a and one of b that may touch, until `take` returns true:
/// first that of an answer, then those near to it in the trees.
template <class Take> void search_pairs(const body_couple &of, const ovoid_body_answer &answer, Take take) {
    const box_tree &a = of.a->tree(), &b = of.b->tree();
    const part_test test(of);
    const auto take_leaves = [&](std::size_t i, std::size_t j) {
        return test.may_touch(a.order[i], b.order[j]) && take(a.order[i], b.order[j]);
    };
    const leaf_pair first = {a.find(answer.part_a), b.find(answer.part_b)};
    pair_search(a.boxes.data(), b.boxes.data(), test, take_leaves, first)
        .visit({0, 0, a.order.size()}, {0, 0, b.order.size()});
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
