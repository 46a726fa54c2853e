// Which pairs of a robot's links need never be queried, and which pairs does an SRDF disable wrongly?
#include <ovoid/robot_io.h>
#include <ovoid/robot_matrix.h>
#include <stdio.h>

/// 1 if the description disables the pair.
static int is_disabled(const ovoid_robot_description *d, const ovoid_robot_matrix_pair *pair) {
    for (size_t i = 0; i < d->disabled_count; i++)
        if (d->disabled[i].a == pair->a && d->disabled[i].b == pair->b) return 1;
    return 0;
}

int main(void) {
    ovoid_error error;
    ovoid_robot_file *file = ovoid_robot_file_read("arm/arm.urdf", "arm/arm.srdf", NULL, &error);
    if (!file) return fprintf(stderr, "%s\n", error.message), 1;
    ovoid_robot_description given = ovoid_robot_file_get_description(file);
    ovoid_robot *robot = ovoid_robot_create(&given, NULL, &error);
    if (!robot) return fprintf(stderr, "%s\n", error.message), 1;
    const ovoid_robot_matrix_options options = {.samples = 2000, .budget = 10000};
    ovoid_robot_matrix *matrix = ovoid_robot_matrix_create(robot, &options, &error);
    if (!matrix) return fprintf(stderr, "%s\n", error.message), 1;

    // The compiled description has each disabled pair once, with a < b, as in the matrix.
    ovoid_robot_description d = ovoid_robot_get_description(robot);
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(matrix); i++) {
        ovoid_robot_matrix_pair pair = ovoid_robot_matrix_get_pair(matrix, i);
        const char *reason = ovoid_robot_matrix_pair_get_reason(&pair, 0);
        int is_wrong = !reason && pair.touch == OVOID_ROBOT_TOUCH_SOMETIMES && is_disabled(&d, &pair);
        printf("%-6s %-6s %-10s %s%s\n", d.links[pair.a].name, d.links[pair.b].name,
               ovoid_robot_touch_get_name(pair.touch), reason ? reason : "is to be looked at",
               is_wrong ? ", but the SRDF leaves it out" : "");
        if (is_wrong) printf("  they touch where the first joint is at %g\n", pair.hit[0]);
    }
    ovoid_robot_matrix_destroy(matrix);
    ovoid_robot_destroy(robot);
    ovoid_robot_file_destroy(file);
}
