// How a table of a pair of links is made.
#ifndef OVOID_ROBOT_MODEL_PAIR_TABLE_FILL_H
#define OVOID_ROBOT_MODEL_PAIR_TABLE_FILL_H

#include "robot/model/kinematics.h"
#include "robot/model/pair_table.h"

enum { TABLE_CELLS = 1 << 16, TABLE_BODY_PAIRS = 64 };

/// An element of one of the links.
typedef struct table_body {
    const ovoid_shape *shape;
    uint32_t frame;
    vec3 center; ///< in its frame
    double reach;
    double error; ///< what its points may be off by
} table_body;

/// One of the links: its steps from the link that both hang on, outward; its bodies.
typedef struct table_side {
    uint32_t link, frame;
    uint32_t first_step, end_step, first_body, end_body;
} table_side;

/// Working memory, and the pair that is looked at. Frames are numbered anew: 0 is the link that both hang on.
typedef struct table_maker {
    const ovoid_robot *r;
    chain_step *steps;
    uint32_t *joints;
    uint32_t step_count;
    link_frame *frames;
    frame_error *errors;
    double *q, *values;
    table_body *bodies;
    uint32_t body_count;
    table_side sides[2];
    ovoid_proof *proofs; ///< of each pair of bodies, hints
    uint8_t have_proofs[TABLE_BODY_PAIRS];
    table_axis axes[2];
    double rates[2];  ///< how far a point of one link moves against the other, at most, by a unit of each variable
    double widths[2]; ///< of a cell
    double unit;
    uint8_t *codes;
    uint64_t queries, most; ///< exact queries, and how many there may be
} table_maker;

/// Memory for all pairs of a robot; 0: none.
int table_maker_create(table_maker *m, const ovoid_robot *r);
void table_maker_destroy(table_maker *m);
/// Sets the pair; 0: it has no table, as none or more than two variables are between the links, or one without limits
/// that is no turn.
int table_maker_set_pair(table_maker *m, uint32_t a, uint32_t b);
/// Fills the codes of the pair; m->codes has room for TABLE_CELLS.
void table_maker_fill(table_maker *m);

#endif
