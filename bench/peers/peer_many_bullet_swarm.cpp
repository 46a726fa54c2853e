// Bullet's dynamic tree with its hashed pair cache, and two ways to query the pairs. The first is that of its collision
// world (dispatcher, convex-convex algorithm, persistent manifolds). The lean one asks yes or no by
// btGjkEpaSolver2::Distance, its fastest, keeps each pair's separating axis, and collides the tree with itself once a
// frame (deferred) instead of once for each body. The trees' margin is a step of the motion; pools are large enough;
// all margins of shapes are 0.
#include "peers/peer_many_bullet.h"

namespace {

/// The trees' boxes are wider by this; a global of the library, set before each tree is made and used.
void set_tree_margin(double step) { gDbvtMargin = btScalar(step); }

// --- the world

struct world {
    std::vector<std::unique_ptr<btConvexHullShape>> shapes;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher;
    btDbvtBroadphase broad;
    btCollisionWorld bodies;
    std::vector<std::unique_ptr<btCollisionObject>> objects;
    double step = 0;

    static btDefaultCollisionConstructionInfo make_pools(uint32_t count) {
        btDefaultCollisionConstructionInfo info;
        info.m_defaultMaxCollisionAlgorithmPoolSize = static_cast<int>(4 * count + 4096);
        info.m_defaultMaxPersistentManifoldPoolSize = static_cast<int>(4 * count + 4096);
        return info;
    }
    explicit world(uint32_t count)
        : configuration(make_pools(count)), dispatcher(&configuration), bodies(&dispatcher, &broad, &configuration) {}
    ~world() {
        for (auto &object : objects) bodies.removeCollisionObject(object.get());
    }
};

void *create_world(const swarm *what, const ovoid_pose *poses) {
    set_tree_margin(what->step);
    auto *w = new world(what->body_count);
    w->step = what->step;
    for (uint32_t i = 0; i < what->shape_count; i++) w->shapes.push_back(make_hull(what->shapes[i]));
    for (uint32_t i = 0; i < what->body_count; i++) {
        auto object = std::make_unique<btCollisionObject>();
        object->setCollisionShape(w->shapes[what->shape_of[i]].get());
        object->setWorldTransform(make_transform(poses[i]));
        object->setCollisionFlags(0);
        object->setActivationState(DISABLE_DEACTIVATION);
        object->setUserIndex(static_cast<int>(i));
        w->bodies.addCollisionObject(object.get());
        w->objects.push_back(std::move(object));
    }
    w->broad.optimize();
    return w;
}

bool is_touching(const btPersistentManifold *manifold) {
    for (int k = 0; k < manifold->getNumContacts(); k++)
        if (manifold->getContactPoint(k).getDistance() <= 0) return true;
    return false;
}

void run_world(void *state, const ovoid_pose *poses, meetings *touching) {
    auto *w = static_cast<world *>(state);
    set_tree_margin(w->step);
    for (size_t i = 0; i < w->objects.size(); i++) w->objects[i]->setWorldTransform(make_transform(poses[i]));
    w->bodies.performDiscreteCollisionDetection();
    for (int i = 0; i < w->dispatcher.getNumManifolds(); i++) {
        const btPersistentManifold *manifold = w->dispatcher.getManifoldByIndexInternal(i);
        if (is_touching(manifold))
            meetings_add(touching, static_cast<uint32_t>(manifold->getBody0()->getUserIndex()),
                         static_cast<uint32_t>(manifold->getBody1()->getUserIndex()), 0);
    }
}
void destroy_world(void *state) { delete static_cast<world *>(state); }

// --- yes or no

/// Stored by the pair cache with a pair: the last separating axis. The cache destroys it with the pair.
struct kept_axis : btCollisionAlgorithm {
    btVector3 axis = {0, 0, 0};
    void processCollision(const btCollisionObjectWrapper *, const btCollisionObjectWrapper *, const btDispatcherInfo &,
                          btManifoldResult *) override {}
    btScalar calculateTimeOfImpact(btCollisionObject *, btCollisionObject *, const btDispatcherInfo &,
                                   btManifoldResult *) override {
        return 1;
    }
    void getAllContactManifolds(btManifoldArray &) override {}
};

struct lean {
    std::vector<std::unique_ptr<btConvexHullShape>> shapes;
    btDefaultCollisionConfiguration configuration; // for its pool of algorithms
    btCollisionDispatcher dispatcher;
    btDbvtBroadphase broad;
    std::vector<hull_at> objects;
    std::vector<btBroadphaseProxy *> proxies;
    double step = 0;

