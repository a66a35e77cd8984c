// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/calibrate/workspace.h"
#include "app/loading/background_loader.h"
#include "app/panels/frame_layout.h"
#include "app/panels/palette.h"
#include "app/remembered.h"
#include "app/stage/stage_thread.h"
#include "app/view/navigation.h"
#include "app/view/stage_picture.h"
#include "app/window/gui.h"
#include "app/window/window.h"

namespace ego {

/// Opens the studio window on these files, or on the demo where they name no take or no avatar,
/// and runs it until it is closed. `motion`: the motion that the demo shows, empty for several.
/// Returns an exit code.
int RunStudio(const std::vector<std::filesystem::path>& files, const std::string& motion = {});

/// A take in the studio's list.
struct TakeEntry {
  std::uint64_t id = 0;
  LoadedTake take;
};

/// An avatar in the studio's list.
struct AvatarEntry {
  std::uint64_t id = 0;
  LoadedAvatar avatar;
  glm::vec3 color{1.0f};  // sRGB; keeps it in every view
  bool visible = true;
};

/// What the window is used for at the moment.
enum class Workspace { kCalibrate, kPerform };

/// A sentence for the user.
struct Message {
  enum class Kind { kInfo, kError };
  std::string text;
  std::chrono::steady_clock::time_point when;
};

/// The studio: what is open, what is selected, how it is seen; and what the panels may do to it.
/// One object on the main thread; loading and the stage run on threads of their own.
class Studio {
 public:
  Studio(std::unique_ptr<Window> window, StageRenderer renderer);
  /// Ends the threads first, then what draws, then the window.
  ~Studio();

  void OpenFiles(const std::vector<std::filesystem::path>& files);
  /// A motion of the studio's own performer; empty: the demo.
  void OpenMotion(const std::string& name = {});
  void OpenDemoCast();

  /// One turn of the main loop: input, what was loaded, panels, picture. Draws nothing, and waits
  /// for input instead, while nothing changes.
  void RunFrame();
  bool ShouldClose() const { return window_->ShouldClose(); }

  // What is open.
  const std::vector<TakeEntry>& takes() const { return takes_; }
  const std::vector<AvatarEntry>& avatars() const { return avatars_; }
  const TakeEntry* current_take() const;
  const AvatarEntry* selected_avatar() const;
  void SelectTake(std::uint64_t id);
  void RemoveTake(std::uint64_t id);
  void SetVisible(std::uint64_t avatar_id, bool visible);
  void RemoveAvatar(std::uint64_t id);
  /// Brings back what was removed last.
  void UndoRemove();
  bool can_undo() const { return !removed_.empty(); }

  // Where one works.
  Workspace workspace() const { return workspace_; }
  void EnterWorkspace(Workspace workspace);
  CalibrateWorkspace& calibrate() { return calibrate_; }
  const CalibrateWorkspace& calibrate() const { return calibrate_; }
  /// Turns to the Calibrate workspace with this avatar.
  void Calibrate(std::uint64_t avatar_id);
  /// Opens an avatar file, or finds it among those that are open, and calibrates it.
  void CalibrateFile(const std::filesystem::path& path);
  /// Called by the Calibrate workspace: what it needs is made in the background.
  void OpenForCalibration(std::uint64_t avatar_id);
  void PrepareReference();
  /// Gives the stage what a calibration makes of an avatar now.
  void ReplaceAvatar(std::uint64_t avatar_id, const CalibrationEditor& editor);
  /// Avatar files opened lately, newest first.
  const std::vector<std::filesystem::path>& recent() const { return recent_; }

  Palette& palette() { return palette_; }
  /// Closes the window, or asks first where something would be lost.
  void AskToClose();
  bool asks_to_close = false;
  void SaveAndClose();
  void CloseWithoutSaving();
  /// Picks that the last session could not save.
  const std::vector<Recovery>& left_behind() const { return left_behind_; }
  void FindLeftBehind();
  void ForgetLeftBehind() { left_behind_.clear(); }

