// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/view/stage_layout.h"
#include "core/model/character.h"
#include "core/pipeline/stage_frame.h"
#include "render/stage_renderer.h"

namespace ego {

/// How one avatar of a scene is shown.
struct StageMember {
  std::uint64_t id = 0;  // as in StageScene::Avatar
  std::string name;
  glm::vec3 color{1.0f};  // sRGB
  bool visible = true;
  std::shared_ptr<const Character> character;  // never null
};

/// What is shown of whom.
struct Overlays {
  bool skeleton = true;  // the captured skeleton, as a figure of its own
  bool surface = true;   // the performer's body surface
  bool markers = true;   // the performer's markers
  bool bodies = true;    // the avatars' meshes
  bool crude = false;    // the avatars' crude surfaces, over their meshes
  bool contacts = true;  // glowing spots where hands touch the body
  bool names = true;
  /// Everyone at the size of the file. Else giants and dwarfs are shown at a size that can be
  /// looked at beside the performer (DisplayScale), and their name plate tells so.
  bool true_sizes = false;
};

/// Factor at which a body of this height is shown beside a performer: 1 from 0.4 to 1.4 times the
/// performer's height, beyond that such that it ends at these bounds.
double DisplayScale(double height, double performer_height);

/// Who a figure on stage is.
struct FigureRole {
  enum class Kind { kPerformer, kSkeleton, kAvatar };
  Kind kind = Kind::kPerformer;
  std::uint64_t avatar_id = 0;  // of avatars
  bool operator==(const FigureRole&) const = default;
};

/// Turns stage frames into figures side by side and has them drawn: performer, captured skeleton,
/// then the visible avatars in the order of the scene. Needs the renderer's context current.
class StagePicture {
 public:
  explicit StagePicture(StageRenderer renderer);

  /// Uploads the meshes of new members and drops those of members gone.
  void SetMembers(std::vector<StageMember> members);

  /// The figures of one instant. Valid until the next call of this or SetMembers; the frame must
  /// outlive their use. `selected` names a figure to highlight, if any.
  std::span<const Figure> Arrange(const StageFrame& frame, const Overlays& overlays,
                                  StageLayout::Line line = StageLayout::Line::kSideways,
                                  const std::optional<FigureRole>& selected = {});
  /// Roles of the figures last arranged, in their order.
  std::span<const FigureRole> roles() const { return roles_; }
  /// What was added to each figure's positions, in the same order.
  std::span<const Vec3> offsets() const { return offsets_; }
  /// Where the line of the last arranged frame has its middle, world space. A camera that follows
  /// adds this to its target.
  Vec3 anchor() const { return anchor_; }
  /// Which way the performer mostly faces (StageLayout::heading); standard views add it to a
  /// camera's yaw.
  double heading() const { return heading_; }
  /// Box around the figures last arranged, relative to `anchor()`.
  Box3 Bounds();
  /// The same for one of them.
  Box3 Bounds(std::size_t figure);

  StageRenderer& renderer() { return renderer_; }

 private:
  struct Drawn {
    StageMember member;
    CharacterId mesh;
    std::vector<Mat4> node_global;

    // What is shown when the body is not shown at its own size: made when the factor changes.
    double scale = 1.0;
    std::string plate;
    Body scaled_body;
    ModelPose scaled_pose;
  };
  void AddContacts(const StageFrame& frame);
  void SetScale(Drawn& drawn, const Body& body, double scale);

  Box3 BoundsOf(std::span<const Figure> figures);
  void AddPerformer(const StageFrame& frame, const Overlays& overlays);
  void AddAvatar(const StageFrame& frame, std::size_t index, const Overlays& overlays);
  const StageLayout& LayoutOf(const std::shared_ptr<const CapturedMotion>& motion);

  StageRenderer renderer_;
  std::map<std::uint64_t, Drawn> drawn_;
  std::shared_ptr<const CapturedMotion> layout_motion_;  // the one `layout_` was made for
  std::optional<StageLayout> layout_;
  Vec3 anchor_{0.0};
  double heading_ = 0.0;
  std::vector<Figure> figures_;
  std::vector<ContactGlow> glows_;  // of all figures
  std::vector<FigureRole> roles_;
  std::vector<StageLayout::Member> members_;
  std::vector<Vec3> offsets_;
};

/// Lowers a box for Camera::Frame so that the names at the figures' feet stay in the picture.
void MakeRoomForNames(Box3& box);

}  // namespace ego
