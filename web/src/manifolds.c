// Contacts of pairs: found, moved on from earlier ones, verified, with their points and areas.
#include "src/exchange.h"

#include <stdlib.h>

/// Where the parts stand behind the largest manifold: 29 numbers, three, four points of eight.
enum { HEAD_PARTS = 64 };

/// 29 numbers: the fields of ovoid_manifold in their order, the memory included.
static double *write_manifold(double *to, const ovoid_manifold *m) {
    *to++ = m->status, *to++ = m->limit, *to++ = m->lower, *to++ = m->upper;
    to = write_vec3(to, m->normal);
    for (int i = 0; i < 4; i++) *to++ = m->id[i];
    *to++ = m->feature_a, *to++ = m->feature_b, *to++ = m->facet_a, *to++ = m->facet_b;
    *to++ = m->axis, *to++ = m->count, *to++ = m->proof, *to++ = m->corners, *to++ = (double)m->share;
    *to++ = (double)m->memory.searched;
    for (int i = 0; i < 7; i++) *to++ = (double)m->memory.pose[i];
    *to++ = m->memory.flags;
    return to;
}

static const double *read_manifold(const double *from, ovoid_manifold *m) {
    *m = (ovoid_manifold){.status = (ovoid_status)(read_index(from[0]) & 0xff),
                          .limit = (ovoid_limit)(read_index(from[1]) & 0xff),
                          .lower = from[2],
                          .upper = from[3]};
    from = read_vec3(from + 4, &m->normal);
    for (int i = 0; i < 4; i++) m->id[i] = read_index(*from++);
    m->feature_a = read_index(*from++), m->feature_b = read_index(*from++);
    m->facet_a = read_index(*from++), m->facet_b = read_index(*from++);
    m->axis = (ovoid_manifold_axis)(read_index(*from++) & 0xff);
    m->count = (uint8_t)(read_index(*from++) & 0xff), m->proof = (uint8_t)(read_index(*from++) & 0xff);
    m->corners = (uint16_t)(read_index(*from++) & 0xffff), m->share = (float)*from++;
    m->memory.searched = (float)*from++;
    for (int i = 0; i < 7; i++) m->memory.pose[i] = (float)*from++;
    m->memory.flags = read_index(*from++);
    return from;
}

static double *write_point(double *to, const ovoid_manifold_point *p) {
    to = write_vec3(write_vec3(to, p->point_a), p->point_b);
    *to++ = p->separation, *to++ = p->id;
    return to;
}

static const double *read_manifold_options(const double *from, ovoid_manifold_options *o) {
    *o = (ovoid_manifold_options){.margin = from[0], .tolerance = from[1], .keep = from[2], .angle = from[3]};
    return from + 4;
}

/// The manifold, what its points are grown by, the two areas, and the points themselves.
static void write_points(const ovoid_manifold *m, const ovoid_manifold_points *points, const double areas[2]) {
    double *to = write_manifold(exchange, m);
    *to++ = points->grown, *to++ = areas[0], *to++ = areas[1];
    for (uint32_t i = 0; i < points->count; i++) to = write_point(to, &points->points[i]);
}

static void write_all(const ovoid_pair *pair, const ovoid_manifold *m, const ovoid_manifold_options *options) {
    static ovoid_manifold_polygon polygon;
    polygon = (ovoid_manifold_polygon){.count = 0};
    const ovoid_manifold_points points = ovoid_manifold_compute_points(pair, m);
    if (m->count) (void)ovoid_manifold_compute_polygon(pair, m, options, &polygon);
    write_points(m, &points, (const double[]){polygon.inner, polygon.outer});
}

/// The manifold of two shapes. Reads both poses, the four options and, where is_warm, an earlier manifold, whose cover
/// stands where covers do; the cover is replaced by that of a new search.
void EXPORT(manifold_find)(const ovoid_shape *a, const ovoid_shape *b, int is_warm) {
    ovoid_pair pair = {.shape_a = a, .shape_b = b};
    ovoid_manifold_options options;
    ovoid_manifold earlier;
    const double *from = read_manifold_options(read_pose(read_pose(exchange, &pair.pose_a), &pair.pose_b), &options);
    if (is_warm) read_manifold(from, &earlier);
    options.cover = &cover;
    const ovoid_manifold found = ovoid_manifold_find(&pair, &options, is_warm ? &earlier : NULL);
    write_all(&pair, &found, &options);
}

// ---- part by part

static ovoid_body_manifold *found_items;
static size_t found_capacity;

static ovoid_posed_shape get_part(const ovoid_body *body, uint32_t part) {
    if (!body->compound) return (ovoid_posed_shape){body->shape, body->pose};
    ovoid_posed_shape found = ovoid_compound_get_part(body->compound, part);
    found.pose = ovoid_pose_compute_product(&body->pose, &found.pose);
    return found;
}

static const double *read_input(unsigned kinds, const void *a, const void *b, ovoid_body_pair *pair) {
    return read_body(read_body(exchange, kinds & 3, a, &pair->a), kinds >> 2 & 3, b, &pair->b);
}

