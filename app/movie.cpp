#include <array>
#include <memory>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/python.hpp"

namespace polynya::app {
namespace {

/// polynya.movie (python/polynya/movie) reads and checks their values.
constexpr std::array kOptions{
    PythonOption{"--out", "FILE",
                 "The film: .mp4, .gif, or .png, the picture at --from; voyage.mp4 if not given"},
    PythonOption{"--from", "S", "Simulated time at which it begins; the run's start if not given"},
    PythonOption{"--to", "S", "Simulated time at which it ends; the run's end if not given"},
    PythonOption{"--speed", "X",
                 "Simulated seconds a second of the film; one for about half a minute if not given"},
    PythonOption{"--size", "WxH", "In pixels; 1280x720 if not given"},
    PythonOption{"--follow", "SHIP",
                 "The ship that the map goes with, by its name; all of the run if not given"},
};

}  // namespace

Command add_movie(CommandLine& app) {
  CommandLine command = app.add_command(
      "movie", "Make a film of a run: the ice, and the force on the ship",
      "Examples:\n"
      "  polynya movie runs/sawamura2017-fig4b --out voyage.mp4\n"
      "  polynya movie runs/sawamura2017-fig4b --out voyage.gif --size 800x450 --from 100 --to 300 --speed "
      "20\n"
      "  polynya movie runs/sawamura2017-fig4b --out voyage.mp4 --follow icebreaker\n"
      "  polynya movie runs/sawamura2017-fig4b --out frame.png --from 330          one picture, without "
      "ffmpeg\n"
      "\n"
      "Needs Python 3 with numpy and matplotlib, and ffmpeg (./setup.sh python). A film that is stopped "
      "leaves "
      "no file.\n"
      "Exit codes: 0 done, 2 usage, 5 input/output.\n");
  auto run = std::make_shared<std::string>();
  auto values = std::make_shared<PythonOptions>(kOptions);
  command.option("run", *run, "RUN", "The run folder; a run that is not finished is shown as far as it got")
      .required();
  values->add_to(command);
  return {command, [run, values] {
            std::vector<std::string> words{*run};
            values->append_to(words);
            return become_python("polynya.movie", words);
          }};
}

}  // namespace polynya::app
