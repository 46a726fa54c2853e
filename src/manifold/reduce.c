// Four corners of a polygon: the deepest one, and those that span the most area with it. From a fixed corner the
// triangle over a diagonal grows up to its best tip and shrinks behind it, and the best tips move on with the
// diagonal's end: so the best quadrilateral of one corner is found in linear time. Where many corners are equally deep,
// as of a face on a face, the best of up to eight of them is taken: up to eight corners it is the best quadrilateral.
#include "manifold/manifold.h"

// A choice must be better by this part to replace an equal one, so that rounding does not choose.
#define BETTER (1 + 1e-6)

enum { STARTS = 8 };

// Twice the area of a triangle of corners.
static double get_area(const manifold_corner *c, uint32_t i, uint32_t j, uint32_t k) {
    return (c[j].x - c[i].x) * (c[k].y - c[i].y) - (c[j].y - c[i].y) * (c[k].x - c[i].x);
}
static double get_area_of_four(const manifold_corner *c, const uint32_t at[4]) {
    return get_area(c, at[0], at[1], at[2]) + get_area(c, at[0], at[2], at[3]);
}

int polygon_find_corner(const manifold_polygon *p, uint32_t id) {
    for (uint32_t i = 0; i < p->count; i++)
        if (p->corners[i].id == id) return (int)i;
    return -1;
}

double polygon_compute_share(const manifold_polygon *p, const corner_choice *choice) {
    // Of slivers rounding may leave the whole less than its part.
    return choice->count == 4 && p->area > 0 ? min2(get_area_of_four(p->corners, choice->index) / (2 * p->area), 1) : 1;
}

// A polygon of which four corners are wanted.
typedef struct reduction {
    const manifold_polygon *polygon;
    double gap, deep; ///< no corner counts as deeper than the gap; a corner up to `deep` is a deepest one
    uint32_t best[4]; ///< ascending
    double area;      ///< twice theirs
} reduction;

static int is_deep(const reduction *r, uint32_t i) {
    return max2(r->polygon->corners[i].separation, r->gap) <= r->deep;
}

static void sort_four(uint32_t at[4]) {
    for (int i = 1; i < 4; i++)
        for (int k = i; k > 0 && at[k - 1] > at[k]; k--) {
            uint32_t swapped = at[k];
            at[k] = at[k - 1];
            at[k - 1] = swapped;
        }
}

static void take(reduction *r, const uint32_t at[4], double area) {
    if (!(area > r->area * BETTER)) return;
    r->area = area;
    for (int c = 0; c < 4; c++) r->best[c] = at[c];
}

// The best quadrilateral with corner i: over each diagonal from it the best tip on each side.
static void choose_from(reduction *r, uint32_t i) {
    const manifold_polygon *p = r->polygon;
    uint32_t count = p->count, right = (i + 1) % count, left = (i + 3) % count;
    for (uint32_t step = 2; step + 1 < count; step++) {
        uint32_t k = (i + step) % count;
        double area = get_area(p->corners, i, right, k), more;
        for (uint32_t next = (right + 1) % count; next != k; next = (right + 1) % count) {
            more = get_area(p->corners, i, next, k);
            if (!(more > area * BETTER)) break;
            area = more;
            right = next;
        }
        if (left == k) left = (k + 1) % count;
        double other = get_area(p->corners, i, k, left);
        for (uint32_t next = (left + 1) % count; next != i; next = (left + 1) % count) {
            more = get_area(p->corners, i, k, next);
            if (!(more > other * BETTER)) break;
            other = more;
            left = next;
        }
        const uint32_t at[4] = {i, right, k, left};
        take(r, at, area + other);
    }
}

// Of the deepest corners at most STARTS, evenly.
static void choose(reduction *r) {
    uint32_t count = 0, seen = 0;
    for (uint32_t i = 0; i < r->polygon->count; i++) count += (uint32_t)is_deep(r, i);
    uint32_t stride = (count + STARTS - 1) / STARTS;
    for (uint32_t i = 0; i < r->polygon->count; i++)
        if (is_deep(r, i) && seen++ % stride == 0) choose_from(r, i);
    sort_four(r->best);
}

// The places of the earlier corners, in the polygon's order; 0 if not all four are there.
static int find_earlier(const manifold_polygon *p, const ovoid_manifold *earlier, uint32_t at[4]) {
    uint32_t count = 0;
    for (uint32_t i = 0; earlier && earlier->count == 4 && i < p->count && count < 4; i++)
        for (int c = 0; c < 4; c++)
            if (p->corners[i].id == earlier->id[c]) {
                at[count++] = i;
                break;
            }
    return count == 4;
}

// The earlier corners; with the deepest one, if it is none of them, in the place of the one that is missed least.
static void keep(reduction *r, const uint32_t old[4]) {
    const manifold_corner *c = r->polygon->corners;
    uint32_t deepest = 0;
    for (uint32_t i = 1; i < r->polygon->count; i++)
        if (c[i].separation < c[deepest].separation) deepest = i;
    int has_deep = 0;
    for (int k = 0; k < 4; k++) has_deep |= is_deep(r, old[k]);
    if (has_deep) take(r, old, get_area_of_four(c, old));
    for (int k = 0; k < 4 && !has_deep; k++) {
        uint32_t at[4] = {old[0], old[1], old[2], old[3]};
        at[k] = deepest;
        sort_four(at);
        take(r, at, get_area_of_four(c, at));
    }
}

corner_choice corners_choose(const manifold_state *s, const ovoid_manifold *earlier, double slack) {
    const manifold_polygon *p = &s->polygon;
    corner_choice choice = {p->count, {0, 1, 2, 3}, 1};
    if (p->count <= 4) return choice;
    double least = INFINITY, all = 2 * p->area;
    for (uint32_t i = 0; i < p->count; i++) least = min2(least, p->corners[i].separation);
    double gap = s->frame.gap, deepest = max2(least, gap), snap = MANIFOLD_SNAP * s->frame.pair->size;
    reduction r = {p, gap, deepest + snap, {0, 1, 2, 3}, -1};
    uint32_t old[4];
    reduction kept = r;
    kept.deep = deepest + max2(snap, slack);
    if (find_earlier(p, earlier, old)) keep(&kept, old);
    int is_kept = kept.area >= 0 && earlier->corners > 4 && kept.area >= (earlier->share - 0.02) * all;
    if (!is_kept) {
        choose(&r);
        is_kept = kept.area >= 0.98 * r.area;
    }
    if (is_kept) r = kept;
    choice.count = 4;
    for (int c = 0; c < 4; c++) choice.index[c] = r.best[c];
    choice.share = all > 0 ? min2(r.area / all, 1) : 1;
    return choice;
}

void corner_choice_write(const corner_choice *choice, const manifold_polygon *p, ovoid_manifold *out) {
    out->count = (uint8_t)choice->count;
    out->corners = (uint16_t)p->count;
    out->share = (float)choice->share;
    for (uint32_t i = 0; i < choice->count; i++) out->id[i] = p->corners[choice->index[i]].id;
}
