// Liars for ovoid_impact_verify and ovoid_approach_verify. Right records of random motions are altered one field at a
// time (alter.h), their steps too, and others are forged from true answers: free for no time, hit before the beginning,
// free by steps over the knots of a path, refused without a reason.
//
// Truth, by other means than the check's: distances at sampled times, and for each step the gap along its normal at
// sampled times, from vertices at computed poses. What these show to be false must be refused; what they do not show to
// be false may pass. Slack: the rounding of poses, 1e-12 of the size and 1e-15 of the angle turned (docs/motion.md).
#include "alter.h"
#include "moving.h"
#include "options.h"

enum { CAPACITY = 20000, SAMPLES = 60, STEP_SAMPLES = 12, CASES = 60 };
static ovoid_step steps[CAPACITY];

typedef struct truth {
    moving_case c;
    double margin, slack;
    double begin, end;
    double times[SAMPLES + 4], lower[SAMPLES + 4], upper[SAMPLES + 4]; ///< distances at times of [begin, end]
    int count;
    double first, last; ///< the times that both motions have
    ovoid_motion_options options;
    const ovoid_motion_options *told; ///< what the check is told of the options, or NULL
} truth;

static ovoid_answer ask(const truth *t, double time) {
    ovoid_pair pair = moving_get_pair(&t->c.a, &t->c.b, time);
    return ovoid_distance(&pair, NULL, NULL);
}

static void add_time(truth *t, double time) {
    if (!(time >= t->begin && time <= t->end)) return;
    ovoid_answer x = ask(t, time);
    t->times[t->count] = time;
    t->lower[t->count] = x.lower - t->slack;
    t->upper[t->count++] = x.upper + t->slack;
}

static void make_truth(truth *t, uint64_t *s, double hit_at) {
    t->count = 0;
    add_time(t, t->begin);
    add_time(t, t->end);
    add_time(t, hit_at);
    for (int i = 0; i < SAMPLES; i++) add_time(t, t->begin + (t->end - t->begin) * random_uniform(s, 0, 1));
}

// ---- steps

static ovoid_vec3 turn(const ovoid_moving_shape *m, double from, double to, ovoid_vec3 n) {
    ovoid_pose at = ovoid_moving_shape_compute_pose(m, from), then = ovoid_moving_shape_compute_pose(m, to);
    at.position = then.position = (ovoid_vec3){0, 0, 0};
    return ovoid_pose_compute_point(&then, ovoid_pose_compute_local_point(&at, n));
}

static double find_support(const ovoid_moving_shape *m, double time, ovoid_vec3 n) {
    ovoid_pose pose = ovoid_moving_shape_compute_pose(m, time);
    ovoid_polytope p = ovoid_shape_get_polytope(m->shape);
    double most = -INFINITY;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        ovoid_vec3 x =
            ovoid_pose_compute_point(&pose, (ovoid_vec3){p.origin.x + v[0], p.origin.y + v[1], p.origin.z + v[2]});
        most = fmax(most, n.x * x.x + n.y * x.y + n.z * x.z);
    }
    return most + ovoid_shape_get_radius(m->shape);
}

static double measure_step(const truth *t, const ovoid_step *step, double from, double time) {
    const ovoid_moving_shape *a = &t->c.a, *b = &t->c.b;
    ovoid_vec3 n = step->normal;
    if (step->frame != OVOID_STEP_WORLD) n = turn(step->frame == OVOID_STEP_A ? a : b, from, time, n);
    return -find_support(b, time, moving_scaled(n, -1)) - find_support(a, time, n);
}

// 1 if a step is no step, or the gap along its normal is not above the level at a sampled time. One that ends where it
// begins says something of that time.
static int step_is_false(const truth *t, const ovoid_step *step, double from, double level) {
    ovoid_vec3 n = step->normal;
    double norm = n.x * n.x + n.y * n.y + n.z * n.z;
    // Bodies that are still are where they are at all times.
    int is_still = t->c.a.motion.kind == OVOID_MOTION_STILL && t->c.b.motion.kind == OVOID_MOTION_STILL;
    if (!(step->until >= from) || !(is_still || step->until <= t->last) || (int)step->frame > 2) return 1;
    if (!(fabs(norm - 1) <= 1e-12)) return 1;
    for (int i = 0; i <= STEP_SAMPLES; i++) {
        double time = from + (step->until - from) * i / STEP_SAMPLES;
        if (measure_step(t, step, from, time) + t->slack <= level) return 1;
    }
    return 0;
}

