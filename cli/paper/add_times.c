// Charts 1 and 2: the cost of each step of Su, Liu, Chen. Offline (a) to (d) once a body; online (e) to (g) for each
// frame of the box.
#include "paper/experiment.h"

#include <math.h>
#include <stdlib.h>

enum { STEPS = 7, REPEATS = 7 };

/// The median time of an offline step in ns: step 0 to 3.
static double measure_offline(const paper_model *m, int step) {
    ovoid_polytope p = ovoid_shape_get_polytope(m->shape);
    ovoid_fit outer, fit[4];
    double took[REPEATS];
    (void)ovoid_ellipsoid_compute_outer(&p, NULL, &outer, NULL);
    fit[0] = outer;
    fit[1] = ovoid_ellipsoid_compute_shrunk(&p, &fit[0].ellipsoid);
    fit[2] = ovoid_ellipsoid_compute_stretched(&p, &fit[1].ellipsoid);
    for (int i = 0; i < REPEATS; i++) {
        double start = clock_get_ns();
        switch (step) {
        case 0: (void)ovoid_ellipsoid_compute_outer(&p, NULL, &fit[3], NULL); break;
        case 1: fit[3] = ovoid_ellipsoid_compute_shrunk(&p, &fit[0].ellipsoid); break;
        case 2: fit[3] = ovoid_ellipsoid_compute_stretched(&p, &fit[1].ellipsoid); break;
        default: fit[3] = ovoid_ellipsoid_compute_enlarged(&p, &fit[2].ellipsoid); break;
        }
        took[i] = clock_get_ns() - start;
    }
    return find_quantile(took, REPEATS, 0.5);
}

/// Step (f): the gap of two posed ellipsoids along the normal between them.
static double find_gap(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    ovoid_vec3 n = ovoid_ellipsoid_compute_nearest_by_sphere(a, b).normal;
    return vec3_dot(n, vec3_sub(b->center, a->center)) - sqrt(sym3_quadratic(a->q, n)) - sqrt(sym3_quadratic(b->q, n));
}

/// The inputs of the online steps of one model, frame by frame.
typedef struct online {
    ovoid_pair *pairs;
    exit_rays *rays;
    const ovoid_areas *areas[2];
    uint32_t count;
    double sum; ///< of results, so that the compiler removes nothing as unused
} online;

static void run_step(online *o, int step) {
    for (uint32_t i = 0; i < o->count; i++) {
        const ovoid_pair *p = &o->pairs[i];
        if (step == 6) {
            for (int k = 0; k < 2 && !o->rays[i].overlap; k++)
                o->sum +=
                    ovoid_areas_find_exit(o->areas[k], o->rays[i].direction[k], o->rays[i].toward[k], OVOID_RULE_ALL).t;
            continue;
        }
        ovoid_fit a = step == 4 ? ovoid_shape_get_inner(p->shape_a) : ovoid_shape_get_outer(p->shape_a);
        ovoid_fit b = step == 4 ? ovoid_shape_get_inner(p->shape_b) : ovoid_shape_get_outer(p->shape_b);
        ovoid_ellipsoid ea = ovoid_ellipsoid_compute_posed(&a.ellipsoid, &p->pose_a);
        ovoid_ellipsoid eb = ovoid_ellipsoid_compute_posed(&b.ellipsoid, &p->pose_b);
        o->sum += step == 4 ? ovoid_ellipsoid_compute_nearest_by_sphere(&ea, &eb).distance : find_gap(&ea, &eb);
    }
}

/// Measures the three online steps of a model, interleaved; ns a frame.
static int measure_online(const experiment *e, int object, double ns[STEPS]) {
    online o = {.areas = {e->models[0].areas, e->models[object].areas}, .count = e->frames};
    o.pairs = calloc(o.count, sizeof *o.pairs);
    o.rays = calloc(o.count, sizeof *o.rays);
    double took[3][REPEATS];
    if (o.pairs && o.rays) {
        for (uint32_t i = 0; i < o.count; i++) {
            o.pairs[i] = experiment_get_frame(e, object, i);
            o.rays[i] = experiment_find_rays(&o.pairs[i]);
        }
        for (int repeat = 0; repeat < REPEATS; repeat++)
            for (int step = 4; step < STEPS; step++) {
                double start = clock_get_ns();
                run_step(&o, step);
                took[step - 4][repeat] = (clock_get_ns() - start) / o.count;
            }
        for (int step = 4; step < STEPS; step++) ns[step] = find_quantile(took[step - 4], REPEATS, 0.5);
    }
    int good = o.pairs && o.rays && !isnan(o.sum);
    free(o.pairs);
    free(o.rays);
    return good;
}

