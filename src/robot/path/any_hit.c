// Any state of a path that hits, found before anything is proven free: states in van der Corput's order, the last one
// first (J. G. van der Corput, Verteilungsfunktionen, 1935), as planners sample edges. More states the more the joints
// turn; a hit counts if the exact path's state, which rounding moves, is one too.
#include "robot/path/motion.h"

#define TURN_A_STATE 0.35 // radians
enum { STATES_MOST = 16 };

// How many states of the segment that was set are looked at.
static uint32_t count_states(const path_work *w) {
    double fastest = 0, slide = 0;
    for (uint32_t i = 0; i < w->step_count; i++) {
        fastest = max2(fastest, w->speeds[i].turn);
        slide = max2(slide, w->speeds[i].slide);
    }
    double count = max2(1 + fastest / TURN_A_STATE, slide > 0 ? 4 : 1);
    return count < STATES_MOST ? (uint32_t)count : STATES_MOST;
}

// 1, then 1/2, 1/4, 3/4, 1/8, 5/8, ...
static double get_place(uint32_t i) {
    if (i == 0) return 1;
    double place = 0;
    for (double half = 0.5; i; i /= 2, half *= 0.5) place += half * (i % 2);
    return place;
}

int path_is_any_hit_at(const path_any_hit *search, double t, ovoid_robot_answer *hit) {
    const ovoid_robot *r = search->w->cell->robot;
    ovoid_robot_query_options options = *search->options;
    ovoid_robot_answer answer;
    // Between two states that are within their limits rounding may leave them.
    options.limit_slack = INFINITY;
    for (uint32_t k = 0; k < r->variable_count; k++)
        search->w->state[k] = t == 1 ? search->q1[k] : search->q0[k] + t * (search->q1[k] - search->q0[k]);
    if (!collide_state(search->checker, search->w->state, &options, &answer) || answer.status != OVOID_ROBOT_HIT)
        return 0;
    const path_place place = {0, search->q0, search->q1, t};
    *hit = path_ask_hit(search->w, &place, checker_get_last_number(search->checker), &search->state);
    return hit->upper <= search->options->margin;
}

double path_find_any_hit(const path_any_hit *search, uint32_t *states, ovoid_robot_answer *hit) {
    uint32_t count = count_states(search->w);
    for (uint32_t i = 0; i < count; i++) {
        ++*states;
        if (path_is_any_hit_at(search, get_place(i), hit)) return get_place(i);
    }
    return INFINITY;
}
