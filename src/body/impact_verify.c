// Verifies the impact of two bodies without a search: groups of steps, each of two parts or of the balls around two
// nodes, that leave out no pair of parts (disjoint rectangles in the table of pairs cover it if their areas add up to
// its area); and of solids the beginning, which is asked anew.
#include "base/environment.h"
#include "base/error.h"
#include "body/moving_tree.h"

// An impact and its proof, with both bodies as trees.
typedef struct claim {
    double margin;
    const ovoid_body_impact *found;
    const ovoid_motion_options *options;
    const ovoid_step *steps;
    const ovoid_step_group *groups;
    moving_trees trees;
} claim;

// The node or leaf over exactly these leaves; descends to the child that holds them. 0 where there is none.
static int find_node(const body_tree *tree, uint32_t first, uint32_t end, tree_ref *found) {
    uint32_t from, to;
    if (first >= end || end > tree->count) return 0;
    for (tree_ref at = body_tree_get_root(tree);;) {
        tree_ref children[BOX8];
        body_tree_get_range(tree, at, &from, &to);
        *found = at;
        if (from == first && to == end && (end - first > 1 || ref_is_leaf(at))) return 1;
        if (ref_is_leaf(at)) return 0;
        uint32_t count = body_tree_get_children(tree, at, children), i = 0;
        for (; i < count; i++) {
            body_tree_get_range(tree, children[i], &from, &to);
            if (from <= first && end <= to) break;
        }
        if (i == count) return 0;
        at = children[i];
    }
}

// 1 if two groups have no pair of parts in common.
static int groups_are_apart(const ovoid_step_group *x, const ovoid_step_group *y) {
    return x->end_a <= y->first_a || y->end_a <= x->first_a || x->end_b <= y->first_b || y->end_b <= x->first_b;
}

// OVOID_OK if the groups leave out no pair of parts.
static ovoid_code verify_cover(const claim *c, ovoid_error *error) {
    const body_tree *a = &c->trees.a.tree, *b = &c->trees.b.tree;
    const ovoid_step_group *groups = c->groups;
    size_t count = c->found->group_count;
    uint64_t area = 0;
    tree_ref node;
    for (size_t i = 0; i < count; i++) {
        if (!find_node(a, groups[i].first_a, groups[i].end_a, &node) ||
            !find_node(b, groups[i].first_b, groups[i].end_b, &node))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "group %zu is of no two nodes of the trees", i);
        for (size_t k = 0; k < i; k++)
            if (!groups_are_apart(&groups[i], &groups[k]))
                return error_set(error, OVOID_ERROR_PROOF, (int64_t)i, "groups %zu and %zu have parts in common", k, i);
        area += (uint64_t)(groups[i].end_a - groups[i].first_a) * (groups[i].end_b - groups[i].first_b);
    }
    if (area == (uint64_t)a->count * b->count) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)count, "the groups leave out pairs of parts");
}

static ovoid_code verify_group(const claim *c, const ovoid_step_group *g, const ovoid_step *steps, ovoid_error *error) {
    tree_ref a, b;
    moving_couple made;
    (void)find_node(&c->trees.a.tree, g->first_a, g->end_a, &a);
    (void)find_node(&c->trees.b.tree, g->first_b, g->end_b, &b);
    const ovoid_impact *x = &c->found->impact;
    const step_claim free = {x->begin, x->free_until, c->margin, steps, g->count};
    // Two triangles may be free by their balls.
    if (c->trees.has_solid && ref_is_leaf(a) && ref_is_leaf(b)) {
        moving_shapes balls = moving_trees_make_balls(&c->trees, a, b, &made);
        if (impact_verify_steps(balls, &free, NULL) == OVOID_OK) return OVOID_OK;
    }
    return impact_verify_steps(moving_trees_get_pair(&c->trees, a, b, &made), &free, error);
}