static int steps_are_false(const truth *t, const ovoid_step *list, size_t count, double begin, double end,
                           double level) {
    double time = begin;
    for (size_t i = 0; i < count; i++) {
        if (step_is_false(t, &list[i], time, level)) return 1;
        time = list[i].until;
    }
    return !(time >= end);
}

// ---- what records claim

static int answer_is_false(const truth *t, const ovoid_answer *x, double time) {
    ovoid_answer own = ask(t, time);
    if (isnan(x->lower) || isnan(x->upper)) return 1;
    if (x->lower > own.upper + t->slack || x->upper < own.lower - t->slack) return 1;
    if (x->status == OVOID_SEPARATED) return !(x->lower > 0);
    return x->status == OVOID_OVERLAPPING ? !(x->upper < 0) : (unsigned)x->status > OVOID_OVERLAPPING;
}

static int refusal_is_false(const ovoid_impact *x) {
    return x->limit != OVOID_LIMIT_OPTIONS || x->hit_at != INFINITY || x->step_count;
}

static int impact_is_false(const truth *t, const ovoid_impact *x, const ovoid_step *list) {
    int hit = x->status == OVOID_IMPACT_HIT, is_free = x->status == OVOID_IMPACT_FREE;
    if (x->limit >= OVOID_LIMIT_POSE_A && x->limit <= OVOID_LIMIT_SHAPE_B) return refusal_is_false(x);
    if ((unsigned)x->status > OVOID_IMPACT_HIT || (unsigned)x->limit > OVOID_LIMIT_ALLOWANCE) return 1;
    if (!(x->begin >= t->first && x->end <= t->last && x->begin <= x->end)) return 1;
    if (!(x->free_until >= x->begin && x->free_until <= x->end)) return 1;
    if (hit ? !(x->hit_at >= x->free_until && x->hit_at <= x->end) : x->hit_at != INFINITY) return 1;
    if (is_free && x->free_until != x->end) return 1;
    // The times that are claimed to be free; of a status free the last one, too.
    for (int i = 0; i < t->count; i++)
        if (t->times[i] >= x->begin && (t->times[i] < x->free_until || (is_free && t->times[i] <= x->end)))
            if (t->upper[i] <= t->margin) return 1;
    if (is_free && ask(t, x->end).upper + t->slack <= t->margin) return 1;
    if (hit && ask(t, x->hit_at).lower - t->slack > t->margin) return 1;
    if (answer_is_false(t, &x->free, x->free_until) || (hit && answer_is_false(t, &x->hit, x->hit_at))) return 1;
    return steps_are_false(t, list, x->step_count, x->begin, x->free_until, t->margin);
}

static int approach_is_false(const truth *t, const ovoid_approach *x, const ovoid_approach *right,
                             const ovoid_step *list) {
    if (x->limit >= OVOID_LIMIT_POSE_A && x->limit <= OVOID_LIMIT_SHAPE_B)
        return x->limit != OVOID_LIMIT_OPTIONS || x->status != OVOID_UNDECIDED;
    if ((unsigned)x->status > OVOID_OVERLAPPING || (unsigned)x->limit > OVOID_LIMIT_ALLOWANCE) return 1;
    if (!(x->begin >= t->first && x->end <= t->last && x->begin <= x->end)) return 1;
    if (!(x->time >= x->begin && x->time <= x->end) || !(x->lower <= x->upper)) return 1;
    if (x->status == OVOID_SEPARATED && !(x->lower > 0)) return 1;
    if (x->status == OVOID_OVERLAPPING && !(x->upper < 0)) return 1;
    if (x->status <= OVOID_TOUCHING && x->status != OVOID_SEPARATED && !(x->lower <= 0 && x->upper >= 0)) return 1;
    if (x->status == OVOID_TOUCHING && x->upper - x->lower > 1e-4 * t->c.size) return 1; // the tolerance is 1e-6
    for (int i = 0; i < t->count; i++)
        if (t->times[i] >= x->begin && t->times[i] <= x->end && x->lower > t->upper[i]) return 1;
    int same_times = x->begin >= right->begin && x->end <= right->end;
    if (same_times && right->lower > -INFINITY && x->upper < right->lower - t->slack) return 1;
    if (x->upper < ask(t, x->time).lower - t->slack || answer_is_false(t, &x->answer, x->time)) return 1;
    if (x->lower == -INFINITY || x->begin == x->end) return 0;
    return steps_are_false(t, list, x->step_count, x->begin, x->end, nextafter(x->lower, -INFINITY));
}

