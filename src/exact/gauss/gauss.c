// Theorem. Let P and Q be polyhedra with vertices p_i and q_j, and let cones C_i, whose edges are unit vectors n_f,
// cover all directions, and D_j, with edges m_g, too. Let h(n) = max (p_i + q_j).n be the height of P + Q along n, and
// r > 0. If (p_i + q_j).n >= r along each edge n of each C_i and D_j that meet, then h(n) >= r along all unit n, so
// that the ball of radius r around the origin is in P + Q.
//
// Proof. A unit n is in some C_i and some D_j. Their common part is a convex cone, so n is a sum of its edges with
// coefficients >= 0, whose sum is at least 1 since the edges are unit vectors. Hence h(n) >= (p_i + q_j).n >= r.
//
// An edge of the common part is an edge n_f of C_i within D_j, an edge m_g of D_j within C_i, or a ray in which two
// faces cross, each spanned by two edges that are neighbors. Here n_f are a polyhedron's facet normals as they are
// stored, or turned, in doubles; C_i has those of the facets around vertex i, which is convex with these neighbors, and
// all C_i cover the directions, whatever rounding did (shape/gauss_map.c). P is A mirrored at the origin, Q is B.
//
// Which vertex? Along n_f within D_j the kernel takes the greatest q_k.n_f, not q_j.n_f. Let e be the most by which a
// vertex is above a facet's plane, as that is kept (bulge), and x = sum b_g m_g a unit vector of D_j, b_g >= 0. Then
// q_j.x is at least q_k.x less e sum b_g, and the sum of b_g is at most the map's spread. The same holds for p_i, for
// vertices of a facet beside its lowest, and for the vertices of an edge. With e and rounding, a claim for each height,
// E = 2 spread (e + claim) covers it.
//
// What is not tried. Where the values along both ends of an arc of one and the same point of the other body, or of its
// ball, are at least r, so are they in between (proof above; of the ball as long as its centre's value is positive). A
// normal is not tried where the ellipsoid's height is at least r. Its root of s = n'Qn, which lies between the squares
// of the shortest semi-axis, at least the ball's radius b, and of the longest, at most B, is above the chord
// (s + b B) / (b + B). s is summed to 32 u trace Q, trace Q <= 3 B^2 and 3 (2 extent)^2, so the chord to
// 192 u extent^2 / b.
//
// A box and another body need few of these numbers: simd/kernels/gauss/box.h finds the same plane by the box's axes.
//
// Errors, in parts of the pair's s (pair/frame.h): a posed vertex is off by 91 u s, and a height by 100 u s: within the
// claim. The direction of a crossing, b1 n2 - b2 n1 with triple products that are off by 8 u, is off by 24 u before it
// is made a unit vector, and so by 48 u over its length: 64 u s over it for the height. Arcs whose products are within
// 32 u of a change of sign are taken to cross.
//
// Two arcs whose crossing is shorter than 2^-40 lie nearly on one circle, within some d. From a crossing the value of
// its vertices falls along one arc, one way or the other, until that ends or the other one does. There both vertices
// are the farthest, to d s, of a normal whose height is known: so the crossing is not lower than that by more than 3 d
// s and E. The first arc's points are a n1 + b n2 with a + b <= 2 / |n1 + n2|, so d <= 2 max |b_i| / (|n1 + n2| |m1 x
// m2|), and 1.6 times that along the sphere.
#include "exact/gauss/gauss.h"

#include "base/compiler.h"
#include "exact/epa.h"
#include "exact/epa_lanes.h"
#include "shape/gauss_map.h"
#include "shape/loops.h"

/// What rounding does to the ellipsoid's support, in parts of extent^2 / ball.
#define ROOT (256 * 0x1p-53)

