// FCL's dynamic trees, used in two ways. Plain: each frame sets all transforms and boxes, refits the tree once
// (update), and queries it for all pairs, each of which goes to fcl::collide without contacts, over libccd. (FCL's own
// solver took 3.5 times as long here, and the boxes of CollisionObject::computeAABB, those of the enclosing spheres,
// 2.4 times.)
//
// Careful: boxes in the tree are enlarged, so that few change in a frame; the list of pairs is kept from frame to
// frame; a pair is queried only if its tight boxes meet and its last separating axis no longer separates it. FCL
// returns no axis with a yes or no, so a distance is queried if a pair has just separated or its axis has failed.
#include "peers/peer_many_fcl.h"

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

// --- the careful way

/// The enlargement of a box, relative to the motion of the outermost points in a frame.
const double steps_ahead = 8;

struct kept_pair {
    uint32_t a, b;
    fcl::Vector3d axis; // from a to b; zero: none
};

struct careful {
    std::vector<std::shared_ptr<fcl::Convexd>> shapes;
    std::vector<std::unique_ptr<posed_convex>> objects;
    std::vector<fcl::AABBd> tight;
    std::vector<unsigned char> moved;
    std::vector<std::vector<kept_pair>> pairs; // of the object with the lower index
    fcl::DynamicAABBTreeCollisionManagerd tree;
    double room = 0;
};

void enlarge(careful *s, uint32_t i) {
    fcl::AABBd wide = s->tight[i];
    wide.expand(fcl::Vector3d::Constant(s->room));
    s->objects[i]->set_box(wide);
}

void *create_careful(const swarm *what, const ovoid_pose *poses) {
    auto *s = new careful;
    s->room = steps_ahead * what->step / 2;
    for (uint32_t i = 0; i < what->shape_count; i++) s->shapes.push_back(make_convex(what->shapes[i]));
    std::vector<fcl::CollisionObjectd *> all;
    s->tight.resize(what->body_count);
    s->moved.assign(what->body_count, 1);
    s->pairs.resize(what->body_count);
    for (uint32_t i = 0; i < what->body_count; i++) {
        s->objects.push_back(std::make_unique<posed_convex>(s->shapes[what->shape_of[i]], i));
        s->objects[i]->move(poses[i]);
        s->tight[i] = s->objects[i]->getAABB();
        enlarge(s, i);
        all.push_back(s->objects[i].get());
    }
    s->tree.registerObjects(all);
    s->tree.setup();
    return s;
}

bool add_pair(fcl::CollisionObjectd *p, fcl::CollisionObjectd *q, void *context) {
    auto *s = static_cast<careful *>(context);
    uint32_t a = to_posed(p)->index, b = to_posed(q)->index;
    if (a == b) return false;
    if (a > b) std::swap(a, b);
    for (const kept_pair &k : s->pairs[a])
        if (k.b == b) return false;
    s->pairs[a].push_back({a, b, fcl::Vector3d::Zero()});
    return false;
}

/// Moves all bodies; those that left their boxes get new ones, and their pairs are updated.
void move_careful(careful *s, const ovoid_pose *poses) {
    std::vector<fcl::CollisionObjectd *> left;
    for (size_t i = 0; i < s->objects.size(); i++) {
        fcl::AABBd wide = s->objects[i]->getAABB();
        s->objects[i]->move(poses[i]);
        s->tight[i] = s->objects[i]->getAABB();
        s->objects[i]->set_box(wide);
        if (wide.contain(s->tight[i])) continue;
        s->moved[i] = 1;
        enlarge(s, static_cast<uint32_t>(i));
        left.push_back(s->objects[i].get());
    }
    if (!left.empty()) s->tree.update(left);
    for (auto &list : s->pairs)
        for (size_t k = 0; k < list.size();) {
            const kept_pair &p = list[k];
            if ((s->moved[p.a] | s->moved[p.b]) && !s->objects[p.a]->getAABB().overlap(s->objects[p.b]->getAABB())) {
                list[k] = list.back();
                list.pop_back();
            } else {
                k++;
            }
        }
    for (size_t i = 0; i < s->objects.size(); i++)
        if (s->moved[i]) s->tree.collide(s->objects[i].get(), s, add_pair);
    std::fill(s->moved.begin(), s->moved.end(), 0);
}

/// The gap along an axis that need not be a unit vector.
double measure_gap(const posed_convex &a, const posed_convex &b, const fcl::Vector3d &axis) {
    return axis.dot(b.getTranslation() - a.getTranslation()) - b.find_extreme(-axis) - a.find_extreme(axis);
}

void ask_careful(careful *s, kept_pair *k, meetings *touching) {
    posed_convex &a = *s->objects[k->a], &b = *s->objects[k->b];
    if (!s->tight[k->a].overlap(s->tight[k->b])) return;
    if (!k->axis.isZero() && measure_gap(a, b, k->axis) > 0) return;
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    request.gjk_solver_type = fcl::GST_LIBCCD;
    k->axis.setZero();
    if (fcl::collide(&a, &b, request, result) > 0) {
        meetings_add(touching, k->a, k->b, 0);
        return;
    }
    fcl::DistanceRequestd how_far(true);
    fcl::DistanceResultd found;
    how_far.gjk_solver_type = fcl::GST_LIBCCD;
    if (fcl::distance(&a, &b, how_far, found) > 0) k->axis = found.nearest_points[1] - found.nearest_points[0];
}

void run_careful(void *state, const ovoid_pose *poses, meetings *touching) {
    auto *s = static_cast<careful *>(state);
    move_careful(s, poses);
    for (auto &list : s->pairs)
        for (kept_pair &k : list) ask_careful(s, &k, touching);
}
void destroy_careful(void *state) { delete static_cast<careful *>(state); }

using tree = fcl::DynamicAABBTreeCollisionManagerd;
using array = fcl::DynamicAABBTreeCollisionManager_Arrayd;
const swarm_peer fcl_tree = {"fcl", create<tree>, run<tree>, destroy<tree>};
const swarm_peer fcl_array = {"fcl array", create<array>, run<array>, destroy<array>};
const swarm_peer fcl_careful = {"fcl careful", create_careful, run_careful, destroy_careful};

} // namespace

const swarm_peer *const fcl_swarms[] = {&fcl_tree, &fcl_array, &fcl_careful, nullptr};
