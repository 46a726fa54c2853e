// The sweep over time: its query at one time, and the longest proven step.
#include "motion/impact_sweep.h"

#include "base/compiler.h"
#include "query/answer.h"

// The times that both motions have, or those of the options. 0 where these do not lie in the motions' times.
static int set_times(sweep *s, const ovoid_motion_options *o) {
    double first = max2(motion_get_begin(&s->shapes.a->motion), motion_get_begin(&s->shapes.b->motion));
    double last = min2(motion_get_end(&s->shapes.a->motion), motion_get_end(&s->shapes.b->motion));
    if (o->begin == 0 && o->end == 0) {
        s->begin = first > -INFINITY ? first : 0;
        s->end = last < INFINITY ? last : 0;
    } else {
        s->begin = o->begin;
        s->end = o->end;
    }
    s->time = s->begin;
    return s->begin >= first && s->end <= last && s->begin <= s->end && isfinite(s->begin) && isfinite(s->end);
}

// A path without times has neither begin nor end.
static int has_times(const ovoid_motion *m) {
    return m->kind != OVOID_MOTION_PATH || (m->times && m->poses && m->count >= 2);
}

// What a shape's allowance adds to the bracket of a distance: nothing if the true body is known.
static double find_width(const ovoid_shape *s) { return shape_is_round(s) ? 0 : shape_get_width(s); }

ovoid_limit sweep_make(sweep *s, moving_shapes shapes, const ovoid_motion_options *options, double tolerance) {
    static const ovoid_motion_options none = {0};
    const ovoid_motion_options *o = options ? options : &none;
    const ovoid_motion *a = &shapes.a->motion, *b = &shapes.b->motion;
    *s = (sweep){.shapes = shapes, .query = o->query, .least = INFINITY, .steps = o->steps, .capacity = o->capacity};
    s->tolerance = o->tolerance != 0 ? o->tolerance : tolerance;
    s->most = o->iterations ? o->iterations : 10000;
    if (!o->steps) s->capacity = 0;
    if (!shapes.a->shape) return OVOID_LIMIT_SHAPE_A;
    if (!shapes.b->shape) return OVOID_LIMIT_SHAPE_B;
    s->allowance = find_width(shapes.a->shape) + find_width(shapes.b->shape);
    if (!has_times(a)) return OVOID_LIMIT_POSE_A;
    if (!has_times(b)) return OVOID_LIMIT_POSE_B;
    if (!(s->tolerance >= 0 && s->tolerance < INFINITY) || isnan(o->begin) || isnan(o->end)) return OVOID_LIMIT_OPTIONS;
    int ok = set_times(s, o);
    // Invalid motions are reported before invalid times, since a bad motion has no times. Of a path only the pieces
    // within the queried times are checked.
    int all = o->begin == 0 && o->end == 0;
    double from = all ? -INFINITY : s->begin, to = all ? INFINITY : s->end;
    if (motion_validate(a, from, to, NULL) != OVOID_OK) return OVOID_LIMIT_POSE_A;
    if (motion_validate(b, from, to, NULL) != OVOID_OK) return OVOID_LIMIT_POSE_B;
    return ok ? motion_pair_make(shapes.a, shapes.b, s->time, &s->pieces) : OVOID_LIMIT_OPTIONS;
}

double sweep_find_size(const sweep *s) {
    ovoid_pair at;
    pair_frame f;
    (void)motion_pair_find_pair(&s->pieces, s->begin, &at);
    return frame_place(&at, &f) == OVOID_LIMIT_NONE ? f.size : 0;
}

// The pieces at a time: those at hand, or others.
static const motion_pair *find_pieces(const sweep *s, double time, motion_pair *other) {
    if (time >= s->pieces.begin && time <= s->pieces.end) return &s->pieces;
    // The pose of a part is valid here: that of the first pieces was.
    (void)motion_pair_make(s->shapes.a, s->shapes.b, time, other);
    return other;
}

