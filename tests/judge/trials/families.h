// The families of the trials: pairs of every kind of trouble, each made from a seed.
#ifndef OVOID_TRIALS_FAMILIES_H
#define OVOID_TRIALS_FAMILIES_H

#include "ask.h"

/// A pair, which owns its shapes. is_known: the exact signed distance is d, by construction.
typedef struct trial {
    ovoid_shape *a, *b; ///< NULL: this family has no data here
    ovoid_pose pose_a, pose_b;
    int is_known;
    double d;
} trial;

/// Which earlier proof the warm queries of a family are given.
typedef enum earlier_kind {
    EARLIER_ANY,    ///< its own, one of a frame before, one of another pair, one of nothing, by chance
    EARLIER_LAST,   ///< that of the frame before
    EARLIER_STALE,  ///< that of four frames before
    EARLIER_FOREIGN ///< that of another pair
} earlier_kind;

typedef struct family {
    tally counts;
    trial (*make)(uint64_t *state);
    int each;   ///< trials in a round, 0 means 1
    int frames; ///< B moves a little from each to the next; 0 means 1
    int judged; ///< the truth by brute force over all features too: for few vertices
    earlier_kind earlier;
} family;

extern family families[];
extern const size_t family_count;

/// Bodies that meet in a face, an edge or a corner; contacts.c.
trial make_face_to_face(uint64_t *r);
trial make_edge_to_edge(uint64_t *r);
trial make_vertex_to_face(uint64_t *r);
trial make_aligned_boxes(uint64_t *r);
trial make_touching(uint64_t *r);
trial make_shared_vertices(uint64_t *r);
trial make_split(uint64_t *r);

/// What the data folder has: read once, on the first call.
trial make_real_hulls(uint64_t *r);
trial make_compound_parts(uint64_t *r);
void families_forget_data(void);

/// B somewhere around A: far, middle, near, over, in one place.
trial place_anywhere(uint64_t *r, ovoid_shape *a, ovoid_shape *b);
/// Moves B along the normal until the signed distance is about gap.
void close_in(trial *t, double gap);
/// Radius of the smallest sphere around the body.
double sphere_radius(const ovoid_shape *s);

#endif
