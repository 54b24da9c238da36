// The files of a run are read back as they were written. Damaged files are refused with the number of the line.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include "scene_text.hpp"
#include "temporary_folder.hpp"
#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "io/run/event_records.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_loop.hpp"
#include "io/run/run_reader.hpp"
#include "io/run/run_writer.hpp"

namespace polynya::io {
namespace {

using namespace tests;

// A ship breaks a plate and pushes a floe in drifting water, so that every file has content.
const std::string kScene = R"({
  "name": "small", "time": {"step_s": 0.01, "until_s": 8}, "water": {"drift_m_per_s": [0.02, -0.01]},
  "record": {"forces_interval_s": 0.1, "frames_interval_s": 0.5, "contacts": "all"},
  "ships": [{"name": "a ship", "hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30}, "mass_kg": 3e6,
             "moment_of_inertia_kg_m2": 5e8, "position_m": [-30.5, 2], "propulsion": {"constant_speed_m_per_s": 2}, )"
                           R"("panels": {"length_m": 2}}],
  "floes": [{"rectangle": {"corner_m": [0, -20], "size_m": [60, 40]}}, {"rectangle": {"corner_m": [70, 0], )"
                           R"("size_m": 5}, "angular_velocity_deg_per_s": 1},
            {"polygon": {"outer_m": [[70, 10], [80, 10], [80, 20], [70, 20]], "holes_m": [[[72, 12], )"
                           R"([72, 14], [74, 14]]]}}]
})";

struct Recorded {
  std::vector<simulation::Birth> births;
  std::vector<simulation::Event> events;
  std::vector<simulation::HullSample> samples;
  std::vector<std::pair<double, std::vector<simulation::FloeState>>> frames;
  std::vector<std::pair<double, std::vector<geometry::Point>>> centroids;
  std::vector<RunContact> contacts;
  std::vector<RunContact> peaks;
  std::vector<simulation::PanelSample> panels;
};

/// Runs the scene into a folder and returns its records.
Recorded write_run(const LoadedScene& scene, const std::filesystem::path& folder) {
  Recorded recorded;
  simulation::Simulation simulation(scene.scene);
  auto writer = RunWriter::create(folder, false, scene);
  EXPECT_TRUE(writer.has_value());
  const auto add = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  const auto take = [&] {
    const simulation::Journal& journal = simulation.journal();
    add(recorded.births, journal.births);
    add(recorded.events, journal.events);
    add(recorded.samples, journal.samples);
    add(recorded.panels, journal.panels);
    for (const simulation::LoadPeak& peak : journal.peaks) recorded.peaks.push_back({peak.time, peak.state});
    writer->record(simulation.journal());
  };
  const auto frame = [&] {
    writer->frame(simulation);
    recorded.frames.emplace_back(simulation.time(), simulation.floe_states());
    for (const auto& state : simulation.contact_states()) recorded.contacts.push_back({simulation.time(), state});
    auto& points = recorded.centroids.emplace_back(simulation.time(), std::vector<geometry::Point>{}).second;
    for (const auto& state : recorded.frames.back().second) {
      points.push_back(transform(state.world_from_body, geometry::measure(*state.polygon_in_body).centroid));
    }
  };
  take();
  frame();
  for (int step = 1; step <= 800; ++step) {
    simulation.step();
    take();
    if (step % 50 == 0) frame();
  }
  RunSummary summary;
  summary.finished = true;
  summary.steps = 800;
  summary.sim_time = simulation.time();
  summary.areas = simulation.area_ledger();
  summary.counts = simulation.counts();
  summary.peaks = writer->peaks();
  summary.warnings = {"a \"warning\""};
  EXPECT_TRUE(writer->finish(summary, &simulation).has_value());
  return recorded;
}

/// Returns an event with all the data that are kept of it.
std::string line_of(const simulation::Event& event, const LoadedScene& scene) {
  std::string text;
  append_event(text, event, scene.scene);
  return text;
}

TEST(Run, AnEventOfASplitStatesAndReadsBackBothSides) {
  simulation::Split split;
  split.by_floe = 7;
  split.floe = 8;
  fracture::FailureCriteria& c = split.criterion;
  c.contact_force = 1e5 / 3;
  c.crack_length = 50.1;
  c.crack_width = 60.2;
  c.flank_forces[0] = 2e5 / 3;
  c.flank_forces[1] = 4e5 / 3;
  c.opening_force = 2e5 / 3;
  c.opening_capacity = 65e3;
  c.fracture_toughness = 115e3;
  const LoadedScene scene = load(kScene);
  const auto again = [&](std::string_view kind) {
    const std::string text = line_of({.time = 1, .ship = -1, .point_in_world = {1, 2}, .what = split}, scene);
    EXPECT_HAS(text, kind);
    const simulation::Event read = event_of(json_of(text), scene.scene);
    EXPECT_EQ(line_of(read, scene), text);
    return simulation::deciding_load(read.criteria(), true).load;
  };
  EXPECT_EQ(again("\"opening force >= opening capacity\""), c.opening_force);
  c.flexural_strength = 0.8e6;
  c.section_stress = 0.81e6;
  EXPECT_EQ(again("\"contact force >= force that breaks a beam\""), c.contact_force);
  c.section_stress = 0;
  c.splitting_force = 10e6;
  c.collision_force = 11e6;
  EXPECT_EQ(again("\"collision force > splitting force\""), 11e6);
}

/// Returns the fields of a contact. Without a waterline the arc is not a number.
std::vector<double> fields_of(const simulation::ContactState& state) {
  std::vector<double> fields{static_cast<double>(state.on.ship), static_cast<double>(state.on.floe),
                             static_cast<double>(state.by.ship), static_cast<double>(state.by.floe)};
  for (const ContactColumn& column : contact_columns()) {
    const double value = column.read(state);
    fields.push_back(std::isnan(value) ? -1e9 : value);
  }
  return fields;
}

void expect_same(const std::vector<RunContact>& read, const std::vector<RunContact>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].time, written[i].time);
    EXPECT_EQ(fields_of(read[i].state), fields_of(written[i].state)) << i;
  }
}

class RunFiles : public testing::Test {
 protected:
  io::Run read() const { return std::move(*checked(read_run(folder / "run"))); }
  /// Why the run cannot be read with that text in a file.
  std::string refusal(std::string_view name, const std::string& text) const {
    write_file(path(name), text);
    const auto run = read_run(folder / "run");
    return run ? "" : run.error();
  }
  std::filesystem::path path(std::string_view name) const { return folder.path() / "run" / name; }
  std::string text(std::string_view name) const { return read_file(path(name)); }

  const LoadedScene scene = load(kScene, ".", "small.json");
  const TemporaryFolder folder;
  const Recorded recorded = write_run(scene, folder / "run");
};

TEST_F(RunFiles, ReadBackWhatWasWritten) {
  const io::Run run = read();
  EXPECT_EQ(run.scene.hash, scene.hash);
  EXPECT_GT(recorded.events.size(), 3U);
  ASSERT_EQ(run.events.size(), recorded.events.size());
  for (std::size_t i = 0; i < run.events.size(); ++i)
    EXPECT_EQ(line_of(run.events[i], scene), line_of(recorded.events[i], scene));
  ASSERT_EQ(run.floes.size(), recorded.births.size());
  for (std::size_t i = 0; i < run.floes.size(); ++i) {
    EXPECT_EQ(*run.shape(recorded.births[i].floe), recorded.births[i].polygon_in_body);
    EXPECT_EQ(run.floes[i].birth.parent, recorded.births[i].parent);
    EXPECT_EQ(run.floes[i].birth.area, recorded.births[i].area);
    EXPECT_EQ(run.floes[i].birth.centroid_in_body, recorded.births[i].centroid_in_body);
  }
  ASSERT_EQ(run.samples.size(), recorded.samples.size());
  for (std::size_t i = 0; i < run.samples.size(); ++i)
    for (const ForceColumn& column : force_columns())
      EXPECT_EQ(column.read(run.samples[i]), column.read(recorded.samples[i])) << column.name;
  EXPECT_GT(recorded.contacts.size(), 10U);
  expect_same(run.contacts, recorded.contacts);
  std::vector<RunContact> peaks = recorded.peaks;  // which the file has where they ended
  std::ranges::stable_sort(peaks, {}, &RunContact::time);
  EXPECT_GT(peaks.size(), 3U);
  expect_same(run.peaks, peaks);
  std::size_t of_frames = 0;
  for (const Frame& frame : run.frames) of_frames += run.contacts_at(frame.time).size();
  EXPECT_EQ(of_frames, run.contacts.size()) << "each belongs to a frame";
}

TEST_F(RunFiles, PanelsHaveTheirTable) {
  std::string expected = header_of(run_file::kPanels);
  for (const simulation::PanelSample& panel : recorded.panels) append_panel(expected, panel, scene.scene);
  EXPECT_GT(recorded.panels.size(), 30U);
  EXPECT_EQ(text(run_file::kPanels), expected);
}

TEST_F(RunFiles, ContactsOfEarlierVersionsHaveNoPlaces) {
  std::string older;
  for (std::istringstream lines(text(run_file::kContacts)); std::getline(lines, older);) {
    std::size_t end = 0;
    for (int column = 0; column < 11; ++column) end = older.find(',', end + 1);
    simulation::ContactState state;
    std::string_view values = std::string_view(older).substr(0, end);
    for (int column = 0; column < 5; ++column) values.remove_prefix(values.find(',') + 1);
    if (older.starts_with("t_s")) continue;
    EXPECT_NO_THROW(read_row(values, state, contact_columns())) << values;
    EXPECT_TRUE(std::isnan(state.arc));
    EXPECT_GT(state.depth, 0);
  }
}

std::string page_of_run_folders() {
  return read_file(std::string(POLYNYA_SOURCE_DIR) + "/docs/run-folder.md");
}

TEST(LoadColumns, AreDocumented) {
  const std::string page = page_of_run_folders();
  for (const ContactColumn& column : contact_columns())
    EXPECT_HAS(page, fmt::format("| `{}` | {} |\n", column.name, column.meaning));
  for (const PanelColumn& column : panel_columns())
    EXPECT_HAS(page, fmt::format("| `{}` | {} |\n", column.name, column.meaning));
}

TEST_F(RunFiles, ForcesAreReadByTheirColumnsNames) {
  const std::string whole = text(run_file::kForces);
  // A run of before, without the columns that are optional: the rest in another order.
  std::vector<const ForceColumn*> kept;
  for (const ForceColumn& column : force_columns())
    if (!column.is_optional) kept.insert(kept.begin(), &column);
  std::string older = "t_s,ship";
  for (const ForceColumn* column : kept) older.append(1, ',').append(column->name);
  for (const simulation::HullSample& sample : recorded.samples) {
    older += fmt::format("\n{},a ship", sample.time);
    for (const ForceColumn* column : kept) older += fmt::format(",{}", column->read(sample));
  }
  EXPECT_EQ(refusal(run_file::kForces, older + '\n'), "");
  const io::Run run = read();
  ASSERT_EQ(run.samples.size(), recorded.samples.size());
  for (const ForceColumn* column : kept)
    for (std::size_t i = 0; i < run.samples.size(); i += 7)
      ASSERT_NEAR(column->read(run.samples[i]), column->read(recorded.samples[i]),
                  1e-12 * std::abs(column->read(recorded.samples[i])))
          << column->name;
  for (const auto& [other, message] :
       {std::pair{",", "no column \"sway_N\""}, {",sway_kN,", "\"sway_kN\""}, {",surge_N,", "\"surge_N\""}})
    EXPECT_HAS(refusal(run_file::kForces, replaced(whole, ",sway_N,", other)), message);
}

TEST(ForceColumns, NameTheirUnitsOnceAndAreDocumented) {
  const std::map<std::string_view, std::string_view> suffixes{
      {"N", "_N"},         {"N·m", "_Nm"},        {"m", "_m"}, {"°", "_deg"}, {"m²", "_m2"},
      {"m/s", "_m_per_s"}, {"°/s", "_deg_per_s"}, {"W", "_W"}, {"", ""}};
  const std::string page = page_of_run_folders();
  std::set<std::string_view> names;
  for (const ForceColumn& column : force_columns()) {
    ASSERT_TRUE(suffixes.contains(column.unit)) << column.name;
    EXPECT_TRUE(column.name.ends_with(suffixes.at(column.unit))) << column.name;
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    const char* over = column.over == Over::kMean          ? "mean"
                       : column.over == Over::kLargestStep ? "largest step"
                                                           : "at its end";
    EXPECT_HAS(page, fmt::format("| `{}` | {} | {} |\n", column.name, over, column.meaning));
  }
}

template <class... Kinds>
constexpr std::size_t count_kinds_of_ice(const std::variant<Kinds...>*) {
  return (std::size_t{std::is_base_of_v<simulation::IceEvent, Kinds>} + ...);
}

TEST(EventFields, AreDocumented) {
  const std::string page = page_of_run_folders();
  using Kinds = decltype(simulation::Event::what);
  constexpr std::size_t kKinds = std::variant_size_v<Kinds>;
  constexpr std::size_t kOfIce = count_kinds_of_ice(static_cast<const Kinds*>(nullptr));
  for (const EventField& field : event_fields()) {
    const std::string of = field.kinds.size() == kKinds   ? "all"
                           : field.kinds.size() == kOfIce ? "all of ice"
                                                          : fmt::format("`{}`", fmt::join(field.kinds, "`, `"));
    const std::string unit = field.meaning.unit.empty() ? "" : fmt::format(" [{}]", field.meaning.unit);
    const std::string row = fmt::format("| `{}{}` | {} | {}{} |\n", field.is_of_criterion ? "criterion." : "",
                                        field.key, of, field.meaning.meaning, unit);
    EXPECT_HAS(page, row);
  }
}

TEST(EventFields, OfWrongValuesAreRefusedByTheirNames) {
  const LoadedScene scene = load(kScene);
  const std::string line = line_of({1, 0, {1, 2}, simulation::MooringBreak{{3, 4}, 6, 5}}, scene);
  const auto refusal = [&](const std::string& from, const std::string& to) -> std::string {
    try {
      return std::string(name_of(event_of(json_of(replaced(line, from, to)), scene.scene)));
    } catch (const ReadError& error) {
      return error.what();
    }
  };
  for (const auto& [from, to, message] :
       {std::tuple{"kind", "kind", "mooring_break"},
        {R"("force_N":6)", R"("force_kN":6)", R"("force_N" is missing)"},
        {R"("force_N":6)", R"("force_N":"6")", R"("force_N" is not a number)"},
        {R"("force_N":6)", R"("force_N":-6)", R"("force_N" is not ≥ 0)"},
        {"[3,4]", "[3]", "1 numbers where [x, y] is expected"},
        {R"("a ship")", R"("b ship")", R"("ship" is "b ship", which is not in the scene)"},
        {"mooring_break", "mooring", R"(an unknown kind of event, "mooring")"}})
    EXPECT_EQ(refusal(from, to), message);
}

/// Births and events state which floes exist. Frames state where they are.
TEST_F(RunFiles, WhoLivesWhereAtEveryFrame) {
  const io::Run run = read();
  const MotionIndex motions(run);
  ASSERT_EQ(run.frames.size(), recorded.frames.size());
  for (std::size_t k = 0; k < recorded.frames.size(); ++k) {
    const auto& [time, states] = recorded.frames[k];
    std::size_t living = 0;
    for (const RunFloe& floe : run.floes) living += run.is_alive(floe.birth.floe, time);
    EXPECT_EQ(living, states.size()) << time;
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_TRUE(run.is_alive(states[i].floe, time));
      const auto motion = checked(motions.floe_at(states[i].floe, time));
      EXPECT_LE(distance(motion->position, recorded.centroids[k].second[i]), 1.5 * kFramePositionTolerance);
      EXPECT_NEAR(motion->angle, states[i].angle, kFrameAngleTolerance);
    }
  }
  for (const RunFloe& floe : run.floes) {
    const auto lineage = run.lineage(floe.birth.floe);
    EXPECT_EQ(static_cast<int>(lineage.size()) - 1, floe.birth.generation);
    EXPECT_EQ(lineage.back(), floe.birth.floe);
  }
}

TEST_F(RunFiles, ALineCutShortIsLeftOutAndContactsMayBeMissing) {
  for (const auto name : {run_file::kForces, run_file::kEvents, run_file::kFrames, run_file::kContacts})
    std::filesystem::resize_file(path(name), std::filesystem::file_size(path(name)) - 5);
  EXPECT_HAS(refused(read_run(folder / "run")), "events.ndjson:", "the last line is cut short, of a run that finished");
  write_file(path(run_file::kSummary), replaced(text(run_file::kSummary), "\"finished\": true", "\"finished\": false"));
  const io::Run run = read();
  EXPECT_EQ(run.samples.size(), 79U);
  EXPECT_EQ(run.frames.size(), 16U);
  EXPECT_EQ(run.contacts.size(), recorded.contacts.size() - 1);
  std::filesystem::remove(path(run_file::kContacts));
  EXPECT_TRUE(read().contacts.empty()) << "as of an older version";
  EXPECT_FALSE(read_run(folder / "none").has_value());
}

TEST_F(RunFiles, DamageIsNamedWithItsLine) {
  const std::string floes = text(run_file::kFloes);
  EXPECT_HAS(refusal(run_file::kFloes, std::string(floes).insert(floes.find('\n') + 1, "{\"floe_id\": 1}\n")),
             "floes.ndjson:2: ");
  std::smatch stretch;  // of a parent's shape
  ASSERT_TRUE(std::regex_search(floes, stretch, std::regex(R"(\[0,\d+,\d+\])")));
  const auto parts = static_cast<std::size_t>(stretch.position());
  const auto line = 1 + std::ranges::count(floes.substr(0, parts), '\n');
  for (const auto& [other, reason] :
       {std::pair{"[9,", "ring 9 of a parent"}, {"[0,999", "of the parent's ring 0, which has"}})
    EXPECT_HAS(refusal(run_file::kFloes, std::string(floes).replace(parts, 3, other)),
               fmt::format("floes.ndjson:{}: ", line), reason);
}

TEST_F(RunFiles, WhatCannotBeIsRefusedWithItsPlace) {
  const std::string forces = text(run_file::kForces), frames = text(run_file::kFrames);
  const std::string header = forces.substr(0, forces.find('\n') + 1), rows = forces.substr(header.size());
  const std::string after_time = rows.substr(rows.find(','));
  for (const char* number : {"nan", "inf", "-inf", "1e999", "1_000", "0x10", "", "x"})
    EXPECT_HAS(refusal(run_file::kForces, header + number + after_time),
               fmt::format("forces.csv:2: \"{}\" is not a number", number));
  EXPECT_HAS(refusal(run_file::kForces, header + "null" + after_time), "forces.csv:2: a row without its time");
  EXPECT_HAS(refusal(run_file::kForces, header + replaced(rows, "a ship", "b ship")),
             "forces.csv:2: \"b ship\" is no ship, structure or wall of the scene");
  EXPECT_HAS(refusal(run_file::kForces, header + "0.1,a ship\n" + rows), "forces.csv:2: 2 fields below a header of ");
  EXPECT_HAS(refusal(run_file::kForces, header + replaced(rows, "a ship", "a\x8f\tship")), R"("a\x8f\x09ship" is no)");
  EXPECT_HAS(refusal(run_file::kForces, ""), "forces.csv: empty");
  write_file(path(run_file::kForces), forces);
  EXPECT_HAS(refusal(run_file::kFrames, frames + frames.substr(FrameEncoder::header().size())),
             "frames.bin: frame 18: at 0 s, not after the one before, at 8 s");
  EXPECT_HAS(refusal(run_file::kFrames, frames.substr(0, frames.size() - 5)), "frames.bin: frame 17, which begins at ",
             "cut short, of a run that finished");
  const std::vector<Motion> two(2);
  EXPECT_HAS(refusal(run_file::kFrames, FrameEncoder::header() + frame_bytes(0, two, {})),
             "frames.bin: frame 1: 2 ships and structures, where the scene has 1");
  const std::vector<Motion> one(1);
  const std::vector<FloeMotion> unborn{{.floe = 1'000'000, .motion = {}}};
  EXPECT_HAS(refusal(run_file::kFrames, FrameEncoder::header() + frame_bytes(0, one, unborn)),
             "frame 1: floe 1000000 was never born");
  EXPECT_HAS(refusal(run_file::kFrames, FrameEncoder::header() + frame_bytes(std::nan(""), one, {})),
             "frame 1, which begins at byte 16: damaged, a number in it is none");
  write_file(path(run_file::kFrames), frames);
  EXPECT_HAS(refusal(run_file::kStates, "t_s,steps,state_hash\n0,0,00\n"), "states.csv:2: \"00\" is not a hash");
}

/// Version 1 wrote every shape whole, and did not write its version.
TEST_F(RunFiles, OfVersionOneReadTheSameAndOfALaterOneNot) {
  std::string lines;
  for (const simulation::Birth& birth : recorded.births) append_birth(lines, birth, nullptr);
  EXPECT_EQ(refusal(run_file::kFloes, lines), "");
  const std::string summary = text(run_file::kSummary), version = "\"folder_version\": 6,";
  EXPECT_EQ(refusal(run_file::kSummary, replaced(summary, version, "")), "");
  const io::Run run = read();
  for (const simulation::Birth& birth : recorded.births) EXPECT_EQ(*run.shape(birth.floe), birth.polygon_in_body);
  EXPECT_HAS(refusal(run_file::kSummary, replaced(summary, version, "\"folder_version\": 7,")),
             "summary.json: a run folder of version");
  EXPECT_HAS(refusal(run_file::kSummary, replaced(summary, version, R"("folder_version": "3",)")),
             R"(summary.json:3:21: folder_version: found "3", allowed: a number)");
}

/// In level ice every cusp leaves the same plate with a longer boundary. Later lines must be as short as early ones.
TEST(Run, FloesGrowWithTheIceThatIsNewNotWithThePlate) {
  const TemporaryFolder folder;
  const LoadedScene scene = load(
      tests::scene({R"("name": "level", "time": {"step_s": 0.02, "until_s": 60}, )"
                    R"("fracture": {"splitting": {"model": "none"}})",
                    list("ships", {ship(R"("hull": {"length_m": 60}, "mass_kg": 3e6, "moment_of_inertia_kg_m2": 5e8,
         "position_m": [-30.5, 2], "propulsion": {"constant_speed_m_per_s": 3})")}),
                    list("floes", {R"({"rectangle": {"corner_m": [0, -75], "size_m": [300, 150]}})"})}));
  simulation::Simulation simulation(scene.scene);
  auto writer = checked(RunWriter::create(folder / "run", false, scene));
  for (int step = 0; step < 3000; ++step) {
    writer->record(simulation.journal());
    simulation.step();
  }
  ASSERT_TRUE(writer->finish({}, &simulation).has_value());
  const auto run = checked(read_run(folder / "run"));
  std::istringstream lines(read_file(folder.path() / "run" / run_file::kFloes));
  const std::size_t half = run->floes.size() / 2;
  ASSERT_GT(half, 100U);
  std::size_t vertices[2] = {}, bytes[2] = {};
  std::string line;
  for (std::size_t i = 0; std::getline(lines, line); ++i) {
    const std::size_t part = i < half ? 0 : 1;
    vertices[part] += vertex_count(*run->shape(static_cast<simulation::FloeId>(i)));
    bytes[part] += line.size();
  }
  EXPECT_GT(2 * vertices[1], 3 * vertices[0]) << "whole shapes would take half as much again";
  EXPECT_LT(static_cast<double>(bytes[1]), 1.1 * static_cast<double>(bytes[0]));
}

TEST_F(RunFiles, TheSummaryHasItsKeys) {
  const JsonValue summary = parse_json(text(run_file::kSummary)).root;
  const auto expect_keys = [](const JsonValue* object, std::initializer_list<const char*> keys) {
    for (const char* key : keys) EXPECT_NE(object->find(key), nullptr) << key;
  };
  expect_keys(&summary, {"version", "folder_version", "seed", "scene_hash", "steps", "sim_time_s", "wall_time_s",
                         "real_time_factor", "peaks", "warnings", "finished"});
  expect_keys(summary.find("ledger"), {"initial_ice_area_m2", "floe_area_m2", "submerged_area_m2", "brash_area_m2",
                                       "rounding_defect_m2", "imbalance_m2"});
  expect_keys(summary.find("counts"), {"floes_initial", "floes_final", "bends", "splits", "crush_contacts",
                                       "rejected_cuts", "database_out_of_range"});
  EXPECT_BEGINS(text(run_file::kForces), "t_s,ship,");
}

// ---- what causes the forces on a ship, against the columns of forces.csv

/// Returns the sum of the parts in each direction. A cause that is a share of another column counts in that
/// column.
std::map<std::string_view, double> sums(const simulation::HullSample& row) {
  std::map<std::string_view, double> sums;
  for (const ForceCause& cause : force_causes())
    if (cause.share_of.empty()) sums[cause.direction] += force_column(cause.column).read(row);
  return sums;
}

TEST(ForceCauses, AddUpToTheForceOnTheShip) {
  simulation::HullSample row;  // each number in it another power of two
  row.from_ice.surge = 1, row.from_ice.sway = 2, row.from_ice.yaw = 4;
  row.from_ships.surge = 8, row.from_ships.sway = 16, row.from_ships.yaw = 32;
  row.from_submerged = {64, 1048576, 128};
  row.from_water = {256, 512, 1024};
  row.from_rudder = {2048, 4096, 8192};
  row.from_mooring = {16384, 32768, 65536};
  row.thrust = 131072;
  row.from_engine = {0, 262144, 524288};
  row.friction_of_ice = {0.5, 0.25, 0.125};  // a share of the first three
  const auto sum = sums(row);
  ASSERT_EQ(sum.size(), 3U);
  EXPECT_EQ(sum.at("Surge force by cause"), 1 + 8 + 64 + 256 + 2048 + 16384 + 131072);
  EXPECT_EQ(sum.at("Sway force by cause"), 2 + 16 + 1048576 + 512 + 4096 + 32768 + 262144);
  EXPECT_EQ(sum.at("Yaw moment by cause"), 4 + 32 + 128 + 1024 + 8192 + 65536 + 524288);
}

TEST(ForceCauses, HaveEachColumnOnceAndSharesOfColumnsOfTheirDirection) {
  for (const ForceCause& cause : force_causes()) {
    const auto is_this = [&](const ForceCause& other) { return other.column == cause.column; };
    EXPECT_EQ(std::ranges::count_if(force_causes(), is_this), 1) << cause.column;
    EXPECT_EQ(force_column(cause.column).unit, cause.direction.starts_with("Yaw") ? "N·m" : "N");
    if (cause.share_of.empty()) continue;
    const auto causes = force_causes();
    const auto whole = std::ranges::find(causes, cause.share_of, &ForceCause::column);
    ASSERT_TRUE(whole != causes.end()) << cause.share_of;
    EXPECT_EQ(whole->direction, cause.direction);
    EXPECT_FALSE(whole->without_shares.empty());
  }
}

TEST(ForceCauses, AreShownWhereAShipHasThem) {
  simulation::Scene scene;
  scene.ships.resize(1);
  scene.ships[0].propulsion = simulation::ConstantSpeed{1};
  const auto has = [&](std::string_view column) {
    const auto causes = force_causes(scene);
    return std::ranges::find(causes, column, &ForceCause::column) != causes.end();
  };
  EXPECT_TRUE(has("surge_N") && has("thrust_N"));
  EXPECT_FALSE(has("surge_from_ice_friction_N") || has("surge_from_mooring_N") || has("surge_from_ships_N"));
  scene.ships[0].propulsion = simulation::ConstantThrust{1};
  scene.ships[0].mooring.emplace();
  EXPECT_TRUE(has("surge_from_ice_friction_N") && has("surge_from_mooring_N"));
  scene.ships.push_back(scene.ships[0]);
  EXPECT_TRUE(has("surge_from_ships_N"));
}

// ---- ice under a hull, read back: submerged pieces, surfaced pieces, and thinned frames

/// A run of 33 s into a small plate, in drifting water. Pieces under the hull move.
class UnderHullRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    const LoadedScene loaded =
        load(tests::scene({R"("time": {"step_s": 0.01, "until_s": 33}, "water": {"drift_m_per_s": [0, 0.1]})",
                           R"("floes": [{"rectangle": {"corner_m": [0, -25], "size_m": [100, 50]}}])",
                           list("ships", {ship(R"("hull": {"length_m": 40, "beam_m": 8, "draught_m": 2}, "mass_kg": 1e6,
           "moment_of_inertia_kg_m2": 1e8, "position_m": [-21, 0], "propulsion": {"constant_speed_m_per_s": 2})")})}));
    auto active = checked(start_run(folder / "run", loaded));
    ASSERT_EQ(run_to_end(*active).end, RunEnd::kFinished);
    run = std::move(*checked(read_run(folder / "run")));
  }
  static void TearDownTestSuite() { run.reset(); }
  static inline std::optional<io::Run> run;
};

TEST_F(UnderHullRun, BrashIsWhatCameUpAndWhatItBrokeInto) {
  std::size_t came_up = 0;
  for (const RunFloe& floe : run->floes) {
    const RunFloe* parent = run->floe(floe.birth.parent);
    const bool rose = parent && run->events.at(*parent->death_event).is<simulation::Resurface>();
    EXPECT_EQ(floe.came_up, rose || (parent && parent->came_up)) << floe.birth.floe;
    came_up += floe.came_up;
  }
  EXPECT_GT(came_up, 5U);
}

TEST_F(UnderHullRun, EveryFloeEitherFloatsOrIsUnder) {
  const MotionIndex motions(*run);
  for (const Frame& frame : run->frames) {
    const auto floating = floes_at(*run, motions, frame.time), under = floes_under_hulls_at(*run, motions, frame.time);
    std::size_t there = 0;
    for (const RunFloe& floe : run->floes) there += floe.birth.time <= frame.time && frame.time < floe.died ? 1 : 0;
    EXPECT_EQ(floating.size() + under.size(), there) << frame.time;
  }
  EXPECT_GE(floes_under_hulls_at(*run, motions, run->end_time()).size(), 5U);
}

TEST_F(UnderHullRun, ThinnedFramesHaveWhatIsUnderWhereItIs) {
  io::Run thin = *run;
  thin.frames = thinned_frames(*run, {.every = 4});
  ASSERT_LT(thin.frames.size(), run->frames.size() / 2);
  const MotionIndex all(*run), some(thin);
  std::size_t compared = 0;
  for (const Frame& frame : thin.frames) {
    for (const PlacedFloe& floe : floes_under_hulls_at(*run, all, frame.time)) {
      const auto motion = checked(some.floe_at(floe.birth->floe, frame.time));
      EXPECT_LT(distance(motion->position, floe.motion->position), 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20U);
}

}  // namespace
}  // namespace polynya::io
