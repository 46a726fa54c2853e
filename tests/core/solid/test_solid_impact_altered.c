// Lies about the impacts of moving solids, alone and beside a shape or a compound (body_impact_liar.h).
#include "body_impact_liar.h"
#include "solids.h"

typedef struct bodies {
    ovoid_shape *shape;
    ovoid_compound *compound;
    ovoid_solid *solids[2];
    mesh meshes[2];
} bodies;

// A body's leaf as a shape of its own. Its pose is that of the body, and of a compound's part the part's too.
static leaf_shape make_leaf(const truth *t, int side, uint32_t leaf, double time) {
    const ovoid_moving_body *m = side ? &t->b : &t->a;
    ovoid_pose pose = ovoid_motion_compute_pose(&m->motion, time);
    if (m->shape) return (leaf_shape){{m->shape, pose}, NULL};
    if (m->compound) {
        ovoid_moving_shape part = ovoid_moving_body_get_part(m, leaf);
        return (leaf_shape){{part.shape, ovoid_moving_shape_compute_pose(&part, time)}, NULL};
    }
    double xyz[9];
    const mesh *own = &((const bodies *)t->bodies)->meshes[side];
    for (uint32_t c = 0; c < 9; c++) xyz[c] = own->xyz[3 * own->indices[3 * leaf + c / 3] + c % 3];
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, 3, NULL, NULL);
    return (leaf_shape){{shape, pose}, shape};
}

static void make_mesh(mesh *m, int kind, uint64_t *s) {
    uint32_t segments = 3 + (uint32_t)(random_next(s) % 4);
    if (kind % 3 == 0)
        mesh_add_angle(m, 1, random_uniform(s, 0.2, 0.5), random_uniform(s, 0.1, 0.6));
    else
        mesh_add_star(m, (ovoid_vec3){0, 0, 0}, 1, 3, segments, 0.5, s);
    // A surface has nothing inside.
    if (kind % 7 == 6) m->triangles--;
}

// The second body is a solid, a shape, or a compound of two.
static void make_second(truth *t, uint64_t seed, uint64_t *s) {
    bodies *own = t->bodies;
    ovoid_vec3 half = {random_uniform(s, 0.1, 0.6), random_uniform(s, 0.1, 0.6), random_uniform(s, 0.1, 0.6)};
    own->shape = ovoid_shape_create_box(half, NULL, NULL);
    const ovoid_posed_shape two[2] = {{own->shape, {{0, 0, 0}, {1, 0, 0, 0}}},
                                      {own->shape, {{0.7, 0.3, 0}, {1, 1, 0, 0}}}};
    own->compound = ovoid_compound_create(two, 2, NULL, NULL);
    make_mesh(&own->meshes[1], (int)(seed % 5), s);
    if (seed % 9 == 8)
        for (size_t i = 0; i < 3 * own->meshes[1].points; i++) own->meshes[1].xyz[i] *= 0.05;
    own->solids[1] = mesh_make_solid(&own->meshes[1]);
    t->b.shape = seed % 4 == 1 ? own->shape : NULL;
    t->b.compound = seed % 4 == 2 ? own->compound : NULL;
    t->b.solid = seed % 4 == 1 || seed % 4 == 2 ? NULL : own->solids[1];
    t->count_b = t->b.shape ? 1 : t->b.compound ? 2 : (uint32_t)own->meshes[1].triangles;
}

static ovoid_motion make_motion(uint64_t seed, double far, uint64_t *s) {
    ovoid_pose start = {random_vec3(s, far), random_quat(s)}, end = {random_vec3(s, far), random_quat(s)};
    if (seed % 2) return ovoid_motion_make_poses(start, end, 1);
    ovoid_vec3 back = {-1.5 * start.position.x, -1.5 * start.position.y, -1.5 * start.position.z};
    return ovoid_motion_make_velocity(start, back, random_vec3(s, 2), 1);
}

static void make(truth *t, uint64_t seed) {
    uint64_t s = seed * 31;
    static bodies own_bodies;
    bodies *own = &own_bodies;
    memset(own, 0, sizeof *own);
    *t = (truth){.bodies = own, .slack = 1e-10, .margin = seed % 3 ? 0 : 0.3};
    make_mesh(&own->meshes[0], (int)(seed % 7), &s);
    own->solids[0] = mesh_make_solid(&own->meshes[0]);
    t->a = (ovoid_moving_body){.solid = own->solids[0], .motion = make_motion(seed, 0.5, &s)};
    t->count_a = (uint32_t)own->meshes[0].triangles;
    make_second(t, seed, &s);
    // Now and then they begin within one another.
    t->b.motion = make_motion(seed, seed % 9 == 8 ? 0.4 : 3, &s);
    set_times(t, seed);
}

static void destroy(truth *t) {
    bodies *own = t->bodies;
    for (int k = 0; k < 2; k++) {
        ovoid_solid_destroy(own->solids[k]);
        mesh_clear(&own->meshes[k]);
    }
    ovoid_compound_destroy(own->compound);
    ovoid_shape_destroy(own->shape);
}

int main(int count, char **arguments) { return run_cases(count, arguments, 60, make, destroy); }
