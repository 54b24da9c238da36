#include <algorithm>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/load_scene.hpp"

namespace polynya::app {

int validate(const ValidateOptions& options) {
  const auto loaded =
      load_scene(options.scene, {}, options.json ? ProblemFormat::kJson : ProblemFormat::kText);
  if (!loaded) return loaded.error();
  if (options.json) {
    write_out(io::to_json_text(loaded->hints));
    return kDone;
  }
  print_hints(*loaded);
  if (options.resolved) {
    write_out(loaded->resolved_text);
    return kDone;
  }
  const simulation::Scene& scene = loaded->scene;
  const auto structures =
      static_cast<std::size_t>(std::ranges::count_if(scene.ships, [](const simulation::ShipSpec& ship) {
        return std::holds_alternative<simulation::FixedInPlace>(ship.propulsion);
      }));
  const auto counted = [](std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
  };
  print_out("{}: valid; \"{}\" with {}{} and {}, {:g} s in steps of {:g} s, hash {}\n",
            options.scene == "-" ? "stdin" : options.scene, scene.name,
            counted(scene.ships.size() - structures, "ship"),
            structures > 0 ? ", " + counted(structures, "structure") : "",
            counted(scene.floes.size(), "floe"), scene.time.until, scene.time.step, loaded->hash);
  for (const io::FieldReport& field : loaded->fields) {
    const simulation::FloeFieldOutcome& outcome = field.outcome;
    print_out("floes[{}]: {} floes, sizes {:.4g} m ± {:.3g} %, {:.4g} % of {:.6g} m² covered, {} left out\n",
              field.group, outcome.count, outcome.mean_size, 100 * outcome.size_spread,
              100 * outcome.concentration(), outcome.region_area, outcome.left_out);
  }
  return kDone;
}

}  // namespace polynya::app
