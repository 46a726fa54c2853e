// What triangles are: the hull of their points exactly, nearly, or not; closed or open. Truth: closed forms of boxes,
// plates with windows and dents; for random bodies the winding number at points of the body that the allowance
// promises, and supports, each of which may be nowhere lower by more than the allowance.
#include "failing.h"
#include "solids.h"

static uint64_t seed = 1;
static int random_int(int low, int high) { return low + (int)(random_next(&seed) % (uint64_t)(high - low + 1)); }
static double random_double(double low, double high) { return random_uniform(&seed, low, high); }

static const double corners[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const uint32_t cube[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                  1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

/// Triangles under construction.
typedef struct soup {
    double xyz[3 * 4000];
    uint32_t indices[3 * 8000];
    size_t points, count;
} soup;

static ovoid_hull_match match(const double *xyz, size_t points, const uint32_t *indices, size_t count) {
    ovoid_hull_match m = {0, 0, 0, 0};
    const ovoid_triangles triangles = {xyz, points, indices, count};
    ovoid_shape *hull = ovoid_shape_create_from_points(xyz, points, NULL, NULL);
    CHECK_EQ(ovoid_triangles_compute_hull_match(&triangles, hull, &m, NULL), OVOID_OK);
    ovoid_shape_destroy(hull);
    return m;
}

static ovoid_hull_match match_soup(const soup *s) { return match(s->xyz, s->points, s->indices, s->count); }

static uint32_t add_point(soup *s, double x, double y, double z) {
    const double p[3] = {x, y, z};
    memcpy(s->xyz + 3 * s->points, p, sizeof p);
    return (uint32_t)s->points++;
}

static void add_triangle(soup *s, uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t t[3] = {a, b, c};
    memcpy(s->indices + 3 * s->count++, t, sizeof t);
}

// ---- closed or open

static void check_edges(void) {
    static soup s;
    memcpy(s.xyz, corners, sizeof corners);
    memcpy(s.indices, cube, sizeof cube);
    s.points = 8, s.count = 12;
    ovoid_hull_match m = match_soup(&s);
    CHECK(m.is_closed && m.is_hull && m.allowance == 0 && m.edges_unmatched == 0);
    // Triangles without area, loose or not, open nothing: two equal corners, three on a line, all three equal.
    add_point(&s, 0.25, 0, 0);
    add_triangle(&s, 0, 8, 1);
    add_triangle(&s, 3, 3, 5);
    add_triangle(&s, 6, 6, 6);
    m = match_soup(&s);
    CHECK(m.is_closed && m.is_hull && m.allowance == 0);
    // One with area does.
    add_triangle(&s, 0, 8, 5);
    m = match_soup(&s);
    CHECK(!m.is_closed && !m.is_hull);
    CHECK_EQ(m.edges_unmatched, 3);
    // Without the lid four edges are open.
    m = match(corners, 8, cube, 10);
    CHECK_EQ(m.edges_unmatched, 4);
    CHECK(!m.is_closed);
}

// A corner on a neighbor's edge, with the sliver that closes it and without. `off` the line it opens.
static void check_corner_on_edge(void) {
    for (int kind = 0; kind < 3; kind++) {
        static soup s;
        s.points = s.count = 0;
        for (int i = 0; i < 8; i++) add_point(&s, corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]);
        uint32_t middle = add_point(&s, 0.375, 0, kind == 2 ? -0x1p-44 : 0);
        for (size_t t = 0; t < 12; t++) {
            const uint32_t *c = cube + 3 * t;
            if (t == 4) {
                add_triangle(&s, 0, middle, 5);
                add_triangle(&s, middle, 1, 5);
            } else {
                add_triangle(&s, c[0], c[1], c[2]);
            }
        }
        if (kind == 1) add_triangle(&s, 0, 1, middle);
        ovoid_hull_match m = match_soup(&s);
        CHECK_EQ(m.is_closed, kind < 2);
        if (kind < 2) CHECK(m.is_hull && m.allowance == 0);
    }
}

// Many corners on one edge, cut differently on either side, in a direction that is no axis.
static void check_cut_line(void) {
    static soup s;
    for (int trial = 0; trial < 200; trial++) {
        s.points = s.count = 0;
        const double at[3] = {random_int(-9, 9), random_int(-9, 9), random_int(-9, 9)};
        const double to[3] = {random_int(-9, 9), random_int(-9, 9), random_int(1, 9)};
        uint32_t line[32], above = add_point(&s, 100, 3, 1), below = add_point(&s, 5, -100, 2);
        for (int i = 0; i < 32; i++) line[i] = add_point(&s, at[0] + i * to[0], at[1] + i * to[1], at[2] + i * to[2]);
        uint32_t ends[2][3] = {{line[0], line[31], above}, {line[31], line[0], below}};
        for (int side = 0; side < 2; side++) {
            int from = 0;
            while (from < 31) {
                int next = from + random_int(1, 31);
                if (next > 31) next = 31;
                add_triangle(&s, side ? line[next] : line[from], side ? line[from] : line[next], ends[side][2]);
                from = next;
            }
            // The fan's two other sides are closed by one triangle each way to a third point.
        }
        add_triangle(&s, line[31], below, above);
        add_triangle(&s, line[0], above, below);
        CHECK(match_soup(&s).is_closed);
        // A piece turned over opens it.
        uint32_t kept = s.indices[0];
        s.indices[0] = s.indices[1], s.indices[1] = kept;
        CHECK(!match_soup(&s).is_closed);
    }
}

// ---- bodies that are not their hulls

static void add_box(soup *s, const double low[3], const double high[3], int turned) {
    uint32_t first = (uint32_t)s->points;
    for (int i = 0; i < 8; i++)
        add_point(s, corners[3 * i] > 0 ? high[0] : low[0], corners[3 * i + 1] > 0 ? high[1] : low[1],
                  corners[3 * i + 2] > 0 ? high[2] : low[2]);
    for (size_t t = 0; t < 12; t++)
        add_triangle(s, first + cube[3 * t], first + cube[3 * t + (turned ? 2 : 1)],
                     first + cube[3 * t + (turned ? 1 : 2)]);
}

// A plate of 2 a x 2 a x 2 h with a square hole of 2 b, at a place.
static void make_window(soup *s, const double at[3], double a, double b, double h) {
    s->points = s->count = 0;
    for (int z = 0; z < 2; z++)
        for (int ring = 0; ring < 2; ring++)
            for (int i = 0; i < 4; i++) {
                double r = ring ? b : a;
                add_point(s, at[0] + (i == 1 || i == 2 ? r : -r), at[1] + (i >= 2 ? r : -r), at[2] + (z ? h : -h));
            }
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t j = (i + 1) % 4;
        const uint32_t quads[4][4] = {
            {i, j, 8 + j, 8 + i}, {4 + j, 4 + i, 12 + i, 12 + j}, {j, i, 4 + i, 4 + j}, {8 + i, 8 + j, 12 + j, 12 + i}};
        for (int q = 0; q < 4; q++) {
            add_triangle(s, quads[q][0], quads[q][1], quads[q][2]);
            add_triangle(s, quads[q][0], quads[q][2], quads[q][3]);
        }
    }
}

