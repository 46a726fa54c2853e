/**
 * @file ovoid.h
 * Everything of the core library. Meshes and scenes are in <ovoid/io.h> (a second library).
 */
#ifndef OVOID_OVOID_H
#define OVOID_OVOID_H

#include "ovoid/base.h"
#include "ovoid/body.h"
#include "ovoid/body_impact.h"
#include "ovoid/body_manifolds.h"
#include "ovoid/compound.h"
#include "ovoid/decompose.h"
#include "ovoid/ellipsoid.h"
#include "ovoid/linear.h"
#include "ovoid/manifold.h"
#include "ovoid/motion.h"
#include "ovoid/paper.h"
#include "ovoid/polytope.h"
#include "ovoid/prepared.h"
#include "ovoid/query.h"
#include "ovoid/shape.h"
#include "ovoid/smooth.h"
#include "ovoid/solid.h"
#include "ovoid/swept.h"
#include "ovoid/world.h"
#include "ovoid/world_manifolds.h"

#endif
