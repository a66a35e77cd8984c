// SPDX-License-Identifier: MIT
#include "app/loading/background_loader.h"

#include <exception>
#include <new>
#include <utility>

#include "app/loading/file_kind.h"

namespace ego {
namespace {

template <class T>
Result<BackgroundLoader::Loaded> AsLoaded(Result<T> result) {
  if (!result) return Error{result.error()};
  return BackgroundLoader::Loaded(*std::move(result));
}

}  // namespace

BackgroundLoader::BackgroundLoader() : thread_([this](std::stop_token stop) { Run(stop); }) {}

BackgroundLoader::~BackgroundLoader() {
  Cancel();
  thread_.request_stop();
  thread_.join();
}

void BackgroundLoader::Add(std::string subject, Work work) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(subject), std::move(work)});
  }
  woken_.notify_one();
}

void BackgroundLoader::AddFile(const std::filesystem::path& path) {
  Add("Opening " + path.filename().string(), [path](const Progress& progress) -> Result<Loaded> {
    const Result<FileKind> kind = KindOf(path);
    if (!kind) return Error{kind.error()};
    if (*kind == FileKind::kTake) return AsLoaded(LoadTake(path, {}, progress));
    return AsLoaded(LoadAvatar(path, progress));
  });
}

void BackgroundLoader::Cancel() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  cancelled_ = true;
}

std::optional<BackgroundLoader::Activity> BackgroundLoader::activity() const {
  const std::lock_guard lock(mutex_);
  if (!activity_) return std::nullopt;
  Activity now = *activity_;
  now.waiting = waiting_.size();
  return now;
}

std::optional<Result<BackgroundLoader::Loaded>> BackgroundLoader::Take() {
  const std::lock_guard lock(mutex_);
  if (finished_.empty()) return std::nullopt;
  std::optional<Result<Loaded>> first(std::move(finished_.front()));
  finished_.pop_front();
  return first;
}

void BackgroundLoader::Run(std::stop_token stop) {
  while (true) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      woken_.wait(lock, stop, [this] { return !waiting_.empty(); });
      if (stop.stop_requested()) return;
      job = std::move(waiting_.front());
      waiting_.pop_front();
      cancelled_ = false;
      activity_ = Activity{job.subject, 0.0, {}, 0};
    }
    const Progress progress = [&](double fraction, std::string_view what) {
      const std::lock_guard lock(mutex_);
      activity_->fraction = fraction;
      activity_->what = what;
      return !cancelled_;
    };
    Result<Loaded> result = [&]() -> Result<Loaded> {
      try {
        return job.work(progress);
      } catch (const std::bad_alloc&) {
        return Error{job.subject + ": not enough memory"};
      } catch (const std::exception& error) {
        return Error{job.subject + ": stopped by an unexpected fault: " + error.what()};
      }
    }();
    const std::lock_guard lock(mutex_);
    activity_.reset();
    if (!cancelled_) finished_.push_back(std::move(result));
  }
}

}  // namespace ego
