#include "db/rows/result_store.hpp"

#include <algorithm>
#include <unordered_set>

#include "core/messages/message_text.hpp"
#include "db/file/sqlite.hpp"
#include "db/rows/evaluation_row.hpp"
#include "db/rows/fields_table.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

namespace {

constexpr const char* now = "strftime('%Y-%m-%dT%H:%M:%fZ', 'now')";

std::string insert_evaluation(Existing existing) {
  std::string names = "INSERT INTO evaluation(key, created, provenance";
  std::string values = std::string(") VALUES (?, ") + now + ", ?";
  std::string changes = "created = excluded.created, provenance = excluded.provenance";
  for (const Column& column : quantity_columns()) {
    names += ", " + column.name;
    values += ", ?";
    changes += ", " + column.name + " = excluded." + column.name;
  }
  const std::string conflict =
      existing == Existing::kept
          ? "NOTHING"
          : "UPDATE SET " + changes + " WHERE excluded.status = 'converged' OR evaluation.status IS NOT 'converged'";
  return names + values + ") ON CONFLICT(key) DO " + conflict;
}

/// Keys have no spaces.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::int64_t provenance_id(SQLite::Database& connection, const Provenance& program) {
  for (const char* query :
       {"INSERT OR IGNORE INTO provenance(version, git_hash, solver, compiler, machine) VALUES (?, ?, ?, ?, ?)",
        "SELECT id FROM provenance WHERE version = ? AND git_hash = ? AND solver = ? AND compiler = ? AND machine = "
        "?"}) {
    SQLite::Statement statement =
        bound(connection, query, program.version, program.git_hash, program.solver, program.compiler, program.machine);
    if (statement.executeStep()) return statement.getColumn(0).getInt64();
  }
  throw std::runtime_error("provenance could not be stored");
}

/// The first column of all rows.
std::vector<std::string> texts_of(SQLite::Statement& row) {
  std::vector<std::string> texts;
  while (row.executeStep()) texts.push_back(row.getColumn(0).getString());
  return texts;
}

StudyOutline read_outline(SQLite::Statement& row) {
  return {row.getColumn(0).getString(), split(row.getColumn(1).getString()), row.getColumn(2).getInt64()};
}

StudySummary read_summary(SQLite::Statement& row) {
  return {read_outline(row),
          row.getColumn(3).getInt64(),
          row.getColumn(4).getInt64(),
          row.getColumn(5).getString(),
          row.getColumn(6).getString(),
          row.getColumn(7).getString(),
          row.getColumn(8).getString()};
}

}  // namespace

struct ResultStore::Parts {
  Database database;
  std::string found_columns = {};
  std::optional<SQLite::Statement> insert = {}, replace = {}, answer = {}, recalled = {};

  SQLite::Database& connection() { return database.connection(); }

  std::optional<StoredEvaluation> find(const std::string& condition, const auto& value) {
    if (found_columns.empty()) found_columns = select_list(connection());
    SQLite::Statement row =
        bound(connection(),
              "SELECT evaluation.id, key, created, version, git_hash, solver, compiler, machine, " + found_columns +
                  " FROM evaluation JOIN provenance ON provenance.id = provenance WHERE " + condition,
              value);
    if (!row.executeStep()) return std::nullopt;
    StoredEvaluation found;
    found.id = row.getColumn(0).getInt64();
    found.key = row.getColumn(1).getString();
    found.created = row.getColumn(2).getString();
    found.provenance = {row.getColumn(3).getString(), row.getColumn(4).getString(), row.getColumn(5).getString(),
                        row.getColumn(6).getString(), row.getColumn(7).getString()};
    SceneAndSolution both = row_of(row, found.id, 8);
    found.scene = std::move(both.scene);
    found.solution = std::move(both.solution);
    SQLite::Statement study = bound(connection(),
                                    "SELECT DISTINCT name FROM study_point JOIN study ON study.id = study "
                                    "WHERE key = ? ORDER BY name",
                                    found.key);
    found.studies = texts_of(study);
    return found;
  }

  std::optional<RollingSolution> recall(const std::string& key) {
    if (!recalled)
      recalled.emplace(connection(),
                       "SELECT evaluation.id, " + select_list(connection()) + " FROM evaluation WHERE key = ?");
    recalled->tryReset();
    recalled->bind(1, key);
    std::optional<RollingSolution> found;
    if (recalled->executeStep()) found = row_of(*recalled, recalled->getColumn(0).getInt64(), 1).solution;
    recalled->reset();  // ends the reading, so that the log can be taken over into the file
    return found;
  }

