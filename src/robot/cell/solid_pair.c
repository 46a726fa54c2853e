// Solids among a robot's bodies, by the queries of <ovoid/body.h>. docs/robot-states.md has the bracket.
#include "robot/cell/solid_pair.h"

static ovoid_body_pair get_bodies(const ovoid_pair *hulls, const solid_sides *s) {
    ovoid_body_pair pair = {{.pose = hulls->pose_a, .solid = s->a}, {.pose = hulls->pose_b, .solid = s->b}};
    if (!s->a) pair.a.shape = hulls->shape_a;
    if (!s->b) pair.b.shape = hulls->shape_b;
    return pair;
}

static ovoid_answer make_answer(const ovoid_body_answer *found, const ovoid_answer *of_hulls, double clear) {
    ovoid_answer answer = ovoid_body_answer_get_answer(found);
    if (!(answer.lower > clear)) answer.lower = of_hulls->lower;
    return answer;
}

ovoid_answer solid_pair_within(const ovoid_pair *hulls, const solid_sides *solids, double margin,
                               const ovoid_answer *of_hulls, double clear) {
    ovoid_body_pair pair = get_bodies(hulls, solids);
    ovoid_body_answer found = ovoid_body_within(&pair, margin, NULL, NULL);
    return make_answer(&found, of_hulls, clear);
}

ovoid_answer solid_pair_distance(const ovoid_pair *hulls, const solid_sides *solids, const ovoid_options *options,
                                 const ovoid_answer *of_hulls, double clear) {
    ovoid_body_pair pair = get_bodies(hulls, solids);
    ovoid_body_answer found = ovoid_body_distance(&pair, options, NULL);
    return make_answer(&found, of_hulls, clear);
}
