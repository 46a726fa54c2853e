// The corners of a contact of a part and a facet of a solid, seen along the normal: vertices of the part over the
// facet, corners of the facet's boundary over the part, and crossings of their edges. Of the facet's triangles those
// near the part are looked at one by one, so edges inside of the facet have no part in it. The facet may have any
// outline; the polygon is the convex hull of the corners (A. M. Andrew, Another efficient algorithm for convex hulls in
// two dimensions, 1979).
#include "body/manifolds/solid_pair.h"

#include <string.h>

enum { OTHERS = OVOID_MANIFOLD_CORNERS };

// A clip in the making. The part's vertices come before the other corners, so their number is known from the start.
typedef struct facet_clipper {
    const solid_pair *pair;
    const facet_contact *contact;
    const clip_rules *rules;
    manifold_state *state;
    facet_depths *depths;
    double outside[PATCH_CORNERS]; // how far the part's vertices are from the facet's triangles
    uint32_t count;
    manifold_corner others[OTHERS];
} facet_clipper;

// A triangle across the normal, counter-clockwise.
typedef struct flat_triangle {
    double x[4], y[4], z[3]; // the first corner again at the end
    int corner[3];           // of the solid's triangle
    uint32_t place;
} flat_triangle;

static vec3 place_point(const manifold_frame *m, vec3 x) {
    return (vec3){vec3_dot(m->u_in_b, x) + m->tu, vec3_dot(m->v_in_b, x) + m->tv, vec3_dot(m->n_in_b, x) + m->tn};
}

static double get_turn(const flat_triangle *t, int i, double x, double y) {
    return (t->x[i + 1] - t->x[i]) * (y - t->y[i]) - (t->y[i + 1] - t->y[i]) * (x - t->x[i]);
}

static flat_triangle flatten(const facet_clipper *c, uint32_t place) {
    flat_triangle t;
    const manifold_frame *m = &c->state->frame;
    t.place = place;
    for (int i = 0; i < 3; i++) {
        vec3 x = place_point(m, solid_get_corner(c->pair->solid, place, i));
        t.x[i] = x.x, t.y[i] = x.y, t.z[i] = x.z, t.corner[i] = i;
    }
    t.x[3] = t.x[0], t.y[3] = t.y[0];
    if (get_turn(&t, 0, t.x[2], t.y[2]) >= 0) return t;
    flat_triangle turned = {.corner = {t.corner[0], t.corner[2], t.corner[1]}, .place = place};
    for (int i = 0; i < 4; i++) turned.x[i] = t.x[3 - i], turned.y[i] = t.y[3 - i];
    for (int i = 0; i < 3; i++) turned.z[i] = t.z[(3 - i) % 3];
    return turned;
}

static double measure_distance(const flat_triangle *t, double x, double y) {
    if (get_turn(t, 0, x, y) >= 0 && get_turn(t, 1, x, y) >= 0 && get_turn(t, 2, x, y) >= 0) return 0;
    double nearest = INFINITY;
    for (int i = 0; i < 3; i++) nearest = min2(nearest, segment_measure_square(&t->x[i], &t->y[i], (vec3){x, y, 0}));
    return sqrt(nearest);
}

// ---- the hull of corners

static int is_before(const manifold_corner *p, const manifold_corner *q) {
    if (p->x != q->x) return p->x < q->x;
    return p->y != q->y ? p->y < q->y : p->id < q->id;
}

static void sort(manifold_corner *c, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        manifold_corner one = c[i];
        uint32_t k = i;
        for (; k > 0 && is_before(&one, &c[k - 1]); k--) c[k] = c[k - 1];
        c[k] = one;
    }
}

// 1 if the middle of three corners is not to the right of the line through the others by more than the snap.
static int is_needless(const manifold_corner *p, const manifold_corner *q, const manifold_corner *r, double snap) {
    double x = r->x - p->x, y = r->y - p->y;
    return x * (q->y - p->y) - y * (q->x - p->x) >= -snap * sqrt(x * x + y * y);
}

static void push(manifold_corner *hull, uint32_t *count, uint32_t least, const manifold_corner *c, double snap) {
    while (*count > least && is_needless(&hull[*count - 2], &hull[*count - 1], c, snap)) --*count;
    if (*count <= OTHERS) hull[(*count)++] = *c; // more than there are corners only where rounding has no order
}

