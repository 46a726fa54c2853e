// Theorem. The box less the triangle is a polytope, of which the origin's depth is sought. Its facets look along the
// box's axes, along the triangle's normal, or along the cross product of an axis and an edge, each way (S. Gottschalk,
// M. C. Lin, D. Manocha, OBBTree: a hierarchical structure for rapid interference detection, 1996). Along any unit n
// the origin is h(n) = sum half_k |n_k| - least n.v below the polytope's support, v the triangle's corners. So the
// least h(n) over these directions is the depth: along a facet's normal it is the distance of that facet, and no other
// h(n) is less than the depth.
//
// The points. The facet of the least h(n) has the foot of the origin in it: h(n) n = x - y, x of the box's face, edge
// or corner that looks along n, y of the triangle's corner, edge or face that looks the other way. Along an axis y is
// the lowest corner, along the triangle's normal x is the corner of the box, along a cross product both are points of
// two edges. What turns out to be no point of its body is not taken.
//
// Errors. A direction that is made as a product c = a x b of known vectors is off by 4 u |a| |b| / |c|, so that its
// height is off from that of the true one by up to 16 u |a| |b| / |c| of the longest coordinate, sqrt(3) and two
// roundings in it: `doubt` over that sine. An edge that is along an axis to 2^-46 has no product with it: were it
// along it, corners would be off by less than 2^-46 of its length, below 128 u, 8 doubts.
#include "linear/box_triangle.h"

/// The sine below which an edge counts as along an axis.
#define ALONG 0x1p-46

// The bodies.
typedef struct couple {
    const double *half;
    const vec3 *corner;
    double doubt;
} couple;

// What is known of the least height.
typedef struct least {
    double value, lower;
    vec3 n;
    int feature; ///< an axis (0 to 2), the triangle's normal (3), or 4 + 3 edge + axis
} least;

// The heights along a direction and against it, and by how much they may be off.
typedef struct heights {
    double along, against, error;
} heights;

static void take(least *to, const heights *h, vec3 n, int feature) {
    double value = min2(h->along, h->against);
    to->lower = min2(to->lower, value - h->error);
    if (!(value < to->value)) return;
    to->value = value;
    to->n = h->against < h->along ? vec3_neg(n) : n;
    to->feature = feature;
}

static double get(const vec3 *v, int k) { return k == 0 ? v->x : k == 1 ? v->y : v->z; }

// By the parts along axis k and the two after it.
static vec3 make(int k, double along, double i, double j) {
    return k == 0 ? (vec3){along, i, j} : k == 1 ? (vec3){j, along, i} : (vec3){i, j, along};
}

static void try_axes(const couple *of, least *to) {
    for (int k = 0; k < 3; k++) {
        double a = get(&of->corner[0], k), b = get(&of->corner[1], k), c = get(&of->corner[2], k);
        const heights h = {of->half[k] - min2(a, min2(b, c)), of->half[k] + max2(a, max2(b, c)), of->doubt};
        take(to, &h, make(k, 1, 0, 0), k);
    }
}

// 0 if the triangle is nearly a segment.
static int try_normal(const couple *of, least *to) {
    const vec3 *v = of->corner;
    vec3 e = vec3_sub(v[1], v[0]), f = vec3_sub(v[2], v[0]), n = vec3_cross(e, f);
    double square = vec3_norm_squared(n), edges = vec3_norm_squared(e) * vec3_norm_squared(f);
    if (!(square > ALONG * ALONG * edges)) return 0;
    double scale = 1 / sqrt(square);
    n = vec3_scale(n, scale);
    double reach = (of->half[0] * fabs(n.x) + of->half[1] * fabs(n.y)) + of->half[2] * fabs(n.z),
           at = vec3_dot(n, v[0]);
    const heights h = {reach - at, reach + at, of->doubt * sqrt(edges) * scale};
    take(to, &h, n, 3);
    return 1;
}

