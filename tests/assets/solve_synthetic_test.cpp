// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string_view>

#include <gtest/gtest.h>

#include "assets/markers/marker_set_file.h"
#include "assets/motions/motions.h"
#include "core/solve/performer_surface.h"
#include "core/solve/solve_take.h"
#include "core/solve/standing.h"
#include "tests/support/synthetic_performer.h"

namespace ego {
namespace {

using J = HumanoidJoint;

const MarkerSet& SetNamed(std::string_view name) {
  for (const MarkerSet& set : ShippedMarkerSets()) {
    if (set.name == name) return set;
  }
  ADD_FAILURE() << "no set " << name;
  return ShippedMarkerSets().front();
}

/// One fit shared by the tests below: a performer with known bones, 1 mm noise.
struct Known {
  test::SyntheticTake made;
  SkeletonFit fit;
};
const Known& KnownPerformer() {
  static const Known kKnown = [] {
    test::SyntheticOptions options;
    options.frames = 300;
    Known known{test::MakeSyntheticTake(SetNamed("Studio 38"), options), {}};
    Result<SkeletonFit> fit = FitSkeleton(known.made.take, SetNamed("Studio 38"));
    EXPECT_TRUE(fit) << fit.error();
    if (fit) known.fit = *std::move(fit);
    return known;
  }();
  return kKnown;
}

double MeanJointError(const Known& known, const std::vector<Pose>& poses) {
  double sum = 0.0;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    sum += test::MeanJointDistance(known.fit.model.skeleton, poses[f], known.made.truth.skeleton,
                                   known.made.poses[f]);
  }
  return sum / static_cast<double>(poses.size());
}

std::vector<Pose> SolveAll(const Known& known, const MarkerTake& take,
                           const PoseSolverOptions& options = {}) {
  const PoseSolver solver(known.fit.model, options);
  PoseSolver::State state;
  std::vector<Pose> poses;
  for (std::size_t f = 0; f < take.frame_count; ++f) {
    solver.Solve(take.Frame(f), state);
    poses.push_back(state.pose);
  }
  return poses;
}

double LargestShift(const Skeleton& skeleton, const std::vector<Pose>& a,
                    const std::vector<Pose>& b) {
  double largest = 0.0;
  for (std::size_t f = 0; f < a.size(); ++f) {
    const ModelPose pa = ForwardKinematics(skeleton, a[f]);
    const ModelPose pb = ForwardKinematics(skeleton, b[f]);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      largest = std::max(largest, glm::distance(pa.position_ws[j], pb.position_ws[j]));
    }
  }
  return largest;
}

std::size_t LabelIndex(const MarkerTake& take, std::string_view label) {
  return static_cast<std::size_t>(std::find(take.labels.begin(), take.labels.end(), label) -
                                  take.labels.begin());
}

TEST(SkeletonFit, RecoversKnownBonesAndJoints) {
  const Known& known = KnownPerformer();
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const J end = EndJoint(static_cast<LimbSegment>(s));
    const double truth = BoneLength(known.made.truth.skeleton, end);
    EXPECT_NEAR(BoneLength(known.fit.model.skeleton, end), truth, 0.013 * truth) << Name(end);
    const double mirror = BoneLength(known.fit.model.skeleton, Mirror(end));
    EXPECT_NEAR(BoneLength(known.fit.model.skeleton, end), mirror, 0.01 * truth) << Name(end);
  }
  EXPECT_LT(MeanJointError(known, SolveAll(known, known.made.take)), 0.004);
}

TEST(SkeletonFit, ResidualIsTheNoiseNoLess) {
  // Mean length of a 3D error of 1 mm per axis is 1.6 mm; well below would mean over-fitting.
  const Known& known = KnownPerformer();
  EXPECT_GT(known.fit.mean_residual, 0.0010);
  EXPECT_LT(known.fit.mean_residual, 0.0018);
}

