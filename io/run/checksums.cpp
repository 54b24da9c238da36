#include "io/run/checksums.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/run/checkpoint.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/output_file.hpp"

namespace polynya::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestChecksums = std::size_t{64} << 20;  ///< [bytes]

std::string line_of(std::string_view name, const Checksum& sum) {
  return fmt::format("{:08x} {} {}\n", sum.crc(), sum.size(), name);
}

/// Returns each line of checksums.txt but the last, with its line break, and the file name in it. Fails if the file
/// cannot be read or does not match its own checksum.
Result<std::vector<std::pair<std::string, std::string>>> lines_in(const fs::path& folder) {
  const fs::path file = folder / run_file::kChecksums;
  const auto text = read_text_file(file, kLongestChecksums);
  if (!text) return fail(fmt::format("{}: {}", file.string(), text.error()));
  const std::string_view whole(*text);
  const std::size_t end = whole.substr(0, whole.size() - std::min<std::size_t>(whole.size(), 1)).rfind('\n') + 1;
  const std::string_view above = whole.substr(0, end);
  if (whole.substr(end) != line_of(run_file::kChecksums, Checksum(above)))
    return fail(file.string() + ": damaged: its own checksum, in its last line, is not that of the lines above");
  std::vector<std::pair<std::string, std::string>> lines;
  for_pieces(above, '\n', [&](std::string_view line, std::size_t) {
    lines.emplace_back(std::string(line) + '\n', line.substr(line.find(' ', line.find(' ') + 1) + 1));
  });
  return lines;
}

Result<> write_lines(const fs::path& folder, const std::string& lines) {
  return write_whole_file(folder / run_file::kChecksums, lines + line_of(run_file::kChecksums, Checksum(lines)),
                          Durability::kSynced);
}

/// Returns true for checkpoints, which a finished run does not need, and for pictures, which can be drawn again.
bool may_be_removed(const std::string& name) {
  return is_checkpoint(name) || name == run_file::kFinalSvg || name == run_file::kFinalPng;
}

/// Compares a file with its line of checksums.txt. Returns what is wrong, or an empty text.
std::string fault_of(const fs::path& folder, const std::string& name, const std::string& line) {
  const fs::path file = folder / name;
  const auto sum = checksum_of(file);
  if (!sum) return sum.error();
  if (line_of(name, *sum) == line) return "";
  return fmt::format("{}: damaged since the run finished: {} bytes with the checksum {:08x}; {} has: {}", file.string(),
                     sum->size(), sum->crc(), run_file::kChecksums, trimmed(line));
}

}  // namespace

Result<Checksum> checksum_of(const fs::path& file, std::uint64_t most) {
  const auto refuse = [&](std::string_view reason) { return fail(fmt::format("{}: {}", file.string(), reason)); };
  // O_NONBLOCK opens a pipe at once, so that it can be refused. Without it, open() would wait for a writer.
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) return refuse(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) return refuse("not a regular file");
  Checksum sum;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (sum.size() < most) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), most - sum.size()));
    const ssize_t count = ::read(descriptor, buffer.data(), wanted);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return refuse(std::strerror(errno));
    if (count == 0) break;
    sum.add({buffer.data(), static_cast<std::size_t>(count)});
  }
  return sum;
}

Result<> announce_checksums(const fs::path& folder) {
  return write_whole_file(temporary_name(folder / run_file::kChecksums), "", Durability::kSynced);
}

Result<> write_checksums(const fs::path& folder, const Checksums& checksums) {
  std::string text;
  for (const auto& [name, sum] : checksums) text += line_of(name, sum);
  return write_lines(folder, text);
}

Result<> add_checksums(const fs::path& folder, const std::vector<std::string_view>& names) {
  if (!fs::exists(folder / run_file::kChecksums)) return {};
  const auto old = lines_in(folder);
  if (!old) return fail(old.error());
  std::string text;
  for (const auto& [line, name] : *old)
    if (std::ranges::find(names, name) == names.end()) text += line;
  for (const std::string_view name : names) {
    const auto sum = checksum_of(folder / name);
    if (!sum) return fail(sum.error());
    text += line_of(name, *sum);
  }
  return write_lines(folder, text);
}

Result<> remove_checksums(const fs::path& folder) {
  const fs::path file = folder / run_file::kChecksums;
  if (!fs::exists(fs::symlink_status(file))) return {};
  const auto removed = remove_file(file);
  return removed ? sync_folder(folder) : removed;
}

bool lacks_checksums(const fs::path& folder) {
  const fs::path file = folder / run_file::kChecksums;
  return fs::exists(fs::symlink_status(temporary_name(file))) && !fs::exists(fs::symlink_status(file));
}

FilesCheck check_files(const fs::path& folder) {
  FilesCheck check;
  check.has_checksums = fs::exists(fs::symlink_status(folder / run_file::kChecksums));
  if (!check.has_checksums) return check;
  const auto lines = lines_in(folder);
  if (!lines) {
    check.damaged.push_back(lines.error());
    return check;
  }
  for (const auto& [line, name] : *lines) {
    if (may_be_removed(name) && !fs::exists(fs::symlink_status(folder / name))) continue;
    ++check.files;
    if (std::string fault = fault_of(folder, name, line); !fault.empty()) check.damaged.push_back(std::move(fault));
  }
  return check;
}

}  // namespace polynya::io
