#pragma once

/// Lists of the quantities that an object has, each with the member that holds its value.

#include <span>
#include <variant>

#include "core/scene/quantity.hpp"

namespace rollres {

/// A quantity, and which member of an `Object`, of one of the types `Values`, holds it.
template <class Object, class... Values>
struct ListedQuantity {
  Quantity quantity;
  std::variant<Values Object::*...> member;
};

/// Calls `visitor(quantity, value)` for each of a list, value being a reference to the object's member. Works on const
/// and non-const objects.
template <class Object, class Owner, class... Values, class Visitor>
void visit_listed(Object& object, std::span<const ListedQuantity<Owner, Values...>> list, Visitor&& visitor) {
  for (const auto& [quantity, member] : list) {
    const auto visit_if = [&](const auto* held) {
      if (held) visitor(quantity, object.**held);
    };
    (visit_if(std::get_if<Values Owner::*>(&member)), ...);
  }
}

}  // namespace rollres
