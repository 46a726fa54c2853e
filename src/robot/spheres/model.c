// A robot of spheres: the links, joints and disabled pairs of another one, whose elements are spheres. Each sphere is a
// point with a radius at its centre's pose, so it is the ball that is meant, exactly.
#include "base/error.h"
#include "robot/model/robot.h"
#include "robot/spheres/spheres.h"

// Makes the elements; 0 or more shapes are made where a code says what is wrong, *made of them.
static ovoid_code make_elements(ovoid_robot_element *elements, const ovoid_robot_link_sphere *spheres, size_t count,
                                const ovoid_allocator *memory, size_t *made, ovoid_error *error) {
    const ovoid_shape_options options = {.allocator = memory};
    for (*made = 0; *made < count; ++*made) {
        const ovoid_robot_link_sphere *s = &spheres[*made];
        ovoid_robot_element *e = &elements[*made];
        ovoid_shape *shape = ovoid_shape_create_sphere(s->ball.radius, &options, error);
        if (!shape) return OVOID_ERROR_MEMORY; // all else was looked at before
        *e = (ovoid_robot_element){s->link, NULL, shape, ovoid_pose_make_identity(), NULL};
        e->pose.position = s->ball.center;
    }
    return OVOID_OK;
}

static void destroy_shapes(const ovoid_robot_element *elements, size_t count) {
    for (size_t i = 0; i < count; i++) element_destroy_shape(&elements[i]);
}

static ovoid_code validate_spheres(const ovoid_robot_link_sphere *spheres, size_t count, size_t links,
                                   ovoid_error *error) {
    for (size_t i = 0; i < count; i++) {
        ovoid_code code = spheres_validate(&spheres[i].ball, 1, error);
        if (code != OVOID_OK) {
            if (error) error->place = (int64_t)i;
            return code;
        }
        if (spheres[i].link >= links)
            return error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "sphere %zu is of link %u: the robot has %zu", i,
                             spheres[i].link, links);
    }
    return OVOID_OK;
}

ovoid_robot *ovoid_robot_create_from_spheres(const ovoid_robot *robot, const ovoid_robot_link_spheres *given,
                                             const ovoid_robot_options *options, ovoid_error *error) {
    const ovoid_robot_link_sphere *spheres = given ? given->items : NULL;
    size_t count = given ? given->count : 0;
    if (!robot || (!spheres && count)) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "no robot, or no spheres (NULL)");
        return NULL;
    }
    ovoid_robot_description d = ovoid_robot_get_description(robot);
    if (validate_spheres(spheres, count, d.link_count, error) != OVOID_OK) return NULL;
    ovoid_allocator memory = allocator_make(options ? options->allocator : NULL);
    ovoid_robot_element *elements = allocator_allocate(&memory, count + 1, sizeof *elements);
    if (!elements) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a robot of %zu spheres", count);
        return NULL;
    }
    size_t made;
    ovoid_robot *made_robot = NULL;
    if (make_elements(elements, spheres, count, &memory, &made, error) == OVOID_OK) {
        d.elements = elements;
        d.element_count = count;
        made_robot = ovoid_robot_create(&d, &(ovoid_robot_options){.takes_shapes = 1, .allocator = &memory}, error);
    }
    if (!made_robot) destroy_shapes(elements, made);
    allocator_release(&memory, elements);
    return made_robot;
}
