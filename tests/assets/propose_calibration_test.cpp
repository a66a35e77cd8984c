// SPDX-License-Identifier: MIT
#include "assets/calibration/propose_calibration.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "assets/gltf/character_file.h"
#include "assets/people/person.h"
#include "core/model/avatar_body.h"
#include "tests/support/capsule_person.h"
#include "tests/support/shared_data.h"

namespace ego {
namespace {

using S = SamplePoint;

AvatarCalibration Propose(const Character& character) {
  const auto result = ProposeCalibration(character);
  EXPECT_TRUE(result) << result.error();
  return result ? *result : AvatarCalibration{};
}

std::vector<Character> People() {
  return {test::MakeCapsulePerson(), test::MakeCapsulePerson({.belly = 0.2, .left_arm = 1.4}),
          test::MakeCapsulePerson({.height = 1.1, .arm_radius = 0.07, .rigid = true})};
}

TEST(ProposeCalibration, EveryPointLiesOnTheSkinAndSaysWhyItIsDoubtful) {
  for (const Character& person : People()) {
    AvatarCalibration calibration = Propose(person);
    EXPECT_EQ(calibration.mesh_hash, MeshHash(person));
    for (const NamedPoint& named : AllPoints(calibration)) {
      EXPECT_TRUE(IsOn(person, named.point->place)) << named.name;
      EXPECT_NE(named.point->state, PickState::kMissing) << named.name;
      EXPECT_NE(named.point->state, PickState::kPicked) << named.name;
      EXPECT_GE(named.point->confidence, 0.0);
      EXPECT_LE(named.point->confidence, 1.0);
      EXPECT_EQ(named.point->state == PickState::kDoubtful && named.point->reason.empty(), false);
    }
  }
}

// What the construction of the capsule person makes exact.
TEST(ProposeCalibration, FindsTheKnownExtremesOfAnEllipsoidHead) {
  const Character person = test::MakeCapsulePerson();
  const Body body = MakeAvatarBody(person, Propose(person));
  const auto at = [&](S p) { return body.surface.sample_ms[Index(p)]; };
  EXPECT_NEAR(at(S::kCrown).y, 1.78, 0.004);
  EXPECT_NEAR(at(S::kNoseTip).z, 0.127, 0.003);
  EXPECT_NEAR(at(S::kNoseTip).y, 1.645, 0.008);
  EXPECT_NEAR(at(S::kBackOfHead).z, -0.09, 0.003);
  EXPECT_NEAR(at(S::kLeftEar).x, 0.078, 0.003);
  EXPECT_NEAR(at(S::kRightEar).x, -0.078, 0.003);
  EXPECT_NEAR(body.height, 1.78, 0.004);
}

TEST(ProposeCalibration, MeasuresTheLimbsThatWereBuilt) {
  const Character person = test::MakeCapsulePerson({.left_arm = 1.4});
  const Body body = MakeAvatarBody(person, Propose(person));
  const auto radius = [&](LimbSegment s) { return body.surface.limb_radius[Index(s)]; };
  EXPECT_NEAR(radius(LimbSegment::kLeftUpperArm), 1.4 * 0.045, 0.001);
  EXPECT_NEAR(radius(LimbSegment::kRightUpperArm), 0.045, 0.001);
  EXPECT_NEAR(radius(LimbSegment::kLeftCalf), 0.065, 0.001);
  EXPECT_NEAR(body.surface.hand[1].half_thickness, 0.016, 0.001);
  EXPECT_NEAR(body.surface.hand[1].fingertip_ms.x, -0.91, 0.02);
  EXPECT_LT(body.surface.foot[0].ball_ms.y, 0.01);
  EXPECT_NEAR(body.surface.foot[0].toe_tip_ms.z, 0.21, 0.006);
}

TEST(ProposeCalibration, FollowsABigBelly) {
  const Body thin = [] {
    const Character c = test::MakeCapsulePerson();
    return MakeAvatarBody(c, Propose(c));
  }();
  const Character fat = test::MakeCapsulePerson({.belly = 0.25});
  const Body body = MakeAvatarBody(fat, Propose(fat));
  const auto z = [](const Body& b, S p) { return b.surface.sample_ms[Index(p)].z; };
  EXPECT_NEAR(z(body, S::kNavel) - z(thin, S::kNavel), 0.25, 0.01);
  EXPECT_NEAR(z(body, S::kLowerBack), z(thin, S::kLowerBack), 0.005);
  EXPECT_GT(z(body, S::kLeftBellySide), z(thin, S::kLeftBellySide) + 0.15);
}

TEST(ProposeCalibration, AMirroredCharacterGetsTheMirroredProposal) {
  for (const Character& person : People()) {
    const Body body = MakeAvatarBody(person, Propose(person));
    const Character mirror_person = test::Mirrored(person);
    const Body mirrored = MakeAvatarBody(mirror_person, Propose(mirror_person));
    const auto flip = [](const Vec3& p) { return Vec3{-p.x, p.y, p.z}; };
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      const auto p = static_cast<S>(i);
      EXPECT_LT(glm::distance(body.surface.sample_ms[i],
                              flip(mirrored.surface.sample_ms[Index(Mirror(p))])),
                1e-5)
          << Name(p);
    }
    for (std::size_t s = 0; s < kSegmentCount; ++s) {
      EXPECT_NEAR(body.surface.limb_radius[s], mirrored.surface.limb_radius[s ^ 2u], 1e-5);
    }
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_LT(glm::distance(body.surface.hand[side].palm_ms,
                              flip(mirrored.surface.hand[1 - side].palm_ms)),
                1e-5);
      EXPECT_LT(glm::distance(body.surface.foot[side].heel_ms,
                              flip(mirrored.surface.foot[1 - side].heel_ms)),
                1e-5);
    }
  }
}

