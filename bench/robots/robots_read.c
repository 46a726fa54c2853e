// Robots and their scenes, in ovoid's form and as plain arrays for its peers.
#define _GNU_SOURCE
#include "robots/robots.h"

#include "common/bodies.h"
#include "common/module.h"
#include "common/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SOLIDS_MOST = 512 };

static const double half_turn = 3.14159265358979323846;

typedef const robot_peer *const *(*get_robot_peers)(void);

int robots_field_load(robots_field *all, const char *path) {
    get_robot_peers get = (get_robot_peers)module_load(path, "bench_get_robot_peers");
    if (!get) return 0;
    for (const robot_peer *const *p = get(); *p && all->count < ROBOT_PEERS_MOST; p++) all->peers[all->count++] = *p;
    return 1;
}

// ---- solids

/// A box if eight vertices have the same distances from the middle; a cylinder along z if all vertices have one height
/// or its negative, and one distance from the axis.
static void find_kind(solid *s, double radius) {
    s->kind = SOLID_HULL;
    double most[3] = {0, 0, 0}, low = INFINITY, high = 0;
    if (s->hull.vertex_count == 1) {
        s->kind = SOLID_SPHERE;
        s->size[0] = radius;
        return;
    }
    if (s->hull.vertex_count == 2 && radius > 0) {
        s->kind = SOLID_CAPSULE;
        s->size[0] = radius;
        s->size[1] = fabs(s->hull.vertices[2]);
        return;
    }
    int is_box = s->hull.vertex_count == 8, is_cylinder = s->hull.vertex_count > 8;
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < s->hull.vertex_count; i++) {
            const double *v = s->hull.vertices + (size_t)3 * i;
            double out = hypot(v[0], v[1]);
            for (int k = 0; k < 3; k++) {
                most[k] = fmax(most[k], fabs(v[k]));
                if (pass && !(fabs(v[k]) > most[k] * (1 - 1e-9))) is_box = 0;
            }
            low = fmin(low, out);
            high = fmax(high, out);
            if (pass && !(fabs(v[2]) > most[2] * (1 - 1e-9))) is_cylinder = 0;
        }
    if (!(low > high * (1 - 1e-9))) is_cylinder = 0;
    if (is_box) {
        s->kind = SOLID_BOX;
        memcpy(s->size, most, sizeof most);
    } else if (is_cylinder) {
        s->kind = SOLID_CYLINDER;
        s->size[0] = high;
        s->size[1] = most[2];
    }
}

/// The number of the shape's solid, added if it is new; its owner keeps the shape. NONE: no room.
static uint32_t add_solid(machine *m, const ovoid_shape *shape) {
    for (uint32_t i = 0; i < m->solid_count; i++)
        if (m->solids[i].hull.shape == shape) return i;
    if (m->solid_count == SOLIDS_MOST) return OVOID_ROBOT_NONE;
    solid *s = &m->solids[m->solid_count];
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double *vertices = malloc(sizeof *vertices * 3 * p.vertex_count);
    if (!vertices) return OVOID_ROBOT_NONE;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        vertices[3 * i] = p.vertices[3 * i] + p.origin.x;
        vertices[3 * i + 1] = p.vertices[3 * i + 1] + p.origin.y;
        vertices[3 * i + 2] = p.vertices[3 * i + 2] + p.origin.z;
    }
    *s = (solid){.hull = {.shape = shape,
                          .vertices = vertices,
                          .triangles = p.triangles,
                          .neighbor_starts = p.neighbor_starts,
                          .neighbors = p.neighbors,
                          .vertex_count = p.vertex_count,
                          .triangle_count = p.triangle_count}};
    find_kind(s, ovoid_shape_get_radius(shape));
    return m->solid_count++;
}

static void drop_solids(machine *m, uint32_t kept) {
    while (m->solid_count > kept) free((double *)m->solids[--m->solid_count].hull.vertices);
}

