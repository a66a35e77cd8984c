// SPDX-License-Identifier: MIT
#include "assets/motions/synthetic_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "assets/motions/motions.h"
#include "assets/motions/skin_measure.h"
#include "core/skeleton/pose.h"
#include "core/solve/solve_take.h"

namespace ego {
namespace {

const WornMarkers& Worn() {
  static const WornMarkers worn = WearMarkers(ScriptedPerformer(), StudioMarkerSet());
  return worn;
}

/// A shipped motion at a lower rate.
CapturedMotion MotionAt(std::string_view name, double rate_hz) {
  const Result<const MotionScript*> script = FindMotion(name);
  EXPECT_TRUE(script) << script.error();
  const MotionPlayer player(ScriptedFigure(), **script);
  CapturedMotion motion;
  motion.name = name;
  motion.performer = ScriptedPerformer().body;
  motion.rate_hz = rate_hz;
  for (double t = 0.0; t < (*script)->Duration(); t += 1.0 / rate_hz) {
    motion.poses.push_back(player.At(t));
  }
  return motion;
}

std::size_t MarkerNamed(const MarkerTake& take, std::string_view label) {
  return static_cast<std::size_t>(std::find(take.labels.begin(), take.labels.end(), label) -
                                  take.labels.begin());
}

TEST(SyntheticMarkers, AreThoseOfTheStudioSet) {
  ASSERT_EQ(Worn().labels.size(), 38u);
  for (std::size_t m = 0; m < 38; ++m) {
    EXPECT_EQ(Worn().labels[m], StudioMarkerSet().markers[m].label);
    // Each within a hand's breadth of where the set has it on the template.
    const Vec3 place = Position(ScriptedPerformer().character,
                                CanonicalMesh(ScriptedPerformer().character), Worn().places[m]);
    EXPECT_LT(glm::distance(place, StudioMarkerSet().markers[m].position_ms), 0.09)
        << Worn().labels[m];
  }
}

TEST(SyntheticMarkers, SitAboveTheSkinInEveryPose) {
  const CapturedMotion motion = MotionAt("M9", 2.0);
  const auto take = RecordMarkers(ScriptedPerformer(), Worn(), motion);
  SkinMeasure skin(ScriptedPerformer().character);
  const std::size_t hand = MarkerNamed(*take, "LFIN");
  const std::size_t chest = MarkerNamed(*take, "STRN");
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    skin.SetPose(motion.poses[f]);
    // Gap leaves one limb out: for each marker one that it is not on.
    EXPECT_NEAR(skin.Gap(take->Frame(f).position_ws[chest], Limb::kLeftLeg), 0.007, 0.001);
    EXPECT_NEAR(skin.Gap(take->Frame(f).position_ws[hand], Limb::kRightArm), 0.007, 0.001);
  }
}

TEST(SyntheticMarkers, NoiseIsWhiteAndOfTheGivenSize) {
  const CapturedMotion motion = MotionAt("wave", 60.0);
  SyntheticMarkerOptions options;
  options.noise = 0.002;
  const auto clean = RecordMarkers(ScriptedPerformer(), Worn(), motion);
  const auto noisy = RecordMarkers(ScriptedPerformer(), Worn(), motion, options);
  const auto again = RecordMarkers(ScriptedPerformer(), Worn(), motion, options);
  EXPECT_EQ(noisy->position_ws, again->position_ws);
  options.seed = 2;
  EXPECT_NE(RecordMarkers(ScriptedPerformer(), Worn(), motion, options)->position_ws,
            noisy->position_ws);
  double sum = 0.0;
  double square = 0.0;
  double neighbours = 0.0;
  const std::size_t n = clean->position_ws.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 d = noisy->position_ws[i] - clean->position_ws[i];
    sum += d.x + d.y + d.z;
    square += glm::dot(d, d);
    if (i + 38 < n)
      neighbours += glm::dot(d, noisy->position_ws[i + 38] - clean->position_ws[i + 38]);
  }
  const double count = 3.0 * static_cast<double>(n);
  const double deviation = std::sqrt(square / count);
  EXPECT_NEAR(deviation, 0.002, 0.0001);
  EXPECT_LT(std::abs(sum / count), 4.0 * 0.002 / std::sqrt(count));
  EXPECT_LT(std::abs(neighbours / square), 0.03);  // one frame tells nothing of the next
}

