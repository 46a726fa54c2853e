// Queries of prepared shapes: what a pose alone decides was computed when they were made.
#include "base/compiler.h"
#include "base/environment.h"
#include "linear/pose.h"
#include "linear/rotation.h"
#include "query/answer.h"
#include "query/begin.h"

#include <string.h>

static void set_ready(const ovoid_posed_shape *body, ovoid_prepared_shape *to) {
    const ovoid_shape *shape = body->shape;
    mat3 r = quat_to_mat3(body->pose.rotation);
    memcpy(to->rotation, &r, sizeof to->rotation);
    to->center = mat3_mul_vec3(r, shape->center);
    to->first = mat3_mul_vec3(r, shape->first);
    if (shape->padded_count > OVOID_PREPARED_VERTICES) return;
    uint32_t count = to->turned_count = shape->padded_count;
    simd_points points = shape_get_points(shape);
    static const double nowhere[3] = {0, 0, 0};
    simd_pose_points(&points, to->rotation, nowhere,
                     (double *[]){to->turned, to->turned + count, to->turned + 2 * (size_t)count});
}

static void make(const ovoid_posed_shape *body, ovoid_prepared_shape *to) {
    to->body = *body;
    to->turned_count = 0;
    // The place of a far origin is found for a pair.
    to->is_ready = body->shape && !body->shape->has_origin && pose_validate(&body->pose) == OVOID_OK;
    if (to->is_ready) set_ready(body, to);
}

void ovoid_prepared_shape_make(const ovoid_posed_shape *body, ovoid_prepared_shape *prepared) {
    ENVIRONMENT_RUN(make(body, prepared));
}

// ---- queries

static void write_evidence(const ovoid_evidence *to, const ovoid_answer *answer) {
    if (to->proof) *to->proof = answer->proof;
    if (to->witness) *to->witness = (ovoid_witness){answer->point_a, answer->point_b, answer->normal};
    if (to->answer) *to->answer = *answer;
}

static ovoid_pair get_pair(ovoid_prepared_pair pair) {
    return (ovoid_pair){pair.a->body.shape, pair.b->body.shape, pair.a->body.pose, pair.b->body.pose};
}

// The query of the pair as if its bodies were not prepared.
COMPILER_NOINLINE static ovoid_verdict find_afresh(ovoid_prepared_pair both, const query_request *request,
                                                   const ovoid_evidence *out) {
    ovoid_pair pair = get_pair(both);
    ovoid_answer answer;
    answer_find_internal(&pair, request, &answer);
    if (out) write_evidence(out, &answer);
    return answer_get_verdict(&answer);
}

COMPILER_NOINLINE static ovoid_verdict search_on(ovoid_prepared_pair both, const placed_query *query,
                                                 const ovoid_evidence *out) {
    ovoid_pair pair = get_pair(both);
    const open_query open = {&pair, *query, NULL};
    ovoid_answer answer;
    answer_run_search(&open, &answer);
    if (out) write_evidence(out, &answer);
    return answer_get_verdict(&answer);
}

// A rejection by the spheres; rejection_make_answer, without evidence.
static inline ovoid_verdict end_at_spheres(ovoid_prepared_pair pair, const pair_frame *f, const rejection *found,
                                           const query_goal *goal) {
    vec3 d = vec3_add(f->offset, vec3_sub(pair.b->first, pair.a->first));
    double upper = vec3_norm(d) - f->upper_radii + reject_get_claim(f);
    ovoid_limit limit = upper - found->lower <= goal->tolerance ? OVOID_LIMIT_NONE : goal->beyond;
    return (ovoid_verdict){OVOID_SEPARATED, found->stage, limit, 0, found->lower, upper};
}

static ovoid_verdict end_at_rejection(const pair_frame *f, const rejection *found, const query_goal *goal,
                                      const ovoid_evidence *out) {
    ovoid_answer answer = rejection_make_answer(found, f, goal);
    if (out) write_evidence(out, &answer);
    return answer_get_verdict(&answer);
}

