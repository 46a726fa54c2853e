// Trials of the query floor: pairs of every kind of trouble, by family, every answer of every query put before the
// exact judge (GMP), which trusts nothing but the vertices and the poses. Truth: exact arithmetic; where a pair is
// built so, its distance by construction; and of small bodies brute force over all features. No tolerance is involved
// but the judge's for witness points (their rounding). trials/families.c has the families.
// Without options: the first rounds of seed 1, so that every run sees the same pairs.
//   --seconds S   as many rounds as that takes; a line each minute; Ctrl-C ends after the present round
//   --state FILE  what was done so far, read at the start and written each minute and at the end: the run goes on.
//                 Failures are appended to FILE.failures at once
//   --seed N; --rounds N; --family NAME (only this); --trial SEED with a family: one trial again
#include "check.h"
#include "options.h"
#include "trials/families.h"
#include "trials/shapes.h"

#include <signal.h>

#define ROUNDS 100

typedef struct soak {
    uint64_t seed, rounds; // rounds done
    double seconds;
    const char *state, *only;
} soak;

static volatile sig_atomic_t stop;
static void on_signal(int number) {
    (void)number;
    stop = 1;
}

// --- one trial

// Proofs of pairs that no trial has, for warm starts that do not fit. The same in every run.
#define FOREIGN 32
static ovoid_proof foreign[FOREIGN];

static void fill_foreign(void) {
    uint64_t r = 7;
    for (int i = 0; i < FOREIGN; i++) {
        ovoid_shape *a = make_any(&r), *b = make_any(&r);
        trial t = place_anywhere(&r, a, b);
        ovoid_pair pair = {t.a, t.b, t.pose_a, t.pose_b};
        ovoid_answer x = i % 2 ? ovoid_collide(&pair, NULL, NULL) : ovoid_depth(&pair, NULL, NULL, NULL);
        foreign[i] = x.proof;
        ovoid_shape_destroy(t.a);
        ovoid_shape_destroy(t.b);
    }
}

static void move(trial *t, uint64_t *r) {
    double size = sphere_radius(t->a) + sphere_radius(t->b);
    ovoid_vec3 d = random_vec3(r, 0.01 * size), *p = &t->pose_b.position;
    ovoid_quat *q = &t->pose_b.rotation;
    double norm = sqrt(q->w * q->w + q->x * q->x + q->y * q->y + q->z * q->z);
    *p = (ovoid_vec3){p->x + d.x, p->y + d.y, p->z + d.z};
    q->w += 0.01 * norm * random_normal(r);
    q->x += 0.01 * norm * random_normal(r);
}

// What is known of the pair: by construction, or by brute force.
static const judge_truth *find_truth(const family *f, const trial *t, const ovoid_pair *pair, judge_truth *truth) {
    if (t->is_known) {
        *truth = (judge_truth){.sign = (t->d > 0) - (t->d < 0), .low = t->d, .high = t->d};
        return truth;
    }
    return f->judged && judge_compute_truth(trial_judge, pair, truth, NULL) == OVOID_OK ? truth : NULL;
}

// Which proof a frame's warm queries are given. proofs: of the frames before.
static const ovoid_proof *choose_earlier(const family *f, const ovoid_proof *proofs, int frame, uint64_t *r) {
    const ovoid_proof *other = &foreign[random_next(r) % FOREIGN];
    if (f->earlier == EARLIER_FOREIGN || frame == 0) return other;
    return f->earlier == EARLIER_STALE && frame >= 4 ? &proofs[frame - 4] : &proofs[frame - 1];
}

static void run_trial(family *f, uint64_t seed) {
    ovoid_proof proofs[16];
    uint64_t r = trial_seed = seed;
    trial t = f->make(&r);
    if (!t.a) return;
    for (int i = 0; i < (f->frames ? f->frames : 1); i++) {
        ovoid_pair pair = {t.a, t.b, t.pose_a, t.pose_b};
        judge_truth truth;
        trial_hints hints = {choose_earlier(f, proofs, i, &r), f->earlier == EARLIER_ANY ? WARM_ANY : WARM_GIVEN,
                             find_truth(f, &t, &pair, &truth)};
        proofs[i] = trial_ask(&f->counts, &pair, &hints, &r);
        move(&t, &r);
        t.is_known = 0;
    }
    ovoid_shape_destroy(t.a);
    ovoid_shape_destroy(t.b);
    judge_forget(trial_judge);
}