TEST(SkeletonFit, SkinThatSlidesNeitherStretchesBonesNorRaisesTheResidual) {
  test::SyntheticOptions options;
  options.frames = 300;
  options.skin = 0.2;
  const test::SyntheticTake made = test::MakeSyntheticTake(SetNamed("CMU 41"), options);
  const Result<SkeletonFit> fit = FitSkeleton(made.take, SetNamed("CMU 41"));
  ASSERT_TRUE(fit) << fit.error();
  EXPECT_LT(fit->mean_residual, 0.0018);  // the noise; rigid markers would leave 2.9 mm
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const J end = EndJoint(static_cast<LimbSegment>(s));
    const double truth = BoneLength(made.truth.skeleton, end);
    EXPECT_NEAR(BoneLength(fit->model.skeleton, end), truth, (s < 4 ? 0.032 : 0.015) * truth)
        << Name(end);
  }
}

TEST(SkeletonFit, ScalesWithTheBody) {
  // A child two thirds the size, its marker errors in proportion.
  test::SyntheticOptions options;
  options.frames = 200;
  options.scale = 0.62;
  options.length_spread = 0.012;
  const test::SyntheticTake child = test::MakeSyntheticTake(SetNamed("CMU 41"), options);
  const Result<SkeletonFit> fit = FitSkeleton(child.take, SetNamed("CMU 41"));
  ASSERT_TRUE(fit) << fit.error();
  EXPECT_NEAR(fit->scale, 0.62, 0.03);
  for (const LimbSegment segment : {LimbSegment::kLeftThigh, LimbSegment::kRightCalf}) {
    const double truth = BoneLength(child.truth.skeleton, EndJoint(segment));
    EXPECT_NEAR(BoneLength(fit->model.skeleton, EndJoint(segment)), truth, 0.02 * truth);
  }
}

TEST(SkeletonFit, RefusesWrongUnitsAndTooFewMarkers) {
  test::SyntheticOptions options;
  options.frames = 20;
  test::SyntheticTake made = test::MakeSyntheticTake(SetNamed("CMU 41"), options);
  for (Vec3& p : made.take.position_ws) p *= 10.0;
  const Result<SkeletonFit> giant = FitSkeleton(made.take, SetNamed("CMU 41"));
  ASSERT_FALSE(giant);
  EXPECT_NE(giant.error().find("unit"), std::string::npos) << giant.error();

  std::fill(made.take.visible.begin(), made.take.visible.end(), std::uint8_t{0});
  const Result<SkeletonFit> blind = FitSkeleton(made.take, SetNamed("CMU 41"));
  ASSERT_FALSE(blind);
  EXPECT_NE(blind.error().find("0 markers"), std::string::npos) << blind.error();
}

TEST(PoseSolver, ColdAndWarmStartsAgree) {
  const Known& known = KnownPerformer();
  // Without the temporal prior, whose lag on hardly visible axes is wanted.
  PoseSolverOptions options;
  options.step_per_frame = 0.0;
  const PoseSolver solver(known.fit.model, options);
  const std::vector<Pose> warm = SolveAll(known, known.made.take, options);
  for (std::size_t f = 0; f < warm.size(); f += 29) {
    PoseSolver::State state;
    ASSERT_TRUE(solver.SolveCold(known.made.take.Frame(f), state).solved);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const double dot = std::abs(glm::dot(state.pose.rotation_ls[j], warm[f].rotation_ls[j]));
      EXPECT_LT(Degrees(2.0 * std::acos(std::min(1.0, dot))), 1.0)
          << "frame " << f << " " << Name(static_cast<J>(j));
    }
  }
}

TEST(PoseSolver, IsBitRepeatable) {
  const Known& known = KnownPerformer();
  const PoseSolver solver(known.fit.model, {});
  PoseSolver::State a;
  PoseSolver::State b;
  for (std::size_t f = 0; f < 20; ++f) {
    solver.Solve(known.made.take.Frame(f), a);
    solver.Solve(known.made.take.Frame(f), b);
    EXPECT_EQ(a.pose.root_ws, b.pose.root_ws);
    EXPECT_EQ(a.pose.rotation_ls, b.pose.rotation_ls);
  }
}

