// The alterations of test_compound_impact_altered and test_solid_impact_altered. True records of two moving bodies are
// altered one field at a time (alter.h), with their groups and steps, and others are forged: free for no time, a hit
// before the beginning, free by coarse steps of the balls around all leaves.
//
// The truth comes from other sources than the verification: distances of the bodies at sampled times, those of the
// deciding leaves at the hit, and a table of the pairs of leaves that the groups name. A record that these show to be
// false must be refused; other records may pass. Slack: the rounding of poses (docs/motion.md).
#ifndef OVOID_TESTS_BODY_IMPACT_LIAR_H
#define OVOID_TESTS_BODY_IMPACT_LIAR_H

#include "alter.h"
#include "options.h"

#include "ovoid/ovoid.h"

enum { LEAVES = 64, CAPACITY = 40000, SAMPLES = 24, TIMES = SAMPLES + 3 };
static ovoid_step steps[CAPACITY];
static ovoid_step_group groups[CAPACITY];

/// A posed shape for a query, and the shape to destroy after it, or NULL.
typedef struct leaf_shape {
    ovoid_posed_shape posed;
    ovoid_shape *own;
} leaf_shape;

typedef struct truth {
    ovoid_moving_body a, b;
    uint32_t count_a, count_b; ///< of leaves
    double margin, slack, begin, end;
    double times[TIMES], upper[TIMES];
    int count;
    ovoid_motion_options options;
    const ovoid_motion_options *told; ///< the options that the check receives, or NULL
    void *bodies;                     ///< of the test
} truth;

/// Given by the test: a leaf of body a (side 0) or b as a shape in the world at a time.
static leaf_shape make_leaf(const truth *t, int side, uint32_t leaf, double time);

static ovoid_body place(const ovoid_moving_body *m, double time) {
    return (ovoid_body){m->shape, m->compound, ovoid_motion_compute_pose(&m->motion, time), m->solid};
}
static ovoid_body_answer ask(const truth *t, double time) {
    ovoid_body_pair pair = {place(&t->a, time), place(&t->b, time)};
    return ovoid_body_distance(&pair, NULL, NULL);
}
static ovoid_answer ask_leaves(const truth *t, uint32_t leaf_a, uint32_t leaf_b, double time) {
    leaf_shape a = make_leaf(t, 0, leaf_a, time), b = make_leaf(t, 1, leaf_b, time);
    ovoid_pair pair = {a.posed.shape, b.posed.shape, a.posed.pose, b.posed.pose};
    ovoid_answer record = ovoid_depth(&pair, NULL, NULL, NULL);
    ovoid_shape_destroy(a.own);
    ovoid_shape_destroy(b.own);
    return record;
}

static void add_time(truth *t, double time) {
    if (!(time >= t->begin && time <= t->end)) return;
    t->times[t->count] = time;
    t->upper[t->count++] = ask(t, time).upper + t->slack;
}

// ---- the claims of records

// 1 if a pair of leaves is in no group or in two.
static int groups_are_false(const truth *t, size_t count) {
    static char table[LEAVES][LEAVES];
    memset(table, 0, sizeof table);
    for (size_t i = 0; i < count; i++) {
        const ovoid_step_group *g = &groups[i];
        if (g->first_a >= g->end_a || g->first_b >= g->end_b || g->end_a > t->count_a || g->end_b > t->count_b)
            return 1;
        for (uint32_t a = g->first_a; a < g->end_a; a++)
            for (uint32_t b = g->first_b; b < g->end_b; b++) table[a][b]++;
    }
    for (uint32_t a = 0; a < t->count_a; a++)
        for (uint32_t b = 0; b < t->count_b; b++)
            if (table[a][b] != 1) return 1;
    return 0;
}

