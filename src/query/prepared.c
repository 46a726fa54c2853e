// Queries of prepared shapes: what a pose alone decides was computed when they were made.
//
// A rotation matrix m is used as it is, without a quaternion's way back to a matrix, where its columns are those of a
// rotation to MATRIX_ROUNDING, and the third is the cross product of the others. Let T be the sum of the deviations, u
// = 2^-53. The sum that is computed is off T by less than 14 u, and m is within T of a rotation R in the Frobenius
// norm: that by Gram and Schmidt. The pose's quaternion is a row of 4 q q', linear in the entries of m (S. W. Shepperd,
// Quaternion from rotation matrix, 1978). With |m - R| <= e the row is off by sqrt(3) e, and it is sqrt(2) long or
// longer, so R(q) is off R by 2.45 e, and by 8 u of rounding: |m - R(q)| <= 3.45 e + 8 u < 170 u for e = 46 u.
// FRAME_MATRIX has the bounds widened by it. A search in the frame of A starts again from the pose.
#include "base/compiler.h"
#include "base/environment.h"
#include "linear/pose.h"
#include "linear/rotation.h"
#include "query/answer.h"
#include "query/begin.h"

static const mat3 identity = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// Matrices go number by number, as they have just been written: a copy by wider pieces would wait for that.
static inline mat3 read_rows(const double *rows) {
    return (mat3){{rows[0], rows[1], rows[2]}, {rows[3], rows[4], rows[5]}, {rows[6], rows[7], rows[8]}};
}
static inline void write_rows(const mat3 *m, double *rows) {
    rows[0] = m->r0.x, rows[1] = m->r0.y, rows[2] = m->r0.z;
    rows[3] = m->r1.x, rows[4] = m->r1.y, rows[5] = m->r1.z;
    rows[6] = m->r2.x, rows[7] = m->r2.y, rows[8] = m->r2.z;
}

// Sets what follows from the rotation, but for the turned vertices. m: NULL of a body that is not rotated; ready:
// is_ready of a shape that can be placed.
COMPILER_INLINED void set_rotation(const mat3 *m, uint32_t ready, ovoid_prepared_shape *to) {
    const ovoid_shape *shape = to->body.shape;
    write_rows(m ? m : &identity, to->rotation);
    to->turned_count = 0;
    // The place of a far origin is found for a pair.
    to->is_ready = shape && !shape->has_origin ? ready : 0;
    if (!to->is_ready) return;
    to->first = m ? mat3_mul_vec3(*m, shape->first) : shape->first;
    to->center = m ? mat3_mul_vec3(*m, shape->center) : shape->center;
}

static void turn_vertices(ovoid_prepared_shape *to) {
    const ovoid_shape *shape = to->body.shape;
    if (shape->padded_count > OVOID_PREPARED_VERTICES) return;
    uint32_t count = to->turned_count = shape->padded_count;
    simd_points points = shape_get_points(shape);
    static const double nowhere[3] = {0, 0, 0};
    simd_pose_points(&points, to->rotation, nowhere,
                     (double *[]){to->turned, to->turned + count, to->turned + 2 * (size_t)count});
}

#define MATRIX_ROUNDING (32 * 0x1p-53)

// 1: the columns are those of a rotation, but for roundings. Of NaN they are not.
static int is_near_rotation(const mat3 *m) {
    vec3 x = {m->r0.x, m->r1.x, m->r2.x}, y = {m->r0.y, m->r1.y, m->r2.y}, z = {m->r0.z, m->r1.z, m->r2.z};
    vec3 off = vec3_sub(vec3_cross(x, y), z);
    double sum = (fabs(vec3_norm_squared(x) - 1) + fabs(vec3_norm_squared(y) - 1)) + fabs(vec3_dot(x, y));
    return sum + ((fabs(off.x) + fabs(off.y)) + fabs(off.z)) <= MATRIX_ROUNDING;
}

