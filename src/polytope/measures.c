// Measures by exact polyhedral formulas. The surface's triangles, with the mean vertex if the body is solid, span
// simplices whose measure, first and second moments are polynomials of their corners and add up. For a simplex of
// dimension d with corners v_i and s their sum, the first moment is measure / (d + 1) s and the second measure / ((d +
// 1) (d + 2)) (sum of v_i v_i' + s s'). Everything is computed in units of the body's size, a power of two, so that
// only results can underflow.
#include "base/environment.h"
#include "linear/both.h"
#include "linear/box.h"
#include "linear/mat3.h"
#include "ovoid/polytope.h"
#include "polytope/closed_form.h"
#include "polytope/polygon.h"
#include "polytope/sphere.h"

// Sums over simplices.
typedef struct moments {
    double measure; // volume, area or length
    double area;    // of the surface
    vec3 first;
    sym3 second;
} moments;

// Adds a simplex of that dimension; unused corners in v are zero.
static void add_simplex(moments *m, double measure, int dimension, const vec3 v[3]) {
    vec3 s = vec3_add(vec3_add(v[0], v[1]), v[2]);
    sym3 sum = sym3_outer(s, 1);
    for (int i = 0; i < 3; i++) sum = sym3_add(sum, sym3_outer(v[i], 1));
    m->measure += measure;
    m->first = vec3_add_scaled(m->first, s, measure / (dimension + 1));
    m->second = sym3_add(m->second, sym3_scale(sum, measure / ((dimension + 1) * (dimension + 2))));
}

// A frame for the computation: about the mean vertex, which is inside, so that no volumes cancel.
typedef struct frame {
    const ovoid_polytope *polytope;
    vec3 middle;
    double unit, inverse; // a power of two, and its inverse
} frame;

static vec3 compute_mean(const ovoid_polytope *p, vec3 near, double unit) {
    vec3 sum = {0, 0, 0};
    double inverse = 1 / unit;
    for (uint32_t i = 0; i < p->vertex_count; i++)
        sum = vec3_add(sum, vec3_scale(vec3_sub(vec3_at(p->vertices, i), near), inverse));
    return vec3_add(near, vec3_scale(sum, unit / p->vertex_count));
}

static vec3 get_corner(const frame *f, uint32_t v) {
    return vec3_scale(vec3_sub(vec3_at(f->polytope->vertices, v), f->middle), f->inverse);
}

// The triangles of a flat body, which has two sides.
static void add_triangles(moments *m, const frame *f) {
    const ovoid_polytope *p = f->polytope;
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        vec3 v[3];
        for (size_t i = 0; i < 3; i++) v[i] = get_corner(f, p->triangles[3 * (size_t)t + i]);
        double area = vec3_norm(vec3_cross(vec3_sub(v[1], v[0]), vec3_sub(v[2], v[0]))) / 2;
        m->area += 2 * area;
        add_simplex(m, area, 2, v);
    }
}

// The pyramids over the triangles of a solid, two at a time, with the operations of add_simplex. They are added one
// after the other.
static void add_pyramids(moments *m, const frame *f) {
    const ovoid_polytope *p = f->polytope;
    for (uint32_t t = 0; t < p->triangle_count; t += 2) {
        const uint32_t *one = p->triangles + 3 * (size_t)t, *two = t + 1 < p->triangle_count ? one + 3 : one;
        both_vec3 v[3];
        for (int i = 0; i < 3; i++) v[i] = both_vec3_make(get_corner(f, one[i]), get_corner(f, two[i]));
        both_vec3 area = both_vec3_cross(both_vec3_sub(v[1], v[0]), both_vec3_sub(v[2], v[0]));
        both square = both_vec3_dot(area, area),
             volume = both_vec3_dot(v[0], both_vec3_cross(v[1], v[2])) / both_set(6);
        both_vec3 s = {v[0].x + v[1].x + v[2].x, v[0].y + v[1].y + v[2].y, v[0].z + v[1].z + v[2].z};
        both xx = s.x * s.x, xy = s.x * s.y, xz = s.x * s.z, yy = s.y * s.y, yz = s.y * s.z, zz = s.z * s.z;
        for (int i = 0; i < 3; i++) {
            xx += v[i].x * v[i].x, xy += v[i].x * v[i].y, xz += v[i].x * v[i].z;
            yy += v[i].y * v[i].y, yz += v[i].y * v[i].z, zz += v[i].z * v[i].z;
        }
        both quarter = volume / both_set(4), part = volume / both_set(20);
        s = (both_vec3){s.x * quarter, s.y * quarter, s.z * quarter};
        xx *= part, xy *= part, xz *= part, yy *= part, yz *= part, zz *= part;
        for (uint32_t k = 0; k < 2 && t + k < p->triangle_count; k++) {
            m->area += sqrt(square[k]) / 2;
            m->measure += volume[k];
            m->first = vec3_add(m->first, both_vec3_get(s, (int)k));
            m->second = sym3_add(m->second, (sym3){xx[k], xy[k], xz[k], yy[k], yz[k], zz[k]});
        }
    }
}

static void add_segment(moments *m, const frame *f) {
    const ovoid_polytope *p = f->polytope;
    uint32_t end[2];
    polytope_get_ends(p, end);
    vec3 v[3] = {get_corner(f, end[0]), get_corner(f, end[1]), {0, 0, 0}};
    add_simplex(m, vec3_norm(vec3_sub(v[1], v[0])), 1, v);
}

static ovoid_measures compute_measures(const ovoid_polytope *polytope) {
    closed_form form = {.kind = FORM_NONE};
    if (polytope->rank == 3) form = closed_form_find(polytope->vertices, polytope->vertex_count);
    if (form.kind != FORM_NONE) return closed_form_compute_measures(&form, polytope);
    ovoid_measures result = {.box = box_make_around(polytope->vertices, polytope->vertex_count)};
    sphere s = sphere_compute_smallest(polytope->vertices, polytope->vertex_count);
    result.sphere_center = s.center;
    result.sphere_radius = s.radius;

    double unit = ldexp(1, find_unit_exponent(vec3_max_abs(vec3_sub(result.box.max, result.box.min))));
    frame f = {polytope, compute_mean(polytope, s.center, unit), unit, 1 / unit};
    moments m = {0};
    if (polytope->rank == 3) add_pyramids(&m, &f);
    if (polytope->rank == 2) add_triangles(&m, &f);
    if (polytope->rank == 1) add_segment(&m, &f);

    int dimension = (int)polytope->rank;
    vec3 mean = m.measure > 0 ? vec3_scale(m.first, 1 / m.measure) : (vec3){0, 0, 0};
    sym3 spread = sym3_add(m.second, sym3_outer(mean, -m.measure));
    double trace = sym3_trace(spread);
    sym3 inertia = sym3_add(sym3_diagonal(trace, trace, trace), sym3_scale(spread, -1));
    for (int i = 0; i < dimension + 2; i++) inertia = sym3_scale(inertia, unit);
    result.inertia = inertia;
    result.centroid = vec3_add(f.middle, vec3_scale(mean, unit));
    result.volume = dimension == 3 ? m.measure * unit * unit * unit : 0;
    result.area = m.area * unit * unit;
    return result;
}

ovoid_measures ovoid_polytope_compute_measures(const ovoid_polytope *polytope) {
    ENVIRONMENT_RETURN(ovoid_measures, polytope, compute_measures(polytope));
}
