// Checking an answer of two bodies by its proof alone.
//
// The deciding pair is an ordinary one (query/verify.c). Each exclusion is measured again along its normal, over all
// its parts, or for a pair of parts as an ordinary lower bound. The cut is followed from the pair of roots down by the
// rule that queries split by (frame.h): each pair is the deciding one, or named by an exclusion, or split, so no two
// parts are left out, whatever the trees are. What lies inside of a solid is counted over all triangles, without the
// tree.
//
// Errors, u = 2^-53, S as in frame.h: a point in the world 45 u, its product with a unit normal and the difference of
// two 10 u, the normal's length 4 u: below 148 u S.
#include "base/environment.h"
#include "base/error.h"
#include "body/body_find.h"
#include "body/clearance.h"
#include "body/exclusions.h"
#include "linear/rotation.h"

typedef struct cut {
    const ovoid_body_answer *x;
    const ovoid_exclusions *all;
    double lower; ///< of all pairs of parts
    double tolerance;
    body_tree a, b;
    tree_frame frame;
    uint32_t place_a, place_b;
    int has_solid;
    triangle_shape room_a, room_b;
} cut;

static ovoid_code refuse(ovoid_error *error, size_t place, const char *what) {
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)place, "exclusion %zu %s", place, what);
}
static ovoid_code refuse_all(ovoid_error *error, const char *what) {
    return error_set(error, OVOID_ERROR_PROOF, -1, "%s", what);
}

static ovoid_verdict get_verdict(const ovoid_body_answer *x) {
    return (ovoid_verdict){.status = x->status, .limit = x->limit, .lower = x->lower, .upper = x->upper};
}

static double find_shape_top(const ovoid_shape *s, vec3 n) {
    return vec3_dot(n, s->origin) + (shape_find_extreme(s, n).value + shape_compute_lower_radius(s, n, AXIS_CHECK));
}

// The leaves of a tree at [first, end).
typedef struct leaf_range {
    const body_tree *tree;
    uint32_t first, end;
} leaf_range;

// The largest n.x over leaves, from the origin of the body's frame; n in the world, and in that frame.
static double find_top(leaf_range leaves, vec3 world, vec3 n) {
    const body_tree *tree = leaves.tree;
    uint32_t first = leaves.first, end = leaves.end;
    if (tree->shape) return find_shape_top(tree->shape, n);
    double most = -INFINITY;
    for (uint32_t place = first; place < end && tree->compound; place++) {
        ovoid_posed_shape part = body_tree_get_leaf(tree, place, NULL);
        vec3 in = mat3_mul_transposed_vec3(quat_to_mat3(part.pose.rotation), world);
        double at = vec3_dot(world, vec3_sub(part.pose.position, tree->pose->position));
        most = max2(most, at + find_shape_top(part.shape, in));
    }
    for (uint32_t place = first; place < end && tree->solid; place++)
        for (int i = 0; i < 3; i++) most = max2(most, vec3_dot(n, solid_get_corner(tree->solid, place, i)));
    return most;
}

// The gap of two ranges along a direction of the world, lowered by what the measurement may be off.
static double measure_gap(const cut *c, const ovoid_exclusion *e) {
    vec3 n = vec3_unit(e->normal);
    if (!vec3_is_finite(e->normal) || !(vec3_norm_squared(n) > 0.5)) return -INFINITY;
    vec3 in_a = mat3_mul_transposed_vec3(c->frame.world, n), in_b = mat3_mul_transposed_vec3(c->frame.world_b, n);
    double top = find_top((leaf_range){&c->a, e->first_a, e->end_a}, n, in_a);
    double bottom =
        vec3_dot(n, c->frame.offset) - find_top((leaf_range){&c->b, e->first_b, e->end_b}, vec3_neg(n), vec3_neg(in_b));
    return (bottom - top) - c->frame.check;
}

static ovoid_pair get_pair(cut *c, uint32_t a, uint32_t b) {
    ovoid_posed_shape x = body_tree_get_leaf(&c->a, a, &c->room_a), y = body_tree_get_leaf(&c->b, b, &c->room_b);
    return (ovoid_pair){x.shape, y.shape, x.pose, y.pose};
}

