#include "studies/run/ended_points.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace rollres {

/// Where a thread says, to other processes too, which point it solves.
struct PointSlot {
  std::atomic<bool> taken;
  char key[127];
};

namespace {

constexpr std::array fatal_signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

std::array<char, 4096> notes_file{};  // a signal handler may not allocate
std::array<struct sigaction, fatal_signals.size()> handlers_before{};
thread_local const std::string* point_in_work = nullptr;

std::filesystem::path notes_beside(const std::filesystem::path& database) { return database.string() + ".ended"; }

constexpr std::size_t slot_count = 1024;  // no more jobs than that
PointSlot* slots = nullptr;               // null: nobody waits for the end by the system

// What follows until `watch` calls only what may be called in a signal handler, and in a child of a process with
// threads (signal-safety(7)).

void note(const char* key, int signal) {
  const int file = ::open(notes_file.data(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file < 0) return;
  const std::size_t length = std::strlen(key);
  const char number[] = {' ', static_cast<char>('0' + signal / 10), static_cast<char>('0' + signal % 10), '\n'};
  if (::write(file, key, length) < 0 || ::write(file, number, sizeof number) < 0) ::unlink(notes_file.data());
  ::close(file);
}

void note_and_end(int signal) {
  if (point_in_work && notes_file[0] != '\0') note(point_in_work->c_str(), signal);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

/// How many processes the system has ended for want of memory; negative if it does not say.
long ended_for_memory(const char* counters) {
  std::array<char, 32768> text{};
  const int file = ::open(counters, O_RDONLY | O_CLOEXEC);
  if (file < 0) return -1;
  for (std::size_t size = 0; size + 1 < text.size();) {
    const ssize_t got = ::read(file, text.data() + size, text.size() - 1 - size);
    if (got <= 0) break;
    size += static_cast<std::size_t>(got);
  }
  ::close(file);
  constexpr char name[] = "oom_kill ";
  const char* line = text.data();
  while (line && std::strncmp(line, name, sizeof name - 1) != 0)
    if ((line = std::strchr(line, '\n'))) ++line;
  return line ? std::atol(line + sizeof name - 1) : -1;
}

/// Waits for the end of the process that solves; notes what it has in work then if the system ended one for want of
/// memory.
[[noreturn]] void watch(pid_t parent, const char* counters, long ended_before) {
  sigset_t all, end;
  ::sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGUSR1);
  ::close_range(0, ~0U, 0);
  ::sigemptyset(&end);
  ::sigaddset(&end, SIGUSR1);
  for (int signal = 0; ::getppid() == parent && signal != SIGUSR1;) ::sigwait(&end, &signal);
  if (ended_for_memory(counters) > ended_before)
    for (std::size_t slot = 0; slot < slot_count; ++slot)
      if (slots[slot].taken) note(slots[slot].key, SIGKILL);
  ::_exit(0);
}

}  // namespace

FatalSignalNotes::FatalSignalNotes(const std::filesystem::path& database, const std::filesystem::path& counters) {
  const std::string file = std::filesystem::absolute(notes_beside(database)).string();
  if (file.size() >= notes_file.size()) return;
  std::memcpy(notes_file.data(), file.c_str(), file.size() + 1);
  struct sigaction action {};
  action.sa_handler = note_and_end;
  action.sa_flags = SA_ONSTACK;
  for (std::size_t i = 0; i < fatal_signals.size(); ++i) ::sigaction(fatal_signals[i], &action, &handlers_before[i]);

  const long ended_before = ended_for_memory(counters.c_str());
  if (ended_before < 0) return;
  void* const shared =
      ::mmap(nullptr, slot_count * sizeof(PointSlot), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return;
  slots = static_cast<PointSlot*>(shared);
  const pid_t parent = ::getpid();
  watcher_ = ::fork();
  if (watcher_ == 0) watch(parent, counters.c_str(), ended_before);
}

FatalSignalNotes::~FatalSignalNotes() {
  if (watcher_ > 0) {
    ::kill(watcher_, SIGKILL);
    ::waitpid(watcher_, nullptr, 0);
  }
  if (slots) ::munmap(slots, slot_count * sizeof(PointSlot));
  slots = nullptr;
  if (notes_file[0] == '\0') return;
  for (std::size_t i = 0; i < fatal_signals.size(); ++i) ::sigaction(fatal_signals[i], &handlers_before[i], nullptr);
  notes_file[0] = '\0';
}

PointInWork::PointInWork(const std::string& key) : slot_(nullptr) {
  // The handler needs one where the thread's own stack has overflown.
  thread_local std::array<char, 16384> spare;
  const stack_t stack{.ss_sp = spare.data(), .ss_flags = 0, .ss_size = spare.size()};
  ::sigaltstack(&stack, &stack_before_);
  point_in_work = &key;
  if (!slots || key.size() >= sizeof slots->key) return;
  for (slot_ = slots; slot_->taken.exchange(true);)
    if (++slot_ == slots + slot_count) {
      slot_ = nullptr;
      return;
    }
  std::memcpy(slot_->key, key.c_str(), key.size() + 1);
}
PointInWork::~PointInWork() {
  point_in_work = nullptr;
  ::sigaltstack(&stack_before_, nullptr);
  if (slot_) slot_->taken = false;
}

std::vector<EndedPoint> ended_points(const std::filesystem::path& database) {
  std::vector<EndedPoint> points;
  std::error_code none;
  const auto kind = std::filesystem::symlink_status(notes_beside(database), none).type();
  if (kind == std::filesystem::file_type::not_found) return points;
  if (kind != std::filesystem::file_type::regular)  // a pipe would be waited for
    throw std::runtime_error(notes_beside(database).string() + ": not a regular file");
  std::ifstream notes(notes_beside(database));
  for (EndedPoint point; notes >> point.key >> point.signal;) points.push_back(point);
  return points;
}

void keep_ended_points(const std::filesystem::path& database, const std::vector<EndedPoint>& points) {
  std::error_code ignored;
  if (points.empty()) {
    std::filesystem::remove(notes_beside(database), ignored);
    return;
  }
  std::ofstream notes(notes_beside(database));
  for (const EndedPoint& point : points) notes << point.key << ' ' << point.signal << '\n';
}

}  // namespace rollres
