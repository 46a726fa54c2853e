// Exclusions: sorting and finding them, and checking a compound's answer by them.
//
// The check is a traversal of both trees from the pair of roots. Each pair of nodes is the deciding pair of parts, or
// one that an exclusion names, or is split and both halves are visited; a pair of leaves that is neither is a hole. So
// no pair of parts is left out, whatever the tree is, since a node's parts are those of its children. Each exclusion is
// measured again along its normal: the least support of all parts of b less the greatest of all parts of a, or for a
// pair of parts as an ordinary lower bound (query/check.c). No search.
//
// Errors, u = 2^-53: of a part's support in the world R(q) is off by 36 u, turning the normal 6 u, dots and sums 12 u,
// differences of positions u: below 60 u S. The normal is taken as a unit vector to 4 u, radii 2 u: 100 u S.
#include "base/environment.h"
#include "base/error.h"
#include "compound/node_bounds.h"
#include "linear/rotation.h"

static int compare(const ovoid_exclusion *a, const ovoid_exclusion *b) {
    if (a->first_a != b->first_a) return a->first_a < b->first_a ? -1 : 1;
    if (a->end_a != b->end_a) return a->end_a < b->end_a ? -1 : 1;
    if (a->first_b != b->first_b) return a->first_b < b->first_b ? -1 : 1;
    return a->end_b < b->end_b ? -1 : a->end_b > b->end_b;
}

// Sifts the heap's item at `at` down. Heap sort: J. W. J. Williams, Algorithm 232, 1964.
static void sink(ovoid_exclusion *items, size_t at, size_t count) {
    ovoid_exclusion x = items[at];
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && compare(&items[child], &items[child + 1]) < 0) child++;
        if (compare(&x, &items[child]) >= 0) break;
        items[at] = items[child];
    }
    items[at] = x;
}

void exclusions_sort(ovoid_exclusion *items, size_t count) {
    for (size_t i = count / 2; i-- > 0;) sink(items, i, count);
    for (size_t end = count; end-- > 1;) {
        ovoid_exclusion last = items[end];
        items[end] = items[0];
        items[0] = last;
        sink(items, 0, end);
    }
}

int exclusions_have(const ovoid_exclusions *all, const ovoid_exclusion *wanted) {
    size_t low = 0, high = all->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = compare(&all->items[middle], wanted);
        if (order == 0) return 1;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return 0;
}

// ---- the check

typedef struct cut {
    const ovoid_body_pair *pair;
    const ovoid_compound_answer *x;
    const ovoid_exclusions *all;
    body_view a, b;
    nodes_frame frame;
    uint32_t place_a, place_b; ///< the deciding pair
} cut;

static ovoid_code refuse(ovoid_error *error, size_t place, const char *what) {
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)place, "exclusion %zu %s", place, what);
}

// The largest n.x over a part's points, relative to the position of a's body; radius included.
static double find_top(const cut *c, const ovoid_posed_shape *body, vec3 n) {
    const ovoid_shape *s = body->shape;
    mat3 r = quat_to_mat3(body->pose.rotation);
    vec3 in = mat3_mul_transposed_vec3(r, n);
    vec3 at = vec3_sub(body->pose.position, c->a.pose->position);
    return (vec3_dot(n, at) + vec3_dot(in, s->origin)) + (shape_find_extreme(s, in).value + s->lower_radius);
}

static double find_top_of(const cut *c, const body_view *v, uint32_t first, uint32_t end, vec3 n) {
    double most = -INFINITY;
    for (uint32_t place = first; place < end; place++) {
        ovoid_posed_shape body = body_view_get_part(v, place);
        most = max2(most, find_top(c, &body, n));
    }
    return most;
}

static int is_in_range(const cut *c, const ovoid_exclusion *e) {
    return e->first_a < e->end_a && e->end_a <= c->a.count && e->first_b < e->end_b && e->end_b <= c->b.count;
}

static ovoid_code check_bound(const cut *c, size_t i, ovoid_error *error) {
    const ovoid_exclusion *e = &c->all->items[i];
    if (!is_in_range(c, e)) return refuse(error, i, "names parts that there are not");
    if (!(e->lower >= c->x->answer.lower)) return refuse(error, i, "is below the answer's lower bound");
    if (!vec3_is_finite(e->normal_low) || !(vec3_max_abs(e->normal_low) <= 0x1p-50 * vec3_max_abs(e->normal)))
        return refuse(error, i, "has a normal whose low half is not one");
    if (e->end_a - e->first_a == 1 && e->end_b - e->first_b == 1) {
        ovoid_posed_shape a = body_view_get_part(&c->a, e->first_a), b = body_view_get_part(&c->b, e->first_b);
        ovoid_pair pair = {a.shape, b.shape, a.pose, b.pose};
        ovoid_proof proof = {.normal = e->normal, .normal_low = e->normal_low};
        if (lower_check_internal(&pair, e->lower, &proof, NULL) == OVOID_OK) return OVOID_OK;
        return refuse(error, i, "is not shown by its normal");
    }
    vec3 n = vec3_unit(e->normal);
    if (!vec3_is_finite(e->normal) || !(vec3_norm_squared(n) > 0.5)) return refuse(error, i, "has no normal");
    double found = -find_top_of(c, &c->b, e->first_b, e->end_b, vec3_neg(n)) -
                   find_top_of(c, &c->a, e->first_a, e->end_a, n) - c->frame.check;
    return found >= e->lower ? OVOID_OK : refuse(error, i, "is not shown by its normal");
}

