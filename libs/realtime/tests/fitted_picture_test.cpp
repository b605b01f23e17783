/// What is drawn from a few fitted points is the CPU's lookup, pixel by pixel and in colour: where points are
/// few, each one's weight shows.

#include <functional>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "straight_view.h"

namespace ssphh::realtime {
namespace {

/// A square floor of 3.2 m, its frame's z axis up; points on it, each with a probe of its own.
class FittedPicture : public test::WithGl {
 protected:
  void stand(const vec3& up) {
    view_ = {Frame::around(glm::normalize(up)), 3};
    probes_ = {};
    probes_.set.fitted.emplace();
  }
  /// At `local`, facing `normal`, both in the floor's frame.
  void add(const vec3& local, const vec3& normal = {0, 0, 1}, const vec3& scale = vec3(1)) {
    const Frame& f = view_.frame;
    probes_.add(f.to_world(local + vec3(0, 0, 1)), scale);
    probes::FittedPoints& fitted = *probes_.set.fitted;
    fitted.points.push_back({f.to_world(local), glm::normalize(f.to_world(normal))});
    fitted.weights.emplace_back().add(static_cast<int>(probes_.set.probes.size()) - 1, 1);
  }

  /// The CPU leaves out a thousandth of the weight, normals come in steps of 1/32767 on an octahedron, and
  /// halves round.
  void expect_the_cpus_lookup(
      const std::string& what,
      const std::function<bool(const vec2&)>& skip = [](const vec2&) { return false; }) {
    const Frame& f = view_.frame;
    scene::Scene scene = coloured(scene::make_quad(f.to_world({-1.6f, -1.6f, 0}), 3.2f * f.x, 3.2f * f.y));
    if (wide_) {
      scene.meshes.push_back(scene::make_quad(f.to_world({3000, 3000, 0}), f.x, f.y));
      scene.meshes.back().material = 0;
      scene.instances.push_back(scene.instances.back());
      scene.instances.back().mesh = 1;
    }
    const probes::FittedPoints& fitted = *probes_.set.fitted;
    Renderer renderer(gl(), scene);
    renderer.set_probes(probes_.set);
    const probes::FittedSurfaces surfaces = probes::prepare_fitted(scene, 0, fitted, everything_sees);
    EXPECT_EQ(surfaces.surfaces.grids[1].count() > 0, wide_) << "whether there are two grids";
    renderer.set_fitted(surfaces);
    const image::Image drawn = view_.draw(renderer);
    const probes::IrradianceLookup lookup(
        probes_.set, probes::make_weights(probes_.positions(), everything_sees, {}, &fitted));
    Worst worst;
    for (int y = 0; y < view_.side; ++y) {
      for (int x = 0; x < view_.side; ++x) {
        const vec2 p = view_.place(x, y);
        if (skip(p)) continue;
        worst.take(drawn.rgb(x, y), reflected(lookup.irradiance({f.to_world({p, 0}), f.z})));
      }
    }
    for (int c = 0; c < 3; ++c) EXPECT_LT(worst.share()[c], 0.02f) << what << ", channel " << c;
  }

  bool wide_ = false;  ///< whether something else lies kilometres away

 private:
  StraightView view_;
  MadeUpProbes probes_;
};

TEST_F(FittedPicture, WeighsNinePointsAsTheCpuDoes) {
  for (const vec3& up : {vec3(0, 1, 0), vec3(0.3f, 0.8f, -0.5f)}) {
    stand(up);
    // Not on a grid, so that no two are equally far from anything.
    for (int i = 0; i < 9; ++i)
      add({static_cast<float>(i % 3) - 1 + 0.03f * static_cast<float>(i), static_cast<float>(i / 3) - 1, 0},
          {0, 0, 1}, vec3(1 + i, 10 - i, 1 + i % 4));
    expect_the_cpus_lookup("nine points");
  }
}

TEST_F(FittedPicture, OfAWideSceneIsFoundInSmallCellsWherePointsAreDenseAndInLargeOnesElsewhere) {
  stand({0, 1, 0});
  wide_ = true;
  for (int i = 0; i < 25; ++i)
    add({0.25f * static_cast<float>(i % 5) - 1.4f + 0.01f * static_cast<float>(i % 7),
         0.25f * static_cast<float>(i / 5) - 1.4f, 0},
        {0, 0, 1}, vec3(5 + i % 9, 10 - i % 5, 4 + i % 4));
  for (int i = 0; i < 8; ++i)
    add({0.9f * static_cast<float>(i % 2) + 0.5f, 0.8f * static_cast<float>(i / 2) - 1.3f, 0}, {0, 0, 1},
        vec3(5 + i, 10 - i, 5 + i % 4));
  expect_the_cpus_lookup("25 points and eight");
}

TEST_F(FittedPicture, LeavesOutPointsThatAreTiltedByMoreThanFortyFiveDegrees) {
  // 0.7 is the cosine of 45.6°.
  for (const auto& [normal, degrees] :
       {std::pair(vec3(0, 11, 20), "28.8 degrees"), std::pair(vec3(0, 15, 16), "43.2 degrees"),
        std::pair(vec3(0, 16, 15), "46.8 degrees"), std::pair(vec3(0, 20, 11), "61.2 degrees")}) {
    stand({0, 0, 1});
    for (int i = 0; i < 4; ++i) add({static_cast<float>(i % 2) - 0.5f, static_cast<float>(i / 2) - 0.5f, 0});
    for (int i = 0; i < 3; ++i) add({static_cast<float>(i) - 1, 0.02f, 0}, normal, vec3(3, 4, 5));
    expect_the_cpus_lookup(degrees);
  }
}

TEST_F(FittedPicture, LeavesOutPointsThatStandOffThePlane) {
  // Up to half a spacing, of 1 m, and a tenth of the distance; but for pixels where rounding decides.
  for (const float height : {0.5f, 0.6f, 0.65f, 0.8f}) {
    stand({0, 0, 1});
    for (int i = 0; i < 9; ++i) add({static_cast<float>(i % 3) - 1, static_cast<float>(i / 3) - 1, 0});
    add({0.1f, 0.1f, height}, {0, 0, 1}, vec3(5, 4, 3));
    add({0.1f, 0.1f, -height}, {0, 0, 1}, vec3(3, 5, 4));
    expect_the_cpus_lookup(std::to_string(height) + " m", [&](const vec2& p) {
      const float distance = glm::length(vec3(p - 0.1f, height));
      return std::abs(0.5f + 0.1f * distance - height) < 0.01f;
    });
  }
}

}  // namespace
}  // namespace ssphh::realtime
