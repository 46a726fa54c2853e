// Most pairs of bodies in a scene are far apart, and all that a yes or no, or a question within a margin, needs of them
// is the line of the roots' centres. It proves the lower bound for all pairs of parts at once; the upper one is the
// distance of a vertex of each. So no part is posed and no frame of either body is made. Of solids whose balls overlap,
// long ones mostly, the boxes of the roots may still part them: the caller has their gap.
//
// Errors: all is measured in the world, where rotations are off by 36 u, not by 82 u as in the frame of the other body
// (node_bounds.c, tree_frame.h): its claim covers them, for the bounds and for whoever checks them in the world poses
// of the parts.
#include "body/first_look.h"

#include "linear/rotation.h"

// What is looked at of a body, in its frame: the ball around it, and a vertex of the first leaf of the tree's order,
// with the leaf's radii.
typedef struct first_sight {
    vec3 center, vertex;
    double ball_radius, radius, upper_radius;
} first_sight;

static first_sight see_parts(const compound_node *root, const compound_part *first) {
    const ovoid_shape *s = first->shape;
    vec3 vertex = vec3_add(first->at, mat3_mul_vec3(first->rotation, s->first));
    return (first_sight){root->center, vertex, root->radius, s->radius, s->upper_radius};
}

static first_sight see(const body_tree *tree) {
    if (tree->solid) return (first_sight){tree->center, solid_get_corner(tree->solid, 0, 0), tree->solid->reach, 0, 0};
    if (tree->compound) return see_parts(tree->compound->nodes, tree->compound->parts);
    const ovoid_posed_shape own = {tree->shape, {{0, 0, 0}, {1, 0, 0, 0}}};
    const compound_node root = node_make_shape(tree->shape);
    const compound_part part = part_make(&own);
    return see_parts(&root, &part);
}

static ovoid_limit find_limit(const final_bracket *b, const query_goal *goal) {
    return bracket_is_narrow(b, goal) ? OVOID_LIMIT_NONE : bracket_find_limit(b, goal, OVOID_LIMIT_NONE);
}

static void exclude_all(const body_search *state, vec3 normal, double lower) {
    const ovoid_exclusion roots = {0, state->a.count, 0, state->b.count, normal, {0, 0, 0}, lower};
    if (state->exclusions) exclusions_add(state->exclusions, &roots);
}

int first_look(const body_search *state, const query_goal *goal, const box_gap *boxes) {
    const body_tree *a = &state->a, *b = &state->b;
    const first_sight of_a = see(a), of_b = see(b);
    ovoid_body_answer *out = state->out;
    mat3 ra = quat_to_mat3(a->pose->rotation), rb = quat_to_mat3(b->pose->rotation);
    vec3 offset = vec3_sub(b->pose->position, a->pose->position);
    vec3 between = vec3_add(offset, vec3_sub(mat3_mul_vec3(rb, of_b.center), mat3_mul_vec3(ra, of_a.center)));
    double length = vec3_norm(between), size = trees_compute_size(a, b, offset),
           claim = trees_compute_claim(a, b, size);
    double lower = length - (of_a.ball_radius + of_b.ball_radius) - claim;
    if (boxes) lower = boxes->lower - claim;
    if (!(lower > goal->far)) return 0;
    // A vertex of each; the radii go along their difference, which is longer than both.
    vec3 from = mat3_mul_vec3(ra, of_a.vertex), to = mat3_mul_vec3(rb, of_b.vertex);
    vec3 d = vec3_add(offset, vec3_sub(to, from));
    double distance = vec3_norm(d), upper = distance - (of_a.upper_radius + of_b.upper_radius) + claim;
    vec3 normal = boxes ? mat3_mul_vec3(ra, boxes->normal) : vec3_scale(between, 1 / length);
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
        .point_a = vec3_add_scaled(vec3_add(a->pose->position, from), d, of_a.radius / distance),
        .point_b = vec3_add_scaled(vec3_add(b->pose->position, to), d, -(of_b.radius / distance)),
        .normal = normal,
        .proof = {.normal = normal, .kind = OVOID_PROOF_POINTS, .count = 1, .weight_a = {1}, .weight_b = {1}}};
    exclude_all(state, normal, lower);
    return 1;
}
