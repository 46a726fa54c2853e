// The C++ header against the C functions: values and what converts to them, shapes from every kind of container,
// owners, errors, memory. Truth: the bytes of what C makes from the same numbers; of conversions, where a known turn
// takes x.
#include "same.hpp"

#include <deque>
#include <list>
#include <string>
#if __cplusplus >= 202002L
#include <span>
#endif

#include "countdown.h"

using ovoid::pose;
using ovoid::quat;
using ovoid::shape;
using ovoid::vec3;

// What costs nothing and what cannot be done, as the compiler sees it.
static_assert(sizeof(vec3) == sizeof(ovoid_vec3) && sizeof(quat) == sizeof(ovoid_quat), "no fields are added");
static_assert(sizeof(pose) == sizeof(ovoid_pose) && sizeof(ovoid::pair) == sizeof(ovoid_pair), "no fields are added");
static_assert(sizeof(ovoid::shape_view) == sizeof(void *) && sizeof(shape) == sizeof(void *), "a handle is a pointer");
static_assert(sizeof(ovoid::compound) == sizeof(void *) && sizeof(ovoid::world) == sizeof(void *),
              "a handle is a pointer");
static_assert(!std::is_copy_constructible<shape>::value && !std::is_copy_assignable<shape>::value, "owners move");
static_assert(!std::is_copy_constructible<ovoid::compound>::value && !std::is_copy_constructible<ovoid::world>::value,
              "owners move");
static_assert(std::is_nothrow_move_constructible<shape>::value && std::is_nothrow_move_assignable<shape>::value, "");
static_assert(std::is_nothrow_move_constructible<ovoid::world>::value, "");
static_assert(noexcept(ovoid::distance(std::declval<const ovoid::pair &>())), "queries never throw");
static_assert(noexcept(ovoid::depth(std::declval<const ovoid::body_pair &>())), "queries never throw");
static_assert(!std::is_convertible<ovoid_shape *, shape>::value, "adopting is said aloud");
static_assert(std::is_same<decltype(std::declval<const ovoid::world &>().get()), const ovoid_world *>::value, "const");
static_assert(std::is_base_of<std::runtime_error, ovoid::error>::value, "");

namespace {

struct named_point { // in another order than x y z, so that its bytes are not those of a vec3
    float z, y, x;
};
struct turned_point { // as large as a vec3
    double z, y, x;
};
struct named_quaternion {
    double x, y, z, w;
};

void check_vectors() {
    const float single[3] = {1, 2, 3};
    const std::array<int, 3> whole = {1, 2, 3};
    CHECK(is_vec3(vec3(), 0, 0, 0) && is_vec3(vec3(1, 2, 3), 1, 2, 3) && is_vec3(vec3(ovoid_vec3{1, 2, 3}), 1, 2, 3));
    CHECK(is_vec3(vec3(std::array<double, 3>{1, 2, 3}), 1, 2, 3) && is_vec3(vec3(whole), 1, 2, 3));
    CHECK(is_vec3(vec3(single), 1, 2, 3) && is_vec3(vec3(named_point{3, 2, 1}), 1, 2, 3));
    CHECK((ovoid::to<std::array<double, 3>>(vec3(1, 2, 3)) == std::array<double, 3>{1, 2, 3}));
    const named_point back = ovoid::to<named_point>(vec3(1, 2, 3));
    CHECK(back.x == 1 && back.y == 2 && back.z == 3);

    const ovoid_quat q = {4, 1, 2, 3};
    const double wxyz[4] = {4, 1, 2, 3};
    const ovoid_quat identity = quat();
    CHECK(identity.w == 1 && identity.x == 0 && identity.y == 0 && identity.z == 0);
    CHECK(is_same<ovoid_quat>(quat(named_quaternion{1, 2, 3, 4}), q) && is_same<ovoid_quat>(quat(q), q));
    CHECK(is_same<ovoid_quat>(quat::wxyz(wxyz), q));
    CHECK(is_same<ovoid_quat>(quat::xyzw(std::vector<float>{1, 2, 3, 4}), q));
    const named_quaternion there = ovoid::to<named_quaternion>(q);
    CHECK(there.w == 4 && there.x == 1 && there.y == 2 && there.z == 3);
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "as many", [] { quat::wxyz(std::vector<double>{1, 2, 3}); }));
}

