// What makes a contact of a part and a facet one, and what it claims. All of it is measured from the features alone, in
// the query and again by the verifier.
//
// Along the facet's normal a contact counts where the part is deepest over the facet itself, not beyond an edge at
// which the surface falls away: there a normal between those of the edge's facets tells more. It is left out where
// another facet nearby is a shorter way out of the solid, or where the part has gone through the solid there.
#include "body/manifolds/solid_pair.h"

#include "base/environment.h"
#include "base/error.h"
#include "query/answer.h"

#include <string.h>

// ---- reading

static int read_plane(solid_pair *p, uint32_t part_b, facet_plane *plane) {
    const ovoid_solid *s = p->solid;
    if (part_b >= s->triangle_count) return 0;
    uint32_t place = s->places[part_b];
    if (s->facets[place] != place || s->bends[place] & SOLID_NO_AREA) return 0;
    *plane = solid_pair_get_plane(p, place);
    return 1;
}

int facet_contact_read(solid_pair *p, const ovoid_body_manifold *item, facet_contact *c) {
    const ovoid_manifold *m = &item->manifold;
    uint32_t facet = OVOID_MANIFOLD_FACET | item->part_b;
    if (m->count < 1 || m->count > 4 || !read_plane(p, item->part_b, &c->plane)) return 0;
    if (feature_get_kind(m->facet_b) == OVOID_MANIFOLD_FACET && m->facet_b != facet) return 0;
    c->facet_a = m->facet_a;
    c->facet_b = m->facet_b;
    c->axis = m->axis;
    switch (m->axis) {
    case OVOID_MANIFOLD_FACE_B:
        c->n = solid_pair_turn_normal(p, c->plane.normal);
        return m->feature_b == facet && m->facet_b == facet;
    case OVOID_MANIFOLD_FACE_A:
        if (feature_get_kind(m->feature_a) != OVOID_MANIFOLD_FACET) return 0;
        if (!shape_has_feature(p->part.shape, m->feature_a) || m->feature_b != m->facet_b) return 0;
        c->n = shape_get_facet_normal(p->part.shape, feature_get_index(m->feature_a));
        return 1;
    case OVOID_MANIFOLD_FREE:
        c->n = vec3_unit(frame_direction_from_world(&p->frame, m->normal));
        return m->feature_a == OVOID_MANIFOLD_DIRECTION && m->feature_b == OVOID_MANIFOLD_DIRECTION &&
               vec3_norm_squared(c->n) > 0.5;
    default: return 0;
    }
}

clip_rules facet_contact_make_rules(const solid_pair *p, const manifold_terms *t, const ovoid_manifold *earlier) {
    const pair_frame *f = &p->frame;
    clip_rules rules = {.snap = p->snap, .most = t->margin + f->a->radius + p->snap, .keep = t->keep};
    if (earlier && rules.keep > rules.snap)
        rules.kept = earlier->id, rules.kept_count = earlier->count < 4 ? earlier->count : 4;
    return rules;
}

// ---- does it count?

int solid_pair_is_top(const solid_pair *p, vec3 x, vec3 up, facet_plane *best) {
    const ovoid_solid *s = p->solid;
    double room = 4 * p->snap + s->flatness, near = room / p->slack, most = -2;
    const tree_ends ends = solid_make_ends(s, x, near);
    place_walk walk;
    place_walk_begin(&walk, s, &ends);
    for (uint32_t place; (place = place_walk_get_next(&walk)) != UINT32_MAX;) {
        if (s->bends[place] & SOLID_NO_AREA) continue;
        if (!(vec3_norm(vec3_sub(solid_find_nearest(s, place, x), x)) <= near)) continue;
        for (int i = 0; i < 3; i++) {
            vec3 d = vec3_sub(solid_get_corner(s, place, i), x);
            if (vec3_dot(up, d) > p->slack * (2 * room + 1e-6 * vec3_norm(d))) return 0;
        }
        facet_plane plane = solid_pair_get_plane(p, s->facets[place]);
        double cosine = vec3_dot(plane.normal, up);
        if (s->report.is_closed && cosine < -1e-6 * p->slack) return 0;
        int is_better = cosine > most + 1e-9 || (cosine > most - 1e-9 && plane.facet < best->facet);
        if (!is_better) continue;
        most = cosine;
        *best = plane;
    }
    return most > -2;
}

