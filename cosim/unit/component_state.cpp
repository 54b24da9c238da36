#include "cosim/unit/component.hpp"
#include <fmt/format.h>

#include "io/text/checksum.hpp"
#include "simulation/state/archive.hpp"

namespace polynya::cosim {
namespace {

/// Mark and version of a saved instance. A change of the layout raises the version, and other versions are refused.
constexpr std::string_view kMark = "PLYNYFMU";
constexpr std::uint32_t kVersion = 1;

/// A saved instance. `run` is empty where no run had been built.
struct Saved {
  Mode mode = Mode::kInstantiated;
  bool has_experiment = false;
  double start = 0;
  bool has_stop = false;
  double stop = 0;
  std::vector<double> values;
  std::vector<std::uint8_t> is_parameter_set;
  std::string run;
};

template <class Archive>
void fields(Archive& archive, simulation::Is<Saved> auto& s) {
  archive(s.mode, s.has_experiment, s.start, s.has_stop, s.stop, s.values, s.is_parameter_set, s.run);
}

}  // namespace

std::string Component::save() const {
  const Saved saved{mode,
                    has_experiment_,
                    start_,
                    stop_.has_value(),
                    stop_.value_or(0),
                    values_,
                    is_parameter_set_,
                    run_ ? run_->save() : ""};
  simulation::ByteWriter writer;
  fields(writer, saved);
  const std::string payload = writer.take();
  simulation::ByteWriter head;
  head(kVersion, io::Checksum(payload).crc());
  return std::string(kMark) + head.take() + payload;
}

io::Result<> Component::restore(std::string_view bytes) {
  constexpr std::size_t kHead = 8;
  if (bytes.size() < kMark.size() + kHead || !bytes.starts_with(kMark)) return io::fail("not a saved instance");
  std::uint32_t version = 0, crc = 0;
  simulation::ByteReader head(bytes.substr(kMark.size(), kHead));
  head(version, crc);
  const std::string_view payload = bytes.substr(kMark.size() + kHead);
  if (version != kVersion) return io::fail(fmt::format("saved by another version: {}, not {}", version, kVersion));
  if (io::Checksum(payload).crc() != crc) return io::fail("damaged: its checksum is another");
  Saved saved;
  simulation::ByteReader reader(payload);
  fields(reader, saved);
  reader.require(reader.is_at_end() && saved.values.size() == values_.size() &&
                     saved.is_parameter_set.size() == values_.size() && saved.mode <= Mode::kTerminated &&
                     (saved.mode < Mode::kStepping || !saved.run.empty()),
                 "other variables than this unit's");
  if (!reader.is_well()) return io::fail(reader.failure());

  const std::vector<double> values_before = std::exchange(values_, saved.values);
  const auto is_set_before = std::exchange(is_parameter_set_, saved.is_parameter_set);
  const bool needs_another_run = !run_ || has_other_parameters(values_before);
  std::unique_ptr<CoupledRun> run_before;
  if (needs_another_run) run_before = std::exchange(run_, nullptr);
  const io::Result<> done = restore_run(saved.run);
  if (!done) {
    values_ = values_before;
    is_parameter_set_ = is_set_before;
    if (needs_another_run) run_ = std::move(run_before);
    return done;
  }
  mode = saved.mode;
  has_experiment_ = saved.has_experiment;
  start_ = saved.start;
  stop_ = saved.has_stop ? std::optional(saved.stop) : std::nullopt;
  return {};
}

io::Result<> Component::restore_run(const std::string& checkpoint) {
  if (checkpoint.empty()) {
    run_.reset();
    return {};
  }
  if (!run_)
    if (auto built = build(); !built) return built;
  return run_->restore(checkpoint);
}

bool Component::has_other_parameters(const std::vector<double>& values) const {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (interface_.variables[i].causality == Causality::kParameter && values[i] != values_[i]) return true;
  return false;
}

}  // namespace polynya::cosim
