// Pairs of leaves, and what is left out.
//
// Two triangles go through the kernel first, eight pairs at a time. Its bounds, lowered and raised by the claim, are
// true, and where they are closer than half the tolerance they are all that is needed; else, and for shapes, the pair
// is an ordinary query, which is exact. The best pair of all becomes one in the end.
#include "body/solid_search.h"

#include "linear/rotation.h"

// The direction that shows the bound of a pair. The node opened last was of a or of b: its box is that of its parent,
// beside the other node's own.
static vec3 find_direction(const body_search *state, const waiting_pair *w) {
    tree_ref ref_a = waiting_get_a(w), ref_b = waiting_get_b(w);
    vec3 tried = state->solids->normals[waiting_get_reason(w)];
    turned_box a = body_tree_get_child_box(&state->a, ref_a), b = body_tree_get_turned_box(&state->b, ref_b);
    box_gap of_a = tree_frame_find_gap(&state->frame, &a, &b, tried);
    a = body_tree_get_turned_box(&state->a, ref_a);
    b = body_tree_get_child_box(&state->b, ref_b);
    box_gap of_b = tree_frame_find_gap(&state->frame, &a, &b, tried);
    return of_b.lower > of_a.lower ? of_b.normal : of_a.normal;
}

void solids_exclude_boxes(body_search *state, const waiting_pair *w) {
    state->lower = min2(state->lower, w->lower);
    if (!state->exclusions) return;
    ovoid_exclusion x = {.lower = w->lower};
    x.normal = mat3_mul_vec3(state->frame.world, find_direction(state, w));
    body_tree_get_range(&state->a, waiting_get_a(w), &x.first_a, &x.end_a);
    body_tree_get_range(&state->b, waiting_get_b(w), &x.first_b, &x.end_b);
    exclusions_add(state->exclusions, &x);
}

// ---- pairs that may touch

// Of two triangles only where both bodies are on one side of them.
static void note_flush(body_search *state, uint32_t a, uint32_t b, double lower) {
    flush_pairs *all = &state->solids->flush;
    if (lower > state->frame.claim || all->count == sizeof all->pair / sizeof *all->pair) return;
    if (state->a.solid && state->b.solid) {
        vec3 n = solid_compute_facet_normal(state->a.solid, a);
        vec3 m = mat3_mul_vec3(state->frame.to_a, solid_compute_facet_normal(state->b.solid, b));
        if (!(vec3_dot(n, m) > 0.5) || !(vec3_max_abs(vec3_cross(n, m)) <= 1e-6)) return;
    }
    all->pair[all->count].a = a;
    all->pair[all->count++].b = b;
}

// ---- the best pair

// The direction of the best pair, for boxes, and for triangles beside a shape. A distance tries it on boxes: that costs
// less than the axes across two boxes and leaves out as much. For a yes or no, or a margin, it does not help: what
// parts two boxes that are far enough need not be near the direction of any pair, least of all of one that an earlier
// answer names; long bodies then opened up to thirteen times as many nodes.
static void set_filter(body_search *state) {
    if (!(vec3_norm_squared(state->best.normal) > 0.5)) return;
    solids_state *solids = state->solids;
    if (state->goal.wants_bracket && state->goal.near == -INFINITY && solids->normal_count < SEARCH_REASONS)
        solids->normals[solids->normal_count++] =
            vec3_unit(mat3_mul_transposed_vec3(state->frame.world, state->best.normal));
    if (!(state->a.solid && state->b.shape) && !(state->a.shape && state->b.solid)) return;
    int side = state->a.solid != NULL;
    const body_tree *shape = side ? &state->b : &state->a;
    if (!shape->shape) return;
    mat3 r = side ? state->frame.world : state->frame.world_b;
    vec3 n = side ? state->best.normal : vec3_neg(state->best.normal);
    solids->filter = mat3_mul_transposed_vec3(r, n);
    mat3 own = side ? state->frame.world_b : state->frame.world;
    vec3 in = vec3_neg(mat3_mul_transposed_vec3(own, n));
    double top = vec3_dot(in, shape->shape->origin) + shape_find_extreme(shape->shape, in).value;
    // From the solid's frame's origin.
    double offset = vec3_dot(n, side ? state->frame.offset : vec3_neg(state->frame.offset));
    solids->filter_support =
        offset - top - shape_compute_lower_radius(shape->shape, in, AXIS_CLAIM) - state->frame.claim;
}

// The gap of a triangle and the shape along the filter.
static double find_shape_gap(const body_search *state, int side, uint32_t place) {
    const ovoid_solid *s = side ? state->b.solid : state->a.solid;
    double most = -INFINITY;
    for (int i = 0; i < 3; i++) most = max2(most, vec3_dot(state->solids->filter, solid_get_corner(s, place, i)));
    return state->solids->filter_support - most;
}

