/**
 * @file bullet.hpp
 * Bullet's narrow phase by ovoid (Bullet 2.84 and later): manifolds whose depth is proven, for convex shapes, compounds
 * of them and triangle meshes. Header only, for Bullet in single or double precision. One line is added to a program,
 * after its dispatcher and before its first step:
 *
 *     ovoid::bullet::adapter adapter(dispatcher);
 *
 * The adapter must live as long as the dispatcher has pairs: declare it before the dispatcher, or destroy the world
 * first. ovoid::bullet::depth_solver is for those who want the depth alone, in Bullet's own convex algorithm.
 *
 * Shapes are translated when a pair of them first meets, and kept. A convex hull is the hull of its points, rounded by
 * its collision margin, which Bullet adds outside; so are a cone, a triangle, a tetrahedron and a mesh's triangles. A
 * box and a cylinder have sharp edges and the size that they were made with (Bullet's search rounds them by the
 * margin). btMultiSphereShape is translated if its radii are equal. What is not translated (multi-spheres of several
 * radii, 2D shapes, Minkowski sums, planes, soft bodies, GImpact) stays with Bullet's own algorithms. If a shape is
 * refused, for example a hull of NaN, ovoid::error is thrown from the step in which it first meets another.
 *
 * A triangle mesh becomes a solid when a convex shape first meets it, about 200 bytes a triangle, which all pairs
 * share; where its triangles have changed below a shape it is made anew. Triangles in one plane are one facet, with a
 * manifold of its own, so edges inside of a flat region have no contact. A closed mesh has an inside, and its outside
 * is up to the orientation of its triangles; of one that is not closed both sides are outside. A terrain is answered
 * triangle by triangle.
 *
 * Threads: as Bullet's dispatchers; btCollisionDispatcherMt may run pairs at the same time.
 */
#ifndef OVOID_BULLET_HPP
#define OVOID_BULLET_HPP

#include "ovoid/bullet_shapes.hpp"

#include <BulletCollision/NarrowPhaseCollision/btConvexPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include <array>
#include <map>
#include <utility>

namespace ovoid {
namespace bullet {

/** Settings of an adapter. */
struct settings : adapters::contact_settings {
    /**
     * Points are given while they are apart by at most this share of Bullet's contact breaking threshold, as its convex
     * algorithm does. 0: only where bodies touch, as its algorithm for boxes does: the solver has fewer points to work
     * on, and bodies come to rest less quietly.
     */
    double margin = 1;
};

namespace detail {

/// What the adapter's algorithms share.
struct workshop {
    adapters::shape_table table;
    solid_table solids;
    settings chosen;
    std::atomic<std::size_t> refused{0};
};

/// Points of a manifold that are out of the way while another is added: Bullet takes a new point that is near an old
/// one for the same, and ids know better.
class aside {
  public:
    aside(btPersistentManifold &manifold, int stays) : manifold_(&manifold), stays_(stays) {
        for (int i = 0; i < manifold.getNumContacts(); i++) {
            kept_[std::size_t(i)] = manifold.getContactPoint(i).m_localPointA;
            if (i != stays) manifold.getContactPoint(i).m_localPointA.setValue(away, away, away);
        }
        count_ = manifold.getNumContacts();
    }
    ~aside() {
        for (int i = 0; i < count_; i++)
            if (i != stays_) manifold_->getContactPoint(i).m_localPointA = kept_[std::size_t(i)];
    }
    aside(const aside &) = delete;
    aside &operator=(const aside &) = delete;