static int is_excluded(const cut *c, const compound_node *a, const compound_node *b) {
    const ovoid_exclusion wanted = {.first_a = a->first, .end_a = a->end, .first_b = b->first, .end_b = b->end};
    return exclusions_have(c->all, &wanted);
}

// OVOID_OK if the cut leaves out no pair of parts.
static ovoid_code check_cut(const cut *c, ovoid_error *error) {
    struct {
        const compound_node *a, *b;
    } stack[2 * COMPOUND_DEPTH_MAX] = {{c->a.nodes, c->b.nodes}};
    for (int count = 1; count > 0;) {
        const compound_node *a = stack[--count].a, *b = stack[count].b;
        if (is_excluded(c, a, b)) continue;
        if (node_is_leaf(a) && node_is_leaf(b)) {
            if (a->first == c->place_a && b->first == c->place_b) continue;
            return error_set(error, OVOID_ERROR_PROOF, -1, "nothing excludes part %u of a and part %u of b",
                             body_view_get_index(&c->a, a->first), body_view_get_index(&c->b, b->first));
        }
        int first = node_is_split_first(a, b);
        stack[count].a = first ? node_get_right(a) : a;
        stack[count++].b = first ? b : node_get_right(b);
        stack[count].a = first ? node_get_left(a) : a;
        stack[count++].b = first ? b : node_get_left(b);
    }
    return OVOID_OK;
}

static ovoid_code check_exclusions(const cut *c, ovoid_error *error) {
    if (c->x->answer.lower == -INFINITY) return OVOID_OK;
    if (c->all->count > c->all->capacity)
        return error_set(error, OVOID_ERROR_PROOF, -1, "%zu exclusions, but there was room for %zu", c->all->count,
                         c->all->capacity);
    for (size_t i = 0; i < c->all->count; i++) {
        ovoid_code code = check_bound(c, i, error);
        if (code != OVOID_OK) return code;
    }
    return check_cut(c, error);
}

// The margin that is refused too is not among the options.
static ovoid_code check_refusal(const ovoid_answer *x, ovoid_limit refused, ovoid_error *error) {
    int is_blank = x->status == OVOID_UNDECIDED && x->lower == -INFINITY && x->upper == INFINITY;
    if (is_blank && (x->limit == refused || x->limit == OVOID_LIMIT_OPTIONS)) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1, "a query that must be refused has an answer");
}

// Status and limit by the bodies' tolerance, or that of the deciding pair, in which is what far origins hide.
static ovoid_code check_terms(const cut *c, const ovoid_pair *parts, const ovoid_options *options, ovoid_error *error) {
    pair_frame f = {.size = 0};
    ovoid_options of_parts = *options;
    options_take_size(&of_parts, c->frame.size);
    (void)frame_place(parts, &f);
    const answer_terms terms = {options_compute_tolerance(&of_parts, f.size, f.hidden), c->a.allowance + c->b.allowance,
                                options->cap < INFINITY ? options->cap : 0};
    return terms_check_internal(&c->x->answer, &terms, error);
}

static ovoid_code check(const ovoid_body_pair *pair, const ovoid_compound_answer *x, const ovoid_options *given,
                        const ovoid_exclusions *all, ovoid_error *error) {
    const ovoid_exclusions none = {NULL, 0, 0, NULL};
    cut c = {.pair = pair, .x = x, .all = all ? all : &none};
    ovoid_options options;
    ovoid_limit refused = options_make(given, &options) ? body_pair_view(pair, &c.a, &c.b) : OVOID_LIMIT_OPTIONS;
    if (refused != OVOID_LIMIT_NONE || x->answer.limit == OVOID_LIMIT_OPTIONS)
        return check_refusal(&x->answer, refused, error);
    if (x->part_a >= c.a.count || x->part_b >= c.b.count)
        return error_set(error, OVOID_ERROR_PROOF, -1, "parts %u and %u are not both there", x->part_a, x->part_b);
    c.place_a = c.a.compound ? c.a.compound->places[x->part_a] : 0;
    c.place_b = c.b.compound ? c.b.compound->places[x->part_b] : 0;
    nodes_frame_make(&c.a, &c.b, &c.frame);
    ovoid_posed_shape a = body_view_get_part(&c.a, c.place_a), b = body_view_get_part(&c.b, c.place_b);
    ovoid_pair parts = {a.shape, b.shape, a.pose, b.pose};
    // Two shapes are asked with the options as they are.
    if (!c.a.compound && !c.b.compound) return answer_check_internal(&parts, &x->answer, given, c.all->cover, error);
    ovoid_code code = check_terms(&c, &parts, &options, error);
    // A first look at the bodies has its points by their rounding.
    const answer_claims claims = {&parts, &x->answer, c.all->cover, c.frame.claim};
    if (code == OVOID_OK) code = bounds_check_internal(&claims, error);
    return code == OVOID_OK ? check_exclusions(&c, error) : code;
}

ovoid_code ovoid_compound_answer_check(const ovoid_body_pair *pair, const ovoid_compound_answer *answer,
                                       const ovoid_options *options, const ovoid_exclusions *exclusions,
                                       ovoid_error *error) {
    OVOID_ASSERT(pair && answer);
    ENVIRONMENT_RETURN(ovoid_code, pair, check(pair, answer, options, exclusions, error));
}
