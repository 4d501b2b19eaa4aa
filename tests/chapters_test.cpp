#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/catch.hpp"
#include "tests/source_directory.hpp"

namespace {

/// The chapters from the ground up: each includes itself and those before it. core/reference stands as low as it does
/// so that it includes no solver: it is the witness of all of them.
constexpr std::array<std::string_view, 44> chapters{"core/scene",
                                                    "core/messages",
                                                    "core/numerics",
                                                    "core/reference",
                                                    "core/material",
                                                    "core/surface",
                                                    "core/interior",
                                                    "core/influence",
                                                    "core/estimate",
                                                    "core/convolution",
                                                    "core/edge",
                                                    "core/newton",
                                                    "core/paper_method",
                                                    "core/spectral",
                                                    "core/finite_strain",
                                                    "core/solve",
                                                    "core/derivatives",
                                                    "db/file",
                                                    "db/rows",
                                                    "db/merge",
                                                    "db/queries",
                                                    "fitting/descent",
                                                    "fitting/errors",
                                                    "fitting/fit",
                                                    "fitting/material",
                                                    "studies/text",
                                                    "studies/drawing",
                                                    "studies/scene_io",
                                                    "studies/scatter",
                                                    "studies/study",
                                                    "studies/stored",
                                                    "studies/run",
                                                    "studies/serve",
                                                    "studies/program",
                                                    "studies/evidence",
                                                    "studies/optimise",
                                                    "studies/charts",
                                                    "studies/figures",
                                                    "studies/fit",
                                                    "studies/sensitivity",
                                                    "studies/report",
                                                    "studies/file_schema",
                                                    "studies/commands",
                                                    "studies/python"};

std::size_t floor_of(const std::string& chapter) {
  return static_cast<std::size_t>(std::find(chapters.begin(), chapters.end(), chapter) - chapters.begin());
}

/// Why a source of `chapter` must not have this line; empty if it may.
std::string upward(const std::string& chapter, const std::string& line) {
  static const std::regex include(R"re(\s*#\s*include\s*"((core|db|fitting|studies)[^"]*)/[^/"]*".*)re");
  std::smatch found;
  if (line.find("include") == std::string::npos || !std::regex_match(line, found, include)) return {};
  if (floor_of(found[1]) <= floor_of(chapter)) return {};
  return chapter + " is below " + found[1].str() + ": " + line;
}

/// The sources of core, db, fitting and studies, but for the public headers that stand in core itself.
std::map<std::string, std::vector<std::filesystem::path>> sources_by_chapter() {
  std::map<std::string, std::vector<std::filesystem::path>> found;
  for (const char* const top : {"core", "db", "fitting", "studies"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_directory() / top))
      if (const auto type = entry.path().extension(); type == ".cpp" || type == ".hpp")
        found[entry.path().parent_path().lexically_relative(source_directory()).string()].push_back(entry.path());
  found.erase("core");
  return found;
}

}  // namespace

TEST_CASE("a chapter includes only itself and the chapters below it", "[chapters]") {
  std::vector<std::string> wrong;
  for (const auto& [chapter, sources] : sources_by_chapter()) {
    INFO(chapter << " must be in the list of chapters");
    CHECK(floor_of(chapter) < chapters.size());
    for (const auto& source : sources) {
      std::ifstream text(source);
      for (std::string line; std::getline(text, line);)
        if (const std::string why = upward(chapter, line); !why.empty()) wrong.push_back(source.string() + ": " + why);
    }
  }
  CHECK(wrong == std::vector<std::string>());
}

TEST_CASE("an include that points upward, or to no chapter, is found", "[chapters]") {
  CHECK(upward("core/influence", R"(#include "core/newton/contact_level.hpp")") != "");
  CHECK(upward("core/solve", R"(  # include "studies/text/units.hpp"  // why)") != "");
  CHECK(upward("core/solve", R"(#include "core/new_chapter/news.hpp")") != "");
  CHECK(upward("core/influence", R"(#include "core/rolling_contact.hpp")") != "");
  CHECK(upward("core/newton", R"(#include "core/influence/influence.hpp")") == "");
  CHECK(upward("core/newton", R"(#include "core/newton/contact_level.hpp")") == "");
  CHECK(upward("core/newton", R"(// #include "core/solve/model_choice.hpp")") == "");
}

TEST_CASE("a folder of sources holds at most thirty files", "[chapters]") {
  for (const auto& [chapter, sources] : sources_by_chapter()) {
    INFO(chapter);
    CHECK(sources.size() <= 30);
  }
}

TEST_CASE("each source has a test of its name or is named in one", "[chapters]") {
  std::set<std::string> words;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_directory() / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    words.insert(entry.path().stem().string());
    std::ifstream text(entry.path());
    std::string word;
    for (char c; text.get(c);)
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
        word += c;
      else if (!word.empty())
        words.insert(std::exchange(word, {}));
  }
  std::vector<std::string> untested;
  for (const auto& [chapter, sources] : sources_by_chapter())
    for (const auto& source : sources) {
      const std::string name = source.stem().string();
      if (source.extension() == ".cpp" && !words.contains(name) && !words.contains(name + "_test"))
        untested.push_back(chapter + "/" + name);
    }
  CHECK(untested == std::vector<std::string>());
}
