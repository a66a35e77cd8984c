// SPDX-License-Identifier: MIT
#include "app/calibrate/calibrate_view.h"

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

using namespace std::chrono_literals;

constexpr auto kGlideTime = 180ms;
constexpr float kXrayOpacity = 0.38f;

double Between(double from, double to, double share) { return from + (to - from) * share; }

// The shorter way around.
double AngleBetween(double from, double to, double share) {
  const double way = std::remainder(to - from, 2.0 * kPi);
  return from + way * share;
}

}  // namespace

std::optional<Vec2> Lens::ToWindow(const Vec3& position_ws) const {
  const auto pixel = camera.Project(position_ws, size());
  if (!pixel) return std::nullopt;
  return Vec2(*pixel) + Vec2(rect.x, rect.y);
}

double Lens::PixelsOf(double metres, const Vec3& position_ws) const {
  const double depth = glm::dot(position_ws - camera.Position(), camera.Forward());
  if (depth <= 0.0) return 0.0;
  return metres * 0.5 * static_cast<double>(rect.height) / (depth * std::tan(0.5 * camera.fov_y));
}

PickCone Lens::ConeAt(const Vec2& window_pixel, double radius_pixels) const {
  PickCone cone;
  cone.origin_ws = camera.Position();
  cone.direction = camera.RayThrough(window_pixel - Vec2(rect.x, rect.y), size());
  cone.slope = 2.0 * std::tan(0.5 * camera.fov_y) * radius_pixels /
               std::max(1.0, static_cast<double>(rect.height));
  return cone;
}

void CalibrateView::GlideTo(const Camera& to, Time now) { glide_ = Glide{camera, to, now}; }

bool CalibrateView::Advance(Time now) {
  if (!glide_) return false;
  const double share = std::clamp(std::chrono::duration<double>(now - glide_->start).count() /
                                      std::chrono::duration<double>(kGlideTime).count(),
                                  0.0, 1.0);
  const double eased = share * share * (3.0 - 2.0 * share);
  const Camera& a = glide_->from;
  const Camera& b = glide_->to;
  camera = b;
  if (share >= 1.0) {
    glide_.reset();
    return true;
  }
  camera.yaw = AngleBetween(a.yaw, b.yaw, eased);
  camera.pitch = Between(a.pitch, b.pitch, eased);
  camera.target_ws = glm::mix(a.target_ws, b.target_ws, eased);
  camera.distance = std::exp(
      Between(std::log(std::max(a.distance, 1e-6)), std::log(std::max(b.distance, 1e-6)), eased));
  return true;
}

Camera CalibrateView::WholeCharacter(const CalibrationSession& session, ViewportSize size) const {
  Box3 box;
  for (const auto& part : session.picker().Mesh().position_ws) {
    for (const Vec3& p : part) box.Add(p);
  }
  // Room for the line that says what to do.
  if (!box.IsEmpty()) box.Add(box.min - Vec3(0.0, 0.07 * (box.max.y - box.min.y), 0.0));
  Camera whole;
  whole.yaw = 0.0;
  whole.pitch = Radians(4.0);
  whole.Frame(box, size, 0.06);
  return whole;
}

std::optional<Figure> CalibrateView::FigureOf(StageRenderer& renderer,
                                              const CalibrationSession& session,
                                              const CalibrateLook& look) {
  const std::shared_ptr<const Character>& character = session.editor().TheCharacter();
  Mesh& mesh = meshes_[session.avatar_id()];
  if (mesh.character != character) {
    renderer.Unload(mesh.id);
    mesh = {renderer.Load(*character), character};
  }
  Figure figure;
  CharacterPart part;
  part.character = mesh.id;
  part.node_global = session.node_global();
  part.opacity = look.xray ? kXrayOpacity : 1.0f;
  part.edges = look.edges;
  figure.character = part;
  if (look.crude) {
    SurfacePart surface;
    surface.body = &session.editor().AvatarBody();
    surface.pose = &session.pose();
    surface.color = look::kPerformer;
    surface.opacity = 0.5f;
    surface.through = true;
    figure.surface = surface;
  }
  if (look.xray) {
    figure.skeleton =
        SkeletonPart{&character->rig.skeleton, &session.pose(), look::kSkeleton, false};
  }
  return figure;
}

void CalibrateView::Draw(StageRenderer& renderer, const CalibrationSession& session,
                         const CalibrateLook& look, const DrawTarget& target) {
  const std::optional<Figure> figure = FigureOf(renderer, session, look);
  StageView view;
  if (figure) view.figures = std::span(&*figure, 1);
  view.camera = camera;
  view.name_plates = false;
  renderer.Draw(view, target);
}

Image CalibrateView::DrawLoupe(StageRenderer& renderer, const CalibrationSession& session,
                               const CalibrateLook& look, const Lens& loupe) {
  const std::optional<Figure> figure = FigureOf(renderer, session, look);
  StageView view;
  if (figure) view.figures = std::span(&*figure, 1);
  view.camera = loupe.camera;
  view.grid = false;
  view.shadows = false;
  view.name_plates = false;
  const ViewportSize size = loupe.size();
  return renderer.DrawImage(view, size.width, size.height);
}

Image CalibrateView::DrawSmall(StageRenderer& renderer, const CalibrationSession& session,
                               ShownPose::Kind kind, int side) {
  std::optional<Figure> figure = FigureOf(renderer, session, {});
  const Character& character = *session.editor().TheCharacter();
  std::vector<Mat4> nodes(character.nodes.joints.size());
  if (kind == ShownPose::Kind::kAsInFile) {
    PoseAsInFile(character, nodes);
  } else {
    const Skeleton& skeleton = session.editor().AvatarBody().skeleton;
    PoseNodes(character.rig, ForwardKinematics(skeleton, CanonicalPose(skeleton)), nodes);
  }
  figure->character->node_global = nodes;
  StageView view;
  view.figures = std::span(&*figure, 1);
  view.camera.yaw = 0.0;
  view.camera.pitch = Radians(4.0);
  view.camera.Frame(renderer.Bounds(view.figures), {side, side}, 0.03);
  view.grid = false;
  view.shadows = false;
  view.name_plates = false;
  return renderer.DrawImage(view, side, side);
}

Lens CalibrateView::LoupeOf(const Lens& lens, const Vec2& window_pixel, const Rect& rect,
                            double zoom) {
  Lens loupe;
  loupe.rect = rect;
  Camera& camera = loupe.camera;
  const Vec3 eye = lens.camera.Position();
  const Vec3 way =
      lens.camera.RayThrough(window_pixel - Vec2(lens.rect.x, lens.rect.y), lens.size());
  camera.distance = lens.camera.distance;
  camera.target_ws = eye + camera.distance * way;
  camera.pitch = std::asin(std::clamp(-way.y, -1.0, 1.0));
  camera.yaw = std::atan2(-way.x, -way.z);
  const double height = std::max(1.0, static_cast<double>(lens.rect.height));
  camera.fov_y = 2.0 * std::atan(std::tan(0.5 * lens.camera.fov_y) *
                                 static_cast<double>(rect.height) / (height * zoom));
  return loupe;
}

}  // namespace ego
