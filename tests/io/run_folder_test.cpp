// Ownership of a run folder, and the files that --overwrite removes.
#include "io/run/run_folder.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <functional>
#include <new>

#include "expect_text.hpp"
#include "temporary_folder.hpp"
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/run/checkpoint.hpp"
#include "io/text/output_file.hpp"

namespace polynya::io {
namespace {

namespace fs = std::filesystem;
using tests::read_file;
using tests::TemporaryFolder;
using tests::write_file;

/// Returns the reason why a folder cannot be claimed, or an empty text if it can. The claim ends at once, as after a
/// kill.
std::string refusal(const fs::path& folder, bool overwrite) {
  const auto lock = claim_run_folder(folder, overwrite);
  return lock ? "" : lock.error();
}

TEST(RunFolder, RefusesWhatIsNotEmptyAndWritesNothingThere) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal(folder / "new/deep", false), "");
  EXPECT_EQ(refusal(folder / "new/deep", false), "");  // empty still
  write_file(folder / "foreign/thesis.tex", "years of work");
  write_file(folder / "foreign/scene.json", "{}");
  for (const bool overwrite : {false, true}) {
    EXPECT_HAS(refusal(folder / "foreign", overwrite), "not a run folder");
    EXPECT_HAS(refusal(folder / "foreign/thesis.tex", overwrite), "not a folder");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "foreign"), {}), 2);
  EXPECT_EQ(read_file(folder / "foreign/thesis.tex"), "years of work");
}

/// A run folder of this version or, without the mark, of an earlier one.
void write_old_run(const fs::path& run, bool is_marked) {
  for (const auto name : run_file::kGrowing) write_file(run / name, "old");
  for (const auto name : run_file::kMadeAtEnd) write_file(run / name, "old");
  for (const auto name : {run_file::kScene, run_file::kSummary}) write_file(run / name, "old");
  for (const auto name : {"failure.bin", "figure-loads.svg", "figure-loads.png", "checkpoint-000000000100.bin",
                          "checkpoint-000000000200.bin.part", "summary.json.part", "rejected-cuts/000001.geojson",
                          "rejected-cuts/000001-ops.json", "rejected-cuts/000002.geojson.part"})
    write_file(run / name, "old");
  if (is_marked) write_file(run / run_file::kLock, "");
}

TEST(RunFolder, OverwritesOnlyWhatPolynyaWrites) {
  for (const bool is_marked : {false, true}) {
    const TemporaryFolder folder;
    const fs::path run = folder / "run";
    write_old_run(run, is_marked);
    EXPECT_HAS(refusal(run, false), "--overwrite");
    EXPECT_EQ(read_file(run / "forces.csv"), "old");
    const std::array foreign{"notes.txt",
                             "figure-mine.svg",
                             "checkpoint-of-mine.bin",
                             "rejected-cuts/notes.txt",
                             "rejected-cuts/1.geojson",
                             "rejected-cuts/000001.txt"};
    for (const auto* name : foreign) write_file(run / name, "mine");
    EXPECT_EQ(refusal(run, true), "");
    for (const auto* name : foreign) {
      EXPECT_EQ(read_file(run / name), "mine") << name;
      fs::remove(run / name);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(run / "rejected-cuts"), {}), 0);
    EXPECT_EQ(std::distance(fs::directory_iterator(run), {}), 2) << "the mark, and rejected-cuts";
  }
}

TEST(RunFolder, RemovesThroughNoLink) {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  write_old_run(run, true);
  write_file(folder / "elsewhere/000001.geojson", "precious");
  fs::remove_all(run / "rejected-cuts");
  fs::create_directory_symlink(folder / "elsewhere", run / "rejected-cuts");
  EXPECT_HAS(refusal(run, true), "rejected-cuts: a link");
  fs::remove(run / "rejected-cuts");
  fs::remove(run / "forces.csv");
  fs::create_symlink(folder / "elsewhere/000001.geojson", run / "forces.csv");
  EXPECT_EQ(refusal(run, true), "");
  EXPECT_EQ(read_file(folder / "elsewhere/000001.geojson"), "precious");
}