static void check_windows(void) {
    static soup s;
    const double zero[3] = {0, 0, 0}, far[3] = {10000, 10000, 10000.3};
    for (int size = 0; size < 12; size++) {
        make_window(&s, zero, 500, 500 * pow(0.2, size), 0.5);
        ovoid_hull_match m = match_soup(&s);
        CHECK(m.is_closed && !m.is_hull);
    }
    make_window(&s, far, 10, 0.5, 1);
    CHECK(match_soup(&s).is_closed && !match_soup(&s).is_hull);
    // Shells in shells of one orientation, one beside another, the same twice: only the last is its hull.
    const double one[3] = {1, 1, 1}, two[3] = {2, 2, 2}, three[3] = {3, 3, 3};
    for (int kind = 0; kind < 4; kind++) {
        s.points = s.count = 0;
        add_box(&s, zero, three, 0);
        if (kind == 0) add_box(&s, one, two, 0);
        if (kind == 1) add_box(&s, one, two, 1);
        if (kind == 2) add_box(&s, zero, three, 1);
        if (kind == 3) add_box(&s, zero, three, 0);
        ovoid_hull_match m = match_soup(&s);
        CHECK(m.is_closed);
        CHECK_EQ(m.is_hull, kind == 3); // of kind 2 the copies cancel: it winds around nothing
    }
    // A sheet there and back has no inside.
    static const uint32_t sheet[6] = {0, 1, 2, 0, 2, 1};
    CHECK(match(corners, 3, sheet, 2).is_closed && !match(corners, 3, sheet, 2).is_hull);
}

