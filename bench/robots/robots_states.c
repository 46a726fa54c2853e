// States: random free ones and random hits, one by one and in batches; the monitor's cycles.
#include "robots/robots.h"

#include "common/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIES = 8000, NEARS = 512 };

/// The wanted number of states of one kind, and their truth.
typedef struct states {
    double *q;
    state_truth *truths;
    uint32_t count;
} states;

static int is_hit(robots_scene *s, const double *q) {
    ovoid_robot_answer is;
    return ovoid_robot_collide(s->checker, &(ovoid_robot_query){q, NULL}, &is, NULL) != OVOID_OK ||
           is.status != OVOID_ROBOT_FREE;
}

/// Draws until there are enough of both kinds, or too many tries.
static int draw_states(robots_run *run, robots_scene *s, states kinds[2]) {
    machine *m = run->machine;
    uint32_t wanted = run->plan->states, width = m->variable_count;
    for (int hit = 0; hit < 2; hit++) {
        kinds[hit] = (states){malloc(sizeof(double) * wanted * width), malloc(sizeof(state_truth) * wanted), 0};
        if (!kinds[hit].q || !kinds[hit].truths) return 0;
    }
    double *q = malloc(sizeof *q * (width + 1));
    for (int i = 0; q && i < TRIES && (kinds[0].count < wanted || kinds[1].count < wanted); i++) {
        machine_draw(m, &s->random, q);
        states *to = &kinds[is_hit(s, q)];
        if (to->count < wanted) memcpy(to->q + (size_t)width * to->count++, q, sizeof *q * width);
    }
    free(q);
    return q != NULL;
}

static void judge_states(robots_run *run, const robots_scene *s, states *all, int said_hit) {
    for (uint32_t i = 0; i < all->count; i++) {
        state_truth *t = &all->truths[i];
        *t = robots_judge(s, run->machine, all->q + (size_t)i * run->machine->variable_count);
        run->open += !t->is_hit && !t->is_free;
        run->judged += t->is_hit || t->is_free;
        run->wrong += said_hit ? t->is_free : t->is_hit;
    }
    *(said_hit ? &run->states_hit : &run->states_free) += all->count;
}

/// Times states one by one; an answer counts as wrong if it differs from the truth.
static void time_alone(robots_run *run, robots_scene *s, const states *all, int hit, tallies *to) {
    uint32_t width = run->machine->variable_count, other = 0;
    ovoid_robot_checker_reset(s->checker);
    double start = get_own_seconds();
    for (uint32_t i = 0; i < all->count; i++) other += is_hit(s, all->q + (size_t)i * width) != hit;
    tally_add(tallies_get(to, "ovoid"), (get_own_seconds() - start) / all->count * 1e9);
    run->wrong += other;
}

static void time_batch(robots_run *run, robots_scene *s, const states *all, int hit, tallies *to) {
    ovoid_robot_answer *answers = malloc(sizeof *answers * all->count);
    if (!answers) return;
    ovoid_robot_batch batch = {all->q, all->count, NULL, answers};
    double start = get_own_seconds();
    ovoid_code code = ovoid_robot_collide_batch(&s->checker, 1, &batch, NULL);
    tally_add(tallies_get(to, "ovoid, batch"), (get_own_seconds() - start) / all->count * 1e9);
    for (uint32_t i = 0; i < all->count; i++)
        run->wrong += code != OVOID_OK || (answers[i].status != OVOID_ROBOT_FREE) != hit;
    free(answers);
}

static int ask_rival(const machine *m, const rival *r, const double *q, ovoid_pose *links) {
    if (!r->who->has_kinematics) (void)ovoid_robot_compute_poses(m->robot, q, links, NULL);
    return r->who->is_hit(r->self, q, r->who->has_kinematics ? NULL : links);
}

static void time_rival(robots_run *run, const rival *r, const states *all, tallies *to) {
    const machine *m = run->machine;
    ovoid_pose *links = malloc(sizeof *links * m->link_count);
    int *hits = malloc(sizeof *hits * (all->count + 1));
    if (links && hits) {
        double start = get_own_seconds();
        for (uint32_t i = 0; i < all->count; i++)
            hits[i] = ask_rival(m, r, all->q + (size_t)i * m->variable_count, links);
        tally *t = tallies_get(to, r->who->name);
        tally_add(t, (get_own_seconds() - start) / all->count * 1e9);
        for (uint32_t i = 0; i < all->count; i++)
            if (all->truths[i].is_hit || all->truths[i].is_free)
                tally_judge(t, hits[i], all->truths[i].is_hit, all->truths[i].depth);
    }
    free(links);
    free(hits);
}

