// The manifolds of two bodies, part by part. The traversal is that of the other queries of bodies (body/traverse.h): no
// pair of parts is the best, so all that is not proven farther than the margin is visited, and each pair of leaves gets
// its own manifold. The manifold of a pair does not depend on the other pairs, nor on the order in which they are
// found.
#include "body/manifolds/body_manifolds.h"

#include "base/environment.h"
#include "base/error.h"
#include "body/body_find.h"
#include "body/manifolds/solid_pair.h"
#include "body/search.h"
#include "manifold/manifold.h"
#include "tools/heap.h"

// ---- order

static int compare_parts(const ovoid_body_manifold *a, const ovoid_body_manifold *b) {
    if (a->part_a != b->part_a) return a->part_a < b->part_a ? -1 : 1;
    return a->part_b < b->part_b ? -1 : a->part_b > b->part_b;
}

static int compare_numbers(double a, double b) { return a < b ? -1 : a > b; }

// Along the facet of a solid: neither a direction nor the facet of the part beside it.
static int is_along_facet(const ovoid_body_manifold *x) {
    const ovoid_manifold *m = &x->manifold;
    return (m->axis == OVOID_MANIFOLD_FACE_A && m->feature_b < OVOID_MANIFOLD_EDGE) ||
           (m->axis == OVOID_MANIFOLD_FACE_B && m->feature_a < OVOID_MANIFOLD_EDGE);
}

// Of the same parts the one along the facet comes first, then the one that is apart most.
static int compare(const ovoid_body_manifold *a, const ovoid_body_manifold *b) {
    int order = compare_parts(a, b);
    if (!order) order = is_along_facet(b) - is_along_facet(a);
    if (!order) order = compare_numbers(b->manifold.lower, a->manifold.lower);
    const ovoid_vec3 *n = &a->manifold.normal, *m = &b->manifold.normal;
    if (!order) order = compare_numbers(fabs(n->x), fabs(m->x));
    if (!order) order = compare_numbers(fabs(n->y), fabs(m->y));
    return order ? order : compare_numbers(fabs(n->z), fabs(m->z));
}

// Manifolds and the points beside them; NULL: none.
typedef struct manifold_columns {
    ovoid_body_manifold *items;
    ovoid_manifold_points *points;
} manifold_columns;

static int is_after(const void *items, size_t i, size_t k) {
    const manifold_columns *c = items;
    return compare(&c->items[i], &c->items[k]) > 0;
}

static void exchange(void *items, size_t i, size_t k) {
    const manifold_columns *c = items;
    ovoid_body_manifold item = c->items[i];
    c->items[i] = c->items[k];
    c->items[k] = item;
    if (!c->points) return;
    ovoid_manifold_points of_item = c->points[i];
    c->points[i] = c->points[k];
    c->points[k] = of_item;
}

size_t body_manifolds_sort(ovoid_body_manifold *items, ovoid_manifold_points *points, size_t count) {
    size_t kept = count > 0;
    manifold_columns columns = {items, points};
    heap_sort(&(heap_places){&columns, is_after, exchange}, count);
    for (size_t i = 1; i < count; i++) {
        if (compare_parts(&items[kept - 1], &items[i]) == 0) continue;
        if (i > kept) exchange(&columns, kept, i);
        kept++;
    }
    return kept;
}

