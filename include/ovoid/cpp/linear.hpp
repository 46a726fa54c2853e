/**
 * @file linear.hpp
 * Vectors, quaternions and poses: the C structs with constructors from other libraries' types.
 *
 * These types convert: a 3-vector is std::array<S, 3>, S[3] or anything with members x, y, z and no w (ovoid_vec3,
 * glm::vec3, messages of ROS); a quaternion is anything with members w, x, y, z, whatever their order; S is any
 * arithmetic type. <ovoid/eigen.hpp> adds Eigen's vectors, quaternions, matrices and transforms, <ovoid/glm.hpp> glm's
 * matrices; for a type of your own specialise vec3_traits, quat_traits or pose_traits. to<T>(value) converts back.
 * Conversion is by value; from float it is exact, to float it rounds.
 */
#ifndef OVOID_CPP_LINEAR_HPP
#define OVOID_CPP_LINEAR_HPP

#include "ovoid/cpp/error.hpp"
#include "ovoid/linear.h"

#include <array>

namespace ovoid {

/**
 * How a 3-vector of another library is read and made: static ovoid_vec3 get(const T &) and static T make(const
 * ovoid_vec3 &). is_packed: a T consists of three doubles x, y, z, so that arrays of them need no copy.
 */
template <class T, class = void> struct vec3_traits;
/** How a rotation is read and made: static ovoid_quat get(const T &), which may throw, static T make(const ovoid_quat
 * &). */
template <class T, class = void> struct quat_traits;
/** How a pose is read and made: static ovoid_pose get(const T &), which may throw, static T make(const ovoid_pose &).
 */
template <class T, class = void> struct pose_traits;

namespace detail {

template <class T> using plain = std::remove_cv_t<std::remove_reference_t<T>>;

template <class T, class = void> struct has_xyz : std::false_type {};
template <class T>
struct has_xyz<T, std::enable_if_t<std::is_arithmetic<plain<decltype(std::declval<T &>().x)>>::value &&
                                   std::is_arithmetic<plain<decltype(std::declval<T &>().y)>>::value &&
                                   std::is_arithmetic<plain<decltype(std::declval<T &>().z)>>::value>>
    : std::true_type {};
template <class T, class = void> struct has_w : std::false_type {};
template <class T>
struct has_w<T, std::enable_if_t<std::is_arithmetic<plain<decltype(std::declval<T &>().w)>>::value>> : std::true_type {
};

/// Whether Traits<T>::get takes a T.
template <template <class, class> class Traits, class T, class = void> struct is_read : std::false_type {};
template <template <class, class> class Traits, class T>
struct is_read<Traits, T, decltype(void(Traits<T, void>::get(std::declval<const T &>())))> : std::true_type {};

/// T converts by Traits, and is not a type of this library, which the copy constructor takes.
template <template <class, class> class Traits, class T, class Own>
using enable_foreign = std::enable_if_t<!std::is_base_of<Own, T>::value && is_read<Traits, T>::value, int>;

} // namespace detail

/** Whether a type with members x, y, z consists of three doubles in that order; specialise it for your types. */
template <class T> struct is_packed_vec3 : std::is_base_of<ovoid_vec3, T> {};

/** Anything with members x, y, z and no w. */
template <class T> struct vec3_traits<T, std::enable_if_t<detail::has_xyz<T>::value && !detail::has_w<T>::value>> {
    /** Only where the order of the members is known. */
    static constexpr bool is_packed = is_packed_vec3<T>::value && sizeof(T) == sizeof(ovoid_vec3);
    /** Reads the vector. */
    static constexpr ovoid_vec3 get(const T &v) noexcept {
        return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    }
    /** Makes a vector. */
    static T make(const ovoid_vec3 &v) {
        T made{};
        made.x = static_cast<detail::plain<decltype(made.x)>>(v.x);
        made.y = static_cast<detail::plain<decltype(made.y)>>(v.y);
        made.z = static_cast<detail::plain<decltype(made.z)>>(v.z);
        return made;
    }
};

/** std::array of three numbers. */
template <class S> struct vec3_traits<std::array<S, 3>, std::enable_if_t<std::is_arithmetic<S>::value>> {
    /** Of doubles. */
    static constexpr bool is_packed = std::is_same<S, double>::value;
    /** Reads the vector. */
    static constexpr ovoid_vec3 get(const std::array<S, 3> &v) noexcept {
        return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    }
    /** Makes a vector. */
    static std::array<S, 3> make(const ovoid_vec3 &v) {
        return {static_cast<S>(v.x), static_cast<S>(v.y), static_cast<S>(v.z)};
    }
};

/** A C array of three numbers. */
template <class S> struct vec3_traits<S[3], std::enable_if_t<std::is_arithmetic<S>::value>> {
    /** Of doubles. */
    static constexpr bool is_packed = std::is_same<S, double>::value;
    /** Reads the vector. */
    static constexpr ovoid_vec3 get(const S (&v)[3]) noexcept {
        return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    }
};

/** Anything with members w, x, y, z. */
template <class T> struct quat_traits<T, std::enable_if_t<detail::has_xyz<T>::value && detail::has_w<T>::value>> {
    /** Reads the quaternion. */
    static constexpr ovoid_quat get(const T &q) noexcept {
        return {static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
    }
    /** Makes a quaternion. */
    static T make(const ovoid_quat &q) {
        T made{};
        made.w = static_cast<detail::plain<decltype(made.w)>>(q.w);
        made.x = static_cast<detail::plain<decltype(made.x)>>(q.x);
        made.y = static_cast<detail::plain<decltype(made.y)>>(q.y);
        made.z = static_cast<detail::plain<decltype(made.z)>>(q.z);
        return made;
    }
};

/** A vector or point; zero by default. */
struct vec3 : ovoid_vec3 {
    /** Zero. */
    constexpr vec3() noexcept : ovoid_vec3{0, 0, 0} {}
    /** From its coordinates. */
    constexpr vec3(double x_, double y_, double z_) noexcept : ovoid_vec3{x_, y_, z_} {}
    /** From the 3-vector of another library. */
    template <class T, detail::enable_foreign<vec3_traits, T, vec3> = 0>
    constexpr vec3(const T &from) : ovoid_vec3(vec3_traits<T>::get(from)) {}
};

namespace detail {

/// N numbers of anything that std::data and std::size take, as doubles; throws ARGUMENT if there are not N.
template <std::size_t N, class M> std::array<double, N> numbers_of(const M &m) {
    if (std::size(m) != N)
        fail(OVOID_ERROR_ARGUMENT, "not as many numbers as a quaternion (4) or a matrix (9 or 16) has");
    std::array<double, N> numbers{};
    for (std::size_t i = 0; i < N; i++) numbers[i] = static_cast<double>(std::data(m)[i]);
    return numbers;
}
/// The square matrix with rows and columns exchanged.
template <std::size_t N> std::array<double, N> transposed(const std::array<double, N> &m) noexcept {
    constexpr std::size_t side = N == 9 ? 3 : 4;
    std::array<double, N> result{};
    for (std::size_t i = 0; i < N; i++) result[i] = m[i % side * side + i / side];
    return result;
}
/// The rotation of a 3x3 matrix, row by row.
inline ovoid_quat rotation_of(const std::array<double, 9> &m) {
    ovoid_pose made;
    ovoid_error e;
    require(ovoid_pose_make_matrix(m.data(), vec3(), &made, &e), e);
    return made.rotation;
}
/// The pose of a 4x4 matrix, row by row.
inline ovoid_pose pose_of(const std::array<double, 16> &m) {
    ovoid_pose made;
    ovoid_error e;
    require(ovoid_pose_make_transform(m.data(), &made, &e), e);
    return made;
}

} // namespace detail

/** A rotation: a quaternion of any norm but zero; the identity by default. */
struct quat : ovoid_quat {
    /** The identity. */
    constexpr quat() noexcept : ovoid_quat{1, 0, 0, 0} {}
    /** From its components, w first. */
    constexpr quat(double w_, double x_, double y_, double z_) noexcept : ovoid_quat{w_, x_, y_, z_} {}
    /**
     * From a quaternion or rotation matrix of another library; a matrix throws in the cases of ovoid_pose_make_matrix.
     */
    template <class T, detail::enable_foreign<quat_traits, T, quat> = 0>
    constexpr quat(const T &from) : ovoid_quat(quat_traits<T>::get(from)) {}
    /** From four numbers in the order w, x, y, z: an array, std::vector or span. Throws ARGUMENT. */
    template <class Q> static quat wxyz(const Q &q) {
        const auto n = detail::numbers_of<4>(q);
        return {n[0], n[1], n[2], n[3]};
    }
    /** From four numbers in the order x, y, z, w of Eigen's coeffs, ROS and Bullet. Throws ARGUMENT. */
    template <class Q> static quat xyzw(const Q &q) {
        const auto n = detail::numbers_of<4>(q);
        return {n[3], n[0], n[1], n[2]};
    }
    /** From nine numbers of a rotation matrix, row by row. Throws as ovoid_pose_make_matrix refuses. */
    template <class M> static quat from_row_major(const M &m) { return detail::rotation_of(detail::numbers_of<9>(m)); }
    /** From nine numbers of a rotation matrix, column by column. Throws as ovoid_pose_make_matrix refuses. */
    template <class M> static quat from_column_major(const M &m) {
        return detail::rotation_of(detail::transposed(detail::numbers_of<9>(m)));
    }
};

/** The position and rotation of a body: world = position + R(rotation) local; the identity by default. */
struct pose : ovoid_pose {
    /** The identity, as ovoid_pose_make_identity. */
    constexpr pose() noexcept : ovoid_pose{vec3(), quat()} {}
    /** At a position, with a rotation or without. */
    constexpr pose(const vec3 &position_, const quat &rotation_ = {}) noexcept : ovoid_pose{position_, rotation_} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_pose>::value, int> = 0>
    constexpr pose(const T &from) noexcept : ovoid_pose(from) {}
    /** From a transform or 4x4 matrix of another library; throws as ovoid_pose_make_transform refuses. */
    template <class T, detail::enable_foreign<pose_traits, T, ovoid_pose> = 0>
    pose(const T &from) : ovoid_pose(pose_traits<T>::get(from)) {}

    /** URDF's xyz and rpy: R = Rz(yaw) Ry(pitch) Rx(roll), radians. */
    static pose rpy(const vec3 &xyz, const vec3 &roll_pitch_yaw) noexcept {
        return ovoid_pose_make_rpy(xyz, roll_pitch_yaw);
    }
    /** Turned by an angle in radians about an axis of any length but zero. Throws as ovoid_pose_make_axis_angle
     * refuses. */
    static pose axis_angle(const vec3 &position, const vec3 &axis, double angle) {
        ovoid_pose made;
        const ovoid_code code = ovoid_pose_make_axis_angle(position, axis, angle, &made);
        if (code != OVOID_OK) detail::fail(code);
        return made;
    }
    /** From the sixteen numbers of a 4x4 matrix, row by row. Throws as ovoid_pose_make_transform refuses. */
    template <class M> static pose from_row_major(const M &m) { return detail::pose_of(detail::numbers_of<16>(m)); }
    /** From the sixteen numbers of a 4x4 matrix, column by column (OpenGL). Throws as ovoid_pose_make_transform
     * refuses. */
    template <class M> static pose from_column_major(const M &m) {
        return detail::pose_of(detail::transposed(detail::numbers_of<16>(m)));
    }

    /** The 4x4 matrix, row by row; last row 0 0 0 1. */
    std::array<double, 16> row_major() const noexcept {
        std::array<double, 16> m;
        ovoid_pose_compute_transform(this, m.data());
        return m;
    }
    /** The 4x4 matrix, column by column. */
    std::array<double, 16> column_major() const noexcept { return detail::transposed(row_major()); }
    /** The 3x3 rotation matrix, row by row. */
    std::array<double, 9> rotation_matrix() const noexcept {
        std::array<double, 9> m;
        ovoid_pose_compute_matrix(this, m.data());
        return m;
    }
    /** The inverse pose. */
    pose inverse() const noexcept { return ovoid_pose_compute_inverse(this); }
    /** The world point in the local frame. */
    vec3 local(const vec3 &world) const noexcept { return ovoid_pose_compute_local_point(this, world); }
    /** OVOID_OK, or what is wrong with the pose: NOT_FINITE, RANGE, ROTATION. */
    ovoid_code validate() const noexcept { return ovoid_pose_validate(this); }
};

/** The pose of a part: posed by inner in a body that is posed by outer. */
inline pose operator*(const pose &outer, const pose &inner) noexcept {
    return ovoid_pose_compute_product(&outer, &inner);
}
/** The local point in the world frame. */
inline vec3 operator*(const pose &at, const vec3 &local) noexcept { return ovoid_pose_compute_point(&at, local); }

/** A vector as a 3-vector of another library. */
template <class T> T to(const ovoid_vec3 &v) { return vec3_traits<T>::make(v); }
/** A rotation as that of another library: a quaternion as it is, or its matrix. */
template <class T> T to(const ovoid_quat &q) { return quat_traits<T>::make(q); }
/** A pose as a transform or 4x4 matrix of another library. */
template <class T> T to(const ovoid_pose &p) { return pose_traits<T>::make(p); }

} // namespace ovoid

#endif
