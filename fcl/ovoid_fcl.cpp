// libovoid_fcl: FCL's calls answered by ovoid in programs that are not compiled anew. It defines the functions that
// libfcl exports for collide, distance and continuousCollide of doubles, so a program that loads it before libfcl
// (LD_PRELOAD, or link order) finds these. What <ovoid/fcl.hpp> leaves to FCL goes on to the next library that defines
// the name. FCL's own code calls these functions through the same names, so its broad-phase managers come here too.
//
// With the environment variable OVOID_FCL_REPORT set, the library writes one line to stderr when the program ends: the
// number of calls, and of those that went on to FCL.

#include <dlfcn.h>

#include <fcl/fcl.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

// The names as the linker knows them: a function template that is declared `extern template` cannot be specialised.
// With C linkage a function has the name that is written.
// clang-format off
#define COLLIDE_GEOMETRIES _ZN3fcl7collideIdEEmPKNS_17CollisionGeometryIT_EERKN5Eigen9TransformIS2_Li3ELi1ELi0EEES5_SA_RKNS_16CollisionRequestIS2_EERNS_15CollisionResultIS2_EE
#define COLLIDE_OBJECTS _ZN3fcl7collideIdEEmPKNS_15CollisionObjectIT_EES5_RKNS_16CollisionRequestIS2_EERNS_15CollisionResultIS2_EE
#define DISTANCE_GEOMETRIES _ZN3fcl8distanceIdEET_PKNS_17CollisionGeometryIS1_EERKN5Eigen9TransformIS1_Li3ELi1ELi0EEES5_SA_RKNS_15DistanceRequestIS1_EERNS_14DistanceResultIS1_EE
#define DISTANCE_OBJECTS _ZN3fcl8distanceIdEET_PKNS_15CollisionObjectIS1_EES5_RKNS_15DistanceRequestIS1_EERNS_14DistanceResultIS1_EE
#define CONTINUOUS_MOTIONS _ZN3fcl17continuousCollideIdEET_PKNS_17CollisionGeometryIS1_EEPKNS_10MotionBaseIS1_EES5_S9_RKNS_26ContinuousCollisionRequestIS1_EERNS_25ContinuousCollisionResultIS1_EE
#define CONTINUOUS_GEOMETRIES _ZN3fcl17continuousCollideIdEET_PKNS_17CollisionGeometryIS1_EERKN5Eigen9TransformIS1_Li3ELi1ELi0EEESA_S5_SA_SA_RKNS_26ContinuousCollisionRequestIS1_EERNS_25ContinuousCollisionResultIS1_EE
#define CONTINUOUS_OBJECTS _ZN3fcl17continuousCollideIdEET_PKNS_15CollisionObjectIS1_EERKN5Eigen9TransformIS1_Li3ELi1ELi0EEES5_SA_RKNS_26ContinuousCollisionRequestIS1_EERNS_25ContinuousCollisionResultIS1_EE
#define COLLIDE_MOVING _ZN3fcl7collideIdEET_PKNS_25ContinuousCollisionObjectIS1_EES5_RKNS_26ContinuousCollisionRequestIS1_EERNS_25ContinuousCollisionResultIS1_EE
// clang-format on
#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)

using geometry = fcl::CollisionGeometry<double>;
using object = fcl::CollisionObject<double>;
using moving = fcl::ContinuousCollisionObject<double>;
using motion = fcl::MotionBase<double>;
using transform = fcl::Transform3<double>;
using collision_request = fcl::CollisionRequest<double>;
using collision_result = fcl::CollisionResult<double>;
using distance_request = fcl::DistanceRequest<double>;
using distance_result = fcl::DistanceResult<double>;
using continuous_request = fcl::ContinuousCollisionRequest<double>;
using continuous_result = fcl::ContinuousCollisionResult<double>;

namespace {

/// Counts, where a report is wanted.
class report {
  public:
    static report &get() {
        static report *all = new report; // lives until the process ends
        return *all;
    }
    void add_call() { add(calls_); }
    void add_left() { add(left_); }
    void write() const {
        if (is_wanted_)
            std::fprintf(stderr, "libovoid_fcl: %llu calls, of which %llu were left to FCL\n",
                         static_cast<unsigned long long>(calls_), static_cast<unsigned long long>(left_));
    }

