// The hull and the measures of a box, as constants and closed forms.
#include "polytope/centered_box.h"

#include "linear/vec3.h"

// Two triangles a facet; which diagonal divides it is free.
const uint32_t centered_box_triangles[3 * BOX_TRIANGLES] = {7, 4, 5, 1, 0, 2, 0, 1, 4, 1, 7, 5, 7, 1, 3, 1, 2, 3,
                                                            2, 7, 3, 7, 2, 6, 2, 0, 4, 4, 1, 5, 2, 4, 6, 4, 7, 6};
const uint32_t centered_box_triangle_facets[BOX_TRIANGLES] = {0, 1, 2, 3, 3, 1, 4, 4, 5, 2, 5, 0};

// Ends of the triangles' edges, ascending.
const uint32_t centered_box_neighbor_starts[BOX_VERTICES + 1] = {0, 3, 9, 15, 18, 24, 27, 30, 36};
const uint32_t centered_box_neighbors[BOX_NEIGHBORS] = {1, 2, 4, 0, 2, 3, 4, 5, 7, 0, 1, 3, 4, 6, 7, 1, 2, 7,
                                                        0, 1, 2, 5, 6, 7, 1, 4, 7, 2, 4, 7, 1, 2, 3, 4, 5, 6};

int centered_box_find(const double *vertices, size_t count, vec3 *half) {
    if (count != BOX_VERTICES) return 0;
    vec3 h = vec3_neg(vec3_at(vertices, 0));
    double most = fmax(h.x, fmax(h.y, h.z));
    if (!(most >= 0x1p-200 && most <= OVOID_LENGTH_MAX)) return 0;
    const double size[3] = {h.x, h.y, h.z};
    for (size_t k = 0; k < 3; k++)
        if (!(size[k] >= 0x1p-18 * most)) return 0;
    for (size_t i = 1; i < BOX_VERTICES; i++)
        for (size_t k = 0; k < 3; k++)
            if (!(vertices[3 * i + k] == (i >> k & 1 ? size[k] : -size[k]))) return 0;
    *half = h;
    return 1;
}

void centered_box_fill_planes(vec3 half, ovoid_plane planes[BOX_FACETS]) {
    planes[0] = (ovoid_plane){{0, 0, 1}, half.z};
    planes[1] = (ovoid_plane){{0, 0, -1}, half.z};
    planes[2] = (ovoid_plane){{0, -1, 0}, half.y};
    planes[3] = (ovoid_plane){{1, 0, 0}, half.x};
    planes[4] = (ovoid_plane){{0, 1, 0}, half.y};
    planes[5] = (ovoid_plane){{-1, 0, 0}, half.x};
}

ovoid_measures centered_box_compute_measures(vec3 half) {
    double volume = 8 * half.x * half.y * half.z, part = volume / 3;
    double xx = half.x * half.x, yy = half.y * half.y, zz = half.z * half.z;
    return (ovoid_measures){.volume = volume,
                            .area = 8 * (half.x * half.y + half.y * half.z + half.z * half.x),
                            .inertia = {part * (yy + zz), 0, 0, part * (xx + zz), 0, part * (xx + yy)},
                            .box = {vec3_neg(half), half}};
}
