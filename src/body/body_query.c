// The queries of two bodies: each goes to the search of its kind, chosen by whether one of them is a solid.
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

void body_find_internal(const ovoid_body_pair *pair, const body_request *request, ovoid_body_answer *out) {
    if (body_pair_has_solid(pair))
        solid_find_internal(pair, request, out);
    else
        parts_find_internal(pair, request, out);
}

static ovoid_body_answer find(const ovoid_body_pair *pair, const ovoid_options *options, query_goal goal,
                              const ovoid_body_evidence *known) {
    OVOID_ASSERT(pair);
    const body_request request = {options, &goal, known ? known->earlier : NULL, known ? known->exclusions : NULL};
    ENVIRONMENT_RETURN_FILLED(ovoid_body_answer, out, goal, body_find_internal(pair, &request, &out));
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
