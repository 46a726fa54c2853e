// The interface of a peer of `bench --robot`: queries about a robot among obstacles. A peer is a shared module that
// exports bench_get_robot_peers and needs nothing of libovoid: bodies are plain arrays, as in peer.h. bench --robot
// --peer FILE loads one more. create is not timed, everything else is.
#ifndef OVOID_BENCH_PEERS_ROBOT_PEER_H
#define OVOID_BENCH_PEERS_ROBOT_PEER_H

#include "peers/peer.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum solid_kind { SOLID_HULL, SOLID_BOX, SOLID_CYLINDER, SOLID_CAPSULE, SOLID_SPHERE } solid_kind;

/// A convex solid in its own frame, as a hull and, if it has one, by its kind.
typedef struct solid {
    body hull; ///< for a cylinder the inscribed prism that ovoid uses, for capsules the segment, for spheres the point
    solid_kind kind;
    double size[3]; ///< box: half sizes; cylinder, capsule: radius, half height along z; sphere: radius
} solid;

/// A solid of a link, in that link's frame; an obstacle, in the world: the root link's frame.
typedef struct placed_solid {
    uint32_t solid, link; ///< link: not for obstacles
    ovoid_pose pose;
} placed_solid;

typedef struct robot_scene {
    const char *robot; ///< "panda", "fetch", ...: for peers that have the robot compiled in
    const solid *solids;
    const placed_solid *elements, *obstacles;
    uint32_t solid_count, element_count, obstacle_count, link_count, variable_count;
    const unsigned char *ignored; ///< link_count x link_count: 1 if two links are not queried; symmetric
    double margin;                ///< of `measure`
} robot_scene;

/// States are variable_count numbers each. links: the link_count poses of a state, made by ovoid's kinematics while the
/// clock runs; NULL for a peer with kinematics of its own.
typedef struct robot_peer {
    const char *name;
    int has_kinematics;                       ///< 1: it takes q and no poses
    void *(*create)(const robot_scene *what); ///< NULL: the peer does not know the robot, or cannot create it
    int (*is_hit)(void *self, const double *q, const ovoid_pose *links);
    /// The segment from q0 to q1 at `count` states, evenly spaced, ends included, in any order. NULL: the benchmark
    /// calls is_hit from q0 on.
    int (*is_edge_hit)(void *self, const double *q0, const double *q1, uint32_t count);
    /// How many pairs are within the margin, each with its distance. NULL: it does not measure.
    uint32_t (*measure)(void *self, const double *q, const ovoid_pose *links);
    void (*destroy)(void *self);
} robot_peer;

/// A list that ends with NULL.
__attribute__((visibility("default"))) const robot_peer *const *bench_get_robot_peers(void);

#ifdef __cplusplus
}
#endif
#endif
