// SPDX-License-Identifier: MIT
#include "app/calibrate/reference_figure.h"

#include <algorithm>
#include <cmath>

#include "assets/motions/motions.h"

namespace ego {
namespace {

ModelPose Canonical(const Body& body) {
  return ForwardKinematics(body.skeleton, CanonicalPose(body.skeleton));
}

bool Same(const Camera& a, const Camera& b) {
  return a.yaw == b.yaw && a.pitch == b.pitch && a.target_ws == b.target_ws &&
         a.distance == b.distance;
}

}  // namespace

std::shared_ptr<TestPostures> ReferenceFigure::Prepare() {
  ScriptedPerformer();
  return std::make_shared<TestPostures>();
}

Image ReferenceFigure::Draw(StageRenderer& renderer, const ModelPose& pose, const Camera& camera,
                            int width, int height) {
  const Character& character = ScriptedPerformer().character;
  if (mesh_.value == 0) mesh_ = renderer.Load(character);
  std::vector<Mat4> nodes(character.nodes.joints.size());
  PoseNodes(character.rig, pose, nodes);
  Figure figure;
  CharacterPart part;
  part.character = mesh_;
  part.node_global = nodes;
  figure.character = part;
  StageView view;
  view.figures = std::span(&figure, 1);
  view.camera = camera;
  view.grid = false;
  view.shadows = false;
  view.name_plates = false;
  return renderer.DrawImage(view, width, height);
}

Lens ReferenceFigure::LensOf(const PickItem& item, int width, int height) const {
  const Body& body = ScriptedPerformer().body;
  return {CameraFor(item, body, Canonical(body), {width, height}),
          {0.0f, 0.0f, static_cast<float>(width), static_cast<float>(height)}};
}

Vec3 ReferenceFigure::PositionOf(const PickItem& item) const {
  const Body& body = ScriptedPerformer().body;
  return PositionOn(item, body, Canonical(body));
}

const GuiTexture* ReferenceFigure::PictureOf(StageRenderer& renderer, const PickItem& item,
                                             int width, int height) {
  if (!postures_ || width <= 0 || height <= 0) return nullptr;
  const Camera camera = LensOf(item, width, height).camera;
  // Another size of the panel: the old pictures serve no more.
  if (!seen_.empty() && (seen_.front().width != width || seen_.front().height != height)) {
    seen_.clear();
  }
  const auto found = std::find_if(seen_.begin(), seen_.end(),
                                  [&](const Seen& seen) { return Same(seen.camera, camera); });
  if (found != seen_.end()) return &found->picture;
  Seen seen{camera, width, height, {}};
  seen.picture.Set(Draw(renderer, Canonical(ScriptedPerformer().body), camera, width, height));
  seen_.push_back(std::move(seen));
  return &seen_.back().picture;
}

const GuiTexture* ReferenceFigure::PictureOf(StageRenderer& renderer, TestPosture posture,
                                             int side) {
  if (!postures_ || side <= 0) return nullptr;
  Seen& seen = posture_[static_cast<std::size_t>(posture)];
  if (seen.width == side) return &seen.picture;
  seen.width = seen.height = side;
  const Body& body = postures_->Performer();
  const ModelPose pose = ForwardKinematics(body.skeleton, postures_->PerformerPose(posture, 1.0));
  Box3 box;
  for (const Vec3& p : pose.position_ws) box.Add(p);
  box.Add(box.min - Vec3(0.1, 0.08, 0.1));
  box.Add(box.max + Vec3(0.1, 0.2, 0.1));
  Camera camera;
  camera.yaw = Radians(20.0);
  camera.pitch = Radians(6.0);
  camera.Frame(box, {side, side}, 0.02);
  seen.picture.Set(Draw(renderer, pose, camera, side, side));
  return &seen.picture;
}

}  // namespace ego