/// Finds the manifolds of two bodies, which manifold_get gives. Reads both poses and the four options; writes the
/// limit. Their number; -1: memory is out.
int EXPORT(manifolds_find)(unsigned kinds, const void *a, const void *b) {
    ovoid_body_pair pair;
    ovoid_manifold_options options;
    read_manifold_options(read_input(kinds, a, b, &pair), &options);
    for (;;) {
        ovoid_body_manifolds room = {.items = found_items, .capacity = found_capacity};
        exchange[0] = ovoid_body_manifolds_find(&pair, &options, &room);
        if (room.count <= found_capacity) return (int)room.count;
        ovoid_body_manifold *larger = realloc(found_items, room.count * sizeof *larger);
        if (!larger) return -1;
        found_items = larger;
        found_capacity = room.count;
    }
}

/// Manifold i of those found last, of the same bodies, poses and options, which it reads too. Writes the parts, then
/// what manifold_find writes; one that a search proves is found again by itself, with its cover and the same bits.
void EXPORT(manifold_get)(unsigned kinds, const void *a, const void *b, size_t i) {
    ovoid_body_pair bodies;
    ovoid_manifold_options options;
    read_manifold_options(read_input(kinds, a, b, &bodies), &options);
    ovoid_body_manifold *m = &found_items[i];
    cover.point_count = cover.triangle_count = 0;
    if (bodies.a.solid || bodies.b.solid) {
        const ovoid_manifold_points points = ovoid_body_manifold_compute_points(&bodies, m);
        write_points(&m->manifold, &points, (const double[]){0, 0});
        exchange[HEAD_PARTS] = m->part_a, exchange[HEAD_PARTS + 1] = m->part_b;
        return;
    }
    const ovoid_posed_shape part_a = get_part(&bodies.a, m->part_a), part_b = get_part(&bodies.b, m->part_b);
    const ovoid_pair pair = {part_a.shape, part_b.shape, part_a.pose, part_b.pose};
    options.cover = &cover;
    if (m->manifold.proof == OVOID_MANIFOLD_PROOF_SEARCH) m->manifold = ovoid_manifold_find(&pair, &options, NULL);
    write_all(&pair, &m->manifold, &options);
    exchange[HEAD_PARTS] = m->part_a, exchange[HEAD_PARTS + 1] = m->part_b;
}

/// Reads both poses, the four options, the parts and the manifold, and its cover where it stands. 0, or the error's
/// code.
int EXPORT(manifold_verify)(unsigned kinds, const void *a, const void *b) {
    ovoid_body_pair pair;
    ovoid_manifold_options options;
    ovoid_body_manifold m;
    const double *from = read_manifold_options(read_input(kinds, a, b, &pair), &options);
    m.part_a = read_index(from[0]), m.part_b = read_index(from[1]);
    read_manifold(from + 2, &m.manifold);
    options.cover = cover.point_count ? &cover : NULL;
    return (int)ovoid_body_manifold_verify(&pair, &m, &options, &exchange_error);
}

/// The whole polygon: reads what manifold_verify reads. Writes the number of its corners, grown, both areas, the
/// corners. 0, or the error's code.
int EXPORT(manifold_polygon)(unsigned kinds, const void *a, const void *b) {
    static ovoid_manifold_polygon polygon;
    ovoid_body_pair bodies;
    ovoid_manifold_options options;
    ovoid_manifold m;
    const double *from = read_manifold_options(read_input(kinds, a, b, &bodies), &options);
    const size_t part_a = read_index(from[0]), part_b = read_index(from[1]);
    read_manifold(from + 2, &m);
    if (bodies.a.solid || bodies.b.solid)
        return exchange_error = (ovoid_error){OVOID_ERROR_ARGUMENT, -1, "a facet of a solid has no polygon"},
               OVOID_ERROR_ARGUMENT;
    if ((bodies.a.compound ? part_a >= ovoid_compound_get_part_count(bodies.a.compound) : part_a > 0) ||
        (bodies.b.compound ? part_b >= ovoid_compound_get_part_count(bodies.b.compound) : part_b > 0))
        return exchange_error = (ovoid_error){OVOID_ERROR_INDEX, -1, "the bodies have no such parts"},
               OVOID_ERROR_INDEX;
    const ovoid_posed_shape p = get_part(&bodies.a, (uint32_t)part_a), q = get_part(&bodies.b, (uint32_t)part_b);
    const ovoid_pair pair = {p.shape, q.shape, p.pose, q.pose};
    if (ovoid_manifold_compute_polygon(&pair, &m, &options, &polygon) != OVOID_OK)
        return exchange_error = (ovoid_error){OVOID_ERROR_ARGUMENT, -1, "the manifold is not one of these bodies"},
               OVOID_ERROR_ARGUMENT;
    double *to = exchange;
    *to++ = polygon.count, *to++ = polygon.grown, *to++ = polygon.inner, *to++ = polygon.outer;
    for (uint32_t i = 0; i < polygon.count; i++) to = write_point(to, &polygon.points[i]);
    return 0;
}

// ---- words

const char *EXPORT(get_axis_name)(int i) { return ovoid_manifold_axis_get_name((ovoid_manifold_axis)i); }
const char *EXPORT(get_manifold_proof_name)(int i) { return ovoid_manifold_proof_get_name((ovoid_manifold_proof)i); }