// ---- lies

static void tell_impact(const truth *t, const ovoid_impact *x, alter_count *n) {
    ovoid_code code = ovoid_impact_verify(&(ovoid_moving_pair){t->c.a, t->c.b, t->margin}, x,
                                          &(ovoid_motion_basis){.options = t->told, .steps = steps}, NULL);
    alter_take(n, impact_is_false(t, x, steps), code != OVOID_OK);
}
static void tell_approach(const truth *t, const ovoid_approach *x, const ovoid_approach *right, alter_count *n) {
    ovoid_code code = ovoid_approach_verify(&(ovoid_moving_pair){t->c.a, t->c.b, 0}, x,
                                            &(ovoid_motion_basis){.options = t->told, .steps = steps}, NULL);
    alter_take(n, approach_is_false(t, x, right, steps), code != OVOID_OK);
}

enum { IMPACT_FIELDS = 13, APPROACH_FIELDS = 11, STEP_FIELDS = 5, FORGED = 11 };
static const alter_field impact_fields[IMPACT_FIELDS] = {
    ALTER_FIELD(ovoid_impact, status, ALTER_INT, 0),         ALTER_FIELD(ovoid_impact, limit, ALTER_INT, 0),
    ALTER_FIELD(ovoid_impact, begin, ALTER_REAL, 1e-9),      ALTER_FIELD(ovoid_impact, end, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_impact, free_until, ALTER_REAL, 1e-9), ALTER_FIELD(ovoid_impact, hit_at, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_impact, step_count, ALTER_SIZE, 0),    ALTER_FIELD(ovoid_impact, free.status, ALTER_INT, 0),
    ALTER_FIELD(ovoid_impact, free.lower, ALTER_REAL, 1e-9), ALTER_FIELD(ovoid_impact, free.upper, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_impact, hit.status, ALTER_INT, 0),     ALTER_FIELD(ovoid_impact, hit.lower, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_impact, hit.upper, ALTER_REAL, 1e-9),
};
static const alter_field approach_fields[APPROACH_FIELDS] = {
    ALTER_FIELD(ovoid_approach, status, ALTER_INT, 0),
    ALTER_FIELD(ovoid_approach, limit, ALTER_INT, 0),
    ALTER_FIELD(ovoid_approach, begin, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_approach, end, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_approach, lower, ALTER_REAL, 1e-6),
    ALTER_FIELD(ovoid_approach, upper, ALTER_REAL, 1e-6),
    ALTER_FIELD(ovoid_approach, time, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_approach, step_count, ALTER_SIZE, 0),
    ALTER_FIELD(ovoid_approach, answer.status, ALTER_INT, 0),
    ALTER_FIELD(ovoid_approach, answer.lower, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_approach, answer.upper, ALTER_REAL, 1e-9),
};
static const alter_field step_fields[STEP_FIELDS] = {
    ALTER_FIELD(ovoid_step, until, ALTER_REAL, 1e-9),    ALTER_FIELD(ovoid_step, normal.x, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_step, normal.y, ALTER_REAL, 1e-9), ALTER_FIELD(ovoid_step, normal.z, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_step, frame, ALTER_INT, 0),
};
static alter_count impact_counts[IMPACT_FIELDS], approach_counts[APPROACH_FIELDS], step_counts[STEP_FIELDS],
    forged_counts[FORGED];

static const alter_table impact_table = ALTER_TABLE(impact_fields, impact_counts),
                         approach_table = ALTER_TABLE(approach_fields, approach_counts),
                         step_table = ALTER_TABLE(step_fields, step_counts);

// The options of a record of the motion's other half, for "another's".
static ovoid_motion_options get_other(const truth *t) {
    return (ovoid_motion_options){.begin = t->first, .end = t->first + 0.5 * (t->last - t->first)};
}

static void lie_about_impact(const truth *t, const ovoid_impact *right) {
    const ovoid_motion_options half = get_other(t);
    ovoid_impact other = ovoid_impact_find(&(ovoid_moving_pair){t->c.a, t->c.b, t->margin}, &half), x = *right;
    alter_walk w = alter_walk_make(&impact_table, &x, sizeof x, &other);
    for (alter_count *n; (n = alter_next(&w));)
        if (x.step_count <= CAPACITY) tell_impact(t, &x, n);
}