TEST(SyntheticMarkers, SoftTissueLagsOnlyWhereThereIsAnyAndWhileMoving) {
  CapturedMotion motion = MotionAt("clap", 60.0);
  // A long rest after the motion.
  for (int i = 0; i < 120; ++i) motion.poses.push_back(motion.poses.back());
  SyntheticMarkerOptions options;
  options.wobble = 0.5;
  const auto rigid = RecordMarkers(ScriptedPerformer(), Worn(), motion);
  const auto soft = RecordMarkers(ScriptedPerformer(), Worn(), motion, options);
  double largest = 0.0;
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    for (std::size_t m = 0; m < 38; ++m) {
      const double off =
          glm::distance(rigid->Frame(f).position_ws[m], soft->Frame(f).position_ws[m]);
      largest = std::max(largest, off);
      if (Worn().regions[m] == MarkerRegion::kHead || Worn().regions[m] == MarkerRegion::kFoot) {
        EXPECT_EQ(off, 0.0);
      }
      if (f + 1 == motion.poses.size()) {
        EXPECT_LT(off, 1e-4);
      }
    }
  }
  EXPECT_GT(largest, 0.002);
  EXPECT_LT(largest, 0.05);
}

TEST(SyntheticMarkers, StrayPlacesStayOnTheSkin) {
  SyntheticMarkerOptions options;
  options.placement_spread = 1.0;
  const WornMarkers stray = WearMarkers(ScriptedPerformer(), StudioMarkerSet(), options);
  const PosedMesh mesh = CanonicalMesh(ScriptedPerformer().character);
  double sum = 0.0;
  for (std::size_t m = 0; m < 38; ++m) {
    ASSERT_TRUE(IsOn(ScriptedPerformer().character, stray.places[m]));
    sum += glm::distance(Position(ScriptedPerformer().character, mesh, stray.places[m]),
                         Position(ScriptedPerformer().character, mesh, Worn().places[m]));
  }
  EXPECT_GT(sum / 38.0, 0.01);
  EXPECT_LT(sum / 38.0, 0.06);
}

/// Does the segment cross the triangle? Signs of volumes, nothing in common with the hierarchy's
/// own test.
bool Crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto volume = [](const Vec3& u, const Vec3& v, const Vec3& w, const Vec3& x) {
    return glm::dot(glm::cross(v - u, w - u), x - u);
  };
  if (volume(a, b, c, p) * volume(a, b, c, q) > 0.0) return false;
  const double s1 = volume(p, q, a, b);
  const double s2 = volume(p, q, b, c);
  const double s3 = volume(p, q, c, a);
  return (s1 > 0.0) == (s2 > 0.0) && (s2 > 0.0) == (s3 > 0.0);
}

TEST(Occlusion, AgreesWithBruteForce) {
  const CapturedMotion motion = MotionAt("arms_crossed", 2.0);
  const Character& character = ScriptedPerformer().character;
  SkinMeasure skin(character);
  skin.SetPose(motion.poses[5]);
  const auto take = RecordMarkers(ScriptedPerformer(), Worn(), motion);
  const std::span<const Vec3> points = take->Frame(5).position_ws;
  const CameraRing ring{.count = 5, .radius = 3.0, .height = 2.0, .seen_by = 2};
  const std::vector<std::uint8_t> seen = SeenByCameras(character, skin.mesh(), points, {}, ring);
  for (std::size_t m = 0; m < points.size(); ++m) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < ring.count; ++c) {
      const double angle = 2.0 * kPi * (static_cast<double>(c) + 0.5) / 5.0;
      const Vec3 camera{3.0 * std::sin(angle), 2.0, 3.0 * std::cos(angle)};
      bool blocked = false;
      for (std::size_t p = 0; p < character.parts.size() && !blocked; ++p) {
        const auto& t = character.parts[p].triangles;
        const auto& v = skin.mesh().position_ws[p];
        for (std::size_t i = 0; i + 2 < t.size() && !blocked; i += 3) {
          blocked = Crosses(points[m], camera, v[t[i]], v[t[i + 1]], v[t[i + 2]]);
        }
      }
      count += blocked ? 0 : 1;
    }
    EXPECT_EQ(seen[m] != 0, count >= 2) << take->labels[m];
  }
}

