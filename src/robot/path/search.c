// Is a path free? Intervals are halved, the earlier half first, until each pair of bodies is proven apart over each of
// them, or the first hit is between two times that are near each other. What an interval dismisses its halves do not
// look at again.
#include "robot/path/search.h"

#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "base/watch.h"

#include <string.h>

#define AHEAD 0x1p-5
// ---- steps

static void add_step(path_search *s, const path_span *span, uint32_t pair, ovoid_robot_step_kind kind, unsigned mask,
                     vec3 normal) {
    size_t at = s->answer->step_count++;
    if (!s->options->steps || at >= s->options->capacity) return;
    s->options->steps[at] = (ovoid_robot_step){s->segment + span->begin, s->segment + span->end, pair,
                                               (uint16_t)kind,           (uint16_t)mask,         normal};
}

// ---- one pair in an interval

static void take_answer(path_search *s, const path_pair *p, ovoid_robot_status status, double lower, double upper) {
    ovoid_robot_answer *a = &s->answer->hit;
    *a = (ovoid_robot_answer){.status = status, .a = *p->a, .b = *p->b, .lower = lower, .upper = upper};
}

static checker_pair get_checker_pair(const path_search *s, uint32_t number, const path_pair *p) {
    ovoid_robot_checker *checker = s->checker;
    pair_parts of = pair_take_apart(s->w->cell, number);
    int is_part = of.part != OVOID_ROBOT_NONE;
    ovoid_proof *proof = is_part ? &checker->part_proofs[number] : &checker->pair_proofs[of.pair];
    uint32_t *mark = is_part ? &checker->part_marks[number] : &checker->pair_marks[of.pair];
    // The normal stays in the world here: one that a check kept in a link's frame is a bad hint once, and no more.
    return (checker_pair){.pair = p->pair,
                          .solids = p->solids,
                          .a = p->a,
                          .b = p->b,
                          .proof = proof,
                          .mark = mark,
                          .error = p->error + p->motion.rounded,
                          .padding = p->padding};
}

// 1 where the interval's ends and the second order prove it along the normal.
static int is_free_by_ends(path_search *s, const path_span *span, uint32_t number, const path_pair *p, vec3 normal) {
    path_pair at_begin = path_make_pair(s->w, number, span->at_begin->frames),
              at_end = path_make_pair(s->w, number, span->at_end->frames);
    double begin = path_measure(s->w, &at_begin, span->at_begin->frames, normal) - p->motion.rounded;
    if (!(begin > s->margin)) return 0;
    double end = path_measure(s->w, &at_end, span->at_end->frames, normal) - p->motion.rounded;
    return path_is_free_between(begin, end, s->margin, p->motion.curved, span->end - span->begin);
}

// 1 where the gap along the normal in the middle proves the interval.
static int is_free_by_middle(const path_search *s, const path_span *span, const path_pair *p, vec3 normal) {
    return path_is_above(path_measure(s->w, p, span->middle->frames, normal), s->margin, p->motion.moved);
}

// What the ends may give: less than the second order takes away in between, and there is no use in measuring them.
static int may_be_free_by_ends(const path_search *s, const path_span *span, const path_pair *p, double lower) {
    double width = span->end - span->begin;
    return p->motion.curved * width * width < 16 * (lower - s->margin);
}

static int is_proven(path_search *s, const path_span *span, uint32_t number, const path_pair *p,
                     const ovoid_answer *answer) {
    double near = add_up(s->margin, p->padding, p->error);
    if (!(answer->lower > near)) return 0;
    vec3 normal = path_turn_back(p, span->middle->frames, answer->normal);
    if (answer->lower > add_up(near, p->motion.moved, 0) &&
        (!s->options->steps || is_free_by_middle(s, span, p, normal))) {
        add_step(s, span, number, OVOID_ROBOT_STEP_MIDDLE, 1, normal);
        return 1;
    }
    if (!may_be_free_by_ends(s, span, p, answer->lower) || !is_free_by_ends(s, span, number, p, normal)) return 0;
    add_step(s, span, number, OVOID_ROBOT_STEP_ENDS, 1, normal);
    return 1;
}

