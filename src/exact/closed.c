// Placed pairs by the closed forms of linear/nearest.h.
//
// Of bodies whose cores overlap the radii alone prove the overlap. The normal is then that of the face which the core
// is the least behind; of a point in a box that is the depth, for which another proof is needed (exact/inside.h).
#include "exact/closed.h"

// The axes of the core of a shape, turned into the world's axes, and its middle, from the origin of the body frame;
// that of a sphere around that origin needs no turn.
static vec3 turn_core(const ovoid_shape *s, const mat3 *turn, vec3 *axis) {
    if (s->vertex_count == 8) {
        for (int i = 0; i < 3; i++) axis[i] = mat3_mul_vec3(*turn, s->box.axis[i]);
        return mat3_mul_vec3(*turn, s->box.center);
    }
    if (s->vertex_count == 2) axis[0] = mat3_mul_vec3(*turn, closed_get_half(s));
    return closed_is_origin(s) ? (vec3){0, 0, 0} : mat3_mul_vec3(*turn, closed_get_middle(s));
}

static uint32_t count_axes(const ovoid_shape *s) { return s->vertex_count == 8 ? 3 : s->vertex_count - 1; }

// The nearest points of a placed pair; A's from the origin of its body frame.
static void find_nearest_pair(const pair_frame *f, nearest_pair *found) {
    vec3 axes_a[3], axes_b[3];
    vec3 middle = turn_core(f->a, &f->world, axes_a), other = turn_core(f->b, &f->world_b, axes_b);
    const nearest_core a = {count_axes(f->a), axes_a}, b = {count_axes(f->b), axes_b};
    nearest_find(&a, &b, vec3_add(f->offset, vec3_sub(other, middle)), found);
    found->point_a = vec3_add(middle, found->point_a);
}

// ---- the points as pairs of vertices

// A parameter between its ends, as the weight of the end at 1, and the vertex bits that it sets.
typedef struct cut {
    double weight;
    unsigned bit;
} cut;

// Bits of A are 0 to 2, those of B 3 to 5.
static void add_cuts(const double *t, uint32_t count, unsigned first, cut *cuts, uint32_t *cut_count, unsigned *set) {
    for (uint32_t i = 0; i < count; i++) {
        double weight = 0.5 * (1 + t[i]);
        unsigned bit = 1u << (first + i);
        if (!(weight > 0)) continue;
        if (!(weight < 1)) {
            *set |= bit;
            continue;
        }
        uint32_t at = (*cut_count)++;
        for (; at > 0 && cuts[at - 1].weight < weight; at--) cuts[at] = cuts[at - 1];
        cuts[at] = (cut){weight, bit};
    }
}

static uint32_t get_vertex(const ovoid_shape *s, unsigned bits) {
    return s->vertex_count == 8 ? s->box.corner[bits & 7] : s->vertex_count == 2 ? bits & 1 : 0;
}

// The number of cuts.
static uint32_t count_cuts(const double *t, uint32_t count) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        double weight = 0.5 * (1 + t[i]);
        sum += (uint32_t)((weight > 0) & (weight < 1));
    }
    return sum;
}

// The two points as one convex combination of pairs of vertices: from the pair with the ends at -1 one parameter after
// another goes to its end at 1, the one of the largest weight first. There are at most three cuts.
static void write_points(const pair_frame *f, const nearest_pair *found, simplex *points) {
    cut cuts[6];
    uint32_t count = 0, axes_a = count_axes(f->a), axes_b = count_axes(f->b);
    unsigned bits = 0;
    if (axes_a > 0) add_cuts(found->a, axes_a, 0, cuts, &count, &bits);
    if (axes_b > 0) add_cuts(found->b, axes_b, 3, cuts, &count, &bits);
    points->count = (int)count + 1;
    double left = 1;
    for (uint32_t i = 0; i < 4; i++) {
        if (i > count) {
            points->p[i].a = points->p[i].b = 0;
            points->weight[i] = 0;
            continue;
        }
        double next = i < count ? cuts[i].weight : 0;
        points->p[i].a = get_vertex(f->a, bits);
        points->p[i].b = get_vertex(f->b, bits >> 3);
        points->weight[i] = left - next;
        if (i < count) bits |= cuts[i].bit;
        left = next;
    }
}

// ---- the answer

static closed_cores find_cores(const pair_frame *f, const nearest_pair *found, double distance) {
    vec3 a = vec3_add(f->world_origin, found->point_a);
    vec3 n = nearest_find_direction(found, distance, f->a->radius + f->b->radius);
    return (closed_cores){a, vec3_add(a, found->difference), n};
}

int closed_run(const placed_query *query, small_end *end) {
    const pair_frame *f = query->frame;
    nearest_pair found;
    if (!closed_is_moderate(f)) return 0;
    find_nearest_pair(f, &found);
    double distance = vec3_norm(found.difference);
    if (!closed_set_bounds(query, found.gap, distance, end)) return 0;
    // Points inside a box and inside a segment take more pairs than an answer holds.
    if (count_cuts(found.a, count_axes(f->a)) + count_cuts(found.b, count_axes(f->b)) > 3) return 0;
    if (!query->is_bare) write_points(f, &found, &end->points);
    end->normal = vec3_clear_signs(found.normal);
    end->inner = (vec3){0, 0, 0};
    closed_cores cores = find_cores(f, &found, distance);
    closed_set_witness(f, &cores, end);
    return 1;
}
