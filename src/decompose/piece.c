// Pieces of a solid, clipped by planes (I. E. Sutherland, G. W. Hodgman, Reentrant polygon clipping, 1974).
#include "decompose/piece.h"

#include "base/allocator.h"
#include "base/error.h"

#include <string.h>

/// Corners nearer to a plane than this, relative to the solid's diagonal, are on it. A triangle in a cutting plane
/// belongs to the side where the solid is.
#define ON_PLANE 1e-9
/// The distance from a plane at which the solid is tested beside it.
#define BESIDE 1e-7

static ovoid_code report_memory(ovoid_error *error) {
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a piece of the solid");
}

static int soup_reserve(const body *b, soup *s, size_t more) {
    if (s->count + more <= s->room) return 1;
    size_t room = 2 * s->room + more;
    vec3 *corners = allocator_allocate(&b->memory, room, sizeof *corners);
    if (!corners) return 0;
    if (s->count) memcpy(corners, s->corners, s->count * sizeof *corners);
    allocator_release(&b->memory, s->corners);
    s->corners = corners;
    s->room = room;
    return 1;
}

// Adds the part of a triangle on one side: d are the corners' heights above the plane, as seen from that side.
static int clip(const body *b, const vec3 t[3], const double d[3], soup *s) {
    double margin = ON_PLANE * b->diagonal;
    if (!(max2(d[0], max2(d[1], d[2])) > margin)) return 1;
    vec3 polygon[6];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        if (d[i] >= -margin) polygon[count++] = t[i];
        if ((d[i] > margin && d[j] < -margin) || (d[i] < -margin && d[j] > margin))
            polygon[count++] = vec3_add_scaled(t[i], vec3_sub(t[j], t[i]), d[i] / (d[i] - d[j]));
    }
    if (!soup_reserve(b, s, 6)) return 0;
    for (int i = 1; i + 1 < count; i++) {
        s->corners[s->count++] = polygon[0];
        s->corners[s->count++] = polygon[i];
        s->corners[s->count++] = polygon[i + 1];
    }
    return 1;
}

static int add_triangle(const body *b, const vec3 t[3], soup *s) {
    if (!soup_reserve(b, s, 3)) return 0;
    memcpy(s->corners + s->count, t, 3 * sizeof *t);
    s->count += 3;
    return 1;
}

// A triangle in the plane belongs to the side where the solid is; if the solid is on neither side, as for a sheet, to
// the side below.
static int add_in_plane(const body *b, const vec3 t[3], const ovoid_plane *plane, soup sides[2]) {
    vec3 middle = vec3_scale(vec3_add(vec3_add(t[0], t[1]), t[2]), 1.0 / 3);
    vec3 step = vec3_scale(plane->normal, BESIDE * b->diagonal);
    int is_above = body_find_inside(b, vec3_add(middle, step)) != 0;
    int is_below = body_find_inside(b, vec3_sub(middle, step)) != 0 || !is_above;
    return (!is_below || add_triangle(b, t, &sides[0])) && (!is_above || add_triangle(b, t, &sides[1]));
}

static int divide_soup(const body *b, const soup *whole, const ovoid_plane *plane, soup sides[2]) {
    double margin = ON_PLANE * b->diagonal;
    for (size_t i = 0; i < whole->count; i += 3) {
        const vec3 *t = whole->corners + i;
        double below[3], above[3];
        for (int k = 0; k < 3; k++) {
            above[k] = vec3_dot(plane->normal, t[k]) - plane->offset;
            below[k] = -above[k];
        }
        int is_in_plane = max2(max2(fabs(above[0]), fabs(above[1])), fabs(above[2])) <= margin;
        if (is_in_plane && !add_in_plane(b, t, plane, sides)) return 0;
        if (!clip(b, t, below, &sides[0])) return 0;
        if (!clip(b, t, above, &sides[1])) return 0;
    }
    return 1;
}

vec3 piece_get_frame_point(const body *b, const ovoid_polytope *frame, uint32_t i) {
    return vec3_scale(vec3_add(frame->origin, vec3_at(frame->vertices, i)), b->inverse);
}

vec3 piece_get_frame_middle(const body *b, const ovoid_polytope *frame) {
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < frame->vertex_count; i++) sum = vec3_add(sum, piece_get_frame_point(b, frame, i));
    return vec3_scale(sum, 1.0 / frame->vertex_count);
}

int piece_is_inside(const body *b, vec3 corner, vec3 middle) {
    return body_find_inside(b, vec3_add_scaled(corner, vec3_sub(middle, corner), BESIDE)) == 1;
}

