// Boxes in closed form against the general way, which a box takes that is not centred: its corners are those of the
// centred one, moved by a power of two that keeps them exact. The tables must be the same numbers; the ellipsoids must
// pass the general proofs where they are moved with the body; the volumes are closed forms themselves.
#include "base/allocator.h"
#include "check.h"
#include "ellipsoid/contain.h"
#include "linear/rotation.h"
#include "polytope/centered_box.h"
#include "polytope/hull.h"
#include "shape/block.h"
#include "shape/loops.h"
#include "shape_files.h"

#include <string.h>

static ovoid_allocator allocator;

// Half sizes on a grid, so that corners moved by powers of two are exact.
static vec3 make_half(uint64_t *s) {
    double size[3];
    for (int k = 0; k < 3; k++)
        size[k] = ldexp((double)(1 + random_next(s) % 1024), random_next(s) % 4 ? -10 : -(int)(random_next(s) % 18));
    return (vec3){size[0], size[1], size[2]};
}

// The corners, moved.
static void fill_corners(vec3 half, double by, double xyz[24]) {
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = (i & 1 ? half.x : -half.x) + by;
        xyz[3 * i + 1] = (i & 2 ? half.y : -half.y) + by;
        xyz[3 * i + 2] = (i & 4 ? half.z : -half.z) + by;
    }
}

// The neighbors are the ends of the triangles' edges, ascending, and every plane holds the corners of its triangles.
static void check_triangles(const ovoid_polytope *p) {
    int joined[8][8] = {{0}};
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        const uint32_t *i = p->triangles + 3 * (size_t)t;
        const ovoid_plane *plane = &p->planes[p->triangle_facets[t]];
        for (int k = 0; k < 3; k++) {
            CHECK(!joined[i[k]][i[(k + 1) % 3]]);
            joined[i[k]][i[(k + 1) % 3]] = 1;
            CHECK_EQ(vec3_dot(plane->normal, vec3_at(p->vertices, i[k])), plane->offset);
        }
        vec3 a = vec3_at(p->vertices, i[0]), b = vec3_at(p->vertices, i[1]), c = vec3_at(p->vertices, i[2]);
        CHECK(vec3_dot(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), plane->normal) > 0);
    }
    for (uint32_t v = 0, at = 0; v < 8; v++) {
        CHECK_EQ(p->neighbor_starts[v], at);
        for (uint32_t w = 0; w < 8; w++) {
            CHECK_EQ(joined[v][w], joined[w][v]);
            if (joined[v][w]) CHECK_EQ(p->neighbors[at++], w);
        }
        CHECK_EQ(p->neighbor_starts[v + 1], at);
    }
}

// The block of the same triangles, moved: its tables are made in the general way.
static void check_tables(const ovoid_shape *box, vec3 half) {
    double moved[24];
    fill_corners(half, 2, moved);
    ovoid_shape *general = fill_in_general(box, moved);
    size_t edges = BOX_NEIGHBORS * sizeof(uint32_t), corners = edges + sizeof(uint32_t);
    CHECK(memcmp(shape_edge_tails(box), shape_edge_tails(general), edges) == 0);
    CHECK(memcmp(shape_edge_facets(box), shape_edge_facets(general), edges) == 0);
    CHECK(memcmp(shape_loop_starts(box), shape_loop_starts(general), (BOX_FACETS + 1) * sizeof(uint32_t)) == 0);
    CHECK(memcmp(shape_loop_vertices(box), shape_loop_vertices(general), corners) == 0);
    CHECK(memcmp(shape_loop_edges(box), shape_loop_edges(general), corners) == 0);
    // The measures are sums of a dozen terms of the body's size; the volume's share of an axis may be 2^-18.
    const ovoid_measures *a = &box->measures, *b = &general->measures;
    CHECK_NEAR(a->volume, b->volume, 1e-9 * a->volume);
    CHECK_NEAR(a->area, b->area, 1e-13 * a->area);
    double size = a->inertia.xx + a->inertia.yy + a->inertia.zz;
    CHECK_NEAR(a->inertia.xx, b->inertia.xx, 1e-9 * size);
    CHECK_NEAR(a->inertia.yy, b->inertia.yy, 1e-9 * size);
    CHECK_NEAR(a->inertia.zz, b->inertia.zz, 1e-9 * size);
    CHECK_EQ(vec3_max_abs(a->centroid), 0);
    CHECK_LE(b->sphere_radius * (1 - 1e-9), a->sphere_radius);
    CHECK_LE(a->sphere_radius, vec3_norm(half) * (1 + 1e-15));
    CHECK_EQ(vec3_max_abs(vec3_sub(a->box.max, half)), 0);
    CHECK_EQ(vec3_max_abs(vec3_add(a->box.min, half)), 0);
    CHECK(general->box.is_present && general->box.is_right && box->box.is_right);
    CHECK(memcmp(box->box.corner, general->box.corner, 8) == 0);
    for (int k = 0; k < 3; k++) CHECK_EQ(vec3_max_abs(vec3_sub(box->box.axis[k], general->box.axis[k])), 0);
    CHECK_EQ(vec3_max_abs(box->box.center), 0);
    ovoid_shape_destroy(general);
}