// The truth of `hit`: at the beginning the bodies' answer, else that of the deciding leaves.
static int hit_is_false(const truth *t, const ovoid_body_impact *record) {
    const ovoid_answer *said = &record->impact.hit;
    ovoid_answer leaves = ask_leaves(t, record->part_a, record->part_b, record->impact.hit_at);
    double lower = leaves.lower, upper = leaves.upper;
    if (record->impact.hit_at <= record->impact.begin) {
        ovoid_body_answer bodies = ask(t, record->impact.hit_at);
        lower = fmin(lower, bodies.lower), upper = fmax(upper, bodies.upper);
        if (bodies.lower - t->slack > t->margin) return 1;
    } else if (leaves.lower - t->slack > t->margin) {
        return 1;
    }
    if (isnan(said->lower) || isnan(said->upper)) return 1;
    if (said->lower > upper + t->slack || said->upper < lower - t->slack) return 1;
    return said->status == OVOID_SEPARATED ? !(said->lower > 0)
                                           : said->status == OVOID_OVERLAPPING && !(said->upper < 0);
}

static int is_false(const truth *t, const ovoid_body_impact *found) {
    const ovoid_impact *impact = &found->impact;
    int hit = impact->status == OVOID_IMPACT_HIT, is_free = impact->status == OVOID_IMPACT_FREE;
    if (impact->limit >= OVOID_LIMIT_POSE_A && impact->limit <= OVOID_LIMIT_SHAPE_B)
        return impact->limit != OVOID_LIMIT_OPTIONS || impact->hit_at != INFINITY || impact->step_count ||
               found->group_count;
    if ((unsigned)impact->status > OVOID_IMPACT_HIT || (unsigned)impact->limit > OVOID_LIMIT_ALLOWANCE) return 1;
    if (found->part_a >= t->count_a || found->part_b >= t->count_b) return 1;
    if (!(impact->begin >= 0 && impact->end <= 1 && impact->begin <= impact->end)) return 1;
    if (!(impact->free_until >= impact->begin && impact->free_until <= impact->end)) return 1;
    if (hit ? !(impact->hit_at >= impact->free_until && impact->hit_at <= impact->end) : impact->hit_at != INFINITY)
        return 1;
    if (is_free && impact->free_until != impact->end) return 1;
    for (int i = 0; i < t->count; i++)
        if (t->times[i] >= impact->begin &&
            (t->times[i] < impact->free_until || (is_free && t->times[i] <= impact->end)))
            if (t->upper[i] <= t->margin) return 1;
    if (is_free && ask(t, impact->end).upper + t->slack <= t->margin) return 1;
    if (hit && hit_is_false(t, found)) return 1;
    return (impact->free_until > impact->begin || is_free) && groups_are_false(t, found->group_count);
}

// ---- alterations

static void tell(const truth *t, const ovoid_body_impact *record, alter_count *n) {
    ovoid_code code =
        ovoid_body_impact_verify(&(ovoid_moving_body_pair){t->a, t->b, t->margin}, record,
                                 &(ovoid_motion_basis){.options = t->told, .steps = steps, .groups = groups}, NULL);
    alter_take(n, is_false(t, record), code != OVOID_OK);
}

