#include "gltf_accessor.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "printable.h"

namespace ssphh::scene_io {
namespace {

enum class ComponentType { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

ComponentType component_type(const json::Cursor& object) {
  const json::Cursor type = object["componentType"];
  const auto code = type.unsigned_integer();
  if (code < 5120 || code > 5126 || code == 5124) type.fail(fmt::format("{} is no component type", code));
  return static_cast<ComponentType>(code);
}

std::uint64_t component_size(ComponentType type) {
  if (type == ComponentType::i8 || type == ComponentType::u8) return 1;
  return type == ComponentType::i16 || type == ComponentType::u16 ? 2 : 4;
}

int component_count(const json::Cursor& accessor, bool matrices = false) {
  const json::Cursor type = accessor["type"];
  const std::string& name = type.text();
  if (name == "SCALAR") return 1;
  if (name.size() == 4 && name.starts_with("VEC") && name[3] >= '2' && name[3] <= '4') return name[3] - '0';
  if (matrices && name == "MAT4") return 16;
  if (name == "MAT2" || name == "MAT3" || name == "MAT4") type.fail("a matrix is not expected here");
  type.fail(fmt::format("\"{}\" is no accessor type", printable(name, 40)));
}

template <class T>
T load(const std::byte* p) {
  T v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

template <class T>
float integer_to_float(T v, bool normalized) {
  if (!normalized) return static_cast<float>(v);
  return std::max(static_cast<float>(v) / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float to_float(const std::byte* p, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::i8:
      return integer_to_float(load<std::int8_t>(p), normalized);
    case ComponentType::u8:
      return integer_to_float(load<std::uint8_t>(p), normalized);
    case ComponentType::i16:
      return integer_to_float(load<std::int16_t>(p), normalized);
    case ComponentType::u16:
      return integer_to_float(load<std::uint16_t>(p), normalized);
    case ComponentType::u32:
      return integer_to_float(load<std::uint32_t>(p), normalized);
    case ComponentType::f32:
      return load<float>(p);
  }
  return 0;
}

std::uint32_t to_index(const std::byte* p, ComponentType type) {
  if (type == ComponentType::u8) return load<std::uint8_t>(p);
  return type == ComponentType::u16 ? load<std::uint16_t>(p) : load<std::uint32_t>(p);
}

bool is_index_type(ComponentType type) {
  return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

// Elements in a buffer view, checked to lie inside it.
struct Elements {
  const std::byte* first = nullptr;
  std::uint64_t stride = 0, component_bytes = 0;
  const std::byte* at(std::uint64_t element, int component) const {
    return first + element * stride + static_cast<std::uint64_t>(component) * component_bytes;
  }
};

Elements elements(GltfDocument& document, const json::Cursor& owner, int view_index, std::uint64_t count,
                  int components, ComponentType type) {
  const auto view = document.buffer_view(view_index);
  const std::uint64_t component_bytes = component_size(type);
  const std::uint64_t element_bytes = component_bytes * static_cast<std::uint64_t>(components);
  const auto offset_member = owner.find("byteOffset");
  const std::uint64_t offset = offset_member ? offset_member->unsigned_integer() : 0;
  const std::uint64_t stride = view.stride == 0 ? element_bytes : view.stride;
  if (stride < element_bytes) {
    owner.fail(fmt::format("elements of {} bytes do not fit the byteStride {}", element_bytes, stride));
  }
  const std::uint64_t size = view.bytes.size();
  if (offset > size || (count > 0 && (size - offset < element_bytes ||
                                      (size - offset - element_bytes) / stride < count - 1))) {
    owner.fail(fmt::format("{} elements from byte {} do not fit bufferViews[{}] of {} bytes", count, offset,
                           view_index, size));
  }
  return {view.bytes.data() + offset, stride, component_bytes};
}

// Calls set(element, bytes) for each replaced element.
template <class Set>
void apply_sparse(GltfDocument& document, const json::Cursor& accessor, std::uint64_t count, int components,
                  ComponentType type, const Set& set) {
  const auto sparse = accessor.find("sparse");
  if (!sparse) return;
  const std::uint64_t changed = (*sparse)["count"].unsigned_integer(count);
  const json::Cursor indices = (*sparse)["indices"], values = (*sparse)["values"];
  const ComponentType index_type = component_type(indices);
  if (!is_index_type(index_type)) indices.fail("the componentType must be an unsigned integer");
  const auto view_of = [&](const json::Cursor& part) {
    return part["bufferView"].index(document.count("bufferViews"), "bufferViews");
  };
  const Elements index_elements = elements(document, indices, view_of(indices), changed, 1, index_type);
  const Elements value_elements = elements(document, values, view_of(values), changed, components, type);
  for (std::uint64_t i = 0; i < changed; ++i) {
    const std::uint64_t element = to_index(index_elements.at(i, 0), index_type);
    if (element >= count) {
      indices.fail(fmt::format("element {} is {}, the accessor has {}", i, element, count));
    }
    set(element, value_elements, i);
  }
}

}  // namespace

std::uint64_t accessor_element_bytes(const json::Cursor& accessor) {
  const std::uint64_t bytes = component_size(component_type(accessor));
  const std::string& type = accessor["type"].text();
  // Columns of matrices begin at multiples of four bytes
  if (type.starts_with("MAT") && type.size() == 4 && type[3] >= '2' && type[3] <= '4') {
    const auto n = static_cast<std::uint64_t>(type[3] - '0');
    return n * ((n * bytes + 3) & ~std::uint64_t{3});
  }
  return bytes * static_cast<std::uint64_t>(component_count(accessor));
}

FloatArray read_floats(GltfDocument& document, int index, int min_components, int max_components) {
  const json::Cursor accessor = document.item("accessors", index);
  FloatArray out;
  out.components = component_count(accessor, max_components == 16);
  if (out.components < min_components || out.components > max_components) {
    accessor.fail(fmt::format("has {} components where {} are expected", out.components,
                              min_components == max_components
                                  ? std::to_string(min_components)
                                  : fmt::format("{} to {}", min_components, max_components)));
  }
  const ComponentType type = component_type(accessor);
  const bool normalized = accessor.boolean_or("normalized", false);
  const auto components = static_cast<std::uint64_t>(out.components);
  out.count = accessor["count"].unsigned_integer(std::numeric_limits<std::uint32_t>::max() - 1);

  Elements source;
  if (const auto view = document.reference(accessor, "bufferView", "bufferViews")) {
    source = elements(document, accessor, *view, out.count, out.components, type);
  }
  document.charge(out.count * components * sizeof(float), accessor);
  out.values.resize(out.count * components);
  if (source.first && type == ComponentType::f32 && source.stride == components * sizeof(float)) {
    if (out.count > 0) std::memcpy(out.values.data(), source.first, out.values.size() * sizeof(float));
  } else if (source.first) {
    for (std::uint64_t i = 0; i < out.count; ++i) {
      for (int c = 0; c < out.components; ++c) {
        out.values[i * components + static_cast<std::uint64_t>(c)] =
            to_float(source.at(i, c), type, normalized);
      }
    }
  }
  apply_sparse(document, accessor, out.count, out.components, type,
               [&](std::uint64_t element, const Elements& values, std::uint64_t i) {
                 for (int c = 0; c < out.components; ++c) {
                   out.values[element * components + static_cast<std::uint64_t>(c)] =
                       to_float(values.at(i, c), type, normalized);
                 }
               });
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    if (!std::isfinite(out.values[i]))
      accessor.fail(fmt::format("element {} is NaN or infinite", i / components));
  }
  return out;
}

std::vector<std::uint32_t> read_indices(GltfDocument& document, int index) {
  const json::Cursor accessor = document.item("accessors", index);
  const ComponentType type = component_type(accessor);
  if (component_count(accessor) != 1 || !is_index_type(type))
    accessor.fail("indices must be unsigned scalars");
  const std::uint64_t count =
      accessor["count"].unsigned_integer(std::numeric_limits<std::uint32_t>::max() - 1);
  Elements source;
  if (const auto view = document.reference(accessor, "bufferView", "bufferViews")) {
    source = elements(document, accessor, *view, count, 1, type);
  }
  document.charge(count * sizeof(std::uint32_t), accessor);
  std::vector<std::uint32_t> out(count, 0);
  for (std::uint64_t i = 0; source.first && i < count; ++i) out[i] = to_index(source.at(i, 0), type);
  apply_sparse(document, accessor, count, 1, type,
               [&](std::uint64_t element, const Elements& values, std::uint64_t i) {
                 out[element] = to_index(values.at(i, 0), type);
               });
  return out;
}

}  // namespace ssphh::scene_io