// Finds the corners of the hull of the triangles and of the cell's corners inside.
static ovoid_code find_points(const body *b, piece *p, ovoid_error *error) {
    ovoid_polytope frame = ovoid_shape_get_polytope(p->frame);
    vec3 middle = piece_get_frame_middle(b, &frame);
    if (!soup_reserve(b, &p->triangles, frame.vertex_count)) return report_memory(error);
    size_t count = p->triangles.count;
    for (uint32_t i = 0; i < frame.vertex_count; i++) {
        vec3 corner = piece_get_frame_point(b, &frame, i);
        if (piece_is_inside(b, corner, middle)) p->triangles.corners[count++] = corner;
    }
    hull polytope;
    ovoid_code code = hull_create((xyz_points){&p->triangles.corners[0].x, count}, &b->memory, &polytope, error);
    if (code != OVOID_OK) return code;
    p->points = allocator_allocate(&b->memory, polytope.vertex_count, sizeof *p->points);
    p->point_count = polytope.vertex_count;
    for (uint32_t i = 0; p->points && i < polytope.vertex_count; i++)
        p->points[i] = vec3_add(polytope.origin, vec3_at(polytope.vertices, i));
    hull_destroy(&polytope, &b->memory);
    return p->points ? OVOID_OK : report_memory(error);
}

static ovoid_code finish(const body *b, piece *p, ovoid_error *error) {
    ovoid_code code = find_points(b, p, error);
    return code == OVOID_OK ? piece_estimate(b, p, error) : code;
}

// A box slightly larger than the solid's.
static ovoid_shape *create_frame(const body *b, ovoid_error *error) {
    const ovoid_box *around = &b->solid->report.box;
    double margin = 0.01 * b->diagonal * b->unit, xyz[24];
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = i & 1 ? around->max.x + margin : around->min.x - margin;
        xyz[3 * i + 1] = i & 2 ? around->max.y + margin : around->min.y - margin;
        xyz[3 * i + 2] = i & 4 ? around->max.z + margin : around->min.z - margin;
    }
    return ovoid_shape_create_from_points(xyz, 8, &(ovoid_shape_options){.allocator = &b->memory}, error);
}

ovoid_code piece_create(const body *b, piece *p, ovoid_error *error) {
    const ovoid_solid *s = b->solid;
    *p = (piece){.frame = create_frame(b, error)};
    if (!p->frame) return OVOID_ERROR_MEMORY;
    if (!soup_reserve(b, &p->triangles, 3 * (size_t)s->triangle_count)) {
        piece_destroy(b, p);
        return report_memory(error);
    }
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        body_get_triangle(b, i, p->triangles.corners + p->triangles.count);
        p->triangles.count += 3;
    }
    ovoid_code code = finish(b, p, error);
    if (code != OVOID_OK) piece_destroy(b, p);
    return code;
}

ovoid_code piece_divide(const body *b, const piece *p, const ovoid_plane *plane, piece sides[2], int *is_cut,
                        ovoid_error *error) {
    for (int i = 0; i < 2; i++) sides[i] = (piece){0};
    *is_cut = 0;
    soup two[2] = {{0}, {0}};
    int is_room = divide_soup(b, &p->triangles, plane, two);
    for (int i = 0; i < 2; i++) sides[i].triangles = two[i];
    ovoid_code code = is_room ? OVOID_OK : report_memory(error);
    if (code == OVOID_OK && two[0].count && two[1].count) {
        ovoid_plane in_unit = {plane->normal, plane->offset * b->unit};
        const ovoid_shape_options options = {.allocator = &b->memory};
        ovoid_shape_halves frames = ovoid_shape_create_divided(p->frame, &in_unit, &options, error);
        sides[0].frame = frames.below;
        sides[1].frame = frames.above;
        *is_cut = frames.below && frames.above;
        code = frames.code;
    }
    for (int i = 0; i < 2 && *is_cut && code == OVOID_OK; i++) code = finish(b, &sides[i], error);
    if (code == OVOID_OK && *is_cut) return OVOID_OK;
    *is_cut = 0;
    for (int i = 0; i < 2; i++) piece_destroy(b, &sides[i]);
    return code;
}

void piece_destroy(const body *b, piece *p) {
    ovoid_shape_destroy(p->frame);
    allocator_release(&b->memory, p->triangles.corners);
    allocator_release(&b->memory, p->points);
    *p = (piece){0};
}