// The general proofs of a moved body take the moved ellipsoids, and the volumes are 4 pi sqrt(3) abc and 4/3 pi abc.
static void check_fits(const ovoid_shape *box, vec3 half) {
    ovoid_polytope p = ovoid_shape_get_polytope(box);
    double moved[24];
    ovoid_plane planes[BOX_FACETS];
    fill_corners(half, 2, moved);
    memcpy(planes, p.planes, sizeof planes);
    for (int f = 0; f < BOX_FACETS; f++)
        planes[f].offset += 2 * (planes[f].normal.x + planes[f].normal.y + planes[f].normal.z);
    p.vertices = moved;
    p.planes = planes;
    ovoid_fit outer = ovoid_shape_get_outer(box), inner = ovoid_shape_get_inner(box);
    double volume = 4.1887902047863905 * half.x * half.y * half.z;
    CHECK(outer.converged && inner.converged);
    CHECK_NEAR(outer.volume, volume * 3 * sqrt(3), 0x1p-45 * outer.volume);
    CHECK_NEAR(inner.volume, volume, 0x1p-45 * volume);
    CHECK_EQ(outer.gap, 0x1p-45);
    CHECK_EQ(inner.gap, 0x1p-45);
    CHECK(ellipsoid_is_enclosing(&p, &(ovoid_ellipsoid){{2, 2, 2}, outer.ellipsoid.q}));
    CHECK(ellipsoid_is_enclosed(&p, &(ovoid_ellipsoid){{2, 2, 2}, inner.ellipsoid.q}));
    // W maps the inner ellipsoid to the unit ball.
    const double *w = box->inside.w, radius[3] = {half.x, half.y, half.z};
    for (int k = 0, at = 0; k < 3; at += k + 2, k++) CHECK_NEAR(w[at] * radius[k], 1, 1e-13);
    CHECK(w[1] == 0 && w[3] == 0 && w[4] == 0);
}

// What ellipsoids of a box are refused: those a rounding too large, those off the centre, and tilted ones.
static void check_refused(const ovoid_shape *box, vec3 half) {
    ovoid_polytope p = ovoid_shape_get_polytope(box);
    ovoid_ellipsoid e = {{0, 0, 0}, sym3_diagonal(half.x * half.x, half.y * half.y, half.z * half.z)};
    e.q = sym3_scale(e.q, 1 - 0x1p-50);
    CHECK(ellipsoid_is_enclosed(&p, &e));
    ovoid_ellipsoid bad = e;
    bad.q.xx *= 1 + 0x1p-49;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.yy *= 1 + 0x1p-49;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.zz *= 1 + 0x1p-49;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.center.z = 0x1p-40 * half.z;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.xz = 2 * half.x * half.z;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.xx = -bad.q.xx;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.yy = NAN;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
}

// Points and files take the same way, bit for bit.
static void check_ways(const ovoid_shape *box, vec3 half) {
    double xyz[24];
    fill_corners(half, 0, xyz);
    ovoid_shape *made = ovoid_shape_create_from_points(xyz, 8, NULL, NULL);
    char bytes[1024];
    size_t size = ovoid_shape_write(box, bytes, sizeof bytes);
    ovoid_shape *read = ovoid_shape_read(bytes, size, NULL, NULL);
    shape_files_check_same(made, box);
    shape_files_check_same(read, box);
    ovoid_shape_destroy(made);
    ovoid_shape_destroy(read);
}

// Bodies that are nearly such boxes.
static void check_found(void) {
    double xyz[24];
    vec3 half, given = {1, 2, 3};
    fill_corners(given, 0, xyz);
    CHECK(centered_box_find(xyz, 8, &half) && vec3_max_abs(vec3_sub(half, given)) == 0);
    CHECK(!centered_box_find(xyz, 7, &half));
    for (int i = 0; i < 24; i++) {
        double kept = xyz[i];
        xyz[i] = nextafter(kept, INFINITY);
        CHECK(!centered_box_find(xyz, 8, &half));
        xyz[i] = -kept;
        CHECK(!centered_box_find(xyz, 8, &half));
        xyz[i] = NAN;
        CHECK(!centered_box_find(xyz, 8, &half));
        xyz[i] = kept;
    }
    const struct {
        vec3 half;
        int found;
    } cases[] = {
        {{1, 1, 0}, 0},
        {{0x1p-18, 1, 1}, 1},
        {{0x1p-19, 1, 1}, 0},
        {{1e50, 1e50, 1e50}, 1},
        {{2e50, 2e50, 2e50}, 0},
        {{1, INFINITY, 1}, 0},
        {{0x1p-200, 0x1p-200, 0x1p-200}, 1},
        {{1e-70, 1e-70, 1e-70}, 0},
        {{-1, -1, -1}, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fill_corners(cases[i].half, 0, xyz);
        CHECK_EQ(centered_box_find(xyz, 8, &half), cases[i].found);
    }
}

int main(void) {
    allocator = allocator_make(NULL);
    check_found();
    for (uint64_t i = 0; i < 3000; i++) {
        uint64_t s = check_seed = 1 + i;
        vec3 half = make_half(&s), found;
        double xyz[24];
        fill_corners(half, 0, xyz);
        if (!centered_box_find(xyz, 8, &found)) continue;
        ovoid_shape *box = ovoid_shape_create_box(half, NULL, NULL);
        CHECK(box != NULL);
        ovoid_polytope p = ovoid_shape_get_polytope(box);
        CHECK_EQ(p.facet_count, BOX_FACETS);
        check_triangles(&p);
        check_tables(box, half);
        check_fits(box, half);
        check_refused(box, half);
        check_ways(box, half);
        ovoid_shape_destroy(box);
    }
    return check_end();
}
