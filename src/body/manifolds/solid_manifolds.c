// The manifolds of a solid and a shape, or each part of a compound: one for each flat facet that a part touches.
//
// The tree gives the triangles near a part. Each facet among them is tried along its own normal first. Where the part
// is deepest beyond an edge at which the surface falls away, or is not over the facet, each of the facet's triangles
// with an edge like that is asked for its distance or depth, as a shape: the normal that is found counts if the solid
// rises nowhere beside the point along it. So an edge inside of a flat region has no contact, at a convex edge the
// normal lies between those of both facets, and at a concave one each facet has its own contact: a normal must be one
// that its feature has (G. van den Bergen, Smooth mesh contacts with GJK, 2010).
//
// Cost: the triangles near the part; one look at the facets' triangles for each facet; a query of two shapes for each
// triangle at an edge.
#include "body/manifolds/solid_pair.h"

#include "base/compiler.h"
#include "body/body_find.h"

#include <string.h>

// What is known of a facet while the triangles near a part are visited. A facet that another one has displaced is
// looked at again, but gives no second manifold.
typedef enum facet_state {
    FACET_NEW = 0,
    FACET_FAR,  // farther than the margin, or taken: no triangle of it is looked at
    FACET_EDGES // only edges and corners of it may touch
} facet_state;
typedef struct facet_note {
    uint32_t facet;
    facet_state state;
} facet_note;

enum { NOTES = 64 };

typedef struct solid_search {
    solid_pair pair;
    manifold_terms terms;
    tree_ends ends; ///< of the part, grown by the margin
    const manifolds_request *request;
    manifolds_found *found;
    uint32_t part;
    int is_exchanged; ///< the caller's body A is the solid
    facet_note notes[NOTES];
    triangle_shape triangle;
} solid_search;

// ---- a manifold

static const ovoid_manifold *find_earlier(const solid_search *s, uint32_t part_b, ovoid_manifold *room) {
    ovoid_body_manifold key = {.part_a = s->part, .part_b = part_b};
    if (s->is_exchanged) key = (ovoid_body_manifold){.part_a = part_b, .part_b = s->part};
    const ovoid_manifold *earlier = manifolds_request_find_earlier(s->request, &key);
    if (!earlier || !s->is_exchanged) return earlier;
    *room = ovoid_manifold_make_swapped(earlier);
    return room;
}

// The part's feature that is clipped: its facet that faces the normal, or an edge or vertex of it.
static uint32_t choose_facet(const solid_search *s, vec3 n, const ovoid_manifold *earlier) {
    const ovoid_shape *a = s->pair.part.shape;
    uint32_t low = shape_find_extreme(a, n).index, edge = shape_find_low_edge(a, n, low, 1e-8 * s->pair.frame.size);
    facet_choice choice = {n,
                           edge == UINT32_MAX ? OVOID_MANIFOLD_VERTEX | low : edge,
                           low,
                           earlier ? earlier->facet_a : 0,
                           earlier != NULL,
                           s->terms.least};
    return facet_choose(a, &choice);
}

typedef struct contact_features {
    uint32_t a, b;
    vec3 given; ///< the world normal that a search found, or zero
} contact_features;

