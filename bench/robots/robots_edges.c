// Edges: ovoid proves them, peers check some of their states; the states along an edge, one after another.
#include "robots/robots.h"

#include "common/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double lengths[3] = {0.1, 0.5, 1};

uint32_t robots_count_samples(const machine *m, const double *q0, const double *q1) {
    double moved = 0, range = 0;
    for (uint32_t i = 0; i < m->variable_count; i++) {
        moved += fabs(q1[i] - q0[i]);
        range += m->high[i] - m->low[i];
    }
    return (uint32_t)ceil(moved / (ROBOTS_RESOLUTION * range)) + 1;
}

/// An edge and its proven result.
typedef struct edge {
    double *q; ///< its two states, then one for work
    uint32_t samples;
    ovoid_robot_path_answer answer;
    double depth; ///< for a hit: the greatest depth in the sampled states
} edge;

/// From a free state, in a random direction: each joint by up to that share of its range. 0: none was found.
static int draw_edge(robots_run *run, robots_scene *s, edge *e, double length) {
    const machine *m = run->machine;
    uint32_t width = m->variable_count;
    ovoid_robot_answer answer;
    for (int i = 0; i < 100; i++) {
        machine_draw(m, &s->random, e->q);
        for (uint32_t k = 0; k < width; k++) {
            double by = random_uniform(&s->random, -0.5, 0.5) * length * (m->high[k] - m->low[k]);
            e->q[width + k] = fmin(fmax(e->q[k] + by, m->low[k]), m->high[k]);
        }
        if (ovoid_robot_collide(s->checker, &(ovoid_robot_query){e->q, NULL}, &answer, NULL) != OVOID_OK ||
            answer.status != OVOID_ROBOT_FREE)
            continue;
        e->samples = robots_count_samples(m, e->q, e->q + width);
        return 1;
    }
    return 0;
}

/// One query of the edge: the first hit or, as in sampling, any hit. Its time in microseconds; below zero: it failed.
static double ask(robots_scene *s, const edge *e, int any_hit, ovoid_robot_path_answer *answer) {
    ovoid_robot_path path = {e->q, 2};
    ovoid_robot_path_options options = {.any_hit = any_hit};
    double start = get_own_seconds();
    ovoid_code code = ovoid_robot_path_find_hit(s->checker, &(ovoid_robot_path_query){&path, &options}, answer, NULL);
    return code == OVOID_OK ? (get_own_seconds() - start) * 1e6 : -1;
}

/// Both queries in turn: the first of the two is timed, as no memory of the edge helps it. One more search writes the
/// steps, and ovoid_robot_path_verify measures them again.
static void prove(robots_run *run, robots_scene *s, edge *e, uint32_t length) {
    enum { STEPS = 1 << 16 };
    static ovoid_robot_step steps[STEPS];
    int any_first = run->edge_count++ / 3 % 2;
    ovoid_robot_path_answer any;
    double times[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        int is_any = k ^ any_first;
        times[is_any] = ask(s, e, is_any, is_any ? &any : &e->answer);
    }
    if (times[0] < 0 || times[1] < 0) {
        run->wrong++;
        return;
    }
    int is_hit = e->answer.status == OVOID_ROBOT_HIT;
    tallies *to = is_hit ? &run->hit_edges[length] : &run->edges[length];
    if (is_hit || e->answer.status == OVOID_ROBOT_FREE)
        tally_add(tallies_get(to, any_first ? "ovoid, any hit" : "ovoid, first hit"), times[any_first]);
    ovoid_robot_path path = {e->q, 2};
    ovoid_robot_path_options options = {.steps = steps, .capacity = STEPS};
    ovoid_robot_path_answer again;
    ovoid_code code = ovoid_robot_path_find_hit(s->checker, &(ovoid_robot_path_query){&path, &options}, &again, NULL);
    if (code == OVOID_OK && again.step_count <= STEPS)
        code = ovoid_robot_path_verify(s->cell, &again, &(ovoid_robot_path_basis){{&path, &options}, steps}, NULL);
    run->judged++;
    run->wrong += code != OVOID_OK || again.status != e->answer.status || any.status != e->answer.status;
}

