// What of a body is clipped, seen along the normal. A facet of many corners is used with as many of them as fit: their
// hull is in the facet, so what is found in it is true of the body.
#include "manifold/manifold.h"

// The corners of a feature of a shape.
typedef struct corner_list {
    uint32_t count;
    const uint32_t *vertices, *edges;
    uint32_t own_vertices[2], own_edges[2];
} corner_list;

static void list_corners(const ovoid_shape *s, uint32_t feature, corner_list *list) {
    uint32_t index = feature_get_index(feature);
    list->vertices = list->own_vertices;
    list->edges = list->own_edges;
    list->count = 1;
    list->own_vertices[0] = index;
    list->own_edges[0] = list->own_edges[1] = index;
    if (feature_get_kind(feature) == OVOID_MANIFOLD_EDGE) {
        edge_ends e = shape_get_ends(s, index);
        list->own_vertices[0] = e.from;
        list->own_vertices[1] = e.to;
        list->count = 2;
    } else if (feature_get_kind(feature) == OVOID_MANIFOLD_FACET) {
        uint32_t start = shape_loop_starts(s)[index];
        list->vertices = shape_loop_vertices(s) + start;
        list->edges = shape_loop_edges(s) + start;
        list->count = shape_loop_starts(s)[index + 1] - start;
    }
}

// The corners of a list in a patch, in their order or against it. Seen from outside of B its facets turn the other way.
static void take_corners(const corner_list *list, int is_reversed, manifold_patch *p) {
    p->count = list->count < PATCH_CORNERS ? list->count : PATCH_CORNERS;
    for (uint32_t i = 0; i < p->count; i++) {
        uint32_t at = list->count <= PATCH_CORNERS ? i : (uint32_t)((uint64_t)i * list->count / p->count);
        uint32_t corner = is_reversed ? list->count - 1 - at : at;
        uint32_t edge = is_reversed ? (corner + list->count - 1) % list->count : corner;
        p->vertices[i] = list->vertices[corner];
        p->edges[i] = list->edges[edge];
    }
}

// The plane through a segment that is level across it.
static void set_line_slope(manifold_patch *p) {
    double dx = p->x[1] - p->x[0], dy = p->y[1] - p->y[0], dz = p->z[1] - p->z[0], square = dx * dx + dy * dy;
    if (!(square > 0)) return;
    p->slope_x = dz * dx / square;
    p->slope_y = dz * dy / square;
    p->steepness = sqrt(1 + dz * dz / square);
}

// The plane of a facet, from its normal in the frame: out is along it, u and v across.
static void set_plane_slope(manifold_patch *p, vec3 plane) {
    p->slope_x = -plane.x / plane.z;
    p->slope_y = -plane.y / plane.z;
    p->steepness = max2(1, 1 / fabs(plane.z));
}

static void close_patch(manifold_patch *p) {
    p->x[p->count] = p->x[0];
    p->y[p->count] = p->y[0];
    p->slope_x = p->slope_y = 0;
    p->steepness = 1;
    if (p->count == 2) set_line_slope(p);
}

void patch_make_a(const manifold_frame *m, uint32_t feature, manifold_patch *p) {
    corner_list list;
    list_corners(m->pair->a, feature, &list);
    take_corners(&list, 0, p);
    for (uint32_t i = 0; i < p->count; i++) {
        vec3 x = frame_vertex_a(m->pair, p->vertices[i]);
        p->x[i] = vec3_dot(m->u, x);
        p->y[i] = vec3_dot(m->v, x);
        p->z[i] = vec3_dot(m->n, x);
    }
    close_patch(p);
    if (p->count < 3) return;
    vec3 normal = shape_get_facet_normal(m->pair->a, feature_get_index(feature));
    set_plane_slope(p, (vec3){vec3_dot(m->u, normal), vec3_dot(m->v, normal), vec3_dot(m->n, normal)});
}

void patch_make_b(const manifold_frame *m, uint32_t feature, manifold_patch *p) {
    corner_list list;
    list_corners(m->pair->b, feature, &list);
    take_corners(&list, 1, p);
    for (uint32_t i = 0; i < p->count; i++) {
        vec3 x = vec3_at(shape_vertices(m->pair->b), p->vertices[i]);
        p->x[i] = vec3_dot(m->u_in_b, x) + m->tu;
        p->y[i] = vec3_dot(m->v_in_b, x) + m->tv;
        p->z[i] = vec3_dot(m->n_in_b, x) + m->tn;
    }
    close_patch(p);
    if (p->count < 3) return;
    vec3 normal = shape_get_facet_normal(m->pair->b, feature_get_index(feature));
    set_plane_slope(p, (vec3){vec3_dot(m->u_in_b, normal), vec3_dot(m->v_in_b, normal), vec3_dot(m->n_in_b, normal)});
}

// The distance of a point from the segment from corner i to the next.
static double measure_segment(const manifold_patch *p, uint32_t i, double x, double y) {
    double dx = p->x[i + 1] - p->x[i], dy = p->y[i + 1] - p->y[i], px = x - p->x[i], py = y - p->y[i];
    double square = dx * dx + dy * dy, t = square > 0 ? (px * dx + py * dy) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    px -= t * dx;
    py -= t * dy;
    return sqrt(px * px + py * py);
}

double patch_measure_distance(const manifold_patch *p, double x, double y) {
    double most = p->count > 2 ? -INFINITY : INFINITY, nearest = INFINITY;
    for (uint32_t i = 0; p->count > 2 && i < p->count; i++) {
        double dx = p->x[i + 1] - p->x[i], dy = p->y[i + 1] - p->y[i], square = dx * dx + dy * dy;
        double out = dy * (x - p->x[i]) - dx * (y - p->y[i]);
        if (square > 0) most = max2(most, out / sqrt(square));
    }
    if (most <= 0) return most;
    for (uint32_t i = 0; i < (p->count > 1 ? patch_get_edge_count(p) : 1); i++)
        nearest = min2(nearest, measure_segment(p, i, x, y));
    return nearest;
}