  private:
    static constexpr btScalar away = btScalar(1e15);
    btPersistentManifold *manifold_;
    int stays_, count_ = 0;
    std::array<btVector3, MANIFOLD_CACHE_SIZE> kept_;
};

/// The points of one of Bullet's manifolds, with the ids of ovoid's: kept from step to step.
class kept_points {
  public:
    /// The manifold's points become these: those with the id of an old one keep its impulses.
    void replace(const ovoid_manifold_points &points, const ovoid_vec3 &normal, btManifoldResult &to) {
        btPersistentManifold &manifold = *to.getPersistentManifold();
        if (manifold.getNumContacts() != count_) count_ = 0; // someone else changed it: no point keeps anything
        for (int i = manifold.getNumContacts() - 1; i >= 0; i--)
            if (i >= count_ || !has(points, ids_[std::size_t(i)])) remove(manifold, i);
        for (std::uint32_t i = 0; i < points.count; i++) {
            const ovoid_manifold_point &p = points.points[i];
            const int old = find(p.id);
            const aside others(manifold, old);
            if (old >= 0) {
                btManifoldPoint &same = manifold.getContactPoint(old);
                same.m_localPointA = find_local(p, manifold, to);
                same.m_lifeTime++;
            }
            add(p, normal, to);
            if (old < 0 && manifold.getNumContacts() > count_) ids_[std::size_t(count_++)] = p.id;
        }
    }
    static void add(const ovoid_manifold_point &p, const ovoid_vec3 &normal, btManifoldResult &to) {
        // Bullet's normal is that of B, towards A.
        to.addContactPoint(-to_bullet(normal), to_bullet(p.point_b), btScalar(p.separation));
    }

  private:
    static bool has(const ovoid_manifold_points &points, std::uint32_t id) {
        for (std::uint32_t i = 0; i < points.count; i++)
            if (points.points[i].id == id) return true;
        return false;
    }
    int find(std::uint32_t id) const {
        for (int i = 0; i < count_; i++)
            if (ids_[std::size_t(i)] == id) return i;
        return -1;
    }
    void remove(btPersistentManifold &manifold, int i) {
        manifold.removeContactPoint(i);
        if (i < count_) ids_[std::size_t(i)] = ids_[std::size_t(--count_)];
    }
    /// Where Bullet will have the point in the frame of the manifold's first body.
    static btVector3 find_local(const ovoid_manifold_point &p, const btPersistentManifold &manifold,
                                const btManifoldResult &of) {
        const bool swapped = manifold.getBody0() != of.getBody0Internal();
        return manifold.getBody0()->getWorldTransform().invXform(to_bullet(swapped ? p.point_b : p.point_a));
    }

    std::array<std::uint32_t, MANIFOLD_CACHE_SIZE> ids_ = {};
    int count_ = 0;
};

/// The contact of two convex shapes: kept from step to step.
class kept_contact {
  public:
    kept_contact(workshop &from, translation a, translation b) : a_(std::move(a)), b_(std::move(b)), workshop_(&from) {}

    /// Finds the contact at these transforms and gives its points to Bullet. own: the manifold holds this contact
    /// alone.
    void process(const btTransform &a, const btTransform &b, btManifoldResult &to, bool own) {
        btPersistentManifold &manifold = *to.getPersistentManifold();
        const double kept = workshop_->chosen.margin * double(manifold.getContactBreakingThreshold());
        const double margin = std::max(kept, double(to.m_closestPointDistanceThreshold));
        const adapters::contact_query query = {a_.made.get(), b_.made.get(), a_.place(a), b_.place(b), margin};
        const ovoid_manifold_points points = adapters::find_contact(query, workshop_->chosen, contact_);
        if (adapters::is_refused(contact_)) workshop_->refused++;
        if (own)
            kept_.replace(points, contact_.normal, to);
        else
            for (std::uint32_t i = 0; i < points.count; i++) kept_points::add(points.points[i], contact_.normal, to);
    }

  private:
    translation a_, b_;
    ovoid_manifold contact_ = {};
    kept_points kept_;
    workshop *workshop_;
};

/// Base of both algorithms. Bullet gives each a block of its own pool, so what it holds lies behind one pointer.
class algorithm : public btCollisionAlgorithm {
  public:
    explicit algorithm(const btCollisionAlgorithmConstructionInfo &info) : btCollisionAlgorithm(info) {}
    // Bullet's worlds sweep convex shapes for continuous motion; algorithms are not asked.
    btScalar calculateTimeOfImpact(btCollisionObject *, btCollisionObject *, const btDispatcherInfo &,
                                   btManifoldResult *) override {
        return 1;
    }
};

/// Two convex shapes.
class convex_algorithm final : public algorithm {
  public:
    convex_algorithm(const btCollisionAlgorithmConstructionInfo &info, std::unique_ptr<kept_contact> contact)
        : algorithm(info), contact_(std::move(contact)), manifold_(info.m_manifold), own_(!info.m_manifold) {}
    ~convex_algorithm() override {
        if (own_ && manifold_) m_dispatcher->releaseManifold(manifold_);
    }
    void processCollision(const btCollisionObjectWrapper *a, const btCollisionObjectWrapper *b,
                          const btDispatcherInfo &, btManifoldResult *to) override {
        if (!manifold_) manifold_ = m_dispatcher->getNewManifold(a->getCollisionObject(), b->getCollisionObject());
        to->setPersistentManifold(manifold_);
        contact_->process(a->getWorldTransform(), b->getWorldTransform(), *to, own_);
    }
    void getAllContactManifolds(btManifoldArray &to) override {
        if (own_ && manifold_) to.push_back(manifold_);
    }

