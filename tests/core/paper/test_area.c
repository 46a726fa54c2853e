// Areas: exits and supports through the tables. Truth: looking at all facets or vertices, to the last bit; the plane
// each exit lies on; the polyhedron itself; and the notes' numbers about the paper's rule, which are integrals over the
// sphere, here from 400 000 samples (standard error of a mean of at most 8 counts below 0.003).
#include "paper/area.h"
#include "polytopes.h"
#include "shape/direction_cells.h"

#include <time.h>

/// A body with an ellipsoid inside: the images of a made polytope and of a ball of half its inner radius.
typedef struct subject {
    const char *name;
    made body;
    ovoid_ellipsoid ellipsoid;
} subject;

static subject subject_make(const char *name, made body, double ball, mat3 map, vec3 shift) {
    made_map(&body, map, shift);
    mat3 q = mat3_mul(map, mat3_transpose(map));
    sym3 s = {q.r0.x, q.r0.y, q.r0.z, q.r1.y, q.r1.z, q.r2.z};
    return (subject){name, body, {shift, sym3_scale(s, ball * ball)}};
}

static mat3 random_map(uint64_t *s, double ratio, double scale) {
    double thin = 1 / ratio, middle = sqrt(thin);
    mat3 stretch = mat3_diagonal(scale, scale * middle, scale * thin);
    mat3 first = mat3_random_rotation(s), last = mat3_random_rotation(s);
    return mat3_mul(last, mat3_mul(stretch, first));
}

enum { SUBJECT_COUNT = 11 };
static void subjects_make(subject *to) {
    uint64_t s = 11;
    const mat3 one = mat3_diagonal(1, 1, 1);
    made spheres[5];
    const uint32_t counts[5] = {60, 400, 80, 50, 50};
    for (int i = 0; i < 5; i++) spheres[i] = made_random(counts[i], i != 1, &s);
    const vec3 none = {0, 0, 0};
    to[0] = subject_make("box", made_box(1, 2, 3), 0.5, one, none);
    to[1] = subject_make("tetrahedron", made_simplex(), 0.2, random_map(&s, 3, 1), none);
    to[2] = subject_make("prism of 31", made_prism(31), 0.5, random_map(&s, 2, 1), none);
    to[3] = subject_make("sphere", made_sphere(8), 0.9, one, none);
    to[4] = subject_make("random 60", spheres[0], 0.3, random_map(&s, 5, 1), none);
    to[5] = subject_make("random 400, some inside", spheres[1], 0.3, random_map(&s, 2, 1), none);
    to[6] = subject_make("needle 1:1e4", spheres[2], 0.3, random_map(&s, 1e4, 1), none);
    to[7] = subject_make("slab 1:1e6", made_sphere(4), 0.5, mat3_diagonal(1, 1, 1e-6), none);
    to[8] = subject_make("tiny", spheres[3], 0.3, random_map(&s, 2, 1e-9), none);
    to[9] = subject_make("huge", made_prism(7), 0.3, random_map(&s, 2, 1e9), none);
    to[10] = subject_make("far away", spheres[4], 0.3, random_map(&s, 2, 1), (vec3){1e7, -1e7, 1e7});
}

static uint32_t brute_support(const ovoid_polytope *p, vec3 n) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < p->vertex_count; i++)
        if (vec3_dot(vec3_at(p->vertices, i), n) > vec3_dot(vec3_at(p->vertices, best), n)) best = i;
    return best;
}

static void check_direction(const ovoid_areas *areas, vec3 u, vec3 toward) {
    // The sound rules give the bits of looking at all.
    ovoid_exit all = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_ALL);
    ovoid_exit ray = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_RAY);
    ovoid_exit signs = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_SIGNS);
    CHECK(all.facet == ray.facet && all.t == ray.t);
    CHECK(all.facet == signs.facet && all.t == signs.t);
    CHECK_LE(ray.touched, all.touched);
    CHECK_LE(signs.touched, all.touched);
    uint32_t touched;
    CHECK_EQ(ovoid_areas_find_support(areas, u, &touched), brute_support(&areas->polytope, u));
    CHECK(touched > 0 && touched <= areas->polytope.vertex_count);
}

/// A direction to the other body such that the ray's is in front of it, in sphere space.
static vec3 toward_of(const ovoid_areas *areas, vec3 u, uint64_t *s) {
    vec3 w = {random_normal(s), random_normal(s), random_normal(s)};
    vec3 mapped = sym3_mul_vec3(areas->inverse_root, u);
    if (vec3_dot(vec3_unit(mapped), w) < 0) w = vec3_neg(w);
    return sym3_mul_vec3(areas->root, w);
}

