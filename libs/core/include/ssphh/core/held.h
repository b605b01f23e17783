#pragma once

#include <memory>

#include <ssphh/core/require.h>

namespace ssphh {

/// What a movable object owns. An object that was moved from can be assigned to and destroyed; any other use
/// of it is an Error.
template <class T>
class Held {
 public:
  Held() = default;
  Held(std::unique_ptr<T> value) : value_(std::move(value)) {}
  T& operator*() const {
    require(value_ != nullptr, "moved object", "it was moved from and holds nothing");
    return *value_;
  }
  T* operator->() const { return &**this; }
  T* get() const { return value_.get(); }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace ssphh
