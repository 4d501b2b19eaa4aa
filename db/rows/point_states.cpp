#include "db/rows/point_states.hpp"

#include "db/file/sqlite.hpp"

namespace rollres {

std::vector<PointState> point_states(const Database& database, std::span<const std::string> keys) {
  return naming(database.name(), [&] {
    SQLite::Savepoint one_state(database.connection(), "states");
    SQLite::Statement row(database.connection(),
                          "SELECT status IS 'converged', coalesce(seconds, 0) FROM evaluation WHERE key = ?");
    std::vector<PointState> states;
    states.reserve(keys.size());
    for (const std::string& key : keys) {
      PointState& state = states.emplace_back();
      row.bind(1, key);
      if (row.executeStep()) {
        state.answer = row.getColumn(0).getInt() == 1 ? Answer::converged : Answer::failed;
        state.seconds = row.getColumn(1).getDouble();
      }
      row.reset();
    }
    one_state.release();
    return states;
  });
}

}  // namespace rollres
