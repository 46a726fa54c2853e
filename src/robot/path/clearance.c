// The smallest clearance of a path: branch and bound (A. H. Land, A. G. Doig, An automatic method of solving discrete
// programming problems, 1960) over pairs and intervals. The nearest pair at a state that was looked at is an upper
// bound of the least distance; a pair that is proven to stay farther apart than that less the tolerance over an
// interval, by the bounds of motion.c, cannot be much nearer there, and is not looked at again in it. The signed
// distance is the greatest gap along any direction and changes by no more than the bodies move, so overlaps are no
// exception.
#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "base/watch.h"
#include "robot/path/motion.h"

#include <string.h>

enum { LEVELS = 31, SEEDS = 4 }; // ends and middle of an interval are exact numbers

typedef struct clearance_search {
    path_work w;
    ovoid_robot_checker *checker;
    const ovoid_robot_query_options *options;
    ovoid_robot_clearance *out; ///< upper: the least that was found; lower: of what is not proven to be above that
    const double *q0, *q1;
    double segment, tolerance;
    uint32_t states_most, groups;
    const ovoid_watch *watch;
    size_t mask_count, state_size;
    uint8_t *masks; // of each level: the pairs that are open
    char *states;   // the middle's of each level, then those of the segment's ends
} clearance_search;

static void keep_least(clearance_search *s, double least) {
    if (least < s->out->lower) s->out->lower = least;
}

// What a pair must be proven farther apart than.
static double get_margin(const clearance_search *s) { return s->out->upper - s->tolerance; }

// ---- one pair in an interval

static ovoid_answer measure(clearance_search *s, const path_pair *p, uint32_t number, double cap) {
    ovoid_robot_checker *checker = s->checker;
    pair_parts of = pair_take_apart(s->w.cell, number);
    int is_part = of.part != OVOID_ROBOT_NONE;
    ovoid_proof *proof = is_part ? &checker->part_proofs[number] : &checker->pair_proofs[of.pair];
    uint32_t *mark = is_part ? &checker->part_marks[number] : &checker->pair_marks[of.pair];
    const checker_pair known = {.pair = p->pair, .a = p->a, .b = p->b, .proof = proof, .mark = mark};
    // A cap of 0 is none: a body that is nearer than that is measured in full.
    const ovoid_options capped = {.cap = cap > 0 && cap < INFINITY ? cap : 0};
    ovoid_answer answer = ovoid_distance(&p->pair, &capped, pair_get_earlier(checker, &known));
    if (answer.status == OVOID_OVERLAPPING) answer = ovoid_depth(&p->pair, NULL, &answer.proof, NULL);
    pair_remember(checker, &known, &answer.proof);
    return answer;
}

// The nearest so far.
static void take(clearance_search *s, const path_pair *p, double upper, double at) {
    ovoid_robot_clearance *out = s->out;
    if (!(upper < out->upper)) return;
    out->upper = upper;
    out->at = s->segment + at;
    out->a = *p->a;
    out->b = *p->b;
}

static int is_above_by_ends(const clearance_search *s, const path_span *span, uint32_t number, const path_pair *p,
                            vec3 normal) {
    path_pair at_begin = path_make_pair(&s->w, number, span->at_begin->frames),
              at_end = path_make_pair(&s->w, number, span->at_end->frames);
    double begin = path_measure(&s->w, &at_begin, span->at_begin->frames, normal) - p->motion.rounded;
    double end = path_measure(&s->w, &at_end, span->at_end->frames, normal) - p->motion.rounded;
    return path_is_free_between(begin, end, get_margin(s), p->motion.curved, span->end - span->begin);
}

// What the pair is not nearer than in the interval, by what it is not nearer than in the middle.
static double find_least(const checker_pair *outward, const path_pair *p, double in_middle) {
    double lower = lower_outward(outward, in_middle) - p->motion.moved;
    return lower - 0x1p-50 * (fabs(lower) + p->motion.moved);
}

// 1 where the pair moves by so little in the interval that its halves can add less than the tolerance: of a body whose
// allowance is wider than that, and of solids, a bracket may never be as narrow.
static int is_narrow(clearance_search *s, const path_pair *p, double least) {
    if (p->motion.moved > 0.5 * s->tolerance) return 0;
    keep_least(s, least);
    return 1;
}

