#include "io/text/output_file.hpp"

// A co-simulation unit writes no files. These functions replace the ones that use POSIX, and fail.

namespace polynya::io {
namespace {

tl::unexpected<std::string> refuse(const std::filesystem::path& path) {
  return fail(path.string() + ": a co-simulation unit on Windows writes no files");
}

}  // namespace

bool Descriptor::close() {
  return std::exchange(opened_, -1) < 0;
}

Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  return refuse(path);
}

Result<OutputFile> OutputFile::reopen(const std::filesystem::path& path, const Checksum&) {
  return refuse(path);
}

OutputFile::~OutputFile() = default;

bool OutputFile::flush() {
  if (status_) status_ = refuse(name_);
  return false;
}

bool OutputFile::sync() {
  return flush();
}

bool is_still_at(int, const std::filesystem::path&) {
  return false;
}

Result<> remove_file(const std::filesystem::path& path) {
  return refuse(path);
}

Result<> sync_folder(const std::filesystem::path& folder) {
  return refuse(folder);
}

Result<> write_whole_file(const std::filesystem::path& path, std::string_view, Durability) {
  return refuse(path);
}

Result<> write_whole_file_in_parts(const std::filesystem::path& path, const std::function<void(const WritePart&)>&,
                                   Durability) {
  return refuse(path);
}

}  // namespace polynya::io
