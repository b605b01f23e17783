#pragma once
/// `ssphh worker`: does jobs of a farm until it is stopped.

#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/farm/worker_pool.h>

#include "options/worker_settings.h"

namespace ssphh::app {

/// Logs that it is ready, and serves until `control` is cancelled or the pool's `idle_exit` has passed; a
/// broker that is not there is waited for. Calls set_thread_count(), which stays so: all jobs share what the
/// slots' own threads leave of the settings' threads. Throws Error as pool_options() and farm::run_workers()
/// do.
farm::WorkerPoolReport run_worker(const WorkerSettings& settings, const Control& control = {});

json::Value to_json(const farm::WorkerPoolReport& report, const WorkerSettings& settings);
std::string to_text(const farm::WorkerPoolReport& report, const WorkerSettings& settings);

}  // namespace ssphh::app
