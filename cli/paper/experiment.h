// The parts of the experiment, in the order of the report, and their common functions.
#ifndef OVOID_CLI_PAPER_EXPERIMENT_H
#define OVOID_CLI_PAPER_EXPERIMENT_H

#include "paper/models.h"
#include "paper/report.h"
#include "tools/random.h"

typedef struct experiment {
    report *report;
    paper_model *models;
    uint32_t frames; ///< of the moving box, for each other model
    uint64_t seed;
} experiment;

/// Chart 0: the models and their pictures.
void experiment_add_models(const experiment *e);
/// Charts 1 and 2: the time of the steps.
void experiment_add_times(const experiment *e);
/// Chart 3: faces tested, by rule and by number of areas.
void experiment_add_faces(const experiment *e);
/// How often a rule drops a needed area; a case in which it fails.
void experiment_add_soundness(const experiment *e);
/// Propositions 1 and 2 in three dimensions, checked.
void experiment_add_propositions(const experiment *e);
/// False alarms and misses of bounding volumes, of the criterion and of the bracket.
void experiment_add_accuracy(const experiment *e);
/// How tight the bounds are, as a function of the distance.
void experiment_add_bracket(const experiment *e);
/// Phases 1 to 3 against the largest enclosed ellipsoid.
void experiment_add_phases(const experiment *e);
/// Bodies that are deformed or divided.
void experiment_add_changes(const experiment *e);
/// A small arm of convex links moving past an obstacle.
void experiment_add_arm(const experiment *e);

// ---- frames

/// The moving box and model `object` at a frame: one round past it, from touching to a size away, always rotating.
ovoid_pair experiment_get_frame(const experiment *e, int object, uint32_t frame);

/// Two models at random poses, from deep overlap to two sizes apart; equal for equal seed and number.
ovoid_pair experiment_get_mutual(const experiment *e, int a, int b, uint32_t number);

/// Radius of the sphere around a model.
double experiment_get_radius(const paper_model *m);

/// The two rays of step (g) of Su, Liu, Chen, each in its own body's frame: from the inner centre through X* or Y*.
typedef struct exit_rays {
    ovoid_vec3 direction[2], toward[2];
    int overlap; ///< the inner ellipsoids overlap: there is no ray
} exit_rays;
exit_rays experiment_find_rays(const ovoid_pair *pair);

// ---- numbers

ovoid_vec3 random_direction(uint64_t *state);
ovoid_quat random_rotation(uint64_t *state);

/// Nanoseconds of processor time; of wall time if the clock of processor time is too coarse.
double clock_get_ns(void);

/// The q-quantile (0 to 1) of the values, which are sorted in place; NaN if there are none.
double find_quantile(double *values, size_t count, double q);

static inline ovoid_vec3 vec3_sub(ovoid_vec3 a, ovoid_vec3 b) { return (ovoid_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline ovoid_vec3 vec3_add_scaled(ovoid_vec3 a, ovoid_vec3 b, double s) {
    return (ovoid_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline double vec3_dot(ovoid_vec3 a, ovoid_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// The quadratic form v' Q v.
static inline double sym3_quadratic(ovoid_sym3 q, ovoid_vec3 v) {
    return q.xx * v.x * v.x + q.yy * v.y * v.y + q.zz * v.z * v.z +
           2 * (q.xy * v.x * v.y + q.xz * v.x * v.z + q.yz * v.y * v.z);
}

static inline ovoid_sym3 sym3_mean(ovoid_sym3 a, ovoid_sym3 b) {
    return (ovoid_sym3){(a.xx + b.xx) / 2, (a.xy + b.xy) / 2, (a.xz + b.xz) / 2,
                        (a.yy + b.yy) / 2, (a.yz + b.yz) / 2, (a.zz + b.zz) / 2};
}
/// The inverse, by cofactors.
static inline ovoid_sym3 sym3_inverse(ovoid_sym3 s) {
    ovoid_sym3 c = {s.yy * s.zz - s.yz * s.yz, s.xz * s.yz - s.xy * s.zz, s.xy * s.yz - s.xz * s.yy,
                    s.xx * s.zz - s.xz * s.xz, s.xy * s.xz - s.xx * s.yz, s.xx * s.yy - s.xy * s.xy};
    double det = s.xx * c.xx + s.xy * c.xy + s.xz * c.xz;
    return (ovoid_sym3){c.xx / det, c.xy / det, c.xz / det, c.yy / det, c.yz / det, c.zz / det};
}

#endif
