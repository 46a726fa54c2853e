// The dual bound of the maximum-volume inscribed ellipsoid.
//
// Let g_i be any directions, b_i the support of the body along them less that of the centre c, M the map of the given
// ellipsoid, h_i = |M' g_i|, u_i = M' g_i / h_i. Any ellipsoid in the body is { c + M (p + G v) : |v| <= 1 } with G
// symmetric positive semidefinite, and b_i / h_i >= u_i . p + |G u_i| >= u_i . p + u_i' G u_i. With weights l_i
// >= 0, P = sum l_i u_i u_i', r = sum l_i u_i: tr(G P) <= sum l_i b_i / h_i - r . p <= B = sum l_i b_i / h_i + |r|
// reach, and 3 det(G P)^(1/3) <= tr(G P). So det G <= (B / 3)^3 / det P, which is 1 at the optimum. The b_i and h_i are
// computed in double-double.
#include "ellipsoid/certificate.h"

#include "linear/exact.h"

// A vector a, not zero, with sum a_j moment_j = 0 over 11 columns of 10, by elimination with full pivoting.
static void find_dependence(const certificate *c, double a[CERTIFICATE_SIZE]) {
    enum { ROWS = 10, COLUMNS = CERTIFICATE_SIZE };
    double m[ROWS][COLUMNS];
    int order[COLUMNS], rank = 0;
    for (int j = 0; j < COLUMNS; j++) {
        order[j] = j;
        for (int i = 0; i < ROWS; i++) m[i][j] = c->moment[j][i];
    }
    for (; rank < ROWS; rank++) {
        int row = rank, column = rank;
        for (int i = rank; i < ROWS; i++)
            for (int j = rank; j < COLUMNS; j++)
                if (fabs(m[i][order[j]]) > fabs(m[row][order[column]])) row = i, column = j;
        if (!(fabs(m[row][order[column]]) > 1e-13)) break;
        int swap = order[rank];
        order[rank] = order[column], order[column] = swap;
        for (int j = 0; j < COLUMNS; j++) {
            double t = m[rank][j];
            m[rank][j] = m[row][j], m[row][j] = t;
        }
        for (int i = rank + 1; i < ROWS; i++) {
            double f = m[i][order[rank]] / m[rank][order[rank]];
            for (int j = rank; j < COLUMNS; j++) m[i][order[j]] -= f * m[rank][order[j]];
        }
    }
    // The first column without a pivot, expressed by the others.
    for (int j = 0; j < COLUMNS; j++) a[order[j]] = j == rank;
    for (int i = rank - 1; i >= 0; i--) {
        double sum = 0;
        for (int j = i + 1; j <= rank; j++) sum += m[i][order[j]] * a[order[j]];
        a[order[i]] = -sum / m[i][order[i]];
    }
}

void certificate_add(certificate *c, uint32_t halfspace, double weight, vec3 u, double d) {
    double *v = c->moment[c->count];
    const double moment[10] = {u.x * u.x, u.x * u.y, u.x * u.z, u.y * u.y, u.y * u.z, u.z * u.z, u.x, u.y, u.z, d};
    for (int i = 0; i < 10; i++) v[i] = moment[i];
    c->halfspace[c->count] = halfspace;
    c->weight[c->count++] = weight;
    if (c->count < CERTIFICATE_SIZE) return;
    // Moves along the dependence until a weight is zero. The dependence has entries of both signs, since the moments of
    // the squares are positive.
    double a[CERTIFICATE_SIZE], step = INFINITY;
    int gone = 0;
    find_dependence(c, a);
    for (int j = 0; j < c->count; j++)
        if (a[j] > 0 && c->weight[j] < step * a[j]) step = c->weight[j] / a[j], gone = j;
    for (int j = 0; j < c->count && isfinite(step); j++) c->weight[j] = fmax(c->weight[j] - step * a[j], 0);
    c->count--;
    c->halfspace[gone] = c->halfspace[c->count];
    c->weight[gone] = c->weight[c->count];
    for (int i = 0; i < 10; i++) c->moment[gone][i] = c->moment[c->count][i];
}

static dd dd_dot(vec3 a, const dd b[3]) {
    return dd_add(dd_add(dd_mul(dd_from(a.x), b[0]), dd_mul(dd_from(a.y), b[1])), dd_mul(dd_from(a.z), b[2]));
}

// The support of the body along g less that of the centre.
static double compute_support(const inscribed_body *body, vec3 g) {
    double top = -INFINITY;
    for (uint32_t v = 0; v < body->vertex_count; v++) {
        vec3 x = vec3_at(body->vertices, v);
        const dd d[3] = {two_sum(x.x, -body->center.x), two_sum(x.y, -body->center.y), two_sum(x.z, -body->center.z)};
        top = fmax(top, dd_dot(g, d).high);
    }
    return top + body->height * fabs(vec3_dot(g, body->normal));
}

// M' g, in double-double and then rounded.
static vec3 compute_pullback(const mat3 *m, vec3 g) {
    const dd d[3] = {dd_from(g.x), dd_from(g.y), dd_from(g.z)};
    mat3 t = mat3_transpose(*m);
    return (vec3){dd_dot(t.r0, d).high, dd_dot(t.r1, d).high, dd_dot(t.r2, d).high};
}

double certificate_compute_bound(const certificate *c, const inscribed_body *body, const vec3 *directions) {
    sym3 p = {0, 0, 0, 0, 0, 0};
    vec3 r = {0, 0, 0};
    double sum = 0;
    for (int i = 0; i < c->count; i++) {
        vec3 pulled = compute_pullback(&body->map, directions[i]);
        double h = vec3_norm(pulled);
        if (!(h > 0)) continue;
        vec3 u = vec3_scale(pulled, 1 / h);
        p = sym3_add(p, sym3_outer(u, c->weight[i]));
        r = vec3_add_scaled(r, u, c->weight[i]);
        sum += c->weight[i] * compute_support(body, directions[i]) / h;
    }
    double third = (sum + vec3_norm(r) * body->reach) / 3, det = sym3_det(p);
    // The sums of up to 11 terms are true to 1e-14.
    return det > 0 ? third * third * third / det * (1 + 1e-13) : INFINITY;
}
