/// Tries the readers with files that were found to hurt and with random changes of them, and the solver with random
/// scenes. Every case runs in a child process: what ends it, or takes too long, is reported and written to a file.
///
///     rollres_fuzz replay CORPUS              every file of every target's folder
///     rollres_fuzz mutate CORPUS SECONDS SEED
///     rollres_fuzz census COUNT SEED          how often each input is drawn; a complaint where it is hardly ever
///     rollres_fuzz scenes COUNT SEED [TIME_LIMIT MEMORY_LIMIT]   absent: the scenes' own default limits
///     rollres_fuzz scene NUMBER SEED [TIME_LIMIT MEMORY_LIMIT]   one of them

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/numerics/recently_made.hpp"
#include "studies/run/forked_work.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "tests/fuzz/random_scenes.hpp"
#include "tests/fuzz/targets.hpp"

using namespace rollres;

namespace {

struct Sample {
  const FuzzTarget* target;
  std::string name, bytes;
};

std::vector<Sample> samples_in(const std::filesystem::path& corpus) {
  std::vector<Sample> samples;
  for (const FuzzTarget& target : fuzz_targets())
    for (const auto& entry : std::filesystem::directory_iterator(corpus / target.name)) {
      std::ifstream file(entry.path(), std::ios::binary);
      samples.push_back({&target, entry.path().string(), {std::istreambuf_iterator<char>(file), {}}});
    }
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return samples;
}

/// One to eight random changes of a sample.
std::string mutated(const std::vector<Sample>& samples, std::size_t which, std::mt19937_64& random) {
  static const std::vector<std::string> words{
      "1e308",   "-1e308",  "1e-310",       "-1",         "0",
      "1e999",   "NaN",     "null",         "\"\"",       "[]",
      "{}",      "[[[[",    "\"infinite\"", "2147483648", "-9223372036854775809",
      "\\u0000", "\x1b[2J", "\xff\xfe",     "'",          "]]>",
      ",",       ":",       "\n",           "..",         "%s",
      "1 mm",    "^^^^",    "(((("};
  std::string bytes = samples[which].bytes;
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(1, count));
  };
  for (std::size_t changes = 1 + below(8); changes > 0; --changes) {
    const std::size_t at = below(bytes.size() + 1), length = below(std::min<std::size_t>(bytes.size() - at, 64) + 1);
    switch (below(6)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 3:
        bytes.replace(at, length, words[below(words.size())]);
        break;
      case 4:  // a number or a word as a whole
        if (const auto from = bytes.find_first_of("0123456789", at); from != std::string::npos)
          bytes.replace(from, std::min(bytes.find_first_not_of("0123456789.eE+-", from), bytes.size()) - from,
                        words[below(words.size())]);
        break;
      default: {
        const std::string& other = samples[below(samples.size())].bytes;
        const std::size_t from = below(other.size() + 1);
        bytes.insert(at, other.substr(from, below(256)));
      }
    }
  }
  return bytes;
}

/// The most that was resident since the last call [bytes].
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) {
      std::ofstream("/proc/self/clear_refs") << 5;
      return 1024 * std::atof(line.c_str() + 6);
    }
  return NAN;
}

double processor_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// What may be resident of the memory allowed; the address sanitizer keeps what was freed for a while.
#ifdef __SANITIZE_ADDRESS__
constexpr double memory_share = 5;
#else
constexpr double memory_share = 1.1;
#endif

/// A quarter with ROLLRES_THIN in the environment.
double thinned(double amount) { return std::getenv("ROLLRES_THIN") ? amount / 4 : amount; }
/// Ten times as much there, as instrumented programs need.
double patience(double seconds) { return std::getenv("ROLLRES_THIN") ? 10 * seconds : seconds; }

int complaints = 0;

/// Says what a case did, and keeps it.
void complain(const std::string& what, const std::string& name, const std::string& bytes) {
  const std::string file = "found-" + name;
  std::ofstream(file, std::ios::binary) << bytes;
  std::cout << "FOUND " << file << ": " << what << std::endl;
  ++complaints;
}

/// Reads `case_of(0)`, `case_of(1)`, ... each in a child, until `more` says no.
template <class CaseOf, class More>
std::size_t read_all(std::size_t pieces, const CaseOf& case_of, const More& more, double seconds_each) {
  std::size_t done = 0;
  std::atomic<bool> stop = false;
  ForkedWork work{.pieces = pieces, .time_limit = seconds_each, .stop = &stop};
  work.work = [&](std::size_t piece) -> std::string {
    const Sample sample = case_of(piece);
    try {
      try_reading(*sample.target, sample.bytes);
    } catch (const std::exception& error) {
      return std::string("throws ") + error.what();
    }
    return {};
  };
  work.done = [&](const PieceEnd& end) {
    ++done;
    const std::string what = end.out_of_time ? "takes too long" : end.death.empty() ? end.answer : end.death;
    if (!what.empty()) {
      const Sample sample = case_of(end.piece);
      complain(what, std::string(sample.target->name) + "-" + std::to_string(end.piece), sample.bytes);
    }
    if (!more()) stop = true;
    return what.empty();
  };
  run_forked(work);
  return done;
}

void replay(const std::filesystem::path& corpus) {
  const std::vector<Sample> samples = samples_in(corpus);
  const auto done = read_all(
      samples.size(), [&](std::size_t piece) { return samples[piece]; }, [] { return true; }, 600);
  std::cout << done << " files replayed, " << complaints << " complaints" << std::endl;
}

