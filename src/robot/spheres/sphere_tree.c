// Spheres in a tree of boxes around their centres, halved at the median of the longest side. A search for the sphere
// that holds a cell best leaves out what is too far, so a thousand spheres cost little more than ten.
#include "base/error.h"
#include "robot/spheres/spheres.h"

#include <stdlib.h>

enum { MOST_SPHERES = 1 << 20, LEAF = 4 };

ovoid_code spheres_validate(const ovoid_robot_sphere *spheres, size_t count, ovoid_error *error) {
    if (!spheres || count == 0) return error_set(error, OVOID_ERROR_EMPTY, -1, "no spheres: give at least one");
    if (count > MOST_SPHERES)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu spheres are more than %d", count, MOST_SPHERES);
    for (size_t i = 0; i < count; i++) {
        const ovoid_robot_sphere *s = &spheres[i];
        if (!vec3_is_finite(s->center) || !isfinite(s->radius))
            return error_set(error, OVOID_ERROR_NOT_FINITE, (int64_t)i,
                             "sphere %zu: a coordinate or the radius is NaN or infinite", i);
        if (s->radius < 0)
            return error_set(error, OVOID_ERROR_RADIUS, (int64_t)i,
                             "sphere %zu has the radius %g; it must not be negative", i, s->radius);
        if (vec3_max_abs(s->center) > OVOID_LENGTH_MAX || s->radius > OVOID_LENGTH_MAX)
            return error_set(error, OVOID_ERROR_RANGE, (int64_t)i, "sphere %zu: a length above %g", i,
                             OVOID_LENGTH_MAX);
    }
    return OVOID_OK;
}

// A sphere on its way into the tree.
typedef struct entry {
    ovoid_robot_sphere sphere;
    double key;
    uint32_t given;
} entry;

static int compare(const void *x, const void *y) {
    const entry *a = x, *b = y;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return a->given < b->given ? -1 : 1;
}

static void fill_node(spheres_node *node, const entry *entries, uint32_t first, uint32_t count) {
    *node = (spheres_node){.centers = box_make_empty(), .first = first, .count = count};
    for (uint32_t i = first; i < first + count; i++) {
        vec3 c = entries[i].sphere.center;
        box at = {c, c};
        node->centers = box_join(&node->centers, &at);
        node->most = max2(node->most, entries[i].sphere.radius);
    }
}

static void sort_along(const box *b, entry *entries, uint32_t count) {
    double x = b->max.x - b->min.x, y = b->max.y - b->min.y, z = b->max.z - b->min.z;
    for (uint32_t i = 0; i < count; i++) {
        vec3 c = entries[i].sphere.center;
        entries[i].key = x >= y && x >= z ? c.x : y >= z ? c.y : c.z;
    }
    qsort(entries, count, sizeof *entries, compare);
}

static void build(spheres_tree *tree, entry *entries) {
    fill_node(&tree->nodes[0], entries, 0, tree->count);
    for (uint32_t i = 0; i + 1 < tree->leaves; i++) {
        const spheres_node *n = &tree->nodes[i];
        if (n->count) sort_along(&n->centers, entries + n->first, n->count);
        uint32_t half = n->count / 2;
        fill_node(&tree->nodes[2 * i + 1], entries, n->first, half);
        fill_node(&tree->nodes[2 * i + 2], entries, n->first + half, n->count - half);
    }
    for (uint32_t i = 0; i < tree->count; i++) tree->items[i] = entries[i].sphere, tree->given[i] = entries[i].given;
}

ovoid_code spheres_tree_open(spheres_tree *tree, const ovoid_robot_sphere *spheres, size_t count,
                             const spheres_link *link, ovoid_error *error) {
    *tree = (spheres_tree){.count = (uint32_t)count, .leaves = 1, .memory = link->memory};
    while ((size_t)tree->leaves * LEAF < count) tree->leaves *= 2;
    entry *entries = allocator_allocate(&tree->memory, count, sizeof *entries);
    tree->items = allocator_allocate(&tree->memory, count, sizeof *tree->items);
    tree->given = allocator_allocate(&tree->memory, count, sizeof *tree->given);
    tree->nodes = allocator_allocate(&tree->memory, 2 * (size_t)tree->leaves, sizeof *tree->nodes);
    int complete = entries && tree->items && tree->given && tree->nodes;
    if (complete) {
        for (uint32_t i = 0; i < count; i++) {
            ovoid_robot_sphere s = {vec3_scale(spheres[i].center, 1 / link->unit), spheres[i].radius / link->unit};
            entries[i] = (entry){s, 0, i};
        }
        build(tree, entries);
    } else
        spheres_tree_close(tree);
    allocator_release(&link->memory, entries);
    return complete ? OVOID_OK : error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu spheres", count);
}

void spheres_tree_close(spheres_tree *tree) {
    allocator_release(&tree->memory, tree->nodes);
    allocator_release(&tree->memory, tree->given);
    allocator_release(&tree->memory, tree->items);
}

// A search for the sphere that holds corners best.
typedef struct least_search {
    const spheres_tree *tree;
    const vec3 *corners;
    int count;
    double sign; ///< of the rounding that is added: 1 or -1
    double least;
    uint32_t nearest;
} least_search;

static double distance_to(vec3 a, vec3 b) {
    vec3 d = vec3_sub(a, b);
    double size = vec3_max_abs(d);
    // Spheres may be far beyond the link; their squares must not overflow.
    return size < 1e100 ? vec3_norm(d) : size * vec3_norm(vec3_scale(d, 1 / size));
}

static double find_far(const least_search *s, vec3 center) {
    double most = 0;
    for (int k = 0; k < s->count; k++) most = max2(most, distance_to(s->corners[k], center));
    return most;
}