// The hulls, then the solids themselves. Of an overlap no more is known than the bracket in the middle: the depth of
// solids may jump.
static int test_solids(clearance_search *s, const path_span *span, uint32_t number, const path_pair *p,
                       const ovoid_answer *of_hulls, double *least) {
    double margin = get_margin(s);
    if (*least > margin) return 1;
    if (is_above_by_ends(s, span, number, p, path_turn_back(p, span->middle->frames, of_hulls->normal))) return 1;
    checker_pair outward = {.pair = p->pair, .error = p->error + p->motion.rounded, .padding = p->padding};
    double clear = add_up(p->padding, outward.error, p->motion.moved), cap = add_up(margin, clear, 0);
    const ovoid_options capped = {.cap = cap > 0 && cap < INFINITY ? cap : 0};
    ovoid_answer answer = solid_pair_distance(&p->pair, &p->solids, &capped, of_hulls, clear);
    take(s, p, upper_outward(&outward, answer.upper), 0.5 * (span->begin + span->end));
    *least = find_least(&outward, p, answer.lower);
    if (answer.status == OVOID_OVERLAPPING) {
        keep_least(s, *least);
        return 1;
    }
    return *least > get_margin(s) || is_narrow(s, p, *least);
}

// 1: the pair need not be looked at again in the interval. *least: what it is not nearer than.
static int test_pair(clearance_search *s, const path_span *span, uint32_t number, double *least) {
    vec3 normal;
    if (path_test_boxes(&s->w, number, span, get_margin(s), &normal) != PATH_BOXES_OPEN) return 1;
    path_pair p = path_make_pair(&s->w, number, span->middle->frames);
    checker_pair outward = {.pair = p.pair, .error = p.error + p.motion.rounded, .padding = p.padding};
    double cap = add_up(add_up(get_margin(s), p.padding, outward.error), p.motion.moved, 0);
    ovoid_answer answer = measure(s, &p, number, cap);
    *least = find_least(&outward, &p, answer.lower);
    if (sides_have_solid(&p.solids)) return test_solids(s, span, number, &p, &answer, least);
    take(s, &p, upper_outward(&outward, answer.upper), 0.5 * (span->begin + span->end));
    if (*least > get_margin(s)) return 1;
    return is_above_by_ends(s, span, number, &p, path_turn_back(&p, span->middle->frames, answer.normal)) ||
           is_narrow(s, &p, *least);
}

// ---- all pairs in an interval

// Tests the pairs of one mask; *least falls to what those that stay open are not nearer than.
static void test_mask(clearance_search *s, const path_span *span, uint8_t *mask, uint32_t first, double *least) {
    for (unsigned rest = *mask; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        double own;
        if (test_pair(s, span, first + k, &own))
            *mask &= (uint8_t) ~(1u << k);
        else if (own < *least)
            *least = own;
    }
}

static unsigned find_far_pairs(const clearance_search *s, uint32_t first, unsigned mask) {
    unsigned far = 0;
    for (unsigned rest = mask; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        far |= (unsigned)path_is_far_pair(&s->w, first + k, get_margin(s)) << k;
    }
    return far;
}

// What pairs that stay open are not nearer than; infinite: none does.
static double test_all(clearance_search *s, const path_span *span, uint8_t *masks) {
    const ovoid_robot_cell *c = s->w.cell;
    double least = INFINITY;
    uint32_t parts = (uint32_t)(c->items.count * c->parts.count), of_parts = (uint32_t)c->items.count * s->groups;
    for (uint32_t k = 0; k < s->mask_count; k++) {
        if (!masks[k]) continue;
        uint32_t first = k < of_parts ? k / s->groups * (uint32_t)c->parts.count + k % s->groups * ROBOT8
                                      : parts + ROBOT8 * (k - of_parts);
        unsigned far = k < of_parts ? path_find_far_parts(&s->w, k / s->groups, k % s->groups, get_margin(s))
                                    : find_far_pairs(s, first - parts, masks[k]);
        masks[k] &= (uint8_t)~far;
        test_mask(s, span, &masks[k], first, &least);
    }
    return least;
}

// ---- intervals

static path_state get_state(const clearance_search *s, uint32_t level) {
    return path_place_state(s->w.cell, s->states + level * s->state_size);
}
static uint8_t *get_masks(const clearance_search *s, uint32_t level) { return s->masks + level * s->mask_count; }