  /// read_row, which names the evaluation where it fails.
  SceneAndSolution row_of(SQLite::Statement& row, std::int64_t id, int first) {
    try {
      return read_row(row, first);
    } catch (const SQLite::Exception&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(database.name() + ": evaluation " + std::to_string(id) + ": " + error.what());
    }
  }

  bool has_points(std::int64_t study, std::span<const std::string> keys, std::span<const std::string> variants) {
    SQLite::Statement row = bound(
        connection(), "SELECT key, coalesce(variant, '') FROM study_point WHERE study = ? ORDER BY position", study);
    std::size_t same = 0;
    for (; row.executeStep(); ++same) {
      if (same == keys.size() || keys[same] != row.getColumn(0).getText()) return false;
      if ((variants.empty() ? "" : variants[same]) != row.getColumn(1).getString()) return false;
    }
    return same == keys.size();
  }

  /// What stands under `column` for the points of a study, in their order.
  std::vector<std::string> of_points(const std::string& study, const std::string& column) {
    SQLite::Statement row = bound(connection(),
                                  "SELECT " + column +
                                      " FROM study_point WHERE study = (SELECT id FROM study "
                                      "WHERE name = ?) ORDER BY position",
                                  study);
    return texts_of(row);
  }

  std::vector<StudySummary> summaries(const std::string* name) {
    const LargeCache cache(connection());
    const std::vector<Column> present = columns_of(connection(), "study");  // an older file is read as it is
    const std::string note = present.back().name == "note" ? "note" : "''";
    SQLite::Statement row(connection(), std::string("SELECT name, axes, count(study_point.key), count(evaluation.id), "
                                                    "count(evaluation.id) FILTER (WHERE status IS NOT 'converged'), "
                                                    "study.created, started, coalesce(max(evaluation.created), ''), " +
                                                    note +
                                                    " FROM study LEFT JOIN study_point ON study_point.study = study.id "
                                                    "LEFT JOIN evaluation ON evaluation.key = study_point.key ") +
                                            (name ? "WHERE name = ? " : "") + "GROUP BY study.id ORDER BY name");
    if (name) row.bind(1, *name);
    std::vector<StudySummary> all;
    while (row.executeStep()) all.push_back(read_summary(row));
    return all;
  }
};

ResultStore::ResultStore(const std::filesystem::path& file, Access access)
    : parts_(std::make_unique<Parts>(Parts{open_database(file, access)})) {}

ResultStore::ResultStore(ResultStore&&) noexcept = default;
ResultStore::~ResultStore() = default;

const Database& ResultStore::database() const { return parts_->database; }

std::size_t ResultStore::save(std::span<const Evaluation> evaluations, Existing existing) {
  database().require_present();
  return naming(database().name(), [&] {
    SQLite::Database& connection = parts_->connection();
    SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
    const std::int64_t program = provenance_id(connection, this_program());
    auto& prepared = existing == Existing::kept ? parts_->insert : parts_->replace;
    if (!prepared) prepared.emplace(connection, insert_evaluation(existing));
    SQLite::Statement& insert = *prepared;
    std::size_t changed = 0;
    for (const Evaluation& evaluation : evaluations) {
      insert.tryReset();  // whatever became of the one before
      SQLite::bind(insert, evaluation.key, program);
      bind_row(insert, 3, evaluation.scene, evaluation.solution);
      const bool is_new = insert.exec() > 0;
      bool fields_are_new = false;
      if (evaluation.solution.fields.grid.size() == 0) {
        if (is_new && existing == Existing::replaced) remove_fields(connection, evaluation.key);
      } else if (is_new) {
        put_fields(connection, evaluation.key, evaluation.solution.fields);
      } else {
        fields_are_new = add_fields(connection, evaluation);
      }
      changed += is_new || fields_are_new ? 1 : 0;
    }
    insert.reset();
    transaction.commit();
    return changed;
  });
}

