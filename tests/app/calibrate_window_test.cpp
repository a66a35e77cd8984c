// SPDX-License-Identifier: MIT
// The Calibrate workspace in a real window, driven by real key and mouse events: from opening an
// avatar to its saved calibration, by hand and by confirming proposals.
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "app/studio.h"
#include "assets/calibration/calibration_file.h"
#include "assets/gltf/character_file.h"
#include "tests/app/virtual_display.h"
#include "tests/support/shared_data.h"

extern char** environ;

namespace ego {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::Do;
using test::RunUntil;

// What one step costs a person who knows the points: aim and click; press a key.
constexpr double kSecondsPerClick = 0.9;
constexpr double kSecondsPerKey = 0.6;

class CalibrateWindow : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* program : {"Xvfb", "xdotool"}) {
      if (!test::Installed(program)) GTEST_SKIP() << program << " is not installed";
    }
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("ego-calibrate-") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
    display_ = std::make_unique<test::VirtualDisplay>(1000, 640);
    ASSERT_TRUE(display_->ready());
  }
  void TearDown() override {
    studio_.reset();
    display_.reset();
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  // A copy in the test's folder, so that nothing is written beside the original.
  fs::path Copy(const fs::path& original) const {
    fs::copy_file(original, folder_ / original.filename());
    return folder_ / original.filename();
  }
  fs::path Cast() const {
    const fs::path path = folder_ / "child.glb";
    EXPECT_TRUE(WriteCharacter(path, *LoadDemoAvatar(0).character));
    return path;
  }

  void Open(const fs::path& avatar) {
    avatar_ = avatar;
    Result<std::unique_ptr<Window>> window = Window::Open("Egostudio test", 1000, 640);
    ASSERT_TRUE(window) << window.error();
    Result<StageRenderer> renderer = StageRenderer::Create({});
    ASSERT_TRUE(renderer) << renderer.error();
    studio_ = std::make_unique<Studio>(*std::move(window), *std::move(renderer));
    studio_->OpenFiles({avatar});
    ASSERT_TRUE(RunUntil(*studio_, [&] { return studio_->avatars().size() == 1; }));
    Do("mousemove 500 300");
    Key("ctrl+1");
    ASSERT_TRUE(RunUntil(*studio_, [&] { return session() != nullptr; }));
    // What was left behind asks before the guide does.
    if (!session()->offer() && studio_->calibrate().show_guide) Key("Return");
  }

  CalibrationSession* session() { return studio_->calibrate().session(); }

  void Settle() {
    ASSERT_TRUE(RunUntil(*studio_, [&] {
      return !studio_->window().has_waiting_input() && !studio_->calibrate().view().gliding();
    }));
    studio_->RunFrame();
  }
  void Key(const std::string& keys) {
    Do("key " + keys);
    ++keys_;
    Settle();
  }
  void MoveTo(const Vec2& pixel) {
    Do("mousemove " + std::to_string(static_cast<int>(pixel.x)) + " " +
       std::to_string(static_cast<int>(pixel.y)));
    Settle();
  }
  // Where a person would click for an item: on what the studio proposes.
  std::optional<Vec2> Aim(const PickItem& item) {
    const std::optional<Vec3> at = session()->PositionOf(item);
    return at ? studio_->calibrate().LensOf(*studio_).ToWindow(*at) : std::nullopt;
  }
  double Seconds() const { return kSecondsPerClick * clicks_ + kSecondsPerKey * keys_; }

  void PickEverythingByHand();
  void ConfirmProposals();
  void ExpectSaved();

  fs::path folder_;
  fs::path avatar_;
  std::unique_ptr<test::VirtualDisplay> display_;
  std::unique_ptr<Studio> studio_;
  int clicks_ = 0;
  int keys_ = 0;
};

