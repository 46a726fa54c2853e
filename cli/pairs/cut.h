// Which objects of a scene at rest a shard searches: those whose pairs are its own, and those that may be near them.
#ifndef OVOID_CLI_PAIRS_CUT_H
#define OVOID_CLI_PAIRS_CUT_H

#include "shard/part.h"

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

/// What an object is to a part.
enum { CUT_FAR = 0, CUT_NEAR = 1, CUT_OWN = 2 };

/// The objects of a scene, cut. A pair belongs to the part that owns the smaller object, of equal ones the first.
typedef struct cli_cut {
    unsigned char *roles; ///< of each object; NULL: all pairs are the part's
    double *radii;        ///< of enclosing balls
} cli_cut;

/// A scene at rest whose pairs within the margin are wanted.
typedef struct near_scene {
    const ovoid_scene *scene;
    const ovoid_pose *poses; ///< of its objects
    double margin;
} near_scene;

/// Cuts a scene. The same for all parts and on all machines. 0, or EXIT_INPUT after a message, with nothing left open.
int cut_open(cli_cut *cut, const near_scene *of, shard_part part);

void cut_close(cli_cut *cut);

/// 1 if the pair of objects a < b is the part's. Both must be near or own.
static inline int cut_has_pair(const cli_cut *cut, uint32_t a, uint32_t b) {
    return !cut->roles || cut->roles[cut->radii[b] < cut->radii[a] ? b : a] == CUT_OWN;
}

#endif
