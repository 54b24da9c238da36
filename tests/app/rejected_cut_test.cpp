// Every cut that geometry refuses is written as an input of polynya cut, which refuses it for the same
// reason.

#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/event_records.hpp"
#include "io/text/json_parser.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::tests {
namespace {

using namespace simulation;

/// A fracture as no contact would ask for it: its cusp misses the floe, or its crack ends inside.
PendingFracture misplaced(fracture::Failure failure, dynamics::PersistentContact& record) {
  PendingFracture pending;
  pending.failure = failure;
  pending.first_touch_in_body = {50, 5};
  pending.point_in_water = {50, 5};
  pending.cusp_radius = 3;
  pending.crack_in_body.start = {-1, 5};
  pending.crack_in_body.end = {1.0 / 3, 5};
  pending.record = &record;
  return pending;
}

TEST(RejectedCut, IsAnInputOfPolynyaCutThatComesToTheSame) {
  const TemporaryFolder folder;
  Scene scene;
  scene.floes = {scenes::floe(scenes::rectangle(0, 0, 10, 10))};
  World world(scene);
  world.journal.clear();
  dynamics::PersistentContact record;
  world.step.fractures = {misplaced(fracture::Failure::kBend, record), misplaced(fracture::Failure::kSplit, record)};
  apply_fractures(world.setup, world.clock, world.step, world.population, world.accounts, world.journal);
  ASSERT_EQ(world.journal.events.size(), 2U);
  for (const Event& event : world.journal.events) {
    const auto& cut = std::get<RejectedCut>(event.what);
    ASSERT_TRUE(io::write_rejected_cut(folder.path(), event.time, cut).has_value());
    const std::string name = "rejected-cuts/00000" + std::to_string(cut.input.number);
    const Outcome again = polynya({"cut", name + ".geojson", "--ops", name + "-ops.json", "--out", "out.wkt"}, folder);
    SCOPED_TRACE(cut.reason);
    SCOPED_TRACE(again.err + again.out);
    EXPECT_EQ(world.accounts.counts.rejected_cuts, 2);
    EXPECT_EQ(again.code, 4);
    const std::string kind = cut.reason.substr(0, cut.reason.find(':'));
    EXPECT_EQ(kind, cut.input.number == 1 ? "misses" : "does-not-separate");
    EXPECT_HAS(again.err, "feature 0, polygon 0: " + kind + ": ");
    EXPECT_HAS(again.err, "1 floe -> 1 piece");
    EXPECT_HAS(again.err, "1 refused; nothing was cut");
    const auto ledger = io::parse_json(again.out);
    ASSERT_TRUE(ledger.faults.empty());
    EXPECT_EQ(ledger.root.find("floes")->items()[0].find("rejected")->find("reason")->text(), kind);
    if (cut.input.number == 2) {
      EXPECT_HAS(again.out, "\"dangling_length_m\"");
      EXPECT_HAS(again.out, R"({"line":[[-1,5],[0.3333333333333333,5]],"must_cut":true})") << "to the last bit";
      EXPECT_HAS(again.err, "separates nothing");
    }
  }
  auto one_too_many = std::get<RejectedCut>(world.journal.events[0].what);
  one_too_many.input.number = io::kMostRejectedCuts + 1;
  EXPECT_TRUE(io::write_rejected_cut(folder.path(), 0, one_too_many).has_value());
  EXPECT_FALSE(std::filesystem::exists(folder / "rejected-cuts/000101.geojson"));
}

}  // namespace
}  // namespace polynya::tests
