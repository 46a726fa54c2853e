// Do two balls cover a link? If not, by how much do they miss, and which two do?
#include <ovoid/robot_spheres.h>
#include <stdio.h>

static int print_audit(const ovoid_robot *robot, const ovoid_robot_sphere *spheres, size_t count) {
    ovoid_robot_sphere_audit a;
    ovoid_error error;
    if (ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){robot, 0, spheres, count}, NULL, &a, &error) !=
        OVOID_OK)
        return fprintf(stderr, "%s\n", error.message), 0;
    if (a.depth.upper <= 0)
        printf("  every point of the link is covered, proven\n");
    else
        printf("  (%.3f, %.3f, %.3f) is outside all of them by %.3f\n", a.point.x, a.point.y, a.point.z, a.depth.lower);
    printf("  uncovered: %.1f %% to %.1f %% of the link; outside it: %.1f %% to %.1f %%\n",
           100 * a.uncovered.lower / a.link.upper, 100 * a.uncovered.upper / a.link.lower,
           100 * a.excess.lower / a.link.upper, 100 * a.excess.upper / a.link.lower);
    return 1;
}

int main(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.3, 0.1, 0.1}, NULL, &error);
    const ovoid_robot_link link = {"forearm"};
    const ovoid_robot_element element = {0, NULL, box, {{0, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {"arm", &link, 1, NULL, 0, &element, 1, NULL, 0, NULL};
    ovoid_robot *robot = ovoid_robot_create(&d, NULL, &error);
    if (!robot) return fprintf(stderr, "%s\n", error.message), 1;

    const ovoid_robot_sphere guess[2] = {{{-0.15, 0, 0}, 0.18}, {{0.15, 0, 0}, 0.18}};
    printf("two balls that were guessed:\n");
    if (!print_audit(robot, guess, 2)) return 1;
    ovoid_robot_sphere found[2];
    ovoid_robot_sphere_cover cover = {.link = 0, .spheres = found, .capacity = 2};
    const ovoid_robot_cover_options search = {.rounds = 500};
    if (ovoid_robot_compute_sphere_cover(robot, &search, &cover, &error) != OVOID_OK)
        return fprintf(stderr, "%s\n", error.message), 1;
    printf("two that were found:\n");
    for (size_t i = 0; i < cover.count; i++)
        printf("  at (%.3f, %.3f, %.3f), radius %.3f\n", found[i].center.x, found[i].center.y, found[i].center.z,
               found[i].radius);
    if (!print_audit(robot, found, cover.count)) return 1;
    ovoid_robot_destroy(robot);
    ovoid_shape_destroy(box);
}