// Along what parted the pair in an earlier interval.
static int is_proven_earlier(path_search *s, const path_span *span, uint32_t number, const path_pair *p, vec3 world) {
    vec3 normal = path_turn_back(p, span->middle->frames, world);
    if (!is_free_by_ends(s, span, number, p, normal)) return 0;
    add_step(s, span, number, OVOID_ROBOT_STEP_ENDS, 1, normal);
    return 1;
}

typedef enum pair_outcome { PAIR_APART, PAIR_LEFT, PAIR_HIT } pair_outcome;

// What the hulls leave open: the solids' distance in the middle.
static pair_outcome test_solids(path_search *s, const path_span *span, uint32_t number, const path_pair *p,
                                const ovoid_answer *of_hulls) {
    checker_pair known = get_checker_pair(s, number, p);
    double near = add_up(s->margin, p->padding, p->error);
    const ovoid_options capped = {.cap = add_up(near, p->motion.moved, 0),
                                  .absolute_tolerance = 0.05 * p->motion.moved};
    ovoid_answer answer = solid_pair_distance(&p->pair, &p->solids, &capped, of_hulls, pair_get_clear(&known));
    if (answer.lower > capped.cap && (!s->options->steps || path_is_solid_far(p, s->margin))) {
        add_step(s, span, number, OVOID_ROBOT_STEP_SOLID, 1, (vec3){0, 0, 0});
        return PAIR_APART;
    }
    double upper = upper_outward(&known, answer.upper);
    int is_hit = upper <= s->margin;
    take_answer(s, p, is_hit ? OVOID_ROBOT_HIT : OVOID_ROBOT_UNDECIDED, lower_outward(&known, answer.lower), upper);
    return is_hit ? PAIR_HIT : PAIR_LEFT;
}

// Tests the pair in the middle of the interval: it is apart by more than the motion, or along one normal at both ends,
// or left open, or a hit.
static pair_outcome test_exactly(path_search *s, const path_span *span, uint32_t number) {
    path_pair p = path_make_pair(s->w, number, span->middle->frames);
    checker_pair known = get_checker_pair(s, number, &p);
    const ovoid_proof *earlier = pair_get_earlier(s->checker, &known);
    int is_known = *known.mark == s->checker->generation;
    if (is_known && is_proven_earlier(s, span, number, &p, known.proof->normal)) return PAIR_APART;
    // A normal need not be better than the motion lets it count.
    const ovoid_options capped = {.cap = add_up(add_up(s->margin, p.padding, p.error), p.motion.moved, 0),
                                  .absolute_tolerance = 0.05 * p.motion.moved};
    ovoid_answer answer = ovoid_distance(&p.pair, &capped, earlier);
    pair_remember(s->checker, &known, &answer.proof);
    if (is_proven(s, span, number, &p, &answer)) return PAIR_APART;
    if (sides_have_solid(&p.solids)) return test_solids(s, span, number, &p, &answer);
    double upper = upper_outward(&known, answer.upper);
    if (answer.status == OVOID_OVERLAPPING && upper > s->margin) {
        answer = ovoid_depth(&p.pair, NULL, &answer.proof, NULL);
        upper = upper_outward(&known, answer.upper);
    }
    take_answer(s, &p, OVOID_ROBOT_UNDECIDED, lower_outward(&known, answer.lower), upper);
    if (!(upper <= s->margin)) return PAIR_LEFT;
    s->answer->hit.status = OVOID_ROBOT_HIT;
    return PAIR_HIT;
}

static pair_outcome test_pair(path_search *s, const path_span *span, uint32_t number) {
    // The bodies hold their spheres' centres, or nearly: no query can show more than these are apart. Where that is not
    // well above the motion, half the interval is the cheaper question.
    // That holds of convex bodies alone: a solid such as a ring need not hold its sphere's centre.
    pair_parts of = pair_take_apart(s->w->cell, number);
    if (!path_has_solid(s->w, &of) && path_get_center_distance(s->w, &of) < 2 * path_get_motion(s->w, &of).moved)
        return PAIR_LEFT;
    vec3 normal = {0, 0, 0};
    switch (path_test_boxes(s->w, number, span, s->margin, &normal)) {
    case PATH_BOXES_FAR: add_step(s, span, number, OVOID_ROBOT_STEP_OUTER, 1, (vec3){0, 0, 0}); return PAIR_APART;
    case PATH_BOXES_PART: add_step(s, span, number, OVOID_ROBOT_STEP_ENDS, 1, normal); return PAIR_APART;
    default: return test_exactly(s, span, number);
    }
}

