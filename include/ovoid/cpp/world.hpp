/**
 * @file world.hpp
 * Worlds: many moving bodies, and all pairs of them that are near. A function that the C library refuses throws
 * ovoid::error and leaves the world as it was.
 */
#ifndef OVOID_CPP_WORLD_HPP
#define OVOID_CPP_WORLD_HPP

#include "ovoid/cpp/body_manifolds.hpp"
#include "ovoid/cpp/motion.hpp"
#include "ovoid/world_manifolds.h"

namespace ovoid {

/** The id of a body in a world; 0: no body. */
using id = ovoid_id;
/** A pair that is not proven farther than the margin. */
using contact = ovoid_contact;
/** The result of a search in a world. */
using world_hit = ovoid_world_hit;
/** The first body that a ray or a moving probe meets. */
using world_cast = ovoid_world_cast;
/** Options of a world. Filter and tasks are C functions and must not throw; the allocator may be called from workers.
 */
using world_options = zeroed<ovoid_world_options>;

/** A body to add to a world, or a probe for a search. */
struct world_body : ovoid_world_body {
    /** group and mask both zero: the body is in all groups and meets all. */
    world_body(const ovoid::body &b, std::uint32_t group_ = 0, std::uint32_t mask_ = 0,
               std::uint64_t user_ = 0) noexcept
        : ovoid_world_body{b, {group_, mask_}, user_} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_world_body>::value, int> = 0>
    world_body(const T &from) noexcept : ovoid_world_body(from) {}
};

/** Which query a world computes for each pair, and up to which distance. */
struct contact_query : ovoid_contact_query {
    /** The options are borrowed; nullptr: the defaults. */
    contact_query(ovoid_query_kind query_ = OVOID_QUERY_COLLIDE, double margin_ = 0,
                  const ovoid_options *options_ = nullptr) noexcept
        : ovoid_contact_query{query_, margin_, options_} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_contact_query>::value, int> = 0>
    contact_query(const T &from) noexcept : ovoid_contact_query(from) {}
};

/**
 * The contacts of a world, for range-for, sorted by a, then by b. Valid until the next call of a function of the world
 * that is not const.
 */
class contacts : public ovoid_contacts {
  public:
    /** From the C struct. */
    explicit contacts(const ovoid_contacts &from) noexcept : ovoid_contacts(from) {}
    /** The first contact. */
    const contact *begin() const noexcept { return items; }
    /** One past the last contact. */
    const contact *end() const noexcept { return items + count; }
    /** Number of contacts. */
    std::size_t size() const noexcept { return count; }
    /** True if there is no contact. */
    bool empty() const noexcept { return count == 0; }
    /** Contact i < size. */
    const contact &operator[](std::size_t i) const noexcept { return items[i]; }
    /** True if the contacts have points and normals: for DISTANCE and DEPTH. */
    bool has_witnesses() const noexcept { return witnesses != nullptr; }
    /** The points and normal of a contact of this list; has_witnesses must be true. */
    const ovoid::witness &witness(const contact &c) const noexcept { return witnesses[&c - items]; }
};

/** What a caller sets of a body for its manifolds. */
using material = zeroed<ovoid_material>;
/** A pair of bodies that are not proven farther apart than their margin. */
using world_manifold = ovoid_world_manifold;
/** The query of the manifolds of all pairs. */
using world_manifold_query = zeroed<ovoid_world_manifold_query>;

/**
 * The manifolds of a world, for range-for, sorted by a, then by b. Valid until the next call of a function of the world
 * that is not const.
 */
class world_manifolds : public ovoid_world_manifolds {
  public:
    /** From the C struct. */
    explicit world_manifolds(const ovoid_world_manifolds &from) noexcept : ovoid_world_manifolds(from) {}
    /** The first pair. */
    const world_manifold *begin() const noexcept { return items; }
    /** One past the last pair. */
    const world_manifold *end() const noexcept { return items + count; }
    /** Number of pairs. */
    std::size_t size() const noexcept { return count; }
    /** True if there is no pair. */
    bool empty() const noexcept { return count == 0; }
    /** Pair i < size. */
    const world_manifold &operator[](std::size_t i) const noexcept { return items[i]; }
    /** The manifolds of a pair of this list, one for each pair of parts. */
    span<const body_manifold> parts_of(const world_manifold &m) const noexcept {
        return {m.count ? parts + m.first : nullptr, m.count};
    }
    /** The points of the manifolds of a pair, beside its parts. */
    span<const ovoid_manifold_points> points_of(const world_manifold &m) const noexcept {
        return {m.count ? points + m.first : nullptr, m.count};
    }
    /** The pairs that are not in contact any more. */
    span<const ovoid_world_parting> partings() const noexcept { return {ended, ended_count}; }
};

/** A world that owns its memory. What its bodies point to must live as long as they are in the world. */
class world : public detail::owner<detail::pointer<ovoid_world>, ovoid_world, ovoid_world_destroy> {
  public:
    using owner::owner;