static void lie_about_approach(const truth *t, const ovoid_approach *right) {
    const ovoid_motion_options half = get_other(t);
    ovoid_approach other = ovoid_approach_find(&(ovoid_moving_pair){t->c.a, t->c.b, 0}, &half), x = *right;
    alter_walk w = alter_walk_make(&approach_table, &x, sizeof x, &other);
    for (alter_count *n; (n = alter_next(&w));)
        if (x.step_count <= CAPACITY) tell_approach(t, &x, right, n);
}

// The first, the last and one step in between.
static void lie_about_steps(const truth *t, const ovoid_impact *right) {
    const size_t count = right->step_count, which[3] = {0, count / 2, count - 1};
    for (int k = 0; k < 3 && count; k++) {
        const ovoid_step other = steps[(which[k] + 1) % count];
        alter_walk w = alter_walk_make(&step_table, &steps[which[k]], sizeof *steps, &other);
        for (alter_count *n; (n = alter_next(&w));) tell_impact(t, right, n);
    }
}

// ---- forgeries

static ovoid_impact make_free(const truth *t, double begin, double end) {
    return (ovoid_impact){.status = OVOID_IMPACT_FREE,
                          .begin = begin,
                          .end = end,
                          .free_until = end,
                          .hit_at = INFINITY,
                          .free = ask(t, end)};
}

static void forge(const truth *t, const char *name, int which, const ovoid_impact *x) {
    alter_name = name;
    alter_way = "forged";
    tell_impact(t, x, &forged_counts[which]);
}

// Free at one time, where the bodies may be within the margin.
static void forge_moment(const truth *t, double time) {
    ovoid_impact x = make_free(t, time, time);
    forge(t, "free for no time", 0, &x);
}

// A hit that is proven at a time before those queried, or after them.
static void forge_hit(const truth *t, double hit_at) {
    ovoid_impact x = make_free(t, t->begin + 0.5 * (t->end - t->begin), t->end);
    x.free_until = x.begin;
    x.free = ask(t, x.begin);
    x.status = OVOID_IMPACT_HIT;
    x.hit_at = hit_at;
    x.hit = ask(t, hit_at);
    forge(t, "hit before the beginning", 1, &x);
    x.begin = t->begin;
    x.end = x.free_until = 0.5 * (t->begin + hit_at);
    x.begin = x.free_until;
    x.free = ask(t, x.free_until);
    forge(t, "hit after the end", 2, &x);
    x.status = OVOID_IMPACT_UNDECIDED;
    forge(t, "undecided, with a hit after the end", 2, &x);
}

// A hit at a time at which the bodies are farther apart; times that are free before the beginning, or after the end.
static void forge_times(const truth *t, const ovoid_impact *right) {
    ovoid_impact x = make_free(t, t->begin, t->end);
    x.free_until = x.begin;
    x.free = ask(t, x.begin);
    x.status = OVOID_IMPACT_HIT;
    for (int i = 0; i < t->count; i++) {
        x.hit_at = t->times[i];
        x.hit = ask(t, x.hit_at);
        forge(t, "a hit that is none", 8, &x);
    }
    x = (ovoid_impact){.begin = t->begin, .end = t->end, .hit_at = INFINITY};
    x.free_until = 0.5 * (t->first + t->begin);
    x.free = ask(t, x.free_until);
    if (t->begin > t->first) forge(t, "free before the beginning", 9, &x);
    x = *right;
    x.status = OVOID_IMPACT_UNDECIDED;
    x.hit_at = INFINITY;
    x.end = 0.5 * (t->begin + x.free_until);
    forge(t, "free after the end", 9, &x);
}

// Free by `count` steps of equal length, along the normals of the distances at their beginnings; knots are not looked
// at.
static void forge_steps(const truth *t, size_t count, ovoid_step_frame frame) {
    ovoid_impact x = make_free(t, t->begin, t->end);
    x.step_count = count;
    for (size_t i = 0; i < count; i++) {
        double from = t->begin + (t->end - t->begin) * (double)i / (double)count;
        double until = t->begin + (t->end - t->begin) * (double)(i + 1) / (double)count;
        steps[i] = (ovoid_step){i + 1 < count ? until : t->end, ask(t, from).normal, frame};
    }
    forge(t, "free by coarse steps", 3, &x);
    x.status = OVOID_IMPACT_UNDECIDED;
    forge(t, "undecided by coarse steps", 3, &x);
}

