#include <cmath>

#include "program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geometry/cut/repair.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;

std::string polygon_json(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}
std::string feature(const std::string& rings, const std::string& properties = "") {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":)" + polygon_json(rings) + "}";
}
std::string collection(const std::vector<std::string>& features) {
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (const std::string& one : features) text += (one == features.front() ? "\n" : ",\n") + one;
  return text + "\n]}\n";
}

const std::string kSquare = "[[0,0],[10,0],[10,10],[0,10],[0,0]]";
const std::string kFarSquare = "[[100,0],[110,0],[110,10],[100,10],[100,0]]";

/// A folder with floes.geojson of these features, in which commands run.
class CutCommand : public testing::Test {
 protected:
  Outcome cut(Words words, const std::string& floes = "floes.geojson") const {
    return polynya(Words{"cut", floes} + words, folder);
  }
  void write(const std::string& name, const std::string& text) const { write_file(folder / name, text); }
  std::string read(const std::string& name) const { return read_file(folder / name); }

  static io::JsonValue json(const std::string& text) {
    io::JsonDocument document = io::parse_json(text);
    EXPECT_TRUE(document.faults.empty()) << text;
    return std::move(document.root);
  }
  static double total(const io::JsonValue& ledger, const char* key) {
    return ledger.find("totals")->find(key)->number();
  }
  static const io::JsonValue& floe(const io::JsonValue& ledger, std::size_t i) {
    return ledger.find("floes")->items().at(i);
  }
  static io::FloeText floes_of(const std::string& text) {
    auto floes = io::read_floe_text(text);
    EXPECT_TRUE(floes.has_value()) << text;
    return floes ? *std::move(floes) : io::FloeText{};
  }
  static double area_of(const io::FloeText& floes) {
    double area = 0;
    for (const io::FloeEntry& entry : floes.entries) {
      const Polygon polygon = geometry::normalised(entry.polygon);
      EXPECT_FALSE(geometry::find_defect(polygon).has_value());
      area += geometry::measure(polygon).area;
    }
    return area;
  }
  /// Everything a ledger promises of its sums.
  static void expect_balanced(const io::JsonValue& ledger) {
    const auto balance = [](const io::JsonValue& one) {
      const auto number = [&](const char* key) { return one.find(key)->number(); };
      EXPECT_NEAR(number("area_of_pieces_m2") + number("removed_m2") - number("rounding_defect_m2"),
                  number("area_m2"), 1e-12 * (1 + number("area_m2")));
      EXPECT_EQ(one.find("exact_defect_m2")->text(), "0");
    };
    balance(*ledger.find("totals"));
    double pieces = 0;
    for (const io::JsonValue& one : ledger.find("floes")->items()) {
      balance(one);
      pieces += one.find("pieces")->number();
      EXPECT_EQ(one.find("parts")->items().size(), static_cast<std::size_t>(one.find("pieces")->number()));
    }
    EXPECT_EQ(total(ledger, "pieces"), pieces);
    EXPECT_EQ(total(ledger, "floes"), static_cast<double>(ledger.find("floes")->items().size()));
  }

  static io::JsonValue ledger_of(const Outcome& outcome, int code = 0) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    io::JsonValue ledger = json(outcome.out);
    expect_balanced(ledger);
    return ledger;
  }
  void SetUp() override { write("floes.geojson", collection({feature(kSquare), feature(kFarSquare)})); }

  TemporaryFolder folder;
};

TEST_F(CutCommand, ADiscLeavesTheOutsideAndAccountsForTheRest) {
  const io::JsonValue ledger = ledger_of(cut("--disc 0,0,5 --out pieces.geojson"));
  EXPECT_EQ(total(ledger, "area_m2"), 200);
  // A quarter of the inscribed regular 36-gon.
  EXPECT_NEAR(total(ledger, "removed_m2"), 0.5 * 36 * 25 * std::sin(M_PI / 18) / 4, 1e-12);
  EXPECT_EQ(ledger.find("tools")->items()[0].find("vertices")->number(), 36);
  const io::JsonValue pieces = json(read("pieces.geojson"));
  ASSERT_EQ(pieces.find("features")->items().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const io::JsonValue& properties = *pieces.find("features")->items()[i].find("properties");
    EXPECT_EQ(properties.find("floe_id")->number(), 2.0 + static_cast<double>(i));
    EXPECT_EQ(properties.find("parent_id")->number(), static_cast<double>(i));
    EXPECT_EQ(properties.find("part")->text(), "outside");
    EXPECT_EQ(properties.find("area_m2")->number(), floe(ledger, i).find("area_of_pieces_m2")->number());
  }
  EXPECT_EQ(floe(ledger, 1).find("removed_m2")->number(), 0) << "the disc misses it: it stays whole";
  EXPECT_EQ(area_of(floes_of(read("pieces.geojson"))), total(ledger, "area_of_pieces_m2"));
}

