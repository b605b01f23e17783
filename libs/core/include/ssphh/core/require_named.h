#pragma once

#include <ssphh/core/enum_names.h>

namespace ssphh {

/// Throws Error(where, …) for a number that no value of the enum has, as a cast makes it.
template <class E>
void require_named(const char* where, E value) {
  for (const EnumName<E>& entry : enum_names<E>)
    if (entry.value == value) return;
  refuse(where, "there is none of that number");
}

}  // namespace ssphh
