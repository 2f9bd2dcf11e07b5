// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/folder_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <random>
#include <regex>
#include <sstream>
#include <utility>

#include "run/errors.h"

namespace {

bool answers_are_lost = false;
std::function<void()> while_it_waits;

}  // namespace

// In place of the system's: a link over a network of which the answer may be lost, and which is then asked for once more.
extern "C" int link(const char* from, const char* to) noexcept {
  const int result = linkat(AT_FDCWD, from, AT_FDCWD, to, 0);
  return result == 0 && answers_are_lost ? linkat(AT_FDCWD, from, AT_FDCWD, to, 0) : result;
}

// In place of the system's, through which a lock waits before it looks again: what others do meanwhile.
extern "C" int nanosleep(const timespec* duration, timespec* left) {
  if (while_it_waits) std::exchange(while_it_waits, nullptr)();
  return static_cast<int>(syscall(SYS_nanosleep, duration, left));
}

namespace vesiflow::run::folder_lock_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A process of its own that ends with what `body` returns.
pid_t start(const std::function<int()>& body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  return child;
}

int code_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class FolderLockTest : public testing::Test {
 protected:
  FolderLockTest()
      : folder_(fs::temp_directory_path() / ("vesiflow_lock_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~FolderLockTest() override { fs::remove_all(folder_); }

  fs::path lock() const { return folder_ / "run.lock"; }

  // What the lock says of an owner is changed: each line is all of it, as in "pid = 7".
  void rewrite(std::initializer_list<std::string> lines) const {
    std::string text = text_ + "\n";
    for (const std::string& line : lines)
      text =
          std::regex_replace(text, std::regex("(^|\n)" + line.substr(0, line.find(" = ")) + " = [^\n]*"), "$1" + line);
    std::ofstream(lock()) << text;
  }
  // The lock of a process that is alive (this one), as a file only.
  void leave_lock() {
    {
      const FolderLock held(folder_);
      text_ = text_of(lock());
    }
    std::ofstream(lock()) << text_;
    text_.pop_back();
  }
  std::string refusal() const {
    try {
      const FolderLock held(folder_);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
  std::string text_;
};

TEST_F(FolderLockTest, IsThereAsLongAsItIsHeld) {
  {
    const FolderLock held(folder_ / "deep" / "run");
    EXPECT_TRUE(fs::exists(folder_ / "deep" / "run" / "run.lock"));
    EXPECT_NO_THROW(held.require_held());
    EXPECT_FALSE(held.taken_from());
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "deep" / "run"));
}

TEST_F(FolderLockTest, RefusalNamesFolderProcessAndWhatToDo) {
  const FolderLock held(folder_);
  const std::string text = text_of(lock()), message = refusal();
  for (const std::string& part : {folder_.string() + ": in use by another run: process " + std::to_string(getpid()),
                                  std::string("since "), "kill " + std::to_string(getpid()), std::string("--out")})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(text_of(lock()), text);
}

TEST_F(FolderLockTest, OneOfManyProcessesThatStartAtOnceGetsIt) {
  for (const bool stale : {false, true}) {
    leave_lock();
    if (stale)
      rewrite({"process_start = 1"});
    else
      fs::remove(lock());
    int go[2], done[2];
    ASSERT_EQ(pipe(go), 0);
    ASSERT_EQ(pipe(done), 0);
    for (int i = 0; i < 24; ++i)
      start([&] {
        char byte = 0;
        close(go[1]);
        (void)!read(go[0], &byte, 1);  // until all are there
        try {
          const FolderLock held(folder_);
          close(done[1]);
          (void)!read(done[0], &byte, 1);  // until all have tried
          return text_of(lock()).find("pid = " + std::to_string(getpid()) + "\n") == std::string::npos ? 2 : 0;
        } catch (const FileError&) {
          return 1;
        }
      });
    close(go[0]);
    close(go[1]);
    int winners = 0, losers = 0, status = 0;
    // Who has it ends when the others have. A minute is for machines that do much else; were there two winners, it would be waited for.
    for (int tries = 0; losers < 23 && tries < 60000; ++tries) {
      if (waitpid(-1, &status, WNOHANG) > 0)
        losers += WIFEXITED(status) && WEXITSTATUS(status) == 1;
      else
        usleep(1000);
    }
    close(done[1]);
    while (wait(&status) > 0) winners += WIFEXITED(status) && WEXITSTATUS(status) == 0;
    close(done[0]);
    EXPECT_EQ(winners, 1) << "stale: " << stale;
    EXPECT_EQ(losers, 23) << "stale: " << stale;
    EXPECT_TRUE(fs::is_empty(folder_)) << "stale: " << stale;
  }
}

TEST_F(FolderLockTest, OfAProcessThatWasKilledIsTakenOver) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = start([&] {
    const FolderLock held(folder_);
    (void)!write(ready[1], "x", 1);
    pause();
    return 0;
  });
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_NE(refusal().find("process " + std::to_string(child)), std::string::npos);
  kill(child, SIGKILL);
  while (text_of("/proc/" + std::to_string(child) + "/stat").find(") Z") == std::string::npos) usleep(1000);
  EXPECT_EQ(refusal(), "");  // though its parent has not waited for it
  EXPECT_EQ(code_of(child), 128 + SIGKILL);
  EXPECT_TRUE(fs::is_empty(folder_));
}

/// Also in the middle of taking over what another has left.
TEST_F(FolderLockTest, KilledAtAnyMomentLeavesNothingInTheWay) {
  const fs::path memory = "/dev/shm/vesiflow_lock_" + std::to_string(getpid());
  const fs::path folder = fs::exists("/dev/shm") ? memory : folder_;  // where locks are made fast
  leave_lock();
  rewrite({"process_start = 1"});
  fs::create_directories(folder);
  fs::copy_file(lock(), folder / "stale");
  std::minstd_rand chance(1);
  for (int kills = 0; kills < 100; ++kills) {
    const pid_t child = start([&] {
      while (true) {
        const FolderLock held(folder);
        fs::copy_file(folder / "stale", folder / "next", fs::copy_options::overwrite_existing);
        fs::rename(folder / "next", folder / "run.lock");
      }
      return 0;
    });
    usleep(static_cast<useconds_t>(500 + chance() % 3000));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    ASSERT_NO_THROW(FolderLock{folder}) << "after " << kills << " kills";
  }
  fs::remove_all(folder);
}

TEST_F(FolderLockTest, KnowsANumberThatIsUsedAgainAndAMachineThatWasStartedAnew) {
  leave_lock();
  EXPECT_NE(refusal(), "");
  const auto expect_taken_over = [&] {
    const FolderLock held(folder_);
    ASSERT_TRUE(held.taken_from()) << text_of(lock());
    EXPECT_NE(held.taken_from()->find("process "), std::string::npos);
  };
  for (const char* line : {"process_start = 1", "pid = 4194303"}) {
    rewrite({line});
    expect_taken_over();
  }
  if (text_of("/etc/machine-id").empty()) return;
  rewrite({"boot = 00000000-0000-0000-0000-000000000000", "since = 2001-01-01 00:00:00 UTC"});
  expect_taken_over();
}

/// Copies of an image of a machine share its name and its identity. What began after this one was started is not of this one.
TEST_F(FolderLockTest, DoesNotTakeACopyOfThisMachineForAnEarlierStartOfIt) {
  leave_lock();
  rewrite({"boot = 00000000-0000-0000-0000-000000000000"});
  const std::string message = refusal();
  EXPECT_NE(message.find("cannot be looked up from here"), std::string::npos) << message;
}

TEST_F(FolderLockTest, IsMadeThoughTheAnswerIsLost) {
  answers_are_lost = true;
  const std::string message = refusal();
  answers_are_lost = false;
  EXPECT_EQ(message, "");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(FolderLockTest, IsRefusedWhereItIsALinkToNothing) {
  fs::create_symlink("/nonexistent/lock", lock());
  EXPECT_NE(refusal().find("remove the file"), std::string::npos) << refusal();
  fs::remove(lock());
  leave_lock();
  rewrite({"process_start = 1"});
  fs::create_symlink("/nonexistent/lock", folder_ / "run.lock.takeover");
  EXPECT_NE(refusal().find("run.lock.takeover"), std::string::npos) << refusal();
}

TEST_F(FolderLockTest, IsHeldThoughItCannotBeReadForAMoment) {
  const FolderLock held(folder_);
  fs::copy_file(lock(), folder_ / "kept");
  std::ofstream(lock(), std::ios::trunc).flush();
  while_it_waits = [&] { fs::rename(folder_ / "kept", lock()); };
  EXPECT_NO_THROW(held.require_held());
  EXPECT_FALSE(while_it_waits) << "the lock has not waited";
  std::ofstream(lock(), std::ios::trunc).flush();
  EXPECT_THROW(held.require_held(), FileError);
}

TEST_F(FolderLockTest, DoesNotJudgeOtherMachinesAndWhatItCannotRead) {
  leave_lock();
  for (const char* line : {"host = elsewhere", "machine = another", "numbering = pid:[1]"}) {
    rewrite({line});
    const std::string message = refusal();
    EXPECT_NE(message.find("if that run is no more, remove " + lock().string()), std::string::npos) << message;
    EXPECT_TRUE(fs::exists(lock()));
  }
  for (const char* text : {"", "host = vm\nmach"}) {
    std::ofstream(lock()) << text;
    const std::string message = refusal();
    EXPECT_NE(message.find("remove the file"), std::string::npos) << message;
  }
}

TEST_F(FolderLockTest, NoticesThatTheFolderHasAnotherOwnerOrIsGone) {
  const FolderLock held(folder_);
  const std::string own = text_of(lock());
  fs::remove(lock());
  held.require_held();  // by mistake, and nobody has taken the folder
  EXPECT_EQ(text_of(lock()), own);
  std::ofstream(lock()) << std::regex_replace(own, std::regex("process_start = "), "process_start = 1");
  EXPECT_THROW(held.require_held(), FileError);
  fs::remove_all(folder_);
  EXPECT_THROW(held.require_held(), FileError);
}

TEST_F(FolderLockTest, LeavesNothingWhereTheDiskIsFull) {
  const int code = code_of(start([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_FSIZE, &none);
    return refusal().find("File too large") == std::string::npos ? 1 : 0;
  }));
  EXPECT_EQ(code, 0);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(FolderLockTest, StaysWithItsFolderWhereverTheProcessGoes) {
  const fs::path before = fs::current_path();
  fs::create_directories(folder_ / "real");
  fs::create_directory_symlink("real", folder_ / "link");
  fs::current_path(folder_);
  {
    const FolderLock held("link");
    fs::current_path("/");
    EXPECT_EQ(held.folder(), fs::canonical(folder_ / "real"));
    EXPECT_THROW(FolderLock(folder_ / "real"), FileError);
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "real"));
  fs::current_path(before);
}

}  // namespace
}  // namespace vesiflow::run::folder_lock_test
