#include <bit>
#include <charconv>
#include <limits>
#include <random>
#include <vector>

#include "expect_text.hpp"

#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

/// The text at the offset of a value begins with the value as it was written.
void expect_text_at(const std::string& text, const JsonValue& value, std::string_view written) {
  EXPECT_EQ(std::string_view(text).substr(value.offset, written.size()), written);
}

TEST(JsonParser, FindsEveryValueBehindCommentsBlanksAndUnicode) {
  const std::string text =
      "\xEF\xBB\xBF// first: {\"no\": 1}\n"
      "{\t\"name\" /* a \"key\" */ : \"f\\\"lo\\u00e9 é\", // said, with [brackets]\n"
      "  \"numbers\": [1, -2.5e3/**/, 3//\n,true , null],\r\n"
      "  \"é\": {\"inner\": \"\\\\\"}}";
  const JsonDocument document = parse_json(text);
  ASSERT_TRUE(document.faults.empty()) << document.faults.front().found;
  const JsonValue& root = document.root;
  expect_text_at(text, root, "{\t");
  expect_text_at(text, *root.find("name"), R"("f\"lo)");
  EXPECT_EQ(root.find("name")->text(), "f\"lo\u00e9 é");
  const auto& numbers = root.find("numbers")->items();
  const std::vector<const char*> written{"1, ", "-2.5e3/", "3//", "true ", "null]"};
  ASSERT_EQ(numbers.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) expect_text_at(text, numbers[i], written[i]);
  expect_text_at(text, *root.find("é")->find("inner"), R"("\\")");
  EXPECT_EQ(text[root.members()[2].key_offset], '"');
  EXPECT_EQ(line_and_column(text, root.find("é")->find("inner")->offset).line, 5);
  EXPECT_EQ(line_and_column("{\"é\": 1,\t\"b\": 2}", 15).column, 15) << "characters, and a tab is one";
}

TEST(JsonParser, TellsASecondKeyAndKeepsTheFirst) {
  const std::string text = R"({"a": 1, "b": {"c": 2, "c": 3}, "a": 4})";
  const JsonDocument document = parse_json(text);
  ASSERT_EQ(document.faults.size(), 2U);
  EXPECT_EQ(document.faults[0].offset, text.find("\"c\": 3"));
  EXPECT_EQ(document.faults[1].offset, text.find("\"a\": 4"));
  EXPECT_EQ(document.root.find("a")->number(), 1);
  EXPECT_EQ(document.root.members().size(), 2U);
}

