// Whole runs side by side with Box2D 2.4.1, Chipmunk 7.0.3 and, where its sources are, Box2D 3.2 stepping the
// same bodies at the same step, without any fracture. One process, one engine after another.
//   polynya_bench_voyages [--quick] [--csv FILE] [--only CASE] [--peer-seconds S] [--lateral METRES]
// Prints the table of docs/performance.md (Markdown). bench/performance.sh puts it there.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>

#include "bench/voyage_run.hpp"

namespace polynya::bench {
namespace {

struct Options {
  bool is_quick = false;
  std::string csv;
  std::string only;
  double peer_seconds = 120;  ///< at most, for each peer's run of a case [s]
  /// Of the ships from where their scenes have them, to port: such voyages are run once, for many of them say
  /// more than the same one again [m].
  std::optional<double> lateral;
};

/// One row of the table: a scene, and what is compared.
struct Case {
  std::string name;
  std::string scene;
  Edit edit;
  double until = 0;  ///< [s]
  bool has_peers = true;
  std::string compared_to;  ///< the case whose step time is the yardstick; empty: none
  int threads = 1;          ///< of ours
  int repeats = 1;          ///< of all its engines; of each block of steps the quietest counts
};

/// As many floes again, far away from the voyage.
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

/// A round plate of 300 m in level-plate's place, its outline drawn with so many corners.
Edit round_plate(int corners) {
  return [corners](simulation::Scene& scene) {
    geometry::Ring ring;
    for (int i = 0; i < corners; ++i) {
      // Not symmetric about the course, so that no corner lies just ahead of the stem.
      const double angle = 2 * std::numbers::pi * (i + 0.3) / corners;
      ring.push_back({150 + 150 * std::cos(angle), 150 * std::sin(angle)});
    }
    scene.floes.front().polygon_in_world = {ring, {}};
  };
}

/// The scene's bodies under one or the other law of contact.
Edit with_law(simulation::ContactLaw law) {
  return [law](simulation::Scene& scene) { scene.contact.law = law; };
}

/// The hulls some way to port: another voyage through the same ice.
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

std::vector<Case> cases(bool is_quick) {
  const double part = is_quick ? 0.1 : 1;
  const Edit crush = with_law(simulation::ContactLaw::kCrush);
  const Edit impulse = with_law(simulation::ContactLaw::kImpulse);
  const char* fig4b = "sawamura2017-fig4b.json";
  return {{"voyage", fig4b, crush, 550 * part, true, "", 1, 3},
          {"voyage-impulse", fig4b, impulse, 550 * part, true, "", 1, 3},
          {"field-10000", "field-10000.json", crush, 500 * part, true, "", 1, 3},
          {"field-10000-impulse", "field-10000.json", impulse, 500 * part, true, "", 1, 3},
          {"field-20000", "field-10000.json", double_the_field, 500 * part, false, "field-10000", 1, 3},
          {"field-100000", "field-100000.json", {}, 500 * part, true, "", 1, 2},
          {"cylinder-shear", "cylinder-shear.json", crush, 400 * part, true, "", 1, 2},
          {"cylinder-shear-impulse", "cylinder-shear.json", impulse, 400 * part, true, "", 1, 2},
          {"cylinder-shear-2", "cylinder-shear.json", crush, 400 * part, false, "cylinder-shear", 2, 2},
          {"plate-100", "level-plate.json", round_plate(100), 200 * part, false, "", 1, 3},
          {"plate-10000", "level-plate.json", round_plate(10000), 200 * part, false, "plate-100", 1, 3}};
}

void print_row(const Case& at, const RunCost& cost, std::size_t floes, const std::string& ratio, std::FILE* csv) {
  std::printf("| %s | %s | %zu | %.4g | %.0f | %.1f | %.1f | %.0f | %.1f | %.4g | %.2f | %.0f | %s |\n",
              at.name.c_str(), cost.engine.c_str(), floes, cost.step, cost.step * static_cast<double>(cost.steps),
              1e6 * cost.mean_step(), 1e6 * cost.median_step(), cost.mean_awake, cost.mean_contacts,
              cost.real_time_factor(), cost.load, cost.memory, ratio.c_str());
  std::fflush(stdout);
  if (csv == nullptr) return;
  std::fprintf(csv, "%s,%s,%zu,%.6g,%.6g,%.4f,%.4f,%.2f,%d,%.2f,%.6g,%.4f,%.1f,%d,%d,%s\n", at.name.c_str(),
               cost.engine.c_str(), floes, cost.step, cost.step * static_cast<double>(cost.steps),
               1e6 * cost.mean_step(), 1e6 * cost.median_step(), cost.mean_awake, cost.most_awake, cost.mean_contacts,
               cost.real_time_factor(), cost.load, cost.memory, cost.bends, cost.splits, ratio.c_str());
  std::fflush(csv);
}

std::string times(double ratio) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", ratio);
  return text;
}

/// Runs what is to be compared one after the other, and that so many times over.
std::vector<RunCost> alternate(int repeats, const std::vector<std::function<RunCost()>>& runs) {
  std::vector<RunCost> costs;
  costs.reserve(runs.size());
  for (const auto& run : runs) costs.push_back(run());
  for (int i = 1; i < repeats; ++i) {
    for (std::size_t k = 0; k < runs.size(); ++k) keep_quieter(costs[k], runs[k]());
  }
  return costs;
}

void run_case(const Case& at, const std::vector<Case>& all, const Options& options, std::FILE* csv) {
  const simulation::Scene scene = load(at.scene, at.edit);
  const auto steps = std::lround(at.until / scene.time.step);
  const auto ours = [&](const Case& which) {
    return [&which, steps] { return run_polynya(which.scene, which.edit, {1e9, steps, which.threads}); };
  };
  const auto yardstick = std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.name == at.compared_to; });
  std::vector<std::function<RunCost()>> runs{ours(at)};
  if (yardstick != all.end()) runs.emplace_back(ours(*yardstick));
  const PeerScene bodies = at.has_peers ? peer_scene(simulation::Simulation{simulation::Scene(scene)}) : PeerScene{};
  const Limits limits{options.peer_seconds, steps};
  if (at.has_peers) {
    for (const Peer& peer : peers()) runs.emplace_back([&] { return peer.run(peer, bodies, limits); });
  }
  const std::vector<RunCost> costs = alternate(at.repeats, runs);
  const RunCost& own = costs.front();
  const std::string ratio =
      yardstick == all.end() ? "" : times(own.mean_step() / costs[1].mean_step()) + " x " + yardstick->name;
  print_row(at, own, scene.floes.size(), ratio, csv);
  if (!at.has_peers) return;
  for (std::size_t k = 1; k < costs.size(); ++k) {
    // Over the same steps, where a peer was stopped early.
    const double over = costs[k].total() / own.total_of_first(costs[k].steps);
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
        "case,engine,floes,step_s,covered_s,mean_us,median_us,mean_awake,most_awake,mean_contacts,"
        "real_time_factor,load_s,peak_MiB,bends,splits,ratio\n",
        csv);
  std::puts(
      "| case | engine | floes | Δt s | run s | µs/step, mean | median | awake | touching pairs | × real "
      "time | load s | peak MiB | step time |");
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