// Every family, each trial with a seed of its own.
static void run_round(soak *s) {
    for (size_t i = 0; i < family_count; i++)
        for (int k = 0; k < (families[i].each ? families[i].each : 1); k++) {
            if (s->only && strcmp(s->only, families[i].counts.name) != 0) continue;
            uint64_t state = s->seed + 1000003 * s->rounds + i + 1009 * (uint64_t)k;
            run_trial(&families[i], random_next(&state));
        }
    s->rounds++;
}

// --- the state: a line of the run's own, then a line a family

static void write_state(const soak *s) {
    char part[1024];
    if (!s->state) return;
    snprintf(part, sizeof part, "%s.part", s->state);
    FILE *f = fopen(part, "w");
    if (!f) {
        printf("cannot write %s\n", part);
        return;
    }
    fprintf(f, "ovoid soak 1, seed %llu, rounds %llu\n", (unsigned long long)s->seed, (unsigned long long)s->rounds);
    for (size_t i = 0; i < family_count; i++) {
        const tally *t = &families[i].counts;
        fprintf(f, "%llu %llu %llu %llu %llu %llu %llu %llu %llu %llu %llu %.17g %s\n", (unsigned long long)t->pairs,
                (unsigned long long)t->answers, (unsigned long long)t->separated, (unsigned long long)t->touching,
                (unsigned long long)t->overlapping, (unsigned long long)t->undecided, (unsigned long long)t->wide,
                (unsigned long long)t->compared, (unsigned long long)t->wrong, (unsigned long long)t->iterations,
                (unsigned long long)t->opened, t->widest, t->name);
    }
    int written = ferror(f) == 0;
    written &= fclose(f) == 0;
    if (!written || rename(part, s->state) != 0) printf("cannot write %s\n", s->state);
}

static int read_tally(FILE *f, tally *t) {
    unsigned long long n[11];
    char name[128];
    for (int i = 0; i < 11; i++)
        if (fscanf(f, "%llu", &n[i]) != 1) return 0;
    if (fscanf(f, "%lg %127[^\n]", &t->widest, name) != 2 || strcmp(name, t->name) != 0) return 0;
    t->pairs = n[0], t->answers = n[1], t->separated = n[2], t->touching = n[3], t->overlapping = n[4];
    t->undecided = n[5], t->wide = n[6], t->compared = n[7], t->wrong = n[8], t->iterations = n[9], t->opened = n[10];
    return 1;
}

// 1 if there is no state yet, or all of it was read.
static int read_state(soak *s) {
    FILE *f = s->state ? fopen(s->state, "r") : NULL;
    if (!f) return 1;
    unsigned long long seed, rounds;
    int ok = fscanf(f, "ovoid soak 1, seed %llu, rounds %llu", &seed, &rounds) == 2;
    for (size_t i = 0; i < family_count && ok; i++) ok = read_tally(f, &families[i].counts);
    fclose(f);
    if (!ok) {
        printf("%s is not a state of this program; remove it to begin anew\n", s->state);
        return 0;
    }
    s->seed = seed;
    s->rounds = rounds;
    printf("going on after %llu rounds of seed %llu\n", rounds, seed);
    return 1;
}

// --- the run

static tally sum_all(void) {
    tally all = {.name = "all"};
    for (size_t i = 0; i < family_count; i++) tally_add(&all, &families[i].counts);
    return all;
}

static void print_progress(const soak *s, double elapsed, const tally *before) {
    tally all = sum_all();
    printf(
        "%.1f min, seed %llu, round %llu: %llu answers (%.0f a second), %llu pairs, open %llu, wide %llu, wrong %llu\n",
        elapsed / 60, (unsigned long long)s->seed, (unsigned long long)s->rounds, (unsigned long long)all.answers,
        (double)(all.answers - before->answers) / elapsed, (unsigned long long)all.pairs,
        (unsigned long long)all.undecided, (unsigned long long)all.wide, (unsigned long long)all.wrong);
    fflush(stdout);
}

// seconds 0: up to the number of rounds.
static void run_all(soak *s, uint64_t rounds) {
    tally before = sum_all();
    double start = seconds_now(), next = 60;
    while (!stop && (s->seconds > 0 ? seconds_now() - start < s->seconds : s->rounds < rounds)) {
        run_round(s);
        double elapsed = seconds_now() - start;
        if (elapsed < next) continue;
        next += 60;
        write_state(s);
        print_progress(s, elapsed, &before);
    }
    write_state(s);
    print_progress(s, seconds_now() - start, &before);
}