  private:
    std::unique_ptr<kept_contact> contact_;
    btPersistentManifold *manifold_;
    bool own_;
};

/// A triangle of a mesh, and the convex shape's contact with it.
struct kept_triangle {
    std::array<btVector3, 3> corners;
    kept_contact contact;
    btPersistentManifold *manifold;
    std::uint64_t seen;
};

/// A convex shape and a terrain, triangle by triangle, each with a manifold of its own.
class mesh_state {
  public:
    mesh_state(workshop &from, btDispatcher &dispatcher, bool mesh_first)
        : workshop_(&from), dispatcher_(&dispatcher), mesh_first_(mesh_first) {}
    ~mesh_state() {
        for (auto &[key, triangle] : triangles_) dispatcher_->releaseManifold(triangle.manifold);
    }
    mesh_state(const mesh_state &) = delete;
    mesh_state &operator=(const mesh_state &) = delete;

    void process(const btCollisionObjectWrapper *a, const btCollisionObjectWrapper *b, btManifoldResult &to);
    void add_manifolds(btManifoldArray &to) const {
        for (const auto &[key, triangle] : triangles_) to.push_back(triangle.manifold);
    }

  private:
    friend class triangle_visitor;
    struct step {
        const btCollisionObjectWrapper *convex, *mesh;
        btManifoldResult *to;
        btVector3 low, high;
    };
    void visit(const step &of, const btVector3 *corners, std::pair<int, int> key);
    kept_triangle *find(const step &of, const btTriangleShape &triangle, std::pair<int, int> key);

    workshop *workshop_;
    btDispatcher *dispatcher_;
    bool mesh_first_;
    std::map<std::pair<int, int>, kept_triangle> triangles_;
    std::uint64_t steps_ = 0;
};

class triangle_visitor : public btTriangleCallback {
  public:
    triangle_visitor(mesh_state &to, const mesh_state::step &of) : to_(&to), of_(&of) {}
    void processTriangle(btVector3 *corners, int part, int index) override { to_->visit(*of_, corners, {part, index}); }

