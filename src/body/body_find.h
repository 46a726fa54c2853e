// Two bodies of any kind, for callers that ask about bodies whatever they are.
#ifndef OVOID_BODY_BODY_FIND_H
#define OVOID_BODY_BODY_FIND_H

#include "body/first_look.h"
#include "query/answer.h"

static inline int body_pair_has_solid(const ovoid_body_pair *pair) { return pair->a.solid || pair->b.solid; }

/// The options of a query of bodies of that size become those of its pairs of parts: the tolerance of the bodies.
static inline void options_take_size(ovoid_options *options, double size) {
    options->absolute_tolerance = options_compute_tolerance(options, size, 0);
}

/// What is asked of two bodies.
typedef struct body_request {
    const ovoid_options *options; ///< as the caller gave them; NULL: the default
    const query_goal *goal;
    const ovoid_body_proof *earlier; ///< of an earlier call, or NULL
    ovoid_exclusions *exclusions;    ///< room for what is left out, or NULL
} body_request;

/// Of a pair with a solid. The goal's depth is not searched for. 1: the bodies are farther apart than was asked, which
/// is in *far, and *out is not written; 0: *out is the answer.
int solid_find(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out, far_bodies *far);
/// Of a pair without a solid, written as solid_find writes it.
int parts_find(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out, far_bodies *far);

/// The pipeline of ovoid_body_collide and its sisters, for callers inside a public function, which has set the default
/// floating-point environment already.
void body_find_internal(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out);

#endif
