// What EPA (epa.c) does first for a depth: the surface grows in lanes (simd/epa8.h), and in the common case the depth
// is taken from it as it is. The numbers are those that epa.c finds for the same surface; where this ends early, epa.c
// goes on from the points and faces that there are.
#include "exact/epa_lanes.h"

#include "base/compiler.h"
#include "exact/cover_memory.h"
#include "pair/cover.h"

#include <string.h>

// The surfaces of curved bodies have slivers, at which growth in lanes ends.
int epa_lanes_serve(const search *s) {
    double size = s->frame->size;
    return size > 0x1p-100 && size < 0x1p100 && !s->frame->is_true;
}

static simd_difference find(const void *bodies, vec3 n) {
    frame_support w = probe_measure(bodies, vec3_neg(n));
    return (simd_difference){w.gap, w.w.x, w.w.y, w.w.z, w.a, w.b};
}

static void set_point(epa8 *lanes, uint32_t i, const difference *d) {
    lanes->w[0][i] = d->w.x, lanes->w[1][i] = d->w.y, lanes->w[2][i] = d->w.z;
    lanes->a[i] = d->a, lanes->b[i] = d->b;
}

// Grows from the points that the polytope holds, or a kept surface of them.
static epa8_end grow(epa8 *lanes, const prober *p, const epa8_kept *kept) {
    const search *s = p->s;
    double claim = s->frame->claim;
    epa8_query query = {.a = p->a,
                        .b = p->b,
                        .find = p->is_posed ? NULL : find,
                        .bodies = p,
                        .claim = claim,
                        .narrow = s->goal.tolerance - s->goal.allowance - 2 * claim,
                        .near = 2 * epa_get_face_doubt(s),
                        .slack = epa_get_slack(s),
                        .doubt = epa_get_doubt(s),
                        .most = s->goal.iterations,
                        .kept = kept};
    return epa8_grow(lanes, &query);
}

epa8_end epa_lanes_grow(epa8 *lanes, const prober *p, const simplex *points) {
    search *s = p->s;
    lanes->points = (uint32_t)points->count;
    for (int i = 0; i < points->count; i++) set_point(lanes, (uint32_t)i, &points->p[i]);
    epa8_end end = grow(lanes, p, NULL);
    if (end == EPA8_FLAT) return end;
    double lower = s->lower;
    search_take_gap(s, vec3_neg(lanes->best_n), lanes->best_gap);
    if (s->lower > lower) s->stage = OVOID_STAGE_EPA;
    // The support that ends the growth is not counted; epa.c does not count it either.
    s->iterations += lanes->points - EPA8_START;
    return end;
}

static difference get_corner(const epa8 *lanes, uint32_t face, int k) {
    uint32_t i = lanes->v[face][k];
    return (difference){{lanes->w[0][i], lanes->w[1][i], lanes->w[2][i]}, lanes->a[i], lanes->b[i]};
}

static vec3 get_normal(const epa8 *lanes, uint32_t face) {
    return (vec3){lanes->n[0][face], lanes->n[1][face], lanes->n[2][face]};
}

// The radius that the surface keeps from the origin, as measure_faces of epa.c finds it.
static double measure(const search *s, const epa8 *lanes) {
    double depth = lanes->low[lanes->nearest] + epa_get_face_doubt(s);
    for (uint32_t half = 0; half < 2; half++)
        for (uint64_t rest = lanes->near[half]; rest; rest &= rest - 1) {
            uint32_t face = 64 * half + compiler_count_low_zeros_64(rest);
            vec3 n = get_normal(lanes, face);
            for (int k = 0; k < 3; k++) depth = min2(depth, vec3_dot(n, get_corner(lanes, face, k).w));
        }
    return depth - s->frame->claim;
}

// The foot on the nearest face's plane, if it lies in that face.
static int find_foot(const search *s, const epa8 *lanes, uint32_t face, evidence *foot) {
    difference corner[3];
    for (int k = 0; k < 3; k++) corner[k] = get_corner(lanes, face, k);
    return epa_find_foot(s, corner, get_normal(lanes, lanes->nearest), lanes->low[lanes->nearest], foot);
}

// The foot in the nearest face, or in another triangle of its facet.
static int find_witness(const search *s, const epa8 *lanes, evidence *foot) {
    if (find_foot(s, lanes, lanes->nearest, foot)) return 1;
    for (uint32_t half = 0; half < 2; half++)
        for (uint64_t rest = lanes->near[half]; rest; rest &= rest - 1)
            if (find_foot(s, lanes, 64 * half + compiler_count_low_zeros_64(rest), foot)) return 1;
    return 0;
}

