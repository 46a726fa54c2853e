// The hull grows point by point: the faces visible from a new point are replaced by the cone from it to their horizon.
// The planes are rounded; what rests on the surface is proven elsewhere (cover.c).
//
// A surface of few points is searched from end to end. One that was moved to the caller's memory has a tournament of
// its faces (D. E. Knuth, The Art of Computer Programming 3, 5.4.1) and a hash table of its points, so that a point is
// joined in a time that does not grow with their number.
#include "exact/expand.h"

#include "pair/simplex.h"
#include "tools/hash.h"

#include <string.h>

typedef expansion_face face;
enum { NONE = EXPANSION_NONE };

void expansion_clear(expansion *p, double slack) {
    p->points = p->faces = p->free_count = p->open_count = p->ring_count = 0;
    p->slack = slack;
    p->doubt = INFINITY;
    p->bound = INFINITY;
    memset(p->cone.edge, 0, sizeof p->cone.edge);
}

static void open_face(expansion *p, uint16_t g) {
    p->f[g].alive = 1;
    if (!p->leaves && p->f[g].low < p->bound) p->open[p->open_count++] = g;
}

// A sliver's normal is orthogonalised; a face without area takes its neighbour's normal: any direction gives true
// bounds.
static void set_plane(expansion *p, face *f, vec3 fallback) {
    vec3 a = p->w[f->v[0]], b = p->w[f->v[1]], c = p->w[f->v[2]];
    vec3 e1 = vec3_sub(b, a), e2 = vec3_sub(c, a);
    double l1 = vec3_norm_squared(e1), l2 = vec3_norm_squared(e2), area = vec3_norm_squared(vec3_cross(e1, e2));
    f->n = area > 1e-26 * (l1 * l2) ? simplex_compute_normal(e1, e2) : fallback;
    f->low = fmin(vec3_dot(f->n, a), fmin(vec3_dot(f->n, b), vec3_dot(f->n, c)));
    f->outward = area > 1e-4 * (l1 * l2) && f->low > 0 && area * f->low * f->low > p->doubt * (l1 + l2);
}

// The plane of a face from its lane of the kernel; that of a sliver is computed by set_plane.
static void take_lane(expansion *p, face *f, uint32_t i) {
    const simd_cone *c = &p->cone;
    double area = c->area[i], low = c->offset[i];
    if (!(area > 1e-4 * c->product[i] && area > SIMD_AREA_MIN)) {
        set_plane(p, f, p->f[f->twin[1]].n);
        return;
    }
    f->n = (vec3){c->n[0][i], c->n[1][i], c->n[2][i]};
    f->low = low;
    f->outward = low > 0 && area * low * low > p->doubt * c->sum[i];
}

// The planes of the ring of new faces.
static void set_ring(expansion *p, uint16_t apex) {
    simd_cone *c = &p->cone;
    vec3 w = p->w[apex];
    for (uint32_t first = 0; first < p->ring_count; first += SIMD_CONE) {
        uint32_t count = p->ring_count - first < SIMD_CONE ? p->ring_count - first : SIMD_CONE;
        for (uint32_t i = 0; i <= count; i++) {
            uint32_t at = first + i < p->ring_count ? first + i : 0;
            vec3 e = vec3_sub(p->w[p->f[p->ring[at]].v[1]], w);
            c->edge[0][i] = e.x, c->edge[1][i] = e.y, c->edge[2][i] = e.z;
        }
        simd_compute_cone(c, count, w);
        for (uint32_t i = 0; i < count; i++) {
            uint16_t g = p->ring[first + i];
            take_lane(p, &p->f[g], i);
            open_face(p, g);
        }
    }
}

static uint16_t add_face(expansion *p) {
    if (p->free_count) return p->free[--p->free_count];
    return p->faces < p->most_faces ? (uint16_t)p->faces++ : NONE;
}

// ---- the index of the points, and the tournament of the faces

typedef struct origin {
    uint32_t a, b;
} origin;

static int is_end(const void *table, size_t slot, const void *key) {
    const expansion *p = table;
    const origin *wanted = key;
    uint16_t i = p->index[slot];
    return i == NONE || (p->a[i] == wanted->a && p->b[i] == wanted->b);
}

static size_t find_slot(const expansion *p, uint32_t a, uint32_t b) {
    return hash_find(hash_pair(a, b), p->slots, p, &(origin){a, b}, is_end);
}

int expansion_has_point(const expansion *p, uint32_t a, uint32_t b) {
    if (p->leaves) return p->index[find_slot(p, a, b)] < p->points;
    for (uint32_t i = 0; i < p->points; i++)
        if (p->a[i] == a && p->b[i] == b) return 1;
    return 0;
}

