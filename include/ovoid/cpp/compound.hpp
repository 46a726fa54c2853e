/**
 * @file compound.hpp
 * Compounds of posed shapes, and the proximity of bodies: shapes or compounds.
 */
#ifndef OVOID_CPP_COMPOUND_HPP
#define OVOID_CPP_COMPOUND_HPP

#include "ovoid/compound.h"
#include "ovoid/cpp/query.hpp"

#include <memory>

namespace ovoid {

/** The warm start of a pair of bodies. */
using compound_proof = zeroed<ovoid_compound_proof>;
/** The answer to a query about bodies. */
using compound_answer = ovoid_compound_answer;

/** A compound that someone else owns: one pointer, passed by value. */
class compound_view {
  public:
    constexpr compound_view() noexcept = default;
    /** Of a C compound. */
    constexpr explicit compound_view(const ovoid_compound *from) noexcept : compound_(from) {}
    /** The C compound, borrowed; nullptr where this is empty. */
    constexpr const ovoid_compound *get() const noexcept { return compound_; }
    /** False where there is none. No other function may then be called. */
    explicit constexpr operator bool() const noexcept { return compound_ != nullptr; }

    /** Number of parts. */
    std::size_t size() const noexcept { return ovoid_compound_get_part_count(compound_); }
    /** Part i < size, with its pose in the compound's frame. */
    ovoid::posed_shape part(std::size_t i) const noexcept { return ovoid_compound_get_part(compound_, i); }
    /** The parts in the order of the tree. */
    span<const std::uint32_t> order() const noexcept { return {ovoid_compound_get_order(compound_), size()}; }
    /** An ellipsoid that encloses all parts. */
    ovoid_ellipsoid outer() const noexcept { return ovoid_compound_get_outer(compound_); }
    /** The largest inner ellipsoid of a part. */
    ovoid_ellipsoid inner() const noexcept { return ovoid_compound_get_inner(compound_); }
    /** Size of the block in bytes, without the shapes. */
    std::size_t size_in_bytes() const noexcept { return ovoid_compound_get_size(compound_); }

  private:
    const ovoid_compound *compound_ = nullptr;
};

/** A part whose shape is shared, for compound::share. */
struct shared_part {
    std::shared_ptr<const ovoid::shape> shape; /**< kept as long as the compound */
    ovoid::pose pose;                          /**< in the compound's frame */
};

/** A compound that is owned. Its shapes are borrowed and must outlive it; share keeps them. */
class compound : public detail::owner<compound_view, ovoid_compound, ovoid_compound_destroy> {
  public:
    using owner::owner;

