// Two bodies, a solid of up to 24 triangles over up to 12 points, and another, a shape or a compound of it. Truth: the
// exact judge (not of compounds), and the check without search, of each answer; brackets of one distance have a point
// in common; manifolds hold before the check without search; a winding number is the same again, and none is given of
// what is not closed; where a surface meets itself does not depend on how much is asked for. Of two that move: the
// check of their impact, and the bodies at sampled times.
#include "ask.h"
#include "bodies.h"
#include "meshes.h"

#ifdef OVOID_HAVE_JUDGE
#include <judge.h>

static void put_before_judge(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    static judge *the_judge;
    if (!the_judge) the_judge = judge_create();
    fuzz_require(the_judge != NULL);
    judge_set_options(the_judge, &(ovoid_options){.absolute_tolerance = INFINITY});
    ovoid_error error = {OVOID_OK, -1, ""};
    if (pair->a.compound || pair->b.compound) return;
    fuzz_require_code(judge_verify_solid(the_judge, pair, x, all, 0, &error), &error);
    judge_forget(the_judge);
}
#else
static void put_before_judge(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    (void)pair, (void)x, (void)all;
}
#endif

enum { ITEMS = 2048, STEPS = 8192, GROUPS = 1024 };

static ovoid_solid *take_solid(fuzz_bytes *from) {
    fuzz_triangles m = take_triangles(from);
    ovoid_solid *s = fuzz_make_solid(&m);
    if (!s) return NULL;
    ovoid_solid_report r = ovoid_solid_get_report(s);
    int64_t winding = 0, again = 0;
    ovoid_vec3 p = {take_double(from), take_double(from), take_double(from)};
    int found = ovoid_solid_compute_winding(s, p, &winding);
    fuzz_require(!found || r.is_closed);
    fuzz_require(found == ovoid_solid_compute_winding(s, p, &again) && winding == again);
    ovoid_solid_crossings all = ovoid_solid_compute_crossings(s, UINT64_MAX),
                          some = ovoid_solid_compute_crossings(s, 2);
    fuzz_require(all.is_complete && some.pairs == (all.pairs < 2 ? all.pairs : 2));
    fuzz_require(some.triangle_a == all.triangle_a && some.triangle_b == all.triangle_b);
    fuzz_require(r.components >= 1 && r.components <= r.points);
    return s;
}

// One to four of the shape; NULL where it is refused.
static ovoid_compound *take_compound(fuzz_bytes *from, const ovoid_shape *shape, int is_wild) {
    ovoid_posed_shape parts[4];
    size_t count = 1 + (size_t)((unsigned)take_byte(from) & 3);
    for (size_t i = 0; i < count; i++) parts[i] = (ovoid_posed_shape){shape, take_any_pose(from, is_wild)};
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_compound *made = ovoid_compound_create(parts, count, NULL, &error);
    if (!made) fuzz_require_error(&error);
    return made;
}

typedef struct findings {
    const ovoid_body_pair *pair;
    double lower, upper;
} findings;

static void check(findings *f, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_error error = {OVOID_OK, -1, ""};
    if (all->count <= all->capacity) {
        fuzz_require_code(ovoid_body_verify(f->pair, x, &(ovoid_body_basis){.exclusions = all}, &error), &error);
        put_before_judge(f->pair, x, all);
    }
    f->lower = fmax(f->lower, x->lower);
    f->upper = fmin(f->upper, x->upper);
    fuzz_require(f->lower <= f->upper);
}

static void ask(findings *f, double margin, const ovoid_body_proof *earlier, size_t capacity) {
    static ovoid_exclusion items[ITEMS];
    ovoid_exclusions all = {.items = items, .capacity = capacity};
    ovoid_body_answer x =
        ovoid_body_collide(f->pair, NULL, &(ovoid_body_evidence){.earlier = earlier, .exclusions = &all});
    check(f, &x, &all);
    x = ovoid_body_within(f->pair, margin, NULL, &(ovoid_body_evidence){.earlier = earlier, .exclusions = &all});
    check(f, &x, &all);
    x = ovoid_body_distance(f->pair, NULL, &(ovoid_body_evidence){.earlier = earlier, .exclusions = &all});
    check(f, &x, &all);
    ovoid_body_proof known = {x.part_a, x.part_b, x.deciding.proof};
    x = ovoid_body_distance(f->pair, NULL, &(ovoid_body_evidence){.earlier = &known, .exclusions = &all});
    check(f, &x, &all);
}

// ---- manifolds

