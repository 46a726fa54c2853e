// Surfaces around the origin, which prove overlaps and depths (pair/cover.h, pair/hull.h): what is claimed must hold
// for every surface whose corners are off by `error`. Errors of a thousandth of the size make that visible in doubles.
// Truth: the corners are moved by `error` to where it hurts most, toward the origin along a triangle's normal, and at
// random; the moved surface's distance, by the nearest points of its triangles, and its winding number, by solid
// angles, are measured here, with nothing of the library's but vectors. Also what must be proven: plain surfaces,
// either side out.
#include "check.h"
#include "distances.h"
#include "exact/expand.h"
#include "linear/mat3.h"
#include "pair/cover.h"
#include "pair/fine.h"
#include "pair/hull.h"

enum { MOST = 64 };

/// A closed surface.
typedef struct body {
    vec3 w[MOST];
    uint16_t t[2 * MOST][3];
    uint32_t points, triangles;
} body;

static vec3 random_vec3(uint64_t *s) {
    double x = random_normal(s), y = random_normal(s), z = random_normal(s);
    return (vec3){x, y, z};
}

// ---- the truth: J. van Oosterom, J. Strackee, The solid angle of a plane triangle, 1983; C. Ericson, Real-time
// collision detection, 2005, for the regions of a triangle.

static double solid_angle(vec3 a, vec3 b, vec3 c) {
    double la = vec3_norm(a), lb = vec3_norm(b), lc = vec3_norm(c);
    double below = la * lb * lc + vec3_dot(a, b) * lc + vec3_dot(b, c) * la + vec3_dot(c, a) * lb;
    return 2 * atan2(vec3_dot(a, vec3_cross(b, c)), below);
}

static long winding_of(const body *x) {
    double sum = 0;
    for (uint32_t i = 0; i < x->triangles; i++)
        sum += solid_angle(x->w[x->t[i][0]], x->w[x->t[i][1]], x->w[x->t[i][2]]);
    return lround(sum / (4 * 3.141592653589793));
}

static double distance_of(const body *x) {
    double least = INFINITY;
    for (uint32_t i = 0; i < x->triangles; i++)
        least = fmin(least, triangle_distance(x->w[x->t[i][0]], x->w[x->t[i][1]], x->w[x->t[i][2]]));
    return least;
}

// ---- bodies

