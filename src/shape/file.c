// The file of a shape (".ovoid"): version 1; 2 where it has an allowance; 3 with the triangles of its hull, for solids
// of many vertices; 4 and 5 are 2 and 3 with the allowance's axis; 6 and 7 are 4 and 5 of cylinders and cones, with
// their lengths; 8 is 2 of ellipsoids, with their half axes. Files of these versions are read; 9 to 16, which are
// written, are the same with a checksum by words. docs/polytope.md has the table.
//
// A file holds what cannot be recomputed: the vertices, the fitted ellipsoids, the radius, the allowance, and the
// report of the given points. Facets, adjacency, planes and measures depend on the vertices and the triangles alone,
// and the triangles on the vertices alone, bit for bit (polytope/hull.h). They are computed again, except for triangles
// that a file holds: these are proven to be the hull (polytope/surface_proof.h), which takes a fraction of the time of
// finding them. So nothing in a file can contradict the vertices.
//
// Reading checks every byte: the checksum (whose every step is a bijection, so that it detects every single wrong byte
// or word), the size against the count, the range of every number, that all vertices are extreme and in the body
// frame, that the rank is right, and that the ellipsoids are proven to enclose and to be enclosed.
#include "shape/file.h"
#include "base/allocator.h"
#include "base/arena.h"
#include "base/environment.h"
#include "base/error.h"
#include "ellipsoid/contain.h"
#include "linear/exact.h"
#include "polytope/hull.h"
#include "polytope/points.h"
#include "shape/block.h"
#include "shape/create.h"
#include "shape/round.h"
#include "tools/checksum.h"

#include <string.h>

#define OUTER_AT 104
#define INNER_AT 216
#define HEADER_SIZE 328
#define ALLOWANCE_AT HEADER_SIZE
#define ALLOWANCE_SIZE 16
#define AXIS_SIZE 24
#define ROUND_SIZE 24
#define HALF_AXES_SIZE 24
#define VERSION_ELLIPSOID 8
// Added to a version whose checksum is by words.
#define VERSION_WORDS 8
#define VERSION_MOST (VERSION_ELLIPSOID + VERSION_WORDS)
#define CHECKSUM_SIZE 8
static const uint8_t magic[8] = {0x89, 'O', 'V', 'O', 'I', 'D', '\n', 0x1a};

// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991), a byte at a time.
static uint64_t compute_checksum_by_bytes(const uint8_t *bytes, size_t size) {
    uint64_t h = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++) h = (h ^ bytes[i]) * 0x100000001b3u;
    return h;
}

// The properties of a file that depend on its version.
typedef struct layout {
    uint32_t version; // without VERSION_WORDS
    uint32_t has_words;
    size_t vertices_at, triangles_at, size; // bytes
    uint32_t triangle_count;                // in the file
} layout;

// The version without what its checksum adds.
static uint32_t get_plain(uint32_t written) { return written > VERSION_WORDS ? written - VERSION_WORDS : written; }

static int has_half_axes(uint32_t version) { return version == VERSION_ELLIPSOID; }
static int has_triangles(uint32_t version) { return version >= 3 && version % 2 == 1; }
static int has_axis(uint32_t version) { return version >= 4 && !has_half_axes(version); }
static int has_round(uint32_t version) { return version >= 6 && !has_half_axes(version); }

// By Euler's formula a solid of n vertices has 2 n - 4 triangles.
static layout make_layout(uint32_t written, uint32_t vertex_count) {
    uint32_t version = get_plain(written);
    layout l = {.version = version, .has_words = written > VERSION_WORDS};
    l.vertices_at = HEADER_SIZE + (version > 1 ? ALLOWANCE_SIZE : 0);
    if (has_axis(version)) l.vertices_at += AXIS_SIZE;
    if (has_round(version)) l.vertices_at += ROUND_SIZE;
    if (has_half_axes(version)) l.vertices_at += HALF_AXES_SIZE;
    l.triangles_at = l.vertices_at + (size_t)vertex_count * 24;
    l.triangle_count = has_triangles(version) && vertex_count > 3 ? 2 * vertex_count - 4 : 0;
    l.size = l.triangles_at + (size_t)l.triangle_count * 12 + CHECKSUM_SIZE;
    return l;
}

