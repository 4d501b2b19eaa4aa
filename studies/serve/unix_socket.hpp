#pragma once

/// A socket of the file system that programs of this machine connect to.

#include <atomic>
#include <filesystem>
#include <functional>
#include <iosfwd>

namespace rollres {

/// Listens at a new socket, and calls `serve(in, out)` for each program that connects, on a thread of its own, until
/// `stop` is set; then removes the socket. Programs that are still connected are cut off.
/// @throws std::runtime_error naming the path if it exists already or cannot be made, or what `serve` threw first
void serve_socket(const std::filesystem::path& path, const std::atomic<bool>& stop,
                  const std::function<void(std::istream& in, std::ostream& out)>& serve);

}  // namespace rollres
