// The weights of a nearest point that lies inside the simplex, in numbers one by one: a load of two coordinates that
// have just been written one by one waits for both stores.
#include "linear/both.h"
#include "pair/simplex.h"

// How many points hold the nearest one follows no pattern: the weights of a segment and of a triangle are both
// computed, and one of them is taken. They are written in pairs, as whoever copies them reads them.
void simplex_compute_weights(simplex *s) {
    int k = s->count - 1;
    if (k == 0) {
        both_store(s->weight, both_make(1, 0));
        both_store(s->weight + 2, both_set(0));
        return;
    }
    vec3 a = s->p[0].w, b = s->p[1].w, c = s->p[k > 1 ? 2 : 0].w, e = vec3_sub(b, a);
    vec3 n = vec3_cross(e, vec3_sub(c, a));
    double u = vec3_dot(n, vec3_cross(b, c)), v = vec3_dot(n, vec3_cross(c, a)), w = vec3_dot(n, vec3_cross(a, b));
    int is_triangle = k > 1;
    const double part[2] = {-vec3_dot(a, e), 1}, whole[2] = {vec3_norm_squared(e), (u + v) + w};
    double t = part[is_triangle] / whole[is_triangle];
    const both first[2] = {both_make(1 - t, t), both_make(u * t, v * t)};
    const double last[2] = {0, w * t};
    both_store(s->weight, first[is_triangle]);
    both_store(s->weight + 2, both_make(last[is_triangle], 0));
    const int is_inside[2] = {(t > 0) & (t < 1), (u > 0) & (v > 0) & (w > 0) & (t < INFINITY)};
    if (!is_inside[is_triangle]) (void)simplex_reduce(s);
}