static double get_key(const expansion *p, uint16_t g) { return g < p->faces && p->f[g].alive ? p->f[g].low : INFINITY; }

// The winner of a node's two children, of which those from `leaves` on are faces.
static uint16_t play(const expansion *p, uint32_t node) {
    uint16_t player[2];
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t child = 2 * node + i;
        player[i] = child < p->leaves ? p->winners[child] : (uint16_t)(child - p->leaves);
    }
    return player[get_key(p, player[1]) < get_key(p, player[0])];
}

// Plays a face's games again, up to the first one whose winner stays and is another face.
static void replay(expansion *p, uint16_t g) {
    for (uint32_t node = (p->leaves + g) / 2; node > 0; node /= 2) {
        uint16_t winner = play(p, node);
        if (winner == p->winners[node] && winner != g) return;
        p->winners[node] = winner;
    }
}

// The tournament anew, with room for twice the faces.
static void make_tournament(expansion *p) {
    p->leaves = 2 * p->faces < p->most_faces ? 2 * p->faces : p->most_faces;
    for (uint32_t node = p->leaves - 1; node > 0; node--) p->winners[node] = play(p, node);
}

// After a point was joined: the faces that it saw, the last ones to become free, and its own take part anew.
static void update_tournament(expansion *p, uint32_t seen) {
    if (p->faces > p->leaves) {
        make_tournament(p);
        return;
    }
    for (uint32_t i = 0; i < seen; i++) replay(p, p->free[p->free_count - 1 - i]);
    for (uint32_t i = 0; i < p->ring_count; i++) replay(p, p->ring[i]);
}

// The index anew, four slots or more for each point; two of each point that there is room for.
static void make_index(expansion *p) {
    for (p->slots = 1; p->slots < 4 * p->points && p->slots <= 2 * p->most_points;) p->slots *= 2;
    memset(p->index, 0xff, p->slots * sizeof *p->index);
    for (uint32_t i = 0; i < p->points; i++) p->index[find_slot(p, p->a[i], p->b[i])] = (uint16_t)i;
}

uint16_t expansion_add_point(expansion *p, vec3 w, uint32_t a, uint32_t b) {
    uint16_t i = (uint16_t)p->points++;
    p->w[i] = w;
    p->a[i] = a;
    p->b[i] = b;
    p->stamp[i] = 0;
    if (p->leaves && 2 * p->points > p->slots)
        make_index(p);
    else if (p->leaves)
        p->index[find_slot(p, a, b)] = i;
    return i;
}

// The four faces of the first tetrahedron, outward: a base, and a cone from point 3 over it.
void expansion_make_tetrahedron(expansion *p) {
    static const uint16_t corner[4][3] = {{0, 2, 1}, {3, 0, 1}, {3, 1, 2}, {3, 2, 0}};
    static const uint16_t across[4][3] = {{3, 2, 1}, {3, 0, 2}, {1, 0, 3}, {2, 0, 1}};
    vec3 e1 = vec3_sub(p->w[1], p->w[0]), e2 = vec3_sub(p->w[2], p->w[0]), e3 = vec3_sub(p->w[3], p->w[0]);
    if (vec3_dot(vec3_cross(e1, e2), e3) < 0) {
        vec3 w = p->w[1];
        uint32_t a = p->a[1], b = p->b[1];
        p->w[1] = p->w[2], p->a[1] = p->a[2], p->b[1] = p->b[2];
        p->w[2] = w, p->a[2] = a, p->b[2] = b;
    }
    p->faces = 4;
    for (uint16_t i = 0; i < 4; i++) {
        memcpy(p->f[i].v, corner[i], sizeof p->f[i].v);
        memcpy(p->f[i].twin, across[i], sizeof p->f[i].twin);
        if (i > 0) p->ring[i - 1] = i;
    }
    set_plane(p, &p->f[0], (vec3){0, 0, 0});
    open_face(p, 0);
    p->ring_count = 3;
    set_ring(p, 3);
}

// The faces' numbers: those in lanes, without the empty ones.
static uint32_t number_faces(const epa8 *from, uint8_t number[EPA8_FACES]) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < EPA8 * from->groups; i++)
        if (from->alive[i / 64] >> i % 64 & 1) number[i] = (uint8_t)count++;
    return count;
}

