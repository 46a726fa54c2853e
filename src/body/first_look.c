// Most pairs of bodies in a scene are far apart, and all that a yes or no, or a question within a margin, needs of them
// is the line of the roots' centres. It proves the lower bound for all pairs of parts at once; the upper one is the
// distance of a vertex of each. So no part is posed and no frame of either body is made.
//
// Where the balls of solids overlap, the boxes of the roots are measured along the same line, which parts most of them;
// else along their own axes, for which the caller makes the frame and has their gap.
//
// Errors: all is measured in the world, where rotations are off by 36 u, not by 82 u as in the frame of the other body
// (node_bounds.c, tree_frame.h): its claim covers them, for the bounds and for whoever checks them in the world poses
// of the parts. The line is off by 4 u as a unit, turned into a body's frame by 42 u, and the box along it as there.
#include "body/first_look.h"

#include "linear/both.h"

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

// The rotations of both bodies to the world.
static both_mat3 make_rotations(const body_tree *a, const body_tree *b) {
    both_mat3 made;
    ovoid_quat p = a->pose->rotation, q = b->pose->rotation;
    if (both_quat_to_mat3(p, q, &made)) return made;
    return both_mat3_make(quat_to_mat3(p), quat_to_mat3(q));
}

// From the one to the other.
static vec3 get_difference(both_vec3 v) { return (vec3){v.x[1] - v.x[0], v.y[1] - v.y[0], v.z[1] - v.z[0]}; }
static vec3 get_one(both_vec3 v, int which) { return (vec3){v.x[which], v.y[which], v.z[which]}; }

// The largest distance of a root's box along a direction of the body's frame, from the centre of the ball.
static double find_top(const body_tree *tree, vec3 center, vec3 n) {
    turned_box root = body_tree_get_turned_box(tree, body_tree_get_root(tree));
    vec3 in = mat3_mul_vec3(root.axes, n), h = root.box.half;
    vec3 shift = vec3_add(root.box.center, vec3_sub(tree->center, center));
    return vec3_dot(n, shift) + ((fabs(in.x) * h.x + fabs(in.y) * h.y) + fabs(in.z) * h.z);
}

// How far the boxes of both roots reach toward each other along a direction of the world.
static double find_reaches(const body_search *state, const both_vec3 *centers, both_vec3 along) {
    return find_top(&state->a, get_one(*centers, 0), get_one(along, 0)) +
           find_top(&state->b, get_one(*centers, 1), vec3_neg(get_one(along, 1)));
}

int first_look(const body_search *state, const query_goal *goal, const box_gap *boxes, far_bodies *far) {
    const body_tree *a = &state->a, *b = &state->b;
    const first_sight of_a = see(a), of_b = see(b);
    const both_mat3 rotations = make_rotations(a, b);
    vec3 offset = vec3_sub(b->pose->position, a->pose->position);
    const both_vec3 centers = both_vec3_make(of_a.center, of_b.center);
    vec3 between = vec3_add(offset, get_difference(both_mat3_mul_vec3(&rotations, centers)));
    double length = vec3_norm(between), size = trees_compute_size(a, b, offset),
           claim = trees_compute_claim(a, b, size);
    double lower = length - (of_a.ball_radius + of_b.ball_radius) - claim;
    if (boxes)
        lower = boxes->lower - claim;
    else if (!(lower > goal->far) && state->has_solid && length > 0) {
        vec3 n = vec3_scale(between, 1 / length);
        const both_vec3 along = both_mat3_mul_transposed_vec3(&rotations, both_vec3_make(n, n));
        lower = length - find_reaches(state, &centers, along) - claim;
    }
    if (!(lower > goal->far)) return 0;
    // A vertex of each; the radii go along their difference, which is longer than both.
    both_vec3 vertices = both_mat3_mul_vec3(&rotations, both_vec3_make(of_a.vertex, of_b.vertex));
    vec3 d = vec3_add(offset, get_difference(vertices));
    double distance = vec3_norm(d), upper = distance - (of_a.upper_radius + of_b.upper_radius) + claim;
    double tolerance = options_compute_tolerance(&state->options, size, 0), allowance = a->allowance + b->allowance;
    const final_bracket bracket = {lower, upper, tolerance + allowance, allowance, OVOID_SEPARATED, OVOID_PROOF_POINTS};
    vec3 point_a = vec3_add(a->pose->position, get_one(vertices, 0));
    vec3 point_b = vec3_add(b->pose->position, get_one(vertices, 1));
    if (of_a.radius > 0) point_a = vec3_add_scaled(point_a, d, of_a.radius / distance);
    if (of_b.radius > 0) point_b = vec3_add_scaled(point_b, d, -(of_b.radius / distance));
    far->lower = lower;
    far->upper = upper;
    far->point_a = point_a;
    far->point_b = point_b;
    far->normal = boxes ? mat3_mul_vec3(both_mat3_get(&rotations, 0), boxes->normal) : vec3_scale(between, 1 / length);
    far->part_a = body_tree_get_index(a, 0);
    far->part_b = body_tree_get_index(b, 0);
    far->limit = find_limit(&bracket, goal);
    exclude_all(state, far->normal, lower);
    return 1;
}
