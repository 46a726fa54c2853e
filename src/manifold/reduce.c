// Four corners of a polygon that span the most area: the best quadrilateral up to eight corners, and a local best
// above, where each corner is moved to its best place between its neighbors.
#include "manifold/manifold.h"

// A choice must be better by this part to replace an equal one, so that rounding does not choose.
#define BETTER (1 + 1e-6)

enum { EXHAUSTIVE = 8, SWEEPS = 16 };

// Twice the area of a triangle of corners.
static double get_area(const manifold_corner *c, uint32_t i, uint32_t j, uint32_t k) {
    return (c[j].x - c[i].x) * (c[k].y - c[i].y) - (c[j].y - c[i].y) * (c[k].x - c[i].x);
}
static double get_area_of_four(const manifold_corner *c, const uint32_t at[4]) {
    return get_area(c, at[0], at[1], at[2]) + get_area(c, at[0], at[2], at[3]);
}

// The corner that makes the largest triangle over i and k, of those from i + 1 on to before k.
static uint32_t find_tip(const manifold_polygon *p, uint32_t i, uint32_t k) {
    uint32_t best = (i + 1) % p->count;
    double most = get_area(p->corners, i, best, k);
    for (uint32_t j = best; j != k; j = (j + 1) % p->count) {
        double area = get_area(p->corners, i, j, k);
        if (area > most * BETTER) most = area, best = j;
    }
    return best;
}

// Over each diagonal the best tip on each side.
static double choose_exhaustively(const manifold_polygon *p, uint32_t best[4]) {
    double most = -1;
    for (uint32_t i = 0; i + 2 < p->count; i++)
        for (uint32_t k = i + 2; k < p->count - (i == 0); k++) {
            const uint32_t at[4] = {i, find_tip(p, i, k), k, find_tip(p, k, i)};
            double area = get_area_of_four(p->corners, at);
            if (!(area > most * BETTER)) continue;
            most = area;
            for (int c = 0; c < 4; c++) best[c] = at[c];
        }
    return most;
}

static double choose_by_ascent(const manifold_polygon *p, uint32_t best[4]) {
    double most = -1;
    for (uint32_t start = 0; start < 4 && start < (p->count + 3) / 4; start++) {
        uint32_t at[4];
        for (uint32_t c = 0; c < 4; c++) at[c] = (c * p->count / 4 + start) % p->count;
        double area = get_area_of_four(p->corners, at), before = -1;
        for (int sweep = 0; sweep < SWEEPS && area > before * BETTER; sweep++) {
            before = area;
            for (int c = 0; c < 4; c++) at[c] = find_tip(p, at[(c + 3) % 4], at[(c + 1) % 4]);
            area = get_area_of_four(p->corners, at);
        }
        if (!(area > most * BETTER)) continue;
        most = area;
        for (int c = 0; c < 4; c++) best[c] = at[c];
    }
    return most;
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

// Turns the corners, which go around, so that the first one comes first in the polygon.
static void begin_with_lowest(uint32_t at[4]) {
    while (at[0] > at[1] || at[0] > at[2] || at[0] > at[3]) {
        uint32_t first = at[0];
        for (int c = 0; c < 3; c++) at[c] = at[c + 1];
        at[3] = first;
    }
}

corner_choice corners_choose(const manifold_polygon *p, const ovoid_manifold *earlier) {
    corner_choice choice = {p->count, {0, 1, 2, 3}, 1};
    if (p->count <= 4) return choice;
    uint32_t old[4] = {0};
    double all = 2 * p->area, kept = find_earlier(p, earlier, old) ? get_area_of_four(p->corners, old) : -1;
    choice.count = 4;
    double most = kept;
    int is_kept = kept >= 0 && earlier->corners > 4 && kept >= (earlier->share - 0.02) * all;
    if (!is_kept) {
        uint32_t best[4] = {0};
        most = p->count <= EXHAUSTIVE ? choose_exhaustively(p, best) : choose_by_ascent(p, best);
        is_kept = kept >= 0.98 * most;
        for (int c = 0; c < 4 && !is_kept; c++) choice.index[c] = best[c];
    }
    for (int c = 0; c < 4 && is_kept; c++) choice.index[c] = old[c];
    begin_with_lowest(choice.index);
    if (is_kept) most = kept;
    choice.share = all > 0 ? min2(most / all, 1) : 1;
    return choice;
}