// Of a motion that is refused only that reason is right; what it says beside it is not.
static void forge_reasons(const truth *t) {
    truth broken = *t;
    broken.c.b.motion =
        ovoid_motion_make_velocity(t->c.b.motion.start, (ovoid_vec3){NAN, 0, 0}, (ovoid_vec3){0, 0, 0}, 1);
    const ovoid_moving_shape *a = &broken.c.a, *b = &broken.c.b;
    ovoid_impact right = ovoid_impact_find(&(ovoid_moving_pair){*a, *b, t->margin}, &t->options), x;
    ovoid_approach nearest = ovoid_approach_find(&(ovoid_moving_pair){*a, *b, 0}, &t->options), y;
    CHECK_EQ(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, t->margin}, &right,
                                 &(ovoid_motion_basis){.options = t->told}, NULL),
             OVOID_OK);
    CHECK_EQ(ovoid_approach_verify(&(ovoid_moving_pair){*a, *b, 0}, &nearest, &(ovoid_motion_basis){.options = t->told},
                                   NULL),
             OVOID_OK);
    for (int limit = 0; limit <= OVOID_LIMIT_ALLOWANCE; limit++) {
        if (limit == OVOID_LIMIT_POSE_B) continue;
        x = right;
        y = nearest;
        x.limit = y.limit = (ovoid_limit)limit;
        CHECK(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, t->margin}, &x,
                                  &(ovoid_motion_basis){.options = t->told}, NULL) != OVOID_OK);
        CHECK(ovoid_approach_verify(&(ovoid_moving_pair){*a, *b, 0}, &y, &(ovoid_motion_basis){.options = t->told},
                                    NULL) != OVOID_OK);
    }
    x = right;
    x.free_until = 0.5;
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, t->margin}, &x, &(ovoid_motion_basis){.options = t->told},
                              NULL) != OVOID_OK);
    x.free_until = 0;
    x.status = OVOID_IMPACT_FREE;
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, t->margin}, &x, &(ovoid_motion_basis){.options = t->told},
                              NULL) != OVOID_OK);
    x = right;
    x.free_until = -1;
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, t->margin}, &x, &(ovoid_motion_basis){.options = t->told},
                              NULL) != OVOID_OK);
    y = nearest;
    y.lower = 1;
    CHECK(ovoid_approach_verify(&(ovoid_moving_pair){*a, *b, 0}, &y, &(ovoid_motion_basis){.options = t->told}, NULL) !=
          OVOID_OK);
}

static void forge_refusals(const truth *t) {
    forge_reasons(t);
    for (int limit = OVOID_LIMIT_POSE_A; limit <= OVOID_LIMIT_SHAPE_B; limit++) {
        ovoid_impact x = {.limit = (ovoid_limit)limit, .hit_at = INFINITY};
        forge(t, "refused without a reason", 4, &x);
        x.hit_at = 0.5 * (t->begin + t->end);
        forge(t, "refused, with a hit", 5, &x);
        for (int status = OVOID_UNDECIDED; status <= OVOID_OVERLAPPING; status++) {
            ovoid_approach y = {
                .status = (ovoid_status)status, .limit = (ovoid_limit)limit, .lower = -INFINITY, .upper = INFINITY};
            alter_name = "approach refused";
            alter_way = "forged";
            tell_approach(t, &y, &y, &forged_counts[6]);
        }
    }
}

// A wide bracket around 0, as bodies that touch; one that is not around 0, as undecided.
static void forge_touching(const truth *t, const ovoid_approach *right) {
    ovoid_approach x = *right;
    alter_way = "forged";
    alter_name = "undecided of a decided bracket";
    x.status = OVOID_UNDECIDED;
    tell_approach(t, &x, right, &forged_counts[10]);
    alter_name = "a bracket farther away";
    x = *right;
    x.lower = x.upper = right->upper + t->c.size;
    x.status = x.lower > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING;
    tell_approach(t, &x, right, &forged_counts[10]);
    x = *right;
    alter_name = "touching within a wide bracket";
    x.status = OVOID_TOUCHING;
    x.lower = fmin(x.lower, -t->c.size);
    x.upper = fmax(x.upper, t->c.size);
    tell_approach(t, &x, right, &forged_counts[10]);
}

