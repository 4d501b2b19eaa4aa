#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

/// The blocks of a figure's data file by name; those of one name in their order. An empty row separates lines.
using FigureBlock = std::vector<std::vector<double>>;
inline std::map<std::string, std::vector<FigureBlock>> figure_blocks(const std::string& text) {
  std::map<std::string, std::vector<FigureBlock>> blocks;
  std::istringstream lines(text);
  FigureBlock* block = nullptr;
  bool title = true;
  for (std::string line; std::getline(lines, line); title = false) {
    if (line.starts_with("# ")) {
      if (!title) block = &blocks[line.substr(2, line.find(':') - 2)].emplace_back();
      continue;
    }
    if (!block) continue;
    std::vector<double> row;
    std::istringstream numbers(line);
    for (double number; numbers >> number;) row.push_back(number);
    block->push_back(row);
  }
  for (auto& [name, all] : blocks)
    for (FigureBlock& one : all)
      while (!one.empty() && one.back().empty()) one.pop_back();
  return blocks;
}

/// Whether the tags of an XML text nest and all of it lies in one element.
inline bool well_formed(const std::string& xml) {
  std::vector<std::string> open;
  std::size_t elements = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    const std::string end = xml.compare(at, 4, "<!--") == 0        ? "-->"
                            : xml.compare(at, 9, "<![CDATA[") == 0 ? "]]>"
                                                                   : ">";
    const std::size_t stop = xml.find(end, at);
    if (stop == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, stop - at - 1);
    at = stop + end.size();
    if (tag.starts_with("?") || tag.starts_with("!")) continue;
    if (tag.starts_with("/")) {
      if (open.empty() || open.back() != tag.substr(1, tag.find_last_not_of(" \n"))) return false;
      open.pop_back();
      continue;
    }
    if (open.empty() && elements++ > 0) return false;
    if (!tag.ends_with("/")) open.push_back(tag.substr(0, tag.find_first_of(" \t\n")));
  }
  return open.empty() && elements == 1;
}