  private:
    mesh_state *to_;
    const mesh_state::step *of_;
};

inline void mesh_state::process(const btCollisionObjectWrapper *a, const btCollisionObjectWrapper *b,
                                btManifoldResult &to) {
    step now = {mesh_first_ ? b : a, mesh_first_ ? a : b, &to, {}, {}};
    const auto *mesh = static_cast<const btConcaveShape *>(now.mesh->getCollisionShape());
    const btTransform in_mesh = now.mesh->getWorldTransform().inverse() * now.convex->getWorldTransform();
    now.convex->getCollisionShape()->getAabb(in_mesh, now.low, now.high);
    const btScalar more = mesh->getMargin() + to.m_closestPointDistanceThreshold + gContactBreakingThreshold;
    now.low -= btVector3(more, more, more);
    now.high += btVector3(more, more, more);
    steps_++;
    triangle_visitor visitor(*this, now);
    mesh->processAllTriangles(&visitor, now.low, now.high);
    for (auto i = triangles_.begin(); i != triangles_.end();) {
        if (i->second.seen == steps_) {
            ++i;
            continue;
        }
        dispatcher_->releaseManifold(i->second.manifold);
        i = triangles_.erase(i);
    }
}

inline void mesh_state::visit(const step &of, const btVector3 *corners, std::pair<int, int> key) {
    if (!TestTriangleAgainstAabb2(corners, of.low, of.high)) return;
    btTriangleShape triangle(corners[0], corners[1], corners[2]);
    triangle.setMargin(static_cast<const btConcaveShape *>(of.mesh->getCollisionShape())->getMargin());
    kept_triangle *kept = find(of, triangle, key);
    if (!kept) return;
    kept->seen = steps_;
    // Callbacks of users see the triangle, as in Bullet's own algorithm.
    const btCollisionObjectWrapper shown(of.mesh, &triangle, of.mesh->getCollisionObject(),
                                         of.mesh->getWorldTransform(), key.first, key.second);
    of.to->setPersistentManifold(kept->manifold);
    const btTransform &convex = of.convex->getWorldTransform(), &mesh = of.mesh->getWorldTransform();
    if (mesh_first_) {
        of.to->setBody0Wrap(&shown);
        of.to->setShapeIdentifiersA(key.first, key.second);
        kept->contact.process(mesh, convex, *of.to, true);
        of.to->setBody0Wrap(of.mesh);
    } else {
        of.to->setBody1Wrap(&shown);
        of.to->setShapeIdentifiersB(key.first, key.second);
        kept->contact.process(convex, mesh, *of.to, true);
        of.to->setBody1Wrap(of.mesh);
    }
}

inline kept_triangle *mesh_state::find(const step &of, const btTriangleShape &triangle, std::pair<int, int> key) {
    const std::array<btVector3, 3> corners = {triangle.m_vertices1[0], triangle.m_vertices1[1],
                                              triangle.m_vertices1[2]};
    const auto found = triangles_.find(key);
    if (found != triangles_.end()) {
        if (found->second.corners == corners) return &found->second;
        // The mesh has changed below its index.
        dispatcher_->releaseManifold(found->second.manifold);
        triangles_.erase(found);
    }
    const auto &shape = static_cast<const btConvexShape &>(*of.convex->getCollisionShape());
    translation convex = translate(workshop_->table, shape), flat = translate(workshop_->table, triangle);
    if (mesh_first_) std::swap(convex, flat);
    const btCollisionObject *a = (mesh_first_ ? of.mesh : of.convex)->getCollisionObject();
    const btCollisionObject *b = (mesh_first_ ? of.convex : of.mesh)->getCollisionObject();
    kept_triangle made = {corners, kept_contact(*workshop_, std::move(convex), std::move(flat)),
                          dispatcher_->getNewManifold(a, b), steps_};
    return &triangles_.emplace(key, std::move(made)).first->second;
}

/// A convex shape and a mesh, facet by facet, each with a manifold of its own: triangles in one plane are one facet, so
/// a body that slides over them meets no edge.
class solid_state {
  public:
    solid_state(workshop &from, btDispatcher &dispatcher, bool mesh_first)
        : workshop_(&from), dispatcher_(&dispatcher), mesh_first_(mesh_first) {}
    ~solid_state() { clear(); }
    solid_state(const solid_state &) = delete;
    solid_state &operator=(const solid_state &) = delete;

    void process(const btCollisionObjectWrapper *a, const btCollisionObjectWrapper *b, btManifoldResult &to);
    void add_manifolds(btManifoldArray &to) const {
        for (const auto &[name, facet] : facets_) to.push_back(facet.manifold);
    }

  private:
    struct kept_facet {
        kept_points points;
        btPersistentManifold *manifold;
        std::uint64_t seen;
    };
    struct step {
        const btCollisionObjectWrapper *convex, *mesh;
        btManifoldResult *to;
        double margin, rounding; ///< the mesh's own margin, which Bullet adds outside
    };
    void clear() {
        for (auto &[name, facet] : facets_) dispatcher_->releaseManifold(facet.manifold);
        facets_.clear();
        found_.clear();
    }
    void find(const step &of);
    void give(const step &of, const ovoid_body_manifold &one, ovoid_manifold_points points);

