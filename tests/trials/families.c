// The table of families, and the pairs that are not contacts (those are in contacts.c).
#include "families.h"

#include "check.h"
#include "shapes.h"

static const ovoid_vec3 origin = {0, 0, 0};

double sphere_radius(const ovoid_shape *s) {
    return ovoid_shape_get_measures(s).sphere_radius + ovoid_shape_get_radius(s);
}

trial place_anywhere(uint64_t *r, ovoid_shape *a, ovoid_shape *b) {
    double size = sphere_radius(a) + sphere_radius(b);
    const double far[] = {6, 1.5, 1, 0.6, 0.2, 0};
    trial t = {a, b, {random_vec3(r, size), random_quat(r)}, {{0, 0, 0}, random_quat(r)}, 0, 0};
    ovoid_vec3 d = random_vec3(r, 0.6 * size * far[random_next(r) % 6]), p = t.pose_a.position;
    t.pose_b.position = (ovoid_vec3){p.x + d.x, p.y + d.y, p.z + d.z};
    return t;
}

void close_in(trial *t, double gap) {
    for (int i = 0; i < 4; i++) {
        ovoid_pair pair = {t->a, t->b, t->pose_a, t->pose_b};
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, NULL);
        double step = gap - (isfinite(x.lower) ? x.lower : x.upper);
        t->pose_b.position.x += x.normal.x * step;
        t->pose_b.position.y += x.normal.y * step;
        t->pose_b.position.z += x.normal.z * step;
    }
}

// --- by shape

static trial hulls(uint64_t *r) { return place_anywhere(r, make_random_hull(r, 64, 1), make_random_hull(r, 64, 1)); }
// 4 to 2048 vertices, axes 1:1 to 1:1000.
static trial long_hulls(uint64_t *r) { return place_anywhere(r, make_long_hull(r, 2048), make_long_hull(r, 2048)); }
// Up to 512 vertices, and now and then 5000.
static trial large_hulls(uint64_t *r) {
    const ovoid_vec3 axes = {1, 1, 2};
    ovoid_shape *a = random_next(r) % 64 ? make_random_hull(r, 512, 1) : make_hull(r, 5000, axes, origin, 0);
    return place_anywhere(r, a, make_random_hull(r, 512, 1));
}
static trial mixed(uint64_t *r) { return place_anywhere(r, make_any(r), make_any(r)); }
static trial needles(uint64_t *r) { return place_anywhere(r, make_needle(r), make_needle(r)); }
static trial slabs(uint64_t *r) { return place_anywhere(r, make_slab(r), make_slab(r)); }
static trial flats(uint64_t *r) { return place_anywhere(r, make_flat(r, 0), make_flat(r, 0)); }
static trial low_ranks(uint64_t *r) {
    ovoid_shape *a = random_next(r) % 2 ? make_segment(r, 0) : make_point(r, 0);
    return place_anywhere(r, a, random_next(r) % 2 ? make_segment(r, 0) : make_any(r));
}
static trial rounds(uint64_t *r) {
    return place_anywhere(r, make_round(r), random_next(r) % 2 ? make_round(r) : make_any(r));
}
static trial grids(uint64_t *r) { return place_anywhere(r, make_grid(r), make_grid(r)); }
static trial prisms(uint64_t *r) { return place_anywhere(r, make_prism(r), make_prism(r)); }

// Faces that are nearly one, brought near one another: in the same orientation face meets face.
static trial near_coplanar(uint64_t *r) {
    trial t = place_anywhere(r, make_near_coplanar(r), make_near_coplanar(r));
    if (random_next(r) % 2) {
        ovoid_shape_destroy(t.b);
        t.b = ovoid_shape_create_copy(t.a, NULL, NULL);
        t.pose_b.rotation = t.pose_a.rotation;
    }
    if (random_next(r) % 2) close_in(&t, log_uniform(r, 1e-15, 1e-2) * (random_next(r) % 2 ? 1 : -1));
    return t;
}

// --- by place

// Gaps and depths of every order, from far below rounding to a thousand sizes.
static trial gaps(uint64_t *r) {
    trial t =
        place_anywhere(r, random_next(r) % 2 ? make_any(r) : make_random_hull(r, 40, 1), make_random_hull(r, 40, 1));
    double gap = log_uniform(r, 1e-15, random_next(r) % 2 ? 1e-6 : 1e3), size = sphere_radius(t.a) + sphere_radius(t.b);
    close_in(&t, size * (random_next(r) % 2 ? gap : -fmin(gap, 0.05)));
    return t;
}