static ovoid_code verify_bound(cut *c, size_t i, ovoid_error *error) {
    const ovoid_exclusion *e = &c->all->items[i];
    int is_in_range =
        e->first_a < e->end_a && e->end_a <= c->a.count && e->first_b < e->end_b && e->end_b <= c->b.count;
    if (!is_in_range) return refuse(error, i, "names parts that there are not");
    if (!(e->lower >= c->lower)) return refuse(error, i, "is below the answer's lower bound");
    if (!vec3_is_finite(e->normal_low) || !(vec3_max_abs(e->normal_low) <= 0x1p-50 * vec3_max_abs(e->normal)))
        return refuse(error, i, "has a normal whose low half is not one");
    int is_plain = !(vec3_max_abs(e->normal_low) > 0);
    if (is_plain && measure_gap(c, e) >= e->lower) return OVOID_OK;
    if (e->end_a - e->first_a == 1 && e->end_b - e->first_b == 1) {
        ovoid_pair pair = get_pair(c, e->first_a, e->first_b);
        ovoid_proof proof = {.normal = e->normal, .normal_low = e->normal_low};
        if (lower_verify_internal(&pair, e->lower, &proof, NULL) == OVOID_OK) return OVOID_OK;
    }
    return refuse(error, i, "is not shown by its normal");
}

static int is_excluded(const cut *c, tree_ref a, tree_ref b) {
    ovoid_exclusion wanted;
    body_tree_get_range(&c->a, a, &wanted.first_a, &wanted.end_a);
    body_tree_get_range(&c->b, b, &wanted.first_b, &wanted.end_b);
    return exclusions_have(c->all, &wanted);
}

// OVOID_OK if the cut leaves out no pair of parts.
static ovoid_code verify_cut(const cut *c, ovoid_error *error) {
    struct {
        tree_ref a, b;
    } stack[2 * SOLID_DEPTH_MAX * BOX8] = {{body_tree_get_root(&c->a), body_tree_get_root(&c->b)}};
    for (uint32_t count = 1; count > 0;) {
        tree_ref a = stack[--count].a, b = stack[count].b;
        if (is_excluded(c, a, b)) continue;
        if (ref_is_leaf(a) && ref_is_leaf(b)) {
            uint32_t place_a = body_tree_get_leaf_place(&c->a, a), place_b = body_tree_get_leaf_place(&c->b, b);
            if (place_a == c->place_a && place_b == c->place_b) continue;
            return error_set(error, OVOID_ERROR_PROOF, -1, "nothing excludes part %u of a and part %u of b",
                             body_tree_get_index(&c->a, place_a), body_tree_get_index(&c->b, place_b));
        }
        int is_first = trees_split_first(&c->a, a, &c->b, b);
        tree_ref children[BOX8];
        uint32_t more = body_tree_get_children(is_first ? &c->a : &c->b, is_first ? a : b, children);
        for (uint32_t i = 0; i < more; i++, count++) {
            stack[count].a = is_first ? children[i] : a;
            stack[count].b = is_first ? b : children[i];
        }
    }
    return OVOID_OK;
}

static ovoid_code verify_exclusions(cut *c, ovoid_error *error) {
    if (c->lower == -INFINITY) return OVOID_OK;
    if (c->all->count > c->all->capacity)
        return error_set(error, OVOID_ERROR_PROOF, -1, "%zu exclusions, but there was room for %zu", c->all->count,
                         c->all->capacity);
    for (size_t i = 0; i < c->all->count; i++) {
        ovoid_code code = verify_bound(c, i, error);
        if (code != OVOID_OK) return code;
    }
    return verify_cut(c, error);
}

// ---- the bodies

static ovoid_code verify_depth(const cut *c, ovoid_error *error) {
    const ovoid_body_answer *x = c->x;
    if (x->lower == -INFINITY) return OVOID_OK;
    ovoid_exclusion all = {0, c->a.count, 0, c->b.count, x->parting, {0, 0, 0}, x->lower};
    return measure_gap(c, &all) >= x->lower ? OVOID_OK : refuse_all(error, "the depth is not shown by its direction");
}

static ovoid_code verify_common_point(const cut *c, ovoid_error *error) {
    const ovoid_body_answer *x = c->x;
    const framed_pair pair = {&c->frame, &c->a, &c->b};
    if (!vec3_is_finite(x->common) || !(vec3_norm(x->common) <= c->frame.size))
        return refuse_all(error, "the common point is beyond the bodies");
    double depth = framed_pair_find_clearance(&pair, 0, x->common, 1) +
                   framed_pair_find_clearance(&pair, 1, x->common, 1) - 2 * c->frame.check;
    return depth > 0 && x->upper >= -depth ? OVOID_OK : refuse_all(error, "the common point does not show the overlap");
}