// A quaternion of a rotation, of no particular length. The row of q.w is exact enough where the turn is below 138
// degrees; otherwise that with the largest entry on the diagonal. All rows are there before one is chosen: of turns
// that no one foresees a branch costs more than their sums.
static ovoid_quat find_quat(const mat3 *m) {
    double x = m->r0.x, y = m->r1.y, z = m->r2.z, trace = x + y + z;
    double wx = m->r2.y - m->r1.z, wy = m->r0.z - m->r2.x, wz = m->r1.x - m->r0.y;
    double xy = m->r1.x + m->r0.y, xz = m->r0.z + m->r2.x, yz = m->r2.y + m->r1.z;
    const ovoid_quat rows[4] = {
        {1 + trace, wx, wy, wz}, {wx, 1 + x - y - z, xy, xz}, {wy, xy, 1 - x + y - z, yz}, {wz, xz, yz, 1 - x - y + z}};
    int largest = 3 - (y >= z);
    largest -= (largest - 1) * ((x >= y) & (x >= z));
    return rows[largest * !(trace > -0.5)];
}

static void make(const ovoid_posed_shape *body, ovoid_prepared_shape *to) {
    to->body = *body;
    to->turned_count = to->is_ready = 0;
    if (pose_validate(&body->pose) != OVOID_OK) return;
    mat3 m = quat_to_mat3(body->pose.rotation);
    set_rotation(&m, 1, to);
    if (to->is_ready) turn_vertices(to);
}

void ovoid_prepared_shape_make(const ovoid_posed_shape *body, ovoid_prepared_shape *prepared) {
    ENVIRONMENT_RUN(make(body, prepared));
}

// By a matrix that is off by more than roundings, or a pose that is none: the queries refuse that.
COMPILER_NOINLINE static ovoid_code make_from_nearest(const mat3 *m, ovoid_prepared_shape *to) {
    ovoid_posed_shape body = {to->body.shape, {to->body.pose.position, {0, 0, 0, 0}}};
    double rotation[9];
    write_rows(m, rotation);
    ovoid_code code = pose_make_matrix(rotation, body.pose.position, &body.pose, NULL);
    make(&body, to);
    return code;
}

static ovoid_code make_matrix(const double *rotation, ovoid_prepared_shape *to) {
    int is_placed = position_is_valid(to->body.pose.position);
    if (!rotation) {
        if (!is_placed) return make_from_nearest(&identity, to);
        to->body.pose.rotation = (ovoid_quat){1, 0, 0, 0};
        set_rotation(NULL, 1, to);
        return OVOID_OK;
    }
    const mat3 m = read_rows(rotation);
    if (!is_near_rotation(&m) || !is_placed) return make_from_nearest(&m, to);
    to->body.pose.rotation = find_quat(&m);
    set_rotation(&m, 1 | FRAME_BY_MATRIX, to);
    return OVOID_OK;
}

ovoid_code ovoid_prepared_shape_make_matrix(const ovoid_shape *shape, const double rotation[9], ovoid_vec3 position,
                                            ovoid_prepared_shape *prepared) {
    if (!prepared) return OVOID_ERROR_ARGUMENT;
    prepared->body.shape = shape;
    prepared->body.pose.position = position;
    ENVIRONMENT_RETURN_CALL(make_matrix(rotation, prepared));
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
    const open_query open = {&pair, *query, NULL, NULL};
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
    if (out && out->proof && !out->witness && !out->answer) return rejection_write_proof(found, f, goal, out->proof);
    ovoid_answer answer = rejection_make_answer(found, f, goal);
    if (out) write_evidence(out, &answer);
    return answer_get_verdict(&answer);
}

static inline ovoid_verdict end_at_small(const pair_frame *f, const small_end *end, const query_goal *goal,
                                         const ovoid_evidence *out) {
    if (out) {
        if (out->proof) answer_write_small_proof(end, out->proof);
        if (out->witness && end->has_witness)
            *out->witness = (ovoid_witness){end->point_a, end->point_b, end->normal};
        else if (out->witness)
            answer_write_small_witness(end, f, out->witness);
        if (out->answer) *out->answer = answer_make_small(end, f, goal);
    }
    return answer_make_small_verdict(end, goal);
}

// 1 if the whole proof or answer is wanted.
static inline int wants_proof(const ovoid_evidence *out) { return out && (out->proof || out->answer); }

