// The greatest gap of true bodies along a direction: GJK (E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure
// for computing the distance between complex objects in three-dimensional space, 1988) with the supports of cylinders
// and cones in closed form, from the normal that the search of their polyhedra found.
//
// Of bodies that overlap by d along n, B is first moved by t = d + r along n, so that they are r apart along it. The
// direction m of their nearest points then satisfies gap(m) + t m.n >= gap(n) + t: gap(m) >= gap(n), and the bound
// grows until the normal stays. It is the gap of a direction, so it holds whatever the search does.
//
// The nearest points of bodies that are apart give the upper bound. Of those that were moved apart each is a deepest
// point, and the ball about it in the other body is the upper bound, where that body is deep on all sides of it.
#include "exact/round.h"

#include "pair/balls.h"

enum { STEPS = 64, MOVES = 16 };

// A point of each body, in its body frame; the vertices, of polyhedra.
typedef struct touch {
    vec3 a, b;
    uint32_t vertex_a, vertex_b;
} touch;

// A search of true bodies. Bounds are those of the cores, radii aside.
typedef struct rounder {
    const pair_frame *frame;
    double best, enough; ///< the greatest gap; a gain that is too little to go on
    double first;        ///< the gap along the polyhedra's normal
    vec3 normal;
    uint32_t steps, most;
    uint32_t count; ///< of the touches, which the simplex's entries name
    touch touches[STEPS + 4];
    double upper;
    ball_centers centers;
    evidence points; ///< of a centre that is a point
} rounder;

static double find_support(const ovoid_shape *s, vec3 n, vec3 *point, uint32_t *vertex) {
    *vertex = 0;
    if (shape_is_round(s)) return round_find_support(s, n, point);
    simd_extreme x = shape_find_extreme(s, n);
    *point = (vec3){x.x, x.y, x.z};
    *vertex = x.index;
    return x.value;
}

// The gap along the unit n and the difference of the points.
static double probe(rounder *r, vec3 n, vec3 *w) {
    const pair_frame *f = r->frame;
    touch *t = &r->touches[r->count++];
    vec3 in_b = vec3_neg(mat3_mul_transposed_vec3(f->rotation, n));
    double high = find_support(f->a, n, &t->a, &t->vertex_a), low = find_support(f->b, in_b, &t->b, &t->vertex_b);
    double gap = (vec3_dot(n, f->translation) - low) - high;
    *w = vec3_sub(frame_b(f, t->b), t->a);
    r->steps++;
    if (!(gap <= r->best)) r->best = gap, r->normal = n;
    return gap;
}

// ---- upper bounds

static void take_centers(rounder *r, ball_centers c, const simplex *p) {
    const pair_frame *f = r->frame;
    if (!c.is_point_a) c.a = balls_cut_off(f->a, c.a);
    if (!c.is_point_b) c.b = balls_cut_off(f->b, c.b);
    double upper = balls_measure(f, &c, f->claim + BALLS_CLAIM * f->size);
    if (!(upper < r->upper)) return;
    r->upper = upper;
    r->centers = c;
    r->points.count = 0;
    for (int i = 0; i < p->count && (c.is_point_a | c.is_point_b); i++) {
        const touch *t = &r->touches[p->p[i].a];
        r->points.p[r->points.count] = (difference){p->p[i].w, t->vertex_a, t->vertex_b};
        r->points.weight[r->points.count++] = p->weight[i];
    }
}

static vec3 move_to_b(const pair_frame *f, vec3 x) {
    return mat3_mul_transposed_vec3(f->rotation, vec3_sub(x, f->translation));
}

// The same point x of A's frame as centre of both balls, where no body needs a point of its own.
static void take_common(rounder *r, vec3 x, const simplex *p) {
    take_centers(r, (ball_centers){x, move_to_b(r->frame, x), 0, 0}, p);
}

// The centre that is moved off the rim of a face, toward both bodies' middles, across the normal.
static vec3 move_inward(const rounder *r, vec3 x) {
    const pair_frame *f = r->frame;
    vec3 middle = vec3_scale(vec3_add(f->a->center, frame_b(f, f->b->center)), 0.5), way = vec3_sub(middle, x);
    way = vec3_add_scaled(way, r->normal, -vec3_dot(way, r->normal));
    double length = vec3_norm(way), most = -2 * r->best;
    return length > most ? vec3_add_scaled(x, way, most / length) : vec3_add(x, way);
}

