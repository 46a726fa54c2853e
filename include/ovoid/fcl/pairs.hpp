/**
 * @file pairs.hpp
 * Pairs of objects on the way from a broad-phase manager to a callback, for <ovoid/fcl.hpp>. They are collected and
 * handed on by the types of their geometries: a callback that asks for each pair goes the same way many times, which a
 * processor foresees. In a large scene objects and geometries are not in the nearer caches: they are fetched while the
 * pairs before them are asked.
 */
#ifndef OVOID_FCL_PAIRS_HPP
#define OVOID_FCL_PAIRS_HPP

#include "ovoid/fcl/pose.hpp"
#include "ovoid/fcl/print.hpp"

#include <fcl/fcl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ovoid {
namespace fcl {
namespace detail {

/// Brings cache lines near: those at these places from an address.
template <int... line> OVOID_FCL_INLINE void fetch(const void *from) {
#if defined(__GNUC__)
    (__builtin_prefetch(static_cast<const char *>(from) + 64 * line), ...);
#else
    (void)from;
#endif
}

/// An object of a manager, with what of it stays where and as it is while it lives. Borrowed.
template <class S> struct registered {
    ::fcl::CollisionObject<S> *of; ///< NULL: removed
    const ::fcl::AABB<S> *box;
    std::uint32_t type; ///< of its geometry

    explicit registered(::fcl::CollisionObject<S> *o) : of(o), box(&o->getAABB()), type(::fcl::BV_UNKNOWN) {
        if (o->collisionGeometry()) type = static_cast<std::uint32_t>(o->getNodeType());
        if (type >= ::fcl::NODE_COUNT) type = ::fcl::BV_UNKNOWN;
    }
    ovoid_box get_box() const { return {to_vec3<S>(box->min_), to_vec3<S>(box->max_)}; }
    /// For get_box().
    OVOID_FCL_INLINE void fetch_box() const {
        fetch<0>(box);
        fetch<0>(&box->max_[2]);
    }
};
template <class S> using registered_objects = std::vector<registered<S>>;

/// The pairs of two lists of objects. The first few are handed on soon, in case the callback ends the query.
template <class S> class pair_queue {
  public:
    using object = ::fcl::CollisionObject<S>;

    pair_queue(::fcl::CollisionCallBack<S> callback, void *data, const registered_objects<S> &x,
               const registered_objects<S> &y)
        : callback_(callback), data_(data), x_(x), y_(y), is_small_(x.size() <= 256), is_large_(x.size() > 2000) {
        std::fill(heads_, heads_ + type_count * type_count, none);
    }

    /// Takes a pair of places. True if the query is over: the callback says so.
    OVOID_FCL_INLINE bool push(std::size_t i, std::size_t j) {
        object *x = x_[i].of, *y = y_[j].of;
        if (!x || !y) return false;
        if (is_small_) return callback_(x, y, data_);
        if (is_large_) {
            // An object has its transform in its first three lines. Many pairs one after the other have the same second
            // object.
            if (y != last_) fetch<0, 1, 2>(last_ = y);
            fetch<0, 1, 2>(x);
        }
        std::uint16_t &head = heads_[x_[i].type * type_count + y_[j].type];
        if (head == none) groups_[group_count_++] = &head;
        pairs_[count_] = {x, y, head};
        head = static_cast<std::uint16_t>(count_++);
        return count_ == limit_ && flush();
    }
    /// Hands on those that are left. True if the callback ends the query.
    OVOID_FCL_APART bool flush() {
        for (std::size_t k = 0; k < group_count_; k++) {
            std::uint16_t p = *groups_[k], next = is_large_ ? p : none;
            *groups_[k] = none;
            for (std::size_t n = 0; n < ahead; n++) fetch_next(next);
            for (; p != none; p = pairs_[p].next) {
                fetch_next(next);
                if (callback_(pairs_[p].x, pairs_[p].y, data_)) return true;
            }
        }
        count_ = group_count_ = 0;
        limit_ = std::min(2 * limit_, most);
        return false;
    }

  private:
    static constexpr std::size_t first = 32, most = 512, ahead = 4, type_count = ::fcl::NODE_COUNT;
    static constexpr std::uint16_t none = 0xffff;
    struct couple {
        object *x, *y;
        std::uint16_t next; ///< of the same types
    };

    /// Fetches the geometries of a pair, with their types in the first line and their sizes in the third, and goes on
    /// to the next pair of its types.
    OVOID_FCL_INLINE void fetch_next(std::uint16_t &at) const {
        if (at == none) return;
        fetch<0, 2>(pairs_[at].x->collisionGeometry().get());
        fetch<0, 2>(pairs_[at].y->collisionGeometry().get());
        at = pairs_[at].next;
    }

    ::fcl::CollisionCallBack<S> callback_;
    void *data_;
    const registered_objects<S> &x_, &y_; // a callback may add to them
    bool is_small_, is_large_;
    const object *last_ = nullptr;
    std::size_t count_ = 0, limit_ = first, group_count_ = 0;
    couple pairs_[most];
    std::uint16_t heads_[type_count * type_count];   ///< of each two types the pair that came last, or none
    std::uint16_t *groups_[type_count * type_count]; ///< the heads of types with pairs
};

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