static trial identical(uint64_t *r) {
    ovoid_shape *a = make_any(r);
    trial t = {
        a, ovoid_shape_create_copy(a, NULL, NULL), {random_vec3(r, 1), random_quat(r)}, {{0, 0, 0}, {0, 0, 0, 0}}, 0,
        0};
    t.pose_b = t.pose_a;
    return t;
}

static trial contained(uint64_t *r) {
    trial t = place_anywhere(r, make_random_hull(r, 100, 1), make_random_hull(r, 30, log_uniform(r, 1e-6, 0.2)));
    ovoid_vec3 d = random_vec3(r, 0.1), p = t.pose_a.position;
    t.pose_b.position = (ovoid_vec3){p.x + d.x, p.y + d.y, p.z + d.z};
    return t;
}

// Lengths of 1e-9, 1e9, and both in one pair; then of any order that the library accepts.
static trial scales(uint64_t *r) {
    const double orders[] = {1e-9, 1, 1e9};
    double sa = orders[random_next(r) % 3], sb = random_next(r) % 2 ? sa : orders[random_next(r) % 3];
    trial t = place_anywhere(r, make_random_hull(r, 40, sa), make_random_hull(r, 40, sb));
    if (random_next(r) % 2) close_in(&t, random_normal(r) * 0.01 * fmin(sa, sb));
    return t;
}
static trial wild_scales(uint64_t *r) {
    double sa = log_uniform(r, 1e-80, 1e45), sb = random_next(r) % 2 ? sa : log_uniform(r, 1e-80, 1e45);
    return place_anywhere(r, make_random_hull(r, 20, sa), make_random_hull(r, 20, sb));
}

// At the ends of what is accepted: lengths up to 1e50, and below 1e-130, where nothing is resolved.
static trial huge(uint64_t *r) {
    double scale = log_uniform(r, 1e35, 2e48);
    return place_anywhere(r, make_random_hull(r, 20, scale), make_random_hull(r, 20, scale * log_uniform(r, 1e-3, 1)));
}
static trial tiny(uint64_t *r) {
    double scale = log_uniform(r, 1e-305, 1e-110);
    return place_anywhere(r, make_random_hull(r, 20, scale), make_random_hull(r, 20, scale * log_uniform(r, 1e-3, 1)));
}

// Far from the world's origin, and vertices far from their own.
static trial far_poses(uint64_t *r) {
    trial t = hulls(r);
    if (random_next(r) % 2) close_in(&t, random_normal(r) * 0.01);
    ovoid_vec3 d = random_vec3(r, 1e7);
    ovoid_vec3 *a = &t.pose_a.position, *b = &t.pose_b.position;
    *a = (ovoid_vec3){a->x + d.x, a->y + d.y, a->z + d.z};
    *b = (ovoid_vec3){b->x + d.x, b->y + d.y, b->z + d.z};
    return t;
}
static trial far_vertices(uint64_t *r) {
    ovoid_shape *a = make_hull(r, random_count(r, 40), (ovoid_vec3){1, 2, 1}, random_vec3(r, 1e7), 0);
    ovoid_shape *b = make_hull(r, random_count(r, 40), (ovoid_vec3){1, 2, 1}, random_vec3(r, 1e7), 0);
    ovoid_vec3 oa = ovoid_shape_get_polytope(a).origin, ob = ovoid_shape_get_polytope(b).origin;
    trial t = {a, b, {{0, 0, 0}, random_quat(r)}, {{0, 0, 0}, random_quat(r)}, 0, 0};
    // Brings the two clouds together again.
    ovoid_vec3 pa = ovoid_pose_compute_point(&t.pose_a, oa), pb = ovoid_pose_compute_point(&t.pose_b, ob);
    ovoid_vec3 d = random_vec3(r, 1.5);
    t.pose_b.position = (ovoid_vec3){pa.x - pb.x + d.x, pa.y - pb.y + d.y, pa.z - pb.z + d.z};
    return t;
}

static trial quaternions(uint64_t *r) {
    trial t = hulls(r);
    double norms[2] = {log_uniform(r, 1e-150, 1e150), log_uniform(r, 1e-150, 1e150)};
    ovoid_quat *q[2] = {&t.pose_a.rotation, &t.pose_b.rotation};
    for (int i = 0; i < 2; i++)
        *q[i] = (ovoid_quat){q[i]->w * norms[i], q[i]->x * norms[i], q[i]->y * norms[i], q[i]->z * norms[i]};
    if (random_next(r) % 4 == 0) q[0]->w = q[0]->x = 0x1p-1060;
    return t;
}

