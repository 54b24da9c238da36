#include "io/run/checkpoint.hpp"

#include <algorithm>
#include <limits>

#include <boost/crc.hpp>
#include <fmt/format.h>

#include "io/text/source_text.hpp"
#include "simulation/state/archive.hpp"
#include "simulation/state/state_fields.hpp"

namespace polynya::io {

using simulation::Is;

namespace {

constexpr std::string_view kMark = "PLYNYCKP";
constexpr std::size_t kHeadSize = 24;
constexpr std::string_view kPrefix = "checkpoint-";
constexpr std::string_view kSuffix = ".bin";

std::uint32_t crc_of(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

/// The number of steps in a checkpoint's name; negative where it is none.
std::int64_t steps_of(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return -1;
  const std::string digits = name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size());
  if (digits.size() != 12 || digits.find_first_not_of("0123456789") != std::string::npos) return -1;
  return std::stoll(digits);
}

std::filesystem::path path_of(const std::filesystem::path& folder, const Checkpoint& checkpoint) {
  return folder / fmt::format("{}{:012}{}", kPrefix, checkpoint.steps, kSuffix);
}

std::string put(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  return write_whole_file(path, checkpoint_bytes(checkpoint), Durability::kSynced);
}

std::string remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  return error ? fmt::format("{}: {}", path.string(), error.message()) : "";
}

template <class Archive>
void fields(Archive& archive, Is<Checkpoint> auto& c) {
  archive(c.program_version, c.scene_hash, c.steps, c.wall_time, c.progress, c.state, c.state_hash,
          c.failure);
}

}  // namespace

template <class Archive>
void fields(Archive& archive, Is<Peak> auto& p) {
  archive(p.value, p.time);
}
template <class Archive>
void fields(Archive& archive, Is<ShipPeaks> auto& p) {
  archive(p.ship, p.of_column);
}
template <class Archive>
void fields(Archive& archive, Is<Motion> auto& m) {
  archive(m.position, m.angle, m.velocity, m.angular_velocity);
}
template <class Archive>
void fields(Archive& archive, Is<FrameEncoder::Told> auto& t) {
  archive(t.time, t.motion);
}
template <class Archive>
void fields(Archive& archive, Is<RunProgress> auto& p) {
  archive(p.file_sizes, p.told, p.peaks);
}

std::string checkpoint_file_of(std::string_view payload) {
  simulation::ByteWriter head;
  head(kCheckpointVersion, crc_of(payload), std::uint64_t{payload.size()});
  return std::string(kMark).append(head.take()).append(payload);
}

std::string checkpoint_bytes(const Checkpoint& checkpoint) {
  simulation::ByteWriter payload;
  fields(payload, checkpoint);
  return checkpoint_file_of(payload.take());
}

tl::expected<Checkpoint, std::string> read_checkpoint(std::string_view bytes) {
  const auto fail = [](std::string reason) { return tl::unexpected(std::move(reason)); };
  if (bytes.size() < kHeadSize || !bytes.starts_with(kMark)) return fail("not a checkpoint");
  simulation::ByteReader head(bytes.substr(kMark.size()));
  std::uint32_t version = 0;
  std::uint32_t crc = 0;
  std::uint64_t length = 0;
  head(version, crc, length);
  if (version != kCheckpointVersion)
    return fail(
        fmt::format("a checkpoint of version {}; this program reads {}", version, kCheckpointVersion));
  const std::string_view payload = bytes.substr(kHeadSize);
  if (payload.size() != length) return fail(fmt::format("damaged: {} bytes of {}", payload.size(), length));
  if (crc_of(payload) != crc) return fail("damaged: its checksum does not match");
  Checkpoint checkpoint;
  simulation::ByteReader reader(payload);
  fields(reader, checkpoint);
  reader.require(reader.is_at_end(), "more bytes than it should have");
  reader.require(checkpoint.steps >= 0, "a number of steps that cannot be");
  if (!reader.is_well()) return fail("damaged: " + reader.failure());
  return checkpoint;
}

std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (steps_of(entry.path()) >= 0) found.push_back(entry.path());
  }
  std::ranges::sort(found, [](const auto& p, const auto& q) { return steps_of(p) > steps_of(q); });
  return found;
}

std::string write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint) {
  if (std::string failure = put(path_of(folder, checkpoint), checkpoint); !failure.empty()) return failure;
  const std::vector<std::filesystem::path> found = checkpoints_in(folder);
  const auto is_older = [&](const auto& path) { return steps_of(path) < checkpoint.steps; };
  const auto kept = std::ranges::find_if(found, is_older);
  std::error_code ignored;  // one too many does no harm
  for (auto path = found.begin(); path != found.end(); ++path)
    if (path != kept && steps_of(*path) != checkpoint.steps) std::filesystem::remove(*path, ignored);
  return "";
}

std::string rewind_to(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                      const std::filesystem::path& file) {
  const auto own = path_of(folder, checkpoint);
  std::error_code ignored;  // where there is no such file yet
  std::string failure = std::filesystem::equivalent(file, own, ignored) ? "" : put(own, checkpoint);
  for (const auto& path : checkpoints_in(folder)) {
    if (!failure.empty() || steps_of(path) <= checkpoint.steps) break;
    failure = remove_file(path);
  }
  return failure.empty() ? sync_folder(folder) : failure;
}

tl::expected<Checkpoint, std::string> read_checkpoint_file(const std::filesystem::path& path,
                                                           std::string_view scene_hash) {
  auto text = read_text_file(path, std::numeric_limits<std::size_t>::max());
  const auto fail = [&](const std::string& reason) {
    return tl::unexpected(fmt::format("{}: {}", path.string(), reason));
  };
  if (!text) return fail(text.error());
  auto checkpoint = read_checkpoint(*text);
  if (!checkpoint) return fail(checkpoint.error());
  if (checkpoint->scene_hash != scene_hash)
    return fail(fmt::format("of another run: its scene's hash is {}, that of this folder's scene.json {}",
                            checkpoint->scene_hash, scene_hash));
  return checkpoint;
}

std::string remove_checkpoints(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> gone = checkpoints_in(folder);
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with(".bin.part")) gone.push_back(entry.path());
  }
  std::string failure;
  for (const auto& path : gone)
    if (failure.empty()) failure = remove_file(path);
  return failure;
}

}  // namespace polynya::io
