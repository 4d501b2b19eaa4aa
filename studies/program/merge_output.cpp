#include "studies/program/merge_output.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

MergeOutput::MergeOutput(Session& session, std::string database, bool json)
    : session_(session), database_(std::move(database)), json_(json) {}

void MergeOutput::add(const std::string& source, const std::function<MergeReport()>& work) {
  Merged& merged = merged_.emplace_back(Merged{source, {}, {}});
  try {
    merged.report = work();
    if (!merged.report.conflicts.empty()) session_.status = std::max(session_.status, ExitStatus::no_answer);
  } catch (const std::runtime_error& error) {
    merged.failure = error.what();
    session_.err << "rollres: " << merged.failure << '\n';
    session_.status = ExitStatus::failure;
  }
}

void MergeOutput::print() {
  if (json_)
    print_json();
  else
    print_lines();
}

void MergeOutput::print_json() const {
  Json object{{"db", database_}, {"sources", Json::array()}};
  for (const Merged& merged : merged_) {
    Json& entry = object["sources"].emplace_back(Json{{"source", merged.source}});
    if (!merged.failure.empty()) {
      entry["failure"] = merged.failure;
      continue;
    }
    const MergeReport& report = merged.report;
    entry.update({{"evaluations", report.evaluations}, {"added", report.added}, {"replaced", report.replaced}});
    entry.update({{"studies", report.studies}, {"conflicts", Json::array()}});
    for (const MergeConflict& conflict : merged.report.conflicts)
      entry["conflicts"].push_back(
          {{"key", conflict.key}, {"column", conflict.column}, {"kept", conflict.kept}, {"other", conflict.other}});
  }
  session_.out << text_of(object, 2) << '\n';
}

void MergeOutput::print_lines() const {
  MergeReport sum;
  std::size_t failed = 0;
  constexpr std::size_t shown = 10;
  for (const auto& [source, report, failure] : merged_) {
    failed += !failure.empty();
    sum.evaluations += report.evaluations;
    sum.added += report.added;
    sum.replaced += report.replaced;
    sum.studies += report.studies;
    for (const MergeConflict& conflict : report.conflicts) {
      sum.conflicts.push_back(conflict);
      if (sum.conflicts.size() <= shown)
        session_.err << source << ": evaluation " << conflict.key << ": " << conflict.column << " = "
                     << shortest(conflict.other) << ", but " << shortest(conflict.kept) << " is kept\n";
    }
  }
  if (sum.conflicts.size() > shown) session_.err << "and " << sum.conflicts.size() - shown << " other conflicts\n";
  session_.out << database_ << ": " << sum.evaluations << " evaluations in " << merged_.size() - failed << " of "
               << merged_.size() << " databases: " << sum.added << " new, " << sum.replaced << " replaced, "
               << sum.evaluations - sum.added - sum.replaced - sum.conflicts.size() << " there already, "
               << sum.conflicts.size() << " in conflict\n";
}

}  // namespace rollres
