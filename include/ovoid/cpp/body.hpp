/**
 * @file body.hpp
 * The proximity of two bodies, each a shape, a compound or a solid.
 */
#ifndef OVOID_CPP_BODY_HPP
#define OVOID_CPP_BODY_HPP

#include "ovoid/body.h"
#include "ovoid/cpp/compound.hpp"
#include "ovoid/cpp/solid.hpp"

namespace ovoid {

/** The warm start of a pair of bodies. */
using body_proof = zeroed<ovoid_body_proof>;
/** The answer to a query about bodies. */
using body_answer = ovoid_body_answer;

/** A posed shape, compound or solid, borrowed. */
struct body : ovoid_body {
    /** A shape at a pose. */
    body(shape_view s, const ovoid::pose &at = {}) noexcept : ovoid_body{s.get(), nullptr, at, nullptr} {}
    /** A compound at a pose. */
    body(compound_view c, const ovoid::pose &at = {}) noexcept : ovoid_body{nullptr, c.get(), at, nullptr} {}
    /** A solid at a pose. */
    body(solid_view s, const ovoid::pose &at = {}) noexcept : ovoid_body{nullptr, nullptr, at, s.get()} {}
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

/**
 * Where a query writes the proof of its answer beside the deciding pair's: into memory of its own, or an array of the
 * caller's. For the cover of a depth set `cover`.
 */
class exclusions : public ovoid_exclusions {
  public:
    /** Grows as a query needs, by malloc; freed with the object. */
    exclusions() noexcept : ovoid_exclusions{nullptr, 0, 0, nullptr, 1, nullptr} {}
    /** Writes into a contiguous container, as many as it has room for; c: receives the cover of a depth, or nullptr. */
    template <class Container>
    explicit exclusions(Container &into, ovoid_cover *c = nullptr) noexcept
        : ovoid_exclusions{std::data(into), std::size(into), 0, c, 0, nullptr} {}
    exclusions(const exclusions &) = delete;
    exclusions &operator=(const exclusions &) = delete;
    ~exclusions() { ovoid_exclusions_release(this); }
    /** False if there were more than there was room for, or memory ran out: the proof is incomplete. */
    bool is_complete() const noexcept { return count <= capacity; }
    /** The exclusions that were written. */
    span<const ovoid_exclusion> written() const noexcept { return {items, is_complete() ? count : capacity}; }
};

/** Do the bodies touch? e: receives the proof, or nullptr. */
inline body_answer collide(const body_pair &p, const ovoid_options &o = options(),
                           const ovoid_body_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    const ovoid_body_evidence known = {earlier, e};
    return ovoid_body_collide(&p, &o, &known);
}
/** Are the bodies within margin (>= 0) of each other? */
inline body_answer within(const body_pair &p, double margin, const ovoid_options &o = options(),
                          const ovoid_body_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    const ovoid_body_evidence known = {earlier, e};
    return ovoid_body_within(&p, margin, &o, &known);
}
/** The distance to the tolerance and the nearest parts. */
inline body_answer distance(const body_pair &p, const ovoid_options &o = options(),
                            const ovoid_body_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    const ovoid_body_evidence known = {earlier, e};
    return ovoid_body_distance(&p, &o, &known);
}
/** The signed distance to the tolerance; with a solid the same as distance. */
inline body_answer depth(const body_pair &p, const ovoid_options &o = options(),
                         const ovoid_body_proof *earlier = nullptr, ovoid_exclusions *e = nullptr) noexcept {
    const ovoid_body_evidence known = {earlier, e};
    return ovoid_body_depth(&p, &o, &known);
}

/** 1: proven within the margin; 0: proven farther; -1: neither is proven. */
inline int is_within(const body_answer &a, double margin) noexcept { return ovoid_body_answer_is_within(&a, margin); }
/** The warm start of the pair's next query. */
inline body_proof proof_of(const ovoid_body_answer &a) noexcept { return ovoid_body_answer_get_proof(&a); }
/** The answer in the form of an answer of two shapes, with the bracket of the bodies. */
inline ovoid_answer answer_of(const ovoid_body_answer &a) noexcept { return ovoid_body_answer_get_answer(&a); }
/** The answer of two bodies without a solid from that of their deciding pair. */
inline body_answer make_body_answer(const ovoid_answer &deciding, std::uint32_t part_a, std::uint32_t part_b) noexcept {
    return ovoid_body_answer_make(&deciding, part_a, part_b);
}
/**
 * True if the answer follows from its proof, the exclusions (nullptr is enough for two shapes) and the query's options.
 */
inline bool is_proven(const body_pair &p, const ovoid_body_answer &a, const ovoid_options &o = options(),
                      const ovoid_exclusions *e = nullptr) noexcept {
    const ovoid_body_basis basis = {&o, e};
    return ovoid_body_verify(&p, &a, &basis, nullptr) == OVOID_OK;
}
/** Throws PROOF (place: the exclusion), with a sentence, if is_proven is false. */
inline void verify(const body_pair &p, const ovoid_body_answer &a, const ovoid_options &o = options(),
                   const ovoid_exclusions *e = nullptr) {
    ovoid_error error;
    const ovoid_body_basis basis = {&o, e};
    detail::require(ovoid_body_verify(&p, &a, &basis, &error), error);
}

} // namespace ovoid

#endif