TEST_F(CutCommand, KeepSaysWhichSideStays) {
  double area_kept[3] = {};
  const char* const keeps[] = {"outside", "inside", "both"};
  for (int i = 0; i < 3; ++i) {
    const io::JsonValue ledger =
        ledger_of(cut({"--disc", "5,5,3", "--keep", keeps[i], "--out", "pieces.geojson"}));
    area_kept[i] = total(ledger, "area_of_pieces_m2");
    const io::JsonValue pieces = json(read("pieces.geojson"));
    for (const io::JsonValue& one : pieces.find("features")->items()) {
      const std::string part = one.find("properties")->find("part")->text();
      EXPECT_TRUE(i == 2 || part == keeps[i]) << part;
    }
  }
  EXPECT_NEAR(area_kept[0] + area_kept[1], 200, 1e-12);
  EXPECT_EQ(area_kept[2], 200);
  EXPECT_LT(area_kept[1], M_PI * 9);
}

TEST_F(CutCommand, AToolOfSeveralPolygonsWithHolesIsTakenTogether) {
  write("floes.wkt", "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))");
  // A frame of area 16 − 4, and a square that overlaps its corner: 4 − 1 more.
  write("tool.wkt", "MULTIPOLYGON (((1 1, 5 1, 5 5, 1 5), (2 2, 4 2, 4 4, 2 4)), ((4 4, 6 4, 6 6, 4 6)))");
  const io::JsonValue ledger =
      ledger_of(cut("--polygon tool.wkt --keep both --out pieces.geojson", "floes.wkt"));
  double inside = 0;
  double outside = 0;
  for (const io::JsonValue& part : floe(ledger, 0).find("parts")->items())
    (part.find("part")->text() == "inside" ? inside : outside) += part.find("area_m2")->number();
  EXPECT_EQ(inside, 15);
  EXPECT_EQ(outside, 85);
  EXPECT_EQ(total(ledger, "pieces"), 3);
  EXPECT_EQ(json(read("pieces.geojson")).find("features")->items().size(), 3U) << "by its extension";
}

TEST_F(CutCommand, ACrackGoesThroughEveryFloeAndKeepsEverything) {
  write("floes.geojson",
        collection({feature(kSquare), feature(kFarSquare), feature("[[0,50],[1,50],[0,51]]")}));
  const io::JsonValue ledger = ledger_of(cut("--crack 0,5,0 --keep inside"));
  EXPECT_EQ(total(ledger, "pieces"), 5);
  EXPECT_EQ(total(ledger, "removed_m2"), 0);
  for (const io::JsonValue& part : floe(ledger, 0).find("parts")->items())
    EXPECT_EQ(part.find("area_m2")->number(), 50);
}

/// Along axes and diagonals a crack through vertices goes through them to the last bit, from any point on it.
TEST_F(CutCommand, ACrackAlongADiagonalHitsTheCorners) {
  write("floes.wkt", "POLYGON ((-1 -1, 1 -1, 1 1, -1 1))");
  for (const auto& [crack, vertices] : {std::pair{"0.1,0.1,45", 3},
                                        {"7.3,7.3,-135", 3},
                                        {"0.3,-0.3,135", 3},
                                        {"-0.7,0.7,-45", 3},
                                        {"3,0,180", 4},
                                        {"0,0.1,-90", 4},
                                        {"0,9,450", 4}}) {
    const Outcome outcome = cut({"--crack", crack, "--out", "-"}, "floes.wkt");
    const io::FloeText pieces = floes_of(outcome.out);
    ASSERT_EQ(pieces.entries.size(), 2U) << crack;
    for (const io::FloeEntry& entry : pieces.entries) {
      const Polygon piece = geometry::normalised(entry.polygon);
      EXPECT_EQ(piece.outer.size(), static_cast<std::size_t>(vertices)) << crack;
      EXPECT_EQ(geometry::measure(piece).area, 2) << crack;
    }
  }
}