    /** A world without bodies. Throws ARGUMENT, MEMORY, LIMIT. */
    static world create(const ovoid_world_options &o = world_options()) {
        ovoid_error e;
        return world(detail::require(ovoid_world_create(&o, &e), e));
    }

    /** Adds a body. Throws ARGUMENT, LIMIT, MEMORY, and for a refused pose NOT_FINITE, RANGE, ROTATION. */
    id add(const world_body &b) {
        ovoid_error e;
        const id made = ovoid_world_add(get(), &b, &e);
        if (made == 0) detail::fail(e);
        return made;
    }
    /** Adds a body at a pose. */
    id add(const ovoid::body &b, std::uint32_t group = 0, std::uint32_t mask = 0, std::uint64_t user = 0) {
        return add(world_body(b, group, mask, user));
    }
    /**
     * Adds bodies from a contiguous container of world_body: all or none. Throws as add (place: the index of the
     * refused one).
     */
    template <class Bodies> std::vector<id> add_many(const Bodies &bodies) {
        const auto items = detail::items_of<ovoid_world_body>(bodies);
        std::vector<id> ids(items.size());
        const ovoid_world_additions all = {items.data(), items.size(), ids.data()};
        call(ovoid_world_add_many, &all);
        return ids;
    }
    /** Removes a body. Throws INDEX. */
    void remove(id b) { call(ovoid_world_remove, b); }
    /** Removes bodies: all or none. Throws INDEX (place: the index in ids). */
    template <class Ids> void remove_many(const Ids &ids) {
        call(ovoid_world_remove_many, std::data(ids), std::size(ids));
    }
    /** Moves a body. Throws INDEX, and for a refused pose NOT_FINITE, RANGE, ROTATION. */
    void move(id b, const pose &to_) { call(ovoid_world_move, b, &to_); }
    /** Moves bodies: all or none. Throws as move (place: the first refused), ARGUMENT if the lengths differ. */
    template <class Ids, class Poses> void move_many(const Ids &ids, const Poses &poses) {
        const auto items = detail::items_of<ovoid_pose>(poses);
        if (std::size(ids) != items.size()) detail::fail(OVOID_ERROR_ARGUMENT, "as many poses as bodies are needed");
        const ovoid_world_moves all = {std::data(ids), items.data(), items.size()};
        call(ovoid_world_move_many, &all);
    }
    /** Sets the groups of a body. Throws INDEX. */
    void set_groups(id b, std::uint32_t group, std::uint32_t mask) {
        call(ovoid_world_set_groups, b, ovoid_groups{group, mask});
    }
    /** Asks the filter again about all pairs of this body. Throws INDEX. */
    void renew(id b) { call(ovoid_world_renew, b); }
    /** Excludes a pair from now on, or includes it again. Throws INDEX, ARGUMENT, MEMORY. */
    void set_ignored(id a, id b, bool ignored) {
        call(ignored ? ovoid_world_add_ignored : ovoid_world_remove_ignored, a, b);
    }
    /** All pairs that are not proven farther apart than the margin. Throws ARGUMENT, MEMORY. */
    contacts compute_contacts(const contact_query &query) {
        ovoid_contacts found;
        call(ovoid_world_compute_contacts, &query, &found);
        return contacts(found);
    }
    /** Sets the material of a body. Throws INDEX, ARGUMENT, MEMORY. */
    void set_material(id b, const ovoid_material &m) { call(ovoid_world_set_material, b, &m); }
    /** The manifolds of all pairs that are not proven farther apart than their margin. Throws ARGUMENT, MEMORY. */
    world_manifolds compute_manifolds(const ovoid_world_manifold_query &query = world_manifold_query()) {
        ovoid_world_manifolds found;
        call(ovoid_world_compute_manifolds, &query, &found);
        return world_manifolds(found);
    }

