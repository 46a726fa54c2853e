// The hull and the measures of the polyhedra of ellipsoids.
//
// The points of a grid on the unit sphere are the vertices of their hull, and its facets are the grid's triangles, the
// same for every n up to GRID_STEPS_MOST (test_shape_ellipsoid.c compares each of them with the hull that is searched
// for). Scaling maps hulls to hulls. A vertex beyond a facet is below its plane by some 0.1 / n^2 of the plane's
// offset, whatever the half axes, which is far more than what rounding changes, as that is relative to each coordinate.
//
// The grid has the symmetries of an octahedron, so that sums over one octant stand for all, and the largest ball in it
// is around the centre. Its facets are nearest to the centre in the middles of the octahedron's faces, where the
// triangles are largest: they are at a distance of 1 - 1 / n^2 or more.
#include "polytope/ellipsoid_grid.h"

#include "linear/vec3.h"
#include "polytope/closed_form.h"

vec3 ellipsoid_grid_get_point(vec3 half, int x, int y, int z) {
    double length = sqrt((double)(x * x + y * y + z * z));
    return (vec3){half.x * (x / length), half.y * (y / length), half.z * (z / length)};
}

// ---- vertices

static uint32_t get_ring(uint32_t n, uint32_t k) { return k < n ? k : 2 * n - k; }
static uint32_t count_ring(uint32_t m) { return m ? 4 * m : 1; }

// The first vertex of ring k.
static uint32_t find_ring(uint32_t n, uint32_t k) {
    uint32_t m = get_ring(n, k);
    if (k <= n) return k ? 1 + 2 * k * (k - 1) : 0;
    return ellipsoid_grid_count_vertices(n) - (1 + 2 * m * (m + 1));
}

// Vertex i of ring k. + 0.0 makes every zero a positive one.
static vec3 find_vertex(vec3 half, uint32_t n, uint32_t k, uint32_t i) {
    int m = (int)get_ring(n, k), s = m ? (int)i % m : 0, x = m - s, y = s;
    for (int quarter = m ? (int)i / m : 0; quarter > 0; quarter--) {
        int turned = -y;
        y = x;
        x = turned;
    }
    return vec3_clear_signs(ellipsoid_grid_get_point(half, x, y, (int)n - (int)k));
}

void ellipsoid_grid_fill_vertices(vec3 half, uint32_t n, double *xyz) {
    for (uint32_t k = 0; k <= 2 * n; k++)
        for (uint32_t i = 0; i < count_ring(get_ring(n, k)); i++, xyz += 3) {
            vec3 v = find_vertex(half, n, k, i);
            xyz[0] = v.x, xyz[1] = v.y, xyz[2] = v.z;
        }
}

// ---- one octant
//
// Triangle `at` of the band between rings k and k + 1, on the unit sphere: even ones have one corner above, odd ones
// two.

static vec3 get_octant_point(uint32_t n, uint32_t k, uint32_t s) {
    return ellipsoid_grid_get_point((vec3){1, 1, 1}, (int)(k - s), (int)s, (int)(n - k));
}

static void find_octant_triangle(uint32_t n, uint32_t k, uint32_t at, vec3 corner[3]) {
    uint32_t s = at / 2;
    corner[0] = get_octant_point(n, k, s);
    corner[1] = get_octant_point(n, k + 1, s + at % 2);
    corner[2] = at % 2 ? get_octant_point(n, k, s + 1) : get_octant_point(n, k + 1, s + 1);
}

static vec3 compute_area(const vec3 corner[3]) {
    return vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[2], corner[0]));
}

int ellipsoid_grid_make(vec3 half, uint32_t n, ellipsoid_grid *grid) {
    double least = min2(half.x, min2(half.y, half.z)), most = vec3_max_abs(half);
    if (n < GRID_STEPS_LEAST || n > GRID_STEPS_MOST || !(least >= GRID_FLATTEST * most) || !(most >= GRID_LEAST) ||
        !(most <= OVOID_LENGTH_MAX))
        return 0;
    *grid = (ellipsoid_grid){half, n, 1};
    for (uint32_t k = 0; k < n; k++)
        for (uint32_t at = 0; at <= 2 * k; at++) {
            vec3 corner[3];
            find_octant_triangle(n, k, at, corner);
            grid->ball = min2(grid->ball, vec3_dot(vec3_unit(compute_area(corner)), corner[0]));
        }
    return 1;
}