static uint64_t compute_checksum(const layout *l, const uint8_t *bytes) {
    size_t size = l->size - CHECKSUM_SIZE;
    return l->has_words ? checksum_words(bytes, size) : compute_checksum_by_bytes(bytes, size);
}

// ---- writing ----

typedef struct writer {
    uint8_t *at;
} writer;

static void put_integer(writer *w, uint64_t value, int bytes) {
    for (int i = 0; i < bytes; i++) *w->at++ = (uint8_t)(value >> 8 * i);
}

static void put_double(writer *w, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_integer(w, bits, 8);
}

static void put_vec3(writer *w, ovoid_vec3 v) {
    put_double(w, v.x);
    put_double(w, v.y);
    put_double(w, v.z);
}

static void put_fit(writer *w, const ovoid_fit *f, uint32_t mark) {
    const ovoid_sym3 *q = &f->ellipsoid.q;
    put_vec3(w, f->ellipsoid.center);
    put_vec3(w, (ovoid_vec3){q->xx, q->xy, q->xz});
    put_vec3(w, (ovoid_vec3){q->yy, q->yz, q->zz});
    put_vec3(w, (ovoid_vec3){f->volume, f->gap, f->beta});
    put_integer(w, f->iterations, 4);
    put_integer(w, f->converged, 4);
    put_integer(w, f->facet, 4);
    put_integer(w, mark, 4);
}

size_t shape_write_version(const ovoid_shape *shape, uint32_t written, void *buffer, size_t capacity) {
    layout l = make_layout(written, shape->vertex_count);
    uint32_t version = l.version;
    if (!buffer || capacity < l.size) return l.size;
    writer w = {buffer};
    memcpy(w.at, magic, sizeof magic);
    w.at += sizeof magic;
    put_integer(&w, written, 4);
    put_integer(&w, shape->rank, 4);
    put_integer(&w, l.size, 8);
    put_integer(&w, shape->vertex_count, 8);
    put_double(&w, shape->radius);
    put_vec3(&w, shape->origin);
    put_integer(&w, shape->report.points, 8);
    put_integer(&w, shape->report.duplicates, 8);
    put_integer(&w, shape->report.interior, 8);
    put_integer(&w, shape->report.coplanar, 8);
    put_integer(&w, shape->report.faces, 8);
    put_fit(&w, &shape->outer_fit, 0);
    put_fit(&w, &shape->inner_fit, shape->counts.is_lean);
    if (version > 1) {
        put_double(&w, shape->allowance.outside);
        put_double(&w, shape->allowance.inside);
    }
    if (has_axis(version)) put_vec3(&w, shape->allowance.axis);
    if (has_round(version)) {
        put_integer(&w, shape->round.kind, 8);
        put_double(&w, shape->round.radius);
        put_double(&w, shape->round.half_length);
    }
    if (has_half_axes(version)) put_vec3(&w, shape->round.half_axes);
    const double *vertices = shape_vertices(shape);
    for (size_t i = 0; i < 3 * (size_t)shape->vertex_count; i++) put_double(&w, vertices[i]);
    const uint32_t *triangles = ovoid_shape_get_polytope(shape).triangles;
    for (size_t i = 0; i < 3 * (size_t)l.triangle_count; i++) put_integer(&w, triangles[i], 4);
    put_integer(&w, compute_checksum(&l, buffer), 8);
    return l.size;
}

// The proof of the triangles needs a point inside: the centre of an inner ellipsoid that is more than a point. The hull
// of a body in closed form is known from its vertices.
static uint32_t choose_version(const ovoid_shape *s) {
    if (shape_is_ellipsoid(s)) return VERSION_ELLIPSOID;
    int is_large = s->rank == 3 && s->vertex_count >= SHAPE_TRIANGLES_LEAST && s->inner.q.xx != 0 &&
                   closed_form_find(shape_vertices(s), s->vertex_count).kind == FORM_NONE;
    if (shape_is_round(s)) return is_large ? 7 : 6;
    if (shape_has_axis(s)) return is_large ? 5 : 4;
    return is_large ? 3 : s->has_allowance ? 2 : 1;
}

