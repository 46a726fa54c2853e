// Robots in their cells: a made one, and a real one if its files are there.
#ifndef OVOID_BENCH_MANY_ROBOT_H
#define OVOID_BENCH_MANY_ROBOT_H

#include "common/bodies.h"
#include "peers/many_peer.h"

enum { ROBOT_LINKS_MOST = 16 };

/// A revolute joint: its place in the frame of the link before it, its axis there, and its range.
typedef struct joint {
    ovoid_pose origin;
    ovoid_vec3 axis;
    double low, high; ///< radians; equal: the joint is fixed
} joint;

/// A chain: link k is moved by joint k, whose frame is that of link k - 1, the base for the first.
typedef struct robot {
    char name[64];
    workcell cell;
    bodies set;
    ovoid_pose base;
    joint joints[ROBOT_LINKS_MOST];
} robot;

/// Ten links of 32 vertices, each about 0.2 m long, axes in turn along z and y, among 400 parts in forty clusters:
/// hulls of 8 to 32 vertices, 2 to 15 cm, within 1.9 m of the base. Neighbours in the chain are ignored. 0: memory is
/// out.
int robot_create_made(robot *all);
/// The Panda (hulls of its meshes; its hand is one with the last link, fingers open) among up to 400 parts of
/// decomposed objects around it, from the folder of test data. 0: it is not available.
int robot_create_panda(robot *all, const char *data);
void robot_destroy(robot *all);

/// The links' poses at the joint angles.
void robot_compute_poses(const robot *all, const double *angles, ovoid_pose *links);
/// Angles, uniform in the joints' ranges.
void robot_draw(const robot *all, uint64_t *state, double *angles);

#endif