// The query of bodies that the spheres do not separate, or one whose evidence is wanted.
COMPILER_NOINLINE static ovoid_verdict find_near(ovoid_prepared_pair pair, const ovoid_options *given,
                                                 const query_goal *wanted, const ovoid_evidence *out) {
    const ovoid_proof *earlier = out ? out->proof : NULL;
    ovoid_options options;
    query_goal goal = *wanted;
    if (!(pair.a->is_ready & pair.b->is_ready) || !options_make(given, &options) || !(goal.far >= 0))
        return find_afresh(pair, &(query_request){.options = given, .goal = wanted, .earlier = earlier}, out);
    pair_frame frame;
    rejection found;
    small_end end;
    frame_place_prepared(pair.a, pair.b, &frame);
    frame_place_rotations(pair.a, pair.b, &frame);
    set_numbers(&goal, &options, &frame);
    if (reject_by_spheres(&frame, goal.far, &found)) return end_at_rejection(&frame, &found, &goal, out);
    const placed_query query = {&frame, &goal, earlier, found.lower, out ? !wants_proof(out) : BARE_ANSWER};
    switch (begin_after_spheres(&query, &found, &end)) {
    case BEGIN_REJECTED: return end_at_rejection(&frame, &found, &goal, out);
    case BEGIN_SMALL: return end_at_small(&frame, &end, &goal, out);
    default: break;
    }
    if ((pair.a->is_ready | pair.b->is_ready) & FRAME_BY_MATRIX)
        return find_afresh(pair, &(query_request){.options = given, .goal = wanted, .earlier = earlier}, out);
    frame_relate(&frame);
    return search_on(pair, &query, out);
}

// 1 if the spheres alone may answer: a verdict that a rejection gives, or two bodies that are spheres.
static inline int may_end_at_spheres(ovoid_prepared_pair pair, const query_goal *goal, const ovoid_evidence *out) {
    if (!(pair.a->is_ready & pair.b->is_ready) || wants_proof(out)) return 0;
    return (!out && goal->far < INFINITY) || closed_are_origins(pair.a->body.shape, pair.b->body.shape);
}

// What it computes for the spheres stays in registers: no function but inline ones sees the frame.
COMPILER_NOINLINE static ovoid_verdict find(ovoid_prepared_pair pair, const ovoid_options *given,
                                            const query_goal *wanted, const ovoid_evidence *out) {
    ovoid_options options;
    query_goal goal = *wanted;
    pair_frame frame;
    rejection found;
    small_end end;
    if (!may_end_at_spheres(pair, &goal, out) || !options_make(given, &options) || !(goal.far >= 0))
        return find_near(pair, given, wanted, out);
    frame_place_prepared(pair.a, pair.b, &frame);
    set_numbers(&goal, &options, &frame);
    if (reject_by_spheres(&frame, goal.far, &found))
        return out ? find_near(pair, given, wanted, out) : end_at_spheres(pair, &frame, &found, &goal);
    const placed_query query = {&frame, &goal, NULL, found.lower, 1};
    if (closed_are_origins(frame.a, frame.b) && closed_run_origins(&query, &end))
        return end_at_small(&frame, &end, &goal, out);
    return find_near(pair, given, wanted, out);
}

static ovoid_verdict run(ovoid_prepared_pair pair, const ovoid_options *given, const query_goal *goal,
                         const ovoid_evidence *out) {
    ENVIRONMENT_RETURN_CALL(find(pair, given, goal, out));
}

ovoid_verdict ovoid_prepared_collide(ovoid_prepared_pair pair, const ovoid_options *options,
                                     const ovoid_evidence *out) {
    return run(pair, options, &query_goal_collide, out);
}

ovoid_verdict ovoid_prepared_within(ovoid_prepared_pair pair, double margin, const ovoid_options *options,
                                    const ovoid_evidence *out) {
    const query_goal goal = query_goal_make_within(margin);
    return run(pair, options, &goal, out);
}

ovoid_verdict ovoid_prepared_distance(ovoid_prepared_pair pair, const ovoid_options *options,
                                      const ovoid_evidence *out) {
    if (!options) return run(pair, NULL, &query_goal_distance, out);
    const query_goal goal = query_goal_make_distance(options);
    return run(pair, options, &goal, out);
}

ovoid_verdict ovoid_prepared_depth(ovoid_prepared_pair pair, const ovoid_options *options, const ovoid_evidence *out) {
    const query_goal goal = query_goal_make_depth(options);
    return run(pair, options, &goal, out);
}
