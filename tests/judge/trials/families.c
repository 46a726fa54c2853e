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
    trial t = {.a = a, .b = b};
    t.pose_a.position = random_vec3(r, size);
    t.pose_a.rotation = random_quat(r);
    t.pose_b.rotation = random_quat(r);
    double off = 0.6 * size * far[random_next(r) % 6];
    ovoid_vec3 d = random_vec3(r, off), p = t.pose_a.position;
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

// Two bodies of one maker. The first is drawn first.
typedef ovoid_shape *maker(uint64_t *r);
static trial place_two(uint64_t *r, maker *first, maker *second) {
    ovoid_shape *a = first(r), *b = second(r);
    return place_anywhere(r, a, b);
}
static ovoid_shape *make_64(uint64_t *r) { return make_random_hull(r, 64, 1); }
static ovoid_shape *make_40(uint64_t *r) { return make_random_hull(r, 40, 1); }
static ovoid_shape *make_6(uint64_t *r) { return make_random_hull(r, 6, 1); }
static ovoid_shape *make_2048(uint64_t *r) { return make_long_hull(r, 2048); }
static ovoid_shape *make_sharp_flat(uint64_t *r) { return make_flat(r, 0); }
static ovoid_shape *make_sharp_segment(uint64_t *r) { return make_segment(r, 0); }
static ovoid_shape *make_sharp_point(uint64_t *r) { return make_point(r, 0); }

static trial hulls(uint64_t *r) { return place_two(r, make_64, make_64); }
// 4 to 2048 vertices, axes 1:1 to 1:1000.
static trial long_hulls(uint64_t *r) { return place_two(r, make_2048, make_2048); }
// Up to 512 vertices, and now and then 5000.
static trial large_hulls(uint64_t *r) {
    const ovoid_vec3 axes = {1, 1, 2};
    ovoid_shape *a = random_next(r) % 64 ? make_random_hull(r, 512, 1) : make_hull(r, 5000, axes, origin, 0);
    ovoid_shape *b = make_random_hull(r, 512, 1);
    return place_anywhere(r, a, b);
}
static trial mixed(uint64_t *r) { return place_two(r, make_any, make_any); }
static trial needles(uint64_t *r) { return place_two(r, make_needle, make_needle); }
static trial slabs(uint64_t *r) { return place_two(r, make_slab, make_slab); }
static trial flats(uint64_t *r) { return place_two(r, make_sharp_flat, make_sharp_flat); }
static trial low_ranks(uint64_t *r) {
    maker *first = random_next(r) % 2 ? make_sharp_segment : make_sharp_point;
    return place_two(r, first, random_next(r) % 2 ? make_sharp_segment : make_any);
}
static trial rounds(uint64_t *r) { return place_two(r, make_round, random_next(r) % 2 ? make_round : make_any); }
static trial grids(uint64_t *r) { return place_two(r, make_grid, make_grid); }
static trial prisms(uint64_t *r) { return place_two(r, make_prism, make_prism); }

// Faces that are nearly one, brought near one another: in the same orientation face meets face.
static trial near_coplanar(uint64_t *r) {
    trial t = place_two(r, make_near_coplanar, make_near_coplanar);
    if (random_next(r) % 2) {
        ovoid_shape_destroy(t.b);
        t.b = ovoid_shape_create_copy(t.a, NULL, NULL);
        t.pose_b.rotation = t.pose_a.rotation;
    }
    double gap = log_uniform(r, 1e-15, 1e-2);
    if (random_next(r) % 2) close_in(&t, random_next(r) % 2 ? gap : -gap);
    return t;
}

// --- by place

// Gaps and depths of every order, from far below rounding to a thousand sizes.
static trial gaps(uint64_t *r) {
    trial t = place_two(r, random_next(r) % 2 ? make_any : make_40, make_40);
    double most = random_next(r) % 2 ? 1e-6 : 1e3, gap = log_uniform(r, 1e-15, most);
    double size = sphere_radius(t.a) + sphere_radius(t.b);
    close_in(&t, size * (random_next(r) % 2 ? gap : -fmin(gap, 0.05)));
    return t;
}

static trial identical(uint64_t *r) {
    ovoid_shape *a = make_any(r);
    trial t = {.a = a, .b = ovoid_shape_create_copy(a, NULL, NULL)};
    t.pose_a.position = random_vec3(r, 1);
    t.pose_a.rotation = random_quat(r);
    t.pose_b = t.pose_a;
    return t;
}

static trial contained(uint64_t *r) {
    double scale = log_uniform(r, 1e-6, 0.2);
    ovoid_shape *a = make_random_hull(r, 100, 1), *b = make_random_hull(r, 30, scale);
    trial t = place_anywhere(r, a, b);
    ovoid_vec3 d = random_vec3(r, 0.1), p = t.pose_a.position;
    t.pose_b.position = (ovoid_vec3){p.x + d.x, p.y + d.y, p.z + d.z};
    return t;
}