TEST(ProposeCalibration, AScaledCharacterGetsTheScaledProposal) {
  for (const Character& person : People()) {
    const Body body = MakeAvatarBody(person, Propose(person));
    for (const double factor : {0.02, 3.0}) {
      const Character scaled = test::Scaled(person, factor);
      const Body other = MakeAvatarBody(scaled, Propose(scaled));
      for (std::size_t i = 0; i < kSampleCount; ++i) {
        EXPECT_LT(glm::distance(factor * body.surface.sample_ms[i], other.surface.sample_ms[i]),
                  1e-4 * factor)
            << Name(static_cast<S>(i));
      }
      EXPECT_NEAR(factor * body.surface.limb_radius[5], other.surface.limb_radius[5],
                  1e-4 * factor);
    }
  }
}

TEST(ProposeCalibration, CrudeMeshesFaceOutward) {
  for (const Character& person : People()) {
    const Body body = MakeAvatarBody(person, Propose(person));
    const Body usual = TemplateBodyOf(person);
    for (std::size_t t = 0; t < kTriangleCount; ++t) {
      const auto normal = [&](const Body& b) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
          p[k] = b.surface.sample_ms[Index(SampleTriangles()[t][k])];
        }
        return glm::cross(p[1] - p[0], p[2] - p[0]);
      };
      EXPECT_GT(glm::dot(normal(body), normal(usual)), 0.0) << person.name << " " << t;
    }
  }
}

TEST(ProposeCalibration, RefusesACharacterWithoutSkinAndStopsWhenAsked) {
  Character empty = test::MakeCapsulePerson();
  for (MeshPart& part : empty.parts) part.triangles.clear();
  EXPECT_FALSE(ProposeCalibration(empty));
  EXPECT_FALSE(ProposeCalibration(test::MakeCapsulePerson(),
                                  [](double, std::string_view) { return false; }));
}

