// SPDX-License-Identifier: MIT
// What is drawn over the picture: dots, rings, capsules, joints, and what a click would do.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/calibrate/workspace.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

constexpr float kLoupeSize = 168.0f;
constexpr double kLoupeZoom = 4.0;

ImVec2 Im(const Vec2& p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

// One pass over one lens: the window's picture, or the loupe's.
class Painter {
 public:
  Painter(ImDrawList& list, const Lens& lens, const CalibrationSession& session,
          const CalibrateWorkspace& work)
      : list_(list), lens_(lens), session_(session), work_(work), eye_(lens.camera.Position()) {}

  void Finding();
  void Limbs();
  void Points(bool with_names);
  void Joints();
  void HoverMarks();

 private:
  bool Sees(const Vec3& at) const {
    return work_.habits.look.xray || session_.picker().Visible(eye_, at);
  }
  void Polyline(std::span<const Vec3> points, bool closed, ImU32 color, float thickness);
  void Capsule(const Vec3& a, const Vec3& b, double radius, ImU32 line, ImU32 fill);
  void Dot(const Vec2& at, PickState state, bool current, bool seen);
  void Halo(const Vec3& at, const glm::vec3& color, float radius, float alpha);

  ImDrawList& list_;
  const Lens& lens_;
  const CalibrationSession& session_;
  const CalibrateWorkspace& work_;
  Vec3 eye_;
};

void Painter::Polyline(std::span<const Vec3> points, bool closed, ImU32 color, float thickness) {
  const std::size_t count = closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; points.size() > 1 && i < count; ++i) {
    const auto a = lens_.ToWindow(points[i]);
    const auto b = lens_.ToWindow(points[(i + 1) % points.size()]);
    if (a && b) list_.AddLine(Im(*a), Im(*b), color, thickness);
  }
}

void Painter::Capsule(const Vec3& a, const Vec3& b, double radius, ImU32 line, ImU32 fill) {
  const auto pa = lens_.ToWindow(a);
  const auto pb = lens_.ToWindow(b);
  if (!pa || !pb) return;
  const double ra = lens_.PixelsOf(radius, a);
  const double rb = lens_.PixelsOf(radius, b);
  const Vec2 way = *pb - *pa;
  const double length = glm::length(way);
  if (length <= std::abs(ra - rb) + 1.0) {
    const bool first = ra > rb;
    list_.AddCircle(Im(first ? *pa : *pb), static_cast<float>(std::max(ra, rb)), line, 48,
                    Px(1.5f));
    return;
  }
  // The hull of two circles: arcs that meet on their common tangents.
  const double along = std::atan2(way.y, way.x);
  const double open = std::acos(std::clamp((ra - rb) / length, -1.0, 1.0));
  const auto arc = [&](const Vec2& center, double r, double from, double to) {
    list_.PathArcTo(Im(center), static_cast<float>(r), static_cast<float>(from),
                    static_cast<float>(to), 24);
  };
  const auto outline = [&] {
    arc(*pb, rb, along - open, along + open);
    arc(*pa, ra, along + open, along + 2.0 * kPi - open);
  };
  outline();
  list_.PathFillConvex(fill);
  outline();
  list_.PathStroke(line, ImDrawFlags_Closed, Px(1.5f));
}

void Painter::Halo(const Vec3& at, const glm::vec3& color, float radius, float alpha) {
  const auto p = lens_.ToWindow(at);
  if (p) list_.AddCircle(Im(*p), Px(radius), Packed(color, alpha), 32, Px(2.0f));
}

// State by shape as well as by colour: full when settled, a ring when proposed, a ring with a
// point when doubtful.
void Painter::Dot(const Vec2& at, PickState state, bool current, bool seen) {
  const ImVec2 p = Im(at);
  const float alpha = seen ? 1.0f : 0.28f;
  const float r = Px(current ? 6.0f : 5.0f);
  const ImU32 dark = Packed(look::kRoom, 0.75f * alpha);
  const bool settled = Settled(state);
  const glm::vec3 color = settled                         ? look::kGood
                          : state == PickState::kDoubtful ? look::kWarn
                                                          : look::kText;
  list_.AddCircleFilled(p, r + Px(1.5f), dark, 20);
  if (settled) {
    list_.AddCircleFilled(p, r, Packed(color, alpha), 20);
  } else {
    list_.AddCircle(p, r - Px(0.5f), Packed(color, alpha), 20, Px(2.0f));
    if (state == PickState::kDoubtful) {
      list_.AddCircleFilled(p, Px(1.75f), Packed(color, alpha), 12);
    }
  }
  if (current) list_.AddCircle(p, r + Px(5.0f), Packed(look::kAccent, alpha), 32, Px(2.0f));
}

