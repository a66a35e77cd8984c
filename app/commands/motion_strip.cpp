// SPDX-License-Identifier: MIT
#include "app/commands/motion_strip.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assets/motions/motions.h"
#include "core/baselines/retarget_method.h"
#include "core/model/rig.h"
#include "render/offscreen.h"
#include "render/stage_renderer.h"

namespace ego {

struct MotionStrips::Impl {
  OffscreenContext context;
  StageRenderer renderer;
  std::vector<const Person*> people;
  std::vector<CharacterId> meshes;
  std::unique_ptr<RetargetMethod> method;
};

namespace {

constexpr double kPitch = 7.0;  // degrees
constexpr double kFieldOfView = 0.35;
// What a row shows at least, in body heights: feet come towards the camera, hands go up.
constexpr double kBelow = 0.13;
constexpr double kAbove = 1.09;
constexpr double kHand = 0.12;  // room for what is above the wrist

/// How far anyone comes from the hips to either side of the picture, in body heights.
double HalfWidth(const std::vector<Pose>& poses, const Body& body, double yaw) {
  const Vec3 right{std::cos(Radians(yaw)), 0.0, -std::sin(Radians(yaw))};
  double widest = 0.0;
  for (const Pose& pose : poses) {
    const ModelPose model = ForwardKinematics(body.skeleton, pose);
    for (const Vec3& p : model.position_ws) {
      widest = std::max(widest, std::abs(glm::dot(p - model.position_ws[0], right)));
    }
  }
  return widest / body.height;
}

/// How high anyone's hands come, in body heights.
double Top(const Body& body, const Pose& pose) {
  const ModelPose model = ForwardKinematics(body.skeleton, pose);
  double top = 0.0;
  for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
    top = std::max(top, model.Position(JointsOf(arm).end).y / body.height + kHand);
  }
  return top;
}

/// Spread over the motion, or over its touches where there are far more of them than instants.
std::vector<double> InstantsOf(const MotionScript& script, const MotionPlayer& player, int count) {
  std::vector<double> touches;
  for (const TrueContact& contact : player.contacts()) {
    touches.push_back(0.5 * (contact.from_s + contact.to_s));
  }
  std::vector<double> instants;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count;
    const auto touch = static_cast<std::size_t>(share * static_cast<double>(touches.size()));
    instants.push_back(touches.size() >= 2 * static_cast<std::size_t>(count)
                           ? touches[touch]
                           : share * script.Duration());
  }
  return instants;
}

void Paste(const Image& cell, int x, int y, Image& sheet) {
  for (int row = 0; row < cell.height; ++row) {
    std::copy_n(
        cell.rgba.begin() + std::ptrdiff_t{4} * row * cell.width, std::ptrdiff_t{4} * cell.width,
        sheet.rgba.begin() + std::ptrdiff_t{4} * (std::ptrdiff_t{y + row} * sheet.width + x));
  }
}

}  // namespace

MotionStrips::MotionStrips(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MotionStrips::MotionStrips(MotionStrips&&) noexcept = default;
MotionStrips& MotionStrips::operator=(MotionStrips&&) noexcept = default;
MotionStrips::~MotionStrips() = default;

Result<MotionStrips> MotionStrips::Create(const std::vector<const Person*>& people,
                                          std::string_view method) {
  Result<OffscreenContext> context = OffscreenContext::Create();
  if (!context) return Error{context.error()};
  Result<StageRenderer> renderer = StageRenderer::Create({.font = {}, .samples = 8});
  if (!renderer) return Error{renderer.error()};
  auto impl = std::make_unique<Impl>(
      Impl{*std::move(context), *std::move(renderer), people, {}, MakeRetargetMethod(method)});
  if (!impl->method) return Error{"there is no method \"" + std::string(method) + "\""};
  for (const Person* person : people) {
    impl->meshes.push_back(impl->renderer.Load(person->character));
  }
  return MotionStrips(std::move(impl));
}

Result<Image> MotionStrips::Draw(const MotionScript& script, const Look& look) {
  const Person& performer = *impl_->people.front();
  const MotionFigure figure(performer);
  const MotionPlayer player(figure, script);
  std::vector<Pose> poses;
  for (const double time : InstantsOf(script, player, look.columns)) {
    poses.push_back(player.At(time));
  }
  // Row by row, then instant by instant.
  std::vector<std::vector<Pose>> rows(impl_->people.size(), poses);
  double above = kAbove;
  for (std::size_t c = 0; c < poses.size(); ++c) {
    impl_->method->SetPerformerPose(performer.body, poses[c]);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const Body& body = impl_->people[row]->body;
      if (row > 0) impl_->method->Adapt(body, rows[row][c]);
      above = std::max(above, Top(body, rows[row][c]));
    }
  }
  const double shown = kBelow + above;
  const double half = std::max(0.22, HalfWidth(poses, performer.body, look.yaw) + 0.10);
  const int width = 2 * static_cast<int>(std::ceil(half * look.cell_height / shown));

  Image sheet;
  sheet.width = width * look.columns;
  sheet.height = look.cell_height * static_cast<int>(impl_->people.size());
  sheet.rgba.resize(std::size_t{4} * static_cast<std::size_t>(sheet.width) *
                    static_cast<std::size_t>(sheet.height));
  for (int c = 0; c < look.columns; ++c) {
    for (std::size_t row = 0; row < impl_->people.size(); ++row) {
      const Person& person = *impl_->people[row];
      const Pose& pose = rows[row][static_cast<std::size_t>(c)];
      std::vector<Mat4> nodes(person.character.nodes.joints.size());
      PoseNodes(person.character.rig, pose, nodes);
      Figure drawn;
      drawn.character = CharacterPart{impl_->meshes[row], nodes};
      StageView view;
      view.figures = {&drawn, 1};
      view.name_plates = false;
      view.grid = false;
      view.camera.target_ws = {pose.root_ws.x, (0.5 * shown - kBelow) * person.body.height,
                               pose.root_ws.z};
      view.camera.yaw = Radians(look.yaw);
      view.camera.pitch = Radians(kPitch);
      view.camera.fov_y = kFieldOfView;
      view.camera.distance = 0.5 * shown * person.body.height / std::tan(0.5 * view.camera.fov_y);
      const Image cell = impl_->renderer.DrawImage(view, width, look.cell_height);
      if (cell.rgba.empty()) return Error{"a picture of this size cannot be drawn here"};
      Paste(cell, c * width, static_cast<int>(row) * look.cell_height, sheet);
    }
  }
  return sheet;
}

}  // namespace ego