/// Edges of a length that are free, or hit, to be asked at once.
typedef struct edge_group {
    double *q;
    uint32_t count;
    int is_hit;
} edge_group;

static void keep_edge(edge_group *g, const edge *e, uint32_t width) {
    double *more = realloc(g->q, sizeof *more * 2 * width * (g->count + 1));
    if (!more) return;
    g->q = more;
    memcpy(more + (size_t)2 * width * g->count++, e->q, sizeof *more * 2 * width);
}

/// Any hit of all edges of a group by one call, on one thread: each has an equal share of its time.
static void prove_group(robots_run *run, robots_scene *s, const edge_group *g, tallies *to) {
    ovoid_robot_path_answer *answers = calloc(g->count + 1, sizeof *answers);
    const ovoid_robot_path_options options = {.any_hit = 1};
    const ovoid_robot_edge_batch batch = {g->q, g->count, &options, answers};
    ovoid_robot_status expected = g->is_hit ? OVOID_ROBOT_HIT : OVOID_ROBOT_FREE;
    double start = get_own_seconds();
    if (g->count && answers && ovoid_robot_path_find_hit_batch(&s->checker, 1, &batch, NULL) == OVOID_OK) {
        double share = (get_own_seconds() - start) / g->count;
        for (uint32_t i = 0; i < g->count; i++) {
            tally_add(tallies_get(to, "ovoid, any hit, batch"), share * 1e6);
            run->wrong += answers[i].status != expected;
        }
    }
    free(answers);
}

/// Edges of a length in batches, those that hit apart from free ones; as many as a planner may have at hand.
static void prove_batches(robots_run *run, robots_scene *s, edge *e, uint32_t length) {
    enum { EDGES = 32 };
    edge_group groups[2] = {{NULL, 0, 0}, {NULL, 0, 1}};
    for (int i = 0; i < EDGES && draw_edge(run, s, e, lengths[length]); i++) {
        if (ask(s, e, 0, &e->answer) < 0) break;
        int is_hit = e->answer.status == OVOID_ROBOT_HIT;
        if (is_hit || e->answer.status == OVOID_ROBOT_FREE) keep_edge(&groups[is_hit], e, run->machine->variable_count);
    }
    prove_group(run, s, &groups[0], &run->edges[length]);
    prove_group(run, s, &groups[1], &run->hit_edges[length]);
    free(groups[0].q);
    free(groups[1].q);
}

static void place_sample(const machine *m, const edge *e, uint32_t i, double *q) {
    double t = (double)i / (e->samples - 1);
    for (uint32_t k = 0; k < m->variable_count; k++) q[k] = e->q[k] + t * (e->q[m->variable_count + k] - e->q[k]);
}

/// The depth of a hit that samples may miss, in the states at 8 times the resolution; and whether the truth of a state
/// contradicts the proof.
static void judge_edge(robots_run *run, const robots_scene *s, edge *e, double *q) {
    const machine *m = run->machine;
    e->depth = 0;
    edge fine = *e;
    fine.samples = e->answer.status == OVOID_ROBOT_HIT ? 8 * (e->samples - 1) + 1 : e->samples;
    for (uint32_t i = 0; i < fine.samples; i++) {
        place_sample(m, &fine, i, q);
        double at = (double)i / (fine.samples - 1);
        state_truth t = robots_judge(s, m, q);
        e->depth = fmax(e->depth, t.depth);
        run->judged++;
        run->wrong += t.is_hit && at < e->answer.free_until;
    }
}

static int sample_edge(const machine *m, const rival *r, const edge *e, double *q, ovoid_pose *links) {
    if (r->who->is_edge_hit) return r->who->is_edge_hit(r->self, e->q, e->q + m->variable_count, e->samples);
    for (uint32_t i = 0; i < e->samples; i++) {
        place_sample(m, e, i, q);
        if (!r->who->has_kinematics) (void)ovoid_robot_compute_poses(m->robot, q, links, NULL);
        if (r->who->is_hit(r->self, q, r->who->has_kinematics ? NULL : links)) return 1;
    }
    return 0;
}

