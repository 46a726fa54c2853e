// FCL with a robot: the parts are in a dynamic tree that is set up once. The planner queries each link against the tree
// and stops at the first hit; the monitor uses the tree's distance traversal with the margin as its bound. Links are
// few, so their boxes are compared directly.
#include "peers/peer_many_fcl.h"

namespace {

const fcl::GJKSolverType solver = fcl::GST_LIBCCD;

struct self {
    const workcell *what;
    std::vector<std::shared_ptr<fcl::Convexd>> shapes;
    std::vector<std::unique_ptr<posed_convex>> links, parts;
    fcl::DynamicAABBTreeCollisionManagerd tree;
};

void *create(const workcell *what, const ovoid_pose *links) {
    auto *s = new self;
    s->what = what;
    for (uint32_t i = 0; i < what->shape_count; i++) s->shapes.push_back(make_convex(what->shapes[i]));
    std::vector<fcl::CollisionObjectd *> all;
    for (uint32_t i = 0; i < what->link_count + what->part_count; i++) {
        bool is_link = i < what->link_count;
        auto &list = is_link ? s->links : s->parts;
        list.push_back(std::make_unique<posed_convex>(s->shapes[what->shape_of[i]], i));
        list.back()->move(is_link ? links[i] : what->parts[i - what->link_count]);
        if (!is_link) all.push_back(list.back().get());
    }
    s->tree.registerObjects(all);
    s->tree.setup();
    return s;
}
void destroy(void *state) { delete static_cast<self *>(state); }

bool do_touch(const fcl::CollisionObjectd *a, const fcl::CollisionObjectd *b) {
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    request.gjk_solver_type = solver;
    return fcl::collide(a, b, request, result) > 0;
}

bool stop_at_touch(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *context) {
    return *static_cast<bool *>(context) = do_touch(a, b);
}

int is_hit(void *state, const ovoid_pose *poses) {
    auto *s = static_cast<self *>(state);
    uint32_t count = s->what->link_count;
    for (uint32_t i = 0; i < count; i++) s->links[i]->move(poses[i]);
    for (uint32_t i = 0; i < count; i++) {
        bool hit = false;
        s->tree.collide(s->links[i].get(), &hit, stop_at_touch);
        if (hit) return 1;
    }
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count; k++)
            if (!s->what->ignored[i * count + k] && s->links[i]->getAABB().overlap(s->links[k]->getAABB()) &&
                do_touch(s->links[i].get(), s->links[k].get()))
                return 1;
    return 0;
}

struct monitor {
    double margin;
    meetings *near;
};

void measure_pair(const fcl::CollisionObjectd *a, const fcl::CollisionObjectd *b, const monitor &m) {
    if (a->getAABB().distance(b->getAABB()) > m.margin) return;
    fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    request.gjk_solver_type = solver;
    double distance = fcl::distance(a, b, request, result);
    if (distance <= m.margin) meetings_add(m.near, to_posed(a)->index, to_posed(b)->index, distance);
}

bool measure_near(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *context, double &bound) {
    auto *m = static_cast<monitor *>(context);
    bound = m->margin;
    measure_pair(a, b, *m);
    return false;
}

void measure(void *state, const ovoid_pose *poses, meetings *near) {
    auto *s = static_cast<self *>(state);
    monitor m = {s->what->margin, near};
    uint32_t count = s->what->link_count;
    for (uint32_t i = 0; i < count; i++) s->links[i]->move(poses[i]);
    for (uint32_t i = 0; i < count; i++) {
        s->tree.distance(s->links[i].get(), &m, measure_near);
        for (uint32_t k = i + 1; k < count; k++)
            if (!s->what->ignored[i * count + k]) measure_pair(s->links[i].get(), s->links[k].get(), m);
    }
}

const cell_peer fcl_cell = {"fcl", create, is_hit, measure, destroy};

} // namespace

const cell_peer *const fcl_cells[] = {&fcl_cell, nullptr};
