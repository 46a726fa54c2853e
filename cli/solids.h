// Mesh files as solids: the triangles themselves, in the place of their hull.
#ifndef OVOID_CLI_SOLIDS_H
#define OVOID_CLI_SOLIDS_H

#include "inputs.h"
#include "results.h"

#include <ovoid/ovoid.h>

/// Reads a mesh file as one solid, its polygons cut into triangles. NULL with *error filled. A mesh that is not closed
/// becomes a surface.
ovoid_solid *solids_read(const char *path, const read_settings *settings, ovoid_error *error);

/// What a pair of bodies is asked.
typedef struct solids_query {
    const char *const *paths;
    ovoid_body_pair pair;
    ovoid_convexity convexity[2]; ///< of the meshes; volumes NaN where there is none
    double margin, tolerance;     ///< margin negative: not given
    const char *unit;
} solids_query;

/// Answers, checks the proof, writes the answer as text, JSON or CSV. Returns the exit code.
int solids_answer(const solids_query *query, const output_settings *out);

#endif