// Each manifold of a part and a facet holds before the check without search, has its points, and is that of the bodies
// exchanged with its sides exchanged.
static void ask_manifolds(const ovoid_body_pair *pair, double margin) {
    static ovoid_body_manifold items[2][64];
    static ovoid_manifold_points points[64];
    const ovoid_manifold_options options = {.margin = fmin(margin, OVOID_LENGTH_MAX)};
    const ovoid_body_pair exchanged = {pair->b, pair->a};
    ovoid_body_manifolds found = {.items = items[0], .points = points, .capacity = 64},
                         other = {.items = items[1], .capacity = 64};
    ovoid_limit limit = ovoid_body_manifolds_find(pair, &options, &found);
    fuzz_require(limit == OVOID_LIMIT_NONE || limit == OVOID_LIMIT_SHAPE_B || limit == OVOID_LIMIT_POSE_A ||
                 limit == OVOID_LIMIT_POSE_B);
    (void)ovoid_body_manifolds_find(&exchanged, &options, &other);
    fuzz_require(found.count == other.count);
    for (size_t i = 0; i < found.count && found.count <= 64; i++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        const ovoid_manifold *m = &items[0][i].manifold;
        fuzz_require(m->count >= 1 && m->count <= 4 && points[i].count == m->count);
        fuzz_require(m->lower <= m->upper && m->lower <= options.margin);
        fuzz_require_code(ovoid_body_manifold_verify(pair, &items[0][i], &options, &error), &error);
        fuzz_require(ovoid_body_manifold_compute_points(pair, &items[0][i]).count == m->count);
    }
    for (size_t i = 0; i < other.count && other.count <= 64; i++)
        fuzz_require(ovoid_body_manifold_verify(&exchanged, &items[1][i], &options, NULL) == OVOID_OK);
}

// ---- motions

static ovoid_moving_body take_moving(fuzz_bytes *from, const ovoid_body *body, int is_wild) {
    ovoid_vec3 linear = take_vector(from, is_wild), angular = take_vector(from, is_wild);
    double duration = fabs(take_number(from, is_wild)) / 4;
    return (ovoid_moving_body){.shape = body->shape,
                               .compound = body->compound,
                               .motion = ovoid_motion_make_velocity(body->pose, linear, angular, duration),
                               .solid = body->solid};
}

// The largest coordinate on the way: poses are off by far less than a millionth of it.
static double find_size(const ovoid_moving_body *a, const ovoid_moving_body *b, double end) {
    double size = 0;
    ovoid_box box[2] = {ovoid_moving_body_compute_box(a, 0, end), ovoid_moving_body_compute_box(b, 0, end)};
    for (int i = 0; i < 2; i++) {
        const double side[6] = {box[i].min.x, box[i].min.y, box[i].min.z, box[i].max.x, box[i].max.y, box[i].max.z};
        for (int k = 0; k < 6; k++) size = fmax(size, fabs(side[k]));
    }
    return size;
}

static void ask_impact(fuzz_bytes *from, const ovoid_body_pair *pair, double margin, int is_wild) {
    static ovoid_step steps[STEPS];
    static ovoid_step_group groups[GROUPS];
    ovoid_moving_body a = take_moving(from, &pair->a, is_wild), b = take_moving(from, &pair->b, is_wild);
    const ovoid_motion_options options = {
        .iterations = 100, .steps = steps, .capacity = STEPS, .groups = groups, .group_capacity = GROUPS};
    ovoid_body_impact x = ovoid_body_impact_find(&(ovoid_moving_body_pair){a, b, margin}, &options);
    const ovoid_impact *is = &x.impact;
    ovoid_error error = {OVOID_OK, -1, ""};
    fuzz_require(!(is->free_until > is->hit_at));
    if (is->step_count > STEPS || x.group_count > GROUPS) return;
    fuzz_require_code(ovoid_body_impact_verify(&(ovoid_moving_body_pair){a, b, margin}, &x,
                                               &(ovoid_motion_basis){.steps = steps, .groups = groups}, &error),
                      &error);
    if (is_wild || is->limit >= OVOID_LIMIT_POSE_A) return;
    double slack = 1e-6 * find_size(&a, &b, is->end);
    for (int i = 0; i < 4; i++) {
        double time = is->begin + i / 4.0 * (is->free_until - is->begin);
        if (!(time < is->free_until)) return;
        ovoid_body_pair at = *pair;
        at.a.pose = ovoid_motion_compute_pose(&a.motion, time);
        at.b.pose = ovoid_motion_compute_pose(&b.motion, time);
        fuzz_require(ovoid_body_within(&at, margin, NULL, NULL).upper > margin - slack);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    int is_wild = take_byte(&from) > 96;
    ovoid_solid *a = take_solid(&from), *b = NULL;
    ovoid_shape *shape = NULL;
    ovoid_compound *compound = NULL;
    unsigned kind = (unsigned)take_byte(&from) & 3;
    if (kind)
        shape = take_any_shape(&from, is_wild);
    else
        b = take_solid(&from);
    if (kind == 2 && shape) compound = take_compound(&from, shape, is_wild);
    if (a && (b || compound || (shape && kind != 2))) {
        ovoid_body_pair pair = {{.solid = a, .pose = take_any_pose(&from, is_wild)},
                                {.shape = compound ? NULL : shape,
                                 .compound = compound,
                                 .solid = b,
                                 .pose = take_any_pose(&from, is_wild)}};
        double margin = fabs(take_double(&from));
        if (!isfinite(margin)) margin = 0;
        ovoid_body_proof earlier = {(uint32_t)take_byte(&from) & 31, (uint32_t)take_byte(&from) & 31,
                                    fuzz_take_proof(&from)};
        findings f = {&pair, -INFINITY, INFINITY};
        ask(&f, margin, NULL, ITEMS);
        ask(&f, margin, &earlier, (size_t)(take_byte(&from) & 3));
        ask_manifolds(&pair, margin);
        ask_impact(&from, &pair, margin, is_wild);
    }
    ovoid_solid_destroy(a);
    ovoid_solid_destroy(b);
    ovoid_compound_destroy(compound);
    ovoid_shape_destroy(shape);
    return 0;
}
