/**
 * @file query.hpp
 * Proximity of two posed shapes, alone and in batches; proofs; smooth brackets; the paper's areas.
 * Queries never throw, allocate or lock: the limit of the answer says why a query was refused, as in C.
 */
#ifndef OVOID_CPP_QUERY_HPP
#define OVOID_CPP_QUERY_HPP

#include "ovoid/cpp/shape.hpp"
#include "ovoid/paper.h"
#include "ovoid/prepared.h"
#include "ovoid/query.h"
#include "ovoid/smooth.h"

#include <memory>
#include <utility>

namespace ovoid {

/** Options of a query: tolerances, cap, iterations. */
using options = zeroed<ovoid_options>;
/** A proof: the warm start of the pair's next query. */
using proof = zeroed<ovoid_proof>;
/** The proof of a depth's upper bound, with its memory, which is owned: the search for the depth may go on there. */
class cover : public ovoid_cover {
  public:
    /** For up to that many points: 10 KB, and beyond 512 points 150 bytes each. Throws std::bad_alloc. */
    explicit cover(std::uint32_t points = OVOID_COVER_POINTS) : ovoid_cover{} {
        size = ovoid_cover_get_size(points);
        data_.reset(new unsigned char[size]);
        memory = data_.get();
    }
    /** The other cover has no memory then, and shows nothing. */
    cover(cover &&from) noexcept : ovoid_cover(from), data_(std::move(from.data_)) {
        static_cast<ovoid_cover &>(from) = {};
    }
    /** The same. */
    cover &operator=(cover &&from) noexcept {
        data_ = std::move(from.data_);
        static_cast<ovoid_cover &>(*this) = from;
        if (this != &from) static_cast<ovoid_cover &>(from) = {};
        return *this;
    }

  private:
    std::unique_ptr<unsigned char[]> data_;
};
/** Points and normal of an answer. */
using witness = ovoid_witness;
/** Two bodies of a batch, by index. */
using couple = ovoid_couple;
/** The answer to a query. */
using answer = ovoid_answer;
/** Status and bracket of an answer, without points and proof. */
using verdict = ovoid_verdict;
/** A smooth bracket of the distance. */
using smooth = ovoid_smooth;
/** The gradient of the exact distance. */
using gradient = ovoid_gradient;

/** Two posed shapes, borrowed. */
struct pair : ovoid_pair {
    /** a and b with their poses. */
    pair(shape_view a, shape_view b, const pose &pose_a_ = {}, const pose &pose_b_ = {}) noexcept
        : ovoid_pair{a.get(), b.get(), pose_a_, pose_b_} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_pair>::value, int> = 0>
    pair(const T &from) noexcept : ovoid_pair(from) {}
};

/** A posed shape, borrowed: of a batch, or a part of a compound. */
struct posed_shape : ovoid_posed_shape {
    /** At the origin. */
    posed_shape(shape_view s, const ovoid::pose &at = {}) noexcept : ovoid_posed_shape{s.get(), at} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_posed_shape>::value, int> = 0>
    posed_shape(const T &from) noexcept : ovoid_posed_shape(from) {}
};

/** Do the bodies touch? earlier: a proof of this pair, or nullptr. */
inline answer collide(const pair &p, const ovoid_options &o = options(),
                      const ovoid_proof *earlier = nullptr) noexcept {
    return ovoid_collide(&p, &o, earlier);
}
/** Are the bodies within margin (>= 0) of each other? Read it with is_within. */
inline answer within(const pair &p, double margin, const ovoid_options &o = options(),
                     const ovoid_proof *earlier = nullptr) noexcept {
    return ovoid_within(&p, margin, &o, earlier);
}
/** The distance to the tolerance if the bodies are apart; of an overlap only the sign is proven. */
inline answer distance(const pair &p, const ovoid_options &o = options(),
                       const ovoid_proof *earlier = nullptr) noexcept {
    return ovoid_distance(&p, &o, earlier);
}
/** The signed distance to the tolerance. received: the cover that proves the bound of a depth, or nullptr. */
inline answer depth(const pair &p, const ovoid_options &o = options(), const ovoid_proof *earlier = nullptr,
                    ovoid_cover *received = nullptr) noexcept {
    return ovoid_depth(&p, &o, earlier, received);
}
/** The depth of a pair that has moved a little, from the proof and the cover of the last one; the cover is renewed. */
inline answer depth_from(const pair &p, ovoid_cover &cover, const ovoid_options &o = options(),
                         const ovoid_proof *earlier = nullptr) noexcept {
    return ovoid_depth_from(&p, &o, earlier, &cover);
}
/** The gap along a direction: a proven lower bound of the signed distance. */
inline double compute_gap(const pair &p, const ovoid_vec3 &direction) noexcept {
    return ovoid_pair_compute_gap(&p, direction);
}
/** The bracket from the ellipsoids alone. */
inline answer bounds(const pair &p) noexcept { return ovoid_pair_compute_bounds(&p); }

/** The signed distance as one number, never above the true one; NaN if the bracket is wider than asked. */
inline double distance_of(const ovoid_answer &a) noexcept { return ovoid_answer_get_distance(&a); }
/** 1: proven within the margin; 0: proven farther; -1: neither is proven. */
inline int is_within(const ovoid_answer &a, double margin) noexcept { return ovoid_answer_is_within(&a, margin); }
/**
 * True if the answer's bounds follow from its proof, and its status from them and the tolerance, without a search. o:
 * the options of the query. c: the cover of depth, or nullptr.
 */
inline bool is_proven(const pair &p, const ovoid_answer &a, const ovoid_options &o = options(),
                      const ovoid_cover *c = nullptr) noexcept {
    const ovoid_answer_basis basis = {&o, c};
    return ovoid_answer_verify(&p, &a, &basis, nullptr) == OVOID_OK;
}
/** Throws PROOF, with a sentence, if is_proven is false. */
inline void verify(const pair &p, const ovoid_answer &a, const ovoid_options &o = options(),
                   const ovoid_cover *c = nullptr) {
    ovoid_error e;
    const ovoid_answer_basis basis = {&o, c};
    detail::require(ovoid_answer_verify(&p, &a, &basis, &e), e);
}

/** What a query of prepared shapes writes beside its verdict. */
using evidence = zeroed<ovoid_evidence>;

/** A posed shape, prepared for many queries. The shape is borrowed. */
struct prepared_shape : ovoid_prepared_shape {
    /** Prepares the shape; the queries refuse a bad pose. */
    explicit prepared_shape(const ovoid_posed_shape &of) noexcept { ovoid_prepared_shape_make(&of, this); }
    /**
     * Prepares the shape at nine numbers of a rotation matrix, row by row. Throws as ovoid_prepared_shape_make_matrix
     * refuses.
     */
    template <class M>
    static prepared_shape from_row_major(const ovoid_shape *of, const M &matrix, const ovoid_vec3 &at) {
        const auto rows = detail::numbers_of<9>(matrix);
        prepared_shape made;
        const ovoid_code code = ovoid_prepared_shape_make_matrix(of, rows.data(), at, &made);
        if (code != OVOID_OK) detail::fail(code, "the matrix is no rotation, or the position is not finite");
        return made;
    }

