#include "studies/run/forked_work.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/numerics/cores.hpp"
#include "core/numerics/threads.hpp"

namespace rollres {

namespace {

using Clock = std::chrono::steady_clock;

bool send_all(int socket, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, void* data, std::size_t size) {
  char* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = recv(socket, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

/// The life of a child: a piece in, an answer out, until the socket is shut.
/// What the work throws ends the child: nothing may unwind into its parent's code.
[[noreturn]] void serve(int socket, pid_t parent, const std::function<std::string(std::size_t)>& work) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
  std::signal(SIGINT, SIG_IGN);  // the parent decides when to stop
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  limit_threads(1);  // of the parent's threads only this one was copied
  std::uint64_t piece = 0;
  while (receive_all(socket, &piece, sizeof piece)) {
    std::string answer;
    try {
      answer = work(static_cast<std::size_t>(piece));
    } catch (...) {
      std::abort();
    }
    const std::uint64_t size = answer.size();
    if (!send_all(socket, &size, sizeof size) || !send_all(socket, answer.data(), answer.size())) break;
  }
  _exit(0);
}

std::string describe_death(int state) {
  if (WIFEXITED(state)) return "the process ended with exit status " + std::to_string(WEXITSTATUS(state));
  const int signal = WTERMSIG(state);
  const char* const name = sigdescr_np(signal);
  return "the process was ended by signal " + std::to_string(signal) + (name ? " (" + std::string(name) + ")" : "");
}

/// One child process and the piece it has in hand.
class Child {
 public:
  explicit Child(const std::function<std::string(std::size_t)>& work) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::runtime_error(std::string("no socket for a child process: ") + std::strerror(errno));
    const pid_t parent = getpid();
    id_ = fork();
    if (id_ == 0) serve(ends[1], parent, work);
    const int error = errno;
    close(ends[1]);
    socket_ = ends[0];
    if (id_ > 0) return;
    close(socket_);
    throw std::runtime_error(std::string("no child process can be started: ") + std::strerror(error));
  }
  ~Child() {
    if (id_ > 0) end(true);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int socket() const { return socket_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  /// A child that died while idle is found out when its answer is read.
  void give(std::size_t piece) {
    piece_ = piece;
    begin_ = Clock::now();
    const std::uint64_t number = piece;
    send_all(socket_, &number, sizeof number);
  }

  /// Waits for the answer; if the child died, it is gone afterwards.
  PieceEnd take() {
    PieceEnd result{.piece = piece_};
    std::uint64_t size = 0;
    bool lives = receive_all(socket_, &size, sizeof size);
    if (lives) {
      result.answer.resize(size);
      lives = receive_all(socket_, result.answer.data(), size);
    }
    result.seconds = seconds();
    if (!lives) {
      result.answer.clear();
      result.death = describe_death(end(false));
    }
    return result;
  }

  PieceEnd cut_short() {
    PieceEnd result{.piece = piece_, .out_of_time = true, .seconds = seconds()};
    result.death = describe_death(end(true));
    return result;
  }

  bool gone() const { return id_ == 0; }

 private:
  /// Closes the socket and collects the child; returns its wait status.
  int end(bool kill_it) {
    if (kill_it) kill(id_, SIGKILL);
    close(socket_);
    int state = 0;
    while (waitpid(id_, &state, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return state;
  }

  pid_t id_ = 0;
  int socket_ = -1;
  std::size_t piece_ = 0;
  Clock::time_point begin_;
};

std::vector<pollfd> sockets_of(const std::vector<std::unique_ptr<Child>>& children) {
  std::vector<pollfd> sockets;
  for (const auto& child : children) sockets.push_back({child->socket(), POLLIN, 0});
  return sockets;
}

}  // namespace

void run_forked(const ForkedWork& work) {
  const auto wanted = static_cast<std::size_t>(work.jobs > 0 ? work.jobs : usable_cores());
  std::size_t next = 0;
  std::vector<std::unique_ptr<Child>> children;  // each has a piece in hand
  const auto begin = Clock::now();
  auto last_report = begin;
  SweepProgress progress{.to_solve = work.pieces, .left = work.pieces};
  while (!(work.stop && *work.stop)) {
    while (next < work.pieces && children.size() < wanted) {
      children.push_back(std::make_unique<Child>(work.work));
      children.back()->give(next++);
    }
    if (children.empty()) break;
    std::vector<pollfd> sockets = sockets_of(children);
    if (poll(sockets.data(), sockets.size(), 100) < 0 && errno != EINTR)
      throw std::runtime_error(std::string("child processes cannot be heard: ") + std::strerror(errno));
    for (std::size_t i = children.size(); i-- > 0;) {
      Child& child = *children[i];
      PieceEnd end;
      if (sockets[i].revents != 0)
        end = child.take();
      else if (child.seconds() > work.time_limit)
        end = child.cut_short();
      else
        continue;
      if (!child.gone() && next < work.pieces)
        child.give(next++);
      else
        children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
      if (!work.done(end)) ++progress.failed;
      ++progress.solved;
      --progress.left;
    }
    if (work.report && Clock::now() - last_report > std::chrono::milliseconds(100)) {
      last_report = Clock::now();
      progress.seconds = std::chrono::duration<double>(last_report - begin).count();
      work.report(progress);
    }
  }
}

}  // namespace rollres