enum { FIELDS = 12, GROUP_FIELDS = 5, STEP_FIELDS = 5, FORGED = 7 };
static const alter_field fields[FIELDS] = {
    ALTER_FIELD(ovoid_body_impact, impact.status, ALTER_INT, 0),
    ALTER_FIELD(ovoid_body_impact, impact.limit, ALTER_INT, 0),
    ALTER_FIELD(ovoid_body_impact, impact.begin, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_body_impact, impact.end, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_body_impact, impact.free_until, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_body_impact, impact.hit_at, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_body_impact, impact.hit.status, ALTER_INT, 0),
    ALTER_FIELD(ovoid_body_impact, impact.hit.lower, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_body_impact, impact.hit.upper, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_body_impact, part_a, ALTER_U32, 0),
    ALTER_FIELD(ovoid_body_impact, part_b, ALTER_U32, 0),
    ALTER_FIELD(ovoid_body_impact, group_count, ALTER_SIZE, 0),
};
static const alter_field group_fields[GROUP_FIELDS] = {
    ALTER_FIELD(ovoid_step_group, first_a, ALTER_U32, 0), ALTER_FIELD(ovoid_step_group, end_a, ALTER_U32, 0),
    ALTER_FIELD(ovoid_step_group, first_b, ALTER_U32, 0), ALTER_FIELD(ovoid_step_group, end_b, ALTER_U32, 0),
    ALTER_FIELD(ovoid_step_group, count, ALTER_SIZE, 0),
};
static const alter_field step_fields[STEP_FIELDS] = {
    ALTER_FIELD(ovoid_step, until, ALTER_REAL, 1e-9),    ALTER_FIELD(ovoid_step, normal.x, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_step, normal.y, ALTER_REAL, 1e-9), ALTER_FIELD(ovoid_step, normal.z, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_step, frame, ALTER_INT, 0),
};
static alter_count counts[FIELDS], group_counts[GROUP_FIELDS], step_counts[STEP_FIELDS], forged_counts[FORGED];
static const alter_table table = ALTER_TABLE(fields, counts), group_table = ALTER_TABLE(group_fields, group_counts),
                         step_table = ALTER_TABLE(step_fields, step_counts);

static void lie_about(const truth *t, const ovoid_body_impact *right) {
    ovoid_motion_options half = {.begin = 0.25, .end = 0.75};
    ovoid_body_impact other = ovoid_body_impact_find(&(ovoid_moving_body_pair){t->a, t->b, t->margin}, &half),
                      record = *right;
    alter_walk w = alter_walk_make(&table, &record, sizeof record, &other);
    for (alter_count *n; (n = alter_next(&w));)
        if (record.group_count <= CAPACITY) tell(t, &record, n);
}

// Alters the first, the last and one group in between, and a step of each.
static void lie_about_groups(const truth *t, const ovoid_body_impact *right) {
    const size_t count = right->group_count, which[3] = {0, count / 2, count ? count - 1 : 0};
    for (int k = 0; k < 3 && count; k++) {
        alter_walk w =
            alter_walk_make(&group_table, &groups[which[k]], sizeof *groups, &groups[(which[k] + 1) % count]);
        for (alter_count *n; (n = alter_next(&w));) tell(t, right, n);
    }
    const ovoid_step first = steps[0];
    for (size_t i = 0; i < right->impact.step_count; i += 1 + right->impact.step_count / 4) {
        alter_walk w = alter_walk_make(&step_table, &steps[i], sizeof *steps, &first);
        for (alter_count *n; (n = alter_next(&w));) tell(t, right, n);
    }
}

// ---- forgeries

static void forge(const truth *t, const char *name, int which, const ovoid_body_impact *record) {
    alter_name = name;
    alter_way = "forged";
    tell(t, record, &forged_counts[which]);
}

// Free from begin to end by `count` steps of the balls around all leaves, along the bodies' normals.
static ovoid_body_impact make_free(const truth *t, double begin, double end, size_t count) {
    groups[0] = (ovoid_step_group){0, t->count_a, 0, t->count_b, count};
    for (size_t i = 0; i < count; i++) {
        double from = begin + (end - begin) * (double)i / (double)count;
        double until = i + 1 < count ? begin + (end - begin) * (double)(i + 1) / (double)count : end;
        steps[i] = (ovoid_step){until, ask(t, from).deciding.normal, OVOID_STEP_WORLD};
    }
    return (ovoid_body_impact){.impact = {.status = OVOID_IMPACT_FREE,
                                          .begin = begin,
                                          .end = end,
                                          .free_until = end,
                                          .hit_at = INFINITY,
                                          .step_count = count,
                                          .free = ask(t, end).deciding},
                               .group_count = 1};
}

// Groups of all pairs of single leaves, without steps.
static void leaf_groups(const truth *t, ovoid_body_impact *record) {
    record->group_count = 0;
    for (uint32_t a = 0; a < t->count_a; a++)
        for (uint32_t b = 0; b < t->count_b; b++)
            groups[record->group_count++] = (ovoid_step_group){a, a + 1, b, b + 1, 0};
}