TEST(Occlusion, ABodyHidesWhatIsBehindItAndNothingElse) {
  CapturedMotion stand = MotionAt("wave", 60.0);
  stand.poses.resize(1);
  SyntheticMarkerOptions options;
  options.occlusion = true;
  options.cameras = {.count = 1, .radius = 4.0, .height = 1.3, .seen_by = 1};  // one, behind
  const auto from_behind = RecordMarkers(ScriptedPerformer(), Worn(), stand, options);
  EXPECT_FALSE(from_behind->visible[MarkerNamed(*from_behind, "STRN")]);
  EXPECT_FALSE(from_behind->visible[MarkerNamed(*from_behind, "CLAV")]);
  EXPECT_TRUE(from_behind->visible[MarkerNamed(*from_behind, "C7")]);
  EXPECT_TRUE(from_behind->visible[MarkerNamed(*from_behind, "T10")]);
  options.cameras = {};
  const auto all_around = RecordMarkers(ScriptedPerformer(), Worn(), stand, options);
  EXPECT_GE(std::count(all_around->visible.begin(), all_around->visible.end(), 1), 36);
}

TEST(Occlusion, FoldedBodiesHideMoreThanStandingOnes) {
  SyntheticMarkerOptions options;
  options.occlusion = true;
  const auto hidden = [&](const char* name) {
    const auto take = RecordMarkers(ScriptedPerformer(), Worn(), MotionAt(name, 3.0), options);
    return static_cast<double>(std::count(take->visible.begin(), take->visible.end(), 0)) /
           static_cast<double>(take->visible.size());
  };
  const double wave = hidden("wave");
  const double thoughtful = hidden("M7");
  std::printf("markers hidden: wave %.1f %%, thoughtful %.1f %%\n", 100.0 * wave,
              100.0 * thoughtful);
  EXPECT_LT(wave, 0.05);
  EXPECT_GT(thoughtful, wave + 0.02);
}

/// The solver, given the markers of the gym sequence and nothing else, finds the joints where they
/// truly are.
TEST(SyntheticMarkers, SolvingFindsTheTrueJointCentres) {
  const CapturedMotion truth = MotionAt("gym", 20.0);
  SyntheticMarkerOptions options;
  options.noise = 0.0005;
  options.wobble = 0.2;
  const auto take = RecordMarkers(ScriptedPerformer(), Worn(), truth, options);
  const Result<SolvedTake> solved = SolveTake(*take, StudioMarkerSet());
  ASSERT_TRUE(solved) << solved.error();
  std::array<double, kJointCount> off{};
  double mean = 0.0;
  for (std::size_t f = 0; f < truth.poses.size(); ++f) {
    const ModelPose a = ForwardKinematics(truth.performer.skeleton, truth.poses[f]);
    const ModelPose b =
        ForwardKinematics(solved->motion.performer.skeleton, solved->motion.poses[f]);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      off[j] += glm::distance(a.position_ws[j], b.position_ws[j]) /
                static_cast<double>(truth.poses.size());
    }
  }
  int count = 0;
  for (const Limb limb : kLimbs) {
    for (const HumanoidJoint joint :
         {JointsOf(limb).base, JointsOf(limb).mid, JointsOf(limb).end}) {
      std::printf("%-14s off by %4.1f mm\n", std::string(Name(joint)).c_str(),
                  1000.0 * off[Index(joint)]);
      EXPECT_LT(off[Index(joint)], 0.012) << Name(joint);
      mean += off[Index(joint)];
      ++count;
    }
  }
  std::printf("limb joints off by %.1f mm in the mean, residual %.1f mm\n", 1000.0 * mean / count,
              solved->report.mean_residual_mm);
  EXPECT_LT(mean / count, 0.007);
}

}  // namespace
}  // namespace ego
