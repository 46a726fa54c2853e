// The deepest uncovered point of a link: the greatest value over its points of f(x) = least over the spheres of
// |x - c| - r, by branch and bound, the cell with the greatest bound first.
//
// Above: a ball is convex, so over a cell each |x - c| is greatest at a corner, and the least over the spheres of those
// is at least f. Below: f itself at points of the link. f changes by at most |x - y| between x and y, which is how
// rounding and allowances are counted. Cells of a solid are the fan of its triangles from a point, which covers it
// wherever that point is; those of a rounded or flat part are of the box around it, and the half-space behind the
// normal of the middle's distance clips them. Near an isolated deepest point each halving leaves as many cells as
// before, so a bracket of width w costs about log(1 / w); where f is the same along curves, about 1 / w.
#include "robot/spheres/spheres.h"

enum { LEVELS = 110, LOOKS = 16 };

// A search.
typedef struct search {
    const spheres_link *link;
    const spheres_tree *tree;
    spheres_heap *heap;
    spheres_depth found;
    double settled; ///< the greatest bound of cells that are too small to be halved
} search;

// A point that is within `off` of the true body of the part; `of`: its cell, with a sphere that is likely
// to hold it.
static void try_point(search *s, const spheres_cell *of, vec3 x, double off) {
    uint32_t nearest = of->sphere;
    // Most points are no deeper than the deepest: one sphere shows that.
    if (!(spheres_tree_measure_value(s->tree, nearest, x) - off - s->link->pad > s->found.lower)) return;
    double value = spheres_tree_find_value(s->tree, x, &nearest) - off - s->link->pad;
    if (value > s->found.lower) {
        s->found.lower = value, s->found.point = x;
        s->found.part = of->part, s->found.sphere = nearest;
    }
}

// Climbs from a point that is better than all before: away from the nearest sphere, and back to the part. The distance
// from one sphere grows with each step, as the part is convex; where another sphere is nearer then, nothing is lost.
static void climb(search *s, uint32_t index) {
    const spheres_part *part = &s->link->parts[index];
    const spheres_cell at = {.part = index};
    for (int step = 0; step < 4; step++) {
        double before = s->found.lower;
        vec3 away = vec3_unit(vec3_sub(s->found.point, s->tree->items[s->found.sphere].center));
        vec3 x = vec3_add_scaled(s->found.point, away, 4 * part->beyond);
        ovoid_answer a = spheres_part_probe(s->link, part, x);
        if (a.status == OVOID_SEPARATED) try_point(s, &at, vec3_scale(a.point_a, 1 / s->link->unit), part->inside);
        if (!(s->found.lower > before)) return;
    }
}

// What is left of a cell by the half-space value <= 0, value being linear in it: at most six corners; their number.
static int clip(const spheres_cell *cell, const double value[4], vec3 left[6]) {
    int count = 0;
    for (int i = 0; i < 4; i++) {
        if (!(value[i] > 0)) left[count++] = cell->corner[i];
        for (int k = 0; k < 4; k++) {
            if (value[i] > 0 || !(value[k] > 0)) continue;
            double t = value[i] <= -INFINITY ? 1 : value[i] / (value[i] - value[k]);
            left[count++] = vec3_add_scaled(cell->corner[i], vec3_sub(cell->corner[k], cell->corner[i]), t);
        }
    }
    return count;
}

// Tries a point of the part near the cell, and lowers the bound by what the part leaves of the cell: 0 where that is
// nothing, or too little to matter. Without this the bound would be too high by the cell's size, with it by the square.
static int try_probe(search *s, spheres_cell *cell) {
    const spheres_part *part = &s->link->parts[cell->part];
    sphere_of_cell around = spheres_cell_find_around(cell);
    ovoid_answer a = spheres_part_probe(s->link, part, around.middle);
    double before = s->found.lower;
    if (a.upper <= 0)
        try_point(s, cell, around.middle, 0);
    else if (a.status == OVOID_SEPARATED)
        try_point(s, cell, vec3_scale(a.point_a, 1 / s->link->unit), part->inside);
    if (s->found.lower > before) climb(s, cell->part);
    if (a.lower / s->link->unit - around.radius > s->link->pad) return 0;
    // The distance at x is at least that at the middle and the way along its normal.
    double value[4];
    for (int k = 0; k < 4; k++)
        value[k] =
            a.lower / s->link->unit + vec3_dot(a.normal, vec3_sub(cell->corner[k], around.middle)) - s->link->pad;
    vec3 left[6];
    int count = clip(cell, value, left);
    uint32_t nearest = cell->sphere;
    if (count == 0) return 0;
    cell->key = min2(cell->key, spheres_tree_find_least(s->tree, left, count, &nearest) + s->link->pad);
    return cell->key > s->found.lower;
}

