// Pairs in contact or almost. Where both bodies stand on coordinates that doubles hold, the distance is known exactly:
// along z, turns about z by any quaternion (w, 0, 0, z) are rational and leave all heights as they are, and a gap added
// to a small dyadic height is what the position says it is, no rounding left out.
#include "families.h"

#include "check.h"
#include "clouds.h"
#include "shapes.h"

static ovoid_pose random_pose(uint64_t *r, double deviation) {
    ovoid_vec3 position = random_vec3(r, deviation);
    return (ovoid_pose){position, random_quat(r)};
}

// Both bodies turned and moved alike, one time in two: the contact is then one to rounding, and the distance not known.
static void move_both(trial *t, uint64_t *r) {
    if (random_next(r) % 2) return;
    ovoid_pose move = random_pose(r, 3);
    ovoid_pose *poses[2] = {&t->pose_a, &t->pose_b};
    for (int i = 0; i < 2; i++) {
        ovoid_quat p = move.rotation, q = poses[i]->rotation;
        poses[i]->position = ovoid_pose_compute_point(&move, poses[i]->position);
        poses[i]->rotation =
            (ovoid_quat){p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
                         p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
    }
    t->is_known = 0;
}

// None, of any order from far below rounding to 1000, or a depth of up to a hundredth.
static double choose_gap(uint64_t *r, double least) {
    switch (random_next(r) % 4) {
    case 0: return 0;
    case 1: return -log_uniform(r, least, 1e-2);
    case 2: return log_uniform(r, least, 1e3);
    default: return log_uniform(r, least, 1e-9);
    }
}

// Bodies of 8 corners, to stand on one another: A reaches up to z = top, B down to z = -bottom.
typedef struct stacked {
    double a[24], b[24], top, bottom;
} stacked;

// B above A by the gap. The nearest points are one above the other as long as B is aside by no more than 1/4 and deeper
// than all else for gaps above -1/50. One time in two both contacts are at height 0 in their own frames: the gap is
// then the position, and may be as small as 1e-40.
static trial stack(uint64_t *r, stacked s) {
    if (random_next(r) % 2) {
        for (int i = 2; i < 24; i += 3) s.a[i] -= s.top, s.b[i] += s.bottom;
        s.top = s.bottom = 0;
    }
    trial t = {
        make_points(s.a, 8, 0), make_points(s.b, 8, 0), {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}, 1, 0};
    const ovoid_quat turns[] = {{1, 0, 0, 0}, {4, 0, 0, 1}, {3, 0, 0, -1}, {7, 0, 0, 2}};
    t.pose_b.rotation = turns[random_next(r) % 4];
    double height = s.top + s.bottom, z = height + choose_gap(r, height > 0 ? 1e-15 : 1e-40);
    double x = random_uniform(r, -0.25, 0.25), y = random_uniform(r, -0.25, 0.25);
    t.pose_b.position = (ovoid_vec3){x, y, z};
    t.d = z - height;
    move_both(&t, r);
    return t;
}

// The corners of a box of these half sizes.
static void set_corners(double *xyz, double x, double y, double z) {
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = i & 1 ? x : -x;
        xyz[3 * i + 1] = i & 2 ? y : -y;
        xyz[3 * i + 2] = i & 4 ? z : -z;
    }
}

trial make_face_to_face(uint64_t *r) {
    stacked s = {.top = 0.5 * (double)(1 + random_next(r) % 4)};
    s.bottom = 0.5 * (double)(1 + random_next(r) % 4);
    set_corners(s.a, 1, 2, s.top);
    set_corners(s.b, 1, 1, s.bottom);
    return stack(r, s);
}

// Square bars on their edges: that of A along x at z = 2, that of B along y at z = -2, before it is turned.
trial make_edge_to_edge(uint64_t *r) {
    static const stacked bars = {{-2, 0, 2, 2, 0, 2, -2, 0, -2, 2, 0, -2, -2, 2, 0, 2, 2, 0, -2, -2, 0, 2, -2, 0},
                                 {0, -2, 2, 0, 2, 2, 0, -2, -2, 0, 2, -2, 2, -2, 0, 2, 2, 0, -2, -2, 0, -2, 2, 0},
                                 2,
                                 2};
    return stack(r, bars);
}

