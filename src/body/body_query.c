// The queries of two bodies: each goes to the search of its kind, chosen by whether one of them is a solid.
#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "body/body_find.h"

ovoid_body_answer ovoid_body_answer_make(const ovoid_answer *deciding, uint32_t part_a, uint32_t part_b) {
    return (ovoid_body_answer){.status = deciding->status,
                               .limit = deciding->limit,
                               .lower = deciding->lower,
                               .upper = deciding->upper,
                               .part_a = part_a,
                               .part_b = part_b,
                               .deciding = *deciding};
}

ovoid_answer ovoid_body_answer_get_answer(const ovoid_body_answer *answer) {
    ovoid_answer own = answer->deciding;
    own.status = answer->status;
    own.limit = answer->limit;
    own.lower = answer->lower;
    own.upper = answer->upper;
    return own;
}

static int find_or_look(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out,
                        far_bodies *far) {
    return body_pair_has_solid(pair) ? solid_find(pair, request, out, far) : parts_find(pair, request, out, far);
}

void body_find_internal(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out) {
    far_bodies far;
    if (find_or_look(pair, request, out, &far)) *out = (ovoid_body_answer)FAR_ANSWER(&far);
}

// By value, from a function that is not inlined: the answer of far bodies is made in the caller's place, since its
// copy would take longer than the look.
COMPILER_NOINLINE static ovoid_body_answer find_by_value(const ovoid_body_pair *pair, const body_request *request) {
    ovoid_body_answer out;
    far_bodies far;
    if (find_or_look(pair, request, &out, &far)) return (ovoid_body_answer)FAR_ANSWER(&far);
    return out;
}

static ovoid_body_answer find(const ovoid_body_pair *pair, const ovoid_options *options, query_goal goal,
                              const ovoid_body_evidence *known) {
    OVOID_ASSERT(pair);
    const body_request request = {options, &goal, known ? known->earlier : NULL, known ? known->exclusions : NULL};
    ENVIRONMENT_RETURN_CALL(find_by_value(pair, &request));
}

ovoid_body_answer ovoid_body_collide(const ovoid_body_pair *pair, const ovoid_options *options,
                                     const ovoid_body_evidence *known) {
    return find(pair, options, query_goal_make_collide(), known);
}
ovoid_body_answer ovoid_body_within(const ovoid_body_pair *pair, double margin, const ovoid_options *options,
                                    const ovoid_body_evidence *known) {
    return find(pair, options, query_goal_make_within(margin), known);
}
ovoid_body_answer ovoid_body_distance(const ovoid_body_pair *pair, const ovoid_options *options,
                                      const ovoid_body_evidence *known) {
    return find(pair, options, query_goal_make_distance(options), known);
}
ovoid_body_answer ovoid_body_depth(const ovoid_body_pair *pair, const ovoid_options *options,
                                   const ovoid_body_evidence *known) {
    return find(pair, options, query_goal_make_depth(options), known);
}

int ovoid_body_answer_is_within(const ovoid_body_answer *x, double margin) {
    return x->upper <= margin ? 1 : x->lower > margin ? 0 : -1;
}

ovoid_body_proof ovoid_body_answer_get_proof(const ovoid_body_answer *x) {
    return (ovoid_body_proof){x->part_a, x->part_b, x->deciding.proof};
}
