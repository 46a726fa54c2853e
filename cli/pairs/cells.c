#include "pairs/cells.h"

#include "tools/hash.h"

#include <math.h>

/// Points first..end - 1, that become `cells` cells from number `cell` on, and their weight.
typedef struct range {
    size_t first, end;
    double weight;
    uint32_t cell, cells;
} range;

static int find_axis(const cell_point *points, range r) {
    double best = -1;
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (size_t i = r.first; i < r.end; i++) {
            double at = points[i].at[k];
            low = at < low ? at : low;
            high = at > high ? at : high;
        }
        if (high - low > best) best = high - low, axis = k;
    }
    return axis;
}

static void swap(cell_point *a, cell_point *b) {
    cell_point kept = *a;
    *a = *b;
    *b = kept;
}

/// The points of a range below a pivot, those at it, and the weights of both.
typedef struct sides {
    size_t low, high;
    double below, at;
} sides;

/// Puts points below the pivot first, then those at it.
static sides partition(cell_point *points, range r, int axis, double pivot) {
    sides s = {r.first, r.end, 0, 0};
    for (size_t i = r.first; i < s.high;) {
        double at = points[i].at[axis];
        if (at > pivot) {
            swap(&points[i], &points[--s.high]);
            continue;
        }
        if (at < pivot) {
            s.below += points[i].weight;
            if (i > s.low) swap(&points[i], &points[s.low]);
            s.low++;
        } else {
            s.at += points[i].weight;
        }
        i++;
    }
    return s;
}

/// The middle one of three points along the axis, at places by a hash.
static double find_pivot(const cell_point *points, range r, int axis) {
    uint64_t hash = hash_pair((uint32_t)r.first, (uint32_t)r.end);
    size_t count = r.end - r.first;
    double a = points[r.first + (size_t)(hash % count)].at[axis];
    double b = points[r.first + (size_t)((hash >> 14) % count)].at[axis], c = points[r.first + count / 2].at[axis];
    return a < b ? (b < c ? b : a < c ? c : a) : (a < c ? a : b < c ? c : b);
}

/// Where the first points, sorted along the axis, have the weight, within one point. Quickselect (C. A. R. Hoare,
/// Algorithm 65: Find, 1961).
static size_t select_weight(cell_point *points, range r, int axis, double weight) {
    while (r.end - r.first > 1) {
        sides s = partition(points, r, axis, find_pivot(points, r, axis));
        if (weight < s.below) {
            r.end = s.low;
        } else if (weight < s.below + s.at || s.high == r.end) {
            // Those at the pivot are in no order: any of them may be before the cut.
            weight -= s.below;
            for (r.first = s.low; r.first < s.high && weight >= points[r.first].weight / 2; r.first++)
                weight -= points[r.first].weight;
            return r.first;
        } else {
            weight -= s.below + s.at;
            r.first = s.high;
        }
    }
    return r.first + (r.first < r.end && weight >= points[r.first].weight / 2);
}

static double sum_weights(const cell_point *points, size_t first, size_t end) {
    double sum = 0;
    for (size_t i = first; i < end; i++) sum += points[i].weight;
    return sum;
}

void cells_make(cell_point *points, size_t count, uint32_t cells) {
    // Each halving halves the number of cells, so the stack is as deep as that number has bits.
    range stack[40], r = {0, count, sum_weights(points, 0, count), 0, cells};
    for (int depth = 0;;) {
        if (r.cells > 1 && r.end - r.first > 1) {
            uint32_t half = r.cells / 2;
            double share = r.weight * half / r.cells;
            size_t cut = select_weight(points, r, find_axis(points, r), share);
            double left = sum_weights(points, r.first, cut);
            stack[depth++] = (range){cut, r.end, r.weight - left, r.cell + half, r.cells - half};
            r = (range){r.first, cut, left, r.cell, half};
            continue;
        }
        for (size_t i = r.first; i < r.end; i++) points[i].cell = r.cell;
        if (!depth) return;
        r = stack[--depth];
    }
}
