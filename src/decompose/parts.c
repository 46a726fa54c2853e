// Convex parts of a solid: the piece of the largest excess is cut, until no excess is larger than asked or there are
// enough pieces; then pieces whose common hull has a small excess are joined, the cheapest first.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "base/watch.h"
#include "decompose/piece.h"

#include <string.h>

enum { PIECES_MOST = 2048 };

struct ovoid_parts {
    ovoid_allocator memory;
    size_t count;
    ovoid_shape **shapes;
};

void ovoid_parts_destroy(ovoid_parts *parts) {
    if (!parts) return;
    for (size_t i = 0; i < parts->count; i++) ovoid_shape_destroy(parts->shapes[i]);
    ovoid_allocator memory = parts->memory;
    allocator_release(&memory, parts->shapes);
    allocator_release(&memory, parts);
}

size_t ovoid_parts_get_count(const ovoid_parts *parts) { return parts->count; }
const ovoid_shape *const *ovoid_parts_get_shapes(const ovoid_parts *parts) {
    return (const ovoid_shape *const *)parts->shapes;
}

// Room for count parts, all of them NULL.
static ovoid_parts *create_parts(const ovoid_allocator *memory, size_t count, ovoid_error *error) {
    ovoid_parts *parts = allocator_allocate(memory, 1, sizeof *parts);
    ovoid_shape **shapes = allocator_allocate(memory, count, sizeof *shapes);
    if (!parts || !shapes) {
        allocator_release(memory, parts);
        allocator_release(memory, shapes);
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu parts", count);
        return NULL;
    }
    memset(shapes, 0, count * sizeof *shapes);
    *parts = (ovoid_parts){*memory, count, shapes};
    return parts;
}

// ---- cutting and joining

typedef struct parts_work {
    const body *b;
    const ovoid_decomposition_options *o;
    piece *pieces;
    size_t count, room;
    double error; ///< in the body's unit; 0: as many parts as asked for
    size_t wanted;
    double enough; ///< the most excess that a joined piece may have
    double *costs; ///< of joining pieces i > k, at i (i - 1) / 2 + k
    size_t steps;
} parts_work;

static void report(parts_work *m, size_t done, size_t total) {
    if (m->o->progress) m->o->progress(m->o->progress_context, done < total ? done : total, total);
}

static void destroy_pieces(parts_work *m) {
    for (size_t i = 0; i < m->count; i++) piece_destroy(m->b, &m->pieces[i]);
    allocator_release(&m->b->memory, m->pieces);
    allocator_release(&m->b->memory, m->costs);
}

static size_t find_worst(const parts_work *m) {
    size_t worst = m->room;
    for (size_t i = 0; i < m->count; i++)
        if (!m->pieces[i].is_finished && (worst == m->room || m->pieces[i].excess > m->pieces[worst].excess)) worst = i;
    return worst;
}

static ovoid_code cut_pieces(parts_work *m, ovoid_error *error) {
    while (m->count < m->room && !watch_is_stopped(&m->o->watch)) {
        size_t worst = find_worst(m);
        if (worst == m->room || m->pieces[worst].excess <= m->error) return OVOID_OK;
        piece *p = &m->pieces[worst], sides[2];
        ovoid_plane plane;
        int is_found, is_cut = 0;
        ovoid_code code = piece_choose_plane(m->b, p, &plane, &is_found, error);
        if (code == OVOID_OK && is_found) code = piece_divide(m->b, p, &plane, sides, &is_cut, error);
        if (code != OVOID_OK) return code;
        p->is_finished = !is_cut;
        if (!is_cut) continue;
        piece_destroy(m->b, p);
        m->pieces[worst] = sides[0];
        m->pieces[m->count++] = sides[1];
        report(m, m->count, m->room);
    }
    return OVOID_OK;
}

// ---- joining

static double *get_cost(parts_work *m, size_t i, size_t k) {
    return i > k ? &m->costs[i * (i - 1) / 2 + k] : &m->costs[k * (k - 1) / 2 + i];
}

// Whether some points between the two are farther from the solid than `enough`.
static int is_far_apart(const body *b, const piece *p, const piece *q, double enough) {
    uint32_t hint = 0;
    for (uint32_t i = 0; i < 24; i++) {
        vec3 x = p->points[i * 7919u % p->point_count], y = q->points[i * 104729u % q->point_count];
        vec3 at = vec3_add_scaled(x, vec3_sub(y, x), (i % 3 + 1) / 4.0);
        double distance;
        hint = body_find_triangle(b, at, hint, &distance);
        if (distance > enough && body_find_inside(b, at) == 0) return 1;
    }
    return 0;
}

// The points of both pieces; NULL where there is no memory.
static vec3 *join_points(const body *b, const piece *p, const piece *q, ovoid_error *error) {
    vec3 *points = allocator_allocate(&b->memory, (size_t)p->point_count + q->point_count, sizeof *points);
    if (!points) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for the points of two parts");
        return NULL;
    }
    memcpy(points, p->points, p->point_count * sizeof *points);
    memcpy(points + p->point_count, q->points, q->point_count * sizeof *points);
    return points;
}