std::optional<SurfaceFields> ResultStore::find_fields(const std::string& key) {
  const auto stored = naming(database().name(), [&] { return find_packed_fields(parts_->connection(), key); });
  if (!stored) return std::nullopt;
  try {
    return unpacked_fields(stored->format, stored->bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(database().name() + ": " + key + ": " + error.what());
  }
}

std::optional<StoredAnswer> ResultStore::find_answer(const std::string& key) {
  return naming(database().name(), [&]() -> std::optional<StoredAnswer> {
    if (!parts_->answer)
      parts_->answer.emplace(
          parts_->connection(),
          "SELECT status, created, " +
              std::string(has_fields_table(parts_->connection()) ? "EXISTS (SELECT 1 FROM fields WHERE fields.key "
                                                                   "= evaluation.key)"
                                                                 : "0") +
              " FROM evaluation WHERE key = ?");
    SQLite::Statement& row = *parts_->answer;
    row.tryReset();
    row.bind(1, key);
    std::optional<StoredAnswer> found;
    if (row.executeStep()) {
      const int status = find_name(ChoiceNames<Status>::names, row.getColumn(0).getString());
      found = {status < 0 ? Status::not_converged : static_cast<Status>(status), row.getColumn(1).getString(),
               row.getColumn(2).getInt() != 0};
    }
    row.reset();  // ends the reading, so that the log can be taken over into the file
    return found;
  });
}

std::optional<StoredEvaluation> ResultStore::find(const std::string& key) {
  return naming(database().name(), [&] { return parts_->find("key = ?", key); });
}

std::optional<RollingSolution> ResultStore::solution(const std::string& key) {
  return naming(database().name(), [&] { return parts_->recall(key); });
}

std::optional<StoredEvaluation> ResultStore::find(std::int64_t id) {
  return naming(database().name(), [&] { return parts_->find("evaluation.id = ?", id); });
}

std::int64_t ResultStore::start_study(const StudyRecord& study, std::span<const std::string> keys,
                                      std::span<const std::string> variants) {
  return naming(database().name(), [&] {
    SQLite::Database& connection = parts_->connection();
    SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
    SQLite::Statement record = bound(connection,
                                     std::string("INSERT INTO study(name, axes, definition, created, started) "
                                                 "VALUES (?, ?, ?, ") +
                                         now + ", " + now +
                                         ") ON CONFLICT(name) DO UPDATE SET axes = excluded.axes, "
                                         "definition = excluded.definition, started = excluded.started RETURNING id",
                                     study.name, joined(study.axes, " "), study.definition);
    record.executeStep();
    const std::int64_t id = record.getColumn(0).getInt64();
    record.reset();
    if (parts_->has_points(id, keys, variants)) {
      transaction.commit();
      return id;
    }
    const LargeCache cache(connection);
    bound(connection, "DELETE FROM study_point WHERE study = ?", id).exec();
    // An index that most keys are new to is made anew: sorted once, not one by one.
    const auto others = connection.execAndGet("SELECT count(*) FROM study_point").getInt64();
    const bool anew = others < static_cast<std::int64_t>(keys.size());
    if (anew) connection.exec("DROP INDEX study_point_key");
    SQLite::Statement add =
        bound(connection, "INSERT INTO study_point(study, position, key, variant) VALUES (?, ?, ?, nullif(?, ''))", id);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      add.reset();
      add.bind(2, static_cast<std::int64_t>(i + 1));
      add.bindNoCopy(3, keys[i]);
      if (!variants.empty()) add.bindNoCopy(4, variants[i]);
      add.exec();
    }
    add.reset();
    if (anew) connection.exec(study_point_index);
    transaction.commit();
    return id;
  });
}

void ResultStore::require_study(std::int64_t id, const std::string& name, std::span<const std::string> keys) {
  const auto change = naming(database().name(), [&]() -> std::string {
    SQLite::Statement row = bound(parts_->connection(), "SELECT name FROM study WHERE id = ?", id);
    if (!row.executeStep()) return "deleted";
    if (const std::string now = row.getColumn(0).getString(); now != name) return "renamed to " + now;
    const std::vector<std::string> points = parts_->of_points(name, "key");
    const std::unordered_set<std::string_view> present(points.begin(), points.end());
    const auto left = count_if(keys, [&](const auto& key) { return !present.contains(key); });
    return left == 0 ? "" : "defined anew, without " + std::to_string(left) + " of its points,";
  });
  if (!change.empty())
    throw std::runtime_error(database().name() + ": study = " + name + ": was " + change +
                             " by another process meanwhile; all answers are stored");
}

void ResultStore::add_points(const std::string& study, std::span<const std::string> keys,
                             std::span<const std::string> variants) {
  naming(database().name(), [&] {
    SQLite::Database& connection = parts_->connection();
    SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
    SQLite::Statement add(connection,
                          "INSERT INTO study_point(study, position, key, variant) SELECT id, "
                          "1 + coalesce((SELECT max(position) FROM study_point WHERE study = id), 0), ?1, ?3 "
                          "FROM study WHERE name = ?2 "
                          "AND NOT EXISTS (SELECT 1 FROM study_point WHERE key = ?1 AND study = id)");
    for (std::size_t i = 0; i < keys.size(); ++i) {
      add.reset();
      SQLite::bind(add, keys[i], study);
      if (i < variants.size() && !variants[i].empty())
        add.bind(3, variants[i]);
      else
        add.bind(3);
      add.exec();
    }
    add.reset();
    transaction.commit();
  });
}