static const uint16_t faces_of_four[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/// The triangles that hull_compute_depth means.
static void set_hull_triangles(body *x) {
    if (x->points == 4) {
        memcpy(x->t, faces_of_four, sizeof faces_of_four);
        x->triangles = 4;
        return;
    }
    uint16_t ring = (uint16_t)(x->points - 2);
    x->triangles = 0;
    for (uint16_t i = 0; i < ring; i++) {
        uint16_t from = (uint16_t)(2 + i), to = (uint16_t)(2 + (i + 1) % ring);
        memcpy(x->t[x->triangles++], (uint16_t[3]){0, from, to}, sizeof *x->t);
        memcpy(x->t[x->triangles++], (uint16_t[3]){1, to, from}, sizeof *x->t);
    }
}

/// The hull of random points, of more or less even extents.
static int make_body(body *x, uint64_t *s, int count) {
    static expansion e;
    static expansion_room room;
    expansion_room_give(&room, &e);
    vec3 w[MOST];
    double thin = random_next(s) % 3 == 0 ? 0.05 : 1;
    for (int i = 0; i < count; i++) {
        w[i] = random_vec3(s);
        w[i].z *= thin;
    }
    if (!expansion_make_hull(&e, w, count, 1e-14)) return 0;
    x->points = e.points;
    x->triangles = expansion_pack(&e);
    memcpy(x->t, e.triangles, x->triangles * sizeof *x->t);
    memcpy(x->w, e.w, e.points * sizeof *e.w);
    return 1;
}

/// Moves the body so that the origin is some errors away from one of its triangles, inside or out.
static void bring_near(body *x, uint64_t *s, double error) {
    const uint16_t *t = x->t[random_next(s) % x->triangles];
    double u = random_uniform(s, 0, 1), v = random_uniform(s, 0, 1 - u);
    // At times near an edge or a corner.
    if (random_next(s) % 3 == 0) u *= 1e-3;
    if (random_next(s) % 3 == 0) v *= 1e-3;
    vec3 a = x->w[t[0]], e1 = vec3_sub(x->w[t[1]], a), e2 = vec3_sub(x->w[t[2]], a);
    vec3 n = vec3_unit(vec3_cross(e1, e2)), at = vec3_add_scaled(vec3_add_scaled(a, e1, u), e2, v);
    double far = random_next(s) % 2 ? 100 : 5;
    at = vec3_add_scaled(at, n, error * random_uniform(s, -far, far));
    for (uint32_t i = 0; i < x->points; i++) x->w[i] = vec3_sub(x->w[i], at);
}

static void turn_over(body *x) {
    for (uint32_t i = 0; i < x->triangles; i++) {
        uint16_t v = x->t[i][1];
        x->t[i][1] = x->t[i][2];
        x->t[i][2] = v;
    }
}

// ---- what is claimed holds

static long proven, refused;

/// The corners of a triangle moved by `error` toward the origin, or all corners anywhere.
static body moved(const body *x, uint64_t *s, double error, uint32_t triangle) {
    body y = *x;
    if (triangle == UINT32_MAX) {
        for (uint32_t i = 0; i < x->points; i++) y.w[i] = vec3_add_scaled(x->w[i], vec3_unit(random_vec3(s)), error);
        return y;
    }
    const uint16_t *t = x->t[triangle];
    vec3 n = vec3_unit(vec3_cross(vec3_sub(x->w[t[1]], x->w[t[0]]), vec3_sub(x->w[t[2]], x->w[t[0]])));
    if (vec3_dot(n, x->w[t[0]]) < 0) n = vec3_neg(n);
    for (int k = 0; k < 3; k++) y.w[t[k]] = vec3_add_scaled(x->w[t[k]], n, -error);
    return y;
}

static void check_claim(const body *x, uint64_t *s, double depth, double error) {
    if (!(depth > 0)) {
        refused++;
        return;
    }
    proven++;
    CHECK(winding_of(x) != 0);
    for (uint32_t i = 0; i <= x->triangles; i++) {
        body y = moved(x, s, error, i < x->triangles ? i : UINT32_MAX);
        CHECK(winding_of(&y) != 0);
        CHECK_LE(depth, distance_of(&y) * (1 + 1e-9) + 1e-12);
    }
}

static void check_hull(uint64_t *s, uint32_t count, double error) {
    body x = {.points = count};
    for (uint32_t i = 0; i < count; i++) x.w[i] = random_vec3(s);
    // A ring around the tips' line, at times.
    if (count > 4 && random_next(s) % 2)
        for (uint32_t i = 2; i < count; i++) {
            double angle = 6.283185307179586 * i / (count - 2);
            x.w[i] = vec3_add_scaled((vec3){cos(angle), sin(angle), 0}, x.w[i], 0.2);
        }
    if (count > 4) x.w[0].z = 2, x.w[1].z = -2;
    set_hull_triangles(&x);
    bring_near(&x, s, error);
    check_claim(&x, s, hull_compute_depth(x.w, (int)count, error), error);
    check_claim(&x, s, hull_compute_clearance(x.w, (int)count, error), error);
    // In double-double, in units of 1 and without radii.
    fine_frame f = {.unit = 1};
    dd3 w[6];
    for (uint32_t i = 0; i < count; i++) w[i] = dd3_from(x.w[i]);
    check_claim(&x, s, -fine_measure_hull(&f, w, (int)count, error), error);
}

static void check_surface(uint64_t *s, double error) {
    body x;
    if (!make_body(&x, s, 4 + (int)(random_next(s) % 30))) return;
    bring_near(&x, s, error);
    if (random_next(s) % 2) turn_over(&x);
    surface all = surface_make(x.w, x.points, (const uint16_t(*)[3])x.t, x.triangles);
    CHECK(surface_is_closed(&all));
    check_claim(&x, s, surface_compute_depth(&all, error), error);
}

// ---- surfaces that wind zero times, and such that are not closed

/// A body within another, turned over: around the origin, and yet it proves nothing.
static void check_nested(uint64_t *s) {
    body in, out;
    if (!make_body(&in, s, 12) || !make_body(&out, s, 12) || winding_of(&in) != 1 || winding_of(&out) != 1) return;
    turn_over(&in);
    body x = out;
    for (uint32_t i = 0; i < in.points; i++) x.w[out.points + i] = vec3_scale(in.w[i], 0.1);
    for (uint32_t i = 0; i < in.triangles; i++)
        for (int k = 0; k < 3; k++) x.t[out.triangles + i][k] = (uint16_t)(in.t[i][k] + out.points);
    x.points += in.points;
    x.triangles += in.triangles;
    surface all = surface_make(x.w, x.points, (const uint16_t(*)[3])x.t, x.triangles);
    CHECK(surface_is_closed(&all));
    CHECK_EQ(winding_of(&x), 0);
    CHECK_EQ(surface_compute_depth(&all, 1e-12), 0);
    // Both the same side out wind twice.
    for (uint32_t i = out.triangles; i < x.triangles; i++) {
        uint16_t v = x.t[i][1];
        x.t[i][1] = x.t[i][2], x.t[i][2] = v;
    }
    CHECK_EQ(winding_of(&x), 2);
    CHECK(surface_compute_depth(&all, 1e-12) > 0);
}

/// Either side out, a body around the origin is proven to the last per cent; beside it, nothing is.
static void check_plain(uint64_t *s) {
    body x;
    if (!make_body(&x, s, 20)) return;
    for (int side = 0; side < 2; side++) {
        surface all = surface_make(x.w, x.points, (const uint16_t(*)[3])x.t, x.triangles);
        double depth = surface_compute_depth(&all, 1e-14), distance = distance_of(&x);
        if (winding_of(&x) == 0)
            CHECK_EQ(depth, 0);
        else if (distance > 1e-9)
            CHECK_NEAR(depth, distance, 1e-2 * distance);
        turn_over(&x);
    }
}

static void check_holes(uint64_t *s) {
    body x;
    if (!make_body(&x, s, 16)) return;
    surface all = surface_make(x.w, x.points, (const uint16_t(*)[3])x.t, x.triangles - 1);
    CHECK(!surface_is_closed(&all));
    // One triangle turned over; one twice; one index too large; a triangle of two corners.
    all.triangle_count++;
    body y = x;
    y.t[0][1] = x.t[0][2], y.t[0][2] = x.t[0][1];
    all.triangles = (const uint16_t(*)[3])y.t;
    CHECK(!surface_is_closed(&all));
    memcpy(y.t[0], x.t[0], sizeof *y.t);
    memcpy(y.t[x.triangles], x.t[1], sizeof *y.t);
    all.triangle_count = x.triangles + 1;
    CHECK(!surface_is_closed(&all));
    // The same triangle both ways, beside the body: closed edges, but each is met twice.
    memcpy(y.t[x.triangles + 1], (uint16_t[3]){x.t[1][0], x.t[1][2], x.t[1][1]}, sizeof *y.t);
    all.triangle_count = x.triangles + 2;
    CHECK(!surface_is_closed(&all));
    y = x;
    all.triangle_count = x.triangles;
    y.t[0][0] = (uint16_t)x.points;
    CHECK(!surface_is_closed(&all));
    y.t[0][0] = x.t[0][1];
    CHECK(!surface_is_closed(&all));
}

/// The hull of points that are almost on the faces of a box is convex, and holds them all, to a few roundings.
static void check_convex(uint64_t *s) {
    static expansion e;
    static expansion_room room;
    expansion_room_give(&room, &e);
    vec3 w[32];
    for (int i = 0; i < 32; i++) {
        double c[3] = {random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1)};
        c[i % 3] = (i / 3 % 2 ? 1 : -1) + random_uniform(s, 0, 1e-9);
        w[i] = (vec3){c[0], c[1], c[2]};
    }
    if (!expansion_make_hull(&e, w, 32, 1e-14)) return;
    for (uint32_t f = 0; f < e.faces; f++)
        for (int i = 0; i < 32 && e.f[f].alive; i++) CHECK_LE(vec3_dot(e.f[f].n, w[i]) - e.f[f].low, 1e-12);
}

