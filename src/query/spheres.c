// The same steps as of any pair (query/answer.c), of bodies that no rotation changes: no matrix is made, and the frame
// stays in registers, as only inline functions see it. What is not answered here goes through the pipeline.
#include "query/spheres.h"

#include "linear/pose.h"
#include "query/begin.h"

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
    if (!options_make(request->options, &options) || !(goal.far >= 0) || !pose_is_plain(&pair->pose_a) ||
        !pose_is_plain(&pair->pose_b))
        return answer_find_by_value(pair, request);
    place(pair, &f);
    set_numbers(&goal, &options, &f);
    if (reject_by_spheres(&f, goal.far, &found)) return answer_find_by_value(pair, request);
    const placed_query query = {&f, &goal, NULL, found.lower, 1};
    if (!closed_run_origins(&query, &end)) return answer_find_by_value(pair, request);
    ovoid_verdict verdict = answer_make_small_verdict(&end, &goal);
    end.points = (simplex){.count = 1, .weight = {1}};
    end.inner = (vec3){0, 0, 0};
    const small_points witness = {end.point_a, end.point_b};
    return (ovoid_answer)SMALL_ANSWER(&end, verdict, witness);
}
