// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/commands/cast_arguments.h"
#include "app/commands/command.h"
#include "app/commands/film.h"
#include "app/commands/terminal.h"
#include "app/loading/file_kind.h"
#include "app/stage/frame_maker.h"
#include "app/view/fonts.h"
#include "app/view/stage_picture.h"
#include "assets/files/file_io.h"
#include "render/offscreen.h"
#include "render/png.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestSide = 8192;

struct Arguments {
  CastArguments cast;
  fs::path out;
  std::string size;
  std::string view = "three-quarter";
  std::optional<double> time_s;
  double from_s = 0.0;
  std::optional<double> to_s;
  double film_rate_hz = 30.0;
  int strip = 0;
  bool crude = false;
  bool true_sizes = false;
};

Result<ViewportSize> ParseSize(const std::string& text) {
  ViewportSize size;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest);
  if (read != 2 || size.width < 16 || size.height < 16 || size.width > kLargestSide ||
      size.height > kLargestSide) {
    return Error{"--size " + text +
                 ": expected WIDTHxHEIGHT in pixels, each 16 to 8192, such as "
                 "1280x720"};
  }
  return size;
}

StandardView ViewNamed(const std::string& name) {
  if (name == "front") return StandardView::kFront;
  if (name == "side") return StandardView::kSide;
  if (name == "top") return StandardView::kTop;
  return StandardView::kThreeQuarter;
}

// Draws any frame of one scene from any side.
class Studio {
 public:
  Studio(const Cast& cast, const Arguments& arguments, StagePicture picture)
      : picture_(std::move(picture)) {
    auto scene = std::make_shared<StageScene>();
    scene->motion = cast.take.motion;
    std::vector<StageMember> members;
    for (std::size_t i = 0; i < cast.avatars.size(); ++i) {
      const LoadedAvatar& avatar = cast.avatars[i];
      scene->avatars.push_back({i + 1, avatar.body});
      members.push_back({i + 1, avatar.name, look::AvatarColor(i), true, avatar.character});
    }
    picture_.SetMembers(std::move(members));
    maker_.SetMethod(arguments.cast.method);
    maker_.SetScene(std::move(scene));
    overlays_.crude = arguments.crude;
    overlays_.true_sizes = arguments.true_sizes;
  }

  std::size_t FrameAt(double time_s) const {
    const CapturedMotion& motion = *maker_.scene()->motion;
    const double frame = std::round(time_s * motion.rate_hz);
    return static_cast<std::size_t>(
        std::clamp(frame, 0.0, static_cast<double>(motion.poses.size() - 1)));
  }
  double Duration() const {
    const CapturedMotion& motion = *maker_.scene()->motion;
    return static_cast<double>(motion.poses.size() - 1) / motion.rate_hz;
  }

  // Turns the camera so that everyone is in the picture at all of these frames.
  Camera FramedOver(std::span<const std::size_t> frames, StandardView view, ViewportSize size) {
    Box3 box;
    for (const std::size_t frame : frames) {
      Arrange(frame, view);
      box.Add(picture_.Bounds());
    }
    MakeRoomForNames(box);
    Camera camera;
    camera.Look(view);
    camera.yaw += picture_.heading();
    camera.Frame(box, size, 0.04);
    return camera;
  }

  Image Draw(std::size_t frame, StandardView view, Camera camera, ViewportSize size) {
    StageView stage;
    stage.figures = Arrange(frame, view);
    camera.target_ws += picture_.anchor();
    stage.camera = camera;
    stage.name_plates = overlays_.names;
    return picture_.renderer().DrawImage(stage, size.width, size.height,
                                         std::max(0.6f, static_cast<float>(size.height) / 800.0f));
  }

 private:
  std::span<const Figure> Arrange(std::size_t frame, StandardView view) {
    maker_.Make(frame, frame_);
    return picture_.Arrange(
        frame_, overlays_,
        view == StandardView::kSide ? StageLayout::Line::kDepthwise : StageLayout::Line::kSideways);
  }

