// The polygon in which two patches overlap. Neither is the reference: its corners are those of each patch that are
// inside of the other, and the crossings of their edges. So it is the same polygon whichever body comes first, and each
// corner has a name that does not depend on how it was found.
//
// Two edges cross where the ends of each are on different sides of the other: with a bit for each corner outside of a
// side, edges that change sides are found by one shift.
#include "manifold/manifold.h"

#include <string.h>

// A polygon that grows: kept corners come first, the others wait.
typedef struct clipper {
    manifold_state *state;
    const clip_rules *rules;
    manifold_polygon *out;
    uint32_t kept, waiting;
    double steep;
    manifold_corner others[2 * OVOID_MANIFOLD_CORNERS];
} clipper;

static int is_kept(const clip_rules *r, uint32_t id) {
    int found = 0;
    for (uint32_t i = 0; i < r->kept_count; i++) found |= r->kept[i] == id;
    return found;
}

// A corner that is nearer to one that is there than four times the snap is that corner; near a kept one the distance is
// that by which it may be outside.
static int is_there(const clipper *c, double x, double y) {
    double snap = 4 * c->rules->snap, keep = max2(c->rules->keep, snap);
    for (uint32_t i = 0; i < c->out->count; i++) {
        const manifold_corner *k = c->out->corners + i;
        double dx = k->x - x, dy = k->y - y, near = i < c->kept ? keep : snap;
        if (dx * dx + dy * dy < near * near) return 1;
    }
    return 0;
}

static void append(clipper *c, const manifold_corner *corner) {
    if (c->out->count == OVOID_MANIFOLD_CORNERS || is_there(c, corner->x, corner->y)) return;
    if (corner->separation <= c->rules->most) c->out->corners[c->out->count++] = *corner;
}

static void add(clipper *c, const manifold_corner *corner, int is_kept) {
    if (is_kept || !c->rules->kept_count)
        append(c, corner);
    else
        c->others[c->waiting++] = *corner;
}

// The least distance that a corner shows, whether it becomes one of the polygon or not: it does not depend on what was
// kept.
static void note(clipper *c, const manifold_corner *corner) {
    c->out->least = min2(c->out->least, fabs(corner->separation) + 2 * corner->outside * c->steep);
}

// ---- corners ----

// One patch's corners to the other patch.
typedef struct corner_side {
    const manifold_patch *own, *other;
    const patch_table *table; ///< of own's corners to other's sides
    uint32_t kind;            ///< of the ids
} corner_side;

// Returns how many corners are inside; kept ones have more room.
static uint32_t add_corners(clipper *c, const corner_side *s) {
    uint32_t inside = 0;
    for (uint32_t i = 0; i < s->own->count; i++) {
        double x = s->own->x[i], y = s->own->y[i], out = -s->table->least[i];
        uint32_t id = s->kind | s->own->vertices[i];
        int is_old = is_kept(c->rules, id);
        double room = is_old ? max2(c->rules->keep, c->rules->snap) : c->rules->snap;
        if (out > room) continue;
        double outside = out > 0 || s->other->count < 3 ? patch_measure_distance(s->other, x, y) : 0;
        if (outside > room) continue;
        double height = patch_get_height(s->other, x, y);
        double separation = s->kind == OVOID_MANIFOLD_ID_VERTEX_A ? height - s->own->z[i] : s->own->z[i] - height;
        const manifold_corner corner = {x, y, separation, outside, id};
        inside += outside <= c->rules->snap;
        if (outside <= c->rules->snap) note(c, &corner);
        add(c, &corner, is_old);
    }
    return inside;
}

// ---- crossings ----

// Where side i of A and the edge from corner j of B meet, if its ends are on different sides. Returns how far the
// farther end is from the side.
static double place_crossing(const manifold_patch *a, const manifold_patch *b, edge_crossing *c) {
    uint32_t i = c->i, j = c->j;
    double p = patch_get_side(a, i, b->x[j], b->y[j]), q = patch_get_side(a, i, b->x[j + 1], b->y[j + 1]);
    double t = p / (p - q);
    c->x = b->x[j] + t * (b->x[j + 1] - b->x[j]);
    c->y = b->y[j] + t * (b->y[j + 1] - b->y[j]);
    return max2(fabs(p), fabs(q));
}

static int is_outside(const manifold_patch *p, uint32_t side, const manifold_patch *other, uint32_t corner) {
    return patch_get_side(p, side, other->x[corner], other->y[corner]) < 0;
}

int patches_cross(const manifold_patch *a, const manifold_patch *b, edge_crossing *c) {
    if (is_outside(a, c->i, b, c->j) == is_outside(a, c->i, b, c->j + 1)) return 0;
    if (is_outside(b, c->j, a, c->i) == is_outside(b, c->j, a, c->i + 1)) return 0;
    (void)place_crossing(a, b, c);
    return 1;
}

