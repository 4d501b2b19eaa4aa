#include "studies/explore/explorer.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "core/numerics/solution_limits.hpp"
#include "db/file/temporary_folder.hpp"
#include "studies/evidence/simpler_models.hpp"
#include "studies/explore/explored_scene.hpp"
#include "studies/explore/explored_studies.hpp"
#include "studies/figures/figure.hpp"
#include "studies/scene_io/model_text.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/scene_io/summary.hpp"
#include "studies/text/files.hpp"

namespace rollres {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> page_files{{
#include "explore_texts.inc"
}};

constexpr std::size_t most_kept = 20'000;  // answers of curves
constexpr std::size_t most_views = 1'000;  // of pages that were opened
constexpr const char* own_scripts_alone =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; frame-src "
    "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'";
/// A report is a page by itself, which may ask nobody for anything.
constexpr const char* as_a_report =
    "sandbox allow-scripts allow-popups; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data:; frame-ancestors 'self'";

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "random numbers of the system");
  std::string token;
  for (const unsigned char byte : bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    token += {digits[byte >> 4U], digits[byte & 15U]};
  }
  return token;
}

/// Takes as long for a wrong first letter as for a wrong last one.
bool same(std::string_view one, std::string_view other) {
  unsigned different = one.size() != other.size() ? 1 : 0;
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i)
    different |= static_cast<unsigned char>(one[i] ^ other[i]);
  return different == 0;
}

std::string type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/javascript; charset=utf-8";
}