static void emit(solid_search *s, const facet_contact *c, const contact_features *features, manifold_state *state) {
    ovoid_manifold_points points = {.count = 0};
    ovoid_manifold room;
    const uint32_t part_b = s->pair.solid->order[c->plane.facet];
    corner_choice chosen = corners_choose(state, find_earlier(s, part_b, &room), s->terms.slack);
    ovoid_body_manifold item;
    memset(&item, 0, sizeof item);
    ovoid_manifold *m = &item.manifold;
    m->normal = c->axis == OVOID_MANIFOLD_FREE ? features->given : frame_direction_to_world(&s->pair.frame, c->n);
    m->axis = c->axis;
    m->feature_a = features->a;
    m->feature_b = features->b;
    m->facet_a = c->facet_a;
    m->facet_b = c->facet_b;
    corner_choice_write(&chosen, &state->polygon, m);
    for (uint32_t i = 0; i < chosen.count; i++) state->polygon.corners[i] = state->polygon.corners[chosen.index[i]];
    state->polygon.count = chosen.count;
    facet_contact_measure(&s->pair, &s->terms, state, m);
    if (m->lower > s->terms.margin || !facet_contact_is_top(&s->pair, c, state)) return;
    if (s->request->has_points)
        facet_contact_write_points(&s->pair, state, &(points_order){chosen.count, s->is_exchanged}, &points);
    item.part_a = s->is_exchanged ? part_b : s->part;
    item.part_b = s->is_exchanged ? s->part : part_b;
    if (s->is_exchanged) *m = ovoid_manifold_make_swapped(m);
    s->request->take(s->request->context, &item, s->request->has_points ? &points : NULL);
}

// ---- along a facet's normal

static facet_contact make_along(const solid_search *s, const facet_plane *plane, const ovoid_manifold *earlier) {
    facet_contact c = {.axis = OVOID_MANIFOLD_FACE_B, .plane = *plane};
    c.n = solid_pair_turn_normal(&s->pair, plane->normal);
    c.facet_a = choose_facet(s, c.n, earlier);
    c.facet_b = OVOID_MANIFOLD_FACET | s->pair.solid->order[plane->facet];
    return c;
}

// place: the triangle of the facet that is visited.
COMPILER_NOINLINE static facet_state try_facet(solid_search *s, const facet_plane *plane, uint32_t place) {
    manifold_state state;
    facet_depths depths;
    int is_through;
    ovoid_manifold room;
    const ovoid_manifold *earlier = find_earlier(s, s->pair.solid->order[plane->facet], &room);
    facet_contact c = make_along(s, plane, earlier);
    clip_rules rules = facet_contact_make_rules(&s->pair, &s->terms, earlier);
    if (!facet_contact_clip(&s->pair, &(facet_clip){&c, &rules, &s->ends}, &state, &depths)) return FACET_FAR;
    s->found->tested++;
    int counts = facet_contact_counts(&s->pair, &c, &state, &depths, &is_through);
    int is_first = depths.first == place;
    s->found->through += is_first && is_through && !counts;
    if (!counts) return is_through ? FACET_FAR : FACET_EDGES;
    const contact_features features = {OVOID_MANIFOLD_VERTEX | state.frame.low_a, c.facet_b, {0, 0, 0}};
    if (is_first) emit(s, &c, &features, &state);
    return FACET_FAR;
}

// ---- along another normal

// A normal that a search found, in the frame, and the solid's point there.
typedef struct found_normal {
    vec3 n, given, x;
} found_normal;

// 0 where the triangle is farther than the margin.
COMPILER_NOINLINE static int search_triangle(solid_search *s, uint32_t place, found_normal *found) {
    const solid_pair *p = &s->pair;
    const vec3 corner[3] = {solid_get_corner(p->solid, place, 0), solid_get_corner(p->solid, place, 1),
                            solid_get_corner(p->solid, place, 2)};
    triangle_set(&s->triangle, corner);
    const ovoid_pair pair = {p->part.shape, &s->triangle.shape, p->part.pose, *p->pose};
    query_goal goal = query_goal_make_depth(NULL);
    goal.far = s->terms.margin;
    ovoid_answer answer;
    answer_find_internal(&pair, &(query_request){.goal = &goal}, &answer);
    s->found->tested++;
    if (answer.lower > s->terms.margin || !(vec3_norm_squared(answer.normal) > 0.5)) return 0;
    found->given = answer.normal;
    found->n = vec3_unit(frame_direction_from_world(&p->frame, answer.normal));
    found->x = mat3_mul_transposed_vec3(p->frame.world_b, vec3_sub(answer.point_b, p->pose->position));
    return 1;
}