  private:
    prepared_shape() noexcept : ovoid_prepared_shape{} {}
};

/** collide of prepared shapes. */
inline verdict collide(const ovoid_prepared_shape &a, const ovoid_prepared_shape &b, const ovoid_options &o = options(),
                       const ovoid_evidence *e = nullptr) noexcept {
    return ovoid_prepared_collide({&a, &b}, &o, e);
}
/** within of prepared shapes. */
inline verdict within(const ovoid_prepared_shape &a, const ovoid_prepared_shape &b, double margin,
                      const ovoid_options &o = options(), const ovoid_evidence *e = nullptr) noexcept {
    return ovoid_prepared_within({&a, &b}, margin, &o, e);
}
/** distance of prepared shapes. */
inline verdict distance(const ovoid_prepared_shape &a, const ovoid_prepared_shape &b,
                        const ovoid_options &o = options(), const ovoid_evidence *e = nullptr) noexcept {
    return ovoid_prepared_distance({&a, &b}, &o, e);
}
/** depth of prepared shapes, without a cover. */
inline verdict depth(const ovoid_prepared_shape &a, const ovoid_prepared_shape &b, const ovoid_options &o = options(),
                     const ovoid_evidence *e = nullptr) noexcept {
    return ovoid_prepared_depth({&a, &b}, &o, e);
}
/** As is_within of an answer. */
inline int is_within(const ovoid_verdict &v, double margin) noexcept { return ovoid_verdict_is_within(&v, margin); }

namespace detail {
/** The places of a batch's results. Throws ARGUMENT: fewer than couples. */
template <class C, class Container> C *receive(Container &into, std::size_t couples) {
    if (items_of<C>(into).size() < couples) fail(OVOID_ERROR_ARGUMENT, "the batch has more couples than places");
    return std::data(into);
}
} // namespace detail

/** One query of many pairs. Bodies, couples, options and the arrays for the answers are borrowed. */
class batch : public ovoid_batch {
  public:
    /** Of contiguous containers of posed_shape (or ovoid_posed_shape) and of couple. */
    template <class Parts, class Couples> batch(const Parts &parts, const Couples &pairs) : ovoid_batch{} {
        const auto p = detail::items_of<ovoid_posed_shape>(parts);
        const auto c = detail::items_of<ovoid_couple>(pairs);
        bodies = p.data(), body_count = p.size(), couples = c.data(), couple_count = c.size();
    }
    /** Options of all queries. */
    batch &with_options(const ovoid_options &o) noexcept { return options = &o, *this; }
    /** Options must outlive the batch. */
    batch &with_options(const ovoid_options &&) = delete;
    /** Earlier proofs (all zero: none), which are replaced by the new ones. Throws ARGUMENT: fewer than couples. */
    template <class Proofs> batch &with_proofs(Proofs &kept) { return proofs = receive<ovoid_proof>(kept), *this; }
    /** Receives verdicts. Throws ARGUMENT: fewer than couples. */
    template <class Verdicts> batch &with_verdicts(Verdicts &into) {
        return verdicts = receive<ovoid_verdict>(into), *this;
    }
    /** Receives answers. Throws ARGUMENT: fewer than couples. */
    template <class Answers> batch &with_answers(Answers &into) { return answers = receive<ovoid_answer>(into), *this; }
    /** Receives points and normals, without the rest of each answer. Throws ARGUMENT: fewer than couples. */
    template <class Witnesses> batch &with_witnesses(Witnesses &into) {
        return witnesses = receive<ovoid_witness>(into), *this;
    }

