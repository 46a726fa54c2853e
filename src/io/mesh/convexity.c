// Does a mesh fill its hull? What a closed surface encloses is the sum of the signed tetrahedra that its triangles span
// with any one point (the divergence theorem); it is compared with the volume of the hull. A hollow counts as outside.
//
// Closed: each edge is passed as often one way as the other. That is when the sum does not depend on the point. It is
// tested without a table: a hash of each edge, of its points' coordinates so that equal points count as one, is added
// one way and subtracted the other; the sum is zero for every closed surface, and for others with a chance of 2^-64.
// Cost: linear in the indices.
#include "io/mesh/mesh_build.h"

#include <math.h>
#include <string.h>

// Vertices are off by rounding. Coordinates of six digits, and floats: by so much of the largest coordinate, in any of
// three directions.
#define DIGITS 1e-6

// Coordinates that are all multiples of a power of ten: by half of that in each of three directions; but that is no
// rounding any more where it is above this share of the diagonal, as of a body of whole numbers.
#define COARSEST 1e-5

// Less than this share of the hull is of no weight.
#define SHARE 1e-6

static uint64_t mix(uint64_t h) {
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 27) * 0x94d049bb133111ebu;
    return h ^ h >> 31;
}

static uint64_t hash_point(const double *xyz) {
    uint64_t h = 0;
    for (int k = 0; k < 3; k++) {
        double v = xyz[k] + 0.0; // -0 is equal to 0
        uint64_t bits;
        memcpy(&bits, &v, sizeof bits);
        h = mix(h + bits + 0x9e3779b97f4a7c15u);
    }
    return h;
}

// The hash of an edge; of the same edge the other way round, minus that.
static uint64_t hash_edge(uint64_t from, uint64_t to) {
    if (from < to) return mix(from + 0x9e3779b97f4a7c15u * to);
    return from == to ? 0 : 0 - mix(to + 0x9e3779b97f4a7c15u * from);
}

static const double *get_point(const ovoid_faces *f, size_t index) {
    return f->vertices + 3 * (size_t)f->indices[index];
}

// The determinant of three points, seen from o.
static double compute_determinant(const double *o, const double *p, const double *q, const double *r) {
    double a[3], b[3], c[3];
    for (int k = 0; k < 3; k++) a[k] = p[k] - o[k], b[k] = q[k] - o[k], c[k] = r[k] - o[k];
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// What the faces enclose; NaN where they are no closed surface. Whether all are seen from outside or from inside does
// not matter.
static double compute_volume(const ovoid_faces *f) {
    double sum = 0;
    uint64_t open = 0;
    for (size_t face = 0, first = 0; face < f->face_count; face++) {
        size_t size = f->sizes[face];
        uint64_t begin = size ? hash_point(get_point(f, first)) : 0, last = begin;
        for (size_t i = 1; i < size; i++) {
            uint64_t next = hash_point(get_point(f, first + i));
            open += hash_edge(last, next);
            last = next;
            if (i > 1)
                sum += compute_determinant(f->vertices, get_point(f, first), get_point(f, first + i - 1),
                                           get_point(f, first + i));
        }
        open += hash_edge(last, begin);
        first += size;
    }
    return f->face_count && !open ? fabs(sum) / 6 : NAN;
}

static int are_multiples(const ovoid_faces *f, double step) {
    for (size_t i = 0; i < 3 * f->vertex_count; i++) {
        double count = f->vertices[i] / step;
        if (!(fabs(count - rint(count)) <= 1e-6)) return 0;
    }
    return 1;
}

// How far vertices may be off. Steps from the coarsest that is no more than COARSEST down to what DIGITS has anyway.
static double find_rounding(const ovoid_faces *f, double diagonal) {
    double most = 0;
    for (size_t i = 0; i < 3 * f->vertex_count; i++) most = fmax(most, fabs(f->vertices[i]));
    double least = DIGITS * most, half_diagonal = 0.5 * sqrt(3);
    if (!(diagonal > 0 && most < 1e300)) return least;
    double step = pow(10, floor(log10(COARSEST * diagonal / half_diagonal)));
    for (; half_diagonal * step > least; step /= 10)
        if (are_multiples(f, step)) return half_diagonal * step;
    return least;
}

ovoid_convexity ovoid_mesh_compute_convexity(const ovoid_mesh *mesh, size_t part, const ovoid_shape *hull) {
    ovoid_faces faces = ovoid_mesh_get_part(mesh, part).faces;
    ovoid_measures m = ovoid_shape_get_measures(hull);
    ovoid_convexity c = {compute_volume(&faces), m.volume, 0};
    double diagonal = hypot(hypot(m.box.max.x - m.box.min.x, m.box.max.y - m.box.min.y), m.box.max.z - m.box.min.z);
    // Points that are off by d take from a convex body, or give to it, no more than a layer d thick on its surface.
    double allowed = fmax(SHARE * m.volume, find_rounding(&faces, diagonal) * m.area);
    // No surface encloses more than its hull: faces that are there twice are none.
    if (c.mesh_volume - m.volume > allowed) c.mesh_volume = NAN;
    c.is_nonconvex = m.volume - c.mesh_volume > allowed;
    return c;
}
