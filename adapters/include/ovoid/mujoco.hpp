/**
 * @file mujoco.hpp
 * MuJoCo's collisions of convex and mesh geoms by ovoid (MuJoCo 2.2): manifolds whose depth is proven. Header only. A
 * program makes one object for each model, after it is compiled and before the first step:
 *
 *     ovoid::mujoco::adapter adapter(model);
 *
 * The adapter enters ovoid's function into mjCOLLISIONFUNC for pairs of sphere, capsule, cylinder, box and mesh, but
 * for those that MuJoCo answers in closed form: sphere with sphere, capsule or cylinder, capsule with capsule.
 * Ellipsoids, height fields and planes stay with MuJoCo. The table is the process's: models without an adapter are
 * answered by what was in it before. The adapter must be destroyed before its model is deleted or compiled anew, and no
 * thread may step a model while an adapter is made or destroyed.
 *
 * A mesh is the convex hull of its vertices, as for MuJoCo. All geoms are translated when the adapter is made; then
 * nothing throws. If a geom is refused, for example a mesh of NaN, the constructor throws ovoid::error.
 *
 * Threads: any number, each with its own mjData, as MuJoCo wants it.
 */
#ifndef OVOID_MUJOCO_HPP
#define OVOID_MUJOCO_HPP

#include "ovoid/adapter.hpp"

#include <mujoco/mujoco.h>

#include <array>
#include <map>

namespace ovoid {
namespace mujoco {

/** Settings of an adapter. */
struct settings : adapters::contact_settings {
    /**
     * The contact of a pair in an mjData begins with that of its last step: faster, and the same points in a body at
     * rest. false: contacts depend on nothing but the positions.
     */
    bool remember = true;
};

namespace detail {

/// A pair's contact, and when it was last wanted.
struct memory {
    ovoid_manifold contact;
    mjtNum time;
};

/// The contacts that an mjData remembers; geoms by number. Those of other times than the present go when they are many.
class memories {
  public:
    ovoid_manifold &find(int a, int b, mjtNum time) {
        if (contacts_.size() >= limit_) drop_old(time);
        memory &found = contacts_[std::uint64_t(std::uint32_t(a)) << 32 | std::uint32_t(b)];
        found.time = time;
        return found.contact;
    }

  private:
    void drop_old(mjtNum time) {
        for (auto i = contacts_.begin(); i != contacts_.end();)
            i = i->second.time == time ? std::next(i) : contacts_.erase(i);
        limit_ = std::max<std::size_t>(1024, 4 * contacts_.size());
    }
    std::unordered_map<std::uint64_t, memory> contacts_;
    std::size_t limit_ = 1024;
};

/// A model's geoms as shapes, and the memories of its data.
class translated_model {
  public:
    translated_model(const mjModel &m, const settings &chosen) : chosen_(chosen) {
        geoms_.resize(std::size_t(m.ngeom));
        for (int g = 0; g < m.ngeom; g++) geoms_[std::size_t(g)] = translate(m, g);
    }

    /// The points of a pair of geoms for MuJoCo; -1: a geom is not translated.
    int collide(const mjData &d, mjContact *to, std::pair<int, int> geoms, mjtNum margin) {
        const adapters::shared_shape &a = geoms_[std::size_t(geoms.first)], &b = geoms_[std::size_t(geoms.second)];
        if (!a || !b) return -1;
        const adapters::contact_query query = {a.get(), b.get(), place(d, geoms.first), place(d, geoms.second),
                                               std::max<mjtNum>(margin, 0)};
        if (query.is_far()) return 0;
        ovoid_manifold alone = {};
        ovoid_manifold &kept = chosen_.remember ? find_memories(d).find(geoms.first, geoms.second, d.time) : alone;
        const ovoid_manifold_points points = adapters::find_contact(query, chosen_, kept);
        if (adapters::is_refused(kept)) refused_++;
        int count = 0;
        for (std::uint32_t i = 0; i < points.count; i++)
            if (points.points[i].separation <= margin) write(points.points[i], kept.normal, to[count++]);
        return count;
    }
    void forget(const mjData &d) {
        const std::lock_guard<std::mutex> lock(mutex_);
        memories_.erase(&d);
    }
    std::size_t refused_count() const noexcept { return refused_; }
    std::size_t shape_count() const { return table_.size(); }
    const shape *find_shape(int geom) const {
        if (geom < 0 || std::size_t(geom) >= geoms_.size() || !geoms_[std::size_t(geom)]) return nullptr;
        return &geoms_[std::size_t(geom)]->made;
    }

