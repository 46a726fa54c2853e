// libccd (D. Fiser): yes or no by GJK and by MPR (XenoCollide), depth by GJK and EPA and by MPR. Its user writes the
// support functions: here a loop over a contiguous array in the body's frame, rotated by a matrix. Tolerances are its
// own. Within a margin: both supports are enlarged by half of it. It measures no distance and has no warm start.
#include "common/rotation.h"
#include "peers/peer.h"

#include <ccd/ccd.h>
#include <math.h>
#include <stdlib.h>

typedef struct object {
    rotation turn;
    ovoid_vec3 position, center;
    const double *vertices;
    uint32_t count;
    double radius; ///< added around the body
} object;

typedef struct self {
    object *objects; ///< of pair i: 2 i and 2 i + 1
    double *margins;
    uint32_t count;
} self;

static void find_support(const void *data, const ccd_vec3_t *direction, ccd_vec3_t *vertex) {
    const object *o = data;
    ovoid_vec3 world = {direction->v[0], direction->v[1], direction->v[2]}, d = rotation_undo(&o->turn, world);
    const double *best = o->vertices;
    double most = -INFINITY;
    for (uint32_t i = 0; i < o->count; i++) {
        const double *v = o->vertices + (size_t)3 * i;
        double dot = v[0] * d.x + v[1] * d.y + v[2] * d.z;
        if (dot > most) {
            most = dot;
            best = v;
        }
    }
    ovoid_vec3 x = rotation_apply(&o->turn, (ovoid_vec3){best[0], best[1], best[2]});
    ccdVec3Set(vertex, x.x + o->position.x, x.y + o->position.y, x.z + o->position.z);
    if (o->radius > 0) {
        double scale = o->radius / sqrt(world.x * world.x + world.y * world.y + world.z * world.z);
        ccd_vec3_t more = *direction;
        ccdVec3Scale(&more, scale);
        ccdVec3Add(vertex, &more);
    }
}

static void find_center(const void *data, ccd_vec3_t *center) {
    const object *o = data;
    ccdVec3Set(center, o->center.x, o->center.y, o->center.z);
}

static object make_object(const body *b, const ovoid_pose *pose) {
    object o = {rotation_make(pose->rotation), pose->position, {0, 0, 0}, b->vertices, b->vertex_count, 0};
    ovoid_vec3 c = rotation_apply(&o.turn, b->center);
    o.center = (ovoid_vec3){c.x + pose->position.x, c.y + pose->position.y, c.z + pose->position.z};
    return o;
}

static void destroy(void *state) {
    self *s = state;
    if (!s) return;
    free(s->objects);
    free(s->margins);
    free(s);
}

static void *create(const workload *work) {
    self *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->count = work->pair_count;
    s->objects = malloc(sizeof *s->objects * 2 * s->count);
    s->margins = malloc(sizeof *s->margins * s->count);
    if (!s->objects || !s->margins) {
        destroy(s);
        return NULL;
    }
    for (uint32_t i = 0; i < s->count; i++) {
        const placed *p = &work->pairs[i];
        s->objects[2 * i] = make_object(&work->bodies[p->a], &p->pose_a);
        s->objects[2 * i + 1] = make_object(&work->bodies[p->b], &p->pose_b);
        s->margins[i] = p->margin;
    }
    return s;
}

typedef int (*intersect)(const void *, const void *, const ccd_t *);
typedef int (*penetrate)(const void *, const void *, const ccd_t *, ccd_real_t *, ccd_vec3_t *, ccd_vec3_t *);

static void run(self *s, question what, intersect boolean, penetrate depth, found *answers) {
    ccd_t settings;
    CCD_INIT(&settings);
    settings.support1 = settings.support2 = find_support;
    settings.center1 = settings.center2 = find_center;
    settings.max_iterations = 1000;
    for (uint32_t i = 0; i < s->count; i++) {
        object *a = &s->objects[2 * (size_t)i], *b = a + 1;
        if (what == QUESTION_DEPTH) {
            ccd_real_t d = 0;
            ccd_vec3_t n = {{0, 0, 0}}, at = {{0, 0, 0}};
            int apart = depth(a, b, &settings, &d, &n, &at);
            answers[i] =
                (found){.yes = apart ? VERDICT_NO : VERDICT_YES, .distance = d, .normal = {n.v[0], n.v[1], n.v[2]}};
        } else {
            a->radius = b->radius = what == QUESTION_WITHIN ? 0.5 * s->margins[i] : 0;
            answers[i] = (found){.yes = boolean(a, b, &settings) ? VERDICT_YES : VERDICT_NO};
        }
    }
    for (uint32_t i = 0; i < 2 * s->count; i++) s->objects[i].radius = 0;
}

static void run_gjk(void *state, question what, int warm, found *answers) {
    (void)warm;
    run(state, what, ccdGJKIntersect, ccdGJKPenetration, answers);
}
static void run_mpr(void *state, question what, int warm, found *answers) {
    (void)warm;
    run(state, what, ccdMPRIntersect, ccdMPRPenetration, answers);
}

static const unsigned questions = 1u << QUESTION_COLLIDE | 1u << QUESTION_WITHIN | 1u << QUESTION_DEPTH;

const peer *const *bench_get_peers(void) {
    static const peer gjk = {"ccd-gjk", questions, 0, 0, create, run_gjk, destroy};
    static const peer mpr = {"ccd-mpr", questions, 0, 0, create, run_mpr, destroy};
    static const peer *const all[] = {&gjk, &mpr, NULL};
    return all;
}