// ---- all pairs in an interval

// Tests the pairs of one mask and keeps those that stay open; 1 if one is a hit.
static int test_mask(path_search *s, const path_span *span, uint8_t *mask, uint32_t first, unsigned far) {
    unsigned gone = *mask & far;
    if (gone) add_step(s, span, first, OVOID_ROBOT_STEP_OUTER, gone, (vec3){0, 0, 0});
    *mask &= (uint8_t)~gone;
    for (unsigned rest = *mask; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        pair_outcome outcome = test_pair(s, span, first + k);
        if (outcome == PAIR_HIT) return 1;
        if (outcome == PAIR_APART) *mask &= (uint8_t) ~(1u << k);
    }
    return 0;
}

static unsigned find_far_pairs(const path_search *s, uint32_t first, unsigned mask) {
    unsigned far = 0;
    for (unsigned rest = mask; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        far |= (unsigned)path_is_far_pair(s->w, first + k, s->margin) << k;
    }
    return far;
}

typedef struct open_count {
    int is_hit;
    unsigned left;
} open_count;

static open_count test_all(path_search *s, const path_span *span, uint8_t *masks) {
    const ovoid_robot_cell *c = s->w->cell;
    open_count open = {0, 0};
    uint32_t parts = (uint32_t)(c->items.count * c->parts.count);
    for (uint32_t k = 0; !open.is_hit && k < s->memory->mask_count; k++) {
        if (!masks[k]) continue;
        uint32_t item = k / (s->memory->groups ? s->memory->groups : 1),
                 group = s->memory->groups ? k % s->memory->groups : 0;
        if (item < c->items.count && s->memory->groups) {
            unsigned far = path_find_far_parts(s->w, item, group, s->margin);
            open.is_hit = test_mask(s, span, &masks[k], item * (uint32_t)c->parts.count + group * ROBOT8, far);
        } else {
            uint32_t first = ROBOT8 * (k - (uint32_t)c->items.count * s->memory->groups);
            open.is_hit = test_mask(s, span, &masks[k], parts + first, find_far_pairs(s, first, masks[k]));
        }
        open.left |= masks[k];
    }
    return open;
}

// ---- intervals

// Places the items that have open pairs, and computes how they move.
static void place_open(path_search *s, const uint8_t *masks, const path_state *state, double half) {
    const ovoid_robot_cell *c = s->w->cell;
    uint32_t items = (uint32_t)c->items.count, first = items * s->memory->groups;
    for (uint32_t i = 0; i < items; i++) {
        uint8_t any = 0;
        for (uint32_t k = 0; k < s->memory->groups; k++) any |= masks[i * s->memory->groups + k];
        s->memory->is_open[i] = any != 0;
    }
    for (uint32_t k = first; k < s->memory->mask_count; k++)
        for (unsigned rest = masks[k]; rest; rest &= rest - 1) {
            item_pair p = cell_pairs(c)[ROBOT8 * (k - first) + compiler_count_low_zeros(rest)];
            s->memory->is_open[p.a] = s->memory->is_open[p.b] = 1;
        }
    for (uint32_t i = 0; i < items; i++) {
        if (!s->memory->is_open[i]) continue;
        path_place_item(s->w, state, i);
        path_set_item(s->w, state, i, half);
    }
}

// Is the state at t a hit, of a pair that is open? It is then the answer's. The state has its frames.
static int is_hit_at(path_search *s, double t, const path_state *state, const uint8_t *open) {
    path_search at = *s;
    ovoid_robot_path_answer answer = *s->answer;
    at.answer = &answer;
    at.options = &(const ovoid_robot_path_options){.query = s->options->query};
    path_span span = {t, t, state, state, state};
    uint8_t *masks = search_get_masks(s, SEARCH_LEVELS);
    memcpy(masks, open, s->memory->mask_count);
    place_open(s, masks, state, 0);
    if (!test_all(&at, &span, masks).is_hit) return 0;
    s->answer->hit = answer.hit;
    return 1;
}