// Poses and options that are none: refused by every query, and the judge agrees.
static void test_refusals(void) {
    ovoid_shape *box = make_box(1, 1, 1, 0);
    const ovoid_pose good = {{0, 0, 0}, {1, 0, 0, 0}};
    const ovoid_pose bad[] = {
        {{NAN, 0, 0}, {1, 0, 0, 0}}, {{0, INFINITY, 0}, {1, 0, 0, 0}}, {{0, 0, 2 * OVOID_LENGTH_MAX}, {1, 0, 0, 0}},
        {{0, 0, 0}, {0, 0, 0, 0}},   {{0, 0, 0}, {1, NAN, 0, 0}},      {{0, 0, 0}, {1, 0, 0, -INFINITY}}};
    for (size_t i = 0; i < 2 * sizeof bad / sizeof *bad; i++) {
        ovoid_pair pair = {box, box, i % 2 ? bad[i / 2] : good, i % 2 ? good : bad[i / 2]};
        const ovoid_answer all[] = {ovoid_collide(&pair, NULL, NULL), ovoid_within(&pair, 1, NULL, NULL),
                                    ovoid_distance(&pair, NULL, NULL), ovoid_depth(&pair, NULL, NULL, NULL),
                                    ovoid_pair_compute_bounds(&pair)};
        for (int k = 0; k < 5; k++) {
            CHECK_EQ(all[k].limit, i % 2 ? OVOID_LIMIT_POSE_A : OVOID_LIMIT_POSE_B);
            CHECK_EQ(judge_verify_answer(trial_judge, &pair, &all[k], NULL, NULL), OVOID_OK);
        }
    }
    ovoid_shape_destroy(box);
    judge_forget(trial_judge);
}

static void print_table(const soak *s) {
    tally all = sum_all();
    printf("seed %llu, %llu rounds\n", (unsigned long long)s->seed, (unsigned long long)s->rounds);
    tally_print_header();
    for (size_t i = 0; i < family_count; i++) {
        if (families[i].counts.pairs) tally_print(&families[i].counts);
        int has_no_data = families[i].make == make_real_hulls || families[i].make == make_compound_parts;
        if (s->rounds && !s->only && has_no_data && !families[i].counts.pairs)
            check_skip("real hulls or compounds: not in the data folder (OVOID_DATA)");
    }
    tally_print(&all);
    check_passed += (long)(all.answers - all.wrong);
    check_failed += (long)all.wrong;
}

static void run_named(const char *name, uint64_t seed) {
    for (size_t i = 0; i < family_count; i++)
        if (strcmp(name, families[i].counts.name) == 0) run_trial(&families[i], seed);
}

/// Trials that failed once: a common point of an overlap of 1e-14, in a tetrahedron that is a needle.
static void run_once_failed(void) { run_named("near-coplanar", 9537145888130744208u); }

int main(int count, char **arguments) {
    soak s = {.seed = 1};
    uint64_t one = 0, rounds = ROUNDS;
    const test_option options[] = {{"seconds", "goes on for so long", NULL, &s.seconds, NULL, NULL},
                                   {"seed", "of the first trial (1)", &s.seed, NULL, NULL, NULL},
                                   {"rounds", "trials of each family", &rounds, NULL, NULL, NULL},
                                   {"state", "a file: goes on where it stopped", NULL, NULL, &s.state, NULL},
                                   {"family", "this one alone", NULL, NULL, &s.only, NULL},
                                   {"trial", "with --family: the trial of this seed alone", &one, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    static char failures[1024];
    if (s.state) {
        snprintf(failures, sizeof failures, "%s.failures", s.state);
        trial_failures = failures;
    }
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
    trial_judge = judge_create();
    if (!CHECK(trial_judge != NULL)) return check_end();
    test_refusals();
    fill_foreign();
    if (one && s.only) {
        run_named(s.only, one);
    } else if (read_state(&s)) {
        if (count == 1) run_once_failed();
        run_all(&s, rounds);
    } else {
        return 2;
    }
    judge_destroy(trial_judge);
    families_forget_data();
    print_table(&s);
    return check_end();
}
