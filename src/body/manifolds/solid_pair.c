// The frame of a convex part and a solid, and what of the solid's triangles is near the part.
#include "body/manifolds/solid_pair.h"

#include "linear/rotation.h"
#include "linear/triangle.h"

ovoid_limit solid_pair_make(solid_pair *p, const ovoid_posed_shape *part, const ovoid_body *solid) {
    const ovoid_shape *a = part->shape;
    p->solid = solid->solid;
    p->pose = &solid->pose;
    p->part = *part;
    triangle_begin(&p->room);
    const vec3 none[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    triangle_set(&p->room, none);
    p->room.shape.extent = p->room.shape.span = p->solid->extent;
    const ovoid_pair pair = {a, &p->room.shape, part->pose, solid->pose};
    ovoid_limit refused = frame_make(&pair, &p->frame);
    if (refused != OVOID_LIMIT_NONE) return refused;
    p->center = solid_pair_get_point(p, a->inner.center);
    p->slack = 1;
    p->snap = MANIFOLD_SNAP * (a->reach + a->radius) + 16 * p->frame.claim;
    return OVOID_LIMIT_NONE;
}

// ---- boxes and walks

// The tree lies within one unit of its origin. No end is as large as those of lanes that are not used.
static double limit_end(double x) { return x > 4 ? 4 : x < -4 ? -4 : x; }

static tree_ends make_ends(const ovoid_solid *s, const double low[3], const double high[3]) {
    tree_ends e;
    for (int k = 0; k < 3; k++) {
        e.ends[k] = limit_end((low[k] - vec3_get(s->center, k)) / s->unit);
        e.ends[3 + k] = limit_end((high[k] - vec3_get(s->center, k)) / s->unit);
    }
    return e;
}

tree_ends solid_pair_make_ends(const solid_pair *p, double more) {
    const mat3 *r = &p->frame.rotation;
    const vec3 axes[3] = {{r->r0.x, r->r1.x, r->r2.x}, {r->r0.y, r->r1.y, r->r2.y}, {r->r0.z, r->r1.z, r->r2.z}};
    double low[3], high[3], room = more + p->frame.lower_radii + p->frame.claim + p->solid->flatness + p->snap;
    for (int k = 0; k < 3; k++) {
        double at = vec3_dot(axes[k], p->frame.translation);
        high[k] = shape_find_extreme(p->part.shape, axes[k]).value - at + room;
        low[k] = -shape_find_extreme(p->part.shape, vec3_neg(axes[k])).value - at - room;
    }
    return make_ends(p->solid, low, high);
}

tree_ends solid_make_ends(const ovoid_solid *solid, vec3 center, double radius) {
    const double low[3] = {center.x - radius, center.y - radius, center.z - radius};
    const double high[3] = {center.x + radius, center.y + radius, center.z + radius};
    return make_ends(solid, low, high);
}

void place_walk_begin(place_walk *w, const ovoid_solid *solid, const tree_ends *ends) {
    box8_begin(&w->walk, solid->boxes, ends->ends);
    w->count = w->at = 0;
}

uint32_t place_walk_get_next(place_walk *w) {
    if (w->at == w->count) {
        w->count = box8_find_leaves(&w->walk, w->places, sizeof w->places / sizeof *w->places);
        w->at = 0;
    }
    return w->at < w->count ? w->places[w->at++] : UINT32_MAX;
}

// ---- triangles

vec3 solid_find_nearest(const ovoid_solid *solid, uint32_t place, vec3 x) {
    const vec3 corner[3] = {solid_get_corner(solid, place, 0), solid_get_corner(solid, place, 1),
                            solid_get_corner(solid, place, 2)};
    return triangle_find_nearest(corner, x);
}

facet_plane solid_pair_get_plane(const solid_pair *p, uint32_t facet) {
    const ovoid_solid *s = p->solid;
    facet_plane plane = {facet, solid_compute_facet_normal(s, facet), solid_get_corner(s, facet, 0), 0};
    if (s->report.is_closed || !(vec3_dot(plane.normal, vec3_sub(p->center, plane.point)) < 0)) return plane;
    plane.normal = vec3_neg(plane.normal);
    plane.is_turned = 1;
    return plane;
}

double solid_pair_measure_gap(const solid_pair *p, vec3 n, vec3 point) {
    return vec3_dot(n, frame_b(&p->frame, point)) - shape_find_extreme(p->part.shape, n).value;
}
