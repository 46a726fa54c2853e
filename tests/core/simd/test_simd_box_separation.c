// The axes of two boxes: every instruction set against the scalar twin, bit for bit; and the twin against long double.
// The gap that it states is that of the corners along its normal, to 1e-13 of boxes of size 1 to 5; an axis is found
// where one of the 15 separates the boxes by more than asked and 1e-9, and none where none does.

#include "simd/box_axes.h"

#include "check.h"

typedef long double real;

typedef struct boxes {
    double a[9], b[9], half_a[3], half_b[3];
    vec3 between;
    double least;
} boxes;

static long met[3]; ///< by a face, by edges, by nothing

static void turn(uint64_t *s, double rows[9]) {
    vec3 x = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
    vec3 y = vec3_unit(vec3_cross(x, (vec3){random_normal(s), random_normal(s), random_normal(s)})),
         z = vec3_cross(x, y);
    const vec3 columns[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        rows[i] = columns[i].x;
        rows[3 + i] = columns[i].y;
        rows[6 + i] = columns[i].z;
    }
}

/// Kinds: any; common axes; an edge turned by little; slabs and needles; with a margin.
static boxes make_boxes(uint64_t *s) {
    boxes q = {.least = 0};
    int kind = (int)(random_next(s) % 5);
    turn(s, q.a);
    turn(s, q.b);
    double tilt = pow(10, random_uniform(s, -12, -1));
    if (kind == 1) memcpy(q.b, q.a, sizeof q.b);
    if (kind == 2)
        for (int i = 0; i < 3; i++) {
            // About A's third edge.
            q.b[3 * i] = cos(tilt) * q.a[3 * i] + sin(tilt) * q.a[3 * i + 1];
            q.b[3 * i + 1] = cos(tilt) * q.a[3 * i + 1] - sin(tilt) * q.a[3 * i];
            q.b[3 * i + 2] = q.a[3 * i + 2];
        }
    for (int i = 0; i < 3; i++) {
        q.half_a[i] = random_uniform(s, 0.2, 1) * (kind == 3 && random_next(s) % 2 ? 1e-3 : 1);
        q.half_b[i] = random_uniform(s, 0.2, 1) * (kind == 3 && random_next(s) % 2 ? 1e-3 : 1);
    }
    q.between = (vec3){0.8 * random_normal(s), 0.8 * random_normal(s), 0.8 * random_normal(s)};
    if (kind == 4) q.least = random_uniform(s, 0, 0.5);
    return q;
}

static box_separation_query make_query(const boxes *q) {
    return (box_separation_query){q->a, q->b, q->half_a, q->half_b, q->between, q->least};
}

static real get_reach(const double rows[9], const double half[3], const real n[3]) {
    real sum = 0;
    for (int k = 0; k < 3; k++) sum += half[k] * fabsl(n[0] * rows[k] + n[1] * rows[3 + k] + n[2] * rows[6 + k]);
    return sum;
}

static real get_gap(const boxes *q, const real n[3]) {
    real along = n[0] * q->between.x + n[1] * q->between.y + n[2] * q->between.z;
    return fabsl(along) - get_reach(q->a, q->half_a, n) - get_reach(q->b, q->half_b, n);
}

/// The largest gap along the 15 axes.
static real find_widest(const boxes *q) {
    real widest = -INFINITY;
    for (int i = 0; i < 15; i++) {
        real n[3], norm = 0;
        for (int c = 0; c < 3; c++) {
            const double *a = q->a, *b = q->b;
            int j = (c + 1) % 3, k = (c + 2) % 3, e = (i - 6) / 3, f = (i - 6) % 3;
            if (i < 6)
                n[c] = (i < 3 ? a : b)[3 * c + i % 3];
            else
                n[c] = (real)a[3 * j + e] * b[3 * k + f] - (real)a[3 * k + e] * b[3 * j + f];
            norm += n[c] * n[c];
        }
        norm = sqrtl(norm);
        if (!(norm > 1e-4L)) continue;
        for (int c = 0; c < 3; c++) n[c] /= norm;
        widest = fmaxl(widest, get_gap(q, n));
    }
    return widest;
}

/// The corners of the boxes along the normal, from A's centre.
static real get_corner_gap(const boxes *q, const box_separation *x) {
    real sum = (real)x->n.x * q->between.x + (real)x->n.y * q->between.y + (real)x->n.z * q->between.z;
    for (int k = 0; k < 3; k++) {
        real a = (real)x->n.x * q->a[k] + (real)x->n.y * q->a[3 + k] + (real)x->n.z * q->a[6 + k];
        real b = (real)x->n.x * q->b[k] + (real)x->n.y * q->b[3 + k] + (real)x->n.z * q->b[6 + k];
        sum += (x->low_b >> k & 1 ? 1 : -1) * q->half_b[k] * b - (x->high_a >> k & 1 ? 1 : -1) * q->half_a[k] * a;
    }
    return sum;
}

static void check_found(const boxes *q, const box_separation *x) {
    real n[3] = {x->n.x, x->n.y, x->n.z};
    CHECK(fabsl(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-15L);
    CHECK(n[0] * q->between.x + n[1] * q->between.y + n[2] * q->between.z > 0);
    CHECK(fabsl(get_gap(q, n) - x->gap) < 1e-13L);
    CHECK(fabsl(get_corner_gap(q, x) - x->gap) < 1e-13L);
    CHECK(x->high_a < 8 && x->low_b < 8);
    CHECK(x->gap > q->least - 1e-9);
}

static int is_face(const boxes *q, vec3 n) {
    for (int i = 0; i < 6; i++) {
        const double *rows = i < 3 ? q->a : q->b;
        if (fabs(n.x * rows[i % 3] + n.y * rows[3 + i % 3] + n.z * rows[6 + i % 3]) > 1 - 1e-12) return 1;
    }
    return 0;
}

int main(void) {
    uint64_t s = 11;
    for (int trial = 0; trial < 100000; trial++) {
        boxes b = make_boxes(&s);
        const box_separation_query q = make_query(&b);
        box_separation x = {.gap = 0}, y = {.gap = 0};
        int is_found = box_separation_get(SIMD_SCALAR)(&q, &x);
        met[is_found ? !is_face(&b, x.n) : 2]++;
        real widest = find_widest(&b);
        if (widest > b.least + 1e-9) CHECK_EQ(is_found, 1);
        if (is_found) check_found(&b, &x);
        for (int isa = SIMD_AVX2; isa <= SIMD_AVX512; isa++) {
            box_separation_function *other = box_separation_get((simd_isa)isa);
            if (!other) continue;
            CHECK_EQ(other(&q, &y), is_found);
            if (is_found) CHECK(memcmp(&x, &y, sizeof x) == 0);
        }
    }
    for (int i = 0; i < 3; i++) CHECK(met[i] > 1000);
    printf("apart by a face %ld, by edges %ld, not apart %ld\n", met[0], met[1], met[2]);
    return check_end();
}
