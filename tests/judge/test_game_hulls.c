// 3378 point clouds of real game hulls, in random pairs near contact: the depth of each, every proof put before the
// exact judge, none undecided. Truth: exact arithmetic. The file is repeated records of a 32-bit little-endian count n
// and n times three 32-bit floats; it is not part of the project, and the test is skipped where it is absent.
//   --pairs N (default 5000), --seed N; --export DIR: writes each cloud as OBJ, LIST and PAIRS.csv for `ovoid batch`.
#include "check.h"
#include "options.h"
#include "proofs/covers.h"
#include "trials/ask.h"
#include "trials/clouds.h"
#include "trials/shapes.h"

// --- the pairs

static double reach(const ovoid_shape *s) { return ovoid_shape_get_measures(s).sphere_radius; }

// A pair in random orientations, B moved along the line of centres until the signed distance is within 1 % of the size.
static ovoid_pair make_pair(const ovoid_shape *a, const ovoid_shape *b, uint64_t *r) {
    ovoid_pair pair = {a, b, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    ovoid_quat *turns[2] = {&pair.pose_a.rotation, &pair.pose_b.rotation};
    for (int i = 0; i < 2; i++) {
        double w = random_normal(r), x = random_normal(r), y = random_normal(r), z = random_normal(r);
        *turns[i] = (ovoid_quat){w, x, y, z};
    }
    // The centre of B on a ray from the centre of A.
    double x = random_normal(r), y = random_normal(r), z = random_normal(r), n = 1 / sqrt(x * x + y * y + z * z);
    ovoid_vec3 ray = {x * n, y * n, z * n}, oa = ovoid_shape_get_polytope(a).origin,
               ob = ovoid_shape_get_polytope(b).origin;
    ovoid_vec3 la = ovoid_shape_get_measures(a).sphere_center, lb = ovoid_shape_get_measures(b).sphere_center;
    ovoid_vec3 ca = ovoid_pose_compute_point(&pair.pose_a, (ovoid_vec3){la.x + oa.x, la.y + oa.y, la.z + oa.z});
    ovoid_vec3 cb = ovoid_pose_compute_point(&pair.pose_b, (ovoid_vec3){lb.x + ob.x, lb.y + ob.y, lb.z + ob.z});
    double size = reach(a) + reach(b), gap = 0.01 * size * random_uniform(r, -1, 1), at = size;
    for (int i = 0; i < 12; i++) {
        pair.pose_b.position =
            (ovoid_vec3){ca.x - cb.x + at * ray.x, ca.y - cb.y + at * ray.y, ca.z - cb.z + at * ray.z};
        ovoid_answer d = ovoid_depth(&pair, NULL, NULL, NULL);
        double along = d.normal.x * ray.x + d.normal.y * ray.y + d.normal.z * ray.z, miss = gap - d.upper;
        if (!(fabs(miss) > 1e-3 * size) || !(along > 0.05)) break;
        at += miss / along;
    }
    return pair;
}

typedef struct run {
    tally counts;
    long stages[OVOID_STAGE_REFINE + 1], kinds[OVOID_PROOF_COVER + 1];
    double query_seconds, judge_seconds;
    double nearest, farthest; // |d| in parts of the size
} run;

static void run_pair(run *all, const ovoid_pair *pair) {
    LOCAL_COVER(cover);
    ovoid_error error = {0};
    tally *t = &all->counts;
    double before = seconds_now();
    ovoid_answer x = ovoid_depth(pair, NULL, NULL, &cover);
    double between = seconds_now();
    ovoid_code code = judge_verify_answer(trial_judge, pair, &x, &cover, &error);
    if (code == OVOID_OK) code = judge_verify_points(trial_judge, pair, &x, &error);
    all->judge_seconds += seconds_now() - between;
    all->query_seconds += between - before;
    if (code == OVOID_OK) code = ovoid_answer_verify(pair, &x, &(ovoid_answer_basis){.cover = &cover}, &error);
    t->pairs++;
    t->answers++;
    if (code != OVOID_OK) trial_fail(t, pair, &x, "depth", error.message);
    trial_count_sign(t, pair, &x, "depth");
    trial_count_width(t, pair, &x);
    if (x.iterations > t->iterations) t->iterations = x.iterations;
    all->stages[x.stage]++;
    all->kinds[x.proof.kind]++;
    double d = fmax(fabs(x.lower), fabs(x.upper)) / pair_size(pair);
    all->farthest = fmax(all->farthest, d);
}

static void print_run(const run *all) {
    tally_print_header();
    tally_print(&all->counts);
    printf("stages:");
    for (int i = 0; i <= OVOID_STAGE_REFINE; i++)
        if (all->stages[i]) printf(" %s %ld", ovoid_stage_get_name((ovoid_stage)i), all->stages[i]);
    printf("; proofs:");
    for (int i = 0; i <= OVOID_PROOF_COVER; i++)
        if (all->kinds[i]) printf(" %s %ld", ovoid_proof_kind_get_name((ovoid_proof_kind)i), all->kinds[i]);
    printf("\nlargest |d| %.3g of the size; %.2g us a query, %.3g us a judgement\n", all->farthest,
           1e6 * all->query_seconds / (double)all->counts.pairs, 1e6 * all->judge_seconds / (double)all->counts.pairs);
}

// --- files for the tool

static FILE *open_in(const char *folder, const char *name) {
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    if (!f) printf("cannot write %s\n", path);
    CHECK(f != NULL);
    return f;
}

// hull_0000.obj ... (points only) and LIST, which names them by line.
static int export_clouds(const clouds *all, const char *folder) {
    FILE *list = open_in(folder, "LIST");
    if (!list) return 0;
    for (size_t i = 0; i < all->count; i++) {
        char name[32];
        snprintf(name, sizeof name, "hull_%04zu.obj", i);
        FILE *f = open_in(folder, name);
        if (!f) break;
        for (uint32_t k = 0; k < all->items[i].count; k++) {
            const double *v = all->items[i].xyz + 3 * k;
            fprintf(f, "v %.17g %.17g %.17g\n", v[0], v[1], v[2]);
        }
        fclose(f);
        fprintf(list, "%s\n", name);
    }
    return fclose(list) == 0;
}

static void write_pose(FILE *f, const ovoid_pose *p) {
    fprintf(f, ",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", p->position.x, p->position.y, p->position.z, p->rotation.w,
            p->rotation.x, p->rotation.y, p->rotation.z);
}

static void write_pair(FILE *f, size_t a, size_t b, const ovoid_pair *pair) {
    fprintf(f, "%zu,%zu", a, b);
    write_pose(f, &pair->pose_a);
    write_pose(f, &pair->pose_b);
    fprintf(f, "\n");
}

// --- all of it

static ovoid_shape **create_shapes(const clouds *all) {
    ovoid_shape **shapes = calloc(all->count, sizeof *shapes);
    ovoid_error error;
    for (size_t i = 0; shapes && i < all->count; i++) {
        shapes[i] = ovoid_shape_create_from_points(all->items[i].xyz, all->items[i].count, NULL, &error);
        if (!shapes[i]) printf("cloud %zu: %s\n", i, error.message);
        CHECK(shapes[i] != NULL);
    }
    return shapes;
}

static void run_all(const clouds *all, long pairs, uint64_t seed, const char *folder) {
    static run total = {.counts = {.name = "game hulls"}};
    double start = seconds_now();
    ovoid_shape **shapes = create_shapes(all);
    printf("%zu shapes in %.2f s\n", all->count, seconds_now() - start);
    FILE *f = folder && export_clouds(all, folder) ? open_in(folder, "PAIRS.csv") : NULL;
    if (f) fprintf(f, "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz\n");
    for (long i = 0; i < pairs; i++) {
        uint64_t r = trial_seed = seed + (uint64_t)i;
        size_t a = (size_t)(random_next(&r) % all->count), b = (size_t)(random_next(&r) % all->count);
        if (!shapes[a] || !shapes[b]) continue;
        ovoid_pair pair = make_pair(shapes[a], shapes[b], &r);
        run_pair(&total, &pair);
        if (f) write_pair(f, a, b, &pair);
    }
    if (f) fclose(f);
    print_run(&total);
    check_passed += (long)(total.counts.answers - total.counts.wrong);
    check_failed += (long)total.counts.wrong;
    judge_forget(trial_judge);
    for (size_t i = 0; i < all->count; i++) ovoid_shape_destroy(shapes[i]);
    free(shapes);
}

int main(int count, char **arguments) {
    uint64_t pairs = 5000, seed = 1;
    const char *folder = NULL;
    const test_option options[] = {{"pairs", "how many (5000)", &pairs, NULL, NULL, NULL},
                                   {"seed", "of their poses (1)", &seed, NULL, NULL, NULL},
                                   {"export", "a folder for the pairs", NULL, NULL, &folder, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    clouds all = clouds_read();
    if (all.count == 0) {
        check_skip("pieces/game_hulls.bin is not in the data folder (OVOID_DATA)");
        return check_end();
    }
    trial_judge = judge_create();
    if (!CHECK(trial_judge != NULL)) return check_end();
    run_all(&all, (long)pairs, seed, folder);
    judge_destroy(trial_judge);
    clouds_destroy(all);
    return check_end();
}
