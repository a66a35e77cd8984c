// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/body/body_surface.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// A performer or an avatar: the same type. The method needs nothing else of either.
struct Body {
  std::string name;
  Skeleton skeleton;
  BodySurface surface;
  double height = 0.0;                // crown above ground in the canonical pose, metres
  double standing_root_height = 0.0;  // hips joint above ground in the canonical pose, metres
};

/// A body with its lengths multiplied by `factor`.
Body Scaled(const Body& body, double factor);

/// The skeleton of an average adult of this height, metres.
Skeleton TemplateSkeleton(double height);

/// The template's skin on any skeleton: heights follow the joints, widths the shoulders and hips,
/// depths the trunk's length. What a body is given until its own surface is measured.
/// `height` is the crown's height above ground, metres.
Body BodyFromSkeleton(std::string name, const Skeleton& skeleton, double height);

/// An average adult, 1.78 m unless told otherwise.
Body TemplateBody(double height = 1.78);

}  // namespace ego