static ovoid_code find_cost(parts_work *m, size_t i, size_t k, ovoid_error *error) {
    double *cost = get_cost(m, i, k);
    const piece *p = &m->pieces[i], *q = &m->pieces[k];
    *cost = INFINITY;
    if (watch_is_stopped(&m->o->watch) || is_far_apart(m->b, p, q, m->enough)) return OVOID_OK;
    vec3 *points = join_points(m->b, p, q, error);
    if (!points) return OVOID_ERROR_MEMORY;
    const estimated_points both = {points, p->point_count + q->point_count, m->enough};
    ovoid_code code = points_estimate(m->b, &both, cost, error);
    allocator_release(&m->b->memory, points);
    return code;
}

static ovoid_code find_costs(parts_work *m, ovoid_error *error) {
    for (size_t i = 1; i < m->count; i++) {
        for (size_t k = 0; k < i; k++) {
            ovoid_code code = find_cost(m, i, k, error);
            if (code != OVOID_OK) return code;
        }
        report(m, i * i, m->count * m->count);
    }
    return OVOID_OK;
}

static int find_cheapest(parts_work *m, size_t *first, size_t *second) {
    double least = INFINITY;
    for (size_t i = 1; i < m->count; i++)
        for (size_t k = 0; k < i; k++)
            if (*get_cost(m, i, k) <= m->enough && *get_cost(m, i, k) < least)
                least = *get_cost(m, i, k), *first = k, *second = i;
    return least < INFINITY;
}

// Joins the second piece to the first; the last piece takes the second's place.
static ovoid_code join(parts_work *m, size_t first, size_t second, ovoid_error *error) {
    piece *p = &m->pieces[first], *q = &m->pieces[second];
    vec3 *points = join_points(m->b, p, q, error);
    if (!points) return OVOID_ERROR_MEMORY;
    allocator_release(&m->b->memory, p->points);
    p->points = points;
    p->point_count += q->point_count;
    p->excess = *get_cost(m, second, first);
    piece_destroy(m->b, q);
    size_t last = --m->count;
    if (second != last) {
        m->pieces[second] = m->pieces[last];
        for (size_t k = 0; k < last; k++)
            if (k != second) *get_cost(m, second, k) = *get_cost(m, last, k);
    }
    ovoid_code code = OVOID_OK;
    for (size_t k = 0; k < m->count && code == OVOID_OK; k++)
        if (k != first) code = find_cost(m, first, k, error);
    return code;
}

static ovoid_code join_pieces(parts_work *m, ovoid_error *error) {
    if (m->count < 2) return OVOID_OK;
    m->costs = allocator_allocate(&m->b->memory, m->count * (m->count - 1) / 2, sizeof *m->costs);
    if (!m->costs) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu pieces", m->count);
    // If a number of parts is wanted, the allowed excess grows until there are so few; otherwise it is the given error.
    m->enough = m->wanted ? max2(m->error, 2 * m->pieces[find_worst(m) % m->room].excess) : m->error;
    for (;;) {
        ovoid_code code = find_costs(m, error);
        size_t first = 0, second = 0;
        while (code == OVOID_OK && (!m->wanted || m->count > m->wanted) && find_cheapest(m, &first, &second))
            code = join(m, first, second, error);
        if (code != OVOID_OK || !m->wanted || m->count <= m->wanted || watch_is_stopped(&m->o->watch)) return code;
        m->enough = max2(2 * m->enough, 1e-3 * m->b->diagonal);
    }
}

// ---- decomposition

static ovoid_parts *make_shapes(parts_work *m, ovoid_error *error) {
    ovoid_parts *parts = create_parts(&m->b->memory, m->count, error);
    for (size_t i = 0; parts && i < m->count; i++) {
        piece *p = &m->pieces[i];
        for (uint32_t k = 0; k < p->point_count; k++) p->points[k] = vec3_scale(p->points[k], m->b->unit);
        parts->shapes[i] = ovoid_shape_create_from_points(&p->points[0].x, p->point_count,
                                                          &(ovoid_shape_options){.allocator = &m->b->memory}, error);
        if (parts->shapes[i]) continue;
        ovoid_parts_destroy(parts);
        return NULL;
    }
    return parts;
}

static void set_aims(parts_work *m) {
    m->error = m->o->error * m->b->inverse;
    m->wanted = m->o->parts;
    if (!m->wanted && !(m->error > 0)) m->error = 0.02 * m->b->diagonal;
    // If a number of parts is wanted, more pieces are made and joined again.
    m->room = m->wanted ? 2 * m->wanted : PIECES_MOST;
    if (m->room > OVOID_DECOMPOSITION_PARTS_MAX) m->room = OVOID_DECOMPOSITION_PARTS_MAX;
    if (m->wanted) m->error = max2(m->error, 1e-6 * m->b->diagonal);
}

