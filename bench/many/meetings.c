// The truth about many bodies rests on a search for candidates that is simple enough to be trusted, and on proofs that
// ovoid_answer_verify has accepted.
#include "many/meetings.h"

#include "common/rotation.h"

#include <math.h>
#include <string.h>

static int compare_meetings(const void *a, const void *b) {
    const meeting *x = a, *y = b;
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    return (x->b > y->b) - (x->b < y->b);
}

void meetings_sort(meetings *all) {
    if (all->count) qsort(all->items, all->count, sizeof *all->items, compare_meetings);
}

void meeting_truth_destroy(meeting_truth *truth) {
    free(truth->sure.items);
    free(truth->open.items);
    *truth = (meeting_truth){0};
}

// --- a swarm

/// A box and its body; the sweep is along x.
typedef struct boxed {
    double low[3], high[3];
    uint32_t body;
} boxed;

/// The box of the vertices, widened by far more than their rounding.
static boxed make_box(const body *b, const ovoid_pose *pose, uint32_t index) {
    boxed box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, index};
    const double at[3] = {pose->position.x, pose->position.y, pose->position.z};
    rotation turn = rotation_make(pose->rotation);
    for (int k = 0; k < 3; k++) {
        const double *row = turn.m + (ptrdiff_t)3 * k;
        for (uint32_t i = 0; i < b->vertex_count; i++) {
            const double *v = b->vertices + (size_t)3 * i;
            double x = row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + at[k];
            box.low[k] = fmin(box.low[k], x);
            box.high[k] = fmax(box.high[k], x);
        }
        double slack = 1e-9 * (fabs(at[k]) + box.high[k] - box.low[k]);
        box.low[k] -= slack;
        box.high[k] += slack;
    }
    return box;
}

static int compare_boxes(const void *a, const void *b) {
    double x = ((const boxed *)a)->low[0], y = ((const boxed *)b)->low[0];
    return (x > y) - (x < y);
}

static int do_overlap(const boxed *a, const boxed *b) {
    return a->low[1] <= b->high[1] && b->low[1] <= a->high[1] && a->low[2] <= b->high[2] && b->low[2] <= a->high[2];
}

static void decide_touch(const swarm *what, const ovoid_pose *poses, uint32_t a, uint32_t b, meeting_truth *truth) {
    ovoid_pair pair = {what->shapes[what->shape_of[a]].shape, what->shapes[what->shape_of[b]].shape, poses[a],
                       poses[b]};
    ovoid_answer answer = ovoid_collide(&pair, NULL, NULL);
    int proven = ovoid_answer_verify(&pair, &answer, NULL, NULL) == OVOID_OK;
    truth->unproven += !proven;
    if (!proven || answer.status == OVOID_UNDECIDED || answer.status == OVOID_TOUCHING)
        meetings_add(&truth->open, a, b, 0);
    else if (answer.status == OVOID_OVERLAPPING)
        meetings_add(&truth->sure, a, b, 0);
}

int swarm_compute_truth(const swarm *what, const ovoid_pose *poses, meeting_truth *truth) {
    *truth = (meeting_truth){0};
    boxed *boxes = malloc(sizeof *boxes * what->body_count);
    if (!boxes) return 0;
    for (uint32_t i = 0; i < what->body_count; i++) boxes[i] = make_box(&what->shapes[what->shape_of[i]], &poses[i], i);
    qsort(boxes, what->body_count, sizeof *boxes, compare_boxes);
    for (uint32_t i = 0; i < what->body_count; i++)
        for (uint32_t k = i + 1; k < what->body_count && boxes[k].low[0] <= boxes[i].high[0]; k++)
            if (do_overlap(&boxes[i], &boxes[k])) {
                truth->boxes++;
                uint32_t a = boxes[i].body, b = boxes[k].body;
                decide_touch(what, poses, a < b ? a : b, a < b ? b : a, truth);
            }
    free(boxes);
    meetings_sort(&truth->sure);
    meetings_sort(&truth->open);
    return !truth->sure.failed && !truth->open.failed;
}

// --- a state of a robot

/// A body of the cell with its enclosing sphere, widened by far more than its rounding.
typedef struct balled {
    const body *body;
    ovoid_pose pose;
    ovoid_vec3 middle;
    double radius;
} balled;

