#include "studies/serve/scene_service.hpp"

#include <chrono>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "core/numerics/parallel.hpp"
#include "core/numerics/threads.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

constexpr std::size_t longest_line = 1'000'000;   // as much is kept of it
constexpr std::size_t most_in_work_per_job = 32;  // lines that are read ahead

/// The next line, or nothing at the end; what is beyond the longest is left out.
std::optional<std::string> next_line(std::istream& in) {
  using Letters = std::char_traits<char>;
  std::string line;
  auto letter = in.rdbuf()->sbumpc();
  if (Letters::eq_int_type(letter, Letters::eof())) return std::nullopt;
  for (; !Letters::eq_int_type(letter, Letters::eof()) && letter != '\n'; letter = in.rdbuf()->sbumpc())
    if (line.size() <= longest_line) line += Letters::to_char_type(letter);
  return line;
}

bool blank(const std::string& line) { return line.find_first_not_of(" \t\r") == std::string::npos; }

std::string one_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

bool ready(const std::future<std::string>& answer) {
  return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

RollingScene read_whole_scene(const Json& object, const std::string& place) {
  return scene_from(scene_entries(object, {}, place), place);
}

ReadScene replacing_inputs_of(const std::string& file) {
  read_scene(file);  // refuses it now, not at every line
  const std::vector<SceneEntry> own = scene_entries(read_object(file), std::filesystem::path(file).parent_path(), file);
  return [own](const Json& object, const std::string& place) {
    return scene_from(overridden(own, replacing_entries(object, place)), place);
  };
}

SceneService::SceneService(StoredEvaluations& evaluations, ReadScene read, int jobs)
    : evaluations_(evaluations), read_(std::move(read)) {
  const std::size_t count = jobs_for(jobs, static_cast<std::size_t>(-1));
  for (std::size_t job = 0; job < count; ++job)
    threads_.emplace_back([this, cores = cores_for_each(count)] {
      limit_threads(cores);
      work();
    });
}

SceneService::~SceneService() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
}

void SceneService::work() {
  for (;;) {
    Answer next;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
    }
    next();
  }
}

std::string SceneService::answer(std::size_t line, const std::string& text) {
  const std::string place = "line " + std::to_string(line);
  Json id;
  std::optional<RollingScene> scene;
  try {
    if (text.size() > longest_line) throw std::invalid_argument(place + ": longer than 1 MB");
    Json object = parse_object(text, place);
    id = line;
    if (const auto given = object.find("id"); given != object.end()) {
      id = *given;
      object.erase(given);
    }
    scene = read_(object, place);
  } catch (const std::exception& error) {
    return one_line({{"id", id}, {"line", line}, {"error", error.what()}});
  }
  return solution_line(evaluations_(*scene), one_line(id));
}

std::future<std::string> SceneService::ask(std::size_t line, std::string text) {
  Answer question([this, line, text = std::move(text)] { return answer(line, text); });
  std::future<std::string> answer = question.get_future();
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(question));
  }
  changed_.notify_one();
  return answer;
}

void SceneService::serve(std::istream& in, std::ostream& out) {
  const std::size_t most = most_in_work_per_job * threads_.size();
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::future<std::string>> answers;
  bool at_end = false, broken = false;

  std::jthread reader([&] {
    std::size_t line = 0;
    while (std::optional<std::string> text = next_line(in)) {
      ++line;
      if (blank(*text)) continue;
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return broken || answers.size() < most; });
      if (broken) break;
      answers.push_back(ask(line, std::move(*text)));
      changed.notify_all();
    }
    const std::lock_guard lock(mutex);
    at_end = true;
    changed.notify_all();
  });
  const auto stop_reading = [&] {
    const std::lock_guard lock(mutex);
    broken = true;
    changed.notify_all();
  };
  try {
    for (;;) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return at_end || !answers.empty(); });
      if (answers.empty()) return;
      std::string written;
      std::size_t still = most;
      do {  // what is answered by now is stored and written at once
        std::future<std::string> first = std::move(answers.front());
        answers.pop_front();
        lock.unlock();
        changed.notify_all();
        written += first.get() + '\n';
        lock.lock();
      } while (--still > 0 && !answers.empty() && ready(answers.front()));
      lock.unlock();
      evaluations_.flush();
      evaluations_.forget();
      out << written << std::flush;
      if (!out) return stop_reading();
    }
  } catch (...) {
    failed_ = true;
    stop_reading();
    throw;
  }
}

}  // namespace rollres
