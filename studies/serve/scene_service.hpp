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
#include <deque>
#include <functional>
#include <future>
#include <iosfwd>
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

/// Each line is a whole scene.
RollingScene read_whole_scene(const Json& object, const std::string& place);

/// Each line replaces inputs of this scene file.
/// @throws as read_scene
ReadScene replacing_inputs_of(const std::string& file);

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
  /// threads may serve a stream each.
  /// @throws std::runtime_error if the store failed
  void serve(std::istream& in, std::ostream& out);

  /// Set when the store failed: whoever waits for a line may stop.
  const std::atomic<bool>& failed() const { return failed_; }

 private:
  using Answer = std::packaged_task<std::string()>;

  std::string answer(std::size_t line, const std::string& text);
  std::future<std::string> ask(std::size_t line, std::string text);
  void work();

  StoredEvaluations& evaluations_;
  ReadScene read_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Answer> waiting_;
  bool ending_ = false;
  std::atomic<bool> failed_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace rollres
