#include <cmath>
#include <cstring>
#include <map>

#include "../base64.hpp"
#include "../io/scene_text.hpp"
#include "program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

/// The data of a run in a page, read from the page's text as a browser reads it.
struct Page {
  std::string text;
  io::JsonValue info;
  std::map<std::string, std::string> columns;

  explicit Page(const std::filesystem::path& file, const std::string& info_id = "run-info",
                const std::string& columns_id = "run-columns")
      : text(read_file(file)) {
    info = io::parse_json(script(info_id)).root;
    const std::string bytes = from_base64(script(columns_id));
    for (const io::JsonValue& column : info.find("columns")->items()) {
      static const std::map<std::string, std::size_t> kSizes{{"f64", 8}, {"i32", 4}, {"u8", 1}};
      const auto offset = static_cast<std::size_t>(column.find("offset")->number());
      const auto count = static_cast<std::size_t>(column.find("count")->number());
      const std::size_t size = count * kSizes.at(column.find("type")->text());
      EXPECT_EQ(offset % 8, 0U);
      EXPECT_LE(offset + size, bytes.size());
      columns[column.find("name")->text()] = bytes.substr(offset, size);
    }
  }
  std::string script(const std::string& id) const {
    const std::size_t tag = text.find("id=\"" + id + "\"");
    const std::size_t start = text.find('>', tag) + 1;
    return text.substr(start, text.find("</script>", start) - start);
  }
  template <class Number>
  std::vector<Number> column(const std::string& name) const {
    const std::string& bytes = columns.at(name);
    std::vector<Number> values(bytes.size() / sizeof(Number));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
};

/// Returns the value that a message advises for an option, or an empty text if it advises none.
std::string advised(const std::string& message, const std::string& option) {
  const std::size_t at = message.rfind(option + ' ');
  if (at == std::string::npos) return "";
  const std::size_t start = at + option.size() + 1;
  const std::string value = message.substr(start, message.find_first_of(" \n", start) - start);
  return value.ends_with(',') ? value.substr(0, value.size() - 1) : value;
}

class ViewCommand : public PlateRun {
 protected:
  static Outcome view(const Words& words, const std::string& of = "run") { return on_run("view", words, of); }
  static Page page(Words words = {}) {
    words.insert(words.end(), {"--out", "page.html"});
    expect_code(0, view(words));
    return Page(folder->path() / "page.html");
  }
};

/// Returns the rings of a floe from the page's columns. They are stored whole, or assembled from the rings of the
/// floe's parent.
std::vector<geometry::Ring> rings_in(const Page& held, std::size_t floe,
                                     const std::vector<std::vector<geometry::Ring>>& before, std::size_t& points_used) {
  const auto points = held.column<double>("points_m");
  const auto ends = held.column<std::int32_t>("ring_ends"), rings_of = held.column<std::int32_t>("rings_of");
  const auto of = held.column<std::int32_t>("part_floe"), ring = held.column<std::int32_t>("part_ring");
  const auto first = held.column<std::int32_t>("part_first"), count = held.column<std::int32_t>("part_count");
  const auto parent = held.column<std::int32_t>("parent");
  const auto last = static_cast<std::size_t>(ends[static_cast<std::size_t>(rings_of[floe + 1] - 1)]);
  const std::size_t start = points_used;
  geometry::Ring all;
  const auto add_new = [&](std::size_t at) { all.push_back({points[2 * at], points[2 * at + 1]}); };
  bool is_parts = false;
  for (std::size_t part = 0; part < of.size(); ++part) {
    if (of[part] != static_cast<std::int32_t>(floe)) continue;
    is_parts = true;
    for (int k = first[part]; k < first[part] + count[part]; ++k) {
      if (ring[part] < 0) {
        add_new(start + static_cast<std::size_t>(k));
        ++points_used;
        continue;
      }
      const auto& from = before[static_cast<std::size_t>(parent[floe])][static_cast<std::size_t>(ring[part])];
      all.push_back(from[static_cast<std::size_t>(k) % from.size()]);
    }
  }
  for (std::size_t k = 0; !is_parts && k < last; ++k, ++points_used) add_new(start + k);
  EXPECT_EQ(all.size(), last);
  std::vector<geometry::Ring> rings;
  std::ptrdiff_t from = 0;
  for (auto r = static_cast<std::size_t>(rings_of[floe]); r < static_cast<std::size_t>(rings_of[floe + 1]); ++r) {
    rings.emplace_back(all.begin() + from, all.begin() + ends[r]);
    from = ends[r];
  }
  return rings;
}

/// The page's values equal the run's to the bit, and each new vertex is stored once: like floes.ndjson, the page grows
/// with the new vertices only.
TEST_F(ViewCommand, ThePageHoldsFramesAndShapesThemselves) {
  const Page held = page();
  EXPECT_EQ(held.text, page().text) << "the same bytes again";
  EXPECT_EQ(held.columns.at("frames"), read_file(folder->path() / "run/frames.bin"));
  std::vector<std::vector<geometry::Ring>> all;
  std::size_t points_used = 0;
  for (std::size_t floe = 0; floe < run->floes.size(); ++floe) {
    const auto shape = run->shape(static_cast<simulation::FloeId>(floe));
    std::vector<geometry::Ring> rings{shape->outer};
    rings.insert(rings.end(), shape->holes.begin(), shape->holes.end());
    all.push_back(rings_in(held, floe, all, points_used));
    EXPECT_EQ(all.back(), rings) << floe;
  }
  EXPECT_EQ(2 * points_used, held.column<double>("points_m").size());
  EXPECT_GT(held.column<std::int32_t>("part_floe").size(), 20U);
}

TEST_F(ViewCommand, AThinnedPageTellsTheSameAtItsFrames) {
  const Page held = page("--every 4 --from 5 --until 27");
  io::Run thin = *run;
  auto frames = checked(io::decode_frames(held.columns.at("frames")));
  thin.frames = std::move(*frames);
  std::vector<double> times;
  for (const io::Frame& frame : thin.frames) times.push_back(frame.time);
  ASSERT_EQ(times, (std::vector<double>{6, 14, 22, 26}));
  const io::MotionIndex all(*run), some(thin);
  int compared = 0;
  for (const double time : times) {
    for (const io::RunFloe& floe : run->floes) {
      if (!run->is_alive(floe.birth.floe, time)) continue;
      const auto a = all.floe_at(floe.birth.floe, time), b = some.floe_at(floe.birth.floe, time);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      EXPECT_LT(length(a->position - b->position), 1e-9);
      EXPECT_NEAR(a->angle, b->angle, 1e-12);
      EXPECT_EQ(a->velocity, b->velocity);
      ++compared;
    }
  }
  EXPECT_GE(compared, 4);
}

TEST_F(ViewCommand, ThePageNeedsNothingElse) {
  const Page held = page();
  EXPECT_LACKS(held.text, "src=", "@import", "url(http", "<link rel=\"stylesheet");
  EXPECT_LACKS(held.text, "{{", "/*{{");
  EXPECT_HAS(held.text, "Permission is hereby granted") << "uPlot's licence";
}

TEST_F(ViewCommand, TwoRunsStandInOnePageEachWithItsNumbers) {
  expect_code(
      0, polynya({"view", "run", "run", "--until", "20", "--label", "one,two & more", "--out", "both.html"}, *folder));
  const std::filesystem::path file = folder->path() / "both.html";
  const Page first(file, "info-0", "columns-0"), second(file, "info-1", "columns-1");
  for (const Page* held : {&first, &second}) {
    EXPECT_EQ(held->column<double>("area_m2").size(), run->floes.size());
    EXPECT_EQ(held->info.find("events")->items().size(), run->events.size());
  }
  const io::JsonDocument pair = io::parse_json(first.script("pair-info"));
  EXPECT_EQ(pair.root.find("labels")->items()[1].text(), "two & more");
  EXPECT_EQ(pair.root.find("axis_s")->items()[0].number(), 0);
  EXPECT_EQ(pair.root.find("axis_s")->items()[1].number(), 20);
  const io::JsonDocument player = io::parse_json(first.script("player-page"));
  EXPECT_HAS(player.root.text(), "{{title}}", "{{options}}", "{{info}}", "{{columns}}");
}

TEST_F(ViewCommand, ATooLargePageIsRefusedWithTheOptionsThatMakeItSmaller) {
  EXPECT_BEGINS(expect_code(0, view("")).out, "run/view.html");
  const auto bytes = static_cast<double>(std::filesystem::file_size(folder->path() / "run/view.html"));
  const Outcome refused = expect_code(2, view(fmt::format("--limit {:.3f} --out large.html", bytes / 1e6 - 0.002)));
  EXPECT_FALSE(std::filesystem::exists(folder->path() / "large.html"));
  EXPECT_HAS(refused.err, "--area", "--every", "--from", "--until");
  EXPECT_EQ(view({"--limit", advised(refused.err, "--limit"), "--out", "large.html"}).code, 0) << refused.err;
}

TEST(WideField, AnAreaHoldsTheFloesThatComeWithinIt) {
  const TemporaryFolder folder;
  write_file(folder / "wide.json",
             scene({R"("time": {"step_s": 0.1, "until_s": 4}, "record": {"frames_interval_s": 1})",
                    list("ships", {ship(R"("position_m": [-80, 600])")}),
                    list("floes", {R"({"lattice": {"columns": 60, "rows": 60, "pitch_m": 20, "size_m": 15}})"})}));
  ASSERT_EQ(polynya("run wide.json --out run --no-map", folder).code, 0);
  const auto run = io::read_run(folder / "run");
  ASSERT_EQ(polynya("view run --area 103,203,197,297 --out part.html", folder).code, 0);
  const Page held(folder / "part.html");
  const auto ids = held.column<std::int32_t>("floe_id");
  EXPECT_EQ(ids.size(), 25U);  // five columns and rows of squares, which stay where they are
  const auto size = held.column<double>("area_m2");
  for (std::size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(size[k], run->floe(ids[k])->birth.area);
}

}  // namespace
}  // namespace polynya::tests