// The largest n.x of a leaf, n in the world, from the body's origin.
static double find_leaf_top(const body_tree *tree, mat3 world, uint32_t place, vec3 n) {
    if (tree->solid) {
        double most = -INFINITY;
        vec3 in = mat3_mul_transposed_vec3(world, n);
        for (int i = 0; i < 3; i++) most = max2(most, vec3_dot(in, solid_get_corner(tree->solid, place, i)));
        return most;
    }
    ovoid_posed_shape leaf = body_tree_get_leaf(tree, place, NULL);
    const ovoid_shape *s = leaf.shape;
    vec3 in = mat3_mul_transposed_vec3(quat_to_mat3(leaf.pose.rotation), n);
    double at = vec3_dot(n, vec3_sub(leaf.pose.position, tree->pose->position));
    double radius = shape_compute_lower_radius(s, in, AXIS_CLAIM);
    return at + (vec3_dot(in, s->origin) + (shape_find_extreme(s, in).value + radius));
}

static double find_leaf_gap(const body_search *state, uint32_t a, uint32_t b) {
    vec3 n = vec3_unit(state->best.normal);
    double top = find_leaf_top(&state->a, state->frame.world, a, n);
    double bottom = vec3_dot(n, state->frame.offset) - find_leaf_top(&state->b, state->frame.world_b, b, vec3_neg(n));
    return bottom - top - state->frame.claim;
}

// 1 where two leaves, of which one is no triangle, are left out by the normal of the best pair.
static int is_filtered(body_search *state, uint32_t a, uint32_t b) {
    double lower;
    if (!state->has_best || !(vec3_norm_squared(state->best.normal) > 0.5)) return 0;
    if (state->solids->filter_support > -INFINITY)
        lower = find_shape_gap(state, !state->a.solid, state->a.solid ? a : b);
    else
        lower = find_leaf_gap(state, a, b);
    if (!search_is_left_out(state, lower)) return 0;
    note_flush(state, a, b, lower);
    const leaf_pair pair = {.place_a = a, .place_b = b, .lower = lower, .normal = state->best.normal};
    search_exclude_leaves(state, &pair);
    return 1;
}

// Two leaves, of which at least one is no triangle.
void solids_visit_leaves(body_search *state, const waiting_pair *w) {
    uint32_t a = body_tree_get_leaf_place(&state->a, waiting_get_a(w)),
             b = body_tree_get_leaf_place(&state->b, waiting_get_b(w));
    if (a == state->warm_a && b == state->warm_b) return;
    if (!is_filtered(state, a, b)) state->kind->query_leaves(state, a, b);
}

int solids_take(body_search *state, const leaf_pair *pair) {
    note_flush(state, pair->place_a, pair->place_b, pair->lower);
    if (!search_take(state, pair)) return 0;
    set_filter(state);
    return 1;
}

// ---- triangles in lanes

static void gather(const ovoid_solid *s, const uint32_t *places, uint32_t count, solid8_triangles *eight) {
    for (uint32_t k = 0; k < BOX8; k++) {
        uint32_t place = places[k < count ? k : 0];
        for (int i = 0; i < 3; i++) {
            vec3 p = solid_get_corner(s, place, i);
            eight->corner[i][0][k] = p.x;
            eight->corner[i][1][k] = p.y;
            eight->corner[i][2][k] = p.z;
        }
    }
}

void solids_visit_triangles(body_search *state, const triangle_group *group) {
    const int side = group->side;
    const uint32_t one = group->one, *places = group->places, count = group->count;
    const tree_frame *f = &state->frame;
    const ovoid_solid *own = side ? state->b.solid : state->a.solid, *other = side ? state->a.solid : state->b.solid;
    // Before a first pair any direction will do.
    vec3 normal = state->solids->normal_count > 1 ? solids_get_normal(state) : (vec3){1, 0, 0};
    solid8_triangle t = {
        .corner = {solid_get_corner(other, one, 0), solid_get_corner(other, one, 1), solid_get_corner(other, one, 2)},
        .rotation = side ? f->to_a : f->to_b,
        .translation = side ? f->translation : vec3_neg(mat3_mul_vec3(f->to_b, f->translation)),
        .normal = side ? normal : vec3_neg(mat3_mul_vec3(f->to_b, normal)),
        .enough = min2(state->far, state->enough) + f->claim};
    solid8_triangles eight;
    solid8_gaps gaps;
    gather(own, places, count, &eight);
    state->solids->kernels->triangles(&t, &eight, &gaps);
    state->out->visited += count;
    for (uint32_t i = 0; i < count && !search_is_decided(state); i++) {
        uint32_t a = side ? one : places[i], b = side ? places[i] : one;
        if (a == state->warm_a && b == state->warm_b) continue;
        double lower = gaps.lower[i] - f->claim;
        int is_out = search_is_left_out(state, lower);
        if (is_out && lower > f->claim && !state->exclusions) {
            state->lower = min2(state->lower, lower);
            continue;
        }
        vec3 n = {gaps.normal[0][i], gaps.normal[1][i], gaps.normal[2][i]};
        leaf_pair c = {.place_a = a, .place_b = b, .lower = lower, .upper = gaps.upper[i] + f->claim};
        // From the one to the eight: for nodes of a that is from b to a.
        c.normal = side ? mat3_mul_vec3(f->world, n) : vec3_neg(mat3_mul_vec3(f->world_b, n));
        int is_known = state->goal.wants_bracket && c.upper - c.lower <= state->tolerance / 2;
        if (is_out) {
            note_flush(state, a, b, lower);
            search_exclude_leaves(state, &c);
        } else if (is_known)
            solids_take(state, &c);
        else
            state->kind->query_leaves(state, a, b);
    }
}
