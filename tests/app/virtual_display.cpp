// SPDX-License-Identifier: MIT
#include "tests/app/virtual_display.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include <gtest/gtest.h>

extern char** environ;

namespace ego::test {

bool Installed(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0;
}

VirtualDisplay::VirtualDisplay(int width, int height) {
  int ends[2];
  if (pipe(ends) != 0) return;
  const std::string fd = std::to_string(ends[1]);
  std::string screen = std::to_string(width);
  screen.append("x").append(std::to_string(height)).append("x24");
  const char* argv[] = {"Xvfb", "-displayfd",   fd.c_str(), "-screen",
                        "0",    screen.c_str(), "-noreset", nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  if (posix_spawnp(&server_, argv[0], &quiet, nullptr, const_cast<char**>(argv), environ) != 0) {
    server_ = -1;
  }
  posix_spawn_file_actions_destroy(&quiet);
  close(ends[1]);
  char number[16] = {};
  const ssize_t read_bytes = server_ > 0 ? read(ends[0], number, sizeof(number) - 1) : 0;
  close(ends[0]);
  std::string name(1, ':');
  name.append(std::to_string(std::atoi(number)));
  if (read_bytes > 0) setenv("DISPLAY", name.c_str(), 1);
  ready_ = read_bytes > 0;
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
  unsetenv("DISPLAY");
}

void Do(const std::string& actions) {
  ASSERT_EQ(std::system(("xdotool " + actions).c_str()), 0) << actions;
}

bool RunUntil(Studio& studio, const std::function<bool()>& wanted) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < limit) {
    studio.RunFrame();
    if (wanted()) return true;
  }
  return false;
}

}  // namespace ego::test
