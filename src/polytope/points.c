// From the user's points to distinct points in the body frame.
//
// Body frame. A component of the origin is zero unless the points lie farther than four times their size from zero
// along it; then it is the centre rounded to a multiple of a power of two near the size. Every coordinate is then a
// multiple of an ulp that divides the origin too, and the difference is smaller than the coordinate, so it is exact.
// This is checked for every point, and the component falls back to zero if it fails.
//
// Grid. Signs of determinants are computed from coordinates scaled by a power of two, so that the largest lies between
// 2^239 and 2^240, and rounded to multiples of 2^-340. Then no product of three differences can overflow or underflow
// (2^-340 cubed is 2^-1020), so the signs are those of exact arithmetic, for bodies of any size. The grid loses less
// than 2^-580, or 1e-174, of the body's size: the only rounding in this folder.
//
// Distinct points are found with a hash table of open addresses. Cost: linear; 8 to 16 bytes a point for the table.
#include "polytope/points.h"

#include "base/allocator.h"
#include "base/error.h"
#include "linear/exact.h"
#include "tools/hash.h"

#include <string.h>

#define GRID_TOP 240
#define NOTHING UINT32_MAX

typedef struct bounds {
    double low[3], high[3];
} bounds;

// Checks that all points are finite and in range, and finds their bounds.
static ovoid_code validate_points(const double *xyz, size_t count, bounds *b, ovoid_error *error) {
    for (int c = 0; c < 3; c++) b->low[c] = INFINITY, b->high[c] = -INFINITY;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            double v = xyz[3 * i + (size_t)c];
            if (!isfinite(v))
                return error_set(error, OVOID_ERROR_NOT_FINITE, (int64_t)i, "point %zu: coordinate %c is %s", i,
                                 "xyz"[c], isnan(v) ? "not a number" : "infinite");
            if (fabs(v) > OVOID_LENGTH_MAX)
                return error_set(error, OVOID_ERROR_RANGE, (int64_t)i, "point %zu: %c = %g is beyond %g", i, "xyz"[c],
                                 v, OVOID_LENGTH_MAX);
            b->low[c] = min2(b->low[c], v);
            b->high[c] = max2(b->high[c], v);
        }
    return OVOID_OK;
}

// The component of the origin, for points between low and high of a body of that size.
static double choose_origin(double low, double high, double size) {
    double center = low / 2 + high / 2;
    if (!(fabs(center) > 4 * size)) return 0;
    if (low == high) return low;
    int e;
    (void)frexp(size, &e);
    // Beyond 2^53 units every double is a multiple of the unit.
    double units = ldexp(center, -e);
    return fabs(units) < 0x1p53 ? ldexp(rint(units), e) : center;
}

static vec3 make_origin(const double *xyz, size_t count, const bounds *b) {
    const double *low = b->low, *high = b->high;
    double size = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2])), origin[3];
    for (int c = 0; c < 3; c++) origin[c] = choose_origin(low[c], high[c], size);
    if (origin[0] == 0 && origin[1] == 0 && origin[2] == 0) return (vec3){0, 0, 0};
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            if (two_sum(xyz[3 * i + (size_t)c], -origin[c]).low != 0) origin[c] = 0;
    return (vec3){origin[0], origin[1], origin[2]};
}

// Points by their values: slots with indices, and the points.
typedef struct point_slots {
    const uint32_t *slots;
    const double *xyz;
} point_slots;

static int is_end(const void *table, size_t slot, const void *key) {
    const point_slots *t = table;
    return t->slots[slot] == NOTHING || hash_is_same_point(t->xyz + 3 * (size_t)t->slots[slot], key);
}

int points_find_first(const double *xyz, size_t count, const ovoid_allocator *allocator, uint32_t *first) {
    size_t capacity = 16;
    while (capacity < 2 * count) capacity *= 2;
    uint32_t *table = allocator_allocate(allocator, capacity, sizeof *table);
    if (!table) return 0;
    memset(table, 0xff, capacity * sizeof *table);
    for (size_t i = 0; i < count; i++) {
        const double *a = xyz + 3 * i;
        size_t slot = hash_find(hash_point(a), capacity, &(point_slots){table, xyz}, a, is_end);
        if (table[slot] == NOTHING) table[slot] = (uint32_t)i;
        first[i] = table[slot];
    }
    allocator_release(allocator, table);
    return 1;
}

