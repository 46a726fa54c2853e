// <ovoid/mujoco.hpp> in MuJoCo itself. Sources of truth: closed forms, ovoid's proven brackets for random poses, and
// physics for what rests.
#include "check.h"

#include <ovoid/mujoco.hpp>

#include <string>
#include <thread>

namespace {

struct model_deleter {
    void operator()(mjModel *m) const { mj_deleteModel(m); }
    void operator()(mjData *d) const { mj_deleteData(d); }
};
using model_owner = std::unique_ptr<mjModel, model_deleter>;
using data_owner = std::unique_ptr<mjData, model_deleter>;

/// A model of bodies that are free, each written as its geom.
model_owner compile(const std::vector<std::string> &geoms, const std::string &fixed = "") {
    std::string xml =
        "<mujoco><option timestep=\"0.002\"/><asset><mesh name=\"rock\" vertex=\"-.3 -.3 -.3 .3 -.3 -.3 0 .4 -.3 "
        "0 0 .4 .1 .1 .1\"/></asset><worldbody>" +
        fixed;
    for (const std::string &geom : geoms) xml += "<body><freejoint/><geom mass=\"1\" " + geom + "/></body>";
    xml += "</worldbody></mujoco>";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(xml.size()));
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), "model.xml")], xml.data(), xml.size());
    char why[500] = "";
    model_owner made(mj_loadXML("model.xml", files.get(), why, sizeof why));
    if (!made) std::printf("%s\n", why);
    return made;
}

void place(mjData &d, int body, const std::array<double, 3> &at, const std::array<double, 4> &turn = {1, 0, 0, 0}) {
    std::copy(at.begin(), at.end(), d.qpos + 7 * body);
    std::copy(turn.begin(), turn.end(), d.qpos + 7 * body + 3);
}

/// Two boxes, one 0.01 in the other: four points, in the middle between the faces, from the first geom to the second.
void test_boxes() {
    const model_owner m = compile({"type=\"box\" size=\".5 .5 .5\"", "type=\"box\" size=\".4 .4 .4\""});
    const ovoid::mujoco::adapter adapter(m.get());
    const data_owner d(mj_makeData(m.get()));
    place(*d, 1, {0, 0, 0.89});
    mj_forward(m.get(), d.get());
    CHECK_EQ(d->ncon, 4);
    for (int i = 0; i < d->ncon; i++) {
        const mjContact &c = d->contact[i];
        CHECK_NEAR(c.dist, -0.01, 1e-12);
        CHECK_NEAR(c.frame[2], 1, 1e-12);
        CHECK_NEAR(c.pos[2], 0.495, 1e-12);
        CHECK_NEAR(std::abs(c.pos[0]), 0.4, 1e-12);
        // MuJoCo has made a frame of it.
        CHECK_NEAR(mju_dot3(c.frame, c.frame + 3), 0, 1e-12);
        CHECK_NEAR(mju_norm3(c.frame + 6), 1, 1e-12);
    }
    // A margin, that MuJoCo takes off again from what is to be pushed: contacts before the boxes touch.
    m->geom_margin[0] = m->geom_margin[1] = 0.02;
    place(*d, 1, {0, 0, 0.915});
    mj_forward(m.get(), d.get());
    CHECK_EQ(d->ncon, 4);
    CHECK_NEAR(d->contact[0].dist, 0.015, 1e-12);
    place(*d, 1, {0, 0, 0.93});
    mj_forward(m.get(), d.get());
    CHECK_EQ(d->ncon, 0);
}

