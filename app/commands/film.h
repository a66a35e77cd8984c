// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/model/character.h"

namespace ego {

/// Writes pictures as an MP4 film by handing them to the program `ffmpeg`, which must be
/// installed. The film appears under its name when `Finish` succeeds and not before.
class Film {
 public:
  /// Width and height must be even. Error: a sentence that names the file or says that ffmpeg is
  /// missing.
  static Result<Film> Begin(const std::filesystem::path& path, int width, int height,
                            double rate_hz);
  Film(Film&& other) noexcept;
  Film& operator=(Film&&) = delete;
  /// An unfinished film is thrown away.
  ~Film();

  Result<void> Add(const Image& picture);
  Result<void> Finish();

 private:
  Film() = default;
  void Abandon();

  std::filesystem::path path_;
  std::filesystem::path part_;  // what ffmpeg writes to
  int child_ = -1;              // process id
  int pipe_ = -1;
};

}  // namespace ego
