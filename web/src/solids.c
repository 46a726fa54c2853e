// Solids of triangles: made, described.
#include "ovoid/solid.h"
#include "src/exchange.h"

ovoid_solid *EXPORT(solid_create)(const double *xyz, size_t point_count, const uint32_t *indices, size_t count) {
    return ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, point_count, indices, count}, NULL,
                                             &exchange_error);
}
void EXPORT(solid_destroy)(ovoid_solid *solid) { ovoid_solid_destroy(solid); }

/// The hull of its points.
ovoid_shape *EXPORT(solid_create_hull)(const ovoid_solid *solid) {
    size_t count = (size_t)ovoid_solid_get_report(solid).points;
    return ovoid_shape_create_from_points(ovoid_solid_get_points(solid), count, NULL, &exchange_error);
}

/// Points, triangles, components, unmatched and crowded edges, degenerate, duplicates, closed, volume, area, box.
void EXPORT(solid_describe)(const ovoid_solid *solid) {
    ovoid_solid_report r = ovoid_solid_get_report(solid);
    double *to = exchange;
    *to++ = (double)r.points, *to++ = (double)r.triangles, *to++ = (double)r.components;
    *to++ = (double)r.edges_unmatched, *to++ = (double)r.edges_crowded, *to++ = (double)r.degenerate;
    *to++ = (double)r.duplicates, *to++ = r.is_closed, *to++ = r.volume, *to++ = r.area;
    write_vec3(write_vec3(to, r.box.min), r.box.max);
}