HttpReply json_reply(const Json& json, int status = 200) {
  return {status, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

/// "scene: load = -1: must be > 0" is said at the field of load. To the browser it is an answer as any other; a request
/// that no page makes is none.
HttpReply refusal(const std::string& words) {
  constexpr std::string_view place = "scene: ";
  constexpr int bad_request = 400;
  Json reply{{"error", words}};
  if (words.starts_with(place)) reply["key"] = words.substr(place.size(), words.find(' ', place.size()) - place.size());
  return json_reply(reply, words.starts_with("request") ? bad_request : 200);
}

HttpReply nothing_here() { return json_reply({{"error", "nothing is here"}}, 404); }

bool wished(const Json& asked, const char* what) {
  const auto wish = asked.find(what);
  return wish != asked.end() && wish->is_boolean() && wish->get<bool>();
}

/// CSV files of the folder and three levels below it, for fields that name one.
Json tables_below(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  constexpr int deepest = 3;
  constexpr std::size_t most = 300;
  std::vector<std::string> found;
  std::error_code none;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, none);
  for (; !none && entry != fs::recursive_directory_iterator() && found.size() < most; entry.increment(none)) {
    const bool hidden = entry->path().filename().string().starts_with('.');
    if (hidden || entry.depth() >= deepest) entry.disable_recursion_pending();
    if (!hidden && entry->path().extension() == ".csv")
      found.push_back(entry->path().lexically_relative(folder).string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// A figure of the inside, or of a sphere's surface, as SVG.
std::string figure_text(const RollingScene& scene, const RollingSolution& solution, const std::string& name) {
  const Figure figure = figures_for(scene, {name}).front();
  const TemporaryFolder folder;
  return whole_file(draw_figure(figure, FigureSource(scene, solution), folder / "figure").svg, 20'000'000);
}

}  // namespace

Explorer::Explorer(const ExplorerOptions& options, Evaluate evaluate)
    : database_(options.database),
      folder_(options.folder),
      stop_(options.stop),
      token_(new_token()),
      read_(whole_scenes(options.folder)),
      first_scene_(options.scene.empty() ? parse_object(paper_scenes().front().json, "paper_cylinder")
                                         : scene_for_pages(options.scene, options.folder)),
      evaluate_(std::move(evaluate)),
      curves_(evaluate_),
      runs_(options.folder, options.database) {
  first_scene_.erase("$schema");
  first_held_ = parse_object(scene_json(read_(first_scene_, "scene")), "scene");
}

std::map<std::string, std::string> Explorer::headers() {
  return {{"Content-Security-Policy", own_scripts_alone},
          {"X-Content-Type-Options", "nosniff"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cache-Control", "no-store"}};
}

HttpReply Explorer::operator()(const HttpRequest& request) {
  HttpReply reply{403, "text/plain", "rollres explore: open the address that it has printed\n"};
  const std::string port = ":" + std::to_string(port_);
  const bool of_host = request.host == "127.0.0.1" + port || request.host == "localhost" + port;
  const bool of_page = request.origin.empty() || request.origin == "http://" + request.host;
  const std::size_t end = request.path.find('/', 1);
  const std::string_view given = std::string_view(request.path).substr(0, end);
  if (of_host && of_page && !given.empty() && same(given.substr(1), token_))
    reply = reply_to(request, end == std::string::npos ? "/" : request.path.substr(end));
  for (const auto& [name, value] : headers()) reply.headers.emplace(name, value);
  return reply;
}

HttpReply Explorer::reply_to(const HttpRequest& request, const std::string& what) {
  try {
    if (request.method == "POST") {
      const std::optional<Json> reply = posted(what, parse_object(request.body, "request"));
      return reply ? json_reply(*reply) : nothing_here();
    }
    if (what == "/start")
      return json_reply({{"scene", first_scene_},
                         {"held", first_held_},
                         {"quantities", quantities_for_pages()},
                         {"database", database_.string()}});
    if (what == "/files") return json_reply({{"files", tables_below(folder_)}});
    if (what == "/studies") return json_reply(studies_for_pages(database_));
    if (what == "/runs") return json_reply(runs_.state());
    if (what == "/chart") return json_reply(study_chart_for_pages(database_, request.query));
    if (what == "/rows") return json_reply(rows_for_pages(database_, request.query));
    if (what == "/count") return json_reply(count_for_pages(database_, request.query));
    if (what == "/point") return json_reply(point_for_pages(database_, request.query));
    if (what == "/report")
      return {200,
              "text/html; charset=utf-8",
              report_for_pages(database_, request.query),
              {{"Content-Security-Policy", as_a_report}}};
    for (const auto& [name, text] : page_files)
      if (what == "/" + std::string(name) || (what == "/" && name == "explore.html"))
        return {200, type_of(name), std::string(text)};
    return nothing_here();
  } catch (const Interrupted&) {
    return json_reply({{"error", "a newer wish has come"}, {"superseded", true}});
  } catch (const std::exception& error) {
    return refusal(error.what());
  }
}

/// Whether a wish of the same page and view has come since, or the server ends. A wish has "page", "view" and "number".
std::function<bool()> Explorer::newer_than(const Json& wish) {
  const std::string view = needed_text(wish, "page", "request", "must be the page's name") + '/' +
                           needed_text(wish, "view", "request", "must be the view's name");
  const std::int64_t number = whole_number(needed(wish, "number", "request", "must be a count"), "number", 0,
                                           std::numeric_limits<int>::max(), "request");
  Newest newest;
  {
    const std::lock_guard lock(mutex_);
    if (newest_.size() > most_views) newest_.clear();
    Newest& here = newest_[view];
    if (!here) here = std::make_shared<std::atomic<std::int64_t>>(-1);
    newest = here;
    if (number > *newest) *newest = number;
  }
  return [newest, number, this] { return *newest > number || stop_; };
}

Json Explorer::answered(const Json& asked) {
  const RollingScene scene = read_(needed(asked, "scene", "request", "must be a scene"), "scene");
  const std::function<bool()> newer = newer_than(needed(asked, "wish", "request", "must be an object"));
  const Interruptible until(newer);
  if (newer()) throw Interrupted();
  const std::optional<RollingScene> coarse = wished(asked, "coarse") ? coarse_scene(scene) : std::nullopt;
  const RollingScene& solved = coarse ? *coarse : scene;
  const RollingSolution solution = evaluate_(solved);
  Json reply = answer_for_pages(solved, solution);
  reply["coarse"] = coarse.has_value();
  if (asked.contains("figure"))
    reply["figure"] = figure_text(scene, solution, needed_text(asked, "figure", "request", "must be a figure's name"));
  if (wished(asked, "explain"))
    reply["explanation"] = model_text(scene) + explanation(scene, solution) +
                           (solution.status == Status::converged && solution.moduli_factors.empty()
                                ? simpler_models_text(scene, solution, simpler_models(scene, solution, evaluate_))
                                : "");
  return reply;
}

void Explorer::forget_old_answers() {
  const std::lock_guard lock(mutex_);
  if (curves_.count().all() - forgotten_ < most_kept) return;
  forgotten_ = curves_.count().all();
  curves_.forget();
}

std::optional<Json> Explorer::posted(const std::string& what, const Json& asked) {
  if (what == "/answer") return answered(asked);
  if (what == "/newer") {
    newer_than(needed(asked, "wish", "request", "must be an object"));
    return Json::object();
  }
  if (what == "/curve") {
    const RollingScene scene = read_(needed(asked, "scene", "request", "must be a scene"), "scene");
    const ExploredCurve curve = explored_curve(needed(asked, "curve", "request", "must be an object"), "curve");
    forget_old_answers();
    return curve_for_pages(scene, curve, curves_, newer_than(needed(asked, "wish", "request", "must be an object")));
  }
  if (what == "/materials")
    return materials_for_pages(read_(needed(asked, "scene", "request", "must be a scene"), "scene"));
  if (what == "/run") {
    const Json& study = needed(asked, "study", "request", "must be a study");
    read_(needed(study, "scene", "study", "must be a scene"), "study: scene");
    return runs_.start(study);
  }
  if (what == "/stop") {
    runs_.stop(needed_text(asked, "study", "request", "must be a study's name"));
    return Json{{"stopping", true}};
  }
  return std::nullopt;
}

}  // namespace rollres
