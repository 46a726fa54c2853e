// A world through the C++ header beside one through C, given the same bodies and moves: the same ids, contacts, hits
// and casts, bit for bit. Truth: the C world; of refusals, the code and place that ovoid/world.h states.
#include "same.hpp"

#include <algorithm>

using ovoid::pose;
using ovoid::shape;
using ovoid::vec3;

namespace {

struct worlds {
    shape box = shape::box({0.5, 0.5, 0.5}), ball = shape::sphere(0.4);
    ovoid::compound pairs = ovoid::compound::create({{box}, {ball, vec3(0.8, 0, 0)}});
    ovoid::world ours = ovoid::world::create();
    ovoid_world *theirs = ovoid_world_create(nullptr, nullptr);
    std::vector<ovoid::world_body> bodies;
    std::vector<ovoid::id> ids;

    worlds() {
        uint64_t s = 7;
        for (int i = 0; i < 60; i++) {
            const vec3 where{random_uniform(&s, -3, 3), random_uniform(&s, -3, 3), random_uniform(&s, -3, 3)};
            const double turn = random_uniform(&s, -3, 3);
            const pose at = pose::rpy(where, {turn, 0, -turn});
            const ovoid::body body = i % 3 == 0   ? ovoid::body(box, at)
                                     : i % 3 == 1 ? ovoid::body(ball, at)
                                                  : ovoid::body(pairs, at);
            bodies.emplace_back(body, 0u, 0u, static_cast<std::uint64_t>(i));
        }
        ids = ours.add_many(bodies);
        for (const ovoid_world_body &b : bodies) ovoid_world_add(theirs, &b, nullptr);
    }
    ~worlds() { ovoid_world_destroy(theirs); }
    worlds(const worlds &) = delete;
    worlds &operator=(const worlds &) = delete;
};

bool is_same_hit(const ovoid_world_hit &a, const ovoid_world_hit &b) {
    return a.a == b.a && a.b == b.b && a.lower == b.lower &&
           (a.b == 0 || is_same_answer(a.answer.deciding, b.answer.deciding));
}

void check_contacts(worlds &w) {
    for (int kind = OVOID_QUERY_COLLIDE; kind <= OVOID_QUERY_DEPTH; kind++) {
        const ovoid::contact_query query(static_cast<ovoid_query_kind>(kind), kind ? 0.2 : 0);
        const ovoid::contacts found = w.ours.compute_contacts(query);
        ovoid_contacts truth;
        CHECK_EQ(ovoid_world_compute_contacts(w.theirs, &query, &truth, nullptr), OVOID_OK);
        CHECK(found.size() == truth.count && found.size() > 20 && !found.empty());
        CHECK_EQ(found.has_witnesses(), kind >= OVOID_QUERY_DISTANCE);
        std::size_t i = 0;
        for (const ovoid::contact &c : found) {
            const ovoid_contact &t = truth.items[i];
            CHECK(c.a == t.a && c.b == t.b && c.part_a == t.part_a && is_same(c.verdict, t.verdict));
            CHECK(c.user_a == w.ours.at(c.a).user && c.user_b == w.ours.at(c.b).user);
            if (found.has_witnesses()) CHECK(is_same(found.witness(c), truth.witnesses[i]));
            CHECK(&found[i] == &c);
            i++;
        }
        CHECK_EQ(i, truth.count);
        ovoid_contact_proof proof = {};
        CHECK_EQ(ovoid_world_compute_proof(w.theirs, truth.items, &proof, nullptr), OVOID_OK);
        CHECK(is_same_answer(w.ours.compute_proof(found[0]).deciding, proof.answer.deciding));
    }
}

void check_manifolds(worlds &w) {
    ovoid::material soft;
    soft.margin = 0.1;
    soft.friction = 0.5;
    w.ours.set_material(w.ids[2], soft);
    ovoid_world_set_material(w.theirs, w.ids[2], &soft, nullptr);
    CHECK(is_same(w.ours.material_of(w.ids[2]), soft) && w.ours.material_of(w.ids[3]).friction == 0);
    ovoid::world_manifold_query query;
    query.options.margin = 0.05;
    std::size_t parts = 0;
    for (int frame = 0; frame < 3; frame++) {
        const ovoid::world_manifolds found = w.ours.compute_manifolds(query);
        ovoid_world_manifolds truth;
        CHECK_EQ(ovoid_world_compute_manifolds(w.theirs, &query, &truth, nullptr), OVOID_OK);
        CHECK(found.size() == truth.count && found.size() > 20 && !found.empty());
        CHECK(found.part_count == truth.part_count && found.begun == truth.begun);
        CHECK(frame == 0 ? found.begun == found.size() : found.begun < found.size());
        std::size_t i = 0;
        for (const ovoid::world_manifold &m : found) {
            const ovoid_world_manifold &t = truth.items[i];
            CHECK(is_same(m, t) && &found[i] == &m);
            const auto of = found.parts_of(m);
            const auto points = found.points_of(m);
            CHECK(of.size() == t.count && points.size() == t.count);
            for (std::size_t k = 0; k < of.size(); k++) {
                CHECK(is_same(of[k], truth.parts[t.first + k]));
                CHECK_EQ(points[k].count, truth.points[t.first + k].count);
                parts++;
            }
            i++;
        }
        const auto gone = found.partings();
        CHECK_EQ(gone.size(), truth.ended_count);
        for (std::size_t k = 0; k < gone.size(); k++) CHECK(is_same(gone[k], truth.ended[k]));
        const ovoid::id far = found[0].a;
        const pose away = vec3(100 + frame, 0, 0);
        w.ours.move(far, away);
        ovoid_world_move(w.theirs, far, &away, nullptr);
        CHECK(frame == 0 || gone.size() > 0);
    }
    CHECK(parts > 60);
    query.ahead = -1;
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "ahead", [&] { w.ours.compute_manifolds(query); }));
    soft.margin = -1;
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "margin", [&] { w.ours.set_material(w.ids[2], soft); }));
    CHECK(throws(OVOID_ERROR_INDEX, -1, "names no body", [&] { w.ours.material_of(0); }));
}

