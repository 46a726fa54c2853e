// A robot is a chain of revolute joints; its cell stands still around it.
#include "many/robot.h"

#include "common/random.h"
#include "common/rotation.h"
#include "many/meetings.h"

#include <ovoid/io.h>
#include <stdio.h>
#include <string.h>

enum { PARTS = 400, SHAPES_MOST = 1024 };

static const double half_turn = 3.14159265358979323846;

void robot_compute_poses(const robot *all, const double *angles, ovoid_pose *links) {
    ovoid_pose at = all->base;
    for (uint32_t k = 0; k < all->cell.link_count; k++) {
        const joint *j = &all->joints[k];
        at.position = ovoid_pose_compute_point(&at, j->origin.position);
        at.rotation = rotation_multiply(at.rotation, j->origin.rotation);
        at.rotation = rotation_multiply(at.rotation, rotation_make_turn(j->axis, angles[k]));
        links[k] = at;
    }
}

void robot_draw(const robot *all, uint64_t *state, double *angles) {
    for (uint32_t k = 0; k < all->cell.link_count; k++)
        angles[k] = random_uniform(state, all->joints[k].low, all->joints[k].high);
}

void robot_destroy(robot *all) {
    free((uint32_t *)all->cell.shape_of);
    free((ovoid_pose *)all->cell.parts);
    free((unsigned char *)all->cell.ignored);
    bodies_destroy(&all->set);
    memset(all, 0, sizeof *all);
}

/// Room for the lists; neighbours in the chain are ignored. 0 if memory runs out.
static int make_room(robot *all, uint32_t link_count) {
    uint32_t *shape_of = calloc(ROBOT_LINKS_MOST + PARTS, sizeof *shape_of);
    ovoid_pose *parts = calloc(PARTS, sizeof *parts);
    unsigned char *ignored = calloc((size_t)link_count * link_count, 1);
    body *items = calloc(SHAPES_MOST, sizeof *items);
    all->set = (bodies){items, 0};
    all->cell = (workcell){items, shape_of, parts, 0, link_count, 0, ignored, 0.2};
    if (!shape_of || !parts || !ignored || !items) return 0;
    for (uint32_t i = 0; i < link_count; i++)
        for (uint32_t k = 0; k < link_count; k++) ignored[i * link_count + k] = i <= k + 1 && k <= i + 1;
    return 1;
}

static void set_shape(robot *all, uint32_t index, uint32_t shape) { ((uint32_t *)all->cell.shape_of)[index] = shape; }

static void add_part(robot *all, uint32_t shape, ovoid_pose pose) {
    set_shape(all, all->cell.link_count + all->cell.part_count, shape);
    ((ovoid_pose *)all->cell.parts)[all->cell.part_count++] = pose;
}

// --- the made robot

/// Points on a sphere, stretched and moved.
static int add_hull(robot *all, uint64_t *state, uint32_t vertices, ovoid_vec3 half, ovoid_vec3 middle) {
    double xyz[3 * 32];
    for (uint32_t i = 0; i < vertices; i++) {
        ovoid_vec3 u = random_unit(state);
        xyz[3 * i] = middle.x + half.x * u.x;
        xyz[3 * i + 1] = middle.y + half.y * u.y;
        xyz[3 * i + 2] = middle.z + half.z * u.z;
    }
    return bodies_add_shape(&all->set, ovoid_shape_create_from_points(xyz, vertices, NULL, NULL));
}

/// A cluster: ten hulls around a place away from the base.
static int add_cluster(robot *all, uint64_t *state) {
    double away = random_uniform(state, 0.55, 1.75), angle = random_uniform(state, -half_turn, half_turn);
    ovoid_vec3 middle = {away * cos(angle), away * sin(angle), random_uniform(state, 0, 1.6)};
    for (int i = 0; i < 10; i++) {
        ovoid_vec3 half = {random_uniform(state, 0.02, 0.15), random_uniform(state, 0.02, 0.1),
                           random_uniform(state, 0.02, 0.06)};
        uint32_t vertices = (uint32_t)random_uniform(state, 8, 33);
        if (!add_hull(all, state, vertices, half, (ovoid_vec3){0, 0, 0})) return 0;
        ovoid_vec3 off = random_unit(state);
        double far = random_uniform(state, 0, 0.2);
        ovoid_vec3 place = {middle.x + far * off.x, middle.y + far * off.y, middle.z + far * off.z};
        add_part(all, all->set.count - 1, (ovoid_pose){place, random_rotation(state)});
    }
    return 1;
}

int robot_create_made(robot *all) {
    *all = (robot){.name = "made robot", .base = {{0, 0, 0.3}, {1, 0, 0, 0}}};
    uint64_t state = 10;
    int good = make_room(all, 10);
    for (uint32_t k = 0; good && k < 10; k++) {
        // Along x, from joint to joint 0.16 m; joint k turns around z or y.
        good = add_hull(all, &state, 32, (ovoid_vec3){0.1, 0.045, 0.045}, (ovoid_vec3){0.08, 0, 0});
        set_shape(all, k, k);
        ovoid_vec3 axis = k % 2 == 0 ? (ovoid_vec3){0, 0, 1} : (ovoid_vec3){0, 1, 0};
        double range = k == 0 ? half_turn : 1;
        all->joints[k] = (joint){{{k == 0 ? 0 : 0.16, 0, 0}, {1, 0, 0, 0}}, axis, -range, range};
    }
    for (int i = 0; good && i < PARTS / 10; i++) good = add_cluster(all, &state);
    if (!good) robot_destroy(all);
    all->cell.shape_count = all->set.count;
    return good;
}

