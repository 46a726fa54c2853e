// Which balls and which region lie inside a shape.
#include "robot/model/inner_balls.h"

#include "linear/mat3.h"
#include "ovoid/query.h"

enum { LATTICE = 6, TRIES = 4 * BALLS, CANDIDATES = LATTICE * LATTICE * LATTICE };

// Points of the lattice that are inside, by the planes, and how far from all of these.
typedef struct lattice {
    vec3 points[CANDIDATES];
    double radii[CANDIDATES];
    uint8_t is_covered[CANDIDATES];
    uint32_t count;
} lattice;

typedef struct ball_search {
    const ovoid_shape *shape, *point; ///< point: at its frame's origin
    const ovoid_solid *solid;         ///< NULL: the shape is the body
} ball_search;

static double find_radius(const ovoid_polytope *p, vec3 x) {
    double least = INFINITY;
    for (uint32_t i = 0; i < p->facet_count; i++)
        least = min2(least, p->planes[i].offset - vec3_dot(p->planes[i].normal, x));
    return least;
}

// Fills the lattice with the middles of the box's cells.
static void fill_lattice(lattice *l, const ovoid_shape *s, const ovoid_polytope *p) {
    vec3 low = s->measures.box.min, size = vec3_sub(s->measures.box.max, low);
    l->count = 0;
    for (uint32_t i = 0; i < CANDIDATES; i++) {
        uint32_t layer = i / (LATTICE * LATTICE), row = i / LATTICE % LATTICE;
        double x = (i % LATTICE + 0.5) / LATTICE, y = (row + 0.5) / LATTICE, z = (layer + 0.5) / LATTICE;
        vec3 point = vec3_add(low, (vec3){x * size.x, y * size.y, z * size.z});
        double radius = find_radius(p, point);
        if (!(radius > 0)) continue;
        l->points[l->count] = point;
        l->is_covered[l->count] = 0;
        l->radii[l->count++] = radius;
    }
}

// How many points that no ball covers yet a ball does; they are covered then, if is_taken.
static uint32_t cover(lattice *l, uint32_t which, int is_taken) {
    double square = l->radii[which] * l->radii[which];
    uint32_t count = 0;
    for (uint32_t i = 0; i < l->count; i++) {
        if (l->is_covered[i] || vec3_norm_squared(vec3_sub(l->points[i], l->points[which])) > square) continue;
        count++;
        l->is_covered[i] = (uint8_t)is_taken;
    }
    return count;
}

// The ball that covers most; its number, or count where all is covered.
static uint32_t find_next(lattice *l) {
    uint32_t best = l->count, most = 0;
    for (uint32_t i = 0; i < l->count; i++) {
        uint32_t covered = cover(l, i, 0);
        if (covered > most) most = covered, best = i;
    }
    return best;
}

static void put_ball(inner_balls *b, uint32_t at, vec3 center, double radius) {
    b->column[0][at] = center.x, b->column[1][at] = center.y, b->column[2][at] = center.z;
    b->column[BALLS_RADIUS][at] = radius;
}

// How far a point inside a solid is from all of its surface; 0: it is not shown to be inside.
static double prove_in_solid(const ball_search *search, vec3 center) {
    ovoid_body_pair pair = {{.shape = search->point, .pose = ovoid_pose_make_identity()},
                            {.solid = search->solid, .pose = ovoid_pose_make_identity()}};
    pair.a.pose.position = center;
    ovoid_body_answer found = ovoid_body_distance(&pair, NULL, NULL);
    return found.inside == OVOID_BODY_A_INSIDE && found.deciding.lower > 0 ? found.deciding.lower : 0;
}

