// SPDX-License-Identifier: MIT
#include "app/commands/people_sheet.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "app/view/fonts.h"
#include "core/model/rig.h"
#include "core/skeleton/pose.h"
#include "render/offscreen.h"
#include "render/stage_renderer.h"

namespace ego {
namespace {

using J = HumanoidJoint;

// One row of a sheet: a posture, turned by so many degrees, seen close to one place or whole.
struct Row {
  enum class Near { kBody, kHead, kHand, kShoulder, kElbow, kKnee, kHip };
  Pose pose;
  double turn = 0.0;
  double pitch = 4.0;  // of the camera, degrees
  Near near = Near::kBody;
};

Quat Turn(double degrees, const Vec3& axis) { return glm::angleAxis(Radians(degrees), axis); }
constexpr Vec3 kX{1.0, 0.0, 0.0};
constexpr Vec3 kZ{0.0, 0.0, 1.0};

void BothArms(Pose& pose, J left, const Quat& rotation) {
  pose.rotation_ls[Index(left)] = rotation;
  // Reflected in x = 0.
  pose.rotation_ls[Index(Mirror(left))] = Quat(rotation.w, rotation.x, -rotation.y, -rotation.z);
}

Pose Standing() {
  Pose pose;
  BothArms(pose, J::kLeftUpperArm, Turn(-70.0, kZ));
  BothArms(pose, J::kLeftLowerArm, Turn(-16.0, kUp));
  return pose;
}

// Arms up and bent, one knee deep, hips bent.
Pose Bent() {
  Pose pose;
  BothArms(pose, J::kLeftShoulder, Turn(18.0, kZ));
  BothArms(pose, J::kLeftUpperArm, Turn(52.0, kZ) * Turn(-20.0, kUp));
  BothArms(pose, J::kLeftLowerArm, Turn(-115.0, kUp));
  pose.rotation_ls[Index(J::kLeftUpperLeg)] = Turn(-95.0, kX);
  pose.rotation_ls[Index(J::kLeftLowerLeg)] = Turn(125.0, kX);
  pose.rotation_ls[Index(J::kRightUpperLeg)] = Turn(20.0, kX);
  pose.rotation_ls[Index(J::kRightLowerLeg)] = Turn(70.0, kX);
  pose.rotation_ls[Index(J::kHead)] = Turn(35.0, kUp);
  return pose;
}

std::vector<Row> RowsOf(std::string_view what) {
  using N = Row::Near;
  if (what == "tpose") return {{{}, 0.0}, {{}, 40.0}, {{}, 180.0}};
  if (what == "face") {
    return {{Standing(), 0.0, 0.0, N::kHead},
            {Standing(), 35.0, 6.0, N::kHead},
            {Standing(), 90.0, 0.0, N::kHead},
            {Standing(), 150.0, 8.0, N::kHead}};
  }
  if (what == "hands") {
    return {
        {{}, 0.0, 70.0, N::kHand}, {{}, 0.0, -70.0, N::kHand}, {Standing(), 60.0, 5.0, N::kHand}};
  }
  if (what == "bends") {
    const Pose bent = Bent();
    return {{bent, 30.0},
            {bent, 150.0},
            {bent, 15.0, 5.0, N::kShoulder},
            {bent, 200.0, 15.0, N::kShoulder},
            {bent, 0.0, 40.0, N::kElbow},
            {bent, 60.0, 10.0, N::kKnee},
            {bent, 70.0, 10.0, N::kHip}};
  }
  return {{Standing(), 0.0}, {Standing(), 40.0}, {Standing(), 90.0}, {Standing(), 155.0}};
}

struct Shot {
  Vec3 target_ws;
  double span = 0.0;  // metres from bottom to top of the picture
};

Shot ShotOf(const Person& person, const ModelPose& pose, Row::Near near, double whole_height) {
  const double size = person.body.height;
  const double head = size - CanonicalPositions(person.body.skeleton)[Index(J::kHead)].y;
  const auto at = [&](J joint) { return pose.Position(joint); };
  switch (near) {
    case Row::Near::kHead:
      return {at(J::kHead) + pose.Rotation(J::kHead) * Vec3{0.0, 0.42 * head, 0.0}, 1.75 * head};
    case Row::Near::kHand: {
      const Vec3& tip = person.body.surface.hand[0].fingertip_ms;
      const Vec3 wrist = CanonicalPositions(person.body.skeleton)[Index(J::kLeftHand)];
      const double length = glm::distance(tip, wrist);
      return {at(J::kLeftHand) + pose.Rotation(J::kLeftHand) * (0.45 * (tip - wrist)),
              1.7 * length};
    }
    case Row::Near::kShoulder:
      return {at(J::kLeftUpperArm), 0.40 * size};
    case Row::Near::kElbow:
      return {at(J::kLeftLowerArm), 0.28 * size};
    case Row::Near::kKnee:
      return {at(J::kLeftLowerLeg), 0.36 * size};
    case Row::Near::kHip:
      return {at(J::kLeftUpperLeg), 0.42 * size};
    case Row::Near::kBody:
      break;
  }
  return {Vec3{0.0, 0.5 * whole_height, 0.0}, 1.06 * whole_height};
}

class Photographer {
 public:
  Photographer(StageRenderer renderer, int cell_height)
      : renderer_(std::move(renderer)), height_(cell_height) {}

