// Pairs of leaves, and what is left out.
//
// Two triangles go through the kernel first, eight pairs at a time. Its bounds, lowered and raised by the claim, are
// true, and where they are closer than half the tolerance they are all that is needed; else, and for shapes, the pair
// is an ordinary query, which is exact. The best pair of all becomes one in the end.
#include "body/exclusions.h"
#include "body/search.h"

#include "linear/rotation.h"

static void add(solid_search *h, const ovoid_exclusion *x) {
    h->lower = min2(h->lower, x->lower);
    if (h->exclusions) exclusions_add(h->exclusions, x);
}

void search_exclude(solid_search *h, uint32_t a, uint32_t b, double lower, vec3 normal, vec3 normal_low) {
    ovoid_exclusion x = {a, a + 1, b, b + 1, normal, normal_low, lower};
    add(h, &x);
}

void search_exclude_boxes(solid_search *h, const waiting_pair *w) {
    h->lower = min2(h->lower, w->lower);
    if (!h->exclusions) return;
    tree_box a = solid_view_get_box(&h->a, w->a), b = solid_view_get_box(&h->b, w->b);
    ovoid_exclusion x = {.lower = w->lower};
    x.normal = mat3_mul_vec3(h->frame.world, solid_frame_find_gap(&h->frame, &a, &b, h->normals[w->normal]).normal);
    solid_view_get_range(&h->a, w->a, &x.first_a, &x.end_a);
    solid_view_get_range(&h->b, w->b, &x.first_b, &x.end_b);
    add(h, &x);
}

// ---- pairs that may touch

static vec3 find_normal(const solid_view *v, uint32_t place) {
    vec3 c = solid_get_corner(v->solid, place, 0);
    vec3 n = vec3_cross(vec3_sub(solid_get_corner(v->solid, place, 1), c),
                        vec3_sub(solid_get_corner(v->solid, place, 2), c));
    return vec3_unit(v->solid->report.volume < 0 ? vec3_neg(n) : n);
}

// Of two triangles only where both bodies are on one side of them.
static void note_flush(solid_search *h, uint32_t a, uint32_t b, double lower) {
    flush_pairs *all = &h->flush;
    if (lower > h->frame.claim || all->count == sizeof all->pair / sizeof *all->pair) return;
    if (h->a.solid && h->b.solid) {
        vec3 n = find_normal(&h->a, a), m = mat3_mul_vec3(h->frame.to_a, find_normal(&h->b, b));
        if (!(vec3_dot(n, m) > 0.5) || !(vec3_max_abs(vec3_cross(n, m)) <= 1e-6)) return;
    }
    all->pair[all->count].a = a;
    all->pair[all->count++].b = b;
}

// ---- the best pair

static void tighten(solid_search *h) {
    double upper = h->best.upper;
    if (h->goal.wants_bracket) h->enough = upper - h->tolerance / 2;
    // The margin is met: only the sign is left to find.
    if (upper <= h->goal.near) {
        h->goal = query_goal_make_collide();
        h->far = h->frame.claim;
        h->enough = INFINITY;
    }
}

// The direction of the best pair, for boxes, and for triangles beside a shape.
static void set_filter(solid_search *h) {
    if (!(vec3_norm_squared(h->best.normal) > 0.5)) return;
    if (h->normal_count < SEARCH_NORMALS)
        h->normals[h->normal_count++] = vec3_unit(mat3_mul_transposed_vec3(h->frame.world, h->best.normal));
    if (!(h->a.solid && h->b.shape) && !(h->a.shape && h->b.solid)) return;
    int side = h->a.solid != NULL;
    const solid_view *shape = side ? &h->b : &h->a;
    if (!shape->shape) return;
    mat3 r = side ? h->frame.world : h->frame.world_b;
    vec3 n = side ? h->best.normal : vec3_neg(h->best.normal);
    h->filter = mat3_mul_transposed_vec3(r, n);
    mat3 own = side ? h->frame.world_b : h->frame.world;
    vec3 in = vec3_neg(mat3_mul_transposed_vec3(own, n));
    double top = vec3_dot(in, shape->shape->origin) + shape_find_extreme(shape->shape, in).value;
    // From the solid's frame's origin.
    double offset = vec3_dot(n, side ? h->frame.offset : vec3_neg(h->frame.offset));
    h->filter_support = offset - top - shape_compute_lower_radius(shape->shape, in, AXIS_CLAIM) - h->frame.claim;
}

// The gap of a triangle and the shape along the filter.
static double find_shape_gap(const solid_search *h, int side, uint32_t place) {
    const ovoid_solid *s = side ? h->b.solid : h->a.solid;
    double most = -INFINITY;
    for (int i = 0; i < 3; i++) most = max2(most, vec3_dot(h->filter, solid_get_corner(s, place, i)));
    return h->filter_support - most;
}

// The largest n.x of a leaf, n in the world, from the body's origin.
static double find_leaf_top(const solid_view *v, mat3 world, uint32_t place, vec3 n) {
    if (v->solid) {
        double most = -INFINITY;
        vec3 in = mat3_mul_transposed_vec3(world, n);
        for (int i = 0; i < 3; i++) most = max2(most, vec3_dot(in, solid_get_corner(v->solid, place, i)));
        return most;
    }
    ovoid_posed_shape leaf = solid_view_get_leaf(v, place, NULL);
    const ovoid_shape *s = leaf.shape;
    vec3 in = mat3_mul_transposed_vec3(quat_to_mat3(leaf.pose.rotation), n);
    double at = vec3_dot(n, vec3_sub(leaf.pose.position, v->pose->position));
    double radius = shape_compute_lower_radius(s, in, AXIS_CLAIM);
    return at + (vec3_dot(in, s->origin) + (shape_find_extreme(s, in).value + radius));
}

