#include "views/player/player_page.hpp"

#include <algorithm>
#include <vector>

#include "io/text/json_writer.hpp"

namespace polynya::views {

namespace {

/// JSON as it may stand in a script element: no "<" that could end it or start a comment.
std::string in_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

/// What is put in for a mark of a template.
struct Filling {
  std::string_view mark;
  std::string text;
};

/// A template with what its marks stand for, in the order in which they stand in it.
std::string filled(std::string_view page, const std::vector<Filling>& fillings) {
  std::string text;
  for (const auto& [mark, filling] : fillings) {
    const std::size_t at = page.find(mark);
    text += page.substr(0, at);
    text += filling;
    page.remove_prefix(at + mark.size());
  }
  text += page;
  return text;
}

/// The names of the two runs, and the times that both have on their axes [s].
std::string pair_info(const std::array<ShownRun, 2>& runs) {
  std::string text;
  io::JsonWriter json(text);
  const auto& [first, second] = runs;
  json.open('{').key("labels").list(std::array{first.label, second.label});
  json.key("axis_s").list(
      std::array{std::min(first.data.start, second.data.start), std::max(first.data.end, second.data.end)});
  json.close('}');
  return text;
}

std::string as_json(std::string_view words) {
  std::string text;
  io::JsonWriter json(text);
  json.value(words);
  return text;
}

}  // namespace

std::string player_page(const io::Run& run, const PlayerData& data, const std::string& options) {
  return filled(kPlayerTemplate, {{"{{title}}", io::escaped(shown_name(run.scene.scene))},
                                  {"{{options}}", in_script(options)},
                                  {"{{info}}", in_script(data.info)},
                                  {"{{columns}}", io::to_base64(data.columns.bytes())}});
}

std::string pair_page(const std::array<ShownRun, 2>& runs) {
  const auto& [first, second] = runs;
  return filled(kPairTemplate, {{"{{title}}", io::escaped(first.label + " and " + second.label)},
                                {"{{pair}}", in_script(pair_info(runs))},
                                {"{{player}}", in_script(as_json(kPlayerTemplate))},
                                {"{{info}}", in_script(first.data.info)},
                                {"{{columns}}", io::to_base64(first.data.columns.bytes())},
                                {"{{info}}", in_script(second.data.info)},
                                {"{{columns}}", io::to_base64(second.data.columns.bytes())}});
}

}  // namespace polynya::views
