// Verifies a proof against the solid and the parts: the points of the lower ends are measured, and the upper ends are
// proven again by cells, each bounded by the claim alone. Nothing of the search that found them is trusted.
//
// Bounds of cells are true to half the pad (body.h), so a claim that is three quarters of the pad above all of them
// holds.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "decompose/searches.h"

/// The length to verify, one of two.
typedef struct claim {
    const char *name;
    const ovoid_decomposition_length *length;
    double (*search)(cell_search *s);
    double (*measure)(const body *b,
                      const ovoid_decomposition_length *length); ///< a lower bound of the length at the point
} claim;

static ovoid_code refuse(const claim *c, const char *what, double claimed, ovoid_error *error) {
    return error_set(error, OVOID_ERROR_ARGUMENT, -1, "%s: %s, %.9g, is not so", c->name, what, claimed);
}

// A lower bound of the distance of the point, which must be the solid's, from all parts; below 0 if it is not, or if
// another part is nearer than the named one.
static double measure_uncovered(const body *b, const ovoid_decomposition_length *length) {
    vec3 x = vec3_scale(length->point, b->inverse);
    uint32_t nearest = length->part;
    if (body_find_inside(b, x) == 0) return -1;
    double least = uncovered_find_least(b, x, length->part, &nearest);
    return body_probe_part(b, length->part, x, INFINITY).lower <= least + 4 * b->pad ? least : -1;
}

// A lower bound of the distance from the solid of some point of the part: the nearest one to the stated point.
static double measure_excess(const body *b, const ovoid_decomposition_length *length) {
    vec3 x = vec3_scale(length->point, b->inverse);
    return body_find_outside(b, x) - body_probe_part(b, length->part, x, INFINITY).upper;
}

static ovoid_code verify_lower(const body *b, const claim *c, ovoid_error *error) {
    const ovoid_decomposition_length *l = c->length;
    if (!(l->lower >= 0 && l->lower <= l->upper && l->upper <= OVOID_LENGTH_MAX))
        return refuse(c, "a bracket from", l->lower, error);
    if (l->lower == 0) return OVOID_OK;
    if (l->part >= b->part_count) return refuse(c, "the part", l->part, error);
    if (!(vec3_max_abs(vec3_scale(l->point, b->inverse)) <= 2)) return refuse(c, "the point, x", l->point.x, error);
    body fine = *b;
    fine.tolerance = 0.25 * b->pad * b->unit;
    return l->lower * b->inverse <= c->measure(&fine, l) ? OVOID_OK : refuse(c, "at least", l->lower, error);
}

static ovoid_code verify_upper(body *b, const ovoid_decomposition_options *o, const claim *c, cell *heap,
                               ovoid_error *error) {
    double ceiling = c->length->upper * b->inverse - 0.75 * b->pad, lower = c->length->lower * b->inverse;
    if (!(ceiling > 0)) return refuse(c, "at most", c->length->upper, error);
    cell_search s = {.problem = b,
                     .tolerance = max2(ceiling - lower, 0),
                     .ceiling = ceiling,
                     .lower = lower,
                     .heap = heap,
                     .room = o->cells,
                     .work = o->work,
                     .options = o};
    double upper = c->search(&s);
    if (s.lower > ceiling) return refuse(c, "at most", c->length->upper, error);
    if (upper <= ceiling) return OVOID_OK;
    return error_set(error, OVOID_ERROR_LIMIT, -1, "%s: at most %.9g is not shown by %zu cells: allow more work",
                     c->name, c->length->upper, s.looked);
}

static ovoid_code verify_both(body *b, const ovoid_decomposition_options *o, const ovoid_decomposition_proof *proof,
                              ovoid_error *error) {
    const claim claims[] = {{"uncovered", &proof->uncovered, uncovered_search, measure_uncovered},
                            {"excess", &proof->excess, excess_search, measure_excess}};
    cell *heap = allocator_allocate(&b->memory, o->cells, sizeof *heap);
    if (!heap) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu cells", o->cells);
    ovoid_code code = OVOID_OK;
    for (int i = 0; i < 2 && code == OVOID_OK; i++) code = verify_lower(b, &claims[i], error);
    for (int i = 0; i < 2 && code == OVOID_OK; i++) code = verify_upper(b, o, &claims[i], heap, error);
    allocator_release(&b->memory, heap);
    return code;
}

static ovoid_code verify(const ovoid_decomposition *d, const ovoid_decomposition_proof *proof,
                         const ovoid_decomposition_options *given, ovoid_error *error) {
    ovoid_decomposition_options o;
    body b;
    if (!proof) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no proof (NULL)");
    ovoid_code code = body_validate_options(given, &o, error);
    if (code == OVOID_OK) code = body_open_parts(&b, d, &o, error);
    if (code != OVOID_OK) return code;
    // The first cells of all parts need room.
    size_t least = 6 * (size_t)b.part_count + CELL_PIECES;
    if (o.cells < least) o.cells = least;
    code = verify_both(&b, &o, proof, error);
    body_close(&b);
    return code;
}

ovoid_code ovoid_decomposition_verify(const ovoid_decomposition *decomposition, const ovoid_decomposition_proof *proof,
                                      const ovoid_decomposition_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, decomposition, verify(decomposition, proof, options, error));
}