// Replaces corners by those of their hull, counter-clockwise. Returns how many there are.
static uint32_t reduce_to_hull(manifold_corner *c, uint32_t count, double snap) {
    manifold_corner hull[OTHERS + 2];
    uint32_t kept = 0;
    if (count < 3) return count;
    sort(c, count);
    for (uint32_t i = 0; i < count; i++) push(hull, &kept, 1, &c[i], snap);
    uint32_t lower = kept;
    for (uint32_t i = count - 1; i-- > 0;) push(hull, &kept, lower, &c[i], snap);
    kept--;
    memcpy(c, hull, kept * sizeof *c);
    return kept;
}

// ---- the corners of the boundary

static void note_depth(facet_clipper *c, double separation, int is_concave) {
    c->depths->least = min2(c->depths->least, separation);
    if (is_concave) c->depths->concave = min2(c->depths->concave, separation);
}

static void add_other(facet_clipper *c, const manifold_corner *corner, int is_concave) {
    note_depth(c, corner->separation, is_concave);
    for (uint32_t i = 0; i < c->count; i++)
        if (c->others[i].id == corner->id) return;
    if (c->count == OTHERS) c->count = reduce_to_hull(c->others, c->count, c->rules->snap);
    if (c->count < OTHERS) c->others[c->count++] = *corner;
}

static uint32_t is_kept_id(const clip_rules *r, uint32_t id) {
    uint32_t found = 0;
    for (uint32_t i = 0; i < r->kept_count; i++) found |= r->kept[i] == id;
    return found;
}

// How far outside a corner may be.
static double get_room(const facet_clipper *c, uint32_t id) {
    return is_kept_id(c->rules, id) ? max2(c->rules->keep, c->rules->snap) : c->rules->snap;
}

// A vertex of the part's patch.
static manifold_corner make_vertex_a(const facet_clipper *c, uint32_t k, uint32_t kind) {
    const simd_patch *a = &c->state->a.at;
    double separation = patch_get_height(&c->state->b, a->x[k], a->y[k]) - a->z[k];
    uint32_t id = kind | a->vertices[k];
    return (manifold_corner){a->x[k], a->y[k], separation, c->outside[k], id, is_kept_id(c->rules, id)};
}

static void add_vertex(facet_clipper *c, const flat_triangle *t, int i, int rises) {
    const manifold_patch *a = &c->state->a;
    uint32_t id = OVOID_MANIFOLD_ID_VERTEX_B | c->pair->solid->triangles[t->place].point[t->corner[i]];
    double outside = patch_measure_distance(a, t->x[i], t->y[i]);
    if (!(outside <= get_room(c, id))) return;
    double separation = t->z[i] - patch_get_height(a, t->x[i], t->y[i]);
    const manifold_corner corner = {t->x[i], t->y[i], separation, outside, id, is_kept_id(c->rules, id)};
    add_other(c, &corner, rises);
}

// The edge of the solid's triangle that an edge of the flat one is.
static int get_edge(const flat_triangle *t, int i) {
    int from = t->corner[i], to = t->corner[(i + 1) % 3];
    return (from + 1) % 3 == to ? from : to;
}

// The edge from corner i of a triangle, and the edges of the part.
static void add_crossings(facet_clipper *c, const flat_triangle *t, int i, int rises) {
    const manifold_patch *a = &c->state->a;
    uint32_t edge = 3 * c->pair->solid->order[t->place] + (uint32_t)get_edge(t, i);
    for (uint32_t k = 0; k < patch_get_edge_count(a); k++) {
        double p = patch_get_side(a, k, t->x[i], t->y[i]), q = patch_get_side(a, k, t->x[i + 1], t->y[i + 1]);
        if ((p < 0) == (q < 0) || max2(fabs(p), fabs(q)) <= c->rules->snap) continue;
        if ((get_turn(t, i, a->at.x[k], a->at.y[k]) < 0) == (get_turn(t, i, a->at.x[k + 1], a->at.y[k + 1]) < 0))
            continue;
        double at = p / (p - q), x = t->x[i] + at * (t->x[i + 1] - t->x[i]), y = t->y[i] + at * (t->y[i + 1] - t->y[i]);
        uint32_t id = OVOID_MANIFOLD_ID_CROSSING | (a->edges[k] & 0x7fff) << 15 | (edge & 0x7fff);
        double separation = patch_get_height(&c->state->b, x, y) - patch_get_height(a, x, y);
        const manifold_corner corner = {x, y, separation, 0, id, is_kept_id(c->rules, id)};
        add_other(c, &corner, rises);
    }
}

