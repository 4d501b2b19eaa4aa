#include "db/file/sql_functions.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <new>
#include <vector>

#include "db/file/digest.hpp"

namespace rollres {

namespace {

bool is_number(sqlite3_value* value) {
  const int type = sqlite3_value_numeric_type(value);
  return type == SQLITE_FLOAT || type == SQLITE_INTEGER;
}

/// By Welford's recurrence (1962).
struct Spread {
  std::int64_t count;
  double mean, squares;
};

void add_to_spread(sqlite3_context* context, int, sqlite3_value** values) {
  if (!is_number(values[0])) return;
  auto* const spread = static_cast<Spread*>(sqlite3_aggregate_context(context, sizeof(Spread)));
  if (!spread) return sqlite3_result_error_nomem(context);
  const double value = sqlite3_value_double(values[0]), step = value - spread->mean;
  spread->mean += step / static_cast<double>(++spread->count);
  spread->squares += step * (value - spread->mean);
}

void finish_spread(sqlite3_context* context) {
  const auto* const spread = static_cast<Spread*>(sqlite3_aggregate_context(context, 0));
  if (spread && spread->count > 1)
    sqlite3_result_double(context, std::sqrt(spread->squares / static_cast<double>(spread->count - 1)));
}

using Numbers = std::vector<double>;

void add_to_numbers(sqlite3_context* context, int, sqlite3_value** values) {
  if (!is_number(values[0])) return;
  auto** const numbers = static_cast<Numbers**>(sqlite3_aggregate_context(context, sizeof(Numbers*)));
  try {
    if (!numbers) throw std::bad_alloc();
    if (!*numbers) *numbers = new Numbers;
    (*numbers)->push_back(sqlite3_value_double(values[0]));
  } catch (const std::bad_alloc&) {
    sqlite3_result_error_nomem(context);
  }
}

/// SQLite calls it for everything that was begun, also after an error.
void finish_median(sqlite3_context* context) {
  auto** const kept = static_cast<Numbers**>(sqlite3_aggregate_context(context, 0));
  if (!kept || !*kept) return;
  const std::unique_ptr<Numbers> numbers(*kept);
  *kept = nullptr;
  if (numbers->empty()) return;
  const auto middle = numbers->begin() + static_cast<std::ptrdiff_t>(numbers->size() / 2);
  std::nth_element(numbers->begin(), middle, numbers->end());
  double median = *middle;
  if (numbers->size() % 2 == 0) median = 0.5 * (median + *std::max_element(numbers->begin(), middle));
  sqlite3_result_double(context, median);
}

void round_number(sqlite3_context* context, int, sqlite3_value** values) {
  if (sqlite3_value_type(values[0]) != SQLITE_FLOAT) return sqlite3_result_value(context, values[0]);
  double value = sqlite3_value_double(values[0]);
  if (std::isfinite(value)) {
    const std::string text = twelve_digits(value);
    std::from_chars(text.data(), text.data() + text.size(), value);
  }
  sqlite3_result_double(context, value);
}

}  // namespace

void add_functions(SQLite::Database& connection) {
  connection.createFunction("stddev", 1, true, nullptr, nullptr, add_to_spread, finish_spread);
  connection.createFunction("median", 1, true, nullptr, nullptr, add_to_numbers, finish_median);
  connection.createFunction("rounded", 1, true, nullptr, round_number);
}

}  // namespace rollres
