// The part of std::filesystem that the program calls. Debian's C++ library for WebAssembly declares it but is compiled
// without it. Files belong to the module's host. In the page they are in memory (browser/page/files.js), without links
// and users, and with the root as the only initial folder.

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

_LIBCPP_BEGIN_NAMESPACE_FILESYSTEM

namespace {

/// Stores an error. Nothing is thrown, because the program always asks for the error code or tests before.
void keep(error_code* error, int number) {
  if (error) *error = number == 0 ? error_code() : error_code(number, generic_category());
}

string_view last_part(string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == string_view::npos ? path : path.substr(slash + 1);
}

/// Returns the position of the extension in a file's name.
std::size_t extension_at(string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == string_view::npos || dot == 0 || name == ".." ? name.size() : dot;
}

file_status status_of(const path& p, error_code* error, bool follows) {
  struct ::stat found {};
  const int failed = follows ? ::stat(p.c_str(), &found) : ::lstat(p.c_str(), &found);
  keep(error, failed ? errno : 0);
  if (failed) {
    const bool is_missing = errno == ENOENT || errno == ENOTDIR;
    if (is_missing) keep(error, 0);
    return file_status(is_missing ? file_type::not_found : file_type::none);
  }
  if (S_ISREG(found.st_mode)) return file_status(file_type::regular, perms::all);
  if (S_ISDIR(found.st_mode)) return file_status(file_type::directory, perms::all);
  return file_status(S_ISLNK(found.st_mode) ? file_type::symlink : file_type::unknown, perms::all);
}

}  // namespace

// ---- names

path::__string_view path::__root_directory() const {
  return __string_view(__pn_).substr(0, !__pn_.empty() && __pn_[0] == '/' ? 1 : 0);
}
path::__string_view path::__filename() const {
  return last_part(__pn_);
}
path::__string_view path::__stem() const {
  const string_view name = last_part(__pn_);
  return name.substr(0, extension_at(name));
}
path::__string_view path::__extension() const {
  const string_view name = last_part(__pn_);
  return name.substr(extension_at(name));
}
path::__string_view path::__parent_path() const {
  const string_view all = __pn_;
  std::size_t end = all.size() - last_part(all).size();
  while (end > 1 && all[end - 1] == '/') --end;
  return all.substr(0, end);
}
int path::__compare(__string_view other) const {
  return __string_view(__pn_).compare(other);
}
path& path::replace_extension(const path& replacement) {
  __pn_.erase(__pn_.size() - __extension().size());
  if (replacement.empty()) return *this;
  if (replacement.native()[0] != '.') __pn_ += '.';
  __pn_ += replacement.native();
  return *this;
}

// ---- the parts of a name

path::iterator path::begin() const {
  iterator it;
  it.__path_ptr_ = this;
  it.__entry_ = __string_view(__pn_).substr(0, 0);
  it.__state_ = iterator::_BeforeBegin;
  return it.__increment();
}
path::iterator path::end() const {
  iterator it;
  it.__path_ptr_ = this;
  it.__entry_ = __string_view(__pn_).substr(__pn_.size());
  it.__state_ = iterator::_AtEnd;
  return it;
}
path::iterator& path::iterator::__increment() {
  const string_view all = __path_ptr_->native();
  std::size_t at = static_cast<std::size_t>(__entry_.data() - all.data()) + __entry_.size();
  if (__state_ == _BeforeBegin && !all.empty() && all[0] == '/') {
    __state_ = _InRootDir;
    __entry_ = all.substr(0, 1);
  } else {
    while (at < all.size() && all[at] == '/') ++at;
    __state_ = at < all.size() ? _InFilenames : _AtEnd;
    __entry_ = all.substr(at, all.substr(at).find('/'));
  }
  __stashed_elem_ = path(string_type(__entry_));
  return *this;
}

// ---- files

file_status __status(const path& p, error_code* error) {
  return status_of(p, error, true);
}
file_status __symlink_status(const path& p, error_code* error) {
  return status_of(p, error, false);
}
uintmax_t __file_size(const path& p, error_code* error) {
  struct ::stat found {};
  const int failed = ::stat(p.c_str(), &found);
  keep(error, failed ? errno : 0);
  return failed ? static_cast<uintmax_t>(-1) : static_cast<uintmax_t>(found.st_size);
}
bool __remove(const path& p, error_code* error) {
  const int failed = ::remove(p.c_str());
  const bool is_missing = failed && errno == ENOENT;
  keep(error, failed && !is_missing ? errno : 0);
  return !failed;
}
bool __create_directory(const path& p, error_code* error) {
  const int failed = ::mkdir(p.c_str(), 0777);
  const bool is_there = failed && errno == EEXIST;
  keep(error, failed && !is_there ? errno : 0);
  return !failed;
}
path __absolute(const path& p, error_code* error) {
  keep(error, 0);
  return p.is_absolute() ? p : path("/") / p;
}
path __weakly_canonical(const path& p, error_code* error) {
  path result;
  for (const path& part : __absolute(p, error)) {
    if (part == "..")
      result = result.parent_path();
    else if (part != ".")
      result /= part;
  }
  return result;
}
path __canonical(const path& p, error_code* error) {
  path result = __weakly_canonical(p, error);
  const bool is_there = exists(status_of(result, error, true));
  keep(error, is_there ? 0 : ENOENT);
  return is_there ? result : path();
}

// ---- folders

/// Contents of a folder, read at once, because folders of runs are small.
class __dir_stream {
 public:
  vector<directory_entry> entries;
  std::size_t at = 0;
};

directory_iterator::directory_iterator(const path& folder, error_code* error, directory_options) {
  DIR* const opened = ::opendir(folder.c_str());
  keep(error, opened ? 0 : errno);
  if (!opened) return;
  auto stream = make_shared<__dir_stream>();
  while (const dirent* entry = ::readdir(opened)) {
    const string name = entry->d_name;
    error_code ignored;
    if (name != "." && name != "..") stream->entries.emplace_back(folder / name, ignored);
  }
  ::closedir(opened);
  if (!stream->entries.empty()) __imp_ = std::move(stream);
}
directory_iterator& directory_iterator::__increment(error_code* error) {
  keep(error, 0);
  if (++__imp_->at == __imp_->entries.size()) __imp_.reset();
  return *this;
}
const directory_entry& directory_iterator::__dereference() const {
  return __imp_->entries[__imp_->at];
}
error_code directory_entry::__do_refresh() noexcept {
  return {};
}

_LIBCPP_END_NAMESPACE_FILESYSTEM

extern "C" {

/// Locks a file. No lock is needed, because the page is the only program with access to its files.
int flock(int, int) {
  return 0;
}

char* mkdtemp(char* name) {
  return ::mkdir(name, 0700) == 0 ? name : nullptr;
}

// Debian's C++ library is compiled with stack guards. WebAssembly has its own checks, so these do nothing.
void* __stack_chk_guard = nullptr;
void __stack_chk_fail() {
  std::abort();
}

}  // extern "C"
