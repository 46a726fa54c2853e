// A cell of joint space and what its middle proves of two groups.
#ifndef OVOID_ROBOT_MATRIX_LOOK_H
#define OVOID_ROBOT_MATRIX_LOOK_H

#include "robot/matrix/cell_contact.h"
#include "robot/matrix/matrix.h"
#include "robot/matrix/narrow.h"

/// What a cell's middle says of a goal: the whole cell has it, or it must be divided, or a state of it has it not.
typedef enum cell_verdict { CELL_PROVEN, CELL_OPEN, CELL_REFUTED } cell_verdict;

typedef struct prover {
    matrix_work *work;
    path_work whole;
    narrow_work narrow;  ///< for the pair of groups
    path_work *w;        ///< that of `narrow`
    void *memory;        ///< of the state
    path_state at;       ///< the middle of the cell
    ovoid_proof *proofs; ///< of the pairs of items of the pair of groups
    unsigned char *has_proof;
    double *q0, *q1; ///< the cell
    const group_pair *of;
    uint32_t *open; ///< the pair of groups' pairs of items: first those that no cell around this one proves apart
    uint32_t open_count;
    ovoid_shape *point; ///< at its frame's origin
    cell_contact contact;
    int searches;           ///< for a common point that are still worth their time
    int is_state;           ///< 1: the middle is one, also for joints that follow others
    uint32_t widest;        ///< the pair of items by whose motion an open cell is divided
    int has_shares;         ///< 1: by the greatest of `shares` instead
    double *shares;         ///< of each variable
    double *slopes;         ///< of each variable, as of cell_gap
    double *corner;         ///< a state at a corner of the cell
    size_t opens;           ///< cells that were left open
    const double *refuting; ///< the state that refutes
} prover;

/// Begins with the pair of groups p->of, whose joints are bounded.
void prover_begin(prover *p);
/// Looks at the cell from p->q0 to p->q1.
cell_verdict prover_look(prover *p, int wants_contact);

#endif
