// Theorem. Let h(n) be the overlap of a polyhedron and a cylinder or a cone along a unit n, and n* a direction in which
// it is the least, and above 0. By the theorem of query/swept/circles.c n* is
// - the axis of a disc, at w or -w;
// - on the arc between the normals of two facets beside an edge, with its ends (query/swept/arcs.c), or
// - where a vertex goes straight to the axis of a cylinder, or to the side of a cone.
//
// Most arcs are shown by one point. Let z be a point of the difference body, and the heights z.m and z.n along the
// normals at an arc's ends be at least r > 0. Any unit direction between is a sum of m and n whose weights are together
// 1 at least, so h is at least r along the arc. z is a vertex at the arc's edge, less the round body's farthest point
// along m, n or m + n.
//
// The normals are those of the Gauss map, as they are stored: its cells cover all directions, whatever was rounded
// (shape/gauss_map.c). Along the corners of a vertex's cell the vertex is no lower than the others by more than the
// map's bulge, and a unit vector of the cell is a sum of these of at most the map's spread. So h and the height of the
// cell's vertex differ by spread times bulge at most, and by as much those of both vertices along an arc. Heights are
// kept to 6 u s.
//
// Errors as in query/swept/circles.c; the vertices are off their points by 2 u s.
#include "query/swept/arcs.h"
#include "query/swept/hull_map.h"

// A hull beside a round body.
typedef struct hull_search {
    edged_search of;
    hull_map hull; ///< its points are the round body's farthest ones
} hull_search;

// ---- directions

static inline vec3 get3(const double v[3]) { return (vec3){v[0], v[1], v[2]}; }

// The round body's farthest point against n, of about the length 1, reversed.
static inline vec3 find_point(const edged_search *q, vec3 n) {
    const vec3 w = get3(q->axis);
    const double t = vec3_dot(n, w);
    // The part along the axis that rounding leaves is cut off once more, as in query/swept/patch.h.
    vec3 off = vec3_add_scaled(n, w, -t);
    off = vec3_add_scaled(off, w, -vec3_dot(off, w));
    const double square = vec3_norm_squared(off), across = sqrt(square);
    const int is_apex = q->is_cone && -2 * q->height * t >= q->radius * across;
    const double scale = is_apex || !(square > 0x1p-102) ? 0 : q->radius / across,
                 up = q->is_cone ? (is_apex ? -q->height : q->height) : copysign(q->height, t);
    return vec3_sub(vec3_add_scaled(vec3_scale(w, up), off, scale), get3(q->center));
}

static void take_facets(hull_search *q) {
    hull_map *h = &q->hull;
    h->least = INFINITY, h->least_facet = 0;
    for (uint32_t f = 0; f < h->map->facets; f++)
        hull_map_take_point(h, f, find_point(&q->of, hull_map_get_normal(h, f)));
    const vec3 n = hull_map_get_normal(h, h->least_facet);
    edged_take(&q->of, h->least, (double[]){n.x, n.y, n.z}, FREE_EDGED, 0);
}

static void take(hull_search *q, const double n[3]) {
    const vec3 along = get3(n);
    const double hull = simd_find_support(&q->hull.points, &along).value;
    edged_take(&q->of, hull + edged_measure_round(&q->of, n) - dot3(n, q->of.center), n, FREE_ROUND, 0);
}

static void take_axis(hull_search *q) {
    const double *w = q->of.axis, back[3] = {-w[0], -w[1], -w[2]};
    take(q, w);
    take(q, back);
}

// Where a vertex is not the farthest along its direction, its cell has no minimum within, and the overlap there is as
// good as others.
static void take_vertices(hull_search *q, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        const vec3 at = vec3_sub(hull_map_get_vertex(&q->hull, i), get3(q->of.center));
        const double v[3] = {at.x, at.y, at.z};
        double n[3];
        if (edged_aim_corner(&q->of, v, n)) take(q, n);
    }
}

// ---- arcs

// Is an arc shown by the round body's points at its ends?
static inline int is_short(const hull_map *h, uint32_t f, uint32_t g, double wanted) {
    return hull_map_get_low(h, g) + vec3_dot(hull_map_get_point(h, f), hull_map_get_normal(h, g)) >= wanted ||
           hull_map_get_low(h, f) + vec3_dot(hull_map_get_point(h, g), hull_map_get_normal(h, f)) >= wanted;
}