// Shows the surface, in the arrays of a small cover or of any.
static void show(const epa8 *lanes, ovoid_cover *cover) {
    small_cover *few = cover->memory;
    cover_arrays *all = cover_get_arrays(cover);
    int is_small = cover->size < OVOID_COVER_SIZE;
    uint32_t *a = is_small ? few->a : all->a, *b = is_small ? few->b : all->b, count = 0;
    uint16_t(*triangles)[3] = is_small ? few->triangles : all->triangles;
    memcpy(a, lanes->a, lanes->points * sizeof *a);
    memcpy(b, lanes->b, lanes->points * sizeof *b);
    for (uint32_t half = 0; half < 2; half++)
        for (uint64_t rest = lanes->alive[half]; rest; rest &= rest - 1, count++) {
            const uint8_t *v = lanes->v[64 * half + compiler_count_low_zeros_64(rest)];
            for (int k = 0; k < 3; k++) triangles[count][k] = v[k];
        }
    cover->point_count = lanes->points;
    cover->triangle_count = count;
    cover->a = a;
    cover->b = b;
    cover->triangles = (const uint16_t(*)[3])triangles;
}

int epa_lanes_take_depth(search *s, const epa8 *lanes, ovoid_cover *cover) {
    if (lanes->inward[0] | lanes->inward[1]) return 0;
    double depth = measure(s, lanes);
    const search_depth found = {lanes->gap - s->frame->lower_radii - s->frame->claim, -depth - s->frame->upper_radii,
                                vec3_neg(get_normal(lanes, lanes->nearest)), OVOID_STAGE_EPA};
    evidence foot;
    if (!(depth > 0) || !search_needs_depth(s, &found) || !find_witness(s, lanes, &foot)) return 0;
    search_take_depth(s, &found, &foot);
    if (search_wants_cover(s, cover, found.upper) || search_wants_start(s, cover)) show(lanes, cover);
    return 1;
}

// The points of an earlier cover, up to a full group. 0 if they are too many or not of these bodies.
static int take_points(epa8 *lanes, const pair_frame *f, const ovoid_cover *kept) {
    uint32_t count = kept->point_count;
    if (count < EPA8_START || count > EPA8_POINTS || !cover_has_arrays(kept)) return 0;
    for (uint32_t i = 0; i < count; i++) {
        lanes->a[i] = kept->a[i], lanes->b[i] = kept->b[i];
        if (kept->a[i] >= f->a->vertex_count || kept->b[i] >= f->b->vertex_count) return 0;
    }
    for (uint32_t i = count; i % EPA8; i++) lanes->a[i] = lanes->b[i] = 0;
    lanes->points = count;
    return 1;
}

// The corners are differences of vertices at the present poses, to the frame's claim, so points of the difference body
// wherever the bodies are. A closed surface of them whose triangles all have the origin behind them, beyond rounding
// (`doubt`), winds around it: each crossing of a ray counts +1 (pair/cover.c). That needs no convexity. So the ball up
// to the nearest triangle is in the body, and `measure` lowers its radius as that of a surface that grew: the planes
// are computed by the same operations. What is not closed, or not outward, the kernel refuses.
//
// Not inlined, so that its memory is given back before a search without the cover.
COMPILER_NOINLINE int epa_lanes_run_kept(search *s, const ovoid_cover *kept, ovoid_cover *cover) {
    const pair_frame *f = s->frame;
    mat3 r = f->rotation;
    vec3 t = f->translation;
    uint32_t faces = kept->triangle_count;
    epa8 lanes;
    prober p;
    if (!epa_lanes_serve(s) || faces < EPA8_START || faces > EPA8_FACES / 2 || !take_points(&lanes, f, kept)) return 0;
    prober_make(&p, s, 0);
    epa8_kept given = {kept->triangles,
                       faces,
                       {r.r0.x, r.r0.y, r.r0.z, r.r1.x, r.r1.y, r.r1.z, r.r2.x, r.r2.y, r.r2.z},
                       {t.x, t.y, t.z}};
    if (grow(&lanes, &p, &given) != EPA8_NARROW || !epa_lanes_take_depth(s, &lanes, cover)) return 0;
    s->iterations = lanes.points - kept->point_count;
    if (!s->iterations) s->stage = OVOID_STAGE_PROOF;
    return 1;
}

int epa_find_foot(const search *s, const difference corner[3], vec3 n, double low, evidence *found) {
    vec3 p[3];
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        found->p[i] = corner[i];
        p[i] = vec3_add_scaled(corner[i].w, n, -low);
    }
    for (int i = 0; i < 3; i++) {
        found->weight[i] = vec3_dot(n, vec3_cross(p[(i + 1) % 3], p[(i + 2) % 3]));
        if (!(found->weight[i] > 0)) return 0;
        sum += found->weight[i];
    }
    vec3 off = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        found->weight[i] /= sum;
        off = vec3_add_scaled(off, p[i], found->weight[i]);
    }
    found->count = 3;
    return vec3_norm(off) <= s->frame->claim;
}