// ---- in the caller's memory

enum { BALL = 900, MOVED_AT = 40 };

/// What the expansion finds by its tournament and its index, and what a look at each face and point finds.
static void check_found(expansion *e) {
    double least = INFINITY;
    for (uint32_t i = 0; i < e->faces; i++)
        if (e->f[i].alive) least = fmin(least, e->f[i].low);
    uint16_t nearest = expansion_find_nearest(e);
    CHECK(e->f[nearest].alive && e->f[nearest].low == least);
    for (uint32_t a = 0; a < BALL; a += 7) {
        int is_there = 0;
        for (uint32_t i = 0; i < e->points; i++) is_there |= e->a[i] == a && e->b[i] == a % 5;
        CHECK_EQ(expansion_has_point(e, a, a % 5), is_there);
        CHECK(!expansion_has_point(e, a, 5));
    }
}

static uint32_t find_farthest(const vec3 *w, vec3 n) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < BALL; i++)
        if (vec3_dot(w[i], n) > vec3_dot(w[best], n)) best = i;
    return best;
}

/// A ball of random points that grows as EPA would have it, moved on the way. `most`: points that the memory holds;
/// some of a ball whose points nearly all are needed are too many for little memory.
static void check_moved(uint64_t *s, uint32_t most) {
    static vec3 w[BALL];
    static expansion e;
    static expansion_room room;
    void *memory = malloc(expansion_get_room_size(most));
    for (int i = 0; i < BALL; i++) {
        vec3 v = {random_normal(s), random_normal(s), random_normal(s)};
        w[i] = vec3_unit(v);
    }
    expansion_room_give(&room, &e);
    expansion_clear(&e, 1e-14);
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t k = find_farthest(w, (vec3[4]){{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}[i]);
        (void)expansion_add_point(&e, w[k], k, k % 5);
    }
    expansion_make_tetrahedron(&e);
    while (e.points < most) {
        if (e.points == MOVED_AT) expansion_move(&e, memory, most);
        if (e.points % 16 == 0) check_found(&e);
        uint16_t nearest = expansion_find_nearest(&e);
        uint32_t k = find_farthest(w, e.f[nearest].n);
        if (expansion_has_point(&e, k, k % 5)) break;
        uint32_t faces = e.faces;
        if (!expansion_join(&e, nearest, expansion_add_point(&e, w[k], k, k % 5))) {
            CHECK(faces + 8 > e.most_faces);
            break;
        }
    }
    check_found(&e);
    CHECK_LE(2 * MOVED_AT, e.points);
    free(memory);
}

