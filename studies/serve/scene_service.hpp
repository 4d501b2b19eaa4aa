#pragma once

/// Scenes as lines of JSON, answered in their order: a solver that other programs keep running, on a pipe or a socket.
///
///     {"id": 1, "speed": "50 mm/s", "load": 20000, ...}   ->
///     {"id":1,"rolling_resistance":313.2,...,"status":"converged"}
///     {"id": 2, "speed": -1, ...}                         ->  {"id":2,"line":2,"error":"line 2: speed = -1: must be >
///     0"}
///
/// A line has the keys of a scene file and `id`, which comes back with the answer; without one it is the number of the
/// line. Where the service has a scene of its own, a line replaces inputs of it as `--set` does. Blank lines count, but
/// have no answer. A line that cannot be read is an error and ends nothing. For sources only: it needs nlohmann_json.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <future>
#include <iosfwd>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/scene/scene.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// The scene of a line, which is an object of inputs. @throws std::invalid_argument naming `place`
using ReadScene = std::function<RollingScene(const Json& object, const std::string& place)>;

/// Each line is a whole scene. It may name files (master_curve_file, ...) that are below `files`, links followed; none
/// if that is empty.
/// @throws std::invalid_argument if there is no such folder
ReadScene whole_scenes(const std::filesystem::path& files = {});

/// Each line replaces inputs of this scene file.
/// @throws as read_scene
ReadScene replacing_inputs_of(const std::string& file);

/// Clients are served in turn: a thread that is free takes a line of the client whose turn is longest ago, and a client
/// none of whose lines is worked on while all threads are taken solves the next one on its own thread.
class SceneService {
 public:
  /// @param evaluations  must outlive the service; its memory of answers is forgotten as they are handed out
  /// @param jobs         threads that solve; 0: one for each core
  SceneService(StoredEvaluations& evaluations, ReadScene read, int jobs);
  /// Ends the threads.
  ~SceneService();
  SceneService(const SceneService&) = delete;
  SceneService& operator=(const SceneService&) = delete;

  /// Answers the lines of `in` until it ends, or until `out` takes no more. What is written is stored before. Several
  /// threads may serve a stream each. Lines that are read ahead are bounded in number, and all clients' in bytes.
  /// @param gone  set when nobody waits for answers any more: what is solved for this client ends, its lines are
  /// dropped
  /// @throws std::runtime_error if the store failed
  void serve(std::istream& in, std::ostream& out, const std::atomic<bool>& gone = nobody_leaves);

  /// Set when the store failed: whoever waits for a line may stop.
  const std::atomic<bool>& failed() const { return failed_; }

 private:
  using Answer = std::packaged_task<std::string()>;
  struct Client;

  std::string answer(std::size_t line, const std::string& text);
  bool ask(Client& client, std::size_t line, std::string text);
  void read_ahead(Client& client, std::istream& in);
  bool write_next(Client& client, std::ostream& out);
  void take(const std::shared_ptr<Client>& client, std::unique_lock<std::mutex>& lock);
  void work();

  static const std::atomic<bool> nobody_leaves;

  StoredEvaluations& evaluations_;
  ReadScene read_;
  int cores_each_ = 1;
  std::mutex mutex_;                            // of what follows, and of the clients
  std::condition_variable asked_, written_;     // a line waits; there is room for lines
  std::list<std::shared_ptr<Client>> clients_;  // whose turn is next first
  std::size_t idle_ = 0;                        // threads
  std::size_t bytes_ = 0;                       // of lines that are not answered yet
  bool ending_ = false;
  std::atomic<bool> failed_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace rollres