  private:
    void add(std::atomic<std::uint64_t> &to) const {
        if (is_wanted_) to.fetch_add(1, std::memory_order_relaxed);
    }
    const bool is_wanted_ = std::getenv("OVOID_FCL_REPORT") != nullptr;
    std::atomic<std::uint64_t> calls_{0}, left_{0};
};

__attribute__((destructor)) void end() { report::get().write(); }

/// FCL's own function of this name.
template <class F> F *find_next(const char *name) {
    if (void *found = dlsym(RTLD_NEXT, name)) return reinterpret_cast<F *>(found);
    throw std::runtime_error(std::string("libovoid_fcl: no library after this one defines FCL's ") + name +
                             "; load it before libfcl 0.7");
}

/// FCL's answers, from the library that would have been called without this one.
struct next_fcl {
    template <class S>
    static std::size_t collide(const geometry *o1, const transform &tf1, const geometry *o2, const transform &tf2,
                               const collision_request &request, collision_result &result) {
        using function = std::size_t(const geometry *, const transform &, const geometry *, const transform &,
                                     const collision_request &, collision_result &);
        static function *const next = find_next<function>(TEXT(COLLIDE_GEOMETRIES));
        report::get().add_left();
        return next(o1, tf1, o2, tf2, request, result);
    }
    template <class S>
    static double distance(const geometry *o1, const transform &tf1, const geometry *o2, const transform &tf2,
                           const distance_request &request, distance_result &result) {
        using function = double(const geometry *, const transform &, const geometry *, const transform &,
                                const distance_request &, distance_result &);
        static function *const next = find_next<function>(TEXT(DISTANCE_GEOMETRIES));
        report::get().add_left();
        return next(o1, tf1, o2, tf2, request, result);
    }
    template <class S>
    static double continuous_collide(const geometry *o1, const motion *motion1, const geometry *o2,
                                     const motion *motion2, const continuous_request &request,
                                     continuous_result &result) {
        using function = double(const geometry *, const motion *, const geometry *, const motion *,
                                const continuous_request &, continuous_result &);
        static function *const next = find_next<function>(TEXT(CONTINUOUS_MOTIONS));
        report::get().add_left();
        return next(o1, motion1, o2, motion2, request, result);
    }
    template <class S>
    static double continuous_collide(const geometry *o1, const transform &begin1, const transform &end1,
                                     const geometry *o2, const transform &begin2, const transform &end2,
                                     const continuous_request &request, continuous_result &result) {
        using function = double(const geometry *, const transform &, const transform &, const geometry *,
                                const transform &, const transform &, const continuous_request &, continuous_result &);
        static function *const next = find_next<function>(TEXT(CONTINUOUS_GEOMETRIES));
        report::get().add_left();
        return next(o1, begin1, end1, o2, begin2, end2, request, result);
    }
};

} // namespace

#define OVOID_FCL_ITSELF ::next_fcl
#include "ovoid/fcl.hpp"

#define EXPORT __attribute__((visibility("default")))

extern "C" {

EXPORT std::size_t COLLIDE_GEOMETRIES(const geometry *o1, const transform &tf1, const geometry *o2,
                                      const transform &tf2, const collision_request &request,
                                      collision_result &result) {
    report::get().add_call();
    return ovoid::fcl::collide<double>(o1, tf1, o2, tf2, request, result);
}
EXPORT std::size_t COLLIDE_OBJECTS(const object *o1, const object *o2, const collision_request &request,
                                   collision_result &result) {
    report::get().add_call();
    return ovoid::fcl::collide<double>(o1, o2, request, result);
}
EXPORT double DISTANCE_GEOMETRIES(const geometry *o1, const transform &tf1, const geometry *o2, const transform &tf2,
                                  const distance_request &request, distance_result &result) {
    report::get().add_call();
    return ovoid::fcl::distance<double>(o1, tf1, o2, tf2, request, result);
}
EXPORT double DISTANCE_OBJECTS(const object *o1, const object *o2, const distance_request &request,
                               distance_result &result) {
    report::get().add_call();
    return ovoid::fcl::distance<double>(o1, o2, request, result);
}
EXPORT double CONTINUOUS_MOTIONS(const geometry *o1, const motion *motion1, const geometry *o2, const motion *motion2,
                                 const continuous_request &request, continuous_result &result) {
    report::get().add_call();
    return ovoid::fcl::continuousCollide<double>(o1, motion1, o2, motion2, request, result);
}
EXPORT double CONTINUOUS_GEOMETRIES(const geometry *o1, const transform &begin1, const transform &end1,
                                    const geometry *o2, const transform &begin2, const transform &end2,
                                    const continuous_request &request, continuous_result &result) {
    report::get().add_call();
    return ovoid::fcl::continuousCollide<double>(o1, begin1, end1, o2, begin2, end2, request, result);
}
EXPORT double CONTINUOUS_OBJECTS(const object *o1, const transform &end1, const object *o2, const transform &end2,
                                 const continuous_request &request, continuous_result &result) {
    report::get().add_call();
    return ovoid::fcl::continuousCollide<double>(o1, end1, o2, end2, request, result);
}
EXPORT double COLLIDE_MOVING(const moving *o1, const moving *o2, const continuous_request &request,
                             continuous_result &result) {
    report::get().add_call();
    return ovoid::fcl::collide<double>(o1, o2, request, result);
}

} // extern "C"
