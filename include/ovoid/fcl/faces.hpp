/**
 * @file faces.hpp
 * Several contacts of two boxes, of a box and a capsule and of two capsules, for <ovoid/fcl.hpp>: in closed form, from
 * the same numbers as in swept.hpp. The axis of least overlap is one of 15 (S. Gottschalk, M. C. Lin, D. Manocha,
 * OBBTree: a hierarchical structure for rapid interference detection, 1996); the faces that it goes through are
 * projected along it, and one is clipped by the other (I. E. Sutherland, G. W. Hodgman, Reentrant polygon clipping,
 * 1974).
 *
 * The depth is that of the bodies to 1e-10 of their size. What is not sure to that is left to the bodies' shapes.
 */
#ifndef OVOID_FCL_FACES_HPP
#define OVOID_FCL_FACES_HPP

#include "ovoid/fcl/contacts.hpp"
#include "ovoid/fcl/print.hpp"
#include "ovoid/swept.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ovoid {
namespace fcl {
namespace detail {

inline ovoid_vec3 negate(const ovoid_vec3 &v) { return {-v.x, -v.y, -v.z}; }

inline bool has_faces(const ovoid_swept_sphere &s) {
    return s.core == OVOID_SWEPT_SEGMENT || s.core == OVOID_SWEPT_BOX;
}

/// A box and a box or a segment, and the axis of their least overlap.
///
/// Gaps along faces' axes, and along cross products of edges before they are divided by their length, are off by less
/// than EDGE of the size, see swept.c. A cross product is taken only where its gap is greater than those of all faces
/// by more than MARGIN of the size, so faces that lie on one another keep their axis. Be l the length of the cross
/// product. The gap is right to the margin from l = 1e-4 on. Below that it is not taken: where it may be greater, the
/// axis is open, unless it is seen that it cannot be:
/// - it is near the axis of a face: gaps of unit axes that are off by phi differ by phi of the size;
/// - the edges are parallel to 2^-32: turned parallel, no point moves by more than 4 l of the size, and there is no
/// axis
///   then.
class least_overlap {
  public:
    enum sign { apart, open, overlapping };

    least_overlap(const ovoid_swept_sphere &box, const ovoid_swept_sphere &other)
        : a_(box), b_(other), dimension_(other.core == OVOID_SWEPT_BOX ? 3 : 1),
          d_(add_scaled(other.center, box.center, -1)) {
        size_ = std::fabs(d_.x) + std::fabs(d_.y) + std::fabs(d_.z) + a_.half[0] + a_.half[1] + a_.half[2];
        for (int k = 0; k < dimension_; k++) size_ += half_b_[k] = b_.half[k];
    }

    /// Of the cores. Open: they touch or nearly touch, or an axis is open; numbers are NaN or have squares out of
    /// range.
    sign find() {
        if (!(size_ > 1e-50 && size_ < 1e50)) return open;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < dimension_; j++) {
                c_[i][j] = dot(a_.axis[i], b_.axis[j]);
                f_[i][j] = std::fabs(c_[i][j]);
            }
        sign all = take_faces();
        if (all != apart) all = std::min(all, take_edges_of<0>());
        if (all != apart) all = std::min(all, take_edges_of<1>());
        if (all != apart) all = std::min(all, take_edges_of<2>());
        return all;
    }
    /// Of cores that overlap: the gap along the axis, which is below 0.
    double gap() const { return gap_; }
    double size() const { return size_; }
    /// Is the axis that of two edges?
    bool is_of_edges() const { return i_ >= 0 && j_ >= 0; }
    /// The point of A's edge that is nearest to B's, where the axis is that of edges. n: normal().
    ovoid_vec3 find_crossing(const ovoid_vec3 &n) const {
        const ovoid_vec3 of_a = find_edge(a_, a_.half, 3, i_, n),
                         of_b = find_edge(b_, half_b_, dimension_, j_, negate(n));
        const ovoid_vec3 off = add_scaled(of_b, of_a, -1);
        const double cosine = c_[i_][j_], most = a_.half[i_],
                     at = (dot(off, a_.axis[i_]) - cosine * dot(off, b_.axis[j_])) / get_square(i_, j_);
        return add_scaled(of_a, a_.axis[i_], std::max(-most, std::min(most, at)));
    }
    /// The axis, from the box to the other body; of the length 1.
    ovoid_vec3 normal() const {
        const ovoid_vec3 n = i_ < 0 ? b_.axis[j_] : j_ < 0 ? a_.axis[i_] : cross();
        return dot(n, d_) < 0 ? negate(n) : n;
    }

