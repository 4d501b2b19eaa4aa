#include "studies/serve/unix_socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <istream>
#include <list>
#include <mutex>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

#include "studies/serve/descriptor_buffer.hpp"

namespace rollres {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw std::runtime_error(path.string() + ": cannot be listened at: " + std::generic_category().message(error));
}

/// A file descriptor that is closed with it.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

struct Connection {
  explicit Connection(int number) : descriptor(number) {}
  Descriptor descriptor;
  std::atomic<bool> over = false, gone = false;  // served; nobody is at the other end
  std::jthread thread;                           // joined before the descriptor is closed
};

constexpr std::size_t most_connections = 64;

/// Tells a program why it is not served. One that does not read is not waited for.
void turn_away(int connection, const std::string& why) {
  const std::string line = "{\"error\":\"" + why + "\"}\n";
  if (::send(connection, line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL) < 0) {
  }  // it has gone
}

/// A descriptor in reserve: where there is no other, a program that connects is cut off with it, and does not knock on.
class SpareDescriptor {
 public:
  void cut_off(int listening) {
    spare_.reset();
    const Descriptor connection(::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC));
    if (connection >= 0) turn_away(connection, "the server has no file descriptor left");
  }
  void renew() {
    if (!spare_ || *spare_ < 0) spare_.emplace(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  }

 private:
  std::optional<Descriptor> spare_;
};

/// Removes the socket's file in the end.
struct SocketFile {
  explicit SocketFile(const std::filesystem::path& given) : path(given) {}
  ~SocketFile() { ::unlink(path.c_str()); }
  std::filesystem::path path;
};

/// Whether a socket's file is there at which nobody listens: what a server left behind that was killed.
bool is_dead(const std::filesystem::path& path, const sockaddr_un& address) {
  std::error_code none;
  if (std::filesystem::symlink_status(path, none).type() != std::filesystem::file_type::socket) return false;
  const Descriptor trial(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  return trial >= 0 && ::connect(trial, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
         errno == ECONNREFUSED;
}

/// Binds, for the owner alone. @return the error, or 0
int bind_at(int listening, const sockaddr_un& address) {
  const mode_t mask = ::umask(0077);
  const int bound = ::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int error = bound == 0 ? 0 : errno;
  ::umask(mask);
  return error;
}

/// Listens, and keeps what is connected.
class Server {
 public:
  Server(int listening, const ServeStream& serve) : listening_(listening), serve_(serve) {}

  void run(const std::atomic<bool>& stop) {
    while (!stop && !failed_) {
      connections_.remove_if([](const Connection& connection) { return connection.over.load(); });
      spare_.renew();
      if (wait()) accept();
    }
    for (Connection& connection : connections_) {
      connection.gone = true;
      ::shutdown(connection.descriptor, SHUT_RDWR);
    }
    connections_.clear();
    if (first_error_) std::rethrow_exception(first_error_);
  }

 private:
  /// Waits 0.1 s, or until a program connects, and marks those that have gone. @return whether one connects
  bool wait() {
    std::vector<pollfd> asked{{listening_, POLLIN, 0}};
    for (const Connection& connection : connections_)  // a negative number is not asked
      asked.push_back({connection.gone ? -1 : static_cast<int>(connection.descriptor), 0, 0});
    constexpr int milliseconds = 100;
    if (::poll(asked.data(), asked.size(), milliseconds) <= 0) return false;
    std::size_t place = 1;
    for (Connection& connection : connections_)
      if (asked[place++].revents & (POLLHUP | POLLERR)) connection.gone = true;
    return (asked.front().revents & POLLIN) != 0;
  }

  void accept() {
    const int number = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
    if (number < 0) {
      if (errno == EMFILE || errno == ENFILE)
        spare_.cut_off(listening_);
      else if (errno != EINTR && errno != ECONNABORTED)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      return;
    }
    Connection& connection = connections_.emplace_back(number);
    if (connections_.size() > most_connections) {
      turn_away(number, std::to_string(most_connections) + " programs are connected already");
      connection.over = true;
      return;
    }
    try {
      connection.thread = std::jthread([this, &connection] { serve(connection); });
    } catch (const std::system_error&) {
      turn_away(number, no_thread);
      connection.over = true;
    }
  }

  void serve(Connection& connection) {
    const int number = connection.descriptor;
    try {
      DescriptorBuffer buffer(number, connection.gone);
      std::istream in(&buffer);
      std::ostream out(&buffer);
      serve_(in, out, connection.gone);
    } catch (const std::system_error&) {
      turn_away(number, no_thread);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_error_) first_error_ = std::current_exception();
      failed_ = true;
    }
    ::shutdown(number, SHUT_RDWR);
    connection.over = true;
  }

  static constexpr const char* no_thread = "the server has no thread left";

  int listening_;
  const ServeStream& serve_;
  std::mutex mutex_;
  std::exception_ptr first_error_;
  std::atomic<bool> failed_ = false;
  SpareDescriptor spare_;
  std::list<Connection> connections_;
};

}  // namespace

void serve_socket(const std::filesystem::path& path, const std::atomic<bool>& stop, const ServeStream& serve) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.string().size() >= sizeof address.sun_path) fail(path, ENAMETOOLONG);
  std::memcpy(address.sun_path, path.c_str(), path.string().size());
  const Descriptor listening(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (listening < 0) fail(path, errno);
  int error = bind_at(listening, address);
  if (error == EADDRINUSE && is_dead(path, address) && ::unlink(path.c_str()) == 0) error = bind_at(listening, address);
  if (error != 0) fail(path, error);
  const SocketFile file(path);
  if (::listen(listening, SOMAXCONN) != 0) fail(path, errno);
  std::signal(SIGPIPE, SIG_IGN);  // a program that is gone is the end of its output, and no more
  Server(listening, serve).run(stop);
}

}  // namespace rollres
