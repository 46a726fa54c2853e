// Checking a contact without a search: what it claims is measured again, from its features and its points' ids alone.
#include "base/environment.h"
#include "base/error.h"
#include "manifold/manifold.h"
#include "query/answer.h"

// A contact in the order of order.c, with the caller's sentence.
typedef struct checker {
    const pair_frame *frame;
    const ovoid_manifold *given;
    manifold_terms terms;
    manifold_axis axis;
    manifold_state state;
    ovoid_error *error;
} checker;

#define refuse(c, ...) error_set((c)->error, OVOID_ERROR_PROOF, -1, __VA_ARGS__)

// ---- the bracket ----

static ovoid_code verify_lower(const checker *c) {
    const pair_frame *f = c->frame;
    vec3 n = vec3_unit(frame_direction_from_world(f, c->given->normal));
    double gain = frame_compute_gain(f, n, mat3_mul_transposed_vec3(f->rotation, n), AXIS_CHECK);
    double found = frame_take_gain(frame_measure_gap(f, n) - f->lower_radii - f->check, gain);
    if (found >= c->given->lower) return OVOID_OK;
    return refuse(c, "lower bound: claimed %.17g, the normal shows %.17g", c->given->lower, found);
}

static ovoid_code verify_upper(const checker *c) {
    const pair_frame *f = c->frame;
    double found = INFINITY;
    switch ((ovoid_manifold_proof)c->given->proof) {
    case OVOID_MANIFOLD_PROOF_NONE: break;
    case OVOID_MANIFOLD_PROOF_POINTS: found = manifold_compute_points_upper(&c->state); break;
    case OVOID_MANIFOLD_PROOF_FACETS: {
        double depth = manifold_prove_depth(&c->state, &c->axis, &(depth_demand){-INFINITY, INFINITY});
        if (depth > 0) found = -depth - f->upper_radii;
        break;
    }
    case OVOID_MANIFOLD_PROOF_SEARCH:
        if (!c->terms.cover) return refuse(c, "an upper bound of a search, without the cover of that search");
        found = cover_measure_upper(f, c->terms.cover);
        break;
    default: return refuse(c, "there is no proof %d", c->given->proof);
    }
    if (max2(found, c->given->lower) <= c->given->upper) return OVOID_OK;
    return refuse(c, "upper bound: claimed %.17g, the %s show %.17g", c->given->upper,
                  ovoid_manifold_proof_get_name((ovoid_manifold_proof)c->given->proof), found);
}

static ovoid_code verify_limit(const checker *c) {
    const ovoid_manifold *m = c->given;
    double most = c->terms.tolerance + frame_get_allowance(c->frame);
    int is_narrow = m->upper - m->lower <= most;
    int is_reason = m->limit == OVOID_LIMIT_ITERATIONS || m->limit == OVOID_LIMIT_PRECISION ||
                    m->limit == OVOID_LIMIT_CAPACITY || m->limit == OVOID_LIMIT_ALLOWANCE ||
                    m->limit == OVOID_LIMIT_ANSWERED;
    if (m->limit == OVOID_LIMIT_NONE ? is_narrow : is_reason) return OVOID_OK;
    return refuse(c, "limit %s does not follow from the bracket [%.17g, %.17g]", ovoid_limit_get_name(m->limit),
                  m->lower, m->upper);
}

// ---- the points ----

