// Claims that rest on the inner ellipsoids. Theorem. Let a closed surface S of triangles over vertices of C wind around
// c, and let E be an ellipsoid with centre c whose interior does not meet S. Then E lies in C: the winding number is
// nonzero on the connected interior of E, and it is zero outside of C. A triangle does not meet the interior of E if
// its plane does not, or if the quadratic form of E is at least 1 at its least point of the triangle. All of this is
// exact, and done once a shape.
//
// A point of E with m = (x - c)' Q^-1 (x - c) < 1 has the ball of radius (1 - sqrt m) r around it in E, r the least
// radius. With Q^-1 = adj Q / det Q nothing is divided.
#include "parts.h"
#include "shell.h"
#include "tools/hash.h"

#include <math.h>
#include <stdlib.h>

// Bits of the roots that approximate irrational numbers from the safe side.
#define ROOT_BITS 96

// A symmetric matrix, exactly: rows (a, b, c), (b, d, e), (c, e, f).
typedef struct symmetric {
    num a, b, c, d, e, f;
} symmetric;

static symmetric symmetric_from(pool *p, ovoid_sym3 q) {
    return (symmetric){number_from(p, q.xx), number_from(p, q.xy), number_from(p, q.xz),
                       number_from(p, q.yy), number_from(p, q.yz), number_from(p, q.zz)};
}

static num minor2(pool *p, num a, num b, num c, num d) { return num_sub(p, num_mul(p, a, d), num_mul(p, b, c)); }

static symmetric compute_adjugate(pool *p, symmetric q) {
    return (symmetric){minor2(p, q.d, q.e, q.e, q.f), minor2(p, q.c, q.b, q.f, q.e), minor2(p, q.b, q.c, q.d, q.e),
                       minor2(p, q.a, q.c, q.c, q.f), minor2(p, q.b, q.a, q.e, q.c), minor2(p, q.a, q.b, q.b, q.d)};
}

static nvec symmetric_apply(pool *p, symmetric q, nvec v) {
    return (nvec){nvec_dot(p, (nvec){q.a, q.b, q.c}, v), nvec_dot(p, (nvec){q.b, q.d, q.e}, v),
                  nvec_dot(p, (nvec){q.c, q.e, q.f}, v)};
}

static num compute_det(pool *p, symmetric q, symmetric adjugate) {
    return nvec_dot(p, (nvec){q.a, q.b, q.c}, (nvec){adjugate.a, adjugate.b, adjugate.c});
}

// By the leading minors (J. J. Sylvester, 1852).
static int is_positive_definite(pool *p, symmetric q) {
    size_t mark = pool_get_mark(p);
    int yes = num_sign(q.a) > 0 && num_sign(minor2(p, q.a, q.b, q.b, q.d)) > 0 &&
              num_sign(compute_det(p, q, compute_adjugate(p, q))) > 0;
    pool_release(p, mark);
    return yes;
}

// --- the ellipsoid inside its polyhedron

typedef struct inner {
    symmetric q, adjugate;
    num det;
} inner;

static inner inner_make(pool *p, const ovoid_shape *shape) {
    inner e = {.q = symmetric_from(p, ovoid_shape_get_inner(shape).ellipsoid.q)};
    e.adjugate = compute_adjugate(p, e.q);
    e.det = compute_det(p, e.q, e.adjugate);
    return e;
}

// u' adj v: the form of the ellipsoid times det Q.
static num inner_form(pool *p, const inner *e, nvec u, nvec v) {
    return nvec_dot(p, u, symmetric_apply(p, e->adjugate, v));
}

// 1 if the form is at least 1 everywhere on the segment, as seen from the centre.
static int segment_is_outside(pool *p, const inner *e, nvec a, nvec b) {
    nvec along = nvec_sub(p, b, a);
    num aa = inner_form(p, e, a, a), t = num_neg(p, inner_form(p, e, a, along)),
        length = inner_form(p, e, along, along);
    if (num_sign(t) <= 0) return num_compare(p, aa, e->det) >= 0;
    if (num_compare(p, t, length) >= 0) return num_compare(p, inner_form(p, e, b, b), e->det) >= 0;
    // At its least point the form is aa - t^2 / length.
    return num_compare(p, num_sub(p, num_mul(p, aa, length), num_mul(p, t, t)), num_mul(p, e->det, length)) >= 0;
}

// 1 if the point of the triangle's plane, of normal n, where the form is least lies in the triangle. It is the multiple
// offset / (n' Q n) of Q n, and a . n = det(a, b, c) = offset, so the offset's sign cancels.
static int is_least_point_inside(pool *p, const inner *e, nvec n, nvec a, nvec b, nvec c) {
    nvec along = symmetric_apply(p, e->q, n);
    return num_sign(nvec_det(p, along, a, b)) >= 0 && num_sign(nvec_det(p, along, b, c)) >= 0 &&
           num_sign(nvec_det(p, along, c, a)) >= 0;
}

