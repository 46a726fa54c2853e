// ovoid verify of path proofs.
#ifndef OVOID_CLI_ROBOT_PATH_VERIFY_H
#define OVOID_CLI_ROBOT_PATH_VERIFY_H

#include "base/args.h"

/// Where the files are now, where they are not where the proofs say; NULL, or none: there.
typedef struct path_verify_settings {
    const char *srdf, *scene, *states;
    args_list packages;
    int json, partial;
} path_verify_settings;

/// The rows of these options; `paths` is the member of the settings that holds them.
#define PATH_VERIFY_OPTIONS(settings)                                                                                  \
    {"srdf",                                                                                                           \
     0,                                                                                                                \
     OPTION_FILE,                                                                                                      \
     offsetof(settings, paths.srdf),                                                                                   \
     "FILE",                                                                                                           \
     NULL,                                                                                                             \
     "of path proofs: the SRDF, where it is not where the proofs say"},                                                \
        {"scene",                                                                                                      \
         0,                                                                                                            \
         OPTION_FILE,                                                                                                  \
         offsetof(settings, paths.scene),                                                                              \
         "FILE",                                                                                                       \
         NULL,                                                                                                         \
         "of path proofs: the obstacles, where they are elsewhere now"},                                               \
        {"package",                                                                                                    \
         'p',                                                                                                          \
         OPTION_LIST,                                                                                                  \
         offsetof(settings, paths.packages),                                                                           \
         "NAME=DIR",                                                                                                   \
         NULL,                                                                                                         \
         "of path proofs: the packages of the robot"},                                                                 \
    {                                                                                                                  \
        "states", 0, OPTION_FILE, offsetof(settings, paths.states), "Q.csv", NULL,                                     \
            "the states that the paths must be through (default: those that the proofs say)"                           \
    }

/// Checks all proofs of the file; urdf: NULL: the one that it says. Returns the exit code.
int path_verify(const cli_command *command, const path_verify_settings *settings, const char *path, const char *urdf);

#endif
