// How tight each bound of the distance is, as a function of the distance, for each family: the brackets of spheres,
// ellipsoids, exits and the stages of a query.
#include "paper/experiment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BOUNDS = 6, BINS = 8, SAMPLES_MAX = 200 };

static const char *const names[BOUNDS] = {"lower: spheres",       "lower: enclosing ellipsoids",
                                          "lower: ovoid_collide", "upper: enclosed ellipsoids",
                                          "upper: exits Q1 Q2",   "upper: ovoid_collide"};

/// Random poses for each model and gap.
static uint32_t get_samples(const experiment *e) {
    uint32_t samples = (e->frames + 5) / 6;
    return samples < SAMPLES_MAX ? samples : SAMPLES_MAX;
}

/// The gap of a bin, in sums of the radii: powers of two from 1/64.
static double get_gap(int bin) { return ldexp(1, bin - 6); }

/// Moves B along the line of the witness points until the distance is the gap; 0 if that fails.
static int set_gap(ovoid_pair *p, double gap) {
    for (int i = 0; i < 12; i++) {
        ovoid_answer answer = ovoid_depth(p, NULL, NULL, NULL);
        double step = gap - answer.lower;
        if (fabs(step) <= 1e-6 * gap) return 1;
        p->pose_b.position = vec3_add_scaled(p->pose_b.position, answer.normal, step);
    }
    return 0;
}

/// Distance minus lower bound, upper bound minus distance, in sums of the radii.
static void measure(const paper_model *a, const paper_model *b, const ovoid_pair *p, double open[BOUNDS]) {
    double size = experiment_get_radius(a) + experiment_get_radius(b);
    ovoid_answer exact = ovoid_distance(p, NULL, NULL), bounds = ovoid_pair_compute_bounds(p),
                 collide = ovoid_collide(p, NULL, NULL);
    const ovoid_areas *areas[2] = {a->areas, b->areas};
    ovoid_paper_bounds exits = ovoid_paper_compute_bounds(p, areas, OVOID_RULE_RAY, INFINITY);
    ovoid_measures ma = ovoid_shape_get_measures(p->shape_a), mb = ovoid_shape_get_measures(p->shape_b);
    ovoid_vec3 d = vec3_sub(ovoid_pose_compute_point(&p->pose_b, mb.sphere_center),
                            ovoid_pose_compute_point(&p->pose_a, ma.sphere_center));
    double spheres = sqrt(vec3_dot(d, d)) - ma.sphere_radius - mb.sphere_radius;
    open[0] = (exact.lower - spheres) / size;
    open[1] = (exact.lower - bounds.lower) / size;
    open[2] = (exact.lower - collide.lower) / size;
    open[3] = (bounds.upper - exact.upper) / size;
    open[4] = (exits.upper - exact.upper) / size;
    open[5] = (collide.upper - exact.upper) / size;
}

/// The medians of a family, by bound and gap.
static void measure_family(const experiment *e, int family, double medians[BOUNDS][BINS]) {
    static double open[BOUNDS][MODELS_EACH * SAMPLES_MAX];
    for (int bin = 0; bin < BINS; bin++) {
        size_t count = 0;
        for (int i = 0; i < MODELS_EACH; i++)
            for (uint32_t k = 0; k < get_samples(e); k++) {
                int model = 1 + (family - 1) * MODELS_EACH + i;
                double one[BOUNDS];
                ovoid_pair p = experiment_get_mutual(e, 0, model, k);
                double size = experiment_get_radius(&e->models[0]) + experiment_get_radius(&e->models[model]);
                if (!set_gap(&p, get_gap(bin) * size)) continue;
                measure(&e->models[0], &e->models[model], &p, one);
                for (int b = 0; b < BOUNDS; b++) open[b][count] = one[b];
                count++;
            }
        for (int b = 0; b < BOUNDS; b++) medians[b][bin] = find_quantile(open[b], count, 0.5);
    }
}

void experiment_add_bracket(const experiment *e) {
    double x[BINS], medians[BOUNDS][BINS];
    report_add_section(e->report, "The bracket, over the distance");
    report_add_text(e->report,
                    "The box and each model, moved along the shortest way between them to a given gap; %u places each. "
                    "Shown is what a bound leaves open, its distance from the true one, as a share of the sum of the "
                    "radii; medians.",
                    get_samples(e));
    report_table *t = report_begin_table(e->report, "bracket", "family,gap,bound,left open (median)");
    for (int bin = 0; bin < BINS; bin++) x[bin] = get_gap(bin);
    for (int family = 1; family < FAMILY_COUNT; family++) {
        const char *name = paper_family_get_name((paper_family)family);
        ovoid_series series[BOUNDS];
        measure_family(e, family, medians);
        for (int b = 0; b < BOUNDS; b++) {
            series[b] = (ovoid_series){names[b], OVOID_SERIES_LINE, BINS, x, medians[b], NULL, NULL};
            for (int bin = 0; bin < BINS; bin++)
                report_add_row(t, "%s,%g,%s,%.6f", name, x[bin], names[b], medians[b][bin]);
        }
        char file[40], title[80];
        snprintf(file, sizeof file, "bracket_%d", family);
        snprintf(title, sizeof title, "The box and the %s: what the bounds leave open", name);
        report_add_chart(e->report, file,
                         &(ovoid_chart){.title = title,
                                        .x_label = "distance, in sums of the radii",
                                        .y_label = "left open, likewise",
                                        .series = series,
                                        .series_count = BOUNDS,
                                        .x_log = 1});
    }
    report_end_table(t, 0);
    report_add_finding(e->report,
                       (report_finding){"Figure 0 shows lower and upper estimates; no numbers.",
                                        "The bounds of the ellipsoids are off by a nearly constant share of the size, "
                                        "whatever the distance; those of the query follow the question and are tight "
                                        "where it is hard.",
                                        "An ellipsoid is as far from the polyhedron as their shapes differ, and that "
                                        "does not depend on where the other body is."});
}
