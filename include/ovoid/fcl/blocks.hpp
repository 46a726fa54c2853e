/**
 * @file blocks.hpp
 * The boxes of a broad-phase manager, for <ovoid/fcl.hpp>: in blocks, with a tree of boxes over the blocks.
 * A block has its boxes side by side in single precision too, rounded outward, so that a compiler's vectors compare
 * four at once; what they let pass is compared in doubles.
 */
#ifndef OVOID_FCL_BLOCKS_HPP
#define OVOID_FCL_BLOCKS_HPP

#include "ovoid/fcl/boxes.hpp"
#include "ovoid/fcl/print.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace ovoid {
namespace fcl {
namespace detail {

/// The number of boxes in a block.
constexpr std::size_t block_size = 16;

/// In the place of a box that is none: it is infinitely far from all, and meets only what is as large as numbers are.
inline ovoid_box empty_box() {
    const double far = std::numeric_limits<double>::max();
    return {{far, far, far}, {-far, -far, -far}};
}

/// A box in single precision.
struct float_box {
    float low[3], high[3];
};
/// A box rounded outward. Each number is off by a rounding of the product, of the sum and of the conversion, together
/// less than it is moved. An end beyond the floats becomes infinite, and one that is infinite NaN, which is beyond
/// nothing.
inline float_box round_out(const ovoid_box &b) {
    static_assert(std::numeric_limits<float>::is_iec559, "conversions beyond the floats are infinite");
    const auto round_down = [](double x) { return static_cast<float>(x - (std::fabs(x) * 0x1p-22 + 0x1p-140)); };
    const auto round_up = [](double x) { return static_cast<float>(x + (std::fabs(x) * 0x1p-22 + 0x1p-140)); };
    return {{round_down(b.min.x), round_down(b.min.y), round_down(b.min.z)},
            {round_up(b.max.x), round_up(b.max.y), round_up(b.max.z)}};
}

/// The boxes of a block, coordinate by coordinate.
struct box_block {
    float low[3][block_size], high[3][block_size];

    void set(std::size_t lane, const float_box &b) {
        for (int k = 0; k < 3; k++) low[k][lane] = b.low[k], high[k][lane] = b.high[k];
    }
    float_box get(std::size_t lane) const {
        return {{low[0][lane], low[1][lane], low[2][lane]}, {high[0][lane], high[1][lane], high[2][lane]}};
    }
    /// The lanes, as bits, whose boxes may meet a box; none before `first`, a multiple of four.
#if defined(__GNUC__)
    // The compiler's own vectors, which it has for every processor.
    OVOID_FCL_INLINE std::uint32_t find(const float_box &b, int first = 0) const {
        using flags = std::int32_t __attribute__((vector_size(16)));
        using halves = std::int64_t __attribute__((vector_size(16)));
        flags found = {0, 0, 0, 0};
        for (int i = first; i < static_cast<int>(block_size); i += 4) {
            flags beyond = {0, 0, 0, 0};
            for (int k = 0; k < 3; k++)
                beyond |= (load(&low[k][i]) > spread(b.high[k])) | (spread(b.low[k]) > load(&high[k][i]));
            found |= ~beyond & (flags{1, 2, 4, 8} << i);
        }
        halves both;
        std::memcpy(&both, &found, sizeof both);
        const auto all = static_cast<std::uint64_t>(both[0] | both[1]);
        return static_cast<std::uint32_t>(all | all >> 32);
    }

  private:
    using four = float __attribute__((vector_size(16)));
    static four load(const float *from) {
        four to;
        std::memcpy(&to, from, sizeof to);
        return to;
    }
    static four spread(float x) { return four{x, x, x, x}; }
#else
    std::uint32_t find(const float_box &b, int first = 0) const {
        std::uint32_t found = 0;
        for (std::size_t i = static_cast<std::size_t>(first); i < block_size; i++) {
            const bool is_beyond = (low[0][i] > b.high[0]) | (low[1][i] > b.high[1]) | (low[2][i] > b.high[2]) |
                                   (b.low[0] > high[0][i]) | (b.low[1] > high[1][i]) | (b.low[2] > high[2][i]);
            found |= static_cast<std::uint32_t>(!is_beyond) << i;
        }
        return found;
    }
#endif
};

/// The lowest bit that is set.
inline std::size_t find_lowest(std::uint32_t bits) {
#if defined(__GNUC__)
    return static_cast<std::size_t>(__builtin_ctz(bits));
#else
    std::size_t at = 0;
    while (!(bits >> at & 1)) at++;
    return at;
#endif
}

/// Boxes by their places 0, 1, ..., those of a block close to each other. Searches take places until `take` returns
/// true: then they return true.
class block_tree {
  public:
    std::size_t count() const { return count_; }
    const ovoid_box &box(std::size_t place) const { return leaves_[place]; }