void ResultStore::set_designs(const std::string& study, std::span<const DesignRecord> designs) {
  naming(database().name(), [&] {
    SQLite::Database& connection = parts_->connection();
    SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
    bound(connection,
          "UPDATE study_point SET design = NULL, goal = NULL, second_goal = NULL, feasible = NULL, "
          "front = NULL WHERE study = (SELECT id FROM study WHERE name = ?)",
          study)
        .exec();
    SQLite::Statement place(connection,
                            "SELECT study, position, design FROM study_point WHERE key = ? "
                            "AND study = (SELECT id FROM study WHERE name = ?)");
    SQLite::Statement number(connection, "UPDATE study_point SET design = ? WHERE study = ? AND position = ?");
    SQLite::Statement worth(connection,
                            "UPDATE study_point SET goal = ?, second_goal = ?, feasible = ?, front = ? "
                            "WHERE study = ? AND position = ?");
    for (const DesignRecord& design : designs) {
      std::optional<std::int64_t> first;
      for (const std::string& key : design.keys) {
        place.reset();
        SQLite::bind(place, key, study);
        if (!place.executeStep() || !place.getColumn(2).isNull()) {
          if (!first) break;  // not a point of the study, or of a design that is told already
          continue;
        }
        const std::int64_t id = place.getColumn(0).getInt64(), position = place.getColumn(1).getInt64();
        number.reset();
        SQLite::bind(number, first.value_or(position), id, position);
        number.exec();
        if (first) continue;
        first = position;
        worth.reset();
        worth.clearBindings();
        worth.bind(1, design.goal);
        if (design.second_goal) worth.bind(2, *design.second_goal);
        worth.bind(3, design.feasible ? 1 : 0);
        if (design.front) worth.bind(4, *design.front);
        worth.bind(5, id);
        worth.bind(6, position);
        worth.exec();
      }
    }
    transaction.commit();
  });
}

std::vector<std::string> ResultStore::points(const std::string& study) {
  return naming(database().name(), [&] { return parts_->of_points(study, "key"); });
}

std::vector<std::string> ResultStore::variants(const std::string& study) {
  return naming(database().name(), [&] { return parts_->of_points(study, "coalesce(variant, '')"); });
}

std::vector<StudySummary> ResultStore::studies() {
  return naming(database().name(), [&] { return parts_->summaries(nullptr); });
}

std::vector<std::string> ResultStore::study_names() {
  return naming(database().name(), [&] {
    SQLite::Statement row(parts_->connection(), "SELECT name FROM study ORDER BY name");
    return texts_of(row);
  });
}

std::optional<StudySummary> ResultStore::study(const std::string& name) {
  std::vector<StudySummary> found = naming(database().name(), [&] { return parts_->summaries(&name); });
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::optional<StudyOutline> ResultStore::outline(const std::string& name) {
  return naming(database().name(), [&]() -> std::optional<StudyOutline> {
    SQLite::Statement row =
        bound(parts_->connection(),
              "SELECT name, axes, (SELECT count(*) FROM study_point WHERE study = study.id) FROM study "
              "WHERE name = ?",
              name);
    if (!row.executeStep()) return std::nullopt;
    return read_outline(row);
  });
}

std::optional<std::string> ResultStore::definition(const std::string& study) {
  return naming(database().name(), [&]() -> std::optional<std::string> {
    SQLite::Statement row = bound(parts_->connection(), "SELECT definition FROM study WHERE name = ?", study);
    if (!row.executeStep()) return std::nullopt;
    return row.getColumn(0).getString();
  });
}

std::vector<Failure> ResultStore::failures(const std::string& study) {
  return naming(database().name(), [&] {
    SQLite::Statement row =
        bound(parts_->connection(),
              "SELECT status, coalesce(reason, ''), count(*) FROM result WHERE study = ? "
              "AND status IS NOT 'converged' GROUP BY status, reason ORDER BY count(*) DESC, reason",
              study);
    std::vector<Failure> all;
    while (row.executeStep())
      all.push_back({row.getColumn(0).getString(), row.getColumn(1).getString(), row.getColumn(2).getInt64()});
    return all;
  });
}

}  // namespace rollres
