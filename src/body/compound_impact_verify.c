// Checks the impact of compounds without a search: groups of steps, each of two parts or of the balls around two nodes,
// that leave out no pair of parts. Disjoint rectangles in the table of pairs cover it if their areas add up to its
// area.
#include "base/environment.h"
#include "base/error.h"
#include "body/compound_impact.h"
#include "motion/impact.h"

// An impact and its proof, with both bodies as trees.
typedef struct claim {
    const ovoid_moving_body *a, *b;
    double margin;
    const ovoid_compound_impact *found;
    const ovoid_motion_options *options;
    const ovoid_step *steps;
    const ovoid_step_group *groups;
    body_view view_a, view_b;
} claim;

// The node over exactly these parts, or NULL; descends to the child that holds them.
static const compound_node *find_node(const body_view *view, uint32_t first, uint32_t end) {
    const compound_node *n = view->nodes;
    if (first >= end || first < n->first || end > n->end) return NULL;
    while (!node_is_leaf(n) && !(n->first == first && n->end == end)) {
        const compound_node *left = node_get_left(n);
        n = end <= left->end ? left : node_get_right(n);
        if (first < n->first || end > n->end) return NULL;
    }
    return n->first == first && n->end == end ? n : NULL;
}

// OVOID_OK if the groups leave out no pair of parts.
static ovoid_code verify_cover(const claim *c, ovoid_error *error) {
    const body_view *a = &c->view_a, *b = &c->view_b;
    const ovoid_step_group *groups = c->groups;
    size_t count = c->found->group_count;
    uint64_t area = 0;
    for (size_t i = 0; i < count; i++) {
        if (!find_node(a, groups[i].first_a, groups[i].end_a) || !find_node(b, groups[i].first_b, groups[i].end_b))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "group %zu is of no two nodes of the trees", i);
        for (size_t k = 0; k < i; k++)
            if (!step_groups_are_apart(&groups[i], &groups[k]))
                return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "groups %zu and %zu have parts in common", k, i);
        area += (uint64_t)(groups[i].end_a - groups[i].first_a) * (groups[i].end_b - groups[i].first_b);
    }
    if (area == (uint64_t)a->count * b->count) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)count, "the groups leave out pairs of parts");
}

static ovoid_code verify_group(const claim *c, const ovoid_step_group *g, const ovoid_step *steps, ovoid_error *error) {
    const compound_node *a = find_node(&c->view_a, g->first_a, g->end_a);
    const compound_node *b = find_node(&c->view_b, g->first_b, g->end_b);
    point_shape ball_a, ball_b;
    int parts = node_is_leaf(a) && node_is_leaf(b);
    ovoid_moving_shape moving_a =
        parts ? moving_view_get_part(c->a, &c->view_a, a->first) : moving_node_make_sphere(c->a, a, &ball_a);
    ovoid_moving_shape moving_b =
        parts ? moving_view_get_part(c->b, &c->view_b, b->first) : moving_node_make_sphere(c->b, b, &ball_b);
    const ovoid_impact *x = &c->found->impact;
    const step_claim free = {x->begin, x->free_until, c->margin, steps, g->count};
    return impact_verify_steps((moving_shapes){&moving_a, &moving_b}, &free, error);
}

static ovoid_code verify_groups(const claim *c, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    // Without steps nothing is claimed of the time before `begin`.
    if (x->free_until <= x->begin && x->status != OVOID_IMPACT_FREE) return OVOID_OK;
    ovoid_code code = verify_cover(c, error);
    size_t next = 0;
    for (size_t i = 0; i < c->found->group_count && code == OVOID_OK; i++) {
        const ovoid_step_group *group = &c->groups[i];
        if (group->count > x->step_count - next || (!group->count && x->begin == x->end))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "group %zu has no such steps", i);
        code = verify_group(c, group, c->steps + next, error);
        if (code != OVOID_OK && error) error->place = (int64_t)i;
        next += group->count;
    }
    return code;
}

// OVOID_OK if the query has these times, or is refused for this reason and nothing is claimed.
static ovoid_code verify_query(claim *c, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    int has_a = moving_view_make(c->a, &c->view_a), has_b = moving_view_make(c->b, &c->view_b);
    if (!has_a || !has_b) {
        ovoid_limit limit = has_a ? OVOID_LIMIT_SHAPE_B : OVOID_LIMIT_SHAPE_A;
        if (x->limit == limit && impact_is_empty(x) && !c->found->group_count) return OVOID_OK;
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a body needs either a shape or a compound");
    }
    ovoid_moving_shape a = moving_view_get_part(c->a, &c->view_a, 0), b = moving_view_get_part(c->b, &c->view_b, 0);
    int is_empty = impact_is_empty(x) && !c->found->group_count;
    const query_claim query = {c->margin, c->options, x->begin, x->end, x->limit, is_empty};
    return impact_verify_query((moving_shapes){&a, &b}, &query, error);
}

static ovoid_code verify(claim *c, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    OVOID_ASSERT((c->steps || !x->step_count) && (c->groups || !c->found->group_count));
    ovoid_code code = verify_query(c, error);
    if (code != OVOID_OK || impact_is_refusal(x)) return code;
    if (!impact_is_sound(x, c->margin) || c->found->part_a >= c->view_a.count || c->found->part_b >= c->view_b.count)
        return error_set(error, OVOID_ERROR_PROOF, -1, "status %s does not follow from free until %.17g, hit at %.17g",
                         ovoid_impact_status_get_name(x->status), x->free_until, x->hit_at);
    code = verify_groups(c, error);
    if (code != OVOID_OK || x->status != OVOID_IMPACT_HIT) return code;
    ovoid_moving_shape part_a = ovoid_moving_body_get_part(c->a, c->found->part_a);
    ovoid_moving_shape part_b = ovoid_moving_body_get_part(c->b, c->found->part_b);
    const answer_claim hit = {x->hit_at, &x->hit, -INFINITY, c->margin};
    return impact_verify_answer((moving_shapes){&part_a, &part_b}, &hit, error);
}

ovoid_code ovoid_compound_impact_verify(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                                        const ovoid_compound_impact *impact, const ovoid_motion_options *options,
                                        const ovoid_step *steps, const ovoid_step_group *groups, ovoid_error *error) {
    claim c = {.a = a, .b = b, .margin = margin, .found = impact, .options = options, .steps = steps, .groups = groups};
    ENVIRONMENT_RETURN(ovoid_code, c, verify(&c, error));
}
