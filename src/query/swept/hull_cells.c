// Theorem. Let z be a point of the difference body, and z.n_f at least r > 0 for all corners n_f of a cell of the
// hull's Gauss map. Any unit direction of the cell is a sum of these whose weights are together 1 at least, so no
// overlap along one is less than r. z is the cell's vertex less the ellipsoid's farthest point along the mean of the
// corners, or along the one that is the lowest. What these leave open is divided (query/swept/divide.c) into triangles
// around that mean.
//
// Errors, in parts u s as in swept.c: heights and cells as in query/swept/hull_arcs.c. With the half axes a, the least
// b, a point of the ellipsoid is off by 16 u a^2 / b.
#include "query/swept/hull_cells.h"

#include "query/swept/divide.h"

// The most points that a search asks for before it is left.
enum { MOST_POINTS = 600 };

static int is_ellipsoid(const ovoid_swept_sphere *s) { return s->core == OVOID_SWEPT_ELLIPSOID; }

int cores_have_hull_cells(const cores *p) {
    return (is_ellipsoid(p->a) && hull_map_is_of(p->b)) || (is_ellipsoid(p->b) && hull_map_is_of(p->a));
}

// The ellipsoid's farthest point against n, of any length, reversed.
static inline vec3 find_point(const hull_cells *c, vec3 n) {
    const vec3 at = ellipsoid_apply_form(&c->form, n);
    return vec3_sub(vec3_scale(at, 1 / sqrt(vec3_dot(at, n))), c->center);
}

// A direction from the hull to the ellipsoid, in the hull's frame, is one from A to B in the world.
static vec3 turn_out(const hull_map *h, vec3 n) {
    const vec3 to = vec3_unit(patch_turn_back(h->of, n));
    return h->is_b ? vec3_neg(to) : to;
}
static vec3 turn_in(const hull_map *h, vec3 n) { return vec3_unit(patch_turn(h->of, h->is_b ? vec3_neg(n) : n)); }

double hull_cells_make(const cores *p, hull_cells *to, vec3 *n) {
    hull_map *h = &to->hull;
    hull_map_set(p, h);
    const ovoid_swept_sphere *hull = h->of, *ellipsoid = h->is_b ? p->a : p->b;
    to->doubt = hull_map_find_doubt(h, p->size) + ellipsoid_find_doubt(ellipsoid);
    if (!(to->doubt <= HULL_DOUBT * p->size)) return INFINITY;
    to->center = vec3_sub(patch_turn(hull, h->is_b ? vec3_neg(p->d) : p->d), hull->shape->origin);
    to->form = ellipsoid_make_form(ellipsoid, hull->axis);
    h->least = INFINITY, h->least_facet = 0;
    for (uint32_t f = 0; f < h->map->facets; f++) hull_map_take_point(h, f, find_point(to, hull_map_get_normal(h, f)));
    *n = turn_out(h, hull_map_get_normal(h, h->least_facet));
    return h->least;
}

// How far a point in a facet's plane is within its edges.
static double measure_inside(const hull_map *h, uint32_t facet, vec3 y) {
    const vec3 n = hull_map_get_normal(h, facet);
    double least = INFINITY;
    for (uint32_t arc = 0; arc < h->map->arcs; arc++) {
        const uint32_t f = h->list[0][arc], g = h->list[1][arc];
        if (f != facet && g != facet) continue;
        const vec3 m = hull_map_get_normal(h, f == facet ? g : f);
        const double height = hull_map_get_low(h, f == facet ? g : f) - vec3_dot(m, y);
        least = min2(least, height / vec3_norm(vec3_cross(m, n)));
    }
    return least;
}