// Looks farther and farther ahead for a hit soon after `from`, as an allowance may hide the time at which bodies meet.
static void look_ahead(path_search *s, double from) {
    path_state state = search_get_state(s, SEARCH_LEVELS + 2);
    for (double by = s->tolerance; by <= AHEAD && from + by <= 1; by *= 2) {
        s->answer->states++;
        path_compute_frames(s->w, s->q0, s->q1, from + by, &state);
        if (!is_hit_at(s, from + by, &state, search_get_masks(s, 0))) continue;
        s->answer->hit_at = s->segment + (from + by);
        return;
    }
}

// The interval is as short as intervals get, and not proven free: its first state that is a hit, or a later one that
// is known.
static void end_at(path_search *s, const path_span *span, const uint8_t *open, int is_hit) {
    ovoid_robot_path_answer *a = s->answer;
    a->free_until = s->segment + span->begin;
    if (is_hit_at(s, span->begin, span->at_begin, open))
        a->hit_at = a->free_until;
    else if (is_hit)
        a->hit_at = s->segment + 0.5 * (span->begin + span->end);
    else if (is_hit_at(s, span->end, span->at_end, open))
        a->hit_at = s->segment + span->end;
    else if (!(a->hit_at < INFINITY))
        look_ahead(s, span->end);
    a->status = a->hit_at < INFINITY ? OVOID_ROBOT_HIT : OVOID_ROBOT_UNDECIDED;
    if (a->status == OVOID_ROBOT_HIT) a->hit.status = OVOID_ROBOT_HIT;
}

void search_end_with(path_search *s, double begin, double at, const ovoid_robot_answer *hit) {
    ovoid_robot_path_answer *a = s->answer;
    a->free_until = s->segment + begin;
    a->hit_at = s->segment + at;
    a->hit = *hit;
    a->status = a->hit.status = OVOID_ROBOT_HIT;
}

// 1 where all pairs that are open at the level are proven apart in the interval; 0: the search has ended.
static int visit(path_search *s, uint32_t level, double begin, double end, const path_state *at_begin,
                 const path_state *at_end) {
    ovoid_robot_path_answer *a = s->answer;
    double middle = 0.5 * (begin + end);
    path_state state = search_get_state(s, level);
    path_span span = {begin, end, at_begin, at_end, &state};
    if (a->states >= s->states_most || watch_is_stopped(&s->options->watch)) {
        a->free_until = s->segment + begin;
        a->status = a->hit_at < INFINITY ? OVOID_ROBOT_HIT : OVOID_ROBOT_UNDECIDED;
        return 0;
    }
    a->states++;
    path_compute_frames(s->w, s->q0, s->q1, middle, &state);
    uint8_t *masks = search_get_masks(s, level);
    place_open(s, masks, &state, 0.5 * (end - begin));
    ovoid_robot_answer known = a->hit;
    open_count open = test_all(s, &span, masks);
    if (!open.is_hit && !open.left) {
        a->hit = known;
        return 1;
    }
    if (open.is_hit && s->options->any_hit) {
        search_end_with(s, begin, middle, &a->hit);
        return 0;
    }
    if (open.is_hit)
        a->hit_at = s->segment + middle;
    else if (a->hit_at < INFINITY)
        a->hit = known;
    int is_narrow = a->hit_at - (s->segment + begin) <= s->tolerance;
    if (s->is_still || is_narrow || level + 1 == SEARCH_LEVELS) {
        end_at(s, &span, masks, open.is_hit);
        return 0;
    }
    memcpy(search_get_masks(s, level + 1), masks, s->memory->mask_count);
    if (!visit(s, level + 1, begin, middle, at_begin, &state) || open.is_hit) return 0;
    memcpy(search_get_masks(s, level + 1), masks, s->memory->mask_count);
    return visit(s, level + 1, middle, end, &state, at_end);
}

// ---- a path

void search_open_all(const path_search *s, uint8_t *masks) {
    const ovoid_robot_query_options *o = &s->options->query;
    size_t parts = s->w->cell->items.count * s->memory->groups;
    memcpy(masks, s->memory->queried, s->memory->mask_count);
    if (o->without_obstacles) memset(masks, 0, parts);
    if (o->without_self) memset(masks + parts, 0, s->memory->mask_count - parts);
}

