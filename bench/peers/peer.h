// The interface of a contestant, ovoid or a peer. A peer is a shared module (MODULE.so) that exports bench_get_peers;
// it receives bodies as plain arrays and needs nothing of libovoid. bench --peer FILE loads one more.
#ifndef OVOID_BENCH_PEERS_PEER_H
#define OVOID_BENCH_PEERS_PEER_H

#include <ovoid/linear.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A convex solid in its own frame.
typedef struct body {
    const void *shape; ///< ovoid's shape; for ovoid alone
    const double *vertices;
    const uint32_t *triangles; ///< counter-clockwise from outside
    const uint32_t *neighbor_starts, *neighbors;
    uint32_t vertex_count, triangle_count;
    ovoid_vec3 center; ///< a point inside
} body;

/// Two bodies, posed by unit quaternions. size: the sum of the radii of their enclosing spheres.
typedef struct placed {
    uint32_t a, b;
    ovoid_pose pose_a, pose_b;
    double size, margin; ///< margin: of QUESTION_WITHIN, one for all pairs of a workload
} placed;

typedef enum question {
    QUESTION_COLLIDE,
    QUESTION_WITHIN,
    QUESTION_DISTANCE, ///< and the nearest points
    QUESTION_DEPTH,    ///< and the normal
    QUESTION_COUNT
} question;

/// Pairs to query. With tracks > 0, pair i is one frame after pair i - tracks: the same bodies, moved a little.
typedef struct workload {
    char name[40];
    uint32_t vertices; ///< of each body; 0 if they differ
    const body *bodies;
    const placed *pairs;
    uint32_t body_count, pair_count, tracks;
    unsigned questions; ///< bit 1 << question: the question is asked here
} workload;

/// A contestant's answer about one pair.
typedef enum verdict { VERDICT_NO, VERDICT_YES, VERDICT_NONE } verdict;
typedef struct found {
    verdict yes;     ///< they touch, or are within the margin; NONE: it gave up
    double distance; ///< of DISTANCE; of DEPTH: the depth, positive
    ovoid_vec3 point_a, point_b, normal;
} found;

typedef struct peer {
    const char *name;
    unsigned questions;                    ///< bit 1 << question: the contestant answers the question
    unsigned warm;                         ///< bit 1 << question: the contestant can start from the last frame
    int is_float;                          ///< single precision
    void *(*create)(const workload *work); ///< bodies and poses in its own form; not timed. NULL: it cannot
    /// All pairs in order, one answer each. warm: with the state that it keeps from frame to frame, none for the first
    /// frame.
    void (*run)(void *self, question what, int warm, found *answers);
    void (*destroy)(void *self);
} peer;

/// A list that ends with NULL.
__attribute__((visibility("default"))) const peer *const *bench_get_peers(void);

#ifdef __cplusplus
}
#endif
#endif
