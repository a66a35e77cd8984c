// SPDX-License-Identifier: MIT
#include <algorithm>

#include "assets/calibration/check_calibration_impl.h"

namespace ego {

using S = SamplePoint;

S CalibrationChecker::Impl::WorstCorner(const SamplePlaces& places,
                                        const std::vector<std::size_t>& triangles,
                                        std::size_t of) const {
  const SamplePlaces& usual = draft.template_body.surface.sample_ms;
  S worst = SampleTriangles()[of][0];
  std::pair<std::size_t, double> most{0, -1.0};
  for (const S p : SampleTriangles()[of]) {
    std::size_t count = 0;
    for (const std::size_t t : triangles) {
      const SampleTriangle& corners = SampleTriangles()[t];
      count += static_cast<std::size_t>(std::count(corners.begin(), corners.end(), p));
    }
    const std::pair<std::size_t, double> here{count,
                                              glm::distance(places[Index(p)], usual[Index(p)])};
    if (here > most) {
      most = here;
      worst = p;
    }
  }
  return worst;
}

void CalibrationChecker::Impl::CheckTriangles(Look& look) const {
  const auto sound = Soundness(look.places, draft.template_body.surface.sample_ms);
  std::vector<std::size_t> bad;
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    if (sound[t] <= 0.0) bad.push_back(t);
  }
  // One finding for each point that is at fault, with all of its triangles.
  std::array<std::vector<std::size_t>, kSampleCount> flipped;
  std::array<std::vector<std::size_t>, kSampleCount> flat;
  for (const std::size_t t : bad) {
    const S worst = WorstCorner(look.places, bad, t);
    (sound[t] < 0.0 ? flipped : flat)[Index(worst)].push_back(t);
  }
  for (const bool is_flat : {false, true}) {
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      const std::vector<std::size_t>& triangles = is_flat ? flat[i] : flipped[i];
      if (triangles.empty()) continue;
      const PointId id = PointId::Of(static_cast<S>(i));
      const std::string count =
          triangles.size() == 1 ? "A triangle of the crude mesh"
                                : std::to_string(triangles.size()) + " triangles of the crude mesh";
      const std::string fault =
          is_flat
              ? (triangles.size() == 1 ? " has" : " have") + std::string(" hardly any area at the ")
              : (triangles.size() == 1 ? " faces" : " face") + std::string(" inward at the ");
      CalibrationFinding& finding =
          Add(look, is_flat ? Severity::kWarning : Severity::kError,
              is_flat ? FindingKind::kDegenerateTriangle : FindingKind::kFlippedTriangle,
              count + fault + Lower(Title(id)) + ".", {id});
      finding.triangles = triangles;
      for (const std::size_t t : triangles) {
        for (const S p : SampleTriangles()[t]) {
          if (std::find(finding.points.begin(), finding.points.end(), PointId::Of(p)) ==
              finding.points.end()) {
            finding.points.push_back(PointId::Of(p));
          }
        }
      }
    }
  }
}

void CalibrationChecker::Impl::CheckCrossings(Look& look) const {
  const auto crossing = CrossingTriangles(look.places);
  if (crossing.empty()) return;
  std::vector<std::size_t> all;
  for (const auto& [a, b] : crossing) {
    all.push_back(a);
    all.push_back(b);
  }
  std::array<std::vector<std::size_t>, kSampleCount> by_point;
  for (const auto& [a, b] : crossing) {
    const S first = WorstCorner(look.places, all, a);
    auto& triangles = by_point[Index(first)];
    for (const std::size_t t : {a, b}) {
      if (std::find(triangles.begin(), triangles.end(), t) == triangles.end()) {
        triangles.push_back(t);
      }
    }
  }
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    if (by_point[i].empty()) continue;
    const PointId id = PointId::Of(static_cast<S>(i));
    Add(look, Severity::kError, FindingKind::kSelfCrossing,
        "The crude mesh cuts through itself at the " + Lower(Title(id)) + ".", {id})
        .triangles = by_point[i];
  }
}

}  // namespace ego
