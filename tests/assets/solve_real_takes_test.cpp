// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/markers/marker_set_file.h"
#include "assets/takes/c3d.h"
#include "assets/takes/trc.h"
#include "core/solve/solve_take.h"
#include "tests/support/shared_data.h"

namespace ego {
namespace {

using J = HumanoidJoint;

struct Bar {
  const char* file;
  double mean_mm;  // largest mean residual over visible markers
  // Where the mean is low for what the take shows, p95 may be this, mm, though it is above 2.5
  // means.
  double tail_mm = 0.0;
};
std::ostream& operator<<(std::ostream& out, const Bar& bar) { return out << bar.file; }

/// At most `count` frames of a take, evenly spread: enough to fit by and quick to solve.
MarkerTake Thinned(const MarkerTake& take, std::size_t count) {
  const std::size_t stride = std::max<std::size_t>(1, take.frame_count / count);
  MarkerTake thin = take;
  thin.position_ws.clear();
  thin.visible.clear();
  thin.frame_count = 0;
  thin.rate_hz = take.rate_hz / static_cast<double>(stride);
  for (std::size_t f = 0; f < take.frame_count; f += stride) {
    const MarkerFrame frame = take.Frame(f);
    thin.position_ws.insert(thin.position_ws.end(), frame.position_ws.begin(),
                            frame.position_ws.end());
    thin.visible.insert(thin.visible.end(), frame.visible.begin(), frame.visible.end());
    ++thin.frame_count;
  }
  return thin;
}

/// Angle by which a hinge is bent, signed, from the bone directions alone.
double Flexion(const Pose& pose, Limb limb) {
  const Vec3 bone = CanonicalDirection(limb);
  const Vec3 bent = pose.rotation_ls[Index(JointsOf(limb).mid)] * bone;
  return std::atan2(glm::dot(bent, glm::cross(FlexionAxis(limb), bone)), glm::dot(bent, bone));
}

class RealTakeSolve : public testing::TestWithParam<Bar> {};

TEST_P(RealTakeSolve, SolvesWithinTheBars) {
  EGO_SHARED_DATA_OR_SKIP(path, std::string("markers/") + GetParam().file);
  const Result<MarkerTake> take = path.extension() == ".trc" ? ReadTrc(path) : ReadC3d(path);
  ASSERT_TRUE(take) << take.error();
  const Result<MarkerSet> set = ChooseMarkerSet(take->labels);
  ASSERT_TRUE(set) << set.error();
  const MarkerTake thin = Thinned(*take, 400);
  const Result<SolvedTake> solved = SolveTake(thin, *set);
  ASSERT_TRUE(solved) << solved.error();
  const SolveReport& report = solved->report;

  EXPECT_LT(report.mean_residual_mm, GetParam().mean_mm) << report.marker_set;
  EXPECT_LT(report.p95_residual_mm, std::max(2.5 * report.mean_residual_mm, GetParam().tail_mm));
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto limb = LimbOf(static_cast<LimbSegment>(s));
    if (!IsLeft(limb)) continue;
    const double left = report.segment_length_mm[s];
    EXPECT_NEAR(left, report.segment_length_mm[s + 2], 0.01 * left) << "segment " << s;
  }
  ASSERT_EQ(solved->motion.poses.size(), thin.frame_count);
  double lowest = 1e9;
  for (const Pose& pose : solved->motion.poses) {
    const ModelPose placed = ForwardKinematics(solved->motion.performer.skeleton, pose);
    lowest = std::min({lowest, placed.Position(J::kLeftFoot).y, placed.Position(J::kRightFoot).y});
    for (const Limb limb : kLimbs) {
      EXPECT_GT(Degrees(Flexion(pose, limb)), -15.0);
      EXPECT_LT(Degrees(Flexion(pose, limb)), 172.0);
    }
    // Nobody in these takes lies down or stands on the hands.
    EXPECT_GT(placed.Position(J::kHead).y, placed.Position(J::kLeftFoot).y - 0.1 * report.height_m);
  }
  // An ankle at its lowest is about as high as it is over a sole on the ground.
  EXPECT_NEAR(lowest, CanonicalPositions(solved->motion.performer.skeleton)[Index(J::kLeftFoot)].y,
              0.06);
}

class LostMarker : public testing::TestWithParam<const char*> {};

/// Any one marker lost for half a second, and the skeleton and the postures learnt without that
/// half second: joints stay within 10 mm of where they are with it.
TEST_P(LostMarker, MovesNoJointByMoreThanACentimetre) {
  EGO_SHARED_DATA_OR_SKIP(path, std::string("markers/") + GetParam());
  const Result<MarkerTake> take = path.extension() == ".trc" ? ReadTrc(path) : ReadC3d(path);
  ASSERT_TRUE(take) << take.error();
  const Result<MarkerSet> set = ChooseMarkerSet(take->labels);
  ASSERT_TRUE(set) << set.error();
  const std::size_t begin = take->frame_count / 2;
  const std::size_t end = begin + static_cast<std::size_t>(0.5 * take->rate_hz);
  ASSERT_LT(end, take->frame_count);
  const std::size_t labels = take->labels.size();
  MarkerTake rest = *take;
  for (std::size_t i = begin * labels; i < end * labels; ++i) rest.visible[i] = 0;
  const Result<SkeletonFit> fit = FitSkeleton(rest, *set);
  ASSERT_TRUE(fit) << fit.error();
  PoseSolverOptions options;
  options.step_per_frame *= std::max(1.0, 100.0 / take->rate_hz);
  const PoseSolver solver(fit->model, options);

  const auto solve = [&](const MarkerTake& markers, PoseSolver::State state) {
    std::vector<ModelPose> poses;
    for (std::size_t f = begin; f < end; ++f) {
      solver.Solve(markers.Frame(f), state);
      poses.push_back(ForwardKinematics(fit->model.skeleton, state.pose));
    }
    return poses;
  };
  PoseSolver::State before;
  solver.Solve(take->Frame(begin - 1), before);
  const std::vector<ModelPose> whole = solve(*take, before);
  for (const BoundMarker& marker : fit->model.markers) {
    MarkerTake lost = *take;
    for (std::size_t f = begin; f < end; ++f) lost.visible[f * labels + marker.label] = 0;
    const std::vector<ModelPose> without = solve(lost, before);
    double shift = 0.0;
    for (std::size_t f = 0; f < whole.size(); ++f) {
      for (std::size_t j = 0; j < kJointCount; ++j) {
        shift = std::max(shift, glm::distance(whole[f].position_ws[j], without[f].position_ws[j]));
      }
    }
    EXPECT_LT(shift, 0.010) << take->labels[marker.label];
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, LostMarker,
                         testing::Values("cmu_02_05.c3d", "btk_mocap36_optitrack.c3d",
                                         "millard_stoop1_t169_f620f800.c3d",
                                         "rajagopal_motion_capture_walk.trc"),
                         [](const auto& each) {
                           std::string name = each.param;
                           for (char& c : name) {
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           }
                           return name;
                         });

INSTANTIATE_TEST_SUITE_P(
    Shared, RealTakeSolve,
    testing::Values(Bar{"cmu_02_05.c3d", 7.0}, Bar{"cmu_135_02_karate.c3d", 7.0},
                    Bar{"hdm05_mm_01-02_03.c3d", 7.0}, Bar{"btk_mocap36_optitrack.c3d", 8.0},
                    Bar{"gatech_nick_freeform.c3d", 8.0},
                    Bar{"millard_stoop1_t169_f620f800.c3d", 7.0},
                    Bar{"millard_neu_t169_f250f350.c3d", 1.0}, Bar{"pycgm_robo_static.c3d", 1.0},
                    Bar{"rajagopal_motion_capture_walk.trc", 7.0},
                    Bar{"rajagopal_static_walk_1.trc", 1.0}, Bar{"c3dorg_mac_jump2.c3d", 7.0, 5.0},
                    Bar{"ezc3d_qualisys_walk.c3d", 7.0}, Bar{"c3dorg_nexgen_test1.c3d", 7.0},
                    Bar{"biomechzoo_HC030A_straight.c3d", 7.0},
                    Bar{"gatech_sehoon_squat.c3d", 8.0, 4.1}),
    [](const auto& each) {
      std::string name = each.param.file;
      for (char& c : name) {
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
      }
      return name;
    });

}  // namespace
}  // namespace ego