int facet_contact_is_top(const solid_pair *p, const facet_contact *c, const manifold_state *s) {
    const manifold_corner *lowest = &s->polygon.corners[0];
    if (c->axis == OVOID_MANIFOLD_FACE_B) return 1;
    for (uint32_t i = 1; i < s->polygon.count; i++)
        if (s->polygon.corners[i].separation < lowest->separation) lowest = &s->polygon.corners[i];
    double height = patch_get_height(&s->a, lowest->x, lowest->y) + lowest->separation;
    facet_plane best = {.facet = UINT32_MAX};
    return solid_pair_is_top(p, facet_contact_place(p, s, (vec3){lowest->x, lowest->y, height}),
                             vec3_neg(solid_pair_get_direction(p, c->n)), &best);
}

// A point of the part that is in contact, in the solid's frame, and how deep it is along the normal.
typedef struct deep_point {
    vec3 x;
    double depth;
} deep_point;

static deep_point make_deep_point(const solid_pair *p, const manifold_state *s, double x, double y) {
    double a = patch_get_height(&s->a, x, y) + p->part.shape->radius, b = patch_get_height(&s->b, x, y);
    return (deep_point){facet_contact_place(p, s, (vec3){x, y, a}), a - b};
}

// Is the facet the way out of the solid at a point of the part? Not where a triangle nearer to the point belongs to a
// facet along whose normal the whole part is less deep, or where the point has left the solid on its other side.
static int is_way_out(const solid_pair *p, const facet_contact *c, const deep_point *at, int *is_through) {
    const ovoid_solid *s = p->solid;
    double within = at->depth * (1 - 1e-6) - p->snap, own = solid_pair_measure_gap(p, c->n, c->plane.point);
    if (!(within > 0)) return 1;
    const tree_ends ends = solid_make_ends(s, at->x, within);
    place_walk walk;
    place_walk_begin(&walk, s, &ends);
    for (uint32_t place; (place = place_walk_get_next(&walk)) != UINT32_MAX;) {
        if (s->bends[place] & SOLID_NO_AREA || s->facets[place] == c->plane.facet) continue;
        vec3 away = vec3_sub(at->x, solid_find_nearest(s, place, at->x));
        if (!(vec3_norm(away) < within)) continue;
        facet_plane plane = solid_pair_get_plane(p, s->facets[place]);
        double height = vec3_dot(plane.normal, away);
        int leaves = height > p->snap && vec3_dot(plane.normal, c->plane.normal) < 0;
        if (height > p->snap && !leaves) continue;
        double other = solid_pair_measure_gap(p, solid_pair_turn_normal(p, plane.normal), plane.point);
        if (other > own + p->snap) return 0;
        *is_through |= leaves;
        if (leaves) return 0;
    }
    return 1;
}

int facet_contact_counts(const solid_pair *p, const facet_contact *c, const manifold_state *s, const facet_depths *d,
                         int *is_through) {
    const manifold_polygon *polygon = &s->polygon;
    double gap = solid_pair_measure_gap(p, c->n, c->plane.point), x = 0, y = 0;
    *is_through = 0;
    if (!(d->least <= d->most)) return 0;
    if (!(d->least <= gap + p->snap || d->vertex <= d->least + p->snap || d->concave <= d->least + p->snap)) return 0;
    if (!p->solid->report.is_closed || !polygon->count) return 1;
    for (uint32_t i = 0; i < polygon->count; i++) x += polygon->corners[i].x, y += polygon->corners[i].y;
    deep_point middle = make_deep_point(p, s, x / polygon->count, y / polygon->count);
    if (is_way_out(p, c, &middle, is_through)) return 1;
    for (uint32_t i = 0; i < polygon->count; i++) {
        deep_point corner = make_deep_point(p, s, polygon->corners[i].x, polygon->corners[i].y);
        if (is_way_out(p, c, &corner, is_through)) return 1;
    }
    return 0;
}

