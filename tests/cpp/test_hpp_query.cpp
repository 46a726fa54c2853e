// Queries, compounds, motions and worlds through the C++ header against the C functions, bit for bit, and their proofs
// against the checkers. Truth: what C answers to the same bodies, options and earlier proofs.
#include "same.hpp"

#include "ovoid/paper.h"

using ovoid::pose;
using ovoid::shape;
using ovoid::vec3;

namespace {

struct bodies {
    shape box = shape::box({1, 2, 3}), pill = shape::capsule(0.5, 1), hull;
    pose near = pose::rpy({1.2, 0.3, 0.1}, {0.1, 0.7, 0}), far = pose::rpy({4, 0, 0}, {0, 0.7, 0});
    bodies() {
        uint64_t s = 5;
        std::vector<double> points;
        for (int i = 0; i < 120; i++) points.push_back(random_normal(&s));
        hull = shape::from_points(points);
    }
};

// Each query, cold and warm, with the default and other options, apart and overlapping.
void check_pairs() {
    const bodies b;
    ovoid::options o;
    o.relative_tolerance = 1e-3;
    for (const pose &at : {b.near, b.far}) {
        const ovoid::pair p(b.box, b.hull, {}, at);
        const ovoid_pair c = {b.box.get(), b.hull.get(), ovoid_pose_make_identity(), at};
        const ovoid_answer cold = ovoid_depth(&c, nullptr, nullptr, nullptr);
        CHECK(is_same_answer(ovoid::collide(p), ovoid_collide(&c, nullptr, nullptr)));
        CHECK(is_same_answer(ovoid::collide(p, o, &cold.proof), ovoid_collide(&c, &o, &cold.proof)));
        CHECK(is_same_answer(ovoid::within(p, 0.5), ovoid_within(&c, 0.5, nullptr, nullptr)));
        CHECK(is_same_answer(ovoid::within(p, 0.5, o, &cold.proof), ovoid_within(&c, 0.5, &o, &cold.proof)));
        CHECK(is_same_answer(ovoid::distance(p), ovoid_distance(&c, nullptr, nullptr)));
        CHECK(is_same_answer(ovoid::distance(p, o, &cold.proof), ovoid_distance(&c, &o, &cold.proof)));
        CHECK(is_same_answer(ovoid::bounds(p), ovoid_pair_compute_bounds(&c)));
        ovoid::cover cover;
        const ovoid::answer a = ovoid::depth(p, {}, nullptr, &cover);
        CHECK(is_same_answer(a, cold));
        CHECK_EQ(ovoid::distance_of(a), a.lower);
        CHECK_EQ(ovoid::is_within(a, 0.5), ovoid_answer_is_within(&a, 0.5));
        CHECK(ovoid::is_proven(p, a, ovoid::options(), &cover));
        ovoid::verify(p, a, ovoid::options(), &cover);
        ovoid::cover kept;
        CHECK(is_same_answer(ovoid::depth_from(p, kept), cold));
        const ovoid::answer again = ovoid::depth_from(p, kept, {}, &cold.proof);
        CHECK(ovoid::is_proven(p, again, ovoid::options(), &kept));
        CHECK_EQ(again.status, cold.status);
        ovoid::cover large(OVOID_COVER_POINTS + 1);
        CHECK(is_same_answer(ovoid::depth(p, {}, nullptr, &large), cold));
        CHECK_EQ(large.point_count, cover.point_count);
        ovoid::cover moved(std::move(large));
        CHECK(large.memory == nullptr && large.point_count == 0);
        CHECK(ovoid::is_proven(p, a, ovoid::options(), &moved));
        large = std::move(moved);
        CHECK(moved.memory == nullptr && ovoid::is_proven(p, a, ovoid::options(), &large));
        ovoid::answer wrong = a;
        wrong.lower += 0.1;
        CHECK(!ovoid::is_proven(p, wrong, ovoid::options(), &cover));
        CHECK(!ovoid::is_proven(p, wrong, ovoid::options(), &large));
        CHECK(throws(OVOID_ERROR_PROOF, -1, "", [&] { ovoid::verify(p, wrong, ovoid::options(), &cover); }));
        const ovoid::prepared_shape ready_a(ovoid::posed_shape(b.box)), ready_b(ovoid::posed_shape(b.hull, at));
        ovoid::answer whole;
        ovoid::evidence into;
        into.answer = &whole;
        const ovoid::verdict v = ovoid::depth(ready_a, ready_b, {}, &into);
        CHECK(is_same_answer(whole, ovoid::depth(p)));
        CHECK_EQ(ovoid::is_within(v, 0.5), ovoid::is_within(a, 0.5));
        CHECK_EQ(ovoid::collide(ready_a, ready_b).lower, ovoid::collide(p).lower);
        CHECK_EQ(ovoid::within(ready_a, ready_b, 0.5).upper, ovoid::within(p, 0.5).upper);
        CHECK_EQ(ovoid::distance(ready_a, ready_b).lower, ovoid::distance(p).lower);
        const std::array<double, 9> quarter = {0, -1, 0, 1, 0, 0, 0, 0, 1}, mirror = {0, 1, 0, 1, 0, 0, 0, 0, 1};
        const auto turned = ovoid::prepared_shape::from_row_major(b.box.get(), quarter, vec3(0, 0, 5));
        CHECK(turned.body.pose.position.z == 5 && turned.rotation[1] == -1);
        CHECK(throws(OVOID_ERROR_ROTATION, -1, "",
                     [&] { ovoid::prepared_shape::from_row_major(b.box.get(), mirror, vec3()); }));
        const ovoid_gradient g = ovoid_answer_compute_gradient(&c, &a, &cover);
        const ovoid_smooth s = ovoid_pair_compute_smooth(&c, 1), t = ovoid::compute_smooth(p, 1);
        CHECK(is_same_count(ovoid::compute_gradient(p, a, &cover).gradient, g.gradient, 12));
        CHECK(t.outer.value == s.outer.value && is_same_count(t.outer.gradient, s.outer.gradient, 12));
    }
    // What is refused stands in the answer, as in C: so the options arrive, whatever they change.
    ovoid::options bad;
    bad.relative_tolerance = -1;
    const ovoid::pair one(b.box, b.pill, {}, b.far);
    const ovoid::body_pair two(b.box, {b.pill, b.far});
    for (const ovoid_limit l : {ovoid::collide(one, bad).limit, ovoid::within(one, 1, bad).limit,
                                ovoid::distance(one, bad).limit, ovoid::depth(one, bad).limit})
        CHECK_EQ(l, OVOID_LIMIT_OPTIONS);
    for (const ovoid::body_answer &a :
         {ovoid::collide(two, bad), ovoid::within(two, 1, bad), ovoid::distance(two, bad), ovoid::depth(two, bad)})
        CHECK_EQ(a.limit, OVOID_LIMIT_OPTIONS);
    const ovoid::answer refused = ovoid::distance({b.box, b.pill, {}, vec3(NAN, 0, 0)});
    CHECK(refused.limit == OVOID_LIMIT_POSE_B && std::strcmp(ovoid::name(refused.status), "undecided") == 0);
    CHECK(std::strcmp(ovoid::name(refused.limit), ovoid_limit_get_name(OVOID_LIMIT_POSE_B)) == 0);
    CHECK(std::strcmp(ovoid::name(OVOID_STAGE_GJK), "gjk") == 0);
    CHECK(std::strcmp(ovoid::name(OVOID_PROOF_POINTS), ovoid_proof_kind_get_name(OVOID_PROOF_POINTS)) == 0);
}

void check_batches() {
    const bodies b;
    const std::vector<ovoid::posed_shape> shapes = {{b.box}, {b.pill, b.near}, {b.hull, b.far}};
    const std::vector<ovoid::couple> couples = {{0, 1}, {1, 2}, {0, 2}};
    std::vector<ovoid::answer> answers(3);
    std::vector<ovoid::verdict> verdicts(3);
    std::vector<ovoid::proof> proofs(3);
    std::vector<ovoid::witness> witnesses(3);
    ovoid::options o;
    o.relative_tolerance = 1e-4;
    ovoid::batch batch(shapes, couples);
    batch.with_options(o).with_answers(answers).with_verdicts(verdicts).with_proofs(proofs).with_witnesses(witnesses);
    void (*const asked[3])(const ovoid_batch &) = {ovoid::collide_batch, ovoid::distance_batch, ovoid::depth_batch};
    ovoid_code (*const in_c[3])(const ovoid_batch *, ovoid_error *) = {ovoid_collide_batch, ovoid_distance_batch,
                                                                       ovoid_depth_batch};
    for (int k = 0; k < 4; k++) {
        proofs.assign(3, {});
        if (k < 3)
            asked[k](batch);
        else
            ovoid::within_batch(batch, 0.5);
        std::vector<ovoid_answer> wanted(3);
        ovoid_batch plain = {};
        plain.bodies = shapes.data();
        plain.body_count = shapes.size();
        plain.couples = couples.data();
        plain.couple_count = couples.size();
        plain.options = &o;
        plain.answers = wanted.data();
        CHECK((k < 3 ? in_c[k](&plain, nullptr) : ovoid_within_batch(&plain, 0.5, nullptr)) == OVOID_OK);
        for (std::size_t i = 0; i < 3; i++) {
            const ovoid_posed_shape &x = shapes[couples[i].a], &y = shapes[couples[i].b];
            const ovoid_pair p = {x.shape, y.shape, x.pose, y.pose};
            const ovoid::answer alone[4] = {ovoid::collide(p, o), ovoid::distance(p, o), ovoid::depth(p, o),
                                            ovoid::within(p, 0.5, o)};
            const ovoid_answer &w = wanted[i];
            CHECK(answers[i].status == alone[k].status);
            CHECK(is_same_answer(answers[i], w));
            CHECK(witnesses[i].point_b.x == w.point_b.x && witnesses[i].normal.z == w.normal.z);
            CHECK(verdicts[i].lower == w.lower && proofs[i].kind == w.proof.kind);
        }
    }
    o.relative_tolerance = -1;
    ovoid::distance_batch(batch);
    CHECK_EQ(verdicts[0].limit, OVOID_LIMIT_OPTIONS);
    const std::vector<ovoid::couple> beyond = {{0, 1}, {0, 3}};
    CHECK(throws(OVOID_ERROR_INDEX, 1, "", [&] { ovoid::distance_batch(ovoid::batch(shapes, beyond)); }));
    verdicts.resize(2);
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "couples", [&] { batch.with_verdicts(verdicts); }));
}

