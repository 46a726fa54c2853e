// Bullet's contact points: the algorithm of its collision pipeline for two hulls, with the persistent manifold that it
// keeps from frame to frame; margins 0. Cold: a new manifold.
#include "peers/bullet_hulls.h"
#include "peers/contact_peer.h"

#include <btBulletCollisionCommon.h>

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include <memory>
#include <vector>

namespace {

struct self {
    const contact_work *work;
    std::vector<std::unique_ptr<btConvexHullShape>> shapes;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDispatcherInfo info;
    std::vector<btCollisionAlgorithm *> algorithms;
};

void release(self *s, size_t i) {
    btCollisionAlgorithm *old = s->algorithms[i];
    if (!old) return;
    old->~btCollisionAlgorithm();
    s->dispatcher.freeCollisionAlgorithm(old);
    s->algorithms[i] = nullptr;
}

void *create(const contact_work *work) {
    auto *s = new self;
    s->work = work;
    for (uint32_t i = 0; i < work->body_count; i++) {
        s->shapes.push_back(make_hull(work->bodies[i].vertices, work->bodies[i].vertex_count));
    }
    s->algorithms.resize(work->pair_count);
    return s;
}

uint32_t run(void *state, uint32_t frame, int warm) {
    auto *s = static_cast<self *>(state);
    uint32_t points = 0;
    for (uint32_t i = 0; i < s->work->pair_count; i++) {
        const placed &p = s->work->pairs[static_cast<size_t>(frame) * s->work->pair_count + i];
        btCollisionObject a, b;
        a.setCollisionShape(s->shapes[p.a].get());
        b.setCollisionShape(s->shapes[p.b].get());
        a.setWorldTransform(make_transform(p.pose_a));
        b.setWorldTransform(make_transform(p.pose_b));
        btCollisionObjectWrapper on_a(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1, -1);
        btCollisionObjectWrapper on_b(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
        if (!warm) release(s, i);
        if (!s->algorithms[i])
            s->algorithms[i] = s->dispatcher.findAlgorithm(&on_a, &on_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
        btManifoldArray all;
        s->algorithms[i]->getAllContactManifolds(all);
        // The manifold names the bodies by address; here these are new in each frame.
        for (int k = 0; k < all.size(); k++) all[k]->setBodies(&a, &b);
        btManifoldResult result(&on_a, &on_b);
        s->algorithms[i]->processCollision(&on_a, &on_b, s->info, &result);
        all.clear();
        s->algorithms[i]->getAllContactManifolds(all);
        for (int k = 0; k < all.size(); k++) points += static_cast<uint32_t>(all[k]->getNumContacts());
    }
    return points;
}

void destroy(void *state) {
    auto *s = static_cast<self *>(state);
    for (size_t i = 0; i < s->algorithms.size(); i++) release(s, i);
    delete s;
}

const contact_peer bullet = {sizeof(btScalar) == 4 ? "bullet, single" : "bullet", sizeof(btScalar) == 4, create, run,
                             destroy};
const contact_peer *const peers[] = {&bullet, nullptr};

} // namespace

const contact_peer *const *bench_get_contact_peers(void) { return peers; }