// ---- what it claims

// From the top of the part to the solid where it is lowest at the first corners of the state.
static double find_gap(const solid_pair *p, const manifold_state *s, uint32_t count) {
    simd_points points = shape_get_points(p->part.shape);
    double lowest = count ? INFINITY : s->b.at.z[0];
    for (uint32_t i = 0; i < count; i++) {
        const manifold_corner *c = &s->polygon.corners[i];
        lowest = min2(lowest, patch_get_height(&s->a, c->x, c->y) + c->separation);
    }
    return lowest - simd_find_support(&points, &s->frame.n).value;
}

void facet_contact_measure(const solid_pair *p, const manifold_terms *t, const manifold_state *s, ovoid_manifold *out) {
    const pair_frame *f = &p->frame;
    const manifold_frame *m = &s->frame;
    double least = INFINITY, pad = manifold_compute_rounding(s);
    for (uint32_t i = 0; i < out->count; i++) least = min2(least, s->polygon.corners[i].separation);
    // Along its own normal the facet's plane is level: no slope adds to the rounding.
    int is_level = out->axis == OVOID_MANIFOLD_FACE_B;
    double lower = find_gap(p, s, is_level ? 0 : out->count) - f->lower_radii - (is_level ? f->claim : pad);
    out->lower = frame_take_gain(lower, frame_compute_gain(f, m->n, m->n_in_b, AXIS_CLAIM));
    out->upper = max2(least - f->upper_radii + pad, out->lower);
    out->proof = OVOID_MANIFOLD_PROOF_NORMAL;
    out->status = bracket_find_status(out->lower, out->upper, t->tolerance);
    int is_narrow = out->upper - out->lower <= t->tolerance + frame_get_allowance(f);
    out->limit = is_narrow ? OVOID_LIMIT_NONE : OVOID_LIMIT_PRECISION;
}

void facet_contact_write_points(const solid_pair *p, manifold_state *s, const points_order *order,
                                ovoid_manifold_points *out) {
    double steep = max2(s->a.steepness, s->b.steepness);
    s->frame.gap = find_gap(p, s, order->count);
    manifold_write_points(s, &(corner_choice){order->count, {0, 1, 2, 3}, 1}, order->is_exchanged, out);
    out->grown += p->solid->flatness * steep;
}

// ---- a manifold of two bodies

// The part beside the solid, and the manifold as if the solid came second.
typedef struct given_contact {
    solid_pair pair;
    ovoid_body_manifold item;
    int is_exchanged;
} given_contact;

// 0, or where it refuses a part 1 for a and 2 for b.
static int give(const ovoid_body_pair *pair, const ovoid_body_manifold *item, given_contact *g) {
    body_tree tree;
    g->is_exchanged = pair->a.solid != NULL;
    g->item = *item;
    if (g->is_exchanged)
        g->item = (ovoid_body_manifold){item->part_b, item->part_a, ovoid_manifold_make_swapped(&item->manifold)};
    const ovoid_body *solid = g->is_exchanged ? &pair->a : &pair->b, *other = g->is_exchanged ? &pair->b : &pair->a;
    int of_solid = g->is_exchanged ? 1 : 2;
    if (other->solid || !body_tree_make(other, &tree) || g->item.part_a >= tree.count) return 3 - of_solid;
    if (!body_is_one(solid) || g->item.part_b >= solid->solid->triangle_count) return of_solid;
    ovoid_posed_shape part = body_tree_get_leaf(&tree, body_tree_get_place(&tree, g->item.part_a), NULL);
    if (solid_pair_make(&g->pair, &part, solid) != OVOID_LIMIT_NONE) return of_solid;
    // Corners by their ids are where they were but for rounding.
    g->pair.slack = 2;
    return 0;
}

