// The exact distance of two polyhedra by the algorithm of Gilbert, Johnson and Keerthi.
#ifndef OVOID_EXACT_GJK_H
#define OVOID_EXACT_GJK_H

#include "pair/search.h"

/// How a run ended.
typedef enum gjk_end {
    GJK_ANSWERED,  ///< the query is answered
    GJK_CONTACT,   ///< the origin lies in the simplex, to rounding
    GJK_STALLED,   ///< no further progress in doubles
    GJK_ITERATIONS ///< the limit was reached
} gjk_end;

/// Runs from the simplex (1 to 4 differences), which holds the last simplex afterwards.
gjk_end gjk_run(search *s, simplex *points);

#endif
