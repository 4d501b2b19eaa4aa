#include "studies/explore/study_runs.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include "db/rows/result_store.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/study/study.hpp"
#include "studies/text/files.hpp"

extern char** environ;

namespace rollres {

namespace {

constexpr std::size_t longest_words = 100'000;  // of what a run prints

/// Studies of a page have their scene in them, and axes of inputs: neither names a file.
void refuse_files(const Json& study) {
  constexpr std::array<std::string_view, 7> known{"study",   "comment",     "scene", "axes",
                                                  "compute", "constraints", "charts"};
  refuse_unknown_keys(study, known, "study");
  const Json& axes = needed(study, "axes", "study", "must be an object of inputs");
  if (!axes.is_object()) refuse("study", "axes", axes, "must be an object of inputs");
  for (const auto& [key, values] : axes.items())
    if (!find_number(key) && !find_input(key)) refuse("study", "axes." + key, values, "must be an input of a scene");
}

std::string text_if_any(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::exists(file, none) ? whole_file(file, largest_json) : "";
}

/// How far a study is; nothing while its process has not recorded it yet.
std::optional<StudySummary> summary_if_any(const std::filesystem::path& database, const std::string& study) {
  try {
    return ResultStore(database, Access::read).study(study);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// Starts this program with other words; what it prints goes into a file.
pid_t started(const std::vector<std::string>& words, const std::filesystem::path& output) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t process = 0;
  const int error = ::posix_spawn(&process, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::system_error(error, std::generic_category(), "a process for the study");
  return process;
}

}  // namespace

StudyRuns::StudyRuns(std::filesystem::path folder, std::filesystem::path database)
    : folder_(std::move(folder)), database_(std::move(database)) {}

StudyRuns::~StudyRuns() {
  for (auto& [name, run] : runs_)
    if (run.process != 0) ::kill(run.process, SIGINT);
  for (auto& [name, run] : runs_)
    if (run.process != 0) ::waitpid(run.process, nullptr, 0);
}

void StudyRuns::look(Run& run) {
  int status = 0;
  if (run.process == 0 || ::waitpid(run.process, &status, WNOHANG) != run.process) return;
  run.process = 0;
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Json StudyRuns::start(const Json& study) {
  refuse_files(study);
  const std::string name = needed_name(study, "study", "study", "must be a name");
  if (name.find('/') != std::string::npos || name.starts_with('.') || name.size() > 100)
    refuse("study", "study", name, "must be a name of at most 100 letters without / and no . before it");
  const std::lock_guard lock(mutex_);
  if (const auto before = runs_.find(name); before != runs_.end()) {
    look(before->second);
    if (before->second.process != 0) throw std::invalid_argument(name + ": runs already");
  }
  Run run{.file = folder_ / (name + ".json"), .words = scratch_ / std::to_string(runs_.size())};
  const std::string text = study.dump(2) + '\n', before = text_if_any(run.file);
  if (!before.empty() && before != text)
    throw std::invalid_argument(run.file.string() + ": holds another study; give this one another name");
  if (before.empty()) write_file(run.file, text);
  try {
    StudyPlan(read_study(run.file));
  } catch (...) {
    std::error_code none;
    if (before.empty()) std::filesystem::remove(run.file, none);
    throw;
  }
  run.process = started({"rollres", "sweep", run.file.string(), "--db", database_.string()}, run.words);
  runs_[name] = run;
  return {{"study", name}, {"file", run.file.string()}};
}

void StudyRuns::stop(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto run = runs_.find(name);
  if (run == runs_.end()) throw std::invalid_argument(name + ": was not started here");
  look(run->second);
  if (run->second.process != 0) ::kill(run->second.process, SIGINT);
}

Json StudyRuns::state() {
  const std::lock_guard lock(mutex_);
  Json list = Json::array();
  for (auto& [name, run] : runs_) {
    look(run);
    list.push_back(
        {{"study", name}, {"file", run.file.string()}, {"running", run.process != 0}, {"status", run.status}});
    if (run.process == 0)
      list.back()["words"] = whole_file(run.words, longest_words);
    else if (const auto study = summary_if_any(database_, name))
      list.back().update({{"answered", study->answered}, {"points", study->points}});
  }
  return list;
}

}  // namespace rollres