  private:
    static constexpr double DOUBT = 0x1p-34, EDGE = 0x1p-44, MARGIN = 1e-9;

    /// The middle of the edge along axis k that is farthest along n.
    static ovoid_vec3 find_edge(const ovoid_swept_sphere &of, const double *half, int dimension, int k,
                                const ovoid_vec3 &n) {
        ovoid_vec3 at = of.center;
        for (int i = 0; i < dimension; i++)
            if (i != k) at = add_scaled(at, of.axis[i], dot(of.axis[i], n) < 0 ? -half[i] : half[i]);
        return at;
    }
    /// The square of the length of the cross product of two axes.
    double get_square(int i, int j) const {
        static const int next[5] = {0, 1, 2, 0, 1};
        const double x = c_[next[i + 1]][j], y = c_[next[i + 2]][j];
        return x * x + y * y;
    }
    /// The cross product of A's axis i and B's axis j is c_kj a_m - c_mj a_k, also where axes are left-handed.
    ovoid_vec3 cross() const {
        const int k = (i_ + 1) % 3, m = (i_ + 2) % 3;
        const double scale = 1 / std::sqrt(get_square(i_, j_));
        const ovoid_vec3 zero = {0, 0, 0};
        return add_scaled(add_scaled(zero, a_.axis[m], c_[k][j_] * scale), a_.axis[k], -c_[m][j_] * scale);
    }
    sign take_faces() {
        bool is_apart = false, is_open = false;
        const auto take = [&](double gap, int i, int j) {
            is_apart |= gap > DOUBT * size_;
            is_open |= !(gap < -DOUBT * size_);
            if (gap > gap_) gap_ = gap, i_ = i, j_ = j;
        };
        for (int i = 0; i < 3; i++) {
            along_a_[i] = dot(a_.axis[i], d_);
            const double of_b = half_b_[0] * f_[i][0] + half_b_[1] * f_[i][1] + half_b_[2] * f_[i][2];
            take(std::fabs(along_a_[i]) - a_.half[i] - of_b, i, -1);
        }
        for (int j = 0; j < dimension_ && dimension_ == 3; j++) {
            const double of_a = a_.half[0] * f_[0][j] + a_.half[1] * f_[1][j] + a_.half[2] * f_[2][j];
            take(std::fabs(dot(b_.axis[j], d_)) - b_.half[j] - of_a, -1, j);
        }
        return is_apart ? apart : is_open ? open : overlapping;
    }
    /// The edges along A's axis i, which is known to the compiler, as that of B is.
    template <int i> sign take_edges_of() {
        sign all = take_edges(i, 0);
        if (dimension_ == 1) return all;
        all = std::min(all, take_edges(i, 1));
        return std::min(all, take_edges(i, 2));
    }
    OVOID_FCL_INLINE sign take_edges(int i, int j) {
        static const int next[5] = {0, 1, 2, 0, 1};
        const int k = next[i + 1], m = next[i + 2], p = next[j + 1], q = next[j + 2];
        const double square = get_square(i, j);
        if (square < 0x1p-64) return overlapping;
        const double of_a = a_.half[k] * f_[m][j] + a_.half[m] * f_[k][j],
                     of_b = half_b_[p] * f_[i][q] + half_b_[q] * f_[i][p];
        const double gap = std::fabs(c_[k][j] * along_a_[m] - c_[m][j] * along_a_[k]) - of_a - of_b;
        if (gap > EDGE * size_) return apart;
        if (!(gap < -EDGE * size_)) return open;
        const double wanted = gap_ + MARGIN * size_;
        if (square < 1e-8) return may_be_greater(gap, wanted, i, j) ? open : overlapping;
        if (wanted < 0 && gap * gap < wanted * wanted * square) gap_ = gap / std::sqrt(square), i_ = i, j_ = j;
        return overlapping;
    }
    /// May the gap along edges that are nearly parallel be greater than that, or as great as those of faces?
    bool may_be_greater(double gap, double wanted, int i, int j) const {
        static const int next[5] = {0, 1, 2, 0, 1};
        const int k = next[i + 1], m = next[i + 2], p = next[j + 1], q = next[j + 2];
        const double length = std::sqrt(get_square(i, j));
        const double off = std::min(std::min(f_[k][j], f_[m][j]), std::min(f_[i][p], f_[i][q]));
        return off + 0x1p-51 > MARGIN / 2 * length && gap + EDGE * size_ > wanted * length;
    }