// The ball around a point that is proven to lie in the body, radius and allowance counted; 0: none is.
static double prove_radius(const ball_search *search, vec3 center) {
    if (search->solid) return prove_in_solid(search, center);
    ovoid_pair pair = {search->point, search->shape, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_a.position = center;
    double upper = ovoid_depth(&pair, NULL, NULL, NULL).upper;
    return upper < 0 ? -upper : 0;
}

static uint32_t find_in_solid(const ball_search *search, inner_balls *b) {
    ovoid_polytope p = ovoid_shape_get_polytope(search->shape);
    lattice l;
    fill_lattice(&l, search->shape, &p);
    uint32_t count = 0;
    // Any number of the hull's points may be outside of a solid.
    for (uint32_t tries = 0; count < BALLS && tries < TRIES; tries++) {
        uint32_t next = find_next(&l);
        if (next == l.count) break;
        (void)cover(&l, next, 1);
        l.is_covered[next] = 1;
        vec3 center = vec3_add(search->shape->origin, l.points[next]);
        double radius = prove_radius(search, center);
        if (radius > 0) put_ball(b, count++, center, radius);
    }
    return count;
}

// Along the segment from the first to the last vertex.
static uint32_t find_in_segment(const ball_search *search, inner_balls *b) {
    const double *vertices = shape_vertices(search->shape);
    vec3 from = vec3_at(vertices, 0), to = vec3_at(vertices, search->shape->vertex_count - 1);
    uint32_t count = 0;
    for (uint32_t i = 0; i < BALLS; i++) {
        double t = i / (BALLS - 1.0);
        vec3 center = vec3_add(search->shape->origin, vec3_add(vec3_scale(from, 1 - t), vec3_scale(to, t)));
        double radius = prove_radius(search, center);
        if (radius > 0) put_ball(b, count++, center, radius);
    }
    return count;
}

static void find_balls(const ball_search *search, inner_balls *b) {
    uint32_t count = search->shape->rank == 3 ? find_in_solid(search, b) : find_in_segment(search, b);
    for (uint32_t i = count; i < BALLS; i++)
        for (uint32_t k = 0; k < BALLS_COLUMNS; k++)
            b->column[k][i] = count ? b->column[k][0] : k == BALLS_RADIUS ? -INFINITY : 0;
}

// ---- the region

static const inner_region nothing = {.offset = -INFINITY};

static inner_region make_box(const ovoid_shape *s) {
    const parallelepiped *p = &s->box;
    double lengths[3];
    vec3 unit[3];
    for (int k = 0; k < 3; k++) {
        lengths[k] = vec3_norm(p->axis[k]);
        unit[k] = vec3_scale(p->axis[k], 1 / lengths[k]);
    }
    double skew =
        fabs(vec3_dot(unit[0], unit[1])) + fabs(vec3_dot(unit[0], unit[2])) + fabs(vec3_dot(unit[1], unit[2]));
    if (!(skew < 1e-12)) return nothing;
    double slack = 1e-9 * s->extent;
    vec3 half = {lengths[0] - slack, lengths[1] - slack, lengths[2] - slack};
    if (!(min2(half.x, min2(half.y, half.z)) > 0)) return nothing;
    return (inner_region){{unit[0], unit[1], unit[2]}, vec3_add(s->origin, p->center), half, 1, 0, 1};
}

static inner_region make_ellipsoid(const ovoid_shape *s) {
    const shape_inner *in = &s->inside;
    if (!(in->least > 0)) return nothing;
    const double *w = in->w;
    mat3 map = {{w[0], 0, 0}, {w[1], w[2], 0}, {w[3], w[4], w[5]}};
    vec3 center = vec3_add(s->origin, s->inner.center);
    return (inner_region){map, center, {0, 0, 0}, 1 / in->reach, 1 - 1e-6, in->reach / in->least};
}

inner_region inner_region_find(const ovoid_shape *s) {
    inner_region box = s->box.is_present ? make_box(s) : nothing;
    return box.scale > 0 ? box : make_ellipsoid(s);
}

// The largest ball as a region.
static inner_region make_ball(const inner_balls *b) {
    int best = 0;
    for (int i = 1; i < BALLS; i++)
        if (b->column[BALLS_RADIUS][i] > b->column[BALLS_RADIUS][best]) best = i;
    double radius = b->column[BALLS_RADIUS][best];
    if (!(radius > 0)) return nothing;
    vec3 center = {b->column[0][best], b->column[1][best], b->column[2][best]};
    return (inner_region){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, center, {0, 0, 0}, 1, radius, 1};
}

ovoid_code shape_inside_find(const ovoid_shape *s, const ovoid_solid *solid, const ovoid_shape *point,
                             shape_inside *in) {
    const ball_search search = {s, point, solid};
    find_balls(&search, &in->balls);
    in->region = solid ? make_ball(&in->balls) : inner_region_find(s);
    in->most = in->least = in->balls.column[BALLS_RADIUS][0];
    for (int i = 1; i < BALLS; i++) {
        in->most = max2(in->most, in->balls.column[BALLS_RADIUS][i]);
        in->least = min2(in->least, in->balls.column[BALLS_RADIUS][i]);
    }
    in->size = 3 * (s->extent + vec3_max_abs(s->origin));
    in->gap = 0;
    return solid ? ovoid_solid_compute_hull_gap(solid, s, &in->gap, NULL) : OVOID_OK;
}
