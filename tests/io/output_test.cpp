#include <algorithm>
#include <csignal>
#include <functional>
#include <new>

#include "expect_text.hpp"
#include "temporary_folder.hpp"
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "io/text/output_file.hpp"

namespace polynya::io {
namespace {

using tests::read_file;
using tests::TemporaryFolder;
using tests::write_file;

/// Whether it holds in a process whose files may have 1000 bytes, which stands for a full disk.
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

TEST(OutputFile, TellsAFileItCannotMake) {
  EXPECT_FALSE(OutputFile::create("/no/such/folder/file").has_value());
  EXPECT_FALSE(write_whole_file("/no/such/folder/file", "x").has_value());
}

TEST(OutputFile, ReplacesALinkOfARunFolderAndFollowsOneThatAUserNamed) {
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
}

TEST(OutputFile, FollowsLinksToAFileThatIsNotThereYet) {
  const TemporaryFolder folder;
  write_file(folder / "elsewhere/other", "");
  std::filesystem::create_symlink("elsewhere/second", folder / "first");
  std::filesystem::create_symlink("target", folder / "elsewhere/second");
  EXPECT_TRUE(write_named_file(folder / "first", "text").has_value());
  EXPECT_EQ(read_file(folder / "elsewhere/target"), "text");
  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_FALSE(write_named_file(folder / "circle", "text").has_value());
}

TEST(OutputFile, ReplacesNoPipeNoDeviceAndNoFolder) {
  const TemporaryFolder folder;
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
  const auto cut = OutputFile::reopen(folder / "cut", 0);
  ASSERT_FALSE(cut.has_value());
  EXPECT_HAS(cut.error(), "cut: a link");
  EXPECT_EQ(read_file(folder / "precious"), "years of work");
}

std::vector<std::string> names_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
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
  EXPECT_EQ(read_file(folder / "file"), whole);
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"file"});
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
  EXPECT_EQ(read_file(folder / "file"), "old");
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"file"});

  EXPECT_TRUE(on_full_disk([&] {
    const auto written = write_whole_file_in_parts(folder / "file", [](const WritePart& write) {
      for (int i = 0; i < 100; ++i) write("a line of 17 char\n");
    });
    return !written && written.error().find("file: File too large") != std::string::npos;
  }));
  EXPECT_EQ(read_file(folder / "file"), "old");
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"file"});
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
