// The depth of two small polyhedra by all planes of their difference (exact/gauss). Truth: the heights along the
// normals of all facets and the cross products of all pairs of edges, of which one is the least, over all vertices, in
// long double; nothing of Gauss maps or pruning is in it. Tolerance 1e-12 of bodies of size about 2, some thousand
// roundings. Every instruction set must find the same bits, and EPA, which a cover asks for, the same depth.
#include "exact/gauss/gauss.h"
#include "ovoid/ovoid.h"
#include "shape/gauss_map.h"
#include "shape/loops.h"
#include "simd/gauss.h"

#include "check.h"
#include "places.h"
#include "proofs/covers.h"

typedef long double real;
typedef struct point {
    real x, y, z;
} point;

enum { MOST = 64 };

static point sub(point a, point b) { return (point){a.x - b.x, a.y - b.y, a.z - b.z}; }
static real dot(point a, point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The rotation of a quaternion of any length.
static point turn(ovoid_quat q, point x) {
    real norm = (real)q.w * q.w + (real)q.x * q.x + (real)q.y * q.y + (real)q.z * q.z, k = 2 / norm;
    point axis = {q.x, q.y, q.z}, t = cross(axis, x), t2 = cross(axis, t);
    real c = q.w * k;
    return (point){x.x + c * t.x + k * t2.x, x.y + c * t.y + k * t2.y, x.z + c * t.z + k * t2.z};
}

/// A body in the world: vertices, normals of its triangles, and edges.
typedef struct body {
    point v[MOST], normal[2 * MOST], edge[3 * MOST];
    uint32_t vertices, normals, edges;
} body;

static void place(const ovoid_shape *s, const ovoid_pose *pose, body *to) {
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    to->vertices = p.vertex_count;
    to->normals = p.triangle_count;
    to->edges = 0;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * i;
        point x =
            turn(pose->rotation, (point){(real)v[0] + p.origin.x, (real)v[1] + p.origin.y, (real)v[2] + p.origin.z});
        to->v[i] = (point){x.x + pose->position.x, x.y + pose->position.y, x.z + pose->position.z};
    }
    for (uint32_t i = 0; i < p.triangle_count; i++) {
        const uint32_t *t = p.triangles + 3 * (size_t)i;
        to->normal[i] = cross(sub(to->v[t[1]], to->v[t[0]]), sub(to->v[t[2]], to->v[t[0]]));
        for (int k = 0; k < 3; k++)
            if (t[k] < t[(k + 1) % 3]) to->edge[to->edges++] = sub(to->v[t[(k + 1) % 3]], to->v[t[k]]);
    }
}

/// The height of B - A along a direction of any length; infinity if that is too short.
static real measure(const body *a, const body *b, point n) {
    real norm = sqrtl(dot(n, n)), low = INFINITY, high = -INFINITY;
    if (!(norm > 1e-9L)) return INFINITY;
    for (uint32_t i = 0; i < a->vertices; i++) low = fminl(low, dot(n, a->v[i]));
    for (uint32_t i = 0; i < b->vertices; i++) high = fmaxl(high, dot(n, b->v[i]));
    return (high - low) / norm;
}

/// The least height, which is the depth where it is positive.
static real find_least(const ovoid_pair *p) {
    static body a, b;
    place(p->shape_a, &p->pose_a, &a);
    place(p->shape_b, &p->pose_b, &b);
    real least = INFINITY;
    for (uint32_t i = 0; i < a.normals; i++) least = fminl(least, measure(&a, &b, sub((point){0, 0, 0}, a.normal[i])));
    for (uint32_t i = 0; i < b.normals; i++) least = fminl(least, measure(&a, &b, b.normal[i]));
    for (uint32_t i = 0; i < a.edges; i++)
        for (uint32_t k = 0; k < b.edges; k++) {
            point n = cross(a.edge[i], b.edge[k]);
            least = fminl(least, fminl(measure(&a, &b, n), measure(&a, &b, sub((point){0, 0, 0}, n))));
        }
    return least;
}

// ---- shapes

static ovoid_shape *make_hull(uint64_t *s, uint32_t count) {
    double xyz[3 * MOST], stretch[3] = {1, random_uniform(s, 0.3, 1), random_uniform(s, 0.3, 1)};
    for (uint32_t i = 0; i < count; i++) {
        double p[3], square = 0;
        for (int k = 0; k < 3; k++) p[k] = random_normal(s), square += p[k] * p[k];
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = stretch[k] * p[k] / sqrt(square);
    }
    return ovoid_shape_create_from_points(xyz, count, NULL, NULL);
}

