#include "farm_client.h"

#include <chrono>
#include <thread>
#include <utility>

#include <ssphh/core/error.h>

namespace ssphh::viewer {

FarmClient::FarmClient(const farm::FarmOptions& options, OwnFarm own)
    : options_(options), own_(std::move(own)) {
  auto watch = std::make_shared<farm::StatusWatch>(options.broker);
  watch_.start("farm", [this, watch](const Control& control) -> BackgroundJob::Finish {
    while (true) {
      try {
        const farm::FarmStatus status = watch->look(control);
        watch_.hand_over([this, figures = figures_of(status), rate = status.per_second] {
          figures_ = figures, per_second_ = rate;
          lost_ = false;
        });
      } catch (const Error&) {
        watch_.hand_over([this] { lost_ = true; });
      }
      for (int i = 0; i < 20; ++i) {
        control.check();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
  });
}

}  // namespace ssphh::viewer
