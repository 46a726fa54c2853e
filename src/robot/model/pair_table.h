// Which pairs of links are proven apart, by the one or two variables that move them against each other: a grid of cells
// over the variables' limits, with a distance that the links keep in all of a cell, at least. Made once a robot.
#ifndef OVOID_ROBOT_MODEL_PAIR_TABLE_H
#define OVOID_ROBOT_MODEL_PAIR_TABLE_H

#include "robot/model/robot.h"

#include <math.h>
#include <stdatomic.h>

/// The cells along one variable; of an axis without a variable there is one.
typedef struct table_axis {
    uint32_t variable; ///< NONE: none
    uint32_t value;    ///< of the chain's values, that which is the variable
    uint32_t count;
    double low, scale; ///< where the first cell begins, and cells a unit
    double period;     ///< of turning joints whose limits are a whole turn or more; 0: none
    double most;       ///< variables beyond it, in absolute value, are not looked up
} table_axis;

/// A pair of links.
typedef struct pair_table {
    uint32_t a, b; ///< a < b
    table_axis axes[2];
    double unit;  ///< of distances
    uint32_t all; ///< the least code of all cells
    /// Of cell i of the first axis and k of the second at k count + i. 0: nothing is proven; else the elements of both
    /// links are farther apart than (code - 1) unit. NULL: `all` is the code of every cell.
    uint8_t *codes;
    /// How many cells are 0 of those below i and k, at k (count + 1) + i; counts of the first axis. NULL as `codes` is.
    uint32_t *sums;
} pair_table;

/// The tables of a robot, by a, then b.
typedef struct pair_tables {
    uint32_t count, capacity;
    pair_table *items;
    size_t memory; ///< bytes
} pair_tables;

/// The tables of a robot that is shared by threads; NULL: nobody has asked for them yet.
typedef struct pair_tables_once {
    _Atomic(pair_tables *) made;
    int is_off; ///< 1: there are none
} pair_tables_once;

/// By how many cells a place may be beyond the one that is looked up: rounding is less, and cells are proven with more.
#define TABLE_EDGE 1e-7

/// The tables, made by the first call; NULL: no memory. Any number of threads may call it.
const pair_tables *robot_get_pair_tables(const ovoid_robot *r);
/// For a robot of few states, which would not repay them: it has no tables. Before the first call of the function
/// above.
void robot_leave_out_pair_tables(const ovoid_robot *r);
/// The table of two links; NULL: there is none.
const pair_table *pair_tables_find(const pair_tables *tables, uint32_t a, uint32_t b);
/// Before the first use, and at the end.
void pair_tables_begin(pair_tables_once *once);
void pair_tables_end(const ovoid_robot *r);

/// Where a variable is along an axis, in cells; below zero by more than the edge: nowhere.
static inline double table_axis_locate(const table_axis *x, double q) {
    if (!(fabs(q) <= x->most)) return -1;
    if (x->period > 0) q -= x->period * (double)(int)(q / x->period + (q < 0 ? -0.5 : 0.5));
    return (q - x->low) * x->scale;
}

/// The cell at a place; `count`: none.
static inline uint32_t table_axis_find_cell(const table_axis *x, double place) {
    if (!(place > -TABLE_EDGE && place < x->count + TABLE_EDGE)) return x->count;
    uint32_t cell = place > 0 ? (uint32_t)place : 0;
    return cell < x->count ? cell : x->count - 1;
}

/// 1 where the links' elements are proven farther apart than the margin, by the values of a state, `stride` apart.
static inline int pair_table_is_far(const pair_table *t, const double *values, size_t stride, double margin) {
    uint32_t cells[2];
    for (int k = 0; k < 2; k++) {
        cells[k] = table_axis_find_cell(&t->axes[k], table_axis_locate(&t->axes[k], values[t->axes[k].value * stride]));
        if (cells[k] == t->axes[k].count) return 0;
    }
    uint32_t code = t->codes ? t->codes[(size_t)cells[1] * t->axes[0].count + cells[0]] : t->all;
    return code > 0 && (code - 1) * t->unit >= margin;
}

/// Intervals of both variables.
typedef struct table_range {
    double low[2], high[2];
} table_range;

/// 1 where the links' elements are proven apart for all values of a range. Cost: four look-ups, or eight.
int pair_table_is_apart(const pair_table *t, const table_range *range);

#endif