TEST(ProposeCalibration, APersonWithoutHeadOrHandsStillGetsABody) {
  Character person = test::MakeCapsulePerson({.rigid = true});
  std::erase_if(person.parts, [](const MeshPart& p) {
    return p.name == "head" || p.name == "nose" || p.name == "hand" || p.name == "foot";
  });
  const AvatarCalibration calibration = Propose(person);
  EXPECT_EQ(calibration.At(S::kNoseTip).state, PickState::kDoubtful);
  EXPECT_EQ(calibration.hand[0].palm.state, PickState::kDoubtful);
  const Body body = MakeAvatarBody(person, calibration);
  for (const Vec3& p : body.surface.sample_ms) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

/// Errors against a calibration known exactly, in shares of the height.
std::vector<double> Errors(const Body& found, const Body& truth) {
  std::vector<double> errors;
  const auto add = [&](const Vec3& a, const Vec3& b) {
    errors.push_back(glm::distance(a, b) / truth.height);
  };
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    add(found.surface.sample_ms[i], truth.surface.sample_ms[i]);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    add(found.surface.hand[side].palm_ms, truth.surface.hand[side].palm_ms);
    add(found.surface.hand[side].fingertip_ms, truth.surface.hand[side].fingertip_ms);
    add(found.surface.foot[side].heel_ms, truth.surface.foot[side].heel_ms);
    add(found.surface.foot[side].ball_ms, truth.surface.foot[side].ball_ms);
    add(found.surface.foot[side].toe_tip_ms, truth.surface.foot[side].toe_tip_ms);
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    errors.push_back(std::abs(found.surface.limb_radius[s] - truth.surface.limb_radius[s]) /
                     truth.height);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(ProposeCalibration, IsAsGoodOnTheCastAsItsGoalSays) {
  for (const PersonParameters& parameters : DemoCast()) {
    const Person person = MakePerson(parameters);
    const Body found = MakeAvatarBody(person.character, Propose(person.character));
    const std::vector<double> errors = Errors(found, person.body);
    EXPECT_LT(errors[errors.size() / 2], 0.010) << parameters.name;
    EXPECT_LT(errors.back(), 0.04) << parameters.name;
  }
}

// -- What a confidence is worth: low ones must be where the errors are ---------------------------

struct Judged {
  double confidence;
  double error;  // share of the height
};

void Judge(const Character& character, const Body& truth, std::vector<Judged>& all) {
  const AvatarCalibration calibration = Propose(character);
  const Body found = MakeAvatarBody(character, calibration);
  const auto add = [&](double confidence, double error) {
    all.push_back({confidence, error / truth.height});
  };
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    add(calibration.sample[i].confidence,
        glm::distance(found.surface.sample_ms[i], truth.surface.sample_ms[i]));
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const HandSurface& hand = truth.surface.hand[side];
    add(calibration.hand[side].palm.confidence,
        glm::distance(found.surface.hand[side].palm_ms, hand.palm_ms));
    add(calibration.hand[side].fingertip.confidence,
        glm::distance(found.surface.hand[side].fingertip_ms, hand.fingertip_ms));
    add(calibration.foot[side].heel.confidence,
        glm::distance(found.surface.foot[side].heel_ms, truth.surface.foot[side].heel_ms));
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    add(calibration.segment[s].confidence,
        std::abs(found.surface.limb_radius[s] - truth.surface.limb_radius[s]));
  }
}

/// Every vertex moved at random; those at one place alike.
Character WithNoise(Character character, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> shift(0.0f, static_cast<float>(sigma));
  std::map<std::tuple<float, float, float>, glm::vec3> moved;
  for (MeshPart& part : character.parts) {
    for (glm::vec3& p : part.positions) {
      const auto [at, fresh] = moved.try_emplace({p.x, p.y, p.z}, p);
      if (fresh) at->second += glm::vec3(shift(random), shift(random), shift(random));
      p = at->second;
    }
  }
  return character;
}

/// All triangles near to some vertices cut out.
Character WithHoles(Character character, double radius, int count, unsigned seed) {
  std::mt19937 random(seed);
  const PosedMesh mesh = CanonicalMesh(character);
  std::vector<Vec3> middles;
  while (middles.size() < static_cast<std::size_t>(count)) {
    const auto& part = mesh.position_ws[random() % mesh.position_ws.size()];
    if (!part.empty()) middles.push_back(part[random() % part.size()]);
  }
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    std::vector<std::uint32_t>& index = character.parts[p].triangles;
    const std::vector<Vec3>& at = mesh.position_ws[p];
    std::vector<std::uint32_t> kept;
    for (std::size_t t = 0; t < index.size(); t += 3) {
      const Vec3 middle = (at[index[t]] + at[index[t + 1]] + at[index[t + 2]]) / 3.0;
      if (std::none_of(middles.begin(), middles.end(),
                       [&](const Vec3& hole) { return glm::distance(hole, middle) < radius; })) {
        kept.insert(kept.end(), {index[t], index[t + 1], index[t + 2]});
      }
    }
    index = std::move(kept);
  }
  return character;
}