    /** The material of a body; zeros if none was set. Throws INDEX. */
    ovoid::material material_of(id b) const {
        ovoid_material found;
        call(ovoid_world_get_material, b, &found);
        return found;
    }
    /** The present state of a body. Throws INDEX. */
    world_body at(id b) const {
        ovoid_world_body found;
        call(ovoid_world_get, b, &found);
        return found;
    }
    /** Number of bodies. */
    std::size_t size() const noexcept { return ovoid_world_get_count(get()); }
    /** The first body after the given one (0: the first of all); 0 if there is none. */
    id find_next(id after) const noexcept { return ovoid_world_find_next(get(), after); }
    /** True if the world checks this pair: groups, filter and ignored pairs allow it. */
    bool is_pair(id a, id b) const noexcept { return ovoid_world_is_pair(get(), a, b) != 0; }
    /**
     * The full answer of a contact, with its proof. excluded: receives the exclusions; may be nullptr. Throws INDEX,
     * ARGUMENT.
     */
    body_answer compute_proof(const contact &c, ovoid_exclusions *excluded = nullptr) const {
        ovoid_contact_proof found = {excluded, {}};
        call(ovoid_world_compute_proof, &c, &found);
        return found.answer;
    }

    /** Do any two bodies touch? Throws ARGUMENT. */
    world_hit find_any() const { return find(ovoid_world_find_any, static_cast<const ovoid_world_ids *>(nullptr)); }
    /** Does any of these bodies touch another body? No ids: no. Throws INDEX, ARGUMENT. */
    template <class Ids, class = decltype(std::size(std::declval<const Ids &>()))>
    world_hit find_any(const Ids &ids) const {
        const ovoid_world_ids some = {std::data(ids), std::size(ids)};
        return find(ovoid_world_find_any, &some);
    }
    /** Does any of these probes, a contiguous container of world_body, touch a body of the world? Throws as add. */
    template <class Probes> world_hit find_any_to(const Probes &probes) const {
        const auto items = detail::items_of<ovoid_world_body>(probes);
        const ovoid_world_probes all = {items.data(), items.size(), nullptr, 0};
        return find(ovoid_world_find_any_of, &all);
    }
    /**
     * Does any of these probes touch a body of the world, or do the two probes of a couple touch? couples: a contiguous
     * container of couple. Throws as add, INDEX (place: the couple that names no probe).
     */
    template <class Probes, class Couples> world_hit find_any_of(const Probes &probes, const Couples &couples) const {
        const auto items = detail::items_of<ovoid_world_body>(probes);
        const auto pairs = detail::items_of<ovoid_couple>(couples);
        const ovoid_world_probes all = {items.data(), items.size(), pairs.data(), pairs.size()};
        return find(ovoid_world_find_any_of, &all);
    }
    /** The body nearest to a body. Throws INDEX, ARGUMENT. */
    world_hit find_nearest(id b, const ovoid_options &o = options()) const {
        const ovoid_world_query query = {b, nullptr, 0, &o};
        return find(ovoid_world_find_nearest, &query);
    }
    /** The body nearest to a probe. Throws as add. */
    world_hit find_nearest_to(const world_body &probe, const ovoid_options &o = options()) const {
        const ovoid_world_query query = {0, &probe, 0, &o};
        return find(ovoid_world_find_nearest, &query);
    }
    /** The two nearest bodies of the world. Throws ARGUMENT. */
    world_hit find_nearest_pair(const ovoid_options &o = options()) const {
        return find(ovoid_world_find_nearest_pair, &o);
    }
    /** All bodies that are not proven farther than margin from a probe, sorted. Allocates. Throws as add. */
    std::vector<world_hit> find_overlaps(const world_body &probe, double margin = 0,
                                         const ovoid_options &o = options()) const {
        std::vector<world_hit> found;
        const ovoid_world_query query = {0, &probe, margin, &o};
        ovoid_world_hits hits = {nullptr, 0, 0};
        // The first call counts them, the second call fills the array.
        call(ovoid_world_find_overlaps, &query, &hits);
        while (hits.count > hits.capacity) {
            found.resize(hits.count);
            hits.items = found.data();
            hits.capacity = found.size();
            call(ovoid_world_find_overlaps, &query, &hits);
        }
        return found;
    }
    /** Writes them to the caller's array; allocates nothing. Throws as add. */
    void find_overlaps(const world_body &probe, double margin, ovoid_world_hits &hits) const {
        const ovoid_world_query query = {0, &probe, margin, nullptr};
        call(ovoid_world_find_overlaps, &query, &hits);
    }
    /** A point as a probe. */
    world_body make_point(const vec3 &point) const noexcept { return ovoid_world_make_point(get(), point); }
    /** The first body that a ray meets. Throws ARGUMENT. */
    world_cast cast_ray(const ray &r, std::uint32_t group = 0, std::uint32_t mask = 0) const {
        const ovoid_world_ray grouped = {r, {group, mask}};
        ovoid_world_cast found;
        call(ovoid_world_cast_ray, &grouped, &found);
        return found;
    }
    /** The first body that a probe meets when it moves along displacement without turning. Throws as add. */
    world_cast cast_body(const world_body &probe, const vec3 &displacement) const {
        const ovoid_world_sweep sweep = {probe, displacement};
        ovoid_world_cast found;
        call(ovoid_world_cast_body, &sweep, &found);
        return found;
    }

