// ovoid robot info: what a robot is made of, and what of its files was not read.
#include "robot/info/info.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/outputs.h"
#include "robot/commands.h"

#include <stdlib.h>

typedef struct settings {
    robot_settings robot;
    int json;
} settings;

static const cli_option options[] = {
    ROBOT_OPTIONS(settings),
    {"json", 0, OPTION_FLAG, offsetof(settings, json), NULL, NULL, "write a line of JSON, with all numbers"},
    {.name = NULL},
};

static link_count *count_links(const cli_robot *robot) {
    ovoid_robot_description d = ovoid_robot_get_description(robot->robot);
    link_count *links = calloc(d.link_count, sizeof *links);
    for (size_t i = 0; i < d.element_count && links; i++) {
        link_count *link = &links[d.elements[i].link];
        link->elements++;
        link->vertices += ovoid_shape_get_polytope(d.elements[i].shape).vertex_count;
    }
    return links;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.json = 0};
    cli_operands operands;
    cli_robot robot;
    int code = command_parse(command, argc, argv, &s, &operands);
    if (code < 0) code = robot_settle(command, &s.robot);
    if (code >= 0) return code;
    code = robot_open(command, operands.items[0], &s.robot, &robot);
    if (code) return code;
    link_count *links = count_links(&robot);
    if (links) {
        (s.json ? info_write_json : info_write_text)(stdout, &robot, links);
        code = finish_file(stdout);
    } else {
        message_error("out of memory");
        code = EXIT_INPUT;
    }
    free(links);
    robot_close(&robot);
    return code;
}

const cli_command command_robot_info = {
    .name = "robot info",
    .summary = "links, joints, variables and geometry, and what was not read",
    .usage = "[OPTION...] ROBOT.urdf",
    .description =
        "What a URDF, its meshes and perhaps an SRDF say: the variables of a state in their order, with limits; each "
        "link with the joint above it and its elements; the meshes, each with its share of its hull and as what it is "
        "queried; groups and named states; and every kind of element that has no effect here, counted.\n\n"
        "What should be known is a warning: names of the SRDF that the URDF does not have, meshes that are not closed, "
        "or of which --hull or --parts takes the hull though they are not convex, packages that were guessed. Absent "
        "meshes are all named before the command fails.",
    .exits = "0 done\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written",
    .examples = "ovoid robot info panda.urdf --srdf panda.srdf\n"
                "ovoid robot info arm.urdf --package arm_description=../arm_description\n"
                "ovoid robot info arm.urdf --json > arm.json",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