/// The line crosses the first floe, ends in the second and misses the third.
TEST_F(CutCommand, ALineSeparatesWhereItCrossesAndSaysWhereItDangles) {
  write("floes.geojson",
        collection({feature(kSquare), feature(kFarSquare), feature("[[0,50],[1,50],[0,51]]")}));
  const Outcome outcome = cut("--line -1,5,103,5");
  const io::JsonValue ledger = ledger_of(outcome);
  EXPECT_EQ(total(ledger, "pieces"), 4);
  EXPECT_EQ(total(ledger, "dangling"), 1);
  EXPECT_EQ(floe(ledger, 0).find("dangling")->items().size(), 0U);
  const io::JsonValue& dangling = floe(ledger, 1).find("dangling")->items().at(0);
  EXPECT_EQ(dangling.find("from_m")->items()[0].number(), 100);
  EXPECT_EQ(dangling.find("to_m")->items()[0].number(), 103);
  EXPECT_EQ(floe(ledger, 1).find("dangling_length_m")->number(), 3);
  EXPECT_HAS(outcome.err, "separates nothing from (100, 5) to (103, 5)");
}

/// A line through one arm of a U that ends in the other: it separates and dangles at once.
TEST_F(CutCommand, ALineCanSeparateAndDangleInOneFloe) {
  write("floes.wkt", "POLYGON ((0 0, 9 0, 9 9, 6 9, 6 3, 3 3, 3 9, 0 9))");
  const io::JsonValue ledger = ledger_of(cut("--line -1,6,8,6", "floes.wkt"));
  EXPECT_EQ(total(ledger, "pieces"), 2);
  EXPECT_EQ(floe(ledger, 0).find("dangling_length_m")->number(), 2);
  EXPECT_EQ(floe(ledger, 0).find("dangling")->items().size(), 1U);
}

TEST_F(CutCommand, OpsApplyInOrderToAllPieces) {
  write("floes.geojson", collection({feature(kSquare)}));
  write("cuts.json", R"([{"crack": [5, 5, 0]}, {"crack": [5, 5, 90]},
    {"polygon": {"type": "Polygon", "coordinates": [[[4,4],[6,4],[6,6],[4,6],[4,4]]]}, "keep": "both"},
    {"disc": [0, 0, 1]}])");
  const io::JsonValue ledger = ledger_of(cut("--ops cuts.json --out pieces.geojson"));
  EXPECT_EQ(total(ledger, "pieces"), 8);
  EXPECT_NEAR(total(ledger, "removed_m2"), 0.5 * 36 * std::sin(M_PI / 18) / 4, 1e-12);
  write("inside.json", R"([{"crack": [5, 5, 0]}, {"disc": [5, 10, 2], "keep": "inside"}])");
  const io::JsonValue second = ledger_of(cut("--ops inside.json"));
  EXPECT_EQ(total(second, "pieces"), 1) << "the lower half is missed by the disc, so nothing of it is inside";
}

/// A cut that must cut is refused where it leaves a floe, or one of its pieces, as it was; the others are
/// cut.
TEST_F(CutCommand, ACutThatMustCutRefusesWhatItLeavesWhole) {
  const std::string disc = R"({"disc": [0, 0, 1], "keep": "both")";
  write("may.json", "[" + disc + "}]");
  write("must.json", "[" + disc + R"(, "must_cut": true}])");
  write("must-each.json", "[" + disc + R"(}, {"crack": [5, 5, 0], "must_cut": true}])");
  EXPECT_EQ(cut("--ops may.json").code, 0);
  const Outcome outcome = cut("--ops must.json");
  const io::JsonValue ledger = ledger_of(outcome, 4);
  EXPECT_EQ(total(ledger, "pieces"), 3);
  EXPECT_EQ(total(ledger, "rejected"), 1);
  EXPECT_TRUE(floe(ledger, 0).find("rejected")->is_null());
  EXPECT_EQ(floe(ledger, 1).find("rejected")->find("reason")->text(), "misses");
  EXPECT_HAS(outcome.err, "feature 1, polygon 0: misses: cut 0: ");
  EXPECT_HAS(outcome.err, "2 floes -> 3 pieces");
  const io::JsonValue each = ledger_of(cut("--ops must-each.json"), 4);
  EXPECT_EQ(floe(each, 0).find("rejected")->find("reason")->text(), "misses") << "the piece in the disc";
  EXPECT_EQ(floe(each, 0).find("pieces")->number(), 3);
}