    /** Iterates over the ids of all bodies, in order. Bodies may be moved meanwhile. */
    class iterator {
      public:
        /** The types that std::iterator_traits requires. */
        using iterator_category = std::input_iterator_tag;
        /** An id. */
        using value_type = id;
        /** Distance. */
        using difference_type = std::ptrdiff_t;
        /** No pointers: ids are values. */
        using pointer = const id *;
        /** An id. */
        using reference = id;
        /** Points to an id of a world; 0: the end. */
        iterator(const ovoid_world *w, id at) noexcept : world_(w), at_(at) {}
        /** The id. */
        id operator*() const noexcept { return at_; }
        /** Goes to the next id. */
        iterator &operator++() noexcept { return at_ = ovoid_world_find_next(world_, at_), *this; }
        /** Goes to the next id; returns the iterator before. */
        iterator operator++(int) noexcept {
            iterator before = *this;
            ++*this;
            return before;
        }
        /** True if both have the same id. */
        friend bool operator==(const iterator &a, const iterator &b) noexcept { return a.at_ == b.at_; }
        /** True if their ids differ. */
        friend bool operator!=(const iterator &a, const iterator &b) noexcept { return a.at_ != b.at_; }

      private:
        const ovoid_world *world_;
        id at_;
    };
    /** The first body's id. */
    iterator begin() const noexcept { return {get(), find_next(0)}; }
    /** The end. */
    iterator end() const noexcept { return {get(), 0}; }

  private:
    template <class Function, class... Arguments> void call(Function function, Arguments... arguments) {
        ovoid_error e;
        detail::require(function(get(), arguments..., &e), e);
    }
    template <class Function, class... Arguments> void call(Function function, Arguments... arguments) const {
        ovoid_error e;
        detail::require(function(get(), arguments..., &e), e);
    }
    template <class Function, class... Arguments> world_hit find(Function function, Arguments... arguments) const {
        world_hit hit;
        call(function, arguments..., &hit);
        return hit;
    }
};

} // namespace ovoid

#endif