    const ovoid_swept_sphere &a_, &b_;
    int dimension_; ///< of B's core
    ovoid_vec3 d_;
    double size_, half_b_[3] = {0, 0, 0}, c_[3][3] = {}, f_[3][3] = {}, along_a_[3] = {}, gap_ = -HUGE_VAL;
    int i_ = -1, j_ = -1; ///< the axis: of A, of B, or the cross product of both
};

/// Corners that are nearer than this part of the size are one, as those of manifolds are.
constexpr double clip_near = 4e-6;

/// A corner of a polygon of contact: its place on the reference face, along the face's axes, and how far the other face
/// is from it along the normal.
struct clip_corner {
    double x, y, separation;
};

/// A polygon of contact. Two corners are a segment.
class clip_polygon {
  public:
    void add(const clip_corner &corner) {
        if (count_ < most) corners_[count_++] = corner;
    }
    int count() const { return count_; }
    const clip_corner &operator[](int i) const { return corners_[i]; }

    /// Keeps the part where the value of a corner, which is linear, is not above 0.
    template <class Value> void cut(const Value &value) {
        double values[most];
        bool is_whole = true;
        for (int i = 0; i < count_; i++) is_whole &= (values[i] = value(corners_[i])) <= 0;
        if (is_whole) return;
        clip_corner old[most];
        const int count = count_;
        std::copy(corners_, corners_ + count, old);
        count_ = 0;
        for (int i = 0; i < count; i++) {
            const int next = i + 1 < count ? i + 1 : 0;
            if (values[i] <= 0) add(old[i]);
            if ((values[i] <= 0) != (values[next] <= 0) && (count != 2 || next != 0))
                add(between(old[i], old[next], values[i] / (values[i] - values[next])));
        }
    }
    /// Of corners that are nearer than that to the next one the deeper one stays.
    void merge(double near) {
        const auto is_near = [near](const clip_corner &a, const clip_corner &b) {
            return std::fabs(a.x - b.x) + std::fabs(a.y - b.y) < near;
        };
        int count = std::min(count_, 1);
        for (int i = 1; i < count_; i++)
            if (!is_near(corners_[count - 1], corners_[i]))
                corners_[count++] = corners_[i];
            else if (corners_[i].separation < corners_[count - 1].separation)
                corners_[count - 1] = corners_[i];
        count_ = count;
        if (count < 2 || !is_near(corners_[0], corners_[count - 1])) return;
        if (corners_[count - 1].separation < corners_[0].separation) corners_[0] = corners_[count - 1];
        count_--;
    }
    /// Four corners: the deepest, the one that is farthest from it, and those farthest to both sides of the line
    /// through them. Then the deepest come first.
    void reduce() {
        if (count_ > 4) {
            sort(1);
            double far = 0, sides[2] = {0, 0};
            int at[2] = {0, 0};
            for (int i = 1; i < count_; i++) {
                const double x = corners_[i].x - corners_[0].x, y = corners_[i].y - corners_[0].y;
                if (x * x + y * y > far) far = x * x + y * y, at[0] = i;
            }
            std::swap(corners_[1], corners_[at[0]]);
            const double x = corners_[1].x - corners_[0].x, y = corners_[1].y - corners_[0].y;
            for (int i = 2; i < count_; i++) {
                const double side = x * (corners_[i].y - corners_[0].y) - y * (corners_[i].x - corners_[0].x);
                const int which = side < 0;
                if (std::fabs(side) > sides[which]) sides[which] = std::fabs(side), at[which] = i;
            }
            const clip_corner others[2] = {corners_[at[0]], corners_[at[1]]};
            count_ = 2;
            for (int i = 0; i < 2; i++)
                if (sides[i] > 0) add(others[i]);
        }
        sort(count_);
    }