TEST(RunFolder, WhatAKillLeavesIsTakenAndNamed) {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  write_file(run / run_file::kLock, "");
  EXPECT_EQ(refusal(run, false), "");
  write_file(run / "scene.json.part", "{");
  EXPECT_EQ(refusal(run, false), "") << "nothing is lost";
  write_file(run / "forces.csv", "old");
  EXPECT_HAS(refusal(run, false), "parts of a run in it, without its scene");
  EXPECT_EQ(refusal(run, true), "");
  EXPECT_FALSE(fs::exists(run / "forces.csv"));
  write_file(run / "scene.json", "{}");
  EXPECT_HAS(refusal(run, false), "continue it with: polynya resume");
  EXPECT_EQ(refusal(run, true), "");
  EXPECT_FALSE(fs::exists(run / "scene.json"));
}

/// Several processes claim one new folder at the same time, and keep their claims until all have tried.
int owners_of(const fs::path& folder, int processes) {
  std::array<int, 2> start{}, result{}, end{};
  EXPECT_EQ(pipe(start.data()) + pipe(result.data()) + pipe(end.data()), 0);
  for (int i = 0; i < processes; ++i) {
    if (fork() != 0) continue;
    char byte = 0;
    close(start[1]);
    close(end[1]);
    static_cast<void>(!::read(start[0], &byte, 1));  // until the parent closes its end
    const auto lock = claim_run_folder(folder, true);
    byte = lock.has_value() ? 1 : 0;
    static_cast<void>(!::write(result[1], &byte, 1));
    static_cast<void>(!::read(end[0], &byte, 1));
    _exit(0);
  }
  close(start[1]);
  int owners = 0;
  for (int i = 0; i < processes; ++i) {
    char byte = 0;
    EXPECT_EQ(::read(result[0], &byte, 1), 1);
    owners += byte;
  }
  close(end[1]);
  for (int i = 0; i < processes; ++i) wait(nullptr);
  for (const int descriptor : {start[0], result[0], result[1], end[0]}) close(descriptor);
  return owners;
}

TEST(RunFolder, HasOneOwner) {
  const TemporaryFolder folder;
  for (int i = 0; i < 100; ++i) ASSERT_EQ(owners_of(folder / ("runs/" + std::to_string(i)), 6), 1);
}

TEST(RunFolder, ALockIsNotFooledByAnotherFolderOfThatName) {
  const TemporaryFolder folder;
  const auto lock = tests::checked(claim_run_folder(folder / "run", false));
  EXPECT_TRUE(lock->is_in_place());
  EXPECT_HAS(refusal(folder / "run", true), "another polynya is writing this run");
  fs::rename(folder / "run", folder / "moved");
  EXPECT_FALSE(lock->is_in_place());
  EXPECT_EQ(refusal(folder / "run", false), "");
  EXPECT_FALSE(lock->is_in_place());
}

Checkpoint checkpoint_at(std::int64_t steps) {
  Checkpoint checkpoint;
  checkpoint.steps = steps;
  return checkpoint;
}

std::vector<std::int64_t> steps_in(const fs::path& folder) {
  std::vector<std::int64_t> steps;
  for (const fs::path& path : checkpoints_in(folder)) steps.push_back(read_checkpoint_file(path, "")->steps);
  return steps;
}