static int is_narrow(const rounder *r) { return r->upper - r->best <= 3 * r->enough; }

// The bounds of the simplex's nearest points, whose entries name touches.
static void take_nearest(rounder *r, const simplex *p) {
    const pair_frame *f = r->frame;
    ball_centers c = {{0, 0, 0}, {0, 0, 0}, !balls_fit(f->a), !balls_fit(f->b)};
    for (int i = 0; i < p->count; i++) {
        c.a = vec3_add_scaled(c.a, r->touches[p->p[i].a].a, p->weight[i]);
        c.b = vec3_add_scaled(c.b, r->touches[p->p[i].a].b, p->weight[i]);
    }
    take_centers(r, c, p);
    if (r->best > 0 || is_narrow(r)) return;
    vec3 b = frame_b(f, c.b);
    if (!c.is_point_a) take_centers(r, (ball_centers){b, c.b, 0, c.is_point_b}, p);
    if (!c.is_point_b) take_centers(r, (ball_centers){c.a, move_to_b(f, c.a), c.is_point_a, 0}, p);
    if (c.is_point_a || c.is_point_b || is_narrow(r)) return;
    vec3 middle = vec3_scale(vec3_add(c.a, b), 0.5);
    take_common(r, middle, p);
    take_common(r, move_inward(r, c.a), p);
    take_common(r, move_inward(r, b), p);
    take_common(r, move_inward(r, middle), p);
}

// ---- the nearest points

// Those of the bodies with B moved by t, from the direction n and the differences `start` of their points.
static void find_nearest(rounder *r, vec3 n, vec3 t, const evidence *start) {
    simplex p = {.count = 0};
    double last = INFINITY;
    r->count = 0;
    for (int i = 0; start && i < start->count && i < 3; i++) {
        const difference *d = &start->p[i];
        r->touches[r->count] =
            (touch){vec3_at(shape_vertices(r->frame->a), d->a), vec3_at(shape_vertices(r->frame->b), d->b), d->a, d->b};
        p.p[p.count++] = (difference){vec3_add(d->w, t), r->count, r->count};
        r->count++;
    }
    for (int step = 0; step < STEPS && r->steps < r->most; step++) {
        vec3 w;
        double gap = probe(r, n, &w) + vec3_dot(n, t);
        if (last - gap <= r->enough) break;
        p.p[p.count++] = (difference){vec3_add(w, t), r->count - 1, r->count - 1};
        n = simplex_reduce(&p);
        if (!(vec3_norm_squared(n) > 0.5)) break;
        double distance = vec3_norm(simplex_compute_point(&p));
        if (!(distance < last)) break;
        last = distance;
    }
    take_nearest(r, &p);
}

// ---- a round body and a point
//
// In the half plane of the radius r and the height z the round body is a rectangle or a triangle. The normal of the
// nearest point is a side's where the point is beyond or behind one side, else the difference from a corner.

typedef struct half_plane {
    double r, z;
} half_plane;

static half_plane make_unit(double r, double z) {
    vec3 n = vec3_unit((vec3){r, z, 0});
    return (half_plane){n.x, n.y};
}

static half_plane find_cylinder_normal(const ovoid_round *round, half_plane x) {
    double beyond = x.r - round->radius, above = fabs(x.z) - round->half_length, way = x.z < 0 ? -1 : 1;
    if (beyond > 0 && above > 0) return make_unit(beyond, way * above);
    return beyond > above ? (half_plane){1, 0} : (half_plane){0, way};
}

static half_plane find_cone_normal(const ovoid_round *round, half_plane x) {
    double radius = round->radius, height = 2 * round->half_length, below = -round->half_length - x.z;
    half_plane side = make_unit(height, radius);
    double off = side.r * (x.r - radius) - side.z * below;
    // Along the side from the rim to the apex.
    double along = -side.z * (x.r - radius) - side.r * below, length = sqrt(height * height + radius * radius);
    if (off > 0 && along >= length) return make_unit(x.r, x.z - round->half_length);
    if (off > 0 && along > 0) return side;
    if (along <= 0 && x.r > radius) return make_unit(x.r - radius, -below);
    return below > off ? (half_plane){0, -1} : side;
}

