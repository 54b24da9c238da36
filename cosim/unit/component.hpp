#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cosim/coupled_run.hpp"
#include "cosim/fmi2.h"
#include "cosim/variables.hpp"

namespace polynya::cosim {

/// State of an instance in the order of calls of the standard.
enum class Mode : std::uint8_t { kInstantiated, kInitialization, kStepping, kTerminated, kError, kFatal };

/// One instance of the unit. The functions of the standard (functions.cpp) check the order of calls and then call
/// these.
class Component {
 public:
  /// Reads the scene of a folder of resources. The error is why there is no instance.
  static io::Result<std::unique_ptr<Component>> make(const std::string& resources, std::string_view guid);

  // Messages to the other side.

  std::string name;
  fmi2CallbackFunctions callbacks{};
  bool is_logging = false;
  std::set<std::string, std::less<>> categories;  ///< that are logged; empty: all

  /// Sends a message to the other side's logger. Errors are always sent, other categories only if they are asked for.
  void log(fmi2Status status, const char* category, const std::string& message) const;
  /// Logs a call that was refused and changed nothing, and returns fmi2Discard.
  fmi2Status discard(const std::string& message) const;
  /// Logs an error, after which the instance waits for a reset or an earlier state, and returns fmi2Error.
  fmi2Status error(const std::string& message);
  /// The same for a defect after which the instance cannot be used.
  fmi2Status fatal(const std::string& message);

  Mode mode = Mode::kInstantiated;

  // Time, as the other side has it [s].

  /// The standard's fmi2SetupExperiment.
  void set_experiment(double start, std::optional<double> stop);
  bool has_experiment() const { return has_experiment_; }
  double time() const { return start_ + (run_ ? run_->time() : 0); }

  // Values.

  const std::vector<Variable>& variables() const { return interface_.variables; }
  /// Builds the run, if parameters have changed since it was built. The error states the problems of the parameters.
  io::Result<> make_ready();
  double value(std::size_t reference) const { return values_[reference]; }
  void set(std::size_t reference, double value);

  /// Advances by a communication step, entirely or not at all.
  fmi2Status do_step(double from, double length);
  /// Brings the instance back to where it was after it was made.
  void reset();

  /// All of the instance but its name and its logging, as bytes.
  std::string save() const;
  io::Result<> restore(std::string_view bytes);

 private:
  Component(std::string text, std::string file, io::LoadedScene scene);
  io::Result<io::LoadedScene> scene_with_parameters() const;
  io::Result<> build();
  std::vector<Control> controls() const;
  std::vector<ShipInput> inputs() const;
  io::Result<> restore_run(const std::string& checkpoint);
  void take_outputs();
  void log_events() const;
  /// Returns true if a parameter has another value now than in `values`.
  bool has_other_parameters(const std::vector<double>& values) const;

  std::string text_;  ///< of the scene
  std::string file_;  ///< its name, for messages
  Interface interface_;
  std::vector<double> values_;                  ///< of all variables
  std::vector<std::uint8_t> is_parameter_set_;  ///< per variable: true for a parameter that was set
  bool has_experiment_ = false;
  double start_ = 0;
  std::optional<double> stop_;
  std::unique_ptr<CoupledRun> run_;  ///< null until values are needed, and where parameters have changed
};

}  // namespace polynya::cosim
