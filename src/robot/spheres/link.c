// A link's convex parts in its own frame, in units of a power of two near its size, and the core's answers about how
// far a point is from a part.
#include "base/error.h"
#include "robot/model/inner_balls.h"
#include "robot/spheres/spheres.h"

static double sum_sizes(vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

// A bound of all that is added up to place a vertex of a part: its length bounds those roundings too.
static double find_reach(const ovoid_robot_element *e) {
    ovoid_polytope p = ovoid_shape_get_polytope(e->shape);
    double most = 0;
    for (uint32_t i = 0; i < p.vertex_count; i++) most = max2(most, sum_sizes(vec3_at(p.vertices, i)));
    double beyond = ovoid_shape_get_radius(e->shape) + ovoid_shape_get_allowance(e->shape).outside;
    return most + sum_sizes(p.origin) + sum_sizes(e->pose.position) + beyond;
}

static void count_parts(spheres_link *link, const ovoid_robot_description *d, uint32_t index, size_t *points) {
    double reach = 0;
    for (size_t i = 0; i < d->element_count; i++) {
        if (d->elements[i].link != index) continue;
        link->part_count++;
        *points += ovoid_shape_get_polytope(d->elements[i].shape).vertex_count;
        reach = max2(reach, find_reach(&d->elements[i]));
    }
    link->unit = ldexp(1, find_unit_exponent(reach));
    // Vertices are off by 64 ulp of their reach, which is at most our unit, that is 128 u; each of at most 200 halvings
    // moves a corner by 2 u, which is 400 u; the middle of a part is off by 64 u; points and poses of the core's
    // answers by less than the rest.
    link->pad = 1024 * ROUNDING;
}

// The mean of at most 64 vertices: in the body to 64 u, however many there are.
static vec3 find_middle(const vec3 *points, uint32_t count) {
    uint32_t step = count / 64 + 1, used = 0;
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < count; i += step, used++) sum = vec3_add(sum, points[i]);
    return vec3_scale(sum, 1.0 / used);
}

static void place_points(const spheres_link *link, spheres_part *part, const ovoid_polytope *p, vec3 *points) {
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        vec3 local = vec3_add(p->origin, vec3_at(p->vertices, i));
        points[i] = vec3_scale(ovoid_pose_compute_point(&part->probe.pose_a, local), 1 / link->unit);
    }
    part->middle = find_middle(points, p->vertex_count);
    box b = box_make_around(&points[0].x, p->vertex_count);
    double margin = part->beyond + link->pad;
    part->box.min = vec3_sub(b.min, (vec3){margin, margin, margin});
    part->box.max = vec3_add(b.max, (vec3){margin, margin, margin});
}

static void fill_part(const spheres_link *link, spheres_part *part, const ovoid_robot_element *e, vec3 *points) {
    ovoid_polytope p = ovoid_shape_get_polytope(e->shape);
    ovoid_allowance allowance = ovoid_shape_get_allowance(e->shape);
    *part = (spheres_part){.probe = {e->shape, link->point, e->pose, ovoid_pose_make_identity()},
                           .points = points,
                           .point_count = p.vertex_count};
    part->beyond = (ovoid_shape_get_radius(e->shape) + allowance.outside) / link->unit * (1 + 4 * ROUNDING);
    part->inside = allowance.inside / link->unit * (1 + 4 * ROUNDING);
    if (p.rank == 3 && part->beyond == 0) part->triangles = p.triangles, part->triangle_count = p.triangle_count;
    place_points(link, part, &p, points);
}

static void fill_parts(spheres_link *link, const ovoid_robot_description *d, uint32_t index) {
    uint32_t part = 0;
    vec3 *points = link->points;
    link->box = box_make_empty();
    for (size_t i = 0; i < d->element_count; i++) {
        if (d->elements[i].link != index) continue;
        fill_part(link, &link->parts[part], &d->elements[i], points);
        link->parts[part].element = (uint32_t)i;
        link->box = box_join(&link->box, &link->parts[part].box);
        points += link->parts[part++].point_count;
    }
}

ovoid_code spheres_link_open(spheres_link *link, const ovoid_robot *robot, uint32_t index,
                             const ovoid_allocator *memory, ovoid_error *error) {
    *link = (spheres_link){.memory = *memory};
    ovoid_robot_description d = ovoid_robot_get_description(robot);
    if (index >= d.link_count)
        return error_set(error, OVOID_ERROR_INDEX, (int64_t)index, "there is no link %u: the robot has %zu", index,
                         d.link_count);
    size_t points = 0;
    count_parts(link, &d, index, &points);
    if (link->part_count == 0)
        return error_set(error, OVOID_ERROR_EMPTY, (int64_t)index, "link \"%.80s\" has no collision geometry",
                         d.links[index].name);
    link->parts = allocator_allocate(memory, link->part_count, sizeof *link->parts);
    link->points = allocator_allocate(memory, points, sizeof *link->points);
    link->point = shape_create_point(memory);
    if (link->parts && link->points && link->point) {
        fill_parts(link, &d, index);
        return OVOID_OK;
    }
    spheres_link_close(link);
    return error_set(error, OVOID_ERROR_MEMORY, (int64_t)index, "no memory for the %u parts of link \"%.80s\"",
                     link->part_count, d.links[index].name);
}

void spheres_link_close(spheres_link *link) {
    ovoid_shape_destroy(link->point);
    allocator_release(&link->memory, link->points);
    allocator_release(&link->memory, link->parts);
}

ovoid_answer spheres_part_probe(const spheres_link *link, const spheres_part *part, vec3 x) {
    ovoid_pair pair = part->probe;
    pair.pose_b.position = vec3_scale(x, link->unit);
    return ovoid_depth(&pair, NULL, NULL, NULL);
}
