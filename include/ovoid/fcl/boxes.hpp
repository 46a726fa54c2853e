/**
 * @file boxes.hpp
 * Trees of axis-aligned boxes for <ovoid/fcl.hpp>: over the triangles of a mesh, and over the objects of a broad-phase
 * manager. A tree is an array in the order of a depth-first walk, without links: every range of leaves is halved.
 */
#ifndef OVOID_FCL_BOXES_HPP
#define OVOID_FCL_BOXES_HPP

#include "ovoid/motion.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace ovoid {
namespace fcl {
namespace detail {

inline ovoid_box join(const ovoid_box &a, const ovoid_box &b) {
    return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
            {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}

/// Have the boxes a common point? Of NaN they have. All six comparisons are made, which is faster than to branch.
struct overlap_test {
    bool operator()(const ovoid_box &a, const ovoid_box &b) const {
        const auto is_beyond = [](const ovoid_vec3 &low, const ovoid_vec3 &high) {
            return static_cast<int>(low.x > high.x) | static_cast<int>(low.y > high.y) |
                   static_cast<int>(low.z > high.z);
        };
        return (is_beyond(a.min, b.max) | is_beyond(b.min, a.max)) == 0;
    }
    /// Whether the boxes of each of two pairs may meet.
    std::pair<bool, bool> operator()(const ovoid_box &a, const ovoid_box &b, const ovoid_box &c,
                                     const ovoid_box &d) const {
        return {(*this)(a, b), (*this)(c, d)};
    }
};

/// The square of the distance of two boxes.
inline double compute_gap2(const ovoid_box &a, const ovoid_box &b) {
    const double x = std::max(0.0, std::max(a.min.x - b.max.x, b.min.x - a.max.x)),
                 y = std::max(0.0, std::max(a.min.y - b.max.y, b.min.y - a.max.y)),
                 z = std::max(0.0, std::max(a.min.z - b.max.z, b.min.z - a.max.z));
    return x * x + y * y + z * z;
}

/// A node of a tree of boxes, and the range of its leaves. The halves of a range of n leaves are the node after it, of
/// the first n / 2 leaves, and the node 2 (n / 2) after it, of the others.
struct box_range {
    std::size_t node, first, end;
    bool is_leaf() const { return end - first == 1; }
    std::size_t half() const { return (end - first) / 2; }
    box_range lower() const { return {node + 1, first, first + half()}; }
    box_range upper() const { return {node + 2 * half(), first + half(), end}; }
};

/// Of two ranges that are not both leaves: is the first one halved? Else the second is.
inline bool is_first_halved(const box_range &x, const box_range &y) {
    return y.is_leaf() || (!x.is_leaf() && x.end - x.first >= y.end - y.first);
}

/// The leaves of one range by take_leaf, and their pairs by search.visit, both of whose trees are the same, until one
/// returns true. Leaves come soon before the pairs that are theirs.
template <class Search, class Take> bool visit_own(const Search &search, const Take &take_leaf, const box_range &x) {
    if (x.is_leaf()) return take_leaf(x.first);
    return visit_own(search, take_leaf, x.lower()) || visit_own(search, take_leaf, x.upper()) ||
           search.visit(x.lower(), x.upper());
}

/// The number of boxes of a tree of so many leaves.
inline std::size_t count_boxes(std::size_t leaves) { return leaves > 0 ? 2 * leaves - 1 : 0; }

/// Writes the boxes of a range: box_of(i) is that of leaf i, and each other one holds its halves.
template <class BoxOf> ovoid_box fill_boxes(std::vector<ovoid_box> &boxes, const box_range &at, const BoxOf &box_of) {
    const ovoid_box box = at.is_leaf()
                              ? box_of(at.first)
                              : join(fill_boxes(boxes, at.lower(), box_of), fill_boxes(boxes, at.upper(), box_of));
    return boxes[at.node] = box;
}

/// A leaf of one tree and one of another.
struct leaf_pair {
    std::size_t a, b;
};

/// Goes through the pairs of a leaf of one tree and one of another that `may_meet` does not part, until `take` returns
/// true: then it returns true. `first` is taken first, then those that are in the same halves. Both halves are tested
/// at once.
template <class Box, class Test, class Take> class pair_search {
  public:
    pair_search(const Box *a, const Box *b, const Test &may_meet, Take &take, leaf_pair first = {0, 0})
        : a_(a), b_(b), may_meet_(may_meet), take_(take), first_(first) {}

    bool visit(const box_range &x, const box_range &y) const {
        return may_meet_(a_[x.node], b_[y.node]) && visit_met(x, y);
    }

  private:
    /// Of ranges whose boxes may meet.
    bool visit_met(const box_range &x, const box_range &y) const {
        if (x.is_leaf() && y.is_leaf()) return take_(x.first, y.first);
        if (is_first_halved(x, y)) {
            const box_range lower = x.lower(), upper = x.upper();
            return first_.a < upper.first ? visit_both(lower, y, upper, y) : visit_both(upper, y, lower, y);
        }
        const box_range lower = y.lower(), upper = y.upper();
        return first_.b < upper.first ? visit_both(x, lower, x, upper) : visit_both(x, upper, x, lower);
    }
    bool visit_both(const box_range &x, const box_range &y, const box_range &z, const box_range &w) const {
        const std::pair<bool, bool> meet = may_meet_(a_[x.node], b_[y.node], a_[z.node], b_[w.node]);
        return (meet.first && visit_met(x, y)) || (meet.second && visit_met(z, w));
    }

    const Box *a_, *b_;
    const Test &may_meet_;
    Take &take_;
    leaf_pair first_;
};

/// Goes through the pairs of leaves whose boxes are nearer than a bound, nearer halves first, until `take` returns
/// true. The bound is the square of a distance, and `take` may lower it.
template <class Take> class near_search {
  public:
    near_search(const ovoid_box *a, const ovoid_box *b, const double &bound2, Take &take)
        : a_(a), b_(b), bound2_(bound2), take_(take) {}

    bool visit(const box_range &x, const box_range &y) const { return gap2(x, y) < bound2_ && visit_near(x, y); }

  private:
    double gap2(const box_range &x, const box_range &y) const { return compute_gap2(a_[x.node], b_[y.node]); }
    bool visit_near(const box_range &x, const box_range &y) const {
        if (x.is_leaf() && y.is_leaf()) return take_(x.first, y.first);
        if (is_first_halved(x, y)) return visit_both(x.lower(), y, x.upper(), y);
        return visit_both(x, y.lower(), x, y.upper());
    }
    bool visit_both(const box_range &x, const box_range &y, const box_range &z, const box_range &w) const {
        const double first = gap2(x, y), second = gap2(z, w);
        if (second < first) return (second < bound2_ && visit_near(z, w)) || (first < bound2_ && visit_near(x, y));
        return (first < bound2_ && visit_near(x, y)) || (second < bound2_ && visit_near(z, w));
    }

    const ovoid_box *a_, *b_;
    const double &bound2_;
    Take &take_;
};

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