ovoid_code search_set_segment(path_search *s, size_t index, ovoid_error *refused) {
    s->q0 = s->list.states + index * s->list.step;
    s->q1 = s->q0 + s->list.length;
    s->segment = s->list.are_edges ? 0 : (double)index;
    if (s->set_segment == index + 1) return OVOID_OK;
    s->set_segment = 0;
    ovoid_code code = path_set_segment(s->w, s->q0, s->q1, s->options->query.limit_slack, refused);
    if (code == OVOID_OK) s->set_segment = index + 1;
    return code;
}

// 1 where a state of the path that was looked at hits; it is the answer. Segments from one that is refused on are not
// looked at.
static int find_any_hit(path_search *s) {
    ovoid_error refused;
    for (size_t i = 0; i < s->list.count && !watch_is_stopped(&s->options->watch); i++) {
        ovoid_robot_answer hit;
        if (s->answer->states >= s->states_most || search_set_segment(s, i, &refused) != OVOID_OK) return 0;
        path_any_hit search = {s->w,  s->checker, &s->options->query,
                               s->q0, s->q1,      search_get_state(s, SEARCH_LEVELS + 2)};
        double at = path_find_any_hit(&search, &s->answer->states, &hit);
        if (!(at < INFINITY)) continue;
        s->segment = 0;
        search_end_with(s, 0, (double)i + at, &hit);
        s->is_settled = 1;
        return 1;
    }
    return 0;
}

void search_refuse(path_search *s, ovoid_code code, const ovoid_error *refused) {
    ovoid_robot_path_answer *a = s->answer;
    a->status = OVOID_ROBOT_REFUSED;
    a->hit.status = OVOID_ROBOT_REFUSED;
    a->hit.code = code;
    a->hit.variable = (uint32_t)refused->place;
    a->refused = (size_t)s->segment;
}

int search_run_open(path_search *s, double begin, double end) {
    path_state at_begin = search_get_state(s, SEARCH_LEVELS), at_end = search_get_state(s, SEARCH_LEVELS + 1);
    s->is_still = path_is_still(s->w);
    path_compute_state(s->w, s->q0, s->q1, begin, &at_begin);
    path_compute_state(s->w, s->q0, s->q1, end, &at_end);
    return visit(s, 0, begin, end, &at_begin, &at_end);
}

void search_end_segment(path_search *s) { s->answer->free_until = s->segment + !s->list.is_state; }

static int run_segment(path_search *s, size_t index) {
    ovoid_error refused;
    ovoid_code code = search_set_segment(s, index, &refused);
    if (code != OVOID_OK) {
        search_refuse(s, code, &refused);
        return 0;
    }
    search_open_all(s, search_get_masks(s, 0));
    if (!search_run_open(s, 0, 1)) return 0;
    search_end_segment(s);
    return 1;
}

void search_run_all(path_search *s, int has_pairs) {
    s->answer->status = OVOID_ROBOT_FREE;
    s->set_segment = 0;
    if (s->options->any_hit && has_pairs && find_any_hit(s)) return;
    for (size_t i = 0; i < s->list.count; i++)
        if (!run_segment(s, i)) return;
    if (has_pairs) return;
    s->answer->status = OVOID_ROBOT_UNDECIDED;
    s->answer->free_until = 0;
    s->answer->hit = answer_make_empty();
}

static ovoid_code validate_options(const ovoid_robot_path_options *o, ovoid_error *error) {
    ovoid_code code = query_options_validate(&o->query, error);
    if (code != OVOID_OK || o->tolerance >= 0) return code;
    return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the tolerance of a path is a number of at least 0");
}

static ovoid_code validate_path(const ovoid_robot_path *path, ovoid_error *error) {
    if (path->states && path->count >= 1 && path->count <= OVOID_ROBOT_PATH_STATES_MAX) return OVOID_OK;
    return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a path has 1 to 2^20 states, not %zu", path->count);
}

// ---- memory

static void destroy_memory(path_memory *m) {
    ovoid_allocator memory = m->w.allocator;
    allocator_release(&memory, m->masks);
    allocator_release(&memory, m->states);
    path_cover_destroy(&m->cover);
    path_work_destroy(&m->w);
    allocator_release(&memory, m);
}

