// A bit that a disk flips in a run's folder is found by `inspect --check` and by `resume`, wherever it is.

#include "io/run/checksums.hpp"

#include <cstdlib>
#include <random>

#include "interrupted_run.hpp"
#include <gtest/gtest.h>

#include "io/scene/scene_file.hpp"

namespace polynya::tests {
namespace {

namespace fs = std::filesystem;

/// A finished run with all files that a run may write, except for those that commands add later.
class Checksums : public InSharedFolder {
 protected:
  static void SetUpTestSuite() {
    folder.emplace();
    std::string scene = replaced(kTinyScene, "\"until_s\": 1", "\"until_s\": 2");
    write_file(folder->path() / "tiny.json",
               replaced(scene, "\"position_m\"", "\"panels\": {\"length_m\": 2}, \"position_m\""));
    ASSERT_EQ(call("run tiny.json --out whole").code, 0);
    for (const auto& entry : fs::recursive_directory_iterator(folder->path() / "whole"))
      if (entry.is_regular_file() && entry.file_size() > 0)
        files.push_back(fs::relative(entry, folder->path() / "whole"));
    ASSERT_GE(files.size(), 12U);
  }
  static Outcome call(const Words& words) { return polynya(words, without_converter(*folder)); }
  static fs::path copy() {
    const fs::path run = folder->path() / "run";
    fs::remove_all(run);
    fs::copy(folder->path() / "whole", run, fs::copy_options::recursive);
    return run;
  }
  static void flip(const fs::path& file, std::uint64_t bit) {
    std::string bytes = read_file(file);
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    write_file(file, bytes);
  }
  static inline std::vector<fs::path> files;  ///< relative to the run's folder
};

TEST_F(Checksums, AreThoseOfTheFilesAndHoldUntilOneIsChanged) {
  const fs::path run = copy();
  const io::FilesCheck check = io::check_files(run);
  EXPECT_TRUE(check.has_checksums);
  EXPECT_EQ(check.files, files.size() - 1) << "all but the file of checksums itself";
  EXPECT_EQ(check.damaged, std::vector<std::string>{});
  EXPECT_HAS(expect_code(0, call("inspect run --check")).out, "compared with checksums, 0 damaged", "\nsound\n");
  expect_code(0, call("resume run"));
}

/// Two thousand places, by the functions that both commands call.
TEST_F(Checksums, FindAFlippedBitAnywhere) {
  std::mt19937_64 dice(7);
  const fs::path run = copy();
  for (int i = 0; i < 2000; ++i) {
    const fs::path name = files[dice() % files.size()];
    const std::uint64_t bit = dice() % (8 * fs::file_size(run / name));
    flip(run / name, bit);
    EXPECT_FALSE(io::check_files(run).damaged.empty()) << name << " bit " << bit;
    flip(run / name, bit);
  }
  EXPECT_TRUE(io::check_files(run).damaged.empty());
}

/// The test flips a bit at one place in each file. POLYNYA_FLIPPED_BITS sets a larger number of places.
TEST_F(Checksums, HaveBothCommandsRefuseADamagedFolder) {
  const char* more = std::getenv("POLYNYA_FLIPPED_BITS");
  const std::size_t count = more ? std::strtoul(more, nullptr, 10) : files.size();
  std::mt19937_64 dice(8);
  for (std::size_t i = 0; i < count; ++i) {
    const fs::path run = copy(), name = files[i % files.size()];
    const std::uint64_t bit = dice() % (8 * fs::file_size(run / name));
    flip(run / name, bit);
    SCOPED_TRACE(name.string() + " bit " + std::to_string(bit));
    const Outcome checked = call("inspect run --check");
    EXPECT_TRUE(checked.code == 4 || checked.code == 5) << checked.code << checked.err;
    if (checked.code == 4) {
      EXPECT_HAS(checked.out, name.string() + ": damaged", "NOT SOUND");
    }
    const std::string before = read_file(run / name);
    for (const char* resume : {"resume run", "resume run --until 3"})
      EXPECT_HAS(expect_code(5, call(resume)).err, "run/" + name.string());
    EXPECT_EQ(read_file(run / name), before) << "nothing is added to a damaged run";
  }
}

TEST_F(Checksums, AreRemovedBeforeARunIsMadeLongerAndWrittenAgain) {
  const fs::path run = copy();
  expect_code(0, call("resume run --until 3"));
  EXPECT_TRUE(io::check_files(run).has_checksums);
  EXPECT_TRUE(io::check_files(run).damaged.empty());
  expect_code(0, call("run tiny.json --out run --overwrite --until 1"));
  EXPECT_TRUE(io::check_files(run).damaged.empty());
}

TEST_F(Checksums, MayBeMissingOfOlderRunsAndOfThoseThatHaveNotFinished) {
  fs::remove(copy() / io::run_file::kChecksums);
  EXPECT_HAS(expect_code(0, call("inspect run --check")).out, "files      without checksums");
  expect_code(0, call("resume run"));
  fs::remove_all(folder->path() / "run");
  leave_run(folder->path() / "tiny.json", folder->path() / "run", 150, {100}, 50);
  EXPECT_HAS(expect_code(0, call("inspect run --check")).out, "files      without checksums");
  expect_code(0, call("resume run"));
  EXPECT_EQ(first_difference(folder->path() / "whole", folder->path() / "run"), "");
  EXPECT_TRUE(io::check_files(folder->path() / "run").damaged.empty());
}

/// A flipped bit in the last part of a file is no damage if the resumed run cuts that part off. It is damage if the
/// part stays.
TEST_F(Checksums, OfACheckpointFindABitInWhatIsContinued) {
  const fs::path run = folder->path() / "run";
  for (const std::string_view name : {io::run_file::kFloes, io::run_file::kEvents, io::run_file::kFrames,
                                      io::run_file::kContacts, io::run_file::kForces, io::run_file::kPanels}) {
    fs::remove_all(run);
    leave_run(folder->path() / "tiny.json", run, 150, {100}, 50);
    const auto scene = io::read_scene_file(run / io::run_file::kScene);
    const auto checkpoint = checked(io::read_checkpoint_file(io::checkpoints_in(run).front(), scene->course_hash));
    const auto at = std::ranges::find(io::run_file::kGrowing, name) - io::run_file::kGrowing.begin();
    const std::uint64_t size = checkpoint->progress.files[static_cast<std::size_t>(at)].size;
    flip(run / name, 8 * (size - 1));
    EXPECT_HAS(expect_code(5, call("resume run")).err, std::string(name) + ": damaged since the checkpoint",
               "polynya run run/scene.json --out run --overwrite");
    flip(run / name, 8 * (size - 1));
    if (fs::file_size(run / name) > size) flip(run / name, 8 * size);
    expect_code(0, call("resume run"));
    EXPECT_EQ(first_difference(folder->path() / "whole", run), "");
  }
}

TEST_F(Checksums, AllowThatTheCheckpointOfTheEndIsRemoved) {
  const fs::path run = copy();
  for (const fs::path& checkpoint : io::checkpoints_in(run)) fs::remove(checkpoint);
  EXPECT_TRUE(io::check_files(run).damaged.empty());
  fs::remove(run / io::run_file::kStates);
  ASSERT_EQ(io::check_files(run).damaged.size(), 1U);
  EXPECT_HAS(io::check_files(run).damaged.front(), "run/states.csv: No such file");
}

}  // namespace
}  // namespace polynya::tests
