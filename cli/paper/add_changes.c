// The paper recomputes its offline steps when an object is deformed or divided: the cost of that, starting from the
// previous ellipsoids or from scratch, and for the two parts of a divided body.
#include "paper/experiment.h"

#include <math.h>
#include <stdlib.h>

enum { SIZES = 4, AMOUNTS = 4, REPEATS = 5 };

static const uint32_t sizes[SIZES] = {16, 102, 1002, 5002};
static const double amounts[AMOUNTS] = {1e-4, 1e-3, 1e-2, 1e-1};

/// The cost of one change.
typedef struct change {
    double again, afresh;         ///< ms: the whole shape
    uint32_t steps, steps_afresh; ///< of the enclosing ellipsoid
} change;

static double *make_points(uint32_t count, uint64_t *state) {
    double *xyz = calloc(count, 3 * sizeof *xyz);
    for (uint32_t i = 0; i < count && xyz; i++) {
        ovoid_vec3 v = random_direction(state);
        xyz[3 * i] = v.x, xyz[3 * i + 1] = 0.7 * v.y, xyz[3 * i + 2] = 0.5 * v.z;
    }
    return xyz;
}

/// Moves each vertex by up to `amount` of its own coordinates.
static void deform(const ovoid_shape *shape, double amount, uint64_t *state, double *to) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    for (uint32_t i = 0; i < 3 * p.vertex_count; i++)
        to[i] = p.vertices[i] * (1 + random_uniform(state, -amount, amount));
}

