// The cost of a shape: made from points, read from its file, and the parts of it that can be run alone, beside Qhull's
// hull and the hulls of peers; and many boxes, cylinders and cones, a size each, all kept. All contestants get the same
// points, in turn, pass after pass; a sample is the mean over the bodies, in processor time. Of few points there are
// thousands of bodies, since a processor learns the branches of bodies that it meets again soon.
#include "setup/setup.h"

#include "common/build.h"
#include "common/module.h"
#include "common/random.h"
#include "common/rows.h"
#include "peers/setup_peer.h"

#include <ovoid/ovoid.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#if defined(OVOID_HAVE_QHULL)
#include <libqhull_r/qhull_ra.h>
#endif

enum { PASSES = 9, CONTESTANTS_MOST = 16, CLOUDS_MOST = 4000, CLOUD_POINTS = 128000, LARGE = 50000, SMOKE_CLOUDS = 40 };

static uint32_t get_cloud_count(uint32_t size, int smoke) {
    uint32_t count = CLOUD_POINTS / (size ? size : 1), most = smoke ? SMOKE_CLOUDS : CLOUDS_MOST;
    return count < 1 ? 1 : count < most ? count : most;
}

/// Points, the shape of their hull, and its file.
typedef struct cloud {
    double *points;
    ovoid_shape *shape;
    void *bytes;
    size_t size;
    uint32_t count;
} cloud;

typedef struct cloud_list {
    cloud *items;
    uint32_t count;
} cloud_list;

static void cloud_destroy(cloud *c) {
    ovoid_shape_destroy(c->shape);
    free(c->points);
    free(c->bytes);
}

/// Points on an ellipsoid, stretched by 1 to 4 along two axes, or evenly in it. Returns 0 if memory runs out.
static int cloud_create(cloud *c, uint32_t count, int is_inside, uint64_t *state) {
    *c = (cloud){.points = malloc(sizeof *c->points * 3 * count), .count = count};
    if (!c->points) return 0;
    double stretch_y = random_uniform(state, 1, 4), stretch_z = random_uniform(state, 1, 4);
    for (size_t i = 0; i < count; i++) {
        ovoid_vec3 p = random_unit(state);
        double r = is_inside ? cbrt(random_uniform(state, 0, 1)) : 1;
        c->points[3 * i] = r * p.x;
        c->points[3 * i + 1] = r * p.y * stretch_y;
        c->points[3 * i + 2] = r * p.z * stretch_z;
    }
    c->shape = ovoid_shape_create_from_points(c->points, count, NULL, NULL);
    if (!c->shape) return 0;
    c->size = ovoid_shape_write(c->shape, NULL, 0);
    c->bytes = malloc(c->size);
    return c->bytes && ovoid_shape_write(c->shape, c->bytes, c->size) == c->size;
}

// --- contestants

/// 0: it failed.
typedef int (*step)(const cloud *c);

static int make_shape(const cloud *c) {
    ovoid_shape *shape = ovoid_shape_create_from_points(c->points, c->count, NULL, NULL);
    ovoid_shape_destroy(shape);
    return shape != NULL;
}

static int make_lean(const cloud *c) {
    ovoid_shape *shape =
        ovoid_shape_create_from_points(c->points, c->count, &(ovoid_shape_options){.inner = OVOID_INNER_LEAN}, NULL);
    ovoid_shape_destroy(shape);
    return shape != NULL;
}

static int read_file(const cloud *c) {
    ovoid_shape *shape = ovoid_shape_read(c->bytes, c->size, NULL, NULL);
    ovoid_shape_destroy(shape);
    return shape != NULL;
}

static int fit_outer(const cloud *c) {
    ovoid_polytope p = ovoid_shape_get_polytope(c->shape);
    ovoid_fit fit;
    return ovoid_ellipsoid_compute_outer(&p, NULL, &fit, NULL) == OVOID_OK;
}

static int fit_inner(const cloud *c) {
    ovoid_polytope p = ovoid_shape_get_polytope(c->shape);
    ovoid_fit fit;
    return ovoid_ellipsoid_compute_inner(&p, NULL, &fit, NULL) == OVOID_OK;
}

static int make_areas(const cloud *c) {
    ovoid_polytope p = ovoid_shape_get_polytope(c->shape);
    ovoid_fit fit = ovoid_shape_get_inner(c->shape);
    ovoid_areas *areas =
        ovoid_areas_create(&p, &fit.ellipsoid, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 8}, NULL);
    ovoid_areas_destroy(areas);
    return areas != NULL;
}