uint16_t expansion_take(expansion *p, const epa8 *from) {
    uint8_t number[EPA8_FACES];
    p->points = 0;
    p->faces = number_faces(from, number);
    for (uint32_t i = 0; i < from->points; i++)
        (void)expansion_add_point(p, (vec3){from->w[0][i], from->w[1][i], from->w[2][i]}, from->a[i], from->b[i]);
    for (uint32_t i = 0; i < EPA8 * from->groups; i++) {
        if (!(from->alive[i / 64] >> i % 64 & 1)) continue;
        face *f = &p->f[number[i]];
        const uint8_t *v = from->v[i];
        f->n = (vec3){from->n[0][i], from->n[1][i], from->n[2][i]};
        f->low = from->low[i];
        f->outward = !(from->inward[i / 64] >> i % 64 & 1);
        for (int e = 0; e < 3; e++) {
            f->v[e] = v[e];
            f->twin[e] = number[from->left[v[e == 2 ? 0 : e + 1]][v[e]]];
        }
        open_face(p, number[i]);
    }
    return number[from->nearest];
}

static uint16_t find_least(const expansion *p) {
    uint16_t best = NONE;
    for (uint32_t i = 0; i < p->faces; i++)
        if (p->f[i].alive && (best == NONE || p->f[i].low < p->f[best].low)) best = (uint16_t)i;
    return best;
}

// Without a tournament: searches the open faces and drops those that were replaced; if none is left, searches all
// faces.
uint16_t expansion_find_nearest(expansion *p) {
    if (p->leaves) return p->winners[1];
    uint32_t kept = 0;
    uint16_t best = NONE;
    double least = INFINITY;
    for (uint32_t i = 0; i < p->open_count; i++) {
        uint16_t g = p->open[i];
        const face *f = &p->f[g];
        if (!f->alive || f->low > p->bound) continue;
        p->open[kept++] = g;
        if (f->low < least) least = f->low, best = g;
    }
    p->open_count = kept;
    return best != NONE ? best : find_least(p);
}

// Sets the face across the edge of f that starts at a corner.
static void set_twin(face *f, uint16_t corner, uint16_t across) {
    f->twin[f->v[0] == corner ? 0 : f->v[1] == corner ? 1 : 2] = across;
}

// A new face on an edge of the horizon, joined to its outer neighbour. 0 if the horizon passes the edge's first corner
// a second time or memory is used up.
static int add_on_edge(expansion *p, const face *old, int e, uint16_t apex) {
    uint16_t g = add_face(p), from = old->v[e], outer = old->twin[e];
    if (g == NONE || p->stamp[from] == apex) return 0;
    face *f = &p->f[g];
    f->v[0] = apex, f->v[1] = from, f->v[2] = old->v[e == 2 ? 0 : e + 1];
    f->twin[1] = outer;
    set_twin(&p->f[outer], f->v[2], g);
    p->stamp[from] = apex;
    p->leaving[from] = g;
    p->ring[0] = g;
    p->ring_count++;
    return 1;
}

// Faces that were seen, the last one first, can be used again, the last one soonest.
static void free_faces(expansion *p, uint16_t *seen, uint32_t count) {
    for (uint32_t i = 0, k = count - 1; i < k; i++, k--) {
        uint16_t swapped = seen[i];
        seen[i] = seen[k];
        seen[k] = swapped;
    }
    memmove(p->free + p->free_count, seen, count * sizeof *seen);
    p->free_count += count;
}

// Replaces the faces that the point sees, connected to the first, by new faces on the edges of their horizon. The faces
// seen, the first at the end of *seen and the others below it: there is room, as no face is both free and seen.
static int replace_visible(expansion *p, uint16_t first, uint16_t apex, uint16_t **seen) {
    vec3 w = p->w[apex];
    uint16_t *end = *seen;
    *--*seen = first;
    p->f[first].alive = 0;
    p->ring_count = 0;
    for (uint16_t *at = end; at-- > *seen;) {
        const face *old = &p->f[*at];
        for (int e = 0; e < 3; e++) {
            uint16_t g = old->twin[e];
            face *f = &p->f[g];
            if (!f->alive) continue;
            if (vec3_dot(f->n, w) - f->low > p->slack) {
                f->alive = 0;
                *--*seen = g;
            } else if (!add_on_edge(p, old, e, apex)) {
                return 0;
            }
        }
    }
    return p->ring_count >= 3;
}

// The faces that were seen stand again, and those around them look at them again.
static void restore_faces(expansion *p, const uint16_t *seen, const uint16_t *end) {
    for (; seen < end; seen++) {
        face *f = &p->f[*seen];
        f->alive = 1;
        for (int e = 0; e < 3; e++) set_twin(&p->f[f->twin[e]], f->v[e == 2 ? 0 : e + 1], *seen);
    }
}

