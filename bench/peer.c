// Support functions for libccd: the plain loop over all vertices, in the body's frame, as its own examples do it.
#include "peer.h"

#include <ccd/ccd.h>
#include <ccd/quat.h>

typedef struct body {
    ovoid_polytope polytope;
    ccd_vec3_t position, center;
    ccd_quat_t rotation, inverse;
} body;

static body make_body(const ovoid_shape *shape, const ovoid_pose *pose) {
    body b;
    b.polytope = ovoid_shape_get_polytope(shape);
    ccdVec3Set(&b.position, pose->position.x, pose->position.y, pose->position.z);
    ccdQuatSet(&b.rotation, pose->rotation.x, pose->rotation.y, pose->rotation.z, pose->rotation.w);
    ccdQuatNormalize(&b.rotation);
    ccdQuatInvert2(&b.inverse, &b.rotation);
    ovoid_vec3 center = ovoid_shape_get_measures(shape).centroid;
    ccdVec3Set(&b.center, center.x, center.y, center.z);
    ccdQuatRotVec(&b.center, &b.rotation);
    ccdVec3Add(&b.center, &b.position);
    return b;
}

static void find_support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *vertex) {
    const body *b = object;
    ccd_vec3_t d = *direction;
    ccdQuatRotVec(&d, &b->inverse);
    const double *best = b->polytope.vertices;
    double most = -CCD_REAL_MAX;
    for (uint32_t i = 0; i < b->polytope.vertex_count; i++) {
        const double *v = b->polytope.vertices + 3 * i;
        double dot = v[0] * d.v[0] + v[1] * d.v[1] + v[2] * d.v[2];
        if (dot > most) {
            most = dot;
            best = v;
        }
    }
    ccdVec3Set(vertex, best[0], best[1], best[2]);
    ccdQuatRotVec(vertex, &b->rotation);
    ccdVec3Add(vertex, &b->position);
}

static void find_center(const void *object, ccd_vec3_t *center) { *center = ((const body *)object)->center; }

static ccd_t make_settings(void) {
    ccd_t settings;
    CCD_INIT(&settings);
    settings.support1 = settings.support2 = find_support;
    settings.center1 = settings.center2 = find_center;
    settings.max_iterations = 1000;
    return settings;
}

int peer_collide_gjk(const ovoid_pair *pair) {
    ccd_t settings = make_settings();
    body a = make_body(pair->shape_a, &pair->pose_a), b = make_body(pair->shape_b, &pair->pose_b);
    return ccdGJKIntersect(&a, &b, &settings);
}

int peer_collide_mpr(const ovoid_pair *pair) {
    ccd_t settings = make_settings();
    body a = make_body(pair->shape_a, &pair->pose_a), b = make_body(pair->shape_b, &pair->pose_b);
    return ccdMPRIntersect(&a, &b, &settings);
}

double peer_depth(const ovoid_pair *pair) {
    ccd_t settings = make_settings();
    body a = make_body(pair->shape_a, &pair->pose_a), b = make_body(pair->shape_b, &pair->pose_b);
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    return ccdGJKPenetration(&a, &b, &settings, &depth, &direction, &position) == 0 ? depth : 0;
}
