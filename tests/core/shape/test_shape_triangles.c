// Files of shapes that hold the triangles of the hull. What is read is what was made, bit for bit, whatever the body;
// every surface that is not the hull of its vertices is refused with its place, whoever mended the checksum. The
// surfaces that are near misses: each fails one condition of polytope/surface_proof.c and holds all the others.
#include "linear/rotation.h"
#include "ovoid/ovoid.h"
#include "polytope/closed_form.h"
#include "shape/file.h"
#include "shape_files.h"

enum { AT = 328 + 16, POINTS_MOST = 2500 };

static double cloud[3 * POINTS_MOST];

static void put(size_t i, vec3 v) {
    cloud[3 * i] = v.x;
    cloud[3 * i + 1] = v.y;
    cloud[3 * i + 2] = v.z;
}

// ---- what is made ----

// The shape comes back from its own file, from one whose checksum is by bytes and, a solid, from those with triangles.
static void check_body(ovoid_shape *s) {
    if (!CHECK(s)) return;
    int solid = s->rank == 3 && s->inner.q.xx != 0;
    size_t size = ovoid_shape_write(s, NULL, 0), most = size + 24 * (size_t)s->vertex_count + 40;
    uint8_t *bytes = malloc(most);
    int has_axis = shape_has_axis(s), is_large = solid && s->vertex_count >= SHAPE_TRIANGLES_LEAST;
    if (is_large) is_large = closed_form_find(shape_vertices(s), s->vertex_count).kind == FORM_NONE;
    int is_round = shape_is_round(s);
    uint32_t expected = has_axis ? (is_large ? 5 : 4) + 2 * is_round : is_large ? 3 : s->has_allowance ? 2 : 1;
    uint32_t other = has_axis ? 5 + 2 * is_round : 3;
    const uint32_t versions[] = {expected + 8, expected, other, other + 8};
    for (uint32_t k = 0; k < (solid ? 4u : 2u); k++) {
        size = k ? shape_write_version(s, versions[k], bytes, most) : ovoid_shape_write(s, bytes, most);
        CHECK_EQ(bytes[8], versions[k]);
        ovoid_error e = {0};
        ovoid_shape *t = ovoid_shape_read(bytes, size, NULL, &e);
        if (!t) printf("    %u vertices: %s\n", s->vertex_count, e.message);
        shape_files_check_same(s, t);
        ovoid_shape_destroy(t);
    }
    free(bytes);
    ovoid_shape_destroy(s);
}

static void check_primitives(void) {
    static const double sizes[] = {1e-60, 1e-9, 1, 1e9, 1e40};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        double r = sizes[i];
        ovoid_shape_options known = {.radius = r / 8, .allowance = {.outside = r / 100, .inside = r / 50}};
        check_body(ovoid_shape_create_box((vec3){r, 2 * r, 3 * r}, NULL, NULL));
        check_body(ovoid_shape_create_box((vec3){r, 2 * r, 3 * r}, &known, NULL));
        check_body(ovoid_shape_create_sphere(r, NULL, NULL));
        check_body(ovoid_shape_create_capsule(r, r, NULL, NULL));
        check_body(ovoid_shape_create_cylinder(r, 2 * r, &(ovoid_shape_options){.tolerance = 1e-3 * r}, NULL));
        check_body(ovoid_shape_create_cylinder(r, 2 * r, &(ovoid_shape_options){.tolerance = 1e-5 * r}, NULL));
        check_body(ovoid_shape_create_cone(r, 2 * r, &(ovoid_shape_options){.tolerance = 1e-5 * r}, NULL));
        check_body(ovoid_shape_create_prism(&(ovoid_prism){r, r, 300}, &known, NULL));
        check_body(ovoid_shape_create_pyramid(&(ovoid_prism){r, r, 700}, NULL, NULL));
    }
}

static mat3 random_rotation(uint64_t *s) {
    return quat_to_mat3((ovoid_quat){random_normal(s), random_normal(s), random_normal(s), random_normal(s)});
}