static ovoid_code verify_inside(const cut *c, ovoid_error *error) {
    const ovoid_body_answer *x = c->x;
    if (x->inside == OVOID_BODY_COMMON_POINT) return verify_common_point(c, error);
    const body_tree *own = x->inside == OVOID_BODY_A_INSIDE ? &c->a : &c->b, *other = own == &c->a ? &c->b : &c->a;
    if (x->inside != OVOID_BODY_A_INSIDE && x->inside != OVOID_BODY_B_INSIDE)
        return refuse_all(error, "an overlap without a reason");
    if (x->component >= body_tree_get_component_count(own)) return refuse_all(error, "there is no such component");
    if (!(x->deciding.lower > c->frame.claim / 2) || !(x->upper >= -x->deciding.lower))
        return refuse_all(error, "the surfaces are nearer than is claimed of what is inside");
    return tree_is_inside(own, other, x->component, 1) == 1 ? OVOID_OK
                                                            : refuse_all(error, "what is said to be inside is not");
}

static ovoid_code verify_apart(const cut *c, ovoid_error *error) {
    const ovoid_body_answer *x = c->x;
    contained_component found;
    if (!(x->deciding.lower > 0) || !(x->lower <= x->deciding.lower) || !(x->upper >= x->deciding.upper))
        return refuse_all(error, "the distance is not that of the surfaces");
    if (!body_tree_is_closed(&c->a) && !body_tree_is_closed(&c->b)) return OVOID_OK;
    if (!(x->deciding.lower > c->frame.claim / 2) || trees_find_inside(&c->a, &c->b, 1, &found) != 0)
        return refuse_all(error, "one body is inside of the other, or so near that it could be");
    return OVOID_OK;
}

// 1 if what proves no overlap, and what is not of the kind that proves it, is not there.
static int inside_is_sound(const ovoid_body_answer *x) {
    int is_component = x->inside == OVOID_BODY_A_INSIDE || x->inside == OVOID_BODY_B_INSIDE;
    int has_point = fabs(x->common.x) > 0 || fabs(x->common.y) > 0 || fabs(x->common.z) > 0;
    if (x->inside != OVOID_BODY_INSIDE_NONE && x->status != OVOID_OVERLAPPING) return 0;
    if (!vec3_is_finite(x->common) || (has_point && x->inside != OVOID_BODY_COMMON_POINT)) return 0;
    return is_component || x->component == 0;
}

static ovoid_code verify_overlap(const cut *c, ovoid_error *error) {
    const ovoid_body_answer *x = c->x;
    if (x->inside != OVOID_BODY_INSIDE_NONE) return verify_inside(c, error);
    if (x->deciding.upper < 0 && x->upper >= x->deciding.upper) return OVOID_OK;
    return refuse_all(error, "an overlap without a reason");
}

// "none" claims a narrow bracket, but of an overlap, whose depth is not searched for.
static int limit_is_sound(const cut *c) {
    const ovoid_body_answer *x = c->x;
    if ((unsigned)x->limit > OVOID_LIMIT_ALLOWANCE) return 0;
    if (x->limit != OVOID_LIMIT_NONE || x->status == OVOID_OVERLAPPING) return 1;
    return x->upper - x->lower <= c->tolerance + (c->a.allowance + c->b.allowance);
}

static ovoid_code verify_bodies(const cut *c, ovoid_error *error) {
    const ovoid_body_answer *x = c->x;
    ovoid_code code = status_verify_internal(answer_get_verdict(&x->deciding), c->tolerance, error);
    if (code == OVOID_OK) code = status_verify_internal(get_verdict(x), c->tolerance, error);
    if (code != OVOID_OK) return code;
    if (!inside_is_sound(x)) return refuse_all(error, "what is said to be inside proves nothing of that status");
    if (!limit_is_sound(c)) return refuse_all(error, "the bracket is wider than its limit says");
    if (x->status == OVOID_SEPARATED) return verify_apart(c, error);
    if (x->status == OVOID_OVERLAPPING)
        code = verify_overlap(c, error);
    else if (!(x->upper >= x->deciding.upper))
        code = refuse_all(error, "the upper bound is below that of the surfaces");
    return code == OVOID_OK ? verify_depth(c, error) : code;
}

// ---- bodies without a solid

// Status and limit by the bodies' tolerance, or that of the deciding pair, in which is what far origins hide.
static ovoid_code verify_terms(const cut *c, const ovoid_pair *parts, const ovoid_options *given, ovoid_error *error) {
    pair_frame f = {.size = 0};
    ovoid_options options;
    (void)options_make(given, &options);
    double cap = options.cap < INFINITY ? options.cap : 0;
    options_take_size(&options, c->frame.size);
    (void)frame_place(parts, &f);
    const answer_terms terms = {options_compute_tolerance(&options, f.size, f.hidden), c->a.allowance + c->b.allowance,
                                cap};
    return terms_verify_internal(&c->x->deciding, &terms, error);
}