// A cube of edges (2, 4, 4), (4, 2, -4), (4, -4, 2) on a corner, over a plate.
trial make_vertex_to_face(uint64_t *r) {
    static const double edges[3][3] = {{1, 2, 2}, {2, 1, -2}, {2, -2, 1}};
    stacked s = {.top = 0.5, .bottom = 5};
    set_corners(s.a, 8, 8, s.top);
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            s.b[3 * i + k] =
                (i & 1 ? 1 : -1) * edges[0][k] + (i & 2 ? 1 : -1) * edges[1][k] + (i & 4 ? 1 : -1) * edges[2][k];
    return stack(r, s);
}

// Axis-aligned boxes of the same axes at small distances: parallel faces and edges, nothing unique.
trial make_aligned_boxes(uint64_t *r) {
    const double steps[] = {0, 0.5, 1, 1.5, 2, 2.5, 1 + 0x1p-50, 2 - 0x1p-50, 2 + 0x1p-40};
    trial t = {
        make_box(0.5, 1, 1.5, 0), make_box(0.5, 1, 0.5, 0), {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}, 0, 0};
    double x = steps[random_next(r) % 9], y = steps[random_next(r) % 9], z = steps[random_next(r) % 9];
    t.pose_b.position = (ovoid_vec3){x, -y, z};
    // Both turned alike, by a quarter, by 3-4-5, or by anything.
    const ovoid_quat turns[] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {2, 0, 1, 0}, random_quat(r)};
    ovoid_quat q = turns[random_next(r) % 4];
    ovoid_pose turn = {{0, 0, 0}, q};
    t.pose_a.rotation = t.pose_b.rotation = q;
    t.pose_b.position = ovoid_pose_compute_point(&turn, t.pose_b.position);
    return t;
}

// One of the ways in which two bodies on dyadic coordinates touch in exactly one face, edge or point: d = 0.
trial make_touching(uint64_t *r) {
    // B's nearest corner, edge or face is at x = 0, A's face at x = 0 or A's edge along y at x = 0.
    static const double cube[] = {-2, -1, -1, 0, -1, -1, -2, 1, -1, 0, 1, -1, -2, -1, 1, 0, -1, 1, -2, 1, 1, 0, 1, 1};
    static const double ridge[] = {0, -1, 0, 0, 1, 0, -1, -1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1};
    static const double tip[] = {0, 0, 0, 2, 1, 1, 2, -1, 1, 2, 1, -1, 2, -1, -1};
    static const double wedge[] = {0, 0, -1, 0, 0, 1, 1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1};
    static const double plate[] = {0, -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1};
    ovoid_shape *a = random_next(r) % 3 == 0   ? make_points(ridge, 6, 0)
                     : random_next(r) % 3 == 0 ? make_points(plate, 4, 0)
                                               : make_points(cube, 8, 0);
    ovoid_shape *b = NULL;
    switch (random_next(r) % 4) {
    case 0: b = make_points(tip, 5, 0); break;
    case 1: b = make_points(wedge, 6, 0); break;
    case 2: b = make_points(plate, 4, 0); break;
    default: b = make_box(1, 0.5, 0.25, 0); break;
    }
    trial t = {a, b, {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}, 1, 0};
    if (ovoid_shape_get_polytope(b).vertex_count == 8) t.pose_b.position.x = 1;
    // Turns about x leave x = 0 where it is.
    if (random_next(r) % 2) t.pose_b.rotation.x = 1;
    if (random_next(r) % 2) t.pose_a.rotation = (ovoid_quat){0.25, 0.25, 0, 0};
    // The same place elsewhere, exactly.
    double shift = (double)(random_next(r) % 3) * 1024.25;
    t.pose_a.position.y += shift, t.pose_b.position.y += shift;
    return t;
}

