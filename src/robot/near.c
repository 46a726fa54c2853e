// The near pairs of a state, each with its distance or depth, its points and its gradient by the robot's variables.
#include "base/environment.h"
#include "base/error.h"
#include "ovoid/smooth.h"
#include "robot/checker.h"

#include <string.h>

// A search for near pairs.
typedef struct near_search {
    ovoid_robot_checker *checker;
    const double *q;
    ovoid_robot_nears *nears;
    double margin;
    int wants_one; ///< the nearest alone: the margin falls
} near_search;

static ovoid_status find_status(double lower, double upper, ovoid_status of_shapes) {
    if (lower > 0) return OVOID_SEPARATED;
    if (upper < 0) return OVOID_OVERLAPPING;
    return of_shapes == OVOID_TOUCHING ? OVOID_TOUCHING : OVOID_UNDECIDED;
}

// Where an item belongs among those kept; beyond the last where it is farther than all of them.
static size_t find_place(const ovoid_robot_nears *n, size_t kept, double lower) {
    size_t at = kept;
    while (at > 0 && n->items[at - 1].lower > lower) at--;
    return at;
}

// Makes room at a place, the farthest falling out where all room is taken. 0: the item itself falls out.
static int make_room(const near_search *s, size_t at, size_t kept) {
    ovoid_robot_nears *n = s->nears;
    size_t variables = s->checker->cell->robot->variable_count, capacity = s->wants_one ? 1 : n->capacity;
    if (at >= capacity) return 0;
    size_t moved = (kept < capacity ? kept : capacity - 1) - at;
    memmove(n->items + at + 1, n->items + at, moved * sizeof *n->items);
    if (n->gradients)
        memmove(n->gradients + (at + 1) * variables, n->gradients + at * variables,
                moved * variables * sizeof *n->gradients);
    return 1;
}

static void keep(const near_search *s, size_t at, const checker_pair *p, const ovoid_answer *is,
                 const ovoid_cover *cover) {
    ovoid_robot_near *n = &s->nears->items[at];
    double lower = lower_outward(p, is->lower), upper = upper_outward(p, is->upper);
    *n = (ovoid_robot_near){.a = *p->a,
                            .b = *p->b,
                            .status = find_status(lower, upper, is->status),
                            .lower = lower,
                            .upper = upper,
                            .point_b = is->point_b,
                            .normal = is->normal};
    n->point_a = vec3_add_scaled(is->point_a, is->normal, p->padding);
    if (!s->nears->gradients) return;
    ovoid_gradient g = ovoid_answer_compute_gradient(&p->pair, is, cover);
    n->has_gradient = g.has_translation && g.has_rotation;
    size_t variables = s->checker->cell->robot->variable_count;
    checker_compute_gradient(s->checker, p, g.gradient, s->q, s->nears->gradients + at * variables);
}

static int ask_pair(void *context, const checker_pair *p, pair_name name) {
    near_search *s = context;
    (void)name;
    ovoid_cover cover;
    ovoid_options options = {.cap = add_up(s->margin, p->padding, p->error)};
    if (!(options.cap > 0)) options.cap = OVOID_LENGTH_MIN;
    ovoid_answer is = ovoid_depth(&p->pair, &options, pair_get_earlier(s->checker, p), &cover);
    pair_remember(s->checker, p, &is.proof);
    double lower = lower_outward(p, is.lower);
    if (lower > s->margin) return 1;
    ovoid_robot_nears *n = s->nears;
    size_t most = s->wants_one ? 1 : n->capacity, kept = n->count < most ? n->count : most;
    size_t at = find_place(n, kept, lower);
    if (make_room(s, at, kept)) keep(s, at, p, &is, &cover);
    n->count = s->wants_one ? 1 : n->count + 1;
    if (s->wants_one) s->margin = min2(s->margin, n->items[0].upper);
    return 1;
}

static ovoid_code find(ovoid_robot_checker *x, const double *q, const ovoid_robot_check_options *options,
                       ovoid_robot_nears *nears, int wants_one, ovoid_error *error) {
    static const ovoid_robot_check_options none = {0, 0, 0, 0};
    if (!options) options = &none;
    nears->count = 0;
    if ((wants_one || nears->capacity) && (!nears->items || nears->capacity == 0))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "there is no room for near pairs");
    ovoid_code code = check_options_check(options, error);
    if (code == OVOID_OK) code = checker_renew(x, error);
    if (code == OVOID_OK) code = checker_place(x, q, options->limit_slack, error);
    if (code != OVOID_OK) return code;
    near_search s = {x, q, nears, options->margin, wants_one};
    checker_search search = {x, options, &s.margin, ask_pair, &s};
    checker_find_pairs(&search);
    return OVOID_OK;
}

ovoid_code ovoid_robot_find_near(ovoid_robot_checker *checker, const double *q,
                                 const ovoid_robot_check_options *options, ovoid_robot_nears *nears,
                                 ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checker, find(checker, q, options, nears, 0, error));
}

ovoid_code ovoid_robot_find_nearest(ovoid_robot_checker *checker, const double *q,
                                    const ovoid_robot_check_options *options, ovoid_robot_nears *nears,
                                    ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checker, find(checker, q, options, nears, 1, error));
}