  private:
    static constexpr int most = 12; // four, and one of each of five cuts; to rounding a cut may give another one

    static clip_corner between(const clip_corner &a, const clip_corner &b, double part) {
        return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y),
                a.separation + part * (b.separation - a.separation)};
    }
    /// Puts that many of the deepest corners first.
    void sort(int wanted) {
        for (int i = 0; i < wanted; i++)
            for (int k = i + 1; k < count_; k++)
                if (corners_[k].separation < corners_[i].separation) std::swap(corners_[i], corners_[k]);
    }

    int count_ = 0;
    clip_corner corners_[most];
};

/// The face of a core that a normal goes through most steeply, or a segment: its centre and half axes.
struct core_face {
    ovoid_vec3 center, axis[2];
    double half[2];
    double steep; ///< the product of the normal and the face's own; of a segment 0
    ovoid_vec3 own;

    /// n: from the core outward.
    core_face(const ovoid_swept_sphere &of, const ovoid_vec3 &n) {
        center = of.center;
        axis[0] = of.axis[0], half[0] = of.half[0];
        axis[1] = own = {0, 0, 0}, half[1] = steep = 0;
        if (of.core == OVOID_SWEPT_SEGMENT) return;
        int k = 0;
        double along[3];
        for (int i = 0; i < 3; i++) {
            along[i] = dot(n, of.axis[i]);
            if (std::fabs(along[i]) > std::fabs(along[k])) k = i;
        }
        own = along[k] < 0 ? negate(of.axis[k]) : of.axis[k];
        steep = std::fabs(along[k]);
        center = add_scaled(center, own, of.half[k]);
        for (int i = 0; i < 2; i++) {
            const int side = k + 1 + i < 3 ? k + 1 + i : k - 2 + i;
            axis[i] = of.axis[side];
            half[i] = of.half[side];
        }
    }
};

/// The axis along which two bodies overlap least, from the first to the second, and the gap along it.
struct contact_axis {
    ovoid_vec3 normal;
    double gap, size;
    bool is_of_edges;
    ovoid_vec3 crossing; ///< of edges: the point of the first core
};

/// Two bodies with an axis, the first a box: the faces that meet, one projected on the other along the axis.
class face_contact {
  public:
    face_contact(const ovoid_swept_sphere &a, const ovoid_swept_sphere &b, const contact_axis &axis)
        : axis_(axis), face_a_(a, axis.normal), face_b_(b, negate(axis.normal)),
          is_a_(face_a_.steep >= face_b_.steep), radii_{a.radius, b.radius}, is_upright_(is_upright(b)) {}