/// A prism, or a frustum, with many corners in each base.
static ovoid_shape *make_prism(uint64_t *s, uint32_t corners) {
    double xyz[3 * MOST], top = random_next(s) % 2 ? 1 : 0.5, half = random_uniform(s, 0.2, 0.8);
    for (uint32_t i = 0; i < 2 * corners; i++) {
        uint32_t corner = i / 2;
        double angle = 6.283185307179586 * corner / corners, r = i % 2 ? top : 1;
        xyz[3 * i] = 0.7 * r * cos(angle);
        xyz[3 * i + 1] = 0.7 * r * sin(angle);
        xyz[3 * i + 2] = i % 2 ? half : -half;
    }
    return ovoid_shape_create_from_points(xyz, 2 * corners, NULL, NULL);
}

static ovoid_shape *make_box(uint64_t *s) {
    double x = random_uniform(s, 0.2, 1), y = random_uniform(s, 0.2, 1);
    return ovoid_shape_create_box((ovoid_vec3){x, y, 0.6}, NULL, NULL);
}

/// Corners of a grid, of which many lie on common planes and edges are parallel.
static ovoid_shape *make_grid(uint64_t *s) {
    double xyz[3 * 12];
    for (int i = 0; i < 36; i++) xyz[i] = 0.5 * (double)(random_next(s) % 3);
    return ovoid_shape_create_from_points(xyz, 12, NULL, NULL);
}

static ovoid_shape *make_shape(uint64_t *s) {
    switch (random_next(s) % 6) {
    case 0: return make_box(s);
    case 1: return make_prism(s, 3 + (uint32_t)(random_next(s) % 14));
    case 2: return make_grid(s);
    default: return make_hull(s, 4 + (uint32_t)(random_next(s) % 29));
    }
}

// ---- checks

static long taken, left, others, wide, kinds[3], boxes[2][3];

static gauss_side make_side(const ovoid_shape *s) {
    const ovoid_sym3 *q = &s->inner.q;
    return (gauss_side){shape_get_gauss_map(s), shape_get_points(s),
                        s->inner.center,        {q->xx, q->xy, q->xz, q->yy, q->yz, q->zz},
                        s->inside.least,        0};
}

static int is_same(const gauss_plane *x, const gauss_plane *y) {
    return x->height == y->height && x->n.x == y->n.x && x->n.y == y->n.y && x->n.z == y->n.z && x->kind == y->kind &&
           x->a == y->a && x->b == y->b;
}

/// The plane that is expected, or none, from every instruction set.
static void check_sets(const gauss_query *q, int expected, const gauss_plane *truth) {
    gauss_plane other;
    for (int isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
        gauss_function *find = isa == SIMD_ISA_COUNT ? gauss_find_plane : gauss_get((simd_isa)isa);
        if (!find) continue;
        memset(&other, 0, sizeof other);
        CHECK_EQ(find(q, &other), expected);
        if (expected) CHECK(is_same(truth, &other));
    }
}

/// The same bits from every instruction set, and of a box with its axes as without.
static void check_kernels(const ovoid_pair *p) {
    pair_frame f;
    CHECK(frame_make(p, &f) == OVOID_LIMIT_NONE);
    if (!shape_get_gauss_map(f.a) || !shape_get_gauss_map(f.b)) return;
    gauss_query q = {make_side(f.a), make_side(f.b), {.side = 0}, f.rotation, f.translation, 4 * f.claim, f.size};
    gauss_plane truth;
    memset(&truth, 0, sizeof truth);
    int found = gauss_get(SIMD_SCALAR)(&q, &truth);
    check_sets(&q, found, &truth);
    kinds[truth.kind] += found;
    gauss_set_box(&f, &q.box);
    if (!q.box.side) return;
    check_sets(&q, found, &truth);
    boxes[q.box.side - 1][truth.kind] += found;
}

/// The points are of the bodies, and as deep as the answer says, along its normal.
static void check_points(const ovoid_answer *x) {
    ovoid_vec3 d = {x->point_b.x - x->point_a.x, x->point_b.y - x->point_a.y, x->point_b.z - x->point_a.z};
    CHECK_NEAR(d.x, x->lower * x->normal.x, 1e-11);
    CHECK_NEAR(d.y, x->lower * x->normal.y, 1e-11);
    CHECK_NEAR(d.z, x->lower * x->normal.z, 1e-11);
}

