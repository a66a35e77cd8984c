// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/character.h"
#include "core/skeleton/pose.h"

namespace ego {

/// Reads a rigged character from glTF 2.0 (.gltf with its files beside it, .glb) or VRM 0.x and
/// 1.0 (.vrm), finds its humanoid and aligns its rest pose to the canonical T-pose.
///
/// The rest pose is that of the inverse bind matrices, not of the nodes. Coordinates are read as
/// metres unless the body's height says otherwise (a note tells). What cannot be shown as the file
/// means it (image formats, morph targets) is left out with a note. Errors: one sentence that
/// names the file, the object in it and what was expected.
Result<Character> ReadCharacter(const std::filesystem::path& path, const Progress& progress = {});

/// The same from memory, for .glb, .vrm and .gltf whose buffers are inside. `name` is the file name
/// that errors show; nothing outside `bytes` is read.
Result<Character> ParseCharacter(std::span<const std::uint8_t> bytes, std::string_view name,
                                 const Progress& progress = {});

/// Writes a character as GLB: meshes, skins, materials, images, and VRMC_vrm 1.0 human bones. In
/// the file the character stands in its canonical pose, in metres.
Result<void> WriteCharacter(const std::filesystem::path& path, const Character& character);

/// Writes the character with one animation in it as GLB: the file it came from with everything in
/// it but its animations, or, for generated characters (no source path), as WriteCharacter does.
/// Rotations are written for the nodes that turn, translations for the hips and for nodes that
/// move against their parents; never scales. `rate_hz` > 0; pose i is at time i / rate_hz.
/// `animation_name` is what other programs list the animation as.
Result<void> WriteRetargeted(const std::filesystem::path& path, const Character& character,
                             std::span<const Pose> poses, double rate_hz,
                             std::string_view animation_name, const Progress& progress = {});

}  // namespace ego