    workshop *workshop_;
    btDispatcher *dispatcher_;
    bool mesh_first_;
    translation convex_;
    std::shared_ptr<const mesh_solid> solid_;
    std::vector<ovoid_body_manifold> found_; ///< of the last step
    std::map<std::uint32_t, kept_facet> facets_;
    std::uint64_t steps_ = 0;
};

inline void solid_state::process(const btCollisionObjectWrapper *a, const btCollisionObjectWrapper *b,
                                 btManifoldResult &to) {
    step now = {mesh_first_ ? b : a, mesh_first_ ? a : b, &to, 0, 0};
    const auto &mesh = static_cast<const btConcaveShape &>(*now.mesh->getCollisionShape());
    const auto &convex = static_cast<const btConvexShape &>(*now.convex->getCollisionShape());
    const btScalar breaking = btMin(mesh.getContactBreakingThreshold(gContactBreakingThreshold),
                                    convex.getContactBreakingThreshold(gContactBreakingThreshold));
    now.rounding = double(mesh.getMargin());
    now.margin = std::max(workshop_->chosen.margin * double(breaking), double(to.m_closestPointDistanceThreshold));
    if (!convex_.made) convex_ = translate(workshop_->table, convex);
    // Bullet's tree has the triangles near the shape. If one of them is not as it was, the solid is made anew.
    btVector3 low, high;
    convex.getAabb(now.mesh->getWorldTransform().inverse() * now.convex->getWorldTransform(), low, high);
    const btScalar more = btScalar(now.margin + now.rounding);
    low -= btVector3(more, more, more);
    high += btVector3(more, more, more);
    triangle_check check(solid_.get());
    mesh.processAllTriangles(&check, low, high);
    // The table may have an old one too, even that of another mesh at the same address.
    for (int tries = 0; tries < 2 && check.count > 0 && check.has_changed; tries++) {
        clear();
        solid_ = workshop_->solids.find(mesh, solid_);
        check = triangle_check(solid_.get());
        mesh.processAllTriangles(&check, low, high);
    }
    steps_++;
    if (check.count > 0) find(now);
    for (auto i = facets_.begin(); i != facets_.end();) {
        if (i->second.seen == steps_) {
            ++i;
            continue;
        }
        dispatcher_->releaseManifold(i->second.manifold);
        i = facets_.erase(i);
    }
}

inline void solid_state::find(const step &of) {
    const ovoid_body_pair pair = {
        {convex_.made->made.get(), nullptr, convex_.place(of.convex->getWorldTransform()), nullptr},
        {nullptr, nullptr, from_bullet(of.mesh->getWorldTransform()), solid_->made.get()}};
    const double size = convex_.made->radius;
    ovoid_manifold_options options = {};
    options.margin = of.margin + of.rounding;
    options.tolerance = workshop_->chosen.tolerance * size;
    options.keep = workshop_->chosen.keep * size;
    std::vector<ovoid_body_manifold> items(found_.size() + 4);
    std::vector<ovoid_manifold_points> points;
    ovoid_body_manifolds room = {};
    room.earlier = found_.data();
    room.earlier_count = found_.size();
    do {
        items.resize(std::max(room.count, items.size()));
        points.resize(items.size());
        room.items = items.data();
        room.points = points.data();
        room.capacity = items.size();
        if (ovoid_body_manifolds_find(&pair, &options, &room) != OVOID_LIMIT_NONE) workshop_->refused++;
    } while (room.count > room.capacity);
    for (std::size_t i = 0; i < room.count; i++) give(of, items[i], points[i]);
    items.resize(room.count);
    found_.swap(items);
}

inline void solid_state::give(const step &of, const ovoid_body_manifold &one, ovoid_manifold_points points) {
    const ovoid_vec3 n = one.manifold.normal;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < points.count; i++) {
        ovoid_manifold_point p = points.points[i];
        const double r = of.rounding;
        p.separation -= r;
        p.point_b = {p.point_b.x - r * n.x, p.point_b.y - r * n.y, p.point_b.z - r * n.z};
        if (p.separation <= of.margin) points.points[count++] = p;
    }
    points.count = count;
    if (!count) return;
    const btCollisionObject *a = (mesh_first_ ? of.mesh : of.convex)->getCollisionObject();
    const btCollisionObject *b = (mesh_first_ ? of.convex : of.mesh)->getCollisionObject();
    auto found = facets_.find(one.part_b);
    if (found == facets_.end())
        found = facets_.emplace(one.part_b, kept_facet{{}, dispatcher_->getNewManifold(a, b), 0}).first;
    found->second.seen = steps_;
    // Callbacks of users see a triangle of the facet, as in Bullet's own algorithm.
    const mesh_triangle &shown_triangle = solid_->triangles[one.part_b];
    btTriangleShape triangle(shown_triangle.corners[0], shown_triangle.corners[1], shown_triangle.corners[2]);
    const btCollisionObjectWrapper shown(of.mesh, &triangle, of.mesh->getCollisionObject(),
                                         of.mesh->getWorldTransform(), shown_triangle.part, shown_triangle.index);
    of.to->setPersistentManifold(found->second.manifold);
    if (mesh_first_) {
        of.to->setBody0Wrap(&shown);
        of.to->setShapeIdentifiersA(shown_triangle.part, shown_triangle.index);
        for (std::uint32_t i = 0; i < count; i++) std::swap(points.points[i].point_a, points.points[i].point_b);
        found->second.points.replace(points, {-n.x, -n.y, -n.z}, *of.to);
        of.to->setBody0Wrap(of.mesh);
    } else {
        of.to->setBody1Wrap(&shown);
        of.to->setShapeIdentifiersB(shown_triangle.part, shown_triangle.index);
        found->second.points.replace(points, n, *of.to);
        of.to->setBody1Wrap(of.mesh);
    }
}

/// A convex shape and a mesh (State: solid_state), or a terrain (mesh_state).
template <class State> class mesh_algorithm final : public algorithm {
  public:
    mesh_algorithm(const btCollisionAlgorithmConstructionInfo &info, std::unique_ptr<State> state)
        : algorithm(info), state_(std::move(state)) {}
    void processCollision(const btCollisionObjectWrapper *a, const btCollisionObjectWrapper *b,
                          const btDispatcherInfo &, btManifoldResult *to) override {
        state_->process(a, b, *to);
    }
    void getAllContactManifolds(btManifoldArray &to) override { state_->add_manifolds(to); }

  private:
    std::unique_ptr<State> state_;
};

/// Which of Bullet's two tables of algorithms.
enum class table { contacts, closest };

/// Creates the algorithm of a pair; Bullet's own where a shape is not translated.
class creator final : public btCollisionAlgorithmCreateFunc {
  public:
    creator(workshop &from, btCollisionConfiguration &own, table of) : workshop_(&from), own_(&own), table_(of) {}
    btCollisionAlgorithm *CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo &info,
                                                   const btCollisionObjectWrapper *a,
                                                   const btCollisionObjectWrapper *b) override {
        const btCollisionShape &x = *a->getCollisionShape(), &y = *b->getCollisionShape();
        if (x.isConcave() || y.isConcave()) {
            const auto &convex = static_cast<const btConvexShape &>(x.isConcave() ? y : x);
            if (!translate(workshop_->table, convex).made) return create_own(info, a, b);
            const bool is_terrain = (x.isConcave() ? x : y).getShapeType() == TERRAIN_SHAPE_PROXYTYPE;
            return is_terrain ? create_mesh<mesh_state>(info, x.isConcave())
                              : create_mesh<solid_state>(info, x.isConcave());
        }
        translation first = translate(workshop_->table, static_cast<const btConvexShape &>(x));
        translation second = translate(workshop_->table, static_cast<const btConvexShape &>(y));
        if (!first.made || !second.made) return create_own(info, a, b);
        auto contact = std::make_unique<kept_contact>(*workshop_, std::move(first), std::move(second));
        return new (allocate(info, sizeof(convex_algorithm))) convex_algorithm(info, std::move(contact));
    }