// Round bodies, stretched, turned, far from the origin, of all sizes.
static void check_random(void) {
    static const double stretch[][3] = {{1, 1, 1},       {1, 2, 3},    {1, 1, 1e-3},
                                        {1, 1e-3, 1e-6}, {1, 1, 1e-9}, {1, 1, 1e-14}};
    static const double sizes[] = {1e-90, 1e-9, 1, 1e9, 1e40};
    static const size_t counts[] = {4, 5, 8, 20, 100, 511, 512, 2000};
    uint64_t s = 17;
    for (size_t i = 0; i < sizeof stretch / sizeof *stretch; i++)
        for (size_t k = 0; k < 2 * sizeof sizes / sizeof *sizes; k++)
            for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
                if (counts[c] > 600 && (i + k) % 5) continue;
                check_seed = s;
                mat3 r = random_rotation(&s);
                vec3 away = {k % 2 ? 1e7 : 0, 0, 0};
                for (size_t j = 0; j < counts[c]; j++) {
                    vec3 v = vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
                    v = (vec3){v.x * stretch[i][0], v.y * stretch[i][1], v.z * stretch[i][2]};
                    put(j, vec3_scale(vec3_add(mat3_mul_vec3(r, v), away), sizes[k / 2]));
                }
                check_body(ovoid_shape_create_from_points(cloud, counts[c], NULL, NULL));
            }
    check_seed = 0;
}

// Cubes with points on their faces, exactly and turned, where rounding makes them corners; rounded cubes, whose faces
// are fans of coplanar triangles; a flat body.
static void check_coplanar(void) {
    uint64_t s = 5;
    for (int turned = 0; turned < 3; turned++) {
        mat3 r = turned ? random_rotation(&s) : quat_to_mat3((ovoid_quat){1, 0, 0, 0});
        size_t n = 0;
        for (int face = 0; face < 6; face++)
            for (int i = 0; i <= 12; i++)
                for (int k = 0; k <= 12; k++) {
                    double a = (i - 6) / 6.0, b = (k - 6) / 6.0, c = face % 2 ? 1 : -1;
                    vec3 v = face < 2 ? (vec3){c, a, b} : face < 4 ? (vec3){a, c, b} : (vec3){a, b, c};
                    put(n++, mat3_mul_vec3(r, v));
                }
        check_body(ovoid_shape_create_from_points(cloud, n, NULL, NULL));
    }
    for (size_t i = 0; i < 1200; i++) {
        double at = 2 * 3.14159265358979 * (double)(i % 600) / 600;
        put(i, (vec3){cos(at), sin(at), i < 600 ? -1 : 1});
    }
    check_body(ovoid_shape_create_from_points(cloud, 1200, NULL, NULL));
    check_body(ovoid_shape_create_from_points(cloud, 600, NULL, NULL));
}

// A body so small that its ellipsoids underflow to points: no point inside is known, so its triangles are not written.
static void check_tiny(void) {
    uint64_t s = 23;
    for (size_t i = 0; i < 600; i++) {
        vec3 v = vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
        put(i, vec3_scale(v, 1e-170));
    }
    ovoid_shape *shape = ovoid_shape_create_from_points(cloud, 600, NULL, NULL);
    CHECK_EQ(shape->rank, 3);
    CHECK_EQ(shape->inner.q.xx, 0);
    check_body(shape);
}

// ---- what is forged ----

// A file being forged: its bytes, its triangles in them.
typedef struct forgery {
    uint8_t *bytes;
    size_t size;
    uint32_t vertices, triangles;
} forgery;

static forgery forge(const ovoid_shape *s) {
    forgery f = {NULL, shape_write_version(s, 3, NULL, 0), s->vertex_count, s->counts.triangles};
    f.bytes = malloc(f.size);
    shape_write_version(s, 3, f.bytes, f.size);
    return f;
}

// A triangle's or a vertex's place in the file.
static size_t triangle_at(const forgery *f, uint32_t t) { return AT + 24 * (size_t)f->vertices + 12 * (size_t)t; }
static size_t vertex_at(uint32_t v) { return AT + 24 * (size_t)v; }