static ovoid_code verify_groups(const claim *c, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
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

static ovoid_code verify_parts(const claim *c, const ovoid_answer *hit, double most, ovoid_error *error) {
    const moving_tree *a = &c->trees.a, *b = &c->trees.b;
    moving_couple made;
    uint32_t place_a = body_tree_get_place(&a->tree, c->found->part_a);
    uint32_t place_b = body_tree_get_place(&b->tree, c->found->part_b);
    const answer_claim own = {c->found->impact.hit_at, hit, -INFINITY, most};
    return impact_verify_answer(moving_trees_get_leaves(&c->trees, place_a, place_b, &made), &own, error);
}

// The claimed bracket contains what is found, and says the same of the sign.
static int holds(const ovoid_answer *claimed, const ovoid_body_answer *found) {
    int follows = status_verify_internal(answer_get_verdict(claimed), INFINITY, NULL) == OVOID_OK;
    if (!follows) return 0;
    return claimed->lower <= found->lower && claimed->upper >= found->upper && claimed->status == found->status;
}

// A hit at the beginning is what the query of the bodies says there, with the answer of the surfaces; where that left
// the margin open, it is a hit of the deciding pair as any other.
static ovoid_code verify_hit_at_begin(const claim *c, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    moving_answer at;
    moving_trees_ask(&c->trees, c->margin, x->begin, &at);
    if (at.answer.upper + at.shift > c->margin) return verify_parts(c, &x->hit, c->margin, error);
    ovoid_answer surfaces = x->hit;
    surfaces.status = at.answer.deciding.status;
    surfaces.limit = at.answer.deciding.limit;
    surfaces.lower = at.answer.deciding.lower;
    surfaces.upper = at.answer.deciding.upper;
    if (!holds(&x->hit, &at.answer) || x->hit.upper + at.shift > c->margin)
        return error_set(error, OVOID_ERROR_PROOF, -1, "the hit at the beginning is not what the bodies show there");
    return verify_parts(c, &surfaces, INFINITY, error);
}

// What is claimed of the beginning: within the margin, or apart.
static ovoid_code verify_begin(const claim *c, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    moving_answer at;
    if (!c->trees.has_solid) return OVOID_OK;
    if (x->status == OVOID_IMPACT_HIT && x->hit_at <= x->begin) return verify_hit_at_begin(c, error);
    if (x->free_until <= x->begin && x->status != OVOID_IMPACT_FREE) return OVOID_OK;
    moving_trees_ask(&c->trees, c->margin, x->begin, &at);
    if (moving_answer_is_apart(&at, 1)) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1, "the bodies are not apart at the beginning");
}

static ovoid_code verify_hit(const claim *c, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    if (x->status != OVOID_IMPACT_HIT || (c->trees.has_solid && x->hit_at <= x->begin)) return OVOID_OK;
    return verify_parts(c, &x->hit, c->margin, error);
}

// OVOID_OK if the query has these times, or is refused for this reason and nothing is claimed.
static ovoid_code verify_query(claim *c, const ovoid_moving_body *a, const ovoid_moving_body *b, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    moving_couple made;
    int is_empty = impact_is_empty(x) && !c->found->group_count;
    ovoid_limit limit = moving_trees_make(a, b, &c->trees);
    if (limit != OVOID_LIMIT_NONE) {
        if (x->limit == limit && is_empty) return OVOID_OK;
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a body needs exactly one of shape, compound and solid");
    }
    const moving_shapes balls = moving_trees_make_balls(&c->trees, body_tree_get_root(&c->trees.a.tree),
                                                        body_tree_get_root(&c->trees.b.tree), &made);
    const query_claim query = {c->margin, c->options, x->begin, x->end, x->limit, is_empty};
    return impact_verify_query(balls, &query, error);
}

static ovoid_code verify(claim *c, const ovoid_moving_body_pair *pair, ovoid_error *error) {
    const ovoid_impact *x = &c->found->impact;
    OVOID_ASSERT((c->steps || !x->step_count) && (c->groups || !c->found->group_count));
    ovoid_code code = verify_query(c, &pair->a, &pair->b, error);
    if (code != OVOID_OK || impact_is_refusal(x)) return code;
    if (!impact_is_sound(x, c->margin) || c->found->part_a >= c->trees.a.tree.count ||
        c->found->part_b >= c->trees.b.tree.count)
        return error_set(error, OVOID_ERROR_PROOF, -1, "status %s does not follow from free until %.17g, hit at %.17g",
                         ovoid_impact_status_get_name(x->status), x->free_until, x->hit_at);
    code = verify_begin(c, error);
    // Without steps nothing is claimed of the time before `begin`.
    int is_claimed = x->free_until > x->begin || x->status == OVOID_IMPACT_FREE;
    if (code == OVOID_OK && is_claimed) code = verify_groups(c, error);
    return code == OVOID_OK ? verify_hit(c, error) : code;
}

ovoid_code ovoid_body_impact_verify(const ovoid_moving_body_pair *pair, const ovoid_body_impact *impact,
                                    const ovoid_motion_basis *basis, ovoid_error *error) {
    claim c = {.margin = pair->margin, .found = impact};
    if (basis) c.options = basis->options, c.steps = basis->steps, c.groups = basis->groups;
    ENVIRONMENT_RETURN(ovoid_code, c, verify(&c, pair, error));
}