    /// Do edges cross between faces that are not near to the plane of contact? They touch in one point.
    bool is_crossing() const {
        return axis_.is_of_edges && std::min(face_a_.steep, face_b_.steep > 0 ? face_b_.steep : 1) < 0.98;
    }
    ovoid_manifold_point get_crossing() const {
        return {axis_.crossing, add_scaled(axis_.crossing, axis_.normal, axis_.gap), axis_.gap, 0};
    }
    /// The polygon of contact, at most four corners, deepest first; false if it does not reach as deep as the axis
    /// says.
    bool find(clip_polygon &to) {
        const core_face &on = is_a_ ? face_a_ : face_b_;
        set_corners(to);
        const double slack = 0x1p-40 * axis_.size;
        for (int k = 0; k < 2; k++) {
            const double most = on.half[k] + slack;
            const auto get = [k](const clip_corner &c) { return k == 0 ? c.x : c.y; };
            to.cut([&](const clip_corner &c) { return get(c) - most; });
            to.cut([&](const clip_corner &c) { return -get(c) - most; });
        }
        to.cut([](const clip_corner &c) { return c.separation; });
        to.merge(clip_near * axis_.size);
        to.reduce();
        off_ = to.count() > 0 ? axis_.gap - to[0].separation : HUGE_VAL;
        return std::fabs(off_) <= 1e-9 * axis_.size;
    }
    /// A corner as a point of both bodies. The first one has the depth of the bodies.
    ovoid_manifold_point get_point(const clip_corner &c) const {
        const core_face &on = is_a_ ? face_a_ : face_b_;
        const ovoid_vec3 core = add_scaled(add_scaled(on.center, on.axis[0], c.x), on.axis[1], c.y);
        const ovoid_vec3 here = add_scaled(core, axis_.normal, is_a_ ? radii_[0] : -radii_[1]);
        const ovoid_vec3 there = add_scaled(here, axis_.normal, is_a_ ? c.separation : -c.separation);
        return {is_a_ ? here : there, is_a_ ? there : here, std::min(c.separation + off_, 0.0), 0};
    }

  private:
    /// A segment that is steeper than a manifold's faces (ovoid_manifold_options.angle) touches with an end.
    bool is_upright(const ovoid_swept_sphere &b) const {
        return b.core == OVOID_SWEPT_SEGMENT && std::fabs(dot(b.axis[0], axis_.normal)) > 0.99271;
    }
    /// The other face's corners, projected along the normal.
    void set_corners(clip_polygon &to) const {
        const core_face &on = is_a_ ? face_a_ : face_b_, &other = is_a_ ? face_b_ : face_a_;
        const ovoid_vec3 n = is_a_ ? axis_.normal : negate(axis_.normal);
        const double along[2] = {dot(n, on.axis[0]), dot(n, on.axis[1])};
        const auto project = [&](const ovoid_vec3 &v) {
            const double gap = dot(v, on.own) / on.steep;
            return clip_corner{dot(v, on.axis[0]) - gap * along[0], dot(v, on.axis[1]) - gap * along[1], gap};
        };
        const clip_corner c = project(add_scaled(other.center, on.center, -1)), u = project(other.axis[0]);
        const auto put = [&](double s, const clip_corner &v, double t) {
            const double x = s * other.half[0], y = t * other.half[1];
            to.add({c.x + x * u.x + y * v.x, c.y + x * u.y + y * v.y,
                    c.separation + x * u.separation + y * v.separation - radii_[0] - radii_[1]});
        };
        if (other.steep > 0) {
            const clip_corner v = project(other.axis[1]);
            put(-1, v, -1), put(1, v, -1), put(1, v, 1), put(-1, v, 1);
        } else if (is_upright_) {
            put(u.separation > 0 ? -1 : 1, u, 0);
        } else {
            put(-1, u, 0), put(1, u, 0);
        }
    }

    contact_axis axis_;
    core_face face_a_, face_b_;
    bool is_a_;
    double radii_[2];
    bool is_upright_;
    double off_ = 0;
};

