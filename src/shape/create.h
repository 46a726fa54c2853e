// Making shapes; shared by the files of this floor.
#ifndef OVOID_SHAPE_CREATE_H
#define OVOID_SHAPE_CREATE_H

#include "ovoid/shape.h"

/// The options with their defaults; NULL allowed. Errors: RADIUS, RANGE, ARGUMENT.
ovoid_code shape_options_make(const ovoid_shape_options *given, ovoid_shape_options *options, ovoid_error *error);

#endif