static void get_triangle(const forgery *f, uint32_t t, uint32_t corner[3]) {
    memcpy(corner, f->bytes + triangle_at(f, t), 12);
}
static void set_triangle(const forgery *f, uint32_t t, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t corner[3] = {a, b, c};
    memcpy(f->bytes + triangle_at(f, t), corner, 12);
}
static void set_vertex(const forgery *f, uint32_t v, vec3 p) { memcpy(f->bytes + vertex_at(v), &p, sizeof p); }

static ovoid_shape *read_forged(const forgery *f, ovoid_error *e) {
    shape_files_mend(f->bytes, f->size);
    *e = (ovoid_error){0};
    return ovoid_shape_read(f->bytes, f->size, NULL, e);
}

// Refused with these words, at this byte unless it is 0.
static void check_refused(forgery *f, const char *words, size_t at) {
    ovoid_error e;
    ovoid_shape *t = read_forged(f, &e);
    CHECK(t == NULL);
    CHECK_EQ(e.code, OVOID_ERROR_FORMAT);
    if (!CHECK(strstr(e.message, words) != NULL)) printf("    \"%s\" is not: %s\n", e.message, words);
    if (at) CHECK_EQ(e.place, (int64_t)at);
    ovoid_shape_destroy(t);
    free(f->bytes);
}

static ovoid_shape *make_round(uint32_t n) {
    uint64_t s = 29;
    for (uint32_t i = 0; i < n; i++) put(i, vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)}));
    return ovoid_shape_create_from_points(cloud, n, NULL, NULL);
}

// The triangle that runs through an edge, and its third corner.
static uint32_t find_edge(const forgery *f, uint32_t from, uint32_t to, uint32_t *third) {
    for (uint32_t t = 0; t < f->triangles; t++) {
        uint32_t c[3];
        get_triangle(f, t, c);
        for (int k = 0; k < 3; k++)
            if (c[k] == from && c[(k + 1) % 3] == to) {
                *third = c[(k + 2) % 3];
                return t;
            }
    }
    CHECK(!"the edge exists");
    return 0;
}

// Triangles t and the one across its edge from a to b get the other diagonal.
static void flip_edge(const forgery *f, uint32_t t, const uint32_t c[3]) {
    uint32_t beyond, across = find_edge(f, c[1], c[0], &beyond);
    set_triangle(f, t, c[2], c[0], beyond);
    set_triangle(f, across, beyond, c[1], c[2]);
}

static int has_edge(const forgery *f, uint32_t from, uint32_t to) {
    for (uint32_t t = 0; t < f->triangles; t++) {
        uint32_t c[3];
        get_triangle(f, t, c);
        for (int k = 0; k < 3; k++)
            if (c[k] == from && c[(k + 1) % 3] == to) return 1;
    }
    return 0;
}

// Moves the last corner of triangle t to a vertex that neither of the others has an edge to.
static void tear(const forgery *f, uint32_t t, const uint32_t c[3]) {
    uint32_t w = 0;
    while (w == c[0] || w == c[1] || has_edge(f, c[1], w) || has_edge(f, w, c[0])) w++;
    CHECK(w < f->vertices);
    set_triangle(f, t, c[0], c[1], w);
}

