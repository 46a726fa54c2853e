// Convex parts of a solid of up to 24 triangles: parts that are given, parts that are made, and the latter grown.
// Truth: brackets of the same length have a point in common, whatever the budget; the solid's own points, and those
// around which it winds, are no farther from the parts than is proven, nor the parts' vertices from the solid, by the
// core's distances; parts that are made leave no more uncovered than rounding, and grown by a length less than that.
#include "bodies.h"
#include "meshes.h"

typedef struct bracket {
    double lower, upper;
} bracket;

typedef struct findings {
    ovoid_decomposition d;
    bracket uncovered, excess;
    double parts[4]; ///< the least that is proven of each
} findings;

static double distance_of_parts(const ovoid_decomposition *d, const ovoid_shape *point, ovoid_vec3 x) {
    double least = INFINITY;
    for (size_t i = 0; i < d->part_count; i++) {
        ovoid_pair pair = {d->parts[i], point, ovoid_pose_make_identity(), {x, {1, 0, 0, 0}}};
        least = fmin(least, fmax(ovoid_distance(&pair, NULL, NULL).lower, 0));
    }
    return least;
}

static void check_uncovered(const findings *f, const ovoid_shape *point, ovoid_vec3 x) {
    fuzz_require(distance_of_parts(&f->d, point, x) <= f->uncovered.upper);
}

static void check_excess(const findings *f, const ovoid_shape *point, size_t part) {
    ovoid_polytope p = ovoid_shape_get_polytope(f->d.parts[part]);
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        ovoid_pose at = {{p.origin.x + v[0], p.origin.y + v[1], p.origin.z + v[2]}, {1, 0, 0, 0}};
        ovoid_body_pair pair = {{.solid = f->d.solid, .pose = ovoid_pose_make_identity()},
                                {.shape = point, .pose = at}};
        double lower = ovoid_body_distance(&pair, NULL, NULL).lower;
        fuzz_require(lower <= f->excess.upper && lower <= f->parts[part]);
    }
}

static void narrow(bracket *b, const ovoid_decomposition_length *l) {
    fuzz_require(0 <= l->lower && l->lower <= l->upper && l->upper < INFINITY);
    b->lower = fmax(b->lower, l->lower);
    b->upper = fmin(b->upper, l->upper);
    fuzz_require(b->lower <= b->upper);
}

// Both lengths with little work and with more; then points.
static findings check_proof(const ovoid_decomposition *d, ovoid_decomposition_options *o) {
    findings f = {*d, {0, INFINITY}, {0, INFINITY}, {INFINITY, INFINITY, INFINITY, INFINITY}};
    for (o->work = 16; o->work < 600; o->work *= 16) {
        double excess[4];
        o->excesses = excess;
        ovoid_decomposition_proof p;
        ovoid_error error = {OVOID_OK, -1, ""};
        if (ovoid_decomposition_compute_proof(d, o, &p, &error) != OVOID_OK) {
            fuzz_require_error(&error);
            return f;
        }
        narrow(&f.uncovered, &p.uncovered);
        narrow(&f.excess, &p.excess);
        for (size_t i = 0; i < d->part_count; i++) f.parts[i] = fmin(f.parts[i], excess[i]);
    }
    static const double origin[3] = {0, 0, 0};
    ovoid_shape *point = ovoid_shape_create_from_points(origin, 1, NULL, NULL);
    ovoid_solid_report r = ovoid_solid_get_report(d->solid);
    const double *xyz = ovoid_solid_get_points(d->solid);
    for (uint64_t t = 0; t < r.triangles; t++) {
        // A corner, and a point under the face.
        uint32_t c[3];
        int64_t winding;
        ovoid_solid_get_triangle(d->solid, t, c);
        const double *a = xyz + 3 * (size_t)c[0], *b = xyz + 3 * (size_t)c[1], *e = xyz + 3 * (size_t)c[2];
        ovoid_vec3 x = {a[0], a[1], a[2]};
        check_uncovered(&f, point, x);
        x = (ovoid_vec3){a[0] / 4 + b[0] / 4 + e[0] / 2, a[1] / 4 + b[1] / 4 + e[1] / 2,
                         a[2] / 4 + b[2] / 4 + e[2] / 2};
        x.x += (r.box.min.x / 2 + r.box.max.x / 2 - x.x) / 8;
        x.y += (r.box.min.y / 2 + r.box.max.y / 2 - x.y) / 8;
        x.z += (r.box.min.z / 2 + r.box.max.z / 2 - x.z) / 8;
        if (ovoid_solid_compute_winding(d->solid, x, &winding) && winding) check_uncovered(&f, point, x);
    }
    for (size_t i = 0; i < d->part_count; i++) check_excess(&f, point, i);
    ovoid_shape_destroy(point);
    return f;
}

static void check_given(fuzz_bytes *from, const ovoid_solid *solid, int is_wild, ovoid_decomposition_options *o) {
    ovoid_shape *parts[3] = {NULL, NULL, NULL};
    size_t count = 1 + (size_t)((unsigned)take_byte(from) % 3);
    for (size_t i = 0; i < count; i++) parts[i] = take_any_shape(from, is_wild);
    ovoid_decomposition d = {solid, (const ovoid_shape *const *)parts, count};
    check_proof(&d, o);
    for (size_t i = 0; i < count; i++) ovoid_shape_destroy(parts[i]);
}

static double get_reach(const ovoid_solid *solid) {
    ovoid_box b = ovoid_solid_get_report(solid).box;
    double x = fmax(fabs(b.min.x), fabs(b.max.x)), y = fmax(fabs(b.min.y), fabs(b.max.y));
    return fmax(fmax(x, y), fmax(fabs(b.min.z), fabs(b.max.z)));
}

static void check_made(const ovoid_solid *solid, ovoid_decomposition_options *o) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_parts *parts = ovoid_parts_create_from_solid(solid, o, &error);
    if (!parts) {
        fuzz_require_error(&error);
        return;
    }
    ovoid_decomposition d = {solid, ovoid_parts_get_shapes(parts), ovoid_parts_get_count(parts)};
    fuzz_require(d.part_count >= 1 && d.part_count <= o->parts);
    double rounding = 1e-6 * get_reach(solid) + OVOID_LENGTH_MIN;
    findings f = check_proof(&d, o);
    fuzz_require(f.uncovered.lower <= rounding);
    ovoid_parts *grown = ovoid_parts_create_enlarged(&d, rounding, o, &error);
    if (grown) {
        ovoid_decomposition e = {solid, ovoid_parts_get_shapes(grown), ovoid_parts_get_count(grown)};
        fuzz_require(check_proof(&e, o).uncovered.lower == 0);
    } else
        fuzz_require_error(&error);
    ovoid_parts_destroy(grown);
    ovoid_parts_destroy(parts);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    int is_wild = take_byte(&from) > 96;
    fuzz_triangles m = take_byte(&from) & 1 ? take_triangles(&from) : take_tetrahedra(&from);
    ovoid_decomposition_options o = {.tolerance = fabs(take_double(&from)) / 16,
                                     .cells = 4096,
                                     .error = fabs(take_double(&from)) / 16,
                                     .parts = 1 + (size_t)((unsigned)take_byte(&from) & 3)};
    ovoid_solid *solid = fuzz_make_solid(&m);
    if (solid) {
        check_given(&from, solid, is_wild, &o);
        check_made(solid, &o);
    }
    ovoid_solid_destroy(solid);
    return 0;
}
