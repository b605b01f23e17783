#include "style.h"

#include <filesystem>

#include <imgui.h>

namespace ssphh::viewer {
namespace {

// Debian's fonts-dejavu-core; ImGui's own small bitmap font stands in where it is missing.
constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

ImVec4 grey(float v, float alpha = 1) {
  return {v, v, v * 1.03f, alpha};
}

}  // namespace

void load_font(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  // Latin, Greek and the signs that the panels use.
  static const ImWchar ranges[] = {0x20,   0xff,   0x370,  0x3ff,  0x2013, 0x2044, 0x2080, 0x208e,
                                   0x2190, 0x2193, 0x2212, 0x2265, 0x25a0, 0x25ff, 0};
  std::error_code ignored;
  if (std::filesystem::exists(font_file, ignored)) {
    io.Fonts->AddFontFromFileTTF(font_file, 14 * scale, nullptr, ranges);
  } else {
    ImFontConfig config;
    config.SizePixels = 13 * scale;
    io.Fonts->AddFontDefault(&config);
  }
}

void apply_look(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.TabRounding = style.PopupRounding = 3;
  style.WindowBorderSize = 0;
  style.FramePadding = {7, 4};
  style.ItemSpacing = {7, 6};
  style.WindowPadding = {10, 10};
  style.ScrollbarSize = 12;
  style.GrabMinSize = 12;
  const ImVec4 accent{0.91f, 0.62f, 0.22f, 1}, accent_dim{0.91f, 0.62f, 0.22f, 0.45f};
  ImVec4* c = style.Colors;
  c[ImGuiCol_WindowBg] = grey(0.11f);
  c[ImGuiCol_PopupBg] = grey(0.14f, 0.98f);
  c[ImGuiCol_MenuBarBg] = grey(0.08f);
  c[ImGuiCol_FrameBg] = grey(0.19f);
  c[ImGuiCol_FrameBgHovered] = grey(0.25f);
  c[ImGuiCol_FrameBgActive] = grey(0.28f);
  c[ImGuiCol_Button] = grey(0.23f);
  c[ImGuiCol_ButtonHovered] = grey(0.31f);
  c[ImGuiCol_ButtonActive] = accent_dim;
  c[ImGuiCol_Header] = grey(0.2f);
  c[ImGuiCol_HeaderHovered] = grey(0.27f);
  c[ImGuiCol_HeaderActive] = grey(0.3f);
  c[ImGuiCol_Tab] = grey(0.14f);
  c[ImGuiCol_TabHovered] = accent_dim;
  c[ImGuiCol_TabActive] = grey(0.27f);
  c[ImGuiCol_CheckMark] = c[ImGuiCol_SliderGrab] = c[ImGuiCol_PlotHistogram] = c[ImGuiCol_PlotLines] = accent;
  c[ImGuiCol_SliderGrabActive] = {1, 0.75f, 0.4f, 1};
  c[ImGuiCol_TextSelectedBg] = accent_dim;
  c[ImGuiCol_Separator] = grey(0.22f);
  c[ImGuiCol_TextDisabled] = grey(0.55f);
  style.ScaleAllSizes(scale);
}

}  // namespace ssphh::viewer
