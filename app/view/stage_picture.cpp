// SPDX-License-Identifier: MIT
#include "app/view/stage_picture.h"

#include <algorithm>
#include <utility>

namespace ego {

StagePicture::StagePicture(StageRenderer renderer) : renderer_(std::move(renderer)) {}

void StagePicture::SetMembers(std::vector<StageMember> members) {
  std::map<std::uint64_t, Drawn> next;
  for (StageMember& member : members) {
    Drawn& drawn = next[member.id];
    const auto old = drawn_.find(member.id);
    if (old != drawn_.end() && old->second.member.character == member.character) {
      drawn = std::move(old->second);
      drawn_.erase(old);
    } else {
      drawn.mesh = renderer_.Load(*member.character);
      drawn.node_global.resize(member.character->nodes.joints.size());
    }
    drawn.member = std::move(member);
  }
  for (const auto& [id, gone] : drawn_) renderer_.Unload(gone.mesh);
  drawn_ = std::move(next);
}

const StageLayout& StagePicture::LayoutOf(const std::shared_ptr<const CapturedMotion>& motion) {
  if (layout_motion_ != motion || !layout_) {
    layout_.emplace(*motion);
    layout_motion_ = motion;
  }
  return *layout_;
}

void StagePicture::AddPerformer(const StageFrame& frame, const Overlays& overlays) {
  const Body& performer = frame.scene->motion->performer;
  if (overlays.surface || (overlays.markers && !frame.marker_ws.empty())) {
    Figure figure;
    figure.name = "Performer";
    figure.color = look::kPerformer;
    figure.plate_ws = Vec3(frame.performer_pose.root_ws.x, 0.0, frame.performer_pose.root_ws.z);
    if (overlays.surface) {
      SurfacePart surface;
      surface.body = &performer;
      surface.pose = &frame.performer;
      // Markers lie on the skin: a clear view of them needs the skin a little see-through.
      if (!overlays.markers || frame.marker_ws.empty()) surface.opacity = 1.0f;
      figure.surface = surface;
    }
    if (overlays.markers && !frame.marker_ws.empty()) {
      MarkerPart markers;
      markers.frame = {frame.time_s, frame.marker_ws, frame.marker_visible};
      if (overlays.surface) markers.color = look::kText;
      figure.markers = markers;
    }
    figures_.push_back(figure);
    roles_.push_back({FigureRole::Kind::kPerformer, 0});
    members_.push_back({performer.height, 1.0});
  }
  if (overlays.skeleton) {
    Figure figure;
    figure.name = "Skeleton";
    figure.color = look::kSkeleton;
    figure.skeleton = SkeletonPart{&performer.skeleton, &frame.performer, look::kSkeleton, false};
    figures_.push_back(figure);
    roles_.push_back({FigureRole::Kind::kSkeleton, 0});
    members_.push_back({performer.height, 1.0});
  }
}

void StagePicture::AddAvatar(const StageFrame& frame, std::size_t index, const Overlays& overlays) {
  const StageScene::Avatar& avatar = frame.scene->avatars[index];
  const auto found = drawn_.find(avatar.id);
  if (found == drawn_.end() || !found->second.member.visible) return;
  Drawn& drawn = found->second;
  const ModelPose& pose = frame.avatars[index].model;
  Figure figure;
  figure.name = drawn.member.name;
  figure.color = drawn.member.color;
  if (overlays.bodies) {
    PoseNodes(drawn.member.character->rig, pose, drawn.node_global);
    CharacterPart character;
    character.character = drawn.mesh;
    character.node_global = drawn.node_global;
    figure.character = character;
  }
  if (overlays.crude || !overlays.bodies) {
    SurfacePart surface;
    surface.body = avatar.body.get();
    surface.pose = &pose;
    surface.color = drawn.member.color;
    if (overlays.bodies) {
      surface.opacity = 0.45f;
      surface.through = true;
    }
    figure.surface = surface;
  }
  figures_.push_back(figure);
  roles_.push_back({FigureRole::Kind::kAvatar, avatar.id});
  const double performer_root = frame.scene->motion->performer.standing_root_height;
  members_.push_back({avatar.body->height, performer_root > 0.0
                                               ? avatar.body->standing_root_height / performer_root
                                               : 1.0});
}

std::span<const Figure> StagePicture::Arrange(const StageFrame& frame, const Overlays& overlays,
                                              StageLayout::Line line,
                                              const std::optional<FigureRole>& selected) {
  figures_.clear();
  roles_.clear();
  members_.clear();
  if (!frame.scene) return figures_;
  AddPerformer(frame, overlays);
  const std::size_t avatars = std::min(frame.avatars.size(), frame.scene->avatars.size());
  for (std::size_t i = 0; i < avatars; ++i) AddAvatar(frame, i, overlays);

  const StageLayout& layout = LayoutOf(frame.scene->motion);
  offsets_.resize(figures_.size());
  layout.Place(frame.frame, line, members_, offsets_);
  anchor_ = layout.Anchor(frame.frame);
  for (std::size_t i = 0; i < figures_.size(); ++i) {
    figures_[i].offset_ws = offsets_[i];
    figures_[i].selected = selected == roles_[i];
  }
  return figures_;
}

Box3 StagePicture::BoundsOf(std::span<const Figure> figures) {
  Box3 box = renderer_.Bounds(figures);
  if (box.IsEmpty()) return box;
  box.min -= anchor_;
  box.max -= anchor_;
  return box;
}

Box3 StagePicture::Bounds() { return BoundsOf(figures_); }

Box3 StagePicture::Bounds(std::size_t figure) { return BoundsOf({&figures_.at(figure), 1}); }

void MakeRoomForNames(Box3& box) {
  if (!box.IsEmpty()) box.min.y -= 0.1 * (box.max.y - box.min.y);
}

}  // namespace ego
