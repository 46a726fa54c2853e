// The truth about a robot's state, and the faults of answers. The truth is found pair by pair, without a tree, a box or
// a proof of an earlier state; each pair's proof is verified by ovoid_answer_verify.
#include "robots/robots.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Far more than the error of the kinematics.
static const double pose_error = 1e-11;

/// A body of the scene.
typedef struct judged {
    const ovoid_shape *shape;
    ovoid_pose pose;
    ovoid_vec3 middle;
    double reach;
} judged;

static judged make_judged(const ovoid_shape *shape, ovoid_pose pose) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_measures m = ovoid_shape_get_measures(shape);
    ovoid_vec3 c = {m.sphere_center.x + p.origin.x, m.sphere_center.y + p.origin.y, m.sphere_center.z + p.origin.z};
    ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    return (judged){shape, pose, ovoid_pose_compute_point(&pose, c),
                    (m.sphere_radius + ovoid_shape_get_radius(shape) + allowance.outside) * (1 + 1e-9) + pose_error};
}

static double get_apart(const judged *a, const judged *b) {
    double x = a->middle.x - b->middle.x, y = a->middle.y - b->middle.y, z = a->middle.z - b->middle.z;
    return sqrt(x * x + y * y + z * z) * (1 - 1e-9) - a->reach - b->reach;
}

static void judge_pair(const judged *a, const judged *b, state_truth *right) {
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    static ovoid_cover cover = {.memory = memory, .size = sizeof memory};
    double apart = get_apart(a, b);
    if (apart > right->gap) return;
    if (apart > 0.01 * (a->reach + b->reach)) {
        right->gap = fmin(right->gap, apart);
        return;
    }
    ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
    ovoid_answer is = ovoid_depth(&pair, NULL, NULL, &cover);
    if (ovoid_answer_verify(&pair, &is, &(ovoid_answer_basis){.cover = &cover}, NULL) != OVOID_OK) {
        right->is_free = 0;
        return;
    }
    right->gap = fmin(right->gap, is.lower - pose_error);
    if (!(is.lower > pose_error)) right->is_free = 0;
    if (is.upper < -pose_error) {
        right->is_hit = 1;
        right->depth = fmax(right->depth, -is.upper);
    }
}

state_truth robots_judge(const robots_scene *s, const machine *m, const double *q) {
    state_truth right = {0, 1, 0, INFINITY};
    ovoid_pose *links = malloc(sizeof *links * m->link_count);
    judged *all = malloc(sizeof *all * (m->element_count + 1));
    if (!links || !all || ovoid_robot_compute_poses(m->robot, q, links, NULL) != OVOID_OK) {
        free(links);
        free(all);
        return (state_truth){0, 0, 0, 0};
    }
    for (uint32_t i = 0; i < m->element_count; i++) {
        const placed_solid *e = &m->elements[i];
        ovoid_pose pose = ovoid_pose_compute_product(&links[e->link], &e->pose);
        all[i] = make_judged(m->solids[e->solid].hull.shape, pose);
        for (uint32_t k = 0; k < s->what.obstacle_count; k++) {
            judged obstacle = make_judged(m->solids[s->obstacles[k].solid].hull.shape, s->obstacles[k].pose);
            judge_pair(&all[i], &obstacle, &right);
        }
        for (uint32_t k = 0; k < i; k++)
            if (!m->ignored[e->link * m->link_count + m->elements[k].link]) judge_pair(&all[k], &all[i], &right);
    }
    free(links);
    free(all);
    if (right.is_hit) right.is_free = 0;
    return right;
}

// ---- tallies

tally *tallies_get(tallies *all, const char *line) {
    for (uint32_t i = 0; i < all->count; i++)
        if (!strcmp(all->items[i].line, line)) return &all->items[i];
    static tally none;
    if (all->count == TALLIES_MOST) return &none;
    tally *t = &all->items[all->count++];
    t->line = line;
    return t;
}

/// Makes room for one more; 0: it is not counted.
static int grow(double **list, uint32_t count, uint32_t *room) {
    if (count < *room) return 1;
    uint32_t wanted = *room ? 2 * *room : 256;
    double *more = realloc(*list, sizeof *more * wanted);
    if (!more) return 0;
    *list = more;
    *room = wanted;
    return 1;
}

void tally_add(tally *t, double sample) {
    if (grow(&t->samples, t->count, &t->room)) t->samples[t->count++] = sample;
}

void tally_judge(tally *t, int said_hit, int is_hit, double depth) {
    t->judged++;
    t->false_alarms += said_hit && !is_hit;
    if (said_hit || !is_hit) return;
    t->missed++;
    if (depth > 0 && grow(&t->depths, t->depth_count, &t->depth_room)) t->depths[t->depth_count++] = depth;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_tally(tally *t) {
    // timing_make has sorted the samples.
    double nine = t->samples[t->count * 9 / 10], last = t->samples[t->count * 99 / 100];
    printf("%38s 90 %%: %.4g, 99 %%: %.4g, most %.4g", "", nine, last, t->samples[t->count - 1]);
    if (t->judged > 0) printf("; of %.0f: missed %.0f, false alarms %.0f", t->judged, t->missed, t->false_alarms);
    if (t->depth_count) {
        qsort(t->depths, t->depth_count, sizeof *t->depths, compare_numbers);
        printf("; missed by %.2g mm in the middle, at most %.2g mm", 1e3 * t->depths[t->depth_count / 2],
               1e3 * t->depths[t->depth_count - 1]);
    }
    printf("\n");
}

void tallies_report(tallies *all, rows *out, const char *chart, const char *unit, double x) {
    for (uint32_t i = 0; i < all->count; i++) {
        tally *t = &all->items[i];
        if (t->count) {
            timing time = timing_make(t->samples, t->count);
            rows_add(out, (row){chart, "obstacles", unit, t->line, x, time, t->judged, t->missed + t->false_alarms});
            print_tally(t);
        }
        free(t->samples);
        free(t->depths);
    }
    *all = (tallies){.count = 0};
}