void mutate(const std::filesystem::path& corpus, double seconds, std::uint64_t seed) {
  std::vector<Sample> samples = samples_in(corpus);
  const auto begin = std::chrono::steady_clock::now();
  const auto done = read_all(
      10'000'000,
      [&](std::size_t piece) {
        std::mt19937_64 random(seed * 1'000'003 + piece);
        const FuzzTarget& target = fuzz_targets()[random() % (fuzz_targets().size() - 1)];  // "solve" has its own run
        std::vector<std::size_t> own;
        for (std::size_t i = 0; i < samples.size(); ++i)
          if (samples[i].target == &target) own.push_back(i);
        return Sample{&target, "", mutated(samples, own[random() % own.size()], random)};
      },
      [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < seconds; }, 600);
  std::cout << done << " mutations, " << complaints << " complaints" << std::endl;
}

void solve_scenes(std::size_t first, std::size_t count, std::uint64_t seed, double time_limit, double memory_limit) {
  const auto scene_of = [&](std::size_t piece) {
    RollingScene scene = random_scene(seed * 1'000'003 + first + piece);
    if (time_limit > 0) scene.time_limit = time_limit;
    if (memory_limit > 0) scene.memory_limit = memory_limit;
    return scene;
  };
  const double time_allowed = time_limit > 0 ? time_limit : 60, memory_allowed = memory_limit > 0 ? memory_limit : 4e9;
  double longest = 0, largest = 0;
  std::map<std::string, int> ends;
  std::string limited;
  ForkedWork work{.pieces = count, .time_limit = 20 * time_allowed + 120};
  work.work = [&](std::size_t piece) {
    const RollingScene scene = scene_of(piece);
    forget_kernels();
    peak_memory();
    const double memory_before = peak_memory(), time_before = processor_seconds();
    std::string status = "none", wrong;
    try {
      const RollingSolution solution = solve(scene);
      status = name_of(solution.status);
      if (solution.reason.find("_limit") != std::string::npos) status += " within the limits";
      wrong = what_is_wrong(scene, solution);
    } catch (const std::exception& error) {
      wrong = std::string("throws ") + error.what();
    }
    std::ostringstream answer;
    answer << processor_seconds() - time_before << ' ' << peak_memory() - memory_before << ' ' << status << '\n'
           << wrong;
    return answer.str();
  };
  work.done = [&](const PieceEnd& end) {
    std::istringstream answer(end.answer);
    double seconds = 0, memory = 0;
    std::string status, wrong = end.out_of_time ? "takes too long" : end.death;
    if (wrong.empty() && answer >> seconds >> memory && std::getline(answer, status)) {
      std::getline(answer, wrong);
      ++ends[status];
      if (status.ends_with("limits")) limited += " " + std::to_string(first + end.piece);
    }
    longest = std::max(longest, seconds);
    largest = std::max(largest, memory);
    if (seconds > 1.1 * time_allowed + patience(0.5)) wrong += std::to_string(seconds) + " s of processor time; ";
    if (memory > memory_share * memory_allowed + 1e8) wrong += std::to_string(memory / 1e9) + " GB; ";
    if (!wrong.empty())
      complain(wrong, "scene-" + std::to_string(seed) + "-" + std::to_string(first + end.piece) + ".json",
               scene_json(scene_of(end.piece)));
    return wrong.empty();
  };
  run_forked(work);
  std::cout << count << " scenes:";
  for (const auto& [status, number] : ends) std::cout << " " << number << status << ",";
  std::cout << " longest " << longest << " s, largest " << largest / 1e9 << " GB, " << complaints << " complaints"
            << (limited.empty() ? "" : ", ended by a limit:" + limited) << std::endl;
}

/// One in a thousand scenes is the least that a run of a few thousand can learn from.
void count_inputs(std::size_t count, std::uint64_t seed) {
  std::map<std::string, std::size_t> drawn;
  for (std::size_t i = 0; i < count; ++i)
    for (const auto& [key, times] : drawn_inputs(random_scene(seed * 1'000'003 + i)))
      drawn[key] += static_cast<std::size_t>(times);
  for (const auto& [key, times] : drawn) {
    std::cout << times << " " << key << (1000 * times < count ? "  FOUND: hardly ever drawn" : "") << "\n";
    complaints += 1000 * times < count;
  }
}

}  // namespace

int main(int count, char** words) {
  const std::vector<std::string> said(words + 1, words + count);
  const auto number = [&](std::size_t place) { return place < said.size() ? std::atof(said[place].c_str()) : 0; };
  if (said.size() == 2 && said[0] == "replay")
    replay(said[1]);
  else if (said.size() == 4 && said[0] == "mutate")
    mutate(said[1], thinned(number(2)), static_cast<std::uint64_t>(number(3)));
  else if (said.size() == 3 && said[0] == "census")
    count_inputs(static_cast<std::size_t>(number(1)), static_cast<std::uint64_t>(number(2)));
  else if (said.size() >= 3 && said[0] == "scenes")
    solve_scenes(0, static_cast<std::size_t>(thinned(number(1))), static_cast<std::uint64_t>(number(2)),
                 patience(number(3)), number(4));
  else if (said.size() >= 3 && said[0] == "scene")
    solve_scenes(static_cast<std::size_t>(number(1)), 1, static_cast<std::uint64_t>(number(2)), patience(number(3)),
                 number(4));
  else
    return std::cerr << "replay CORPUS | mutate CORPUS SECONDS SEED | census COUNT SEED\n"
                        "scenes COUNT SEED [SECONDS BYTES] | scene NUMBER SEED [SECONDS BYTES]\n",
           2;
  return complaints > 0;
}
