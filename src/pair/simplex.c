// The nearest point of points, segments, triangles and tetrahedra, case by case.
#include "pair/simplex.h"

// A nearest point, the corners of the smallest face that contains it, by their places in the simplex, and their
// weights.
typedef struct nearest {
    int count;
    int at[3];
    double weight[3];
    vec3 point;
} nearest;

static nearest nearest_of_vertex(const difference *p, int i) { return (nearest){1, {i, 0, 0}, {1, 0, 0}, p[i].w}; }

static nearest nearest_of_segment(const difference *p, int i, int j) {
    vec3 e = vec3_sub(p[j].w, p[i].w);
    double top = -vec3_dot(p[i].w, e), bottom = vec3_dot(e, e);
    if (!(top > 0)) return nearest_of_vertex(p, i);
    if (!(top < bottom)) return nearest_of_vertex(p, j);
    double t = top / bottom;
    return (nearest){2, {i, j, 0}, {1 - t, t, 0}, vec3_add_scaled(p[i].w, e, t)};
}

static nearest nearer(nearest a, nearest b) { return vec3_norm_squared(b.point) < vec3_norm_squared(a.point) ? b : a; }

static nearest nearest_of_triangle(const difference *p, int i, int j, int k) {
    vec3 a = p[i].w, b = p[j].w, c = p[k].w;
    vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    double nn = vec3_dot(n, n);
    // Signed areas of the origin's projection against the three edges.
    double u = vec3_dot(n, vec3_cross(b, c)), v = vec3_dot(n, vec3_cross(c, a)), w = vec3_dot(n, vec3_cross(a, b));
    if (u > 0 && v > 0 && w > 0 && nn > 0) {
        double sum = u + v + w;
        return (nearest){3, {i, j, k}, {u / sum, v / sum, w / sum}, vec3_scale(n, vec3_dot(n, a) / nn)};
    }
    nearest best = nearest_of_segment(p, i, j);
    best = nearer(best, nearest_of_segment(p, j, k));
    return nearer(best, nearest_of_segment(p, k, i));
}

// The side of the face v[0], v[1], v[2] that the origin is on, compared with the corner v[3]: 1 the same, -1 the other,
// 0 in doubt. *volume: six times that of the tetrahedron of the face and the origin.
static int origin_side(const difference *p, const int v[4], double *volume) {
    vec3 a = p[v[0]].w, e1 = vec3_sub(p[v[1]].w, a), e2 = vec3_sub(p[v[2]].w, a), n = vec3_cross(e1, e2);
    double to_origin = -vec3_dot(n, a), to_corner = vec3_dot(n, vec3_sub(p[v[3]].w, a));
    double slack = 1e-14 * vec3_norm(e1) * vec3_norm(e2);
    *volume = fabs(to_origin);
    if (fabs(to_corner) <= slack * vec3_norm(vec3_sub(p[v[3]].w, a))) return 0;
    if (fabs(to_origin) <= slack * vec3_norm(a)) return 0;
    return (to_origin > 0) == (to_corner > 0) ? 1 : -1;
}

static const int faces[4][4] = {{1, 2, 3, 0}, {0, 2, 3, 1}, {0, 1, 3, 2}, {0, 1, 2, 3}};

// The nearest point of the tetrahedron's surface among the faces that the origin is not behind; count 0 if behind all.
static nearest nearest_of_tetrahedron(simplex *s) {
    nearest best = {0, {0}, {0}, {0, 0, 0}};
    double volume[4];
    for (int f = 0; f < 4; f++) {
        const int *v = faces[f];
        if (origin_side(s->p, v, &volume[f]) == 1) continue;
        nearest n = nearest_of_triangle(s->p, v[0], v[1], v[2]);
        best = best.count ? nearer(best, n) : n;
    }
    if (best.count) return best;
    // Inside: the weights of the origin are the volumes opposite to the corners.
    double sum = (volume[0] + volume[1]) + (volume[2] + volume[3]);
    for (int i = 0; i < 4; i++) s->weight[i] = volume[i] / sum;
    return best;
}