#if defined(OVOID_HAVE_QHULL)
static int run_qhull(const cloud *c) {
    FILE *nothing = fopen("/dev/null", "w");
    double *copy = malloc(sizeof(double) * 3 * c->count);
    int code = 1;
    if (nothing && copy) {
        memcpy(copy, c->points, sizeof(double) * 3 * c->count);
        char command[] = "qhull Qt";
        qhT qh;
        int current, total;
        qh_zero(&qh, nothing);
        code = qh_new_qhull(&qh, 3, (int)c->count, copy, 0, command, nothing, nothing);
        qh_freeqhull(&qh, !qh_ALL);
        qh_memfreeshort(&qh, &current, &total);
    }
    free(copy);
    if (nothing) (void)fclose(nothing);
    return code == 0;
}
#endif

static const struct {
    const char *name;
    step run;
} steps[] = {
    {"shape", make_shape},          {"lean shape", make_lean},      {"shape's file read", read_file},
    {"outer ellipsoid", fit_outer}, {"inner ellipsoid", fit_inner}, {"ovoid_areas, k = 8", make_areas},
#if defined(OVOID_HAVE_QHULL)
    {"Qhull's hull", run_qhull},
#endif
};
enum { STEPS = sizeof steps / sizeof *steps };

typedef struct contestants {
    const setup_peer *peers[CONTESTANTS_MOST];
    uint32_t count;
} contestants;

static int load(contestants *all, const char *path) {
    const setup_peer *const *(*get)(void) =
        (const setup_peer *const *(*)(void))module_load(path, "bench_get_setup_peers");
    if (!get) return 0;
    for (const setup_peer *const *p = get(); *p && STEPS + all->count < CONTESTANTS_MOST; p++)
        all->peers[all->count++] = *p;
    return 1;
}

static const struct { const char *name, *path; } built[] = {OVOID_BENCH_SETUP_MODULES{NULL, NULL}};

static int load_all(contestants *all, const setup_plan *plan) {
    for (int i = 0; built[i].name && !plan->alone; i++)
        if (*built[i].path) (void)load(all, built[i].path);
    for (uint32_t i = 0; i < plan->module_count; i++)
        if (!load(all, plan->modules[i])) return 0;
    return 1;
}

// --- the table

/// Runs contestant i on all clouds; microseconds a cloud. Negative: it failed.
static double time_contestant(const contestants *all, uint32_t i, const cloud_list *clouds) {
    int good = 1;
    double start = get_own_seconds();
    for (const cloud *c = clouds->items; c < clouds->items + clouds->count && good; c++)
        good = i < STEPS ? steps[i].run(c) : all->peers[i - STEPS]->make(c->points, c->count) > 0;
    return good ? (get_own_seconds() - start) / clouds->count * 1e6 : -1;
}

static void add_clouds(rows *table, const contestants *all, const cloud_list *clouds, row named) {
    uint32_t passes = clouds->items->count > LARGE ? 2 : PASSES;
    static double samples[CONTESTANTS_MOST][PASSES];
    for (uint32_t pass = 0; pass < passes; pass++)
        for (uint32_t i = 0; i < STEPS + all->count; i++) samples[i][pass] = time_contestant(all, i, clouds);
    for (uint32_t i = 0; i < STEPS + all->count; i++) {
        named.line = i < STEPS ? steps[i].name : all->peers[i - STEPS]->name;
        named.y = timing_make(samples[i], passes);
        if (named.y.least > 0) rows_add(table, named);
    }
}

/// Clouds of a size: on ellipsoids or in them.
typedef struct cloud_plan {
    uint32_t size;
    int is_inside, smoke;
} cloud_plan;

static int add_size(rows *table, const contestants *all, cloud_plan plan) {
    cloud_list clouds = {.count = get_cloud_count(plan.size, plan.smoke)};
    clouds.items = calloc(clouds.count, sizeof *clouds.items);
    uint64_t state = plan.size;
    int good = clouds.items != NULL;
    for (uint32_t k = 0; k < clouds.count && good; k++)
        good = cloud_create(&clouds.items[k], plan.size, plan.is_inside, &state);
    row named = {.chart = plan.is_inside ? "Making a shape of points in an ellipsoid"
                                         : "Making a shape of points on an ellipsoid",
                 .x_name = "points",
                 .y_name = "us",
                 .x = plan.size};
    if (good) add_clouds(table, all, &clouds, named);
    for (uint32_t k = 0; k < clouds.count && clouds.items; k++) cloud_destroy(&clouds.items[k]);
    free(clouds.items);
    return good;
}

// --- bodies of a size each

