// After the signed volumes of M. Montanari, N. Petrinic, E. Barbieri, Improving the GJK algorithm for faster and more
// reliable distance queries between convex objects, 2017, and C. Muratori, Implementing GJK, 2006, who decides the case
// from the newest corner. The nearest point lies on a face, an edge or at the new corner, as it is nearer than any
// point of the old simplex.
//
// With a the new corner, e_i the edges from it to the old ones (lane i), c_i = a x e_i, n_i = e_i x e_j where j follows
// i:
// - the face (i, j) is between the origin and the tetrahedron iff n_i.a has the sign of the tetrahedron's volume;
// - in its plane the origin is on the face's side of edge i iff n_i.c_i > 0, of edge j iff n_i.c_j < 0;
// - the origin is before edge i iff a.e_i < 0.
// The conditions of Karush, Kuhn and Tucker, of which exactly one set holds, are combinations of these bits; so all
// candidates are computed in lanes, without a branch, a division or a root, and one is picked. The directions are
// n_i, e_i x c_i and a: orthogonal to their face or edge to rounding, also where the nearest point is almost 0.
#include "simd/corner.h"

#include <stdint.h>

// The candidates: faces in 0 to 2, edges in 4 to 6, the corner in 7.
typedef struct candidates {
    _Alignas(32) double x[8];
    _Alignas(32) double y[8];
    _Alignas(32) double z[8];
} candidates;

// The signs, a bit for each lane.
typedef struct signs {
    unsigned above;    // n_i.a >= 0
    unsigned positive; // the volume is: 7 or 0
    unsigned in_first; // n_i.c_i > 0
    unsigned in_next;  // n_i.c_j < 0
    unsigned before;   // a.e_i < 0
    unsigned sliver;   // |n_i|^2 <= 1e-4 |e_i|^2 |e_j|^2
} signs;

static inline corner_step pick(const candidates *all, signs s, unsigned valid) {
    static const uint8_t kept[8] = {1 | 2, 2 | 4, 4 | 1, 0, 1, 2, 4, 0};
    // A face needs both of its old corners; a flat simplex has the origin on no certain side.
    unsigned faces = valid & (valid >> 1 | valid << 2) & 7;
    unsigned out = valid == 7 ? ~(s.above ^ s.positive) & 7 : 7;
    unsigned first = s.in_first & faces, next = s.in_next & faces;
    unsigned face = out & first & next;
    unsigned inside_of = first | (next << 1 & 7) | next >> 2;
    unsigned edge = s.before & ~inside_of & valid;
    unsigned i = (unsigned)__builtin_ctz(face | edge << 4 | 1u << 7);
    return (corner_step){all->x[i], all->y[i], all->z[i], kept[i], out == 0, s.sliver >> i & 1};
}

static inline double dot(const double a[3], const double b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static inline void cross(double out[3], const double a[3], const double b[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void set_candidate(candidates *all, int i, const double n[3], double sign) {
    all->x[i] = n[0] * sign;
    all->y[i] = n[1] * sign;
    all->z[i] = n[2] * sign;
}

corner_step simd_step_from_corner_scalar(const corner_lanes *old, unsigned valid, double ax, double ay, double az) {
    double a[3] = {ax, ay, az}, e[3][3], c[3][3];
    candidates all;
    signs s = {0, 0, 0, 0, 0, 0};
    for (int i = 0; i < 3; i++) {
        e[i][0] = old->x[i] - ax;
        e[i][1] = old->y[i] - ay;
        e[i][2] = old->z[i] - az;
        cross(c[i], a, e[i]);
        s.before |= (unsigned)(dot(a, e[i]) < 0) << i;
    }
    for (int i = 0; i < 3; i++) {
        double n[3], k[3];
        int j = (i + 1) % 3;
        cross(n, e[i], e[j]);
        cross(k, e[i], c[i]);
        double height = dot(n, a);
        s.above |= (unsigned)(height >= 0) << i;
        s.in_first |= (unsigned)(dot(n, c[i]) > 0) << i;
        s.in_next |= (unsigned)(dot(n, c[j]) < 0) << i;
        s.sliver |= (unsigned)!(dot(n, n) > 1e-4 * dot(e[i], e[i]) * dot(e[j], e[j])) << i;
        if (i == 0 && dot(n, e[2]) > 0) s.positive = 7;
        set_candidate(&all, i, n, height < 0 ? -1 : 1);
        set_candidate(&all, 4 + i, k, 1);
    }
    set_candidate(&all, 7, a, 1);
    return pick(&all, s, valid);
}

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define AVX2 __attribute__((target("avx2")))

typedef struct lanes3 {
    __m256d x, y, z;
} lanes3;

AVX2 static inline __m256d dot4(lanes3 a, lanes3 b) {
    return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)), _mm256_mul_pd(a.z, b.z));
}