static double find_leaf_gap(const solid_search *h, uint32_t a, uint32_t b) {
    vec3 n = vec3_unit(h->best.normal);
    double top = find_leaf_top(&h->a, h->frame.world, a, n);
    double bottom = vec3_dot(n, h->frame.offset) - find_leaf_top(&h->b, h->frame.world_b, b, vec3_neg(n));
    return bottom - top - h->frame.claim;
}

int search_is_filtered(solid_search *h, uint32_t a, uint32_t b) {
    double lower;
    if (!h->has_best || !(vec3_norm_squared(h->best.normal) > 0.5)) return 0;
    if (h->filter_support > -INFINITY)
        lower = find_shape_gap(h, !h->a.solid, h->a.solid ? a : b);
    else
        lower = find_leaf_gap(h, a, b);
    if (!search_is_left_out(h, lower)) return 0;
    note_flush(h, a, b, lower);
    search_exclude(h, a, b, lower, h->best.normal, (vec3){0, 0, 0});
    return 1;
}

ovoid_pair search_get_pair(solid_search *h, uint32_t a, uint32_t b) {
    ovoid_posed_shape x = solid_view_get_leaf(&h->a, a, &h->room_a), y = solid_view_get_leaf(&h->b, b, &h->room_b);
    return (ovoid_pair){x.shape, y.shape, x.pose, y.pose};
}

static void exclude_candidate(solid_search *h, const solid_candidate *x) {
    search_exclude(h, x->place_a, x->place_b, x->lower, x->normal, x->normal_low);
}

void search_take(solid_search *h, const solid_candidate *x) {
    note_flush(h, x->place_a, x->place_b, x->lower);
    if (h->has_best && !(x->upper < h->best.upper)) {
        exclude_candidate(h, x);
        return;
    }
    if (h->has_best) exclude_candidate(h, &h->best);
    h->best = *x;
    h->has_best = 1;
    h->is_answered = 0;
    set_filter(h);
    tighten(h);
}

static void take_trouble(solid_search *h, ovoid_limit limit) {
    int is_wide = limit == OVOID_LIMIT_ITERATIONS || limit == OVOID_LIMIT_PRECISION || limit == OVOID_LIMIT_CAPACITY;
    if (is_wide && h->trouble == OVOID_LIMIT_NONE) h->trouble = limit;
}

void search_visit_leaves(solid_search *h, uint32_t a, uint32_t b, const ovoid_proof *earlier) {
    query_goal goal = h->goal;
    goal.far = max2(goal.far, h->far);
    if (h->has_best && goal.wants_bracket && h->best.upper < goal.far) {
        goal.far = max2(h->enough, h->frame.claim);
        goal.beyond = OVOID_LIMIT_CAP;
    }
    ovoid_pair pair = search_get_pair(h, a, b);
    answer_find_internal(&pair, &h->options, goal, earlier, NULL, &h->spare);
    h->out->tested++;
    const ovoid_answer *x = &h->spare;
    take_trouble(h, x->limit);
    solid_candidate c = {a, b, x->lower, x->upper, x->proof.normal, x->proof.normal_low};
    int is_better = !h->has_best || x->upper < h->best.upper;
    search_take(h, &c);
    if (!is_better) return;
    h->out->deciding = *x;
    h->is_answered = 1;
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

void search_visit_triangles(solid_search *h, int side, uint32_t one, const uint32_t *places, uint32_t count) {
    const solid_frame *f = &h->frame;
    const ovoid_solid *own = side ? h->b.solid : h->a.solid, *other = side ? h->a.solid : h->b.solid;
    vec3 normal = search_get_normal(h);
    solid8_triangle t = {
        .corner = {solid_get_corner(other, one, 0), solid_get_corner(other, one, 1), solid_get_corner(other, one, 2)},
        .rotation = side ? f->to_a : f->to_b,
        .translation = side ? f->translation : vec3_neg(mat3_mul_vec3(f->to_b, f->translation)),
        .normal = side ? normal : vec3_neg(mat3_mul_vec3(f->to_b, normal)),
        .enough = min2(h->far, h->enough) + f->claim};
    solid8_triangles eight;
    solid8_gaps gaps;
    gather(own, places, count, &eight);
    h->kernels->triangles(&t, &eight, &gaps);
    h->out->visited += count;
    for (uint32_t i = 0; i < count && !search_is_decided(h); i++) {
        uint32_t a = side ? one : places[i], b = side ? places[i] : one;
        if (a == h->warm_a && b == h->warm_b) continue;
        vec3 n = {gaps.normal[0][i], gaps.normal[1][i], gaps.normal[2][i]};
        solid_candidate c = {
            .place_a = a, .place_b = b, .lower = gaps.lower[i] - f->claim, .upper = gaps.upper[i] + f->claim};
        // From the one to the eight: for nodes of a that is from b to a.
        c.normal = side ? mat3_mul_vec3(f->world, n) : vec3_neg(mat3_mul_vec3(f->world_b, n));
        int is_known = h->goal.wants_bracket && c.upper - c.lower <= h->tolerance / 2;
        if (search_is_left_out(h, c.lower)) {
            note_flush(h, a, b, c.lower);
            exclude_candidate(h, &c);
        } else if (is_known)
            search_take(h, &c);
        else
            search_visit_leaves(h, a, b, NULL);
    }
}
