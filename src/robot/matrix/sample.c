// Random states of a matrix: for each, which pairs are hit and which are proven apart. States are a function of seed
// and number alone: G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, 2014.
#include "base/error.h"
#include "base/watch.h"
#include "robot/cell/checker.h"
#include "robot/matrix/matrix.h"
#include "tools/random.h"

// What is known of a pair of links in the state that is looked at.
typedef struct pair_mark {
    size_t hit, open; ///< the number of the last state, from 1, that was a hit, or was not decided
    size_t opens;     ///< how many were not decided
} pair_mark;

typedef struct sampler {
    matrix_work *work;
    ovoid_robot_checker *checker;
    pair_mark *marks; ///< of each pair of groups
    uint32_t *owner;  ///< of each pair of items: its pair of groups
    double *q;        ///< of a group of lanes
    uint32_t *unseen; ///< pairs of groups that were not yet seen apart
    size_t unseen_count;
    uint64_t random;
    size_t state;      ///< the number of the state that is looked at, from 1
    const double *now; ///< it
    ovoid_code code;
} sampler;

static void draw_state(sampler *s, double *q) {
    const matrix_work *w = s->work;
    for (uint32_t i = 0; i < w->cell->robot->variable_count; i++) {
        double share = random_share(&s->random);
        q[i] = min2(w->low[i] + share * (w->high[i] - w->low[i]), w->high[i]);
    }
}

static ovoid_robot_matrix_pair *get_pair(const sampler *s, uint32_t both) {
    return &s->work->matrix->pairs[s->work->of_group_pair[both]];
}

static void take_hit(sampler *s, uint32_t both) {
    pair_mark *mark = &s->marks[both];
    ovoid_robot_matrix_pair *p = get_pair(s, both);
    if (mark->hit == s->state) return;
    mark->hit = s->state;
    mark->opens -= mark->open == s->state;
    p->hits++;
    ovoid_code code = matrix_keep_state(s->work, &p->hit, s->now);
    if (code != OVOID_OK) s->code = code;
}

static void take_open(const sampler *s, uint32_t both) {
    pair_mark *mark = &s->marks[both];
    mark->opens += mark->open != s->state;
    mark->open = s->state;
}

// What lies inside both bodies proves most hits; it is asked where the pair was not apart in the last state.
static int is_overlap_proven(const sampler *s, const checker_pair *p, pair_name name) {
    double lower, upper;
    return !pair_was_apart(s->checker, p) && checker_prove_overlap(s->checker, name, &lower, &upper) &&
           upper_outward(p, upper) <= 0;
}

// What the boxes leave; what they do not is apart.
static int ask_pair(void *context, const checker_pair *p, pair_name name) {
    sampler *s = context;
    uint32_t both = s->owner[name.index];
    if (s->marks[both].hit == s->state || is_overlap_proven(s, p, name)) {
        take_hit(s, both);
        return 1;
    }
    ovoid_answer answer = ovoid_within(&p->pair, p->error, NULL, pair_get_earlier(s->checker, p));
    pair_remember(s->checker, p, &answer.proof);
    if (sides_have_solid(&p->solids) && !(answer.lower > p->error)) {
        answer.upper = solid_sides_raise(&p->solids, answer.upper);
        if (!(upper_outward(p, answer.upper) <= 0))
            answer = solid_pair_within(&p->pair, &p->solids, p->error, &answer, p->error);
    }
    if (answer.lower > p->error) return 1;
    if (upper_outward(p, answer.upper) <= 0)
        take_hit(s, both);
    else
        take_open(s, both);
    return 1;
}

// Keeps the state with the pairs that are seen apart for the first time: those neither hit nor open.
static void keep_frees(sampler *s) {
    size_t kept = 0;
    for (size_t i = 0; i < s->unseen_count; i++) {
        uint32_t both = s->unseen[i];
        if (s->marks[both].hit == s->state || s->marks[both].open == s->state) {
            s->unseen[kept++] = both;
            continue;
        }
        ovoid_code code = matrix_keep_state(s->work, &get_pair(s, both)->free, s->now);
        if (code != OVOID_OK) s->code = code;
    }
    s->unseen_count = kept;
}

static void count_frees(const sampler *s) {
    for (uint32_t i = 0; i < s->work->cell->group_pairs.count; i++) {
        ovoid_robot_matrix_pair *p = get_pair(s, i);
        p->samples = s->state;
        p->frees = s->state - p->hits - s->marks[i].opens;
    }
}

static const ovoid_robot_query_options links_alone = {.margin = 0, .without_obstacles = 1};

static void look_at_state(sampler *s) {
    checker_search search = {s->checker, &links_alone, &links_alone.margin, ask_pair, s, 0};
    s->state++;
    checker_find_pairs(&search);
    keep_frees(s);
}

static void look_at_all(sampler *s) {
    size_t variables = s->work->cell->robot->variable_count, samples = s->work->options.samples;
    const ovoid_watch *watch = &s->work->options.watch;
    for (size_t i = 0; i < samples && s->code == OVOID_OK && !watch_is_stopped(watch); i += ROBOT8) {
        lane_state states[ROBOT8];
        size_t count = samples - i < ROBOT8 ? samples - i : ROBOT8;
        for (size_t k = 0; k < count; k++) draw_state(s, s->q + k * variables);
        checker_place_lanes(s->checker, s->q, count, 0, states);
        checker_filter_lanes(s->checker, &links_alone);
        for (uint32_t k = 0; k < count && s->code == OVOID_OK; k++) {
            if (states[k].code != OVOID_OK) continue; // a follower is outside its limits, or beyond all lengths
            checker_take_lane(s->checker, k, &states[k]);
            s->now = s->q + k * variables;
            look_at_state(s);
        }
    }
}

static void begin(sampler *s) {
    const ovoid_robot_cell *c = s->work->cell;
    for (uint32_t i = 0; i < c->group_pairs.count; i++) {
        const group_pair *p = &cell_group_pairs(c)[i];
        for (uint32_t k = p->first; k < p->end; k++) s->owner[k] = i;
        s->marks[i] = (pair_mark){0, 0, 0};
        s->unseen[i] = i;
    }
    s->unseen_count = c->group_pairs.count;
}

ovoid_code matrix_sample(matrix_work *w, ovoid_error *error) {
    const ovoid_robot_cell *c = w->cell;
    const ovoid_allocator *memory = &w->allocator;
    sampler s = {.work = w, .random = w->options.seed, .code = OVOID_ERROR_MEMORY};
    s.marks = allocator_allocate(memory, c->group_pairs.count, sizeof *s.marks);
    s.unseen = allocator_allocate(memory, c->group_pairs.count, sizeof *s.unseen);
    s.owner = allocator_allocate(memory, c->pairs.count, sizeof *s.owner);
    s.q = allocator_allocate(memory, ROBOT8 * (size_t)c->robot->variable_count, sizeof *s.q);
    s.checker = ovoid_robot_checker_create(c, &(ovoid_robot_checker_options){memory}, NULL);
    if (s.marks && s.unseen && s.owner && s.q && s.checker) {
        s.code = OVOID_OK;
        begin(&s);
        look_at_all(&s);
        count_frees(&s);
    }
    ovoid_robot_checker_destroy(s.checker);
    void *all[] = {s.marks, s.unseen, s.owner, s.q};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) allocator_release(memory, all[i]);
    return s.code == OVOID_OK ? OVOID_OK : error_set(error, s.code, -1, "no memory for the states of a matrix");
}
