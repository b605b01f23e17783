#include <fmt/format.h>
#include <imgui.h>

#include <ssphh/core/counted.h>
#include <ssphh/farm/engine.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

bool does_jobs(const std::string& service) {
  return service.starts_with("ssphh.jobs.");
}

void draw_jobs(const FarmClient& farm) {
  const farm::FarmFigures& f = *farm.figures();
  heading("Jobs");
  // Of all that the broker answers; questions such as the window's own are no jobs.
  std::uint64_t finished = 0;
  for (const farm::FarmFigures::Service& service : f.services)
    finished += does_jobs(service.name) ? service.finished : 0;
  ImGui::TextWrapped("%s queued, %llu running, %llu finished", counted(f.queued, "job").c_str(),
                     static_cast<unsigned long long>(f.running), static_cast<unsigned long long>(finished));
  if (f.retries > 0 || f.parked > 0)
    ImGui::TextWrapped("%s, %llu set aside", counted(f.retries, "retry", "retries").c_str(),
                       static_cast<unsigned long long>(f.parked));
  if (const auto rate = farm.jobs_per_second())
    ImGui::TextWrapped("%s", fmt::format("{:.1f} jobs a second", *rate).c_str());
}

/// The broker knows of the next jobs alone: what is left of a bake is told by the bake.
void draw_bake(App& app) {
  const JobStatus status = app.job.status();
  heading("Bake");
  std::string text = status.name;
  if (status.fraction >= 0) text += fmt::format(": {:.0f} %", 100 * status.fraction);
  if (status.stage_left && !app.farm->lost())
    text += fmt::format(", about {:.0f} s left", *status.stage_left);
  ImGui::TextWrapped("%s", text.c_str());
  if (wide_button("Bake here")) attempt(app, [&] { app.bake_here(); });
}

/// Those that do jobs, of this build or another; clients that hand out scenes count as workers as well.
void draw_workers(const farm::FarmFigures& f) {
  heading("Workers");
  int of_this_build = 0;
  if (ImGui::BeginTable("workers", 3)) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed);
    for (const farm::FarmFigures::Worker& worker : f.each_worker) {
      if (!does_jobs(worker.service)) continue;
      const bool ours = worker.service == farm::job_service();
      of_this_build += ours;
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(worker.name.c_str());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(
          (ours ? fmt::format("{} {:.0f} s", worker.state, worker.seconds) : std::string("another build"))
              .c_str());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(counted(worker.served, "job").c_str());
    }
    ImGui::EndTable();
  }
  if (of_this_build == 0)
    note(fmt::format("No worker of this build (engine {}) is there: bakes wait for one.", farm::engine_id()));
}

}  // namespace

void draw_farm_panel(App& app) {
  FarmClient& farm = *app.farm;
  heading("Broker");
  ImGui::TextWrapped("%s", farm.endpoint().c_str());
  const std::string failure = farm.failure();
  if (!failure.empty()) {
    note(failure + ". Bakes that go to it wait until it is started again.");
    if (wide_button("Start it again")) attempt(app, [&] { app.restart_farm(); });
  } else if (farm.lost()) {
    note("It does not answer. Bakes that go to it wait until it does.");
  }
  tick_row("at the farm", &farm.used);
  tip("Bakes that begin from now on, GEN and VIZ, go to its workers; else this machine does them.");
  if (farm.used && app.baking()) draw_bake(app);
  if (farm.lost()) return;
  if (!farm.figures()) return note("It has not answered yet.");
  draw_jobs(farm);
  draw_workers(*farm.figures());
}

}  // namespace ssphh::viewer
