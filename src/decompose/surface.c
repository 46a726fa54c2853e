// The triangles near a point or a cell. A cell is apart from a triangle if some direction separates them: normals of
// faces and cross products of edges suffice (S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, 1996, for boxes; the same
// holds for any two polytopes). Any direction with a gap proves it, whatever the rounding of the direction.
#include "decompose/body.h"

#include "ovoid/body.h"

// ---- the nearest triangle, through the tree

typedef struct waiting {
    double square; ///< of the distance of the box, in the tree's unit
    tree_ref ref;
} waiting;

typedef struct nearest {
    const body *b;
    vec3 x;       ///< in the body's unit
    double q[3];  ///< the tree's frame and unit
    double least; ///< square of the distance, our unit
    double limit; ///< the same in the tree's unit
    uint32_t place;
    uint32_t count;
    waiting stack[SOLID_DEPTH_MAX * BOX8];
} nearest;

static void try_triangle(nearest *n, uint32_t place) {
    vec3 corner[3];
    body_get_triangle(n->b, place, corner);
    double d = vec3_norm_squared(vec3_sub(n->x, triangle_find_nearest(corner, n->x)));
    if (!(d < n->least)) return;
    double ratio = n->b->unit / n->b->solid->unit;
    n->least = d;
    n->limit = d * ratio * ratio;
    n->place = place;
}

// Pushes the children of a node that may contain a nearer triangle, the nearest on top.
static void open_node(nearest *n, uint32_t node) {
    const box8 *boxes = &n->b->solid->boxes[node];
    double square[BOX8];
    for (int i = 0; i < BOX8; i++) {
        square[i] = 0;
        for (int k = 0; k < 3; k++) {
            double d = max2(max2(boxes->low[k][i] - n->q[k], n->q[k] - boxes->high[k][i]), 0);
            square[i] += d * d;
        }
    }
    uint32_t first = n->count, children = n->b->solid->nodes[node].children;
    for (uint32_t i = 0; i < children; i++) {
        if (!(square[i] < n->limit)) continue;
        uint32_t at = n->count++;
        for (; at > first && n->stack[at - 1].square < square[i]; at--) n->stack[at] = n->stack[at - 1];
        n->stack[at] = (waiting){square[i], solid_get_child(n->b->solid, node, i)};
    }
}

uint32_t body_find_triangle(const body *b, vec3 x, uint32_t hint, double *distance) {
    const ovoid_solid *s = b->solid;
    vec3 q = vec3_scale(vec3_sub(vec3_scale(x, b->unit), s->center), 1 / s->unit);
    nearest n;
    n.b = b;
    n.x = x;
    n.q[0] = q.x, n.q[1] = q.y, n.q[2] = q.z;
    n.least = n.limit = INFINITY;
    n.place = 0;
    n.count = 1;
    n.stack[0] = (waiting){0, 0};
    try_triangle(&n, hint < s->triangle_count ? hint : 0);
    while (n.count > 0) {
        waiting w = n.stack[--n.count];
        if (!(w.square < n.limit)) continue;
        if (ref_is_leaf(w.ref))
            try_triangle(&n, ref_get_index(w.ref));
        else
            open_node(&n, w.ref);
    }
    *distance = sqrt(n.least);
    return n.place;
}

// ---- cells and triangles

// The faces' normals and the six edges of a cell.
typedef struct cell_axes {
    const cell *c;
    vec3 normals[4], edges[6];
    double pad;
} cell_axes;

