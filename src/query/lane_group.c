// The frame of a lane: for the few that end with evidence, and those that leave their lanes.
#include "query/lane_group.h"

void lane_group_place_frame(group_lane at, pair_frame *f) {
    const pair8 *o = at.e->lanes;
    const ovoid_posed_shape *a = get_a(at.e, at.k), *b = get_b(at.e, at.k);
    double size = o->size.lane[at.k], hidden = OVOID_LENGTH_MIN;
    f->a = a->shape;
    f->b = b->shape;
    f->world = get9(o->world_a, at.k);
    f->world_b = get9(o->world_b, at.k);
    f->world_origin = a->pose.position;
    f->offset = get3(o->offset, at.k);
    f->between = get3(o->between, at.k);
    f->turned_a = f->turned_b = NULL;
    f->size = size;
    f->claim = FRAME_CLAIM * size + 2 * hidden;
    f->check = FRAME_CHECK * size + hidden;
    f->hidden = hidden;
    f->lower_radii = f->upper_radii = o->radii.lane[at.k];
    f->is_true = 0;
    f->beyond = 0;
}