// Corners of one lattice in one pose: shared vertices, edges and planes, all exactly; brute force knows the rest.
trial make_shared_vertices(uint64_t *r) {
    ovoid_shape *a = make_lattice(r), *b = make_lattice(r);
    trial t = {a, b, {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}, 0, 0};
    if (random_next(r) % 2) t.pose_a = t.pose_b = random_pose(r, 10);
    return t;
}

// A body cut in two along z = 0: the halves share the vertices of the cut, and d = 0 in every common pose. One time in
// four they are parted or pushed together.
trial make_split(uint64_t *r) {
    double halves[2][3 * 40];
    size_t cut = 3 + (size_t)(random_next(r) % 6), more = 1 + (size_t)(random_next(r) % 30);
    for (size_t i = 0; i < cut; i++) {
        halves[0][3 * i] = halves[1][3 * i] = random_normal(r);
        halves[0][3 * i + 1] = halves[1][3 * i + 1] = random_normal(r);
        halves[0][3 * i + 2] = halves[1][3 * i + 2] = 0;
    }
    for (int k = 0; k < 2; k++)
        for (size_t i = cut; i < cut + more; i++) {
            halves[k][3 * i] = random_normal(r), halves[k][3 * i + 1] = random_normal(r);
            halves[k][3 * i + 2] = random_uniform(r, 0.1, 2) * (k ? 1 : -1);
        }
    trial t = {.a = make_points(halves[0], cut + more, 0), .b = make_points(halves[1], cut + more, 0), .is_known = 1};
    t.pose_a = t.pose_b = random_pose(r, 3);
    if (random_next(r) % 4) return t;
    t.is_known = 0;
    double gap = log_uniform(r, 1e-15, 1e-3);
    close_in(&t, random_next(r) % 2 ? gap : -gap);
    return t;
}

// --- what the data folder has

static clouds hulls, parts;
static int is_read;

static void read_once(void) {
    if (is_read) return;
    is_read = 1;
    hulls = clouds_read();
    parts = clouds_read_compounds();
}

void families_forget_data(void) {
    clouds_destroy(hulls);
    clouds_destroy(parts);
    hulls = parts = (clouds){NULL, 0};
    is_read = 0;
}

trial make_real_hulls(uint64_t *r) {
    read_once();
    if (hulls.count == 0) return (trial){0};
    const cloud *a = &hulls.items[random_next(r) % hulls.count], *b = &hulls.items[random_next(r) % hulls.count];
    ovoid_shape *of_a = make_points(a->xyz, a->count, 0), *of_b = make_points(b->xyz, b->count, 0);
    trial t = place_anywhere(r, of_a, of_b);
    double size = sphere_radius(t.a) + sphere_radius(t.b);
    double gap = size * log_uniform(r, 1e-15, 0.1);
    if (random_next(r) % 2) close_in(&t, random_next(r) % 2 ? gap : -gap);
    return t;
}

// Two parts of one object, where they are: neighbours share what the decomposition left them.
trial make_compound_parts(uint64_t *r) {
    read_once();
    if (parts.count == 0) return (trial){0};
    size_t i = (size_t)(random_next(r) % parts.count), first = i, last = i;
    while (first > 0 && parts.items[first - 1].object == parts.items[i].object) first--;
    while (last + 1 < parts.count && parts.items[last + 1].object == parts.items[i].object) last++;
    const cloud *a = &parts.items[i], *b = &parts.items[first + (size_t)(random_next(r) % (last - first + 1))];
    trial t = {make_points(a->xyz, a->count, 0),
               make_points(b->xyz, b->count, 0),
               {{0, 0, 0}, {1, 0, 0, 0}},
               {{0, 0, 0}, {1, 0, 0, 0}},
               0,
               0};
    if (random_next(r) % 2) t.pose_a = t.pose_b = random_pose(r, 10);
    return t;
}
