/**
 * @file eigen.hpp
 * Eigen's types for <ovoid/ovoid.hpp>, with any scalar and storage order, expressions, maps and blocks included.
 * 3-vectors are vectors. Quaternions, angle-axes and 3x3 matrices are rotations. Transforms and 4x4 matrices are poses.
 * Points are matrices of 3 rows (each column a point) or of 3 columns (each row a point), or vectors x y z x y z ...
 */
#ifndef OVOID_EIGEN_HPP
#define OVOID_EIGEN_HPP

#include "ovoid/cpp/points.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ovoid {
namespace detail {

template <class T, int Rows, int Columns> constexpr bool is_eigen_of_size() {
    if constexpr (std::is_base_of<Eigen::MatrixBase<T>, T>::value)
        return int(T::RowsAtCompileTime) == Rows && int(T::ColsAtCompileTime) == Columns;
    else
        return false;
}
template <class T> constexpr bool is_eigen_vec3() { return is_eigen_of_size<T, 3, 1>() || is_eigen_of_size<T, 1, 3>(); }

/// The numbers of a matrix, row by row.
template <std::size_t N, class M> std::array<double, N> eigen_rows(const M &expression) {
    const auto m = expression.eval();
    const Eigen::Index columns = m.cols();
    std::array<double, N> rows{};
    for (std::size_t i = 0; i < N; i++) {
        const Eigen::Index k = static_cast<Eigen::Index>(i);
        rows[i] = static_cast<double>(m(k / columns, k % columns));
    }
    return rows;
}
template <class M, std::size_t N> M eigen_from_rows(const std::array<double, N> &rows) {
    M m;
    for (std::size_t i = 0; i < N; i++) {
        const Eigen::Index k = static_cast<Eigen::Index>(i), columns = m.cols();
        m(k / columns, k % columns) = static_cast<typename M::Scalar>(rows[i]);
    }
    return m;
}

} // namespace detail

/** A vector of three. */
template <class T> struct vec3_traits<T, std::enable_if_t<detail::is_eigen_vec3<T>()>> {
    /** True for plain vectors of doubles, which are read without a copy. */
    static constexpr bool is_packed = std::is_same<typename T::Scalar, double>::value &&
                                      std::is_same<typename T::PlainObject, T>::value &&
                                      sizeof(T) == 3 * sizeof(double);
    /** Converts from Eigen. */
    static ovoid_vec3 get(const T &expression) {
        const auto v = expression.eval();
        return {static_cast<double>(v(0)), static_cast<double>(v(1)), static_cast<double>(v(2))};
    }
    /** Converts to Eigen. */
    static T make(const ovoid_vec3 &v) {
        using scalar = typename T::Scalar;
        return {static_cast<scalar>(v.x), static_cast<scalar>(v.y), static_cast<scalar>(v.z)};
    }
};

/** A quaternion. Eigen's constructor takes w first, but its coeffs() have w last: here members are read by name. */
template <class T> struct quat_traits<T, std::enable_if_t<std::is_base_of<Eigen::QuaternionBase<T>, T>::value>> {
    /** Converts from Eigen. */
    static ovoid_quat get(const T &q) noexcept {
        return {static_cast<double>(q.w()), static_cast<double>(q.x()), static_cast<double>(q.y()),
                static_cast<double>(q.z())};
    }
    /** Converts to Eigen; the norm may differ from 1. */
    static T make(const ovoid_quat &q) {
        using scalar = typename T::Scalar;
        return {static_cast<scalar>(q.w), static_cast<scalar>(q.x), static_cast<scalar>(q.y), static_cast<scalar>(q.z)};
    }
};

/** An angle and a unit axis. */
template <class S> struct quat_traits<Eigen::AngleAxis<S>, void> {
    /** Converts from Eigen. Throws as ovoid_pose_make_axis_angle fails. */
    static ovoid_quat get(const Eigen::AngleAxis<S> &turn) {
        return pose::axis_angle({}, vec3_traits<typename Eigen::AngleAxis<S>::Vector3>::get(turn.axis()),
                                static_cast<double>(turn.angle()))
            .rotation;
    }
};

