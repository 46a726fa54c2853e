// From the state of a search to the answer, and the pipeline that all queries share.
#ifndef OVOID_QUERY_ANSWER_H
#define OVOID_QUERY_ANSWER_H

#include "query/search.h"

/// Witness points of the bodies in A's frame, rounding radii included, as a proof gives them.
typedef struct witness_points {
    vec3 a, b;
} witness_points;
witness_points witness_compute_points(const pair_frame *frame, const ovoid_proof *proof);

/// 1 if the proof's numbers are finite, its indices in range and its weights sum to something: safe to compute with.
int proof_is_sound(const pair_frame *frame, const ovoid_proof *proof);

/// The difference b[i] - a[i] of a proof's entry.
static inline difference proof_difference(const pair_frame *f, const ovoid_proof *p, uint32_t i) {
    return (difference){frame_difference(f, p->a[i], p->b[i]), p->a[i], p->b[i]};
}

/// An upper bound of d below zero from a point strictly inside both inner ellipsoids, or 0 if that is not proven.
/// x: in A's body frame. Solids only.
double inner_compute_upper(const pair_frame *frame, vec3 x);

/// An upper bound of d from a point of each inner ellipsoid, each in its body frame; infinity if one is outside.
double inner_points_compute_upper(const pair_frame *frame, vec3 a, vec3 b, double error);

/// The answer, widened to hold after rounding.
ovoid_answer answer_make(search *s);

/// The answer of a query that was refused: no bracket.
ovoid_answer answer_make_refused(ovoid_limit limit);

/// 1 if the options' numbers make sense; fills in the defaults.
int options_make(const ovoid_options *given, ovoid_options *options);

/// The whole pipeline for one question; cover may be NULL.
ovoid_answer answer_find(const ovoid_pair *pair, const ovoid_options *given, question ask, const ovoid_proof *earlier,
                         ovoid_cover *cover);

#endif
