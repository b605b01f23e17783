#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

void draw_truth(App& app) {
  heading("Ground truth");
  setting_widget(app, "show", "show");
  if (app.settings.show == Show::wipe) setting_slider(app, "line", "wipe", 0, 1);
  if (app.settings.show == Show::pixelated) setting_slider(app, "block [pixels]", "block", 1, 64, "%.0f");
  setting_widget(app, "against", "against");
  setting_slider(app, "bounces", "truth-depth", 1, 32, "%.0f");
  setting_slider(app, "samples", "truth-spp", 1, 4096, "%.0f");
  if (!needs_truth(app.settings)) {
    note("Press T to see path tracing, or another method, beside the picture.");
    return;
  }
  const ReferenceImage& truth = app.reference.image();
  const float share = static_cast<float>(truth.passes) / static_cast<float>(app.settings.truth_passes);
  ImGui::ProgressBar(share, {-1, 0},
                     fmt::format("{} of {} samples", truth.passes, app.settings.truth_passes).c_str());
  const auto& difference = app.picture.shown_difference();
  if (!difference || app.settings.debug == DebugView::leak) return;
  const metrics::ImageError& e = difference->error;
  ImGui::TextWrapped("relMSE  %.4g", e.relmse);
  ImGui::TextWrapped("mean |difference|  %.4g", e.mae);
  ImGui::TextWrapped("mean ratio  %.3f %.3f %.3f", e.mean_ratio[0], e.mean_ratio[1], e.mean_ratio[2]);
  ImGui::TextWrapped("last colour  %.3g", static_cast<double>(difference->scale));
  note("The truth's noise counts as difference: let it take some hundred samples.");
}

}  // namespace

void draw_picture_panel(App& app) {
  heading("Picture");
  if (tick_row("automatic", &app.settings.auto_exposure)) app.redraw();
  tip("The exposure follows what suits the picture; key \\");
  setting_slider(app, "exposure", "exposure", -12, 8, "%+.2f EV");
  setting_widget(app, "tone curve", "tonemap");
  setting_widget(app, "debug view", "debug");
  if (app.settings.debug == DebugView::leak)
    note("Looked-up indirect light on places where path tracing finds next to none, as it comes in.");
  setting_widget(app, "histogram (J)", "histogram");
  setting_widget(app, "waveform (U)", "waveform");
  setting_widget(app, "false colours (K)", "false-color");
  setting_widget(app, "method's marks", "draw");
  if (app.marks.status().running) note(fmt::format("drawing {} …", app.marks.status().stage));
  setting_widget(app, "smooth edges", "antialias");
  setting_slider(app, "pixels", "scale", 0.25f, 2, "× %.2f");
  setting_slider(app, "probe light at", "indirect-scale", 1, 8, "1 of %.0f pixels");
  draw_truth(app);
  heading("Files");
  if (wide_button("Save picture as…")) app.ask_for_file(FileDialog::For::picture);
  tip("What is seen as a .png, or its linear radiance as an .exr.");
  if (wide_button("Save scene as…")) app.ask_for_file(FileDialog::For::scene);
}

}  // namespace ssphh::viewer
