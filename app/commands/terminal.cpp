// SPDX-License-Identifier: MIT
#include "app/commands/terminal.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "app/commands/command.h"

namespace ego {
namespace {

using namespace std::chrono_literals;

std::string OneLine(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return line;
}

}  // namespace

int Fail(std::string_view sentence) {
  std::fprintf(stderr, "egostudio: %s\n", OneLine(sentence).c_str());
  return kFailed;
}

void PrintNotes(std::string_view about, std::span<const std::string> notes) {
  for (const std::string& note : notes) {
    std::fprintf(stderr, "note: %s: %s\n", std::string(about).c_str(), OneLine(note).c_str());
  }
}

ProgressLine::ProgressLine(std::string subject)
    : subject_(std::move(subject)),
      terminal_(isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + (terminal_ ? 300ms : 2s)) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::Show(double fraction, std::string_view what) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(100ms) : Clock::duration(5s));
  shown_ = true;
  const int percent = static_cast<int>(100.0 * fraction);
  const std::string detail(what);
  std::fprintf(stderr, terminal_ ? "\r\033[K%s: %3d %%  %s" : "%s: %3d %%  %s\n", subject_.c_str(),
               percent, detail.c_str());
  std::fflush(stderr);
}

Progress ProgressLine::AsProgress() {
  return [this](double fraction, std::string_view what) {
    Show(fraction, what);
    return true;
  };
}

}  // namespace ego
