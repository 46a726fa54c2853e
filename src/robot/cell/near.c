// The near pairs of a state, each with its distance or depth, its points and its gradient by the robot's variables.
#include "base/environment.h"
#include "base/error.h"
#include "ovoid/smooth.h"
#include "robot/cell/checker.h"

// A search for near pairs.
typedef struct near_search {
    ovoid_robot_checker *checker;
    const double *q;
    near_list list;
    double margin;
    int wants_one; ///< the nearest alone: the margin falls
    int without_depths;
} near_search;

static ovoid_status find_status(double lower, double upper, ovoid_status of_shapes) {
    if (lower > 0) return OVOID_SEPARATED;
    if (upper < 0) return OVOID_OVERLAPPING;
    return of_shapes == OVOID_TOUCHING ? OVOID_TOUCHING : OVOID_UNDECIDED;
}

static void put(double *to, vec3 v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

// The gradient of solids is that of the deciding pair of triangles at its points. That no other pair is as near is not
// shown.
static ovoid_gradient make_gradient(const checker_pair *p, const ovoid_answer *answer) {
    ovoid_gradient g = {.has_translation = 0};
    vec3 lever_a = vec3_sub(answer->point_a, p->pair.pose_a.position),
         lever_b = vec3_sub(answer->point_b, p->pair.pose_b.position);
    put(g.gradient, vec3_neg(answer->normal));
    put(g.gradient + 3, vec3_cross(answer->normal, lever_a));
    put(g.gradient + 6, answer->normal);
    put(g.gradient + 9, vec3_cross(lever_b, answer->normal));
    return g;
}

// cover: NULL of solids.
static void keep(const near_search *s, uint32_t at, const checker_pair *p, const ovoid_answer *answer,
                 const ovoid_cover *cover) {
    const near_list *list = &s->list;
    ovoid_robot_near *n = &list->items[at];
    double lower = lower_outward(p, answer->lower), upper = upper_outward(p, answer->upper);
    *n = (ovoid_robot_near){.a = *p->a,
                            .b = *p->b,
                            .status = find_status(lower, upper, answer->status),
                            .lower = lower,
                            .upper = upper,
                            .point_b = answer->point_b,
                            .normal = answer->normal};
    n->point_a = vec3_add_scaled(answer->point_a, answer->normal, p->padding);
    if (!list->gradients) return;
    ovoid_gradient g = cover ? ovoid_answer_compute_gradient(&p->pair, answer, cover) : make_gradient(p, answer);
    n->has_gradient = g.has_translation && g.has_rotation;
    checker_compute_gradient(s->checker, p, g.gradient, s->q, list->gradients + at * list->variables);
}

// An overlap without its depth, where balls inside the bodies prove it.
static int take_overlap(near_search *s, const checker_pair *p, pair_name name) {
    ovoid_answer answer = {.status = OVOID_OVERLAPPING};
    if (pair_was_apart(s->checker, p) || !checker_prove_overlap(s->checker, name, &answer.lower, &answer.upper))
        return 0;
    if (!(upper_outward(p, answer.upper) < 0)) return 0;
    *p->near = s->checker->state;
    uint32_t slot = near_list_find_slot(&s->list, lower_outward(p, answer.lower));
    if (slot != NEAR_LIST_FULL) keep(s, slot, p, &answer, NULL);
    return 1;
}

// Memory for searches that fill their own, made by the first of them. 0 where there is none.
static int take_memory(ovoid_robot_checker *checker) {
    ovoid_cover *cover = &checker->cover;
    if (cover->memory) return 1;
    cover->size = ovoid_cover_get_size(OVOID_COVER_POINTS_MAX);
    cover->memory = allocator_allocate(&checker->allocator, cover->size, 1);
    return cover->memory != NULL;
}

static int ask_pair(void *context, const checker_pair *p, pair_name name) {
    near_search *s = context;
    uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    ovoid_cover own = {.memory = memory, .size = sizeof memory}, *cover = &own;
    ovoid_options options = {.cap = add_up(s->margin, p->padding, p->error)};
    if (!(options.cap > 0)) options.cap = OVOID_LENGTH_MIN;
    if (s->without_depths && take_overlap(s, p, name)) return 1;
    ovoid_answer answer = ovoid_depth(&p->pair, &options, pair_get_earlier(s->checker, p), cover);
    if (answer.limit == OVOID_LIMIT_CAPACITY && take_memory(s->checker)) {
        cover = &s->checker->cover;
        answer = ovoid_depth(&p->pair, &options, pair_get_earlier(s->checker, p), cover);
    }
    pair_remember(s->checker, p, &answer.proof);
    int asks_solids = sides_have_solid(&p->solids) && !(lower_outward(p, answer.lower) > s->margin);
    if (asks_solids) answer = solid_pair_distance(&p->pair, &p->solids, &options, &answer, pair_get_clear(p));
    double lower = lower_outward(p, answer.lower);
    if (lower > s->margin) return 1;
    *p->near = s->checker->state;
    uint32_t slot = near_list_find_slot(&s->list, lower);
    if (slot != NEAR_LIST_FULL) keep(s, slot, p, &answer, asks_solids ? NULL : cover);
    if (s->wants_one) s->margin = min2(s->margin, s->list.items[0].upper);
    return 1;
}

static const ovoid_robot_query_options *get_options(const ovoid_robot_query *query) {
    static const ovoid_robot_query_options none = {0, 0, 0, 0};
    return query->options ? query->options : &none;
}

// Places the state of a query, where there is room for what it finds.
static ovoid_code place(ovoid_robot_checker *checker, const ovoid_robot_query *query, ovoid_robot_nears *nears,
                        ovoid_error *error) {
    nears->count = 0;
    if (nears->capacity && !nears->items)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "there is no room for near pairs");
    ovoid_code code = query_options_validate(get_options(query), error);
    if (code == OVOID_OK) code = checker_renew(checker, error);
    return code == OVOID_OK ? checker_place(checker, query->q, get_options(query)->limit_slack, error) : code;
}

