#include "simulation/ice/split_instant.hpp"

#include <algorithm>

#include "dynamics/chunks.hpp"
#include "simulation/ice/beams.hpp"
#include "simulation/ship/pressing.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;

/// Largest opening force, as a fraction of F_max, with which a split is taken as the solver found it [-]. Larger values
/// record splits with forces that the floe could not have carried. Smaller values take more solutions of the step.
constexpr double kMostShare = 1.05;
/// Opening force to which the contacts of a split are limited, as a fraction of F_max [-]. It is a little more than 1,
/// so that the split still happens if one of several contacts falls short through rounding.
constexpr double kAimedShare = 1.01;
/// Largest number of times that the step is solved again. Limiting the contacts of two bodies changes the forces of
/// other contacts, which may then split their floes or be unloaded. More rounds cost time; fewer leave more splits to
/// Counts::unresolved_splits.
constexpr int kMostRounds = 8;

/// Stores all that solving changes of the contacts and their bodies.
void keep_start(const dynamics::Bodies& bodies, const std::vector<Contact>& contacts, int threads,
                std::vector<SolverStart>& kept) {
  kept.resize(contacts.size());
  dynamics::for_contacts(contacts, threads, [&](const Contact& c, std::size_t i) {
    kept[i] = {{bodies.velocity[c.a], bodies.velocity[c.b]},
               {bodies.angular_velocity[c.a], bodies.angular_velocity[c.b]},
               {c.record->last_impulse[0], c.record->last_impulse[1]},
               c.record->last_slip_impulse};
  });
}

/// Restores the state before the step was solved.
void go_back(const std::vector<SolverStart>& kept, const std::vector<Contact>& contacts, dynamics::Bodies& bodies) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = contacts[i];
    const BodyIndex both[] = {c.a, c.b};
    for (int k = 0; k < 2; ++k) {
      bodies.velocity[both[k]] = kept[i].velocity[k];
      bodies.angular_velocity[both[k]] = kept[i].angular_velocity[k];
      c.record->last_impulse[k] = kept[i].last_impulse[k];
    }
    c.record->last_slip_impulse = kept[i].last_slip_impulse;
  }
}

/// Returns the opening force of a split over its capacity [-].
double share_of(const PendingFracture& split) {
  return split.criteria.split_share();
}

/// A contact whose force is limited because of a split, with its values before that.
struct StoppedContact {
  std::size_t contact = 0;
  double force = 0;           ///< normal force that overshot [N]
  double breaking_force = 0;  ///< Contact::breaking_force [N]
  double missed_impulse = 0;  ///< Contact::missed_impulse [N s]
};

/// A split whose force exceeded its capacity. The step is solved again with the forces of its contacts limited.
struct StoppedSplit {
  PendingFracture split;                 ///< the split, with the forces that overshot
  std::vector<StoppedContact> contacts;  ///< its contacts, with their values before
  double share = 1;                      ///< fraction of their forces to which its contacts are limited
  double too_small = 0;                  ///< largest fraction known to be too small
  double enough = 1;                     ///< smallest fraction known to be enough
};

/// The splits of a step that overshot, and the limits on their contacts.
class SplitInstants {
 public:
  SplitInstants(std::vector<Contact>& contacts, double dt) : contacts_(contacts), dt_(dt) {}

  /// Limits the contacts of the splits that overshoot, and adjusts the limits of those found in earlier rounds whose
  /// opening forces are still too large or too small. Returns true if a limit changed, so that the step must be solved
  /// again.
  bool stop(const std::vector<PendingFracture>& splits) {
    const std::size_t before = stopped_.size();
    for (const PendingFracture& split : splits) {
      if (share_of(split) <= kMostShare) continue;
      const Contact& at = contact_of(split);
      // Both bodies of a pair may overshoot: the split with the larger share happens first.
      StoppedSplit* const same = stopped_at(at);
      if (same == nullptr)
        stopped_.push_back({.split = split, .contacts = {}});
      else if (same >= stopped_.data() + before && share_of(split) > share_of(same->split))
        same->split = split;
    }
    bool is_changed = stopped_.size() > before;
    for (std::size_t k = 0; k < before; ++k) is_changed = bisect(stopped_[k]) || is_changed;
    for (std::size_t k = before; k < stopped_.size(); ++k) stop_contacts(stopped_[k]);
    return is_changed;
  }

  bool any() const { return !stopped_.empty(); }

  /// Replaces the splits of limited contacts in the list by the splits that happened, each with the forces at its
  /// instant. Counts the splits whose instant was not found.
  void enter(std::vector<PendingFracture>& splits, Counts& counts) {
    std::erase_if(splits, [&](const PendingFracture& split) {
      if (stopped_at(contact_of(split)) != nullptr) return true;
      const bool overshoots = share_of(split) > kMostShare;  // all rounds were used
      counts.unresolved_splits += overshoots ? 1 : 0;
      return overshoots;
    });
    for (const StoppedSplit& stopped : stopped_) {
      PendingFracture split = stopped.split;
      const double scale = reached(stopped);
      fracture::FailureCriteria& c = split.criteria;
      for (double* load :
           {&c.contact_force, &c.flank_forces[0], &c.flank_forces[1], &c.opening_force, &c.section_stress})
        *load *= scale;
      if (share_of(split) >= 1 && share_of(split) <= kMostShare)
        splits.push_back(split);
      else
        counts.unresolved_splits += is_any_broken(stopped) ? 1 : 0;  // otherwise the force did not reach its limit
    }
    std::ranges::stable_sort(splits, {}, [&](const PendingFracture& split) { return index_of(split); });
  }

