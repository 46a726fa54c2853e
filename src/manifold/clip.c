// The polygon in which two patches overlap. Neither is the reference: its corners are those of each patch that are
// inside of the other, and the crossings of their edges. So it is the same polygon whichever body comes first, and each
// corner has a name that does not depend on how it was found.
//
// Two edges cross where the ends of each are on different sides of the other: with a bit for each corner outside of a
// side, edges that change sides are found by one shift.
//
// Around the polygon, from each crossing on, one of both patches is inside of the other up to the next crossing. So the
// corners of a patch between the edges of both crossings follow, in its order, and nothing is sorted. Where edges lie
// on one another and do not cross, or corners outside are kept, corners of both patches may lie between two crossings:
// then the lists of both, which are in order, are merged by their angle. Corners that are one are neighbors then.
#include "manifold/manifold.h"

#include <string.h>

// A corner's place says what it is: one of A, one of B, a crossing.
enum { PLACE_B = PATCH_CORNERS, PLACE_CROSSING = 2 * PATCH_CORNERS, PLACES = 4 * PATCH_CORNERS };
enum { LISTS = 3, KEPT_MOST = 8 };

// All corners, before those that are one are joined.
typedef struct clipper {
    manifold_state *state;
    const clip_rules *rules;
    double steep, least;
    uint32_t kept_ids[4];
    uint64_t has_a, has_b; ///< a bit for each corner
    uint32_t crossing_count, kept_count;
    uint32_t kept[KEPT_MOST];            ///< places of kept corners
    uint8_t edges[2 * PATCH_CORNERS][2]; ///< of each crossing the edges of A and B
    manifold_corner found[PLACES];
} clipper;

static uint32_t is_kept_id(const clipper *c, uint32_t id) {
    const uint32_t *kept = c->kept_ids;
    if (!c->rules->kept_count) return 0;
    return (uint32_t)((kept[0] == id) | (kept[1] == id) | (kept[2] == id) | (kept[3] == id));
}

// Corners farther apart than the margin are none.
static int put(clipper *c, uint32_t place, const manifold_corner *corner) {
    if (!(corner->separation <= c->rules->most)) return 0;
    if (corner->is_kept && c->kept_count < KEPT_MOST) c->kept[c->kept_count++] = place;
    c->found[place] = *corner;
    return 1;
}

// The least distance that a corner shows, whether it becomes one of the polygon or not: it does not depend on what was
// kept.
static void note(clipper *c, const manifold_corner *corner) {
    c->least = min2(c->least, fabs(corner->separation) + 2 * corner->outside * c->steep);
}

// ---- corners ----

// One patch's corners to the other patch.
typedef struct corner_side {
    const manifold_patch *own, *other;
    const simd_patch_table *table; ///< of own's corners to other's sides
    uint32_t kind, place;          ///< of the ids; of the first corner
} corner_side;

// Returns how many corners are inside; kept ones have more room.
static uint32_t put_corners(clipper *c, const corner_side *s, uint64_t *has) {
    const simd_patch *own = &s->own->at;
    double snap = c->rules->snap, keep = max2(c->rules->keep, snap);
    uint32_t inside = 0;
    *has = 0;
    for (uint32_t i = 0; i < own->count; i++) {
        double out = -s->table->least[i];
        if (out > keep) continue;
        uint32_t id = s->kind | own->vertices[i];
        uint32_t is_kept = is_kept_id(c, id);
        double room = is_kept ? keep : snap;
        if (out > room) continue;
        double x = own->x[i], y = own->y[i];
        double outside = out > 0 || s->other->at.count < 3 ? patch_measure_distance(s->other, x, y) : 0;
        if (outside > room) continue;
        double height = patch_get_height(s->other, x, y);
        double separation = s->kind == OVOID_MANIFOLD_ID_VERTEX_A ? height - own->z[i] : own->z[i] - height;
        const manifold_corner corner = {x, y, separation, outside, id, is_kept};
        if (outside <= snap) {
            inside++;
            note(c, &corner);
        }
        *has |= (uint64_t)put(c, s->place + i, &corner) << i;
    }
    return inside;
}

// ---- crossings ----

