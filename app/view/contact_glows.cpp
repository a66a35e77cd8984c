// SPDX-License-Identifier: MIT
#include "app/view/contact_glows.h"

#include <algorithm>
#include <array>

#include "core/metrics/surface_gap.h"

namespace ego {
namespace {

constexpr double kRadius = 0.042;  // shares of height
constexpr double kBrightest = 0.6;

// Light adds up: of spots that would cover each other, from `own` on, only the strongest is kept.
void AppendApart(const ContactGlow& glow, std::size_t own, std::vector<ContactGlow>& glows) {
  for (std::size_t i = own; i < glows.size(); ++i) {
    if (glm::distance(glows[i].position_ws, glow.position_ws) > static_cast<double>(glow.radius)) {
      continue;
    }
    if (glow.strength > glows[i].strength) glows[i] = glow;
    return;
  }
  glows.push_back(glow);
}

}  // namespace

double GlowStrength(double gap, double height) {
  constexpr double kTouching = 0.005;
  constexpr double kApart = 0.015;
  if (height <= 0.0) return 0.0;
  const double t = std::clamp((kApart - gap / height) / (kApart - kTouching), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void AppendContactGlows(const Body& body, const Pose& pose, double scale,
                        std::vector<ContactGlow>& glows) {
  const MeasuredBody measured(body, pose);
  const std::size_t own = glows.size();
  for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
    const std::size_t side = Index(arm);
    struct Spot {
      Vec3 place;
      double depth;  // below the skin
    };
    const std::array<Spot, 3> spots = {
        Spot{measured.Palm(side), 0.0}, Spot{measured.Fingertip(side), 0.0},
        Spot{measured.pose.Position(JointsOf(arm).end), body.surface.hand[side].half_thickness}};
    for (const Spot& spot : spots) {
      const double gap = SurfaceGap(measured, arm, spot.place) - spot.depth;
      ContactGlow glow;
      glow.position_ws = scale * spot.place;
      glow.strength = static_cast<float>(kBrightest * GlowStrength(gap, body.height));
      glow.radius = static_cast<float>(kRadius * scale * body.height);
      if (glow.strength > 0.0f) AppendApart(glow, own, glows);
    }
  }
}

}  // namespace ego