  FrameMaker maker_;
  StagePicture picture_;
  StageFrame frame_;
  Overlays overlays_;
};

// Copies a picture into a larger one.
void Paste(const Image& piece, int x, int y, Image& sheet) {
  for (int row = 0; row < piece.height; ++row) {
    const auto from = piece.rgba.begin() + std::ptrdiff_t{4} * row * piece.width;
    const auto to = sheet.rgba.begin() + std::ptrdiff_t{4} * ((y + row) * sheet.width + x);
    std::copy(from, from + std::ptrdiff_t{4} * piece.width, to);
  }
}

std::vector<std::size_t> Spread(const Studio& studio, double from_s, double to_s, int count) {
  std::vector<std::size_t> frames;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count;
    frames.push_back(studio.FrameAt(from_s + share * (to_s - from_s)));
  }
  return frames;
}

// One row per frame: seen from the front at the left, from the side at the right.
Image DrawStrip(Studio& studio, std::span<const std::size_t> frames, ViewportSize cell) {
  const Camera front = studio.FramedOver(frames, StandardView::kFront, cell);
  const Camera side = studio.FramedOver(frames, StandardView::kSide, cell);
  Image sheet;
  sheet.width = 2 * cell.width;
  sheet.height = cell.height * static_cast<int>(frames.size());
  sheet.rgba.resize(std::size_t{4} * static_cast<std::size_t>(sheet.width) *
                    static_cast<std::size_t>(sheet.height));
  ProgressLine line("drawing");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int y = static_cast<int>(i) * cell.height;
    Paste(studio.Draw(frames[i], StandardView::kFront, front, cell), 0, y, sheet);
    Paste(studio.Draw(frames[i], StandardView::kSide, side, cell), cell.width, y, sheet);
    line.Show(static_cast<double>(i + 1) / static_cast<double>(frames.size()), "strip");
  }
  return sheet;
}

Result<void> WritePicture(const fs::path& path, const Image& picture) {
  const std::vector<std::uint8_t> png = EncodePng(picture);
  if (png.empty()) return Error{path.string() + ": a picture of this size cannot be drawn here"};
  return WriteFileAtomically(path, png);
}

Result<void> WriteFilm(Studio& studio, const Arguments& arguments, double to_s, ViewportSize size) {
  const StandardView view = ViewNamed(arguments.view);
  const Camera camera = studio.FramedOver(Spread(studio, arguments.from_s, to_s, 40), view, size);
  Result<Film> film = Film::Begin(arguments.out, size.width, size.height, arguments.film_rate_hz);
  if (!film) return Error{film.error()};
  const auto count = static_cast<std::size_t>(
      std::floor((to_s - arguments.from_s) * arguments.film_rate_hz + 1e-6) + 1.0);
  ProgressLine line("drawing " + arguments.out.filename().string());
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = arguments.from_s + static_cast<double>(i) / arguments.film_rate_hz;
    const Result<void> added = film->Add(studio.Draw(studio.FrameAt(time_s), view, camera, size));
    if (!added) return added;
    line.Show(static_cast<double>(i + 1) / static_cast<double>(count), "film");
  }
  return film->Finish();
}

