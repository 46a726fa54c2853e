// EPA of a depth: grown in lanes (simd/epa8.h) as far as the common case goes.
#ifndef OVOID_EXACT_EPA_LANES_H
#define OVOID_EXACT_EPA_LANES_H

#include "exact/probe.h"
#include "simd/epa8.h"

/// 1 if the pair's size is such that no direction of the growth, which has the length that it comes with, overflows.
int epa_lanes_serve(const search *s);

/// Grows from the differences of the simplex, one at least, until the depth is known or the case is not common; what is
/// found on the way goes into the search. slack, doubt: as in expand.h.
epa8_end epa_lanes_grow(epa8 *lanes, const prober *p, const simplex *points, double slack, double doubt);

/// Takes the depth that the surface proves, which ended NARROW, with its witness. 0 if that takes a closer look at the
/// surface, then nothing is taken: as where a face may not have the origin behind it.
int epa_lanes_take_depth(search *s, const epa8 *lanes);

/// The foot of the origin on the plane n.x = low of three corners as evidence, if it lies between them.
int epa_find_foot(const search *s, const difference corner[3], vec3 n, double low, evidence *found);

/// How much n.w of the corners of one face may differ.
static inline double epa_get_face_doubt(const search *s) { return 1100 * 0x1p-53 * s->frame->size; }

#endif
