// ODE (R. Smith): dCollide of two convex geometries, which Debian's build passes to libccd's MPR, after its own
// bounding boxes. It needs the origin inside a body, so bodies are moved there. Yes or no: one contact, the least that
// it allows; depth and normal: the deepest of eight contacts. It measures no distance and has no warm start.
#include "common/rotation.h"
#include "peers/peer.h"

#include <math.h>
#include <ode/ode.h>
#include <stdlib.h>

/// The arrays to which dGeomSetConvex keeps pointers.
typedef struct hull {
    dReal *planes, *points;
    unsigned *polygons;
    unsigned plane_count, point_count;
} hull;

typedef struct self {
    hull *hulls;
    dGeomID *geoms; ///< of pair i: 2 i and 2 i + 1
    uint32_t hull_count, count;
} self;

/// One plane and one triangle a face, as ODE's own demos store them.
static int fill_hull(hull *h, const body *b) {
    *h = (hull){calloc(4 * (size_t)b->triangle_count, sizeof(dReal)), malloc(sizeof(dReal) * 3 * b->vertex_count),
                malloc(sizeof(unsigned) * 4 * b->triangle_count), b->triangle_count, b->vertex_count};
    if (!h->planes || !h->points || !h->polygons) return 0;
    const double center[3] = {b->center.x, b->center.y, b->center.z};
    for (uint32_t i = 0; i < 3 * b->vertex_count; i++) h->points[i] = b->vertices[i] - center[i % 3];
    for (uint32_t t = 0; t < b->triangle_count; t++) {
        const uint32_t *c = b->triangles + (size_t)3 * t;
        const dReal *p = h->points + (size_t)3 * c[0], *q = h->points + (size_t)3 * c[1],
                    *r = h->points + (size_t)3 * c[2];
        double u[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
        double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        double norm = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        dReal *plane = h->planes + (size_t)4 * t;
        for (int k = 0; k < 3; k++) plane[k] = n[k] / norm;
        plane[3] = plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2];
        unsigned *polygon = h->polygons + (size_t)4 * t;
        polygon[0] = 3;
        for (int k = 0; k < 3; k++) polygon[k + 1] = c[k];
    }
    return 1;
}

static void destroy(void *state) {
    self *s = state;
    if (!s) return;
    for (uint32_t i = 0; s->geoms && i < 2 * s->count; i++)
        if (s->geoms[i]) dGeomDestroy(s->geoms[i]);
    for (uint32_t i = 0; s->hulls && i < s->hull_count; i++) {
        free(s->hulls[i].planes);
        free(s->hulls[i].points);
        free(s->hulls[i].polygons);
    }
    free(s->geoms);
    free(s->hulls);
    free(s);
}

static dGeomID create_geom(const hull *h, const body *b, const ovoid_pose *pose) {
    dGeomID g = dCreateConvex(NULL, h->planes, h->plane_count, h->points, h->point_count, h->polygons);
    dQuaternion q = {pose->rotation.w, pose->rotation.x, pose->rotation.y, pose->rotation.z};
    rotation turn = rotation_make(pose->rotation);
    ovoid_vec3 c = rotation_apply(&turn, b->center);
    dGeomSetPosition(g, pose->position.x + c.x, pose->position.y + c.y, pose->position.z + c.z);
    dGeomSetQuaternion(g, q);
    // Its bounding box is computed now, not in the timed loop.
    dReal box[6];
    dGeomGetAABB(g, box);
    return g;
}

static void *create(const workload *work) {
    static int started;
    if (!started++) dInitODE();
    self *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->count = work->pair_count;
    s->hull_count = work->body_count;
    s->hulls = calloc(s->hull_count, sizeof *s->hulls);
    s->geoms = calloc(2 * (size_t)s->count, sizeof *s->geoms);
    int good = s->hulls && s->geoms;
    for (uint32_t i = 0; good && i < s->hull_count; i++) good = fill_hull(&s->hulls[i], &work->bodies[i]);
    if (!good) {
        destroy(s);
        return NULL;
    }
    for (uint32_t i = 0; i < s->count; i++) {
        const placed *p = &work->pairs[i];
        s->geoms[2 * i] = create_geom(&s->hulls[p->a], &work->bodies[p->a], &p->pose_a);
        s->geoms[2 * i + 1] = create_geom(&s->hulls[p->b], &work->bodies[p->b], &p->pose_b);
    }
    return s;
}

static void run(void *state, question what, int warm, found *answers) {
    (void)warm;
    self *s = state;
    dContactGeom contacts[8];
    int flags = what == QUESTION_DEPTH ? 8 : 1 | (int)CONTACTS_UNIMPORTANT;
    for (uint32_t i = 0; i < s->count; i++) {
        const dGeomID *pair = &s->geoms[2 * (size_t)i];
        int count = dCollide(pair[0], pair[1], flags, contacts, sizeof contacts[0]), deepest = 0;
        answers[i] = (found){.yes = count > 0 ? VERDICT_YES : VERDICT_NO};
        if (count == 0) continue;
        for (int k = 1; k < count; k++)
            if (contacts[k].depth > contacts[deepest].depth) deepest = k;
        const dReal *n = contacts[deepest].normal;
        answers[i].distance = contacts[deepest].depth;
        answers[i].normal = (ovoid_vec3){n[0], n[1], n[2]};
    }
}

const peer *const *bench_get_peers(void) {
    static const peer ode = {"ode", 1u << QUESTION_COLLIDE | 1u << QUESTION_DEPTH, 0, 0, create, run, destroy};
    static const peer *const all[] = {&ode, NULL};
    return all;
}
