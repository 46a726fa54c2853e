/**
 * @file replace.hpp
 * FCL's calls in namespace fcl as functions that are no templates: a call that leaves the scalar to the arguments finds
 * them before FCL's templates. <ovoid/fcl.hpp> includes it where OVOID_FCL_REPLACE is defined. Calls with floats are
 * replaced where OVOID_FCL_REPLACE_FLOAT is defined too: they compile FCL's templates for floats, which takes a minute.
 */
#ifndef OVOID_FCL_REPLACE_HPP
#define OVOID_FCL_REPLACE_HPP

#include "ovoid/fcl.hpp"

/** @cond */
namespace fcl {

#define OVOID_FCL_PUT(S)                                                                                               \
    inline std::size_t collide(const CollisionGeometry<S> *o1, const Transform3<S> &tf1,                               \
                               const CollisionGeometry<S> *o2, const Transform3<S> &tf2,                               \
                               const CollisionRequest<S> &request, CollisionResult<S> &result) {                       \
        return ::ovoid::fcl::collide<S>(o1, tf1, o2, tf2, request, result);                                            \
    }                                                                                                                  \
    inline std::size_t collide(const CollisionObject<S> *o1, const CollisionObject<S> *o2,                             \
                               const CollisionRequest<S> &request, CollisionResult<S> &result) {                       \
        return ::ovoid::fcl::collide<S>(o1, o2, request, result);                                                      \
    }                                                                                                                  \
    inline S distance(const CollisionGeometry<S> *o1, const Transform3<S> &tf1, const CollisionGeometry<S> *o2,        \
                      const Transform3<S> &tf2, const DistanceRequest<S> &request, DistanceResult<S> &result) {        \
        return ::ovoid::fcl::distance<S>(o1, tf1, o2, tf2, request, result);                                           \
    }                                                                                                                  \
    inline S distance(const CollisionObject<S> *o1, const CollisionObject<S> *o2, const DistanceRequest<S> &request,   \
                      DistanceResult<S> &result) {                                                                     \
        return ::ovoid::fcl::distance<S>(o1, o2, request, result);                                                     \
    }
#define OVOID_FCL_PUT_CONTINUOUS(S)                                                                                    \
    inline S continuousCollide(const CollisionGeometry<S> *o1, const MotionBase<S> *motion1,                           \
                               const CollisionGeometry<S> *o2, const MotionBase<S> *motion2,                           \
                               const ContinuousCollisionRequest<S> &request, ContinuousCollisionResult<S> &result) {   \
        return ::ovoid::fcl::continuousCollide<S>(o1, motion1, o2, motion2, request, result);                          \
    }                                                                                                                  \
    inline S continuousCollide(const CollisionGeometry<S> *o1, const Transform3<S> &tf1_beg,                           \
                               const Transform3<S> &tf1_end, const CollisionGeometry<S> *o2,                           \
                               const Transform3<S> &tf2_beg, const Transform3<S> &tf2_end,                             \
                               const ContinuousCollisionRequest<S> &request, ContinuousCollisionResult<S> &result) {   \
        return ::ovoid::fcl::continuousCollide<S>(o1, tf1_beg, tf1_end, o2, tf2_beg, tf2_end, request, result);        \
    }                                                                                                                  \
    inline S continuousCollide(const CollisionObject<S> *o1, const Transform3<S> &tf1_end,                             \
                               const CollisionObject<S> *o2, const Transform3<S> &tf2_end,                             \
                               const ContinuousCollisionRequest<S> &request, ContinuousCollisionResult<S> &result) {   \
        return ::ovoid::fcl::continuousCollide<S>(o1, tf1_end, o2, tf2_end, request, result);                          \
    }                                                                                                                  \
    inline S collide(const ContinuousCollisionObject<S> *o1, const ContinuousCollisionObject<S> *o2,                   \
                     const ContinuousCollisionRequest<S> &request, ContinuousCollisionResult<S> &result) {             \
        return ::ovoid::fcl::collide<S>(o1, o2, request, result);                                                      \
    }
OVOID_FCL_PUT(double)
OVOID_FCL_PUT_CONTINUOUS(double)
#ifdef OVOID_FCL_REPLACE_FLOAT
OVOID_FCL_PUT(float)
#endif
#undef OVOID_FCL_PUT
#undef OVOID_FCL_PUT_CONTINUOUS

} // namespace fcl
/** @endcond */

#endif
