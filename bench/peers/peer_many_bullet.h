// Shared by Bullet's two many-body contestants; built once in double and once in single precision.
#ifndef OVOID_BENCH_PEERS_PEER_MANY_BULLET_H
#define OVOID_BENCH_PEERS_PEER_MANY_BULLET_H

#include "peers/bullet_hulls.h"
#include "peers/many_peer.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btAabbUtil2.h>

#include <memory>
#include <vector>

inline std::unique_ptr<btConvexHullShape> make_hull(const body &b) { return make_hull(b.vertices, b.vertex_count); }

/// A posed shape for the pair detector.
struct hull_at {
    const btConvexHullShape *shape;
    btTransform at;
};

/// The pair detector: no margins, a cut-off, the separating axis of the last call.
struct narrow {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;

    /// The signed distance, or BT_LARGE_FLOAT if it is beyond the cut-off.
    btScalar ask(const hull_at &a, const hull_at &b, btScalar cut, btVector3 *axis) {
        btGjkPairDetector detector(a.shape, b.shape, CONVEX_HULL_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE, 0, 0,
                                   &simplex, &depth);
        if (axis->fuzzyZero() == 0) detector.setCachedSeparatingAxis(*axis);
        btDiscreteCollisionDetectorInterface::ClosestPointInput input;
        input.m_transformA = a.at;
        input.m_transformB = b.at;
        input.m_maximumDistanceSquared = cut * cut;
        btPointCollector points;
        detector.getClosestPointsNonVirtual(input, points, nullptr);
        *axis = detector.getCachedSeparatingAxis();
        return points.m_hasResult ? points.m_distance : BT_LARGE_FLOAT;
    }
};

#ifdef BT_USE_DOUBLE_PRECISION
#define SUFFIX ""
#else
#define SUFFIX "-f"
#endif

extern const swarm_peer *const bullet_swarms[];
extern const cell_peer *const bullet_cells[];

#endif
