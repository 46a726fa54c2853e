// A peg in the hole of a ring, the ring as a non-convex solid: their distance, and its proof.
#include <ovoid/ovoid.h>

#include <math.h>
#include <stdio.h>

enum { AROUND = 128, TUBE = 64 };
static double points[3 * AROUND * TUBE];
static uint32_t triangles[6 * AROUND * TUBE];

// A ring of radius 15 with a tube of radius 5.
static ovoid_solid *create_ring(ovoid_error *error) {
    const double turn = 6.28318530717958648;
    for (uint32_t k = 0; k < AROUND * TUBE; k++) {
        uint32_t i = k / TUBE, j = k % TUBE, next = (i + 1) % AROUND * TUBE, up = (j + 1) % TUBE;
        double a = turn * i / AROUND, b = turn * j / TUBE, r = 15 + 5 * cos(b);
        const double p[3] = {r * cos(a), r * sin(a), 5 * sin(b)};
        const uint32_t t[6] = {k, next + j, next + up, k, next + up, i * TUBE + up};
        for (int n = 0; n < 3; n++) points[3 * k + (uint32_t)n] = p[n];
        for (int n = 0; n < 6; n++) triangles[6 * k + (uint32_t)n] = t[n];
    }
    return ovoid_solid_create_from_triangles(
        &(ovoid_triangles){points, (size_t)AROUND * TUBE, triangles, 2 * (size_t)AROUND * TUBE}, NULL, error);
}

int main(void) {
    ovoid_error error = {.message = ""};
    ovoid_solid *ring = create_ring(&error);
    ovoid_shape *peg = ovoid_shape_create_capsule(5, 20, NULL, &error);
    if (!ring || !peg) return fprintf(stderr, "%s\n", error.message), 1;
    ovoid_solid_report report = ovoid_solid_get_report(ring);
    printf("the ring: %llu triangles, %s, volume %.1f\n", (unsigned long long)report.triangles,
           report.is_closed ? "closed" : "open", report.volume);

    static ovoid_exclusion items[20000];
    ovoid_exclusions all = {.items = items, .capacity = 20000};
    int refused = 0;
    for (double x = 0; x < 7; x += 2) {
        ovoid_body_pair pair = {{.solid = ring, .pose = ovoid_pose_make_identity()},
                                {.shape = peg, .pose = {{x, 0, 0}, {1, 0, 0, 0}}}};
        ovoid_body_answer answer = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        printf("peg at %g: %s, %.4f to %.4f\n", x, ovoid_status_get_name(answer.status), answer.lower, answer.upper);
        refused += ovoid_body_verify(&pair, &answer, &(ovoid_body_basis){.exclusions = &all}, &error) != OVOID_OK;
    }
    ovoid_shape_destroy(peg);
    ovoid_solid_destroy(ring);
    return refused != 0;
}
