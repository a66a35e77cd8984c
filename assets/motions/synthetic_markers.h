// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "assets/people/person.h"
#include "core/markers/marker_set.h"
#include "core/markers/marker_take.h"
#include "core/model/mesh_point.h"
#include "core/pipeline/captured_motion.h"

namespace ego {

/// The cameras of a stage: a ring around the performer, all looking inward.
struct CameraRing {
  std::size_t count = 8;
  double radius = 4.0;  // metres
  double height = 2.4;  // metres
  /// A marker needs so many cameras to be located.
  std::size_t seen_by = 2;
};

/// How the markers of a synthetic performer differ from points of its skin. All off by default.
struct SyntheticMarkerOptions {
  double stand_off = 0.007;  // centre of a 14 mm marker above the skin, metres
  /// How far markers are stuck from where the set puts them, along the skin, in its sigmas.
  double placement_spread = 0.0;
  /// Soft tissue: markers of trunk and limbs lag behind the bone like masses on damped springs
  /// (5 Hz, damping 0.25); 1: flabby, 0.3: lean, 0: rigid.
  double wobble = 0.0;
  double noise = 0.0;  // standard deviation of each coordinate, metres, white
  bool occlusion = false;
  CameraRing cameras;
  std::uint32_t seed = 1;
};

/// Where a person wears the markers of a set, on the skin; one for each marker of the set.
struct WornMarkers {
  std::vector<std::string> labels;
  std::vector<MeshPoint> places;
  std::vector<MarkerRegion> regions;
};

/// Sticks a set's markers to the skin nearest to where the set has them on a person of these
/// proportions.
WornMarkers WearMarkers(const Person& person, const MarkerSet& set,
                        const SyntheticMarkerOptions& options = {});

/// Which points are seen by enough cameras past the posed skin: rays from each point to each
/// camera of a ring around `center_ws` (its height does not matter). Points lie just above the
/// skin.
std::vector<std::uint8_t> SeenByCameras(const Character& character, const PosedMesh& mesh,
                                        std::span<const Vec3> points_ws, const Vec3& center_ws,
                                        const CameraRing& cameras);

/// The markers moving with the skin of a motion of this person. Deterministic.
std::shared_ptr<const MarkerTake> RecordMarkers(const Person& person, const WornMarkers& markers,
                                                const CapturedMotion& motion,
                                                const SyntheticMarkerOptions& options = {});

/// The studio's own marker set, which the scripted performer wears.
const MarkerSet& StudioMarkerSet();

}  // namespace ego