TEST(PoseSolver, TurningAndMovingTheMarkersTurnsAndMovesThePose) {
  const Known& known = KnownPerformer();
  const Quat turn = glm::angleAxis(2.5, kUp);
  const Vec3 shift{3.0, 0.5, -2.0};
  MarkerTake moved = known.made.take;
  for (Vec3& p : moved.position_ws) p = turn * p + shift;
  const std::vector<Pose> before = SolveAll(known, known.made.take);
  const std::vector<Pose> after = SolveAll(known, moved);
  for (std::size_t f = 0; f < before.size(); f += 10) {
    EXPECT_LT(glm::distance(after[f].root_ws, turn * before[f].root_ws + shift), 1e-4);
    for (std::size_t j = 1; j < kJointCount; ++j) {
      EXPECT_GT(std::abs(glm::dot(after[f].rotation_ls[j], before[f].rotation_ls[j])), 1.0 - 1e-6);
    }
  }
}

TEST(PoseSolver, OneLostMarkerMovesJointsLittle) {
  const Known& known = KnownPerformer();
  MarkerTake start = known.made.take;
  start.frame_count = 150;
  const std::vector<Pose> whole = SolveAll(known, start);
  for (std::size_t m = 0; m < start.labels.size(); ++m) {
    MarkerTake gap = start;
    for (std::size_t f = 100; f < 150; ++f) gap.visible[f * gap.labels.size() + m] = 0;
    EXPECT_LT(LargestShift(known.fit.model.skeleton, whole, SolveAll(known, gap)), 0.010)
        << gap.labels[m];
  }
}

TEST(PoseSolver, AGhostAMetreAwayIsNoWorseThanALostMarker) {
  const Known& known = KnownPerformer();
  for (const char* label : {"RTOE", "LELB", "LASI", "RFHD"}) {
    MarkerTake ghost = known.made.take;
    MarkerTake gap = known.made.take;
    const std::size_t m = LabelIndex(ghost, label);
    for (std::size_t f = 100; f < 150; ++f) {
      ghost.position_ws[f * ghost.labels.size() + m] += Vec3{0.8, 0.4, -0.5};
      gap.visible[f * gap.labels.size() + m] = 0;
    }
    EXPECT_LT(LargestShift(known.fit.model.skeleton, SolveAll(known, gap), SolveAll(known, ghost)),
              0.003)
        << label;
  }
}

TEST(PoseSolver, SurvivesNonsense) {
  const Known& known = KnownPerformer();
  const PoseSolver solver(known.fit.model, {});
  PoseSolver::State state;
  MarkerTake nonsense = known.made.take;
  for (std::size_t i = 0; i < nonsense.position_ws.size(); ++i) {
    if (i % 3 == 0) nonsense.position_ws[i] = {900.0, -900.0, static_cast<double>(i % 7)};
    if (i % 5 == 0) nonsense.position_ws[i] = Vec3{0.0};
  }
  for (std::size_t f = 0; f < 5; ++f) {
    solver.Solve(nonsense.Frame(f), state);
    EXPECT_TRUE(std::isfinite(state.pose.root_ws.x + state.pose.root_ws.y));
    for (const Quat& q : state.pose.rotation_ls) EXPECT_NEAR(glm::length(q), 1.0, 1e-9);
  }
}

TEST(PoseSolver, HoldsThePoseWhenTooLittleIsSeen) {
  const Known& known = KnownPerformer();
  const PoseSolver solver(known.fit.model, {});
  PoseSolver::State state;
  MarkerTake dark = known.made.take;
  std::fill(dark.visible.begin(), dark.visible.end(), std::uint8_t{0});
  EXPECT_FALSE(solver.Solve(dark.Frame(0), state).solved);
  EXPECT_FALSE(state.started);
  ASSERT_TRUE(solver.Solve(known.made.take.Frame(0), state).solved);
  const Pose held = state.pose;
  EXPECT_FALSE(solver.Solve(dark.Frame(1), state).solved);
  EXPECT_EQ(state.pose.rotation_ls, held.rotation_ls);
}

