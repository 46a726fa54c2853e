// Checking the impact of compounds without a search: groups of steps, each of two parts or of the balls around two
// nodes, that leave out no pair of parts. Disjoint rectangles in the table of pairs, whose areas add up to the table,
// cover it.
#include "base/environment.h"
#include "base/error.h"
#include "query/impact.h"
#include "scene/compound_impact.h"

// The node over exactly these parts, or NULL: down the tree to the half that holds them.
static const compound_node *find_node(const solid_view *view, uint32_t first, uint32_t end) {
    const compound_node *n = view->nodes;
    if (first >= end || first < n->first || end > n->end) return NULL;
    while (!node_is_leaf(n) && !(n->first == first && n->end == end)) {
        const compound_node *left = node_get_left(n);
        n = end <= left->end ? left : node_get_right(n);
        if (first < n->first || end > n->end) return NULL;
    }
    return n->first == first && n->end == end ? n : NULL;
}

static int is_apart(const ovoid_step_group *x, const ovoid_step_group *y) {
    return x->end_a <= y->first_a || y->end_a <= x->first_a || x->end_b <= y->first_b || y->end_b <= x->first_b;
}

// No pair of parts is left out.
static ovoid_code check_cover(const solid_view *a, const solid_view *b, const ovoid_step_group *groups, size_t count,
                              ovoid_error *error) {
    uint64_t area = 0;
    for (size_t i = 0; i < count; i++) {
        if (!find_node(a, groups[i].first_a, groups[i].end_a) || !find_node(b, groups[i].first_b, groups[i].end_b))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "group %zu is of no two nodes of the trees", i);
        for (size_t k = 0; k < i; k++)
            if (!is_apart(&groups[i], &groups[k]))
                return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "groups %zu and %zu have parts in common", k, i);
        area += (uint64_t)(groups[i].end_a - groups[i].first_a) * (groups[i].end_b - groups[i].first_b);
    }
    if (area == (uint64_t)a->count * b->count) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)count, "the groups leave out pairs of parts");
}

typedef struct claim {
    const ovoid_moving_solid *a, *b;
    solid_view view_a, view_b;
    double margin;
    const ovoid_impact *x;
} claim;

static ovoid_code check_group(const claim *c, const ovoid_step_group *g, const ovoid_step *steps, ovoid_error *error) {
    const compound_node *a = find_node(&c->view_a, g->first_a, g->end_a);
    const compound_node *b = find_node(&c->view_b, g->first_b, g->end_b);
    point_shape ball_a, ball_b;
    int parts = node_is_leaf(a) && node_is_leaf(b);
    ovoid_moving moving_a =
        parts ? moving_view_get_part(c->a, &c->view_a, a->first) : moving_node_make_ball(c->a, a, &ball_a);
    ovoid_moving moving_b =
        parts ? moving_view_get_part(c->b, &c->view_b, b->first) : moving_node_make_ball(c->b, b, &ball_b);
    return impact_check_steps(&moving_a, &moving_b, c->x->begin, c->x->free_until, c->margin, steps, g->count, error);
}

static ovoid_code check_groups(const claim *c, const ovoid_compound_impact *found, const ovoid_step *steps,
                               const ovoid_step_group *groups, ovoid_error *error) {
    // Nothing is claimed of the time before the begin.
    if (c->x->free_until <= c->x->begin && c->x->status != OVOID_IMPACT_FREE) return OVOID_OK;
    ovoid_code code = check_cover(&c->view_a, &c->view_b, groups, found->group_count, error);
    size_t next = 0;
    for (size_t i = 0; i < found->group_count && code == OVOID_OK; i++) {
        if (groups[i].count > c->x->step_count - next || (!groups[i].count && c->x->begin == c->x->end))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "group %zu has no such steps", i);
        code = check_group(c, &groups[i], steps + next, error);
        if (code != OVOID_OK && error) error->place = (int64_t)i;
        next += groups[i].count;
    }
    return code;
}

static ovoid_code check(const ovoid_moving_solid *a, const ovoid_moving_solid *b, double margin,
                        const ovoid_compound_impact *found, const ovoid_step *steps, const ovoid_step_group *groups,
                        ovoid_error *error) {
    const ovoid_impact *x = &found->impact;
    claim c = {.a = a, .b = b, .margin = margin, .x = x};
    OVOID_ASSERT((steps || !x->step_count) && (groups || !found->group_count));
    // A refusal claims nothing.
    if (x->status == OVOID_IMPACT_UNDECIDED && x->limit >= OVOID_LIMIT_POSE_A && x->free_until == 0) return OVOID_OK;
    moving_view_make(a, &c.view_a);
    moving_view_make(b, &c.view_b);
    ovoid_moving part_a = moving_view_get_part(a, &c.view_a, 0), part_b = moving_view_get_part(b, &c.view_b, 0);
    ovoid_code code = impact_check_times(&part_a, &part_b, x->begin, x->end, error);
    if (code != OVOID_OK) return code;
    if (!impact_is_sound(x, margin) || found->part_a >= c.view_a.count || found->part_b >= c.view_b.count)
        return error_set(error, OVOID_ERROR_PROOF, -1, "status %s does not follow from free until %.17g, hit at %.17g",
                         ovoid_impact_status_get_name(x->status), x->free_until, x->hit_at);
    code = check_groups(&c, found, steps, groups, error);
    if (code != OVOID_OK || x->status != OVOID_IMPACT_HIT) return code;
    part_a = ovoid_moving_solid_get_part(a, found->part_a);
    part_b = ovoid_moving_solid_get_part(b, found->part_b);
    return impact_check_answer(&part_a, &part_b, x->hit_at, &x->hit, -INFINITY, margin, error);
}

ovoid_code ovoid_compound_impact_check(const ovoid_moving_solid *a, const ovoid_moving_solid *b, double margin,
                                       const ovoid_compound_impact *impact, const ovoid_step *steps,
                                       const ovoid_step_group *groups, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, margin, check(a, b, margin, impact, steps, groups, error));
}
