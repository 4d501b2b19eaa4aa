#include "studies/serve/scene_service.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/messages/message_text.hpp"
#include "core/numerics/parallel.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/numerics/threads.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

constexpr std::size_t longest_line = 1'000'000;       // as much is kept of it
constexpr std::size_t most_in_work_per_job = 32;      // lines that are read ahead
constexpr std::size_t most_bytes_of_one = 4'000'000;  // of such lines
constexpr std::size_t most_bytes = 64'000'000;        // of such lines, of all clients; each has one line in any case
constexpr auto at_times = std::chrono::milliseconds(50);  // whether a client has gone

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

/// The scene with the names of its files as whole paths. Refuses what is not a regular file below the folder.
Json confined(Json object, const std::filesystem::path& folder, const std::string& place) {
  for (const TablePart& part : parts_with_tables(object))
    for (const std::string_view key : table_keys) {
      const auto named = part.object->find(std::string(key));
      if (named == part.object->end() || !named->is_string()) continue;
      const std::string said = part.prefix + std::string(key);
      if (folder.empty())
        refuse(place, said, *named, "a line may name files only where --files gives a folder of them");
      std::error_code none;
      const std::filesystem::path file = std::filesystem::canonical(folder / named->get<std::string>(), none);
      const bool below =
          !file.empty() && std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
      if (!below || !std::filesystem::is_regular_file(file, none))
        refuse(place, said, *named, "must be a file in the folder of --files");
      *named = file.string();
    }
  return object;
}

bool ready(const std::future<std::string>& answer) {
  return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

ReadScene whole_scenes(const std::filesystem::path& files) {
  std::error_code none;
  if (!files.empty() && !std::filesystem::is_directory(files, none))
    throw std::invalid_argument("--files = " + files.string() + ": must be a folder");
  const std::filesystem::path folder = files.empty() ? files : std::filesystem::canonical(files);
  return [folder](const Json& object, const std::string& place) {
    return scene_from(scene_entries(confined(object, folder, place), {}, place), place);
  };
}

ReadScene replacing_inputs_of(const std::string& file) {
  read_scene(file);  // refuses it now, not at every line
  const std::vector<SceneEntry> own = scene_entries(read_object(file), std::filesystem::path(file).parent_path(), file);
  return [own](const Json& object, const std::string& place) {
    return scene_from(overridden(own, replacing_entries(object, place)), place);
  };
}

const std::atomic<bool> SceneService::nobody_leaves = false;

/// One stream that is served.
struct SceneService::Client {
  struct Line {
    std::future<std::string> answer;
    std::size_t bytes;
  };
  explicit Client(const std::atomic<bool>& left) : gone(left) {}
  bool is_over() const { return gone || broken; }
  bool first_is_ready() const { return !lines.empty() && ready(lines.front().answer); }

  const std::atomic<bool>& gone;     // lives as long as `serve`, which waits for `in_work` to be 0
  std::atomic<bool> broken = false;  // its output, or the store
  std::deque<Answer> waiting;        // nobody works on these
  std::size_t in_work = 0;
  std::deque<Line> lines;  // that are not written, in their order
  std::size_t bytes = 0;   // of these
  bool at_end = false;
  std::condition_variable changed;  // the first line is answered, nothing is in work, or the input has ended
};

SceneService::SceneService(StoredEvaluations& evaluations, ReadScene read, int jobs)
    : evaluations_(evaluations), read_(std::move(read)) {
  const std::size_t count = jobs_for(jobs, static_cast<std::size_t>(-1));
  cores_each_ = cores_for_each(count);
  idle_ = count;
  for (std::size_t job = 0; job < count; ++job) threads_.emplace_back([this] { work(); });
}

SceneService::~SceneService() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  asked_.notify_all();
}

/// Works on the next line of a client on the calling thread, without the lock.
void SceneService::take(const std::shared_ptr<Client>& client, std::unique_lock<std::mutex>& lock) {
  Answer next = std::move(client->waiting.front());
  client->waiting.pop_front();
  ++client->in_work;
  lock.unlock();
  {
    const Interruptible until([&] { return client->is_over(); });
    next();
  }
  lock.lock();
  --client->in_work;
  if (client->in_work == 0 || client->first_is_ready()) client->changed.notify_all();
}

