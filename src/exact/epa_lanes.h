// EPA of a depth: grown in lanes (simd/epa8.h) as far as the common case goes.
#ifndef OVOID_EXACT_EPA_LANES_H
#define OVOID_EXACT_EPA_LANES_H

#include "exact/probe.h"
#include "pair/cover.h"
#include "simd/epa8.h"

/// 1 if the pair's size is such that no direction of the growth, which has the length that it comes with, overflows.
int epa_lanes_serve(const search *s);

/// Grows from the differences of the simplex, one at least, until the depth is known or the case is not common; what is
/// found on the way goes into the search.
epa8_end epa_lanes_grow(epa8 *lanes, const prober *p, const simplex *points);

/// Takes the depth that the surface proves, which ended NARROW, with its witness, and its cover if that is not NULL. 0
/// if that takes a closer look at the surface, then nothing is taken: as where a face may not have the origin behind
/// it.
int epa_lanes_take_depth(search *s, const epa8 *lanes, ovoid_cover *cover);

/// The depth from the surface of an earlier cover, which may hold anything. 1: the query is answered, and *cover (may
/// be NULL) shows the surface as it is now. 0: it is no surface around the origin of these bodies as they are now, or
/// no plain one; nothing is changed.
int epa_lanes_run_kept(search *s, const ovoid_cover *kept, ovoid_cover *cover);

/// The foot of the origin on the plane n.x = low of three corners as evidence, if it lies between them.
int epa_find_foot(const search *s, const difference corner[3], vec3 n, double low, evidence *found);

/// How much n.w of the corners of one face may differ.
static inline double epa_get_face_doubt(const search *s) { return 1100 * 0x1p-53 * s->frame->size; }

/// As in exact/expand.h, for that pair.
static inline double epa_get_slack(const search *s) { return 16 * 0x1p-53 * s->frame->size; }
static inline double epa_get_doubt(const search *s) { return triangle_compute_doubt(s->frame->size, s->frame->claim); }

#endif
