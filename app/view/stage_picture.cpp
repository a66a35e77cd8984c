// SPDX-License-Identifier: MIT
#include "app/view/stage_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/contact_glows.h"

namespace ego {

double DisplayScale(double height, double performer_height) {
  constexpr double kSmallest = 0.4;
  constexpr double kTallest = 1.4;
  if (height <= 0.0 || performer_height <= 0.0) return 1.0;
  const double ratio = height / performer_height;
  return std::clamp(ratio, kSmallest, kTallest) / ratio;
}

namespace {

// Name plates stand side by side: a long file name keeps its beginning.
std::string Elided(const std::string& name) {
  constexpr std::size_t kLongest = 20;
  std::size_t characters = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool continues = (static_cast<unsigned char>(name[i]) & 0xC0u) == 0x80u;  // UTF-8
    if (!continues && ++characters > kLongest) return name.substr(0, i) + "\u2026";
  }
  return name;
}

// Room that a broad body needs beside what its height already gives it.
double Girth(const Body& body) {
  constexpr double kSlim = 0.11;  // half the breadth of an adult, shares of height
  double half = 0.0;
  for (const Vec3& p : body.surface.sample_ms) half = std::max(half, std::abs(p.x));
  return std::max(0.0, half - kSlim * body.height);
}

}  // namespace

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
    drawn.plate.clear();  // made anew with the next picture
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
    members_.push_back({performer.height, 0.0, 1.0});
  }
  if (overlays.skeleton) {
    Figure figure;
    figure.name = "Skeleton";
    figure.color = look::kSkeleton;
    figure.skeleton = SkeletonPart{&performer.skeleton, &frame.performer, look::kSkeleton, false};
    figures_.push_back(figure);
    roles_.push_back({FigureRole::Kind::kSkeleton, 0});
    members_.push_back({performer.height, 0.0, 1.0});
  }
}

void StagePicture::SetScale(Drawn& drawn, const Body& body, double scale) {
  if (drawn.scale == scale && !drawn.plate.empty()) return;
  drawn.scale = scale;
  drawn.plate = Elided(drawn.member.name);
  if (scale == 1.0) return;
  const int percent = static_cast<int>(std::lround(100.0 * scale));
  drawn.plate += "  " + std::to_string(percent) + " %";
  drawn.scaled_body = Scaled(body, scale);
}

void StagePicture::AddAvatar(const StageFrame& frame, std::size_t index, const Overlays& overlays) {
  const StageScene::Avatar& avatar = frame.scene->avatars[index];
  const auto found = drawn_.find(avatar.id);
  if (found == drawn_.end() || !found->second.member.visible) return;
  Drawn& drawn = found->second;
  const double performer_height = frame.scene->motion->performer.height;
  const double scale =
      overlays.true_sizes ? 1.0 : DisplayScale(avatar.body->height, performer_height);
  SetScale(drawn, *avatar.body, scale);
  const ModelPose& pose = frame.avatars[index].model;
  Figure figure;
  figure.name = drawn.plate;
  figure.color = drawn.member.color;
  if (overlays.bodies) {
    PoseNodes(drawn.member.character->rig, pose, frame.avatars[index].pose.hand, drawn.node_global);
    if (scale != 1.0) {
      // About the stage's origin, so that soles on the ground stay on it.
      for (Mat4& node : drawn.node_global) {
        for (int column = 0; column < 4; ++column) {
          node[column] = Vec4(scale * Vec3(node[column]), node[column].w);
        }
      }
    }
    CharacterPart character;
    character.character = drawn.mesh;
    character.node_global = drawn.node_global;
    figure.character = character;
  }
  if (overlays.crude || !overlays.bodies) {
    SurfacePart surface;
    if (scale == 1.0) {
      surface.body = avatar.body.get();
      surface.pose = &pose;
    } else {
      drawn.scaled_pose = pose;
      for (Vec3& p : drawn.scaled_pose.position_ws) p *= scale;
      surface.body = &drawn.scaled_body;
      surface.pose = &drawn.scaled_pose;
    }
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
  const double path_scale =
      performer_root > 0.0 ? avatar.body->standing_root_height / performer_root : 1.0;
  members_.push_back(
      {scale * avatar.body->height, scale * Girth(*avatar.body), scale * path_scale});
}

void StagePicture::AddContacts(const StageFrame& frame) {
  glows_.clear();
  std::vector<std::size_t> first(figures_.size() + 1, 0);
  for (std::size_t i = 0; i < figures_.size(); ++i) {
    const FigureRole& role = roles_[i];
    if (role.kind == FigureRole::Kind::kPerformer) {
      AppendContactGlows(frame.scene->motion->performer, frame.performer_pose, 1.0, glows_);
    }
    for (std::size_t k = 0; role.kind == FigureRole::Kind::kAvatar && k < frame.avatars.size();
         ++k) {
      const StageScene::Avatar& avatar = frame.scene->avatars[k];
      if (avatar.id != role.avatar_id) continue;
      AppendContactGlows(*avatar.body, frame.avatars[k].pose, drawn_.at(avatar.id).scale, glows_);
    }
    first[i + 1] = glows_.size();
  }
  for (std::size_t i = 0; i < figures_.size(); ++i) {
    figures_[i].contacts = std::span(glows_).subspan(first[i], first[i + 1] - first[i]);
  }
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

  if (overlays.contacts) AddContacts(frame);

  const StageLayout& layout = LayoutOf(frame.scene->motion);
  offsets_.resize(figures_.size());
  layout.Place(frame.frame, line, members_, offsets_);
  anchor_ = layout.Anchor(frame.frame);
  heading_ = layout.heading();
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