static change measure(const ovoid_shape *shape, const double *moved) {
    double again[REPEATS], afresh[REPEATS];
    change c = {0, 0, 0, 0};
    uint32_t count = ovoid_shape_get_polytope(shape).vertex_count;
    for (int i = 0; i < REPEATS; i++) {
        double t0 = clock_get_ns();
        ovoid_shape *a = ovoid_shape_create_deformed(shape, moved, NULL, NULL);
        double t1 = clock_get_ns();
        ovoid_shape *b = ovoid_shape_create_from_points(moved, count, NULL, NULL);
        again[i] = (t1 - t0) * 1e-6;
        afresh[i] = (clock_get_ns() - t1) * 1e-6;
        if (a) c.steps = ovoid_shape_get_outer(a).iterations;
        if (b) c.steps_afresh = ovoid_shape_get_outer(b).iterations;
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    c.again = find_quantile(again, REPEATS, 0.5);
    c.afresh = find_quantile(afresh, REPEATS, 0.5);
    return c;
}

/// The ms to cut the shape in two by a plane through its middle; *vertices: of both parts together.
static double measure_division(const ovoid_shape *shape, uint32_t *vertices) {
    const ovoid_plane plane = {{1, 2, 3}, 0.05};
    double took[REPEATS];
    for (int i = 0; i < REPEATS; i++) {
        double start = clock_get_ns();
        ovoid_shape_halves halves = ovoid_shape_create_divided(shape, &plane, NULL, NULL);
        took[i] = (clock_get_ns() - start) * 1e-6;
        *vertices = 0;
        ovoid_shape *parts[2] = {halves.below, halves.above};
        for (int k = 0; k < 2; k++) {
            if (parts[k]) *vertices += ovoid_shape_get_polytope(parts[k]).vertex_count;
            ovoid_shape_destroy(parts[k]);
        }
    }
    return find_quantile(took, REPEATS, 0.5);
}

/// The ms to create the shape of the same vertices.
static double measure_creation(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double took[REPEATS];
    for (int i = 0; i < REPEATS; i++) {
        double start = clock_get_ns();
        ovoid_shape_destroy(ovoid_shape_create_from_points(p.vertices, p.vertex_count, NULL, NULL));
        took[i] = (clock_get_ns() - start) * 1e-6;
    }
    return find_quantile(took, REPEATS, 0.5);
}

static void add_picture(const experiment *e) {
    const ovoid_plane plane = {{1, 0.4, 0.8}, 0.1};
    const paper_model *m = &e->models[1 + MODELS_EACH + 5];
    ovoid_shape_halves halves = ovoid_shape_create_divided(m->shape, &plane, NULL, NULL);
    if (halves.below && halves.above) {
        const ovoid_picture_body bodies[] = {{m->name, m->shape, {{0, 0, 0}, {1, 0, 0, 0}}, 0, NULL, 0},
                                             {NULL, halves.below, {{1.9, 0.9, 0}, {1, 0, 0, 0}}, 0, NULL, 0},
                                             {NULL, halves.above, {{2.4, 1.2, 0.35}, {1, 0, 0, 0}}, 0, NULL, 0}};
        const ovoid_picture picture = {bodies, 3, NULL, 0, NULL, NULL};
        const ovoid_picture_options options = {900, 420, {1, -1.6, 0.6}, OVOID_PICTURE_OUTER | OVOID_PICTURE_INNER};
        report_add_picture(e->report, "divided", &picture, &options,
                           "A body and its two parts, each with ellipsoids of its own.");
    }
    ovoid_shape_destroy(halves.below);
    ovoid_shape_destroy(halves.above);
}

void experiment_add_changes(const experiment *e) {
    double ratio[SIZES][AMOUNTS], share = 0;
    char labels[SIZES][24];
    ovoid_series series[SIZES];
    report_add_section(e->report, "Deformed and divided bodies");
    report_table *t = report_begin_table(e->report, "deformed",
                                         "vertices,moved by,again ms,afresh ms,ratio,steps again,steps afresh");
    report_table *cuts = report_begin_table(e->report, "divided", "vertices,of both parts,divide ms,create ms,ratio");
    for (int i = 0; i < SIZES; i++) {
        uint64_t state = e->seed + sizes[i];
        double *xyz = make_points(sizes[i], &state);
        ovoid_shape *shape = xyz ? ovoid_shape_create_from_points(xyz, sizes[i], NULL, NULL) : NULL;
        for (int k = 0; k < AMOUNTS && shape; k++) {
            deform(shape, amounts[k], &state, xyz);
            change c = measure(shape, xyz);
            ratio[i][k] = c.again / c.afresh;
            share += ratio[i][k] / (SIZES * AMOUNTS);
            report_add_row(t, "%u,%g,%.3f,%.3f,%.2f,%u,%u", sizes[i], amounts[k], c.again, c.afresh, ratio[i][k],
                           c.steps, c.steps_afresh);
        }
        if (shape) {
            uint32_t vertices;
            double divide = measure_division(shape, &vertices), create = measure_creation(shape);
            report_add_row(cuts, "%u,%u,%.3f,%.3f,%.2f", sizes[i], vertices, divide, create, divide / create);
        }
        snprintf(labels[i], sizeof labels[i], "%u vertices", sizes[i]);
        series[i] = (ovoid_series){labels[i], OVOID_SERIES_LINE, AMOUNTS, amounts, ratio[i], NULL, NULL};
        ovoid_shape_destroy(shape);
        free(xyz);
    }
    report_add_chart(e->report, "deformed",
                     &(ovoid_chart){.title = "A deformed body: time from the last ellipsoids over time afresh",
                                    .x_label = "how far vertices are moved, of their coordinates",
                                    .y_label = "ratio",
                                    .series = series,
                                    .series_count = SIZES,
                                    .x_log = 1,
                                    .y_min = 0,
                                    .y_max = 1.5});
    report_end_table(t, 0);
    report_end_table(cuts, SIZES);
    add_picture(e);
    char measured[300];
    snprintf(
        measured, sizeof measured,
        "Started from the last ellipsoids a deformed body takes %.0f %% of the time that it takes afresh. A division "
        "makes two shapes; the table has its cost.",
        100 * share);
    char part[80];
    snprintf(part, sizeof part, "from the last ellipsoids %.0f %% of the time afresh", 100 * share);
    report_add_verdict(e->report,
                       (report_verdict){"Offline steps are computed again only where a body is deformed or divided.",
                                        REPORT_HOLDS, part, "a shape never changes; a changed one is made anew"});
    report_add_finding(
        e->report, (report_finding){"The offline steps need not be computed again until an object is deformed or "
                                    "divided.",
                                    measured,
                                    "Fewer steps of the solvers are not much less time: the hull, and the proofs that "
                                    "the ellipsoids enclose and are enclosed, are made anew each time and are most "
                                    "of it."});
}