// The corners of a manifold's points, in their order.
static int open_corners(given_contact *g, facet_contact *c, manifold_state *s) {
    const ovoid_manifold *m = &g->item.manifold;
    if (!facet_contact_read(&g->pair, &g->item, c) || !facet_contact_open(&g->pair, c, s)) return 0;
    const facet_corner_query query = {&g->pair, c, s};
    for (uint32_t i = 0; i < m->count; i++)
        if (!facet_contact_find_corner(&query, m->id[i], &s->polygon.corners[i])) return 0;
    s->polygon.count = m->count;
    return 1;
}

void solid_manifold_compute_points(const ovoid_body_pair *pair, const ovoid_body_manifold *item,
                                   ovoid_manifold_points *points) {
    given_contact g;
    facet_contact c;
    manifold_state s;
    memset(points, 0, sizeof *points);
    if (give(pair, item, &g) || !open_corners(&g, &c, &s)) return;
    facet_contact_write_points(&g.pair, &s, &(points_order){s.polygon.count, g.is_exchanged}, points);
}

// ---- verifying

typedef struct verifier {
    given_contact given;
    facet_contact contact;
    manifold_terms terms;
    ovoid_error *error;
} verifier;

#define refuse(v, ...) error_set((v)->error, OVOID_ERROR_PROOF, -1, __VA_ARGS__)

static ovoid_code verify_features(verifier *v, const manifold_state *s) {
    const ovoid_manifold *m = &v->given.item.manifold;
    const solid_pair *p = &v->given.pair;
    vec3 n = frame_direction_to_world(&p->frame, v->contact.n);
    if (!vec3_is_finite(m->normal) || !(vec3_norm(vec3_sub(n, m->normal)) <= 1e-12))
        return refuse(v, "the normal is not that of the features");
    if (m->axis == OVOID_MANIFOLD_FACE_B && m->feature_a != (OVOID_MANIFOLD_VERTEX | s->frame.low_a))
        return refuse(v, "the part's feature is not its vertex nearest to the facet");
    for (uint32_t i = m->count; i < 4; i++)
        if (m->id[i]) return refuse(v, "an id without a point");
    return OVOID_OK;
}

static ovoid_code verify_bracket(verifier *v, const manifold_state *s) {
    const ovoid_manifold *m = &v->given.item.manifold;
    ovoid_manifold found = {.axis = m->axis, .count = m->count};
    facet_contact_measure(&v->given.pair, &v->terms, s, &found);
    if (!(m->lower <= found.lower && m->upper >= max2(found.upper, m->lower)))
        return refuse(v, "bracket [%.17g, %.17g], the normal shows [%.17g, %.17g]", m->lower, m->upper, found.lower,
                      found.upper);
    if (m->proof != OVOID_MANIFOLD_PROOF_NORMAL) return refuse(v, "a proof that a facet of a solid does not have");
    int is_narrow = m->upper - m->lower <= v->terms.tolerance + frame_get_allowance(&v->given.pair.frame);
    if (m->limit != (is_narrow ? OVOID_LIMIT_NONE : OVOID_LIMIT_PRECISION))
        return refuse(v, "limit %s does not follow from the bracket", ovoid_limit_get_name(m->limit));
    const ovoid_verdict verdict = {.status = m->status, .lower = m->lower, .upper = m->upper};
    return status_verify_internal(verdict, v->terms.tolerance, v->error);
}

