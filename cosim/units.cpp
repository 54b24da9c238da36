#include "cosim/units.hpp"

#include <utility>

namespace polynya::cosim {
namespace {

/// The units of scenes (the keys' units in io/scene/describe_*.cpp) and of outputs. The factor of ° is π / 180.
constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
    {"m", R"(m="1")"},
    {"m²", R"(m="2")"},
    {"s", R"(s="1")"},
    {"m/s", R"(m="1" s="-1")"},
    {"1/s", R"(s="-1")"},
    {"rad", R"(rad="1")"},
    {"rad/s", R"(rad="1" s="-1")"},
    {"°", R"(rad="1" factor="0.017453292519943295")"},
    {"°/s", R"(rad="1" s="-1" factor="0.017453292519943295")"},
    {"kg", R"(kg="1")"},
    {"kg m²", R"(kg="1" m="2")"},
    {"kg/m³", R"(kg="1" m="-3")"},
    {"N", R"(kg="1" m="1" s="-2")"},
    {"kN", R"(kg="1" m="1" s="-2" factor="1000")"},
    {"N.m", R"(kg="1" m="2" s="-2")"},
    {"N/m", R"(kg="1" s="-2")"},
    {"N m/rad", R"(kg="1" m="2" s="-2" rad="-1")"},
    {"N s/m", R"(kg="1" s="-1")"},
    {"N m s/rad", R"(kg="1" m="2" s="-1" rad="-1")"},
    {"MW", R"(kg="1" m="2" s="-3" factor="1e6")"},
    {"Pa", R"(kg="1" m="-1" s="-2")"},
    // BaseUnit has whole exponents only; Pa √m is the square root of kg² m⁻¹ s⁻⁴, so its dimension is left open.
    {"Pa √m", ""},
};

}  // namespace

std::string base_unit(std::string_view unit) {
  for (const auto& [name, powers] : kUnits)
    if (name == unit) return std::string(powers);
  return {};
}

}  // namespace polynya::cosim
