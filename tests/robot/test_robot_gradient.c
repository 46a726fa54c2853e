// Gradients of near pairs by the robot's variables. Truth: central differences of the distance in long double, links
// posed by exact_robot.h, bodies as the triangles of boxes and tetrahedra, each edge against each edge and each corner
// against each triangle. Differences are off by some 1e-11; on machines whose long double is a double it is skipped.
#include "check.h"
#include "exact_robot.h"
#include "robots.h"

enum { CORNERS = 8, TRIANGLES = 12, KINDS = 3, MOST = 40 };
typedef struct point {
    real x[3];
} point;
typedef struct solid {
    point corners[CORNERS];
    int corner_count, triangle_count;
    int triangles[TRIANGLES][3];
} solid;

static ovoid_error error;
static ovoid_shape *shapes[KINDS];
static solid solids[KINDS];

static real dot(point a, point b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]; }
static point along(point a, real t, point d) {
    return (point){{a.x[0] + t * d.x[0], a.x[1] + t * d.x[1], a.x[2] + t * d.x[2]}};
}
static point minus(point a, point b) { return along(a, -1, b); }
static point cross(point a, point b) {
    return (point){
        {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
static real clamp(real t) { return t < 0 ? 0 : t > 1 ? 1 : t; }

// Squares of distances. A corner of a segment is looked at by the triangles, or by the other segment's clamp.
static real measure_segments(point a, point b, point c, point d) {
    point u = minus(b, a), v = minus(d, c), w = minus(a, c);
    real uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w), det = uu * vv - uv * uv;
    real s = det > 0 ? clamp((uv * vw - vv * uw) / det) : 0, t = clamp((uv * s + vw) / vv);
    s = clamp((uv * t - uw) / uu);
    point apart = minus(along(a, s, u), along(c, t, v));
    return dot(apart, apart);
}

// Of a point to the plane of a triangle, where its foot is inside; else infinity, as an edge is nearer.
static real measure_face(point p, point a, point b, point c) {
    point n = cross(minus(b, a), minus(c, a));
    if (dot(cross(minus(b, a), minus(p, a)), n) < 0 || dot(cross(minus(c, b), minus(p, b)), n) < 0 ||
        dot(cross(minus(a, c), minus(p, c)), n) < 0)
        return INFINITY;
    real h = dot(minus(p, a), n);
    return h * h / dot(n, n);
}

static real measure_corners(const point *corners, int count, const point *other, const solid *of) {
    real best = INFINITY;
    for (int i = 0; i < count; i++)
        for (int t = 0; t < of->triangle_count; t++) {
            const int *v = of->triangles[t];
            best = fminl(best, measure_face(corners[i], other[v[0]], other[v[1]], other[v[2]]));
        }
    return best;
}

static real measure(const solid *a, const point *pa, const solid *b, const point *pb) {
    real best = fminl(measure_corners(pa, a->corner_count, pb, b), measure_corners(pb, b->corner_count, pa, a));
    for (int i = 0; i < 3 * a->triangle_count; i++)
        for (int k = 0; k < 3 * b->triangle_count; k++) {
            const int *u = a->triangles[i / 3], *v = b->triangles[k / 3];
            best = fminl(best, measure_segments(pa[u[i % 3]], pa[u[(i + 1) % 3]], pb[v[k % 3]], pb[v[(k + 1) % 3]]));
        }
    return sqrtl(best);
}

static void pose_solid(const solid *s, const exact_frame *f, point *out) {
    for (int i = 0; i < s->corner_count; i++)
        for (int k = 0; k < 3; k++) {
            const real *x = s->corners[i].x;
            out[i].x[k] = f->p[k] + f->r[k][0] * x[0] + f->r[k][1] * x[1] + f->r[k][2] * x[2];
        }
}

static void add_corner(solid *s, double x, double y, double z) { s->corners[s->corner_count++] = (point){{x, y, z}}; }

static void make_shapes(uint64_t *seed) {
    static const int box[TRIANGLES][3] = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    static const int tetrahedron[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    for (int i = 0; i < 8; i++) add_corner(&solids[0], i & 1 ? 0.1 : -0.1, i & 2 ? 0.05 : -0.05, i & 4 ? 0.2 : -0.2);
    solids[0].triangle_count = TRIANGLES;
    memcpy(solids[0].triangles, box, sizeof box);
    for (int kind = 1; kind < KINDS; kind++) {
        for (int i = 0; i < 4; i++) {
            ovoid_vec3 v = random_vec3(seed, 0.2);
            add_corner(&solids[kind], v.x, v.y, v.z);
        }
        solids[kind].triangle_count = 4;
        memcpy(solids[kind].triangles, tetrahedron, sizeof tetrahedron);
    }
    for (int kind = 0; kind < KINDS; kind++) {
        double xyz[3 * CORNERS];
        for (int i = 0; i < 3 * solids[kind].corner_count; i++) xyz[i] = (double)solids[kind].corners[i / 3].x[i % 3];
        shapes[kind] = ovoid_shape_create_from_points(xyz, (size_t)solids[kind].corner_count, NULL, &error);
        if (!shapes[kind]) exit(1);
    }
}

// A robot of which link i has the shape i % KINDS, in its frame.
static ovoid_robot *make_robot(uint64_t *s, random_robot *a) {
    make_random_robot(s, a);
    for (uint32_t i = 0; i < a->d.link_count; i++)
        a->elements[i] = (ovoid_robot_element){i, NULL, shapes[i % KINDS], ovoid_pose_make_identity(), NULL};
    a->d.element_count = a->d.link_count;
    return ovoid_robot_create(&a->d, NULL, &error);
}

static real find_distance(const ovoid_robot *r, const double *q, const ovoid_robot_near *of) {
    exact_frame frames[ROBOT_LINKS];
    point a[CORNERS], b[CORNERS];
    exact_poses(r, q, frames);
    const solid *sa = &solids[of->a.link % KINDS], *sb = &solids[of->b.link % KINDS];
    pose_solid(sa, &frames[of->a.link], a);
    pose_solid(sb, &frames[of->b.link], b);
    return measure(sa, a, sb, b);
}

static long compared, uneven;
static double worst;

static void compare(const ovoid_robot *r, double *q, const ovoid_robot_near *of, const double *row) {
    real here = find_distance(r, q, of);
    CHECK_LE(of->lower, (double)here + 1e-16);
    CHECK_LE((double)here, of->upper + 1e-16);
    for (size_t v = 0; v < ovoid_robot_get_variable_count(r); v++) {
        double at = q[v];
        real d[2];
        for (int k = 0; k < 2; k++) {
            double h = k ? 0x1p-21 : 0x1p-20;
            q[v] = at + h;
            real high = find_distance(r, q, of), right = q[v];
            q[v] = at - h;
            d[k] = (high - find_distance(r, q, of)) / (right - q[v]);
        }
        q[v] = at;
        // Where the two widths differ another corner or edge becomes the nearest, and the difference tells nothing.
        uneven += fabsl(d[0] - d[1]) > 1e-10L;
        if (fabsl(d[0] - d[1]) > 1e-10L) continue;
        CHECK_NEAR(row[v], (double)d[1], 1e-9);
        worst = fmax(worst, fabs(row[v] - (double)d[1]));
        compared++;
    }
}

static void test_gradients(uint64_t *s) {
    for (int round = 0; round < 120; round++) {
        random_robot a;
        double q[7 * ROBOT_LINKS];
        static double rows[MOST * 7 * ROBOT_LINKS];
        static ovoid_robot_near items[MOST];
        check_seed = (uint64_t)round;
        ovoid_robot *r = make_robot(s, &a);
        ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
        ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
        if (!x) exit(1);
        make_random_state(s, r, q);
        ovoid_robot_query_options options = {.margin = 0.5, .limit_slack = INFINITY};
        ovoid_robot_nears nears = {.items = items, .gradients = rows, .capacity = MOST};
        CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, &options}, &nears, &error), OVOID_OK);
        size_t n = ovoid_robot_get_variable_count(r), kept = nears.count < MOST ? nears.count : MOST;
        for (size_t i = 0; i < kept; i += 5)
            if (items[i].has_gradient && items[i].lower > 0.01) compare(r, q, &items[i], rows + i * n);
        ovoid_robot_checker_destroy(x);
        ovoid_robot_cell_destroy(cell);
        ovoid_robot_destroy(r);
    }
    check_seed = 0;
    CHECK_LE(1000, compared);
    CHECK_LE(20 * uneven, compared);
    printf("%ld derivatives, off by %.2g at most; %ld where the distance bends\n", compared, worst, uneven);
}

int main(void) {
    uint64_t s = 21;
    if (LDBL_MANT_DIG < 64) {
        check_skip("long double is no longer than double here");
        return check_end();
    }
    make_shapes(&s);
    test_gradients(&s);
    for (int i = 0; i < KINDS; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
