// Volumes of the link outside the spheres, of the spheres outside the link, and of both, by halving the tetrahedra of a
// box around all, the one whose bounds are farthest apart first.
//
// In a cell a convex function is at most its linear interpolant between the corners, so where that is <= 0 the point is
// in the body: of a part with the distances at the corners, of a ball with |x - c|^2 - r^2. A half-space that holds the
// part, and the interpolant lowered by its greatest error for the ball, bound them from outside. Both planes cut off
// shares in closed form, whose difference falls with the square of the cell's size; unions are bounded by the largest
// share and by the sum. Cells that only one surface crosses are therefore soon narrow, and those at curves, where
// several meet, are the ones that are halved.
#include "robot/spheres/spheres.h"

enum { LEVELS = 110, LOOKS = 16 };

static ovoid_robot_bracket find_part_share(const spheres_link *link, const spheres_part *part, const spheres_cell *cell,
                                           const sphere_of_cell *around) {
    static const ovoid_robot_bracket none = {0, 0}, all = {1, 1};
    box b = box_make_around(&cell->corner[0].x, 4);
    if (!box_is_overlapping(&b, &part->box)) return none;
    ovoid_answer a = spheres_part_probe(link, part, around->middle);
    double lower = a.lower / link->unit, upper = a.upper / link->unit, value[4];
    if (lower - link->pad > around->radius) return none;
    if (upper + link->pad < -around->radius) return all;
    for (int k = 0; k < 4; k++)
        value[k] = lower + vec3_dot(a.normal, vec3_sub(cell->corner[k], around->middle)) - link->pad;
    ovoid_robot_bracket share = {0, min2(1, spheres_compute_share(value) * (1 + 0x1p-46))};
    if (share.upper == 0) return none;
    for (int k = 0; k < 4; k++)
        value[k] = spheres_part_probe(link, part, cell->corner[k]).upper / link->unit * (1 + 4 * ROUNDING);
    share.lower = min2(spheres_compute_share(value) * (1 - 0x1p-46), share.upper);
    return share;
}

static ovoid_robot_bracket find_link_share(const spheres_link *link, const spheres_cell *cell,
                                           const sphere_of_cell *around) {
    ovoid_robot_bracket share = {0, 0};
    for (uint32_t i = 0; i < link->part_count && share.lower < 1; i++) {
        ovoid_robot_bracket of_part = find_part_share(link, &link->parts[i], cell, around);
        share.lower = max2(share.lower, of_part.lower);
        share.upper += of_part.upper;
    }
    share.upper = min2(share.upper, 1);
    return share;
}

// What is in a and not in b, as a volume.
static ovoid_robot_bracket find_rest(ovoid_robot_bracket a, ovoid_robot_bracket b, double volume) {
    return (ovoid_robot_bracket){max2(0, a.lower - b.upper) * volume, min2(a.upper, 1 - b.lower) * volume};
}

static void fill_cell(const spheres_link *link, const spheres_tree *tree, spheres_cell *cell) {
    sphere_of_cell around = spheres_cell_find_around(cell);
    ovoid_robot_bracket l = find_link_share(link, cell, &around), s = spheres_tree_find_share(tree, cell, &around);
    double v = cell->volume;
    cell->holds = (spheres_volumes){
        find_rest(l, s, v), find_rest(s, l, v), {l.lower * v, l.upper * v}, {s.lower * v, s.upper * v}};
    cell->key = (cell->holds.uncovered.upper - cell->holds.uncovered.lower) +
                (cell->holds.excess.upper - cell->holds.excess.lower);
}

static void add_bracket(ovoid_robot_bracket *sum, const ovoid_robot_bracket *b) {
    sum->lower += b->lower;
    sum->upper += b->upper;
}

static void add_volumes(spheres_volumes *sum, const spheres_volumes *v) {
    add_bracket(&sum->uncovered, &v->uncovered);
    add_bracket(&sum->excess, &v->excess);
    add_bracket(&sum->link, &v->link);
    add_bracket(&sum->spheres, &v->spheres);
}

// The sum of up to 2^24 terms, none of them negative, and of what made them, is off by less than 2^-27 of itself.
static ovoid_robot_bracket widen(ovoid_robot_bracket b) {
    return (ovoid_robot_bracket){b.lower * (1 - 0x1p-27), b.upper * (1 + 0x1p-27)};
}

static box find_box(const spheres_link *link, const spheres_tree *tree) {
    box all = link->box;
    for (uint32_t i = 0; i < tree->count; i++) {
        double r = tree->items[i].radius * (1 + 4 * ROUNDING);
        vec3 c = tree->items[i].center, side = {r, r, r};
        box b = {vec3_sub(c, side), vec3_add(c, side)};
        all = box_join(&all, &b);
    }
    return all;
}

spheres_volumes spheres_find_volumes(const spheres_link *link, const spheres_tree *tree, spheres_heap *heap,
                                     size_t *cells) {
    spheres_cell root[6];
    spheres_volumes sum = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    spheres_cell_make_box(find_box(link, tree), root);
    heap->count = 0;
    for (int i = 0; i < 6; i++) {
        fill_cell(link, tree, &root[i]);
        spheres_heap_push(heap, &root[i]);
    }
    size_t looks = 6;
    while (heap->count && heap->count + 2 <= heap->capacity && looks < LOOKS * heap->capacity &&
           !watch_is_stopped(heap->watch)) {
        spheres_cell cell = spheres_heap_pop(heap), half[2];
        (void)spheres_cell_halve(&cell, half);
        if (!(cell.key > root[0].volume * 0x1p-40) || cell.level >= LEVELS) {
            add_volumes(&sum, &cell.holds);
            continue;
        }
        for (int i = 0; i < 2; i++) {
            fill_cell(link, tree, &half[i]);
            // A cell whose volume is decided (key 0) is added to the sum, and leaves the heap.
            if (half[i].key > 0)
                spheres_heap_push(heap, &half[i]);
            else
                add_volumes(&sum, &half[i].holds);
        }
        looks += 2;
    }
    for (size_t i = 0; i < heap->count; i++) add_volumes(&sum, &heap->cells[i].holds);
    *cells += looks;
    return (spheres_volumes){widen(sum.uncovered), widen(sum.excess), widen(sum.link), widen(sum.spheres)};
}