// The distance at a time outside of those queried, as the smallest.
static void forge_nearest(const truth *t, const ovoid_approach *right, double time) {
    ovoid_approach x = *right;
    x.time = time;
    x.answer = ask(t, time);
    x.upper = x.answer.upper + t->slack;
    x.lower = fmin(x.lower, x.upper);
    x.status = x.upper < 0 ? OVOID_OVERLAPPING : x.lower > 0 ? OVOID_SEPARATED : OVOID_UNDECIDED;
    alter_name = "nearest outside of the times";
    alter_way = "forged";
    tell_approach(t, &x, right, &forged_counts[7]);
}

// ---- cases

// Motions whose times differ, and queries of all times, of a part of them, of one time.
static void set_times(truth *t, uint64_t seed) {
    t->first = 0;
    t->last = 1;
    if (t->c.a.motion.kind == OVOID_MOTION_STILL && t->c.b.motion.kind == OVOID_MOTION_STILL) t->last = 0;
    double span = t->last - t->first;
    t->begin = t->first + span * (seed % 3 == 1 ? 0.4 : 0);
    t->end = seed % 7 == 1 ? t->begin : t->last - span * (seed % 3 == 1 ? 0.1 : 0);
    if (t->begin == 0 && t->end == 0) t->end = t->last;
    t->options = (ovoid_motion_options){.begin = t->begin, .end = t->end, .steps = steps, .capacity = CAPACITY};
    t->told = seed % 2 ? NULL : &t->options;
}

static void try_impact(truth *t, uint64_t *s) {
    ovoid_impact right = ovoid_impact_find(&(ovoid_moving_pair){t->c.a, t->c.b, t->margin}, &t->options);
    make_truth(t, s, right.hit_at);
    CHECK_LE(right.step_count, CAPACITY);
    CHECK_EQ(ovoid_impact_verify(&(ovoid_moving_pair){t->c.a, t->c.b, t->margin}, &right,
                                 &(ovoid_motion_basis){.options = t->told, .steps = steps}, NULL),
             OVOID_OK);
    CHECK(!impact_is_false(t, &right, steps));
    lie_about_impact(t, &right);
    lie_about_steps(t, &right);
    forge_times(t, &right);
    for (size_t count = 1; count <= 64 && t->begin < t->end; count *= 4)
        for (int frame = 0; frame < 3; frame++) forge_steps(t, count, (ovoid_step_frame)frame);
    for (int i = 0; i < t->count && i < 12; i++) forge_moment(t, t->times[i]);
    if (right.status == OVOID_IMPACT_HIT) forge_hit(t, right.hit_at);
    for (int i = 0; i < t->count; i++)
        if (t->upper[i] <= t->margin) forge_hit(t, t->times[i]);
    forge_refusals(t);
}

static void try_approach(truth *t) {
    ovoid_approach right = ovoid_approach_find(&(ovoid_moving_pair){t->c.a, t->c.b, 0}, &t->options);
    CHECK_EQ(ovoid_approach_verify(&(ovoid_moving_pair){t->c.a, t->c.b, 0}, &right,
                                   &(ovoid_motion_basis){.options = t->told, .steps = steps}, NULL),
             OVOID_OK);
    CHECK(!approach_is_false(t, &right, &right, steps));
    lie_about_approach(t, &right);
    forge_touching(t, &right);
    for (int i = 0; i <= 8; i++) forge_nearest(t, &right, t->first + (t->last - t->first) * i / 8);
}

int main(int count, char **arguments) {
    uint64_t first = 1, cases = CASES;
    const test_option options[] = {{"seed", "of the first case (1)", &first, NULL, NULL, NULL},
                                   {"cases", "how many", &cases, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    static truth t;
    for (uint64_t seed = first; seed < first + cases; seed++) {
        uint64_t s = check_seed = seed;
        moving_make(&t.c, seed);
        t.margin = seed % 4 == 0 ? 0.1 * t.c.size : 0;
        t.slack = (1e-12 + 1e-15 * t.c.spin) * 20 * t.c.size;
        set_times(&t, seed);
        try_impact(&t, &s);
        try_approach(&t);
        moving_destroy(&t.c);
    }
    check_seed = 0;
    alter_print_table(&impact_table);
    alter_print_table(&step_table);
    alter_print_table(&approach_table);
    const char *const names[FORGED] = {"free for no time",
                                       "hit before the beginning",
                                       "hit after the end",
                                       "coarse steps",
                                       "refused",
                                       "refused, with a hit",
                                       "approach refused",
                                       "nearest outside",
                                       "a hit that is none",
                                       "free outside",
                                       "touching"};
    for (int i = 0; i < FORGED; i++) alter_print(names[i], &forged_counts[i]);
    return check_end();
}
