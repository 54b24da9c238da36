// Whole runs side by side with Box2D 2.4.1, Chipmunk 7.0.3 and, where its sources are, Box2D 3.2 stepping the
// same bodies without any fracture. One process, one engine after another.
//   polynya_bench_voyages [--quick] [--csv FILE] [--only CASE] [--peer-seconds S] [--lateral METRES]
// Polynya takes the tick of a scene that gives none, with its parts (simulation/world/parts.hpp); ticks 2, 4 and 8
// times as long; and the fine step, without parts. The peers take the fine step too. Box2D 3.2 also takes the longest
// step with which its bodies reach the same places. Prints the table of docs/performance.md (Markdown).
// bench/performance.sh puts it there.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "bench/voyage_run.hpp"
#include "simulation/world/default_tick.hpp"

namespace polynya::bench {
namespace {

struct Options {
  bool is_quick = false;
  std::string csv;
  std::string only;
  double peer_seconds = 120;  ///< time limit of each peer's run of a case [s]
  /// Lateral distances of the ships from their places in the scenes, to port [m]. Such voyages are run once, because
  /// many different voyages are more informative than repetitions of one.
  std::optional<double> lateral;
};

/// A group of rows of the table: a scene, and the engines and settings that are compared.
struct Case {
  std::string name;
  std::string scene;
  Edit edit;
  double until = 0;  ///< [s]
  bool has_peers = true;
  double scene_step = 0;    ///< the fine step, where the scene gives it [s]; 0: take_fine_step() chooses it
  std::string compared_to;  ///< the case whose cost is the yardstick; empty: none
  int threads = 1;          ///< threads of Polynya
  int repeats = 1;          ///< repeats of all engines; the fastest repeat of each kBlock ticks counts
};

/// Adds the same number of floes again, far away from the voyage.
void double_the_field(simulation::Scene& scene) {
  double low = INFINITY;
  double high = -INFINITY;
  for (const auto& floe : scene.floes) {
    for (const geometry::Point p : floe.polygon_in_world.outer) {
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
  }
  const std::size_t count = scene.floes.size();
  for (std::size_t i = 0; i < count; ++i) {
    simulation::FloeSpec floe = scene.floes[i];
    for (geometry::Point& p : floe.polygon_in_world.outer) p.y += high - low + 20;
    scene.floes.push_back(std::move(floe));
  }
}

/// Replaces the plate of level-plate by a round plate of 300 m whose outline has `corners` corners.
Edit round_plate(int corners) {
  return [corners](simulation::Scene& scene) {
    geometry::Ring ring;
    for (int i = 0; i < corners; ++i) {
      // The corners are not symmetric about the course, so that no corner lies just ahead of the stem.
      const double angle = 2 * std::numbers::pi * (i + 0.3) / corners;
      ring.push_back({150 + 150 * std::cos(angle), 150 * std::sin(angle)});
    }
    scene.floes.front().polygon_in_world = {ring, {}};
  };
}

/// Switches the scene to the crushing law with the default tick.
void by_crushing(simulation::Scene& scene) {
  scene.contact.law = simulation::ContactLaw::kCrush;
  scene.time.step = simulation::default_tick(scene);
}

/// The same bodies by the paper's law of contact, whose ticks have no parts, at the scene's own step.
void by_impulses(simulation::Scene& scene) {
  scene.contact.law = simulation::ContactLaw::kImpulse;
}

/// An edit, and then a tick that is longer by a factor.
Edit in_longer_ticks(const Edit& edit, int times) {
  return [edit, times](simulation::Scene& scene) {
    edit(scene);
    scene.time.step *= times;
  };
}

/// Applies an edit, and then the fine step: the given one [s], or the one that take_fine_step() chooses.
Edit in_fine_steps(const Edit& edit, double scene_step) {
  return [edit, scene_step](simulation::Scene& scene) {
    edit(scene);
    take_fine_step(scene);
    if (scene_step > 0) scene.time.step = scene_step;
  };
}

/// Moves the hulls by a lateral distance to port, which makes another voyage through the same ice.
Edit moved_to_port(const Edit& edit, double lateral) {
  return [edit, lateral](simulation::Scene& scene) {
    if (edit) edit(scene);
    const auto move = [&](simulation::PlacedHull& hull) {
      hull.position_in_world += rotate(geometry::Rotation::by(hull.heading), geometry::Vector{0, lateral});
    };
    std::ranges::for_each(scene.ships, move);
    std::ranges::for_each(scene.structures, move);
  };
}

/// A case's floes or outlines changed, by the law of crushing ice.
Edit also_crushing(const Edit& edit) {
  return [edit](simulation::Scene& scene) {
    edit(scene);
    by_crushing(scene);
  };
}

std::vector<Case> cases(bool is_quick) {
  const double part = is_quick ? 0.1 : 1;
  const char* fig4b = "sawamura2017-fig4b.json";
  const char* cylinder = "cylinder-shear.json";
  return {
      {"voyage", fig4b, by_crushing, 550 * part, true, 0.005, "", 1, 3},
      {"voyage-impulse", fig4b, by_impulses, 550 * part, true, 0.005, "", 1, 2},
      {"field-10000", "field-10000.json", by_crushing, 500 * part, true, 0, "", 1, 3},
      {"field-20000", "field-10000.json", also_crushing(double_the_field), 500 * part, false, 0, "field-10000", 1, 2},
      {"field-100000", "field-100000.json", by_crushing, 500 * part, true, 0, "", 1, 2},
      {"cylinder-shear", cylinder, by_crushing, 400 * part, true, 0, "", 1, 2},
      {"cylinder-shear-2", cylinder, by_crushing, 400 * part, false, 0, "cylinder-shear", 2, 2},
      {"plate-100", "level-plate.json", also_crushing(round_plate(100)), 200 * part, false, 0, "", 1, 3},
      {"plate-10000", "level-plate.json", also_crushing(round_plate(10000)), 200 * part, false, 0, "plate-100", 1, 3}};
}

void print_row(const Case& at, const RunCost& cost, std::size_t floes, const std::string& ratio, std::FILE* csv) {
  std::printf("| %s | %s | %zu | %.4g | %.0f | %.3f | %.1f | %.0f | %.1f | %.4g | %.2f | %.0f | %s |\n",
              at.name.c_str(), cost.engine.c_str(), floes, cost.step, cost.covered(), 1e3 * cost.per_second(),
              1e6 * cost.median_tick(), cost.mean_awake, cost.mean_contacts, 1 / cost.per_second(), cost.load,
              cost.memory, ratio.c_str());
  std::fflush(stdout);
  if (csv == nullptr) return;
  std::fprintf(csv, "%s,\"%s\",%zu,%.6g,%.6g,%.6f,%.4f,%.2f,%d,%.2f,%.6g,%.4f,%.1f,%d,%d,%.2f,%s\n", at.name.c_str(),
               cost.engine.c_str(), floes, cost.step, cost.covered(), 1e3 * cost.per_second(), 1e6 * cost.median_tick(),
               cost.mean_awake, cost.most_awake, cost.mean_contacts, 1 / cost.per_second(), cost.load, cost.memory,
               cost.bends, cost.splits, -1e-3 * cost.surge, ratio.c_str());
  std::fflush(csv);
}

std::string times(double ratio) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", ratio);
  return text;
}

/// Executes the runs one after the other, and repeats the whole sequence `repeats` times.
std::vector<RunCost> alternate(int repeats, const std::vector<std::function<RunCost()>>& runs) {
  std::vector<RunCost> costs;
  costs.reserve(runs.size());
  for (const auto& run : runs) costs.push_back(run());
  for (int i = 1; i < repeats; ++i) {
    for (std::size_t k = 0; k < runs.size(); ++k) keep_quieter(costs[k], runs[k]());
  }
  return costs;
}

/// How far bodies are from where they are with other steps, over how far they came: of all that moved, and of the
/// first, the ship, whichever is more.
double astray(const PeerScene& start, const RunCost& reference, const RunCost& run) {
  double off = 0;
  double way = 0;
  double of_ship = 0;
  for (std::size_t i = 0; i < start.bodies.size(); ++i) {
    const double moved = distance(reference.places[i], start.bodies[i].position);
    const double beside = distance(run.places[i], reference.places[i]);
    if (i == 0 && moved > 0) of_ship = beside / moved;
    if (start.bodies[i].is_prescribed) continue;
    way += moved;
    off += beside;
  }
  return std::max(of_ship, way > 0 ? off / way : 0);
}

/// Returns the scene with the longest step with which the bodies of a peer reach the same places as with the scene's
/// step.
PeerScene with_longest_step(const Peer& peer, const PeerScene& scene, const Limits& limits) {
  constexpr double kAllowed = 0.1;
  PeerScene found = scene;
  const RunCost reference = peer.run(peer, scene, limits);
  if (reference.places.empty() || reference.covered() < 0.99 * limits.time) return found;
  for (const double times : {1.25, 1.5, 2., 2.5, 3., 4., 5., 6., 8., 10., 12., 16.}) {
    PeerScene longer = scene;
    longer.step = times * scene.step;
    const double off = astray(scene, reference, peer.run(peer, longer, limits));
    std::fprintf(stderr, "%s at %g s: places off by %.3f of the way\n", peer.name.c_str(), longer.step, off);
    if (off > kAllowed) break;
    found = longer;
  }
  return found;
}

/// The runs that a case compares. The first run is that of Polynya.
struct Runs {
  std::vector<std::function<RunCost()>> runs;
  std::vector<PeerScene> scenes;  ///< scenes of the peers, kept while they run
};

void add_peers(const simulation::Scene& scene, const Limits& limits, Runs& to) {
  const PeerScene bodies = peer_scene(simulation::Simulation{simulation::Scene(scene)});
  to.scenes.reserve(2 * peers().size());
  for (const Peer& peer : peers()) {
    const PeerScene& at_step = to.scenes.emplace_back(bodies);
    to.runs.emplace_back([&peer, &at_step, limits] { return peer.run(peer, at_step, limits); });
    if (!peer.has_places) continue;
    const PeerScene& longest = to.scenes.emplace_back(with_longest_step(peer, bodies, limits));
    to.runs.emplace_back([&peer, &longest, limits] {
      RunCost cost = peer.run(peer, longest, limits);
      cost.engine += ", longest step";
      return cost;
    });
  }
}

void run_case(const Case& at, const std::vector<Case>& all, const Options& options, std::FILE* csv) {
  const auto ours = [&](const Case& which, const Edit& edit, simulation::Shortcuts shortcuts = {}) {
    return [&which, edit, shortcuts, until = at.until] {
      return run_polynya(which.scene, edit, {1e9, until, which.threads}, shortcuts);
    };
  };
  Runs compared{{ours(at, at.edit)}, {}};
  const auto yardstick = std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.name == at.compared_to; });
  if (yardstick != all.end()) compared.runs.emplace_back(ours(*yardstick, yardstick->edit));
  const bool has_parts = at.has_peers && load(at.scene, at.edit).contact.law == simulation::ContactLaw::kCrush;
  const auto add_ours = [&](const Edit& edit, const std::string& how, simulation::Shortcuts shortcuts = {}) {
    compared.runs.emplace_back([run = ours(at, edit, shortcuts), how] {
      RunCost cost = run();
      cost.engine += how;
      return cost;
    });
  };
  if (has_parts) {
    for (const int times : {2, 4, 8}) add_ours(in_longer_ticks(at.edit, times), fmt::format(", tick x {}", times));
    add_ours(in_fine_steps(at.edit, at.scene_step), ", fine step", kWithoutParts);
  }
  const simulation::Scene scene = load(at.scene, in_fine_steps(at.edit, at.scene_step));
  if (at.has_peers) add_peers(scene, {options.peer_seconds, at.until}, compared);
  const std::vector<RunCost> costs = alternate(at.repeats, compared.runs);
  const RunCost& own = costs.front();
  const std::string ratio =
      yardstick == all.end() ? "" : times(own.mean_tick() / costs[1].mean_tick()) + " x " + yardstick->name;
  print_row(at, own, scene.floes.size(), ratio, csv);
  if (!at.has_peers) return;
  for (std::size_t k = 1; k < costs.size(); ++k) {
    // Over the same time, where a peer was stopped early.
    const double over = costs[k].total() / own.total_of_first(costs[k].covered());
    print_row(at, costs[k], scene.floes.size(), times(over) + " x Polynya", csv);
  }
}

