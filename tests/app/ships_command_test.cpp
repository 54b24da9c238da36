// What `ships` prints: the list, a ship with its sources, and both as JSON.
#include "program.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/scene/ship_presets.hpp"

namespace polynya::tests {
namespace {

TEST(ShipsCommand, ListsEveryShip) {
  const TemporaryFolder folder;
  const Outcome list = polynya({"ships"}, {folder.path()});
  EXPECT_EQ(list.code, 0);
  for (const io::ShipPreset& ship : io::ship_presets())
    EXPECT_NE(list.out.find("\n" + std::string(ship.name) + " "), std::string::npos) << ship.name;
}

TEST(ShipsCommand, PrintsTheListAsJsonOfEachShipAsItPrintsThat) {
  const TemporaryFolder folder;
  const Outcome list = polynya({"ships", "--json"}, {folder.path()});
  ASSERT_EQ(list.code, 0) << list.err;
  const auto ships = nlohmann::json::parse(list.out);
  ASSERT_EQ(ships.size(), io::ship_presets().size());
  for (const auto& ship : ships) {
    const std::string name = ship.at("name");
    EXPECT_GT(ship.at("ship").at("hull").size(), 0u) << name;
    const Outcome one = polynya({"ships", name, "--json"}, {folder.path()});
    ASSERT_EQ(one.code, 0) << one.err;
    EXPECT_EQ(nlohmann::json::parse(one.out), ship);
  }
}

TEST(ShipsCommand, NamesTheShipsWhereThereIsNoneOfAName) {
  const TemporaryFolder folder;
  const Outcome refused = polynya({"ships", "titanic"}, {folder.path()});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("no ship \"titanic\"; there are"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find(" polaris"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace polynya::tests
