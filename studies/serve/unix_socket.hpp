#pragma once

/// A socket of the file system that programs of this machine connect to.

#include <atomic>
#include <filesystem>
#include <functional>
#include <iosfwd>

namespace rollres {

/// Serves one program. @param gone  set when it has gone, or is to be left   @throws std::system_error if there is no
/// thread to be had, which ends this program's connection only
using ServeStream = std::function<void(std::istream& in, std::ostream& out, const std::atomic<bool>& gone)>;

/// Listens at a new socket, and calls `serve` for each program that connects, on a thread of its own, until `stop` is
/// set; then removes the socket. Programs that are still connected are cut off. A file of a socket at which nobody
/// listens is replaced. At most 64 programs are served at a time; one for which no thread or file descriptor is left is
/// told so and cut off.
/// @throws std::runtime_error naming the path if it exists already or cannot be made, or what `serve` threw first
void serve_socket(const std::filesystem::path& path, const std::atomic<bool>& stop, const ServeStream& serve);

}  // namespace rollres