// The normal from a round body to a point x, both in its body frame.
static vec3 find_point_normal(const ovoid_shape *s, vec3 x) {
    vec3 v = vec3_add(x, s->origin);
    double r = vec3_norm((vec3){v.x, v.y, 0});
    half_plane at = {r, v.z};
    half_plane n =
        s->round.kind == OVOID_ROUND_CONE ? find_cone_normal(&s->round, at) : find_cylinder_normal(&s->round, at);
    return r > 0 ? (vec3){n.r * (v.x / r), n.r * (v.y / r), n.z} : (vec3){n.r, 0, n.z};
}

// The bounds of a round body and a point x in the body's frame: the normal n out of the body in A's frame.
static void take_point_along(rounder *r, int is_round_a, vec3 x, vec3 n) {
    const pair_frame *f = r->frame;
    vec3 w;
    double gap = probe(r, is_round_a ? n : vec3_neg(n), &w);
    vec3 in_body = is_round_a ? n : mat3_mul_transposed_vec3(f->rotation, n);
    vec3 center = gap > 0 ? vec3_add_scaled(x, in_body, -gap) : x;
    const simplex one = {.count = 1, .weight = {1}};
    ball_centers c = is_round_a ? (ball_centers){center, f->b->first, 0, 1} : (ball_centers){f->a->first, center, 1, 0};
    take_centers(r, c, &one);
}

// The bounds of a round body and a point, or a sphere; 0 of other pairs.
static int take_point(rounder *r) {
    const pair_frame *f = r->frame;
    if (f->b->vertex_count == 1 && shape_is_round(f->a)) {
        vec3 x = frame_b(f, f->b->first);
        take_point_along(r, 1, x, vec3_unit(find_point_normal(f->a, x)));
    } else if (f->a->vertex_count == 1 && shape_is_round(f->b)) {
        vec3 x = move_to_b(f, f->a->first);
        take_point_along(r, 0, x, vec3_unit(mat3_mul_vec3(f->rotation, find_point_normal(f->b, x))));
    } else {
        return 0;
    }
    return 1;
}

// ---- any pair

static void search_normal(rounder *r, const search *s, vec3 n) {
    const pair_frame *f = s->frame;
    const evidence *start = s->kind == OVOID_PROOF_POINTS ? &s->witness : NULL;
    double off = 2e-3 * (f->a->reach + f->b->reach);
    vec3 w;
    r->first = probe(r, n, &w);
    for (int move = 0; move < MOVES && r->steps < r->most && !is_narrow(r); move++) {
        double before = r->best;
        find_nearest(r, r->normal, vec3_scale(r->normal, before < off ? off - before : 0), start);
        if (before >= off || !(r->best - before > r->enough)) break;
        // The balls show no more than the polyhedra, as where a rim crosses an edge.
        if (s->goal.wants_depth && r->best < 0 && !(r->upper - balls_compute_radii(f) < s->upper)) break;
    }
}

static void take_lower(search *s, vec3 n, double gap) {
    double lower = round_compute_lower(s->frame, n, gap);
    if (!(lower > s->lower)) return;
    s->lower = lower;
    s->normal = n;
    s->world = s->world_low = (vec3){0, 0, 0};
    s->stage = OVOID_STAGE_GJK;
}

// A depth whose points stay those of the polyhedra keeps their normal, since the points belong to it.
static void take_bounds(const rounder *r, search *s, vec3 n) {
    double upper = r->upper - balls_compute_radii(r->frame);
    int is_better = upper < s->upper, is_kept = s->goal.wants_depth && !is_better && r->best < 0;
    take_lower(s, is_kept ? n : r->normal, is_kept ? r->first : r->best);
    if (!is_better) return;
    s->upper = upper;
    s->kind = OVOID_PROOF_BALLS;
    s->witness = r->points;
    s->inner_a = r->centers.a;
    s->inner_b = r->centers.b;
    s->stage = OVOID_STAGE_GJK;
}

void round_run(search *s, vec3 n) {
    const pair_frame *f = s->frame;
    uint64_t most = 2 * (uint64_t)s->goal.iterations;
    if (s->iterations >= most) return;
    rounder r;
    r.frame = f;
    r.best = r.first = -INFINITY;
    r.normal = n;
    r.enough = max2(0.25 * (s->goal.tolerance - s->goal.allowance), f->claim);
    r.steps = r.count = 0;
    r.most = (uint32_t)min2(UINT32_MAX, (double)(most - s->iterations));
    r.upper = INFINITY;
    r.points.count = 0;
    if (!take_point(&r)) search_normal(&r, s, n);
    s->iterations += r.steps;
    take_bounds(&r, s, n);
}