// ---- machines

static void set_ignored(machine *m, const ovoid_robot_description *d) {
    for (uint32_t a = 0; a < m->link_count; a++)
        for (uint32_t b = 0; b < m->link_count; b++)
            m->ignored[a * m->link_count + b] = (unsigned char)ovoid_robot_is_rigid_pair(m->robot, a, b);
    for (size_t i = 0; i < d->disabled_count; i++) {
        uint32_t a = d->disabled[i].a, b = d->disabled[i].b;
        m->ignored[a * m->link_count + b] = m->ignored[b * m->link_count + a] = 1;
    }
}

static void set_limits(machine *m) {
    m->reach = 0;
    for (uint32_t i = 0; i < m->variable_count; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(m->robot, i);
        m->low[i] = v.lower > -INFINITY ? v.lower : -half_turn;
        m->high[i] = v.upper < INFINITY ? v.upper : half_turn;
    }
}

/// The reach of the robot, about: the farthest part of its links in some states.
static void find_reach(machine *m) {
    uint64_t random = 1;
    double *q = malloc(sizeof *q * (m->variable_count + 1));
    ovoid_pose *poses = malloc(sizeof *poses * m->link_count);
    for (int i = 0; q && poses && i < 200; i++) {
        machine_draw(m, &random, q);
        if (ovoid_robot_compute_poses(m->robot, q, poses, NULL) != OVOID_OK) break;
        for (uint32_t k = 0; k < m->link_count; k++) {
            ovoid_vec3 p = poses[k].position;
            m->reach = fmax(m->reach, sqrt(p.x * p.x + p.y * p.y + p.z * p.z));
        }
    }
    free(q);
    free(poses);
}

/// Computes the fields that follow from the robot.
static int finish(machine *m) {
    if (!m->robot) return 0;
    ovoid_robot_description d = ovoid_robot_get_description(m->robot);
    m->link_count = (uint32_t)d.link_count;
    m->element_count = (uint32_t)d.element_count;
    m->variable_count = (uint32_t)ovoid_robot_get_variable_count(m->robot);
    m->solids = calloc(SOLIDS_MOST, sizeof *m->solids);
    m->elements = calloc(d.element_count + 1, sizeof *m->elements);
    m->ignored = calloc(d.link_count, d.link_count);
    m->low = calloc(m->variable_count + 1u, sizeof *m->low);
    m->high = calloc(m->variable_count + 1u, sizeof *m->high);
    if (!m->solids || !m->elements || !m->ignored || !m->low || !m->high) return 0;
    for (uint32_t i = 0; i < d.element_count; i++) {
        uint32_t which = add_solid(m, d.elements[i].shape);
        if (which == OVOID_ROBOT_NONE) return 0;
        m->elements[i] = (placed_solid){which, d.elements[i].link, d.elements[i].pose};
    }
    set_ignored(m, &d);
    set_limits(m);
    find_reach(m);
    return 1;
}

/// The problems of an archive, unpacked to a folder that is removed at the end, as the files are read scene by scene.
static int unpack(machine *m, const char *archive) {
    char folder[] = "/tmp/ovoid-bench-XXXXXX", command[2400];
    ovoid_error error;
    if (access(archive, R_OK) != 0 || !mkdtemp(folder)) return 0;
    (void)snprintf(command, sizeof command, "tar xjf '%s' -C '%s'", archive, folder);
    // NOLINTNEXTLINE(cert-env33-c): tar is asked by its name, as in a shell
    int good = system(command) == 0;
    m->problems = good ? ovoid_problems_find(folder, &error) : NULL;
    (void)snprintf(m->folder, sizeof m->folder, "%s", folder);
    return m->problems != NULL;
}

