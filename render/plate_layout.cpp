// SPDX-License-Identifier: MIT
#include "render/plate_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ego {
namespace {

constexpr float kTypeSize = 15.0f;
constexpr float kHeight = 26.0f;
constexpr float kPadding = 11.0f;
constexpr float kMark = 8.0f;  // across
constexpr float kGap = 7.0f;
constexpr float kOpacity = 0.86f;

struct Placed {
  const DrawList::Plate* plate = nullptr;
  float depth = 0.0f;  // clip space
  double distance = 0.0;
  glm::vec2 min{0.0f}, max{0.0f};  // pixels, y down
  std::vector<TextAtlas::Quad> quads;

  float Height() const { return max.y - min.y; }
};

void MoveTo(float top, Placed& p) {
  const float height = p.Height();
  p.min.y = top;
  p.max.y = top + height;
}

/// Moves a plate down (or up) until it covers none of the others.
void GiveWay(std::span<const Placed> others, float gap, bool down, Placed& p) {
  // Each move passes one of the others for good: there are no more moves than plates.
  for (std::size_t moves = 0; moves <= others.size(); ++moves) {
    const auto covered = std::find_if(others.begin(), others.end(), [&](const Placed& o) {
      return p.min.x <= o.max.x && p.max.x >= o.min.x && p.min.y <= o.max.y && p.max.y >= o.min.y;
    });
    if (covered == others.end()) return;
    MoveTo(down ? covered->max.y + gap : covered->min.y - gap - p.Height(), p);
  }
}

/// Clip depth at which a plate is drawn: a little nearer than its anchor and than the floor behind
/// its lower edge, so that neither the own toes nor the floor cut it, but bodies before it do.
float DepthOf(const Placed& p, const Camera& camera, const Mat4& clip, ViewportSize size) {
  const Vec3 eye = camera.Position();
  const Vec3 ray = camera.RayThrough({0.5 * (p.min.x + p.max.x), p.max.y}, size);
  Vec3 at = p.plate->anchor_ws;
  if (ray.y < -1e-6 && eye.y > 0.0) {
    const Vec3 floor = eye - (eye.y / ray.y) * ray;
    if (glm::length(floor - eye) < glm::length(at - eye)) at = floor;
  }
  const double distance = glm::length(at - eye);
  if (distance < 1e-6) return 0.0f;
  at += std::min(0.2, 0.3 * distance) / distance * (eye - at);
  const Vec4 h = clip * Vec4(at, 1.0);
  return static_cast<float>(h.z / h.w);
}

class Writer {
 public:
  Writer(ViewportSize size, std::vector<PlateVertex>& out)
      : size_(size.width, size.height), out_(out) {}

  void Rectangle(const glm::vec2& min, const glm::vec2& max, float depth, float radius,
                 const glm::vec4& color) {
    // A pixel more on each side, for the soft edge.
    Quad(min - 1.0f, max + 1.0f, depth, {0.5f * (max - min), radius, 0.0f}, {}, {}, color);
  }
  void Glyph(const glm::vec2& pen, const TextAtlas::Quad& quad, float depth,
             const glm::vec4& color) {
    Quad(pen + quad.min, pen + quad.max, depth, {1.0f, 1.0f, 0.0f, 1.0f}, quad.uv_min, quad.uv_max,
         color);
  }

 private:
  void Quad(const glm::vec2& min, const glm::vec2& max, float depth, const glm::vec4& shape,
            const glm::vec2& uv_min, const glm::vec2& uv_max, const glm::vec4& color) {
    constexpr std::array<glm::vec2, 6> kCorners = {glm::vec2{0, 0}, {1, 0}, {1, 1},
                                                   glm::vec2{0, 0}, {1, 1}, {0, 1}};
    for (const glm::vec2& c : kCorners) {
      const glm::vec2 pixel = glm::mix(min, max, c);
      const glm::vec2 ndc = 2.0f * pixel / size_ - 1.0f;
      out_.push_back({{ndc.x, -ndc.y, depth},
                      pixel - 0.5f * (min + max),
                      shape,
                      glm::mix(uv_min, uv_max, c),
                      color});
    }
  }
  glm::vec2 size_;
  std::vector<PlateVertex>& out_;
};

}  // namespace

void LayoutPlates(std::span<const DrawList::Plate> plates, const Camera& camera, ViewportSize size,
                  float content_scale, TextAtlas& atlas, std::vector<PlateVertex>& out) {
  const float s = std::clamp(content_scale, 0.5f, 8.0f);
  atlas.SetSize(std::round(kTypeSize * s));
  const Mat4 clip = camera.Projection(size) * camera.View();
  const auto snap = [](float v) { return std::round(v); };

  std::vector<Placed> placed;
  for (const DrawList::Plate& plate : plates) {
    const std::optional<Vec3> pixel = camera.Project(plate.anchor_ws, size);
    if (!pixel || pixel->x < 0.0 || pixel->x > size.width || pixel->y < 0.0 ||
        pixel->y > size.height) {
      continue;
    }
    Placed& p = placed.emplace_back();
    p.plate = &plate;
    p.distance = pixel->z;
    const float text = atlas.Layout(plate.name, p.quads);
    const float width = text + s * (2.0f * kPadding + kMark + kGap);
    // A long name beside the picture's edge stays whole.
    const float margin = snap(3.0f * s);
    const float right_most = std::max(margin, static_cast<float>(size.width) - margin - width);
    const float left = std::clamp(static_cast<float>(pixel->x) - 0.5f * width, margin, right_most);
    p.min = {snap(left), snap(static_cast<float>(pixel->y))};
    p.max = p.min + glm::vec2{std::ceil(width), snap(s * kHeight)};
  }
  // The nearest keep their place; others give way downwards, or upwards at the picture's edge.
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.distance < b.distance; });
  const float gap = snap(3.0f * s);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::span<const Placed> nearer(placed.data(), i);
    const float wanted = placed[i].min.y;
    GiveWay(nearer, gap, true, placed[i]);
    if (placed[i].max.y <= static_cast<float>(size.height) - gap) continue;
    MoveTo(std::min(wanted, static_cast<float>(size.height) - gap - placed[i].Height()), placed[i]);
    GiveWay(nearer, gap, false, placed[i]);
  }
  for (Placed& p : placed) p.depth = DepthOf(p, camera, clip, size);
  Writer writer(size, out);
  for (auto it = placed.rbegin(); it != placed.rend(); ++it) {
    const Placed& p = *it;
    const float radius = 0.5f * (p.max.y - p.min.y);
    writer.Rectangle(p.min, p.max, p.depth, radius, glm::vec4(look::kPanel, kOpacity));
    const float middle = 0.5f * (p.min.y + p.max.y);
    const glm::vec2 mark{p.min.x + s * kPadding, middle - 0.5f * s * kMark};
    writer.Rectangle(mark, mark + s * kMark, p.depth, 0.5f * s * kMark,
                     glm::vec4(p.plate->color, 1.0f));
    const glm::vec2 pen{snap(mark.x + s * (kMark + kGap)), snap(middle + 0.5f * atlas.CapHeight())};
    for (const TextAtlas::Quad& quad : p.quads) {
      writer.Glyph(pen, quad, p.depth, glm::vec4(look::kText, 1.0f));
    }
  }
}

}  // namespace ego