static void check_areas(const subject *b, ovoid_split split, uint32_t k, uint64_t *s) {
    ovoid_error error;
    ovoid_areas *areas =
        ovoid_areas_create(&b->body.p, &b->ellipsoid, &(ovoid_areas_options){.split = split, .k = k}, &error);
    if (!CHECK(areas != NULL)) return;
    ovoid_area_counts counts = ovoid_areas_get_counts(areas);
    CHECK_EQ(counts.cells, split == OVOID_SPLIT_CUBE ? 6 * k * k : 8);
    CHECK_LE(counts.facet_entries, (uint64_t)counts.cells * b->body.p.facet_count);

    // Any direction, of any length.
    for (int i = 0; i < 300; i++) {
        vec3 u = {random_normal(s), random_normal(s), random_normal(s)};
        u = vec3_scale(u, i % 3 == 0 ? 1e-100 : i % 3 == 1 ? 1e100 : 1);
        check_direction(areas, u, toward_of(areas, vec3_unit(u), s));
        vec3 mapped = sym3_mul_vec3(areas->root, vec3_unit(u));
        check_direction(areas, mapped, toward_of(areas, mapped, s));
    }
    // Borders and corners of cells, mapped back both ways, on them and a rounding beside.
    for (int i = 0; i < 200; i++) {
        double a = (double)(random_next(s) % 129) / 64 - 1, c = (double)(random_next(s) % 129) / 64 - 1;
        if (i % 4 == 0) a = random_uniform(s, -1, 1);
        vec3 v = cube_point((uint32_t)(random_next(s) % 6), i % 8 == 3 ? 0 : a, c);
        v.x *= 1 + (double)(i % 5 - 2) * 0x1p-52;
        v.y += (double)(i % 3 - 1) * 0x1p-53;
        vec3 u = sym3_mul_vec3(areas->root, v), n = sym3_mul_vec3(areas->inverse_root, v);
        check_direction(areas, u, toward_of(areas, u, s));
        check_direction(areas, n, toward_of(areas, n, s));
        check_direction(areas, v, toward_of(areas, v, s));
    }
    // Rays through vertices, where several facets tie, and along normals, where several vertices do.
    for (uint32_t i = 0; i < b->body.p.vertex_count && i < 100; i++) {
        vec3 u = vec3_sub(vec3_at(b->body.p.vertices, i), b->ellipsoid.center);
        check_direction(areas, u, toward_of(areas, u, s));
    }
    for (uint32_t j = 0; j < b->body.p.facet_count && j < 100; j++) {
        vec3 n = b->body.p.planes[j].normal;
        check_direction(areas, n, toward_of(areas, n, s));
        check_direction(areas, vec3_neg(n), toward_of(areas, vec3_neg(n), s));
    }
    ovoid_areas_destroy(areas);
}

static void test_soundness(subject *subjects) {
    for (int i = 0; i < SUBJECT_COUNT; i++) {
        uint64_t s = check_seed = (uint64_t)i + 1;
        check_areas(&subjects[i], OVOID_SPLIT_OCTANTS, 0, &s);
        for (uint32_t k = 1; k <= 16; k *= 4) check_areas(&subjects[i], OVOID_SPLIT_CUBE, k, &s);
    }
    uint64_t s = check_seed = 99;
    check_areas(&subjects[3], OVOID_SPLIT_CUBE, 64, &s);
    check_areas(&subjects[6], OVOID_SPLIT_CUBE, 64, &s);
}