static void check_broken_triangles(void) {
    ovoid_shape *s = make_round(40);
    uint32_t c[3], d[3];
    for (uint32_t t = 0; t < s->counts.triangles; t += 5) {
        forgery f = forge(s);
        get_triangle(&f, t, c);
        get_triangle(&f, (t + 7) % f.triangles, d);
        set_triangle(&f, t, c[1], c[0], c[2]); // turned over
        check_refused(&f, "edge", 0);
        f = forge(s);
        set_triangle(&f, t, d[0], d[1], d[2]); // another one twice, this one missing
        check_refused(&f, "edge", 0);
        f = forge(s);
        set_triangle(&f, t, c[0], c[1],
                     (c[2] + 1) % 40 == c[0] || (c[2] + 1) % 40 == c[1] ? (c[2] + 3) % 40 : (c[2] + 1) % 40);
        check_refused(&f, "", 0);
        f = forge(s);
        tear(&f, t, c);
        check_refused(&f, "the surface is open", 0);
        f = forge(s);
        set_triangle(&f, t, c[0], c[1], c[1]);
        check_refused(&f, "", 0);
        f = forge(s);
        set_triangle(&f, t, c[0], 40, c[2]);
        check_refused(&f, "no vertex", triangle_at(&f, t));
        f = forge(s);
        set_triangle(&f, t, UINT32_MAX, c[1], c[2]);
        check_refused(&f, "no vertex", triangle_at(&f, t));
        f = forge(s);
        flip_edge(&f, t, c); // a dent, or more than that
        check_refused(&f, t ? "" : "not convex at an edge", 0);
    }
    ovoid_shape_destroy(s);
}

// Every triangle inside out; a vertex that no triangle has; a vertex pulled inward; the inside outside.
static void check_broken_bodies(void) {
    ovoid_shape *s = make_round(40);
    uint32_t c[3];
    forgery f = forge(s);
    for (uint32_t t = 0; t < f.triangles; t++) get_triangle(&f, t, c), set_triangle(&f, t, c[1], c[0], c[2]);
    check_refused(&f, "face outward", triangle_at(&f, 0));
    f = forge(s);
    for (uint32_t t = 0; t < f.triangles; t++) {
        get_triangle(&f, t, c);
        for (int k = 0; k < 3; k++) c[k] -= c[k] == 17;
        set_triangle(&f, t, c[0], c[1], c[2]);
    }
    check_refused(&f, "on no triangle", vertex_at(17));
    f = forge(s);
    set_vertex(&f, 17, vec3_scale(vec3_at(shape_vertices(s), 17), 0.75));
    check_refused(&f, "not convex at an edge", 0);
    f = forge(s);
    set_vertex(&f, 17, vec3_at(shape_vertices(s), 18));
    check_refused(&f, "", 0);
    f = forge(s);
    double far = 1.25;
    memcpy(f.bytes + 216, &far, sizeof far);
    check_refused(&f, "face outward", 0);
    f = forge(s);
    far = 1e50;
    memcpy(f.bytes + 216, &far, sizeof far);
    check_refused(&f, "inside", 0);
    ovoid_shape_destroy(s);
}

// A surface as a file: the vertices and triangles given, ellipsoids of the ball of radius 1 and of a tiny one, centred.
static forgery forge_surface(const vec3 *v, uint32_t vertices, const uint32_t (*t)[3], uint32_t triangles) {
    ovoid_shape *s = make_round(vertices);
    CHECK_EQ(s->counts.triangles, triangles);
    forgery f = forge(s);
    ovoid_shape_destroy(s);
    const double outer[9] = {0, 0, 0, 4, 0, 0, 4, 0, 4}, inner[9] = {0, 0, 0, 1e-6, 0, 0, 1e-6, 0, 1e-6};
    memcpy(f.bytes + 104, outer, sizeof outer);
    memcpy(f.bytes + 216, inner, sizeof inner);
    for (uint32_t i = 0; i < vertices; i++) set_vertex(&f, i, v[i]);
    for (uint32_t i = 0; i < triangles; i++) set_triangle(&f, i, t[i][0], t[i][1], t[i][2]);
    return f;
}

static void check_accepted(forgery *f) {
    ovoid_error e;
    ovoid_shape *t = read_forged(f, &e);
    if (!CHECK(t)) printf("    %s\n", e.message);
    ovoid_shape_destroy(t);
    free(f->bytes);
}