static void check_pair(const ovoid_pair *p) {
    STATIC_COVER(cover);
    ovoid_answer x = ovoid_depth(p, NULL, NULL, NULL), proven = ovoid_depth(p, NULL, NULL, &cover);
    ovoid_error error;
    check_kernels(p);
    CHECK_EQ(x.status, proven.status);
    if (x.status != OVOID_OVERLAPPING) return;
    CHECK(ovoid_answer_verify(p, &proven, &(ovoid_answer_basis){.cover = &cover}, &error) == OVOID_OK);
    real depth = find_least(p);
    CHECK_LE(x.lower, -(double)depth + 1e-13);
    CHECK_LE(-(double)depth - 1e-13, x.upper);
    CHECK(x.limit == OVOID_LIMIT_NONE);
    CHECK_NEAR(x.upper, -(double)depth, 3e-9);
    CHECK_NEAR(x.lower, proven.lower, 3e-9);
    int is_here = x.iterations == 0 && x.proof.kind == OVOID_PROOF_COVER;
    if (is_here) {
        CHECK_NEAR(x.upper, -(double)depth, 1e-9);
        wide += fabs(x.upper + (double)depth) > 3e-11;
        check_points(&x);
        others += x.lower != proven.lower || x.upper != proven.upper;
    }
    *(is_here ? &taken : &left) += 1;
}

