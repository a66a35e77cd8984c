// SPDX-License-Identifier: MIT
#pragma once

#include "assets/people/field.h"
#include "assets/people/person.h"
#include "assets/people/region.h"

namespace ego {

/// A person's head as an implicit surface: skull, jaw, cheeks, brow, eyes behind lids, nose, lips,
/// ears, and hair over it. Model space, T-pose, metres, symmetric in x = 0.
class PersonHead {
 public:
  PersonHead() = default;
  /// `chin` is the height of the chin, `middle_z` the depth of the head's middle.
  PersonHead(const PersonParameters& parameters, double chin, double middle_z);

  /// Approximate signed distance to the skin, without hair and neck.
  double Skin(const Vec3& p_ms) const { return Skin(p_ms, false); }
  /// The same; with `plain_ears` they are thick and without a hollow, so that a coarse lattice
  /// catches them.
  double Skin(const Vec3& p_ms, bool plain_ears) const;
  /// Of the hair's outside; far away where there is none.
  double Hair(const Vec3& p_ms) const;
  /// What a point on the head's skin is: skin, lips or a part of the eye.
  Region FaceRegion(const Vec3& p_ms) const;
  /// How long an edge of the mesh may be there, so that the face keeps its features.
  double LongestEdge(const Vec3& p_ms) const;

  /// Front of the left eyeball's iris, and the eyeball's radius.
  Vec3 IrisFront() const;
  double EyeRadius() const { return eye_radius_; }
  /// Between the lips, from the right corner (-1) to the left (1).
  Vec3 OnMouth(double share) const;
  double crown() const { return crown_; }  // height of the skull's top, below the hair
  double middle_z() const { return middle_z_; }
  /// Height above the chin as a share of the head's height, to a height in model space.
  double Y(double share) const { return chin_ + share * parameters_.head_height; }

 private:
  double HairTop() const;
  /// How far a point (relative to chin and middle, x >= 0) is from the hairline, along the skin,
  /// positive where hair grows.
  double AboveHairline(const Vec3& q) const;
  Vec3 Ear() const;  // middle of the left ear, relative to chin and middle
  /// Relative to the eyeball's middle, in eyeball radii.
  Vec3 InEye(const Vec3& q) const;
  double Face(const Vec3& q) const;  // q: relative to chin and middle, x >= 0
  double Front(double x, double y) const;

  PersonParameters parameters_;
  double chin_ = 0.0;
  double middle_z_ = 0.0;
  double crown_ = 0.0;
  double eye_radius_ = 0.0;
  double hair_drop_ = 0.0;  // by which the hair is lowered, so that it ends at the height
  Vec3 eye_{0.0};           // the left eyeball's middle, relative to chin and middle
  Vec3 lips_{0.0};          // middle of the mouth, on the face
  Vec3 mouth_corner_{0.0};  // left
};

}  // namespace ego
