// Casts into a world: a ray, or a body that moves without rotation. The tree is traversed in the order in which the
// boxes are met, up to the first proven hit; bodies are queried by the casts of motion.h, part by part, and solids by
// those of cast_solid.h.
//
// A slab is entered at (low - origin) / direction: one difference and one quotient of given numbers, off by 2 u of
// itself, which WIDER covers. Boxes are enlarged by half the box of the moving body, and by 2^-50 of their coordinates
// for the rounding of that sum.
#include "base/environment.h"
#include "base/error.h"
#include "body/body_tree.h"
#include "world/body_bounds.h"
#include "world/find/cast_solid.h"
#include "world/state.h"
#include "world/tree/dynamic_tree_traverse.h"

#define WIDER 0x1p-50

typedef struct casting {
    const ovoid_world *w;
    ovoid_groups groups;
    vec3 origin, direction, grow; ///< of the centre of the ray or moving body; half the size of its box
    double length;
    const ovoid_ray *ray; ///< of a ray; NULL for a body
    ovoid_body body;      ///< the moving body
    double bound;
    ovoid_world_cast *out;
} casting;

// Cuts the range of times to those at which the centre is inside the enlarged slab; 0 if none is left.
static int enter_slab(double low, double high, double from, double displacement, double range[2]) {
    if (!(fabs(displacement) > 0)) return from >= low && from <= high;
    double a = (low - from) / displacement, b = (high - from) / displacement;
    double first = a < b ? a : b, last = a < b ? b : a;
    range[0] = max2(range[0], first - WIDER * fabs(first));
    range[1] = min2(range[1], last + WIDER * fabs(last));
    return range[0] <= range[1];
}

static double measure_entry(const void *context, const box *bounds) {
    const casting *c = context;
    double range[2] = {0, c->length};
    double slack = 4 * WIDER * (vec3_max_abs(bounds->min) + vec3_max_abs(bounds->max) + vec3_max_abs(c->grow));
    vec3 low = vec3_sub(bounds->min, c->grow), high = vec3_add(bounds->max, c->grow);
    int meets = enter_slab(low.x - slack, high.x + slack, c->origin.x, c->direction.x, range) &&
                enter_slab(low.y - slack, high.y + slack, c->origin.y, c->direction.y, range) &&
                enter_slab(low.z - slack, high.z + slack, c->origin.z, c->direction.z, range);
    return meets ? range[0] : INFINITY;
}

static void take_hit(casting *c, uint32_t body, const part_hit *hit) {
    ovoid_world_cast *out = c->out;
    if (hit->status == OVOID_IMPACT_FREE) return;
    out->lower = min2(out->lower, hit->lower);
    if (hit->status == OVOID_IMPACT_UNDECIDED) out->undecided++;
    if (hit->status != OVOID_IMPACT_HIT || !(hit->upper < out->upper)) return;
    out->body = body_get_id(c->w, body);
    out->part = hit->part;
    out->probe = hit->probe;
    out->upper = hit->upper;
    out->point = hit->point;
    out->normal = hit->normal;
    c->bound = hit->upper;
}

static int is_met(const casting *c, uint32_t i) {
    const world_body *b = &c->w->bodies[i];
    return groups_are_paired(&c->groups, &b->groups);
}

static void visit_ray(void *context, uint32_t i) {
    casting *c = context;
    body_tree tree;
    const ovoid_body *body = &c->w->bodies[i].body;
    if (!is_met(c, i)) return;
    if (body->solid) {
        part_hit hit = solid_cast_ray(body, c->ray);
        take_hit(c, i, &hit);
        return;
    }
    if (!body_tree_make(body, &tree)) return;
    for (uint32_t k = 0; k < tree.count; k++) {
        ovoid_posed_shape part = body_tree_get_leaf(&tree, k, NULL);
        ovoid_ray_hit ray_hit = ovoid_shape_cast_ray(&part, c->ray);
        part_hit hit = {body_tree_get_index(&tree, k),
                        0,
                        ray_hit.status,
                        ray_hit.lower,
                        ray_hit.upper,
                        ray_hit.point,
                        ray_hit.normal};
        take_hit(c, i, &hit);
    }
}