/// A corner that slides out of a face stays where contacts are remembered, and is another point where they are not.
void test_memory() {
    const model_owner m = compile({"type=\"box\" size=\".5 .5 .5\"", "type=\"box\" size=\".5 .5 .5\""});
    for (const bool remember : {true, false}) {
        ovoid::mujoco::settings chosen;
        chosen.remember = remember;
        const ovoid::mujoco::adapter adapter(m.get(), chosen);
        const data_owner d(mj_makeData(m.get())), fresh(mj_makeData(m.get()));
        place(*d, 1, {0, -0.001, 0.99});
        mj_forward(m.get(), d.get());
        for (mjData *data : {d.get(), fresh.get()}) {
            place(*data, 1, {0, 0.001, 0.99});
            mj_forward(m.get(), data);
            CHECK_EQ(data->ncon, 4);
        }
        bool same = d->ncon == fresh->ncon;
        for (int i = 0; same && i < d->ncon; i++) same = !std::memcmp(d->contact[i].pos, fresh->contact[i].pos, 24);
        CHECK_EQ(same, !remember);
    }
}

/// Each pair of types at random poses: no contact deeper than the proven depth, none missing, all within the margin.
void test_poses() {
    const std::vector<std::string> geoms = {"type=\"sphere\" size=\".3\"",      "type=\"capsule\" size=\".2 .3\"",
                                            "type=\"cylinder\" size=\".3 .4\"", "type=\"box\" size=\".3 .4 .2\"",
                                            "type=\"mesh\" mesh=\"rock\"",      "type=\"box\" size=\".5 .5 .01\""};
    const model_owner m = compile(geoms);
    const ovoid::mujoco::adapter adapter(m.get());
    const data_owner d(mj_makeData(m.get()));
    long asked = 0;
    for (std::uint64_t number = 1; number <= 300; number++) {
        std::uint64_t seed = check_seed = number;
        for (int i = 0; i < m->nbody - 1; i++) {
            std::array<double, 4> q;
            for (double &x : q) x = random_normal(&seed);
            mju_normalize4(q.data());
            const auto at = [&] { return random_uniform(&seed, -0.7, 0.7); };
            place(*d, i, {at(), at(), at()}, q);
        }
        mj_forward(m.get(), d.get());
        for (int a = 0; a < m->ngeom; a++)
            for (int b = a + 1; b < m->ngeom; b++) {
                const int first = m->geom_type[a] <= m->geom_type[b] ? a : b, second = a + b - first;
                if (!ovoid::mujoco::detail::is_answered(m->geom_type[first], m->geom_type[second])) continue;
                const auto pose = [&](int g) {
                    mjtNum q[4];
                    mju_mat2Quat(q, d->geom_xmat + 9 * g);
                    const mjtNum *p = d->geom_xpos + 3 * g;
                    return ovoid_pose{{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
                };
                const ovoid_pair pair = {adapter.find_shape(a)->get(), adapter.find_shape(b)->get(), pose(a), pose(b)};
                const ovoid_answer exact = ovoid_depth(&pair, nullptr, nullptr, nullptr);
                double least = 1e300;
                for (int i = 0; i < d->ncon; i++) {
                    const mjContact &c = d->contact[i];
                    if (c.geom1 + c.geom2 == a + b && (c.geom1 == a || c.geom1 == b)) least = std::min(least, c.dist);
                }
                asked++;
                CHECK_LE(exact.lower, least + 5e-4);
                if (exact.upper < -1e-9) CHECK_LE(least, 0);
            }
    }
    CHECK_LE(3000, asked);
    CHECK_EQ(adapter.refused_count(), 0u);
}

/// Boxes flush but for rounding (mujoco#3476): a contact is never as deep as a box is wide.
void test_flush() {
    const model_owner m = compile({"type=\"box\" size=\".055 .0355 .02\"", "type=\"box\" size=\".055 .0355 .02\""});
    const ovoid::mujoco::adapter adapter(m.get());
    const data_owner d(mj_makeData(m.get()));
    for (std::uint64_t number = 1; number <= 2000; number++) {
        std::uint64_t seed = check_seed = number;
        const double tilt = std::pow(10, random_uniform(&seed, -12, -3)), overlap = random_uniform(&seed, 0, 1e-4);
        std::array<double, 4> q = {1, 0, 0, 0};
        for (std::size_t i = 1; i < 4; i++) q[i] = tilt * random_normal(&seed);
        mju_normalize4(q.data());
        place(*d, 1, {random_uniform(&seed, -0.01, 0.01), 0.071 - overlap, random_uniform(&seed, -0.01, 0.01)}, q);
        mj_forward(m.get(), d.get());
        // Corners go at most by the tilt beyond the overlap.
        for (int i = 0; i < d->ncon; i++) CHECK_LE(-(overlap + 10 * tilt * 0.07), d->contact[i].dist);
        if (overlap > 2e-7) CHECK_LE(1, d->ncon);
    }
}

/// Boxes on a plane, which MuJoCo answers, and on each other, which ovoid does: at rest after two seconds.
void test_rest() {
    std::vector<std::string> geoms(3, "type=\"box\" size=\".2 .2 .2\"");
    const model_owner m = compile(geoms, "<geom type=\"plane\" size=\"5 5 1\"/>");
    const ovoid::mujoco::adapter adapter(m.get());
    const data_owner d(mj_makeData(m.get()));
    for (int i = 0; i < 3; i++) place(*d, i, {0, 0, 0.2 + 0.4 * i});
    for (int i = 0; i < 1000; i++) mj_step(m.get(), d.get());
    CHECK_EQ(d->ncon, 12);
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(d->qpos[7 * i + 2], 0.2 + 0.4 * i, 0.005);
        CHECK_NEAR(d->qpos[7 * i], 0, 1e-6);
        CHECK_LE(mju_norm3(d->qvel + 6 * i), 1e-3);
    }
}

/// The table of functions is whole again when the last adapter goes, and other models are never answered by ovoid.
void test_table() {
    const mjfCollision before = mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX];
    const model_owner m = compile({"type=\"box\" size=\".5 .5 .5\"", "type=\"ellipsoid\" size=\".5 .4 .3\""});
    const model_owner other = compile({"type=\"box\" size=\".5 .5 .5\"", "type=\"box\" size=\".4 .4 .4\""});
    {
        const ovoid::mujoco::adapter adapter(m.get());
        CHECK(mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] == ovoid::mujoco::detail::collide);
        CHECK(mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_SPHERE] != ovoid::mujoco::detail::collide);
        CHECK(adapter.find_shape(0) != nullptr);
        CHECK(adapter.find_shape(1) == nullptr);
        const data_owner d(mj_makeData(other.get()));
        place(*d, 1, {0, 0, 0.89});
        mj_forward(other.get(), d.get());
        CHECK_LE(4, d->ncon);
        bool is_refused = false;
        try {
            const ovoid::mujoco::adapter twice(m.get());
        } catch (const ovoid::error &e) {
            is_refused = e.code() == OVOID_ERROR_ARGUMENT;
        }
        CHECK(is_refused);
        // The refused one has not taken the first one's place.
        CHECK(mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] == ovoid::mujoco::detail::collide);
    }
    CHECK(mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] == before);
}

/// Threads, each with its data, come to the same numbers as one alone.
void test_threads() {
    const model_owner m = compile(std::vector<std::string>(6, "type=\"mesh\" mesh=\"rock\""),
                                  "<geom type=\"box\" size=\"5 5 1\" pos=\"0 0 -1\"/>");
    ovoid::mujoco::adapter adapter(m.get());
    const auto run = [&] {
        const data_owner d(mj_makeData(m.get()));
        for (int i = 0; i < 6; i++) place(*d, i, {0.1 * i, 0.05 * i, 0.5 + 0.7 * i});
        for (int i = 0; i < 300; i++) mj_step(m.get(), d.get());
        adapter.forget(d.get());
        return std::vector<double>(d->qpos, d->qpos + m->nq);
    };
    const std::vector<double> alone = run();
    std::array<std::vector<double>, 4> all;
    std::vector<std::thread> threads;
    for (std::vector<double> &one : all) threads.emplace_back([&one, &run] { one = run(); });
    for (std::thread &t : threads) t.join();
    for (const std::vector<double> &one : all) CHECK(one == alone);
}

} // namespace

int main() {
    test_boxes();
    test_memory();
    test_poses();
    test_flush();
    test_rest();
    test_table();
    test_threads();
    return check_end();
}