TEST_F(CutCommand, EveryDefectIsRefusedByNameAndTheGoodAreCut) {
  struct Bad {
    const char* rings;
    const char* reason;
  };
  const std::vector<Bad> all{
      {"[[0,0],[1,0]]", "too-few-points"},
      {"[[0,0],[1,0],[0,0],[1,0]]", "too-few-points"},
      {"", "too-few-points"},
      {"[[0,0],[4,4],[4,0],[0,4]]", "self-crossing"},
      {"[[0,0],[4,0],[2,2],[4,4],[0,4],[2,2]]", "self-crossing"},
      {"[[0,0],[4,0],[4,4],[4,2],[4,6],[0,6]]", "overlapping-edges"},
      {"[[0,0],[4,0],[8,0]]", "zero-area"},
      {"[[0,0],[NaN,0],[4,4]]", "not-finite"},
      {"[[0,0],[1e999,0],[4,4]]", "not-finite"},
      {"[[0,0],[4,0],[4,4]],[[10,10],[11,10],[10,11]]", "hole-outside"},
      {"[[0,0],[9,0],[9,9],[0,9]],[[1,1],[5,1],[5,5],[1,5]],[[2,2],[4,2],[4,4],[2,4]]", "holes-overlap"},
      {"[[0,0],[9,0],[9,9],[0,9]],[[1,1],[5,1],[5,5],[1,5]],[[3,3],[7,3],[7,7],[3,7]]", "rings-cross"},
      {"[[0,0],[9,0],[9,9],[0,9]],[[0,0],[9,9],[3,9],[0,6]]", "overlapping-edges"},
      {"[[0,0],[8,0],[8,8],[0,8]],[[0,4],[4,2],[8,4],[4,6]]", "disconnected"}};
  std::vector<std::string> features{feature(kSquare)};
  for (const Bad& bad : all) features.push_back(feature(bad.rings));
  features.emplace_back(R"({"type":"Feature","properties":{},"geometry":null})");
  features.emplace_back(R"({"type":"LineString","coordinates":[[0,0],[1,1]]})");
  features.push_back(polygon_json("[[0,0],[1,0],5]"));
  features.push_back(feature(kFarSquare));
  write("floes.geojson", collection(features));
  const Outcome outcome = cut("--crack 0,5,0 --out pieces.geojson");
  const io::JsonValue ledger = ledger_of(outcome, 4);
  EXPECT_EQ(total(ledger, "area_m2"), 200);
  EXPECT_EQ(total(ledger, "pieces"), 4);
  EXPECT_EQ(total(ledger, "rejected"), static_cast<double>(all.size() + 3));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const io::JsonValue& rejected = *floe(ledger, i + 1).find("rejected");
    ASSERT_FALSE(rejected.is_null()) << all[i].rings;
    EXPECT_EQ(rejected.find("reason")->text(), all[i].reason) << all[i].rings;
    EXPECT_EQ(floe(ledger, i + 1).find("feature")->number(), static_cast<double>(i + 1));
    const bool has_vertices = !rejected.find("vertices")->items().empty();
    EXPECT_TRUE(has_vertices || std::string(all[i].rings).empty()) << all[i].rings;
    EXPECT_HAS(outcome.err,
               fmt::format("floes.geojson:{}: feature {}, polygon 0: {}", i + 3, i + 1, all[i].reason));
  }
  EXPECT_EQ(floe(ledger, all.size() + 1).find("rejected")->find("reason")->text(), "no-geometry");
  EXPECT_EQ(floe(ledger, all.size() + 2).find("rejected")->find("reason")->text(), "not-a-polygon");
  EXPECT_EQ(floe(ledger, all.size() + 3).find("rejected")->find("reason")->text(), "malformed");
  EXPECT_EQ(floes_of(read("pieces.geojson")).entries.size(), 4U);
}

TEST_F(CutCommand, WhatOgcAllowsIsCut) {
  write("floes.geojson",
        collection(
            {feature("[[0,0],[0,10],[10,10],[10,0]]"),              // clockwise, open
             feature("[[0,0],[5,0],[5,0],[10,0],[10,10],[0,10]]"),  // a point twice, one straight
             feature(
                 "[[0,0],[10,0],[10,10],[0,10],[0,0]],[[0,0],[6,2],[2,6]]"),  // a hole at the shell's vertex
             feature("[[0,0],[10,0],[10,10],[0,10]],[[2,2],[4,2],[4,4],[2,4]],[[4,4],[6,4],[6,6],[4,6]]")}));
  const io::JsonValue ledger = ledger_of(cut("--crack 0,3,7 --out pieces.wkt"));
  EXPECT_EQ(total(ledger, "area_m2"), 100 + 100 + 84 + 92);
  EXPECT_NEAR(area_of(floes_of(read("pieces.wkt"))), 376, 1e-11);
}

