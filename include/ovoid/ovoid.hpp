/**
 * @file ovoid.hpp
 * The core library for C++17 and later: header only, over the C functions; it needs only the standard library. Meshes
 * and scenes: <ovoid/io.hpp>. Eigen and glm: <ovoid/eigen.hpp>, <ovoid/glm.hpp>.
 *
 * - Values are the C structs, some with constructors (vec3, pose, pair, body, motion); no field is added, so both go
 *   wherever the other does. Options begin as zero, the default.
 * - shape, compound, areas and world own a handle: they move, never copy, destroy once; get() is the C handle. Views
 * and pairs borrow: what they point to must outlive them. What was moved from is empty and may be assigned or
 * destroyed.
 * - What the C library refuses with an ovoid_error throws ovoid::error with its code, place and sentence. Queries are
 *   noexcept, allocate nothing and give the bits of the C functions.
 * - Names: ovoid_shape_get_radius(s) is s.radius(), ovoid_world_find_nearest(w, ...) is w.find_nearest(...),
 * ovoid_distance is ovoid::distance, ovoid_impact_find is ovoid::find_impact. docs/cpp.md has the list.
 */
#ifndef OVOID_OVOID_HPP
#define OVOID_OVOID_HPP

#include "ovoid/cpp/body.hpp"
#include "ovoid/cpp/body_manifolds.hpp"
#include "ovoid/cpp/compound.hpp"
#include "ovoid/cpp/decompose.hpp"
#include "ovoid/cpp/error.hpp"
#include "ovoid/cpp/linear.hpp"
#include "ovoid/cpp/manifold.hpp"
#include "ovoid/cpp/motion.hpp"
#include "ovoid/cpp/points.hpp"
#include "ovoid/cpp/query.hpp"
#include "ovoid/cpp/shape.hpp"
#include "ovoid/cpp/solid.hpp"
#include "ovoid/cpp/swept.hpp"
#include "ovoid/cpp/world.hpp"
#include "ovoid/ovoid.h"

#endif
