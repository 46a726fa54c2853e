/**
 * @file decompose.hpp
 * Decomposition of solids into convex parts, and the proof of its error.
 */
#ifndef OVOID_CPP_DECOMPOSE_HPP
#define OVOID_CPP_DECOMPOSE_HPP

#include "ovoid/cpp/solid.hpp"
#include "ovoid/decompose.h"

namespace ovoid {

/** What is proven about the parts. */
using decomposition_proof = ovoid_decomposition_proof;
/** Options; all zero is the default. */
using decomposition_options = ovoid_decomposition_options;

/** A closed solid and the convex parts that approximate it, borrowed. */
struct decomposition : ovoid_decomposition {
    /** count parts in the solid's frame. */
    decomposition(solid_view s, const ovoid_shape *const *first, std::size_t count) noexcept
        : ovoid_decomposition{s.get(), first, count} {}
};

/** A view of convex parts that are owned elsewhere: one pointer, passed by value. */
class parts_view {
  public:
    constexpr parts_view() noexcept = default;
    /** Wraps C parts. */
    constexpr explicit parts_view(const ovoid_parts *from) noexcept : parts_(from) {}
    /** The C parts, borrowed; nullptr if there are none. */
    constexpr const ovoid_parts *get() const noexcept { return parts_; }
    /** False if there are none. No other function may then be called. */
    explicit constexpr operator bool() const noexcept { return parts_ != nullptr; }

    /** The number of parts. */
    std::size_t size() const noexcept { return ovoid_parts_get_count(parts_); }
    /** Part i < size(). */
    shape_view operator[](std::size_t i) const noexcept { return shape_view(ovoid_parts_get_shapes(parts_)[i]); }
    /** The parts together with the solid that they approximate. */
    decomposition of(solid_view s) const noexcept { return {s, ovoid_parts_get_shapes(parts_), size()}; }

  private:
    const ovoid_parts *parts_ = nullptr;
};

/** Convex parts with an owner. */
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

/**
 * Brackets of both lengths of the error. excess: room for a length of each part, or nullptr. Throws ARGUMENT, EMPTY,
 * LIMIT, MEMORY.
 */
inline decomposition_proof prove(const decomposition &d, const decomposition_options &o = {},
                                 double *excess = nullptr) {
    ovoid_error e;
    decomposition_proof found;
    ovoid_decomposition_options all = o;
    if (excess) all.excesses = excess;
    detail::require(ovoid_decomposition_compute_proof(&d, &all, &found, &e), e);
    return found;
}

/** Throws ARGUMENT if a claim of the proof is false, LIMIT if the work was too little to prove it, EMPTY, MEMORY. */
inline void verify(const decomposition &d, const decomposition_proof &claimed, const decomposition_options &o = {}) {
    ovoid_error e;
    detail::require(ovoid_decomposition_verify(&d, &claimed, &o, &e), e);
}

} // namespace ovoid

#endif
