// p, the greatest distance of a point of a part from the solid.
//
// Upper bound: the distance from a triangle is convex, so in a cell it is greatest at a corner; and the distance from
// the solid changes by no more than the point moves. A cell that no triangle crosses and whose middle is inside has no
// point outside. Lower bound: points of the parts, by the core's proven distance of a point from a solid.
//
// A cell is cut along the plane of a triangle that crosses it, moved to either side by nearly the tolerance: the inner
// piece is then done, and the piece between is within the tolerance of the triangle.
#include "decompose/searches.h"

static double find_farthest(const vec3 t[3], const cell *c) {
    double most = 0;
    for (int i = 0; i < 4; i++)
        most = max2(most, vec3_norm_squared(vec3_sub(c->corner[i], triangle_find_nearest(t, c->corner[i]))));
    return sqrt(most);
}

static void try_point(cell_search *s, vec3 x, double estimate, uint32_t part) {
    if (!(estimate > s->lower * (1 + 1e-9))) return;
    cell_search_raise(s, body_find_outside(s->problem, x), x, part);
}

// 1 if the plane that separates x from the part separates the whole cell: the core proves the part below n.x - lower.
static int is_parted(const body *b, const cell *c, vec3 x, const part_distance *d) {
    if (!(d->lower > 0)) return 0;
    for (int i = 0; i < 4; i++)
        if (!(vec3_dot(d->normal, vec3_sub(c->corner[i], x)) + d->lower > b->pad)) return 0;
    return 1;
}

// A cell whose middle is inside the solid. Let each triangle T that crosses it be near the part's own boundary, beyond
// a plane n.x = h - d_T, where h is the part's support along n. Let e be a lower bound of how far the middle is below
// all those planes, and d the greatest of d_T. Move a point x of the cell and the part toward the middle by a share d /
// (d + e) of the way: there it is below all planes, and the segment from there to the middle meets no triangle, so it
// is inside.
static void find_bound_inside(const body *b, cell *c, vec3 middle, int is_in_part) {
    enum { CROSSING = 4096 };
    uint32_t places[CROSSING], count = body_list_crossing(b, c, places, is_in_part ? CROSSING : 0);
    if (count == 0) c->bound = 0;
    if (count == 0 || count > CROSSING || !is_in_part) return;
    double depth = INFINITY, most = 0, reach = cell_compute_radius(c, middle);
    double sign = b->solid->report.volume < 0 ? -1 : 1;
    for (uint32_t i = 0; i < count; i++) {
        vec3 t[3];
        body_get_triangle(b, places[i], t);
        vec3 n = vec3_scale(vec3_unit(vec3_cross(vec3_sub(t[1], t[0]), vec3_sub(t[2], t[0]))), sign);
        int lowest = 0;
        for (int k = 1; k < 3; k++)
            if (vec3_dot(n, t[k]) < vec3_dot(n, t[lowest])) lowest = k;
        depth = min2(depth, vec3_dot(n, vec3_sub(t[lowest], middle)) - b->pad);
        if (!(depth > 0)) return;
        most = max2(most, body_find_depth(b, c->owner, t[lowest], n) + b->pad);
        if (most * reach > c->bound * (most + depth)) return;
    }
    c->bound = min2(c->bound, most * reach / (most + depth) * (1 + 16 * ROUNDING));
}

static void find_bound(cell_search *s, cell *c) {
    const body *b = s->problem;
    vec3 middle = cell_compute_middle(c), t[3];
    double distance, goal = cell_search_get_goal(s);
    c->hint = body_find_triangle(b, middle, c->hint, &distance);
    body_get_triangle(b, c->hint, t);
    double best = min2(find_farthest(t, c), distance + cell_compute_radius(c, middle));
    c->bound = min2(c->bound, best);
    if (c->bound <= goal) return;
    part_distance d = body_probe_part(b, c->owner, middle, INFINITY);
    int inside = body_find_inside(b, middle);
    if (inside == 0 && d.lower == 0) try_point(s, middle, distance, c->owner);
    if (is_parted(b, c, middle, &d))
        c->bound = 0;
    else if (inside == 1)
        find_bound_inside(b, c, middle, d.upper == 0);
}

