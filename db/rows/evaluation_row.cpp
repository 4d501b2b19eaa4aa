#include "db/rows/evaluation_row.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "core/messages/message_text.hpp"
#include "core/messages/number_list.hpp"
#include "db/rows/layer_list.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

namespace {

using Lines = std::vector<std::string>;

void bind_value(SQLite::Statement& statement, int index, const std::optional<double>& value) {
  value ? rollres::bind_value(statement, index, *value) : statement.bind(index);
}
/// A list is text, and NULL if it is empty.
void bind_value(SQLite::Statement& statement, int index, const std::vector<double>& list) {
  list.empty() ? statement.bind(index) : statement.bind(index, text_of_list(list));
}
void bind_value(SQLite::Statement& statement, int index, const BondedLayers& layers) {
  layers.empty() ? statement.bind(index) : statement.bind(index, text_of_layers(layers));
}
void bind_value(SQLite::Statement& statement, int index, const Lines& lines) {
  statement.bind(index, joined(lines, "\n", [](std::string line) {
                   std::replace(line.begin(), line.end(), '\n', ' ');
                   return line;
                 }));
}
template <class Choice>
requires std::is_enum_v<Choice>
void bind_value(SQLite::Statement& statement, int index, const Choice& choice) {
  statement.bind(index, std::string(name_of(choice)));
}

void read_value(const SQLite::Column& column, double& value) { value = column.getDouble(); }
void read_value(const SQLite::Column& column, std::optional<double>& value) { value = column.getDouble(); }
void read_value(const SQLite::Column& column, std::vector<double>& list) {
  const std::string text = column.getString();
  const auto numbers = list_in(text);
  if (!numbers) throw std::runtime_error(std::string(column.getName()) + " = " + text + ": is no list of numbers");
  list = *numbers;
}
void read_value(const SQLite::Column& column, BondedLayers& layers) {
  try {
    layers = layers_in(column.getString());
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string(column.getName()) + " = " + error.what());
  }
}
void read_value(const SQLite::Column& column, int& value) { value = column.getInt(); }
void read_value(const SQLite::Column& column, std::string& value) { value = column.getString(); }
void read_value(const SQLite::Column& column, Lines& lines) {
  lines.clear();
  const std::string text = column.getString();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
}
template <class Choice>
requires std::is_enum_v<Choice>
void read_value(const SQLite::Column& column, Choice& choice) {
  const std::string name = column.getString();
  const int position = find_name(ChoiceNames<Choice>::names, name);
  if (position < 0)
    throw std::runtime_error(std::string(column.getName()) + " = " + name + ": not known to this version of rollres");
  choice = static_cast<Choice>(position);
}

}  // namespace

void bind_row(SQLite::Statement& statement, int first, const RollingScene& scene, const RollingSolution& solution) {
  auto bind_next = [&](const Quantity&, const auto& value) { bind_value(statement, first++, value); };
  visit_inputs(scene, bind_next);
  visit_outputs(solution, bind_next);
}

SceneAndSolution read_row(SQLite::Statement& statement, int first) {
  SceneAndSolution row;
  row.scene.kinematics = Kinematics::printed;  // of rows from before there was a choice
  auto read_next = [&](const Quantity&, auto& value) {
    const SQLite::Column column = statement.getColumn(first++);
    if (!column.isNull()) read_value(column, value);
  };
  visit_inputs(row.scene, read_next);
  visit_outputs(row.solution, read_next);
  return row;
}

std::string select_list(SQLite::Database& connection) {
  const std::set<std::string> present = column_names(connection, "evaluation");
  return joined(quantity_columns(), ", ", [&](const Column& column) {
    return (present.contains(column.name) ? "evaluation." : "NULL AS ") + column.name;
  });
}

}  // namespace rollres
