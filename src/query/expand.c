// The hull grows point by point: the faces that a new point sees are replaced by the cone from it to their horizon. The
// planes are rounded; what the surface is used for is proven elsewhere (cover.c).
#include "query/expand.h"

#include "query/simplex.h"

#include <string.h>

typedef expansion_face face;
enum { POINTS = EXPANSION_POINTS, FACES = EXPANSION_FACES, NONE = EXPANSION_NONE };

void expansion_clear(expansion *p, double slack) {
    p->points = p->faces = p->free_count = 0;
    p->slack = slack;
}

static void set_plane(expansion *p, face *f, vec3 fallback) {
    vec3 a = p->w[f->v[0]], b = p->w[f->v[1]], c = p->w[f->v[2]];
    vec3 e1 = vec3_sub(b, a), e2 = vec3_sub(c, a);
    // A face without area takes the direction of its neighbour: any direction gives true bounds.
    double area = vec3_norm_squared(vec3_cross(e1, e2)), edges = vec3_norm_squared(e1) * vec3_norm_squared(e2);
    f->n = area > 1e-26 * edges ? simplex_compute_normal(e1, e2) : fallback;
    f->low = fmin(vec3_dot(f->n, a), fmin(vec3_dot(f->n, b), vec3_dot(f->n, c)));
    f->alive = 1;
}

static uint16_t add_face(expansion *p) {
    if (p->free_count) return p->free[--p->free_count];
    return p->faces < FACES ? (uint16_t)p->faces++ : NONE;
}

uint16_t expansion_add_point(expansion *p, vec3 w, uint32_t a, uint32_t b) {
    p->w[p->points] = w;
    p->a[p->points] = a;
    p->b[p->points] = b;
    return (uint16_t)p->points++;
}

// The four faces of the first tetrahedron, outward.
void expansion_make_tetrahedron(expansion *p) {
    static const uint16_t corner[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    static const uint16_t across[4][3] = {{2, 3, 1}, {0, 3, 2}, {1, 3, 0}, {0, 2, 1}};
    vec3 e1 = vec3_sub(p->w[1], p->w[0]), e2 = vec3_sub(p->w[2], p->w[0]), e3 = vec3_sub(p->w[3], p->w[0]);
    if (vec3_dot(vec3_cross(e1, e2), e3) < 0) {
        vec3 w = p->w[1];
        uint32_t a = p->a[1], b = p->b[1];
        p->w[1] = p->w[2], p->a[1] = p->a[2], p->b[1] = p->b[2];
        p->w[2] = w, p->a[2] = a, p->b[2] = b;
    }
    p->faces = 4;
    for (int i = 0; i < 4; i++) {
        memcpy(p->f[i].v, corner[i], sizeof p->f[i].v);
        memcpy(p->f[i].next, across[i], sizeof p->f[i].next);
        set_plane(p, &p->f[i], (vec3){0, 0, 0});
    }
}

uint16_t expansion_find_nearest(const expansion *p) {
    uint16_t best = NONE;
    for (uint32_t i = 0; i < p->faces; i++)
        if (p->f[i].alive && (best == NONE || p->f[i].low < p->f[best].low)) best = (uint16_t)i;
    return best;
}

// The faces that the point sees, connected to the first; their number.
static uint32_t find_visible(expansion *p, uint16_t first, vec3 w) {
    uint32_t count = 0;
    p->visible[count++] = first;
    p->f[first].alive = 0;
    for (uint32_t i = 0; i < count; i++)
        for (int e = 0; e < 3; e++) {
            uint16_t g = p->f[p->visible[i]].next[e];
            face *f = &p->f[g];
            if (!f->alive || !(vec3_dot(f->n, w) - f->low > p->slack)) continue;
            f->alive = 0;
            p->visible[count++] = g;
        }
    return count;
}

// A new face on each edge of the horizon, joined to its neighbours. 0 if the horizon is not one simple loop or memory
// is used up; the surface is then spoilt.
static int close_horizon(expansion *p, uint32_t count, uint16_t apex) {
    uint16_t leaving[POINTS];
    memset(leaving, 0xff, sizeof leaving);
    uint16_t first = NONE;
    uint32_t made = 0;
    for (uint32_t i = 0; i < count; i++) {
        for (int e = 0; e < 3; e++) {
            const face *old = &p->f[p->visible[i]];
            uint16_t outer = old->next[e], from = old->v[e], to = old->v[(e + 1) % 3];
            if (!p->f[outer].alive) continue;
            uint16_t g = add_face(p);
            if (g == NONE || leaving[from] != NONE) return 0;
            face *f = &p->f[g];
            f->v[0] = from, f->v[1] = to, f->v[2] = apex;
            f->next[0] = outer, f->next[1] = f->next[2] = NONE;
            set_plane(p, f, p->f[outer].n);
            leaving[from] = g;
            for (int k = 0; k < 3; k++)
                if (p->f[outer].v[k] == to && p->f[outer].v[(k + 1) % 3] == from) p->f[outer].next[k] = g;
            first = g;
            made++;
        }
    }
    // Around the loop: each new face's edge (to, apex) meets the one that leaves `to`.
    uint16_t g = first;
    for (uint32_t i = 0; i < made; i++) {
        uint16_t follower = leaving[p->f[g].v[1]];
        if (follower == NONE) return 0;
        p->f[g].next[1] = follower;
        p->f[follower].next[2] = g;
        g = follower;
        if (g == first && i + 1 < made) return 0;
    }
    if (g != first) return 0;
    for (uint32_t i = 0; i < count; i++) p->free[p->free_count++] = p->visible[i];
    return made >= 3;
}

uint32_t expansion_pack(const expansion *p, uint16_t (*triangles)[3]) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->faces; i++)
        if (p->f[i].alive) memcpy(triangles[count++], p->f[i].v, sizeof p->f[i].v);
    return count;
}

