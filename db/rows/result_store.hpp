#pragma once

/// Results that are kept: each scene that was solved once, with its answer, and the studies that ask for it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "db/file/database.hpp"
#include "db/file/provenance.hpp"

namespace rollres {

/// What makes two evaluations the same: all inputs, numbers rounded to 12 significant digits (so that 0.1 + 0.2 is
/// 0.3), and the solver; the method is the one that solves the scene, named or not. An input at its default value is
/// left out, so that a scene keeps its key when inputs are added. Limits of time and memory count: what one of them cut
/// short is no answer to a scene without it.
/// @param solver  Provenance::solver
/// @return digest of 32 hexadecimal digits
std::string evaluation_key(const RollingScene& scene, std::string_view solver = this_program().solver);

/// A scene and its answer. The fields of the solution are kept if it has any.
struct Evaluation {
  std::string key;
  RollingScene scene;
  RollingSolution solution;
};

/// What becomes of an answer that is stored already when there is another one with its key.
enum class Existing {
  kept,
  replaced  ///< in place, under its id; but an answer that converged gives way only to one that converged
};

/// What is known of an answer without reading it.
struct StoredAnswer {
  Status status = Status::not_converged;
  std::string created;  ///< UTC
  bool has_fields = false;

  bool operator==(const StoredAnswer&) const = default;
};

/// An evaluation as it was found, without its fields.
struct StoredEvaluation : Evaluation {
  std::int64_t id = 0;  ///< in this file
  std::string created;  ///< UTC, "2013-05-01T12:00:00.000Z"
  Provenance provenance;
  std::vector<std::string> studies;  ///< that have it as a point
};

/// What is kept of a study besides its points.
struct StudyRecord {
  std::string name;
  std::vector<std::string> axes;  ///< keys of inputs
  std::string definition;         ///< text of the study file
};

/// What a design of an optimisation is worth.
struct DesignRecord {
  std::vector<std::string> keys;        ///< of its evaluations, points of the study: the first one's row tells the rest
  double goal = 0;                      ///< [SI]
  std::optional<double> second_goal{};  ///< [SI] of a front
  bool feasible = false;                ///< all constraints hold
  std::optional<std::int64_t> front{};  ///< its place on the front, from 1
};

/// What a study asks for.
struct StudyOutline {
  std::string name;
  std::vector<std::string> axes;
  std::int64_t points = 0;
};

/// How far a study is.
struct StudySummary : StudyOutline {
  std::int64_t answered = 0;  ///< points with a row, failed ones included
  std::int64_t failed = 0;    ///< answered, but not with status converged
  std::string created;        ///< when the study first ran, UTC
  std::string started;        ///< when it last was started, UTC
  std::string last_result;    ///< when its newest row was stored, UTC; empty if there is none
  std::string note = {};      ///< what people wrote on it
};

/// Points of a study that have no answer for the same reason.
struct Failure {
  std::string status, reason;
  std::int64_t points = 0;
};

/// An open database of results, used by one thread at a time.
/// Every function throws std::runtime_error naming the file if the database fails.
class ResultStore {
 public:
  /// Opens or creates; see Database.
  explicit ResultStore(const std::filesystem::path& file, Access access = Access::write);
  ResultStore(ResultStore&&) noexcept;
  ~ResultStore();

  /// Stores evaluations in one transaction: when it returns they are on the disk, if it throws all is as it was.
  /// Fields go with their answer; a kept answer of the same status that has none gets them.
  /// @return how many changed what is stored
  std::size_t save(std::span<const Evaluation> evaluations, Existing existing = Existing::kept);

  std::optional<SurfaceFields> find_fields(const std::string& key);

  bool contains(const std::string& key) { return find_answer(key).has_value(); }
  std::optional<StoredAnswer> find_answer(const std::string& key);
  std::optional<StoredEvaluation> find(const std::string& key);
  /// The solution alone, without its fields: quicker.
  std::optional<RollingSolution> solution(const std::string& key);
  std::optional<StoredEvaluation> find(std::int64_t id);

  /// Records that a study starts (again) with these points, in this order, in place of those it had.
  /// @param variants  of the points, one for each; empty: they have none
  /// @return the number of its row
  std::int64_t start_study(const StudyRecord& study, std::span<const std::string> keys,
                           std::span<const std::string> variants = {});
  /// @throws std::runtime_error saying what another process did to a study that was started: it deleted or renamed it,
  /// or took points of these away
  void require_study(std::int64_t id, const std::string& name, std::span<const std::string> keys);

  /// Makes `keys` the next points of a study that has been started, but for those that are its points already.
  void add_points(const std::string& study, std::span<const std::string> keys,
                  std::span<const std::string> variants = {});
  /// Writes what designs are worth beside their points; the first of two designs of one point tells it.
  void set_designs(const std::string& study, std::span<const DesignRecord> designs);
  /// Keys of a study's points, in order; empty if there is no such study.
  std::vector<std::string> points(const std::string& study);
  std::vector<std::string> variants(const std::string& study);  ///< of these; empty texts where they have none

  std::vector<StudySummary> studies();  ///< by name
  std::optional<StudySummary> study(const std::string& name);
  std::optional<StudyOutline> outline(const std::string& name);  ///< without reading an answer
  std::vector<std::string> study_names();                        ///< in their order
  /// Text of the study file; nothing if there is no such study.
  std::optional<std::string> definition(const std::string& study);
  std::vector<Failure> failures(const std::string& study);  ///< most frequent first

  const Database& database() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rollres