/// The exit is on its facet, and on or behind all the others; a little further the ray is outside.
static void test_exit_is_on_surface(subject *subjects) {
    for (int i = 0; i < SUBJECT_COUNT; i++) {
        const subject *b = &subjects[i];
        ovoid_areas *areas = ovoid_areas_create(&b->body.p, &b->ellipsoid,
                                                &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 4}, NULL);
        if (!CHECK(areas != NULL)) return;
        uint64_t s = check_seed = (uint64_t)i + 1;
        // Coordinates hold the exit to their own rounding; the thin bodies' planes are tilted by 1e-16 over 1e6 : 1.
        double size = vec3_norm(vec3_sub(vec3_at(b->body.p.vertices, 0), b->ellipsoid.center));
        double tolerance = 1e-12 * (size + vec3_norm(b->ellipsoid.center));
        for (int r = 0; r < 200; r++) {
            vec3 u = sym3_mul_vec3(areas->root, (vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
            ovoid_exit e = ovoid_areas_find_exit(areas, u, u, OVOID_RULE_RAY);
            CHECK(e.t > 0 && isfinite(e.t));
            for (uint32_t j = 0; j < b->body.p.facet_count; j++)
                CHECK_LE(vec3_dot(b->body.p.planes[j].normal, e.point) - b->body.p.planes[j].offset, tolerance);
            ovoid_plane p = b->body.p.planes[e.facet];
            CHECK_NEAR(vec3_dot(p.normal, e.point), p.offset, tolerance);
        }
        ovoid_areas_destroy(areas);
    }
}

/// Known by hand: a cube, and rays along its axes, its diagonals.
static void test_closed_form(void) {
    made box = made_box(1, 1, 1);
    ovoid_ellipsoid ball = {{0, 0, 0}, {1, 0, 0, 1, 0, 1}};
    ovoid_areas *areas =
        ovoid_areas_create(&box.p, &ball, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 1}, NULL);
    if (!CHECK(areas != NULL)) return;
    // Each face of the cube map sees its own face of the cube, whose borders it shares with four.
    CHECK_EQ(ovoid_areas_get_counts(areas).cells, 6);
    CHECK_EQ(ovoid_areas_get_counts(areas).facet_entries, 30);
    ovoid_exit e = ovoid_areas_find_exit(areas, (vec3){0, 0, 2}, (vec3){0, 0, 1}, OVOID_RULE_RAY);
    CHECK(e.t == 0.5 && e.point.x == 0 && e.point.y == 0 && e.point.z == 1);
    e = ovoid_areas_find_exit(areas, (vec3){-1, 0.5, 0.25}, (vec3){-1, 0, 0}, OVOID_RULE_SIGNS);
    CHECK(e.t == 1 && e.point.x == -1 && e.point.y == 0.5 && e.point.z == 0.25);
    e = ovoid_areas_find_exit(areas, (vec3){1, 1, 1}, (vec3){1, 1, 1}, OVOID_RULE_ALL);
    CHECK(e.t == 1 && e.touched == 6);
    CHECK_EQ(ovoid_areas_find_support(areas, (vec3){1, 1, 1}, NULL), 7);
    CHECK_EQ(ovoid_areas_find_support(areas, (vec3){-1, -2, -3}, NULL), 0);
    // A direction that is none is answered, whatever with.
    CHECK_LE(ovoid_areas_find_support(areas, (vec3){NAN, 0, 0}, NULL), 7);
    CHECK(ovoid_areas_find_exit(areas, (vec3){0, 0, 0}, (vec3){0, 0, 0}, OVOID_RULE_RAY).t == INFINITY);
    ovoid_areas_destroy(areas);
    made_destroy(&box);
}

/// One case by hand, on a sphere of triangles 4 degrees wide: the other body lies along (1, 1, 0.23), so that the
/// octant
/// (-, -, +) has the product -0.713 with it and is dropped by the paper's rule; but the ray (-0.1, -0.1, 1), in front
/// of the sphere as seen from there, leaves by it.
static void test_paper_rule_is_unsound(void) {
    subject sphere = subject_make("sphere", made_sphere(24), 0.9, mat3_diagonal(1, 1, 1), (vec3){0, 0, 0});
    ovoid_areas *areas = ovoid_areas_create(&sphere.body.p, &sphere.ellipsoid, NULL, NULL);
    if (!CHECK(areas != NULL)) return;
    vec3 toward = {1, 1, 0.23}, u = {-0.1, -0.1, 1};
    CHECK(vec3_dot(toward, u) > 0);
    CHECK(!(octants_find_kept(toward, OVOID_RULE_PAPER) >> octant_of(u) & 1));
    CHECK(octants_find_kept(toward, OVOID_RULE_SIGNS) >> octant_of(u) & 1);
    ovoid_exit right = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_ALL);
    ovoid_exit sound = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_SIGNS);
    ovoid_exit wrong = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_PAPER);
    CHECK(sound.t == right.t && sound.facet == right.facet);
    CHECK(wrong.t > right.t * (1 + 1e-6) && wrong.facet != right.facet);

    // How often, for directions in front of a random other body.
    uint64_t s = check_seed = 3;
    long wrongs = 0, dropped = 0, count = 20000;
    for (long i = 0; i < count; i++) {
        u = (vec3){random_normal(&s), random_normal(&s), random_normal(&s)};
        toward = toward_of(areas, u, &s);
        right = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_ALL);
        wrong = ovoid_areas_find_exit(areas, u, toward, OVOID_RULE_PAPER);
        wrongs += wrong.t != right.t;
        vec3 mapped = sym3_mul_vec3(areas->inverse_root, toward);
        dropped += !(octants_find_kept(mapped, OVOID_RULE_PAPER) >> octant_of(u) & 1);
    }
    printf("the paper's rule: of %ld rays into the front half, %ld pass a dropped octant, %ld get a wrong exit\n",
           count, dropped, wrongs);
    CHECK(wrongs > 0);
    ovoid_areas_destroy(areas);
    made_destroy(&sphere.body);
}

