// If no single plane gains much, choose the plane that gains most together with a second one. A hole through a box is
// an example: the hull of the box and the hulls of both halves contain the hole, and only the hulls of quarters leave
// some of it out. Wei et al., 2022, search a tree of cuts; two steps, only where one does not help, proved to be
// enough.
#include "decompose/piece.h"

/// One plane is enough if less than this share of the cost remains.
#define ENOUGH 0.8

// The cost that remains after the best plane of each side, both together; infinite if the plane does not cut the piece.
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
    // The best single plane is one of them, so two steps are compared with two steps.
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
