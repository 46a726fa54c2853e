/**
 * @file glm.hpp
 * glm's types for <ovoid/ovoid.hpp>: 3x3 matrices are rotations, 4x4 matrices are poses, arrays of dvec3 are read
 * without a copy. glm's vectors and quaternions convert by their members, without this header. glm stores matrices by
 * columns.
 */
#ifndef OVOID_GLM_HPP
#define OVOID_GLM_HPP

#include "ovoid/cpp/linear.hpp"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace ovoid {

/** Arrays of dvec3 are read without a copy. */
template <glm::qualifier Q> struct is_packed_vec3<glm::vec<3, double, Q>> : std::true_type {};

/** A rotation matrix. */
template <class S, glm::qualifier Q> struct quat_traits<glm::mat<3, 3, S, Q>, void> {
    /** Converts from glm. Throws as ovoid_pose_make_matrix fails. */
    static ovoid_quat get(const glm::mat<3, 3, S, Q> &m) {
        std::array<double, 9> rows{};
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++)
                rows[static_cast<std::size_t>(3 * row + column)] = static_cast<double>(m[column][row]);
        return detail::rotation_of(rows);
    }
    /** Converts to glm. */
    static glm::mat<3, 3, S, Q> make(const ovoid_quat &q) {
        const std::array<double, 9> rows = pose(vec3(), quat(q)).rotation_matrix();
        glm::mat<3, 3, S, Q> m;
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++)
                m[column][row] = static_cast<S>(rows[static_cast<std::size_t>(3 * row + column)]);
        return m;
    }
};

/** A homogeneous matrix. */
template <class S, glm::qualifier Q> struct pose_traits<glm::mat<4, 4, S, Q>, void> {
    /** Converts from glm. Throws as ovoid_pose_make_transform fails. */
    static ovoid_pose get(const glm::mat<4, 4, S, Q> &m) {
        std::array<double, 16> rows{};
        for (int row = 0; row < 4; row++)
            for (int column = 0; column < 4; column++)
                rows[static_cast<std::size_t>(4 * row + column)] = static_cast<double>(m[column][row]);
        return detail::pose_of(rows);
    }
    /** Converts to glm. */
    static glm::mat<4, 4, S, Q> make(const ovoid_pose &p) {
        const std::array<double, 16> rows = pose(p).row_major();
        glm::mat<4, 4, S, Q> m;
        for (int row = 0; row < 4; row++)
            for (int column = 0; column < 4; column++)
                m[column][row] = static_cast<S>(rows[static_cast<std::size_t>(4 * row + column)]);
        return m;
    }
};

} // namespace ovoid

#endif
