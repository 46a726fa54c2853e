// Shared by all of FCL's contestants.
#ifndef OVOID_BENCH_PEERS_PEER_FCL_H
#define OVOID_BENCH_PEERS_PEER_FCL_H

#include "peers/peer.h"

#include <fcl/fcl.h>

#include <memory>
#include <vector>

/// A Convex: above 32 vertices FCL climbs from vertex to vertex.
inline std::shared_ptr<fcl::Convexd> make_convex(const body &b) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    auto faces = std::make_shared<std::vector<int>>();
    for (uint32_t i = 0; i < b.vertex_count; i++)
        vertices->emplace_back(b.vertices[3 * i], b.vertices[3 * i + 1], b.vertices[3 * i + 2]);
    for (uint32_t t = 0; t < b.triangle_count; t++) {
        faces->push_back(3);
        for (int k = 0; k < 3; k++) faces->push_back(static_cast<int>(b.triangles[3 * t + k]));
    }
    auto shape = std::make_shared<fcl::Convexd>(vertices, static_cast<int>(b.triangle_count), faces);
    shape->computeLocalAABB();
    return shape;
}

#endif
