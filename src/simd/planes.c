// Each lane does the same operations in the same order, none of them fused, so every set gives the same bits: the
// scalar twin's.
#include "simd/planes.h"

#include <math.h>

void simd_compute_planes_scalar(simd_triangles *t, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        double ax = t->corner[0][0][i], ay = t->corner[0][1][i], az = t->corner[0][2][i];
        double bx = t->corner[1][0][i], by = t->corner[1][1][i], bz = t->corner[1][2][i];
        double cx = t->corner[2][0][i], cy = t->corner[2][1][i], cz = t->corner[2][2][i];
        double ux = bx - ax, uy = by - ay, uz = bz - az, vx = cx - ax, vy = cy - ay, vz = cz - az;
        double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        double area = (nx * nx + ny * ny) + nz * nz;
        double u = (ux * ux + uy * uy) + uz * uz, v = (vx * vx + vy * vy) + vz * vz;
        double scale = 1 / sqrt(area > SIMD_AREA_MIN ? area : 1);
        nx *= scale, ny *= scale, nz *= scale;
        double na = (nx * ax + ny * ay) + nz * az, nb = (nx * bx + ny * by) + nz * bz;
        double nc = (nx * cx + ny * cy) + nz * cz, least = nb < nc ? nb : nc;
        t->n[0][i] = nx, t->n[1][i] = ny, t->n[2][i] = nz;
        t->low[i] = na < least ? na : least;
        t->area[i] = area;
        t->product[i] = u * v;
        t->sum[i] = u + v;
    }
}

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define AVX2 __attribute__((target("avx2"))) static inline

/// Four vectors.
typedef struct vectors {
    __m256d x, y, z;
} vectors;

AVX2 vectors load(double (*corner)[SIMD_TRIANGLES], uint32_t i) {
    return (vectors){_mm256_loadu_pd(corner[0] + i), _mm256_loadu_pd(corner[1] + i), _mm256_loadu_pd(corner[2] + i)};
}
AVX2 vectors subtract(vectors a, vectors b) {
    return (vectors){_mm256_sub_pd(a.x, b.x), _mm256_sub_pd(a.y, b.y), _mm256_sub_pd(a.z, b.z)};
}
AVX2 __m256d dot(vectors a, vectors b) {
    __m256d xy = _mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y));
    return _mm256_add_pd(xy, _mm256_mul_pd(a.z, b.z));
}
AVX2 vectors cross(vectors a, vectors b) {
    return (vectors){_mm256_sub_pd(_mm256_mul_pd(a.y, b.z), _mm256_mul_pd(a.z, b.y)),
                     _mm256_sub_pd(_mm256_mul_pd(a.z, b.x), _mm256_mul_pd(a.x, b.z)),
                     _mm256_sub_pd(_mm256_mul_pd(a.x, b.y), _mm256_mul_pd(a.y, b.x))};
}

AVX2 void compute_four(simd_triangles *t, uint32_t i) {
    const __m256d one = _mm256_set1_pd(1);
    vectors a = load(t->corner[0], i), b = load(t->corner[1], i), c = load(t->corner[2], i);
    vectors u = subtract(b, a), v = subtract(c, a), n = cross(u, v);
    __m256d area = dot(n, n), uu = dot(u, u), vv = dot(v, v);
    __m256d is_wide = _mm256_cmp_pd(area, _mm256_set1_pd(SIMD_AREA_MIN), _CMP_GT_OQ);
    __m256d scale = _mm256_div_pd(one, _mm256_sqrt_pd(_mm256_blendv_pd(one, area, is_wide)));
    n = (vectors){_mm256_mul_pd(n.x, scale), _mm256_mul_pd(n.y, scale), _mm256_mul_pd(n.z, scale)};
    // minsd's rule, that the second is taken unless the first is less, is that of the scalar twin.
    __m256d low = _mm256_min_pd(dot(n, a), _mm256_min_pd(dot(n, b), dot(n, c)));
    _mm256_storeu_pd(t->n[0] + i, n.x);
    _mm256_storeu_pd(t->n[1] + i, n.y);
    _mm256_storeu_pd(t->n[2] + i, n.z);
    _mm256_storeu_pd(t->low + i, low);
    _mm256_storeu_pd(t->area + i, area);
    _mm256_storeu_pd(t->product + i, _mm256_mul_pd(uu, vv));
    _mm256_storeu_pd(t->sum + i, _mm256_add_pd(uu, vv));
}

__attribute__((target("avx2"))) static void compute_planes_avx2(simd_triangles *t, uint32_t count) {
    for (uint32_t i = 0; i < count; i += 4) compute_four(t, i);
}

void simd_compute_planes(simd_triangles *t, uint32_t count) {
    if (__builtin_cpu_supports("avx2"))
        compute_planes_avx2(t, count);
    else
        simd_compute_planes_scalar(t, count);
}

#else

void simd_compute_planes(simd_triangles *t, uint32_t count) { simd_compute_planes_scalar(t, count); }

#endif