// All triples of the icosahedron's vertices whose sides have that squared length, outward: its own 20 faces with the
// shorter one, those of the great icosahedron with the longer one. Both are closed surfaces, convex at each edge.
static forgery forge_icosahedron(double square) {
    const double g = 1.6180339887498949;
    vec3 v[12];
    uint32_t t[20][3], n = 0;
    for (uint32_t i = 0; i < 12; i++) {
        double a = i & 1 ? 1 : -1, b = i & 2 ? g : -g;
        v[i] = i < 4 ? (vec3){0, a, b} : i < 8 ? (vec3){a, b, 0} : (vec3){b, 0, a};
    }
    for (uint32_t i = 0; i < 12; i++)
        for (uint32_t k = i + 1; k < 12; k++)
            for (uint32_t m = k + 1; m < 12 && n < 20; m++) {
                if (fabs(vec3_norm_squared(vec3_sub(v[i], v[k])) - square) > 1e-9 ||
                    fabs(vec3_norm_squared(vec3_sub(v[k], v[m])) - square) > 1e-9 ||
                    fabs(vec3_norm_squared(vec3_sub(v[m], v[i])) - square) > 1e-9)
                    continue;
                int out = vec3_dot(v[i], vec3_cross(v[k], v[m])) > 0;
                t[n][0] = i, t[n][1] = out ? k : m, t[n++][2] = out ? m : k;
            }
    CHECK_EQ(n, 20);
    return forge_surface(v, 12, (const uint32_t(*)[3])t, 20);
}

// Two double pyramids over regular pentagons with common apices: the count of triangles is right, all edges are convex,
// and all of it winds twice.
static void check_two_in_one(void) {
    vec3 v[12] = {{0, 0, 1}, {0, 0, -1}};
    uint32_t t[20][3];
    for (uint32_t i = 0; i < 10; i++) {
        uint32_t start = i < 5 ? 2 : 7, here = start + i % 5, next = start + (i + 1) % 5;
        double at = 2 * 3.14159265358979 * (i % 5) / 5, r = i < 5 ? 1 : 0.5;
        v[here] = (vec3){r * cos(at), r * sin(at), 0};
        if (i % 5 == 0) v[here].y = 0;
        t[2 * i][0] = 0, t[2 * i][1] = here, t[2 * i][2] = next;
        t[2 * i + 1][0] = 1, t[2 * i + 1][1] = next, t[2 * i + 1][2] = here;
    }
    forgery f = forge_surface(v, 12, (const uint32_t(*)[3])t, 20);
    check_refused(&f, "wind once", 0);
}

// Two tetrahedra that share an edge: four triangles meet there.
static void check_edge_of_four(void) {
    static const uint32_t t[8][3] = {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3},
                                     {0, 1, 4}, {1, 0, 5}, {0, 4, 5}, {4, 1, 5}};
    const vec3 v[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0.5}, {0, 1, -0.5}, {0, -1, 0.5}, {0, -1, -0.5}};
    forgery f = forge_surface(v, 6, t, 8);
    check_refused(&f, "same direction", 0);
}

static void check_winding(void) {
    check_edge_of_four();
    forgery f = forge_icosahedron(4);
    check_accepted(&f);
    f = forge_icosahedron(4 * 1.6180339887498949 * 1.6180339887498949);
    check_refused(&f, "wind once", 0);
    check_two_in_one();
}

// A cube whose top has a ninth vertex: below it, in it, in one of its edges, above it.
static void check_ninth(void) {
    static const uint32_t t[14][3] = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}, {1, 3, 5}, {3, 7, 5}, {3, 2, 7},
                                      {2, 6, 7}, {2, 0, 6}, {0, 4, 6}, {4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}};
    vec3 v[9];
    for (uint32_t i = 0; i < 8; i++) v[i] = (vec3){i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5};
    v[8] = (vec3){0, 0, 0.5 + 0x1p-52};
    forgery f = forge_surface(v, 9, t, 14);
    check_accepted(&f);
    v[8] = (vec3){0.125, 0.0625, 0.5};
    f = forge_surface(v, 9, t, 14);
    check_refused(&f, "not extreme", vertex_at(8));
    v[8].z = 0.5 - 0x1p-54;
    f = forge_surface(v, 9, t, 14);
    check_refused(&f, "not convex at an edge", 0);

    // In the edge from 4 to 5, which two triangles of the front share now.
    static const uint32_t in_edge[14][3] = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 8, 4}, {1, 5, 8},
                                            {1, 3, 5}, {3, 7, 5}, {3, 2, 7}, {2, 6, 7}, {2, 0, 6},
                                            {0, 4, 6}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}};
    v[8] = (vec3){0, -0.5, 0.5};
    f = forge_surface(v, 9, in_edge, 14);
    check_refused(&f, "not extreme", vertex_at(8));
}