  private:
    static void *allocate(const btCollisionAlgorithmConstructionInfo &info, std::size_t size) {
        return info.m_dispatcher1->allocateCollisionAlgorithm(int(size));
    }
    template <class State>
    btCollisionAlgorithm *create_mesh(const btCollisionAlgorithmConstructionInfo &info, bool mesh_first) {
        auto state = std::make_unique<State>(*workshop_, *info.m_dispatcher1, mesh_first);
        return new (allocate(info, sizeof(mesh_algorithm<State>))) mesh_algorithm<State>(info, std::move(state));
    }
    btCollisionAlgorithm *create_own(btCollisionAlgorithmConstructionInfo &info, const btCollisionObjectWrapper *a,
                                     const btCollisionObjectWrapper *b) {
        const int x = a->getCollisionShape()->getShapeType(), y = b->getCollisionShape()->getShapeType();
        btCollisionAlgorithmCreateFunc *own = table_ == table::contacts
                                                  ? own_->getCollisionAlgorithmCreateFunc(x, y)
                                                  : own_->getClosestPointsAlgorithmCreateFunc(x, y);
        return own->CreateCollisionAlgorithm(info, a, b);
    }

    workshop *workshop_;
    btCollisionConfiguration *own_;
    table table_;
};

} // namespace detail