// ---- nearly hulls

static double get_support(const soup *s, const double n[3]) {
    double most = -INFINITY;
    for (size_t i = 0; i < s->points; i++)
        most = fmax(most, n[0] * s->xyz[3 * i] + n[1] * s->xyz[3 * i + 1] + n[2] * s->xyz[3 * i + 2]);
    return most;
}

// Points of K = c + (1 - l) (H - c) with l max |v - c| = w lie in the body: each is wound around.
static void check_core(const soup *s, double allowance) {
    ovoid_shape *hull = ovoid_shape_create_from_points(s->xyz, s->points, NULL, NULL);
    ovoid_solid *solid =
        ovoid_solid_create_from_triangles(&(ovoid_triangles){s->xyz, s->points, s->indices, s->count}, NULL, NULL);
    ovoid_polytope p = ovoid_shape_get_polytope(hull);
    ovoid_vec3 c = ovoid_shape_get_measures(hull).centroid;
    double reach = 0;
    for (uint32_t v = 0; v < p.vertex_count; v++)
        reach = fmax(reach,
                     hypot(hypot(p.vertices[3 * v] - c.x, p.vertices[3 * v + 1] - c.y), p.vertices[3 * v + 2] - c.z));
    double l = allowance / reach * (1 + 1e-9) + 1e-12;
    for (int i = 0; i < 60; i++) {
        // A point of a triangle of the hull, drawn toward c.
        const uint32_t *t = p.triangles + 3 * (size_t)random_int(0, (int)p.triangle_count - 1);
        double u = random_double(0, 1), v = random_double(0, 1 - u), x[3], center[3] = {c.x, c.y, c.z};
        const double origin[3] = {p.origin.x, p.origin.y, p.origin.z};
        for (int k = 0; k < 3; k++) {
            double on = p.vertices[3 * t[0] + (uint32_t)k] * (1 - u - v) + p.vertices[3 * t[1] + (uint32_t)k] * u +
                        p.vertices[3 * t[2] + (uint32_t)k] * v;
            x[k] = origin[k] + center[k] + (1 - l) * (on - center[k]);
        }
        int64_t winding = 0;
        int is_known = ovoid_solid_compute_winding(solid, (ovoid_vec3){x[0], x[1], x[2]}, &winding);
        CHECK(!is_known || winding != 0);
    }
    ovoid_solid_destroy(solid);
    ovoid_shape_destroy(hull);
}

// A box whose faces are grids, turned, its points rounded to single precision or moved by `noise`.
static void make_grid_box(soup *s, int cells, double noise, int single) {
    const ovoid_pose turn = {{0, 0, 0}, random_quat(&seed)};
    double size[3] = {random_double(0.5, 1), random_double(0.5, 1), random_double(0.2, 1)};
    s->points = s->count = 0;
    for (int face = 0; face < 6; face++) {
        uint32_t first = (uint32_t)s->points;
        for (int i = 0; i <= cells; i++)
            for (int j = 0; j <= cells; j++) {
                int axis = face / 2;
                double local[3];
                local[axis] = face % 2 ? size[axis] : -size[axis];
                local[(axis + 1) % 3] = size[(axis + 1) % 3] * (2.0 * (face % 2 ? i : cells - i) / cells - 1);
                local[(axis + 2) % 3] = size[(axis + 2) % 3] * (2.0 * j / cells - 1);
                ovoid_vec3 x = ovoid_pose_compute_point(&turn, (ovoid_vec3){local[0], local[1], local[2]});
                // The same point of two faces must move equally: noise from its place.
                double shift = noise * sin(1e4 * local[0] + 7e4 * local[1] + 3e4 * local[2]);
                add_point(s, x.x + shift, x.y - shift, x.z + shift);
            }
        for (int i = 0; i < cells; i++)
            for (int j = 0; j < cells; j++) {
                uint32_t a = first + (uint32_t)(i * (cells + 1) + j), b = a + (uint32_t)cells + 1;
                add_triangle(s, a, b, b + 1);
                add_triangle(s, a, b + 1, a + 1);
            }
    }
    for (size_t i = 0; i < 3 * s->points && single; i++) s->xyz[i] = (double)(float)s->xyz[i];
}

