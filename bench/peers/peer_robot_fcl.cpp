// FCL as MoveIt drives it: a dynamic tree for the world and one for the robot's own bodies, whose callbacks leave out
// allowed pairs and stop at the first contact; URDF's boxes, cylinders and spheres are FCL's own. Other shapes are
// trees of triangles (BVHModel<OBBRSS>), as in MoveIt, or in the second contestant Convex.
#include "peers/peer_fcl.h"
#include "peers/robot_peer.h"

namespace {

/// The owner of a body: links from 0 on, obstacles -1.
struct owner {
    int link;
};

struct self {
    robot_scene what;
    std::vector<std::shared_ptr<fcl::CollisionGeometryd>> shapes;
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> links, obstacles;
    std::vector<fcl::CollisionObjectd *> link_list;
    std::vector<fcl::Transform3d> in_link;
    std::vector<owner> owners;
    owner world{-1};
    fcl::DynamicAABBTreeCollisionManagerd around, own;
};

fcl::Transform3d to_transform(const ovoid_pose &pose) {
    const ovoid_quat &q = pose.rotation;
    fcl::Transform3d t = fcl::Transform3d::Identity();
    t.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    t.translation() = fcl::Vector3d(pose.position.x, pose.position.y, pose.position.z);
    return t;
}

std::shared_ptr<fcl::CollisionGeometryd> make_triangles(const body &b) {
    std::vector<fcl::Vector3d> points;
    std::vector<fcl::Triangle> triangles;
    for (uint32_t i = 0; i < b.vertex_count; i++)
        points.emplace_back(b.vertices[3 * i], b.vertices[3 * i + 1], b.vertices[3 * i + 2]);
    for (uint32_t t = 0; t < b.triangle_count; t++)
        triangles.emplace_back(b.triangles[3 * t], b.triangles[3 * t + 1], b.triangles[3 * t + 2]);
    auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    return model;
}

std::shared_ptr<fcl::CollisionGeometryd> make_shape(const solid &s, bool meshes) {
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    switch (s.kind) {
    case SOLID_BOX: shape = std::make_shared<fcl::Boxd>(2 * s.size[0], 2 * s.size[1], 2 * s.size[2]); break;
    case SOLID_CYLINDER: shape = std::make_shared<fcl::Cylinderd>(s.size[0], 2 * s.size[1]); break;
    case SOLID_CAPSULE: shape = std::make_shared<fcl::Capsuled>(s.size[0], 2 * s.size[1]); break;
    case SOLID_SPHERE: shape = std::make_shared<fcl::Sphered>(s.size[0]); break;
    default:
        if (meshes)
            shape = make_triangles(s.hull);
        else
            shape = make_convex(s.hull);
    }
    shape->computeLocalAABB();
    return shape;
}

void *create(const robot_scene *what, bool meshes) {
    auto *s = new self;
    s->what = *what;
    for (uint32_t i = 0; i < what->solid_count; i++) s->shapes.push_back(make_shape(what->solids[i], meshes));
    s->owners.resize(what->element_count);
    for (uint32_t i = 0; i < what->element_count; i++) {
        const placed_solid &e = what->elements[i];
        s->owners[i].link = static_cast<int>(e.link);
        s->in_link.push_back(to_transform(e.pose));
        s->links.push_back(std::make_unique<fcl::CollisionObjectd>(s->shapes[e.solid], s->in_link.back()));
        s->links.back()->setUserData(&s->owners[i]);
        s->link_list.push_back(s->links.back().get());
    }
    std::vector<fcl::CollisionObjectd *> all;
    for (uint32_t i = 0; i < what->obstacle_count; i++) {
        const placed_solid &o = what->obstacles[i];
        s->obstacles.push_back(std::make_unique<fcl::CollisionObjectd>(s->shapes[o.solid], to_transform(o.pose)));
        s->obstacles.back()->setUserData(&s->world);
        s->obstacles.back()->computeAABB();
        all.push_back(s->obstacles.back().get());
    }
    s->around.registerObjects(all);
    s->around.setup();
    s->own.registerObjects(s->link_list);
    s->own.setup();
    return s;
}
void *create_meshes(const robot_scene *what) { return create(what, true); }
void *create_convex(const robot_scene *what) { return create(what, false); }
void destroy(void *state) { delete static_cast<self *>(state); }

bool is_left_out(const self *s, const fcl::CollisionObjectd *a, const fcl::CollisionObjectd *b) {
    int i = static_cast<owner *>(a->getUserData())->link, k = static_cast<owner *>(b->getUserData())->link;
    if (i < 0 || k < 0) return false;
    return s->what.ignored[static_cast<uint32_t>(i) * s->what.link_count + static_cast<uint32_t>(k)] != 0;
}

struct question {
    const self *of;
    bool is_hit;
    uint32_t near;
};

bool collide_pair(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *context) {
    auto *q = static_cast<question *>(context);
    if (is_left_out(q->of, a, b)) return false;
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    request.gjk_solver_type = fcl::GST_LIBCCD;
    q->is_hit = fcl::collide(a, b, request, result) > 0;
    return q->is_hit;
}

void place(self *s, const ovoid_pose *links) {
    for (uint32_t i = 0; i < s->what.element_count; i++) {
        s->links[i]->setTransform(to_transform(links[s->what.elements[i].link]) * s->in_link[i]);
        s->links[i]->computeAABB();
    }
    s->own.update();
}

int is_hit(void *state, const double *, const ovoid_pose *links) {
    auto *s = static_cast<self *>(state);
    question q = {s, false, 0};
    place(s, links);
    s->own.collide(&q, collide_pair);
    for (uint32_t i = 0; !q.is_hit && i < s->links.size(); i++) s->around.collide(s->links[i].get(), &q, collide_pair);
    return q.is_hit;
}

bool measure_pair(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *context, double &bound) {
    auto *q = static_cast<question *>(context);
    bound = q->of->what.margin;
    if (is_left_out(q->of, a, b) || a->getAABB().distance(b->getAABB()) > bound) return false;
    fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    request.gjk_solver_type = fcl::GST_LIBCCD;
    q->near += fcl::distance(a, b, request, result) <= bound;
    return false;
}

uint32_t measure(void *state, const double *, const ovoid_pose *links) {
    auto *s = static_cast<self *>(state);
    question q = {s, false, 0};
    place(s, links);
    s->own.distance(&q, measure_pair);
    for (auto &link : s->links) s->around.distance(link.get(), &q, measure_pair);
    return q.near;
}

const robot_peer meshes = {"fcl, meshes", 0, create_meshes, is_hit, nullptr, measure, destroy};
const robot_peer convex = {"fcl, convex", 0, create_convex, is_hit, nullptr, measure, destroy};
const robot_peer *const peers[] = {&meshes, &convex, nullptr};

} // namespace

const robot_peer *const *bench_get_robot_peers(void) { return peers; }