static void find(ovoid_robot_checker *checker, const ovoid_robot_query *query, ovoid_robot_nears *nears,
                 int wants_one) {
    const ovoid_robot_query_options *options = get_options(query);
    near_list list = {.items = nears->items,
                      .gradients = nears->gradients,
                      .variables = checker->cell->robot->variable_count,
                      .row = checker->near_row,
                      .capacity = wants_one ? 1 : nears->capacity,
                      .keys = checker->near_keys,
                      .scratch = checker->near_keys + checker_count_pairs(checker)};
    near_search s = {checker, query->q, list, options->margin, wants_one, nears->without_depths && !wants_one};
    checker_search search = {checker, options, &s.margin, ask_pair, &s, !wants_one};
    checker_find_pairs(&search);
    near_list_sort(&s.list);
    nears->count = wants_one ? s.list.kept : s.list.found;
}

static ovoid_code find_near(ovoid_robot_checker *checker, const ovoid_robot_query *query, ovoid_robot_nears *nears,
                            ovoid_error *error) {
    ovoid_code code = place(checker, query, nears, error);
    if (code == OVOID_OK) find(checker, query, nears, 0);
    return code;
}

static ovoid_code find_nearest(ovoid_robot_checker *checker, const ovoid_robot_query *query, ovoid_robot_nears *nears,
                               ovoid_error *error) {
    if (nears->capacity == 0) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "there is no room for a near pair");
    ovoid_code code = place(checker, query, nears, error);
    if (code == OVOID_OK) find(checker, query, nears, 1);
    return code;
}

ovoid_code ovoid_robot_find_near(ovoid_robot_checker *checker, const ovoid_robot_query *query, ovoid_robot_nears *nears,
                                 ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checker, find_near(checker, query, nears, error));
}

ovoid_code ovoid_robot_find_nearest(ovoid_robot_checker *checker, const ovoid_robot_query *query,
                                    ovoid_robot_nears *nears, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checker, find_nearest(checker, query, nears, error));
}
