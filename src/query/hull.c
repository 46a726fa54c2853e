#include "query/hull.h"

#include "query/cover.h"
#include "query/expand.h"

static const uint16_t tetrahedron[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

// A tetrahedron by its determinants: the origin is inside iff the four have one sign. A determinant of corners off by
// `error` is off by 4 reach^2 error, its evaluation by 64 u reach^3; a cross product by 8 reach (error + 4 u reach).
// Corners of about unit length: no square can underflow to where it loses digits. 0: in doubt; -1: outside.
static double compact_tetrahedron_depth(const vec3 w[4], double reach, double error) {
    double slack = reach * reach * (4 * error + 64 * 0x1p-53 * reach), depth = INFINITY;
    int above = 0, below = 0;
    for (int i = 0; i < 4; i++) {
        vec3 a = w[tetrahedron[i][0]], b = w[tetrahedron[i][1]], c = w[tetrahedron[i][2]];
        double det = vec3_dot(a, vec3_cross(b, c));
        above += det > slack;
        below += det < -slack;
        double area = vec3_norm(vec3_cross(vec3_sub(b, a), vec3_sub(c, a))) + 8 * reach * (error + 4 * 0x1p-53 * reach);
        depth = fmin(depth, (fabs(det) - slack) / area * (1 - 0x1p-50));
    }
    if (above > 0 && below > 0) return -1;
    return above == 4 || below == 4 ? depth : 0;
}

// In units of the corners' size.
static double tetrahedron_depth(const vec3 w[4], double error) {
    double reach = 0;
    for (int i = 0; i < 4; i++) reach = fmax(reach, vec3_max_abs(w[i]));
    double unit = ldexp(1, -find_unit_exponent(reach));
    vec3 compact[4];
    for (int i = 0; i < 4; i++) compact[i] = vec3_scale(w[i], unit);
    double depth = compact_tetrahedron_depth(compact, 2, error * unit);
    return depth > 0 ? depth / unit * (1 - 0x1p-50) : depth;
}

static double double_pyramid_depth(const vec3 *w, int count, double error) {
    uint16_t triangles[8][3];
    int ring = count - 2;
    for (int i = 0; i < ring; i++) {
        uint16_t from = (uint16_t)(2 + i), to = (uint16_t)(2 + (i + 1) % ring);
        triangles[2 * i][0] = 0, triangles[2 * i][1] = from, triangles[2 * i][2] = to;
        triangles[2 * i + 1][0] = 1, triangles[2 * i + 1][1] = to, triangles[2 * i + 1][2] = from;
    }
    surface s = {w, (const uint16_t(*)[3])triangles, (uint32_t)count, (uint32_t)(2 * ring)};
    return surface_compute_depth(&s, error);
}

double hull_compute_clearance(const vec3 *w, int count, double error) {
    surface s = {w, tetrahedron, 4, 4};
    if (count == 4) return surface_compute_depth(&s, error);
    return count == 5 || count == 6 ? double_pyramid_depth(w, count, error) : 0;
}

double hull_compute_depth(const vec3 *w, int count, double error) {
    double depth = count == 4 ? tetrahedron_depth(w, error) : 0;
    return depth != 0 ? fmax(depth, 0) : hull_compute_clearance(w, count, error);
}

// The hull of the points that are not dropped; its depth around the origin, 0 if it does not contain it.
static double depth_without(expansion *e, const vec3 *w, int count, const int *dropped, double error, double slack) {
    vec3 left[HULL_POINTS_MAX];
    int n = 0;
    for (int i = 0; i < count; i++)
        if (!dropped[i]) left[n++] = w[i];
    if (!expansion_make_hull(e, left, n, slack)) return 0;
    uint16_t triangles[EXPANSION_FACES][3];
    surface s = {e->w, (const uint16_t(*)[3])triangles, e->points, expansion_pack(e, triangles)};
    return surface_compute_depth(&s, error);
}

// The order of a double pyramid: two corners that no triangle joins, then the ring around the first.
static int order_as_double_pyramid(const expansion *e, int kept[6]) {
    int joined[6][6] = {{0}}, n = (int)e->points;
    for (uint32_t i = 0; i < e->faces; i++) {
        if (!e->f[i].alive) continue;
        for (int k = 0; k < 3; k++) joined[e->f[i].v[k]][e->f[i].v[(k + 1) % 3]] = 1;
    }
    for (int a = 0; a < n; a++)
        for (int b = a + 1; b < n; b++) {
            int ring = 0;
            for (int c = 0; c < n; c++) ring += c != a && c != b && joined[a][c] && joined[b][c];
            if (joined[a][b] || ring != n - 2) continue;
            // Walk around: from each ring corner to the next one that is joined and not met yet.
            int met[6] = {0}, order[6] = {a, b}, length = 2, at = -1;
            for (int c = 0; c < n && at < 0; c++)
                if (c != a && c != b) at = c;
            while (at >= 0) {
                met[at] = 1;
                order[length++] = at;
                int next = -1;
                for (int c = 0; c < n && next < 0; c++)
                    if (c != a && c != b && !met[c] && joined[at][c]) next = c;
                at = next;
            }
            if (length != n) continue;
            for (int i = 0; i < n; i++) kept[i] = order[i];
            return 1;
        }
    return 0;
}

int hull_find_few(const vec3 *w, int count, double error, double slack, int kept[6]) {
    expansion e;
    int dropped[HULL_POINTS_MAX] = {0}, left[HULL_POINTS_MAX], n = count;
    if (count > HULL_POINTS_MAX || !(depth_without(&e, w, count, dropped, error, slack) > 0)) return 0;
    for (int i = 0; i < count && n > 4; i++) {
        dropped[i] = 1;
        if (depth_without(&e, w, count, dropped, error, slack) > 0)
            n--;
        else
            dropped[i] = 0;
    }
    if (n > 6) return 0;
    n = 0;
    for (int i = 0; i < count; i++)
        if (!dropped[i]) left[n++] = i;
    int order[6] = {0, 1, 2, 3, 4, 5};
    vec3 few[6];
    for (int i = 0; i < n; i++) few[i] = w[left[i]];
    // The corners keep their order in the hull's own list only if it took all of them in turn.
    if (n > 4) {
        if (!expansion_make_hull(&e, few, n, slack) || e.points != (uint32_t)n || !order_as_double_pyramid(&e, order))
            return 0;
        for (int i = 0; i < n; i++) kept[i] = left[e.a[order[i]]];
    } else {
        for (int i = 0; i < n; i++) kept[i] = left[i];
    }
    return n;
}
