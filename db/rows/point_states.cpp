#include "db/rows/point_states.hpp"

#include <unordered_map>

#include "db/file/sqlite.hpp"

namespace rollres {

std::vector<PointState> point_states(const Database& database, std::span<const std::string> keys) {
  return naming(database.name(), [&] {
    SQLite::Savepoint one_state(database.connection(), "states");
    const std::string columns = "SELECT status IS 'converged', coalesce(seconds, 0), key FROM evaluation";
    const auto read_state = [](SQLite::Statement& row) {
      return PointState{row.getColumn(0).getInt() == 1 ? Answer::converged : Answer::failed,
                        row.getColumn(1).getDouble()};
    };
    std::vector<PointState> states(keys.size());
    const auto stored = database.connection().execAndGet("SELECT count(*) FROM (SELECT 1 FROM evaluation LIMIT 1000)");
    if (stored.getInt() < 1000 && keys.size() > 1000) {  // few answers, to many questions
      std::unordered_map<std::string, PointState> all;
      for (SQLite::Statement row(database.connection(), columns); row.executeStep();)
        all.emplace(row.getColumn(2).getString(), read_state(row));
      for (std::size_t i = 0; i < keys.size() && !all.empty(); ++i)
        if (const auto found = all.find(keys[i]); found != all.end()) states[i] = found->second;
    } else {
      SQLite::Statement row(database.connection(), columns + " WHERE key = ?");
      for (std::size_t i = 0; i < keys.size(); ++i) {
        row.bindNoCopy(1, keys[i]);
        if (row.executeStep()) states[i] = read_state(row);
        row.reset();
      }
    }
    one_state.release();
    return states;
  });
}

}  // namespace rollres