  private:
    static ovoid_pose place(const mjData &d, int g) {
        const mjtNum *at = d.geom_xpos + 3 * g;
        mjtNum q[4];
        mju_mat2Quat(q, d.geom_xmat + 9 * g);
        return {{at[0], at[1], at[2]}, {q[0], q[1], q[2], q[3]}};
    }
    static void write(const ovoid_manifold_point &from, const ovoid_vec3 &normal, mjContact &to) {
        to.dist = from.separation;
        to.pos[0] = 0.5 * (from.point_a.x + from.point_b.x);
        to.pos[1] = 0.5 * (from.point_a.y + from.point_b.y);
        to.pos[2] = 0.5 * (from.point_a.z + from.point_b.z);
        // From the first geom to the second. MuJoCo makes the other two axes.
        to.frame[0] = normal.x;
        to.frame[1] = normal.y;
        to.frame[2] = normal.z;
        mju_zero(to.frame + 3, 6);
    }
    adapters::shared_shape translate(const mjModel &m, int g) {
        const mjtNum *size = m.geom_size + 3 * g;
        const int type = m.geom_type[g];
        adapters::description of = {double(type), size[0], size[1], size[2]};
        switch (type) {
        case mjGEOM_SPHERE: return table_.find(of, [&] { return shape::sphere(size[0]); });
        case mjGEOM_CAPSULE: return table_.find(of, [&] { return shape::capsule(size[0], size[1]); });
        case mjGEOM_CYLINDER: return table_.find(of, [&] { return shape::cylinder(size[0], size[1]); });
        case mjGEOM_BOX: return table_.find(of, [&] { return shape::box(vec3(size[0], size[1], size[2])); });
        case mjGEOM_MESH: break;
        default: return nullptr;
        }
        const int mesh = m.geom_dataid[g];
        const float *xyz = m.mesh_vert + 3 * m.mesh_vertadr[mesh];
        of.resize(1);
        of.insert(of.end(), xyz, xyz + 3 * m.mesh_vertnum[mesh]);
        return table_.find(of, [&] { return shape::from_points(span<const double>(of.data() + 1, of.size() - 1)); });
    }
    /// The memories of a data. The lock is held while they are looked up; then they are the thread's that has the data.
    memories &find_memories(const mjData &d) {
        const std::lock_guard<std::mutex> lock(mutex_);
        return memories_[&d];
    }

    settings chosen_;
    adapters::shape_table table_;
    std::vector<adapters::shared_shape> geoms_;
    std::mutex mutex_;
    std::map<const mjData *, memories> memories_;
    std::atomic<std::size_t> refused_{0};
};

using table_of_functions = std::array<std::array<mjfCollision, mjNGEOMTYPES>, mjNGEOMTYPES>;

/// The models that have an adapter, and what stood in MuJoCo's table. Changed by no thread while another steps.
struct registry {
    std::map<const mjModel *, translated_model *> models;
    table_of_functions before = {};
};

inline registry &get_registry() {
    static registry one;
    return one;
}

/// Whether ovoid answers geoms of these types, the first not above the second.
inline bool is_answered(int a, int b) {
    const auto is_known = [](int type) {
        return type == mjGEOM_SPHERE || type == mjGEOM_CAPSULE || type == mjGEOM_CYLINDER || type == mjGEOM_BOX ||
               type == mjGEOM_MESH;
    };
    if (!is_known(a) || !is_known(b)) return false;
    const bool in_closed_form = b <= mjGEOM_CAPSULE || (a == mjGEOM_SPHERE && b == mjGEOM_CYLINDER);
    return !in_closed_form;
}

/// What stands in mjCOLLISIONFUNC: an mjfCollision, whose six parameters are MuJoCo's.
inline int collide(const mjModel *m, const mjData *d, mjContact *to, int a, int b, mjtNum margin) {
    const registry &all = get_registry();
    const auto found = all.models.find(m);
    const int count = found == all.models.end() ? -1 : found->second->collide(*d, to, {a, b}, margin);
    if (count >= 0) return count;
    const mjfCollision own = all.before[std::size_t(m->geom_type[a])][std::size_t(m->geom_type[b])];
    return own ? own(m, d, to, a, b, margin) : 0;
}

} // namespace detail

/** Answers the collisions of a model, while it lives. */
class adapter {
  public:
    /** Translates the geoms of the model. Throws ovoid::error (ARGUMENT: the model has an adapter). */
    explicit adapter(const mjModel *model, const settings &chosen = settings()) : model_(model), own_(*model, chosen) {
        detail::registry &all = detail::get_registry();
        if (!all.models.emplace(model, &own_).second)
            ovoid::detail::fail(OVOID_ERROR_ARGUMENT, "the model has an adapter already");
        if (all.models.size() == 1) enter(all);
    }
    /** The model is answered by what was in the table before; with the last adapter the table is restored. */
    ~adapter() {
        detail::registry &all = detail::get_registry();
        all.models.erase(model_);
        if (all.models.empty()) leave(all);
    }
    adapter(const adapter &) = delete;
    adapter &operator=(const adapter &) = delete;

    /** Drops what is remembered of a data: call it before mj_deleteData, else its contacts stay until the adapter goes.
     */
    void forget(const mjData *data) { own_.forget(*data); }
    /** Number of queries that were refused, because a geom's position was not finite. They have no contact. */
    std::size_t refused_count() const noexcept { return own_.refused_count(); }
    /** Number of different shapes. */
    std::size_t shape_count() const { return own_.shape_count(); }
    /** The shape of a geom in its frame; nullptr if the geom stays with MuJoCo. */
    const shape *find_shape(int geom) const { return own_.find_shape(geom); }

  private:
    static void enter(detail::registry &all) {
        for (int a = 0; a < mjNGEOMTYPES; a++)
            for (int b = a; b < mjNGEOMTYPES; b++) {
                all.before[std::size_t(a)][std::size_t(b)] = mjCOLLISIONFUNC[a][b];
                if (detail::is_answered(a, b)) mjCOLLISIONFUNC[a][b] = detail::collide;
            }
    }
    static void leave(detail::registry &all) {
        for (int a = 0; a < mjNGEOMTYPES; a++)
            for (int b = a; b < mjNGEOMTYPES; b++)
                if (detail::is_answered(a, b)) mjCOLLISIONFUNC[a][b] = all.before[std::size_t(a)][std::size_t(b)];
    }
    const mjModel *model_;
    detail::translated_model own_;
};

} // namespace mujoco
} // namespace ovoid

#endif
