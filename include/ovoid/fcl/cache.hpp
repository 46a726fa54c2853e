/**
 * @file cache.hpp
 * The translations of FCL's geometries that <ovoid/fcl.hpp> keeps. A translation is found by the address of its
 * geometry and used while the geometry's print is the same. Each thread has a table of what it used last, which it
 * reads without a lock; behind it is one table for all threads.
 *
 * Translations go by a sweep, each time that their number or their bytes have doubled since the last one: those whose
 * geometry is dead, which is known of geometries that came in a CollisionObject; and of the others those that nobody
 * used since the last sweep. A thread lets go of what was swept at its next call, or when it ends.
 */
#ifndef OVOID_FCL_CACHE_HPP
#define OVOID_FCL_CACHE_HPP

#include "ovoid/fcl/body.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace ovoid {
namespace fcl {
namespace detail {

/// A translation, and what is known of its geometry.
struct entry {
    print of;
    std::shared_ptr<const body> made;
    std::weak_ptr<const void> owner;   ///< guarded by the store's lock
    std::atomic<bool> is_owned{false}; ///< `owner` is set
    std::atomic<bool> is_used{true};   ///< since the last sweep
    std::atomic<bool> is_swept{false}; ///< not in the store any more
    std::size_t size = 0;              ///< in bytes
};

/// The translations of all threads.
class store {
  public:
    /// It is never destroyed, so that calls of FCL from destructors at the end of the program are answered too.
    static store &get() {
        static store *all = new store;
        return *all;
    }

    /// The entry of this geometry if it has the geometry's print, with its owner noted; or NULL.
    template <class S> std::shared_ptr<entry> find(const typed<S> &g, const std::shared_ptr<const geometry<S>> *owner) {
        const std::lock_guard<std::mutex> hold(lock_);
        const auto found = entries_.find(g.of);
        if (found == entries_.end() || !has_print(g, found->second->of)) return nullptr;
        if (owner) note(*found->second, *owner);
        return found->second;
    }

    /// Adds an entry in the place of one of the same address. owner: empty where it is not known.
    void add(const void *address, const std::shared_ptr<entry> &made, const std::shared_ptr<const void> &owner) {
        const std::lock_guard<std::mutex> hold(lock_);
        if (entries_.size() >= most_ || size_ >= most_size_) sweep(false);
        std::shared_ptr<entry> &place = entries_[address];
        if (place) let_go(*place);
        place = made;
        size_ += made->size;
        note(*made, owner);
    }

    /// Drops the entries of dead geometries; if all, also those whose geometry is not known to live.
    void trim(bool all) {
        const std::lock_guard<std::mutex> hold(lock_);
        sweep(all);
    }
    void forget(const void *address) {
        const std::lock_guard<std::mutex> hold(lock_);
        const auto found = entries_.find(address);
        if (found == entries_.end()) return;
        let_go(*found->second);
        entries_.erase(found);
        sweeps_.fetch_add(1, std::memory_order_release);
    }
    std::size_t count() {
        const std::lock_guard<std::mutex> hold(lock_);
        return entries_.size();
    }
    /// Changes when entries were swept.
    static std::uint64_t sweeps() { return sweeps_.load(std::memory_order_acquire); }

  private:
    static void note(entry &e, const std::shared_ptr<const void> &owner) {
        if (!owner) return;
        e.owner = owner;
        e.is_owned.store(true, std::memory_order_relaxed);
    }
    void let_go(entry &e) {
        e.is_swept.store(true, std::memory_order_release);
        size_ -= e.size;
    }
    void sweep(bool all) {
        for (auto at = entries_.begin(); at != entries_.end();) {
            entry &e = *at->second;
            const bool was_used = e.is_used.exchange(false, std::memory_order_relaxed);
            const bool stays = e.is_owned.load(std::memory_order_relaxed) ? !e.owner.expired() : was_used && !all;
            if (!stays) let_go(e);
            at = stays ? std::next(at) : entries_.erase(at);
        }
        most_ = std::max<std::size_t>(64, 2 * entries_.size());
        most_size_ = std::max<std::size_t>(std::size_t{64} << 20, 2 * size_);
        sweeps_.fetch_add(1, std::memory_order_release);
    }