// These run before and after the query, which needs the stack: they are not inlined.
COMPILER_NOINLINE static double find_pair(const sweep *s, double time, ovoid_pair *pair) {
    motion_pair other;
    return motion_pair_find_pair(find_pieces(s, time, &other), time, pair);
}
COMPILER_NOINLINE static void find_fall(sweep *s, double time) {
    motion_pair other;
    motion_gap gap;
    motion_gap_find(find_pieces(s, time, &other), time, vec3_unit(s->answer.normal), &gap);
    s->fall = gap.speed[0][0] + gap.speed[1][0];
    s->error = gap.error;
}

void sweep_query(sweep *s, double time) {
    ovoid_pair pair;
    ovoid_proof earlier = s->answer.proof;
    s->shift = find_pair(s, time, &pair);
    const query_goal goal = query_goal_make_distance(s->query);
    answer_find_internal(
        &pair, &(query_request){.options = s->query, .goal = &goal, .earlier = s->used ? &earlier : NULL}, &s->answer);
    find_fall(s, time);
    s->queried_at = time;
    s->used++;
}

static void take_step(sweep *s, ovoid_step step, double least) {
    if (s->count < s->capacity) s->steps[s->count] = step;
    s->count++;
    s->time = step.until;
    s->least = min2(s->least, least);
    if (s->time >= s->pieces.end && s->time < s->end)
        (void)motion_pair_make(s->shapes.a, s->shapes.b, s->time, &s->pieces);
}

int motion_pair_is_above(const motion_pair *pieces, const ovoid_step *step, double from, double level, double *least) {
    motion_gap begin, end;
    motion_gap_find(pieces, from, step->normal, &begin);
    motion_gap_find_end(pieces, &begin, step->frame, step->until, &end);
    *least = motion_gap_compute_lower(pieces, step->frame, &begin, &end);
    return *least > level;
}

int sweep_step_to(sweep *s, double until, vec3 n, double level) {
    ovoid_step step = {until, n, OVOID_STEP_WORLD};
    double least;
    if (!(until > s->time && until <= s->pieces.end)) return 0;
    if (!motion_pair_is_above(&s->pieces, &step, s->time, level, &least)) return 0;
    take_step(s, step, least);
    return 1;
}

// Of the three frames, the one that promises the longest step is tried. A step that is not proven is shortened for the
// next trial: by a secant where the gap at its end is below the level, else, and from the second failure on, as the
// curvature demands.
int sweep_step(sweep *s, vec3 n, double level) {
    enum { FRAMES = 3, TRIALS = 16 };
    motion_gap from, to;
    motion_gap_find(&s->pieces, s->time, n, &from);
    double room = motion_gap_get_lower(&from) - level, last = min2(s->pieces.end, s->end), reach[FRAMES];
    int failed[FRAMES] = {0, 0, 0};
    if (!(room > 0)) return 0;
    for (int f = 0; f < FRAMES; f++)
        reach[f] = min2(motion_gap_guess_reach(&s->pieces, (ovoid_step_frame)f, &from, level), last);
    for (int trial = 0; trial < TRIALS; trial++) {
        int f = reach[1] > reach[0] ? 1 : 0;
        if (reach[2] > reach[f]) f = 2;
        ovoid_step step = {reach[f], n, (ovoid_step_frame)f};
        if (!(step.until > s->time)) return 0;
        motion_gap_find_end(&s->pieces, &from, step.frame, step.until, &to);
        double least = motion_gap_compute_lower(&s->pieces, step.frame, &from, &to);
        if (least > level) {
            take_step(s, step, least);
            return 1;
        }
        double left = motion_gap_get_lower(&to) - level, share = left < 0 ? 0.999 * room / (room - left) : 0.7;
        if (failed[f]++) share = min2(share, 0.5);
        reach[f] = s->time + (step.until - s->time) * share;
    }
    return 0;
}
