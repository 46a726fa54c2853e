// A posed body as a tree over parts: that of a compound, or one node around a shape.
#include "body/body_view.h"

int body_view_make(const ovoid_body *body, body_view *v) {
    if (!body_is_convex(body)) return 0;
    if (pose_validate(&body->pose) != OVOID_OK) return 0;
    v->pose = &body->pose;
    v->compound = body->compound;
    if (v->compound) {
        v->nodes = v->compound->nodes;
        v->parts = v->compound->parts;
        v->extent = v->compound->extent;
        v->allowance = v->compound->allowance;
        v->count = v->compound->count;
    } else {
        ovoid_posed_shape own = {body->shape, {{0, 0, 0}, {1, 0, 0, 0}}};
        v->own_node = node_make_shape(body->shape);
        v->own_part = part_make(&own);
        v->nodes = &v->own_node;
        v->parts = &v->own_part;
        v->extent = posed_shape_compute_extent(&own);
        v->allowance = shape_get_width(body->shape);
        v->count = 1;
    }
    return vec3_norm(v->pose->position) + v->extent <= OVOID_LENGTH_MAX;
}

ovoid_limit body_pair_view(const ovoid_body_pair *pair, body_view *a, body_view *b) {
    if (!body_is_convex(&pair->a)) return OVOID_LIMIT_SHAPE_A;
    if (!body_is_convex(&pair->b)) return OVOID_LIMIT_SHAPE_B;
    if (!body_view_make(&pair->a, a)) return OVOID_LIMIT_POSE_A;
    return body_view_make(&pair->b, b) ? OVOID_LIMIT_NONE : OVOID_LIMIT_POSE_B;
}
