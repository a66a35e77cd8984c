// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "app/loading/load_avatar.h"
#include "app/loading/load_take.h"
#include "core/base/progress.h"
#include "core/base/result.h"

namespace ego {

class CalibrationSession;
class TestPostures;

/// Loads one thing after another on a thread of its own and hands over what is finished. All
/// functions are for the owner's thread; none waits for loading but the destructor, which cancels.
class BackgroundLoader {
 public:
  using Loaded = std::variant<LoadedTake, LoadedAvatar, std::shared_ptr<CalibrationSession>,
                              std::shared_ptr<TestPostures>>;
  using Work = std::function<Result<Loaded>(const Progress&)>;

  BackgroundLoader();
  ~BackgroundLoader();

  /// `subject` is shown while it is at work ("solving karate.c3d").
  void Add(std::string subject, Work work);
  /// A take or an avatar, by its extension.
  void AddFile(const std::filesystem::path& path);
  /// Gives up the present work and all that waits.
  void Cancel();

  struct Activity {
    std::string subject;
    double fraction = 0.0;
    std::string what;
    std::size_t waiting = 0;  // more after this
  };
  /// What it is at; nothing when idle.
  std::optional<Activity> activity() const;

  /// One finished piece, in the order added; nothing when there is none. Cancelled work is not
  /// handed over.
  std::optional<Result<Loaded>> Take();

 private:
  struct Job {
    std::string subject;
    Work work;
  };
  void Run(std::stop_token stop);

  mutable std::mutex mutex_;
  std::condition_variable_any woken_;
  std::deque<Job> waiting_;              // guarded by mutex_
  std::optional<Activity> activity_;     // guarded by mutex_
  std::deque<Result<Loaded>> finished_;  // guarded by mutex_
  std::atomic<bool> cancelled_ = false;  // of the present work
  std::jthread thread_;                  // last: it starts when everything above is there
};

}  // namespace ego
