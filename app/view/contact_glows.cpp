// SPDX-License-Identifier: MIT
#include "app/view/contact_glows.h"

#include <algorithm>
#include <array>

#include "core/metrics/surface_gap.h"

namespace ego {

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
      const double strength = GlowStrength(gap, body.height);
      if (strength <= 0.0) continue;
      ContactGlow glow;
      glow.position_ws = scale * spot.place;
      glow.strength = static_cast<float>(0.85 * strength);
      glows.push_back(glow);
    }
  }
}

}  // namespace ego
