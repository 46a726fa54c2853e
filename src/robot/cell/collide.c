// Is a state free? Each pair that enclosing bodies leave is asked whether it is within the margin, beginning with the
// pair that ended the last state: neighbouring states hit the same things.
#include "base/environment.h"
#include "base/error.h"
#include "robot/cell/checker.h"

// A pair that spheres and boxes leave.
typedef struct candidate {
    checker_pair pair;
    pair_name name;
} candidate;

enum { CANDIDATES = 16 };

// What the check of one state found.
typedef struct state_search {
    ovoid_robot_checker *checker;
    double margin;
    ovoid_robot_answer *answer;
    pair_name asked; ///< before the search
    candidate candidates[CANDIDATES];
    uint32_t count;
} state_search;

static void take_pair(state_search *s, const checker_pair *p, ovoid_robot_status status, double lower, double upper) {
    ovoid_robot_answer *a = s->answer;
    a->status = status;
    a->a = *p->a, a->b = *p->b;
    a->lower = lower, a->upper = upper;
}

static int are_equal(pair_name a, pair_name b) { return a.item == b.item && a.index == b.index; }

static void remember_hit(ovoid_robot_checker *checker, pair_name name) {
    checker->last_count = are_equal(name, checker->last) ? checker->last_count + 1 : 1;
    checker->last = name;
}

// Takes a bracket of the bodies' distance; 0 where it proves the pair within the margin. Of pairs that stay open the
// first is kept.
static int take_bracket(state_search *s, const checker_pair *p, pair_name name, double least, double most) {
    double lower = lower_outward(p, least), upper = upper_outward(p, most);
    int is_hit = upper <= s->margin;
    if (is_hit || s->answer->status == OVOID_ROBOT_FREE)
        take_pair(s, p, is_hit ? OVOID_ROBOT_HIT : OVOID_ROBOT_UNDECIDED, lower, upper);
    if (is_hit) remember_hit(s->checker, name);
    return !is_hit;
}

// Asks one pair; 0 where it is proven within the margin.
static int ask_pair(state_search *s, const checker_pair *p, pair_name name, const ovoid_proof *earlier) {
    double margin = add_up(s->margin, p->padding, p->error);
    ovoid_answer answer = ovoid_within(&p->pair, margin, NULL, earlier);
    pair_remember(s->checker, p, &answer.proof);
    if (sides_have_solid(&p->solids) && !(answer.lower > margin)) {
        answer.upper = solid_sides_raise(&p->solids, answer.upper);
        if (!(upper_outward(p, answer.upper) <= s->margin))
            answer = solid_pair_within(&p->pair, &p->solids, margin, &answer, pair_get_clear(p));
    }
    return answer.lower > margin || take_bracket(s, p, name, answer.lower, answer.upper);
}

// Takes the earlier proof if that separated the bodies: a proof of an overlap seldom holds for a state that is not
// close.
static int ask_candidate(state_search *s, const checker_pair *p, pair_name name) {
    if (checker_is_cover_far(s->checker, p, name, s->margin)) return 1;
    return ask_pair(s, p, name, pair_was_apart(s->checker, p) ? pair_get_earlier(s->checker, p) : NULL);
}

// First what lies inside both bodies, by which most hits are proven; the rest is asked after the search.
static int look_at_pair(void *context, const checker_pair *p, pair_name name) {
    state_search *s = context;
    double lower, upper;
    if (are_equal(name, s->asked)) return 1;
    if (!pair_was_apart(s->checker, p) && checker_prove_overlap(s->checker, name, &lower, &upper) &&
        !take_bracket(s, p, name, lower, upper))
        return 0;
    if (s->count == CANDIDATES) return ask_candidate(s, p, name);
    s->candidates[s->count++] = (candidate){*p, name};
    return 1;
}