  /// Returns true if a split limited the force of a contact, so that it stayed below the force at which its ice bends.
  bool stops(const dynamics::PersistentContact* record) const {
    return std::ranges::any_of(stopped_, [&](const StoppedSplit& stopped) {
      return std::ranges::any_of(stopped.contacts,
                                 [&](const StoppedContact& s) { return contacts_[s.contact].record == record; });
    });
  }

 private:
  std::size_t index_of(const PendingFracture& split) const {
    return static_cast<std::size_t>(std::ranges::find(contacts_, split.record, &Contact::record) - contacts_.begin());
  }
  const Contact& contact_of(const PendingFracture& split) const { return contacts_[index_of(split)]; }

  StoppedSplit* stopped_at(const Contact& at) {
    const auto found = std::ranges::find_if(stopped_, [&](const StoppedSplit& m) {
      const Contact& c = contact_of(m.split);
      return c.a == at.a && c.b == at.b;
    });
    return found == stopped_.end() ? nullptr : &*found;
  }

  void stop_contacts(StoppedSplit& stopped) {
    const Contact& at = contact_of(stopped.split);
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      Contact& c = contacts_[i];
      const double force = normal_force_of(c, dt_);
      if (c.a != at.a || c.b != at.b || !(force > 0)) continue;
      stopped.contacts.push_back({i, force, c.breaking_force, c.missed_impulse});
    }
    stop_at(stopped, kAimedShare / share_of(stopped.split));
  }

  void stop_at(StoppedSplit& stopped, double share) {
    stopped.share = share;
    for (const StoppedContact& limited : stopped.contacts) {
      Contact& c = contacts_[limited.contact];
      c.breaking_force = limited.breaking_force;
      c.missed_impulse = limited.missed_impulse;
      break_at(c, share * limited.force);
    }
  }

  /// Adjusts the limits of a split by bisection, if its opening force deviates from the capacity. The force is too
  /// small if other contacts were unloaded when one was limited. Returns true if the limits changed.
  bool bisect(StoppedSplit& stopped) {
    const double share = share_of(stopped.split) * reached(stopped);
    if (!is_any_broken(stopped) || (share >= 1 && share <= kMostShare)) return false;
    (share < 1 ? stopped.too_small : stopped.enough) = stopped.share;
    stop_at(stopped, 0.5 * (stopped.too_small + stopped.enough));
    return true;
  }

  /// Returns the present sum of the contacts' forces over the sum of the forces that overshot [-].
  double reached(const StoppedSplit& stopped) const {
    double before = 0, now = 0;
    for (const StoppedContact& limited : stopped.contacts) {
      before += limited.force;
      now += std::min(normal_force_of(contacts_[limited.contact], dt_), contacts_[limited.contact].breaking_force);
    }
    return now / before;
  }

  bool is_any_broken(const StoppedSplit& stopped) const {
    return std::ranges::any_of(stopped.contacts,
                               [&](const StoppedContact& s) { return contacts_[s.contact].is_broken; });
  }

  std::vector<Contact>& contacts_;
  double dt_;
  std::vector<StoppedSplit> stopped_;
};

}  // namespace

dynamics::SolverResult solve_to_splits(const Setup& setup, const Step& step, Population& population, StepData& data,
                                       Counts& counts) {
  dynamics::SolverSettings settings = setup.solver;
  settings.threads = step.threads;
  dynamics::Bodies& bodies = population.bodies;
  const ContactSettings& contact = setup.scene.contact;
  const dynamics::CrushLaw law{step.length, contact.substeps, contact.is_warm_started};
  const auto solve = [&] { return data.solver.solve(bodies, data.contacts, law, settings); };
  data.splits.clear();
  if (setup.scene.fracture.splitting != fracture::SplittingModel::kLefm) return solve();
  const auto find = [&] {
    find_splits(setup, step, population, data.contacts, data.splits);
    find_broken_beams(setup, step, population, data);
  };
  keep_start(bodies, data.contacts, step.threads, data.solver_start);
  SplitInstants instants(data.contacts, step.length);
  dynamics::SolverResult result = solve();
  find();
  for (int round = 0; round < kMostRounds && instants.stop(data.splits); ++round) {
    go_back(data.solver_start, data.contacts, bodies);
    result = solve();
    find();
  }
  if (!instants.any()) return result;
  instants.enter(data.splits, counts);
  std::erase_if(data.fractures, [&](const PendingFracture& pending) {
    return pending.failure == fracture::Failure::kBend && instants.stops(pending.record);
  });
  return result;
}

}  // namespace polynya::simulation
