#include "studies/report/report_look.hpp"

#include <map>
#include <string>

namespace rollres::html {

namespace {

/// Files of this folder by their names.
const std::map<std::string_view, std::string_view> texts{
#include "report_texts.inc"
};

}  // namespace

std::string_view style() { return texts.at("report.css"); }

std::string script() { return std::string(texts.at("ticks.js")) + std::string(texts.at("report.js")); }

}  // namespace rollres::html