size_t ovoid_shape_write(const ovoid_shape *shape, void *buffer, size_t capacity) {
    OVOID_ASSERT(shape);
    ENVIRONMENT_RETURN(size_t, shape,
                       shape_write_version(shape, choose_version(shape) + VERSION_WORDS, buffer, capacity));
}

// ---- reading ----

typedef struct reader {
    const uint8_t *bytes;
    size_t at;
    ovoid_error *error;
    const ovoid_allocator *allocator, *work; // of the shape; of working memory
} reader;

static uint64_t get_word(reader *r) {
    r->at += 8;
    return checksum_load_word(r->bytes + r->at - 8);
}

static uint32_t get_half(reader *r) {
    const uint8_t *b = r->bytes + r->at;
    r->at += 4;
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double get_double(reader *r) {
    uint64_t bits = get_word(r);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static ovoid_vec3 get_vec3(reader *r) {
    double x = get_double(r), y = get_double(r), z = get_double(r);
    return (ovoid_vec3){x, y, z};
}

static ovoid_fit get_fit(reader *r) {
    ovoid_fit f = {.ellipsoid.center = get_vec3(r)};
    ovoid_vec3 a = get_vec3(r), b = get_vec3(r), c = get_vec3(r);
    f.ellipsoid.q = (ovoid_sym3){a.x, a.y, a.z, b.x, b.y, b.z};
    f.volume = c.x;
    f.gap = c.y;
    f.beta = c.z;
    f.iterations = get_half(r);
    f.converged = get_half(r);
    f.facet = get_half(r);
    return f;
}

// The content of a file.
typedef struct content {
    layout at;
    uint32_t rank, vertex_count, is_lean;
    double radius;
    ovoid_allowance allowance;
    ovoid_round round;
    ovoid_vec3 origin;
    ovoid_report report;
    ovoid_fit outer, inner;
    double *vertices;
    uint32_t *triangles; // NULL if the file has none
} content;

static ovoid_code refuse(const reader *r, size_t place, const char *what) {
    return error_set(r->error, OVOID_ERROR_FORMAT, (int64_t)place, "byte %zu: %s", place, what);
}

// Checks by magic, version, size and checksum that it is a complete file of this format.
static ovoid_code validate_envelope(reader *r, size_t size, content *c) {
    if (size < sizeof magic || memcmp(r->bytes, magic, sizeof magic) != 0) return refuse(r, 0, "not an .ovoid file");
    if (size < HEADER_SIZE + CHECKSUM_SIZE) return refuse(r, size, "the file ends within its header");
    r->at = sizeof magic;
    uint32_t version = get_half(r);
    if (version < 1 || version > VERSION_MOST) return refuse(r, 8, "written by another version of the format");
    c->rank = get_half(r);
    if (has_triangles(get_plain(version)) && c->rank != 3)
        return refuse(r, 12, "only the file of a solid holds triangles");
    uint64_t total = get_word(r), count = get_word(r);
    if (total != size) return refuse(r, size, total > size ? "the file is truncated" : "bytes after the end");
    if (count > 0 && count <= POINTS_MAX) c->at = make_layout(version, (uint32_t)count);
    if (c->at.size != total) return refuse(r, 24, "the number of vertices does not agree with the size");
    c->vertex_count = (uint32_t)count;
    reader end = {.bytes = r->bytes, .at = size - CHECKSUM_SIZE};
    if (get_word(&end) != compute_checksum(&c->at, r->bytes))
        return refuse(r, size - CHECKSUM_SIZE, "the checksum does not agree: the file is damaged");
    return OVOID_OK;
}

static int is_length(double v) { return fabs(v) <= OVOID_LENGTH_MAX; }
static int is_vec3(ovoid_vec3 v) { return is_length(v.x) && is_length(v.y) && is_length(v.z); }

static int is_fit(const ovoid_fit *f) {
    return is_vec3(f->ellipsoid.center) && isfinite(f->ellipsoid.q.xx + f->ellipsoid.q.xy + f->ellipsoid.q.xz) &&
           isfinite(f->ellipsoid.q.yy + f->ellipsoid.q.yz + f->ellipsoid.q.zz) && f->volume >= 0 &&
           isfinite(f->volume) && f->beta >= 0 && isfinite(f->beta) && f->converged <= 1;
}

// The number behind it, which is at most `most`, is *mark.
static ovoid_code read_fit(reader *r, ovoid_fit *f, uint32_t most, uint32_t *mark) {
    size_t start = r->at;
    *f = get_fit(r);
    *mark = get_half(r);
    if (*mark > most || !is_fit(f)) return refuse(r, start, "a number of an ellipsoid is out of its range");
    return OVOID_OK;
}

static ovoid_code read_report(reader *r, content *c) {
    size_t start = r->at;
    ovoid_report *p = &c->report;
    p->points = get_word(r);
    p->duplicates = get_word(r);
    p->interior = get_word(r);
    p->coplanar = get_word(r);
    p->faces = get_word(r);
    p->vertices = c->vertex_count;
    p->rank = c->rank;
    if (p->points > POINTS_MAX || p->duplicates > p->points || p->interior > p->points ||
        p->vertices + p->duplicates + p->interior != p->points || p->coplanar > p->interior)
        return refuse(r, start, "the counts of the report do not add up");
    return OVOID_OK;
}

// Reads the axis: zero unless the allowance has an `outside`, else of length 1 as shape_options_make makes it.
static ovoid_code read_axis(reader *r, content *c) {
    size_t start = r->at;
    c->allowance.axis = get_vec3(r);
    if (allowance_is_normal(&c->allowance) && vec3_norm_squared(c->allowance.axis) > 0) return OVOID_OK;
    return refuse(r, start, "the allowance's axis is not a direction of length 1, or there is nothing outside");
}

static ovoid_code read_allowance(reader *r, content *c) {
    if (c->at.version == 1) return OVOID_OK;
    size_t start = r->at;
    c->allowance.outside = get_double(r);
    c->allowance.inside = get_double(r);
    if (!(c->allowance.outside >= 0 && is_length(c->allowance.outside) && c->allowance.inside >= 0 &&
          is_length(c->allowance.inside)) ||
        (c->at.version == 2 && c->allowance.outside + c->allowance.inside == 0))
        return refuse(r, start, "the allowance is not two lengths, one above zero");
    return has_axis(c->at.version) ? read_axis(r, c) : OVOID_OK;
}

static ovoid_code read_half_axes(reader *r, content *c) {
    size_t start = r->at;
    vec3 half = get_vec3(r);
    double least = min2(half.x, min2(half.y, half.z));
    if (!is_vec3(half) || !(least > 0)) return refuse(r, start, "a half axis is not a length above zero");
    c->round = (ovoid_round){.kind = OVOID_ROUND_ELLIPSOID, .half_axes = half};
    return OVOID_OK;
}

static ovoid_code read_round(reader *r, content *c) {
    if (has_half_axes(c->at.version)) return read_half_axes(r, c);
    if (!has_round(c->at.version)) return OVOID_OK;
    size_t start = r->at;
    uint64_t kind = get_word(r);
    double radius = get_double(r), half_length = get_double(r);
    if (!(kind == OVOID_ROUND_CYLINDER || kind == OVOID_ROUND_CONE) || !(radius > 0 && is_length(radius)) ||
        !(half_length >= 0 && is_length(half_length)) || signbit(half_length))
        return refuse(r, start, "the true body is no cylinder or cone");
    c->round = (ovoid_round){.kind = (ovoid_round_kind)kind, .radius = radius, .half_length = half_length};
    return OVOID_OK;
}

static ovoid_code read_header(reader *r, content *c) {
    c->radius = get_double(r);
    if (!(c->radius >= 0 && is_length(c->radius))) return refuse(r, 32, "the radius is not a length");
    c->origin = get_vec3(r);
    if (!is_vec3(c->origin)) return refuse(r, 40, "the origin is not a point");
    ovoid_code code = read_report(r, c);
    uint32_t nothing;
    if (!code) code = read_fit(r, &c->outer, 0, &nothing);
    if (!code) code = read_fit(r, &c->inner, 1, &c->is_lean);
    if (!code) code = read_allowance(r, c);
    return code ? code : read_round(r, c);
}

// Reads coordinates of the body frame: origin + vertex must be exactly a double, and no zero negative.
static ovoid_code read_vertices(reader *r, content *c) {
    const double origin[3] = {c->origin.x, c->origin.y, c->origin.z};
    for (size_t i = 0; i < 3 * (size_t)c->vertex_count; i++) {
        double v = c->vertices[i] = get_double(r);
        if (!is_length(v) || (v == 0 && signbit(v))) return refuse(r, r->at - 8, "a coordinate is not a length");
        dd given = two_sum(origin[i % 3], v);
        if (given.low != 0 || !is_length(given.high))
            return refuse(r, r->at - 8, "a coordinate is not of the body frame");
    }
    return OVOID_OK;
}

// Reads the triangles; the proof checks that their corners are vertices.
static void read_triangles(reader *r, content *c) {
    for (size_t i = 0; i < 3 * (size_t)c->at.triangle_count; i++) c->triangles[i] = get_half(r);
}

// Checks that the vertices of the hull are these vertices.
static ovoid_code validate_hull(const reader *r, const content *c, const hull *polytope) {
    if (polytope->vertex_count != c->vertex_count) return refuse(r, c->at.vertices_at, "a vertex is not extreme");
    if (polytope->origin.x != 0 || polytope->origin.y != 0 || polytope->origin.z != 0)
        return refuse(r, c->at.vertices_at, "the vertices are not in the body frame");
    if (polytope->rank != c->rank) return refuse(r, 12, "the rank is not that of the vertices");
    return OVOID_OK;
}

// 1 for a body far below OVOID_LENGTH_MIN: its Q underflows to zero, and queries cannot distinguish it from a point.
static int is_point_to_queries(const ovoid_polytope *p, const ovoid_ellipsoid *e) {
    const double least = OVOID_LENGTH_MIN / 16;
    int is_small = p->rank > 0 && vec3_max_abs(e->center) <= least;
    for (uint32_t v = 0; v < p->vertex_count; v++) is_small &= vec3_max_abs(vec3_at(p->vertices, v)) <= least;
    const ovoid_sym3 *q = &e->q;
    return is_small && q->xx == 0 && q->xy == 0 && q->xz == 0 && q->yy == 0 && q->yz == 0 && q->zz == 0;
}

// The centre of the inner ellipsoid is the point that proven triangles wind around, so that it need only meet none.
static int is_inner(const content *c, const hull *polytope, const ovoid_shape *shape) {
    int is_proven = c->at.triangle_count > 0 && polytope->rank == 3 && polytope->form.kind == FORM_NONE;
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    return is_proven ? ellipsoid_is_clear(&p, &c->inner.ellipsoid) : shape_is_inner(shape, &c->inner.ellipsoid);
}

static ovoid_code validate_ellipsoids(const reader *r, const content *c, const hull *polytope,
                                      const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    if (!ellipsoid_is_enclosing(&p, &c->outer.ellipsoid) && !is_point_to_queries(&p, &c->outer.ellipsoid))
        return refuse(r, OUTER_AT, "the outer ellipsoid does not enclose");
    if (!is_inner(c, polytope, shape)) return refuse(r, INNER_AT, "the inner ellipsoid is not enclosed");
    return OVOID_OK;
}

// Sets radius and allowance. A file whose allowance block_set_radius would reduce is refused, since no writer makes it.
static ovoid_code set_radius(const reader *r, const content *c, ovoid_shape *shape) {
    block_set_radius(shape, c->radius, c->allowance);
    shape->round = c->round;
    if (shape->allowance.inside != c->allowance.inside)
        return refuse(r, ALLOWANCE_AT + 8, "the allowance inside is larger than the body");
    if (c->round.kind == OVOID_ROUND_NONE || round_is_held(shape, &c->round)) return OVOID_OK;
    return refuse(r, ALLOWANCE_AT + ALLOWANCE_SIZE + (has_axis(c->at.version) ? AXIS_SIZE : 0),
                  "the polyhedron is not inscribed in its true body");
}

static ovoid_shape *make_shape(const reader *r, const content *c, hull *polytope) {
    polytope->origin = c->origin;
    const block_making how = {r->allocator, r->work, c->is_lean};
    ovoid_shape *shape = shape_create_block(polytope, &how, r->error);
    if (!shape) return NULL;
    shape->report = c->report;
    shape_set_fits(shape, &c->outer, &c->inner);
    if (!set_radius(r, c, shape) && !validate_ellipsoids(r, c, polytope, shape)) return shape;
    ovoid_shape_destroy(shape);
    return NULL;
}

// The hull of the vertices, computed from the vertices alone.
static ovoid_code find_hull(const reader *r, const content *c, hull *polytope) {
    ovoid_code code = hull_create((xyz_points){c->vertices, c->vertex_count}, r->work, polytope, r->error);
    if (code == OVOID_OK || code == OVOID_ERROR_MEMORY) return code;
    return refuse(r, c->at.vertices_at, "the vertices have no hull");
}

// The hull of the vertices, proven from vertices and triangles.
static ovoid_code prove_hull(const reader *r, const content *c, hull *polytope) {
    surface_claim claim = {c->vertices, c->vertex_count, c->triangles, c->at.triangle_count, c->inner.ellipsoid.center};
    surface_flaw flaw;
    ovoid_code code = hull_create_proven(&claim, r->work, polytope, &flaw);
    if (code == OVOID_OK) return code;
    if (code == OVOID_ERROR_MEMORY)
        return error_set(r->error, code, -1, "no memory for a hull of %u vertices", c->vertex_count);
    size_t each = flaw.is_vertex ? 24 : 12, start = flaw.is_vertex ? c->at.vertices_at : c->at.triangles_at;
    return refuse(r, start + each * flaw.index, flaw.what);
}

static ovoid_shape *read_shape(reader *r, content *c) {
    if (read_header(r, c) || read_vertices(r, c)) return NULL;
    read_triangles(r, c);
    hull polytope;
    if (c->at.triangle_count ? prove_hull(r, c, &polytope) : find_hull(r, c, &polytope)) return NULL;
    ovoid_shape *shape = validate_hull(r, c, &polytope) ? NULL : make_shape(r, c, &polytope);
    hull_destroy(&polytope, r->work);
    return shape;
}

static ovoid_shape *read_bytes(const void *bytes, size_t size, const ovoid_allocator *given, ovoid_error *error) {
    if (!bytes) {
        error_write(error, size ? OVOID_ERROR_ARGUMENT : OVOID_ERROR_FORMAT, size ? -1 : 0, "there are no bytes");
        return NULL;
    }
    _Alignas(64) char buffer[SHAPE_WORK_SIZE];
    ovoid_allocator allocator = allocator_make(given);
    arena a;
    ovoid_allocator work = arena_make(&a, &allocator, buffer, sizeof buffer);
    reader r = {bytes, 0, error, &allocator, &work};
    content c = {0};
    if (validate_envelope(&r, size, &c)) return NULL;
    // Vertices, then triangles.
    c.vertices = allocator_allocate(&work, c.at.size, 1);
    if (!c.vertices) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for %u vertices", c.vertex_count);
        return NULL;
    }
    if (c.at.triangle_count) c.triangles = (uint32_t *)(c.vertices + 3 * (size_t)c.vertex_count);
    ovoid_shape *shape = read_shape(&r, &c);
    allocator_release(&work, c.vertices);
    return shape;
}

ovoid_shape *ovoid_shape_read(const void *bytes, size_t size, const ovoid_shape_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, bytes, read_bytes(bytes, size, options ? options->allocator : NULL, error));
}