static int triangle_is_outside(pool *p, const inner *e, nvec a, nvec b, nvec c) {
    size_t mark = pool_get_mark(p);
    nvec n = nvec_cross(p, nvec_sub(p, b, a), nvec_sub(p, c, a));
    num offset = nvec_dot(p, n, a), spread = nvec_dot(p, n, symmetric_apply(p, e->q, n));
    // The plane does not meet the interior: offset^2 >= n' Q n.
    int outside = !nvec_is_zero(n) && num_compare(p, num_mul(p, offset, offset), spread) >= 0;
    if (!outside)
        outside = (nvec_is_zero(n) || !is_least_point_inside(p, e, n, a, b, c)) && segment_is_outside(p, e, a, b) &&
                  segment_is_outside(p, e, b, c) && segment_is_outside(p, e, c, a);
    pool_release(p, mark);
    return outside;
}

// The polyhedron's triangles around the ellipsoid's centre; points to free.
static shell shell_create(pool *p, const ovoid_polytope *polytope, ovoid_vec3 center, nvec **points) {
    uint32_t count = polytope->vertex_count;
    nvec c = nvec_from(p, center);
    *points = judge_allocate(count, sizeof **points);
    for (uint32_t i = 0; i < count; i++) {
        const double *v = polytope->vertices + 3 * (size_t)i;
        nvec_slot kept = nvec_slot_make(p);
        size_t mark = pool_get_mark(p);
        (*points)[i] = nvec_slot_set(kept, nvec_sub(p, nvec_from(p, (ovoid_vec3){v[0], v[1], v[2]}), c));
        pool_release(p, mark);
    }
    return (shell){*points, polytope->triangles, count, polytope->triangle_count};
}

static int is_inside_polyhedron(pool *p, const body *b, const inner *e) {
    nvec *points;
    shell s = shell_create(p, &b->polytope, ovoid_shape_get_inner(b->shape).ellipsoid.center, &points);
    int inside = shell_is_closed(&s) && shell_is_winding(p, &s);
    for (uint32_t t = 0; t < s.triangle_count && inside; t++) {
        const uint32_t *v = s.triangles + 3 * (size_t)t;
        inside = triangle_is_outside(p, e, points[v[0]], points[v[1]], points[v[2]]);
    }
    free(points);
    return inside;
}

// A lower bound of the least eigenvalue of positive definite Q, good to about 2^-60: the largest t, bit by bit, for
// which Q - t I is still positive definite.
static num find_least_eigenvalue(pool *p, symmetric q) {
    num least = num_compare(p, q.a, q.d) < 0 ? q.a : q.d;
    if (num_compare(p, q.f, least) < 0) least = q.f;
    slot t = slot_make(p);
    long top_bit = (long)ilogb(num_to_double(least)) + 1;
    int digits = 0;
    // The first bit is at most the least diagonal entry; Q is positive definite, so one is found in the end.
    for (long bit = top_bit; digits < 60; bit--) {
        size_t mark = pool_get_mark(p);
        num trial = num_add(p, t, num_scaled(p, number_from_integer(p, 1), bit));
        symmetric shifted = q;
        shifted.a = num_sub(p, q.a, trial);
        shifted.d = num_sub(p, q.d, trial);
        shifted.f = num_sub(p, q.f, trial);
        int holds = is_positive_definite(p, shifted);
        if (holds) slot_set(t, trial);
        if (holds || digits) digits++;
        pool_release(p, mark);
    }
    return t;
}

// --- facts by shape

static void compute_facts(pool *p, const body *b, facts *f) {
    size_t mark = pool_get_mark(p);
    inner e = inner_make(p, b->shape);
    mpz_init(f->radius.m);
    f->radius.e = 0;
    f->shape = b->shape;
    f->is_inside = b->polytope.rank == 3 && is_positive_definite(p, e.q) && is_inside_polyhedron(p, b, &e);
    if (f->is_inside) slot_set(&f->radius, num_root_below(p, find_least_eigenvalue(p, e.q), ROOT_BITS));
    pool_release(p, mark);
}

static int is_end(const void *table, size_t at, const void *key) {
    const ovoid_shape *shape = ((const facts *)table)[at].shape;
    return !shape || shape == key;
}

static size_t find_slot(const facts *table, size_t capacity, const ovoid_shape *shape) {
    return hash_find(hash_number((uintptr_t)shape >> 6), capacity, table, shape, is_end);
}

static void grow_table(judge *j) {
    size_t capacity = j->capacity ? 2 * j->capacity : 64;
    facts *table = judge_allocate(capacity, sizeof *table);
    for (size_t i = 0; i < j->capacity; i++)
        if (j->table[i].shape) table[find_slot(table, capacity, j->table[i].shape)] = j->table[i];
    free(j->table);
    j->table = table;
    j->capacity = capacity;
}

const facts *judge_get_facts(judge *context, const body *b) {
    if (2 * context->count >= context->capacity) grow_table(context);
    facts *f = &context->table[find_slot(context->table, context->capacity, b->shape)];
    if (!f->shape) {
        compute_facts(context->p, b, f);
        context->count++;
    }
    return f;
}

