// The contents of the areas of one polyhedron.
#ifndef OVOID_PAPER_AREA_H
#define OVOID_PAPER_AREA_H

#include "linear/mat3.h"
#include "ovoid/paper.h"
#include "paper/table.h"

struct ovoid_areas {
    ovoid_polytope polytope; ///< a view; borrowed
    vec3 center;
    sym3 root, inverse_root; ///< Q^1/2 and Q^-1/2, rounded
    uint32_t k;              ///< 0: octants
    vec3 *duals;             ///< polar dual points of the facets, in sphere space: Q^1/2 n_j / (d_j - n_j . c)
    uint8_t *octants;        ///< of the facets: bit o where octant o lists the facet
    area_table by_octant;    ///< facets by octant, for the rules that drop octants
    area_table facets;       ///< facets by cube cell; empty where the split is octants
    area_table vertices;     ///< vertices by cube cell, or by octant
    ovoid_allocator allocator;
};

/// Q^1/2 and Q^-1/2 of a positive definite Q and the ratio of its radii; 0 if it is not positive definite.
int sphere_space_make(sym3 q, sym3 *root, sym3 *inverse_root, double *ratio);

/// The octants that a rule keeps, as bits. toward: the direction to the other body, in sphere space.
uint32_t octants_find_kept(vec3 toward, ovoid_area_rule rule);

/// The direction, scaled by a power of two if a mapping of it could over- or underflow; zero if it is not finite.
vec3 direction_scaled(vec3 v);

#endif