// Replaces a pair of groups by a copy of another, with its steps.
static void forge_twice(const truth *t, const ovoid_body_impact *right) {
    size_t at_i = 0, stride = 1 + right->group_count / 50 * 6; // a part of many groups

    for (size_t i = 0; i < right->group_count; at_i += groups[i++].count) {
        size_t at_j = 0;
        for (size_t j = 0; j < right->group_count; at_j += groups[j++].count) {
            ovoid_step_group before = groups[i], other = groups[j];
            ovoid_step kept[8];
            uint32_t area = (before.end_a - before.first_a) * (before.end_b - before.first_b);
            if (i == j || i % stride || j % stride || before.count != other.count || before.count > 8) continue;
            if (area != (other.end_a - other.first_a) * (other.end_b - other.first_b)) continue;
            memcpy(kept, steps + at_i, before.count * sizeof *kept);
            memcpy(steps + at_i, steps + at_j, before.count * sizeof *kept);
            groups[i] = other;
            forge(t, "a group said twice", 4, right);
            groups[i] = before;
            memcpy(steps + at_i, kept, before.count * sizeof *kept);
        }
    }
}

// Claims any two leaves at any time as a hit.
static void forge_hits(const truth *t) {
    for (int i = 0; i < t->count; i++) {
        ovoid_body_impact record = {.impact = {.status = OVOID_IMPACT_HIT, .begin = t->begin, .end = t->end}};
        record.part_a = (uint32_t)i % t->count_a;
        record.part_b = (uint32_t)i % t->count_b;
        record.impact.free_until = t->begin;
        record.impact.hit_at = t->times[i];
        record.impact.hit = ask_leaves(t, record.part_a, record.part_b, t->times[i]);
        forge(t, "a hit that is none", 5, &record);
    }
}

// Claims a larger margin than that of the query.
static void forge_margins(const truth *t, const ovoid_body_impact *right) {
    truth larger = *t;
    double least = INFINITY;
    for (int i = 0; i < t->count; i++)
        if (t->times[i] < right->impact.free_until) least = fmin(least, t->upper[i]);
    for (double by = 1e-9; by < 10 && least < INFINITY; by *= 10) {
        larger.margin = least + by;
        forge(&larger, "a larger margin", 6, right);
    }
}

// For a body that is refused, only that reason is right, and nothing else may be claimed.
static void forge_refusals(const truth *t) {
    ovoid_moving_body none = {.motion = t->b.motion};
    ovoid_body_impact right = ovoid_body_impact_find(&(ovoid_moving_body_pair){t->a, none, t->margin}, &t->options),
                      record = right;
    CHECK_EQ(ovoid_body_impact_verify(&(ovoid_moving_body_pair){t->a, none, t->margin}, &record,
                                      &(ovoid_motion_basis){.options = t->told}, NULL),
             OVOID_OK);
    record.impact.hit_at = 0.5;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){t->a, none, t->margin}, &record,
                                   &(ovoid_motion_basis){.options = t->told}, NULL) != OVOID_OK);
    record = right;
    record.impact.limit = OVOID_LIMIT_SHAPE_A;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){t->a, none, t->margin}, &record,
                                   &(ovoid_motion_basis){.options = t->told}, NULL) != OVOID_OK);
    record = right;
    record.impact.limit = OVOID_LIMIT_OPTIONS;
    CHECK_EQ(ovoid_body_impact_verify(&(ovoid_moving_body_pair){t->a, t->b, -1}, &record,
                                      &(ovoid_motion_basis){.options = t->told}, NULL),
             OVOID_OK);
    record.group_count = 1;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){t->a, t->b, -1}, &record,
                                   &(ovoid_motion_basis){.options = t->told, .groups = groups}, NULL) != OVOID_OK);
}

