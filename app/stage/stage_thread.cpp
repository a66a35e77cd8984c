// SPDX-License-Identifier: MIT
#include "app/stage/stage_thread.h"

#include <chrono>
#include <utility>

#include "core/base/check.h"

namespace ego {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace

StageThread::StageThread() : thread_([this](std::stop_token stop) { Run(stop); }) {}

StageThread::~StageThread() {
  thread_.request_stop();  // wakes it wherever it waits
  thread_.join();          // nothing below is in use any more
  waiting_.clear();
  maker_.SetScene(nullptr);
}

void StageThread::SetScene(std::shared_ptr<const StageScene> scene) {
  EGO_CHECK(scene && scene->motion && !scene->motion->poses.empty());
  Give(SceneTo{std::move(scene)});
}
void StageThread::SetMethod(std::string name) { Give(MethodTo{std::move(name)}); }
void StageThread::Play(bool playing) { Give(PlayTo{playing}); }
void StageThread::Seek(std::size_t frame) { Give(SeekTo{frame}); }
void StageThread::Step(std::ptrdiff_t frames) { Give(StepBy{frames}); }
void StageThread::SetSpeed(double speed) { Give(SpeedTo{speed}); }
void StageThread::SetLoop(bool loop) { Give(LoopTo{loop}); }

void StageThread::Give(Command command) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(command));
  }
  ++commands_given_;
  woken_.notify_one();
}

void StageThread::Run(std::stop_token stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex_);
      const auto has_command = [this] { return !waiting_.empty(); };
      if (const auto due = playhead_.NextDue()) {
        woken_.wait_until(lock, stop, *due, has_command);
      } else {
        woken_.wait(lock, stop, has_command);
      }
      taken_.swap(waiting_);
    }
    if (stop.stop_requested()) return;
    const Playhead::Time now = Playhead::Time::clock::now();
    for (Command& command : taken_) CarryOut(command, now);
    const bool commanded = !taken_.empty();
    commands_done_ += taken_.size();
    taken_.clear();
    if (playhead_.Advance(now) || commanded) Publish();
  }
}

void StageThread::CarryOut(Command& command, Playhead::Time now) {
  std::visit(Overloaded{
                 [&](const PlayTo& c) { playhead_.Play(c.playing, now); },
                 [&](const SeekTo& c) { playhead_.Seek(c.frame, now); },
                 [&](const StepBy& c) { playhead_.Step(c.frames, now); },
                 [&](const SpeedTo& c) { playhead_.SetSpeed(c.speed, now); },
                 [&](const LoopTo& c) { playhead_.SetLoop(c.loop, now); },
                 [&](const MethodTo& c) { EGO_CHECK(maker_.SetMethod(c.name)); },
                 [&](SceneTo& c) {
                   const bool same = maker_.scene() && maker_.scene()->motion == c.scene->motion;
                   maker_.SetScene(std::move(c.scene));
                   if (same) return;
                   playhead_.SetMotion(maker_.frame_count(), maker_.scene()->motion->rate_hz, now);
                 },
             },
             command);
}

void StageThread::Publish() {
  const auto start = StepClock::Clock::now();
  StageFrame& out = slot_.Back();
  maker_.Make(playhead_.frame(), out);
  out.playing = playhead_.playing();
  out.sequence = ++sequence_;
  out.commands_done = commands_done_;
  out.frames_missed = playhead_.missed();
  frame_clock_.Add(StepClock::Clock::now() - start);
  out.timings.frame = frame_clock_.Summary();
  slot_.Publish();
}

}  // namespace ego
