/**
 * @file decompose.hpp
 * Solids in convex parts, and the proof of how good the parts are.
 */
#ifndef OVOID_CPP_DECOMPOSE_HPP
#define OVOID_CPP_DECOMPOSE_HPP

#include "ovoid/cpp/solid.hpp"
#include "ovoid/decompose.h"

namespace ovoid {

/** What is proven of the parts. */
using decomposition_proof = ovoid_decomposition_proof;
/** Options; all zero is the default. */
using decomposition_options = ovoid_decomposition_options;

/** A closed solid and the convex parts that stand for it, borrowed. */
struct decomposition : ovoid_decomposition {
    /** count parts in the solid's frame. */
    decomposition(solid_view s, const ovoid_shape *const *first, std::size_t count) noexcept
        : ovoid_decomposition{s.get(), first, count} {}
};

/** Convex parts that someone else owns: one pointer, passed by value. */
class parts_view {
  public:
    constexpr parts_view() noexcept = default;
    /** Of C parts. */
    constexpr explicit parts_view(const ovoid_parts *from) noexcept : parts_(from) {}
    /** The C parts, borrowed; nullptr where this is empty. */
    constexpr const ovoid_parts *get() const noexcept { return parts_; }
    /** False where there are none. No other function may then be called. */
    explicit constexpr operator bool() const noexcept { return parts_ != nullptr; }

    /** How many there are. */
    std::size_t size() const noexcept { return ovoid_parts_get_count(parts_); }
    /** Part i < size(). */
    shape_view operator[](std::size_t i) const noexcept { return shape_view(ovoid_parts_get_shapes(parts_)[i]); }
    /** With the solid that they stand for. */
    decomposition of(solid_view s) const noexcept { return {s, ovoid_parts_get_shapes(parts_), size()}; }

  private:
    const ovoid_parts *parts_ = nullptr;
};

/** Convex parts that are owned. */
class parts : public detail::owner<parts_view, ovoid_parts, ovoid_parts_destroy> {
  public:
    using owner::owner;

    /** Cuts a closed solid by planes. Throws ARGUMENT, LIMIT, MEMORY. */
    static parts from_solid(solid_view s, const decomposition_options &o = {}) {
        ovoid_error e;
        return parts(detail::require(ovoid_parts_create_from_solid(s.get(), &o, &e), e));
    }
    /** Polyhedra that hold all points within the radius of the parts. Throws ARGUMENT, RANGE, MEMORY. */
    static parts enlarged(const decomposition &d, double radius, const decomposition_options &o = {}) {
        ovoid_error e;
        return parts(detail::require(ovoid_parts_create_enlarged(&d, radius, &o, &e), e));
    }
};

/** How far the parts are from the solid. excess: room for a length of each part, or nullptr. Throws ARGUMENT, EMPTY,
 * LIMIT, MEMORY. */
inline decomposition_proof prove(const decomposition &d, const decomposition_options &o = {},
                                 double *excess = nullptr) {
    ovoid_error e;
    decomposition_proof found;
    ovoid_decomposition_options all = o;
    if (excess) all.excesses = excess;
    detail::require(ovoid_decomposition_compute_proof(&d, &all, &found, &e), e);
    return found;
}

/** Throws ARGUMENT where a claim of the proof is not so, LIMIT where the work did not show it, EMPTY, MEMORY. */
inline void verify(const decomposition &d, const decomposition_proof &claimed, const decomposition_options &o = {}) {
    ovoid_error e;
    detail::require(ovoid_decomposition_verify(&d, &claimed, &o, &e), e);
}

} // namespace ovoid

#endif
