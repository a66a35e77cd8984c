// SPDX-License-Identifier: MIT
// The half of the studio that knows of both workspaces: which one is shown, what goes from one to
// the other, and what must be saved before the window closes.
#include <algorithm>
#include <system_error>
#include <utility>

#include "app/loading/file_kind.h"
#include "app/panels/panels.h"
#include "app/studio.h"

namespace ego {
namespace {

constexpr std::size_t kRecent = 8;

}  // namespace

void Studio::EnterWorkspace(Workspace workspace) {
  if (workspace == workspace_) return;
  workspace_ = workspace;
  show_keys = false;
  if (workspace == Workspace::kPerform) {
    calibrate_.Apply(*this);
    return;
  }
  const auto is_open = [this](std::uint64_t id) {
    return std::any_of(avatars_.begin(), avatars_.end(),
                       [id](const AvatarEntry& entry) { return entry.id == id; });
  };
  if (const AvatarEntry* selected = selected_avatar()) {
    calibrate_.Open(*this, selected->id);
  } else if (!is_open(calibrate_.avatar_id()) && !avatars_.empty()) {
    calibrate_.Open(*this, avatars_.front().id);
  }
}

void Studio::Calibrate(std::uint64_t avatar_id) {
  selection_ = FigureRole{FigureRole::Kind::kAvatar, avatar_id};
  EnterWorkspace(Workspace::kCalibrate);
  calibrate_.Open(*this, avatar_id);
}

void Studio::CalibrateFile(const std::filesystem::path& path) {
  std::error_code error;
  for (const AvatarEntry& entry : avatars_) {
    if (entry.avatar.path.empty()) continue;
    if (std::filesystem::equivalent(entry.avatar.path, path, error)) {
      Calibrate(entry.id);
      return;
    }
  }
  calibrate_when_open_ = path;
  loader_.AddFile(path);
}

void Studio::OpenDropped(const std::filesystem::path& file) {
  const Result<FileKind> kind = KindOf(file);
  if (workspace_ == Workspace::kCalibrate && kind && *kind == FileKind::kAvatar) {
    CalibrateFile(file);
  } else {
    OpenFiles({file});
  }
}

void Studio::OpenForCalibration(std::uint64_t avatar_id) {
  for (const AvatarEntry& entry : avatars_) {
    if (entry.id != avatar_id) continue;
    const LoadedAvatar& avatar = entry.avatar;
    loader_.Add("Opening " + avatar.name,
                [avatar_id, name = avatar.name, path = avatar.path, character = avatar.character](
                    const Progress& progress) -> Result<BackgroundLoader::Loaded> {
                  Result<CalibrationDocument> opened =
                      path.empty() ? OpenCalibration(Character(*character), progress)
                                   : OpenCalibration(path, progress);
                  if (!opened) return Error{opened.error()};
                  return BackgroundLoader::Loaded(
                      std::make_shared<CalibrationSession>(avatar_id, name, *std::move(opened)));
                });
  }
}

void Studio::PrepareReference() {
  loader_.Add("Preparing the reference figure",
              [](const Progress&) -> Result<BackgroundLoader::Loaded> {
                return BackgroundLoader::Loaded(ReferenceFigure::Prepare());
              });
}

void Studio::ReplaceAvatar(std::uint64_t avatar_id, const CalibrationEditor& editor) {
  for (AvatarEntry& entry : avatars_) {
    if (entry.id != avatar_id) continue;
    entry.avatar.character = editor.TheCharacter();
    entry.avatar.body = std::make_shared<const Body>(editor.AvatarBody());
    entry.avatar.calibration = editor.Summary();
    entry.avatar.calibrated_by_file = !editor.Unsaved();
  }
  PassMembers();
  RebuildScene();
}

void Studio::AddRecent(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(file, error);
  if (error) return;
  std::erase(recent_, whole);
  recent_.insert(recent_.begin(), whole);
  if (recent_.size() > kRecent) recent_.resize(kRecent);
}

void Studio::FindLeftBehind() {
  const std::filesystem::path folder = RecoveryFolder();
  if (folder.empty()) return;
  left_behind_ = FindRecoveries(folder);
  std::erase_if(left_behind_, [](const Recovery& recovery) {
    std::error_code error;
    return !std::filesystem::exists(recovery.avatar, error);
  });
  constexpr std::size_t kMostOffered = 5;
  if (left_behind_.size() > kMostOffered) left_behind_.resize(kMostOffered);
}

void Studio::AskToClose() {
  if (calibrate_.Unsaved().empty()) {
    window_->Close();
  } else {
    asks_to_close = true;
  }
}

void Studio::SaveAndClose() {
  asks_to_close = false;
  for (CalibrationSession* session : calibrate_.Unsaved()) {
    const Result<void> saved =
        session->editor().Path().empty()
            ? Result<void>(Error{session->name() + " has no file yet: save it with Ctrl+Shift+S"})
            : session->Save();
    if (saved) continue;
    Say(Message::Kind::kError, saved.error() + ". The window stays open and nothing is lost.");
    Calibrate(session->avatar_id());
    calibrate_.ask_path = true;
    return;
  }
  window_->Close();
}

void Studio::CloseWithoutSaving() {
  for (CalibrationSession* session : calibrate_.Unsaved()) {
    if (!session->avatar_path().empty()) {
      DiscardRecovery(RecoveryFolder(), session->avatar_path());
    }
  }
  window_->Close();
}

void Studio::ShowTitle() {
  std::string title = "Egostudio";
  const CalibrationSession* session = calibrate_.session();
  if (workspace_ == Workspace::kCalibrate && session) {
    title = session->name() + (session->editor().Unsaved() ? "*" : "") + " - Egostudio";
  } else if (!calibrate_.Unsaved().empty()) {
    title += "*";
  }
  if (title == title_) return;
  title_ = title;
  window_->SetTitle(title);
}

void Studio::ShowPanels() {
  if (workspace_ == Workspace::kCalibrate) {
    ShowCalibrateViewport(*this);
    ShowCalibrateRail(*this);
    ShowCalibrateInspector(*this);
    ShowPostureStrip(*this);
  } else {
    ShowViewport(*this);
    ShowLeftRail(*this);
    ShowInspector(*this);
    ShowTimeline(*this);
  }
  ShowTopBar(*this);
  ShowStatusBar(*this);
  ShowSplitters(*this);
  ShowKeys(*this);
  ShowQuestions(*this);
  palette_.Show(*this);
}

std::vector<std::pair<std::string, std::string>> Studio::MouseHelp() const {
  const NavigationHelp help = HelpOf(navigation_);
  std::vector<std::pair<std::string, std::string>> lines;
  if (workspace_ == Workspace::kCalibrate) {
    lines = {{"Click", "pick the point that is asked for, or select a dot"},
             {"Drag a dot", "along the skin"},
             {"Shift+click", "one more point around a limb"}};
  } else {
    lines = {{"Click", "select a figure"}};
  }
  lines.push_back({help.turn, "turn"});
  lines.push_back({help.move, "move"});
  lines.push_back({help.zoom, "closer, farther"});
  return lines;
}

}  // namespace ego
