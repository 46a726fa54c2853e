// Regular prisms and pyramids in closed form against the general way, which such a body takes when it is moved along
// its axis by a power of two: then its corners are exact. The general tables of the same triangles must be the same
// numbers; the general proofs, of surfaces and of ellipsoids, must take what is written down; volumes are closed forms.
#include "base/allocator.h"
#include "check.h"
#include "ellipsoid/closed_fit.h"
#include "ellipsoid/contain.h"
#include "polytope/hull.h"
#include "shape/block.h"
#include "shape/file.h"
#include "shape/loops.h"
#include "shape_files.h"

#include <stdlib.h>
#include <string.h>

static ovoid_allocator allocator;

// A ring that begins at an angle, and its copy or an apex. Half lengths on a grid, so that heights moved by 2 are
// exact.
typedef struct body {
    double xyz[6 * 128];
    uint32_t sides, count;
    int is_prism;
    double radius, half_length;
} body;

static void fill_body(body *b, double angle) {
    uint32_t n = b->sides;
    b->count = b->is_prism ? 2 * n : n + 1;
    for (uint32_t i = 0; i < n; i++) {
        double turned = angle + 6.283185307179586 * i / n;
        for (uint32_t k = 0; k < 2; k++) {
            double *corner = b->xyz + 3 * (size_t)(i + k * n);
            if (k && !b->is_prism) continue;
            corner[0] = b->radius * cos(turned), corner[1] = b->radius * sin(turned);
            corner[2] = k ? b->half_length : -b->half_length;
        }
    }
    double *apex = b->xyz + 3 * (size_t)n;
    if (!b->is_prism) apex[0] = apex[1] = 0, apex[2] = b->half_length;
}

static body make_body(uint64_t *s) {
    body b = {.sides = 3 + (uint32_t)(random_next(s) % (random_next(s) % 4 ? 20 : 125)),
              .is_prism = random_next(s) % 2};
    b.radius = random_uniform(s, 0.1, 1) * (random_next(s) % 8 ? 1 : 0x1p-12);
    b.half_length = ldexp((double)(1 + random_next(s) % 1024), random_next(s) % 8 ? -10 : -18);
    fill_body(&b, random_next(s) % 2 ? random_uniform(s, -3, 3) : 0);
    return b;
}

static void lift_body(const body *b, double *moved) {
    for (uint32_t i = 0; i < 3 * b->count; i++) moved[i] = b->xyz[i] + (i % 3 == 2 ? b->half_length : 0);
}

// The claimed triangles are proven to be the hull in the general way, which finds their facets, planes and neighbors.
static void check_hull(const body *b, const ovoid_polytope *p) {
    double moved[6 * 128];
    lift_body(b, moved);
    surface_claim claim = {moved, b->count, p->triangles, p->triangle_count, {0, 0, b->half_length / 2}};
    surface_flaw flaw;
    hull general;
    CHECK_EQ(hull_create_proven(&claim, &allocator, &general, &flaw), OVOID_OK);
    CHECK_EQ(general.form.kind, FORM_NONE);
    CHECK_EQ(general.facet_count, p->facet_count);
    size_t starts = sizeof(uint32_t) * (b->count + 1), neighbors = sizeof(uint32_t) * p->neighbor_starts[b->count];
    CHECK(memcmp(general.neighbor_starts, p->neighbor_starts, starts) == 0);
    CHECK(memcmp(general.neighbors, p->neighbors, neighbors) == 0);
    // Facets come in another order; the normal of a narrow side is off by the rounding of its corners over its width.
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        ovoid_plane plane = p->planes[p->triangle_facets[t]], other = general.planes[general.triangle_facets[t]];
        double heights = fabs(plane.offset + b->half_length * plane.normal.z - other.offset);
        CHECK_LE(vec3_norm(vec3_sub(plane.normal, other.normal)), 1e-13);
        CHECK_LE(heights, 1e-12);
        for (uint32_t k = 0; k < 3; k++) {
            vec3 v = vec3_at(p->vertices, p->triangles[3 * (size_t)t + k]);
            CHECK_NEAR(vec3_dot(plane.normal, v), plane.offset, 4e-16);
        }
    }
    hull_destroy(&general, &allocator);
}

