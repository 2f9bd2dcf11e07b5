// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/folder_lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>

#include "files/atomic_file.h"
#include "files/descriptor.h"
#include "files/text_of.h"
#include "run/errors.h"
#include "system_message.h"

namespace vesiflow::run {
namespace {

// What is tried again, because others do the same at that moment or because a file cannot be read just then.
constexpr int most_tries = 20;

void wait_a_little() {
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

// A link to nothing is there too. What the system cannot tell counts as being there.
bool is_there(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::symlink_status(file, error).type() != std::filesystem::file_type::not_found;
}

std::string line_of(const char* file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

// State and start (in ticks since the machine was started) of a process; empty where /proc does not show it.
struct Process {
  std::string state, start;
};

Process process_of(long pid) {
  const std::string text = text_of(fmt::format("/proc/{}/stat", pid));
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));  // a name may have any characters
  std::array<std::string, 20> field;
  for (std::string& f : field) fields >> f;
  return {field.front(), field.back()};
}

// As a lock says it; such texts can be compared.
std::string text_of_time(std::time_t time) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(time));
}

// When this machine was started; empty where /proc does not show it.
std::string boot_time() {
  std::ifstream lines("/proc/stat");
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("btime ")) return text_of_time(std::atol(line.c_str() + 6));
  return {};
}

// What a lock says. A process is known by all of these: hosts share names, processes in containers numbers, and numbers are used
// again.
struct Owner {
  std::string host, machine, boot, numbering, pid, process_start, since;

  static Owner here();
  static std::optional<Owner> parse(const std::string& text);
  std::string text() const;
  std::string who() const { return fmt::format("process {} on {}, since {}", pid, host, since); }
};

template <class O, class Visit>
void visit_fields(O& owner, const Visit& visit) {
  visit("host", owner.host);
  visit("machine", owner.machine);
  visit("boot", owner.boot);
  visit("numbering", owner.numbering);
  visit("pid", owner.pid);
  visit("process_start", owner.process_start);
  visit("since", owner.since);
}

Owner Owner::here() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  std::error_code none;
  return {host.data(),
          line_of("/etc/machine-id"),
          line_of("/proc/sys/kernel/random/boot_id"),
          std::filesystem::read_symlink("/proc/self/ns/pid", none).string(),
          std::to_string(getpid()),
          process_of(getpid()).start,
          text_of_time(std::time(nullptr))};
}

std::string Owner::text() const {
  std::string text;
  visit_fields(*this,
               [&](const char* name, const std::string& value) { text += fmt::format("{} = {}\n", name, value); });
  return text;
}

// Nothing if it is not complete.
std::optional<Owner> Owner::parse(const std::string& text) {
  Owner owner;
  std::istringstream lines(text);
  bool complete = text.ends_with('\n');
  visit_fields(owner, [&](const std::string& name, std::string& value) {
    std::string line;
    std::getline(lines, line);
    complete = complete && line.starts_with(name + " = ");
    if (complete) value = line.substr(name.size() + 3);
  });
  return complete ? std::optional(owner) : std::nullopt;
}

enum class Fate { runs, is_gone, is_unknown };

Fate fate_of(const Owner& owner) {
  const Owner here = Owner::here();
  if (owner.host != here.host || owner.machine != here.machine) return Fate::is_unknown;
  // Another start may be another machine: of that name, without an identity, or with the same one where both are copies of an image.
  // What began after this machine was started is certainly not of an earlier start of it.
  if (owner.boot != here.boot)
    return here.machine.empty() || owner.since >= boot_time() ? Fate::is_unknown : Fate::is_gone;
  if (owner.numbering != here.numbering) return Fate::is_unknown;
  const long pid = std::atol(owner.pid.c_str());
  if (pid <= 0) return Fate::is_unknown;
  if (kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH) return Fate::is_gone;
  const Process process = process_of(pid);
  const bool ended = process.state == "Z" || process.state == "X";
  const bool another = !process.start.empty() && process.start != owner.process_start;
  return ended || another ? Fate::is_gone : Fate::runs;
}

FileError cannot_be_written(const std::filesystem::path& folder, const std::string& reason) {
  return FileError(fmt::format("{}: results cannot be written there: {}; choose another folder with --out",
                               folder.string(), reason));
}

bool write_whole(const Descriptor& descriptor, const std::string& text) {
  return descriptor.valid() && write_all(descriptor, text) && fsync(descriptor) == 0;
}