    /// Sets all boxes: box_of(place).
    template <class BoxOf> void fill(std::size_t count, const BoxOf &box_of) {
        count_ = count;
        const std::size_t blocks = (count + block_size - 1) / block_size;
        leaves_.resize(blocks * block_size);
        blocks_.resize(blocks);
        all_.resize(blocks);
        outer_.resize(blocks);
        boxes_.resize(count_boxes(blocks));
        for (std::size_t i = 0; i < leaves_.size(); i++) set_leaf(i, i < count ? box_of(i) : empty_box());
        if (blocks > 0) fill_boxes(boxes_, root(), [this](std::size_t block) { return join_block(block); });
    }
    /// Sets one box, and those of the tree that hold it.
    void set(std::size_t place, const ovoid_box &box) {
        set_leaf(place, box);
        set_above(root(), place / block_size);
    }
    /// The sum of the lengths of the tree's boxes.
    double measure() const {
        double sum = 0;
        for (const ovoid_box &box : boxes_)
            if (box.min.x <= box.max.x)
                sum += (box.max.x - box.min.x) + (box.max.y - box.min.y) + (box.max.z - box.min.z);
        return sum;
    }

    /// The places whose boxes meet a box.
    template <class Take> bool find(const ovoid_box &box, const Take &take) const {
        if (count_ == 0) return false;
        const float_box outer = round_out(box);
        const auto take_block = [&](std::size_t block, std::size_t) {
            for (std::uint32_t lanes = blocks_[block].find(outer); lanes; lanes &= lanes - 1) {
                const std::size_t place = block * block_size + find_lowest(lanes);
                if (place < count_ && overlap_test()(leaves_[place], box) && take(place)) return true;
            }
            return false;
        };
        return pair_search(boxes_.data(), &box, overlap_test(), take_block).visit(root(), {0, 0, 1});
    }
    /// The pairs of two places whose boxes meet.
    template <class Take> bool find_own(const Take &take) const {
        const auto take_block = [&](std::size_t block) {
            return take_own<0>(block, take) || take_own<4>(block, take) || take_own<8>(block, take) ||
                   take_own<12>(block, take);
        };
        const auto take_blocks = [&](std::size_t x, std::size_t y) { return take_pairs(*this, x, y, take); };
        return count_ > 0 &&
               visit_own(pair_search(boxes_.data(), boxes_.data(), overlap_test(), take_blocks), take_block, root());
    }
    /// The pairs of a place here and a place there whose boxes meet.
    template <class Take> bool find_both(const block_tree &there, const Take &take) const {
        const auto take_blocks = [&](std::size_t x, std::size_t y) { return take_pairs(there, x, y, take); };
        return count_ > 0 && there.count_ > 0 &&
               pair_search(boxes_.data(), there.boxes_.data(), overlap_test(), take_blocks).visit(root(), there.root());
    }

