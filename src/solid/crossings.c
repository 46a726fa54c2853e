// Self-intersections of a surface: pairs of triangles with a common point that is not a common corner or edge. For each
// triangle the tree finds the triangles whose boxes meet its own, and exact signs of determinants decide. An edge meets
// a triangle if its ends are not on one side of the triangle's plane, and the line through them passes no edge on the
// wrong side; in one plane, if it meets an edge or one end is inside (P. Guigue, O. Devillers, Fast and robust
// triangle-triangle overlap test using orientation predicates, 2003). Two triangles with a common edge meet elsewhere
// only if they are folded onto each other. Triangles without area and triangles of three common corners are left out:
// the report counts both.
#include "base/environment.h"
#include "linear/exact.h"
#include "solid/solid.h"

/// A triangle in the solid's unit, and its points' indices.
typedef struct facet {
    vec3 c[3];
    uint32_t index[3];
} facet;

typedef struct search {
    const ovoid_solid *solid;
    double scale;
    uint64_t most;
    ovoid_solid_crossings *out;
} search;

static facet make_facet(const search *state, uint32_t place) {
    facet f;
    for (int i = 0; i < 3; i++) {
        f.index[i] = state->solid->triangles[place].point[i];
        f.c[i] = vec3_scale(vec3_at(state->solid->points, f.index[i]), state->scale);
    }
    return f;
}

static double min3(double a, double b, double c) { return min2(a, min2(b, c)); }
static double max3(double a, double b, double c) { return max2(a, max2(b, c)); }

/// 1 if two intervals, each of three numbers, have no number in common.
static int are_apart(double a0, double a1, double a2, double b0, double b1, double b2) {
    return min3(a0, a1, a2) > max3(b0, b1, b2) || max3(a0, a1, a2) < min3(b0, b1, b2);
}

static int are_boxes_apart(const facet *a, const facet *b) {
    return are_apart(a->c[0].x, a->c[1].x, a->c[2].x, b->c[0].x, b->c[1].x, b->c[2].x) ||
           are_apart(a->c[0].y, a->c[1].y, a->c[2].y, b->c[0].y, b->c[1].y, b->c[2].y) ||
           are_apart(a->c[0].z, a->c[1].z, a->c[2].z, b->c[0].z, b->c[1].z, b->c[2].z);
}

// ---- two triangles in one plane, seen from a point beside it

/// A point that is not in the triangle's plane; 0 if the triangle has no area.
static int find_apex(const vec3 c[3], vec3 *apex) {
    for (int axis = 0; axis < 3; axis++) {
        *apex = (vec3){c[0].x + 4 * (axis == 0), c[0].y + 4 * (axis == 1), c[0].z + 4 * (axis == 2)};
        if (orient3d_sign(c[0], c[1], c[2], *apex)) return 1;
    }
    return 0;
}

static int is_between(double a, double x, double b) { return (a <= x && x <= b) || (b <= x && x <= a); }

/// 1 if x, of three points on a line, is not beyond an end.
static int is_on_segment(vec3 a, vec3 b, vec3 x) {
    return is_between(a.x, x.x, b.x) && is_between(a.y, x.y, b.y) && is_between(a.z, x.z, b.z);
}

static int do_segments_meet(vec3 a, vec3 b, vec3 c, vec3 d, vec3 apex) {
    int c_side = orient3d_sign(a, b, c, apex), d_side = orient3d_sign(a, b, d, apex);
    int a_side = orient3d_sign(c, d, a, apex), b_side = orient3d_sign(c, d, b, apex);
    if (c_side * d_side < 0 && a_side * b_side < 0) return 1;
    return (!c_side && is_on_segment(a, b, c)) || (!d_side && is_on_segment(a, b, d)) ||
           (!a_side && is_on_segment(c, d, a)) || (!b_side && is_on_segment(c, d, b));
}