// The cross products of an edge with the axes.
static void try_edge(const couple *of, int edge, least *to) {
    const vec3 from = of->corner[edge], w = of->corner[(edge + 2) % 3], e = vec3_sub(of->corner[(edge + 1) % 3], from);
    double square = vec3_norm_squared(e);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        double x = -get(&e, j), y = get(&e, i), across = x * x + y * y;
        if (!(across > ALONG * ALONG * square)) continue;
        double scale = 1 / sqrt(across);
        x *= scale, y *= scale;
        double at = x * get(&from, i) + y * get(&from, j), other = x * get(&w, i) + y * get(&w, j);
        double reach = of->half[i] * fabs(x) + of->half[j] * fabs(y);
        const heights h = {reach - min2(at, other), reach + max2(at, other), of->doubt * sqrt(square) * scale};
        take(to, &h, make(k, 0, x, y), 4 + 3 * edge + k);
    }
}

// ---- the points

static int is_in_box(const couple *of, vec3 x) {
    return fabs(x.x) <= of->half[0] + of->doubt && fabs(x.y) <= of->half[1] + of->doubt &&
           fabs(x.z) <= of->half[2] + of->doubt;
}

static vec3 clamp(const double half[3], vec3 x) {
    return (vec3){max2(-half[0], min2(half[0], x.x)), max2(-half[1], min2(half[1], x.y)),
                  max2(-half[2], min2(half[2], x.z))};
}

// The corner of the box that is the farthest along n.
static vec3 find_corner(const double half[3], vec3 n) {
    return (vec3){n.x < 0 ? -half[0] : half[0], n.y < 0 ? -half[1] : half[1], n.z < 0 ? -half[2] : half[2]};
}

// The box's point across from the triangle's.
static int put_across(const couple *of, box_triangle *to) {
    vec3 x = vec3_add_scaled(to->on_triangle, to->n, to->value);
    to->on_box = clamp(of->half, x);
    return is_in_box(of, x);
}

static int put_axis(const couple *of, box_triangle *to) {
    to->on_triangle = of->corner[0];
    for (int i = 1; i < 3; i++)
        if (vec3_dot(to->n, of->corner[i]) < vec3_dot(to->n, to->on_triangle)) to->on_triangle = of->corner[i];
    return put_across(of, to);
}

static int put_normal(const couple *of, box_triangle *to) {
    to->on_box = find_corner(of->half, to->n);
    to->on_triangle = vec3_add_scaled(to->on_box, to->n, -to->value);
    vec3 off[3];
    for (int i = 0; i < 3; i++) off[i] = vec3_sub(of->corner[i], to->on_triangle);
    const double a = vec3_dot(to->n, vec3_cross(off[1], off[2])), b = vec3_dot(to->n, vec3_cross(off[2], off[0])),
                 c = vec3_dot(to->n, vec3_cross(off[0], off[1])), sum = a + b + c;
    const double beyond = of->doubt * max2(vec3_norm(off[0]), max2(vec3_norm(off[1]), vec3_norm(off[2])));
    return sum >= 0 ? min2(a, min2(b, c)) >= -beyond : max2(a, max2(b, c)) <= beyond;
}

// The edge of the box along axis k, and that of the triangle: seen along n they cross.
static int put_edges(const couple *of, int edge, int k, box_triangle *to) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const vec3 from = of->corner[edge], e = vec3_sub(of->corner[(edge + 1) % 3], from);
    vec3 off = vec3_sub(vec3_add_scaled(find_corner(of->half, to->n), to->n, -to->value), from);
    double ei = get(&e, i), ej = get(&e, j), part = (ei * get(&off, i) + ej * get(&off, j)) / (ei * ei + ej * ej),
           within = max2(0, min2(1, part));
    to->on_triangle = vec3_add_scaled(from, e, within);
    return put_across(of, to) && fabs(part - within) * vec3_norm(e) <= of->doubt;
}

static int put_points(const couple *of, int feature, box_triangle *to) {
    if (feature < 3) return put_axis(of, to);
    return feature == 3 ? put_normal(of, to) : put_edges(of, (feature - 4) / 3, (feature - 4) % 3, to);
}

int box_triangle_find_overlap(const double half[3], const vec3 corner[3], double doubt, box_triangle *to) {
    couple of = {half, corner, doubt};
    least found = {.value = INFINITY, .lower = INFINITY};
    try_axes(&of, &found);
    if (!try_normal(&of, &found)) return 0;
    for (int edge = 0; edge < 3; edge++) try_edge(&of, edge, &found);
    *to = (box_triangle){.n = found.n, .value = found.value, .lower = found.lower - 8 * doubt};
    of.doubt = 4 * doubt;
    return to->lower > doubt && put_points(&of, found.feature, to);
}