// Boxes rounded to single precision are hulls, with an allowance that holds; moved by more they are not.
static void check_rounded(void) {
    static soup s;
    int hulls = 0, exact = 0;
    for (int trial = 0; trial < 150; trial++) {
        make_grid_box(&s, random_int(1, 6), 0, 1);
        ovoid_hull_match m = match_soup(&s);
        CHECK(m.is_closed);
        hulls += m.is_hull;
        exact += m.is_hull && m.allowance == 0;
        if (!m.is_hull) continue;
        CHECK(m.allowance >= 0 && m.allowance < 1e-5);
        check_core(&s, m.allowance);
        make_grid_box(&s, 4, 1e-2, 0);
        m = match_soup(&s);
        CHECK(m.is_closed);
        CHECK(!m.is_hull);
    }
    printf("boxes in single precision: %d of 150 are hulls, %d of them exactly\n", hulls, exact);
    CHECK(hulls >= 140);
}

// A slot that is as thin as one likes is none of the hull: a wedge to the middle of a box, 1e-9 wide at the top.
static void check_slot(void) {
    static soup s;
    for (int digits = 3; digits < 14; digits++) {
        double w = pow(10, -digits);
        s.points = s.count = 0;
        // The outline in x and z, extruded along y.
        const double outline[7][2] = {{0, 0}, {2, 0}, {2, 1}, {1 + w, 1}, {1, 0.5}, {1 - w, 1}, {0, 1}};
        for (int y = 0; y < 2; y++)
            for (int i = 0; i < 7; i++) add_point(&s, outline[i][0], y, outline[i][1]);
        static const uint32_t cap[5][3] = {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}};
        for (int i = 0; i < 5; i++) {
            add_triangle(&s, cap[i][0], cap[i][1], cap[i][2]);
            add_triangle(&s, 7 + cap[i][0], 7 + cap[i][2], 7 + cap[i][1]);
        }
        for (uint32_t i = 0; i < 7; i++) {
            uint32_t j = (i + 1) % 7;
            add_triangle(&s, j, i, 7 + i);
            add_triangle(&s, j, 7 + i, 7 + j);
        }
        ovoid_hull_match m = match_soup(&s);
        CHECK(m.is_closed && !m.is_hull);
    }
}

// Hulls of random points, their triangles in any orientation and order, with noise in the last bits: hulls exactly, or
// nearly with supports that the allowance covers; one vertex pulled inward: no hull.
static void check_random(void) {
    static soup s, moved;
    for (int trial = 0; trial < 300; trial++) {
        double xyz[3 * 40];
        int count = random_int(8, 40);
        for (int i = 0; i < 3 * count; i++) xyz[i] = random_double(-1, 1) * (trial % 3 == 0 && i % 3 == 2 ? 1e-2 : 1);
        ovoid_shape *hull = ovoid_shape_create_from_points(xyz, (size_t)count, NULL, NULL);
        ovoid_polytope p = ovoid_shape_get_polytope(hull);
        s.points = s.count = 0;
        for (uint32_t v = 0; v < p.vertex_count; v++)
            add_point(&s, p.vertices[3 * v], p.vertices[3 * v + 1], p.vertices[3 * v + 2]);
        int turned = random_int(0, 1);
        for (uint32_t t = 0; t < p.triangle_count; t++)
            add_triangle(&s, p.triangles[3 * t], p.triangles[3 * t + (turned ? 2 : 1)],
                         p.triangles[3 * t + (turned ? 1 : 2)]);
        ovoid_shape_destroy(hull);
        ovoid_hull_match m = match_soup(&s);
        CHECK(m.is_closed && m.is_hull && m.allowance == 0);
        moved = s;
        for (size_t i = 0; i < 3 * s.points; i++) moved.xyz[i] *= 1 + random_double(-1, 1) * 1e-9;
        m = match_soup(&moved);
        CHECK(m.is_closed);
        if (m.is_hull) check_core(&moved, m.allowance);
        // Pulled to half its distance from the middle, a vertex is in the hull of the others, or leaves a dent.
        moved = s;
        uint32_t v = (uint32_t)random_int(0, (int)s.points - 1);
        const double n[3] = {s.xyz[3 * v], s.xyz[3 * v + 1], s.xyz[3 * v + 2]};
        for (int k = 0; k < 3; k++) moved.xyz[3 * v + (uint32_t)k] *= 0.01;
        m = match_soup(&moved);
        hull = ovoid_shape_create_from_points(moved.xyz, moved.points, NULL, NULL);
        int is_inside = ovoid_shape_get_report(hull).vertices + 1 == moved.points;
        ovoid_shape_destroy(hull);
        if (is_inside && get_support(&moved, n) < get_support(&s, n) - 1e-3) CHECK(!m.is_hull);
    }
}