TEST(PerformerBody, IsSymmetricAndFollowsTheMarkersWithinBounds) {
  const MarkerSet& set = SetNamed("Studio 38");
  SkeletonFit fit = KnownPerformer().fit;
  fit.scale = 1.0;
  fit.model.skeleton = TemplateSkeleton(1.78);
  const auto canonical = CanonicalPositions(fit.model.skeleton);
  const auto dress = [&](double thicker) {  // markers on a body thicker all round by this much
    for (std::size_t m = 0; m < fit.model.markers.size(); ++m) {
      BoundMarker& marker = fit.model.markers[m];
      const SetMarker& place = set.markers[fit.set_marker[m]];
      marker.offset_ls = place.position_ms - canonical[Index(place.joint)];
      Vec3 out{place.position_ms.x, 0.0, place.position_ms.z};
      if (place.region == MarkerRegion::kLimb) {
        out = place.position_ms.y > 1.2 ? Vec3{0.0, 1.0, 0.0} : Vec3{place.position_ms.x, 0, 0};
      }
      marker.offset_ls += thicker * glm::normalize(out);
    }
    return PerformerBody("someone", fit, set);
  };
  const Body average = TemplateBody();
  const Body usual = dress(0.0);
  const Body fat = dress(0.05);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const auto point = static_cast<SamplePoint>(i);
    const Vec3& p = fat.surface.sample_ms[i];
    const Vec3& m = fat.surface.sample_ms[Index(Mirror(point))];
    EXPECT_LT(glm::distance(p, Vec3{-m.x, m.y, m.z}), 1e-9) << Name(point);
    // What is as on the template leaves the template; what is thicker moves out, not too far.
    EXPECT_LT(glm::distance(usual.surface.sample_ms[i], average.surface.sample_ms[i]), 1e-3);
    EXPECT_LT(glm::distance(p, average.surface.sample_ms[i]), 0.031);
  }
  EXPECT_GT(fat.surface.sample_ms[Index(SamplePoint::kSternumBase)].z,
            usual.surface.sample_ms[Index(SamplePoint::kSternumBase)].z + 0.01);
  EXPECT_GT(fat.surface.limb_radius[0], 1.1 * usual.surface.limb_radius[0]);
  EXPECT_LT(fat.surface.limb_radius[0], 1.16 * usual.surface.limb_radius[0]);
}

TEST(SolveTake, FillsFramesWithoutMarkersSmoothlyAndSaysSo) {
  test::SyntheticOptions options;
  options.frames = 160;
  test::SyntheticTake made = test::MakeSyntheticTake(SetNamed("CMU 41"), options);
  const std::size_t n = made.take.labels.size();
  for (std::size_t i = 60 * n; i < 80 * n; ++i) made.take.visible[i] = 0;
  const Result<SolvedTake> solved = SolveTake(made.take, SetNamed("CMU 41"));
  ASSERT_TRUE(solved) << solved.error();
  EXPECT_EQ(solved->report.frames_without_markers.size(), 20u);
  EXPECT_FALSE(solved->report.warnings.empty());
  ASSERT_EQ(solved->motion.poses.size(), 160u);
  for (std::size_t f = 1; f < 160; ++f) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const double dot = std::abs(glm::dot(solved->motion.poses[f].rotation_ls[j],
                                           solved->motion.poses[f - 1].rotation_ls[j]));
      EXPECT_LT(Degrees(2.0 * std::acos(std::min(1.0, dot))), 12.0) << f << " " << j;
    }
  }
}

TEST(SolveTake, TurnsALyingFileUpright) {
  test::SyntheticOptions options;
  options.frames = 120;
  const test::SyntheticTake made = test::MakeSyntheticTake(SetNamed("CMU 41"), options);
  MarkerTake lying = made.take;
  for (Vec3& p : lying.position_ws) p = {p.x, -p.z, p.y};  // its own up is now +Z
  const Result<SolvedTake> a = SolveTake(made.take, SetNamed("CMU 41"));
  const Result<SolvedTake> b = SolveTake(lying, SetNamed("CMU 41"));
  ASSERT_TRUE(a) << a.error();
  ASSERT_TRUE(b) << b.error();
  for (std::size_t f = 0; f < 120; f += 20) {
    EXPECT_LT(glm::distance(a->motion.poses[f].root_ws, b->motion.poses[f].root_ws), 0.01) << f;
  }
}

