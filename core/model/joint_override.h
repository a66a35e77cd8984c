// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "core/base/result.h"
#include "core/model/character.h"

namespace ego {

/// What a person says about a rig: the node that plays a joint, -1 for none; nothing where the
/// studio's own map stands.
using JointOverrides = std::array<std::optional<int>, kJointCount>;

/// The character with its map mended and its rig fitted anew. A joint that would lose its node to
/// an overridden one takes the node that one had. Error: a joint that no humanoid can do without
/// would have no node, a node does not exist or would be two joints, or the rest pose has no shape
/// then.
Result<Character> WithJointOverrides(const Character& character, const JointOverrides& overrides);

}  // namespace ego