static void make_side(const ovoid_shape *s, gauss_side *side) {
    const ovoid_sym3 *q = &s->inner.q;
    const double entries[6] = {q->xx, q->xy, q->xz, q->yy, q->yz, q->zz};
    side->map = shape_get_gauss_map(s);
    side->points = shape_get_points(s);
    side->center = s->inner.center;
    for (int i = 0; i < 6; i++) side->q[i] = entries[i];
    side->ball = s->inside.least;
    side->shrink = ROOT * s->extent * (s->extent / s->inside.least);
}

void gauss_set_box(const pair_frame *f, gauss_box *to) {
    const parallelepiped *a = &f->a->box, *b = &f->b->box, *box = a->is_right ? a : b;
    to->side = a->is_right ? 1 : b->is_right ? 2 : 0;
    if (!to->side) return;
    const mat3 turn = to->side == 1 ? mat3_transpose(f->rotation) : f->rotation;
    to->center = to->side == 1 ? mat3_mul_vec3(turn, vec3_sub(box->center, f->translation)) : frame_b(f, box->center);
    to->axes =
        (mat3){mat3_mul_vec3(turn, box->unit[0]), mat3_mul_vec3(turn, box->unit[1]), mat3_mul_vec3(turn, box->unit[2])};
    for (int k = 0; k < 3; k++) to->half[k] = box->half[k];
}

// E of the theorem.
static double compute_doubt(const pair_frame *f, const ovoid_shape *s) {
    const gauss_map *map = shape_get_gauss_map(s);
    return 2 * map->spread * (map->bulge + f->claim);
}

static int is_for_here(const pair_frame *f) {
    if (!shape_get_gauss_map(f->a) || !shape_get_gauss_map(f->b)) return 0;
    return f->size > 0x1p-100 && f->size < 0x1p100 && !(f->a->box.is_present && f->b->box.is_present);
}

// ---- the witness: three corners of the face whose plane was found
//
// A face of the difference is the sum of both bodies' faces that look there: polygons, edges or vertices. Its corners
// come from the edges of both, in the order of their directions.

/// The face of a body, counter-clockwise as the difference has it, across the normal.
typedef struct face {
    uint32_t count, vertex[GAUSS_POINTS];
    double x[GAUSS_POINTS], y[GAUSS_POINTS];
} face;

/// What is looked for: the foot of the origin on a plane.
typedef struct foot_search {
    const search *s;
    vec3 n, u, v;  ///< outward; across
    double within; ///< vertices that are lower by no more are in the plane
    evidence *found;
} foot_search;

static void set_edge(const gauss_map *map, uint32_t arc, face *to) {
    to->count = 2;
    for (uint32_t k = 0; k < 2; k++) to->vertex[k] = gauss_get_list(map, 2 + k)[arc];
}

static void set_facet(const ovoid_shape *s, uint32_t facet, face *to) {
    const uint32_t *starts = shape_loop_starts(s), *loop = shape_loop_vertices(s) + starts[facet];
    to->count = starts[facet + 1] - starts[facet];
    for (uint32_t i = 0; i < to->count; i++) to->vertex[i] = loop[i];
}

// Are a facet's corners all at a height?
static int is_level(const ovoid_shape *s, vec3 n, double least, uint32_t facet) {
    const uint32_t *starts = shape_loop_starts(s), *loop = shape_loop_vertices(s);
    for (uint32_t i = starts[facet]; i < starts[facet + 1]; i++)
        if (vec3_dot(n, vec3_at(shape_vertices(s), loop[i])) < least) return 0;
    return 1;
}

// The face at a vertex that is extreme along n, in the body's axes: a facet, an edge, or the vertex alone.
static void find_face(const ovoid_shape *s, vec3 n, uint32_t vertex, double within, face *to) {
    const uint32_t *starts = shape_neighbor_starts(s), *neighbors = shape_neighbors(s), *facets = shape_edge_facets(s);
    double least = vec3_dot(n, vec3_at(shape_vertices(s), vertex)) - within;
    to->count = 1;
    to->vertex[0] = vertex;
    for (uint32_t i = starts[vertex]; i < starts[vertex + 1]; i++) {
        if (vec3_dot(n, vec3_at(shape_vertices(s), neighbors[i])) < least) continue;
        if (is_level(s, n, least, facets[i])) {
            set_facet(s, facets[i], to);
            return;
        }
        to->count = 2;
        to->vertex[1] = neighbors[i];
    }
}