/** A rotation matrix. */
template <class T> struct quat_traits<T, std::enable_if_t<detail::is_eigen_of_size<T, 3, 3>()>> {
    /** Converts from Eigen. Throws as ovoid_pose_make_matrix fails. */
    static ovoid_quat get(const T &m) { return detail::rotation_of(detail::eigen_rows<9>(m)); }
    /** Converts to Eigen. */
    static T make(const ovoid_quat &q) { return detail::eigen_from_rows<T>(pose(vec3(), quat(q)).rotation_matrix()); }
};

/** A homogeneous matrix. */
template <class T> struct pose_traits<T, std::enable_if_t<detail::is_eigen_of_size<T, 4, 4>()>> {
    /** Converts from Eigen. Throws as ovoid_pose_make_transform fails. */
    static ovoid_pose get(const T &m) { return detail::pose_of(detail::eigen_rows<16>(m)); }
    /** Converts to Eigen. */
    static T make(const ovoid_pose &p) { return detail::eigen_from_rows<T>(pose(p).row_major()); }
};

/** A transform: Isometry3d, Affine3d (refused if it scales or shears), Projective3d. */
template <class S, int Mode, int Options> struct pose_traits<Eigen::Transform<S, 3, Mode, Options>, void> {
    /** Converts from Eigen. Throws as ovoid_pose_make_transform fails. */
    static ovoid_pose get(const Eigen::Transform<S, 3, Mode, Options> &t) {
        return detail::pose_of(detail::eigen_rows<16>(Eigen::Transform<S, 3, Eigen::Projective>(t).matrix()));
    }
    /** Converts to Eigen. */
    static Eigen::Transform<S, 3, Mode, Options> make(const ovoid_pose &p) {
        using transform = Eigen::Transform<S, 3, Mode, Options>;
        transform made = transform::Identity();
        const std::array<double, 16> rows = pose(p).row_major();
        for (Eigen::Index i = 0; i < 3; i++)
            for (Eigen::Index j = 0; j < 4; j++)
                made.matrix()(i, j) = static_cast<S>(rows[static_cast<std::size_t>(4 * i + j)]);
        return made;
    }
};

/** Points: the columns of 3 x n, the rows of n x 3 (n not 3), or a vector x y z x y z ... */
template <class T> struct points_traits<T, std::enable_if_t<std::is_base_of<Eigen::MatrixBase<T>, T>::value>> {
    /**
     * Copies the numbers only if they are not stored as x y z x y z ... Throws ARGUMENT if the length of a vector is
     * not divisible by three.
     */
    static point_array get(const T &points) {
        constexpr int rows = T::RowsAtCompileTime, columns = T::ColsAtCompileTime;
        constexpr bool is_vector = rows == 1 || columns == 1, is_by_column = rows == 3 && columns != 3;
        static_assert(is_vector || is_by_column || (columns == 3 && rows != 3),
                      "say which are the points: give a Matrix<S, 3, Dynamic> or a Matrix<S, Dynamic, 3>");
        if constexpr (is_vector)
            if (points.size() % 3 != 0)
                detail::fail(OVOID_ERROR_ARGUMENT, "the number of coordinates is not divisible by three",
                             points.size());
        constexpr bool lies_right = is_vector || (is_by_column ? !T::IsRowMajor : bool(T::IsRowMajor));
        if constexpr (lies_right && std::is_same<typename T::Scalar, double>::value &&
                      std::is_same<typename T::PlainObject, T>::value) {
            return {points.data(), static_cast<std::size_t>(points.size()) / 3};
        } else {
            const auto p = points.eval();
            std::vector<double> copy;
            copy.reserve(static_cast<std::size_t>(p.size()));
            for (Eigen::Index i = 0; i < p.size(); i++) {
                if constexpr (is_vector)
                    copy.push_back(static_cast<double>(p(i)));
                else
                    copy.push_back(static_cast<double>(is_by_column ? p(i % 3, i / 3) : p(i / 3, i % 3)));
            }
            return point_array(std::move(copy));
        }
    }
};

} // namespace ovoid

#endif