/// The notes' numbers.
static void test_claims(void) {
    uint64_t s = check_seed = 17;
    long count = 400000, paper = 0, unsound = 0, signs = 0, dot = 0;
    for (long i = 0; i < count; i++) {
        vec3 d = vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
        uint32_t by_paper = 0xff & ~octants_find_kept(d, OVOID_RULE_PAPER);
        uint32_t by_signs = 0xff & ~octants_find_kept(d, OVOID_RULE_SIGNS);
        for (uint32_t o = 0; o < 8; o++) {
            vec3 v = vec3_unit((vec3){o & 1 ? -1 : 1, o & 2 ? -1 : 1, o & 4 ? -1 : 1});
            paper += by_paper >> o & 1;
            signs += by_signs >> o & 1;
            dot += vec3_dot(v, d) < -sqrt(2.0 / 3);
            // Some corner of the dropped octant in front.
            int is_in_front = (o & 1 ? -d.x : d.x) > 0 || (o & 2 ? -d.y : d.y) > 0 || (o & 4 ? -d.z : d.z) > 0;
            unsound += (by_paper >> o & 1) && is_in_front;
            CHECK(!((by_signs >> o & 1) && is_in_front));
            CHECK(!(vec3_dot(v, d) < -sqrt(2.0 / 3) && is_in_front));
        }
    }
    double n = (double)count;
    printf("octants dropped of 8: paper %.3f (%.1f %% of them unsound), signs %.3f, -sqrt(2/3) %.3f\n",
           (double)paper / n, 100 * (double)unsound / (double)paper, (double)signs / n, (double)dot / n);
    CHECK_NEAR((double)paper / n, 1.17, 0.01);
    CHECK_NEAR((double)unsound / (double)paper, 0.197, 0.004);
    CHECK_EQ(signs, count);
    CHECK_NEAR((double)dot / n, 0.73, 0.01);
    // The integral behind two of them: eight caps of cosine c cover 8 (1 - c)/2 of the sphere.
    CHECK_NEAR((double)paper / n, 4 * (1 - sqrt(0.5)), 0.005);
    CHECK_NEAR((double)dot / n, 4 * (1 - sqrt(2.0 / 3)), 0.005);
}

/// The paper's cylinder of k sides: caps cut from a centre vertex, 2k + 2 vertices and 4k triangles.
static made made_paper_cylinder(uint32_t k) {
    double *v = malloc(3 * sizeof(double) * (2 * k + 2));
    uint32_t *t = malloc(3 * sizeof(uint32_t) * 4 * k), *sizes = malloc(sizeof(uint32_t) * 4 * k);
    for (uint32_t i = 0; i < 2 * k; i++) {
        double angle = 6.283185307179586 * (i % k) / k;
        v[3 * i] = cos(angle), v[3 * i + 1] = sin(angle), v[3 * i + 2] = i < k ? -1 : 1;
    }
    const double caps[6] = {0, 0, -1, 0, 0, 1};
    memcpy(v + 6 * k, caps, sizeof caps);
    for (uint32_t i = 0; i < k; i++) {
        uint32_t j = (i + 1) % k;
        const uint32_t faces[12] = {i, j, j + k, i, j + k, i + k, 2 * k, j, i, 2 * k + 1, i + k, j + k};
        memcpy(t + 12 * i, faces, sizeof faces);
    }
    for (uint32_t i = 0; i < 4 * k; i++) sizes[i] = 3;
    made m = made_from_polygons(v, 2 * k + 2, t, sizes, 4 * k);
    free(v);
    free(t);
    free(sizes);
    return m;
}

