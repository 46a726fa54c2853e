// The paper's two propositions, as they hold in three dimensions, each checked with numbers. docs/paper.md has the
// proofs.
//
// 1. Let the unit sphere around 0 be A's enclosed ellipsoid in its sphere space, and B a convex body that does not meet
// the ball, with any point b of it. The point of A's surface nearest to B lies in the half u.b >= 0: for the nearest
// point y of B, all of B is in { x : x.y >= |y|^2 }, so b.y > 0, and the sphere's nearest point is y / |y|.
// 2. An octant can be dropped, whatever B is, if and only if the direction d of b has the three signs opposite to it.
#include "paper/experiment.h"

#include <math.h>

/// Finds a point of an ellipsoid that does not meet the unit sphere, and its point nearest to the origin.
static int find_pair(uint64_t *state, ovoid_vec3 *inside, ovoid_vec3 *nearest) {
    const ovoid_ellipsoid ball = {{0, 0, 0}, {1, 0, 0, 1, 0, 1}};
    double a = random_uniform(state, 0.1, 5), b = random_uniform(state, 0.1, 5), c = random_uniform(state, 0.1, 5);
    ovoid_vec3 u = random_direction(state), v = random_direction(state);
    double far = random_uniform(state, 1, 8);
    ovoid_ellipsoid e = {{far * u.x, far * u.y, far * u.z}, {a * a, 0, 0, b * b, 0, c * c}};
    ovoid_nearest n = ovoid_ellipsoid_compute_nearest(&ball, &e);
    if (n.overlap) return 0;
    *nearest = n.point_b;
    double r = random_uniform(state, 0, 1);
    *inside = (ovoid_vec3){e.center.x + r * a * v.x, e.center.y + r * b * v.y, e.center.z + r * c * v.z};
    return 1;
}

void experiment_add_propositions(const experiment *e) {
    uint64_t state = e->seed;
    double least = INFINITY, checked = 0, by_signs = 0, by_paper = 0;
    for (uint32_t i = 0; i < 400 * e->frames; i++) {
        ovoid_vec3 b, y;
        if (!find_pair(&state, &b, &y)) continue;
        checked++;
        least = fmin(least, vec3_dot(b, y) / sqrt(vec3_dot(b, b) * vec3_dot(y, y)));
        // The octant of the nearest point, compared with those that each rule drops for the direction of b.
        double x = y.x < 0 ? -b.x : b.x, k = y.y < 0 ? -b.y : b.y, z = y.z < 0 ? -b.z : b.z;
        by_signs += x < 0 && k < 0 && z < 0;
        by_paper += (x + k + z) / sqrt(3 * vec3_dot(b, b)) < -sqrt(0.5);
    }
    report_add_section(e->report, "Propositions 1 and 2, in three dimensions");
    char measured[80];
    snprintf(measured, sizeof measured, "in all of %.0f cases, the least cosine is %.2f", checked, least);
    report_add_verdict(
        e->report, (report_verdict){"Proposition 1: the nearest point lies in the half that looks at the other body.",
                                    least > 0 ? REPORT_HOLDS : REPORT_DOES_NOT_HOLD, measured,
                                    "proven in three dimensions, for any convex body"});
    report_add_text(
        e->report,
        "Proposition 1. Let A's enclosed ellipsoid be the unit sphere (its sphere space), and let b be any point "
        "of a convex body B that does not meet it. The point of the sphere nearest to B lies in the half sphere "
        "u.b > 0. Proof: let y be the point of B nearest to the centre. B is convex, so all of it lies in x.y >= "
        "y.y, and b.y > 0; the sphere's nearest point is y / |y|. The paper draws its proof in a plane, for an "
        "ellipsoid; neither is needed.\n\n"
        "Proposition 2. Of the eight octants the ones that lie wholly behind, u.d < 0 for all their u, are those "
        "whose three axes are behind: the octant opposite to d, and no other. As a condition on the dot product "
        "with the octant's vector alone the limit is -sqrt(2/3) = -0.8165; with -sqrt(2)/2 parts of the front are "
        "dropped.");
    report_table *t = report_begin_table(e->report, "propositions", "check,cases,result");
    report_add_row(t, "1: least cosine between a point of B and the nearest point,%.0f,%.5f", checked, least);
    report_add_row(t, "2: nearest point in an octant dropped by signs,%.0f,%.0f", checked, by_signs);
    report_add_row(t, "2: nearest point in an octant dropped by the paper's rule,%.0f,%.0f", checked, by_paper);
    report_end_table(t, 3);
}