static void find_queried(path_memory *m, const ovoid_robot_cell *c) {
    memset(m->queried, 0, m->mask_count);
    for (uint32_t item = 0; item < c->items.count; item++)
        for (uint32_t part = 0; part < c->parts.count; part++)
            m->queried[item * m->groups + part / ROBOT8] |=
                (uint8_t)(path_is_queried(&m->w, item, part) << part % ROBOT8);
    for (uint32_t k = 0; k < c->pairs.count; k++)
        m->queried[c->items.count * m->groups + k / ROBOT8] |= (uint8_t)(1u << k % ROBOT8);
}

static int allocate(path_memory *m, const ovoid_robot_cell *c) {
    m->groups = (uint32_t)c->boxes.count;
    m->mask_count = c->items.count * m->groups + (c->pairs.count + ROBOT8 - 1) / ROBOT8;
    m->state_size = path_get_state_size(c);
    m->masks = allocator_allocate(&m->w.allocator, m->mask_count * (SEARCH_LEVELS + 2) + c->items.count + 1, 1);
    m->states = allocator_allocate(&m->w.allocator, SEARCH_LEVELS + 3, m->state_size);
    m->queried = m->masks ? m->masks + m->mask_count * (SEARCH_LEVELS + 1) : NULL;
    m->is_open = m->masks ? m->queried + m->mask_count : NULL;
    if (m->masks) find_queried(m, c);
    return m->masks && m->states;
}

// The checker's memory, made where there is none for the cell as it is.
static ovoid_code get_memory(ovoid_robot_checker *checker, ovoid_error *error) {
    if (checker->path) return OVOID_OK;
    path_memory *m = allocator_allocate(&checker->allocator, 1, sizeof *m);
    if (!m) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a path");
    *m = (path_memory){.groups = 0};
    ovoid_code code = path_work_create(&m->w, checker->cell, &checker->allocator, error);
    if (code != OVOID_OK) {
        allocator_release(&checker->allocator, m);
        return code;
    }
    if (allocate(m, checker->cell)) {
        checker->path = m;
        checker->path_destroy = destroy_memory;
        return OVOID_OK;
    }
    destroy_memory(m);
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a path");
}

// The memory of covers, made for the first path that they prove.
static ovoid_code get_cover(path_memory *m, ovoid_error *error) {
    if (m->cover.block || path_cover_create(&m->cover, &m->w)) return OVOID_OK;
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for the balls around a robot");
}

void search_settle_hit(path_search *s, const ovoid_robot_path *path, size_t first) {
    ovoid_robot_path_answer *a = s->answer;
    if (a->status != OVOID_ROBOT_HIT || s->is_settled) return;
    path_place place = path_find_place(s->w->cell, path, a->hit_at);
    path_state state = search_get_state(s, SEARCH_LEVELS + 2);
    ovoid_error refused;
    uint32_t number = path_find_number(s->w->cell, &a->hit.a, &a->hit.b);
    if (number != OVOID_ROBOT_NONE && search_set_segment(s, first + place.segment, &refused) == OVOID_OK)
        a->hit = path_ask_hit(s->w, &place, number, &state);
    if (a->hit.upper <= s->margin) return;
    a->status = a->hit.status = OVOID_ROBOT_UNDECIDED;
    a->hit_at = INFINITY;
}

static ovoid_robot_path_answer make_answer(void) {
    return (ovoid_robot_path_answer){.hit_at = INFINITY, .hit = {.lower = -INFINITY, .upper = INFINITY}};
}

// By covers, if these are asked for and decide the path; else without.
static void run_path(path_search *s, const ovoid_robot_path *path) {
    int has_pairs = cell_has_pairs(s->w->cell, &s->options->query);
    if (!search_uses_covers(s->options) || !has_pairs || !covered_run_path(s)) {
        uint32_t checked = s->answer->states;
        *s->answer = make_answer();
        s->answer->states = checked;
        search_run_all(s, has_pairs);
    }
    search_settle_hit(s, path, 0);
    // What covers prove has no steps; so that the count does not depend on what proved more, it is of those asked for.
    if (search_uses_covers(s->options)) s->answer->step_count = 0;
}

static path_search make_search(ovoid_robot_checker *checker, const ovoid_robot_path_options *options) {
    return (path_search){.w = &checker->path->w,
                         .memory = checker->path,
                         .checker = checker,
                         .options = options,
                         .margin = options->query.margin,
                         .tolerance = options->tolerance > 0 ? options->tolerance : 0x1p-20,
                         .states_most = options->states ? options->states : 100000};
}