static void check_refusals(void) {
    ovoid_hull_match m;
    ovoid_error error;
    const ovoid_triangles good = {corners, 8, cube, 12}, bad = {corners, 7, cube, 12}, none = {corners, 8, cube, 0};
    ovoid_shape *hull = ovoid_shape_create_from_points(corners, 8, NULL, NULL);
    CHECK_EQ(ovoid_triangles_compute_hull_match(&good, NULL, &m, &error), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_triangles_compute_hull_match(&bad, hull, &m, &error), OVOID_ERROR_INDEX);
    CHECK_EQ(ovoid_triangles_compute_hull_match(&none, hull, &m, &error), OVOID_ERROR_EMPTY);
    // A point of the hull that no triangle has: they are not all of it.
    double more[27] = {0};
    memcpy(more, corners, sizeof corners);
    more[24] = 3;
    CHECK(!match(more, 9, cube, 12).is_hull && match(more, 9, cube, 12).is_closed);
    // The same hull with another allowance.
    ovoid_shape *allowed = ovoid_shape_create_allowed(
        hull, &(ovoid_shape_options){.allowance = (ovoid_allowance){.outside = 0, .inside = 0.125}}, &error);
    CHECK_EQ(ovoid_shape_get_allowance(allowed).inside, 0.125);
    CHECK_EQ(ovoid_shape_get_allowance(hull).inside, 0);
    CHECK(!ovoid_shape_create_allowed(
        hull, &(ovoid_shape_options){.allowance = (ovoid_allowance){.outside = 0, .inside = -1}}, &error));
    CHECK(!ovoid_shape_create_allowed(
        NULL, &(ovoid_shape_options){.allowance = (ovoid_allowance){.outside = 0, .inside = 1}}, &error));
    ovoid_shape_destroy(allowed);
    ovoid_shape_destroy(hull);
}

// ---- the gap between a solid and its hull

// The cube [-1, 1]^3 with a dent of that depth in the middle of its top.
static void make_dented(soup *s, double depth) {
    s->points = s->count = 0;
    for (int i = 0; i < 8; i++)
        add_point(s, 2 * corners[3 * i] - 1, 2 * corners[3 * i + 1] - 1, 2 * corners[3 * i + 2] - 1);
    uint32_t middle = add_point(s, 0, 0, 1 - depth);
    for (size_t t = 0; t < 12; t++)
        if (t != 2 && t != 3) add_triangle(s, cube[3 * t], cube[3 * t + 1], cube[3 * t + 2]);
    for (uint32_t i = 0; i < 4; i++) add_triangle(s, 4 + i, 4 + (i + 1) % 4, middle);
}

static ovoid_solid *create_solid(const soup *s, const ovoid_allocator *allocator) {
    return ovoid_solid_create_from_triangles(&(ovoid_triangles){s->xyz, s->points, s->indices, s->count},
                                             &(ovoid_solid_options){allocator}, NULL);
}

static double measure_gap(const ovoid_solid *solid, const ovoid_shape *hull) {
    double gap = NAN;
    CHECK_EQ(ovoid_solid_compute_hull_gap(solid, hull, &gap, NULL), OVOID_OK);
    return gap;
}