// Where side i of A and the edge from corner j of B meet, if its ends are on different sides. Returns how far the
// farther end is from the side.
static double place_crossing(const manifold_patch *a, const simd_patch *b, edge_crossing *c) {
    uint32_t i = c->i, j = c->j;
    double p = patch_get_side(a, i, b->x[j], b->y[j]), q = patch_get_side(a, i, b->x[j + 1], b->y[j + 1]);
    double t = p / (p - q);
    c->x = b->x[j] + t * (b->x[j + 1] - b->x[j]);
    c->y = b->y[j] + t * (b->y[j + 1] - b->y[j]);
    return max2(fabs(p), fabs(q));
}

static int is_outside(const manifold_patch *p, uint32_t side, const manifold_patch *other, uint32_t corner) {
    return patch_get_side(p, side, other->at.x[corner], other->at.y[corner]) < 0;
}

int patches_cross(const manifold_patch *a, const manifold_patch *b, edge_crossing *c) {
    if (is_outside(a, c->i, b, c->j) == is_outside(a, c->i, b, c->j + 1)) return 0;
    if (is_outside(b, c->j, a, c->i) == is_outside(b, c->j, a, c->i + 1)) return 0;
    (void)place_crossing(a, &b->at, c);
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

// Of two crossings on edge i of A that nearer to its start comes first.
static void put_in_order(clipper *c, uint32_t first, uint32_t i) {
    if (c->crossing_count != first + 2) return;
    const simd_patch *a = &c->state->a.at;
    manifold_corner *p = c->found + PLACE_CROSSING + first, *q = p + 1;
    double along = (q->x - p->x) * (a->x[i + 1] - a->x[i]) + (q->y - p->y) * (a->y[i + 1] - a->y[i]);
    if (!(along < 0)) return;
    uint32_t place = PLACE_CROSSING + first;
    for (uint32_t k = 0; k < c->kept_count; k++)
        if (c->kept[k] >= place) c->kept[k] = 2 * place + 1 - c->kept[k];
    manifold_corner swapped = *p;
    *p = *q;
    *q = swapped;
    uint8_t edge = c->edges[first][1];
    c->edges[first][1] = c->edges[first + 1][1];
    c->edges[first + 1][1] = edge;
}

static void put_crossings(clipper *c) {
    const manifold_state *s = c->state;
    const manifold_patch *a = &s->a, *b = &s->b;
    uint64_t of_b[PATCH_CORNERS];
    uint32_t count_a = patch_get_edge_count(a), count_b = patch_get_edge_count(b);
    for (uint32_t j = 0; j < count_b; j++) of_b[j] = find_changes(s->to_b.outside[j], a->at.count);
    edge_crossing x;
    for (x.i = 0; x.i < count_a; x.i++) {
        uint32_t first = c->crossing_count;
        for (uint64_t changes = find_changes(s->to_a.outside[x.i], b->at.count); changes; changes &= changes - 1) {
            x.j = (uint32_t)__builtin_ctzll(changes);
            if (!(of_b[x.j] >> x.i & 1)) continue;
            // Edges that lie on one another cross by rounding alone.
            if (place_crossing(a, &b->at, &x) <= c->rules->snap) continue;
            double separation = patch_get_height(b, x.x, x.y) - patch_get_height(a, x.x, x.y);
            uint32_t id = crossing_make_id(a, b, &x);
            const manifold_corner corner = {x.x, x.y, separation, 0, id, is_kept_id(c, id)};
            note(c, &corner);
            uint32_t at = c->crossing_count;
            if (at == 2 * PATCH_CORNERS || !put(c, PLACE_CROSSING + at, &corner)) continue;
            c->edges[at][0] = (uint8_t)x.i;
            c->edges[at][1] = (uint8_t)x.j;
            c->crossing_count++;
        }
        put_in_order(c, first, x.i);
    }
}

// ---- corners that are one ----

static int is_near(const manifold_corner *p, const manifold_corner *q, double within) {
    double dx = p->x - q->x, dy = p->y - q->y;
    return dx * dx + dy * dy < within * within;
}

// What is deeper than the other by more than the snap is a corner of its own.
static int is_deeper(const clipper *c, const manifold_corner *p, const manifold_corner *than) {
    double gap = c->state->frame.gap;
    return max2(p->separation, gap) < max2(than->separation, gap) - c->rules->snap;
}

// 1 if a kept corner stands for it.
static int is_covered(const clipper *c, const manifold_corner *corner) {
    for (uint32_t k = 0; k < c->kept_count; k++) {
        const manifold_corner *kept = c->found + c->kept[k];
        if (is_near(kept, corner, c->rules->keep) && !is_deeper(c, corner, kept)) return 1;
    }
    return 0;
}

// Of two that are near the kept one stays, else a corner of A before one of B before a crossing, unless the other one
// is deeper. The one that goes; NULL if both stay.
static const manifold_corner *find_gone(const clipper *c, const manifold_corner *p, const manifold_corner *q) {
    int is_first = p->is_kept != q->is_kept ? p->is_kept != 0 : p->id < q->id;
    if (is_first) return is_deeper(c, q, p) ? NULL : q;
    return is_deeper(c, p, q) ? NULL : p;
}

// Appends a corner around the polygon, unless another one stands for it.
static void append(clipper *c, uint32_t place) {
    manifold_polygon *out = &c->state->polygon;
    const manifold_corner *corner = c->found + place;
    double snap = 4 * c->rules->snap;
    if (!corner->is_kept && c->kept_count && is_covered(c, corner)) return;
    while (out->count > 0 && is_near(out->corners + out->count - 1, corner, snap)) {
        const manifold_corner *gone = find_gone(c, out->corners + out->count - 1, corner);
        if (gone == corner) return;
        if (!gone) break;
        out->count--;
    }
    if (out->count < OVOID_MANIFOLD_CORNERS) out->corners[out->count++] = *corner;
}

// The last corner and the first.
static void close_polygon(const clipper *c) {
    manifold_polygon *out = &c->state->polygon;
    while (out->count > 1 && is_near(out->corners + out->count - 1, out->corners, 4 * c->rules->snap)) {
        const manifold_corner *gone = find_gone(c, out->corners + out->count - 1, out->corners);
        if (!gone) return;
        if (gone == out->corners) memmove(out->corners, out->corners + 1, (out->count - 1) * sizeof *out->corners);
        out->count--;
    }
}

// ---- the order around the polygon ----

static void append_bits(clipper *c, uint64_t bits, uint32_t place) {
    for (; bits; bits &= bits - 1) append(c, place + (uint32_t)__builtin_ctzll(bits));
}

// The corners up to the end of an edge's start.
static uint64_t get_up_to(uint32_t edge) { return ~(~UINT64_C(1) << edge); }

// The corners of A in its order, each crossing behind the start of its edge, and behind a crossing the corners of B up
// to the next one. 0: corners of both patches lie between two crossings.
static int walk(clipper *c) {
    uint64_t a = c->has_a, b = c->has_b;
    if (!c->crossing_count) {
        if (a && b) return 0;
        append_bits(c, a, 0);
        append_bits(c, b, PLACE_B);
        return 1;
    }
    uint64_t first = a & get_up_to(c->edges[0][0]);
    append_bits(c, first, 0);
    a &= ~first;
    for (uint32_t k = 0; k < c->crossing_count; k++) {
        int is_last = k + 1 == c->crossing_count;
        const uint8_t *from = c->edges[k], *to = c->edges[is_last ? 0 : k + 1];
        uint64_t next_a = is_last ? a : a & get_up_to(to[0]), up_to = get_up_to(to[1]), behind = ~get_up_to(from[1]);
        uint64_t low = b & up_to, high = b & behind;
        if (from[1] <= to[1]) low &= behind, high = 0;
        if ((low | high) && (next_a || (is_last && first))) return 0;
        append(c, PLACE_CROSSING + k);
        append_bits(c, high, PLACE_B);
        append_bits(c, low, PLACE_B);
        append_bits(c, next_a, 0);
        a &= ~next_a;
        b &= ~(low | high);
    }
    return !b;
}

// A number that grows with the angle of a direction, from -2 to 2.
static double get_turn(double x, double y) {
    double sum = fabs(x) + fabs(y), part = sum > 0 ? x / sum : 1;
    return y < 0 ? part - 1 : 1 - part;
}

// Places in one order, with their turns about the mean.
typedef struct place_list {
    uint32_t count;
    uint8_t places[PLACES];
    double turn[PLACES]; ///< of each place
} place_list;

static void list_places(const clipper *c, place_list *l, uint32_t ends[LISTS]) {
    double x = 0, y = 0;
    l->count = 0;
    for (uint64_t bits = c->has_a; bits; bits &= bits - 1) l->places[l->count++] = (uint8_t)__builtin_ctzll(bits);
    ends[0] = l->count;
    for (uint64_t bits = c->has_b; bits; bits &= bits - 1)
        l->places[l->count++] = (uint8_t)(PLACE_B + __builtin_ctzll(bits));
    ends[1] = l->count;
    for (uint32_t k = 0; k < c->crossing_count; k++) l->places[l->count++] = (uint8_t)(PLACE_CROSSING + k);
    ends[2] = l->count;
    for (uint32_t i = 0; i < l->count; i++) x += c->found[l->places[i]].x, y += c->found[l->places[i]].y;
    double scale = 1 / (double)l->count;
    for (uint32_t i = 0; i < l->count; i++) {
        const manifold_corner *p = c->found + l->places[i];
        l->turn[l->places[i]] = get_turn(p->x - x * scale, p->y - y * scale);
    }
}

// A list that is read around, from the corner of the least turn on.
typedef struct reader {
    uint32_t begin, end, next, left;
} reader;

static reader open_reader(const place_list *l, uint32_t begin, uint32_t end) {
    reader r = {begin, end, begin, end - begin};
    for (uint32_t i = begin; i < end; i++)
        if (l->turn[l->places[i]] < l->turn[l->places[r.next]]) r.next = i;
    return r;
}

// The three lists by their turns; what rounding put out of order is inserted at its place.
static void merge(clipper *c) {
    place_list l;
    uint8_t order[PLACES];
    reader lists[LISTS] = {{0}};
    uint32_t ends[LISTS], count = 0, first = 0;
    list_places(c, &l, ends);
    for (int k = 0; k < LISTS; k++)
        if (ends[k] > (k ? ends[k - 1] : 0)) lists[count++] = open_reader(&l, k ? ends[k - 1] : 0, ends[k]);
    for (uint32_t i = 0; i < l.count; i++) {
        uint32_t best = 0;
        for (uint32_t k = 1; k < count; k++)
            if (l.turn[l.places[lists[k].next]] < l.turn[l.places[lists[best].next]]) best = k;
        reader *r = lists + best;
        uint8_t place = l.places[r->next];
        r->next = r->next + 1 == r->end ? r->begin : r->next + 1;
        if (--r->left == 0) *r = lists[--count];
        uint32_t k = i;
        for (; k > 0 && l.turn[order[k - 1]] > l.turn[place]; k--) order[k] = order[k - 1];
        order[k] = place;
    }
    // From the first place on, so that where they begin does not change as they move.
    for (uint32_t i = 1; i < l.count; i++)
        if (order[i] < order[first]) first = i;
    for (uint32_t i = 0; i < l.count; i++) append(c, order[first + i < l.count ? first + i : first + i - l.count]);
}

// ---- the polygon ----

double polygon_compute_area(const manifold_polygon *p) {
    double sum = 0;
    const manifold_corner *c = p->corners;
    for (uint32_t i = 1; i + 1 < p->count; i++)
        sum += (c[i].x - c->x) * (c[i + 1].y - c->y) - (c[i].y - c->y) * (c[i + 1].x - c->x);
    return max2(sum, 0) / 2;
}

void patches_clip(manifold_state *s, const clip_rules *rules) {
    clipper c;
    const patch_kernels *kernels = patch_get_kernels();
    c.state = s;
    c.rules = rules;
    c.crossing_count = c.kept_count = 0;
    c.steep = max2(s->a.steepness, s->b.steepness);
    c.least = INFINITY;
    for (uint32_t i = 0; i < 4; i++) c.kept_ids[i] = i < rules->kept_count ? rules->kept[i] : UINT32_MAX;
    kernels->measure(&s->a.at, &s->b.at, &s->to_a);
    kernels->measure(&s->b.at, &s->a.at, &s->to_b);
    corner_side a = {&s->a, &s->b, &s->to_b, OVOID_MANIFOLD_ID_VERTEX_A, 0};
    corner_side b = {&s->b, &s->a, &s->to_a, OVOID_MANIFOLD_ID_VERTEX_B, PLACE_B};
    uint32_t inside_a = put_corners(&c, &a, &c.has_a), inside_b = put_corners(&c, &b, &c.has_b);
    if (inside_a < s->a.at.count && inside_b < s->b.at.count) put_crossings(&c);
    s->polygon.count = 0;
    if (!walk(&c)) {
        s->polygon.count = 0;
        merge(&c);
    }
    close_polygon(&c);
    s->polygon.least = c.least;
    s->polygon.area = s->polygon.count > 4 ? polygon_compute_area(&s->polygon) : 0;
}
