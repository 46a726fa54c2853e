/**
 * @file compound.hpp
 * Compounds of posed shapes.
 */
#ifndef OVOID_CPP_COMPOUND_HPP
#define OVOID_CPP_COMPOUND_HPP

#include "ovoid/compound.h"
#include "ovoid/cpp/query.hpp"

#include <memory>

namespace ovoid {

/** A view of a compound that is owned elsewhere: one pointer, passed by value. */
class compound_view {
  public:
    constexpr compound_view() noexcept = default;
    /** Wraps a C compound. */
    constexpr explicit compound_view(const ovoid_compound *from) noexcept : compound_(from) {}
    /** The C compound, borrowed; nullptr if there is none. */
    constexpr const ovoid_compound *get() const noexcept { return compound_; }
    /** False if there is none. No other function may then be called. */
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

/** A compound with an owner. Its shapes are borrowed and must outlive it; share keeps them. */
class compound : public detail::owner<compound_view, ovoid_compound, ovoid_compound_destroy> {
  public:
    using owner::owner;

    /**
     * Makes a compound of a contiguous container of posed_shape (or ovoid_posed_shape), copied. Throws EMPTY, LIMIT,
     * ARGUMENT, NOT_FINITE, RANGE, ROTATION (place: the part), MEMORY.
     */
    template <class Parts> static compound create(const Parts &parts, const ovoid_allocator *allocator = nullptr) {
        const auto items = detail::items_of<ovoid_posed_shape>(parts);
        ovoid_error e;
        const ovoid_compound_options o = {allocator};
        return compound(detail::require(ovoid_compound_create(items.data(), items.size(), &o, &e), e));
    }
    /** Makes a compound of parts in braces. */
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

} // namespace ovoid

#endif
