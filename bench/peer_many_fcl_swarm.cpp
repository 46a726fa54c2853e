// FCL's dynamic trees: each frame sets all transforms and boxes, refits the tree once (update), and asks it for all
// pairs, each of which goes to fcl::collide without contacts, over libccd: FCL's own solver took 3.5 times as long
// here, and the boxes of CollisionObject::computeAABB, those of the enclosing spheres, 2.4 times.
#include "peer_many_fcl.h"

namespace {

struct frame {
    meetings *touching;
    fcl::CollisionRequestd request;
};

bool collide_pair(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *context) {
    auto *f = static_cast<frame *>(context);
    fcl::CollisionResultd result;
    if (fcl::collide(a, b, f->request, result) > 0)
        meetings_add(f->touching, to_posed(a)->index, to_posed(b)->index, 0);
    return false;
}

template <typename manager> struct self {
    std::vector<std::shared_ptr<fcl::Convexd>> shapes;
    std::vector<std::unique_ptr<posed_convex>> objects;
    manager tree;
};

template <typename manager> void *create(const swarm *what, const ovoid_pose *poses) {
    auto *s = new self<manager>;
    for (uint32_t i = 0; i < what->shape_count; i++) s->shapes.push_back(make_convex(what->shapes[i]));
    std::vector<fcl::CollisionObjectd *> all;
    for (uint32_t i = 0; i < what->body_count; i++) {
        s->objects.push_back(std::make_unique<posed_convex>(s->shapes[what->shape_of[i]], i));
        s->objects.back()->move(poses[i]);
        all.push_back(s->objects.back().get());
    }
    s->tree.registerObjects(all);
    s->tree.setup();
    return s;
}

template <typename manager> void run(void *state, const ovoid_pose *poses, meetings *touching) {
    auto *s = static_cast<self<manager> *>(state);
    for (size_t i = 0; i < s->objects.size(); i++) s->objects[i]->move(poses[i]);
    s->tree.update();
    frame f;
    f.touching = touching;
    f.request.gjk_solver_type = fcl::GST_LIBCCD;
    s->tree.collide(&f, collide_pair);
}

template <typename manager> void destroy(void *state) { delete static_cast<self<manager> *>(state); }

using tree = fcl::DynamicAABBTreeCollisionManagerd;
using array = fcl::DynamicAABBTreeCollisionManager_Arrayd;
const swarm_peer fcl_tree = {"fcl", create<tree>, run<tree>, destroy<tree>};
const swarm_peer fcl_array = {"fcl array", create<array>, run<array>, destroy<array>};

} // namespace

const swarm_peer *const fcl_swarms[] = {&fcl_tree, &fcl_array, nullptr};