int expansion_join(expansion *p, uint16_t first, uint16_t apex) {
    uint32_t count = find_visible(p, first, p->w[apex]);
    return close_horizon(p, count, apex);
}

// The point farthest from the first `have` points' hull (a point, a line, a plane); its distance.
static int find_farthest(const vec3 *w, int count, const vec3 *base, int have, double *far) {
    vec3 e1 = have > 1 ? vec3_sub(base[1], base[0]) : (vec3){0, 0, 0};
    vec3 e2 = have > 2 ? vec3_sub(base[2], base[0]) : (vec3){0, 0, 0};
    vec3 n = vec3_unit(vec3_cross(e1, e2)), u = vec3_unit(e1);
    int best = 0;
    *far = -1;
    for (int i = 0; i < count; i++) {
        vec3 d = vec3_sub(w[i], base[0]);
        if (have == 2) d = vec3_add_scaled(d, u, -vec3_dot(u, d));
        double distance = have == 3 ? fabs(vec3_dot(n, d)) : vec3_norm(d);
        if (distance > *far) *far = distance, best = i;
    }
    return best;
}

// The face that the point is farthest above, or none.
static uint16_t find_seen(const expansion *p, vec3 w) {
    uint16_t seen = NONE;
    double most = p->slack;
    for (uint32_t f = 0; f < p->faces; f++) {
        double above = vec3_dot(p->f[f].n, w) - p->f[f].low;
        if (p->f[f].alive && above > most) most = above, seen = (uint16_t)f;
    }
    return seen;
}

int expansion_make_hull(expansion *p, const vec3 *w, int count, double slack) {
    expansion_clear(p, slack);
    if (count < 4) return 0;
    // Four that span space.
    expansion_add_point(p, w[0], 0, 0);
    for (int have = 1; have < 4; have++) {
        double far;
        int i = find_farthest(w, count, p->w, have, &far);
        if (!(far > slack)) return 0;
        expansion_add_point(p, w[i], (uint32_t)i, 0);
    }
    expansion_make_tetrahedron(p);
    // Each other point that lies outside.
    for (int i = 0; i < count; i++) {
        uint16_t seen = find_seen(p, w[i]);
        if (seen == NONE) continue;
        if (p->points == POINTS || !expansion_join(p, seen, expansion_add_point(p, w[i], (uint32_t)i, 0))) return 0;
    }
    return 1;
}
