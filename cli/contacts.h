// Contact manifolds of a pair in a record: found, copied, verified.
#ifndef OVOID_CLI_CONTACTS_H
#define OVOID_CLI_CONTACTS_H

#include "base/args.h"

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

/// The options of contacts.
typedef struct contacts_settings {
    int wanted;
    double angle; ///< 0: the default
} contacts_settings;

/// The rows of these options in a table; `contacts` is the member of the settings that holds them.
#define CONTACTS_OPTIONS(settings)                                                                                     \
    {"contacts",                                                                                                       \
     0,                                                                                                                \
     OPTION_FLAG,                                                                                                      \
     offsetof(settings, contacts.wanted),                                                                              \
     NULL,                                                                                                             \
     NULL,                                                                                                             \
     "also the contact manifold of each pair that touches, or is within --margin: normal, up to four points with "     \
     "their separations and ids, and the area; of compounds one for each pair of parts, of solids none"},              \
    {                                                                                                                  \
        "contact-angle", 0, OPTION_POSITIVE, offsetof(settings, contacts.angle), "RADIANS", NULL,                      \
            "facets turned from the plane of contact by more touch with an edge or a vertex alone (default: 1.45, "    \
            "which is the most)"                                                                                       \
    }

/// Checks them. -1 to go on, or EXIT_USAGE.
int contacts_settle(const cli_command *command, const contacts_settings *settings);

/// The options of the library; margin: negative, none was given, means 0; tolerance: of brackets, 0 the default.
ovoid_manifold_options contacts_make_options(const contacts_settings *settings, double margin, double tolerance);

/// Sets the contacts of a record to those of its pair, in memory that contacts_clear frees. 0 if memory runs out.
int contacts_find(const ovoid_body_pair *pair, const ovoid_manifold_options *options, ovoid_record *record);

/// Gives a record that was copied its own copy of its contacts. 0, and it has none, if memory runs out.
int contacts_copy(ovoid_record *record);
void contacts_clear(ovoid_record *record);

/// The shapes of two parts of a pair, in the world; a part of what is no compound is OVOID_RECORD_NO_PART. 0 where
/// there is no such part, or a body is a solid.
int contacts_get_parts(const ovoid_body_pair *bodies, const uint32_t parts[2], ovoid_pair *pair);

/// Checks the contacts of a record: each by its own proof, its points and areas against what its features give, and
/// that no pair of parts within the margin lacks one. tolerance: of the query. OVOID_OK, PROOF with a sentence, or
/// MEMORY.
ovoid_code contacts_verify(const ovoid_body_pair *pair, const ovoid_record *record, double tolerance,
                           ovoid_error *error);

#endif
