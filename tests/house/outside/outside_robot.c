// A program that uses the installed libovoid_robot.
#include <ovoid/robot.h>
#include <stdio.h>

int main(void) {
    ovoid_error error;
    ovoid_robot_link link = {"base"};
    ovoid_robot_description description = {.links = &link, .link_count = 1};
    ovoid_robot *robot = ovoid_robot_create(&description, NULL, &error);
    if (!robot) return fprintf(stderr, "%s\n", error.message), 1;
    uint32_t root = ovoid_robot_get_root(robot);
    ovoid_robot_destroy(robot);
    return root == 0 ? 0 : 1;
}