// Hulls of two scales.
static trial place_scaled(uint64_t *r, double most, double sa, double sb) {
    ovoid_shape *a = make_random_hull(r, most, sa), *b = make_random_hull(r, most, sb);
    return place_anywhere(r, a, b);
}

// Lengths of 1e-9, 1e9, and both in one pair; then of any order that the library accepts.
static trial scales(uint64_t *r) {
    const double orders[] = {1e-9, 1, 1e9};
    double sa = orders[random_next(r) % 3], sb = random_next(r) % 2 ? sa : orders[random_next(r) % 3];
    trial t = place_scaled(r, 40, sa, sb);
    if (random_next(r) % 2) close_in(&t, random_normal(r) * 0.01 * fmin(sa, sb));
    return t;
}
static trial wild_scales(uint64_t *r) {
    double sa = log_uniform(r, 1e-80, 1e45), sb = random_next(r) % 2 ? sa : log_uniform(r, 1e-80, 1e45);
    return place_scaled(r, 20, sa, sb);
}

// At the ends of what is accepted: lengths up to 1e50, and below 1e-130, where nothing is resolved.
static trial huge(uint64_t *r) {
    double scale = log_uniform(r, 1e35, 2e48), other = scale * log_uniform(r, 1e-3, 1);
    return place_scaled(r, 20, scale, other);
}
static trial tiny(uint64_t *r) {
    double scale = log_uniform(r, 1e-305, 1e-110), other = scale * log_uniform(r, 1e-3, 1);
    return place_scaled(r, 20, scale, other);
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
static ovoid_shape *make_far_hull(uint64_t *r) {
    size_t count = random_count(r, 40);
    ovoid_vec3 center = random_vec3(r, 1e7);
    return make_hull(r, count, (ovoid_vec3){1, 2, 1}, center, 0);
}
static trial far_vertices(uint64_t *r) {
    ovoid_shape *a = make_far_hull(r), *b = make_far_hull(r);
    ovoid_vec3 oa = ovoid_shape_get_polytope(a).origin, ob = ovoid_shape_get_polytope(b).origin;
    trial t = {.a = a, .b = b};
    t.pose_a.rotation = random_quat(r);
    t.pose_b.rotation = random_quat(r);
    // Brings the two clouds together again.
    ovoid_vec3 pa = ovoid_pose_compute_point(&t.pose_a, oa), pb = ovoid_pose_compute_point(&t.pose_b, ob);
    ovoid_vec3 d = random_vec3(r, 1.5);
    t.pose_b.position = (ovoid_vec3){pa.x - pb.x + d.x, pa.y - pb.y + d.y, pa.z - pb.z + d.z};
    return t;
}

static trial quaternions(uint64_t *r) {
    trial t = hulls(r);
    ovoid_quat *q[2] = {&t.pose_a.rotation, &t.pose_b.rotation};
    for (int i = 0; i < 2; i++) {
        double norm = log_uniform(r, 1e-150, 1e150);
        *q[i] = (ovoid_quat){q[i]->w * norm, q[i]->x * norm, q[i]->y * norm, q[i]->z * norm};
    }
    if (random_next(r) % 4 == 0) q[0]->w = q[0]->x = 0x1p-1060;
    return t;
}

// --- few vertices, for brute force

// One time in two to a gap or depth of any order from 1e-15 to 0.1 of the size.
static void close_in_a_little(trial *t, uint64_t *r) {
    if (random_next(r) % 2) return;
    double size = sphere_radius(t->a) + sphere_radius(t->b), part = log_uniform(r, 1e-15, 0.1);
    close_in(t, size * random_normal(r) * part);
}

static trial small_hulls(uint64_t *r) {
    trial t = place_two(r, make_6, make_6);
    close_in_a_little(&t, r);
    return t;
}
static trial eight_corners(uint64_t *r) {
    ovoid_shape *a = make_random_hull(r, 8, 1), *b = make_box(1, log_uniform(r, 1e-3, 1), 0.5, 0);
    trial t = place_anywhere(r, a, b);
    close_in_a_little(&t, r);
    return t;
}
// A box or a slanted one, to 1:1000, some of them rounded; half of the pairs nearly of the same axes.
static ovoid_shape *make_parallelepiped(uint64_t *r) {
    double xyz[24], radius = random_next(r) % 4 ? 0 : log_uniform(r, 1e-3, 1);
    double y = log_uniform(r, 1e-3, 1), z = log_uniform(r, 1e-3, 1);
    if (random_next(r) % 2) return make_box(1, y, z, radius);
    ovoid_vec3 axis[3] = {random_vec3(r, 1), random_vec3(r, y), random_vec3(r, z)}, c = random_vec3(r, 1);
    for (int i = 0; i < 8; i++) {
        double s[3] = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
        xyz[3 * i] = c.x + s[0] * axis[0].x + s[1] * axis[1].x + s[2] * axis[2].x;
        xyz[3 * i + 1] = c.y + s[0] * axis[0].y + s[1] * axis[1].y + s[2] * axis[2].y;
        xyz[3 * i + 2] = c.z + s[0] * axis[0].z + s[1] * axis[1].z + s[2] * axis[2].z;
    }
    return make_points(xyz, 8, radius);
}
static trial parallelepipeds(uint64_t *r) {
    trial t = place_two(r, make_parallelepiped, make_parallelepiped);
    if (random_next(r) % 2) {
        double turn = log_uniform(r, 1e-17, 0.3);
        ovoid_quat *a = &t.pose_a.rotation, *b = &t.pose_b.rotation;
        *b = (ovoid_quat){a->w + turn * random_normal(r), a->x + turn * random_normal(r), a->y, a->z};
    }
    close_in_a_little(&t, r);
    return t;
}
// Points, segments, triangles, tetrahedra of any axes, some of them rounded.
static ovoid_shape *make_simplex(uint64_t *r) {
    double xyz[12], radius = random_next(r) % 4 ? 0 : log_uniform(r, 1e-3, 1);
    double y = log_uniform(r, 1e-6, 1), z = log_uniform(r, 1e-6, 1);
    const double axes[3] = {1, y, z};
    for (int i = 0; i < 12; i++) xyz[i] = axes[i % 3] * random_normal(r);
    return make_points(xyz, 1 + (size_t)(random_next(r) % 4), radius);
}
static trial simplices(uint64_t *r) {
    trial t = place_two(r, make_simplex, make_simplex);
    close_in_a_little(&t, r);
    return t;
}

// Points, segments and boxes of any scale, most of them rounded: the pairs in closed form.
static ovoid_shape *make_closed(uint64_t *r, double scale) {
    double radius = random_next(r) % 3 ? scale * log_uniform(r, 1e-6, 10) : 0;
    double x = scale * log_uniform(r, 1e-3, 1), y = scale * log_uniform(r, 1e-3, 1),
           z = scale * log_uniform(r, 1e-9, 1);
    ovoid_vec3 a = random_vec3(r, x), b = random_vec3(r, x);
    switch (random_next(r) % 6) {
    case 0: return ovoid_shape_create_sphere(radius, NULL, NULL);
    case 1: return make_points((const double[]){a.x, a.y, a.z}, 1, radius);
    case 2: return ovoid_shape_create_capsule(radius, z, NULL, NULL);
    case 3: return make_points((const double[]){a.x, a.y, a.z, b.x, b.y, b.z}, 2, radius);
    case 4: return make_box(scale, x, x, radius);
    default: return make_box(x, y, scale, radius);
    }
}
// In any poses, or in what is special to them: concentric, of the same or nearly the same axes, on a lattice of their
// own sizes. Some are then brought to a gap or a depth of any order.
static trial closed_pairs(uint64_t *r) {
    const double orders[] = {1e-9, 1, 1, 1e9};
    double scale = orders[random_next(r) % 4], other = random_next(r) % 4 ? scale : orders[random_next(r) % 4];
    ovoid_shape *a = make_closed(r, scale), *b = make_closed(r, other);
    trial t = place_anywhere(r, a, b);
    uint64_t kind = random_next(r) % 8;
    if (kind == 0) t.pose_b.position = t.pose_a.position;
    if (kind == 1 || kind == 2) t.pose_b.rotation = t.pose_a.rotation;
    if (kind == 2) t.pose_b.rotation.x += log_uniform(r, 1e-17, 1e-3);
    if (kind == 3 || kind == 4) {
        double step = kind == 3 ? scale : sphere_radius(a) + sphere_radius(b);
        ovoid_vec3 d = {0, 0, 0};
        (&d.x)[random_next(r) % 3] = step * (double)(random_next(r) % 3);
        (&d.x)[random_next(r) % 3] += step * (double)(random_next(r) % 2);
        t.pose_a = t.pose_b = (ovoid_pose){{0, 0, 0}, {1, 0, 0, 0}};
        t.pose_b.position = d;
        if (random_next(r) % 2) t.pose_b.rotation = (ovoid_quat){1, 1, 0, 0};
        return t;
    }
    close_in_a_little(&t, r);
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
    {.counts.name = "parallelepipeds, brute force", .make = parallelepipeds, .each = 3, .judged = 1},
    {.counts.name = "closed forms, brute force", .make = closed_pairs, .each = 6, .judged = 1},
};
const size_t family_count = sizeof families / sizeof *families;
