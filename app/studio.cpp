// SPDX-License-Identifier: MIT
#include "app/studio.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <future>
#include <thread>
#include <utility>

#include "app/commands/command.h"
#include "app/commands/terminal.h"
#include "app/loading/file_kind.h"
#include "app/view/fonts.h"
#include "core/baselines/retarget_method.h"

namespace ego {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kDemoAvatars = 5;
constexpr auto kBesideLoading = 120ms;  // from picture to picture
constexpr auto kMessageStays = 8s;
constexpr std::size_t kMostErrors = 4;  // as many as can be read at a glance
constexpr auto kSettles = 400ms;        // after a change the panels may need a few pictures more

template <class Entry>
auto Find(std::vector<Entry>& entries, std::uint64_t id) {
  return std::find_if(entries.begin(), entries.end(), [id](const Entry& e) { return e.id == id; });
}

}  // namespace

Studio::Studio(std::unique_ptr<Window> window, StageRenderer renderer)
    : window_(std::move(window)),
      gui_(*window_),
      picture_(std::move(renderer)),
      method_(RetargetMethodNames().front()),
      last_change_(std::chrono::steady_clock::now()) {
  layout_.Divide(static_cast<float>(window_->width()), static_cast<float>(window_->height()),
                 gui_.scale());
}

// Members end in the reverse of their order: loading and the stage are stopped and joined, then
// meshes, interface and window go while the window's context is still current.
Studio::~Studio() = default;

void Studio::OpenFiles(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) loader_.AddFile(file);
}

void Studio::OpenMotion(const std::string& name) {
  loader_.Add("Preparing the performer's motion",
              [name](const Progress&) -> Result<BackgroundLoader::Loaded> {
                Result<LoadedTake> take = LoadMotion(name);
                if (!take) return Error{take.error()};
                return BackgroundLoader::Loaded(*std::move(take));
              });
}

void Studio::OpenDemoCast() {
  // Every other one is made beside the loader's thread: two at a time.
  std::shared_future<LoadedAvatar> ahead;
  for (std::size_t i = 0; i < std::min(kDemoAvatars, DemoAvatarCount()); ++i) {
    std::shared_future<LoadedAvatar> made;
    if (i % 2 == 1) {
      made = std::async(std::launch::async, [i, before = ahead] {
               if (before.valid()) before.wait();
               return LoadDemoAvatar(i);
             }).share();
      ahead = made;
    }
    loader_.Add("Preparing the demo's cast",
                [i, made](const Progress&) -> Result<BackgroundLoader::Loaded> {
                  return BackgroundLoader::Loaded(made.valid() ? made.get() : LoadDemoAvatar(i));
                });
  }
}

const TakeEntry* Studio::current_take() const {
  for (const TakeEntry& entry : takes_) {
    if (entry.id == current_take_) return &entry;
  }
  return nullptr;
}

const AvatarEntry* Studio::selected_avatar() const {
  if (!selection_ || selection_->kind != FigureRole::Kind::kAvatar) return nullptr;
  for (const AvatarEntry& entry : avatars_) {
    if (entry.id == selection_->avatar_id) return &entry;
  }
  return nullptr;
}

void Studio::SelectTake(std::uint64_t id) {
  if (id == current_take_) return;
  current_take_ = id;
  RebuildScene();
}

void Studio::RemoveTake(std::uint64_t id) {
  const auto found = Find(takes_, id);
  if (found == takes_.end()) return;
  Say(Message::Kind::kInfo, "Removed " + found->take.name + ". Ctrl+Z brings it back.");
  removed_.emplace_back(std::move(*found));
  takes_.erase(found);
  if (id == current_take_) SelectTake(takes_.empty() ? 0 : takes_.back().id);
}

void Studio::SetVisible(std::uint64_t avatar_id, bool visible) {
  const auto found = Find(avatars_, avatar_id);
  if (found == avatars_.end()) return;
  found->visible = visible;
  PassMembers();
}

void Studio::RemoveAvatar(std::uint64_t id) {
  const auto found = Find(avatars_, id);
  if (found == avatars_.end()) return;
  Say(Message::Kind::kInfo, "Removed " + found->avatar.name + ". Ctrl+Z brings it back.");
  removed_.emplace_back(std::move(*found));
  avatars_.erase(found);
  PassMembers();
  RebuildScene();
}

