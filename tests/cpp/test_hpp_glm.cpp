// glm's types through <ovoid/glm.hpp>. Truth: glm's own product of a matrix and a point, the quaternion's components by
// name, and the bytes of the shape that C makes of the same coordinates.
#include "same.hpp"

#if __has_include(<glm/gtc/quaternion.hpp>)
#include <ovoid/glm.hpp>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

using ovoid::pose;
using ovoid::shape;
using ovoid::vec3;

namespace {

uint64_t state = 19;
double any() { return random_uniform(&state, -2, 2); }
glm::dvec3 any_vector() {
    const double x = any(), y = any(), z = any();
    return {x, y, z};
}

// The pose takes a point where glm's matrix takes it: 1e-14 for doubles, 1e-5 for floats, of lengths below 10.
void expect_moves(const pose &p, const glm::dmat4 &truth, double tolerance) {
    for (int k = 0; k < 4; k++) {
        const glm::dvec3 local = any_vector(), there(truth * glm::dvec4(local, 1));
        CHECK_LE(glm::length(there - ovoid::to<glm::dvec3>(p * local)), tolerance);
    }
}

double distance_of(const glm::dmat4 &a, const glm::dmat4 &b) {
    double largest = 0;
    for (int i = 0; i < 4; i++) largest = std::max(largest, glm::length(a[i] - b[i]));
    return largest;
}

void check_poses() {
    for (int i = 0; i < 200; i++) {
        const glm::dvec3 t = any_vector(), axis = glm::normalize(any_vector());
        const double angle = any();
        const glm::dmat4 m = glm::rotate(glm::translate(glm::dmat4(1), t), angle, axis);
        const glm::dquat q = glm::angleAxis(angle, axis);
        expect_moves(m, m, 1e-14);
        expect_moves(glm::mat4(m), m, 1e-5);
        expect_moves(pose(t, q), m, 1e-14);
        expect_moves(pose(t, glm::dmat3(m)), m, 1e-14);
        expect_moves(pose(glm::vec3(t), glm::quat(q)), m, 1e-5);
        expect_moves(pose::axis_angle(t, axis, angle), m, 1e-14);
        const pose p = m;
        CHECK_LE(distance_of(ovoid::to<glm::dmat4>(p), m), 1e-14);
        CHECK_LE(distance_of(glm::dmat4(ovoid::to<glm::mat4>(p)), m), 1e-6);
        CHECK_LE(distance_of(glm::dmat4(ovoid::to<glm::dmat3>(p.rotation)), glm::dmat4(glm::dmat3(m))), 1e-14);
        CHECK_LE(1 - std::abs(glm::dot(ovoid::to<glm::dquat>(p.rotation), q)), 1e-14);
    }
    // The order of the components: by name, whatever glm stores.
    glm::dquat q(1, 0, 0, 0);
    q.w = 4, q.x = 1, q.y = 2, q.z = 3;
    const ovoid_quat named = ovoid::quat(q);
    CHECK(named.w == 4 && named.x == 1 && named.y == 2 && named.z == 3);
    const glm::dquat back = ovoid::to<glm::dquat>(named);
    CHECK(back.w == 4 && back.x == 1 && back.y == 2 && back.z == 3);
    CHECK(throws(OVOID_ERROR_ROTATION, -1, "scale", [] { (void)pose(glm::scale(glm::dmat4(1), glm::dvec3(1.5))); }));
    CHECK(throws(OVOID_ERROR_ROTATION, -1, "last row", [] { (void)pose(glm::dmat4(1) * 2.0); }));
}

void check_points() {
    std::vector<glm::dvec3> points;
    std::vector<glm::vec3> small;
    for (int i = 0; i < 12; i++) small.emplace_back(any_vector());
    for (const glm::vec3 &p : small) points.emplace_back(p);
    ovoid_error e;
    const shape truth = adopt(ovoid_shape_create_from_points(&points[0].x, 12, nullptr, &e));
    CHECK(is_same_shape(shape::from_points(points), truth.get()) &&
          is_same_shape(shape::from_points(small), truth.get()));
    CHECK(ovoid::points_of(points).data() == &points[0].x);
    CHECK(is_vec3(vec3(glm::vec3(1, 2, 3)), 1, 2, 3) && ovoid::to<glm::vec3>(vec3(1, 2, 3)) == glm::vec3(1, 2, 3));
    CHECK_EQ(shape::box(glm::dvec3(1, 2, 3)).measures().volume, shape::box({1, 2, 3}).measures().volume);
}

} // namespace

int main() {
    check_poses();
    check_points();
    return check_end();
}
#else
int main() {
    check_skip("glm is absent (libglm-dev)");
    return check_end();
}
#endif