int ellipsoid_grid_find(const double *v, size_t count, ellipsoid_grid *grid) {
    if (count < 18 || v[0] != 0 || v[1] != 0 || count > 4 * GRID_STEPS_MOST * GRID_STEPS_MOST + 2) return 0;
    uint32_t n = (uint32_t)(sqrt((double)count) / 2);
    if (ellipsoid_grid_count_vertices(n) != count) return 0;
    uint32_t side = find_ring(n, n);
    vec3 half = {v[3 * (size_t)side], v[3 * ((size_t)side + n) + 1], v[2]};
    for (uint32_t k = 0; k <= 2 * n; k++)
        for (uint32_t i = 0; i < count_ring(get_ring(n, k)); i++, v += 3) {
            vec3 w = find_vertex(half, n, k, i);
            if (!(v[0] == w.x && v[1] == w.y && v[2] == w.z)) return 0;
        }
    return ellipsoid_grid_make(half, n, grid);
}

// ---- triangles

// Between a ring of m and one of m + 1 vertices a quarter, from their first vertices; counter-clockwise from outside
// where the wide one is below.
static uint32_t *put_band(uint32_t *to, uint32_t narrow, uint32_t wide, uint32_t m, int is_upper) {
    uint32_t around = 4 * (m + 1), within = count_ring(m);
    for (uint32_t quarter = 0; quarter < 4; quarter++)
        for (uint32_t s = 0; s <= m; s++) {
            uint32_t w = wide + quarter * (m + 1) + s, next = wide + (quarter * (m + 1) + s + 1) % around;
            uint32_t v = narrow + (quarter * m + s) % within;
            to = closed_form_put_triangle(to, v, is_upper ? w : next, is_upper ? next : w);
            if (s == m) continue;
            uint32_t beside = narrow + (quarter * m + s + 1) % within;
            to = closed_form_put_triangle(to, next, is_upper ? beside : v, is_upper ? v : beside);
        }
    return to;
}

void ellipsoid_grid_fill_triangles(const ellipsoid_grid *grid, uint32_t *triangles, uint32_t *facets) {
    uint32_t n = grid->steps, *to = triangles;
    for (uint32_t k = 0; k < n; k++) to = put_band(to, find_ring(n, k), find_ring(n, k + 1), k, 1);
    for (uint32_t k = n; k < 2 * n; k++) to = put_band(to, find_ring(n, k + 1), find_ring(n, k), 2 * n - k - 1, 0);
    for (uint32_t i = 0; i < ellipsoid_grid_count_triangles(n); i++) facets[i] = i;
}

// ---- planes and measures

// The normal of the triangle on the unit sphere, over the half axes.
void ellipsoid_grid_fill_planes(const ellipsoid_grid *grid, const uint32_t *triangles, const double *vertices,
                                ovoid_plane *planes) {
    vec3 a = grid->half;
    for (uint32_t t = 0; t < ellipsoid_grid_count_triangles(grid->steps); t++) {
        vec3 v[3], corner[3];
        for (size_t k = 0; k < 3; k++) {
            v[k] = vec3_at(vertices, triangles[3 * (size_t)t + k]);
            corner[k] = (vec3){v[k].x / a.x, v[k].y / a.y, v[k].z / a.z};
        }
        vec3 area = compute_area(corner), normal = vec3_unit((vec3){area.x / a.x, area.y / a.y, area.z / a.z});
        double offset = max2(vec3_dot(normal, v[0]), max2(vec3_dot(normal, v[1]), vec3_dot(normal, v[2])));
        planes[t] = (ovoid_plane){vec3_clear_signs(normal), offset};
    }
}

// Over the tetrahedron of the centre and a triangle of determinant d, x^2 has the integral d / 120 times the sum of the
// corners' squares and the square of their sum.
ovoid_measures ellipsoid_grid_compute_measures(const ellipsoid_grid *grid) {
    vec3 a = grid->half;
    double volume = 0, area = 0, square = 0;
    for (uint32_t k = 0; k < grid->steps; k++)
        for (uint32_t at = 0; at <= 2 * k; at++) {
            vec3 c[3];
            find_octant_triangle(grid->steps, k, at, c);
            vec3 n = compute_area(c), sum = vec3_add(c[0], vec3_add(c[1], c[2]));
            double d = vec3_dot(n, c[0]);
            volume += d / 6;
            // Areas scale by the other two half axes; integrals of x^2, y^2 and z^2 over the sphere's are equal.
            area += vec3_norm((vec3){n.x * a.y * a.z, n.y * a.z * a.x, n.z * a.x * a.y}) / 2;
            double squares = vec3_norm_squared(c[0]) + vec3_norm_squared(c[1]) + vec3_norm_squared(c[2]);
            square += d / 120 * (squares + vec3_norm_squared(sum)) / 3;
        }
    double product = a.x * a.y * a.z, scale = 8 * square * product;
    double xx = scale * (a.x * a.x), yy = scale * (a.y * a.y), zz = scale * (a.z * a.z);
    return (ovoid_measures){
        .volume = 8 * volume * product, .area = 8 * area, .inertia = {.xx = yy + zz, .yy = zz + xx, .zz = xx + yy}};
}
