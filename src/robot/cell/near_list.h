// Near pairs as a search finds them: in the caller's memory, the farthest falling out where that is full, and in order
// at the end.
#ifndef OVOID_ROBOT_CELL_NEAR_LIST_H
#define OVOID_ROBOT_CELL_NEAR_LIST_H

#include "ovoid/robot.h"

/// The place of a pair that was kept, and what it is sorted by: nearer pairs come first, of equal ones those found
/// first.
typedef struct near_key {
    double lower;
    uint32_t found; ///< how many were found before it
    uint32_t slot;  ///< of its item and its row
} near_key;

typedef struct near_list {
    ovoid_robot_near *items;
    double *gradients; ///< or NULL
    size_t variables;  ///< numbers of a row
    double *row;       ///< room for one
    size_t capacity;   ///< of these
    size_t kept, found;
    near_key *keys, *scratch; ///< room for as many as can be found
    int is_heap;              ///< the keys are: the farthest on top
} near_list;

#define NEAR_LIST_FULL UINT32_MAX

/// The slot of a pair that was found; FULL: as many are at least as near, and it falls out. Cost: O(log n).
uint32_t near_list_find_slot(near_list *list, double lower);
/// Sorts keys, items and rows. Cost: n log n comparisons, each item and row moved once, one of each cycle twice.
void near_list_sort(near_list *list);

#endif