static void test_split(void) {
    made box = made_box(1, 2, 3);
    ovoid_ellipsoid inner = {{0, 0, 0}, {1, 0, 0, 4, 0, 9}};
    ovoid_split_counts c = ovoid_polytope_compute_split(&box.p, &inner);
    CHECK_EQ(c.faces, 12);
    CHECK_EQ(c.pieces, 36);
    // Per octant and face: one quarter, cut by the diagonal or not. Two of a face's four quarters are halved.
    uint32_t sum = 0;
    for (int o = 0; o < 8; o++) {
        sum += c.per_octant[o];
        CHECK(c.per_octant[o] >= 3 && c.per_octant[o] <= 6);
    }
    CHECK_EQ(sum, 36);
    // A quarter's square has two triangles, its two halves one each: 4 quarters make 2 (2 + 1 + 1) of a face of 2.
    CHECK_EQ(c.triangles, 48);
    // Through the vertices: nothing is cut where the planes pass along edges.
    made sphere = made_sphere(6);
    inner.q = (sym3){1, 0, 0, 1, 0, 1};
    c = ovoid_polytope_compute_split(&sphere.p, &inner);
    CHECK(c.pieces == c.faces && c.triangles == c.faces);
    for (int o = 0; o < 8; o++) CHECK_EQ(c.per_octant[o], c.faces / 8);
    // A tetrahedron between alternate corners of a cube: each plane cuts each face along a middle line, into 4 pieces.
    made simplex = made_simplex();
    c = ovoid_polytope_compute_split(&simplex.p, &inner);
    CHECK_EQ(c.pieces, 16);
    CHECK_EQ(c.triangles, 16);
    // The same octahedron, stretched askew with its ellipsoid: in sphere space its vertices lie on the axes but for
    // rounding, which must cut no slivers.
    uint64_t s = 3;
    for (int i = 0; i < 50; i++) {
        vec3 e0 = vec3_unit(vec3_random(&s)), e1 = vec3_orthogonal(e0), e2 = vec3_cross(e0, e1);
        sym3 root = sym3_add(sym3_outer(e0, random_uniform(&s, 1, 3)),
                             sym3_add(sym3_outer(e1, random_uniform(&s, 1, 3)), sym3_outer(e2, 1)));
        vec3 columns[3] = {{root.xx, root.xy, root.xz}, {root.xy, root.yy, root.yz}, {root.xz, root.yz, root.zz}};
        double xyz[18];
        for (int k = 0; k < 6; k++) {
            vec3 v = vec3_scale(columns[k % 3], k < 3 ? 1 : -1);
            xyz[3 * k] = v.x, xyz[3 * k + 1] = v.y, xyz[3 * k + 2] = v.z;
        }
        made octahedron = made_hull(xyz, 6);
        // Q = root root, of which root is the symmetric root.
        ovoid_ellipsoid e = {{0, 0, 0}, {0, 0, 0, 0, 0, 0}};
        for (int k = 0; k < 3; k++) e.q = sym3_add(e.q, sym3_outer(columns[k], 1));
        c = ovoid_polytope_compute_split(&octahedron.p, &e);
        CHECK_EQ(c.faces, 8);
        CHECK_EQ(c.pieces, 8);
        CHECK_EQ(c.triangles, 8);
        made_destroy(&octahedron);
    }
    // The paper's cylinders, 24 to 120 faces, which it reports as 59 to 212 after splitting.
    for (uint32_t k = 6; k <= 30; k += 24) {
        made cylinder = made_paper_cylinder(k);
        c = ovoid_polytope_compute_split(&cylinder.p, &inner);
        printf("cylinder of %u faces: %u pieces, %u triangles\n", c.faces, c.pieces, c.triangles);
        CHECK_EQ(c.faces, 4 * k);
        made_destroy(&cylinder);
    }
    made_destroy(&box);
    made_destroy(&sphere);
    made_destroy(&simplex);
}

/// Memory that fails at the k-th call, and counts what is out.
typedef struct failing {
    long calls, fail_at, live;
} failing;
static void *failing_allocate(void *context, size_t size) {
    failing *f = context;
    if (++f->calls == f->fail_at) return NULL;
    f->live++;
    return aligned_alloc(64, (size + 63) / 64 * 64);
}
static void failing_release(void *context, void *memory) {
    ((failing *)context)->live--;
    free(memory);
}