// Where the normal is that of a facet of the part, to rounding, that facet makes it.
static void set_axis(const solid_search *s, found_normal *found, facet_contact *c, contact_features *features) {
    const ovoid_shape *a = s->pair.part.shape;
    c->axis = OVOID_MANIFOLD_FREE;
    features->a = features->b = OVOID_MANIFOLD_DIRECTION;
    features->given = found->given;
    if (feature_get_kind(c->facet_a) == OVOID_MANIFOLD_FACET) {
        vec3 n = shape_get_facet_normal(a, feature_get_index(c->facet_a));
        if (vec3_dot(n, found->n) >= 1 - 1e-9) {
            c->axis = OVOID_MANIFOLD_FACE_A;
            features->a = c->facet_a;
            found->n = n;
        }
    }
    c->n = found->n;
}

// The solid's edge or vertex at a point, where its facets face the normal too little to be clipped: the highest edge of
// the triangle there.
static uint32_t find_feature(const solid_search *s, uint32_t place, vec3 up) {
    const ovoid_solid *solid = s->pair.solid;
    double height[3], most = -INFINITY;
    for (int i = 0; i < 3; i++) most = max2(most, height[i] = vec3_dot(up, solid_get_corner(solid, place, i)));
    int top = height[0] >= most ? 0 : height[1] >= most ? 1 : 2;
    for (int i = 0; i < 3; i++)
        if (most - min2(height[i], height[(i + 1) % 3]) <= s->pair.snap)
            return OVOID_MANIFOLD_EDGE | (3 * solid->order[place] + (uint32_t)i);
    return OVOID_MANIFOLD_VERTEX | solid->triangles[place].point[top];
}

COMPILER_NOINLINE static void try_normal(solid_search *s, uint32_t place, found_normal *found) {
    manifold_state state;
    facet_depths depths;
    facet_contact c = {.plane = {.facet = UINT32_MAX}};
    contact_features features;
    vec3 up = vec3_neg(solid_pair_get_direction(&s->pair, found->n));
    if (!solid_pair_is_top(&s->pair, found->x, up, &c.plane)) return;
    ovoid_manifold room;
    uint32_t part_b = s->pair.solid->order[c.plane.facet];
    const ovoid_manifold *earlier = find_earlier(s, part_b, &room);
    c.facet_a = choose_facet(s, found->n, earlier);
    set_axis(s, found, &c, &features);
    c.facet_b = OVOID_MANIFOLD_FACET | part_b;
    if (vec3_dot(c.plane.normal, up) < s->terms.least) c.facet_b = find_feature(s, place, up);
    if (c.axis == OVOID_MANIFOLD_FACE_A) features.b = c.facet_b;
    clip_rules rules = facet_contact_make_rules(&s->pair, &s->terms, earlier);
    if (facet_contact_clip(&s->pair, &(facet_clip){&c, &rules, &s->ends}, &state, &depths) && state.polygon.count)
        emit(s, &c, &features, &state);
}

static int has_edge(const solid_search *s, uint32_t place, const facet_plane *plane) {
    for (int i = 0; i < 3; i++) {
        solid_bend bend = solid_get_bend(s->pair.solid, place, i);
        if (bend == SOLID_OPEN || bend == (plane->is_turned ? SOLID_CONCAVE : SOLID_CONVEX)) return 1;
    }
    return 0;
}

// ---- the search

static void visit(solid_search *s, uint32_t place) {
    const ovoid_solid *solid = s->pair.solid;
    uint32_t facet = solid->facets[place];
    facet_note *note = &s->notes[facet % NOTES];
    if (solid->bends[place] & SOLID_NO_AREA) return;
    int is_known = note->state != FACET_NEW && note->facet == facet;
    if (is_known && note->state == FACET_FAR) return;
    facet_plane plane = solid_pair_get_plane(&s->pair, facet);
    if (!is_known) {
        const pair_frame *f = &s->pair.frame;
        double gap = solid_pair_measure_gap(&s->pair, solid_pair_turn_normal(&s->pair, plane.normal), plane.point);
        int is_far = gap - f->lower_radii - f->claim - solid->flatness > s->terms.margin;
        *note = (facet_note){facet, is_far ? FACET_FAR : try_facet(s, &plane, place)};
    }
    found_normal found;
    if (note->state == FACET_EDGES && has_edge(s, place, &plane) && search_triangle(s, place, &found))
        try_normal(s, place, &found);
}