  private:
    template <class C, class Container> C *receive(Container &into) const {
        return detail::receive<C>(into, couple_count);
    }
};

/** collide for each couple. Throws INDEX (place: the couple); then nothing is written. */
inline void collide_batch(const ovoid_batch &b) {
    ovoid_error e;
    detail::require(ovoid_collide_batch(&b, &e), e);
}
/** within for each couple. Throws INDEX. */
inline void within_batch(const ovoid_batch &b, double margin) {
    ovoid_error e;
    detail::require(ovoid_within_batch(&b, margin, &e), e);
}
/** distance for each couple. Throws INDEX. */
inline void distance_batch(const ovoid_batch &b) {
    ovoid_error e;
    detail::require(ovoid_distance_batch(&b, &e), e);
}
/** depth for each couple, without covers. Throws INDEX. */
inline void depth_batch(const ovoid_batch &b) {
    ovoid_error e;
    detail::require(ovoid_depth_batch(&b, &e), e);
}

/** The smooth bracket of the signed distance. order: 0 values, 1 also gradients, 2 also Hessians. */
inline ovoid_smooth compute_smooth(const pair &p, int order) noexcept { return ovoid_pair_compute_smooth(&p, order); }
/** The gradient of the exact signed distance, as far as an answer proves it. c: the cover of a depth. */
inline ovoid_gradient compute_gradient(const pair &p, const ovoid_answer &a, const ovoid_cover *c = nullptr) noexcept {
    return ovoid_answer_compute_gradient(&p, &a, c);
}

/** The word for results, for example "separated". */
inline const char *name(ovoid_status status) noexcept { return ovoid_status_get_name(status); }
/** The word for results, for example "gjk". */
inline const char *name(ovoid_stage stage) noexcept { return ovoid_stage_get_name(stage); }
/** The word for results, for example "precision". */
inline const char *name(ovoid_limit limit) noexcept { return ovoid_limit_get_name(limit); }
/** The word for results, for example "points". */
inline const char *name(ovoid_proof_kind kind) noexcept { return ovoid_proof_kind_get_name(kind); }

/** Tables of facial area splitting, owned; they borrow the polytope's shape. */
class areas : public detail::owner<detail::pointer<ovoid_areas>, ovoid_areas, ovoid_areas_destroy> {
  public:
    using owner::owner;
    /** Of a polyhedron and an ellipsoid inside it. k: cells per cube edge, a power of two from 1 to 64. Throws as the C
     * function fails. */
    static areas create(const ovoid_polytope &p, const ovoid_ellipsoid &e, ovoid_split split, std::uint32_t k = 1,
                        const ovoid_allocator *allocator = nullptr) {
        ovoid_error error;
        const ovoid_areas_options o = {split, k, allocator};
        return areas(detail::require(ovoid_areas_create(&p, &e, &o, &error), error));
    }
    /** The size of the tables. */
    ovoid_area_counts counts() const noexcept { return ovoid_areas_get_counts(get()); }
    /** The point at which the ray from the ellipsoid's centre leaves the polyhedron. */
    ovoid_exit find_exit(const vec3 &direction, const vec3 &toward, ovoid_area_rule rule) const noexcept {
        return ovoid_areas_find_exit(get(), direction, toward, rule);
    }
    /** The vertex extreme along a direction. touched (may be nullptr): vertices tested. */
    std::uint32_t find_support(const vec3 &direction, std::uint32_t *touched = nullptr) const noexcept {
        return ovoid_areas_find_support(get(), direction, touched);
    }
};

/** Cuts every triangle along the planes of sphere space and counts the pieces. */
inline ovoid_split_counts compute_split(const ovoid_polytope &p, const ovoid_ellipsoid &e) noexcept {
    return ovoid_polytope_compute_split(&p, &e);
}
/** The online steps of the paper for a pair: a heuristic. a, b: the tables of the shapes, nullptr for a flat one. */
inline ovoid_paper_bounds compute_paper_bounds(const pair &p, const areas *a, const areas *b, ovoid_area_rule rule,
                                               double threshold) noexcept {
    const ovoid_areas *both[2] = {a ? a->get() : nullptr, b ? b->get() : nullptr};
    return ovoid_paper_compute_bounds(&p, both, rule, threshold);
}

} // namespace ovoid

#endif