// The manifolds of bodies that come nearer step by step, those of the step before as the earlier ones.
void check_body_manifolds(ovoid::body_pair p) {
    ovoid::body_manifolds all;
    CHECK(all.empty() && all.begin() == all.end());
    std::vector<ovoid_body_manifold> last;
    std::size_t parts = 0;
    ovoid_manifold_options o = {};
    o.margin = 1;
    for (int step = 0; step < 20; step++) {
        std::vector<ovoid_body_manifold> room(8);
        ovoid_body_manifolds truth = {};
        truth.items = room.data();
        truth.capacity = room.size();
        truth.earlier = last.data();
        truth.earlier_count = last.size();
        CHECK_EQ(ovoid_body_manifolds_find(&p, &o, &truth), OVOID_LIMIT_NONE);
        CHECK_EQ(all.find(p, o), OVOID_LIMIT_NONE);
        CHECK(all.size() == truth.count && all.lower() == truth.lower && all.upper() == truth.upper);
        std::size_t i = 0;
        for (const ovoid::body_manifold &m : all) {
            CHECK(&m == &all[i] && is_same(m, room[i++]));
            const ovoid_manifold_points points = ovoid::compute_points(p, m), &own = all.points_of(m);
            CHECK(points.count == m.manifold.count && own.count == points.count);
            for (std::uint32_t k = 0; k < own.count; k++)
                CHECK(is_same(points.points[k].point_a, own.points[k].point_a) &&
                      is_same(points.points[k].point_b, own.points[k].point_b) &&
                      points.points[k].id == own.points[k].id);
            CHECK_EQ(ovoid::is_proven(p, m, o), ovoid_body_manifold_verify(&p, &m, &o, nullptr) == OVOID_OK);
        }
        CHECK_EQ(i, truth.count);
        parts += i;
        last.assign(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(truth.count));
        p.b.pose.position.x -= 0.2;
    }
    CHECK(parts > 5);
    ovoid_body_manifold none = {};
    none.part_a = 7;
    CHECK(!ovoid::is_proven(p, none) && ovoid::compute_points(p, none).count == 0);
    CHECK(throws(OVOID_ERROR_PROOF, 0, "part 7", [&] { ovoid::verify(p, none); }));
    p.a.pose.position.x = NAN;
    CHECK(all.find(p, o) == OVOID_LIMIT_POSE_A && all.empty());
}

