#include "cosim/model_description.hpp"

#include <array>
#include <cmath>
#include <set>

#include "cosim/units.hpp"
#include <fmt/format.h>

#include "io/run/summary.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::cosim {
namespace {

/// A text between quotes or tags of XML. Control characters, which XML does not have, become spaces.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return result;
}

/// FNV-1a of a text from a start value.
std::uint64_t hash_of(std::string_view text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// The fewest digits that read back to the number.
std::string number(double value) {
  return fmt::format("{}", value);
}

void append_range(std::string& xml, const Variable& v) {
  if (std::isfinite(v.least)) xml += fmt::format(R"( min="{}")", number(v.least));
  if (std::isfinite(v.most)) xml += fmt::format(R"( max="{}")", number(v.most));
}

bool has_start(const Variable& v) {
  return v.causality == Causality::kParameter || v.causality == Causality::kInput;
}

void append_type(std::string& xml, const Variable& v) {
  const std::string start = has_start(v) ? fmt::format(R"( start="{}")", number(v.start)) : "";
  switch (v.type) {
    case VariableType::kReal:
      xml += "<Real";
      if (!v.unit.empty()) xml += fmt::format(R"( unit="{}")", escaped(v.unit));
      append_range(xml, v);
      break;
    case VariableType::kInteger:
      xml += "<Integer";
      append_range(xml, v);
      break;
    case VariableType::kBoolean:
      xml += "<Boolean";
      if (has_start(v)) xml += fmt::format(R"( start="{}")", v.start != 0 ? "true" : "false");
      xml += "/>";
      return;
    case VariableType::kControl:
      xml += R"(<Enumeration declaredType="Control" min="1" max="3")";
      break;
  }
  xml += start + "/>";
}

/// causality, variability and initial, in combinations that the standard has.
std::string_view kind_of(const Variable& v) {
  switch (v.causality) {
    case Causality::kParameter:
      return R"(causality="parameter" variability="fixed" initial="exact")";
    case Causality::kCalculatedParameter:
      return R"(causality="calculatedParameter" variability="fixed" initial="calculated")";
    case Causality::kInput:
      return R"(causality="input" variability="continuous")";
    case Causality::kOutput:
      return v.type == VariableType::kReal ? R"(causality="output" variability="continuous" initial="calculated")"
                                           : R"(causality="output" variability="discrete" initial="calculated")";
  }
  return {};
}

std::string variables_xml(const Interface& interface) {
  std::string xml = "  <ModelVariables>\n";
  for (std::size_t i = 0; i < interface.variables.size(); ++i) {
    const Variable& v = interface.variables[i];
    xml += fmt::format(R"(    <ScalarVariable name="{}" valueReference="{}" {})", escaped(v.name), i, kind_of(v));
    if (!v.meaning.empty()) xml += fmt::format(R"( description="{}")", escaped(v.meaning));
    xml += '>';
    append_type(xml, v);
    xml += "</ScalarVariable>\n";
  }
  return xml + "  </ModelVariables>\n";
}

std::string units_xml(const Interface& interface) {
  std::set<std::string> names;
  for (const Variable& v : interface.variables)
    if (!v.unit.empty()) names.insert(v.unit);
  std::string xml = "  <UnitDefinitions>\n";
  for (const std::string& name : names) {
    const std::string base = base_unit(name);
    xml += base.empty() ? fmt::format("    <Unit name=\"{}\"/>\n", escaped(name))
                        : fmt::format("    <Unit name=\"{}\"><BaseUnit {}/></Unit>\n", escaped(name), base);
  }
  return xml + "  </UnitDefinitions>\n";
}

/// Lists the outputs, and the variables that are computed during initialization, by their numbers from 1 on.
std::string structure_xml(const Interface& interface) {
  std::string outputs, unknowns;
  for (std::size_t i = 0; i < interface.variables.size(); ++i) {
    const Causality causality = interface.variables[i].causality;
    const std::string line = fmt::format("      <Unknown index=\"{}\"/>\n", i + 1);
    if (causality == Causality::kOutput) outputs += line;
    if (causality == Causality::kOutput || causality == Causality::kCalculatedParameter) unknowns += line;
  }
  return fmt::format(
      "  <ModelStructure>\n    <Outputs>\n{}    </Outputs>\n    <InitialUnknowns>\n{}    </InitialUnknowns>\n"
      "  </ModelStructure>\n",
      outputs, unknowns);
}

constexpr auto kCapabilities =
    R"(  <CoSimulation modelIdentifier="{}" needsExecutionTool="false" canHandleVariableCommunicationStepSize="true"
    canInterpolateInputs="false" maxOutputDerivativeOrder="0" canRunAsynchronuously="false"
    canBeInstantiatedOnlyOncePerProcess="false" canNotUseMemoryManagementFunctions="true" canGetAndSetFMUstate="true"
    canSerializeFMUstate="true" providesDirectionalDerivative="false"/>
)";
constexpr auto kTypes =
    R"(  <TypeDefinitions>
    <SimpleType name="Control" description="who moves a ship">
      <Enumeration>
        <Item name="scene" value="1" description="its propulsion and its pilot in the scene"/>
        <Item name="commands" value="2" description="the master, by lever and steering angle"/>
        <Item name="motion" value="3" description="the master, which gives pose and velocity"/>
      </Enumeration>
    </SimpleType>
  </TypeDefinitions>
  <LogCategories>
    <Category name="logEvents" description="events of the ice: bends, splits, collisions"/>
    <Category name="logStatusWarning" description="what may surprise"/>
    <Category name="logStatusDiscard" description="calls that were refused and changed nothing"/>
    <Category name="logStatusError" description="calls that were wrong"/>
    <Category name="logStatusFatal" description="defects after which the instance cannot be used"/>
    <Category name="logAll" description="all of the above"/>
  </LogCategories>
)";

}  // namespace

std::string guid_of(const io::LoadedScene& scene, const Interface& interface) {
  const std::uint64_t of_scene = hash_of(io::version(), hash_of(scene.resolved_text, 0xcbf29ce484222325));
  const std::uint64_t of_variables = hash_of(variables_xml(interface), of_scene);
  const std::string digits = fmt::format("{:016x}{:016x}", of_scene, of_variables);
  return fmt::format("{{{}-{}-{}-{}-{}}}", digits.substr(0, 8), digits.substr(8, 4), digits.substr(12, 4),
                     digits.substr(16, 4), digits.substr(20));
}

std::string model_description(const io::LoadedScene& scene, const Interface& interface) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const std::string text = scene.description.empty() ? "A ship in ice, simulated by Polynya" : scene.description;
  xml += fmt::format(
      "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"{}\" guid=\"{}\"\n    description=\"{}\"\n"
      "    generationTool=\"Polynya {}\" variableNamingConvention=\"flat\">\n",
      escaped(scene.scene.name), guid_of(scene, interface), escaped(text), io::version());
  xml += fmt::format(fmt::runtime(kCapabilities), kModelIdentifier);
  xml += units_xml(interface);
  xml += kTypes;
  xml += fmt::format("  <DefaultExperiment startTime=\"0\" stopTime=\"{}\" stepSize=\"{}\"/>\n",
                     number(scene.scene.time.until), number(scene.scene.time.step));
  xml += variables_xml(interface) + structure_xml(interface);
  return xml + "</fmiModelDescription>\n";
}

}  // namespace polynya::cosim