/// A jacket that stands off on the left side only, at this height.
Character WithABulge(Character character, double height, double at) {
  const PosedMesh mesh = CanonicalMesh(character);
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    for (std::size_t v = 0; v < character.parts[p].positions.size(); ++v) {
      const Vec3 q = mesh.position_ws[p][v];
      const double near = 1.0 - std::abs(q.y - at * height) / (0.12 * height);
      if (q.x <= 0.0 || q.x > 0.16 * height || near <= 0.0) continue;
      const double share = near * std::min(1.0, q.x / (0.03 * height));
      character.parts[p].positions[v] +=
          glm::vec3(0.05 * height * share * glm::normalize(Vec3{q.x, 0.0, q.z}));
    }
  }
  return character;
}

double RankCorrelation(const std::vector<Judged>& all) {
  const auto ranks = [&](auto key) {
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return key(all[a]) < key(all[b]); });
    std::vector<double> rank(all.size());
    for (std::size_t i = 0; i < order.size();) {
      std::size_t j = i;
      while (j < order.size() && key(all[order[j]]) == key(all[order[i]])) ++j;
      for (std::size_t k = i; k < j; ++k) rank[order[k]] = 0.5 * static_cast<double>(i + j - 1);
      i = j;
    }
    return rank;
  };
  const auto a = ranks([](const Judged& j) { return j.confidence; });
  const auto b = ranks([](const Judged& j) { return j.error; });
  const double mean = 0.5 * static_cast<double>(all.size() - 1);
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  return ab / std::sqrt(aa * bb);
}

TEST(ProposeCalibration, ConfidenceIsLowWhereTheErrorIsLarge) {
  std::vector<Judged> all;
  for (const std::size_t which : {0u, 2u, 4u}) {  // performer, alien, big belly
    const Person person = MakePerson(DemoCast()[which]);
    const double height = person.body.height;
    const unsigned seed = static_cast<unsigned>(which) + 1;
    std::vector<Judged> clean;
    Judge(person.character, person.body, clean);
    EXPECT_LT(RankCorrelation(clean), -0.4) << person.body.name;
    all.insert(all.end(), clean.begin(), clean.end());
    Judge(WithNoise(person.character, 0.01 * height, seed), person.body, all);
    Judge(WithHoles(person.character, 0.05 * height, 25, seed), person.body, all);
    Judge(WithABulge(person.character, height, 0.5 + 0.05 * static_cast<double>(which)),
          person.body, all);
  }
  const auto mean_error = [&](double low, double high) {
    double sum = 0.0;
    int count = 0;
    for (const Judged& j : all) {
      if (j.confidence < low || j.confidence >= high) continue;
      sum += j.error;
      ++count;
    }
    EXPECT_GT(count, 10) << low;
    return sum / count;
  };
  const double doubtful = mean_error(0.0, 0.5);
  const double fair = mean_error(0.5, 0.8);
  const double sure = mean_error(0.8, 1.01);
  EXPECT_GT(doubtful, 1.8 * fair);
  EXPECT_GT(fair, 1.5 * sure);
  EXPECT_LT(RankCorrelation(all), -0.4);
}

bool IsAvatar(const std::filesystem::path& path) {
  return path.extension() == ".glb" || path.extension() == ".vrm";
}

TEST(ProposeCalibration, EveryRealAvatarGetsAUsableProposal) {
  EGO_SHARED_DATA_OR_SKIP(path, "avatars");
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (!IsAvatar(entry.path())) continue;
    const Result<Character> character = ReadCharacter(entry.path());
    if (!character) continue;  // what the reader refuses is its own tests' matter
    const AvatarCalibration calibration = Propose(*character);
    const CalibrationSummary summary = Summarize(calibration);
    EXPECT_EQ(summary.missing, 0u) << entry.path();
    EXPECT_LE(summary.doubtful, 9u) << entry.path();
    const Body body = MakeAvatarBody(*character, calibration);
    const Body usual = TemplateBodyOf(*character);
    // No crude triangle is inside out as seen from the middle of its mesh, or close to it.
    std::size_t folded = 0;
    for (const SampleTriangle& t : SampleTriangles()) {
      const auto normal = [&](const Body& b) {
        const auto p = [&](std::size_t k) { return b.surface.sample_ms[Index(t[k])]; };
        return glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
      };
      if (glm::dot(normal(body), normal(usual)) < -0.2) ++folded;
    }
    EXPECT_LE(folded, 4u) << entry.path();
  }
}

}  // namespace
}  // namespace ego