static balled make_ball(const workcell *what, const ovoid_pose *links, uint32_t index) {
    const body *b = &what->shapes[what->shape_of[index]];
    balled ball = {b, index < what->link_count ? links[index] : what->parts[index - what->link_count], {0, 0, 0}, 0};
    ball.middle = ovoid_pose_compute_point(&ball.pose, b->center);
    for (uint32_t i = 0; i < b->vertex_count; i++) {
        const double *v = b->vertices + (size_t)3 * i;
        double x = v[0] - b->center.x, y = v[1] - b->center.y, z = v[2] - b->center.z;
        ball.radius = fmax(ball.radius, sqrt(x * x + y * y + z * z));
    }
    ball.radius *= 1 + 1e-9;
    return ball;
}

/// 0 if the spheres show that the two are farther than the margin.
static int may_meet(const balled *a, const balled *b, double margin) {
    double x = a->middle.x - b->middle.x, y = a->middle.y - b->middle.y, z = a->middle.z - b->middle.z;
    double most = (a->radius + b->radius + margin) * (1 + 1e-9);
    return x * x + y * y + z * z <= most * most;
}

/// 1 if the two are certain to meet.
static int decide_near(const balled balls[2], const uint32_t names[2], double margin, meeting_truth *truth) {
    ovoid_pair pair = {balls[0].body->shape, balls[1].body->shape, balls[0].pose, balls[1].pose};
    ovoid_answer answer = margin > 0 ? ovoid_distance(&pair, NULL, NULL) : ovoid_collide(&pair, NULL, NULL);
    if (ovoid_answer_verify(&pair, &answer, NULL, NULL) != OVOID_OK) {
        truth->unproven++;
        answer.lower = -INFINITY;
        answer.upper = INFINITY;
    }
    if (answer.lower > margin) return 0;
    if (answer.upper < margin) {
        meetings_add(&truth->sure, names[0], names[1], fmax(answer.upper, 0));
        return 1;
    }
    meetings_add(&truth->open, names[0], names[1], 0);
    return 0;
}

int cell_compute_truth(const workcell *what, const ovoid_pose *links, double margin, int find_one,
                       meeting_truth *truth) {
    *truth = (meeting_truth){0};
    uint32_t count = what->link_count + what->part_count;
    balled *balls = malloc(sizeof *balls * count);
    if (!balls) return 0;
    for (uint32_t i = 0; i < count; i++) balls[i] = make_ball(what, links, i);
    int done = 0;
    for (uint32_t a = 0; a < what->link_count && !done; a++)
        for (uint32_t b = a + 1; b < count && !done; b++) {
            if (b < what->link_count && what->ignored[a * what->link_count + b]) continue;
            if (!may_meet(&balls[a], &balls[b], margin)) continue;
            done = decide_near((balled[2]){balls[a], balls[b]}, (uint32_t[2]){a, b}, margin, truth) && find_one;
        }
    free(balls);
    return !truth->sure.failed && !truth->open.failed;
}

// --- judging

static int is_in(const meetings *all, const meeting *one) {
    return all->count && bsearch(one, all->items, all->count, sizeof *all->items, compare_meetings) != NULL;
}

meeting_faults meetings_judge(meetings *list, const meeting_truth *truth, double distance_error) {
    meeting_faults faults = {0};
    meetings_sort(list);
    const meetings *sure = &truth->sure;
    size_t i = 0, k = 0;
    // Walks both lists in step; a pair that is listed twice is one too many.
    while (i < list->count || k < sure->count) {
        int order = i == list->count ? 1 : k == sure->count ? -1 : compare_meetings(&list->items[i], &sure->items[k]);
        if (order < 0) {
            faults.extra += !is_in(&truth->open, &list->items[i]);
            i++;
        } else if (order > 0) {
            faults.missing++;
            k++;
        } else {
            // Overlaps may come with a depth. Written so that NaN counts as wrong.
            double apart = list->items[i].distance < 0 ? 0 : list->items[i].distance;
            faults.off += distance_error >= 0 && !(fabs(apart - sure->items[k].distance) <= distance_error);
            i++;
            k++;
        }
    }
    return faults;
}