void Studio::UndoRemove() {
  if (removed_.empty()) return;
  std::variant<TakeEntry, AvatarEntry> last = std::move(removed_.back());
  removed_.pop_back();
  // Ids grow: sorting by them puts an entry back in its place.
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  if (auto* take = std::get_if<TakeEntry>(&last)) {
    const std::uint64_t id = take->id;
    takes_.push_back(std::move(*take));
    std::sort(takes_.begin(), takes_.end(), by_id);
    if (!current_take()) SelectTake(id);
  } else {
    avatars_.push_back(std::move(std::get<AvatarEntry>(last)));
    std::sort(avatars_.begin(), avatars_.end(), by_id);
    PassMembers();
    RebuildScene();
  }
}

void Studio::TogglePlaying() {
  // Presses may come faster than frames: each counts from the one before.
  if (frame().commands_done == stage_.commands_given()) wants_playing_ = frame().playing;
  wants_playing_ = !wants_playing_;
  stage_.Play(wants_playing_);
}

void Studio::Step(std::ptrdiff_t frames) {
  wants_playing_ = false;
  stage_.Step(frames);
}

void Studio::SetSpeed(double speed) {
  speed_ = std::clamp(speed, Playhead::kSlowest, Playhead::kFastest);
  stage_.SetSpeed(speed_);
}

void Studio::SetLoop(bool loop) {
  loop_ = loop;
  stage_.SetLoop(loop);
}

void Studio::SetMethod(const std::string& name) {
  method_ = name;
  stage_.SetMethod(name);
}

void Studio::Say(Message::Kind kind, std::string text) {
  if (kind == Message::Kind::kInfo) {
    info_ = Message{std::move(text), std::chrono::steady_clock::now()};
    return;
  }
  std::erase(errors_, text);
  if (errors_.size() == kMostErrors) errors_.erase(errors_.begin());
  errors_.push_back(std::move(text));
}

void Studio::RebuildScene() {
  const TakeEntry* take = current_take();
  if (!take) return;
  auto scene = std::make_shared<StageScene>();
  scene->motion = take->take.motion;
  for (const AvatarEntry& entry : avatars_) {
    scene->avatars.push_back({entry.id, entry.avatar.body});
  }
  stage_.SetScene(std::move(scene));
}

void Studio::PassMembers() {
  std::vector<StageMember> members;
  for (const AvatarEntry& entry : avatars_) {
    members.push_back(
        {entry.id, entry.avatar.name, entry.color, entry.visible, entry.avatar.character});
  }
  picture_.SetMembers(std::move(members));
}

void Studio::TakeIn(LoadedTake take) {
  const std::uint64_t id = next_id_++;
  Say(Message::Kind::kInfo, "Opened " + take.name + ".");
  takes_.push_back({id, std::move(take)});
  SelectTake(id);
  if (takes_.size() > 1) return;
  wants_playing_ = true;
  stage_.Play(true);
}

void Studio::TakeIn(LoadedAvatar avatar) {
  const std::uint64_t id = next_id_++;
  Say(Message::Kind::kInfo, "Opened " + avatar.name + ".");
  const std::filesystem::path path = avatar.path;
  avatars_.push_back({id, std::move(avatar), look::AvatarColor(next_color_++), true});
  PassMembers();
  RebuildScene();
  if (!path.empty()) AddRecent(path);
  const bool asked = !path.empty() && path == calibrate_when_open_;
  // Whoever is in the Calibrate workspace already waits for the first that comes.
  const bool awaited = workspace_ == Workspace::kCalibrate && calibrate_.avatar_id() == 0;
  if (asked) calibrate_when_open_.clear();
  if (asked || awaited) Calibrate(id);
}

bool Studio::TakeInLoaded() {
  bool any = false;
  while (std::optional<Result<BackgroundLoader::Loaded>> result = loader_.Take()) {
    any = true;
    if (!*result) {
      Say(Message::Kind::kError, result->error());
      calibrate_when_open_.clear();
      continue;
    }
    std::visit(
        [this]<class T>(T& loaded) {
          if constexpr (std::is_same_v<T, std::shared_ptr<CalibrationSession>>) {
            calibrate_.TakeIn(*this, std::move(loaded));
          } else if constexpr (std::is_same_v<T, std::shared_ptr<TestPostures>>) {
            calibrate_.TakeIn(std::move(loaded));
          } else {
            TakeIn(std::move(loaded));
          }
        },
        **result);
  }
  // Given up or failed: the place says so and can be asked again.
  if (calibrate_.opening() && !loader_.activity()) calibrate_.Forget(calibrate_.avatar_id());
  return any;
}

