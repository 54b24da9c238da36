#include "views/player/player_page.hpp"

#include "io/text/base64.hpp"
#include "io/text/xml_text.hpp"

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

}  // namespace

std::string player_page(const io::Run& run, const PlayerData& data) {
  std::string page;
  std::string_view rest = kPlayerTemplate;
  const auto put = [&](std::string_view mark, const std::string& text) {
    const std::size_t at = rest.find(mark);
    page += rest.substr(0, at);
    page += text;
    rest.remove_prefix(at + mark.size());
  };
  put("{{title}}", io::escaped(run.scene.scene.name));
  put("{{info}}", in_script(data.info));
  put("{{columns}}", io::to_base64(data.columns.bytes()));
  page += rest;
  return page;
}

}  // namespace polynya::views