/// If each key were compared with all keys before it, this test would take half an hour, which is more than its time
/// limit.
TEST(JsonParser, ReadsHalfAMillionKeysOfOneObjectAndFindsASecondOneAmongThem) {
  std::string text = R"({"properties": {)";
  for (int i = 0; i < 500'000; ++i) text += "\"k" + std::to_string(i) + "\": " + std::to_string(i) + ", ";
  text += R"("k15": -1, "k16": -1, "k499999": -1}})";
  const JsonDocument document = parse_json(text);
  ASSERT_EQ(document.faults.size(), 3U);
  for (const JsonFault& fault : document.faults)
    expect_text_at(text, {nullptr, fault.offset}, "\"" + fault.path + "\": -1");
  const JsonValue& properties = *document.root.find("properties");
  ASSERT_EQ(properties.members().size(), 500'000U);
  for (const auto& [key, value] : {std::pair("k15", 15), std::pair("k16", 16), std::pair("k499999", 499'999)})
    EXPECT_EQ(properties.find(key)->number(), value) << "the first one counts";
}

TEST(JsonParser, BoundsNesting) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
  };
  EXPECT_TRUE(parse_json(nested(kDeepestNesting)).faults.empty());
  const JsonDocument deep = parse_json(nested(1'000'000));
  ASSERT_EQ(deep.faults.size(), 1U);
  EXPECT_EQ(deep.faults[0].offset, static_cast<std::uint32_t>(kDeepestNesting));
}

TEST(JsonParser, FaultsAreReportedInPlainWordsWhereTheyAre) {
  const std::string value = "allowed: an object, a list, text in double quotes, a number, true, false or null";
  const std::string nothing = "found the end of the text, " + value;
  for (const auto& [text, offset, message] : std::initializer_list<std::tuple<std::string, std::size_t, std::string>>{
           {R"({"a": 1 "b": 2})", 8, "a comma is missing before \"b\""},
           {"{\n  \"a\": {\"c\": 1} // note\n  \"b\": 2\n}", 28,
            "a comma is missing before \"b\", at the end of line 2"},
           {"[[1, 2]\n [3, 4]]", 9, "a comma is missing before '[', at the end of line 1"},
           {"[1 -2]", 3, "a comma is missing before '-2'"},
           {"[1 /*]*/ 2]", 9, "a comma is missing before '2'"},
           {"[1, 2,\n]", 5, "a comma too many: only ']' follows it"},
           {R"({"a": 1, /* }] */ })", 7, "a comma too many: only '}' follows it"},
           {"[1,,2]", 3, "a comma too many: nothing stands before it"},
           {"[,1]", 1, "a comma too many: nothing stands before it"},
           {"{\n\"a\": [1,\n2", 12, "the text ends, but the list that begins on line 2 is not closed with ']'"},
           {R"({"a": 1; "b": 2})", 7, "found ';', allowed: a comma, or '}'"},
           {R"({name: 1})", 1, "found 'name', allowed: a key in double quotes"},
           {R"({"a" = 1})", 5, "found '=', allowed: a colon between a key and its value"},
           {R"({"a": , "b": 1})", 6, "found ',', " + value},
           {R"({"a": })", 6, ""},
           {R"({"a": NaN})", 6, ""},
           {R"({"a": 1e400})", 6, ""},
           {"{} x", 3, "found 'x', allowed: nothing behind the outermost value"},
           {"", 0, nothing},
           {"// only this", 12, nothing},
           {"[\"a", 1, ""},
           {"{\"a\": \"b\n\"}", 6,
            "found \"b, allowed: text that ends with a double quote on the same line (\\n and \\t stand for breaks and "
            "tabs)"}}) {
    const JsonDocument document = parse_json(text);
    ASSERT_EQ(document.faults.size(), 1U) << text;
    EXPECT_EQ(document.faults[0].offset, offset) << text;
    EXPECT_BEGINS(message_of(document.faults[0]), message) << text;
    EXPECT_TRUE(document.faults[0].path.empty());
  }
  EXPECT_EQ(parse_json(std::string("{}\0{}", 5)).faults.size(), 1U);
  EXPECT_EQ(parse_json("\"\xff\"").faults.size(), 1U);
}

TEST(JsonWriter, NumbersReadBackToTheSameDouble) {
  std::mt19937_64 random(20170611);
  const auto written = [](double value) {
    std::string text;
    append_number(text, value);
    return text;
  };
  for (int i = 0; i < 100'000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const std::string text = written(value);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(back, value) << text;
  }
  EXPECT_EQ(written(0.1), "0.1");
  EXPECT_EQ(written(-0.0), "0");
  EXPECT_EQ(written(550), "550");
  EXPECT_EQ(written(std::numeric_limits<double>::quiet_NaN()), "null");
}

TEST(JsonWriter, WhatIsWrittenReadsBack) {
  const std::string text = R"({"a": [1, [2, 3.5]], "b": {"c": "x\"\\\ny\u0001é", "d": [true, null, {}], "e": []}})";
  const std::string once = to_json_text(parse_json(text).root);
  const JsonDocument again = parse_json(once);
  ASSERT_TRUE(again.faults.empty()) << once;
  EXPECT_EQ(to_json_text(again.root), once);
  EXPECT_EQ(again.root.find("b")->find("c")->text(), "x\"\\\ny\x01é");
}

TEST(Nearest, FindsWhatWasMeant) {
  const std::vector<std::string_view> keys{"thickness_m", "density_kg_per_m3", "friction", "poisson_ratio"};
  for (const char* word : {"thicknes_m", "thickness", "thickness_mm"}) EXPECT_EQ(nearest(word, keys), "thickness_m");
  EXPECT_EQ(nearest("firction", keys), "friction");
  EXPECT_EQ(nearest("colour", keys), "");
}

}  // namespace
}  // namespace polynya::io