// The greatest distance of a sphere's surface from the corners. The root of the greatest square is the greatest root.
static double measure(const least_search *s, uint32_t i) {
    const ovoid_robot_sphere *ball = &s->tree->items[i];
    double square = 0;
    for (int k = 0; k < s->count; k++) square = max2(square, vec3_norm_squared(vec3_sub(s->corners[k], ball->center)));
    double most = square < 1e200 ? sqrt(square) : find_far(s, ball->center);
    return most - ball->radius + s->sign * spheres_round(most, ball->radius);
}

static void look_at_leaf(least_search *s, const spheres_node *node) {
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        // One corner is too far: the others need not be measured.
        const ovoid_robot_sphere *ball = &s->tree->items[i];
        double reach = (s->least + ball->radius) + 64 * ROUNDING * (fabs(s->least) + 2 * ball->radius),
               square = vec3_norm_squared(vec3_sub(s->corners[0], ball->center));
        if (reach >= 0 && square * (1 - 0x1p-40) > reach * reach) continue;
        double value = measure(s, i);
        if (value < s->least) s->least = value, s->nearest = i;
    }
}

// Below what no sphere of the node comes: of the first corner.
static double bound_node(const least_search *s, uint32_t i) {
    const spheres_node *n = &s->tree->nodes[i];
    if (n->count == 0) return INFINITY;
    box corner = {s->corners[0], s->corners[0]};
    double distance = box_compute_distance(&corner, &n->centers);
    if (!(distance < 1e100)) distance = 0;
    return distance - n->most - spheres_round(distance, n->most);
}

static void look_below(least_search *s, uint32_t i) {
    if (i + 1 >= s->tree->leaves) {
        look_at_leaf(s, &s->tree->nodes[i]);
        return;
    }
    double a = bound_node(s, 2 * i + 1), b = bound_node(s, 2 * i + 2);
    uint32_t first = a <= b ? 2 * i + 1 : 2 * i + 2, second = a <= b ? 2 * i + 2 : 2 * i + 1;
    if (min2(a, b) < s->least) look_below(s, first);
    if (max2(a, b) < s->least) look_below(s, second);
}

double spheres_tree_find_least(const spheres_tree *tree, const vec3 *corners, int count, uint32_t *nearest) {
    least_search s = {tree, corners, count, 1, INFINITY, *nearest};
    s.least = measure(&s, s.nearest);
    look_below(&s, 0);
    *nearest = s.nearest;
    return s.least;
}

double spheres_tree_find_value(const spheres_tree *tree, vec3 x, uint32_t *nearest) {
    least_search s = {tree, &x, 1, -1, INFINITY, 0};
    look_below(&s, 0);
    *nearest = s.nearest;
    return s.least;
}

double spheres_tree_measure_greatest(const spheres_tree *tree, uint32_t sphere, const vec3 corners[4]) {
    return measure(&(least_search){tree, corners, 4, 1, INFINITY, 0}, sphere);
}
double spheres_tree_measure_value(const spheres_tree *tree, uint32_t sphere, vec3 x) {
    return measure(&(least_search){tree, &x, 1, -1, INFINITY, 0}, sphere);
}

// Adds what the spheres at a leaf hold of a cell. Of a ball, |x - c|^2 - r^2 is at most its linear interpolant between
// the corners, and at least that minus sum_i<j l_i l_j |v_i - v_j|^2 <= 3/8 of the longest edge's square (l:
// barycentric; the sum of products is greatest at 1/4 each). Both in units of s = max(1, r).
static void add_ball(const spheres_cell *cell, const ovoid_robot_sphere *ball, double edge_squared,
                     ovoid_robot_bracket *share) {
    double low[4], high[4], unit = max2(1, ball->radius);
    for (int k = 0; k < 4; k++) {
        double d = distance_to(cell->corner[k], ball->center), sum = d + ball->radius;
        double value = (d - ball->radius) * (sum / unit), error = 16 * ROUNDING * sum * (sum / unit);
        high[k] = value + error;
        low[k] = value - error - 0.375 * (1 + 16 * ROUNDING) * edge_squared / unit;
    }
    share->lower = max2(share->lower, spheres_compute_share(high) * (1 - 0x1p-46));
    share->upper += spheres_compute_share(low) * (1 + 0x1p-46);
}

// A ball that holds a cell ends the search.
static void add_below(const spheres_tree *tree, uint32_t i, const spheres_cell *cell, const sphere_of_cell *around,
                      ovoid_robot_bracket *share) {
    const spheres_node *n = &tree->nodes[i];
    if (n->count == 0 || share->lower >= 1) return;
    box middle = {around->middle, around->middle};
    double reach = (n->most + around->radius) * (1 + 0x1p-40);
    if (box_compute_distance(&middle, &n->centers) > reach) return;
    if (i + 1 < tree->leaves) {
        add_below(tree, 2 * i + 1, cell, around, share);
        add_below(tree, 2 * i + 2, cell, around, share);
        return;
    }
    for (uint32_t k = n->first; k < n->first + n->count && share->lower < 1; k++)
        if (distance_to(around->middle, tree->items[k].center) <=
            (tree->items[k].radius + around->radius) * (1 + 0x1p-40))
            add_ball(cell, &tree->items[k], around->edge_squared, share);
}

ovoid_robot_bracket spheres_tree_find_share(const spheres_tree *tree, const spheres_cell *cell,
                                            const sphere_of_cell *around) {
    ovoid_robot_bracket share = {0, 0};
    add_below(tree, 0, cell, around, &share);
    return (ovoid_robot_bracket){min2(share.lower, 1), min2(share.upper, 1)};
}