// A quarter turn about z and a way of (5, 6, 7): x goes to (5, 7, 7). By columns the same numbers are another order.
void check_poses() {
    const double rows[16] = {0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1};
    const std::array<float, 16> columns = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    ovoid_pose truth;
    CHECK_EQ(ovoid_pose_make_transform(rows, &truth, nullptr), OVOID_OK);
    const pose by_row = pose::from_row_major(rows), by_column = pose::from_column_major(columns);
    CHECK(is_same<ovoid_pose>(by_row, truth) && is_same<ovoid_pose>(by_column, truth));
    const vec3 moved = by_column * vec3(1, 0, 0);
    CHECK_NEAR(moved.x, 5, 1e-15);
    CHECK_NEAR(moved.y, 7, 1e-15);
    CHECK_NEAR(moved.z, 7, 1e-15);
    for (std::size_t i = 0; i < 16; i++) {
        CHECK_NEAR(by_row.row_major()[i], rows[i], 1e-15);
        CHECK_NEAR(by_row.column_major()[i], columns[i], 1e-15);
    }
    const double turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    const pose parts(vec3(5, 6, 7), quat::from_row_major(turn));
    CHECK(is_same<ovoid_pose>(parts, truth));
    CHECK(is_same<ovoid_quat>(quat::from_column_major(parts.rotation_matrix()), truth.rotation) == false);
    CHECK_NEAR(parts.rotation_matrix()[1], -1, 1e-15);

    const ovoid_pose identity = pose(), none = ovoid_pose_make_identity();
    CHECK(is_same(identity, none) && pose().validate() == OVOID_OK);
    CHECK(is_same<ovoid_pose>(pose::rpy({1, 2, 3}, {.1, .2, .3}), ovoid_pose_make_rpy({1, 2, 3}, {.1, .2, .3})));
    ovoid_pose turned;
    CHECK_EQ(ovoid_pose_make_axis_angle({1, 2, 3}, {0, 1, 1}, 2, &turned), OVOID_OK);
    const pose a = pose::axis_angle({1, 2, 3}, {0, 1, 1}, 2);
    CHECK(is_same<ovoid_pose>(a, turned));
    CHECK(is_same<ovoid_pose>(a * by_row, ovoid_pose_compute_product(&turned, &truth)));
    CHECK(is_same<ovoid_pose>(a.inverse(), ovoid_pose_compute_inverse(&turned)));
    CHECK(is_same<ovoid_vec3>(a * vec3(1, 2, 3), ovoid_pose_compute_point(&turned, {1, 2, 3})));
    CHECK(is_same<ovoid_vec3>(a.local({1, 2, 3}), ovoid_pose_compute_local_point(&turned, {1, 2, 3})));
    CHECK_EQ(pose(vec3(NAN, 0, 0)).validate(), OVOID_ERROR_NOT_FINITE);

    std::array<double, 16> bad{};
    CHECK(throws(OVOID_ERROR_ROTATION, -1, "last row", [&] { pose::from_row_major(bad); }));
    CHECK(throws(OVOID_ERROR_ROTATION, -1, "last row", [&] { pose::from_column_major(rows); }));
    bad[3] = INFINITY;
    CHECK(throws(OVOID_ERROR_NOT_FINITE, 3, "entry 3", [&] { pose::from_row_major(bad); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "as many", [] { pose::from_row_major(std::vector<double>(9)); }));
    CHECK(throws(OVOID_ERROR_ROTATION, -1, "rotation", [] { pose::axis_angle({}, {}, 1); }));
}

// Twelve corners whose coordinates are exact in float, in every kind of container: the bytes of the C shape.
void check_points() {
    uint64_t s = 3;
    std::vector<double> flat;
    for (int i = 0; i < 36; i++) flat.push_back(static_cast<float>(random_uniform(&s, -1, 1)));
    ovoid_error e;
    const shape truth = adopt(ovoid_shape_create_from_points(flat.data(), 12, nullptr, &e));

    double raw[36];
    std::array<double, 36> fixed;
    std::vector<std::array<double, 3>> triples;
    std::vector<std::array<float, 3>> small_triples;
    std::vector<ovoid_vec3> vectors;
    std::vector<vec3> own;
    std::list<vec3> linked;
    std::vector<named_point> named;
    std::vector<turned_point> turned;
    double rows[12][3];
    for (std::size_t i = 0; i < 36; i++) raw[i] = fixed[i] = rows[i / 3][i % 3] = flat[i];
    for (std::size_t i = 0; i < 12; i++) {
        const vec3 v(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
        triples.push_back({v.x, v.y, v.z});
        small_triples.push_back(ovoid::to<std::array<float, 3>>(v));
        vectors.push_back(v);
        own.push_back(v);
        linked.push_back(v);
        named.push_back(ovoid::to<named_point>(v));
        turned.push_back(ovoid::to<turned_point>(v));
    }
    CHECK(is_same_shape(shape::from_points(flat), truth.get()));
    CHECK(is_same_shape(shape::from_points(std::vector<float>(flat.begin(), flat.end())), truth.get()));
    CHECK(is_same_shape(shape::from_points(std::deque<double>(flat.begin(), flat.end())), truth.get()));
    CHECK(is_same_shape(shape::from_points(raw), truth.get()) && is_same_shape(shape::from_points(fixed), truth.get()));
    CHECK(is_same_shape(shape::from_points(rows), truth.get()));
    CHECK(is_same_shape(shape::from_points(ovoid::span<const double>(flat.data(), 36)), truth.get()));
    CHECK(is_same_shape(shape::from_points(triples), truth.get()));
    CHECK(is_same_shape(shape::from_points(small_triples), truth.get()));
    CHECK(is_same_shape(shape::from_points(vectors), truth.get()) &&
          is_same_shape(shape::from_points(own), truth.get()));
    CHECK(is_same_shape(shape::from_points(linked), truth.get()));
    CHECK(is_same_shape(shape::from_points(named), truth.get()) &&
          is_same_shape(shape::from_points(turned), truth.get()));
    // Without a copy where the numbers lie as x y z.
    CHECK(ovoid::points_of(flat).data() == flat.data() && ovoid::points_of(raw).data() == raw);
    CHECK(ovoid::points_of(triples).data() == triples[0].data() && ovoid::points_of(vectors).data() == &vectors[0].x);
    CHECK(ovoid::points_of(own).data() == &own[0].x && ovoid::points_of(rows).data() == rows[0]);
#if __cplusplus >= 202002L
    CHECK(is_same_shape(shape::from_points(std::span<const double>(flat)), truth.get()));
    CHECK(is_same_shape(shape::from_points(std::span(triples)), truth.get()));
    const std::span<const double> vertices = truth.vertices();
    CHECK(vertices.data() == truth.vertices().data() && vertices.size() == truth.vertices().size());
#endif
    const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const shape tetrahedron = adopt(ovoid_shape_create_from_points(corners, 4, nullptr, &e));
    CHECK(is_same_shape(shape::from_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), tetrahedron.get()));
}

void check_shapes() {
    ovoid_error e;
    ovoid_shape_options c = {};
    c.radius = 0.25;
    ovoid::shape_options o;
    CHECK(o.radius == 0 && o.allocator == nullptr);
    o.radius = 0.25;
    CHECK(is_same_shape(shape::box({1, 2, 3}, o), adopt(ovoid_shape_create_box({1, 2, 3}, &c, &e)).get()));
    CHECK(is_same_shape(shape::box({1, 2, 3}), adopt(ovoid_shape_create_box({1, 2, 3}, nullptr, &e)).get()));
    CHECK(is_same_shape(shape::sphere(2), adopt(ovoid_shape_create_sphere(2, nullptr, &e)).get()));
    CHECK(is_same_shape(shape::capsule(0.5, 2), adopt(ovoid_shape_create_capsule(0.5, 2, nullptr, &e)).get()));
    CHECK_EQ(shape::capsule(0.5, 2).radius(), 0.5);
    const ovoid_prism seven = {1, 2, 7}, five = {1, 2, 5};
    CHECK(is_same_shape(shape::prism(1, 2, 7), adopt(ovoid_shape_create_prism(&seven, nullptr, &e)).get()));
    CHECK(is_same_shape(shape::pyramid(1, 2, 5, o), adopt(ovoid_shape_create_pyramid(&five, &c, &e)).get()));

    const std::vector<vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::uint32_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, sizes[4] = {3, 3, 3, 3};
    const ovoid_faces faces = {&points[0].x, 4, indices, sizes, 4};
    const shape truth = adopt(ovoid_shape_create_from_faces(&faces, nullptr, &e));
    const std::vector<std::array<int, 3>> triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const std::vector<std::vector<std::size_t>> polygons = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    CHECK(is_same_shape(shape::from_faces(points, triangles), truth.get()));
    CHECK(is_same_shape(shape::from_faces(points, polygons), truth.get()));
    CHECK(is_same_shape(shape::from_faces(faces), truth.get()));

    const shape box = shape::box({1, 2, 3}, o);
    CHECK(box.radius() == 0.25 && box.vertices().size() == 24 && box.triangles().size() == 36);
    CHECK_EQ(box.polytope().vertex_count, 8);
    CHECK_EQ(box.report().vertices, 8);
    CHECK_NEAR(box.measures().volume, 48, 1e-12);
    CHECK_EQ(box.size_in_bytes(), ovoid_shape_get_size(box.get()));
    CHECK(!box.is_lean());
    CHECK(box.outer().volume > 48 && box.inner().volume < 48);
    CHECK(is_same_shape(box.copy(), box.get()) && box.copy().get() != box.get());
    CHECK(is_same_shape(shape::read(box.write()), box.get()));
    std::vector<double> moved(box.vertices().begin(), box.vertices().end());
    moved[0] *= 2;
    CHECK(is_same_shape(box.deformed(moved, o),
                        adopt(ovoid_shape_create_deformed(box.get(), moved.data(), &c, &e)).get()));
    const std::pair<shape, shape> parts = box.divided({{1, 0, 0}, 0.5});
    CHECK_NEAR(parts.first.measures().volume, 36, 1e-12);
    CHECK_NEAR(parts.second.measures().volume, 12, 1e-12);
    const std::pair<shape, shape> whole = box.divided({{1, 0, 0}, 5});
    CHECK(whole.first && !whole.second);
}

// Every kind of refusal, with its code, place and a word of its sentence.
void check_errors() {
    const std::vector<vec3> bad = {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}};
    CHECK(throws(OVOID_ERROR_ARGUMENT, 4, "divisible", [] { shape::from_points(std::vector<double>(4)); }));
    CHECK(throws(OVOID_ERROR_EMPTY, -1, "", [] { shape::from_points(std::vector<double>()); }));
    CHECK(throws(OVOID_ERROR_NOT_FINITE, 2, "", [&] { shape::from_points(bad); }));
    CHECK(throws(OVOID_ERROR_RADIUS, -1, "", [] { shape::sphere(-1); }));
    const std::vector<vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto faces = [&](int last) {
        return [&points, last] {
            shape::from_faces(points, std::vector<std::array<long, 3>>{{0, 2, 1}, {0, 1, last}});
        };
    };
    CHECK(throws(OVOID_ERROR_INDEX, 1, "", faces(9)));
    CHECK(throws(OVOID_ERROR_INDEX, 1, "negative", faces(-1)));
    CHECK(throws(OVOID_ERROR_NOT_CONVEX, 0, "open", faces(3)));
    std::vector<unsigned char> bytes = shape::sphere(1).write();
    bytes[bytes.size() / 2] ^= 1;
    // The checksum is the last eight bytes.
    const auto place = static_cast<std::int64_t>(bytes.size()) - 8;
    CHECK(throws(OVOID_ERROR_FORMAT, place, "checksum", [&] { shape::read(bytes); }));
    const shape box = shape::box({1, 1, 1});
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "each vertex", [&] { box.deformed(points); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "", [&] { box.divided({{0, 0, 0}, 0}); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "a gap below 0", [&] { ovoid::compute_outer(box.polytope(), -1); }));
    CHECK(std::string(ovoid::name(OVOID_ERROR_EMPTY)) == "empty" &&
          std::string(ovoid::version()) == ovoid_get_version());
}