void check_compounds() {
    const bodies b;
    const ovoid_posed_shape parts[2] = {{b.box.get(), pose()}, {b.pill.get(), b.far}};
    const auto arm = ovoid::compound::create({{b.box}, {b.pill, b.far}});
    const auto same = ovoid::compound::create(parts);
    CHECK(arm.size() == 2 && arm.part(1).shape == b.pill.get() && is_same<ovoid_pose>(arm.part(1).pose, b.far));
    CHECK(is_same(arm.outer(), same.outer()) && is_same(arm.inner(), same.inner()));
    CHECK(arm.order().size() == 2 && arm.size_in_bytes() == ovoid_compound_get_size(arm.get()));
    const ovoid::body_pair p({arm, vec3(0, 0, 1)}, {b.hull, vec3(7, 1, 0)});
    const ovoid_body_pair c = {{nullptr, arm.get(), pose(vec3(0, 0, 1)), nullptr},
                               {b.hull.get(), nullptr, pose(vec3(7, 1, 0)), nullptr}};
    const ovoid_body_answer truth = ovoid_body_distance(&c, nullptr, nullptr);
    std::vector<ovoid_exclusion> space(10);
    ovoid::exclusions e(space);
    const ovoid::body_answer found = ovoid::distance(p, {}, nullptr, &e);
    CHECK(is_same_answer(found.deciding, truth.deciding) && found.part_a == truth.part_a &&
          found.part_b == truth.part_b);
    CHECK(e.is_complete() && e.written().size() == e.count && ovoid::is_proven(p, found, ovoid::options(), &e));
    ovoid::verify(p, found, ovoid::options(), &e);
    const ovoid::body_proof warm = ovoid::proof_of(found);
    const ovoid_body_evidence known = {&warm, nullptr};
    CHECK(is_same_answer(ovoid::collide(p).deciding, ovoid_body_collide(&c, nullptr, nullptr).deciding));
    CHECK(is_same_answer(ovoid::collide(p, {}, &warm).deciding, ovoid_body_collide(&c, nullptr, &known).deciding));
    CHECK(is_same_answer(ovoid::within(p, 3).deciding, ovoid_body_within(&c, 3, nullptr, nullptr).deciding));
    CHECK(is_same_answer(ovoid::depth(p).deciding, ovoid_body_depth(&c, nullptr, nullptr).deciding));
    ovoid::body_answer wrong = found;
    wrong.lower += 1;
    CHECK(!ovoid::is_proven(p, wrong, ovoid::options(), &e));
    CHECK(throws(OVOID_ERROR_PROOF, -1, "", [&] { ovoid::verify(p, wrong, ovoid::options(), &e); }));
    check_body_manifolds(p);
    CHECK(throws(OVOID_ERROR_EMPTY, -1, "", [] { ovoid::compound::create(std::vector<ovoid::posed_shape>()); }));
    CHECK(throws(OVOID_ERROR_ROTATION, 1, "", [&] {
        ovoid::compound::create({{b.box}, {b.box, {vec3(), ovoid::quat(0, 0, 0, 0)}}});
    }));

    // A shared compound keeps its shapes.
    std::weak_ptr<const shape> watched;
    std::shared_ptr<const ovoid::compound> shared;
    {
        const auto kept = std::make_shared<const shape>(shape::box({1, 2, 3}));
        watched = kept;
        shared = ovoid::compound::share({{kept, {}}, {kept, vec3(9, 0, 0)}});
    }
    CHECK(!watched.expired() && shared->size() == 2 && shared->part(1).shape == watched.lock()->get());
    shared.reset();
    CHECK(watched.expired());
    CHECK(throws(OVOID_ERROR_ARGUMENT, 0, "", [] { ovoid::compound::share({{nullptr, {}}}); }));
}