void Painter::Finding() {
  if (!work_.shown_finding) return;
  const CalibrationFinding& finding = *work_.shown_finding;
  const Body& body = session_.editor().AvatarBody();
  std::array<Vec3, kSampleCount> samples;
  PoseSamples(body.skeleton, body.surface, session_.pose(), samples);
  for (const std::size_t t : finding.triangles) {
    if (t >= SampleTriangles().size()) continue;
    std::array<Vec3, 3> corners;
    std::array<ImVec2, 3> p;
    bool all = true;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = samples[Index(SampleTriangles()[t][k])];
      const auto at = lens_.ToWindow(corners[k]);
      all = all && at;
      if (at) p[k] = Im(*at);
    }
    if (!all) continue;
    list_.AddTriangleFilled(p[0], p[1], p[2], Packed(look::kBad, 0.28f));
    Polyline(corners, true, Packed(look::kBad), Px(2.0f));
  }
  for (const PointId id : finding.points) {
    const std::optional<Vec3> at = session_.PositionOf(PickItem::Of(id));
    if (at && !id.IsDot()) Halo(*at, look::kBad, 14.0f, 1.0f);
  }
}

void Painter::Limbs() {
  const Body& body = session_.editor().AvatarBody();
  const std::optional<PickItem>& current = session_.current();
  for (std::size_t i = 0; i < kSegmentCount; ++i) {
    const auto segment = static_cast<LimbSegment>(i);
    const bool asked = current && current->segment == segment;
    const bool row = work_.hovered_row && work_.hovered_row->segment == segment;
    const bool twin = session_.editor().Symmetric() && current && current->segment &&
                      Mirror(*current->segment) == segment;
    if (!asked && !row && !twin && !work_.habits.look.limbs) continue;
    const Vec3 a = session_.pose().Position(StartJoint(segment));
    const Vec3 b = session_.pose().Position(EndJoint(segment));
    const glm::vec3 color = asked ? look::kAccent : look::kQuiet;
    if (asked || twin || row || work_.habits.look.crude) {
      Capsule(a, b, body.surface.limb_radius[i], Packed(color, asked ? 0.9f : 0.5f),
              Packed(color, asked ? 0.14f : 0.07f));
    }
    // The gray points of figure 5.
    for (const CalibrationPoint& dot : session_.calibration().At(segment).dots) {
      if (dot.state == PickState::kMissing || dot.place.part < 0) continue;
      const Vec3 at = session_.picker().Position(dot.place);
      const auto p = lens_.ToWindow(at);
      if (!p || !Sees(at)) continue;
      const float r = Px(asked ? 3.5f : 2.5f);
      list_.AddCircleFilled(Im(*p), r + Px(1.0f), Packed(look::kRoom, 0.7f), 12);
      list_.AddCircleFilled(Im(*p), r, Packed(Settled(dot.state) ? look::kGood : look::kQuiet), 12);
    }
  }
}

void Painter::Points(bool with_names) {
  const std::optional<PickItem>& current = session_.current();
  for (const PickItem& item : PickItems()) {
    if (item.segment) continue;
    const std::optional<Vec3> at = session_.PositionOf(item);
    const auto p = at ? lens_.ToWindow(*at) : std::nullopt;
    if (!p) continue;
    const bool asked = current == item;
    const bool seen = Sees(*at);
    const bool twin = current && session_.editor().Symmetric() && Mirror(*current) == item;
    if (twin && !asked) Halo(*at, look::kAccent, 9.0f, seen ? 0.6f : 0.2f);
    if (work_.hovered_row == item || work_.hover.item == item) Halo(*at, look::kText, 11.0f, 1.0f);
    Dot(*p, StateOf(session_.calibration(), item), asked, seen);
  }
  if (!with_names || !work_.hover.item) return;
  const std::optional<Vec3> at = session_.PositionOf(*work_.hover.item);
  const auto p = at ? lens_.ToWindow(*at) : std::nullopt;
  if (!p) return;
  const std::string name = Title(*work_.hover.item);
  const ImVec2 size = ImGui::CalcTextSize(name.c_str());
  const ImVec2 corner{static_cast<float>(p->x) + Px(16.0f),
                      static_cast<float>(p->y) - 0.5f * size.y};
  list_.AddRectFilled({corner.x - Px(6.0f), corner.y - Px(3.0f)},
                      {corner.x + size.x + Px(6.0f), corner.y + size.y + Px(3.0f)},
                      Packed(look::kRaised, 0.95f), Px(6.0f));
  list_.AddText(corner, Packed(look::kText), name.c_str());
}

