// Each lane does the same operations in the same order, none of them fused, so every set gives the same bits: the
// scalar twin's.
#include "simd/planes.h"

#include <math.h>

void simd_compute_cone_scalar(simd_cone *c, uint32_t count, vec3 apex) {
    for (uint32_t i = 0; i < count; i++) {
        double ux = c->edge[0][i], uy = c->edge[1][i], uz = c->edge[2][i];
        double vx = c->edge[0][i + 1], vy = c->edge[1][i + 1], vz = c->edge[2][i + 1];
        double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        double area = (nx * nx + ny * ny) + nz * nz;
        double u = (ux * ux + uy * uy) + uz * uz, v = (vx * vx + vy * vy) + vz * vz;
        double scale = 1 / sqrt(area > SIMD_AREA_MIN ? area : 1);
        nx *= scale, ny *= scale, nz *= scale;
        c->n[0][i] = nx, c->n[1][i] = ny, c->n[2][i] = nz;
        c->offset[i] = (nx * apex.x + ny * apex.y) + nz * apex.z;
        c->area[i] = area;
        c->product[i] = u * v;
        c->sum[i] = u + v;
    }
}

#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/kernels/vectors.h"

#define AVX2 __attribute__((target("avx2"))) static inline

AVX2 vectors4 load(double (*edge)[SIMD_CONE + 4], uint32_t i) {
    return vectors4_load(edge[0] + i, edge[1] + i, edge[2] + i);
}

AVX2 void compute_four(simd_cone *c, uint32_t i, vectors4 apex) {
    const __m256d one = _mm256_set1_pd(1);
    vectors4 u = load(c->edge, i), v = load(c->edge, i + 1), n = vectors4_cross(u, v);
    __m256d area = vectors4_dot(n, n), uu = vectors4_dot(u, u), vv = vectors4_dot(v, v);
    __m256d is_wide = _mm256_cmp_pd(area, _mm256_set1_pd(SIMD_AREA_MIN), _CMP_GT_OQ);
    __m256d scale = _mm256_div_pd(one, _mm256_sqrt_pd(_mm256_blendv_pd(one, area, is_wide)));
    n = (vectors4){_mm256_mul_pd(n.x, scale), _mm256_mul_pd(n.y, scale), _mm256_mul_pd(n.z, scale)};
    _mm256_storeu_pd(c->n[0] + i, n.x);
    _mm256_storeu_pd(c->n[1] + i, n.y);
    _mm256_storeu_pd(c->n[2] + i, n.z);
    _mm256_storeu_pd(c->offset + i, vectors4_dot(n, apex));
    _mm256_storeu_pd(c->area + i, area);
    _mm256_storeu_pd(c->product + i, _mm256_mul_pd(uu, vv));
    _mm256_storeu_pd(c->sum + i, _mm256_add_pd(uu, vv));
}

__attribute__((target("avx2"))) static void compute_cone_avx2(simd_cone *c, uint32_t count, vec3 apex) {
    vectors4 all = vectors4_spread(apex);
    for (uint32_t i = 0; i < count; i += 4) compute_four(c, i, all);
}

void simd_compute_cone(simd_cone *c, uint32_t count, vec3 apex) {
    if (__builtin_cpu_supports("avx2"))
        compute_cone_avx2(c, count, apex);
    else
        simd_compute_cone_scalar(c, count, apex);
}

#else

void simd_compute_cone(simd_cone *c, uint32_t count, vec3 apex) { simd_compute_cone_scalar(c, count, apex); }

#endif
