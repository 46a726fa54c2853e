// Eigen's types through <ovoid/eigen.hpp>. Truth: Eigen's own product of a transform and a point, the quaternion's
// components by name, and the bytes of the shape that C makes of the same coordinates.
#include "same.hpp"

#if __has_include(<Eigen/Geometry>)
#include <ovoid/eigen.hpp>

using ovoid::pose;
using ovoid::shape;
using ovoid::vec3;

namespace {

uint64_t state = 17;
double any() { return random_uniform(&state, -2, 2); }
Eigen::Vector3d any_vector() {
    const double x = any(), y = any(), z = any();
    return {x, y, z};
}
Eigen::Quaterniond any_quaternion() {
    Eigen::Quaterniond q;
    for (int i = 0; i < 4; i++) q.coeffs()[i] = any();
    return q.normalized();
}

// The pose takes a point where Eigen's transform takes it: 1e-14 for doubles, 1e-5 for floats, of lengths below 10.
void expect_moves(const pose &p, const Eigen::Isometry3d &truth, double tolerance) {
    for (int k = 0; k < 4; k++) {
        const Eigen::Vector3d local = any_vector(), there = truth * local;
        CHECK_LE((there - ovoid::to<Eigen::Vector3d>(p * local)).norm(), tolerance);
    }
}

void check_poses() {
    for (int i = 0; i < 200; i++) {
        const Eigen::Quaterniond q = any_quaternion();
        const Eigen::Vector3d t = any_vector();
        const Eigen::Isometry3d iso = Eigen::Translation3d(t) * q;
        const Eigen::Matrix4d matrix = iso.matrix();
        const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> row_matrix = matrix;
        const Eigen::Matrix3d rotation = iso.linear();
        const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> small_rotation = rotation.cast<float>();
        expect_moves(iso, iso, 1e-14);
        expect_moves(matrix, iso, 1e-14);
        expect_moves(row_matrix, iso, 1e-14);
        expect_moves(Eigen::Affine3d(iso), iso, 1e-14);
        expect_moves(Eigen::AffineCompact3d(iso), iso, 1e-14);
        expect_moves(Eigen::Isometry3f(iso.cast<float>()), iso, 1e-5);
        expect_moves(Eigen::Transform<double, 3, Eigen::Isometry, Eigen::RowMajor>(iso), iso, 1e-14);
        expect_moves(pose(t, q), iso, 1e-14);
        expect_moves(pose(t, rotation), iso, 1e-14);
        expect_moves(pose(t, iso.linear()), iso, 1e-14);
        expect_moves(pose(t.transpose(), small_rotation), iso, 1e-5);
        expect_moves(pose(t.cast<float>(), q.cast<float>()), iso, 1e-5);
        const Eigen::AngleAxisd turn(q);
        expect_moves(pose(iso.translation(), turn), iso, 1e-14);
        // Back.
        const pose p = iso;
        CHECK_LE((ovoid::to<Eigen::Isometry3d>(p).matrix() - matrix).norm(), 1e-14);
        CHECK_LE((ovoid::to<Eigen::Matrix4d>(p) - matrix).norm(), 1e-14);
        CHECK_LE((ovoid::to<Eigen::Matrix4f>(p) - matrix.cast<float>()).norm(), 1e-6);
        CHECK_LE((ovoid::to<Eigen::Affine3f>(p).matrix() - matrix.cast<float>()).norm(), 1e-6);
        CHECK_LE((ovoid::to<Eigen::Matrix3d>(p.rotation) - rotation).norm(), 1e-14);
        CHECK_LE(ovoid::to<Eigen::Quaterniond>(p.rotation).angularDistance(q), 1e-7);
    }
    // The order of the components: Eigen's coeffs are x y z w.
    const Eigen::Quaterniond q(4, 1, 2, 3);
    const ovoid_quat named = ovoid::quat(q), counted = ovoid::quat::xyzw(q.coeffs());
    CHECK(named.w == 4 && named.x == 1 && named.y == 2 && named.z == 3 && is_same(named, counted));
    CHECK(ovoid::to<Eigen::Quaterniond>(named).w() == 4 && ovoid::to<Eigen::Quaterniond>(named).z() == 3);
    CHECK(ovoid::quat(Eigen::Map<const Eigen::Quaterniond>(q.coeffs().data())).w == 4);

    Eigen::Affine3d scaled = Eigen::Affine3d::Identity();
    scaled.scale(1.5);
    CHECK(throws(OVOID_ERROR_ROTATION, -1, "scale", [&] { (void)pose(scaled); }));
    const Eigen::Matrix4d flipped = Eigen::Vector4d(1, 1, -1, 1).asDiagonal();
    CHECK(throws(OVOID_ERROR_ROTATION, -1, "reflection", [&] { (void)pose(flipped); }));
}

void check_vectors() {
    const Eigen::Vector3d v(1, 2, 3);
    CHECK(is_vec3(vec3(v), 1, 2, 3) && is_vec3(vec3(v.transpose()), 1, 2, 3) &&
          is_vec3(vec3(v.cast<float>()), 1, 2, 3));
    CHECK(is_vec3(vec3(2 * v + v), 3, 6, 9) && is_vec3(vec3(Eigen::Map<const Eigen::Vector3d>(v.data())), 1, 2, 3));
    CHECK(ovoid::to<Eigen::Vector3f>(vec3(1, 2, 3)) == Eigen::Vector3f(1, 2, 3));
    CHECK_EQ(shape::box(v).measures().volume, shape::box({1, 2, 3}).measures().volume);
}

// The same twelve points, whose coordinates are exact in float, in every layout.
void check_points() {
    Eigen::Matrix3Xd columns(3, 12);
    for (Eigen::Index i = 0; i < 36; i++) columns(i % 3, i / 3) = static_cast<float>(any());
    ovoid_error e;
    const shape truth = adopt(ovoid_shape_create_from_points(columns.data(), 12, nullptr, &e));
    const Eigen::MatrixX3d rows = columns.transpose();
    const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> packed_rows = rows;
    const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> split_columns = columns;
    const Eigen::VectorXd flat = Eigen::Map<const Eigen::VectorXd>(columns.data(), 36);
    std::vector<Eigen::Vector3d> vectors;
    std::vector<Eigen::Vector3f> small;
    for (Eigen::Index i = 0; i < 12; i++) {
        vectors.push_back(columns.col(i));
        small.push_back(columns.col(i).cast<float>());
    }
    CHECK(is_same_shape(shape::from_points(columns), truth.get()) &&
          is_same_shape(shape::from_points(rows), truth.get()));
    CHECK(is_same_shape(shape::from_points(packed_rows), truth.get()));
    CHECK(is_same_shape(shape::from_points(split_columns), truth.get()));
    CHECK(is_same_shape(shape::from_points(flat), truth.get()));
    CHECK(is_same_shape(shape::from_points(columns.cast<float>()), truth.get()));
    CHECK(is_same_shape(shape::from_points(columns.transpose()), truth.get()));
    CHECK(is_same_shape(shape::from_points(Eigen::Map<const Eigen::Matrix3Xd>(columns.data(), 3, 12)), truth.get()));
    CHECK(is_same_shape(shape::from_points(vectors), truth.get()) &&
          is_same_shape(shape::from_points(small), truth.get()));
    CHECK(ovoid::points_of(columns).data() == columns.data() && ovoid::points_of(vectors).data() == vectors[0].data());
    CHECK(ovoid::points_of(packed_rows).data() == packed_rows.data() && ovoid::points_of(flat).data() == flat.data());
    CHECK(throws(OVOID_ERROR_ARGUMENT, 35, "divisible", [&] { shape::from_points(Eigen::VectorXd(flat.head(35))); }));
}

// Bodies where Eigen says: two boxes of half size 1, one turned by an eighth and moved by 5: 5 - 1 - sqrt 2.
void check_query() {
    const shape box = shape::box(Eigen::Vector3d::Ones());
    Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
    at.translate(Eigen::Vector3d(5, 0, 0)).rotate(Eigen::AngleAxisd(std::acos(-1.0) / 4, Eigen::Vector3d::UnitZ()));
    const ovoid::answer a = ovoid::distance({box, box, Eigen::Isometry3d::Identity(), at});
    CHECK_NEAR(a.lower, 4 - std::sqrt(2.0), 1e-8);
    CHECK_NEAR(ovoid::to<Eigen::Vector3d>(a.normal).x(), 1, 1e-6);
    auto world = ovoid::world::create();
    world.add({box, at});
    CHECK_NEAR(world.at(world.find_next(0)).body.pose.position.x, 5, 0);
}

} // namespace

int main() {
    check_poses();
    check_vectors();
    check_points();
    check_query();
    return check_end();
}
#else
int main() {
    check_skip("Eigen is absent (libeigen3-dev)");
    return check_end();
}
#endif