static void test_random(void) {
    uint64_t s = 11;
    for (int i = 0; i < 1500; i++) {
        ovoid_shape *a = make_shape(&s), *b = make_shape(&s);
        if (a && b) {
            ovoid_pair p = {a, b, {random_vec3(&s, 0.1), random_quat(&s)}, {random_vec3(&s, 0.6), random_quat(&s)}};
            // Parallel edges and faces.
            if (random_next(&s) % 8 == 0) p.pose_b.rotation = p.pose_a.rotation;
            check_pair(&p);
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    printf("of boxes %ld %ld %ld and %ld %ld %ld\n", boxes[0][0], boxes[0][1], boxes[0][2], boxes[1][0], boxes[1][1],
           boxes[1][2]);
    printf("%ld by planes, %ld by EPA; kinds %ld %ld %ld; %ld other covers\n", taken, left, kinds[0], kinds[1],
           kinds[2], others);
    CHECK_LE(left, 15);
    // EPA's surface shows the same depth, but for rounding.
    CHECK_LE(others, 5);
    // Vertices of sharp corners are less sure to be the farthest along their cells' corners.
    CHECK_LE(wide, 5);
    for (int kind = 0; kind < 3; kind++) CHECK(kinds[kind] > 100 && boxes[0][kind] > 5 && boxes[1][kind] > 5);
}

/// A tolerance that is less than the width of a depth by planes, which is above 1e-12, is met all the same. The sizes
/// of two such hulls and the way between them are below 6 together.
static void check_narrow(const ovoid_pair *p) {
    const ovoid_options narrow = {.relative_tolerance = 1e-13};
    ovoid_answer x = ovoid_depth(p, &narrow, NULL, NULL);
    CHECK(x.limit == OVOID_LIMIT_NONE);
    CHECK_LE(x.upper - x.lower, 6e-13);
}

/// Hulls of general position are never left to EPA.
static void test_general(void) {
    uint64_t s = 7;
    taken = left = 0;
    for (int i = 0; i < 300; i++) {
        ovoid_shape *a = make_hull(&s, 4 + (uint32_t)(i % 29)), *b = make_hull(&s, 4 + (uint32_t)(i / 10 % 29));
        ovoid_pair p = {a, b, {{0, 0, 0}, random_quat(&s)}, {random_vec3(&s, 0.4), random_quat(&s)}};
        check_pair(&p);
        check_narrow(&p);
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    CHECK_EQ(left, 0);
    CHECK(taken > 200);
}

/// Prisms that stand on one another: the foot is where neither face has a corner.
static void test_stacks(void) {
    uint64_t s = 13;
    taken = left = 0;
    for (int i = 0; i < 100; i++) {
        ovoid_shape *a = make_prism(&s, 3 + (uint32_t)(i % 7)), *b = make_prism(&s, 3 + (uint32_t)(i / 7 % 6));
        double top = ovoid_shape_get_polytope(a).vertices[5], bottom = ovoid_shape_get_polytope(b).vertices[2];
        double turn = random_uniform(&s, 0, 3), x = random_uniform(&s, -0.2, 0.2), y = random_uniform(&s, -0.2, 0.2);
        ovoid_pair p = {
            a, b, ovoid_pose_make_identity(), {{x, y, fabs(top) + fabs(bottom) - 0.01}, {cos(turn), 0, 0, sin(turn)}}};
        check_pair(&p);
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    printf("stacks: %ld by planes, %ld by EPA\n", taken, left);
    CHECK(taken > 96);
}

/// What a map is not made for: flat bodies, many vertices, normals that are nearly one.
static void test_maps(void) {
    uint64_t s = 3;
    ovoid_shape *few = make_hull(&s, GAUSS_POINTS), *many = make_hull(&s, GAUSS_POINTS + 1);
    CHECK(shape_get_gauss_map(few) != NULL);
    CHECK(shape_get_gauss_map(many) == NULL);
    const double flat[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    ovoid_shape *polygon = ovoid_shape_create_from_points(flat, 4, NULL, NULL);
    CHECK(shape_get_gauss_map(polygon) == NULL);
    // A pyramid on a base that is bent by 1e-12: its facets there have one normal to 36 bits.
    const double bent[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1, 0.5, 0.5, -1e-11};
    ovoid_shape *pyramid = ovoid_shape_create_from_points(bent, 6, NULL, NULL);
    CHECK(pyramid != NULL);
    if (pyramid && shape_get_gauss_map(pyramid)) CHECK(ovoid_shape_get_polytope(pyramid).facet_count == 5);
    ovoid_shape_destroy(few);
    ovoid_shape_destroy(many);
    ovoid_shape_destroy(polygon);
    ovoid_shape_destroy(pyramid);
}

/// A map says of each edge its facets and vertices, and of each facet the plane under its corners.
static void test_lists(void) {
    uint64_t s = 5;
    for (int i = 0; i < 40; i++) {
        ovoid_shape *shape = make_shape(&s);
        const gauss_map *map = shape ? shape_get_gauss_map(shape) : NULL;
        if (map) {
            CHECK_EQ(map->arcs + 2, map->facets + shape->vertex_count);
            for (uint32_t arc = 0; arc < map->arcs; arc++)
                for (uint32_t end = 0; end < 2; end++) {
                    uint32_t f = gauss_get_list(map, end)[arc];
                    for (uint32_t k = 2; k < 4; k++) {
                        const double *v = shape_vertices(shape) + 3 * (size_t)gauss_get_list(map, k)[arc];
                        double along = gauss_get_facet(map, f)[0] * v[0] + gauss_get_facet(map, f)[8] * v[1] +
                                       gauss_get_facet(map, f)[16] * v[2];
                        CHECK_NEAR(along, gauss_get_facet(map, f)[24], 1e-12);
                    }
                }
            CHECK(map->bulge >= 0 && map->bulge < 1e-12);
            CHECK(map->spread >= 1 && map->spread < 0x1p14);
        }
        ovoid_shape_destroy(shape);
    }
}

static ovoid_pair make_scaled(double k) {
    const double xyz[] = {0, 0, 0, k, 0, 0, 0, k, 0, 0, 0, k, k, k, 2 * k};
    ovoid_shape *a = ovoid_shape_create_from_points(xyz, 5, NULL, NULL);
    return (ovoid_pair){a, a, ovoid_pose_make_identity(), {{0.1 * k, 0.2 * k, 0.3 * k}, {1, 0.1, 0.2, 0.3}}};
}

/// What is made of the normals of the sides of a prism or a pyramid. Mirrored normals are a map too, of a body that is
/// not there, so that vertices are far above planes.
typedef enum alteration { TWICE_AROUND, MIRRORED, ANOTHER_FACET, DENTED, DENTED_LITTLE } alteration;

static void alter(ovoid_shape *shape, alteration how) {
    ovoid_plane *planes = (ovoid_plane *)((char *)shape + shape->at.planes);
    int is_dented = 0;
    for (uint32_t f = 0; f < shape->counts.facets; f++) {
        ovoid_vec3 n = planes[f].normal;
        if (fabs(n.z) > 0.9) continue;
        double angle = 2 * atan2(n.y, n.x);
        if (how == TWICE_AROUND) planes[f].normal = (ovoid_vec3){cos(angle), sin(angle), 0};
        if (how == MIRRORED) planes[f].normal = (ovoid_vec3){-n.x, n.y, n.z};
        double across = how == DENTED ? 0.2 : 0.8;
        if (how >= DENTED && !is_dented++) planes[f].normal = vec3_unit((ovoid_vec3){across * n.x, across * n.y, 1});
    }
    if (how == ANOTHER_FACET) planes[0].normal = planes[1].normal;
}

/// How far the vertices are above a facet's plane.
static double find_rise(const ovoid_shape *shape, const gauss_map *map, uint32_t f) {
    double most = -INFINITY;
    for (uint32_t v = 0; v < shape->vertex_count; v++) {
        const double *x = shape_vertices(shape) + 3 * (size_t)v;
        double along =
            gauss_get_facet(map, f)[0] * x[0] + gauss_get_facet(map, f)[8] * x[1] + gauss_get_facet(map, f)[16] * x[2];
        most = fmax(most, along - gauss_get_facet(map, f)[24]);
    }
    return most;
}

/// A plane that is turned a little has vertices above it, whichever plane it is.
static void test_bulge(void) {
    uint64_t s = 17;
    ovoid_shape *shape = make_hull(&s, 9);
    ovoid_plane *planes = (ovoid_plane *)((char *)shape + shape->at.planes);
    for (uint32_t f = 0; f < shape->counts.facets; f++) {
        ovoid_plane kept = planes[f];
        planes[f].normal = vec3_unit(vec3_add(kept.normal, (ovoid_vec3){1e-3, 2e-3, -1e-3}));
        shape_gauss_map_fill(shape);
        const gauss_map *map = shape_get_gauss_map(shape);
        CHECK(map != NULL);
        if (map) CHECK_NEAR(map->bulge, find_rise(shape, map, f), 1e-14);
        planes[f] = kept;
    }
    ovoid_shape_destroy(shape);
}

/// Normals that are no polyhedron's are refused: those that go around twice, where each cell is convex and its
/// neighbors lie beside it; one that is another facet's; one that makes a dent in the cell of an apex. Of a little dent
/// most of the cell's normals are on the right side of each arc.
static void test_altered(void) {
    double prism[3 * 10], pyramid[3 * 7] = {0};
    for (int i = 0; i < 10; i++) {
        int corner = i / 2;
        double angle = 6.283185307179586 * corner / 5;
        prism[3 * i] = cos(angle), prism[3 * i + 1] = sin(angle), prism[3 * i + 2] = i % 2 ? 0.7 : -0.7;
    }
    for (int i = 0; i < 6; i++) {
        double angle = 6.283185307179586 * i / 6;
        pyramid[3 * i] = cos(angle), pyramid[3 * i + 1] = sin(angle), pyramid[3 * i + 2] = -0.5;
    }
    pyramid[20] = 1;
    for (int how = TWICE_AROUND; how <= DENTED_LITTLE; how++) {
        ovoid_shape *shape = how >= DENTED ? ovoid_shape_create_from_points(pyramid, 7, NULL, NULL)
                                           : ovoid_shape_create_from_points(prism, 10, NULL, NULL);
        CHECK(shape_get_gauss_map(shape) != NULL);
        alter(shape, (alteration)how);
        shape_gauss_map_fill(shape);
        const gauss_map *map = shape_get_gauss_map(shape);
        CHECK(map == NULL || (how == MIRRORED && map->bulge > 0.5));
        ovoid_shape_destroy(shape);
    }
}

/// Sizes far from one.
static void test_scales(void) {
    static const double scales[] = {1e-9, 1, 1e9};
    ovoid_pair unit = make_scaled(1);
    double depth = (double)find_least(&unit);
    for (int i = 0; i < 3; i++) {
        double k = scales[i];
        ovoid_pair p = make_scaled(k);
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        CHECK(x.status == OVOID_OVERLAPPING && x.iterations == 0);
        CHECK_NEAR(x.upper / k, -depth, 1e-9);
        p.pose_b.position.x = 5 * k;
        CHECK(ovoid_depth(&p, NULL, NULL, NULL).status == OVOID_SEPARATED);
        ovoid_shape_destroy((ovoid_shape *)p.shape_a);
    }
    ovoid_shape_destroy((ovoid_shape *)unit.shape_a);
}

int main(void) {
    test_random();
    test_general();
    test_stacks();
    test_maps();
    test_lists();
    test_bulge();
    test_altered();
    test_scales();
    return check_end();
}