/// A sampler's query and, if the edge is free, its cost for each state.
static void time_rival(robots_run *run, const rival *r, const edge *e, double *q, ovoid_pose *links, tally *to) {
    double start = get_own_seconds();
    int said_hit = sample_edge(run->machine, r, e, q, links);
    double time = get_own_seconds() - start;
    tally_add(to, time * 1e6);
    int is_hit = e->answer.status == OVOID_ROBOT_HIT;
    tally_judge(to, said_hit, is_hit, e->depth);
    if (!is_hit && !said_hit) tally_add(tallies_get(&run->along, r->who->name), time / e->samples * 1e9);
}

/// Times ovoid as a sampler.
static void time_along(robots_run *run, robots_scene *s, const edge *e) {
    const machine *m = run->machine;
    uint32_t hits = 0;
    if (!e->samples) return;
    double *all = malloc(sizeof *all * e->samples * (m->variable_count + 1));
    ovoid_robot_answer *answers = malloc(sizeof *answers * e->samples);
    if (all && answers) {
        for (uint32_t i = 0; i < e->samples; i++) place_sample(m, e, i, all + (size_t)i * m->variable_count);
        double start = get_own_seconds();
        for (uint32_t i = 0; i < e->samples; i++) {
            (void)ovoid_robot_collide(s->checker, &(ovoid_robot_query){all + (size_t)i * m->variable_count, NULL},
                                      &answers[i], NULL);
            hits += answers[i].status == OVOID_ROBOT_HIT;
        }
        tally_add(tallies_get(&run->along, "ovoid"), (get_own_seconds() - start) / e->samples * 1e9);
        ovoid_robot_batch batch = {all, e->samples, NULL, answers};
        start = get_own_seconds();
        (void)ovoid_robot_collide_batch(&s->checker, 1, &batch, NULL);
        tally_add(tallies_get(&run->along, "ovoid, batch"), (get_own_seconds() - start) / e->samples * 1e9);
        for (uint32_t i = 0; i < e->samples; i++) hits += answers[i].status == OVOID_ROBOT_HIT;
    }
    run->wrong += hits;
    free(all);
    free(answers);
}

void robots_run_edges(robots_run *run, robots_scene *s, rival *rivals, uint32_t count) {
    const machine *m = run->machine;
    double *q = malloc(sizeof *q * 3 * (m->variable_count + 1));
    ovoid_pose *links = malloc(sizeof *links * m->link_count);
    edge e = {.q = q};
    // The first search of a checker allocates its memory for paths, and the first by covers makes them.
    if (q && links && draw_edge(run, s, &e, 0.1)) {
        (void)ask(s, &e, 0, &e.answer);
        double first = ask(s, &e, 1, &e.answer), second = ask(s, &e, 1, &e.answer);
        if (second >= 0) tally_add(tallies_get(&run->covers, "ovoid"), first - second);
    }
    for (uint32_t i = 0; q && links && i < 3 * run->plan->edges; i++) {
        uint32_t length = i % 3;
        if (!draw_edge(run, s, &e, lengths[length])) break;
        prove(run, s, &e, length);
        if (e.answer.status != OVOID_ROBOT_FREE && e.answer.status != OVOID_ROBOT_HIT) continue;
        int is_hit = e.answer.status == OVOID_ROBOT_HIT;
        double *work = q + (size_t)2 * m->variable_count;
        judge_edge(run, s, &e, work);
        if (!is_hit) time_along(run, s, &e);
        tallies *lines = is_hit ? &run->hit_edges[length] : &run->edges[length];
        for (uint32_t r = 0; r < count; r++)
            time_rival(run, &rivals[r], &e, work, links, tallies_get(lines, rivals[r].who->name));
    }
    for (uint32_t length = 0; q && length < 3; length++) prove_batches(run, s, &e, length);
    free(q);
    free(links);
}