static int is_in_triangle(vec3 p, const vec3 c[3], vec3 apex) {
    int s0 = orient3d_sign(c[0], c[1], p, apex), s1 = orient3d_sign(c[1], c[2], p, apex);
    int s2 = orient3d_sign(c[2], c[0], p, apex);
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

static int meets_in_plane(vec3 p, vec3 q, const vec3 c[3]) {
    vec3 apex;
    if (!find_apex(c, &apex)) return 0;
    for (int i = 0; i < 3; i++)
        if (do_segments_meet(p, q, c[i], c[(i + 1) % 3], apex)) return 1;
    return is_in_triangle(p, c, apex);
}

// ---- an edge and a triangle

static int meets(vec3 p, vec3 q, const vec3 c[3]) {
    int p_side = orient3d_sign(c[0], c[1], c[2], p), q_side = orient3d_sign(c[0], c[1], c[2], q);
    if (p_side * q_side > 0) return 0;
    if (!p_side && !q_side) return meets_in_plane(p, q, c);
    int low = 0, high = 0;
    for (int i = 0; i < 3; i++) {
        int side = orient3d_sign(p, q, c[i], c[(i + 1) % 3]);
        low |= side < 0;
        high |= side > 0;
    }
    return !(low && high);
}

// ---- two triangles

/// How many corners two triangles share. *at_a and *at_b: with one shared corner its place in each triangle, with two
/// the place of the corner that is not shared.
static int find_shared(const facet *a, const facet *b, int *at_a, int *at_b) {
    int count = 0, sum_a = 0, sum_b = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (a->index[i] == b->index[j]) count++, sum_a += i, sum_b += j;
    *at_a = count == 2 ? 3 - sum_a : sum_a;
    *at_b = count == 2 ? 3 - sum_b : sum_b;
    return count;
}

static int has_area(const facet *f) {
    vec3 apex;
    return f->index[0] != f->index[1] && f->index[1] != f->index[2] && f->index[2] != f->index[0] &&
           find_apex(f->c, &apex);
}

/// 1 if both lie in one plane, on the same side of their common edge; the named corners are not on that edge.
static int are_folded(const facet *a, const facet *b, int at_a, int at_b) {
    vec3 apex, from = a->c[(at_a + 1) % 3], to = a->c[(at_a + 2) % 3];
    if (orient3d_sign(a->c[0], a->c[1], a->c[2], b->c[at_b]) != 0 || !find_apex(a->c, &apex)) return 0;
    return orient3d_sign(from, to, a->c[at_a], apex) * orient3d_sign(from, to, b->c[at_b], apex) > 0;
}

static int do_meet(const facet *a, const facet *b) {
    int at_a, at_b, shared = find_shared(a, b, &at_a, &at_b);
    if (shared > 2 || are_boxes_apart(a, b)) return 0;
    if (shared == 2) return are_folded(a, b, at_a, at_b);
    // The edge across from the common corner does not have it.
    if (shared == 1)
        return meets(a->c[(at_a + 1) % 3], a->c[(at_a + 2) % 3], b->c) ||
               meets(b->c[(at_b + 1) % 3], b->c[(at_b + 2) % 3], a->c);
    for (int i = 0; i < 3; i++)
        if (meets(a->c[i], a->c[(i + 1) % 3], b->c) || meets(b->c[i], b->c[(i + 1) % 3], a->c)) return 1;
    return 0;
}

static void take(search *state, uint32_t one, uint32_t other) {
    const uint32_t *order = state->solid->order;
    if (state->out->pairs++) return;
    int is_first = order[one] < order[other];
    state->out->triangle_a = is_first ? order[one] : order[other];
    state->out->triangle_b = is_first ? order[other] : order[one];
}

/// Visits all triangles behind `place` in the tree's order. 0: as many pairs as wanted have been found.
static int visit(search *state, uint32_t place) {
    enum { ROOM = 64 };
    uint32_t places[ROOM], found;
    facet own = make_facet(state, place);
    if (!has_area(&own)) return 1;
    box bounds = solid_make_bounds(state->solid, &state->solid->triangles[place]);
    const double ends[6] = {bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z};
    box8_walk walk;
    box8_begin(&walk, state->solid->boxes, ends);
    while ((found = box8_find_leaves(&walk, places, ROOM)) > 0)
        for (uint32_t i = 0; i < found; i++) {
            if (places[i] <= place) continue;
            facet other = make_facet(state, places[i]);
            if (!has_area(&other) || !do_meet(&own, &other)) continue;
            take(state, place, places[i]);
            if (state->out->pairs >= state->most) return 0;
        }
    return 1;
}

static void find_crossings(const ovoid_solid *s, uint64_t most, ovoid_solid_crossings *out) {
    search state = {s, ldexp(1, -find_unit_exponent(s->extent)), most, out};
    *out = (ovoid_solid_crossings){.pairs = 0};
    uint32_t place = 0;
    while (place < s->triangle_count && out->pairs < most && visit(&state, place)) place++;
    out->is_complete = place == s->triangle_count;
}

ovoid_solid_crossings ovoid_solid_compute_crossings(const ovoid_solid *solid, uint64_t most) {
    ENVIRONMENT_RETURN_FILLED(ovoid_solid_crossings, out, most, find_crossings(solid, most, &out));
}