// No probe is farther from the solid than from its hull by more than the gap.
static void check_probes(const ovoid_solid *solid, const ovoid_shape *hull, double gap) {
    ovoid_shape *probes[] = {ovoid_shape_create_sphere(0, NULL, NULL), ovoid_shape_create_sphere(0.25, NULL, NULL),
                             ovoid_shape_create_box((ovoid_vec3){0.05, 0.05, 0.8}, NULL, NULL)};
    for (int i = 0; i < 300; i++) {
        const ovoid_shape *probe = probes[i % 3];
        ovoid_pose pose = ovoid_pose_make_identity();
        pose.position = (ovoid_vec3){random_double(-1, 1), random_double(-1, 1), random_double(0.5, 2)};
        if (i < 30) pose.position = (ovoid_vec3){0, 0, i % 3 == 2 ? 1.8 : i % 3 == 1 ? 1.25 : 1};
        const ovoid_pair hulls = {probe, hull, pose, ovoid_pose_make_identity()};
        const ovoid_body_pair bodies = {{.shape = probe, .pose = pose},
                                        {.solid = solid, .pose = ovoid_pose_make_identity()}};
        double least = ovoid_body_distance(&bodies, NULL, NULL).lower;
        double most = ovoid_depth(&hulls, NULL, NULL, NULL).upper + gap;
        if (!CHECK(least <= most)) printf("  probe %d: %.17g beyond %.17g\n", i, least, most);
    }
    for (size_t i = 0; i < sizeof probes / sizeof *probes; i++) ovoid_shape_destroy(probes[i]);
}

static void check_gaps(void) {
    static soup s;
    for (int i = 0; i < 12; i++) {
        double depth = i == 0 ? 0 : ldexp(1, -i - 1);
        make_dented(&s, depth);
        ovoid_solid *solid = create_solid(&s, NULL);
        ovoid_shape *hull = ovoid_shape_create_from_points(s.xyz, s.points, NULL, NULL);
        double gap = measure_gap(solid, hull);
        // All of the dent is at least 1 - depth from the centre, where the top is at 1; a corner is at the root of 3.
        CHECK_NEAR(gap, sqrt(3) * depth, 1e-12);
        CHECK(gap >= sqrt(3) * depth);
        check_probes(solid, hull, gap);
        // A hull with a radius is another body.
        ovoid_shape *rounded =
            ovoid_shape_create_from_points(s.xyz, s.points, &(ovoid_shape_options){.radius = 0.5}, NULL);
        CHECK_EQ(measure_gap(solid, rounded), INFINITY);
        ovoid_shape_destroy(rounded);
        ovoid_solid_destroy(solid);
        // Without one triangle it is a surface.
        s.count--;
        solid = create_solid(&s, NULL);
        CHECK_EQ(measure_gap(solid, hull), INFINITY);
        ovoid_solid_destroy(solid);
        ovoid_shape_destroy(hull);
    }
    // Nothing of half the hull's size about its centroid is in a body that is dented beyond that.
    make_dented(&s, 0.75);
    ovoid_solid *solid = create_solid(&s, NULL);
    ovoid_shape *hull = ovoid_shape_create_from_points(s.xyz, s.points, NULL, NULL);
    CHECK_EQ(measure_gap(solid, hull), INFINITY);
    ovoid_shape_destroy(hull);
    ovoid_solid_destroy(solid);
}

static soup dented;
static ovoid_shape *dented_hull;
static ovoid_solid *dented_solid;

static int match_dented(ovoid_error *error) {
    ovoid_hull_match m;
    const ovoid_triangles triangles = {dented.xyz, dented.points, dented.indices, dented.count};
    return ovoid_triangles_compute_hull_match(&triangles, dented_hull, &m, error) == OVOID_OK && m.is_closed &&
           !m.is_hull;
}

static int measure_dented(ovoid_error *error) {
    double gap;
    return ovoid_solid_compute_hull_gap(dented_solid, dented_hull, &gap, error) == OVOID_OK && gap < 1;
}

static void check_memory(void) {
    make_dented(&dented, 0.125);
    dented_hull = ovoid_shape_create_from_points(dented.xyz, dented.points, NULL, NULL);
    dented_solid = create_solid(&dented, NULL);
    check_operation("match", 0, match_dented);
    check_operation("gap", 0, measure_dented);
    ovoid_solid_destroy(dented_solid);
    ovoid_shape_destroy(dented_hull);
}

int main(void) {
    check_edges();
    check_corner_on_edge();
    check_cut_line();
    check_windows();
    check_rounded();
    check_slot();
    check_random();
    check_refusals();
    check_gaps();
    check_memory();
    return check_end();
}
