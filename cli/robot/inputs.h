// Reading robots, with the options for it.
#ifndef OVOID_CLI_ROBOT_INPUTS_H
#define OVOID_CLI_ROBOT_INPUTS_H

#include "base/args.h"

#include <ovoid/robot_io.h>

/// Options of every command that reads a robot.
typedef struct robot_settings {
    const char *srdf;   ///< NULL: none
    args_list packages; ///< NAME=DIR
    args_list scales;   ///< LINK=F or F
    args_list xacro;    ///< NAME:=VALUE
    int parts, visual, free_base, fixed_base;
    int hull;         ///< meshes are their hulls, of links and obstacles
    double tolerance; ///< of cylinders; 0: radius/200
} robot_settings;

/// The rows of these options in a table; `robot` is the member of the settings that holds them.
#define ROBOT_OPTIONS(settings)                                                                                        \
    {"srdf",                                                                                                           \
     0,                                                                                                                \
     OPTION_FILE,                                                                                                      \
     offsetof(settings, robot.srdf),                                                                                   \
     "FILE",                                                                                                           \
     NULL,                                                                                                             \
     "the SRDF: disabled pairs, groups, named states, a base that can move"},                                          \
        {"package",                                                                                                    \
         'p',                                                                                                          \
         OPTION_LIST,                                                                                                  \
         offsetof(settings, robot.packages),                                                                           \
         "NAME=DIR",                                                                                                   \
         NULL,                                                                                                         \
         "the folder of a package, for package://NAME/...; may be given several times (default: ROS_PACKAGE_PATH, "    \
         "AMENT_PREFIX_PATH, and the folders above the URDF)"},                                                        \
        {"scale",                                                                                                      \
         0,                                                                                                            \
         OPTION_LIST,                                                                                                  \
         offsetof(settings, robot.scales),                                                                             \
         "[LINK=]F",                                                                                                   \
         NULL,                                                                                                         \
         "the shapes of a link, or of all links that have no other factor, F times as large, each about its own "      \
         "origin; may be given several times"},                                                                        \
        {"xacro",                                                                                                      \
         0,                                                                                                            \
         OPTION_LIST,                                                                                                  \
         offsetof(settings, robot.xacro),                                                                              \
         "NAME:=VALUE",                                                                                                \
         NULL,                                                                                                         \
         "an argument of a .xacro file, which the program xacro expands; may be given several times"},                 \
        {"parts",                                                                                                      \
         0,                                                                                                            \
         OPTION_FLAG,                                                                                                  \
         offsetof(settings, robot.parts),                                                                              \
         NULL,                                                                                                         \
         NULL,                                                                                                         \
         "each object of a mesh file is a convex part"},                                                               \
        {"hull",                                                                                                       \
         0,                                                                                                            \
         OPTION_FLAG,                                                                                                  \
         offsetof(settings, robot.hull),                                                                               \
         NULL,                                                                                                         \
         NULL,                                                                                                         \
         "meshes count as their convex hulls (default: as what they are, a solid or, where they are not closed, a "    \
         "surface)"},                                                                                                  \
        {"visual",                                                                                                     \
         0,                                                                                                            \
         OPTION_FLAG,                                                                                                  \
         offsetof(settings, robot.visual),                                                                             \
         NULL,                                                                                                         \
         NULL,                                                                                                         \
         "links without collision geometry take their visual one"},                                                    \
        {"free-base",                                                                                                  \
         0,                                                                                                            \
         OPTION_FLAG,                                                                                                  \
         offsetof(settings, robot.free_base),                                                                          \
         NULL,                                                                                                         \
         NULL,                                                                                                         \
         "the virtual joint of the SRDF moves the robot, with variables of its own (default: the root link does not "  \
         "move)"},                                                                                                     \
        {"fixed-base",                                                                                                 \
         0,                                                                                                            \
         OPTION_FLAG,                                                                                                  \
         offsetof(settings, robot.fixed_base),                                                                         \
         NULL,                                                                                                         \
         NULL,                                                                                                         \
         "the root link does not move, as it does not without this option"},                                           \
    {                                                                                                                  \
        "cylinder-tolerance", 0, OPTION_POSITIVE, offsetof(settings, robot.tolerance), "T", NULL,                      \
            "the most by which the prism that holds a cylinder may be inside it, in metres (default: 1/200 of its "    \
            "radius)"                                                                                                  \
    }

/// A robot and its files.
typedef struct cli_robot {
    ovoid_robot_file *file;
    ovoid_robot *robot;
    size_t note_count; ///< how many notes there were
} cli_robot;

/// Settles what meshes count as. -1 to go on, or an exit code after a message.
int robot_settle(const cli_command *command, const robot_settings *settings);

/// Reads a robot; notes are warnings. 0, or an exit code after a message, with nothing left open.
int robot_open(const cli_command *command, const char *urdf, const robot_settings *settings, cli_robot *robot);
/// The same without the warnings of objects that are not convex: of a file beside the robot.
int robot_open_beside(const cli_command *command, const char *urdf, const robot_settings *settings, cli_robot *robot);
void robot_close(cli_robot *robot);

/// The value of a link, from "LINK=X", or of all links, "X": then link is empty.
typedef struct link_value {
    char link[256];
    double value;
} link_value;

/// Splits such a text; 0, or an exit code after a message that names the option.
int robot_split_value(const cli_command *command, const char *option, const char *text, link_value *is);

/// A note of the library as a warning; context: the robot, whose notes are counted.
void robot_warn(void *context, const ovoid_robot_note *note);

/// What stands behind the joint's name in the name of a variable where it has several, as in "floor x"; else "".
const char *robot_get_component(const ovoid_robot_joint *joint, uint32_t component);

#endif
