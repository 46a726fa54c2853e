// A frame in convex parts, and a proof of their error: what a distance from the parts means for the frame itself.
#include <ovoid/ovoid.h>

#include <math.h>
#include <stdio.h>

// A square frame: 4 wide, 2 high, with a hole of 2 through it.
static ovoid_solid *create_frame(ovoid_error *error) {
    static const double reach[4] = {2, 2, 1, 1}, height[4] = {-1, 1, 1, -1};
    double points[3 * 16];
    uint32_t triangles[3 * 32];
    for (uint32_t k = 0; k < 16; k++) {
        uint32_t ring = k / 4, i = k % 4, next = 4 * ring + (i + 1) % 4, up = (k + 4) % 16, far = (next + 4) % 16;
        const double p[3] = {i == 1 || i == 2 ? reach[ring] : -reach[ring], i >= 2 ? reach[ring] : -reach[ring],
                             height[ring]};
        const uint32_t t[6] = {k, next, far, k, far, up};
        for (int n = 0; n < 3; n++) points[3 * k + (uint32_t)n] = p[n];
        for (int n = 0; n < 6; n++) triangles[6 * k + (uint32_t)n] = t[n];
    }
    return ovoid_solid_create_from_triangles(&(ovoid_triangles){points, 16, triangles, 32}, NULL, error);
}

// The distance of a shape from the nearest part.
static double compute_distance(const ovoid_decomposition *d, const ovoid_shape *shape, const ovoid_pose *pose) {
    double least = INFINITY;
    for (size_t i = 0; i < d->part_count; i++) {
        ovoid_pair pair = {d->parts[i], shape, ovoid_pose_make_identity(), *pose};
        least = fmin(least, ovoid_distance(&pair, NULL, NULL).lower);
    }
    return least;
}

int main(void) {
    ovoid_error error = {.message = ""};
    ovoid_solid *frame = create_frame(&error);
    ovoid_decomposition_options options = {.error = 0.05, .tolerance = 0.01};
    ovoid_parts *parts = frame ? ovoid_parts_create_from_solid(frame, &options, &error) : NULL;
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, &error);
    if (!parts || !ball) return fprintf(stderr, "%s\n", error.message), 1;

    ovoid_decomposition d = {frame, ovoid_parts_get_shapes(parts), ovoid_parts_get_count(parts)};
    ovoid_decomposition_proof proof;
    ovoid_code code = ovoid_decomposition_compute_proof(&d, &options, &proof, &error);
    if (code != OVOID_OK) return fprintf(stderr, "%s\n", error.message), 1;
    double r = proof.uncovered.upper, p = proof.excess.upper;
    printf("%zu parts; uncovered at most %.3f, excess at most %.3f\n", d.part_count, r, p);

    // In the hole, 0.5 from the frame all around; the hull of the frame contains it.
    ovoid_pose middle = ovoid_pose_make_identity();
    double distance = compute_distance(&d, ball, &middle);
    printf("ball in the hole: %.3f from the parts, so %.3f to %.3f from the frame\n", distance, distance - r,
           distance + p);
    ovoid_shape_destroy(ball);
    ovoid_parts_destroy(parts);
    ovoid_solid_destroy(frame);
    return !(distance - r <= 0.5 && 0.5 <= distance + p);
}
