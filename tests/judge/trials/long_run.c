// long_run: at least 10^9 queries, each answer checked by its proof, 10^6 of them by exact arithmetic; 0 wrong ones are
// expected, and the exit status says so. Truth: ovoid_answer_verify and the judge; long_block.c says what else.
//   --queries N (1e9)    stop when so many are done in all, earlier runs included
//   --seconds S (0)      stop after so many; 0: never
//   --threads T (1), --sample N (1000: one answer of so many goes before the judge), --seed N (1)
//   --state FILE         read at the start if it exists, written each minute and at the end: the run goes on
//   --family NAME, --block N   this block again, and nothing else; open and wide answers are shown too
// Ctrl-C ends the run after the present blocks, and saves. Failures go to the output and, at once, to FILE.failures.
#include "long_run.h"
#include "options.h"

#include "check.h"
#include "report.h"

#include <signal.h>
#include <string.h>
#include <threads.h>
#include <time.h>

#define FAMILIES_MOST 64

typedef struct long_run {
    uint64_t seed, target, sample, begun; // begun: blocks handed out, all of them done when the state is written
    double seconds, start;
    const char *state, *family;
    clouds clouds;
    uint32_t schedule[4096], schedule_count; // families by share, mixed
    counts counts[FAMILIES_MOST];
    uint64_t queries, printed;
    int is_over;
    mtx_t lock;
} long_run;

static volatile sig_atomic_t stop;
static void on_signal(int number) {
    (void)number;
    stop = 1;
}