// Finds a plane to cut along, where the cell reaches farther beyond an edge of the triangle, in its plane, than the
// margin: half the margin beyond the edge.
static int find_edge(const vec3 t[3], vec3 normal, const cell *c, double margin, ovoid_plane *plane) {
    double most = margin;
    for (int i = 0; i < 3; i++) {
        vec3 n = vec3_unit(vec3_cross(vec3_sub(t[(i + 1) % 3], t[i]), normal));
        double offset = vec3_dot(n, t[i]), beyond = -INFINITY;
        for (int k = 0; k < 4; k++) beyond = max2(beyond, vec3_dot(n, c->corner[k]) - offset);
        if (beyond > most) most = beyond, *plane = (ovoid_plane){n, offset + 0.5 * margin};
    }
    return most > margin;
}

// Finds a plane to cut along, where a corner of the cell is farther from the part than the margin: half the margin
// beyond the part.
static int find_face(const body *b, const cell *c, double margin, ovoid_plane *plane) {
    double most = margin;
    for (int i = 0; i < 4; i++) {
        part_distance d = body_probe_part(b, c->owner, c->corner[i], INFINITY);
        if (!(d.lower > most)) continue;
        most = d.lower;
        *plane = (ovoid_plane){d.normal, vec3_dot(d.normal, c->corner[i]) - d.lower + 0.5 * margin};
    }
    return most > margin;
}

static double find_longest(const vec3 *points, int count) {
    double longest = 0;
    for (int i = 0; i < count; i++)
        for (int k = i + 1; k < count; k++) longest = max2(longest, vec3_norm_squared(vec3_sub(points[k], points[i])));
    return sqrt(longest);
}

static cell_plane find_plane(cell_search *s, const cell *c, ovoid_plane *plane) {
    const body *b = s->problem;
    if (find_face(b, c, 0.5 * cell_search_get_goal(s), plane)) return CELL_BELOW;
    uint32_t place = c->hint;
    if (!body_is_crossed(b, c, &place)) return CELL_HALVES;
    vec3 t[3];
    body_get_triangle(b, place, t);
    // A cell much larger than the triangle is halved instead.
    if (find_longest(c->corner, 4) > 2 * find_longest(t, 3)) return CELL_HALVES;
    vec3 n = vec3_unit(vec3_cross(vec3_sub(t[1], t[0]), vec3_sub(t[2], t[0])));
    double offset = vec3_dot(n, t[0]), low = INFINITY, high = -INFINITY, side = s->lower + 0.75 * s->tolerance;
    for (int i = 0; i < 4; i++) {
        double d = vec3_dot(n, c->corner[i]) - offset;
        low = min2(low, d);
        high = max2(high, d);
    }
    // Cuts on the side where the cell reaches farther; a cell that is within the slab along the triangle is cut at the
    // triangle's edges.
    if (max2(-low, high) <= side + 0.05 * s->tolerance)
        return find_edge(t, n, c, 0.5 * side, plane) ? CELL_BOTH : CELL_HALVES;
    plane->normal = n;
    plane->offset = offset + (-low > high ? -side : side);
    return CELL_BOTH;
}

// ---- the first points and cells

static vec3 get_point(const body *b, const ovoid_polytope *p, uint32_t i) {
    return vec3_scale(vec3_add(p->origin, vec3_at(p->vertices, i)), b->inverse);
}

// Tries the parts' vertices and the middles of their faces, since the farthest points are mostly on faces.
static void try_part(cell_search *s, uint32_t part) {
    const body *b = s->problem;
    ovoid_polytope p = ovoid_shape_get_polytope(b->parts[part].shape);
    uint32_t hint = 0;
    for (uint32_t t = 0; t < p.triangle_count; t++) {
        vec3 sum = {0, 0, 0};
        for (int k = 0; k < 3; k++) sum = vec3_add(sum, get_point(b, &p, p.triangles[3 * (size_t)t + (size_t)k]));
        vec3 x = vec3_scale(sum, 1.0 / 3);
        double distance;
        hint = body_find_triangle(b, x, hint, &distance);
        if (distance > s->lower && body_find_inside(b, x) == 0) try_point(s, x, distance, part);
    }
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        vec3 x = get_point(b, &p, i);
        double distance;
        hint = body_find_triangle(b, x, hint, &distance);
        if (distance > s->lower && body_find_inside(b, x) == 0) try_point(s, x, distance, part);
    }
}

void excess_set_functions(cell_search *s) {
    s->find_bound = find_bound;
    s->find_plane = find_plane;
}

double excess_search(cell_search *s) {
    const body *b = s->problem;
    excess_set_functions(s);
    for (uint32_t i = 0; i < b->part_count; i++) try_part(s, i);
    for (uint32_t i = 0; i < b->part_count; i++) cell_search_add_box(s, &b->parts[i].bounds, i);
    return cell_search_run(s);
}