int machine_read(machine *m, const char *data, const machine_files *files) {
    *m = (machine){0};
    (void)snprintf(m->name, sizeof m->name, "%s", files->name);
    char urdf[1024], srdf[1024], archive[1024];
    (void)snprintf(urdf, sizeof urdf, "%s/robots/%s", data, files->urdf);
    (void)snprintf(srdf, sizeof srdf, "%s/robots/%s", data, files->srdf ? files->srdf : "");
    (void)snprintf(archive, sizeof archive, "%s/robots/%s", data, files->problems ? files->problems : "");
    ovoid_error error;
    ovoid_robot_read_options options = {.fixed_base = 1, .hull = 1, .ros_package_path = "", .ament_prefix_path = ""};
    m->file = ovoid_robot_file_read(urdf, files->srdf ? srdf : NULL, &options, &error);
    if (!m->file) {
        printf("without %s: %s\n", files->name, error.message);
        return 0;
    }
    ovoid_robot_description d = ovoid_robot_file_get_description(m->file);
    m->robot = ovoid_robot_create(&d, NULL, &error);
    if (finish(m) && (!files->problems || unpack(m, archive))) return 1;
    printf("without %s: its robot or its problems could not be made\n", files->name);
    machine_destroy(m);
    return 0;
}

void machine_destroy(machine *m) {
    char command[200];
    if (m->solids) drop_solids(m, 0);
    free(m->solids);
    free(m->elements);
    free(m->ignored);
    free(m->low);
    free(m->high);
    ovoid_problems_destroy(m->problems);
    ovoid_robot_destroy(m->robot);
    ovoid_robot_file_destroy(m->file);
    (void)snprintf(command, sizeof command, "rm -r '%s'", m->folder);
    // NOLINTNEXTLINE(cert-env33-c): the folder was made here
    if (m->folder[0] && system(command) != 0) printf("%s was not removed\n", m->folder);
    *m = (machine){0};
}

void machine_draw(const machine *m, uint64_t *random, double *q) {
    for (uint32_t i = 0; i < m->variable_count; i++) q[i] = random_uniform(random, m->low[i], m->high[i]);
}

// ---- machines made here

/// A chain whose joints turn about y and z alternately, with capsules as links; neighbours touch.
int machine_make_snake(machine *m, uint32_t links) {
    enum { MOST = 256 };
    static char names[2][MOST][16];
    static ovoid_robot_link link[MOST];
    static ovoid_robot_element element[MOST];
    static ovoid_robot_pair pair[MOST];
    *m = (machine){0};
    ovoid_robot_joint *joint = calloc(links + 1, sizeof *joint);
    if (!joint || links > MOST) return free(joint), 0;
    (void)snprintf(m->name, sizeof m->name, "snake of %u", links);
    ovoid_pose middle = {{0.05, 0, 0}, {0.7071067811865476, 0, 0.7071067811865476, 0}}; // z to x
    for (uint32_t i = 0; i < links; i++) {
        (void)snprintf(names[0][i], sizeof names[0][i], "link%u", i);
        (void)snprintf(names[1][i], sizeof names[1][i], "joint%u", i);
        link[i].name = names[0][i];
        // Each element has a shape of its own, as the robot frees them.
        element[i] = (ovoid_robot_element){i, NULL, ovoid_shape_create_capsule(0.03, 0.05, NULL, NULL), middle, NULL};
        if (i == 0) continue;
        pair[i - 1] = (ovoid_robot_pair){i - 1, i, "Adjacent"};
        joint[i - 1] = (ovoid_robot_joint){.name = names[1][i],
                                           .type = OVOID_JOINT_REVOLUTE,
                                           .parent = i - 1,
                                           .child = i,
                                           .origin = {{0.1, 0, 0}, {1, 0, 0, 0}},
                                           .axis = {0, i % 2, 1 - i % 2},
                                           .lower = -0.4,
                                           .upper = 0.4,
                                           .mimic = OVOID_ROBOT_NONE};
    }
    ovoid_robot_description d = {m->name, link, links, joint, links - 1, element, links, pair, links - 1, NULL};
    m->robot = ovoid_robot_create(&d, &(ovoid_robot_options){.takes_shapes = 1}, NULL);
    for (uint32_t i = 0; !m->robot && i < links; i++) ovoid_shape_destroy((ovoid_shape *)element[i].shape);
    free(joint);
    if (finish(m)) return 1;
    machine_destroy(m);
    return 0;
}