AVX2 static inline lanes3 cross4(lanes3 a, lanes3 b) {
    return (lanes3){_mm256_sub_pd(_mm256_mul_pd(a.y, b.z), _mm256_mul_pd(a.z, b.y)),
                    _mm256_sub_pd(_mm256_mul_pd(a.z, b.x), _mm256_mul_pd(a.x, b.z)),
                    _mm256_sub_pd(_mm256_mul_pd(a.x, b.y), _mm256_mul_pd(a.y, b.x))};
}

/// Lane i becomes the old lane that follows i.
#define NEXT(v) _mm256_permute4x64_pd(v, 0xc9)

AVX2 static inline lanes3 next4(lanes3 a) { return (lanes3){NEXT(a.x), NEXT(a.y), NEXT(a.z)}; }

AVX2 static inline unsigned mask4(__m256d v) { return (unsigned)_mm256_movemask_pd(v); }

AVX2 static corner_step step_from_corner_avx2(const corner_lanes *old, unsigned valid, double ax, double ay,
                                              double az) {
    lanes3 a = {_mm256_set1_pd(ax), _mm256_set1_pd(ay), _mm256_set1_pd(az)};
    lanes3 e = {_mm256_sub_pd(_mm256_load_pd(old->x), a.x), _mm256_sub_pd(_mm256_load_pd(old->y), a.y),
                _mm256_sub_pd(_mm256_load_pd(old->z), a.z)};
    lanes3 f = next4(e), c = cross4(a, e), n = cross4(e, f), k = cross4(e, c);
    __m256d zero = _mm256_setzero_pd(), height = dot4(n, a), ee = dot4(e, e);

    // The signs. The volume is that of lane 0: n_0.e_2.
    signs s;
    s.above = mask4(_mm256_cmp_pd(height, zero, _CMP_GE_OQ)) & 7;
    s.in_first = mask4(_mm256_cmp_pd(dot4(n, c), zero, _CMP_GT_OQ));
    s.in_next = mask4(_mm256_cmp_pd(dot4(n, next4(c)), zero, _CMP_LT_OQ));
    s.before = mask4(_mm256_cmp_pd(dot4(a, e), zero, _CMP_LT_OQ));
    s.positive = mask4(_mm256_cmp_pd(dot4(n, next4(f)), zero, _CMP_GT_OQ)) & 1 ? 7 : 0;
    __m256d least = _mm256_mul_pd(_mm256_mul_pd(_mm256_set1_pd(1e-4), ee), NEXT(ee));
    s.sliver = ~mask4(_mm256_cmp_pd(dot4(n, n), least, _CMP_GT_OQ)) & 7;

    // Faces point away from the origin; the corner is the fourth of the edges.
    candidates all;
    __m256d flip = _mm256_and_pd(_mm256_cmp_pd(height, zero, _CMP_LT_OQ), _mm256_set1_pd(-0.0));
    _mm256_store_pd(all.x, _mm256_xor_pd(n.x, flip));
    _mm256_store_pd(all.y, _mm256_xor_pd(n.y, flip));
    _mm256_store_pd(all.z, _mm256_xor_pd(n.z, flip));
    _mm256_store_pd(all.x + 4, _mm256_blend_pd(k.x, a.x, 8));
    _mm256_store_pd(all.y + 4, _mm256_blend_pd(k.y, a.y, 8));
    _mm256_store_pd(all.z + 4, _mm256_blend_pd(k.z, a.z, 8));
    return pick(&all, s, valid);
}

corner_step simd_step_from_corner(const corner_lanes *old, unsigned valid, double ax, double ay, double az) {
    if (__builtin_cpu_supports("avx2")) return step_from_corner_avx2(old, valid, ax, ay, az);
    return simd_step_from_corner_scalar(old, valid, ax, ay, az);
}

#else

corner_step simd_step_from_corner(const corner_lanes *old, unsigned valid, double ax, double ay, double az) {
    return simd_step_from_corner_scalar(old, valid, ax, ay, az);
}

#endif
