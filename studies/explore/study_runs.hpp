#pragma once

/// Studies that run beside a page: each as a child process `rollres sweep FILE --db DATABASE`, so that what it solves
/// is what the command line solves, and stopping it costs nothing that is stored. For sources only: it needs
/// nlohmann_json.

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "db/file/temporary_folder.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

class StudyRuns {
 public:
  /// @param folder  of the study files that are written
  StudyRuns(std::filesystem::path folder, std::filesystem::path database);
  /// Stops all and waits for them.
  ~StudyRuns();
  StudyRuns(const StudyRuns&) = delete;
  StudyRuns& operator=(const StudyRuns&) = delete;

  /// Writes FOLDER/NAME.json and sweeps it; a study that was stopped goes on. @return its name and file
  /// @throws std::invalid_argument as read_study, or naming a file of another content, or that the study runs already
  Json start(const Json& study);
  /// The first wish to stop of Ctrl-C: points in work are finished. Of no effect on one that has ended.
  void stop(const std::string& name);
  /// Of all that were started: name, file, whether it runs and, while it does, its points and those answered, or how it
  /// ended and what it printed.
  Json state();

 private:
  struct Run {
    std::filesystem::path file, words;  // of the study; of what it prints
    pid_t process = 0;                  // 0: it has ended
    int status = 0;
  };
  void look(Run& run);

  std::filesystem::path folder_, database_;
  TemporaryFolder scratch_;
  std::mutex mutex_;
  std::map<std::string, Run> runs_;
};

}  // namespace rollres
