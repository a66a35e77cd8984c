// SPDX-License-Identifier: MIT
#include "app/commands/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

extern char** environ;

namespace ego {
namespace {

// Starts ffmpeg with its standard input at the end of a new pipe; writes the other end to `pipe`.
int Spawn(const std::vector<std::string>& arguments, int& child, int& pipe) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return errno;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (failed != 0) {
    close(ends[1]);
    return failed;
  }
  pipe = ends[1];
  return 0;
}

}  // namespace

Result<Film> Film::Begin(const std::filesystem::path& path, int width, int height, double rate_hz) {
  Film film;
  film.path_ = path;
  film.part_ = path;
  film.part_ += ".part.mp4";
  std::string size = std::to_string(width);
  size.append("x").append(std::to_string(height));
  std::string target = "file:";
  target += film.part_.string();
  const std::vector<std::string> arguments = {
      "ffmpeg",      "-loglevel", "error",         "-y",
      "-f",          "rawvideo",  "-pixel_format", "rgba",
      "-video_size", size,        "-framerate",    std::to_string(rate_hz),
      "-i",          "-",         "-pix_fmt",      "yuv420p",
      "-crf",        "18",        "-movflags",     "+faststart",
      target};
  // A child that ends early must show as a failed write, not end this program.
  std::signal(SIGPIPE, SIG_IGN);
  const int failed = Spawn(arguments, film.child_, film.pipe_);
  if (failed == ENOENT) {
    return Error{
        path.string() +
        ": films need the program ffmpeg, which is not installed (apt-get install ffmpeg)"};
  }
  if (failed != 0) {
    return Error{path.string() + ": ffmpeg could not be started: " + std::strerror(failed)};
  }
  return film;
}

Film::Film(Film&& other) noexcept
    : path_(std::move(other.path_)),
      part_(std::move(other.part_)),
      child_(std::exchange(other.child_, -1)),
      pipe_(std::exchange(other.pipe_, -1)) {}

Film::~Film() { Abandon(); }

void Film::Abandon() {
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  if (child_ < 0) return;
  int status = 0;
  waitpid(std::exchange(child_, -1), &status, 0);
  std::error_code error;
  std::filesystem::remove(part_, error);
}

Result<void> Film::Add(const Image& picture) {
  const std::uint8_t* at = picture.rgba.data();
  std::size_t left = picture.rgba.size();
  while (left > 0) {
    const ssize_t wrote = write(pipe_, at, left);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return Error{path_.string() + ": ffmpeg stopped before the film was complete"};
    at += wrote;
    left -= static_cast<std::size_t>(wrote);
  }
  return {};
}

Result<void> Film::Finish() {
  close(std::exchange(pipe_, -1));
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  std::error_code error;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    std::filesystem::remove(part_, error);
    return Error{path_.string() + ": ffmpeg could not write the film"};
  }
  std::filesystem::rename(part_, path_, error);
  if (error) return Error{path_.string() + ": the film cannot be put there: " + error.message()};
  return {};
}

}  // namespace ego
