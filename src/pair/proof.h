// Reading a proof: is it safe to compute with, which differences it names, and its witness points.
#ifndef OVOID_PAIR_PROOF_H
#define OVOID_PAIR_PROOF_H

#include "pair/frame.h"
#include "pair/simplex.h"

/// Witness points of the bodies in A's frame, rounding radii included, from a proof.
typedef struct witness_points {
    vec3 a, b;
} witness_points;
witness_points witness_compute_points(const pair_frame *frame, const ovoid_proof *proof);

/// The weighted points of both bodies' hulls, without the radii. The proof must be sound, with entries.
witness_points proof_compute_points(const pair_frame *frame, const ovoid_proof *proof);

/// 1 if the proof's numbers are finite, its indices in range and its weights not all zero: safe to compute with.
int proof_is_sound(const pair_frame *frame, const ovoid_proof *proof);

/// The difference b[i] - a[i] of a proof's entry.
static inline difference proof_difference(const pair_frame *f, const ovoid_proof *p, uint32_t i) {
    return (difference){frame_proof_difference(f, p->a[i], p->b[i]), p->a[i], p->b[i]};
}

#endif
