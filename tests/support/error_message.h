#pragma once
/// What an error says.

#include <string>

#include <ssphh/core/error.h>

namespace ssphh::test {

/// The message of the Error that `action` throws; "no error" when it throws none.
template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace ssphh::test