static ovoid_verdict end_at_small(const pair_frame *f, const small_end *end, const query_goal *goal,
                                  const ovoid_evidence *out) {
    if (out) {
        if (out->proof) *out->proof = answer_make_small_proof(end);
        if (out->witness) *out->witness = answer_make_small_witness(end, f);
        if (out->answer) *out->answer = answer_make_small(end, f, goal);
    }
    return answer_make_small_verdict(end, goal);
}

// The query of bodies that the spheres do not separate, or one whose evidence is wanted.
COMPILER_NOINLINE static ovoid_verdict find_near(ovoid_prepared_pair pair, const ovoid_options *given,
                                                 const query_goal *wanted, const ovoid_evidence *out) {
    const ovoid_proof *earlier = out ? out->proof : NULL;
    ovoid_options options;
    query_goal goal = *wanted;
    if (!(pair.a->is_ready & pair.b->is_ready) || !options_make(given, &options) || !(goal.far >= 0))
        return find_afresh(pair, &(query_request){given, wanted, earlier, NULL}, out);
    pair_frame frame;
    rejection found;
    small_end end;
    frame_place_prepared(pair.a, pair.b, &frame);
    frame_place_rotations(pair.a, pair.b, &frame);
    set_numbers(&goal, &options, &frame);
    if (reject_by_spheres(&frame, goal.far, &found)) return end_at_rejection(&frame, &found, &goal, out);
    const placed_query query = {&frame, &goal, earlier, found.lower};
    switch (begin_after_spheres(&query, &found, &end)) {
    case BEGIN_REJECTED: return end_at_rejection(&frame, &found, &goal, out);
    case BEGIN_SMALL: return end_at_small(&frame, &end, &goal, out);
    default: frame_relate(&frame); return search_on(pair, &query, out);
    }
}

// What it computes for the spheres stays in registers: no function but inline ones sees the frame.
COMPILER_NOINLINE static ovoid_verdict find(ovoid_prepared_pair pair, const ovoid_options *given,
                                            const query_goal *wanted, const ovoid_evidence *out) {
    ovoid_options options;
    query_goal goal = *wanted;
    pair_frame frame;
    rejection found;
    if (out || !(pair.a->is_ready & pair.b->is_ready) || !options_make(given, &options) || !(goal.far >= 0))
        return find_near(pair, given, wanted, out);
    frame_place_prepared(pair.a, pair.b, &frame);
    set_numbers(&goal, &options, &frame);
    if (!reject_by_spheres(&frame, goal.far, &found)) return find_near(pair, given, wanted, NULL);
    return end_at_spheres(pair, &frame, &found, &goal);
}

static ovoid_verdict run(ovoid_prepared_pair pair, const ovoid_options *given, const query_goal *goal,
                         const ovoid_evidence *out) {
    ENVIRONMENT_RETURN_CALL(find(pair, given, goal, out));
}

ovoid_verdict ovoid_prepared_collide(ovoid_prepared_pair pair, const ovoid_options *options,
                                     const ovoid_evidence *out) {
    const query_goal goal = query_goal_make_collide();
    return run(pair, options, &goal, out);
}

ovoid_verdict ovoid_prepared_within(ovoid_prepared_pair pair, double margin, const ovoid_options *options,
                                    const ovoid_evidence *out) {
    const query_goal goal = query_goal_make_within(margin);
    return run(pair, options, &goal, out);
}

ovoid_verdict ovoid_prepared_distance(ovoid_prepared_pair pair, const ovoid_options *options,
                                      const ovoid_evidence *out) {
    const query_goal goal = query_goal_make_distance(options);
    return run(pair, options, &goal, out);
}

ovoid_verdict ovoid_prepared_depth(ovoid_prepared_pair pair, const ovoid_options *options, const ovoid_evidence *out) {
    const query_goal goal = query_goal_make_depth(options);
    return run(pair, options, &goal, out);
}
