#include <algorithm>

#include <ssphh/core/error.h>
#include <ssphh/image/io.h>
#include <ssphh/metrics/mask.h>
#include <ssphh/report/plan.h>

namespace ssphh::report {

void load_masks(Plan& plan, const std::filesystem::path& folder) {
  for (PlanScene& scene : plan.scenes) {
    for (Inset& inset : scene.insets) {
      if (inset.mask_file.empty()) continue;
      const std::filesystem::path beside = folder / inset.mask_file;
      inset.mask = image::read_image(
          std::filesystem::exists(beside) ? beside : std::filesystem::path(inset.mask_file));
      const int width = inset.mask.width, height = inset.mask.height;
      int left = width, right = 0, top = height, bottom = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          if (!metrics::in_mask(inset.mask, x, y, width, height)) continue;
          left = std::min(left, x), right = std::max(right, x + 1);
          top = std::min(top, y), bottom = std::max(bottom, y + 1);
        }
      }
      if (left >= right) throw Error(inset.mask_file, "has no white pixel", "white is what is measured");
      inset.x0 = static_cast<double>(left) / width, inset.x1 = static_cast<double>(right) / width;
      inset.y0 = static_cast<double>(top) / height, inset.y1 = static_cast<double>(bottom) / height;
    }
  }
}

}  // namespace ssphh::report
