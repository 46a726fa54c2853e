/**
 * @file points.hpp
 * Points and faces from any container, as the C functions take them, without a copy if the numbers are contiguous
 * doubles.
 *
 * Points are: numbers x y z x y z ... (std::vector<double>, std::array, a C array, std::span, ovoid::span), floats too;
 * or a container of 3-vectors (std::vector<std::array<double, 3>>, of Eigen::Vector3d, of glm::dvec3, std::list, ...).
 * <ovoid/eigen.hpp> adds matrices of 3 rows, whose columns are points, and of 3 columns, whose rows are.
 */
#ifndef OVOID_CPP_POINTS_HPP
#define OVOID_CPP_POINTS_HPP

#include "ovoid/cpp/linear.hpp"
#include "ovoid/shape.h"

#include <initializer_list>
#include <limits>
#include <vector>

namespace ovoid {

/** Points as the C functions take them: a view, or a copy if one was needed. */
class point_array {
  public:
    /** A view of count points, x y z of point i at 3 i; they must outlive it. */
    point_array(const double *xyz, std::size_t count) noexcept : xyz_(xyz), count_(count) {}
    /** Takes over numbers x y z x y z ...; their number is divisible by three. */
    explicit point_array(std::vector<double> &&numbers) noexcept
        : numbers_(std::move(numbers)), xyz_(numbers_.data()), count_(numbers_.size() / 3) {}
    /** Takes over the points of the other. */
    point_array(point_array &&) noexcept = default;
    /** Takes over the points of the other in place of its own. */
    point_array &operator=(point_array &&) noexcept = default;
    /** x y z of point i at 3 i. */
    const double *data() const noexcept { return xyz_; }
    /** Number of points. */
    std::size_t size() const noexcept { return count_; }

  private:
    std::vector<double> numbers_;
    const double *xyz_;
    std::size_t count_;
};

/** How a type of your own gives points: static point_array get(const T &). */
template <class T, class = void> struct points_traits;

namespace detail {

template <class P> using element_of = plain<decltype(*std::begin(std::declval<const P &>()))>;
template <class P, class = void> struct is_contiguous : std::false_type {};
template <class P>
struct is_contiguous<P, decltype(void(std::data(std::declval<const P &>())),
                                 void(std::size(std::declval<const P &>())))> : std::true_type {};
template <class P, class = void> struct has_rows : std::false_type {};
template <class P> struct has_rows<P, decltype(void(std::declval<const P &>().rows()))> : std::true_type {};

template <class P> point_array points_of_numbers(const P &numbers) {
    const std::size_t count = static_cast<std::size_t>(std::distance(std::begin(numbers), std::end(numbers)));
    if (count % 3 != 0)
        fail(OVOID_ERROR_ARGUMENT, "the number of coordinates is not divisible by three",
             static_cast<std::int64_t>(count));
    if constexpr (is_contiguous<P>::value && std::is_same<element_of<P>, double>::value) {
        return {std::data(numbers), count / 3};
    } else {
        std::vector<double> copy;
        copy.reserve(count);
        for (const auto &x : numbers) copy.push_back(static_cast<double>(x));
        return point_array(std::move(copy));
    }
}

template <class P> point_array points_of_vectors(const P &vectors) {
    using element = element_of<P>;
    if constexpr (is_contiguous<P>::value && vec3_traits<element>::is_packed) {
        static_assert(sizeof(element) == 3 * sizeof(double), "is_packed means three doubles and nothing else");
        return {reinterpret_cast<const double *>(std::data(vectors)), std::size(vectors)};
    } else {
        std::vector<double> copy;
        for (const auto &vector : vectors) {
            const ovoid_vec3 v = vec3_traits<element>::get(vector);
            copy.insert(copy.end(), {v.x, v.y, v.z});
        }
        return point_array(std::move(copy));
    }
}

} // namespace detail

/** The points of a container. Throws ARGUMENT if the number of coordinates is not divisible by three. */
template <class P> point_array points_of(const P &points) {
    if constexpr (detail::is_read<points_traits, P>::value) {
        return points_traits<P>::get(points);
    } else {
        static_assert(!detail::has_rows<P>::value,
                      "for a matrix include <ovoid/eigen.hpp>, or specialise points_traits");
        using element = detail::element_of<P>;
        if constexpr (std::is_arithmetic<element>::value) {
            return detail::points_of_numbers(points);
        } else {
            static_assert(detail::is_read<vec3_traits, element>::value,
                          "no 3-vectors: include <ovoid/eigen.hpp> or specialise vec3_traits");
            return detail::points_of_vectors(points);
        }
    }
}
/** The points of a list in braces, copied. */
inline point_array points_of(std::initializer_list<vec3> points) { return detail::points_of_vectors(points); }

/** Faces as the C functions take them: indices one face after another, and the size of each. */
class face_array {
  public:
    /** Of a container of faces, each a container of vertex indices. Throws INDEX where one does not fit 32 bits. */
    template <class Faces> explicit face_array(const Faces &faces) {
        for (const auto &face : faces) {
            const std::size_t before = indices_.size();
            for (const auto &index : face) add(index);
            sizes_.push_back(static_cast<std::uint32_t>(indices_.size() - before));
        }
    }
    /** With points, the C struct; it borrows both. */
    ovoid_faces with(const point_array &points) const noexcept {
        return {points.data(), points.size(), indices_.data(), sizes_.data(), sizes_.size()};
    }

  private:
    template <class Index> void add(const Index &index) {
        static_assert(std::is_integral<Index>::value, "a face is a container of integers");
        bool bad = sizeof(Index) > 4 && static_cast<std::uint64_t>(index) > std::numeric_limits<std::uint32_t>::max();
        if constexpr (std::is_signed<Index>::value) bad = bad || index < 0;
        if (bad)
            detail::fail(OVOID_ERROR_INDEX, "an index of a face is negative or needs more than 32 bits",
                         static_cast<std::int64_t>(sizes_.size()));
        indices_.push_back(static_cast<std::uint32_t>(index));
    }
    std::vector<std::uint32_t> indices_, sizes_;
};

} // namespace ovoid

#endif
