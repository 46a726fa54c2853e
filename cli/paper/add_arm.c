// The union of primitives and robot links of the paper's sections 1 and 2: an arm of four convex links moves past an
// obstacle; the distance of the whole arm is the least of its links'.
#include "paper/experiment.h"

#include <math.h>
#include <string.h>

enum { LINKS = 4, STEPS = 240 };

/// The arm: links along their own z axis from 0 to `length`, rotated about y at each joint, the whole about z.
typedef struct arm {
    ovoid_shape *links[LINKS], *obstacle;
    ovoid_pose obstacle_pose;
} arm;

static const double lengths[LINKS] = {0.9, 0.8, 0.6, 0.35};

/// A tapered prism of eight sides with a rounding radius.
static ovoid_shape *create_link(int i) {
    double xyz[16 * 3], low = 0.13 - 0.02 * i, high = 0.11 - 0.02 * i;
    for (int k = 0; k < 16; k++) {
        double angle = 0.78539816339744831 * (k % 8), r = k < 8 ? low : high;
        xyz[3 * k] = r * cos(angle), xyz[3 * k + 1] = r * sin(angle), xyz[3 * k + 2] = k < 8 ? 0 : lengths[i];
    }
    const ovoid_shape_options rounded = {.radius = 0.02};
    return ovoid_shape_create_from_points(xyz, 16, &rounded, NULL);
}

static ovoid_quat multiply(ovoid_quat a, ovoid_quat b) {
    return (ovoid_quat){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// The links' poses at time t from 0 to 1: the base turns, the joints bend and stretch.
static void find_poses(double t, ovoid_pose poses[LINKS]) {
    double turn = -1.2 + 2.4 * t, bend[LINKS] = {0.5 + 0.2 * sin(6 * t), 0.7 - 0.5 * sin(5 * t), 0.5, 0.6 * cos(9 * t)};
    ovoid_quat q = {cos(turn / 2), 0, 0, sin(turn / 2)};
    ovoid_vec3 p = {0, 0, 0};
    for (int i = 0; i < LINKS; i++) {
        q = multiply(q, (ovoid_quat){cos(bend[i] / 2), 0, sin(bend[i] / 2), 0});
        poses[i] = (ovoid_pose){p, q};
        p = ovoid_pose_compute_point(&poses[i], (ovoid_vec3){0, 0, lengths[i] + 0.05});
    }
}

/// The nearest link and its answer; each link's query starts from its last proof.
static int find_nearest(const arm *a, const ovoid_pose poses[LINKS], ovoid_proof proofs[LINKS], ovoid_answer *answer) {
    int nearest = 0;
    for (int i = 0; i < LINKS; i++) {
        ovoid_pair pair = {a->links[i], a->obstacle, poses[i], a->obstacle_pose};
        ovoid_answer found = ovoid_depth(&pair, NULL, &proofs[i], NULL);
        proofs[i] = found.proof;
        if (i == 0 || found.lower < answer->lower) nearest = i, *answer = found;
    }
    return nearest;
}

static void add_picture(const experiment *e, const arm *a, double t, int nearest, const ovoid_answer *answer) {
    static const char *const names[LINKS] = {"link 1", "link 2", "link 3", "link 4"};
    ovoid_pose poses[LINKS];
    ovoid_picture_body bodies[LINKS + 1];
    find_poses(t, poses);
    for (int i = 0; i < LINKS; i++) bodies[i] = (ovoid_picture_body){names[i], a->links[i], poses[i], 0, NULL, 0};
    bodies[LINKS] = (ovoid_picture_body){"obstacle", a->obstacle, a->obstacle_pose, 0, NULL, 0};
    const ovoid_picture_link link = {(size_t)nearest, LINKS, answer};
    const ovoid_picture picture = {bodies, LINKS + 1, &link, 1, NULL, "m"};
    const ovoid_picture_options options = {
        900, 560, {0.6, -2, 0.7}, OVOID_PICTURE_WITNESS | OVOID_PICTURE_INNER | OVOID_PICTURE_NAMES};
    report_add_picture(e->report, "arm_picture", &picture, &options, "The arm where it is nearest to the obstacle.");
}

static int arm_make(arm *a) {
    int good = 1;
    for (int i = 0; i < LINKS; i++) good &= (a->links[i] = create_link(i)) != NULL;
    const double wedge[] = {-0.3, -0.3, 0, 0.3, -0.3, 0, 0.3, 0.3, 0, -0.3, 0.3, 0, -0.15, -0.1, 0.9, 0.1, 0.1, 1};
    a->obstacle = ovoid_shape_create_from_points(wedge, 6, NULL, NULL);
    a->obstacle_pose = (ovoid_pose){{1.15, 0.1, 0}, {1, 0, 0, 0.2}};
    return good && a->obstacle;
}

void experiment_add_arm(const experiment *e) {
    arm a = {{NULL}, NULL, {{0, 0, 0}, {1, 0, 0, 0}}};
    report_add_section(e->report, "An arm of convex links");
    if (arm_make(&a)) {
        double time[STEPS], distance[STEPS], least = INFINITY, worst = 0;
        ovoid_proof proofs[LINKS];
        memset(proofs, 0, sizeof proofs);
        ovoid_answer answer, best = {0};
        int nearest = 0, at = 0, link = 0;
        report_table *t = report_begin_table(e->report, "arm", "time,nearest link,lower,upper,stage");
        for (int i = 0; i < STEPS; i++) {
            ovoid_pose poses[LINKS];
            time[i] = (double)i / (STEPS - 1);
            find_poses(time[i], poses);
            link = find_nearest(&a, poses, proofs, &answer);
            distance[i] = answer.lower;
            worst = fmax(worst, answer.upper - answer.lower);
            if (answer.lower < least) least = answer.lower, at = i, nearest = link, best = answer;
            report_add_row(t, "%.5f,%d,%.9f,%.9f,%s", time[i], link + 1, answer.lower, answer.upper,
                           ovoid_stage_get_name(answer.stage));
        }
        report_end_table(t, 0);
        const ovoid_series series = {NULL, OVOID_SERIES_LINE, STEPS, time, distance, NULL, NULL};
        report_add_chart(e->report, "arm_distance",
                         &(ovoid_chart){.title = "Signed distance of the arm to the obstacle",
                                        .x_label = "time",
                                        .y_label = "m",
                                        .series = &series,
                                        .series_count = 1});
        add_picture(e, &a, time[at], nearest, &best);
        report_add_text(
            e->report,
            "Four rounded links and an obstacle, %d moments; every query starts from the link's last proof. The "
            "least distance is %.4f m, at time %.3f, of link %d. No bracket is wider than %.1e m.",
            STEPS, least, time[at], nearest + 1, worst);
    }
    for (int i = 0; i < LINKS; i++) ovoid_shape_destroy(a.links[i]);
    ovoid_shape_destroy(a.obstacle);
}