    /// The places whose boxes are nearer to a box than the root of a bound, which `take` may lower; nearer blocks
    /// first.
    template <class Take> bool find_near(const ovoid_box &box, const double &bound2, const Take &take) const {
        const auto take_block = [&](std::size_t block, std::size_t) {
            return take_near(block * block_size, box, bound2, take);
        };
        return count_ > 0 && near_search(boxes_.data(), &box, bound2, take_block).visit(root(), {0, 0, 1});
    }
    /// The pairs of two places whose boxes are that near.
    template <class Take> bool find_own_near(const double &bound2, const Take &take) const {
        const auto take_all = [&](std::size_t i, std::size_t first) {
            return take_near(first, leaves_[i], bound2, [&](std::size_t j) { return take(i, j); });
        };
        const auto take_blocks = [&](std::size_t x, std::size_t y) {
            for (std::size_t i = x * block_size; i < (x + 1) * block_size; i++)
                if (compute_gap2(leaves_[i], all_[y]) < bound2 && take_all(i, y * block_size)) return true;
            return false;
        };
        const auto take_block = [&](std::size_t block) {
            for (std::size_t i = block * block_size; i + 1 < (block + 1) * block_size; i++)
                if (take_all(i, i + 1)) return true;
            return false;
        };
        return count_ > 0 &&
               visit_own(near_search(boxes_.data(), boxes_.data(), bound2, take_blocks), take_block, root());
    }

  private:
    box_range root() const { return {0, 0, blocks_.size()}; }
    /// The lanes after lane i.
    static std::uint32_t above(std::size_t i) { return std::uint32_t{0xfffffffe} << i; }

    void set_leaf(std::size_t place, const ovoid_box &box) {
        leaves_[place] = box;
        blocks_[place / block_size].set(place % block_size, round_out(box));
    }
    ovoid_box join_block(std::size_t block) {
        ovoid_box all = empty_box();
        for (std::size_t i = 0; i < block_size; i++) all = join(all, leaves_[block * block_size + i]);
        outer_[block] = round_out(all);
        return all_[block] = all;
    }
    void set_above(const box_range &at, std::size_t block) {
        if (at.is_leaf()) {
            boxes_[at.node] = join_block(block);
            return;
        }
        const box_range lower = at.lower(), upper = at.upper();
        set_above(block < lower.end ? lower : upper, block);
        boxes_[at.node] = join(boxes_[lower.node], boxes_[upper.node]);
    }

    /// Takes a place there with those lanes of a block here whose boxes meet its box.
    template <class Take>
    OVOID_FCL_INLINE bool take_lanes(const block_tree &there, std::size_t block, std::size_t j, std::uint32_t lanes,
                                     const Take &take) const {
        for (; lanes; lanes &= lanes - 1) {
            const std::size_t i = block * block_size + find_lowest(lanes);
            if (i < count_ && j < there.count_ && overlap_test()(leaves_[i], there.leaves_[j]) && take(i, j))
                return true;
        }
        return false;
    }
    /// Takes the pairs of one of four lanes of a block and a lane after it.
    template <int first, class Take> bool take_own(std::size_t block, const Take &take) const {
        const box_block &boxes = blocks_[block];
        for (std::size_t i = first; i < first + 4; i++)
            if (take_lanes(*this, block, block * block_size + i, boxes.find(boxes.get(i), first) & above(i), take))
                return true;
        return false;
    }
    /// Takes the pairs of block x here and block y there: first the lanes of y that meet all of x are found.
    template <class Take>
    bool take_pairs(const block_tree &there, std::size_t x, std::size_t y, const Take &take) const {
        for (std::uint32_t lanes = there.blocks_[y].find(outer_[x]); lanes; lanes &= lanes - 1) {
            const std::size_t j = find_lowest(lanes);
            if (take_lanes(there, x, y * block_size + j, blocks_[x].find(there.blocks_[y].get(j)), take)) return true;
        }
        return false;
    }
    /// Takes the places from `first` to the end of its block that are near a box.
    template <class Take>
    bool take_near(std::size_t first, const ovoid_box &box, const double &bound2, const Take &take) const {
        const std::size_t end = std::min(count_, (first / block_size + 1) * block_size);
        for (std::size_t i = first; i < end; i++)
            if (compute_gap2(leaves_[i], box) < bound2 && take(i)) return true;
        return false;
    }

    std::size_t count_ = 0;
    std::vector<ovoid_box> leaves_; ///< with empty boxes up to the end of the last block
    std::vector<box_block> blocks_;
    std::vector<ovoid_box> all_;   ///< of each block
    std::vector<float_box> outer_; ///< the same, rounded outward
    std::vector<ovoid_box> boxes_; ///< the tree, whose leaves are those
};

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
