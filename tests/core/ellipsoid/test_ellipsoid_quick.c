// The fits' proofs in doubles against the same quantities in double-double, whose error, 2^-100 times the condition of
// Q, is far below every bound tested here; and the small quadratic program against its conditions of optimality.
#include "ellipsoid/certificate.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/inscribe.h"
#include "polytopes.h"

static dd dd_abs(dd a) { return a.high < 0 ? dd_neg(a) : a; }

// A turned ellipsoid's matrix with radii 1, between, and `thin`.
static sym3 make_thin(double thin, uint64_t *s) {
    double between = random_next(s) % 2 ? 1 : thin;
    return sym3_rotate(sym3_diagonal(1, between * between, thin * thin), mat3_random_rotation(s));
}

// The largest row sum of |W A W'|, for the A given, less `one` on the diagonal.
static double compute_row_sum(const factor *f, dd a[3][3], double one) {
    double most = 0;
    for (int i = 0; i < 3; i++) {
        dd row = dd_from(0);
        for (int j = 0; j < 3; j++) {
            dd sum = dd_from(i == j ? -one : 0);
            for (int k = 0; k < 3; k++)
                for (int n = 0; n < 3; n++) sum = dd_add(sum, dd_mul(two_product(f->w[i][k], f->w[j][n]), a[k][n]));
            row = dd_add(row, dd_abs(sum));
        }
        most = fmax(most, row.high);
    }
    return most;
}

// The defect is at least the true one, and `size` bounds what roundings of the entries do.
static void check_factor(void) {
    double closest = INFINITY;
    int factors = 0;
    for (int i = 0; i < 20000; i++) {
        uint64_t s = check_seed = 1 + (uint64_t)i;
        sym3 q = make_thin(pow(10, -5 * random_uniform(&s, 0, 1)), &s);
        factor f;
        double size;
        if (!factor_make_quickly(q, &f, &size)) continue;
        factors++;
        sym3dd exact = sym3dd_from(q);
        double defect = compute_row_sum(&f, exact.m, 1);
        CHECK_LE(defect, f.defect);
        closest = fmin(closest, f.defect / (0x1p-53 * size));
        dd change[3][3];
        const double edge[3] = {sqrt(q.xx), sqrt(q.yy), sqrt(q.zz)};
        for (int k = 0; k < 3; k++)
            for (int n = 0; n <= k; n++)
                change[k][n] = change[n][k] = dd_from((random_next(&s) % 2 ? 1 : -1) * 0x1p-53 * edge[k] * edge[n]);
        CHECK_LE(compute_row_sum(&f, change, 0), 0x1p-53 * size * (1 + 1e-9));
    }
    CHECK(factors > 15000);
    factor f;
    double size;
    CHECK(!factor_make_quickly(sym3_diagonal(1, 1, -1), &f, &size));
    CHECK(!factor_make_quickly(sym3_diagonal(1, NAN, 1), &f, &size));
    CHECK(!factor_make_quickly(sym3_diagonal(1e-210, 1e-210, 1e-210), &f, &size));
    CHECK(!factor_make_quickly(sym3_diagonal(1e210, 1e210, 1e210), &f, &size));
    printf("the least defect is %.3g roundings of the size\n", closest);
    check_seed = 0;
}

// d' Q^-1 d by L D L' in double-double.
static dd compute_norm(const sym3dd *q, const dd d[3]) {
    dd l[3][3], pivot[3], y[3], sum = dd_from(0);
    for (int j = 0; j < 3; j++) {
        pivot[j] = q->m[j][j];
        for (int k = 0; k < j; k++) pivot[j] = dd_sub(pivot[j], dd_mul(dd_mul(l[j][k], l[j][k]), pivot[k]));
        for (int i = j + 1; i < 3; i++) {
            l[i][j] = q->m[i][j];
            for (int k = 0; k < j; k++) l[i][j] = dd_sub(l[i][j], dd_mul(dd_mul(l[i][k], l[j][k]), pivot[k]));
            l[i][j] = dd_div(l[i][j], pivot[j]);
        }
        y[j] = d[j];
        for (int k = 0; k < j; k++) y[j] = dd_sub(y[j], dd_mul(l[j][k], y[k]));
        sum = dd_add(sum, dd_div(dd_mul(y[j], y[j]), pivot[j]));
    }
    return sum;
}