// 1 if the bodies' bracket is that of the deciding pair, and nothing is said to be inside.
static int is_of_parts(const ovoid_body_answer *x) {
    const ovoid_answer *own = &x->deciding;
    // Not a number is no bracket.
    int has_bracket = x->lower >= own->lower && x->lower <= own->lower && x->upper >= own->upper &&
                      x->upper <= own->upper && x->status == own->status && x->limit == own->limit;
    return has_bracket && x->inside == OVOID_BODY_INSIDE_NONE && inside_is_sound(x);
}

static ovoid_code verify_parts(cut *c, const ovoid_pair *parts, const ovoid_options *given, ovoid_error *error) {
    const ovoid_answer *x = &c->x->deciding;
    if (!is_of_parts(c->x)) return refuse_all(error, "the bracket is not that of the deciding pair");
    // Two shapes are asked with the options as they are.
    const ovoid_answer_basis basis = {.options = given, .cover = c->all->cover};
    if (c->a.shape && c->b.shape) return answer_verify_internal(parts, x, &basis, error);
    ovoid_code code = verify_terms(c, parts, given, error);
    // A first look at the bodies has its points by their rounding.
    const answer_claims claims = {.pair = parts, .answer = x, .cover = c->all->cover, .slack = c->frame.claim};
    if (code == OVOID_OK) code = bounds_verify_internal(&claims, error);
    return code == OVOID_OK ? verify_exclusions(c, error) : code;
}

// ---- both bodies

static ovoid_limit find_refusal(const ovoid_body_pair *pair, const ovoid_options *given, cut *c) {
    ovoid_options options;
    if (!options_make(given, &options)) return OVOID_LIMIT_OPTIONS;
    ovoid_limit refused = body_trees_make(pair, &c->a, &c->b);
    if (refused != OVOID_LIMIT_NONE) return refused;
    tree_frame_make(&c->a, &c->b, &c->frame);
    c->tolerance = tree_frame_compute_tolerance(&c->frame, &options);
    c->has_solid = c->a.solid || c->b.solid;
    if (c->a.solid) triangle_begin(&c->room_a);
    if (c->b.solid) triangle_begin(&c->room_b);
    return OVOID_LIMIT_NONE;
}

static ovoid_code verify_solids(cut *c, const ovoid_pair *leaves, ovoid_error *error) {
    static const ovoid_options of_leaves = {.absolute_tolerance = INFINITY};
    static const ovoid_answer_basis basis = {.options = &of_leaves};
    // Of the deciding pair the bounds; what its status means is a matter of the bodies' size.
    ovoid_code code = answer_verify_internal(leaves, &c->x->deciding, &basis, error);
    if (code == OVOID_OK) code = verify_exclusions(c, error);
    return code == OVOID_OK ? verify_bodies(c, error) : code;
}

static ovoid_code verify(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_body_basis *basis,
                         ovoid_error *error) {
    static const ovoid_exclusions none = {.items = NULL};
    cut c = {.x = x, .all = basis->exclusions ? basis->exclusions : &none, .lower = x->deciding.lower};
    ovoid_limit refused = find_refusal(pair, basis->options, &c);
    if (refused != OVOID_LIMIT_NONE || limit_is_refusal(x->limit)) {
        return refusal_verify_internal(get_verdict(x), refused, error);
    }
    if (x->part_a >= c.a.count || x->part_b >= c.b.count)
        return error_set(error, OVOID_ERROR_PROOF, -1, "parts %u and %u are not both there", x->part_a, x->part_b);
    c.place_a = body_tree_get_place(&c.a, x->part_a);
    c.place_b = body_tree_get_place(&c.b, x->part_b);
    ovoid_pair parts = get_pair(&c, c.place_a, c.place_b);
    return c.has_solid ? verify_solids(&c, &parts, error) : verify_parts(&c, &parts, basis->options, error);
}

ovoid_code ovoid_body_verify(const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                             const ovoid_body_basis *basis, ovoid_error *error) {
    OVOID_ASSERT(pair && answer);
    static const ovoid_body_basis none;
    ENVIRONMENT_RETURN(ovoid_code, pair, verify(pair, answer, basis ? basis : &none, error));
}