static ovoid_code verify_point(const checker *c, uint32_t i) {
    const manifold_state *s = &c->state;
    uint32_t id = c->given->id[i];
    manifold_corner corner;
    for (uint32_t k = 0; k < i; k++)
        if (c->given->id[k] == id) return refuse(c, "points %u and %u are the same", k, i);
    if (!manifold_find_corner(s, c->given, id, &corner)) return refuse(c, "point %u is no corner of the bodies", i);
    double rounding = manifold_compute_rounding(s),
           room = max2(MANIFOLD_SNAP * c->frame->size, c->terms.keep) + rounding;
    double most = c->terms.margin + c->frame->a->radius + c->frame->b->radius + 4 * rounding;
    if (feature_get_kind(id) == OVOID_MANIFOLD_ID_NEAREST)
        return c->given->count == 1 ? OVOID_OK : refuse(c, "the nearest points beside corners");
    if (!(corner.outside <= room)) return refuse(c, "point %u is outside of a body by %.3g", i, corner.outside);
    if (!(corner.separation <= most))
        return refuse(c, "point %u is %.17g apart, beyond the margin", i, corner.separation);
    return OVOID_OK;
}

static double get_separation(const checker *c, const manifold_corner *corner) {
    return max2(corner->separation, c->state.frame.gap);
}

// No corner of the polygon is deeper than the deepest point. A corner near another one that stands for it is deeper by
// no more than the snap, once for the polygon here and once for that of the query.
static ovoid_code verify_deepest(const checker *c) {
    const manifold_state *s = &c->state;
    double deepest = INFINITY, given = INFINITY,
           room = 2 * MANIFOLD_SNAP * c->frame->size + max2(MANIFOLD_SNAP * c->frame->size, c->terms.slack);
    for (uint32_t i = 0; i < s->polygon.count; i++) deepest = min2(deepest, get_separation(c, s->polygon.corners + i));
    for (uint32_t i = 0; i < c->given->count; i++) {
        manifold_corner corner;
        if (manifold_find_corner(s, c->given, c->given->id[i], &corner))
            given = min2(given, get_separation(c, &corner));
    }
    if (given <= deepest + room + manifold_compute_rounding(s)) return OVOID_OK;
    return refuse(c, "the deepest point is at %.9g; the polygon has a corner at %.9g", given, deepest);
}

ovoid_code manifold_verify_counts(const ovoid_manifold *m, ovoid_error *error) {
    int is_few = m->corners <= 4;
    if (m->corners < m->count || (is_few && m->count != m->corners) || (!is_few && m->count != 4))
        return error_set(error, OVOID_ERROR_PROOF, -1, "%u points of a polygon of %u corners", m->count, m->corners);
    if (is_few ? m->share == 1 : m->share >= 0 && m->share <= 1) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1, "share %.9g", (double)m->share);
}

ovoid_code manifold_verify_choice(const ovoid_manifold *m, const manifold_polygon *p, corner_choice *own,
                                  ovoid_error *error) {
    if (p->count != m->corners)
        return error_set(error, OVOID_ERROR_PROOF, -1, "%u corners; the polygon has %u", m->corners, p->count);
    *own = (corner_choice){m->count, {0}, 1};
    for (uint32_t i = 0; i < m->count; i++) {
        int at = polygon_find_corner(p, m->id[i]);
        if (at < 0) return error_set(error, OVOID_ERROR_PROOF, -1, "point %u is no corner of the polygon", i);
        if (i && (uint32_t)at < own->index[i - 1])
            return error_set(error, OVOID_ERROR_PROOF, -1, "point %u is not in the polygon's order", i);
        own->index[i] = (uint32_t)at;
    }
    return OVOID_OK;
}

// The polygon again: without kept corners it does not depend on earlier contacts.
static ovoid_code verify_polygon(const checker *c) {
    const manifold_polygon *p = &c->state.polygon;
    const ovoid_manifold *m = c->given;
    corner_choice own;
    ovoid_code code = manifold_verify_counts(m, c->error);
    if (code != OVOID_OK || c->terms.keep > 0) return code;
    code = manifold_verify_choice(m, p, &own, c->error);
    if (code != OVOID_OK || m->corners <= 4) return code;
    double share = polygon_compute_share(p, &own);
    if (!(p->area > 0) || fabs(share - (double)m->share) <= 1e-6) return OVOID_OK;
    return refuse(c, "share %.9g; the points have %.9g", (double)m->share, share);
}