int Render(const Arguments& arguments) {
  const std::string extension = LowerExtension(arguments.out);
  const bool film = extension == ".mp4";
  if (!film && extension != ".png") {
    return Fail(arguments.out.string() + ": pictures are written as .png, films as .mp4");
  }
  if (film && arguments.strip > 0) return Fail("--strip makes a picture: --out must end in .png");
  const Result<ViewportSize> size = ParseSize(
      !arguments.size.empty() ? arguments.size : (arguments.strip > 0 ? "960x420" : "1280x720"));
  if (!size) return Fail(size.error());
  if (film && (size->width % 2 != 0 || size->height % 2 != 0)) {
    return Fail("--size " + arguments.size + ": films need an even width and height");
  }
  if (arguments.strip * size->height > 2 * kLargestSide) {
    return Fail("--strip: so many frames of this size make a picture of more than 16384 rows");
  }
  if (arguments.to_s && *arguments.to_s < arguments.from_s) {
    return Fail("--to lies before --from");
  }
  const Result<OffscreenContext> context = OffscreenContext::Create();
  if (!context) return Fail(context.error());
  const std::vector<std::uint8_t> font = ReadFace(Face::kTextStrong);
  Result<StageRenderer> renderer = StageRenderer::Create({.font = font, .samples = 4});
  if (!renderer) return Fail(renderer.error());
  const Result<Cast> cast = LoadCast(arguments.cast);
  if (!cast) return Fail(cast.error());

  Studio studio(*cast, arguments, StagePicture(*std::move(renderer)));
  const double to_s = std::min(arguments.to_s.value_or(studio.Duration()), studio.Duration());
  const Result<void> written = [&]() -> Result<void> {
    if (film) return WriteFilm(studio, arguments, to_s, *size);
    if (arguments.strip > 0) {
      const auto frames = Spread(studio, arguments.from_s, to_s, arguments.strip);
      return WritePicture(arguments.out, DrawStrip(studio, frames, *size));
    }
    const StandardView view = ViewNamed(arguments.view);
    const std::size_t frame =
        studio.FrameAt(arguments.time_s.value_or(0.5 * (arguments.from_s + to_s)));
    const Camera camera = studio.FramedOver({&frame, 1}, view, *size);
    return WritePicture(arguments.out, studio.Draw(frame, view, camera, *size));
  }();
  if (!written) return Fail(written.error());
  std::printf("%s\n", arguments.out.string().c_str());
  return kDone;
}

}  // namespace

Command AddRenderCommand(CLI::App& program) {
  CLI::App* line = program.add_subcommand(
      "render", "Draw performer, skeleton and avatars side by side, without a window");
  auto arguments = std::make_shared<Arguments>();
  AddCastOptions(*line, arguments->cast);
  line->add_option("--out", arguments->out, "Picture (.png) or film (.mp4) to write")->required();
  line->add_option("--size", arguments->size,
                   "WIDTHxHEIGHT in pixels, of one cell with --strip (default 1280x720)");
  line->add_option("--view", arguments->view, "Where to look from")
      ->check(CLI::IsMember({"three-quarter", "front", "side", "top"}))
      ->capture_default_str();
  line->add_option("--time", arguments->time_s, "Instant to draw, seconds (default: the middle)")
      ->check(CLI::NonNegativeNumber);
  line->add_option("--from", arguments->from_s, "Begin of film or strip, seconds")
      ->check(CLI::NonNegativeNumber);
  line->add_option("--to", arguments->to_s, "End of film or strip, seconds (default: the end)")
      ->check(CLI::NonNegativeNumber);
  line->add_option("--fps", arguments->film_rate_hz, "Pictures per second of a film")
      ->check(CLI::Range(1.0, 240.0))
      ->capture_default_str();
  line->add_option("--strip", arguments->strip,
                   "So many instants in one picture, each from the front and from the side")
      ->check(CLI::Range(1, 100));
  line->add_flag("--true-sizes", arguments->true_sizes,
                 "Giants and dwarfs at their own size (default: at one that compares well)");
  line->add_flag("--crude", arguments->crude,
                 "Show the surfaces that the method works with over the avatars");
  line->footer(
      "Without --take the demo's motion is used, without --avatar the demo's cast.\n\n"
      "Examples:\n"
      "  egostudio render --out demo.png\n"
      "  egostudio render --take karate.c3d --avatar knight.glb --strip 6 --out karate.png\n"
      "  egostudio render --take karate.c3d --avatar knight.glb --out karate.mp4 --to 10");
  return {line, [arguments] { return Render(*arguments); }};
}

}  // namespace ego
