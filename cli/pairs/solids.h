// Mesh files as solids: the triangles themselves instead of their hull.
#ifndef OVOID_CLI_PAIRS_SOLIDS_H
#define OVOID_CLI_PAIRS_SOLIDS_H

#include "base/inputs.h"
#include "results.h"

#include <ovoid/ovoid.h>

/// The options' choice for meshes: each a solid, its hull, or the kind that its triangles show.
typedef struct solids_choice {
    int solid, parts, hull;
} solids_choice;

/// The rows of these options in a table; `choice` is the member of the settings that holds them. parts_help: of
/// --parts.
#define SOLIDS_OPTIONS(settings, parts_help)                                                                           \
    {"parts", 0, OPTION_FLAG, offsetof(settings, choice.parts), NULL, NULL, parts_help},                               \
        {"solid",                                                                                                      \
         0,                                                                                                            \
         OPTION_FLAG,                                                                                                  \
         offsetof(settings, choice.solid),                                                                             \
         NULL,                                                                                                         \
         NULL,                                                                                                         \
         "each mesh is the solid that its triangles enclose, or where they are not closed their surface, also "        \
         "where it is its hull (default: where it is not)"},                                                           \
    {                                                                                                                  \
        "hull", 0, OPTION_FLAG, offsetof(settings, choice.hull), NULL, NULL, "each mesh is its convex hull"            \
    }

/// At most one of them may be set: -1 to continue, or EXIT_USAGE.
int solids_settle(const cli_command *command, const solids_choice *choice);

/// The settings, with the choice of hulls and solids applied.
read_settings solids_get_read(const read_settings *read, const solids_choice *choice);
/// The triangles of a body, if it is a solid or a surface, else NULL. Warns of a surface.
const ovoid_solid *solids_get(const char *path, const cli_body *body);
/// SOLID or SURFACE; HULL for NULL.
ovoid_mesh_kind solids_get_kind(const ovoid_solid *solid);

/// The bodies of two files; each may be a solid.
typedef struct solids_pair {
    const char *const *paths;
    const ovoid_solid *solids[2]; ///< NULL: the body's hull
    ovoid_body_pair pair;
    ovoid_convexity convexity[2]; ///< of the meshes; volumes NaN if there is none
} solids_pair;

/// A pair of bodies that are open. Returns how many are solids or surfaces.
int solids_make_pair(const char *const *paths, const cli_body bodies[2], const ovoid_pose poses[2], solids_pair *pair);

/// Sets a record's kinds and volumes from two bodies, and the field for it if one of their meshes is not its hull.
void solids_describe_bodies(const cli_body bodies[2], ovoid_record *record);
/// As solids_describe_bodies, for a pair with at least one solid.
void solids_describe(const solids_pair *pair, ovoid_record *record);

/// The query of a pair of bodies.
typedef struct solids_query {
    double margin, tolerance; ///< margin negative: not given
    const char *unit;
    const ovoid_manifold_options *contacts; ///< of the contacts that are written too; NULL: none
} solids_query;

/// Answers, verifies the proof, writes the answer as text, JSON or CSV. Returns the exit code.
int solids_answer(const solids_pair *pair, const solids_query *query, const output_settings *out);

/// Warns of a solid that encloses nothing.
void solids_warn_flat(const char *path, const ovoid_solid *solid);

#endif