    explicit lean(uint32_t count) : configuration(world::make_pools(count)), dispatcher(&configuration) {}
    ~lean() {
        for (auto *proxy : proxies) broad.destroyProxy(proxy, &dispatcher);
    }
};

void *create_lean(const swarm *what, const ovoid_pose *poses) {
    set_tree_margin(what->step);
    auto *s = new lean(what->body_count);
    s->step = what->step;
    s->broad.m_deferedcollide = true;
    for (uint32_t i = 0; i < what->shape_count; i++) s->shapes.push_back(make_hull(what->shapes[i]));
    for (uint32_t i = 0; i < what->body_count; i++) {
        s->objects.push_back({s->shapes[what->shape_of[i]].get(), make_transform(poses[i])});
        btVector3 low, high;
        s->objects[i].shape->getAabb(s->objects[i].at, low, high);
        auto *name = reinterpret_cast<void *>(static_cast<uintptr_t>(i));
        s->proxies.push_back(s->broad.createProxy(low, high, CONVEX_HULL_SHAPE_PROXYTYPE, name,
                                                  btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter,
                                                  &s->dispatcher));
    }
    s->broad.optimize();
    return s;
}

uint32_t get_name(const btBroadphaseProxy *proxy) {
    return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(proxy->m_clientObject));
}

void ask_pair(lean *s, btBroadphasePair &pair, meetings *touching) {
    const btBroadphaseProxy *p = pair.m_pProxy0, *q = pair.m_pProxy1;
    // The tree's boxes are wider; the proxies hold the tight ones.
    if (!TestAabbAgainstAabb2(p->m_aabbMin, p->m_aabbMax, q->m_aabbMin, q->m_aabbMax)) return;
    if (!pair.m_algorithm)
        pair.m_algorithm = new (s->dispatcher.allocateCollisionAlgorithm(sizeof(kept_axis))) kept_axis;
    uint32_t a = get_name(p), b = get_name(q);
    btVector3 *axis = &static_cast<kept_axis *>(pair.m_algorithm)->axis;
    const hull_at &at_a = s->objects[a], &at_b = s->objects[b];
    btGjkEpaSolver2::sResults r;
    if (btGjkEpaSolver2::Distance(at_a.shape, at_a.at, at_b.shape, at_b.at, *axis, r))
        *axis = r.normal * r.distance; // in the frame of A, as the guess is taken
    else
        meetings_add(touching, a, b, 0);
}

void run_lean(void *state, const ovoid_pose *poses, meetings *touching) {
    auto *s = static_cast<lean *>(state);
    set_tree_margin(s->step);
    for (size_t i = 0; i < s->objects.size(); i++) {
        btVector3 low, high;
        s->objects[i].at = make_transform(poses[i]);
        s->objects[i].shape->getAabb(s->objects[i].at, low, high);
        s->broad.setAabb(s->proxies[i], low, high, &s->dispatcher);
    }
    s->broad.calculateOverlappingPairs(&s->dispatcher);
    auto &pairs = s->broad.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); i++) ask_pair(s, pairs[i], touching);
}
void destroy_lean(void *state) { delete static_cast<lean *>(state); }

const swarm_peer whole = {"bullet world" SUFFIX, create_world, run_world, destroy_world};
const swarm_peer yes_or_no = {"bullet lean" SUFFIX, create_lean, run_lean, destroy_lean};

} // namespace

const swarm_peer *const bullet_swarms[] = {&whole, &yes_or_no, nullptr};
