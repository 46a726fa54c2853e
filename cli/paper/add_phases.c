// Offline: the volumes of the three phases relative to the largest enclosed ellipsoid, where phase 2 stops early, and
// the effect of repeating phases 2 and 3.
#include "paper/experiment.h"

#include <math.h>

enum { ROUNDS = 12 };

/// Volumes relative to the largest one: after phases 1, 2, 3, and after each further round of phases 2 and 3.
typedef struct reached {
    double phase[3], round[ROUNDS];
    double beta;
} reached;

static reached measure(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double largest = ovoid_shape_get_inner(shape).volume;
    ovoid_ellipsoid outer = ovoid_shape_get_outer(shape).ellipsoid;
    ovoid_fit shrunk = ovoid_ellipsoid_compute_shrunk(&p, &outer);
    ovoid_fit stretched = ovoid_ellipsoid_compute_stretched(&p, &shrunk.ellipsoid);
    ovoid_fit enlarged = ovoid_ellipsoid_compute_enlarged(&p, &stretched.ellipsoid);
    reached r = {{shrunk.volume / largest, stretched.volume / largest, enlarged.volume / largest}, {0}, stretched.beta};
    r.round[0] = r.phase[2];
    for (int i = 1; i < ROUNDS; i++) {
        stretched = ovoid_ellipsoid_compute_stretched(&p, &enlarged.ellipsoid);
        enlarged = ovoid_ellipsoid_compute_enlarged(&p, &stretched.ellipsoid);
        r.round[i] = enlarged.volume / largest;
    }
    return r;
}

void experiment_add_phases(const experiment *e) {
    double share[3][MODEL_COUNT], rounds[FAMILY_COUNT][ROUNDS] = {{0}}, number[ROUNDS], sum[3] = {0};
    int stuck = 0;
    report_add_section(e->report, "Phases 1 to 3 against the largest enclosed ellipsoid");
    report_table *t = report_begin_table(e->report, "phases",
                                         "model,phase 1 %,phase 2 %,phase 3 %,beta of phase 2,after 12 rounds %");
    for (int i = 0; i < MODEL_COUNT; i++) {
        const paper_model *m = &e->models[i];
        reached r = measure(m->shape);
        for (int k = 0; k < 3; k++) share[k][i] = 100 * r.phase[k], sum[k] += r.phase[k] / MODEL_COUNT;
        for (int k = 0; k < ROUNDS; k++) rounds[m->family][k] += 100 * r.round[k] / (m->family ? MODELS_EACH : 1);
        stuck += r.beta < 1e-6;
        report_add_row(t, "%s,%.2f,%.2f,%.2f,%.3g,%.2f", m->name, 100 * r.phase[0], 100 * r.phase[1], 100 * r.phase[2],
                       r.beta, 100 * r.round[ROUNDS - 1]);
    }
    report_end_table(t, 0);
    const ovoid_series phases[] = {{"phase 1", OVOID_SERIES_LINE, MODEL_COUNT, NULL, share[0], NULL, NULL},
                                   {"phase 2", OVOID_SERIES_LINE, MODEL_COUNT, NULL, share[1], NULL, NULL},
                                   {"phase 3", OVOID_SERIES_LINE, MODEL_COUNT, NULL, share[2], NULL, NULL}};
    report_add_chart(e->report, "phases",
                     &(ovoid_chart){.title = "Volume after each phase, of the largest enclosed ellipsoid's",
                                    .x_label = "model: 0 box, 1 to 10 cylinders, 11 to 20 complex, 21 to 30 spheres",
                                    .y_label = "percent",
                                    .series = phases,
                                    .series_count = 3,
                                    .y_max = 105});
    ovoid_series repeated[FAMILY_COUNT];
    for (int k = 0; k < ROUNDS; k++) number[k] = k + 1;
    for (int f = 0; f < FAMILY_COUNT; f++)
        repeated[f] = (ovoid_series){
            paper_family_get_name((paper_family)f), OVOID_SERIES_LINE, ROUNDS, number, rounds[f], NULL, NULL};
    report_add_chart(e->report, "phases_repeated",
                     &(ovoid_chart){.title = "Phases 2 and 3 again and again",
                                    .x_label = "rounds",
                                    .y_label = "percent of the largest volume",
                                    .series = repeated,
                                    .series_count = FAMILY_COUNT});
    char measured[400];
    snprintf(measured, sizeof measured,
             "On average phase 1 reaches %.1f %% of the largest volume, phase 2 %.1f %%, phase 3 %.1f %%; phase 2 is "
             "stuck at beta = 0 for %d of %d models. Rounds of phases 2 and 3 bring cylinders to %.1f %%, spheres to "
             "%.1f %%.",
             100 * sum[0], 100 * sum[1], 100 * sum[2], stuck, MODEL_COUNT, rounds[FAMILY_CYLINDER][ROUNDS - 1],
             rounds[FAMILY_SPHERE][ROUNDS - 1]);
    char part[80];
    snprintf(part, sizeof part, "%.1f %% of the largest volume; phase 2 is stuck for %d of %d models", 100 * sum[2],
             stuck, MODEL_COUNT);
    report_add_verdict(e->report, (report_verdict){"Three phases make the enclosed ellipsoid as large as possible.",
                                                   sum[2] > 0.999 ? REPORT_HOLDS : REPORT_DOES_NOT_HOLD, part,
                                                   "the largest one, to a proven gap"});
    report_add_finding(
        e->report, (report_finding){"Finding the enclosed ellipsoid of largest volume is very difficult; three "
                                    "phases make one as large as possible.",
                                    measured,
                                    "The largest enclosed ellipsoid is a convex problem and is solved to a proven gap "
                                    "today. Phase 1 ends where it touches a facet, often several at once by symmetry; "
                                    "a stretch toward any point then leaves the body at once."});
}
