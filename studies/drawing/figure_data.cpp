#include "studies/drawing/figure_data.hpp"

#include "studies/text/readable_number.hpp"

namespace rollres {

FigureData::FigureData(std::string_view title) : text_("# " + std::string(title) + '\n') {}

std::string FigureData::add(std::string_view name, std::string_view columns, const std::vector<DataRow>& rows) {
  if (blocks_ > 0) text_ += "\n\n";
  text_ += "# " + std::string(name) + ": " + std::string(columns) + '\n';
  for (const DataRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text_ += (i == 0 ? "" : " ") + short_number(row[i], 8);
    text_ += '\n';
  }
  return "data index " + std::to_string(blocks_++);
}

std::string FigureData::add(std::string_view name, std::string_view columns, const std::vector<ContourLoop>& loops) {
  std::vector<DataRow> rows;
  for (const ContourLoop& loop : loops) {
    if (!rows.empty()) rows.emplace_back();
    for (DataRow& row : closed(loop)) rows.push_back(std::move(row));
  }
  return add(name, columns, rows);
}

std::vector<DataRow> closed(const ContourLoop& loop) {
  std::vector<DataRow> rows;
  for (const auto& [x, y] : loop.points) rows.push_back({x, y});
  rows.push_back({loop.points.front()[0], loop.points.front()[1]});
  return rows;
}

}  // namespace rollres
