#pragma once

/// What `rollres merge` and `rollres import` tell.

#include <functional>
#include <string>
#include <vector>

#include "db/merge/merge.hpp"
#include "studies/program/commands.hpp"

namespace rollres {

class MergeOutput {
 public:
  MergeOutput(Session& session, std::string database, bool json);

  /// Does one merge and takes note of what came of it; a source that fails is a message and exit status 3.
  void add(const std::string& source, const std::function<MergeReport()>& work);
  /// One line for each conflict, and one for all; or JSON.
  void print();

 private:
  struct Merged {
    std::string source;
    MergeReport report;
    std::string failure;
  };

  void print_json() const;
  void print_lines() const;

  Session& session_;
  std::string database_;
  bool json_;
  std::vector<Merged> merged_;
};

}  // namespace rollres