// --- the panda

/// Links 0 to 7, hand, two fingers: origins, axes and ranges of its URDF; fingers 0.04 m open.
static const struct panda_link {
    const char *mesh;
    ovoid_vec3 xyz, rpy;
    double low, high;
} panda_links[] = {
    {"link0", {0, 0, 0}, {0, 0, 0}, 0, 0},
    {"link1", {0, 0, 0.333}, {0, 0, 0}, -2.8973, 2.8973},
    {"link2", {0, 0, 0}, {-1.5707963267948966, 0, 0}, -1.7628, 1.7628},
    {"link3", {0, -0.316, 0}, {1.5707963267948966, 0, 0}, -2.8973, 2.8973},
    {"link4", {0.0825, 0, 0}, {1.5707963267948966, 0, 0}, -3.0718, -0.0698},
    {"link5", {-0.0825, 0.384, 0}, {-1.5707963267948966, 0, 0}, -2.8973, 2.8973},
    {"link6", {0, 0, 0}, {1.5707963267948966, 0, 0}, -0.0175, 3.7525},
    {"link7", {0.088, 0, 0}, {1.5707963267948966, 0, 0}, -2.8973, 2.8973},
    {"hand", {0, 0, 0.107}, {0, 0, -0.7853981633974483}, 0, 0},
    {"finger", {0, 0.04, 0.0584}, {0, 0, 0}, 0, 0},
    {"finger", {0, -0.08, 0}, {0, 0, 3.141592653589793}, 0, 0},
};
enum { PANDA_LINKS = sizeof panda_links / sizeof panda_links[0] };

static int add_panda_links(robot *all, const char *data) {
    for (uint32_t k = 0; k < PANDA_LINKS; k++) {
        const struct panda_link *link = &panda_links[k];
        char path[1024];
        (void)snprintf(path, sizeof path, "%s/robots/panda/meshes/collision/%s.stl", data, link->mesh);
        if (!bodies_add_shape(&all->set, ovoid_shape_read_file(path, &(ovoid_read_options){.hull = 1}, NULL, NULL)))
            return 0;
        set_shape(all, k, k);
        all->joints[k] = (joint){ovoid_pose_make_rpy(link->xyz, link->rpy), {0, 0, 1}, link->low, link->high};
    }
    return 1;
}

/// The parts of one decomposed object, which is a few units large in its file, scaled to 5 %, somewhere around the
/// robot. 0 if memory runs out; an absent file adds nothing.
static int add_object(robot *all, uint64_t *state, const char *path) {
    ovoid_mesh *mesh = ovoid_mesh_read(path, &(ovoid_read_options){.scale = 0.05, .parts = 1}, NULL);
    if (!mesh) return 1;
    double away = random_uniform(state, 0.45, 0.9), angle = random_uniform(state, -half_turn, half_turn);
    ovoid_vec3 middle = {away * cos(angle), away * sin(angle), random_uniform(state, 0, 1)};
    ovoid_pose pose = {middle, random_rotation(state)};
    int good = 1;
    for (size_t i = 0; good && i < ovoid_mesh_get_part_count(mesh) && all->cell.part_count < PARTS; i++) {
        ovoid_faces faces = ovoid_mesh_get_part(mesh, i).faces;
        ovoid_shape *shape = ovoid_shape_create_from_points(faces.vertices, faces.vertex_count, NULL, NULL);
        // Only solids: peers are not queried about flat parts.
        if (shape && ovoid_shape_get_polytope(shape).rank < 3) {
            ovoid_shape_destroy(shape);
            continue;
        }
        good = bodies_add_shape(&all->set, shape);
        if (good) add_part(all, all->set.count - 1, pose);
    }
    ovoid_mesh_destroy(mesh);
    return good;
}

/// Links that touch in nearly all states are ignored, as a set-up assistant for planners does.
static int ignore_usual_touches(robot *all) {
    uint32_t count = all->cell.link_count, hits[ROBOT_LINKS_MOST * ROBOT_LINKS_MOST] = {0};
    unsigned char *ignored = (unsigned char *)all->cell.ignored;
    workcell alone = all->cell;
    alone.part_count = 0;
    uint64_t state = 3;
    enum { STATES = 200 };
    for (int i = 0; i < STATES; i++) {
        double angles[ROBOT_LINKS_MOST];
        ovoid_pose links[ROBOT_LINKS_MOST];
        meeting_truth truth;
        robot_draw(all, &state, angles);
        robot_compute_poses(all, angles, links);
        int good = cell_compute_truth(&alone, links, 0, 0, &truth);
        for (size_t k = 0; good && k < truth.sure.count; k++)
            hits[truth.sure.items[k].a * count + truth.sure.items[k].b]++;
        meeting_truth_destroy(&truth);
        if (!good) return 0;
    }
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count; k++)
            if (hits[i * count + k] * 100 > 95 * STATES) ignored[i * count + k] = ignored[k * count + i] = 1;
    return 1;
}

int robot_create_panda(robot *all, const char *data) {
    *all = (robot){.name = "panda", .base = ovoid_pose_make_identity()};
    uint64_t state = 7;
    int good = make_room(all, PANDA_LINKS) && add_panda_links(all, data);
    for (int k = 0; good && k < 1000 && all->cell.part_count < PARTS; k++) {
        char path[1024];
        (void)snprintf(path, sizeof path, "%s/compounds/%03d.obj", data, k);
        good = add_object(all, &state, path);
    }
    all->cell.shape_count = all->set.count;
    good = good && all->cell.part_count > 0 && ignore_usual_touches(all);
    if (!good) robot_destroy(all);
    return good;
}