void check_bodies(worlds &w) {
    CHECK(w.ids.size() == 60 && w.ours.size() == 60);
    std::vector<ovoid::id> walked;
    for (const ovoid::id b : w.ours) walked.push_back(b);
    CHECK(walked == w.ids && std::distance(w.ours.begin(), w.ours.end()) == 60);
    const ovoid::world_body got = w.ours.at(w.ids[7]);
    CHECK(got.user == 7 && got.body.shape == w.ball.get() && is_same(got.body.pose, w.bodies[7].body.pose));
    for (std::size_t i = 0; i < 60; i++)
        CHECK_EQ(w.ids[i], i ? ovoid_world_find_next(w.theirs, w.ids[i - 1]) : ovoid_world_find_next(w.theirs, 0));

    const std::vector<ovoid::id> two = {w.ids[3], w.ids[4]};
    const std::vector<pose> poses = {vec3(0.1, 0, 0), vec3(0, 0.1, 0)};
    w.ours.move_many(two, poses);
    w.ours.move(w.ids[5], vec3(0, 0, 0.1));
    const ovoid_world_moves moves = {two.data(), poses.data(), 2};
    ovoid_world_move_many(w.theirs, &moves, nullptr);
    const pose third = vec3(0, 0, 0.1);
    ovoid_world_move(w.theirs, w.ids[5], &third, nullptr);
    check_contacts(w);

    const auto touches = [&](std::size_t a, std::size_t b) {
        const ovoid::contacts all = w.ours.compute_contacts({});
        return std::any_of(all.begin(), all.end(),
                           [&](const ovoid::contact &c) { return c.a == w.ids[a] && c.b == w.ids[b]; });
    };
    CHECK(touches(3, 4) && w.ours.is_pair(w.ids[3], w.ids[4]));
    w.ours.set_ignored(w.ids[3], w.ids[4], true);
    CHECK(!touches(3, 4) && touches(3, 5) && !w.ours.is_pair(w.ids[3], w.ids[4]));
    w.ours.set_ignored(w.ids[3], w.ids[4], false);
    CHECK(touches(3, 4));
    w.ours.set_groups(w.ids[3], 2, 1);
    w.ours.set_groups(w.ids[4], 4, 1);
    CHECK(!touches(3, 4) && !w.ours.is_pair(w.ids[3], w.ids[4]));
    w.ours.set_groups(w.ids[3], 0, 0);
    w.ours.set_groups(w.ids[4], 0, 0);
    w.ours.renew(w.ids[3]);
    CHECK(touches(3, 4));
}

