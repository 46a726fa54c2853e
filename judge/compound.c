// Answers about bodies of several parts. Theorem. Each exclusion is a rectangle in the table of all pairs of parts,
// rows and columns in the orders of both trees: along its normal n every part of one body ends before every part of the
// other begins, by `lower` at least, radii and allowances included. If the rectangles and the deciding pair's own
// square cover the table (cover.c), no pair of parts is nearer than the least of their bounds. The library's trees are
// not used.
#include "parts.h"

#include <stdlib.h>

/// One body as the table's rows or columns.
typedef struct side {
    const ovoid_body *body;
    const uint32_t *order; ///< NULL: a shape
    uint32_t count;
} side;

typedef struct table {
    judge *context;
    side a, b;
    uint32_t place_a, place_b; ///< of the deciding pair
    double lower;
    const ovoid_exclusion *items;
    size_t count;
    ovoid_error *error;
} table;

static ovoid_code reject_item(const table *t, size_t i, const char *why) {
    (void)judge_reject(t->error, OVOID_ERROR_PROOF, "exclusion %zu %s", i, why);
    if (t->error) t->error->place = (int64_t)i;
    return OVOID_ERROR_PROOF;
}

// --- the sides

/// Fills a side and the place of its part in the order. The order must name each part once.
static ovoid_code read_side(const ovoid_body *of, uint32_t part, side *s, uint32_t *place, ovoid_error *error) {
    *s = (side){of, NULL, 1};
    *place = 0;
    if (!of->shape == !of->compound)
        return judge_reject(error, OVOID_ERROR_ARGUMENT, "a body has neither a shape nor a compound, or both");
    if (of->compound) {
        s->order = ovoid_compound_get_order(of->compound);
        s->count = (uint32_t)ovoid_compound_get_part_count(of->compound);
    }
    if (part >= s->count) return judge_reject(error, OVOID_ERROR_PROOF, "there is no part %u", part);
    if (s->order && !judge_is_order(s->order, s->count, part, place))
        return judge_reject(error, OVOID_ERROR_PROOF, "the order does not name each part once");
    return OVOID_OK;
}

/// Part i of a body, with its pose in the world by definition.
static ovoid_posed_shape get_part(const ovoid_body *of, uint32_t i) {
    if (!of->compound) return (ovoid_posed_shape){of->shape, of->pose};
    ovoid_posed_shape part = ovoid_compound_get_part(of->compound, i);
    part.pose = ovoid_pose_compute_product(&of->pose, &part.pose);
    return part;
}

static uint32_t get_index(const side *s, uint32_t place) { return s->order ? s->order[place] : place; }

// --- the bound of one exclusion

/// The reach of the true parts along the normal or against it: support / n + radius |normal|, where the radius includes
/// what the allowance adds.
typedef struct reach {
    slot support, n, radius;
    int has_part;
} reach;

static int is_farther(pool *p, const reach *r, num support, num n, num radius, num square) {
    num one = number_from_integer(p, 1), k = num_mul(p, n, r->n);
    num ahead = num_sub(p, num_mul(p, support, r->n), num_mul(p, r->support, n));
    return num_compare_roots(p, ahead, one, num_mul(p, num_sub(p, r->radius, radius), k), square) > 0;
}

// The farthest point of the parts at [first, end) along the direction (1) or against it (-1).
static ovoid_code find_reach(pool *p, const side *s, const uint32_t range[2], nvec n, int way, reach *r) {
    *r = (reach){slot_make(p), slot_make(p), slot_make(p), 0};
    num square = nvec_norm_squared(p, n);
    for (uint32_t place = range[0]; place < range[1]; place++) {
        size_t mark = pool_get_mark(p);
        ovoid_posed_shape part = get_part(s->body, get_index(s, place));
        if (!judge_is_pose_valid(&part.pose)) return OVOID_ERROR_PROOF;
        body b = body_make(p, part.shape, &part.pose);
        num support = body_support(p, &b, n, way), radius = num_add(p, b.radius, b.outside);
        if (way < 0) support = num_neg(p, support);
        if (!r->has_part || is_farther(p, r, support, b.n, radius, square)) {
            slot_set(r->support, support);
            slot_set(r->n, b.n);
            slot_set(r->radius, radius);
            r->has_part = 1;
        }
        pool_release(p, mark);
    }
    return OVOID_OK;
}

// k (gap - radii) |n| >= k lower |n|, k the product of both n.
static int is_bound(pool *p, const reach *a, const reach *b, nvec n, double lower) {
    num gap = num_neg(p, num_add(p, num_mul(p, a->support, b->n), num_mul(p, b->support, a->n)));
    num least = num_add(p, number_from(p, lower), num_add(p, a->radius, b->radius)), one = number_from_integer(p, 1);
    num claimed = num_mul(p, least, num_mul(p, a->n, b->n));
    return num_compare_roots(p, claimed, nvec_norm_squared(p, n), gap, one) <= 0;
}

static ovoid_code verify_bound(const table *t, size_t i) {
    const ovoid_exclusion *e = &t->items[i];
    pool *p = t->context->p;
    if (!(e->lower >= t->lower) || !isfinite(e->lower)) return reject_item(t, i, "is below the answer's lower bound");
    if (!is_finite(e->normal) || !is_finite(e->normal_low)) return reject_item(t, i, "has no normal");
    nvec n = nvec_add(p, nvec_from(p, e->normal), nvec_from(p, e->normal_low));
    if (nvec_is_zero(n)) return reject_item(t, i, "has no normal");
    const uint32_t rows[2] = {e->first_a, e->end_a}, columns[2] = {e->first_b, e->end_b};
    reach a, b;
    if (find_reach(p, &t->a, rows, n, 1, &a) != OVOID_OK || find_reach(p, &t->b, columns, n, -1, &b) != OVOID_OK)
        return reject_item(t, i, "has a part whose pose is none");
    return is_bound(p, &a, &b, n, e->lower) ? OVOID_OK : reject_item(t, i, "is not shown by its normal");
}