Options options_of(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const bool has_value = i + 1 < count;
    if (std::strcmp(words[i], "--quick") == 0) {
      options.is_quick = true;
      options.peer_seconds = 10;
    } else if (std::strcmp(words[i], "--csv") == 0 && has_value) {
      options.csv = words[++i];
    } else if (std::strcmp(words[i], "--only") == 0 && has_value) {
      options.only = words[++i];
    } else if (std::strcmp(words[i], "--peer-seconds") == 0 && has_value) {
      options.peer_seconds = std::atof(words[++i]);
    } else if (std::strcmp(words[i], "--lateral") == 0 && has_value) {
      options.lateral = std::atof(words[++i]);
    } else {
      std::fprintf(stderr, "usage: %s [--quick] [--csv FILE] [--only CASE] [--peer-seconds S] [--lateral METRES]\n",
                   words[0]);
      std::exit(2);
    }
  }
  return options;
}

}  // namespace
}  // namespace polynya::bench

int main(int count, char** words) {
  using namespace polynya::bench;
  const Options options = options_of(count, words);
  std::FILE* csv = options.csv.empty() ? nullptr : std::fopen(options.csv.c_str(), "w");
  if (csv != nullptr)
    std::fputs(
        "case,engine,floes,step_s,covered_s,ms_per_s,median_us,mean_awake,most_awake,mean_contacts,"
        "real_time_factor,load_s,peak_MiB,bends,splits,surge_kN,ratio\n",
        csv);
  std::puts(
      "| case | engine | floes | Δt s | run s | ms a simulated s | µs/Δt, median | awake | touching pairs | × real "
      "time | load s | peak MiB | time |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  auto all = cases(options.is_quick);
  if (options.lateral) {
    for (Case& at : all) {
      at.edit = moved_to_port(at.edit, *options.lateral);
      at.repeats = 1;
    }
  }
  for (const Case& at : all) {
    if (options.only.empty() || options.only == at.name) run_case(at, all, options, csv);
  }
  if (csv != nullptr) std::fclose(csv);
}