// 1 where no more states may be looked at.
static int is_used_up(clearance_search *s) {
    if (s->out->states < s->states_most && watch_is_stopped(s->watch)) s->states_most = 0;
    return s->out->states >= s->states_most;
}

// An interval of `span`, whose middle is not looked at yet; known: what no pair is nearer than in it.
static void visit(clearance_search *s, uint32_t level, const path_span *span, double known) {
    double begin = span->begin, end = span->end, middle = 0.5 * (begin + end);
    if (is_used_up(s)) {
        keep_least(s, known);
        return;
    }
    s->out->states++;
    path_state state = get_state(s, level);
    path_compute_state(&s->w, s->q0, s->q1, middle, &state);
    path_set_interval(&s->w, &state, 0.5 * (end - begin));
    const path_span interval = {begin, end, span->at_begin, span->at_end, &state};
    uint8_t *masks = get_masks(s, level);
    double least = test_all(s, &interval, masks);
    if (!(least < INFINITY)) return;
    if (path_is_still(&s->w) || level + 1 == LEVELS) {
        keep_least(s, least);
        return;
    }
    const path_span halves[2] = {{begin, middle, span->at_begin, &state, NULL},
                                 {middle, end, &state, span->at_end, NULL}};
    for (int k = 0; k < 2; k++) {
        memcpy(get_masks(s, level + 1), masks, s->mask_count);
        visit(s, level + 1, &halves[k], max2(known, least));
    }
}

// ---- a path

static void open_all(const clearance_search *s, uint8_t *masks) {
    const ovoid_robot_cell *c = s->w.cell;
    memset(masks, 0, s->mask_count);
    for (uint32_t item = 0; !s->options->without_obstacles && item < c->items.count; item++)
        for (uint32_t part = 0; part < c->parts.count; part++)
            masks[item * s->groups + part / ROBOT8] |= (uint8_t)(path_is_queried(&s->w, item, part) << part % ROBOT8);
    for (uint32_t k = 0; !s->options->without_self && k < c->pairs.count; k++)
        masks[c->items.count * s->groups + k / ROBOT8] |= (uint8_t)(1u << k % ROBOT8);
}

// 0: the segment is refused.
static int set_segment(clearance_search *s, const ovoid_robot_path *path, size_t index) {
    ovoid_error refused;
    size_t count = s->w.cell->robot->variable_count;
    s->q0 = path->states + index * count;
    s->q1 = index + 1 < path->count ? s->q0 + count : s->q0;
    s->segment = (double)index;
    ovoid_code code = path_set_segment(&s->w, s->q0, s->q1, s->options->limit_slack, &refused);
    if (code == OVOID_OK) return 1;
    *s->out = (ovoid_robot_clearance){.status = OVOID_ROBOT_REFUSED,
                                      .lower = -INFINITY,
                                      .upper = INFINITY,
                                      .refused = index,
                                      .code = code,
                                      .variable = (uint32_t)refused.place,
                                      .states = s->out->states};
    return 0;
}

// Some states of the segment alone, so that the search begins with an upper bound.
static void look_at_some(clearance_search *s) {
    path_state state = get_state(s, 0);
    int count = path_is_still(&s->w) ? 1 : SEEDS + 1;
    for (int k = 0; k < count && !is_used_up(s); k++) {
        double t = (double)k / SEEDS;
        s->out->states++;
        path_compute_state(&s->w, s->q0, s->q1, t, &state);
        path_set_interval(&s->w, &state, 0);
        const path_span span = {t, t, &state, &state, &state};
        open_all(s, get_masks(s, 0));
        (void)test_all(s, &span, get_masks(s, 0));
    }
}

static void run_segment(clearance_search *s) {
    path_state begin = get_state(s, LEVELS), end = get_state(s, LEVELS + 1);
    path_compute_state(&s->w, s->q0, s->q1, 0, &begin);
    path_compute_state(&s->w, s->q0, s->q1, 1, &end);
    open_all(s, get_masks(s, 0));
    visit(s, 0, &(const path_span){0, 1, &begin, &end, NULL}, -INFINITY);
}

