// The poses of the bodies, frame by frame, and the rays of step (g) of Su, Liu, Chen.
#include "paper/experiment.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

ovoid_vec3 random_direction(uint64_t *state) {
    for (;;) {
        ovoid_vec3 v;
        v.x = random_uniform(state, -1, 1), v.y = random_uniform(state, -1, 1), v.z = random_uniform(state, -1, 1);
        double norm = sqrt(vec3_dot(v, v));
        if (norm > 0.1 && norm <= 1) return (ovoid_vec3){v.x / norm, v.y / norm, v.z / norm};
    }
}

ovoid_quat random_rotation(uint64_t *state) {
    for (;;) {
        ovoid_quat q;
        q.w = random_uniform(state, -1, 1), q.x = random_uniform(state, -1, 1);
        q.y = random_uniform(state, -1, 1), q.z = random_uniform(state, -1, 1);
        double squared = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
        if (squared > 0.01 && squared <= 1) return q;
    }
}

static double read_clock(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

/// The clock of the process; the monotonic clock if the former stands still for 50 us, as it may under a limit of
/// processor time, so that no time is zero.
static clockid_t choose_clock(void) {
    double start = read_clock(CLOCK_MONOTONIC), used = read_clock(CLOCK_PROCESS_CPUTIME_ID);
    while (read_clock(CLOCK_MONOTONIC) - start < 5e4) continue;
    return read_clock(CLOCK_PROCESS_CPUTIME_ID) > used ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
}

double clock_get_ns(void) {
    static clockid_t clock;
    static int is_chosen;
    if (!is_chosen) clock = choose_clock(), is_chosen = 1;
    return read_clock(clock);
}

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double find_quantile(double *values, size_t count, double q) {
    if (!count) return NAN;
    qsort(values, count, sizeof *values, compare_doubles);
    return values[(size_t)(q * (double)(count - 1) + 0.5)];
}

double experiment_get_radius(const paper_model *m) { return ovoid_shape_get_measures(m->shape).sphere_radius; }

ovoid_pair experiment_get_frame(const experiment *e, int object, uint32_t frame) {
    const double PI = 3.14159265358979323846;
    const paper_model *box = &e->models[0], *other = &e->models[object];
    // The round, its tilt and the start of the turn differ from object to object.
    uint64_t state = e->seed + 7919u * (uint64_t)object;
    double phase = random_uniform(&state, 0, 2 * PI), tilt = random_uniform(&state, 0, PI);
    ovoid_quat start = random_rotation(&state), own = random_rotation(&state);
    double t = 2 * PI * frame / e->frames, reach = experiment_get_radius(box) + experiment_get_radius(other);
    double distance = reach * (0.95 - 0.5 * cos(3 * t));
    ovoid_vec3 u = {cos(t + phase), sin(t + phase) * cos(tilt), sin(t + phase) * sin(tilt)};
    // The box spins about its own x axis: its start rotation times this one.
    double c = cos(2 * t), s = sin(2 * t);
    ovoid_quat q = {start.w * c - start.x * s, start.w * s + start.x * c, start.y * c + start.z * s,
                    start.z * c - start.y * s};
    return (ovoid_pair){
        box->shape, other->shape, {{distance * u.x, distance * u.y, distance * u.z}, q}, {{0, 0, 0}, own}};
}

ovoid_pair experiment_get_mutual(const experiment *e, int a, int b, uint32_t number) {
    uint64_t state = e->seed + 1000003u * (uint64_t)(a * MODEL_COUNT + b) + 31u * number;
    double reach = experiment_get_radius(&e->models[a]) + experiment_get_radius(&e->models[b]);
    double distance = reach * random_uniform(&state, 0.1, 2);
    ovoid_vec3 u = random_direction(&state);
    ovoid_quat qa = random_rotation(&state), qb = random_rotation(&state);
    return (ovoid_pair){e->models[a].shape,
                        e->models[b].shape,
                        {{0, 0, 0}, qa},
                        {{distance * u.x, distance * u.y, distance * u.z}, qb}};
}

exit_rays experiment_find_rays(const ovoid_pair *pair) {
    ovoid_ellipsoid inner[2] = {ovoid_shape_get_inner(pair->shape_a).ellipsoid,
                                ovoid_shape_get_inner(pair->shape_b).ellipsoid};
    ovoid_ellipsoid a = ovoid_ellipsoid_compute_posed(&inner[0], &pair->pose_a);
    ovoid_ellipsoid b = ovoid_ellipsoid_compute_posed(&inner[1], &pair->pose_b);
    ovoid_nearest found = ovoid_ellipsoid_compute_nearest_by_sphere(&a, &b);
    exit_rays r = {.overlap = (int)found.overlap};
    r.direction[0] = vec3_sub(ovoid_pose_compute_local_point(&pair->pose_a, found.point_a), inner[0].center);
    r.direction[1] = vec3_sub(ovoid_pose_compute_local_point(&pair->pose_b, found.point_b), inner[1].center);
    r.toward[0] = vec3_sub(ovoid_pose_compute_local_point(&pair->pose_a, b.center), inner[0].center);
    r.toward[1] = vec3_sub(ovoid_pose_compute_local_point(&pair->pose_b, a.center), inner[1].center);
    return r;
}