static double compute_farthest(const made *m, const ovoid_ellipsoid *e) {
    sym3dd q = sym3dd_from(e->q);
    double top = 0;
    for (uint32_t v = 0; v < m->p.vertex_count; v++) {
        vec3 x = vec3_at(m->vertices, v);
        const dd d[3] = {two_sum(x.x, -e->center.x), two_sum(x.y, -e->center.y), two_sum(x.z, -e->center.z)};
        top = fmax(top, compute_norm(&q, d).high);
    }
    return top;
}

static made make_body(uint64_t *s, double thin) {
    made m = made_random(8 + random_next(s) % 30, 1, s);
    mat3 map = mat3_mul(mat3_random_rotation(s), mat3_mul(mat3_diagonal(1, 1, thin), mat3_random_rotation(s)));
    made_map(&m, map, vec3_random(s));
    return m;
}

// An ellipsoid about the body, off its best one, is never found to be nearer to enclosing than it is.
static void check_enclosing(void) {
    for (int i = 0; i < 400; i++) {
        uint64_t s = check_seed = 1 + (uint64_t)i;
        made m = make_body(&s, pow(10, -4 * random_uniform(&s, 0, 1)));
        ovoid_fit fit;
        CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, NULL, &fit, NULL), OVOID_OK);
        CHECK_LE(compute_farthest(&m, &fit.ellipsoid), 1);
        CHECK_LE(1 - 1e-6, compute_farthest(&m, &fit.ellipsoid));
        factor f;
        double size;
        if (factor_make_quickly(fit.ellipsoid.q, &f, &size)) {
            double truth = compute_farthest(&m, &fit.ellipsoid);
            double bound = factor_compute_enclosing_bound(&f, &m.p, fit.ellipsoid.center);
            CHECK_LE(truth, bound);
            CHECK_LE(bound, truth * (1 + 1e-6));
        }
        made_destroy(&m);
    }
    check_seed = 0;
}

// The rough factor is below the precise one, and what it scales is found inside by the precise proof.
static void check_clear(void) {
    for (int i = 0; i < 400; i++) {
        uint64_t s = check_seed = 1 + (uint64_t)i;
        made m = make_body(&s, pow(10, -3 * random_uniform(&s, 0, 1)));
        ovoid_fit fit;
        CHECK_EQ(ovoid_ellipsoid_compute_inner(&m.p, NULL, &fit, NULL), OVOID_OK);
        ovoid_ellipsoid e = fit.ellipsoid;
        e.q = sym3_scale(e.q, random_uniform(&s, 0.5, 1.5));
        double precise = ellipsoid_compute_clear_bound(&m.p, &e),
               rough = ellipsoid_compute_clear_bound_roughly(&m.p, &e);
        CHECK_LE(rough, precise);
        CHECK_LE(precise * (1 - 1e-8), rough);
        e.q = sym3_scale(e.q, rough * rough * (1 - 8 * 0x1p-53));
        CHECK(ellipsoid_is_enclosed(&m.p, &e));
        made_destroy(&m);
    }
    check_seed = 0;
}

