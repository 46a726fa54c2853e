// The results: one cell for each workload and question.
#ifndef OVOID_BENCH_PAIRS_CELLS_H
#define OVOID_BENCH_PAIRS_CELLS_H

#include "common/measure.h"

typedef struct cell {
    char workload[40];
    uint32_t vertices, pairs, tracks;
    question what;
    uint32_t open;     ///< pairs whose reference is too wide to judge distances
    uint32_t unproven; ///< of ovoid's answers
    uint32_t count;
    entrant entrants[ENTRANTS_MOST]; ///< ovoid's come first
} cell;

typedef struct cells {
    cell *items;
    uint32_t count, room;
    uint32_t own; ///< the number of ovoid's entrants
} cells;

/// A copy of the cell at the end; 0 if memory runs out.
int cells_add(cells *all, const cell *one);
void cells_destroy(cells *all);

const char *question_get_name(question what);

/// The fastest entrant that is not ovoid's; right: of those with at most 1 % wrong answers. NULL: none.
const entrant *cell_find_fastest_peer(const cell *c, uint32_t own, int right);
/// ovoid's fastest of the first `own` entrants with that name.
const entrant *cell_find_fastest_own(const cell *c, uint32_t own, const char *name);

/// The terminal's table: a head for the entrants, a row for each cell, and the sums of faults.
void cells_print_head(const cell *c);
void cells_print_row(const cell *c, uint32_t own);
void cells_print_faults(const cells *all);

/// CSV, a row for each entrant of each cell; its first line describes the build. 0: not written.
int cells_write_csv(const cells *all, const char *path);
/// A plot: a panel for each question and placement of the random hulls.
int cells_write_svg(const cells *all, const char *path);

#endif