void Painter::Joints() {
  const Character& character = *session_.editor().TheCharacter();
  const ModelPose& pose = session_.pose();
  for (std::size_t j = 1; j < kJointCount; ++j) {
    const auto a = lens_.ToWindow(pose.position_ws[Index(kParent[j])]);
    const auto b = lens_.ToWindow(pose.position_ws[j]);
    if (a && b) list_.AddLine(Im(*a), Im(*b), Packed(look::kSkeleton, 0.45f), Px(2.0f));
  }
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto p = lens_.ToWindow(pose.position_ws[j]);
    if (!p) continue;
    const HumanoidMap::Entry& entry = character.map.joint[j];
    const bool mended = session_.calibration().joint_override[j].has_value();
    const glm::vec3 color = mended                    ? look::kGood
                            : entry.node < 0          ? look::kQuiet
                            : entry.confidence >= 0.6 ? look::kSkeleton
                                                      : look::kWarn;
    const bool lit = work_.hover.joint && Index(*work_.hover.joint) == j;
    const bool asked = work_.asked_joint && Index(*work_.asked_joint) == j;
    const ImVec2 at = Im(*p);
    list_.AddCircleFilled(at, Px(7.5f), Packed(look::kRoom, 0.8f), 20);
    if (entry.node < 0) {
      list_.AddCircle(at, Px(5.0f), Packed(color), 20, Px(2.0f));
    } else {
      list_.AddCircleFilled(at, Px(6.0f), Packed(color), 20);
    }
    if (lit || asked) list_.AddCircle(at, Px(11.0f), Packed(look::kAccent), 32, Px(2.0f));
  }
}

void Painter::HoverMarks() {
  const Hover& hover = work_.hover;
  if (hover.ring) {
    std::vector<Vec3> places;
    for (const MeshPoint& place : hover.ring->place) {
      places.push_back(session_.picker().Position(place));
    }
    Polyline(places, hover.ring->closed, Packed(look::kAccent), Px(2.5f));
  }
  if (!hover.vertex || hover.item) return;
  const Vec3& at = hover.vertex->position_ws;
  const SurfaceMesh& surface = session_.editor().Surface();
  if (const auto vertex = surface.VertexAt(hover.vertex->place)) {
    for (const SurfaceMesh::Vertex next : surface.Neighbours(*vertex)) {
      const std::array<Vec3, 2> edge = {at, session_.picker().Position(surface.PlaceOf(next))};
      Polyline(edge, false, Packed(look::kAccent, 0.5f), Px(1.0f));
    }
  }
  if (const auto p = lens_.ToWindow(at)) {
    list_.AddCircleFilled(Im(*p), Px(3.5f), Packed(look::kAccent), 16);
    list_.AddCircle(Im(*p), Px(7.0f), Packed(look::kText), 24, Px(1.5f));
  }
  if (hover.mirror) {
    const Vec3 other = session_.picker().Position(*hover.mirror);
    Halo(other, look::kAccent, 6.0f, Sees(other) ? 0.9f : 0.4f);
  }
}

