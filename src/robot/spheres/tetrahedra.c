// Cells: tetrahedra (linear/tetrahedron.h) with what is known of them, a heap of them, and what share of one a plane
// cuts off.
#include "linear/tetrahedron.h"
#include "robot/spheres/spheres.h"
#include "tools/heap.h"

double spheres_cell_halve(const spheres_cell *cell, spheres_cell half[2]) {
    vec3 halves[2][4];
    double longest = tetrahedron_halve(cell->corner, halves);
    half[0] = half[1] = *cell;
    for (int i = 0; i < 2; i++) {
        // The half at the end of the edge comes first.
        memcpy(half[i].corner, halves[1 - i], sizeof half[i].corner);
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
    (void)tetrahedron_find_longest_edge(cell->corner, &a.edge_squared);
    return a;
}

// The side of a box, grown to multiples of the step.
static void grow(double step, double *low, double *high) {
    *low = (floor(*low / step) - 1) * step;
    *high = (ceil(*high / step) + 1) * step;
}

// Coordinates have 13 bits at first, and each halving adds one at most.
void spheres_cell_make_box(box b, spheres_cell cells[6]) {
    double step = ldexp(1, find_unit_exponent(max2(vec3_max_abs(b.min), vec3_max_abs(b.max))) - 12);
    grow(step, &b.min.x, &b.max.x);
    grow(step, &b.min.y, &b.max.y);
    grow(step, &b.min.z, &b.max.z);
    double volume = (b.max.x - b.min.x) * (b.max.y - b.min.y) * (b.max.z - b.min.z) / 6;
    vec3 corners[6][4];
    tetrahedra_fill_box(&b, corners);
    for (int i = 0; i < 6; i++) {
        cells[i] = (spheres_cell){.volume = volume};
        memcpy(cells[i].corner, corners[i], sizeof corners[i]);
    }
}

static int is_worse(const void *a, const void *b) {
    return ((const spheres_cell *)a)->key > ((const spheres_cell *)b)->key;
}

void spheres_heap_push(spheres_heap *all, const spheres_cell *cell) {
    heap_push((heap){all->cells, all->count++, sizeof *cell, is_worse}, cell);
}

spheres_cell spheres_heap_pop(spheres_heap *all) {
    spheres_cell top;
    heap_pop((heap){all->cells, all->count--, sizeof top, is_worse}, &top);
    return top;
}

// The zero on the edge from a corner with value a <= 0 to one with b > 0.
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