Remembered Studio::ToRemember() const {
  return {window_->width(), window_->height(), layout_, overlays_,
          navigation_,      calibrate_.habits, recent_};
}

void Studio::Restore(const Remembered& remembered) {
  layout_ = remembered.layout;
  overlays_ = remembered.overlays;
  navigation_ = remembered.navigation;
  calibrate_.habits = remembered.calibrate;
  recent_ = remembered.recent;
}

void Studio::MeasureRate() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - last_frame_).count();
  last_frame_ = now;
  if (seconds <= 0.0 || seconds > 1.0) return;
  draw_hz_ += (draw_hz_ == 0.0 ? 1.0 : 0.06) * (1.0 / seconds - draw_hz_);
}

// While nothing moves there is nothing to draw: waiting for input then leaves the machine alone.
double Studio::Patience() const {
  return std::chrono::steady_clock::now() - last_change_ > kSettles ? 0.1 : 0.0;
}

void Studio::RunFrame() {
  window_->Poll(Patience());
  const auto now = std::chrono::steady_clock::now();
  bool changed = TakeInLoaded();
  for (const std::filesystem::path& file : window_->dropped()) OpenDropped(file);
  HandleKeys();
  if (window_->TakeCloseRequest()) AskToClose();
  changed |= stage_.Fetch();
  if (info_ && now - info_->when > kMessageStays) {
    info_.reset();
    changed = true;
  }
  if (workspace_ == Workspace::kCalibrate) changed |= calibrate_.Advance(*this, now);
  if (changed || window_->had_input()) last_change_ = now;
  if (now - last_change_ > kSettles && !loader_.activity()) return;
  if (window_->width() == 0 || window_->height() == 0) {
    std::this_thread::sleep_for(50ms);
    return;
  }
  // Where drawing takes the processor, it must not slow down what is being loaded.
  if (loader_.activity() && !window_->had_input() && picture_.renderer().IsSoftware() &&
      now - last_frame_ < kBesideLoading) {
    std::this_thread::sleep_for(10ms);
    return;
  }
  layout_.Divide(static_cast<float>(window_->width()), static_cast<float>(window_->height()),
                 gui_.scale());
  ShowTitle();
  gui_.Begin();
  ShowPanels();
  if (workspace_ == Workspace::kCalibrate) {
    calibrate_.Draw(*this);
  } else {
    DrawStage();
  }
  gui_.End();
  window_->Present();
  MeasureRate();
  // Without a vertical sync to wait for, drawing faster than the display shows helps nobody.
  std::this_thread::sleep_until(now +
                                std::chrono::duration_cast<std::chrono::microseconds>(
                                    std::chrono::duration<double>(0.95 / window_->refresh_hz())));
}

int RunStudio(const std::vector<std::filesystem::path>& files, const std::string& motion) {
  const std::filesystem::path memory = RememberedPath();
  const Result<Remembered> remembered = ReadRemembered(memory);
  const Remembered start = remembered ? *remembered : Remembered{};
  Result<std::unique_ptr<Window>> window =
      Window::Open("Egostudio", start.window_width, start.window_height);
  if (!window) return Fail(window.error());
  const std::vector<std::uint8_t> font = ReadFace(Face::kTextStrong);
  Result<StageRenderer> renderer =
      StageRenderer::Create({.font = font, .samples = 0, .coarseness = 0.5f});
  if (!renderer) return Fail(renderer.error());
  Studio studio(*std::move(window), *std::move(renderer));
  studio.Restore(start);
  if (!remembered) studio.Say(Message::Kind::kError, remembered.error());

  const auto any = [&](FileKind kind) {
    return std::any_of(files.begin(), files.end(), [kind](const std::filesystem::path& file) {
      const Result<FileKind> its = KindOf(file);
      return its && *its == kind;
    });
  };
  studio.OpenFiles(files);
  studio.FindLeftBehind();
  if (!any(FileKind::kTake)) studio.OpenMotion(motion);
  if (!any(FileKind::kAvatar)) studio.OpenDemoCast();
  while (!studio.ShouldClose()) studio.RunFrame();
  if (memory.empty()) return kDone;
  const Result<void> kept = WriteRemembered(memory, studio.ToRemember());
  if (!kept) std::fprintf(stderr, "egostudio: %s\n", kept.error().c_str());
  return kDone;
}

}  // namespace ego