void robots_run_states(robots_run *run, robots_scene *s, rival *rivals, uint32_t count) {
    states kinds[2] = {{0}, {0}};
    int good = draw_states(run, s, kinds);
    for (int hit = 0; good && hit < 2; hit++) {
        tallies *to = hit ? &run->hit_states : &run->free_states;
        if (kinds[hit].count == 0) continue;
        judge_states(run, s, &kinds[hit], hit);
        time_alone(run, s, &kinds[hit], hit, to);
        time_batch(run, s, &kinds[hit], hit, to);
        for (uint32_t k = 0; k < count; k++) time_rival(run, &rivals[k], &kinds[hit], to);
    }
    for (int hit = 0; hit < 2; hit++) {
        free(kinds[hit].q);
        free(kinds[hit].truths);
    }
}

// ---- the monitor

/// Every pair within the margin, with its gradient.
static double time_monitor(const robots_scene *s, ovoid_robot_checker *checker, const double *q,
                           ovoid_robot_nears *nears) {
    ovoid_robot_query_options options = {.margin = s->what.margin};
    double start = get_own_seconds();
    (void)ovoid_robot_find_near(checker, &(ovoid_robot_query){q, &options}, nears, NULL);
    return (get_own_seconds() - start) * 1e6;
}

/// near: the number of pairs; a rival with another count is wrong.
static void time_measure(robots_run *run, const rival *r, const double *q, ovoid_pose *links, size_t near) {
    double start = get_own_seconds();
    if (!r->who->has_kinematics) (void)ovoid_robot_compute_poses(run->machine->robot, q, links, NULL);
    uint32_t counted = r->who->measure(r->self, q, links);
    tally *t = tallies_get(&run->monitor, r->who->name);
    tally_add(t, (get_own_seconds() - start) * 1e6);
    tally_judge(t, counted >= near, counted <= near, 0);
}

/// From one random state toward another, the fastest joint by 0.01 a cycle.
void robots_run_monitor(robots_run *run, robots_scene *s, rival *rivals, uint32_t count) {
    machine *m = run->machine;
    uint32_t width = m->variable_count;
    double *q = malloc(sizeof *q * 3 * (width + 1)), *to = q + width, *at = to + width;
    ovoid_pose *links = malloc(sizeof *links * m->link_count);
    ovoid_robot_nears nears = {.items = malloc(sizeof *nears.items * NEARS),
                               .gradients = malloc(sizeof(double) * NEARS * (width + 1)),
                               .capacity = NEARS};
    // The query of the peers: distances alone, and for overlaps only that there is one.
    ovoid_robot_checker *plain = ovoid_robot_checker_create(s->cell, NULL, NULL);
    if (q && links && nears.items && nears.gradients && plain) {
        double most = 0;
        machine_draw(m, &s->random, q);
        machine_draw(m, &s->random, to);
        for (uint32_t i = 0; i < width; i++) most = fmax(most, fabs(to[i] - q[i]));
        for (uint32_t k = 0; k < run->plan->cycles; k++) {
            for (uint32_t i = 0; i < width; i++) at[i] = q[i] + (to[i] - q[i]) * fmin(1, 0.01 * k / most);
            double time = time_monitor(s, s->checker, at, &nears);
            size_t expected = nears.count;
            ovoid_robot_nears alone = {.items = nears.items, .capacity = NEARS, .without_depths = 1};
            double time_alone = time_monitor(s, plain, at, &alone);
            run->wrong += alone.count != expected;
            if (k > 0) tally_add(tallies_get(&run->monitor, "ovoid, distances"), time_alone);
            // The first cycle has no earlier state.
            if (k > 0) tally_add(tallies_get(&run->monitor, "ovoid, gradients"), time);
            if (k > 0) run->near += (double)nears.count;
            for (uint32_t r = 0; r < count; r++)
                if (k > 0 && rivals[r].who->measure) time_measure(run, &rivals[r], at, links, nears.count);
        }
    }
    free(q);
    free(links);
    ovoid_robot_checker_destroy(plain);
    free(nears.items);
    free(nears.gradients);
}