/// The deepest point of two capsules, or where their axes are parallel to 1e-6 the ends of the part that is side by
/// side.
template <class S> void add_segments(contact_list<S> &to, const ovoid_swept_pair &pair, const measured &depth) {
    const ovoid_swept_sphere &a = *pair.a, &b = *pair.b;
    const ovoid_vec3 d = add_scaled(b.center, a.center, -1), &n = depth.at.normal;
    const double across = dot(a.axis[0], b.axis[0]), along = dot(a.axis[0], d), reach = std::fabs(across) * b.half[0],
                 size = a.half[0] + b.half[0] + a.radius + b.radius, low = std::max(-a.half[0], along - reach),
                 high = std::min(a.half[0], along + reach);
    if (!(1 - std::fabs(across) < 5e-13 && high - low > clip_near * size)) return add_deepest(to, -1, -1, depth);
    ovoid_manifold_point at[2];
    for (int i = 0; i < 2; i++) {
        const ovoid_vec3 on_a = add_scaled(a.center, a.axis[0], i == 0 ? low : high);
        const ovoid_vec3 off = add_scaled(on_a, b.center, -1);
        const ovoid_vec3 between = add_scaled(off, b.axis[0], -dot(off, b.axis[0]));
        at[i].point_a = add_scaled(on_a, n, a.radius);
        at[i].separation = -dot(between, n) - a.radius - b.radius;
        at[i].point_b = add_scaled(at[i].point_a, n, at[i].separation);
    }
    const int first = at[1].separation < at[0].separation ? 1 : 0;
    const double off = contact_distance(depth.bracket) - at[first].separation;
    if (!(std::fabs(off) <= 1e-9 * size)) return add_deepest(to, -1, -1, depth);
    for (const int i : {first, 1 - first}) {
        at[i].separation += off;
        if (to.room() > 0 && at[i].separation <= 0) to.add(-1, -1, at[i], n);
    }
}

/// The axis of a box and another body with faces: apart, or open if their shapes have to be asked.
inline least_overlap::sign find_axis(const ovoid_swept_sphere &box, const ovoid_swept_sphere &other, contact_axis &to) {
    if (other.core == OVOID_SWEPT_SEGMENT) {
        ovoid_witness at;
        const ovoid_verdict found = ovoid_swept_contact({&box, &other}, &at);
        if (found.status == OVOID_SEPARATED) return least_overlap::apart;
        to = {at.normal, middle(found), box.half[0] + box.half[1] + box.half[2] + other.half[0] + other.radius, false,
              at.point_a};
        if (found.status != OVOID_UNDECIDED) return least_overlap::overlapping;
    }
    least_overlap least(box, other);
    const least_overlap::sign found = least.find();
    if (found == least_overlap::overlapping) {
        to = {least.normal(), least.gap() - other.radius, least.size() + other.radius, least.is_of_edges(), {0, 0, 0}};
        if (to.is_of_edges) to.crossing = least.find_crossing(to.normal);
    }
    // A segment that is not seen to enter the box was not measured.
    return found == least_overlap::apart && other.core == OVOID_SWEPT_SEGMENT ? least_overlap::open : found;
}

/// The contacts of two bodies with faces; false if their shapes have to be asked.
template <class S> bool collide_faces(contact_list<S> &to, const ovoid_swept_pair &pair) {
    if (pair.a->core == OVOID_SWEPT_SEGMENT && pair.b->core == OVOID_SWEPT_SEGMENT) {
        measured depth;
        depth.bracket = ovoid_swept_contact(pair, &depth.at);
        if (depth.bracket.status == OVOID_UNDECIDED) return false;
        if (is_hit(depth.bracket)) add_segments(to, pair, depth);
        return true;
    }
    const bool is_swapped = pair.a->core == OVOID_SWEPT_SEGMENT;
    const ovoid_swept_sphere &box = is_swapped ? *pair.b : *pair.a, &other = is_swapped ? *pair.a : *pair.b;
    contact_axis axis;
    const least_overlap::sign sign = find_axis(box, other, axis);
    if (sign != least_overlap::overlapping) return sign == least_overlap::apart;
    const auto add = [&](ovoid_manifold_point at) {
        if (is_swapped) std::swap(at.point_a, at.point_b);
        to.add(-1, -1, at, is_swapped ? negate(axis.normal) : axis.normal);
    };
    face_contact faces(box, other, axis);
    clip_polygon polygon;
    if (faces.is_crossing())
        add(faces.get_crossing());
    else if (!faces.find(polygon))
        return false;
    for (int i = 0; i < polygon.count() && to.room() > 0; i++) add(faces.get_point(polygon[i]));
    return true;
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