  Image Draw(const Person& person, CharacterId id, const Row& row, int width, double whole_height) {
    Pose pose = row.pose;
    pose.root_ws = person.body.skeleton.offset[0];
    pose.rotation_ls[0] = Turn(row.turn, kUp) * pose.rotation_ls[0];
    const ModelPose model = ForwardKinematics(person.body.skeleton, pose);
    nodes_.resize(person.character.nodes.joints.size());
    PoseNodes(person.character.rig, model, nodes_);
    Figure figure;
    figure.character = CharacterPart{id, nodes_};

    const Shot shot = ShotOf(person, model, row.near, whole_height);
    StageView view;
    view.figures = {&figure, 1};
    view.name_plates = false;
    view.grid = false;
    view.camera.target_ws = shot.target_ws;
    view.camera.yaw = 0.0;
    view.camera.pitch = Radians(row.pitch);
    view.camera.fov_y = 0.35;
    view.camera.distance = 0.5 * shot.span / std::tan(0.5 * view.camera.fov_y);
    return renderer_.DrawImage(view, width, height_);
  }

  StageRenderer& renderer() { return renderer_; }

 private:
  StageRenderer renderer_;
  int height_;
  std::vector<Mat4> nodes_;
};

}  // namespace

std::vector<std::string> PeopleSheetNames() { return {"turn", "tpose", "face", "hands", "bends"}; }

Result<Image> DrawPeopleSheet(const std::vector<Person>& people, std::string_view what,
                              int cell_height) {
  const Result<OffscreenContext> context = OffscreenContext::Create();
  if (!context) return Error{context.error()};
  Result<StageRenderer> renderer = StageRenderer::Create({.font = {}, .samples = 4});
  if (!renderer) return Error{renderer.error()};
  Photographer photographer(*std::move(renderer), cell_height);

  const std::vector<Row> rows = RowsOf(what);
  const double aspect = what == "turn" ? 0.55 : 1.0;
  const int width = static_cast<int>(std::lround(aspect * cell_height));
  double tallest = 0.0;
  double broadest = 0.0;
  for (const Person& person : people) {
    tallest = std::max(tallest, person.body.height);
    broadest = std::max(broadest, 2.0 * person.body.surface.hand[0].fingertip_ms.x);
  }
  // Everyone at the same scale; whole people with spread arms must fit by their breadth.
  const double whole = what == "tpose" || what == "bends" ? std::max(tallest, broadest) : tallest;
  Image sheet;
  sheet.width = width * static_cast<int>(people.size());
  sheet.height = cell_height * static_cast<int>(rows.size());
  sheet.rgba.resize(std::size_t{4} * static_cast<std::size_t>(sheet.width) *
                    static_cast<std::size_t>(sheet.height));
  for (std::size_t column = 0; column < people.size(); ++column) {
    const CharacterId id = photographer.renderer().Load(people[column].character);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const Image cell = photographer.Draw(people[column], id, rows[row], width, whole);
      if (cell.rgba.empty()) return Error{"a picture of this size cannot be drawn here"};
      for (int y = 0; y < cell.height; ++y) {
        const std::ptrdiff_t to_row =
            static_cast<std::ptrdiff_t>(row) * cell.height + static_cast<std::ptrdiff_t>(y);
        std::copy_n(cell.rgba.begin() + std::ptrdiff_t{4} * y * cell.width,
                    std::ptrdiff_t{4} * cell.width,
                    sheet.rgba.begin() +
                        4 * (to_row * sheet.width + static_cast<std::ptrdiff_t>(column) * width));
      }
    }
    photographer.renderer().Unload(id);
  }
  return sheet;
}

}  // namespace ego