    /** Of a contiguous container of posed_shape (or ovoid_posed_shape), copied. Throws EMPTY, LIMIT, ARGUMENT,
     * NOT_FINITE, RANGE, ROTATION (place: the part), MEMORY. */
    template <class Parts> static compound create(const Parts &parts, const ovoid_allocator *allocator = nullptr) {
        const auto items = detail::items_of<ovoid_posed_shape>(parts);
        ovoid_error e;
        return compound(detail::require(ovoid_compound_create(items.data(), items.size(), allocator, &e), e));
    }
    /** Of parts in braces. */
    static compound create(std::initializer_list<ovoid::posed_shape> parts,
                           const ovoid_allocator *allocator = nullptr) {
        return create(span<const ovoid::posed_shape>(parts.begin(), parts.size()), allocator);
    }
    /** A shared compound that keeps its shapes alive. Throws as create; ARGUMENT for a part without a shape. */
    static std::shared_ptr<const compound> share(const std::vector<shared_part> &parts,
                                                 const ovoid_allocator *allocator = nullptr) {
        struct holder {
            std::vector<shared_part> parts;
            ovoid::compound compound;
        };
        std::vector<ovoid::posed_shape> borrowed;
        for (const shared_part &p : parts) borrowed.emplace_back(p.shape ? shape_view(*p.shape) : shape_view(), p.pose);
        auto held = std::make_shared<holder>(holder{parts, create(borrowed, allocator)});
        return {held, &held->compound};
    }
};

class solid_view;

/** A posed shape, compound or solid, borrowed. */
struct body : ovoid_body {
    /** A shape at a pose. */
    body(shape_view s, const ovoid::pose &at = {}) noexcept : ovoid_body{s.get(), nullptr, at, nullptr} {}
    /** A compound at a pose. */
    body(compound_view c, const ovoid::pose &at = {}) noexcept : ovoid_body{nullptr, c.get(), at, nullptr} {}
    /** A solid at a pose: in <ovoid/cpp/solid.hpp>. */
    body(solid_view s, const ovoid::pose &at = {}) noexcept;
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_body>::value, int> = 0>
    body(const T &from) noexcept : ovoid_body(from) {}
};

/** Two bodies. */
struct body_pair : ovoid_body_pair {
    /** a and b. */
    body_pair(const body &a_, const body &b_) noexcept : ovoid_body_pair{a_, b_} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_body_pair>::value, int> = 0>
    body_pair(const T &from) noexcept : ovoid_body_pair(from) {}
};

/** Where a query writes what proves its answer beside the deciding pair: into an array of the caller's. */
class exclusions : public ovoid_exclusions {
  public:
    /** Into a contiguous container, as many as it has places; c: receives the cover of a depth, or nullptr. */
    template <class Container>
    explicit exclusions(Container &into, ovoid_cover *c = nullptr) noexcept
        : ovoid_exclusions{std::data(into), std::size(into), 0, c} {}
    /** False where there were more than places: the proof is not all there. */
    bool is_complete() const noexcept { return count <= capacity; }
    /** What was written. */
    span<const ovoid_exclusion> written() const noexcept { return {items, is_complete() ? count : capacity}; }
};

/** Do the bodies touch? e: receives what proves it, or nullptr. */
inline compound_answer collide(const body_pair &p, const ovoid_options &o = options(),
                               const ovoid_compound_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    return ovoid_compound_collide(&p, &o, earlier, e);
}
/** Are the bodies within margin (>= 0) of each other? Read it with is_within(answer.answer, margin). */
inline compound_answer within(const body_pair &p, double margin, const ovoid_options &o = options(),
                              const ovoid_compound_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    return ovoid_compound_within(&p, margin, &o, earlier, e);
}
/** The distance to the tolerance and the nearest parts. */
inline compound_answer distance(const body_pair &p, const ovoid_options &o = options(),
                                const ovoid_compound_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    return ovoid_compound_distance(&p, &o, earlier, e);
}
/** The signed distance to the tolerance. */
inline compound_answer depth(const body_pair &p, const ovoid_options &o = options(),
                             const ovoid_compound_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    return ovoid_compound_depth(&p, &o, earlier, e);
}

/** The warm start of the pair's next query. */
inline compound_proof proof_of(const ovoid_compound_answer &a) noexcept {
    return ovoid_compound_proof{a.part_a, a.part_b, a.answer.proof};
}
/** True where the answer follows from its proof, the exclusions (nullptr is enough for two shapes) and the query's
 *  options. */
inline bool is_proven(const body_pair &p, const ovoid_compound_answer &a, const ovoid_options &o = options(),
                      const ovoid_exclusions *e = nullptr) noexcept {
    return ovoid_compound_answer_verify(&p, &a, &o, e, nullptr) == OVOID_OK;
}
/** Throws PROOF (place: the exclusion), with a sentence, where is_proven is false. */
inline void verify(const body_pair &p, const ovoid_compound_answer &a, const ovoid_options &o = options(),
                   const ovoid_exclusions *e = nullptr) {
    ovoid_error error;
    detail::require(ovoid_compound_answer_verify(&p, &a, &o, e, &error), error);
}

} // namespace ovoid

#endif