// Is it by the one in its middle?
static int is_short_by_middle(const hull_search *q, uint32_t f, uint32_t g) {
    const vec3 m = hull_map_get_normal(&q->hull, f), n = hull_map_get_normal(&q->hull, g),
               at = find_point(&q->of, vec3_add(m, n));
    const double first = hull_map_get_low(&q->hull, f) + vec3_dot(at, m),
                 second = hull_map_get_low(&q->hull, g) + vec3_dot(at, n);
    return min2(first, second) >= q->of.low;
}

// The unit vectors of the plane in which an arc is, the first one its first end.
static patch_plane find_plane(const hull_map *h, uint32_t arc) {
    const vec3 m = hull_map_get_normal(h, h->list[0][arc]),
               across = vec3_unit(vec3_cross(m, hull_map_get_normal(h, h->list[1][arc]))), e = vec3_cross(across, m);
    return (patch_plane){vec3_cross(m, e), {m, e}};
}

static plane_vector project(const patch_plane *of, vec3 v) {
    return (plane_vector){vec3_dot(of->e[0], v), vec3_dot(of->e[1], v)};
}

static int hold_arc(hull_search *q, uint32_t arc) {
    const patch_plane of = find_plane(&q->hull, arc);
    const vec3 w = get3(q->of.axis);
    const double along = vec3_dot(of.n, w);
    arc_plane o = arcs_make_plane(&q->of, (int)arc, project(&of, w), along * along);
    const plane_vector last = project(&of, hull_map_get_normal(&q->hull, q->hull.list[1][arc]));
    o.first = (plane_vector){1, 0};
    o.last = unit2(last.x, last.y);
    o.corner = project(&of, vec3_sub(hull_map_get_vertex(&q->hull, q->hull.list[2][arc]), get3(q->of.center)));
    o.side = 1;
    return arcs_hold(&q->of, &o);
}

static int hold_arcs(hull_search *q) {
    const hull_map *h = &q->hull;
    for (uint32_t arc = 0; arc < h->map->arcs; arc++) {
        const uint32_t f = h->list[0][arc], g = h->list[1][arc];
        if (is_short(h, f, g, q->of.low) || is_short_by_middle(q, f, g)) continue;
        if (!(hold_arc(q, arc) && q->of.low > 0)) return 0;
    }
    return 1;
}

// ---- all

static int is_round(const ovoid_swept_sphere *s) {
    return s->core == OVOID_SWEPT_CYLINDER || s->core == OVOID_SWEPT_CONE;
}

int cores_have_hull_arcs(const cores *p) {
    return (is_round(p->a) && hull_map_is_of(p->b)) || (is_round(p->b) && hull_map_is_of(p->a));
}

// The direction in the world.
static edged_direction find_direction(const hull_search *q) {
    vec3 n = get3(q->of.n);
    if (q->of.is_on_arc) {
        const patch_plane of = find_plane(&q->hull, (uint32_t)q->of.edge);
        n = vec3_add_scaled(vec3_scale(of.e[0], q->of.in_plane.x), of.e[1], q->of.in_plane.y);
    }
    return (edged_direction){q->hull.is_b, vec3_unit(patch_turn_back(q->hull.of, n)), {0, 0, 0}};
}

int cores_search_hull_arcs(const cores *p, double tolerance, least_overlap *at, double *doubt) {
    hull_search q;
    hull_map_set(p, &q.hull);
    const int is_b = q.hull.is_b;
    const ovoid_swept_sphere *hull = q.hull.of, *round = is_b ? p->a : p->b;
    *doubt = hull_map_find_doubt(&q.hull, p->size);
    if (!(*doubt <= HULL_DOUBT * p->size)) return 0;
    const vec3 axis = patch_turn(hull, round->axis[0]),
               center = vec3_sub(patch_turn(hull, is_b ? vec3_neg(p->d) : p->d), hull->shape->origin);
    q.of = edged_make(p, is_b, axis, center, tolerance);
    take_facets(&q);
    take_axis(&q);
    take_vertices(&q, hull->shape->vertex_count);
    if (!(q.of.low > 0 && hold_arcs(&q))) return 0;
    const edged_direction of = find_direction(&q);
    return edged_set_points(p, &q.of, &of, at);
}