// A sentence on a raised ground, kept inside a rectangle.
void Bubble(ImDrawList& list, const Rect& within, ImVec2 at, const std::string& text, bool bad) {
  ImGui::PushFont(Gui::Current().fonts().small);
  const float wrap = Px(280.0f);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const ImVec2 pad{Px(10.0f), Px(6.0f)};
  at.x = std::clamp(at.x, within.x + Px(4.0f),
                    within.x + within.width - size.x - 2.0f * pad.x - Px(4.0f));
  at.y = std::clamp(at.y, within.y + Px(4.0f),
                    within.y + within.height - size.y - 2.0f * pad.y - Px(4.0f));
  const ImVec2 end{at.x + size.x + 2.0f * pad.x, at.y + size.y + 2.0f * pad.y};
  list.AddRectFilled(at, end, Packed(look::kRaised, 0.97f), Px(6.0f));
  if (bad) list.AddRectFilled(at, {at.x + Px(3.0f), end.y}, Packed(look::kWarn), Px(1.5f));
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x + pad.x, at.y + pad.y},
               Packed(look::kText), text.c_str(), nullptr, wrap);
  ImGui::PopFont();
}

// What a click would do, in words; of a joint, what it is.
std::string Promise(const CalibrationSession& session, const Hover& hover) {
  if (hover.joint) {
    const Character& character = *session.editor().TheCharacter();
    const HumanoidMap::Entry& entry = character.map.joint[Index(*hover.joint)];
    const auto node = static_cast<std::size_t>(std::max(0, entry.node));
    return WordsOf(*hover.joint) + ": " +
           (entry.node < 0 ? "no node" : character.nodes.joints[node].name);
  }
  if (hover.item || !hover.vertex) return {};
  if (!session.current()) return "Everything is settled. Choose a point in the list to change it.";
  return hover.no_mirror ? "No mirror vertex here: only this side is picked." : std::string();
}

void DrawLoupe(Studio& studio, const CalibrationSession& session, const Lens& lens,
               ImDrawList& list) {
  CalibrateWorkspace& work = studio.calibrate();
  if (!work.habits.loupe || !work.hover.vertex || work.hover.item || work.view().gliding()) return;
  const float side = Px(kLoupeSize);
  const Vec2 pointer(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
  const Rect& view = lens.rect;
  // Beside the pointer, away from what is aimed at, inside the picture.
  Rect rect{static_cast<float>(pointer.x) + Px(36.0f),
            static_cast<float>(pointer.y) - side - Px(28.0f), side, side};
  if (rect.x + side > view.x + view.width)
    rect.x = static_cast<float>(pointer.x) - side - Px(36.0f);
  if (rect.y < view.y + Px(44.0f)) rect.y = static_cast<float>(pointer.y) + Px(36.0f);
  const Lens loupe = CalibrateView::LoupeOf(lens, pointer, rect, kLoupeZoom);
  work.loupe.Set(
      work.view().DrawLoupe(studio.picture().renderer(), session, work.habits.look, loupe));
  const ImVec2 low{rect.x, rect.y};
  const ImVec2 high{rect.x + side, rect.y + side};
  list.AddImageRounded(work.loupe.id(), low, high, {0, 0}, {1, 1}, IM_COL32_WHITE, Px(10.0f));
  list.PushClipRect(low, high, true);
  Painter painter(list, loupe, session, work);
  painter.Limbs();
  painter.Points(false);
  painter.HoverMarks();
  list.PopClipRect();
  list.AddRect(low, high, Packed(look::kLine), Px(10.0f), 0, Px(2.0f));
}

}  // namespace

std::string WordsOf(HumanoidJoint joint) {
  std::string words;
  for (const char c : Name(joint)) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper) words += ' ';
    words += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

void DrawOverlay(Studio& studio, const CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  const Lens lens = work.LensOf(studio);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Rect& view = lens.rect;
  list.PushClipRect({view.x, view.y}, {view.x + view.width, view.y + view.height}, true);
  Painter painter(list, lens, session, work);
  if (work.list == CalibrateWorkspace::List::kJoints) {
    painter.Joints();
  } else {
    painter.Limbs();
    painter.Finding();
    painter.Points(true);
    painter.HoverMarks();
    DrawLoupe(studio, session, lens, list);
  }
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const std::string promise = Promise(session, work.hover);
  if (work.note()) {
    const Vec2& at = work.note()->at;
    Bubble(list, view, {static_cast<float>(at.x) + Px(18.0f), static_cast<float>(at.y) + Px(14.0f)},
           work.note()->text, work.note()->bad);
  } else if (!promise.empty()) {
    Bubble(list, view, {pointer.x + Px(18.0f), pointer.y + Px(14.0f)}, promise,
           work.hover.no_mirror);
  }
  list.PopClipRect();
}

}  // namespace ego
