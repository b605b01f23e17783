#pragma once
/// The textures of an export as image files, each written once.

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// All functions return the file's name inside the folder. Names are the project's own ("texture3.png"):
/// textures' names may hold anything.
class TextureFiles {
 public:
  /// The folder must exist, the scene outlive the object.
  TextureFiles(const scene::Scene& scene, std::filesystem::path directory);

  /// Colours times `factor`: the 8-bit values as they are (sRGB, or data of a normal map) as PNG where the
  /// factor is 1, else linear OpenEXR.
  std::string color(int texture, const vec3& factor = vec3(1));
  /// Colours times `factor`, linear OpenEXR.
  std::string linear_color(int texture, const vec3& factor);
  /// map(channel/255) three times, linear OpenEXR. `kind` names the file and must differ for every `map`.
  std::string channel(int texture, int channel, const std::string& kind,
                      const std::function<float(float)>& map);
  /// A linear image that is no texture.
  std::string image(const std::string& name, const image::Image& image);

  const std::vector<std::filesystem::path>& written() const { return written_; }

 private:
  std::string once(const std::string& key, const std::string& name,
                   const std::function<image::Image()>& make);

  const scene::Scene& scene_;
  std::filesystem::path directory_;
  std::map<std::string, std::string> names_;  ///< by what they hold
  std::vector<std::filesystem::path> written_;
};

}  // namespace ssphh::scene_io
