// Bullet's set-up of a body: its hull by btConvexHullComputer, and a shape of the hull's vertices, without margins.
#include "peers/bullet_hulls.h"
#include "peers/setup_peer.h"

#include <LinearMath/btConvexHullComputer.h>

namespace {

uint32_t make(const double *points, uint32_t count) {
    btConvexHullComputer hull;
    hull.compute(points, 3 * sizeof *points, static_cast<int>(count), 0, 0);
    btConvexHullShape shape;
    for (int i = 0; i < hull.vertices.size(); i++) shape.addPoint(hull.vertices[i], false);
    shape.setMargin(0);
    shape.recalcLocalAabb();
    return static_cast<uint32_t>(shape.getNumVertices());
}

const setup_peer bullet = {sizeof(btScalar) == 4 ? "Bullet's hull, single" : "Bullet's hull", make};
const setup_peer *const peers[] = {&bullet, nullptr};

} // namespace

const setup_peer *const *bench_get_setup_peers(void) { return peers; }
