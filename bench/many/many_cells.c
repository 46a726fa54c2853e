// A robot among its surroundings, with the queries of two programs. The planner draws joint angles at random and asks
// whether anything touches; the monitor follows a smooth path and asks, each cycle, for every distance below the
// margin. The links' poses are computed before the clock runs; contestants take turns block by block, or cycle by
// cycle.
#include "many/many.h"

#include "common/random.h"
#include "many/meetings.h"
#include "many/robot.h"

#include <stdio.h>
#include <string.h>

enum { BLOCK = 100, SAMPLES_MOST = 20000 };

/// The share of the margin by which a monitored distance may be off.
static const double distance_error = 1e-4;

typedef struct contestant {
    const cell_peer *who;
    void *self;
    double *samples; ///< microseconds for each state
    double judged, missing, extra, off;
} contestant;

typedef struct cell_run {
    const robot *machine;
    contestant all[CONTESTANTS_MOST];
    uint32_t count, taken;
    double hits, states, near, open, unproven;
} cell_run;

static void leave(cell_run *run) {
    for (uint32_t k = 0; k < run->count; k++) {
        free(run->all[k].samples);
        if (run->all[k].self) run->all[k].who->destroy(run->all[k].self);
    }
}

static int enter(cell_run *run, const robot *machine, const many_field *field) {
    *run = (cell_run){.machine = machine};
    double angles[ROBOT_LINKS_MOST];
    ovoid_pose links[ROBOT_LINKS_MOST];
    for (uint32_t k = 0; k < machine->cell.link_count; k++)
        angles[k] = (machine->joints[k].low + machine->joints[k].high) / 2;
    robot_compute_poses(machine, angles, links);
    for (uint32_t k = 0; k < field->cell_count; k++) {
        contestant *c = &run->all[run->count++];
        c->who = field->cells[k];
        c->self = c->who->create(&machine->cell, links);
        c->samples = malloc(sizeof *c->samples * SAMPLES_MOST);
        if (!c->self || !c->samples) return 0;
    }
    return 1;
}

static void report(rows *all, cell_run *run, const char *chart) {
    for (uint32_t k = 0; k < run->count; k++) {
        contestant *c = &run->all[k];
        rows_add(all, (row){chart, "parts", "us", c->who->name, run->machine->cell.part_count,
                            timing_make(c->samples, run->taken), c->judged, c->missing + c->extra + c->off});
        if (c->missing + c->extra + c->off > 0)
            printf("%40s missing %.0f, too many %.0f, distances off %.0f\n", "", c->missing, c->extra, c->off);
    }
}

// --- the planner

/// A block's states, and the answers of every contestant.
typedef struct block {
    ovoid_pose links[BLOCK][ROBOT_LINKS_MOST];
    int hits[CONTESTANTS_MOST][BLOCK];
    uint32_t count;
} block;

static void time_block(cell_run *run, block *b, uint32_t round) {
    for (uint32_t j = 0; j < run->count; j++) {
        uint32_t k = (j + round) % run->count;
        contestant *c = &run->all[k];
        double start = get_own_seconds();
        for (uint32_t i = 0; i < b->count; i++) b->hits[k][i] = c->who->is_hit(c->self, b->links[i]);
        c->samples[run->taken] = (get_own_seconds() - start) / b->count * 1e6;
    }
    run->taken++;
}

static int judge_block(cell_run *run, const block *b) {
    for (uint32_t i = 0; i < b->count; i++) {
        meeting_truth right;
        if (!cell_compute_truth(&run->machine->cell, b->links[i], 0, 1, &right)) return 0;
        int hit = right.sure.count > 0, open = !hit && right.open.count > 0;
        run->states++;
        run->hits += hit;
        run->open += open;
        run->unproven += (double)right.unproven;
        for (uint32_t k = 0; !open && k < run->count; k++) {
            run->all[k].judged++;
            run->all[k].missing += hit && !b->hits[k][i];
            run->all[k].extra += !hit && b->hits[k][i];
        }
        meeting_truth_destroy(&right);
    }
    return 1;
}

static int run_planner(rows *all, const robot *machine, const many_field *field, uint32_t states, const char *chart) {
    static block b;
    cell_run run;
    int good = enter(&run, machine, field);
    uint64_t random = 5;
    for (uint32_t done = 0; good && done < states && run.taken < SAMPLES_MOST; done += b.count) {
        b.count = states - done < BLOCK ? states - done : BLOCK;
        for (uint32_t i = 0; i < b.count; i++) {
            double angles[ROBOT_LINKS_MOST];
            robot_draw(machine, &random, angles);
            robot_compute_poses(machine, angles, b.links[i]);
        }
        time_block(&run, &b, run.taken);
        good = judge_block(&run, &b);
    }
    if (good) {
        report(all, &run, chart);
        printf("%12s  %.0f states, %.1f %% hit; open %.0f, unproven %.0f\n", "", run.states,
               100 * run.hits / run.states, run.open, run.unproven);
    }
    leave(&run);
    return good;
}

// --- the monitor

/// Angles on the way from one random state to the next; the joint with the longest way moves by 0.01 radians a cycle.
typedef struct path {
    double from[ROBOT_LINKS_MOST], to[ROBOT_LINKS_MOST];
    uint32_t at, steps;
    uint64_t random;
} path;