// The certificate in doubles is above the one in double-double, with the body's reach measured in that. 1e-13 is what
// the latter adds.
static void check_certificate(void) {
    uint64_t many = 0;
    for (int i = 0; i < 400; i++) {
        uint64_t s = check_seed = 1 + (uint64_t)i;
        made m = made_random(8 + random_next(&s) % 60, 1, &s);
        int holds = 1;
        for (uint32_t f = 0; f < m.p.facet_count; f++) holds &= m.planes[f].offset > 0.05;
        if (holds) {
            inscribed e = inscribe_solve((halfspace_set){m.planes, m.p.facet_count}, 2.5e-7);
            CHECK_LE(e.gap, 2.5e-7);
            certificate c = {.count = e.count};
            for (int k = 0; k < e.count; k++) {
                c.direction[k] = m.planes[e.item[k]].normal;
                c.weight[k] = e.weight[k] * (i % 4 ? 1 : random_uniform(&s, 0.95, 1.05));
            }
            ovoid_ellipsoid round = {e.x, lower3_square(e.map)};
            inscribed_body body = {.vertices = m.vertices, .vertex_count = m.p.vertex_count, .center = e.x};
            body.map = lower3_to_mat3(e.map), body.reach = sqrt(compute_farthest(&m, &round)) * (1 + 1e-14);
            double fine = certificate_compute_bound(&c, &body);
            double quick = certificate_compute_bound_quickly(&c, &m.p, e.x, e.map);
            CHECK_LE(fine / (1 + 1e-13), quick);
            if (i % 4) CHECK_LE(quick, 1 + 3e-7);
            many++;
        }
        made_destroy(&m);
    }
    CHECK(many > 200);
    // Weights that bound nothing are not accepted.
    certificate one = {.count = 1, .direction = {{1, 0, 0}}, .weight = {3}};
    made m = made_box(1, 1, 1);
    CHECK(certificate_compute_bound_quickly(&one, &m.p, (vec3){0, 0, 0}, (lower3){1, 0, 1, 0, 0, 1}) == INFINITY);
    made_destroy(&m);
    check_seed = 0;
}

// min 1/2 |sum x row|^2 - c.x: no slope at an unknown that stays, and none downward along one that does not.
static void check_program(void) {
    enum { ITEMS = 30 };
    for (int i = 0; i < 2000; i++) {
        uint64_t s = check_seed = 1 + (uint64_t)i;
        double row[ITEMS][QP_WIDTH] = {{0}}, c[ITEMS], sum[QP_WIDTH], d[9];
        for (int j = 0; j < 9; j++) d[j] = 3 * random_normal(&s);
        for (int k = 0; k < ITEMS; k++) {
            for (int j = 0; j < 9; j++) row[k][j] = random_normal(&s);
            // Some rows are nearly those of others.
            for (int j = 0; k % 5 == 4 && j < 9; j++) row[k][j] = row[k - 1][j] * (1 + 1e-9 * random_normal(&s));
            // A d with row . d >= c exists, so the minimum does.
            c[k] = -random_uniform(&s, 0, 1);
            for (int j = 0; j < 9; j++) c[k] += row[k][j] * d[j];
        }
        qp q;
        qp_clear(&q);
        double worst = 1;
        for (int step = 0; step < 200 && worst > 1e-9 && q.count < QP_SIZE; step++) {
            for (int j = 0; j < QP_WIDTH; j++) sum[j] = 0;
            for (int k = 0; k < q.count; k++)
                for (int j = 0; j < QP_WIDTH; j++) sum[j] += q.x[k] * q.row[k][j];
            worst = 0;
            uint32_t next = 0;
            for (uint32_t k = 0; k < ITEMS; k++) {
                double slope = c[k];
                for (int j = 0; j < QP_WIDTH; j++) slope -= sum[j] * row[k][j];
                if (qp_has(&q, k)) CHECK_NEAR(slope, 0, 1e-7);
                if (!qp_has(&q, k) && slope > worst) worst = slope, next = k;
            }
            if (!(worst > 1e-9)) break;
            memcpy(q.row[q.count], row[next], sizeof row[next]);
            q.item[q.count] = next;
            q.c[q.count] = c[next];
            qp_add(&q, 0);
            qp_settle(&q);
            for (int k = 0; k < q.count; k++) CHECK_LE(0, q.x[k]);
        }
        CHECK(worst <= 1e-9);
    }
    check_seed = 0;
}

int main(void) {
    check_factor();
    check_enclosing();
    check_clear();
    check_certificate();
    check_program();
    return check_end();
}
