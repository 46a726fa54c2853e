/**
 * @file manifold.hpp
 * Contact manifolds: up to four points of two shapes with a proven bracket and ids. Queries never throw, allocate or
 * lock: the limit of the manifold says why a query was refused, as in C.
 */
#ifndef OVOID_CPP_MANIFOLD_HPP
#define OVOID_CPP_MANIFOLD_HPP

#include "ovoid/cpp/query.hpp"
#include "ovoid/manifold.h"

namespace ovoid {

/** Options of contact queries: margin, tolerance, keep, angle, room for a cover. */
using manifold_options = zeroed<ovoid_manifold_options>;
/** A contact: the result of a query, and the `earlier` of the pair's next one; all zero: no earlier contact. */
using manifold = zeroed<ovoid_manifold>;
/** A point of contact. */
using manifold_point = ovoid_manifold_point;
/** The points of a contact. */
using manifold_points = ovoid_manifold_points;
/** The whole polygon of a contact. */
using manifold_polygon = zeroed<ovoid_manifold_polygon>;

/** The contact of two bodies. earlier: the pair's last contact, or nullptr. */
inline manifold find_manifold(const pair &p, const ovoid_manifold_options &o = manifold_options(),
                              const ovoid_manifold *earlier = nullptr) noexcept {
    return ovoid_manifold_find(&p, &o, earlier);
}
/** The contact of the pair (b, a) from that of (a, b). */
inline manifold make_swapped(const ovoid_manifold &m) noexcept { return ovoid_manifold_make_swapped(&m); }
/** The points of a contact; the pair is that of the query, in the same poses. */
inline manifold_points compute_points(const pair &p, const ovoid_manifold &m) noexcept {
    return ovoid_manifold_compute_points(&p, &m);
}
/** The whole polygon of a contact, with its areas. Throws ARGUMENT: the contact is not one of this pair. */
inline manifold_polygon compute_polygon(const pair &p, const ovoid_manifold &m,
                                        const ovoid_manifold_options &o = manifold_options()) {
    manifold_polygon polygon;
    if (ovoid_manifold_compute_polygon(&p, &m, &o, &polygon) != OVOID_OK)
        detail::fail(OVOID_ERROR_ARGUMENT, "the manifold is not one of this pair");
    return polygon;
}
/** True if the contact's claims hold, without a search. o: the options of the query, with its cover. */
inline bool is_proven(const pair &p, const ovoid_manifold &m,
                      const ovoid_manifold_options &o = manifold_options()) noexcept {
    return ovoid_manifold_verify(&p, &m, &o, nullptr) == OVOID_OK;
}
/** Throws PROOF, with a sentence, if is_proven is false. */
inline void verify(const pair &p, const ovoid_manifold &m, const ovoid_manifold_options &o = manifold_options()) {
    ovoid_error e;
    detail::require(ovoid_manifold_verify(&p, &m, &o, &e), e);
}

/** One query of many pairs. Bodies, couples, options and arrays are borrowed. */
class manifold_batch : public ovoid_manifold_batch {
  public:
    /** Of contiguous containers of posed_shape, couple and manifold; each manifold is the earlier one, then the new.
     * Throws ARGUMENT: fewer manifolds than couples. */
    template <class Parts, class Couples, class Manifolds>
    manifold_batch(const Parts &parts, const Couples &pairs, Manifolds &kept) : ovoid_manifold_batch{} {
        const auto p = detail::items_of<ovoid_posed_shape>(parts);
        const auto c = detail::items_of<ovoid_couple>(pairs);
        bodies = p.data(), body_count = p.size(), couples = c.data(), couple_count = c.size();
        manifolds = detail::receive<ovoid_manifold>(kept, couple_count);
    }
    /** Options of all queries. */
    manifold_batch &with_options(const ovoid_manifold_options &o) noexcept { return options = &o, *this; }
    /** Options must outlive the batch. */
    manifold_batch &with_options(const ovoid_manifold_options &&) = delete;
    /** Receives the points. Throws ARGUMENT: fewer than couples. */
    template <class Points> manifold_batch &with_points(Points &into) {
        return points = detail::receive<ovoid_manifold_points>(into, couple_count), *this;
    }
};

/** find_manifold for each couple. Throws INDEX (place: the couple); then nothing is written. */
inline void find_manifolds(const ovoid_manifold_batch &b) {
    ovoid_error e;
    detail::require(ovoid_manifold_find_batch(&b, &e), e);
}

/** The word for results, for example "face a". */
inline const char *name(ovoid_manifold_axis axis) noexcept { return ovoid_manifold_axis_get_name(axis); }
/** The word for results, for example "facets". */
inline const char *name(ovoid_manifold_proof kind) noexcept { return ovoid_manifold_proof_get_name(kind); }

} // namespace ovoid

#endif