// The other diagonal of a cube's side and triangles in another order are the same body.
static void check_other_triangles(void) {
    ovoid_shape *s = ovoid_shape_create_box((vec3){1, 2, 3}, NULL, NULL);
    forgery f = forge(s);
    uint32_t c[3], d[3], flipped = 0;
    for (uint32_t t = 0; t < f.triangles && !flipped; t++) {
        uint32_t beyond;
        get_triangle(&f, t, c);
        uint32_t across = find_edge(&f, c[1], c[0], &beyond);
        if (s->counts.facets != 6 ||
            ovoid_shape_get_polytope(s).triangle_facets[t] != ovoid_shape_get_polytope(s).triangle_facets[across])
            continue;
        flip_edge(&f, t, c);
        flipped = 1;
    }
    CHECK(flipped);
    get_triangle(&f, 3, c);
    get_triangle(&f, 9, d);
    set_triangle(&f, 3, d[1], d[2], d[0]);
    set_triangle(&f, 9, c[2], c[0], c[1]);
    ovoid_error e;
    ovoid_shape *t = read_forged(&f, &e);
    if (CHECK(t)) {
        CHECK_EQ(t->counts.facets, 6);
        CHECK_EQ(ovoid_shape_get_measures(t).volume, 48);
        ovoid_pair pair = {s, t, ovoid_pose_make_identity(), ovoid_pose_make_rpy((vec3){3, 0, 0}, (vec3){0, 0, 0})};
        ovoid_answer answer = ovoid_distance(&pair, NULL, NULL);
        CHECK_LE(1, answer.upper);
        CHECK_NEAR(answer.upper, 1, 1e-11);
        CHECK(ovoid_answer_verify(&pair, &answer, NULL, NULL) == OVOID_OK);
    }
    ovoid_shape_destroy(t);
    free(f.bytes);
    ovoid_shape_destroy(s);
}

// Allowances that no shape has: negative, not a number, and inside more than the body has room for, which a constructor
// takes away. (Found by fuzzing: the last was read, and written again as other bytes.)
static void check_allowances(void) {
    ovoid_shape *s = make_round(12);
    for (uint32_t version = 2; version <= 3; version++)
        for (size_t at = 328; at < 344; at += 8) {
            static const double wrong[] = {-1, NAN, 1e51, 1e30};
            for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
                if (at == 328 && wrong[i] == 1e30) continue;
                ovoid_shape_options known = {.allowance = {.outside = 0.1, .inside = 0.1}};
                ovoid_shape *t = ovoid_shape_create_from_points(cloud, 12, &known, NULL);
                forgery f = {NULL, shape_write_version(t, version, NULL, 0), 12, 20};
                f.bytes = malloc(f.size);
                shape_write_version(t, version, f.bytes, f.size);
                memcpy(f.bytes + at, &wrong[i], 8);
                check_refused(&f, "allowance", wrong[i] == 1e30 ? 336 : 328);
                ovoid_shape_destroy(t);
            }
        }
    ovoid_shape_destroy(s);
}

