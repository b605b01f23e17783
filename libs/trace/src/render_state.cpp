#include <algorithm>
#include <array>
#include <cstring>

#include <ssphh/core/file.h>
#include <ssphh/trace/render_state.h>

namespace ssphh::trace {
namespace {

constexpr std::array<char, 8> magic{'S', 'S', 'P', 'H', 'H', 'R', 'S', '\n'};
constexpr std::uint32_t version = 1;

/// Fixed head of a checkpoint; then the float images in the order of the state, groups last, and a Hash128 of
/// all before it. Little-endian, as every machine this builds for.
struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::int32_t width, height, groups, passes_done;
  std::uint32_t reserved;
  std::uint64_t paths, rays;
  std::uint64_t key_high, key_low;
};
static_assert(sizeof(Header) == 64 && std::is_trivially_copyable_v<Header>);

/// All images of a state in file order, with their channel counts.
template <class State, class Visit>
void for_each_image(State& state, const Visit& visit) {
  for (const RenderLayer layer : render_layers()) {
    for (auto& image : images_of(state, layer)) visit(image, channels_of(layer));
  }
}

}  // namespace

std::span<const RenderLayer> render_layers() {
  static constexpr auto all = [] {
    std::array<RenderLayer, enum_names<RenderLayer>.size()> layers{};
    for (std::size_t i = 0; i < layers.size(); ++i) layers[i] = enum_names<RenderLayer>[i].value;
    return layers;
  }();
  return all;
}

std::span<image::Image> images_of(RenderState& state, RenderLayer layer) {
  switch (layer) {
    case RenderLayer::color:
      return {&state.color, 1};
    case RenderLayer::direct:
      return {&state.direct, 1};
    case RenderLayer::indirect:
      return {&state.indirect, 1};
    case RenderLayer::albedo:
      return {&state.albedo, 1};
    case RenderLayer::normal:
      return {&state.normal, 1};
    case RenderLayer::depth:
      return {&state.depth, 1};
    case RenderLayer::coverage:
      return {&state.coverage, 1};
    case RenderLayer::groups:
      return state.groups;
  }
  refuse("layer of a picture", "there is none of that number");
}

std::span<const image::Image> images_of(const RenderState& state, RenderLayer layer) {
  return images_of(const_cast<RenderState&>(state), layer);
}

int channels_of(RenderLayer layer) {
  return layer == RenderLayer::depth || layer == RenderLayer::coverage ? 1 : 3;
}

Hash128 render_key(const Hash128& scene_hash, float time, const RenderParams& params) {
  Hasher h;
  h.text("render").value(scene_hash.high).value(scene_hash.low).value(time);
  h.value(params.width).value(params.height).value(params.projection).value(params.per_group ? 1 : 0);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) h.value(params.camera.world[column][row]);
  }
  const scene::Camera& camera = params.camera.camera;
  h.value(camera.orthographic ? 1 : 0).value(camera.yfov).value(camera.yheight);
  h.value(params.path.max_depth).value(params.path.spp).value(params.path.seed);
  return h.finish();
}

Tile tile_of(const RenderParams& params) {
  return params.tile.width == 0 ? Tile{0, 0, params.width, params.height} : params.tile;
}

RenderState empty_state(const RenderParams& params, std::size_t light_groups) {
  RenderState state;
  const Tile tile = tile_of(params);
  if (params.per_group) state.groups.resize(light_groups);
  for_each_image(state, [&](image::Image& image, int channels) {
    image = image::Image(tile.width, tile.height, channels);
  });
  return state;
}

void paste(RenderState& whole, const RenderState& part, const Tile& tile) {
  std::vector<image::Image*> to;
  std::vector<const image::Image*> from;
  for_each_image(whole, [&](image::Image& i, int) { to.push_back(&i); });
  for_each_image(part, [&](const image::Image& i, int) { from.push_back(&i); });
  require(to.size() == from.size(), "tile", "the picture and its part keep different images");
  for (std::size_t k = 0; k < to.size(); ++k) {
    const image::Image& source = *from[k];
    require(source.width == tile.width && source.height == tile.height && source.channels == to[k]->channels,
            "tile", "an image of the part is not of its size");
    require(tile.x >= 0 && tile.y >= 0 && tile.x <= to[k]->width - tile.width &&
                tile.y <= to[k]->height - tile.height,
            "tile", "it does not lie inside the picture");
    const auto row_floats = static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(source.channels);
    for (int y = 0; y < tile.height; ++y)
      std::copy_n(source.at(0, y), row_floats, to[k]->at(tile.x, tile.y + y));
  }
  whole.paths += part.paths;
  whole.rays += part.rays;
}

