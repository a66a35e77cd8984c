// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "app/panels/frame_layout.h"

namespace ego {

// Small pieces that several panels are made of. Sizes are given at scale 1.

/// Pixels at the window's content scale.
float Px(float size);
/// A colour of render/look.h as Dear ImGui packs it.
unsigned Packed(const glm::vec3& srgb, float alpha = 1.0f);

/// Begins a borderless panel that fills a rectangle. False when it is folded away; EndPanel is
/// called either way. Panels do not overlap, but for a card that lies above the others.
bool BeginPanel(const char* name, const Rect& rect, const glm::vec3& ground, float padding = 12.0f,
                bool above_others = false);
void EndPanel();

/// Begins the invisible panel under which the picture lies; ends with ImGui::End.
void BeginViewport(const Rect& rect);
/// Begins a card of this size (at scale 1) in the middle of a rectangle, above everything else.
void BeginCard(const char* name, const Rect& within, float width, float height);
void EndCard();
/// The one button that one would press.
bool PrimaryButton(const char* label, float width = 0.0f);

/// A heading of a section, with room above it.
void Section(const char* title);
/// Text in the quiet colour, wrapped at the panel's edge.
void Quiet(std::string_view text);
/// One fact: quiet name at the left, value in the mono face at the right, its unit quiet.
void Fact(const char* name, std::string_view value, const char* unit = "");

/// Signs drawn by hand, so that no icon font is needed.
enum class Sign { kPlay, kPause, kFirst, kLast, kBack, kForward, kLoop, kEye, kEyeOff, kCross };
/// A button that shows a sign; `tip` is shown on hover. True when pressed.
bool SignButton(const char* id, Sign sign, const char* tip, bool lit = false, float size = 28.0f);
/// A button with a word that is lit while on. True when pressed.
bool Toggle(const char* label, const char* tip, bool on);
/// Shows a sentence when the last item is hovered for a moment.
void Tip(const char* text);

}  // namespace ego
