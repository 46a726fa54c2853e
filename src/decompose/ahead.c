// Where no single plane gains much, the one that gains most with another after it. A hole through a box is such a case:
// its hull and those of both halves hold the hole all the same, and only quarters let some of it go. Wei et al., 2022,
// search a tree of cuts; two steps, and these only where one does not help, are what was found to matter.
#include "decompose/piece.h"

/// One plane is enough where it leaves less than this share.
#define ENOUGH 0.8

// What the best plane of each side leaves, both together; infinite where the plane does not cut the piece.
static ovoid_code find_second(const body *b, const piece *p, const ovoid_plane *plane, double *left,
                              ovoid_error *error) {
    piece sides[2];
    int is_cut;
    *left = INFINITY;
    ovoid_code code = piece_divide(b, p, plane, sides, &is_cut, error);
    if (code != OVOID_OK || !is_cut) return code;
    *left = 0;
    for (int i = 0; i < 2; i++) {
        ovoid_plane second;
        if (sides[i].outlier_count) *left += piece_find_plane(b, &sides[i], &second);
        piece_destroy(b, &sides[i]);
    }
    return OVOID_OK;
}

ovoid_code piece_choose_plane(const body *b, const piece *p, ovoid_plane *plane, int *is_found, ovoid_error *error) {
    double best = piece_find_plane(b, p, plane), enough = ENOUGH * piece_compute_cost(p);
    *is_found = best < INFINITY;
    if (best <= enough) return OVOID_OK;
    // The best alone is one of them, so that what is compared is two steps each.
    ovoid_plane planes[PIECE_PLANES + 1];
    uint32_t count = piece_list_planes(b, p, planes);
    if (*is_found) planes[count++] = *plane;
    best = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double left;
        ovoid_code code = find_second(b, p, &planes[i], &left, error);
        if (code != OVOID_OK) return code;
        if (left < best) best = left, *plane = planes[i], *is_found = 1;
    }
    return OVOID_OK;
}
