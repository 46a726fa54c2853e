// A true cylinder or cone and a point, or a sphere, in closed form.
//
// In the half plane of the radius r and the height z the round body is a rectangle or a triangle. The normal of the
// nearest point is a side's where the point is beyond or behind one side, else the difference from a corner. The gap
// along that normal is the lower bound; the upper one is shown by a ball in the body about the nearest point, or about
// the point itself if the body holds it.
#include "exact/round.h"

#include "pair/balls.h"

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

// The normal n, out of the body in A's frame, and the point x in the body's frame.
static void take_bounds(search *s, int is_round_a, vec3 x, vec3 n) {
    const pair_frame *f = s->frame;
    vec3 along = is_round_a ? n : vec3_neg(n);
    double gap = round_find_ends(f, along).gap;
    vec3 in_body = is_round_a ? n : mat3_mul_transposed_vec3(f->rotation, n);
    const ovoid_shape *round = is_round_a ? f->a : f->b;
    vec3 center = balls_cut_off(round, gap > 0 ? vec3_add_scaled(x, in_body, -gap) : x);
    ball_centers c = is_round_a ? (ball_centers){center, f->b->first} : (ball_centers){f->a->first, center};
    double upper = balls_measure(f, &c, f->claim + BALLS_CLAIM * f->size) - balls_compute_radii(f);
    search_take_gap(s, along, gap);
    if (!(upper < s->upper)) return;
    s->upper = upper;
    s->kind = OVOID_PROOF_BALLS;
    s->witness = (evidence){.count = 1, .weight = {1}};
    s->inner_a = c.a;
    s->inner_b = c.b;
}

static int is_turned(const ovoid_shape *s) { return shape_is_round(s) && !shape_is_ellipsoid(s); }

int round_take_point(search *s) {
    const pair_frame *f = s->frame;
    if (f->b->vertex_count == 1 && is_turned(f->a)) {
        take_bounds(s, 1, frame_b(f, f->b->first), vec3_unit(find_point_normal(f->a, frame_b(f, f->b->first))));
    } else if (f->a->vertex_count == 1 && is_turned(f->b)) {
        vec3 x = mat3_mul_transposed_vec3(f->rotation, vec3_sub(f->a->first, f->translation));
        take_bounds(s, 0, x, vec3_unit(mat3_mul_vec3(f->rotation, find_point_normal(f->b, x))));
    } else {
        return 0;
    }
    s->stage = OVOID_STAGE_SUPPORT;
    return search_is_done(s);
}