TEST(SolveTake, StopsWhenTold) {
  test::SyntheticOptions options;
  options.frames = 40;
  const test::SyntheticTake made = test::MakeSyntheticTake(SetNamed("CMU 41"), options);
  const Result<SolvedTake> stopped =
      SolveTake(made.take, SetNamed("CMU 41"), {}, [](double, std::string_view) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error(), "cancelled");
}

TEST(SolveTake, SolvesTheScriptedPerformersMarkersAsTheStudiosOwnSet) {
  // Markers on modelled skin, whose bones are known: the studio's set must name and place them all.
  const Result<ScriptedTake> take = PerformShipped("wave");
  ASSERT_TRUE(take) << take.error();
  const CapturedMotion* const motion = &take->motion;
  const Result<MarkerSet> set = ChooseMarkerSet(motion->markers->labels);
  ASSERT_TRUE(set) << set.error();
  EXPECT_EQ(set->name, "Studio 38");
  EXPECT_EQ(motion->markers->labels.size(), 38u);
  const Result<SkeletonFit> fit = FitSkeleton(*motion->markers, *set);
  ASSERT_TRUE(fit) << fit.error();
  EXPECT_EQ(fit->model.markers.size(), 38u);
  EXPECT_LT(fit->mean_residual, 0.004);
  EXPECT_NEAR(fit->scale * 1.78, motion->performer.height, 0.06 * motion->performer.height);
}

TEST(Standing, FindsTheFloorAndLevelsTheSoles) {
  // A body that stands, shifts its weight and lifts one foot now and then, on a floor 4 cm low,
  // whose left foot frame is pitched and rolled by a wrong marker place.
  const Body body = TemplateBody(1.7);
  MarkerModel model;
  model.skeleton = body.skeleton;
  model.markers = {{0, J::kLeftFoot, {0.0, -0.03, -0.07}}, {1, J::kLeftFoot, {0.0, -0.04, 0.14}}};
  const Quat wrong = glm::normalize(glm::angleAxis(Radians(9.0), Vec3{1, 0, 0}) *
                                    glm::angleAxis(Radians(4.0), Vec3{0, 0, 1}));
  const std::vector<BoundMarker> placed = model.markers;
  for (BoundMarker& m : model.markers) m.offset_ls = wrong * m.offset_ls;
  std::vector<Pose> poses;
  for (int f = 0; f < 300; ++f) {
    Pose pose = CanonicalPose(body.skeleton);
    pose.root_ws += Vec3{0.02 * std::sin(0.02 * f), -0.04, 0.0};
    if (f % 100 > 60) {
      const double lift = 0.9 * std::sin(kPi * (f % 100 - 60) / 40.0);
      pose.rotation_ls[Index(J::kRightUpperLeg)] = glm::angleAxis(-lift, Vec3{1, 0, 0});
      pose.rotation_ls[Index(J::kRightLowerLeg)] = glm::angleAxis(lift, Vec3{1, 0, 0});
    }
    pose.rotation_ls[Index(J::kLeftFoot)] = glm::conjugate(wrong);
    poses.push_back(pose);
  }
  LevelSoles(model, poses, 100.0);
  for (std::size_t m = 0; m < placed.size(); ++m) {
    EXPECT_LT(glm::distance(model.markers[m].offset_ls, placed[m].offset_ls), 1e-3);
  }
  for (const Pose& pose : poses) {
    EXPECT_NEAR(std::abs(pose.rotation_ls[Index(J::kLeftFoot)].w), 1.0, 1e-5);
  }
  EXPECT_NEAR(GroundHeight(body, poses, 100.0), -0.04, 0.005);
}

}  // namespace
}  // namespace ego