// Around the loop: each new face's edge (to, apex) meets the one that leaves `to`. 0 if it is not one simple loop.
static int close_ring(expansion *p, uint16_t apex) {
    uint16_t first = p->ring[0], g = first;
    for (uint32_t i = 0; i < p->ring_count; i++) {
        uint16_t to = p->f[g].v[2];
        if (p->stamp[to] != apex || (g == first && i > 0)) return 0;
        uint16_t follower = p->leaving[to];
        p->f[g].twin[2] = follower;
        p->f[follower].twin[0] = g;
        p->ring[i] = g;
        g = follower;
    }
    return g == first;
}

int expansion_join(expansion *p, uint16_t first, uint16_t apex) {
    uint32_t faces = p->faces, free_count = p->free_count;
    uint16_t *end = p->free + p->most_faces, *seen = end;
    if (!replace_visible(p, first, apex, &seen) || !close_ring(p, apex)) {
        restore_faces(p, seen, end);
        p->faces = faces;
        p->free_count = free_count;
        return 0;
    }
    free_faces(p, seen, (uint32_t)(end - seen));
    set_ring(p, apex);
    if (p->leaves) update_tournament(p, (uint32_t)(end - seen));
    return 1;
}

// ---- a room of any size

// The arrays of a room one after another, the widest items first.
static void carve(expansion *p, char *base, size_t points) {
    size_t faces = 2 * points, at = 0;
    p->most_points = (uint32_t)points;
    p->most_faces = (uint32_t)faces;
    p->w = (vec3 *)(void *)(base + at), at += points * sizeof *p->w;
    p->f = (face *)(void *)(base + at), at += faces * sizeof *p->f;
    p->a = (uint32_t *)(void *)(base + at), at += points * sizeof *p->a;
    p->b = (uint32_t *)(void *)(base + at), at += points * sizeof *p->b;
    p->leaving = (uint16_t *)(void *)(base + at), at += points * sizeof *p->leaving;
    p->stamp = (uint16_t *)(void *)(base + at), at += points * sizeof *p->stamp;
    // The lists that only growth needs take as much as the triangles that end it.
    p->triangles = (uint16_t(*)[3])(void *)(base + at);
    p->ring = (uint16_t *)(void *)(base + at), at += points * sizeof *p->ring;
    p->free = (uint16_t *)(void *)(base + at), at += faces * sizeof *p->free;
    p->winners = (uint16_t *)(void *)(base + at), at += faces * sizeof *p->winners;
    p->index = (uint16_t *)(void *)(base + at);
}

// Ring, free faces, tournament, and up to four slots of the index for each point.
size_t expansion_get_room_size(uint32_t points) {
    const size_t lists = (1 + 2 + 2 + 4) * (size_t)points;
    return points * (sizeof(vec3) + 2 * sizeof(uint32_t) + 2 * sizeof(uint16_t)) + 2 * points * sizeof(face) +
           lists * sizeof(uint16_t);
}

void expansion_move(expansion *p, void *room, uint32_t points) {
    const expansion from = *p;
    carve(p, room, points);
    memcpy(p->w, from.w, from.points * sizeof *p->w);
    memcpy(p->f, from.f, from.faces * sizeof *p->f);
    memcpy(p->a, from.a, from.points * sizeof *p->a);
    memcpy(p->b, from.b, from.points * sizeof *p->b);
    // The stamps of a point that was not joined are not kept.
    memset(p->stamp, 0, from.points * sizeof *p->stamp);
    memcpy(p->free, from.free, from.free_count * sizeof *p->free);
    p->open = NULL;
    make_tournament(p);
    make_index(p);
}

uint32_t expansion_pack(expansion *p) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->faces; i++)
        if (p->f[i].alive) memcpy(p->triangles[count++], p->f[i].v, sizeof p->f[i].v);
    return count;
}

// The point farthest from the span of the hull's points (a point, a line, a plane); its distance.
static int find_farthest(const expansion *p, const vec3 *w, int count, double *far) {
    const vec3 *base = p->w;
    uint32_t have = p->points;
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
    p->bound = -INFINITY;
    if (count < 4) return 0;
    // Four that span space.
    expansion_add_point(p, w[0], 0, 0);
    while (p->points < 4) {
        double far;
        int i = find_farthest(p, w, count, &far);
        if (!(far > slack)) return 0;
        expansion_add_point(p, w[i], (uint32_t)i, 0);
    }
    expansion_make_tetrahedron(p);
    // Each other point that lies outside is joined.
    for (int i = 0; i < count; i++) {
        uint16_t seen = find_seen(p, w[i]);
        if (seen == NONE) continue;
        if (p->points == p->most_points || !expansion_join(p, seen, expansion_add_point(p, w[i], (uint32_t)i, 0)))
            return 0;
    }
    return 1;
}
