#include "studies/text/file_kind.hpp"

#include <array>
#include <initializer_list>

namespace rollres {

namespace {

struct KindWords {
  std::string_view name, commands;
};
constexpr std::array<KindWords, 4> words{{{"a scene", "rollres solve and gradient take it"},
                                          {"a study", "rollres plan and sweep take it"},
                                          {"a design problem", "rollres optimise takes it"},
                                          {"a fit", "rollres fit takes it"}}};

bool has_one_of(const Json& object, std::initializer_list<const char*> keys) {
  return any_of(keys, [&](const char* key) { return object.contains(key); });
}

}  // namespace

void require_kind(FileKind wanted, const Json& object, const std::string& place) {
  FileKind kind = wanted;
  if (has_one_of(object, {"fit"}))
    kind = FileKind::fit;
  else if (has_one_of(object, {"variables", "minimise", "maximise"}))
    kind = FileKind::design;
  else if (has_one_of(object, {"study", "axes", "sample"}))
    kind = FileKind::study;
  else if (has_one_of(object, {"indenter", "radius", "layer_thickness"}))
    kind = FileKind::scene;
  if (kind == wanted) return;
  const KindWords &is = words[static_cast<std::size_t>(kind)], &is_not = words[static_cast<std::size_t>(wanted)];
  throw std::invalid_argument(place + ": is " + std::string(is.name) + ", not " + std::string(is_not.name) + ": " +
                              std::string(is.commands));
}

}  // namespace rollres