// Claims about the body where its form is found: of its own triangles, of others that are right too, and of wrong ones.
static void check_claims(const body *b, const ovoid_polytope *p) {
    uint32_t triangles[3 * 512];
    surface_claim claim = {b->xyz, b->count, triangles, p->triangle_count, {0, 0, -b->half_length / 2}};
    surface_flaw flaw;
    hull found;
    memcpy(triangles, p->triangles, 3 * sizeof *triangles * p->triangle_count);
    CHECK_EQ(hull_create_proven(&claim, &allocator, &found, &flaw), OVOID_OK);
    CHECK_EQ(found.form.kind, FORM_REGULAR);
    hull_destroy(&found, &allocator);
    const uint32_t first[3] = {triangles[0], triangles[1], triangles[2]};
    memcpy(triangles, (uint32_t[]){first[1], first[2], first[0]}, sizeof first);
    CHECK_EQ(hull_create_proven(&claim, &allocator, &found, &flaw), OVOID_OK);
    CHECK_EQ(found.form.kind, FORM_NONE);
    CHECK(memcmp(found.triangles, triangles, sizeof first) == 0);
    hull_destroy(&found, &allocator);
    memcpy(triangles, (uint32_t[]){first[1], first[0], first[2]}, sizeof first);
    CHECK_EQ(hull_create_proven(&claim, &allocator, &found, &flaw), OVOID_ERROR_HULL);
}

// The block of the same arrays whose tables are made in the general way, and measures that are sums over triangles.
static void check_tables(const body *b, const ovoid_shape *shape) {
    double moved[6 * 128];
    lift_body(b, moved);
    ovoid_shape *general = fill_in_general(shape, moved);
    size_t from = shape->at.edge_tails;
    CHECK(memcmp((const char *)shape + from, (const char *)general + from, shape->at.size - from) == 0);
    // The error of a regular polygon is that of the middle of its area and of its main directions.
    const ovoid_measures *a = &shape->measures, *m = &general->measures;
    double size = a->inertia.xx + a->inertia.zz;
    CHECK_NEAR(a->volume, m->volume, 1e-12 * a->volume);
    CHECK_NEAR(a->area, m->area, 1e-12 * a->area);
    CHECK_NEAR(a->inertia.xx, m->inertia.xx, 1e-11 * size);
    CHECK_NEAR(a->inertia.yy, m->inertia.yy, 1e-11 * size);
    CHECK_NEAR(a->inertia.zz, m->inertia.zz, 1e-11 * size);
    CHECK(a->inertia.xy == 0 && a->inertia.xz == 0 && a->inertia.yz == 0);
    CHECK_LE(vec3_norm(vec3_sub(vec3_add(a->centroid, (vec3){0, 0, b->half_length}), m->centroid)), 1e-12);
    CHECK_NEAR(a->sphere_radius, m->sphere_radius, 1e-9 * m->sphere_radius);
    CHECK_EQ(a->box.min.x, m->box.min.x);
    CHECK_EQ(a->box.max.y, m->box.max.y);
    CHECK_EQ(a->box.max.z + b->half_length, m->box.max.z);
    CHECK_EQ(shape->box.is_present, general->box.is_present);
    ovoid_shape_destroy(general);
}