TEST(Checkpoints, AreWrittenInPartsAsTheyAreInMemory) {
  const TemporaryFolder folder;
  Checkpoint checkpoint = checkpoint_at(7);
  checkpoint.program_version = "0.1.0";
  checkpoint.progress.files = {{1, 1}, {2, 2}, {3, 3}};
  checkpoint.progress.recorded.resize(100'000);
  for (std::size_t i = 0; i < checkpoint.progress.recorded.size(); ++i)
    checkpoint.progress.recorded[i].time = static_cast<double>(i);
  checkpoint.state = std::string(1'000'000, 's');
  checkpoint.failure = "why";
  ASSERT_TRUE(write_checkpoint(folder.path(), checkpoint).has_value());
  const fs::path file = checkpoints_in(folder.path()).front();
  EXPECT_EQ(read_file(file), checkpoint_bytes(checkpoint));
  EXPECT_EQ(read_checkpoint_file(file, "")->state, checkpoint.state);
}

TEST(Checkpoints, TheOneJustWrittenIsTheNewestThatIsKept) {
  const TemporaryFolder folder;
  std::int64_t before = -1;
  for (const std::int64_t steps : {10, 20, 30, 5, 7, 100, 100, 50, 60, 2}) {
    ASSERT_TRUE(write_checkpoint(folder.path(), checkpoint_at(steps)).has_value());
    const auto kept = steps_in(folder.path());
    ASSERT_EQ(kept.front(), steps);
    EXPECT_LE(kept.size(), 2U);
    EXPECT_EQ(kept.size() == 2 && kept[1] == before, before >= 0 && before < steps) << steps;
    before = steps;
  }
}

TEST(Checkpoints, RewindingRemovesWhatIsNewerAndTakesOneFromElsewhere) {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  ASSERT_TRUE(write_checkpoint(elsewhere.path(), checkpoint_at(5)).has_value());
  for (const std::int64_t steps : {10, 20})
    ASSERT_TRUE(write_checkpoint(folder.path(), checkpoint_at(steps)).has_value());
  const fs::path ten = folder / "checkpoint-000000000010.bin";
  EXPECT_TRUE(rewind_to(folder.path(), checkpoint_at(10), ten).has_value());
  EXPECT_EQ(steps_in(folder.path()), std::vector<std::int64_t>{10});
  EXPECT_TRUE(rewind_to(folder.path(), checkpoint_at(5), elsewhere / "checkpoint-000000000005.bin").has_value());
  EXPECT_EQ(steps_in(folder.path()), std::vector<std::int64_t>{5});
}

// ---- files as they are written: whole, or with whole records, through no link that was put in their way

/// Returns whether the condition holds in a process whose files may have at most 1000 bytes, which simulates a full
/// disk.
bool on_full_disk(const std::function<bool()>& holds) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    _exit(holds() ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  return status == 0;
}

TEST(OutputFile, EndsWithAWholeRecordWhereTheDiskIsFull) {
  const TemporaryFolder folder;
  const auto path = folder / "lines.txt";
  EXPECT_TRUE(on_full_disk([&] {
    auto file = OutputFile::create(path);
    for (int i = 0; i < 100; ++i) {
      file->append("a line of 17 char\n");
      if (i % 7 == 0) file->flush();
    }
    file->flush();
    return file->status().error().find("lines.txt: File too large") != std::string::npos && !file->flush();
  }));
  const std::string text = read_file(path);
  EXPECT_EQ(text.size(), 990U);  // the most whole lines of 18 bytes in 1000
  EXPECT_EQ(text.back(), '\n');
}

TEST(OutputFile, ReplacesALinkOfARunFolderAndFollowsThoseThatAUserNamed) {
  const TemporaryFolder folder;
  write_file(folder / "target", "old");
  std::filesystem::create_symlink("target", folder / "link");
  EXPECT_TRUE(write_named_file(folder / "link", "named").has_value());
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "target"), "named");
  EXPECT_TRUE(write_whole_file(folder / "link", "whole").has_value());
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "link"), "whole");
  EXPECT_EQ(read_file(folder / "target"), "named");
  // The link may also point to a file that does not exist yet.
  write_file(folder / "elsewhere/other", "");
  std::filesystem::create_symlink("elsewhere/second", folder / "first");
  std::filesystem::create_symlink("target", folder / "elsewhere/second");
  EXPECT_TRUE(write_named_file(folder / "first", "text").has_value());
  EXPECT_EQ(read_file(folder / "elsewhere/target"), "text");
  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_FALSE(write_named_file(folder / "circle", "text").has_value());
}