static void run(clearance_search *s, const ovoid_robot_path *path) {
    ovoid_robot_clearance *out = s->out;
    size_t segments = path->count > 1 ? path->count - 1 : 1;
    for (size_t i = 0; i < segments; i++) {
        if (!set_segment(s, path, i)) return;
        look_at_some(s);
    }
    for (size_t i = 0; i < segments; i++) {
        if (segments > 1 && !set_segment(s, path, i)) return;
        // Stopped: nothing is known of it.
        if (s->states_most == 0)
            keep_least(s, -INFINITY);
        else
            run_segment(s);
    }
    // What was dismissed is above the least that was found then, less the tolerance, by comparisons that round.
    if (out->upper < INFINITY) {
        double above = get_margin(s);
        keep_least(s, above - 0x1p-45 * (fabs(above) + s->tolerance));
        out->lower = out->lower < out->upper ? out->lower : out->upper;
    }
    out->status = out->lower > s->options->margin    ? OVOID_ROBOT_FREE
                  : out->upper <= s->options->margin ? OVOID_ROBOT_HIT
                                                     : OVOID_ROBOT_UNDECIDED;
    if (cell_has_pairs(s->checker->cell, s->options)) return;
    out->status = OVOID_ROBOT_UNDECIDED;
    out->code = OVOID_ERROR_EMPTY;
}

static double find_tolerance(const ovoid_robot_cell *c, double given) {
    double reach = 0;
    for (size_t i = 0; i < c->items.count; i++) reach = max2(reach, cell_items(c)[i].reach);
    return given > 0 ? given : 0x1p-10 * reach;
}

static ovoid_code allocate(clearance_search *s, ovoid_error *error) {
    const ovoid_robot_cell *c = s->w.cell;
    s->groups = (uint32_t)c->boxes.count;
    s->mask_count = c->items.count * s->groups + (c->pairs.count + ROBOT8 - 1) / ROBOT8;
    s->state_size = path_get_state_size(c);
    s->masks = allocator_allocate(&s->w.allocator, s->mask_count * (LEVELS + 1) + 1, 1);
    s->states = allocator_allocate(&s->w.allocator, LEVELS + 2, s->state_size);
    if (!s->masks || !s->states) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a path");
    return OVOID_OK;
}

static ovoid_code validate_options(const ovoid_robot_path *path, const ovoid_robot_path_options *o,
                                   ovoid_error *error) {
    ovoid_code code = query_options_validate(&o->query, error);
    if (code != OVOID_OK) return code;
    if (!(o->tolerance >= 0 && o->tolerance < INFINITY))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the tolerance of a clearance is a length of at least 0");
    if (!path->states || path->count < 1 || path->count > OVOID_ROBOT_PATH_STATES_MAX)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a path has 1 to 2^20 states, not %zu", path->count);
    return OVOID_OK;
}

static ovoid_code compute(ovoid_robot_checker *checker, const ovoid_robot_path_query *query, ovoid_robot_clearance *out,
                          ovoid_error *error) {
    static const ovoid_robot_path_options none;
    const ovoid_robot_path *path = query->path;
    const ovoid_robot_path_options *o = query->options ? query->options : &none;
    *out = (ovoid_robot_clearance){.lower = -INFINITY, .upper = INFINITY};
    ovoid_code code = validate_options(path, o, error);
    if (code == OVOID_OK) code = checker_renew(checker, error);
    if (code != OVOID_OK) return code;
    clearance_search s = {.checker = checker,
                          .options = &o->query,
                          .out = out,
                          .tolerance = find_tolerance(checker->cell, o->tolerance),
                          .states_most = o->states ? o->states : 100000 + 100 * (uint32_t)path->count,
                          .watch = &o->watch};
    code = path_work_create(&s.w, checker->cell, &checker->allocator, error);
    if (code != OVOID_OK) return code;
    code = allocate(&s, error);
    if (code == OVOID_OK) {
        out->lower = INFINITY;
        run(&s, path);
    }
    allocator_release(&checker->allocator, s.masks);
    allocator_release(&checker->allocator, s.states);
    path_work_destroy(&s.w);
    return code;
}

ovoid_code ovoid_robot_path_compute_clearance(ovoid_robot_checker *checker, const ovoid_robot_path_query *query,
                                              ovoid_robot_clearance *clearance, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checker, compute(checker, query, clearance, error));
}