// Owners: empty after a move, nothing is destroyed twice, nothing is held at the end; and for each allocation that
// fails MEMORY is thrown and nothing is held.
void check_owners() {
    countdown memory = {1000000, 0};
    const ovoid_allocator allocator = countdown_make_allocator(&memory);
    ovoid::shape_options o;
    o.allocator = &allocator;
    {
        shape a = shape::box({1, 1, 1}, o), b = shape::sphere(1, o);
        const ovoid_shape *handle = a.get();
        CHECK(a && b && memory.held == 2);
        shape c = std::move(a);
        CHECK(!a && a.get() == nullptr && c.get() == handle && memory.held == 2); // NOLINT: moved from is empty
        b = std::move(c);
        CHECK(!c && b.get() == handle && memory.held == 1); // NOLINT: moved from is empty
        shape &same = b;
        b = std::move(same);
        CHECK(b.get() == handle && memory.held == 1);
        ovoid_shape *given = b.release();
        CHECK(!b && memory.held == 1);
        shape d(given);
        d.reset();
        CHECK(!d && memory.held == 0);
        std::vector<shape> many;
        for (int i = 0; i < 20; i++) many.push_back(shape::sphere(1 + i, o));
        CHECK_EQ(memory.held, 20);
        many.erase(many.begin() + 3, many.begin() + 13);
        CHECK_EQ(memory.held, 10);
        auto shared = std::make_shared<const shape>(shape::sphere(1, o));
        CHECK(memory.held == 11 && shared->radius() == 1);
        const ovoid::shape_view view = *shared;
        CHECK(view.get() == shared->get());
    }
    CHECK_EQ(memory.held, 0);
    ovoid::world_options w;
    w.allocator = &allocator;
    const shape ball = shape::sphere(1);
    const auto make_all = [&] {
        const shape box = shape::box({1, 1, 1}, o), copy = box.copy(&allocator),
                    read = shape::read(box.write(), &allocator);
        const auto compound = ovoid::compound::create({{box, vec3(1, 2, 3)}, ball}, &allocator);
        const auto areas = ovoid::areas::create(box.polytope(), box.inner().ellipsoid, OVOID_SPLIT_CUBE, 2, &allocator);
        auto world = ovoid::world::create(w);
        for (double x = 0; x < 30; x++) world.add({compound, vec3(x, 0, 0)});
        world.compute_contacts({OVOID_QUERY_DISTANCE, 1});
    };
    memory.left = 1000000;
    make_all();
    const long needed = 1000000 - memory.left;
    CHECK(needed > 20 && memory.held == 0);
    for (long k = 0; k < needed; k++) {
        memory.left = k;
        bool is_memory = false;
        try {
            make_all();
        } catch (const ovoid::error &e) {
            is_memory = e.code() == OVOID_ERROR_MEMORY;
        }
        CHECK(is_memory);
        CHECK_EQ(memory.held, 0);
    }
}

} // namespace

int main() {
    check_vectors();
    check_poses();
    check_points();
    check_shapes();
    check_errors();
    check_owners();
    return check_end();
}