  // What plays.
  StageThread& stage() { return stage_; }
  const StageFrame& frame() const { return stage_.frame(); }
  void TogglePlaying();
  /// Pauses and moves by so many frames.
  void Step(std::ptrdiff_t frames);
  void SetSpeed(double speed);
  double speed() const { return speed_; }
  void SetLoop(bool loop);
  bool loop() const { return loop_; }
  void SetMethod(const std::string& name);
  const std::string& method() const { return method_; }

  // How it is seen.
  Overlays& overlays() { return overlays_; }
  Camera& camera() { return camera_; }
  Navigation& navigation() { return navigation_; }
  std::optional<FigureRole>& selection() { return selection_; }
  StagePicture& picture() { return picture_; }
  FrameLayout& layout() { return layout_; }
  const FrameLayout& layout() const { return layout_; }
  /// Keeps the studio from framing the stage by itself when avatars come and go.
  void CameraMovedByHand() { frame_when_ready_ = false; }
  void FrameAll();
  /// The same, and again whenever someone comes or goes.
  void FrameEveryone();
  void FrameSelected();
  void LookFrom(StandardView view);

  // What is going on.
  BackgroundLoader& loader() { return loader_; }
  /// Tells what was done, for a while, or what went wrong, until it is dismissed: of several things
  /// that went wrong the last ones.
  void Say(Message::Kind kind, std::string text);
  const std::optional<Message>& info() const { return info_; }
  const std::vector<std::string>& errors() const { return errors_; }
  void DismissErrors() { errors_.clear(); }
  double draw_hz() const { return draw_hz_; }
  Window& window() { return *window_; }
  const Window& window() const { return *window_; }
  Remembered ToRemember() const;
  void Restore(const Remembered& remembered);

  bool show_keys = false;  // the list of keys is up
  /// What the mouse does in this workspace: how, what.
  std::vector<std::pair<std::string, std::string>> MouseHelp() const;

 private:
  bool TakeInLoaded();
  void TakeIn(LoadedTake take);
  void TakeIn(LoadedAvatar avatar);
  void ShowPanels();
  void ShowTitle();
  void OpenDropped(const std::filesystem::path& file);
  void AddRecent(const std::filesystem::path& file);
  void HandleKeys();
  void DrawStage();
  void FrameWhenChanged();
  void FollowHeading();
  void RebuildScene();
  void PassMembers();
  void MeasureRate();
  double Patience() const;

  // The order of members is the order of life: threads are last and end first.
  std::unique_ptr<Window> window_;
  Gui gui_;
  StagePicture picture_;
  CalibrateWorkspace calibrate_;

  std::vector<TakeEntry> takes_;
  std::vector<AvatarEntry> avatars_;
  std::uint64_t current_take_ = 0;  // 0: none
  std::uint64_t next_id_ = 1;
  std::size_t next_color_ = 0;
  std::vector<std::variant<TakeEntry, AvatarEntry>> removed_;

  Workspace workspace_ = Workspace::kPerform;
  Navigation navigation_ = Navigation::kStudio;
  std::vector<std::filesystem::path> recent_;
  std::filesystem::path calibrate_when_open_;  // an avatar file that is on its way
  std::string title_;
  std::vector<Recovery> left_behind_;
  Palette palette_;
  Overlays overlays_;
  Camera camera_;
  double heading_ = 0.0;  // of the take that the camera's yaw was last turned for
  std::optional<FigureRole> selection_;
  FrameLayout layout_;
  bool frame_when_ready_ = true;          // the camera has not been moved by hand yet
  std::vector<FigureRole> framed_roles_;  // who was on stage when it was framed last
  Rect framed_view_;
  double speed_ = 1.0;
  bool loop_ = true;
  bool wants_playing_ = false;  // as last commanded; the frame shown may not know yet
  std::string method_;
  std::optional<Message> info_;
  std::vector<std::string> errors_;

  std::chrono::steady_clock::time_point last_frame_{};
  std::chrono::steady_clock::time_point last_change_{};
  double draw_hz_ = 0.0;

  StageThread stage_;
  BackgroundLoader loader_;
};

}  // namespace ego
