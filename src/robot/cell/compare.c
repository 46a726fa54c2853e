// A robot beside a model of it: every state is checked with both, and each answer is proven by itself, so a state that
// is counted as missed is one: the robot hits there, and every pair of the model is apart.
#include "base/error.h"
#include "robot/cell/checker.h"

#include "ovoid/robot_compare.h"

enum { BLOCK = 64 };

const char *ovoid_robot_agreement_get_name(ovoid_robot_agreement agreement) {
    static const char *const names[OVOID_ROBOT_AGREEMENTS] = {"open", "both free", "both hit", "missed", "invented"};
    return (unsigned)agreement < OVOID_ROBOT_AGREEMENTS ? names[agreement] : names[0];
}

static ovoid_robot_agreement judge(ovoid_robot_status robot, ovoid_robot_status model) {
    int is_hit = robot == OVOID_ROBOT_HIT, is_model_hit = model == OVOID_ROBOT_HIT;
    if ((!is_hit && robot != OVOID_ROBOT_FREE) || (!is_model_hit && model != OVOID_ROBOT_FREE))
        return OVOID_ROBOT_COMPARED_OPEN;
    if (is_hit) return is_model_hit ? OVOID_ROBOT_COMPARED_BOTH_HIT : OVOID_ROBOT_COMPARED_MISSED;
    return is_model_hit ? OVOID_ROBOT_COMPARED_INVENTED : OVOID_ROBOT_COMPARED_BOTH_FREE;
}

// The pair of a missed state that overlaps most, where it overlaps more than those before.
static ovoid_code take_missed(const ovoid_robot_comparison_batch *batch, size_t state, ovoid_robot_comparison *sum,
                              ovoid_error *error) {
    size_t variables = batch->robot->cell->robot->variable_count;
    ovoid_robot_near near;
    ovoid_robot_nears nears = {.items = &near, .capacity = 1};
    ovoid_code code = ovoid_robot_find_nearest(
        batch->robot, &(ovoid_robot_query){batch->q + state * variables, batch->options}, &nears, error);
    if (code != OVOID_OK || nears.count == 0) return code;
    if (sum->counts[OVOID_ROBOT_COMPARED_MISSED] && near.upper >= sum->deepest.upper) return OVOID_OK;
    sum->deepest = near;
    sum->deepest_state = sum->states;
    return OVOID_OK;
}

static ovoid_code validate_all(const ovoid_robot_comparison_batch *batch, size_t first, size_t count,
                               ovoid_robot_answer answers[2][BLOCK], ovoid_error *error) {
    ovoid_robot_checker *checkers[2] = {batch->robot, batch->model};
    ovoid_code code = OVOID_OK;
    for (int i = 0; i < 2 && code == OVOID_OK; i++) {
        size_t variables = checkers[i]->cell->robot->variable_count;
        ovoid_robot_batch states = {batch->q + first * variables, count, batch->options, answers[i]};
        code = ovoid_robot_collide_batch(&checkers[i], 1, &states, error);
    }
    return code;
}

static ovoid_code compare_block(const ovoid_robot_comparison_batch *batch, size_t first, size_t count,
                                ovoid_robot_comparison *sum, ovoid_error *error) {
    ovoid_robot_answer answers[2][BLOCK];
    ovoid_code code = validate_all(batch, first, count, answers, error);
    for (size_t i = 0; i < count && code == OVOID_OK; i++) {
        ovoid_robot_agreement a = judge(answers[0][i].status, answers[1][i].status);
        if (a == OVOID_ROBOT_COMPARED_MISSED) code = take_missed(batch, first + i, sum, error);
        sum->counts[a]++;
        sum->states++;
        if (batch->agreements) batch->agreements[first + i] = a;
    }
    return code;
}

ovoid_code ovoid_robot_compare_states(const ovoid_robot_comparison_batch *batch, ovoid_robot_comparison *comparison,
                                      ovoid_error *error) {
    if (!batch || !comparison || !batch->robot || !batch->model || (batch->count && !batch->q))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no checkers, no states, or no room (NULL)");
    size_t variables = batch->robot->cell->robot->variable_count, of_model = batch->model->cell->robot->variable_count;
    if (variables != of_model)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the robot has %zu variables and its model %zu", variables,
                         of_model);
    ovoid_robot_comparison sum = *comparison;
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < batch->count && code == OVOID_OK; i += BLOCK)
        code = compare_block(batch, i, batch->count - i < BLOCK ? batch->count - i : BLOCK, &sum, error);
    if (code == OVOID_OK) *comparison = sum;
    return code;
}