void check_motions() {
    const bodies b;
    const pose start(vec3(6, 0, 0.2));
    const ovoid_motion still = ovoid_motion_make_still(pose());
    const ovoid_motion spin = ovoid_motion_make_velocity(start, {-8, 0, 0}, {0, 30, 0}, 1);
    const ovoid_moving_shape ca = {b.box.get(), still, {}}, cb = {b.pill.get(), spin, {}};
    const ovoid::moving_shape x(b.box, pose()), y(b.pill, ovoid::motion::velocity(start, {-8, 0, 0}, {0, 30, 0}, 1));
    std::vector<ovoid::step> steps(1000);
    ovoid::motion_options o;
    o.with_steps(steps);
    const ovoid_moving_pair both = {ca, cb, 0};
    const ovoid::impact hit = ovoid::find_impact(x, y, 0, o), truth = ovoid_impact_find(&both, nullptr);
    CHECK(hit.status == OVOID_IMPACT_HIT && hit.hit_at == truth.hit_at && hit.free_until == truth.free_until);
    CHECK(std::strcmp(ovoid::name(hit.status), "hit") == 0);
    ovoid::verify(x, y, 0, hit, steps);
    ovoid::impact wrong = hit;
    wrong.free_until += 0.01;
    CHECK(throws(OVOID_ERROR_PROOF, -1, "does not follow", [&] { ovoid::verify(x, y, 0, wrong, steps); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "steps",
                 [&] { ovoid::verify(x, y, 0, hit, ovoid::span<const ovoid_step>()); }));
    CHECK(is_same<ovoid_pose>(y.at(0.3), ovoid_moving_shape_compute_pose(&cb, 0.3)));
    CHECK(is_same(y.swept(0, 1), ovoid_moving_shape_compute_box(&cb, 0, 1)));
    const ovoid::moving_shape fixed(b.pill, ovoid::motion(start), vec3(1, 0, 0));
    CHECK(is_vec3(fixed.at(0).position, 7, 0, 0.2));

    ovoid::motion_options wide;
    wide.with_steps(steps);
    const ovoid::moving_shape past(b.pill, ovoid::motion::between(vec3(6, 0, 4.5), vec3(-6, 0, 4.5), 1));
    const ovoid::approach nearest = ovoid::find_approach(x, past, wide);
    const ovoid_moving_pair passing = {ca, past, 0};
    const ovoid_approach also = ovoid_approach_find(&passing, nullptr);
    CHECK(nearest.lower == also.lower && nearest.upper == also.upper && nearest.time == also.time);
    ovoid::verify(x, past, nearest, steps);

    const std::vector<double> times = {0, 1, 2};
    const std::vector<pose> poses = {vec3(6, 0, 0), vec3(3, 0, 0), vec3(6, 0, 0)};
    const ovoid::motion path = ovoid::motion::path(times, poses);
    path.validate();
    CHECK(is_vec3(path.at(1.5).position, 4.5, 0, 0));
    CHECK(
        throws(OVOID_ERROR_ARGUMENT, -1, "as many times", [&] { ovoid::motion::path(std::vector<double>{0}, poses); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, 1, "", [&] {
        ovoid::motion::path(std::vector<double>{0, 0, 1}, poses).validate();
    }));
    CHECK(throws(OVOID_ERROR_NOT_FINITE, -1, "", [] { ovoid::motion(vec3(NAN, 0, 0)).validate(); }));

    const ovoid::pair p(b.box, b.hull, {}, b.far);
    const ovoid::impact cast = ovoid::cast_shape(p, {-10, 0, 0}),
                        c_cast = ovoid_shape_cast(&p, {-10, 0, 0}, 0, nullptr);
    CHECK(cast.hit_at == c_cast.hit_at && cast.status == OVOID_IMPACT_HIT);
    // The box's face is at x = 1: half way of the ray.
    const ovoid::ray_hit ray = ovoid::cast_ray(b.box, {{2, 0, 0}, {-2, 0, 0}});
    CHECK(ray.status == OVOID_IMPACT_HIT && ray.lower <= 0.5 && ray.upper >= 0.5);

    const auto arm = ovoid::compound::create({{b.box}, {b.pill, vec3(0, 9, 0)}});
    const ovoid::moving_body u(arm, pose()), v(b.pill, y.motion);
    std::vector<ovoid::step_group> groups(100);
    ovoid::motion_options full;
    full.with_steps(steps).with_groups(groups);
    const ovoid::body_impact met = ovoid::find_impact(u, v, 0, full);
    const ovoid_moving_body_pair meeting = {u, v, 0};
    const ovoid_body_impact c_met = ovoid_body_impact_find(&meeting, nullptr);
    CHECK(met.impact.hit_at == c_met.impact.hit_at && met.part_a == 0);
    ovoid::verify(u, v, 0, met, steps, groups);
    CHECK(u.part(1).shape == b.pill.get() && is_same(v.swept(0, 1), ovoid_moving_body_compute_box(&v, 0, 1)));
}

void check_ellipsoids() {
    const bodies b;
    const ovoid_polytope p = b.hull.polytope();
    ovoid_fit outer, inner;
    const ovoid_ellipsoid_options loose = {1e-4, nullptr};
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&p, &loose, &outer, NULL), OVOID_OK);
    CHECK_EQ(ovoid_ellipsoid_compute_inner(&p, &loose, &inner, NULL), OVOID_OK);
    const ovoid_ellipsoid &e = outer.ellipsoid, &f = inner.ellipsoid;
    CHECK(is_same(ovoid::compute_outer(p, 1e-4).ellipsoid, e) && is_same(ovoid::compute_inner(p, 1e-4).ellipsoid, f));
    const ovoid_fit shrunk = ovoid::compute_shrunk(p, e), stretched = ovoid::compute_stretched(p, shrunk.ellipsoid);
    CHECK(is_same(shrunk.ellipsoid, ovoid_ellipsoid_compute_shrunk(&p, &e).ellipsoid));
    CHECK(stretched.volume >= shrunk.volume &&
          ovoid::compute_enlarged(p, stretched.ellipsoid).volume >= stretched.volume);
    CHECK(is_same<ovoid_vec3>(ovoid::compute_radii(e), ovoid_ellipsoid_compute_radii(&e)));
    CHECK_EQ(ovoid::compute_volume(e), ovoid_ellipsoid_compute_volume(&e));
    const ovoid_ellipsoid moved = ovoid::compute_posed(f, vec3(20, 0, 0));
    CHECK_EQ(moved.center.x, f.center.x + 20);
    CHECK_EQ(ovoid::compute_nearest(e, moved).distance, ovoid_ellipsoid_compute_nearest(&e, &moved).distance);
    CHECK_EQ(ovoid::compute_nearest_by_sphere(e, moved).distance,
             ovoid_ellipsoid_compute_nearest_by_sphere(&e, &moved).distance);
    CHECK_EQ(ovoid::compute_nearest_to_point(e, {9, 0, 0}).distance,
             ovoid_ellipsoid_compute_nearest_to_point(&e, {9, 0, 0}).distance);
    vec3 common;
    CHECK(ovoid::is_overlapping(e, f, &common) && !ovoid::is_overlapping(e, moved));
    CHECK_EQ(ovoid::compute_measures(p).volume, b.hull.measures().volume);

    const auto areas = ovoid::areas::create(p, f, OVOID_SPLIT_OCTANTS);
    uint32_t touched = 0;
    CHECK(areas.counts().cells == 8 && areas.find_support({1, 0, 0}, &touched) < p.vertex_count && touched > 0);
    CHECK(areas.find_exit({1, 0, 0}, {1, 0, 0}, OVOID_RULE_RAY).t ==
          areas.find_exit({1, 0, 0}, {1, 0, 0}, OVOID_RULE_ALL).t);
    CHECK(ovoid::compute_split(p, f).pieces >= p.triangle_count);
    const ovoid::pair two(b.hull, b.hull, {}, vec3(20, 0, 0));
    const ovoid_areas *both[2] = {areas.get(), areas.get()};
    CHECK_EQ(ovoid::compute_paper_bounds(two, &areas, &areas, OVOID_RULE_RAY, 0.1).upper,
             ovoid_paper_compute_bounds(&two, both, OVOID_RULE_RAY, 0.1).upper);
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "", [&] { ovoid::areas::create(p, f, OVOID_SPLIT_CUBE, 3); }));
}

