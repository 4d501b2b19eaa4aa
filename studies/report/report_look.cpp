#include "studies/report/report_look.hpp"

#include <map>

namespace rollres::html {

namespace {

/// The files of this folder by their endings: ".css".
const std::map<std::string_view, std::string_view> texts{
#include "report_texts.inc"
};

}  // namespace

std::string_view style() { return texts.at(".css"); }

std::string_view script() { return texts.at(".js"); }

}  // namespace rollres::html
