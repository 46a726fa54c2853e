// r, the greatest distance of a point of the solid from its nearest part.
//
// Upper bound: the distance from a convex part is convex, so in a cell it is greatest at a corner, and the cell is
// bounded by the least, over the parts, of the greatest distance of its four corners. A cell that no triangle crosses
// is either completely inside or completely outside of the solid; outside it has no point of it. Lower bound: points
// inside the solid, and points of its triangles, by the least of the lower bounds of the core.
//
// A cell is cut by the plane that touches its nearest part, moved outward by nearly the tolerance: the piece on the
// part's side is then done, and the piece beyond belongs to another part, or is outside of the solid. So parts whose
// faces are faces of the solid, or of each other, need no cells as small as the tolerance.
#include "decompose/searches.h"

#include <string.h>

static double find_box_distance(const body_part *p, const cell *c) {
    double most = 0;
    for (int i = 0; i < 4; i++) {
        box at = {c->corner[i], c->corner[i]};
        most = max2(most, box_compute_distance(&at, &p->bounds));
    }
    return most;
}

// The greatest distance of the four corners from a part; need not be exact above `cap`.
static double find_farthest(const body *b, const cell *c, uint32_t part, double cap) {
    double most = 0;
    for (int i = 0; i < 4 && most < cap; i++) most = max2(most, body_probe_part(b, part, c->corner[i], cap).upper);
    return most;
}

double uncovered_find_least(const body *b, vec3 x, uint32_t first, uint32_t *nearest) {
    double least = INFINITY;
    box at = {x, x};
    for (uint32_t k = 0; k < b->part_count && least > 0; k++) {
        uint32_t i = k == 0 ? first : k == first ? 0 : k;
        if (box_compute_distance(&at, &b->parts[i].bounds) >= least) continue;
        double d = body_probe_part(b, i, x, least).lower;
        if (d < least) least = d, *nearest = i;
    }
    return least;
}

static void try_point(cell_search *s, vec3 x, uint32_t part) {
    const body *b = s->problem;
    // Few points are farther than the farthest so far: one part that is near enough excludes the others.
    if (body_probe_part(b, part, x, s->lower).upper <= s->lower) return;
    double d = uncovered_find_least(b, x, part, &part);
    cell_search_raise(s, d, x, part);
}

// The piece of the solid in a cell: the triangles that cross the cell, and the cell's corners inside. The hull of these
// contains the piece, since every other point on the border of the piece is not a corner of its hull.
enum { CROSSING = 512, TABLE = 4096 };
typedef struct share {
    uint32_t count;                ///< of triangles; CROSSING + 1: more
    uint32_t points[3 * CROSSING]; ///< of the triangles, by index, each once
    uint32_t point_count;
    vec3 corners[4];
    int corner_count;
} share;

static void add_point(share *own, uint32_t *table, uint32_t point) {
    uint32_t at = point * 2654435769u >> 20;
    for (; table[at] != UINT32_MAX; at = (at + 1) % TABLE)
        if (table[at] == point) return;
    table[at] = point;
    own->points[own->point_count++] = point;
}

static void find_share(const body *b, const cell *c, share *own) {
    uint32_t places[CROSSING], table[TABLE];
    own->count = body_list_crossing(b, c, places, CROSSING);
    own->point_count = 0;
    own->corner_count = 0;
    if (own->count > CROSSING) return;
    memset(table, 0xff, sizeof table);
    for (uint32_t i = 0; i < own->count; i++)
        for (int k = 0; k < 3; k++) add_point(own, table, b->solid->triangles[places[i]].point[k]);
    for (int i = 0; i < 4; i++)
        if (body_find_inside(b, c->corner[i]) != 0) own->corners[own->corner_count++] = c->corner[i];
}

// The greatest distance of the piece from a part; need not be exact from `cap` on.
static double find_farthest_share(const body *b, const share *own, uint32_t part, double cap) {
    double most = 0;
    for (int i = 0; i < own->corner_count && most < cap; i++)
        most = max2(most, body_probe_part(b, part, own->corners[i], cap).upper);
    for (uint32_t i = 0; i < own->point_count && most < cap; i++) {
        vec3 x = vec3_scale(vec3_at(b->solid->points, own->points[i]), b->inverse);
        most = max2(most, body_probe_part(b, part, x, cap).upper);
    }
    return most;
}

static void find_bound_share(cell_search *s, cell *c) {
    const body *b = s->problem;
    share own;
    find_share(b, c, &own);
    if (own.count > CROSSING) return;
    if (own.count == 0 && own.corner_count == 0) c->bound = 0;
    if (own.count == 0) return;
    double goal = cell_search_get_goal(s);
    uint32_t first = c->owner;
    for (uint32_t k = 0; k < b->part_count && c->bound > goal; k++) {
        uint32_t i = k == 0 ? first : k == first ? 0 : k;
        double d = find_farthest_share(b, &own, i, c->bound);
        if (d < c->bound) c->bound = d, c->owner = i;
    }
}

static void find_bound(cell_search *s, cell *c) {
    const body *b = s->problem;
    double goal = cell_search_get_goal(s), best = find_farthest(b, c, c->owner, INFINITY);
    for (uint32_t i = 0; i < b->part_count && best > goal; i++) {
        if (i == c->owner || find_box_distance(&b->parts[i], c) >= best) continue;
        double d = find_farthest(b, c, i, best);
        if (d < best) best = d, c->owner = i;
    }
    c->bound = min2(c->bound, best);
    if (c->bound <= goal) return;
    vec3 middle = cell_compute_middle(c);
    if (body_find_inside(b, middle) != 0) try_point(s, middle, c->owner);
    find_bound_share(s, c);
}

static cell_plane find_plane(cell_search *s, const cell *c, ovoid_plane *plane) {
    const body *b = s->problem;
    double goal = cell_search_get_goal(s), most = 0;
    part_distance farthest = {0};
    for (int i = 0; i < 4; i++) {
        part_distance d = body_probe_part(b, c->owner, c->corner[i], INFINITY);
        if (d.lower > most) most = d.lower, farthest = d;
    }
    if (!(most > goal)) return CELL_HALVES;
    plane->normal = farthest.normal;
    plane->offset = vec3_dot(farthest.normal, farthest.nearest) + s->lower + 0.75 * s->tolerance;
    return CELL_BOTH;
}

void uncovered_set_functions(cell_search *s) {
    s->find_bound = find_bound;
    s->find_plane = find_plane;
}

double uncovered_search(cell_search *s) {
    const body *b = s->problem;
    enum { POINTS = 1 << 14 };
    size_t vertices = 0;
    for (uint32_t i = 0; i < b->part_count; i++) vertices += ovoid_shape_get_polytope(b->parts[i].shape).vertex_count;
    // Fewer points are tried for parts of thousands of vertices, since each takes longer.
    uint32_t points = (uint32_t)min2(POINTS, 0x1p24 * b->part_count / (double)vertices);
    uncovered_set_functions(s);
    // The solid's points first, since the farthest are mostly corners.
    uint32_t step = b->solid->point_count / points + 1;
    for (uint32_t i = 0; i < b->solid->point_count; i += step)
        try_point(s, vec3_scale(vec3_at(b->solid->points, i), b->inverse), s->point_owner);
    box around = {vec3_scale(b->solid->report.box.min, b->inverse), vec3_scale(b->solid->report.box.max, b->inverse)};
    cell_search_add_box(s, &around, s->point_owner);
    return cell_search_run(s);
}
