// Everything that is wanted of a lane is made from numbers in registers and stored once: a proof or an answer made in a
// variable and copied would be waited for.
#include "query/batch_ends.h"

#include "base/compiler.h"

// A lane's numbers.
typedef struct lane_end {
    ovoid_verdict verdict;
    vec3 a, b, normal; ///< points and normal, world
} lane_end;

// What only a proof says.
typedef struct lane_corners {
    double w0, w1, w2;
    uint32_t count, a0, a1, a2, b0, b1, b2; ///< corners; zero of those that are none
} lane_corners;

COMPILER_INLINED ovoid_verdict make_verdict(const group_result *r, unsigned k, const query_goal *goal) {
    small_end end;
    end.lower = r->nearest.lower.lane[k];
    end.upper = r->nearest.upper.lane[k];
    end.iterations = r->steps[k];
    end.stage = end.iterations > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT;
    end.kind = OVOID_PROOF_POINTS;
    return answer_make_small_verdict(&end, goal);
}

// The proof, the whole answer.
static void write_proof(const ovoid_batch *to, size_t index, const lane_end *x, const group_result *r, unsigned k) {
    const lane_column *w = r->nearest.weight;
    uint32_t count = r->count[k];
    const lane_corners c = {.w0 = w[0].lane[k],
                            .w1 = w[1].lane[k],
                            .w2 = w[2].lane[k],
                            .count = count,
                            .a0 = r->a[k][0],
                            .a1 = count > 1 ? r->a[k][1] : 0,
                            .a2 = count > 2 ? r->a[k][2] : 0,
                            .b0 = r->b[k][0],
                            .b1 = count > 1 ? r->b[k][1] : 0,
                            .b2 = count > 2 ? r->b[k][2] : 0};
    ovoid_answer *out = to->answers ? &to->answers[index] : NULL;
    ovoid_proof *proof = out ? &out->proof : &to->proofs[index];
    *proof = (ovoid_proof){.normal = {x->normal.x, x->normal.y, x->normal.z},
                           .kind = OVOID_PROOF_POINTS,
                           .count = c.count,
                           .a = {c.a0, c.a1, c.a2},
                           .b = {c.b0, c.b1, c.b2},
                           .weight_a = {c.w0, c.w1, c.w2},
                           .weight_b = {c.w0, c.w1, c.w2}};
    if (!out) return;
    out->status = x->verdict.status;
    out->stage = x->verdict.stage;
    out->limit = x->verdict.limit;
    out->iterations = x->verdict.iterations;
    out->lower = x->verdict.lower;
    out->upper = x->verdict.upper;
    out->point_a = x->a;
    out->point_b = x->b;
    out->normal = x->normal;
    if (to->proofs) to->proofs[index] = *proof;
}

static void end_lane(const group_search *task, const lane_group *e, unsigned k, const group_result *r,
                     const query_goal *goal) {
    const group_nearest *n = &r->nearest;
    const ovoid_posed_shape *a = get_a(e, k);
    small_points points = {get3(n->point_a, k), get3(n->point_b, k)};
    vec3 normal = get3(n->normal, k);
    if (e->lanes->radii.lane[k] > 0) {
        pair_frame f;
        f.a = a->shape;
        f.b = get_b(e, k)->shape;
        small_points_add_radii(&points, &f, normal);
    }
    const lane_end end = {make_verdict(r, k, goal), vec3_add(a->pose.position, points.a),
                          vec3_add(a->pose.position, points.b), normal};
    const ovoid_batch *to = task->to;
    size_t index = e->index[k];
    if (to->verdicts) to->verdicts[index] = end.verdict;
    if (to->witnesses)
        to->witnesses[index] =
            (ovoid_witness){{end.a.x, end.a.y, end.a.z}, {end.b.x, end.b.y, end.b.z}, {normal.x, normal.y, normal.z}};
    if (to->proofs || to->answers) write_proof(to, index, &end, r, k);
}

void group_end_at_points(const group_search *task, const lane_group *e, unsigned lanes, const group_result *r) {
    query_goal goal = *task->goal;
    for (; lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        goal.tolerance = e->lanes->tolerance.lane[k];
        if (query_goal_is_met(&goal, r->nearest.lower.lane[k], r->nearest.upper.lane[k]))
            end_lane(task, e, k, r, &goal);
        else
            group_finish(task, e->index[k], NULL, NULL);
    }
}