// The corners across the normal. A is mirrored, which turns its loops around.
static void place_face(const foot_search *of, int is_a, face *f) {
    const pair_frame *frame = of->s->frame;
    for (uint32_t i = 0; is_a && i < f->count / 2; i++) {
        uint32_t swapped = f->vertex[i];
        f->vertex[i] = f->vertex[f->count - 1 - i];
        f->vertex[f->count - 1 - i] = swapped;
    }
    for (uint32_t i = 0; i < f->count; i++) {
        vec3 p = is_a ? vec3_neg(frame_vertex_a(frame, f->vertex[i])) : frame_vertex_b(frame, f->vertex[i]);
        f->x[i] = vec3_dot(of->u, p);
        f->y[i] = vec3_dot(of->v, p);
    }
}

static uint32_t find_lowest(const face *f) {
    uint32_t low = 0;
    for (uint32_t i = 1; i < f->count; i++)
        if (f->y[i] < f->y[low] || (f->y[i] == f->y[low] && f->x[i] < f->x[low])) low = i;
    return low;
}

// Is the next edge of the first face before that of the other, in the order of directions from the lowest corner on?
static int is_before(const face *a, uint32_t i, const face *b, uint32_t k) {
    uint32_t i2 = (i + 1) % a->count, k2 = (k + 1) % b->count;
    double ax = a->x[i2] - a->x[i], ay = a->y[i2] - a->y[i], bx = b->x[k2] - b->x[k], by = b->y[k2] - b->y[k];
    int is_down_a = ay < 0 || (ay == 0 && ax < 0), is_down_b = by < 0 || (by == 0 && bx < 0);
    return is_down_a != is_down_b ? is_down_b : ax * by - ay * bx > 0;
}

static difference get_corner(const search *s, uint32_t a, uint32_t b) {
    return (difference){frame_difference(s->frame, a, b), a, b};
}

// The foot in the sum of two faces, as a fan of triangles around its lowest corner. The first and the last triangle are
// none.
static int find_in_sum(const foot_search *of, const face *a, const face *b) {
    uint32_t i = find_lowest(a), k = find_lowest(b);
    uint32_t left_a = a->count > 1 ? a->count : 0, left_b = b->count > 1 ? b->count : 0;
    const difference first = get_corner(of->s, a->vertex[i], b->vertex[k]);
    difference corner[3] = {first, first, first};
    double height = vec3_dot(of->n, first.w);
    while (left_a + left_b > 0) {
        if (left_b == 0 || (left_a > 0 && is_before(a, i, b, k)))
            i = (i + 1) % a->count, left_a--;
        else
            k = (k + 1) % b->count, left_b--;
        corner[1] = corner[2];
        corner[2] = get_corner(of->s, a->vertex[i], b->vertex[k]);
        if (epa_find_foot(of->s, corner, of->n, height, of->found)) return 1;
    }
    return 0;
}

static int try_faces(const foot_search *of, face *a, face *b) {
    place_face(of, 1, a);
    place_face(of, 0, b);
    return find_in_sum(of, a, b);
}

// The faces that are extreme within a rounding. support: where the bodies are extreme.
static void find_faces(const foot_search *of, const frame_support *support, face *a, face *b) {
    const pair_frame *f = of->s->frame;
    find_face(f->a, vec3_neg(of->n), support->a, of->within, a);
    find_face(f->b, mat3_mul_transposed_vec3(f->rotation, of->n), support->b, of->within, b);
}

