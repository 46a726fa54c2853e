// Solids through the C++ header against the C functions, bit for bit, and their proofs against the checker. Truth: what
// C answers to the same bodies, options and earlier proofs; and of an L and a cube, distances known by their corners.
#include "same.hpp"

using ovoid::body_pair;
using ovoid::pose;
using ovoid::shape;
using ovoid::solid;

namespace {

// The prism over an L of length 2 and width 1, from z = 0 to 1.
const double corners[36] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0,
                            0, 0, 1, 2, 0, 1, 2, 1, 1, 1, 1, 1, 1, 2, 1, 0, 2, 1};
const std::uint32_t triangles[60] = {0,  2, 1,  0,  3,  2, 0,  4, 3, 0, 5,  4, 6,  7,  8, 6, 8, 9, 6, 9,
                                     10, 6, 10, 11, 0,  1, 7,  0, 7, 6, 1,  2, 8,  1,  8, 7, 2, 3, 9, 2,
                                     9,  8, 3,  4,  10, 3, 10, 9, 4, 5, 11, 4, 11, 10, 5, 0, 6, 5, 6, 11};

solid make_angle() { return solid::from_triangles(corners, 12, triangles, 20); }

bool is_same_solid_answer(const ovoid_body_answer &a, const ovoid_body_answer &b) {
    return a.status == b.status && a.limit == b.limit && is_same(a.lower, b.lower) && is_same(a.upper, b.upper) &&
           is_same(a.parting, b.parting) && a.inside == b.inside && a.component == b.component &&
           a.part_a == b.part_a && a.part_b == b.part_b && is_same_answer(a.deciding, b.deciding);
}

void check_views() {
    const solid s = make_angle();
    const ovoid_solid_report r = s.report();
    CHECK_EQ(r.is_closed, 1);
    CHECK_EQ(r.volume, 3.0);
    CHECK_EQ(r.triangles, s.order().size());
    CHECK_EQ(s.points().size(), 36u);
    CHECK(is_same_count(s.points().data(), ovoid_solid_get_points(s.get()), 36));
    std::uint32_t of[3];
    s.triangle(7, of);
    CHECK(of[0] == 6 || of[0] == 10 || of[0] == 11);
    std::int64_t winding = 7;
    CHECK(s.winding({0.5, 0.5, 0.5}, &winding));
    CHECK_EQ(winding, 1);
    CHECK(s.winding({1.5, 1.5, 0.5}, &winding));
    CHECK_EQ(winding, 0);
    CHECK(!s.winding({0, 0.5, 0.5}, &winding));
    CHECK_EQ(s.crossings().pairs, 0u);
    CHECK_EQ(s.crossings().is_complete, 1);
    CHECK_EQ(s.size_in_bytes(), ovoid_solid_get_size(s.get()));
    const ovoid::solid_view none;
    CHECK(!none && s);
    CHECK(throws(OVOID_ERROR_INDEX, 1, "12", [] {
        const std::uint32_t wrong[6] = {0, 1, 2, 0, 1, 12};
        (void)solid::from_triangles(corners, 12, wrong, 2);
    }));
    CHECK(throws(OVOID_ERROR_EMPTY, -1, "", [] { (void)solid::from_triangles(corners, 12, triangles, 0); }));
}

