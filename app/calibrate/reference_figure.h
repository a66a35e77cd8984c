// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "app/calibrate/calibrate_view.h"
#include "app/calibrate/pick_item.h"
#include "app/view/gui_texture.h"
#include "assets/calibration/test_postures.h"
#include "assets/people/person.h"
#include "render/stage_renderer.h"

namespace ego {

/// Small pictures of a person of the studio's own cast: where a point lies, and the test
/// postures. Drawn once each and kept.
class ReferenceFigure {
 public:
  /// About a second of work the first time in a program.
  static std::shared_ptr<TestPostures> Prepare();

  void SetPostures(std::shared_ptr<TestPostures> postures) { postures_ = std::move(postures); }
  TestPostures* postures() const { return postures_.get(); }

  /// The picture on which an item is seen, `width` x `height` pixels, and the lens that made it,
  /// with its corner at the window's. Null before the postures are there.
  const GuiTexture* PictureOf(StageRenderer& renderer, const PickItem& item, int width, int height);
  Lens LensOf(const PickItem& item, int width, int height) const;
  /// Where an item lies on the figure.
  Vec3 PositionOf(const PickItem& item) const;

  const GuiTexture* PictureOf(StageRenderer& renderer, TestPosture posture, int side);

 private:
  struct Seen {
    Camera camera;
    int width = 0;
    int height = 0;
    GuiTexture picture;
  };
  Image Draw(StageRenderer& renderer, const ModelPose& pose, const Camera& camera, int width,
             int height);

  std::shared_ptr<TestPostures> postures_;
  CharacterId mesh_;
  std::vector<Seen> seen_;
  std::array<Seen, kTestPostureCount> posture_;
};

}  // namespace ego
