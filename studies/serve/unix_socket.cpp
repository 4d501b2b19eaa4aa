#include "studies/serve/unix_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <istream>
#include <list>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <system_error>
#include <thread>

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
  std::atomic<bool> over = false;
  std::jthread thread;  // joined before the descriptor is closed
};

/// Removes the socket's file in the end.
struct SocketFile {
  explicit SocketFile(const std::filesystem::path& given) : path(given) {}
  ~SocketFile() { ::unlink(path.c_str()); }
  std::filesystem::path path;
};

}  // namespace

void serve_socket(const std::filesystem::path& path, const std::atomic<bool>& stop,
                  const std::function<void(std::istream& in, std::ostream& out)>& serve) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.string().size() >= sizeof address.sun_path) fail(path, ENAMETOOLONG);
  std::memcpy(address.sun_path, path.c_str(), path.string().size());
  const Descriptor listening(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (listening < 0) fail(path, errno);
  const mode_t mask = ::umask(0077);  // for its owner alone
  const int bound = ::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int error = errno;
  ::umask(mask);
  if (bound != 0) fail(path, error);
  const SocketFile file(path);
  if (::listen(listening, SOMAXCONN) != 0) fail(path, errno);

  std::signal(SIGPIPE, SIG_IGN);  // a program that is gone is the end of its output, and no more
  std::mutex mutex;
  std::exception_ptr first_error;
  std::atomic<bool> failed = false;
  std::list<Connection> connections;
  while (!stop && !failed) {
    connections.remove_if([](const Connection& connection) { return connection.over.load(); });
    pollfd asked{listening, POLLIN, 0};
    if (::poll(&asked, 1, 100) <= 0) continue;
    const int number = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
    if (number < 0) continue;
    Connection& connection = connections.emplace_back(number);
    connection.thread = std::jthread([&, number] {
      try {
        DescriptorBuffer buffer(number, failed);
        std::istream in(&buffer);
        std::ostream out(&buffer);
        serve(in, out);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!first_error) first_error = std::current_exception();
        failed = true;
      }
      ::shutdown(number, SHUT_RDWR);
      connection.over = true;
    });
  }
  for (Connection& connection : connections) ::shutdown(connection.descriptor, SHUT_RDWR);
  connections.clear();
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace rollres