TEST(OutputFile, ReplacesNoPipeNoDeviceAndNoFolderAndNeedsOne) {
  const TemporaryFolder folder;
  EXPECT_FALSE(OutputFile::create("/no/such/folder/file").has_value());
  EXPECT_FALSE(write_whole_file("/no/such/folder/file", "x").has_value());
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_HAS(write_whole_file(folder / "pipe", "x").error(), "not a regular file");
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_HAS(write_whole_file(folder.path(), "x").error(), "a folder");
  EXPECT_HAS(write_named_file("/dev/full", "x").error(), "No space left");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(OutputFile, WritesThroughNoLinkThatWasPutInItsWay) {
  const TemporaryFolder folder;
  write_file(folder / "precious", "years of work");
  for (const char* name : {"grown", "cut", "whole.part"}) std::filesystem::create_symlink("precious", folder / name);
  EXPECT_TRUE(write_whole_file(folder / "whole", "text").has_value());
  EXPECT_EQ(read_file(folder / "whole"), "text");
  auto grown = tests::checked(OutputFile::create(folder / "grown"));
  grown->append("text\n");
  EXPECT_TRUE(grown->flush() && grown->is_in_place());
  EXPECT_EQ(read_file(folder / "grown"), "text\n");
  EXPECT_HAS(tests::refused(OutputFile::reopen(folder / "cut", Checksum())), "cut: a link");
  EXPECT_EQ(read_file(folder / "precious"), "years of work");
}

/// Checks that the folder contains only that file.
void expect_alone(const TemporaryFolder& folder, const std::string& text) {
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
  EXPECT_TRUE(read_file(folder / "file") == text);
}

TEST(OutputFile, InPartsIsTheTextThatTheyMake) {
  const TemporaryFolder folder;
  std::string whole;
  const auto produce = [&](const WritePart& write) {
    for (int i = 0; i < 1000; ++i) {
      const std::string part(static_cast<std::size_t>(i), static_cast<char>('a' + i % 26));
      write(part);
      whole += part;
    }
  };
  EXPECT_TRUE(write_whole_file_in_parts(folder / "file", produce, Durability::kSynced).has_value());
  expect_alone(folder, whole);
}

TEST(OutputFile, InPartsLeavesTheOldFileAndNoOtherWhereItsTextOrTheDiskFails) {
  const TemporaryFolder folder;
  write_file(folder / "file", "old");
  const auto throws = [](const WritePart& write) {
    write("half of it");
    throw std::bad_alloc();
  };
  const auto descriptors = [] { return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}); };
  const auto before = descriptors();
  EXPECT_THROW(static_cast<void>(write_whole_file_in_parts(folder / "file", throws)), std::bad_alloc);
  EXPECT_EQ(descriptors(), before);
  expect_alone(folder, "old");
  EXPECT_TRUE(on_full_disk([&] {
    const auto written = write_whole_file_in_parts(folder / "file", [](const WritePart& write) {
      for (int i = 0; i < 100; ++i) write("a line of 17 char\n");
    });
    return !written && written.error().find("file: File too large") != std::string::npos;
  }));
  expect_alone(folder, "old");
}

TEST(OutputFile, KnowsWhetherItIsStillThere) {
  const TemporaryFolder folder;
  auto file = tests::checked(OutputFile::create(folder / "file"));
  EXPECT_TRUE(file->is_in_place());
  write_file(folder / "other", "");
  std::filesystem::rename(folder / "other", folder / "file");
  EXPECT_FALSE(file->is_in_place());
  std::filesystem::remove(folder / "file");
  EXPECT_FALSE(file->is_in_place());
}

}  // namespace
}  // namespace polynya::io
