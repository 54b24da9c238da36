#pragma once

#include <map>
#include <set>

#include "analysis/run_check.hpp"

namespace polynya::analysis {

/// Compares what the bodies of a run have crushed with the work that it took (crushed.csv), at one frame after the
/// other, into its check.
class WorkCheck {
 public:
  WorkCheck(const io::Run& run, RunCheck& check) : run_(run), check_(check) {}

  void compare(double time);

 private:
  using Body = simulation::ContactState::Body;
  using Key = std::pair<std::int64_t, std::int64_t>;  ///< two bodies: a floe's id, or −1 − the number of a hull

  const fracture::Ice& ice_of(const Body& floe) const;
  double area_of(const Body& body) const;  ///< [m²]
  void enter(const Key& pair, const UnpaidOverlap& overlap);

  const io::Run& run_;
  RunCheck& check_;
  std::set<Key> compared_;
  std::map<Key, std::size_t> unpaid_;  ///< in the check's list
};

}  // namespace polynya::analysis
