// Bullet with a robot: the parts are in a dynamic tree, each link's box is queried against it, and the pair detector
// uses each pair's last separating axis. The tree's box query cannot be stopped, so after a hit the rest is skipped.
#include "peers/peer_many_bullet.h"

namespace {

struct self {
    const workcell *what;
    std::vector<std::unique_ptr<btConvexHullShape>> shapes;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broad;
    std::vector<hull_at> objects;     // links, then parts
    std::vector<btVector3> low, high; // of links
    std::vector<btBroadphaseProxy *> proxies;
    std::vector<btVector3> axes[2]; // of link i and object k at i * objects + k; planner's, monitor's
    narrow detector;

    ~self() {
        for (auto *proxy : proxies) broad.destroyProxy(proxy, &dispatcher);
    }
};

void *create(const workcell *what, const ovoid_pose *links) {
    auto *s = new self;
    s->what = what;
    for (uint32_t i = 0; i < what->shape_count; i++) s->shapes.push_back(make_hull(what->shapes[i]));
    uint32_t count = what->link_count + what->part_count;
    for (uint32_t i = 0; i < count; i++) {
        bool is_link = i < what->link_count;
        const ovoid_pose &pose = is_link ? links[i] : what->parts[i - what->link_count];
        s->objects.push_back({s->shapes[what->shape_of[i]].get(), make_transform(pose)});
        if (is_link) continue;
        btVector3 low, high;
        s->objects[i].shape->getAabb(s->objects[i].at, low, high);
        s->proxies.push_back(s->broad.createProxy(low, high, CONVEX_HULL_SHAPE_PROXYTYPE,
                                                  reinterpret_cast<void *>(static_cast<uintptr_t>(i)),
                                                  btBroadphaseProxy::StaticFilter, 0, &s->dispatcher));
    }
    s->low.resize(what->link_count);
    s->high.resize(what->link_count);
    for (auto &axes : s->axes) axes.resize(size_t(what->link_count) * count, btVector3(0, 0, 0));
    s->broad.optimize();
    return s;
}
void destroy(void *state) { delete static_cast<self *>(state); }

void move(self *s, const ovoid_pose *links) {
    for (uint32_t i = 0; i < s->what->link_count; i++) {
        s->objects[i].at = make_transform(links[i]);
        s->objects[i].shape->getAabb(s->objects[i].at, s->low[i], s->high[i]);
    }
}

/// The tree's callback for each part whose box meets that of the link. near: NULL for the planner.
struct visitor : btBroadphaseAabbCallback {
    self *s;
    uint32_t link = 0;
    bool hit = false;
    btScalar cut;
    meetings *near;
    btVector3 low, high; // of the link

    visitor(self *s, double cut, meetings *near) : s(s), cut(btScalar(cut)), near(near) {}

    void ask(uint32_t other) {
        btVector3 *axis = &s->axes[near ? 1 : 0][link * s->objects.size() + other];
        btScalar distance = s->detector.ask(s->objects[link], s->objects[other], cut, axis);
        if (near && distance <= cut) meetings_add(near, link, other, distance);
        hit |= distance <= 0;
    }
    bool process(const btBroadphaseProxy *proxy) override {
        if (hit && !near) return false;
        if (TestAabbAgainstAabb2(low, high, proxy->m_aabbMin, proxy->m_aabbMax))
            ask(static_cast<uint32_t>(reinterpret_cast<uintptr_t>(proxy->m_clientObject)));
        return true;
    }
    /// Queries the link with all parts, then with the links after it.
    void visit(uint32_t i) {
        btVector3 wide(cut, cut, cut);
        link = i;
        low = s->low[i] - wide;
        high = s->high[i] + wide;
        s->broad.aabbTest(low, high, *this);
        uint32_t count = s->what->link_count;
        for (uint32_t k = i + 1; k < count && (near || !hit); k++)
            if (!s->what->ignored[i * count + k] && TestAabbAgainstAabb2(low, high, s->low[k], s->high[k])) ask(k);
    }
};

int is_hit(void *state, const ovoid_pose *links) {
    auto *s = static_cast<self *>(state);
    move(s, links);
    visitor v(s, 0, nullptr);
    for (uint32_t i = 0; i < s->what->link_count && !v.hit; i++) v.visit(i);
    return v.hit;
}

void measure(void *state, const ovoid_pose *links, meetings *near) {
    auto *s = static_cast<self *>(state);
    move(s, links);
    visitor v(s, s->what->margin, near);
    for (uint32_t i = 0; i < s->what->link_count; i++) v.visit(i);
}

const cell_peer bullet_cell = {"bullet" SUFFIX, create, is_hit, measure, destroy};

} // namespace

const cell_peer *const bullet_cells[] = {&bullet_cell, nullptr};
