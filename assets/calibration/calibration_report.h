// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "assets/calibration/calibration_document.h"
#include "assets/calibration/check_calibration.h"

namespace ego {

/// Whether a calibration stands as it is or a person should look, with everything that speaks for
/// or against it, as JSON: summary, findings, every point and segment with its confidence, every
/// joint of the map, the gaps that the test postures leave. Lengths in metres.
std::string FormatCalibrationReport(const CalibrationDocument& document,
                                    const std::vector<CalibrationFinding>& findings);

}  // namespace ego
