#pragma once

#include "io/run/summary.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {

/// What a run's summary needs of the last step that was whole: where memory runs out within a step, the world
/// is no longer to be relied on. Takes no memory, and little time.
class LastWholeStep {
 public:
  explicit LastWholeStep(const simulation::Simulation& simulation);

  /// After a step; `more_floes` came to be in it, less those that broke or left.
  void take(const simulation::Simulation& simulation, std::int64_t more_floes);

  /// Steps, time, counts and accounts. The area of the floes and what moves are not measured, but what the
  /// accounts leave: the imbalances are 0.
  void fill(RunSummary& summary) const;

 private:
  double time_ = 0;  ///< [s]
  simulation::Counts counts_;
  simulation::AreaLedger ledger_;
  simulation::MassLedger masses_;
  simulation::AuditSums sums_;
};

}  // namespace polynya::io