static void test_errors(subject *b) {
    ovoid_error e;
    const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    made flat = made_polygon(corners, 3);
    CHECK(!ovoid_areas_create(&flat.p, &b->ellipsoid, NULL, &e));
    CHECK(e.code == OVOID_ERROR_ARGUMENT && strstr(e.message, "rank 2"));
    made_destroy(&flat);
    const uint32_t bad[] = {0, 3, 65, 128};
    for (int i = 0; i < 4; i++)
        CHECK(!ovoid_areas_create(&b->body.p, &b->ellipsoid,
                                  &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = bad[i]}, &e) &&
              e.code == OVOID_ERROR_ARGUMENT);
    CHECK(!ovoid_areas_create(&b->body.p, &b->ellipsoid, &(ovoid_areas_options){.split = (ovoid_split)7, .k = 1}, &e));
    CHECK(!ovoid_areas_create(NULL, &b->ellipsoid, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 1}, &e) &&
          e.code == OVOID_ERROR_ARGUMENT);
    CHECK(!ovoid_areas_create(&b->body.p, NULL, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 1}, NULL));
    ovoid_ellipsoid outside = b->ellipsoid, thin = b->ellipsoid;
    outside.center.x += 100;
    CHECK(!ovoid_areas_create(&b->body.p, &outside, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 1}, &e));
    CHECK(e.code == OVOID_ERROR_ARGUMENT && e.place >= 0 && e.place < b->body.p.facet_count);
    thin.q = (sym3){1, 0, 0, 1, 0, 0};
    CHECK(!ovoid_areas_create(&b->body.p, &thin, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 1}, &e) &&
          strstr(e.message, "flat"));

    long calls = 1;
    for (long k = 1; k <= calls; k++) {
        failing f = {0, k, 0};
        ovoid_allocator allocator = {failing_allocate, failing_release, &f};
        ovoid_areas *areas =
            ovoid_areas_create(&b->body.p, &b->ellipsoid, &(ovoid_areas_options){OVOID_SPLIT_CUBE, 8, &allocator}, &e);
        if (!areas) {
            CHECK(e.code == OVOID_ERROR_MEMORY);
            calls = k + 1;
        }
        ovoid_areas_destroy(areas);
        CHECK_EQ(f.live, 0);
    }
    CHECK(calls > 15);
    ovoid_areas_destroy(NULL);
}

/// What finer cells bring, and what they cost: printed; a bound on the work, which does not depend on the machine.
static void test_large(void) {
    made sphere = made_sphere(50);
    subject b = subject_make("10 002 vertices", sphere, 0.9, mat3_diagonal(1, 2, 3), (vec3){0, 0, 0});
    for (uint32_t k = 1; k <= 64; k *= 4) {
        struct timespec start, end;
        timespec_get(&start, TIME_UTC);
        ovoid_areas *areas = ovoid_areas_create(&b.body.p, &b.ellipsoid,
                                                &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = k}, NULL);
        timespec_get(&end, TIME_UTC);
        if (!CHECK(areas != NULL)) return;
        double seconds = (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec);
        uint64_t s = 5, facets = 0, vertices = 0;
        for (int i = 0; i < 2000; i++) {
            vec3 u = {random_normal(&s), random_normal(&s), random_normal(&s)};
            uint32_t touched;
            facets += ovoid_areas_find_exit(areas, u, u, OVOID_RULE_RAY).touched;
            ovoid_areas_find_support(areas, u, &touched);
            vertices += touched;
        }
        printf("10 002 vertices, 20 000 facets, k = %u: made in %.3f s, %.1f MB; a ray looks at %.1f facets, a support "
               "at %.1f vertices\n",
               k, seconds, (double)ovoid_areas_get_counts(areas).bytes * 1e-6, (double)facets / 2000,
               (double)vertices / 2000);
        // Its share of the sphere, and as much again on each side of the cell.
        CHECK_LE((double)facets / 2000, 9 * (20000.0 / (6 * k * k) + 4));
        CHECK_LE((double)vertices / 2000, 9 * (10002.0 / (6 * k * k) + 4));
        ovoid_areas_destroy(areas);
    }
    made_destroy(&b.body);
}

int main(void) {
    subject subjects[SUBJECT_COUNT];
    subjects_make(subjects);
    test_closed_form();
    test_soundness(subjects);
    test_exit_is_on_surface(subjects);
    test_paper_rule_is_unsound();
    test_claims();
    test_split();
    test_errors(&subjects[4]);
    test_large();
    for (int i = 0; i < SUBJECT_COUNT; i++) made_destroy(&subjects[i].body);
    return check_end();
}