// --- few vertices, for brute force

static trial small_hulls(uint64_t *r) {
    trial t = place_anywhere(r, make_random_hull(r, 6, 1), make_random_hull(r, 6, 1));
    if (random_next(r) % 2) close_in(&t, random_normal(r) * log_uniform(r, 1e-14, 0.1));
    return t;
}
static trial eight_corners(uint64_t *r) {
    trial t = place_anywhere(r, make_random_hull(r, 8, 1), make_box(1, log_uniform(r, 1e-3, 1), 0.5, 0));
    if (random_next(r) % 2) close_in(&t, random_normal(r) * log_uniform(r, 1e-14, 0.1));
    return t;
}
// Points, segments, triangles, tetrahedra of any axes, some of them rounded.
static ovoid_shape *make_simplex(uint64_t *r) {
    double xyz[12], radius = random_next(r) % 4 ? 0 : log_uniform(r, 1e-3, 1);
    double axes[3] = {1, log_uniform(r, 1e-6, 1), log_uniform(r, 1e-6, 1)};
    for (int i = 0; i < 12; i++) xyz[i] = axes[i % 3] * random_normal(r);
    return make_points(xyz, 1 + (size_t)(random_next(r) % 4), radius);
}
static trial simplices(uint64_t *r) {
    trial t = place_anywhere(r, make_simplex(r), make_simplex(r));
    double size = sphere_radius(t.a) + sphere_radius(t.b);
    if (random_next(r) % 2) close_in(&t, size * random_normal(r) * log_uniform(r, 1e-15, 0.1));
    return t;
}

// --- the table

family families[] = {
    {.counts.name = "hulls", .make = hulls},
    {.counts.name = "hulls to 2048, axes to 1:1000", .make = long_hulls},
    {.counts.name = "large hulls", .make = large_hulls},
    {.counts.name = "mixed", .make = mixed},
    {.counts.name = "needles", .make = needles},
    {.counts.name = "slabs", .make = slabs},
    {.counts.name = "flat", .make = flats},
    {.counts.name = "segments and points", .make = low_ranks},
    {.counts.name = "round", .make = rounds},
    {.counts.name = "grids", .make = grids},
    {.counts.name = "near-coplanar", .make = near_coplanar},
    {.counts.name = "prisms", .make = prisms},
    {.counts.name = "gaps 1e-15 to 1e3", .make = gaps},
    {.counts.name = "boxes, aligned", .make = make_aligned_boxes},
    {.counts.name = "boxes face to face", .make = make_face_to_face, .each = 3},
    {.counts.name = "boxes edge to edge", .make = make_edge_to_edge, .each = 3},
    {.counts.name = "boxes vertex to face", .make = make_vertex_to_face, .each = 3},
    {.counts.name = "exact touching", .make = make_touching, .each = 2},
    {.counts.name = "shared vertices", .make = make_shared_vertices, .each = 6, .judged = 1},
    {.counts.name = "one body cut in two", .make = make_split, .each = 2},
    {.counts.name = "small hulls, brute force", .make = small_hulls, .each = 3, .judged = 1},
    {.counts.name = "eight corners, brute force", .make = eight_corners, .judged = 1},
    {.counts.name = "simplices, brute force", .make = simplices, .each = 6, .judged = 1},
    {.counts.name = "identical", .make = identical},
    {.counts.name = "contained", .make = contained},
    {.counts.name = "scales 1e-9, 1, 1e9", .make = scales},
    {.counts.name = "wild scales", .make = wild_scales},
    {.counts.name = "huge", .make = huge},
    {.counts.name = "tiny", .counts.may_be_undecided = 1, .make = tiny},
    {.counts.name = "far poses", .make = far_poses},
    {.counts.name = "far vertices", .make = far_vertices},
    {.counts.name = "quaternions of any norm", .make = quaternions},
    {.counts.name = "motion", .make = mixed, .frames = 8},
    {.counts.name = "motion, the previous proof", .make = mixed, .frames = 6, .earlier = EARLIER_LAST},
    {.counts.name = "motion, a stale proof", .make = hulls, .frames = 8, .earlier = EARLIER_STALE},
    {.counts.name = "another pair's proof", .make = mixed, .frames = 3, .earlier = EARLIER_FOREIGN},
    {.counts.name = "real hulls", .make = make_real_hulls, .each = 3},
    {.counts.name = "parts of real compounds", .make = make_compound_parts, .each = 2},
};
const size_t family_count = sizeof families / sizeof *families;