    std::mutex lock_;
    std::unordered_map<const void *, std::shared_ptr<entry>> entries_;
    std::size_t most_ = 64, size_ = 0, most_size_ = std::size_t{64} << 20;
    inline static std::atomic<std::uint64_t> sweeps_{0};
};

/// What one thread used last: sets of two places. The place that was used last stays when its set takes a new entry, so
/// the two bodies of a call keep each other. The sets are doubled when as many entries were put out as there are sets,
/// up to a limit, so that a scene of many geometries is found without a lock too.
class table {
  public:
    /// This thread's table. A thread that calls FCL while it ends, after its table, gets one that is not freed.
    static table &get() {
        static thread_local table *mine = nullptr;
        if (!mine) {
            static thread_local struct ender {
                ~ender() {
                    delete mine;
                    mine = nullptr;
                }
            } at_end;
            (void)at_end;
            mine = new table;
        }
        return *mine;
    }

    /// To be called once at the start of each call: lets go of what was swept.
    void begin() {
        const std::uint64_t sweeps = store::sweeps();
        if (sweeps == sweeps_) return;
        sweeps_ = sweeps;
        for (set &s : sets_)
            for (place &p : s.places)
                if (p.held && p.held->is_swept.load(std::memory_order_acquire)) p = place();
    }

    /// The body of a geometry, which stays until the second find after this one; NULL if it has none. owner: NULL or
    /// empty where it is not known.
    template <class S> const body *find(const typed<S> &g, const std::shared_ptr<const geometry<S>> *owner) {
        set &s = sets_[pick_set(g.of)];
        const std::uint32_t i = s.places[0].address == g.of ? 0 : 1;
        const place &at = s.places[i];
        if (at.address == g.of && has_print(g, at.held->of)) {
            entry &e = *at.held;
            if (owner && *owner && !e.is_owned.load(std::memory_order_relaxed)) return make_anew(g, owner);
            if (!e.is_used.load(std::memory_order_relaxed)) e.is_used.store(true, std::memory_order_relaxed);
            s.last = i;
            return e.made.get();
        }
        return make_anew(g, owner);
    }

  private:
    struct place {
        const void *address = nullptr;
        std::shared_ptr<entry> held;
    };
    struct set {
        place places[2];
        std::uint32_t last = 0;
        /// The place for an address: its own, or the one that was not used last.
        std::uint32_t pick(const void *address) const {
            for (std::uint32_t i = 0; i < 2; i++)
                if (places[i].address == address) return i;
            return 1 - last;
        }
    };
    static constexpr std::size_t fewest_sets = 256, most_sets = std::size_t{1} << 15;

    /// The number of sets is a power of two.
    std::size_t pick_set(const void *geometry) const {
        const auto address = reinterpret_cast<std::uintptr_t>(geometry);
        return (address >> 4 ^ address >> 12) & mask_;
    }
    /// Not inline: it is seldom called.
    template <class S>
    OVOID_FCL_APART const body *make_anew(const typed<S> &g, const std::shared_ptr<const geometry<S>> *owner) {
        std::shared_ptr<entry> held = make_entry(g, owner);
        return held ? put(g.of, std::move(held)) : nullptr;
    }
    const body *put(const void *address, std::shared_ptr<entry> held) {
        if (evictions_ >= sets_.size() && sets_.size() < most_sets) grow();
        set &s = sets_[pick_set(address)];
        s.last = s.pick(address);
        place &to = s.places[s.last];
        evictions_ += to.address && to.address != address;
        to = {address, std::move(held)};
        return to.held->made.get();
    }
    /// Doubles the sets. An entry keeps its place within its set, and the one that was used last stays so.
    void grow() {
        const std::size_t half = sets_.size();
        sets_.resize(2 * half);
        mask_ = sets_.size() - 1;
        for (std::size_t k = 0; k < half; k++) {
            set &lower = sets_[k], &upper = sets_[k + half];
            upper.last = lower.last;
            for (std::uint32_t i = 0; i < 2; i++)
                if (pick_set(lower.places[i].address) != k) std::swap(lower.places[i], upper.places[i]);
        }
        evictions_ = 0;
    }

    /// The entry of all threads, or a new one; NULL if the geometry has no translation.
    template <class S>
    static std::shared_ptr<entry> make_entry(const typed<S> &g, const std::shared_ptr<const geometry<S>> *owner) {
        store &all = store::get();
        std::shared_ptr<entry> e = all.find(g, owner);
        print p;
        if (e || !make_print(g, p)) return e;
        e = std::make_shared<entry>();
        e->of = p;
        e->made = make_body(g.of);
        e->size = e->made->size();
        all.add(g.of, e, owner ? *owner : nullptr);
        return e;
    }

    std::vector<set> sets_ = std::vector<set>(fewest_sets);
    std::size_t mask_ = fewest_sets - 1;
    std::size_t evictions_ = 0; ///< since the sets were doubled
    std::uint64_t sweeps_ = 0;
};

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
