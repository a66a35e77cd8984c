// SPDX-License-Identifier: MIT
#include "assets/gltf/accessor_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include <tiny_gltf.h>

namespace ego {
namespace {

/// Elements in a buffer view: where the first begins, how far apart, how many.
struct View {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

/// Checks that `count` elements of `size` bytes lie inside the buffer view. Null on failure.
View Locate(const tinygltf::Model& model, int view_index, std::size_t offset, std::size_t size,
            std::size_t count, bool strided) {
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size()) return {};
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) return {};
  const std::vector<unsigned char>& data =
      model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) return {};
  const std::size_t stride = strided && view.byteStride > 0 ? view.byteStride : size;
  if (size == 0 || stride < size || offset > view.byteLength) return {};
  const std::size_t room = view.byteLength - offset;
  if (count > 0 && (room < size || (count - 1) > (room - size) / stride)) return {};
  return {data.data() + view.byteOffset + offset, stride};
}

template <class T>
T Load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

double LoadNumber(const unsigned char* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const double v = Load<std::int8_t>(at);
      return normalized ? std::max(v / 127.0, -1.0) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const double v = Load<std::uint8_t>(at);
      return normalized ? v / 255.0 : v;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const double v = Load<std::int16_t>(at);
      return normalized ? std::max(v / 32767.0, -1.0) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const double v = Load<std::uint16_t>(at);
      return normalized ? v / 65535.0 : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return Load<std::uint32_t>(at);
    default:
      return static_cast<double>(Load<float>(at));
  }
}

std::size_t ComponentSize(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

/// Calls put(element, component, number) for every number of the accessor, sparse values last.
/// Returns why it cannot be read, empty when it was.
template <class Put>
std::string Visit(const tinygltf::Model& model, const tinygltf::Accessor& accessor, int components,
                  Put put) {
  const std::size_t size = ComponentSize(accessor.componentType);
  const auto per_element = static_cast<std::size_t>(components);
  // Columns of small-integer matrices are padded; no reader here needs those.
  const auto visit = [&](const View& view, std::size_t element, std::size_t at) {
    for (std::size_t c = 0; c < per_element; ++c) {
      put(element, c,
          LoadNumber(view.first + at * view.stride + c * size, accessor.componentType,
                     accessor.normalized));
    }
  };
  if (accessor.bufferView >= 0) {
    const View view = Locate(model, accessor.bufferView, accessor.byteOffset, size * per_element,
                             accessor.count, true);
    if (view.first == nullptr) return "runs past the end of its buffer view";
    for (std::size_t i = 0; i < accessor.count; ++i) visit(view, i, i);
  }
  if (!accessor.sparse.isSparse) return {};
  const auto& sparse = accessor.sparse;
  const std::size_t index_size = ComponentSize(sparse.indices.componentType);
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count ||
      sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 || index_size == 0) {
    return "has malformed sparse values";
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  const View indices =
      Locate(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
             index_size, count, false);
  const View values =
      Locate(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
             size * per_element, count, false);
  if (indices.first == nullptr || values.first == nullptr) {
    return "has sparse values past the end of their buffer view";
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double index =
        LoadNumber(indices.first + i * indices.stride, sparse.indices.componentType, false);
    if (!(index >= 0.0 && index < static_cast<double>(accessor.count))) {
      return "has a sparse index out of range";
    }
    visit(values, static_cast<std::size_t>(index), i);
  }
  return {};
}

/// The most elements that data of the file stand behind in any accessor; the count stops at
/// `enough`.
std::size_t MostBackedElements(const tinygltf::Model& model, std::size_t enough) {
  // How many elements of a size a view holds, whatever it says about itself.
  const auto holds = [&](int index, std::size_t size) -> std::size_t {
    if (index < 0 || static_cast<std::size_t>(index) >= model.bufferViews.size()) return 0;
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) return 0;
    const std::size_t data = model.buffers[static_cast<std::size_t>(view.buffer)].data.size();
    return std::min(view.byteLength, data) / std::max<std::size_t>(1, size);
  };
  std::size_t most = 0;
  for (const tinygltf::Accessor& accessor : model.accessors) {
    std::size_t backed = holds(accessor.bufferView, ComponentSize(accessor.componentType));
    if (accessor.sparse.isSparse) {
      backed = std::max(backed, holds(accessor.sparse.indices.bufferView,
                                      ComponentSize(accessor.sparse.indices.componentType)));
    }
    most = std::max(most, std::min(accessor.count, backed));
    if (most >= enough) break;
  }
  return most;
}

/// The accessor, checked for shape; null with a reason.
const tinygltf::Accessor* Find(const tinygltf::Model& model, int index, int components,
                               std::string& why) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    why = "refers to accessor " + std::to_string(index) + ", which the file does not have";
    return nullptr;
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components) {
    why = "has elements of another shape than the expected " + std::to_string(components) +
          " numbers";
    return nullptr;
  }
  if (accessor.count > kMaxElements) {
    why = "has " + std::to_string(accessor.count) + " elements; at most " +
          std::to_string(kMaxElements) + " are read";
    return nullptr;
  }
  // Both before anything is allocated for the elements.
  const std::size_t element =
      ComponentSize(accessor.componentType) * static_cast<std::size_t>(components);
  if (element == 0) {
    why = "has an unknown component type";
    return nullptr;
  }
  if (accessor.bufferView >= 0 &&
      Locate(model, accessor.bufferView, accessor.byteOffset, element, accessor.count, true)
              .first == nullptr) {
    why = "runs past the end of its buffer view";
    return nullptr;
  }
  // Zeros that no byte of the file stands for: as many as something else in it has, no more.
  if (accessor.bufferView < 0) {
    const std::size_t backed = MostBackedElements(model, accessor.count);
    if (accessor.count > backed) {
      why = "has " + std::to_string(accessor.count) +
            " elements and no buffer view, but the file " + "holds data for at most " +
            std::to_string(backed);
      return nullptr;
    }
  }
  return &accessor;
}

}  // namespace

Result<std::vector<float>> ReadNumbers(const tinygltf::Model& model, int accessor, int components,
                                       const std::string& what) {
  std::string why;
  const tinygltf::Accessor* source = Find(model, accessor, components, why);
  if (source == nullptr) return Error{what + " " + why};
  const auto per_element = static_cast<std::size_t>(components);
  std::vector<float> out(source->count * per_element, 0.0f);
  bool finite = true;
  why = Visit(model, *source, components, [&](std::size_t i, std::size_t c, double value) {
    finite = finite && std::isfinite(value);
    out[i * per_element + c] = static_cast<float>(value);
  });
  if (why.empty() && !finite) why = "holds a number that is not finite";
  if (!why.empty()) return Error{what + " " + why};
  return out;
}

Result<std::vector<std::uint32_t>> ReadIntegers(const tinygltf::Model& model, int accessor,
                                                int components, const std::string& what) {
  std::string why;
  const tinygltf::Accessor* source = Find(model, accessor, components, why);
  if (source == nullptr) return Error{what + " " + why};
  const auto per_element = static_cast<std::size_t>(components);
  std::vector<std::uint32_t> out(source->count * per_element, 0u);
  bool whole = true;
  why = Visit(model, *source, components, [&](std::size_t i, std::size_t c, double value) {
    whole = whole && value >= 0.0 && value <= 4294967295.0 && value == std::floor(value);
    out[i * per_element + c] = whole ? static_cast<std::uint32_t>(value) : 0u;
  });
  if (why.empty() && !whole) why = "holds a number that is no index";
  if (!why.empty()) return Error{what + " " + why};
  return out;
}

}  // namespace ego
