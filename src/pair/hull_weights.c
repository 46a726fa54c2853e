// Weights by the faces' normals, corrected by what the weighted corners are off the origin. With n[i] the normal of the
// face across from corner i and det[i] = n[i].(w[i] - w[j]), j on that face, a point x has the weight
// n[i].(x - w[j]) / det[i] there. In a needle of width t the products cancel to t of their size in a normal and to t^2
// in det[i]: double-doubles leave a relative error of about 2^-102 / t^2 in a weight. The corrections have that error,
// too, relative to what is left, so a few of them reach the rounding of the weights themselves.
#include "pair/hull_weights.h"

#include <string.h>

enum { CORRECTIONS = 8 };

typedef struct tetrahedron {
    dd3 corner[4];
    dd3 normal[4];
    double det[4];
    double weight[4];
} tetrahedron;

static const int others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// The normals, and the weights of the origin by them; 0: the corners are on one plane, to rounding.
static int set_first_weights(tetrahedron *t) {
    for (int i = 0; i < 4; i++) {
        const dd3 a = t->corner[others[i][0]], b = t->corner[others[i][1]], c = t->corner[others[i][2]];
        dd3 n = dd3_cross(dd3_sub(b, a), dd3_sub(c, a));
        dd det = dd3_dot(n, dd3_sub(t->corner[i], a));
        if (!(fabs(det.high) > 1e-200)) return 0;
        t->normal[i] = n;
        t->det[i] = det.high;
        t->weight[i] = -dd3_dot(n, a).high / det.high;
    }
    return 1;
}

static vec3 compute_rest(const tetrahedron *t) {
    dd3 sum = dd3_mul_double(t->corner[0], t->weight[0]);
    for (int i = 1; i < 4; i++) sum = dd3_add(sum, dd3_mul_double(t->corner[i], t->weight[i]));
    return dd3_high(sum);
}

// Sets the weights, as near as corrections bring them; how far their point is from the origin, infinity where there are
// none.
static double find_weights(tetrahedron *t) {
    double best = INFINITY, kept[4];
    if (!set_first_weights(t)) return INFINITY;
    for (int round = 0; round < CORRECTIONS; round++) {
        for (int i = 0; i < 4; i++) t->weight[i] = fmax(t->weight[i], 0);
        vec3 rest = compute_rest(t);
        double off = vec3_norm(rest), sum = t->weight[0] + t->weight[1] + t->weight[2] + t->weight[3];
        if (!(off < best && sum > 0)) break;
        best = off;
        memcpy(kept, t->weight, sizeof kept);
        for (int i = 0; i < 4; i++) t->weight[i] -= dd3_dot_vec3(t->normal[i], rest).high / t->det[i];
    }
    if (best < INFINITY) memcpy(t->weight, kept, sizeof kept);
    return best;
}

static void take_weights(const tetrahedron *t, const int *at, int count, double *weight) {
    double sum = t->weight[0] + t->weight[1] + t->weight[2] + t->weight[3];
    for (int i = 0; i < count; i++) weight[i] = 0;
    for (int i = 0; i < 4; i++) weight[at[i]] = t->weight[i] / sum;
}

void hull_set_weights(const dd3 *w, int count, double *weight) {
    double best = INFINITY;
    for (unsigned some = 0; some < 1u << count; some++) {
        tetrahedron t;
        int at[4], corners = 0;
        for (int i = 0; i < count; i++) {
            if (!(some >> i & 1)) continue;
            if (corners < 4) at[corners] = i, t.corner[corners] = w[i];
            corners++;
        }
        if (corners != 4) continue;
        double off = find_weights(&t);
        if (!(off < best)) continue;
        best = off;
        take_weights(&t, at, count, weight);
    }
}

void hull_set_weights_of_doubles(const vec3 *w, int count, double *weight) {
    double reach = 0;
    dd3 compact[HULL_CORNERS_MAX];
    for (int i = 0; i < count; i++) reach = fmax(reach, vec3_max_abs(w[i]));
    double unit = ldexp(1, -find_unit_exponent(reach));
    for (int i = 0; i < count; i++) compact[i] = dd3_from(vec3_scale(w[i], unit));
    hull_set_weights(compact, count, weight);
}
