// SPDX-License-Identifier: MIT
#include "core/markers/marker_set.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/markers/marker_set_file.h"

namespace ego {
namespace {

std::vector<std::string> LabelsOf(const MarkerSet& set) {
  std::vector<std::string> labels;
  for (const SetMarker& marker : set.markers) labels.push_back(marker.label);
  return labels;
}

TEST(CleanLabel, KeepsWhatNamesThePlace) {
  EXPECT_EQ(CleanLabel("Subject:LFHD"), "LFHD");
  EXPECT_EQ(CleanLabel("a:b:rKne "), "RKNE");
  EXPECT_EQ(CleanLabel("R.Shoulder"), "RSHOULDER");
  EXPECT_EQ(CleanLabel("L_IAS"), "LIAS");
  EXPECT_EQ(CleanLabel("*12"), "*12");
  EXPECT_EQ(CleanLabel(""), "");
}

TEST(CleanLabels, DropsASharedPrefixButNotASide) {
  const std::vector<std::string> optitrack = {"Bob_Hip1", "Bob_Hip2", "Bob_LHand1", "Bob_RHand1",
                                              "Bob_Head1"};
  EXPECT_EQ(CleanLabels(optitrack),
            (std::vector<std::string>{"HIP1", "HIP2", "LHAND1", "RHAND1", "HEAD1"}));
  const std::vector<std::string> sides = {"L_IAS", "L_IPS", "L_FLE", "L_FME", "L_FAL", "R_IAS"};
  EXPECT_EQ(CleanLabels(sides)[0], "LIAS");
}

TEST(ChooseMarkerSet, FindsEachSetByItsOwnLabels) {
  for (const MarkerSet& set : ShippedMarkerSets()) {
    std::vector<std::string> labels;
    for (const std::string& label : LabelsOf(set)) labels.push_back("Someone:" + label);
    const Result<MarkerSet> chosen = ChooseMarkerSet(labels);
    ASSERT_TRUE(chosen) << chosen.error();
    EXPECT_EQ(chosen->name, set.name);
  }
}

TEST(ChooseMarkerSet, CompletesWithLabelsOfOtherSets) {
  std::vector<std::string> labels;
  for (const MarkerSet& set : ShippedMarkerSets()) {
    if (set.name == "CMU 41") labels = LabelsOf(set);
  }
  ASSERT_FALSE(labels.empty());
  labels.push_back("LKNI");  // inner knee: known to another set
  const Result<MarkerSet> chosen = ChooseMarkerSet(labels);
  ASSERT_TRUE(chosen) << chosen.error();
  EXPECT_EQ(chosen->name, "CMU 41");
  const auto match = MatchLabels(*chosen, labels);
  ASSERT_TRUE(match.back().has_value());
  EXPECT_EQ(chosen->markers[*match.back()].joint, HumanoidJoint::kLeftUpperLeg);
}

TEST(ChooseMarkerSet, SaysThatLabelsAreNeeded) {
  std::vector<std::string> unlabelled;
  for (int i = 0; i < 40; ++i) unlabelled.push_back(std::string(1, '*').append(std::to_string(i)));
  const Result<MarkerSet> refused = ChooseMarkerSet(unlabelled);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().find("not labelled"), std::string::npos) << refused.error();
  EXPECT_NE(refused.error().find("Plug-in Gait"), std::string::npos) << refused.error();

  const std::vector<std::string> strange = {"FOO", "BAR", "LFHD", "RFHD", "BAZ", "QUX"};
  const Result<MarkerSet> few = ChooseMarkerSet(strange);
  ASSERT_FALSE(few);
  EXPECT_NE(few.error().find("only 2 of 6"), std::string::npos) << few.error();
}

TEST(MatchLabels, GivesAPlaceToTheFirstOfTwo) {
  const Result<MarkerSet> set = ParseMarkerSet(R"({"name": "pair", "markers": [
      {"label": "C7", "aliases": ["CV7"], "joint": "upperChest", "position": [0, 1.5, -0.1],
       "region": "trunk"}]})",
                                               "test");
  ASSERT_TRUE(set) << set.error();
  const std::vector<std::string> labels = {"x:CV7", "C7", "other"};
  const auto match = MatchLabels(*set, labels);
  EXPECT_EQ(match[0], 0u);
  EXPECT_FALSE(match[1].has_value());
  EXPECT_FALSE(match[2].has_value());
}

}  // namespace
}  // namespace ego