void CalibrateWindow::PickEverythingByHand() {
  int by_key = 0;
  for (int i = 0; i < 60 && session()->current(); ++i) {
    const PickItem item = *session()->current();
    const std::optional<Vec2> aim = Aim(item);
    if (aim) MoveTo(*aim);
    const Hover hover = studio_->calibrate().hover;
    if (!aim || !hover.vertex || hover.item) {
      ++by_key;  // hidden by hair or cloth: the proposal is taken as it is
      Key("Return");
      ASSERT_TRUE(Settled(StateOf(session()->calibration(), item))) << Title(item);
      continue;
    }
    Do("click 1");
    ++clicks_;
    Settle();
    ASSERT_EQ(StateOf(session()->calibration(), item), PickState::kPicked) << Title(item);
    if (item.segment) continue;
    // What the hover showed is what the click took.
    const CalibrationPoint& point = *Find(session()->calibration(), item.point);
    EXPECT_LT(glm::length(session()->picker().Position(point.place) - hover.vertex->position_ws),
              1e-9)
        << Title(item);
  }
  EXPECT_FALSE(session()->current());
  EXPECT_LE(by_key, 6);
  Key("ctrl+s");
  std::printf("by hand: %d clicks, %d keys: %.0f s at a person's speed\n", clicks_, keys_,
              Seconds());
  EXPECT_LT(Seconds(), 60.0);
}

void CalibrateWindow::ConfirmProposals() {
  for (int i = 0; i < 20 && NextDoubtful(session()->calibration(), {}); ++i) {
    Key("Tab");
    const PickItem item = *session()->current();
    if (StateOf(session()->calibration(), item) == PickState::kMissing) break;
    Key("Return");
  }
  Key("ctrl+Return");
  Key("ctrl+s");
  std::printf("by proposals: %d keys: %.0f s at a person's speed\n", keys_, Seconds());
  EXPECT_LT(Seconds(), 20.0);
}

void CalibrateWindow::ExpectSaved() {
  EXPECT_FALSE(session()->editor().Unsaved());
  ASSERT_TRUE(fs::exists(CalibrationPathFor(avatar_)));
  const Result<LoadedCalibration> written =
      ReadCalibration(CalibrationPathFor(avatar_), *session()->editor().TheCharacter());
  ASSERT_TRUE(written) << written.error();
  EXPECT_EQ(SettledItems(written->calibration), SettledItems(session()->calibration()));
  EXPECT_GE(SettledItems(written->calibration) + 3, PickItems().size());
}

TEST_F(CalibrateWindow, EveryPointByHandOnTheCast) {
  Open(Cast());
  PickEverythingByHand();
  ExpectSaved();
}

TEST_F(CalibrateWindow, EveryPointByHandOnAChild) {
  EGO_SHARED_DATA_OR_SKIP(path, "avatars/makehuman_child_female.glb");
  Open(Copy(path));
  PickEverythingByHand();
  ExpectSaved();
}

TEST_F(CalibrateWindow, EveryPointByHandOnABunny) {
  EGO_SHARED_DATA_OR_SKIP(path, "avatars/m2m_human-bunny.glb");
  Open(Copy(path));
  PickEverythingByHand();
  ExpectSaved();
}

TEST_F(CalibrateWindow, EveryPointByHandOnAnAlien) {
  EGO_SHARED_DATA_OR_SKIP(path, "avatars/sumerian_alien.glb");
  Open(Copy(path));
  PickEverythingByHand();
  ExpectSaved();
}

TEST_F(CalibrateWindow, ByProposalsOnTheCast) {
  Open(Cast());
  ConfirmProposals();
  ExpectSaved();
}

TEST_F(CalibrateWindow, ByProposalsOnABunny) {
  EGO_SHARED_DATA_OR_SKIP(path, "avatars/m2m_human-bunny.glb");
  Open(Copy(path));
  ConfirmProposals();
  ExpectSaved();
}

TEST_F(CalibrateWindow, ByProposalsOnAnAlien) {
  EGO_SHARED_DATA_OR_SKIP(path, "avatars/sumerian_alien.glb");
  Open(Copy(path));
  ConfirmProposals();
  ExpectSaved();
}