// The part of n that is orthogonal to e1 and e2, as a unit vector: one step of Gram and Schmidt.
static vec3 orthogonalised(vec3 n, vec3 e1, vec3 e2) {
    double l1 = vec3_dot(e1, e1);
    if (l1 > 0) {
        n = vec3_add_scaled(n, e1, -vec3_dot(n, e1) / l1);
        e2 = vec3_add_scaled(e2, e1, -vec3_dot(e2, e1) / l1);
    }
    double l2 = vec3_dot(e2, e2);
    if (l2 > 0) n = vec3_add_scaled(n, e2, -vec3_dot(n, e2) / l2);
    return vec3_unit(n);
}

// A sliver's cross product is off by u / sin of the angle between its edges, which orthogonalisation removes.
vec3 simplex_compute_normal(vec3 e1, vec3 e2) {
    vec3 n = vec3_cross(e1, e2);
    double area = vec3_norm_squared(n), edges = vec3_norm_squared(e1) * vec3_norm_squared(e2);
    return area > 1e-4 * edges ? vec3_unit(n) : orthogonalised(n, e1, e2);
}

// The direction to the nearest point, without the rounding error along the face. For a segment e the point is off by u
// |w|, which turns the direction by u |w| / |point| and moves the gap by |e| times as much; this is negligible if
// |point| and |e| are similar. For a triangle the normal is off by u / sin of the angle at the corner, negligible
// except for slivers.
static vec3 direction(const simplex *s, vec3 point) {
    vec3 zero = {0, 0, 0}, n = vec3_unit(point);
    if (s->count == 1) return n;
    vec3 e1 = vec3_sub(s->p[1].w, s->p[0].w);
    if (s->count == 2) return vec3_norm_squared(point) > 0.01 * vec3_norm_squared(e1) ? n : orthogonalised(n, e1, zero);
    vec3 e2 = vec3_sub(s->p[2].w, s->p[0].w);
    double sine_squared = vec3_norm_squared(vec3_cross(e1, e2)) / (vec3_norm_squared(e1) * vec3_norm_squared(e2));
    return sine_squared > 1e-4 ? n : orthogonalised(n, e1, e2);
}

vec3 simplex_reduce(simplex *s) {
    nearest n;
    switch (s->count) {
    case 1: n = nearest_of_vertex(s->p, 0); break;
    case 2: n = nearest_of_segment(s->p, 0, 1); break;
    case 3: n = nearest_of_triangle(s->p, 0, 1, 2); break;
    default: n = nearest_of_tetrahedron(s); break;
    }
    if (n.count == 0) return (vec3){0, 0, 0};
    simplex kept = {.count = n.count};
    for (int i = 0; i < n.count; i++) {
        kept.p[i] = s->p[n.at[i]];
        kept.weight[i] = n.weight[i];
    }
    *s = kept;
    return direction(s, n.point);
}

void simplex_compute_inside_weights(simplex *s) {
    double sum = 0, reach = 0;
    vec3 w[4];
    for (int i = 0; i < 4; i++) reach = max2(reach, vec3_max_abs(s->p[i].w));
    // Volumes of lengths below 1e-100 would underflow.
    double unit = reach < 1e-90 ? ldexp(1, -find_unit_exponent(reach)) : 1;
    for (int i = 0; i < 4; i++) w[i] = vec3_scale(s->p[i].w, unit);
    for (int i = 0; i < 4; i++) {
        const int *v = faces[i];
        s->weight[i] = fabs(vec3_dot(w[v[0]], vec3_cross(w[v[1]], w[v[2]])));
        sum += s->weight[i];
    }
    for (int i = 0; i < 4; i++) s->weight[i] /= sum;
}

vec3 simplex_compute_point(const simplex *s) {
    vec3 sum = vec3_scale(s->p[0].w, s->weight[0]);
    for (int i = 1; i < s->count; i++) sum = vec3_add_scaled(sum, s->p[i].w, s->weight[i]);
    return sum;
}