void SceneService::work() {
  limit_threads(cores_each_);
  std::unique_lock lock(mutex_);
  for (;;) {
    auto next = clients_.end();
    const auto found = [&] {
      next = find_if(clients_, [](const auto& client) { return !client->waiting.empty() && !client->is_over(); });
      return next != clients_.end();
    };
    asked_.wait(lock, [&] { return ending_ || found(); });
    if (!found()) return;
    --idle_;
    const std::shared_ptr<Client> client = *next;
    clients_.splice(clients_.end(), clients_, next);
    take(client, lock);
    ++idle_;
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
    RollingScene read = read_(object, place);
    if (read.memory_limit.value_or(0) > usual_memory_limit())
      throw std::invalid_argument(message_text(place, ": memory_limit = ", *read.memory_limit,
                                               ": must be <= ", usual_memory_limit(), ", what a scene may take here"));
    scene = std::move(read);
    return solution_line(evaluations_(*scene), one_line(id));
  } catch (const std::bad_alloc&) {
    return one_line({{"id", id}, {"line", line}, {"error", place + ": there is no memory left for it"}});
  } catch (const std::exception& error) {
    if (scene) throw;  // the store failed, or nobody waits for it
    return one_line({{"id", id}, {"line", line}, {"error", error.what()}});
  }
}

/// Queues a line as soon as there is room. @return false if nobody waits for its answer
bool SceneService::ask(Client& client, std::size_t line, std::string text) {
  const std::size_t most = most_in_work_per_job * threads_.size(), bytes = text.size();
  Answer question([this, line, text = std::move(text)] { return answer(line, text); });
  std::unique_lock lock(mutex_);
  const auto has_room = [&] {
    return client.is_over() || client.lines.empty() ||
           (client.lines.size() < most && client.bytes + bytes <= most_bytes_of_one && bytes_ + bytes <= most_bytes);
  };
  while (!written_.wait_for(lock, at_times, has_room)) {
  }
  if (client.is_over()) return false;
  bytes_ += bytes;
  client.bytes += bytes;
  client.lines.push_back({question.get_future(), bytes});
  client.waiting.push_back(std::move(question));
  asked_.notify_one();
  return true;
}

void SceneService::read_ahead(Client& client, std::istream& in) {
  std::size_t line = 0;
  try {
    while (std::optional<std::string> text = next_line(in)) {
      ++line;
      if (!blank(*text) && !ask(client, line, std::move(*text))) break;
    }
  } catch (const std::bad_alloc&) {
    client.broken = true;
  }
  const std::lock_guard lock(mutex_);
  client.at_end = true;
  client.changed.notify_all();
}

/// Writes the answers that there are, at least one. @return false if none follows
bool SceneService::write_next(Client& client, std::ostream& out) {
  std::unique_lock lock(mutex_);
  while (!client.first_is_ready()) {
    if (client.is_over() || (client.at_end && client.lines.empty())) return false;
    if (client.in_work == 0 && idle_ == 0 && !client.waiting.empty()) {  // all threads are taken by others
      const auto self = find_if(clients_, [&](const auto& one) { return one.get() == &client; });
      take(*self, lock);
    } else {
      client.changed.wait_for(lock, at_times);
    }
  }
  std::string written;
  for (std::size_t still = most_in_work_per_job * threads_.size(); still > 0 && client.first_is_ready(); --still) {
    written += client.lines.front().answer.get() + '\n';
    bytes_ -= client.lines.front().bytes;
    client.bytes -= client.lines.front().bytes;
    client.lines.pop_front();
  }
  lock.unlock();
  written_.notify_all();
  evaluations_.flush();  // what is written is stored before
  evaluations_.forget();
  out << written << std::flush;
  return static_cast<bool>(out);
}

void SceneService::serve(std::istream& in, std::ostream& out, const std::atomic<bool>& gone) {
  limit_threads(cores_each_);  // where it solves, too
  const auto client = std::make_shared<Client>(gone);
  std::list<std::shared_ptr<Client>>::iterator place;
  {
    const std::lock_guard lock(mutex_);
    place = clients_.insert(clients_.end(), client);
  }
  const auto leave = [&] {
    std::unique_lock lock(mutex_);
    client->broken = true;
    client->waiting.clear();
    for (const Client::Line& line : client->lines) bytes_ -= line.bytes;
    client->lines.clear();
    clients_.erase(place);
    written_.notify_all();
    client->changed.wait(lock, [&] { return client->in_work == 0; });
  };
  std::jthread reader;
  try {
    reader = std::jthread([&] { read_ahead(*client, in); });
    while (write_next(*client, out)) {
    }
    leave();
  } catch (const Interrupted&) {
    leave();
  } catch (const std::bad_alloc&) {  // the end of this client alone
    leave();
  } catch (const std::system_error&) {  // there is no thread for the reader
    leave();
    throw;
  } catch (...) {
    failed_ = true;
    leave();
    throw;
  }
}

}  // namespace rollres
