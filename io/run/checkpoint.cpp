#include "io/run/checkpoint.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "io/text/checksum.hpp"
#include "io/text/output_file.hpp"
#include "simulation/state/archive.hpp"
#include "simulation/state/state_fields.hpp"

namespace polynya::io {

using simulation::Is;

template <class Archive>
void fields(Archive& archive, Is<Peak> auto& p) {
  archive(p.value, p.time);
}
template <class Archive>
void fields(Archive& archive, Is<ShipPeaks> auto& p) {
  archive(p.ship, p.of_column, p.of_contact);
}
template <class Archive>
void fields(Archive& archive, Is<RecordedMotion> auto& r) {
  archive(r.time, r.motion);
}
template <class Archive>
void fields(Archive& archive, Is<WrittenFile> auto& f) {
  archive(f.size, f.crc);
}
template <class Archive>
void fields(Archive& archive, Is<RunProgress> auto& p) {
  archive(p.files, p.recorded, p.peaks);
}
template <class Archive>
void fields(Archive& archive, Is<Checkpoint> auto& c) {
  archive(c.program_version, c.course_hash, c.steps, c.wall_time, c.progress, c.state, c.state_hash, c.failure);
}

namespace {

constexpr std::string_view kMark = "PLYNYCKP";
constexpr std::size_t kHeadSize = 24;  ///< length of mark, version, checksum and length [bytes]
constexpr std::string_view kPrefix = "checkpoint-";
constexpr std::string_view kSuffix = ".bin";

/// Returns the number of steps in the name of a checkpoint; negative if it is not the name of one.
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

std::string payload_of(const Checkpoint& checkpoint) {
  simulation::ByteWriter writer;
  fields(writer, checkpoint);
  return writer.take();
}

std::string head_of(std::string_view payload) {
  simulation::ByteWriter head;
  head(kCheckpointVersion, Checksum(payload).crc(), std::uint64_t{payload.size()});
  return std::string(kMark).append(head.take());
}

}  // namespace

std::string checkpoint_file_of(std::string_view payload) {
  return head_of(payload).append(payload);
}

std::string checkpoint_bytes(const Checkpoint& checkpoint) {
  return checkpoint_file_of(payload_of(checkpoint));
}

Result<> write_checkpoint_file(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  // A variable of its own, because it has 200 MB for a million floes and must not be copied.
  const std::string payload = payload_of(checkpoint);
  const auto produce = [&](const WritePart& write) {
    write(head_of(payload));
    write(payload);
  };
  return write_whole_file_in_parts(path, produce, Durability::kSynced);
}

Result<Checkpoint> read_checkpoint(std::string_view bytes) {
  if (bytes.size() < kHeadSize || !bytes.starts_with(kMark)) return fail("not a checkpoint");
  simulation::ByteReader head(bytes.substr(kMark.size()));
  std::uint32_t version = 0;
  std::uint32_t crc = 0;
  std::uint64_t length = 0;
  head(version, crc, length);
  if (version != kCheckpointVersion)
    return fail(fmt::format("a checkpoint of version {}; this program reads {}", version, kCheckpointVersion));
  const std::string_view payload = bytes.substr(kHeadSize);
  if (payload.size() != length) return fail(fmt::format("damaged: {} bytes of {}", payload.size(), length));
  if (Checksum(payload).crc() != crc) return fail("damaged: its checksum does not match");
  Checkpoint checkpoint;
  simulation::ByteReader reader(payload);
  fields(reader, checkpoint);
  reader.require(reader.is_at_end(), "more bytes than it should have");
  reader.require(checkpoint.steps >= 0, "a number of steps that cannot be");
  if (!reader.is_well()) return fail("damaged: " + reader.failure());
  return checkpoint;
}

bool is_checkpoint(const std::filesystem::path& path) {
  return steps_of(path) >= 0;
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

Result<> write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint) {
  if (auto written = write_checkpoint_file(path_of(folder, checkpoint), checkpoint); !written) return written;
  const std::vector<std::filesystem::path> found = checkpoints_in(folder);
  const auto is_older = [&](const auto& path) { return steps_of(path) < checkpoint.steps; };
  const auto kept = std::ranges::find_if(found, is_older);
  std::error_code ignored;  // an old checkpoint that stays does no harm
  for (auto path = found.begin(); path != found.end(); ++path)
    if (path != kept && steps_of(*path) != checkpoint.steps) std::filesystem::remove(*path, ignored);
  return {};
}

Result<> rewind_to(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                   const std::filesystem::path& file) {
  const auto own = path_of(folder, checkpoint);
  std::error_code ignored;  // the file may not exist yet
  if (!std::filesystem::equivalent(file, own, ignored))
    if (auto written = write_checkpoint_file(own, checkpoint); !written) return written;
  for (const auto& path : checkpoints_in(folder)) {
    if (steps_of(path) <= checkpoint.steps) break;
    if (auto removed = remove_file(path); !removed) return removed;
  }
  return sync_folder(folder);
}

Result<Checkpoint> read_checkpoint_file(const std::filesystem::path& path, std::string_view course_hash) {
  const auto problem = [&](const std::string& reason) { return fail(fmt::format("{}: {}", path.string(), reason)); };
  auto text = read_text_file(path, std::numeric_limits<std::size_t>::max());
  if (!text) return problem(text.error());
  auto checkpoint = read_checkpoint(*text);
  if (!checkpoint) return problem(checkpoint.error());
  if (checkpoint->course_hash != course_hash)
    return problem("of another run: its scene is not this folder's scene.json");
  return checkpoint;
}

Result<> remove_checkpoints(const std::filesystem::path& folder, std::size_t kept) {
  std::vector<std::filesystem::path> files = checkpoints_in(folder);
  files.erase(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(std::min(kept, files.size())));
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with(".bin.part")) files.push_back(entry.path());
  }
  for (const auto& file : files)
    if (auto removed = remove_file(file); !removed) return removed;
  return {};
}

}  // namespace polynya::io
