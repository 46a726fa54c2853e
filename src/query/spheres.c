// The same steps as of any pair (query/answer.c), of bodies that no rotation changes: no matrix is made, and the frame
// stays in registers, as only inline functions see it. What is not answered here goes through the pipeline.
#include "query/spheres.h"

#include "exact/closed.h"
#include "linear/rotation.h"
#include "query/begin.h"

static int is_place(vec3 p) {
    return (fabs(p.x) <= OVOID_LENGTH_MAX) & (fabs(p.y) <= OVOID_LENGTH_MAX) & (fabs(p.z) <= OVOID_LENGTH_MAX);
}

// 1 for a pose that is valid, whose quaternion needs no scaling.
static int is_plain(const ovoid_pose *pose) {
    return is_place(pose->position) & quat_is_plain(quat_norm_squared(pose->rotation));
}

// What frame_place sets, but for the rotations.
static inline void place(const ovoid_pair *pair, pair_frame *f) {
    f->a = pair->shape_a;
    f->b = pair->shape_b;
    f->world_origin = pair->pose_a.position;
    f->offset = f->between = vec3_sub(pair->pose_b.position, pair->pose_a.position);
    f->hidden = OVOID_LENGTH_MIN;
    frame_set_lengths(f);
}

ovoid_answer spheres_find(const ovoid_pair *pair, const query_request *request) {
    ovoid_options options;
    query_goal goal = *request->goal;
    pair_frame f;
    rejection found;
    small_end end;
    if (!options_make(request->options, &options) || !(goal.far >= 0) || !is_plain(&pair->pose_a) ||
        !is_plain(&pair->pose_b))
        return answer_find_by_value(pair, request);
    place(pair, &f);
    set_numbers(&goal, &options, &f);
    if (reject_by_spheres(&f, goal.far, &found)) return answer_find_by_value(pair, request);
    if (!closed_is_moderate(&f)) return answer_find_by_value(pair, request);
    closed_points points = closed_find_points(f.offset);
    double claim = reject_get_claim(&f);
    end.lower = points.gap - f.lower_radii - claim;
    end.upper = points.distance - f.upper_radii + claim;
    if (!closed_is_answered(&goal, end.lower, end.upper)) return answer_find_by_value(pair, request);
    end.kind = OVOID_PROOF_POINTS;
    end.stage = OVOID_STAGE_SUPPORT;
    end.iterations = 0;
    // The difference's direction is the normal.
    vec3 a = f.world_origin, b = vec3_add(a, f.offset);
    closed_set_witness(&f, &(closed_cores){a, b, points.normal}, &end);
    if (request->cover && !goal.has_cover) request->cover->point_count = request->cover->triangle_count = 0;
    ovoid_verdict verdict = answer_make_small_verdict(&end, &goal);
    vec3 normal = closed_clear_signs(points.normal);
    return (ovoid_answer){
        .status = verdict.status,
        .stage = verdict.stage,
        .limit = verdict.limit,
        .lower = end.lower,
        .upper = end.upper,
        .point_a = end.point_a,
        .point_b = end.point_b,
        .normal = normal,
        .proof = {.normal = normal, .kind = OVOID_PROOF_POINTS, .count = 1, .weight_a = {1}, .weight_b = {1}}};
}