int hull_cells_find_facet(const hull_cells *c, const cores *p, least_overlap *at) {
    const hull_map *h = &c->hull;
    const uint32_t f = h->least_facet;
    const vec3 foot = vec3_sub(vec3_scale(hull_map_get_normal(h, f), h->least), hull_map_get_point(h, f));
    const double inside = measure_inside(h, f, foot);
    if (!(inside > 0x1p-20 * p->size)) return 0;
    at->of = patch_make_plane(turn_out(h, hull_map_get_normal(h, f)));
    const vec3 n = at->of.n;
    const overlap_ends ends = cores_find_ends(p, n);
    at->value = at->lowest = vec3_dot(n, ends.v);
    at->inside = inside, at->slope = 0;
    at->on_a = h->is_b ? ends.on_a : vec3_add(vec3_add(ends.on_b, p->d), vec3_scale(n, at->value));
    at->on_b = h->is_b ? vec3_sub(vec3_sub(ends.on_a, p->d), vec3_scale(n, at->value)) : ends.on_b;
    return least_overlap_add_piece(p, h->is_b, at);
}

// ---- cells

// A cell: its vertex, that less the ellipsoid's farthest point about along it, and if it is open the sum of its corners
// twice.
typedef struct hull_cell {
    const hull_cells *of;
    vec3 vertex, point, middle;
    int is_open;
} hull_cell;

static void make_cells(const hull_cells *c, double wanted, hull_cell *cells) {
    const hull_map *h = &c->hull;
    const ovoid_shape *hull = h->of->shape;
    for (uint32_t i = 0; i < hull->vertex_count; i++) {
        const vec3 vertex = hull_map_get_vertex(h, i);
        cells[i].of = c, cells[i].vertex = vertex;
        cells[i].point = find_point(c, vec3_sub(vertex, hull->inner.center));
        cells[i].middle = (vec3){0, 0, 0};
        cells[i].is_open = 0;
    }
    // Each corner of a cell is to one side of one of its arcs.
    for (uint32_t arc = 0; arc < h->map->arcs; arc++)
        for (int k = 0; k < 2; k++) {
            const uint32_t f = h->list[k][arc];
            hull_cell *to = &cells[h->list[2 + k][arc]];
            to->is_open |= !(hull_map_get_low(h, f) + vec3_dot(to->point, hull_map_get_normal(h, f)) >= wanted);
        }
    for (uint32_t arc = 0; arc < h->map->arcs; arc++)
        for (int k = 2; k < 4; k++) {
            hull_cell *to = &cells[h->list[k][arc]];
            if (to->is_open)
                to->middle = vec3_add(to->middle, vec3_add(hull_map_get_normal(h, h->list[0][arc]),
                                                           hull_map_get_normal(h, h->list[1][arc])));
        }
}

static vec3 find_end(const void *of, vec3 n) {
    const hull_cell *c = of;
    return vec3_add(c->vertex, find_point(c->of, n));
}

// The triangle of a cell beside an arc.
static int hold_triangle(const hull_cell *c, uint32_t arc, division *d) {
    const hull_map *h = &c->of->hull;
    const vec3 corner[3] = {vec3_unit(c->middle), hull_map_get_normal(h, h->list[0][arc]),
                            hull_map_get_normal(h, h->list[1][arc])},
               known = vec3_add(c->vertex, c->point);
    for (int k = 0; k < 2; k++) {
        const vec3 at = vec3_add(c->vertex, hull_map_get_point(h, h->list[k][arc]));
        if (min2(vec3_dot(at, corner[0]), min2(vec3_dot(at, corner[1]), vec3_dot(at, corner[2]))) >= d->wanted)
            return 1;
    }
    d->of = c;
    return division_hold(d, corner, &known);
}

int hull_cells_hold(const hull_cells *c, const cores *p, const least_overlap *at, double wanted, vec3 *less) {
    const hull_map *h = &c->hull;
    hull_cell cells[GAUSS_POINTS];
    *less = turn_out(h, hull_map_get_normal(h, h->least_facet));
    if (h->least < wanted) return 0;
    *less = (vec3){0, 0, 0};
    make_cells(c, wanted, cells);
    division d = division_make(p, at, wanted);
    d.find = find_end;
    d.n = turn_in(h, at->of.n);
    d.left = MOST_POINTS;
    for (uint32_t arc = 0; arc < h->map->arcs; arc++)
        for (int k = 0; k < 2; k++) {
            const hull_cell *of = &cells[h->list[2 + k][arc]];
            if (!of->is_open || hold_triangle(of, arc, &d)) continue;
            if (vec3_norm_squared(d.less) > 0) *less = turn_out(h, d.less);
            return 0;
        }
    return 1;
}
