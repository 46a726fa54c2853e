// Bounding volumes as first stages, in straightforward scalar code of equal care; only their relative cost matters.
#include "pairs/bounds.h"

#include <math.h>
#include <string.h>

static double dot(ovoid_vec3 a, ovoid_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static ovoid_vec3 sub(ovoid_vec3 a, ovoid_vec3 b) { return (ovoid_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static ovoid_vec3 apply(const double m[9], ovoid_vec3 v) {
    return (ovoid_vec3){m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
                        m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
/// The transpose of m times v.
static ovoid_vec3 undo(const double m[9], ovoid_vec3 v) {
    return (ovoid_vec3){m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
                        m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

/// Eigenvectors of q as columns, by Jacobi's rotations.
static void find_axes(const ovoid_sym3 *q, double axes[9]) {
    double m[3][3] = {{q->xx, q->xy, q->xz}, {q->xy, q->yy, q->yz}, {q->xz, q->yz, q->zz}};
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(axes, identity, sizeof identity);
    for (int sweep = 0; sweep < 30; sweep++)
        for (int k = 0; k < 3; k++) {
            int i = k == 2, j = k == 0 ? 1 : 2;
            if (m[i][j] == 0) continue;
            double theta = 0.5 * atan2(2 * m[i][j], m[j][j] - m[i][i]), c = cos(theta), s = sin(theta);
            for (int r = 0; r < 3; r++) {
                double x = m[r][i], y = m[r][j];
                m[r][i] = c * x - s * y;
                m[r][j] = s * x + c * y;
            }
            for (int r = 0; r < 3; r++) {
                double x = m[i][r], y = m[j][r], u = axes[3 * r + i], v = axes[3 * r + j];
                m[i][r] = c * x - s * y;
                m[j][r] = s * x + c * y;
                axes[3 * r + i] = c * u - s * v;
                axes[3 * r + j] = s * u + c * v;
            }
        }
}

/// The box with the axes of v; its volume.
static double fit_box(volumes *v, const ovoid_polytope *p) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        const double *x = p->vertices + (size_t)3 * i;
        ovoid_vec3 t = undo(v->axes, (ovoid_vec3){x[0] + p->origin.x, x[1] + p->origin.y, x[2] + p->origin.z});
        const double along[3] = {t.x, t.y, t.z};
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], along[k]);
            high[k] = fmax(high[k], along[k]);
        }
    }
    v->half = (ovoid_vec3){0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1]), 0.5 * (high[2] - low[2])};
    v->box_center =
        apply(v->axes, (ovoid_vec3){0.5 * (high[0] + low[0]), 0.5 * (high[1] + low[1]), 0.5 * (high[2] + low[2])});
    return v->half.x * v->half.y * v->half.z;
}

static ovoid_vec3 add(ovoid_vec3 a, ovoid_vec3 b) { return (ovoid_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }

volumes volumes_make(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_measures m = ovoid_shape_get_measures(shape);
    volumes straight = {.sphere_center = add(m.sphere_center, p.origin),
                        .sphere_radius = m.sphere_radius,
                        .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                        .outer = ovoid_shape_get_outer(shape).ellipsoid};
    straight.outer.center = add(straight.outer.center, p.origin);
    volumes turned = straight;
    find_axes(&turned.outer.q, turned.axes);
    return fit_box(&turned, &p) < fit_box(&straight, &p) ? turned : straight;
}

double bound_by_sphere(const bounded *pair) {
    ovoid_vec3 a = add(pair->at_a, apply(pair->turn_a, pair->a->sphere_center));
    ovoid_vec3 b = add(pair->at_b, apply(pair->turn_b, pair->b->sphere_center)), d = sub(b, a);
    return sqrt(dot(d, d)) - pair->a->sphere_radius - pair->b->sphere_radius;
}

/// The columns of turn times axes.
static void pose_axes(const double turn[9], const double axes[9], ovoid_vec3 out[3]) {
    for (int k = 0; k < 3; k++) out[k] = apply(turn, (ovoid_vec3){axes[k], axes[3 + k], axes[6 + k]});
}

double bound_by_box(const bounded *pair) {
    ovoid_vec3 u[3], v[3];
    pose_axes(pair->turn_a, pair->a->axes, u);
    pose_axes(pair->turn_b, pair->b->axes, v);
    ovoid_vec3 d = sub(add(pair->at_b, apply(pair->turn_b, pair->b->box_center)),
                       add(pair->at_a, apply(pair->turn_a, pair->a->box_center)));
    const double ha[3] = {pair->a->half.x, pair->a->half.y, pair->a->half.z};
    const double hb[3] = {pair->b->half.x, pair->b->half.y, pair->b->half.z};
    double r[3][3], absolute[3][3], du[3], best = -INFINITY;
    for (int i = 0; i < 3; i++) {
        du[i] = dot(d, u[i]);
        for (int j = 0; j < 3; j++) {
            r[i][j] = dot(u[i], v[j]);
            absolute[i][j] = fabs(r[i][j]);
        }
    }
    // The faces of A, then of B.
    for (int i = 0; i < 3; i++)
        best =
            fmax(best, fabs(du[i]) - ha[i] - hb[0] * absolute[i][0] - hb[1] * absolute[i][1] - hb[2] * absolute[i][2]);
    for (int j = 0; j < 3; j++)
        best = fmax(best, fabs(dot(d, v[j])) - hb[j] - ha[0] * absolute[0][j] - ha[1] * absolute[1][j] -
                              ha[2] * absolute[2][j]);
    // The edges, their cross products scaled to unit length; nearly parallel edges add no information.
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double squared = 1 - r[i][j] * r[i][j];
            if (squared < 1e-6) continue;
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            double gap = fabs(du[i2] * r[i1][j] - du[i1] * r[i2][j]) - ha[i1] * absolute[i2][j] -
                         ha[i2] * absolute[i1][j] - hb[j1] * absolute[i][j2] - hb[j2] * absolute[i][j1];
            best = fmax(best, gap / sqrt(squared));
        }
    return best;
}