// By bisection.
const ovoid_manifold *manifolds_request_find_earlier(const manifolds_request *r, const ovoid_body_manifold *of) {
    size_t low = 0, high = r->earlier_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = compare_parts(&r->earlier[middle], of);
        if (order == 0) return &r->earlier[middle].manifold;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

// ---- the search

// The state of the traversal comes first: its kind's functions are called with it.
typedef struct manifolds_search {
    body_search state;
    const manifolds_request *request;
    manifolds_found *found;
    ovoid_manifold_options options;
    ovoid_manifold_points points;
} manifolds_search;

static void find_pair(manifolds_search *s, const ovoid_pair *parts, ovoid_body_manifold *c) {
    s->points.count = 0;
    manifold_find_internal(parts, &s->options, manifolds_request_find_earlier(s->request, c), &c->manifold);
    s->found->tested++;
}

static void take_pair(const manifolds_search *s, const ovoid_body_manifold *c) {
    manifolds_found *found = s->found;
    found->lower = min2(found->lower, c->manifold.lower);
    found->upper = min2(found->upper, c->manifold.upper);
    if (!(c->manifold.lower > s->options.margin)) s->request->take(s->request->context, c, s->options.points);
}

static void query_leaves(body_search *state, uint32_t a, uint32_t b) {
    manifolds_search *s = (manifolds_search *)state;
    ovoid_body_manifold c = {.part_a = body_tree_get_index(&state->a, a), .part_b = body_tree_get_index(&state->b, b)};
    find_pair(s, search_pose_leaves(state, a, b), &c);
    take_pair(s, &c);
}

static void search_parts(manifolds_search *s) {
    parts_state parts;
    ovoid_body_answer counts;
    search_kind kind = parts_kind;
    body_search *state = &s->state;
    // Of the goal only the margin counts: no pair of parts is taken as the best.
    const query_goal goal = {.far = s->options.margin, .near = -INFINITY, .beyond = OVOID_LIMIT_ANSWERED};
    kind.query_leaves = query_leaves;
    state->kind = &kind;
    state->has_solid = 0;
    state->parts = &parts;
    state->solids = NULL;
    state->out = &counts;
    state->exclusions = NULL;
    counts.visited = 0;
    (void)options_make(NULL, &state->options);
    parts_begin(state, &goal);
    kind.traverse(state);
    s->found->lower = min2(s->found->lower, state->lower);
    s->found->visited = counts.visited;
}

// Two shapes, whose poses their manifold refuses.
static ovoid_limit find_shapes(manifolds_search *s, const ovoid_body_pair *pair) {
    const ovoid_pair shapes = {pair->a.shape, pair->b.shape, pair->a.pose, pair->b.pose};
    ovoid_body_manifold c = {.part_a = 0, .part_b = 0};
    find_pair(s, &shapes, &c);
    ovoid_limit limit = c.manifold.limit;
    if (limit == OVOID_LIMIT_POSE_A || limit == OVOID_LIMIT_POSE_B) {
        *s->found = (manifolds_found){-INFINITY, INFINITY, 0, 0, 0};
        return limit;
    }
    take_pair(s, &c);
    return OVOID_LIMIT_NONE;
}

static ovoid_limit refuse(const ovoid_body_pair *pair, const ovoid_manifold_options *o) {
    if (!body_is_one(&pair->a)) return OVOID_LIMIT_SHAPE_A;
    if (!body_is_one(&pair->b) || (pair->a.solid && pair->b.solid)) return OVOID_LIMIT_SHAPE_B;
    return !o || manifold_options_are_valid(o) ? OVOID_LIMIT_NONE : OVOID_LIMIT_OPTIONS;
}

ovoid_limit body_manifolds_find_internal(const ovoid_body_pair *pair, const manifolds_request *request,
                                         manifolds_found *found) {
    manifolds_search s;
    const ovoid_body *a = &pair->a, *b = &pair->b;
    *found = (manifolds_found){-INFINITY, INFINITY, 0, 0, 0};
    ovoid_limit refused = refuse(pair, request->options);
    if (refused == OVOID_LIMIT_NONE && body_pair_has_solid(pair)) return solid_manifolds_find(pair, request, found);
    if (refused == OVOID_LIMIT_NONE && !(a->shape && b->shape)) refused = body_trees_make(pair, &s.state.a, &s.state.b);
    if (refused != OVOID_LIMIT_NONE) return refused;
    s.request = request;
    s.found = found;
    s.options = request->options ? *request->options : (ovoid_manifold_options){.margin = 0};
    s.options.cover = NULL;
    s.options.points = request->has_points ? &s.points : NULL;
    found->lower = INFINITY;
    if (!(a->shape && b->shape)) {
        search_parts(&s);
        return OVOID_LIMIT_NONE;
    }
    return find_shapes(&s, pair);
}

// ---- the public functions

static void take_item(void *context, const ovoid_body_manifold *manifold, const ovoid_manifold_points *points) {
    ovoid_body_manifolds *room = context;
    size_t at = room->count++;
    if (at >= room->capacity) return;
    room->items[at] = *manifold;
    if (room->points) room->points[at] = *points;
}

static ovoid_limit find(const ovoid_body_pair *pair, const ovoid_manifold_options *options,
                        ovoid_body_manifolds *room) {
    OVOID_ASSERT(pair && room && (room->items || !room->capacity) && (room->earlier || !room->earlier_count));
    manifolds_found found;
    room->count = 0;
    const manifolds_request request = {options,   room->earlier, room->earlier_count, room->points != NULL,
                                       take_item, room};
    ovoid_limit refused = body_manifolds_find_internal(pair, &request, &found);
    size_t written = room->count < room->capacity ? room->count : room->capacity;
    size_t kept = body_manifolds_sort(room->items, room->points, written);
    if (room->count <= room->capacity) room->count = kept;
    room->lower = found.lower;
    room->upper = found.upper;
    room->visited = found.visited;
    room->tested = found.tested;
    room->through = found.through;
    return refused;
}

ovoid_limit ovoid_body_manifolds_find(const ovoid_body_pair *pair, const ovoid_manifold_options *options,
                                      ovoid_body_manifolds *manifolds) {
    ENVIRONMENT_RETURN(ovoid_limit, pair, find(pair, options, manifolds));
}

// The two parts of a manifold as a pair of shapes; 0, or where it refuses a part 1 for a and 2 for b.
static int pose_parts(const ovoid_body_pair *pair, const ovoid_body_manifold *manifold, ovoid_pair *parts) {
    body_tree a, b;
    if (!body_tree_make(&pair->a, &a) || manifold->part_a >= a.count) return 1;
    if (!body_tree_make(&pair->b, &b) || manifold->part_b >= b.count) return 2;
    ovoid_posed_shape part_a = body_tree_get_leaf(&a, body_tree_get_place(&a, manifold->part_a), NULL);
    ovoid_posed_shape part_b = body_tree_get_leaf(&b, body_tree_get_place(&b, manifold->part_b), NULL);
    *parts = (ovoid_pair){part_a.shape, part_b.shape, part_a.pose, part_b.pose};
    return 0;
}

static ovoid_manifold_points compute_points(const ovoid_body_pair *pair, const ovoid_body_manifold *manifold) {
    OVOID_ASSERT(pair && manifold);
    ovoid_pair parts;
    if (body_pair_has_solid(pair)) {
        ovoid_manifold_points points;
        solid_manifold_compute_points(pair, manifold, &points);
        return points;
    }
    if (pose_parts(pair, manifold, &parts)) return (ovoid_manifold_points){.count = 0};
    return ovoid_manifold_compute_points(&parts, &manifold->manifold);
}

ovoid_manifold_points ovoid_body_manifold_compute_points(const ovoid_body_pair *pair,
                                                         const ovoid_body_manifold *manifold) {
    ENVIRONMENT_RETURN(ovoid_manifold_points, pair, compute_points(pair, manifold));
}

static ovoid_code verify(const ovoid_body_pair *pair, const ovoid_body_manifold *manifold,
                         const ovoid_manifold_options *options, ovoid_error *error) {
    OVOID_ASSERT(pair && manifold);
    ovoid_pair parts;
    if (body_pair_has_solid(pair)) return solid_manifold_verify(pair, manifold, options, error);
    int refused = pose_parts(pair, manifold, &parts);
    if (refused)
        return error_set(error, OVOID_ERROR_PROOF, refused - 1,
                         "part %u of body %c: it has none of that number, or its pose is refused",
                         refused == 1 ? manifold->part_a : manifold->part_b, "ab"[refused - 1]);
    return ovoid_manifold_verify(&parts, &manifold->manifold, options, error);
}

ovoid_code ovoid_body_manifold_verify(const ovoid_body_pair *pair, const ovoid_body_manifold *manifold,
                                      const ovoid_manifold_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, pair, verify(pair, manifold, options, error));
}