TEST_F(CalibrateWindow, MovesMirrorsAndTakesBack) {
  Open(Cast());
  const PickItem chest = PickItem::Of(PointId::Of(SamplePoint::kLeftChest));
  studio_->calibrate().Select(*studio_, chest);
  Key("f");
  const auto place = [&](PointId id) { return Find(session()->calibration(), id)->place; };
  const PointId left = chest.point;
  const PointId right = Mirror(left);
  const MeshPoint left_before = place(left);
  const MeshPoint right_before = place(right);

  // A drag along the skin is one step of the history, for both sides.
  const std::optional<Vec2> aim = Aim(chest);
  ASSERT_TRUE(aim);
  MoveTo(*aim);
  Do("mousedown 1");
  Settle();
  for (int i = 1; i <= 3; ++i) MoveTo(*aim + Vec2(0.0, 9.0 * i));
  Do("mouseup 1");
  Settle();
  EXPECT_NE(place(left), left_before);
  EXPECT_NE(place(right), right_before);
  const MeshPoint dragged = place(left);
  Key("ctrl+z");
  EXPECT_EQ(place(left), left_before);
  EXPECT_EQ(place(right), right_before);
  Key("ctrl+shift+z");
  EXPECT_EQ(place(left), dragged);
  Key("ctrl+z");
  Key("ctrl+y");
  EXPECT_EQ(place(left), dragged);

  // Arrow keys, down and up again between two frames, go along edges and none is lost.
  studio_->calibrate().SetSymmetric(false);
  studio_->calibrate().Select(*studio_, chest);
  Do("key Down key Down");
  Settle();
  EXPECT_NE(place(left), dragged);
  Key("ctrl+z");
  EXPECT_NE(place(left), dragged);
  Key("ctrl+z");
  EXPECT_EQ(place(left), dragged);

  Key("Delete");
  EXPECT_EQ(StateOf(session()->calibration(), chest), PickState::kMissing);
  Key("ctrl+z");
  EXPECT_EQ(place(left), dragged);
  EXPECT_TRUE(session()->editor().Unsaved());

  // Where nothing can be written the sentence says so and the picks stay.
  fs::create_directories(CalibrationPathFor(avatar_) / "in the way");
  Key("ctrl+s");
  EXPECT_EQ(studio_->errors().size(), 1u);
  EXPECT_TRUE(session()->editor().Unsaved());
  EXPECT_EQ(place(left), dragged);

  // Closing asks.
  Key("Escape");
  Key("ctrl+q");
  EXPECT_TRUE(studio_->asks_to_close);
  EXPECT_FALSE(studio_->ShouldClose());
}

TEST_F(CalibrateWindow, PicksOutliveAKill) {
  const fs::path avatar = Cast();
  const std::string program = std::string(EGO_BINARY_DIR) + "/egostudio";
  const char* argv[] = {program.c_str(), avatar.c_str(), nullptr};
  pid_t studio = -1;
  ASSERT_EQ(posix_spawn(&studio, argv[0], nullptr, nullptr, const_cast<char**>(argv), environ), 0);
  const auto limit = std::chrono::steady_clock::now() + 60s;
  while (!FindRecovery(RecoveryFolder(), avatar) && std::chrono::steady_clock::now() < limit) {
    Do("mousemove 500 300 key ctrl+1 key Return key ctrl+Return");
    std::this_thread::sleep_for(500ms);
  }
  kill(studio, SIGKILL);
  waitpid(studio, nullptr, 0);
  ASSERT_TRUE(FindRecovery(RecoveryFolder(), avatar));
  EXPECT_FALSE(fs::exists(CalibrationPathFor(avatar)));

  Open(avatar);
  ASSERT_TRUE(session()->offer());
  EXPECT_EQ(SettledItems(session()->calibration()), 0u);
  Key("Return");
  EXPECT_FALSE(session()->offer());
  EXPECT_GE(SettledItems(session()->calibration()), 40u);
  EXPECT_TRUE(session()->editor().Unsaved());
}

}  // namespace
}  // namespace ego