TEST_F(CutCommand, RepairIsOnRequestAndSaysWhatItChanged) {
  // A bow-tie, and a pentagram: its middle is wound around twice.
  const std::string bow_tie = "[[0,0],[4,4],[4,0],[0,4]]";
  const std::string star = "[[0,3],[8,3],[2,8],[4,0],[6,8]]";
  write("floes.geojson", collection({feature(bow_tie), feature(star), feature(kFarSquare)}));
  EXPECT_EQ(cut("--crack 0,100,0").code, 4);
  double star_area[2] = {};
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = cut({"--crack", "0,100,0", "--repair", i == 0 ? "even-odd" : "non-zero"});
    const io::JsonValue ledger = ledger_of(outcome);
    EXPECT_EQ(total(ledger, "repaired"), 2);
    const io::JsonValue& repair = *floe(ledger, 0).find("repair");
    EXPECT_EQ(repair.find("area_drawn_m2")->number(), 0);
    EXPECT_EQ(repair.find("area_changed_m2")->number(), 8);
    EXPECT_EQ(repair.find("shapes")->number(), 2);
    EXPECT_EQ(floe(ledger, 0).find("area_m2")->number(), 8);
    EXPECT_EQ(floe(ledger, 2).find("repair"), nullptr);
    star_area[i] = floe(ledger, 1).find("area_m2")->number();
    EXPECT_HAS(outcome.err, "repaired");
  }
  EXPECT_LT(star_area[0], star_area[1]) << "even-odd leaves the middle open";
  write("floes.geojson", collection({feature("[[0,0],[NaN,0],[4,4]]"), feature("[[0,0],[1,0],[2,0]]")}));
  const Outcome hopeless = cut("--crack 0,100,0 --repair non-zero");
  EXPECT_EQ(hopeless.code, 4);
  EXPECT_EQ(floe(json(hopeless.out), 0).find("rejected")->find("reason")->text(), "not-finite");
  EXPECT_EQ(floe(json(hopeless.out), 1).find("rejected")->find("reason")->text(), "zero-area");
}

TEST_F(CutCommand, FormatsGoInAndOutAndStdinIsRead) {
  write("floes.wkt", "POLYGON ((0 0, 10 0, 10 10, 0 10))\nPOLYGON ((20 0, 30 0, 30 10))\n");
  write("floes.ndjson", feature(kSquare) + "\n" + feature("[[20,0],[30,0],[30,10]]") + "\n");
  write("floes.geojson", collection({feature(kSquare), feature("[[20,0],[30,0],[30,10]]")}));
  std::string pieces[3];
  int i = 0;
  for (const std::string name : {"floes.wkt", "floes.ndjson", "floes.geojson"}) {
    const Start start{folder.path(), RLIM_INFINITY, folder / name};
    const Outcome outcome = polynya("cut - --crack 0,0,30 --ledger ledger.json", start);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expect_balanced(json(read("ledger.json")));
    const io::FloeText floes = floes_of(outcome.out);
    EXPECT_EQ(floes.format, floes_of(read(name)).format) << name;
    ASSERT_EQ(floes.entries.size(), 3U);
    for (const io::FloeEntry& entry : floes.entries) {
      for (const geometry::Point p : entry.polygon.outer) pieces[i] += fmt::format("{} {},", p.x, p.y);
    }
    ++i;
  }
  EXPECT_EQ(pieces[0], pieces[1]);
  EXPECT_EQ(pieces[0], pieces[2]);
  EXPECT_BEGINS(cut("--crack 0,0,30 --out -", "floes.wkt").out, "POLYGON ((");
}

