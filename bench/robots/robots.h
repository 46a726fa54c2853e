// `bench --robot`: robots from files among their obstacles. States, edges, the monitor, the matrix; compared with
// peers.
#ifndef OVOID_BENCH_ROBOTS_ROBOTS_H
#define OVOID_BENCH_ROBOTS_ROBOTS_H

#include "common/rows.h"
#include "peers/robot_peer.h"

#include <ovoid/robot_io.h>
#include <ovoid/robot_matrix.h>
#include <ovoid/robot_path.h>

enum { ROBOT_PEERS_MOST = 8, ROBOT_OBSTACLES_MOST = 64 };

/// What to run.
typedef struct robots_plan {
    uint32_t scenes; ///< the largest number for a robot
    uint32_t states; ///< for each scene: as many free ones as ones that hit
    uint32_t edges;  ///< of each scene and length
    uint32_t cycles; ///< of the monitor in each scene
    size_t samples;  ///< of the matrix
    size_t budget;   ///< of its proofs; 0: the default
    const char *only, *data;
} robots_plan;

robots_plan robots_plan_make(void);
robots_plan robots_plan_make_smoke(void);

/// The peers.
typedef struct robots_field {
    const robot_peer *peers[ROBOT_PEERS_MOST];
    uint32_t count;
} robots_field;

/// Adds the peers of a module; 0, with a line on stderr, where it cannot be loaded.
int robots_field_load(robots_field *all, const char *path);

/// A robot, and what peers are told of it.
typedef struct machine {
    char name[64];
    ovoid_robot_file *file; ///< NULL: it was made here
    ovoid_robot *robot;
    solid *solids; ///< of the robot, then those of the scene
    placed_solid *elements;
    uint32_t solid_count, element_count, variable_count, link_count;
    unsigned char *ignored;
    double *low, *high; ///< of each variable; continuous joints: half a turn to either side
    double reach;       ///< about the distance that it reaches from its root
    ovoid_problems *problems;
    char folder[64]; ///< the folder where they are unpacked; empty: none
} machine;

/// One scene of a machine: ovoid's cell and checker, and the data for peers.
typedef struct robots_scene {
    ovoid_obstacles *file;
    ovoid_shape *made[ROBOT_OBSTACLES_MOST];
    uint32_t made_count;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
    placed_solid obstacles[ROBOT_OBSTACLES_MOST];
    robot_scene what; ///< for peers
    uint64_t random;
} robots_scene;

/// A robot of the data folder with its planning problems, which are unpacked to a temporary folder; 0 with a line on
/// stdout: it is not available, or cannot be read.
typedef struct machine_files {
    const char *name, *urdf, *srdf, *problems;
} machine_files;
int machine_read(machine *m, const char *data, const machine_files *files);
/// Two robots of a kind side by side; 60 links in a chain of capsules. 0: it failed.
int machine_make_pair(machine *m, const machine *one);
int machine_make_snake(machine *m, uint32_t links);
void machine_destroy(machine *m);

/// The number of scenes of a machine: its problems, else ten with boxes.
uint32_t machine_count_scenes(const machine *m);
/// 0, with a line: the scene cannot be read.
int robots_scene_create(robots_scene *s, machine *m, uint32_t index);
void robots_scene_destroy(robots_scene *s, machine *m);
/// A state, uniform within the limits.
void machine_draw(const machine *m, uint64_t *random, double *q);

/// The truth of a state: all pairs, tried one by one, their proofs checked by ovoid_answer_verify.
typedef struct state_truth {
    int is_hit, is_free; ///< neither: it is within rounding or an allowance of touching
    double depth;        ///< the deepest proven overlap
    double gap;          ///< free: the least proven distance
} state_truth;
state_truth robots_judge(const robots_scene *s, const machine *m, const double *q);

/// A peer that takes part in a scene.
typedef struct rival {
    const robot_peer *who;
    void *self;
} rival;

/// Samples of one line, and the judgement of its answers.
typedef struct tally {
    const char *line;
    double *samples;
    uint32_t count, room;
    double judged, missed, false_alarms;
    double *depths; ///< of the missed hits
    uint32_t depth_count, depth_room;
} tally;
enum { TALLIES_MOST = 2 * ROBOT_PEERS_MOST };
typedef struct tallies {
    tally items[TALLIES_MOST];
    uint32_t count;
} tallies;
/// The line of that name; made if it is new.
tally *tallies_get(tallies *all, const char *line);
void tally_add(tally *t, double sample);
/// truth: 1 a hit, 0 free; depth: of the hit, NaN if none is known.
void tally_judge(tally *t, int said_hit, int is_hit, double depth);
/// Adds rows, prints percentiles and the faults, and frees the tallies.
void tallies_report(tallies *all, rows *out, const char *chart, const char *unit, double x);

/// The run of a machine: the tallies of all its questions.
typedef struct robots_run {
    machine *machine;
    const robots_plan *plan;
    tallies free_states, hit_states, along, monitor;
    tallies covers;                 ///< what the first edge of a cell costs more than the same again
    tallies edges[3], hit_edges[3]; ///< by length
    double wrong, judged;           ///< of ovoid's answers
    double open;                    ///< states whose truth is open
    double near, states_free, states_hit;
    uint32_t edge_count;
} robots_run;

void robots_run_states(robots_run *run, robots_scene *s, rival *rivals, uint32_t count);
void robots_run_edges(robots_run *run, robots_scene *s, rival *rivals, uint32_t count);
void robots_run_monitor(robots_run *run, robots_scene *s, rival *rivals, uint32_t count);

/// The distance of the states of an edge that MoveIt's planners check: a share of the sum of all joints' ranges.
#define ROBOTS_RESOLUTION 0.005
uint32_t robots_count_samples(const machine *m, const double *q0, const double *q1);

/// Runs everything; 0: it failed, or an answer of ovoid's was wrong.
int robots_run_all(const robots_plan *plan, const char *const *modules, uint32_t module_count, const char *csv,
                   const char *svg, int alone);

#endif