static ovoid_code prepare(ovoid_robot_checker *checker, const ovoid_robot_path_options *options, ovoid_error *error) {
    ovoid_code code = checker_renew(checker, error);
    if (code == OVOID_OK) code = get_memory(checker, error);
    if (code == OVOID_OK && search_uses_covers(options)) code = get_cover(checker->path, error);
    return code;
}

static const ovoid_robot_path_options no_options;

static ovoid_code find_hit(ovoid_robot_checker *checker, const ovoid_robot_path_query *query,
                           ovoid_robot_path_answer *answer, ovoid_error *error) {
    const ovoid_robot_path *path = query->path;
    const ovoid_robot_path_options *options = query->options ? query->options : &no_options;
    *answer = make_answer();
    ovoid_code code = validate_options(options, error);
    if (code == OVOID_OK) code = validate_path(path, error);
    if (code == OVOID_OK) code = prepare(checker, options, error);
    if (code != OVOID_OK) return code;
    path_search s = make_search(checker, options);
    size_t variables = checker->cell->robot->variable_count;
    s.answer = answer;
    s.list = (segment_list){.states = path->states, .count = 1, .is_state = 1};
    if (path->count > 1)
        s.list =
            (segment_list){.states = path->states, .count = path->count - 1, .step = variables, .length = variables};
    run_path(&s, path);
    return OVOID_OK;
}

ovoid_code ovoid_robot_path_find_hit(ovoid_robot_checker *checker, const ovoid_robot_path_query *query,
                                     ovoid_robot_path_answer *answer, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checker, find_hit(checker, query, answer, error));
}

// ---- edges

void search_run_edge(path_search *s, size_t index) {
    const segment_list all = s->list;
    const ovoid_robot_path path = {all.states + index * all.step, 2};
    uint32_t checked = s->answer->states;
    *s->answer = make_answer();
    s->answer->states = checked;
    s->list = (segment_list){.states = path.states, .count = 1, .length = all.length};
    s->is_settled = 0;
    search_run_all(s, cell_has_pairs(s->w->cell, &s->options->query));
    search_settle_hit(s, &path, 0);
    if (search_uses_covers(s->options)) s->answer->step_count = 0;
    s->list = all;
    s->set_segment = 0;
}

static void run_block(void *context, ovoid_robot_checker *checker, size_t first, size_t end) {
    const ovoid_robot_edge_batch *batch = *(const ovoid_robot_edge_batch **)context;
    const ovoid_robot_path_options *options = batch->options ? batch->options : &no_options;
    size_t variables = checker->cell->robot->variable_count;
    path_search s = make_search(checker, options);
    s.list = (segment_list){
        .states = batch->states, .count = batch->count, .step = 2 * variables, .length = variables, .are_edges = 1};
    ovoid_robot_checker_reset(checker);
    if (search_uses_covers(options) && cell_has_pairs(checker->cell, &options->query))
        covered_run_edges(&s, first, end, batch->answers);
    else
        for (size_t i = first; i < end; i++) {
            s.answer = &batch->answers[i];
            search_run_edge(&s, i);
        }
}

static ovoid_code find_hit_batch(ovoid_robot_checker *const *checkers, size_t count,
                                 const ovoid_robot_edge_batch *batch, ovoid_error *error) {
    const ovoid_robot_path_options *options = batch->options ? batch->options : &no_options;
    for (size_t i = 0; i < batch->count; i++) batch->answers[i] = make_answer();
    ovoid_code code = validate_options(options, error);
    if (code == OVOID_OK && options->steps)
        code =
            error_set(error, OVOID_ERROR_ARGUMENT, -1, "a batch of edges writes no steps: ask for those of one path");
    if (code == OVOID_OK) code = checkers_validate(checkers, count, error);
    for (size_t i = 0; code == OVOID_OK && i < count; i++) code = prepare(checkers[i], options, error);
    if (code != OVOID_OK) return code;
    return checkers_run(checkers, count, &(checkers_job){run_block, &batch, batch->count}, error);
}

ovoid_code ovoid_robot_path_find_hit_batch(ovoid_robot_checker *const *checkers, size_t checker_count,
                                           const ovoid_robot_edge_batch *batch, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checkers, find_hit_batch(checkers, checker_count, batch, error));
}