// Leaves in p->source the points that do not equal an earlier one.
static int drop_duplicates(const double *xyz, const ovoid_allocator *allocator, points *p) {
    uint32_t *source = p->source, count = p->count, kept = 0;
    if (!points_find_first(xyz, count, allocator, source)) return 0;
    for (uint32_t i = 0; i < count; i++)
        if (source[i] == i) source[kept++] = i;
    p->duplicates = count - kept;
    p->count = kept;
    return 1;
}

// A coordinate of the body frame in units of the grid: times 2^e in two factors, as 2^e may not be a double; below
// 2^-288 doubles are finer than the grid.
static double snap(double v, const double factor[2]) {
    v = v * factor[0] * factor[1];
    return fabs(v) < 0x1p-288 ? rint(v * 0x1p340) * 0x1p-340 : v;
}

static void fill_grid(const double *xyz, points *p) {
    const double origin[3] = {p->origin.x, p->origin.y, p->origin.z};
    double top = 0;
    for (uint32_t i = 0; i < p->count; i++)
        for (size_t c = 0; c < 3; c++) top = max2(top, fabs(xyz[3 * (size_t)p->source[i] + c] - origin[c]));
    int e = 0;
    (void)frexp(top, &e);
    e = GRID_TOP - e;
    p->factor[0] = ldexp(1, e / 2);
    p->factor[1] = ldexp(1, e - e / 2);
    for (uint32_t i = 0; i < p->count; i++)
        for (size_t c = 0; c < 3; c++)
            p->grid[3 * (size_t)i + c] = snap(xyz[3 * (size_t)p->source[i] + c] - origin[c], p->factor);
}

vec3 points_to_grid(const points *p, vec3 v) {
    return (vec3){snap(v.x, p->factor), snap(v.y, p->factor), snap(v.z, p->factor)};
}

static ovoid_code create(xyz_points given, const ovoid_allocator *allocator, points *p, ovoid_error *error) {
    size_t count = given.count;
    *p = (points){0};
    if (count == 0) return error_set(error, OVOID_ERROR_EMPTY, -1, "no points");
    if (count > POINTS_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu points; at most %zu are taken", count, POINTS_MAX);
    bounds b;
    ovoid_code code = validate_points(given.xyz, count, &b, error);
    if (code) return code;
    p->origin = make_origin(given.xyz, count, &b);
    p->source = allocator_allocate(allocator, count, sizeof *p->source);
    if (!p->source) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu points", count);
    p->count = (uint32_t)count;
    for (uint32_t i = 0; i < p->count; i++) p->source[i] = i;
    return OVOID_OK;
}

static ovoid_code fail_memory(points *p, const ovoid_allocator *allocator, ovoid_error *error) {
    uint32_t count = p->count;
    points_destroy(p, allocator);
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %u points", count);
}

// The grid of the points in p->source.
static ovoid_code finish(const double *xyz, const ovoid_allocator *allocator, points *p, ovoid_error *error) {
    p->grid = allocator_allocate(allocator, p->count, 3 * sizeof *p->grid);
    if (!p->grid) return fail_memory(p, allocator, error);
    fill_grid(xyz, p);
    return OVOID_OK;
}

ovoid_code points_create(xyz_points given, const ovoid_allocator *allocator, points *p, ovoid_error *error) {
    ovoid_code code = create(given, allocator, p, error);
    if (code) return code;
    if (!drop_duplicates(given.xyz, allocator, p)) return fail_memory(p, allocator, error);
    return finish(given.xyz, allocator, p, error);
}

ovoid_code points_create_distinct(xyz_points given, const ovoid_allocator *allocator, points *p, ovoid_error *error) {
    ovoid_code code = create(given, allocator, p, error);
    return code ? code : finish(given.xyz, allocator, p, error);
}

void points_destroy(points *p, const ovoid_allocator *allocator) {
    allocator_release(allocator, p->grid);
    allocator_release(allocator, p->source);
    *p = (points){0};
}

void points_keep(points *p, const uint8_t *keep) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        if (!keep[i]) continue;
        memmove(p->grid + 3 * (size_t)kept, p->grid + 3 * (size_t)i, 3 * sizeof *p->grid);
        p->source[kept++] = p->source[i];
    }
    p->count = kept;
}