// Between frames.
void check_finds(worlds &w) {
    const ovoid_world *c = w.theirs;
    ovoid_world_hit hit;
    ovoid_world_find_any(c, nullptr, &hit, nullptr);
    CHECK(is_same_hit(w.ours.find_any(), hit) && hit.b != 0);
    const std::vector<ovoid::id> some = {w.ids[9], w.ids[10]};
    const ovoid_world_ids named = {some.data(), 2};
    ovoid_world_find_any(c, &named, &hit, nullptr);
    CHECK(is_same_hit(w.ours.find_any(some), hit));
    CHECK_EQ(w.ours.find_any(std::vector<ovoid::id>()).b, 0);
    const std::vector<ovoid::world_body> probes = {{{w.ball, vec3(50, 0, 0)}}, {{w.ball, vec3(0, 0, 0)}}};
    const ovoid_world_probes all = {probes.data(), 2, nullptr, 0};
    ovoid_world_find_any_of(c, &all, &hit, nullptr);
    CHECK(is_same_hit(w.ours.find_any_to(probes), hit) && hit.a == 1 && hit.b != 0);
    const std::vector<ovoid::world_body> aside = {{{w.ball, vec3(50, 0, 0)}}, {{w.ball, vec3(50.5, 0, 0)}}};
    const std::vector<ovoid::couple> couples = {{0, 1}};
    const ovoid_world_probes state = {aside.data(), 2, couples.data(), 1};
    ovoid_world_find_any_of(c, &state, &hit, nullptr);
    CHECK(is_same_hit(w.ours.find_any_of(aside, couples), hit) && hit.a == 0 && hit.b == (OVOID_WORLD_PROBE | 1));
    ovoid_world_query query = {w.ids[0], nullptr, 0, nullptr};
    ovoid_world_find_nearest(c, &query, &hit, nullptr);
    CHECK(is_same_hit(w.ours.find_nearest(w.ids[0]), hit));
    query = {0, &probes[0], 0, nullptr};
    ovoid_world_find_nearest(c, &query, &hit, nullptr);
    CHECK(is_same_hit(w.ours.find_nearest_to(probes[0]), hit) && hit.b != 0);
    ovoid::options near;
    near.cap = 1;
    CHECK_EQ(w.ours.find_nearest_to(probes[0], near).b, 0);
    ovoid_world_find_nearest_pair(c, nullptr, &hit, nullptr);
    CHECK(is_same_hit(w.ours.find_nearest_pair(), hit));

    std::vector<ovoid_world_hit> space(60);
    ovoid_world_hits truth = {space.data(), 60, 0}, mine = truth;
    query = {0, &probes[1], 0.5, nullptr};
    ovoid_world_find_overlaps(c, &query, &truth, nullptr);
    const std::vector<ovoid::world_hit> overlaps = w.ours.find_overlaps(probes[1], 0.5);
    CHECK(overlaps.size() == truth.count && overlaps.size() > 2);
    for (std::size_t i = 0; i < overlaps.size(); i++) CHECK(is_same_hit(overlaps[i], space[i]));
    w.ours.find_overlaps(probes[1], 0.5, mine);
    CHECK_EQ(mine.count, truth.count);
    CHECK(w.ours.find_overlaps(probes[0]).empty());
    CHECK_EQ(w.ours.find_overlaps(w.ours.make_point({0.1, 0, 0})).size() > 0, true);

    const ovoid::ray ray({-20, 0, 0}, {1, 0, 0}, 40, 0.01);
    const ovoid_world_ray grouped = {ray, {0, 0}};
    ovoid_world_cast cast;
    ovoid_world_cast_ray(c, &grouped, &cast, nullptr);
    const ovoid::world_cast met = w.ours.cast_ray(ray);
    CHECK(met.body == cast.body && met.body != 0 && met.lower == cast.lower && is_same(met.point, cast.point));
    CHECK(met.lower > 15 && met.upper < 20);
    const ovoid_world_sweep sweep = {probes[0], {-100, 0, 0}};
    ovoid_world_cast_body(c, &sweep, &cast, nullptr);
    const ovoid::world_cast moved = w.ours.cast_body(probes[0], {-100, 0, 0});
    CHECK(moved.body == cast.body && moved.body != 0 && moved.lower == cast.lower);
}

