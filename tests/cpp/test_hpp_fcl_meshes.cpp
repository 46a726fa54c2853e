// The contacts of meshes by <ovoid/fcl.hpp> beside each type of shape, and beside each other: each is held against the
// bracket of ovoid's shapes of the triangle and of the other body, the true one where that is round, and the list of
// triangles against all of them, one by one.
#include "fcl_zoo.hpp"

#include <ovoid/fcl.hpp>
#include <ovoid/ovoid.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <utility>
#include <vector>

using namespace fcl;
using shape_owner = std::shared_ptr<ovoid_shape>;

/// A geometry and its parts as shapes: the triangles of a mesh, or itself.
struct body {
    geometry_of<double> of;
    std::vector<shape_owner> parts;
    bool is_mesh;

    const ovoid_shape *get(int part) const { return parts[std::size_t(is_mesh ? part : 0)].get(); }
    int name(std::size_t part) const { return is_mesh ? int(part) : -1; }
};
static shape_owner own(ovoid_shape *shape) { return shape_owner(shape, ovoid_shape_destroy); }

static body make_mesh(double radius, unsigned parts) {
    const auto mesh = make_ball<OBBRSSd>(radius, parts);
    body made = {mesh, {}, true};
    for (int i = 0; i < mesh->num_tris; i++) {
        double xyz[9];
        for (int k = 0; k < 9; k++) xyz[k] = mesh->vertices[mesh->tri_indices[i][std::size_t(k / 3)]][k % 3];
        made.parts.push_back(own(ovoid_shape_create_from_points(xyz, 3, nullptr, nullptr)));
    }
    return made;
}

/// Two parts at their poses.
struct couple {
    const ovoid_shape *a, *b;
    Transform3d s, t;

    ovoid_answer ask() const {
        const auto pose = [](const Transform3d &at) {
            const Eigen::Quaterniond q(at.linear());
            return ovoid_pose{{at.translation()[0], at.translation()[1], at.translation()[2]},
                              {q.w(), q.x(), q.y(), q.z()}};
        };
        const ovoid_pair pair = {a, b, pose(s), pose(t)};
        ovoid_options tight{};
        tight.relative_tolerance = 1e-11;
        return ovoid_depth(&pair, &tight, nullptr, nullptr);
    }
};

/// The depth is that of the two parts, and the normal parts them. Both bodies are of about size 1.
static void check_contact(const couple &of, const Contactd &c) {
    const ovoid_answer truth = of.ask();
    const double slack = 1e-8;
    CHECK_LE(truth.lower, slack);
    CHECK_LE(c.penetration_depth, -truth.lower + slack);
    CHECK_LE(-truth.upper - slack, c.penetration_depth);
    CHECK_NEAR(c.normal.norm(), 1, 1e-12);
    couple moved = of;
    moved.t.translation() += c.normal * c.penetration_depth;
    CHECK_LE(-slack, moved.ask().upper);
    // The place is half way between the deepest points, which both bodies reach by a translation of half the depth.
    const auto is_in = [&c](const ovoid_shape *part, const Transform3d &at, double way) {
        const shape_owner point = own(ovoid_shape_create_sphere(1e-9, nullptr, nullptr));
        return couple{part, point.get(), at, Transform3d(Eigen::Translation3d(c.pos + way * c.normal))}.ask().lower;
    };
    CHECK_LE(is_in(of.a, of.s, c.penetration_depth / 2), slack);
    CHECK_LE(is_in(of.b, of.t, -c.penetration_depth / 2), slack);
}

/// All contacts of two bodies: their number.
static std::size_t check(const body &a, const Transform3d &s, const body &b, const Transform3d &t) {
    CollisionResultd all, few;
    ovoid::fcl::collide<double>(a.of.get(), s, b.of.get(), t, CollisionRequestd(100000, true), all);
    std::set<std::pair<int, int>> found;
    for (std::size_t i = 0; i < all.numContacts(); i++) {
        const Contactd &c = all.getContact(i);
        CHECK(c.o1 == a.of.get() && c.o2 == b.of.get());
        CHECK((c.b1 >= 0) == a.is_mesh && (c.b2 >= 0) == b.is_mesh);
        CHECK(found.insert({c.b1, c.b2}).second);
        check_contact({a.get(c.b1), b.get(c.b2), s, t}, c);
    }
    for (std::size_t i = 0; i < a.parts.size(); i++)
        for (std::size_t j = 0; j < b.parts.size(); j++) {
            const ovoid_answer truth = couple{a.parts[i].get(), b.parts[j].get(), s, t}.ask();
            const bool is_listed = found.count({a.name(i), b.name(j)}) > 0;
            if (truth.upper < 0) CHECK(is_listed);
            if (truth.lower > 0) CHECK(!is_listed);
        }
    // One is that of the parts that decide, which come first in a list.
    CollisionResultd plain, one;
    ovoid::fcl::collide<double>(a.of.get(), s, b.of.get(), t, CollisionRequestd(1, true), one);
    CHECK_EQ(one.numContacts(), std::min<std::size_t>(1, all.numContacts()));
    if (one.numContacts() == 1 && all.numContacts() > 0) {
        CHECK_EQ(one.getContact(0).b1, all.getContact(0).b1);
        CHECK_EQ(one.getContact(0).b2, all.getContact(0).b2);
    }
    // Without details the same triangles.
    CHECK_EQ(ovoid::fcl::collide<double>(a.of.get(), s, b.of.get(), t, CollisionRequestd(100000, false), plain),
             all.numContacts());
    CHECK_EQ(ovoid::fcl::collide<double>(a.of.get(), s, b.of.get(), t, CollisionRequestd(2, true), few),
             std::min<std::size_t>(2, all.numContacts()));
    return all.numContacts();
}

int main() {
    std::vector<body> others;
    for (const auto &x : make_shapes<double>()) {
        const auto *g = x.geometry.get();
        const ovoid_vec3 radii = {0.5, 0.4, 0.3};
        shape_owner shape;
        switch (g->getNodeType()) {
        case GEOM_BOX: shape = own(ovoid_shape_create_box({0.5, 0.4, 0.3}, nullptr, nullptr)); break;
        case GEOM_SPHERE: shape = own(ovoid_shape_create_sphere(0.5, nullptr, nullptr)); break;
        case GEOM_ELLIPSOID: shape = own(ovoid_shape_create_ellipsoid(radii, nullptr, nullptr)); break;
        case GEOM_CAPSULE: shape = own(ovoid_shape_create_capsule(0.25, 0.4, nullptr, nullptr)); break;
        case GEOM_CONE: shape = own(ovoid_shape_create_cone(0.4, 0.45, nullptr, nullptr)); break;
        case GEOM_CYLINDER: shape = own(ovoid_shape_create_cylinder(0.4, 0.4, nullptr, nullptr)); break;
        case GEOM_CONVEX: shape = own(ovoid_shape_create_box({0.45, 0.45, 0.45}, nullptr, nullptr)); break;
        default: continue;
        }
        others.push_back({x.geometry, {shape}, false});
    }
    others.push_back(make_mesh(0.4, 5));
    const body mesh = make_mesh(0.5, 7);
    random_poses poses(11);
    for (const body &other : others) {
        std::size_t count = 0;
        for (int n = 0; n < 12; n++) {
            const Transform3d s = poses.make<double>(0.3), t = poses.make<double>(0.3);
            count += n % 2 ? check(mesh, s, other, t) : check(other, t, mesh, s);
        }
        CHECK_LE(40u, count);
    }
    return check_end();
}