typedef ovoid_shape *(*create_sized)(ovoid_vec3 size);

static ovoid_shape *create_box(ovoid_vec3 size) { return ovoid_shape_create_box(size, NULL, NULL); }
static ovoid_shape *create_cylinder(ovoid_vec3 size) { return ovoid_shape_create_cylinder(size.x, size.y, NULL, NULL); }
static ovoid_shape *create_cone(ovoid_vec3 size) { return ovoid_shape_create_cone(size.x, size.y, NULL, NULL); }

static const struct {
    const char *name, *read_name;
    create_sized create;
    uint32_t count;
} kinds[] = {{"boxes", "boxes, made, written and read", create_box, 100000},
             {"cylinders", "cylinders, made, written and read", create_cylinder, 10000},
             {"cones", "cones, made, written and read", create_cone, 10000}};

/// The shape that its own file gives; the shape is destroyed.
static ovoid_shape *read_again(ovoid_shape *shape) {
    char bytes[4096];
    size_t size = ovoid_shape_write(shape, bytes, sizeof bytes);
    ovoid_shape_destroy(shape);
    return size <= sizeof bytes ? ovoid_shape_read(bytes, size, NULL, NULL) : NULL;
}

/// Makes or reads bodies of a size each, keeps them all, and asks each about the one before. 0: it failed.
static int make_bodies(create_sized create, ovoid_shape **shapes, uint32_t count, int is_read) {
    uint64_t state = count;
    uint32_t apart = 0;
    int good = 1;
    for (uint32_t i = 0; i < count && good; i++) {
        ovoid_vec3 size = {random_uniform(&state, 0.1, 1), random_uniform(&state, 0.1, 1),
                           random_uniform(&state, 0.1, 1)};
        shapes[i] = create(size);
        if (shapes[i] && is_read) shapes[i] = read_again(shapes[i]);
        good = shapes[i] != NULL;
        if (!good || i == 0) continue;
        const ovoid_pair pair = {shapes[i - 1], shapes[i], {{0, 0, 0}, {1, 0, 0, 0}}, {{1.5, 0, 0}, {1, 0, 0, 0}}};
        apart += ovoid_collide(&pair, NULL, NULL).status == OVOID_SEPARATED;
    }
    return good && (apart > 0 || count < 100);
}

/// Microseconds a body: made or read, and asked. The time of writing files is in that of reading.
static int add_bodies(rows *table, size_t kind, uint32_t count, int is_read) {
    double samples[PASSES];
    ovoid_shape **shapes = malloc(count * sizeof(ovoid_shape *));
    int good = shapes != NULL;
    for (uint32_t pass = 0; pass < PASSES && good; pass++) {
        memset(shapes, 0, count * sizeof(ovoid_shape *));
        double start = get_own_seconds();
        good = make_bodies(kinds[kind].create, shapes, count, is_read);
        samples[pass] = (get_own_seconds() - start) / count * 1e6;
        for (uint32_t i = 0; i < count; i++) ovoid_shape_destroy(shapes[i]);
    }
    free(shapes);
    if (!good) return 0;
    rows_add(table, (row){.chart = "Bodies of a size each, kept and asked",
                          .x_name = "bodies",
                          .y_name = "us",
                          .line = is_read ? kinds[kind].read_name : kinds[kind].name,
                          .x = count,
                          .y = timing_make(samples, PASSES)});
    return 1;
}

/// The C library keeps what is freed: else whether a loop gets fresh pages each time depends on the sizes it happens to
/// meet.
static void keep_memory(void) {
#if defined(__GLIBC__)
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 25);
    (void)mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

int setup_run(const setup_plan *plan, const char *csv, const char *svg) {
    static rows table;
    contestants all = {.count = 0};
    keep_memory();
    if (!load_all(&all, plan)) return 0;
    printf("%s\n", get_build());
    uint32_t sizes = plan->smoke && plan->size_count > 2 ? 2 : plan->size_count;
    for (int is_inside = 0; is_inside < 2; is_inside++)
        for (uint32_t i = 0; i < sizes; i++)
            if (!add_size(&table, &all, (cloud_plan){plan->sizes[i], is_inside, plan->smoke})) return 0;
    for (size_t kind = 0; kind < sizeof kinds / sizeof *kinds; kind++)
        for (int is_read = 0; is_read < 2; is_read++)
            if (!add_bodies(&table, kind, plan->smoke ? 1000 : kinds[kind].count, is_read)) return 0;
    return (!csv || rows_write_csv(&table, csv)) && (!svg || rows_write_svg(&table, svg));
}
