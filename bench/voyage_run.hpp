#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/peer.hpp"

namespace polynya::bench {

/// How long a run may take.
struct Limits {
  double wall = 1e9;  ///< wall time of the steps [s]
  double time = 0;    ///< simulated, at most [s]
  int threads = 1;    ///< threads of Polynya; the peers have one
};

/// The cost of a run, and its results as far as they are compared.
struct RunCost {
  std::string engine;
  long ticks = 0;              ///< a tick of ours may have several parts; the peers have one time step in each
  double step = 0;             ///< length of a tick [s]
  double load = 0;             ///< time from the scene's text to the first step; 0 for the peers [s]
  double memory = 0;           ///< peak of the process during load and run [MiB]; 0: not measured
  std::vector<double> blocks;  ///< wall time of each kBlock ticks; the last has the rest of the run [s]
  double mean_awake = 0;       ///< bodies
  int most_awake = 0;
  double mean_contacts = 0;  ///< over the steps at which they were counted
  int bends = 0, splits = 0;
  double surge = 0;                     ///< mean of the first ship's, by the ice [N]
  std::vector<geometry::Point> places;  ///< places of a peer's bodies at the end

  static constexpr long kBlock = 100;
  double covered() const { return step * static_cast<double>(ticks); }  ///< [s]
  double total() const;                                                 ///< total time of the steps [s]
  double total_of_first(double time) const;                             ///< wall time of so much simulated [s]
  double mean_tick() const { return total() / static_cast<double>(ticks); }
  double per_second() const { return total() / covered(); }  ///< wall time a simulated second [-]
  double median_tick() const;                                ///< median of the blocks' means [s]
};

/// Every engine takes the same steps in each repetition, so the fastest repetition of a block is its undisturbed cost.
void keep_quieter(RunCost& cost, const RunCost& again);

/// A scene of scenes/, and the changes that a case makes to it.
using Edit = std::function<void(simulation::Scene&)>;
simulation::Scene load(const std::string& file, const Edit& edit = {});

/// Gives the scene the fine step: the longest round number of seconds in which no hull moves farther than loads allow
/// (allowed_displacement in simulation/world/parts.hpp), so that no tick needs parts for the way of a hull. The peers
/// take that step.
void take_fine_step(simulation::Scene& scene);

/// Ticks without parts: each tick is one time step, as in the peers.
inline constexpr simulation::Shortcuts kWithoutParts{.takes_parts = false};

/// Runs a scene of scenes/ and measures the time, including the time to load the scene.
RunCost run_polynya(const std::string& file, const Edit& edit, const Limits& limits,
                    simulation::Shortcuts shortcuts = {});
/// Runs a scene that is loaded already.
RunCost run_polynya(const simulation::Scene& scene, const Limits& limits, simulation::Shortcuts shortcuts = {});

/// An engine that we are compared to.
struct Peer {
  std::string name;
  RunCost (*run)(const Peer& peer, const PeerScene& scene, const Limits& limits);
  bool has_places = false;  ///< true if it states the places of its bodies at the end
};
/// Returns the engines that were compiled into this build.
const std::vector<Peer>& peers();

}  // namespace polynya::bench
