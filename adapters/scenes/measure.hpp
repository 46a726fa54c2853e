/// @file measure.hpp
/// What a run of a scene shows: contacts beside proven depths, speeds beside what the energy allows, rest, and time.
#ifndef ADAPTERS_MEASURE_HPP
#define ADAPTERS_MEASURE_HPP

#include "scenes/scene.hpp"

#include <memory>
#include <set>

namespace scenes {

/// A contact is a phantom if it claims a depth that an exact query disproves by more than this share of the scene's
/// size; it is lost if a pair is proven deeper than this and the engine has no contact of it.
constexpr double share = 1e-3;

/// What one run showed.
struct findings {
    std::uint64_t pairs = 0; ///< asked: near pairs in the steps that were looked at
    std::uint64_t phantoms = 0, lost = 0;
    double worst_phantom = 0, worst_lost = 0; ///< by how much, in lengths
    std::set<std::size_t> ejected;            ///< bodies that were once faster than the scene allows
    double fastest = 0;
    double drift = 0;  ///< the farthest that a body is at the end from where it began, horizontally
    double jitter = 0; ///< root of the mean square speed in the last tenth of the time
    double energy_begin = 0, energy_end = 0, energy_gain = 0; ///< gain: the most above the first
    std::uint64_t touches = 0, steps = 0;
    double seconds = 0; ///< of the processor, in steps
};

/// The scene's bodies as ovoid's shapes, and their exact answers.
class truth {
  public:
    explicit truth(const scene &of);
    /// Compares the contacts of a step with the depths at the poses where they were found.
    void compare(const state &at, const std::vector<touch> &touches, findings &to) const;
    /// Kinetic and potential energy.
    double energy(const state &at) const;

  private:
    struct depth {
        double lower, upper;
    };
    depth measure(std::size_t a, std::size_t b, const state &at) const;
    const scene *scene_;
    std::vector<ovoid::shape> shapes_;
    std::vector<double> reach_;
};

/// Speeds of a state: who is ejected, and the sum of squares for the jitter.
double look_at_speeds(const scene &of, const state &at, findings &to);

} // namespace scenes

#endif