// --- points of inner ellipsoids

nvec inner_point_a(const claim *c) { return body_point(c->s->p, &c->s->a, nvec_from(c->s->p, c->proof->inner_a)); }

nvec inner_point_b(const claim *c) { return body_point(c->s->p, &c->s->b, nvec_from(c->s->p, c->proof->inner_b)); }

// m = form / whole of a point, and a lower bound of the ellipsoid's least radius.
typedef struct depth_in {
    num form, whole, radius;
} depth_in;

// For the point `local` / `factor` in the body frame. The radius is left NULL.
static depth_in compute_depth_in(pool *p, const body *b, nvec local, num factor) {
    inner e = inner_make(p, b->shape);
    nvec center = nvec_from(p, ovoid_shape_get_inner(b->shape).ellipsoid.center);
    nvec y = nvec_sub(p, local, nvec_scale(p, center, factor));
    return (depth_in){inner_form(p, &e, y, y), num_mul(p, e.det, num_mul(p, factor, factor)), NULL};
}

// k times the body-frame point of B that is the world point x / n_a.
static nvec local_in_b(const posed *s, nvec xa) {
    pool *p = s->p;
    nvec from_b = nvec_sub(p, xa, nvec_scale(p, s->b.position, s->a.n));
    return nvec_sub(p, body_rotate_back(p, &s->b, from_b), nvec_scale(p, s->b.origin, s->k));
}

// The depth claimed by a common point: core >= -((1 - sqrt ma) ra + (1 - sqrt mb) rb), with the roots rounded up and
// the radii rounded down. whole > 0.
static int is_depth_proven(const claim *c, depth_in a, depth_in b) {
    pool *p = c->s->p;
    // (1 - sqrt(form / whole)) whole = whole - sqrt(form whole)
    num left_a = num_sub(p, a.whole, num_root_above(p, num_mul(p, a.form, a.whole), ROOT_BITS));
    num left_b = num_sub(p, b.whole, num_root_above(p, num_mul(p, b.form, b.whole), ROOT_BITS));
    num balls = num_add(p, num_mul(p, num_mul(p, left_a, a.radius), b.whole),
                        num_mul(p, num_mul(p, left_b, b.radius), a.whole));
    return num_sign(num_add(p, num_mul(p, c->core, num_mul(p, a.whole, b.whole)), balls)) >= 0;
}

static ovoid_code verify_common_point(const claim *c, const facts *a, const facts *b) {
    const posed *s = c->s;
    pool *p = s->p;
    nvec local_a = nvec_from(p, c->proof->inner_a);
    depth_in in_a = compute_depth_in(p, &s->a, local_a, number_from_integer(p, 1));
    depth_in in_b = compute_depth_in(p, &s->b, local_in_b(s, inner_point_a(c)), s->k);
    if (num_compare(p, in_a.form, in_a.whole) >= 0 || num_compare(p, in_b.form, in_b.whole) >= 0)
        return judge_reject(c->error, OVOID_ERROR_PROOF,
                            "the common point is not strictly inside both inner ellipsoids");
    in_a.radius = &a->radius;
    in_b.radius = &b->radius;
    if (!is_depth_proven(c, in_a, in_b))
        return judge_reject(c->error, OVOID_ERROR_PROOF, "upper is deeper than the inner ellipsoids' balls show");
    return OVOID_OK;
}

static ovoid_code verify_two_points(const claim *c) {
    const posed *s = c->s;
    pool *p = s->p;
    num one = number_from_integer(p, 1);
    depth_in in_a = compute_depth_in(p, &s->a, nvec_from(p, c->proof->inner_a), one);
    depth_in in_b = compute_depth_in(p, &s->b, nvec_from(p, c->proof->inner_b), one);
    if (num_compare(p, in_a.form, in_a.whole) > 0 || num_compare(p, in_b.form, in_b.whole) > 0)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "a point of the proof is outside of its inner ellipsoid");
    return OVOID_OK;
}

ovoid_code judge_verify_inner(const claim *c) {
    int common = c->proof->kind == OVOID_PROOF_INNER;
    if (!is_finite(c->proof->inner_a) || (!common && !is_finite(c->proof->inner_b)))
        return judge_reject(c->error, OVOID_ERROR_NOT_FINITE, "a point of the proof is not finite");
    // Copies, since the second call may move the table. A triangle of a solid has no inner ellipsoid.
    if (!c->s->a.shape || !c->s->b.shape)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "a triangle has no inner ellipsoid");
    const facts a = *judge_get_facts(c->context, &c->s->a), b = *judge_get_facts(c->context, &c->s->b);
    if (!a.is_inside || !b.is_inside)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "the inner ellipsoid of %s is not inside its polyhedron",
                            a.is_inside ? "B" : "A");
    return common ? verify_common_point(c, &a, &b) : verify_two_points(c);
}