// is_new: a bit for each corner that was not tried as one of the cell around this one.
static void add_cell(search *s, spheres_cell *cell, double parent, unsigned is_new) {
    const spheres_part *part = &s->link->parts[cell->part];
    s->found.cells++;
    // The sphere that held the cell around this one best may show that no point of it is deeper than the deepest.
    double hinted = spheres_tree_measure_greatest(s->tree, cell->sphere, cell->corner);
    if (min2(parent, hinted + s->link->pad) <= s->found.lower) return;
    cell->key = min2(parent, spheres_tree_find_least(s->tree, cell->corner, 4, &cell->sphere) + s->link->pad);
    if (cell->key <= s->found.lower) return;
    if (part->triangles) {
        for (int k = 0; k < 4; k++)
            if (is_new >> k & 1) try_point(s, cell, cell->corner[k], part->inside);
        try_point(s, cell, spheres_cell_find_around(cell).middle, part->inside);
    } else if (!try_probe(s, cell))
        return;
    spheres_heap_push(s->heap, cell);
}

static void add_fan(search *s, uint32_t index, double bound) {
    const spheres_part *part = &s->link->parts[index];
    for (uint32_t t = 0; t < part->triangle_count; t++) {
        spheres_cell cell = {.part = index};
        cell.corner[0] = part->middle;
        for (int k = 0; k < 3; k++) cell.corner[k + 1] = part->points[part->triangles[3 * (size_t)t + (size_t)k]];
        add_cell(s, &cell, bound, 15);
    }
}

static void add_part(search *s, uint32_t index) {
    const spheres_part *part = &s->link->parts[index];
    const spheres_cell at = {.part = index};
    for (uint32_t i = 0; i < part->point_count; i++) try_point(s, &at, part->points[i], part->inside);
    // One sphere for the whole part: exact for a rounded one, too.
    uint32_t nearest = 0;
    double whole = spheres_tree_find_least(s->tree, part->points, (int)part->point_count, &nearest);
    whole += (part->beyond + s->link->pad) * (1 + 4 * ROUNDING);
    if (part->triangles) {
        add_fan(s, index, whole);
        return;
    }
    spheres_cell cells[6];
    spheres_cell_make_box(part->box, cells);
    for (int i = 0; i < 6; i++) {
        cells[i].part = index;
        add_cell(s, &cells[i], whole, 15);
    }
}

static int is_same(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static unsigned find_new(const spheres_cell *cell, const spheres_cell *half) {
    unsigned found = 0;
    for (unsigned k = 0; k < 4; k++) found |= (unsigned)!is_same(cell->corner[k], half->corner[k]) << k;
    return found;
}

static void divide(search *s) {
    spheres_cell cell = spheres_heap_pop(s->heap), half[2];
    double shortest = 64 * s->link->pad, edge = spheres_cell_halve(&cell, half);
    if (cell.level >= LEVELS || edge <= shortest * shortest) {
        s->settled = max2(s->settled, cell.key);
        return;
    }
    for (int i = 0; i < 2; i++) add_cell(s, &half[i], cell.key, find_new(&cell, &half[i]));
}

spheres_depth spheres_find_depth(const spheres_link *link, const spheres_tree *tree, double tolerance,
                                 spheres_heap *heap) {
    search s = {link, tree, heap, {.lower = -INFINITY}, -INFINITY};
    heap->count = 0;
    for (uint32_t i = 0; i < link->part_count; i++) add_part(&s, i);
    size_t most = LOOKS * heap->capacity;
    while (heap->count && heap->count + 2 <= heap->capacity && s.found.cells < most &&
           heap->cells[0].key - s.found.lower > tolerance && !watch_is_stopped(heap->watch))
        divide(&s);
    s.found.upper = max2(s.settled, s.found.lower);
    if (heap->count) s.found.upper = max2(s.found.upper, heap->cells[0].key);
    return s.found;
}
