// Corners as points of the bodies. A corner has a place across the normal; the points are where the planes of both
// patches are there, moved by the rounding radii.
#include "base/environment.h"
#include "manifold/manifold.h"

#include <string.h>

// The corners of a facet are within 4 FACET_FLATNESS of its plane, as triangles lower than that are joined to it. The
// plane is taken through its first corner with slopes whose error is that of a direction, 100 u, over the square of the
// cosine; what is placed with them is off by that times the size.
double manifold_compute_rounding(const manifold_state *s) {
    double steep = max2(s->a.steepness, s->b.steepness);
    return s->frame.pair->claim + 1024 * ROUNDING * steep * steep * s->frame.pair->size;
}

// A corner outside of its facet may be deeper on the facet's plane than the cores are along the normal: its points are
// brought to the gap, half of the way each.
double manifold_compute_excess(const manifold_state *s, const manifold_corner *c) {
    return c->outside * max2(s->a.steepness, s->b.steepness) + max2(s->frame.gap - c->separation, 0) / 2;
}

// A place on a plane is within four times the steepness times the size of A's origin.
double manifold_compute_world_rounding(const manifold_state *s) {
    const pair_frame *f = s->frame.pair;
    return 4 * ROUNDING * (vec3_max_abs(f->world_origin) + 4 * max2(s->a.steepness, s->b.steepness) * f->size);
}

static void set_heights(const manifold_state *s, manifold_corner *c) {
    c->separation = patch_get_height(&s->b, c->x, c->y) - patch_get_height(&s->a, c->x, c->y);
    double from_a = patch_measure_distance(&s->a, c->x, c->y), from_b = patch_measure_distance(&s->b, c->x, c->y);
    c->outside = max2(from_a, from_b);
}

// A vertex, to the other body's patch.
static manifold_corner make_vertex_a(const manifold_state *s, uint32_t vertex) {
    vec3 x = frame_place_a(&s->frame, vertex);
    double separation = patch_get_height(&s->b, x.x, x.y) - x.z;
    return (manifold_corner){
        x.x, x.y, separation, patch_measure_distance(&s->b, x.x, x.y), OVOID_MANIFOLD_ID_VERTEX_A | vertex, 0};
}
static manifold_corner make_vertex_b(const manifold_state *s, uint32_t vertex) {
    vec3 x = frame_place_b(&s->frame, vertex);
    double separation = x.z - patch_get_height(&s->a, x.x, x.y);
    return (manifold_corner){
        x.x, x.y, separation, patch_measure_distance(&s->a, x.x, x.y), OVOID_MANIFOLD_ID_VERTEX_B | vertex, 0};
}

// A vertex that is no corner of its own patch is none of the polygon: its patch is not there where it is.
static int patch_has_vertex(const manifold_patch *p, uint32_t vertex) {
    int found = 0;
    for (uint32_t i = 0; i < p->at.count; i++) found |= p->at.vertices[i] == vertex;
    return found;
}

// Of a facet and another body the vertex that is extreme; of edges and vertices the nearest points.
manifold_corner manifold_make_nearest(const manifold_state *s, const manifold_axis *axis) {
    const manifold_frame *m = &s->frame;
    manifold_corner c;
    if (axis->kind == OVOID_MANIFOLD_FACE_B || axis->a == OVOID_MANIFOLD_DIRECTION)
        c = make_vertex_a(s, m->low_a);
    else if (axis->kind == OVOID_MANIFOLD_FACE_A)
        c = make_vertex_b(s, m->low_b);
    else {
        feature_points p = features_find_nearest(m->pair, axis->a, axis->b);
        vec3 middle = vec3_scale(vec3_add(p.a, p.b), 0.5);
        c = (manifold_corner){.x = vec3_dot(m->u, middle), .y = vec3_dot(m->v, middle)};
    }
    c.id = OVOID_MANIFOLD_ID_NEAREST | (m->low_a & 0x7fff) << 15 | (m->low_b & 0x7fff);
    set_heights(s, &c);
    return c;
}

int manifold_open(const pair_frame *f, const ovoid_manifold *c, manifold_state *s) {
    if (c->axis == OVOID_MANIFOLD_NONE || c->count < 1 || c->count > 4) return 0;
    if (!shape_has_feature(f->a, c->facet_a) || !shape_has_feature(f->b, c->facet_b)) return 0;
    vec3 n = vec3_unit(frame_direction_from_world(f, c->normal));
    manifold_axis axis = {c->axis, c->feature_a, c->feature_b};
    if (!axis_compute_normal(f, &axis, &n) || !(vec3_norm_squared(n) > 0.5)) return 0;
    gap_along along = gap_measure_along(f, n);
    manifold_frame_make(f, &along, &s->frame);
    s->facet_a = c->facet_a;
    s->facet_b = c->facet_b;
    patch_make_a(&s->frame, s->facet_a, &s->a);
    patch_make_b(&s->frame, s->facet_b, &s->b);
    s->polygon.count = 0;
    return 1;
}

static int find_crossing(const manifold_state *s, uint32_t id, manifold_corner *c) {
    edge_crossing x;
    for (x.i = 0; x.i < patch_get_edge_count(&s->a); x.i++) {
        if ((s->a.edges[x.i] & 0x7fff) != (id >> 15 & 0x7fff)) continue;
        for (x.j = 0; x.j < patch_get_edge_count(&s->b); x.j++) {
            if (crossing_make_id(&s->a, &s->b, &x) != id || !patches_cross(&s->a, &s->b, &x)) continue;
            *c = (manifold_corner){.x = x.x, .y = x.y, .id = id};
            c->separation = patch_get_height(&s->b, x.x, x.y) - patch_get_height(&s->a, x.x, x.y);
            return 1;
        }
    }
    return 0;
}