static void add_charts(const experiment *e, double ns[MODEL_COUNT][STEPS]) {
    static const char *const names[STEPS] = {"(a) enclosing", "(b) shrink", "(c) stretch", "(d) enlarge",
                                             "(e) X* Y*",     "(f) lower",  "(g) upper"};
    double y[STEPS][MODEL_COUNT];
    ovoid_series series[STEPS];
    for (int step = 0; step < STEPS; step++) {
        for (int i = 0; i < MODEL_COUNT; i++) y[step][i] = ns[i][step] * 1e-3;
        series[step] = (ovoid_series){
            names[step], step < 4 ? OVOID_SERIES_LINE : OVOID_SERIES_STACK, MODEL_COUNT, NULL, y[step], NULL, NULL};
    }
    static const char x_label[] = "model: 0 box, 1 to 10 cylinders, 11 to 20 complex, 21 to 30 spheres";
    report_add_chart(e->report, "chart1",
                     &(ovoid_chart){.title = "Chart 1: time of each offline step",
                                    .x_label = x_label,
                                    .y_label = "microseconds",
                                    .series = series,
                                    .series_count = 4,
                                    .y_log = 1});
    // (e) and (f) take the same time within a few percent: as lines one would hide the other, so they are stacked.
    static const char *const every_fifth[MODEL_COUNT] = {"0", "", "", "",   "",   "5", "", "", "",  "",   "10",
                                                         "",  "", "", "",   "15", "",  "", "", "",  "20", "",
                                                         "",  "", "", "25", "",   "",  "", "", "30"};
    report_add_chart(e->report, "chart1_online",
                     &(ovoid_chart){.title = "Chart 1: time of each online step, one above the other",
                                    .x_label = x_label,
                                    .y_label = "microseconds",
                                    .series = series + 4,
                                    .series_count = 3,
                                    .categories = every_fifth,
                                    .category_count = MODEL_COUNT});
    // Shares of the online steps, by family.
    static const char *const families[] = {"cylinders", "complex cylinders", "spheres", "all"};
    double share[3][4];
    for (int family = 0; family < 4; family++) {
        double sum[3] = {0, 0, 0};
        for (int i = 1; i < MODEL_COUNT; i++)
            for (int k = 0; k < 3 && (family == 3 || (int)e->models[i].family == family + 1); k++)
                sum[k] += ns[i][4 + k];
        for (int k = 0; k < 3; k++) share[k][family] = 100 * sum[k] / (sum[0] + sum[1] + sum[2]);
    }
    for (int k = 0; k < 3; k++)
        series[k] = (ovoid_series){names[4 + k], OVOID_SERIES_STACK, 4, NULL, share[k], NULL, NULL};
    report_add_chart(e->report, "chart2",
                     &(ovoid_chart){.title = "Chart 2: shares of the online steps",
                                    .y_label = "percent of the time",
                                    .series = series,
                                    .series_count = 3,
                                    .categories = families,
                                    .category_count = 4,
                                    .y_max = 100});
    char measured[256];
    snprintf(
        measured, sizeof measured,
        "The upper bound, checking all facets, takes %.0f %% of the online time over all models; finding X* and Y* "
        "%.0f %%, the lower bound %.0f %%.",
        share[2][3], share[0][3], share[1][3]);
    char part[80];
    snprintf(part, sizeof part, "%.0f %% of the online time", share[2][3]);
    report_add_verdict(
        e->report, (report_verdict){"The upper bound is the dearest online step, 48 % of the time (70 % in section 1).",
                                    share[2][3] > 40 ? REPORT_HOLDS : REPORT_DOES_NOT_HOLD, part,
                                    "checks the facets several at a time, or only those of the ray's area"});
    report_add_finding(
        e->report,
        (report_finding){"The upper bound takes 48 % of the online time (section 5.3), 70 % (section 1).", measured,
                         "A check of all facets is one pass of multiplications over contiguous memory, "
                         "which a processor of today does several at a time; the nearest points of two "
                         "ellipsoids are a root search that it cannot shorten in that way. The paper's "
                         "two numbers differ by themselves."});
}

void experiment_add_times(const experiment *e) {
    static double ns[MODEL_COUNT][STEPS];
    report_add_section(e->report, "Charts 1 and 2: the time of the steps");
    report_table *t = report_begin_table(
        e->report, "times", "model,(a) us,(b) us,(c) us,(d) us,(e) us,(f) us,(g) us,share of (g) online %");
    for (int i = 0; i < MODEL_COUNT; i++) {
        for (int step = 0; step < 4; step++) ns[i][step] = measure_offline(&e->models[i], step);
        if (!measure_online(e, i, ns[i])) break;
        const double *s = ns[i];
        report_add_row(t, "%s,%.2f,%.2f,%.2f,%.2f,%.3f,%.3f,%.3f,%.1f", e->models[i].name, s[0] / 1e3, s[1] / 1e3,
                       s[2] / 1e3, s[3] / 1e3, s[4] / 1e3, s[5] / 1e3, s[6] / 1e3, 100 * s[6] / (s[4] + s[5] + s[6]));
    }
    report_end_table(t, 0);
    report_add_text(e->report,
                    "Times are medians of %d interleaved repetitions in this one run; read them as ratios. Offline "
                    "steps run once a body, online steps once a frame of the moving box (%u frames for each model).",
                    REPEATS, e->frames);
    add_charts(e, ns);
}