// A cube in parts is the cube.
void check_decompositions() {
    const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const std::uint32_t faces[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    const auto cube = ovoid::solid::from_triangles(corners, 8, faces, 12);
    const auto parts = ovoid::parts::from_solid(cube);
    CHECK(parts && parts.size() == 1 && parts[0].polytope().vertex_count == 8);
    double excess = -1;
    const auto proof = ovoid::prove(parts.of(cube), {}, &excess);
    CHECK(proof.uncovered.upper < 1e-9 && proof.excess.upper < 1e-2 && excess <= proof.excess.upper);
    const auto grown = ovoid::parts::enlarged(parts.of(cube), 0.5);
    CHECK(ovoid::prove(grown.of(cube)).excess.upper >= 0.5);
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "", [&] { ovoid::parts::enlarged(parts.of(cube), -1); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "", [&] { ovoid::parts::from_solid({}); }));
    CHECK(throws(OVOID_ERROR_EMPTY, -1, "", [&] { ovoid::prove({cube, nullptr, 0}); }));
}

// Contacts: cold, warm, their points, polygon and batch.
void check_manifolds() {
    const shape box = shape::box({1, 2, 3});
    const pose near = pose::rpy({1.9, 0.3, 0.1}, {0.1, 0, 0});
    const ovoid::pair p(box, box, {}, near);
    ovoid::manifold_options o;
    o.margin = 0.1;
    const ovoid::manifold cold = ovoid::find_manifold(p, o);
    const ovoid_manifold same = ovoid_manifold_find(&p, &o, nullptr);
    CHECK(is_same<ovoid_manifold>(cold, same));
    CHECK(is_same<ovoid_manifold>(ovoid::find_manifold(p, o, &cold), ovoid_manifold_find(&p, &o, &same)));
    CHECK(is_same<ovoid_manifold>(ovoid::make_swapped(cold), ovoid_manifold_make_swapped(&same)));
    const ovoid::manifold_points points = ovoid::compute_points(p, cold);
    CHECK_EQ(points.count, 4);
    CHECK_EQ(ovoid::compute_polygon(p, cold, o).count, cold.corners);
    CHECK(ovoid::is_proven(p, cold, o));
    ovoid::manifold wrong = cold;
    wrong.upper = -0.2;
    CHECK(!ovoid::is_proven(p, wrong, o));
    CHECK(throws(OVOID_ERROR_PROOF, -1, "upper", [&] { ovoid::verify(p, wrong, o); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "manifold", [&] { ovoid::compute_polygon(p, {}, o); }));
    CHECK(std::string(ovoid::name(cold.axis)) == "face a" || std::string(ovoid::name(cold.axis)) == "face b");
    CHECK(std::string(ovoid::name(OVOID_MANIFOLD_PROOF_FACETS)) == "facets");

    const std::vector<ovoid::posed_shape> bodies = {{box, pose()}, {box, near}};
    std::vector<ovoid::couple> couples = {{0, 1}};
    std::vector<ovoid_manifold> kept(1);
    std::vector<ovoid::manifold_points> room(1);
    ovoid::find_manifolds(ovoid::manifold_batch(bodies, couples, kept).with_options(o).with_points(room));
    CHECK(is_same(kept[0], same));
    CHECK(is_same(room[0].points[3].point_b, points.points[3].point_b));
    std::vector<ovoid_manifold> none;
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "couples", [&] { ovoid::manifold_batch(bodies, couples, none); }));
    couples[0].b = 2;
    CHECK(
        throws(OVOID_ERROR_INDEX, 0, "", [&] { ovoid::find_manifolds(ovoid::manifold_batch(bodies, couples, kept)); }));
}