/// A description repeated twice, on a base between the two.
typedef struct twins {
    ovoid_robot_link *links;
    ovoid_robot_joint *joints;
    ovoid_robot_element *elements;
    ovoid_robot_pair *disabled;
    char (*names)[64];
} twins;

static int twins_fill(twins *t, const ovoid_robot_description *d, uint32_t root) {
    size_t n = d->link_count, j = d->joint_count, e = d->element_count, p = d->disabled_count;
    t->links = calloc(2 * n + 1, sizeof *t->links);
    t->joints = calloc(2 * j + 2, sizeof *t->joints);
    t->elements = calloc(2 * e + 1, sizeof *t->elements);
    t->disabled = calloc(2 * p + 1, sizeof *t->disabled);
    t->names = calloc(2 * (n + j), sizeof *t->names);
    if (!t->links || !t->joints || !t->elements || !t->disabled || !t->names) return 0;
    for (uint32_t side = 0; side < 2; side++) {
        uint32_t by = side * (uint32_t)n;
        for (size_t i = 0; i < n; i++) {
            char *name = t->names[by + i];
            (void)snprintf(name, sizeof *t->names, "%s_%u", d->links[i].name, side);
            t->links[by + i].name = name;
        }
        for (size_t i = 0; i < j; i++) {
            char *name = t->names[2 * n + side * j + i];
            ovoid_robot_joint *to = &t->joints[side * j + i];
            *to = d->joints[i];
            (void)snprintf(name, sizeof *t->names, "%s_%u", d->joints[i].name, side);
            to->name = name;
            to->parent += by;
            to->child += by;
            if (to->mimic != OVOID_ROBOT_NONE) to->mimic += side * (uint32_t)j;
        }
        for (size_t i = 0; i < e; i++) {
            t->elements[side * e + i] = d->elements[i];
            t->elements[side * e + i].link += by;
        }
        for (size_t i = 0; i < p; i++)
            t->disabled[side * p + i] = (ovoid_robot_pair){d->disabled[i].a + by, d->disabled[i].b + by, NULL};
        t->joints[2 * j + side] = (ovoid_robot_joint){.name = side ? "right" : "left",
                                                      .type = OVOID_JOINT_FIXED,
                                                      .parent = (uint32_t)(2 * n),
                                                      .child = root + by,
                                                      .origin = {{0, side ? -0.4 : 0.4, 0}, {1, 0, 0, 0}},
                                                      .mimic = OVOID_ROBOT_NONE};
    }
    t->links[2 * n].name = "between";
    return 1;
}

int machine_make_pair(machine *m, const machine *one) {
    *m = (machine){0};
    (void)snprintf(m->name, sizeof m->name, "two of %.40s", one->name);
    ovoid_robot_description d = ovoid_robot_get_description(one->robot);
    twins t = {0};
    if (twins_fill(&t, &d, ovoid_robot_get_root(one->robot))) {
        ovoid_robot_description both = {m->name,
                                        t.links,
                                        2 * d.link_count + 1,
                                        t.joints,
                                        2 * d.joint_count + 2,
                                        t.elements,
                                        2 * d.element_count,
                                        t.disabled,
                                        2 * d.disabled_count,
                                        NULL};
        m->robot = ovoid_robot_create(&both, NULL, NULL);
    }
    free(t.links);
    free(t.joints);
    free(t.elements);
    free(t.disabled);
    free(t.names);
    if (finish(m)) return 1;
    machine_destroy(m);
    return 0;
}

// ---- scenes