static ovoid_code verify_point(verifier *v, const manifold_state *s, uint32_t i) {
    const ovoid_manifold *m = &v->given.item.manifold;
    const manifold_corner *c = &s->polygon.corners[i];
    const solid_pair *p = &v->given.pair;
    for (uint32_t k = 0; k < i; k++)
        if (m->id[k] == m->id[i]) return refuse(v, "points %u and %u are the same", k, i);
    if (feature_get_kind(c->id) == OVOID_MANIFOLD_ID_NEAREST)
        return m->count == 1 ? OVOID_OK : refuse(v, "the nearest points beside corners");
    if (!(c->outside <= 2 * max2(p->snap, v->terms.keep) + p->solid->flatness))
        return refuse(v, "point %u is outside of a body by %.3g", i, c->outside);
    if (!(c->separation <= v->terms.margin + p->part.shape->radius + 2 * p->snap))
        return refuse(v, "point %u is %.17g apart, beyond the margin", i, c->separation);
    return OVOID_OK;
}

// The polygon again: without kept corners it does not depend on earlier contacts. With them the number of corners and
// the share are only in range.
static ovoid_code verify_polygon(verifier *v, manifold_state *s) {
    const ovoid_manifold *m = &v->given.item.manifold;
    solid_pair *p = &v->given.pair;
    facet_depths depths;
    int is_through;
    ovoid_code code = manifold_verify_counts(m, v->error);
    if (code != OVOID_OK) return code;
    const clip_rules rules = facet_contact_make_rules(p, &v->terms, NULL);
    const tree_ends ends = solid_pair_make_ends(p, v->terms.margin);
    if (!facet_contact_clip(p, &(facet_clip){&v->contact, &rules, &ends}, s, &depths))
        return refuse(v, "the features are none of the bodies");
    if (m->axis == OVOID_MANIFOLD_FACE_B && !facet_contact_counts(p, &v->contact, s, &depths, &is_through))
        return refuse(v, "the part is not nearest to the solid over this facet");
    if (v->terms.keep > 0) return OVOID_OK;
    corner_choice own;
    code = manifold_verify_choice(m, &s->polygon, &own, v->error);
    if (code != OVOID_OK || m->corners <= 4) return code;
    double share = polygon_compute_share(&s->polygon, &own);
    if (fabs(share - (double)m->share) <= 1e-6) return OVOID_OK;
    return refuse(v, "share %.9g; the points have %.9g", (double)m->share, share);
}

COMPILER_NOINLINE static ovoid_code verify_corners(verifier *v) {
    manifold_state s;
    if (!open_corners(&v->given, &v->contact, &s)) return refuse(v, "the features are none of the bodies");
    ovoid_code code = verify_features(v, &s);
    if (code == OVOID_OK) code = verify_bracket(v, &s);
    for (uint32_t i = 0; i < s.polygon.count && code == OVOID_OK; i++) code = verify_point(v, &s, i);
    if (code != OVOID_OK || facet_contact_is_top(&v->given.pair, &v->contact, &s)) return code;
    return refuse(v, "the solid rises beside the contact, along the normal");
}

COMPILER_NOINLINE static ovoid_code verify_whole(verifier *v) {
    manifold_state s;
    return verify_polygon(v, &s);
}

ovoid_code solid_manifold_verify(const ovoid_body_pair *pair, const ovoid_body_manifold *item,
                                 const ovoid_manifold_options *options, ovoid_error *error) {
    verifier v = {.error = error};
    int refused = give(pair, item, &v.given);
    if (refused)
        return error_set(
            error, OVOID_ERROR_PROOF, refused - 1,
            "part %u of body %c: it has none of that number, both bodies are solids, or its pose is refused",
            refused == 1 ? item->part_a : item->part_b, "ab"[refused - 1]);
    if (!manifold_terms_make(options, &v.given.pair.frame, &v.terms))
        return error_set(error, OVOID_ERROR_PROOF, -1, "the options are refused, so there is no contact");
    ovoid_code code = verify_corners(&v);
    return code == OVOID_OK ? verify_whole(&v) : code;
}