uint32_t crossing_make_id(const manifold_patch *a, const manifold_patch *b, const edge_crossing *c) {
    return OVOID_MANIFOLD_ID_CROSSING | (a->edges[c->i] & 0x7fff) << 15 | (b->edges[c->j] & 0x7fff);
}

// Of the bits of a side: 1 at each edge of the other patch whose ends are on different sides.
static uint64_t find_changes(uint64_t outside, uint32_t count) {
    uint64_t next = outside >> 1 | (outside & 1) << (count - 1);
    uint64_t edges = count > 2 ? ~UINT64_C(0) >> (64 - count) : count - 1;
    return (outside ^ next) & edges;
}

static void add_crossings(clipper *c) {
    const manifold_state *s = c->state;
    const manifold_patch *a = &s->a, *b = &s->b;
    uint64_t of_b[PATCH_CORNERS];
    uint32_t count_a = patch_get_edge_count(a), count_b = patch_get_edge_count(b);
    for (uint32_t j = 0; j < count_b; j++) of_b[j] = find_changes(s->to_b.outside[j], a->count);
    edge_crossing x;
    for (x.i = 0; x.i < count_a; x.i++)
        for (uint64_t changes = find_changes(s->to_a.outside[x.i], b->count); changes; changes &= changes - 1) {
            x.j = (uint32_t)__builtin_ctzll(changes);
            if (!(of_b[x.j] >> x.i & 1)) continue;
            // Edges that lie on one another cross by rounding alone.
            if (place_crossing(a, b, &x) <= c->rules->snap) continue;
            double separation = patch_get_height(b, x.x, x.y) - patch_get_height(a, x.x, x.y);
            const manifold_corner corner = {x.x, x.y, separation, 0, crossing_make_id(a, b, &x)};
            note(c, &corner);
            add(c, &corner, is_kept(c->rules, corner.id));
        }
}

// ---- the polygon ----

// A number that grows with the angle of a direction, from -2 to 2.
static double get_turn(double x, double y) {
    double sum = fabs(x) + fabs(y), part = sum > 0 ? x / sum : 1;
    return y < 0 ? part - 1 : 1 - part;
}

// The corners around their mean. Equal turns keep their order.
static void sort(manifold_polygon *p) {
    double x = 0, y = 0, turn[OVOID_MANIFOLD_CORNERS];
    uint32_t order[OVOID_MANIFOLD_CORNERS], count = p->count;
    for (uint32_t i = 0; i < count; i++) x += p->corners[i].x, y += p->corners[i].y;
    double scale = 1 / (double)count;
    x *= scale;
    y *= scale;
    int is_sorted = 1;
    for (uint32_t i = 0; i < count; i++) {
        double key = get_turn(p->corners[i].x - x, p->corners[i].y - y);
        uint32_t k = i;
        for (; k > 0 && turn[k - 1] > key; k--) turn[k] = turn[k - 1], order[k] = order[k - 1];
        turn[k] = key;
        order[k] = i;
        is_sorted &= k == i;
    }
    if (is_sorted) return;
    manifold_corner sorted[OVOID_MANIFOLD_CORNERS];
    for (uint32_t i = 0; i < count; i++) sorted[i] = p->corners[order[i]];
    memcpy(p->corners, sorted, count * sizeof *sorted);
}

static double compute_area(const manifold_polygon *p) {
    double sum = 0;
    const manifold_corner *c = p->corners;
    for (uint32_t i = 1; i + 1 < p->count; i++)
        sum += (c[i].x - c->x) * (c[i + 1].y - c->y) - (c[i].y - c->y) * (c[i + 1].x - c->x);
    return max2(sum, 0) / 2;
}

void patches_clip(manifold_state *s, const clip_rules *rules) {
    clipper c;
    c.state = s;
    c.rules = rules;
    c.out = &s->polygon;
    c.kept = c.waiting = 0;
    c.steep = max2(s->a.steepness, s->b.steepness);
    patch_table_fill(&s->a, &s->b, &s->to_a);
    patch_table_fill(&s->b, &s->a, &s->to_b);
    corner_side a = {&s->a, &s->b, &s->to_b, OVOID_MANIFOLD_ID_VERTEX_A};
    corner_side b = {&s->b, &s->a, &s->to_a, OVOID_MANIFOLD_ID_VERTEX_B};
    c.out->count = 0;
    c.out->least = INFINITY;
    uint32_t inside_a = add_corners(&c, &a), inside_b = add_corners(&c, &b);
    int is_whole = inside_a == s->a.count || inside_b == s->b.count;
    if (!is_whole) add_crossings(&c);
    c.kept = rules->kept_count ? c.out->count : 0;
    for (uint32_t i = 0; i < c.waiting; i++) append(&c, c.others + i);
    // The corners of one patch alone are in order.
    int is_alone = is_whole && !c.kept && (c.out->count == inside_a || c.out->count == inside_b) &&
                   (inside_a == 0 || inside_b == 0);
    if (c.out->count > 2 && !is_alone) sort(c.out);
    c.out->area = c.out->count > 4 ? compute_area(c.out) : 0;
}
