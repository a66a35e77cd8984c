// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <glm/glm.hpp>

#include "core/body/body.h"
#include "core/markers/marker_take.h"
#include "core/skeleton/pose.h"
#include "render/camera.h"
#include "render/look.h"

namespace ego {

/// A character that was handed to StageRenderer::Load.
struct CharacterId {
  std::uint32_t value = 0;  // 0: none
  bool operator==(const CharacterId&) const = default;
};

/// A rigged mesh, posed by its nodes.
struct CharacterPart {
  CharacterId character;
  /// World transform of every node, as PoseNodes gives them. A wrong count draws nothing.
  std::span<const Mat4> node_global;
  glm::vec3 tint{1.0f};  // multiplies the materials, linear
  float opacity = 1.0f;  // below one: see-through, so that what is inside shows
  bool edges = false;    // the mesh's edges as lines over its skin, all of them
};

/// The crude surface of a body: what the method knows of the skin.
struct SurfacePart {
  const Body* body = nullptr;
  const ModelPose* pose = nullptr;
  glm::vec3 color = look::kPerformer;  // sRGB
  float opacity = 0.82f;
  bool through = false;  // drawn over bodies that hide it (an x-ray overlay)
};

/// Joints and tapered bones.
struct SkeletonPart {
  const Skeleton* skeleton = nullptr;
  const ModelPose* pose = nullptr;
  glm::vec3 color = look::kSkeleton;  // sRGB
  bool through = false;
};

/// Optical markers as small spheres; those that are not visible are absent.
struct MarkerPart {
  MarkerFrame frame;
  glm::vec3 color = look::kPerformer;  // sRGB
  double radius = 0.014;               // metres
};

/// A glowing spot where skin touches skin.
struct ContactGlow {
  Vec3 position_ws{0.0};
  float strength = 1.0f;  // 0 to 1
  float radius = 0.085f;  // metres
  glm::vec3 color = look::kContact;
};

/// One who stands on the stage. Any of the parts may be there at once: markers on a surface, a
/// surface over a character. All positions are the motion's own world space; `offset_ws` then
/// places the figure beside others. Spans and pointers are read during Draw only.
struct Figure {
  std::string_view name;           // UTF-8; empty: no name plate
  glm::vec3 color = look::kQuiet;  // sRGB, of the plate's mark and of the rim when selected
  Vec3 offset_ws{0.0};
  bool selected = false;

  std::optional<CharacterPart> character;
  std::optional<SurfacePart> surface;
  std::optional<SkeletonPart> skeleton;
  std::optional<MarkerPart> markers;
  std::span<const ContactGlow> contacts;

  /// Ground point at which the name plate lies, motion's own world space. Without: beneath the
  /// hips, or the middle of the visible markers.
  std::optional<Vec3> plate_ws;
};

/// All that one picture shows.
struct StageView {
  std::span<const Figure> figures;
  Camera camera;
  bool grid = true;
  bool shadows = true;
  bool name_plates = true;
};

/// Where a picture goes: a rectangle of a framebuffer that the caller owns, in pixels from the
/// bottom left corner as OpenGL counts them.
struct DrawTarget {
  unsigned framebuffer = 0;  // OpenGL name; 0: the window's own
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  float content_scale = 1.0f;  // of the monitor; sizes text and plates
};

}  // namespace ego
