#include "studies/run/shared_contacts.hpp"

#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "db/rows/result_store.hpp"

namespace rollres {

namespace {

struct SharedContacts {
  std::mutex mutex;
  std::map<std::string, std::shared_future<RollingSolution>> answers;  ///< per metre, by the key of a metre's scene
};

}  // namespace

Evaluate once_for_widths(const Evaluate& evaluate) {
  return [evaluate, shared = std::make_shared<SharedContacts>()](const RollingScene& scene) {
    if (!scene.width) return evaluate(scene);
    const RollingScene metre = scene_per_metre(scene);
    std::promise<RollingSolution> promise;
    std::shared_future<RollingSolution> answer;
    bool first = false;
    {
      const std::lock_guard lock(shared->mutex);
      const auto [place, is_new] = shared->answers.try_emplace(evaluation_key(metre));
      if (is_new) place->second = promise.get_future().share();
      answer = place->second;
      first = is_new;
    }
    if (first) try {
        RollingSolution solution = evaluate(metre);
        solution.fields = {};
        promise.set_value(std::move(solution));
      } catch (...) {
        promise.set_exception(std::current_exception());
      }
    return answer_of_width(scene, answer.get());
  };
}

}  // namespace rollres