static ovoid_sym3 pose_form(const double m[9], const ovoid_sym3 *q) {
    ovoid_vec3 c[3] = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}, t[3];
    for (int i = 0; i < 3; i++)
        t[i] = (ovoid_vec3){q->xx * c[i].x + q->xy * c[i].y + q->xz * c[i].z,
                            q->xy * c[i].x + q->yy * c[i].y + q->yz * c[i].z,
                            q->xz * c[i].x + q->yz * c[i].y + q->zz * c[i].z};
    return (ovoid_sym3){dot(c[0], t[0]), dot(c[0], t[1]), dot(c[0], t[2]),
                        dot(c[1], t[1]), dot(c[1], t[2]), dot(c[2], t[2])};
}

static double form(const ovoid_sym3 *q, ovoid_vec3 n) {
    return q->xx * n.x * n.x + q->yy * n.y * n.y + q->zz * n.z * n.z +
           2 * (q->xy * n.x * n.y + q->xz * n.x * n.z + q->yz * n.y * n.z);
}

/// (a s + b t)^-1 d, by cofactors, of any length.
static ovoid_vec3 solve(const ovoid_sym3 *a, double s, const ovoid_sym3 *b, double t, ovoid_vec3 d) {
    ovoid_sym3 m = {a->xx * s + b->xx * t, a->xy * s + b->xy * t, a->xz * s + b->xz * t,
                    a->yy * s + b->yy * t, a->yz * s + b->yz * t, a->zz * s + b->zz * t};
    double xx = m.yy * m.zz - m.yz * m.yz, xy = m.xz * m.yz - m.xy * m.zz, xz = m.xy * m.yz - m.xz * m.yy;
    double yy = m.xx * m.zz - m.xz * m.xz, yz = m.xy * m.xz - m.xx * m.yz, zz = m.xx * m.yy - m.xy * m.xy;
    return (ovoid_vec3){xx * d.x + xy * d.y + xz * d.z, xy * d.x + yy * d.y + yz * d.z, xz * d.x + yz * d.y + zz * d.z};
}

double bound_by_ellipsoid(const bounded *pair) {
    ovoid_sym3 qa = pose_form(pair->turn_a, &pair->a->outer.q), qb = pose_form(pair->turn_b, &pair->b->outer.q);
    ovoid_vec3 d = sub(add(pair->at_b, apply(pair->turn_b, pair->b->outer.center)),
                       add(pair->at_a, apply(pair->turn_a, pair->a->outer.center)));
    ovoid_vec3 n = solve(&qa, 1, &qb, 1, d);
    n = solve(&qa, 1 / sqrt(form(&qa, n)), &qb, 1 / sqrt(form(&qb, n)), d);
    return (dot(n, d) - sqrt(form(&qa, n)) - sqrt(form(&qb, n))) / sqrt(dot(n, n));
}