static ovoid_limit search_part(solid_search *s, const ovoid_posed_shape *part, const ovoid_body *solid) {
    ovoid_limit refused = solid_pair_make(&s->pair, part, solid);
    if (refused != OVOID_LIMIT_NONE) return refused;
    if (!manifold_terms_make(s->request->options, &s->pair.frame, &s->terms)) return OVOID_LIMIT_OPTIONS;
    memset(s->notes, 0, sizeof s->notes);
    s->ends = solid_pair_make_ends(&s->pair, s->terms.margin);
    place_walk walk;
    place_walk_begin(&walk, s->pair.solid, &s->ends);
    for (uint32_t place; (place = place_walk_get_next(&walk)) != UINT32_MAX;) {
        s->found->visited++;
        visit(s, place);
    }
    return OVOID_LIMIT_NONE;
}

static ovoid_limit exchange_limit(ovoid_limit limit) {
    return limit == OVOID_LIMIT_POSE_A ? OVOID_LIMIT_POSE_B : limit == OVOID_LIMIT_POSE_B ? OVOID_LIMIT_POSE_A : limit;
}

// The bracket of the bodies, with the solid as the second whichever it is.
COMPILER_NOINLINE static ovoid_limit search_bodies(const ovoid_body_pair *pair, const manifolds_request *request,
                                                   manifolds_found *found) {
    ovoid_body_answer answer;
    const ovoid_body_pair turned = {pair->b, pair->a};
    const query_goal goal = query_goal_make_within(request->options ? request->options->margin : 0);
    const body_request of_bodies = {.goal = &goal};
    body_find_internal(pair->a.solid ? &turned : pair, &of_bodies, &answer);
    found->lower = answer.lower;
    found->upper = answer.upper;
    found->visited = answer.visited;
    found->tested = answer.tested;
    if (answer.lower > -INFINITY) return OVOID_LIMIT_NONE;
    return pair->a.solid ? exchange_limit(answer.limit) : answer.limit;
}

COMPILER_NOINLINE static ovoid_limit search_parts(const ovoid_body_pair *pair, const manifolds_request *request,
                                                  manifolds_found *found) {
    solid_search s;
    body_tree tree;
    s.request = request;
    s.found = found;
    s.is_exchanged = pair->a.solid != NULL;
    triangle_begin(&s.triangle);
    const ovoid_body *solid = s.is_exchanged ? &pair->a : &pair->b, *other = s.is_exchanged ? &pair->b : &pair->a;
    ovoid_limit refused = OVOID_LIMIT_NONE;
    if (!body_tree_make(other, &tree)) return s.is_exchanged ? OVOID_LIMIT_POSE_B : OVOID_LIMIT_POSE_A;
    for (uint32_t i = 0; i < tree.count && refused == OVOID_LIMIT_NONE; i++) {
        ovoid_posed_shape part = body_tree_get_leaf(&tree, i, NULL);
        s.part = body_tree_get_index(&tree, i);
        refused = search_part(&s, &part, solid);
    }
    return refused;
}

ovoid_limit solid_manifolds_find(const ovoid_body_pair *pair, const manifolds_request *request,
                                 manifolds_found *found) {
    ovoid_limit refused = search_bodies(pair, request, found);
    double margin = request->options ? request->options->margin : 0;
    if (refused != OVOID_LIMIT_NONE || found->lower > margin) return refused;
    return search_parts(pair, request, found);
}
