#pragma once

/// What `rollres explore` answers to its page: a request in, a reply out, without a network. A request whose path does
/// not begin with the token, or that comes from a page of another host, is refused before anything of it is read.

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/solve/rolling_contact.hpp"
#include "studies/explore/http_server.hpp"
#include "studies/explore/study_runs.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/serve/scene_service.hpp"

namespace rollres {

struct ExplorerOptions {
  std::string scene = {};          ///< a file; empty: the paper's cylinder
  std::filesystem::path database;  ///< may be missing; made by the first study that runs
  std::filesystem::path folder;    ///< files are read below it, studies written into it
  const std::atomic<bool>& stop;   ///< set from outside: what is solved ends
};

class Explorer {
 public:
  /// @throws as read_scene, of the scene
  Explorer(const ExplorerOptions& options, Evaluate evaluate);

  /// 32 letters that nobody can guess; the page stands at /TOKEN/.
  const std::string& token() const { return token_; }
  /// From now on requests must have been sent to this port.
  void be_at(int port) { port_ = port; }
  /// May be called by many threads.
  HttpReply operator()(const HttpRequest& request);

  /// What every reply says to the browser: nothing is loaded from elsewhere, nothing kept, no other page frames it.
  static std::map<std::string, std::string> headers();

 private:
  /// The newest wish of a page for one view; older ones end when it comes.
  using Newest = std::shared_ptr<std::atomic<std::int64_t>>;

  HttpReply reply_to(const HttpRequest& request, const std::string& what);
  /// Nothing where no such request is.
  std::optional<Json> posted(const std::string& what, const Json& asked);
  std::function<bool()> newer_than(const Json& wish);
  Json answered(const Json& asked);
  void forget_old_answers();

  std::filesystem::path database_, folder_;
  const std::atomic<bool>& stop_;
  std::string token_;
  std::atomic<int> port_ = 0;
  ReadScene read_;
  Json first_scene_, first_held_;  // as it is written, and in SI
  Evaluate evaluate_;
  StoredEvaluations curves_;  // answers without fields, kept while the page may ask for them again
  StudyRuns runs_;
  std::mutex mutex_;           // of what follows
  std::size_t forgotten_ = 0;  // answers of curves
  std::map<std::string, Newest> newest_;
};

}  // namespace rollres
