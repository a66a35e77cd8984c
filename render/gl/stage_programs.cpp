// SPDX-License-Identifier: MIT
#include "render/gl/stage_programs.h"

#include <array>
#include <string_view>
#include <utility>

namespace ego::gl {

Result<StagePrograms> StagePrograms::Build() {
  StagePrograms all;
  struct Recipe {
    Program* program;
    const char* vertex;
    const char* fragment;
    std::string_view define;
  };
  const std::array<Recipe, 10> recipes = {{
      {&all.body, "body.vert", "body.frag", {}},
      {&all.body_textured, "body.vert", "body.frag", "TEXTURED"},
      {&all.depth, "depth.vert", "depth.frag", {}},
      {&all.depth_textured, "depth.vert", "depth.frag", "TEXTURED"},
      {&all.ground, "ground.vert", "ground.frag", {}},
      {&all.ground_shadowed, "ground.vert", "ground.frag", "SHADOWED"},
      {&all.room, "room.vert", "room.frag", {}},
      {&all.spot, "spot.vert", "spot.frag", {}},
      {&all.plate, "plate.vert", "plate.frag", {}},
      {&all.edge, "depth.vert", "edge.frag", {}},
  }};
  for (const Recipe& r : recipes) {
    Result<Program> built =
        Program::Build(r.vertex, r.fragment, std::span(&r.define, r.define.empty() ? 0u : 1u));
    if (!built) return Error{built.error()};
    *r.program = std::move(*built);
  }
  return all;
}

}  // namespace ego::gl
