#include "studies/scene_io/paper_scenes.hpp"

namespace rollres {

namespace {

constexpr PaperScene scenes[] = {
#include "paper_scenes.inc"
};

}  // namespace

std::span<const PaperScene> paper_scenes() { return scenes; }

}  // namespace rollres