// Swept spheres beside the C functions, and each kind beside the shape of the same lengths at the same pose: their
// brackets have a common point.
void check_swept() {
    const pose at = pose::rpy({0.3, -0.2, 0.4}, {0.5, 0.7, -0.3});
    using ovoid::swept_sphere;
    const std::vector<double> corners = {0.3, 0, 0, 0, 0.4, 0, 0, 0, 0.5};
    struct kind {
        swept_sphere swept;
        shape same;
    };
    const auto make = [&](int i) -> kind {
        switch (i) {
        case 0: return {swept_sphere::sphere(0.3, at.position), shape::sphere(0.3)};
        case 1: return {swept_sphere::capsule(0.2, 0.6, at), shape::capsule(0.2, 0.6)};
        case 2: return {swept_sphere::box({0.3, 0.4, 0.5}, at), shape::box({0.3, 0.4, 0.5})};
        case 3: return {swept_sphere::cylinder(0.2, 0.6, at), shape::cylinder(0.2, 0.6, 1e-3)};
        case 4: return {swept_sphere::cone(0.2, 0.6, at), shape::cone(0.2, 0.6, 1e-3)};
        case 5:
            return {swept_sphere::hull(corners.data(), 3, {0.1, 0.4 / 3, 0.5 / 3}, at), shape::from_points(corners)};
        default: return {swept_sphere::ellipsoid({0.3, 0.4, 0.5}, at), shape::ellipsoid({0.3, 0.4, 0.5})};
        }
    };
    const shape ball = shape::sphere(0.25);
    for (int i = 0; i < 7; i++)
        for (const vec3 &center : {vec3{0.3, -0.2, 1.4}, vec3{1.2, 0.3, 0.4}, vec3{0.3, 0.1, 0.6}}) {
            const kind of = make(i);
            const swept_sphere other = swept_sphere::sphere(0.25, center);
            const ovoid_swept_pair c = {&of.swept, &other};
            ovoid_witness w, v;
            CHECK(is_same(ovoid::collide(of.swept, other), ovoid_swept_collide(c)));
            CHECK(is_same(ovoid::distance(of.swept, other, &w), ovoid_swept_distance(c, &v)) && is_same(w, v));
            CHECK(is_same(ovoid::contact_depth(of.swept, other), ovoid_swept_contact(c, nullptr)));
            const ovoid::verdict found = ovoid::depth(of.swept, other);
            CHECK(is_same(found, ovoid_swept_depth(c, nullptr)));
            const ovoid::answer truth = ovoid::depth({of.same, ball, at, pose(center)});
            if (found.status == OVOID_UNDECIDED) continue;
            CHECK_LE(found.lower, truth.upper + 1e-13);
            CHECK_LE(truth.lower, found.upper + 1e-13);
        }
    const swept_sphere round = swept_sphere::box({0.3, 0.4, 0.5}, at, 0.1);
    CHECK_EQ(round.radius, 0.1);
    CHECK_EQ(swept_sphere(ovoid_swept_sphere(round)).half[2], 0.5);
}

} // namespace

int main() {
    check_swept();
    check_manifolds();
    check_decompositions();
    check_pairs();
    check_batches();
    check_compounds();
    check_motions();
    check_ellipsoids();
    return check_end();
}
