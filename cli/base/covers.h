// Memory of covers: of a query, so large that the search for a depth has room, and of a copy that is kept.
#ifndef OVOID_CLI_BASE_COVERS_H
#define OVOID_CLI_BASE_COVERS_H

#include <ovoid/query.h>

/// Gives a cover that has none memory for OVOID_COVER_POINTS_MAX points, of which the system provides what is written
/// to; 0 if there is none. free(cover->memory) releases it.
int cover_take_memory(ovoid_cover *cover);

/// A copy in one block, for free(); NULL of a cover that is NULL or shows nothing, and if memory is out.
ovoid_cover *cover_copy(const ovoid_cover *from);

#endif