// Arcs may cross at their ends, where the faces are more than their edges.
static int find_witness(const foot_search *of, const gauss_plane *plane, const frame_support *support) {
    const pair_frame *f = of->s->frame;
    face a, b;
    if (plane->kind == GAUSS_CROSSING) {
        set_edge(shape_get_gauss_map(f->a), plane->a, &a);
        set_edge(shape_get_gauss_map(f->b), plane->b, &b);
        if (try_faces(of, &a, &b)) return 1;
    }
    find_faces(of, support, &a, &b);
    return try_faces(of, &a, &b);
}

// The corner that find_witness begins with, of the plane of a facet.
static difference find_corner(const foot_search *of, const frame_support *support) {
    face a, b;
    find_faces(of, support, &a, &b);
    if (a.count > 1) place_face(of, 1, &a);
    if (b.count > 1) place_face(of, 0, &b);
    return get_corner(of->s, a.vertex[a.count > 1 ? find_lowest(&a) : 0], b.vertex[b.count > 1 ? find_lowest(&b) : 0]);
}

// ---- the depth

// Bodies that hardly overlap, by no more claims than this, are left to EPA, which may show no surface around the
// origin.
enum { TOUCHING = 4096 };

// The map of the second body, while the kernel reads the first one's.
static void prefetch_map(const ovoid_shape *s) {
    for (uint64_t at = s->at.gauss; at < s->at.vertices; at += 64) compiler_prefetch((const char *)s + at);
}

// Not on the stack while EPA is.
COMPILER_NOINLINE static int take_depth(search *s) {
    const pair_frame *f = s->frame;
    gauss_query q;
    gauss_plane plane;
    if (f->is_true || !is_for_here(f)) return 0;
    prefetch_map(f->b);
    double doubt = compute_doubt(f, f->a) + compute_doubt(f, f->b) + 2 * f->claim;
    make_side(f->a, &q.a);
    make_side(f->b, &q.b);
    gauss_set_box(f, &q.box);
    q.rotation = f->rotation;
    q.translation = f->translation;
    q.claim = doubt + TOUCHING * f->claim;
    q.size = f->size;
    if (!gauss_find_plane(&q, &plane)) return 0;
    vec3 n = vec3_unit(plane.n), u = vec3_orthogonal(n);
    frame_support support = frame_find_support(f, vec3_neg(n));
    const search_depth found = {support.gap - f->lower_radii - f->claim, doubt - plane.height - f->upper_radii,
                                vec3_neg(n), OVOID_STAGE_EPA};
    if (!search_needs_depth(s, &found)) return 0;
    evidence foot;
    const foot_search of = {s, n, u, vec3_cross(n, u), 2 * f->claim, &foot};
    if (s->goal.wants_corner && plane.kind != GAUSS_CROSSING)
        foot.count = 1, foot.p[0] = find_corner(&of, &support), foot.weight[0] = 1;
    else if (!find_witness(&of, &plane, &support))
        return 0;
    search_take_depth(s, &found, &foot);
    return 1;
}

// How far above its nearest face, in claims, a surface may end that is to show a depth which is known.
enum { COVER_NARROW = 4 };

int gauss_take_depth(search *s, ovoid_cover *cover) {
    search before;
    if (cover) before = *s;
    if (!take_depth(s)) return 0;
    if (!search_wants_cover(s, cover, s->upper) && !search_wants_start(s, cover)) return 1;
    search grown = before;
    // EPA begins with the face that is known to be the nearest.
    simplex points = {.count = s->witness.count};
    for (int i = 0; i < points.count; i++) points.p[i] = s->witness.p[i], points.weight[i] = s->witness.weight[i];
    grown.goal.tolerance = before.goal.allowance + COVER_NARROW * s->frame->claim;
    (void)epa_run(&grown, &points, 1, cover);
    if (grown.kind == OVOID_PROOF_COVER && grown.upper <= s->upper) return 1;
    *s = before;
    return 0;
}