// The pair that ended the last state; 1 where it does not end this one.
static int ask_last(state_search *s, const ovoid_robot_query_options *options) {
    ovoid_robot_checker *checker = s->checker;
    pair_name last = checker->last;
    int is_self = last.item == OVOID_ROBOT_NONE;
    if (checker->last_count < 2 || (is_self ? options->without_self : options->without_obstacles)) return 1;
    if (is_self ? checker_is_pair_far(checker, last.index, s->margin)
                : checker_is_part_far(checker, last.item, last.index, s->margin))
        return 1;
    s->asked = last;
    checker_pair p =
        is_self ? checker_make_item_pair(checker, last.index) : checker_make_part_pair(checker, last.item, last.index);
    double lower, upper;
    // What lies inside both bodies is the cheaper test of solids.
    if (sides_have_solid(&p.solids) && checker_prove_overlap(checker, last, &lower, &upper) &&
        !take_bracket(s, &p, last, lower, upper))
        return 0;
    return ask_pair(s, &p, last, pair_get_earlier(checker, &p));
}

static const ovoid_robot_query_options no_options = {0, 0, 0, 0};

static void refuse(ovoid_robot_answer *answer, ovoid_code code, uint32_t variable) {
    *answer = (ovoid_robot_answer){
        .status = OVOID_ROBOT_REFUSED, .code = code, .variable = variable, .lower = -INFINITY, .upper = INFINITY};
}

// The answer to the state that is placed.
static void decide(ovoid_robot_checker *checker, const ovoid_robot_query_options *options, ovoid_robot_answer *answer) {
    *answer = (ovoid_robot_answer){.status = OVOID_ROBOT_FREE, .lower = options->margin, .upper = INFINITY};
    if (!cell_has_pairs(checker->cell, options)) {
        *answer = answer_make_empty();
        return;
    }
    state_search s;
    s.checker = checker, s.margin = options->margin, s.answer = answer;
    s.asked = (pair_name){OVOID_ROBOT_NONE, OVOID_ROBOT_NONE};
    s.count = 0;
    if (!ask_last(&s, options)) return;
    checker_search search = {checker, options, &s.margin, look_at_pair, &s, 0};
    checker_find_pairs(&search);
    if (answer->status == OVOID_ROBOT_HIT) return;
    for (uint32_t i = 0; i < s.count; i++)
        if (!ask_candidate(&s, &s.candidates[i].pair, s.candidates[i].name)) return;
}

int collide_state(ovoid_robot_checker *checker, const double *q, const ovoid_robot_query_options *options,
                  ovoid_robot_answer *answer) {
    ovoid_error refused;
    ovoid_code code = checker_place(checker, q, options->limit_slack, &refused);
    if (code == OVOID_OK)
        decide(checker, options, answer);
    else
        refuse(answer, code, (uint32_t)refused.place);
    return code == OVOID_OK;
}

static ovoid_code collide(ovoid_robot_checker *checker, const ovoid_robot_query *query, ovoid_robot_answer *answer,
                          ovoid_error *error) {
    const ovoid_robot_query_options *options = query->options ? query->options : &no_options;
    *answer = (ovoid_robot_answer){.lower = -INFINITY, .upper = INFINITY};
    ovoid_code code = query_options_validate(options, error);
    if (code == OVOID_OK) code = checker_renew(checker, error);
    if (code == OVOID_OK) (void)collide_state(checker, query->q, options, answer);
    return code;
}

ovoid_code ovoid_robot_collide(ovoid_robot_checker *checker, const ovoid_robot_query *query, ovoid_robot_answer *answer,
                               ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checker, collide(checker, query, answer, error));
}

void collide_block(ovoid_robot_checker *checker, const ovoid_robot_batch *batch, size_t first, size_t end) {
    const ovoid_robot_query_options *options = batch->options ? batch->options : &no_options;
    ovoid_robot_checker_reset(checker);
    for (size_t i = first; i < end; i += ROBOT8) {
        lane_state states[ROBOT8];
        size_t count = end - i < ROBOT8 ? end - i : ROBOT8;
        checker_place_lanes(checker, batch->q + i * checker->cell->robot->variable_count, count, options->limit_slack,
                            states);
        checker_filter_lanes(checker, options);
        for (uint32_t k = 0; k < count; k++) {
            if (states[k].code != OVOID_OK) {
                refuse(&batch->answers[i + k], states[k].code, states[k].variable);
                continue;
            }
            checker_take_lane(checker, k, &states[k]);
            decide(checker, options, &batch->answers[i + k]);
        }
    }
}