static void path_advance(path *p, const robot *machine, double *angles) {
    uint32_t count = machine->cell.link_count;
    if (p->at == p->steps) {
        if (p->steps == 0)
            robot_draw(machine, &p->random, p->from);
        else
            memcpy(p->from, p->to, sizeof p->from);
        robot_draw(machine, &p->random, p->to);
        double most = 0;
        for (uint32_t k = 0; k < count; k++) most = fmax(most, fabs(p->to[k] - p->from[k]));
        p->at = 0;
        p->steps = (uint32_t)(most / 0.01) + 1;
    }
    double part = (double)p->at++ / p->steps;
    for (uint32_t k = 0; k < count; k++) angles[k] = p->from[k] + part * (p->to[k] - p->from[k]);
}

/// Each tenth cycle is judged.
static int judge_cycle(cell_run *run, const ovoid_pose *links, meetings *lists) {
    meeting_truth right;
    double margin = run->machine->cell.margin;
    int good = cell_compute_truth(&run->machine->cell, links, margin, 0, &right);
    run->states++;
    run->near += (double)right.sure.count;
    run->open += (double)right.open.count;
    run->unproven += (double)right.unproven;
    for (uint32_t k = 0; good && k < run->count; k++) {
        meeting_faults wrong = meetings_judge(&lists[k], &right, distance_error * margin);
        contestant *c = &run->all[k];
        c->judged += (double)right.sure.count;
        c->missing += (double)wrong.missing;
        c->extra += (double)wrong.extra;
        c->off += (double)wrong.off;
        good = !lists[k].failed;
    }
    meeting_truth_destroy(&right);
    return good;
}

static int run_cycle(cell_run *run, const ovoid_pose *links, meetings *lists, uint32_t cycle) {
    for (uint32_t j = 0; j < run->count; j++) {
        uint32_t k = (j + cycle) % run->count;
        contestant *c = &run->all[k];
        lists[k].count = 0;
        double start = get_own_seconds();
        c->who->measure(c->self, links, &lists[k]);
        c->samples[run->taken] = (get_own_seconds() - start) * 1e6;
    }
    run->taken++;
    return cycle % 10 != 0 || judge_cycle(run, links, lists);
}

static int run_monitor(rows *all, const robot *machine, const many_field *field, uint32_t cycles, const char *chart) {
    cell_run run;
    meetings lists[CONTESTANTS_MOST] = {{0}};
    path way = {.random = 6};
    int good = enter(&run, machine, field);
    for (uint32_t cycle = 0; good && cycle < cycles && cycle < SAMPLES_MOST; cycle++) {
        double angles[ROBOT_LINKS_MOST];
        ovoid_pose links[ROBOT_LINKS_MOST];
        path_advance(&way, machine, angles);
        robot_compute_poses(machine, angles, links);
        good = run_cycle(&run, links, lists, cycle);
    }
    if (good) {
        report(all, &run, chart);
        printf("%12s  %u cycles, %.1f pairs within %g m; open %.0f, unproven %.0f\n", "", run.taken,
               run.near / run.states, machine->cell.margin, run.open, run.unproven);
    }
    for (uint32_t k = 0; k < run.count; k++) free(lists[k].items);
    leave(&run);
    return good;
}

// --- both robots

static int is_wanted(const many_plan *plan, const char *name) { return !plan->only || !strcmp(plan->only, name); }

static int run_question(rows *all, const robot *machine, const many_field *field, const many_plan *plan, int monitor) {
    static const char *const charts[2][2] = {
        {"Planner, a made robot of 10 links", "Planner, a panda among real parts"},
        {"Monitor, a made robot of 10 links", "Monitor, a panda among real parts"}};
    const char *chart = charts[monitor][!strcmp(machine->name, "panda")];
    return monitor ? run_monitor(all, machine, field, plan->cycles, chart)
                   : run_planner(all, machine, field, plan->states, chart);
}

static int run_made(rows *all, const many_field *field, const many_plan *plan, int monitor) {
    robot machine;
    if (!robot_create_made(&machine)) return 0;
    // The same cell with some of its parts, to see how the cost grows.
    uint32_t parts = machine.cell.part_count;
    int good = 1;
    for (uint32_t share = 16; good && share >= 1; share /= 4) {
        machine.cell.part_count = parts / share;
        good = run_question(all, &machine, field, plan, monitor);
    }
    robot_destroy(&machine);
    return good;
}

static int run_real(rows *all, const many_field *field, const many_plan *plan, int monitor) {
    robot machine;
    if (!plan->data || !robot_create_panda(&machine, plan->data)) {
        printf("without the panda: its files are not there\n");
        return 1;
    }
    int good = run_question(all, &machine, field, plan, monitor);
    robot_destroy(&machine);
    return good;
}

int many_run_cells(rows *all, const many_field *field, const many_plan *plan) {
    static const char *const names[2] = {"planner", "monitor"};
    for (int monitor = 0; monitor < 2; monitor++)
        if (is_wanted(plan, names[monitor]) &&
            !(run_made(all, field, plan, monitor) && run_real(all, field, plan, monitor)))
            return 0;
    return 1;
}