// ---- the whole ----

static ovoid_code verify_apart(const checker *c) {
    static const uint32_t none[4];
    const ovoid_manifold *m = c->given;
    int is_empty = !m->count && !m->corners && !m->feature_a && !m->feature_b && !m->facet_a && !m->facet_b &&
                   !(m->share < 0 || m->share > 0);
    for (int i = 0; i < 4; i++) is_empty &= m->id[i] == none[i];
    if (m->limit != OVOID_LIMIT_CAP || m->proof != OVOID_MANIFOLD_PROOF_NONE || !is_empty)
        return refuse(c, "a contact without an axis has points, features, a proof or a limit that is not the cap");
    if (m->status != OVOID_SEPARATED || !(m->lower > c->terms.margin) || m->upper != INFINITY)
        return refuse(c, "bodies that are not shown to be farther apart than the margin");
    return verify_lower(c);
}

static ovoid_code verify_contact(checker *c) {
    const ovoid_manifold *m = c->given;
    if (m->count > 4 || !manifold_open(c->frame, m, &c->state)) return refuse(c, "the features are none of the bodies");
    for (uint32_t i = m->count; i < 4; i++)
        if (m->id[i]) return refuse(c, "an id without a point");
    vec3 n = frame_direction_to_world(c->frame, c->state.frame.n);
    if (!(vec3_norm(vec3_sub(n, m->normal)) <= 1e-12)) return refuse(c, "the normal is not that of the features");
    if (max2(c->state.a.steepness, c->state.b.steepness) * c->terms.least > 1 + 1e-5)
        return refuse(c, "a facet that is turned from the plane of contact by more than the angle");
    c->axis = (manifold_axis){m->axis, m->feature_a, m->feature_b};
    manifold_clip(&c->terms, &c->axis, m, &c->state);
    ovoid_code code = verify_lower(c);
    if (code == OVOID_OK) code = verify_upper(c);
    for (uint32_t i = 0; i < m->count && code == OVOID_OK; i++) code = verify_point(c, i);
    if (code == OVOID_OK) code = verify_deepest(c);
    if (code == OVOID_OK) code = verify_polygon(c);
    const ovoid_verdict verdict = {.status = m->status, .lower = m->lower, .upper = m->upper};
    if (code == OVOID_OK) code = status_verify_internal(verdict, c->terms.tolerance, c->error);
    return code == OVOID_OK ? verify_limit(c) : code;
}

static ovoid_code verify(const ovoid_pair *pair, const ovoid_manifold *given, const ovoid_manifold_options *options,
                         ovoid_error *error) {
    OVOID_ASSERT(pair && given);
    ordered_pair o = ordered_pair_make(pair, given);
    checker c = {.given = &o.manifold, .error = error};
    pair_frame f;
    c.frame = &f;
    ovoid_limit refused = frame_make(pair, &f);
    if (refused == OVOID_LIMIT_NONE) (void)frame_make(&o.pair, &f);
    if (refused == OVOID_LIMIT_NONE && !manifold_terms_make(options, &f, &c.terms)) refused = OVOID_LIMIT_OPTIONS;
    const ovoid_verdict verdict = {
        .status = given->status, .limit = given->limit, .lower = given->lower, .upper = given->upper};
    if (refused != OVOID_LIMIT_NONE) return refusal_verify_internal(verdict, refused, error);
    if (!vec3_is_finite(given->normal) || !(fabs(vec3_norm(given->normal) - 1) <= 1e-12))
        return refuse(&c, "the normal is not a unit vector");
    return given->axis == OVOID_MANIFOLD_NONE ? verify_apart(&c) : verify_contact(&c);
}

ovoid_code ovoid_manifold_verify(const ovoid_pair *pair, const ovoid_manifold *manifold,
                                 const ovoid_manifold_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, pair, verify(pair, manifold, options, error));
}
