/// @file scene.hpp
/// A scene of rigid bodies in no engine's words, so that several engines run the same one: convex parts, bodies made of
/// them, their masses and first velocities, the step and the time.
#ifndef ADAPTERS_SCENE_HPP
#define ADAPTERS_SCENE_HPP

#include <ovoid/ovoid.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace scenes {

/// What a part is; sizes as the constructors of ovoid::shape take them.
enum class kind { box, sphere, capsule, cylinder, hull };

/// A convex part in its own frame. box: half sizes; sphere: x the radius; capsule and cylinder: x the radius, y half
/// the length along z; hull: points.
struct part {
    kind is = kind::box;
    ovoid_vec3 size = {};
    std::vector<ovoid_vec3> points;
};

/// A part placed in a body.
struct placed {
    std::size_t part;
    ovoid_pose pose;
};

/// What a body may do.
enum class motion { fixed, free, axle };

/// A body; its origin is its centre of mass. An axle turns about its own z, at its place.
struct body {
    std::vector<placed> parts;
    ovoid_pose pose = {};
    motion moves = motion::free;
    double mass = 1;
    ovoid_vec3 inertia = {1, 1, 1}; ///< principal, along the body's axes
    ovoid_vec3 velocity = {}, spin = {};
    double friction = 0.6;
};

/// A scene. `fastest`: no body can be faster without energy that the scene does not have; of an axle the spin, else the
/// velocity.
struct scene {
    std::string name;
    std::vector<part> parts;
    std::vector<body> bodies;
    double step = 1.0 / 240;
    double seconds = 10;
    double size = 1; ///< of a typical body; what counts as a difference is a share of it
    double fastest = 1;
    bool rests = true; ///< comes to rest by its end
};

/// Where the bodies are and how they move.
struct state {
    std::vector<ovoid_pose> poses;
    std::vector<ovoid_vec3> velocities, spins;
};

/// A contact point as an engine has it: normal from a to b, separation negative for an overlap.
struct touch {
    std::uint32_t a, b;
    ovoid_vec3 normal;
    double separation;
};

/// A scene in an engine.
class engine {
  public:
    virtual ~engine() = default;
    virtual void step() = 0;
    /// The state after the last step.
    virtual void read_state(state &to) const = 0;
    /// The contacts of the last step, found where the bodies were before it.
    virtual void read_touches(std::vector<touch> &to) const = 0;
};

/// The rounding radius that the engine adds to hulls (Bullet's margin), as a share of the scene's size.
extern const double hull_margin;
/// How many bodies a pile may have, so that the engine's solver ends within minutes.
extern const int most_bodies;
/// Whether the engine's own narrow phase knows capsules.
extern const bool has_capsules;
/// The engine's name, and one with a scene, its own narrow phase or ours.
extern const char *const engine_name;
engine *create_engine(const scene &from, bool ours);

/// The names of all scenes, and one of them; small: few bodies and little time, for tests.
std::vector<std::string> list_scenes();
scene make_scene(const std::string &name, bool small);

/// The shape of a part, with the engine's margin.
ovoid::shape make_shape(const part &from, double margin);

} // namespace scenes

#endif
