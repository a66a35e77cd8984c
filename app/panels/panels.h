// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace ego
