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
constexpr std::array<std::string_view, 53> chapters{"core/scene",
                                                    "core/messages",
                                                    "core/numerics",
                                                    "core/algebra",
                                                    "core/reference",
                                                    "core/material",
                                                    "core/surface",
                                                    "core/model",
                                                    "core/interior",
                                                    "core/influence",
                                                    "core/estimate",
                                                    "core/heat",
                                                    "core/convolution",
                                                    "core/edge",
                                                    "core/newton",
                                                    "core/paper_method",
                                                    "core/spectral",
                                                    "core/zones",
                                                    "core/finite_strain",
                                                    "core/given_pressure",
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
                                                    "studies/relations",
                                                    "studies/optimise",
                                                    "studies/charts",
                                                    "studies/figures",
                                                    "studies/stored_fits",
                                                    "studies/fit",
                                                    "studies/predict",
                                                    "studies/sensitivity",
                                                    "studies/report",
                                                    "studies/explore",
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

/// A source without comments, texts and lines of the preprocessor.
std::string code_of(const std::string& text) {
  std::string code;
  const auto has = [&](std::size_t at, std::string_view words) { return text.compare(at, words.size(), words) == 0; };
  const auto after = [&](std::string_view words, std::size_t from) {
    const std::size_t at = text.find(words, from);
    return at == std::string::npos ? text.size() : at + words.size();
  };
  bool new_line = true;
  for (std::size_t i = 0; i < text.size();) {
    const char letter = text[i];
    if (has(i, "//")) {
      i = text.find('\n', i);
    } else if (has(i, "/*")) {
      i = after("*/", i + 2);
    } else if (has(i, "R\"")) {
      const std::size_t open = text.find('(', i);
      i = after(")" + text.substr(i + 2, open - i - 2) + "\"", open);
    } else if (letter == '"' ||
               (letter == '\'' && (code.empty() || !std::isalnum(static_cast<unsigned char>(code.back()))))) {
      for (++i; i < text.size() && text[i] != letter; ++i) i += text[i] == '\\';
      ++i;
    } else if (letter == '#' && new_line) {
      while (i < text.size() && text[i] != '\n') i += has(i, "\\\n") ? 2 : 1;
    } else {
      code += letter;
      new_line = letter == '\n' || (new_line && letter == ' ');
      ++i;
    }
  }
  return code;
}

/// The words of code, and each other letter but blanks by itself.
std::vector<std::string> tokens_of(const std::string& code) {
  std::vector<std::string> tokens;
  bool in_word = false;
  for (const char letter : code) {
    const bool word = std::isalnum(static_cast<unsigned char>(letter)) || letter == '_';
    if (word && in_word)
      tokens.back() += letter;
    else if (!std::isspace(static_cast<unsigned char>(letter)))
      tokens.emplace_back(1, letter);
    in_word = word;
  }
  return tokens;
}

bool begins_a_type(const std::string& word) {
  return word == "struct" || word == "class" || word == "enum" || word == "union";
}

/// The name of the type that `head {` defines; empty where it defines none, or a specialisation.
std::string type_defined(const std::vector<std::string>& head) {
  std::size_t at = 0;
  for (int depth = 0; at < head.size() && (depth > 0 || !begins_a_type(head[at])); ++at)
    depth += (head[at] == "<") - (head[at] == ">");
  while (at < head.size() && begins_a_type(head[at])) ++at;
  if (at == head.size()) return {};
  const std::string name = head[at++];
  if (at < head.size() && head[at] == "final") ++at;
  const bool bases = at + 1 < head.size() && head[at] == ":" && head[at + 1] != ":";
  return at == head.size() || bases ? name : std::string();
}

/// The types that a source defines at the scope of a namespace with a name, each with its namespaces before it.
std::vector<std::string> types_in(const std::string& text) {
  constexpr const char* hidden = "";  // a namespace without a name, a function, a type
  std::vector<std::string> found, scopes, head;
  for (const std::string& token : tokens_of(code_of(text))) {
    if (token == "{") {
      const bool space = !head.empty() &&
                         (head[0] == "namespace" || (head[0] == "inline" && head.size() > 1 && head[1] == "namespace"));
      std::string scope = hidden, outer;
      if (space)
        for (std::size_t i = head[0] == "inline" ? 2 : 1; i < head.size(); ++i) scope += head[i];
      for (const std::string& name : scopes) outer += name + "::";
      const bool open = std::find(scopes.begin(), scopes.end(), hidden) == scopes.end();
      if (const std::string name = type_defined(head); !space && open && !name.empty()) found.push_back(outer + name);
      scopes.push_back(scope);
      head.clear();
    } else if (token == "}") {
      if (!scopes.empty()) scopes.pop_back();
      head.clear();
    } else if (token == ";") {
      head.clear();
    } else {
      head.push_back(token);
    }
  }
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
  CHECK(upward("core/newton", R"(// #include "core/solve/resolve.hpp")") == "");
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

// Two types of one name are one type for the linker: a list of the one is then freed by the code of the other.
TEST_CASE("no two sources define types of one name in one namespace", "[chapters]") {
  std::map<std::string, std::string> owner;
  std::vector<std::string> twice;
  for (const char* const top : {"core", "db", "fitting", "studies", "tests"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_directory() / top)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      std::ifstream file(entry.path());
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      const std::string place = entry.path().lexically_relative(source_directory()).string();
      for (const std::string& type : types_in(text))
        if (const auto [known, fresh] = owner.emplace(type, place); !fresh)
          twice.push_back(type + ": " + known->second + ", " + place);
    }
  CHECK(twice == std::vector<std::string>());
  CHECK(owner.contains("rollres::RollingScene"));
  CHECK(owner.contains("rollres::StudyPlan"));
  CHECK(owner.size() > 400);
}

TEST_CASE("types are found at the scope of a named namespace, and there alone", "[chapters]") {
  using Names = std::vector<std::string>;
  CHECK(types_in("namespace a { struct B { int c; }; class C final : public B {}; }") == Names{"a::B", "a::C"});
  CHECK(types_in("namespace a::b { enum class E : char { x }; union U {}; }") == Names{"a::b::E", "a::b::U"});
  CHECK(types_in("struct A {};") == Names{"A"});
  CHECK(types_in("namespace a { template <class T, class U> struct B {}; }") == Names{"a::B"});
  // Declared, nested, local, hidden, specialised, or not in the code at all.
  CHECK(types_in("namespace a { struct B; class C; enum class E : int; struct B f(struct C x); }") == Names{});
  CHECK(types_in("namespace a { struct B { struct C {}; enum D { x }; }; }") == Names{"a::B"});
  CHECK(types_in("namespace a { void f() { struct C {}; } struct B* g() { return nullptr; } }") == Names{});
  CHECK(types_in("namespace a { namespace { struct C {}; } struct D {}; }") == Names{"a::D"});
  CHECK(types_in("namespace a { struct B::C {}; }") == Names{});
  CHECK(types_in("namespace a { template <> struct B<int> {}; template <class T> void f(T t) {} }") == Names{});
  CHECK(types_in("// struct A {};\n/* struct B {}; */ auto t = \"struct C {}; \\\" {\"; char q = '\"', r = '{';") ==
        Names{});
  CHECK(types_in("auto raw = R\"x(struct A { \" )\" )x\"; int n = 1'000; struct B {};") == Names{"B"});
  CHECK(types_in("#define X struct A { \\\n int b;\nstruct C {};") == Names{"C"});
}