static void visit_body(void *context, uint32_t i) {
    casting *c = context;
    body_tree tree, probe;
    const ovoid_body *body = &c->w->bodies[i].body;
    if (!is_met(c, i)) return;
    if (body->solid || c->body.solid) {
        part_hit hit = solid_cast_body(body, &c->body, c->direction);
        take_hit(c, i, &hit);
        return;
    }
    if (!body_tree_make(body, &tree) || !body_tree_make(&c->body, &probe)) return;
    for (uint32_t k = 0; k < tree.count; k++) {
        for (uint32_t m = 0; m < probe.count; m++) {
            ovoid_posed_shape a = body_tree_get_leaf(&tree, k, NULL), b = body_tree_get_leaf(&probe, m, NULL);
            ovoid_pair pair = {a.shape, b.shape, a.pose, b.pose};
            ovoid_impact impact = ovoid_shape_cast(&pair, c->direction, 0, NULL);
            part_hit hit = {body_tree_get_index(&tree, k),
                            body_tree_get_index(&probe, m),
                            impact.status,
                            impact.free_until,
                            impact.hit_at,
                            impact.hit.point_a,
                            impact.hit.normal};
            take_hit(c, i, &hit);
        }
    }
}

static void run(casting *c, ovoid_groups groups, tree_visit *visit) {
    c->groups = groups_make(groups);
    c->bound = c->length;
    *c->out = (ovoid_world_cast){.lower = c->length, .upper = INFINITY};
    tree_traversal traversal = {&c->w->tree, measure_entry, visit, c, &c->bound};
    dynamic_tree_find_nearest(&traversal);
}

static int is_length(vec3 v) { return vec3_is_finite(v) && vec3_max_abs(v) <= OVOID_LENGTH_MAX; }

static ovoid_code cast_ray(const ovoid_world *w, const ovoid_world_ray *given, ovoid_world_cast *out,
                           ovoid_error *error) {
    OVOID_ASSERT(w && given && out);
    const ovoid_ray *r = &given->ray;
    if (!is_length(r->origin) || !is_length(r->direction) || !(vec3_max_abs(r->direction) > 0) || !(r->length >= 0) ||
        !(r->radius >= 0 && r->radius <= OVOID_LENGTH_MAX))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1,
                         "the ray is refused: NaN, too large, a direction of zero, or a negative length or radius");
    casting c = {.w = w,
                 .origin = r->origin,
                 .direction = r->direction,
                 .grow = {r->radius, r->radius, r->radius},
                 .length = r->length,
                 .ray = r,
                 .out = out};
    run(&c, given->groups, visit_ray);
    return OVOID_OK;
}

ovoid_code ovoid_world_cast_ray(const ovoid_world *w, const ovoid_world_ray *ray, ovoid_world_cast *cast,
                                ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, cast_ray(w, ray, cast, error));
}

static ovoid_code cast_body(const ovoid_world *w, const ovoid_world_sweep *sweep, ovoid_world_cast *out,
                            ovoid_error *error) {
    OVOID_ASSERT(w && sweep && out);
    const ovoid_world_body *probe = &sweep->probe;
    vec3 displacement = sweep->displacement;
    ovoid_code code = world_validate_body(&probe->body, -1, error);
    if (code != OVOID_OK) return code;
    if (!is_length(displacement))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the displacement is NaN, infinite or too large");
    body_sphere ball = body_compute_sphere(&probe->body);
    box bounds = body_compute_box(&probe->body, &ball);
    vec3 middle = vec3_scale(vec3_add(bounds.min, bounds.max), 0.5);
    casting c = {.w = w, .origin = middle, .direction = displacement, .length = 1, .body = probe->body, .out = out};
    c.grow = vec3_scale(vec3_sub(bounds.max, bounds.min), 0.5 * (1 + WIDER));
    double slack = 4 * WIDER * vec3_max_abs(middle);
    c.grow = vec3_add(c.grow, (vec3){slack, slack, slack});
    run(&c, probe->groups, visit_body);
    return OVOID_OK;
}

ovoid_code ovoid_world_cast_body(const ovoid_world *w, const ovoid_world_sweep *sweep, ovoid_world_cast *cast,
                                 ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, cast_body(w, sweep, cast, error));
}