static int is_concave(const facet_contact *contact, solid_bend bend) {
    return bend == (contact->plane.is_turned ? SOLID_CONVEX : SOLID_CONCAVE);
}

static void add_triangle(facet_clipper *c, uint32_t place) {
    const manifold_patch *a = &c->state->a;
    flat_triangle t = flatten(c, place);
    for (uint32_t k = 0; k < a->at.count; k++)
        if (c->outside[k] > 0) c->outside[k] = min2(c->outside[k], measure_distance(&t, a->at.x[k], a->at.y[k]));
    for (int i = 0; i < 3; i++) {
        solid_bend bend = solid_get_bend(c->pair->solid, place, get_edge(&t, i));
        int rises = is_concave(c->contact, bend);
        if (bend == SOLID_FLAT) continue;
        add_vertex(c, &t, i, rises);
        add_vertex(c, &t, (i + 1) % 3, rises);
        add_crossings(c, &t, i, rises);
    }
}

// ---- the polygon

// A corner that is nearer to one that is there than four times the snap is that corner; near a kept one the distance is
// that by which it may be outside.
static int is_there(const facet_clipper *c, const manifold_corner *corner) {
    const manifold_polygon *p = &c->state->polygon;
    double snap = 4 * c->rules->snap, keep = max2(c->rules->keep, snap);
    for (uint32_t i = 0; i < p->count; i++) {
        double dx = p->corners[i].x - corner->x, dy = p->corners[i].y - corner->y;
        double near = p->corners[i].is_kept && !corner->is_kept ? keep : snap;
        if (dx * dx + dy * dy < near * near) return 1;
    }
    return 0;
}

// One of the kept corners, or of the others. Corners farther apart than the margin are none.
static void append(facet_clipper *c, const manifold_corner *corner, uint32_t is_kept) {
    manifold_polygon *p = &c->state->polygon;
    if (corner->is_kept != is_kept || !(corner->separation <= c->rules->most)) return;
    if (p->count < OVOID_MANIFOLD_CORNERS && !is_there(c, corner)) p->corners[p->count++] = *corner;
}

// The part's vertices over the facet, then the corners of the boundary, then crossings.
static void gather(facet_clipper *c, uint32_t is_kept) {
    for (uint32_t k = 0; k < c->state->a.at.count; k++) {
        const manifold_corner corner = make_vertex_a(c, k, OVOID_MANIFOLD_ID_VERTEX_A);
        if (!(corner.outside <= get_room(c, corner.id))) continue;
        note_depth(c, corner.separation, 0);
        c->depths->vertex = min2(c->depths->vertex, corner.separation);
        append(c, &corner, is_kept);
    }
    for (int crossings = 0; crossings < 2; crossings++)
        for (uint32_t i = 0; i < c->count; i++)
            if ((feature_get_kind(c->others[i].id) == OVOID_MANIFOLD_ID_CROSSING) == crossings)
                append(c, &c->others[i], is_kept);
}

// Where the facet and the part have no corner in common that counts: the part's vertex that is nearest to the facet.
static void add_nearest(facet_clipper *c) {
    const manifold_patch *a = &c->state->a;
    uint32_t best = 0;
    for (uint32_t k = 1; k < a->at.count; k++)
        if (c->outside[k] < c->outside[best]) best = k;
    if (!(c->outside[best] < INFINITY)) return;
    c->state->polygon.corners[0] = make_vertex_a(c, best, OVOID_MANIFOLD_ID_NEAREST);
    c->state->polygon.count = 1;
}

// The plane of the facet as a patch without corners.
static void set_plane(const facet_contact *c, manifold_state *s) {
    manifold_patch *b = &s->b;
    const manifold_frame *m = &s->frame;
    vec3 q = place_point(m, c->plane.point), n = c->plane.normal;
    b->at.count = 0;
    b->at.x[0] = q.x, b->at.y[0] = q.y, b->at.z[0] = q.z;
    patch_set_slope(b, (vec3){vec3_dot(m->u_in_b, n), vec3_dot(m->v_in_b, n), vec3_dot(m->n_in_b, n)});
}

