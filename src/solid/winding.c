// How often a closed surface winds around a point: the signed crossings of the ray from the point toward +x.
//
// Every sign is that of an exact determinant. If the ray meets an edge or a corner, the point is moved by (0, e, e^2)
// with an infinitesimal e, so that it meets none (H. Edelsbrunner, E. P. Muecke, Simulation of simplicity, 1990): seen
// along x, a point is then left or right of each edge whose ends are different, and an edge whose ends are the same
// bounds no area. The side of an edge is computed with its ends in the order of their indices, so both triangles of an
// edge agree. The only case left open is a point on a triangle.
#include "base/environment.h"
#include "linear/exact.h"
#include "solid/solid.h"

static int sign_of(double x) { return (x > 0) - (x < 0); }

// The side of the edge from a to b on which p is, seen along x: 1 left, -1 right; 0: the edge is a point.
static int find_side(vec3 p, vec3 ahead, vec3 a, vec3 b) {
    int side = orient3d_sign(p, ahead, a, b);
    if (side) return side;
    // The determinant's change as p moves along y, then along z.
    side = sign_of(b.z - a.z);
    return side ? side : -sign_of(b.y - a.y);
}

static int find_side_of_edge(vec3 p, vec3 ahead, const vec3 corner[3], const uint32_t index[3], int i) {
    int j = (i + 1) % 3;
    return index[i] < index[j] ? find_side(p, ahead, corner[i], corner[j]) : -find_side(p, ahead, corner[j], corner[i]);
}

static double max3(double a, double b, double c) { return max2(a, max2(b, c)); }
static double min3(double a, double b, double c) { return min2(a, min2(b, c)); }

// 1 if the point, which is in the triangle's box, is on the triangle: in its plane, and not beside it along any axis.
static int is_on(vec3 p, const vec3 c[3]) {
    if (orient3d_sign(c[0], c[1], c[2], p) != 0) return 0;
    for (int axis = 0; axis < 3; axis++) {
        vec3 ahead = {p.x + 4 * (axis == 0), p.y + 4 * (axis == 1), p.z + 4 * (axis == 2)};
        int left = 0, right = 0;
        for (int i = 0; i < 3; i++) {
            int side = orient3d_sign(p, ahead, c[i], c[(i + 1) % 3]);
            left |= side > 0;
            right |= side < 0;
        }
        if (left && right) return 0;
    }
    return 1;
}

int ray_count_crossing(vec3 p, const vec3 c[3], const uint32_t index[3]) {
    if (min3(c[0].y, c[1].y, c[2].y) > p.y || max3(c[0].y, c[1].y, c[2].y) < p.y) return 0;
    if (min3(c[0].z, c[1].z, c[2].z) > p.z || max3(c[0].z, c[1].z, c[2].z) < p.z) return 0;
    double far = max3(c[0].x, c[1].x, c[2].x), near = min3(c[0].x, c[1].x, c[2].x);
    if (far < p.x) return 0;
    if (near <= p.x && is_on(p, c)) return 2;
    vec3 ahead = {p.x + 4, p.y, p.z};
    int s0 = find_side_of_edge(p, ahead, c, index, 0), s1 = find_side_of_edge(p, ahead, c, index, 1);
    if (s0 != s1 || s0 == 0) return 0;
    if (find_side_of_edge(p, ahead, c, index, 2) != s0) return 0;
    if (near > p.x) return -s0;
    int above = orient3d_sign(c[0], c[1], c[2], p);
    return above == 0 ? 2 : above == -s0 ? above : 0;
}

// The ray in the solid's unit, for exact signs, and in the tree's frame, for its boxes.
typedef struct ray {
    vec3 p;
    double scale;
    int64_t winding;
} ray;

static int cross(ray *r, const ovoid_solid *s, uint32_t place) {
    vec3 corner[3];
    for (int i = 0; i < 3; i++) corner[i] = vec3_scale(solid_get_corner(s, place, i), r->scale);
    int crossing = ray_count_crossing(r->p, corner, s->triangles[place].point);
    if (crossing == 2) return 0;
    r->winding += crossing;
    return 1;
}

static int cross_tree(ray *r, const ovoid_solid *s, vec3 point) {
    enum { ROOM = 64 };
    uint32_t places[ROOM], found;
    vec3 p = vec3_scale(vec3_sub(point, s->center), 1 / s->unit);
    // The boxes are rounded outward by more than the error of this difference; the ray's box is rounded outward again.
    const double ends[6] = {p.x, p.y, p.z, 4, p.y, p.z};
    box8_walk walk;
    box8_begin(&walk, s->boxes, ends);
    while ((found = box8_find_leaves(&walk, places, ROOM)) > 0)
        for (uint32_t i = 0; i < found; i++)
            if (!cross(r, s, places[i])) return 0;
    return walk.count == 0;
}

int solid_find_winding(const ovoid_solid *s, vec3 point, int linear, int64_t *winding) {
    if (!s->report.is_closed || !vec3_is_finite(point)) return 0;
    const ovoid_box *b = &s->report.box;
    int is_outside = point.x < b->min.x || point.x > b->max.x || point.y < b->min.y || point.y > b->max.y ||
                     point.z < b->min.z || point.z > b->max.z;
    ray r = {.winding = 0};
    if (!is_outside) {
        r.scale = ldexp(1, -find_unit_exponent(s->extent));
        r.p = vec3_scale(point, r.scale);
        if (!linear && !cross_tree(&r, s, point)) return 0;
        for (uint32_t i = 0; linear && i < s->triangle_count; i++)
            if (!cross(&r, s, i)) return 0;
    }
    *winding = r.winding;
    return 1;
}

int ovoid_solid_compute_winding(const ovoid_solid *solid, ovoid_vec3 point, int64_t *winding) {
    ENVIRONMENT_RETURN(int, point, solid_find_winding(solid, point, 0, winding));
}