/** Registers ovoid's algorithms with a dispatcher. It must live as long as the dispatcher has pairs. */
class adapter {
  public:
    /**
     * Replaces the dispatcher's algorithms for convex shapes with one another (in compounds too), and with triangle
     * meshes and terrains. Pairs that the dispatcher has already keep theirs.
     */
    explicit adapter(btCollisionDispatcher &dispatcher, const settings &chosen = settings())
        : contacts_(workshop_, *dispatcher.getCollisionConfiguration(), detail::table::contacts),
          closest_(workshop_, *dispatcher.getCollisionConfiguration(), detail::table::closest) {
        workshop_.chosen = chosen;
        for (int a = 0; a < CONCAVE_SHAPES_START_HERE; a++) {
            for (int b = 0; b < CONCAVE_SHAPES_START_HERE; b++) enter(dispatcher, a, b);
            for (const int mesh : {TRIANGLE_MESH_SHAPE_PROXYTYPE, SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE,
                                   TERRAIN_SHAPE_PROXYTYPE, MULTIMATERIAL_TRIANGLE_MESH_PROXYTYPE}) {
                enter(dispatcher, a, mesh);
                enter(dispatcher, mesh, a);
            }
        }
    }
    adapter(const adapter &) = delete;
    adapter &operator=(const adapter &) = delete;

    /** The translation of a shape; its `made` is nullptr if the shape stays with Bullet. Throws ovoid::error. */
    translation translate(const btConvexShape &of) { return detail::translate(workshop_.table, of); }
    /** Number of shapes that are kept. */
    std::size_t shape_count() const { return workshop_.table.size(); }
    /** Destroys the shapes that no pair uses now. */
    void drop_unused() {
        workshop_.table.drop_unused();
        workshop_.solids.drop_unused();
    }
    /** Number of queries that were refused, because a body's transform was not finite. They have no contact. */
    std::size_t refused_count() const noexcept { return workshop_.refused; }

  private:
    void enter(btCollisionDispatcher &dispatcher, int a, int b) {
        dispatcher.registerCollisionCreateFunc(a, b, &contacts_);
        dispatcher.registerClosestPointsCreateFunc(a, b, &closest_);
    }
    detail::workshop workshop_;
    detail::creator contacts_, closest_;
};

/**
 * The depth of two overlapping convex shapes for Bullet's own convex algorithm, which asks it where its search without
 * margins fails: btConvexConvexAlgorithm::CreateFunc create(&solver), entered with registerCollisionCreateFunc. With an
 * adapter it is not needed. It throws ovoid::error if a shape is refused.
 */
class depth_solver : public btConvexPenetrationDepthSolver {
  public:
    // Eight parameters, as Bullet has it.
    bool calcPenDepth(btSimplexSolverInterface &, const btConvexShape *a, const btConvexShape *b,
                      const btTransform &at_a, const btTransform &at_b, btVector3 &axis, btVector3 &point_a,
                      btVector3 &point_b, btIDebugDraw *debug) override {
        const translation x = detail::translate(table_, *a), y = detail::translate(table_, *b);
        if (!x.made || !y.made) return ask_bullet({a, b, at_a, at_b, debug}, axis, point_a, point_b);
        const ovoid_pair pair = {x.made->made.get(), y.made->made.get(), x.place(at_a), y.place(at_b)};
        const ovoid_answer answer = ovoid_depth(&pair, nullptr, nullptr, nullptr);
        const ovoid_vec3 &n = answer.normal;
        axis = -detail::to_bullet(n);
        point_a = detail::to_bullet(answer.point_a);
        point_b = detail::to_bullet(answer.point_b);
        const bool overlaps = answer.upper < 0;
        // Of shapes that are apart Bullet takes the margins off again.
        if (!overlaps) {
            point_a += axis * a->getMargin();
            point_b -= axis * b->getMargin();
        }
        return overlaps;
    }

  private:
    struct question {
        const btConvexShape *a, *b;
        const btTransform &at_a, &at_b;
        btIDebugDraw *debug;
    };
    static bool ask_bullet(const question &of, btVector3 &axis, btVector3 &point_a, btVector3 &point_b) {
        btGjkEpaPenetrationDepthSolver own;
        btVoronoiSimplexSolver simplex;
        return own.calcPenDepth(simplex, of.a, of.b, of.at_a, of.at_b, axis, point_a, point_b, of.debug);
    }
    adapters::shape_table table_;
};

} // namespace bullet
} // namespace ovoid

#endif