image::Image resolve(const image::Image& sum, int passes_done) {
  image::Image mean = sum;
  const float scale = passes_done > 0 ? 1 / static_cast<float>(passes_done) : 0;
  for (float& v : mean.pixels) v *= scale;
  return mean;
}

void save_state(const RenderState& state, const std::filesystem::path& path) {
  Header header{magic,
                version,
                state.color.width,
                state.color.height,
                static_cast<std::int32_t>(state.groups.size()),
                state.passes_done,
                0,
                state.paths,
                state.rays,
                state.key.high,
                state.key.low};
  std::size_t floats = 0;
  for_each_image(state, [&](const image::Image& i, int channels) {
    require(i.width == header.width && i.height == header.height && i.channels == channels, "render state",
            "its images differ in size");
    floats += i.pixels.size();
  });
  std::vector<std::byte> data(sizeof(Header) + floats * sizeof(float) + sizeof(Hash128));
  std::memcpy(data.data(), &header, sizeof(Header));
  std::size_t at = sizeof(Header);
  for_each_image(state, [&](const image::Image& i, int) {
    const std::size_t bytes = i.pixels.size() * sizeof(float);
    if (bytes) std::memcpy(data.data() + at, i.pixels.data(), bytes);
    at += bytes;
  });
  const Hash128 hash = Hasher().bytes(std::span(data).first(at)).finish();
  std::memcpy(data.data() + at, &hash, sizeof(hash));
  write_file(path, data);
}

RenderState load_state(const std::filesystem::path& path, const Hash128& key) {
  const std::vector<std::byte> data = read_file(path, std::uint64_t{16} << 30);
  const auto damaged = [&](const std::string& problem) {
    return Error(path.string(), "not a usable render checkpoint: " + problem, "remove it to start afresh");
  };
  Header header;
  if (data.size() < sizeof(Header) + sizeof(Hash128)) throw damaged("the file is too short");
  std::memcpy(&header, data.data(), sizeof(Header));
  if (header.magic != magic) throw damaged("it does not begin as one");
  if (header.version != version)
    throw damaged("its version " + std::to_string(header.version) + " is unknown");
  Hash128 stored;
  std::memcpy(&stored, data.data() + data.size() - sizeof(Hash128), sizeof(Hash128));
  if (Hasher().bytes(std::span(data).first(data.size() - sizeof(Hash128))).finish() != stored)
    throw damaged("its checksum is wrong");

  // Sizes are checked against the file's before any image is made.
  constexpr std::int32_t limit = 1 << 20;
  if (header.width < 0 || header.height < 0 || header.width > limit || header.height > limit ||
      header.groups < 0 || header.groups > 256 || header.passes_done < 0) {
    throw damaged("its header makes no sense");
  }
  const std::uint64_t floats_per_pixel = 17 + 3 * static_cast<std::uint64_t>(header.groups);
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
  const std::uint64_t payload = data.size() - sizeof(Header) - sizeof(Hash128);
  if (pixels > payload || pixels * floats_per_pixel * sizeof(float) != payload)
    throw damaged("its size is wrong");
  if (Hash128{header.key_high, header.key_low} != key) {
    throw Error(path.string(), "the checkpoint belongs to another scene or other render parameters",
                "remove it, or repeat the options it was made with");
  }

  RenderState state;
  state.passes_done = header.passes_done;
  state.paths = header.paths, state.rays = header.rays;
  state.key = key;
  state.groups.resize(static_cast<std::size_t>(header.groups));
  std::size_t at = sizeof(Header);
  for_each_image(state, [&](image::Image& i, int channels) {
    i = image::Image(header.width, header.height, channels);
    const std::size_t bytes = i.pixels.size() * sizeof(float);
    if (bytes) std::memcpy(i.pixels.data(), data.data() + at, bytes);
    at += bytes;
  });
  return state;
}

}  // namespace ssphh::trace
