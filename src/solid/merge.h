// Triangles with merged points: the points that triangles use, each once, in the order of their first use.
#ifndef OVOID_SOLID_MERGE_H
#define OVOID_SOLID_MERGE_H

#include "solid/solid.h"

/// Merged points and triangles, with a table of open addresses over the points.
typedef struct solid_merger {
    double *points;
    solid_triangle *triangles;
    uint32_t *table;  ///< a point, or UINT32_MAX
    uint32_t *merged; ///< for each given point its merged point, or UINT32_MAX
    uint32_t mask, count;
} solid_merger;

/// Refuses what ovoid_solid_create_from_triangles refuses.
ovoid_code solid_validate_triangles(const ovoid_triangles *given, ovoid_error *error);

/// Merges triangles that were validated; 0 if memory runs out, with nothing allocated.
int merger_make(solid_merger *merger, const ovoid_triangles *given, const ovoid_allocator *allocator);
void merger_destroy(solid_merger *merger, const ovoid_allocator *allocator);

/// The merged point with these coordinates, or UINT32_MAX.
uint32_t merger_find(const solid_merger *merger, vec3 point);

#endif
