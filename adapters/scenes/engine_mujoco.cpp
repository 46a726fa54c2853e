/// @file engine_mujoco.cpp
/// Scenes in MuJoCo, as models in its XML.
#include "scenes/scene.hpp"

#include <ovoid/mujoco.hpp>

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace scenes {

const double hull_margin = 0;
const char *const engine_name = "MuJoCo";
const int most_bodies = 100;
const bool has_capsules = true;

namespace {

/// Text by printf.
class text {
  public:
    void add(const char *format, ...) __attribute__((format(printf, 2, 3))) {
        char line[1024];
        va_list arguments;
        va_start(arguments, format);
        const int length = std::vsnprintf(line, sizeof line, format, arguments);
        va_end(arguments);
        whole.append(line, static_cast<std::size_t>(length));
    }
    std::string whole;
};

void add_pose(text &to, const ovoid_pose &p) {
    to.add(" pos=\"%.17g %.17g %.17g\" quat=\"%.17g %.17g %.17g %.17g\"", p.position.x, p.position.y, p.position.z,
           p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z);
}

void add_geom(text &to, const scene &of, const placed &at, double friction) {
    const part &p = of.parts[at.part];
    to.add("<geom friction=\"%.17g 0.005 0.0001\"", friction);
    add_pose(to, at.pose);
    const char *const types[] = {"box", "sphere", "capsule", "cylinder", "mesh"};
    to.add(" type=\"%s\"", types[static_cast<int>(p.is)]);
    if (p.is == kind::hull)
        to.add(" mesh=\"part%zu\"/>\n", at.part);
    else
        to.add(" size=\"%.17g %.17g %.17g\"/>\n", p.size.x, p.size.y, p.size.z);
}

void add_body(text &to, const scene &of, const body &b) {
    to.add("<body");
    add_pose(to, b.pose);
    to.add(">\n");
    if (b.moves == motion::free) to.add("<freejoint/>");
    if (b.moves == motion::axle) to.add("<joint type=\"hinge\" axis=\"0 0 1\"/>");
    to.add("<inertial pos=\"0 0 0\" mass=\"%.17g\" diaginertia=\"%.17g %.17g %.17g\"/>\n", b.mass, b.inertia.x,
           b.inertia.y, b.inertia.z);
    for (const placed &at : b.parts) add_geom(to, of, at, b.friction);
    to.add("</body>\n");
}

std::string write_model(const scene &of) {
    text to;
    to.add("<mujoco><compiler inertiafromgeom=\"false\" balanceinertia=\"true\"/>\n");
    to.add("<option timestep=\"%.17g\" gravity=\"0 0 -9.81\" jacobian=\"sparse\"/>\n", of.step);
    to.add("<size nconmax=\"%zu\" njmax=\"%zu\"/>\n<asset>\n", 25 * of.bodies.size() + 500,
           100 * of.bodies.size() + 1000);
    for (std::size_t i = 0; i < of.parts.size(); i++) {
        if (of.parts[i].is != kind::hull) continue;
        to.add("<mesh name=\"part%zu\" vertex=\"", i);
        for (const ovoid_vec3 &v : of.parts[i].points) to.add("%.9g %.9g %.9g ", v.x, v.y, v.z);
        to.add("\"/>\n");
    }
    to.add("</asset><worldbody>\n");
    for (const body &b : of.bodies) add_body(to, of, b);
    to.add("</worldbody></mujoco>\n");
    return to.whole;
}

mjModel *compile(const std::string &xml) {
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), "scene.xml")], xml.data(), xml.size());
    char why[1000] = "";
    mjModel *made = mj_loadXML("scene.xml", files.get(), why, sizeof why);
    mj_deleteVFS(files.get());
    if (!made) throw std::runtime_error(why);
    return made;
}

ovoid_vec3 vector(const mjtNum *v) { return {v[0], v[1], v[2]}; }

class mujoco_engine : public engine {
  public:
    mujoco_engine(const scene &of, bool ours) : model_(compile(write_model(of))), data_(mj_makeData(model_)) {
        if (ours) adapter_ = std::make_unique<ovoid::mujoco::adapter>(model_);
        for (std::size_t i = 0; i < of.bodies.size(); i++) {
            const int joint = model_->body_jntadr[i + 1];
            if (joint < 0) continue;
            // Of a free joint: the velocity in the world, the spin in the body.
            const body &b = of.bodies[i];
            const ovoid_pose turn = {{0, 0, 0}, b.pose.rotation};
            const ovoid_vec3 w = ovoid_pose_compute_local_point(&turn, b.spin);
            const mjtNum values[6] = {b.velocity.x, b.velocity.y, b.velocity.z, w.x, w.y, w.z};
            if (b.moves == motion::free)
                mju_copy(data_->qvel + model_->jnt_dofadr[joint], values, 6);
            else
                data_->qvel[model_->jnt_dofadr[joint]] = w.z;
        }
        mj_forward(model_, data_);
    }
    ~mujoco_engine() override {
        adapter_.reset();
        mj_deleteData(data_);
        mj_deleteModel(model_);
    }

    void step() override { mj_step(model_, data_); }

    void read_state(state &to) const override {
        to = {};
        for (int i = 1; i < model_->nbody; i++) {
            const int joint = model_->body_jntadr[i];
            ovoid_pose at = {vector(model_->body_pos + 3 * i), {}};
            const mjtNum *q = model_->body_quat + 4 * i;
            mjtNum turned[4] = {q[0], q[1], q[2], q[3]};
            ovoid_vec3 velocity = {}, spin = {};
            if (joint >= 0 && model_->jnt_type[joint] == mjJNT_FREE) {
                const mjtNum *p = data_->qpos + model_->jnt_qposadr[joint],
                             *v = data_->qvel + model_->jnt_dofadr[joint];
                at.position = vector(p);
                mju_copy(turned, p + 3, 4);
                velocity = vector(v);
                mjtNum w[3];
                mju_rotVecQuat(w, v + 3, turned);
                spin = vector(w);
            } else if (joint >= 0) {
                const mjtNum axis[3] = {0, 0, 1};
                mjtNum turn[4];
                mju_axisAngle2Quat(turn, axis, data_->qpos[model_->jnt_qposadr[joint]]);
                mju_mulQuat(turned, q, turn);
                spin = {0, 0, data_->qvel[model_->jnt_dofadr[joint]]};
            }
            at.rotation = {turned[0], turned[1], turned[2], turned[3]};
            to.poses.push_back(at);
            to.velocities.push_back(velocity);
            to.spins.push_back(spin);
        }
    }

    void read_touches(std::vector<touch> &to) const override {
        to.clear();
        for (int i = 0; i < data_->ncon; i++) {
            const mjContact &c = data_->contact[i];
            to.push_back({number(c.geom1), number(c.geom2), vector(c.frame), c.dist});
        }
    }

  private:
    std::uint32_t number(int geom) const { return static_cast<std::uint32_t>(model_->geom_bodyid[geom] - 1); }
    mjModel *model_;
    mjData *data_;
    std::unique_ptr<ovoid::mujoco::adapter> adapter_;
};

} // namespace

engine *create_engine(const scene &from, bool ours) { return new mujoco_engine(from, ours); }

} // namespace scenes
