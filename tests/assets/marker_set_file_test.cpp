// SPDX-License-Identifier: MIT
#include "assets/markers/marker_set_file.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/body/body.h"

namespace ego {
namespace {

TEST(ShippedMarkerSets, EveryFileIsBuiltInAndValid) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(EGO_SOURCE_DIR) / "assets/data/marker_sets")) {
    if (entry.path().extension() != ".json") continue;
    ++files;
    const Result<MarkerSet> set = ReadMarkerSet(entry.path());
    ASSERT_TRUE(set) << set.error();
    bool built_in = false;
    for (const MarkerSet& shipped : ShippedMarkerSets()) built_in |= shipped.name == set->name;
    EXPECT_TRUE(built_in) << entry.path();
  }
  EXPECT_EQ(files, ShippedMarkerSets().size());
  EXPECT_GE(files, 9u);
}

TEST(ShippedMarkerSets, MarkersLieNearTheirJointAndPartnersMirror) {
  const auto canonical = CanonicalPositions(TemplateSkeleton(1.78));
  for (const MarkerSet& set : ShippedMarkerSets()) {
    for (const SetMarker& marker : set.markers) {
      EXPECT_LT(glm::distance(marker.position_ms, canonical[Index(marker.joint)]), 0.46)
          << set.name << " " << marker.label;
      if (marker.mirror.empty()) continue;
      for (const SetMarker& partner : set.markers) {
        if (partner.label != marker.mirror) continue;
        EXPECT_EQ(partner.joint, Mirror(marker.joint)) << set.name << " " << marker.label;
        EXPECT_NEAR(partner.position_ms.x, -marker.position_ms.x, 1e-9);
        EXPECT_NEAR(partner.position_ms.y, marker.position_ms.y, 1e-9);
        EXPECT_NEAR(partner.position_ms.z, marker.position_ms.z, 1e-9);
      }
    }
  }
}

TEST(ShippedMarkerSets, TheStudiosOwnHas38) {
  for (const MarkerSet& set : ShippedMarkerSets()) {
    if (set.name == "Studio 38") {
      EXPECT_EQ(set.markers.size(), 38u);
    }
  }
}

TEST(MarkerSetFile, RoundTrips) {
  for (const MarkerSet& set : ShippedMarkerSets()) {
    const Result<MarkerSet> back = ParseMarkerSet(FormatMarkerSet(set), "again.json");
    ASSERT_TRUE(back) << back.error();
    EXPECT_EQ(back->name, set.name);
    EXPECT_EQ(back->description, set.description);
    ASSERT_EQ(back->markers.size(), set.markers.size());
    for (std::size_t i = 0; i < set.markers.size(); ++i) {
      EXPECT_EQ(back->markers[i].label, set.markers[i].label);
      EXPECT_EQ(back->markers[i].aliases, set.markers[i].aliases);
      EXPECT_EQ(back->markers[i].joint, set.markers[i].joint);
      EXPECT_EQ(back->markers[i].position_ms, set.markers[i].position_ms);
      EXPECT_EQ(back->markers[i].sigma, set.markers[i].sigma);
      EXPECT_EQ(back->markers[i].mirror, set.markers[i].mirror);
      EXPECT_EQ(back->markers[i].region, set.markers[i].region);
    }
  }
}

TEST(MarkerSetFile, ImpliesThePartnerOfTheOtherSide) {
  const Result<MarkerSet> set = ParseMarkerSet(R"({"name": "one", "markers": [
      {"label": "LKNE", "joint": "leftUpperLeg", "position": [0.15, 0.5, 0], "region": "limb",
       "mirror": "RKNE"}]})",
                                               "one.json");
  ASSERT_TRUE(set) << set.error();
  ASSERT_EQ(set->markers.size(), 2u);
  EXPECT_EQ(set->markers[1].label, "RKNE");
  EXPECT_EQ(set->markers[1].joint, HumanoidJoint::kRightUpperLeg);
  EXPECT_DOUBLE_EQ(set->markers[1].position_ms.x, -0.15);
}

TEST(MarkerSetFile, SaysWhatIsWrongInOneSentence) {
  const auto with = [](const std::string& marker) {
    return R"({"name": "x", "markers": [)" + marker + "]}";
  };
  const std::string good =
      R"({"label": "C7", "joint": "upperChest", "position": [0, 1.5, 0], "region": "trunk"})";
  ASSERT_TRUE(ParseMarkerSet(with(good), "f.json"));
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"", "not valid JSON"},
      {"{", "not valid JSON"},
      {"[]", "must be a JSON object"},
      {"{}", "\"name\""},
      {R"({"name": "x"})", "\"markers\""},
      {R"({"name": "x", "markers": []})", "no markers"},
      {with("3"), "must be an object"},
      {with(R"({"joint": "head"})"), "\"label\""},
      {with(R"({"label": "A", "joint": "tail"})"), "\"joint\""},
      {with(R"({"label": "A", "joint": "head", "position": [0, 1]})"), "\"position\""},
      {with(R"({"label": "A", "joint": "head", "position": [0, 99, 0], "region": "head"})"),
       "within 3 m"},
      {with(R"({"label": "A", "joint": "head", "position": [0, 1, 0], "region": "tail"})"),
       "\"region\""},
      {with(R"({"label": "A", "joint": "head", "position": [0, 1, 0], "region": "head",
               "sigma": -1})"),
       "sigma"},
      {with(good + "," + good), "used twice"},
      {with(R"({"label": "A", "aliases": 3, "joint": "head", "position": [0, 1, 0],
               "region": "head"})"),
       "\"aliases\""},
  };
  for (const auto& [text, expected] : bad) {
    const Result<MarkerSet> set = ParseMarkerSet(text, "f.json");
    ASSERT_FALSE(set) << text;
    EXPECT_TRUE(set.error().starts_with("f.json: ")) << set.error();
    EXPECT_NE(set.error().find(expected), std::string::npos) << set.error() << " for " << text;
  }
  EXPECT_FALSE(ReadMarkerSet("no/such/file.json"));
}

TEST(MarkerSetFile, SurvivesTheFuzzCorpus) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(EGO_SOURCE_DIR) / "tests/fuzz/corpus/marker_set")) {
    ++files;
    const Result<MarkerSet> set = ReadMarkerSet(entry.path());
    if (set) {
      EXPECT_TRUE(Validate(*set)) << entry.path();
    } else {
      EXPECT_TRUE(set.error().starts_with(entry.path().filename().string())) << set.error();
    }
  }
  EXPECT_GE(files, 3u);
}

}  // namespace
}  // namespace ego
