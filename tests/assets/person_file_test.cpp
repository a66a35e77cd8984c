// SPDX-License-Identifier: MIT
#include "assets/people/person_file.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "assets/people/person_measure.h"
#include "tests/support/skin_oracle.h"

namespace ego {
namespace {

TEST(PersonFile, WhatIsWrittenReadsBackTheSame) {
  const std::vector<PersonParameters> cast = StudioCast();
  const std::string text = FormatPeople(cast);
  const auto read = ParsePeople(text, "cast.json");
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->size(), cast.size());
  for (std::size_t i = 0; i < cast.size(); ++i) {
    EXPECT_EQ((*read)[i].name, cast[i].name);
    EXPECT_EQ((*read)[i].hair, cast[i].hair);
    EXPECT_EQ((*read)[i].style, cast[i].style);
    for (const PersonMeasure& measure : PersonMeasures()) {
      EXPECT_EQ((*read)[i].*measure.value, cast[i].*measure.value) << measure.key;
    }
    for (const PersonColor& color : PersonColors()) {
      const glm::vec3 d = (*read)[i].*color.value - cast[i].*color.value;
      EXPECT_LT(glm::length(d), 0.005f) << color.key;
    }
  }
  EXPECT_EQ(FormatPeople(*read), text);
}

TEST(PersonFile, ABaseIsChangedWhereTheFileSaysSo) {
  const auto read = ParsePeople(
      R"({"people": [{"name": "Giant", "base": "Long arms", "height": 2.0, "hair": "none",
                      "shirtColor": "#46c77A"}]})",
      "giant.json");
  ASSERT_TRUE(read) << read.error();
  const PersonParameters& giant = read->front();
  EXPECT_EQ(giant.name, "Giant");
  EXPECT_EQ(giant.height, 2.0);
  EXPECT_EQ(giant.arm_length, 0.73);
  EXPECT_EQ(giant.hair, Hair::kNone);
  EXPECT_NEAR(giant.shirt_color.g, 0xC7 / 255.0, 1e-6);
}

TEST(PersonFile, WhatIsWrongIsSaidInOneSentence) {
  struct Bad {
    const char* json;
    const char* expected;
  };
  const Bad bad[] = {
      {"{", "not valid JSON"},
      {"[]", "\"people\""},
      {R"({"people": []})", "1 to 100"},
      {R"({"people": [7]})", "person 1 must be an object"},
      {R"({"people": [{"height": 1.8}]})", "needs a \"name\""},
      {R"({"people": [{"name": "A", "base": "Nobody"}]})", "\"base\" must be one of"},
      {R"({"people": [{"name": "A", "armLenght": 0.5}]})", "no measurement \"armLenght\""},
      {R"({"people": [{"name": "A", "height": "tall"}]})", "\"height\" must be a number"},
      {R"({"people": [{"name": "A", "height": 9}]})", "\"height\" is 9 but must be from 0.5"},
      {R"({"people": [{"name": "A", "height": 1e999}]})", "JSON"},
      {R"({"people": [{"name": "A", "legLength": 1.1}]})", "for the trunk"},
      {R"({"people": [{"name": "A", "hair": "green"}]})", "\"hair\" must be none"},
      {R"({"people": [{"name": "A", "skinColor": "#12345"}]})", "colour"},
      {R"({"people": [{"name": "A", "skinColor": "#12345G"}]})", "colour"},
      {R"({"people": [{"name": "A", "style": 3}]})", "soft or robot"}};
  for (const Bad& each : bad) {
    const auto read = ParsePeople(each.json, "mine.json");
    EXPECT_FALSE(read) << each.json;
    EXPECT_NE(read.error().find("mine.json: "), std::string::npos) << read.error();
    EXPECT_NE(read.error().find(each.expected), std::string::npos) << read.error();
    EXPECT_EQ(read.error().find('\n'), std::string::npos);
  }
}

TEST(PersonFile, WhateverIsValidCanBeMade) {
  std::mt19937 random(7);
  int made = 0;
  for (int attempt = 0; attempt < 200000 && made < 4; ++attempt) {
    PersonParameters person;
    for (const PersonMeasure& measure : PersonMeasures()) {
      const double unit = measure.of_height ? person.height : 1.0;
      person.*measure.value =
          std::uniform_real_distribution<double>(measure.low, measure.high)(random) * unit;
    }
    person.hair = static_cast<Hair>(attempt % static_cast<int>(kHairNames.size()));
    person.style = made == 3 ? PersonStyle::kRobot : PersonStyle::kSoft;
    if (!Validate(person)) continue;
    const Person who = MakePerson(person);
    EXPECT_GT(test::VolumeOf(test::WeldedSkinOf(who.character)), 0.0);
    for (const double radius : who.body.surface.limb_radius) EXPECT_GT(radius, 0.0);
    ++made;
  }
  EXPECT_EQ(made, 4);
}

}  // namespace
}  // namespace ego