// Where a file system has no hard links.
bool create_at_its_place(const std::filesystem::path& file, const std::string& text) {
  const Descriptor descriptor(open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (!descriptor.valid() && errno == EEXIST) return false;
  if (write_whole(descriptor, text)) return true;
  const std::string reason = system_message();
  if (descriptor.valid()) unlink(file.c_str());
  throw cannot_be_written(file.parent_path(), reason);
}

// Over a network the answer to a link that was made may be lost, and the question asked again: the second answer is that it is there.
bool is_linked(const Descriptor& descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && status.st_nlink == 2;
}

// Whether the file was made, with that text; false if it is there already. It is written under another name and linked: whatever
// moment a kill comes at, the file is whole or not there.
bool create(const std::filesystem::path& file, const std::string& text) {
  std::string temporary = temporary_of(file.string() + ".XXXXXX").string();
  const auto ending = static_cast<int>(temporary_of("").string().size());
  const Descriptor descriptor(mkostemps(temporary.data(), ending, O_CLOEXEC));
  const bool written = write_whole(descriptor, text);
  const bool answered = written && fchmod(descriptor, 0644) == 0 && link(temporary.c_str(), file.c_str()) == 0;
  const int error = errno;
  const bool linked = answered || (written && is_linked(descriptor));
  if (descriptor.valid()) unlink(temporary.c_str());
  if (linked) return true;
  if (!written) throw cannot_be_written(file.parent_path(), system_message(error));
  // ENOENT: who has the folder has removed the temporary file.
  if (error == EEXIST || error == ENOENT) return false;
  return create_at_its_place(file, text);
}

void refuse(const std::filesystem::path& file, const std::optional<Owner>& owner, Fate fate) {
  const std::string folder = file.parent_path().string();
  if (!owner)
    throw FileError(fmt::format(
        "{}: another run is just starting in this folder, or was killed as it did; if there is none, remove the file",
        file.string()));
  if (fate == Fate::runs)
    throw FileError(fmt::format(
        "{}: in use by another run: {}; wait for its end, or stop it (kill {}), or choose another folder with --out",
        folder, owner->who(), owner->pid));
  throw FileError(
      fmt::format("{}: in use by another run: {}, which cannot be looked up from here (on {}); if that run is no more, "
                  "remove {}",
                  folder, owner->who(), Owner::here().host, file.string()));
}

// Removes the lock of a process that is gone, and no other. Several may try at once, of which a slow one could remove what a
// fast one has put in its place: so only who holds a second file may. Of that one too a killed process may leave what is stale; that
// two then meet who remove it at once is left to FolderLock::require_held.
void remove_stale(const std::filesystem::path& file, const std::string& text, const std::string& own) {
  const std::filesystem::path turn = file.string() + ".takeover";
  if (create(turn, own)) {
    if (text_of(file) == text) unlink(file.c_str());
  } else {
    const std::string found = text_of(turn);
    if (found.empty() && !is_there(turn)) return;
    const std::optional<Owner> owner = Owner::parse(found);
    const Fate fate = owner ? fate_of(*owner) : Fate::is_unknown;
    if (fate != Fate::is_gone) refuse(turn, owner, fate);
  }
  unlink(turn.c_str());
}

FileError comes_and_goes(const std::filesystem::path& file) {
  return FileError(fmt::format(
      "{}: could not be made in {} tries: others make and remove it; try again, or choose another folder with --out",
      file.string(), most_tries));
}

std::filesystem::path made(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw cannot_be_written(folder, error.message());
  return std::filesystem::canonical(folder);
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(made(folder)), file_(folder_ / name), text_(Owner::here().text()) {
  for (int tries = 1; !create(file_, text_); ++tries) {
    if (tries > most_tries) throw comes_and_goes(file_);
    const std::string found = text_of(file_);
    if (found.empty() && !is_there(file_)) {  // its owner has just ended
      wait_a_little();
      continue;
    }
    const std::optional<Owner> owner = Owner::parse(found);
    const Fate fate = owner ? fate_of(*owner) : Fate::is_unknown;
    if (fate != Fate::is_gone) refuse(file_, owner, fate);
    remove_stale(file_, found, text_);
    taken_from_ = owner->who();
  }
}

FolderLock::~FolderLock() {
  if (text_of(file_) == text_) unlink(file_.c_str());
}

void FolderLock::require_held() const {
  for (int tries = 1; tries <= most_tries; ++tries) {
    const std::string found = text_of(file_);
    if (found == text_ || (!is_there(file_) && create(file_, text_))) return;
    if (const auto owner = Owner::parse(found)) refuse(file_, owner, Fate::runs);
    wait_a_little();  // too many open files, a file server that is away
  }
  throw FileError(fmt::format(
      "{}: cannot be read: the folder may be another run's by now; if it is not, restart when the file can be read",
      file_.string()));
}

}  // namespace vesiflow::run
