// The bodies of the paper's experiment (its chart 0): a box, ten cylinders, ten cylinders of more faces, ten spheres.
#ifndef OVOID_CLI_PAPER_MODELS_H
#define OVOID_CLI_PAPER_MODELS_H

#include <ovoid/ovoid.h>

typedef enum paper_family { FAMILY_BOX = 0, FAMILY_CYLINDER, FAMILY_COMPLEX, FAMILY_SPHERE, FAMILY_COUNT } paper_family;

enum { MODELS_EACH = 10, MODEL_COUNT = 1 + 3 * MODELS_EACH };

/// A body: the triangle mesh with the paper's counts, and the shape of its hull.
typedef struct paper_model {
    char name[24]; ///< "cylinder 14"
    paper_family family;
    double *xyz;
    uint32_t *triangles;
    uint32_t vertex_count, triangle_count; ///< of the mesh; centres of flat caps are not vertices of the hull
    ovoid_shape *shape;
    ovoid_areas *areas; ///< eight octants, of the shape's inner ellipsoid
} paper_model;

/// All models, MODEL_COUNT of them; NULL if memory runs out.
paper_model *paper_models_create(void);
void paper_models_destroy(paper_model *models);

/// "box", "cylinders", "complex cylinders", "spheres"
const char *paper_family_get_name(paper_family family);

/// The mesh as a polytope, for callers that need only vertices and triangles.
ovoid_polytope paper_model_get_mesh(const paper_model *model);

#endif