int manifold_find_corner(const manifold_state *s, const ovoid_manifold *c, uint32_t id, manifold_corner *corner) {
    uint32_t index = feature_get_index(id);
    const manifold_axis axis = {c->axis, c->feature_a, c->feature_b};
    switch (feature_get_kind(id)) {
    case OVOID_MANIFOLD_ID_VERTEX_A:
        if (!patch_has_vertex(&s->a, index)) return 0;
        *corner = make_vertex_a(s, index);
        return 1;
    case OVOID_MANIFOLD_ID_VERTEX_B:
        if (!patch_has_vertex(&s->b, index)) return 0;
        *corner = make_vertex_b(s, index);
        return 1;
    case OVOID_MANIFOLD_ID_CROSSING: return find_crossing(s, id, corner);
    default: *corner = manifold_make_nearest(s, &axis); return corner->id == id;
    }
}

corner_placing corner_placing_make(const manifold_state *s) {
    const manifold_frame *m = &s->frame;
    const pair_frame *f = m->pair;
    const manifold_patch *a = &s->a;
    vec3 normal = frame_direction_to_world(f, m->n);
    double at = a->at.z[0] - (a->slope_x * a->at.x[0] + a->slope_y * a->at.y[0]) + f->a->radius;
    return (corner_placing){f->world_origin,
                            frame_direction_to_world(f, vec3_add_scaled(m->u, m->n, a->slope_x)),
                            frame_direction_to_world(f, vec3_add_scaled(m->v, m->n, a->slope_y)),
                            vec3_scale(normal, at),
                            normal,
                            m->gap,
                            f->a->radius + f->b->radius};
}

ovoid_manifold_point corner_placing_get_point(const corner_placing *p, const manifold_corner *c) {
    double separation = max2(c->separation, p->gap), lower = (c->separation - separation) / 2;
    vec3 in = vec3_add_scaled(vec3_add_scaled(vec3_scale(p->x, c->x), p->y, c->y), p->n, lower);
    vec3 a = vec3_add(p->origin, vec3_add(in, p->at));
    separation -= p->radii;
    return (ovoid_manifold_point){a, vec3_add_scaled(a, p->n, separation), separation, c->id};
}

// ---- the order of the bodies ----

static uint32_t exchange_id(uint32_t id) {
    if (id < OVOID_MANIFOLD_ID_CROSSING) return id ^ OVOID_MANIFOLD_ID_VERTEX_B;
    return (id & OVOID_MANIFOLD_KIND) | (id & 0x7fff) << 15 | (id >> 15 & 0x7fff);
}

void point_exchange(ovoid_manifold_point *p) {
    vec3 a = p->point_a;
    p->point_a = p->point_b;
    p->point_b = a;
    p->id = exchange_id(p->id);
}

static ovoid_manifold_axis exchange_axis(ovoid_manifold_axis axis) {
    return axis == OVOID_MANIFOLD_FACE_A   ? OVOID_MANIFOLD_FACE_B
           : axis == OVOID_MANIFOLD_FACE_B ? OVOID_MANIFOLD_FACE_A
                                           : axis;
}

ovoid_manifold ovoid_manifold_make_swapped(const ovoid_manifold *given) {
    ovoid_manifold c = *given;
    c.normal = vec3_neg(c.normal);
    for (int i = 0; i < 4 && i < c.count; i++) c.id[i] = exchange_id(c.id[i]);
    c.feature_a = given->feature_b;
    c.feature_b = given->feature_a;
    c.facet_a = given->facet_b;
    c.facet_b = given->facet_a;
    c.axis = exchange_axis(c.axis);
    c.memory.flags ^= MANIFOLD_EXCHANGED;
    return c;
}

ordered_pair ordered_pair_make(const ovoid_pair *pair, const ovoid_manifold *c) {
    if (!(c->memory.flags & MANIFOLD_EXCHANGED)) return (ordered_pair){*pair, *c, 0};
    return (ordered_pair){pair_make_exchanged(pair), ovoid_manifold_make_swapped(c), 1};
}

void manifold_write_points(const manifold_state *s, const corner_choice *chosen, int is_exchanged,
                           ovoid_manifold_points *out) {
    double excess = 0;
    corner_placing placing = corner_placing_make(s);
    memset(out, 0, sizeof *out);
    for (uint32_t i = 0; i < chosen->count; i++) {
        const manifold_corner *corner = s->polygon.corners + chosen->index[i];
        out->points[i] = corner_placing_get_point(&placing, corner);
        if (is_exchanged) point_exchange(out->points + i);
        excess = max2(excess, manifold_compute_excess(s, corner));
    }
    out->count = chosen->count;
    out->grown = excess + manifold_compute_world_rounding(s) + manifold_compute_rounding(s);
}

void manifold_compute_points_internal(const ovoid_pair *pair, const ovoid_manifold *c, ovoid_manifold_points *out) {
    ordered_pair o = ordered_pair_make(pair, c);
    pair_frame f;
    manifold_state s;
    memset(out, 0, sizeof *out);
    if (frame_make(&o.pair, &f) != OVOID_LIMIT_NONE || !manifold_open(&f, &o.manifold, &s)) return;
    for (uint32_t i = 0; i < c->count; i++)
        if (!manifold_find_corner(&s, &o.manifold, o.manifold.id[i], s.polygon.corners + i)) return;
    manifold_write_points(&s, &(corner_choice){c->count, {0, 1, 2, 3}, 1}, o.is_exchanged, out);
}

ovoid_manifold_points ovoid_manifold_compute_points(const ovoid_pair *pair, const ovoid_manifold *manifold) {
    ENVIRONMENT_RETURN_FILLED(ovoid_manifold_points, points, pair,
                              manifold_compute_points_internal(pair, manifold, &points));
}