// The general proofs take the ellipsoids, moved with the body so that no form is found. The volumes are 4/3 pi times
// the half axes of closed_fit.c, with the radii of a perfect polygon.
static void check_fits(const body *b, const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_plane planes[130];
    double moved[6 * 128], n = b->sides, h = b->half_length, apothem = b->radius * cos(3.141592653589793 / n);
    lift_body(b, moved);
    for (uint32_t f = 0; f < p.facet_count; f++) {
        planes[f] = p.planes[f];
        planes[f].offset += h * planes[f].normal.z;
    }
    p.vertices = moved, p.planes = planes;
    ovoid_fit outer = ovoid_shape_get_outer(shape), inner = ovoid_shape_get_inner(shape);
    double unit = 4.1887902047863905, most = n * 0x1p-39 + 0x1p-45;
    double volume = unit * b->radius * b->radius * h * (b->is_prism ? 1.5 * sqrt(3) : 1.125 * 1.5);
    CHECK(outer.converged && inner.converged);
    CHECK_EQ(outer.gap, most);
    CHECK_EQ(inner.gap, most);
    CHECK_NEAR(outer.volume, volume, most * volume);
    volume = unit * apothem * apothem * h * (b->is_prism ? 1 : 0.25);
    CHECK_NEAR(inner.volume, volume, most * volume);
    outer.ellipsoid.center.z += h, inner.ellipsoid.center.z += h;
    CHECK(ellipsoid_is_enclosing(&p, &outer.ellipsoid));
    CHECK(ellipsoid_is_enclosed(&p, &inner.ellipsoid));
    // The weights of closed_fit.c's body have this ellipsoid as their bound: none that encloses is smaller than by the
    // gap.
    outer.ellipsoid.q = sym3_scale(outer.ellipsoid.q, 1 - most);
    CHECK(!ellipsoid_is_enclosing(&p, &outer.ellipsoid));
    inner.ellipsoid.q = sym3_scale(inner.ellipsoid.q, 1 + most);
    CHECK(!ellipsoid_is_enclosed(&p, &inner.ellipsoid));
}

// What the shortcut refuses: an ellipsoid that is too large by more than the ring's error, off its place, or tilted.
static void check_refused(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    closed_form form = closed_form_find(p.vertices, p.vertex_count);
    ovoid_ellipsoid e = shape->inner, bad;
    double error = regular_solid_get_error(&form.solid);
    CHECK(closed_fit_is_enclosed(&form, &e) && ellipsoid_is_enclosed(&p, &e));
    bad = e, bad.q.xx *= 1 + 3 * error;
    CHECK(!closed_fit_is_enclosed(&form, &bad));
    bad = e, bad.q.yy *= 1 + 3 * error;
    CHECK(!closed_fit_is_enclosed(&form, &bad));
    bad = e, bad.q.xx *= 1 + 20 * error, bad.q.yy = bad.q.xx;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.zz *= 1 + 10 * error;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.center.z = nextafter(e.center.z, 1);
    CHECK(!closed_fit_is_enclosed(&form, &bad));
    bad = e, bad.center.y = 0x1p-20 * sqrt(e.q.yy);
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.xy = 0.5 * e.q.xx;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.xx = NAN;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
    bad = e, bad.q.yy = -e.q.yy;
    CHECK(!ellipsoid_is_enclosed(&p, &bad));
}

// Points and files give the same shape, bit for bit; files with triangles too.
static void check_ways(const ovoid_shape *shape) {
    static char bytes[65536];
    for (uint32_t version = 1; version <= 3; version += 2) {
        size_t size = shape_write_version(shape, version, bytes, sizeof bytes);
        CHECK_LE(size, sizeof bytes);
        ovoid_shape *read = ovoid_shape_read(bytes, size, NULL, NULL);
        shape_files_check_same(read, shape);
        ovoid_shape_destroy(read);
    }
}

static int is_found(const body *b, uint32_t count) {
    regular_solid s;
    return regular_solid_find(b->xyz, count, &s);
}

// Bodies that are nearly such solids: a corner moved by far more than its rounding, in any coordinate.
static void check_nearly(const body *given) {
    body b = *given;
    CHECK(is_found(&b, b.count));
    CHECK(!is_found(&b, b.count - 1));
    for (uint32_t i = 0; i < 3 * b.count; i++) {
        double kept = b.xyz[i];
        const double others[] = {kept + 0x1p-40 * b.radius, NAN, -kept, INFINITY};
        for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
            b.xyz[i] = others[k];
            // A corner on an axis stays where it is mirrored.
            CHECK(!is_found(&b, b.count) || fabs(kept) <= 1e-14 * b.radius);
        }
        b.xyz[i] = kept;
    }
}

