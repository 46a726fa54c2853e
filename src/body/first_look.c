// Most pairs of bodies in a scene are far apart, and all that a yes or no, or a question within a margin, needs of them
// is the line of the roots' centres. It proves the lower bound for all pairs of parts at once; the upper one is the
// distance of a vertex of each. So no part is posed and no frame of either body is made.
//
// Errors: all is measured in the world, where rotations are off by 36 u, not by 82 u as in the frame of the other body
// (node_bounds.c): its claim covers them, for the bounds and for whoever checks them in the world poses of the parts.
#include "body/first_look.h"

#include "linear/rotation.h"

// The deciding parts are the first of the trees' order; one vertex of each, from its body's origin, in the world's
// axes.
static vec3 find_vertex(const compound_part *part, mat3 r) {
    return mat3_mul_vec3(r, vec3_add(part->at, mat3_mul_vec3(part->rotation, part->shape->first)));
}

static ovoid_limit find_limit(const final_bracket *b, const query_goal *goal) {
    return bracket_is_narrow(b, goal) ? OVOID_LIMIT_NONE : bracket_find_limit(b, goal, OVOID_LIMIT_NONE);
}

static void exclude_all(const body_search *state, vec3 normal, double lower) {
    const ovoid_exclusion roots = {0, state->a.count, 0, state->b.count, normal, {0, 0, 0}, lower};
    if (state->exclusions) exclusions_add(state->exclusions, &roots);
}

int first_look(const body_search *state, const query_goal *goal) {
    const body_tree *a = &state->a, *b = &state->b;
    const compound_node *node_a = state->parts->nodes[0], *node_b = state->parts->nodes[1];
    const compound_part *part_a = state->parts->parts[0], *part_b = state->parts->parts[1];
    ovoid_body_answer *out = state->out;
    mat3 ra = quat_to_mat3(a->pose->rotation), rb = quat_to_mat3(b->pose->rotation);
    vec3 offset = vec3_sub(b->pose->position, a->pose->position);
    vec3 between = vec3_add(offset, vec3_sub(mat3_mul_vec3(rb, node_b->center), mat3_mul_vec3(ra, node_a->center)));
    double length = vec3_norm(between), size = trees_compute_size(a, b, offset),
           claim = trees_compute_claim(a, b, size);
    double lower = length - (node_a->radius + node_b->radius) - claim;
    if (!(lower > goal->far)) return 0;
    // A vertex of each; the radii go along their difference, which is longer than both.
    vec3 from = find_vertex(part_a, ra), d = vec3_add(offset, vec3_sub(find_vertex(part_b, rb), from));
    const ovoid_shape *shape_a = part_a->shape, *shape_b = part_b->shape;
    double distance = vec3_norm(d), upper = distance - (shape_a->upper_radius + shape_b->upper_radius) + claim;
    vec3 point = vec3_add(a->pose->position, from), normal = vec3_scale(between, 1 / length);
    double tolerance = options_compute_tolerance(&state->options, size, 0), allowance = a->allowance + b->allowance;
    const final_bracket bracket = {lower, upper, tolerance + allowance, allowance, OVOID_SEPARATED, OVOID_PROOF_POINTS};
    out->part_a = body_tree_get_index(a, 0);
    out->part_b = body_tree_get_index(b, 0);
    out->visited = 1;
    out->tested = 0;
    out->deciding = (ovoid_answer){
        .status = OVOID_SEPARATED,
        .stage = OVOID_STAGE_SPHERE,
        .limit = find_limit(&bracket, goal),
        .lower = lower,
        .upper = upper,
        .point_a = vec3_add_scaled(point, d, shape_a->radius / distance),
        .point_b = vec3_add_scaled(vec3_add(point, d), d, -(shape_b->radius / distance)),
        .normal = normal,
        .proof = {.normal = normal, .kind = OVOID_PROOF_POINTS, .count = 1, .weight_a = {1}, .weight_b = {1}}};
    exclude_all(state, normal, lower);
    return 1;
}
