#include "studies/charts/stored_line.hpp"

#include <stdexcept>

#include "core/derivatives/objective.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

const QuantityColumn& chosen_axis(const ShownStudy& shown, const std::string& wish, const std::string& picture,
                                  std::span<const std::string_view> usual) {
  const auto count = [&](const std::string& key) {
    return shown.rows.values(column_of(key, shown.study, shown.rows, "--axis")).size();
  };
  std::string key = wish;
  const auto may_go = [&](const std::string& one) { return usual.empty() || find_name(usual, one) >= 0; };
  for (const std::string& one : shown.study.axes)
    if (wish.empty() && may_go(one) && (key.empty() || count(one) > count(key))) key = one;
  if (key.empty())
    throw std::invalid_argument(
        shown.study.name + ": has no axis along which " + picture + " could go" +
        (usual.empty() ? "" : ": " + joined(usual) + "; --axis takes any: " + joined(shown.study.axes)));
  if (count(key) < 2 && shown.rows.size() > 1 &&
      std::find(shown.study.axes.begin(), shown.study.axes.end(), key) == shown.study.axes.end())
    throw std::invalid_argument(shown.study.name + ": --axis = " + key + ": all points have the same; axes are " +
                                joined(shown.study.axes));
  return number_column(key, shown.study, shown.rows, "--axis");
}

/// @throws std::invalid_argument if another axis has several values, too
void require_one_line(const ShownStudy& shown, const QuantityColumn& axis, const std::string& picture) {
  for (const std::string& key : shown.study.axes) {
    const QuantityColumn& other = column_of(key, shown.study, shown.rows, "--axis");
    const std::vector<Cell> values = shown.rows.values(other);
    if (&other == &axis || values.size() < 2) continue;
    if (shown.rows.size() == shown.rows.values(axis).size()) continue;  // varies along
    throw std::invalid_argument(
        shown.study.name + ": " + key + " has " + std::to_string(values.size()) + " values; " + picture +
        " shows one, choose it with --where " +
        shell_word(key + "=" + value_in_words(other.quantity, *values.begin(), unit_in(shown.rows, other))));
  }
}

std::string counted(std::size_t count, const char* thing, const char* one, const char* several) {
  return std::to_string(count) + " " + thing + (count == 1 ? one : several);
}

}  // namespace

std::string StoredLine::remarks() const {
  std::string text;
  if (solved > 0)
    text += counted(solved, "scene", " was solved again: its fields are", "s were solved again: their fields are") +
            " not stored (rollres sweep STUDY --fields)\n";
  if (left_out > 0)
    text += counted(left_out, "point", " has no answer and is", "s have no answer and are") + " left out\n";
  return text;
}

StoredLine stored_line(ResultStore& store, const ShownStudy& shown, const std::vector<Filter>& filters,
                       const std::string& axis, const std::string& picture,
                       const std::function<RollingSolution(const RollingScene&)>& evaluate,
                       std::span<const std::string_view> usual) {
  StoredLine line;
  line.axis = &chosen_axis(shown, axis, picture, usual);
  line.left_out = shown.unanswered();
  require_one_line(shown, *line.axis, picture);
  std::vector<Filter> wanted = filters;
  wanted.push_back({"study", Comparison::equal, shown.study.name});
  const Table ids = run_query(store.database(), {.filters = wanted, .columns = {"id"}});
  for (const auto& row : ids.rows) {
    auto one = store.find(std::get<std::int64_t>(row.front()));
    if (!one || one->solution.status != Status::converged) continue;
    if (auto fields = store.find_fields(evaluation_key(one->scene))) {
      one->solution.fields = std::move(*fields);
    } else {
      ++line.solved;
      one->solution = evaluate(one->scene);
    }
    if (one->solution.status == Status::converged && one->solution.fields.grid.size() > 0)
      line.points.push_back(std::move(*one));
    else
      ++line.left_out;
  }
  stable_sort(line.points, [&](const auto& a, const auto& b) {
    return real_input(a.scene, line.axis->quantity.key) < real_input(b.scene, line.axis->quantity.key);
  });
  return line;
}

}  // namespace rollres
