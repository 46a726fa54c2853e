// What of a body is clipped, seen along the normal. A facet of many corners is used with as many of them as fit: their
// hull is in the facet, so what is found in it is true of the body.
#include "manifold/manifold.h"

#include "linear/both.h"

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

static void set_side(manifold_patch *p, uint32_t i, double x, double y, uint32_t corner) {
    p->side_x[i] = x;
    p->side_y[i] = y;
    p->side_at[i] = x * p->x[corner] + y * p->y[corner];
}

// The half-plane to the left of an edge.
static void set_edge_side(manifold_patch *p, uint32_t i, uint32_t from, uint32_t to) {
    double dx = p->x[to] - p->x[from], dy = p->y[to] - p->y[from], square = dx * dx + dy * dy;
    double scale = square > 0 ? 1 / sqrt(square) : 0;
    set_side(p, i, -dy * scale, dx * scale, from);
    if (!(square > 0)) p->side_at[i] = -INFINITY;
}

static void close_patch(manifold_patch *p) {
    for (uint32_t k = 0; k < 2; k++) p->x[p->count + k] = p->x[0], p->y[p->count + k] = p->y[0];
    p->slope_x = p->slope_y = 0;
    p->steepness = 1;
    p->side_count = p->count > 2 ? p->count : 4;
    for (uint32_t i = 0; i < p->count && p->count > 1; i++) set_edge_side(p, i, i, i + 1);
    if (p->count == 2) {
        set_side(p, 2, p->side_y[0], -p->side_x[0], 0);
        set_side(p, 3, -p->side_y[0], p->side_x[0], 1);
        set_line_slope(p);
    } else if (p->count == 1)
        for (uint32_t i = 0; i < 4; i++) set_side(p, i, i < 2 ? 1 - 2.0 * i : 0, i < 2 ? 0 : 5 - 2.0 * i, 0);
}

// What the patches of A and of B differ in: the body, the frame's axes in its frame, and how a vertex is placed.
typedef struct patch_body {
    const ovoid_shape *shape;
    vec3 u, v, n;
    int is_b;
} patch_body;

static void make_patch(const manifold_frame *m, const patch_body *body, uint32_t feature, manifold_patch *p) {
    corner_list list;
    list_corners(body->shape, feature, &list);
    take_corners(&list, body->is_b, p);
    for (uint32_t i = 0; i < p->count; i++) {
        vec3 x = body->is_b ? frame_place_b(m, p->vertices[i]) : frame_place_a(m, p->vertices[i]);
        p->x[i] = x.x, p->y[i] = x.y, p->z[i] = x.z;
    }
    close_patch(p);
    if (p->count < 3) return;
    vec3 normal = shape_get_facet_normal(body->shape, feature_get_index(feature));
    set_plane_slope(p, (vec3){vec3_dot(body->u, normal), vec3_dot(body->v, normal), vec3_dot(body->n, normal)});
}

void patch_make_a(const manifold_frame *m, uint32_t feature, manifold_patch *p) {
    make_patch(m, &(patch_body){m->pair->a, m->u, m->v, m->n, 0}, feature, p);
}

void patch_make_b(const manifold_frame *m, uint32_t feature, manifold_patch *p) {
    make_patch(m, &(patch_body){m->pair->b, m->u_in_b, m->v_in_b, m->n_in_b, 1}, feature, p);
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
    double least = INFINITY, nearest = INFINITY;
    for (uint32_t i = 0; p->count > 2 && i < p->count; i++) least = min2(least, patch_get_side(p, i, x, y));
    if (p->count > 2 && least >= 0) return 0;
    for (uint32_t i = 0; i < (p->count > 1 ? patch_get_edge_count(p) : 1); i++)
        nearest = min2(nearest, measure_segment(p, i, x, y));
    return nearest;
}

// Two corners at a time; there is one more than there are. Coordinates are finite.
void patch_table_fill(const manifold_patch *p, const manifold_patch *other, patch_table *t) {
    double distance[PATCH_CORNERS + 1];
    for (uint32_t k = 0; k < other->count; k++) t->least[k] = INFINITY;
    for (uint32_t i = 0; i < p->side_count; i++) {
        both nx = both_make(p->side_x[i], p->side_x[i]), ny = both_make(p->side_y[i], p->side_y[i]);
        both at = both_make(p->side_at[i], p->side_at[i]);
        for (uint32_t k = 0; k < other->count; k += 2) {
            both d = (nx * both_make(other->x[k], other->x[k + 1]) + ny * both_make(other->y[k], other->y[k + 1])) - at;
            distance[k] = d[0];
            distance[k + 1] = d[1];
        }
        double most = -INFINITY;
        uint64_t outside = 0;
        for (uint32_t k = 0; k < other->count; k++) {
            most = max2(most, distance[k]);
            t->least[k] = min2(t->least[k], distance[k]);
            outside |= (uint64_t)(distance[k] < 0) << k;
        }
        t->most[i] = most;
        t->outside[i] = outside;
    }
}
