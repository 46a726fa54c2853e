// What the areas of one polyhedron hold.
#ifndef OVOID_AREA_AREA_H
#define OVOID_AREA_AREA_H

#include "area/table.h"
#include "linear/mat3.h"
#include "ovoid/area.h"

struct ovoid_areas {
    ovoid_polytope polytope; ///< a view; borrowed
    vec3 center;
    sym3 root, inverse_root; ///< Q^1/2 and Q^-1/2, rounded
    uint32_t k;              ///< 0: octants
    vec3 *duals;             ///< of the facets, in sphere space: Q^1/2 n_j / (d_j - n_j . c)
    uint8_t *octants;        ///< of the facets: bit o where octant o lists the facet
    area_table by_octant;    ///< facets; what the rules that drop octants use
    area_table facets;       ///< facets by cube cell; empty where the split is octants
    area_table vertices;     ///< by cube cell, or octant
    ovoid_allocator allocator;
};

/// Q^1/2 and Q^-1/2 of a positive definite Q and the ratio of its radii; 0 where it is not.
int sphere_space_make(sym3 q, sym3 *root, sym3 *inverse_root, double *ratio);

/// The octants that a rule keeps, as bits. toward: the direction to the other body, in sphere space.
uint32_t octants_find_kept(vec3 toward, ovoid_area_rule rule);

/// A direction that no mapping over- or underflows: itself, or scaled by a power of two; zero where it is not finite.
vec3 direction_scaled(vec3 v);

#endif
