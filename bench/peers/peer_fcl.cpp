// FCL in double: Convex shapes, which climb from vertex to vertex above 32 vertices, through fcl::collide and
// fcl::distance. Two contestants, one for each of its solvers: its own (fcl) and libccd (fcl-ccd, its default). Its own
// solver returns the depth with a minus sign, which the benchmark corrects, and the normal in the frame of A, which it
// does not. Warm start: the cached guess of its own solver, for collide. Within a margin: its distance, compared.
#include "peers/peer_fcl.h"

#include <cmath>
#include <memory>
#include <vector>

namespace {

struct posed {
    const fcl::Convexd *a, *b;
    fcl::Transform3d at_a, at_b;
    double margin;
};

struct self {
    fcl::GJKSolverType solver;
    std::vector<std::shared_ptr<fcl::Convexd>> shapes;
    std::vector<posed, Eigen::aligned_allocator<posed>> pairs;
    std::vector<fcl::Vector3d> guesses;
};

fcl::Transform3d make_transform(const ovoid_pose &pose) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    const ovoid_quat &q = pose.rotation;
    t.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
    t.translation() = fcl::Vector3d(pose.position.x, pose.position.y, pose.position.z);
    return t;
}

void *create(const workload *work, fcl::GJKSolverType solver) {
    auto *s = new self;
    s->solver = solver;
    for (uint32_t i = 0; i < work->body_count; i++) s->shapes.push_back(make_convex(work->bodies[i]));
    for (uint32_t i = 0; i < work->pair_count; i++) {
        const placed &p = work->pairs[i];
        s->pairs.push_back(
            {s->shapes[p.a].get(), s->shapes[p.b].get(), make_transform(p.pose_a), make_transform(p.pose_b), p.margin});
    }
    s->guesses.resize(work->tracks ? work->tracks : work->pair_count);
    return s;
}
void *create_own(const workload *work) { return create(work, fcl::GST_INDEP); }
void *create_ccd(const workload *work) { return create(work, fcl::GST_LIBCCD); }
void destroy(void *state) { delete static_cast<self *>(state); }

ovoid_vec3 to_vec3(const fcl::Vector3d &v) { return {v.x(), v.y(), v.z()}; }

found ask_collide(const posed &p, fcl::GJKSolverType solver, bool depth, fcl::Vector3d *guess, bool has_guess) {
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    request.gjk_solver_type = solver;
    request.enable_contact = depth;
    if (guess) {
        request.enable_cached_gjk_guess = true;
        if (has_guess) request.cached_gjk_guess = *guess;
    }
    found f = {};
    f.yes = fcl::collide(p.a, p.at_a, p.b, p.at_b, request, result) > 0 ? VERDICT_YES : VERDICT_NO;
    if (guess) *guess = result.cached_gjk_guess;
    if (depth && result.numContacts() > 0) {
        f.distance = std::abs(result.getContact(0).penetration_depth);
        f.normal = to_vec3(result.getContact(0).normal);
    }
    return f;
}

found ask_distance(const posed &p, fcl::GJKSolverType solver, bool within) {
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    request.gjk_solver_type = solver;
    request.enable_nearest_points = !within;
    double distance = fcl::distance(p.a, p.at_a, p.b, p.at_b, request, result);
    found f = {};
    f.yes = distance <= (within ? p.margin : 0) ? VERDICT_YES : VERDICT_NO;
    f.distance = distance;
    f.point_a = to_vec3(result.nearest_points[0]);
    f.point_b = to_vec3(result.nearest_points[1]);
    return f;
}

void run(void *state, question what, int warm, found *answers) {
    auto *s = static_cast<self *>(state);
    for (size_t i = 0; i < s->pairs.size(); i++) {
        bool collides = what == QUESTION_COLLIDE || what == QUESTION_DEPTH;
        fcl::Vector3d *guess = warm ? &s->guesses[i % s->guesses.size()] : nullptr;
        answers[i] = collides
                         ? ask_collide(s->pairs[i], s->solver, what == QUESTION_DEPTH, guess, i >= s->guesses.size())
                         : ask_distance(s->pairs[i], s->solver, what == QUESTION_WITHIN);
    }
}

const unsigned all_questions = (1u << QUESTION_COUNT) - 1, collide_warm = 1u << QUESTION_COLLIDE | 1u << QUESTION_DEPTH;
const peer own = {"fcl", all_questions, collide_warm, 0, create_own, run, destroy};
const peer over_ccd = {"fcl-ccd", all_questions, 0, 0, create_ccd, run, destroy};
const peer *const all[] = {&own, &over_ccd, nullptr};

} // namespace

const peer *const *bench_get_peers(void) { return all; }