// An edge of the solid or a point of it as a patch.
static int set_feature(const solid_pair *p, uint32_t feature, manifold_state *s) {
    const ovoid_solid *solid = p->solid;
    manifold_patch *b = &s->b;
    uint32_t index = feature_get_index(feature), place = 0;
    int is_edge = feature_get_kind(feature) == OVOID_MANIFOLD_EDGE;
    if (index >= (is_edge ? 3 * solid->triangle_count : solid->point_count)) return 0;
    if (is_edge) place = solid->places[index / 3];
    double x[8], y[8], z[8];
    uint32_t points[2];
    for (uint32_t i = 0; i < 8; i++) {
        uint32_t point = is_edge ? solid->triangles[place].point[(index + i % 2) % 3] : index;
        vec3 at = vec3_at(solid->points, point);
        x[i] = at.x, y[i] = at.y, z[i] = at.z;
        points[i % 2] = point;
    }
    const manifold_frame *m = &s->frame;
    vec3 u = m->u_in_b, v = m->v_in_b, n = m->n_in_b;
    const simd_placing placing = {{x, y, z, 8}, {u.x, u.y, u.z, v.x, v.y, v.z, n.x, n.y, n.z}, {m->tu, m->tv, m->tn}};
    b->at.count = is_edge ? 2 : 1;
    for (uint32_t i = 0; i < 2; i++) b->at.vertices[i] = i, b->edges[i] = index;
    patch_place(&placing, b);
    for (uint32_t i = 0; i < 2; i++) b->at.vertices[i] = points[i];
    return 1;
}

int facet_contact_open(solid_pair *p, const facet_contact *c, manifold_state *s) {
    if (!shape_has_feature(p->part.shape, c->facet_a)) return 0;
    gap_along along = gap_measure_along(&p->frame, c->n);
    manifold_frame_make(&p->frame, &along, &s->frame);
    // Of the solid the frame has one point: it does not show the gap.
    s->frame.gap = -INFINITY;
    s->facet_a = c->facet_a;
    s->facet_b = c->facet_b;
    s->polygon.count = 0;
    s->polygon.area = 0;
    patch_make_a(&s->frame, c->facet_a, &s->a);
    if (feature_get_kind(c->facet_b) != OVOID_MANIFOLD_FACET) return set_feature(p, c->facet_b, s);
    set_plane(c, s);
    return 1;
}

static void add_triangles(facet_clipper *c, const tree_ends *ends) {
    const ovoid_solid *s = c->pair->solid;
    uint32_t facet = c->contact->plane.facet;
    c->depths->first = facet;
    if (s->bends[facet] & SOLID_ALONE) {
        add_triangle(c, facet);
        return;
    }
    c->depths->first = UINT32_MAX;
    place_walk walk;
    place_walk_begin(&walk, s, ends);
    for (uint32_t place; (place = place_walk_get_next(&walk)) != UINT32_MAX;) {
        if (s->facets[place] != facet) continue;
        if (c->depths->first == UINT32_MAX) c->depths->first = place;
        add_triangle(c, place);
    }
}

int facet_contact_clip(solid_pair *p, const facet_clip *clip, manifold_state *s, facet_depths *depths) {
    facet_clipper c = {
        .pair = p, .contact = clip->contact, .rules = clip->rules, .state = s, .depths = depths, .count = 0};
    *depths = (facet_depths){INFINITY, INFINITY, INFINITY, clip->rules->most, UINT32_MAX};
    if (!facet_contact_open(p, clip->contact, s)) return 0;
    if (feature_get_kind(clip->contact->facet_b) != OVOID_MANIFOLD_FACET) {
        patches_clip(s, clip->rules);
        return 1;
    }
    for (uint32_t k = 0; k < s->a.at.count; k++) c.outside[k] = INFINITY;
    add_triangles(&c, clip->ends);
    if (clip->rules->kept_count) gather(&c, 1);
    gather(&c, 0);
    s->polygon.count = reduce_to_hull(s->polygon.corners, s->polygon.count, clip->rules->snap);
    s->polygon.area = s->polygon.count > 2 ? polygon_compute_area(&s->polygon) : 0;
    if (!s->polygon.count) add_nearest(&c);
    return 1;
}

// ---- corners by their ids

