// Cells: tetrahedra that are halved at the middle of their longest edge (M. C. Rivara, Algorithms for refining
// triangular grids suitable for adaptive and multigrid techniques, 1984), a heap of them, and what share of one a plane
// cuts off.
#include "robot/spheres/spheres.h"

static const int edges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

double spheres_cell_halve(const spheres_cell *cell, spheres_cell half[2]) {
    double longest = -1;
    const int *edge = edges[0];
    for (int i = 0; i < 6; i++) {
        double square = vec3_norm_squared(vec3_sub(cell->corner[edges[i][0]], cell->corner[edges[i][1]]));
        if (square > longest) longest = square, edge = edges[i];
    }
    vec3 middle = vec3_scale(vec3_add(cell->corner[edge[0]], cell->corner[edge[1]]), 0.5);
    half[0] = half[1] = *cell;
    for (int i = 0; i < 2; i++) {
        half[i].corner[edge[i]] = middle;
        half[i].volume = cell->volume / 2;
        half[i].level = cell->level + 1;
    }
    return longest;
}

sphere_of_cell spheres_cell_find_around(const spheres_cell *cell) {
    sphere_of_cell a = {{0, 0, 0}, 0, 0};
    for (int i = 0; i < 4; i++) a.middle = vec3_add_scaled(a.middle, cell->corner[i], 0.25);
    for (int i = 0; i < 4; i++) a.radius = max2(a.radius, vec3_norm_squared(vec3_sub(cell->corner[i], a.middle)));
    a.radius = sqrt(a.radius) * (1 + 16 * ROUNDING);
    for (int i = 0; i < 6; i++)
        a.edge_squared =
            max2(a.edge_squared, vec3_norm_squared(vec3_sub(cell->corner[edges[i][0]], cell->corner[edges[i][1]])));
    return a;
}

// The side of a box, grown to multiples of the step.
static void grow(double step, double *low, double *high) {
    *low = (floor(*low / step) - 1) * step;
    *high = (ceil(*high / step) + 1) * step;
}

// The six paths from one corner of the box to the opposite one along its edges (H. W. Kuhn, Some combinatorial lemmas
// in topology, 1960). Coordinates have 13 bits at first, and each halving adds one at most.
void spheres_cell_make_box(box b, spheres_cell cells[6]) {
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    double step = ldexp(1, find_unit_exponent(max2(vec3_max_abs(b.min), vec3_max_abs(b.max))) - 12);
    grow(step, &b.min.x, &b.max.x);
    grow(step, &b.min.y, &b.max.y);
    grow(step, &b.min.z, &b.max.z);
    double volume = (b.max.x - b.min.x) * (b.max.y - b.min.y) * (b.max.z - b.min.z) / 6;
    for (int i = 0; i < 6; i++) {
        double at[3] = {b.min.x, b.min.y, b.min.z}, end[3] = {b.max.x, b.max.y, b.max.z};
        cells[i] = (spheres_cell){.volume = volume};
        for (int k = 0; k < 4; k++) {
            cells[i].corner[k] = (vec3){at[0], at[1], at[2]};
            if (k < 3) at[orders[i][k]] = end[orders[i][k]];
        }
    }
}

void spheres_heap_push(spheres_heap *heap, const spheres_cell *cell) {
    size_t at = heap->count++;
    for (; at > 0 && heap->cells[(at - 1) / 2].key < cell->key; at = (at - 1) / 2)
        heap->cells[at] = heap->cells[(at - 1) / 2];
    heap->cells[at] = *cell;
}

spheres_cell spheres_heap_pop(spheres_heap *heap) {
    spheres_cell top = heap->cells[0], last = heap->cells[--heap->count];
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= heap->count) break;
        if (child + 1 < heap->count && heap->cells[child + 1].key > heap->cells[child].key) child++;
        if (heap->cells[child].key <= last.key) break;
        heap->cells[at] = heap->cells[child];
        at = child;
    }
    if (heap->count) heap->cells[at] = last;
    return top;
}

// Where on the edge from a corner with value a <= 0 to one with b > 0 the zero is.
static double find_zero(double a, double b) { return a <= -INFINITY ? 1 : b >= INFINITY ? 0 : a / (a - b); }

// One corner on its side: the product of three. Three: all but such a product, written without cancellation. Two: the
// wedge between edges AB and CD is three tetrahedra, with s, t the zeros on AC and AD, p, q those on BC and BD: s t + q
// s (1 - t) + (1 - s) p q. No term is negative.
double spheres_compute_share(const double value[4]) {
    double in[4], out[4];
    int inside = 0, outside = 0;
    for (int i = 0; i < 4; i++) {
        if (value[i] <= 0)
            in[inside++] = value[i];
        else
            out[outside++] = value[i];
    }
    if (inside == 0 || inside == 4) return inside == 4;
    if (inside == 1) return find_zero(in[0], out[0]) * find_zero(in[0], out[1]) * find_zero(in[0], out[2]);
    if (inside == 3) {
        double a = find_zero(in[0], out[0]), b = find_zero(in[1], out[0]), c = find_zero(in[2], out[0]);
        return a + (1 - a) * (b + (1 - b) * c);
    }
    double s = find_zero(in[0], out[0]), t = find_zero(in[0], out[1]);
    double p = find_zero(in[1], out[0]), q = find_zero(in[1], out[1]);
    return s * t + q * s * (1 - t) + (1 - s) * p * q;
}