static void check_found(void) {
    body b = {.sides = 5, .is_prism = 1, .radius = 1, .half_length = 1};
    const struct {
        double radius, half_length;
        int found;
    } cases[] = {{1, 0x1p-18, 1}, {1, 0x1p-19, 0}, {0x1p-17, 1, 1},   {0x1p-19, 1, 0},   {1e49, 1e49, 1},
                 {6e49, 1, 0},    {6e49, 6e49, 0}, {1e-70, 1e-70, 0}, {1e-60, 1e-60, 1}, {1, 0, 0},
                 {1, -1, 0},      {0, 1, 0},       {1, INFINITY, 0},  {NAN, 1, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (b.is_prism = 0; b.is_prism < 2; b.is_prism++) {
            b.radius = cases[i].radius, b.half_length = cases[i].half_length;
            fill_body(&b, 0.1);
            CHECK_EQ(is_found(&b, b.count), cases[i].found);
        }
    // A star goes around twice, and is convex nowhere.
    b = (body){.sides = 5, .count = 10, .is_prism = 1, .radius = 1, .half_length = 1};
    fill_body(&b, 0);
    body star = b;
    for (uint32_t i = 0; i < 10; i++) memcpy(star.xyz + 3 * i, b.xyz + 3 * (i / 5 * 5 + 2 * i % 5), 24);
    CHECK(!is_found(&star, 10));
    // The other way around, the ring is clockwise.
    for (uint32_t i = 0; i < 10; i++) memcpy(star.xyz + 3 * i, b.xyz + 3 * (i / 5 * 5 + (5 - i % 5) % 5), 24);
    CHECK(!is_found(&star, 10));
}

// Many sides: the general way beyond the most, and tables that are the same up to it.
static void check_many(void) {
    const uint32_t sides[] = {511, 4096, 4097};
    for (size_t i = 0; i < 3; i++) {
        const ovoid_prism prism = {.radius = 1, .half_length = 0.75, .sides = sides[i]};
        for (int is_prism = 0; is_prism < 2; is_prism++) {
            ovoid_shape *s = is_prism ? ovoid_shape_create_prism(&prism, NULL, NULL)
                                      : ovoid_shape_create_pyramid(&prism, NULL, NULL);
            CHECK(s != NULL);
            ovoid_polytope p = ovoid_shape_get_polytope(s);
            CHECK_EQ(p.facet_count, sides[i] + 1 + is_prism);
            CHECK_EQ(closed_form_find(p.vertices, p.vertex_count).kind, sides[i] > 4096 ? FORM_NONE : FORM_REGULAR);
            CHECK(ovoid_shape_get_outer(s).converged && ovoid_shape_get_inner(s).converged);
            CHECK(ellipsoid_is_enclosing(&p, &s->outer) && ellipsoid_is_enclosed(&p, &s->inner));
            ovoid_shape_destroy(s);
        }
    }
}

int main(void) {
    allocator = allocator_make(NULL);
    check_found();
    check_many();
    for (uint64_t i = 0; i < 1000; i++) {
        uint64_t s = check_seed = 1 + i;
        body b = make_body(&s);
        ovoid_shape *shape = ovoid_shape_create_from_points(b.xyz, b.count, NULL, NULL);
        CHECK(shape != NULL);
        ovoid_polytope p = ovoid_shape_get_polytope(shape);
        CHECK_EQ(p.facet_count, b.sides + 1 + (uint32_t)b.is_prism);
        check_hull(&b, &p);
        check_claims(&b, &p);
        check_tables(&b, shape);
        check_fits(&b, shape);
        check_refused(shape);
        check_ways(shape);
        if (i < 40) check_nearly(&b);
        ovoid_shape_destroy(shape);
    }
    return check_end();
}
