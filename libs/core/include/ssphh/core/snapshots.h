#pragma once
/// A value that one thread makes anew, again and again, while others read the last finished one.

#include <atomic>
#include <cstdint>
#include <deque>

#include <ssphh/core/require.h>

namespace ssphh {

/// Holds copies of a value: the newest, which read() gives out, and others, of which publish() takes one that
/// nobody reads and makes it the newest. Nobody waits, nothing is allocated after the constructor.
///
///   Snapshots<probes::IrradianceLookup> light(lookup);
///   light.publish([&](probes::IrradianceLookup& next) { next.swap_light(set); });  // a worker
///   const auto now = light.read();                                                // a game's thread
///   now->irradiance(point);
template <class T>
class Snapshots {
  struct Copy {
    explicit Copy(const T& first) : value(first) {}
    T value;
    std::uint64_t version = 0;
    std::atomic<int> readers{0};
  };

 public:
  /// `copies`, 2 or more: 3 serve a reader that holds one at a time; readers that hold n at a time need n +
  /// 2, or publish() may find none free.
  explicit Snapshots(const T& first, int copies = 3) {
    require(copies >= 2, "snapshots", "they need two copies at least");
    for (int i = 0; i < copies; ++i) copies_.emplace_back(first);
    newest_ = &copies_.front();
  }
  Snapshots(const Snapshots&) = delete;
  Snapshots& operator=(const Snapshots&) = delete;

  /// What stays as it is while this lives; no longer than the Snapshots.
  class Reader {
   public:
    explicit Reader(Copy& copy) : copy_(&copy) {}
    Reader(Reader&& other) noexcept : copy_(other.copy_) { other.copy_ = nullptr; }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() {
      if (copy_) copy_->readers.fetch_sub(1);
    }
    const T& operator*() const { return get().value; }
    const T* operator->() const { return &get().value; }
    /// How many were published before it, itself included.
    std::uint64_t version() const { return get().version; }

   private:
    const Copy& get() const {
      require(copy_ != nullptr, "moved object", "it was moved from and holds nothing");
      return *copy_;
    }
    Copy* copy_;
  };

  /// The newest value, from any thread.
  Reader read() const {
    for (;;) {
      Copy* const copy = newest_.load();
      copy->readers.fetch_add(1);
      // Else it may have been taken for writing before this reader was counted.
      if (newest_.load() == copy) return Reader(*copy);
      copy->readers.fetch_sub(1);
    }
  }

  /// Calls write(T&) with an older value, which it brings up to date whole, and makes that the newest. False:
  /// readers hold all others; nothing was written, and the newest stays. Where `write` throws, too. One
  /// thread at a time.
  template <class Write>
  bool publish(const Write& write) {
    for (Copy& copy : copies_) {
      if (&copy == newest_.load() || copy.readers.load() > 0) continue;
      write(copy.value);
      copy.version = newest_.load()->version + 1;
      newest_.store(&copy);
      return true;
    }
    return false;
  }

 private:
  std::deque<Copy> copies_;
  std::atomic<Copy*> newest_;
};

}  // namespace ssphh