static ovoid_code verify_cover(const table *t) {
    pair_table all = {t->a.count, t->b.count, t->place_a, t->place_b, t->items, t->count};
    uint32_t row, column;
    if (judge_is_covered(&all, &row, &column)) return OVOID_OK;
    return judge_reject(t->error, OVOID_ERROR_PROOF, "nothing excludes part %u of a and part %u of b",
                        get_index(&t->a, row), get_index(&t->b, column));
}

static ovoid_code verify_exclusions(const table *t) {
    if (t->lower == -INFINITY) return OVOID_OK;
    for (size_t i = 0; i < t->count; i++) {
        const ovoid_exclusion *e = &t->items[i];
        if (!(e->first_a < e->end_a && e->end_a <= t->a.count && e->first_b < e->end_b && e->end_b <= t->b.count))
            return reject_item(t, i, "names parts that there are not");
    }
    ovoid_code code = verify_cover(t);
    for (size_t i = 0; i < t->count && code == OVOID_OK; i++) {
        size_t mark = pool_get_mark(t->context->p);
        code = verify_bound(t, i);
        pool_release(t->context->p, mark);
    }
    return code;
}

// --- the deciding pair

/// The size of a body, about, in doubles: the largest |part position| + vertex norm + radius; and the sum of all
/// lengths that enter by rounding, with the positions of the body and of the parts' frames.
typedef struct measure {
    double size, reach;
} measure;

static double compute_norm(ovoid_vec3 v) { return hypot(hypot(v.x, v.y), v.z); }

static measure measure_body(const ovoid_body *of) {
    size_t count = of->compound ? ovoid_compound_get_part_count(of->compound) : 1;
    measure m = {0, 0};
    for (size_t i = 0; i < count; i++) {
        ovoid_posed_shape part = {of->shape, ovoid_pose_make_identity()};
        if (of->compound) part = ovoid_compound_get_part(of->compound, i);
        ovoid_polytope polytope = ovoid_shape_get_polytope(part.shape);
        ovoid_allowance allowance = ovoid_shape_get_allowance(part.shape);
        double size = compute_norm(part.pose.position) + judge_find_extent(&polytope) + compute_norm(polytope.origin);
        size += ovoid_shape_get_radius(part.shape) + allowance.outside + 2 * allowance.inside;
        m.size = fmax(m.size, size);
    }
    m.reach = m.size + compute_norm(of->pose.position);
    return m;
}

// Checks that the bracket of "touching" is narrow relative to the bodies, whose deciding parts may be small.
static ovoid_code verify_touching(const judge *context, const ovoid_body_pair *pair, const ovoid_answer *answer,
                                  ovoid_error *error) {
    ovoid_vec3 a = pair->a.pose.position, b = pair->b.pose.position;
    measure ma = measure_body(&pair->a), mb = measure_body(&pair->b);
    double size = ma.size + mb.size + compute_norm((ovoid_vec3){b.x - a.x, b.y - a.y, b.z - a.z});
    return judge_verify_touching(context, answer, size, ma.reach + mb.reach, error);
}

ovoid_code judge_verify_compound(judge *context, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                 const ovoid_exclusions *exclusions, ovoid_error *error) {
    if (!context || !pair || !answer) return judge_reject(error, OVOID_ERROR_ARGUMENT, "a pointer is NULL");
    table t = {.context = context, .lower = answer->lower, .error = error};
    ovoid_code code = read_side(&pair->a, answer->part_a, &t.a, &t.place_a, error);
    if (code == OVOID_OK) code = read_side(&pair->b, answer->part_b, &t.b, &t.place_b, error);
    if (code != OVOID_OK) return code;
    const ovoid_answer *of_parts = &answer->deciding;
    if (answer->status != of_parts->status || answer->lower != of_parts->lower || answer->upper != of_parts->upper)
        return judge_reject(error, OVOID_ERROR_PROOF, "the bracket is not that of the deciding pair");
    if (exclusions) t.items = exclusions->items, t.count = exclusions->count;
    if (exclusions && exclusions->count > exclusions->capacity)
        return judge_reject(error, OVOID_ERROR_PROOF, "%zu exclusions, but there was room for %zu", exclusions->count,
                            exclusions->capacity);
    ovoid_answer own = answer->deciding;
    // A refusal claims nothing.
    if (own.status == OVOID_UNDECIDED && own.lower == -INFINITY && own.upper == INFINITY) return OVOID_OK;
    if (own.status == OVOID_TOUCHING && (pair->a.compound || pair->b.compound)) {
        code = verify_touching(context, pair, &own, error);
        own.status = OVOID_UNDECIDED, own.limit = OVOID_LIMIT_PRECISION;
    }
    ovoid_posed_shape a = get_part(&pair->a, answer->part_a), b = get_part(&pair->b, answer->part_b);
    ovoid_pair parts = {a.shape, b.shape, a.pose, b.pose};
    if (code == OVOID_OK)
        code = judge_verify_answer(context, &parts, &own, exclusions ? exclusions->cover : NULL, error);
    return code == OVOID_OK ? verify_exclusions(&t) : code;
}
