#include "studies/run/ended_points.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>

namespace rollres {

namespace {

constexpr std::array fatal_signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

std::array<char, 4096> notes_file{};  // a signal handler may not allocate
std::array<struct sigaction, fatal_signals.size()> handlers_before{};
thread_local const std::string* point_in_work = nullptr;

std::filesystem::path notes_beside(const std::filesystem::path& database) { return database.string() + ".ended"; }

/// Calls only what may be called in a signal handler (signal-safety(7)).
void note_and_end(int signal) {
  if (point_in_work && notes_file[0] != '\0') {
    const int file = ::open(notes_file.data(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file >= 0) {
      const char number[] = {' ', static_cast<char>('0' + signal / 10), static_cast<char>('0' + signal % 10), '\n'};
      if (::write(file, point_in_work->data(), point_in_work->size()) < 0 || ::write(file, number, sizeof number) < 0)
        ::unlink(notes_file.data());
      ::close(file);
    }
  }
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

FatalSignalNotes::FatalSignalNotes(const std::filesystem::path& database) {
  const std::string file = std::filesystem::absolute(notes_beside(database)).string();
  if (file.size() >= notes_file.size()) return;
  std::memcpy(notes_file.data(), file.c_str(), file.size() + 1);
  struct sigaction action {};
  action.sa_handler = note_and_end;
  action.sa_flags = SA_ONSTACK;
  for (std::size_t i = 0; i < fatal_signals.size(); ++i) ::sigaction(fatal_signals[i], &action, &handlers_before[i]);
}

FatalSignalNotes::~FatalSignalNotes() {
  if (notes_file[0] == '\0') return;
  for (std::size_t i = 0; i < fatal_signals.size(); ++i) ::sigaction(fatal_signals[i], &handlers_before[i], nullptr);
  notes_file[0] = '\0';
}

PointInWork::PointInWork(const std::string& key) {
  // The handler needs one where the thread's own stack has overflown.
  thread_local std::array<char, 16384> spare;
  const stack_t stack{.ss_sp = spare.data(), .ss_flags = 0, .ss_size = spare.size()};
  ::sigaltstack(&stack, nullptr);
  point_in_work = &key;
}
PointInWork::~PointInWork() { point_in_work = nullptr; }

std::vector<EndedPoint> ended_points(const std::filesystem::path& database) {
  std::vector<EndedPoint> points;
  std::ifstream notes(notes_beside(database));
  for (EndedPoint point; notes >> point.key >> point.signal;) points.push_back(point);
  return points;
}

void forget_ended_points(const std::filesystem::path& database) {
  std::error_code ignored;
  std::filesystem::remove(notes_beside(database), ignored);
}

}  // namespace rollres
