// The spheres that a robot comes with: of a URDF whose links have spheres for collision geometry, or of an SRDF.
#include "robot/spheres/spheres.h"

#include "base/message.h"
#include "base/outputs.h"
#include "tools/array.h"

#include <stdlib.h>
#include <string.h>

int sphere_list_add(sphere_list *list, uint32_t link, ovoid_robot_sphere ball) {
    if (!array_reserve((void **)&list->items, &list->capacity, list->count, sizeof *list->items))
        return message_error("out of memory for %zu spheres", list->count + 1), 0;
    // Behind those of its link and of the links before.
    size_t at = list->count++;
    for (; at && list->items[at - 1].link > link; at--) list->items[at] = list->items[at - 1];
    list->items[at] = (ovoid_robot_link_sphere){link, ball};
    return 1;
}

size_t sphere_list_find(const sphere_list *list, uint32_t link, size_t *count) {
    size_t first = 0, end;
    while (first < list->count && list->items[first].link < link) first++;
    for (end = first; end < list->count && list->items[end].link == link;) end++;
    *count = end - first;
    return first;
}

void sphere_list_clear(sphere_list *list) {
    free(list->items);
    *list = (sphere_list){.items = NULL};
}

/// Adds a sphere of a link that goes by its name; one that the robot has not, or that has no geometry, is passed over
/// with a warning, once.
static int add_by_name(const cli_cell *cell, sphere_list *list, const char *path, const char *name,
                       ovoid_robot_sphere ball) {
    static const char *last; // the name that was warned of last: a link's spheres follow one another
    uint32_t link = ovoid_robot_find_link(cell->robot.robot, name);
    int has_geometry = 0;
    for (size_t i = 0; i < cell->description.element_count; i++)
        has_geometry |= cell->description.elements[i].link == link;
    if (has_geometry) return sphere_list_add(list, link, ball);
    if (!last || strcmp(last, name) != 0)
        message_warning("%s: link %s %s: its spheres are left out", path, name,
                        link == OVOID_ROBOT_NONE ? "is not one of the robot's"
                                                 : "of the robot has no collision geometry");
    last = name;
    return 1;
}

/// 1 where an element is a sphere, which is then *ball, in its link's frame.
static int get_sphere(const ovoid_robot_element *e, ovoid_robot_sphere *ball) {
    ovoid_polytope p = ovoid_shape_get_polytope(e->shape);
    ovoid_vec3 x = p.origin;
    if (p.vertex_count != 1) return 0;
    x.x += p.vertices[0], x.y += p.vertices[1], x.z += p.vertices[2];
    *ball = (ovoid_robot_sphere){ovoid_pose_compute_point(&e->pose, x), ovoid_shape_get_radius(e->shape)};
    return 1;
}

static int add_elements(const cli_cell *cell, const char *path, const ovoid_robot_description *d, sphere_list *list) {
    size_t others = 0;
    for (size_t i = 0; i < d->element_count; i++) {
        ovoid_robot_sphere ball;
        const char *name = d->links[d->elements[i].link].name;
        if (!get_sphere(&d->elements[i], &ball))
            others++;
        else if (!add_by_name(cell, list, path, name, ball))
            return 0;
    }
    if (others) message_warning("%s: %zu elements are no spheres: they are left out", path, others);
    return 1;
}

static int add_approximations(const cli_cell *cell, const char *path, const ovoid_robot_file *file, sphere_list *list) {
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    size_t count;
    const ovoid_robot_link_sphere *spheres = ovoid_robot_file_get_spheres(file, &count);
    for (size_t i = 0; i < count; i++)
        if (!add_by_name(cell, list, path, d.links[spheres[i].link].name, spheres[i].ball)) return 0;
    return 1;
}

int spheres_read(const cli_command *command, const cli_cell *cell, const robot_settings *settings, const char *urdf,
                 const char *given, sphere_list *list) {
    *list = (sphere_list){.items = NULL};
    int good = 1;
    if (given) {
        int is_srdf = outputs_has_extension(given, "srdf");
        cli_robot beside;
        robot_settings s = *settings;
        s.srdf = is_srdf ? given : NULL;
        s.visual = 0;
        s.hull = 1;
        s.scales.count = 0; // spheres are taken as they are
        int code = robot_open_beside(command, is_srdf ? urdf : given, &s, &beside);
        if (code) return code;
        ovoid_robot_description d = ovoid_robot_file_get_description(beside.file);
        good = is_srdf ? add_approximations(cell, given, beside.file, list) : add_elements(cell, given, &d, list);
        robot_close(&beside);
    } else if (settings->srdf) {
        good = add_approximations(cell, settings->srdf, cell->robot.file, list);
    }
    if (good && given && !list->count) message_error("%s: has no spheres for links of the robot", given), good = 0;
    if (!good) sphere_list_clear(list);
    return good ? 0 : EXIT_INPUT;
}
