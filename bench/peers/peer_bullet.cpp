// Bullet, hull shapes with all margins 0; built once in double and once in single precision, as Debian ships both. Two
// contestants each: epa2, the calls of btGjkEpaSolver2, and pair, the btGjkPairDetector of its collision pipeline with
// btGjkEpaPenetrationDepthSolver. Warm start: the pair detector's cached separating axis. Yes or no by the pair
// detector: a pair of points at a distance below 0 (or the margin), with its own cut-off of farther pairs.
#include "peers/bullet_hulls.h"
#include "peers/peer.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <memory>
#include <vector>

namespace {

struct posed {
    const btConvexHullShape *a, *b;
    btTransform at_a, at_b;
    btScalar margin;
};

struct self {
    std::vector<std::unique_ptr<btConvexHullShape>> shapes;
    std::vector<posed> pairs;
    std::vector<btVector3> axes; // of each track's last frame
};

ovoid_vec3 from_bullet(const btVector3 &v) { return {v.x(), v.y(), v.z()}; }

void *create(const workload *work) {
    auto *s = new self;
    for (uint32_t i = 0; i < work->body_count; i++) {
        s->shapes.push_back(make_hull(work->bodies[i].vertices, work->bodies[i].vertex_count));
    }
    for (uint32_t i = 0; i < work->pair_count; i++) {
        const placed &p = work->pairs[i];
        s->pairs.push_back({s->shapes[p.a].get(), s->shapes[p.b].get(), make_transform(p.pose_a),
                            make_transform(p.pose_b), btScalar(p.margin)});
    }
    s->axes.resize(work->tracks ? work->tracks : work->pair_count);
    return s;
}
void destroy(void *state) { delete static_cast<self *>(state); }

found ask_epa2(const posed &p, question what) {
    btGjkEpaSolver2::sResults r;
    btVector3 guess = p.at_b.getOrigin() - p.at_a.getOrigin();
    found f = {};
    if (what == QUESTION_DEPTH) {
        f.yes = btGjkEpaSolver2::Penetration(p.a, p.at_a, p.b, p.at_b, guess, r, false) ? VERDICT_YES : VERDICT_NO;
        f.distance = -r.distance;
    } else {
        bool apart = btGjkEpaSolver2::Distance(p.a, p.at_a, p.b, p.at_b, guess, r);
        f.yes = apart && r.distance > (what == QUESTION_WITHIN ? p.margin : 0) ? VERDICT_NO : VERDICT_YES;
        f.distance = apart ? r.distance : 0;
    }
    f.point_a = from_bullet(r.witnesses[0]);
    f.point_b = from_bullet(r.witnesses[1]);
    f.normal = from_bullet(p.at_a.getBasis() * r.normal); // returned in the frame of A
    return f;
}

void run_epa2(void *state, question what, int, found *answers) {
    auto *s = static_cast<self *>(state);
    for (size_t i = 0; i < s->pairs.size(); i++) answers[i] = ask_epa2(s->pairs[i], what);
}

btScalar get_cut(const posed &p, question what) {
    switch (what) {
    case QUESTION_COLLIDE: return 0;
    case QUESTION_WITHIN: return p.margin * p.margin;
    default: return BT_LARGE_FLOAT;
    }
}

void run_pair(void *state, question what, int warm, found *answers) {
    auto *s = static_cast<self *>(state);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    size_t tracks = s->axes.size();
    for (size_t i = 0; i < s->pairs.size(); i++) {
        const posed &p = s->pairs[i];
        btGjkPairDetector detector(p.a, p.b, p.a->getShapeType(), p.b->getShapeType(), 0, 0, &simplex, &depth);
        if (warm && i >= tracks) detector.setCachedSeparatingAxis(s->axes[i % tracks]);
        btDiscreteCollisionDetectorInterface::ClosestPointInput input;
        input.m_transformA = p.at_a;
        input.m_transformB = p.at_b;
        input.m_maximumDistanceSquared = get_cut(p, what);
        btPointCollector points;
        detector.getClosestPointsNonVirtual(input, points, nullptr);
        if (warm) s->axes[i % tracks] = detector.getCachedSeparatingAxis();
        found &f = answers[i];
        f = {};
        f.yes = points.m_hasResult && points.m_distance <= (what == QUESTION_WITHIN ? p.margin : 0) ? VERDICT_YES
                                                                                                    : VERDICT_NO;
        f.distance = what == QUESTION_DEPTH ? -points.m_distance : points.m_distance;
        f.point_b = from_bullet(points.m_pointInWorld);
        f.point_a = from_bullet(points.m_pointInWorld + points.m_normalOnBInWorld * points.m_distance);
        f.normal = from_bullet(points.m_normalOnBInWorld);
    }
}

#ifdef BT_USE_DOUBLE_PRECISION
#define SUFFIX ""
const int single_precision = 0;
#else
#define SUFFIX "-f"
const int single_precision = 1;
#endif

const unsigned all_questions = (1u << QUESTION_COUNT) - 1;
const peer epa2 = {"bt-epa2" SUFFIX, all_questions, 0, single_precision, create, run_epa2, destroy};
const peer pair = {"bt-pair" SUFFIX, all_questions, all_questions, single_precision, create, run_pair, destroy};
const peer *const all[] = {&epa2, &pair, nullptr};

} // namespace

const peer *const *bench_get_peers(void) { return all; }
