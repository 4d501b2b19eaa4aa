#include "db/file/temporary_folder.hpp"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace rollres {

namespace {

/// The path of a folder where a signal handler finds it. One that finds no place here stays behind.
struct Noted {
  std::atomic<bool> taken = false, whole = false;
  std::array<char, 1024> path;
};
std::array<Noted, 16> noted;

void note(const std::string& path) {
  for (Noted& place : noted)
    if (path.size() < place.path.size() && !place.taken.exchange(true)) {
      std::memcpy(place.path.data(), path.c_str(), path.size() + 1);
      place.whole = true;
      return;
    }
}

void forget(const std::string& path) {
  for (Noted& place : noted)
    if (place.whole && path == place.path.data()) {
      place.whole = false;
      place.taken = false;
      return;
    }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  const char* const given = std::getenv("TMPDIR");
  const std::filesystem::path parent = given && *given ? given : "/tmp";
  std::string name = (parent / "rollres_XXXXXX").string();
  // A signal between the folder's making and its note would leave it behind.
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  const bool made = ::mkdtemp(name.data());
  const int error = errno;
  if (made) note(name);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (!made) {
    const std::string why = std::generic_category().message(error);
    throw std::runtime_error((given && *given ? "TMPDIR = " : "") + parent.string() +
                             ": no folder for temporary files can be made there: " + why);
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  forget(path_.string());
}

void remove_temporary_folders() noexcept {
  for (Noted& place : noted) {
    if (!place.whole) continue;
    // Other threads may still put files into it.
    constexpr int most_attempts = 50;
    int status = 1;
    for (int attempt = 0; attempt < most_attempts && status != 0; ++attempt) {
      const pid_t child = ::_Fork();
      if (child == 0) {
        ::execl("/bin/rm", "rm", "-rf", "--", place.path.data(), static_cast<char*>(nullptr));
        ::_exit(127);
      }
      if (child < 0 || ::waitpid(child, &status, 0) < 0) break;
    }
  }
}

}  // namespace rollres
