// From C++: two bodies, their distance and its proof; a world and its contacts; a refused input.
#include <ovoid/ovoid.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
    const auto box = ovoid::shape::box({1, 2, 3});
    const auto pill = ovoid::shape::capsule(0.5, 1);
    const ovoid::pair pair{box, pill, {}, ovoid::pose::rpy({4, 0, 0}, {0, 0.7, 0})};
    const ovoid::answer answer = ovoid::distance(pair);
    std::printf("%s, %.17g <= d <= %.17g\n", ovoid::name(answer.status), answer.lower, answer.upper);
    ovoid::verify(pair, answer); // throws if the proof does not hold

    auto world = ovoid::world::create();
    for (double x = 0; x < 10; x++) world.add({box, ovoid::vec3{1.9 * x, 0, 0}});
    for (const ovoid::contact &c : world.compute_contacts({OVOID_QUERY_DEPTH}))
        std::printf("%u touches %u, %.3f deep\n", unsigned(c.a >> 32), unsigned(c.b >> 32), -c.verdict.upper);
    try {
        ovoid::shape::from_points(std::vector<double>{0, 0, 0, 1, 0, NAN});
    } catch (const ovoid::error &e) {
        std::printf("refused: %s\n", e.what());
    }
}
