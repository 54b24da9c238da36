#pragma once

#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include "io/text/shape_parts.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::io {

/// The shapes of a run's floes, as floes.ndjson has them: those that are parts of their parents' take the
/// memory of what is new, and are assembled when asked for. The last ones assembled are kept. Not for several
/// threads at once.
class FloeShapes {
 public:
  /// The next floe, by id. The error is why the parts cannot be of that parent; nothing is added then.
  Result<> add(ShapeParts shape, simulation::FloeId parent);
  void add(const geometry::Polygon& shape) { static_cast<void>(add(whole(shape), simulation::kNoFloe)); }

  std::size_t size() const { return floes_.size(); }

  /// In the floe's body frame. Needs a floe that was added.
  std::shared_ptr<const geometry::Polygon> of(simulation::FloeId floe) const;

  /// What of the floe's shape is its parent's; null where nothing is.
  const ShapeParts* parts_of(simulation::FloeId floe) const;

 private:
  struct Floe {
    simulation::FloeId parent = simulation::kNoFloe;  ///< that its parts are of
    ShapeParts parts;                                 ///< empty where it is whole
    std::shared_ptr<const geometry::Polygon> whole;
    std::vector<std::size_t> ring_sizes;
  };
  const Floe& floe(simulation::FloeId id) const { return floes_.at(static_cast<std::size_t>(id)); }
  std::shared_ptr<const geometry::Polygon> find(simulation::FloeId id) const;
  void keep(simulation::FloeId id, std::shared_ptr<const geometry::Polygon> shape) const;

  std::vector<Floe> floes_;  ///< by id
  // What was assembled last: it follows from floes_, so that const functions may change it.
  mutable std::unordered_map<simulation::FloeId, std::shared_ptr<const geometry::Polygon>> kept_;
  mutable std::deque<simulation::FloeId> oldest_kept_;
  mutable std::size_t kept_vertices_ = 0;
};

}  // namespace polynya::io