static double now_seconds(void) {
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// --- which family a block is of

// Each family as often as its share; a family whose data are absent not at all. Mixed, so that short runs see all.
static void fill_schedule(long_run *run) {
    for (uint32_t i = 0; i < long_family_count; i++) {
        const long_family *f = &long_families[i];
        if (!f->make && run->clouds.count == 0) {
            printf("skipped: %s: pieces/game_hulls.bin is not in the data folder (OVOID_DATA)\n", f->name);
            continue;
        }
        for (uint32_t k = 0; k < f->share; k++) run->schedule[run->schedule_count++] = i;
    }
    uint64_t r = 1;
    for (uint32_t i = run->schedule_count - 1; i > 0; i--) {
        uint32_t k = (uint32_t)(random_next(&r) % (i + 1)), t = run->schedule[i];
        run->schedule[i] = run->schedule[k];
        run->schedule[k] = t;
    }
}

static uint64_t find_block_seed(uint64_t seed, uint64_t block) {
    uint64_t r = seed;
    uint64_t mixed = random_next(&r) ^ (block * 0x9e3779b97f4a7c15u);
    return random_next(&mixed);
}

// --- the state file: a line of the run's own, then a line for each family that ran, numbers as in counts

static void write_counts(FILE *f, const char *name, const counts *c) {
    const uint64_t *x = (const uint64_t *)c;
    fprintf(f, "%s\n", name);
    for (size_t i = 0; i < sizeof *c / sizeof *x; i++) fprintf(f, " %llu", (unsigned long long)x[i]);
    fprintf(f, "\n");
}

// Whole or not at all: written beside, then renamed. With the lock held.
static void write_state(const long_run *run) {
    char part[1024];
    if (!run->state) return;
    snprintf(part, sizeof part, "%s.part", run->state);
    FILE *f = fopen(part, "w");
    if (!f) {
        printf("cannot write %s\n", part);
        return;
    }
    fprintf(f, "ovoid long run 2, seed %llu, schedule %u, blocks %llu\n", (unsigned long long)run->seed,
            run->schedule_count, (unsigned long long)run->begun);
    for (size_t i = 0; i < long_family_count; i++)
        if (run->counts[i].blocks) write_counts(f, long_families[i].name, &run->counts[i]);
    int written = ferror(f) == 0;
    written &= fclose(f) == 0;
    if (!written || rename(part, run->state) != 0) printf("cannot write %s\n", run->state);
}

static int read_counts(FILE *f, counts *c) {
    uint64_t *x = (uint64_t *)c;
    for (size_t i = 0; i < sizeof *c / sizeof *x; i++) {
        unsigned long long value;
        if (fscanf(f, "%llu", &value) != 1) return 0;
        x[i] = value;
    }
    return fgetc(f) == '\n';
}

// 1 if there is no state yet, or all of it was read.
static int read_state(long_run *run) {
    FILE *f = run->state ? fopen(run->state, "r") : NULL;
    if (!f) return 1;
    unsigned long long seed, blocks;
    unsigned schedule;
    char name[128];
    int ok = fscanf(f, "ovoid long run 2, seed %llu, schedule %u, blocks %llu\n", &seed, &schedule, &blocks) == 3;
    ok = ok && schedule == run->schedule_count;
    while (ok && fgets(name, sizeof name, f)) {
        name[strcspn(name, "\n")] = 0;
        size_t i = 0;
        while (i < long_family_count && strcmp(long_families[i].name, name) != 0) i++;
        ok = i < long_family_count && read_counts(f, &run->counts[i]);
        if (ok) run->queries += run->counts[i].queries;
    }
    fclose(f);
    if (!ok) {
        printf("%s is not a state of this program with these families\n", run->state);
        return 0;
    }
    run->seed = seed;
    run->begun = blocks;
    printf("going on: seed %llu, %llu blocks, %.4g queries done\n", seed, blocks, (double)run->queries);
    return 1;
}

// --- failures (and, where one block is run again, answers that are open or wide)

static void report(void *context, const long_family *f, uint64_t block, const ovoid_pair *pair, const ovoid_answer *x,
                   const char *question, const char *why) {
    long_run *run = context;
    mtx_lock(&run->lock);
    if (run->printed++ < 1000) {
        printf("SEEN %s, block %llu, seed %llu, %s: %s\n", f->name, (unsigned long long)block,
               (unsigned long long)run->seed, question, why);
        print_answer(stdout, x);
        if (run->printed <= 4) print_pair(stdout, pair);
        fflush(stdout);
        char path[1024];
        snprintf(path, sizeof path, "%s.failures", run->state ? run->state : "");
        FILE *out = run->state ? fopen(path, "a") : NULL;
        if (out) {
            fprintf(out, "%s, block %llu, seed %llu, %s: %s\n", f->name, (unsigned long long)block,
                    (unsigned long long)run->seed, question, why);
            print_answer(out, x);
            print_pair(out, pair);
            fclose(out);
        }
    }
    mtx_unlock(&run->lock);
}

// --- running

static void sum_all(const long_run *run, counts *all) {
    memset(all, 0, sizeof *all);
    for (size_t i = 0; i < long_family_count; i++) counts_add(all, &run->counts[i]);
}

// The next block's number and family, or 0 where the run is over.
static int take_block(long_run *run, uint64_t *number, uint32_t *family) {
    mtx_lock(&run->lock);
    int over = stop || run->queries >= run->target || (run->seconds > 0 && now_seconds() - run->start >= run->seconds);
    if (!over) {
        *number = run->begun++;
        *family = run->schedule[*number % run->schedule_count];
        // What is handed out counts at once, so that several threads stop at the target.
        run->queries += BLOCK_QUERIES;
    }
    mtx_unlock(&run->lock);
    return !over;
}

static int work_on(void *context) {
    long_run *run = context;
    uint64_t number;
    uint32_t family;
    judge *j = judge_create();
    if (!j) abort();
    while (take_block(run, &number, &family)) {
        counts c = {0};
        block_run block = {.family = &long_families[family],
                           .number = number,
                           .seed = find_block_seed(run->seed, number),
                           .sample = run->sample,
                           .clouds = &run->clouds,
                           .judge = j,
                           .report = report,
                           .context = run};
        block_execute(&block, &c);
        mtx_lock(&run->lock);
        counts_add(&run->counts[family], &c);
        mtx_unlock(&run->lock);
    }
    judge_destroy(j);
    return 0;
}

static void print_progress(long_run *run, uint64_t at_start) {
    counts all;
    mtx_lock(&run->lock);
    sum_all(run, &all);
    double elapsed = now_seconds() - run->start;
    printf("%.1f min, seed %llu: %llu queries (%.3g a second), %llu before the judge, open %llu, wide %llu, vague "
           "%llu, wrong %llu\n",
           elapsed / 60, (unsigned long long)run->seed, (unsigned long long)all.queries,
           (double)(all.queries - at_start) / elapsed, (unsigned long long)all.exact, (unsigned long long)all.open,
           (unsigned long long)all.wide, (unsigned long long)all.vague, (unsigned long long)all.wrong);
    fflush(stdout);
    mtx_unlock(&run->lock);
}

// Starts the threads, then prints each minute. The state is written only between blocks of all threads: at the end of
// a slice, when each has come back.
static void run_all(long_run *run, int threads) {
    thrd_t all[64];
    counts before;
    sum_all(run, &before);
    double whole = run->seconds;
    while (!stop && run->queries < run->target && (whole <= 0 || now_seconds() - run->start < whole)) {
        double next = now_seconds() - run->start + 60;
        run->seconds = whole > 0 && whole < next ? whole : next;
        for (int i = 0; i < threads; i++)
            if (thrd_create(&all[i], work_on, run) != thrd_success) abort();
        for (int i = 0; i < threads; i++) thrd_join(all[i], NULL);
        write_state(run);
        print_progress(run, before.queries);
    }
}

// --- tables

static void print_names(const char *title, const uint64_t *values, size_t count, const char *(*name)(int)) {
    printf("%s:", title);
    for (size_t i = 0; i < count; i++)
        if (values[i]) printf(" %s %llu,", name((int)i), (unsigned long long)values[i]);
    printf("\n");
}

static const char *name_question(int i) {
    static const char *const names[] = {"collide", "within", "distance", "depth", "bounds"};
    return names[i];
}
static const char *name_warm(int i) {
    static const char *const names[] = {"none", "of the frame before", "stale", "of another pair", "damaged"};
    return names[i];
}
static const char *name_status(int i) { return ovoid_status_get_name((ovoid_status)i); }
static const char *name_stage(int i) { return ovoid_stage_get_name((ovoid_stage)i); }
static const char *name_limit(int i) { return ovoid_limit_get_name((ovoid_limit)i); }

static void print_row(const char *name, const counts *c, uint64_t queries) {
    printf("%-24s %5.1f %12llu %10llu %9llu %6.2f %6.2f %6.2f %7llu %7llu %6llu %6llu %6.0f %6llu\n", name,
           100.0 * (double)c->queries / (double)queries, (unsigned long long)c->queries, (unsigned long long)c->pairs,
           (unsigned long long)c->exact, 100.0 * (double)c->statuses[OVOID_SEPARATED] / (double)c->queries,
           100.0 * (double)c->statuses[OVOID_TOUCHING] / (double)c->queries,
           100.0 * (double)c->statuses[OVOID_OVERLAPPING] / (double)c->queries, (unsigned long long)c->open,
           (unsigned long long)c->wide, (unsigned long long)c->vague, (unsigned long long)c->iterations,
           (double)c->nanoseconds / (double)c->queries, (unsigned long long)c->wrong);
}

static void print_tables(const long_run *run) {
    counts all;
    sum_all(run, &all);
    if (!all.queries) return;
    printf("%-24s %5s %12s %10s %9s %6s %6s %6s %7s %7s %6s %6s %6s %6s\n", "family", "%", "queries", "places", "exact",
           "apart%", "touch%", "over%", "open", "wide", "vague", "iter", "ns", "wrong");
    for (size_t i = 0; i < long_family_count; i++)
        if (run->counts[i].queries) print_row(long_families[i].name, &run->counts[i], all.queries);
    print_row("all", &all, all.queries);
    print_names("questions", all.questions, ASK_KINDS, name_question);
    print_names("earlier proof", all.warm, WARM_KINDS, name_warm);
    print_names("statuses", all.statuses, OVOID_OVERLAPPING + 1, name_status);
    print_names("stages", all.stages, OVOID_STAGE_REFINE + 1, name_stage);
    print_names("limits", all.limits, OVOID_LIMIT_SHAPE_B + 1, name_limit);
    printf("with options: %llu\n", (unsigned long long)all.limited);
    printf("seed %llu, %llu blocks: %llu queries, %llu before the judge, %llu vague, %llu wrong\n",
           (unsigned long long)run->seed, (unsigned long long)run->begun, (unsigned long long)all.queries,
           (unsigned long long)all.exact, (unsigned long long)all.vague, (unsigned long long)all.wrong);
    check_passed = (long)(all.queries - all.wrong - all.vague);
    check_failed += (long)(all.wrong + all.vague);
}

// One block again, whatever the schedule says of it.
static void run_block(long_run *run, uint64_t number) {
    judge *j = judge_create();
    if (!j) abort();
    for (size_t i = 0; i < long_family_count; i++) {
        if (strcmp(run->family, long_families[i].name) != 0) continue;
        block_run block = {.family = &long_families[i],
                           .number = number,
                           .seed = find_block_seed(run->seed, number),
                           .sample = run->sample,
                           .is_shown = 1,
                           .clouds = &run->clouds,
                           .judge = j,
                           .report = report,
                           .context = run};
        block_execute(&block, &run->counts[i]);
        run->begun = 1;
    }
    judge_destroy(j);
}

int main(int count, char **arguments) {
    static long_run run = {.seed = 1, .target = 1000000000u, .sample = 1000};
    uint64_t threads = 1, block = 0;
    const test_option options[] = {
        {"queries", "ends after so many (1e9)", &run.target, NULL, NULL, NULL},
        {"seconds", "ends after so long", NULL, &run.seconds, NULL, NULL},
        {"threads", "1 to 64", &threads, NULL, NULL, NULL},
        {"sample", "one answer in so many goes before the judge (1000)", &run.sample, NULL, NULL, NULL},
        {"seed", "of the first block (1)", &run.seed, NULL, NULL, NULL},
        {"state", "a file: goes on where it stopped", NULL, NULL, &run.state, NULL},
        {"family", "one block of this family alone, with --block", NULL, NULL, &run.family, NULL},
        {"block", "the block's number", &block, NULL, NULL, NULL},
        {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    threads = threads < 1 ? 1 : threads > 64 ? 64 : threads;
    if (run.sample == 0 || mtx_init(&run.lock, mtx_plain) != thrd_success) return 2;
    run.clouds = clouds_read();
    fill_schedule(&run);
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
    run.start = now_seconds();
    if (run.family)
        run_block(&run, block);
    else if (!read_state(&run))
        return 2;
    else
        run_all(&run, (int)threads);
    print_tables(&run);
    clouds_destroy(run.clouds);
    return check_end();
}
