// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "app/stage/frame_maker.h"
#include "app/stage/playhead.h"
#include "core/base/latest_value.h"
#include "core/pipeline/stage_frame.h"

namespace ego {

/// Plays a scene at the take's rate on a thread of its own and hands each frame to the drawing
/// thread, which is never blocked and may skip frames.
///
/// All public functions are for one thread, the owner's. Commands are carried out between frames
/// in the order given; a frame whose `commands_done` equals `commands_given()` has them all.
class StageThread {
 public:
  StageThread();
  /// Stops the thread, then releases what it worked on.
  ~StageThread();
  StageThread(const StageThread&) = delete;
  StageThread& operator=(const StageThread&) = delete;

  /// Another scene, whose motion has frames. With the same motion as before the playhead stays
  /// where it is, else it goes to the first frame; playing goes on as it did.
  void SetScene(std::shared_ptr<const StageScene> scene);
  /// The name must be one of RetargetMethodNames().
  void SetMethod(std::string name);
  /// Playing from the last frame of a motion that does not loop begins at the first.
  void Play(bool playing);
  /// To a frame, clamped to the motion; playing goes on from there.
  void Seek(std::size_t frame);
  /// Pauses and moves by so many frames, clamped to the motion.
  void Step(std::ptrdiff_t frames);
  /// Share of the take's rate, clamped to [0.1, 4].
  void SetSpeed(double speed);
  void SetLoop(bool loop);

  std::uint64_t commands_given() const { return commands_given_; }

  /// Takes the newest frame if there is one since the last call. True when `frame()` changed.
  bool Fetch() { return slot_.Fetch(); }
  /// The newest fetched frame; its `scene` is null before the first.
  const StageFrame& frame() const { return slot_.Front(); }

 private:
  struct PlayTo {
    bool playing;
  };
  struct SeekTo {
    std::size_t frame;
  };
  struct StepBy {
    std::ptrdiff_t frames;
  };
  struct SpeedTo {
    double speed;
  };
  struct LoopTo {
    bool loop;
  };
  struct MethodTo {
    std::string name;
  };
  struct SceneTo {
    std::shared_ptr<const StageScene> scene;
  };
  using Command = std::variant<PlayTo, SeekTo, StepBy, SpeedTo, LoopTo, MethodTo, SceneTo>;

  void Give(Command command);
  void Run(std::stop_token stop);
  void CarryOut(Command& command, Playhead::Time now);
  void Publish();

  // The owner's side.
  std::uint64_t commands_given_ = 0;

  // Between the two.
  std::mutex mutex_;
  std::condition_variable_any woken_;
  std::vector<Command> waiting_;  // guarded by mutex_
  LatestValue<StageFrame> slot_;

  // The thread's side.
  std::vector<Command> taken_;
  FrameMaker maker_;
  Playhead playhead_;
  StepClock frame_clock_;
  std::uint64_t sequence_ = 0;
  std::uint64_t commands_done_ = 0;

  std::jthread thread_;  // last: it starts when everything above is there
};

}  // namespace ego