static void make_axes(const body *b, const cell *c, cell_axes *a) {
    static const uint8_t ends[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    a->c = c;
    a->pad = b->pad;
    for (int i = 0; i < 6; i++) a->edges[i] = vec3_sub(c->corner[ends[i][1]], c->corner[ends[i][0]]);
    a->normals[0] = vec3_cross(a->edges[0], a->edges[1]);
    a->normals[1] = vec3_cross(a->edges[0], a->edges[2]);
    a->normals[2] = vec3_cross(a->edges[1], a->edges[2]);
    a->normals[3] = vec3_cross(a->edges[3], a->edges[4]);
}

// 1 if the direction shows a gap of more than the pad.
static int is_parting(const cell_axes *a, const vec3 t[3], vec3 n) {
    double low = INFINITY, high = -INFINITY, least = INFINITY, most = -INFINITY;
    for (int i = 0; i < 4; i++) {
        double d = vec3_dot(n, a->c->corner[i]);
        low = min2(low, d);
        high = max2(high, d);
    }
    for (int i = 0; i < 3; i++) {
        double d = vec3_dot(n, t[i]);
        least = min2(least, d);
        most = max2(most, d);
    }
    double gap = max2(least - high, low - most);
    return gap > 0 && gap > a->pad * vec3_norm(n);
}

static int is_apart(const cell_axes *a, const vec3 t[3]) {
    for (int i = 0; i < 4; i++)
        if (is_parting(a, t, a->normals[i])) return 1;
    const vec3 edges[3] = {vec3_sub(t[1], t[0]), vec3_sub(t[2], t[0]), vec3_sub(t[2], t[1])};
    if (is_parting(a, t, vec3_cross(edges[0], edges[1]))) return 1;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 3; j++)
            if (is_parting(a, t, vec3_cross(a->edges[i], edges[j]))) return 1;
    return 0;
}

// Finds the tree's boxes that may meet the cell's. Boxes of the tree are of about 1, and lanes without a box end at
// 2^100; an end of the cell's box beyond both, for a part much larger than the solid, is cut to 2^64.
static void begin_walk(const body *b, const cell *c, box8_walk *walk) {
    const ovoid_solid *s = b->solid;
    const double far = 0x1p64;
    box around = cell_compute_box(c);
    vec3 pad = {b->pad, b->pad, b->pad};
    vec3 low = vec3_scale(vec3_sub(vec3_scale(vec3_sub(around.min, pad), b->unit), s->center), 1 / s->unit);
    vec3 high = vec3_scale(vec3_sub(vec3_scale(vec3_add(around.max, pad), b->unit), s->center), 1 / s->unit);
    const double ends[6] = {max2(low.x, -far), max2(low.y, -far), max2(low.z, -far),
                            min2(high.x, far), min2(high.y, far), min2(high.z, far)};
    box8_begin(walk, s->boxes, ends);
}

uint32_t body_list_crossing(const body *b, const cell *c, uint32_t *places, uint32_t room) {
    enum { BATCH = 64 };
    cell_axes axes;
    make_axes(b, c, &axes);
    uint32_t batch[BATCH], found, count = 0;
    box8_walk walk;
    begin_walk(b, c, &walk);
    while ((found = box8_find_leaves(&walk, batch, BATCH)) > 0)
        for (uint32_t i = 0; i < found; i++) {
            vec3 t[3];
            body_get_triangle(b, batch[i], t);
            if (is_apart(&axes, t)) continue;
            if (count == room) return room + 1;
            places[count++] = batch[i];
        }
    return count;
}

int body_is_crossed(const body *b, const cell *c, uint32_t *place) {
    // Tests the triangle that crossed the last cell first.
    cell_axes axes;
    make_axes(b, c, &axes);
    vec3 t[3];
    body_get_triangle(b, *place, t);
    if (!is_apart(&axes, t)) return 1;
    uint32_t first, count = body_list_crossing(b, c, &first, 1);
    if (count) *place = first;
    return count > 0;
}

int body_find_inside(const body *b, vec3 x) {
    int64_t winding;
    if (!solid_find_winding(b->solid, vec3_scale(x, b->unit), 0, &winding)) return -1;
    return winding != 0;
}

double body_find_outside(const body *b, vec3 x) {
    ovoid_pose at = ovoid_pose_make_identity();
    at.position = vec3_scale(x, b->unit);
    ovoid_body_pair pair = {.a = {.shape = b->point, .pose = at},
                            .b = {.solid = b->solid, .pose = ovoid_pose_make_identity()}};
    ovoid_options options = {.absolute_tolerance = b->tolerance};
    ovoid_body_answer answer = ovoid_body_distance(&pair, &options, NULL);
    return answer.status == OVOID_SEPARATED ? answer.lower * b->inverse : 0;
}