// A corner that is none of the surface's points, though the memory behind them may hold one; and edges that nothing
// closes.
static void check_closed(void) {
    static const vec3 w[5] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {1, 1, 1}};
    uint16_t t[4][3];
    surface x = surface_make(w, 4, (const uint16_t(*)[3])t, 4);
    memcpy(t, faces_of_four, sizeof t);
    CHECK(surface_is_closed(&x));
    for (int v = 0; v < 4; v++) {
        memcpy(t, faces_of_four, sizeof t);
        for (int i = 0; i < 12; i++)
            if (t[i / 3][i % 3] == v) t[i / 3][i % 3] = 4;
        CHECK(!surface_is_closed(&x));
        x.point_count = 5;
        CHECK(surface_is_closed(&x));
        x.point_count = 4;
    }
    for (int i = 0; i < 12; i++) {
        memcpy(t, faces_of_four, sizeof t);
        t[i / 3][i % 3] = (uint16_t)((t[i / 3][i % 3] + 1) % 4);
        CHECK(!surface_is_closed(&x));
    }
    memcpy(t, faces_of_four, sizeof t);
    x.triangle_count = 3;
    CHECK(!surface_is_closed(&x));
    x.triangle_count = 0;
    CHECK(!surface_is_closed(&x));
}

int main(void) {
    check_closed();
    for (uint64_t seed = 0; seed < 3000; seed++) {
        uint64_t s = check_seed = seed;
        double error = seed % 3 == 0 ? 1e-2 : seed % 3 == 1 ? 1e-3 : 1e-6;
        for (uint32_t count = 4; count <= 6; count++) check_hull(&s, count, error);
        check_surface(&s, error);
        if (seed % 10) continue;
        check_nested(&s);
        check_plain(&s);
        check_holes(&s);
        check_convex(&s);
        if (seed % 100 == 0) check_moved(&s, seed % 200 ? 2 * BALL : 100);
    }
    printf("%ld proven, %ld refused\n", proven, refused);
    CHECK(proven > 1000 && refused > 1000);
    return check_end();
}