void check_refusals(worlds &w) {
    const ovoid::id stale = w.ours.add({w.ball, vec3(9, 9, 9)});
    w.ours.remove(stale);
    const std::vector<ovoid::id> both = {w.ids[0], stale};
    const std::vector<pose> poses(2);
    CHECK(throws(OVOID_ERROR_INDEX, 0, "", [&] { w.ours.remove(stale); }));
    CHECK(throws(OVOID_ERROR_INDEX, 1, "", [&] { w.ours.remove_many(both); }));
    CHECK(throws(OVOID_ERROR_INDEX, 0, "", [&] { w.ours.move(stale, {}); }));
    CHECK(throws(OVOID_ERROR_INDEX, 1, "", [&] { w.ours.move_many(both, poses); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "as many", [&] { w.ours.move_many(both, std::vector<pose>(1)); }));
    CHECK(throws(OVOID_ERROR_NOT_FINITE, 0, "", [&] { w.ours.move(w.ids[0], vec3(NAN, 0, 0)); }));
    CHECK(throws(OVOID_ERROR_NOT_FINITE, 0, "", [&] { w.ours.add({w.ball, vec3(NAN, 0, 0)}); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, 0, "", [&] { w.ours.add(ovoid::shape_view()); }));
    CHECK(throws(OVOID_ERROR_INDEX, -1, "", [&] { w.ours.at(stale); }));
    CHECK(throws(OVOID_ERROR_INDEX, -1, "", [&] { w.ours.find_nearest(stale); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "", [&] { w.ours.compute_contacts({OVOID_QUERY_WITHIN, -1}); }));
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "", [&] { w.ours.cast_ray({{0, 0, 0}, {0, 0, 0}}); }));
    const std::vector<ovoid::world_body> bodies = {{{w.ball}}, {{w.ball, vec3(0, 2e50, 0)}}};
    const std::size_t before = w.ours.size();
    CHECK(throws(OVOID_ERROR_RANGE, 1, "", [&] { w.ours.add_many(bodies); }));
    CHECK_EQ(w.ours.size(), before);
    ovoid::world_options o;
    o.enlargement = -1;
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "", [&] { ovoid::world::create(o); }));

    // A filter, as a lambda that captures nothing; a world that was moved keeps its bodies.
    o = {};
    o.filter = [](void *, ovoid_id, ovoid_id) { return 0; };
    auto none = ovoid::world::create(o);
    none.add(w.ball), none.add(w.ball);
    const ovoid::world moved = std::move(none);
    CHECK(!none && moved.size() == 2 && moved.find_any().b == 0); // NOLINT: moved from is empty
}

} // namespace

int main() {
    worlds w;
    check_contacts(w);
    check_bodies(w);
    check_finds(w);
    check_manifolds(w);
    check_refusals(w);
    return check_end();
}