static ovoid_parts *create_from_solid(const ovoid_solid *solid, const ovoid_decomposition_options *given,
                                      ovoid_error *error) {
    ovoid_decomposition_options options;
    body b;
    if (body_validate_options(given, &options, error) != OVOID_OK) return NULL;
    if (body_open(&b, solid, &options, error) != OVOID_OK) return NULL;
    parts_work m = {.b = &b, .o = &options};
    set_aims(&m);
    m.pieces = allocator_allocate(&b.memory, m.room, sizeof *m.pieces);
    ovoid_parts *parts = NULL;
    if (!m.pieces)
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu pieces", m.room);
    else if (piece_create(&b, &m.pieces[0], error) == OVOID_OK) {
        m.count = 1;
        if (cut_pieces(&m, error) == OVOID_OK && join_pieces(&m, error) == OVOID_OK) parts = make_shapes(&m, error);
    }
    destroy_pieces(&m);
    body_close(&b);
    return parts;
}

ovoid_parts *ovoid_parts_create_from_solid(const ovoid_solid *solid, const ovoid_decomposition_options *options,
                                           ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_parts *, solid, create_from_solid(solid, options, error));
}

// ---- enlarged parts

// The rhombic triacontahedron that contains the unit ball: its corners are those of an icosahedron and of a
// dodecahedron, the farthest 1.176 from the middle.
enum { AROUND = 32 };
static void set_corners_around(vec3 corners[AROUND]) {
    const double g = 1.618033988749895, scale = 1 / g;
    int count = 0;
    for (int i = 0; i < 8; i++) {
        double x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1, z = i & 4 ? 1 : -1;
        corners[count++] = (vec3){x, y, z};
        if (i & 1) continue;
        corners[count++] = (vec3){0, y, z * g};
        corners[count++] = (vec3){y, z * g, 0};
        corners[count++] = (vec3){z * g, 0, y};
        corners[count++] = (vec3){0, y * g, z / g};
        corners[count++] = (vec3){y * g, z / g, 0};
        corners[count++] = (vec3){z / g, 0, y * g};
    }
    for (int i = 0; i < AROUND; i++) corners[i] = vec3_scale(corners[i], scale);
}

// The hull of the part's vertices moved by all corners is the sum of both bodies. The radius is increased first, by
// the rounding of sums and corners.
static ovoid_shape *enlarge(const ovoid_shape *shape, double radius, const ovoid_allocator *memory,
                            ovoid_error *error) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    vec3 around[AROUND];
    set_corners_around(around);
    double *xyz = allocator_allocate(memory, (size_t)AROUND * p.vertex_count, 3 * sizeof *xyz);
    if (!xyz) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a part of %u vertices", p.vertex_count);
        return NULL;
    }
    double extent = 0;
    for (uint32_t i = 0; i < p.vertex_count; i++)
        extent = max2(extent, vec3_max_abs(vec3_add(p.origin, vec3_at(p.vertices, i))));
    double grown = radius * (1 + 16 * ROUNDING) + 8 * ROUNDING * (extent + radius);
    for (uint32_t i = 0; i < p.vertex_count; i++)
        for (int k = 0; k < AROUND; k++) {
            vec3 x = vec3_add_scaled(vec3_add(p.origin, vec3_at(p.vertices, i)), around[k], grown);
            memcpy(xyz + 3 * ((size_t)AROUND * i + (size_t)k), &x, sizeof x);
        }
    ovoid_shape_options options = {.radius = ovoid_shape_get_radius(shape), .allocator = memory};
    ovoid_shape *made = ovoid_shape_create_from_points(xyz, (size_t)AROUND * p.vertex_count, &options, error);
    allocator_release(memory, xyz);
    return made;
}

static ovoid_parts *create_enlarged(const ovoid_decomposition *d, double radius,
                                    const ovoid_decomposition_options *given, ovoid_error *error) {
    ovoid_allocator memory = allocator_make(given ? given->allocator : NULL);
    if (body_validate_parts(d, error) != OVOID_OK) return NULL;
    if (!(radius >= 0 && radius <= OVOID_LENGTH_MAX)) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "the radius %g is no length: give one of at least 0", radius);
        return NULL;
    }
    ovoid_parts *parts = create_parts(&memory, d->part_count, error);
    for (size_t i = 0; parts && i < d->part_count; i++) {
        parts->shapes[i] = enlarge(d->parts[i], radius, &memory, error);
        if (parts->shapes[i]) continue;
        ovoid_parts_destroy(parts);
        return NULL;
    }
    return parts;
}

ovoid_parts *ovoid_parts_create_enlarged(const ovoid_decomposition *decomposition, double radius,
                                         const ovoid_decomposition_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_parts *, radius, create_enlarged(decomposition, radius, options, error));
}
