// SPDX-License-Identifier: MIT
#pragma once

#include "app/panels/frame_layout.h"

namespace ego {

class Studio;

// One function per panel, each in a file of its own. Called once per frame between Gui::Begin and
// Gui::End; each draws into its part of Studio::layout().

/// Name, transport-free title line: method, draw and stage times.
void ShowTopBar(Studio& studio);
/// Takes and avatars: choose, show, hide, remove.
void ShowLeftRail(Studio& studio);
/// What is selected: an avatar's or the take's facts.
void ShowInspector(Studio& studio);
/// Transport, speed, scrubbing.
void ShowTimeline(Studio& studio);
/// Last message, progress with cancel, frame times.
void ShowStatusBar(Studio& studio);
/// Camera and selection by mouse, overlay toggles, empty state. The picture itself lies beneath.
void ShowViewport(Studio& studio);
/// The borders between panels, draggable; a double click folds one away.
void ShowSplitters(Studio& studio);
/// The list of all keys.
void ShowKeys(Studio& studio);
/// What is asked before the window closes, and what the last session left behind.
void ShowQuestions(Studio& studio);

// Pieces that both workspaces show.

/// The last error, at the lower edge of the picture until it is dismissed.
void ShowError(Studio& studio, const Rect& view);
/// Whose mouse habits the camera follows, at the lower left corner of the picture.
void ShowNavigationMenu(Studio& studio, const Rect& view);
/// Avatar files opened lately, one button each; nothing where there are none.
void ShowRecentFiles(Studio& studio);

}  // namespace ego