TEST_F(CutCommand, LinksAndPipesAreWrittenThrough) {
  write("floes.geojson", collection({feature(kSquare)}));
  write("real.wkt", "");
  std::filesystem::create_symlink("real.wkt", folder / "link.wkt");
  ASSERT_EQ(cut("--crack 5,5,33 --out link.wkt").code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.wkt"));
  EXPECT_BEGINS(read("real.wkt"), "POLYGON");
  const Outcome piped = cut("--crack 5,5,33 --out /proc/self/fd/1 --ledger l.json");
  EXPECT_EQ(piped.code, 0) << piped.err;
}

TEST_F(CutCommand, SaysWhereNothingWasCut) {
  write("floes.wkt", "POLYGON ((0 0, 1 1, 1 0, 0 1))\n");
  EXPECT_HAS(polynya("cut floes.wkt --crack 5,5,33", folder).err, "1 refused; nothing was cut");
}

/// Pieces are floes again: cut once more, ids go on and lead back.
TEST_F(CutCommand, PiecesAreFloesAgain) {
  write("floes.geojson",
        collection({feature(kSquare, R"("floe_id":12)"), feature(kFarSquare, R"("floe_id":3)")}));
  ASSERT_EQ(cut("--crack 5,5,33 --out first.geojson --ledger l.json").code, 0);
  const io::JsonValue first = json(read("first.geojson"));
  EXPECT_EQ(first.find("features")->items()[0].find("properties")->find("parent_id")->number(), 12);
  EXPECT_EQ(first.find("features")->items()[0].find("properties")->find("floe_id")->number(), 13);
  const Outcome again = cut("--disc 5,5,4 --out second.geojson", "first.geojson");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(floe(json(again.out), 0).find("floe_id")->number(), 13);
  EXPECT_EQ(total(json(again.out), "area_m2"), total(json(read("l.json")), "area_of_pieces_m2"));
}

// The line leaves a corner of 3e-33 m2, all of whose vertices round to (1.5, 1.5): no floe, but an item of
// the ledger.
TEST_F(CutCommand, APieceThatRoundsToAPointIsASliver) {
  write("square.wkt", "POLYGON ((0 0, 1.5 0, 1.5 1.5, 0 1.5))\n");
  const io::JsonValue ledger = ledger_of(cut("--line 0,4,2.4,0 --out pieces.wkt --ledger -", "square.wkt"));
  EXPECT_EQ(total(ledger, "slivers"), 1);
  EXPECT_GT(total(ledger, "area_slivers_m2"), 0);
  EXPECT_EQ(total(ledger, "area_slivers_m2"), total(ledger, "removed_m2"));
}

TEST_F(CutCommand, AreasOfSliversAreTheNearestDoubles) {
  // In plain doubles this floe has −3.5e-18 m2, and with rings that run clockwise it must be the same floe.
  write("sliver.wkt",
        "POLYGON ((10.214251825832536 9.982363678414115, 10.151854324862311 9.969288413081589, "
        "9.066274827191009 9.741807508383557))\n");
  const Outcome outcome = cut("--disc 0,0,1 --out - --ledger ledger.json", "sliver.wkt");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const io::JsonValue ledger = json(read("ledger.json"));
  EXPECT_EQ(total(ledger, "area_m2"), 4.1982189329424393e-18);
  EXPECT_EQ(total(ledger, "area_of_pieces_m2"), 4.1982189329424393e-18);
}

TEST_F(CutCommand, AnInvalidToolIsRefusedByName) {
  write("floes.geojson", collection({feature(kSquare)}));
  write("tool.wkt", "POLYGON ((0 0, 4 4, 4 0, 0 4))");
  const Outcome outcome = cut("--polygon tool.wkt");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(outcome.out.empty());
  EXPECT_HAS(outcome.err, "tool.wkt: feature 0, polygon 0: self-crossing at (2, 2)");
}

TEST_F(CutCommand, WhatCannotBeReadOrWrittenIsFive) {
  write("floes.geojson", collection({feature(kSquare)}));
  write("broken.geojson", "{\"type\": \"Polygon\",\n  \"coordinates\": [[[0,0],}");
  write("prose.txt", "42 is no floe");
  EXPECT_EQ(cut("--disc 0,0,1", "missing.geojson").code, 5);
  EXPECT_EQ(cut("--disc 0,0,1", "prose.txt").code, 5);
  EXPECT_EQ(cut("--polygon missing.geojson").code, 5);
  EXPECT_EQ(cut("--disc 0,0,1 --out no/such/folder.geojson").code, 5);
  // A size limit stands for a full disk: nothing half-written is left, nor is what was there lost.
  write("pieces.wkt", "as it was");
  const Start full_disk{folder.path(), 300};
  const Outcome full = polynya("cut floes.geojson --disc 0,0,5 --out pieces.wkt", full_disk);
  EXPECT_EQ(full.code, 5);
  EXPECT_HAS(full.err, "File too large");
  EXPECT_EQ(read("pieces.wkt"), "as it was");
  const Outcome broken = cut("--disc 0,0,1", "broken.geojson");
  EXPECT_EQ(broken.code, 5);
  EXPECT_HAS(broken.err, "broken.geojson:2:");
}

}  // namespace
}  // namespace polynya::tests