uint32_t machine_count_scenes(const machine *m) {
    return m->problems ? (uint32_t)ovoid_problems_get_count(m->problems) : 10;
}

static int add_obstacle(robots_scene *s, machine *m, const ovoid_shape *shape, ovoid_pose pose) {
    uint32_t which = add_solid(m, shape);
    if (which == OVOID_ROBOT_NONE || s->what.obstacle_count == ROBOT_OBSTACLES_MOST) return 0;
    s->obstacles[s->what.obstacle_count++] = (placed_solid){which, OVOID_ROBOT_NONE, pose};
    return ovoid_robot_cell_add(s->cell, &(ovoid_body){.shape = shape, .pose = pose}, NULL) != 0;
}

/// Ten boxes around the robot, at half its reach or more.
static int make_boxes(robots_scene *s, machine *m) {
    for (int i = 0; i < 10; i++) {
        double r = m->reach;
        ovoid_vec3 half = {random_uniform(&s->random, 0.03, 0.15) * r, random_uniform(&s->random, 0.03, 0.15) * r,
                           random_uniform(&s->random, 0.03, 0.15) * r};
        ovoid_vec3 to = random_unit(&s->random);
        double away = random_uniform(&s->random, 0.5, 1) * r;
        ovoid_pose pose = {{away * to.x, away * to.y, away * to.z}, random_rotation(&s->random)};
        ovoid_shape *shape = ovoid_shape_create_box(half, NULL, NULL);
        if (!shape) return 0;
        s->made[s->made_count++] = shape;
        if (!add_obstacle(s, m, shape, pose)) return 0;
    }
    return 1;
}

static int read_obstacles(robots_scene *s, machine *m, uint32_t index) {
    // The peers use hulls.
    const ovoid_robot_read_options hulls = {.hull = 1};
    ovoid_error error;
    s->file = ovoid_obstacles_read(ovoid_problems_get(m->problems, index).scene, &hulls, &error);
    if (!s->file) {
        printf("%s\n", error.message);
        return 0;
    }
    for (size_t i = 0; i < ovoid_obstacles_get_count(s->file); i++) {
        ovoid_obstacle o = ovoid_obstacles_get(s->file, i);
        if (!add_obstacle(s, m, o.shape, o.pose)) return 0;
    }
    return 1;
}

int robots_scene_create(robots_scene *s, machine *m, uint32_t index) {
    *s = (robots_scene){.random = index + 1};
    s->cell = ovoid_robot_cell_create(m->robot, NULL, NULL);
    int good = s->cell && (m->problems ? read_obstacles(s, m, index) : make_boxes(s, m));
    s->checker = good ? ovoid_robot_checker_create(s->cell, NULL, NULL) : NULL;
    s->what = (robot_scene){.robot = m->name,
                            .solids = m->solids,
                            .elements = m->elements,
                            .obstacles = s->obstacles,
                            .solid_count = m->solid_count,
                            .element_count = m->element_count,
                            .obstacle_count = s->what.obstacle_count,
                            .link_count = m->link_count,
                            .variable_count = m->variable_count,
                            .ignored = m->ignored,
                            .margin = 0.2};
    if (s->checker) return 1;
    robots_scene_destroy(s, m);
    return 0;
}

void robots_scene_destroy(robots_scene *s, machine *m) {
    ovoid_robot_checker_destroy(s->checker);
    ovoid_robot_cell_destroy(s->cell);
    ovoid_obstacles_destroy(s->file);
    for (uint32_t i = 0; i < s->made_count; i++) ovoid_shape_destroy(s->made[i]);
    // Solids of the scene are removed; those of the robot, which come first, stay.
    uint32_t own = 0;
    for (uint32_t i = 0; i < m->element_count; i++)
        own = m->elements[i].solid + 1 > own ? m->elements[i].solid + 1 : own;
    drop_solids(m, own);
    *s = (robots_scene){0};
}
