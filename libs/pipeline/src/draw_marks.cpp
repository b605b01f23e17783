#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/pipeline/draw_marks.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/sketch/draw.h>
#include <ssphh/trace/primary_rays.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::pipeline {

void draw_marks(image::Image& picture, const sketch::Sketch& marks, const trace::SharedGeometry& geometry,
                const scene::Scene& scene, float time, const trace::RenderParams& params, float white,
                const Control& control) {
  require(picture.width == params.width && picture.height == params.height, "picture of marks",
          "its size is not that of its rendering");
  require(white > 0 && std::isfinite(white), "white of marks", "is no radiance over 0");
  const trace::TransportScene source(geometry, scene);
  const rays::PosedWorld world(source, time);
  sketch::Eye eye;
  eye.ray = [rays = trace::primary_rays(params)](float x, float y) -> sketch::Ray {
    const rays::RayQuery ray = rays(x, y);
    return {ray.origin, ray.direction};
  };
  eye.surfaces = [&world](std::span<const sketch::Ray> rays, std::span<float> distances) {
    std::vector<rays::RayQuery> queries;
    for (const sketch::Ray& ray : rays) queries.push_back({ray.origin, ray.direction});
    std::vector<rays::RayHit> hits(rays.size());
    world.intersect(queries, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) distances[i] = hits[i].distance;
  };
  sketch::draw(picture, marks, eye, {.white = white}, control);
}

}  // namespace ssphh::pipeline