// How far a point of the facet's plane is from the facet, by balls that grow until one holds a triangle of it. Within
// the flatness it is on the facet.
static double measure_outside(const facet_clipper *c, vec3 at) {
    const ovoid_solid *s = c->pair->solid;
    double nearest = INFINITY, flat = s->flatness + 16 * c->pair->frame.claim;
    for (double r = 2 * c->pair->snap + flat; !(nearest <= r) && r < 16 * c->pair->frame.size; r *= 4) {
        const tree_ends ends = solid_make_ends(s, at, r);
        place_walk walk;
        place_walk_begin(&walk, s, &ends);
        for (uint32_t place; (place = place_walk_get_next(&walk)) != UINT32_MAX;)
            if (s->facets[place] == c->contact->plane.facet && !(s->bends[place] & SOLID_NO_AREA))
                nearest = min2(nearest, vec3_norm(vec3_sub(at, solid_find_nearest(s, place, at))));
    }
    return nearest <= flat ? 0 : nearest;
}

static int find_vertex_a(const facet_clipper *c, uint32_t id, manifold_corner *corner) {
    const manifold_state *s = c->state;
    uint32_t index = feature_get_index(id);
    if (index >= s->frame.pair->a->vertex_count) return 0;
    vec3 x = frame_place_a(&s->frame, index);
    double height = patch_get_height(&s->b, x.x, x.y);
    *corner = (manifold_corner){x.x, x.y, height - x.z, 0, id, 0};
    if (s->b.at.count)
        corner->outside = patch_measure_distance(&s->b, x.x, x.y);
    else
        corner->outside = measure_outside(c, facet_contact_place(c->pair, s, (vec3){x.x, x.y, height}));
    return corner->outside < INFINITY;
}

static int find_vertex_b(const facet_clipper *c, uint32_t id, manifold_corner *corner) {
    const manifold_state *s = c->state;
    uint32_t index = feature_get_index(id);
    if (index >= c->pair->solid->point_count) return 0;
    vec3 x = place_point(&s->frame, vec3_at(c->pair->solid->points, index));
    double outside = patch_measure_distance(&s->a, x.x, x.y);
    *corner = (manifold_corner){x.x, x.y, x.z - patch_get_height(&s->a, x.x, x.y), outside, id, 0};
    return 1;
}

static int take_crossing(const facet_clipper *c, uint32_t id, manifold_corner *corner) {
    for (uint32_t i = 0; i < c->count; i++)
        if (c->others[i].id == id) {
            *corner = c->others[i];
            return 1;
        }
    return 0;
}

// Edges whose names end with the same 15 bits: the first that crosses is taken.
static int find_crossing(facet_clipper *c, uint32_t id, manifold_corner *corner) {
    const ovoid_solid *s = c->pair->solid;
    for (uint32_t edge = id & 0x7fff; edge < 3 * s->triangle_count; edge += 0x8000) {
        uint32_t place = s->places[edge / 3];
        int own = (int)(edge % 3);
        if (s->facets[place] != c->contact->plane.facet || solid_get_bend(s, place, own) == SOLID_FLAT) continue;
        flat_triangle t = flatten(c, place);
        c->count = 0;
        for (int i = 0; i < 3; i++)
            if (get_edge(&t, i) == own) add_crossings(c, &t, i, 0);
        if (take_crossing(c, id, corner)) return 1;
    }
    return 0;
}

// An edge of the solid in the place of its facet.
static int find_feature_crossing(const facet_clipper *c, uint32_t id, manifold_corner *corner) {
    const manifold_state *s = c->state;
    edge_crossing x = {.j = 0};
    for (; s->b.at.count == 2 && x.i < patch_get_edge_count(&s->a); x.i++) {
        if (crossing_make_id(&s->a, &s->b, &x) != id || !patches_cross(&s->a, &s->b, &x)) continue;
        double separation = patch_get_height(&s->b, x.x, x.y) - patch_get_height(&s->a, x.x, x.y);
        *corner = (manifold_corner){x.x, x.y, separation, 0, id, 0};
        return 1;
    }
    return 0;
}

int facet_contact_find_corner(const facet_corner_query *q, uint32_t id, manifold_corner *corner) {
    static const clip_rules rules = {.snap = 0};
    facet_depths depths = {.least = 0};
    facet_clipper c = {.pair = q->pair, .contact = q->contact, .rules = &rules, .state = q->state, .depths = &depths};
    switch (feature_get_kind(id)) {
    case OVOID_MANIFOLD_ID_VERTEX_B: return find_vertex_b(&c, id, corner);
    case OVOID_MANIFOLD_ID_CROSSING:
        return q->state->b.at.count ? find_feature_crossing(&c, id, corner) : find_crossing(&c, id, corner);
    default: return find_vertex_a(&c, id, corner);
    }
}