// True bodies in which the polyhedron is not inscribed, or which are none: `at` is the number of the value in the file.
static void check_rounds(void) {
    static const struct {
        int at;
        double factor, other; // other: where the factor is 0
    } wrong[] = {{1, 0, 0},    {1, 0, -1},       {1, 0, NAN}, {1, 1.01, 0},     {1, 0.99, 0},
                 {2, 0, -0.0}, {2, 0, -1},       {2, 0, NAN}, {2, 1.01, 0},     {2, 0.99, 0},
                 {2, 0, 0},    {1, 1 + 1e-9, 0}, {0, 0, 0},   {1, 1 - 1e-9, 0}, {2, 1 + 1e-15, 0}};
    for (int kind = 0; kind < 2; kind++)
        for (size_t i = 0; i < 2 * sizeof wrong / sizeof *wrong; i++) {
            ovoid_shape *s = (kind ? ovoid_shape_create_cone : ovoid_shape_create_cylinder)(1, 0.75, NULL, NULL);
            uint32_t version = 6 + i % 2;
            forgery f = {NULL, shape_write_version(s, version, NULL, 0), s->vertex_count, s->counts.triangles};
            f.bytes = malloc(f.size);
            shape_write_version(s, version, f.bytes, f.size);
            CHECK(f.bytes[8] == version && f.bytes[368] == 1 + kind);
            double value;
            uint8_t *place = f.bytes + 368 + 8 * wrong[i / 2].at;
            memcpy(&value, place, 8);
            value = wrong[i / 2].factor > 0 ? value * wrong[i / 2].factor : wrong[i / 2].other;
            memcpy(place, &value, 8);
            // The other kind: a prism is no pyramid.
            if (wrong[i / 2].at == 0) f.bytes[368] = (uint8_t)(2 - kind);
            check_refused(&f, "true body", 368);
            ovoid_shape_destroy(s);
        }
}

// Axes that no allowance has: zero, not of length 1, not a number, or of nothing that stands out.
static void check_axes(void) {
    static const vec3 wrong[] = {{0, 0, 0}, {0, 0, 2}, {0, 0, 1 - 1e-9}, {NAN, 0, 1}, {0, INFINITY, 0}};
    ovoid_shape *s = ovoid_shape_create_cylinder(1, 1, &(ovoid_shape_options){.tolerance = 0.05}, NULL);
    for (size_t i = 0; i < 2 * (sizeof wrong / sizeof *wrong + 1); i++) {
        uint32_t version = 4 + i % 2;
        forgery f = {NULL, shape_write_version(s, version, NULL, 0), s->vertex_count, s->counts.triangles};
        f.bytes = malloc(f.size);
        shape_write_version(s, version, f.bytes, f.size);
        CHECK_EQ(f.bytes[8], version);
        if (i / 2 < sizeof wrong / sizeof *wrong)
            memcpy(f.bytes + 344, &wrong[i / 2], sizeof *wrong);
        else
            memset(f.bytes + 328, 0, 8);
        check_refused(&f, "axis", 344);
    }
    ovoid_shape_destroy(s);
}

// Ranks and versions that do not go together.
static void check_headers(void) {
    ovoid_shape *s = make_round(12);
    for (uint32_t rank = 0; rank < 5; rank++) {
        if (rank == 3) continue;
        forgery f = forge(s);
        f.bytes[12] = (uint8_t)rank;
        check_refused(&f, "solid", 12);
    }
    forgery f = forge(s);
    f.bytes[8] = 17;
    check_refused(&f, "version", 8);
    f = forge(s);
    f.bytes[8] = 2;
    check_refused(&f, "does not agree", 24);
    f = forge(s);
    f.bytes[24]++;
    check_refused(&f, "does not agree", 24);
    // All vertices in a plane.
    f = forge(s);
    double zero = 0;
    for (uint32_t v = 0; v < f.vertices; v++) memcpy(f.bytes + vertex_at(v) + 16, &zero, sizeof zero);
    check_refused(&f, "plane", vertex_at(0));
    ovoid_shape_destroy(s);
}

int main(void) {
    check_primitives();
    check_random();
    check_coplanar();
    check_tiny();
    check_broken_triangles();
    check_broken_bodies();
    check_winding();
    check_ninth();
    check_other_triangles();
    check_allowances();
    check_axes();
    check_rounds();
    check_headers();
    return check_end();
}
