#include <memory>

#include "app/command_line.hpp"
#include "app/number_option.hpp"
#include "app/view.hpp"

namespace polynya::app {

Command add_view(CLI::App& app) {
  auto* command = app.add_subcommand("view", "Write a page that plays a run in any browser, offline");
  command->footer(
      "Examples:\n"
      "  polynya view runs/sawamura2017-fig4b                    runs/sawamura2017-fig4b/view.html\n"
      "  polynya view runs/sawamura2017-fig4b --out voyage.html\n"
      "  polynya view runs/huge --every 5 --from 100 --until 400\n"
      "\n"
      "Exit codes: 0 done, 2 usage (also: larger than --limit), 5 input/output.\n");
  auto options = std::make_shared<ViewOptions>();
  command->add_option("run", options->run, "The run folder")->required()->type_name("RUN");
  command->add_option("--out", options->out, "The page; view.html in the run folder if not given")
      ->type_name("FILE");
  command->add_option("--every", options->every, "Only each N-th frame, and the last")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--from", options->from, "Only from that time on [s]")->type_name("S")->check(finite());
  command->add_option("--until", options->until, "Only up to that time [s]")->type_name("S")->check(finite());
  command->add_option("--limit", options->most_megabytes, "The largest page to write [MB]; 100 if not given")
      ->type_name("MB")
      ->check(between(0.001, 2000));
  return [options] { return view(*options); };
}

}  // namespace polynya::app