// Each query beside C's, cold and warm, with its proof.
void check_queries() {
    const solid angle = make_angle();
    const shape cube = shape::box({0.25, 0.25, 0.25});
    ovoid_exclusion items[512], other[512];
    for (const pose &at : {pose::rpy({1.5, 1.5, 0.5}, {0, 0, 0}), pose::rpy({1.1, 0.9, 0.5}, {0.2, 0.1, 0.7}),
                           pose::rpy({0.5, 0.5, 0.5}, {0, 0, 0})}) {
        const body_pair p({angle}, {cube, at}), two({angle}, {angle, at});
        for (const body_pair *q : {&p, &two}) {
            ovoid_exclusions all = {items, 512, 0, nullptr, 0, nullptr}, c = {other, 512, 0, nullptr, 0, nullptr};
            const ovoid_body_evidence into = {nullptr, &c};
            const ovoid::body_answer x = ovoid::distance(*q, {}, nullptr, &all);
            CHECK(is_same_solid_answer(x, ovoid_body_distance(q, nullptr, &into)));
            CHECK_EQ(all.count, c.count);
            CHECK(ovoid::is_proven(*q, x, ovoid::options(), &all));
            ovoid::body_answer wrong = x;
            wrong.deciding.lower += 0.1;
            CHECK(!ovoid::is_proven(*q, wrong, ovoid::options(), &all));
            const ovoid::body_proof earlier = ovoid::proof_of(x);
            const ovoid_body_evidence known = {&earlier, nullptr};
            CHECK(is_same_solid_answer(ovoid::distance(*q, {}, &earlier), ovoid_body_distance(q, nullptr, &known)));
            CHECK(is_same_solid_answer(ovoid::collide(*q), ovoid_body_collide(q, nullptr, nullptr)));
            const ovoid::body_answer w = ovoid::within(*q, 0.5);
            CHECK(is_same_solid_answer(w, ovoid_body_within(q, 0.5, nullptr, nullptr)));
            CHECK_EQ(ovoid::is_within(w, 0.5), ovoid_body_answer_is_within(&w, 0.5));
        }
    }
    // In the notch a quarter from both of its walls; in the L.
    const ovoid::body_answer apart = ovoid::distance(body_pair({angle}, {cube, pose::rpy({1.5, 1.5, 0.5}, {0, 0, 0})}));
    CHECK_EQ(apart.status, OVOID_SEPARATED);
    CHECK_NEAR(apart.lower, 0.25, 1e-9);
    const ovoid::body_answer in = ovoid::distance(body_pair({angle}, {cube, pose::rpy({0.5, 0.5, 0.5}, {0, 0, 0})}));
    CHECK_EQ(in.inside, OVOID_BODY_B_INSIDE);
    CHECK_NEAR(in.upper, -0.25, 1e-9);
}

// As any body: beside a compound, in a world, on its way.
void check_bodies() {
    const solid angle = make_angle();
    const shape cube = shape::box({0.25, 0.25, 0.25});
    const ovoid::compound two = ovoid::compound::create(
        {{cube, pose::rpy({1.5, 1.5, 0.5}, {0, 0, 0})}, {cube, pose::rpy({4, 4, 0.5}, {0, 0, 0})}});
    ovoid_exclusion items[512];
    ovoid_exclusions all = {items, 512, 0, nullptr, 0, nullptr};
    const body_pair beside(angle, two);
    const ovoid::body_answer x = ovoid::distance(beside, {}, nullptr, &all);
    CHECK_EQ(x.part_b, 0u);
    CHECK_NEAR(x.lower, 0.25, 1e-9);
    CHECK(ovoid::is_proven(beside, x, ovoid::options(), &all));
    ovoid::world w = ovoid::world::create();
    const ovoid::id a = w.add(ovoid::body(angle)), b = w.add(ovoid::body(cube, pose::rpy({1.5, 1.5, 0.5}, {0, 0, 0})));
    const ovoid::contacts found = w.compute_contacts({OVOID_QUERY_DISTANCE, 1});
    CHECK_EQ(found.size(), 1u);
    CHECK(found.items[0].a == a && found.items[0].b == b);
    CHECK_NEAR(found.items[0].verdict.lower, 0.25, 1e-9);
    // The cube comes down the notch from above, past both walls, and out of it through the one at x = 1.
    const ovoid::moving_body still(angle, ovoid::motion(pose()));
    const ovoid::moving_body falls(
        cube, ovoid_motion_make_poses(pose::rpy({1.5, 1.5, 3}, {0, 0, 0}), pose::rpy({1.5, 1.5, 0.5}, {0, 0, 0}), 1));
    CHECK_EQ(ovoid::find_impact(still, falls).impact.status, OVOID_IMPACT_FREE);
    const ovoid::moving_body moved(
        cube, ovoid_motion_make_poses(pose::rpy({1.5, 1.5, 0.5}, {0, 0, 0}), pose::rpy({0.5, 1.5, 0.5}, {0, 0, 0}), 1));
    static ovoid_step steps[4096];
    static ovoid_step_group groups[1024];
    const ovoid::motion_options full = ovoid::motion_options().with_steps(steps).with_groups(groups);
    const ovoid::body_impact met = ovoid::find_impact(still, moved, 0, full);
    CHECK_EQ(met.impact.status, OVOID_IMPACT_HIT);
    CHECK_NEAR(met.impact.hit_at, 0.25, 1e-8);
    ovoid::verify(still, moved, 0, met, steps, groups);
    CHECK(still.swept(0, 1).max.x >= 2);
}

} // namespace

int main() {
    check_views();
    check_queries();
    check_bodies();
    return check_end();
}
