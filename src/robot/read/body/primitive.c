#include "robot/read/body/primitive.h"

int primitive_compare(const primitive *a, const primitive *b) {
    int order = (a->kind > b->kind) - (a->kind < b->kind);
    for (int k = 0; k < 3 && !order; k++) order = (a->size[k] > b->size[k]) - (a->size[k] < b->size[k]);
    return order;
}

size_t primitive_get_size_count(primitive_kind kind) {
    if (kind == PRIMITIVE_SPHERE) return 1;
    return kind == PRIMITIVE_BOX || kind == PRIMITIVE_MESH ? 3 : 2;
}

ovoid_shape *primitive_create(const primitive *p, const ovoid_robot_read_options *options, ovoid_error *error) {
    ovoid_shape_options shape = {.tolerance = options->tolerance};
    if (options->shape) shape = *options->shape, shape.tolerance = options->tolerance;
    double x = p->size[0], half = p->size[1] / 2;
    switch (p->kind) {
    case PRIMITIVE_SPHERE: return ovoid_shape_create_sphere(x, &shape, error);
    case PRIMITIVE_CAPSULE: return ovoid_shape_create_capsule(x, half, &shape, error);
    case PRIMITIVE_CYLINDER: return ovoid_shape_create_cylinder(x, half, &shape, error);
    case PRIMITIVE_CONE: return ovoid_shape_create_cone(x, half, &shape, error);
    default: return ovoid_shape_create_box((ovoid_vec3){x / 2, half, p->size[2] / 2}, &shape, error);
    }
}
