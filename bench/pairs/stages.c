// Which stage decides how many pairs, and what these pairs cost in all: pairs are grouped by the stage that decided,
// and each group is timed. A stage that decides few pairs and makes the later stages costlier does not pay for itself.
// Then, on the same pairs, a sphere, an oriented box and an ellipsoid as the first stage, each timed alone.
#include "pairs/stages.h"

#include "common/build.h"
#include "pairs/bounds.h"
#include "pairs/cells.h"
#include "pairs/ours.h"

#include <stdio.h>
#include <stdlib.h>

enum { STAGE_COUNT = OVOID_STAGE_REFINE + 1, PASSES = 15 };

typedef struct asked {
    ovoid_pair pair;
    double margin;
    ovoid_stage stage;
} asked;

/// Nanoseconds per query over the pairs that the stage decided, the median of the passes.
static double time_stage(const asked *pairs, uint32_t count, question what, ovoid_stage stage) {
    static volatile double sink;
    double samples[PASSES];
    for (int pass = 0; pass < PASSES; pass++) {
        uint32_t done = 0;
        double start = get_own_seconds(), sum = 0;
        // The group is repeated, so that the clock's own cost does not matter.
        while (done < 200)
            for (uint32_t i = 0; i < count; i++)
                if (pairs[i].stage == stage) {
                    sum += ours_get_answer(&pairs[i].pair, what, pairs[i].margin, NULL).upper;
                    done++;
                }
        sink = sum;
        samples[pass] = (get_own_seconds() - start) / done * 1e9;
    }
    (void)sink;
    return timing_make(samples, PASSES).median;
}

static void print_stages(const workload *work, asked *pairs, question what) {
    uint32_t counts[STAGE_COUNT] = {0};
    for (uint32_t i = 0; i < work->pair_count; i++) {
        pairs[i].stage = ours_get_answer(&pairs[i].pair, what, pairs[i].margin, NULL).stage;
        counts[pairs[i].stage]++;
    }
    printf("%-16s %5u %-9s", work->name, work->vertices, question_get_name(what));
    for (int s = OVOID_STAGE_SPHERE; s < STAGE_COUNT; s++) {
        if (counts[s])
            printf(" %5.1f%% %6.0f", 100.0 * counts[s] / work->pair_count,
                   time_stage(pairs, work->pair_count, what, (ovoid_stage)s));
        else
            printf(" %13s", "-");
    }
    printf("\n");
}

// --- bounding volumes

static void fill_rotation(const ovoid_pose *pose, double m[9]) {
    ovoid_pose turn = {{0, 0, 0}, pose->rotation};
    for (int k = 0; k < 3; k++) {
        ovoid_vec3 c = ovoid_pose_compute_point(&turn, (ovoid_vec3){k == 0, k == 1, k == 2});
        m[k] = c.x;
        m[3 + k] = c.y;
        m[6 + k] = c.z;
    }
}

static double time_bound(bound compute, const bounded *pairs, uint32_t count) {
    static volatile double sink;
    double samples[PASSES];
    for (int pass = 0; pass < PASSES; pass++) {
        double start = get_own_seconds(), sum = 0;
        for (uint32_t i = 0; i < count; i++) sum += compute(&pairs[i]);
        sink = sum;
        samples[pass] = (get_own_seconds() - start) / count * 1e9;
    }
    (void)sink;
    return timing_make(samples, PASSES).median;
}

/// For the pairs whose bounding spheres do not separate them by more than the limit, the share that each volume
/// separates; and for those that neither sphere nor box separates, the ellipsoids' share.
static void print_bounds_for(const workload *work, const bounded *pairs, int within) {
    uint32_t by[3] = {0}, beyond = 0, left = 0;
    for (uint32_t i = 0; i < work->pair_count; i++) {
        double limit = within ? work->pairs[i].margin : 0;
        int sphere = bound_by_sphere(&pairs[i]) > limit, box = bound_by_box(&pairs[i]) > limit;
        int ellipsoid = bound_by_ellipsoid(&pairs[i]) > limit;
        by[0] += sphere;
        by[1] += sphere || box;
        by[2] += sphere || ellipsoid;
        left += !sphere && !box;
        beyond += !sphere && !box && ellipsoid;
    }
    double all = 0.01 * work->pair_count;
    printf("%-16s %5u %-9s %7.1f%% %7.1f%% %7.1f%% %13.1f%%", work->name, work->vertices, within ? "within" : "collide",
           by[0] / all, by[1] / all, by[2] / all, left ? 100.0 * beyond / left : 0);
}

static int print_bounds(const workload *work) {
    volumes *all = malloc(sizeof *all * work->body_count);
    bounded *pairs = malloc(sizeof *pairs * work->pair_count);
    int good = all && pairs;
    for (uint32_t i = 0; good && i < work->body_count; i++) all[i] = volumes_make(work->bodies[i].shape);
    for (uint32_t i = 0; good && i < work->pair_count; i++) {
        const placed *p = &work->pairs[i];
        pairs[i] = (bounded){.a = &all[p->a], .b = &all[p->b], .at_a = p->pose_a.position, .at_b = p->pose_b.position};
        fill_rotation(&p->pose_a, pairs[i].turn_a);
        fill_rotation(&p->pose_b, pairs[i].turn_b);
    }
    if (good) {
        static const bound bounds[] = {bound_by_sphere, bound_by_box, bound_by_ellipsoid};
        for (int within = 0; within < 2; within++) {
            print_bounds_for(work, pairs, within);
            for (int k = 0; k < 3; k++) printf(" %8.0f", time_bound(bounds[k], pairs, work->pair_count));
            printf("\n");
        }
    }
    free(pairs);
    free(all);
    return good;
}

// --- the two tables

static int visit_stages(void *context, const workload *work) {
    (void)context;
    asked *pairs = malloc(sizeof *pairs * work->pair_count);
    for (uint32_t i = 0; pairs && i < work->pair_count; i++)
        pairs[i] = (asked){workload_get_pair(work, i), work->pairs[i].margin, OVOID_STAGE_NONE};
    for (int what = 0; pairs && what < QUESTION_COUNT; what++)
        if (work->questions >> what & 1) print_stages(work, pairs, (question)what);
    free(pairs);
    return pairs != NULL;
}

static int visit_bounds(void *context, const workload *work) {
    (void)context;
    // Only workloads in which most pairs are apart can be separated.
    return !(work->questions >> QUESTION_WITHIN & 1) || print_bounds(work);
}

int stages_run(const plan *what) {
    printf("%s\n\nShare of pairs that a stage decides, and nanoseconds of a query that ends there\n", get_build());
    printf("%-16s %5s %-9s", "", "n", "question");
    for (int s = OVOID_STAGE_SPHERE; s < STAGE_COUNT; s++) printf(" %13s", ovoid_stage_get_name((ovoid_stage)s));
    printf("\n");
    if (!plan_visit(what, visit_stages, NULL)) return 0;
    printf(
        "\nFirst stages alone: share of pairs parted by the sphere, by sphere or box, by sphere or ellipsoid; by the "
        "ellipsoid of those left by both others; nanoseconds each\n");
    printf("%-16s %5s %-9s %8s %8s %8s %14s %8s %8s %8s\n", "", "n", "question", "sphere", "box", "ellips.",
           "beyond both", "sphere", "box", "ellips.");
    return plan_visit(what, visit_bounds, NULL);
}
