// After the signed volumes of M. Montanari, N. Petrinic, E. Barbieri, Improving the GJK algorithm for faster and more
// reliable distance queries between convex objects, 2017, and C. Muratori, Implementing GJK, 2006, who decides the case
// from the newest corner. The nearest point lies on a face, an edge or at the new corner, as it is nearer than any
// point of the old simplex.
//
// With a the new corner, e_i the edges from it to the old ones (lane i), c_i = a x e_i, n_i = e_i x e_j where j follows
// i:
// - the face (i, j) is between the origin and the tetrahedron iff n_i.a has the sign of the tetrahedron's volume,
//   n_i.e_k with the third edge;
// - in its plane the origin is on the face's side of edge i iff n_i.c_i > 0, of edge j iff n_i.c_j < 0;
// - the origin is before edge i iff a.e_i < 0.
// The conditions of Karush, Kuhn and Tucker, of which exactly one set holds, are combinations of these bits; so all
// candidates are computed in lanes, without a branch, a division or a root, and one is picked. The directions are
// n_i, e_i x c_i and a: orthogonal to their face or edge to rounding, also where the nearest point is almost 0.
#include "base/compiler.h"
#include "simd/kernels/corner_pick.h"

#include <math.h>

static inline double dot(const double a[3], const double b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static inline void cross(double out[3], const double a[3], const double b[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

// The candidates: faces in 0 to 2, edges in 4 to 6, the corner in 7. Squares of the edges' lengths.
typedef struct candidates {
    double x[8], y[8], z[8], edge[4];
} candidates;

static inline void set_candidate(candidates *all, int i, const double n[3], double sign) {
    all->x[i] = n[0] * sign;
    all->y[i] = n[1] * sign;
    all->z[i] = n[2] * sign;
}

static inline unsigned sign(double x, int i) { return (unsigned)(signbit(x) != 0) << i; }

// The candidate that the bits name: of the faces, of the edges, else the corner.
static corner_step pick(const candidates *all, unsigned bits, int is_inside) {
    static const uint8_t next[4] = {1, 2, 0, 3};
    unsigned i = (unsigned)compiler_count_low_zeros(bits | 1u << 7);
    double x = all->x[i], y = all->y[i], z = all->z[i], square = (x * x + y * y) + z * z;
    int is_sliver = (i < 3) & !(square > 1e-4 * (all->edge[i & 3] * all->edge[next[i & 3]]));
    return (corner_step){x, y, z, square, corner_kept[i], is_inside, is_sliver};
}

corner_step simd_step_from_corner_scalar(const corner_lanes *old, unsigned valid, vec3 a) {
    double w[3] = {a.x, a.y, a.z}, e[3][3], c[3][3];
    candidates all;
    unsigned behind = 0, first = 0, next = 0, before = 0;
    for (int i = 0; i < 3; i++) {
        e[i][0] = old->x[i] - a.x;
        e[i][1] = old->y[i] - a.y;
        e[i][2] = old->z[i] - a.z;
        cross(c[i], w, e[i]);
        before |= sign(dot(w, e[i]), i);
        all.edge[i] = dot(e[i], e[i]);
    }
    for (int i = 0; i < 3; i++) {
        double n[3], k[3];
        int j = (i + 1) % 3;
        cross(n, e[i], e[j]);
        cross(k, e[i], c[i]);
        double height = dot(n, w);
        behind |= sign(height, i) ^ sign(dot(n, e[(i + 2) % 3]), i);
        first |= sign(dot(n, c[i]), i) ^ 1u << i;
        next |= sign(dot(n, c[j]), i);
        set_candidate(&all, i, n, signbit(height) ? -1 : 1);
        set_candidate(&all, 4 + i, k, 1);
    }
    set_candidate(&all, 7, w, 1);
    // A face needs both of its old corners; a flat simplex has the origin on no certain side.
    unsigned faces = valid & (valid >> 1 | valid << 2) & 7;
    behind &= valid == 7 ? 7 : 0;
    first &= faces;
    next &= faces;
    unsigned of_face = first | (next << 1 & 7) | next >> 2;
    return pick(&all, (first & next & ~behind) | (before & ~of_face & valid & 7) << 4, behind == 7);
}

#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/kernels/corner_avx2.h"

__attribute__((target("avx2"))) static corner_step step_avx2(const corner_lanes *old, unsigned valid, const vec3 *a) {
    vectors4 corners = {_mm256_load_pd(old->x), _mm256_load_pd(old->y), _mm256_load_pd(old->z)};
    return corner_step_avx2(corners, valid, vectors4_spread(*a));
}

corner_step simd_step_from_corner(const corner_lanes *old, unsigned valid, const vec3 *a) {
    if (__builtin_cpu_supports("avx2")) return step_avx2(old, valid, a);
    return simd_step_from_corner_scalar(old, valid, *a);
}

#else

corner_step simd_step_from_corner(const corner_lanes *old, unsigned valid, const vec3 *a) {
    return simd_step_from_corner_scalar(old, valid, *a);
}

#endif
