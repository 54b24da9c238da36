#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/peer.hpp"

namespace polynya::bench {

/// How long a run may take.
struct Limits {
  double wall = 1e9;  ///< of the steps [s]
  long steps = 0;     ///< at most
  int threads = 1;    ///< of ours; the peers have one
};

/// What a run came to.
struct RunCost {
  std::string engine;
  long steps = 0;
  double step = 0;             ///< Δt [s]
  double load = 0;             ///< from the scene's text to before the first step; 0 for the peers [s]
  double memory = 0;           ///< peak of the process during load and run [MiB]; 0: not measured
  std::vector<double> blocks;  ///< wall time of each block of kBlock steps [s]
  double mean_awake = 0;       ///< bodies
  int most_awake = 0;
  double mean_contacts = 0;  ///< over the steps at which they were counted
  int bends = 0, splits = 0;

  static constexpr long kBlock = 100;
  double total() const;                     ///< of the steps [s]
  double total_of_first(long steps) const;  ///< wall time of the first so many [s]
  double mean_step() const { return total() / static_cast<double>(steps); }
  double median_step() const;  ///< of the blocks' means [s]
  double real_time_factor() const { return step * static_cast<double>(steps) / total(); }
};

/// Every engine takes the same steps each time, so a block's quietest run is what it costs undisturbed.
void keep_quieter(RunCost& cost, const RunCost& again);

/// A scene of scenes/, with what a case changes about it.
using Edit = std::function<void(simulation::Scene&)>;
simulation::Scene load(const std::string& file, const Edit& edit = {});

/// Loading included, which is timed.
RunCost run_polynya(const std::string& file, const Edit& edit, const Limits& limits);
RunCost run_polynya(const simulation::Scene& scene, const Limits& limits);

/// An engine that we are compared to.
struct Peer {
  std::string name;
  RunCost (*run)(const Peer& peer, const PeerScene& scene, const Limits& limits);
};
/// Those that this build has.
const std::vector<Peer>& peers();

}  // namespace polynya::bench
