// The polygon in which two patches overlap. Neither is the reference: its corners are those of each patch that are
// inside of the other, and the crossings of their edges. So it is the same polygon whichever body comes first, and each
// corner has a name that does not depend on how it was found.
#include "manifold/manifold.h"

// A polygon that grows.
typedef struct clipper {
    const manifold_patch *a, *b;
    const clip_rules *rules;
    manifold_polygon *out;
} clipper;

static int is_kept(const clip_rules *r, uint32_t id) {
    for (uint32_t i = 0; i < r->kept_count; i++)
        if (r->kept[i] == id) return 1;
    return 0;
}

// A corner that is nearer to one that is there than four times the snap is that corner.
static int is_there(const clipper *c, double x, double y) {
    double near = 4 * c->rules->snap;
    for (uint32_t i = 0; i < c->out->count; i++) {
        const manifold_corner *k = c->out->corners + i;
        double dx = k->x - x, dy = k->y - y;
        if (dx * dx + dy * dy < near * near) return 1;
    }
    return 0;
}

static void add(clipper *c, const manifold_corner *corner) {
    if (c->out->count == OVOID_MANIFOLD_CORNERS || is_there(c, corner->x, corner->y)) return;
    if (corner->separation <= c->rules->most) c->out->corners[c->out->count++] = *corner;
}

// The least distance that a corner shows, whether it becomes one of the polygon or not: it does not depend on what was
// kept.
static void note(clipper *c, const manifold_corner *corner) {
    double steep = max2(c->a->steepness, c->b->steepness);
    c->out->least = min2(c->out->least, fabs(corner->separation) + 2 * corner->outside * steep);
}

// Corners of one patch inside of the other; kept ones with more room. Returns how many are inside.
static uint32_t add_inside(clipper *c, const manifold_patch *p, const manifold_patch *other, uint32_t kind) {
    uint32_t inside = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        double distance = patch_measure_distance(other, p->x[i], p->y[i]);
        uint32_t id = kind | p->vertices[i];
        int is_inside = distance <= c->rules->snap;
        if (!is_inside && !(distance <= c->rules->keep && is_kept(c->rules, id))) continue;
        double height = patch_get_height(other, p->x[i], p->y[i]);
        double separation = kind == OVOID_MANIFOLD_ID_VERTEX_A ? height - p->z[i] : p->z[i] - height;
        const manifold_corner corner = {p->x[i], p->y[i], separation, max2(distance, 0), id};
        inside += (uint32_t)is_inside;
        if (is_inside) note(c, &corner);
        add(c, &corner);
    }
    return inside;
}

// Twice the area of the triangle of the edge from corner i and a point: positive to the left.
static double get_side(const manifold_patch *p, uint32_t i, double x, double y) {
    return (p->x[i + 1] - p->x[i]) * (y - p->y[i]) - (p->y[i + 1] - p->y[i]) * (x - p->x[i]);
}

int patches_cross(const manifold_patch *a, const manifold_patch *b, edge_crossing *c) {
    uint32_t i = c->i, j = c->j;
    double p = get_side(a, i, b->x[j], b->y[j]), q = get_side(a, i, b->x[j + 1], b->y[j + 1]);
    if ((p < 0) == (q < 0)) return 0;
    double r = get_side(b, j, a->x[i], a->y[i]), s = get_side(b, j, a->x[i + 1], a->y[i + 1]);
    if ((r < 0) == (s < 0)) return 0;
    double t = p / (p - q);
    c->x = b->x[j] + t * (b->x[j + 1] - b->x[j]);
    c->y = b->y[j] + t * (b->y[j + 1] - b->y[j]);
    return 1;
}

uint32_t crossing_make_id(const manifold_patch *a, const manifold_patch *b, const edge_crossing *c) {
    return OVOID_MANIFOLD_ID_CROSSING | (a->edges[c->i] & 0x7fff) << 15 | (b->edges[c->j] & 0x7fff);
}

static void add_crossings(clipper *c) {
    edge_crossing x;
    for (x.i = 0; x.i < patch_get_edge_count(c->a); x.i++)
        for (x.j = 0; x.j < patch_get_edge_count(c->b); x.j++) {
            if (!patches_cross(c->a, c->b, &x)) continue;
            double separation = patch_get_height(c->b, x.x, x.y) - patch_get_height(c->a, x.x, x.y);
            const manifold_corner corner = {x.x, x.y, separation, 0, crossing_make_id(c->a, c->b, &x)};
            note(c, &corner);
            add(c, &corner);
        }
}

// A number that grows with the angle of a direction, from -2 to 2.
static double get_turn(double x, double y) {
    double sum = fabs(x) + fabs(y), part = sum > 0 ? x / sum : 1;
    return y < 0 ? part - 1 : 1 - part;
}

// The corners around their mean. Equal turns keep their order.
static void sort(manifold_polygon *p) {
    double x = 0, y = 0, turn[OVOID_MANIFOLD_CORNERS];
    for (uint32_t i = 0; i < p->count; i++) x += p->corners[i].x, y += p->corners[i].y;
    x /= p->count;
    y /= p->count;
    for (uint32_t i = 0; i < p->count; i++) {
        manifold_corner corner = p->corners[i];
        double key = get_turn(corner.x - x, corner.y - y);
        uint32_t k = i;
        for (; k > 0 && turn[k - 1] > key; k--) turn[k] = turn[k - 1], p->corners[k] = p->corners[k - 1];
        turn[k] = key;
        p->corners[k] = corner;
    }
}

static double compute_area(const manifold_polygon *p) {
    double sum = 0;
    const manifold_corner *c = p->corners;
    for (uint32_t i = 1; i + 1 < p->count; i++)
        sum += (c[i].x - c->x) * (c[i + 1].y - c->y) - (c[i].y - c->y) * (c[i + 1].x - c->x);
    return max2(sum, 0) / 2;
}

void patches_clip(const manifold_patch *a, const manifold_patch *b, const clip_rules *rules, manifold_polygon *out) {
    clipper c = {a, b, rules, out};
    out->count = 0;
    out->least = INFINITY;
    uint32_t inside_a = add_inside(&c, a, b, OVOID_MANIFOLD_ID_VERTEX_A);
    uint32_t inside_b = add_inside(&c, b, a, OVOID_MANIFOLD_ID_VERTEX_B);
    if (inside_a < a->count && inside_b < b->count) add_crossings(&c);
    if (out->count > 2) sort(out);
    out->area = compute_area(out);
}