static void forge_all(const truth *t, const ovoid_body_impact *right) {
    forge_twice(t, right);
    forge_margins(t, right);
    forge_hits(t);
    forge_refusals(t);
    for (int i = 0; i < t->count; i++) {
        ovoid_body_impact record = make_free(t, t->times[i], t->times[i], 0);
        forge(t, "free for no time", 0, &record);
        leaf_groups(t, &record);
        forge(t, "free for no time, leaf by leaf", 0, &record);
        record = make_free(t, t->times[i], t->times[i], 1);
        forge(t, "free for no time by a step", 0, &record);
    }
    for (size_t count = 1; count <= 64 && t->begin < t->end; count *= 4) {
        ovoid_body_impact record = make_free(t, t->begin, t->end, count);
        forge(t, "coarse steps", 1, &record);
    }
    if (right->impact.status != OVOID_IMPACT_HIT) return;
    ovoid_body_impact record = *right;
    record.impact.begin = record.impact.free_until = 0.5 * (record.impact.hit_at + record.impact.end);
    forge(t, "hit before the beginning", 2, &record);
    record = *right;
    record.impact.begin = record.impact.end = record.impact.free_until = 0.5 * record.impact.hit_at;
    record.impact.status = OVOID_IMPACT_UNDECIDED;
    forge(t, "undecided, with a hit after the end", 3, &record);
}

// ---- cases

/// Times and options of a case, whose bodies are made.
static void set_times(truth *t, uint64_t seed) {
    t->begin = seed % 4 == 1 ? 0.3 : 0;
    t->end = seed % 5 == 1 ? t->begin = 0.4 : 1;
    t->options = (ovoid_motion_options){.begin = t->begin,
                                        .end = t->end,
                                        .steps = steps,
                                        .capacity = CAPACITY,
                                        .groups = groups,
                                        .group_capacity = CAPACITY};
    t->told = (seed / 2) % 2 ? NULL : &t->options;
}

static void try_case(truth *t, uint64_t seed) {
    uint64_t s = seed;
    ovoid_body_impact right = ovoid_body_impact_find(&(ovoid_moving_body_pair){t->a, t->b, t->margin}, &t->options);
    ovoid_error error;
    if (!CHECK_EQ(ovoid_body_impact_verify(&(ovoid_moving_body_pair){t->a, t->b, t->margin}, &right,
                                           &(ovoid_motion_basis){.options = t->told, .steps = steps, .groups = groups},
                                           &error),
                  OVOID_OK))
        printf("  %s\n", error.message);
    add_time(t, t->begin);
    add_time(t, t->end);
    if (right.impact.status == OVOID_IMPACT_HIT) add_time(t, right.impact.hit_at);
    for (int i = 0; i < SAMPLES; i++) add_time(t, t->begin + (t->end - t->begin) * random_uniform(&s, 0, 1));
    CHECK(!is_false(t, &right));
    lie_about(t, &right);
    lie_about_groups(t, &right);
    forge_all(t, &right);
}

/// The whole test: cases by make, which are destroyed again.
static int run_cases(int count, char **arguments, uint64_t cases, void (*make)(truth *t, uint64_t seed),
                     void (*destroy)(truth *t)) {
    uint64_t first = 1;
    const test_option options[] = {{"seed", "of the first case (1)", &first, NULL, NULL, NULL},
                                   {"cases", "how many", &cases, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    static truth t;
    for (uint64_t seed = first; seed < first + cases; seed++) {
        check_seed = seed;
        make(&t, seed);
        try_case(&t, seed);
        destroy(&t);
    }
    check_seed = 0;
    alter_print_table(&table);
    alter_print_table(&group_table);
    alter_print_table(&step_table);
    const char *const names[FORGED] = {"free for no time",  "coarse steps", "hit before the beginning",
                                       "hit after the end", "twice",        "a hit that is none",
                                       "a larger margin"};
    for (int i = 0; i < FORGED; i++) alter_print(names[i], &forged_counts[i]);
    return check_end();
}

#endif
