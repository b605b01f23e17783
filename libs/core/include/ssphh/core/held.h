#pragma once

#include <ssphh/core/require.h>

namespace ssphh {

/// What a movable object owns. An object that was moved from can be assigned to and destroyed; any other use
/// of it is an Error.
template <class T>
class Held {
 public:
  Held() = default;
  /// Takes over from a std::unique_ptr. No type of <memory> is named: it is half of what a light header
  /// costs.
  template <class Owner>
  requires requires(Owner& owner, T*& mine) { mine = owner.release(); }
  Held(Owner owner) : value_(owner.release()) {}
  Held(Held&& other) noexcept : value_(other.value_) { other.value_ = nullptr; }
  Held& operator=(Held&& other) noexcept {
    T* const taken = other.value_;
    other.value_ = nullptr;
    destroy();
    value_ = taken;
    return *this;
  }
  ~Held() { destroy(); }

  T& operator*() const {
    require(value_ != nullptr, "moved object", "it was moved from and holds nothing");
    return *value_;
  }
  T* operator->() const { return &**this; }
  T* get() const { return value_; }

 private:
  void destroy() {
    static_assert(sizeof(T) > 0, "T is complete where its holder is destroyed");
    delete value_;
    value_ = nullptr;
  }

  T* value_ = nullptr;
};

}  // namespace ssphh
